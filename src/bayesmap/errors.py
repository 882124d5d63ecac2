"""The exception for invalid input, and a check of whole numbers that raises it.

Every layer raises `BadInput` with a message that names the place, the error and the remedy. The command line prints the
message on one line and exits with code 3.
"""

from __future__ import annotations

import math


class BadInput(ValueError):
    """Invalid input. The message names the place and the remedy."""


def check_count(where: str, name: str, value: int, least: int) -> int:
    """Return a value as a whole number, or raise an error.

    Args:
        where: function or object that takes the number, for the message.
        name: name of the argument.
        value: the value.
        least: smallest allowed value.

    Raises:
        BadInput: the value is not a whole number, or is below ``least``.
    """
    number = hasattr(value, "__float__") and not isinstance(value, bool | str)
    if not number or not math.isfinite(value) or value != int(value) or value < least:
        raise BadInput(f"{where}: {name} must be a whole number of {least} or more, got {value!r}")
    return int(value)
