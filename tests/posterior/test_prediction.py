"""Predicted readings and scans, log likelihoods by reading, residuals of held-out ones, and runs that arviz reads."""

import dataclasses

import numpy as np
import pytest
import scipy
from flat_options import infer
from oracle.enumeration import beams, distances
from oracle.stop_worlds import scans_of_all_kinds
from oracle.worlds import make_case

import bayesmap as bm
from bayesmap.cells.arrays import Draws, pack
from bayesmap.posterior.posterior import Posterior
from bayesmap.posterior.prediction import compare_readings, predictor_of, residuals_of, surface_offset
from bayesmap.posterior.scores import beam_log_scores
from bayesmap.samplers.sampler import Snapshot, Stream
from bayesmap.sensors.model import RangeLimits

SENSOR = bm.BeamMixture(bm.Gaussian(0.3), p_no_return=0.1)


@pytest.fixture(scope="module")
def case():
    return make_case(21, sensor=SENSOR, n_poses=3)


@pytest.fixture(scope="module", params=["binary", "surface", "moving"])
def run(case, request):
    """Walls, surfaces, and walls with poses that are drawn."""
    options = {"chains": 2, "warmup": 30, "draws": 25, "sensor": SENSOR, "seed": 2}
    prior = bm.Surface() if request.param == "surface" else case.prior
    poses = bm.UncertainPoses(0.1, 0.05) if request.param == "moving" else None
    return infer(case.scans, case.grid, prior=prior, poses=poses, **options)


def test_drawn_readings_have_the_predicted_quantiles(run):
    """The share of draws below a quantile is its level, within four standard errors."""
    pose, angles = run.posterior.scans.poses[0], np.linspace(-3, 3, 7)
    found = run.predict(np.tile(pose, (40, 1)), angles, levels=(0.2, 0.5, 0.8), draws=50)
    assert (found.draws_m.shape, found.quantiles_m.shape) == ((50, 40, 7), (40, 7, 3))
    np.testing.assert_array_equal(found.quantiles_m[0], found.quantiles_m[-1])
    for level, at in zip(found.levels, found.quantiles_m[0].T, strict=True):
        # Scans of one draw share a map, so the error is that of 50 maps.
        below = (found.draws_m <= at + 1e-9).mean(axis=1)
        error = np.maximum(below.std(axis=0) / np.sqrt(50), 0.01)
        assert (np.abs(below.mean(axis=0) - level) < 4 * error)[np.isfinite(at)].all()
        assert (below.mean(axis=0) >= level - 4 * error).all()  # at no return the probability is a step
    assert str(found).startswith("Prediction: 40 poses, 7 beams each, 50 draws")


def test_all_beams_of_a_drawn_scan_see_one_map(case):
    """A wall that stands in half of the draws stops both beams through its cell, or neither."""
    grid, scans = bm.Grid((6, 3)), case.scans
    run = infer(scans, case.grid, prior=case.prior, sensor=SENSOR, chains=1, draws=40)
    walls = np.zeros((1, 40, 6, 3), bool)
    walls[:, ::2, 3, 1] = walls[..., 5, :] = True
    spec = run.posterior.draws.specs[0]
    draws = dataclasses.replace(run.posterior.draws, grid=grid, arrays={"walls": spec.stored(walls)})
    half = bm.Run(dataclasses.replace(run.posterior, draws=draws))
    found = half.predict([0.5, 1.5, 0.0], [-0.05, 0.05], sensor=bm.Gaussian(0.01), draws=40, max_range_m=20.0)
    np.testing.assert_allclose(found.draws_m[::2, 0], 3 - 0.5, atol=0.1)
    np.testing.assert_allclose(found.draws_m[1::2, 0], 5 - 0.5, atol=0.1)


