"""Chains on a real Ray cluster of two nodes: the draws of threads, bit for bit, whatever dies."""

import os
import signal
import sys
from dataclasses import dataclass

import numpy as np
import pytest
from flat_options import infer
from samplers.stop_rooms import assert_same
from tiers import full_but

import bayesmap as bm
from bayesmap.model import Model
from bayesmap.run import ray_executor
from bayesmap.run.chains import SweepPlan
from bayesmap.run.runner import Job, ThreadExecutor
from bayesmap.samplers.sampler import Keep, Watch
from bayesmap.samplers.walls import WallGibbs

pytestmark = [
    pytest.mark.xdist_group("ray"),
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings(r"ignore:os\.fork\(\) was called:RuntimeWarning"),  # Ray forks; JAX may be loaded
]

ANGLES = np.linspace(0, 2 * np.pi, 60, endpoint=False)
WALLS, POSE = bm.worlds.tutorial()
GRID = bm.worlds.TUTORIAL_GRID
SHORT = {"chains": 3, "warmup": 20, "draws": 30, "seed": 5}


@pytest.fixture(scope="module")
def scans():
    return bm.simulate(WALLS, GRID, POSE, ANGLES, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=0)


KINDS = {
    "walls": {"prior": bm.Independent(0.3), "sensor": bm.Gaussian(0.2)},
    "blocks of walls from belief propagation": {
        "prior": bm.Independent(0.3), "sensor": bm.Gaussian(0.2), "method": "block", "start": "propagate",
    },
    "reflectivities": {"prior": bm.Beta(), "sensor": bm.BeamMixture(bm.Gaussian(0.2))},
    "surfaces and a fitted sensor": {"prior": bm.Surface(), "sensor": "fit"},
}  # fmt: skip


def quick(**change):
    """An executor whose segments are so short that a small run has many."""
    return bm.RayExecutor(**{"segment_s": 0.01} | change)


def as_threads(scans, kind, executor=None, on_progress=None, **change):
    """Infer on the cluster, and check that threads draw the same; return the run."""
    arguments = {**SHORT, **KINDS[kind], **change}
    run = infer(scans, GRID, executor=executor or quick(), on_progress=on_progress, **arguments)
    assert_same(run, infer(scans, GRID, **arguments))
    return run


@pytest.mark.parametrize("kind", full_but(list(KINDS), "surfaces and a fitted sensor"))
def test_the_draws_are_those_of_threads(cluster, scans, kind):
    run = as_threads(scans, kind)
    with pytest.raises(AssertionError):  # power of all that compares runs here
        assert_same(run, infer(scans, GRID, **{**SHORT, **KINDS[kind], "seed": 6}))


def test_chains_stop_where_those_of_threads_do(cluster, scans):
    """They stop at a precision, at marks that groups of chains reach at different times."""
    events = []
    assert as_threads(scans, "walls", on_progress=events.append, draws=400, precision=0.05).n_draws < 400
    assert {event.total < 420 for event in events if event.error is not None} == {True}  # the estimated end


@pytest.mark.full
@pytest.mark.parametrize("chains_per_task", [1, 2, 3])
def test_how_chains_are_divided_makes_no_difference(cluster, scans, chains_per_task):
    """Unknown poses make none either: each chain has poses of its own, and rays that follow them."""
    as_threads(scans, "walls", quick(chains_per_task=chains_per_task), thin=2)
    poses = bm.UncertainPoses(0.05, 0.01)
    as_threads(scans, "reflectivities", quick(chains_per_task=chains_per_task), poses=poses, warmup=7, draws=8)


@pytest.mark.full
@pytest.mark.parametrize("kind", ["walls", "surfaces and a fitted sensor"])
def test_a_node_that_dies_costs_nothing_but_time(cluster, scans, kind):
    cluster.complete()
    killed = []

    def on_progress(event):
        if event.stage == "warm-up" and not killed:
            assert event.done < event.total
            cluster.kill()
            killed.append(event.done)

    as_threads(scans, kind, on_progress=on_progress, warmup=40, draws=60)
    assert killed


@dataclass(frozen=True, eq=False)
class Deadly(WallGibbs):
    """Ends the process that samples with it, once, in the middle of Ray's task; the file ``mark`` says that it has."""

    mark: str = ""

    def step(self, state, sweeps, beta=1.0, keep=Keep()):
        if state.sweep > 10 and not os.path.exists(self.mark):
            with open(self.mark, "x"):
                pass
            os.kill(os.getpid(), signal.SIGKILL)
        return super().step(state, sweeps, beta, keep)


