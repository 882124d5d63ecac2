"""`bm.infer`: every method's answer depends on its arguments alone, however the runner cuts up its work."""

import os
import signal
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from flat_options import grouped
from oracle.enumeration import marginals, number_of
from oracle.worlds import OwnSensor, make_case
from sampler_cases import BOTH, SAMPLERS, model_of
from sampler_cases import chains_of as run_of
from stop_rooms import assert_same

import bayesmap as bm
from bayesmap.kernels.device import launch
from bayesmap.kernels.walls.chains import EXACT as EXACTLY
from bayesmap.kernels.walls.chains import WallChains, derive_state
from bayesmap.kernels.walls.table import trace
from bayesmap.run import runner
from bayesmap.run.chains import MIN_DRAWS_PER_CHAIN, SweepPlan, join_chains
from bayesmap.samplers.sampler import Watch
from bayesmap.samplers.wall_problem import WallProblem

MARKOV = ["gibbs", "block"]
METHODS = [*MARKOV, "exact", "importance", "propagate"]


@pytest.fixture
def case():
    return make_case(11, prior=0.3, sensor=bm.Gaussian(0.5), n_poses=2)


def infer(case, **options):
    return bm.infer(case.scans, case.grid, **grouped(**{"prior": case.prior, "sensor": case.sensor, **options}))


@pytest.mark.parametrize("method", METHODS)
def test_every_method_finds_the_exact_marginals(case, method):
    """Within 0.03: five standard errors of 4000 draws worth 400. Belief propagation keeps no draws unless asked."""
    truth, approximate = marginals(case.exact.p, 16), method == "propagate"
    draws = {} if approximate else {"draws": 1000}
    run = infer(case, method=method, chains=4, particles=300_000, seed=2, **draws)
    np.testing.assert_allclose(run.occupancy.ravel(), truth, atol=0.15 if approximate else 0.03)
    assert run.draws.shape == (4, 0 if approximate else 1000, 4, 4)
    if approximate:
        assert run.posterior.statistics["belief_changes"][-1] < 0.01
    else:
        np.testing.assert_allclose(run.draws.mean(axis=(0, 1)).ravel(), truth, atol=0.04)
    if method == "exact":
        assert run.posterior.log_evidence == pytest.approx(case.exact.log_evidence, abs=1e-3)


@pytest.mark.parametrize("method", METHODS)
def test_the_log_joint_is_that_of_the_draws(method):
    """The prior has one number a cell, some of them fixed."""
    case = make_case(11, prior="cells", sensor=bm.Gaussian(0.5), n_poses=2)
    run = infer(case, method=method, chains=2, draws=20, particles=1000)
    expected = case.exact.log_joint[number_of(run.draws.reshape(2, 20, 16))]
    np.testing.assert_allclose(run.log_joint, expected, atol=1e-3, rtol=1e-5)


@pytest.mark.parametrize("method", METHODS)
def test_equal_arguments_give_equal_runs_with_any_number_of_threads(case, method):
    options = {"method": method, "draws": 50, "particles": 1000, "seed": 3}
    for threads in (2, 7):
        assert_same(infer(case, threads=threads, **options), infer(case, threads=1, **options))
    assert (infer(case, **(options | {"seed": 4})).draws != infer(case, **options).draws).any()


@pytest.mark.parametrize("method", MARKOV)
def test_chains_may_start_from_a_map(case, method):
    """With no warm-up and one sweep, the start still shows in what no beam reaches... so look at the start itself."""
    start = np.random.default_rng(1).random((4, 4)) < 0.5
    for maps in (start, start.astype(np.uint8), np.stack([start] * 4)):
        walls = infer(case, method=method, start=maps, warmup=0, draws=0).posterior.snapshot.arrays["walls"]
        np.testing.assert_array_equal(walls.reshape(4, 4, 4) != 0, np.stack([start] * 4))


def test_ctrl_c_during_the_warm_start_goes_on_to_the_same_end():
    """On the tutorial's map one round and twenty rounds do not give one start."""
    walls, pose = bm.worlds.tutorial()
    grid, angles, sensor = bm.worlds.TUTORIAL_GRID, np.arange(100) / 100 * 2 * np.pi, bm.Gaussian(0.2)
    scans = bm.simulate(walls, grid, pose, angles, sensor=sensor, max_range_m=42.0, seed=1)
    options = {"prior": bm.Independent(0.05), "sensor": sensor, "start": "propagate", "warmup": 2, "draws": 3}
    whole, short = (bm.infer(scans, grid, seed=5, **grouped(**options, **rounds)) for rounds in ({}, {"rounds": 1}))
    assert (whole.draws != short.draws).any()

    def interrupt(event):
        if event.stage == "propagate" and event.done == 1:
            signal.raise_signal(signal.SIGINT)

    part = bm.infer(scans, grid, seed=5, on_progress=interrupt, **grouped(**options))
    assert not part.finished
    assert_same(bm.infer(scans, grid, seed=5, **grouped(**options, resume=part)), whole)


