"""`bm.ranges` and `bm.simulate`: the forward model in metres, from poses in the world."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle.formula import beams, distances

import bayesmap as bm

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


def test_simulate_repeats_itself_by_its_seed_alone():
    walls, pose = bm.worlds.tutorial()
    options = {"sensor": bm.BeamMixture(), "max_range_m": 20.0}
    first, again, other = (
        bm.simulate(walls, bm.worlds.TUTORIAL_GRID, pose, ANGLES, seed=seed, **options).ranges_m for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()


def test_glass_lets_through_as_many_beams_as_its_opacity_says():
    """A pane of opacity 0.3 before a wall: binomial, 2000 scans, within 5 standard errors."""
    walls = np.zeros((6, 1), dtype=bool)
    walls[3] = walls[5] = True
    opacity = np.ones((6, 1))
    opacity[3] = 0.3
    poses = np.tile([0.5, 0.5, 0.0], (2000, 1))
    scans = bm.simulate(
        walls, bm.Grid((6, 1)), poses, [0.0], sensor=bm.Gaussian(1e-3), max_range_m=9.0, opacity=opacity, seed=3
    )
    stopped = (scans.ranges_m < 3.5).mean()
    assert abs(stopped - 0.3) < 5 * np.sqrt(0.3 * 0.7 / 2000)


def test_a_pose_inside_a_wall_cannot_be_simulated():
    walls = np.ones((2, 2), dtype=bool)
    with pytest.raises(bm.BadInput, match=r"pose 1 at \(1\.5, 0\.5\) m stands in the occupied cell \(1, 0\)"):
        bm.simulate(walls, bm.Grid((2, 2)), [[5, 5, 0], [1.5, 0.5, 0]], [0.0], sensor=bm.Gaussian(0.1), max_range_m=5.0)
