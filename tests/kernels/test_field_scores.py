"""Sums of a likelihood field where points fall, against the plain formula."""

import numpy as np

import bayesmap as bm
from bayesmap.kernels.match.fields import field_sums

GRID = bm.Grid((30, 20), 0.1, (-1.0, 0.5))


def test_sums_are_those_of_the_plain_formula():
    rng = np.random.default_rng(0)
    field = rng.integers(0, 256, GRID.shape).astype(np.uint8)
    points, poses = rng.uniform(-2, 2, (40, 2)), rng.uniform([-1, 0.5, -4], [2, 2.5, 4], (50, 3))
    cos, sin = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
    x = cos * points[:, 0] - sin * points[:, 1] + poses[:, :1]
    y = sin * points[:, 0] + cos * points[:, 1] + poses[:, 1:2]
    cells = GRID.to_cells(np.stack([x, y], axis=-1))
    assert np.abs(cells - np.round(cells)).min() > 1e-5  # none lies so near a line that single precision decides
    i, j = np.moveaxis(np.floor(cells).astype(int), -1, 0)
    inside = (i >= 0) & (j >= 0) & (i < 30) & (j < 20)
    expected = np.where(inside, field[np.clip(i, 0, 29), np.clip(j, 0, 19)], 0).sum(axis=1)
    assert inside.any()
    assert not inside.all()
    np.testing.assert_array_equal(field_sums(field, GRID, points, poses), expected)
