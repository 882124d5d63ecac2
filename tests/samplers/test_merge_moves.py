"""A surface that stops few beams gives way to a neighbour's that reaches its readings, where that explains them."""

import math

import numpy as np
import pytest
from stop_rooms import GRID as ROOM
from stop_rooms import LABELLED, PRIORS, TRUTH, scans

import bayesmap as bm
from bayesmap.kernels.surfaces.stop_chains import StopChains
from bayesmap.model import Model
from bayesmap.samplers import merge_moves as moves
from bayesmap.samplers import stop_gibbs
from bayesmap.samplers.methods import make_sampler
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import end_cells

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
    cells[:, 1:3] = GRID.centers_from_corner_m(np.arange(GRID.n_cells))
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
    found = moves.explained_readings(cells, owner, points, noise_of(owner), GRID)
    for x, which in ((3, slice(1, 3)), (4, slice(3, 13)), (5, slice(13, 21))):
        mine, at = points[which], flat(x, 5)
        assert found.count[at] == len(mine)
        np.testing.assert_allclose(found.mean_m[at], mine.mean(axis=0))
        covariance = np.cov(mine.T, bias=True)
        np.testing.assert_allclose(found.moments[at], covariance[[0, 0, 1], [0, 1, 1]], atol=1e-12)
        assert found.noise_m2[at] == pytest.approx(NOISE_M**2)
        for angle in (0.0, 0.7):
            u = np.array([np.cos(angle), np.sin(angle)])
            assert moves.variance_along(found.moments[[at]], u[None])[0] == pytest.approx(u @ covariance @ u)
    assert found.count.sum() == 20


def neighbours(cells, owner, points):
    """Pairs of cells, by number: whose readings go to which neighbour; and how many sigmas the readings are off."""
    found = moves.explained_readings(cells, owner, points, noise_of(owner), GRID)
    few, by, off = moves.best_neighbours(cells, found, moves.surface_axes(cells), GRID)
    return dict(zip(few.tolist(), by.tolist(), strict=True)), off


def test_the_readings_of_the_fewer_go_to_the_neighbour_whose_axis_they_lie_on():
    """One cell of a pair gives way; none does that stops many beams, or whose readings lie beside the axis."""
    cells, owner, points = wall()
    cells[flat(4, 6)] = surface(4, 6, angle=np.pi / 2)  # next to them, too, but they lie beside its axis
    owner = np.append(owner, [flat(4, 6)] * 11).astype(np.int32)
    points = np.vstack([points, np.column_stack([np.full(11, 0.45), np.linspace(0.6, 0.7, 11)])])
    pairs, off = neighbours(cells, owner, points)
    assert pairs[flat(3, 5)] in (flat(4, 5), flat(5, 5))
    assert pairs[flat(5, 5)] == flat(4, 5)
    assert flat(4, 6) not in pairs.values()
    assert (off < 1.0).all()
    cells, owner, points = wall(((3, 5), (4, 5), (7, moves.MAX_READINGS + 1), (8, moves.MAX_READINGS + 2)))
    for angle, expected in ((0.0, {flat(3, 5): flat(4, 5)}), (1.0, {})):
        cells[flat(4, 5)] = surface(4, 5, angle)
        assert neighbours(cells, owner, points)[0] == expected


