"""`sample` follows the density that `log_likelihood` scores.

Chi-square over sixty bins and the two atoms, 50 000 readings each, seeds fixed. False alarms of the whole file: 1e-4.
"""

import numpy as np
import pytest
import scipy
from oracle.verdict import ALPHA
from sensor_cases import ALL, DISTANCES, LIMITS, MIXTURES, integral

import bayesmap as bm

N = 50_000
TESTS = len(ALL) * len(DISTANCES)


def chi_square(sensor, readings, d):
    """P-value of readings against the density's integrals over bins, and against the atoms."""
    atoms = np.zeros(2)
    if isinstance(sensor, bm.BeamMixture):
        low, high = LIMITS.min_m, LIMITS.max_m
        atoms = np.exp(sensor.log_likelihood(np.array([np.inf, -np.inf]), np.float64(d), LIMITS))
    else:
        centre = min(d, LIMITS.max_m)
        low, high = centre + np.array([-40, 40]) * float(sensor.scale_at(np.float64(centre)))
    width = (high - low) * 0.5 ** np.arange(3, 9)
    around = np.concatenate([[d], d - width, d + width]) if np.isfinite(d) else []
    inside = [x for x in around if low < x < high]
    edges = np.unique([*np.linspace(low, high, 50), *inside])
    finite = readings[np.isfinite(readings)]
    counts = np.histogram(finite, edges)[0]
    p = integral(sensor, d, edges)
    outside = [len(finite) - counts.sum(), 0.0 if isinstance(sensor, bm.BeamMixture) else max(0.0, 1 - p.sum())]
    counts = np.concatenate([counts, [(readings == np.inf).sum(), (readings == -np.inf).sum(), outside[0]]])
    expected = np.concatenate([p, atoms, [outside[1]]]) * len(readings)
    assert counts[expected < 1e-4].sum() == 0, "a reading that is next to impossible"
    rare = expected < 8
    counts, expected = (np.append(a[~rare], a[rare].sum()) for a in (counts, expected))
    if expected[-1] < 8:
        counts, expected = (np.append(a[:-2], a[-2:].sum()) for a in (counts, expected))
    return scipy.special.chdtrc(max(1, len(expected) - 1), ((counts - expected) ** 2 / expected).sum())


@pytest.mark.parametrize("name", ALL)
def test_readings_follow_the_density(name):
    rng, sensor = np.random.default_rng([list(ALL).index(name), 1]), ALL[name]
    readings = sensor.sample(rng, np.repeat(DISTANCES, N).reshape(-1, N), LIMITS)
    p_values = {d: chi_square(sensor, some, d) for d, some in zip(DISTANCES, readings, strict=True)}
    assert {d: p for d, p in p_values.items() if p <= ALPHA / TESTS} == {}


TWINS = {
    "more random readings": (bm.BeamMixture(p_random=0.065), bm.BeamMixture()),
    "more lost": (bm.BeamMixture(p_no_return=0.03), bm.BeamMixture()),
    "more objects": (bm.BeamMixture(p_short=0.12), bm.BeamMixture()),
    "wider noise": (bm.Gaussian(0.22), bm.Gaussian(0.2)),
}


@pytest.mark.parametrize("name", TWINS)
def test_readings_of_a_wrong_twin_are_rejected(name):
    twin, sensor = TWINS[name]
    readings = twin.sample(np.random.default_rng(2), np.full(N, 3.0), LIMITS)
    assert chi_square(sensor, readings, 3.0) < ALPHA / TESTS


@pytest.mark.parametrize("name", MIXTURES)
def test_a_mixture_s_finite_readings_stay_within_the_limits(name):
    readings = MIXTURES[name].sample(np.random.default_rng(3), np.linspace(0, 9, N), LIMITS)
    finite = readings[np.isfinite(readings)]
    assert LIMITS.min_m <= finite.min() <= finite.max() <= LIMITS.max_m
    assert not np.isnan(readings).any()
