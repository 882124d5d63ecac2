"""Runs over reflectivities and surfaces are determined by their arguments: not by threads, stops or other chains."""

from itertools import product

import numpy as np
import pytest
from stop_rooms import GRID, LABELLED, PRIORS, TRUTH, assert_same, infer, scans
from tiers import full_but, pairs_but

import bayesmap as bm
from bayesmap.cells.ising_field import SOLID
from bayesmap.model import Model
from bayesmap.run import runner
from bayesmap.run.chains import SweepPlan, join
from bayesmap.run.runner import Job, run_chains
from bayesmap.samplers.fit import first_sensor, fit
from bayesmap.samplers.merge_moves import EARLY_SHARE
from bayesmap.samplers.sampler import Keep
from bayesmap.samplers.stop_gibbs import StopGibbs


@pytest.fixture(autouse=True)
def _short_steps(monkeypatch):
    """A sweep a step, so that runs can be stopped anywhere."""
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)


ALL = list(PRIORS | LABELLED)
KINDS = pytest.mark.parametrize("kind", ALL)


@pytest.mark.parametrize(
    ("kind", "chains"), pairs_but(product(ALL, [1, 3]), ("surfaces", 3), ("labelled reflectivities", 1))
)
def test_the_number_of_threads_changes_nothing(kind, chains):
    runs = [infer(kind, chains=chains, threads=threads) for threads in (1, 2, 4)]
    assert_same(runs[0], runs[1])
    assert_same(runs[0], runs[2])


@pytest.mark.parametrize("kind", full_but(ALL, "labelled surfaces"))
def test_a_seed_gives_one_run_and_another_seed_another(kind):
    assert_same(infer(kind, seed=3), infer(kind, seed=3))
    assert (infer(kind, seed=3).draws != infer(kind, seed=4).draws).any()


@pytest.mark.parametrize("kind", full_but(ALL, "surfaces"))
def test_chain_two_is_the_same_wherever_it_runs(kind):
    """Three jobs of one chain each, joined, are the run of three chains: other processes would do no otherwise."""
    whole = infer(kind, chains=3, warmup=6, draws=4)
    prior = (PRIORS | LABELLED)[kind]
    model = Model(scans(), GRID, prior, first_sensor(prior, GRID.resolution), hit_depth=0.5)
    sampler, parts = StopGibbs(early_sweeps=int(EARLY_SHARE * 6)), []
    for chain in (0, 1, 2):
        problem = sampler.prepare(model, "cpu")
        found = fit(problem, 0, 6)
        parts.append(run_chains(Job(model, sampler, SweepPlan(6, 4), 0, (chain,), parameters=found)))
    chains = join(parts)
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
def test_a_run_stopped_at_any_sweep_goes_on_bit_for_bit(kind, thin):
    options = {"warmup": 12, "draws": 4, "thin": thin}
    stops = []
    whole = infer(kind, on_checkpoint=stops.append, checkpoint_every_s=0.0, **options)
    assert [run.posterior.sweep for run in stops] == list(range(1, 12 + 4 * thin + 1))
    assert not any(run.finished for run in stops)
    # The search for starts ends after 9 sweeps, where surfaces are merged, and the warm-up after 12.
    for sweep in (1, 5, 9, 10, 12, 14):
        stop = stops[sweep - 1]
        assert_same(infer(kind, resume=stop, **options), whole)


def test_a_run_saved_and_loaded_at_any_sweep_goes_on_bit_for_bit(tmp_path):
    stops = []
    whole = infer("surfaces", on_checkpoint=stops.append, checkpoint_every_s=0.0)
    for stop in (stops[7], stops[14]):
        stop.save(tmp_path / "part.nc")
        assert_same(infer("surfaces", resume=bm.load(tmp_path / "part.nc")), whole)


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
    found = state.chains.in_squares(0, 5, kept=False)
    touched = problem.rays.touched
    np.testing.assert_array_equal(problem.coordinates["cell"], touched)

    def expected(solid):
        a, b = prior.beta_given(solid[touched])
        return (a + found.stopped) / (a + b + found.stopped + found.passed)

    reported = info.draws["expected_stop_chance"][0, 0].astype(float)
    np.testing.assert_allclose(reported, expected(shown), atol=1e-3)
    assert (after != shown)[touched].any()
    assert abs(reported - expected(after)).max() > 0.05
