"""R-hat and effective sample sizes are arviz's; summaries name problems, those of poses have the draws' moments."""

from dataclasses import replace

import numpy as np
import pytest
from flat_options import infer
from hypothesis import given, settings
from hypothesis import strategies as st

import bayesmap as bm
from bayesmap.cells.arrays import Draws, pack
from bayesmap.posterior import summary
from bayesmap.posterior.summary import bulk_ess, diagnose_cells, rhat, summarise_poses, tail_ess


def arviz(what, values, **options):
    """Arviz is imported here, for it takes its time; where a half chain is constant it divides by nothing."""
    from arviz_stats.base import array_stats

    with np.errstate(all="ignore"):
        return float(getattr(array_stats, what)(values, **options))


def series(seed, chains, draws, kind):
    """Autocorrelated, antithetic, trending, heavy-tailed, whole-numbered or stuck draws."""
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal((chains, draws))
    if kind == "heavy":
        return rng.standard_cauchy((chains, draws))
    if kind == "whole":
        return rng.poisson(3.0, (chains, draws)).astype(float)
    if kind == "apart":
        return noise + 3.0 * np.arange(chains)[:, None]
    if kind == "trend":
        return noise + np.linspace(0, 4, draws)
    rho = {"slow": 0.9, "fast": -0.8, "white": 0.0}[kind]
    values = noise.copy()
    for i in range(1, draws):
        values[:, i] = rho * values[:, i - 1] + noise[:, i]
    return values


KINDS = ["slow", "fast", "white", "heavy", "whole", "apart", "trend"]


@settings(max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(1, 5), st.integers(4, 120), st.sampled_from(KINDS))
def test_scalars_have_arviz_s_r_hat_and_effective_sample_sizes(seed, chains, draws, kind):
    values = series(seed, chains, draws, kind)
    if chains > 1:  # arviz gives none for one chain, where the halves of that chain could be compared
        assert rhat(values) == pytest.approx(arviz("rhat", values), rel=1e-9)
    assert bulk_ess(values) == pytest.approx(arviz("ess", values, method="bulk"), rel=1e-9)
    assert tail_ess(values) == pytest.approx(arviz("ess", values, method="tail", prob=(0.05, 0.95)), rel=1e-9)


def diagnose(walls, among=None):
    prior, shape = bm.Independent(0.5), walls.shape[2:]
    draws = Draws(bm.Grid(shape), prior.arrays, {"walls": pack(walls)})
    return diagnose_cells(prior, draws, np.ones(shape, dtype=bool) if among is None else among)


def walls_of(seed, chains, draws, shape=(5, 4)):
    """Cells that flip at every rate, some that never change, and some that differ between chains alone."""
    rng = np.random.default_rng(seed)
    stay = rng.uniform(0, 0.98, shape)
    walls = np.zeros((chains, draws, *shape), dtype=bool)
    walls[:, 0] = rng.random((chains, *shape)) < 0.5
    for i in range(1, draws):
        redrawn = rng.random((chains, *shape)) < 0.4
        walls[:, i] = np.where(rng.random((chains, *shape)) < stay, walls[:, i - 1], redrawn)
    walls[:, :, 0, 0] = True
    walls[:, :, 1, 1] = False
    walls[:, :, 2, 2] = (np.arange(chains) % 2 == 0)[:, None]
    return walls


@pytest.mark.parametrize(("chains", "draws"), [(4, 100), (2, 51), (1, 40), (8, 4), (3, 9)])
@pytest.mark.parametrize("seed", range(3))
def test_the_worst_cell_is_the_one_that_arviz_finds(seed, chains, draws, monkeypatch):
    monkeypatch.setattr(summary, "BATCH_CELLS", 7)  # several batches
    walls = walls_of(seed, chains, draws)
    found = diagnose(walls)
    flat = walls.reshape(chains, draws, -1).astype(float)
    within = (flat != flat[:, :1]).any(axis=(0, 1))
    rhats = [arviz("rhat", flat[:, :, c]) for c in np.flatnonzero(within)]
    sizes = [arviz("ess", flat[:, :, c], method="bulk") for c in np.flatnonzero(within)]
    # arviz folds about the median too; of a 0/1 quantity that is constant or the same again
    if chains > 1:
        assert found.rhat_max == pytest.approx(np.nanmax(rhats), rel=1e-9)
    assert found.ess_min == pytest.approx(np.nanmin(sizes), rel=1e-9)
    assert found.ess_low_cells == (np.array(sizes) < summary.ESS_LIMIT).sum()
    assert found.judged_cells == len(sizes) + found.disagreeing_cells
    constant = ~within
    same = (flat == flat[:1, :1]).all(axis=(0, 1))
    assert found.unchanged_cells == same.sum() >= 2
    assert found.disagreeing_cells == (constant & ~same).sum()
    assert found.disagreeing_cells >= (chains > 1)


