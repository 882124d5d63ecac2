"""Predict readings from draws of a map, averaged over the draws, and compute the likelihood of scans at any poses.

A map has a stop probability m in [0, 1] for every cell, 0 or 1 for binary walls. A beam stops in the i-th cell that it
meets with probability ``w_i = m_i prod_{j < i} (1 - m_j)``, at a distance d_i known up to a spread s_i, or nowhere:

    p(z) = sum_i w_i p(z | d_i, s_i) + prod_j (1 - m_j) p(z | infinity)

The predictive law is the mean over draws. The likelihood of a scan follows this law under one map. Its beams walk the
grid from the pose, so no rays are traced beforehand.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels import rays as traced
from bayesmap.kernels import sensor_law as laws
from bayesmap.kernels.device import ONE, Float32Rows, Float64Rows, Float64s, Floats, Int32s, Ints, Singles, Uint8Rows
from bayesmap.kernels.rays import Line, RayArrays, line_from, line_of, rays_to_device, walk_along
from bayesmap.kernels.sensor_law import MIXTURE, NOISE, SensorLaw64
from bayesmap.kernels.surfaces.surface import REFLECTIVITY, Cell, Ray, cells_to_device, cross_surface
from bayesmap.kernels.walk import NEVER, Walk, advance_walk, is_inside
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.sensors.tabulated import tabulated
from bayesmap.space.arrays import evenly_spaced_indices
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})
StopStates = Singles
"""Maps: stop probabilities of cells without a surface (maps, cells), or surfaces (maps, cells, 6): reflectivity,
mean x and y in metres from the grid's lower left corner, and Cholesky factor l11, l21, l22."""


MIN_STOP_CHANCE = 2e-3  # cells with less count as empty in fast weighing unless near the reading: all poses lose alike
# A beam is followed until its chance to get so far is below this. The limit is lower for noise alone, under which an
# unlikely stop may be the only one that explains a reading; the mixture has a floor.
MIN_SURVIVAL = wp.constant(wp.float64(1.0e-30))
MIN_SURVIVAL_MIXTURE = wp.constant(wp.float64(1.0e-14))
CELLS_PAST_REACH = 4.0  # cells past a reading's reach whose surfaces, which extend along the beam, may explain it
MIN_THREADED_BEAMS = 5_000  # fewer beams than this are done before a second thread has started


@wp.struct
class MapArrays:
    """Maps on a device, one per row."""

    draws: int  # number of maps
    stop: Float32Rows  # stop probabilities, if cells have no surfaces
    surface: wp.array2d(dtype=Cell)  # otherwise, the surfaces
    has_surfaces: int  # 1 if cells have surfaces
    depth: wp.float64  # where beams stop in cells without a surface, as a share of their chord
    empty: Uint8Rows  # 1 in cells that stop less than `MIN_STOP_CHANCE`; only in maps of whole grids


@wp.struct
class Frame:
    """The grid that beams walk."""

    nx: int
    ny: int
    origin_x: wp.float64
    origin_y: wp.float64
    resolution: wp.float64


@wp.func
def line_in(frame: Frame, x: wp.float64, y: wp.float64, angle: wp.float64) -> Line:
    """Return the line of a beam that leaves (x, y) in the world frame at an angle."""
    start = wp.vec2d(x - frame.origin_x, y - frame.origin_y)
    return line_from(start, wp.vec2d(wp.cos(angle), wp.sin(angle)), frame.ny, frame.resolution)


def grid_frame(grid: Grid) -> Frame:
    """Return a grid as kernels read it."""
    (nx, ny), (x, y) = grid.shape, grid.origin
    return devices.pack(Frame, "cpu", nx=nx, ny=ny, origin_x=x, origin_y=y, resolution=grid.resolution)


