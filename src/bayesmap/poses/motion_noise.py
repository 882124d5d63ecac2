"""The noise of odometry whose variance grows with the way: it is the same whether a log has 1 scan a second or 10.

Over n scans, a way of d metres and turns of a radians in all (sizes added), the errors of x, y and yaw, in the frame
of the motion, have the variances

    v = per_m d + per_rad a + per_scan n.

So parts of a motion have variances that add up to that of the whole, as those of a random walk do. (The squares of
`bayesmap.poses.prior.Odometry` do not: ten short motions have a tenth of the variance of the one that they make.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.prior import Odometry

Floats = NDArray[np.float64]

USUAL = np.array([[1e-3, 1e-3, 1e-5], [5e-4, 5e-4, 1e-5], [1e-3, 2e-3, 1e-6]])
"""Of ordinary robots: rows x, y, yaw; columns per metre, per radian, per scan."""

FACTOR_SIGMA = np.log(10.0)
"""Standard deviation of the logarithm of each before any motion was seen: a factor of ten either way."""

TELLS, FEWEST = 0.5, 20
"""Motions known to so much of the usual variance are looked at; with fewer of them the usual noise is taken."""

DEGREES_OF_FREEDOM = 4.0
CONSISTENT = 1.2718
"""1 / E[(nu + 1) z^2 / (nu + z^2)] for a standard normal z and nu = 4."""


@dataclass(frozen=True, eq=False)
class MotionNoise:
    """Variances of x, y and yaw (rows) per metre, per radian and per scan (columns), (3, 3)."""

    rates: Floats

    def variances(self, motions: Floats) -> Floats:
        """Variances of x, y and yaw of each motion from scan to scan, (..., 3)."""
        ways, turns = np.hypot(motions[..., 0], motions[..., 1]), np.abs(motions[..., 2])
        return self.over(ways, turns, np.ones_like(ways))

    def over(self, ways_m: Floats, turns_rad: Floats, scans: Floats) -> Floats:
        """Variances of x, y and yaw over ways, turns and numbers of scans, (..., 3)."""
        return np.asarray(_features(ways_m, turns_rad, scans) @ self.rates.T)

    def of_scans(self, motions: Floats) -> Odometry:
        """The noise as that of single motions from scan to scan, which are given, (S - 1, 3)."""
        ways, turns = np.hypot(motions[:, 0], motions[:, 1]), np.abs(motions[:, 2])
        # Such that squares summed over the scans are what rates summed over the way are.
        per_m = ways.sum() / max(float((ways**2).sum()), 1e-12)
        per_rad = turns.sum() / max(float((turns**2).sum()), 1e-12)
        place, yaw = self.rates[:2].mean(axis=0), self.rates[2]
        return Odometry(
            float(np.sqrt(place[0] * per_m)), float(np.sqrt(place[1] * per_rad)), float(np.sqrt(yaw[0] * per_m)),
            float(np.sqrt(yaw[1] * per_rad)), float(np.sqrt(place[2])), float(np.sqrt(yaw[2])),
        )  # fmt: skip


def fit_noise(errors: Floats, ways_m: Floats, turns_rad: Floats, scans: Floats, known_variance: Floats) -> MotionNoise:
    """The noise that explains some errors best, by maximum likelihood under a wide prior.

    The cost of an error e of variance v is log v / 2 + 1.27 (nu + 1) / 2 log(1 + e^2 / (nu v)), Student's t with
    nu = 4 made consistent for the normal distribution: slips do not decide.

    Args:
        errors: of M motions, x, y and yaw, (M, 3).
        ways_m: of the same motions, (M,).
        turns_rad: sizes of their turns added up, (M,).
        scans: how many motions from scan to scan each is made of, (M,).
        known_variance: what errors contain besides odometry's, (M, 3).
    """
    features = _features(ways_m, turns_rad, scans)
    rates = USUAL.copy()
    for axis in range(3):
        # Where the motion is known hardly better than by odometry, it says nothing about odometry.
        tells = known_variance[:, axis] < TELLS * (features @ USUAL[axis])
        if tells.sum() >= FEWEST:
            rates[axis] = _rates(errors[tells, axis], features[tells], known_variance[tells, axis], USUAL[axis])
    return MotionNoise(rates)


def _rates(errors: Floats, features: Floats, known_variance: Floats, usual: Floats) -> Floats:
    """The rates of one axis, (3,), by L-BFGS in their logarithms."""
    from scipy.optimize import minimize

    nu = DEGREES_OF_FREEDOM

    def cost(log_factors: Floats) -> tuple[float, Floats]:
        rates = usual * np.exp(log_factors)
        variance = features @ rates + known_variance
        ratio = errors**2 / (nu * variance)
        slope = 0.5 / variance - 0.5 * CONSISTENT * (nu + 1.0) * ratio / (1.0 + ratio) / variance
        value = 0.5 * np.log(variance).sum() + 0.5 * CONSISTENT * (nu + 1.0) * np.log1p(ratio).sum()
        prior = log_factors / FACTOR_SIGMA
        return float(value + 0.5 * (prior**2).sum()), (slope @ features) * rates + prior / FACTOR_SIGMA

    found = minimize(cost, np.zeros(3), jac=True, method="L-BFGS-B", bounds=[(-9.0, 9.0)] * 3)
    return np.asarray(usual * np.exp(found.x))


def _features(ways_m: Floats, turns_rad: Floats, scans: Floats) -> Floats:
    return np.stack([ways_m, turns_rad, scans], axis=-1).astype(np.float64)
