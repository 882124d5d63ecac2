"""The chain runner: how the work is cut up never shows in the result, and nothing that was done is lost."""

from dataclasses import replace

import numpy as np
import pytest
from sampler_cases import BOTH, SAMPLERS, model_of
from sampler_cases import chains_of as run_of

import bayesmap as bm
from bayesmap.kernels.device import launch
from bayesmap.kernels.walls.chains import EXACT as EXACTLY
from bayesmap.kernels.walls.chains import WallChains, derive_state
from bayesmap.kernels.walls.table import trace
from bayesmap.run import runner
from bayesmap.run.chains import SweepPlan, join
from bayesmap.samplers.progress import Watch
from bayesmap.samplers.wall_problem import WallProblem

EXACT = int(EXACTLY)
SCHEDULE = SweepPlan(warmup=13, draws=17, thin=3)
FIELDS = ("log_likelihood", "log_prior", "warmup_log_joint", "sweep", "finished")


def problem_8x8():
    """Two scans of a random 8 x 8 map; not tiny, so that all branches of the kernels are taken."""
    grid = bm.Grid((8, 8), 0.5)
    rng = np.random.default_rng(8)
    walls = rng.random(grid.shape) < 0.2
    poses, angles = [[1.1, 1.3, 0.2], [2.9, 2.2, 1.0]], np.linspace(0, 2 * np.pi, 40, endpoint=False)
    ranges = bm.ranges(walls, grid, poses, angles, 6.0) + rng.normal(0, 0.2, (2, 40))
    scans = bm.Scans(poses, angles, ranges, max_range_m=6.0)
    return WallProblem(table=trace(scans, grid, bm.Gaussian(0.2)), prior=bm.Independent(0.2), poses=scans.poses)


def chains_of(problem, method, order, *, threads=None, should_stop=lambda: False, on_progress=None, **options):
    watch = Watch(on_progress, should_stop)
    problem = replace(problem, threads=threads)
    return run_of(problem, method, order, schedule=SCHEDULE, watch=watch, **options)


def packed(chains):
    return chains.draws.arrays["walls"]


def assert_same(one, other):
    for name in FIELDS:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)
    np.testing.assert_array_equal(packed(one), packed(other))
    np.testing.assert_array_equal(one.snapshot.arrays["walls"], other.snapshot.arrays["walls"])


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_one_two_and_eight_threads_give_the_same_chains(method, order):
    problem = problem_8x8()
    one = chains_of(problem, method, order, threads=1)
    for threads in (2, 8, None):
        assert_same(chains_of(problem, method, order, threads=threads), one)


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_resumed_chains_equal_uninterrupted_ones_bit_for_bit(method, order, monkeypatch):
    """Stopped after every single step, in warm-up and after it."""
    problem = problem_8x8()
    whole = chains_of(problem, method, order)
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    part, stops = None, 0
    while part is None or not part.finished:
        before = -1 if part is None else part.sweep
        answers = iter([False, True])
        part = chains_of(problem, method, order, resume=part, should_stop=lambda answers=answers: next(answers))
        assert part.sweep > before or part.finished
        stops += 1
    assert stops > 20
    assert_same(part, whole)


