"""Weigh poses fast: the log-likelihood of a scan at many poses under many draws of a map.

The law is the one of `bayesmap.kernels.predict.density`, in single precision, for mixtures. It is fast because

- the map stays on the device between calls, and one thread does a whole scan;
- a beam's walk ends a margin past its reading: any later stop has the density of a beam that meets nothing;
- before the reading, it matters whether the beam is stopped, not where;
- cells that stop almost no beam (most of a floor) are skipped.
"""

from functools import lru_cache
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels import sensor_law as laws
from bayesmap.kernels.device import ONE_32, ZERO_32, Float64Rows, Float64s, Floats, Int32s
from bayesmap.kernels.predict.density import DeviceMaps, Frame, MapArrays, grid_frame
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.surfaces.surface import REFLECTIVITY, Ray, cross_surface, meeting_chance
from bayesmap.sensors.model import RangeLimits, SensorModel

wp.set_module_options({"enable_backward": False})
# Distance from a reading within which the position of the stop matters: noise scales plus cells.
MARGIN_SCALES = wp.constant(wp.float32(6.0))
MARGIN_CELLS = wp.constant(wp.float32(4.0))  # a surface is smaller than its cell
MIN_CHANCE = wp.constant(wp.float32(1.0e-6))  # a smaller chance of a stop is skipped
NEVER = wp.constant(wp.float32(1.0e30))  # distance of a grid line that the beam does not cross
MIN_DENSITY = wp.constant(wp.float32(1.0e-30))  # smaller densities of readings are raised to this
PARALLEL = wp.constant(wp.float32(1.0e-9))  # direction cosines below this count as zero
MIN_SURVIVAL = wp.constant(wp.float32(1.0e-12))  # a beam is followed until its chance to get so far is below this


@wp.func
def next_line(p: wp.float32, u: wp.float32) -> wp.float32:
    """Return the distance to the next grid line of one axis, in cells, from a coordinate and a direction cosine."""
    if wp.abs(u) < PARALLEL:
        return NEVER
    cell = wp.floor(p)
    if u > ZERO_32:
        return (cell + ONE_32 - p) / u
    return (cell - p) / u


@wp.func
def stop_chance(maps: MapArrays, draw: int, cell: int, ray: Ray) -> wp.float32:
    """Return the chance that a beam which comes to a cell stops in it."""
    if maps.has_surfaces != 0:
        state = maps.surface[draw, cell]
        return state[REFLECTIVITY] * meeting_chance(state, ray)
    return maps.stop[draw, cell]


@wp.func
def relevant_span_m(law: SensorLaw32, frame: Frame, z: wp.float32) -> wp.vec2:
    """Return the distances, metres, between which the position of a stop matters for the density of a reading z."""
    end = wp.clamp(z, ZERO_32, law.max_m)
    margin = MARGIN_SCALES * wp.sqrt(laws.variance_at(law, end, ZERO_32)) + MARGIN_CELLS * wp.float32(frame.resolution)
    last = law.max_m
    if wp.isfinite(z):
        last = wp.min(last, z + margin)
    return wp.vec2(end - margin, last)


@wp.func
def reading_log_density(
    law: SensorLaw32, frame: Frame, maps: MapArrays, draw: int, start_m: wp.vec2, angle: wp.float32, z: wp.float32
) -> wp.float32:
    """Return log p(reading z | map, beam) for a beam from a start in metres from the grid's corner."""
    # The walk is the one of Amanatides and Woo (1987), without a rule for corners. The cell of the sensor is touched
    # where the beam leaves it. Start, in cells: position p, cell c, distance of the next grid lines, gap between lines.
    resolution = wp.float32(frame.resolution)
    depth = wp.float32(maps.depth)
    ux, uy = wp.cos(angle), wp.sin(angle)
    px, py = start_m[0] / resolution, start_m[1] / resolution
    cx, cy = int(wp.floor(px)), int(wp.floor(py))
    step_x, step_y = wp.where(ux > ZERO_32, 1, -1), wp.where(uy > ZERO_32, 1, -1)
    next_x, next_y = next_line(px, ux), next_line(py, uy)
    gap_x = wp.where(next_x < NEVER, wp.abs(ONE_32 / ux), NEVER)
    gap_y = wp.where(next_y < NEVER, wp.abs(ONE_32 / uy), NEVER)
    # Walk, and sum the density over stops: chance of getting to the cell, times chance and density of its stop.
    ray = Ray(start_m, wp.vec2(ux, uy))
    decay = laws.object_decay(law, z)
    span = relevant_span_m(law, frame, z) / resolution
    entry = wp.min(next_x, next_y)
    total = ZERO_32
    survive = ONE_32
    while entry <= span[1] and survive > MIN_SURVIVAL:
        leave = wp.min(next_x, next_y)
        if cx >= 0 and cx < frame.nx and cy >= 0 and cy < frame.ny:
            cell = cx * frame.ny + cy
            if entry >= span[0]:
                chance = stop_chance(maps, draw, cell, ray)
                if chance > MIN_CHANCE:
                    distance = (entry + depth * (leave - entry)) * resolution
                    variance = ZERO_32
                    if maps.has_surfaces != 0:
                        crossing = cross_surface(maps.surface[draw, cell], ray)
                        distance = crossing.distance_m
                        variance = crossing.variance
                    total += survive * chance * laws.stop_density(law, z, decay, distance, variance)
                    survive = survive * (ONE_32 - chance)
            elif maps.empty[draw, cell] == wp.uint8(0):
                chance = stop_chance(maps, draw, cell, ray)
                density = law.uniform
                if not wp.isfinite(z):
                    distance = (entry + depth * (leave - entry)) * resolution
                    density = laws.stop_density(law, z, decay, distance, ZERO_32)
                total += survive * chance * density
                survive = survive * (ONE_32 - chance)
        # Step to the next cell; end outside the grid.
        entry = leave
        if next_x < next_y:
            cx += step_x
            next_x += gap_x
        else:
            cy += step_y
            next_y += gap_y
        if (cx < 0 and step_x < 0) or (cy < 0 and step_y < 0):
            entry = NEVER
        if (cx >= frame.nx and step_x > 0) or (cy >= frame.ny and step_y > 0):
            entry = NEVER
    return wp.log(wp.max(total + survive * laws.no_stop_density(law, z, decay), MIN_DENSITY))


