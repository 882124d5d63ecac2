"""A cheap stand-in for the law of a scan: how near its end points fall to the map's surfaces, to a few centimetres.

It leaves out what stands in the way of a beam, so that nothing is judged by it: it tells where the exact law is to be
asked. The nearest surface's normal density counts, its peak 1, above a floor (Thrun, Burgard and Fox 2005, section
6.4, with surfaces in place of cells); a surface is widened by the noise of a reading.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.localization.field import SOLID, worth_of_unknown
from bayesmap.space.grid import Grid

Floats = NDArray[np.float64]

FINE_M = 0.025
MOST_CELLS = 16_000_000
"""Of fine cells."""

FLOOR = 0.02
"""What a point is worth that falls nowhere near a surface, as a part of one that falls on it."""

FAINT = 0.1
"""Cells that stop fewer beams than this have no surface here."""

TOP = 255


@dataclass(frozen=True, eq=False)
class EndpointField:
    """Log of a point's worth, over a fine grid.

    Attributes:
        grid: fine.
        values: 0, far from all surfaces, to 255, on one, (nx, ny).
    """

    grid: Grid
    values: NDArray[np.uint8]

    def log_worth(self, points: Floats, poses: Floats) -> Floats:
        """Sum over points of their log worth above that of a point far from all surfaces, at each pose, (P,), nats.

        Args:
            points: in the sensor's frame, (N, 2).
            poses: in the world frame, (P, 3).
        """
        from bayesmap.kernels.match.fields import field_sums

        return np.asarray(field_sums(self.values, self.grid, points, poses) * (-math.log(FLOOR) / TOP))


def endpoint_field(
    states: NDArray[np.float32], grid: Grid, noise_m: float, unknown: NDArray[np.bool_], chance: float
) -> EndpointField:
    """The field of some draws of a map.

    Args:
        states: stop probabilities (D, N), or surfaces (D, N, 6 or more): see `KnownMap.of_draws`.
        grid: of the map.
        noise_m: standard deviation of a reading.
        unknown: cells of which nothing is known, (nx, ny).
        chance: that such a cell stops a beam.
    """
    from bayesmap.kernels.match.fields import spread

    parts = max(1, math.ceil(grid.resolution / FINE_M - 1e-9))
    parts = max(1, min(parts, math.isqrt(MOST_CELLS // grid.n_cells)))
    fine = Grid((grid.shape[0] * parts, grid.shape[1] * parts), grid.resolution / parts, grid.origin)
    means, covariances, strengths = _surfaces(states, grid, ~unknown.ravel())
    # A fine cell stands for all points within it, so that no surface is narrower than half of one.
    round_ = np.array([1.0, 0.0, 1.0])
    covariances = (covariances + round_ * noise_m**2) / fine.resolution**2 + 0.25 * round_
    peaks = spread(means / fine.resolution, covariances, strengths, fine.shape)
    # About a third of a cell is how far a surface spreads, or is off its middle.
    worth = worth_of_unknown(chance, math.hypot(noise_m, 0.3 * grid.resolution), grid.resolution)
    np.maximum(peaks, np.where(unknown, worth, 0.0).repeat(parts, axis=0).repeat(parts, axis=1), out=peaks)
    logs = np.log(FLOOR + (1.0 - FLOOR) * np.minimum(peaks, 1.0)) / -math.log(FLOOR) + 1.0
    return EndpointField(fine, np.round(TOP * logs).astype(np.uint8))


def _surfaces(states: NDArray[np.float32], grid: Grid, known: NDArray[np.bool_]) -> tuple[Floats, Floats, Floats]:
    """Means from the grid's corner (K, 2), covariances xx, xy, yy (K, 3), in metres, and strengths, of all draws.

    Of known cells only: what a few draws have elsewhere tells of the prior, and all of them together have it almost
    everywhere.
    """
    chances = states[..., 0] if states.ndim == 3 else states
    which = np.nonzero((chances > FAINT) & known)
    strengths = np.asarray(np.minimum(chances[which].astype(np.float64) / SOLID, 1.0))
    if states.ndim == 3:
        own = states[which].astype(np.float64)
        l11, l21, l22 = own[:, 3:6].T
        return np.asarray(own[:, 1:3]), np.stack([l11**2, l11 * l21, l21**2 + l22**2], axis=1), strengths
    cells = np.stack(np.unravel_index(which[1], grid.shape), axis=1)
    flat = grid.resolution**2 / 12.0  # of a point anywhere in the cell
    return np.asarray((cells + 0.5) * grid.resolution), np.tile([flat, 0.0, flat], (len(cells), 1)), strengths
