"""Axes of vectorised models: mapped arguments, constraints as arrays, sums of scores, large batches in chunks.

`vmap`, `scan` and distributions over arrays are made of these four parts, in this order: `map_over` gives each argument
its axis, `dense` and `vectorise` give a constraint leading axes, `total` adds scores, and `in_chunks` bounds memory.
"""

import math
from collections.abc import Callable
from functools import reduce
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax.custom_batching import custom_vmap
from jax.extend.core import jaxprs_in_params

from bayesmap.gen.choice_map import Branches, Choice, ChoiceMap, Indexed, Or, Static
from bayesmap.gen.errors import ShapeMismatch, UnknownAddress
from bayesmap.gen.masks import Mask, is_concrete, overlay
from bayesmap.gen.typing import InAxes


class Mapped(NamedTuple):
    """The arguments of a mapped function, as the leaves of their tree."""

    leaves: list[Any]
    axes: list[int | None]  # mapped axis of each leaf; None if all elements share the leaf
    rebuild: Callable[[list[Any]], Any]  # returns the arguments of given leaves
    n: int  # number of elements

    def element(self, i: Any) -> Any:
        """Return the arguments of element `i`."""
        pairs = zip(self.leaves, self.axes, strict=True)
        return self.rebuild([x if axis is None else jnp.take(x, i, axis=axis) for x, axis in pairs])

    def element_shapes(self) -> list[jax.ShapeDtypeStruct]:
        """Return the shapes and dtypes of one element's leaves. They are known even if n = 0."""
        shapes = []
        for x, axis in zip(self.leaves, self.axes, strict=True):
            shape = list(jnp.shape(x))
            if axis is not None:
                del shape[axis]
            shapes.append(jax.ShapeDtypeStruct(tuple(shape), jnp.result_type(x)))  # type: ignore[no-untyped-call]
        return shapes

    def vmap(self, fn: Callable[..., Any], *mapped: Any) -> Any:
        """Return `fn(*(x[i] for x in mapped), element(i))` for every i, stacked."""

        def call(leaves: list[Any], *elements: Any) -> Any:
            return fn(*elements, self.rebuild(leaves))

        in_axes = (self.axes, *(0 for _ in mapped))
        return jax.vmap(call, in_axes=in_axes, axis_size=self.n)(self.leaves, *mapped)


def map_over(in_axes: InAxes, args: tuple[Any, ...], n: int | None = None) -> Mapped:
    """Return the leaves of `args` with their mapped axes. `in_axes` is as for `jax.vmap`; None repeats `args`."""
    # Let `jax.vmap` check the axes; then give each leaf its axis. A None would vanish from the tree: write "shared".
    axes = tuple(in_axes) if isinstance(in_axes, list) else in_axes
    jax.vmap(lambda *_: 0, in_axes=axes, out_axes=None, axis_size=n)(*args)
    marked = jax.tree.map(lambda a: "shared" if a is None else a, axes, is_leaf=lambda a: a is None)
    leaf_axes = [None if a == "shared" else a for a in jax.tree.leaves(jax.tree.broadcast(marked, args))]
    leaves, treedef = jax.tree.flatten(args)
    if n is None:
        n = next(jnp.shape(x)[a] for x, a in zip(leaves, leaf_axes, strict=True) if a is not None)
    return Mapped(leaves, leaf_axes, lambda new: jax.tree.unflatten(treedef, new), n)


def check_index(index: Any, n: int) -> Any:
    """Return an index into `n` elements. A known one is made non-negative, or raises UnknownAddress if out of range."""
    if is_concrete(index) and jnp.ndim(index) == 0:
        if not -n <= int(index) < n:
            raise UnknownAddress(int(index), f"there are {n} elements")
        return int(index) % n
    return index


