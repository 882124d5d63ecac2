"""Predicted readings and scans against the plain definition, log likelihoods by reading, and runs that arviz reads."""

import dataclasses

import numpy as np
import pytest
import scipy
from flat_options import infer
from oracle.enumeration import beams, distances
from oracle.stop_law import cross_surface
from oracle.worlds import make_case

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.posterior.prediction import CENTRAL_80, Predictor, ScanPredictor, fixed_maps
from bayesmap.samplers.sampler import Stream
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
        finite = np.isfinite(at)
        assert (np.abs(below.mean(axis=0) - level) < 4 * error)[finite].all()
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
        "pose 0, .* outside the map": {"poses": [99.0, 0.0, 0.0]}, "levels must rise": {"levels": (0.5, 0.2)},
        "draws": {"draws": 0}, "predict: max_range_m": {"max_range_m": -1.0},
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


GRID = bm.Grid((12, 9), 0.5, (-1.0, 2.0))
LIMITS = RangeLimits(0.2, 5.0)
SHARP_SENSOR = bm.BeamMixture(bm.Gaussian(0.05), 0.02, 0.05, 0.1, 0.4)
DEPTH = 0.5
STEP_M = 1e-4
POSE = (1.3, 4.1, 0.7)
ANGLES = np.linspace(-1.5, 1.4, 9)
RANGES = np.linspace(LIMITS.min_m, LIMITS.max_m, 20_001)
OFF_M = 1e-3
"""Of a quantile: a 30 000th of the span, the step of the plain walk, and that of the ranges."""


def cells_met(angle):
    """Cells on a beam in order, and where it enters and leaves each, by steps of a tenth of a millimetre.

    The cell of the start is met where the beam leaves it.
    """
    t = np.arange(0.0, LIMITS.max_m, STEP_M)
    heading = POSE[2] + angle
    u = (POSE[0] - GRID.origin[0] + t * np.cos(heading)) / GRID.resolution
    v = (POSE[1] - GRID.origin[1] + t * np.sin(heading)) / GRID.resolution
    inside = (u >= 0) & (u < GRID.shape[0]) & (v >= 0) & (v < GRID.shape[1])
    flat = np.where(inside, np.floor(u) * GRID.shape[1] + np.floor(v), -1).astype(int)
    first = np.flatnonzero(np.diff(flat, prepend=-2))
    last = np.append(first[1:], len(t))
    cells, enter, leave = flat[first], t[first], np.append(t, LIMITS.max_m)[last]
    enter[0] = leave[0]
    return cells[cells >= 0], enter[cells >= 0], leave[cells >= 0]


def law(stops):
    """P(reading <= each of RANGES), of stops (weight, distance, spread)."""
    total = np.zeros(len(RANGES))
    for weight, distance, spread in stops:
        sensor = bm.BeamMixture(bm.Gaussian(np.hypot(0.05, spread)), 0.02, 0.05, 0.1, 0.4)
        total += weight * sensor.cumulative(RANGES, np.full(len(RANGES), distance), LIMITS)
    return total


def along(chances, distances, spreads):
    free = 1.0
    for chance, distance, spread in zip(chances, distances, spreads, strict=True):
        yield free * chance, distance, spread
        free *= 1 - chance
    yield free, np.inf, 0.0


def quantile(below, level):
    """The least of RANGES that readings stay below with a probability: the definition."""
    if below[0] >= level:
        return -np.inf
    return RANGES[np.argmax(below >= level)] if below[-1] >= level else np.inf


def expected(draws_of_beam):
    """Quantiles of the mean over draws of each beam's law."""
    return [[quantile(np.mean(laws, axis=0), level) for level in CENTRAL_80] for laws in draws_of_beam]


def predicted(states, **options):
    predictor = Predictor(GRID, fixed_maps(states), SHARP_SENSOR, DEPTH, len(states))
    return ScanPredictor.of(predictor, LIMITS).quantiles(POSE, ANGLES, **options)


def stop_maps():
    rng = np.random.default_rng(3)
    stop = rng.beta(0.3, 1.5, (3, GRID.n_cells))
    stop[rng.random(stop.shape) < 0.1] = 1.0
    return stop.astype(np.float32)


def test_quantiles_are_those_of_the_mean_over_draws():
    maps = stop_maps()
    laws = []
    for angle in ANGLES:
        cells, enter, leave = cells_met(angle)
        where = enter + DEPTH * (leave - enter)
        laws.append([law(along(one[cells].astype(float), where, np.zeros(len(cells)))) for one in maps])
    found = predicted(maps)
    assert np.isinf(expected(laws)).any()  # a beam that probably comes back from nothing is among them
    np.testing.assert_allclose(found, expected(laws), atol=OFF_M)
    one_draw = expected([each[:1] for each in laws])
    assert not np.allclose(found, one_draw, atol=0.05)  # another law would be noticed


def test_quantiles_of_surfaces_are_where_a_beam_crosses_them_and_levels_must_rise_inside_zero_and_one():
    rng = np.random.default_rng(4)
    states = np.zeros((2, GRID.n_cells, 6), np.float32)
    states[..., 0] = rng.beta(0.6, 1.0, (2, GRID.n_cells))
    mean = GRID.centers_from_corner_m(np.arange(GRID.n_cells)) + rng.uniform(-0.2, 0.2, (GRID.n_cells, 2))
    shape = np.column_stack([rng.uniform(0.05, 0.2, GRID.n_cells), rng.normal(0, 0.05, GRID.n_cells)])
    states[..., 1:3], states[..., 3:5], states[..., 5] = mean, shape, 0.04  # alike in both draws: nothing is merged
    start = np.array(POSE[:2]) - GRID.origin
    laws = []
    for angle in ANGLES:
        cells, _, _ = cells_met(angle)
        direction = np.array([np.cos(POSE[2] + angle), np.sin(POSE[2] + angle)])
        chance, distance, variance = cross_surface(states[0, cells].astype(float), start, direction)
        stops = [one[cells, 0] * chance for one in states.astype(float)]
        laws.append([law(along(chances, distance, np.sqrt(variance))) for chances in stops])
    np.testing.assert_allclose(predicted(states), expected(laws), atol=OFF_M)
    for levels in ((), (0.5, 0.5), (0.9, 0.1), (0.0, 0.5), (0.5, 1.0)):
        with pytest.raises(BadInput, match="levels must rise"):
            predicted(stop_maps(), levels=levels)
    with pytest.raises(BadInput, match="no draw"):
        predicted(stop_maps()[:0])
