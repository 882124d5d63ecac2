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

MIN_THREADED_LOOK_UPS = 100_000  # fewer look-ups of points are done before a second thread has started

Pyramid = wp.array4d(dtype=wp.uint8)  # likelihood grids with their maxima over blocks: (grids, levels, nx, ny)


@wp.struct
class SearchJobs:
    """J jobs on a device: job j has ``points[point_begin[j]:point_end[j]]``, and rows of angles of its own."""

    points: Vec2ds  # in the sensor's frame
    point_begin: Int32s
    point_end: Int32s
    grid: Int32s
    origin: Vec2ds  # corner of each grid, metres
    resolution: wp.float64  # of all grids
    centre: Vec2ds  # middle of the window, metres
    half_x: Int32s  # the window's half width, cells
    half_y: Int32s
    min_score: Float64s  # scores must exceed this
    off_centre_cost: Float64s  # cost of a squared cell off the centre, in units of the score
    angle_rad: Float64s  # angle of each row
    row_cost: Float64s  # cost of the row's angle
    job_of_row: Int32s
    cells: wp.array2d(dtype=wp.vec2i)  # cells of each row's points, with the sensor at the window's centre


@wp.struct
class Block:
    """A block of 2^level x 2^level translations at one angle, of which (dx, dy) is the first, in cells."""

    job: int
    row: int  # of its angle
    level: int
    dx: int
    dy: int


@wp.struct
class Roots:
    """The largest blocks of all jobs: job j has ``order[begin[j]:begin[j + 1]]``, best bound first."""

    begin: Int32s
    row_begin: Int32s  # first node of each row
    order: Int32s  # nodes
    bound: Float64s  # of each node
    node: wp.array(dtype=wp.vec3i)  # row, dx, dy


@wp.struct
class EarlierModes:
    """The earlier poses of each job, (J, modes), as (row, dx, dy), and how far a further mode must lie from them."""

    node: wp.array2d(dtype=wp.vec3i)
    apart: wp.vec3i
    count: int


@wp.struct
class Stack:
    """Blocks that each strand, a thread that searches a part of a job, has still to search; the best are on top."""

    bound: Float64Rows
    node: wp.array2d(dtype=wp.vec3i)  # level, dx, dy


@wp.struct
class Best:
    """The best poses so far."""

    incumbent: Float64s  # best score of each job
    score: Float64s  # best score of each strand
    node: wp.array(dtype=wp.vec3i)  # row, dx, dy of the strand's best pose; row -1 if there is none


@wp.func
def block_score(jobs: SearchJobs, pyramid: Pyramid, block: Block) -> int:
    """Return the sum, over the points of a job, of the largest value that a translation in the block gives."""
    grid = jobs.grid[block.job]
    nx, ny = pyramid.shape[2], pyramid.shape[3]
    width = 1 << block.level
    total = int(0)
    for point in range(jobs.point_end[block.job] - jobs.point_begin[block.job]):
        cell = jobs.cells[block.row, point]
        x = cell[0] + block.dx
        y = cell[1] + block.dy
        if x < nx and y < ny and x > -width and y > -width:
            total += int(pyramid[grid, block.level, wp.max(x, 0), wp.max(y, 0)])
    return total


@wp.func
def min_offset_sq(offset: int, width: int) -> wp.float64:
    """Return the least square of the numbers from ``offset`` to ``offset + width - 1``."""
    last = offset + width - 1
    if offset <= 0 and last >= 0:
        return wp.float64(0.0)
    nearest = wp.float64(wp.min(wp.abs(offset), wp.abs(last)))
    return nearest * nearest


@wp.func
def block_bound(jobs: SearchJobs, pyramid: Pyramid, block: Block) -> wp.float64:
    """Return the bound of the scores in a block, less the cost of its angle and of its distance from the centre."""
    points = jobs.point_end[block.job] - jobs.point_begin[block.job]
    scale = wp.float64(1.0) / (wp.float64(255.0) * wp.float64(wp.max(points, 1)))
    width = 1 << block.level
    offset_cost = jobs.off_centre_cost[block.job] * (min_offset_sq(block.dx, width) + min_offset_sq(block.dy, width))
    return wp.float64(block_score(jobs, pyramid, block)) * scale - (jobs.row_cost[block.row] + offset_cost)


