"""How far errors of points move poses: what robust matching claims of its own precision, held against the pairs.

Matching minimises a robust cost, and its second derivatives by Gauss and Newton, over the variance of what is left,
claim too much. A residual e pulls with the force psi = w e, which grows more slowly than e, and at last falls; and when
a scan moves, its points are paired with others, nearer ones. So of a shift the forces change by a share k < 1 of what
Gauss and Newton say. An M-estimator's variance is (Huber 1967), for a point, E[psi^2] / (k E[w])^2, of which each of
the two points of a pair has half. With noise of 1 cm k is 0.67, with 3 cm 0.57: among points that scatter as widely as
they are apart the nearest is seldom the same.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.line_pairs import pair_sums
from bayesmap.kernels.match_counts import match_counts
from bayesmap.poses.alignment import ALIKE, REACH_M, SCALE_M, Alignment, beam_weights
from bayesmap.poses.pose_gaussian import PoseGaussian
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import between

Floats = NDArray[np.float64]

COUNTED_AGAIN = 0.1
"""Of the points' variance so much is in that of errors in common, too (`shared_errors`): what that finds in simulated
offices, where nothing is in common."""

LEAST_RESPONSE, MOST_RESPONSE = 0.2, 1.0
"""Where the forces hardly answer to a shift there is too little to match."""


def point_error_m(geometry: ScanGeometry, aligned: Alignment, threads: int | None = None) -> float:
    """Standard deviation of a point, such that Gauss and Newton's curvature over its square has the right size, metres.

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
    step, changed, said = 0.5 * aligned.sigma_m, 0.0, 0.0
    for axis in (0, 1):
        shift = np.zeros(3)
        shift[axis] = step
        changed += float((sums(shift)[1] - sums(-shift)[1])[:, axis].sum()) / (2.0 * step)
        said += float(second[:, axis, axis].sum())
    weight, force_sq = float(totals[:, 1].sum()), float(totals[:, 4].sum())
    if not (said > 0.0 and weight > 0.0):
        return aligned.sigma_m
    response = float(np.clip(changed / said, LEAST_RESPONSE, MOST_RESPONSE))
    return float(np.sqrt(0.5 * force_sq / weight)) / response


def with_point_error(aligned: Alignment, error_m: float) -> PoseGaussian:
    """The approximation of the posterior with points that err so much: the laser's part of it is scaled.

    The approximation is a Student's t, whose covariance is dof / (dof - 2) times its scale matrix.
    """
    gaussian = aligned.gaussian
    scale = (aligned.sigma_m / error_m) ** 2 * gaussian.dof / (gaussian.dof - 2.0) / (1.0 - COUNTED_AGAIN)
    laser = np.arange(len(gaussian.first)) < len(aligned.pairs)
    return replace(
        gaussian,
        curvature=np.where(laser[:, None, None], scale * gaussian.curvature, gaussian.curvature),
        force=np.where(laser[:, None], scale * gaussian.force, gaussian.force),
    )
