"""Compiled densities of readings and priors equal the plain reference, and fast ways of a sweep change no chain."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import warp as wp
from oracle.stop_law import draw_readings, draw_states, log_likelihoods, log_prior, paths_of
from oracle.stop_worlds import Worlds, beam_rays, centres_of, draw_worlds
from oracle.worlds import OwnSensor
from tiers import latin

import bayesmap as bm
from bayesmap.kernels.device import Float32Rows, Float32s, pack
from bayesmap.kernels.predict.density import log_densities
from bayesmap.kernels.sensor_law import (
    SensorLaw32,
    highest_density,
    lowest_density,
    object_decay,
    sensor_law,
    stop_density,
)
from bayesmap.kernels.surfaces import stops
from bayesmap.kernels.surfaces.endpoint_beams import (
    UNKNOWN,
    LaneBlocks,
    StopLikelihood,
    fill_blocks,
    fits_lanes,
    log_stops,
    log_stops_in_lanes,
)
from bayesmap.kernels.surfaces.endpoint_cells import UNBOUNDED, BeamLists, beams_of_cell, log_beams
from bayesmap.kernels.surfaces.stops import ChainArrays
from bayesmap.kernels.surfaces.surface import centre_of
from bayesmap.model import Model
from bayesmap.samplers import stop_problem
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import trace_stops
from bayesmap.sensors.model import RangeLimits

wp.set_module_options({"enable_backward": False})

WIDE = bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_random=0.05, p_no_return=0.1, p_short=0.1, rate_short_per_m=0.6)
PRECISE = bm.BeamMixture(bm.Gaussian(0.004, 0.001), p_random=0.01, p_no_return=0.0, p_short=0.02)
LONG_TAILS = bm.BeamMixture(bm.StudentT(0.02, 3.0, 0.005), p_random=0.02, p_no_return=0.1, p_short=0.1)
LONE = bm.Grid((5, 2), 0.4)
DENSITY_PRIORS = {
    "reflectivities": bm.Beta(0.8, 1.5), "reflectivities by default": bm.Beta(), "surfaces": bm.Surface(0.8, 1.5),
    "thin surfaces": bm.Surface(0.8, 1.5, mean_scale=0.6, spread=0.05, dof=4.0), "surfaces by default": bm.Surface(),
}  # fmt: skip
# Single precision: a density is off by 1e-6 of itself, more where a surface is seen edge on.
CLOSE = {"rtol": 3e-4, "atol": 3e-4}


def swept_log_likelihoods(worlds, truth):
    """Log-likelihoods of every beam under the given states, as a sweep computes them on the way."""
    sampler = worlds.sampler(1, truth)
    total, prior = sampler.sweep()
    return sampler.arrays.log_likelihood.numpy(), total[0], prior[0]


@pytest.mark.parametrize("sensor", [WIDE, PRECISE, LONG_TAILS], ids=["blunt", "sharp", "heavy tails"])
@pytest.mark.parametrize("name", DENSITY_PRIORS)
def test_a_sweep_s_log_likelihood_is_the_reference_s(name, sensor):
    prior = DENSITY_PRIORS[name]
    worlds, truth = draw_worlds([7, len(name)], LONE, prior, sensor, 300, poses=2, beams=6)
    paths = paths_of(worlds.problem.rays)
    assert paths.far.sum() > 50
    mine, total, _ = swept_log_likelihoods(worlds, truth)
    expected = log_likelihoods(paths, truth.astype(np.float32).astype(float), sensor, not isinstance(prior, bm.Surface))
    np.testing.assert_allclose(mine, expected, **CLOSE)
    assert total == pytest.approx(expected.sum(), rel=1e-4)


@pytest.mark.parametrize("noise", [bm.Gaussian(0.02, 0.003), bm.StudentT(0.01, 3.0, 0.002)], ids=["normal", "t"])
@pytest.mark.parametrize("name", ["surfaces", "surfaces by default", "reflectivities by default"])
def test_stops_far_from_the_reading_that_count_as_random_readings_hardly_matter(name, noise):
    """The shortcut costs less than 0.005 nats a beam, and nothing if cells have no surfaces and noise no heavy tail."""
    prior = DENSITY_PRIORS[name]
    plain = not isinstance(prior, bm.Surface)
    grid = bm.Grid((24, 2), 0.1)
    sensor = bm.BeamMixture(noise, p_random=0.02, p_no_return=0.01, p_short=0.02)
    rng = np.random.default_rng(10)
    poses = np.column_stack([np.full(400, -0.05), rng.uniform(0.02, 0.18, 400), np.zeros(400)])
    scans = bm.Scans(poses, [-0.03, 0.0, 0.03], np.ones((400, 3)), max_range_m=2.6)
    whole = beam_rays(scans, grid, margin_m=np.inf, whole=True)
    lost, far = [], 0
    for _ in range(5):
        states = draw_states(rng, prior, centres_of(whole))
        readings = draw_readings(rng, paths_of(whole, far=False), states, sensor, plain)
        rays = trace_stops(replace(scans, ranges_m=readings.reshape(400, 3)), grid, prior, sensor).rays
        np.testing.assert_array_equal(rays.touched, whole.touched)
        short, full = paths_of(rays), paths_of(replace(whole, range_m=readings), far=False)
        lost.append(log_likelihoods(full, states, sensor, plain) - log_likelihoods(short, states, sensor, plain))
        far += short.far.sum()
    assert far > 1000
    most = 5e-3 if not plain else 1e-9 if isinstance(noise, bm.Gaussian) else 1e-4
    assert np.mean(np.abs(lost)) < most


@pytest.mark.parametrize("name", DENSITY_PRIORS)
def test_the_log_prior_is_the_reference_s_but_for_its_constant(name):
    """The constant depends on the prior alone: sums over the same cells differ by the same number in all states."""
    prior = DENSITY_PRIORS[name]
    worlds, _ = draw_worlds([11, 0], bm.Grid((2, 2), 0.4), prior, WIDE, 4, poses=1, beams=3)
    rng, centres = np.random.default_rng(12), centres_of(worlds.problem.rays)
    off = []
    for _ in range(20):
        state = draw_states(rng, prior, centres).astype(np.float32)
        state[:, 0] = np.clip(state[:, 0], 1e-25, 1 - 1e-6)
        _, _, mine = swept_log_likelihoods(worlds, state)
        off.append(mine - log_prior(prior, state.astype(float), centres).sum())
    assert np.ptp(off) < 1e-3 * (1 + abs(np.mean(off)))


@pytest.mark.parametrize("plain", [True, False])
def test_nothing_is_impossible_but_no_density_is_nan(plain):
    """Cells that stop everything, or nothing, and readings that such cells cannot give."""
    prior = bm.Beta(1, 1) if plain else bm.Surface(1, 1)
    sensor = bm.BeamMixture(bm.Gaussian(0.01), p_random=1e-3, p_no_return=0.0, p_short=0.0)
    readings = np.array([[0.9, np.inf, -np.inf, np.nan, 0.0, 3.0]])
    scans = bm.Scans([-0.3, 0.3, 0.0], np.linspace(-0.2, 0.2, 6), readings, max_range_m=3.0)
    problem = trace_stops(scans, LONE, prior, sensor)
    for m in (0.0, 1.0, 1e-30, 1 - 1e-7):
        states = np.zeros((len(problem.rays.touched), 6))
        states[:, 0], states[:, 3], states[:, 5] = m, 0.1, 0.1
        states[:, 1:3] = centres_of(problem.rays)[0]
        sampler = Worlds(problem, LONE.shape, 1).sampler(1, states)
        for beta in (1.0, 1.0, 0.5, 0.0):
            log_likelihood, _ = sampler.sweep(beta=beta)
            assert np.isfinite(log_likelihood).all()
            hits, met = sampler.counts()
            assert hits.min() >= 0
            assert max(hits.max(), met.max()) <= 5
        batch = states[None].astype(np.float32)
        found = log_densities(problem.rays, [batch[..., 0] if plain else batch], sensor, 0.5)
        assert np.isfinite(found[~np.isnan(readings[0])]).all()


LIMITS = RangeLimits(0.1, 6.0)
COUNT = 40_000
BOUNDED = {
    "normal": bm.BeamMixture(bm.Gaussian(0.02, 0.01), p_random=0.02, p_no_return=0.1, p_short=0.1),
    "sharp": bm.BeamMixture(bm.Gaussian(0.001, 0.0), p_random=0.001, p_no_return=0.0, p_short=0.3),
    "heavy tails": bm.BeamMixture(bm.StudentT(0.05), p_random=0.2, p_no_return=0.02, p_short=0.05),
}


@wp.kernel
def densities(law: SensorLaw32, reading_m: Float32s, distance_m: Float32s, variance: Float32s, out: Float32Rows):
    i = wp.tid()
    z = reading_m[i]
    out[0, i] = lowest_density(law, z)
    out[1, i] = stop_density(law, z, object_decay(law, z), distance_m[i], variance[i])
    out[2, i] = highest_density(law, z)


def lowest_any_highest(sensor):
    rng = np.random.default_rng(3)
    distance = rng.uniform(0.0, 9.0, COUNT)
    distance[:100] = np.inf
    reading = np.where(rng.random(COUNT) < 0.5, distance + rng.normal(0, 0.01, COUNT), rng.uniform(0.1, 6.0, COUNT))
    reading = np.where(np.isfinite(reading) & (reading > 0.1) & (reading < 6.0), reading, np.inf)
    reading[rng.random(COUNT) < 0.1] = -np.inf
    variance = rng.choice([0.0, 1e-6, 1e-4, 0.01], COUNT)
    arrays = [wp.array(x.astype(np.float32), dtype=wp.float32, device="cpu") for x in (reading, distance, variance)]
    out = wp.zeros((3, COUNT), dtype=wp.float32, device="cpu")
    wp.launch(densities, dim=COUNT, inputs=[sensor_law(sensor, LIMITS, "cpu", SensorLaw32), *arrays, out], device="cpu")
    return reading, *out.numpy()


@pytest.mark.parametrize("name", BOUNDED)
def test_no_density_lies_outside_its_bounds_and_some_come_close(name):
    reading, lowest, density, highest = lowest_any_highest(BOUNDED[name])
    assert (density >= 0.999 * lowest).all()
    assert (density <= 1.001 * highest).all()
    hit = np.isfinite(reading)
    assert density[hit].min() < 1.1 * lowest[hit].min()
    assert density[hit].max() > 0.5 * highest[hit].max()  # the twin: half of the bound would be too low
    assert (density[np.isposinf(reading)] < 2 * lowest[np.isposinf(reading)]).any()
    if name == "normal":  # a tabulated law has no bounds
        _, lowest, _, highest = lowest_any_highest(OwnSensor(bm.Gaussian(0.2)))
        assert (lowest == 0).all()
        assert np.isinf(highest).all()


PRIOR = bm.Surface(0.5, 1.0, mean_scale=0.4, spread=0.3, dof=3.0)
HARD = bm.BeamMixture(bm.Gaussian(0.02, 0.01), p_random=0.05, p_no_return=0.1)
CROWD = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.01, p_short=0.4, rate_short_per_m=3.0)
SHARP = bm.BeamMixture(bm.Gaussian(0.001), p_random=1e-9)
TAILS, EVEN = (bm.BeamMixture(bm.StudentT(0.01, dof, 0.005), p_random=0.02, p_no_return=0.05) for dof in (5.0, 4.0))

SENSORS = {"hard": HARD, "crowd": CROWD, "sharp": SHARP, "heavy tails": TAILS, "even": EVEN}


@wp.kernel
def both_ways(
    likelihood: StopLikelihood, state: ChainArrays, lists: BeamLists, blocks: LaneBlocks,
    leasts: wp.array(dtype=wp.float64), out: wp.array2d(dtype=wp.float64),
):  # fmt: skip
    """Weigh one by one; in lanes; both, cut short below the least. Count the beams without a lane, and the stopped."""
    u = wp.tid()
    c = likelihood.endpoints.cell[u]
    cell = state.cells[c]
    centre = centre_of(c, state.ny, state.edge_m)
    beams = beams_of_cell(lists, likelihood.endpoints, 0, u, state.last_hits[c])
    out[0, u] = log_stops(likelihood, beams, centre, cell, UNBOUNDED)
    own = fill_blocks(likelihood, blocks, 0, beams)
    out[1, u] = log_stops_in_lanes(likelihood.law, blocks, own, centre, cell, UNBOUNDED)
    out[2, u] = log_beams(likelihood, blocks, own, beams, centre, cell, leasts[u])
    out[3, u] = wp.float64(beams.stopped_end - beams.stopped_begin - own.n_stopped)
    out[4, u] = wp.float64(beams.stopped_end - beams.stopped_begin)


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
    beams = {"rays": chains._rays, "endpoints": chains._endpoints}
    inputs = [pack(StopLikelihood, "cpu", law=law, beta=1.0, **beams), chains._state, chains._lists, chains._blocks]
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
    (HARD, 1.0, 1), (HARD, 0.5, 0), (bm.Gaussian(0.1), 1.0, 0), (TAILS, 1.0, 1), (EVEN, 1.0, 1),
    (bm.BeamMixture(bm.StudentT(0.1, dof=4.5)), 1.0, 0), (bm.BeamMixture(bm.StudentT(0.1, dof=33.0)), 1.0, 0),
])  # fmt: skip
def test_lanes_are_for_mixtures_with_normal_noise_or_few_and_whole_degrees_of_freedom(sensor, beta, takes):
    law = sensor_law(sensor, RangeLimits(0.0, 6.0), "cpu", SensorLaw32)
    out = wp.zeros(1, dtype=wp.int32)
    wp.launch(is_for_lanes, dim=1, inputs=[law, beta, out])
    assert out.numpy()[0] == takes


GRID = bm.Grid((40, 40), resolution=0.25)
SENSOR = bm.BeamMixture(bm.Gaussian(0.03), p_random=0.05, p_no_return=0.05, p_short=0.05)
PRIORS = {"reflectivities": bm.Beta(0.3, 1.0), "surfaces": bm.Surface(0.3, 1.0)}


@pytest.fixture(scope="module", params=PRIORS)
def problem(request):
    """A square room, seen from many places."""
    rng = np.random.default_rng(5)
    poses = np.column_stack([*rng.uniform(3.0, 7.0, (2, 60)), rng.uniform(-np.pi, np.pi, 60)])
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[4:36, [4, 35]] = walls[[4, 35], 4:36] = True
    scans = bm.simulate(walls, GRID, poses, np.linspace(-2.0, 2.0, 40), sensor=SENSOR, max_range_m=12.0, seed=3)
    return StopGibbs().prepare(Model(scans, GRID, PRIORS[request.param], SENSOR), "cpu", 1)


def swept(problem):
    """Log-likelihoods of each of 40 sweeps, (1, 40)."""
    sampler = StopGibbs()
    return sampler.step(sampler.init(problem, [0], 7), 40)[1].log_likelihood


@pytest.fixture(scope="module")
def whole(problem):
    return swept(problem)


def test_chains_are_those_of_beams_that_walk_all_their_cells(problem, whole, monkeypatch):
    assert len({round(value, 3) for value in whole[0]}) > 4
    monkeypatch.setattr(stops.UpdateSchedule, "updates_lazy", lambda self, sweep: True)
    np.testing.assert_allclose(whole, swept(problem), rtol=1e-5)


def test_cells_that_were_let_pass_unseen_would_be_noticed(problem, whole, monkeypatch):
    """The wrong twin: beams pass lazy cells as if these stopped none."""
    watched_to_device = stops.UpdateSchedule.watched_to_device

    def forgetful(self, rays, device):
        lazy = watched_to_device(self, rays, device)
        lazy.zero_()
        return lazy

    monkeypatch.setattr(stops.UpdateSchedule, "watched_to_device", forgetful)
    assert abs(whole - swept(problem)).max() > 1.0


def test_lazy_cells_are_updated_together_and_seldom(problem):
    every = stop_problem.update_periods(problem.estimate)
    assert {2, 8, 16} <= set(every.tolist())
    schedule = stops.UpdateSchedule(problem.rays, every)
    assert [sweep for sweep in range(32) if schedule.updates_lazy(sweep)] == [0, 8, 16, 24]
