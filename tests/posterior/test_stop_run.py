"""Users get from a run over reflectivities or surfaces what its draws say."""

from functools import cache

import numpy as np
import pytest
from oracle.stop_law import log_likelihoods, paths_of
from oracle.stop_worlds import beam_rays, scans_of_all_kinds
from samplers.stop_rooms import surfaces_of

import bayesmap as bm
from bayesmap.posterior.prediction import predictor_of
from bayesmap.posterior.scores import beam_log_scores

GRID = bm.Grid((4, 3), 0.5, (-1.0, 2.0))
SENSOR = bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_random=0.05, p_no_return=0.1, p_short=0.1)
PRIORS = {"reflectivities": bm.Beta(0.5, 1.0), "surfaces": bm.Surface(0.5, 1.0)}
KINDS = pytest.mark.parametrize("kind", PRIORS)
SHOWN = {"reflectivities": ("reflectivity", "expected"), "surfaces": ("stop_chance", "expected_stop_chance")}
TRAIN = scans_of_all_kinds(5, GRID, poses=30)


def inferred(scans, kind, **schedule):
    return bm.infer(scans, GRID, prior=PRIORS[kind], sensor=SENSOR, schedule=bm.Schedule(**schedule), hit_depth=0.5)


@cache
def run_of(kind, draws=8):
    return inferred(TRAIN, kind, chains=2, warmup=20, draws=draws)


def of(run, name):
    """An array of the draws, or the cells that one counts."""
    draws = run.posterior.draws
    return draws.arrays[name] if name in draws.arrays else draws.index[name]


@KINDS
def test_draws_and_their_mean_cover_the_grid(kind):
    run = run_of(kind)
    assert isinstance(run, bm.Run)
    assert (run.draws.shape, run.n_draws) == ((2, 8, 4, 3), 8)
    drawn, expected = (of(run, name) for name in SHOWN[kind])
    expected = expected.mean(axis=(0, 1), dtype=float)
    np.testing.assert_allclose(run.occupancy.ravel()[of(run, "cell")], expected, atol=1e-12)
    np.testing.assert_array_equal(run.draws.reshape(2, 8, -1)[..., of(run, "cell")], drawn)
    np.testing.assert_allclose(run.map_of(1, 3), run.draws[1, 3], atol=1e-6)
    assert run.log_joint.shape == (2, 8)
    assert len(run.plot().axes) >= 3


def test_draws_and_intervals_of_untouched_cells_are_the_prior_s():
    scans = bm.Scans([-1.5, 3.2, 0.0], [0.0], [[1.2]], max_range_m=3.0)
    schedule = bm.Schedule(chains=1, warmup=5, draws=400)
    run = bm.infer(scans, GRID, prior=bm.Beta(1.0, 1.0), sensor=SENSOR, schedule=schedule)
    elsewhere = np.ones(GRID.shape, dtype=bool)
    elsewhere.ravel()[of(run, "cell")] = False
    assert elsewhere.sum() == 8
    assert (run.occupancy[elsewhere] == 0.5).all()
    assert (run.draws[..., elsewhere] == 0.5).all()
    lower, upper = run.interval(0.8)
    np.testing.assert_allclose(lower[elsewhere], 0.1)
    np.testing.assert_allclose(upper[elsewhere], 0.9)


@KINDS
def test_intervals_are_quantiles_of_the_draws(kind):
    run = run_of(kind)
    flat = of(run, SHOWN[kind][0]).reshape(16, -1).astype(float)
    for level in (0.5, 0.9):
        lower, upper = run.interval(level)
        for end, q in ((lower, 0.5 - level / 2), (upper, 0.5 + level / 2)):
            np.testing.assert_allclose(end.ravel()[of(run, "cell")], np.quantile(flat, q, axis=0), atol=1e-12)
    for level in (0.0, 1.0, 90):
        with pytest.raises(bm.BadInput, match="level"):
            run.interval(level)


