"""Chains on a Ray cluster (docs/scale.md), and the connection of this process to one.

The model and the traced beams go into the cluster's object store once. The chains are divided into groups, and each
group runs in segments of a few seconds, every one a Ray task of its own: given where the chains stood it returns the
new draws and where they stand. This process keeps both. When a worker or a node dies, Ray runs the lost segment again
elsewhere, from where the one before it ended, and since segments depend on nothing else the draws are the same.

All groups are cut into segments at the same numbers of sweeps, so that chains can be joined wherever the slowest is.
"""

from __future__ import annotations

import logging
import time
import uuid
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import takewhile
from typing import Any

from bayesmap.errors import BadInput, check_count
from bayesmap.run import ray_worker
from bayesmap.run.chains import Chains, SweepPlan, in_sequence, join, some_chains
from bayesmap.run.runner import Job, pause_after
from bayesmap.samplers.progress import Watch
from bayesmap.samplers.sampler import Snapshot, to_see
from bayesmap.version import __version__


def connect(address: str | None) -> Any:
    """Return the `ray` module, connected; an existing connection is used, and none is closed.

    Args:
        address: see `bayesmap.run.ray_executor.RayExecutor`.

    Raises:
        BadInput: Ray is not installed, or there is no cluster at the address.
    """
    try:
        import ray
    except ImportError:
        raise BadInput("RayExecutor: Ray is not installed; install it with: pip install 'bayesmap[ray]'") from None
    if not ray.is_initialized():
        try:
            ray.init(address=address, log_to_driver=False, logging_level=logging.ERROR, include_dashboard=False)
        except Exception as error:  # among others a bare Exception, of a node that does not come up in time
            where = "on this machine" if address in (None, "auto") else f"at {address}"
            reason = " ".join(str(error).split())
            raise BadInput(
                f"RayExecutor: no Ray cluster {where} can be used: {reason}; ray start --head starts one, and without "
                "an address bayesmap does"
            ) from error
    return ray


def outcome(ray: Any, ref: Any) -> Any:
    """Return what a task returned, or raise what it raised, as if it had run here."""
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


WAIT_S = 0.25
"""How often this process looks whether it shall stop."""
GROWTH = 16
"""A segment has at most so many times the sweeps of the one before."""


