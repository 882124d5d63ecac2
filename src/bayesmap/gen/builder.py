"""`C["x", 0].set(v)`: choice maps in the syntax of indexing."""

# ruff: noqa: D102 - the methods are those of ChoiceMap, at an address.

from collections.abc import Callable, Iterable
from typing import Any

import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap, components
from bayesmap.gen.errors import ShapeMismatch


class Builder:
    """`C["x", 0].set(v)`; also `C.v(value)`, `C.d({...})`, `C.kw(...)`, `C.n()`."""

    def __init__(self, base: ChoiceMap | None, address: tuple[Any, ...]) -> None:
        self._base, self._address = base, address

    def __getitem__(self, address: Any) -> "Builder":
        return Builder(self._base, (*self._address, *components(address)))

    def set(self, value: Any) -> ChoiceMap:
        """The map (the empty one for `C`) with `value`, a value, dict or map, at the address."""
        new = ChoiceMap.entry(value, *self._address)
        if self._base is None:
            return new
        old, value = (
            self._base.get_submap(self._address).get_value(),
            new.get_submap(self._address).get_value(),
        )
        if old is not None and value is not None and jnp.shape(old) != jnp.shape(value):
            raise ShapeMismatch(self._address, f"found {jnp.shape(value)}, expected {jnp.shape(old)}")
        return new | self._base

    def update(self, f: Callable[[Any], Any]) -> ChoiceMap:
        here = (self._base or ChoiceMap.empty()).get_submap(self._address)
        return self.set(f(here.get_value() if here.has_value() else here))

    def v(self, value: Any) -> ChoiceMap:
        return self.set(ChoiceMap.choice(value))

    def n(self) -> ChoiceMap:
        return ChoiceMap.empty()

    def d(self, mapping: dict[Any, Any]) -> ChoiceMap:
        return self.set(ChoiceMap.d(mapping))

    def kw(self, **values: Any) -> ChoiceMap:
        return self.set(ChoiceMap.d(values))

    def from_mapping(self, pairs: Iterable[tuple[Any, Any]]) -> ChoiceMap:
        return self.set(ChoiceMap.from_mapping(pairs))

    def switch(self, index: Any, maps: Iterable[ChoiceMap]) -> ChoiceMap:
        return self.set(ChoiceMap.switch(index, maps))


ChoiceMapBuilder = Builder(None, ())
