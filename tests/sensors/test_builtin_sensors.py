"""Every sensor model is a probability law, the law of the book, and draws follow it; it survives the way through JSON.

NumPy, both precisions of the compiled law, and JAX agree. The sensor model of the contributor's page has three methods,
and everything works with it. Draws: chi-square over sixty bins and the two atoms, 50 000 readings each, seeds fixed.
False alarms of all: 1e-4.
"""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy
import warp as wp
from hypothesis import given
from hypothesis import strategies as st
from oracle.stop_law import gaussian, reading_law
from oracle.stop_worlds import scans_of_all_kinds
from oracle.verdict import ALPHA
from oracle.worlds import OwnSensor

import bayesmap as bm
from bayesmap.kernels import device as devices
from bayesmap.kernels.sensor_law import SensorLaw32, SensorLaw64, cumulative, object_decay, sensor_law, stop_log_density
from bayesmap.posterior.prediction import predictor_of
from bayesmap.posterior.scores import beam_log_scores
from bayesmap.sensors.model import FLAT_NATS, RangeLimits, describe, from_description

wp.set_module_options({"enable_backward": False})

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
    """Distances at which a mixture's density jumps, within the limits: the wall."""
    return [d] if LIMITS.min_m < d < LIMITS.max_m else []


def density(sensor, z, d):
    return np.exp(sensor.log_likelihood(np.asarray(z, dtype=float), np.float64(d), LIMITS))


