"""Estimates before the chains: the fitted sensor and prior, from training scans alone, and the initial map.

Tolerances are in standard errors, from data sets drawn anew, and a part of the value where the model that fits is not
quite the one that drew. False alarms: below 1e-4 for each test.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy
from oracle.stop_law import draw_readings, draw_states, paths_of
from oracle.stop_worlds import beam_rays, centres_of, scans_of_all_kinds, touching
from stop_rooms import GRID, TRUTH, assert_same, infer, scans

import bayesmap as bm
from bayesmap.model import Model
from bayesmap.samplers import fit as fits
from bayesmap.samplers import stop_problem as estimates
from bayesmap.samplers.stop_problem import trace_stops
from bayesmap.sensors.model import RangeLimits

SIX = ("sigma_m", "sigma_per_m", "p_random", "p_no_return", "p_short", "rate_short_per_m")


def numbers(sensor):
    """A sensor's numbers; a noise of many degrees of freedom counts as a normal one that scatters as much."""
    of_noise = sensor.noise.kernel_parameters()
    wider = np.sqrt(of_noise.dof / (of_noise.dof - 2.0)) if of_noise.dof else 1.0
    return np.array([wider * getattr(of_noise, name) if "sigma" in name else getattr(sensor, name) for name in SIX])


def fitted_to_known_stops(seed, least_m, count=12_000):
    """Every beam's stop is given, up to a surface's spread; some lie out of range, some beams meet nothing."""
    rng, limits = np.random.default_rng(seed), RangeLimits(least_m, 8.0)
    distance = np.where(rng.random(count) < 0.1, np.inf, rng.uniform(0.5, 10.0, count))
    variance = rng.uniform(0, 0.05**2, count)
    spread = np.where(np.isfinite(distance), np.sqrt(variance) * rng.standard_normal(count), 0.0)
    stopped = np.isfinite(distance)
    readings = TRUTH.sample(rng, distance + spread, limits)
    stops = fits.DrawnStops(readings, stopped, np.where(stopped, distance, 0.0), variance)
    sensor = bm.BeamMixture(bm.Gaussian(0.1, 0.001), p_random=0.2, p_no_return=0.2, p_short=0.2, rate_short_per_m=2.0)
    for _ in range(40):
        sensor = fits.refit_sensor(sensor, stops, limits, 1.0)
    return numbers(sensor)


@pytest.mark.full
@pytest.mark.parametrize("least_m", [0.05, 0.3])
def test_with_known_stops_the_fit_is_right_within_its_standard_error(least_m):
    found = np.array([fitted_to_known_stops(seed, least_m) for seed in range(8)])
    error = found.std(axis=0, ddof=1) / np.sqrt(len(found))
    # Readings that are too close are left out, but counted as possible: they flatter chance by their share.
    assert (abs(found.mean(axis=0) - numbers(TRUTH)) < 6 * error + 0.02 * numbers(TRUTH)).all()
    assert (error < 0.05 * numbers(TRUTH)).all()


def drawn_map(prior, seed, poses=250, beams=30):
    """Scans of cells that were drawn from the prior itself."""
    grid, rng = bm.Grid((16, 16), 0.25), np.random.default_rng(seed)
    where = np.column_stack([rng.uniform(0, 4, (poses, 2)), rng.uniform(-3, 3, poses)])
    nothing = bm.Scans(where, np.linspace(-2, 2, beams), np.full((poses, beams), np.inf), max_range_m=6.0)
    rays = touching(beam_rays(nothing, grid, whole=True), np.arange(grid.n_cells))
    cells = draw_states(rng, prior, centres_of(rays))
    readings = draw_readings(rng, paths_of(rays, far=False), cells, TRUTH, not isinstance(prior, bm.Surface))
    return replace(nothing, ranges_m=readings.reshape(poses, beams)), grid


@pytest.mark.parametrize("prior", [bm.Beta(0.2, 1.0), bm.Surface(0.2, 1.0)])
def test_with_an_unknown_map_the_fit_comes_near_the_truth(prior):
    """7500 beams, of which some thousand say something about each number: a standard error of 3 to 15 %."""
    data, grid = drawn_map(prior, 4)
    problem = trace_stops(data, grid, replace(prior, a=0.02, b=0.2), fits.initial_sensor(prior, grid.resolution))
    found = fits.fit(problem, 0, 80)
    mine, truth = found.sensor, TRUTH
    for name, tolerance in (("p_random", 0.5), ("p_no_return", 0.5), ("p_short", 0.4), ("rate_short_per_m", 0.6)):
        assert abs(np.log(getattr(mine, name) / getattr(truth, name))) < tolerance, name
    assert abs(np.log(mine.noise.scale_at(1.5) / truth.noise.scale_at(1.5))) < 0.25
    assert abs(np.log(found.prior.mean / prior.mean)) < 0.35
    assert abs(np.log(found.prior.a / prior.a)) < 0.6


