"""Odometry as the log states it, and its factors between key scans; where there is none, those of the front end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.alignment import Alignment
from bayesmap.poses.calibration import OdometryFit, fit_odometry, motion_variances, stated_at, stated_motions
from bayesmap.poses.front_end import UNKNOWN, Track
from bayesmap.poses.graph import Factors, relative_covariances
from bayesmap.poses.log_checks import caught_up
from bayesmap.poses.next_scans import chained
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import between, compose, wrapped
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

STEADY = np.diag(1.0 / np.array([0.1, 0.1, np.radians(3.0)]) ** 2)
"""How firmly, without odometry, the front end's own links hold."""


NEIGHBOURS = 7
"""Successive motions of which the median variance is taken."""

GUESSED = np.diag(1.0 / UNKNOWN**2)
"""How firmly a link holds that nothing is known of: it keeps parts of the path from drifting away."""


@dataclass(frozen=True, eq=False)
class StatedOdometry:
    """What a log states of the robot's motion.

    Attributes:
        poses: as stated, (S, 3).
        stamps_s: of the scans, (S,), or None.
        motions: from scan to scan in the earlier one's frame, (S - 1, 3).
        impossible: motions that no robot can have made, (S - 1,).
        used: False where the robot's motion is to be found from the scans alone.
    """

    poses: Floats
    stamps_s: Floats | None
    motions: Floats
    impossible: NDArray[np.bool_]
    used: bool

    @property
    def used_motions(self) -> Floats | None:
        """The motions, (S - 1, 3); None where they are not used."""
        return self.motions if self.used else None

    def reversed_at(self, against: NDArray[np.bool_]) -> StatedOdometry:
        """Return odometry with the motions before some scans, (S,), the other way round."""
        if not (self.used and against.any()):
            return self
        motions = np.where(against[1:, None], self.motions * [-1.0, -1.0, 1.0], self.motions)
        poses = np.vstack([self.poses[:1], chained(self.poses[0], motions)])
        return replace(self, poses=poses, motions=motions)

    def first_factors(self, track: Track, poses: Floats) -> Factors:
        """Return factors between key scans at some poses, (K, 3), with what the front end learnt of the noise."""
        if not self.used:
            return chain_factors(track, poses)
        return self._corrected(track, poses, track.slope, lambda motions: motion_variances(motions, track.noise_ratios))

    def fitted(self, track: Track, aligned: Alignment) -> tuple[OdometryFit | None, Factors]:
        """Return the errors of odometry by aligned key scans, None where it is not used, and factors without them."""
        poses = aligned.poses
        if not self.used:
            return None, chain_factors(track, poses)
        order = np.arange(len(track.keys) - 1)
        covariance = relative_covariances(aligned.gaussian.precision, poses, order, order + 1)
        variance = np.diagonal(covariance, axis1=1, axis2=2)
        fit = fit_odometry(self.poses, self.stamps_s, poses, track.keys, variance)
        return fit, self._corrected(track, poses, fit.slope, fit.noise.variances, fit.lag_s)

    def _corrected(
        self, track: Track, poses: Floats, slope: Floats, noise: Callable[[Floats], Floats], lag_s: float = 0.0
    ) -> Factors:
        """Return factors between key scans, but where a motion was refused or the path breaks."""
        return corrected_factors(
            self.poses, self.stamps_s, self.motions, self.impossible | track.broken[1:], track.keys, poses, slope,
            noise, lag_s,
        )  # fmt: skip


def stated_odometry(scans: Scans, geometry: ScanGeometry | None, threads: int | None = None) -> StatedOdometry:
    """Return the odometry of scans in the order of time, late poses mended; without a geometry it is not used."""
    poses = scans.poses if geometry is None else caught_up(scans, geometry, threads)
    motions, impossible = stated_motions(poses, scans.stamps_s)
    return StatedOdometry(poses, scans.stamps_s, motions, impossible, geometry is not None)


