"""The motions that odometry states between scans, and what is learnt about its errors on the way.

Errors of odometry are in part the same all the time: wheels of other sizes than assumed, a base of another width, a
laser beside the point that odometry follows. To first order all of these add a linear function of the stated motion,
``error = B motion``, which is found by recursive least squares as scans are matched. The rest is noise as that of
`bayesmap.poses.prior.Odometry`, whose size is estimated in the same pass.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.prior import Odometry
from bayesmap.space.planar import between, wrapped

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
"""Standard deviation of the entries of B before any motion was seen: 15 % of the motion."""


def stated_motions(poses: Floats, stamps_s: Floats | None) -> tuple[Floats, NDArray[np.bool_]]:
    """Motions from scan to scan in the earlier one's frame, (S - 1, 3), and which of them no robot can have made."""
    motions = between(poses[:-1], poses[1:])
    length = np.hypot(motions[:, 0], motions[:, 1])
    impossible = length > max(2.0, 20.0 * float(np.median(length)) if len(length) else 2.0)
    if stamps_s is not None and np.ptp(stamps_s) > 0:
        gap = np.maximum(np.diff(stamps_s), 0.0) + 0.3
        impossible |= length > FAST_M_PER_S * gap + 0.5
    return motions, impossible


class RunningOdometry:
    """The systematic error and the size of the noise, learnt from one matched motion after the other."""

    def __init__(self) -> None:
        self._normal = np.eye(3)
        self._moment = np.zeros((3, 3))
        self._squares = np.array([PRIOR_COUNT * FIRST_RATIO**2] * 2)
        self._count = PRIOR_COUNT
        self._slope: Floats = np.zeros((3, 3))

    @property
    def slope(self) -> Floats:
        """B: the mean error by the stated motion, (3, 3)."""
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
        return np.asarray((COMMON.sigmas(motions) * self.ratios[[0, 0, 1]]) ** 2)

    def learn(self, motion: Floats, found: Floats, laser_variance: Floats) -> None:
        """Take note of one motion: as stated, as matched, and the variances that matching leaves."""
        error = found - motion
        error[2] = wrapped(error[2])
        variance = self.variances(motion) + laser_variance
        rest = error - self._slope @ motion
        rest[2] = wrapped(rest[2])
        squared = rest**2 / variance
        if (squared < 16.0).all():
            weight = 1.0 / np.maximum(variance, 1e-6)
            scale = 1e-4  # what a unit of the normal matrix stands for: keeps the prior's SLOPE_SIGMA meaningful
            gain = float(np.exp(np.mean(np.log(weight)))) * scale
            self._normal += gain * np.outer(motion, motion) * SLOPE_SIGMA**2 / scale
            self._moment += gain * np.outer(error, motion) * SLOPE_SIGMA**2 / scale
            self._slope = np.asarray(np.linalg.solve(self._normal, self._moment.T).T, np.float64)
        base = COMMON.sigmas(motion) ** 2
        excess = np.maximum(rest**2 - laser_variance, 0.0) / base
        keep = 1.0 - 1.0 / MEMORY
        limit = 25.0 * self._squares / self._count
        self._squares = keep * self._squares + np.minimum([0.5 * (excess[0] + excess[1]), excess[2]], limit)
        self._count = keep * self._count + 1.0
