"""Labels of cells: the prior's density and draws, what a run with labels predicts and shows, and what it saves.

False alarms: `ALPHA` = 1e-4 over this module.
"""

from dataclasses import replace

import numpy as np
import pytest
import scipy
import warp as wp
from oracle.enumeration import all_maps, log_prior_of_all
from oracle.verdict import ALPHA, least_p_value
from samplers.stop_rooms import GRID, LABELLED, TRUTH, assert_same, infer, scans

import bayesmap as bm
from bayesmap.cells.kinds import prior_from
from bayesmap.kernels.surfaces.cell_draws import log_gamma
from bayesmap.run import runner
from bayesmap.samplers.fit import refit_prior
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import trace_stops

TESTS = 50  # p-values in this module, at most
PRIOR = bm.Beta(0.3, 2.0, coupling=0.8, a_solid=2.0, b_solid=0.7)
KINDS = pytest.mark.parametrize("kind", LABELLED)


def test_the_density_is_that_of_its_formula_up_to_a_constant():
    shape, rng = (3, 2), np.random.default_rng(2)
    expected, found = log_prior_of_all(shape, 0.5, PRIOR.coupling), []
    for solid in all_maps(6).reshape(-1, *shape):
        m = rng.uniform(0.1, 0.9, shape)
        a, b = np.where(solid, 2.0, 0.3), np.where(solid, 0.7, 2.0)
        of_m = (scipy.stats.beta.logpdf(m, a, b) + np.log(m * (1 - m))).sum()  # of the log odds
        found.append(PRIOR.log_prob({"reflectivity": m, "solid": solid}, bm.Grid(shape)) - of_m)
    np.testing.assert_allclose(np.array(found) - found[0], expected - expected[0], atol=1e-9)


def test_draws_are_exact():
    shape, rng = (2, 2), np.random.default_rng(3)
    drawn = [PRIOR.sample_cells(rng, bm.Grid(shape)) for _ in range(800)]
    solid = np.stack([one["solid"].ravel() for one in drawn])
    m = np.stack([one["reflectivity"].ravel() for one in drawn])
    law = np.exp(log_prior_of_all(shape, 0.5, PRIOR.coupling))
    assert least_p_value(solid, law) > ALPHA / TESTS
    assert least_p_value(solid, np.exp(log_prior_of_all(shape, 0.5, 0.0))) < ALPHA / TESTS
    assert scipy.stats.kstest(m[solid], scipy.stats.beta(2.0, 0.7).cdf).pvalue > ALPHA / TESTS
    assert scipy.stats.kstest(m[~solid], scipy.stats.beta(0.3, 2.0).cdf).pvalue > ALPHA / TESTS
    assert scipy.stats.ttest_1samp(m.mean(axis=1), PRIOR.mean).pvalue > ALPHA / TESTS
    assert PRIOR.mean_stop(bm.Grid(shape))[0, 0] == PRIOR.mean


@wp.kernel
def many_log_gammas(x: wp.array(dtype=wp.float64), out: wp.array(dtype=wp.float64)):
    out[wp.tid()] = log_gamma(x[wp.tid()])


def test_descriptions_give_the_prior_back_and_the_kernel_s_log_gamma_is_right():
    for prior in (*LABELLED.values(), bm.Surface(0.01, 0.3, coupling=0.7, a_solid=1.5, b_solid=0.5, dof=4.0)):
        assert prior_from(prior.describe()) == prior
        assert "solid" in {spec.name for spec in prior.arrays}
    assert set(bm.Beta().describe()) == {"kind", "a", "b"}
    assert set(bm.Surface().describe()) == {"kind", "a", "b", "mean_scale", "spread", "dof", "size_scale"}
    assert "solid" not in {spec.name for spec in bm.Surface().arrays}
    assert not replace(bm.Surface(coupling=1.0), coupling=0.0).has_labels
    x = np.concatenate([np.geomspace(1e-4, 1e7, 4000), [1.0, 2.0, 9.999999, 10.0]])
    out = wp.zeros(len(x), dtype=wp.float64, device="cpu")
    wp.launch(many_log_gammas, dim=len(x), inputs=[wp.array(x, dtype=wp.float64, device="cpu"), out], device="cpu")
    np.testing.assert_allclose(out.numpy(), scipy.special.gammaln(x), rtol=1e-13, atol=1e-12)


