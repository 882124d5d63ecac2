"""Only scans that a run has not seen may judge it."""

import dataclasses

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.posterior.heldout import NoneHeldOut, moved_by, seen_by, unseen_scans


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
    seen = seen_by(log.select(slice(2, 5)), log)
    np.testing.assert_array_equal(np.flatnonzero(seen), [2, 3, 4])
    moved = dataclasses.replace(log, poses=log.poses + 1.0)
    assert not seen_by(log, moved).any()
    assert not seen_by(log, dataclasses.replace(log, angles_rad=log.angles_rad + 0.1)).any()


def test_where_scans_have_stamps_their_poses_may_be_inferred(stamped):
    run = dataclasses.replace(stamped, poses=stamped.poses + 1.0).select(slice(2, 8))
    np.testing.assert_array_equal(np.flatnonzero(seen_by(run, stamped)), np.arange(2, 8))
    assert moved_by(run, stamped)
    assert not moved_by(stamped.select(slice(2, 8)), stamped)
    assert not seen_by(run, dataclasses.replace(stamped, ranges_m=stamped.ranges_m + 0.01)).any()
    assert not seen_by(run, dataclasses.replace(stamped, stamps_s=stamped.stamps_s + 0.5)).any()


def test_a_scan_without_a_hit_is_that_of_a_run_only_where_it_stands(stamped):
    """Two recordings whose clocks both begin at 0 have such scans in common, but not their poses."""
    blind = dataclasses.replace(stamped, ranges_m=np.full(stamped.ranges_m.shape, np.inf))
    assert seen_by(blind, blind).all()
    assert not seen_by(dataclasses.replace(blind, poses=blind.poses + 1.0), blind).any()


def test_scans_that_a_run_has_moved_cannot_judge_it(stamped):
    moved = dataclasses.replace(stamped, poses=stamped.poses + 1.0)
    with pytest.raises(NoneHeldOut, match=r"a.log: the run has its scans elsewhere than this log"):
        unseen_scans(moved.holdout(5)[0], stamped, 5, "a.log")
    with pytest.raises(bm.BadInput, match="the run was made from 20 of its 20 scans"):
        unseen_scans(moved, stamped, 0, "a.log")


def test_the_held_out_scans_are_those_of_the_protocol(log):
    train, held = log.holdout(5)
    found = unseen_scans(train, log, 5, "a.log")
    np.testing.assert_array_equal(found.ranges_m, held.ranges_m)
    thinned = train.select(slice(None, None, 2))
    assert len(unseen_scans(thinned, log, 5, "a.log")) == len(held)


def test_another_recording_is_taken_whole(log):
    other = dataclasses.replace(log, poses=log.poses + 1.0)
    assert unseen_scans(log, other, 0, "b.log") is other


@pytest.mark.parametrize(
    ("train", "every", "message"),
    [
        (lambda log: log, 5, r"a.log: the run was made without holding scans out.*bayesmap infer --holdout 5"),
        (
            lambda log: log.holdout(4)[0],
            5,
            r"has seen \d of the 4 scans that would score it; it was made with --holdout 4",
        ),
        (lambda log: log.select(slice(1, 20)), 5, "the run has seen 4 of the 4 .*; other scans were held out"),
        (lambda log: log.holdout(5)[0], 0, r"the run was made from 16 of its 20 scans; --all is for another recording"),
        (lambda log: dataclasses.replace(log, poses=log.poses + 1), 5, "none of the run's scans is in it.*--all"),
        (lambda log: log.holdout(5)[0], 1, "n >= 2, got 1"),
        (lambda log: log.holdout(5)[0], 100, "20 scans are too few"),
    ],
)
def test_scans_that_were_trained_on_are_refused(log, train, every, message):
    with pytest.raises(bm.BadInput, match=message):
        unseen_scans(train(log), log, every, "a.log")
