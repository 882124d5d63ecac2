"""The motions that odometry states between scans, and what is learnt about its errors on the way.

Errors of odometry are in part the same all the time: wheels of other sizes than assumed, a base of another width, a
laser beside the point that odometry follows. To first order all of these make odometry state ``(1 + C) motion``, and C
is found by recursive least squares from key scan to key scan, where matching errs less than odometry. The rest is noise
as that of `bayesmap.poses.prior.Odometry`, whose size is estimated in the same pass from scan to scan.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.prior import Odometry
from bayesmap.space.planar import between, wrapped
from bayesmap.space.time_order import elapsed_s

Floats = NDArray[np.float64]

FAST_M_PER_S = 3.0
FAST_RAD_PER_S = 3.0
"""Faster motions are not believed of a robot: their noise is as large as they are."""

COMMON = Odometry(0.1, 0.05, 0.05, 0.1, 0.01, 0.01)
"""Noise of ordinary robots; what is estimated is how many times larger the one at hand is."""

FIRST_RATIO = 3.0
"""Noise is taken to be so many times that of ordinary robots until the data say otherwise."""

PRIOR_COUNT = 12.0
MEMORY = 300.0
"""Motions over which the size of the noise is averaged: floors differ."""

SLOPE_SIGMA = 0.15
"""Standard deviation of the entries of C before any motion was seen: 15 % of the motion."""


def stated_motions(poses: Floats, stamps_s: Floats | None) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the motions from scan to scan in the earlier one's frame, (S - 1, 3), and which no robot can have made.

    Where stamps repeat, a motion is impossible if it is too fast for the longest time that the stamps allow, or if it
    is much longer than usual and too fast for the shortest.
    """
    motions = between(poses[:-1], poses[1:])
    length = np.hypot(motions[:, 0], motions[:, 1])
    unusual = length > max(2.0, 20.0 * float(np.median(length)) if len(length) else 2.0)
    if stamps_s is None:
        return motions, unusual
    least_s, most_s = elapsed_s(stamps_s)
    return motions, (length > _farthest_m(most_s)) | (unusual & (length > _farthest_m(least_s)))


def _farthest_m(elapsed: Floats) -> Floats:
    return np.asarray(FAST_M_PER_S * (elapsed + 0.3) + 0.5)


def variances(motions: Floats, ratios: Floats) -> Floats:
    """Variances of x, y and yaw, (..., 3), of odometry so many times noisier than `COMMON`: position and heading.

    A heading that is off half-way moves what comes after: over a long motion, as where scans are missing, that counts.
    """
    variance = (COMMON.sigmas(motions) * ratios[[0, 0, 1]]) ** 2
    lever_m = 0.5 * np.hypot(motions[..., 0], motions[..., 1])
    variance[..., :2] += (lever_m**2 * variance[..., 2])[..., None]
    return np.asarray(variance)


def inverse_slope(systematic: Floats) -> Floats:
    """1 / (1 + C) - 1, (3, 3): what corrects a motion that is stated as (1 + C) times what it is."""
    return np.asarray(np.linalg.inv(np.eye(3) + systematic) - np.eye(3))


class RunningOdometry:
    """The systematic error and the size of the noise, learnt from one matched motion after the other."""

    def __init__(self) -> None:
        self._normal = np.eye(3)
        self._moment = np.zeros((3, 3))
        self._squares = np.array([PRIOR_COUNT * FIRST_RATIO**2] * 2)
        self._count = PRIOR_COUNT
        self._systematic: Floats = np.zeros((3, 3))
        self._slope: Floats = np.zeros((3, 3))

    @property
    def slope(self) -> Floats:
        """B = 1 / (1 + C) - 1: what to add to a stated motion, by the stated motion, (3, 3)."""
        return self._slope

    @property
    def ratios(self) -> Floats:
        """How many times larger than `COMMON` the noise is: of the position, and of the heading."""
        return np.asarray(np.clip(np.sqrt(self._squares / self._count), 0.5, 30.0))

    def corrected(self, motions: Floats) -> Floats:
        """Stated motions plus their mean errors, (..., 3)."""
        out = motions + motions @ self._slope.T
        out[..., 2] = wrapped(out[..., 2])
        return out

    def variances(self, motions: Floats) -> Floats:
        """Variances of x, y and yaw of each motion's remaining error, (..., 3)."""
        return variances(motions, self.ratios)

    def learn_slope(self, stated: Floats, found: Floats, laser_variance: Floats) -> None:
        """Take note of the systematic error of one motion of some length: as stated and as matched, (3,) each."""
        error = stated - found
        error[2] = wrapped(error[2])
        variance = self.variances(stated) + laser_variance
        rest = error - self._systematic @ found
        rest[2] = wrapped(rest[2])
        if not (rest**2 < 16.0 * variance).all():
            return
        # One weight for the three: the entries of C share a normal matrix.
        gain = float(np.exp(-np.mean(np.log(np.maximum(variance, 1e-6))))) * SLOPE_SIGMA**2
        self._normal += gain * np.outer(found, found)
        self._moment += gain * np.outer(error, found)
        self._systematic = np.asarray(np.linalg.solve(self._normal, self._moment.T).T, np.float64)
        self._slope = inverse_slope(self._systematic)

    def learn_noise(self, motion: Floats, found: Floats, laser_variance: Floats) -> None:
        """Take note of the noise of one motion from scan to scan: as stated and as matched, (3,) each."""
        rest = found - motion - self._slope @ motion
        rest[2] = wrapped(rest[2])
        base = COMMON.sigmas(motion) ** 2
        excess = np.maximum(rest**2 - laser_variance, 0.0) / base
        keep = 1.0 - 1.0 / MEMORY
        limit = 25.0 * self._squares / self._count
        self._squares = keep * self._squares + np.minimum([0.5 * (excess[0] + excess[1]), excess[2]], limit)
        self._count = keep * self._count + 1.0
