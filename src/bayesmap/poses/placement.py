"""Scans between key scans, placed among them: each refined against the key scans that see the same walls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.scan_refinement import refine_scans
from bayesmap.poses.alignment import ALIKE, Pairs
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.poses.se2 import rotation
from bayesmap.space.planar import around, nearest

Floats = NDArray[np.float64]

COMPARED = 10
"""Key scans that each scan is compared with."""

PRIOR_SIGMA = np.array([0.03, 0.03, np.radians(1.0)])
"""Standard deviations of where a scan lies between the key scans around it, before its own beams are looked at."""


CAUTION, LEAST_SIGMA_M = 2.0, 0.005
"""Points count as if they scattered so many times as widely beside what lies between the key scans: the rough first
steps then stay near it. What the beams tell in the end is counted with their own scatter, of at least so much."""


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
        """Covariance of each scan's pose given the key scans, (S, 3, 3); zero for those."""
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
    found, laser_information, totals = refine_scans(
        geometry, None, scans.astype(np.int32), offsets, keys[flat].astype(np.int32), key_poses[flat], poses[scans],
        poses[scans], turn @ prior @ np.swapaxes(turn, 1, 2), CAUTION * max(sigma_m, LEAST_SIGMA_M), 10,
        geometry.reach_m(0.2, 0.08), geometry.scale_m(0.1, 0.03), ALIKE, threads=threads,
    )  # fmt: skip
    back = rotation(found[:, 2])
    result[scans] = found
    information[scans] = CAUTION**2 * np.swapaxes(back, 1, 2) @ laser_information @ back
    matched[scans] = totals[:, 2] / np.maximum(totals[:, 3], 1.0)
    return Placement(result, information, matched)


def _spread(partners: NDArray[np.int32], most: int) -> NDArray[np.int32]:
    """At most so many, evenly over the list: it is sorted by time class and overlap."""
    if len(partners) <= most:
        return partners
    return partners[np.arange(most) * len(partners) // most]
