"""`cumulative` is the integral of the density from below, atoms included, and readings that are drawn follow it.

Kolmogorov-Smirnov on 20 000 readings a case, seeds fixed; false alarms of the whole file: 1e-4.
"""

import numpy as np
import pytest
from oracle.verdict import ALPHA
from scipy import stats
from sensor_cases import ALL, DISTANCES, LIMITS, MIXTURES, NOISES, density, integral

import bayesmap as bm

RANGES = np.linspace(LIMITS.min_m, LIMITS.max_m, 12)
N = 20_000
CASES = [(name, d) for name in ALL for d in DISTANCES]


@pytest.mark.parametrize("d", DISTANCES)
@pytest.mark.parametrize("name", MIXTURES)
def test_a_mixture_s_is_too_close_and_the_density_below(name, d):
    sensor = MIXTURES[name]
    inside = [d] if LIMITS.min_m < d < LIMITS.max_m else []  # the density jumps at the wall
    edges = np.unique([*RANGES, *inside])
    # an atom that is impossible is floored at exp(-30)
    expected = density(sensor, [-np.inf], d) + np.append(0.0, np.cumsum(integral(sensor, d, edges)))
    np.testing.assert_allclose(sensor.cumulative(edges, np.float64(d), LIMITS), expected, atol=1e-9)
    top = sensor.cumulative(np.float64(LIMITS.max_m), np.float64(d), LIMITS)
    assert 1.0 - top == pytest.approx(float(density(sensor, [np.inf], d)[0]), abs=1e-9)


@pytest.mark.parametrize("d", DISTANCES)
@pytest.mark.parametrize("name", NOISES)
def test_that_of_noise_alone_is_the_density_s_between_any_two_ranges(name, d):
    sensor, edges = NOISES[name], np.unique([*np.linspace(-1.0, 10.0, 40), min(d, LIMITS.max_m)])
    found = np.diff(sensor.cumulative(edges, np.float64(d), LIMITS))
    np.testing.assert_allclose(found, integral(sensor, d, edges), atol=1e-9)
    assert sensor.cumulative(np.float64(-1e9), np.float64(d), LIMITS) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", MIXTURES)
def test_typed_readings(name):
    d = np.array(DISTANCES)
    sensor = MIXTURES[name]
    assert (sensor.cumulative(np.full(len(d), np.inf), d, LIMITS) == 1.0).all()
    close = sensor.cumulative(np.full(len(d), -np.inf), d, LIMITS)
    np.testing.assert_array_equal(close, sensor.cumulative(np.full(len(d), LIMITS.min_m), d, LIMITS))
    assert np.isnan(sensor.cumulative(np.full(len(d), np.nan), d, LIMITS)).all()


@pytest.mark.parametrize(("name", "d"), CASES)
def test_drawn_readings_follow_it(name, d):
    """The randomised transform of draws is uniform."""
    rng = np.random.default_rng([CASES.index((name, d)), 1])
    sensor = ALL[name]
    z = sensor.sample(rng, np.full(N, d), LIMITS)
    high = sensor.cumulative(z, np.full(N, d), LIMITS)
    low = high.copy()
    if name in MIXTURES:
        low[np.isneginf(z)] = 0.0
        low[np.isposinf(z)] = sensor.cumulative(np.full(N, LIMITS.max_m), np.full(N, d), LIMITS)[np.isposinf(z)]
    u = low + rng.random(N) * (high - low)
    assert stats.kstest(u, "uniform").pvalue > ALPHA / len(CASES)


def test_a_wrong_twin_is_told_apart():
    """Power of the test above: noise a tenth too wide."""
    rng = np.random.default_rng(1)
    z = bm.Gaussian(0.22).sample(rng, np.full(N, 1.7), LIMITS)
    u = bm.Gaussian(0.2).cumulative(z, np.full(N, 1.7), LIMITS)
    assert stats.kstest(u, "uniform").pvalue < ALPHA / len(CASES)


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
