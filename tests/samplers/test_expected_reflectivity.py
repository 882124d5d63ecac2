"""Expected reflectivities predict what drawn ones predict, the exact predictive law, with less noise.

Copies of a small world side by side are independent chains. The law is known: of reflectivities by enumerating all ways
in which the beams may stop, of surfaces by weighting draws from the prior. False alarms: `ALPHA` = 1e-4 over this
module.
"""

from functools import cache
from itertools import product

import numpy as np
import pytest
import scipy
from oracle.stop_law import draw_states, exact_reflectivities, log_likelihoods, paths_of
from oracle.stop_worlds import beam_rays, build_worlds, copies, touching
from oracle.verdict import ALPHA
from tiers import pairs_but

import bayesmap as bm
from bayesmap.cells.surface import PARTS
from bayesmap.samplers import stop_gibbs
from bayesmap.samplers.sampler import Keep

EDGE, COPIES, DRAWS, FROM_PRIOR = 0.5, 2000, 4, 100_000
TESTS = 200  # p-values in this module, at most
LIMIT = -scipy.special.ndtri(ALPHA / TESTS / 2)

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
"""Of the variance of a single draw's density, at most: a third, a half and three quarters were found."""

CASES = {
    "reflectivities": ((2, 2), bm.Beta(0.5, 1.5)),
    "rare walls": ((2, 2), bm.Beta(0.1, 0.6)),
    "surfaces": ((2, 1), bm.Surface(1.0, 1.5, mean_scale=0.3, spread=0.3, dof=5.0)),
}


@cache
def world_of(case):
    """Prior, whether cells have no surfaces, their centres, the paths of the held-out beams, the others' rays."""
    shape, prior = CASES[case]
    grid = bm.Grid(shape, EDGE)
    cell = np.arange(grid.n_cells)
    centres = np.stack([cell // shape[1] + 0.5, cell % shape[1] + 0.5], axis=-1) * EDGE
    # by the grid's numbers of cells, not by those of what these beams touch
    rays = touching(beam_rays(HELD_OUT, grid, whole=True), cell)
    held_out = paths_of(rays, far=False)
    return (
        prior,
        not isinstance(prior, bm.Surface),
        centres,
        held_out,
        build_worlds(SCANS, grid, prior, LAW, 1).problem.rays,
    )


def densities(case, states):
    """Of the held-out readings, (..., B), given states (..., cells, 6)."""
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
    """Densities of the held-out readings by every copy's draws, (COPIES, DRAWS, B): expected ones, and drawn ones."""
    prior, plain, centres, _, _ = world_of(case)
    worlds = copies(SCANS, bm.Grid(CASES[case][0], EDGE), prior, LAW, COPIES)
    sampler = stop_gibbs.StopGibbs()
    _, info = sampler.step(sampler.init(worlds.problem, [0], 7), 150 + DRAWS, keep=Keep(150, 1))
    states = np.zeros((COPIES, DRAWS, len(centres), 6))
    if not plain:
        assert worlds.problem.estimate.endpoint.all()
        for part, name in enumerate(PARTS, 1):
            states[..., part] = (
                np.moveaxis(info.draws[f"surface_{name}"][0][:, worlds.cells()], 0, 1).astype(float) * EDGE
            )
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
    return (of_copy.mean(axis=0) - mean) / np.hypot(of_copy.std(axis=0) / np.sqrt(COPIES), error)


@pytest.mark.parametrize("case", CASES)
def test_the_mean_density_is_the_exact_one_and_single_draws_say_more_of_it(case):
    expected, drawn = predicted(case)
    assert abs(z(case, expected)).max() < LIMIT
    assert abs(z(case, drawn)).max() < LIMIT
    # The two have the same mean, to within less than either knows the law,
    apart = (expected - drawn).mean(axis=1)
    assert abs(apart.mean(axis=0) / (apart.std(axis=0) / np.sqrt(COPIES))).max() < LIMIT
    # and of single draws the expected ones scatter less: over the copies, which are independent.
    share = expected[:, 0].var(axis=0) / drawn[:, 0].var(axis=0)
    assert share.max() < 0.98
    assert share.mean() < LEFT[case]


def without_b(hits, met, prior, drawn, solid=None):
    return (prior.a + hits) / (prior.a + hits + met + 1e-30)


def met_counted_twice(hits, met, prior, drawn, solid=None):
    return (prior.a + hits) / (prior.a + prior.b + hits + 2 * met)


@pytest.mark.parametrize(
    ("case", "twin"),
    pairs_but(
        product(CASES, [without_b, met_counted_twice]), ("reflectivities", without_b), ("rare walls", met_counted_twice)
    ),
)
def test_wrong_twins_are_rejected(case, twin, monkeypatch):
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