def test_only_training_scans_are_looked_at():
    whole = scans(poses=20)
    other = replace(whole, ranges_m=np.where(np.arange(20)[:, None] % 10 == 5, 1.0, whole.ranges_m))
    trains = [data.holdout(10)[0] for data in (whole, other)]
    assert_same(infer("surfaces", trains[0]), infer("surfaces", trains[1]))
    assert infer("surfaces", whole).posterior.sensor != infer("surfaces", trains[0]).posterior.sensor


def test_a_pilot_fits_and_all_chains_run_under_what_it_found():
    stops = []
    run = infer("surfaces", on_checkpoint=stops.append, checkpoint_every_s=0.0)
    assert {stop.posterior.sensor for stop in stops} == {run.posterior.sensor}
    problem = trace_stops(scans(), GRID, bm.Surface(), fits.initial_sensor(bm.Surface(), GRID.resolution))
    found = fits.fit(problem, 0, 12)
    assert (run.posterior.sensor, run.posterior.prior) == (found.sensor, found.prior)
    assert found != fits.fit(problem, 1, 12)
    assert found != fits.fit(problem, 0, 11)
    assert fits.fit(problem, 0, 0).sensor == problem.sensor


def test_a_pilot_is_as_long_as_the_warm_up_or_as_it_helps_and_a_given_sensor_and_prior_are_not_touched():
    events = []
    infer("surfaces", scans(poses=3), warmup=fits.PILOT_SWEEPS + 5, draws=0, chains=1, on_progress=events.append)
    assert max(event.done for event in events if event.stage == "fit") == fits.PILOT_SWEEPS
    run = infer("surfaces", scans(poses=3), warmup=0, draws=1)
    assert run.posterior.sensor == fits.initial_sensor(bm.Surface(), GRID.resolution)
    run = infer("surfaces", sensor=TRUTH)
    assert (run.posterior.sensor, run.posterior.prior) == (TRUTH, bm.Surface())
    assert "fitted" not in run.posterior.settings


def test_binary_walls_can_have_a_fitted_sensor():
    model = Model(scans(), GRID, bm.Independent(0.1), TRUTH, hit_depth=0.5)
    assert 0.3 < fits.fit_sensor(model, "cpu", seed=0, threads=None).p_random / TRUTH.p_random < 3
    short = bm.Schedule(chains=1, warmup=5, draws=5)
    run = bm.infer(scans(poses=5), GRID, prior=bm.Independent(0.1), sensor="fit", schedule=short)
    assert isinstance(run.posterior.sensor, bm.BeamMixture)


def test_the_prior_s_counts_are_found_from_hits_and_passes():
    rng = np.random.default_rng(6)
    m = rng.beta(0.3, 1.2, 20_000)
    met = rng.integers(0, 30, m.size)
    hits = rng.binomial(met, m)
    found = fits.refit_prior(bm.Surface(0.02, 0.2, mean_scale=0.5), hits, met - hits, 1.0)
    assert (found.a, found.b) == (pytest.approx(0.3, rel=0.06), pytest.approx(1.2, rel=0.06))
    assert found.mean_scale == 0.5
    half = fits.refit_prior(bm.Beta(0.02, 0.2), hits, met - hits, 0.5)
    assert half.a == pytest.approx(np.sqrt(0.02 * found.a), rel=1e-3)
    # cells that have not counted yet are left out
    some = fits.refit_prior(bm.Surface(0.02, 0.2, mean_scale=0.5), hits, np.where(m > 0.9, -1, met - hits), 1.0)
    assert some.a != found.a
    assert fits.refit_prior(bm.Beta(), hits, np.full(m.size, -1), 1.0) == bm.Beta()


def test_steps_are_whole_while_the_map_is_coming_about_and_then_shrink():
    steps = [fits.step_size_after(sweep) for sweep in range(fits.FIRST_FIT_SWEEP, fits.PILOT_SWEEPS)]
    assert steps == sorted(steps, reverse=True)
    last_whole = fits.FULL_STEPS_UNTIL - fits.FIRST_FIT_SWEEP
    assert steps[0] == steps[last_whole] == 1.0 > steps[last_whole + 1]
    assert sum(step**2 for step in steps if step < 1) < 2  # noise is averaged out


COUNT = 10_000
FIRST = bm.Gaussian(0.02, 0.002)


def residuals(noise, seed, count=COUNT):
    """Residuals of stops at 1 to 15 m whose surfaces spread up to 3 cm: both scales add up in quadrature."""
    rng = np.random.default_rng(seed)
    distance = rng.uniform(1.0, 15.0, count)
    variance = rng.uniform(0.0, 0.03, count) ** 2
    scale = np.hypot(noise.scale_at(distance), np.sqrt(variance))
    return fits.StopResiduals(scale * noise.draw(rng, (count,)), distance, variance, np.ones(count))


