"""Reflectivities on maps of one to four cells against the exact posterior: every way in which the beams may stop.

A few thousand copies of a map side by side are as many independent chains, so their states after some sweeps are
independent draws. Expected reflectivities predict what drawn ones predict, the exact predictive law, with less noise;
the law of surfaces is one of weighted draws from the prior. False alarms: `ALPHA` = 1e-4 for draws and predictions
each.
"""

from functools import cache
from itertools import product

import numpy as np
import pytest
import scipy
from oracle.stop_law import Paths, draw_states, exact_reflectivities, log_likelihoods, paths_of
from oracle.stop_worlds import beam_rays, build_worlds, copies, touching
from oracle.verdict import ALPHA
from tiers import full_but, pairs_but

import bayesmap as bm
from bayesmap.cells.surface import PARTS
from bayesmap.samplers import stop_gibbs, stop_problem
from bayesmap.samplers.sampler import Keep

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
    monkeypatch.setattr(stop_problem, "MIN_PASSES", 0)
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
    assert p_values(drawn(scans, grid, prior, law, 150, hit_depth=0.0), exact).min() > ALPHA / TESTS


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
    assert p_values(m, exact_of(scans, grid, prior, sensor(0.15))).min() < ALPHA / TESTS
    # passes of beams that never came: a beam counts all its cells
    paths = paths_of(build_worlds(scans, grid, prior, law, 1).problem.rays)
    late = Paths(*paths[:2], paths.plain_m + 0.1, *paths[3:])
    assert p_values(m, exact_reflectivities(late, 4, prior, law)).min() < ALPHA / TESTS


EDGE, MANY, DRAWS, FROM_PRIOR = 0.5, 2000, 4, 100_000
PREDICTION_TESTS = 200  # p-values in this module, at most
LIMIT = -scipy.special.ndtri(ALPHA / PREDICTION_TESTS / 2)

LAW = bm.BeamMixture(bm.Gaussian(0.1, 0.02), p_random=0.1, p_no_return=0.15, p_short=0.15, rate_short_per_m=0.8)
SCANS = bm.Scans(
    [[-0.4, 0.2, 0.05], [0.45, -0.5, 1.4], [1.3, 0.8, -2.6]], [-0.1, 0.15],
    [[0.65, 1.1], [np.inf, 0.72], [0.9, 0.5]], max_range_m=2.0, min_range_m=0.15,
)  # fmt: skip
HELD_OUT = bm.Scans(
    [[-0.3, 0.3, 0.0], [-0.2, 0.7, -0.5], [1.2, 0.1, 2.7]], [-0.2, 0.1],
    [[0.6, np.inf], [1.2, 0.9], [0.8, -np.inf]], max_range_m=2.0, min_range_m=0.15,
)  # fmt: skip
LEFT = {"reflectivities": 0.4, "rare walls": 0.65, "surfaces": 0.85}
"""The most that is left of the variance of a single draw's density; a third, a half and three quarters were found."""

PREDICTED = {
    "reflectivities": ((2, 2), bm.Beta(0.5, 1.5)),
    "rare walls": ((2, 2), bm.Beta(0.1, 0.6)),
    "surfaces": ((2, 1), bm.Surface(1.0, 1.5, mean_scale=0.3, spread=0.3, dof=5.0)),
}


@cache
def world_of(case):
    """Prior, whether cells have no surfaces, their centres, the paths of the held-out beams, the others' rays."""
    shape, prior = PREDICTED[case]
    grid = bm.Grid(shape, EDGE)
    cells = np.arange(grid.n_cells)
    # by the grid's numbers of cells, not by those of what these beams touch
    held_out = paths_of(touching(beam_rays(HELD_OUT, grid, whole=True), cells), far=False)
    rays = build_worlds(SCANS, grid, prior, LAW, 1).problem.rays
    return prior, not isinstance(prior, bm.Surface), grid.centers_from_corner_m(cells), held_out, rays


def densities(case, states):
    """Densities of the held-out readings, (..., B), given states (..., cells, 6)."""
    _, plain, _, held_out, _ = world_of(case)
    return np.exp(log_likelihoods(held_out, states, LAW, plain))


