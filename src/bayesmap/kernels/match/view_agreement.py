"""Compare two scans: count points that the other scan sees, and points that stand where the other saw through."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.match.line_pairs import beam_towards, nearest_point
from bayesmap.kernels.match.scan_geometry import ScanArrays, neighbour, scan_arrays, widest_gap
from bayesmap.space.planar import inverse

wp.set_module_options({"enable_backward": False})


@wp.func
def near_wall(scene: ScanArrays, j: int, beam: int, x: float, y: float, near: float) -> int:
    """Return 1 if (x, y) is near the wall between the points of a beam of scan j and the next beam, else 0."""
    beams = scene.beams[j]
    a = beam
    if a < 0:
        if scene.full_circle[j] == 0:
            return 0
        a += beams
    b = neighbour(a, 1, beams, scene.full_circle[j])
    if b < 0:
        return 0
    if scene.kind[j, a] == wp.uint8(0) or scene.kind[j, b] == wp.uint8(0):
        return 0
    p = scene.points[j, a]
    d = scene.points[j, b] - p
    size = wp.length(d)
    if size > widest_gap(scene.step[j], wp.length(p)):
        return 0
    here = wp.vec2f(x, y) - p
    share = wp.clamp(wp.dot(here, d) / wp.max(size * size, 1.0e-9), 0.0, 1.0)
    return wp.where(wp.length(here - share * d) < near, 1, 0)


@wp.kernel
def compare_views(
    first: int,
    scene: ScanArrays,
    source: wp.array(dtype=wp.int32),
    target: wp.array(dtype=wp.int32),
    relative: wp.array(dtype=wp.vec3d),
    near: float,
    clear: float,
    counts: wp.array2d(dtype=wp.int32),
):
    """One thread per pair: count the points of the source on what the target saw, those that contradict it, and all.

    A point contradicts if three neighbouring beams of the target all hit something ``clear`` metres beyond it.
    """
    p = first + wp.tid()
    i = source[p]
    j = target[p]
    z = relative[p]
    cosine = float(wp.cos(z[2]))
    sine = float(wp.sin(z[2]))
    beams = scene.kind.shape[1]
    matched = int(0)
    against = int(0)
    total = int(0)
    b = int(0)
    while b < beams:
        k = b
        b += scene.stride
        if scene.kind[i, k] == wp.uint8(0):
            continue
        total += 1
        q = scene.points[i, k]
        x = cosine * q[0] - sine * q[1] + float(z[0])
        y = sine * q[0] + cosine * q[1] + float(z[1])
        if nearest_point(scene, j, x, y, near) >= 0:
            matched += 1
            continue
        middle = beam_towards(scene, j, x, y)
        if middle < 0:
            continue
        if near_wall(scene, j, middle - 1, x, y, near) + near_wall(scene, j, middle, x, y, near) > 0:
            matched += 1
            continue
        away = wp.sqrt(x * x + y * y)
        through = int(0)
        for d in range(-1, 2):
            c = middle + d
            if scene.full_circle[j] != 0:
                c = (c + scene.beams[j]) % scene.beams[j]
            if c >= 0 and c < scene.beams[j]:
                if scene.kind[j, c] != wp.uint8(0):
                    if wp.length(scene.points[j, c]) > away + clear:
                        through += 1
        if through == 3:
            against += 1
    counts[p, 0] = matched
    counts[p, 1] = against
    counts[p, 2] = total


@dataclass(frozen=True)
class Agreement:
    """When points of one scan count as seen by another, and when as contradicting it.

    Attributes:
        near_m: a point so near one of the other scan, or the wall between two neighbouring ones, is matched.
        clear_m: one that stands so far before what the other saw contradicts.
        beams: about so many of each scan are looked at.
    """

    near_m: float
    clear_m: float
    beams: int


def view_counts(
    geometry: Any,
    source: NDArray[np.int32],
    target: NDArray[np.int32],
    relative: NDArray[np.float64],
    agreement: Agreement,
    threads: int | None = None,
) -> NDArray[np.int32]:
    """Count the points of each source: matched by the target, contradicting it, all; (P, 3).

    ``relative`` are the poses of sources in the frames of targets, (P, 3).
    """
    device, count = geometry.device, len(source)
    counts = wp.empty((count, 3), dtype=wp.int32, device=device)
    stride = max(1, geometry.beams // agreement.beams)
    inputs = [scan_arrays(geometry, stride), devices.to_device(source, wp.int32, device)]
    inputs += [devices.to_device(target, wp.int32, device), devices.to_device(relative, wp.vec3d, device)]
    devices.launch(compare_views, count, [*inputs, agreement.near_m, agreement.clear_m, counts], device, threads)
    return np.asarray(counts.numpy())


def mutual_view_counts(
    geometry: Any,
    first: NDArray[np.int32],
    second: NDArray[np.int32],
    relative: NDArray[np.float64],
    agreement: Agreement,
    threads: int | None = None,
) -> NDArray[np.int32]:
    """Sum `view_counts` of the second scans in the views of the first, and of the first in those of the second, (P, 3).

    ``relative`` are the poses of the second in the frames of the first, (P, 3).
    """
    counts = view_counts(geometry, second, first, relative, agreement, threads)
    return counts + view_counts(geometry, first, second, inverse(relative), agreement, threads)
