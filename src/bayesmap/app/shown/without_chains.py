"""Methods without chains, run in short steps: belief propagation while the hand moves, and importance sampling.

The methods are those of `bayesmap.samplers.without_chains`. Here they stop after each round of belief propagation
(`Preview`) and after some particles (`Weighing`), so that the worker can read new tasks.
"""

import time
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.app.shown.result import CHAINS, SAVED_DRAWS, Estimate, Progress, Result
from bayesmap.app.shown.verdicts import judge_particles
from bayesmap.arguments import Schedule
from bayesmap.beams.table import BeamTable
from bayesmap.kernels.random import mix
from bayesmap.kernels.walls.propagate import Beliefs
from bayesmap.kernels.walls.table import particle_log_weights, reach_frequency
from bayesmap.posterior.posterior import posterior_of_draws
from bayesmap.result import Run
from bayesmap.samplers import without_chains as methods
from bayesmap.samplers.sampler import Stream
from bayesmap.samplers.wall_problem import WallProblem, finite_logit
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats

TOLERANCE = 1e-3  # belief propagation has converged when no probability changes by more than this in a round
THREADS_FROM_INCIDENCES = 200_000  # smaller tables use one thread, so that the page has the other cores for painting
STEP_SECONDS = 0.015  # duration of a step of importance sampling
FIRST_STEP_PARTICLES = 64  # particles in the first step


def without_untouched_cells(table: BeamTable) -> tuple[NDArray[np.intp], BeamTable]:
    """Return the flat indices of the M cells that beams touch, and the beam table with cells renumbered 0 to M - 1."""
    cells = np.flatnonzero(table.touched_map())
    numbers = np.zeros(table.grid.n_cells, dtype=np.int32)
    numbers[cells] = np.arange(len(cells), dtype=np.int32)
    row_grid = Grid((max(1, len(cells)), 1))
    return cells, BeamTable(row_grid, table.offsets, numbers[table.cells], table.loglik, table.no_hit)


def approximate_reach(table: BeamTable, p_wall: Floats) -> Floats:
    """Return the share of five maps in which a beam reaches each cell, (nx, ny): walls have p over 0.1, 0.3 ... 0.9."""
    return reach_frequency(table, p_wall > np.arange(0.1, 1.0, 0.2)[:, None, None])


class Preview(Estimate):
    """Belief propagation as in `bayesmap.samplers.without_chains`, one round at a time.
    Cells that no beam touches keep the prior exactly, so the rounds leave them out: on 500 x 500 cells with one sensor,
    most of the map. Beliefs have ``converged`` when they change by less than `TOLERANCE`, or after `methods.ROUNDS`.
    """

    approximate = True

    def __init__(self, problem: WallProblem) -> None:
        self.problem = problem
        self.cells, self.table = without_untouched_cells(problem.table)  # touched cells, and the beam table over them
        self.rounds, self._seconds = 0, 0.0  # rounds done, and the time that they took
        self._threads = 1 if problem.table.n_incidences < THREADS_FROM_INCIDENCES else None
        self._p = problem.p_wall[self.cells]
        self._fixed = (self._p == 0) | (self._p == 1)
        self.converged = len(self.cells) == 0 or bool(self._fixed.all())
        if not self.converged:
            self._beliefs = Beliefs(self.table, finite_logit(self._p), problem.device)

    def round(self) -> None:
        """Do one more round of belief propagation."""
        began_s = time.perf_counter()
        self._beliefs.round(methods.DAMPING, self._threads)
        before = self._p
        self._p = np.where(self._fixed, before, special.expit(self._beliefs.log_odds()))
        self.rounds += 1
        self._seconds += time.perf_counter() - began_s
        self.converged = self.rounds >= methods.ROUNDS or float(np.abs(self._p - before).max()) < TOLERANCE

    def mean(self) -> Floats:
        p = self.problem.p_wall.copy()
        p[self.cells] = self._p
        return p.reshape(self.problem.table.grid.shape)

    def reached(self) -> Floats:
        """Return the approximate probability that a beam reaches each cell, (nx, ny), by `approximate_reach`."""
        reached = np.zeros(self.problem.table.grid.n_cells)
        if len(self.cells):
            reached[self.cells] = approximate_reach(self.table, self._p.reshape(self.table.grid.shape)).ravel()
        return reached.reshape(self.problem.table.grid.shape)

    def marginals(self) -> methods.Marginals:
        """Return the current marginals for starts of chains. `as_run` saves them, and calls them finished."""
        converged = self.converged
        return methods.Marginals(self.mean(), np.zeros(0), converged=converged, finished=converged, seconds=0.0)

    def progress(self, ended: bool) -> Progress:
        return Progress(sweeps=self.rounds, seconds=self._seconds)

    def as_run(self, result: Result) -> Run:
        began_s, document = time.perf_counter(), result.document
        request = methods.DrawRequest(CHAINS, SAVED_DRAWS, document.seed, particles=0, rounds=self.rounds)
        draws = methods.draw_from_marginals(result.scene.problem, request, replace(self.marginals(), finished=True))
        return _run_of_draws(result, self.problem, draws, began_s, self.rounds)


