"""Which axis of which argument a vectorised model maps over, in `jax.vmap`'s notation."""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from bayesmap.gen.flags import is_concrete
from bayesmap.gen.typing import InAxes


class Mapped(NamedTuple):
    """Arguments as leaves, each with its mapped axis (None: shared by all elements)."""

    leaves: list[Any]
    axes: list[int | None]
    rebuild: Callable[[list[Any]], Any]
    n: int

    def element(self, i: Any) -> Any:
        """The arguments of the element `i`."""
        pairs = zip(self.leaves, self.axes, strict=True)
        return self.rebuild([x if axis is None else jnp.take(x, i, axis=axis) for x, axis in pairs])

    def element_shapes(self) -> list[jax.ShapeDtypeStruct]:
        """Shapes and dtypes of an element's leaves, also where there is no element."""

        def one(x: Any, axis: int | None) -> jax.ShapeDtypeStruct:
            shape = list(jnp.shape(x))
            if axis is not None:
                del shape[axis]
            return jax.ShapeDtypeStruct(tuple(shape), jnp.result_type(x))  # type: ignore[no-untyped-call]

        return [one(x, axis) for x, axis in zip(self.leaves, self.axes, strict=True)]

    def vmap(self, fn: Callable[..., Any], *mapped: Any) -> Any:
        """`fn(*(x[i] for x in mapped), element(i))` for every i, stacked."""

        def call(leaves: list[Any], *rest: Any) -> Any:
            return fn(*rest, self.rebuild(leaves))

        in_axes = (self.axes, *(0 for _ in mapped))
        return jax.vmap(call, in_axes=in_axes, axis_size=self.n)(self.leaves, *mapped)


def map_over(in_axes: InAxes, args: tuple[Any, ...], n: int | None = None) -> Mapped:
    """Match `in_axes` to `args`.

    Args:
        in_axes: as for `jax.vmap`; None with `n` repeats the same arguments.
        args: the arguments.
        n: the number of elements where no argument says it.

    Raises:
        ValueError, TypeError: what `jax.vmap` raises for axes that do not fit.
    """
    axes = tuple(in_axes) if isinstance(in_axes, list) else in_axes
    jax.vmap(lambda *_: 0, in_axes=axes, out_axes=None, axis_size=n)(*args)
    marked = jax.tree.map(lambda a: "shared" if a is None else a, axes, is_leaf=lambda a: a is None)
    spread = [None if a == "shared" else a for a in jax.tree.leaves(jax.tree.broadcast(marked, args))]
    leaves, treedef = jax.tree.flatten(args)
    if n is None:
        n = next(jnp.shape(x)[a] for x, a in zip(leaves, spread, strict=True) if a is not None)
    return Mapped(leaves, spread, lambda new: jax.tree.unflatten(treedef, new), n)


def total(scores: Any) -> Any:
    """The sum of an array of scores, shape ().

    The barrier keeps XLA from merging it with the sums that made the scores into one long loop, which
    loses a digit: with it, compiled and uncompiled scores agree.
    """
    return jnp.sum(jax.lax.optimization_barrier(scores))  # type: ignore[no-untyped-call]


def replace_term(sum_: Any, old: Any, new: Any, afresh: Callable[[], Any]) -> Any:
    """The sum after one of its terms changed, in time that does not grow with their number.

    Rounding errors add up, to about sqrt(k) units in the last place after k changes. A sum that is not
    finite is taken afresh.
    """
    moved = sum_ + (new - old)
    if is_concrete(moved):  # outside jit, a cond of fresh closures would be compiled at every edit
        return moved if bool(jnp.isfinite(moved)) else afresh()
    return jax.lax.cond(jnp.isfinite(moved), lambda: moved, afresh)