@pytest.fixture(autouse=True)
def _short_steps(monkeypatch):
    """A sweep a step, so that runs can be stopped anywhere."""
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)


@KINDS
def test_saved_loaded_and_resumed_bit_for_bit(kind, tmp_path):
    stops = []
    whole = infer(kind, on_checkpoint=stops.append, checkpoint_every_s=0.0)
    whole.save(tmp_path / "whole.nc")
    assert_same(bm.load(tmp_path / "whole.nc"), whole)
    stops[8].save(tmp_path / "part.nc")
    assert_same(infer(kind, resume=bm.load(tmp_path / "part.nc")), whole)
    other = replace(LABELLED[kind], coupling=0.5)
    with pytest.raises(bm.BadInput, match="made with other prior"):
        infer(kind, prior=other, resume=bm.load(tmp_path / "part.nc"))


@KINDS
def test_unknown_poses_go_with_labels_bit_for_bit(kind, tmp_path):
    options = {"poses": bm.UncertainPoses(0.02, 0.01), "sensor": TRUTH, "warmup": 10, "draws": 6}
    stops = []
    whole = infer(kind, scans(poses=8), on_checkpoint=stops.append, checkpoint_every_s=0.0, **options)
    assert_same(infer(kind, scans(poses=8), threads=3, **options), whole)
    for number in (4, 6):
        stops[number].save(tmp_path / "part.nc")
        assert_same(infer(kind, scans(poses=8), resume=bm.load(tmp_path / "part.nc"), **options), whole)


def test_cells_that_no_beam_touches_draw_reflectivities_given_their_labels_where_poses_move():
    prior = bm.Beta(0.5, 1.5, coupling=0.6, a_solid=3.0, b_solid=0.8)
    one = bm.Scans([0.5, 0.5, 0.0], [0.0], [[0.8]], max_range_m=2.0)
    problem = trace_stops(one, bm.Grid((60, 60), 0.2), prior, TRUTH, threads=1)
    sampler = StopGibbs()
    state, _ = sampler.step(sampler.init(problem, range(2), 4), 10)
    before = [state.chains.solid(chain).copy() for chain in range(2)]
    m, solid = sampler.present_cells(state), np.stack(before)
    np.testing.assert_array_equal(solid, [state.chains.solid(chain) for chain in range(2)])
    away = ~problem.touched().ravel()
    assert scipy.stats.kstest(m[:, away][solid[:, away]], scipy.stats.beta(3.0, 0.8).cdf).pvalue > ALPHA / TESTS
    assert scipy.stats.kstest(m[:, away][~solid[:, away]], scipy.stats.beta(0.5, 1.5).cdf).pvalue > ALPHA / TESTS
    np.testing.assert_array_equal(sampler.present_cells(state), m)  # the same sweep, the same numbers
    state, _ = sampler.step(state, 1)
    assert (sampler.present_cells(state)[:, away] != m[:, away]).mean() > 0.99


