"""Render likelihood grids of scans with pyramids of their maxima, and likelihood fields of a map's surfaces."""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float32s, Floats, Int32s, Ints, Singles, Uint8Rows, Vec2ds, Vec3ds
from bayesmap.kernels.match.branch_and_bound import Pyramid
from bayesmap.kernels.match.scan_geometry import ScanArrays, max_gap, neighbour, scan_arrays
from bayesmap.space.grid import Grid

wp.set_module_options({"enable_backward": False})


@wp.kernel
def stamp_points(
    first: int, bands: int, offsets: Int32s, scan: Int32s, pose: Vec3ds, scene: ScanArrays, spacing: wp.float32,
    origin: Vec2ds, resolution: wp.float64, stamp: Uint8Rows, pyramid: Pyramid,
):  # fmt: skip
    """One thread per band of a grid: set each cell to the largest of all stamps that cover it."""
    # t: thread; g: grid; e: entry; s: its scan; p: its pose; b, c: neighbouring beams; k: stamp from b towards c, of
    # which there are several if points on one surface lie further apart than ``spacing``.
    t = first + wp.tid()
    g = t / bands
    band = t - g * bands
    nx = pyramid.shape[2]
    ny = pyramid.shape[3]
    low = nx * band / bands
    high = nx * (band + 1) / bands
    radius = stamp.shape[0] / 2
    peak = stamp[radius, radius]
    unique = stamp[radius, radius + 1] < peak
    for e in range(offsets[g], offsets[g + 1]):
        s = scan[e]
        p = pose[e]
        cosine = wp.cos(p[2])
        sine = wp.sin(p[2])
        for b in range(scene.points.shape[1]):
            if scene.kind[s, b] == wp.uint8(0):
                continue
            point = scene.points[s, b]
            to_next = wp.vec2f()
            stamps = int(1)
            c = neighbour(b, 1, scene.beams[s], scene.full_circle[s])
            if c >= 0:
                if scene.kind[s, c] != wp.uint8(0):
                    apart = wp.length(scene.points[s, c] - point)
                    if apart > spacing and apart < max_gap(scene.step[s], wp.length(point)):
                        stamps = 1 + int(apart / spacing)
                        to_next = (scene.points[s, c] - point) / wp.float32(stamps)
            for k in range(stamps):
                px = wp.float64(point[0] + wp.float32(k) * to_next[0])
                py = wp.float64(point[1] + wp.float32(k) * to_next[1])
                cx = int(wp.floor((p[0] + cosine * px - sine * py - origin[g][0]) / resolution))
                cy = int(wp.floor((p[1] + sine * px + cosine * py - origin[g][1]) / resolution))
                if cy < -radius or cy >= ny + radius:
                    continue
                # A cell with the peak's value is the middle of an earlier stamp.
                if unique and cx >= low and cx < high and cy >= 0 and cy < ny:
                    if pyramid[g, 0, cx, cy] == peak:
                        continue
                for x in range(wp.max(cx - radius, low), wp.min(cx + radius + 1, high)):
                    for y in range(wp.max(cy - radius, 0), wp.min(cy + radius + 1, ny)):
                        value = stamp[x - cx + radius, y - cy + radius]
                        if value > pyramid[g, 0, x, y]:
                            pyramid[g, 0, x, y] = value


@wp.kernel
def next_level(first: int, level: int, pyramid: Pyramid):
    """One thread per row: compute maxima over blocks of 2^level cells, from maxima over blocks half as long."""
    t = first + wp.tid()
    nx = pyramid.shape[2]
    ny = pyramid.shape[3]
    g = t / nx
    x = t - g * nx
    half = 1 << (level - 1)
    x2 = wp.min(x + half, nx - 1)
    for y in range(ny):
        y2 = wp.min(y + half, ny - 1)
        low = wp.max(pyramid[g, level - 1, x, y], pyramid[g, level - 1, x2, y])
        high = wp.max(pyramid[g, level - 1, x, y2], pyramid[g, level - 1, x2, y2])
        pyramid[g, level, x, y] = wp.max(low, high)


