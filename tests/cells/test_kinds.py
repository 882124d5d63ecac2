"""Kinds of cells: refusals, descriptions, draws, labels (false alarms: `ALPHA` = 1e-4); eight cells to a byte."""

from dataclasses import replace

import numpy as np
import pytest
import scipy
import warp as wp
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from oracle.enumeration import all_maps, log_prior_of_all
from oracle.verdict import ALPHA, least_p_value
from samplers.stop_rooms import GRID, LABELLED, TRUTH, assert_same, infer, scans

import bayesmap as bm
from bayesmap.cells import arrays as cell_arrays
from bayesmap.cells.arrays import as_halves, count_walls, pack, unpack
from bayesmap.cells.kinds import prior_from
from bayesmap.cells.reflectivity import recover_counts
from bayesmap.io.ros.maps import read_map
from bayesmap.kernels.random import log_gamma
from bayesmap.run import runner
from bayesmap.samplers.fit import refit_prior
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import trace_stops

PRIORS = [bm.Beta(), bm.Beta(0.5, 3.0), bm.Surface(), bm.Surface(0.1, 2, 0.3, 0.2, 4.5)]


FOR_LABELS = [*LABELLED.values(), bm.Surface(0.01, 0.3, coupling=0.7, a_solid=1.5, b_solid=0.5, dof=4.0)]


@pytest.mark.parametrize("prior", [*PRIORS, *FOR_LABELS, bm.Independent(0.2), bm.Ising(0.2, 0.75)])
def test_a_prior_comes_back_from_its_description(prior):
    again = prior_from(prior.describe())
    assert (type(again), vars(again), repr(again)) == (type(prior), vars(prior), repr(prior))
    assert ("solid" in {spec.name for spec in prior.arrays}) == (prior in FOR_LABELS)
    assert bm.Beta(0.5, 1.5).mean == bm.Surface(0.5, 1.5).mean == 0.25  # the share of stopped beams


BAD = [0.0, -1.0, np.nan, np.inf]
REFUSED = [
    *((kind, {which: value}, f"{kind.__name__}: {which} must be a positive number")
      for kind in (bm.Beta, bm.Surface) for which in ("a", "b") for value in BAD),
    *((bm.Surface, {which: value}, f"{which} must be a positive number of cells")
      for which in ("mean_scale", "spread", "size_scale") for value in BAD),
    *((bm.Surface, {"dof": value}, "dof must exceed 1") for value in (1.0, 0.5, np.nan, np.inf)),
    (bm.Surface, {"coupling": -0.1}, r"Surface: coupling must be a number in \[0, 50\], got -0.1"),
    (bm.Surface, {"coupling": np.nan}, "coupling must be a number"),
    (bm.Beta, {"coupling": "fit"}, "Beta: coupling must be a number in .* got 'fit'"),
    (bm.Surface, {"coupling": 1.0, "a_solid": 0.0}, "Surface: a_solid must be a positive number"),
    (bm.Ising, {"p_wall": 1.5, "coupling": 0.5}, r"Ising: p_wall must lie in \[0, 1\], got 1.5"),
    (bm.Ising, {"p_wall": 0.5, "coupling": -0.1}, r"Ising: coupling must lie in \[0, 50\], got -0.1"),
    *((bm.Ising, {"p_wall": 0.5, "coupling": value}, "coupling must lie in") for value in (np.nan, np.inf)),
    (bm.Ising, {"p_wall": 0.5, "coupling": "strong"}, "coupling must be a number or 'fit', got 'strong'"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "arguments", "message"), REFUSED)
def test_parameters_that_make_no_sense_are_refused(kind, arguments, message):
    with pytest.raises(bm.BadInput, match=message):
        kind(**arguments)


def test_walls_of_another_grid_a_coupling_not_fitted_and_surfaces_hardly_ever_small_enough_are_refused():
    with pytest.raises(bm.BadInput, match="coupling is not fitted yet"):
        bm.Ising(0.5, "fit").log_prob(np.zeros((2, 2), bool), bm.Grid((2, 2)))
    with pytest.raises(bm.BadInput, match="Ising: p_wall has shape"):
        bm.Ising(np.full((2, 3), 0.5), 1.0).probabilities(bm.Grid((2, 2)))
    with pytest.raises(bm.BadInput, match="spread must not exceed 3 times size_scale"):
        bm.Surface(spread=1.0, size_scale=0.2)
    assert bm.Surface(spread=0.9, size_scale=0.31).sample_surfaces(np.random.default_rng(1), 100).shape == (100, 5)


