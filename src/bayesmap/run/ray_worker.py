"""Run chains in segments, and the tasks of a Ray worker that do so for `bayesmap.run.ray_executor`.

A segment is some consecutive sweeps. It depends on the job, the numbers of its chains and where they stood, and on
nothing else. So a segment that is lost with the machine that made it can be made again elsewhere, with the same draws.

A worker process keeps the problem, and the chains of its last segment, for the segments to come. This saves time only:
the arguments of the next segment hold all that a process has lost.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.run.chains import Chains, Record, SweepPlan
from bayesmap.run.runner import Job, no_draws, sweeps
from bayesmap.samplers.sampler import ChainState, Snapshot
from bayesmap.version import __version__


def run_segment(
    job: Job, until: int, resume: Snapshot | None, state: ChainState | None = None
) -> tuple[Chains, ChainState]:
    """Run the chains of a job up to a number of sweeps. Returns the new draws of the chains, and their state.

    It leaves counting the observed cells to `observed_counts`. The statistics of the start are empty with ``resume``.

    Args:
        job: with its problem prepared.
        until: sweeps that each chain will have made; 0 only starts them.
        resume: where the chains stand; None starts them.
        state: the chains themselves, where this process still has them from the segment before.
    """
    schedule, keep = job.schedule, job.schedule.keep
    began = time.perf_counter()
    if state is None:
        state = job.sampler.init(job.problem, job.chain_ids, job.seed, resume)
    assert state is not None
    started = time.perf_counter()
    begin, statistics = state.sweep, state.statistics if resume is None else {}
    empty = no_draws(job.model, state, len(job.chain_ids))
    kept = len(keep.sweeps(begin, until)) if schedule.draws else 0
    record, before = Record(empty, SweepPlan(schedule.warmup, kept, schedule.thin)), begin
    for now, info in sweeps(job.sampler, state, until, keep=keep):
        record.add(info, before)
        before, state = now.sweep, now
    seconds = {"trace": 0.0, "warm_start": started - began, "sampling": time.perf_counter() - started}
    segment = record.chains(
        snapshot=job.sampler.snapshot(state), finished=state.sweep >= schedule.sweeps, statistics=statistics,
        observed_counts=np.zeros((2, 0, 0), dtype=np.int32), n_incidences=state.problem.n_incidences, seconds=seconds,
    )  # fmt: skip
    return segment, state


@dataclass
class Held:
    """The problem and the chains that this process keeps from task to task.

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
) -> Chains:
    """Run some chains of a job up to a number of sweeps; see `run_segment`."""
    here = held(run, job, problem)
    ids, state = here.chains or ((), None)
    here.chains = None
    if state is not None and (ids != chain_ids or resume is None or state.sweep != resume.sweep):
        state = None
    job = replace(job, problem=here.problem, chain_ids=chain_ids)
    segment, state = run_segment(job, until, resume, state)
    here.chains = (chain_ids, state)
    return segment


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
