"""Run chains in segments, as tasks of a Ray worker for `bayesmap.run.ray_executor`.

A segment is a number of consecutive sweeps. A worker process caches the problem, and the chains of its last segment,
for later segments. This only saves time: the arguments of a segment suffice to run it in a new process.
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

    The job has its problem prepared. ``until`` is the number of sweeps at the end; 0 only starts the chains. Observed
    cells are counted later, by `observed_counts`. The statistics of the start are empty with ``resume``. ``state`` is
    the state of the chains, if this process still has it from the segment before.
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
    """Prepare the job's problem. Returns the problem, and the seconds spent.

    Raises `BadInput` if the versions of bayesmap here and in the calling process differ, or the sampler cannot sample
    the model.
    """
    if version != __version__:
        raise BadInput(
            f"RayExecutor: a worker has bayesmap {__version__}, this process {version}; install one on all nodes"
        )
    began = time.perf_counter()
    return job.sampler.prepare(job.model_to_trace, job.device, job.threads), time.perf_counter() - began


def cached(run: str, job: Job, problem: list[Any]) -> Cached:
    """Return this process's cached problem of a run; fetch it from the object store on first use.

    The reference to the problem stands in a list: Ray would fetch a bare reference for every segment.
    """
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
    """Count observed cells of chains at a snapshot, see `Sampler.observed_counts`; `to_see` selects the draws."""
    state = job.sampler.init(cached(run, job, problem).problem, chain_ids, job.seed, snapshot)
    return job.sampler.observed_counts(state, draws)
