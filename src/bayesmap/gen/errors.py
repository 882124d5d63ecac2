"""What bad use gets: every message names the address, what was found and what was expected."""

# ruff: noqa: D102 - each class says its headline.

from typing import Any, Self

from bayesmap.errors import BadInput


def show(address: tuple[Any, ...]) -> str:
    """An address as its user would write it."""
    if len(address) == 1:
        return repr(address[0])
    return repr(address)


class AddressError(BadInput):
    """Something is wrong at `address`; an enclosing model prefixes its own part with `under`.

    `args` holds the address alone, as its user would write it.
    """

    def __init__(self, address: Any, detail: str = "") -> None:
        self.address: tuple[Any, ...] = address if isinstance(address, tuple) else (address,)
        self.detail = detail
        super().__init__(self.address[0] if len(self.address) == 1 else self.address)

    def __reduce__(self) -> Any:
        return type(self), (self.address, self.detail)

    def under(self, prefix: tuple[Any, ...]) -> Self:
        """The same error as seen from a model that holds this one at `prefix`."""
        return type(self)((*prefix, *self.address), self.detail)

    def __str__(self) -> str:
        return f"{self.headline()} {show(self.address)}{': ' if self.detail else ''}{self.detail}"

    def headline(self) -> str:
        """The first words of the message."""
        return "Bad use of address"


class NotAnAddress(AddressError, TypeError):
    """A site's address is not made of strings."""


class AddressReuse(AddressError):
    """Two sites of one model have the same address, or one lies under the other."""

    def headline(self) -> str:
        return "A second site at address"


class MissingAddress(AddressError):
    """A density was asked for, but no value was given at a site."""

    def headline(self) -> str:
        return "No value for the choice at address"


class UnknownAddress(AddressError):
    """A constraint or request names an address that the model does not have."""

    def headline(self) -> str:
        return "The model has no choice at address"


class ShapeMismatch(AddressError):
    """A value's shape differs from that of the site's draws."""

    def headline(self) -> str:
        return "Wrong shape at address"


class OutsideSupport(AddressError):
    """A value that a discrete site can never draw, whatever its parameters."""

    def headline(self) -> str:
        return "Value outside the support at address"


class ChoiceMapNoValueAtAddress(AddressError, KeyError):
    """A choice map was asked for a value that it does not hold."""

    def headline(self) -> str:
        return "The choice map holds no value at address"


class MissingExtra(BadInput, ImportError):
    """An optional library is not installed."""


class BadArguments(BadInput, TypeError):
    """A distribution or function was given arguments that it cannot take."""


class NotSupportedEditRequest(TypeError):
    """A generative function was given a request that it has no rule for."""

    def __init__(self, gen_fn: Any, request: Any) -> None:
        super().__init__(f"{type(gen_fn).__name__} has no rule for the edit request {type(request).__name__}")
