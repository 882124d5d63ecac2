import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from bayesmap.errors import BadInput
from bayesmap.sim.drawing import DRAWING, TUTORIAL_GRID, from_text, to_text, tutorial

maps = hnp.arrays(bool, hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=12))


def test_lines_are_the_first_index():
    walls = from_text("..X\n#..\n")
    assert walls.shape == (2, 3)
    assert np.argwhere(walls).tolist() == [[0, 2], [1, 0]]


@given(maps)
def test_what_is_written_is_read_back(walls):
    np.testing.assert_array_equal(from_text(to_text(walls)), walls)


@given(maps, st.integers(0, 4), st.integers(0, 3), st.sampled_from(["\n", "\r\n"]))
def test_indentation_blank_lines_and_line_ends_do_not_matter(walls, indent, blank, newline):
    lines = [" " * indent + line + "  " for line in to_text(walls).splitlines()]
    framed = newline.join([""] * blank + lines + [" "] * blank)
    np.testing.assert_array_equal(from_text(framed), walls)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("...\n..\n", "line 2 has 2 cells, but line 1 has 3"),
        ("...\n\n...\n", "line 2 has 0 cells"),
        ("..\n.o\n", "line 2, column 2: unknown character 'o'"),
        ("\n\n  .X\n  ?.", "line 4, column 3: unknown character '?'"),
        ("", "no lines"),
        (" \n\n", "no lines"),
    ],
)
def test_a_bad_drawing_is_refused_with_its_place(text, place):
    with pytest.raises(BadInput) as error:
        from_text(text)
    assert place in str(error.value)
    with pytest.raises(BadInput, match="shape"):
        to_text(np.zeros((2, 2, 2)))


def test_the_tutorial_s_walls_are_indexed_as_it_indexes_them():
    walls, pose = tutorial()
    lines = DRAWING.strip().split("\n")
    assert walls.tolist() == [[character == "X" for character in line] for line in lines]  # the tutorial's own reading
    assert walls[2, 14]  # in the drawing: third line, fifteenth column
    assert not walls[14, 2]
    assert pose.tolist() == [10.0, 10.0, 0.0]
    assert TUTORIAL_GRID.cell_at(10.2, 9.8) == (10, 10)
    walls[:] = True
    assert not tutorial()[0].all()  # each call gives arrays of its own