class Weighing(Estimate):
    """Importance sampling with the particles of `bayesmap.samplers.without_chains`, weighed in short steps."""

    def __init__(self, problem: WallProblem, total: int, seed: int) -> None:
        self.problem, self.total = problem, total  # `total` particles to weigh
        self.count = 0  # particles weighed so far
        self._key = mix(seed, 0, Stream.PARTICLES)
        self._log_weights = np.empty(total)
        self._step_particles = FIRST_STEP_PARTICLES
        self._seconds = 0.0

    def advance(self) -> None:
        """Weigh more particles: about `STEP_SECONDS` of work."""
        began_s = time.perf_counter()
        n = min(self._step_particles, self.total - self.count)
        self._log_weights[self.count : self.count + n] = particle_log_weights(
            self.problem.device_table, self.problem.device_prior, self._key, self.count, n, self.problem.device
        )
        self.count += n
        self.done = self.count == self.total
        seconds = time.perf_counter() - began_s
        self._seconds += seconds
        # Choose the next step's size by this step's speed; it grows at most fourfold.
        self._step_particles = int(np.clip(n * STEP_SECONDS / max(seconds, 1e-9), 1, 4 * self._step_particles))

    @property
    def particles(self) -> methods.Particles:
        """The particles weighed so far."""
        log_weights = self._log_weights[: self.count]
        log_total = float(special.logsumexp(log_weights))
        return methods.Particles(
            log_weights=log_weights - log_total, log_evidence=log_total - float(np.log(self.count)),
            problem=self.problem, key=self._key, seconds=self._seconds, finished=self.done,
        )  # fmt: skip

    def progress(self, ended: bool) -> Progress:
        ess = self.particles.effective_sample_size
        return Progress(self.count, self.total, ess, verdict=judge_particles(ess), seconds=self._seconds)

    @property
    def log_weights(self) -> Floats:
        return self.particles.log_weights

    def mean(self) -> Floats:
        return self.particles.occupancy()

    def reached(self) -> Floats:
        """Return the approximate probability that a beam reaches each cell, (nx, ny), by `approximate_reach`."""
        return approximate_reach(self.problem.table, self.mean())

    def as_run(self, result: Result) -> Run:
        began_s, document = time.perf_counter(), result.document
        request = methods.DrawRequest(CHAINS, SAVED_DRAWS, document.seed, particles=document.sweeps, rounds=0)
        draws = methods.resample_particles(self.problem, request, self.particles)
        return _run_of_draws(result, self.problem, draws, began_s)


def _run_of_draws(
    result: Result, problem: WallProblem, draws: methods.IndependentDraws, began_s: float, rounds: int = 0
) -> Run:
    """Return a run of independent draws. ``began_s`` is a time of `time.perf_counter`; ``rounds`` are a preview's."""
    model = result.scene.model(problem.prior)
    settings = result.settings_of_run(model, Schedule(CHAINS, warmup=0, draws=SAVED_DRAWS, thin=1), rounds)
    seconds = {"trace": 0.0, "total": time.perf_counter() - began_s}
    return Run(posterior_of_draws(model, draws, result.scene.problem.n_incidences, settings, seconds))
