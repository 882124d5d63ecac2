"""Scans that say little or nothing: a run over reflectivities or surfaces is made of them all the same, or refused in
one sentence.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from stop_rooms import GRID, PRIORS, TRUTH, infer, scans
from tiers import latin

import bayesmap as bm
from bayesmap.samplers.fit import first_sensor, fit
from bayesmap.samplers.stop_problem import trace_stops

KINDS = pytest.mark.parametrize("kind", PRIORS)
INF, NAN = np.inf, np.nan


@cache
def room():
    return scans(poses=6)


def filled(value):
    return replace(room(), ranges_m=np.full(room().ranges_m.shape, value))


def storm(seed=1):
    """Nine readings of ten are invalid."""
    invalid = np.random.default_rng(seed).random(room().ranges_m.shape) < 0.9
    return replace(room(), ranges_m=np.where(invalid, NAN, room().ranges_m))


ODD = {
    "no hit at all": lambda: filled(INF),
    "all too close": lambda: filled(-INF),
    "a storm of invalid readings": storm,
    "one beam": lambda: bm.Scans([3.0, 2.4, 0.0], [0.0], [[1.1]], max_range_m=6.0),
    "one beam, no return": lambda: bm.Scans([3.0, 2.4, 0.0], [0.0], [[INF]], max_range_m=6.0),
    "one beam, out of the grid": lambda: bm.Scans([0.1, 2.1, np.pi], [0.0], [[INF]], max_range_m=6.0),
    "all the same reading": lambda: filled(1.0),
    "readings of nothing": lambda: filled(0.0),
    "readings past the range": lambda: filled(7.5),
    "a scan of beams along lines": lambda: bm.Scans(
        [3.0, 2.4, 0.0], np.arange(8) * np.pi / 4, [[1.0, INF, -INF, NAN, 2.0, 0.2, 1.5, INF]], max_range_m=6.0
    ),
    "too close though nothing can be": lambda: replace(filled(-INF), min_range_m=0.0),
}


def assert_sound(run):
    """Numbers everywhere, within their bounds."""
    posterior = run.posterior
    arrays = posterior.draws.arrays
    for values in (arrays["reflectivity"], arrays["expected"], posterior.occupancy):
        assert ((values >= 0) & (values <= 1)).all()
    for values in (posterior.log_likelihood, posterior.log_prior, *arrays.values(), posterior.snapshot.arrays["state"]):
        assert np.isfinite(values).all()
    noise = posterior.sensor.noise
    found = [noise.sigma_m, noise.sigma_per_m, posterior.sensor.rate_short_per_m, posterior.prior.a, posterior.prior.b]
    assert (np.array(found) > 0).all()
    assert np.isfinite(found).all()
    lower, upper = run.interval(0.9)
    assert (lower <= upper).all()
    assert run.summary().finished


@pytest.mark.parametrize(("name", "kind"), latin(2, list(ODD), list(PRIORS)))
def test_a_run_is_made_of_scans_that_say_little(kind, name, tmp_path):
    run = infer(kind, ODD[name](), warmup=8, draws=5)
    assert_sound(run)
    run.save(tmp_path / "run.nc")
    np.testing.assert_array_equal(bm.load(tmp_path / "run.nc").draws, run.draws)
    assert np.isfinite(run.log_score(room()))


@KINDS
def test_where_nothing_was_seen_the_prior_stays_and_a_fit_almost_where_it_began(kind):
    run = infer(kind, ODD["one beam, out of the grid"](), sensor=TRUTH, draws=4)
    np.testing.assert_allclose(run.occupancy[~run.observed], PRIORS[kind].mean)
    assert run.observed.sum() == 1
    start = first_sensor(PRIORS[kind], GRID.resolution)
    found = fit(trace_stops(filled(NAN), GRID, PRIORS[kind], start), seed=0, sweeps=30).sensor
    for name in ("p_random", "p_no_return", "p_short", "rate_short_per_m"):
        assert getattr(found, name) == pytest.approx(getattr(start, name), rel=1e-6)
    assert found.noise.sigma_m == pytest.approx(start.noise.sigma_m)


def test_half_a_thousand_scans_of_one_pose_and_a_grid_of_one_cell():
    many = bm.Scans(np.tile([0.5, 0.5, 0.0], (500, 1)), [0.0], np.full((500, 1), 0.3), max_range_m=2.0)
    assert_sound(infer("surfaces", many, grid=bm.Grid((1, 1)), chains=1))


@pytest.mark.parametrize("a", [1e-6, 1e-3, 50.0])
@pytest.mark.parametrize("b", [1e-6, 500.0])
def test_priors_of_any_size_give_reflectivities(a, b):
    run = infer("reflectivities", room(), prior=bm.Beta(a, b), sensor=TRUTH, draws=3)
    assert_sound(run)
    assert np.isfinite(run.log_score(room()))


@pytest.mark.parametrize(
    "shape",
    [{"spread": 1e-5}, {"spread": 5.0, "size_scale": 10.0}, {"dof": 1.01}, {"dof": 500.0}, {"mean_scale": 1e-4}],
    ids=str,
)
def test_priors_of_any_shape_give_surfaces(shape):
    sharp = bm.BeamMixture(bm.Gaussian(1e-3, 1e-4))
    assert_sound(infer("surfaces", room(), prior=bm.Surface(**shape), sensor=sharp, warmup=40))


@pytest.mark.parametrize("sensor", [bm.Gaussian(0.1), bm.StudentT(0.1)])
@KINDS
def test_sensors_under_which_a_reading_is_impossible_are_refused_with_the_one_that_is_right(kind, sensor):
    with pytest.raises(bm.BadInput, match="a BeamMixture"):
        infer(kind, sensor=sensor)


@KINDS
@pytest.mark.parametrize("method", ["exact", "importance", "block", "propagate"])
def test_other_methods_are_refused(kind, method):
    name = type(PRIORS[kind]).__name__
    with pytest.raises(bm.BadInput, match=f"{name} has one method, 'gibbs', got '{method}'"):
        infer(kind, method=method)


def test_runs_of_another_kind_or_with_other_settings_are_not_resumed():
    short = bm.Schedule(chains=1, warmup=2, draws=2)
    walls = bm.infer(room(), GRID, prior=bm.Independent(0.1), sensor=TRUTH, schedule=short)
    surfaces = infer("surfaces", room())
    with pytest.raises(bm.BadInput, match="one over walls or free, not over reflectivities and surfaces"):
        infer("surfaces", room(), resume=walls)
    with pytest.raises(bm.BadInput, match="over reflectivities and surfaces, not over walls or free"):
        bm.infer(room(), GRID, prior=bm.Independent(0.1), sensor=TRUTH, checkpoints=bm.Checkpoints(resume=surfaces))
    with pytest.raises(bm.BadInput, match="over reflectivities and surfaces, not over reflectivities"):
        infer("surfaces", room(), resume=surfaces, prior=bm.Beta())
    for options, word in (
        ({"seed": 1}, "seed"), ({"sensor": TRUTH}, "sensor"), ({"chains": 3}, "chains"), ({"draws": 7}, "draws"),
        ({"prior": bm.Surface(mean_scale=0.5)}, "prior"), ({"hit_depth": 0.2}, "hit_dep"),
    ):  # fmt: skip
        with pytest.raises(bm.BadInput, match=f"resume: the saved run was made with other .*{word}"):
            infer("surfaces", room(), resume=surfaces, **options)
    with pytest.raises(bm.BadInput, match="resume: the saved run was made with other scans"):
        infer("surfaces", storm(), resume=surfaces)