@wp.struct
class WeighedScans:
    """Poses of scans, in the world frame, and the readings of all scans."""

    pose: Float64Rows
    scan: Int32s  # index of the scan at each pose
    angle_rad: Float64s
    range_m: Float64Rows
    columns: int  # columns of the result
    cycle: int  # if positive, pose p is weighed under draw p mod cycle only


@wp.kernel
def scan_log_likelihoods(
    first: int, law: SensorLaw32, frame: Frame, maps: MapArrays, scans: WeighedScans, out: Float64Rows
):
    """One thread per pose and column of the result: sum log p(reading | map, pose) over beams."""
    thread = first + wp.tid()
    pose = thread / scans.columns
    column = thread - pose * scans.columns
    draw = column
    # In a cycle, threads are grouped by draw, because the poses of a draw read the same cells.
    if scans.cycle > 0:
        poses_per_draw = (scans.pose.shape[0] + scans.cycle - 1) / scans.cycle
        draw = thread / poses_per_draw
        pose = (thread - draw * poses_per_draw) * scans.cycle + draw
        column = 0
        if pose >= scans.pose.shape[0]:
            return
    x, y = wp.float32(scans.pose[pose, 0] - frame.origin_x), wp.float32(scans.pose[pose, 1] - frame.origin_y)
    total = wp.float64(0.0)
    for beam in range(scans.angle_rad.shape[0]):
        z = scans.range_m[scans.scan[pose], beam]
        if not wp.isnan(z):
            angle = wp.float32(scans.pose[pose, 2] + scans.angle_rad[beam])
            density = reading_log_density(law, frame, maps, draw, wp.vec2(x, y), angle, wp.float32(z))
            total += wp.float64(density)
    out[pose, column] = total


@lru_cache(maxsize=64)
def _packed_law(sensor: SensorModel, limits: RangeLimits, device: str) -> Any:
    """Return the law of a sensor in single precision; it is packed once."""
    return laws.sensor_law(sensor, limits, device, SensorLaw32)


def scan_log_likelihood(
    maps: DeviceMaps, poses: Floats, angles_rad: Floats, ranges_m: Floats, sensor: SensorModel, limits: RangeLimits, *,
    scan: NDArray[np.intp] | None = None, draws: int | None = None, in_turn: bool = False, threads: int | None = None,
) -> Floats:  # fmt: skip
    """Compute the log-likelihood of scans at poses under draws of the map, nats, (P, D); invalid readings count 0.
    Readings belong to one scan, (A,), or several, (S, A). ``scan`` is the index of each pose's scan, (P,); None for the
    first. The first ``draws`` of the map are used; if ``in_turn``, one for each pose, in turn: the result is (P, 1).
    """
    n_poses, n_draws = len(poses), maps.draws if draws is None else min(draws, maps.draws)
    columns, cycle = (1, n_draws) if in_turn else (n_draws, 0)
    scan = np.zeros(n_poses, np.intp) if scan is None else scan
    scans = devices.pack(
        WeighedScans, maps.device, pose=poses, scan=scan, angle_rad=angles_rad, range_m=np.atleast_2d(ranges_m),
        columns=columns, cycle=cycle,
    )  # fmt: skip
    law = _packed_law(sensor, limits, maps.device)
    inputs = [law, grid_frame(maps.grid), maps.arrays, scans, (n_poses, columns)]
    n_threads = devices.ceil_div(n_poses, cycle) * cycle if in_turn else n_poses * n_draws
    return np.asarray(devices.launch(scan_log_likelihoods, n_threads, inputs, maps.device, threads)[0])