def test_belief_propagation_stopped_by_ctrl_c_is_not_finished_and_the_handler_is_given_back(case):
    before = signal.getsignal(signal.SIGINT)

    def interrupt(event):
        signal.raise_signal(signal.SIGINT)

    run = infer(case, method="propagate", rounds=20, on_progress=interrupt)
    assert len(run.posterior.statistics["belief_changes"]) == 1
    assert not run.finished
    infer(case, draws=2)
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.parametrize(("change", "message"), [
    ({"scans": slice(0, 1)}, "scans or on another grid"), ({"seed": 2}, r"seed \(1, now 2\)"),
    ({"draws": 21}, r"draws \(20, now 21\)"), ({"method": "block"}, r"method \('gibbs', now 'block'\)"),
    ({"sensor": bm.Gaussian(0.6)}, "sensor"), ({"prior": bm.Independent(0.31)}, "prior"),
    ({"start": np.eye(4, dtype=bool)}, "scans or on another grid"),
])  # fmt: skip
def test_a_run_made_with_other_arguments_is_not_resumed(case, change, message):
    options = {"method": "gibbs", "warmup": 10, "draws": 20, "seed": 1, "start": np.zeros((4, 4), dtype=bool)}
    saved, other = infer(case, **options), dict(change)
    if "scans" in other:
        case = replace(case, scans=case.scans.select(other.pop("scans")))
    with pytest.raises(bm.BadInput, match=f"resume: the saved run was made with other .*{message}"):
        infer(case, resume=saved, **(options | other))


@pytest.mark.parametrize("method", METHODS)
def test_scans_that_say_nothing_leave_the_prior(method):
    """No scan at all, or an invalid reading and a beam that never meets the grid: 8000 draws, five standard errors."""
    grid, prior = bm.Grid((3, 3)), bm.Independent(np.linspace(0, 1, 9).reshape(3, 3))
    silent = [
        bm.Scans(np.zeros((0, 3)), [0.0], np.zeros((0, 1)), max_range_m=5.0),
        bm.Scans([[1.0, 1.0, 0.0], [9.0, 9.0, 0.0]], [0.0], [[np.nan], [1.0]], max_range_m=5.0),
    ]
    for scans in silent:
        options = grouped(method=method, draws=2000, warmup=0, particles=20_000)
        run = bm.infer(scans, grid, prior=prior, sensor=bm.Gaussian(0.1), **options)
        np.testing.assert_allclose(run.draws.mean(axis=(0, 1)), prior.p_wall, atol=5 * np.sqrt(0.25 / 8000))
        assert not run.observed.any()


@pytest.mark.parametrize("shape", [(1, 1), (1, 5), (5, 1)])
@pytest.mark.parametrize("method", METHODS)
def test_maps_one_cell_wide_work(method, shape):
    case = make_case(12, shape=shape, prior=0.3, sensor=bm.Gaussian(0.5), n_poses=2)
    run = infer(case, method=method, draws=1000, particles=100_000, rounds=50)
    np.testing.assert_allclose(run.occupancy.ravel(), marginals(case.exact.p, case.n), atol=0.04)


def test_wrong_priors_and_sensors_and_scans_that_say_nothing_of_the_map_are_refused(case):
    for change, message in (
        ({"prior": 0.2}, r"prior must say what cells are, such as bm.Independent\(0.2\) or bm.Surface\(\), got 0.2"),
        ({"prior": bm.Independent}, "prior must say what cells are, .* got <class"),
        ({"sensor": None}, "sensor must be a sensor model or 'fit', got None"),
    ):
        with pytest.raises(bm.BadInput, match=f"infer: {message}"):
            infer(case, draws=2, warmup=2, **change)
    grid, sensor, angles = bm.Grid((10, 8), 0.5), bm.Gaussian(0.2), np.linspace(-3, 3, 9)
    scans = bm.simulate(np.eye(10, 8), grid, [1.3, 2.8, 0.0], angles, sensor=sensor, max_range_m=9.0)
    with pytest.raises(bm.BadInput, match=r"no scan and no hit lies on the grid, x 0 to 5.* they lie at x 4\d"):
        bm.infer(scans.at(scans.poses + np.array([50.0, 0.0, 0.0])), grid, prior=bm.Independent(0.2), sensor=sensor)
    nothing = bm.Scans(scans.poses, angles, np.full((1, 9), np.nan), max_range_m=9.0)
    with pytest.raises(bm.BadInput, match="all 9 readings are NaN"):
        bm.infer(nothing, grid, prior=bm.Independent(0.2), sensor=sensor)


