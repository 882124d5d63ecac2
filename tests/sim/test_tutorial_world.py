import numpy as np

from bayesmap import worlds
from bayesmap.sim.drawing import DRAWING, TUTORIAL_GRID


def test_walls_are_indexed_as_the_tutorial_indexes_them():
    walls, _ = worlds.tutorial()
    expected = np.zeros((21, 21), dtype=bool)
    for i, line in enumerate(DRAWING.strip().split("\n")):  # the tutorial's own reading
        for j, character in enumerate(line):
            expected[i, j] = character == "X"
    assert walls.dtype == bool
    np.testing.assert_array_equal(walls, expected)
    assert walls.sum() == 54
    assert walls[2, 14]  # in the drawing: third line, fifteenth column
    assert not walls[14, 2]


def test_the_robot_stands_in_the_middle_in_the_open():
    walls, pose = worlds.tutorial()
    assert pose.dtype == np.float64
    assert pose.tolist() == [10.0, 10.0, 0.0]
    assert not walls[TUTORIAL_GRID.cell_at(10.0, 10.0)]


def test_cells_are_centred_on_their_indices():
    x, y = TUTORIAL_GRID.centers_m()
    np.testing.assert_array_equal(x, np.arange(21))
    np.testing.assert_array_equal(y, np.arange(21))


def test_each_call_gives_its_own_arrays():
    worlds.tutorial()[0][:] = True
    assert not worlds.tutorial()[0].all()
