"""The fast likelihood of scans at poses is that of the plain one, and sums of a field at points are plain sums."""

import numpy as np
import pytest
from oracle.stop_worlds import surfaces_of

import bayesmap as bm
from bayesmap.kernels.match.fields import field_sums
from bayesmap.kernels.predict.density import LEAST_CHANCE, device_maps
from bayesmap.kernels.predict.pose_weights import scan_log_likelihood
from bayesmap.kernels.predict.scan_likelihood import ScanLikelihood
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((60, 50), 0.1, (-1.0, 2.0))
LASER = bm.BeamMixture(bm.Gaussian(0.02, 0.005), p_random=0.01, p_no_return=0.05, p_short=0.05)
TAILS = bm.BeamMixture(bm.StudentT(0.02, 9.0, 0.005), p_random=0.01, p_no_return=0.05, p_short=0.05)
FIELD_GRID = bm.Grid((30, 20), 0.1, (-1.0, 0.5))
ANGLES = np.radians(np.arange(60) * 6.0)


def states(kind, rng):
    stop = np.where(rng.random((3, GRID.n_cells)) < 0.05, rng.uniform(0.2, 1.0, (3, GRID.n_cells)), 4e-3)
    if kind == "plain":
        return stop.astype(np.float32)
    return surfaces_of(rng, GRID, stop)


@pytest.mark.parametrize("laser", [LASER, TAILS], ids=["normal", "heavy tails"])
@pytest.mark.parametrize("kind", ["plain", "surfaces"])
def test_the_fast_law_is_the_plain_one(kind, laser):
    rng = np.random.default_rng(1)
    maps = states(kind, rng)
    poses = np.column_stack([rng.uniform(-1.5, 5.5, 40), rng.uniform(1.5, 7.5, 40), rng.uniform(-4, 4, 40)])
    ranges = rng.uniform(0.0, 6.0, (2, 60))
    ranges[:, ::7], ranges[0, 3], ranges[1, 4] = np.inf, np.nan, -np.inf
    scans = bm.Scans(np.zeros((2, 3)), ANGLES, ranges, 6.0, 0.1)
    which = rng.integers(0, 2, 40)
    fast = scan_log_likelihood(
        device_maps([maps], GRID, 0.5), poses, ANGLES, ranges, laser, RangeLimits(0.1, 6.0), scan=which
    )
    plain = ScanLikelihood(scans, GRID, laser, 0.5)
    for draw in range(3):
        expected = plain(maps, poses, which, np.full(40, draw))
        np.testing.assert_allclose(fast[:, draw], expected, rtol=2e-5, atol=2e-3)


def test_cells_that_hardly_ever_stop_a_beam_cost_all_poses_alike():
    """A beam that reads 4 m has passed some forty of them: what they take off differs little from pose to pose."""
    rng = np.random.default_rng(3)
    maps = states("plain", rng)
    maps[maps < 0.1] = 0.9 * LEAST_CHANCE
    poses = np.column_stack([rng.uniform(1, 3, 40), rng.uniform(4, 5, 40), rng.uniform(-4, 4, 40)])
    ranges = rng.uniform(0.0, 6.0, (1, 60))
    fast = scan_log_likelihood(device_maps([maps], GRID, 0.5), poses, ANGLES, ranges, LASER, RangeLimits(0.1, 6.0))
    plain = ScanLikelihood(bm.Scans(np.zeros((1, 3)), ANGLES, ranges, 6.0, 0.1), GRID, LASER, 0.5)
    for draw in range(3):
        less = fast[:, draw] - plain(maps, poses, np.zeros(40, int), np.full(40, draw))
        assert less.min() > 0.0
        assert less.max() < 0.06 * len(ANGLES)
        assert less.std() < 0.01 * len(ANGLES)


def test_poses_are_weighed_under_first_draws_or_one_in_turn_and_sums_of_a_field_are_the_plain_formula_s():
    rng = np.random.default_rng(4)
    packed = device_maps([states("surfaces", rng)], GRID, 0.5)
    poses = np.column_stack([rng.uniform(0, 4, 7), rng.uniform(3, 6, 7), rng.uniform(-4, 4, 7)])
    given = (packed, poses, ANGLES, rng.uniform(0, 6, 60), LASER, RangeLimits(0.0, 6.0))
    every = scan_log_likelihood(*given)
    np.testing.assert_array_equal(scan_log_likelihood(*given, draws=2), every[:, :2])
    turns = scan_log_likelihood(*given, in_turn=True)
    np.testing.assert_array_equal(turns[:, 0], every[np.arange(7), np.arange(7) % 3])
    rng = np.random.default_rng(0)
    field = rng.integers(0, 256, FIELD_GRID.shape).astype(np.uint8)
    points, poses = rng.uniform(-2, 2, (40, 2)), rng.uniform([-1, 0.5, -4], [2, 2.5, 4], (50, 3))
    cos, sin = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
    x = cos * points[:, 0] - sin * points[:, 1] + poses[:, :1]
    y = sin * points[:, 0] + cos * points[:, 1] + poses[:, 1:2]
    cells = FIELD_GRID.to_cells(np.stack([x, y], axis=-1))
    assert np.abs(cells - np.round(cells)).min() > 1e-5  # none lies so near a line that single precision decides
    i, j = np.moveaxis(np.floor(cells).astype(int), -1, 0)
    inside = (i >= 0) & (j >= 0) & (i < 30) & (j < 20)
    expected = np.where(inside, field[np.clip(i, 0, 29), np.clip(j, 0, 19)], 0).sum(axis=1)
    assert inside.any()
    assert not inside.all()
    np.testing.assert_array_equal(field_sums(field, FIELD_GRID, points, poses), expected)
