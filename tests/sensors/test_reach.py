"""Past `reach_m` a reading's likelihood no longer depends on the distance, within `FLAT_NATS`."""

import numpy as np
import pytest
from sensor_cases import ALL, LIMITS, MIXTURES, NOISES

from bayesmap.sensors.builtin import FLAT_NATS

READINGS = np.array([*np.linspace(LIMITS.min_m, LIMITS.max_m, 23), np.inf, -np.inf])


@pytest.mark.parametrize("name", ALL)
def test_the_likelihood_is_flat_past_the_reach(name):
    for z, reach in zip(READINGS, ALL[name].reach_m(READINGS, LIMITS), strict=True):
        if reach < LIMITS.max_m:
            past = np.append(np.linspace(reach, LIMITS.max_m + 1, 200), np.inf)
            values = ALL[name].log_likelihood(np.full(len(past), z), past, LIMITS)
            beyond = ALL[name].log_likelihood(np.float64(z), np.float64(np.inf), LIMITS)
            assert abs(values - beyond).max() <= FLAT_NATS * (1 + 1e-6)


def test_a_sharp_mixture_ends_most_beams_early():
    reaches = MIXTURES["mixture"].reach_m(np.array([1.0, 2.0, 3.0]), LIMITS)
    assert (reaches < np.array([1.5, 2.5, 3.5])).all()


def test_additive_noise_is_nowhere_flat():
    assert [name for name, noise in NOISES.items() if np.isfinite(noise.reach_m(READINGS, LIMITS)).any()] == []


def test_an_invalid_reading_reaches_nothing():
    assert [name for name, sensor in ALL.items() if sensor.reach_m(np.array([np.nan]), LIMITS)[0] != 0.0] == []
