"""The initial estimate: its counts and moments are those of a naive loop."""

import numpy as np
import pytest
import scipy
from oracle.stop_worlds import beam_rays, scans_of_all_kinds

import bayesmap as bm
from bayesmap.samplers import initial_estimate as estimates
from bayesmap.samplers.stop_problem import trace_stops

SENSOR = bm.BeamMixture(bm.Gaussian(0.05))


@pytest.fixture(scope="module")
def problem():
    grid = bm.Grid((7, 6), resolution=0.25, origin=(-1.0, 2.0))
    scans = scans_of_all_kinds(9, grid, poses=30, limits=(0.1, 2.0))
    return trace_stops(scans, grid, bm.Surface(), SENSOR)


def naive(rays):
    """The touched cell in which each reading ends, and hits and passes by cell, beam by beam."""
    edge, ny = rays.grid.resolution, rays.grid.shape[1]
    distance_m = rays.distance_m(0.0)
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
    ends, centres, spread = (
        estimates.end_cells(rays),
        rays.grid.centers_from_corner_m(cells),
        0.28 * rays.grid.resolution,
    )
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
    moved = estimates.steps(problem.estimate, problem.grid.resolution)
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
    problem = trace_stops(scans, grid, prior, SENSOR)
    rng = np.random.default_rng(3)
    states = [estimates.draw_start_state(problem.estimate, prior, problem.rays, rng) for _ in range(3)]
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


def test_update_periods_grow_with_the_distance_from_readings(problem, monkeypatch):
    estimate = problem.estimate
    monkeypatch.setattr(estimates, "MIN_PASSES", 0)
    where = np.stack(np.divmod(estimate.touched, problem.grid.shape[1]), axis=-1)
    nearest = np.abs(where[:, None] - where[estimate.endpoint]).max(axis=-1).min(axis=1)
    np.testing.assert_array_equal(
        estimates.update_periods(estimate), np.select([nearest == 0, nearest == 1], [0, 8], 16)
    )
    # Cells that few beams pass are updated in every other sweep.
    middle, free = int(np.median(estimate.passes[~estimate.endpoint])), ~estimate.endpoint
    monkeypatch.setattr(estimates, "MIN_PASSES", middle)
    periods, few = estimates.update_periods(estimate), estimate.passes < middle
    assert (few & free).any()
    assert (~few & free).any()
    assert (periods[few & free] == 2).all()
    assert (periods[~few & free] > 2).all()


def test_end_points_outside_the_grid_past_what_beams_touch_or_that_did_not_return_belong_to_no_cell():
    scans = bm.Scans([-0.5, 0.5, 0.0], [0.0, 0.4], [[7.0, 1.0]], max_range_m=9.0)
    rays = beam_rays(scans, bm.Grid((3, 1)), margin_m=0.1)
    np.testing.assert_array_equal(estimates.end_cells(rays), [-1, 0])
    found = estimates.initial_estimate(rays, bm.Beta())
    np.testing.assert_array_equal(found.hits, found.touched == 0)
    scans = bm.Scans([0.5, 0.5, 0.0], np.arange(4) * np.pi / 2, [[np.inf, -np.inf, np.nan, 0.3]], max_range_m=2.0)
    rays = beam_rays(scans, bm.Grid((1, 1)), margin_m=0.1)
    np.testing.assert_array_equal(estimates.end_cells(rays), [-1, -1, -1, 0])