@wp.kernel
def bound_blocks(first: int, jobs: SearchJobs, pyramid: Pyramid, roots: Roots):
    """One thread per angle of a job: compute the cells of its points, and bound the scores of the largest blocks."""
    # Cells are computed with the sensor at the window's centre.
    row = first + wp.tid()
    job = jobs.job_of_row[row]
    corner = jobs.origin[jobs.grid[job]]
    cosine, sine = wp.cos(jobs.angle_rad[row]), wp.sin(jobs.angle_rad[row])
    x0 = jobs.centre[job][0] - corner[0]
    y0 = jobs.centre[job][1] - corner[1]
    for i in range(jobs.point_end[job] - jobs.point_begin[job]):
        point = jobs.points[jobs.point_begin[job] + i]
        x = int(wp.floor((x0 + cosine * point[0] - sine * point[1]) / jobs.resolution))
        y = int(wp.floor((y0 + sine * point[0] + cosine * point[1]) / jobs.resolution))
        jobs.cells[row, i] = wp.vec2i(x, y)
    level = pyramid.shape[1] - 1
    width = 1 << level
    node = roots.row_begin[row]
    dx = -jobs.half_x[job]
    while dx <= jobs.half_x[job]:
        dy = -jobs.half_y[job]
        while dy <= jobs.half_y[job]:
            roots.bound[node] = block_bound(jobs, pyramid, Block(job, row, level, dx, dy))
            roots.node[node] = wp.vec3i(row, dx, dy)
            node += 1
            dy += width
        dx += width


@wp.func
def is_near_earlier(earlier: EarlierModes, block: Block) -> bool:
    """Return whether a whole block lies within ``earlier.apart`` of an earlier pose."""
    apart = earlier.apart
    last = (1 << block.level) - 1
    for mode in range(earlier.count):
        pose = earlier.node[block.job, mode]
        if wp.abs(block.row - pose[0]) <= apart[0]:
            if block.dx >= pose[1] - apart[1] and block.dx + last <= pose[1] + apart[1]:
                if block.dy >= pose[2] - apart[2] and block.dy + last <= pose[2] + apart[2]:
                    return True
    return False


@wp.kernel
def search_blocks(
    first: int, strands: int, jobs: SearchJobs, roots: Roots, pyramid: Pyramid, earlier: EarlierModes, stack: Stack,
    best: Best,
):  # fmt: skip
    """One thread per strand of a job: search every ``strands``-th of the job's largest blocks, best bound first."""
    # Strands share the best score of the job. An outdated value costs time, but does not change the result.
    strand = first + wp.tid()
    job = strand / strands
    best_score = wp.float64(jobs.min_score[job])  # of the strand
    best_node = wp.vec3i(-1, 0, 0)
    rank = roots.begin[job] + strand - job * strands
    while rank < roots.begin[job + 1]:
        root = roots.order[rank]
        rank += strands
        if roots.bound[root] < wp.max(best_score, best.incumbent[job]) or roots.bound[root] <= jobs.min_score[job]:
            break
        row = roots.node[root][0]
        stack.bound[strand, 0] = roots.bound[root]
        stack.node[strand, 0] = wp.vec3i(pyramid.shape[1] - 1, roots.node[root][1], roots.node[root][2])
        size = int(1)
        while size > 0:
            size -= 1
            limit = wp.max(best_score, best.incumbent[job])
            value = stack.bound[strand, size]
            if value < limit or value <= jobs.min_score[job]:
                continue
            level = stack.node[strand, size][0]
            left = stack.node[strand, size][1]
            bottom = stack.node[strand, size][2]
            # A single translation: keep it if it is better, or equal and earlier in the order.
            if level == 0:
                better = value > best_score
                if value == best_score and best_node[0] >= 0:
                    if row < best_node[0]:
                        better = True
                    if row == best_node[0]:
                        better = left < best_node[1] or (left == best_node[1] and bottom < best_node[2])
                if better:
                    best_score = value
                    best_node = wp.vec3i(row, left, bottom)
                    if value > best.incumbent[job]:
                        best.incumbent[job] = value
                continue
            # Push those of the block's quarters that can still win.
            half = 1 << (level - 1)
            base = size
            for child in range(4):
                dx = left + half * (child / 2)
                dy = bottom + half * (child % 2)
                if dx > jobs.half_x[job] or dy > jobs.half_y[job]:
                    continue
                block = Block(job, row, level - 1, dx, dy)
                if is_near_earlier(earlier, block):
                    continue
                score = block_bound(jobs, pyramid, block)
                if score < limit or score <= jobs.min_score[job]:
                    continue
                place = size  # children in ascending order, so that the best is on top
                while place > base and stack.bound[strand, wp.max(place - 1, 0)] > score:
                    stack.bound[strand, place] = stack.bound[strand, place - 1]
                    stack.node[strand, place] = stack.node[strand, place - 1]
                    place -= 1
                stack.bound[strand, place] = score
                stack.node[strand, place] = wp.vec3i(level - 1, dx, dy)
                size += 1
    best.score[strand] = best_score
    best.node[strand] = best_node


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
    min_scores: Floats  # bound that scores must exceed, (J,)
    off_centre_costs: Floats  # cost of a squared cell off the centre, in units of the score, (J,)


