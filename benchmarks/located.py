"""Where was a scan taken, asked of a map that lacks it: single scans, ten with odometry, tracking, beside the truth."""

import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.localization.belief import PoseBelief
from bayesmap.localization.known_map import KnownMap
from bayesmap.localization.localize import InitialPose, follow, localize
from bayesmap.space.planar import between, wrap_angle
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

RIGHT_M, RIGHT_RAD = 0.5, np.radians(10.0)


def judged(belief: PoseBelief, truth: Floats, seconds: float) -> dict[str, Any]:
    """What is kept of an answer."""
    error = belief.mean - truth
    error[2] = wrap_angle(error[2])
    return {
        "right": is_right(belief.mean, truth),
        "off_m": off_m(belief.mean, truth),
        "square": float(error @ np.linalg.solve(belief.covariance, error)),
        "modes": [(mode.probability, is_right(mode.mean, truth)) for mode in belief.modes[:12]],
        "seconds": seconds,
    }


def located(known: KnownMap, scans: Scans, raw: Scans, place: int) -> dict[str, Any]:
    """Five single scans, ten with odometry, and how fast these are followed from a known start, of one place.

    Args:
        known: a map that was made without these scans.
        scans: at their true poses.
        raw: the same, at odometry's.
        place: the first of the ten.

    Returns:
        Answers ``one`` (five) and ``ten``, with seconds of processor time; ``hz``, scans followed in a second of it.
    """
    found: dict[str, Any] = {"place": place, "one": []}
    for scan in range(place, place + 10, 2):
        begin = time.process_time()
        where = localize(known, scans.select([scan])).last
        found["one"].append(judged(where, scans.poses[scan], time.process_time() - begin))
    some = np.arange(place, place + 10)
    moved = scans.select(some).at(raw.poses[some])
    begin = time.process_time()
    last = list(follow(known, moved))[-1]
    found["ten"] = judged(last, scans.poses[some[-1]], time.process_time() - begin)
    tracked = follow(known, moved, InitialPose(scans.poses[place], 0.1, 0.05))
    next(tracked)
    begin = time.process_time()
    found["hz"] = len(list(tracked)) / (time.process_time() - begin)
    return found


def off_m(pose: Floats, truth: Floats) -> float:
    """How far a position is from the truth."""
    return float(np.hypot(*(pose - truth)[:2]))


def is_right(pose: Floats, truth: Floats) -> bool:
    """Within half a metre and ten degrees."""
    error = between(truth, pose)
    return bool(np.hypot(error[0], error[1]) < RIGHT_M and abs(wrap_angle(error[2])) < RIGHT_RAD)