@pytest.mark.parametrize("angle", [0.0, 0.05, np.pi, -0.05])
def test_a_lengthened_surface_keeps_its_line_and_its_square_and_reaches_the_readings(angle):
    cells, owner, points = wall()
    cells[flat(4, 5)] = surface(4, 5, angle)
    found, axes = moves.explained_readings(cells, owner, points, noise_of(owner), GRID), moves.surface_axes(cells)
    few, by = np.array([flat(3, 5)]), np.array([flat(4, 5)])
    x, y, l11, l21, l22 = moves.lengthen(cells, found, axes, few, by, GRID)[0]
    assert abs(np.array([x - 0.45, y - 0.55])).max() <= 0.05
    assert -np.sin(angle) * (x - 0.45) + np.cos(angle) * (y - 0.55) == pytest.approx(0, abs=1e-7)
    across, along = np.linalg.eigvalsh(np.array([[l11, 0], [l21, l22]]) @ np.array([[l11, l21], [0, l22]]))
    assert across == pytest.approx(0.004**2, rel=1e-3)
    scatter = (((points[:13] - [x, y]) @ [np.cos(angle), np.sin(angle)]) ** 2).mean()
    assert along == pytest.approx(max(0.03**2, 1.5**2 * scatter), rel=1e-3)
    assert along > 0.03**2


def merged_by(maps, owner, points, worth):
    """Merge surfaces, if the removal of a cell that stops beams is worth so many nats."""

    def look(maps):
        return -worth * (maps.cells[..., 0] > 0.1).reshape(-1, *GRID.shape)

    return moves.merge_where_better(maps, points, noise_of(owner), [owner], GRID, look, look(maps))


def test_merges_that_do_not_pay_are_taken_back_and_a_surface_takes_in_one_neighbour_at_a_time():
    """Two short surfaces, far apart on one wall, could each be taken in by the long one between them."""
    cells, owner, points = wall()
    for worth in (moves.MIN_GAIN_NATS / 2, -moves.MIN_GAIN_NATS, 2 * moves.MIN_GAIN_NATS):
        maps = moves.ChainMaps(cells[None].copy(), np.zeros((1, GRID.n_cells), dtype=bool))
        gone = merged_by(maps, owner, points, worth)
        left = np.flatnonzero(maps.cells[0, :, 0] > 0.1)
        assert gone == [3 - len(left)]
        assert (len(left) < 3) == (worth > moves.MIN_GAIN_NATS) != np.array_equal(maps.cells[0], cells)
        assert flat(4, 5) in left
    cells, owner, points = wall(((3, 3), (5, 40), (7, 3)))
    maps = moves.ChainMaps(cells[None].copy(), np.zeros((1, GRID.n_cells), dtype=bool))
    assert merged_by(maps, owner, points, 10.0) == [1]
    (left,) = (x for x in (3, 7) if maps.cells[0, flat(x, 5), 0] > 0.1)
    cells[flat(left, 5), 0] = moves.FREE
    new = moves.propose_merges(cells, np.zeros(GRID.n_cells, dtype=bool), owner, points, noise_of(owner), GRID)
    (at,) = np.flatnonzero(new.index[:, 0] == flat(10 - left, 5))
    assert new.index[at, 1] == flat(5, 5)
    np.testing.assert_array_equal(maps.cells[0, flat(5, 5)], new.cells[at, 1])


SURFACES = {"surfaces": PRIORS["surfaces"], "labelled surfaces": LABELLED["labelled surfaces"]}


def prepared(prior, early_sweeps=0):
    sampler = StopGibbs(early_sweeps)
    return sampler, sampler.prepare(Model(scans(), ROOM, prior, TRUTH, hit_depth=0.5), "cpu")


@pytest.mark.parametrize("kind", SURFACES)
def test_readings_are_explained_better_than_before_and_no_surface_leaves_its_cell(kind):
    sampler, problem = prepared(SURFACES[kind])
    state, _ = sampler.step(sampler.init(problem, [0, 1], 0), 20)
    look, before = moves.make_evidence_of(problem, state.chains, 1.0), moves.ChainMaps.of(state.chains)
    seen = look(before)
    moves.make_merge_moves(problem, state.chains, 1.0)
    after = moves.ChainMaps.of(state.chains)
    assert not np.array_equal(before.cells, after.cells)
    assert (look(after) - seen).sum() > 0
    away = after.cells[..., 1:3] - ROOM.centers_from_corner_m(np.arange(ROOM.n_cells))
    assert abs(away).max() <= 0.5 * ROOM.resolution + 1e-6