def dense(chm: ChoiceMap, shape: tuple[int, ...]) -> tuple[Any, Any] | None:
    """Return the values of a choice map, perhaps at indices into `shape`, as one array, and which elements have one.
    Returns (array of shape `shape + ...`, flags of shape `shape`, or None if all elements have a value); None for an
    empty map. Raises ShapeMismatch for a wrong length, and UnknownAddress for a name or an index out of range.
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
            value, inner_flags = dense(inner, jnp.shape(index) + shape[1:]) or (None, None)
            flags = jnp.zeros(shape, bool).at[index].set(True if inner_flags is None else inner_flags)
            return _put(value, index, shape[0]), flags
        case Or() | Branches():
            maps = (chm.left, chm.right) if isinstance(chm, Or) else chm.chms
            arrays = [array for array in (dense(m, shape) for m in maps) if array is not None]
            joined = reduce(overlay, [Mask(value, True if flags is None else flags) for value, flags in arrays])
            return joined.value, jnp.broadcast_to(joined.flag, shape)
    raise UnknownAddress(next(chm.paths()), "the model has a bare value or an array there")


def vectorise(chm: ChoiceMap, n: int) -> ChoiceMap:
    """Return the map with a leading axis of `n` on every leaf. Raises ShapeMismatch or UnknownAddress if it misfits."""
    match chm:
        case Choice(Mask(value, flag)):
            _check_leading(value, (n,))
            return Choice(Mask(value, jnp.broadcast_to(flag, (n,)) if jnp.ndim(flag) == 0 else flag))
        case Choice(value):
            _check_leading(value, (n,))
            return chm
        case Static(mapping):
            submaps = {}
            for name, submap in mapping.items():
                try:
                    submaps[name] = vectorise(submap, n)
                except (ShapeMismatch, UnknownAddress) as error:
                    raise error.under((name,)) from None
            return Static(submaps)
        case Indexed(inner, index):
            return _at_index(inner, check_index(index, n), n)
        case Or(left, right):
            return vectorise(left, n) | vectorise(right, n)
        case Branches(index, maps):
            return Branches(jnp.broadcast_to(index, (n,)), tuple(vectorise(m, n) for m in maps))
    raise TypeError(f"{type(chm).__name__} is no choice map")


def _at_index(chm: ChoiceMap, index: Any, n: int) -> ChoiceMap:
    """Return `chm` at `index` of a leading axis of length `n`, masked out elsewhere."""
    match chm:
        case Choice(Mask(value, flag)):
            flag = jnp.broadcast_to(flag, jnp.shape(index)) if jnp.ndim(flag) < jnp.ndim(index) else flag
            return Choice(Mask(_put(value, index, n), _put(flag, index, n)))
        case Choice(value):
            return Choice(Mask(_put(value, index, n), jnp.zeros(n, bool).at[index].set(True)))
        case Static(mapping):
            return Static({name: _at_index(submap, index, n) for name, submap in mapping.items()})
        case Indexed(inner, inner_index):
            return Indexed(_at_index(inner, index, n), _put(inner_index, index, n))
        case Or(left, right):
            return _at_index(left, index, n) | _at_index(right, index, n)
        case Branches(branch, maps):
            return Branches(_put(branch, index, n), tuple(_at_index(m, index, n) for m in maps))
    raise TypeError(f"{type(chm).__name__} is no choice map")


def _put(value: Any, index: Any, n: int) -> Any:
    """Return zeros with a leading axis of length `n`, and `value` at `index`."""
    value = jnp.asarray(value)
    return jnp.zeros((n, *value.shape[jnp.ndim(index) :]), value.dtype).at[index].set(value)


def _check_leading(value: Any, shape: tuple[int, ...]) -> None:
    """Raise ShapeMismatch unless the leading axes of `value` are `shape`."""
    if jnp.shape(value)[: len(shape)] != shape:
        raise ShapeMismatch((), f"found {jnp.shape(value)}, expected {shape} for the leading axes")


def total(scores: Any) -> Any:
    """Return the sum of an array of scores, shape ()."""
    # Without the barrier XLA merges this sum with the sums inside the scores into one loop, which loses a digit.
    return jnp.sum(jax.lax.optimization_barrier(scores))  # type: ignore[no-untyped-call]


def replace_term(old_sum: Any, old: Any, new: Any, recompute: Callable[[], Any]) -> Any:
    """Return a sum after its term `old` became `new`, in time that does not grow with the number of terms.
    After k changes, rounding errors are sqrt(k) units in the last place. `recompute` adds up a sum that is not finite.
    """
    new_sum = old_sum + (new - old)
    if is_concrete(new_sum):  # outside jit, a cond of fresh closures would be compiled at every edit
        return new_sum if bool(jnp.isfinite(new_sum)) else recompute()
    return jax.lax.cond(jnp.isfinite(new_sum), lambda: new_sum, recompute)


CACHE_BYTES = 1 << 20  # largest intermediate array of a chunk on a CPU
DEVICE_BYTES = 1 << 28  # largest intermediate array of a chunk on an accelerator


def in_chunks(fn: Callable[..., Any], *args: Any) -> Any:
    """Return `fn(*args)`. Under `jax.vmap` elements run in chunks, so that intermediate arrays fit the cache."""
    # Only traced leaves can be mapped over. Without any, there is no batch.
    leaves, treedef = jax.tree.flatten(args)
    traced = [k for k, x in enumerate(leaves) if isinstance(x, jax.core.Tracer)]
    if not traced:
        return fn(*args)

    def of_traced(*values: Any) -> Any:
        # Values that are not traced stay concrete, so that errors can be raised while tracing.
        filled = dict(zip(traced, values, strict=True))
        return fn(*jax.tree.unflatten(treedef, [filled.get(k, x) for k, x in enumerate(leaves)]))

    chunked = custom_vmap(of_traced)

    @chunked.def_vmap
    def run_batch(axis_size: int, is_batched: list[bool], *values: Any) -> Any:
        batched = [v for v, b in zip(values, is_batched, strict=True) if b]

        def of_element(element: list[Any]) -> Any:
            leaf = iter(element)
            return of_traced(*(next(leaf) if b else v for v, b in zip(values, is_batched, strict=True)))

        # Choose the chunk so that its largest array fits.
        largest_bytes = _largest_array_bytes(jax.make_jaxpr(of_element)([v[0] for v in batched]).jaxpr)
        chunk = (CACHE_BYTES if jax.default_backend() == "cpu" else DEVICE_BYTES) // largest_bytes
        if chunk >= axis_size:
            out = jax.vmap(of_element)(batched)
        else:
            # Prefer a chunk that divides the batch: a remainder would copy all results again.
            chunk = next((size for size in range(chunk, max(1, chunk // 4), -1) if axis_size % size == 0), chunk)
            out = jax.lax.map(of_element, batched, batch_size=chunk if chunk > 1 else None)
        return out, jax.tree.map(lambda _: True, out)

    # Derivatives are those of the function itself: custom_vmap has no reverse mode.
    differentiable = jax.custom_jvp(chunked)
    differentiable.defjvp(lambda primals, tangents: jax.jvp(of_traced, primals, tangents))
    return differentiable(*(leaves[k] for k in traced))


def _largest_array_bytes(jaxpr: Any) -> int:
    """Return the bytes of the largest array that a jaxpr computes."""
    sizes = [1]
    for eqn in jaxpr.eqns:
        sizes += [math.prod(v.aval.shape) * v.aval.dtype.itemsize for v in eqn.outvars if hasattr(v.aval, "shape")]
        sizes += [_largest_array_bytes(inner) for inner in jaxprs_in_params(eqn.params)]
    return max(sizes)
