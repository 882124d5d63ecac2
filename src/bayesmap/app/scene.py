"""From the document to readings: simulated, each with noise of its own, and the problem that they pose."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import SMALLEST_NOISE_M, Document
from bayesmap.app.protocol.notices import Scan
from bayesmap.app.protocol.tasks import Buffers
from bayesmap.beams.table import BeamTable
from bayesmap.cells.binary import BinaryWalls, Independent
from bayesmap.cells.kind import CellPrior
from bayesmap.model import Model
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.sensors.builtin import AdditiveNoise, Gaussian
from bayesmap.sensors.model import SensorModel
from bayesmap.sim.forward import ranges
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans, fan

STREAM_NOISE = 11
BLUR_SIGMAS = 5.0
NEAR_SIGMAS = 13.0
"""Past its reading a beam is followed so far for a preview: a stop there is less than 1e-30 as likely as one at the
reading, which is 0 to `bayesmap.kernels.walls.propagate`, even where the reading is off by three sigmas itself."""


@dataclass(frozen=True, eq=False)
class Beams:
    """Beam tables, made when they are asked for: a moving hand is shown the next map before it needs them.

    Attributes:
        whole: of all that beams could tell.
        near: of beams that end a little past their readings, for belief propagation.
    """

    whole: Callable[[], BeamTable]
    near: Callable[[], BeamTable]

    @classmethod
    def of(cls, table: BeamTable) -> Beams:
        """Those of a table that there is."""
        return cls(lambda: table, lambda: table)


@dataclass(frozen=True, eq=False)
class Scene:
    """Readings, and what they say.

    Attributes:
        scans: what the sensors report.
        exact_m: where the beams truly end, (S, A); empty, (0, A), where nobody knows.
        ids: of the sensors, (S,).
        sensor: the law of the readings.
        grid: the map's cells.
        beams: of the scans that the map is made of.
        prior: of walls.
        hit_depth: where in a cell a beam is expected to stop.
        used: from the first on, how many scans the map is made of; None is all.
    """

    scans: Scans
    exact_m: NDArray[np.float64]
    ids: tuple[int, ...]
    sensor: SensorModel
    grid: Grid
    beams: Beams
    prior: BinaryWalls
    hit_depth: float = 0.0
    used: int | None = None

    @property
    def used_scans(self) -> Scans:
        """The scans that the map is made of."""
        return self.scans if self.used is None else self.scans.select(slice(self.used))

    @cached_property
    def problem(self) -> WallProblem:
        """Beam table and prior."""
        return WallProblem(self.beams.whole(), self.prior, self.scans.poses[: self.used])

    @cached_property
    def near(self) -> WallProblem:
        """The same of beams that end a little past their readings."""
        return WallProblem(self.beams.near(), self.prior, self.scans.poses[: self.used])

    def model(self, cells: CellPrior) -> Model:
        """The same readings, to be explained by cells of a kind."""
        return Model(self.used_scans, self.grid, cells, self.sensor, hit_depth=self.hit_depth)

    def with_prior(self, p_wall: float) -> Scene:
        """The same readings under another prior; beam tables that there are are shared, and their index."""
        other = replace(self, prior=Independent(p_wall))
        for name in ("problem", "near"):
            if (there := vars(self).get(name)) is not None:
                vars(other)[name] = there.under(other.prior)
        return other


def standard_noise(seed: int, sensor: int, angles: int) -> NDArray[np.float64]:
    """Standard normal numbers, (A,): that of a beam depends on the seed, the sensor and the beam's number alone."""
    return np.random.default_rng([seed, sensor, STREAM_NOISE]).standard_normal(angles)


def simulate_document(document: Document) -> tuple[Scans, NDArray[np.float64]]:
    """Scans of all sensors, and the noise-free ranges, (S, A); exact readings are those."""
    poses = np.array([(s.x, s.y, s.yaw) for s in document.sensors])
    angles = fan(document.angles, math.degrees(document.fov))
    exact = ranges(document.is_wall, document.grid, poses, angles, document.max_range)
    noise = np.stack([standard_noise(document.seed, s.id, document.angles) for s in document.sensors])
    sigma_m = max(document.noise, SMALLEST_NOISE_M) if document.readings == "noisy" else 0.0
    readings = exact + sigma_m * noise
    return Scans(poses, angles, readings, max_range_m=document.max_range), exact


