"""Rounds of belief propagation on the host's behalf: owns the messages, runs the kernels of `propagate`."""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable
from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch
from bayesmap.kernels.walls.propagate import beam_messages, cell_beliefs, neighbour_messages, relative_likelihood

CPU_PARTS = 4  # fixed, so that sums do not depend on the number of cores
GPU_PARTS = 256


class Beliefs:
    """Messages and beliefs of one problem.

    Memory: 12 bytes for each incidence of the table, and where neighbours are coupled 32 for each cell.
    """

    def __init__(
        self,
        table: BeamTable,
        logit: NDArray[np.float64],
        device: str,
        beta: float = 1.0,
        coupling: float = 0.0,
    ) -> None:
        cells, incidences, beams = table.grid.n_cells, table.n_incidences, table.n_beams
        parts = min(CPU_PARTS if device == "cpu" else GPU_PARTS, max(1, beams))
        bounds = np.searchsorted(table.offsets, np.linspace(0, incidences, parts + 1))
        bounds[0], bounds[-1] = 0, beams
        self._device, self._beams, self._cells, self._parts = device, beams, cells, parts
        self._bounds = devices.to_device(bounds.astype(np.int32), wp.int32, device)
        self._offsets = devices.to_device(table.offsets, wp.int32, device)
        self._table_cells = devices.to_device(table.cells, wp.int32, device)
        self._relative = wp.empty(incidences, dtype=wp.float32, device=device)
        self._no_hit = wp.empty(beams, dtype=wp.float32, device=device)
        self._ratio = wp.full(incidences, 1.0, dtype=wp.float32, device=device)
        self._behind = wp.empty(incidences, dtype=wp.float32, device=device)
        self._logit = devices.to_device(logit, wp.float64, device)
        self._product = wp.empty((parts, cells), dtype=wp.float32, device=device)
        self._received = wp.zeros((parts, cells), dtype=wp.float32, device=device)
        self._shape, self._coupling = table.grid.shape, coupling
        sides = 4 if coupling else 0
        # Two of each: messages are made of those of the last round, whichever thread comes first.
        self._sides, self._next_sides = (wp.zeros((sides, cells), dtype=wp.float32, device=device) for _ in range(2))
        self._odds = wp.empty(cells, dtype=wp.float32, device=device)
        self._belief = wp.empty(cells, dtype=wp.float32, device=device)
        inputs: list[object] = [wp.float32(beta), self._offsets]
        inputs += [devices.to_device(a, wp.float32, device) for a in (table.loglik, table.no_hit)]
        launch(relative_likelihood, beams, [*inputs, self._relative, self._no_hit], device)
        self._gather()

    def round(self, damping: float, threads: int | None = None) -> None:
        """All beams and neighbours send messages, made of the beliefs of the last round; then all cells gather them."""
        inputs = [self._bounds, self._offsets, self._table_cells, self._relative, self._no_hit, self._odds]
        inputs += [wp.float32(damping), self._ratio, self._behind, self._product, self._received]
        launch(beam_messages, self._parts, inputs, self._device, threads)
        if self._coupling:
            inputs = [*self._shape, wp.float64(self._coupling), wp.float32(damping), self._belief]
            inputs += [self._sides, self._next_sides]
            launch(neighbour_messages, self._cells, inputs, self._device, threads)
            self._sides, self._next_sides = self._next_sides, self._sides
        self._gather()

    def log_odds(self) -> NDArray[np.float32]:
        """Log-odds of a wall in every cell, flat, shape (N,)."""
        return np.array(self._belief.numpy())

    def _gather(self) -> None:
        inputs = [self._logit, self._received, self._sides, self._odds, self._belief]
        launch(cell_beliefs, self._cells, inputs, self._device)
