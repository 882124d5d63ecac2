"""Methods on binary walls that need no Markov chain: their draws are independent."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import pack
from bayesmap.samplers.exact import enumerate_maps
from bayesmap.samplers.importance import Particles, sample_importance
from bayesmap.samplers.problem import WallProblem
from bayesmap.samplers.progress import Watch
from bayesmap.samplers.propagate import Marginals, propagate
from bayesmap.samplers.sampler import STREAM_START

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Asked:
    """How much of what: ``chains * draws`` draws by ``seed``, after ``particles`` or ``rounds`` of work."""

    chains: int
    draws: int
    seed: int
    particles: int
    rounds: int


@dataclass(frozen=True, eq=False)
class Found:
    """Independent draws, and what the method computes itself.

    Attributes:
        walls: packed maps, (chains, draws, ceil(N / 8)).
        log_likelihood, log_prior: of each, (chains, draws).
        occupancy: marginals, (nx, ny).
        observed: cells that a beam reaches in at least half of the maps, (nx, ny).
        seconds: of the method's own work.
        finished: false if it was stopped early.
        log_weights: normalised, of all particles.
        statistics: other numbers by name.
        log_evidence: log p(readings).
    """

    walls: NDArray[np.uint8]
    log_likelihood: Floats
    log_prior: Floats
    occupancy: Floats
    observed: NDArray[np.bool_]
    seconds: float = 0.0
    finished: bool = True
    log_weights: Floats | None = None
    statistics: Mapping[str, Floats] = field(default_factory=dict)
    log_evidence: float | None = None


def exact(problem: WallProblem, asked: Asked, watch: Watch) -> Found:
    """The whole posterior, with draws from it."""
    whole = enumerate_maps(problem)
    return _found(problem, asked, whole.sample, whole.marginals(), log_evidence=whole.log_evidence)


def importance(problem: WallProblem, asked: Asked, watch: Watch) -> Found:
    """Weighted maps, with draws resampled from them."""
    return found_by_importance(problem, asked, sample_importance(problem, asked.particles, asked.seed, watch=watch))


def found_by_importance(problem: WallProblem, asked: Asked, found: Particles) -> Found:
    """The same of particles that have been weighed."""
    return _found(
        problem,
        asked,
        lambda rng, count: found.maps(found.resample(rng, count)),
        found.occupancy(),
        log_weights=found.log_weights,
        log_evidence=found.log_evidence,
        seconds=found.seconds,
        finished=found.finished,
    )


def belief_propagation(problem: WallProblem, asked: Asked, watch: Watch) -> Found:
    """Beliefs, with draws that are independent from cell to cell: marginals are all that there is."""
    return found_by_beliefs(problem, asked, propagate(problem, rounds=asked.rounds, watch=watch))


def found_by_beliefs(problem: WallProblem, asked: Asked, found: Marginals) -> Found:
    """The same of beliefs that have been propagated."""
    return _found(
        problem,
        asked,
        lambda rng, count: rng.random((count, *found.p_wall.shape)) < found.p_wall,
        found.p_wall,
        statistics={"belief_changes": found.changes},
        seconds=found.seconds,
        finished=found.finished,
    )


def _found(
    problem: WallProblem,
    asked: Asked,
    draw: Callable[[np.random.Generator, int], NDArray[np.bool_]],
    occupancy: Floats,
    *,
    log_weights: Floats | None = None,
    log_evidence: float | None = None,
    statistics: Mapping[str, Floats] | None = None,
    seconds: float = 0.0,
    finished: bool = True,
) -> Found:
    from bayesmap.kernels.walls.importance import log_likelihoods
    from bayesmap.kernels.walls.reach import reach_frequency

    rngs = [np.random.default_rng([asked.seed, chain, STREAM_START]) for chain in range(asked.chains)]
    walls = np.stack([draw(rng, asked.draws) for rng in rngs])
    packed = pack(walls)
    flat = walls.reshape(-1, *problem.grid.shape)
    some = np.unique(np.linspace(0, len(flat) - 1, 32).astype(int)) if len(flat) else None
    maps = occupancy[None] > 0.5 if some is None else flat[some]
    return Found(
        walls=packed,
        log_likelihood=np.stack([log_likelihoods(problem.table, chain, problem.device) for chain in packed]),
        log_prior=np.array([[problem.prior.log_prob(w, problem.grid) for w in chain] for chain in walls]),
        occupancy=occupancy,
        observed=reach_frequency(problem.table, maps, problem.device) >= 0.5,
        seconds=seconds,
        finished=finished,
        log_weights=log_weights,
        statistics={} if statistics is None else statistics,
        log_evidence=log_evidence,
    )
