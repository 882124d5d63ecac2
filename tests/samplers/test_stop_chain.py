"""Runs over reflectivities and surfaces depend on their arguments alone, and are made of scans that say little."""

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest
from stop_rooms import GRID, LABELLED, PRIORS, TRUTH, assert_same, infer, scans
from tiers import full_but, latin, pairs_but

import bayesmap as bm
from bayesmap.cells.ising_field import SOLID
from bayesmap.model import Model
from bayesmap.run import runner
from bayesmap.run.chains import SweepPlan, join_chains
from bayesmap.run.runner import Job, run_chains
from bayesmap.samplers.fit import fit, initial_sensor
from bayesmap.samplers.merge_moves import EARLY_SHARE
from bayesmap.samplers.sampler import Keep
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import trace_stops


@pytest.fixture(autouse=True)
def _short_steps(monkeypatch):
    """A sweep a step, so that runs can be stopped anywhere."""
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)


ALL = list(PRIORS | LABELLED)
KINDS = pytest.mark.parametrize("kind", ALL)


@pytest.mark.parametrize(
    ("kind", "chains"), pairs_but(product(ALL, [1, 3]), ("surfaces", 3), ("labelled reflectivities", 1))
)
def test_the_seed_decides_the_run_and_the_number_of_threads_changes_nothing(kind, chains):
    runs = [infer(kind, chains=chains, threads=threads, seed=3) for threads in (1, 2, 4)]
    assert_same(runs[0], runs[1])
    assert_same(runs[0], runs[2])
    assert (infer(kind, chains=chains, seed=4).draws != runs[0].draws).any()


@pytest.mark.parametrize("kind", full_but(ALL, "surfaces"))
def test_chain_two_is_the_same_wherever_it_runs(kind):
    """Three jobs of one chain each, joined, are the run of three chains: other processes would do no otherwise."""
    whole = infer(kind, chains=3, warmup=6, draws=4)
    prior = (PRIORS | LABELLED)[kind]
    model = Model(scans(), GRID, prior, initial_sensor(prior, GRID.resolution), hit_depth=0.5)
    sampler, parts = StopGibbs(early_sweeps=int(EARLY_SHARE * 6)), []
    for chain in (0, 1, 2):
        found = fit(sampler.prepare(model, "cpu"), 0, 6)
        parts.append(run_chains(Job(model, sampler, SweepPlan(6, 4), 0, (chain,), parameters=found)))
    chains = join_chains(parts)
    np.testing.assert_array_equal(chains.log_joint, whole.log_joint)
    for name, values in chains.draws.arrays.items():
        np.testing.assert_array_equal(values, whole.posterior.draws.arrays[name], err_msg=name)
    for name, values in chains.snapshot.arrays.items():
        np.testing.assert_array_equal(values, whole.posterior.snapshot.arrays[name], err_msg=name)
    np.testing.assert_array_equal(chains.observed(), whole.observed)


@pytest.mark.parametrize(
    ("kind", "step_seconds"),
    pairs_but(product(ALL, [1e-3, 10.0]), ("surfaces", 1e-3), ("labelled reflectivities", 10.0)),
)
def test_any_cutting_into_steps_gives_the_same_run(kind, step_seconds, monkeypatch):
    whole = infer(kind, thin=2)
    monkeypatch.setattr(runner, "STEP_SECONDS", step_seconds)
    assert_same(infer(kind, thin=2), whole)


@pytest.mark.parametrize(
    ("kind", "thin"), pairs_but(product(ALL, [1, 3]), ("surfaces", 1), ("labelled reflectivities", 3))
)
def test_a_run_stopped_at_any_sweep_and_saved_goes_on_bit_for_bit(kind, thin, tmp_path):
    options = {"warmup": 12, "draws": 4, "thin": thin}
    stops = []
    whole = infer(kind, on_checkpoint=stops.append, checkpoint_every_s=0.0, **options)
    assert [run.posterior.sweep for run in stops] == list(range(1, 12 + 4 * thin + 1))
    assert not any(run.finished for run in stops)
    whole.save(tmp_path / "whole.nc")
    assert_same(bm.load(tmp_path / "whole.nc"), whole)
    # The search for starts ends after 9 sweeps, where surfaces are merged, and the warm-up after 12.
    for sweep in (1, 5, 9, 10, 12, 14):
        stop = stops[sweep - 1]
        stop.save(tmp_path / "part.nc")
        part = stop if sweep in (5, 12) else bm.load(tmp_path / "part.nc")
        assert_same(infer(kind, resume=part, **options), whole)
    if kind in LABELLED:
        with pytest.raises(bm.BadInput, match="made with other prior"):
            infer(kind, prior=replace(LABELLED[kind], coupling=0.5), resume=part, **options)


def test_progress_is_told_of_the_fit_warm_up_and_draws_to_the_last_sweep():
    events = []
    infer("reflectivities", on_progress=events.append)
    counted = [event for event in events if event.stage in ("fit", "warm-up", "draws")]
    assert [event.done for event in counted] == [*range(1, 13), *range(1, 19)]
    assert [event.stage for event in counted] == ["fit"] * 12 + ["warm-up"] * 12 + ["draws"] * 6
    assert all(np.isfinite(event.log_joint) for event in counted)


