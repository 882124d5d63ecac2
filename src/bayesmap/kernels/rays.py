"""Trace rays: list the cells of each beam, compute where it crosses them, and count hits and passes of cells.

`trace_rays` walks every beam twice: the first walk counts its cells, the second lists them. Kernels of other files read
the lists, and compute with `chord` where a beam enters and leaves a cell.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import ArrayLike

from bayesmap.beams.rays import MAX_INCIDENCES, Rays
from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import ZERO, Float32s, Float64s, Floats, Int32Rows, Int32s, Ints, Singles, Uint8s, Vec2ds
from bayesmap.kernels.walk import PARALLEL, Walk, advance_walk, begin_walk, cell_before, is_inside
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})
BEAMS_PER_REPORT = 1 << 16  # beams traced between two reports of progress


@wp.struct
class Lines:
    """Beams and their grid, on a device."""

    start_m: Vec2ds  # start of each beam from the grid's lower left corner
    direction: Vec2ds  # unit vectors
    nx: int
    ny: int
    edge_m: wp.float64  # edge of a cell


@wp.struct
class RayArrays:
    """`Rays` on a device: beam b crosses ``cells[offsets[b]:offsets[b + 1]]``."""

    lines: Lines
    offsets: Int32s
    cells: Int32s


@wp.struct
class Slab:
    """One axis of a beam's line, in units of cells."""

    start: wp.float64
    per_cell: wp.float64  # from one grid line to the next, with the direction's sign; 0 if the line crosses none
    first: int  # the cell of the start: see `cell_before`
    side: int  # 1 if the beam enters a cell by its upper side
    onward: int  # sign of the direction; 0 if the line crosses no grid line


@wp.func
def slab_of(start: wp.float64, cosine: wp.float64) -> Slab:
    """Return one axis of a line from its start, in units of cells, and its direction cosine."""
    slab = Slab()
    slab.start = start
    if wp.abs(cosine) >= PARALLEL:
        slab.per_cell = wp.float64(1.0) / cosine
        slab.onward = wp.where(cosine > wp.float64(0.0), 1, -1)
        slab.side = wp.where(cosine > wp.float64(0.0), 0, 1)
        slab.first = cell_before(start, slab.onward)
    return slab


@wp.struct
class Line:
    """A beam's line in its grid."""

    x: Slab
    y: Slab
    ny: int
    per_column: wp.float64  # 1 / ny
    edge_m: wp.float64
    start_m: wp.vec2d
    direction: wp.vec2d


@wp.func
def line_from(start_m: wp.vec2d, direction: wp.vec2d, ny: int, edge_m: wp.float64) -> Line:
    """Return the line of a beam from its start, metres from the grid's corner, and its direction."""
    x = slab_of(start_m[0] / edge_m, direction[0])
    y = slab_of(start_m[1] / edge_m, direction[1])
    return Line(x, y, ny, wp.float64(1.0) / wp.float64(ny), edge_m, start_m, direction)


@wp.func
def line_of(lines: Lines, beam: int) -> Line:
    """Return the line of a beam."""
    return line_from(lines.start_m[beam], lines.direction[beam], lines.ny, lines.edge_m)


@wp.func
def walk_along(line: Line, nx: int, max_m: wp.float64) -> Walk:
    """Start the walk along a line in its grid, ``nx`` cells wide."""
    return begin_walk(wp.vec2d(line.x.start, line.y.start), line.direction, nx, line.ny, max_m / line.edge_m)


@wp.func
def chord(line: Line, cell: int) -> wp.vec2d:
    """Return the distances at which a beam enters and leaves a cell that it touches, metres (`Rays.chords`)."""
    # Intersect the parts of the line between the cell's sides in x and in y.
    x = int((wp.float64(cell) + wp.float64(0.5)) * line.per_column)  # a division of whole numbers takes longer
    y = cell - x * line.ny
    enter = ZERO
    leave = wp.float64(1.0e300)  # an axis without motion limits nothing
    holds_start = bool(True)
    if line.x.onward != 0:
        to_side_x = wp.float64(x + line.x.side) - line.x.start
        enter = wp.max(enter, to_side_x * line.x.per_cell)
        leave = (to_side_x + wp.float64(line.x.onward)) * line.x.per_cell
        holds_start = x == line.x.first
    if line.y.onward != 0:
        to_side_y = wp.float64(y + line.y.side) - line.y.start
        enter = wp.max(enter, to_side_y * line.y.per_cell)
        leave = wp.min(leave, (to_side_y + wp.float64(line.y.onward)) * line.y.per_cell)
        holds_start = holds_start and y == line.y.first
    leave = wp.max(leave, ZERO)
    # The cell of the start is met where the beam leaves it.
    if holds_start:
        enter = leave
    return wp.vec2d(enter * line.edge_m, wp.max(leave, enter) * line.edge_m)


@wp.func
def distance_at(line: Line, cell: int, depth: wp.float64) -> wp.float64:
    """Return the distance at which a beam stops in a cell, metres. ``depth`` is a share of its chord."""
    inside = chord(line, cell)
    return inside[0] + depth * (inside[1] - inside[0])


