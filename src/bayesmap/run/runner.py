"""The runner of all chains: start them, advance them step by step, store their draws, and write checkpoints.

All chains of a process advance together, in steps of about a quarter of a second of work. After each step all of them
have made the same number of sweeps. So a checkpoint holds the state of each chain, this number, and the draws so far.

Read `Job` (what to run), `run_chains` (the loop), and `advance_chains` (the steps, which the page iterates itself). An
`Executor` decides where the chains of a job run.
"""

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
from bayesmap.run.chains import Chains, DrawRecord, StoppingRule, SweepPlan, map_error, observed_cells
from bayesmap.samplers.fit import FIRST_FIT_SWEEP, Parameters
from bayesmap.samplers.sampler import PILOT, SILENT, ChainState, Info, Keep, Sampler, Snapshot, Watch, draws_to_inspect

STEP_SECONDS = 0.25  # seconds of work per step
SECONDS_PER_INCIDENCE = 2e-8  # a first guess, for the first step; later steps use the measured time
MAX_FIRST_STEP_SWEEPS = 16  # a limit, because the first guess of the speed may be far off
MAX_STEP_GROWTH = 16  # largest ratio of the sweeps of a step to the sweeps of the step before
MAX_BUFFER_BYTES = 64 << 20  # size of the draws of one step
MAX_CHECKPOINT_SHARE = 0.05  # largest share of the time that checkpoints may take
FIRST_MAP_SWEEPS = FIRST_FIT_SWEEP  # sweeps of the pilot: its walls are in place but still thick, and a fit can go on
OnCheckpoint = Callable[[Chains], None] | None  # saves the chains so far


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
    parameters: Parameters | None = None  # sensor and prior that were fitted beforehand; if None, the model's
    problem: Any = None  # the sampler's prepared problem, if this process has it already

    @property
    def model_to_trace(self) -> Model:
        """The model with the fitted sensor, whose noise decides how far beams are traced."""
        return self.model if self.parameters is None else replace(self.model, sensor=self.parameters.sensor)


