"""The chain runner: how the work is cut up never shows in the result, and nothing that was done is lost."""

import numpy as np
import pytest
from oracle.worlds import make_case
from sampler_cases import BOTH, SAMPLERS

import bayesmap as bm
from bayesmap.kernels.chains import WallChains
from bayesmap.kernels.parallel import launch
from bayesmap.kernels.state import EXACT as EXACTLY
from bayesmap.kernels.state import derive_state
from bayesmap.run import chain as runner
from bayesmap.run.chain import Schedule, run_chains
from bayesmap.samplers.start import start_maps

EXACT = int(EXACTLY)
SCHEDULE = Schedule(warmup=13, draws=17, thin=3)
FIELDS = ("packed", "log_likelihood", "log_prior", "warmup_log_joint", "walls", "sweep", "finished")


def problem_8x8():
    """Two scans of a random 8 x 8 map; not tiny, so that all branches of the kernels are taken."""
    grid = bm.Grid((8, 8), 0.5)
    rng = np.random.default_rng(8)
    walls = rng.random(grid.shape) < 0.2
    poses, angles = [[1.1, 1.3, 0.2], [2.9, 2.2, 1.0]], np.linspace(0, 2 * np.pi, 40, endpoint=False)
    ranges = bm.ranges(walls, grid, poses, angles, 6.0) + rng.normal(0, 0.2, (2, 40))
    scans = bm.Scans(poses, angles, ranges, max_range_m=6.0)
    from bayesmap.kernels.trace import trace
    from bayesmap.samplers.problem import Problem

    return Problem(table=trace(scans, grid, bm.Gaussian(0.2)), prior=bm.Independent(0.2), poses=scans.poses)


def chains_of(problem, method, order, **options):
    sampler = SAMPLERS[method][0](problem, order)
    return run_chains(sampler, start_maps(problem, "prior", 5, 3), SCHEDULE, 3, **options)


def assert_same(one, other):
    for name in FIELDS:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_one_two_and_eight_threads_give_the_same_chains(method, order):
    problem = problem_8x8()
    one = chains_of(problem, method, order, threads=1)
    for threads in (2, 8, None):
        assert_same(chains_of(problem, method, order, threads=threads), one)


@pytest.mark.parametrize("step_seconds", [0.0, 1e-5, 1e-4, 1e-3])
@pytest.mark.parametrize(("method", "order"), [("gibbs", "random"), ("block", "radial")])
def test_any_cutting_into_steps_gives_the_same_chains(method, order, step_seconds, monkeypatch):
    problem = problem_8x8()
    whole = chains_of(problem, method, order)
    monkeypatch.setattr(runner, "STEP_SECONDS", step_seconds)
    assert_same(chains_of(problem, method, order), whole)


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
        assert part.sweep > before
        stops += 1
    assert stops > 20
    assert_same(part, whole)


def test_a_stop_keeps_what_there_is_and_says_so(monkeypatch):
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    problem = problem_8x8()
    whole = chains_of(problem, "gibbs", "radial")
    for after in (0, 5, 13, 20, 29):
        asked = iter(range(100))
        part = chains_of(problem, "gibbs", "radial", should_stop=lambda asked=asked, after=after: next(asked) >= after)
        assert not part.finished
        kept, warmed = part.packed.shape[1], part.warmup_log_joint.shape[1]
        assert part.sweep == warmed + 3 * kept == after if after <= 13 else part.sweep == 13 + 3 * (after - 13)
        np.testing.assert_array_equal(part.packed, whole.packed[:, :kept])
        np.testing.assert_array_equal(part.log_joint, whole.log_joint[:, :kept])
        np.testing.assert_array_equal(part.warmup_log_joint, whole.warmup_log_joint[:, :warmed])


def test_a_finished_run_is_not_run_again():
    problem = problem_8x8()
    whole = chains_of(problem, "gibbs", "radial")
    assert_same(chains_of(problem, "gibbs", "radial", resume=whole), whole)


def test_a_checkpoint_comes_at_the_end_of_warm_up_and_is_good_to_resume_from():
    problem, seen = problem_8x8(), []
    whole = chains_of(problem, "block", "random", on_checkpoint=seen.append, checkpoint_every_s=1e9)
    assert [c.sweep for c in seen] == [SCHEDULE.warmup]
    assert not seen[0].finished
    assert_same(chains_of(problem, "block", "random", resume=seen[0]), whole)


