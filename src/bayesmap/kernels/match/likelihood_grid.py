"""Draw likelihood grids of scans, and the pyramids of their maxima."""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Floats, Int32s, Ints, Uint8Rows, Vec2ds, Vec3ds
from bayesmap.kernels.match.branch_and_bound import Pyramid
from bayesmap.kernels.match.scan_geometry import ScanArrays, neighbour, scan_arrays, widest_gap

wp.set_module_options({"enable_backward": False})


@wp.kernel
def draw_points(
    first: int, bands: int, offsets: Int32s, scan: Int32s, pose: Vec3ds, scene: ScanArrays, spacing: wp.float32,
    origin: Vec2ds, resolution: wp.float64, stamp: Uint8Rows, pyramid: Pyramid,
):  # fmt: skip
    """One thread per band of a grid: set each cell to the largest of all stamps that cover it. If points of
    neighbouring beams on one surface lie further apart than ``spacing``, stamps are put in between.
    """
    # t: thread; g: grid; e: entry; s: its scan; p: its pose; b, c: neighbouring beams; k: stamp from b towards c.
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
            here = scene.points[s, b]
            to_next = wp.vec2f()
            stamps = int(1)
            c = neighbour(b, 1, scene.beams[s], scene.full_circle[s])
            if c >= 0:
                if scene.kind[s, c] != wp.uint8(0):
                    apart = wp.length(scene.points[s, c] - here)
                    if apart > spacing and apart < widest_gap(scene.step[s], wp.length(here)):
                        stamps = 1 + int(apart / spacing)
                        to_next = (scene.points[s, c] - here) / wp.float32(stamps)
            for k in range(stamps):
                px = wp.float64(here[0] + wp.float32(k) * to_next[0])
                py = wp.float64(here[1] + wp.float32(k) * to_next[1])
                cx = int(wp.floor((p[0] + cosine * px - sine * py - origin[g][0]) / resolution))
                cy = int(wp.floor((p[1] + sine * px + cosine * py - origin[g][1]) / resolution))
                if cy < -radius or cy >= ny + radius:
                    continue
                # A cell with the peak's value is the middle of a stamp that was drawn before.
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
    and its pose each. ``stamp``, an odd square, is drawn around each point; stamps of a wall lie at most ``spacing_m``
    apart. ``pyramid`` is an array to write into, if any.
    """
    grids, device = len(offsets) - 1, geometry.device
    if pyramid is None:
        pyramid = wp.empty((grids, levels, *shape), dtype=wp.uint8, device=device)
    bands = 1 if device == "cpu" else 64
    inputs = [bands, offsets, scan, poses_world, scan_arrays(geometry), spacing_m, origins, resolution, stamp, pyramid]
    if device == "cpu":
        host = pyramid.numpy()
        host[:, 0] = 0
        devices.launch(draw_points, grids * bands, inputs, device, threads)
        for level in range(1, levels):
            widen(host[:, level - 1], host[:, level], 1 << (level - 1))
        return pyramid
    wp.copy(pyramid, wp.zeros(shape=pyramid.shape, dtype=wp.uint8, device=device))
    devices.launch(draw_points, grids * bands, inputs, device, threads)
    for level in range(1, levels):
        devices.launch(next_level, grids * shape[0], [level, pyramid], device, threads)
    return pyramid


def widen(narrow: NDArray[np.uint8], wide: NDArray[np.uint8], half: int) -> None:
    """Compute `next_level` ten times as fast on the CPU: NumPy takes maxima of 32 bytes at once."""
    for grid, out in zip(narrow, wide, strict=True):
        along = np.empty_like(out)
        np.maximum(grid[:-half], grid[half:], out=along[:-half])
        np.maximum(grid[-half:], grid[-1], out=along[-half:])
        np.maximum(along[:, :-half], along[:, half:], out=out[:, :-half])
        np.maximum(along[:, -half:], along[:, -1:], out=out[:, -half:])
