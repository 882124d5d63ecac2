"""Methods on binary walls that need no Markov chain: their draws are independent.

Exact enumeration is one of them: a method for tiny maps, and the oracle against which every sampler is tested.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells.arrays import pack
from bayesmap.errors import BadInput
from bayesmap.samplers.importance import Particles, sample_importance
from bayesmap.samplers.progress import Watch
from bayesmap.samplers.propagate import Marginals, propagate
from bayesmap.samplers.sampler import STREAM_START
from bayesmap.samplers.wall_problem import WallProblem

MAX_UNKNOWN = 16


@dataclass(frozen=True, eq=False)
class Enumeration:
    """The whole posterior, enumerated.

    Attributes:
        unknown: flat indices of the cells that were enumerated, (n,): not fixed by the prior, and touched by a beam or
            coupled to others.
        log_posterior: normalised log-probability of each of the 2^n states; bit i of the state's number is the
            wall in ``unknown[i]``.
        log_evidence: log p(readings).
        problem: what was enumerated.
    """

    unknown: NDArray[np.intp]
    log_posterior: NDArray[np.float64]
    log_evidence: float
    problem: WallProblem

    def states(self) -> NDArray[np.bool_]:
        """Return the enumerated cells in each state, (2^n, n)."""
        state = np.arange(len(self.log_posterior))[:, None]
        return np.asarray(state >> np.arange(len(self.unknown)) & 1 == 1)

    def marginals(self) -> NDArray[np.float64]:
        """Return the posterior wall probability of every cell, (nx, ny); the prior's where no beam observes it."""
        p = self.problem.p_wall.copy()
        p[self.unknown] = np.exp(self.log_posterior) @ self.states()
        return p.reshape(self.problem.table.grid.shape)

    def pairs(self) -> NDArray[np.float64]:
        """Return the posterior probability that both of two enumerated cells are walls, (n, n)."""
        states = self.states().astype(np.float64)
        return np.asarray((states * np.exp(self.log_posterior)[:, None]).T @ states)

    def sample(self, rng: np.random.Generator, count: int) -> NDArray[np.bool_]:
        """Draw maps independently, (count, nx, ny)."""
        shape = self.problem.table.grid.shape
        walls = rng.random((count, shape[0] * shape[1])) < self.problem.p_wall
        state = rng.choice(len(self.log_posterior), size=count, p=np.exp(self.log_posterior))
        walls[:, self.unknown] = self.states()[state]
        return walls.reshape(count, *shape)


def enumerate_maps(problem: WallProblem) -> Enumeration:
    """Compute p(map | readings) for every map, in plain NumPy.

    Raises:
        BadInput: more than `MAX_UNKNOWN` unknown cells.
    """
    table, p = problem.table, problem.p_wall
    free_to_vary = (p > 0) & (p < 1)
    # What coupled cells that no beam touches are, the others know.
    matters = table.observed().ravel() | (problem.coupling != 0.0)
    unknown = np.nonzero(matters & free_to_vary)[0]
    if len(unknown) > MAX_UNKNOWN:
        raise BadInput(
            f"exact: {len(unknown)} cells are unknown, and enumeration takes at most {MAX_UNKNOWN}; "
            "use method 'gibbs' or 'block', or fix cells with a prior of 0 or 1"
        )
    bit_of = np.full(table.grid.n_cells, -1)
    bit_of[unknown] = np.arange(len(unknown))
    state = np.arange(1 << len(unknown))
    log_p = np.zeros(len(state))
    for i, cell in enumerate(unknown):
        log_p += np.where(state >> i & 1, np.log(p[cell]), np.log1p(-p[cell]))
    if problem.coupling != 0.0:
        log_p += problem.coupling * _pairs_alike(problem, state, bit_of)
        log_p -= special.logsumexp(log_p)
    for b in range(table.n_beams):
        still_free = np.ones(len(state), dtype=np.bool_)
        term = np.full(len(state), np.float64(table.no_hit[b]))
        for k in range(table.offsets[b], table.offsets[b + 1]):
            cell = table.cells[k]
            wall = (state >> bit_of[cell] & 1 == 1) if bit_of[cell] >= 0 else np.full(len(state), p[cell] == 1.0)
            term[still_free & wall] = table.loglik[k]
            still_free &= ~wall
        log_p += term
    log_evidence = float(special.logsumexp(log_p))
    return Enumeration(unknown, log_p - log_evidence, log_evidence, problem)


