"""Values of random choices by address: `C["walls"].set(w) | C["readings"].set(z)`.

An address is a name, an index, or a tuple of them. Below a vectorised model the values are stored as
whole arrays, so `chm["v"]` is `chm[:, "v"]` and `chm[0, "v"]` its first element. Names select submaps;
an index selects from the leading axis of everything below it.
"""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from collections.abc import Callable, Iterable, Iterator
from functools import reduce
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.errors import ChoiceMapNoValueAtAddress, show
from bayesmap.gen.mask import Mask, is_concrete, where
from bayesmap.gen.pytree import Pytree, dataclass
from bayesmap.gen.selection import Selection

_is_mask: Callable[[Any], bool] = lambda leaf: isinstance(leaf, Mask)  # noqa: E731


def components(address: Any) -> tuple[Any, ...]:
    """An address as a tuple."""
    return address if isinstance(address, tuple) else (address,)


def _index(tree: Any, at: Any) -> Any:
    return jax.tree.map(lambda leaf: leaf[at], tree, is_leaf=_is_mask)


class ChoiceMap(Pytree):
    """Base of choice maps; make one with `ChoiceMapBuilder`, conventionally called `C`."""

    def __repr__(self) -> str:
        from bayesmap.gen.pretty import render

        return render(self)

    # What a kind of node implements ---------------------------------------------------------------

    def get_value(self) -> Any:
        """The value at the empty address, or None; a Mask when its presence is decided at run time."""
        return None

    def get_inner_map(self, component: Any) -> "ChoiceMap":
        """The submap one address component down."""
        raise NotImplementedError

    def filter(self, selection: Any) -> "ChoiceMap":
        """The part whose addresses are selected; with a Boolean flag, everything or nothing."""
        raise NotImplementedError

    def paths(self) -> Iterator[tuple[Any, ...]]:
        """The address of every value, without the indices that its arrays' axes stand for."""
        raise NotImplementedError

    def static_is_empty(self) -> bool:
        """Is it known, whatever the flags, that nothing is here?"""
        return False

    # Asking ---------------------------------------------------------------------------------------

    def get_submap(self, *addresses: Any) -> "ChoiceMap":
        """The submap at an address: empty where there is none."""
        path = [c for address in addresses for c in components(address)]
        return reduce(lambda chm, component: chm.get_inner_map(component), path, self)

    def __call__(self, *addresses: Any) -> "ChoiceMap":
        return self.get_submap(*addresses)

    def __getitem__(self, address: Any) -> Any:
        value = self.get_submap(address).get_value()
        if value is None:
            raise ChoiceMapNoValueAtAddress(address)
        return value

    def __contains__(self, address: Any) -> bool:
        return self.get_submap(address).has_value()

    def has_value(self) -> bool:
        """Is there a value at the empty address?"""
        return self.get_value() is not None

    def get_selection(self) -> Selection:
        """The selection of exactly the addresses that hold a value."""
        sel = Selection.none()
        for path in self.paths():
            sel = sel | Selection.leaf().extend(*(c for c in path if isinstance(c, str)))
        return sel

    def invalid_subset(self, gen_fn: Any, args: tuple[Any, ...]) -> "ChoiceMap | None":
        """The choices that `gen_fn`, run on `args`, would never make; None if there are none."""
        shape = jax.eval_shape(gen_fn.simulate, jax.random.key(0), args).get_choices()
        rest = self.filter(~shape.get_selection())
        return None if rest.static_is_empty() else rest

    # Combining ------------------------------------------------------------------------------------

    def __or__(self, other: "ChoiceMap") -> "ChoiceMap":
        return merge(self, other)

    __add__ = __or__
    __xor__ = __or__

    def merge(self, other: "ChoiceMap") -> "ChoiceMap":
        """Everything in either; where both have a value, this one's."""
        return merge(self, other)

    def __and__(self, other: "ChoiceMap") -> "ChoiceMap":
        return other.filter(self.get_selection())

    def mask(self, flag: Any) -> "ChoiceMap":
        """The same choices where `flag` holds, none elsewhere."""
        return self.filter(flag)

    def extend(self, *address: Any) -> "ChoiceMap":
        """This map moved below `address`."""
        acc = self
        for component in reversed(address):
            if isinstance(component, str):
                acc = Static.build({component: acc})
            elif not isinstance(component, slice):
                acc = acc if acc.static_is_empty() else Indexed(acc, component)
            elif component != slice(None):
                raise ValueError(f"Only the full slice `:` can stand in an address, not {component}")
        return acc

    @property
    def at(self) -> Any:
        """`chm.at["x"].set(v)`: this map with the value at "x" replaced."""
        from bayesmap.gen.builder import Builder

        return Builder(self, ())

    # Making ---------------------------------------------------------------------------------------

    @staticmethod
    def empty() -> "ChoiceMap":
        """The map without values."""
        return Static({})

    @staticmethod
    def choice(value: Any) -> "ChoiceMap":
        """A bare value, at the empty address."""
        if isinstance(value, Mask):
            value = value.flatten()
        return Static({}) if value is None else Choice(value)

    @staticmethod
    def entry(value: Any, *address: Any) -> "ChoiceMap":
        """A value, dict or map at an address."""
        if not isinstance(value, ChoiceMap):
            value = ChoiceMap.d(value) if isinstance(value, dict) else ChoiceMap.choice(value)
        return value.extend(*address)  # type: ignore[no-any-return]

    @staticmethod
    def from_mapping(pairs: Iterable[tuple[Any, Any]]) -> "ChoiceMap":
        """A map from (address, value) pairs."""
        entries = [ChoiceMap.entry(value, *components(address)) for address, value in pairs]
        return reduce(merge, entries, ChoiceMap.empty())

    @staticmethod
    def d(mapping: dict[Any, Any]) -> "ChoiceMap":
        """A map from a dict, nested dicts included."""
        return ChoiceMap.from_mapping(mapping.items())

    @staticmethod
    def kw(**values: Any) -> "ChoiceMap":
        """A map from keyword arguments."""
        return ChoiceMap.d(values)

    @staticmethod
    def switch(index: Any, maps: Iterable["ChoiceMap"]) -> "ChoiceMap":
        """The map numbered `index`; with a traced index, all of them, masked."""
        maps = list(maps)
        return maps[index] if isinstance(index, int) else Switch(index, tuple(maps))


