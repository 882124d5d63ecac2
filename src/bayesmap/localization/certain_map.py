"""One scan in a map that is known, each beam a reading of its own: the posterior is narrow, and may have many places.

What `bayesmap.localization.filter` does for maps that were inferred would lose places here: beside a likelihood of
a centimetre's width, that of a place whose proposal lies five centimetres off is nothing. So the likelihood's power
rises from what a scan is worth there to 1, while proposals follow, and places that have come together count as one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.localization.belief import PoseBelief
from bayesmap.localization.filter import FOUND_SD, NEARLY, Prior, Scan, Target, belief_of, everywhere
from bayesmap.localization.known_map import INDEPENDENT_BEAMS, KnownMap
from bayesmap.localization.particles import PoseMixture, adapted, draw_population, groups_of
from bayesmap.localization.search import search
from bayesmap.space.planar import wrapped

Floats = NDArray[np.float64]

CANDIDATES = 32
RISES = 6
"""Steps of the power."""

SETTLES = 4
"""Rounds with the power at 1, at most."""

KEPT = 16
"""Places that are weighed, at most."""

EACH, LAST = 24, 192
"""Draws of each place, in a round and in the last."""

ONE_PLACE = 1.0
"""Places nearer than so many standard deviations, or `ALIKE`, have come together."""

ALIKE = np.array([0.02, 0.02, np.radians(1.0)])


def locate(known: KnownMap, scan: Scan, rng: np.random.Generator) -> PoseBelief:
    """The posterior of a scan's pose, which may be anywhere on the map.

    Args:
        known: the map; its ``beam_weight`` is the power that the likelihood ends at.
        scan: the scan.
        rng: for the draws of poses.
    """
    prior = Prior()
    valid = max(1, int((~np.isnan(scan.ranges_m)).sum()))
    last = known.weight_of(scan.ranges_m)
    first = min(last, INDEPENDENT_BEAMS / valid)

    def target(weight: float, thin: int = 1) -> Target:
        return Target(known, prior, scan, thin, weight)

    thin = max(1, len(scan.angles_rad) // 60)

    found = search(known.field, scan.angles_rad, scan.ranges_m, CANDIDATES)
    if len(found.poses) == 0:
        return belief_of(known, prior, scan, everywhere(known, target(last), rng), None)
    count = len(found.poses)
    places = PoseMixture(found.poses, np.broadcast_to(np.diag(FOUND_SD**2), (count, 3, 3)), np.zeros(count))
    for weight in np.geomspace(first, last, RISES):
        places, _ = adapted(places, draw_population(places, target(float(weight), thin), EACH, rng))
        places = distinct(places).best(KEPT)
    for _ in range(SETTLES):
        places, power = adapted(places, draw_population(places, target(last), EACH, rng))
        places = distinct(places).best(KEPT)
        if power > NEARLY:
            break
    population = draw_population(places, target(last), LAST, rng)
    return belief_of(known, prior, scan, population, groups_of(places, population.poses))


def distinct(places: PoseMixture) -> PoseMixture:
    """The places without those that lie on a heavier one."""
    kept: list[int] = []
    for i in np.argsort(-places.log_mass, kind="stable").tolist():
        off = places.means[kept] - places.means[i]
        off[:, 2] = wrapped(off[:, 2])
        within = np.einsum("ki,kij,kj->k", off, np.linalg.inv(places.covariances[kept]), off) < ONE_PLACE**2
        if not (within | (np.abs(off) < ALIKE).all(axis=1)).any():
            kept.append(i)
    return PoseMixture(places.means[kept], places.covariances[kept], places.log_mass[kept])
