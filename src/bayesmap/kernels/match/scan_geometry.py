"""Compute points and wall normals of scans on a device (`points_and_normals`), and pack them for kernels."""

from typing import Any, NamedTuple

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float32s, Float64Rows, Floats, Int32Rows, Int32s, Uint8Rows
from bayesmap.sensors.model import RangeLimits

wp.set_module_options({"enable_backward": False})
NO_POINT, POINT, WITH_NORMAL = (wp.constant(wp.uint8(k)) for k in (0, 1, 2))  # `bayesmap.poses.scan_geometry`'s kinds
NOWHERE_M = wp.constant(wp.float32(1.0e6))  # where beams without a point end: too far to be nearest to any point
MAX_FITS = wp.constant(3)  # fits tried per beam, each twice as wide as the one before
MAX_NEIGHBOURS = wp.constant(40)  # beams to either side, this one included
# Largest gap between neighbouring points of one surface: metres plus spacings of beams head-on, or standard deviations.
GAP_M, GAP_SPACINGS, GAP_SIGMAS = (wp.constant(wp.float32(x)) for x in (0.05, 3.5, 5.0))
# Largest distance of the two neighbours on either side that are always tried: metres, standard deviations, or spacings.
NEAR_M, NEAR_SIGMAS, NEAR_SPACINGS = (wp.constant(wp.float32(x)) for x in (0.5, 20.0, 2.2))
# Largest variance across a straight wall, in those of a point, of the first and of wider fits; and over that along it.
FIRST_VARIANCES, WIDER_VARIANCES, MAX_RATIO = (wp.constant(wp.float32(x)) for x in (4.0, 1.5, 0.04))


@wp.struct
class ScanArrays:
    """Points and normals of all scans on a device, see `bayesmap.poses.scan_geometry.ScanGeometry`."""

    points: wp.array2d(dtype=wp.vec2f)
    normals: wp.array2d(dtype=wp.vec2f)
    kind: Uint8Rows
    spread: Float32Rows
    beam_of_angle: Int32Rows
    layout: Int32s  # row of beam_of_angle of each scan
    beams: Int32s  # number of beams of each scan
    step: Float32s  # angle between neighbouring beams of each scan, radians
    full_circle: Int32s
    stride: int  # pair every ``stride``-th point


class LineFit(NamedTuple):
    """Rules of the lines that are fitted to walls."""

    reach_m: float  # distance of neighbours at first
    noise_m: float  # standard deviation of a point


@wp.func
def neighbour(beam: int, steps: int, beams: int, full_circle: int) -> int:
    """Return the beam ``steps`` further on, or -1 past the end of a scan that is not a full circle."""
    other = beam + steps
    if full_circle != 0:
        return (other % beams + beams) % beams  # a remainder has the sign of its dividend
    if other < 0 or other >= beams:
        return -1
    return other


@wp.func
def max_gap(step_rad: wp.float32, away: wp.float32) -> wp.float32:
    """Return the largest gap between points of neighbouring beams on one surface, ``away`` metres from the laser."""
    return GAP_M + GAP_SPACINGS * (step_rad * away)


@wp.kernel
def scan_points(
    first: int, ranges: Float64Rows, angles: Float64Rows, min_m: wp.float64, max_m: wp.float64, scans: ScanArrays
):
    """One thread per scan: compute where its beams ended, in its frame; ``angles`` has one row for all, or one each."""
    scan = first + wp.tid()
    row = wp.min(scan, angles.shape[0] - 1)
    for beam in range(ranges.shape[1]):
        r = ranges[scan, beam]
        scans.kind[scan, beam] = NO_POINT
        scans.points[scan, beam] = wp.vec2f(NOWHERE_M, NOWHERE_M)
        if r > min_m and r < max_m:  # false for NaN and for either infinity
            x = wp.float32(r * wp.cos(angles[row, beam]))
            scans.points[scan, beam] = wp.vec2f(x, wp.float32(r * wp.sin(angles[row, beam])))
            scans.kind[scan, beam] = POINT


@wp.struct
class PointSums:
    """Sums over a point and its neighbours along the wall, of their offsets from the point."""

    count: float  # number of points, this one included
    offset: wp.vec2f
    square: wp.mat22f  # offset times offset transposed


@wp.func
def sum_neighbours(
    scans: ScanArrays, scan: int, beam: int, reach: wp.float32, gap: wp.float32, near: wp.float32
) -> PointSums:
    """Sum the offsets of consecutive points to both sides: no two further apart than ``gap``, all within ``reach``."""
    # The next two points to either side may lie beyond the reach, up to ``near``.
    point = scans.points[scan, beam]
    sums = PointSums()
    sums.count = 1.0
    for side in range(2):
        last = point
        for k in range(1, MAX_NEIGHBOURS):
            other_beam = neighbour(beam, wp.where(side == 0, -k, k), scans.beams[scan], scans.full_circle[scan])
            if other_beam < 0:
                break
            if scans.kind[scan, other_beam] == NO_POINT:
                break
            other = scans.points[scan, other_beam]
            offset = other - point
            distance = wp.length(offset)
            if wp.length(other - last) > gap or distance > near or (k > 2 and distance > reach):
                break
            sums.count += 1.0
            sums.offset += offset
            sums.square += wp.outer(offset, offset)
            last = other
    return sums