def test_mean_surfaces_are_means_over_draws_in_the_world_frame_and_a_run_without_hits_has_none():
    run = run_of("surfaces")
    mean, covariance, reflectivity = run_of("surfaces").surfaces()
    flat = of(run, "surface_cell")
    draws = surfaces_of(run.posterior).reshape(16, -1, 5).astype(float) * 0.5
    for u in (0, len(flat) // 2, len(flat) - 1):
        centre = np.array([-1.0, 2.0]) + (np.array([flat[u] // 3, flat[u] % 3]) + 0.5) * 0.5
        np.testing.assert_allclose(mean[u], centre + draws[:, u, :2].mean(axis=0))
        factors = np.zeros((16, 2, 2))
        factors[:, 0, 0], factors[:, 1, 0], factors[:, 1, 1] = draws[:, u, 2:].T
        np.testing.assert_allclose(covariance[u], np.mean(factors @ factors.transpose(0, 2, 1), axis=0))
        m = of(run, "expected")[:, :, np.searchsorted(of(run, "cell"), flat[u])].astype(float)
        assert reflectivity[u] == pytest.approx(m.mean())
    with pytest.raises(bm.BadInput, match=r"Surface\(\)"):
        run_of("reflectivities").surfaces()
    nothing = bm.Scans(TRAIN.poses, TRAIN.angles_rad, np.full(TRAIN.ranges_m.shape, np.inf), max_range_m=0.4)
    run = inferred(nothing, "surfaces", chains=2, warmup=1, draws=2)  # without hits
    assert [part.shape for part in run.surfaces()] == [(0, 2), (0, 2, 2), (0,)]
    run.plot()


def states_of(run, chain, draw, touched):
    """One draw's cells to predict by, (T', 6), in metres from the corner; every touched cell must have a surface."""
    states = np.zeros((len(touched), 6))
    states[:, 0] = of(run, "expected")[chain, draw, np.searchsorted(of(run, "cell"), touched)]
    if run.posterior.kind == "surface":
        at = np.searchsorted(of(run, "surface_cell"), touched)
        states[:, 1:] = surfaces_of(run.posterior)[chain, draw, at].astype(float) * GRID.resolution
        states[:, 1:3] += GRID.centers_from_corner_m(touched)
    return states


@KINDS
def test_the_log_score_is_the_log_mean_density_of_the_reference(kind):
    run = run_of(kind)
    if kind == "surfaces":
        assert len(of(run, "surface_cell")) == len(of(run, "cell")) == 12
    held = scans_of_all_kinds(6, GRID, poses=7)
    rays = beam_rays(held, GRID, whole=True)
    paths, density = paths_of(rays, far=False), 0.0
    for chain, draw in np.ndindex(2, 8):
        states = states_of(run, chain, draw, rays.touched)
        density = density + np.exp(log_likelihoods(paths, states, SENSOR, kind == "reflectivities")) / 16
    valid = ~np.isnan(held.ranges_m.ravel())
    mine = beam_log_scores(predictor_of(run.posterior), held)
    np.testing.assert_allclose(mine[valid], np.log(density)[valid], atol=2e-3)
    assert run.log_score(held) == pytest.approx(np.log(density)[valid].mean(), abs=1e-3)


@KINDS
def test_cells_that_no_beam_of_the_run_touched_are_scored_by_the_prior(kind):
    """A run over nothing but the first column; a held-out beam through the last two."""
    scans = bm.Scans([-0.9, 1.5, np.pi / 2], [0.0], [[0.7]], max_range_m=3.0)
    run = inferred(scans, kind, chains=1, warmup=2, draws=300)
    held = bm.Scans([0.6, 1.9, np.pi / 2], [0.0], [[np.inf]], max_range_m=3.0)
    # Plain cells in the way: three, each passed with the chance 1 - a / (a + b) = 2/3.
    score = run.log_score(held)
    if kind == "reflectivities":
        rays = beam_rays(held, GRID, whole=True)
        state = np.zeros((3, 6))
        state[:, 0] = 1 / 3
        expected = log_likelihoods(paths_of(rays), state, SENSOR, True)[0]  # linear in every m
        assert score == pytest.approx(expected, abs=1e-5)
    else:
        assert -1.5 < score < 0.0
