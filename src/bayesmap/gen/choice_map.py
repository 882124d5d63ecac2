"""Choice maps: values of random choices by address, as in `C["walls"].set(w) | C["readings"].set(z)`.

An address is a name, an index, or a tuple of names and indices. A vectorised model stores its values as whole arrays:
`chm["v"]` is `chm[:, "v"]`, and `chm[0, "v"]` its first element. An index selects from the leading axis of all arrays.

A choice map is a tree of nodes of five kinds. `Choice` holds a value, `Static` submaps by name, and `Indexed` a map at
an index. `Or` holds two maps, of which the left one takes precedence, and `Branches` a map for each branch of a switch.
Each operation of `ChoiceMap` is a match over these kinds. `join` is the rule of `|`.

A flag may be an array, such as a comparison of index arrays. Then the map stores the value as a Mask.
`Builder`, at the end, makes maps.
"""

import operator
from collections.abc import Callable, Iterable, Iterator
from functools import reduce
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.errors import ChoiceMapNoValueAtAddress, ShapeMismatch, format_address
from bayesmap.gen.masks import Mask, overlay, same_index, where_leaves
from bayesmap.gen.outline import Outlined, leaf_text
from bayesmap.gen.pytree import Pytree, dataclass
from bayesmap.gen.selection import Selection


def as_path(address: Any) -> tuple[Any, ...]:
    """Return an address as a tuple."""
    return address if isinstance(address, tuple) else (address,)