@dataclass(frozen=True)
class Modes:
    """The number of poses searched in each job, and how far apart they must be."""

    count: int
    min_score_ratio: float  # a further pose must exceed this share of the first pose's score
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
    threads = 1 if n_look_ups < MIN_THREADED_LOOK_UPS else threads
    jobs, roots = _bound_roots(grids, windows, threads)
    deepest = 4 * pyramid.shape[1] + 4  # four children a level
    earlier = devices.pack(EarlierModes, device, apart=wp.vec3i(*modes.apart))
    stack = devices.pack(Stack, device, bound=(n_strands, deepest), node=(n_strands, deepest))
    best = devices.pack(Best, device, score=(n_strands,), node=(n_strands,))
    min_scores = windows.min_scores
    scores = np.full((n_jobs, modes.count), -np.inf)
    nodes = np.zeros((n_jobs, modes.count, 3), dtype=np.int64)
    nodes[..., 0] = -1
    for mode in range(modes.count):
        if mode > 0:  # without a first pose there are no further ones
            min_scores = np.where(
                np.isfinite(scores[:, 0]), np.maximum(min_scores, modes.min_score_ratio * scores[:, 0]), np.inf
            )
        jobs.min_score = devices.to_device(min_scores, wp.float64, device)
        earlier_nodes = np.where(nodes[..., :1] >= 0, nodes, -(1 << 28)).astype(np.int32)
        earlier.node, earlier.count = devices.to_device(earlier_nodes, wp.vec3i, device), mode
        best.incumbent = devices.to_device(min_scores.copy(), wp.float64, device)
        devices.launch(search_blocks, n_strands, [strands, jobs, roots, pyramid, earlier, stack, best], device, threads)
        # Take the best of each job's strands, among equal scores the first by angle, x and y.
        node = best.node.numpy().reshape(n_jobs, strands, 3)
        score = np.where(node[..., 0] >= 0, best.score.numpy().reshape(n_jobs, strands), -np.inf)
        winners = np.lexsort((node[..., 2], node[..., 1], node[..., 0], -score))[:, 0]
        scores[:, mode], nodes[:, mode] = (a[np.arange(n_jobs), winners] for a in (score, node))
    return scores, nodes


def _bound_roots(grids: Any, windows: Windows, threads: int | None) -> tuple[Any, Any]:
    """Put the jobs on the device, and their largest blocks with their bounds."""
    pyramid, device = grids.pyramid, grids.device
    count, rows = len(windows.grid), len(windows.angles_rad)
    width = 1 << (pyramid.shape[1] - 1)
    half_x, half_y = np.ascontiguousarray(windows.half_cells.T)
    job_of_row = np.repeat(np.arange(count, dtype=np.int32), np.diff(windows.row_offsets))
    # Arrays that kernels fill whole are not zeroed first.
    max_points = int(np.diff(windows.point_offsets).max(initial=1))
    jobs = devices.pack(
        SearchJobs, device, points=windows.points, point_begin=windows.point_offsets[:-1],
        point_end=windows.point_offsets[1:], grid=windows.grid, origin=grids.origins,
        resolution=grids.resolution, centre=windows.centres, half_x=half_x, half_y=half_y,
        off_centre_cost=windows.off_centre_costs, angle_rad=windows.angles_rad, row_cost=windows.angle_costs,
        job_of_row=job_of_row, cells=wp.empty((rows, max_points), dtype=wp.vec2i, device=device),
    )  # fmt: skip
    node_begin = np.concatenate([[0], np.cumsum(np.prod(2 * windows.half_cells // width + 1, axis=1)[job_of_row])])
    job_nodes = node_begin[windows.row_offsets].astype(np.int32)
    bound, node = (wp.empty(int(node_begin[-1]), dtype=kind, device=device) for kind in (wp.float64, wp.vec3i))
    roots = devices.pack(Roots, device, bound=bound, node=node, row_begin=node_begin[:-1])
    devices.launch(bound_blocks, rows, [jobs, pyramid, roots], device, threads)
    bounds = roots.bound.numpy()
    if count == 1:
        order = np.argsort(-bounds, kind="stable")
    else:
        order = np.lexsort((-bounds, np.repeat(np.arange(count), np.diff(job_nodes))))
    roots.order, roots.begin = (devices.to_device(a, wp.int32, device) for a in (order, job_nodes))
    return jobs, roots
