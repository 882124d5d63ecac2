"""The prior of coupled walls: its density, its draws, and its coupling, which is found in maps and in scans of them.

Draws are compared with enumeration; false alarms: `ALPHA` = 1e-4 for all of these tests. Means of couplings are within
five of their errors: a false alarm in 200 000 for 60 maps, in 2000 for twelve; seeds are fixed.
"""

from functools import cache

import numpy as np
import pytest
from flat_options import infer
from oracle.enumeration import all_maps, log_prior_of_all, neighbours
from oracle.verdict import ALPHA, least_p_value
from oracle.worlds import make_case, random_prior
from tiers import full_but, latin, pairs_but

import bayesmap as bm
from bayesmap.app.sources import open_run
from bayesmap.cells.binary import MAX_FITTED_COUPLING, balance_map
from bayesmap.cells.ising_field import rough_draw
from bayesmap.model import Model
from bayesmap.samplers.fit import fit_coupling_to_scans
from bayesmap.samplers.walls import WallBlocks, WallGibbs

CASES = [(0.5, 0.4, (3, 4)), (0.2, 0.9, (4, 3)), (0.05, 1.5, (3, 3)), ("cells", 1.0, (3, 4)), (0.4, 2.0, (1, 7))]


def prior_of(p, coupling, shape):
    return bm.Ising(random_prior(np.random.default_rng(7), p, shape), coupling)


@pytest.mark.parametrize(("p", "coupling", "shape"), CASES)
def test_the_density_is_that_of_its_formula_up_to_a_constant(p, coupling, shape):
    prior, grid = prior_of(p, coupling, shape), bm.Grid(shape)
    mine = np.array([prior.log_prob(walls.reshape(shape), grid) for walls in all_maps(grid.n_cells)])
    expected = log_prior_of_all(shape, prior.p_wall, coupling)
    possible = np.isfinite(expected)
    assert (np.isfinite(mine) == possible).all()
    difference = mine[possible] - expected[possible]
    np.testing.assert_allclose(difference, difference[0], atol=1e-9)
    walls = all_maps(grid.n_cells)[np.argmax(mine)]
    alike = sum(walls[a] == walls[b] for a, b in neighbours(shape))
    apart = bm.Independent(prior.p_wall).log_prob(walls.reshape(shape), grid)
    assert mine.max() == pytest.approx(apart + coupling * alike)


@pytest.mark.parametrize(("p", "coupling", "shape"), pairs_but(CASES, CASES[1], CASES[2]))
def test_draws_are_exact(p, coupling, shape):
    prior, grid = prior_of(p, coupling, shape), bm.Grid(shape)
    law = np.exp(log_prior_of_all(shape, prior.p_wall, coupling))
    draws = prior.sample_maps(np.random.default_rng(1), grid, 8_000).reshape(-1, grid.n_cells)
    assert least_p_value(draws, law) > ALPHA / 12
    assert least_p_value(draws, np.exp(log_prior_of_all(shape, prior.p_wall))) < ALPHA / 12  # the twin
    single = np.stack([prior.sample(np.random.default_rng([2, i]), grid) for i in range(500)])
    assert least_p_value(single.reshape(-1, grid.n_cells), law) > ALPHA / 12
    if (p, coupling) == (0.05, 1.5):  # on a small map the 50 sweeps of a start are enough for any test
        starts = np.stack([prior.start(np.random.default_rng([3, i]), grid) for i in range(1_000)])
        assert least_p_value(starts.reshape(-1, 9), law) > ALPHA / 12
        none = np.stack([rough_draw(np.random.default_rng([4, i]), np.full(shape, np.log(p / (1 - p))), coupling, 0)
                         for i in range(1_000)])  # fmt: skip
        assert least_p_value(none.reshape(-1, 9), law) < ALPHA / 12  # the twin: without a sweep


def test_endless_draws_a_prior_without_coupling_and_programs_are_refused_with_the_remedy():
    with pytest.raises(bm.BadInput, match=r"at a coupling of 3 maps of 12 x 12 cells cannot be drawn exactly.*weaker"):
        bm.Ising(0.5, 3.0).sample(np.random.default_rng(1), bm.Grid((12, 12)))
    assert bm.Ising(0.5, 3.0).start(np.random.default_rng(1), bm.Grid((12, 12))).shape == (12, 12)
    with pytest.raises(bm.BadInput, match=r"give the coupling, too, .* as in bm\.Ising\(0\.3, 'fit'\)"):
        bm.Ising(0.3)
    pytest.importorskip("jax")
    with pytest.raises(bm.BadInput, match="mapping_model: the prior must be Independent, got Ising; use infer"):
        bm.mapping_model(bm.Grid((2, 2)), [0.5, 0.5, 0], [0.0], bm.Ising(0.5, 1.0), bm.Gaussian(0.1), max_range_m=5.0)


def test_the_mean_of_cells_is_not_p():
    """Among neighbours that are mostly free a wall is rarer than p: exactly, on 3 x 3 cells."""
    law = np.exp(log_prior_of_all((3, 3), 0.2, 0.5))
    mean = bm.Ising(0.2, 0.5).mean_stop(bm.Grid((3, 3)))
    assert abs(mean.ravel() - law @ all_maps(9)).max() < 5 * np.sqrt(0.2 * 0.8 / 200)
    assert mean.max() < 0.19


METHODS = [("gibbs", "radial", "prior"), ("gibbs", "random", "propagate"), ("block", "raster", "prior")]
METHODS += [(method, "radial", "propagate") for method in ("block", "propagate", "exact", "importance")]


