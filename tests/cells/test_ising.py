"""The prior of coupled walls: its density, its draws, and what it is at a coupling of zero.

Draws are compared with enumeration. False alarms: `ALPHA` = 1e-4 for the whole file.
"""

import numpy as np
import pytest
from flat_options import infer
from oracle.enumeration import all_maps, log_prior_of_all, neighbours
from oracle.verdict import ALPHA, least_p_value
from oracle.worlds import make_case, random_prior
from tiers import pairs_but

import bayesmap as bm
from bayesmap.app.sources import opened_run
from bayesmap.cells.ising_field import rough_draw

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
    apart = np.exp(log_prior_of_all(shape, prior.p_wall))
    assert least_p_value(draws, apart) < ALPHA / 12  # the twin
    single = np.stack([prior.sample(np.random.default_rng([2, i]), grid) for i in range(500)])
    assert least_p_value(single.reshape(-1, grid.n_cells), law) > ALPHA / 12


@pytest.mark.full
def test_starts_are_like_draws():
    """On a small map 50 sweeps are enough for any test."""
    prior, shape = bm.Ising(0.3, 0.6), (3, 3)
    starts = np.stack([prior.start(np.random.default_rng([3, i]), bm.Grid(shape)) for i in range(2_000)])
    law = np.exp(log_prior_of_all(shape, 0.3, 0.6))
    assert least_p_value(starts.reshape(-1, 9), law) > ALPHA / 12
    logit = np.full(shape, np.log(0.3 / 0.7))
    none = np.stack([rough_draw(np.random.default_rng([4, i]), logit, 0.6, 0) for i in range(2_000)])
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
    result = opened_run(run, "run.nc").result
    assert result.prior is case.prior
    np.testing.assert_array_equal(result.found.mean(), run.occupancy)
    assert result.document.prior == 0.3
