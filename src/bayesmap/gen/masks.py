"""Flags and masks. A flag is a Python bool or a Boolean array. A `Mask` is a value with a flag: False means absent.

A Python bool is known while a program is traced, and decides which addresses a choice map has. An array never decides
this, even when its value is known: otherwise maps would have one structure inside `jax.jit` and another one outside.
"""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from contextvars import ContextVar
from functools import reduce
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax.experimental import checkify

from bayesmap.gen.diff import Diff
from bayesmap.gen.pytree import Pytree, dataclass
from bayesmap.gen.typing import Flag


def is_concrete(value: Any) -> bool:
    """Return whether the value is known while Python runs, that is, no JAX tracer."""
    return not isinstance(value, jax.core.Tracer)


def is_known(flag: Any) -> bool:
    """Return whether the flag is a Python bool."""
    return isinstance(flag, bool | np.bool_)


def flag_and(first: Flag, second: Flag) -> Flag:
    """Return whether both flags are True: a Python bool if both flags are known."""
    if is_known(first) and is_known(second):
        return bool(first) and bool(second)
    return jnp.logical_and(first, second)


def same_index(a: Any, b: Any) -> Flag:
    """Return whether two indices are equal: a Python bool if both are Python ints."""
    return a == b if isinstance(a, int) and isinstance(b, int) else jnp.asarray(a) == jnp.asarray(b)


def where_leaves(flag: Any, yes: Any, no: Any) -> Any:
    """Return `jnp.where` of each pair of leaves. The flag's shape is a prefix of every leaf's shape."""

    def choose(a: Any, b: Any) -> Any:
        missing_axes = max(jnp.ndim(a), jnp.ndim(b)) - jnp.ndim(flag)
        return jnp.where(jnp.reshape(flag, jnp.shape(flag) + (1,) * missing_axes), a, b)

    return jax.tree.map(choose, yes, no)


_checking: ContextVar[bool] = ContextVar("checking", default=False)  # inside `do_checkify`
_optional: ContextVar[bool] = ContextVar("optional", default=False)  # inside `optional_part`


@contextmanager
def _set_true(variable: ContextVar[bool]) -> Iterator[None]:
    """Set a variable to True for the code inside."""
    token = variable.set(True)
    try:
        yield
    finally:
        variable.reset(token)


def do_checkify() -> AbstractContextManager[None]:
    """Let the code inside raise errors for values whose flag is False; compiled code needs `checkify.checkify`."""
    return _set_true(_checking)


def optional_part() -> AbstractContextManager[None]:
    """Let choices be absent in the code inside: `mask` and `switch` score a part that a flag may switch off."""
    return _set_true(_optional)


def check_flags(condition: Any, message: str) -> None:
    """Report an error if an element of `condition` is False and the code runs inside `do_checkify`."""
    if _checking.get():
        checkify.check(jnp.all(condition), message)


def in_optional_part() -> bool:
    """Return whether this code runs inside `optional_part`: a distribution then scores an absent choice by NaN."""
    return _optional.get()


