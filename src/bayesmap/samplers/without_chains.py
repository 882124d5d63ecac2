"""Methods on binary walls that need no Markov chain: their draws are independent.

Belief propagation with ray potentials (`propagate`) gives approximate marginals in a few rounds;
`bayesmap.kernels.walls.propagate` states the messages. Self-normalised importance sampling from the prior
(`sample_importance`) shows why better methods are needed: its weights collapse. Exact enumeration (`enumerate_maps`) is
the reference against which every sampler is tested. The functions at the end turn the results into draws.
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells.arrays import pack
from bayesmap.errors import BadInput, check_count
from bayesmap.samplers.sampler import SILENT, Stream, Watch
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.space.arrays import Floats, Indices, Mask, Rng

DAMPING = 0.5  # default of `propagate`: weight of the old message
ROUNDS = 20  # default of `propagate`: most rounds
MAX_UNKNOWN = 16  # most unknown cells of `enumerate_maps`: 65 536 states
BATCH_CELLS = 1 << 23  # cells per batch of maps
COUPLED_BATCH_CELLS = 1 << 13  # cells per batch of maps with coupled neighbours
INSPECTED_MAPS = 32  # most maps that decide which cells count as observed
MIN_BATCH, MAX_BATCH = 256, 1 << 20  # particles that are weighed together
NEGLIGIBLE_NATS = 40.0  # a particle this far below the best adds nothing to any mean


@dataclass(frozen=True, eq=False)
class Marginals:
    """The marginals of belief propagation, and the course of its rounds."""

    p_wall: Floats  # approximate posterior wall probability, (nx, ny)
    changes: Floats  # largest change of any cell's probability in each round, (rounds,)
    converged: bool  # whether the last largest change was below the tolerance
    finished: bool  # whether it converged or made all rounds; false if it was stopped early
    seconds: float
    prior: Floats | None = None  # wall probability without any beam, (nx, ny); None if it is the prior's own


def propagate(
    problem: WallProblem, *, rounds: int = ROUNDS, damping: float = DAMPING, tolerance: float = 1e-3, beta: float = 1.0,
    watch: Watch = SILENT,
) -> Marginals:  # fmt: skip
    """Pass messages between all beams and cells until beliefs converge, or for a number of rounds.
    If no cell lies on two beams and neighbours are not coupled, one undamped round is exact. If beams and coupled
    neighbours form a tree, as many rounds as it is wide are exact. Other marginals are approximate, mostly too certain.
    Rounds end when no probability changes by over ``tolerance``. ``damping`` in [0, 1) is the old message's weight in
    the new one, geometrically. ``beta`` is the inverse temperature. Raises `BadInput` if one is out of range.
    """
    from bayesmap.kernels.walls.propagate import Beliefs

    rounds = check_count("propagate", "rounds", rounds, 1)
    if not 0 <= damping < 1:
        raise BadInput(f"propagate: damping must lie in [0, 1), got {damping!r}")
    began_s = time.perf_counter()
    beliefs = Beliefs(problem.table, problem.logit, problem.device, beta, problem.coupling)
    p_wall = special.expit(beliefs.log_odds().astype(np.float64))
    changes = []
    for number in range(rounds):
        previous = p_wall
        beliefs.round(damping, problem.threads)
        p_wall = special.expit(beliefs.log_odds().astype(np.float64))
        changes.append(float(np.abs(p_wall - previous).max()))
        watch.report("propagate", number + 1, rounds)
        if changes[-1] < tolerance or watch.should_stop():
            break
    # The log-odds of fixed cells are large but finite: set their probabilities exactly.
    p_wall = np.where((problem.p_wall == 0) | (problem.p_wall == 1), problem.p_wall, p_wall)
    return Marginals(
        p_wall=p_wall.reshape(problem.table.grid.shape), changes=np.array(changes),
        converged=changes[-1] < tolerance, finished=changes[-1] < tolerance or len(changes) == rounds,
        seconds=time.perf_counter() - began_s,
    )  # fmt: skip


def propagate_to_start(problem: WallProblem, rounds: int = ROUNDS, watch: Watch = SILENT) -> Marginals:
    """Propagate beliefs for a start; if neighbours are coupled, also without beams, to find the effect of beams."""
    marginals = propagate(problem, rounds=rounds, watch=watch)
    if problem.coupling == 0.0:
        return marginals
    return replace(marginals, prior=propagate(problem, rounds=rounds, beta=0.0).p_wall)


@dataclass(frozen=True, eq=False)
class Particles:
    """Weighted maps that are drawn from the prior. A map is stored as its number, by which it can be drawn again."""

    log_weights: Floats  # normalised, (particles,)
    log_evidence: float  # log of the mean weight: an estimate of log p(readings)
    problem: WallProblem
    key: int  # key of the random numbers; with a particle's number it gives the map
    seconds: float
    finished: bool  # whether all particles were weighed; false if stopped early

    @property
    def effective_sample_size(self) -> float:
        """1 / sum of squared weights; 1 if a single particle has all weight."""
        return float(np.exp(-special.logsumexp(2 * self.log_weights)))

    def maps(self, particles: Indices) -> Mask:
        """Return the maps of the given particles, (n, nx, ny)."""
        from bayesmap.kernels.walls.table import particle_maps

        if self.problem.coupling != 0.0:
            return _coupled_maps(self.problem, self.key, particles)
        walls = particle_maps(self.problem.device_prior, self.key, particles, self.problem.device)
        return np.asarray(walls.reshape(len(particles), *self.problem.table.grid.shape) != 0)

    def occupancy(self) -> Floats:
        """Return the weighted mean of the maps, (nx, ny). Independent cells that no beam touches take the prior."""
        heavy = np.nonzero(self.log_weights > self.log_weights.max() - NEGLIGIBLE_NATS)[0]
        mean = np.zeros(self.problem.table.grid.shape)
        batch = max(1, BATCH_CELLS // mean.size)
        for i in range(0, len(heavy), batch):
            particles = heavy[i : i + batch]
            mean += np.tensordot(np.exp(self.log_weights[particles]), self.maps(particles), axes=1)
        mean /= np.exp(self.log_weights[heavy]).sum()
        if self.problem.coupling != 0.0:
            return mean
        return np.where(self.problem.table.touched_map(), mean, self.problem.p_wall.reshape(mean.shape))

    def resample(self, rng: Rng, count: int) -> Indices:
        """Draw the numbers of ``count`` particles with replacement, each with its weight's probability."""
        cumulative = np.cumsum(np.exp(self.log_weights))
        return np.searchsorted(cumulative / cumulative[-1], rng.random(count), side="right")