def test_log_likelihoods_by_reading_are_the_formula_s(case):
    """Reading by reading at the oracle's distances; their sum is the log likelihood of the draw."""
    readings = case.scans.ranges_m.copy()
    readings[0, :2] = [np.nan, np.inf]
    scans = dataclasses.replace(case.scans, ranges_m=readings)
    run = infer(scans, case.grid, prior=case.prior, sensor=SENSOR, chains=2, draws=10)
    found = run.dataset(by_reading=True)
    nats = found["reading_log_likelihood"]
    starts, angles = beams(scans.poses, scans.angles_rad, case.grid)
    limits, z = RangeLimits(scans.min_range_m, scans.max_range_m), readings.ravel()
    plain = np.array([
        SENSOR.log_likelihood(z, distances(walls, starts, angles) * case.grid.resolution, limits)[~np.isnan(z)]
        for walls in run.draws.reshape(-1, *case.grid.shape)
    ])  # fmt: skip
    np.testing.assert_allclose(nats.values.reshape(plain.shape), plain, atol=1e-4)
    np.testing.assert_allclose(nats.sum("reading"), found["log_likelihood"], atol=1e-3)
    assert (nats["reading_scan"].values[0], nats["reading_beam"].values[0]) == (0, 1)


def test_sensor_prior_and_drawn_poses_are_those_of_the_run_and_impossible_predictions_are_refused(run):
    assert (run.sensor, run.prior) == (SENSOR, run.posterior.prior)
    if run.posterior.kind == "binary":  # a sweep of surfaces redraws reflectivities after its likelihood
        found = run.dataset(by_reading=True)
        np.testing.assert_allclose(found["reading_log_likelihood"].sum("reading"), found["log_likelihood"], atol=1e-2)
    for words, asked in {
        "pose 0, .* outside the map": {"poses": [99.0, 0.0, 0.0]}, "draws": {"draws": 0},
        "predict: max_range_m": {"max_range_m": -1.0}, "levels must rise": {"levels": (0.5, 0.2)},
        "levels must": {"levels": ()}, "levels must r": {"levels": (0.5, 0.5)}, "levels": {"levels": (0.5, 1.0)},
    }.items():  # fmt: skip
        with pytest.raises(bm.BadInput, match=words):
            run.predict(**{"poses": run.posterior.scans.poses[0], **asked})


def test_two_models_are_compared_with_a_paired_error(case, run):
    held = make_case(22, sensor=SENSOR, n_poses=12).scans
    one, other = bm.score(run, held), bm.score(run, held, bm.BeamMixture(bm.Gaussian(0.31), p_no_return=0.1))
    assert (one.by_beam.shape, one.by_beam.mean()) == (one.pit.shape, one.nats_per_beam)
    found = bm.compare_scores(one, other)
    assert found.nats_per_beam == pytest.approx(one.nats_per_beam - other.nats_per_beam)
    assert 0 < found.error < 0.5 * one.nats_per_beam_error
    # By hand: the standard error of a ratio of sums over scans.
    off = np.bincount(one.scan_of_beam, one.by_beam - other.by_beam - found.nats_per_beam)
    assert found.error == pytest.approx(np.sqrt((off**2).sum()) / one.beams, rel=0.15)
    assert bm.compare_scores(one, one).nats_per_beam == 0.0
    with pytest.raises(bm.BadInput, match="different beams"):
        bm.compare_scores(one, bm.score(run, case.scans))


def test_all_random_streams_have_different_numbers():
    """Two streams of one number would draw the same numbers from one seed, such as labels and predicted readings."""
    assert len(Stream.__members__) == 10 == len({stream.value for stream in Stream.__members__.values()})