class ChoiceMap(Outlined, Pytree):
    """Base of choice maps, made by the `Builder` that users import as `C`. Its subclasses are the kinds of nodes."""

    def get_value(self) -> Any:
        """Return the value at the empty address, or None. It is a Mask if its presence is decided at run time."""
        match self:
            case Choice(value):
                return value
            case Branches(_, maps):
                masks = [Mask.build(value) for chm in maps if (value := chm.get_value()) is not None]
                return Mask.or_n(*masks) if masks else None
            case Or(left, right):
                first, second = left.get_value(), right.get_value()
                # A map with elements only at indices has no value here, so a union with it has none either.
                return None if first is None or second is None else _first_present(first, second)
        return None

    def get_inner_map(self, component: Any) -> "ChoiceMap":
        """Return the submap one address component down."""
        by_name = isinstance(component, str)
        match self:
            case Static(mapping) if by_name:
                return mapping.get(component, Static({}))
            case Static(mapping):
                return Static({name: chm.get_inner_map(component) for name, chm in mapping.items()})
            case Choice(value) if not by_name:
                return Choice(_elements(value, component))
            case Indexed(chm, index) if not by_name:
                return _element_at(chm, index, component)
            case Or(left, right):
                return left.get_inner_map(component) | right.get_inner_map(component)
            case Branches(idx, maps):
                inner_maps = tuple(chm.get_inner_map(component) for chm in maps)
                inner_idx = idx if by_name or jnp.ndim(idx) == 0 else idx[component]
                return Static({}) if all(m.static_is_empty() for m in inner_maps) else Branches(inner_idx, inner_maps)
        return Static({})

    def filter(self, selection_or_flag: Any) -> "ChoiceMap":
        """Return the part whose addresses are selected. A flag selects everything or nothing."""
        by_address = isinstance(selection_or_flag, Selection)
        match self:
            case Choice() if by_address:
                return self if selection_or_flag.check() else Static({})
            case Choice(value):
                return ChoiceMap.choice(Mask.build(value, selection_or_flag))
            case Static(mapping):
                selections = {name: selection_or_flag(name) if by_address else selection_or_flag for name in mapping}
                return Static.build({name: chm.filter(selections[name]) for name, chm in mapping.items()})
            case Indexed(chm, index):
                return chm.filter(selection_or_flag).extend(index)
            case Or(left, right):
                return left.filter(selection_or_flag) | right.filter(selection_or_flag)
            case Branches(idx, maps):
                return Branches(idx, tuple(chm.filter(selection_or_flag) for chm in maps))
        raise TypeError(f"{type(self).__name__} is no choice map")

    def paths(self) -> Iterator[tuple[Any, ...]]:
        """Yield the address of every value, without the indices of the elements of arrays."""
        match self:
            case Choice():
                yield ()
            case Static(mapping):
                yield from ((name, *path) for name, chm in mapping.items() for path in chm.paths())
            case Indexed(chm, index):
                yield from ((index, *path) for path in chm.paths())
            case Or(left, right):
                yield from (path for chm in (left, right) for path in chm.paths())
            case Branches(_, maps):
                yield from dict.fromkeys(path for chm in maps for path in chm.paths())

    def static_is_empty(self) -> bool:
        """Return whether the map is known to be empty for all values of its arrays."""
        match self:
            case Static(mapping):
                return not mapping
            case Branches(_, maps):
                return all(chm.static_is_empty() for chm in maps)
        return False

    def outline(self, label: str = "") -> list[str]:
        """Return the map as lines, one choice per line. The first begins with `label`."""
        match self:
            case Choice(value):
                return [f"{label or '()'}: {leaf_text(value)}"]
            case Static(mapping):
                lines = [line for name, chm in mapping.items() for line in chm.outline(repr(name))] or ["(empty)"]
                if not label:
                    return lines
                return [f"{label}:", *("  " + line for line in lines)] if mapping else [f"{label}: (empty)"]
            case Indexed(chm, index):
                return chm.outline(f"{label}[{leaf_text(index)}]")
            case Or(left, right):
                return [*left.outline(label), *right.outline(label)]
            case Branches(idx, maps):
                lines = ["  " + line for k, chm in enumerate(maps) for line in chm.outline(f"[{k}]")]
                return [f"{label or 'switch'}: branch {leaf_text(idx)} of", *lines]
        raise TypeError(f"{type(self).__name__} is no choice map")

    def get_submap(self, *addresses: Any) -> "ChoiceMap":
        """Return the submap at an address. It is empty if there is none."""
        path = [c for address in addresses for c in as_path(address)]
        return reduce(lambda chm, component: chm.get_inner_map(component), path, self)

    __call__ = get_submap

    def __getitem__(self, address: Any) -> Any:
        """Return the value at an address. Raises ChoiceMapNoValueAtAddress if there is none."""
        value = self.get_submap(address).get_value()
        if value is None:
            raise ChoiceMapNoValueAtAddress(address)
        return value

    def __contains__(self, address: Any) -> bool:
        """Return whether there is a value at an address."""
        return self.get_submap(address).has_value()

    def has_value(self) -> bool:
        """Return whether there is a value at the empty address."""
        return self.get_value() is not None

    def get_selection(self) -> Selection:
        """Return the selection of exactly the addresses that hold a value."""
        selection = Selection.none()
        for path in self.paths():
            names = [component for component in path if isinstance(component, str)]
            selection = selection | Selection.leaf().extend(*names)
        return selection

    def invalid_subset(self, gen_fn: Any, args: tuple[Any, ...]) -> "ChoiceMap | None":
        """Return the choices of this map that `gen_fn` never makes on `args`; None if there are none."""
        invalid = self.filter(~gen_fn.choice_shapes(args).get_selection())
        return None if invalid.static_is_empty() else invalid

    def simplify(self) -> "ChoiceMap":
        """Return this map: filters are applied immediately, so there is nothing to simplify."""
        return self

    def __or__(self, other: "ChoiceMap") -> "ChoiceMap":
        """Return everything in either map. If both have a value at an address, this map's value is returned."""
        return join(self, other)

    # GenJAX spells the union of maps in four ways. Here `^` does not check that the maps are disjoint.
    __add__ = __xor__ = merge = __or__

    def __and__(self, other: "ChoiceMap") -> "ChoiceMap":
        """Return the values of `other` at the addresses of this map."""
        return other.filter(self.get_selection())

    def mask(self, flag: Any) -> "ChoiceMap":
        """Return the choices if `flag` is True, and no choices otherwise."""
        return self.filter(flag)

    def extend(self, *address: Any) -> "ChoiceMap":
        """Return this map moved below `address`: names, indices, `:`, and at most one array of indices."""
        chm = self
        for component in reversed(address):
            if isinstance(component, str):
                chm = Static.build({component: chm})
            elif not isinstance(component, slice):
                chm = chm if chm.static_is_empty() else Indexed.build(chm, component)
            elif component != slice(None):
                raise ValueError(f"Only the full slice `:` can stand in an address, not {component}")
        return chm

    @property
    def at(self) -> "Builder":
        """Builder from this map: `chm.at["x"].set(v)` is this map with the value at "x" replaced."""
        return Builder(self, ())

    @staticmethod
    def empty() -> "ChoiceMap":
        """Return the map without choices."""
        return Static({})

    @staticmethod
    def choice(value: Any) -> "ChoiceMap":
        """Return the map of a bare value. It is empty for an array without elements, or a Mask known to be False."""
        if isinstance(value, Mask):
            value = value.flatten()
        return Static({}) if value is None or 0 in getattr(value, "shape", ()) else Choice(value)

    value = choice  # GenJAX's other name

    @staticmethod
    def entry(value: Any, *address: Any) -> "ChoiceMap":
        """Return the map of a value, dict or map at an address."""
        if not isinstance(value, ChoiceMap):
            value = ChoiceMap.d(value) if isinstance(value, dict) else ChoiceMap.choice(value)
        return value.extend(*address)  # type: ignore[no-any-return]

    @staticmethod
    def from_mapping(pairs: Iterable[tuple[Any, Any]]) -> "ChoiceMap":
        """Return the map of (address, value) pairs."""
        entries = (ChoiceMap.entry(value, *as_path(address)) for address, value in pairs)
        return reduce(operator.or_, entries, ChoiceMap.empty())

    @staticmethod
    def d(mapping: dict[Any, Any]) -> "ChoiceMap":
        """Return the map of a dict; dicts may be nested."""
        return ChoiceMap.from_mapping(mapping.items())

    @staticmethod
    def kw(**values: Any) -> "ChoiceMap":
        """Return the map of keyword arguments."""
        return ChoiceMap.d(values)

    @staticmethod
    def switch(idx: Any, chms: Iterable["ChoiceMap"]) -> "ChoiceMap":
        """Return map number `idx`. For an index array, return all maps, masked."""
        chms = list(chms)
        if isinstance(idx, int):
            return chms[idx]
        return Branches(idx, tuple(chm.mask(idx == k) for k, chm in enumerate(chms)))