@dataclass
class Mask(Pytree):
    """A value that is present where `flag` is True. The flag's shape is a prefix of every leaf's shape."""

    value: Any
    flag: Flag = True

    def __post_init__(self) -> None:
        if isinstance(self.value, Mask):
            raise TypeError("A Mask cannot hold a Mask; use Mask.build to combine their flags")
        prefix = jnp.shape(self.primal_flag())
        for leaf in jax.tree.leaves(self.value):
            if jnp.shape(leaf)[: len(prefix)] != prefix:
                raise ValueError(f"The shape {prefix} must be a prefix of all leaf shapes. Found {jnp.shape(leaf)}")

    @staticmethod
    def build(value: Any, flag: Flag = True) -> "Mask":
        """Return a value with a flag. A Mask gets both flags; the new flag's shape must be a prefix of its flag's."""
        if not isinstance(value, Mask):
            return Mask(value, flag)
        old, new = jnp.shape(value.flag), jnp.shape(flag)
        if old[: len(new)] != new:
            raise ValueError(f"Can't build a Mask with non-matching Flag shapes {new} and {old}")
        if new:
            flag = jnp.reshape(flag, new + (1,) * (len(old) - len(new)))
        return Mask(value.value, flag_and(flag, value.flag))

    @staticmethod
    def maybe_mask(value: Any, flag: Flag) -> Any:
        """Return `Mask.build(value, flag).flatten()`."""
        return Mask.build(value, flag).flatten()

    def flatten(self) -> Any:
        """Return the value if the flag is Python's True, None if it is Python's False, and this Mask otherwise."""
        flag = self.primal_flag()
        if is_known(flag):
            return self.value if flag else None
        return self

    def primal_flag(self) -> Flag:
        """Return the flag without its `Diff`."""
        return self.flag.primal if isinstance(self.flag, Diff) else self.flag

    def unmask(self, default: Any = None) -> Any:
        """Return the value where the flag is True, else `default`; without it the stored value, see `do_checkify`."""
        if default is not None:
            return where_leaves(self.primal_flag(), self.value, default)
        check_flags(self.primal_flag(), "unmask: a flag is False, so the value is invalid; give a default")
        return self.value

    def __getitem__(self, index: Any) -> "Mask":
        """Return the elements `index` with their flags."""
        path = index if isinstance(index, tuple) else (index,)
        flag = self.primal_flag()
        if jnp.ndim(flag) > 0:
            flag = jnp.asarray(flag)[path[: jnp.ndim(flag)]]
        return Mask(jax.tree.map(lambda leaf: leaf[path], self.value), flag)

    def __or__(self, other: "Mask") -> "Mask":
        """Return this value where it is present, and the other value elsewhere."""
        flag, other_flag = _flags_of_alike(self, other)
        # A known flag decides for all elements. Otherwise each element decides, and the new flag is an array.
        if is_known(flag):
            return self if flag else other
        return Mask(where_leaves(flag, self.value, other.value), jnp.logical_or(flag, other_flag))

    def __xor__(self, other: "Mask") -> "Mask":
        """Return the value that is present; no value is present where both are."""
        flag, other_flag = _flags_of_alike(self, other)
        # Both flags must be known for the result to be: the other value's presence takes this one away.
        if is_known(flag) and is_known(other_flag):
            return Mask.build(self if flag else other, flag != other_flag)
        return Mask(where_leaves(flag, self.value, other.value), jnp.logical_xor(flag, other_flag))

    def __invert__(self) -> "Mask":
        """Return the value with the opposite flag."""
        flag = self.primal_flag()
        return Mask(self.value, not flag if is_known(flag) else jnp.logical_not(flag))

    @staticmethod
    def or_n(first: "Mask", *others: "Mask") -> "Mask":
        """Return `first | other | ...`."""
        return reduce(lambda a, b: a | b, others, first)

    @staticmethod
    def xor_n(first: "Mask", *others: "Mask") -> "Mask":
        """Return `first ^ other ^ ...`."""
        return reduce(lambda a, b: a ^ b, others, first)


def _flags_of_alike(a: Mask, b: Mask) -> tuple[Flag, Flag]:
    """Return the flags of two masks. Raises ValueError unless their tree structures and shapes are equal."""
    if bool(jax.tree.structure(a.value) != jax.tree.structure(b.value)):  # type: ignore[operator]
        raise ValueError("Cannot combine masks with different tree structures")
    for x, y in zip(jax.tree.leaves((a.value, a.flag)), jax.tree.leaves((b.value, b.flag)), strict=True):
        if jnp.shape(x) != jnp.shape(y):
            raise ValueError(f"Cannot combine masks with different array shapes: {jnp.shape(x)} vs {jnp.shape(y)}")
    return a.primal_flag(), b.primal_flag()


def overlay(first: Mask, second: Mask) -> Mask:
    """Return `first | second` for flags of different rank. The shorter flag is repeated along the missing axes."""
    ndim = max(jnp.ndim(first.flag), jnp.ndim(second.flag))
    flags = [jnp.reshape(m.flag, jnp.shape(m.flag) + (1,) * (ndim - jnp.ndim(m.flag))) for m in (first, second)]
    shape = jnp.broadcast_shapes(*map(jnp.shape, flags))
    a, b = (Mask(m.value, jnp.broadcast_to(f, shape)) for m, f in zip((first, second), flags, strict=True))
    return a | b
