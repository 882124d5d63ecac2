"""Public logs from raw odometry, where they are at hand. Thresholds leave room for other machines' rounding."""

import numpy as np
import pytest
from data import intel_log

from bayesmap.io.logs import read_log
from bayesmap.poses.relations import read_relations, relation_errors
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between


def test_intel_is_as_close_to_the_known_relations_as_was_asked():
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
