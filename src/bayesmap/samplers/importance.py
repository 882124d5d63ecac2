"""Self-normalised importance sampling from the prior: kept because it shows why better methods are needed.

A particle is a map drawn from the prior, its weight the likelihood of the readings. Maps are drawn by counter, so a
particle is just its number: a million of them take 8 MB for their log weights, and any map can be drawn again. Where
neighbours are coupled maps are drawn exactly, too (`bayesmap.cells.perfect_draws`), some at a time, by the number of
their batch.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells.arrays import pack
from bayesmap.errors import check_count
from bayesmap.samplers.progress import SILENT, Watch
from bayesmap.samplers.sampler import STREAM_PARTICLES
from bayesmap.samplers.wall_problem import WallProblem

BATCH_CELLS = 1 << 23  # cells of maps that are drawn at a time
COUPLED_CELLS = 1 << 13  # of maps of coupled cells that are drawn together
NEGLIGIBLE_NATS = 40.0  # a particle this far below the best adds nothing to any mean


@dataclass(frozen=True, eq=False)
class Particles:
    """Weighted maps.

    Attributes:
        log_weights: normalised log weights, (particles,).
        log_evidence: log of the mean weight: an estimate of log p(readings).
        problem, key: from which any particle's map can be drawn again.
        seconds: time spent weighing.
        finished: false if stopped early.
    """

    log_weights: NDArray[np.float64]
    log_evidence: float
    problem: WallProblem
    key: int
    seconds: float
    finished: bool

    @property
    def effective_sample_size(self) -> float:
        """1 / sum of squared weights; 1 means that a single particle carries all weight."""
        return float(np.exp(-special.logsumexp(2 * self.log_weights)))

    def maps(self, particles: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Return the maps of the given particles, (n, nx, ny)."""
        from bayesmap.kernels.walls.maps import particle_maps

        if self.problem.coupling != 0.0:
            return _coupled_maps(self.problem, self.key, particles)
        walls = particle_maps(self.problem.device_prior, self.key, particles, self.problem.device)
        return np.asarray(walls.reshape(len(particles), *self.problem.table.grid.shape) != 0)

    def occupancy(self) -> NDArray[np.float64]:
        """Return the weighted mean of the maps, (nx, ny), in batches; independent cells that no beam touches have the
        prior's.
        """
        matter = np.nonzero(self.log_weights > self.log_weights.max() - NEGLIGIBLE_NATS)[0]
        mean = np.zeros(self.problem.table.grid.shape)
        batch = max(1, BATCH_CELLS // mean.size)
        for i in range(0, len(matter), batch):
            part = matter[i : i + batch]
            mean += np.tensordot(np.exp(self.log_weights[part]), self.maps(part), axes=1)
        mean /= np.exp(self.log_weights[matter]).sum()
        if self.problem.coupling != 0.0:
            return mean
        return np.where(self.problem.table.observed(), mean, self.problem.p_wall.reshape(mean.shape))

    def resample(self, rng: np.random.Generator, count: int) -> NDArray[np.intp]:
        """Draw the numbers of ``count`` particles with replacement, each with its weight's probability."""
        cumulative = np.cumsum(np.exp(self.log_weights))
        return np.searchsorted(cumulative / cumulative[-1], rng.random(count), side="right")


def sample_importance(
    problem: WallProblem, particles: int, seed: int, *, beta: float = 1.0, watch: Watch = SILENT
) -> Particles:
    """Draw maps from the prior and weigh them by the likelihood, at an inverse temperature.

    Raises:
        BadInput: no particles, or neighbours coupled so strongly that maps cannot be drawn.
    """
    from bayesmap.kernels.random import mix

    particles = check_count("importance", "particles", particles, 1)
    key = mix(seed, 0, STREAM_PARTICLES)
    batches: list[NDArray[np.float64]] = []
    began = time.perf_counter()
    size, done = 256, 0
    watch.report("particles", 0, particles)  # of a large map the first particles take a while
    while done < particles and not (batches and watch.should_stop()):
        now = min(size, particles - done)
        batches.append(_weigh(problem, key, done, now))
        done += now
        elapsed = time.perf_counter() - began
        size = int(np.clip(0.25 * done / max(elapsed, 1e-9), 256, 1 << 20))
        watch.report("particles", done, particles)
    log_weights = beta * np.concatenate(batches)
    log_total = float(special.logsumexp(log_weights))
    return Particles(
        log_weights=log_weights - log_total,
        log_evidence=log_total - float(np.log(done)),
        problem=problem,
        key=key,
        seconds=time.perf_counter() - began,
        finished=done == particles,
    )


def _weigh(problem: WallProblem, key: int, first: int, count: int) -> NDArray[np.float64]:
    """Compute log p(readings | map) of particles first .. first + count - 1."""
    from bayesmap.kernels.walls.maps import log_likelihoods, weigh

    if problem.coupling == 0.0:
        return weigh(problem.device_table, problem.device_prior, key, first, count, problem.device)
    maps = _coupled_maps(problem, key, np.arange(first, first + count))
    return log_likelihoods(problem.table, pack(maps), problem.device)


def _coupled_maps(problem: WallProblem, key: int, particles: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Return the maps of some particles, (n, nx, ny): each is one of the maps drawn with the number of its batch."""
    out = np.empty((len(particles), *problem.grid.shape), dtype=np.bool_)
    together = max(1, COUPLED_CELLS // problem.grid.n_cells)
    batch_of = particles // together
    for batch in np.unique(batch_of).tolist():
        rng = np.random.default_rng([key, batch])
        maps = problem.prior.sample_maps(rng, problem.grid, together)
        mine = batch_of == batch
        out[mine] = maps[particles[mine] % together]
    return out
