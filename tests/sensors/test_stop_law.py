"""The law of a reading whose beam stopped at about a distance: widened noise, or the mean over stops."""

import numpy as np
import pytest
import scipy
from oracle.own_sensor import OwnSensor
from sensor_cases import ALL, LIMITS

import bayesmap as bm

READINGS = np.array([0.6, 1.0, 2.9, 3.1, 4.8, np.inf, -np.inf, np.nan])


@pytest.mark.parametrize("name", ALL)
def test_without_a_spread_it_is_the_likelihood(name):
    d = np.linspace(0.1, 12.0, 40)[:, None]
    for distance in (d, np.full((1, 1), np.inf)):
        np.testing.assert_array_equal(
            ALL[name].stop_log_likelihood(READINGS, distance, np.zeros(()), LIMITS),
            ALL[name].log_likelihood(READINGS, distance, LIMITS),
        )


def test_a_spread_widens_the_noise():
    narrow, wide = (bm.BeamMixture(bm.Gaussian(s), 0.05, 0.1, 0.2, 0.4) for s in (0.3, 0.5))
    d = np.linspace(0.1, 12.0, 40)[:, None]
    found = narrow.stop_log_likelihood(READINGS, d, np.full(d.shape, 0.4), LIMITS)
    np.testing.assert_allclose(found, wide.log_likelihood(READINGS, d, LIMITS), atol=1e-12)


@pytest.mark.parametrize("sigma_m", [0.5, 0.05, 0.002])
@pytest.mark.parametrize("spread_m", [0.01, 0.1, 0.3])
def test_a_model_of_the_user_s_own_has_the_mean_over_stops(sigma_m, spread_m):
    """Normal noise about a normal stop is normal, however much sharper the one is than the other."""
    own = OwnSensor(bm.Gaussian(sigma_m))
    z, d = np.linspace(4.0, 6.0, 41), np.full(41, 5.0)
    found = own.stop_log_likelihood(z, d, np.full(41, spread_m), LIMITS)
    wide = np.hypot(sigma_m, spread_m)
    expected = scipy.stats.norm.logpdf(z, 5.0, wide)
    near = np.abs(z - 5.0) < 4 * wide
    np.testing.assert_allclose(found[near], expected[near], atol=0.02)
    invalid = own.stop_log_likelihood(np.array([np.nan]), np.array([5.0]), np.array([spread_m]), LIMITS)
    assert invalid == pytest.approx(0.0, abs=1e-9)
