"""Render likelihood grids of scans with pyramids of their maxima, and likelihood fields of a map's surfaces.

`render_grids` puts a stamp around each point of each grid's scans: a cell has the largest value of the stamps that
cover it. Branch and bound searches these grids (`bayesmap.poses.matcher`). `render_field` and `field_sums` are for
localization: they render a map's surfaces, and look up the points of a scan at many poses.
"""

from typing import Any, NamedTuple

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float32s, Floats, Int32s, Ints, Singles, Uint8Rows, Vec2ds, Vec3ds
from bayesmap.kernels.match.branch_and_bound import Pyramid
from bayesmap.kernels.match.scan_geometry import NO_POINT, ScanArrays, max_gap, neighbour, scan_arrays
from bayesmap.space.grid import Grid

wp.set_module_options({"enable_backward": False})
MAX_SIGMAS = wp.constant(wp.float32(3.0))  # standard deviations from a surface past which its density is left out


class GridScans(NamedTuple):
    """Likelihood grids and their scans: grid g contains the entries offsets[g] to offsets[g + 1]."""

    origins: Floats  # corner of each grid, metres, (grids, 2)
    resolution: float  # edge of a cell, metres
    offsets: Ints
    scan: Ints  # the scan of each entry
    poses: Floats  # the scan's pose in the grids' frame, (entries, 3)
    stamp: NDArray[np.uint8]  # values around a point, an odd square
    spacing_m: float  # largest distance between the stamps of one wall


GridScansArrays = devices.struct_like(GridScans, Vec2ds, wp.float64, Int32s, Int32s, Vec3ds, Uint8Rows, wp.float32)


@wp.kernel
def stamp_points(first: int, bands: int, grids: GridScansArrays, scans: ScanArrays, pyramid: Pyramid):
    """One thread per band of a grid: set each cell to the largest of all stamps that cover it."""
    # If the points of neighbouring beams lie further apart on one surface than ``spacing_m``, there are several stamps
    # from the beam towards the next.
    thread = first + wp.tid()
    grid = thread / bands
    band = thread - grid * bands
    nx, ny = pyramid.shape[2], pyramid.shape[3]
    low = nx * band / bands
    high = nx * (band + 1) / bands
    radius = grids.stamp.shape[0] / 2
    peak = grids.stamp[radius, radius]
    peak_is_unique = grids.stamp[radius, radius + 1] < peak
    for entry in range(grids.offsets[grid], grids.offsets[grid + 1]):
        scan = grids.scan[entry]
        pose = grids.poses[entry]
        cosine, sine = wp.cos(pose[2]), wp.sin(pose[2])
        for beam in range(scans.points.shape[1]):
            if scans.kind[scan, beam] == NO_POINT:
                continue
            # Stamps from this point towards the next, if both lie on one surface.
            point = scans.points[scan, beam]
            to_next = wp.vec2f()
            stamps = int(1)
            next_beam = neighbour(beam, 1, scans.beams[scan], scans.full_circle[scan])
            if next_beam >= 0:
                if scans.kind[scan, next_beam] != NO_POINT:
                    apart = wp.length(scans.points[scan, next_beam] - point)
                    if apart > grids.spacing_m and apart < max_gap(scans.step[scan], wp.length(point)):
                        stamps = 1 + int(apart / grids.spacing_m)
                        to_next = (scans.points[scan, next_beam] - point) / wp.float32(stamps)
            for k in range(stamps):
                # The cell of the stamp's middle.
                px = wp.float64(point[0] + wp.float32(k) * to_next[0])
                py = wp.float64(point[1] + wp.float32(k) * to_next[1])
                cx = int(wp.floor((pose[0] + cosine * px - sine * py - grids.origins[grid][0]) / grids.resolution))
                cy = int(wp.floor((pose[1] + sine * px + cosine * py - grids.origins[grid][1]) / grids.resolution))
                if cy < -radius or cy >= ny + radius:
                    continue
                # A cell with the peak's value is the middle of an earlier stamp.
                if peak_is_unique and cx >= low and cx < high and cy >= 0 and cy < ny:
                    if pyramid[grid, 0, cx, cy] == peak:
                        continue
                for x in range(wp.max(cx - radius, low), wp.min(cx + radius + 1, high)):
                    for y in range(wp.max(cy - radius, 0), wp.min(cy + radius + 1, ny)):
                        value = grids.stamp[x - cx + radius, y - cy + radius]
                        if value > pyramid[grid, 0, x, y]:
                            pyramid[grid, 0, x, y] = value


@wp.kernel
def next_level(first: int, level: int, pyramid: Pyramid):
    """One thread per row: compute maxima over blocks of 2^level cells, from maxima over blocks half as long."""
    thread = first + wp.tid()
    nx, ny = pyramid.shape[2], pyramid.shape[3]
    grid = thread / nx
    x = thread - grid * nx
    half = 1 << (level - 1)
    x2 = wp.min(x + half, nx - 1)
    for y in range(ny):
        y2 = wp.min(y + half, ny - 1)
        low = wp.max(pyramid[grid, level - 1, x, y], pyramid[grid, level - 1, x2, y])
        high = wp.max(pyramid[grid, level - 1, x, y2], pyramid[grid, level - 1, x2, y2])
        pyramid[grid, level, x, y] = wp.max(low, high)