def simulated_scene(document: Document) -> Scene:
    """What the sensors of a simulation see."""
    from bayesmap.kernels.walls.table import trace

    scans, exact = simulate_document(document)
    sensor = Gaussian(max(document.noise, SMALLEST_NOISE_M))
    beams = Beams(
        partial(trace, scans, document.grid, sensor),
        partial(trace, scans, document.grid, sensor, reach_m=near_reach_m(scans, sensor)),
    )
    ids = tuple(s.id for s in document.sensors)
    return Scene(scans, exact, ids, sensor, document.grid, beams, Independent(document.prior))


def near_reach_m(scans: Scans, sensor: Gaussian) -> NDArray[np.float64]:
    """How far along each beam a stop could still explain its reading, metres, (B,).

    Belief propagation makes the same of beams that end there: what is left out would send messages of 1.
    """
    return scans.ranges_m.ravel() + NEAR_SIGMAS * sensor.sigma_m


def same_readings(before: Document, after: Document) -> bool:
    """Whether two simulations have the same readings and the same law: all but prior and method is alike."""
    return before == replace(
        after,
        prior=before.prior,
        pose_sigma=before.pose_sigma,
        heading_sigma=before.heading_sigma,
        cells=before.cells,
        method=before.method,
        order=before.order,
        start=before.start,
        sweeps=before.sweeps,
    )


@dataclass(frozen=True, eq=False)
class Touched:
    """A beam table on the cells alone that beams touch: on a large map a small part of it.

    Attributes:
        cells: flat indices of those cells, (M,).
        table: the same beams over cells 0..M-1.
    """

    cells: NDArray[np.intp]
    table: BeamTable


def touched(table: BeamTable) -> Touched:
    """Leave out the cells that no beam touches."""
    seen = np.zeros(table.grid.n_cells, dtype=np.bool_)
    seen[table.cells] = True
    cells = np.flatnonzero(seen)
    place = np.zeros(table.grid.n_cells, dtype=np.int32)
    place[cells] = np.arange(len(cells), dtype=np.int32)
    small = Grid((max(1, len(cells)), 1))
    return Touched(cells, BeamTable(small, table.offsets, place[table.cells], table.loglik, table.no_hit))


def hits(scene: Scene) -> NDArray[np.bool_]:
    """Which beams met something, (S, A): known in a simulation, else a finite reading below the longest range.

    Additive noise also blurs the longest range, which is what a beam without a return reads: readings within five
    standard deviations of it are taken for such.
    """
    limit = scene.scans.max_range_m
    if len(scene.exact_m):
        return np.asarray(scene.exact_m < limit)
    sensor = scene.sensor
    blur = getattr(sensor, "sigma_m", getattr(sensor, "scale_m", 0.0)) if isinstance(sensor, AdditiveNoise) else 0.0
    ranges_m = scene.scans.ranges_m
    return np.asarray(np.isfinite(ranges_m) & (ranges_m < limit - BLUR_SIGMAS * blur))


def rays(scene: Scene, scan: int | None, generation: int) -> tuple[Scan, Buffers]:
    """Make the message `scan`: all scans of a simulation, or one of a file."""
    some = slice(None) if scan is None else slice(scan, scan + 1)
    ids = list(scene.ids) if scan is None else [scan + 1]
    exact = scene.exact_m[some] if len(scene.exact_m) else scene.exact_m
    return Scan(ids, scan, generation=generation), {
        "pose": scene.scans.poses[some],
        # Only the scans of a file have beams of their own, and those are sent one at a time.
        "angles": (scene.scans.angles_rad if scan is None else scene.scans.angles_by_scan()[scan]).astype(np.float32),
        "ranges": scene.scans.ranges_m[some].astype(np.float32),
        "exact": exact.astype(np.float32),
        "hit": hits(scene)[some].astype(np.uint8),
    }
