import numpy as np
import pytest

from bayesmap.space.grid import Grid
from bayesmap.viz.cells import boundary_segments, boxes


def test_one_cell_has_four_edges_in_metres():
    grid = Grid(shape=(3, 3), resolution=0.5, origin=(10.0, -1.0))
    mask = np.zeros((3, 3), dtype=bool)
    mask[2, 0] = True
    found = {tuple(sorted(map(tuple, s))) for s in boundary_segments(grid, mask).tolist()}
    assert found == {
        ((11.0, -1.0), (11.0, -0.5)),
        ((11.5, -1.0), (11.5, -0.5)),
        ((11.0, -1.0), (11.5, -1.0)),
        ((11.0, -0.5), (11.5, -0.5)),
    }


@pytest.mark.parametrize("seed", range(5))
def test_segments_are_the_edges_between_unlike_cells(seed):
    mask = np.random.default_rng(seed).random((7, 5)) < 0.5
    expected = set()
    for i in range(-1, 8):
        for j in range(-1, 6):
            here = 0 <= i < 7 and 0 <= j < 5 and bool(mask[i, j])
            right = 0 <= i + 1 < 7 and 0 <= j < 5 and bool(mask[i + 1, j])
            above = 0 <= i < 7 and 0 <= j + 1 < 5 and bool(mask[i, j + 1])
            if here != right:
                expected.add(("|", i + 1, j))
            if here != above:
                expected.add(("-", i, j + 1))
    found = []
    for (x0, y0), (x1, y1) in boundary_segments(Grid(shape=(7, 5)), mask).astype(int).tolist():
        found += [("|", x0, y) for y in range(y0, y1)] if x0 == x1 else [("-", x, y0) for x in range(x0, x1)]
    assert len(found) == len(set(found))
    assert set(found) == expected


def test_straight_walls_are_one_segment_a_side():
    mask = np.zeros((50, 50), dtype=bool)
    mask[10, 5:45] = True
    assert len(boundary_segments(Grid(shape=(50, 50)), mask)) == 4


def test_boxes_cover_the_mask_and_no_more():
    mask = np.random.default_rng(1).random((20, 30)) < 0.4
    covered = np.zeros(mask.shape, dtype=int)
    for box in boxes(Grid(shape=mask.shape), mask).astype(int):
        (x0, y0), (x1, y1) = box[0], box[2]
        covered[x0:x1, y0:y1] += 1
    np.testing.assert_array_equal(covered, mask)


def test_nothing_to_outline():
    assert boundary_segments(Grid(shape=(3, 3)), np.zeros((3, 3), dtype=bool)).shape == (0, 2, 2)
