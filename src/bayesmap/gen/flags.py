"""Logic on flags, each a Python bool or a Boolean array, and which checks apply to the code that runs at the moment.

A Python bool is known while a program is traced, and decides what a choice map holds. An array never does, even when
its value could be looked up: else a program would give maps of other structure inside `jax.jit` than outside.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax.experimental import checkify

from bayesmap.gen.typing import Flag


def is_concrete(value: Any) -> bool:
    """Is the value known while Python runs, not a JAX tracer?"""
    return not isinstance(value, jax.core.Tracer)


def is_known(flag: Any) -> bool:
    """Is it a Python bool?"""
    return isinstance(flag, bool | np.bool_)


def both(f: Flag, g: Flag) -> Flag:
    """f and g."""
    return bool(f and g) if is_known(f) and is_known(g) else jnp.logical_and(f, g)


def either(f: Flag, g: Flag) -> Flag:
    """f or g."""
    return bool(f or g) if is_known(f) and is_known(g) else jnp.logical_or(f, g)


def exactly_one(f: Flag, g: Flag) -> Flag:
    """f or g, not both."""
    return bool(f) != bool(g) if is_known(f) and is_known(g) else jnp.logical_xor(f, g)


def negation(f: Flag) -> Flag:
    """Not f."""
    return not f if is_known(f) else jnp.logical_not(f)


def same_index(a: Any, b: Any) -> Flag:
    """Are two indices equal? A Python bool if both are Python ints."""
    return a == b if isinstance(a, int) and isinstance(b, int) else jnp.asarray(a) == jnp.asarray(b)


def where(flag: Any, yes: Any, no: Any) -> Any:
    """Leafwise `jnp.where`; `flag`'s shape is a prefix of every leaf's."""

    def pick(a: Any, b: Any) -> Any:
        missing = max(jnp.ndim(a), jnp.ndim(b)) - jnp.ndim(flag)
        return jnp.where(jnp.reshape(flag, jnp.shape(flag) + (1,) * missing), a, b)

    return jax.tree.map(pick, yes, no)


_checking: ContextVar[bool] = ContextVar("checking", default=False)
_optional: ContextVar[bool] = ContextVar("optional", default=False)


@contextmanager
def do_checkify() -> Iterator[None]:
    """Check, in the code inside, that no value whose flag is False is used.

    Compiled code reports through `jax.experimental.checkify.checkify`; other code raises at once.
    """
    token = _checking.set(True)
    try:
        yield
    finally:
        _checking.reset(token)


def check(condition: Any, message: str) -> None:
    """Complain where some element of `condition` is False, if within `do_checkify`."""
    if _checking.get():
        checkify.check(jnp.all(condition), message)


@contextmanager
def optional_part() -> Iterator[None]:
    """The code inside scores a part of a model that a flag may switch off, so that its choices may be absent."""
    token = _optional.set(True)
    try:
        yield
    finally:
        _optional.reset(token)


def in_optional_part() -> bool:
    """Is this code inside `optional_part`?"""
    return _optional.get()
