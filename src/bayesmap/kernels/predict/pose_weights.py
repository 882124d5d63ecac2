"""Weigh poses fast: the log-likelihood of a scan at many poses under many draws of a map.

The law is that of `bayesmap.kernels.predict.scan_likelihood`, in single precision, for mixtures. The map stays where
kernels read it from call to call, one thread does a whole scan, and a beam's walk ends where its reading is behind it:
from there on all that stops have in common remains, the density of a beam that meets nothing. On the way to the reading
it matters whether the beam is stopped, not where; cells that hardly ever stop one, most of a floor, are passed by.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float64Rows, Float64s, Floats, Int32s, Singles, Uint8Rows
from bayesmap.kernels.predict.density import MapArrays, maps_to_device
from bayesmap.kernels.predict.scan_likelihood import Frame, grid_frame
from bayesmap.kernels.sensor_law import (
    SensorLaw32,
    no_stop_density,
    object_decay,
    sensor_law,
    stop_density,
    variance_at,
)
from bayesmap.kernels.surfaces.cell import cross_surface, crossing_probability, ray_from
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid

wp.set_module_options({"enable_backward": False})

PAST_SCALES = wp.constant(wp.float32(6.0))
PAST_CELLS = wp.constant(wp.float32(4.0))
"""Distance before and past a reading within which the place of the stop matters: noise scales, and cells (a surface is
smaller than its cell)."""

LEAST_CHANCE = 2e-3
"""A cell that stops fewer beams than this counts as empty, but where the reading ended near it: there it may be what
the beam met. Elsewhere it takes that share of the beams, from all poses alike."""

UNLIKELY = wp.constant(wp.float32(1.0e-6))
HUGE = wp.constant(wp.float32(1.0e30))
GONE_FAST = wp.constant(wp.float32(1.0e-12))
ONE = wp.constant(wp.float32(1.0))
ZERO = wp.constant(wp.float32(0.0))


@wp.func
def next_line(p: wp.float32, u: wp.float32) -> wp.float32:
    """Return the distance in cells to the next grid line across one axis."""
    if wp.abs(u) < wp.float32(1.0e-9):
        return HUGE
    cell = wp.floor(p)
    if u > ZERO:
        return (cell + ONE - p) / u
    return (cell - p) / u


@wp.func
def reading_log_density(
    law: SensorLaw32, frame: Frame, maps: MapArrays, empty: Uint8Rows, draw: int, x: wp.float32, y: wp.float32,
    angle: wp.float32, z: wp.float32,
) -> wp.float32:  # fmt: skip
    """Return log p(reading | map, beam) for a beam from (x, y), in metres from the grid's corner.

    The walk is that of Amanatides and Woo (1987). Corners, where `bayesmap.kernels.walk` touches all cells that meet,
    are met with probability 0. The cell of the sensor itself is touched where the beam leaves it, as there.
    """
    resolution = wp.float32(frame.resolution)
    depth = wp.float32(maps.depth)
    ux = wp.cos(angle)
    uy = wp.sin(angle)
    px = x / resolution
    py = y / resolution
    cx = int(wp.floor(px))
    cy = int(wp.floor(py))
    step_x = wp.where(ux > ZERO, 1, -1)
    step_y = wp.where(uy > ZERO, 1, -1)
    next_x = next_line(px, ux)
    next_y = next_line(py, uy)
    gap_x = wp.where(next_x < HUGE, wp.abs(ONE / ux), HUGE)
    gap_y = wp.where(next_y < HUGE, wp.abs(ONE / uy), HUGE)
    ray = ray_from(wp.vec2(x, y), wp.vec2(ux, uy))
    decay = object_decay(law, z)
    past = law.max_m
    end = wp.clamp(z, ZERO, law.max_m)
    margin = PAST_SCALES * wp.sqrt(variance_at(law, end, ZERO)) + PAST_CELLS * resolution
    near = (end - margin) / resolution  # from here on it matters where the beam is stopped
    if wp.isfinite(z):
        past = wp.min(past, z + margin)
    past = past / resolution
    entered = wp.min(next_x, next_y)
    total = ZERO
    survive = ONE
    while entered <= past and survive > GONE_FAST:
        left = wp.min(next_x, next_y)
        if cx >= 0 and cx < frame.nx and cy >= 0 and cy < frame.ny:
            cell = cx * frame.ny + cy
            if entered >= near:
                chance = ZERO
                distance = (entered + depth * (left - entered)) * resolution
                variance = ZERO
                if maps.surfaces != 0:
                    state = maps.surface[draw, cell]
                    chance = state[0] * crossing_probability(state, ray)
                    if chance > UNLIKELY:
                        met = cross_surface(state, ray)
                        distance = met.distance_m
                        variance = met.variance
                else:
                    chance = maps.stop[draw, cell]
                if chance > UNLIKELY:
                    total += survive * chance * stop_density(law, z, decay, distance, variance)
                    survive = survive * (ONE - chance)
            elif empty[draw, cell] == wp.uint8(0):
                chance = ZERO
                if maps.surfaces != 0:
                    state = maps.surface[draw, cell]
                    chance = state[0] * crossing_probability(state, ray)
                else:
                    chance = maps.stop[draw, cell]
                density = law.uniform
                if not wp.isfinite(z):
                    distance = (entered + depth * (left - entered)) * resolution
                    density = stop_density(law, z, decay, distance, ZERO)
                total += survive * chance * density
                survive = survive * (ONE - chance)
        entered = left
        if next_x < next_y:
            cx += step_x
            next_x += gap_x
        else:
            cy += step_y
            next_y += gap_y
        if (cx < 0 and step_x < 0) or (cy < 0 and step_y < 0):
            entered = HUGE
        if (cx >= frame.nx and step_x > 0) or (cy >= frame.ny and step_y > 0):
            entered = HUGE
    return wp.log(wp.max(total + survive * no_stop_density(law, z, decay), wp.float32(1.0e-30)))


@wp.kernel
def scan_log_likelihoods(
    first: int, law: SensorLaw32, frame: Frame, maps: MapArrays, empty: Uint8Rows, draws: int, in_turn: int,
    poses: Float64Rows, scan: Int32s, angle_rad: Float64s, range_m: Float64Rows, out: Float64Rows,
):  # fmt: skip
    """One thread per pose and draw: sum log p(reading | map, pose) over beams.

    If ``in_turn`` is positive, pose p is weighed under draw p modulo ``in_turn`` alone; else under all draws.
    """
    t = first + wp.tid()
    p = t / draws
    column = t - p * draws
    d = column
    if in_turn > 0:  # all poses of a draw one after the other: their beams meet the same cells
        each = (poses.shape[0] + in_turn - 1) / in_turn
        d = t / each
        p = (t - d * each) * in_turn + d
        column = 0
        if p >= poses.shape[0]:
            return
    x = wp.float32(poses[p, 0] - frame.origin_x)
    y = wp.float32(poses[p, 1] - frame.origin_y)
    total = wp.float64(0.0)
    for b in range(angle_rad.shape[0]):
        z = range_m[scan[p], b]
        if not wp.isnan(z):
            angle = wp.float32(poses[p, 2] + angle_rad[b])
            total += wp.float64(reading_log_density(law, frame, maps, empty, d, x, y, angle, wp.float32(z)))
    out[p, column] = total


@dataclass(frozen=True, eq=False)
class PackedMap:
    """Draws of a map on a device.

    Attributes:
        maps: the draws.
        empty: 1 where a cell stops fewer beams than `LEAST_CHANCE`, a row a draw.
        draws: how many.
        frame: the grid.
        device: where they are.
    """

    maps: Any
    empty: Any
    draws: int
    frame: Any
    device: str


def pack_map(states: Singles, grid: Grid, hit_depth: float, device: str = "cpu") -> PackedMap:
    """Put draws of a map of a grid on a device: stop probabilities (D, N), or surfaces (D, N, 6).

    In a cell without a surface a beam stops at the part ``hit_depth`` of its chord.
    """
    device = devices.resolve(device)
    chances = states[..., 0] if states.ndim == 3 else states
    empty = devices.to_device((chances < LEAST_CHANCE).astype(np.uint8), wp.uint8, device)
    maps = maps_to_device(np.ascontiguousarray(states), hit_depth, device)
    return PackedMap(maps, empty, len(states), grid_frame(grid), device)


def map_states(packed: PackedMap) -> Singles:
    """Return the draws that `pack_map` was given; surfaces with two more numbers."""
    held = packed.maps.surface if packed.maps.surfaces != 0 else packed.maps.stop
    return np.asarray(held.numpy())


@lru_cache(maxsize=64)
def _law(sensor: SensorModel, limits: RangeLimits, device: str) -> Any:
    return sensor_law(sensor, limits, device, SensorLaw32)


def scan_log_likelihood(
    packed: PackedMap, poses: Floats, angles_rad: Floats, ranges_m: Floats, sensor: SensorModel, limits: RangeLimits,
    scan: NDArray[np.intp] | None = None, draws: int | None = None, in_turn: bool = False, threads: int | None = None,
) -> Floats:  # fmt: skip
    """Compute the log-likelihood of scans at poses under draws of the map, nats, (P, D); invalid readings count 0.

    Args:
        packed: the draws.
        poses: in the world frame, (P, 3).
        angles_rad: of the beams, (A,).
        ranges_m: readings of one scan, (A,), or of several, (S, A).
        sensor: the law of a reading given where its beam stops.
        limits: of the sensor.
        scan: the scan that is weighed at each pose, (P,); the first if None.
        draws: only the first so many draws; all if None.
        in_turn: weigh each pose under one of them, one after the other: (P, 1).
        threads: at once; all cores if None.
    """
    device, count = packed.device, len(poses)
    draws = packed.draws if draws is None else min(draws, packed.draws)
    cycle = draws if in_turn else 0
    draws = 1 if in_turn else draws
    out = wp.empty((count, draws), dtype=wp.float64, device=device)
    which = np.zeros(count, np.int32) if scan is None else np.asarray(scan, np.int32)
    readings = np.ascontiguousarray(np.atleast_2d(ranges_m), dtype=np.float64)
    inputs = [_law(sensor, limits, device), packed.frame, packed.maps, packed.empty, draws, cycle]
    inputs += [poses, which, angles_rad, readings, out]
    size = -(-count // cycle) * cycle if in_turn else count * draws
    devices.launch(scan_log_likelihoods, size, inputs, device, threads)
    return np.asarray(out.numpy())
