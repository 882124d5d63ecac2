"""A value that may be absent, decided at run time."""

from functools import reduce
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.diff import Diff
from bayesmap.gen.flags import both, check, either, exactly_one, is_known, negation, where
from bayesmap.gen.pytree import Pytree, dataclass
from bayesmap.gen.typing import Flag


@dataclass
class Mask(Pytree):
    """`value` where `flag` holds, nothing elsewhere; the flag's shape is a prefix of every leaf's shape."""

    value: Any
    flag: Flag = True

    def __post_init__(self) -> None:
        if isinstance(self.value, Mask):
            raise TypeError("A Mask cannot hold a Mask; use Mask.build to combine their flags")
        prefix = jnp.shape(self.primal_flag())
        for leaf in jax.tree.leaves(self.value):
            if jnp.shape(leaf)[: len(prefix)] != prefix:
                raise ValueError(
                    f"A flag's shape {prefix} must be a prefix of all leaf shapes. Found {jnp.shape(leaf)}."
                )

    @staticmethod
    def build(value: Any, flag: Flag = True) -> "Mask":
        """Mask a value, or a Mask once more: then both flags must hold.

        Raises:
            ValueError: one flag's shape is not a prefix of the other's.
        """
        if not isinstance(value, Mask):
            return Mask(value, flag)
        old, new = jnp.shape(value.flag), jnp.shape(flag)
        if old[: len(new)] != new:
            raise ValueError(f"Can't build a Mask with non-matching Flag shapes {new} and {old}")
        if new:
            flag = jnp.reshape(flag, new + (1,) * (len(old) - len(new)))
        return Mask(value.value, both(flag, value.flag))

    @staticmethod
    def maybe_mask(value: Any, flag: Flag) -> Any:
        """`Mask.build(value, flag).flatten()`."""
        return Mask.build(value, flag).flatten()

    def flatten(self) -> Any:
        """The value if the flag is True, None if it is False, this Mask if it is an array."""
        flag = self.primal_flag()
        if is_known(flag):
            return self.value if flag else None
        return self

    def primal_flag(self) -> Flag:
        """The flag, without the mark of how it changed."""
        return self.flag.primal if isinstance(self.flag, Diff) else self.flag

    def unmask(self, default: Any = None) -> Any:
        """The value; where the flag is False, `default`, or, without one, whatever is stored there.

        Within `do_checkify`, a flag that is False without a default is an error.
        """
        if default is not None:
            return where(self.primal_flag(), self.value, default)
        check(self.primal_flag(), "unmask: a flag is False, so the value is invalid; give a default")
        return self.value

    def __getitem__(self, index: Any) -> "Mask":
        path, flag = index if isinstance(index, tuple) else (index,), self.primal_flag()
        if jnp.ndim(flag) > 0:
            flag = jnp.asarray(flag)[path[: jnp.ndim(flag)]]
        return Mask(jax.tree.map(lambda leaf: leaf[path], self.value), flag)

    def __or__(self, other: "Mask") -> "Mask":
        """This value where it is present, else the other's."""
        _check_same_shapes(self, other)
        mine, theirs = self.primal_flag(), other.primal_flag()
        if is_known(mine):
            return self if mine else other
        return Mask(where(mine, self.value, other.value), either(mine, theirs))

    def __xor__(self, other: "Mask") -> "Mask":
        """The value of whichever is present; nothing where both are."""
        _check_same_shapes(self, other)
        mine, theirs = self.primal_flag(), other.primal_flag()
        if is_known(mine) and is_known(theirs):
            return Mask.build(self if mine else other, mine != theirs)
        return Mask(where(mine, self.value, other.value), exactly_one(mine, theirs))

    def __invert__(self) -> "Mask":
        """The same value, present where it was absent."""
        return Mask(self.value, negation(self.primal_flag()))

    @staticmethod
    def or_n(first: "Mask", *others: "Mask") -> "Mask":
        """`first | other | ...`."""
        return reduce(lambda a, b: a | b, others, first)

    @staticmethod
    def xor_n(first: "Mask", *others: "Mask") -> "Mask":
        """`first ^ other ^ ...`."""
        return reduce(lambda a, b: a ^ b, others, first)


def _check_same_shapes(a: Mask, b: Mask) -> None:
    if bool(jax.tree.structure(a.value) != jax.tree.structure(b.value)):  # type: ignore[operator]
        raise ValueError("Cannot combine masks with different tree structures")
    for x, y in zip(jax.tree.leaves((a.value, a.flag)), jax.tree.leaves((b.value, b.flag)), strict=True):
        if jnp.shape(x) != jnp.shape(y):
            raise ValueError(f"Cannot combine masks with different array shapes: {jnp.shape(x)} vs {jnp.shape(y)}")


def overlay(first: Mask, second: Mask) -> Mask:
    """`first | second` for flags of different rank: the shorter holds for all of the axes that it lacks."""
    ndim = max(jnp.ndim(first.flag), jnp.ndim(second.flag))
    flags = [jnp.reshape(m.flag, jnp.shape(m.flag) + (1,) * (ndim - jnp.ndim(m.flag))) for m in (first, second)]
    shape = jnp.broadcast_shapes(*map(jnp.shape, flags))
    a, b = (Mask(m.value, jnp.broadcast_to(f, shape)) for m, f in zip((first, second), flags, strict=True))
    return a | b
