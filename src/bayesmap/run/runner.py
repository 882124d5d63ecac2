"""The one runner of all chains: an iterator of (state, info), and a loop that stores draws and writes checkpoints.

All chains of a process advance together, in steps of about a quarter of a second of work. Between two steps they have
made the same number of sweeps. So a checkpoint holds the state of each chain, this number, and the draws so far.
`bayesmap.infer`, the page and the workers of a cluster either iterate over `sweeps`, or let `run_chains` store the
draws. An `Executor` decides where the chains of a job run.
"""

from __future__ import annotations

import contextlib
import signal
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from types import FrameType
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import Draws
from bayesmap.model import Model
from bayesmap.run.chains import Chains, EndRule, Record, SweepPlan, map_error, observed_cells
from bayesmap.samplers.fit import Parameters
from bayesmap.samplers.sampler import PILOT, SILENT, ChainState, Info, Keep, Sampler, Snapshot, Watch, draws_to_inspect


@contextlib.contextmanager
def stop_on_interrupt() -> Iterator[Callable[[], bool]]:
    """Make the yielded function return True after the first Ctrl-C; a second one interrupts at once.

    It always returns False outside the main thread, in which alone Python handles signals, and in a process that was
    started to ignore Ctrl-C, as shells start background jobs of a script.
    """
    stopped = False

    def handle(number: int, frame: FrameType | None) -> None:
        nonlocal stopped
        if stopped:
            raise KeyboardInterrupt
        stopped = True

    in_main_thread = threading.current_thread() is threading.main_thread()
    if not in_main_thread or signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        yield lambda: False
        return
    before = signal.signal(signal.SIGINT, handle)
    try:
        yield lambda: stopped
    finally:
        signal.signal(signal.SIGINT, signal.SIG_DFL if before is None else before)


STEP_SECONDS = 0.25  # of work per step
SECONDS_PER_INCIDENCE = 2e-8  # a first guess, for the first step; later steps use the measured time
FIRST_STEP = 16  # most sweeps of the first step
STEP_GROWTH = 16  # largest ratio of the sweeps of a step to the sweeps of the step before
BUFFER_BYTES = 64 << 20  # most bytes of the draws of one step
CHECKPOINT_SHARE = 0.05  # largest share of the time that checkpoints may take


@dataclass(frozen=True, eq=False)
class Job:
    """Chains of one posterior, with all that a process needs to run them."""

    model: Model
    sampler: Sampler[Any, Any]
    schedule: SweepPlan
    seed: int
    chain_ids: tuple[int, ...]  # numbers of the chains among all chains of the run
    device: str = "cpu"
    threads: int | None = None  # all cores if None
    parameters: Parameters | None = None  # sensor and prior that were fitted beforehand; None: the model's
    problem: Any = None  # the sampler's prepared problem, if this process has it already

    @property
    def model_to_trace(self) -> Model:
        """The model with the fitted sensor, whose noise decides how far beams are traced."""
        return self.model if self.parameters is None else replace(self.model, sensor=self.parameters.sensor)


def sweeps(
    sampler: Sampler[Any, Any], state: Any, until: int, *, keep: Keep = Keep(), beta: float = 1.0,
    step_seconds: float | None = None, most_kept: int | None = None, stops: tuple[int, ...] = (),
) -> Iterator[tuple[Any, Info]]:  # fmt: skip
    """Advance chains step by step until they have made ``until`` sweeps: yield (state, info) after each step.

    The number of sweeps in a step depends on their speed; the draws do not. A step takes about ``step_seconds``
    (`STEP_SECONDS` if None), keeps at most ``most_kept`` draws, and ends at each number of sweeps in ``stops``.
    """
    seconds = STEP_SECONDS if step_seconds is None else step_seconds
    per_sweep_s, most = SECONDS_PER_INCIDENCE * state.problem.n_incidences, FIRST_STEP
    while state.sweep < until:
        # Sweeps of this step: by the measured speed, up to the next stop, and with few enough draws.
        count = int(max(1, min(seconds / per_sweep_s if per_sweep_s > 0 else most, most, until - state.sweep)))
        count = min([count, *(stop - state.sweep for stop in stops if stop > state.sweep)])
        if most_kept is not None and keep.every:
            kept = keep.sweeps(state.sweep, state.sweep + count)
            count = kept[most_kept - 1] - state.sweep if len(kept) > most_kept else count
        began = time.perf_counter()
        state, info = sampler.step(state, count, beta, keep)
        per_sweep_s, most = (time.perf_counter() - began) / count, STEP_GROWTH * count
        yield state, info