def fitted(found):
    noise = FIRST
    for _ in fits.DOFS:
        noise = fits.refit_noise(noise, found, 1.0)
    return noise


@pytest.mark.parametrize("dof", fits.DOFS)
def test_shape_scale_and_growth_are_found(dof):
    truth = bm.Gaussian(0.01, 0.003) if dof == math.inf else bm.StudentT(0.01, dof, 0.003)
    found = [fitted(residuals(truth, seed)) for seed in range(6)]
    assert [type(noise) for noise in found] == [type(truth)] * 6
    numbers = np.array([(n.dof, n.sigma_m, n.sigma_per_m) for n in (one.kernel_parameters() for one in found)])
    assert (numbers[:, 0] == truth.kernel_parameters().dof).all()
    error = numbers[:, 1:].std(axis=0, ddof=1) / np.sqrt(len(found))
    assert (abs(numbers[:, 1:].mean(axis=0) - [0.01, 0.003]) < 6 * error).all()
    assert (error < [0.0008, 0.00015]).all()


def test_few_readings_do_not_make_heavy_tails():
    """Normal ones, 60 at a time: a number more has to be worth its while."""
    shapes = [type(fitted(residuals(bm.Gaussian(0.02), seed, count=60))) for seed in range(40)]
    assert shapes.count(bm.StudentT) < 8  # 2 expected; 8 or more are chance less often than once in 10 000 runs
    assert [type(fitted(residuals(bm.StudentT(0.02, 3.0), seed, count=600))) for seed in range(5)] == [bm.StudentT] * 5


def test_a_part_of_a_step_goes_a_part_of_the_way_leaves_the_shape_and_too_few_readings_change_nothing():
    found = residuals(bm.StudentT(0.01, 3.0, 0.003), 0)
    assert fits.refit_noise(bm.StudentT(0.04, 9.0, 0.001), found, 1.0).dof == 5.0  # one shape at a time
    normal, half = fits.refit_noise(FIRST, found, 0.5), fits.refit_noise(FIRST, found, 0.25)
    assert isinstance(normal, bm.Gaussian)
    assert math.log(normal.sigma_m / FIRST.sigma_m) == pytest.approx(2 * math.log(half.sigma_m / FIRST.sigma_m))
    assert fits.refit_noise(FIRST, residuals(bm.Gaussian(0.02), 0, count=9), 1.0) is FIRST


MIXTURE = bm.BeamMixture(bm.Gaussian(0.05))


@pytest.fixture(scope="module")
def problem():
    grid = bm.Grid((7, 6), resolution=0.25, origin=(-1.0, 2.0))
    return trace_stops(scans_of_all_kinds(9, grid, poses=30, limits=(0.1, 2.0)), grid, bm.Surface(), MIXTURE)


def naive(rays):
    """The touched cell in which each reading ends, and hits and passes by cell, beam by beam."""
    edge, ny = rays.grid.resolution, rays.grid.shape[1]
    distance_m = rays.stop_distance_m(0.0)
    ends, hits, passes = [], np.zeros(rays.grid.n_cells, int), np.zeros(rays.grid.n_cells, int)
    for b, z in enumerate(rays.range_m):
        end = -1
        if np.isfinite(z):
            x, y = np.floor((rays.start_m[b] + z * rays.direction[b].astype(float)) / edge).astype(int)
            if 0 <= x < rays.grid.shape[0] and 0 <= y < ny and x * ny + y in rays.touched:
                end = x * ny + y
        ends.append(end)
        if end >= 0:
            hits[end] += 1
        if np.isnan(z) or z < 0:
            continue
        for k in range(rays.offsets[b], rays.offsets[b + 1]):
            if rays.cells[k] == end or distance_m[k] > z:
                break
            passes[rays.cells[k]] += 1
    return np.array(ends), hits[rays.touched], passes[rays.touched]


def test_counts_are_naive_counts(problem):
    ends, hits, passes = naive(problem.rays)
    estimate = problem.estimate
    np.testing.assert_array_equal(estimates.end_cells(problem.rays), ends)
    np.testing.assert_array_equal(estimate.touched, problem.rays.touched)
    np.testing.assert_array_equal(estimate.hits, hits)
    np.testing.assert_array_equal(estimate.passes, passes)
    np.testing.assert_array_equal(estimate.endpoint, hits > 0)
    assert hits.sum() > 20
    assert passes.sum() > hits.sum()


