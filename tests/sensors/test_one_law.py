"""The law of a reading is one: NumPy's, both precisions of the compiled one, and JAX's say the same.

The sensor model of the contributor's page has three methods, and everything works with it.
"""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import warp as wp
from oracle.stop_worlds import scans_of_all_kinds
from sensor_cases import ALL, LIMITS

import bayesmap as bm
from bayesmap.kernels import device as devices
from bayesmap.kernels.sensor_law import SensorLaw32, SensorLaw64, cumulative, object_decay, sensor_law, stop_log_density
from bayesmap.posterior.prediction import predictor_of
from bayesmap.posterior.scores import beam_log_scores

wp.set_module_options({"enable_backward": False})

READINGS = np.concatenate([np.linspace(0.31, 7.9, 60), [np.inf, -np.inf]])
DISTANCES = np.concatenate([np.linspace(0.02, 7.95, 70), [8.5, np.inf]])
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
    z, d, spread = READINGS[:, None, None], DISTANCES[:, None], np.array([0.0, 0.15])
    found, below = compiled(ALL[name], z, d, spread, precision)
    expected = ALL[name].stop_log_likelihood(z, d, spread, LIMITS)
    close = PRECISIONS[precision][2]
    # Single precision knows the probabilities of typed readings as differences of numbers near one.
    certain = (np.isfinite(z) & (d >= 0)) | (expected > (-18.0 if precision == "double" else -6.0))
    np.testing.assert_allclose(found[certain], expected[certain], rtol=close, atol=close)
    np.testing.assert_allclose(np.exp(found[~certain]), np.exp(expected[~certain]), atol=1e-6)
    inside = np.clip(z, LIMITS.min_m, LIMITS.max_m)
    np.testing.assert_allclose(
        below, ALL[name].cumulative(inside, d, LIMITS, spread_m=spread), atol=max(1e-9, close / 30)
    )


@pytest.mark.parametrize("name", ALL)
def test_jax_s_law_is_numpy_s(name):
    import jax.numpy as jnp

    from bayesmap.programs.beam_sensor import reading_law

    z, d = np.broadcast_arrays(READINGS[:, None], DISTANCES[None])
    found = reading_law(ALL[name], LIMITS).logpdf(jnp.asarray(z), jnp.asarray(d))
    np.testing.assert_allclose(found, ALL[name].log_likelihood(z, d, LIMITS), rtol=2e-3, atol=2e-3)


PAGE = Path(__file__).parents[2] / "CONTRIBUTING.md"
GRID = bm.Grid((6, 5), 0.5, (-1.0, 2.0))
KINDS = [bm.Independent(0.2), bm.Beta(0.5, 1.0), bm.Surface(0.5, 1.0)]
TRAIN, HELD = (scans_of_all_kinds(seed, GRID, poses=12) for seed in (1, 2))


@pytest.fixture(scope="module")
def sonar():
    code = next(block for block in re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL) if "Sonar" in block)
    names = {"__name__": "sonar"}
    exec(code, names)
    return names["Sonar"](0.15)


@pytest.mark.parametrize("prior", KINDS, ids=lambda prior: prior.words.kind)
def test_maps_are_inferred_and_scored_by_it(prior, sonar):
    run = bm.infer(TRAIN, GRID, prior=prior, sensor=sonar, schedule=bm.Schedule(chains=2, warmup=10, draws=20))
    assert np.isfinite(run.log_joint).all()
    score = bm.score(run, HELD)
    assert run.log_score(HELD) == score.nats_per_beam
    assert np.isfinite(score.nats_per_beam)
    assert 0 < score.coverage[0].share.value < score.coverage[2].share.value < 1


@pytest.mark.parametrize("sigma_m", [0.05, 0.02])
def test_readings_far_from_every_wall_are_scored_by_the_plain_law(sonar, sigma_m):
    """Also where its density is smaller than that of anything that a mixture would call possible."""
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


def test_the_likelihood_that_chains_of_surfaces_report_is_the_model_s(sonar):
    """The table against the plain formula: what a sweep sums up is the joint law's likelihood of the kept draw."""
    schedule = bm.Schedule(chains=1, warmup=10, draws=3)
    run = bm.infer(TRAIN, GRID, prior=bm.Beta(0.5, 1.0), sensor=sonar, schedule=schedule, hit_depth=0.5)
    model = bm.model.Model(TRAIN, GRID, bm.Beta(0.5, 1.0), sonar, hit_depth=0.5)
    for draw in range(3):
        cells = {"reflectivity": np.asarray(run.map_of(0, draw), dtype=float)}
        beams = model.beam_log_likelihoods(model.state(cells))
        reported = float(run.posterior.log_likelihood[0, draw])
        assert reported == pytest.approx(beams.sum(), abs=0.02 * len(beams))
