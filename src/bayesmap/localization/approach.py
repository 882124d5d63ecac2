"""From where a pose may be to where the scan's end points meet the map: proposals for the exact law, at little cost."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bayesmap.localization.particles import PoseMixture, adapted, draw_population
from bayesmap.localization.search import FEWEST, end_points

if TYPE_CHECKING:
    from bayesmap.localization.known_map import KnownMap

Floats = NDArray[np.float64]

POINTS = 60
SHARPER = 2.0
"""How much more end points count here than beams: their field is that of all draws of the map in one, and wider. It
decides how many rounds the exact law needs, not what it answers."""

STEPS, NEARLY = 3, 0.6
"""Rounds at most, or until weights hardly have to be tempered; one less for several places: a search found them."""

DRAWS, LEAST = 240, 24
"""Draws in a round, of all places together, and of each."""


def approached(
    places: PoseMixture,
    log_prior: Callable[[Floats], Floats],
    known: KnownMap,
    angles_rad: Floats,
    ranges_m: Floats,
    rng: np.random.Generator,
) -> PoseMixture:
    """Places moved to where prior and end points say, and narrowed to their spread; as they are if too few beams hit.

    Args:
        places: where the pose may be.
        log_prior: log density of poses (P, 3) before the scan, (P,).
        known: the map.
        angles_rad: of the beams, (A,).
        ranges_m: readings, (A,).
        rng: for the draws.
    """
    points = end_points(angles_rad, ranges_m, POINTS)
    if len(points) < FEWEST:
        return places
    hits = int(np.isfinite(ranges_m).sum())
    weight = SHARPER * known.weight_of(ranges_m) * hits / len(points)

    def target(poses: Floats) -> Floats:
        return np.asarray(log_prior(poses) + weight * known.endpoints.log_worth(points, poses))

    each = max(LEAST, DRAWS // len(places.means))
    for _ in range(STEPS if len(places.means) == 1 else STEPS - 1):
        places, power = adapted(places, draw_population(places, target, each, rng))
        places = places.best(len(places.means))
        if power > NEARLY:
            break
    return places