def chain_factors(track: Track, poses: Floats) -> Factors:
    """Weak links from key scan to key scan as the front end found them; where it broke, as the keys are, (K, 3)."""
    keys = track.keys
    order = np.arange(len(keys) - 1)
    relative = between(track.poses[keys[:-1]], track.poses[keys[1:]])
    links = Factors(order, order + 1, relative, np.tile(STEADY, (len(order), 1, 1)))
    return guessed(links, poses, track.broken[keys[1:]])


def guessed(links: Factors, poses: Floats, where: NDArray[np.bool_]) -> Factors:
    """Links from key scan to key scan; some replaced by where the keys are, (K, 3), as if hardly anything was known."""
    relative, information = links.relative.copy(), links.information.copy()
    relative[where] = between(poses[:-1][where], poses[1:][where])
    information[where] = GUESSED
    return Factors(links.first, links.second, relative, information)


def corrected_factors(
    stated: Floats,
    stamps_s: Floats | None,
    motions: Floats,
    rejected: NDArray[np.bool_],
    keys: NDArray[np.intp],
    poses: Floats,
    slope: Floats,
    variances: Callable[[Floats], Floats],
    lag_s: float = 0.0,
) -> Factors:
    """Odometry from key scan to key scan, corrected for its systematic error and its lag.

    Where a stated motion is rejected, (S - 1,), the keys' present poses, (K, 3), hold loosely. ``variances`` gives
    those of x, y and yaw, (S - 1, 3), of stated motions from scan to scan, (S - 1, 3).
    """
    if lag_s != 0.0:
        late = stated_at(stated, stamps_s, lag_s)
        motions = between(late[:-1], late[1:])
    corrected = motions + motions @ slope.T
    corrected[:, 2] = wrapped(corrected[:, 2])
    lost = np.concatenate([[0], np.cumsum(rejected)])
    return guessed(composed(corrected, _steadied(variances(motions)), keys), poses, lost[keys[1:]] > lost[keys[:-1]])


def _steadied(variances: Floats) -> Floats:
    """Return the variances of successive motions, (N, 3), each at least the median of those about it.

    Noise grows with the true way, so a motion that noise has made too short is stated with too small a variance.
    """
    from scipy.ndimage import median_filter

    return np.asarray(np.maximum(variances, median_filter(variances, size=(NEIGHBOURS, 1), mode="nearest")))


def composed(motions: Floats, variances: Floats, keys: NDArray[np.intp]) -> Factors:
    """Motions from scan to scan composed to factors from each key scan to the next; variances add up along the way.

    Args:
        motions: from scan to scan, corrected, (S - 1, 3).
        variances: of x, y and yaw of each motion, (S - 1, 3).
        keys: indices of the keys, (K,).
    """
    relative, covariance = np.zeros((len(keys) - 1, 3)), np.zeros((len(keys) - 1, 3, 3))
    longest = int(np.diff(keys).max(initial=1))
    for k in range(longest):
        at = keys[:-1] + k
        active = np.nonzero(at < keys[1:])[0]
        motion, variance = motions[at[active]], variances[at[active]]
        yaw = relative[active, 2]
        cosine, sine = np.cos(yaw), np.sin(yaw)
        turn = np.zeros((len(active), 3, 3))
        turn[:, 0, 0] = turn[:, 1, 1] = cosine
        turn[:, 0, 1], turn[:, 1, 0], turn[:, 2, 2] = -sine, sine, 1.0
        lever = np.tile(np.eye(3), (len(active), 1, 1))  # an earlier heading error moves what comes after
        lever[:, 0, 2] = -(sine * motion[:, 0] + cosine * motion[:, 1])
        lever[:, 1, 2] = cosine * motion[:, 0] - sine * motion[:, 1]
        covariance[active] = lever @ covariance[active] @ np.swapaxes(lever, 1, 2)
        covariance[active] += (turn * variance[:, None, :]) @ np.swapaxes(turn, 1, 2)
        relative[active] = compose(relative[active], motion)
    relative[:, 2] = wrapped(relative[:, 2])
    order = np.arange(len(keys) - 1)
    return Factors(order, order + 1, relative, np.asarray(np.linalg.inv(covariance + np.eye(3) * 1e-9), np.float64))
