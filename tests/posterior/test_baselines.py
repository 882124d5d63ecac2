"""Maps of other mappers: computed by hand, and fitted to training scans alone as well as can be."""

import dataclasses

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.kernels.counts import count_hits
from bayesmap.kernels.predict.density import log_densities
from bayesmap.kernels.rays import trace_rays
from bayesmap.posterior import baselines
from bayesmap.posterior.heldout import make_folds, together
from bayesmap.posterior.scores import score_prediction

BY_NAME = {b.name: b for b in baselines.BASELINES}
HITS, PASSES = np.array([0.0, 3.0, 1.0, 0.0]), np.array([0.0, 1.0, 9.0, 100.0])


def test_hit_ratios_and_log_odds_by_hand():
    found = baselines.hit_ratio(HITS, PASSES, {"a": 0.5, "b": 1.5})
    np.testing.assert_allclose(found, [0.25, 3.5 / 6, 1.5 / 12, 0.5 / 102])
    odds = np.array([1.0, (7 / 3) ** 3 * (2 / 3), (7 / 3) * (2 / 3) ** 9, (2 / 3) ** 100])
    np.testing.assert_allclose(BY_NAME["log-odds"].stop(HITS, PASSES, {}), odds / (1 + odds))
    np.testing.assert_allclose(
        BY_NAME["log-odds, clamped"].stop(HITS, PASSES, {}), np.clip(odds / (1 + odds), 0.1192, 0.971)
    )
    tuned = baselines.log_odds(HITS, PASSES, {"p_hit": 0.6, "p_miss": 0.45, "p_start": 0.2})
    assert tuned[0] == pytest.approx(0.2)
    assert tuned[1] == pytest.approx(1 / (1 + 4 * (2 / 3) ** 3 * (11 / 9)))
    assert baselines.log_odds(np.array([1e6]), np.array([0.0]), {"p_hit": 0.9, "p_miss": 0.4, "p_start": 0.5})[0] == 1.0


def test_a_climb_finds_the_top_within_the_box():
    parameters = (baselines.Parameter("x", 0.1, 10.0), baselines.Parameter("share", 0.01, 0.99, share=True))

    def hill(v):
        return -(np.log(v["x"] / 3.0) ** 2) - (v["share"] - 0.4) ** 2

    told = []
    found, top = baselines.maximise(
        hill, hill, parameters, [{"x": 0.2, "share": 0.9}, {"x": 9.0, "share": 0.1}], told.append
    )
    assert len(told) > 10
    assert (told, told[-1]) == (sorted(told), pytest.approx(1.0))
    assert (found["x"], found["share"]) == (pytest.approx(3.0, rel=0.02), pytest.approx(0.4, abs=0.02))
    assert top == pytest.approx(0.0, abs=1e-4)
    edge, _ = baselines.maximise(lambda v: v["x"], lambda v: v["x"], parameters[:1], [{"x": 1.0}])
    assert edge["x"] == pytest.approx(10.0)


