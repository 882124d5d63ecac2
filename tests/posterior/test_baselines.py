"""Only scans that a run has not seen judge it; folds of training scans; maps of other mappers, by hand and fitted."""

import dataclasses

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.kernels.predict.density import log_densities
from bayesmap.kernels.rays import count_hits, trace_rays
from bayesmap.posterior import baselines, heldout
from bayesmap.posterior.baselines import hit_ratio
from bayesmap.posterior.heldout import join_folds, make_folds
from bayesmap.posterior.scores import score_prediction


@pytest.fixture
def log():
    """Twenty scans of which two read alike."""
    rng = np.random.default_rng(1)
    readings = rng.uniform(0.1, 5.0, (20, 8))
    readings[3, 2:4] = [np.inf, np.nan]
    readings[8] = readings[7]
    return bm.Scans(rng.uniform(0, 5, (20, 3)), np.linspace(0, 1, 8), readings, max_range_m=6.0)


def test_a_scan_is_known_by_readings_and_pose_or_stamp_and_moved_or_thinned_ones_cannot_judge(log):
    np.testing.assert_array_equal(np.flatnonzero(heldout.match_scans(log.select(slice(2, 5)), log) >= 0), [2, 3, 4])
    moved = dataclasses.replace(log, poses=log.poses + 1.0)
    assert not (heldout.match_scans(log, moved) >= 0).any()
    assert not (heldout.match_scans(log, dataclasses.replace(log, angles_rad=log.angles_rad + 0.1)) >= 0).any()
    stamped = dataclasses.replace(log, stamps_s=np.arange(20.0))
    run = dataclasses.replace(stamped, poses=stamped.poses + 1.0).select(slice(2, 8))
    np.testing.assert_array_equal(np.flatnonzero(heldout.match_scans(run, stamped) >= 0), np.arange(2, 8))
    assert heldout.has_moved_scans(run, stamped)
    assert not heldout.has_moved_scans(stamped.select(slice(2, 8)), stamped)
    assert not (heldout.match_scans(run, dataclasses.replace(stamped, ranges_m=stamped.ranges_m + 0.01)) >= 0).any()
    assert not (heldout.match_scans(run, dataclasses.replace(stamped, stamps_s=stamped.stamps_s + 0.5)) >= 0).any()
    blind = dataclasses.replace(stamped, ranges_m=np.full(stamped.ranges_m.shape, np.inf))
    assert (heldout.match_scans(blind, blind) >= 0).all()
    assert not (heldout.match_scans(dataclasses.replace(blind, poses=blind.poses + 1.0), blind) >= 0).any()
    moved = dataclasses.replace(stamped, poses=stamped.poses + 1.0)
    with pytest.raises(heldout.NoneHeldOut, match=r"a.log: the run has its scans elsewhere than this log"):
        heldout.unseen_scans(moved.holdout(5)[0], stamped, 5, "a.log")
    with pytest.raises(bm.BadInput, match="the run was made from 20 of its 20 scans"):
        heldout.unseen_scans(moved, stamped, 0, "a.log")
    run = dataclasses.replace(moved, ranges_m=moved.ranges_m[:, ::2], angles_rad=moved.angles_rad[::2])
    with pytest.raises(heldout.NoneHeldOut, match="elsewhere"):
        heldout.unseen_scans(run.select(slice(2, 8)), stamped, 4, "log")
    other = dataclasses.replace(stamped, stamps_s=stamped.stamps_s + 0.5)
    with pytest.raises(bm.BadInput, match="none of the run's scans"):
        heldout.unseen_scans(run, other, 4, "log")


def test_the_held_out_scans_are_those_of_the_protocol_and_another_recording_is_taken_whole(log):
    train, held = log.holdout(5)
    np.testing.assert_array_equal(heldout.unseen_scans(train, log, 5, "a.log").ranges_m, held.ranges_m)
    assert len(heldout.unseen_scans(train.select(slice(None, None, 2)), log, 5, "a.log")) == len(held)
    other = dataclasses.replace(log, poses=log.poses + 1.0)
    assert heldout.unseen_scans(log, other, 0, "b.log") is other


