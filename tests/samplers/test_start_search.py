"""Chains of surfaces search for better starts: changes of many cells are tried at once, and the better ones stay.

A chain takes the squares of its second start that explain its readings better, where these fit, and by itself.
"""

import math

import numpy as np
import pytest
from stop_rooms import GRID, LABELLED, PRIORS, TRUTH, scans

import bayesmap as bm
from bayesmap.kernels.surfaces.stop_chains import StopChains
from bayesmap.model import Model
from bayesmap.samplers import start_search, stop_gibbs
from bayesmap.samplers.initial_estimate import end_cells
from bayesmap.samplers.methods import sampler_of
from bayesmap.samplers.start_search import (
    BETTER_NATS,
    HALF_WIDTHS,
    MARGIN,
    SEARCH_SHARE,
    UPDATES_ALL,
    UPDATES_FEW,
    ChainMaps,
    Changes,
    apart,
    evidence,
    look_with,
    merge,
    merge_sweeps,
    select_starts,
    squares,
    sums_over_squares,
    take_better_squares,
    try_changes,
)
from bayesmap.samplers.stop_gibbs import StopGibbs

SURFACES = {"surfaces": PRIORS["surfaces"], "labelled surfaces": LABELLED["labelled surfaces"]}


def prepared(prior, search_until=0):
    sampler = StopGibbs(search_until)
    return sampler, sampler.prepare(Model(scans(), GRID, prior, TRUTH, hit_depth=0.5), "cpu")


@pytest.fixture(scope="module", params=SURFACES)
def settled(request):
    """Chains of which one has lost a wall, before and after they looked at second starts of theirs."""
    sampler, problem = prepared(SURFACES[request.param])
    state, _ = sampler.step(sampler.init(problem, [0, 1], 0), 20)
    other, _ = sampler.step(sampler.init(problem, [2, 3], 0), 20)
    cells = [state.chains.cells(chain).copy() for chain in (0, 1)]
    lost = np.zeros(GRID.shape, dtype=bool)
    lost[:8, :8] = True
    cells[0][lost.ravel(), 0] = 1e-20
    for chain in (0, 1):
        state.chains.put_cells(chain, cells[chain])
    look = look_with(problem, state.chains, 1.0)
    before = ChainMaps.of(state.chains)
    seen = look(before)
    gain = (look(ChainMaps.of(other.chains)) - seen).reshape(2, -1)
    for chain in (0, 1):
        state.chains.put_cells(chain, cells[chain])
    select_starts(problem, state.chains, other.chains, gain, 1.0)
    merge(problem, state.chains, 1.0)
    return before, ChainMaps.of(state.chains), seen, look, lost


def test_a_wall_that_a_chain_has_lost_comes_back(settled):
    before, after, _, _, lost = settled
    stops = [(maps.cells[0, :, 0] > 0.5).reshape(GRID.shape)[lost].sum() for maps in (before, after)]
    assert stops[0] == 0
    assert stops[1] >= 5


def test_readings_are_explained_better_than_before(settled):
    _, after, seen, look, _ = settled
    gained = (look(after) - seen).sum(axis=(1, 2))
    assert gained[0] > 100
    assert gained[1] >= 0


def test_no_surface_leaves_its_cell(settled):
    _, after, _, _, _ = settled
    away = after.cells[..., 1:3] - GRID.cell_centres_m(np.arange(GRID.n_cells))
    assert abs(away).max() <= 0.5 * GRID.resolution + 1e-6


def test_a_search_ends_when_it_is_to_and_reports_all_its_sweeps():
    sampler, problem = prepared(PRIORS["surfaces"], 10)
    state = sampler.init(problem, [0, 1], 0)
    assert state.second is not None
    state, info = sampler.step(state, 9)
    assert state.second is not None
    assert info.log_likelihood.shape == (2, 9)
    state, info = sampler.step(state, 3)
    assert state.second is None
    assert state.evidence is None
    assert info.log_likelihood.shape == info.log_prior.shape == (2, 3)
    assert state.sweep == 12


def test_surfaces_are_joined_in_the_warm_up_alone():
    after = [merge_sweeps(int(SEARCH_SHARE * warmup)) for warmup in range(60)]
    assert [len(sweeps) for sweeps in after] == 2 * [0] + 11 * [1] + 47 * [3]
    assert [warmup for warmup, sweeps in enumerate(after) if len(set(sweeps)) < len(sweeps)] == []
    assert [warmup for warmup, sweeps in enumerate(after) if max(sweeps, default=0) > warmup] == []


@pytest.mark.parametrize("cuts", [[30], [7, 3, 1, 1, 0, 1, 4, 13], [1] * 30])
def test_surfaces_are_joined_after_the_same_sweeps_however_these_are_cut(monkeypatch, cuts):
    sampler, problem = prepared(PRIORS["surfaces"], 10)
    made, joined, sweeps = {}, [], StopChains.sweeps

    def watched(chains, first, count, *args, **options):
        if first < UPDATES_ALL:  # others are trials
            made[id(chains)] = first + count
        return sweeps(chains, first, count, *args, **options)

    monkeypatch.setattr(StopChains, "sweeps", watched)
    monkeypatch.setattr(stop_gibbs, "merge", lambda of, chains, beta: joined.append(made[id(chains)]))
    state = sampler.init(problem, [0, 1], 0)
    for count in cuts:
        state, info = sampler.step(state, count)
        assert info.log_likelihood.shape == info.log_prior.shape == (2, count)
    assert state.sweep == 30
    assert joined == merge_sweeps(10) == [10, 11, 12]