def sample_importance(
    problem: WallProblem, particles: int, seed: int, *, beta: float = 1.0, watch: Watch = SILENT
) -> Particles:
    """Weigh prior draws by their likelihood^beta. Raises `BadInput` without particles, or if it cannot draw."""
    from bayesmap.kernels.random import mix

    particles = check_count("importance", "particles", particles, 1)
    key = mix(seed, 0, Stream.PARTICLES)
    log_likelihoods: list[Floats] = []
    began_s = time.perf_counter()
    batch_size, n_weighed = MIN_BATCH, 0
    watch.report("particles", 0, particles)  # the first particles of a large map take long
    while n_weighed < particles and not (log_likelihoods and watch.should_stop()):
        count = min(batch_size, particles - n_weighed)
        log_likelihoods.append(_weigh(problem, key, n_weighed, count))
        n_weighed += count
        # Later batches take about a quarter of a second, so that a stop is noticed soon.
        batch_size = int(np.clip(0.25 * n_weighed / max(time.perf_counter() - began_s, 1e-9), MIN_BATCH, MAX_BATCH))
        watch.report("particles", n_weighed, particles)
    log_weights = beta * np.concatenate(log_likelihoods)
    log_total = float(special.logsumexp(log_weights))
    return Particles(
        log_weights=log_weights - log_total, log_evidence=log_total - float(np.log(n_weighed)), problem=problem,
        key=key, seconds=time.perf_counter() - began_s, finished=n_weighed == particles,
    )  # fmt: skip


def _weigh(problem: WallProblem, key: int, first: int, count: int) -> Floats:
    """Compute log p(readings | map) of particles first .. first + count - 1."""
    from bayesmap.kernels.walls.table import log_likelihoods, particle_log_weights

    if problem.coupling == 0.0:
        return particle_log_weights(problem.device_table, problem.device_prior, key, first, count, problem.device)
    maps = _coupled_maps(problem, key, np.arange(first, first + count))
    return log_likelihoods(problem.table, pack(maps), problem.device)


