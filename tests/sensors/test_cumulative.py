"""`cumulative` is the integral of the density from below, atoms included, and readings that are drawn follow it.

Kolmogorov-Smirnov on 20 000 readings a case, seeds fixed; false alarms of the whole file: 1e-4.
"""

import numpy as np
import pytest
import scipy
from oracle.verdict import ALPHA
from sensor_cases import ALL, DISTANCES, LIMITS, MIXTURES, NOISES, density, integral, jumps

import bayesmap as bm

RANGES = np.linspace(LIMITS.min_m, LIMITS.max_m, 12)
N = 20_000
TESTS = len(ALL) * len(DISTANCES)


@pytest.mark.parametrize("name", MIXTURES)
def test_a_mixture_s_is_too_close_and_the_density_below(name):
    sensor, found, expected = MIXTURES[name], {}, {}
    for d in DISTANCES:
        edges = np.unique([*RANGES, *jumps(d)])
        found[d] = sensor.cumulative(edges, np.float64(d), LIMITS)
        # an atom that is impossible is floored at exp(-30)
        expected[d] = density(sensor, [-np.inf], d) + np.append(0.0, np.cumsum(integral(sensor, d, edges)))
    assert found == {d: pytest.approx(values, rel=1e-7, abs=1e-9) for d, values in expected.items()}
    d = np.array(DISTANCES)
    top = sensor.cumulative(np.full(len(d), LIMITS.max_m), d, LIMITS)
    np.testing.assert_allclose(1.0 - top, density(sensor, np.full(len(d), np.inf), d), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("name", NOISES)
def test_that_of_noise_alone_is_the_density_s_between_any_two_ranges(name):
    sensor, found, expected = NOISES[name], {}, {}
    for d in DISTANCES:
        edges = np.unique([*np.linspace(-1.0, 10.0, 40), min(d, LIMITS.max_m)])
        found[d] = np.diff(sensor.cumulative(edges, np.float64(d), LIMITS))
        expected[d] = integral(sensor, d, edges)
    assert found == {d: pytest.approx(values, rel=1e-7, abs=1e-9) for d, values in expected.items()}
    lowest = sensor.cumulative(np.full(len(DISTANCES), -1e9), np.array(DISTANCES), LIMITS)
    np.testing.assert_allclose(lowest, 0.0, atol=1e-9)


@pytest.mark.parametrize("name", MIXTURES)
def test_typed_readings(name):
    d = np.array(DISTANCES)
    sensor = MIXTURES[name]
    assert (sensor.cumulative(np.full(len(d), np.inf), d, LIMITS) == 1.0).all()
    close = sensor.cumulative(np.full(len(d), -np.inf), d, LIMITS)
    np.testing.assert_array_equal(close, sensor.cumulative(np.full(len(d), LIMITS.min_m), d, LIMITS))
    assert np.isnan(sensor.cumulative(np.full(len(d), np.nan), d, LIMITS)).all()


def transforms(rng, sensor, z, d):
    """Return the randomised transform of readings: uniform where they follow the cumulative distribution."""
    high = sensor.cumulative(z, d, LIMITS)
    low = high.copy()
    if isinstance(sensor, bm.BeamMixture):
        low[np.isneginf(z)] = 0.0
        top = sensor.cumulative(np.full(z.shape, LIMITS.max_m), d, LIMITS)
        low[np.isposinf(z)] = top[np.isposinf(z)]
    return low + rng.random(z.shape) * (high - low)


@pytest.mark.parametrize("name", ALL)
def test_drawn_readings_follow_it(name):
    rng, sensor = np.random.default_rng([list(ALL).index(name), 1]), ALL[name]
    d = np.repeat(DISTANCES, N).reshape(-1, N)
    u = transforms(rng, sensor, sensor.sample(rng, d, LIMITS), d)
    p_values = dict(zip(DISTANCES, (scipy.stats.kstest(row, "uniform").pvalue for row in u), strict=True))
    assert {d: p for d, p in p_values.items() if p <= ALPHA / TESTS} == {}


def test_a_wrong_twin_is_told_apart():
    """Power of the test above: noise a tenth too wide."""
    rng = np.random.default_rng(1)
    z = bm.Gaussian(0.22).sample(rng, np.full(N, 1.7), LIMITS)
    u = bm.Gaussian(0.2).cumulative(z, np.full(N, 1.7), LIMITS)
    assert scipy.stats.kstest(u, "uniform").pvalue < ALPHA / TESTS


def test_a_spread_adds_to_the_noise_in_quadrature():
    narrow, wide = (bm.BeamMixture(bm.Gaussian(sigma)) for sigma in (0.3, 0.5))
    found = narrow.cumulative(RANGES, np.float64(3.0), LIMITS, spread_m=0.4)
    np.testing.assert_allclose(found, wide.cumulative(RANGES, np.float64(3.0), LIMITS), rtol=1e-12)


def test_a_model_of_one_s_own_is_told_what_it_lacks():
    class Sonar(bm.SensorModel):
        def log_likelihood(self, range_m, distance_m, limits): ...

        def reach_m(self, range_m, limits): ...

        def sample(self, rng, distance_m, limits): ...

    with pytest.raises(bm.BadInput, match=r"Sonar: no cumulative distribution; add a method cumulative\(\)"):
        Sonar().cumulative(np.zeros(1), np.zeros(1), LIMITS)
