"""Beams that pass their lazy cells in one step draw what beams draw that walk all their cells."""

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.kernels.surfaces import stops
from bayesmap.model import Model
from bayesmap.samplers import initial_estimate
from bayesmap.samplers.stop_gibbs import StopGibbs

GRID = bm.Grid((40, 40), resolution=0.25)
SENSOR = bm.BeamMixture(bm.Gaussian(0.03), p_random=0.05, p_no_return=0.05, p_short=0.05)
PRIORS = {"reflectivities": bm.Beta(0.3, 1.0), "surfaces": bm.Surface(0.3, 1.0)}
SWEEPS = 40


def scans():
    """A square room, seen from many places."""
    rng = np.random.default_rng(5)
    poses = np.column_stack([*rng.uniform(3.0, 7.0, (2, 60)), rng.uniform(-np.pi, np.pi, 60)])
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[4:36, [4, 35]] = walls[[4, 35], 4:36] = True
    angles = np.linspace(-2.0, 2.0, 40)
    return bm.simulate(walls, GRID, poses, angles, sensor=SENSOR, max_range_m=12.0, seed=3)


def swept(kind, sweeps=SWEEPS, resume=None):
    """Log-likelihoods of each sweep, (1, sweeps), and where the chain stands."""
    sampler = StopGibbs()
    problem = sampler.prepare(Model(scans(), GRID, PRIORS[kind], SENSOR), "cpu", 1)
    state, info = sampler.step(sampler.init(problem, [0], 7, resume), sweeps)
    return info.log_likelihood, sampler.snapshot(state)


@pytest.mark.parametrize("kind", PRIORS)
def test_chains_are_those_of_beams_that_walk_all_their_cells(kind, monkeypatch):
    fast, _ = swept(kind)
    assert len({round(value, 3) for value in fast[0]}) > 4
    monkeypatch.setattr(stops.UpdateSchedule, "updates_lazy", lambda self, sweep: True)
    plain, _ = swept(kind)
    np.testing.assert_allclose(fast, plain, rtol=1e-5)


@pytest.mark.parametrize("kind", PRIORS)
def test_cells_that_were_let_pass_unseen_would_be_noticed(kind, monkeypatch):
    """The wrong twin: beams pass lazy cells as if these stopped none."""
    fast, _ = swept(kind)
    monkeypatch.setattr(stops.UpdateSchedule, "mark_watched", _forgetful(stops.UpdateSchedule.mark_watched))
    wrong, _ = swept(kind)
    assert abs(fast - wrong).max() > 1.0


def _forgetful(mark_watched):
    def put(self, there, device):
        holds = mark_watched(self, there, device)
        holds.zero_()
        return holds

    return put


@pytest.mark.parametrize("kind", PRIORS)
@pytest.mark.parametrize("first", [3, 9, 16])
def test_chains_that_go_on_between_two_turns_are_those_that_never_stopped(kind, first):
    whole, there = swept(kind)
    _, begun = swept(kind, first)
    rest, resumed = swept(kind, SWEEPS - first, begun)
    np.testing.assert_array_equal(whole[:, first:], rest)
    np.testing.assert_array_equal(there.arrays["state"], resumed.arrays["state"])


def test_held_cells_have_their_turn_together_and_seldom():
    problem = StopGibbs().prepare(Model(scans(), GRID, PRIORS["surfaces"], SENSOR), "cpu", 1)
    every = initial_estimate.update_periods(problem.estimate)
    assert {2, 8, 16} <= set(every.tolist())
    schedule = stops.UpdateSchedule(problem.rays, every)
    assert [sweep for sweep in range(32) if schedule.updates_lazy(sweep)] == [0, 8, 16, 24]
