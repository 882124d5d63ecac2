"""Chains on a Ray cluster (docs/scale.md), with the same draws as in one process, bit for bit.

The chains are divided into groups, and each group runs in segments of a few seconds. A segment is one Ray task: it
takes a snapshot of the chains, and returns the new draws and the next snapshot, which this process stores. If a worker
or a node dies, Ray runs the lost segment again elsewhere. Its draws are the same, because they depend on its arguments
only. All groups end segments at the same numbers of sweeps. So chains can be joined at the sweep of the slowest group.

Read `RayExecutor` (the public options) and `_RayRun.run` (the loop in this process), then `run_group` and `run_segment`
(the tasks of the workers). Model and traced beams go into the cluster's object store once; workers cache them.
"""

import logging
import math
import time
import uuid
from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from itertools import takewhile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput, check_count
from bayesmap.run.chains import Chains, DrawRecord, StoppingRule, SweepPlan, join_chains, join_segments, map_error
from bayesmap.run.runner import CheckpointTimer, Job, OnCheckpoint, advance_chains, empty_draws
from bayesmap.samplers.sampler import ChainState, Snapshot, Watch, draws_to_inspect
from bayesmap.version import __version__

WAIT_S = 0.25  # longest time between two checks whether to stop
MAX_SEGMENT_GROWTH = 16  # largest ratio of the sweeps of a segment to the sweeps of the segment before