@pytest.fixture(scope="module", params=[bm.Independent(0.2), bm.Beta(), bm.Surface()], ids=lambda p: p.words.kind)
def run(request):
    grid = bm.Grid((8, 6), 0.5)
    walls = np.zeros(grid.shape, dtype=bool)
    walls[6] = True
    sensor = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.01, p_no_return=0.01)
    scans = bm.simulate(walls, grid, [1.2, 1.4, 0.0], np.linspace(-0.3, 0.3, 9), sensor=sensor, max_range_m=6.0, seed=1)
    schedule = bm.Schedule(chains=2, warmup=5, draws=12)
    return bm.infer(scans, grid, prior=request.param, sensor=sensor, schedule=schedule, seed=2)


def test_drawn_stops_are_the_draws_themselves_not_what_they_expect_and_thinned_ones_some_of_each_chain(run):
    posterior = run.posterior
    stops = np.concatenate(list(posterior.prior.drawn_stops(posterior.draws)))
    chance = stops if stops.ndim == 2 else stops[..., 0]
    assert chance.shape == (24, run.grid.n_cells)
    known = posterior.draws.index.get("cell", np.arange(run.grid.n_cells))
    for number, (chain, draw) in enumerate(posterior.draws.numbers()):
        drawn = posterior.draws.cells(chain, draw)
        state = (drawn["walls"] if "walls" in drawn else drawn["reflectivity"]).ravel().astype(np.float32)
        np.testing.assert_array_equal(chance[number, known], state[known])
        assert np.isnan(np.delete(state, known)).all()
    sites = np.array([3, 17, 40], dtype=np.int32)
    at_sites = np.concatenate(list(posterior.prior.drawn_stops(posterior.draws, sites)))
    np.testing.assert_array_equal(at_sites, stops[:, sites])
    draws, few = posterior.draws, posterior.draws.thinned(7)
    assert (few.chains, few.count) == (2, 3)
    name = draws.specs[0].name
    np.testing.assert_array_equal(few.arrays[name], draws.arrays[name][:, [0, 6, 11]])
    assert (draws.thinned(1).count, draws.thinned(1000).count) == (1, 12)


def test_cells_that_no_beam_touched_are_drawn_from_the_prior(run):
    """Their mean is the prior's: five standard errors, a false alarm in 1 700 000."""
    posterior = run.posterior
    if posterior.kind == "binary":
        pytest.skip("binary draws hold all cells")
    untouched = np.setdiff1d(np.arange(run.grid.n_cells), posterior.draws.index["cell"]).astype(np.int32)
    assert len(untouched) > 5
    stops = np.concatenate(list(posterior.prior.drawn_stops(posterior.draws, untouched)))
    chance = stops if stops.ndim == 2 else stops[..., 0]
    a, b = posterior.prior.a, posterior.prior.b
    error = np.sqrt(a * b / ((a + b) ** 2 * (a + b + 1)) / chance.size)
    assert abs(chance.mean() - posterior.prior.mean) < 5 * error
    assert chance.std() > 0.1


@pytest.mark.parametrize(("a", "b"), [(0.0213, 0.187), (0.0089, 0.0949)])
def test_counts_of_beams_are_read_off_expected_chances(a, b):
    stopped, passed = (counts.ravel().astype(float) for counts in np.mgrid[0:8, 0:12])
    expected = ((a + stopped) / (a + b + stopped + passed)).astype(np.float16).astype(float)
    found = recover_counts(expected, np.full_like(stopped, a), np.full_like(stopped, b))
    np.testing.assert_array_equal(found, [stopped, passed])


@pytest.mark.parametrize("prior", [bm.Beta(), bm.Surface(), bm.Beta(0.02, 0.2, coupling=0.5)])
def test_a_cell_is_free_and_certain_only_if_enough_beams_passed_it(prior, tmp_path):
    sensor = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01)
    schedule = bm.Schedule(chains=2, warmup=20, draws=20)
    for beams, free, certain in ((1, False, False), (3, False, False), (8, True, True)):
        scans = bm.Scans(np.tile([0.25, 0.25, 0.0], (beams, 1)), [0.0], np.full((beams, 1), 1.75), max_range_m=5.0)
        run = bm.infer(scans, bm.Grid((5, 1), 0.5), prior=prior, sensor=sensor, schedule=schedule)
        run.export(tmp_path / "map.yaml")
        occupancy, _ = read_map(tmp_path / "map.yaml")
        passed = (slice(1, 3), 0)
        assert prior.has_labels or (run.occupancy[passed] < 0.1).all()
        assert ((occupancy[passed] == 0).all(), np.isnan(occupancy[passed]).all()) == (free, not free)
        assert (run.posterior.prior.width(run.posterior.draws, 0.9)[passed] < 0.4).all() == certain


boolean_maps = arrays(np.bool_, st.tuples(st.integers(0, 3), st.integers(0, 5), st.integers(1, 9), st.integers(1, 9)))


