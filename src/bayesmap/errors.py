"""The exception for input that cannot be used, and the check that raises it most often.

Every layer raises `BadInput` with a message that says what was wrong, where, and what would be right;
the command line prints it on one line and exits with code 3.
"""

from __future__ import annotations

import math


class BadInput(ValueError):
    """Input that cannot be used: the message names the place and the remedy."""


def check_count(where: str, name: str, value: int, least: int) -> int:
    """Return a value as a whole number, or refuse it.

    Args:
        where: the function or object that was given the number.
        name: of the argument.
        value: what was given.
        least: the smallest that makes sense.

    Raises:
        BadInput: not a whole number, or below the least.
    """
    number = hasattr(value, "__float__") and not isinstance(value, bool | str)
    if not number or not math.isfinite(value) or value != int(value) or value < least:
        raise BadInput(f"{where}: {name} must be a whole number of {least} or more, got {value!r}")
    return int(value)
