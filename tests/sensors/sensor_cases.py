"""Sensor models and distances on which the tests of this folder run."""

import numpy as np

import bayesmap as bm
from bayesmap.sensors.model import RangeLimits

LIMITS = RangeLimits(0.3, 8.0)

NOISES = {
    "gaussian": bm.Gaussian(0.2), "gaussian, growing": bm.Gaussian(0.05, 0.1), "student-t": bm.StudentT(0.2, 4.0),
    "student-t, growing": bm.StudentT(0.1, 2.5, 0.05), "cauchy": bm.StudentT(0.05, 1.0),
}  # fmt: skip
MIXTURES = {
    "mixture": bm.BeamMixture(),
    "mixture of wide noise": bm.BeamMixture(bm.Gaussian(0.7), 0.1, 0.2, 0.3, 1.5),
    "mixture of growing noise": bm.BeamMixture(bm.Gaussian(0.05, 0.1), 0.02, 0.0, 0.05, 0.1),
    "mixture of student-t": bm.BeamMixture(bm.StudentT(0.2, 3.0, 0.02), 0.05, 0.1, 0.2, 0.4),
    "mixture without objects": bm.BeamMixture(bm.Gaussian(0.1), 0.01, 0.3, 0.0),
}
ALL = NOISES | MIXTURES

DISTANCES = (0.0, 0.1, 0.3, 1.7, 7.9, 8.0, 8.5, np.inf)
"""At the sensor, below its least range, at it, inside, near its largest range, at it, above it, nothing."""


def jumps(d):
    """Where a mixture's density jumps, within the limits: at the wall."""
    return [d] if LIMITS.min_m < d < LIMITS.max_m else []


def density(sensor, z, d):
    """p(z | d) for an array of readings."""
    return np.exp(sensor.log_likelihood(np.asarray(z, dtype=float), np.float64(d), LIMITS))


def integral(sensor, d, edges):
    """The density's integral between neighbouring edges: 40-point Gauss-Legendre on 64 pieces of each."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    low, high = np.asarray(edges[:-1], dtype=float), np.asarray(edges[1:], dtype=float)
    fine = np.linspace(low, high, 65, axis=-1)
    a, b = fine[:, :-1, None], fine[:, 1:, None]
    return (density(sensor, (a + b) / 2 + (b - a) / 2 * nodes, d) * weights * (b - a) / 2).sum(axis=(1, 2))