def render_grids(
    geometry: Any, offsets: Ints, scan: Ints, poses_world: Floats, origins: Floats, resolution: float,
    stamp: NDArray[np.uint8], spacing_m: float, shape: tuple[int, int], levels: int, threads: int | None = None,
    pyramid: Any = None,
) -> Any:  # fmt: skip
    """Render grids of scans at poses, with their pyramids: (grids, levels, nx, ny) on the device.

    Grid g, with its corner at ``origins[g]``, contains the entries offsets[g] .. offsets[g + 1]: a scan of ``geometry``
    and its pose each. ``stamp``, an odd square, is put around each point; stamps of a wall lie at most ``spacing_m``
    apart. ``pyramid`` is an array to write into, if any.
    """
    grids, device = len(offsets) - 1, geometry.device
    if pyramid is None:
        pyramid = wp.empty((grids, levels, *shape), dtype=wp.uint8, device=device)
    if device == "cpu":
        pyramid.numpy()[:, 0] = 0
    else:
        pyramid.zero_()
    bands = 1 if device == "cpu" else 64
    inputs = [bands, offsets, scan, poses_world, scan_arrays(geometry), spacing_m, origins, resolution, stamp, pyramid]
    devices.launch(stamp_points, grids * bands, inputs, device, threads)
    for level in range(1, levels):
        if device == "cpu":
            widen(pyramid.numpy()[:, level - 1], pyramid.numpy()[:, level], 1 << (level - 1))
        else:
            devices.launch(next_level, grids * shape[0], [level, pyramid], device, threads)
    return pyramid


def widen(narrow: NDArray[np.uint8], wide: NDArray[np.uint8], half: int) -> None:
    """Compute `next_level` ten times as fast on the CPU: NumPy takes maxima of 32 bytes at once."""
    for grid, out in zip(narrow, wide, strict=True):
        in_x = np.empty_like(out)
        np.maximum(grid[:-half], grid[half:], out=in_x[:-half])
        np.maximum(grid[-half:], grid[-1], out=in_x[-half:])
        np.maximum(in_x[:, :-half], in_x[:, half:], out=out[:, :-half])
        np.maximum(in_x[:, -half:], in_x[:, -1:], out=out[:, -half:])


@wp.kernel
def sum_field(first: int, field: Uint8Rows, points: Float32Rows, poses: Float32Rows, out: Int32s):
    """One thread per pose, in cells from the grid's corner: sum the field's values at the points."""
    p = first + wp.tid()
    c = wp.cos(poses[p, 2])
    s = wp.sin(poses[p, 2])
    x = poses[p, 0]
    y = poses[p, 1]
    total = int(0)
    for k in range(points.shape[0]):
        i = int(wp.floor(c * points[k, 0] - s * points[k, 1] + x))
        j = int(wp.floor(s * points[k, 0] + c * points[k, 1] + y))
        if i >= 0 and j >= 0 and i < field.shape[0] and j < field.shape[1]:
            total += int(field[i, j])
    out[p] = total


def field_sums(field: NDArray[np.uint8], grid: Grid, points: Floats, poses: Floats) -> Ints:
    """Sum the values of a field (nx, ny) at the points of a scan at each pose, (P,); outside the field they are 0.
    Points are in the sensor's frame, metres, (N, 2); poses in the world frame, (P, 3).
    """
    devices.start()
    poses_cells = np.column_stack([grid.to_cells(poses[:, :2]), poses[:, 2]])
    inputs = [field, points / grid.resolution, poses_cells, (len(poses),)]
    return np.asarray(devices.launch(sum_field, len(poses), inputs, "cpu", 1)[0])


REACH_SIGMAS = wp.constant(wp.float32(3.0))  # standard deviations from a surface past which its density is left out


@wp.kernel
def render_surfaces(first: int, mean: Float32Rows, covariance: Float32Rows, strength: Float32s, out: Float32Rows):
    """One thread per surface, in fine cells from the grid's corner: raise the cells around it to its own density."""
    k = first + wp.tid()
    xx = covariance[k, 0]
    xy = covariance[k, 1]
    yy = covariance[k, 2]
    determinant = xx * yy - xy * xy
    reach_x = REACH_SIGMAS * wp.sqrt(xx)
    reach_y = REACH_SIGMAS * wp.sqrt(yy)
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
    ``means`` are in cells from the corner, (K, 2), ``covariances`` xx, xy, yy in squared cells, (K, 3), ``strengths``.
    """
    devices.start()
    return np.asarray(devices.launch(render_surfaces, len(means), [means, covariances, strengths, shape], "cpu", 1)[0])