def start_chains(job: Job, resume: Chains | None = None, watch: Watch = SILENT) -> tuple[ChainState, dict[str, float]]:
    """Start or continue the chains of a job. Returns their state, and the seconds spent, by phase."""
    began = time.perf_counter()
    problem = job.problem
    if problem is None:
        problem = job.sampler.prepare(job.model_to_trace, job.device, job.threads, watch)
    if job.parameters is not None:
        problem = problem.under(job.parameters.sensor, job.parameters.prior)
    traced = time.perf_counter()
    snapshot = None if resume is None else resume.snapshot
    state = job.sampler.init(problem, job.chain_ids, job.seed, snapshot, watch)
    return state, {"trace": traced - began, "warm_start": time.perf_counter() - traced, "sampling": 0.0}


def no_draws(model: Model, state: ChainState, chains: int) -> Draws:
    """Return the empty draws of a model, for a number of chains."""
    empty = Draws(model.grid, model.arrays, {}, state.problem.coordinates)
    return replace(empty, arrays={spec.name: spec.empty(chains, 0, empty.shape_of(spec)) for spec in empty.specs})


FIRST_MAP_SWEEPS = 5  # sweeps of the chain that draws a first map: its walls are where they stay, but still thick


def first_map(sampler: Sampler[Any, Any], problem: Any, model: Model, seed: int) -> tuple[Chains, float]:
    """Draw a first, rough map with a short chain of its own. Returns it, and the seconds of a sweep on all threads."""
    state = sampler.init(problem, [PILOT], seed)
    state, _ = sampler.step(state, 1)  # a first sweep is slower
    began = time.perf_counter()
    state, _ = sampler.step(state, FIRST_MAP_SWEEPS - 2)
    seconds = (time.perf_counter() - began) / (FIRST_MAP_SWEEPS - 2)
    state, info = sampler.step(state, 1, keep=Keep(state.sweep, 1))
    draws = replace(no_draws(model, state, 1), arrays=info.draws)
    chains = Chains(
        draws, info.log_likelihood, info.log_prior, np.zeros((1, 0)), Snapshot(0),
        sampler.observed_counts(state, draws_to_inspect(draws)), {}, problem.n_incidences, {}, finished=False,
    )  # fmt: skip
    return chains, seconds


