"""Metropolis sampling of any kind of cells, cell by cell, in plain NumPy: for kinds without a sampler of their own.

Every sweep (`_sweep`) proposes another state for each cell (`CellPrior.propose`) and accepts it with probability
min(1, ratio). The ratio is the likelihood ratio of the beams that touch the cell, times the ratios of priors and of
proposals (Metropolis et al., 1953; Hastings, 1970). The sensor needs only a density.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.model import Model, log_likelihoods
from bayesmap.samplers.sampler import SILENT, ChainState, Info, Keep, RaysProblem, Snapshot, Stream, Watch
from bayesmap.space.arrays import Floats, Ints, Rng


@dataclass(frozen=True, eq=False)
class MetropolisProblem(RaysProblem):
    """A model, its rays, and the beams that touch each cell."""

    model: Model
    rays: Rays

    @cached_property
    def beams_by_cell(self) -> list[Ints]:
        """The indices of the beams that touch each cell, one array a cell, by flat index."""
        order = np.argsort(self.rays.cells, kind="stable")
        bounds = np.searchsorted(self.rays.cells[order], np.arange(self.grid.n_cells + 1))
        beam = self.rays.beam_of_entry()[order]
        return [np.unique(beam[bounds[cell] : bounds[cell + 1]]) for cell in range(self.grid.n_cells)]

    @cached_property
    def rays_by_cell(self) -> list[Rays]:
        """The rays of the beams that touch each cell, by flat index."""
        return [self.rays.select(beams) for beams in self.beams_by_cell]

    def log_likelihoods(self, cells: Mapping[str, NDArray[Any]], beta: float, rays: Rays) -> Floats:
        """Compute log p(reading | cells) of the beams in ``rays`` at the inverse temperature ``beta``, nats, (B,)."""
        stops = self.model.cells.stops(cells, self.grid)
        return log_likelihoods(rays, stops, self.model.sensor, self.model.hit_depth, beta)


@dataclass(frozen=True, eq=False)
class MetropolisState(ChainState):
    """Maps of several chains between two sweeps."""

    problem: MetropolisProblem
    maps: tuple[dict[str, NDArray[Any]], ...]  # arrays of the cells by name, for each chain, changed in place
    chain_ids: tuple[int, ...]  # numbers among all chains of the run
    seed: int


@dataclass(frozen=True)
class Metropolis:
    """A sampler whose sweeps propose a new state for each cell of the grid once."""

    def prepare(
        self, model: Model, device: str, threads: int | None = None, watch: Watch = SILENT
    ) -> MetropolisProblem:
        """Trace the beams. The sweeps run in NumPy, on the CPU, and do not use ``threads``."""
        from bayesmap.kernels.device import resolve
        from bayesmap.kernels.rays import trace_rays

        rays = trace_rays(model.scans, model.grid, device=resolve(device), on_progress=watch.for_stage("trace"))
        return MetropolisProblem(model, rays)

    def init(
        self, problem: MetropolisProblem, chain_ids: Sequence[int], seed: int, resume: Snapshot | None = None,
        watch: Watch = SILENT,
    ) -> MetropolisState:  # fmt: skip
        """Start chains at draws from the prior, or at the maps of a snapshot; ``watch`` is not used."""
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
        problem, n_chains = state.problem, len(state.maps)
        prior = problem.model.cells
        sizes = dict(zip(("x", "y"), problem.grid.shape, strict=True))
        kept = keep.sweeps(state.sweep, state.sweep + sweeps)
        shapes = {spec.name: tuple(sizes[dim] for dim in spec.dims) for spec in prior.arrays}
        draws = {spec.name: spec.empty(n_chains, len(kept), shapes[spec.name]) for spec in prior.arrays}
        log_likelihood, log_prior = np.zeros((n_chains, sweeps)), np.zeros((n_chains, sweeps))
        for chain, cells in enumerate(state.maps):
            beam_log_likelihoods = problem.log_likelihoods(cells, beta, problem.rays)
            for i in range(sweeps):
                sweep = state.sweep + i
                rng = np.random.default_rng([state.seed, state.chain_ids[chain], Stream.SWEEPS, sweep])
                beam_log_likelihoods = _sweep(problem, cells, beam_log_likelihoods, beta, rng)
                log_likelihood[chain, i] = beam_log_likelihoods.sum()
                log_prior[chain, i] = prior.log_prob(cells, problem.grid)
                if sweep + 1 in kept:  # `Keep` counts sweeps from 1
                    for spec in prior.arrays:
                        draws[spec.name][chain, kept.index(sweep + 1)] = spec.stored(cells[spec.name])
        return replace(state, sweep=state.sweep + sweeps), Info(log_likelihood, log_prior, draws)

    def snapshot(self, state: MetropolisState) -> Snapshot:
        """Return the maps."""
        return Snapshot(state.sweep, {name: np.stack([cells[name] for cells in state.maps]) for name in state.maps[0]})

    def observed_counts(self, state: MetropolisState, draws: Mapping[str, NDArray[Any]]) -> Ints:
        """Count each cell that a beam touches as observed in one draw, whatever the draws. Returns (2, nx, ny)."""
        touched = state.problem.touched_map().astype(np.int32)
        return np.stack([touched, np.ones_like(touched)])


def _sweep(
    problem: MetropolisProblem, cells: dict[str, NDArray[Any]], beam_log_likelihoods: Floats, beta: float, rng: Rng,
) -> Floats:  # fmt: skip
    """Propose another state for each cell of a map, in place. Takes and returns the log-likelihoods of all beams."""
    ny = problem.grid.shape[1]
    for cell, beams in enumerate(problem.beams_by_cell):
        # Put the proposal into the map, and weigh it by the beams that touch the cell.
        site = (cell // ny, cell % ny)
        proposal, log_ratio = problem.model.cells.propose(cells, site, rng, problem.grid)
        previous = {name: cells[name][site].copy() for name in proposal}
        for name, value in proposal.items():
            cells[name][site] = value
        if len(beams):
            proposed = problem.log_likelihoods(cells, beta, problem.rays_by_cell[cell])
            log_ratio += float((proposed - beam_log_likelihoods[beams]).sum())
        if np.log(rng.random()) < log_ratio:
            if len(beams):
                beam_log_likelihoods[beams] = proposed
        else:
            for name, value in previous.items():
                cells[name][site] = value
    return beam_log_likelihoods
