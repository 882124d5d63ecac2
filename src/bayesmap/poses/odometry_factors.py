"""Compute factors between key scans from the odometry that a log states; without odometry, from the front end.

`StatedOdometry.first_factors` takes the noise that the front end learnt; `fit_errors` fits it to aligned key scans.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from bayesmap.poses.alignment import Alignment
from bayesmap.poses.calibration import OdometryFit, compensate_lag, fit_odometry, motion_variances, stated_motions
from bayesmap.poses.front_end import UNKNOWN_SIGMA, Track
from bayesmap.poses.graph import Factors, PoseStudentT, relative_covariances
from bayesmap.poses.log_checks import correct_late_odometry
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats, between, chain_motions, compose, frame_jacobians, rotation, wrap_yaw
from bayesmap.space.scans import Scans

FRONT_END_INFORMATION = np.diag(1.0 / np.array([0.1, 0.1, np.radians(3.0)]) ** 2)  # of a link without odometry
UNKNOWN_MOTION_INFORMATION = np.diag(1.0 / UNKNOWN_SIGMA**2)  # keeps the segments of a broken path from drifting away
MEDIAN_MOTIONS = 7  # number of successive motions over which the median variance is computed


@dataclass(frozen=True, eq=False)
class StatedOdometry:
    """The robot's motion as a log states it."""

    poses: Floats  # stated poses, (S, 3)
    stamps_s: Floats | None  # stamps of the scans, seconds, (S,), or None
    motions: Floats  # motions from scan to scan in the earlier one's frame, (S - 1, 3)
    impossible: Mask  # mask of motions that no robot can have made, (S - 1,)
    used: bool  # False if motions are inferred from the scans alone

    def reversed_at(self, is_reversed: Mask) -> "StatedOdometry":
        """Return odometry with the motions before the scans of a mask, (S,), reversed."""
        if not (self.used and is_reversed.any()):
            return self
        motions = np.where(is_reversed[1:, None], self.motions * [-1.0, -1.0, 1.0], self.motions)
        poses = np.vstack([self.poses[:1], chain_motions(self.poses[0], motions)])
        return replace(self, poses=poses, motions=motions)

    def first_factors(self, track: Track, poses: Floats) -> Factors:
        """Return factors between key scans at poses (K, 3), with the noise that the front end has learnt."""
        if not self.used:
            return front_end_factors(track, poses)
        return self._factors(track, poses, track.slope, lambda motions: motion_variances(motions, track.noise_ratios))

    def fit_errors(self, track: Track, aligned: Alignment) -> tuple[OdometryFit | None, Factors]:
        """Return the fit of odometry's errors, None if it is not used, and factors without these errors."""
        poses = aligned.poses
        if not self.used:
            return None, front_end_factors(track, poses)
        order = np.arange(len(track.keys) - 1)
        covariance = relative_covariances(aligned.gaussian.precision, poses, order, order + 1)
        variance = np.diagonal(covariance, axis1=1, axis2=2)
        expected = np.vstack([np.zeros(3), motion_variances(self.motions, track.noise_ratios)])
        expected = np.diff(np.cumsum(expected, axis=0)[track.keys], axis=0)
        fit = fit_odometry(self.poses, self.stamps_s, poses, track.keys, variance, expected)
        return fit, self._factors(track, poses, fit.slope, fit.noise.variances, fit.lag_s)

    def with_systematic_error(
        self, gaussian: PoseStudentT, track: Track, fit: OdometryFit | None, factors: Factors
    ) -> PoseStudentT:
        """Return a Gaussian whose covariances hold the uncertainty of odometry's systematic error.
        This error is common to the whole path: where odometry alone knows the length of a corridor, all of the length
        may be wrong by some per cent. The ``factors`` of odometry must be the last terms of ``gaussian``.
        """
        if fit is None:
            return gaussian
        changes = np.where(self._is_unknown(track)[:, None], 0.0, fit.shifts(factors.relative))
        return replace(gaussian, by_odometry=gaussian.steps_from_changes(changes))

    def _factors(
        self, track: Track, poses: Floats, slope: Floats, variances: Callable[[Floats], Floats], lag_s: float = 0.0
    ) -> Factors:
        """Return factors between key scans at poses (K, 3), corrected for systematic error and lag.
        Over an impossible motion or a break of the path, a weak link at the keys' present poses is used instead.
        ``variances`` computes the variances of x, y and yaw of motions from scan to scan, (S - 1, 3).
        """
        from scipy.ndimage import median_filter

        motions = self.motions
        if lag_s != 0.0:
            late = compensate_lag(self.poses, self.stamps_s, lag_s)
            motions = between(late[:-1], late[1:])
        corrected = wrap_yaw(motions + motions @ slope.T)
        # Raise variances to the local median: noise that shortens a motion must not lower its variance.
        variance = variances(motions)
        variance = np.maximum(variance, median_filter(variance, size=(MEDIAN_MOTIONS, 1), mode="nearest"))
        links = compose_factors(corrected, np.asarray(variance), track.keys)
        return with_weak_links(links, poses, self._is_unknown(track))

    def _is_unknown(self, track: Track) -> Mask:
        """Select steps between key scans that hold an impossible motion or a break of the path, (K - 1,)."""
        n_unknown = np.concatenate([[0], np.cumsum(self.impossible | track.broken[1:])])
        return np.asarray(np.diff(n_unknown[track.keys]) > 0)