def _coupled_maps(problem: WallProblem, key: int, particles: Indices) -> Mask:
    """Return the maps of particles by number, (n, nx, ny). The number of a batch seeds all its maps together."""
    out = np.empty((len(particles), *problem.grid.shape), dtype=np.bool_)
    batch_size = max(1, COUPLED_BATCH_CELLS // problem.grid.n_cells)
    batch_of_particle = particles // batch_size
    for batch in np.unique(batch_of_particle).tolist():
        maps = problem.prior.sample_maps(np.random.default_rng([key, batch]), problem.grid, batch_size)
        mask = batch_of_particle == batch
        out[mask] = maps[particles[mask] % batch_size]
    return out


@dataclass(frozen=True, eq=False)
class Enumeration:
    """The whole posterior over n unknown cells: those that a beam touches or that are coupled, and not fixed."""

    unknown: Indices  # flat indices of the unknown cells, (n,)
    log_posterior: Floats  # normalised, of each state, (2^n,); bit i of a state is the wall in ``unknown[i]``
    log_evidence: float  # log p(readings)
    problem: WallProblem

    def states(self) -> Mask:
        """Return the enumerated cells in each state, (2^n, n)."""
        return _bits(np.arange(len(self.log_posterior))[:, None], np.arange(len(self.unknown)))

    def marginals(self) -> Floats:
        """Return the posterior wall probability of every cell, (nx, ny). Unobserved cells keep the prior's."""
        p = self.problem.p_wall.copy()
        p[self.unknown] = np.exp(self.log_posterior) @ self.states()
        return p.reshape(self.problem.table.grid.shape)

    def pair_probabilities(self) -> Floats:
        """Return the posterior probability that both of two enumerated cells are walls, (n, n)."""
        states = self.states().astype(np.float64)
        return np.asarray((states * np.exp(self.log_posterior)[:, None]).T @ states)

    def sample(self, rng: Rng, count: int) -> Mask:
        """Draw maps independently, (count, nx, ny)."""
        shape = self.problem.table.grid.shape
        walls = rng.random((count, shape[0] * shape[1])) < self.problem.p_wall
        state = rng.choice(len(self.log_posterior), size=count, p=np.exp(self.log_posterior))
        walls[:, self.unknown] = self.states()[state]
        return walls.reshape(count, *shape)


def enumerate_maps(problem: WallProblem) -> Enumeration:
    """Compute p(map | readings) of every map in NumPy. Raises `BadInput` for more than `MAX_UNKNOWN` unknown cells."""
    table, p = problem.table, problem.p_wall
    # Cells that no beam touches matter if neighbours are coupled.
    matters = table.touched_map().ravel() | (problem.coupling != 0.0)
    unknown = np.nonzero(matters & (p > 0) & (p < 1))[0]
    if len(unknown) > MAX_UNKNOWN:
        raise BadInput(
            f"exact: {len(unknown)} cells are unknown, and enumeration takes at most {MAX_UNKNOWN}; "
            "use method 'gibbs' or 'block', or fix cells with a prior of 0 or 1"
        )
    bit_of_cell = np.full(table.grid.n_cells, -1)
    bit_of_cell[unknown] = np.arange(len(unknown))
    state = np.arange(1 << len(unknown))
    log_p = np.zeros(len(state))
    for i, cell in enumerate(unknown):
        log_p += np.where(state >> i & 1, np.log(p[cell]), np.log1p(-p[cell]))
    if problem.coupling != 0.0:
        log_p += problem.coupling * _count_alike_pairs(problem, state, bit_of_cell)
        log_p -= special.logsumexp(log_p)
    # Log-likelihood of each beam: its first wall in each state.
    for b in range(table.n_beams):
        still_free = np.ones(len(state), dtype=np.bool_)
        term = np.full(len(state), np.float64(table.no_hit[b]))
        for k in range(table.offsets[b], table.offsets[b + 1]):
            is_wall = _walls_in(table.cells[k], problem, state, bit_of_cell)
            term[still_free & is_wall] = table.loglik[k]
            still_free &= ~is_wall
        log_p += term
    log_evidence = float(special.logsumexp(log_p))
    return Enumeration(unknown, log_p - log_evidence, log_evidence, problem)


def _bits(state: NDArray[np.int64], bit: NDArray[np.int64]) -> Mask:
    """Return whether bits of states are set."""
    return np.asarray(state >> bit & 1 == 1)


def _walls_in(cell: int, problem: WallProblem, state: NDArray[np.int64], bit_of_cell: NDArray[np.int64]) -> Mask:
    """Return whether one cell, by flat index, is a wall in each state, (2^n,)."""
    if bit_of_cell[cell] >= 0:
        return _bits(state, bit_of_cell[cell])
    return np.full(len(state), problem.p_wall[cell] == 1.0)


def _count_alike_pairs(
    problem: WallProblem, state: NDArray[np.int64], bit_of_cell: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Count the pairs of neighbours that are both walls or both free, in each state, (2^n,)."""
    cells = np.arange(problem.grid.n_cells).reshape(problem.grid.shape)
    pairs = np.zeros(len(state), dtype=np.int64)
    for cell, neighbour in ((cells[1:], cells[:-1]), (cells[:, 1:], cells[:, :-1])):
        for a, b in zip(cell.ravel().tolist(), neighbour.ravel().tolist(), strict=True):
            pairs += _walls_in(a, problem, state, bit_of_cell) == _walls_in(b, problem, state, bit_of_cell)
    return pairs


@dataclass(frozen=True)
class DrawRequest:
    """A request of ``chains * draws`` draws."""

    chains: int
    draws: int  # draws per chain
    seed: int
    particles: int  # number of particles for importance sampling
    rounds: int  # number of rounds of belief propagation


@dataclass(frozen=True, eq=False)
class IndependentDraws:
    """Independent draws, and further results of the method, as in `bayesmap.posterior.posterior.Posterior`."""

    walls: NDArray[np.uint8]  # packed maps, (chains, draws, ceil(N / 8))
    log_likelihood: Floats  # log-likelihood of each map, (chains, draws)
    log_prior: Floats
    occupancy: Floats  # marginals, (nx, ny)
    observed: Mask  # cells that a beam reaches in at least half of the maps, (nx, ny)
    seconds: float = 0.0  # time of the method before it draws
    finished: bool = True  # false if the method was stopped early
    log_weights: Floats | None = None
    statistics: Mapping[str, Floats] = field(default_factory=dict)
    log_evidence: float | None = None


def draw_by_enumeration(problem: WallProblem, request: DrawRequest, watch: Watch) -> IndependentDraws:
    """Enumerate the whole posterior, and draw from it; ``watch`` is not used."""
    posterior = enumerate_maps(problem)
    return _draw(problem, request, posterior.sample, posterior.marginals(), log_evidence=posterior.log_evidence)


def draw_by_importance(problem: WallProblem, request: DrawRequest, watch: Watch) -> IndependentDraws:
    """Weigh maps, and resample draws from them."""
    particles = sample_importance(problem, request.particles, request.seed, watch=watch)
    return resample_particles(problem, request, particles)


def resample_particles(problem: WallProblem, request: DrawRequest, particles: Particles) -> IndependentDraws:
    """Resample draws from particles that have been weighed."""
    return _draw(
        problem, request, lambda rng, count: particles.maps(particles.resample(rng, count)), particles.occupancy(),
        log_weights=particles.log_weights, log_evidence=particles.log_evidence, seconds=particles.seconds,
        finished=particles.finished,
    )  # fmt: skip


def draw_by_propagation(problem: WallProblem, request: DrawRequest, watch: Watch) -> IndependentDraws:
    """Propagate beliefs, and draw each cell independently: belief propagation gives marginals alone."""
    return draw_from_marginals(problem, request, propagate(problem, rounds=request.rounds, watch=watch))


def draw_from_marginals(problem: WallProblem, request: DrawRequest, marginals: Marginals) -> IndependentDraws:
    """Draw each cell independently from its marginal."""
    return _draw(
        problem, request, lambda rng, count: rng.random((count, *marginals.p_wall.shape)) < marginals.p_wall,
        marginals.p_wall, statistics={"belief_changes": marginals.changes}, seconds=marginals.seconds,
        finished=marginals.finished,
    )  # fmt: skip


def _draw(
    problem: WallProblem, request: DrawRequest, sample: Callable[[Rng, int], Mask], occupancy: Floats, **results: Any,
) -> IndependentDraws:  # fmt: skip
    """Draw maps for every chain by ``sample``; ``results`` are further fields of `IndependentDraws`."""
    from bayesmap.kernels.walls.table import log_likelihoods, reach_frequency

    rngs = [np.random.default_rng([request.seed, chain, Stream.START]) for chain in range(request.chains)]
    walls = np.stack([sample(rng, request.draws) for rng in rngs])
    packed = pack(walls)
    maps = walls.reshape(-1, *problem.grid.shape)
    indices = np.unique(np.linspace(0, len(maps) - 1, INSPECTED_MAPS).astype(int))
    inspected = maps[indices] if len(maps) else occupancy[None] > 0.5
    return IndependentDraws(
        walls=packed,
        log_likelihood=np.stack([log_likelihoods(problem.table, chain, problem.device) for chain in packed]),
        log_prior=np.array([[problem.prior.log_prob(w, problem.grid) for w in chain] for chain in walls]),
        occupancy=occupancy, observed=reach_frequency(problem.table, inspected, problem.device) >= 0.5, **results,
    )  # fmt: skip