@dataclass
class Choice(ChoiceMap):
    """A bare value: an array, or a Mask of one."""

    value: Any

    def get_value(self) -> Any:
        return self.value

    def get_inner_map(self, component: Any) -> ChoiceMap:
        return Static({}) if isinstance(component, str) else Choice(_index(self.value, component))

    def filter(self, selection: Any) -> ChoiceMap:
        if isinstance(selection, Selection):
            return self if selection.check() else Static({})
        return ChoiceMap.choice(Mask.build(self.value, selection))

    def paths(self) -> Iterator[tuple[Any, ...]]:
        yield ()


@dataclass
class Static(ChoiceMap):
    """Submaps by name."""

    mapping: dict[str, ChoiceMap]

    @staticmethod
    def build(mapping: dict[str, ChoiceMap]) -> "Static":
        """Leaves out what is empty."""
        return Static({name: chm for name, chm in mapping.items() if not chm.static_is_empty()})

    def get_inner_map(self, component: Any) -> ChoiceMap:
        if isinstance(component, str):
            return self.mapping.get(component, Static({}))
        return Static({name: chm.get_inner_map(component) for name, chm in self.mapping.items()})

    def filter(self, selection: Any) -> ChoiceMap:
        def part(name: str) -> Any:
            return selection(name) if isinstance(selection, Selection) else selection

        return Static.build({name: chm.filter(part(name)) for name, chm in self.mapping.items()})

    def paths(self) -> Iterator[tuple[Any, ...]]:
        for name, chm in self.mapping.items():
            yield from ((name, *path) for path in chm.paths())

    def static_is_empty(self) -> bool:
        return not self.mapping


