"""`C["x", 0].set(v)`: choice maps in the syntax of indexing."""

# ruff: noqa: D102 - the methods are those of ChoiceMap, at an address.

from collections.abc import Callable, Iterable
from functools import reduce
from typing import Any

import jax.numpy as jnp

from bayesmap.gen.errors import ShapeMismatch


def components(address: Any) -> tuple[Any, ...]:
    """An address as a tuple."""
    return address if isinstance(address, tuple) else (address,)


class FromMappings:
    """Constructors that need only `choice` (a bare value), `empty`, `extend` and `|`."""

    @classmethod
    def entry(cls, value: Any, *address: Any) -> Any:
        """A value, dict or map at an address."""
        if not isinstance(value, FromMappings):
            value = cls.d(value) if isinstance(value, dict) else cls.choice(value)  # type: ignore[attr-defined]
        return value.extend(*address)

    @classmethod
    def from_mapping(cls, pairs: Iterable[tuple[Any, Any]]) -> Any:
        """A map from (address, value) pairs."""
        entries = [cls.entry(value, *components(address)) for address, value in pairs]
        return reduce(lambda a, b: a | b, entries, cls.empty())  # type: ignore[attr-defined]

    @classmethod
    def d(cls, mapping: dict[Any, Any]) -> Any:
        """A map from a dict, nested dicts included."""
        return cls.from_mapping(mapping.items())

    @classmethod
    def kw(cls, **values: Any) -> Any:
        """A map from keyword arguments."""
        return cls.d(values)


class Builder:
    """`C["x", 0].set(v)`; also `C.v(value)`, `C.d({...})`, `C.kw(...)`, `C.n()`.

    `maps` is the class `ChoiceMap`, `base` the map to change (None for an empty one), `address` what was indexed.
    """

    def __init__(self, maps: Any, base: Any, address: tuple[Any, ...]) -> None:
        self._maps, self._base, self._address = maps, base, address

    def __getitem__(self, address: Any) -> "Builder":
        return Builder(self._maps, self._base, (*self._address, *components(address)))

    def set(self, value: Any) -> Any:
        """The map (the empty one for `C`) with `value`, a value, dict or map, at the address."""
        new = self._maps.entry(value, *self._address)
        if self._base is None:
            return new
        old, value = (chm.get_submap(self._address).get_value() for chm in (self._base, new))
        if old is not None and value is not None and jnp.shape(old) != jnp.shape(value):
            raise ShapeMismatch(self._address, f"found {jnp.shape(value)}, expected {jnp.shape(old)}")
        return new | self._base

    def update(self, f: Callable[[Any], Any]) -> Any:
        base = self._maps.empty() if self._base is None else self._base
        here = base.get_submap(self._address)
        return self.set(f(here.get_value() if here.has_value() else here))

    def v(self, value: Any) -> Any:
        return self.set(self._maps.choice(value))

    def n(self) -> Any:
        return self._maps.empty()

    def d(self, mapping: dict[Any, Any]) -> Any:
        return self.set(self._maps.d(mapping))

    def kw(self, **values: Any) -> Any:
        return self.set(self._maps.kw(**values))

    def from_mapping(self, pairs: Iterable[tuple[Any, Any]]) -> Any:
        return self.set(self._maps.from_mapping(pairs))

    def switch(self, idx: Any, chms: Iterable[Any]) -> Any:
        return self.set(self._maps.switch(idx, chms))