@pytest.mark.parametrize(("train", "every", "message"), [
    (lambda log: log, 5, r"a.log: the run was made without holding scans out.*bayesmap infer --holdout 5"),
    (lambda log: log.holdout(4)[0], 5, r"has seen \d of the 4 scans that would .*; it was made with --holdout 4"),
    (lambda log: log.select(slice(1, 20)), 5, "the run has seen 4 of the 4 .*; other scans were held out"),
    (lambda log: log.holdout(5)[0], 0, r"the run was made from 16 of its 20 scans; --all is for another recording"),
    (lambda log: dataclasses.replace(log, poses=log.poses + 1), 5, "none of the run's scans is in it.*--all"),
    (lambda log: log.holdout(5)[0], 1, "n >= 2, got 1"),
    (lambda log: log.holdout(5)[0], 100, "20 scans are too few"),
])  # fmt: skip
def test_scans_that_were_trained_on_are_refused(log, train, every, message):
    with pytest.raises(bm.BadInput, match=message):
        heldout.unseen_scans(train(log), log, every, "a.log")


def test_folds_leave_each_scan_out_of_its_own_counts_and_too_few_scans_are_refused(room):
    grid, train, *_ = room
    folds = heldout.make_folds(train, grid)
    assert len(folds) == heldout.FOLDS  # so few beams that all ways are taken
    assert sum(len(fold.scans) for fold in folds) == len(train)
    for fold in folds:
        own = {pose.tobytes() for pose in fold.scans.poses}
        hits, passes = count_hits(train.select(np.array([pose.tobytes() not in own for pose in train.poses])), grid)
        np.testing.assert_array_equal(fold.hits, hits)
        np.testing.assert_array_equal(fold.passes, passes)
    with pytest.raises(bm.BadInput, match="takes two scans or more"):
        heldout.make_folds(train.select(slice(0, 1)), grid)
    blind = dataclasses.replace(train, ranges_m=np.full(train.ranges_m.shape, np.nan))
    with pytest.raises(bm.BadInput, match="none of the training scans has a valid reading"):
        heldout.make_folds(blind, grid)
    with pytest.raises(bm.BadInput, match="to fit a sensor on"):
        heldout.one_fold(blind, grid)


def test_together_they_are_predicted_as_each_alone(room):
    """Each under its own counts: the same bits, and other ones under another's."""
    grid, train, *_ = room
    sensor = bm.BeamMixture(bm.Gaussian(0.05))
    folds = heldout.make_folds(train, grid)[:3]

    def maps(fold, of):
        return hit_ratio(of.hits, of.passes, {"a": 0.5, "b": 0.5})[fold.rays.touched][None].astype(np.float32)

    alone = [log_densities(fold.rays, [maps(fold, fold)], sensor, 0.5) for fold in folds]
    joined = heldout.join_folds(folds)
    of_all = np.concatenate([maps(fold, fold) for fold in folds], axis=1)
    found = log_densities(joined.rays, [of_all], sensor, 0.5, columns=joined.columns)
    np.testing.assert_array_equal(found, np.concatenate(alone))
    swapped = np.concatenate([maps(fold, of) for fold, of in zip(folds, folds[::-1], strict=True)], axis=1)
    assert (log_densities(joined.rays, [swapped], sensor, 0.5, columns=joined.columns) != found).any()


BY_NAME = {b.name: b for b in baselines.BASELINES}
HITS, PASSES = np.array([0.0, 3.0, 1.0, 0.0]), np.array([0.0, 1.0, 9.0, 100.0])


def test_hit_ratios_and_log_odds_by_hand():
    found = baselines.hit_ratio(HITS, PASSES, {"a": 0.5, "b": 1.5})
    np.testing.assert_allclose(found, [0.25, 3.5 / 6, 1.5 / 12, 0.5 / 102])
    odds = np.array([1.0, (7 / 3) ** 3 * (2 / 3), (7 / 3) * (2 / 3) ** 9, (2 / 3) ** 100])
    stop, clamped = (BY_NAME[name].stop(HITS, PASSES, {}) for name in ("log-odds", "log-odds, clamped"))
    np.testing.assert_allclose(stop, odds / (1 + odds))
    np.testing.assert_allclose(clamped, np.clip(stop, 0.1192, 0.971))
    tuned = baselines.odds_map(HITS, PASSES, {"p_hit": 0.6, "p_miss": 0.45, "p_start": 0.2})
    assert tuned[0] == pytest.approx(0.2)
    assert tuned[1] == pytest.approx(1 / (1 + 4 * (2 / 3) ** 3 * (11 / 9)))
    assert baselines.odds_map(np.array([1e6]), np.array([0.0]), {"p_hit": 0.9, "p_miss": 0.4, "p_start": 0.5})[0] == 1.0


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
    told, (grid, train, _, _) = [], room
    found = baselines.fit_baseline(BY_NAME["hit ratio"], train, grid, on_progress=told.append)
    assert (len(told) > 10, told, told[-1]) == (True, sorted(told), pytest.approx(1.0))
    return found


