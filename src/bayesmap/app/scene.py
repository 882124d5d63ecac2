"""Scenes: the readings of a document, and the inference problem built from them."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import Scan
from bayesmap.app.protocol.tasks import Buffers
from bayesmap.beams.table import BeamTable
from bayesmap.cells.binary import BinaryWalls, Independent
from bayesmap.cells.kind import CellPrior
from bayesmap.model import Model
from bayesmap.samplers.sampler import Stream
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.sensors.model import AdditiveNoise, Gaussian, SensorModel
from bayesmap.sim.forward import ranges
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans, fan

BLUR_SIGMAS = 5.0  # a reading within this many standard deviations of the longest range counts as no return
CUT_SIGMAS = 13.0  # how far past its reading a preview follows a beam: farther stops are 1e-30 as likely


@dataclass(frozen=True, eq=False)
class Scene:
    """The readings of a document, and the inference problem built from them."""

    scans: Scans  # the readings of the sensors
    exact_m: NDArray[np.float64]  # noise-free ranges, (S, A); empty, (0, A), if they are unknown
    ids: tuple[int, ...]  # ids of the sensors, (S,)
    sensor: SensorModel  # the sensor model
    grid: Grid  # the map's cells
    prior: BinaryWalls  # the prior of walls
    trace: Callable[[], BeamTable]  # traces the beams of the used scans; many scenes are replaced before that is needed
    trace_near: Callable[[], BeamTable] | None = None  # traces them only a little past their readings; if None, `trace`
    hit_depth: float = 0.0  # depth in a cell at which a beam is expected to stop
    n_used: int | None = None  # number of first scans used for the map; None means all scans

    @cached_property
    def problem(self) -> WallProblem:
        """The problem of the beam table and the prior."""
        return WallProblem(self.trace(), self.prior, self.scans.poses[: self.n_used])

    @cached_property
    def near_problem(self) -> WallProblem:
        """The problem with beams that end a little past their readings."""
        return WallProblem((self.trace_near or self.trace)(), self.prior, self.scans.poses[: self.n_used])

    def model(self, cells: CellPrior) -> Model:
        """Return the model in which cells of a kind explain the readings."""
        scans = self.scans if self.n_used is None else self.scans.select(slice(self.n_used))
        return Model(scans, self.grid, cells, self.sensor, hit_depth=self.hit_depth)

    def with_prior(self, p_wall: float) -> "Scene":
        """Return the scene under another prior, with the beam tables and indices that exist already."""
        other = replace(self, prior=Independent(p_wall))
        for name in ("problem", "near_problem"):
            if (problem := vars(self).get(name)) is not None:
                vars(other)[name] = problem.under(other.prior)
        return other


def scene_of_file(
    scans: Scans, grid: Grid, sensor: SensorModel, p_wall: float, table: BeamTable, hit_depth: float = 0.0,
    n_used: int | None = None,
) -> Scene:  # fmt: skip
    """Return the scene of a file. Its scans have the ids 1, 2, 3 and so on, and its noise-free ranges are unknown."""
    return Scene(
        scans, np.zeros((0, len(scans.angles_rad))), tuple(range(1, len(scans) + 1)), sensor, grid,
        Independent(p_wall), lambda: table, hit_depth=hit_depth, n_used=n_used,
    )  # fmt: skip


def standard_noise(seed: int, sensor_id: int, n_beams: int) -> NDArray[np.float64]:
    """Draw standard normal numbers, (A,). Each depends only on the seed, the sensor's id and the beam's index."""
    return np.random.default_rng([seed, sensor_id, Stream.NOISE]).standard_normal(n_beams)


def simulate_document(document: Document) -> tuple[Scans, NDArray[np.float64]]:
    """Simulate the scans of all sensors. Returns the scans and the noise-free ranges in metres, (S, A)."""
    poses = np.array([(sensor.x, sensor.y, sensor.yaw) for sensor in document.sensors])
    angles_rad = fan(document.angles, math.degrees(document.fov))
    exact_m = ranges(document.is_wall, document.grid, poses, angles_rad, document.max_range)
    noise = np.stack([standard_noise(document.seed, sensor.id, document.angles) for sensor in document.sensors])
    ranges_m = exact_m + (document.noise if document.readings == "noisy" else 0.0) * noise
    return Scans(poses, angles_rad, ranges_m, max_range_m=document.max_range), exact_m


def simulated_scene(document: Document) -> Scene:
    """Simulate the readings of a drawn world."""
    from bayesmap.kernels.walls.table import trace

    scans, exact_m = simulate_document(document)
    model = Gaussian(document.noise)
    trace_all = partial(trace, scans, document.grid, model)
    # Cutting beams past their readings does not change belief propagation: the omitted cells send messages equal to 1.
    trace_near = partial(trace_all, reach_m=scans.ranges_m.ravel() + CUT_SIGMAS * model.sigma_m)
    ids = tuple(sensor.id for sensor in document.sensors)
    return Scene(scans, exact_m, ids, model, document.grid, Independent(document.prior), trace_all, trace_near)


def hit_mask(scene: Scene) -> NDArray[np.bool_]:
    """Return a mask of the beams that hit something, (S, A): exact in a simulation, else guessed from the readings.
    Without a return, a beam may read the longest range plus noise: readings within `BLUR_SIGMAS` of it are no return.
    """
    max_range_m, sensor = scene.scans.max_range_m, scene.sensor
    if len(scene.exact_m):
        return np.asarray(scene.exact_m < max_range_m)
    noise_m = getattr(sensor, "sigma_m", getattr(sensor, "scale_m", 0.0)) if isinstance(sensor, AdditiveNoise) else 0.0
    ranges_m = scene.scans.ranges_m
    return np.asarray(np.isfinite(ranges_m) & (ranges_m < max_range_m - BLUR_SIGMAS * noise_m))


def scan_message(scene: Scene, scan: int | None, generation: int) -> tuple[Scan, Buffers]:
    """Return the message `Scan` and its buffers: all scans of a simulation, or one scan of a file."""
    rows = np.arange(len(scene.scans)) if scan is None else np.array([scan])
    return Scan([scene.ids[i] for i in rows], scan, generation=generation), scan_buffers(scene, rows)


def scan_buffers(scene: Scene, rows: NDArray[np.intp]) -> Buffers:
    """Return the buffers of the scans in these rows, as the message `Scan` lists them."""
    scans = scene.scans
    exact_m = scene.exact_m[rows] if len(scene.exact_m) else scene.exact_m
    # If scans differ in their beam angles, angles have one row per scan.
    angles = scans.angles_rad if scans.own_angles_rad is None else scans.angles_by_scan()[rows]
    return {
        "pose": scans.poses[rows], "angles": angles.astype(np.float32),
        "ranges": scans.ranges_m[rows].astype(np.float32), "exact": exact_m.astype(np.float32),
        "hit": hit_mask(scene)[rows].astype(np.uint8),
    }  # fmt: skip
