"""Only scans that a run has not seen may judge it."""

import dataclasses

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.posterior.heldout import seen_by, unseen_scans


@pytest.fixture
def log():
    rng = np.random.default_rng(1)
    readings = rng.uniform(0.1, 5.0, (20, 8))
    readings[3, 2:4] = [np.inf, np.nan]
    return bm.Scans(rng.uniform(0, 5, (20, 3)), np.linspace(0, 1, 8), readings, max_range_m=6.0)


def test_a_scan_is_known_by_its_pose_and_readings(log):
    seen = seen_by(log.select(slice(2, 5)), log)
    np.testing.assert_array_equal(np.flatnonzero(seen), [2, 3, 4])
    moved = dataclasses.replace(log, poses=log.poses + 1.0)
    assert not seen_by(log, moved).any()
    assert not seen_by(log, dataclasses.replace(log, angles_rad=log.angles_rad + 0.1)).any()


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