@pytest.mark.parametrize("after", [0, 5, 13, 20, 21, 29, SCHEDULE.sweeps])
def test_a_stop_keeps_what_there_is_and_says_so(after, monkeypatch):
    """Even in the last step: resumed there, nothing is left to do."""
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    problem, asked = problem_8x8(), iter(range(100))
    whole = chains_of(problem, "gibbs", "radial")
    part = chains_of(problem, "gibbs", "radial", should_stop=lambda: next(asked) >= after)
    assert (part.sweep, part.finished) == (after, False)
    kept, warmed = packed(part).shape[1], part.warmup_log_joint.shape[1]
    assert (warmed, kept) == (min(after, 13), max(0, after - 13) // 3)
    np.testing.assert_array_equal(packed(part), packed(whole)[:, :kept])
    np.testing.assert_array_equal(part.log_joint, whole.log_joint[:, :kept])
    np.testing.assert_array_equal(part.warmup_log_joint, whole.warmup_log_joint[:, :warmed])
    assert_same(chains_of(problem, "gibbs", "radial", resume=part), whole)


@pytest.mark.parametrize(("every_s", "sweeps"), [(1e9, [SCHEDULE.warmup]), (0.0, range(1, SCHEDULE.sweeps + 1))])
def test_checkpoints_come_after_warm_up_and_as_often_as_asked_and_are_good_to_resume_from(every_s, sweeps, monkeypatch):
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    problem, seen = problem_8x8(), []
    whole = chains_of(problem, "block", "random", on_checkpoint=seen.append, checkpoint_every_s=every_s)
    assert [c.sweep for c in seen] == list(sweeps)
    assert not any(c.finished for c in seen)
    assert_same(chains_of(problem, "block", "random", resume=seen[max(0, len(seen) - 3)]), whole)


def test_progress_counts_sweeps_tells_the_log_joint_and_checkpoints_take_a_twentieth_of_the_time(monkeypatch):
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    problem, seen = problem_8x8(), []
    chains = chains_of(problem, "gibbs", "radial", on_progress=seen.append)
    assert [p.done for p in seen] == list(range(1, 65))
    assert {p.total for p in seen} == {SCHEDULE.sweeps}
    assert [p.stage for p in seen] == ["warm-up"] * 13 + ["draws"] * 51
    np.testing.assert_array_equal([p.log_joint for p in seen[15::3]], chains.log_joint.mean(axis=0))
    assert runner.pause_after(0.5, 30.0) == 30.0
    assert runner.pause_after(20.0, 30.0) == pytest.approx(19 * 40.0)  # what the next one may take, with more draws
    assert runner.pause_after(20.0, 0.0) == 0.0


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_a_chain_draws_the_same_wherever_it_runs_and_whichever_others_do(method, order):
    """Chains 3 and 1 alone, joined, are chains 3 and 1 of five."""
    problem = problem_8x8()
    whole = chains_of(problem, method, order)
    sampler = SAMPLERS[method][0](order, "prior")
    parts = [
        runner.run_chains(runner.Job(model_of(problem), sampler, SCHEDULE, 3, (chain,), problem=problem))
        for chain in (3, 1)
    ]
    both = join(parts)
    for name in ("log_likelihood", "log_prior", "warmup_log_joint"):
        np.testing.assert_array_equal(getattr(both, name), getattr(whole, name)[[3, 1]], err_msg=name)
    np.testing.assert_array_equal(packed(both), packed(whole)[[3, 1]])
    assert (packed(both)[0] != packed(both)[1]).any()


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_what_a_chain_keeps_up_to_date_is_what_follows_from_its_walls(method, order):
    problem = problem_8x8()
    sampler = SAMPLERS[method][0](order, "prior")
    state = sampler.init(problem, range(20), 1)
    for sweeps in (1, 10, 200):
        state, _ = sampler.step(state, sweeps)
        fresh = WallChains(problem.device_table, state.walls(), [0] * 20, "cpu")
        launch(derive_state, 20, [problem.device_table, fresh.states], "cpu")
        for name in ("walls", "first_wall", "current", "reached"):
            kept, derived = (getattr(chains.states, name).numpy() for chains in (state.chains, fresh))
            np.testing.assert_array_equal(kept, derived, err_msg=name)


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_what_a_chain_remembers_of_its_cells_is_true(method, order):
    """``log_likelihood_gain`` is what a wall in the cell adds to the log-likelihood, or a bound."""
    problem = problem_8x8()
    sampler = SAMPLERS[method][0](order, "prior")
    state = sampler.init(problem, range(3), 1)
    for _ in range(10):
        state, _ = sampler.step(state, 3)
        states = state.chains.states
        known, gain = states.known.numpy(), states.log_likelihood_gain.numpy()
        for chain, walls in enumerate(state.walls() != 0):
            for c in np.flatnonzero(known[chain]):
                put, removed = walls.copy(), walls.copy()
                put[c], removed[c] = True, False
                adds = np.subtract(*(problem.table.log_likelihood(w.reshape(8, 8)) for w in (put, removed)))
                close = float(1e-3 + 1e-5 * abs(gain[chain, c]))  # single precision, some dozen terms
                if known[chain, c] == EXACT and not walls[c]:
                    assert adds == pytest.approx(gain[chain, c], abs=close)
                elif walls[c]:
                    assert adds >= gain[chain, c] - close
                else:
                    assert adds <= gain[chain, c] + close
