"""Points at which beams were stopped follow their law given the readings, under any sensor's law.

False alarms: `ALPHA` = 1e-4 over this module. The kernel reads the law from a table, off by up to a hundredth.
"""

import math
from functools import cache

import numpy as np
import pytest
import scipy
import warp as wp
from oracle.verdict import ALPHA
from oracle.worlds import OwnSensor
from tiers import full_but

import bayesmap as bm
from bayesmap.kernels import device
from bayesmap.kernels.device import Float64s
from bayesmap.kernels.random import mix
from bayesmap.kernels.sensor_law import SensorLaw32, object_decay, sensor_law
from bayesmap.kernels.surfaces.square_counts import stop_point_m
from bayesmap.sensors.model import RangeLimits

wp.set_module_options({"enable_backward": False})

LIMITS = RangeLimits(0.05, 8.0)
DRAWS, TESTS = 3000, 20


@wp.kernel
def points(
    law: SensorLaw32, reading: wp.float32, distance: wp.float32, variance: wp.float32, key: wp.uint64, out: Float64s
):
    i = wp.tid()
    decay = object_decay(law, reading)
    out[i] = stop_point_m(law, reading, decay, distance, variance, key, wp.uint64(i) * wp.uint64(4))


law_of = cache(sensor_law)
"""The law of a model of the user's own is tabulated, which takes seconds."""


def draw_points(sensor, limits, reading_m, distance_m, spread_m, count, seed=0):
    """Distances at which a beam with this reading was stopped by a surface at about the distance, (count,), metres."""
    device.start()
    out = wp.zeros(count, dtype=wp.float64, device="cpu")
    law = law_of(sensor, limits, "cpu", SensorLaw32)
    inputs = [law, reading_m, distance_m, spread_m**2, mix(seed, math.floor(1e6 * spread_m)), out]
    wp.launch(points, dim=count, inputs=inputs, device="cpu")
    return np.array(out.numpy())


@cache
class Late(OwnSensor):
    """Readings come late by a third of the noise, so that the law is not symmetric."""

    def __init__(self, sigma_m):
        super().__init__(bm.BeamMixture(bm.Gaussian(sigma_m), p_random=0.1, p_no_return=0.1, p_short=0.1))
        self.late_m = sigma_m / 3.0

    def log_likelihood(self, range_m, distance_m, limits):
        return super().log_likelihood(range_m, distance_m + self.late_m, limits)


def plain_law(sensor, reading_m, distance_m, spread_m, given_reading=True):
    """Distances, and the cumulative distribution there: a normal law times the reading's likelihood, added up."""
    t = np.linspace(distance_m - 7 * spread_m, distance_m + 7 * spread_m, 20_001)
    log_p = scipy.stats.norm.logpdf(t, distance_m, spread_m)
    if given_reading:
        log_p = log_p + sensor.log_likelihood(np.full_like(t, reading_m), t, LIMITS)
    p = np.exp(log_p - log_p.max())
    below = np.cumsum(p)
    return t, below / below[-1]


CASES = {
    "a thick surface and a sharp sensor": (0.02, 3.05, 3.0, 0.06),
    "a thin surface and a blunt sensor": (0.3, 3.05, 2.95, 0.02), "both alike": (0.1, 2.1, 2.0, 0.1),
    "the surface's far end": (0.05, 3.25, 3.0, 0.08), "a reading from elsewhere": (0.05, 6.0, 2.0, 0.08),
    "a reading before the surface": (0.05, 1.0, 2.0, 0.08), "no return": (0.05, np.inf, 4.0, 0.1),
}  # fmt: skip


@pytest.mark.parametrize("case", full_but(CASES, "the surface's far end", "no return"))
def test_points_follow_the_surface_times_the_likelihood_of_the_reading(case):
    sigma_m, reading_m, distance_m, spread_m = CASES[case]
    sensor = Late(sigma_m)
    found = draw_points(sensor, LIMITS, reading_m, distance_m, spread_m, DRAWS)

    def p_value(given_reading):
        t, below = plain_law(sensor, reading_m, distance_m, spread_m, given_reading)
        return scipy.stats.kstest(found, lambda x: np.interp(x, t, below)).pvalue

    assert p_value(True) > ALPHA / TESTS
    if abs(reading_m - distance_m) < 4 * spread_m:  # else it says nothing of the point
        assert p_value(False) < ALPHA / TESTS


def test_a_surface_without_thickness_has_one_point_and_none_lies_behind_the_beam_s_start():
    assert (draw_points(Late(0.05), LIMITS, 3.0, 2.9, 0.0, 10) == np.float32(2.9)).all()
    assert draw_points(Late(0.05), LIMITS, 0.1, 0.02, 0.05, 500).min() >= 0


def test_points_of_a_mixture_lie_between_surface_and_reading_if_it_came_from_there():
    sensor = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.2, p_no_return=0.1)
    found = draw_points(sensor, LIMITS, 3.1, 3.0, 0.05, DRAWS)
    density = sensor.stop_log_likelihood(np.array([3.1]), np.array([3.0]), np.array([0.05]), LIMITS)
    chance = 0.2 / (LIMITS.max_m - LIMITS.min_m)
    by_chance = chance / np.exp(density[0])

    def below(x):
        there = scipy.stats.norm.cdf(x, 3.05, 0.05 / np.sqrt(2))
        return by_chance * scipy.stats.norm.cdf(x, 3.0, 0.05) + (1 - by_chance) * there

    assert scipy.stats.kstest(found, below).pvalue > ALPHA / TESTS
    assert scipy.stats.kstest(found, lambda x: scipy.stats.norm.cdf(x, 3.0, 0.05)).pvalue < ALPHA / TESTS
