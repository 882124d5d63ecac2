"""Frozen dataclasses that JAX can flatten: the base of every value in this package.

A field declared with `Pytree.static()` belongs to the tree's definition (it must be hashable); every
other field is a subtree. The base provides `tree_flatten_with_keys` and `tree_unflatten`, so a class
decorated by `penzai.pz.pytree_dataclass` may inherit from it too.
"""

import dataclasses
from collections.abc import Iterable
from typing import Any, Self, TypeVar, dataclass_transform

import jax

T = TypeVar("T")


def static(**options: Any) -> Any:
    """A field that belongs to the tree's definition: hashable, never traced."""
    return dataclasses.field(metadata={"pytree_node": False}, **options)


@dataclass_transform(frozen_default=True, field_specifiers=(dataclasses.field, static))
def dataclass(cls: type[T]) -> type[T]:
    """Make a subclass of `Pytree` a frozen dataclass, and register it with JAX."""
    frozen = dataclasses.dataclass(frozen=True, repr=cls.__repr__ is object.__repr__)(cls)
    return jax.tree_util.register_pytree_with_keys_class(frozen)


class Pytree:
    """Base of pytree dataclasses: decorate a subclass with `@Pytree.dataclass`."""

    dataclass = staticmethod(dataclass)
    static = staticmethod(static)

    @staticmethod
    def field(**options: Any) -> Any:
        """A field that is a subtree; the same as leaving the specifier out."""
        return dataclasses.field(**options)

    def replace(self, **changes: Any) -> Self:
        """A copy with some fields changed."""
        new = object.__new__(type(self))
        for f in dataclasses.fields(self):  # type: ignore[arg-type]
            object.__setattr__(new, f.name, changes.pop(f.name, getattr(self, f.name)))
        if changes:
            raise TypeError(f"{type(self).__name__} has no field {', '.join(changes)}")
        return new

    def tree_flatten_with_keys(self) -> tuple[list[tuple[Any, Any]], tuple[Any, ...]]:
        """Children with their field names, and the static fields' values."""
        children, static = [], []
        for f in dataclasses.fields(self):  # type: ignore[arg-type]
            value = getattr(self, f.name)
            if f.metadata.get("pytree_node", True):
                children.append((jax.tree_util.GetAttrKey(f.name), value))
            else:
                static.append(value)
        return children, tuple(static)

    @classmethod
    def tree_unflatten(cls, static: tuple[Any, ...], children: Iterable[Any]) -> Self:
        """Rebuild without running `__init__`: children may be placeholders of any type."""
        new = object.__new__(cls)
        nodes, fixed = iter(children), iter(static)
        for f in dataclasses.fields(cls):  # type: ignore[arg-type]
            source = nodes if f.metadata.get("pytree_node", True) else fixed
            object.__setattr__(new, f.name, next(source))
        return new
