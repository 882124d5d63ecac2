"""Frozen dataclasses that JAX can flatten into leaves: `Pytree`, the base of every value in `bayesmap.gen`.

A field declared with `Pytree.static()` belongs to the tree's definition and must be hashable; every other field is a
subtree. A class decorated by `penzai.pz.pytree_dataclass` may inherit from the base.
"""

import dataclasses
import types
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Self, TypeVar, dataclass_transform

import jax
import jax.numpy as jnp

T = TypeVar("T")


def static(**options: Any) -> Any:
    """Declare a field that belongs to the tree's definition: hashable, never traced."""
    return dataclasses.field(metadata={"pytree_node": False}, **options)


@dataclass_transform(frozen_default=True, field_specifiers=(dataclasses.field, static))
def dataclass(cls: type[T]) -> type[T]:
    """Make a subclass of `Pytree` a frozen dataclass, and register it with JAX."""
    frozen = dataclasses.dataclass(frozen=True, repr=cls.__repr__ is object.__repr__)(cls)
    return jax.tree_util.register_pytree_with_keys_class(frozen)


class Pytree:
    """Base of pytree dataclasses. A subclass needs the decorator `@Pytree.dataclass`."""

    dataclass = staticmethod(dataclass)
    static = staticmethod(static)

    @staticmethod
    def field(**options: Any) -> Any:
        """Declare a field that is a subtree, which is the default."""
        return dataclasses.field(**options)

    def __class_getitem__(cls, parameters: Any) -> Any:
        """Allow `Target[Any]` in annotations and as a base; the class does not depend on the parameters."""
        return types.GenericAlias(cls, parameters)

    @staticmethod
    def const(value: Any) -> "Const":
        """Return `value` as a part of the tree's definition: hashable, never traced."""
        return value if isinstance(value, Const) else Const(value)

    @staticmethod
    def tree_const(tree: Any) -> Any:
        """Return `tree` with every leaf that is not traced as a constant."""

        def constant(leaf: Any) -> Any:
            return leaf if isinstance(leaf, jax.core.Tracer) else Pytree.const(leaf)

        return jax.tree.map(constant, tree, is_leaf=_is_const)

    @staticmethod
    def tree_const_unwrap(tree: Any) -> Any:
        """Return `tree` with every constant replaced by its value."""
        return jax.tree.map(Const.unwrap, tree, is_leaf=_is_const)

    @staticmethod
    def partial(*args: Any) -> Callable[[Callable[..., Any]], "Closure"]:
        """Return a decorator that fixes a function's first arguments, as leaves of a `Closure`."""
        return lambda fn: Closure(args, fn)

    def treedef(self) -> Any:
        """Return the tree's definition."""
        return jax.tree.structure(self)

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some fields changed."""
        new = object.__new__(type(self))
        for f in dataclasses.fields(self):  # type: ignore[arg-type]
            object.__setattr__(new, f.name, changes.pop(f.name, getattr(self, f.name)))
        if changes:
            raise TypeError(f"{type(self).__name__} has no field {', '.join(changes)}")
        return new

    def tree_flatten_with_keys(self) -> tuple[list[tuple[Any, Any]], tuple[Any, ...]]:
        """Return the children with their field names, and the static fields' values."""
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
        """Return a tree of these children without a call of `__init__`: JAX passes children of any type."""
        new = object.__new__(cls)
        next_child, next_static = iter(children), iter(static)
        for f in dataclasses.fields(cls):  # type: ignore[arg-type]
            values = next_child if f.metadata.get("pytree_node", True) else next_static
            object.__setattr__(new, f.name, next(values))
        return new


@dataclass
class Const(Pytree):
    """A value that belongs to the tree's definition. If it is a function, the constant can be called."""

    val: Any = static()

    def __call__(self, *args: Any) -> Any:
        """Call the value, which is a function."""
        return self.val(*args)

    def unwrap(self: Any) -> Any:
        """Return the value; `Const.unwrap(x)` returns any other x itself."""
        return self.val if isinstance(self, Const) else self


def _is_const(value: Any) -> bool:
    return isinstance(value, Const)


@dataclass
class Closure(Pytree):
    """A function with its first arguments as leaves. See `Pytree.partial`."""

    dyn_args: tuple[Any, ...]
    fn: Callable[..., Any] = static()

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Call the function with the fixed arguments and further ones."""
        return self.fn(*self.dyn_args, *args, **kwargs)


def nth(tree: Any, index: Any) -> Any:
    """Return the tree of `leaf[index]` for all leaves."""
    return jax.tree.map(lambda leaf: leaf[index], tree)


class PythonicPytree(Pytree):
    """A tree whose leaves have leading axes of equal length: a sequence to index, slice, iterate and concatenate."""

    def __getitem__(self, index: Any) -> Self:
        return nth(self, index)  # type: ignore[no-any-return]

    def __len__(self) -> int:
        return len(jax.tree.leaves(self)[0])

    def __iter__(self) -> Iterator[Self]:
        return (self[i] for i in range(len(self)))

    def __add__(self, other: Any) -> Self:
        if not isinstance(other, type(self)):
            raise TypeError(f"Cannot add {type(self).__name__} and {type(other).__name__}")
        return jax.tree.map(lambda a, b: jnp.concatenate([a, b]), self, other)  # type: ignore[no-any-return]

    def prepend(self, element: Any) -> Self:
        """Return the sequence with one more element before the first."""
        return jax.tree.map(lambda leaf: jnp.asarray(leaf)[None], element) + self  # type: ignore[no-any-return]