@dataclass
class Choice(ChoiceMap):
    """A node with a bare value `v`: an array, or a Mask of an array."""

    v: Any  # GenJAX's name: `value` is the static method above


@dataclass
class Static(ChoiceMap):
    """A node with submaps by name."""

    mapping: dict[str, ChoiceMap]

    @staticmethod
    def build(mapping: dict[str, ChoiceMap]) -> "Static":
        """Return the map without its empty submaps."""
        return Static({name: chm for name, chm in mapping.items() if not chm.static_is_empty()})


@dataclass
class Indexed(ChoiceMap):
    """A node with the map `chm` at `index`: an int, a scalar, or an array (k,) with values (k, ...)."""

    chm: ChoiceMap
    index: Any

    @staticmethod
    def build(chm: ChoiceMap, index: Any) -> ChoiceMap:
        """Return `chm` at `index`. Raises ValueError if `chm` and `index` both have an array of indices."""
        inner_indices = [part for path in chm.paths() for part in path if not isinstance(part, str)]
        if jnp.ndim(index) > 0 and any(jnp.ndim(inner) > 0 for inner in inner_indices):
            raise ValueError("An address can hold one array of indices, and single indices before it")
        return Indexed(chm, index)


@dataclass
class Or(ChoiceMap):
    """A node with two maps that `|` cannot join immediately. The left map takes precedence."""

    left: ChoiceMap
    right: ChoiceMap


@dataclass
class Branches(ChoiceMap):
    """A node with the maps of a switch's branches. Map number k is masked by `idx == k`."""

    idx: Any  # number of the branch that ran, an integer array
    chms: tuple[ChoiceMap, ...]  # GenJAX's name


def _elements(tree: Any, index: Any) -> Any:
    """Return `leaf[index]` of each leaf, where a Mask is one leaf."""
    return jax.tree.map(lambda leaf: leaf[index], tree, is_leaf=lambda leaf: isinstance(leaf, Mask))


def _element_at(chm: ChoiceMap, indices: Any, index: Any) -> ChoiceMap:
    """Return the element `index` of the map `chm` at `indices`, masked by False if `indices` lack this element."""
    if isinstance(index, slice):
        raise ValueError(f"A slice cannot select from choices at the indices {indices}; give an index")
    is_here = same_index(indices, index)
    if jnp.ndim(indices) == 0:
        return chm.filter(is_here)
    first = jnp.argmax(is_here)
    return _elements(chm, first).filter(jnp.asarray(is_here)[first])  # type: ignore[no-any-return]


def _first_present(first: Any, second: Any) -> Any:
    """Return `first` where it is present, and `second` elsewhere. Values without a flag are present."""
    if not isinstance(first, Mask):
        return first
    combined = overlay(first, Mask.build(second))
    return combined if isinstance(second, Mask) else combined.value


