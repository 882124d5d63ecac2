"""Chains on a Ray cluster (docs/scale.md), and the connection of this process to a cluster.

The model and the traced beams go into the cluster's object store once. The chains are divided into groups, and each
group runs in segments of a few seconds. A segment is one Ray task: it takes a snapshot of the chains, and returns the
new draws and the next snapshot, which this process stores. If a worker or a node dies, Ray runs the lost segment again
elsewhere. The draws are the same, because a segment depends on its arguments only. A worker process caches the problem,
and the chains of its last segment, to save time. All groups end segments at the same numbers of sweeps, so that chains
can be joined at the sweep of the slowest group.
"""

from __future__ import annotations

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
from bayesmap.run.chains import Chains, EndRule, Record, SweepPlan, in_sequence, join, map_error, select_chains
from bayesmap.run.runner import CheckpointTimer, Job, no_draws, sweeps
from bayesmap.samplers.sampler import ChainState, Snapshot, Watch, draws_to_inspect
from bayesmap.version import __version__


def run_segment(
    job: Job, until: int, resume: Snapshot | None, state: ChainState | None = None
) -> tuple[Chains, ChainState]:
    """Run the chains of a job up to a number of sweeps. Returns the new draws of the chains, and their state.

    The job has its problem prepared. ``until`` is the number of sweeps at the end; 0 only starts the chains. Observed
    cells are counted later, by `observed_counts`. The statistics of the start are empty with ``resume``. ``state`` is
    the state of the chains, if this process still has it from the segment before.
    """
    schedule, keep = job.schedule, job.schedule.keep
    began = time.perf_counter()
    state = job.sampler.init(job.problem, job.chain_ids, job.seed, resume) if state is None else state
    assert state is not None
    started = time.perf_counter()
    begin, statistics = state.sweep, state.statistics if resume is None else {}
    empty = no_draws(job.model, state, len(job.chain_ids))
    kept = len(keep.sweeps(begin, until)) if schedule.draws else 0
    record, before = Record(empty, SweepPlan(schedule.warmup, kept, schedule.thin)), begin
    for advanced, info in sweeps(job.sampler, state, until, keep=keep):
        record.add(info, before)
        before, state = advanced.sweep, advanced
    seconds = {"trace": 0.0, "warm_start": started - began, "sampling": time.perf_counter() - started}
    segment = record.chains(
        snapshot=job.sampler.snapshot(state), finished=state.sweep >= schedule.sweeps, statistics=statistics,
        observed_counts=np.zeros((2, 0, 0), dtype=np.int32), n_incidences=state.problem.n_incidences, seconds=seconds,
    )  # fmt: skip
    return segment, state


@dataclass
class Cached:
    """The problem of a run that this process keeps, with numbers and state of the chains of the last segment."""

    run: str
    problem: Any
    chains: tuple[tuple[int, ...], ChainState] | None = None


_cached: Cached | None = None


def prepare(job: Job, version: str) -> tuple[Any, float]:
    """Return the prepared problem and the seconds spent. Raises `BadInput` for another version of bayesmap."""
    if version != __version__:
        raise BadInput(f"RayExecutor: a worker has bayesmap {__version__}, this process {version}; all need the same")
    began = time.perf_counter()
    return job.sampler.prepare(job.model_to_trace, job.device, job.threads), time.perf_counter() - began


def cached(run: str, job: Job, problem: list[Any]) -> Cached:
    """Return this process's cached problem of a run; in a list, since Ray fetches a bare reference each time."""
    global _cached  # noqa: PLW0603 -- one per process, as the worker is
    if _cached is None or _cached.run != run:
        import ray

        prepared = ray.get(problem[0])
        if job.parameters is not None:
            prepared = prepared.under(job.parameters.sensor, job.parameters.prior)
        _cached = Cached(run, prepared)
    return _cached


def advance(
    run: str, job: Job, problem: list[Any], chain_ids: tuple[int, ...], until: int, resume: Snapshot | None
) -> Chains:
    """Run the given chains of a job up to a number of sweeps; see `run_segment`."""
    cache = cached(run, job, problem)
    # Use the cached chains only if they are these chains, at the sweep of the snapshot.
    ids, state = cache.chains or ((), None)
    cache.chains = None
    if state is not None and (ids != chain_ids or resume is None or state.sweep != resume.sweep):
        state = None
    job = replace(job, problem=cache.problem, chain_ids=chain_ids)
    segment, state = run_segment(job, until, resume, state)
    cache.chains = (chain_ids, state)
    return segment


def observed_counts(
    run: str, job: Job, problem: list[Any], chain_ids: tuple[int, ...], snapshot: Snapshot,
    draws: Mapping[str, NDArray[Any]],
) -> NDArray[np.int32]:  # fmt: skip
    """Count observed cells of chains at a snapshot, see `Sampler.observed_counts`."""
    state = job.sampler.init(cached(run, job, problem).problem, chain_ids, job.seed, snapshot)
    return job.sampler.observed_counts(state, draws)