def _pairs_alike(problem: WallProblem, state: NDArray[np.int64], bit_of: NDArray[np.int64]) -> NDArray[np.int64]:
    """Count the pairs of neighbours that are both walls or both free, in each state."""
    cells, pairs = np.arange(problem.grid.n_cells).reshape(problem.grid.shape), np.zeros(len(state), dtype=np.int64)

    def walls(cell: int) -> NDArray[np.bool_]:
        if bit_of[cell] < 0:
            return np.full(len(state), problem.p_wall[cell] == 1.0)
        return np.asarray(state >> bit_of[cell] & 1 == 1)

    for one, other in ((cells[1:], cells[:-1]), (cells[:, 1:], cells[:, :-1])):
        for a, b in zip(one.ravel().tolist(), other.ravel().tolist(), strict=True):
            pairs += walls(a) == walls(b)
    return pairs


Floats = NDArray[np.float64]


@dataclass(frozen=True)
class DrawRequest:
    """What to draw: ``chains * draws`` draws by ``seed``, after ``particles`` or ``rounds`` of work."""

    chains: int
    draws: int
    seed: int
    particles: int
    rounds: int


@dataclass(frozen=True, eq=False)
class IndependentDraws:
    """Independent draws, and the results of the method beside them.

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


def exact(problem: WallProblem, request: DrawRequest, watch: Watch) -> IndependentDraws:
    """Enumerate the whole posterior, and draw from it."""
    whole = enumerate_maps(problem)
    return _found(problem, request, whole.sample, whole.marginals(), log_evidence=whole.log_evidence)


def importance(problem: WallProblem, request: DrawRequest, watch: Watch) -> IndependentDraws:
    """Weigh maps, and resample draws from them."""
    particles = sample_importance(problem, request.particles, request.seed, watch=watch)
    return draws_by_importance(problem, request, particles)


def draws_by_importance(problem: WallProblem, request: DrawRequest, particles: Particles) -> IndependentDraws:
    """Resample draws from particles that have been weighed."""
    return _found(
        problem,
        request,
        lambda rng, count: particles.maps(particles.resample(rng, count)),
        particles.occupancy(),
        log_weights=particles.log_weights,
        log_evidence=particles.log_evidence,
        seconds=particles.seconds,
        finished=particles.finished,
    )


def belief_propagation(problem: WallProblem, request: DrawRequest, watch: Watch) -> IndependentDraws:
    """Propagate beliefs, and draw each cell independently: belief propagation gives marginals alone."""
    return draws_by_beliefs(problem, request, propagate(problem, rounds=request.rounds, watch=watch))


def draws_by_beliefs(problem: WallProblem, request: DrawRequest, marginals: Marginals) -> IndependentDraws:
    """Draw each cell independently from beliefs that have been propagated."""
    return _found(
        problem,
        request,
        lambda rng, count: rng.random((count, *marginals.p_wall.shape)) < marginals.p_wall,
        marginals.p_wall,
        statistics={"belief_changes": marginals.changes},
        seconds=marginals.seconds,
        finished=marginals.finished,
    )


def _found(
    problem: WallProblem,
    request: DrawRequest,
    draw: Callable[[np.random.Generator, int], NDArray[np.bool_]],
    occupancy: Floats,
    *,
    log_weights: Floats | None = None,
    log_evidence: float | None = None,
    statistics: Mapping[str, Floats] | None = None,
    seconds: float = 0.0,
    finished: bool = True,
) -> IndependentDraws:
    from bayesmap.kernels.walls.maps import log_likelihoods, reach_frequency

    rngs = [np.random.default_rng([request.seed, chain, STREAM_START]) for chain in range(request.chains)]
    walls = np.stack([draw(rng, request.draws) for rng in rngs])
    packed = pack(walls)
    flat = walls.reshape(-1, *problem.grid.shape)
    inspected = np.unique(np.linspace(0, len(flat) - 1, 32).astype(int)) if len(flat) else None
    maps = occupancy[None] > 0.5 if inspected is None else flat[inspected]
    return IndependentDraws(
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