def join(left: ChoiceMap, right: ChoiceMap) -> ChoiceMap:
    """Return everything in either map. If both have a value at an address, the left map's value is returned."""
    if left.static_is_empty() or right.static_is_empty():
        return right if left.static_is_empty() else left
    match left, right:
        # Submaps by name: join submaps of the same name.
        case Static(left_maps), Static(right_maps):
            joined = dict(left_maps)
            for name, submap in right_maps.items():
                joined[name] = join(left_maps[name], submap) if name in left_maps else submap
            return Static.build(joined)
        case Choice(first), Choice(second):
            return Choice(_first_present(first, second))
        # A value without a flag covers all elements on the right.
        case Choice(value), Indexed() if not isinstance(value, Mask):
            return left
        # mask | elements | value: replace the value's elements first, then lay the mask over the result.
        case Or(Choice() as mask, Indexed() as elements), Choice():
            return join(mask, join(elements, right))
        # Elements over an array: replace the array's elements.
        case Indexed(), Choice(value) if not isinstance(value, Mask):
            return Choice(overwrite(left, jnp.asarray(value)))
        # A switch by a scalar: join the other map to each branch, masked as the branch is.
        case (Branches(idx, maps), other) if jnp.ndim(idx) == 0 and not isinstance(other, Branches):
            return Branches(idx, tuple(chm | other.mask(idx == k) for k, chm in enumerate(maps)))
        case (other, Branches(idx, maps)) if jnp.ndim(idx) == 0 and not isinstance(other, Branches):
            return Branches(idx, tuple(other.mask(idx == k) | chm for k, chm in enumerate(maps)))
        # A bare value and names cannot share an address.
        case (Choice(), Static()) | (Static(), Choice()):
            names = format_address(next(path for chm in (left, right) for path in chm.paths() if path))
            raise ValueError(f"Choice and non-Choice in Or: one has a bare value where the other has a choice {names}")
    # Any other pair is joined when it is read.
    return Or(left, right)


def overwrite(chm: ChoiceMap, array: Any) -> Any:
    """Return `array` with the elements at the indices of `chm` replaced."""
    match chm:
        case Indexed(inner, index):
            return array.at[index].set(overwrite(inner, array[index]))
        case Choice(Mask(value, flag)):
            return where_leaves(flag, value, array)
        case Choice(value):
            return value
    raise ValueError(f"Names below an index cannot replace elements of an array of shape {array.shape}")


class Builder:
    """Builder of choice maps: `C["x", 0].set(v)`, `C.v(value)`, `C.d({...})`, `C.kw(...)` and `C.n()`."""

    def __init__(self, base: ChoiceMap | None, address: tuple[Any, ...]) -> None:
        self._base = base  # the map to change; None for the empty map
        self._address = address  # the address at which a value is set

    def __getitem__(self, address: Any) -> "Builder":
        return Builder(self._base, (*self._address, *as_path(address)))

    def set(self, value: Any) -> ChoiceMap:
        """Return the base map with `value` at the address. `value` is a value, a dict or a map."""
        new = ChoiceMap.entry(value, *self._address)
        if self._base is None:
            return new
        old_value = self._base.get_submap(self._address).get_value()
        new_value = new.get_submap(self._address).get_value()
        if old_value is not None and new_value is not None and jnp.shape(old_value) != jnp.shape(new_value):
            raise ShapeMismatch(self._address, f"found {jnp.shape(new_value)}, expected {jnp.shape(old_value)}")
        return new | self._base

    def update(self, f: Callable[[Any], Any]) -> ChoiceMap:
        """Return the base map with `f` applied to the value or the submap at the address."""
        submap = (ChoiceMap.empty() if self._base is None else self._base).get_submap(self._address)
        return self.set(f(submap.get_value() if submap.has_value() else submap))

    def v(self, value: Any) -> ChoiceMap:
        """Return the base map with the bare value at the address; a dict counts as a value."""
        return self.set(ChoiceMap.choice(value))

    def n(self) -> ChoiceMap:
        """Return the empty map."""
        return ChoiceMap.empty()

    def d(self, mapping: dict[Any, Any]) -> ChoiceMap:
        """Return the base map with `ChoiceMap.d(mapping)` at the address."""
        return self.set(ChoiceMap.d(mapping))

    def kw(self, **values: Any) -> ChoiceMap:
        """Return the base map with `ChoiceMap.kw(**values)` at the address."""
        return self.set(ChoiceMap.kw(**values))

    def from_mapping(self, pairs: Iterable[tuple[Any, Any]]) -> ChoiceMap:
        """Return the base map with `ChoiceMap.from_mapping(pairs)` at the address."""
        return self.set(ChoiceMap.from_mapping(pairs))

    def switch(self, idx: Any, chms: Iterable[ChoiceMap]) -> ChoiceMap:
        """Return the base map with `ChoiceMap.switch(idx, chms)` at the address."""
        return self.set(ChoiceMap.switch(idx, chms))


ChoiceMapBuilder = Builder(None, ())
ChoiceMap.builder = ChoiceMapBuilder  # type: ignore[attr-defined]
