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
PEAK = wp.constant(wp.float64(255.0))  # value of a grid's cell in which a point fits best
NO_ROW = -(1 << 28)  # row of an earlier pose that does not exist, far from all rows
Vec2is = wp.array(dtype=wp.vec2i)
Pyramid = wp.array4d(dtype=wp.uint8)  # likelihood grids with their maxima over blocks: (grids, levels, nx, ny)


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


WindowsArrays = devices.struct_like(
    Windows, Vec2ds, Int32s, Int32s, Vec2ds, Vec2is, Float64s, Float64s, Int32s, Float64s, Float64s
)


@wp.struct
class Rows:
    """The rows of all jobs: the points of a job at one angle, with the sensor at the window's centre."""

    job: Int32s
    cells: wp.array2d(dtype=wp.vec2i)  # cells of each row's points


@wp.struct
class Block:
    """A block of 2^level x 2^level translations at one angle, of which (dx, dy) is the first, in cells."""

    job: int
    row: int  # row of its angle
    level: int
    dx: int
    dy: int


@wp.struct
class Roots:
    """The largest blocks of all jobs: job j has ``order[begin[j]:begin[j + 1]]``, best bound first."""

    begin: Int32s
    row_begin: Int32s  # first node of each row
    order: Int32s  # nodes
    bound: Float64s  # bound of each node
    node: wp.array(dtype=wp.vec3i)  # row, dx, dy


@wp.struct
class EarlierModes:
    """The earlier poses of each job, (J, modes), as (row, dx, dy), and how far a further mode must lie from them."""

    node: wp.array2d(dtype=wp.vec3i)
    apart: wp.vec3i
    count: int


@wp.struct
class Strands:
    """The state of the search. A strand is a thread that searches a part of a job's blocks."""

    incumbent: Float64s  # best score so far of each job
    score: Float64s  # best score of each strand
    pose: wp.array(dtype=wp.vec3i)  # row, dx, dy of this score; row -1 if there is none
    bound: Float64Rows  # stack of the blocks that a strand has still to search, the best on top
    node: wp.array2d(dtype=wp.vec3i)  # level, dx, dy of these blocks


@wp.func
def block_score(jobs: WindowsArrays, rows: Rows, pyramid: Pyramid, block: Block) -> int:
    """Return the sum, over the points of a job, of the largest value that a translation in the block gives."""
    grid = jobs.grid[block.job]
    nx, ny = pyramid.shape[2], pyramid.shape[3]
    width = 1 << block.level
    total = int(0)
    for point in range(jobs.point_offsets[block.job + 1] - jobs.point_offsets[block.job]):
        cell = rows.cells[block.row, point]
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
def block_bound(jobs: WindowsArrays, rows: Rows, pyramid: Pyramid, block: Block) -> wp.float64:
    """Return the bound of the scores in a block, less the cost of its angle and of its distance from the centre."""
    points = jobs.point_offsets[block.job + 1] - jobs.point_offsets[block.job]
    scale = wp.float64(1.0) / (PEAK * wp.float64(wp.max(points, 1)))
    width = 1 << block.level
    offset_cost = jobs.off_centre_costs[block.job] * (min_offset_sq(block.dx, width) + min_offset_sq(block.dy, width))
    return wp.float64(block_score(jobs, rows, pyramid, block)) * scale - (jobs.angle_costs[block.row] + offset_cost)


@wp.kernel
def bound_blocks(
    first: int, jobs: WindowsArrays, rows: Rows, origins: Vec2ds, resolution: wp.float64, pyramid: Pyramid, roots: Roots
):
    """One thread per angle of a job: compute the cells of its points, and bound the scores of the largest blocks."""
    # Cells are computed with the sensor at the window's centre.
    row = first + wp.tid()
    job = rows.job[row]
    corner = origins[jobs.grid[job]]  # corner of the grid, metres
    cosine, sine = wp.cos(jobs.angles_rad[row]), wp.sin(jobs.angles_rad[row])
    x0, y0 = jobs.centres[job][0] - corner[0], jobs.centres[job][1] - corner[1]
    for i in range(jobs.point_offsets[job + 1] - jobs.point_offsets[job]):
        point = jobs.points[jobs.point_offsets[job] + i]
        x = int(wp.floor((x0 + cosine * point[0] - sine * point[1]) / resolution))
        y = int(wp.floor((y0 + sine * point[0] + cosine * point[1]) / resolution))
        rows.cells[row, i] = wp.vec2i(x, y)
    level = pyramid.shape[1] - 1
    width = 1 << level
    node = roots.row_begin[row]
    dx = -jobs.half_cells[job][0]
    while dx <= jobs.half_cells[job][0]:
        dy = -jobs.half_cells[job][1]
        while dy <= jobs.half_cells[job][1]:
            roots.bound[node] = block_bound(jobs, rows, pyramid, Block(job, row, level, dx, dy))
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


