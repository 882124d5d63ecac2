"""Scores on held-out scans: by hand in small worlds, calibrated on data of the model; false alarms: 1e-4 each."""

import dataclasses
import functools
import json

import numpy as np
import pytest
import scipy
import warp as wp
from flat_options import infer
from oracle.enumeration import beams, distances
from oracle.verdict import ALPHA
from oracle.worlds import make_case

import bayesmap as bm
from bayesmap.cells import binary
from bayesmap.kernels.rays import trace_rays
from bayesmap.posterior import scores
from bayesmap.posterior.posterior import entropy_bits
from bayesmap.posterior.prediction import Predictor, fixed_maps, predictor_of
from bayesmap.posterior.scores import beam_log_scores, score_prediction
from bayesmap.sensors.model import RangeLimits


@pytest.fixture(scope="module")
def case():
    return make_case(21, sensor=bm.BeamMixture(bm.Gaussian(0.3)), n_poses=3)


@pytest.fixture(scope="module")
def run(case):
    return infer(case.scans, case.grid, prior=case.prior, sensor=case.sensor, chains=2, draws=50)


def test_occupancy_is_the_mean_of_the_draws_and_entropy_is_in_bits(run):
    np.testing.assert_allclose(run.occupancy, run.draws.mean(axis=(0, 1)), atol=1e-12)
    prior, draws = run.posterior.prior, run.posterior.draws
    none = dataclasses.replace(draws, arrays={name: values[:, :0] for name, values in draws.arrays.items()})
    assert np.isnan(prior.mean_map(none)).all()
    p = np.array([0.0, 0.5, 1.0, 0.25])
    expected = [0.0, 1.0, 0.0, -(0.25 * np.log2(0.25) + 0.75 * np.log2(0.75))]
    np.testing.assert_allclose(entropy_bits(p), expected, atol=1e-12)


def test_the_log_score_is_the_log_mean_density_over_draws(case, run):
    """Beam by beam, at the oracle's distances; invalid readings are left out."""
    held = make_case(22, sensor=case.sensor, n_poses=2).scans
    readings = held.ranges_m.copy()
    readings[0, :3] = [np.nan, np.inf, -np.inf]
    held = dataclasses.replace(held, ranges_m=readings)
    starts, angles = beams(held.poses, held.angles_rad, case.grid)
    limits, z = RangeLimits(held.min_range_m, held.max_range_m), held.ranges_m.ravel()
    worth = [
        case.sensor.log_likelihood(z, distances(walls, starts, angles) * case.grid.resolution, limits)
        for walls in run.draws.reshape(-1, 4, 4)
    ]
    plain = (scipy.special.logsumexp(worth, axis=0) - np.log(len(worth)))[~np.isnan(z)]
    found = beam_log_scores(predictor_of(run.posterior), held)
    np.testing.assert_array_equal(np.isnan(found), np.isnan(z))
    np.testing.assert_allclose(found[~np.isnan(z)], plain, atol=1e-6)
    assert run.log_score(held) == np.nanmean(found)


@pytest.mark.parametrize("score", [bm.Run.log_score, bm.score])
def test_scores_that_cannot_be_are_refused(case, run, score):
    posterior = run.posterior
    none = {name: values[:, :0] for name, values in posterior.draws.arrays.items()}
    no_draws = dataclasses.replace(posterior, draws=dataclasses.replace(posterior.draws, arrays=none))
    unknown = dataclasses.replace(posterior, sensor=None, settings=posterior.settings | {"sensor": {"kind": "X"}})
    empty = dataclasses.replace(case.scans, ranges_m=np.full(case.scans.ranges_m.shape, np.nan))
    for judged, scans, message in (
        (bm.Run(no_draws), case.scans, "the run has no draws yet; let it finish its warm-up"),
        (bm.Run(unknown), case.scans, "'X', is not one of bayesmap's; pass sensor="),
        (run, empty, "none of the scans has a valid reading"),
    ):
        with pytest.raises(bm.BadInput, match=message):
            score(judged, scans)