@pytest.mark.parametrize("cuts", [[30], [7, 3, 1, 1, 0, 1, 4, 13], [1] * 30])
def test_surfaces_are_joined_in_the_warm_up_alone_after_the_same_sweeps_however_these_are_cut(monkeypatch, cuts):
    after = [moves.sweeps_before_merges(int(moves.EARLY_SHARE * warmup)) for warmup in range(60)]
    assert [len(sweeps) for sweeps in after] == 2 * [0] + 11 * [1] + 47 * [3]
    assert [warmup for warmup, sweeps in enumerate(after) if len(set(sweeps)) < len(sweeps)] == []
    assert [warmup for warmup, sweeps in enumerate(after) if max(sweeps, default=0) > warmup] == []
    sampler = make_sampler("stop-gibbs", ROOM, bm.Gibbs("radial"), 50)
    assert sampler == StopGibbs(early_sweeps=int(50 * moves.EARLY_SHARE))
    assert make_sampler("stop-gibbs", ROOM, bm.Gibbs("radial")) == StopGibbs()
    sampler, problem = prepared(PRIORS["surfaces"], 10)
    made, joined, sweeps = {}, [], StopChains.sweeps

    def watched(chains, first, count, *args, **options):
        if first < moves.FULL_SWEEP:  # others are trials
            made[id(chains)] = first + count
        return sweeps(chains, first, count, *args, **options)

    monkeypatch.setattr(StopChains, "sweeps", watched)
    monkeypatch.setattr(stop_gibbs, "make_merge_moves", lambda of, chains, beta: joined.append(made[id(chains)]))
    state = sampler.init(problem, [0, 1], 0)
    for count in cuts:
        state, info = sampler.step(state, count)
        assert info.log_likelihood.shape == info.log_prior.shape == (2, count)
    assert state.sweep == 30
    assert joined == moves.sweeps_before_merges(10) == [10, 11, 12]


def test_a_sweep_without_steps_moves_no_surface_of_a_cell_in_which_readings_end():
    sampler, problem = prepared(PRIORS["surfaces"])
    state, _ = sampler.step(sampler.init(problem, [0], 0), 3)
    ends = np.unique(end_cells(problem.rays))[1:]
    before, parameters = moves.ChainMaps.of(state.chains).cells[0], problem.prior.kernel_parameters(ROOM.resolution)
    moved = []
    for steps in (0, 6, 24):
        state.chains.put_cells(0, before)
        state.chains.sweeps(3, 1, TRUTH, parameters, steps=steps)
        away = abs(state.chains.cells(0)[ends, 1:] - before[ends, 1:]).max(axis=1)
        moved.append((away > 1e-5).mean())  # metres: turning into a surface's frame and back rounds
    assert moved[0] == 0
    assert 0.5 < moved[1] < moved[2]


SHAPE = (20, 15)


def naive_evidence(chains, chain, problem):
    """Beam by beam: the density of its reading less its part of what the surface costs that stopped it."""
    stopped, mean = chains.stopped_by(chain), problem.prior.mean
    out = np.zeros(problem.grid.n_cells)
    for beam, end in enumerate(end_cells(problem.rays)):
        if end < 0:
            continue
        out[end] += chains.log_likelihood(chain)[beam]
        if stopped[beam] >= 0:
            beams = (stopped == stopped[beam]).sum()
            out[end] -= (math.log((1 - mean) / mean) + 2.5 * math.log(1 + beams)) / beams
    return out