@pytest.mark.parametrize(("method", "order", "start"), METHODS)
def test_at_a_coupling_of_zero_it_is_the_independent_prior_bit_for_bit(method, order, start):
    case = make_case(8, prior="cells", n_poses=2)
    options = {"sensor": case.sensor, "method": method, "order": order, "start": start, "draws": 40, "warmup": 5}
    one, other = (
        infer(case.scans, case.grid, prior=prior, chains=2, particles=500, **options)
        for prior in (case.prior, bm.Ising(case.prior.p_wall, 0.0))
    )
    np.testing.assert_array_equal(one.draws, other.draws)
    np.testing.assert_array_equal(one.log_joint, other.log_joint)
    np.testing.assert_array_equal(one.occupancy, other.occupancy)


@pytest.mark.parametrize(
    ("p", "method"),
    [(0.3, "gibbs"), ("cells", "block"), (0.3, "propagate"), ("cells", "exact"), ("cells", "importance")],
)
def test_runs_say_their_log_prior_and_come_back_from_files_and_go_on(p, method, tmp_path):
    case = make_case(9, prior=p, coupling=0.7, shape=(3, 4))
    options = {"prior": case.prior, "sensor": case.sensor, "method": method, "chains": 2, "draws": 30, "warmup": 5}
    run = infer(case.scans, case.grid, particles=3000, **options)
    plain = [[case.prior.log_prob(walls, case.grid) for walls in chain] for chain in run.draws]
    np.testing.assert_allclose(run.posterior.log_prior, plain, rtol=1e-9)
    run.save(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    assert isinstance(loaded.posterior.prior, bm.Ising)
    np.testing.assert_array_equal(loaded.posterior.prior.p_wall, case.prior.p_wall)
    assert (loaded.posterior.prior.coupling, loaded.posterior.kind) == (0.7, "binary")
    np.testing.assert_array_equal(loaded.draws, run.draws)
    if method in ("gibbs", "block"):
        part = []
        infer(case.scans, case.grid, **options, on_checkpoint=part.append, checkpoint_every_s=0.0)
        part[0].save(tmp_path / "part.nc")
        resumed = infer(case.scans, case.grid, **options, resume=bm.load(tmp_path / "part.nc"))
        np.testing.assert_array_equal(resumed.draws, run.draws)
        other = {**options, "prior": bm.Ising(case.prior.p_wall, 0.8), "resume": bm.load(tmp_path / "part.nc")}
        with pytest.raises(bm.BadInput, match=r"made with other prior \(.*'coupling': 0.7"):
            infer(case.scans, case.grid, **other)


def test_its_runs_are_scored_drawn_exported_and_opened_on_the_page(tmp_path):
    case = make_case(12, prior=0.3, coupling=0.6, shape=(4, 4))
    run = infer(case.scans, case.grid, prior=case.prior, sensor=case.sensor, chains=2, draws=30, warmup=5)
    assert np.isfinite(bm.score(run, case.scans).nats_per_beam)
    assert run.plot().axes
    assert all(path.stat().st_size > 0 for path in run.export(tmp_path / "map.yaml"))
    result = open_run(run, "run.nc").result
    assert result.prior is case.prior
    np.testing.assert_array_equal(result.estimate.mean(), run.occupancy)
    assert result.document.prior == 0.3


GRID = bm.Grid((40, 40), 0.25)
SENSOR = bm.BeamMixture(bm.Gaussian(0.03))
TRUTHS = [(0.3, 0.0), (0.3, 0.3), (0.3, 0.6), (0.4, 0.8)]


@pytest.mark.parametrize(("p", "coupling"), TRUTHS)
def test_known_maps_have_the_coupling_that_they_were_drawn_with(p, coupling):
    """60 maps each: the mean of their couplings lies within five of its errors of the truth; none is below 0."""
    maps = bm.Ising(p, coupling).sample_maps(np.random.default_rng([int(100 * coupling), 1]), GRID, 60)
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
        assert balance == balance_map(walls)[x, y]
        eta = np.log(p[x, y] / (1 - p[x, y])) + couplings * balance
        total += walls[x, y] * eta - np.log1p(np.exp(eta))
    assert bm.fit_coupling(walls, p) == pytest.approx(couplings[np.argmax(total)], abs=1e-3)


def test_maps_without_a_boundary_have_the_largest_scattered_ones_none_and_what_is_no_map_is_refused():
    assert bm.fit_coupling(np.zeros((20, 20)), 0.2) == MAX_FITTED_COUPLING
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
    stops = np.column_stack([(free[rng.choice(len(free), poses)] + 0.5) * GRID.resolution, rng.uniform(-3, 3, poses)])
    return walls, bm.simulate(walls, GRID, stops, np.linspace(-3, 3, 24), sensor=SENSOR, max_range_m=6.0, seed=seed)


@pytest.mark.parametrize(("truth", "sampler"), latin(2, TRUTHS[1:], [WallGibbs(), WallBlocks(order="random")]))
def test_scans_of_a_whole_map_give_the_coupling_of_that_map(truth, sampler):
    """300 scans leave next to nothing open: what is found is what the map itself says."""
    p, coupling = truth
    walls, scans = simulated(p, coupling, 300, 4)
    found = fit_coupling_to_scans(Model(scans, GRID, bm.Ising(p, "fit"), SENSOR), sampler, "cpu", seed=1)
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
    short = {"method": method, "chains": 1, "warmup": 2, "draws": 2, "particles": 50}
    run = infer(scans, GRID, prior=bm.Ising(0.3, "fit"), sensor="fit", **short)
    assert 0 < run.posterior.prior.coupling < 1.5
    assert {"sensor", "prior"} <= run.posterior.settings["fitted"].keys()