def test_checkpoints_come_as_often_as_asked(monkeypatch):
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    problem, seen = problem_8x8(), []
    whole = chains_of(problem, "gibbs", "radial", on_checkpoint=seen.append, checkpoint_every_s=-1.0)
    assert [c.sweep for c in seen] == [*range(1, 14), *range(16, 65, 3)]
    assert_same(chains_of(problem, "gibbs", "radial", resume=seen[-3]), whole)


def test_checkpoints_take_a_tenth_of_the_time_at_most_unless_each_step_shall_have_one():
    assert runner.pause_after(0.5, 30.0) == 30.0
    assert runner.pause_after(20.0, 30.0) == pytest.approx(9 * 20.0)
    assert runner.pause_after(20.0, 0.0) == 0.0


def test_progress_counts_sweeps_and_tells_the_log_joint(monkeypatch):
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    problem, seen = problem_8x8(), []
    chains = chains_of(problem, "gibbs", "radial", on_progress=seen.append)
    assert [p.done for p in seen] == [*range(1, 14), *range(16, 65, 3)]
    assert {p.total for p in seen} == {SCHEDULE.sweeps}
    assert [p.warming_up for p in seen] == [True] * 13 + [False] * 17
    np.testing.assert_array_equal(np.stack([p.log_joint for p in seen[13:]], axis=1), chains.log_joint)


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_what_a_chain_keeps_up_to_date_is_what_follows_from_its_walls(method, order):
    problem = problem_8x8()
    sampler = SAMPLERS[method][0](problem, order)
    state = sampler.init(start_maps(problem, "prior", 20, 1), 1)
    for sweeps in (1, 10, 200):
        state, _ = sampler.step(state, sweeps)
        fresh = WallChains(problem.device_table, state.walls(), [0] * 20, "cpu")
        launch(derive_state, 20, [problem.device_table, fresh.states], "cpu")
        for name in ("walls", "first", "current", "reached"):
            kept, derived = (getattr(chains.states, name).numpy() for chains in (state.chains, fresh))
            np.testing.assert_array_equal(kept, derived, err_msg=name)


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_what_a_chain_remembers_of_its_cells_is_true(method, order):
    """``gain`` is what a wall in the cell adds to the log-likelihood, or the bound that it says it is."""
    problem = problem_8x8()
    sampler = SAMPLERS[method][0](problem, order)
    state = sampler.init(start_maps(problem, "prior", 3, 1), 1)
    for _ in range(10):
        state, _ = sampler.step(state, 3)
        states = state.chains.states
        known, gain = states.known.numpy(), states.gain.numpy()
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


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_the_reported_log_joint_is_that_of_the_drawn_map(method, order):
    """For priors of one number and of one a cell, fixed cells included."""
    for case in (make_case(1, prior="cells", n_poses=3), make_case(2, prior=0.3)):
        problem = case.problem()
        sampler = SAMPLERS[method][0](problem, order)
        _, info = sampler.step(sampler.init(start_maps(problem, "prior", 3, 1), 1), 20)
        for chain in range(3):
            for draw in range(20):
                walls = info.draws[chain, draw].reshape(case.grid.shape) != 0
                reported = info.log_likelihood[chain, draw] + info.log_prior[chain, draw]
                assert reported == pytest.approx(problem.log_joint(walls), rel=1e-6, abs=1e-4)
                assert info.log_prior[chain, draw] == pytest.approx(case.prior.log_prob(walls, case.grid), abs=1e-9)


def test_fixed_cells_stay_as_the_prior_fixed_them():
    case = make_case(4, prior="cells", n_poses=3)
    problem = case.problem()
    p = case.prior.p_wall
    for method, order in BOTH:
        sampler = SAMPLERS[method][0](problem, order)
        _, info = sampler.step(sampler.init(start_maps(problem, "ones", 50, 1), 1), 20)
        draws = info.draws.reshape(-1, *case.grid.shape) != 0
        assert not draws[:, p == 0].any()
        assert draws[:, p == 1].all()


def test_radial_orders_go_outwards_from_the_nearest_sensor():
    from oracle.transitions import block_sites, single_sites

    for seed in range(20):
        case = make_case(seed, shape=[(4, 4), (1, 6), (3, 2)][seed % 3], n_poses=1 + seed % 3)
        problem = case.problem()
        for method, sites in (("gibbs", single_sites), ("block", block_sites)):
            expected = sites(case.grid.shape, "radial", case.scans.poses, case.grid)
            found = SAMPLERS[method][0](problem, "radial").sites
            if method == "block":
                rows = max(1, case.grid.shape[1] - 1)
                found = [s // rows * case.grid.shape[1] + s % rows for s in found.tolist()]
            np.testing.assert_array_equal(found, [cells[0] for cells in expected])