def test_the_device_is_the_caller_s_choice(case, run):
    """An absent device is refused; a GPU gives the CPU's scores."""
    assert run.log_score(case.scans, device="cpu") == run.log_score(case.scans)
    for made in (run.log_score, functools.partial(bm.score, run)):
        with pytest.raises(bm.BadInput, match="device: 'tpu:7' is not on this machine"):
            made(case.scans, device="tpu:7")
        if wp.is_cuda_available():
            on_gpu, here = made(case.scans, device="cuda"), made(case.scans)
            nats = [getattr(one, "nats_per_beam", one) for one in (on_gpu, here)]
            assert nats[0] == pytest.approx(nats[1], rel=1e-6)


def test_observed_cells_are_those_that_beams_reach_in_half_of_the_draws():
    """Behind a wall that is certain, nothing is observed, though beams would touch it on a free map."""
    grid = bm.Grid((6, 1))
    p = np.array([[0.1], [0.1], [1.0], [0.1], [0.1], [0.1]])
    scans = bm.Scans([-0.5, 0.5, 0.0], [0.0], [[2.5]], max_range_m=10.0)
    run = infer(scans, grid, prior=bm.Independent(p), sensor=bm.Gaussian(0.3), draws=100)
    np.testing.assert_array_equal(run.observed.ravel(), [True, True, True, False, False, False])


def test_the_summary_is_json_names_problems_and_judges_the_map_not_single_cells_or_sums(run):
    summary = run.summary()
    assert summary is run.summary()
    assert json.loads(json.dumps(summary.as_json(), allow_nan=False))["finished"] is True
    assert summary.unchanged_cells == (run.draws == run.draws[:1, :1]).all(axis=(0, 1)).sum()
    bad = dataclasses.replace(
        summary, map_error=0.12, precision=0.03, disagreeing_cells=3, judged_cells=100, finished=False,
        effective_sample_size=5.0,
    )  # fmt: skip
    problems = " / ".join(bad.problems())
    for words in ("stopped before", "known to 0.120", "good up to 0.1: infer", "3 cells are stuck", "of 5.0"):
        assert words in problems
    good = dataclasses.replace(
        run.summary(), rhat_log_joint=1.2, rhat_log_likelihood=1.2, rhat_max=1.3, ess_min=12.0, rhat_high_cells=30,
        ess_low_cells=20, disagreeing_cells=1, judged_cells=100, map_error=0.03, precision=0.03,
    )  # fmt: skip
    assert good.problems() == []
    assert "1.200 of the likelihood" in str(good)


@pytest.mark.parametrize("method", ["exact", "importance", "propagate"])
def test_methods_without_chains_have_no_r_hat(case, method):
    run = infer(case.scans, case.grid, prior=case.prior, sensor=case.sensor, method=method, draws=10, particles=1000)
    summary = run.summary()
    assert np.isnan([summary.rhat_log_joint, summary.rhat_max, summary.ess_min]).all()
    assert np.isfinite(summary.effective_sample_size) == (method == "importance")


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
    predictor = Predictor(GRID, fixed_maps(np.array([[0.3, 0.5]])), SENSOR, 0.0)
    found = score_prediction(predictor, scans, on_progress=told.append)
    assert (told, told[-1]) == (sorted(told), pytest.approx(1.0))
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
    ranges = np.linspace(0, 4, 40_001)
    low, high = np.interp([0.25, 0.75], below(ranges), ranges)
    assert half.mean_width_m == pytest.approx(min(high, 4.0) - low, abs=1e-3)
    assert half.median_width_m == pytest.approx(half.mean_width_m)


@pytest.fixture(scope="module")
def deep(case):
    return infer(case.scans, case.grid, prior=case.prior, sensor=case.sensor, chains=2, draws=50, hit_depth=0.3)


