"""Fast ways of a sweep over surfaces: beams eight at a time, and lazy cells passed in one step, change no chain."""

from functools import cache

import numpy as np
import pytest
import warp as wp
from tiers import latin

import bayesmap as bm
from bayesmap.kernels.sensor_law import SensorLaw32, sensor_law
from bayesmap.kernels.surfaces import stops
from bayesmap.kernels.surfaces.cell_draws import ActiveCells
from bayesmap.kernels.surfaces.endpoint_beams import (
    UNKNOWN,
    EndpointCells,
    LaneBlocks,
    fill_blocks,
    fits_lanes,
    log_stops,
    log_stops_in_lanes,
)
from bayesmap.kernels.surfaces.endpoint_cells import NO_LEAST, BeamLists, listed_of, log_beams
from bayesmap.kernels.surfaces.stops import ChainArrays, TracedRays
from bayesmap.kernels.surfaces.surface import centre_of
from bayesmap.model import Model
from bayesmap.samplers import stop_problem
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.sensors.model import RangeLimits

wp.set_module_options({"enable_backward": False})

PRIOR = bm.Surface(0.5, 1.0, mean_scale=0.4, spread=0.3, dof=3.0)
HARD = bm.BeamMixture(bm.Gaussian(0.02, 0.01), p_random=0.05, p_no_return=0.1)
CROWD = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.01, p_short=0.4, rate_short_per_m=3.0)
SHARP = bm.BeamMixture(bm.Gaussian(0.001), p_random=1e-9)
TAILS = bm.BeamMixture(bm.StudentT(0.01, 5.0, 0.005), p_random=0.02, p_no_return=0.05)

SENSORS = {"hard": HARD, "crowd": CROWD, "sharp": SHARP, "heavy tails": TAILS}


@wp.kernel
def both_ways(
    law: SensorLaw32, rays: TracedRays, endpoints: EndpointCells, active: ActiveCells, state: ChainArrays,
    lists: BeamLists, blocks: LaneBlocks, leasts: wp.array(dtype=wp.float64), out: wp.array2d(dtype=wp.float64),
):  # fmt: skip
    """Weigh one by one; in lanes; both, cut short below the least. Count the beams without a lane, and the stopped."""
    u = wp.tid()
    c = endpoints.cell[u]
    cell = state.cells[c]
    centre = centre_of(c, active.ny, active.edge_m)
    begin, end = endpoints.offsets[u], endpoints.offsets[u + 1]
    listed = listed_of(lists, 0, u, begin, end, state.last_hits[c])
    one = state.beta
    out[0, u] = log_stops(law, one, rays, endpoints, listed, centre, cell, NO_LEAST)
    others = fill_blocks(blocks, 0, u, rays, endpoints, listed)
    beams = wp.vec2i(listed.passing_end - listed.passing_begin, listed.stopped_end - listed.stopped_begin - others)
    out[1, u] = log_stops_in_lanes(law, blocks, 0, u, beams, centre, cell, NO_LEAST)
    out[2, u] = log_beams(law, one, rays, endpoints, blocks, 0, u, listed, others, centre, cell, leasts[u])
    out[3, u] = wp.float64(others)
    out[4, u] = wp.float64(listed.stopped_end - listed.stopped_begin)


@wp.kernel
def is_for_lanes(law: SensorLaw32, beta: wp.float32, out: wp.array(dtype=wp.int32)):
    out[0] = wp.where(fits_lanes(law, beta), 1, 0)


def scans_of_a_room(rng, scans=60, beams=90):
    """Poses in a room of 4 m, readings about its walls; some of chance, too short, or without a return."""
    x, y = rng.uniform(0.8, 3.2, (2, scans))
    angle = np.linspace(-np.pi, np.pi, beams, endpoint=False)
    ux, uy = np.cos(angle), np.sin(angle)
    to_x = np.where(ux > 0, 4.0 - x[:, None], x[:, None]) / np.maximum(np.abs(ux), 1e-9)
    to_y = np.where(uy > 0, 4.0 - y[:, None], y[:, None]) / np.maximum(np.abs(uy), 1e-9)
    readings = np.minimum(to_x, to_y) + 0.02 * rng.normal(size=to_x.shape)
    kind = rng.uniform(size=readings.shape)
    readings = np.where(kind < 0.1, rng.uniform(0.1, 6.0, readings.shape), readings)
    readings = np.where(kind > 0.95, np.inf, readings)
    return bm.Scans(np.stack([x, y, np.zeros(scans)], axis=-1), angle, readings, max_range_m=6.0)


