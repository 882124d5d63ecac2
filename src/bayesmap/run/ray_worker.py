"""Run chains in segments, and the tasks of a Ray worker that do so for `bayesmap.run.ray_executor`.

A segment is some consecutive sweeps. It depends on the job, the numbers of its chains and where they stood, and on
nothing else. So a segment that is lost with the machine that made it can be made again elsewhere, with the same draws.

A worker process keeps the problem, and the chains of its last segment, for the segments to come. This saves time only:
the arguments of the next segment hold all that a process has lost.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import Draws
from bayesmap.errors import BadInput
from bayesmap.run.chains import Chains, Record, SweepPlan
from bayesmap.run.runner import Job, no_draws, sweeps
from bayesmap.samplers.sampler import ChainState, Snapshot
from bayesmap.version import __version__

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Segment:
    """What some chains did between two numbers of sweeps.

    Attributes:
        begin, end: sweeps that each chain had made before it, and after it.
        draws: the maps that were kept in it.
        log_likelihood, log_prior: of each of these, (chains, kept).
        warmup_log_joint: of each warm-up sweep in it, (chains, warm-up sweeps).
        statistics: results of the start, by name; empty unless the segment starts the chains.
        n_incidences: how many cells all beams cross together.
        seconds: spent at the start ("warm_start") and in sweeps ("sampling").
    """

    begin: int
    end: int
    draws: Draws
    log_likelihood: Floats
    log_prior: Floats
    warmup_log_joint: Floats
    statistics: Mapping[str, Floats]
    n_incidences: int
    seconds: Mapping[str, float]

    @property
    def last_log_joint(self) -> float | None:
        """Mean over chains of the log joint of its last kept draw, else of its last warm-up sweep; None without."""
        joint = self.log_likelihood + self.log_prior if self.log_likelihood.size else self.warmup_log_joint
        return float(joint[:, -1].mean()) if joint.size else None


def run_segment(
    job: Job, until: int, resume: Snapshot | None, state: ChainState | None = None
) -> tuple[Segment, Snapshot, ChainState]:
    """Run the chains of a job up to a number of sweeps.

    Args:
        job: with its problem prepared.
        until: sweeps that each chain will have made; 0 only starts them.
        resume: where the chains stand; None starts them.
        state: the chains themselves, where this process still has them from the segment before.

    Returns:
        The segment, where the chains stand after it, and the chains.
    """
    schedule, keep = job.schedule, job.schedule.keep
    began = time.perf_counter()
    if state is None:
        state = job.sampler.init(job.problem, job.chain_ids, job.seed, resume)
    assert state is not None
    started = time.perf_counter()
    begin, statistics = state.sweep, state.statistics if resume is None else {}
    empty = no_draws(job.model, state, len(job.chain_ids))
    room = SweepPlan(schedule.warmup, len(keep.sweeps(begin, until)) if schedule.draws else 0, schedule.thin)
    record, before = Record(empty, room, keep), begin
    for now, info in sweeps(job.sampler, state, until, keep=keep):
        record.add(info, before)
        before, state = now.sweep, now
    log_likelihood, log_prior, warmup = record.log_densities
    seconds = {"warm_start": started - began, "sampling": time.perf_counter() - started}
    segment = Segment(
        begin, state.sweep, record.draws, log_likelihood, log_prior, warmup, statistics, state.problem.n_incidences,
        seconds,
    )  # fmt: skip
    return segment, job.sampler.snapshot(state), state


def chains_of_segments(
    segments: Sequence[Segment], snapshot: Snapshot, trace_s: float, schedule: SweepPlan, resume: Chains | None = None
) -> Chains:
    """Join segments that follow each other, as if the chains had never been interrupted.

    Args:
        segments: of some chains, in order, each beginning where the one before it ended; at least one.
        snapshot: where the chains stand after the last.
        trace_s: seconds that preparing the problem took.
        schedule: of the job.
        resume: what the chains had done before the first segment.

    Returns:
        The chains. Their ``observed_counts`` are zeros: the sampler alone can count these (`Sampler.observed_counts`).
    """
    first = segments[0]
    draws = [segment.draws.arrays for segment in segments]
    parts = [(segment.log_likelihood, segment.log_prior, segment.warmup_log_joint) for segment in segments]
    spent = {name: sum(segment.seconds[name] for segment in segments) for name in first.seconds} | {"trace": trace_s}
    if resume is not None:
        draws = [resume.draws.arrays, *draws]
        parts = [(resume.log_likelihood, resume.log_prior, resume.warmup_log_joint), *parts]
        spent = {name: seconds + resume.seconds.get(name, 0.0) for name, seconds in spent.items()}
    arrays: dict[str, NDArray[Any]] = {name: np.concatenate([one[name] for one in draws], axis=1) for name in draws[0]}
    log_likelihood, log_prior, warmup = (np.concatenate(kind, axis=1) for kind in zip(*parts, strict=True))
    return Chains(
        draws=replace(first.draws, arrays=arrays), log_likelihood=log_likelihood, log_prior=log_prior,
        warmup_log_joint=warmup, snapshot=snapshot,
        observed_counts=np.zeros((2, *first.draws.grid.shape), dtype=np.int32),
        statistics=first.statistics if resume is None else resume.statistics,
        n_incidences=first.n_incidences, seconds=spent, finished=snapshot.sweep >= schedule.sweeps,
    )  # fmt: skip


def some_chains(chains: Chains, which: slice) -> Chains:
    """Return some of the chains, as if there were no others."""
    draws = replace(chains.draws, arrays={name: array[which] for name, array in chains.draws.arrays.items()})
    snapshot = Snapshot(chains.sweep, {name: array[which] for name, array in chains.snapshot.arrays.items()})
    return replace(
        chains, draws=draws, snapshot=snapshot, log_likelihood=chains.log_likelihood[which],
        log_prior=chains.log_prior[which], warmup_log_joint=chains.warmup_log_joint[which],
    )  # fmt: skip


@dataclass
class Held:
    """What this process keeps from task to task.

    Attributes:
        run: name of the run whose problem it is.
        problem: where the kernels read it.
        chains: of the last segment, by their numbers.
    """

    run: str
    problem: Any
    chains: tuple[tuple[int, ...], ChainState] | None = None


_held: Held | None = None


def prepare(job: Job, version: str) -> tuple[Any, float]:
    """Prepare the job's problem. Returns it, and the seconds that it took.

    Raises:
        BadInput: the versions of bayesmap here and in the calling process differ, or the sampler cannot sample the
            model.
    """
    if version != __version__:
        raise BadInput(
            f"RayExecutor: a worker has bayesmap {__version__}, this process {version}; install one on all nodes"
        )
    began = time.perf_counter()
    return job.sampler.prepare(job.model_to_trace, job.device, job.threads), time.perf_counter() - began


def held(run: str, job: Job, problem: list[Any]) -> Held:
    """Return this process's own problem of a run, under the job's parameters; taken from the object store on first use.

    Args:
        run: name of the run.
        job: of it.
        problem: the reference to the problem, in a list: Ray would fetch a bare one for every segment.
    """
    global _held  # noqa: PLW0603 -- one a process, as the worker is
    if _held is None or _held.run != run:
        import ray

        prepared = ray.get(problem[0])
        if job.parameters is not None:
            prepared = prepared.under(job.parameters.sensor, job.parameters.prior)
        _held = Held(run, prepared)
    return _held


def advance(
    run: str, job: Job, problem: list[Any], chain_ids: tuple[int, ...], until: int, resume: Snapshot | None
) -> tuple[Segment, Snapshot]:
    """Run some chains of a job up to a number of sweeps; see `bayesmap.run.ray_worker.run_segment`."""
    here = held(run, job, problem)
    ids, state = here.chains or ((), None)
    here.chains = None
    if state is None or ids != chain_ids or resume is None or state.sweep != resume.sweep:
        state = None
    segment, snapshot, state = run_segment(
        replace(job, problem=here.problem, chain_ids=chain_ids), until, resume, state
    )
    here.chains = (chain_ids, state)
    return segment, snapshot


def observed_counts(
    run: str,
    job: Job,
    problem: list[Any],
    chain_ids: tuple[int, ...],
    snapshot: Snapshot,
    draws: Mapping[str, NDArray[Any]],
) -> NDArray[np.int32]:
    """Compute `bayesmap.samplers.sampler.Sampler.observed_counts` of chains at a snapshot; the draws are those of
    `to_see`.
    """
    here = held(run, job, problem)
    state = job.sampler.init(here.problem, chain_ids, job.seed, snapshot)
    return job.sampler.observed_counts(state, draws)