def test_a_run_s_nats_are_its_log_score_and_errors_depend_on_the_seed_alone(case, deep):
    held = make_case(22, sensor=case.sensor, n_poses=4).scans
    found = bm.score(deep, held)
    assert found.nats_per_beam == pytest.approx(deep.log_score(held), abs=2e-4)  # a robust table's flat nats
    assert found.beams == len(found.pit) == (~np.isnan(held.ranges_m)).sum()
    assert (sum(found.pit_histogram), found.sensor["kind"]) == (pytest.approx(1.0), "mixture")
    assert found.hit_depth == 0.3
    first, again, other = (bm.score(deep, held, seed=seed).as_json() for seed in (1, 1, 2))
    assert (first, first["nats_per_beam"]) == (again, other["nats_per_beam"])
    assert first["nats_per_beam_error"] != other["nats_per_beam_error"]
    single = json.loads(json.dumps(bm.score(deep, held.select(slice(0, 1))).as_json(), allow_nan=False))
    assert single["nats_per_beam_error"] is None
    assert [c["level"] for c in single["coverage"]] == [0.5, 0.8, 0.95]


def test_scans_that_never_reach_the_map_have_no_events_and_many_draws_are_taken_some_at_a_time(case, deep, monkeypatch):
    found = bm.score(deep, bm.Scans([900.0, 900.0, 0.0], [0.0, 1.0], [[1.0, np.inf]], max_range_m=3.0, min_range_m=0.1))
    assert found.events == 0
    assert np.isnan(found.brier.value)
    assert json.dumps(found.as_json(), allow_nan=False)
    whole = bm.score(deep, case.scans).as_json()
    monkeypatch.setattr(binary, "BATCH_BYTES", 4 * 16 * 7)
    assert bm.score(deep, case.scans).as_json() == whole


HALL = bm.Grid((20, 16), 0.25)
LIMITS = RangeLimits(0.2, 4.0)
DEPTH = 0.4
SENSORS = {
    "mixture": bm.BeamMixture(bm.Gaussian(0.05, 0.01), 0.05, 0.1, 0.1, 0.5),
    "student-t mixture": bm.BeamMixture(bm.StudentT(0.05, 4.0), 0.02, 0.05, 0.05, 0.5),
    "gaussian": bm.Gaussian(0.1),
}


def drawn_from_the_model(sensor, seed, scans=150, rays=24):
    """Maps, and readings each drawn from one of them: stop by stop, then by the sensor."""
    rng = np.random.default_rng(seed)
    solid = np.where(rng.random(HALL.n_cells) < 0.12, 0.8, 0.005)
    stop = np.clip(solid * rng.uniform(0.5, 1.2, (3, HALL.n_cells)), 0, 1).astype(np.float32)
    poses = np.column_stack([rng.uniform(0.5, 3.5, (scans, 2)), rng.uniform(-4, 4, scans)])
    blank = bm.Scans(poses, np.linspace(0, 6, rays), np.ones((scans, rays)), max_range_m=4.0, min_range_m=0.2)
    traced = trace_rays(blank, HALL)
    where = traced.stop_distance_m(DEPTH)
    d = np.full(blank.n_beams, np.inf)
    for b in range(blank.n_beams):
        mine = slice(traced.offsets[b], traced.offsets[b + 1])
        halts = rng.random(mine.stop - mine.start) < stop[rng.integers(3), traced.cells[mine]]
        if halts.any():
            d[b] = where[mine][halts.argmax()]
    z = sensor.sample(rng, d, LIMITS).reshape(scans, rays)
    return Predictor(HALL, fixed_maps(stop), sensor, DEPTH), dataclasses.replace(blank, ranges_m=z)


@pytest.mark.parametrize("name", SENSORS)
def test_predictions_of_the_model_s_own_data_are_calibrated(name):
    predictor, scans = drawn_from_the_model(SENSORS[name], 1)
    found = scores.score_prediction(predictor, scans)
    assert scipy.stats.kstest(found.pit, "uniform").pvalue > ALPHA
    for interval in found.coverage:
        inside_all = round(interval.share.value * found.beams)
        assert scipy.stats.binomtest(inside_all, found.beams, interval.level).pvalue > ALPHA
    # Each event has its chance given all before it: the sum of surprises is a martingale.
    predicted = np.array([p * n for p, _, n in found.reliability]).sum()
    happened = np.array([share * n for _, share, n in found.reliability]).sum()
    assert abs(happened - predicted) < 4 * np.sqrt(found.brier.value * found.events)
    if name != "gaussian":
        p, share = found.p_no_return
        assert abs(p - share) < 4 * np.sqrt(p * (1 - p) / found.beams)


