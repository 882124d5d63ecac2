"""Placement of the scans between key scans: each is refined against the key scans that see the same walls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import match_counts, pair_sums
from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.poses.alignment import ALIKE, Alignment, PointError, without_slack
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, bracketing_indices, nearest_index, rotation

MAX_COMPARED = 10  # key scans that each scan is compared with
PRIOR_SIGMA = np.array([0.03, 0.03, np.radians(1.0)])  # sigmas of a scan before its beams are used
CAUTION = 2.0  # factor on the scatter of points during refinement: rough first steps stay near the prior
MIN_SIGMA_M = 0.005  # least scatter of points during refinement
MAX_STEPS = 10  # most steps of a refinement
REACH_M = (0.2, 0.08)  # largest distance of paired points: first step, last step
SCALE_M = (0.1, 0.03)  # distance from which points count as outliers: first step, last step


@dataclass(frozen=True, eq=False)
class Placement:
    """Poses of all scans."""

    poses: Floats  # (S, 3)
    information: Floats  # of each pose given the key scans, in its own frame, (S, 3, 3)
    explained: Floats  # share of each scan's points on walls of compared key scans, (S,); 1 for key scans

    def own_covariance(self, keys: NDArray[np.intp]) -> Floats:
        """Return the scale matrix of Student's t of each scan's pose given the key scans, (S, 3, 3); zero for keys."""
        covariance = np.linalg.inv(self.information + np.diag(1.0 / PRIOR_SIGMA**2))
        covariance[keys] = 0.0
        return np.asarray(covariance)


def place_scans(
    geometry: ScanGeometry, poses: Floats, keys: NDArray[np.intp], aligned: Alignment, error: PointError
) -> Placement:
    """Refine every scan against the partners of the key scan nearest to it in time; key scans keep their poses. The S
    poses to start from are those of all scans, (S, 3), and ``aligned`` holds the key scans alone.
    """
    count = len(poses)
    key_poses = aligned.poses
    scans = np.setdiff1d(np.arange(count), keys)
    result, information, explained = poses.copy(), np.zeros((count, 3, 3)), np.ones(count)
    result[keys] = key_poses
    if not len(scans):
        return Placement(result, information, explained)
    # Refine all scans at once; each starts at its pose, which is also the mean of its prior.
    offsets, compared = compared_keys(scans, keys, aligned)
    targets = keys[compared].astype(np.int32)
    starts = poses[scans]
    prior = np.diag(1.0 / PRIOR_SIGMA**2)
    turn = rotation(poses[scans, 2])
    reach, scale = geometry.reach_m(*REACH_M), geometry.scale_m(*SCALE_M)
    refinement = Refinement(
        scans.astype(np.int32), offsets, targets, key_poses[compared], starts, starts,
        turn @ prior @ np.swapaxes(turn, 1, 2),
    )  # fmt: skip
    convergence = Convergence(CAUTION * max(aligned.sigma_m, MIN_SIGMA_M), MAX_STEPS, reach, scale, ALIKE)
    refined, _, _ = refine_scans(geometry, refinement, convergence, geometry.threads)
    result[scans] = refined
    # The information of each pair of scans, and its sum over the pairs of a scan.
    source = np.repeat(scans, np.diff(offsets)).astype(np.int32)
    relative = between(key_poses[compared], result[source])
    pair_information, shares = _information(geometry, source, targets, relative, reach[1], scale[1], error)
    information[scans] = np.add.reduceat(pair_information, offsets[:-1], axis=0)
    explained[scans] = shares[scans]
    return Placement(result, information, explained)


def compared_keys(
    scans: NDArray[np.intp], keys: NDArray[np.intp], aligned: Alignment
) -> tuple[NDArray[np.int32], NDArray[np.intp]]:
    """Select the key scans that each scan is compared with, as numbers among the keys.

    They are the key scans before and after the scan, and partners of the nearer one. Scan i has the entries from
    ``offsets[i]`` to ``offsets[i + 1]``. Returns the offsets, and the key scans of all scans.
    """
    before, after = bracketing_indices(keys, scans)
    nearer = nearest_index(keys, scans)
    farther = np.where(nearer == before, after, before)
    pairs = aligned.pairs
    of_key = []
    for k in range(len(keys)):
        partners = pairs.target[pairs.offsets[k] : pairs.offsets[k + 1]]
        of_key.append(np.concatenate([[k], _spread(partners, MAX_COMPARED - 2)]).astype(np.int32))
    of_scan = [np.union1d(of_key[near], [far]) for near, far in zip(nearer, farther, strict=True)]
    offsets = np.concatenate([[0], np.cumsum([len(compared) for compared in of_scan])]).astype(np.int32)
    return offsets, np.concatenate(of_scan).astype(np.intp)


def _information(
    geometry: ScanGeometry, source: NDArray[np.int32], target: NDArray[np.int32], relative: Floats, reach_m: float,
    scale_m: float, error: PointError,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Return the information of M pairs' points about the source scan's pose, in its frame, (M, 3, 3).

    The second result is the share of each scan's points that any of its pairs explains, (S,). A point that fits one
    wall well, or several walls half, counts fully. Points that lie out of sight of one key scan may be seen by another.

    The target scan's pose is known. Relative poses, (M, 3), are those of sources in the frames of targets, and pairs
    are sorted by source. A beam that is matched with c scans has its own error once and the mean of c others':
    sigma^2 (1 + 1 / c), so that it counts 1 / (c + 1) in each pair.
    """
    offsets = np.searchsorted(source, np.arange(len(geometry) + 1)).astype(np.int32)
    counts = match_counts(geometry, offsets, target, relative, reach_m, scale_m, ALIKE, threads=geometry.threads)
    weights = (1.0 / (1.0 + counts)).astype(np.float32)
    hessian, slack, gradient, _ = pair_sums(
        geometry, weights, source, target, relative, reach_m, scale_m, ALIKE, threads=geometry.threads
    )
    in_target = without_slack(hessian, slack, gradient, error.scatter_m)[0] / error.scatter_m**2
    turn = rotation(relative[:, 2])
    in_source = np.swapaxes(turn, 1, 2) @ in_target @ turn
    points = np.maximum((geometry.host_kind > 0).sum(axis=1), 1)
    explained = np.minimum(counts, 1.0).sum(axis=1) / points
    return np.asarray(error.response[:, None] * in_source * error.response), np.asarray(explained, np.float64)


def _spread(partners: NDArray[np.int32], most: int) -> NDArray[np.int32]:
    """Select ``most`` partners evenly from the list, which is sorted by time class and overlap."""
    if len(partners) <= most:
        return partners
    return partners[np.arange(most) * len(partners) // most]
