"""Points and wall normals of scans, on a device."""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float32s, Float64Rows, Floats, Int32Rows, Int32s, Uint8Rows

wp.set_module_options({"enable_backward": False})

POINT = wp.constant(wp.uint8(1))
WITH_NORMAL = wp.constant(wp.uint8(2))
NOWHERE_M = wp.constant(wp.float32(1.0e6))  # where beams without a point end: too far to be nearest to any point
MOST_FITS = wp.constant(3)  # fits tried per beam, each twice as wide as the one before
MOST_NEIGHBOURS = wp.constant(40)  # beams to either side, this one included


@wp.struct
class ScanArrays:
    """Points and normals of all scans on a device, see `bayesmap.poses.scan_geometry.ScanGeometry`."""

    points: wp.array2d(dtype=wp.vec2f)
    normals: wp.array2d(dtype=wp.vec2f)
    kind: Uint8Rows
    spread: Float32Rows
    beam_of_angle: Int32Rows
    layout: Int32s  # row of beam_of_angle of each scan
    beams: Int32s
    step: Float32s
    full_circle: Int32s
    stride: int  # every so many-th point is paired


@wp.func
def neighbour(beam: int, steps: int, beams: int, full_circle: int) -> int:
    """Return the beam ``steps`` further on; -1 past the end of a scan that is not a full circle."""
    other = beam + steps
    if full_circle != 0:
        return (other + beams) % beams
    if other < 0 or other >= beams:
        return -1
    return other


@wp.func
def max_gap(step_rad: wp.float32, away: wp.float32) -> wp.float32:
    """Return how far apart the points of two neighbouring beams on one surface may lie, ``away`` from the laser."""
    return wp.float32(0.05) + wp.float32(3.5) * (step_rad * away)


@wp.kernel
def scan_points(
    first: int, ranges: Float64Rows, angles: Float64Rows, nearest: wp.float64, farthest: wp.float64,
    points: wp.array2d(dtype=wp.vec2f), kind: Uint8Rows,
):  # fmt: skip
    """One thread per scan: compute where its beams ended, in its frame; ``angles`` has one row for all, or one each."""
    s = first + wp.tid()
    row = wp.min(s, angles.shape[0] - 1)
    for b in range(ranges.shape[1]):
        r = ranges[s, b]
        kind[s, b] = wp.uint8(0)
        points[s, b] = wp.vec2f(NOWHERE_M, NOWHERE_M)
        if r > nearest and r < farthest:  # false for NaN and for either infinity
            points[s, b] = wp.vec2f(wp.float32(r * wp.cos(angles[row, b])), wp.float32(r * wp.sin(angles[row, b])))
            kind[s, b] = POINT


@wp.kernel
def scan_normals(
    first: int, points: wp.array2d(dtype=wp.vec2f), beams_of: Int32s, step_of: Float32s, circle_of: Int32s,
    reach_m: wp.float32, noise_m: wp.float32, kind: Uint8Rows, normals: wp.array2d(dtype=wp.vec2f), spread: Float32Rows,
):  # fmt: skip
    """One thread per scan: fit the line through each point's neighbours along the wall, by least squares.

    Neighbours are consecutive beams without a gap, at first within ``reach_m``. The reach is doubled as long as the
    wall stays straight within ``noise_m``. A piece whose direction the noise hides has no normal. ``spread`` is the
    variance of the normal's angle per variance of a point: one over the sum of squared distances along the line.
    """
    # s: scan; b: beam; c: neighbouring beam; n, sums, squares: number of points, and sums of their offsets; a, h, c2:
    # their scatter matrix; along, across: its eigenvalues.
    s = first + wp.tid()
    beams = beams_of[s]
    step_rad = step_of[s]
    full_circle = circle_of[s]
    for b in range(points.shape[1]):
        normals[s, b] = wp.vec2f(wp.float32(0.0), wp.float32(0.0))
        spread[s, b] = wp.float32(0.0)
        if kind[s, b] == wp.uint8(0):
            continue
        point = points[s, b]
        away = wp.length(point)
        apart = step_rad * away  # between neighbouring beams on a wall seen head-on
        gap = wp.max(max_gap(step_rad, away), wp.float32(5.0) * noise_m)
        farthest = wp.max(wp.max(wp.float32(0.5), wp.float32(20.0) * noise_m), wp.float32(2.2) * apart)
        reach = reach_m
        for fit in range(MOST_FITS):
            n = float(1.0)
            sums = wp.vec2f()
            squares = wp.mat22f()
            for side in range(2):
                last = point
                for k in range(1, MOST_NEIGHBOURS):
                    c = neighbour(b, wp.where(side == 0, -k, k), beams, full_circle)
                    if c < 0:
                        break
                    if kind[s, c] == wp.uint8(0):
                        break
                    other = points[s, c]
                    if wp.length(other - last) > gap:
                        break
                    d = other - point
                    distance = wp.length(d)
                    if distance > farthest:
                        break
                    if k > 2 and distance > reach:
                        break
                    n += 1.0
                    sums += d
                    squares += wp.outer(d, d)
                    last = other
            if n < 3.0:
                break
            a = squares[0, 0] - sums[0] * sums[0] / n
            h = squares[0, 1] - sums[0] * sums[1] / n
            c2 = squares[1, 1] - sums[1] * sums[1] / n
            root = wp.sqrt(wp.max(wp.float32(0.0), (a - c2) * (a - c2) * wp.float32(0.25) + h * h))
            along = (a + c2) * wp.float32(0.5) + root
            across = wp.max((a + c2) * wp.float32(0.5) - root, wp.float32(0.0))
            long = across < wp.float32(0.04) * along
            straight = across < n * wp.float32(4.0) * noise_m * noise_m
            if fit > 0:
                straight = straight and across < n * wp.float32(1.5) * noise_m * noise_m
            if not straight:
                break
            reach = reach * wp.float32(2.0)
            if not long:
                continue  # noise hides the direction of so short a piece: a longer one may show it
            turn = wp.float32(0.5) * wp.atan2(wp.float32(2.0) * h, a - c2)
            normal = wp.vec2f(-wp.sin(turn), wp.cos(turn))
            if normal[0] * point[0] + normal[1] * point[1] > wp.float32(0.0):
                normal = -normal  # towards the laser
            normals[s, b] = normal
            spread[s, b] = wp.float32(1.0) / wp.max(along, wp.float32(1.0e-6))
    for b in range(beams):
        if spread[s, b] > wp.float32(0.0):
            kind[s, b] = WITH_NORMAL


