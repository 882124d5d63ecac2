"""Every sensor model is a probability law: it integrates to one, and it is the law of the book."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle import density as oracle
from sensor_cases import ALL, DISTANCES, LIMITS, MIXTURES, NOISES, density, integral, jumps

import bayesmap as bm


@pytest.mark.parametrize("name", NOISES)
def test_additive_noise_integrates_to_one_over_all_readings(name):
    sensor, totals = NOISES[name], {}
    for d in DISTANCES:
        centre = min(d, LIMITS.max_m)
        scale = float(sensor.scale_at(np.float64(centre)))
        far = np.geomspace(1e-2, 1e9, 60) * scale  # Cauchy's tails past 1e9 scales hold 6e-10
        totals[d] = integral(sensor, d, centre + np.concatenate([-far[::-1], [0.0], far])).sum()
    assert totals == pytest.approx(dict.fromkeys(DISTANCES, 1.0), abs=2e-9)


@pytest.mark.parametrize("name", MIXTURES)
def test_a_mixture_integrates_to_one_with_its_two_atoms(name):
    sensor, totals = MIXTURES[name], {}
    for d in DISTANCES:
        edges = np.unique([*np.linspace(LIMITS.min_m, LIMITS.max_m, 20), *jumps(d)])
        # an atom that is impossible is floored at exp(-30)
        totals[d] = integral(sensor, d, edges).sum() + density(sensor, [np.inf, -np.inf], d).sum()
    assert totals == pytest.approx(dict.fromkeys(DISTANCES, 1.0), abs=1e-9)


def test_an_invalid_reading_says_nothing():
    d = np.array(DISTANCES)
    found = {name: sensor.log_likelihood(np.full(len(d), np.nan), d, LIMITS) for name, sensor in ALL.items()}
    assert [name for name, values in found.items() if (values != 0.0).any()] == []


@pytest.mark.parametrize("name", NOISES)
def test_additive_noise_scores_typed_readings_as_the_limits(name):
    sensor, d = NOISES[name], np.array(DISTANCES)
    for typed, stands_for in ((np.inf, LIMITS.max_m), (-np.inf, LIMITS.min_m)):
        both = [sensor.log_likelihood(np.full(len(d), z), d, LIMITS) for z in (typed, stands_for)]
        np.testing.assert_array_equal(*both)


@given(st.floats(0.3, 8.0), st.sampled_from(DISTANCES), st.floats(0.01, 2.0), st.floats(0.0, 0.3))
def test_the_gaussian_is_scipy_s(z, d, sigma, per_m):
    found = bm.Gaussian(sigma, per_m).log_likelihood(np.float64(z), np.float64(d), LIMITS)
    expected = oracle.gaussian(z, d, sigma=sigma, per_m=per_m, max_m=LIMITS.max_m)
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)


probability = st.floats(0.0, 0.9)


@given(
    st.floats(0.3, 8.0) | st.sampled_from([np.inf, -np.inf]),
    st.floats(0.0, 9.0) | st.just(np.inf),
    st.floats(0.02, 1.0),
    st.floats(0.0, 0.2),
    st.sampled_from([None, 1.0, 4.0]),
    st.floats(0.01, 0.9),
    probability,
    probability,
    st.floats(0.05, 3.0),
)
def test_the_mixture_is_the_story_that_its_docstring_tells(z, d, sigma, per_m, dof, random, lost, short, rate):
    noise = bm.Gaussian(sigma, per_m) if dof is None else bm.StudentT(sigma, dof, per_m)
    found = bm.BeamMixture(noise, random, lost, short, rate).log_likelihood(np.float64(z), np.float64(d), LIMITS)
    with np.errstate(divide="ignore"):
        expected = oracle.mixture(
            z, d, sigma=sigma, dof=dof, per_m=per_m, min_m=LIMITS.min_m, max_m=LIMITS.max_m, p_random=random,
            p_no_return=lost, p_short=short, rate=rate,
        )  # fmt: skip
    if expected > -29:  # below, typed readings are floored at -30
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)
    else:
        assert -30.0 <= found < -28.99
