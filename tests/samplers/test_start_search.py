"""Chains of surfaces go on from the better of two starts in each place, and by themselves."""

import numpy as np
import pytest
from stop_rooms import GRID, LABELLED, PRIORS, TRUTH, scans

import bayesmap as bm
from bayesmap.kernels.surfaces.stop_chains import StopChains
from bayesmap.model import Model
from bayesmap.samplers import stop_gibbs
from bayesmap.samplers.initial_estimate import end_cells
from bayesmap.samplers.methods import sampler_of
from bayesmap.samplers.start_search import (
    SEARCH_SHARE,
    UPDATES_ALL,
    ChainMaps,
    look_with,
    merge,
    merge_sweeps,
    select_starts,
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
