"""Correlative matching of points to likelihood grids by branch and bound.

Hess, Kohler, Rapp and Andor (2016), "Real-time loop closure in 2D LIDAR SLAM", algorithm 3: a node is a block of
2^h x 2^h translations at one angle; level h of the pyramid bounds the score of all of them. The search is exact: what
it returns is what looking at every translation and every angle would, and the first of equals in the order of angle,
x, y, whatever the number of threads.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices

wp.set_module_options({"enable_backward": False})


@wp.struct
class Jobs:
    """What to match: job k has the points point_begin .. point_end, and rows of angles of its own."""

    point_begin: wp.array(dtype=wp.int32)
    point_end: wp.array(dtype=wp.int32)
    grid: wp.array(dtype=wp.int32)
    half_x: wp.array(dtype=wp.int32)  # the window's half width, cells
    half_y: wp.array(dtype=wp.int32)
    least: wp.array(dtype=wp.float64)  # scores must exceed this
    across: wp.array(dtype=wp.float64)  # cost of a squared cell off the centre, in units of the score


@wp.func
def block_score(
    pyramid: wp.array4d(dtype=wp.uint8),
    cells: wp.array2d(dtype=wp.vec2i),
    row: int,
    points: int,
    grid: int,
    level: int,
    dx: int,
    dy: int,
) -> int:
    """The sum over points of the largest value in the block of shifts (dx, dy) .. + 2^level - 1."""
    nx = pyramid.shape[2]
    ny = pyramid.shape[3]
    width = 1 << level
    total = int(0)
    for k in range(points):
        c = cells[row, k]
        x = c[0] + dx
        y = c[1] + dy
        if x < nx and y < ny and x > -width and y > -width:
            total += int(pyramid[grid, level, wp.max(x, 0), wp.max(y, 0)])
    return total


@wp.func
def off_centre(offset: int, width: int) -> wp.float64:
    """The least squared distance from 0 within offset .. offset + width - 1."""
    last = offset + width - 1
    if offset <= 0 and last >= 0:
        return wp.float64(0.0)
    near = wp.float64(wp.min(wp.abs(offset), wp.abs(last)))
    return near * near


@wp.kernel
def turn_points(
    first: int,
    jobs: Jobs,
    job_of_row: wp.array(dtype=wp.int32),
    angle: wp.array(dtype=wp.float64),
    centre: wp.array(dtype=wp.vec2d),
    origin: wp.array(dtype=wp.vec2d),
    resolution: wp.float64,
    points: wp.array(dtype=wp.vec2d),
    cells: wp.array2d(dtype=wp.vec2i),
):
    """One thread an angle of a job: the cells of its points with the sensor at the window's centre."""
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
        cells[row, k] = wp.vec2i(x, y)


@wp.kernel
def bound_blocks(
    first: int,
    jobs: Jobs,
    job_of_row: wp.array(dtype=wp.int32),
    row_cost: wp.array(dtype=wp.float64),
    node_begin: wp.array(dtype=wp.int32),
    level: int,
    cells: wp.array2d(dtype=wp.vec2i),
    pyramid: wp.array4d(dtype=wp.uint8),
    bound: wp.array(dtype=wp.float64),
    node: wp.array(dtype=wp.vec3i),
):
    """One thread an angle of a job: bounds of the largest blocks."""
    row = first + wp.tid()
    j = job_of_row[row]
    width = 1 << level
    points = jobs.point_end[j] - jobs.point_begin[j]
    scale = wp.float64(1.0) / (wp.float64(255.0) * wp.float64(wp.max(points, 1)))
    n = node_begin[row]
    dx = -jobs.half_x[j]
    while dx <= jobs.half_x[j]:
        dy = -jobs.half_y[j]
        while dy <= jobs.half_y[j]:
            total = block_score(pyramid, cells, row, points, jobs.grid[j], level, dx, dy)
            cost = row_cost[row] + jobs.across[j] * (off_centre(dx, width) + off_centre(dy, width))
            bound[n] = wp.float64(total) * scale - cost
            node[n] = wp.vec3i(row, dx, dy)
            n += 1
            dy += width
        dx += width


@wp.func
def is_taken(
    row: int, dx: int, dy: int, width: int, taken: wp.array(dtype=wp.vec3i), apart: wp.vec3i, modes: int
) -> int:
    """Whether a whole block lies within the surroundings of a pose that was found before."""
    for m in range(modes):
        t = taken[m]
        if wp.abs(row - t[0]) <= apart[0]:
            if dx >= t[1] - apart[1] and dx + width - 1 <= t[1] + apart[1]:
                if dy >= t[2] - apart[2] and dy + width - 1 <= t[2] + apart[2]:
                    return 1
    return 0


