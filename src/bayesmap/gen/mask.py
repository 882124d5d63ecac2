"""A value that may be absent, decided at run time."""

from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.pytree import Pytree, dataclass
from bayesmap.gen.typing import Flag


def is_concrete(value: Any) -> bool:
    """Is the value known while Python runs, not a JAX tracer?"""
    return not isinstance(value, jax.core.Tracer)


def where(flag: Any, yes: Any, no: Any) -> Any:
    """Leafwise `jnp.where`; `flag`'s shape is a prefix of every leaf's."""

    def pick(a: Any, b: Any) -> Any:
        missing = max(jnp.ndim(a), jnp.ndim(b)) - jnp.ndim(flag)
        return jnp.where(jnp.reshape(flag, jnp.shape(flag) + (1,) * missing), a, b)

    return jax.tree.map(pick, yes, no)


@dataclass
class Mask(Pytree):
    """`value` where `flag` holds, nothing elsewhere; the flag's shape is a prefix of every leaf's shape."""

    value: Any
    flag: Flag = True

    def __post_init__(self) -> None:
        if isinstance(self.value, Mask):
            raise TypeError("A Mask cannot hold a Mask; use Mask.build to combine their flags")
        prefix = jnp.shape(self.flag)
        for leaf in jax.tree.leaves(self.value):
            if jnp.shape(leaf)[: len(prefix)] != prefix:
                raise ValueError(f"A flag of shape {prefix} cannot mask a value of shape {jnp.shape(leaf)}")

    @staticmethod
    def build(value: Any, flag: Flag = True) -> "Mask":
        """Mask a value, or a Mask once more: then both flags must hold."""
        if isinstance(value, Mask):
            inner = value.flag
            if flag is True:
                return value
            if jnp.ndim(flag) < jnp.ndim(inner):
                flag = jnp.reshape(flag, jnp.shape(flag) + (1,) * (jnp.ndim(inner) - jnp.ndim(flag)))
            return Mask(value.value, flag if inner is True else jnp.logical_and(flag, inner))
        return Mask(value, flag)

    def flatten(self) -> Any:
        """The value if the flag is known to be True, None if it is known to be False, else this Mask."""
        if is_concrete(self.flag) and jnp.ndim(self.flag) == 0:
            return self.value if bool(self.flag) else None
        return self

    def unmask(self, default: Any = None) -> Any:
        """The value; where the flag is False, `default`.

        Raises:
            ValueError: no default was given and the flag is known not to hold everywhere.
        """
        if default is not None:
            return where(self.flag, self.value, default)
        if is_concrete(self.flag) and not bool(jnp.all(self.flag)):
            raise ValueError("Unmasking a value whose flag is False, and no default was given")
        return self.value

    def __getitem__(self, index: Any) -> "Mask":
        path = index if isinstance(index, tuple) else (index,)
        flag = self.flag if jnp.ndim(self.flag) == 0 else jnp.asarray(self.flag)[path[: jnp.ndim(self.flag)]]
        return Mask(jax.tree.map(lambda leaf: leaf[path], self.value), flag)

    def __or__(self, other: "Mask") -> "Mask":
        """This value where it is present, else the other's."""
        mine, theirs = jax.tree.map(jnp.shape, self.value), jax.tree.map(jnp.shape, other.value)
        if mine != theirs:
            raise ValueError(f"Masks of values of shapes {mine} and {theirs} cannot be combined")
        ndim = max(jnp.ndim(self.flag), jnp.ndim(other.flag))
        flags = [jnp.reshape(f, jnp.shape(f) + (1,) * (ndim - jnp.ndim(f))) for f in (self.flag, other.flag)]
        shape = jnp.broadcast_shapes(*(jnp.shape(f) for f in flags))
        first, second = (jnp.broadcast_to(f, shape) for f in flags)
        return Mask(where(first, self.value, other.value), jnp.logical_or(first, second))