def run_chains(
    job: Job, *, resume: Chains | None = None, watch: Watch = SILENT, on_checkpoint: OnCheckpoint = None,
    checkpoint_every_s: float = 30.0,
) -> Chains:  # fmt: skip
    """Run all chains of a job in this process, or continue the chains of ``resume``, bit for bit.

    The watch gets progress after every step, and may stop the chains between two steps. Stopped chains are not
    ``finished``, even if they were stopped in the last step. ``on_checkpoint`` gets the chains so far at the end of
    warm-up, and every ``checkpoint_every_s`` seconds; less often if it would take more than 5 % of the time.
    """
    # Start the chains, and make room for their draws.
    schedule = job.schedule
    running = _RunningChains(job, resume, watch)
    steps = advance_chains(
        job.sampler, running.state, schedule.sweeps, keep=schedule.keep,
        max_kept=max(1, MAX_BUFFER_BYTES // max(running.draw_bytes, 1)), stops=(schedule.warmup, *schedule.marks),
    )  # fmt: skip
    rule = StoppingRule(schedule, running.map_error)
    rule.check(running.sweep)  # a resumed run may stand at a mark
    checkpoints = CheckpointTimer(on_checkpoint, checkpoint_every_s)
    # Advance step by step until the last sweep, the stopping rule, or a stop by the user.
    began_s = time.perf_counter()
    stopped = watch.should_stop()
    while not (stopped or rule.is_met):
        step = next(steps, None)
        if step is None:
            break
        state, info = step
        is_warmup = running.sweep < schedule.warmup
        running.record_step(state, info)
        running.seconds["sampling"] += time.perf_counter() - began_s
        # Look at the error, report the progress, and write a checkpoint if one is due.
        sweep = running.sweep
        log_joint = float(np.mean(info.log_likelihood[:, -1] + info.log_prior[:, -1]))
        rule.check(sweep)
        watch.report(
            "warm-up" if is_warmup else "draws", done=sweep, total=rule.expected_sweeps(sweep), log_joint=log_joint,
            error=rule.error, warmup=schedule.warmup, end_is_open=rule.end_is_open,
        )  # fmt: skip
        checkpoints.offer(running.results, at_once=is_warmup and sweep == schedule.warmup)
        began_s, stopped = time.perf_counter(), watch.should_stop()
    # A stop in the last step counts, too: the caller must not begin the work that follows the chains.
    return replace(running.results(), finished=not stopped and (rule.is_met or running.sweep >= schedule.sweeps))


class _RunningChains:
    """The chains of a job in this process: their present state, their draws so far, and the seconds spent."""

    def __init__(self, job: Job, resume: Chains | None, watch: Watch) -> None:
        self._job = job
        began_s = time.perf_counter()
        problem = job.problem
        if problem is None:
            problem = job.sampler.prepare(job.model_to_trace, job.device, job.threads, watch)
        if job.parameters is not None:
            problem = problem.under(job.parameters.sensor, job.parameters.prior)
        traced_s = time.perf_counter()
        snapshot = None if resume is None else resume.snapshot
        self.state: ChainState = job.sampler.init(problem, job.chain_ids, job.seed, snapshot, watch)
        self.seconds = {"trace": traced_s - began_s, "warm_start": time.perf_counter() - traced_s, "sampling": 0.0}
        self.sweep = self.state.sweep  # number of sweeps of each chain; a state must not be read after a step from it
        self._statistics = self.state.statistics
        if resume is not None:
            self.seconds = {name: spent + resume.seconds.get(name, 0.0) for name, spent in self.seconds.items()}
            self._statistics = resume.statistics
        empty = empty_draws(job.model, self.state, len(job.chain_ids))
        self._record = DrawRecord(empty, job.schedule, resume)
        self.draw_bytes = sum(spec.empty(len(job.chain_ids), 1, empty.shape_of(spec)).nbytes for spec in empty.specs)

    def record_step(self, state: ChainState, info: Info) -> None:
        """Store the draws of a step and the state after it."""
        self._record.add(info, self.sweep)
        self.state, self.sweep = state, state.sweep

    def map_error(self) -> float:
        """Estimate the error of the mean map from the draws so far."""
        return map_error(self._job.model.cells, self._record.draws, observed_cells(self._observed_counts()))

    def results(self) -> Chains:
        """Return draws and states so far, as not finished."""
        return self._record.chains(
            snapshot=self._job.sampler.snapshot(self.state), finished=False, statistics=self._statistics,
            observed_counts=self._observed_counts(), n_incidences=self.state.problem.n_incidences,
            seconds=dict(self.seconds),
        )  # fmt: skip

    def _observed_counts(self) -> NDArray[np.int32]:
        return self._job.sampler.observed_counts(self.state, draws_to_inspect(self._record.draws))


def advance_chains(
    sampler: Sampler[Any, Any], state: Any, until: int, *, keep: Keep = Keep(), step_seconds: float | None = None,
    max_kept: int | None = None, stops: tuple[int, ...] = (),
) -> Iterator[tuple[Any, Info]]:  # fmt: skip
    """Advance chains step by step until they have made ``until`` sweeps: yield (state, info) after each step.
    The number of sweeps in a step depends on their speed; the draws do not. A step takes about ``step_seconds``
    (`STEP_SECONDS` if None), keeps at most ``max_kept`` draws, and ends at each number of sweeps in ``stops``.
    """
    seconds = STEP_SECONDS if step_seconds is None else step_seconds
    per_sweep_s = SECONDS_PER_INCIDENCE * state.problem.n_incidences
    max_sweeps = MAX_FIRST_STEP_SWEEPS
    while state.sweep < until:
        # Limit the sweeps of this step by the measured speed, by the next stop, and by the memory for draws.
        affordable = seconds / per_sweep_s if per_sweep_s > 0 else max_sweeps
        count = int(max(1, min(affordable, max_sweeps, until - state.sweep)))
        count = min([count, *(stop - state.sweep for stop in stops if stop > state.sweep)])
        if max_kept is not None and keep.every:
            kept_sweeps = keep.sweeps(state.sweep, state.sweep + count)
            count = kept_sweeps[max_kept - 1] - state.sweep if len(kept_sweeps) > max_kept else count
        began_s = time.perf_counter()
        state, info = sampler.step(state, count, keep=keep)
        per_sweep_s, max_sweeps = (time.perf_counter() - began_s) / count, MAX_STEP_GROWTH * count
        yield state, info


def empty_draws(model: Model, state: ChainState, chains: int) -> Draws:
    """Return a record of no draws of a model, with arrays of the right shapes for a number of chains."""
    empty = Draws(model.grid, model.arrays, {}, state.problem.coordinates)
    return replace(empty, arrays={spec.name: spec.empty(chains, 0, empty.shape_of(spec)) for spec in empty.specs})


class CheckpointTimer:
    """Writes a checkpoint of chains every ``every_s`` seconds, or less often if that takes too much of the time."""

    def __init__(self, write: OnCheckpoint, every_s: float) -> None:
        self._write, self._every_s = write, every_s
        self._written_at_s, self._pause_s = time.monotonic(), every_s

    def offer(self, chains: Callable[[], Chains], at_once: bool) -> None:
        """Write a checkpoint if one is due, or in any case if ``at_once``. ``chains`` returns what to save."""
        began_s = time.monotonic()
        if self._write is not None and (at_once or began_s - self._written_at_s >= self._pause_s):
            self._write(replace(chains(), finished=False))
            self._written_at_s = time.monotonic()
            self._pause_s = checkpoint_pause_s(self._written_at_s - began_s, self._every_s)


def checkpoint_pause_s(checkpoint_s: float, every_s: float) -> float:
    """Return the seconds to the next checkpoint, assumed to take twice as long. 0 stays 0: every step."""
    return max(every_s, 2 * checkpoint_s * (1 / MAX_CHECKPOINT_SHARE - 1)) if every_s > 0 else every_s


class Executor(Protocol):
    """Runs the chains of a job on some machine."""

    def run(
        self, job: Job, resume: Chains | None, watch: Watch, on_checkpoint: OnCheckpoint, checkpoint_every_s: float
    ) -> Chains:
        """Run all chains of the job, see `run_chains`. Returns them in the order of their numbers."""


@dataclass(frozen=True)
class ThreadExecutor:
    """Runs all chains in this process, on its threads or its GPU; ``should_stop`` may stop them, as the watch may."""

    should_stop: Callable[[], bool] = lambda: False

    def run(
        self, job: Job, resume: Chains | None, watch: Watch, on_checkpoint: OnCheckpoint, checkpoint_every_s: float
    ) -> Chains:
        """Run all chains in this process."""
        both = replace(watch, should_stop=lambda: watch.should_stop() or self.should_stop())
        return run_chains(
            job, resume=resume, watch=both, on_checkpoint=on_checkpoint, checkpoint_every_s=checkpoint_every_s
        )


def draw_first_map(sampler: Sampler[Any, Any], problem: Any, model: Model, seed: int) -> tuple[Chains, float, Any]:
    """Draw a first, rough map by the pilot. Returns it, seconds of a sweep on all threads, and the pilot's state."""
    state = sampler.init(problem, [PILOT], seed)
    state, _ = sampler.step(state, 1)  # a first sweep is slower, so it is not timed
    began_s = time.perf_counter()
    state, _ = sampler.step(state, FIRST_MAP_SWEEPS - 2)
    sweep_s = (time.perf_counter() - began_s) / (FIRST_MAP_SWEEPS - 2)
    state, info = sampler.step(state, 1, keep=Keep(state.sweep, 1))
    draws = replace(empty_draws(model, state, 1), arrays=info.draws)
    chains = Chains(
        draws=draws, log_likelihood=info.log_likelihood, log_prior=info.log_prior, warmup_log_joint=np.zeros((1, 0)),
        observed_counts=sampler.observed_counts(state, draws_to_inspect(draws)), n_incidences=problem.n_incidences,
        snapshot=Snapshot(0), statistics={}, seconds={}, finished=False,
    )  # fmt: skip
    return chains, sweep_s, state


@contextlib.contextmanager
def stop_on_interrupt() -> Iterator[Callable[[], bool]]:
    """Yield a function that returns True after the first Ctrl-C; a second Ctrl-C interrupts at once.
    The function always returns False outside the main thread, because Python handles signals only there, and in a
    process that was started to ignore Ctrl-C, as shells start background jobs of a script.
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
    handler_before = signal.signal(signal.SIGINT, handle)
    try:
        yield lambda: stopped
    finally:
        signal.signal(signal.SIGINT, signal.SIG_DFL if handler_before is None else handler_before)