@dataclass
class Indexed(ChoiceMap):
    """A map for one element, `index` a scalar; or for several, `index` (k,) and every value (k, ...)."""

    inner: ChoiceMap
    index: Any

    def get_inner_map(self, component: Any) -> ChoiceMap:
        if isinstance(component, str):
            return Static({})
        if isinstance(component, slice):
            raise ValueError(f"The choice map has values at index {self.index} only; it cannot be sliced")
        if jnp.ndim(self.index) == 0:
            same = self.index == component
            return self.inner.filter(bool(same) if is_concrete(same) else same)
        hits = self.index == component
        first = jnp.argmax(hits)
        return _index(self.inner, first).filter(hits[first])  # type: ignore[no-any-return]

    def filter(self, selection: Any) -> ChoiceMap:
        return self.inner.filter(selection).extend(self.index)

    def paths(self) -> Iterator[tuple[Any, ...]]:
        yield from ((self.index, *path) for path in self.inner.paths())


@dataclass
class Or(ChoiceMap):
    """Both maps, the left one first: what `|` gives when it cannot be worked out at once."""

    left: ChoiceMap
    right: ChoiceMap

    def get_inner_map(self, component: Any) -> ChoiceMap:
        return self.left.get_inner_map(component) | self.right.get_inner_map(component)

    def filter(self, selection: Any) -> ChoiceMap:
        return self.left.filter(selection) | self.right.filter(selection)

    def paths(self) -> Iterator[tuple[Any, ...]]:
        yield from self.left.paths()
        yield from self.right.paths()


@dataclass
class Switch(ChoiceMap):
    """The map numbered by the integer array `index`, the others masked out."""

    index: Any
    maps: tuple[ChoiceMap, ...]

    def branches(self) -> list[ChoiceMap]:
        """The maps, each masked by whether it is the chosen one."""
        return [chm.filter(self.index == k) for k, chm in enumerate(self.maps)]

    def get_value(self) -> Any:
        values = [chm.get_value() for chm in self.branches()]
        present = [Mask.build(v) for v in values if v is not None]
        return reduce(lambda a, b: a | b, present) if present else None

    def get_inner_map(self, component: Any) -> ChoiceMap:
        index = self.index if isinstance(component, str) or jnp.ndim(self.index) == 0 else self.index[component]
        maps = tuple(chm.get_inner_map(component) for chm in self.maps)
        return Static({}) if all(chm.static_is_empty() for chm in maps) else Switch(index, maps)

    def filter(self, selection: Any) -> ChoiceMap:
        return Switch(self.index, tuple(chm.filter(selection) for chm in self.maps))

    def paths(self) -> Iterator[tuple[Any, ...]]:
        yield from dict.fromkeys(path for chm in self.maps for path in chm.paths())

    def static_is_empty(self) -> bool:
        return all(chm.static_is_empty() for chm in self.maps)


def merge(left: ChoiceMap, right: ChoiceMap) -> ChoiceMap:
    """Everything in either map, the left one's value where both have one.

    Raises:
        ValueError: one has a value where the other has names below.
    """
    if left.static_is_empty() or right.static_is_empty():
        return right if left.static_is_empty() else left
    match left, right:
        case Static(a), Static(b):
            both = {k: merge(a[k], b[k]) if k in a and k in b else a.get(k, b.get(k)) for k in [*a, *b]}
            return Static.build(both)  # type: ignore[arg-type]
        case Choice(Mask() as a), Choice(b):
            combined = a | Mask.build(b)
            return Choice(combined if isinstance(b, Mask) else combined.value)
        case Choice(), Choice() | Indexed():
            return left
        case Indexed(), Choice(value) if not isinstance(value, Mask):
            return Choice(overlay(left, jnp.asarray(value)))
        case (Choice(), Static()) | (Static(), Choice()):
            names = next(path for chm in (left, right) for path in chm.paths() if path)
            raise ValueError(f"One choice map has a bare value where the other has a choice {show(names)}")
    return Or(left, right)


def overlay(chm: ChoiceMap, array: Any) -> Any:
    """`array` with the elements that `chm` has indices for replaced."""
    match chm:
        case Indexed(inner, index):
            return array.at[index].set(overlay(inner, array[index]))
        case Choice(Mask(value, flag)):
            return where(flag, value, array)
        case Choice(value):
            return value
    raise ValueError(f"Names below an index cannot replace elements of an array of shape {array.shape}")