@wp.func
def surface_stop(maps: MapArrays, row: int, column: int, line: Line) -> wp.vec3d:
    """Return chance, distance and variance of the stop of a beam on a surface."""
    state = maps.surface[row, column]
    crossing = cross_surface(state, Ray(wp.vec2(line.start_m), wp.vec2(line.direction)))
    chance = wp.float64(state[REFLECTIVITY]) * wp.float64(crossing.meeting_chance)
    return wp.vec3d(chance, wp.float64(crossing.distance_m), wp.float64(crossing.variance))


@wp.func
def stop_on_walk(maps: MapArrays, row: int, line: Line, w: Walk) -> wp.vec3d:
    """Return chance, distance and *spread*, not variance, of the stop in a walk's cell, in a map of the whole grid."""
    cell = w.cell_x * line.ny + w.cell_y
    if maps.has_surfaces != 0:
        stop = surface_stop(maps, row, cell, line)
        return wp.vec3d(stop[0], stop[1], wp.sqrt(stop[2]))
    # Length of the beam inside the cell: 0 if it only touches a corner.
    chord = wp.min(wp.min(w.next_x, w.next_y), NEVER) - w.distance
    if w.cell_x != w.beam_x or w.cell_y != w.beam_y:
        chord = wp.where(w.along_line != 0, chord, wp.float64(0.0))
    distance = wp.float64(wp.float32((w.distance + maps.depth * chord) * line.edge_m))
    return wp.vec3d(wp.float64(maps.stop[row, cell]), distance, wp.float64(0.0))


@wp.func
def stop_in(maps: MapArrays, row: int, column: int, line: Line, cell: int) -> wp.vec3d:
    """Return chance, distance and variance of the stop of a beam in ``cell``, which has ``column`` of map ``row``."""
    if maps.has_surfaces != 0:
        return surface_stop(maps, row, column, line)
    chance = wp.float64(maps.stop[row, column])
    if chance == wp.float64(0.0):
        return wp.vec3d(chance, chance, chance)
    return wp.vec3d(chance, traced.distance_at(line, cell, maps.depth), wp.float64(0.0))


def maps_to_device(states: StopStates, hit_depth: float, device: str) -> Any:
    """Put maps on a device: stop probabilities (two dimensions) or surfaces (three), see `StopStates`."""
    surfaces = states.ndim == 3
    cells = {"surface": cells_to_device(states, device)} if surfaces else {"stop": states}
    return devices.pack(MapArrays, device, draws=len(states), has_surfaces=int(surfaces), depth=hit_depth, **cells)


@dataclass(frozen=True, eq=False)
class DeviceMaps:
    """Draws of whole maps on a device, for many predictions: `MapArrays` with a row per draw and a column per cell."""

    arrays: Any
    draws: int
    grid: Grid
    device: str

    def states(self) -> Singles:
        """Return the draws; surfaces have two more numbers, see `Cell`."""
        return np.asarray((self.arrays.surface if self.arrays.has_surfaces else self.arrays.stop).numpy())

    def thinned(self, max_draws: int) -> "DeviceMaps":
        """Return at most ``max_draws`` of the draws, evenly spread."""
        if max_draws >= self.draws:
            return self
        rows = evenly_spaced_indices(self.draws, max_draws)
        return device_maps([self.states()[rows]], self.grid, self.arrays.depth, device=self.device)


def device_maps(batches: Iterable[StopStates], grid: Grid, hit_depth: float, *, device: str = "cpu") -> DeviceMaps:
    """Put draws of all cells of a grid on a device. Raises `BadInput` if there is none."""
    device = devices.resolve(device)
    parts = list(batches)
    require_draws(sum(map(len, parts)))
    states = np.concatenate(parts)
    arrays = maps_to_device(states, hit_depth, device)
    stop_chance = states[..., 0] if states.ndim == 3 else states
    arrays.empty = devices.to_device(stop_chance < MIN_STOP_CHANCE, wp.uint8, device)
    return DeviceMaps(arrays, len(states), grid, device)