@wp.func
def push_quarters(
    jobs: WindowsArrays, rows: Rows, pyramid: Pyramid, earlier: EarlierModes, strands: Strands, strand: int, size: int,
    block: Block, limit: wp.float64,
) -> int:  # fmt: skip
    """Push the quarters of a block whose bound reaches ``limit`` on a stack of this size. Returns the new size."""
    base = size
    half = 1 << (block.level - 1)
    for child in range(4):
        dx = block.dx + half * (child / 2)
        dy = block.dy + half * (child % 2)
        if dx > jobs.half_cells[block.job][0] or dy > jobs.half_cells[block.job][1]:
            continue
        quarter = Block(block.job, block.row, block.level - 1, dx, dy)
        if is_near_earlier(earlier, quarter):
            continue
        bound = block_bound(jobs, rows, pyramid, quarter)
        if bound < limit or bound <= jobs.min_scores[block.job]:
            continue
        place = size  # quarters in ascending order, so that the best is on top
        while place > base and strands.bound[strand, wp.max(place - 1, 0)] > bound:
            strands.bound[strand, place] = strands.bound[strand, place - 1]
            strands.node[strand, place] = strands.node[strand, place - 1]
            place -= 1
        strands.bound[strand, place] = bound
        strands.node[strand, place] = wp.vec3i(block.level - 1, dx, dy)
        size += 1
    return size


@wp.kernel
def search_blocks(
    first: int, per_job: int, jobs: WindowsArrays, rows: Rows, roots: Roots, pyramid: Pyramid, earlier: EarlierModes,
    strands: Strands,
):  # fmt: skip
    """One thread per strand of a job: search every ``per_job``-th of the job's largest blocks, best bound first."""
    # Strands share the best score of the job. An outdated value costs time, but does not change the result.
    strand = first + wp.tid()
    job = strand / per_job
    best_score = wp.float64(jobs.min_scores[job])  # best score of the strand
    best_node = wp.vec3i(-1, 0, 0)
    rank = roots.begin[job] + strand - job * per_job
    while rank < roots.begin[job + 1]:
        root = roots.order[rank]
        rank += per_job
        if roots.bound[root] < wp.max(best_score, strands.incumbent[job]) or roots.bound[root] <= jobs.min_scores[job]:
            break
        row = roots.node[root][0]
        strands.bound[strand, 0] = roots.bound[root]
        strands.node[strand, 0] = wp.vec3i(pyramid.shape[1] - 1, roots.node[root][1], roots.node[root][2])
        size = int(1)
        while size > 0:
            size -= 1
            limit = wp.max(best_score, strands.incumbent[job])
            bound = strands.bound[strand, size]
            if bound < limit or bound <= jobs.min_scores[job]:
                continue
            node = strands.node[strand, size]
            block = Block(job, row, node[0], node[1], node[2])
            if block.level > 0:
                size = push_quarters(jobs, rows, pyramid, earlier, strands, strand, size, block, limit)
                continue
            # A single translation: keep it if it is better, or equal and earlier in the order.
            is_tie = bound == best_score and best_node[0] >= 0
            is_first = block.dx < best_node[1] or (block.dx == best_node[1] and block.dy < best_node[2])
            is_first = row < best_node[0] or (row == best_node[0] and is_first)
            if bound > best_score or (is_tie and is_first):
                best_score = bound
                best_node = wp.vec3i(row, block.dx, block.dy)
                if bound > strands.incumbent[job]:
                    strands.incumbent[job] = bound
    strands.score[strand] = best_score
    strands.pose[strand] = best_node