def connect(address: str | None) -> Any:
    """Return the `ray` module, connected to a cluster. An open connection is used. Raises `BadInput`."""
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
            raise BadInput(
                f"RayExecutor: no Ray cluster {where} can be used: {reason}; ray start --head starts one, and without "
                "an address bayesmap does"
            ) from error
    return ray


def outcome(ray: Any, ref: Any) -> Any:
    """Return the result of a task, or raise its error, as if it had run in this process."""
    try:
        return ray.get(ref)
    except ray.exceptions.RayTaskError as error:
        raise error.cause from None


def failed(error: Exception) -> ConnectionError:
    """Return the error of a task whose worker died too often."""
    reason = str(error).strip().splitlines()
    return ConnectionError(
        "RayExecutor: a task was given up after its workers had died again and again (out of memory? a node that "
        f"cannot load bayesmap?): {reason[0] if reason else type(error).__name__}"
    )


WAIT_S = 0.25  # longest time between two checks whether to stop, seconds
GROWTH = 16  # largest ratio of the sweeps of a segment to the sweeps of the segment before


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
        self, job: Job, resume: Chains | None, watch: Watch, on_checkpoint: Callable[[Chains], None] | None,
        checkpoint_every_s: float,
    ) -> Chains:  # fmt: skip
        """Run all chains of the job. If stopped early, they end at the last mark that all chains have reached.

        Raises `BadInput` if the sampler refuses the model, Ray is not installed, or the cluster cannot be used, and
        `ConnectionError` if the workers of a task died more than ``retries`` times.
        """
        ray = connect(self.address)
        try:
            return _RayRun(ray, self, job, resume, watch).run(on_checkpoint, checkpoint_every_s)
        except ray.exceptions.RayError as error:
            raise failed(error) from error

    def groups(self, chains: int, tasks_at_once: int) -> list[slice]:
        """Divide chains into groups of neighbours, of sizes that differ by one at most."""
        if self.chains_per_task is not None:
            number = math.ceil(chains / self.chains_per_task)
        else:
            number = min(chains, max(1, tasks_at_once))
        ends = [chains * (group + 1) // number for group in range(number)]
        return [slice(begin, end) for begin, end in zip([0, *ends], ends, strict=False)]


@dataclass
class Marks:
    """Numbers of sweeps at which segments of all groups end, with the ends of warm-up and of the schedule."""

    schedule: SweepPlan
    segment_s: float  # seconds of work between two marks
    marks: list[int]  # so far, ascending
    per_sweep_s: float = 0.0  # seconds per sweep of the slowest group; 0 before it is measured

    def after(self, sweep: int) -> int:
        """Return the first mark after a number of sweeps."""
        last, plan = self.marks[-1], self.schedule
        if sweep >= last:
            most = max(1, GROWTH * (last - self.marks[-2])) if len(self.marks) > 1 else 1
            count = most if self.per_sweep_s == 0 else min(most, int(self.segment_s / self.per_sweep_s))
            ends = [end for end in (plan.warmup, *plan.marks, plan.sweeps) if end > last]
            self.marks.append(min([last + max(1, count), *ends]))
        return self.marks[bisect_right(self.marks, sweep)]


@dataclass
class Group:
    """Chains that advance together, with their results."""

    which: slice
    chain_ids: tuple[int, ...]
    resume: Chains | None  # results from before this run
    segments: list[Chains] = field(default_factory=list)  # consecutive results of this run; snapshots without arrays
    snapshots: dict[int, Snapshot] = field(default_factory=dict)  # by number of sweeps, as far as they may be needed

    @property
    def sweep(self) -> int:
        """Number of sweeps of each chain; -1 before the start."""
        return max(self.snapshots, default=-1)

    def up_to(self, sweep: int) -> Chains:
        """Return the results of the chains up to a mark."""
        parts = [] if self.resume is None else [self.resume]
        parts += takewhile(lambda segment: segment.sweep <= sweep, self.segments)
        return replace(in_sequence(parts), snapshot=self.snapshots[sweep])


class _RayRun:
    """One call of `RayExecutor.run`."""

    def __init__(self, ray: Any, executor: RayExecutor, job: Job, resume: Chains | None, watch: Watch) -> None:
        # Check that the cluster can run a task, and divide the chains into groups.
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
        ids = job.chain_ids
        self.groups = [
            Group(which, ids[which], None if resume is None else select_chains(resume, which))
            for which in executor.groups(len(ids), tasks_at_once)
        ]
        for group in self.groups:
            if group.resume is not None:
                group.snapshots[group.resume.sweep] = group.resume.snapshot
        self.marks = Marks(job.schedule, executor.segment_s, [0 if resume is None else resume.sweep])
        self.running: dict[Any, Group] = {}
        self.name = uuid.uuid4().hex
        self.shared: tuple[Any, ...] = ()
        self.trace_s = 0.0
        self.rule = EndRule(job.schedule, self._error)

    def remote(self, function: Callable[..., Any], **options: Any) -> Any:
        return self.ray.remote(function).options(**self.options, **options).remote

    def run(self, on_checkpoint: Callable[[Chains], None] | None, checkpoint_every_s: float) -> Chains:
        self._share()
        submit_segment = self.remote(advance)

        def submit(group: Group) -> None:
            started = group.sweep >= 0
            until = self.marks.after(group.sweep) if started else 0
            resume = group.snapshots[group.sweep] if started else None
            self.running[submit_segment(self.name, *self.shared, group.chain_ids, until, resume)] = group

        schedule, watch = self.job.schedule, self.watch
        last = self.sweep
        self.rule.check(last)  # a resumed run may stand at a mark
        for group in self.groups:
            if not self.rule.reached and group.sweep < schedule.sweeps:
                submit(group)
        checkpoints = CheckpointTimer(on_checkpoint, checkpoint_every_s)
        # Take segments as they end, and start the next segment of their group.
        while self.running and not self.rule.reached and not (watch.should_stop() and self.sweep >= 0):
            ready, _ = self.ray.wait(list(self.running), num_returns=1, timeout=WAIT_S)
            for ref in ready:
                group = self.running.pop(ref)
                self._note(group, outcome(self.ray, ref))
                if group.sweep < schedule.sweeps and not watch.should_stop():
                    submit(group)
            if self.sweep == last:
                continue
            # The slowest group has reached a new mark: estimate the error, drop old snapshots, perhaps checkpoint.
            warmed_up = last < schedule.warmup <= self.sweep
            last = self.sweep
            self.rule.check(last)
            for group in self.groups:
                group.snapshots = {sweep: snapshot for sweep, snapshot in group.snapshots.items() if sweep >= last}
            if last > 0:
                checkpoints.offer(lambda: replace(self.so_far(), finished=False), at_once=warmed_up)
        # Segments that still run end by themselves, in seconds. Never cancel them: Ray aborts this process if it
        # cancels a task that has just returned (a race, see its pull request 54798; 2.60 still has it).
        return replace(self.so_far(), finished=True) if self.rule.reached else self.so_far()

    def _error(self) -> float:
        chains = self.so_far()
        return map_error(self.job.model.cells, chains.draws, chains.observed())

    @property
    def sweep(self) -> int:
        """Number of sweeps that all chains have made; -1 before all have started."""
        return min(group.sweep for group in self.groups)

    def so_far(self) -> Chains:
        """Return all chains at the sweep of the slowest group."""
        parts = [group.up_to(self.sweep) for group in self.groups]
        submit_count = self.remote(observed_counts)
        counts = [
            submit_count(self.name, *self.shared, group.chain_ids, part.snapshot, draws_to_inspect(part.draws))
            for group, part in zip(self.groups, parts, strict=True)
        ]
        return join([
            replace(
                part, observed_counts=outcome(self.ray, count),
                seconds={**part.seconds, "trace": part.seconds["trace"] + self.trace_s},
            )
            for part, count in zip(parts, counts, strict=True)
        ])  # fmt: skip

    def _share(self) -> None:
        """Put the model and the sampler's prepared problem into the object store."""
        job, ray, beams = self.job, self.ray, self.job.model.scans.n_beams
        model = ray.put(replace(job, threads=self.executor.cpus_per_task))
        self.watch.report("trace", 0, beams)
        problem, seconds = self.remote(prepare, num_returns=2)(model, __version__)
        self.trace_s = outcome(ray, seconds)
        self.watch.report("trace", beams, beams)
        self.shared = (model, [problem])

    def _note(self, group: Group, segment: Chains) -> None:
        """Store the result of a task, and report the progress of all chains."""
        new_sweeps = segment.sweep - max(group.sweep, 0)
        group.snapshots[segment.sweep] = segment.snapshot
        group.segments.append(replace(segment, snapshot=Snapshot(segment.sweep)))
        if new_sweeps > 0:
            self.marks.per_sweep_s = max(self.marks.per_sweep_s, segment.seconds["sampling"] / new_sweeps)
        done, warmup = self.sweep, self.job.schedule.warmup
        if segment.sweep == 0 or done < 0:
            self.watch.report("start", sum(group.sweep >= 0 for group in self.groups), len(self.groups))
        elif done > 0:
            log_joint = segment.log_joint if segment.log_joint.size else segment.warmup_log_joint
            mean = float(log_joint[:, -1].mean()) if log_joint.size else None
            total, error = self.rule.expected_sweeps(done), self.rule.error
            is_open = self.rule.end_is_open
            self.watch.report("warm-up" if done <= warmup else "draws", done, total, mean, error, warmup, is_open)
