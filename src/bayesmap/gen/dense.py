"""Choice maps of indices as arrays: what a vectorised model reads its constraints from."""

from functools import reduce
from typing import Any

import jax.numpy as jnp

from bayesmap.gen.choice_map import Choice, ChoiceMap, Indexed, Or, Static, Switch
from bayesmap.gen.errors import ShapeMismatch, UnknownAddress
from bayesmap.gen.flags import is_concrete
from bayesmap.gen.mask import Mask, overlay


def dense(chm: ChoiceMap, shape: tuple[int, ...]) -> tuple[Any, Any] | None:
    """A map without names as one array, with a flag for every element that it gives.

    Args:
        chm: values, perhaps at indices.
        shape: the leading axes that indices may select from.

    Returns:
        (array of shape `shape + ...`, flag of shape `shape` or None for "all"), or None for an empty map.

    Raises:
        ShapeMismatch: an array is too long or too short.
        UnknownAddress: there is a name in the map, or an index out of range.
    """
    if chm.static_is_empty():
        return None
    match chm:
        case Choice(Mask(value, flag)):
            _check_leading(value, shape)
            flag = jnp.reshape(flag, jnp.shape(flag) + (1,) * (len(shape) - jnp.ndim(flag)))
            return value, jnp.broadcast_to(flag, shape)
        case Choice(value):
            _check_leading(value, shape)
            return value, None
        case Indexed(inner, index) if shape:
            index = check_index(index, shape[0])
            value, given = dense(inner, jnp.shape(index) + shape[1:]) or (None, None)
            present = True if given is None else given
            return _put(value, index, shape[0]), jnp.zeros(shape, bool).at[index].set(present)
        case Or() | Switch():
            parts = (chm.c1, chm.c2) if isinstance(chm, Or) else chm.chms
            found = [Mask(v, True if f is None else f) for v, f in filter(None, (dense(p, shape) for p in parts))]
            joined = reduce(overlay, found)
            return joined.value, jnp.broadcast_to(joined.flag, shape)
    raise UnknownAddress(next(chm.paths()), "the model has a bare value or an array there")


def vectorise(chm: ChoiceMap, n: int) -> ChoiceMap:
    """The same map with a leading axis of length `n` on every leaf, ready to be mapped over.

    Raises:
        ShapeMismatch: an array's leading axis is not `n`.
        UnknownAddress: an index is out of range.
    """
    match chm:
        case Choice(Mask(value, flag)):
            _check_leading(value, (n,))
            return Choice(Mask(value, jnp.broadcast_to(flag, (n,)) if jnp.ndim(flag) == 0 else flag))
        case Choice(value):
            _check_leading(value, (n,))
            return chm
        case Static(mapping):
            parts = {}
            for name, sub in mapping.items():
                try:
                    parts[name] = vectorise(sub, n)
                except (ShapeMismatch, UnknownAddress) as error:
                    raise error.under((name,)) from None
            return Static(parts)
        case Indexed(inner, index):
            return _spread(inner, check_index(index, n), n)
        case Or(left, right):
            return vectorise(left, n) | vectorise(right, n)
        case Switch(index, maps):
            return Switch(jnp.broadcast_to(index, (n,)), tuple(vectorise(m, n) for m in maps))
    raise TypeError(f"{type(chm).__name__} is no choice map")


def _spread(chm: ChoiceMap, index: Any, n: int) -> ChoiceMap:
    """`chm` at `index` of a leading axis of length `n`, masked out elsewhere."""
    match chm:
        case Choice(Mask(value, flag)):
            flag = jnp.broadcast_to(flag, jnp.shape(index)) if jnp.ndim(flag) < jnp.ndim(index) else flag
            return Choice(Mask(_put(value, index, n), _put(flag, index, n)))
        case Choice(value):
            return Choice(Mask(_put(value, index, n), jnp.zeros(n, bool).at[index].set(True)))
        case Static(mapping):
            return Static({name: _spread(sub, index, n) for name, sub in mapping.items()})
        case Indexed(inner, below):
            return Indexed(_spread(inner, index, n), _put(below, index, n))
        case Or(left, right):
            return _spread(left, index, n) | _spread(right, index, n)
        case Switch(branch, maps):
            return Switch(_put(branch, index, n), tuple(_spread(m, index, n) for m in maps))
    raise TypeError(f"{type(chm).__name__} is no choice map")


def _put(value: Any, index: Any, n: int) -> Any:
    """Zeros with a leading axis of length `n`, and `value` at `index`."""
    value = jnp.asarray(value)
    return jnp.zeros((n, *value.shape[jnp.ndim(index) :]), value.dtype).at[index].set(value)


def _check_leading(value: Any, shape: tuple[int, ...]) -> None:
    found = jnp.shape(value)
    if found[: len(shape)] != shape:
        raise ShapeMismatch((), f"found {found}, expected {shape} for the leading axes")


def check_index(index: Any, n: int) -> Any:
    """The index, made non-negative if it is known.

    Raises:
        UnknownAddress: it is known to lie outside 0 .. n - 1 (or -n .. -1).
    """
    if is_concrete(index) and jnp.ndim(index) == 0:
        if not -n <= int(index) < n:
            raise UnknownAddress(int(index), f"there are {n} elements")
        return int(index) % n
    return index