@KINDS
def test_maps_and_predictions_of_cells_that_no_beam_touches_follow_their_labels(kind):
    few = scans(poses=4, beams=12)
    run = infer(kind, few, sensor=TRUTH, draws=20)
    draws, prior = run.posterior.draws, LABELLED[kind]
    solid = draws.values("solid")
    assert solid.shape == (2, 20, *GRID.shape)
    away = ~run.posterior.draws.to_grid(np.ones(len(draws.index["cell"]), bool), "cell", 0.0).astype(bool)
    means = np.where(solid, prior.a_solid / (prior.a_solid + prior.b_solid), prior.a / (prior.a + prior.b))
    np.testing.assert_allclose(run.occupancy[away], means.mean(axis=(0, 1))[away], rtol=1e-6)
    np.testing.assert_allclose(prior.map_of(draws, 1, 3)[away], means[1, 3][away], rtol=1e-6)
    predicted = np.concatenate(list(prior.predictive_stops(draws)))
    m = predicted if predicted.ndim == 2 else predicted[..., 0]
    np.testing.assert_allclose(m[:, away.ravel()], means.reshape(40, -1)[:, away.ravel()], rtol=1e-6)
    some = np.flatnonzero(away)[::7].astype(np.int32)
    np.testing.assert_array_equal(np.concatenate(list(prior.predictive_stops(draws, some))), predicted[:, some])
    # Drawn ones are Betas by the label.
    drawn = np.concatenate(list(prior.drawn_stops(draws)))
    m = drawn if drawn.ndim == 2 else drawn[..., 0]
    for which, law in ((True, (prior.a_solid, prior.b_solid)), (False, (prior.a, prior.b))):
        of_label = m[:, away.ravel()][(solid == which).reshape(40, -1)[:, away.ravel()]]
        assert abs(of_label.mean() - law[0] / sum(law)) < 0.02
    lower, upper = run.interval(0.8)
    for x, y in np.argwhere(away)[::50]:
        share = solid[:, :, x, y].mean()
        for end, tail in ((lower[x, y], 0.1), (upper[x, y], 0.9)):
            below = (1 - share) * scipy.stats.beta.cdf(end, prior.a, prior.b)
            below += share * scipy.stats.beta.cdf(end, prior.a_solid, prior.b_solid)
            assert below == pytest.approx(tail, abs=1e-6) or end < 1e-15


def test_the_fit_finds_both_betas():
    """40 000 cells with known labels: within a tenth; labels that are mixed up it does not."""
    rng = np.random.default_rng(8)
    solid = rng.random(40_000) < 0.3
    truth = bm.Beta(0.1, 4.0, coupling=1.0, a_solid=2.0, b_solid=0.5)
    m = rng.beta(*truth.beta_given(solid))
    met = rng.integers(1, 60, len(m))
    hits = rng.binomial(met, m)

    def fitted(given):
        prior = bm.Beta(coupling=1.0)
        for _ in range(3):
            prior = refit_prior(prior, hits.astype(np.int32), (met - hits).astype(np.int32), 1.0, given)
        return np.array([prior.a, prior.b, prior.a_solid, prior.b_solid])

    np.testing.assert_allclose(fitted(solid), [0.1, 4.0, 2.0, 0.5], rtol=0.1)
    assert (abs(fitted(rng.permutation(solid)) / [0.1, 4.0, 2.0, 0.5] - 1) > 0.1).any()
    assert refit_prior(truth, hits, met - hits, 1.0, solid).coupling == 1.0


def test_proposals_of_the_prior_keep_it():
    """The log ratio that comes with a proposal is that of two maps' densities less that of proposing the one or the
    other.
    """
    shape, rng = (3, 2), np.random.default_rng(6)
    cells, one = PRIOR.sample_cells(rng, bm.Grid(shape)), bm.Grid((1, 1))
    changed = 0
    for site in np.ndindex(shape):
        for _ in range(6):
            proposal, log_ratio = PRIOR.propose(cells, site, rng, bm.Grid(shape))
            before = {name: values[site].reshape(1, 1) for name, values in cells.items()}
            after = {name: values.copy() for name, values in cells.items()}
            for name, value in proposal.items():
                after[name][site] = value
            alone = PRIOR.log_prob({n: np.reshape(v, (1, 1)) for n, v in proposal.items()}, one)
            expected = PRIOR.log_prob(after, bm.Grid(shape)) - PRIOR.log_prob(cells, bm.Grid(shape))
            assert log_ratio == pytest.approx(expected - alone + PRIOR.log_prob(before, one), abs=1e-9)
            changed += abs(log_ratio) > 0
    assert changed > 5
