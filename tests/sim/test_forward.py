"""The forward model in metres, `bm.ranges` and `bm.simulate`; simulated odometry, and pairs of related poses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle.enumeration import beams, distances
from tiers import full_but

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.sim.robot import NEAR_M, OdometryNoise, related_pairs, simulate_odometry, travel_times_s
from bayesmap.space.planar import between, wrap_angle

ANGLES = np.linspace(0, 2 * np.pi, 36, endpoint=False)


def random_map(seed, shape=(9, 7)):
    return np.random.default_rng(seed).random(shape) < 0.25


def by_the_oracle(walls, grid, poses, angles, max_range_m):
    starts, directions = beams(poses, angles, grid)
    longest, shape = max_range_m / grid.resolution, (len(np.atleast_2d(poses)), len(angles))
    expected, with_slack = (distances(walls, starts, directions, longest=longest, slack=s) for s in (1e-11, 1e-7))
    return (expected * grid.resolution).reshape(shape), (expected == with_slack).reshape(shape)


COORDINATE = st.floats(-50, 50)


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.05, 0.1, 0.5, 1.0, 3.0]), st.tuples(COORDINATE, COORDINATE))
def test_ranges_in_metres_from_several_poses(seed, resolution, origin):
    rng = np.random.default_rng(seed)
    walls, grid = random_map(seed), bm.Grid((9, 7), resolution, origin)
    xy = np.array(grid.origin) + rng.uniform(-0.2, 1.2, (3, 2)) * np.array([9, 7]) * resolution
    poses = np.column_stack([xy, rng.uniform(-7, 7, 3)])
    expected, sure = by_the_oracle(walls, grid, poses, ANGLES, 8 * resolution)
    found = bm.ranges(walls, grid, poses, ANGLES, 8 * resolution)
    assert found.shape == (3, 36)
    assert sure.mean() > 0.95
    np.testing.assert_allclose(found[sure], expected[sure], atol=1e-9 * resolution, rtol=0)
    np.testing.assert_array_equal(bm.ranges(walls, grid, poses[1], ANGLES, 8 * resolution), found[1])


@pytest.mark.parametrize("away", [2.0**10, 2.0**20, -(2.0**24)])
def test_ranges_do_not_depend_on_where_in_the_world_the_grid_lies(away):
    """Shifts by powers of two of a map whose coordinates are multiples of 1/256 are free of rounding."""
    rng = np.random.default_rng(3)
    walls = random_map(3)
    poses = np.column_stack([rng.integers(0, 7 * 64, (4, 2)) / 64, rng.uniform(-3, 3, 4)])
    here = bm.ranges(walls, bm.Grid((9, 7)), poses, ANGLES, 20.0)
    poses[:, :2] += away
    np.testing.assert_array_equal(bm.ranges(walls, bm.Grid((9, 7), origin=(away, away)), poses, ANGLES, 20.0), here)


def test_simulated_scans_are_distances_plus_noise():
    """Mean and spread of 40 000 standardised readings, within 5 standard errors."""
    walls, pose = bm.worlds.tutorial()
    grid, angles = bm.worlds.TUTORIAL_GRID, np.linspace(0, 2 * np.pi, 400, endpoint=False)
    poses = np.tile(pose, (100, 1))
    scans = bm.simulate(walls, grid, poses, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=1)
    standard = (scans.ranges_m - bm.ranges(walls, grid, poses, angles, 42.0)) / 0.2
    assert abs(standard.mean()) < 5 / 200
    assert abs(standard.std() - 1) < 5 / np.sqrt(2 * 40_000)


def test_simulate_repeats_itself_by_its_seed_alone_and_not_from_inside_a_wall():
    walls, pose = bm.worlds.tutorial()
    grid, options = bm.worlds.TUTORIAL_GRID, {"sensor": bm.BeamMixture(), "max_range_m": 20.0}
    first, again, other = (bm.simulate(walls, grid, pose, ANGLES, seed=s, **options).ranges_m for s in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()
    walls = np.ones((2, 2), dtype=bool)
    with pytest.raises(bm.BadInput, match=r"pose 1 at \(1\.5, 0\.5\) m stands in the occupied cell \(1, 0\)"):
        bm.simulate(walls, bm.Grid((2, 2)), [[5, 5, 0], [1.5, 0.5, 0]], [0.0], sensor=bm.Gaussian(0.1), max_range_m=5.0)


def test_glass_lets_through_as_many_beams_as_its_opacity_says():
    """A pane of opacity 0.3 before a wall: binomial, 2000 scans, within 5 standard errors."""
    walls = np.zeros((6, 1), dtype=bool)
    walls[3] = walls[5] = True
    opacity = np.ones((6, 1))
    opacity[3] = 0.3
    poses, options = np.tile([0.5, 0.5, 0.0], (2000, 1)), {"max_range_m": 9.0, "opacity": opacity, "seed": 3}
    scans = bm.simulate(walls, bm.Grid((6, 1)), poses, [0.0], sensor=bm.Gaussian(1e-3), **options)
    stopped = (scans.ranges_m < 3.5).mean()
    assert abs(stopped - 0.3) < 5 * np.sqrt(0.3 * 0.7 / 2000)


PERFECT = dict.fromkeys(OdometryNoise.__dataclass_fields__, 0.0)


def odometry(**numbers):
    return OdometryNoise(**{**PERFECT, **numbers})


def straight(metres, steps):
    return np.column_stack([np.linspace(0, metres, steps + 1), np.zeros((steps + 1, 2))])


def circle(turns, steps):
    angle = np.linspace(0, 2 * np.pi * turns, steps + 1)
    return np.column_stack([np.sin(angle), 1 - np.cos(angle), wrap_angle(angle)])


def ends(path, noise, runs):
    return np.array([between(path[0], simulate_odometry(path, noise, seed=seed)[-1]) for seed in range(runs)])


def test_odometry_is_the_truth_but_for_its_errors_and_bias_adds_up_along_the_way():
    for path in (straight(5.0, 10), circle(1.3, 40), circle(1.0, 9)[::-1]):
        np.testing.assert_allclose(between(path, simulate_odometry(path, odometry())), 0.0, atol=1e-9)
    path = straight(3.0, 6)[::-1]
    reported = simulate_odometry(path, odometry(distance_scale=0.1))
    np.testing.assert_allclose(reported[-1], [-0.3, 0.0, 0.0], atol=1e-9)
    assert simulate_odometry(straight(10.0, 50), odometry(drift_rad_per_m=0.02))[-1, 2] == pytest.approx(0.2)
    turned = simulate_odometry(circle(0.5, 50), odometry(turn_scale=0.1))[-1, 2]
    assert wrap_angle(turned - 1.1 * np.pi) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("steps", full_but([4, 64], 4))
def test_noise_has_the_stated_size_whatever_the_steps(steps):
    """Standard deviations of 2000 runs lie within 8 % (4.5 standard errors: chance fails one run in 10^5)."""
    metres = 9.0
    along = ends(straight(metres, steps), odometry(distance_per_m=0.02), 2000)
    assert np.std(along[:, 0]) == pytest.approx(0.02 * np.sqrt(metres), rel=0.08)
    yaw = ends(straight(metres, steps), odometry(turn_per_m=0.01), 2000)[:, 2]
    assert np.std(yaw) == pytest.approx(0.01 * np.sqrt(metres), rel=0.08)
    turns = 0.5
    spot = np.column_stack([np.zeros((steps + 1, 2)), wrap_angle(np.linspace(0, 2 * np.pi * turns, steps + 1))])
    yaw = wrap_angle(ends(spot, odometry(turn_per_rad=0.02), 2000)[:, 2] - np.pi)
    assert np.std(yaw) == pytest.approx(0.02 * np.sqrt(2 * np.pi * turns), rel=0.08)


def test_slips_come_as_often_as_said_and_only_lengthen_the_way():
    path = straight(1000.0, 1000)
    reported = simulate_odometry(path, odometry(slips_per_m=0.1, slip_m=0.05))
    extra = np.diff(reported[:, 0]) - 1.0
    assert (extra > -1e-9).all()
    # Binomial with mean 95 and standard deviation 9.3; the mean of as many exponentials has 10 % of error.
    assert 55 < (extra > 1e-6).sum() < 135
    assert extra.sum() / (extra > 1e-6).sum() == pytest.approx(0.05, rel=0.45)
    assert np.abs(simulate_odometry(path, odometry(slips_per_m=0.1, slip_rad=0.2))[:, 2]).max() > 0.2


def test_odometry_lags_its_beginning_does_not_depend_on_its_end_and_stamps_follow_way_and_turn():
    path = straight(4.0, 40)
    stamps = travel_times_s(path, 0.5, 1.0)
    late = simulate_odometry(path, odometry(lag_s=0.4), stamps_s=stamps)
    np.testing.assert_allclose(late[10:, 0], path[10:, 0] - 0.4 * 0.5, atol=1e-9)
    np.testing.assert_allclose(late[0], path[0])
    with pytest.raises(BadInput, match="a lag needs stamps_s"):
        simulate_odometry(path, odometry(lag_s=0.4))
    with pytest.raises(BadInput, match="must ascend"):
        simulate_odometry(path, odometry(lag_s=0.4), stamps_s=stamps[::-1])
    path = circle(2.0, 50)
    np.testing.assert_array_equal(simulate_odometry(path[:20], seed=3), simulate_odometry(path, seed=3)[:20])
    assert not np.array_equal(simulate_odometry(path, seed=3), simulate_odometry(path, seed=4))
    path = np.array([[0, 0, 0], [1.0, 0, 0], [1.0, 0, np.pi / 2], [1.0, 0, np.pi / 2]])
    np.testing.assert_allclose(np.diff(travel_times_s(path, 0.5, np.pi)), [2.0, 0.5, 0.001])


@pytest.mark.parametrize(("numbers", "message"), [
    ({"turn_per_m": -0.1}, "turn_per_m must be a finite number of 0 or more"),
    ({"lag_s": np.nan}, "lag_s must be a finite number, got nan"),
])  # fmt: skip
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
