"""The model: the joint law of cells, sensor, poses and readings.

    p(cells) p(sensor) p(poses | log) prod over beams of p(z | cells, sensor, pose)

A beam stops in the i-th cell that it meets with probability ``w_i = a_i prod_{j < i} (1 - a_j)``, or nowhere in the
map. Here a_i is the chance that the cell stops a beam which reaches it. The stop lies at a distance d_i, known up to a
spread s_i (`bayesmap.beams.rays`). The law of a reading z is

    p(z | cells, sensor, pose) = sum_i w_i p(z | d_i, s_i) + prod_j (1 - a_j) p(z | infinity)

with the sensor's law p(z | d, s) (`bayesmap.sensors.model`). Binary walls are the case a_i in {0, 1}: then one w is 1.

`Model` is what samplers take: data, unknowns and priors. `log_likelihoods` computes the law above in plain NumPy, in
double precision, for all kinds of cells. It is slow, and serves to test samplers.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays, stops_of
from bayesmap.cells.arrays import ArraySpec
from bayesmap.cells.kind import CellPrior, Cells
from bayesmap.errors import BadInput
from bayesmap.poses.prior import KnownPoses, PosePrior
from bayesmap.sensors.model import SensorModel
from bayesmap.space.arrays import Floats
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

BEAMS_AT_ONCE = 8192  # number of beams that are traced together, which limits the memory

POSES = ArraySpec("poses", ("scan", "pose"), "float64", meaning="x, y in metres and yaw in radians, in the world frame")
"""The array of poses in a draw, if poses are unknown."""


@dataclass(frozen=True, eq=False)
class State:
    """One draw of all unknowns."""

    cells: Cells  # the arrays of the kind of cells, each over the whole grid
    sensor: SensorModel  # the law of the readings
    poses: Floats  # poses of the scans in the world frame, (S, 3)


@dataclass(frozen=True, eq=False)
class Model:
    """The data of an inference, its unknowns and their priors."""

    scans: Scans  # readings of the sensor, with the poses of the log
    grid: Grid
    cells: CellPrior  # the kind of cells, with its prior
    sensor: SensorModel  # the law of the readings; if it is fitted, the law that the fit starts from
    poses: PosePrior = field(default_factory=KnownPoses)  # the prior of the scans' poses
    hit_depth: float = 0.0  # where a beam stops in a cell without a surface, as a fraction of its path in the cell

    @property
    def arrays(self) -> tuple[ArraySpec, ...]:
        """The arrays of a draw: its cells' arrays, and the poses if they are unknown."""
        return (*self.cells.arrays, POSES) if self.poses.unknown else self.cells.arrays

    def state(self, cells: Cells) -> State:
        """Return a state with these cells, arrays over the whole grid; cells without a value get one of the prior."""
        return State(self.cells.completed(cells, self.grid), self.sensor, self.scans.poses)

    def log_joint(self, state: State) -> float:
        """Compute the log density of a state and the readings, in nats, up to a constant of the priors."""
        poses = self.poses.law(self.scans.poses).log_prob(np.asarray(state.poses))
        return float(poses) + self.cells.log_prob(state.cells, self.grid) + self.log_likelihood(state)

    def log_likelihood(self, state: State) -> float:
        """Compute log p(readings | state) in nats: densities per metre for ranges, probabilities for typed readings."""
        return float(self.beam_log_likelihoods(state).sum())

    def beam_log_likelihoods(self, state: State) -> Floats:
        """Compute log p(reading | state) of each beam in nats, (B,); 0 if invalid. `BadInput`: poses of wrong shape."""
        if np.shape(state.poses) != self.scans.poses.shape:
            raise BadInput(f"state: poses has shape {np.shape(state.poses)}, expected {self.scans.poses.shape}")
        cell_stops, sensor = self.cells.stops(state.cells, self.grid), state.sensor
        batches = [log_likelihoods(rays, cell_stops, sensor, self.hit_depth) for rays in self._trace(state.poses)]
        return np.concatenate(batches) if batches else np.zeros(0)

    def _trace(self, poses_world: Floats) -> Iterator[Rays]:
        """Trace the scans from poses, (S, 3), `BEAMS_AT_ONCE` beams at a time."""
        from bayesmap.kernels.rays import trace_rays

        scans_at_once = max(1, BEAMS_AT_ONCE // self.scans.ranges_m.shape[1])
        for i in range(0, len(self.scans), scans_at_once):
            batch = slice(i, i + scans_at_once)
            yield trace_rays(self.scans.select(batch), self.grid, poses_world=poses_world[batch])


def log_likelihoods(
    rays: Rays, cell_stops: NDArray[np.floating], sensor: SensorModel, hit_depth: float, beta: float = 1.0
) -> Floats:
    """Compute log p(reading | map) of every beam, (B,), by the formula of this module; 0 for an invalid reading.
    ``cell_stops``: see `bayesmap.beams.rays.stops_of`. The inverse temperature ``beta`` is the power of p(z | stop).
    """
    stops = stops_of(rays, cell_stops, hit_depth)
    beam = rays.beam_of_entry()
    # One row per beam: its stops, and in the last column the case of no stop in the map.
    shape = rays.n_beams, int(rays.lengths.max(initial=0)) + 1
    entry = beam, np.arange(rays.n_incidences) - rays.offsets[beam]
    chance = np.zeros(shape)
    log_p = np.full(shape, -np.inf)
    chance[entry] = stops.chance
    log_p[entry] = sensor.stop_log_likelihood(rays.range_m[beam], stops.distance_m, stops.spread_m, rays.limits)
    log_p[:, -1] = sensor.log_likelihood(rays.range_m, np.full(rays.n_beams, np.inf), rays.limits)
    # Weight of a stop: its chance, times the chance of passing all cells before it.
    passed = np.cumprod(1.0 - chance, axis=1)
    weight = chance
    weight[:, 1:] *= passed[:, :-1]
    weight[:, -1] = passed[:, -1]
    tempered = beta * log_p if beta > 0 else np.zeros(shape)  # p^0 is 1, also for impossible readings
    with np.errstate(divide="ignore"):
        return np.asarray(np.logaddexp.reduce(np.log(weight) + tempered, axis=1))
