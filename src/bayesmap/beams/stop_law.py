r"""In which of its cells a beam stops, and where: the plain reference for every kernel that draws or predicts stops.

A cell that stops beams at its hit depth has one number, the probability that it does. Binary walls are stop
probabilities 0 and 1. A cell with a surface has six: reflectivity m, mean mu, and Cholesky factor of the covariance
Sigma of the points where beams stop (normal distributions as normal-distributions-transform maps keep them: Biber and
Strasser, 2003). A beam from p in direction u, with normal n, passes the mean at the offset o = n . (mu - p); across the
beam the surface has the standard deviation v = sqrt(n' Sigma n). The beam crosses the surface with probability

    g = 1 / (1 + (o / (w v))^6)

which is nearly one where it crosses the surface's body and nearly zero where it passes beside it; w = 2.2 was measured
(docs/surfaces.md). If it crosses it, and is stopped, which has probability m, that happens at the distance
t ~ N(t*, s^2), the law of a point of the surface *given that it lies on the beam*:

    t* = u . (mu - p) - (u' Sigma n / c^2) o        s^2 = u' Sigma u - (u' Sigma n)^2 / c^2

A beam's direction is known up to an angle omega only: at the mean's distance d = u . (mu - p) its line may lie off by
omega d, which spreads the readings of a wall that it grazes. So c^2 = v^2 + (omega d)^2, the variance across the beam
of the two together. The probability g keeps v: with c in it, held-out scans were predicted worse.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.sensors.model import Floats

CROSSING_WIDTH = 2.2
"""w above."""

DIRECTION_RAD = 0.005
"""omega above: between 4 and 8 thousandths held-out scans are predicted best (docs/lab/surfaces.md)."""


class Stops(NamedTuple):
    """Of every entry of some rays, (K,) each: the chance that a beam which gets there stops, and at which distance.

    Distances are known up to a spread, their standard deviation; both in metres.
    """

    chance: Floats
    distance_m: Floats
    spread_m: Floats


def stops_of(rays: Rays, states: NDArray[np.floating], hit_depth: float) -> Stops:
    """The stops that a map offers to some rays.

    Args:
        rays: beams.
        states: stop probabilities of the grid's cells, (N,), or surfaces, (N, 6): reflectivity, mean x and y in metres
            from the grid's lower left corner, and l11, l21, l22 of Sigma = L L'.
        hit_depth: where in a cell without a surface a beam stops, as a part of its stretch.
    """
    here = np.asarray(states, dtype=np.float64)[rays.cells]
    if here.ndim == 1:
        enter, leave = rays.stretches()
        return Stops(here, enter + hit_depth * (leave - enter), np.zeros(len(here)))
    beam = rays.beam_of_entry()
    along = rays.direction[beam]
    normal = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    to_mean = here[:, 1:3] - rays.start_m[beam]
    depth, offset = (to_mean * along).sum(axis=-1), (to_mean * normal).sum(axis=-1)
    l11, l21, l22 = here[:, 3:].T
    u_1, u_2 = l11 * along[:, 0] + l21 * along[:, 1], l22 * along[:, 1]  # L' u
    n_1, n_2 = l11 * normal[:, 0] + l21 * normal[:, 1], l22 * normal[:, 1]  # L' n
    across, mixed = n_1**2 + n_2**2, u_1 * n_1 + u_2 * n_2
    crosses = 1.0 / (1.0 + (offset**2 / (CROSSING_WIDTH**2 * across)) ** 3)
    off_line = (DIRECTION_RAD * np.maximum(depth, 0.0)) ** 2
    widened = across + off_line
    distance = np.maximum(depth - mixed / widened * offset, 0.0)
    # u' Sigma u - mixed^2 / widened, without a difference of large numbers.
    variance = ((l11 * l22) ** 2 + off_line * (u_1**2 + u_2**2)) / widened
    return Stops(here[:, 0] * crosses, distance, np.sqrt(variance))
