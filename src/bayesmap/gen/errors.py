"""Errors of wrong use. Messages of address errors name the address, what the user gave, and what is expected there."""

from typing import Any, Self

from bayesmap.errors import BadInput


def format_address(address: tuple[Any, ...]) -> str:
    """Return an address as a user writes it."""
    return repr(address[0] if len(address) == 1 else address)


class AddressError(BadInput):
    """An error at `address`. An enclosing model adds its own part of the address with `under`.
    A subclass may give the `headline` that begins the message. `args` holds the address alone, as a user writes it.
    """

    headline = "Bad use of address"

    def __init_subclass__(cls, *, headline: str | None = None) -> None:
        if headline is not None:
            cls.headline = headline

    def __init__(self, address: Any, detail: str = "") -> None:
        self.address: tuple[Any, ...] = address if isinstance(address, tuple) else (address,)
        self.detail = detail
        # `__str__` makes the text, because `under` changes the address.
        super().__init__(self.address[0] if len(self.address) == 1 else self.address)

    def __reduce__(self) -> Any:
        return type(self), (self.address, self.detail)

    def under(self, prefix: tuple[Any, ...]) -> Self:
        """Return the error of a model that holds this error's model at `prefix`."""
        return type(self)((*prefix, *self.address), self.detail)

    def __str__(self) -> str:
        return f"{self.headline} {format_address(self.address)}{': ' if self.detail else ''}{self.detail}"


class NotAnAddress(AddressError, TypeError, headline="A part that is no string in address"):
    """A site's address is not made of strings."""


class AddressReuse(AddressError, headline="A second site at address"):
    """Two sites of one model have one address, or one lies under the other."""


class MissingAddress(AddressError, headline="No value for the choice at address"):
    """A density needs a value at a site, and none was given."""


class UnknownAddress(AddressError, headline="The model has no choice at address"):
    """A constraint or request names an address that the model does not have."""


class ShapeMismatch(AddressError, headline="Wrong shape at address"):
    """A value's shape differs from the shape of the site's draws."""


class OutsideSupport(AddressError, headline="Value outside the support at address"):
    """A discrete site never draws this value, whatever its parameters."""


class ChoiceMapNoValueAtAddress(AddressError, KeyError, headline="The choice map holds no value at address"):
    """A choice map holds no value at an address that was read."""


class MissingExtra(BadInput, ImportError):
    """An optional library is not installed."""


class BadArguments(BadInput, TypeError):
    """A distribution or function got arguments that it cannot take."""


class NotSupportedEditRequest(TypeError):
    """A generative function got a request that it has no rule for: a fault of a program, not of a user's input."""

    def __init__(self, gen_fn: Any, request: Any) -> None:
        super().__init__(gen_fn, request)  # an error is unpickled by its arguments

    def __str__(self) -> str:
        gen_fn, request = self.args
        return f"{type(gen_fn).__name__} has no rule for the edit request {type(request).__name__}"