@wp.kernel
def search_blocks(
    first: int,
    strands: int,
    jobs: Jobs,
    row_cost: wp.array(dtype=wp.float64),
    job_nodes: wp.array(dtype=wp.int32),
    order: wp.array(dtype=wp.int32),
    bound: wp.array(dtype=wp.float64),
    node: wp.array(dtype=wp.vec3i),
    top: int,
    cells: wp.array2d(dtype=wp.vec2i),
    pyramid: wp.array4d(dtype=wp.uint8),
    taken: wp.array2d(dtype=wp.vec3i),
    apart: wp.vec3i,
    modes: int,
    stack_bound: wp.array2d(dtype=wp.float64),
    stack_node: wp.array2d(dtype=wp.vec4i),
    incumbent: wp.array(dtype=wp.float64),
    best: wp.array(dtype=wp.float64),
    best_node: wp.array(dtype=wp.vec3i),
):
    """One thread a strand of a job: depth first through every ``strands``-th of its largest blocks, best bound first.

    Strands share the score of the best that any has found; a stale one costs time and changes nothing.
    """
    t = first + wp.tid()
    j = t / strands
    points = jobs.point_end[j] - jobs.point_begin[j]
    scale = wp.float64(1.0) / (wp.float64(255.0) * wp.float64(wp.max(points, 1)))
    mine = wp.float64(jobs.least[j])
    found = wp.vec3i(-1, 0, 0)
    q = job_nodes[j] + t - j * strands
    while q < job_nodes[j + 1]:
        start = order[q]
        q += strands
        if bound[start] < wp.max(mine, incumbent[j]) or bound[start] <= jobs.least[j]:
            break
        row = node[start][0]
        stack_bound[t, 0] = bound[start]
        stack_node[t, 0] = wp.vec4i(top, node[start][1], node[start][2], 0)
        depth = int(1)
        while depth > 0:
            depth -= 1
            limit = wp.max(mine, incumbent[j])
            value = stack_bound[t, depth]
            if value < limit or value <= jobs.least[j]:
                continue
            level = stack_node[t, depth][0]
            x0 = stack_node[t, depth][1]
            y0 = stack_node[t, depth][2]
            if level == 0:
                better = value > mine
                if value == mine and found[0] >= 0:
                    if row < found[0]:
                        better = True
                    if row == found[0]:
                        better = x0 < found[1] or (x0 == found[1] and y0 < found[2])
                if better:
                    mine = value
                    found = wp.vec3i(row, x0, y0)
                    if value > incumbent[j]:
                        incumbent[j] = value
                continue
            half = 1 << (level - 1)
            base = depth
            for child in range(4):
                dx = x0 + half * (child / 2)
                dy = y0 + half * (child % 2)
                if dx > jobs.half_x[j] or dy > jobs.half_y[j]:
                    continue
                if modes > 0:
                    if is_taken(row, dx, dy, half, taken[j], apart, modes) == 1:
                        continue
                total = block_score(pyramid, cells, row, points, jobs.grid[j], level - 1, dx, dy)
                cost = row_cost[row] + jobs.across[j] * (off_centre(dx, half) + off_centre(dy, half))
                score = wp.float64(total) * scale - cost
                if score < limit or score <= jobs.least[j]:
                    continue
                z = depth  # children in ascending order, so that the best is on top
                while z > base and stack_bound[t, wp.max(z - 1, 0)] > score:
                    stack_bound[t, z] = stack_bound[t, z - 1]
                    stack_node[t, z] = stack_node[t, z - 1]
                    z -= 1
                stack_bound[t, z] = score
                stack_node[t, z] = wp.vec4i(level - 1, dx, dy, 0)
                depth += 1
    best[t] = mine
    best_node[t] = found


