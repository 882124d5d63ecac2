"""Pairs of poses whose relation is written as truth."""

import numpy as np

from bayesmap.sim.relations import NEAR_M, related_pairs


def test_pairs_are_near_different_and_from_near_and_far_in_time():
    angle = np.linspace(0, 6 * np.pi, 300)  # three rounds of a circle
    path = np.column_stack([5 * np.cos(angle), 5 * np.sin(angle), angle])
    start, end = related_pairs(path, seed=1)
    assert (end > start).all()
    assert len(np.unique(np.stack([start, end]), axis=1).T) == len(start)
    assert np.hypot(*(path[start, :2] - path[end, :2]).T).max() <= NEAR_M
    assert set(zip(range(299), range(1, 300), strict=True)) <= set(zip(start.tolist(), end.tolist(), strict=True))
    assert (end - start > 80).sum() > 20  # a round later


def test_a_single_pose_has_no_relation():
    assert len(related_pairs(np.zeros((1, 3)))[0]) == 0
