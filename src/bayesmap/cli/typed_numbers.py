"""Numbers typed one after the other, such as a point: X,Y."""

from __future__ import annotations

import math

import click


def numbers_of(text: str, flag: str, form: str, counts: tuple[int, ...]) -> list[float]:
    """The numbers of an option's text.

    Args:
        text: as typed.
        flag: the option.
        form: what was to be typed, such as "X,Y".
        counts: how many numbers it may be.

    Raises:
        click.BadParameter: another count, or something that is not a finite number.
    """
    try:
        found = [float(part) for part in text.split(",")]
    except ValueError:
        found = []
    if len(found) not in counts or not all(map(math.isfinite, found)):
        raise click.BadParameter(f"{text!r} is not {form}", param_hint=f"'{flag}'")
    return found
