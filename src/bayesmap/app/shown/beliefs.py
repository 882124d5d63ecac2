"""The answer while the hand is moving: belief propagation on the cells that beams touch."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.app.scene import Touched, touched
from bayesmap.app.shown.result import CHAINS, SAVED_DRAWS, Figures, Found, Result, settings_of_run
from bayesmap.kernels.walls.maps import reach_frequency
from bayesmap.kernels.walls.propagate import Beliefs
from bayesmap.posterior.posterior import posterior_of_draws
from bayesmap.result import Run
from bayesmap.samplers.propagate import DAMPING, ROUNDS, Marginals
from bayesmap.samplers.wall_problem import WallProblem, log_odds
from bayesmap.samplers.without_chains import DrawRequest, draws_by_beliefs

TOLERANCE = 1e-3
THREADS_FROM_INCIDENCES = 200_000
"""Smaller tables leave the other cores to the page, which paints with them."""


class Preview(Found):
    """Rounds of belief propagation as in `bayesmap.samplers.propagate`, one at a time.

    Cells that no beam touches keep the prior exactly, so the rounds need not visit them: at 500 x 500 with one sensor
    that is most of the map.

    Attributes:
        rounds: done so far.
        converged: whether the last one changed no probability by more than the tolerance, or was the last allowed.
    """

    approximate = True

    def __init__(self, problem: WallProblem) -> None:
        self.problem = problem
        self.part: Touched = touched(problem.table)
        self.rounds = 0
        self._threads = 1 if problem.table.n_incidences < THREADS_FROM_INCIDENCES else None
        self._p = problem.p_wall[self.part.cells]
        self._fixed = (self._p == 0) | (self._p == 1)
        self.converged = len(self.part.cells) == 0 or bool(self._fixed.all())
        if not self.converged:
            self._beliefs = Beliefs(self.part.table, log_odds(self._p), problem.device)

    def round(self) -> None:
        """One more round."""
        self._beliefs.round(DAMPING, self._threads)
        before, p = self._p, special.expit(self._beliefs.log_odds())
        self._p = np.where(self._fixed, before, p)
        self.rounds += 1
        change = float(np.abs(self._p - before).max())
        self.converged = self.rounds >= ROUNDS or change < TOLERANCE

    def mean(self) -> NDArray[np.float64]:
        """Approximate posterior wall probability of every cell, (nx, ny)."""
        p = self.problem.p_wall.copy()
        p[self.part.cells] = self._p
        return p.reshape(self.problem.table.grid.shape)

    def observed(self) -> NDArray[np.bool_]:
        """Cells that a beam reaches before the first likely wall, (nx, ny)."""
        seen = np.zeros(self.problem.table.grid.n_cells, dtype=np.bool_)
        if len(self.part.cells):
            likely = (self._p > 0.5).reshape(1, *self.part.table.grid.shape)
            seen[self.part.cells] = reach_frequency(self.part.table, likely).ravel() > 0
        return seen.reshape(self.problem.table.grid.shape)

    def marginals(self) -> Marginals:
        """What the rounds found, for `bayesmap.samplers.walls` and for a saved run."""
        return Marginals(self.mean(), np.zeros(0), np.zeros(0), self.converged, self.converged, 0.0)

    def figures(self, over: bool) -> Figures:
        """Return the rounds done."""
        return Figures(sweeps=self.rounds)

    def as_run(self, result: Result) -> Run:
        """Return independent draws by the beliefs, as a run."""
        document, model = result.document, result.scene.model(self.problem.prior)
        began = time.perf_counter()
        request = DrawRequest(CHAINS, SAVED_DRAWS, document.seed, document.sweeps, self.rounds)
        draws = draws_by_beliefs(result.scene.problem, request, replace(self.marginals(), finished=True))
        settings = settings_of_run(result, model, chains=CHAINS, draws=SAVED_DRAWS, rounds=self.rounds)
        seconds = {"trace": 0.0, "total": time.perf_counter() - began}
        return Run(posterior_of_draws(model, draws, result.scene.problem.n_incidences, settings, seconds))
