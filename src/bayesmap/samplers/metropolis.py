"""Metropolis sampling of any kind of cells, cell by cell, in plain NumPy: for kinds without a sampler of their own.

Every sweep proposes another state for each cell (`CellPrior.propose`). It is accepted with probability min(1, ratio).
The ratio is that of the likelihoods of the beams that touch the cell, times that of priors and proposals (Metropolis et
al., 1953; Hastings, 1970). The sensor needs only a density.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.cells.kind import Floats
from bayesmap.model import Model, log_likelihoods
from bayesmap.samplers.sampler import SILENT, ChainState, Info, Keep, RaysProblem, Snapshot, Stream, Watch


@dataclass(frozen=True, eq=False)
class MetropolisProblem(RaysProblem):
    """A model, its rays, and the beams that touch each cell."""

    model: Model
    rays: Rays

    @cached_property
    def beams_of(self) -> list[NDArray[np.int32]]:
        """The beams that touch each cell, by flat index."""
        order = np.argsort(self.rays.cells, kind="stable")
        bounds = np.searchsorted(self.rays.cells[order], np.arange(self.grid.n_cells + 1))
        beam = self.rays.beam_of_entry()[order]
        return [np.unique(beam[bounds[c] : bounds[c + 1]]) for c in range(self.grid.n_cells)]

    @cached_property
    def rays_of(self) -> list[Rays]:
        """The beams that touch each cell, as rays."""
        return [self.rays.select(beams) for beams in self.beams_of]

    def log_likelihoods(self, cells: Mapping[str, NDArray[Any]], beta: float, rays: Rays) -> Floats:
        """Compute log p(reading | cells) of the beams in ``rays`` at an inverse temperature."""
        stops = self.model.cells.stops(cells, self.grid)
        return log_likelihoods(rays, stops, self.model.sensor, self.model.hit_depth, beta)


@dataclass(frozen=True, eq=False)
class MetropolisState(ChainState):
    """Maps of several chains between two sweeps."""

    problem: MetropolisProblem
    maps: tuple[dict[str, NDArray[Any]], ...]
    chain_ids: tuple[int, ...]
    seed: int


@dataclass(frozen=True)
class Metropolis:
    """Every sweep proposes each cell of the grid a new state once."""

    def prepare(
        self, model: Model, device: str, threads: int | None = None, watch: Watch = SILENT
    ) -> MetropolisProblem:
        """Trace the beams; the sweeps run in NumPy, on the CPU."""
        from bayesmap.kernels.device import resolve
        from bayesmap.kernels.rays import trace_rays

        rays = trace_rays(model.scans, model.grid, device=resolve(device), on_progress=watch.of("trace"))
        return MetropolisProblem(model, rays)

    def init(
        self, problem: MetropolisProblem, chain_ids: Sequence[int], seed: int, resume: Snapshot | None = None,
        watch: Watch = SILENT,
    ) -> MetropolisState:  # fmt: skip
        """Start chains at draws from the prior, or at the maps of a snapshot."""
        if resume is None:
            rngs = [np.random.default_rng([seed, chain, Stream.START]) for chain in chain_ids]
            starts = [problem.model.cells.sample_cells(rng, problem.grid) for rng in rngs]
        else:
            starts = [{name: a[i].copy() for name, a in resume.arrays.items()} for i in range(len(chain_ids))]
        return MetropolisState(problem, 0 if resume is None else resume.sweep, tuple(starts), tuple(chain_ids), seed)

    def step(
        self, state: MetropolisState, sweeps: int, beta: float = 1.0, keep: Keep = Keep()
    ) -> tuple[MetropolisState, Info]:
        """Make some sweeps of all chains, in place; a kept draw is the map after its sweep."""
        problem, chains = state.problem, len(state.maps)
        prior, sizes = problem.model.cells, {"x": problem.grid.shape[0], "y": problem.grid.shape[1]}
        kept = keep.sweeps(state.sweep, state.sweep + sweeps)
        draws = {s.name: s.empty(chains, len(kept), tuple(sizes[dim] for dim in s.dims)) for s in prior.arrays}
        log_likelihood, log_prior = np.zeros((chains, sweeps)), np.zeros((chains, sweeps))
        for chain, cells in enumerate(state.maps):
            beam_log_likelihoods = problem.log_likelihoods(cells, beta, problem.rays)
            for i in range(sweeps):
                number = state.sweep + i
                rng = np.random.default_rng([state.seed, state.chain_ids[chain], Stream.SWEEPS, number])
                beam_log_likelihoods = _sweep(problem, cells, beam_log_likelihoods, beta, rng)
                log_likelihood[chain, i] = beam_log_likelihoods.sum()
                log_prior[chain, i] = prior.log_prob(cells, problem.grid)
                if number + 1 in kept:
                    for spec in prior.arrays:
                        draws[spec.name][chain, kept.index(number + 1)] = spec.stored(cells[spec.name])
        return replace(state, sweep=state.sweep + sweeps), Info(log_likelihood, log_prior, draws)

    def snapshot(self, state: MetropolisState) -> Snapshot:
        """Return the maps."""
        return Snapshot(state.sweep, {name: np.stack([cells[name] for cells in state.maps]) for name in state.maps[0]})

    def observed_counts(self, state: MetropolisState, draws: Mapping[str, NDArray[Any]]) -> NDArray[np.int32]:
        """Count each cell that a beam touches as observed in one draw. Returns (2, nx, ny)."""
        touched = state.problem.touched().astype(np.int32)
        return np.stack([touched, np.ones_like(touched)])


def _sweep(
    problem: MetropolisProblem, cells: dict[str, NDArray[Any]], beam_log_likelihoods: Floats, beta: float,
    rng: np.random.Generator,
) -> Floats:  # fmt: skip
    """Propose each cell another state, in place, and return the log-likelihoods of all beams afterwards."""
    ny = problem.grid.shape[1]
    for c, beams in enumerate(problem.beams_of):
        site = (c // ny, c % ny)
        proposal, log_ratio = problem.model.cells.propose(cells, site, rng, problem.grid)
        old = {name: cells[name][site].copy() for name in proposal}
        for name, value in proposal.items():
            cells[name][site] = value
        if len(beams):
            proposed = problem.log_likelihoods(cells, beta, problem.rays_of[c])
            log_ratio += float((proposed - beam_log_likelihoods[beams]).sum())
        if np.log(rng.random()) < log_ratio:
            if len(beams):
                beam_log_likelihoods[beams] = proposed
        else:
            for name, value in old.items():
                cells[name][site] = value
    return beam_log_likelihoods