@pytest.mark.parametrize("cells", [{"sensor": bm.Gaussian(0.5)}, {"prior": bm.Beta()}])
def test_a_first_map_is_shown_and_changes_no_draw(case, cells):
    previews = []
    arguments = (case.scans, case.grid)
    options = {"prior": bm.Independent(0.3), "schedule": bm.Schedule(chains=2, warmup=4, draws=6)} | cells
    alone = bm.infer(*arguments, **options)
    run = bm.infer(*arguments, **options, checkpoints=bm.Checkpoints(preview=previews.append))
    np.testing.assert_array_equal(run.occupancy, alone.occupancy)
    np.testing.assert_array_equal(run.log_joint, alone.log_joint)
    (preview,) = previews
    assert (preview.n_draws, preview.finished, preview.occupancy.shape) == (1, False, case.grid.shape)


def test_a_limited_time_ends_the_chains_with_what_they_have(case, monkeypatch):
    options = {"prior": bm.Independent(0.3), "sensor": case.sensor}
    short = bm.infer(case.scans, case.grid, **options, schedule=bm.Schedule(2, warmup=5, seconds=1e-3))
    assert short.finished
    draws = short.n_draws
    assert MIN_DRAWS_PER_CHAIN <= draws <= runner.MAX_FIRST_STEP_SWEEPS  # those of one step
    warmup = short.posterior.settings["warmup"]
    assert warmup < 5  # five sweeps take longer
    whole = bm.infer(case.scans, case.grid, **options, schedule=bm.Schedule(2, warmup=warmup, draws=draws))
    np.testing.assert_array_equal(short.log_joint, whole.log_joint)
    # Enough time: the draws that were asked for. A stopped run goes on with its own warm-up.
    longer = bm.Schedule(2, warmup=5, draws=10, seconds=600)
    assert bm.infer(case.scans, case.grid, **options, schedule=longer).n_draws == 10
    short = bm.infer(case.scans, case.grid, **options, schedule=replace(longer, seconds=1e-3))
    resumed = bm.infer(case.scans, case.grid, **options, schedule=longer, checkpoints=bm.Checkpoints(resume=short))
    warmup = short.posterior.settings["warmup"]
    whole = bm.infer(case.scans, case.grid, **options, schedule=bm.Schedule(2, warmup=warmup, draws=10))
    np.testing.assert_array_equal(resumed.log_joint, whole.log_joint)


