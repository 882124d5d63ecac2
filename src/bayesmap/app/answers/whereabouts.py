"""The posterior of the pose from which one scan was taken, over all positions and headings in a map.

In a drawn world the map is known, and readings follow their law independently, so each beam counts in full. For a run
or a log with kept draws, the map is given by these draws. Beams then count as in `bayesmap.localization.known_map`.
"""

import math
from collections.abc import Hashable
from dataclasses import replace

import numpy as np

from bayesmap.app.protocol.actions import WhereAmI
from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import Place, Whereabouts
from bayesmap.app.protocol.tasks import Buffers
from bayesmap.app.scene import hit_mask
from bayesmap.app.shown.result import Result
from bayesmap.errors import BadInput
from bayesmap.localization.belief import Mode, PoseBelief
from bayesmap.localization.filter import Scan, locate
from bayesmap.localization.known_map import KnownMap
from bayesmap.localization.localize import localize
from bayesmap.samplers.sampler import Stream
from bayesmap.sensors.model import Gaussian, RangeLimits
from bayesmap.sim.forward import ranges
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans, fan

FINEST_M = 0.125  # cells of a drawn map are divided down to this edge, since the search tries centres of cells
MAX_CELLS = 1_000_000  # cells after the division: with more, cells are divided into fewer parts
TYPICAL_SCANS = 100  # number of typical scans of a drawn world
MAX_POSES = 1000  # poses sent to the page: those with the largest weights


class Locator:
    """Locates one scan at a time, and keeps the prepared map for the next."""

    def __init__(self) -> None:
        self._known_map: KnownMap | None = None
        self._key: Hashable = None  # the values that the known map depends on

    def answer(
        self, question: WhereAmI, result: Result | None, scan: int, generation: int
    ) -> tuple[Whereabouts, Buffers]:
        """Find the places where a scan may have been taken, or return the reason why there is no answer.
        In a drawn world, the question names the sensor. For a file, ``scan`` is the index of the scan on show.
        ``generation`` is the number of the present picture.
        """
        try:
            if result is None:
                raise BadInput("there is no map to be located in yet")
            one_scan, row = _select_scan(question, result, scan)
            belief = _locate(self._known_map_of(result), one_scan, result.document)
        except BadInput as error:
            return Whereabouts(generation, trouble=str(error).removeprefix("localize: ")), {}
        is_file = not result.document.simulated
        heaviest = np.argsort(belief.weights, kind="stable")[-MAX_POSES:]
        whereabouts = Whereabouts(
            generation, sensor=None if is_file else result.scene.ids[row], index=row if is_file else None,
            pose=one_scan.poses[0].tolist(), modes=[_place_of(mode) for mode in belief.modes],
            p_lost=float(belief.p_lost), nats_per_beam=float(belief.nats_per_beam),
        )  # fmt: skip
        poses, weights = belief.poses[heaviest].astype(np.float32), belief.weights[heaviest].astype(np.float32)
        return whereabouts, {"pose": poses, "weight": weights}

    def _known_map_of(self, result: Result) -> KnownMap:
        """Return the known map of a result. It is prepared again only if a value that it depends on has changed."""
        document = result.document
        key: Hashable = result.estimate
        if document.simulated:
            key = (document.walls, document.grid, document.noise, document.max_range, document.angles, document.fov)
        if self._known_map is None or key != self._key:
            if result.estimate.kept_draws is None and not document.simulated:
                raise BadInput("a scan is located by draws of the map, and there are none yet; run Gibbs")
            self._known_map = known_map_of_drawing(document) if document.simulated else KnownMap.of_run(result.as_run())
            self._key = key
        return self._known_map


def known_map_of_drawing(document: Document) -> KnownMap:
    """Return the walls of a drawn world as a known map. Raises `BadInput` if it has no free cell."""
    grid = document.grid
    n_parts = max(1, min(math.ceil(grid.resolution / FINEST_M - 1e-9), math.isqrt(MAX_CELLS // grid.n_cells)))
    fine_walls = document.is_wall.repeat(n_parts, axis=0).repeat(n_parts, axis=1).astype(np.float64)
    fine_grid = Grid((grid.shape[0] * n_parts, grid.shape[1] * n_parts), grid.resolution / n_parts, grid.origin)
    return KnownMap.of_draws(
        fine_walls.reshape(1, -1).astype(np.float32), fine_grid, Gaussian(document.noise), _typical_scans(document),
        occupancy=fine_walls, observed=np.ones(fine_grid.shape, dtype=np.bool_), hit_depth=0.0, beam_weight=1.0,
    )  # fmt: skip


def _typical_scans(document: Document) -> Scans:
    """Simulate scans at random poses in a drawn world. Raises `BadInput` if the world has no free cell."""
    grid = document.grid
    rng = np.random.default_rng([document.seed, Stream.TYPICAL])
    free = np.argwhere(~document.is_wall)
    if not len(free):
        raise BadInput("the map has no free cell in which a robot could be")
    cells = free[rng.integers(len(free), size=TYPICAL_SCANS)] + rng.random((TYPICAL_SCANS, 2))
    yaw = rng.uniform(-np.pi, np.pi, TYPICAL_SCANS)
    poses = np.column_stack([np.array(grid.origin) + cells * grid.resolution, yaw])
    angles_rad = fan(document.angles, math.degrees(document.fov))
    exact_m = ranges(document.is_wall, grid, poses, angles_rad, document.max_range)
    noisy_m = exact_m + document.noise * rng.standard_normal(exact_m.shape)
    ranges_m = np.where(exact_m < document.max_range, noisy_m, np.inf)
    return Scans(poses, angles_rad, ranges_m, max_range_m=document.max_range)


def _locate(known_map: KnownMap, one_scan: Scans, document: Document) -> PoseBelief:
    """Return the belief of the pose of one scan."""
    if not document.simulated:
        return localize(known_map, one_scan, seed=document.seed).last
    limits = RangeLimits(one_scan.min_range_m, one_scan.max_range_m)
    scan = Scan(one_scan.angles_rad, one_scan.ranges_m[0], limits)
    return locate(known_map, scan, np.random.default_rng(document.seed))


def _place_of(mode: Mode) -> Place:
    """Return a mode of a belief as a place where the robot may be."""
    sigma_m = float(np.sqrt(np.linalg.eigvalsh(mode.covariance[:2, :2])[-1]))
    return Place(**mode.as_json(), sigma_m=sigma_m, sigma_rad=float(np.sqrt(mode.covariance[2, 2])))


def _select_scan(question: WhereAmI, result: Result, scan: int) -> tuple[Scans, int]:
    """Return the scan to locate, and its index in the scene: ``scan`` for a file, else that of the sensor asked for."""
    scene = result.scene
    if not result.document.simulated:
        return scene.scans.select(slice(scan, scan + 1)), scan
    row = scene.ids.index(question.sensor) if question.sensor in scene.ids else 0
    sensor_scan = scene.scans.select(slice(row, row + 1))
    # The reading of a beam that met nothing is the longest range plus noise. Mark such readings as no return.
    ranges_m = np.where(hit_mask(scene)[[row]], sensor_scan.ranges_m, np.inf)
    return replace(sensor_scan, ranges_m=ranges_m), row