@cache
def weighed(sensor, seed, worse=0.0):
    """Weigh a room's endpoint cells by `both_ways` after a few sweeps, with random other surfaces.

    Returns (cells,) each: one by one, the leasts, in lanes, all beams, cut short, those without a lane, and stopped.
    """
    rng = np.random.default_rng(seed)
    model = Model(scans_of_a_room(rng), bm.Grid((28, 28), 0.2, (-0.8, -0.8)), PRIOR, sensor)
    sampler = StopGibbs()
    problem = sampler.prepare(model, "cpu", 1)
    state, _ = sampler.step(sampler.init(problem, [0], seed), 3)
    chains = state.chains
    there = np.array(chains.cells(0))
    there[:, 1:3] += worse * rng.normal(size=(len(there), 2))
    there[:, 3:] *= np.exp(0.3 * rng.normal(size=(len(there), 3)))
    chains.put_cells(0, there)
    law = sensor_law(problem.sensor, problem.rays.limits, "cpu", SensorLaw32)
    cells = len(chains.plan.endpoints)
    out = wp.zeros((5, cells), dtype=wp.float64)
    inputs = [law, chains._rays, chains._endpoints, chains._active, chains._state, chains._lists, chains._blocks]
    wp.launch(both_ways, dim=cells, inputs=[*inputs, wp.full(cells, -1e300, dtype=wp.float64), out])
    plain, lanes, whole, others, stopped = out.numpy().copy()
    least = plain + rng.normal(size=cells)
    wp.launch(both_ways, dim=cells, inputs=[*inputs, wp.array(least, dtype=wp.float64), out])
    return plain, least, lanes, whole, out.numpy()[2], others, stopped


@pytest.mark.parametrize(("name", "worse"), latin(2, list(SENSORS), [0.0, 0.05]))
def test_eight_at_a_time_say_what_each_says(name, worse):
    """Surfaces stand where their readings end, or beside it."""
    plain, least, lanes, whole, cut, others, stopped = weighed(SENSORS[name], 10, worse)
    close = 2e-5 * (1 + np.abs(plain)) + 2e-5 * stopped
    assert np.all(np.abs(whole - plain) <= close)
    known = (others == 0) & (lanes != float(UNKNOWN))
    assert known.sum() > 0.5 * (others == 0).sum() > 20
    assert stopped[known].max() > 16  # more than two blocks of them
    assert np.all(np.abs(lanes - plain)[known] <= close[known])
    decided = np.abs(plain - least) > close
    assert np.array_equal((cut > least)[decided], (plain > least)[decided])
    assert np.all(np.abs(cut - plain)[plain > least] <= close[plain > least])


def test_beams_without_a_lane_and_products_too_small_for_a_number_are_taken_one_by_one():
    plain, _, lanes, whole, _, others, stopped = weighed(HARD, 4)
    assert 0 < others.sum() < 0.1 * stopped.sum()
    mixed = (others > 0) & (others < stopped)
    assert mixed.any()
    assert np.abs(lanes - plain)[mixed].min() > 0.1
    assert np.abs(whole - plain)[mixed].max() < 1e-3
    plain, _, lanes, whole, *_ = weighed(SHARP, 3, 0.05)
    unknown = lanes == float(UNKNOWN)
    assert 0 < unknown.sum() < 0.2 * unknown.size
    assert np.array_equal(whole[unknown], plain[unknown])
    assert weighed(HARD, 3, 0.05)[0].sum() < weighed(HARD, 3)[0].sum() - 100


@pytest.mark.parametrize(("sensor", "beta", "takes"), [
    (HARD, 1.0, 1), (HARD, 0.5, 0), (bm.Gaussian(0.1), 1.0, 0), (TAILS, 1.0, 1),
    (bm.BeamMixture(bm.StudentT(0.1, dof=4.0)), 1.0, 0), (bm.BeamMixture(bm.StudentT(0.1, dof=33.0)), 1.0, 0),
])  # fmt: skip
def test_lanes_are_for_mixtures_with_normal_noise_or_few_and_odd_degrees_of_freedom(sensor, beta, takes):
    law = sensor_law(sensor, RangeLimits(0.0, 6.0), "cpu", SensorLaw32)
    out = wp.zeros(1, dtype=wp.int32)
    wp.launch(is_for_lanes, dim=1, inputs=[law, beta, out])
    assert out.numpy()[0] == takes


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
    every = stop_problem.update_periods(problem.estimate)
    assert {2, 8, 16} <= set(every.tolist())
    schedule = stops.UpdateSchedule(problem.rays, every)
    assert [sweep for sweep in range(32) if schedule.updates_lazy(sweep)] == [0, 8, 16, 24]