def test_evidence_is_the_sum_over_beams_whose_readings_end_in_a_cell_and_a_look_draws_stops_and_moves_no_cell():
    sampler, problem = prepared(bm.Surface())
    state, info = sampler.step(sampler.init(problem, [0, 1], 0), 3)
    for chain in (0, 1):
        assert state.chains.log_likelihood(chain).sum() == pytest.approx(info.log_likelihood[chain, -1], rel=1e-6)
        found = moves.evidence_by_cell(state.chains, chain, end_cells(problem.rays), problem.prior)
        np.testing.assert_allclose(found, naive_evidence(state.chains, chain, problem), rtol=1e-5, atol=1e-3)
        assert (found != 0).sum() > 50
    by, (stopped, _, _) = state.chains.stopped_by(0), state.chains.stops(0)
    np.testing.assert_array_equal(by >= 0, stopped)
    offsets = problem.rays.offsets
    assert all(cell in problem.rays.cells[offsets[b] : offsets[b + 1]] for b, cell in enumerate(by) if cell >= 0)
    maps, look = moves.ChainMaps.of(state.chains), moves.make_evidence_of(problem, state.chains, 1.0)
    seen = look(maps)
    assert np.array_equal(moves.ChainMaps.of(state.chains).cells, maps.cells)
    stops = state.chains.stopped_by(0)
    state.chains.sweeps(moves.TRIAL_SWEEP, 1, problem.sensor, problem.prior.kernel_parameters(ROOM.resolution))
    assert np.array_equal(state.chains.stopped_by(0), stops)  # by the same random numbers, though cells went on
    assert not np.array_equal(moves.ChainMaps.of(state.chains).cells, maps.cells)
    found = moves.evidence_by_cell(state.chains, 0, end_cells(problem.rays), problem.prior)
    np.testing.assert_array_equal(found, seen[0].ravel())


def test_changes_that_gain_stay_and_others_are_taken_back():
    """A look at maps gives each cell minus a thousand times the square by which m is off the truth."""
    rng = np.random.default_rng(0)
    truth, m = (rng.random((2, SHAPE[0] * SHAPE[1])) for _ in range(2))
    cells = np.zeros((*m.shape, 6), dtype=np.float32)
    cells[..., 0] = m
    maps = moves.ChainMaps(cells, np.zeros(m.shape, dtype=bool))

    def look(maps):
        return -1000 * (maps.cells[..., 0].astype(float) - truth).reshape(-1, *SHAPE) ** 2

    middle = np.argwhere(np.ones(SHAPE, dtype=bool))[:: 7 * SHAPE[1] // 4]
    where = (middle[:, 0] * SHAPE[1] + middle[:, 1])[:, None]
    new = [rng.random((len(where), 1)) for _ in range(2)]
    states = [np.concatenate([m_new[..., None], np.ones((len(where), 1, 5))], -1).astype(np.float32) for m_new in new]
    changes = [moves.Changes(middle, where, cells, np.ones(where.shape, dtype=bool)) for cells in states]
    before = look(maps)
    stays = moves.try_changes(maps, changes, look, before, 0, 5.0)
    for chain in (0, 1):
        at = where[:, 0]
        gain = 1000 * ((m[chain, at] - truth[chain, at]) ** 2 - (new[chain][:, 0] - truth[chain, at]) ** 2)
        np.testing.assert_array_equal(stays[chain], gain >= 5.0)
        assert 0 < stays[chain].sum() < len(at)
        expected = m[chain].copy()
        expected[at[stays[chain]]] = new[chain][stays[chain], 0]
        np.testing.assert_allclose(maps.cells[chain, :, 0], expected, rtol=1e-6)
        np.testing.assert_array_equal(np.flatnonzero(maps.solid[chain]), np.sort(at[stays[chain]]))
    np.testing.assert_allclose(before, look(maps), atol=1e-3)

    places = rng.permutation(np.argwhere(np.ones(SHAPE, dtype=bool)))[:80]
    distance = abs(places[:, None] - places).max(axis=-1)
    for cells in (1, 4):  # sites that are tried together lie apart, and the others next to one before them
        chosen = moves.select_apart(places, cells, SHAPE)
        for i in range(len(places)):
            assert chosen[i] == (distance[i, :i][chosen[:i]].min(initial=99) > cells)
        assert 1 < chosen.sum() < len(places)