def points_and_normals(
    ranges_m: Floats, angles_rad: Floats, nearest_m: float, farthest_m: float, fans: Any, reach_m: float,
    noise_m: float, device: str = "cpu", threads: int | None = None,
) -> tuple[Any, Any, Any, Any]:  # fmt: skip
    """Compute points, normals, kinds and spreads of scans, (S, B) each, as arrays on the device.

    Readings are (S, B), NaN past a scan's last beam; ascending angles (1, B) for all scans, or (S, B). Readings between
    ``nearest_m`` and ``farthest_m`` are points, with the standard deviation ``noise_m``. ``fans`` is a
    `bayesmap.poses.scan_geometry.Fans`. For ``reach_m`` see `scan_normals`.
    """
    device = devices.resolve(device)
    scans, beams = ranges_m.shape
    points, normals = (wp.empty((scans, beams), dtype=wp.vec2f, device=device) for _ in range(2))
    kind = wp.empty((scans, beams), dtype=wp.uint8, device=device)
    spread = wp.empty((scans, beams), dtype=wp.float32, device=device)
    inputs = [ranges_m, angles_rad, nearest_m, farthest_m, points, kind]
    devices.launch(scan_points, scans, inputs, device, threads)
    inputs = [points, fans.beams, fans.step_rad, fans.full_circle, reach_m, noise_m, kind, normals, spread]
    devices.launch(scan_normals, scans, inputs, device, threads)
    return points, normals, kind, spread


def scan_arrays(geometry: Any, stride: int = 1) -> Any:
    """Return a `bayesmap.poses.scan_geometry.ScanGeometry` as kernels read it; it is packed once for each stride."""
    fans, packed = geometry.fans, geometry.packed
    if stride not in packed:
        packed[stride] = devices.pack(
            ScanArrays, geometry.device, points=geometry.points, normals=geometry.normals, kind=geometry.kind,
            spread=geometry.spread, beam_of_angle=fans.beam_of_angle, layout=fans.layout, beams=fans.beams,
            step=fans.step_rad, full_circle=fans.full_circle, stride=stride,
        )  # fmt: skip
    return packed[stride]


def equal_weights(geometry: Any) -> Any:
    """Return equal weights of all beams, (S, B), on the geometry's device; front ends use them for every scan."""
    if "weights" not in geometry.packed:
        shape = (len(geometry), geometry.beams)
        geometry.packed["weights"] = wp.full(shape, 1.0, dtype=wp.float32, device=geometry.device)
    return geometry.packed["weights"]


def select_rows(array: Any, rows: NDArray[np.intp]) -> Any:
    """Copy rows of an array on a device."""
    return wp.array(np.ascontiguousarray(array.numpy()[rows]), dtype=array.dtype, device=array.device)
