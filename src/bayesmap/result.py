"""The result that users hold: a posterior, with everything one does with it a method away."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.packing import unpack
from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior, entropy_bits
from bayesmap.posterior.score import log_score
from bayesmap.posterior.scoring import Score, score_posterior
from bayesmap.posterior.summary import Summary, summarise
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Run:
    """The posterior over walls that a call of `bayesmap.infer` found."""

    posterior: Posterior

    @property
    def grid(self) -> Grid:
        """Where the cells are."""
        return self.posterior.grid

    @property
    def finished(self) -> bool:
        """False if the run was stopped before all draws were there; `infer(..., resume=run)` goes on."""
        return self.posterior.finished

    @property
    def occupancy(self) -> NDArray[np.float64]:
        """Posterior wall probability of every cell, (nx, ny)."""
        return self.posterior.occupancy

    @property
    def entropy(self) -> NDArray[np.float64]:
        """Entropy of every cell's marginal in bits, (nx, ny)."""
        return entropy_bits(self.posterior.occupancy)

    @property
    def observed(self) -> NDArray[np.bool_]:
        """Cells that a beam reaches in at least half of the draws, (nx, ny): elsewhere the prior speaks."""
        return self.posterior.observed

    @cached_property
    def draws(self) -> NDArray[np.bool_]:
        """All kept maps, (chain, draw, nx, ny); unpacked on first use, one byte a cell."""
        return unpack(self.posterior.packed, self.posterior.grid.shape)

    @property
    def n_draws(self) -> int:
        """Draws of each chain."""
        return int(self.posterior.packed.shape[1])

    def map_of(self, chain: int, draw: int) -> NDArray[np.bool_]:
        """One draw, (nx, ny); chain and draw are counted from 0, negative ones from the end."""
        return unpack(self.posterior.packed[chain, draw], self.posterior.grid.shape)

    @property
    def log_joint(self) -> NDArray[np.float64]:
        """Log p(walls, readings) of every draw, (chain, draw)."""
        return self.posterior.log_likelihood + self.posterior.log_prior

    @property
    def log_weights(self) -> NDArray[np.float64]:
        """Normalised log weights of all particles of importance sampling, (particles,).

        Raises:
            BadInput: another method.
        """
        if self.posterior.log_weights is None:
            raise BadInput(f"run: method {self.posterior.settings['method']!r} has no importance weights")
        return self.posterior.log_weights

    def summary(self) -> Summary:
        """R-hat, effective sample sizes, cells that never changed, timings."""
        return self._summary

    @cached_property
    def _summary(self) -> Summary:
        return summarise(self.posterior)

    def log_score(
        self,
        heldout_scans: Scans,
        sensor: SensorModel | None = None,
        on_progress: Callable[[int, int], None] = lambda done, total: None,
    ) -> float:
        """Mean log predictive density of the scans' valid readings: nats per beam, averaged over draws.

        ``on_progress`` is told how many of how many draws have been looked at.

        ``sensor`` is needed only for a loaded run whose sensor model is of your own making.
        """
        return log_score(self.posterior, heldout_scans, sensor, on_progress)

    def save(
        self,
        path: str | os.PathLike[str],
        on_progress: Callable[[int, int], None] = lambda done, total: None,
    ) -> None:
        """Write everything to one netCDF file, whole or not at all; ``on_progress`` is told what part is written."""
        from bayesmap.io.saved import save

        save(self.posterior, path, on_progress)

    def plot(self, **options: Any) -> Figure:
        """A figure of mean, entropy and one draw; options as in `bayesmap.viz.figure.posterior_figure`.

        Raises:
            BadInput: a run that was stopped before its first draw.
        """
        from bayesmap.viz.figure import posterior_figure

        self._need_marginals()
        posterior = self.posterior
        if self.n_draws and "draw" not in options:
            options["draw"] = self.map_of(0, -1)
        options.setdefault("scans", posterior.scans)
        return posterior_figure(posterior.grid, posterior.occupancy, posterior.observed, **options)

    def export(self, path: str | os.PathLike[str], **options: Any) -> tuple[Any, ...]:
        """Write the map, or the trajectory, for other programs; the path's ending chooses the format.

        A map_server YAML, recordings for ROS 1 and 2, GeoTIFF, rerun, TUM; options as in
        `bayesmap.io.exports.export_run`.

        Returns:
            The paths of what was written.

        Raises:
            BadInput: a run that was stopped before its first draw, an unknown ending, or a file that cannot be written.
        """
        from bayesmap.io.exports import export_run

        self._need_marginals()
        return export_run(path, self, self.posterior.scans, **options)

    def _need_marginals(self) -> None:
        if np.isnan(self.posterior.occupancy).any():
            raise BadInput("run: stopped before its first draw, there is no posterior yet; resume it")


def score(
    run: Run,
    heldout_scans: Scans,
    sensor: SensorModel | None = None,
    *,
    seed: int = 0,
    on_progress: Callable[[float], None] = lambda share: None,
) -> Score:
    """How well a run predicts scans that it has not seen, and how well calibrated it is.

    Args:
        run: what predicts: the mean over its draws.
        heldout_scans: scans that had no part in it.
        sensor: another law of the readings than the run's.
        seed: of the randomised transform of typed readings, and of the bootstrap.
        on_progress: told which share is done, from 0 to 1.

    Raises:
        BadInput: no valid reading, no draws, or a sensor model without compiled form.
    """
    return score_posterior(run.posterior, heldout_scans, sensor, seed=seed, on_progress=on_progress)