def require_draws(draws: int) -> None:
    """Raise `BadInput` if there are no draws."""
    if draws == 0:
        raise BadInput("score: there is no draw to predict from")


@wp.func
def add_log(sums: wp.vec2d, value: wp.float64) -> wp.vec2d:
    """Add a value to a running log-sum-exp: (greatest so far, sum of exp(value - greatest))."""
    if value > sums[0]:
        return wp.vec2d(value, sums[1] * wp.exp(sums[0] - value) + wp.float64(1.0))
    return wp.vec2d(sums[0], sums[1] + wp.exp(value - sums[0]))


@wp.func
def no_sum(law: SensorLaw64) -> wp.vec2d:
    """Return an empty running sum: a log-sum-exp, or a plain sum for a mixture, whose floor avoids underflow."""
    return wp.vec2d(wp.where(law.kind == MIXTURE, wp.float64(0.0), wp.float64(-1.0e300)), wp.float64(0.0))


@wp.func
def add_stop(
    law: SensorLaw64, sums: wp.vec2d, weight: wp.float64, z: wp.float64, decay: wp.float64, stop: wp.vec3d
) -> wp.vec2d:
    """Add ``weight``, in place of the stop's chance, times p(z | stop) to the sum. ``decay`` is `object_decay` of z."""
    if law.kind == MIXTURE:
        return wp.vec2d(sums[0], sums[1] + weight * laws.stop_density(law, z, decay, stop[1], stop[2]))
    return add_log(sums, wp.log(weight) + laws.stop_log_density(law, z, decay, stop[1], stop[2]))


@wp.struct
class ForecastSums:
    """Readings, and running sums over draws."""

    range_m: Float64s  # readings
    reach_m: Float64s  # distance up to which stops may explain them
    largest: Float64s  # density together with ``total``, see `no_sum`
    total: Float64s
    below: Float64s  # cumulative probability at the beam's reading
    below_max: Float64s  # at the largest range
    below_min: Float64s  # at the smallest range


@wp.kernel
def add_forecasts(
    first: int, law: SensorLaw64, rays: RayArrays, columns: Int32s, maps: MapArrays, with_cumulative: int,
    out: ForecastSums,
):  # fmt: skip
    """One thread per beam: add the law of its reading under each draw of a batch to running sums."""
    # z_limit: the reading z, or the limit that a typed reading stands for; beyond: first entry past the reach, whose
    # stops give the reading the same density as no stop.
    beam = first + wp.tid()
    z = out.range_m[beam]
    if wp.isnan(z):
        return
    line = line_of(rays.lines, beam)
    nowhere = wp.vec3d(ONE, wp.float64(wp.inf), wp.float64(0.0))
    sums = wp.vec2d(out.largest[beam], out.total[beam])
    z_limit = z
    if wp.isinf(z):
        z_limit = wp.where(z > wp.float64(0.0), law.max_m, law.min_m)
    min_survival = wp.where(law.kind == MIXTURE, MIN_SURVIVAL_MIXTURE, MIN_SURVIVAL)
    decay = laws.object_decay(law, z)
    begin, end = rays.offsets[beam], rays.offsets[beam + 1]
    beyond = traced.first_past(line, rays.cells, begin, end, out.reach_m[beam], wp.float64(0.0))
    for draw in range(maps.draws):
        survive = wp.float64(1.0)
        for entry in range(begin, end + 1):
            if entry == beyond:
                sums = add_stop(law, sums, survive, z, decay, nowhere)
                if with_cumulative == 0:
                    break
            weight = survive
            stop = nowhere
            if entry < end:
                stop = stop_in(maps, draw, columns[entry], line, rays.cells[entry])
                weight = survive * stop[0]
                survive = survive * (ONE - stop[0])
            if weight <= wp.float64(0.0):
                continue
            if entry < beyond:
                sums = add_stop(law, sums, weight, z, decay, stop)
            if with_cumulative != 0:
                out.below[beam] = out.below[beam] + weight * laws.cumulative(law, z_limit, stop[1], stop[2])
                if law.kind != NOISE:
                    below_max = laws.cumulative(law, law.max_m, stop[1], stop[2])
                    below_min = laws.cumulative(law, law.min_m, stop[1], stop[2])
                    out.below_max[beam] = out.below_max[beam] + weight * below_max
                    out.below_min[beam] = out.below_min[beam] + weight * below_min
            if survive < min_survival:
                break
    out.largest[beam] = sums[0]
    out.total[beam] = sums[1]