@pytest.mark.parametrize("change", [
    {"sensor": bm.BeamMixture(bm.Gaussian(0.09, 0.01), 0.05, 0.1, 0.1, 0.5)},
    {"sensor": bm.BeamMixture(bm.Gaussian(0.05, 0.01), 0.05, 0.2, 0.1, 0.5)},
    {"hit_depth": 0.8},
    {"batches": fixed_maps(np.full((1, HALL.n_cells), 0.11))},
], ids=["noise too wide", "too many lost beams", "another depth", "a map of the mean"])  # fmt: skip
def test_predictions_of_a_wrong_twin_are_not_calibrated(change):
    """Power of the test above, and what is wrong never scores better."""
    predictor, scans = drawn_from_the_model(SENSORS["mixture"], 1)
    right = scores.score_prediction(predictor, scans)
    wrong = scores.score_prediction(dataclasses.replace(predictor, **change), scans)
    assert scipy.stats.kstest(wrong.pit, "uniform").pvalue < ALPHA
    assert wrong.pit_p_value < 0.01 < right.pit_p_value
    assert wrong.nats_per_beam < right.nats_per_beam
    assert wrong.log_loss.value > right.log_loss.value


def test_the_transform_spreads_atoms_and_histograms_and_reliability_are_right_by_hand():
    u, again = (scores.randomised_pit(np.array([0.2, 0.7] * 5000), np.array([0.2, 0.9] * 5000), 3) for _ in range(2))
    assert (u[::2] == 0.2).all()
    assert scipy.stats.kstest(u[1::2], "uniform", args=(0.7, 0.2)).pvalue > ALPHA
    np.testing.assert_array_equal(u, again)
    u = np.array([0.01, 0.3, 0.5, 0.74, 0.99])
    np.testing.assert_allclose(scores.pit_histogram(u, 4), [0.2, 0.2, 0.4, 0.2])
    assert scores.pit_histogram(np.array([0.0, 1.0]), 2).tolist() == [0.5, 0.5]
    chance = np.array([1e-5, 5e-4, 0.6, 0.8])
    rows = scores.reliability(chance, np.array([False, False, True, True]))
    assert [n for *_, n in rows] == [2, 2]
    np.testing.assert_allclose(rows[1][:2], (0.7, 1.0))


def test_errors_are_those_of_means_over_scans_and_the_test_of_uniformity_respects_them_too():
    """Items of a scan are copies of one number: a bootstrap over items would be seven times too sure."""
    rng = np.random.default_rng(1)
    of_scan = rng.normal(size=200)
    found = scores.ScanBlocks.make(np.repeat(np.arange(200), 50)).mean(np.repeat(of_scan, 50))
    assert found.value == pytest.approx(of_scan.mean())
    assert found.error == pytest.approx(of_scan.std() / np.sqrt(200), rel=0.1)
    assert scores.ScanBlocks.make(np.array([0] * 9 + [1])).mean(np.array([1.0] * 9 + [0.0])).value == pytest.approx(0.9)
    single = scores.ScanBlocks.make(np.zeros(5, int))
    assert np.isnan(single.mean(np.arange(5.0)).error)
    distance, p = single.uniformity(np.linspace(0.01, 0.99, 5))
    assert np.isnan(p)
    assert 0 < distance < 0.5
    rng = np.random.default_rng(2)
    u = np.clip(np.repeat((np.arange(80) + 0.5) / 80, 40) + rng.normal(0, 0.02, 3200), 0, 1)
    u = np.where(rng.random(3200) < 0.5, u, u**1.15)
    block = np.repeat(rng.permutation(80), 40)
    assert scipy.stats.kstest(u, "uniform").pvalue < 0.05
    assert scores.ScanBlocks.make(block).uniformity(u)[1] > 0.2
    assert scores.ScanBlocks.make(block).uniformity(u**2)[1] == 0.0