@dataclass(frozen=True)
class Modes:
    """The number of poses searched in each job, and how far apart they must be."""

    count: int
    min_score_ratio: float  # least score of a further pose, divided by the first pose's score
    apart: tuple[int, int, int]  # largest differences of poses that are not apart: rows, cells in x, cells in y


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
    jobs, rows, roots = _bound_roots(grids, windows, threads)
    earlier = devices.pack(EarlierModes, device, apart=wp.vec3i(*modes.apart))
    stack = (n_strands, 4 * pyramid.shape[1] + 4)  # room for at most four children a level
    state = devices.pack(Strands, device, score=(n_strands,), pose=(n_strands,), bound=stack, node=stack)
    min_scores = windows.min_scores
    scores = np.full((n_jobs, modes.count), -np.inf)
    nodes = np.zeros((n_jobs, modes.count, 3), dtype=np.int64)
    nodes[..., 0] = -1
    for mode in range(modes.count):
        if mode > 0:  # without a first pose there are no further ones
            min_scores = np.where(
                np.isfinite(scores[:, 0]), np.maximum(min_scores, modes.min_score_ratio * scores[:, 0]), np.inf
            )
        jobs.min_scores = devices.to_device(min_scores, wp.float64, device)
        earlier_nodes = np.where(nodes[..., :1] >= 0, nodes, NO_ROW).astype(np.int32)
        earlier.node, earlier.count = devices.to_device(earlier_nodes, wp.vec3i, device), mode
        state.incumbent = devices.to_device(min_scores.copy(), wp.float64, device)
        inputs = [strands, jobs, rows, roots, pyramid, earlier, state]
        devices.launch(search_blocks, n_strands, inputs, device, threads)
        # Take the best of each job's strands, among equal scores the first by angle, x and y.
        node = state.pose.numpy().reshape(n_jobs, strands, 3)
        score = np.where(node[..., 0] >= 0, state.score.numpy().reshape(n_jobs, strands), -np.inf)
        winners = np.lexsort((node[..., 2], node[..., 1], node[..., 0], -score))[:, 0]
        scores[:, mode], nodes[:, mode] = (a[np.arange(n_jobs), winners] for a in (score, node))
    return scores, nodes


def _bound_roots(grids: Any, windows: Windows, threads: int | None) -> tuple[Any, Any, Any]:
    """Put jobs, rows and roots on the device: the largest blocks of all jobs, with their bounds."""
    pyramid, device = grids.pyramid, grids.device
    count, n_rows = len(windows.grid), len(windows.angles_rad)
    width = 1 << (pyramid.shape[1] - 1)
    job_of_row = np.repeat(np.arange(count, dtype=np.int32), np.diff(windows.row_offsets))
    # Arrays that kernels fill whole are not zeroed first.
    max_points = int(np.diff(windows.point_offsets).max(initial=1))
    jobs = devices.pack(WindowsArrays, device, **vars(windows))
    cells = wp.empty((n_rows, max_points), dtype=wp.vec2i, device=device)
    rows = devices.pack(Rows, device, job=job_of_row, cells=cells)
    node_begin = np.concatenate([[0], np.cumsum(np.prod(2 * windows.half_cells // width + 1, axis=1)[job_of_row])])
    job_nodes = node_begin[windows.row_offsets].astype(np.int32)
    bound, node = (wp.empty(int(node_begin[-1]), dtype=kind, device=device) for kind in (wp.float64, wp.vec3i))
    roots = devices.pack(Roots, device, bound=bound, node=node, row_begin=node_begin[:-1])
    inputs = [jobs, rows, grids.origins, grids.resolution, pyramid, roots]
    devices.launch(bound_blocks, n_rows, inputs, device, threads)
    bounds = roots.bound.numpy()
    if count == 1:
        order = np.argsort(-bounds, kind="stable")
    else:
        order = np.lexsort((-bounds, np.repeat(np.arange(count), np.diff(job_nodes))))
    roots.order, roots.begin = (devices.to_device(a, wp.int32, device) for a in (order, job_nodes))
    return jobs, rows, roots
