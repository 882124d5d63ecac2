"""Predictions of data from the model itself are calibrated, those of a wrong twin are not; errors respect scans.

Seeds are fixed; false alarms of the statistical tests of this file: 1e-4 each.
"""

import dataclasses

import numpy as np
import pytest
import scipy
from oracle.verdict import ALPHA

import bayesmap as bm
from bayesmap.kernels.rays import trace_rays
from bayesmap.posterior import scores
from bayesmap.posterior.prediction import Predictor, fixed_maps
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((20, 16), 0.25)
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
    solid = np.where(rng.random(GRID.n_cells) < 0.12, 0.8, 0.005)
    stop = np.clip(solid * rng.uniform(0.5, 1.2, (3, GRID.n_cells)), 0, 1).astype(np.float32)
    poses = np.column_stack([rng.uniform(0.5, 3.5, (scans, 2)), rng.uniform(-4, 4, scans)])
    blank = bm.Scans(poses, np.linspace(0, 6, rays), np.ones((scans, rays)), max_range_m=4.0, min_range_m=0.2)
    traced = trace_rays(blank, GRID)
    where = traced.distance_m(DEPTH)
    d = np.full(blank.n_beams, np.inf)
    for b in range(blank.n_beams):
        mine = slice(traced.offsets[b], traced.offsets[b + 1])
        halts = rng.random(mine.stop - mine.start) < stop[rng.integers(3), traced.cells[mine]]
        if halts.any():
            d[b] = where[mine][halts.argmax()]
    z = sensor.sample(rng, d, LIMITS).reshape(scans, rays)
    return Predictor(GRID, fixed_maps(stop), sensor, DEPTH), dataclasses.replace(blank, ranges_m=z)


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
    {"batches": fixed_maps(np.full((1, GRID.n_cells), 0.11))},
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


def test_the_transform_spreads_atoms_and_histograms_intervals_scores_and_reliability_are_right_by_hand():
    u = scores.randomised_pit(np.array([0.2, 0.7] * 5000), np.array([0.2, 0.9] * 5000), seed=3)
    assert (u[::2] == 0.2).all()
    assert scipy.stats.kstest(u[1::2], "uniform", args=(0.7, 0.2)).pvalue > ALPHA
    np.testing.assert_array_equal(
        u[:100], scores.randomised_pit(np.array([0.2, 0.7] * 5000), np.array([0.2, 0.9] * 5000), 3)[:100]
    )
    u = np.array([0.01, 0.3, 0.5, 0.74, 0.99])
    np.testing.assert_allclose(scores.pit_histogram(u, 4), [0.2, 0.2, 0.4, 0.2])
    assert scores.pit_histogram(np.array([0.0, 1.0]), 2).tolist() == [0.5, 0.5]
    assert scores.inside(u, 0.5).tolist() == [False, True, True, True, False]
    brier, loss = scores.binary_scores(np.array([0.2, 0.2]), np.array([True, False]))
    np.testing.assert_allclose(brier, [0.64, 0.04])
    np.testing.assert_allclose(loss, [-np.log(0.2), -np.log(0.8)])
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
    unequal = scores.ScanBlocks.make(np.array([0] * 9 + [1]))
    assert unequal.mean(np.array([1.0] * 9 + [0.0])).value == pytest.approx(0.9)
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
