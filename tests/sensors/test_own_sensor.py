"""The sensor model of the contributor's page: three methods, and everything works with it."""

import re
from pathlib import Path

import numpy as np
import pytest
from oracle.stop_worlds import scans_of_all_kinds

import bayesmap as bm
from bayesmap.posterior.predictor import predictor_of
from bayesmap.posterior.scores import beam_log_scores

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