@dataclass(frozen=True, eq=False)
class Forecast:
    """The prediction of each beam's reading, and its probability integral transform (PIT); NaN for invalid readings."""

    log_density: Floats  # log predictive density of a range in nats per metre, log probability of a typed reading, (B,)
    pit_low: Floats  # predictive P(value < reading), (B,)
    pit_high: Floats  # predictive P(value <= reading), equal for ranges, (B,)
    p_no_return: Floats  # predictive probability of this reading, (B,); 0 if the sensor is noise alone
    p_too_close: Floats  # predictive probability of this reading, (B,); 0 if the sensor is noise alone


def law_with_cumulative(sensor: SensorModel, limits: RangeLimits, device: str) -> Any:
    """Return the law for kernels that need cumulatives. Raises `BadInput` if probabilities do not add up to one."""
    law = laws.sensor_law(sensor, limits, device)
    if sensor.kernel_parameters() is None and not tabulated(sensor, limits).has_cumulative:
        raise BadInput(
            f"score: the densities of {type(sensor).__name__} do not integrate to one, so only its log score can be "
            "had (Run.log_score); mend log_likelihood(), or add cumulative()"
        )
    return law


def are_typed(sensor: SensorModel, limits: RangeLimits) -> bool:
    """Return whether no return and too close are outcomes of their own; else they stand for the limits."""
    parameters = sensor.kernel_parameters()
    return tabulated(sensor, limits).typed if parameters is None else parameters.robust


def explained_within_m(range_m: Floats, sensor: SensorModel, limits: RangeLimits, resolution_m: float) -> Floats:
    """Return the distance past which a stop explains a reading no better than no stop, metres, or infinity if none."""
    return np.asarray(sensor.reach_m(range_m, limits) + CELLS_PAST_REACH * resolution_m)


def _summed_forecasts(
    rays: Rays, columns: Ints, batches: Iterable[StopStates], sensor: SensorModel, hit_depth: float, device: str, *,
    with_cumulative: bool,
) -> tuple[Floats, list[Floats]]:  # fmt: skip
    """Compute log densities, and mean cumulatives at the reading and at the largest and smallest range, (B,) each."""
    device = devices.resolve(device)
    law = (law_with_cumulative if with_cumulative else laws.sensor_law)(sensor, rays.limits, device)
    beams, cumulatives = rays.n_beams, (rays.n_beams if with_cumulative else 1,)  # 1: not used
    reach_m = explained_within_m(rays.range_m, sensor, rays.limits, rays.grid.resolution)
    sums = devices.pack(
        ForecastSums, device, range_m=rays.range_m, reach_m=reach_m, total=(beams,), below=cumulatives,
        below_max=cumulatives, below_min=cumulatives, largest=np.full(beams, 0.0 if law.kind == MIXTURE else -1.0e300),
    )  # fmt: skip
    rays_and_columns = [rays_to_device(rays, device), devices.to_device(columns, wp.int32, device)]
    draws = 0
    for batch in batches:
        draws += len(batch)
        inputs = [law, *rays_and_columns, maps_to_device(batch, hit_depth, device), int(with_cumulative)]
        devices.launch(add_forecasts, beams, [*inputs, sums], device, 1 if beams < MIN_THREADED_BEAMS else None)
    require_draws(draws)
    with np.errstate(divide="ignore"):
        log_density = sums.largest.numpy() + np.log(sums.total.numpy() / draws)
    log_density[np.isnan(rays.range_m)] = np.nan
    return log_density, [a.numpy() / draws for a in (sums.below, sums.below_max, sums.below_min)]


