"""Trials change maps in many places, and keep what the readings around each place gain by."""

import math

import numpy as np
import pytest
from stop_rooms import GRID, TRUTH, scans

import bayesmap as bm
from bayesmap.model import Model
from bayesmap.samplers.initial_estimate import end_cells
from bayesmap.samplers.start_search import (
    UPDATES_FEW,
    ChainMaps,
    Changes,
    apart,
    covered,
    evidence,
    look_with,
    sums_over_squares,
    try_changes,
)
from bayesmap.samplers.stop_gibbs import StopGibbs

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


def test_evidence_is_the_sum_over_the_beams_whose_readings_end_in_a_cell():
    sampler = StopGibbs()
    problem = sampler.prepare(Model(scans(), GRID, bm.Surface(), TRUTH, hit_depth=0.5), "cpu")
    state, info = sampler.step(sampler.init(problem, [0, 1], 0), 3)
    for chain in (0, 1):
        assert state.chains.log_likelihood(chain).sum() == pytest.approx(info.log_likelihood[chain, -1], rel=1e-6)
        found = evidence(state.chains, chain, end_cells(problem.rays), problem.prior)
        np.testing.assert_allclose(found, naive_evidence(state.chains, chain, problem), rtol=1e-5, atol=1e-3)
        assert (found != 0).sum() > 50


def test_a_beam_is_stopped_by_a_cell_that_it_crosses_or_by_none():
    sampler = StopGibbs()
    problem = sampler.prepare(Model(scans(), GRID, bm.Surface(), TRUTH, hit_depth=0.5), "cpu")
    state, _ = sampler.step(sampler.init(problem, [0], 0), 3)
    by, (stopped, _, _) = state.chains.stopped_by(0), state.chains.stops(0)
    np.testing.assert_array_equal(by >= 0, stopped)
    offsets = problem.rays.offsets
    assert all(cell in problem.rays.cells[offsets[b] : offsets[b + 1]] for b, cell in enumerate(by) if cell >= 0)


def test_a_look_draws_the_stops_of_a_whole_sweep_and_moves_no_cell():
    sampler = StopGibbs()
    problem = sampler.prepare(Model(scans(), GRID, bm.Surface(), TRUTH, hit_depth=0.5), "cpu")
    state, _ = sampler.step(sampler.init(problem, [0, 1], 0), 3)
    maps, look = ChainMaps.of(state.chains), look_with(problem, state.chains, 1.0)
    seen = look(maps)
    assert np.array_equal(ChainMaps.of(state.chains).cells, maps.cells)
    stops = state.chains.stopped_by(0)
    numbers = problem.prior.kernel_numbers(GRID.resolution)
    state.chains.sweeps(UPDATES_FEW, 1, problem.sensor, numbers)  # the same random numbers, and cells that go on
    assert np.array_equal(state.chains.stopped_by(0), stops)
    assert not np.array_equal(ChainMaps.of(state.chains).cells, maps.cells)
    found = evidence(state.chains, 0, end_cells(problem.rays), problem.prior)
    np.testing.assert_array_equal(found, seen[0].ravel())


def worth(truth):
    """A look at maps whose cells are each worth minus a thousand times the square by which m is off ``truth``."""
    return lambda maps: -1000 * (maps.cells[..., 0].astype(float) - truth).reshape(-1, *SHAPE) ** 2


def maps_of(m):
    cells = np.zeros((len(m), SHAPE[0] * SHAPE[1], 6), dtype=np.float32)
    cells[..., 0] = m
    return ChainMaps(cells, np.zeros(cells.shape[:2], dtype=bool))


def test_what_gains_stays_and_what_does_not_is_taken_back():
    rng = np.random.default_rng(0)
    truth, m = (rng.random((2, SHAPE[0] * SHAPE[1])) for _ in range(2))
    maps, look = maps_of(m), worth(truth)
    middle = np.argwhere(np.ones(SHAPE, dtype=bool))[:: 7 * SHAPE[1] // 4]
    where = (middle[:, 0] * SHAPE[1] + middle[:, 1])[:, None]
    new = [rng.random((len(where), 1)) for _ in range(2)]
    changes = [
        Changes(middle, where, np.concatenate([m_new[..., None], np.ones((len(where), 1, 5))], -1).astype(np.float32),
                np.ones(where.shape, dtype=bool))
        for m_new in new
    ]  # fmt: skip
    before = look(maps)
    stays = try_changes(maps, changes, look, before, 0, 5.0)
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


def test_sums_over_squares_are_naive_sums():
    values = np.random.default_rng(1).normal(size=SHAPE)
    for half in (0, 1, 3):
        padded = np.pad(values, half)
        naive = [[padded[x : x + 2 * half + 1, y : y + 2 * half + 1].sum() for y in range(15)] for x in range(20)]
        np.testing.assert_allclose(sums_over_squares(values, half), naive, atol=1e-9)


@pytest.mark.parametrize("cells", [1, 4])
def test_places_that_are_tried_together_lie_apart_and_the_others_next_to_one_before_them(cells):
    places = np.random.default_rng(2).permutation(np.argwhere(np.ones(SHAPE, dtype=bool)))[:80]
    chosen = apart(places, cells, SHAPE)
    distance = abs(places[:, None] - places).max(axis=-1)
    for i in range(len(places)):
        earlier = distance[i, :i][chosen[:i]]
        assert chosen[i] == (earlier.min(initial=99) > cells)
    assert 1 < chosen.sum() < len(places)


def test_squares_cover_the_cells_around_their_middles_inside_the_grid():
    found = covered(np.array([[0, 0], [10, 14]]), 2, SHAPE)
    assert found[:3, :3].all()
    assert found[8:13, 12:15].all()
    assert found.sum() == 9 + 15
