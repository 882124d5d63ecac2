"""Numbers typed one after the other, such as a point: X,Y; and those in whose place a word may stand."""

from __future__ import annotations

import math
from typing import Any

import click


class NumberOr(click.ParamType[float | str]):
    """A number, or a word.

    Attributes:
        word: that may stand in its place.
    """

    name = "number"

    def __init__(self, word: str) -> None:
        self.word = word

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float | str:
        """The number or the word of a text; a number as it is."""
        if value == self.word:
            return self.word
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor {self.word!r}", param, ctx)


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
