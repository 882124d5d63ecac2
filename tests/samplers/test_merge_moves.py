"""A surface that stops few beams gives way to a neighbour's that reaches its readings, where that explains them."""

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.samplers.start_search import (
    FREE,
    MERGED_NATS,
    MOST_READINGS,
    ChainMaps,
    axes_of,
    best_neighbours,
    lengthened,
    merge_moves,
    merge_surfaces,
    readings_of,
    variance_in,
)

GRID = bm.Grid((12, 9), resolution=0.1)
NOISE_M = 0.01


def flat(x, y):
    return x * GRID.shape[1] + y


def surface(x, y, angle=0.0, along=0.03, across=0.004, m=0.9):
    """A cell's state: a surface about the middle of the cell (x, y), along an angle."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    factor = np.linalg.cholesky(turn @ np.diag([along**2, across**2]) @ turn.T)
    return [m, (x + 0.5) * 0.1, (y + 0.5) * 0.1, factor[0, 0], factor[1, 0], factor[1, 1]]


def wall(beams=((3, 3), (4, 10), (5, 8))):
    """Cells in a row along x, at y = 5, each with so many readings on the same line: cells, owners and end points."""
    rng = np.random.default_rng(0)
    cells = np.zeros((GRID.n_cells, 6), dtype=np.float32)
    cells[:, 1:3] = GRID.cell_centres_m(np.arange(GRID.n_cells))
    cells[:, 3] = cells[:, 5] = 0.02
    owner, points = [], []
    for x, count in beams:
        cells[flat(x, 5)] = surface(x, 5)
        owner += [flat(x, 5)] * count
        points.append(np.column_stack([rng.uniform(0.1 * x, 0.1 * x + 0.1, count), rng.normal(0.55, 0.003, count)]))
    return cells, np.array([*owner, -1], dtype=np.int32), np.vstack([*points, [[np.inf, 0.0]]])


def noise_of(owner):
    return np.full(len(owner), NOISE_M**2)


def test_moments_are_those_of_the_readings_that_a_surface_stopped():
    cells, owner, points = wall()
    points[0] = [1.0, 0.85]  # far from the surface that stopped it: a passing object, or chance
    found = readings_of(cells, owner, points, noise_of(owner), GRID)
    for x, which in ((3, slice(1, 3)), (4, slice(3, 13)), (5, slice(13, 21))):
        mine, at = points[which], flat(x, 5)
        assert found.count[at] == len(mine)
        np.testing.assert_allclose(found.mean_m[at], mine.mean(axis=0))
        covariance = np.cov(mine.T, bias=True)
        np.testing.assert_allclose(found.moments[at], covariance[[0, 0, 1], [0, 1, 1]], atol=1e-12)
        assert found.noise[at] == pytest.approx(NOISE_M**2)
        for angle in (0.0, 0.7):
            u = np.array([np.cos(angle), np.sin(angle)])
            assert variance_in(found.moments[[at]], u[None])[0] == pytest.approx(u @ covariance @ u)
    assert found.count.sum() == 20


def test_the_readings_of_the_fewer_go_to_the_neighbour_whose_axis_they_lie_on():
    cells, owner, points = wall()
    cells[flat(4, 6)] = surface(4, 6, angle=np.pi / 2)  # next to them, too, but they lie beside its axis
    owner = np.append(owner, [flat(4, 6)] * 11).astype(np.int32)
    points = np.vstack([points, np.column_stack([np.full(11, 0.45), np.linspace(0.6, 0.7, 11)])])
    found = readings_of(cells, owner, points, noise_of(owner), GRID)
    few, by, off = best_neighbours(cells, found, axes_of(cells), GRID)
    assert dict(zip(few.tolist(), by.tolist(), strict=True))[flat(3, 5)] in (flat(4, 5), flat(5, 5))
    assert dict(zip(few.tolist(), by.tolist(), strict=True))[flat(5, 5)] == flat(4, 5)
    assert flat(4, 6) not in by
    assert (off < 1.0).all()


def test_of_a_pair_only_one_gives_way_and_none_that_stops_many():
    cells, owner, points = wall(((3, 5), (4, 5), (7, MOST_READINGS + 1), (8, MOST_READINGS + 2)))
    found = readings_of(cells, owner, points, noise_of(owner), GRID)
    few, by, _ = best_neighbours(cells, found, axes_of(cells), GRID)
    np.testing.assert_array_equal(np.stack([few, by], -1), [[flat(3, 5), flat(4, 5)]])


def test_readings_beside_a_surface_stay_where_they_are():
    cells, owner, points = wall(((3, 3), (4, 10)))
    cells[flat(4, 5)] = surface(4, 5, angle=1.0)
    found = readings_of(cells, owner, points, noise_of(owner), GRID)
    assert len(best_neighbours(cells, found, axes_of(cells), GRID)[0]) == 0


@pytest.mark.parametrize("angle", [0.0, 0.05, np.pi, -0.05])
def test_a_lengthened_surface_keeps_its_line_and_its_square_and_reaches_the_readings(angle):
    cells, owner, points = wall()
    cells[flat(4, 5)] = surface(4, 5, angle)
    found, axes = readings_of(cells, owner, points, noise_of(owner), GRID), axes_of(cells)
    few, by = np.array([flat(3, 5)]), np.array([flat(4, 5)])
    x, y, l11, l21, l22 = lengthened(cells, found, axes, few, by, GRID)[0]
    assert abs(np.array([x - 0.45, y - 0.55])).max() <= 0.05
    off = -np.sin(angle) * (x - 0.45) + np.cos(angle) * (y - 0.55)
    assert off == pytest.approx(0, abs=1e-7)
    covariance = np.array([[l11, 0], [l21, l22]]) @ np.array([[l11, l21], [0, l22]])
    across, along = np.linalg.eigvalsh(covariance)
    assert across == pytest.approx(0.004**2, rel=1e-3)
    both = points[:13]
    scatter = (((both - [x, y]) @ [np.cos(angle), np.sin(angle)]) ** 2).mean()
    assert along == pytest.approx(max(0.03**2, 1.5**2 * scatter), rel=1e-3)
    assert along > 0.03**2


def test_the_one_becomes_free_and_the_other_longer():
    cells, owner, points = wall()
    solid = np.zeros(GRID.n_cells, dtype=bool)
    new = merge_moves(cells, solid, owner, points, noise_of(owner), GRID)
    assert new.where.shape == (len(new.middle), 2)
    np.testing.assert_array_equal(new.middle, np.stack(np.divmod(new.where[:, 0], GRID.shape[1]), -1))
    np.testing.assert_array_equal(new.cells[:, 0, 0], np.float32(FREE))
    np.testing.assert_array_equal(new.cells[:, 0, 1:], cells[new.where[:, 0], 1:])
    np.testing.assert_array_equal(new.cells[:, 1, 0], cells[new.where[:, 1], 0])


@pytest.mark.parametrize(("worth", "pays"), [(2 * MERGED_NATS, True), (MERGED_NATS / 2, False), (-MERGED_NATS, False)])
def test_what_does_not_pay_is_taken_back(worth, pays):
    cells, owner, points = wall()
    maps = ChainMaps(cells[None].copy(), np.zeros((1, GRID.n_cells), dtype=bool))

    def look(maps):
        """To be rid of a cell that stops beams is worth so many nats."""
        stops = (maps.cells[..., 0] > 0.1).reshape(-1, *GRID.shape)
        return -worth * stops

    gone = merge_surfaces(maps, points, noise_of(owner), [owner], GRID, look, look(maps))
    left = np.flatnonzero(maps.cells[0, :, 0] > 0.1)
    if pays:
        assert gone == [3 - len(left)]
        assert len(left) < 3
        assert flat(4, 5) in left
    else:
        assert gone == [0]
        np.testing.assert_array_equal(maps.cells[0], cells)


def test_a_surface_that_took_one_in_takes_no_other_from_what_it_was_before():
    """Of two short ones, far apart on the same wall, each would be taken in by the long one between them."""
    cells, owner, points = wall(((3, 3), (5, 40), (7, 3)))
    maps = ChainMaps(cells[None].copy(), np.zeros((1, GRID.n_cells), dtype=bool))
    alone = {}
    for x, other in ((3, 7), (7, 3)):
        one = cells.copy()
        one[flat(other, 5), 0] = FREE
        alone[x] = lengthened_by(one, owner, points, x)

    def look(maps):
        """Readings are explained better without a short one, by the long one next to it."""
        stops = (maps.cells[..., 0] > 0.1).reshape(-1, *GRID.shape)
        return -10.0 * stops

    gone = merge_surfaces(maps, points, noise_of(owner), [owner], GRID, look, look(maps))
    assert gone == [1]
    left = [x for x in (3, 7) if maps.cells[0, flat(x, 5), 0] > 0.1]
    assert len(left) == 1
    taken_in = 10 - left[0]
    np.testing.assert_array_equal(maps.cells[0, flat(5, 5)], alone[taken_in])


def lengthened_by(cells, owner, points, x):
    """What the surface in the middle becomes when it takes in that of column x."""
    new = merge_moves(cells, np.zeros(GRID.n_cells, dtype=bool), owner, points, noise_of(owner), GRID)
    (at,) = np.flatnonzero(new.where[:, 0] == flat(x, 5))
    assert new.where[at, 1] == flat(5, 5)
    return new.cells[at, 1]