def test_a_sensor_of_the_user_s_own_is_known_by_its_law_and_is_given_again_to_a_loaded_run(case, tmp_path):
    """A file holds its name alone; a run is not resumed with another sensor of the same name."""
    blunt, sharp, saved = OwnSensor(bm.Gaussian(3.0)), OwnSensor(bm.Gaussian(0.2)), []
    simulated = bm.simulate(np.zeros((4, 4)), case.grid, [0, 3, 0], [0.0] * 99, sensor=sharp, max_range_m=3.0)
    assert np.isfinite(simulated.ranges_m).all()
    run = infer(case, sensor=sharp, warmup=5, draws=5, on_checkpoint=saved.append)
    assert infer(case, sensor=sharp, warmup=5, draws=5, resume=saved[0]).finished
    with pytest.raises(bm.BadInput, match="sensor"):
        infer(case, sensor=blunt, warmup=5, draws=5, resume=saved[0])
    run.save(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    assert loaded.trajectory is loaded.posterior.sensor is None
    assert loaded.posterior.settings["sensor"] == {"kind": "OwnSensor"}
    np.testing.assert_array_equal(loaded.draws, run.draws)
    with pytest.raises(bm.BadInput, match="sensor="):
        loaded.log_score(case.scans)
    assert loaded.log_score(case.scans, sensor=sharp) == run.log_score(case.scans)


IN_CHILD = """
import multiprocessing, warnings
import numpy as np
from oracle.worlds import make_case
from test_infer import infer

def occupancy(_=None):
    return infer(make_case(11), warmup=5, draws=5, threads=2).occupancy

here = occupancy()
warnings.simplefilter("ignore")  # of threads and forks
with multiprocessing.get_context("fork").Pool(1) as pool:
    np.testing.assert_array_equal(pool.apply_async(occupancy).get(timeout=60), here)
print("the same")
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="fork is the way of Linux")
def test_a_forked_child_infers_what_its_parent_does():
    """In a process of its own: what other tests have loaded here, such as Ray, does not survive a fork."""
    env = os.environ | {"PYTHONPATH": os.pathsep.join([os.path.dirname(__file__), *sys.path])}
    done = subprocess.run([sys.executable, "-c", IN_CHILD], env=env, capture_output=True, text=True, check=False)
    assert done.stdout == "the same\n", done.stderr


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


def assert_same_chains(one, other):
    for name in FIELDS:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)
    np.testing.assert_array_equal(packed(one), packed(other))
    np.testing.assert_array_equal(one.snapshot.arrays["walls"], other.snapshot.arrays["walls"])


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_stopped_chains_keep_what_they_have_and_go_on_bit_for_bit(method, order, monkeypatch):
    """Stopped before the first sweep and after every single step, the last one included, in warm-up and after it."""
    problem = problem_8x8()
    whole = chains_of(problem, method, order)
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    part, sweeps = chains_of(problem, method, order, should_stop=lambda: True), []
    while not part.finished:
        sweeps.append(part.sweep)
        warmed, kept = min(part.sweep, 13), max(0, part.sweep - 13) // 3
        np.testing.assert_array_equal(packed(part), packed(whole)[:, :kept])
        np.testing.assert_array_equal(part.log_joint, whole.log_joint[:, :kept])
        np.testing.assert_array_equal(part.warmup_log_joint, whole.warmup_log_joint[:, :warmed])
        answers = iter([False, True])
        part = chains_of(problem, method, order, resume=part, should_stop=lambda answers=answers: next(answers))
    assert sweeps == list(range(SCHEDULE.sweeps + 1))
    assert_same_chains(part, whole)


@pytest.mark.parametrize(("every_s", "sweeps"), [(1e9, [SCHEDULE.warmup]), (0.0, range(1, SCHEDULE.sweeps + 1))])
def test_checkpoints_are_good_to_resume_from_take_a_twentieth_of_the_time_and_progress_counts(
    every_s, sweeps, monkeypatch
):
    """Checkpoints come after the warm-up and as often as asked for; progress tells sweeps and the log joint."""
    monkeypatch.setattr(runner, "STEP_SECONDS", 0.0)
    problem, saved, seen = problem_8x8(), [], []
    options = {"on_checkpoint": saved.append, "checkpoint_every_s": every_s}
    chains = chains_of(problem, "block", "random", on_progress=seen.append, **options)
    assert [c.sweep for c in saved] == list(sweeps)
    assert not any(c.finished for c in saved)
    assert_same_chains(chains_of(problem, "block", "random", resume=saved[max(0, len(saved) - 3)]), chains)
    assert [p.done for p in seen] == list(range(1, 65))
    assert {p.total for p in seen} == {SCHEDULE.sweeps}
    assert [p.stage for p in seen] == ["warm-up"] * 13 + ["draws"] * 51
    np.testing.assert_array_equal([p.log_joint for p in seen[15::3]], chains.log_joint.mean(axis=0))
    assert runner.checkpoint_pause_s(0.5, 30.0) == 30.0
    assert runner.checkpoint_pause_s(20.0, 30.0) == pytest.approx(19 * 40.0)  # with more draws
    assert runner.checkpoint_pause_s(20.0, 0.0) == 0.0


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
    both = join_chains(parts)
    for name in ("log_likelihood", "log_prior", "warmup_log_joint"):
        np.testing.assert_array_equal(getattr(both, name), getattr(whole, name)[[3, 1]], err_msg=name)
    np.testing.assert_array_equal(packed(both), packed(whole)[[3, 1]])
    assert (packed(both)[0] != packed(both)[1]).any()


@pytest.mark.parametrize(("method", "order"), BOTH)
def test_a_chain_s_kept_sums_and_bounds_follow_from_its_walls(method, order):
    problem = problem_8x8()
    sampler = SAMPLERS[method][0](order, "prior")
    state = sampler.init(problem, range(20), 1)
    for sweeps in (1, 10, 200):
        state, _ = sampler.step(state, sweeps)
        fresh = WallChains(problem.device_table, state.walls(), [0] * 20, "cpu")
        launch(derive_state, 20, [problem.device_table, fresh.states], "cpu")
        for name in ("walls", "first_wall", "beam_loglik", "reaching"):
            kept, derived = (getattr(chains.states, name).numpy() for chains in (state.chains, fresh))
            np.testing.assert_array_equal(kept, derived, err_msg=name)

    # ``log_likelihood_gain`` is what a wall in the cell adds to the log-likelihood, or a bound.
    state = sampler.init(problem, range(3), 1)
    for _ in range(10):
        state, _ = sampler.step(state, 3)
        states = state.chains.states
        known, gain = states.gain_status.numpy(), states.log_likelihood_gain.numpy()
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