def test_a_worker_that_dies_costs_nothing_but_time(cluster, scans, tmp_path):
    cluster.send_by_value(sys.modules[__name__])
    model = Model(scans, GRID, bm.Independent(0.3), bm.Gaussian(0.2))

    def job(sampler):
        return Job(model, sampler, SweepPlan(20, 30), 5, (0, 1, 2))

    mark = tmp_path / "died"
    done = quick().run(job(Deadly(mark=str(mark))), None, Watch(), None, 30.0)
    assert mark.exists()
    expected = ThreadExecutor().run(job(WallGibbs()), None, Watch(), None, 30.0)
    np.testing.assert_array_equal(done.draws.arrays["walls"], expected.draws.arrays["walls"])
    np.testing.assert_array_equal(done.log_joint, expected.log_joint)


@pytest.mark.full
def test_a_task_whose_worker_always_dies_is_given_up(cluster, scans, tmp_path):
    cluster.send_by_value(sys.modules[__name__])
    model = Model(scans, GRID, bm.Independent(0.3), bm.Gaussian(0.2))
    job = Job(model, Deadly(mark=str(tmp_path / "died")), SweepPlan(20, 30), 5, (0,))
    with pytest.raises(ConnectionError, match="its workers had died"):
        quick(retries=0).run(job, None, Watch(), None, 30.0)


def test_a_run_that_is_stopped_goes_on_where_it_was(cluster, scans):
    """Ctrl-C in the middle; then on the cluster, and as well on threads."""
    arguments = {**SHORT, **KINDS["surfaces and a fitted sensor"], "warmup": 40, "draws": 60}

    def stop(event):
        if event.stage == "draws":
            signal.raise_signal(signal.SIGINT)

    stopped = infer(scans, GRID, executor=quick(), on_progress=stop, **arguments)
    assert not stopped.finished
    assert 40 < stopped.posterior.sweep < 100
    expected = infer(scans, GRID, **arguments)
    assert_same(infer(scans, GRID, executor=quick(), resume=stopped, **arguments), expected)
    assert_same(infer(scans, GRID, resume=stopped, **arguments), expected)


@pytest.mark.full
def test_checkpoints_are_of_all_chains_at_one_sweep(cluster, scans):
    arguments = {**SHORT, **KINDS["walls"], "warmup": 50, "draws": 100}
    seen, progress = [], []
    run = infer(
        scans, GRID, executor=quick(), on_checkpoint=seen.append, on_progress=progress.append, checkpoint_every_s=0.0,
        **arguments,
    )  # fmt: skip
    assert len(seen) >= 2
    for one in seen:
        assert not one.finished
        kept = one.draws.shape[1]
        assert one.posterior.sweep == one.posterior.warmup_log_joint.shape[1] + kept
        np.testing.assert_array_equal(one.draws, run.draws[:, :kept])
    sweeps = [event.done for event in progress if event.stage in ("warm-up", "draws")]
    assert sweeps == sorted(sweeps)
    assert sweeps[-1] == 150
    assert_same(infer(scans, GRID, executor=quick(), resume=seen[0], **arguments), run)


@pytest.mark.full
@pytest.mark.parametrize("kind", ["walls", "surfaces and a fitted sensor"])
def test_a_checkpoint_does_not_send_all_draws_back(cluster, scans, kind, monkeypatch):
    """Workers say which cells are observed: they need eight maps of walls for it, and of surfaces no draw at all."""
    sent, remote = [], ray_executor._RayRun.remote

    def spied(self, function, **options):
        submit = remote(self, function, **options)
        if function is not ray_executor.observed_counts:
            return submit
        return lambda *given: (sent.append(given[-1]), submit(*given))[1]

    monkeypatch.setattr(ray_executor._RayRun, "remote", spied)
    infer(scans, GRID, executor=quick(), **{**SHORT, **KINDS[kind]})
    assert sent
    assert {array.shape[1] for draws in sent for array in draws.values()} == ({8} if kind == "walls" else {0})


def test_tasks_that_the_cluster_cannot_run_are_refused(cluster, scans):
    for executor, device, message in (
        (quick(), "tpu:7", "each task has a GPU of its own"), (quick(cpus_per_task=64), "cpu", "each needs 64 CPUs"),
    ):  # fmt: skip
        with pytest.raises(bm.BadInput, match=message):
            infer(scans, GRID, executor=executor, device=device, **{**SHORT, **KINDS["walls"]})


def test_numbers_that_make_no_sense_are_refused_and_without_ray_the_remedy_is_named(scans, monkeypatch):
    for change, message in (
        ({"cpus_per_task": 0}, "cpus_per_task must be a whole number of 1 or more"),
        ({"chains_per_task": 0}, "chains_per_task must be a whole number of 1 or more"),
        ({"retries": -1}, "retries must be a whole number of 0 or more"),
        ({"segment_s": 0.0}, "segment_s must be a positive number of seconds"),
    ):
        with pytest.raises(bm.BadInput, match=message):
            bm.RayExecutor(**change)
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(bm.BadInput, match=r"pip install 'bayesmap\[ray\]'"):
        infer(scans, GRID, executor=bm.RayExecutor(), **{**SHORT, **KINDS["walls"]})
