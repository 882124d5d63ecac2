"""The first guess takes readings at their word: its counts and moments are those of a naive loop."""

import numpy as np
import pytest
from oracle.field_worlds import beam_rays, scans_of_all_kinds

import bayesmap as bm
from bayesmap.samplers.field_gibbs import build_field
from bayesmap.samplers.plug_in import end_cells, pace, plug_in, steps

SENSOR = bm.BeamMixture(bm.Gaussian(0.05))


@pytest.fixture(scope="module")
def problem():
    grid = bm.Grid((7, 6), resolution=0.25, origin=(-1.0, 2.0))
    scans = scans_of_all_kinds(9, grid, poses=30, limits=(0.1, 2.0))
    return build_field(scans, grid, bm.Surface(), SENSOR)


def naive(rays):
    """The touched cell in which each reading ends, and hits and passes by cell, beam by beam."""
    edge, ny = rays.grid.resolution, rays.grid.shape[1]
    place = {int(flat): i for i, flat in enumerate(rays.touched)}
    ends, hits, passes = [], np.zeros(rays.n_cells, int), np.zeros(rays.n_cells, int)
    for b, z in enumerate(rays.range_m):
        end = -1
        if np.isfinite(z):
            x, y = np.floor((rays.start_m[b] + z * rays.direction[b].astype(float)) / edge).astype(int)
            if 0 <= x < rays.grid.shape[0] and 0 <= y < ny:
                end = place.get(x * ny + y, -1)
        ends.append(end)
        if end >= 0:
            hits[end] += 1
        if np.isnan(z) or z < 0:
            continue
        for k in range(rays.offsets[b], rays.offsets[b + 1]):
            if rays.cells[k] == end or rays.distance_m[k] > z:
                break
            passes[rays.cells[k]] += 1
    return np.array(ends), hits, passes


def test_counts_are_naive_counts(problem):
    ends, hits, passes = naive(problem.rays)
    np.testing.assert_array_equal(end_cells(problem.rays), ends)
    np.testing.assert_array_equal(problem.guess.hits, hits)
    np.testing.assert_array_equal(problem.guess.passes, passes)
    np.testing.assert_array_equal(problem.guess.busy, hits > 0)
    assert hits.sum() > 20
    assert passes.sum() > hits.sum()


def test_moments_are_those_of_the_end_points_drawn_towards_the_prior(problem):
    rays, guess = problem.rays, problem.guess
    ends, centres, spread = end_cells(rays), rays.centres_m(), 0.28 * rays.grid.resolution
    for cell in np.argsort(guess.hits)[[0, -5, -2, -1]]:
        points = rays.end_points_m()[ends == cell]
        weights = np.append(np.ones(len(points)), 0.3)
        every = np.vstack([points, centres[cell]])
        mean = np.average(every, axis=0, weights=weights)
        away = every - mean
        covariance = ((away * weights[:, None]).T @ away + 0.5 * spread**2 * np.eye(2)) / (len(points) + 1)
        l11, l21, l22 = guess.factor_m[cell]
        factor = np.array([[l11, 0.0], [l21, l22]])
        np.testing.assert_allclose(guess.mean_m[cell], mean, atol=1e-6)
        np.testing.assert_allclose(factor @ factor.T, covariance, atol=1e-7)


def test_only_busy_cells_step(problem):
    moved = steps(problem.guess, problem.rays.grid.resolution)[:, :6] != 0
    assert moved[problem.guess.busy].all()
    assert not moved[~problem.guess.busy].any()


def test_cells_rest_the_longer_the_further_readings_are(problem):
    from bayesmap.kernels.stops import IN_A_ROW

    rays, busy = problem.rays, problem.guess.busy
    ny = rays.grid.shape[1]
    where = np.stack([rays.touched // ny, rays.touched % ny], axis=-1)
    nearest = np.abs(where[:, None] - where[busy]).max(axis=-1).min(axis=1)
    turns = pace(problem.guess)
    np.testing.assert_array_equal(turns == 0, nearest == 0)
    np.testing.assert_array_equal(turns == 16, nearest == 1)
    np.testing.assert_array_equal(turns == 32, nearest > 1)
    assert set(np.unique(turns) % IN_A_ROW) == {0}  # one candidate for so many cells is enough


def test_end_points_outside_the_grid_or_past_what_beams_touch_belong_to_no_cell():
    scans = bm.Scans([-0.5, 0.5, 0.0], [0.0, 0.4], [[7.0, 1.0]], max_range_m=9.0)
    rays = beam_rays(scans, bm.Grid((3, 1)), margin_m=0.1)
    assert end_cells(rays)[0] == -1
    assert plug_in(rays, bm.Beta()).hits.sum() <= 1


def test_readings_along_the_axes_that_did_not_return_end_nowhere():
    """Infinity times a direction of zero is not a number."""
    scans = bm.Scans([0.5, 0.5, 0.0], np.arange(4) * np.pi / 2, [[np.inf, -np.inf, np.nan, 0.3]], max_range_m=2.0)
    rays = beam_rays(scans, bm.Grid((1, 1)), margin_m=0.1)
    np.testing.assert_array_equal(end_cells(rays), [-1, -1, -1, 0])