def test_cells_can_be_left_out_and_one_chain_is_compared_with_itself():
    walls = walls_of(1, 4, 100)
    among = np.zeros((5, 4), dtype=bool)
    among[3, 2] = True
    alone = diagnose(walls, among)
    values = walls[:, :, 3, 2].astype(float)
    assert alone.rhat_max == pytest.approx(arviz("rhat", values), rel=1e-9)
    assert alone.ess_min == pytest.approx(arviz("ess", values, method="bulk"), rel=1e-9)
    assert rhat(series(1, 2, 50, "apart").reshape(1, 100)) > 2
    assert rhat(series(1, 1, 1000, "white")) < 1.05


def test_too_few_draws_constant_maps_and_a_cell_that_changes_in_the_middle_draw_alone_have_no_diagnostics():
    """The halves of an odd number of draws leave the middle one out: both are constant then."""
    for count in (5, 7):
        walls = np.zeros((2, count, 3, 3), dtype=bool)
        walls[:, count // 2, 1, 1] = True
        assert np.isnan(diagnose(walls).rhat_max)
    for count in range(4):
        assert count == 0 or np.isnan(summarise_poses(draws(2, count=count)[0]).rhat).all()
        found, values = diagnose(np.zeros((2, count, 3, 3), bool)), np.random.default_rng(1).normal(size=(2, count))
        assert np.isnan([found.rhat_max, found.ess_min, rhat(values), bulk_ess(values), tail_ess(values)]).all()
    found = diagnose(np.ones((3, 50, 4, 4), dtype=bool))
    assert (found.unchanged_cells, found.disagreeing_cells) == (16, 0)
    assert np.isnan(found.rhat_max)


def run_of(method, **options):
    grid, noisy = bm.Grid((4, 3)), bm.Gaussian(2.0)
    scans = bm.simulate(np.eye(4, 3), grid, [2.5, 1.5, 0.0], np.linspace(0, 6, 20), sensor=noisy, max_range_m=5.0)
    return infer(scans, grid, prior=bm.Independent(0.3), sensor=noisy, method=method, **options)


def test_a_sound_run_has_no_problems_a_collapsed_one_and_one_too_short_to_judge_say_so():
    summary = run_of("gibbs", draws=4000).summary()
    assert summary.problems() == []
    good, *figures = str(summary).splitlines()
    assert good.startswith("good: the mean map is known to 0.0")
    assert "importance" not in str(summary)  # which chains do not have
    assert [line.split(":")[0] for line in figures[:4]] == [
        "good", "R-hat", "effective sample size of the log joint", "observed cells that changed",
    ]  # fmt: skip
    assert "R-hat compares chains with one another" in str(summary)
    summary = run_of("importance", particles=3, draws=10).summary()
    assert summary.effective_sample_size <= 3
    assert any("importance" in problem for problem in summary.problems())
    assert str(summary).startswith("doubtful: importance sampling has an effective sample size of ")
    assert "use 'gibbs'" in str(summary)
    summary = run_of("gibbs", draws=20, precision=0.01).summary()
    assert any("of 100 observed cells, which is good up to 0.015: " in problem for problem in summary.problems())
    told = replace(summary, map_error=0.014).strengths()[0]
    assert told.endswith("is known to 0.014 in 99 of 100 observed cells (good up to 0.015); 0.01 takes more draws")
    assert summary.as_json()["effective_sample_size"] is None


def draws(seed, chains=4, count=500, yaw=3.1):
    rng = np.random.default_rng(seed)
    covariance = np.array([[0.04, 0.01, 0.0], [0.01, 0.02, 0.005], [0.0, 0.005, 0.03]])
    noise = rng.standard_normal((chains, count, 2, 3)) @ np.linalg.cholesky(covariance).T
    poses = np.array([[1.0, 2.0, yaw], [-1.0, 0.0, 0.5]]) + noise
    poses[..., 2] = (poses[..., 2] + np.pi) % (2 * np.pi) - np.pi
    return poses, covariance


def test_moments_are_those_that_the_draws_come_from_and_chains_that_disagree_have_a_large_r_hat():
    poses, covariance = draws(0)
    found = summarise_poses(poses)
    assert abs((found.mean[0, 2] - 3.1 + np.pi) % (2 * np.pi) - np.pi) < 0.02
    np.testing.assert_allclose(found.mean[:, :2], [[1.0, 2.0], [-1.0, 0.0]], atol=0.025)
    np.testing.assert_allclose(found.covariance, [covariance, covariance], atol=0.005)
    np.testing.assert_allclose(found.sigma_m**2, np.linalg.eigvalsh(covariance[:2, :2])[1], rtol=0.1)
    assert (found.rhat < 1.02).all()
    assert (found.ess > 1000).all()
    poses, _ = draws(1)
    poses[0, :, 1, 0] += 3.0
    found = summarise_poses(poses)
    assert found.rhat[1, 0] > 1.5
    assert found.rhat[0, 0] < 1.02