@wp.func
def first_past(line: Line, cells: Int32s, begin: int, end: int, distance_m: wp.float64, depth: wp.float64) -> int:
    """Return the first entry in [begin, end) whose stop is at least so far away, or end, by bisection."""
    low = begin
    high = end
    while low < high:
        middle = (low + high) // 2
        if distance_at(line, cells[middle], depth) < distance_m:
            low = middle + 1
        else:
            high = middle
    return low


@wp.kernel
def list_cells(
    first: int, lines: Lines, reach_m: Float64s, near_m: Float64s, offsets: Int32s, cells: Int32s, first_near: Int32s
):
    """One thread per beam: write its cells, and the entry of the first cell that it enters at ``near_m`` or later."""
    # Without room for cells, and at an infinite ``near_m``, cells are counted. entry: the next one.
    beam = first + wp.tid()
    entry = offsets[beam]
    near_distance = near_m[beam] / lines.edge_m
    walk = walk_along(line_of(lines, beam), lines.nx, reach_m[beam])
    near = int(entry)
    while walk.distance <= walk.end:
        if is_inside(walk, lines.nx, lines.ny):
            if cells.shape[0] > 0:
                cells[entry] = walk.cell_x * lines.ny + walk.cell_y
            entry += 1
            if walk.distance < near_distance:
                near = entry
        walk = advance_walk(walk)
    first_near[beam] = near


@wp.kernel
def fill_distances(first: int, rays: RayArrays, depth: wp.float64, distance_m: Float32s):
    """One thread per beam: compute the distance at which it would stop in each of its cells."""
    beam = first + wp.tid()
    line = line_of(rays.lines, beam)
    for entry in range(rays.offsets[beam], rays.offsets[beam + 1]):
        distance_m[entry] = wp.float32(distance_at(line, rays.cells[entry], depth))


def stop_distances(rays: Rays, hit_depth: float, device: str = "cpu") -> Singles:
    """Compute `Rays.stop_distance_m` by a kernel: metres, (K,)."""
    distance_m = wp.empty(rays.n_incidences, dtype=wp.float32, device=device)
    inputs = [rays_to_device(rays, device), hit_depth, distance_m]
    devices.launch(fill_distances, rays.n_beams, inputs, device, devices.threads_for(rays.n_beams))
    return np.asarray(distance_m.numpy())


def rays_to_device(rays: Rays, device: str) -> Any:
    """Put rays on a device."""
    lines = lines_to_device(rays.start_m, rays.direction, rays.grid, device)
    return devices.pack(RayArrays, device, lines=lines, offsets=rays.offsets, cells=rays.cells)


def lines_to_device(start_m: Floats, direction: Floats, grid: Grid, device: str) -> Any:
    """Put lines on a device; starts are in metres from the grid's lower left corner."""
    (nx, ny), edge_m = grid.shape, grid.resolution
    return devices.pack(Lines, device, start_m=start_m, direction=direction, nx=nx, ny=ny, edge_m=edge_m)