def test_the_fewer_the_beams_the_more_draws_by_default():
    grid = 300 * 300
    assert [bm.Beta().default_draws(beams, grid, 4) for beams in (0, 1, 25_000, 50_000, 100_000, 10**9)] == [
        200, 200, 200, 100, 50, 50,
    ]  # fmt: skip
    # On large grids no more than 1 GiB of draws, but always 50
    assert bm.Beta().default_draws(1, 1000 * 1000, 1) == 200
    assert bm.Beta().default_draws(1, 1000 * 1000, 4) == 67
    assert bm.Surface().default_draws(1, 10**8, 4) == 50
    # More where sweeps between them are not kept
    assert [bm.Beta().default_draws(beams, grid, 4, thin=3) for beams in (25_000, 50_000, 100_000, 10**9)] == [
        200, 200, 100, 100,
    ]  # fmt: skip
    few = scans(poses=2, beams=5)

    def swept(**schedule):
        run = bm.infer(few, GRID, prior=bm.Beta(), sensor=TRUTH, schedule=bm.Schedule(chains=1, warmup=0, **schedule))
        return run.n_draws, run.posterior.sweep

    assert (bm.Beta().default_draws(few.n_beams, GRID.n_cells, 1), swept()) == (200, (200, 3 * 200))
    assert swept(draws=5) == (5, 5)  # who says how many draws, gets as many sweeps
    assert swept(thin=1) == (200, 200)


@pytest.mark.parametrize("kind", full_but(ALL, "surfaces", "reflectivities"))
def test_no_draws_is_a_fit_and_nothing_else(kind):
    run = infer(kind, draws=0)
    assert run.finished
    assert run.n_draws == 0
    assert np.isnan(run.occupancy).all()
    with pytest.raises(bm.BadInput, match="draws"):
        run.log_score(scans())


def test_a_square_s_chance_has_the_pseudo_counts_of_the_label_that_the_draw_shows():
    """Not of the label that the sweep went on to draw."""
    prior = LABELLED["labelled surfaces"]
    sampler = StopGibbs()
    problem = sampler.prepare(Model(scans(), GRID, prior, TRUTH, hit_depth=0.5), "cpu")
    state, info = sampler.step(sampler.init(problem, [0], 3), 6, keep=Keep(after=5, every=1))
    shown = SOLID.values(info.draws[SOLID.name][0, 0], GRID.shape).ravel()
    after = state.chains.solid(0)
    found = state.chains.in_squares(0, 5, is_kept=False)
    touched = problem.rays.touched
    np.testing.assert_array_equal(problem.coordinates["cell"], touched)

    def expected(solid):
        a, b = prior.beta_given(solid[touched])
        return (a + found.stopped) / (a + b + found.stopped + found.passed)

    reported = info.draws["expected_stop_chance"][0, 0].astype(float)
    np.testing.assert_allclose(reported, expected(shown), atol=1e-3)
    assert (after != shown)[touched].any()
    assert abs(reported - expected(after)).max() > 0.05


PLAIN_KINDS = pytest.mark.parametrize("kind", PRIORS)
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


@PLAIN_KINDS
def test_scans_that_saw_nothing_leave_the_prior_and_the_fit_s_start(kind):
    run = infer(kind, ODD["one beam, out of the grid"](), sensor=TRUTH, draws=4)
    np.testing.assert_allclose(run.occupancy[~run.observed], PRIORS[kind].mean)
    assert run.observed.sum() == 1
    start = initial_sensor(PRIORS[kind], GRID.resolution)
    found = fit(trace_stops(filled(NAN), GRID, PRIORS[kind], start), seed=0, sweeps=30).sensor
    for name in ("p_random", "p_no_return", "p_short", "rate_short_per_m"):
        assert getattr(found, name) == pytest.approx(getattr(start, name), rel=1e-6)
    assert found.noise.sigma_m == pytest.approx(start.noise.sigma_m)


def test_half_a_thousand_scans_of_one_pose_and_a_grid_of_one_cell():
    many = bm.Scans(np.tile([0.5, 0.5, 0.0], (500, 1)), [0.0], np.full((500, 1), 0.3), max_range_m=2.0)
    assert_sound(infer("surfaces", many, grid=bm.Grid((1, 1)), chains=1))


SHAPES = [{"spread": 1e-5}, {"spread": 5.0, "size_scale": 10.0}, {"dof": 1.01}, {"dof": 500.0}, {"mean_scale": 1e-4}]
EXTREME = [*(bm.Beta(a, b) for a in (1e-6, 1e-3, 50.0) for b in (1e-6, 500.0)), *(bm.Surface(**s) for s in SHAPES)]


@pytest.mark.parametrize("prior", EXTREME, ids=str)
def test_priors_of_any_size_and_shape_give_sound_runs(prior):
    sensor, warmup = (bm.BeamMixture(bm.Gaussian(1e-3, 1e-4)), 40) if prior.has_surfaces else (TRUTH, 12)
    run = infer("surfaces", room(), prior=prior, sensor=sensor, warmup=warmup, draws=3)
    assert_sound(run)
    assert np.isfinite(run.log_score(room()))


@pytest.mark.parametrize("sensor", [bm.Gaussian(0.1), bm.StudentT(0.1)])
@PLAIN_KINDS
def test_sensors_under_which_a_reading_is_impossible_are_refused_with_the_one_that_is_right(kind, sensor):
    with pytest.raises(bm.BadInput, match="a BeamMixture"):
        infer(kind, sensor=sensor)


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
