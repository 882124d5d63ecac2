"""The tasks of a worker of a Ray cluster, for `bayesmap.run.ray_executor`: prepare a problem, and run segments of
chains.

A worker process keeps the problem, and the chains of its last segment, for the segments to come. They are a
convenience: whatever a process has lost, the arguments of the next segment hold.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.run.runner import Job
from bayesmap.run.segments import Segment, run_segment
from bayesmap.samplers.sampler import ChainState, Snapshot
from bayesmap.version import __version__


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
    """Run some chains of a job up to a number of sweeps; see `bayesmap.run.segments.run_segment`."""
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