def test_moments_are_those_of_the_end_points_drawn_towards_the_prior_and_widened(problem):
    rays, estimate = problem.rays, problem.estimate
    cells, hits = estimate.endpoint_cells, estimate.hits[estimate.endpoint]
    ends, centres = estimates.end_cells(rays), rays.grid.centers_from_corner_m(cells)
    spread = 0.28 * rays.grid.resolution
    for u in np.argsort(hits)[[0, -5, -2, -1]]:
        points = rays.end_points_m()[ends == cells[u]]
        weights = np.append(np.ones(len(points)), 0.3)
        every = np.vstack([points, centres[u]])
        mean = np.average(every, axis=0, weights=weights)
        away = every - mean
        covariance = ((away * weights[:, None]).T @ away + 0.5 * spread**2 * np.eye(2)) / (len(points) + 1)
        l11, l21, l22 = estimate.factor_m[u]
        factor = np.array([[l11, 0.0], [l21, l22]])
        np.testing.assert_allclose(estimate.mean_m[u], mean, atol=1e-6)
        (across, along), axes = np.linalg.eigh(covariance)
        wide = axes @ np.diag([across, along * estimates.ALONG_WALL_SIGMAS**2]) @ axes.T
        np.testing.assert_allclose(factor @ factor.T, wide, atol=1e-7)


def test_endpoint_cells_step_in_a_frame_along_their_longer_axis_and_by_their_thickness_across(problem):
    moved = estimates.steps_and_frames(problem.estimate, problem.grid.resolution)
    assert moved.shape == (problem.estimate.endpoint.sum(), 8)
    assert (moved[:, :6] > 0).all()
    hits = problem.estimate.hits[problem.estimate.endpoint]
    for (l11, l21, l22), n, row in zip(problem.estimate.factor_m, hits, moved, strict=True):
        factor = np.array([[l11, 0.0], [l21, l22]])
        (across, along), axes = np.linalg.eigh(factor @ factor.T)
        frame = row[6:].astype(float)
        assert np.linalg.norm(frame) == pytest.approx(1.0, rel=1e-5)
        if along > 1.01 * across:  # a round one has no longer axis
            assert abs(frame @ axes[:, 1]) == pytest.approx(1.0, abs=1e-4)
        assert row[2] == pytest.approx(estimates.STEP_ACROSS_SIGMAS * np.sqrt(across / (n + 1)), rel=1e-3)


def test_every_cell_of_the_grid_has_a_start_those_without_beams_from_the_prior():
    """Kolmogorov and Smirnov at 1e-6, and a twin: the cells in which readings end are not so distributed."""
    grid = bm.Grid((60, 60), resolution=0.25)
    scans = bm.Scans([7.0, 7.0, 0.3], [0.0, 0.5], [[1.2, 0.9]], max_range_m=2.0)
    prior = bm.Surface(0.8, 1.5)
    problem = trace_stops(scans, grid, prior, MIXTURE)
    rng = np.random.default_rng(3)
    states = [estimates.draw_start(problem.estimate, prior, problem.rays, rng) for _ in range(3)]
    untouched = np.setdiff1d(np.arange(grid.n_cells), problem.rays.touched)
    assert len(untouched) > 3000
    surfaces = prior.sample_surfaces(np.random.default_rng(4), 20_000) * grid.resolution
    for state in states:
        away = state[untouched, 1:3] - grid.centers_from_corner_m(untouched)
        assert scipy.stats.kstest(state[untouched, 0], scipy.stats.beta(prior.a, prior.b).cdf).pvalue > 1e-6
        for drawn, expected in ((away[:, 0], surfaces[:, 0]), (state[untouched, 3], surfaces[:, 2])):
            assert scipy.stats.ks_2samp(drawn, expected).pvalue > 1e-6
        assert scipy.stats.ks_2samp(away[:, 0], 1.3 * surfaces[:, 0]).pvalue < 1e-6
    assert (states[0][problem.estimate.endpoint_cells] != states[1][problem.estimate.endpoint_cells]).all()


def test_end_points_outside_the_grid_past_what_beams_touch_or_that_did_not_return_belong_to_no_cell():
    scans = bm.Scans([-0.5, 0.5, 0.0], [0.0, 0.4], [[7.0, 1.0]], max_range_m=9.0)
    rays = beam_rays(scans, bm.Grid((3, 1)), margin_m=0.1)
    np.testing.assert_array_equal(estimates.end_cells(rays), [-1, 0])
    found = estimates.initial_estimate(rays, bm.Beta())
    np.testing.assert_array_equal(found.hits, found.touched == 0)
    scans = bm.Scans([0.5, 0.5, 0.0], np.arange(4) * np.pi / 2, [[np.inf, -np.inf, np.nan, 0.3]], max_range_m=2.0)
    rays = beam_rays(scans, bm.Grid((1, 1)), margin_m=0.1)
    np.testing.assert_array_equal(estimates.end_cells(rays), [-1, -1, -1, 0])
