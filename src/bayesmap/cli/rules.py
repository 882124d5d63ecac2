"""What a setting's number must be, beyond a number: said before any work is done with it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from bayesmap.cli.keys import Key, Value
from bayesmap.errors import BadInput

MOST = 10**9
"""Of anything that is counted."""


@dataclass(frozen=True)
class Rule:
    """What a number must be.

    Attributes:
        holds: whether it is.
        words: what it must be, to follow "must be".
    """

    holds: Callable[[Any], bool]
    words: str


ONE_OR_MORE = Rule(lambda n: n >= 1, "a whole number of 1 or more")
NONE_OR_MORE = Rule(lambda n: n >= 0, "a whole number of 0 or more")
EVERY = Rule(lambda n: n == 0 or n >= 2, "2 or more, for every n-th scan, or 0")
LENGTH = Rule(lambda x: 0 < x < math.inf, "a positive number of metres")
SPACING = Rule(lambda x: 0 <= x < math.inf, "0 or a positive number of metres")
SPEED = Rule(lambda x: 0 < x < math.inf, "a positive number of metres a second")
DURATION = Rule(lambda x: x >= 0, "0 or a positive number of seconds")
CODE = Rule(lambda x: not math.isnan(x), "the log's number in metres, or inf if it has none")
SHARE = Rule(lambda x: 0 <= x <= 1, "a number from 0 to 1")

RULES = {
    "resolution": LENGTH,
    "max_range": LENGTH,
    "no_return": CODE,
    "thin_scans": SPACING,
    "chains": ONE_OR_MORE,
    "warmup": NONE_OR_MORE,
    "draws": ONE_OR_MORE,  # the library allows none; the picture and the map are made from them
    "thin": ONE_OR_MORE,
    "particles": ONE_OR_MORE,
    "rounds": ONE_OR_MORE,
    "seed": NONE_OR_MORE,
    "prior": SHARE,
    "coupling": Rule(lambda x: x == "fit" or 0 <= x <= 50, "a number from 0 to 50, or fit"),
    "beam_weight": Rule(lambda x: 0 < x <= 1, "a number above 0, and 1 at most"),
    "hit_depth": SHARE,
    "holdout": EVERY,
    "threads": Rule(lambda n: 1 <= n <= 1024, "a whole number from 1 to 1024"),
    "checkpoint_every": DURATION,
    "scans": ONE_OR_MORE,
    "speed": SPEED,
    "chain": ONE_OR_MORE,
    "frames": ONE_OR_MORE,
    "occupied_thresh": SHARE,
    "free_thresh": SHARE,
    "radius": LENGTH,
    "risk": Rule(lambda x: 0 < x < 1, "a number above 0 and below 1"),
    "candidates": ONE_OR_MORE,
    "views": ONE_OR_MORE,
}
"""By the name of the setting, in whichever section it is."""


def checked(key: Key, value: Value) -> Value:
    """The value, if it keeps its rule.

    Raises:
        BadInput: it does not; the message names the flag, which is also how the setting is called elsewhere.
    """
    if isinstance(value, int) and value > MOST and key.name != "seed":
        raise BadInput(f"{key.flag} must be {MOST:,} at most, got {value}")
    rule = RULES.get(key.name)
    if rule is not None and value is not None and not rule.holds(value):
        raise BadInput(f"{key.flag} must be {rule.words}, got {value!r}")
    return value