@pytest.mark.filterwarnings("ignore:Estimated shape parameter")
def test_arviz_reads_a_saved_run(run, tmp_path):
    """Summary, R-hat, effective sample size and pointwise loo, by arviz's own functions on the file."""
    pytest.importorskip("xarray_einstats", reason="arviz-stats needs it for loo")
    import arviz_stats as az
    import xarray as xr

    path = tmp_path / "run.nc"
    run.save(path, by_reading=True)
    tree = xr.open_datatree(path)
    assert list(az.summary(tree, group="sample_stats").index) == ["lp", "log_likelihood", "log_prior"]
    joint = tree["sample_stats"].to_dataset()
    assert float(az.rhat(joint)["lp"]) == pytest.approx(run.summary().rhat_log_joint, rel=1e-6)
    assert float(az.ess(joint)["lp"]) == pytest.approx(run.summary().ess_log_joint_bulk, rel=1e-6)
    loo = az.loo(tree, pointwise=True)
    nats = run.dataset(by_reading=True)["reading_log_likelihood"].values.reshape(50, -1).astype(float)
    assert loo.elpd_i.size == nats.shape[1]
    # Plain importance sampling agrees with Pareto smoothing where weights are tame.
    plain = -(scipy.special.logsumexp(-nats, axis=0) - np.log(50))
    tame = np.asarray(loo.pareto_k) < 0.3
    assert tame.any()
    np.testing.assert_allclose(np.asarray(loo.elpd_i)[tame], plain[tame], atol=0.15)
    assert bm.load(path).finished
    tree.close()


CORRIDOR = bm.Grid((10, 1))
PRIOR = bm.Independent(0.5)
SHARP = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.01, p_no_return=0.01, p_short=0.0)


def ahead(*ranges, max_range_m=9.0):
    """Beams from the middle of the corridor's first cell, ahead it."""
    poses = np.tile([0.5, 0.5, 0.0], (len(ranges), 1))
    return bm.Scans(poses, np.zeros(1), np.array(ranges, dtype=float)[:, None], max_range_m)


def posterior_of(*draws, grid=CORRIDOR):
    """A posterior of given draws, each a list of walls, of beams that stop in the middle of cells."""
    walls = np.zeros((len(draws), grid.n_cells), dtype=np.uint8)
    for row, cells in zip(walls, draws, strict=True):
        row[list(cells)] = 1
    packed = pack(walls.reshape(-1, *grid.shape) != 0)
    none = np.zeros((1, len(draws)))
    return Posterior(
        scans=ahead(1.0), sensor=SHARP, prior=PRIOR, settings={"hit_depth": 0.5, "method": "gibbs"},
        draws=Draws(grid, PRIOR.arrays, {"walls": packed[None]}), occupancy=walls.mean(axis=0).reshape(grid.shape),
        observed=np.ones(grid.shape, dtype=bool), log_likelihood=none, log_prior=none, warmup_log_joint=none,
        snapshot=Snapshot(1), finished=True, seconds={}, counts={},
    )  # fmt: skip


def test_a_wall_is_where_readings_are_measured_from_by_the_median_over_draws():
    told = []
    found = residuals_of(predictor_of(posterior_of([6])), ahead(6.0, 5.5, 6.5), on_progress=told.append)
    assert told == pytest.approx([1 / 3, 1.0])
    np.testing.assert_allclose(found.residual_m, [0.0, -0.5, 0.5], atol=2e-3)  # the wall's middle is 6 m away
    np.testing.assert_allclose(found.ends_world, [[6.5, 0.5], [6.0, 0.5], [7.0, 0.5]])
    np.testing.assert_array_equal(found.beams, [0, 1, 2])
    assert found.surprise_nats[0] < found.surprise_nats[1] - 3
    for draws, expected in (([[4], [4], [8]], 4), ([[4], [8], [8]], 8), ([[], [], [4]], 9)):
        found = residuals_of(predictor_of(posterior_of(*draws)), ahead(5.0), on_progress=told.append)
        assert told[-1] == pytest.approx(1.0)
        np.testing.assert_allclose(found.residual_m, [5.0 - expected], atol=0.1)  # noise moves a median a little


