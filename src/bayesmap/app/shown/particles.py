"""Importance sampling in short pieces: the particles of `bayesmap.samplers.without_chains`, some at a time."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.app.shown.result import CHAINS, SAVED_DRAWS, Figures, Floats, Found, Result, settings_of_run
from bayesmap.app.shown.verdict import judge_particles
from bayesmap.kernels.random import mix
from bayesmap.kernels.walls.maps import reach_frequency, weigh
from bayesmap.posterior.posterior import posterior_of_draws
from bayesmap.result import Run
from bayesmap.samplers.sampler import STREAM_PARTICLES
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.without_chains import DrawRequest, Particles, draws_by_importance

PIECE_SECONDS = 0.015
FIRST_PIECE = 64


class Weighing:
    """Particles that are being weighed.

    Attributes:
        total: how many there will be.
        done: how many there are.
    """

    def __init__(self, problem: WallProblem, total: int, seed: int) -> None:
        self.problem, self.total, self.done = problem, total, 0
        self._key = mix(seed, 0, STREAM_PARTICLES)
        self._log_weights: NDArray[np.float64] = np.empty(total)
        self._piece = FIRST_PIECE
        self._seconds = 0.0

    def advance(self) -> None:
        """Weigh some more: about `PIECE_SECONDS` of work."""
        began = time.perf_counter()
        now = min(self._piece, self.total - self.done)
        problem = self.problem
        some = weigh(problem.device_table, problem.device_prior, self._key, self.done, now, problem.device)
        self._log_weights[self.done : self.done + now] = some
        self.done += now
        spent = time.perf_counter() - began
        self._seconds += spent
        self._piece = int(np.clip(now * PIECE_SECONDS / max(spent, 1e-9), 1, 4 * self._piece))

    def found(self) -> Weighed:
        """Return the particles weighed so far."""
        log_weights = self._log_weights[: self.done]
        log_total = float(special.logsumexp(log_weights))
        particles = Particles(
            log_weights=log_weights - log_total,
            log_evidence=log_total - float(np.log(self.done)),
            problem=self.problem,
            key=self._key,
            seconds=self._seconds,
            finished=self.done == self.total,
        )
        return Weighed(particles, self.total)


@dataclass(frozen=True, eq=False)
class Weighed(Found):
    """Weighted particles.

    Attributes:
        particles: those weighed so far.
        total: how many there will be.
    """

    particles: Particles
    total: int

    def figures(self, over: bool) -> Figures:
        """Return the particles weighed, and how many of equal weight they are worth."""
        ess = self.particles.effective_sample_size
        return Figures(len(self.particles.log_weights), self.total, ess, verdict=judge_particles(ess))

    @property
    def log_weights(self) -> Floats:
        """Log weights, (n,)."""
        return self.particles.log_weights

    def mean(self) -> Floats:
        """Return the posterior wall probability, (nx, ny)."""
        return self.particles.occupancy()

    def observed(self) -> NDArray[np.bool_]:
        """Return the cells that a beam reaches where walls are likely, (nx, ny)."""
        return reach_frequency(self.particles.problem.table, self.mean()[None] > 0.5) > 0

    def as_run(self, result: Result) -> Run:
        """Return draws by weight, as a run."""
        problem, document = self.particles.problem, result.document
        began = time.perf_counter()
        request = DrawRequest(CHAINS, SAVED_DRAWS, document.seed, document.sweeps, 0)
        draws = draws_by_importance(problem, request, self.particles)
        model = result.scene.model(problem.prior)
        settings = settings_of_run(result, model, chains=CHAINS, draws=SAVED_DRAWS)
        seconds = {"trace": 0.0, "total": time.perf_counter() - began}
        return Run(posterior_of_draws(model, draws, problem.n_incidences, settings, seconds))
