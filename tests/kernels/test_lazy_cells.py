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


@pytest.fixture(scope="module", params=PRIORS)
def problem(request):
    """A square room, seen from many places."""
    rng = np.random.default_rng(5)
    poses = np.column_stack([*rng.uniform(3.0, 7.0, (2, 60)), rng.uniform(-np.pi, np.pi, 60)])
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[4:36, [4, 35]] = walls[[4, 35], 4:36] = True
    scans = bm.simulate(walls, GRID, poses, np.linspace(-2.0, 2.0, 40), sensor=SENSOR, max_range_m=12.0, seed=3)
    return StopGibbs().prepare(Model(scans, GRID, PRIORS[request.param], SENSOR), "cpu", 1)


def swept(problem, sweeps=SWEEPS, resume=None):
    """Log-likelihoods of each sweep, (1, sweeps), and a snapshot of the chain."""
    sampler = StopGibbs()
    state, info = sampler.step(sampler.init(problem, [0], 7, resume), sweeps)
    return info.log_likelihood, sampler.snapshot(state)


@pytest.fixture(scope="module")
def whole(problem):
    return swept(problem)


def test_chains_are_those_of_beams_that_walk_all_their_cells(problem, whole, monkeypatch):
    assert len({round(value, 3) for value in whole[0][0]}) > 4
    monkeypatch.setattr(stops.UpdateSchedule, "updates_lazy", lambda self, sweep: True)
    np.testing.assert_allclose(whole[0], swept(problem)[0], rtol=1e-5)


def test_cells_that_were_let_pass_unseen_would_be_noticed(problem, whole, monkeypatch):
    """The wrong twin: beams pass lazy cells as if these stopped none."""
    mark_watched = stops.UpdateSchedule.mark_watched

    def forgetful(self, rays, device):
        lazy = mark_watched(self, rays, device)
        lazy.zero_()
        return lazy

    monkeypatch.setattr(stops.UpdateSchedule, "mark_watched", forgetful)
    assert abs(whole[0] - swept(problem)[0]).max() > 1.0


@pytest.mark.parametrize("first", [3, 9, 16])
def test_chains_that_go_on_between_two_updates_are_those_that_never_stopped(problem, whole, first):
    _, begun = swept(problem, first)
    rest, resumed = swept(problem, SWEEPS - first, begun)
    np.testing.assert_array_equal(whole[0][:, first:], rest)
    np.testing.assert_array_equal(whole[1].arrays["state"], resumed.arrays["state"])


def test_lazy_cells_are_updated_together_and_seldom(problem):
    every = initial_estimate.update_periods(problem.estimate)
    assert {2, 8, 16} <= set(every.tolist())
    schedule = stops.UpdateSchedule(problem.rays, every)
    assert [sweep for sweep in range(32) if schedule.updates_lazy(sweep)] == [0, 8, 16, 24]
