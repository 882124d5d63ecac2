"""Chains that are watched while they run: the library's runner in short steps, the running mean, the kept draws."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.recent import joined
from bayesmap.cells.arrays import Draws
from bayesmap.model import Model
from bayesmap.posterior.diagnostics import bulk_ess, rhat
from bayesmap.run.chains import Chains, Record, SweepPlan
from bayesmap.run.runner import BUFFER_BYTES, no_draws, sweeps
from bayesmap.samplers.sampler import Problem, Sampler

CHAINS = 2
POSE_CHAINS = 16
"""Where poses are uncertain: a map holds its sensors in place, so that each chain stays near where it started."""

STEP_SECONDS = 0.015
"""Of work between two looks at the pipe."""

DRAW_BYTES = 128 << 20
"""Of the kept draws of a run; more sweeps than fit are thinned."""

LOOKS = 32
"""At which cells some beam says something is counted so often in a run, besides at sweeps 1, 2, 4 and so on."""

DIAGNOSIS_SHARE = 0.1
"""Of the time that diagnostics of the growing trace may take; they are those of every sweep, as of the last time."""


@dataclass(frozen=True)
class Mixing:
    """R-hat and effective sample size of the log joint, and its last value averaged over the chains."""

    rhat: float
    ess: float
    log_joint: float


class Stream:
    """Some chains from their start to their last sweep, whatever their kind of cells.

    Attributes:
        model: what is sampled.
        problem: what the sampler has prepared of it.
        total: sweeps to do.
        thin: sweeps from one counted map to the next; 1 unless so many are kept that they would not fit.
        n_chains: how many chains.
        counted: maps that each chain's mean is made of.
    """

    def __init__(
        self, model: Model, sampler: Sampler[Any, Any], problem: Problem, total: int, seed: int, *, keep: bool
    ) -> None:
        self.model, self.problem, self._sampler, self.keep = model, problem, sampler, keep
        self.n_chains = POSE_CHAINS if model.poses.unknown else CHAINS
        self.state = sampler.init(problem, range(self.n_chains), seed)
        empty = no_draws(model, self.state, self.n_chains)
        one = sum(spec.empty(self.n_chains, 1, empty.shape_of(spec)).nbytes for spec in empty.specs)
        self.thin = math.ceil(total * one / DRAW_BYTES) if keep else 1
        self.total = math.ceil(total / self.thin) * self.thin
        schedule = SweepPlan(0, self.total // self.thin, self.thin)
        self._record = Record(empty, schedule if keep else SweepPlan(0, 0), schedule.keep)
        # At fixed sweeps: how long a step is depends on the machine, and the same actions make the same page.
        doubling = (2**k for k in range(self.total.bit_length()))
        self._look_at = {*doubling, *(self.total * k // LOOKS for k in range(1, LOOKS + 1))}
        self._steps = sweeps(
            sampler, self.state, self.total, keep=schedule.keep, step_seconds=STEP_SECONDS,
            most_kept=max(1, BUFFER_BYTES // max(one, 1)), stops=tuple(sorted(self._look_at)),
        )  # fmt: skip
        self.seconds, self.counted = 0.0, 0
        self._latest = self._recent = empty
        self._sums = np.zeros((self.n_chains, *model.grid.shape))
        self._rhat = self._ess = math.nan
        self._diagnose_at, self._diagnosed = 0.0, 0
        self._observed_counts = np.zeros((2, *model.grid.shape), dtype=np.int32)
        self._log_likelihood = np.zeros((self.n_chains, self.total))
        self._log_prior = np.zeros((self.n_chains, self.total))

    @property
    def sweep(self) -> int:
        """Sweeps done."""
        return int(self.state.sweep)

    @property
    def done(self) -> bool:
        """Whether all sweeps are."""
        return self.sweep >= self.total

    def advance(self) -> None:
        """Some sweeps: about `STEP_SECONDS` of work."""
        before, began = self.sweep, time.perf_counter()
        self.state, info = next(self._steps)
        latest = replace(self._latest, arrays=info.draws)
        if latest.count:
            self._latest = latest
            self._recent = joined(self._recent, latest)
            for chain in range(self.n_chains):
                one = replace(latest, arrays={name: a[chain : chain + 1] for name, a in info.draws.items()})
                self._sums[chain] += self.model.cells.mean_map(one) * latest.count
            self.counted += latest.count
        if self.keep:
            self._record.add(info, before)
        self._log_likelihood[:, before : self.sweep] = info.log_likelihood
        self._log_prior[:, before : self.sweep] = info.log_prior
        if self.sweep in self._look_at:
            self._observed_counts += self._sampler.observed_counts(self.state, {})
        self.seconds += time.perf_counter() - began

    @property
    def draws(self) -> Draws:
        """The kept draws."""
        return self._record.draws

    @property
    def recent(self) -> Draws:
        """The last maps, kept or not; see `bayesmap.app.recent`."""
        return self._recent

    def mean(self) -> NDArray[np.float64]:
        """Mean over the counted maps of the probability that a cell stops a beam, (nx, ny).

        Where draws are not kept, cells that no beam touches have the prior's mean exactly: what their draws average to.
        """
        mean = self._sums.mean(axis=0) / max(1, self.counted)
        if self.keep or self.model.poses.unknown:  # from other poses beams touch other cells
            return np.asarray(mean)
        return np.where(self.problem.touched(), mean, self.model.cells.mean_stop(self.model.grid))

    def means(self) -> NDArray[np.float64]:
        """The same of each chain, (chains, nx, ny)."""
        return self._sums / max(1, self.counted)

    def observed(self) -> NDArray[np.bool_]:
        """Cells of which a beam said something in at least half of the maps that were looked at, (nx, ny)."""
        return np.asarray(2 * self._observed_counts[0] >= np.maximum(1, self._observed_counts[1]))

    def draw(self, chain: int | None, draw: int | None) -> tuple[NDArray[Any], int, int]:
        """One map, (nx, ny), and which it is: the last where there is none such, the latest where none are kept."""
        kept, which = self.draws, min(chain or 0, self.n_chains - 1)
        if kept.count == 0:
            return self.model.cells.map_of(self._latest, which, -1), which, 0
        number = kept.count - 1 if draw is None else min(draw, kept.count - 1)
        return self.model.cells.map_of(kept, which, number), which, number

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
        log_likelihood, log_prior, warmup = self._record.log_densities
        return Chains(
            draws=self.draws, log_likelihood=log_likelihood, log_prior=log_prior, warmup_log_joint=warmup,
            snapshot=self._sampler.snapshot(self.state), observed_counts=self._observed_counts, statistics={},
            n_incidences=self.problem.n_incidences,
            seconds={"trace": 0.0, "warm_start": 0.0, "sampling": self.seconds}, finished=self.done,
        )  # fmt: skip
