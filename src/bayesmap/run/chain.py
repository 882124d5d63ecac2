"""The one chain runner: all chains abreast, in short steps, with progress, checkpoints and a clean stop.

Chains advance together: between two steps they have all made the same number of sweeps, so a checkpoint is just the
walls of each chain, that number, and the draws so far. A step is about a quarter of a second of work.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.sampler import Info, State, WallSampler

STEP_SECONDS = 0.25
SECONDS_PER_INCIDENCE = 2e-8  # a first guess, for the first step
BUFFER_BYTES = 64 << 20  # draws of one step, before they are packed
CHECKPOINT_SHARE = 0.1  # of the time, at most


@dataclass(frozen=True, eq=False)
class Chains:
    """What the chains have done so far.

    Attributes:
        packed: kept maps, eight cells to a byte, shape (chains, kept, ceil(N / 8)).
        log_likelihood, log_prior: the two parts of log p(walls, readings), one column for each kept draw.
        warmup_log_joint: log p(walls, readings) after each warm-up sweep, (chains, done warm-up sweeps).
        walls: where the chains stand, (chains, N).
        sweep: sweeps made, warm-up included.
        seconds: time spent in sweeps.
        finished: whether all draws are there.
    """

    packed: NDArray[np.uint8]
    log_likelihood: NDArray[np.float64]
    log_prior: NDArray[np.float64]
    warmup_log_joint: NDArray[np.float64]
    walls: NDArray[np.uint8]
    sweep: int
    seconds: float
    finished: bool

    @property
    def log_joint(self) -> NDArray[np.float64]:
        """Log p(walls, readings) of every kept draw, (chains, kept)."""
        return self.log_likelihood + self.log_prior


@dataclass(frozen=True)
class Schedule:
    """How long to run: ``warmup`` sweeps that are not kept, then ``draws`` maps, ``thin`` sweeps apart."""

    warmup: int
    draws: int
    thin: int = 1

    @property
    def sweeps(self) -> int:
        """All sweeps of one chain."""
        return self.warmup + self.draws * self.thin


@dataclass(frozen=True)
class Progress:
    """Told after every step: sweeps done and to do, and the latest log joint of each chain."""

    done: int
    total: int
    log_joint: NDArray[np.float64]
    warming_up: bool


def run_chains(
    sampler: WallSampler,
    starts: NDArray[np.bool_],
    schedule: Schedule,
    seed: int,
    *,
    threads: int | None = None,
    resume: Chains | None = None,
    on_progress: Callable[[Progress], None] | None = None,
    on_checkpoint: Callable[[Chains], None] | None = None,
    checkpoint_every_s: float = 30.0,
    should_stop: Callable[[], bool] = lambda: False,
) -> Chains:
    """Run warm-up and draws of all chains.

    Args:
        sampler: what a sweep is.
        starts: one map a chain, (chains, nx, ny); not looked at when resuming.
        schedule: how many sweeps, and which are kept.
        seed: of the sweeps' random numbers.
        threads: chains that run at once; all cores if None. The result does not depend on it.
        resume: continue these chains, with the same sampler, schedule and seed: the result is bit for bit that of
            chains that never stopped.
        on_progress: told after every step.
        on_checkpoint: given the chains so far at the end of warm-up, and every ``checkpoint_every_s`` seconds; less
            often where it takes so long that it would hold the chains up.
        checkpoint_every_s: see above.
        should_stop: asked between two steps; when true the chains so far are returned.

    Returns:
        The chains; with ``finished`` false if they were stopped early.
    """
    shape = sampler.problem.table.grid.shape
    if resume is None:
        state = sampler.init(starts, seed)
        record = _Record(len(starts), shape[0] * shape[1], schedule)
    else:
        state = sampler.init(resume.walls.reshape(-1, *shape) != 0, seed, resume.sweep)
        record = _Record.resumed(resume, schedule)

    saved_at, pause_s = time.monotonic(), checkpoint_every_s
    per_sweep = SECONDS_PER_INCIDENCE * sampler.problem.table.n_incidences
    while state.sweep < schedule.sweeps and not should_stop():
        warming = state.sweep < schedule.warmup
        left = (schedule.warmup if warming else schedule.sweeps) - state.sweep
        step = _step_sweeps(left, per_sweep, 1 if warming else schedule.thin, state)
        began = time.perf_counter()
        state, info = sampler.step(state, step, thin=schedule.thin, keep=not warming, threads=threads)
        spent = time.perf_counter() - began
        per_sweep = spent / step
        record.add(info, warming, schedule.thin, spent)
        if on_progress is not None:
            last = info.log_likelihood[:, -1] + info.log_prior[:, -1]
            on_progress(Progress(state.sweep, schedule.sweeps, last, warming))
        warmed_up = warming and state.sweep == schedule.warmup
        now = time.monotonic()
        if on_checkpoint is not None and (warmed_up or now - saved_at > pause_s):
            on_checkpoint(record.chains(state))
            saved_at = time.monotonic()
            pause_s = pause_after(saved_at - now, checkpoint_every_s)
    return replace(record.chains(state), finished=state.sweep >= schedule.sweeps)


def pause_after(checkpoint_s: float, every_s: float) -> float:
    """Seconds to the next checkpoint, where the last one took so long: as asked, if one is asked for at every step."""
    return max(every_s, checkpoint_s * (1 / CHECKPOINT_SHARE - 1)) if every_s > 0 else every_s


def _step_sweeps(left: int, per_sweep_s: float, multiple: int, state: State) -> int:
    """Sweeps of the next step: about `STEP_SECONDS`, within the buffer, a multiple of the thinning."""
    chains, cells = state.chains.shape
    wanted = STEP_SECONDS / per_sweep_s if per_sweep_s > 0 else 1
    room = BUFFER_BYTES / (chains * cells) * multiple
    step = int(max(1, min(wanted, room)))
    return min(left, max(multiple, step // multiple * multiple))


class _Record:
    """Draws and traces, growing as the chains go."""

    def __init__(self, chains: int, cells: int, schedule: Schedule) -> None:
        self.packed = np.zeros((chains, schedule.draws, (cells + 7) // 8), dtype=np.uint8)
        self.log_likelihood = np.zeros((chains, schedule.draws))
        self.log_prior = np.zeros((chains, schedule.draws))
        self.warmup_log_joint = np.zeros((chains, schedule.warmup))
        self.kept = 0
        self.warmed = 0
        self.seconds = 0.0

    @classmethod
    def resumed(cls, chains: Chains, schedule: Schedule) -> _Record:
        record = cls(chains.walls.shape[0], chains.walls.shape[1], schedule)
        record.kept = chains.packed.shape[1]
        record.warmed = chains.warmup_log_joint.shape[1]
        record.packed[:, : record.kept] = chains.packed
        record.log_likelihood[:, : record.kept] = chains.log_likelihood
        record.log_prior[:, : record.kept] = chains.log_prior
        record.warmup_log_joint[:, : record.warmed] = chains.warmup_log_joint
        record.seconds = chains.seconds
        return record

    def add(self, info: Info, warming: bool, thin: int, seconds: float) -> None:
        self.seconds += seconds
        if warming:
            steps = info.log_likelihood.shape[1]
            joint = info.log_likelihood + info.log_prior
            self.warmup_log_joint[:, self.warmed : self.warmed + steps] = joint
            self.warmed += steps
            return
        new = slice(self.kept, self.kept + info.draws.shape[1])
        self.packed[:, new] = np.packbits(info.draws, axis=-1)
        self.log_likelihood[:, new] = info.log_likelihood[:, thin - 1 :: thin]
        self.log_prior[:, new] = info.log_prior[:, thin - 1 :: thin]
        self.kept = new.stop

    def chains(self, state: State) -> Chains:
        return Chains(
            packed=self.packed[:, : self.kept],
            log_likelihood=self.log_likelihood[:, : self.kept],
            log_prior=self.log_prior[:, : self.kept],
            warmup_log_joint=self.warmup_log_joint[:, : self.warmed],
            walls=state.walls(),
            sweep=state.sweep,
            seconds=self.seconds,
            finished=False,
        )
