"""A log of the battery that went wrong once: fewer beams in the first alignments put it 20 m off without a word."""

from dataclasses import replace

import numpy as np
import pytest

from bayesmap.poses.slam import infer_trajectory
from benchmarks.pose_battery import case, judge


@pytest.mark.full
def test_a_weak_laser_on_a_campus_is_not_wrong_without_a_word():
    log = case(52)
    trajectory = infer_trajectory(log.scans)
    outcome = judge(trajectory, log.truth)
    assert outcome.median_m < 0.1
    assert outcome.worst_m < 5.0
    assert outcome.unannounced == 0
    # The judge sees what nobody announced: half of the way 5 m to the side.
    moved = trajectory.poses + np.outer(np.arange(len(log.truth)) > len(log.truth) // 2, [0.0, 5.0, 0.0])
    assert judge(replace(trajectory, poses=moved), log.truth).unannounced > 100