@wp.kernel
def scan_normals(first: int, scans: ScanArrays, reach_m: wp.float32, noise_m: wp.float32):
    """One thread per scan: fit the line through each point's neighbours along the wall, by least squares.
    Neighbours are consecutive beams without a gap, at first within ``reach_m``. The reach is doubled as long as the
    wall stays straight within ``noise_m``. A piece whose direction the noise hides has no normal. ``spread`` is the
    variance of the normal's angle per variance of a point: one over the sum of squared distances along the line.
    """
    scan = first + wp.tid()
    step_rad = scans.step[scan]
    for beam in range(scans.points.shape[1]):
        scans.normals[scan, beam] = wp.vec2f(wp.float32(0.0), wp.float32(0.0))
        scans.spread[scan, beam] = wp.float32(0.0)
        if scans.kind[scan, beam] == NO_POINT:
            continue
        point = scans.points[scan, beam]
        away = wp.length(point)
        apart = step_rad * away  # between neighbouring beams on a wall seen head-on
        # Limits of a fit: the gap between neighbouring points, and the distance of the two neighbours, metres.
        gap = wp.max(max_gap(step_rad, away), GAP_SIGMAS * noise_m)
        near = wp.max(wp.max(NEAR_M, NEAR_SIGMAS * noise_m), NEAR_SPACINGS * apart)
        reach = reach_m
        for fit in range(MAX_FITS):
            sums = sum_neighbours(scans, scan, beam, reach, gap, near)
            if sums.count < 3.0:
                break
            # Eigenvalues of the scatter matrix (xx, xy; xy, yy), along the wall and across.
            xx = sums.square[0, 0] - sums.offset[0] * sums.offset[0] / sums.count
            xy = sums.square[0, 1] - sums.offset[0] * sums.offset[1] / sums.count
            yy = sums.square[1, 1] - sums.offset[1] * sums.offset[1] / sums.count
            root = wp.sqrt(wp.max(wp.float32(0.0), (xx - yy) * (xx - yy) * wp.float32(0.25) + xy * xy))
            along = (xx + yy) * wp.float32(0.5) + root
            across = wp.max((xx + yy) * wp.float32(0.5) - root, wp.float32(0.0))
            # The piece must be as straight as the noise lets it be, and long enough beside its thickness.
            is_straight = across < sums.count * FIRST_VARIANCES * noise_m * noise_m
            if fit > 0:
                is_straight = is_straight and across < sums.count * WIDER_VARIANCES * noise_m * noise_m
            if not is_straight:
                break
            reach = reach * wp.float32(2.0)
            if across >= MAX_RATIO * along:
                continue  # noise hides the direction of so short a piece: a longer one may show it
            turn = wp.float32(0.5) * wp.atan2(wp.float32(2.0) * xy, xx - yy)
            normal = wp.vec2f(-wp.sin(turn), wp.cos(turn))
            if normal[0] * point[0] + normal[1] * point[1] > wp.float32(0.0):
                normal = -normal  # towards the laser
            scans.normals[scan, beam] = normal
            scans.spread[scan, beam] = wp.float32(1.0) / wp.max(along, wp.float32(1.0e-6))
    for beam in range(scans.beams[scan]):
        if scans.spread[scan, beam] > wp.float32(0.0):
            scans.kind[scan, beam] = WITH_NORMAL


def points_and_normals(
    ranges_m: Floats, angles_rad: Floats, limits: RangeLimits, fans: Any, fit: LineFit, device: str = "cpu",
    threads: int | None = None,
) -> Any:  # fmt: skip
    """Compute the `ScanArrays` of scans, with points, normals, kinds and spreads.
    Readings are (S, B), NaN past a scan's last beam; ascending angles (1, B) for all scans, or (S, B). Readings between
    the limits are points. ``fans`` is a `bayesmap.poses.scan_geometry.Fans`.
    """
    device = devices.resolve(device)
    n_scans, beams = ranges_m.shape
    points, normals = (wp.empty((n_scans, beams), dtype=wp.vec2f, device=device) for _ in range(2))
    kind = wp.empty((n_scans, beams), dtype=wp.uint8, device=device)
    spread = wp.empty((n_scans, beams), dtype=wp.float32, device=device)
    scans = _pack_fans(fans, device, points=points, normals=normals, kind=kind, spread=spread)
    devices.launch(scan_points, n_scans, [ranges_m, angles_rad, limits.min_m, limits.max_m, scans], device, threads)
    devices.launch(scan_normals, n_scans, [scans, fit.reach_m, fit.noise_m], device, threads)
    return scans


def _pack_fans(fans: Any, device: str, **fields: Any) -> Any:
    """Return the `ScanArrays` with these fields, for scans with these directions of beams."""
    return devices.pack(
        ScanArrays, device, beam_of_angle=fans.beam_of_angle, layout=fans.layout, beams=fans.beams,
        step=fans.step_rad, full_circle=fans.full_circle, **fields,
    )  # fmt: skip


def scan_arrays(geometry: Any, stride: int = 1) -> Any:
    """Return a `bayesmap.poses.scan_geometry.ScanGeometry` as kernels read it; it is packed once for each stride."""
    key = f"stride {stride}"
    if key not in geometry.kernel_inputs:
        fields = {name: getattr(geometry, name) for name in ("points", "normals", "kind", "spread")}
        geometry.kernel_inputs[key] = _pack_fans(geometry.fans, geometry.device, stride=stride, **fields)
    return geometry.kernel_inputs[key]


def equal_weights(geometry: Any) -> Any:
    """Return equal weights of all beams, (S, B), on the geometry's device. Front ends use them for every scan."""
    if "weights" not in geometry.kernel_inputs:
        shape = (len(geometry), geometry.beams)
        geometry.kernel_inputs["weights"] = wp.full(shape, 1.0, dtype=wp.float32, device=geometry.device)
    return geometry.kernel_inputs["weights"]


def select_rows(array: Any, rows: NDArray[np.intp]) -> Any:
    """Copy rows of an array on a device."""
    return wp.array(np.ascontiguousarray(array.numpy()[rows]), dtype=array.dtype, device=array.device)
