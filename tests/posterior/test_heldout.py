"""Only scans that a run has not seen may judge it; folds of training scans are each left out once."""

import dataclasses

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.kernels.counts import count_hits
from bayesmap.kernels.predict.density import log_densities
from bayesmap.posterior import heldout
from bayesmap.posterior.baselines import hit_ratio


@pytest.fixture
def log():
    rng = np.random.default_rng(1)
    readings = rng.uniform(0.1, 5.0, (20, 8))
    readings[3, 2:4] = [np.inf, np.nan]
    return bm.Scans(rng.uniform(0, 5, (20, 3)), np.linspace(0, 1, 8), readings, max_range_m=6.0)


@pytest.fixture
def stamped(log):
    """The same with stamps; two scans read alike."""
    readings = log.ranges_m.copy()
    readings[8] = readings[7]
    return dataclasses.replace(log, ranges_m=readings, stamps_s=np.arange(20.0))


def test_a_scan_is_known_by_its_pose_and_readings(log):
    seen = heldout.seen_by(log.select(slice(2, 5)), log)
    np.testing.assert_array_equal(np.flatnonzero(seen), [2, 3, 4])
    moved = dataclasses.replace(log, poses=log.poses + 1.0)
    assert not heldout.seen_by(log, moved).any()
    assert not heldout.seen_by(log, dataclasses.replace(log, angles_rad=log.angles_rad + 0.1)).any()


def test_where_scans_have_stamps_their_poses_may_be_inferred(stamped):
    run = dataclasses.replace(stamped, poses=stamped.poses + 1.0).select(slice(2, 8))
    np.testing.assert_array_equal(np.flatnonzero(heldout.seen_by(run, stamped)), np.arange(2, 8))
    assert heldout.moved_by(run, stamped)
    assert not heldout.moved_by(stamped.select(slice(2, 8)), stamped)
    assert not heldout.seen_by(run, dataclasses.replace(stamped, ranges_m=stamped.ranges_m + 0.01)).any()
    assert not heldout.seen_by(run, dataclasses.replace(stamped, stamps_s=stamped.stamps_s + 0.5)).any()


def test_a_scan_without_a_hit_is_that_of_a_run_only_where_it_stands(stamped):
    """Two recordings whose clocks both begin at 0 have such scans in common, but not their poses."""
    blind = dataclasses.replace(stamped, ranges_m=np.full(stamped.ranges_m.shape, np.inf))
    assert heldout.seen_by(blind, blind).all()
    assert not heldout.seen_by(dataclasses.replace(blind, poses=blind.poses + 1.0), blind).any()


def test_scans_that_a_run_has_moved_cannot_judge_it(stamped):
    moved = dataclasses.replace(stamped, poses=stamped.poses + 1.0)
    with pytest.raises(heldout.NoneHeldOut, match=r"a.log: the run has its scans elsewhere than this log"):
        heldout.unseen_scans(moved.holdout(5)[0], stamped, 5, "a.log")
    with pytest.raises(bm.BadInput, match="the run was made from 20 of its 20 scans"):
        heldout.unseen_scans(moved, stamped, 0, "a.log")


def test_the_held_out_scans_are_those_of_the_protocol_and_another_recording_is_taken_whole(log):
    train, held = log.holdout(5)
    found = heldout.unseen_scans(train, log, 5, "a.log")
    np.testing.assert_array_equal(found.ranges_m, held.ranges_m)
    thinned = train.select(slice(None, None, 2))
    assert len(heldout.unseen_scans(thinned, log, 5, "a.log")) == len(held)
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


GRID = bm.Grid((20, 30), 0.2)


@pytest.fixture(scope="module")
def train():
    """Forty scans in a room with a pillar."""
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[12:14, 10:12] = True
    rng = np.random.default_rng(5)
    poses = np.column_stack([rng.uniform(1, 2.2, 40), rng.uniform(1, 5, 40), rng.uniform(-4, 4, 40)])
    sensor = bm.BeamMixture(bm.Gaussian(0.04, 0.01), 0.04, 0.05, 0.1, 0.5)
    return bm.simulate(walls, GRID, poses, np.linspace(0, 6.2, 60), sensor=sensor, max_range_m=6.0, seed=2)


def test_folds_leave_each_scan_out_of_its_own_counts(train):
    folds = heldout.make_folds(train, GRID)
    assert len(folds) == heldout.FOLDS  # so few beams that all ways are taken
    assert sum(len(fold.scans) for fold in folds) == len(train)
    for fold in folds:
        own = {pose.tobytes() for pose in fold.scans.poses}
        others = train.select(np.array([pose.tobytes() not in own for pose in train.poses]))
        hits, passes = count_hits(others, GRID)
        np.testing.assert_array_equal(fold.hits, hits)
        np.testing.assert_array_equal(fold.passes, passes)


def test_together_they_are_predicted_as_each_alone(train):
    """Each under its own counts: the same bits, and other ones under another's."""
    sensor = bm.BeamMixture(bm.Gaussian(0.05))
    folds = heldout.make_folds(train, GRID)[:3]

    def maps(fold, of):
        return hit_ratio(of.hits, of.passes, {"a": 0.5, "b": 0.5})[fold.rays.touched][None].astype(np.float32)

    alone = [log_densities(fold.rays, [maps(fold, fold)], sensor, 0.5) for fold in folds]
    joined = heldout.together(folds)
    of_all = np.concatenate([maps(fold, fold) for fold in folds], axis=1)
    found = log_densities(joined.rays, [of_all], sensor, 0.5, columns=joined.columns)
    np.testing.assert_array_equal(found, np.concatenate(alone))
    swapped = np.concatenate([maps(fold, of) for fold, of in zip(folds, folds[::-1], strict=True)], axis=1)
    other = log_densities(joined.rays, [swapped], sensor, 0.5, columns=joined.columns)
    assert (other != found).any()


def test_too_few_scans_are_refused(train):
    with pytest.raises(bm.BadInput, match="takes two scans or more"):
        heldout.make_folds(train.select(slice(0, 1)), GRID)
    blind = dataclasses.replace(train, ranges_m=np.full(train.ranges_m.shape, np.nan))
    with pytest.raises(bm.BadInput, match="none of the training scans has a valid reading"):
        heldout.make_folds(blind, GRID)
    with pytest.raises(bm.BadInput, match="to fit a sensor on"):
        heldout.one_fold(blind, GRID)


def test_a_map_of_thinned_scans_at_other_poses_is_known_as_such(stamped):
    run = dataclasses.replace(
        stamped, poses=stamped.poses + 1.0, ranges_m=stamped.ranges_m[:, ::2], angles_rad=stamped.angles_rad[::2]
    )
    with pytest.raises(heldout.NoneHeldOut, match="elsewhere"):
        heldout.unseen_scans(run.select(slice(2, 8)), stamped, 4, "log")
    other = dataclasses.replace(stamped, stamps_s=stamped.stamps_s + 0.5)
    with pytest.raises(BadInput, match="none of the run's scans"):
        heldout.unseen_scans(run, other, 4, "log")
