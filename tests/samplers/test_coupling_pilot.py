"""The coupling is found again in maps that were drawn with it, and in scans of such maps.

Means are within five of their errors: a false alarm in 200 000 for 60 maps, in 2000 for twelve; seeds are fixed.
"""

from functools import cache

import numpy as np
import pytest
from flat_options import infer
from tiers import full_but, latin

import bayesmap as bm
from bayesmap.cells.binary import LARGEST_FITTED, walls_less_free
from bayesmap.model import Model
from bayesmap.samplers.fit import fit_coupling_to_scans
from bayesmap.samplers.walls import WallBlocks, WallGibbs

GRID = bm.Grid((40, 40), 0.25)
SENSOR = bm.BeamMixture(bm.Gaussian(0.03))
TRUTHS = [(0.3, 0.0), (0.3, 0.3), (0.3, 0.6), (0.4, 0.8)]


@pytest.mark.parametrize(("p", "coupling"), TRUTHS)
def test_known_maps_have_the_coupling_that_they_were_drawn_with(p, coupling):
    """60 maps each: the mean of their couplings lies within five of its errors of the truth; none is below 0."""
    rng = np.random.default_rng([int(100 * coupling), 1])
    maps = bm.Ising(p, coupling).sample_maps(rng, GRID, 60)
    found = np.array([bm.fit_coupling(walls, p) for walls in maps])
    error = found.std() / np.sqrt(len(found))
    if coupling:
        assert abs(found.mean() - coupling) < 5 * error
        assert error < 0.01
    assert abs(bm.fit_coupling(maps, p) - coupling) < max(5 * error, 0.01)
    assert abs(bm.fit_coupling(maps, p + 0.1) - coupling) > 0.02  # the twin: another p is another coupling


def test_it_is_the_greatest_pseudo_likelihood():
    """Against a fine grid of couplings, written down cell by cell; with a probability for each cell, some fixed."""
    rng = np.random.default_rng(2)
    p = rng.uniform(0.1, 0.6, (9, 7))
    p[2, 3], p[5, 5] = 0.0, 1.0
    walls = bm.Ising(p, 0.7).sample(rng, bm.Grid(p.shape))
    couplings = np.linspace(0, 3, 3001)
    total = np.zeros(len(couplings))
    for x, y in np.argwhere((p > 0) & (p < 1)):
        around = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)]
        balance = sum(1 if walls[i, j] else -1 for i, j in around if 0 <= i < 9 and 0 <= j < 7)
        assert balance == walls_less_free(walls)[x, y]
        eta = np.log(p[x, y] / (1 - p[x, y])) + couplings * balance
        total += walls[x, y] * eta - np.log1p(np.exp(eta))
    assert bm.fit_coupling(walls, p) == pytest.approx(couplings[np.argmax(total)], abs=1e-3)


def test_maps_without_a_boundary_have_the_largest_scattered_ones_none_and_what_is_no_map_is_refused():
    assert bm.fit_coupling(np.zeros((20, 20)), 0.2) == LARGEST_FITTED
    assert bm.fit_coupling(np.indices((20, 20)).sum(axis=0) % 2, 0.5) == 0.0
    for arguments, message in (
        ((np.zeros(3), 0.5), r"walls must be a map \(nx, ny\), or several .* got shape \(3,\)"),
        ((np.zeros((3, 3)), np.full((2, 3), 0.5)), r"p_wall has shape \(2, 3\), but the maps are \(3, 3\)"),
        ((np.zeros((3, 3)), 1.5), "p_wall must lie in"),
    ):
        with pytest.raises(bm.BadInput, match=message):
            bm.fit_coupling(*arguments)


@cache
def simulated(p, coupling, poses, seed):
    rng = np.random.default_rng([seed, 3])
    walls = bm.Ising(p, coupling).sample(rng, GRID)
    free = np.argwhere(~walls)
    at = (free[rng.choice(len(free), poses)] + 0.5) * GRID.resolution
    stops = np.column_stack([at, rng.uniform(-3, 3, poses)])
    return walls, bm.simulate(walls, GRID, stops, np.linspace(-3, 3, 24), sensor=SENSOR, max_range_m=6.0, seed=seed)


@pytest.mark.parametrize(("truth", "sampler"), latin(2, TRUTHS[1:], [WallGibbs(), WallBlocks(order="random")]))
def test_scans_of_a_whole_map_give_the_coupling_of_that_map(truth, sampler):
    """300 scans leave next to nothing open: what is found is what the map itself says."""
    p, coupling = truth
    walls, scans = simulated(p, coupling, 300, 4)
    model = Model(scans, GRID, bm.Ising(p, "fit"), SENSOR)
    found = fit_coupling_to_scans(model, sampler, "cpu", seed=1)
    assert (found.p_wall, found.coupling) == (p, pytest.approx(bm.fit_coupling(walls, p), abs=0.03))


@pytest.mark.parametrize("truth", full_but(TRUTHS[1:], TRUTHS[2]))
def test_few_scans_give_it_without_bias(truth):
    """Eight scans of each of twelve maps, which see a part of them: the mean within five errors, and 0.15."""
    p, coupling = truth
    found = []
    for seed in range(12):
        _, scans = simulated(p, coupling, 8, seed)
        model = Model(scans, GRID, bm.Ising(p, "fit"), SENSOR)
        found.append(fit_coupling_to_scans(model, WallGibbs(), "cpu", seed=seed).coupling)
    error = np.std(found) / np.sqrt(len(found))
    assert abs(np.mean(found) - coupling) < min(5 * error, 0.15)


def test_infer_fits_it_before_the_chains_and_says_what_it_found(tmp_path):
    walls, scans = simulated(0.3, 0.6, 300, 4)
    options = {"prior": bm.Ising(0.3, "fit"), "sensor": SENSOR, "warmup": 5, "draws": 5, "seed": 1}
    stops = []
    run = infer(scans, GRID, chains=2, **options, on_checkpoint=stops.append, checkpoint_every_s=0.0)
    prior = run.posterior.prior
    assert run.posterior.settings["prior"]["coupling"] == "fit"
    assert run.posterior.settings["fitted"]["prior"] == prior.describe()
    assert prior.coupling == pytest.approx(bm.fit_coupling(walls, 0.3), abs=0.03)
    given = infer(scans, GRID, chains=2, **{**options, "prior": bm.Ising(0.3, prior.coupling)})
    np.testing.assert_array_equal(run.draws, given.draws)
    np.testing.assert_array_equal(infer(scans, GRID, chains=1, **options).draws, run.draws[:1])
    run.save(tmp_path / "run.nc")
    assert bm.load(tmp_path / "run.nc").posterior.prior.coupling == prior.coupling
    stops[0].save(tmp_path / "part.nc")
    resumed = infer(scans, GRID, chains=2, **options, resume=bm.load(tmp_path / "part.nc"))
    np.testing.assert_array_equal(resumed.draws, run.draws)


@pytest.mark.parametrize("method", full_but(["block", "propagate", "importance"], "block"))
def test_every_method_takes_a_coupling_that_is_to_be_fitted(method):
    _, scans = simulated(0.3, 0.6, 8, 0)
    run = infer(
        scans, GRID, prior=bm.Ising(0.3, "fit"), sensor="fit", method=method, chains=1, warmup=2, draws=2, particles=50
    )
    assert 0 < run.posterior.prior.coupling < 1.5
    assert {"sensor", "prior"} <= run.posterior.settings["fitted"].keys()