@given(boolean_maps)
def test_unpacking_gives_back_what_was_packed(walls):
    packed = pack(walls)
    assert packed.dtype == np.uint8
    assert packed.shape == (*walls.shape[:2], -(-walls.shape[2] * walls.shape[3] // 8))
    back = unpack(packed, walls.shape[2:])
    assert back.dtype == np.bool_
    np.testing.assert_array_equal(back, walls)
    for chain, draw in np.ndindex(walls.shape[:2]):
        np.testing.assert_array_equal(pack(walls[chain, draw]), packed[chain, draw])


@given(arrays(np.bool_, st.tuples(st.integers(0, 30), st.integers(1, 6), st.integers(1, 6))))
def test_counting_walls_needs_no_unpacking(walls):
    cells = walls.shape[1] * walls.shape[2]
    np.testing.assert_array_equal(count_walls(pack(walls), cells), walls.reshape(-1, cells).sum(axis=0))


def test_counting_in_batches_gives_the_same_and_numbers_of_which_halves_hold_some_bits_are_numpy_s(monkeypatch):
    walls = np.random.default_rng(1).random((100, 5, 7)) < 0.3
    monkeypatch.setattr(cell_arrays, "BATCH_BITS", 100)
    np.testing.assert_array_equal(count_walls(pack(walls), 35), walls.reshape(100, -1).sum(axis=0))
    steps = np.arange(2**12) / 2.0**26
    values = np.concatenate([sign * steps * (1 + e) for sign in (-1, 1) for e in (-1e-9, 0, 1e-9)])
    np.testing.assert_array_equal(as_halves(values).view(np.uint16), values.astype(np.float16).view(np.uint16))
    assert len(np.unique(as_halves(values))) > 2000


@given(arrays(np.uint32, st.integers(0, 50)), st.sampled_from([np.float32, np.float64]))
def test_halves_are_those_of_numpy(bits, dtype):
    values = bits.view(np.float32).astype(dtype)
    with np.errstate(all="ignore"):
        np.testing.assert_array_equal(as_halves(values).view(np.uint16), values.astype(np.float16).view(np.uint16))


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
    assert least_p_value(solid, np.exp(log_prior_of_all(shape, 0.5, PRIOR.coupling))) > ALPHA / TESTS
    assert least_p_value(solid, np.exp(log_prior_of_all(shape, 0.5, 0.0))) < ALPHA / TESTS
    assert scipy.stats.kstest(m[solid], scipy.stats.beta(2.0, 0.7).cdf).pvalue > ALPHA / TESTS
    assert scipy.stats.kstest(m[~solid], scipy.stats.beta(0.3, 2.0).cdf).pvalue > ALPHA / TESTS
    assert scipy.stats.ttest_1samp(m.mean(axis=1), PRIOR.mean).pvalue > ALPHA / TESTS
    assert PRIOR.mean_stop(bm.Grid(shape))[0, 0] == PRIOR.mean


@wp.kernel
def many_log_gammas(x: wp.array(dtype=wp.float64), out: wp.array(dtype=wp.float64)):
    out[wp.tid()] = log_gamma(x[wp.tid()])


def test_descriptions_without_labels_are_short_and_the_kernel_s_log_gamma_is_right():
    assert set(bm.Beta().describe()) == {"kind", "a", "b"}
    assert set(bm.Surface().describe()) == {"kind", "a", "b", "mean_scale", "spread", "dof", "size_scale"}

    assert not replace(bm.Surface(coupling=1.0), coupling=0.0).has_labels
    x = np.concatenate([np.geomspace(1e-4, 1e7, 4000), [1.0, 2.0, 9.999999, 10.0]])
    out = wp.zeros(len(x), dtype=wp.float64, device="cpu")
    wp.launch(many_log_gammas, dim=len(x), inputs=[wp.array(x, dtype=wp.float64, device="cpu"), out], device="cpu")
    np.testing.assert_allclose(out.numpy(), scipy.special.gammaln(x), rtol=1e-13, atol=1e-12)


@KINDS
def test_unknown_poses_go_with_labels_bit_for_bit(kind, tmp_path, monkeypatch):
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)  # a sweep a step, so that runs can be stopped anywhere
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
    away = ~problem.touched_map().ravel()
    assert scipy.stats.kstest(m[:, away][solid[:, away]], scipy.stats.beta(3.0, 0.8).cdf).pvalue > ALPHA / TESTS
    assert scipy.stats.kstest(m[:, away][~solid[:, away]], scipy.stats.beta(0.5, 1.5).cdf).pvalue > ALPHA / TESTS
    np.testing.assert_array_equal(sampler.present_cells(state), m)  # the same sweep, the same numbers
    state, _ = sampler.step(state, 1)
    assert (sampler.present_cells(state)[:, away] != m[:, away]).mean() > 0.99


@KINDS
def test_maps_and_predictions_of_cells_that_no_beam_touches_follow_their_labels(kind):
    run = infer(kind, scans(poses=4, beams=12), sensor=TRUTH, draws=20)
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
    """The log ratio of a proposal is that of both maps' densities less that of proposing the one or the other."""
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
