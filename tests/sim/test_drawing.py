import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from bayesmap.errors import BadInput
from bayesmap.sim.drawing import from_text, to_text

maps = hnp.arrays(bool, hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=12))


def test_lines_are_the_first_index():
    walls = from_text("..X\n...\n")
    assert walls.shape == (2, 3)
    assert np.argwhere(walls).tolist() == [[0, 2]]


@given(maps)
def test_what_is_written_is_read_back(walls):
    np.testing.assert_array_equal(from_text(to_text(walls)), walls)


@given(maps, st.integers(0, 4), st.integers(0, 3), st.sampled_from(["\n", "\r\n"]))
def test_indentation_blank_lines_and_line_ends_do_not_matter(walls, indent, blank, newline):
    lines = [" " * indent + line + "  " for line in to_text(walls).splitlines()]
    framed = newline.join([""] * blank + lines + [" "] * blank)
    np.testing.assert_array_equal(from_text(framed), walls)


def test_hash_is_a_wall_too():
    np.testing.assert_array_equal(from_text("#.X"), [[True, False, True]])


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


def test_only_maps_can_be_drawn():
    with pytest.raises(BadInput, match="shape"):
        to_text(np.zeros((2, 2, 2)))
