"""Define the exception for invalid input, and check arguments.

Every layer raises `BadInput`, whose message names place, error and remedy. The command line prints it; exit code 3.
"""

import difflib
import functools
import inspect
import math
from collections.abc import Callable
from typing import ParamSpec, TypeVar

P = ParamSpec("P")  # parameters of a decorated function
R = TypeVar("R")  # its result


class BadInput(ValueError):
    """Invalid input. The message names the place and the remedy."""


def check_count(caller: str, name: str, value: int, minimum: int) -> int:
    """Return a caller's argument as an int. Raises `BadInput` unless it is a whole number of ``minimum`` or more."""
    is_number = hasattr(value, "__float__") and not isinstance(value, bool | str)
    if not is_number or not math.isfinite(value) or value != int(value) or value < minimum:
        raise BadInput(f"{caller}: {name} must be a whole number of {minimum} or more, got {value!r}")
    return int(value)


def near_names(function: Callable[P, R]) -> Callable[P, R]:
    """Decorate a function: its error for an unknown keyword names the nearest known one, as in Python 3.13."""
    keywords = list(inspect.signature(function).parameters)

    @functools.wraps(function)
    def call(*args: P.args, **options: P.kwargs) -> R:
        for name in options:
            if name not in keywords:
                nearest = difflib.get_close_matches(name, keywords, n=1)
                hint = f". Did you mean {nearest[0]!r}?" if nearest else ""
                raise TypeError(f"{function.__name__}() got an unexpected keyword argument {name!r}{hint}")
        return function(*args, **options)

    return call
