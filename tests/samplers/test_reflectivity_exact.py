"""Reflectivities on maps of one to four cells against the exact posterior: every way in which the beams may stop.

A few thousand copies of a map side by side are as many independent chains, so their states after some sweeps are
independent draws. False alarms: `ALPHA` = 1e-4 over this module.
"""

import numpy as np
import pytest
import scipy
from oracle.stop_law import Paths, exact_reflectivities, paths_of
from oracle.stop_worlds import build_worlds, copies
from oracle.verdict import ALPHA
from tiers import full_but

import bayesmap as bm
from bayesmap.samplers import initial_estimate

COPIES = 4000
TESTS = 200  # p-values in this module, at most


def sensor(sigma_m):
    return bm.BeamMixture(
        bm.Gaussian(sigma_m, 0.02), p_random=0.1, p_no_return=0.15, p_short=0.15, rate_short_per_m=0.8
    )


def scans_for(shape, seed):
    """Readings of every kind from poses on all sides; most end in or about the cells."""
    rng = np.random.default_rng(seed)
    size = np.array(shape) * 0.5
    poses, readings = [], []
    for side in range(3):
        angle = rng.uniform(-np.pi, np.pi)
        xy = size / 2 - (0.8 + 0.2 * side) * np.array([np.cos(angle), np.sin(angle)])
        poses.append([*xy, angle])
        row = rng.uniform(0.6, 1.4, 3)
        row[rng.integers(3)] = [np.inf, np.nan, -np.inf][side] if side else np.inf
        readings.append(row)
    return bm.Scans(poses, [-0.25, 0.02, 0.3], readings, max_range_m=2.0, min_range_m=0.15)


CASES = [
    ((1, 1), 0.05, bm.Beta(1.0, 1.0)), ((2, 1), 0.05, bm.Beta(0.5, 2.0)), ((1, 2), 0.4, bm.Beta(2.0, 0.5)),
    ((3, 1), 0.05, bm.Beta(1.0, 1.5)), ((2, 2), 0.1, bm.Beta(0.5, 0.5)), ((2, 2), 0.5, bm.Beta(1.5, 1.0)),
    ((4, 1), 0.03, bm.Beta(1.0, 2.0)),
]  # fmt: skip

SQUARE = scans_for((2, 2), [4, 1]), bm.Grid((2, 2), 0.5), bm.Beta(1.0, 1.0), sensor(0.1)


def exact_of(scans, grid, prior, law, hit_depth=0.5, beta=1.0):
    rays = build_worlds(scans, grid, prior, law, 1, hit_depth).problem.rays
    return exact_reflectivities(paths_of(rays, hit_depth=hit_depth), grid.n_cells, prior, law, beta)


def drawn(scans, grid, prior, law, sweeps, seed=11, hit_depth=0.5, beta=1.0):
    """Reflectivities of all copies after some sweeps, (COPIES, cells)."""
    worlds = copies(scans, grid, prior, law, COPIES, hit_depth)
    return worlds.sweep(worlds.sampler(seed), sweeps, beta)[worlds.cells(), 0].astype(float)


def p_values(m, exact):
    """Kolmogorov-Smirnov of every cell, and z-tests of all products of two."""
    out = [scipy.stats.kstest(m[:, i], exact.cdf(i)).pvalue for i in range(m.shape[1])]
    products = np.einsum("ni,nj->nij", m, m)
    z = (products.mean(axis=0) - exact.pairs()) / (products.std(axis=0) / np.sqrt(len(m)))
    return np.array([*out, *2 * scipy.stats.norm.sf(abs(z[np.triu_indices(m.shape[1])]))])


@pytest.mark.parametrize("case", full_but(CASES, CASES[0], CASES[2], CASES[6]), ids=str)
def test_draws_follow_the_exact_posterior(case):
    shape, sigma_m, prior = case
    grid, law = bm.Grid(shape, 0.5), sensor(sigma_m)
    scans = scans_for(shape, [sum(shape), 1])
    m = drawn(scans, grid, prior, law, 150)
    exact = exact_of(scans, grid, prior, law)
    assert p_values(m, exact).min() > ALPHA / TESTS
    assert abs(exact.mean() - prior.mean).max() > 0.05  # and the data say something


