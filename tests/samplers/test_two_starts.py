"""Of a second start chains take the squares that explain their readings better, where these fit."""

import numpy as np
import pytest

from bayesmap.samplers import start_search
from bayesmap.samplers.start_search import (
    BETTER_NATS,
    HALF_WIDTHS,
    MARGIN,
    ChainMaps,
    cells_of,
    squares,
    take_better_squares,
)

SHAPE = (40, 30)
GOOD = np.zeros(SHAPE)
GOOD[5:8, 5:8] = GOOD[20:27, 10:16] = GOOD[0:2, 28:30] = 1.0
"""Three places of which the second start knows, and the first does not."""


def maps_of(m):
    cells = np.zeros((1, m.size, 6), dtype=np.float32)
    cells[0, :, 0] = m.ravel()
    return ChainMaps(cells, np.zeros((1, m.size), dtype=bool))


def look(maps):
    """Each cell whose m is that of the good places is worth ten nats."""
    return 10.0 * (maps.cells[..., 0].reshape(-1, *SHAPE) == GOOD)


def test_chains_take_what_is_better_and_keep_what_is_not():
    worse = GOOD.copy()
    worse[30:35, 20:25] = 0.5  # of these places the first start knows more
    first, second = maps_of(np.zeros(SHAPE)), maps_of(worse)
    gain = look(second) - look(first)
    take_better_squares(first, second, gain, look)
    np.testing.assert_array_equal(first.cells[0, :, 0].reshape(SHAPE), GOOD)


def test_a_square_that_does_not_fit_among_the_chain_s_own_is_taken_back():
    def seams(maps):
        """A cell of the second start's next to one of the first costs more than it is worth."""
        m = maps.cells[..., 0].reshape(-1, *SHAPE)
        return look(maps) - 1000.0 * ((m[:, :, :] == 1) & (np.roll(m, 1, axis=1) == 0))

    first, second = maps_of(np.zeros(SHAPE)), maps_of(GOOD)
    take_better_squares(first, second, look(second) - look(first), seams)
    assert not first.cells.any()


def test_labels_come_with_their_cells():
    first, second = maps_of(np.zeros(SHAPE)), maps_of(GOOD)
    second.solid[0] = GOOD.ravel() > 0
    take_better_squares(first, second, look(second) - look(first), look)
    np.testing.assert_array_equal(first.solid, second.solid)


def test_too_little_is_not_looked_for():
    gain = np.zeros(SHAPE)
    gain[10, 10], gain[25, 25] = BETTER_NATS + 0.1, BETTER_NATS - 0.1
    tried = np.zeros(SHAPE, dtype=bool)
    found = squares(0, maps_of(GOOD), gain, 1, tried)
    assert len(found.middle) == 1
    assert abs(found.middle[0] - 10).max() <= 1
    tried[9:12, 9:12] = True
    assert len(squares(0, maps_of(GOOD), gain, 1, tried).middle) == 0


def test_squares_side_by_side_are_tried_one_after_the_other(monkeypatch):
    monkeypatch.setattr(start_search, "HALF_WIDTHS", (1,))
    row = np.zeros(SHAPE)
    row[3:6, 3:27:6] = 1.0  # further apart than small squares are wide, and closer than beams are asked

    def look(maps):
        return 10.0 * (maps.cells[..., 0].reshape(-1, *SHAPE) == row)

    first, second = maps_of(np.zeros(SHAPE)), maps_of(row)
    take_better_squares(first, second, look(second) - look(first), look)
    np.testing.assert_array_equal(first.cells[0, :, 0].reshape(SHAPE), row)


@pytest.mark.parametrize("half", HALF_WIDTHS)
def test_no_beam_is_asked_about_two_squares(half):
    gain = np.random.default_rng(half).uniform(0, 2 * BETTER_NATS, SHAPE)
    found = squares(0, maps_of(GOOD), gain, half, np.zeros(SHAPE, dtype=bool)).middle
    assert len(found) > 1
    asked = np.zeros(SHAPE, dtype=int)
    for x, y in found:
        asked[max(0, x - half - MARGIN) : x + half + MARGIN + 1, max(0, y - half - MARGIN) : y + half + MARGIN + 1] += 1
    assert asked.max() == 1


@pytest.mark.parametrize("half", [1, 2])
def test_the_cells_of_squares_are_those_around_their_middles(half):
    middle = np.array([[10, 10], [0, 29]])
    found = cells_of(middle, half, SHAPE)
    inner, corner = (np.unique(row) for row in found)
    assert len(inner) == (2 * half + 1) ** 2
    assert len(corner) == (half + 1) ** 2
    for row, place in zip((inner, corner), middle, strict=True):
        assert abs(np.stack(np.divmod(row, SHAPE[1]), axis=-1) - place).max() <= half