def log_densities(
    rays: Rays, batches: Iterable[StopStates], sensor: SensorModel, hit_depth: float, *, columns: Ints | None = None,
    device: str = "cpu",
) -> Floats:  # fmt: skip
    """Compute the log predictive density of every reading, (B,), of beams traced at least as far as it reaches."""
    columns = rays.columns if columns is None else columns  # columns of the entries' cells in the draws, (K,)
    return _summed_forecasts(rays, columns, batches, sensor, hit_depth, device, with_cumulative=False)[0]


def forecast(
    rays: Rays, batches: Iterable[StopStates], sensor: SensorModel, hit_depth: float, *, device: str = "cpu"
) -> Forecast:
    """Predict the reading of every beam, traced over its whole length, under the mean of the law over draws.
    The columns of the draws are the cells ``rays.touched``. Without a surface, a beam stops at the share ``hit_depth``
    of its chord. Raises `BadInput` without draws, or if probabilities of a user's sensor do not add up to one.
    """
    log_density, cumulative = _summed_forecasts(
        rays, rays.columns, batches, sensor, hit_depth, device, with_cumulative=True
    )
    below, below_max, below_min = cumulative
    z = rays.range_m
    typed = are_typed(sensor, rays.limits)
    nan = np.where(np.isnan(z), np.nan, 0.0)
    none, close = (1.0 - below_max, below_min) if typed else (np.zeros_like(below), np.zeros_like(below))
    low = np.where(np.isneginf(z) & typed, 0.0, np.where(np.isposinf(z) & typed, below_max, below))
    high = np.where(np.isposinf(z) & typed, 1.0, below)
    return Forecast(log_density, *(np.clip(a, 0.0, 1.0) + nan for a in (low, high, none, close)))


@wp.struct
class PosedScans:
    """Poses of scans of A beams each, and the maps under which they are weighed."""

    pose: Float64Rows  # pose in the world frame
    scan: Int32s  # index of the scan at each pose
    map_index: Int32s  # index of the map at each pose
    mounts: Float64Rows  # start and angle in the scan's frame, of each beam of a scan or of all scans
    range_m: Float64s  # readings of all scans
    beams: int  # A


@wp.kernel
def beam_log_likelihoods(first: int, law: SensorLaw64, frame: Frame, maps: MapArrays, scans: PosedScans, out: Float64s):
    """One thread per beam of a pose: compute log p(reading | cells, pose)."""
    thread = first + wp.tid()
    row = thread / scans.beams
    beam = scans.scan[row] * scans.beams + thread % scans.beams  # among those of all scans
    z = scans.range_m[beam]
    if wp.isnan(z):
        return
    # The line of the beam in the world frame.
    mount = thread % scans.beams
    if scans.mounts.shape[0] > scans.beams:
        mount = beam
    yaw = scans.pose[row, 2]
    x = scans.pose[row, 0] + wp.cos(yaw) * scans.mounts[mount, 0] - wp.sin(yaw) * scans.mounts[mount, 1]
    y = scans.pose[row, 1] + wp.sin(yaw) * scans.mounts[mount, 0] + wp.cos(yaw) * scans.mounts[mount, 1]
    line = line_in(frame, x, y, yaw + scans.mounts[mount, 2])
    # Walk, and sum the density over stops; then add the beam that stops nowhere.
    min_survival = wp.where(law.kind == MIXTURE, MIN_SURVIVAL_MIXTURE, MIN_SURVIVAL)
    decay = laws.object_decay(law, z)
    sums = no_sum(law)
    survive = wp.float64(1.0)
    w = walk_along(line, frame.nx, law.max_m)
    while w.distance <= w.end and survive >= min_survival:
        if is_inside(w, frame.nx, frame.ny):
            stop = stop_on_walk(maps, scans.map_index[row], line, w)
            weight = survive * stop[0]
            survive = survive * (ONE - stop[0])
            if weight > wp.float64(0.0):
                moments = wp.vec3d(weight, stop[1], stop[2] * stop[2])  # variance in place of the spread
                sums = add_stop(law, sums, weight, z, decay, moments)
        w = advance_walk(w)
    if survive > wp.float64(0.0):
        sums = add_stop(law, sums, survive, z, decay, wp.vec3d(survive, wp.float64(wp.inf), wp.float64(0.0)))
    out[thread] = sums[0] + wp.log(sums[1])


