"""Match points to likelihood grids by branch and bound (correlative scan matching).

Algorithm 3 of Hess, Kohler, Rapp and Andor (2016), "Real-time loop closure in 2D LIDAR SLAM". A node is a block of 2^h
x 2^h translations at one angle; level h of the pyramid bounds their scores. The search is exact. Among equal scores it
returns the first in the order of angle, x and y, for any number of threads.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float64Rows, Float64s, Floats, Int32s, Ints, Vec2ds

wp.set_module_options({"enable_backward": False})

FEW_POINTS = 100_000  # fewer points, at all angles of all jobs, are looked up before a second thread has started

Pyramid = wp.array4d(dtype=wp.uint8)  # likelihood grids with their maxima over blocks: (grids, levels, nx, ny)


@wp.struct
class SearchJobs:
    """Jobs on a device: job j has the points ``point_begin[j]:point_end[j]``, and rows of angles of its own."""

    point_begin: Int32s
    point_end: Int32s
    grid: Int32s
    half_x: Int32s  # the window's half width, cells
    half_y: Int32s
    least: Float64s  # scores must exceed this
    off_centre_cost: Float64s  # cost of a squared cell off the centre, in units of the score
    row_cost: Float64s  # cost of each angle
    cells: wp.array2d(dtype=wp.vec2i)  # cells of each row's points, with the sensor at the window's centre


@wp.struct
class Roots:
    """The largest blocks of all jobs: job j has ``order[begin[j]:begin[j + 1]]``, best bound first."""

    begin: Int32s
    order: Int32s
    bound: Float64s
    node: wp.array(dtype=wp.vec3i)  # row, dx, dy


@wp.struct
class EarlierModes:
    """The earlier poses of each job, (J, modes), as (row, dx, dy), and how far a further mode must lie from them."""

    node: wp.array2d(dtype=wp.vec3i)
    apart: wp.vec3i
    count: int


@wp.struct
class Stack:
    """Blocks that each strand has still to search, the best on top."""

    bound: Float64Rows
    node: wp.array2d(dtype=wp.vec4i)  # level, dx, dy, unused


@wp.struct
class Best:
    """The best poses so far."""

    incumbent: Float64s  # best score of each job
    score: Float64s  # best score of each strand
    node: wp.array(dtype=wp.vec3i)  # its row, dx, dy; row -1 if there is none


@wp.func
def block_score(jobs: SearchJobs, pyramid: Pyramid, j: int, row: int, level: int, dx: int, dy: int) -> int:
    """Sum, over the points of a job, the largest value in the block of shifts (dx, dy) .. + 2^level - 1."""
    grid = jobs.grid[j]
    nx = pyramid.shape[2]
    ny = pyramid.shape[3]
    width = 1 << level
    total = int(0)
    for k in range(jobs.point_end[j] - jobs.point_begin[j]):
        c = jobs.cells[row, k]
        x = c[0] + dx
        y = c[1] + dy
        if x < nx and y < ny and x > -width and y > -width:
            total += int(pyramid[grid, level, wp.max(x, 0), wp.max(y, 0)])
    return total


@wp.func
def least_offset_sq(offset: int, width: int) -> wp.float64:
    """Return the least squared distance from 0 within offset .. offset + width - 1."""
    last = offset + width - 1
    if offset <= 0 and last >= 0:
        return wp.float64(0.0)
    least = wp.float64(wp.min(wp.abs(offset), wp.abs(last)))
    return least * least


@wp.func
def block_bound(jobs: SearchJobs, pyramid: Pyramid, j: int, row: int, level: int, dx: int, dy: int) -> wp.float64:
    """Return the bound of the scores in a block, less the cost of its angle and of its distance from the centre."""
    points = jobs.point_end[j] - jobs.point_begin[j]
    scale = wp.float64(1.0) / (wp.float64(255.0) * wp.float64(wp.max(points, 1)))
    width = 1 << level
    offset_cost = jobs.off_centre_cost[j] * (least_offset_sq(dx, width) + least_offset_sq(dy, width))
    return wp.float64(block_score(jobs, pyramid, j, row, level, dx, dy)) * scale - (jobs.row_cost[row] + offset_cost)


@wp.kernel
def bound_blocks(
    first: int, jobs: SearchJobs, job_of_row: Int32s, angle: Float64s, centre: Vec2ds, origin: Vec2ds,
    resolution: wp.float64, points: Vec2ds, node_begin: Int32s, pyramid: Pyramid, roots: Roots,
):  # fmt: skip
    """One thread per angle of a job: compute the cells of its points, and bound the scores of the largest blocks."""
    # row: angle; j: job; k: point; n: node. Cells are computed with the sensor at the window's centre.
    row = first + wp.tid()
    j = job_of_row[row]
    corner = origin[jobs.grid[j]]
    cosine = wp.cos(angle[row])
    sine = wp.sin(angle[row])
    x0 = centre[j][0] - corner[0]
    y0 = centre[j][1] - corner[1]
    for k in range(jobs.point_end[j] - jobs.point_begin[j]):
        p = points[jobs.point_begin[j] + k]
        x = int(wp.floor((x0 + cosine * p[0] - sine * p[1]) / resolution))
        y = int(wp.floor((y0 + sine * p[0] + cosine * p[1]) / resolution))
        jobs.cells[row, k] = wp.vec2i(x, y)
    level = pyramid.shape[1] - 1
    width = 1 << level
    n = node_begin[row]
    dx = -jobs.half_x[j]
    while dx <= jobs.half_x[j]:
        dy = -jobs.half_y[j]
        while dy <= jobs.half_y[j]:
            roots.bound[n] = block_bound(jobs, pyramid, j, row, level, dx, dy)
            roots.node[n] = wp.vec3i(row, dx, dy)
            n += 1
            dy += width
        dx += width


@wp.func
def is_near_earlier(earlier: EarlierModes, j: int, row: int, dx: int, dy: int, width: int) -> bool:
    """Return whether a whole block lies within ``earlier.apart`` of an earlier pose."""
    apart = earlier.apart
    for m in range(earlier.count):
        t = earlier.node[j, m]
        if wp.abs(row - t[0]) <= apart[0]:
            if dx >= t[1] - apart[1] and dx + width - 1 <= t[1] + apart[1]:
                if dy >= t[2] - apart[2] and dy + width - 1 <= t[2] + apart[2]:
                    return True
    return False


@wp.kernel
def search_blocks(
    first: int, strands: int, jobs: SearchJobs, roots: Roots, pyramid: Pyramid, earlier: EarlierModes, stack: Stack,
    best: Best,
):  # fmt: skip
    """One thread per strand of a job: search every ``strands``-th of its largest blocks, best bound first."""
    # t: strand; j: job; q: position in the order of blocks; mine, winner: best of the strand; depth: size of its stack.
    # Strands share the best score of the job. An outdated value costs time, but does not change the result.
    t = first + wp.tid()
    j = t / strands
    mine = wp.float64(jobs.least[j])
    winner = wp.vec3i(-1, 0, 0)
    q = roots.begin[j] + t - j * strands
    while q < roots.begin[j + 1]:
        start = roots.order[q]
        q += strands
        if roots.bound[start] < wp.max(mine, best.incumbent[j]) or roots.bound[start] <= jobs.least[j]:
            break
        row = roots.node[start][0]
        stack.bound[t, 0] = roots.bound[start]
        stack.node[t, 0] = wp.vec4i(pyramid.shape[1] - 1, roots.node[start][1], roots.node[start][2], 0)
        depth = int(1)
        while depth > 0:
            depth -= 1
            limit = wp.max(mine, best.incumbent[j])
            value = stack.bound[t, depth]
            if value < limit or value <= jobs.least[j]:
                continue
            level = stack.node[t, depth][0]
            x0 = stack.node[t, depth][1]
            y0 = stack.node[t, depth][2]
            # A single translation: keep it if it is better, or equal and earlier in the order.
            if level == 0:
                better = value > mine
                if value == mine and winner[0] >= 0:
                    if row < winner[0]:
                        better = True
                    if row == winner[0]:
                        better = x0 < winner[1] or (x0 == winner[1] and y0 < winner[2])
                if better:
                    mine = value
                    winner = wp.vec3i(row, x0, y0)
                    if value > best.incumbent[j]:
                        best.incumbent[j] = value
                continue
            # Push the four halves of the block that can still win.
            half = 1 << (level - 1)
            base = depth
            for child in range(4):
                dx = x0 + half * (child / 2)
                dy = y0 + half * (child % 2)
                if dx > jobs.half_x[j] or dy > jobs.half_y[j]:
                    continue
                if is_near_earlier(earlier, j, row, dx, dy, half):
                    continue
                score = block_bound(jobs, pyramid, j, row, level - 1, dx, dy)
                if score < limit or score <= jobs.least[j]:
                    continue
                z = depth  # children in ascending order, so that the best is on top
                while z > base and stack.bound[t, wp.max(z - 1, 0)] > score:
                    stack.bound[t, z] = stack.bound[t, z - 1]
                    stack.node[t, z] = stack.node[t, z - 1]
                    z -= 1
                stack.bound[t, z] = score
                stack.node[t, z] = wp.vec4i(level - 1, dx, dy, 0)
                depth += 1
    best.score[t] = mine
    best.node[t] = winner


@dataclass(frozen=True, eq=False)
class Windows:
    """The searches of J jobs: their points, and the translations and angles to try."""

    points: Floats  # all jobs' points one after the other, in the sensor's frame, (N, 2)
    point_offsets: Ints  # job j has the points from point_offsets[j] to point_offsets[j + 1]
    grid: Ints  # index of the grid that each job searches, (J,)
    centres: Floats  # x and y of the middle of each window, (J, 2)
    half_cells: Ints  # half widths of the windows, in cells, (J, 2)
    angles_rad: Floats  # angles of all rows
    angle_costs: Floats  # cost of each angle, in units of the score
    row_offsets: Ints  # job j has the rows from row_offsets[j] to row_offsets[j + 1]
    least: Floats  # bound that scores must exceed, (J,)
    off_centre_costs: Floats  # cost of a squared cell off the centre, in units of the score, (J,)


@dataclass(frozen=True)
class Modes:
    """The number of poses searched in each job, and what makes a further pose another mode."""

    count: int
    share: float  # a further pose must exceed this share of the first pose's score
    apart: tuple[int, int, int]  # and differ from earlier poses by more than these rows, cells in x, or cells in y


def search_grids(
    grids: Any, windows: Windows, modes: Modes, strands: int, threads: int | None = None
) -> tuple[Floats, NDArray[np.int64]]:
    """Find the best poses of each job: scores (J, modes), -inf where there is none, and (row, dx, dy), (J, modes, 3).
    ``grids`` are `bayesmap.poses.matcher.LikelihoodGrids`; ``strands`` threads share a job.
    """
    pyramid, device = grids.pyramid, grids.device
    n_jobs, n_strands = len(windows.grid), len(windows.grid) * strands
    n_look_ups = len(windows.angles_rad) * len(windows.points) / max(n_jobs, 1)
    threads = 1 if n_look_ups < FEW_POINTS else threads
    jobs, roots = _bound_roots(grids, windows, threads)
    deepest = 4 * pyramid.shape[1] + 4  # four children a level
    earlier = devices.pack(EarlierModes, device, apart=wp.vec3i(*modes.apart))
    stack = devices.pack(Stack, device, bound=(n_strands, deepest), node=(n_strands, deepest))
    best = devices.pack(Best, device, score=(n_strands,), node=(n_strands,))
    least = windows.least
    scores = np.full((n_jobs, modes.count), -np.inf)
    nodes = np.zeros((n_jobs, modes.count, 3), dtype=np.int64)
    nodes[..., 0] = -1
    for mode in range(modes.count):
        if mode > 0:  # without a first pose there are no further ones
            least = np.where(np.isfinite(scores[:, 0]), np.maximum(least, modes.share * scores[:, 0]), np.inf)
        jobs.least = devices.to_device(least, wp.float64, device)
        earlier_nodes = np.where(nodes[..., :1] >= 0, nodes, -(1 << 28)).astype(np.int32)
        earlier.node, earlier.count = devices.to_device(earlier_nodes, wp.vec3i, device), mode
        best.incumbent = devices.to_device(least.copy(), wp.float64, device)
        devices.launch(search_blocks, n_strands, [strands, jobs, roots, pyramid, earlier, stack, best], device, threads)
        # Take the best of each job's strands, among equal scores the first by angle, x and y.
        node = best.node.numpy().reshape(n_jobs, strands, 3)
        score = np.where(node[..., 0] >= 0, best.score.numpy().reshape(n_jobs, strands), -np.inf)
        winner = np.arange(n_jobs), np.lexsort((node[..., 2], node[..., 1], node[..., 0], -score))[:, 0]
        scores[:, mode], nodes[:, mode] = score[winner], node[winner]
    return scores, nodes


def _bound_roots(grids: Any, windows: Windows, threads: int | None) -> tuple[Any, Any]:
    """Put the jobs on the device, and their largest blocks with their bounds."""
    pyramid, device = grids.pyramid, grids.device
    count, rows = len(windows.grid), len(windows.angles_rad)
    width = 1 << (pyramid.shape[1] - 1)
    half_x, half_y = np.ascontiguousarray(windows.half_cells.T)
    # Arrays that kernels fill whole are not zeroed first.
    most_points = int(np.diff(windows.point_offsets).max(initial=1))
    jobs = devices.pack(
        SearchJobs, device, point_begin=windows.point_offsets[:-1], point_end=windows.point_offsets[1:],
        grid=windows.grid, half_x=half_x, half_y=half_y, off_centre_cost=windows.off_centre_costs,
        row_cost=windows.angle_costs, cells=wp.empty((rows, most_points), dtype=wp.vec2i, device=device),
    )  # fmt: skip
    job_of_row = np.repeat(np.arange(count, dtype=np.int32), np.diff(windows.row_offsets))
    node_begin = np.concatenate([[0], np.cumsum(np.prod(2 * windows.half_cells // width + 1, axis=1)[job_of_row])])
    job_nodes = node_begin[windows.row_offsets].astype(np.int32)
    bound, node = (wp.empty(int(node_begin[-1]), dtype=kind, device=device) for kind in (wp.float64, wp.vec3i))
    roots = devices.pack(Roots, device, bound=bound, node=node)
    inputs = [jobs, job_of_row, windows.angles_rad, windows.centres, grids.origins, grids.resolution, windows.points,
              node_begin[:-1], pyramid, roots]  # fmt: skip
    devices.launch(bound_blocks, rows, inputs, device, threads)
    bounds = roots.bound.numpy()
    if count == 1:
        order = np.argsort(-bounds, kind="stable")
    else:
        order = np.lexsort((-bounds, np.repeat(np.arange(count), np.diff(job_nodes))))
    roots.order, roots.begin = (devices.to_device(a, wp.int32, device) for a in (order, job_nodes))
    return jobs, roots