@pytest.mark.full
def test_the_prior_of_logs_too_and_cells_that_hold_their_reflectivity_for_most_of_a_round_follow_it(monkeypatch):
    """Beta(0.02, 0.2): compared where half of the mass lies below what single precision holds."""
    shape, prior, law = (2, 1), bm.Beta(), sensor(0.05)
    grid, scans = bm.Grid(shape, 0.5), scans_for(shape, 21)
    m = drawn(scans, grid, prior, law, 1200)
    exact = exact_of(scans, grid, prior, law)
    z = (m.mean(axis=0) - exact.mean()) / (m.std(axis=0) / np.sqrt(COPIES))
    assert abs(z).max() < scipy.stats.norm.isf(ALPHA / TESTS)
    for cell in range(2):
        for level in (1e-20, 1e-10, 1e-5, 1e-3, 0.1, 0.5, 0.9, 0.99):
            below = int((m[:, cell] < level).sum())
            assert scipy.stats.binomtest(below, COPIES, exact.cdf(cell)(level)[0]).pvalue > ALPHA / TESTS
    monkeypatch.setattr(initial_estimate, "MIN_PASSES", 0)
    scans, grid, prior, law = SQUARE
    m, exact = drawn(scans, grid, prior, law, 600), exact_of(scans, grid, prior, law)
    assert p_values(m, exact).min() > ALPHA / TESTS
    twin = exact_of(scans, grid, bm.Beta(1.0, 1.6), law)  # of another prior
    assert p_values(m, twin).min() < ALPHA / TESTS


def test_beams_along_lines_and_through_corners():
    """Several cells at the same distance: one after the other, as the beam table lists them."""
    scans = bm.Scans(
        [[0.5, -0.5, np.pi / 2], [-0.25, -0.25, np.pi / 4], [1.25, 0.5, np.pi]], [0.0],
        [[0.7], [1.05], [0.4]], max_range_m=2.0,
    )  # fmt: skip
    grid, prior, law = bm.Grid((2, 2), 0.5), bm.Beta(1.0, 1.0), sensor(0.1)
    exact = exact_of(scans, grid, prior, law, hit_depth=0.0)
    m = drawn(scans, grid, prior, law, 150, hit_depth=0.0)
    assert p_values(m, exact).min() > ALPHA / TESTS


@pytest.mark.parametrize("beta", full_but([0.0, 0.3, 0.7], 0.3))
def test_at_an_inverse_temperature_draws_follow_the_tempered_posterior(beta):
    scans, grid, prior, law = SQUARE
    m = drawn(scans, grid, prior, law, 150, beta=beta)
    assert p_values(m, exact_of(scans, grid, prior, law, beta=beta)).min() > ALPHA / TESTS
    assert p_values(m, exact_of(scans, grid, prior, law, beta=beta + 0.3)).min() < ALPHA / TESTS  # the twin


def test_wrong_twins_are_rejected():
    scans, grid, prior, law = SQUARE
    m = drawn(scans, grid, prior, law, 150)
    assert p_values(m, exact_of(scans, grid, prior, law)).min() > ALPHA / TESTS
    for other in (bm.Beta(1.15, 1.0), bm.Beta(1.0, 1.15)):
        assert p_values(m, exact_of(scans, grid, other, law)).min() < ALPHA / TESTS
    noisier = sensor(0.15)
    assert p_values(m, exact_of(scans, grid, prior, noisier)).min() < ALPHA / TESTS
    # passes of beams that never came: a beam counts all its cells
    paths = paths_of(build_worlds(scans, grid, prior, law, 1).problem.rays)
    late = Paths(*paths[:2], paths.plain_m + 0.1, *paths[3:])
    assert p_values(m, exact_reflectivities(late, 4, prior, law)).min() < ALPHA / TESTS
