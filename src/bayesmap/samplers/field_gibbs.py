"""Gibbs sampling of reflectivities and surfaces, with each beam's stop drawn along (docs/surfaces.md).

Given the cells, where each beam stops is drawn from its exact conditional in one walk along the beam; given the stops,
each cell's reflectivity is a Beta, and its surface takes a Metropolis step. The reflectivity half goes back to
"counting" maps (Haehnel, 2004), which keep the counts of one assignment; here the assignments are drawn.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.beam_rays import BeamRays
from bayesmap.beams.rays import around_readings
from bayesmap.cells.reflectivity import Reflective
from bayesmap.errors import BadInput
from bayesmap.samplers.fit import BEAMS_LOOKED_AT, Stops
from bayesmap.samplers.plug_in import PlugIn, pace, plug_in, starts, steps
from bayesmap.samplers.sampler import STREAM_START, STREAM_SWEEPS
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.model import SensorModel
from bayesmap.sensors.noise import Gaussian
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

CELLS_AROUND = 1.5
SIGMAS_AROUND = 6.0
"""A stop further from its reading than so many cells and standard deviations counts as a random reading's."""


@dataclass(frozen=True, eq=False)
class FieldProblem:
    """Rays through cells that stop some of them, under a prior.

    Attributes:
        rays: cells along every beam.
        prior: `Beta` or `Surface`, as given; fitted ones are handed to each sweep.
        sensor: the law of the readings, likewise.
        device: where kernels run.
    """

    rays: BeamRays
    prior: Reflective
    sensor: BeamMixture
    device: str = "cpu"

    @property
    def plain(self) -> bool:
        """Whether cells have no surfaces."""
        return not self.prior.has_surfaces

    @cached_property
    def guess(self) -> PlugIn:
        """Hits, passes and moments of the readings at their word."""
        return plug_in(self.rays, self.prior, self.device)


def build_field(
    scans: Scans,
    grid: Grid,
    prior: Reflective,
    sensor: SensorModel,
    *,
    hit_depth: float = 0.5,
    device: str = "cpu",
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> FieldProblem:
    """Trace the scans' rays, as far as their readings can be explained; ``on_progress`` is told of beams done.

    Raises:
        BadInput: a sensor that is not a `BeamMixture` of Gaussian noise, or too many incidences.
    """
    from bayesmap.kernels.device import resolve
    from bayesmap.kernels.rays import stop_distances, trace_rays

    device = resolve(device)
    if not (isinstance(sensor, BeamMixture) and isinstance(sensor.noise, Gaussian)):
        raise BadInput(
            "infer: reflectivity and surface maps need a BeamMixture sensor with Gaussian noise (on the command line "
            f"mixture:0.02), got {type(sensor).__name__}; the spread of a surface stands for heavier tails"
        )
    ranges = np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 0.0)
    margin_m = CELLS_AROUND * grid.resolution + SIGMAS_AROUND * sensor.noise.scale_at(ranges).ravel()
    reach_m, near_m = around_readings(scans, margin_m, grid.resolution)
    rays = trace_rays(scans, grid, reach_m=reach_m, near_m=near_m, device=device, on_progress=on_progress)
    return FieldProblem(BeamRays.of(rays, stop_distances(rays, hit_depth, device)), prior, sensor, device)


def prior_numbers(prior: Reflective, edge_m: float) -> Any:
    """The prior as kernels take it, lengths in metres."""
    from bayesmap.kernels.field import PriorNumbers

    return PriorNumbers(*prior.kernel_numbers(edge_m))


class FieldGibbs:
    """Chains of cell states, advanced a sweep at a time."""

    def __init__(
        self,
        problem: FieldProblem,
        chains: int,
        seed: int,
        *,
        threads: int | None = None,
        states: NDArray[np.float32] | None = None,
        counts: NDArray[np.int32] | None = None,
    ) -> None:
        """Start chains about the plug-in guess, or go on from given states (C, T, 6) and counts (2, C, T)."""
        from bayesmap.kernels.field import FieldChains

        self.problem = problem
        if states is None:
            rng = np.random.default_rng([seed, STREAM_START])
            states = starts(problem.guess, problem.prior, problem.rays.grid.resolution, chains, rng)
        self._chains = FieldChains(
            problem.rays,
            states,
            steps(problem.guess, problem.rays.grid.resolution),
            pace(problem.guess),
            plain=problem.plain,
            seed=seed,
            stream=STREAM_SWEEPS,
            threads=threads,
            device=problem.device,
            counts=counts,
        )
        every = max(1, math.ceil(problem.rays.n_beams * len(states) / BEAMS_LOOKED_AT))
        self._looked_at = slice(every // 2, None, every)

    def sweep(
        self, number: int, sensor: BeamMixture, prior: Reflective
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """One sweep of all chains; log-likelihood and log prior of the states *before* it, (C,) each."""
        parameters = sensor.kernel_parameters()
        assert parameters is not None
        numbers = prior_numbers(prior, self.problem.rays.grid.resolution)
        return self._chains.sweep(number, parameters, numbers)

    def states(self) -> NDArray[np.float32]:
        """A copy of all cells, (C, T, 6)."""
        return self._chains.states()

    def cells(self, chain: int) -> NDArray[np.float32]:
        """All cells of a chain, (T, 6): on the CPU not a copy, and to be read before the next sweep."""
        return self._chains.cells(chain)

    def counted(self, chain: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Hits and met of one chain, (T,) each, likewise."""
        return self._chains.counted(chain)

    def counts(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Hits and met of the last sweep, (C, T) each."""
        return self._chains.counts()

    def stops(self) -> Stops:
        """Stops of the last sweep, of a fixed part of the beams, all chains together."""
        some, chains = self._looked_at, range(self._chains.n_chains)
        parts = [self._chains.stops(chain) for chain in chains]
        return Stops(
            range_m=np.tile(self.problem.rays.range_m[some], len(parts)),
            stopped=np.concatenate([stopped[some] for stopped, _, _ in parts]),
            distance_m=np.concatenate([distance[some] for _, distance, _ in parts]).astype(np.float64),
            variance=np.concatenate([variance[some] for _, _, variance in parts]).astype(np.float64),
        )