def test_the_inner_score_is_the_mean_over_folds_of_whole_beams_and_no_change_of_a_number_is_better(room, fitted):
    """Beams are cut past their readings for fitting: the score is the same."""
    grid, train, _, _ = room
    folds, baseline = make_folds(train, grid), BY_NAME["hit ratio"]
    logs = []
    for fold in folds:
        stop = baseline.stop(fold.hits, fold.passes, fitted.values)[None].astype(np.float32)
        rays = trace_rays(fold.scans, grid)
        sensor, depth = fitted.predictor.sensor, fitted.values["hit_depth"]
        logs.append(log_densities(rays, [stop[:, rays.touched]], sensor, depth))
    found = np.nanmean(baselines.inner_log_densities(join_folds(folds), baseline, fitted.values))
    assert found == pytest.approx(np.concatenate(logs).mean(), abs=1e-4)
    assert found == pytest.approx(fitted.inner_nats_per_beam, abs=1e-9)
    for parameter in (*baselines.SENSOR, *baseline.parameters):
        at = parameter.encode(fitted.values[parameter.name])
        for step in (-0.3, -0.1, 0.1, 0.3):
            moved = fitted.values | {parameter.name: parameter.decode(at + step)}
            nats = np.nanmean(baselines.inner_log_densities(join_folds(folds), baseline, moved))
            assert nats < fitted.inner_nats_per_beam + 2e-4


def test_the_fit_predicts_held_out_scans_about_as_well_as_the_truth_s_own_sensor(room, fitted):
    """It predicts better than a coarse sensor, and its map is made from all training scans."""
    grid, train, held, sensor = room
    found = score_prediction(fitted.predictor, held).nats_per_beam
    assert found > score_prediction(dataclasses.replace(fitted.predictor, sensor=sensor), held).nats_per_beam - 0.05
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
    scans = bm.simulate(occupancy == 1.0, grid, poses, np.linspace(0, 6.2, 30), sensor=sensor, max_range_m=6.0, seed=2)
    return occupancy, grid, *scans.holdout(5)


@pytest.fixture(scope="module")
def true_fit(seen):
    occupancy, grid, train, held = seen
    fit = baselines.fit_external_map("true.yaml", occupancy, grid, train)
    return fit, score_prediction(fit.predictor, held).nats_per_beam


def test_the_true_map_is_understood_and_predicts(seen, true_fit):
    """It was not, while cells that beams touch were given the values of the first ones of the grid."""
    (occupancy, grid, _, _), (fit, nats) = seen, true_fit
    (stop,) = fit.predictor.batches(np.arange(grid.n_cells))
    np.testing.assert_allclose(stop[0], baselines.stop_probabilities(occupancy.ravel(), fit.values), rtol=1e-6)
    assert fit.values["stop_occupied"] > 0.3
    assert fit.values["stop_free"] < 0.01
    assert nats > 1.0
    assert nats == pytest.approx(fit.inner_nats_per_beam, abs=0.2)  # what was fitted is what is scored


def test_a_map_of_another_place_predicts_worse_and_one_of_another_shape_is_refused(seen, true_fit):
    (occupancy, grid, train, held), (_, nats) = seen, true_fit
    shuffled = np.random.default_rng(1).permutation(occupancy.ravel()).reshape(grid.shape)
    twin = baselines.fit_external_map("shuffled.yaml", shuffled, grid, train)
    assert score_prediction(twin.predictor, held).nats_per_beam < nats - 1.5
    short = baselines.Baseline("short", lambda hits, passes, values: np.full(hits.size - 1, 0.1))
    with pytest.raises(ValueError, match="short: stop gave shape"):
        baselines.fit_baseline(short, train, grid)
    with pytest.raises(bm.BadInput, match="must be probabilities of shape"):
        baselines.fit_external_map("turned.yaml", occupancy.T, grid, train)