def test_no_return_lies_at_the_median_moved_beams_end_where_each_began_and_scans_without_any_are_refused():
    scans = ahead(np.inf, np.inf, 4.0, np.nan, -np.inf)
    found = compare_readings(scans, np.array([6.0, np.inf, np.inf, 6.0, 6.0]), np.arange(5.0))
    np.testing.assert_array_equal(found.beams, [0, 1, 2])
    np.testing.assert_allclose(found.residual_m, [3.0, 0.0, -5.0])
    np.testing.assert_allclose(found.ends_world[:, 0], [6.5, 9.5, 4.5])
    np.testing.assert_array_equal(found.surprise_nats, [0, -1, -2])
    beam_poses = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, np.pi / 2]]])
    scans = bm.Scans([[0.0, 0.0, 0.0]], [0.0, np.pi / 2], [[2.0, 3.0]], 9.0, beam_poses=beam_poses)
    found = compare_readings(scans, np.full(2, 1.0), np.zeros(2))
    np.testing.assert_allclose(found.ends_world, [[2.0, 0.0], [-2.0, 0.0]], atol=1e-12)
    with pytest.raises(bm.BadInput, match="none of the scans has a hit or a no-return"):
        residuals_of(predictor_of(posterior_of([6])), ahead(np.nan, -np.inf))


THICK_M, LONG_M = 0.01, 0.2


def wall(direction_rad):
    """Covariance of a wall that runs in a direction."""
    t = np.array([np.cos(direction_rad), np.sin(direction_rad)])
    n = np.array([-t[1], t[0]])
    return LONG_M**2 * np.outer(t, t) + THICK_M**2 * np.outer(n, n)


@pytest.mark.parametrize("turn_rad", [0.0, 0.7, 2.5, -1.2])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_point_has_its_parts_across_and_along(turn_rad, side):
    """A wall ahead x at the origin, a sensor above or below it, all turned about the origin."""
    turn = np.array([[np.cos(turn_rad), -np.sin(turn_rad)], [np.sin(turn_rad), np.cos(turn_rad)]])
    sensor, point = turn @ [0.5, side * 2.0], turn @ [0.3, side * 0.04]
    found = surface_offset(np.zeros(2), wall(turn_rad), point, sensor)
    assert found.across_m == pytest.approx(0.04)  # in front of it, on whichever side the sensor stands
    # the sensor above looks down, so that larger x is on its left; from below it is on its right
    assert found.along_m == pytest.approx(side * 0.3)
    assert (found.thickness_m, found.length_m) == pytest.approx((THICK_M, LONG_M))
    assert found.incidence_rad == pytest.approx(np.arctan2(0.5, 2.0))
    behind = surface_offset(np.zeros(2), wall(turn_rad), turn @ [0.0, -side * 0.05], turn @ [0.0, side * 3.0])
    assert (behind.across_m, behind.incidence_rad) == pytest.approx((-0.05, 0.0), abs=1e-6)


@pytest.mark.parametrize("prior", [bm.Independent(0.2), bm.Beta(0.5, 1.0), bm.Surface(0.5, 1.0)])
def test_all_scores_give_equal_densities_bit_for_bit(prior):
    """The log score, the whole score, and the surprise of residuals are one kernel's, for every kind of cells."""
    grid, sensor = bm.Grid((4, 3), 0.5, (-1.0, 2.0)), bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_no_return=0.1)
    train, held = scans_of_all_kinds(5, grid, poses=20), scans_of_all_kinds(6, grid, poses=7)
    run = bm.infer(train, grid, prior=prior, sensor=sensor, schedule=bm.Schedule(chains=2, warmup=5, draws=8))
    for other in (None, bm.BeamMixture(bm.StudentT(0.1)), bm.Gaussian(0.2)):
        assert run.log_score(held, sensor=other) == bm.score(run, held, sensor=other).nats_per_beam
    predictor = predictor_of(run.posterior)
    found = residuals_of(predictor, held)
    np.testing.assert_array_equal(found.surprise_nats, -beam_log_scores(predictor, held)[found.beams])