def run_chains(
    job: Job, *, resume: Chains | None = None, watch: Watch = SILENT,
    on_checkpoint: Callable[[Chains], None] | None = None, checkpoint_every_s: float = 30.0,
) -> Chains:  # fmt: skip
    """Run warm-up and draws of all chains of a job in this process, or continue the chains of ``resume``, bit for bit.

    The watch gets progress after every step, and may stop the chains between two steps: then they are not ``finished``,
    even in the last step. ``on_checkpoint`` gets the chains so far at the end of warm-up, and every
    ``checkpoint_every_s`` seconds; less often if it would take more than 5 % of the time.
    """
    # Start the chains, and make room for their draws.
    schedule, chains = job.schedule, len(job.chain_ids)
    state, seconds = start_chains(job, resume, watch)
    statistics = state.statistics
    if resume is not None:
        seconds = {name: spent + resume.seconds.get(name, 0.0) for name, spent in seconds.items()}
        statistics = resume.statistics
    empty = no_draws(job.model, state, chains)
    record = Record(empty, schedule, resume)
    draw_bytes = sum(spec.empty(chains, 1, empty.shape_of(spec)).nbytes for spec in empty.specs)

    def observed_counts() -> NDArray[np.int32]:
        return job.sampler.observed_counts(state, draws_to_inspect(record.draws))

    def so_far() -> Chains:
        return record.chains(
            snapshot=job.sampler.snapshot(state), finished=False, statistics=statistics,
            observed_counts=observed_counts(), n_incidences=state.problem.n_incidences, seconds=dict(seconds),
        )  # fmt: skip

    steps = sweeps(
        job.sampler, state, schedule.sweeps, keep=schedule.keep, most_kept=max(1, BUFFER_BYTES // max(draw_bytes, 1)),
        stops=(schedule.warmup, *schedule.marks),
    )  # fmt: skip

    def error() -> float:
        return map_error(job.model.cells, record.draws, observed_cells(observed_counts()))

    rule = EndRule(schedule, error)
    rule.check(state.sweep)  # a resumed run may stand at a mark
    # Advance step by step: record draws, look at the error, report, write checkpoints.
    checkpoints = CheckpointTimer(on_checkpoint, checkpoint_every_s)
    began, before = time.perf_counter(), state.sweep
    stopped = watch.should_stop()
    while not (stopped or rule.reached):
        state, info = next(steps, (state, None))
        if info is None:
            break
        record.add(info, before)
        seconds["sampling"] += time.perf_counter() - began
        warming = before < schedule.warmup
        before = state.sweep
        log_joint = float(np.mean(info.log_likelihood[:, -1] + info.log_prior[:, -1]))
        rule.check(state.sweep)
        total = rule.expected_sweeps(state.sweep)
        watch.report(
            "warm-up" if warming else "draws", state.sweep, total, log_joint, rule.error, schedule.warmup,
            rule.end_is_open,
        )  # fmt: skip
        checkpoints.offer(so_far, at_once=warming and state.sweep == schedule.warmup)
        began, stopped = time.perf_counter(), watch.should_stop()
    # A stop in the last step counts, too: the caller must not begin the work that follows the chains.
    return replace(so_far(), finished=not stopped and (rule.reached or state.sweep >= schedule.sweeps))


class CheckpointTimer:
    """Writes a checkpoint of chains every ``every_s`` seconds, or less often if that takes too much of the time."""

    def __init__(self, write: Callable[[Chains], None] | None, every_s: float) -> None:
        self._write, self._every_s = write, every_s
        self._written_at, self._pause_s = time.monotonic(), every_s

    def offer(self, chains: Callable[[], Chains], at_once: bool) -> None:
        """Write a checkpoint if one is due, or in any case if ``at_once``."""
        began = time.monotonic()
        if self._write is not None and (at_once or began - self._written_at >= self._pause_s):
            self._write(replace(chains(), finished=False))
            self._written_at = time.monotonic()
            self._pause_s = pause_after(self._written_at - began, self._every_s)


def pause_after(checkpoint_s: float, every_s: float) -> float:
    """Return the seconds to the next checkpoint, assumed to take twice as long; 0 stays 0, every step."""
    return max(every_s, 2 * checkpoint_s * (1 / CHECKPOINT_SHARE - 1)) if every_s > 0 else every_s


class Executor(Protocol):
    """Runs the chains of a job on some machine."""

    def run(
        self, job: Job, resume: Chains | None, watch: Watch, on_checkpoint: Callable[[Chains], None] | None,
        checkpoint_every_s: float,
    ) -> Chains:  # fmt: skip
        """Run all chains of the job, see `run_chains`. Returns them in the order of their numbers."""


@dataclass(frozen=True)
class ThreadExecutor:
    """Runs all chains in this process, on its threads or its GPU; ``should_stop`` may stop them, as the watch may."""

    should_stop: Callable[[], bool] = lambda: False

    def run(
        self, job: Job, resume: Chains | None, watch: Watch, on_checkpoint: Callable[[Chains], None] | None,
        checkpoint_every_s: float,
    ) -> Chains:  # fmt: skip
        """Run all chains in this process."""
        both = replace(watch, should_stop=lambda: watch.should_stop() or self.should_stop())
        return run_chains(
            job, resume=resume, watch=both, on_checkpoint=on_checkpoint, checkpoint_every_s=checkpoint_every_s
        )
