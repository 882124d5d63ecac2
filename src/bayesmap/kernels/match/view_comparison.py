"""Compare the views of two scans: count the points of one that match the other, or contradict it."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Floats, Int32Rows, Int32s, Ints, Vec3ds
from bayesmap.kernels.match import scan_geometry as scenes
from bayesmap.kernels.match.line_pairs import beam_towards, nearest_point, rotation_of
from bayesmap.kernels.match.scan_geometry import ScanArrays, max_gap, neighbour, scan_arrays
from bayesmap.space.planar import inverse

wp.set_module_options({"enable_backward": False})


@wp.func
def is_near_wall(scans: ScanArrays, scan: int, beam: int, point: wp.vec2f, near_m: float) -> int:
    """Return 1 if a point is near the wall between the points of a beam and the next beam, else 0."""
    beams = scans.beams[scan]
    start = beam
    if start < 0:
        if scans.full_circle[scan] == 0:
            return 0
        start += beams
    end = neighbour(start, 1, beams, scans.full_circle[scan])
    if end < 0:
        return 0
    if scans.kind[scan, start] == scenes.NO_POINT or scans.kind[scan, end] == scenes.NO_POINT:
        return 0
    start_point = scans.points[scan, start]
    wall = scans.points[scan, end] - start_point
    length = wp.length(wall)
    if length > max_gap(scans.step[scan], wp.length(start_point)):
        return 0
    to_point = point - start_point
    share = wp.clamp(wp.dot(to_point, wall) / wp.max(length * length, 1.0e-9), 0.0, 1.0)
    return wp.where(wp.length(to_point - share * wall) < near_m, 1, 0)


@wp.kernel
def compare_views(
    first: int, scans: ScanArrays, source: Int32s, target: Int32s, relative: Vec3ds, near_m: float, clear_m: float,
    counts: Int32Rows,
):  # fmt: skip
    """One thread per pair: count the points of the source that match the target, that contradict it, and all points."""
    # A point contradicts the target if three neighbouring beams of it all hit something ``clear_m`` beyond the point.
    pair = first + wp.tid()
    other = target[pair]
    turn = rotation_of(relative[pair])
    shift = wp.vec2f(float(relative[pair][0]), float(relative[pair][1]))
    matched, contradicting, total = int(0), int(0), int(0)
    for beam in range(0, scans.kind.shape[1], scans.stride):
        if scans.kind[source[pair], beam] == scenes.NO_POINT:
            continue
        total += 1
        point = turn * scans.points[source[pair], beam] + shift
        # A match: near a point, or near the wall between two points.
        if nearest_point(scans, other, point, near_m) >= 0:
            matched += 1
            continue
        middle = beam_towards(scans, other, point)
        if middle < 0:
            continue
        near_walls = is_near_wall(scans, other, middle - 1, point, near_m)
        near_walls += is_near_wall(scans, other, middle, point, near_m)
        if near_walls > 0:
            matched += 1
            continue
        # A contradiction: the beams about the point pass through it.
        beyond = wp.length(point) + clear_m
        through = int(0)
        for step in range(-1, 2):
            nearby = neighbour(middle, step, scans.beams[other], scans.full_circle[other])
            if nearby >= 0:
                if scans.kind[other, nearby] != scenes.NO_POINT and wp.length(scans.points[other, nearby]) > beyond:
                    through += 1
        if through == 3:
            contradicting += 1
    counts[pair, 0] = matched
    counts[pair, 1] = contradicting
    counts[pair, 2] = total


@dataclass(frozen=True)
class Agreement:
    """Rules for points of one scan that match another scan, or contradict it."""

    near_m: float  # distance to a point of the other scan, or to the wall between two neighbouring points, of a match
    clear_m: float  # least distance of a contradicting point before the points that the other scan hit
    beams: int  # number of beams of each scan that are compared, about


def view_counts(
    geometry: Any, source: Ints, target: Ints, relative: Floats, agreement: Agreement, threads: int | None = None
) -> Ints:
    """Count each source's points that match, that contradict, and all, (P, 3); ``relative`` poses: in target frames."""
    scans, pairs = scan_arrays(geometry, max(1, geometry.beams // agreement.beams)), len(source)
    inputs = [scans, source, target, relative, agreement.near_m, agreement.clear_m, (pairs, 3)]
    return np.asarray(devices.launch(compare_views, pairs, inputs, geometry.device, threads)[0])


def mutual_view_counts(
    geometry: Any, first: Ints, second: Ints, relative: Floats, agreement: Agreement, threads: int | None = None
) -> Ints:
    """Sum `view_counts` in both directions, (P, 3); ``relative`` are the poses of the second in the first's frame."""
    counts = view_counts(geometry, second, first, relative, agreement, threads)
    return counts + view_counts(geometry, first, second, inverse(relative), agreement, threads)
