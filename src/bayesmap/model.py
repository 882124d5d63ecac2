"""The model: four unknowns, one law.

    p(cells) p(sensor) p(poses | log) prod over beams of p(z | cells, sensor, pose)

A beam stops in the i-th cell that it meets with probability ``w_i = a_i prod_{j < i} (1 - a_j)``, a_i being the chance
that this cell stops a beam which gets there, at a distance d_i known up to a spread s_i
(`bayesmap.beams.rays`), or nowhere in the map, and

    p(z | cells, sensor, pose) = sum_i w_i p(z | d_i, s_i) + prod_j (1 - a_j) p(z | infinity)

with the sensor's law p(z | d, s) (`bayesmap.sensors.model`). Binary walls are the case a_i in {0, 1}: then one w is 1.
Here it is written down in plain NumPy, in double precision, for every kind of cells; samplers are tested against it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays, stops_of
from bayesmap.cells.arrays import ArraySpec
from bayesmap.cells.kind import CellPrior, Cells
from bayesmap.errors import BadInput
from bayesmap.poses.prior import Known, PosePrior
from bayesmap.sensors.model import Floats, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

BEAMS_AT_ONCE = 8192

POSES = ArraySpec("poses", ("scan", "pose"), "float64", what="x, y in metres and yaw in radians, in the world frame")
"""The array that a draw holds beside its cells where poses are unknown."""


@dataclass(frozen=True, eq=False)
class State:
    """One draw of all unknowns.

    Attributes:
        cells: the arrays that the kind of cells declares, each over the whole grid.
        sensor: the law of the readings.
        poses: of the scans, in the world frame, (S, 3).
    """

    cells: Cells
    sensor: SensorModel
    poses: Floats


@dataclass(frozen=True, eq=False)
class Model:
    """A question of inference: the data, the unknowns and their priors.

    Attributes:
        scans: what the sensor reported; their poses are those that the log states.
        grid: the map's cells.
        cells: the kind of cells, with its prior.
        sensor: the law of the readings; where it is fitted, the law that the fit starts from.
        poses: the prior of the scans' poses.
        hit_depth: where in a cell without a surface a beam stops, as a part of its stretch in the cell.
    """

    scans: Scans
    grid: Grid
    cells: CellPrior
    sensor: SensorModel
    poses: PosePrior = field(default_factory=Known)
    hit_depth: float = 0.0

    @property
    def arrays(self) -> tuple[ArraySpec, ...]:
        """Return the arrays of a draw: those of its cells, and the poses where they are unknown."""
        return (*self.cells.arrays, POSES) if self.poses.unknown else self.cells.arrays

    def state(self, cells: Cells) -> State:
        """Return a state with these cells, the model's sensor, and the poses that the log states.

        Args:
            cells: arrays over the whole grid, such as those of a run's draw
                (`bayesmap.cells.arrays.Draws.cells`); where it says nothing of a cell, the cell has a state of the
                prior.
        """
        return State(self.cells.completed(cells, self.grid), self.sensor, self.scans.poses)

    def log_joint(self, state: State) -> float:
        """Compute the log density of a state and the readings, in nats, up to a constant of the priors.

        Raises:
            BadInput: poses of another shape than the scans'.
        """
        poses = self.poses.law(self.scans.poses).log_prob(np.asarray(state.poses))
        return float(poses) + self.cells.log_prob(state.cells, self.grid) + self.log_likelihood(state)

    def log_likelihood(self, state: State) -> float:
        """Compute log p(readings | state), nats: densities per metre of ranges, probabilities of typed readings."""
        return float(self.beam_log_likelihoods(state).sum())

    def beam_log_likelihoods(self, state: State) -> Floats:
        """Compute log p(reading | state) of each beam, (B,), in nats; 0 for an invalid reading.

        Raises:
            BadInput: poses of another shape than the scans'.
        """
        if np.shape(state.poses) != self.scans.poses.shape:
            raise BadInput(f"state: poses has shape {np.shape(state.poses)}, expected {self.scans.poses.shape}")
        stops = self.cells.stops(state.cells, self.grid)
        parts = [log_likelihoods(rays, stops, state.sensor, self.hit_depth) for rays in self._rays(state.poses)]
        return np.concatenate(parts) if parts else np.zeros(0)

    def _rays(self, poses: Floats) -> Iterator[Rays]:
        from bayesmap.kernels.rays import trace_rays

        at_once = max(1, BEAMS_AT_ONCE // self.scans.ranges_m.shape[1])
        for i in range(0, len(self.scans), at_once):
            some = slice(i, i + at_once)
            yield trace_rays(self.scans.select(some), self.grid, poses_world=poses[some])


def log_likelihoods(
    rays: Rays, states: NDArray[np.floating], sensor: SensorModel, hit_depth: float, beta: float = 1.0
) -> Floats:
    """Compute log p(reading | map) of every beam, (B,), by the formula of this module; 0 for an invalid reading.

    Args:
        rays: beams and their readings.
        states: the map, as `bayesmap.beams.rays.stops_of` takes it.
        sensor: the law of the readings.
        hit_depth: where in a cell without a surface a beam stops.
        beta: inverse temperature, the power of the sensor's law p(z | stop).
    """
    stops = stops_of(rays, states, hit_depth)
    beam, last = rays.beam_of_entry(), np.arange(rays.n_beams)
    # A row for each beam: its entries, and nowhere in the last column.
    shape = rays.n_beams, int(rays.lengths.max(initial=0)) + 1
    place = beam, np.arange(rays.n_incidences) - rays.offsets[beam]
    chance, law = np.zeros(shape), np.full(shape, -np.inf)
    chance[place] = stops.chance
    law[place] = sensor.stop_log_likelihood(rays.range_m[beam], stops.distance_m, stops.spread_m, rays.limits)
    law[:, -1] = sensor.log_likelihood(rays.range_m, np.full(rays.n_beams, np.inf), rays.limits)
    passed = np.cumprod(1.0 - chance, axis=1)
    weight = chance
    weight[:, 1:] *= passed[:, :-1]
    weight[last, -1] = passed[:, -1]
    tempered = beta * law if beta > 0 else np.zeros(shape)  # p^0 is 1, of impossible readings too
    with np.errstate(divide="ignore"):
        return np.asarray(np.logaddexp.reduce(np.log(weight) + tempered, axis=1))
