"""Frozen dataclasses that JAX can flatten: the base of every value in this package.

A field declared with `Pytree.static()` belongs to the tree's definition (it must be hashable); every
other field is a subtree. The base provides `tree_flatten_with_keys` and `tree_unflatten`, so a class
decorated by `penzai.pz.pytree_dataclass` may inherit from it too.
"""

import dataclasses
import types
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Self, TypeVar, dataclass_transform

import jax
import jax.numpy as jnp

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

    def __class_getitem__(cls, parameters: Any) -> Any:
        """`Target[Any]`, in annotations and as a base: the class itself does not depend on it."""
        return types.GenericAlias(cls, parameters)

    @staticmethod
    def const(value: Any) -> "Const":
        """`value` as part of the tree's definition: hashable, never traced."""
        return value if isinstance(value, Const) else Const(value)

    @staticmethod
    def tree_const(tree: Any) -> Any:
        """`tree` with every leaf that is not traced made constant."""

        def fix(leaf: Any) -> Any:
            return leaf if isinstance(leaf, jax.core.Tracer) else Pytree.const(leaf)

        return jax.tree.map(fix, tree, is_leaf=_is_const)

    @staticmethod
    def tree_const_unwrap(tree: Any) -> Any:
        """`tree` with every constant replaced by its value."""
        return jax.tree.map(Const.unwrap, tree, is_leaf=_is_const)

    @staticmethod
    def partial(*args: Any) -> Callable[[Callable[..., Any]], "Closure"]:
        """A decorator: a function with its first arguments given, as a tree of which they are leaves."""
        return lambda fn: Closure(args, fn)

    def treedef(self) -> Any:
        """The tree's definition."""
        return jax.tree.structure(self)

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


@dataclass
class Const(Pytree):
    """A value that belongs to the tree's definition; call it if it is a function."""

    val: Any = static()

    def __call__(self, *args: Any) -> Any:
        """Call the value, which is a function."""
        return self.val(*args)

    def unwrap(self: Any) -> Any:
        """The value; `Const.unwrap(x)` of anything else is x."""
        return self.val if isinstance(self, Const) else self


def _is_const(value: Any) -> bool:
    return isinstance(value, Const)


@dataclass
class Closure(Pytree):
    """A function with its first arguments, which JAX sees; made by `Pytree.partial`."""

    dyn_args: tuple[Any, ...]
    fn: Callable[..., Any] = static()

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """The function of the arguments held here and these."""
        return self.fn(*self.dyn_args, *args, **kwargs)


def nth(tree: Any, index: Any) -> Any:
    """The tree of all leaves' elements `leaf[index]`."""
    return jax.tree.map(lambda leaf: leaf[index], tree)


class PythonicPytree(Pytree):
    """A tree whose leaves have leading axes of one length, as a sequence: index, slice, iterate, concatenate."""

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
        """The sequence with one more element before the first."""
        return jax.tree.map(lambda leaf: jnp.asarray(leaf)[None], element) + self  # type: ignore[no-any-return]
