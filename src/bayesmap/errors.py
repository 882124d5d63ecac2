"""The exception for invalid input, and checks of arguments.

Every layer raises `BadInput` with a message that names the place, the error and the remedy. The command line prints the
message on one line and exits with code 3.
"""

from __future__ import annotations

import difflib
import functools
import inspect
import math
from collections.abc import Callable
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


class BadInput(ValueError):
    """Invalid input. The message names the place and the remedy."""


def check_count(where: str, name: str, value: int, least: int) -> int:
    """Return an argument as an int. Raises `BadInput` unless it is a whole number of ``least`` or more."""
    number = hasattr(value, "__float__") and not isinstance(value, bool | str)
    if not number or not math.isfinite(value) or value != int(value) or value < least:
        raise BadInput(f"{where}: {name} must be a whole number of {least} or more, got {value!r}")
    return int(value)


def near_names(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that answers an unknown keyword with the nearest one, as Python 3.13 does."""
    known = list(inspect.signature(function).parameters)

    @functools.wraps(function)
    def call(*args: P.args, **options: P.kwargs) -> R:
        for name in options:
            if name not in known:
                close = difflib.get_close_matches(name, known, n=1)
                hint = f". Did you mean {close[0]!r}?" if close else ""
                raise TypeError(f"{function.__name__}() got an unexpected keyword argument {name!r}{hint}")
        return function(*args, **options)

    return call