@dataclass(frozen=True, eq=False)
class ScanLikelihood:
    """The likelihood of scans at any poses under any cells. Beams keep their starts and angles relative to the pose."""

    scans: Scans
    grid: Grid
    sensor: SensorModel
    hit_depth: float  # share of its chord in a cell without a surface at which a beam stops
    device: str = "cpu"

    def beams(
        self, cells: Singles | DeviceMaps, poses: Floats, scan: NDArray[np.intp], map_index: NDArray[np.intp]
    ) -> Floats:
        """Compute the log density of each reading at poses in the world frame, invalid ones 0, in nats, (P, A).
        ``cells`` holds a map of the whole grid per row, see `StopStates`; `DeviceMaps` are not copied. ``scan`` and
        ``map_index`` are the indices of the scan and of the map at each pose, (P,).
        """
        device, beams = devices.resolve(self.device), self.scans.ranges_m.shape[1]
        limits = RangeLimits(self.scans.min_range_m, self.scans.max_range_m)
        law, size = laws.sensor_law(self.sensor, limits, device), len(poses) * beams
        maps = cells.arrays if isinstance(cells, DeviceMaps) else maps_to_device(cells, self.hit_depth, device)
        mounts, readings = self._on_device
        fields = {"pose": poses, "scan": scan, "map_index": map_index, "mounts": mounts, "range_m": readings}
        scans = devices.pack(PosedScans, device, beams=beams, **fields)
        inputs = [law, grid_frame(self.grid), maps, scans, (size,)]
        (out,) = devices.launch(beam_log_likelihoods, size, inputs, device, devices.threads_for(size))
        return np.asarray(out.reshape(len(poses), beams))

    def __call__(self, cells: Singles, poses: Floats, scan: NDArray[np.intp], map_index: NDArray[np.intp]) -> Floats:
        """Compute the log-likelihood of each scan at its pose, (P,): the sum of `beams`."""
        return np.asarray(self.beams(cells, poses, scan, map_index).sum(axis=1))

    @cached_property
    def _on_device(self) -> tuple[Any, Any]:
        """The mounts of beams and the readings on the device."""
        scans = self.scans
        readings = devices.to_device(scans.ranges_m.ravel(), wp.float64, self.device)
        mounts = np.zeros((len(scans.angles_rad), 3))
        mounts[:, 2] = scans.angles_rad
        if scans.own_angles_rad is not None:
            mounts = np.zeros((*scans.ranges_m.shape, 3))
            mounts[..., 2] = scans.angles_by_scan()
            mounts = mounts.reshape(-1, 3)
        if scans.beam_poses is not None:
            dx, dy = np.moveaxis(scans.beam_poses[..., :2] - scans.poses[:, None, :2], -1, 0)
            yaw = scans.poses[:, 2:3]
            x, y = np.cos(yaw) * dx + np.sin(yaw) * dy, np.cos(yaw) * dy - np.sin(yaw) * dx
            mounts = np.stack([x, y, scans.beam_angles_world() - yaw], axis=-1).reshape(-1, 3)
        return devices.to_device(mounts, wp.float64, self.device), readings
