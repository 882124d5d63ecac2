"""The result that users hold where cells stop some of the beams: reflectivities and surfaces."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.field import FieldPosterior, field_beam_log_scores
from bayesmap.posterior.field_summary import summarise_field
from bayesmap.posterior.summary import Summary
from bayesmap.result import Run
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.model import SensorModel
from bayesmap.sensors.noise import Gaussian
from bayesmap.space.scans import Reading, Scans

if TYPE_CHECKING:
    from matplotlib.figure import Figure


OCCUPIED, FREE = 0.3, 0.1
"""Reflectivities above and below which a robot's map of occupied, free and unknown cells calls a cell so."""


@dataclass(frozen=True, eq=False)
class FieldRun(Run):
    """The posterior over reflectivities, and perhaps surfaces, that a call of `bayesmap.infer` found.

    ``occupancy`` is the mean reflectivity, of what the draws expect: the mean of ``draws`` has the same limit and more
    noise. ``entropy`` is that of whether a cell stops the next beam that meets it.
    """

    posterior: FieldPosterior  # type: ignore[assignment]

    @cached_property
    def draws(self) -> NDArray[np.float32]:  # type: ignore[override]
        """Reflectivity of all cells in all draws, (chain, draw, nx, ny); the prior's mean where no beam comes."""
        posterior = self.posterior
        shape = (*posterior.reflectivity.shape[:2], posterior.grid.n_cells)
        out = np.full(shape, posterior.prior.mean, dtype=np.float32)
        out[..., posterior.touched] = posterior.reflectivity
        return out.reshape(*shape[:2], *posterior.grid.shape)

    @property
    def n_draws(self) -> int:
        """Draws of each chain."""
        return self.posterior.n_draws

    def map_of(self, chain: int, draw: int) -> NDArray[np.float64]:  # type: ignore[override]
        """One draw's reflectivities, (nx, ny); both counted from 0."""
        return self.posterior.to_grid(self.posterior.reflectivity[chain, draw], self.posterior.prior.mean)

    def interval(self, level: float = 0.9) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Central credible interval of each cell's reflectivity: lower and upper end, (nx, ny) each.

        Raises:
            BadInput: a level outside (0, 1), or a run that was stopped before its first draw.
        """
        if not 0 < level < 1:
            raise BadInput(f"interval: level must lie inside (0, 1), got {level!r}")
        self._need_marginals()
        return self.posterior.interval(level)

    def surfaces(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Mean surfaces: means (U, 2) and covariances (U, 2, 2) in metres, and reflectivities (U,).

        Raises:
            BadInput: a run without surfaces or without draws.
        """
        if self.posterior.kind != "surface":
            raise BadInput("surfaces: this run's cells have none; infer with prior=Surface(), or --cells surface")
        self._need_marginals()
        return self.posterior.mean_surfaces()

    @cached_property
    def _summary(self) -> Summary:
        return summarise_field(self.posterior)

    def log_score(
        self,
        heldout_scans: Scans,
        sensor: SensorModel | None = None,
        on_progress: Callable[[int, int], None] = lambda done, total: None,
    ) -> float:
        """Mean log predictive density of the scans' valid readings: nats per beam, averaged over draws.

        ``on_progress`` is told how many of how many draws have been looked at.

        Raises:
            BadInput: no draws, no valid reading, or a sensor of another kind than the run's.
        """
        if sensor is not None and not (isinstance(sensor, BeamMixture) and isinstance(sensor.noise, Gaussian)):
            raise BadInput(f"score: this run's map is scored by a BeamMixture with Gaussian noise, not by {sensor!r}")
        if self.n_draws == 0:
            raise BadInput("score: the run has no draws yet; let it finish its warm-up")
        if not (heldout_scans.readings != Reading.INVALID).any():
            raise BadInput("score: none of the scans has a valid reading")
        return float(np.nanmean(field_beam_log_scores(self.posterior, heldout_scans, sensor, on_progress)))

    def save(
        self,
        path: str | os.PathLike[str],
        on_progress: Callable[[int, int], None] = lambda done, total: None,
    ) -> None:
        """Write everything to one netCDF file, whole or not at all; ``on_progress`` is told what part is written."""
        from bayesmap.io.saved_field import save_field

        save_field(self.posterior, path, on_progress)

    def plot(self, **options: Any) -> Figure:
        """A figure of mean, width of the 90 % interval, readings and one draw, with surfaces where they can be seen.

        Options are those of `bayesmap.viz.figure.posterior_figure`.

        Raises:
            BadInput: a run that was stopped before its first draw.
        """
        from bayesmap.viz.figure import posterior_figure

        self._need_marginals()
        if self.n_draws and "draw" not in options:
            options["draw"] = self.map_of(0, -1)
        options.setdefault("scans", self.posterior.scans)
        options.setdefault("label", "reflectivity")
        if "width" not in options:
            lower, upper = self.interval(0.9)
            options["width"] = upper - lower
        if self.posterior.kind == "surface":
            options.setdefault("surfaces", self.surfaces())
        return posterior_figure(self.grid, self.occupancy, self.observed, **options)

    def export(self, path: str | os.PathLike[str], **options: Any) -> tuple[Any, ...]:
        """Write the map, or the trajectory, for other programs, as `Run.export` does.

        A wall's probability must be over one half to say that it is likely there; a cell that stops three beams in ten
        for certain is no place for a robot. So maps of occupied, free and unknown cells have thresholds of their own
        here, `OCCUPIED` and `FREE`, unless some are given.

        Raises:
            BadInput: as `Run.export`.
        """
        from bayesmap.io.exports import format_of

        mode = options.get("mode")
        if mode is None and format_of(path, options.get("format")) == "map-server":
            mode = "trinary"
        if mode == "trinary":
            for name, value in (("occupied_thresh", OCCUPIED), ("free_thresh", FREE)):
                options[name] = value if options.get(name) is None else options[name]
        return super().export(path, **options)
