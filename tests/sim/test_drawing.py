"""Walls as text and as pictures."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from PIL import Image

from bayesmap.errors import BadInput
from bayesmap.sim.drawing import DRAWING, TUTORIAL_GRID, from_text, to_text, tutorial
from bayesmap.worlds import from_image, from_map_image, from_occupancy

maps = hnp.arrays(bool, hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=12))


@given(maps, st.integers(0, 4), st.integers(0, 3), st.sampled_from(["\n", "\r\n"]))
def test_drawings_are_read_back_whatever_their_blanks_and_line_ends(walls, indent, blank, newline):
    np.testing.assert_array_equal(from_text(to_text(walls)), walls)
    lines = [" " * indent + line + "  " for line in to_text(walls).splitlines()]
    framed = newline.join([""] * blank + lines + [" "] * blank)
    np.testing.assert_array_equal(from_text(framed), walls)


@pytest.mark.parametrize(("text", "place"), [
    ("...\n..\n", "line 2 has 2 cells, but line 1 has 3"), ("...\n\n...\n", "line 2 has 0 cells"),
    ("..\n.o\n", "line 2, column 2: unknown character 'o'"), (" \n\n", "no lines"),
    ("\n\n  .X\n  ?.", "line 4, column 3: unknown character '?'"), ("", "no lines"),
])  # fmt: skip
def test_a_bad_drawing_is_refused_with_its_place(text, place):
    with pytest.raises(BadInput) as error:
        from_text(text)
    assert place in str(error.value)
    with pytest.raises(BadInput, match="shape"):
        to_text(np.zeros((2, 2, 2)))


def test_the_tutorial_s_walls_are_indexed_as_it_indexes_them():
    assert np.argwhere(from_text("..X\n#..\n")).tolist() == [[0, 2], [1, 0]]
    walls, pose = tutorial()
    lines = DRAWING.strip().split("\n")
    assert walls.tolist() == [[character == "X" for character in line] for line in lines]  # the tutorial's own reading
    assert walls[2, 14]  # in the drawing: third line, fifteenth column
    assert not walls[14, 2]
    assert (pose.tolist(), TUTORIAL_GRID.cell_at(10.2, 9.8)) == ([10.0, 10.0, 0.0], (10, 10))
    walls[:] = True
    assert not tutorial()[0].all()  # each call gives arrays of its own


pictures = hnp.arrays(np.uint8, hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=9))


def test_the_top_left_of_a_picture_is_low_x_high_y_and_row_zero_of_an_occupancy_grid_the_bottom():
    image = np.full((3, 5), 255, dtype=np.uint8)  # 3 rows, 5 columns
    image[0, 0] = 0
    walls = from_image(image)
    assert (walls.shape, np.argwhere(walls).tolist()) == ((5, 3), [[0, 2]])
    for unknown_is_wall in (False, True):
        walls, _ = from_occupancy([[-1, 0, 100, 50, 51]], 0.1, unknown_is_wall=unknown_is_wall)
        np.testing.assert_array_equal(walls[:, 0], [unknown_is_wall, False, True, False, True])
    cells = np.zeros((3, 5), dtype=np.int8)
    cells[0, 4] = 100
    walls, grid = from_occupancy(cells, 0.05, origin=(-1.0, 2.0))
    assert np.argwhere(walls).tolist() == [[4, 0]]
    assert (grid.shape, grid.resolution, grid.origin) == ((5, 3), 0.05, (-1.0, 2.0))


@given(pictures)
def test_files_pil_images_and_arrays_agree(tmp_path_factory, picture):
    path = tmp_path_factory.mktemp("image") / "map.png"
    Image.fromarray(picture).save(path)
    walls = from_image(picture)
    np.testing.assert_array_equal(from_image(path), walls)
    np.testing.assert_array_equal(from_image(str(path)), walls)
    np.testing.assert_array_equal(from_image(Image.fromarray(picture)), walls)
    np.testing.assert_array_equal(from_image(picture / 255.0), walls)
    np.testing.assert_array_equal(from_image(np.dstack([picture] * 3)), walls)


def test_dark_pixels_are_walls_transparent_ones_free_and_map_server_greys_occupied_unknown_free():
    greys = np.array([[0.0, 0.29, 0.31, 1.0]])
    np.testing.assert_array_equal(from_image(greys, threshold=0.3)[:, 0], [True, True, False, False])
    black_but_clear = np.zeros((1, 2, 4), dtype=np.uint8)
    black_but_clear[0, 1, 3] = 255
    np.testing.assert_array_equal(from_image(black_but_clear)[:, 0], [False, True])
    bits = Image.fromarray(np.array([[True, False]]))
    assert bits.mode == "1"
    np.testing.assert_array_equal(from_image(bits)[:, 0], [False, True])
    image = np.array([[0, 130, 205, 254]], dtype=np.uint8)  # darkness 1, .49, .196, .004
    walls, _ = from_map_image(image, 0.1, free_thresh=0.196)
    np.testing.assert_array_equal(walls[:, 0], [True, False, False, False])
    walls, _ = from_map_image(image, 0.1, free_thresh=0.19, unknown_is_wall=True)
    np.testing.assert_array_equal(walls[:, 0], [True, True, True, False])


@given(pictures)
def test_negate_swaps_black_and_white(picture):
    plain, _ = from_map_image(picture, 0.1)
    negated, _ = from_map_image(255 - picture, 0.1, negate=True)
    np.testing.assert_array_equal(plain, negated)


@pytest.mark.parametrize(("cells", "says"), [
    ([[0, 101]], "row 0, column 1 is 101"), ([[0], [-2]], "row 1, column 0 is -2"),
    ([[float("nan")]], "row 0, column 0 is nan"), ([0, 100], "info.height and info.width"),
    ([["wall"]], "array of numbers"),
])  # fmt: skip
def test_a_bad_occupancy_grid_is_refused_with_its_place(cells, says):
    with pytest.raises(BadInput) as error:
        from_occupancy(cells, 0.1)
    assert says in str(error.value)


@pytest.mark.parametrize(
    "image", [np.zeros(4), np.zeros((2, 2, 2)), np.full((2, 2), 1.5), np.full((2, 2), np.nan), np.zeros((0, 3))]
)
def test_an_array_that_is_no_picture_is_refused(image):
    with pytest.raises(BadInput, match="image:"):
        from_image(image)


def test_files_that_are_no_pictures_and_thresholds_out_of_order_are_refused(tmp_path):
    (tmp_path / "map.png").write_text("no picture")
    for name, says in (("map.png", r"map\.png: cannot be read as an image"), ("absent.png", r"absent\.png")):
        with pytest.raises(BadInput, match=says):
            from_image(tmp_path / name)
    with pytest.raises(BadInput, match="free_thresh < occupied_thresh"):
        from_map_image(np.zeros((2, 2)), 0.1, occupied_thresh=0.2, free_thresh=0.3)
    with pytest.raises(BadInput, match="threshold"):
        from_image(np.zeros((2, 2)), threshold=1.0)
