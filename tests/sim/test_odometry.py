"""Simulated odometry, and pairs of poses whose relation is written as truth."""

import numpy as np
import pytest
from tiers import full_but

from bayesmap.errors import BadInput
from bayesmap.sim.robot import NEAR_M, OdometryNoise, related_pairs, simulate_odometry, travel_times_s
from bayesmap.space.planar import between, wrapped

PERFECT = dict.fromkeys(OdometryNoise.__dataclass_fields__, 0.0)


def odometry(**numbers):
    return OdometryNoise(**{**PERFECT, **numbers})


def straight(metres, steps):
    return np.column_stack([np.linspace(0, metres, steps + 1), np.zeros((steps + 1, 2))])


def circle(turns, steps):
    angle = np.linspace(0, 2 * np.pi * turns, steps + 1)
    return np.column_stack([np.sin(angle), 1 - np.cos(angle), wrapped(angle)])


def ends(path, noise, runs):
    return np.array([between(path[0], simulate_odometry(path, noise, seed=seed)[-1]) for seed in range(runs)])


@pytest.mark.parametrize("path", [straight(5.0, 10), circle(1.3, 40), circle(1.0, 9)[::-1]])
def test_without_errors_odometry_is_the_truth(path):
    np.testing.assert_allclose(between(path, simulate_odometry(path, odometry())), 0.0, atol=1e-9)


def test_a_robot_that_reverses_is_reported_to_reverse():
    path = straight(3.0, 6)[::-1]
    reported = simulate_odometry(path, odometry(distance_scale=0.1))
    np.testing.assert_allclose(reported[-1], [-0.3, 0.0, 0.0], atol=1e-9)


@pytest.mark.parametrize("steps", full_but([4, 64], 4))
def test_noise_has_the_stated_size_whatever_the_steps(steps):
    """Standard deviations of 2000 runs lie within 8 % (4.5 standard errors: chance fails one run in 10^5)."""
    metres = 9.0
    along = ends(straight(metres, steps), odometry(distance_per_m=0.02), 2000)
    assert np.std(along[:, 0]) == pytest.approx(0.02 * np.sqrt(metres), rel=0.08)
    yaw = ends(straight(metres, steps), odometry(turn_per_m=0.01), 2000)[:, 2]
    assert np.std(yaw) == pytest.approx(0.01 * np.sqrt(metres), rel=0.08)
    turns = 0.5
    spot = np.column_stack([np.zeros((steps + 1, 2)), wrapped(np.linspace(0, 2 * np.pi * turns, steps + 1))])
    yaw = wrapped(ends(spot, odometry(turn_per_rad=0.02), 2000)[:, 2] - np.pi)
    assert np.std(yaw) == pytest.approx(0.02 * np.sqrt(2 * np.pi * turns), rel=0.08)


def test_bias_adds_up_along_the_way():
    end = simulate_odometry(straight(10.0, 50), odometry(distance_scale=0.05))[-1]
    np.testing.assert_allclose(end, [10.5, 0, 0], atol=1e-9)
    assert simulate_odometry(straight(10.0, 50), odometry(drift_rad_per_m=0.02))[-1, 2] == pytest.approx(0.2)
    half = circle(0.5, 50)
    assert wrapped(simulate_odometry(half, odometry(turn_scale=0.1))[-1, 2] - 1.1 * np.pi) == pytest.approx(0, abs=1e-9)


def test_slips_come_as_often_as_said_and_only_lengthen_the_way():
    path = straight(1000.0, 1000)
    reported = simulate_odometry(path, odometry(slips_per_m=0.1, slip_m=0.05))
    extra = np.diff(reported[:, 0]) - 1.0
    assert (extra > -1e-9).all()
    # Binomial with mean 95 and standard deviation 9.3; the mean of as many exponentials has 10 % of error.
    assert 55 < (extra > 1e-6).sum() < 135
    assert extra.sum() / (extra > 1e-6).sum() == pytest.approx(0.05, rel=0.45)
    assert np.abs(simulate_odometry(path, odometry(slips_per_m=0.1, slip_rad=0.2))[:, 2]).max() > 0.2


def test_odometry_that_lags_reports_where_the_robot_was():
    path = straight(4.0, 40)
    stamps = travel_times_s(path, 0.5, 1.0)
    late = simulate_odometry(path, odometry(lag_s=0.4), stamps_s=stamps)
    np.testing.assert_allclose(late[10:, 0], path[10:, 0] - 0.4 * 0.5, atol=1e-9)
    np.testing.assert_allclose(late[0], path[0])
    with pytest.raises(BadInput, match="a lag needs stamps_s"):
        simulate_odometry(path, odometry(lag_s=0.4))
    with pytest.raises(BadInput, match="must ascend"):
        simulate_odometry(path, odometry(lag_s=0.4), stamps_s=stamps[::-1])


def test_the_noise_of_the_beginning_does_not_depend_on_the_end():
    path = circle(2.0, 50)
    np.testing.assert_array_equal(simulate_odometry(path[:20], seed=3), simulate_odometry(path, seed=3)[:20])
    assert not np.array_equal(simulate_odometry(path, seed=3), simulate_odometry(path, seed=4))


def test_stamps_follow_from_the_slower_of_way_and_turn():
    path = np.array([[0, 0, 0], [1.0, 0, 0], [1.0, 0, np.pi / 2], [1.0, 0, np.pi / 2]])
    np.testing.assert_allclose(np.diff(travel_times_s(path, 0.5, np.pi)), [2.0, 0.5, 0.001])


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"turn_per_m": -0.1}, "turn_per_m must be a finite number of 0 or more"),
        ({"lag_s": np.nan}, "lag_s must be a finite number, got nan"),
    ],
)
def test_numbers_that_make_no_sense(numbers, message):
    with pytest.raises(BadInput, match=message):
        OdometryNoise(**numbers)


def test_pairs_are_near_different_and_from_near_and_far_in_time():
    angle = np.linspace(0, 6 * np.pi, 300)  # three rounds of a circle
    path = np.column_stack([5 * np.cos(angle), 5 * np.sin(angle), angle])
    start, end = related_pairs(path, seed=1)
    assert (end > start).all()
    assert len(np.unique(np.stack([start, end]), axis=1).T) == len(start)
    assert np.hypot(*(path[start, :2] - path[end, :2]).T).max() <= NEAR_M
    assert set(zip(range(299), range(1, 300), strict=True)) <= set(zip(start.tolist(), end.tolist(), strict=True))
    assert (end - start > 80).sum() > 20  # a round later
    assert len(related_pairs(path[:1])[0]) == 0