def render_grids(
    geometry: Any, grids: GridScans, shape: tuple[int, int], levels: int, threads: int | None = None,
    pyramid: Any = None,  # memory to use, if any
) -> Any:  # fmt: skip
    """Render grids of the `ScanArrays` of ``geometry`` with their pyramids, (grids, levels, nx, ny), on the device."""
    count, device = len(grids.origins), geometry.device
    if pyramid is None:
        pyramid = wp.empty((count, levels, *shape), dtype=wp.uint8, device=device)
    if device == "cpu":
        pyramid.numpy()[:, 0] = 0
    else:
        pyramid.zero_()
    bands = 1 if device == "cpu" else 64  # one for each thread
    inputs = [bands, devices.pack(GridScansArrays, device, **grids._asdict()), scan_arrays(geometry), pyramid]
    devices.launch(stamp_points, count * bands, inputs, device, threads)
    for level in range(1, levels):
        if device == "cpu":
            next_level_on_cpu(pyramid.numpy()[:, level - 1], pyramid.numpy()[:, level], 1 << (level - 1))
        else:
            devices.launch(next_level, count * shape[0], [level, pyramid], device, threads)
    return pyramid


def next_level_on_cpu(narrow: NDArray[np.uint8], wide: NDArray[np.uint8], half: int) -> None:
    """Compute `next_level` ten times as fast on the CPU: NumPy takes maxima of 32 bytes at once."""
    for grid, out in zip(narrow, wide, strict=True):
        in_x = np.empty_like(out)
        np.maximum(grid[:-half], grid[half:], out=in_x[:-half])
        np.maximum(grid[-half:], grid[-1], out=in_x[-half:])
        np.maximum(in_x[:, :-half], in_x[:, half:], out=out[:, :-half])
        np.maximum(in_x[:, -half:], in_x[:, -1:], out=out[:, -half:])


@wp.kernel
def sum_at_poses(first: int, field: Uint8Rows, points: Float32Rows, poses: Float32Rows, out: Int32s):
    """One thread per pose, in cells from the grid's corner: sum the field's values at the points."""
    pose = first + wp.tid()
    cosine, sine = wp.cos(poses[pose, 2]), wp.sin(poses[pose, 2])
    x, y = poses[pose, 0], poses[pose, 1]
    total = int(0)
    for k in range(points.shape[0]):
        i = int(wp.floor(cosine * points[k, 0] - sine * points[k, 1] + x))
        j = int(wp.floor(sine * points[k, 0] + cosine * points[k, 1] + y))
        if i >= 0 and j >= 0 and i < field.shape[0] and j < field.shape[1]:
            total += int(field[i, j])
    out[pose] = total


def field_sums(field: NDArray[np.uint8], grid: Grid, points: Floats, poses: Floats) -> Ints:
    """Sum the values of a field, (nx, ny), 0 outside, at points, (N, 2), metres, of a scan at world poses, (P, 3)."""
    devices.start()
    poses_cells = np.column_stack([grid.to_cells(poses[:, :2]), poses[:, 2]])
    inputs = [field, points / grid.resolution, poses_cells, (len(poses),)]
    return np.asarray(devices.launch(sum_at_poses, len(poses), inputs, "cpu", 1)[0])


@wp.kernel
def stamp_surfaces(first: int, mean: Float32Rows, covariance: Float32Rows, strength: Float32s, out: Float32Rows):
    """One thread per surface, in fine cells from the grid's corner: raise the cells around it to its own density."""
    k = first + wp.tid()
    xx = covariance[k, 0]
    xy = covariance[k, 1]
    yy = covariance[k, 2]
    determinant = xx * yy - xy * xy
    reach_x, reach_y = MAX_SIGMAS * wp.sqrt(xx), MAX_SIGMAS * wp.sqrt(yy)
    i_from = wp.max(0, int(wp.floor(mean[k, 0] - reach_x)))
    i_to = wp.min(out.shape[0] - 1, int(wp.floor(mean[k, 0] + reach_x)))
    j_from = wp.max(0, int(wp.floor(mean[k, 1] - reach_y)))
    j_to = wp.min(out.shape[1] - 1, int(wp.floor(mean[k, 1] + reach_y)))
    for i in range(i_from, i_to + 1):
        x = wp.float32(i) + wp.float32(0.5) - mean[k, 0]
        for j in range(j_from, j_to + 1):
            y = wp.float32(j) + wp.float32(0.5) - mean[k, 1]
            distance_sq = (yy * x * x - wp.float32(2.0) * xy * x * y + xx * y * y) / determinant
            wp.atomic_max(out, i, j, strength[k] * wp.exp(-wp.float32(0.5) * distance_sq))


def render_field(means: Floats, covariances: Floats, strengths: Floats, shape: tuple[int, int]) -> Singles:
    """Return the largest of s exp(-d^2 / 2) over all surfaces, d the Mahalanobis distance from the mean, (nx, ny).
    ``means`` (K, 2) are in cells from the corner, ``covariances`` (K, 3) are xx, xy, yy, ``strengths`` are s, (K,).
    """
    devices.start()
    return np.asarray(devices.launch(stamp_surfaces, len(means), [means, covariances, strengths, shape], "cpu", 1)[0])
