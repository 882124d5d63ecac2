"""`bayesmap.score` on worlds small enough to score by hand."""

import dataclasses
import json

import numpy as np
import pytest
import scipy
from flat_options import infer
from oracle.worlds import make_case

import bayesmap as bm
from bayesmap.posterior.predictor import Predictor, fixed_maps
from bayesmap.posterior.scores import score_prediction

GRID = bm.Grid((2, 1))
SENSOR = bm.BeamMixture(bm.Gaussian(0.1), 0.1, 0.2, 0.0)


def below(z):
    """P(reading <= z) of a beam from the left through cells with stop probabilities 0.3 and 0.5, hit at their edges."""
    walls = 0.3 * scipy.stats.norm.cdf(z, 1.0, 0.1) + 0.35 * scipy.stats.norm.cdf(z, 2.0, 0.1)
    return 0.1 * z / 4.0 + 0.9 * 0.8 * walls


def test_three_beams_by_hand():
    z = np.array([1.05, 2.4, np.inf])
    scans = bm.Scans(np.tile([-1.0, 0.5, 0.0], (3, 1)), [0.0], z[:, None], max_range_m=4.0)
    told = []
    found = score_prediction(
        Predictor(GRID, fixed_maps(np.array([[0.3, 0.5]])), SENSOR, 0.0), scans, on_progress=told.append
    )
    assert told == sorted(told)
    assert told[-1] == pytest.approx(1.0)
    p_none = 1.0 - below(4.0)
    density = [
        0.1 / 4 + 0.72 * (0.3 * scipy.stats.norm.pdf(r, 1.0, 0.1) + 0.35 * scipy.stats.norm.pdf(r, 2.0, 0.1))
        for r in z[:2]
    ]
    assert (found.beams, found.scans) == (3, 3)
    assert found.nats_per_beam == pytest.approx(np.log([*density, p_none]).mean(), abs=1e-6)
    np.testing.assert_allclose(found.pit[:2], below(z[:2]), atol=1e-6)
    assert 1 - p_none <= found.pit[2] <= 1.0
    assert found.p_no_return == (pytest.approx(p_none, abs=1e-6), pytest.approx(1 / 3))

    first, second = (below(2.0) - below(1.0)) / (1 - below(1.0)), (below(3.0) - below(2.0)) / (1 - below(2.0))
    chance, happened = np.array([first, first, second, first, second]), np.array([1, 0, 1, 0, 0])
    assert found.events == 5
    assert found.brier.value == pytest.approx(((chance - happened) ** 2).mean(), abs=1e-6)
    assert found.log_loss.value == pytest.approx(-np.log(np.where(happened, chance, 1 - chance)).mean(), abs=1e-5)
    for interval in found.coverage:
        assert interval.share.value == pytest.approx((abs(found.pit - 0.5) <= interval.level / 2).mean())
    half = found.coverage[0]
    low, high = (
        np.interp(level, below(np.linspace(0, 4, 40_001)), np.linspace(0, 4, 40_001)) for level in (0.25, 0.75)
    )
    assert half.mean_width_m == pytest.approx(min(high, 4.0) - low, abs=1e-3)
    assert half.median_width_m == pytest.approx(half.mean_width_m)


@pytest.fixture(scope="module")
def case():
    return make_case(21, sensor=bm.BeamMixture(bm.Gaussian(0.3)), n_poses=3)


@pytest.fixture(scope="module")
def run(case):
    return infer(case.scans, case.grid, prior=case.prior, sensor=case.sensor, chains=2, draws=50, hit_depth=0.3)


def test_a_run_s_nats_are_its_log_score(case, run):
    held = make_case(22, sensor=case.sensor, n_poses=4).scans
    found = bm.score(run, held)
    assert found.nats_per_beam == pytest.approx(run.log_score(held), abs=2e-4)  # a robust table's flat nats
    assert found.beams == len(found.pit) == (~np.isnan(held.ranges_m)).sum()
    assert sum(found.pit_histogram) == pytest.approx(1.0)
    assert found.sensor["kind"] == "mixture"
    assert found.hit_depth == 0.3


def test_a_score_depends_on_its_seed_alone(case, run):
    held = make_case(22, sensor=case.sensor, n_poses=4).scans
    first, again, other = (bm.score(run, held, seed=seed).as_json() for seed in (1, 1, 2))
    assert first == again
    assert first["nats_per_beam"] == other["nats_per_beam"]
    assert first["nats_per_beam_error"] != other["nats_per_beam_error"]


def test_a_score_of_a_single_scan_is_json(case, run):
    held = make_case(22, sensor=case.sensor, n_poses=1).scans
    document = json.loads(json.dumps(bm.score(run, held).as_json(), allow_nan=False))
    assert document["nats_per_beam_error"] is None
    assert [c["level"] for c in document["coverage"]] == [0.5, 0.8, 0.95]


def test_scans_that_never_reach_the_map_have_no_events(run):
    away = bm.Scans([900.0, 900.0, 0.0], [0.0, 1.0], [[1.0, np.inf]], max_range_m=3.0, min_range_m=0.1)
    found = bm.score(run, away)
    assert found.events == 0
    assert np.isnan(found.brier.value)
    assert json.dumps(found.as_json(), allow_nan=False)


def test_many_draws_are_taken_some_at_a_time(case, run, monkeypatch):
    from bayesmap.cells import binary

    whole = bm.score(run, case.scans).as_json()
    monkeypatch.setattr(binary, "BATCH_BYTES", 4 * 16 * 7)
    assert bm.score(run, case.scans).as_json() == whole


@pytest.mark.parametrize("prior", [bm.Beta(0.3, 0.5), bm.Surface()], ids=["reflectivity", "surface"])
def test_cells_that_stop_some_beams_are_scored_alike(case, prior):
    """Against the samplers' own log score, which is computed in single precision."""
    run = infer(case.scans, case.grid, prior=prior, sensor=case.sensor, chains=2, warmup=10, draws=20)
    held = make_case(22, sensor=case.sensor, n_poses=4).scans
    held = dataclasses.replace(held, ranges_m=np.where(np.isneginf(held.ranges_m), np.nan, held.ranges_m))
    found = bm.score(run, held)
    assert found.nats_per_beam == pytest.approx(run.log_score(held), abs=2e-3)
    assert 0 < found.coverage[0].share.value <= found.coverage[2].share.value
    assert bm.score(run, held, sensor=bm.Gaussian(0.1)).nats_per_beam < found.nats_per_beam
