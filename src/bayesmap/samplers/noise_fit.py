"""The likeliest noise of readings about where their beams stopped: its scale, its growth, and how heavy its tails are.

Real readings scatter more at times than a normal law allows: poses are off by more in one scan than in another, walls
are hit at a slant, and an edge is half wall and half what lies behind it. Student's t is a mixture of normal laws of
all scales, and with many degrees of freedom normal itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from bayesmap.sensors.noise import AdditiveNoise, noise_with

SHAPES = (3.0, 5.0, 9.0, 17.0, math.inf)
"""Degrees of freedom that are tried, infinitely many for normal noise: of odd numbers kernels need no logarithm."""
LEAST_SCALE_M = 1e-3
LEAST_GROWTH = 1e-6
FIRST_STEP, CLOSE = 0.1, 1e-3
"""Of the search, in logarithms: where it looks first, and how close to the likeliest it comes."""
LEAST_WEIGHT = 10.0
"""Readings that it takes to change anything."""


@dataclass(frozen=True, eq=False)
class Residuals:
    """Readings of beams that were stopped, (N,) each.

    Attributes:
        residual_m: reading less where the beam was stopped.
        distance_m: where that was.
        variance: of the surface along the beam, which adds to the noise's, square metres.
        weight: the chance that the reading came from there.
    """

    residual_m: NDArray[np.float64]
    distance_m: NDArray[np.float64]
    variance: NDArray[np.float64]
    weight: NDArray[np.float64]

    def cost(self, dof: float, scale_m: float, per_m: float) -> float:
        """Mean negative log density of a noise whose scale is sqrt((scale_m + per_m distance)^2 + variance)."""
        scale = np.sqrt((scale_m + per_m * self.distance_m) ** 2 + self.variance)
        log_density = noise_with(dof, 1.0, 0.0).log_density(self.residual_m / scale) - np.log(scale)
        return float(-(self.weight * log_density).sum() / self.weight.sum())

    def likeliest(self, dof: float, scale_m: float, per_m: float) -> tuple[float, NDArray[np.float64]]:
        """The least cost of a shape, and the logarithms of its scale and growth, from those given on."""
        first = np.log([scale_m, max(per_m, 1e-5)])
        found = scipy.optimize.minimize(
            lambda logs: self.cost(dof, *np.exp(logs)),
            first,
            method="Nelder-Mead",  # of two numbers as fast as any, and without the threads of linear algebra
            bounds=[(math.log(LEAST_SCALE_M), math.log(10.0)), (math.log(LEAST_GROWTH), 0.0)],
            options={"initial_simplex": first + FIRST_STEP * np.eye(3, 2, -1), "xatol": CLOSE, "fatol": CLOSE**2},
        )
        return float(found.fun), found.x


def refit_noise(noise: AdditiveNoise, residuals: Residuals, step: float) -> AdditiveNoise:
    """Move a noise part of the way, ``step``, towards the likeliest; while steps are whole its shape may change, too,
    to the next of `SHAPES`.
    """
    readings = residuals.weight.sum()
    if readings < LEAST_WEIGHT:
        return noise
    numbers = noise.kernel_parameters()
    assert numbers is not None
    dof, scale_m, per_m = numbers.dof or math.inf, numbers.sigma_m, numbers.sigma_per_m
    place = SHAPES.index(dof)
    tried = SHAPES[max(place - 1, 0) : place + 2] if step == 1.0 else (dof,)
    found = {shape: residuals.likeliest(shape, scale_m, per_m) for shape in tried}
    a_number_more = 0.5 * math.log(readings) / readings  # must be worth that (Schwarz 1978)
    best = min(tried, key=lambda shape: found[shape][0] + (a_number_more if shape < math.inf else 0.0))
    present = np.log([scale_m, max(per_m, LEAST_GROWTH)])
    return noise_with(best, *np.exp((1 - step) * present + step * found[best][1]).tolist())
