"""Values together with what is known of how they changed since a trace was made.

`edit` receives its arguments as a tree of `Diff` leaves and returns its value as one. A tangent is
`NoChange`, `UnknownChange`, or `IndexChange(index)`: equal to the old array except, at most, at `index`.
The last is what lets a generative function recompute only what one changed element affects.
"""

from typing import Any

import jax

from bayesmap.gen.pytree import Pytree, dataclass


class Change(Pytree):
    """What is known of a change."""


@dataclass
class _NoChange(Change):
    """The value is the old one."""


@dataclass
class _UnknownChange(Change):
    """Nothing is known."""


@dataclass
class IndexChange(Change):
    """Only the elements `value[index]` may differ; `index` holds ints or scalar integer arrays."""

    index: tuple[Any, ...]


NoChange = _NoChange()
UnknownChange = _UnknownChange()


def _is_diff(value: Any) -> bool:
    return isinstance(value, Diff)


@dataclass
class Diff(Pytree):
    """A leaf value `primal` (the new one) and its `tangent`."""

    primal: Any
    tangent: Change

    def get_primal(self) -> Any:
        """The value."""
        return self.primal

    def get_tangent(self) -> Change:
        """What is known of its change."""
        return self.tangent

    @staticmethod
    def tree_diff(value: Any, tangents: Any) -> Any:
        """`value`, each leaf marked by the leaf of `tangents` in the same place."""
        return jax.tree.map(Diff, value, tangents)

    @staticmethod
    def tree_tangent(value: Any) -> Any:
        """The marks in place of the leaves; an unmarked leaf counts as unchanged."""
        return jax.tree.map(lambda leaf: leaf.tangent if _is_diff(leaf) else NoChange, value, is_leaf=_is_diff)

    @staticmethod
    def is_diff(value: Any) -> bool:
        """Is it a `Diff`?"""
        return _is_diff(value)

    @staticmethod
    def is_change_tangent(value: Any) -> bool:
        """Is it a mark?"""
        return isinstance(value, Change)

    @staticmethod
    def static_check_tree_diff(value: Any) -> bool:
        """Is every leaf marked?"""
        return all(_is_diff(leaf) for leaf in jax.tree.leaves(value, is_leaf=_is_diff))

    @staticmethod
    def tree(value: Any, tangent: Change) -> Any:
        """`value` with every leaf marked by `tangent`; marks that it has already are replaced."""
        return jax.tree.map(lambda leaf: Diff(leaf, tangent), Diff.tree_primal(value))

    @staticmethod
    def no_change(value: Any) -> Any:
        """`value`, every leaf marked unchanged."""
        return Diff.tree(value, NoChange)

    @staticmethod
    def unknown_change(value: Any) -> Any:
        """`value`, every leaf marked as changed in an unknown way."""
        return Diff.tree(value, UnknownChange)

    @staticmethod
    def index_change(value: Any, *index: Any) -> Any:
        """`value`, every leaf marked as changed at `index` alone."""
        return Diff.tree(value, IndexChange(index))

    @staticmethod
    def tree_primal(value: Any) -> Any:
        """`value` without its marks."""
        return jax.tree.map(lambda leaf: leaf.primal if _is_diff(leaf) else leaf, value, is_leaf=_is_diff)

    @staticmethod
    def tangents(value: Any) -> list[Change]:
        """The marks of the leaves in order; an unmarked leaf counts as changed."""
        leaves = jax.tree.leaves(value, is_leaf=_is_diff)
        return [leaf.tangent if _is_diff(leaf) else UnknownChange for leaf in leaves]

    @staticmethod
    def zip(value: Any, tangents: list[Change]) -> Any:
        """Mark the leaves of the plain tree `value` with `tangents`, in order."""
        leaves, treedef = jax.tree.flatten(value)
        return jax.tree.unflatten(treedef, [Diff(leaf, t) for leaf, t in zip(leaves, tangents, strict=True)])

    @staticmethod
    def static_check_no_change(value: Any) -> bool:
        """Is every leaf marked unchanged?"""
        return all(isinstance(t, _NoChange) for t in Diff.tangents(value))