@dataclass(frozen=True)
class RayExecutor:
    """Run the chains of one posterior on a Ray cluster, with the same draws as on threads, bit for bit.

    Every node needs Ray (``pip install 'bayesmap[ray]'``) and the same bayesmap. With GPUs, each task has its own.

    Attributes:
        address: address of the cluster, as in `ray.init` ("auto", "host:6379", "ray://host:10001"). If None, it is the
            cluster that this process is connected to, or RAY_ADDRESS, or one that runs on this machine; else a new
            cluster starts here, and ends with this process.
        cpus_per_task: CPUs that Ray reserves for a task, and threads of the task.
        chains_per_task: chains that one task runs together; by default as many as give each CPU (each GPU) one task.
        segment_s: seconds of work per task, the most that is lost if a worker dies or a run is stopped.
        retries: number of times that a task is run again if its worker dies.

    Raises `BadInput` for a number outside its range.
    """

    address: str | None = None
    cpus_per_task: int = 1
    chains_per_task: int | None = None
    segment_s: float = 5.0
    retries: int = 3

    def __post_init__(self) -> None:
        check_count("RayExecutor", "cpus_per_task", self.cpus_per_task, 1)
        check_count("RayExecutor", "retries", self.retries, 0)
        if self.chains_per_task is not None:
            check_count("RayExecutor", "chains_per_task", self.chains_per_task, 1)
        if not self.segment_s > 0:
            raise BadInput(f"RayExecutor: segment_s must be a positive number of seconds, got {self.segment_s!r}")

    def run(
        self, job: Job, resume: Chains | None, watch: Watch, on_checkpoint: OnCheckpoint, checkpoint_every_s: float
    ) -> Chains:
        """Run all chains of the job. If stopped early, they end at the last mark that all chains have reached.
        Raises `BadInput` if the sampler refuses the model, Ray is not installed, or the cluster cannot be used, and
        `ConnectionError` if the workers of a task died more than ``retries`` times.
        """
        ray = connect(self.address)
        try:
            return _RayRun(ray, self, job, resume, watch).run(on_checkpoint, checkpoint_every_s)
        except ray.exceptions.RayError as error:
            raise worker_death(error) from error

    def groups(self, chains: int, tasks_at_once: int) -> list[slice]:
        """Divide chains into groups of neighbours, of sizes that differ by one at most."""
        if self.chains_per_task is not None:
            number = math.ceil(chains / self.chains_per_task)
        else:
            number = min(chains, max(1, tasks_at_once))
        ends = [chains * (group + 1) // number for group in range(number)]
        return [slice(begin, end) for begin, end in zip([0, *ends], ends, strict=False)]


@dataclass
class Group:
    """Chains that advance together, with their results."""

    selection: slice  # the group among all chains of the run
    chain_ids: tuple[int, ...]  # numbers of the chains, which decide their random numbers
    resume: Chains | None  # results from before this run
    segments: list[Chains] = field(default_factory=list)  # consecutive results of this run; snapshots without arrays
    snapshots: dict[int, Snapshot] = field(default_factory=dict)  # those that may be needed, by number of sweeps

    @property
    def sweep(self) -> int:
        """Number of sweeps of each chain; -1 before the start."""
        return max(self.snapshots, default=-1)

    def up_to(self, sweep: int) -> Chains:
        """Return the results of the chains up to the end of a segment."""
        segments = [] if self.resume is None else [self.resume]
        segments += takewhile(lambda segment: segment.sweep <= sweep, self.segments)
        return replace(join_segments(segments), snapshot=self.snapshots[sweep])


@dataclass
class SegmentEnds:
    """Numbers of sweeps at which the segments of all groups end, chosen one by one as the speed becomes known."""

    schedule: SweepPlan
    segment_s: float  # seconds of work in a segment
    ends: list[int]  # ends chosen so far, ascending
    per_sweep_s: float = 0.0  # seconds per sweep of the slowest group; 0 before it is measured

    def after(self, sweep: int) -> int:
        """Return the first end after a number of sweeps."""
        last, plan = self.ends[-1], self.schedule
        if sweep >= last:
            max_count = max(1, MAX_SEGMENT_GROWTH * (last - self.ends[-2])) if len(self.ends) > 1 else 1
            count = max_count if self.per_sweep_s == 0 else min(max_count, int(self.segment_s / self.per_sweep_s))
            # Chains may end at the marks of the schedule, so segments end there too.
            fixed_ends = [end for end in (plan.warmup, *plan.marks, plan.sweeps) if end > last]
            self.ends.append(min([last + max(1, count), *fixed_ends]))
        return self.ends[bisect_right(self.ends, sweep)]


class _RayRun:
    """One call of `RayExecutor.run`: the groups, the tasks that run, and the stopping rule."""

    def __init__(self, ray: Any, executor: RayExecutor, job: Job, resume: Chains | None, watch: Watch) -> None:
        """Check that the cluster can run a task, and divide the chains into groups."""
        self.ray, self.executor, self.job, self.watch = ray, executor, job, watch
        on_gpu = job.device != "cpu"
        if on_gpu and job.device not in ("cuda", "cuda:0"):
            raise BadInput(f"RayExecutor: each task has a GPU of its own; write device 'cuda', not {job.device!r}")
        resources = ray.cluster_resources()
        tasks_at_once = int(resources.get("GPU", 0) if on_gpu else resources.get("CPU", 0) // executor.cpus_per_task)
        if tasks_at_once == 0:
            need = "a GPU" if on_gpu else f"{executor.cpus_per_task} CPUs"
            raise BadInput(f"RayExecutor: no task can run: each needs {need}, and the cluster has too few")
        self.options = {"num_cpus": executor.cpus_per_task, "num_gpus": int(on_gpu), "max_retries": executor.retries}
        # Divide the chains into groups, each with its part of the run to resume.
        ids = job.chain_ids
        self.groups = [
            Group(selection, ids[selection], None if resume is None else resume.select(selection))
            for selection in executor.groups(len(ids), tasks_at_once)
        ]
        for group in self.groups:
            if group.resume is not None:
                group.snapshots[group.resume.sweep] = group.resume.snapshot
        self.ends = SegmentEnds(job.schedule, executor.segment_s, [0 if resume is None else resume.sweep])
        self.submit_segment = self.remote(run_group)
        self.running: dict[Any, Group] = {}  # groups by the references of their tasks
        self.name = uuid.uuid4().hex  # key of this run in the caches of the workers
        self.shared: tuple[Any, list[Any]] = (None, [])  # references to job and problem in the object store
        self.trace_s = 0.0  # seconds of tracing beams
        self.rule = StoppingRule(job.schedule, self._map_error)

    def remote(self, function: Callable[..., Any], **options: Any) -> Any:
        """Return a function that submits a task with the resources of this run. It returns a reference."""
        return self.ray.remote(function).options(**self.options, **options).remote

    def run(self, on_checkpoint: OnCheckpoint, checkpoint_every_s: float) -> Chains:
        """Run segments of all groups until the last sweep, the stopping rule, or a stop by the user."""
        self._share()
        schedule, watch = self.job.schedule, self.watch
        last = self.sweep
        self.rule.check(last)  # a resumed run may stand at a mark
        for group in self.groups:
            if not self.rule.is_met and group.sweep < schedule.sweeps:
                self._submit(group)
        checkpoints = CheckpointTimer(on_checkpoint, checkpoint_every_s)
        # Take segments as they end, and start the next segment of their group.
        while self.running and not self.rule.is_met and not (watch.should_stop() and self.sweep >= 0):
            ended, _ = self.ray.wait(list(self.running), num_returns=1, timeout=WAIT_S)
            for reference in ended:
                group = self.running.pop(reference)
                self._note(group, task_result(self.ray, reference))
                if group.sweep < schedule.sweeps and not watch.should_stop():
                    self._submit(group)
            if self.sweep == last:
                continue  # the slowest group has not ended its segment
            # The slowest group has ended a segment: estimate the error, drop old snapshots, perhaps checkpoint.
            warmed_up = last < schedule.warmup <= self.sweep
            last = self.sweep
            self.rule.check(last)
            for group in self.groups:
                group.snapshots = {sweep: snapshot for sweep, snapshot in group.snapshots.items() if sweep >= last}
            if last > 0:
                checkpoints.offer(lambda: replace(self.results(), finished=False), at_once=warmed_up)
        # Segments that still run end by themselves, in seconds. Never cancel them: Ray aborts this process if it
        # cancels a task that has just returned (a race, see its pull request 54798; 2.60 still has it).
        return replace(self.results(), finished=True) if self.rule.is_met else self.results()

    @property
    def sweep(self) -> int:
        """Number of sweeps that all chains have made; -1 before all have started."""
        return min(group.sweep for group in self.groups)

    def results(self) -> Chains:
        """Return all chains at the sweep of the slowest group."""
        groups = [group.up_to(self.sweep) for group in self.groups]
        # Workers count the observed cells, because that needs the traced beams.
        submit_count = self.remote(observed_counts)
        references = [
            submit_count(self.name, *self.shared, group.chain_ids, chains.snapshot, draws_to_inspect(chains.draws))
            for group, chains in zip(self.groups, groups, strict=True)
        ]
        for i, reference in enumerate(references):
            seconds = {**groups[i].seconds, "trace": groups[i].seconds["trace"] + self.trace_s}
            groups[i] = replace(groups[i], observed_counts=task_result(self.ray, reference), seconds=seconds)
        return join_chains(groups)

    def _map_error(self) -> float:
        chains = self.results()
        return map_error(self.job.model.cells, chains.draws, chains.observed())

    def _share(self) -> None:
        """Put the model and the sampler's prepared problem into the object store."""
        n_beams = self.job.model.scans.n_beams
        job = self.ray.put(replace(self.job, threads=self.executor.cpus_per_task))
        self.watch.report("trace", 0, n_beams)
        problem, seconds = self.remote(prepare_problem, num_returns=2)(job, __version__)
        self.trace_s = task_result(self.ray, seconds)
        self.watch.report("trace", n_beams, n_beams)
        self.shared = (job, [problem])  # in a list, since Ray would fetch a bare reference before each task

    def _submit(self, group: Group) -> None:
        """Start the next segment of a group; the first segment only starts its chains."""
        has_started = group.sweep >= 0
        until = self.ends.after(group.sweep) if has_started else 0
        snapshot = group.snapshots[group.sweep] if has_started else None
        self.running[self.submit_segment(self.name, *self.shared, group.chain_ids, until, snapshot)] = group

    def _note(self, group: Group, segment: Chains) -> None:
        """Store the result of a task, and report the progress of all chains."""
        new_sweeps = segment.sweep - max(group.sweep, 0)
        group.snapshots[segment.sweep] = segment.snapshot
        group.segments.append(replace(segment, snapshot=Snapshot(segment.sweep)))
        if new_sweeps > 0:
            self.ends.per_sweep_s = max(self.ends.per_sweep_s, segment.seconds["sampling"] / new_sweeps)
        done, warmup = self.sweep, self.job.schedule.warmup
        if segment.sweep == 0 or done < 0:
            self.watch.report("start", sum(group.sweep >= 0 for group in self.groups), len(self.groups))
        elif done > 0:
            log_joint = segment.log_joint if segment.log_joint.size else segment.warmup_log_joint
            mean = float(log_joint[:, -1].mean()) if log_joint.size else None
            self.watch.report(
                "warm-up" if done <= warmup else "draws", done, total=self.rule.expected_sweeps(done), log_joint=mean,
                error=self.rule.error, warmup=warmup, end_is_open=self.rule.end_is_open,
            )  # fmt: skip


def prepare_problem(job: Job, version: str) -> tuple[Any, float]:
    """Return the prepared problem and the seconds spent. Raises `BadInput` for another version of bayesmap."""
    if version != __version__:
        raise BadInput(f"RayExecutor: a worker has bayesmap {__version__}, this process {version}; all need the same")
    began_s = time.perf_counter()
    return job.sampler.prepare(job.model_to_trace, job.device, job.threads), time.perf_counter() - began_s


@dataclass
class ProblemCache:
    """The problem of a run that this worker process keeps, and the chains of its last segment."""

    run: str  # name of the run
    problem: Any
    chains: tuple[tuple[int, ...], ChainState] | None = None  # numbers and state of these chains


_cache: ProblemCache | None = None


def cache_of_run(run: str, job: Job, problem: list[Any]) -> ProblemCache:
    """Return this process's cache of a run, after fetching the problem if the cache is of another run."""
    global _cache  # noqa: PLW0603 -- one per process, as the worker is
    if _cache is None or _cache.run != run:
        import ray

        prepared = ray.get(problem[0])
        if job.parameters is not None:
            prepared = prepared.under(job.parameters.sensor, job.parameters.prior)
        _cache = ProblemCache(run, prepared)
    return _cache


def run_group(
    run: str, job: Job, problem: list[Any], chain_ids: tuple[int, ...], until: int, resume: Snapshot | None
) -> Chains:
    """Run some chains of a job up to a number of sweeps; see `run_segment`."""
    cache = cache_of_run(run, job, problem)
    # Use the cached chains only if they are these chains, at the sweep of the snapshot.
    cached_ids, state = cache.chains or ((), None)
    cache.chains = None  # a segment that fails leaves a state that must not be used again
    if state is not None and (cached_ids != chain_ids or resume is None or state.sweep != resume.sweep):
        state = None
    job = replace(job, problem=cache.problem, chain_ids=chain_ids)
    segment, state = run_segment(job, until, resume, state)
    cache.chains = (chain_ids, state)
    return segment


def run_segment(job: Job, until: int, resume: Snapshot | None, state: ChainState | None) -> tuple[Chains, ChainState]:
    """Run the chains of a job up to a number of sweeps. Returns the new draws of the chains, and their state.

    The job has its problem prepared. ``until`` is the number of sweeps at the end; 0 only starts the chains. Observed
    cells are counted later, by `observed_counts`. The statistics of the start are empty with ``resume``. ``state`` is
    the state of the chains, if this process still has it from the segment before.
    """
    schedule, keep = job.schedule, job.schedule.keep
    # Start the chains, or continue from the snapshot.
    began_s = time.perf_counter()
    state = job.sampler.init(job.problem, job.chain_ids, job.seed, resume) if state is None else state
    assert state is not None
    started_s = time.perf_counter()
    sweep, statistics = state.sweep, state.statistics if resume is None else {}
    # Advance the chains, and record the draws of this segment alone.
    n_kept = len(keep.sweeps(sweep, until)) if schedule.draws else 0
    plan = SweepPlan(schedule.warmup, n_kept, schedule.thin)
    record = DrawRecord(empty_draws(job.model, state, len(job.chain_ids)), plan)
    for advanced, info in advance_chains(job.sampler, state, until, keep=keep):
        record.add(info, sweep)
        sweep, state = advanced.sweep, advanced
    seconds = {"trace": 0.0, "warm_start": started_s - began_s, "sampling": time.perf_counter() - started_s}
    segment = record.chains(
        snapshot=job.sampler.snapshot(state), finished=state.sweep >= schedule.sweeps, statistics=statistics,
        observed_counts=np.zeros((2, 0, 0), dtype=np.int32), n_incidences=state.problem.n_incidences, seconds=seconds,
    )  # fmt: skip
    return segment, state


def observed_counts(
    run: str, job: Job, problem: list[Any], chain_ids: tuple[int, ...], snapshot: Snapshot,
    draws: Mapping[str, NDArray[Any]],
) -> NDArray[np.int32]:  # fmt: skip
    """Count observed cells of chains at a snapshot, (2, nx, ny); see `Sampler.observed_counts`."""
    state = job.sampler.init(cache_of_run(run, job, problem).problem, chain_ids, job.seed, snapshot)
    return job.sampler.observed_counts(state, draws)


def connect(address: str | None) -> Any:
    """Return the `ray` module, connected to a cluster. Raises `BadInput` without Ray or a cluster that can be used."""
    try:
        import ray
    except ImportError:
        raise BadInput("RayExecutor: Ray is not installed; install it with: pip install 'bayesmap[ray]'") from None
    if not ray.is_initialized():
        try:
            ray.init(address=address, log_to_driver=False, logging_level=logging.ERROR, include_dashboard=False)
        except Exception as error:  # Ray raises a bare Exception if a node does not start in time
            where = "on this machine" if address in (None, "auto") else f"at {address}"
            reason = " ".join(str(error).split())
            remedy = "ray start --head starts one, and without an address bayesmap does"
            raise BadInput(f"RayExecutor: no Ray cluster {where} can be used: {reason}; {remedy}") from error
    return ray


def task_result(ray: Any, reference: Any) -> Any:
    """Return the result of a task, or raise its error, as if it had run in this process."""
    try:
        return ray.get(reference)
    except ray.exceptions.RayTaskError as error:
        raise error.cause from None


def worker_death(error: Exception) -> ConnectionError:
    """Return the error to raise for a task whose workers died too often; ``error`` is Ray's."""
    reason = (str(error).strip().splitlines() or [type(error).__name__])[0]
    failure = "a task was given up after its workers had died again and again"
    return ConnectionError(f"RayExecutor: {failure} (out of memory? a node that cannot load bayesmap?): {reason}")