def integral(sensor, d, edges):
    """The density's integral between neighbouring edges: 40-point Gauss-Legendre on 64 pieces of each."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    low, high = np.asarray(edges[:-1], dtype=float), np.asarray(edges[1:], dtype=float)
    fine = np.linspace(low, high, 65, axis=-1)
    a, b = fine[:, :-1, None], fine[:, 1:, None]
    return (density(sensor, (a + b) / 2 + (b - a) / 2 * nodes, d) * weights * (b - a) / 2).sum(axis=(1, 2))


LAW_READINGS = np.concatenate([np.linspace(0.31, 7.9, 60), [np.inf, -np.inf]])
LAW_DISTANCES = np.concatenate([np.linspace(0.02, 7.95, 70), [8.5, np.inf]])
PRECISIONS = {"double": (SensorLaw64, wp.float64, 1e-9), "single": (SensorLaw32, wp.float32, 3e-3)}


@wp.kernel
def densities(law: Any, z: wp.array(dtype=Any), d: wp.array(dtype=Any), v: wp.array(dtype=Any),
              out: wp.array(dtype=Any), below: wp.array(dtype=Any)):  # fmt: skip
    i = wp.tid()
    out[i] = stop_log_density(law, z[i], object_decay(law, z[i]), d[i], v[i])
    below[i] = cumulative(law, wp.clamp(z[i], law.min_m, law.max_m), d[i], v[i])


def compiled(sensor, z, d, spread, precision):
    devices.start()
    law, real, _ = PRECISIONS[precision]
    inputs = [wp.array(a.ravel(), dtype=real, device="cpu") for a in np.broadcast_arrays(z, d, np.asarray(spread) ** 2)]
    out = [wp.zeros(inputs[0].shape, dtype=real, device="cpu") for _ in range(2)]
    inputs = [sensor_law(sensor, LIMITS, "cpu", law), *inputs, *out]
    wp.launch(densities, dim=inputs[1].shape[0], inputs=inputs, device="cpu")
    shape = np.broadcast_shapes(np.shape(z), np.shape(d), np.shape(spread))
    return [a.numpy().reshape(shape).astype(float) for a in out]


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("name", ALL)
def test_the_compiled_law_is_numpy_s(name, precision):
    """On all readings, distances and two spreads of the stop, which are axes of an array."""
    z, d, spread = LAW_READINGS[:, None, None], LAW_DISTANCES[:, None], np.array([0.0, 0.15])
    found, below = compiled(ALL[name], z, d, spread, precision)
    expected = ALL[name].stop_log_likelihood(z, d, spread, LIMITS)
    close = PRECISIONS[precision][2]
    # Single precision knows the probabilities of typed readings as differences of numbers near one.
    certain = (np.isfinite(z) & (d >= 0)) | (expected > (-18.0 if precision == "double" else -6.0))
    np.testing.assert_allclose(found[certain], expected[certain], rtol=close, atol=close)
    np.testing.assert_allclose(np.exp(found[~certain]), np.exp(expected[~certain]), atol=1e-6)
    expected = ALL[name].cumulative(np.clip(z, LIMITS.min_m, LIMITS.max_m), d, LIMITS, spread_m=spread)
    np.testing.assert_allclose(below, expected, atol=max(1e-9, close / 30))


@pytest.mark.parametrize("name", ALL)
def test_jax_s_law_is_numpy_s(name):
    import jax.numpy as jnp

    from bayesmap.programs.beam_sensor import reading_law

    z, d = np.broadcast_arrays(LAW_READINGS[:, None], LAW_DISTANCES[None])
    found = reading_law(ALL[name], LIMITS).logpdf(jnp.asarray(z), jnp.asarray(d))
    np.testing.assert_allclose(found, ALL[name].log_likelihood(z, d, LIMITS), rtol=2e-3, atol=2e-3)


PAGE = Path(__file__).parents[2] / "CONTRIBUTING.md"
GRID = bm.Grid((6, 5), 0.5, (-1.0, 2.0))
KINDS = [bm.Independent(0.2), bm.Beta(0.5, 1.0), bm.Surface(0.5, 1.0)]
TRAIN, HELD = (scans_of_all_kinds(seed, GRID, poses=12) for seed in (1, 2))


@pytest.fixture(scope="module")
def sonar():
    blocks, names = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL), {"__name__": "sonar"}
    exec(next(block for block in blocks if "Sonar" in block), names)
    return names["Sonar"](0.15)


@pytest.mark.parametrize("prior", KINDS, ids=lambda prior: prior.words.kind)
def test_maps_are_inferred_and_scored_by_it(prior, sonar):
    run = bm.infer(TRAIN, GRID, prior=prior, sensor=sonar, schedule=bm.Schedule(chains=2, warmup=10, draws=20))
    assert np.isfinite(run.log_joint).all()
    if type(prior) is bm.Beta:  # the table that a sweep sums up against the plain formula
        model = bm.model.Model(TRAIN, GRID, prior, sonar, hit_depth=run.posterior.settings["hit_depth"])
        for draw in range(3):
            cells = {"reflectivity": np.asarray(run.map_of(0, draw), dtype=float)}
            beams = model.beam_log_likelihoods(model.state(cells))
            assert float(run.posterior.log_likelihood[0, draw]) == pytest.approx(beams.sum(), abs=0.02 * len(beams))
    score = bm.score(run, HELD)
    assert run.log_score(HELD) == score.nats_per_beam
    assert np.isfinite(score.nats_per_beam)
    assert 0 < score.coverage[0].share.value < score.coverage[2].share.value < 1


@pytest.mark.parametrize("sigma_m", [0.05, 0.02])
def test_readings_far_from_every_wall_are_scored_by_the_plain_law(sonar, sigma_m):
    """The plain law's density may be smaller than a mixture's density of anything possible."""
    sensor, prior = type(sonar)(sigma_m), bm.Independent(0.2)
    run = bm.infer(TRAIN, GRID, prior=prior, sensor=sensor, schedule=bm.Schedule(chains=2, warmup=10, draws=10))
    model, draws = bm.model.Model(HELD, GRID, prior, sensor), run.posterior.draws
    plain = np.array([model.beam_log_likelihoods(model.state(draws.cells(*one))) for one in draws.numbers()])
    expected = np.logaddexp.reduce(plain, axis=0) - np.log(len(plain))
    found = beam_log_scores(predictor_of(run.posterior), HELD)
    valid = ~np.isnan(found)
    assert expected[valid].min() < -40
    np.testing.assert_allclose(found[valid], expected[valid], rtol=0.01, atol=0.02)
    assert run.log_score(HELD) == pytest.approx(expected[valid].mean(), rel=0.01)


@pytest.mark.parametrize("name", ALL)
def test_a_law_integrates_to_one_over_all_readings(name):
    sensor, totals = ALL[name], {}
    for d in DISTANCES:
        if name in MIXTURES:  # with its two atoms; one that is impossible is floored at exp(-30)
            edges = np.unique([*np.linspace(LIMITS.min_m, LIMITS.max_m, 20), *jumps(d)])
            totals[d] = integral(sensor, d, edges).sum() + density(sensor, [np.inf, -np.inf], d).sum()
            continue
        centre = min(d, LIMITS.max_m)
        scale = float(sensor.scale_at(np.float64(centre)))
        far = np.geomspace(1e-2, 1e9, 60) * scale  # Cauchy's tails past 1e9 scales hold 6e-10
        totals[d] = integral(sensor, d, centre + np.concatenate([-far[::-1], [0.0], far])).sum()
    assert totals == pytest.approx(dict.fromkeys(DISTANCES, 1.0), abs=2e-9)


def test_an_invalid_reading_says_nothing_and_noise_alone_takes_typed_ones_for_the_limits():
    d = np.array(DISTANCES)
    found = {name: sensor.log_likelihood(np.full(len(d), np.nan), d, LIMITS) for name, sensor in ALL.items()}
    assert [name for name, values in found.items() if (values != 0.0).any()] == []
    assert (MIXTURES["mixture"].reach_m(np.array([1.0, 2.0, 3.0]), LIMITS) < np.array([1.5, 2.5, 3.5])).all()
    assert [name for name, noise in NOISES.items() if np.isfinite(noise.reach_m(SPAN, LIMITS)).any()] == []
    assert [name for name, sensor in ALL.items() if sensor.reach_m(np.array([np.nan]), LIMITS)[0] != 0.0] == []
    for noise in NOISES.values():  # typed readings count as the limits
        for typed, limit in ((np.inf, LIMITS.max_m), (-np.inf, LIMITS.min_m)):
            both = [noise.log_likelihood(np.full(len(d), z), d, LIMITS) for z in (typed, limit)]
            np.testing.assert_array_equal(*both)


@given(st.floats(0.3, 8.0), st.sampled_from(DISTANCES), st.floats(0.01, 2.0), st.floats(0.0, 0.3))
def test_the_gaussian_is_scipy_s(z, d, sigma, per_m):
    found = bm.Gaussian(sigma, per_m).log_likelihood(np.float64(z), np.float64(d), LIMITS)
    assert found == pytest.approx(gaussian(z, d, sigma=sigma, per_m=per_m, max_m=LIMITS.max_m), rel=1e-12, abs=1e-12)


probability = st.floats(0.0, 0.9)


@given(
    st.floats(0.3, 8.0) | st.sampled_from([np.inf, -np.inf]), st.floats(0.0, 9.0) | st.just(np.inf),
    st.floats(0.02, 1.0), st.floats(0.0, 0.2), st.sampled_from([None, 1.0, 4.0]), st.floats(0.01, 0.9), probability,
    probability, st.floats(0.05, 3.0),
)  # fmt: skip
def test_the_mixture_is_the_story_that_its_docstring_tells(z, d, sigma, per_m, dof, random, lost, short, rate):
    noise = bm.Gaussian(sigma, per_m) if dof is None else bm.StudentT(sigma, dof, per_m)
    sensor = bm.BeamMixture(noise, random, lost, short, rate)
    found = sensor.log_likelihood(np.float64(z), np.float64(d), LIMITS)
    with np.errstate(divide="ignore"):
        expected = np.log(reading_law(z, d, 0.0, sensor, LIMITS))
    if expected > -29:  # below, typed readings are floored at -30
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)
    else:
        assert -30.0 <= found < -28.99


SPAN = np.array([*np.linspace(LIMITS.min_m, LIMITS.max_m, 23), np.inf, -np.inf])


@pytest.mark.parametrize("name", ALL)
def test_the_likelihood_is_flat_past_the_reach(name):
    for z, reach in zip(SPAN, ALL[name].reach_m(SPAN, LIMITS), strict=True):
        if reach < LIMITS.max_m:
            past = np.append(np.linspace(reach, LIMITS.max_m + 1, 200), np.inf)
            values = ALL[name].log_likelihood(np.full(len(past), z), past, LIMITS)
            beyond = ALL[name].log_likelihood(np.float64(z), np.float64(np.inf), LIMITS)
            assert abs(values - beyond).max() <= FLAT_NATS * (1 + 1e-6)


READINGS = np.array([0.6, 1.0, 2.9, 3.1, 4.8, np.inf, -np.inf, np.nan])


def test_a_spread_adds_to_the_noise_in_quadrature_and_a_model_of_one_s_own_is_told_what_it_lacks():
    narrow, wide = (bm.BeamMixture(bm.Gaussian(s), 0.05, 0.1, 0.2, 0.4) for s in (0.3, 0.5))
    d = np.linspace(0.1, 12.0, 40)[:, None]
    density = narrow.stop_log_likelihood(READINGS, d, np.full(d.shape, 0.4), LIMITS)
    np.testing.assert_allclose(density, wide.log_likelihood(READINGS, d, LIMITS), atol=1e-12)
    below = narrow.cumulative(RANGES, np.float64(3.0), LIMITS, spread_m=0.4)
    np.testing.assert_allclose(below, wide.cumulative(RANGES, np.float64(3.0), LIMITS), rtol=1e-12)
    with pytest.raises(bm.BadInput, match=r"OwnSensor: no cumulative distribution; add a method cumulative\(\)"):
        OwnSensor(bm.Gaussian(0.1)).cumulative(np.zeros(1), np.zeros(1), LIMITS)


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


RANGES = np.linspace(LIMITS.min_m, LIMITS.max_m, 12)


@pytest.mark.parametrize("name", MIXTURES)
def test_the_cumulative_of_a_mixture_is_too_close_and_the_density_below(name):
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
    assert (sensor.cumulative(np.full(len(d), np.inf), d, LIMITS) == 1.0).all()
    close = sensor.cumulative(np.full(len(d), -np.inf), d, LIMITS)
    np.testing.assert_array_equal(close, sensor.cumulative(np.full(len(d), LIMITS.min_m), d, LIMITS))
    assert np.isnan(sensor.cumulative(np.full(len(d), np.nan), d, LIMITS)).all()


@pytest.mark.parametrize("name", NOISES)
def test_the_cumulative_of_noise_alone_is_the_density_between_any_two_ranges(name):
    sensor, found, expected = NOISES[name], {}, {}
    for d in DISTANCES:
        edges = np.unique([*np.linspace(-1.0, 10.0, 40), min(d, LIMITS.max_m)])
        found[d] = np.diff(sensor.cumulative(edges, np.float64(d), LIMITS))
        expected[d] = integral(sensor, d, edges)
    assert found == {d: pytest.approx(values, rel=1e-7, abs=1e-9) for d, values in expected.items()}
    lowest = sensor.cumulative(np.full(len(DISTANCES), -1e9), np.array(DISTANCES), LIMITS)
    np.testing.assert_allclose(lowest, 0.0, atol=1e-9)


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
    edges = np.unique([*np.linspace(low, high, 50), *[x for x in around if low < x < high]])
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
    if name in MIXTURES:
        finite = sensor.sample(rng, np.linspace(0, 9, N), LIMITS)
        assert not np.isnan(finite).any()
        finite = finite[np.isfinite(finite)]
        assert LIMITS.min_m <= finite.min() <= finite.max() <= LIMITS.max_m


TWINS = {
    "more random readings": (bm.BeamMixture(p_random=0.065), bm.BeamMixture()),
    "more lost": (bm.BeamMixture(p_no_return=0.03), bm.BeamMixture()),
    "more objects": (bm.BeamMixture(p_short=0.12), bm.BeamMixture()),
    "wider noise": (bm.Gaussian(0.22), bm.Gaussian(0.2)),
}


@pytest.mark.parametrize("name", TWINS)
def test_readings_of_a_wrong_twin_are_rejected(name):
    twin, sensor = TWINS[name]
    assert chi_square(sensor, twin.sample(np.random.default_rng(2), np.full(N, 3.0), LIMITS), 3.0) < ALPHA / TESTS


def test_a_description_gives_the_model_back_or_the_name_alone_if_it_is_not_ours():
    assert {name: from_description(json.loads(json.dumps(describe(model)))) for name, model in ALL.items()} == ALL

    class Sonar(bm.Gaussian):
        pass

    assert describe(Sonar(0.1)) == {"kind": "Sonar"}
    assert from_description({"kind": "Sonar"}) is None


@pytest.mark.parametrize(("description", "message"), [
    ({"kind": "gaussian", "sigma": 1.0}, r"'gaussian' has no parameter 'sigma'; it has: sigma_m, sigma_per_m"),
    ({"kind": "mixture", "noise": {"kind": "mixture"}}, "noise is 'gaussian' or 'student-t'"),
    ({"kind": "gaussian", "sigma_m": -1.0}, "sigma_m must be a positive number"),
])  # fmt: skip
def test_a_wrong_description_is_refused(description, message):
    with pytest.raises(bm.BadInput, match=message):
        from_description(description)


@pytest.mark.parametrize(("make", "message"), [
    (lambda: bm.Gaussian(0.0), "Gaussian: sigma_m must be a positive number of metres, got 0.0"),
    (lambda: bm.Gaussian(np.inf), "sigma_m must be a positive"),
    (lambda: bm.Gaussian(np.nan), "sigma_m must be a positive"),
    (lambda: bm.Gaussian(0.1, -0.1), "growth of the noise per metre must be 0 or more"),
    (lambda: bm.StudentT(0.0), "StudentT: scale_m"),
    (lambda: bm.StudentT(0.1, 0.0), "dof must be a positive number"),
    (lambda: bm.BeamMixture(p_random=0.0), r"p_random must lie inside \(0, 1\), got 0.0"),
    (lambda: bm.BeamMixture(p_random=1.0), "p_random"),
    (lambda: bm.BeamMixture(p_short=1.0), r"p_short must lie in \[0, 1\)"),
    (lambda: bm.BeamMixture(p_no_return=-0.1), "p_no_return"),
    (lambda: bm.BeamMixture(p_no_return=np.nan), "p_no_return"),
    (lambda: bm.BeamMixture(rate_short_per_m=0.0), "rate_short_per_m must be positive"),
])  # fmt: skip
def test_parameters_outside_their_range_are_refused(make, message):
    with pytest.raises(bm.BadInput, match=message):
        make()