def test_second_starts_are_other_starts():
    sampler, problem = prepared(PRIORS["surfaces"], 10)
    state = sampler.init(problem, [0, 1], 0)
    ends = np.unique(end_cells(problem.rays))[1:]
    starts = [chains.cells(chain)[ends] for chains in (state.chains, state.second) for chain in (0, 1)]
    for i, one in enumerate(starts):
        assert all((one != other).any(axis=1).all() for other in starts[:i])


@pytest.mark.parametrize("prior", [bm.Beta(), bm.Beta(coupling=0.5)])
def test_cells_without_surfaces_have_one_start(prior):
    sampler, problem = prepared(prior, 10)
    assert sampler.init(problem, [0], 0).second is None


def test_surfaces_search_in_the_first_part_of_the_warm_up():
    sampler, _ = sampler_of("stop-gibbs", GRID, bm.Gibbs("radial"), 50)
    assert sampler == StopGibbs(search_until=int(50 * SEARCH_SHARE))
    assert sampler_of("stop-gibbs", GRID, bm.Gibbs("radial"))[0] == StopGibbs()


def test_a_sweep_without_steps_moves_no_surface_of_a_cell_in_which_readings_end():
    sampler, problem = prepared(PRIORS["surfaces"])
    state, _ = sampler.step(sampler.init(problem, [0], 0), 3)
    ends = np.unique(end_cells(problem.rays))[1:]
    before, numbers = ChainMaps.of(state.chains).cells[0], problem.prior.kernel_numbers(GRID.resolution)
    moved = []
    for steps in (0, 6, 24):
        state.chains.put_cells(0, before)
        state.chains.sweeps(3, 1, TRUTH, numbers, steps=steps)
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


WIDE = (40, 30)
GOOD = np.zeros(WIDE)
GOOD[5:8, 5:8] = GOOD[20:27, 10:16] = GOOD[0:2, 28:30] = 1.0
"""Three places of which the second start knows, and the first does not."""


def map_of(m):
    cells = np.zeros((1, m.size, 6), dtype=np.float32)
    cells[0, :, 0] = m.ravel()
    return ChainMaps(cells, np.zeros((1, m.size), dtype=bool))


def look_at_good(maps):
    """Each cell whose m is that of the good places is worth ten nats."""
    return 10.0 * (maps.cells[..., 0].reshape(-1, *WIDE) == GOOD)


def test_chains_take_what_is_better_and_keep_what_is_not():
    worse = GOOD.copy()
    worse[30:35, 20:25] = 0.5  # of these places the first start knows more
    first, second = map_of(np.zeros(WIDE)), map_of(worse)
    gain = look_at_good(second) - look_at_good(first)
    second.solid[0] = GOOD.ravel() > 0
    take_better_squares(first, second, gain, look_at_good)
    np.testing.assert_array_equal(first.cells[0, :, 0].reshape(WIDE), GOOD)
    np.testing.assert_array_equal(first.solid, second.solid)


def test_a_square_that_does_not_fit_among_the_chain_s_own_is_taken_back():
    def seams(maps):
        """A cell of the second start's next to one of the first costs more than it is worth."""
        m = maps.cells[..., 0].reshape(-1, *WIDE)
        return look_at_good(maps) - 1000.0 * ((m[:, :, :] == 1) & (np.roll(m, 1, axis=1) == 0))

    first, second = map_of(np.zeros(WIDE)), map_of(GOOD)
    take_better_squares(first, second, look_at_good(second) - look_at_good(first), seams)
    assert not first.cells.any()


def test_too_little_is_not_looked_for():
    gain = np.zeros(WIDE)
    gain[10, 10], gain[25, 25] = BETTER_NATS + 0.1, BETTER_NATS - 0.1
    tried = np.zeros(WIDE, dtype=bool)
    found = squares(0, map_of(GOOD), gain, 1, tried)
    assert len(found.middle) == 1
    assert abs(found.middle[0] - 10).max() <= 1
    tried[9:12, 9:12] = True
    assert len(squares(0, map_of(GOOD), gain, 1, tried).middle) == 0


def test_squares_side_by_side_are_tried_one_after_the_other(monkeypatch):
    monkeypatch.setattr(start_search, "HALF_WIDTHS", (1,))
    row = np.zeros(WIDE)
    row[3:6, 3:27:6] = 1.0  # further apart than small squares are wide, and closer than beams are asked

    def look_at_good(maps):
        return 10.0 * (maps.cells[..., 0].reshape(-1, *WIDE) == row)

    first, second = map_of(np.zeros(WIDE)), map_of(row)
    take_better_squares(first, second, look_at_good(second) - look_at_good(first), look_at_good)
    np.testing.assert_array_equal(first.cells[0, :, 0].reshape(WIDE), row)


@pytest.mark.parametrize("half", HALF_WIDTHS)
def test_no_beam_is_asked_about_two_squares(half):
    gain = np.random.default_rng(half).uniform(0, 2 * BETTER_NATS, WIDE)
    found = squares(0, map_of(GOOD), gain, half, np.zeros(WIDE, dtype=bool)).middle
    assert len(found) > 1
    asked = np.zeros(WIDE, dtype=int)
    for x, y in found:
        asked[max(0, x - half - MARGIN) : x + half + MARGIN + 1, max(0, y - half - MARGIN) : y + half + MARGIN + 1] += 1
    assert asked.max() == 1