@cache
def exact(case):
    """The predictive density of each held-out reading, and its error, (B,) each."""
    prior, plain, centres, _, rays = world_of(case)
    if plain:
        law = exact_reflectivities(paths_of(rays), len(centres), prior, LAW)
        means = np.zeros((len(law.weight), len(centres), 6))
        means[..., 0] = law.a / (law.a + law.b)
        return law.weight @ densities(case, means), 0.0
    states = draw_states(np.random.default_rng(5), prior, (centres, EDGE), (FROM_PRIOR,))
    log_weight = log_likelihoods(paths_of(rays), states, LAW, False).sum(axis=-1)
    weight = np.exp(log_weight - log_weight.max())
    weight /= weight.sum()
    of_state = densities(case, states)
    mean = weight @ of_state
    return mean, np.sqrt(weight**2 @ (of_state - mean) ** 2)


def predicted(case):
    """Densities of the held-out readings by every copy's draws, (MANY, DRAWS, B): expected ones, and drawn ones."""
    prior, plain, centres, _, _ = world_of(case)
    worlds = copies(SCANS, bm.Grid(PREDICTED[case][0], EDGE), prior, LAW, MANY)
    sampler = stop_gibbs.StopGibbs()
    _, info = sampler.step(sampler.init(worlds.problem, [0], 7), 150 + DRAWS, keep=Keep(150, 1))
    states = np.zeros((MANY, DRAWS, len(centres), 6))
    if not plain:
        assert worlds.problem.estimate.endpoint.all()
        for part, name in enumerate(PARTS, 1):
            drawn = info.draws[f"surface_{name}"][0][:, worlds.cells()].astype(float)
            states[..., part] = np.moveaxis(drawn, 0, 1) * EDGE
        states[..., 1:3] += centres
    out = []
    for name in ("expected", "reflectivity"):
        states[..., 0] = np.moveaxis(info.draws[name][0][:, worlds.cells()], 0, 1)
        out.append(densities(case, states))
    return out


def z(case, found):
    """How many of its errors the mean density lies above the exact one, (B,)."""
    mean, error = exact(case)
    of_copy = found.mean(axis=1)
    return (of_copy.mean(axis=0) - mean) / np.hypot(of_copy.std(axis=0) / np.sqrt(MANY), error)


@pytest.mark.parametrize("case", PREDICTED)
def test_the_mean_density_is_the_exact_one_and_single_draws_say_more_of_it(case):
    expected, drawn = predicted(case)
    assert abs(z(case, expected)).max() < LIMIT
    assert abs(z(case, drawn)).max() < LIMIT
    # The two have the same mean, to within less than either knows the law,
    apart = (expected - drawn).mean(axis=1)
    assert abs(apart.mean(axis=0) / (apart.std(axis=0) / np.sqrt(MANY))).max() < LIMIT
    # and of single draws the expected ones scatter less: over the copies, which are independent.
    share = expected[:, 0].var(axis=0) / drawn[:, 0].var(axis=0)
    assert share.max() < 0.98
    assert share.mean() < LEFT[case]


def without_b(hits, met, prior, drawn, solid=None):
    return (prior.a + hits) / (prior.a + hits + met + 1e-30)


def met_counted_twice(hits, met, prior, drawn, solid=None):
    return (prior.a + hits) / (prior.a + prior.b + hits + 2 * met)


KEPT = ("reflectivities", without_b), ("rare walls", met_counted_twice)


@pytest.mark.parametrize(("case", "twin"), pairs_but(product(PREDICTED, [without_b, met_counted_twice]), *KEPT))
def test_wrong_expectations_are_rejected(case, twin, monkeypatch):
    monkeypatch.setattr(stop_gibbs, "expected_reflectivity", twin)
    expected, _ = predicted(case)
    assert abs(z(case, expected)).max() > LIMIT


def test_a_cell_is_never_expected_to_stop_every_beam_and_is_as_drawn_until_it_has_counted():
    """Half precision would round the mean to 1, and nothing behind the cell could be seen ever after."""
    hits, met = np.array([10**6, 3, 0, 5, 0], dtype=np.int32), np.array([0, 1, 10**6, -1, -1], dtype=np.int32)
    drawn = np.array([0, 0, 0, 1, 0.5], dtype=np.float16)
    found = stop_gibbs.expected_reflectivity(hits, met, bm.Beta(0.25, 0.75), drawn).astype(np.float16)
    assert found[0] == found[3] == np.nextafter(np.float16(1), np.float16(0))
    assert found[1] == np.float16(3.25 / 5)
    assert 0 < found[2] < 1e-6
    assert found[4] == 0.5
