"""Public logs from raw odometry, where they are at hand. Thresholds leave room for other machines' rounding."""

import numpy as np
import pytest
from data import intel_log

from bayesmap.io.logs import read_log
from bayesmap.io.text.trajectories import read_relations
from bayesmap.poses.slam import infer_trajectory
from bayesmap.posterior.trajectory_scores import relation_errors
from bayesmap.space.planar import between, compose, wrap_angle
from bayesmap.space.scans import Scans


@pytest.mark.full
def test_intel_is_close_to_the_known_relations():
    trajectory = infer_trajectory(read_log(intel_log("intel-odometry.log.gz")))
    truth = read_relations(intel_log("intel.relations.gz"))
    summary = relation_errors(trajectory.stamps_s, trajectory.poses, truth, exact=True).summary()
    assert summary["relations"] == 97
    assert summary["translation_m_mean"] < 0.017
    assert summary["rotation_deg_mean"] < 0.40


@pytest.mark.full
def test_odometry_that_comes_late_does_not_turn_the_rest_of_a_building():
    """1988 scans of CSAIL: a turn that odometry states late was counted twice, and relations were 1.9 m off."""
    trajectory = infer_trajectory(read_log(intel_log("mit-csail.sort.bag")))
    truth = read_relations(intel_log("mit-csail.relations"))
    summary = relation_errors(trajectory.stamps_s, trajectory.poses, truth).summary()
    assert summary["relations"] == 1172
    assert summary["translation_m_mean"] < 0.032
    assert summary["rotation_deg_mean"] < 0.37


def test_a_loop_without_truth_closes():
    """Where the robot ends, it sees walls that it saw from its first place: odometry doubles them by decimetres."""
    scans = read_log(intel_log("loop5-odometry.log.gz"))
    trajectory = infer_trajectory(scans)
    assert len(trajectory.closures) >= 3
    assert (trajectory.closures.weights > 0.5).sum() >= 3
    assert np.hypot(*trajectory.closures.residuals[:, :2].T).max() < 0.2
    assert len(trajectory.leaps) == 0, "two scans of a corridor slide into each other"
    stated = between(scans.poses[0], scans.poses[-1])
    found = between(trajectory.poses[0], trajectory.poses[-1])
    assert np.hypot(*(stated - found)[:2]) > 1.0


def drone_log(name):
    """Frames of a drone with 32 zones around it as scans with raw odometry, and motion capture's poses, (S, 3)."""
    rows = np.genfromtxt(intel_log(name), delimiter=",", comments="#")
    rows = rows[rows[:, 0] == 0]
    zones = np.tile(np.pi * 7 / 64 - np.pi / 32 * np.arange(8), 4)
    angles = np.repeat([0.0, np.pi, np.pi / 2, -np.pi / 2], 8) + zones
    depth = rows[:, 19:51] / 1000.0
    ranges = depth / np.cos(zones) + np.repeat([0.02, 0.02, 0.025, 0.025], 8) * np.cos(zones)
    ranges[(depth <= 0.0) | (ranges > 3.9)] = np.nan
    order = np.argsort(wrap_angle(angles))
    odometry = compose(rows[:, 6:9], rows[:, 3:6])
    w, x, y, z = rows[:, 15:19].T
    truth = np.column_stack([rows[:, 12:14], np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y**2 + z**2))])
    stamps = np.arange(len(rows)) / 15.0 + rows[:, 1]
    scans = Scans(odometry, wrap_angle(angles)[order], ranges[:, order], 4.0, min_range_m=0.02, stamps_s=stamps)
    return scans, truth, np.flatnonzero(rows[:, 2] == 0)


@pytest.mark.full
@pytest.mark.parametrize("name", ["swarm-icp.csv.gz", "swarm-exp1-two-drones.csv.gz"])
def test_places_a_metre_apart_that_look_alike_do_not_bend_the_path(name):
    """Six matches of two places agreed with each other and bent the way by a metre: relations were off by 0.4 m."""
    scans, truth, capture = drone_log(name)
    found = infer_trajectory(scans)
    first, second = np.triu_indices(len(capture), 1)
    a, b = capture[first], capture[second]
    off = between(between(truth[a], truth[b]), between(found.poses[a], found.poses[b]))
    assert np.median(np.hypot(off[:, 0], off[:, 1])) < 0.06
    assert np.hypot(off[:, 0], off[:, 1]).max() < 0.3
