"""Which checks apply to the code that runs at the moment."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import jax.numpy as jnp
from jax.experimental import checkify

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