def beam_lines(scans: Scans, grid: Grid) -> tuple[Floats, Floats]:
    """Return the start of every beam, metres from the grid's lower left corner, and its unit vector, (B, 2) each."""
    start = (scans.beam_starts_world() - np.array(grid.origin)).reshape(-1, 2)
    angle = scans.beam_angles_world().ravel()
    return start, np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def trace_rays(
    scans: Scans, grid: Grid, *, poses_world: ArrayLike | None = None, reach_m: Floats | None = None,
    near_m: Floats | None = None, device: str = "cpu",
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> Rays:  # fmt: skip
    """Follow every beam of S scans of A beams through a grid: beam ``s * A + a`` of the rays is beam a of scan s.
    Beams with invalid readings, and beams that a scan lacks, get no entry. ``poses_world`` are other poses, as
    `bayesmap.space.scans.Scans.at` takes them. Each beam is followed for ``reach_m``, (B,), at most to the sensor's
    largest range, the default. No stop before ``near_m``, (B,), could explain its reading; 0 if None. ``on_progress``
    gets beams done and all; each is followed twice. Raises `BadInput` if 32-bit indices cannot count the incidences.
    """
    device = devices.resolve(device)
    scans = scans if poses_world is None else scans.at(poses_world)
    ranges, beams = scans.ranges_m.ravel(), scans.ranges_m.size
    reach = np.minimum(np.inf if reach_m is None else reach_m, scans.max_range_m)
    reach = np.where(np.isnan(ranges), -1.0, reach)
    start_m, direction = beam_lines(scans, grid)
    lines = lines_to_device(start_m, direction, grid, device)
    reach = devices.to_device(reach, wp.float64, device)

    def follow_beams(beams_before: int, near_m: Floats, offsets: Ints, cells: Any) -> Ints:
        """Follow all beams, a piece at a time. Returns the ``first_near`` of `list_cells`."""
        first_near = wp.empty(beams, dtype=wp.int32, device=device)
        arrays = [devices.to_device(near_m, wp.float64, device), devices.to_device(offsets, wp.int32, device)]
        for begin in range(0, beams, BEAMS_PER_REPORT):
            size = min(BEAMS_PER_REPORT, beams - begin)
            inputs = [lines, reach, *arrays, cells, first_near]
            devices.launch(list_cells, size, inputs, device, devices.threads_for(size), begin)
            on_progress((beams_before + begin + size) // 2, beams)
        return np.asarray(first_near.numpy())

    # The first walk counts the cells of each beam, the second lists them.
    counts = follow_beams(0, np.full(beams, np.inf), np.zeros(beams), wp.empty(0, dtype=wp.int32, device=device))
    offsets = offsets_from(counts)
    cells = wp.empty(int(offsets[-1]), dtype=wp.int32, device=device)
    first_near = follow_beams(beams, np.zeros(beams) if near_m is None else near_m, offsets, cells)
    return Rays(
        grid=grid, offsets=offsets, cells=cells.numpy(), first_near=first_near, start_m=start_m,
        direction=direction, range_m=ranges, limits=RangeLimits(scans.min_range_m, scans.max_range_m),
    )  # fmt: skip


def offsets_from(counts: Ints) -> Ints:
    """Return the first entry of each beam and the number of entries, (B + 1,). Raises `BadInput` if over 2^31 - 1."""
    ends = np.cumsum(counts, dtype=np.int64)
    total = int(ends[-1]) if len(ends) else 0
    if total > MAX_INCIDENCES:
        raise BadInput(
            f"scans: {len(counts):,} beams cross {total:,} cells, over the limit of {MAX_INCIDENCES:,}; "
            "use a coarser resolution, a shorter --max-range, or fewer scans"
        )
    return np.concatenate([[0], ends]).astype(np.int32)


@wp.kernel
def count_hits_and_passes(
    first: int, lines: Lines, reach_m: Float64s, hit: Uint8s, bounds: Int32s, hits: Int32Rows, passes: Int32Rows
):
    """One thread per share of the beams: count hits and passes in rows of its own, (threads, cells)."""
    thread = first + wp.tid()
    for beam in range(bounds[thread], bounds[thread + 1]):
        walk = walk_along(line_of(lines, beam), lines.nx, reach_m[beam])
        ends_inside = walk.end >= reach_m[beam] / lines.edge_m
        last = int(-1)  # last cell of the grid touched so far
        while walk.distance <= walk.end:
            if is_inside(walk, lines.nx, lines.ny):
                if last >= 0:
                    passes[thread, last] = passes[thread, last] + 1
                last = walk.cell_x * lines.ny + walk.cell_y
            walk = advance_walk(walk)
        if last >= 0:
            if hit[beam] != wp.uint8(0) and ends_inside:
                hits[thread, last] = hits[thread, last] + 1
            else:
                passes[thread, last] = passes[thread, last] + 1


def count_hits(scans: Scans, grid: Grid, device: str = "cpu") -> tuple[Ints, Ints]:
    """Count the beams that stopped in each cell and the beams that passed it, (nx * ny,) each.
    A hit stops in the last cell touched at its range; outside the grid it passes all cells. A beam without return
    passes all cells up to the sensor's range. Beams that are too close or invalid do not count.
    """
    device = devices.resolve(device)
    ranges = scans.ranges_m.ravel()
    hit = np.isfinite(ranges)
    reach_m = np.where(hit, ranges, np.where(np.isposinf(ranges), scans.max_range_m, -1.0))
    threads = devices.available_cores()
    bounds = np.linspace(0, len(ranges), threads + 1).astype(np.int32)
    counts = (threads, grid.n_cells)
    inputs = [lines_to_device(*beam_lines(scans, grid), grid, device), reach_m, hit, bounds, counts, counts]
    hits, passes = devices.launch(count_hits_and_passes, threads, inputs, device)
    return hits.sum(axis=0, dtype=np.int32), passes.sum(axis=0, dtype=np.int32)


@wp.kernel
def add_passes(first: int, rays: RayArrays, distance_m: Float32s, range_m: Float32s, end_cell: Int32s, passes: Int32s):
    """One thread per beam: add one to every cell before the one in which its reading ends."""
    beam = first + wp.tid()
    reading = range_m[beam]
    if wp.isnan(reading) or reading < wp.float32(0.0):
        return
    for entry in range(rays.offsets[beam], rays.offsets[beam + 1]):
        cell = rays.cells[entry]
        if cell == end_cell[beam] or distance_m[entry] > reading:
            return
        wp.atomic_add(passes, cell, 1)


def count_passes(rays: Rays, end_cell: Ints, device: str) -> Ints:
    """Count the beams that pass each cell of the grid before the cells in which they end, flat, (B,). Returns (N,)."""
    distance_m = stop_distances(rays, 0.0, device)
    inputs = [rays_to_device(rays, device), distance_m, rays.range_m, end_cell, (rays.grid.n_cells,)]
    return np.asarray(devices.launch(add_passes, rays.n_beams, inputs, device, 1)[0])
