"""The posterior of a field as plain data: reflectivities, and surfaces where the prior has them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from bayesmap.beams.beam_rays import BeamRays
from bayesmap.beams.rays import around_readings
from bayesmap.cells.reflectivity import Reflective, quantiles_of_halves
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]
CELLS_AT_ONCE = 8192
CELLS_AROUND = SIGMAS_AROUND = 10.0
FRESH_CELLS = 1 << 16  # surfaces drawn from the prior, of which predictions take those that they need


@dataclass(frozen=True, eq=False)
class FieldPosterior:
    """Cells that stop some beams, given scans, as draws.

    Only touched cells are kept, those that some beam crosses; only busy ones, in which some reading ends, keep their
    surfaces: those of the others are hardly anything but draws from the prior, and are drawn anew where they are
    needed.

    Attributes:
        grid, scans, settings, seconds, counts, notes: as in `bayesmap.posterior.posterior.Posterior`.
        sensor: the model that was used for the draws: fitted, if it was to be.
        prior: of the cells, likewise.
        touched: flat indices of the T touched cells, ascending, int32.
        busy: of the U cells with surfaces, their places in ``touched``, ascending.
        reflectivity: (chains, draws, T).
        expected: mean of the reflectivity given the draw's surfaces and where the beams then stopped, likewise: what
            predictions are made of.
        surfaces: mean x, y less the cell's centre, and the Cholesky factor l11, l21, l22 of the covariance, in edges of
            a cell, (chains, draws, U, 5).
        occupancy: posterior mean of the reflectivity, that of ``expected``, (nx, ny); the prior's mean where no beam
            comes.
        observed: cells of which some beam says something in at least half of the draws, (nx, ny).
        log_likelihood, log_prior: of every draw, (chains, draws); the prior in unconstrained coordinates.
        warmup_log_joint: (chains, warm-up sweeps).
        states, last_counts, informed, sweep: where the chains stand: all that is needed to go on.
        finished: false if the run was stopped early.
    """

    grid: Grid
    scans: Scans
    sensor: BeamMixture
    prior: Reflective
    settings: dict[str, Any]
    touched: NDArray[np.int32]
    busy: NDArray[np.int32]
    reflectivity: NDArray[np.float16]
    expected: NDArray[np.float16]
    surfaces: NDArray[np.float16]
    occupancy: Floats
    observed: NDArray[np.bool_]
    log_likelihood: Floats
    log_prior: Floats
    warmup_log_joint: Floats
    states: NDArray[np.float32]
    last_counts: NDArray[np.int32]
    informed: NDArray[np.int32]
    sweep: int
    finished: bool
    seconds: dict[str, float]
    counts: dict[str, int]
    log_evidence: float | None = None
    log_weights: None = None
    belief_changes: None = None
    notes: tuple[str, ...] = field(default=())

    @property
    def kind(self) -> Literal["reflectivity", "surface"]:
        """What a cell's state is."""
        return "surface" if self.prior.has_surfaces else "reflectivity"

    @property
    def n_draws(self) -> int:
        """Draws of each chain."""
        return int(self.reflectivity.shape[1])

    def to_grid(self, values: NDArray[Any], elsewhere: float) -> Floats:
        """Spread values of touched cells, (..., T), over the grid, (..., nx, ny)."""
        out = np.full((*values.shape[:-1], self.grid.n_cells), elsewhere)
        out[..., self.touched] = values
        return out.reshape(*values.shape[:-1], *self.grid.shape)

    def interval(self, level: float) -> tuple[Floats, Floats]:
        """Central credible interval of each cell's reflectivity: lower and upper end, (nx, ny) each."""
        tails = (0.5 * (1 - level), 0.5 * (1 + level))
        ends = np.empty((2, len(self.touched)))
        for i in range(0, len(self.touched), CELLS_AT_ONCE):
            some = slice(i, i + CELLS_AT_ONCE)
            part = self.reflectivity[:, :, some]
            ends[:, some] = quantiles_of_halves(part.reshape(-1, part.shape[-1]), tails)
        before = stats.beta(self.prior.a, self.prior.b).ppf(tails)
        lower, upper = (self.to_grid(ends[i], float(before[i])) for i in (0, 1))
        return lower, upper

    def mean_surfaces(self) -> tuple[Floats, Floats, Floats]:
        """Posterior mean surfaces of the busy cells, for pictures.

        Returns:
            means in the world frame (U, 2), covariances of the points (U, 2, 2), both in metres, and the mean
            reflectivity of their cells, (U,).
        """
        edge, ny = self.grid.resolution, self.grid.shape[1]
        flat = self.touched[self.busy]
        centre = np.stack([flat // ny + 0.5, flat % ny + 0.5], axis=-1) * edge + np.array(self.grid.origin)
        mean, second = np.zeros((len(flat), 2)), np.zeros((len(flat), 2, 2))
        draws = self.surfaces.reshape(self.surfaces.shape[0] * self.n_draws, *self.surfaces.shape[2:])
        for surface in draws:
            x, y, l11, l21, l22 = surface.astype(np.float64).T * edge
            mean += np.stack([x, y], axis=-1)
            second[:, 0, 0] += l11**2
            second[:, 0, 1] += l11 * l21
            second[:, 1, 1] += l21**2 + l22**2
        second[:, 1, 0] = second[:, 0, 1]
        n = max(len(draws), 1)
        return centre + mean / n, second / n, self.occupancy.ravel()[flat]

    def cells_for(self, touched: NDArray[np.int32], seed: int = 0) -> Iterator[NDArray[np.float32]]:
        """Each draw's cell states to predict other rays by, whose touched cells are these flat indices, (T', 6).

        Reflectivities are ``expected`` ones, and the prior's mean in cells that no beam of the run touched: the density
        of a reading is linear in each, so its mean over draws is that of drawn ones, with less noise. Surfaces are
        those of the draw; where no reading ended they come from the prior. Lengths are metres from the grid's lower
        left corner.
        """
        held, place = (np.full(self.grid.n_cells, -1, dtype=np.int32) for _ in range(2))
        held[self.touched] = np.arange(len(self.touched))
        place[self.touched[self.busy]] = np.arange(len(self.busy))
        known, with_surface = held[touched] >= 0, place[touched] >= 0
        edge, ny = self.grid.resolution, self.grid.shape[1]
        centre = np.stack([touched // ny + 0.5, touched % ny + 0.5], axis=-1) * edge
        rng = np.random.default_rng(seed)
        # Surfaces are drawn once and passed on from cell to cell: each draw of the map takes them up from another
        # place, and what a cell gets does not depend on which others are asked for.
        fresh = np.zeros((FRESH_CELLS, 6), dtype=np.float32)
        fresh[:, 0] = self.prior.mean
        if self.prior.has_surfaces:
            fresh[:, 1:] = self.prior.sample_surfaces(rng, len(fresh))
        for chain in range(self.reflectivity.shape[0]):
            for draw in range(self.n_draws):
                states = fresh[(touched + int(rng.integers(FRESH_CELLS))) % FRESH_CELLS]
                states[known, 0] = self.expected[chain, draw, held[touched[known]]]
                if self.prior.has_surfaces:
                    states[with_surface, 1:] = self.surfaces[chain, draw, place[touched[with_surface]]]
                    states[:, 1:] *= edge
                    states[:, 1:3] += centre
                yield states


def field_beam_log_scores(
    posterior: FieldPosterior,
    scans: Scans,
    sensor: BeamMixture | None = None,
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> Floats:
    """Log predictive density of every reading, NaN where it is invalid, log mean over draws, in nats, (B,)."""
    from bayesmap.kernels.field_score import FieldScore
    from bayesmap.kernels.rays import stop_distances, trace_rays

    sensor = posterior.sensor if sensor is None else sensor
    # Stops further from a reading than this explain it as chance or a passing object alone.
    ranges = np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 0.0).ravel()
    margin_m = CELLS_AROUND * posterior.grid.resolution + SIGMAS_AROUND * sensor.noise.scale_at(ranges)
    hit_depth = float(posterior.settings["hit_depth"])
    reach_m, near_m = around_readings(scans, margin_m, posterior.grid.resolution)
    traced = trace_rays(scans, posterior.grid, reach_m=reach_m, near_m=near_m)
    rays = BeamRays.of(traced, stop_distances(traced, hit_depth))
    parameters = sensor.kernel_parameters()
    assert parameters is not None
    score = FieldScore(rays, parameters, plain=posterior.kind == "reflectivity")
    for states in posterior.cells_for(rays.touched):
        score.add(states)
        on_progress(score.draws, posterior.reflectivity.shape[0] * posterior.n_draws)
    scores = score.log_mean_density()
    scores[np.isnan(rays.range_m)] = np.nan
    return scores