def stated_odometry(scans: Scans, geometry: ScanGeometry | None) -> StatedOdometry:
    """Return the odometry of scans in the order of time, with late poses corrected. Without geometry it is not used."""
    poses = scans.poses if geometry is None else correct_late_odometry(scans, geometry)
    motions, impossible = stated_motions(poses, scans.stamps_s)
    return StatedOdometry(poses, scans.stamps_s, motions, impossible, geometry is not None)


def front_end_factors(track: Track, poses: Floats) -> Factors:
    """Return weak links between key scans at the front end's poses, or over breaks at the keys' poses, (K, 3)."""
    keys = track.keys
    order = np.arange(len(keys) - 1)
    relative = between(track.poses[keys[:-1]], track.poses[keys[1:]])
    links = Factors(order, order + 1, relative, np.tile(FRONT_END_INFORMATION, (len(order), 1, 1)))
    return with_weak_links(links, poses, track.broken[keys[1:]])


def with_weak_links(links: Factors, poses: Floats, is_unknown: Mask) -> Factors:
    """Return links between key scans, those of a mask replaced by weak links at the keys' poses, (K, 3)."""
    relative = np.where(is_unknown[:, None], between(poses[:-1], poses[1:]), links.relative)
    information = np.where(is_unknown[:, None, None], UNKNOWN_MOTION_INFORMATION, links.information)
    return replace(links, relative=relative, information=information)


def compose_factors(motions: Floats, variances: Floats, keys: Indices) -> Factors:
    """Return factors between successive keys, from motions between scans and their variances, (S - 1, 3) each."""
    relative, covariance = np.zeros((len(keys) - 1, 3)), np.zeros((len(keys) - 1, 3, 3))
    # Step k adds the k-th motion after each key, for all keys at once.
    for k in range(int(np.diff(keys).max(initial=1))):
        number = keys[:-1] + k
        active = np.nonzero(number < keys[1:])[0]
        motion, variance = motions[number[active]], variances[number[active]]
        to_key = rotation(relative[active, 2])
        shift = frame_jacobians(relative[active, 2], motion)  # an earlier heading error shifts this motion's end
        covariance[active] = shift @ covariance[active] @ np.swapaxes(shift, 1, 2)
        covariance[active] += (to_key * variance[:, None, :]) @ np.swapaxes(to_key, 1, 2)
        relative[active] = compose(relative[active], motion)
    order = np.arange(len(keys) - 1)
    information = np.asarray(np.linalg.inv(covariance + np.eye(3) * 1e-9), np.float64)  # 1e-9: invertible
    return Factors(order, order + 1, wrap_yaw(relative), information)
