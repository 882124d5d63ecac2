"""How far errors of points move poses: what robust matching claims of its own precision, held against the pairs.

Matching minimises a robust cost, and its second derivatives by Gauss and Newton, over the variance of what is left,
claim too much. A residual e pulls with the force psi = w e, which grows more slowly than e, and at last falls; and when
a scan moves, its points are paired with others, nearer ones. So of a shift the forces change by a share k < 1 of what
Gauss and Newton say. An M-estimator's variance is (Huber 1967), for a point, E[psi^2] / (k E[w])^2, of which each of
the two points of a pair has half. With noise of 1 cm k is 0.67, with 3 cm 0.57: among points that scatter as widely as
they are apart the nearest is seldom the same.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import match_counts, pair_sums
from bayesmap.poses.alignment import ALIKE, REACH_M, SCALE_M, Alignment, beam_weights
from bayesmap.poses.pose_gaussian import PoseGaussian
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import between

Floats = NDArray[np.float64]

COUNTED_AGAIN = 0.1
"""Of the points' variance so much is in that of errors in common, too (`shared_errors`): what that finds in simulated
offices, where nothing is in common."""

LEVER_M = 4.0
"""Points are so far from the laser, about: what a turn moves them by."""

LEAST_RESPONSE, MOST_RESPONSE = 0.2, 1.0
"""Where the forces hardly answer to a shift there is too little to match."""


@dataclass(frozen=True, eq=False)
class PointError:
    """How far points err, and how the forces answer to a shift.

    Attributes:
        scatter_m: standard deviation of a point's force over its mean weight, metres.
        response: k above, of shifts along x and y and of turns, (3,).
    """

    scatter_m: float
    response: Floats

    @property
    def sigma_m(self) -> float:
        """Standard deviation of a point as shifts see it, metres."""
        return self.scatter_m / float(self.response[0])


def point_error(geometry: ScanGeometry, aligned: Alignment, threads: int | None = None) -> PointError:
    """How far errors of points move scans that were aligned.

    Args:
        geometry: of the scans that were aligned.
        aligned: their poses, and which were compared.
        threads: to compute with; by default all cores.
    """
    pairs = aligned.pairs
    reach, scale = geometry.reach_m(*REACH_M)[1], geometry.scale_m(*SCALE_M)[1]
    relative = between(aligned.poses[pairs.target], aligned.poses[pairs.source])
    counts = match_counts(geometry, pairs.offsets, pairs.target, relative, reach, scale, ALIKE, threads)
    weights = beam_weights(counts)

    def sums(shift: Floats) -> tuple[Floats, Floats, Floats]:
        second, _, first, totals = pair_sums(
            geometry, weights, pairs.source, pairs.target, relative + shift, reach, scale, ALIKE, threads=threads
        )
        return second, first, totals

    second, _, totals = sums(np.zeros(3))
    said = np.einsum("mii->i", second)
    weight, force_sq = float(totals[:, 1].sum()), float(totals[:, 4].sum())
    if not (said.min(initial=np.inf) > 0.0 and weight > 0.0):
        return PointError(aligned.sigma_m, np.ones(3))
    changed = np.empty(3)
    for axis, lever_m in enumerate((1.0, 1.0, LEVER_M)):
        shift = np.zeros(3)
        shift[axis] = 0.5 * aligned.sigma_m / lever_m
        changed[axis] = (sums(shift)[1] - sums(-shift)[1])[:, axis].sum() / (2.0 * shift[axis])
    along = (changed[0] + changed[1]) / (said[0] + said[1])  # the axes are those of scans, which look any way
    response = np.clip([along, along, changed[2] / said[2]], LEAST_RESPONSE, MOST_RESPONSE)
    return PointError(float(np.sqrt(0.5 * force_sq / weight)), response)


def with_point_error(aligned: Alignment, error: PointError) -> PoseGaussian:
    """The approximation of the posterior with points that err so much: the laser's part of it is scaled.

    The approximation is a Student's t, whose covariance is dof / (dof - 2) times its scale matrix.
    """
    gaussian = aligned.gaussian
    scale = (aligned.sigma_m / error.scatter_m) ** 2 * gaussian.dof / (gaussian.dof - 2.0) / (1.0 - COUNTED_AGAIN)
    laser = np.arange(len(gaussian.first)) < len(aligned.pairs)
    curvature = scale * error.response[:, None] * gaussian.curvature * error.response
    force = scale * error.response**2 * gaussian.force
    return replace(
        gaussian,
        curvature=np.where(laser[:, None, None], curvature, gaussian.curvature),
        force=np.where(laser[:, None], force, gaussian.force),
    )