@dataclass(frozen=True)
class RayExecutor:
    """Run the chains of one posterior on a Ray cluster, with the same draws as on threads, bit for bit.

    Needs Ray (``pip install 'bayesmap[ray]'``), and the same version of bayesmap on every node. On a GPU each task
    has one of its own.

    Attributes:
        address: of the cluster, as `ray.init` takes it ("auto", "host:6379", "ray://host:10001"). By default the one
            that this process is connected to already, or that RAY_ADDRESS names, or that was started on this machine;
            without any, one is started here, until this process ends.
        cpus_per_task: CPUs that Ray reserves for a task, and threads that it has.
        chains_per_task: chains that one task runs abreast; by default as many as give each CPU (each GPU) one task.
        segment_s: seconds of work of a task: what is lost at most when a worker dies or a run is stopped.
        retries: how often a task is run again whose worker has died.

    Raises:
        BadInput: Ray is not installed, there is no cluster at the address, or a number that makes no sense.
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
        self,
        job: Job,
        resume: Chains | None,
        watch: Watch,
        on_checkpoint: Callable[[Chains], None] | None,
        checkpoint_every_s: float,
    ) -> Chains:
        """Run all chains of the job; stopped early, they have the sweeps that all chains have made.

        Raises:
            BadInput: what the sampler refuses, or a cluster that cannot be had.
            ConnectionError: a worker died more often than it may.
        """
        ray = connect(self.address)
        try:
            return _RayRun(ray, self, job, resume, watch).run(on_checkpoint, checkpoint_every_s)
        except ray.exceptions.RayError as error:
            raise failed(error) from error

    def groups(self, chains: int, tasks_at_once: int) -> list[slice]:
        """Divide chains into groups of neighbours, of sizes that differ by one at most."""
        if self.chains_per_task is not None:
            number = -(-chains // self.chains_per_task)
        else:
            number = min(chains, max(1, tasks_at_once))
        ends = [chains * (group + 1) // number for group in range(number)]
        return [slice(begin, end) for begin, end in zip([0, *ends], ends, strict=False)]


@dataclass
class Marks:
    """Numbers of sweeps at which segments end, common to all groups.

    Attributes:
        schedule: the end of warm-up and the end of all are marks.
        segment_s: seconds of work between two marks.
        at: those so far, ascending.
        per_sweep_s: what a sweep of the slowest group takes.
    """

    schedule: SweepPlan
    segment_s: float
    at: list[int]
    per_sweep_s: float = 0.0

    def after(self, sweep: int) -> int:
        """Return the first mark after a number of sweeps."""
        if sweep >= self.at[-1]:
            before = self.at[-1] - self.at[-2] if len(self.at) > 1 else 0
            most = max(1, GROWTH * before)
            count = most if self.per_sweep_s == 0 else min(most, int(self.segment_s / self.per_sweep_s))
            until = self.at[-1] + max(1, count)
            plan = self.schedule
            ends = [end for end in (plan.warmup, *plan.marks, plan.sweeps) if end > self.at[-1]]
            self.at.append(min([until, *ends]))
        return self.at[bisect_right(self.at, sweep)]


@dataclass
class Group:
    """Chains that advance together, and what they have done.

    Attributes:
        which: of the job's chains.
        chain_ids: their numbers.
        resume: what they had done before this run.
        segments: the consecutive parts of this run, whose snapshots have no arrays.
        snapshots: where they stood after each number of sweeps that is still of use.
    """

    which: slice
    chain_ids: tuple[int, ...]
    resume: Chains | None
    segments: list[Chains] = field(default_factory=list)
    snapshots: dict[int, Snapshot] = field(default_factory=dict)

    @property
    def sweep(self) -> int:
        """The number of sweeps that each has made; -1 before they are started."""
        return max(self.snapshots, default=-1)

    def up_to(self, sweep: int) -> Chains:
        """Return what the chains have done up to a mark."""
        parts = [] if self.resume is None else [self.resume]
        parts += takewhile(lambda segment: segment.sweep <= sweep, self.segments)
        return replace(in_sequence(parts), snapshot=self.snapshots[sweep])


class _RayRun:
    """One call of `RayExecutor.run`."""

    def __init__(self, ray: Any, executor: RayExecutor, job: Job, resume: Chains | None, watch: Watch) -> None:
        self.ray, self.executor, self.job, self.watch = ray, executor, job, watch
        on_gpu = job.device != "cpu"
        if on_gpu and job.device not in ("cuda", "cuda:0"):
            raise BadInput(f"RayExecutor: each task has a GPU of its own; write device 'cuda', not {job.device!r}")
        resources = ray.cluster_resources()
        at_once = int(resources.get("GPU", 0) if on_gpu else resources.get("CPU", 0) // executor.cpus_per_task)
        if at_once == 0:
            wanted = "a GPU" if on_gpu else f"{executor.cpus_per_task} CPUs"
            raise BadInput(f"RayExecutor: no task can run: each needs {wanted}, and the cluster has too few")
        self.options = {
            "num_cpus": executor.cpus_per_task, "num_gpus": int(on_gpu), "max_retries": executor.retries,
        }  # fmt: skip
        ids = job.chain_ids
        self.groups = [
            Group(which, ids[which], None if resume is None else some_chains(resume, which))
            for which in executor.groups(len(ids), at_once)
        ]
        begin = 0
        if resume is not None:
            begin = resume.sweep
            for group in self.groups:
                assert group.resume is not None
                group.snapshots[begin] = group.resume.snapshot
        self.marks = Marks(job.schedule, executor.segment_s, [begin])
        self.running: dict[Any, Group] = {}
        self.name = uuid.uuid4().hex
        self.shared: tuple[Any, ...] = ()
        self.trace_s = 0.0
        self.known = False
        self.error: float | None = None

    def remote(self, function: Callable[..., Any], **options: Any) -> Any:
        return self.ray.remote(function).options(**self.options, **options).remote

    def run(self, on_checkpoint: Callable[[Chains], None] | None, checkpoint_every_s: float) -> Chains:
        self._share()
        advance = self.remote(ray_worker.advance)

        def submit(group: Group) -> None:
            started = group.sweep >= 0
            until = self.marks.after(group.sweep) if started else 0
            resume = group.snapshots[group.sweep] if started else None
            self.running[advance(self.name, *self.shared, group.chain_ids, until, resume)] = group

        schedule, watch = self.job.schedule, self.watch
        last = self.sweep
        self._look()  # a run that was stopped at a mark
        for group in self.groups:
            if not self.known and group.sweep < schedule.sweeps:
                submit(group)
        saved_at, pause_s = time.monotonic(), checkpoint_every_s
        while self.running and not self.known and not (watch.should_stop() and self.sweep >= 0):
            ready, _ = self.ray.wait(list(self.running), num_returns=1, timeout=WAIT_S)
            for ref in ready:
                group = self.running.pop(ref)
                self._note(group, outcome(self.ray, ref))
                if group.sweep < schedule.sweeps and not watch.should_stop():
                    submit(group)
            if self.sweep == last:
                continue
            warmed_up = last < schedule.warmup <= self.sweep
            last = self.sweep
            self._look()
            for group in self.groups:
                group.snapshots = {at: snapshot for at, snapshot in group.snapshots.items() if at >= last}
            now = time.monotonic()
            due = warmed_up or now - saved_at >= pause_s
            if on_checkpoint is not None and last > 0 and due:
                so_far = self.so_far()
                on_checkpoint(replace(so_far, finished=False))
                saved_at = time.monotonic()
                pause_s = pause_after(saved_at - now, checkpoint_every_s)
        # Segments that still run are left to end, in seconds. Never cancel them: Ray aborts this process when it
        # cancels a task that has just returned (the race of its pull request 54798, which 2.60 still has).
        return replace(self.so_far(), finished=True) if self.known else self.so_far()

    def _look(self) -> None:
        """Estimate the error of the map at a mark, and note whether it is small enough."""
        schedule = self.job.schedule
        if schedule.precision is not None and self.sweep in schedule.marks:
            self.error = self.so_far().error(self.job.model.cells)
            self.known = self.error <= schedule.precision

    @property
    def sweep(self) -> int:
        """The number of sweeps that all chains have made; -1 while some are not started."""
        return min(group.sweep for group in self.groups)

    def so_far(self) -> Chains:
        """Return all chains at the sweep of the slowest."""
        parts = [group.up_to(self.sweep) for group in self.groups]
        count = self.remote(ray_worker.observed_counts)
        counts = [
            count(self.name, *self.shared, group.chain_ids, part.snapshot, to_see(part.draws))
            for group, part in zip(self.groups, parts, strict=True)
        ]
        return join([
            replace(
                part, observed_counts=outcome(self.ray, observed_counts),
                seconds={**part.seconds, "trace": part.seconds["trace"] + self.trace_s},
            )
            for part, observed_counts in zip(parts, counts, strict=True)
        ])  # fmt: skip

    def _share(self) -> None:
        """Put the model and what the sampler prepares of it into the object store."""
        job, ray, beams = self.job, self.ray, self.job.model.scans.n_beams
        model = ray.put(replace(job, threads=self.executor.cpus_per_task))
        self.watch.report("trace", 0, beams)
        problem, seconds = self.remote(ray_worker.prepare, num_returns=2)(model, __version__)
        self.trace_s = outcome(ray, seconds)
        self.watch.report("trace", beams, beams)
        self.shared = (model, [problem])

    def _note(self, group: Group, segment: Chains) -> None:
        """Keep the result of a task, and report the progress of all chains."""
        made = segment.sweep - max(group.sweep, 0)
        group.snapshots[segment.sweep] = segment.snapshot
        group.segments.append(replace(segment, snapshot=Snapshot(segment.sweep)))
        if made > 0:
            self.marks.per_sweep_s = max(self.marks.per_sweep_s, segment.seconds["sampling"] / made)
        schedule, done = self.job.schedule, self.sweep
        if segment.sweep == 0 or done < 0:
            started = sum(group.sweep >= 0 for group in self.groups)
            self.watch.report("start", started, len(self.groups))
        elif done > 0:
            warming = done <= schedule.warmup
            log_joint = segment.log_joint if segment.log_joint.size else segment.warmup_log_joint
            mean = float(log_joint[:, -1].mean()) if log_joint.size else None
            self.watch.report("warm-up" if warming else "draws", done, schedule.sweeps, mean, self.error)
