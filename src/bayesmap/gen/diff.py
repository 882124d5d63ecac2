"""Values with a mark of their change since a trace was made, and how functions pass these marks on.

`edit` takes its arguments as a tree of `Diff` leaves, and returns its return value as such a tree. The marks allow
`edit` to recompute only what may have changed. `dataflow` reads off a function how it passes marks on.
"""

import dataclasses
from collections.abc import Callable, Sequence
from typing import Any

import jax
from jax.extend.core import Literal

from bayesmap.gen.pytree import Pytree, dataclass


class Change(Pytree):
    """Base of the marks of a change."""


@dataclass
class _NoChange(Change):
    """The mark of a value that is the old one."""


@dataclass
class _UnknownChange(Change):
    """The mark of a value that may differ everywhere."""


@dataclass
class IndexChange(Change):
    """The mark of an array that differs in the elements `value[index]` at most, for ints or integer arrays."""

    index: tuple[Any, ...]


NoChange = _NoChange()
UnknownChange = _UnknownChange()


@dataclass
class Diff(Pytree):
    """A new leaf value, `primal`, and the mark of its change, `tangent`."""

    primal: Any
    tangent: Change

    def get_primal(self) -> Any:
        """Return the value."""
        return self.primal

    def get_tangent(self) -> Change:
        """Return the mark of the value's change."""
        return self.tangent

    @staticmethod
    def tree_diff(value: Any, tangents: Any) -> Any:
        """Return `value` with each leaf marked by the leaf of `tangents` in the same place."""
        return jax.tree.map(Diff, value, tangents)

    @staticmethod
    def tree_tangent(value: Any) -> Any:
        """Return the tree of marks; an unmarked leaf counts as unchanged."""
        return jax.tree.map(lambda leaf: leaf.tangent if Diff.is_diff(leaf) else NoChange, value, is_leaf=Diff.is_diff)

    @staticmethod
    def is_diff(value: Any) -> bool:
        """Return whether `value` is a `Diff`."""
        return isinstance(value, Diff)

    @staticmethod
    def is_change_tangent(value: Any) -> bool:
        """Return whether `value` is a mark."""
        return isinstance(value, Change)

    @staticmethod
    def static_check_tree_diff(value: Any) -> bool:
        """Return whether every leaf is marked."""
        return all(Diff.is_diff(leaf) for leaf in jax.tree.leaves(value, is_leaf=Diff.is_diff))

    @staticmethod
    def tree(value: Any, tangent: Change) -> Any:
        """Return `value` with every leaf marked by `tangent`, which replaces earlier marks."""
        return jax.tree.map(lambda leaf: Diff(leaf, tangent), Diff.tree_primal(value))

    @staticmethod
    def no_change(value: Any) -> Any:
        """Return `value` with every leaf marked unchanged."""
        return Diff.tree(value, NoChange)

    @staticmethod
    def unknown_change(value: Any) -> Any:
        """Return `value` with every leaf marked as changed in an unknown way."""
        return Diff.tree(value, UnknownChange)

    @staticmethod
    def tree_primal(value: Any) -> Any:
        """Return `value` without its marks."""
        return jax.tree.map(lambda leaf: leaf.primal if Diff.is_diff(leaf) else leaf, value, is_leaf=Diff.is_diff)

    @staticmethod
    def tangents(value: Any) -> list[Change]:
        """Return the marks of the leaves in order; an unmarked leaf counts as changed."""
        leaves = jax.tree.leaves(value, is_leaf=Diff.is_diff)
        return [leaf.tangent if Diff.is_diff(leaf) else UnknownChange for leaf in leaves]

    @staticmethod
    def zip(value: Any, tangents: Sequence[Change]) -> Any:
        """Return the plain tree `value` with its leaves marked by `tangents`, in order."""
        leaves, treedef = jax.tree.flatten(value)
        return jax.tree.unflatten(treedef, [Diff(leaf, t) for leaf, t in zip(leaves, tangents, strict=True)])

    @staticmethod
    def static_check_no_change(value: Any) -> bool:
        """Return whether every leaf is marked unchanged."""
        return all(isinstance(t, _NoChange) for t in Diff.tangents(value))


# JAX primitives for which element i of the result depends on element i of the operands alone.
_ELEMENTWISE = frozenset(
    "abs add and ceil convert_element_type copy copy_p div eq exp floor ge gt integer_pow le log logistic lt "  # noqa: SIM905
    "max min mul ne neg not or round select_n sign sqrt sub tanh xor".split()
)


@dataclasses.dataclass(frozen=True)
class Origin:
    """The inputs of a function that a value depends on, and those of which it is an elementwise image, by number."""

    inputs: frozenset[int] = frozenset()
    images: frozenset[int] = frozenset()

    def change(self, tangents: Sequence[Change]) -> Change:
        """Return the mark of the value, given the marks of all inputs."""
        changed = [k for k in self.inputs if tangents[k] != NoChange]
        if not changed:
            return NoChange
        # A change of some elements passes on if only one input changed, and the value is its elementwise image.
        first = tangents[changed[0]]
        is_indexed = len(changed) == 1 and changed[0] in self.images and isinstance(first, IndexChange)
        return first if is_indexed else UnknownChange


def dataflow(fn: Callable[..., Any], *inputs: Any) -> list[Origin] | None:
    """Return the origin of each output leaf of `fn`, read off its jaxpr; None if `fn` needs the inputs' values."""
    try:
        jaxpr = jax.make_jaxpr(fn)(*inputs).jaxpr
    except TypeError:  # raised by JAX when Python needs the value of a tracer
        return None
    origins = {v: Origin(frozenset([k]), frozenset([k])) for k, v in enumerate(jaxpr.invars)}

    def origin(atom: Any) -> Origin:
        return Origin() if isinstance(atom, Literal) else origins.get(atom, Origin())

    for eqn in jaxpr.eqns:
        # An operand of another shape is broadcast: the result is no elementwise image of it.
        shape = getattr(eqn.outvars[0].aval, "shape", None) if eqn.outvars else None
        operands = [(origin(v), getattr(v.aval, "shape", None) == shape) for v in eqn.invars]
        sources = frozenset[int]().union(*(o.inputs for o, _ in operands))
        images = frozenset[int]()
        if eqn.primitive.name in _ELEMENTWISE:
            not_images = (o.inputs - o.images if same_shape else o.inputs for o, same_shape in operands)
            images = sources.difference(*not_images)
        for out in eqn.outvars:
            origins[out] = Origin(sources, images)
    return [origin(v) for v in jaxpr.outvars]