def search(
    pyramid: Any,
    origins: NDArray[np.float64],
    resolution: float,
    points: NDArray[np.float64],
    point_offsets: NDArray[np.int32],
    grid_of_job: NDArray[np.int32],
    centres: NDArray[np.float64],
    half_cells: NDArray[np.int32],
    angles_rad: NDArray[np.float64],
    angle_costs: NDArray[np.float64],
    row_offsets: NDArray[np.int32],
    least: NDArray[np.float64],
    across: NDArray[np.float64],
    modes: int,
    share: float,
    apart: tuple[int, int, int],
    strands: int,
    device: str,
    threads: int | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The best poses of each job: scores (J, modes), -inf where there is none, and (row, dx, dy), (J, modes, 3).

    Args:
        pyramid: of the grids, on the device.
        origins: of the grids, shape (grids, 2).
        resolution: of the grids, metres a cell.
        points: all jobs' points one after the other, in the sensor's frame, shape (N, 2).
        point_offsets: job j has the points from point_offsets[j] to point_offsets[j + 1].
        grid_of_job: shape (J,).
        centres: x and y of the middle of each window, shape (J, 2).
        half_cells: half the windows' widths, shape (J, 2).
        angles_rad: of all rows.
        angle_costs: what each angle costs, in units of the score.
        row_offsets: job j has the rows from row_offsets[j] to row_offsets[j + 1].
        least: scores must exceed this, shape (J,).
        across: what a squared cell off the centre costs, shape (J,).
        modes: poses a job.
        share: of the first one's score that those of further ones must exceed.
        apart: each further mode is more than so many rows, cells and cells away from those before, in one of the three.
        strands: threads that share a job.
        device: where the pyramid is.
        threads: to compute with; by default all cores.
    """
    count = len(grid_of_job)
    top = pyramid.shape[1] - 1
    width = 1 << top
    jobs = Jobs()
    jobs.point_begin = devices.to_device(point_offsets[:-1], wp.int32, device)
    jobs.point_end = devices.to_device(point_offsets[1:], wp.int32, device)
    jobs.grid = devices.to_device(grid_of_job, wp.int32, device)
    jobs.half_x, jobs.half_y = (devices.to_device(h, wp.int32, device) for h in np.ascontiguousarray(half_cells.T))
    jobs.across = devices.to_device(across, wp.float64, device)
    rows = len(angles_rad)
    rows_of_job = np.diff(row_offsets)
    job_of_row = np.repeat(np.arange(count, dtype=np.int32), rows_of_job)
    blocks = np.prod(2 * half_cells // width + 1, axis=1)
    node_begin = np.concatenate([[0], np.cumsum(blocks[job_of_row])])
    job_nodes = node_begin[row_offsets].astype(np.int32)
    job_of_row_dev = devices.to_device(job_of_row, wp.int32, device)
    row_cost = devices.to_device(angle_costs, wp.float64, device)
    most = int(np.diff(point_offsets).max(initial=1))
    cells = wp.empty((rows, max(most, 1)), dtype=wp.vec2i, device=device)
    inputs = [jobs, job_of_row_dev, devices.to_device(angles_rad, wp.float64, device)]
    inputs += [devices.to_device(centres, wp.vec2d, device), devices.to_device(origins, wp.vec2d, device)]
    inputs += [wp.float64(resolution), devices.to_device(points, wp.vec2d, device), cells]
    devices.launch(turn_points, rows, inputs, device, threads)
    bound = wp.empty(int(node_begin[-1]), dtype=wp.float64, device=device)
    node = wp.empty(int(node_begin[-1]), dtype=wp.vec3i, device=device)
    begin = devices.to_device(node_begin[:-1], wp.int32, device)
    inputs = [jobs, job_of_row_dev, row_cost, begin, top, cells, pyramid, bound, node]
    devices.launch(bound_blocks, rows, inputs, device, threads)
    bounds = bound.numpy()
    if count == 1:
        order = np.argsort(-bounds, kind="stable")
    else:
        order = np.lexsort((-bounds, np.repeat(np.arange(count), np.diff(job_nodes))))
    order_dev, nodes_dev = (devices.to_device(a, wp.int32, device) for a in (order, job_nodes))
    threads_of_all = count * strands
    stack_bound = wp.empty((threads_of_all, 4 * top + 8), dtype=wp.float64, device=device)
    stack_node = wp.empty((threads_of_all, 4 * top + 8), dtype=wp.vec4i, device=device)
    scores = np.full((count, modes), -np.inf)
    found = np.zeros((count, modes, 3), dtype=np.int64)
    found[..., 0] = -1
    for mode in range(modes):
        if mode > 0:  # where there is no first one there is no further one
            least = np.where(np.isfinite(scores[:, 0]), np.maximum(least, share * scores[:, 0]), np.inf)
        jobs.least = devices.to_device(least, wp.float64, device)
        taken = np.where(found[..., :1] >= 0, found, -(1 << 28)).astype(np.int32)
        incumbent = devices.to_device(least.copy(), wp.float64, device)
        best = wp.empty(threads_of_all, dtype=wp.float64, device=device)
        best_node = wp.empty(threads_of_all, dtype=wp.vec3i, device=device)
        inputs = [strands, jobs, row_cost, nodes_dev, order_dev, bound, node, top, cells, pyramid]
        inputs += [devices.to_device(taken, wp.vec3i, device), wp.vec3i(*apart), mode, stack_bound, stack_node]
        inputs += [incumbent, best, best_node]
        devices.launch(search_blocks, threads_of_all, inputs, device, threads)
        _first_of_best(
            best.numpy().reshape(count, strands), best_node.numpy().reshape(count, strands, 3), scores, found, mode
        )
    return scores, found


def _first_of_best(
    best: NDArray[np.float64],
    nodes: NDArray[np.int32],
    scores: NDArray[np.float64],
    found: NDArray[np.int64],
    mode: int,
) -> None:
    """The best of a job's strands; of equals, the first by angle, x, y."""
    valid = nodes[..., 0] >= 0
    value = np.where(valid, best, -np.inf)
    for j in np.nonzero(valid.any(axis=1))[0]:
        top = np.nonzero(value[j] == value[j].max())[0]
        winner = min((tuple(nodes[j, t]), t) for t in top)[1]
        scores[j, mode] = value[j, winner]
        found[j, mode] = nodes[j, winner]
