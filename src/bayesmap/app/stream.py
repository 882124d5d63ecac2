"""Chains that are watched while they run: sweeps in short steps, the running mean, the draws where they are kept."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.packing import unpack
from bayesmap.posterior.diagnostics import bulk_ess, rhat
from bayesmap.run.chain import BUFFER_BYTES, SECONDS_PER_INCIDENCE, Chains
from bayesmap.samplers.sampler import WallSampler

CHAINS = 2
STEP_SECONDS = 0.015
"""Of work between two looks at the pipe."""

SECONDS_PER_CELL = 2e-8
DRAW_BYTES = 128 << 20
"""Packed draws of a run; more sweeps than fit are thinned."""

DIAGNOSIS_SHARE = 0.1
"""Of the time that diagnostics of the growing trace may take; they are those of every sweep, as of the last time."""


@dataclass(frozen=True)
class Mixing:
    """R-hat and effective sample size of the log joint, and its last value averaged over the chains."""

    rhat: float
    ess: float
    log_joint: float


class Stream:
    """Some chains from their start to their last sweep.

    Attributes:
        sampler: what a sweep is.
        total: sweeps to do.
        thin: sweeps from one counted map to the next; 1 unless so many are kept that they would not fit.
        state: where the chains stand.
        packed: kept draws, (chains, counted or 0, ceil(N / 8)).
    """

    def __init__(self, sampler: WallSampler, starts: NDArray[np.bool_], total: int, seed: int, *, keep: bool) -> None:
        cells = sampler.problem.table.grid.n_cells
        self.sampler, self.keep = sampler, keep
        size = (cells + 7) // 8
        self.thin = math.ceil(total * CHAINS * size / DRAW_BYTES) if keep else 1
        self.total = math.ceil(total / self.thin) * self.thin
        self.state = sampler.init(starts, seed)
        self.counted = 0
        self.seconds = 0.0
        kept = self.total // self.thin if keep else 0
        self._packed = np.zeros((CHAINS, kept, size), dtype=np.uint8)
        self._sums = np.zeros((CHAINS, cells), dtype=np.int64)
        self._seen = np.zeros(cells, dtype=np.int64)
        self._steps = 0
        self._rhat = self._ess = math.nan
        self._diagnose_at, self._diagnosed = 0.0, 0
        self._log_likelihood = np.zeros((CHAINS, self.total))
        self._log_prior = np.zeros((CHAINS, self.total))
        self._per_sweep = SECONDS_PER_INCIDENCE * sampler.problem.table.n_incidences + SECONDS_PER_CELL * cells

    @property
    def sweep(self) -> int:
        """Sweeps done."""
        return self.state.sweep

    @property
    def done(self) -> bool:
        """Whether all sweeps are."""
        return self.state.sweep >= self.total

    def advance(self) -> None:
        """Some sweeps: about `STEP_SECONDS` of work."""
        room = BUFFER_BYTES // self._sums.size
        wanted = min(int(STEP_SECONDS / self._per_sweep), room * self.thin)
        sweeps = min(self.total - self.sweep, max(1, wanted // self.thin) * self.thin)
        before = self.sweep
        began = time.perf_counter()
        self.state, info = self.sampler.step(self.state, sweeps, thin=self.thin)
        new = slice(self.counted, self.counted + info.draws.shape[1])
        self._sums += info.draws.reshape(CHAINS, -1, self._sums.shape[1]).sum(axis=1, dtype=np.uint32)
        if self.keep:
            self._packed[:, new] = np.packbits(info.draws, axis=-1)
        self.counted = new.stop
        self._log_likelihood[:, before : self.sweep] = info.log_likelihood
        self._log_prior[:, before : self.sweep] = info.log_prior
        self._seen += (self.state.chains.states.reached.numpy() > 0).sum(axis=0)
        self._steps += 1
        spent = time.perf_counter() - began
        self.seconds += spent
        self._per_sweep = spent / sweeps

    @property
    def packed(self) -> NDArray[np.uint8]:
        """The kept draws, (chains, count, bytes)."""
        return self._packed[:, : self.counted if self.keep else 0]

    def mean(self) -> NDArray[np.float64]:
        """Fraction of the counted maps in which each cell is a wall, (nx, ny).

        Where draws are not kept, cells that no beam touches have the prior exactly: what their draws average to.
        """
        table = self.sampler.problem.table
        mean = (self._sums.sum(axis=0) / (CHAINS * max(1, self.counted))).reshape(table.grid.shape)
        if self.keep:
            return np.asarray(mean)
        return np.where(table.observed(), mean, self.sampler.problem.p_wall.reshape(mean.shape))

    def means(self) -> NDArray[np.float64]:
        """The same of each chain, (chains, nx, ny)."""
        return (self._sums / max(1, self.counted)).reshape(CHAINS, *self.sampler.problem.table.grid.shape)

    def observed(self) -> NDArray[np.bool_]:
        """Cells that a beam reached in at least half of the maps at which the chains paused, (nx, ny)."""
        shape = self.sampler.problem.table.grid.shape
        return (2 * self._seen >= CHAINS * max(1, self._steps)).reshape(shape)

    def draw(self, chain: int | None, draw: int | None) -> tuple[NDArray[np.bool_], int, int]:
        """One map, (nx, ny), and which it is: the last where there is none such, the chain's where none are kept."""
        shape = self.sampler.problem.table.grid.shape
        which = min(chain or 0, CHAINS - 1)
        packed = self.packed
        if packed.shape[1] == 0:
            return self.state.walls()[which].reshape(shape) != 0, which, 0
        last = packed.shape[1] - 1
        number = last if draw is None else min(draw, last)
        return unpack(packed[which, number], shape), which, number

    def log_joint(self) -> NDArray[np.float64]:
        """Of every sweep, (chains, sweeps)."""
        return self._log_likelihood[:, : self.sweep] + self._log_prior[:, : self.sweep]

    def mixing(self) -> Mixing:
        """Diagnostics of all sweeps, while the chains run of those until a moment ago; NaN where nothing changed."""
        joint = self.log_joint()
        last = float(joint[:, -1].mean()) if joint.shape[1] else math.nan
        now = time.perf_counter()
        if now >= self._diagnose_at or (self.done and self._diagnosed < self.sweep):
            constant = joint.size == 0 or float(np.ptp(joint)) == 0.0
            self._rhat, self._ess = (math.nan, math.nan) if constant else (rhat(joint), bulk_ess(joint))
            self._diagnosed = self.sweep
            self._diagnose_at = math.inf if self.done else now + (time.perf_counter() - now) / DIAGNOSIS_SHARE
        return Mixing(self._rhat, self._ess, last)

    def chains(self) -> Chains:
        """Everything, as the library's runner leaves it."""
        counted = slice(self.thin - 1, self.sweep, self.thin)
        return Chains(
            packed=self.packed,
            log_likelihood=self._log_likelihood[:, counted],
            log_prior=self._log_prior[:, counted],
            warmup_log_joint=np.zeros((CHAINS, 0)),
            walls=self.state.walls(),
            sweep=self.sweep,
            seconds=self.seconds,
            finished=self.done,
        )