@pytest.fixture(scope="module")
def room():
    """A room with a pillar of which half of the beams see nothing, scanned from forty places."""
    grid = bm.Grid((32, 24), 0.25)
    walls = np.zeros(grid.shape, bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[12:14, 10:12] = True
    rng = np.random.default_rng(5)
    poses = np.column_stack([rng.uniform(1, 2.5, 40), rng.uniform(1, 5, 40), rng.uniform(-4, 4, 40)])
    sensor = bm.BeamMixture(bm.Gaussian(0.04, 0.01), 0.04, 0.05, 0.1, 0.5)
    scans = bm.simulate(walls, grid, poses, np.linspace(0, 6.2, 30), sensor=sensor, max_range_m=6.0, seed=2)
    return grid, *scans.holdout(5), sensor


@pytest.fixture(scope="module")
def fitted(room):
    grid, train, _, _ = room
    return baselines.fit_baseline(BY_NAME["hit ratio"], train, grid)


def test_the_inner_score_is_the_mean_over_folds_of_whole_beams(room, fitted):
    """Beams are cut past their readings for fitting: the score is the same."""
    grid, train, _, _ = room
    folds, baseline = make_folds(train, grid), BY_NAME["hit ratio"]
    logs = []
    for fold in folds:
        stop = baseline.stop(fold.hits, fold.passes, fitted.values)[None].astype(np.float32)
        rays = trace_rays(fold.scans, grid)
        sensor, depth = fitted.predictor.sensor, fitted.values["hit_depth"]
        logs.append(log_densities(rays, [stop[:, rays.touched]], sensor, depth))
    dof = getattr(fitted.predictor.sensor.noise, "dof", None)
    found = baselines.inner_score(together(folds), baseline, dof, fitted.values)
    assert found == pytest.approx(np.concatenate(logs).mean(), abs=1e-4)
    assert found == pytest.approx(fitted.inner_nats_per_beam, abs=1e-9)


def test_no_change_of_a_single_number_fits_better(room, fitted):
    grid, train, _, _ = room
    folds, baseline = make_folds(train, grid), BY_NAME["hit ratio"]
    dof = getattr(fitted.predictor.sensor.noise, "dof", None)
    for parameter in (*baselines.SENSOR, *baseline.own):
        at = parameter.inner(fitted.values[parameter.name])
        for step in (-0.3, -0.1, 0.1, 0.3):
            moved = fitted.values | {parameter.name: parameter.outer(at + step)}
            assert baselines.inner_score(together(folds), baseline, dof, moved) < fitted.inner_nats_per_beam + 2e-4


def test_the_fit_predicts_held_out_scans_about_as_well_as_the_truth_s_own_sensor(room, fitted):
    """And better than the default sensor would, and its map is that of all training scans."""
    grid, train, held, sensor = room
    found = score_prediction(fitted.predictor, held).nats_per_beam
    own = dataclasses.replace(fitted.predictor, sensor=sensor)
    assert found > score_prediction(own, held).nats_per_beam - 0.05
    coarse = dataclasses.replace(fitted.predictor, sensor=bm.BeamMixture(bm.Gaussian(0.3)))
    assert found > score_prediction(coarse, held).nats_per_beam + 0.1
    hits, passes = count_hits(train, grid)
    (stop,) = fitted.predictor.batches(np.arange(grid.n_cells))
    np.testing.assert_allclose(stop[0], baselines.hit_ratio(hits, passes, fitted.values), rtol=1e-6)


@pytest.fixture(scope="module")
def seen():
    """A room in the middle of a grid of which beams touch less than a half: its map, and scans in it."""
    grid = bm.Grid((64, 48), 0.125)
    occupancy = np.full(grid.shape, np.nan)
    occupancy[20:52, 12:36] = 1.0
    occupancy[21:51, 13:35] = 0.0
    occupancy[34:36, 22:25] = 1.0
    rng = np.random.default_rng(5)
    poses = np.column_stack([rng.uniform(2.8, 4.0, 40), rng.uniform(1.8, 4.2, 40), rng.uniform(-4, 4, 40)])
    sensor = bm.BeamMixture(bm.Gaussian(0.03, 0.005), 0.02, 0.01, 0.02, 0.5)
    angles = np.linspace(0, 6.2, 30)
    scans = bm.simulate(occupancy == 1.0, grid, poses, angles, sensor=sensor, max_range_m=6.0, seed=2)
    return occupancy, grid, *scans.holdout(5)


@pytest.fixture(scope="module")
def fit(seen):
    occupancy, grid, train, _ = seen
    return baselines.fit_external_map("true.yaml", occupancy, grid, train)


def test_the_true_map_is_understood_and_predicts(seen, fit):
    """It was not, while cells that beams touch were given the values of the first ones of the grid."""
    occupancy, grid, _, held = seen
    (stop,) = fit.predictor.batches(np.arange(grid.n_cells))
    np.testing.assert_allclose(stop[0], baselines.stop_probabilities(occupancy.ravel(), fit.values), rtol=1e-6)
    assert fit.values["stop_occupied"] > 0.3
    assert fit.values["stop_free"] < 0.01
    found = score_prediction(fit.predictor, held).nats_per_beam
    assert found > 1.0
    assert found == pytest.approx(fit.inner_nats_per_beam, abs=0.2)  # what was fitted is what is scored


@pytest.mark.full
def test_a_map_of_another_place_predicts_far_worse(seen, fit):
    occupancy, grid, train, held = seen
    found = score_prediction(fit.predictor, held).nats_per_beam
    shuffled = np.random.default_rng(1).permutation(occupancy.ravel()).reshape(grid.shape)
    wrong = baselines.fit_external_map("shuffled.yaml", shuffled, grid, train)
    assert score_prediction(wrong.predictor, held).nats_per_beam < found - 1.5


def test_maps_of_another_shape_are_refused(seen):
    occupancy, grid, train, _ = seen
    short = baselines.Baseline("short", lambda hits, passes, values: np.full(hits.size - 1, 0.1))
    with pytest.raises(ValueError, match="short: stop gave an array of shape"):
        baselines.fit_baseline(short, train, grid)
    with pytest.raises(bm.BadInput, match="must be probabilities of shape"):
        baselines.fit_external_map("turned.yaml", occupancy.T, grid, train)
