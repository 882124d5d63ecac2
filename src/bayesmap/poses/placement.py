"""Scans between key scans, placed among them: each refined against the key scans that see the same walls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import match_counts, pair_sums
from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.poses.alignment import ALIKE, Pairs, PointError, without_slack
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import around, between, nearest, rotation

Floats = NDArray[np.float64]

COMPARED = 10
"""Key scans that each scan is compared with."""

PRIOR_SIGMA = np.array([0.03, 0.03, np.radians(1.0)])
"""Standard deviations of where a scan lies between the key scans around it, before its own beams are looked at."""

CAUTION, LEAST_SIGMA_M = 2.0, 0.005
"""Points count as if they scattered so many times as widely, and by at least so much, beside what lies between the key
scans: the rough first steps then stay near it. What the beams tell in the end is counted with their own scatter."""

REACH_M, SCALE_M = (0.2, 0.08), (0.1, 0.03)
"""How far paired points may lie apart and the scale of outliers, in the first step and the last."""


@dataclass(frozen=True, eq=False)
class Placement:
    """Poses of all scans.

    Attributes:
        poses: (S, 3).
        information: of each pose given the key scans, in its own frame, (S, 3, 3).
        matched: share of the points that fall into the other scans' view and lie on their walls, (S,).
    """

    poses: Floats
    information: Floats
    matched: Floats

    def own_covariance(self, keys: NDArray[np.intp]) -> Floats:
        """Scale matrix of a Student's t of each scan's pose given the key scans, (S, 3, 3); zero for those."""
        covariance = np.linalg.inv(self.information + np.diag(1.0 / PRIOR_SIGMA**2))
        covariance[keys] = 0.0
        return np.asarray(covariance)


def place_scans(
    geometry: ScanGeometry,
    poses: Floats,
    keys: NDArray[np.intp],
    key_poses: Floats,
    pairs: Pairs,
    sigma_m: float,
    error: PointError,
    *,
    threads: int | None = None,
) -> Placement:
    """Refine every scan against the partners of the key scan nearest to it in time.

    Args:
        geometry: of all S scans.
        poses: of all scans, to start from, (S, 3).
        keys: the key scans, (K,).
        key_poses: (K, 3); the poses of key scans are kept.
        pairs: the partners of each key scan, as positions among the keys.
        sigma_m: standard deviation of a point.
        error: how far points move scans.
        threads: to compute with; by default all cores.
    """
    count = len(poses)
    scans = np.setdiff1d(np.arange(count), keys)
    result, information, matched = poses.copy(), np.zeros((count, 3, 3)), np.ones(count)
    result[keys] = key_poses
    if not len(scans):
        return Placement(result, information, matched)
    before, after = around(keys, scans)
    near = nearest(keys, scans)
    other = np.where(near == before, after, before)
    compared = []
    for k in range(len(keys)):
        partners = pairs.target[pairs.offsets[k] : pairs.offsets[k + 1]]
        compared.append(np.concatenate([[k], _spread(partners, COMPARED - 2)]).astype(np.int32))
    lists = [np.union1d(compared[n], [o]) for n, o in zip(near, other, strict=True)]
    offsets = np.concatenate([[0], np.cumsum([len(one) for one in lists])]).astype(np.int32)
    flat = np.concatenate(lists).astype(np.intp)
    prior = np.diag(1.0 / PRIOR_SIGMA**2)
    turn = rotation(poses[scans, 2])
    reach, scale = geometry.reach_m(*REACH_M), geometry.scale_m(*SCALE_M)
    refinement = Refinement(
        scans.astype(np.int32), offsets, keys[flat].astype(np.int32), key_poses[flat], poses[scans], poses[scans],
        turn @ prior @ np.swapaxes(turn, 1, 2),
    )  # fmt: skip
    convergence = Convergence(CAUTION * max(sigma_m, LEAST_SIGMA_M), 10, reach, scale, ALIKE)
    found, _, totals = refine_scans(geometry, refinement, convergence, threads)
    result[scans] = found
    source = np.repeat(scans, np.diff(offsets)).astype(np.int32)
    per_pair = _information(
        geometry, source, keys[flat].astype(np.int32), between(key_poses[flat], result[source]), reach[1], scale[1],
        error, threads,
    )  # fmt: skip
    information[scans] = np.add.reduceat(per_pair, offsets[:-1], axis=0)
    matched[scans] = totals[:, 2] / np.maximum(totals[:, 3], 1.0)
    return Placement(result, information, matched)


def _information(
    geometry: ScanGeometry,
    source: NDArray[np.int32],
    target: NDArray[np.int32],
    relative: Floats,
    reach_m: float,
    scale_m: float,
    error: PointError,
    threads: int | None,
) -> Floats:
    """What the points of each pair of scans tell of the first's pose, in its own frame, the other's known, (M, 3, 3).

    A beam that is matched with c scans has its own error once and the mean of c others': sigma^2 (1 + 1 / c), so that
    it counts 1 / (c + 1) in each pair. Poses of pairs are
    relative: the first's in the frame of the second, (M, 3); pairs are sorted by the first.
    """
    offsets = np.searchsorted(source, np.arange(len(geometry) + 1)).astype(np.int32)
    counts = match_counts(geometry, offsets, target, relative, reach_m, scale_m, ALIKE, threads)
    weights = (1.0 / (1.0 + counts)).astype(np.float32)
    second, slack, first, _ = pair_sums(
        geometry, weights, source, target, relative, reach_m, scale_m, ALIKE, threads=threads
    )
    told = without_slack(second, slack, first, error.scatter_m)[0] / error.scatter_m**2
    turn = rotation(relative[:, 2])
    own = np.swapaxes(turn, 1, 2) @ told @ turn
    return np.asarray(error.response[:, None] * own * error.response)


def _spread(partners: NDArray[np.int32], most: int) -> NDArray[np.int32]:
    """At most so many, evenly over the list: it is sorted by time class and overlap."""
    if len(partners) <= most:
        return partners
    return partners[np.arange(most) * len(partners) // most]
