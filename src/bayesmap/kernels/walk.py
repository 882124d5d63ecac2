"""The walk of a beam through the grid: every cell that it touches, in order, with the distance of the touch.

Cells are closed squares: a beam through a corner touches all cells that meet there, and a beam along a grid line
touches the cells on both sides. The cell of the start is touched where the beam leaves it. These are the rules of the
tutorial's formula, the minimum over the four edges of every wall pixel. The steps follow Amanatides and Woo
(1987), with ties kept. The walk counts in units of cells. It starts one cell *before* any grid line that the start lies
on, so that both sides are touched at distance zero, and at the grid's border when the sensor is outside.
"""

from typing import Any

import warp as wp
from numpy.typing import NDArray

from bayesmap.beams import rays
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import ONE, ZERO, Float64s, Floats, Int32s, Ints, Uint8Rows, Vec2ds

wp.set_module_options({"enable_backward": False})
TIE = wp.constant(wp.float64(rays.TIE))
PARALLEL = wp.constant(wp.float64(rays.PARALLEL))
NEVER = wp.constant(wp.float64(1.0e300))  # distance of a grid line that the beam does not cross
SIDE_X = wp.constant(1)  # the cell beside the current one in x is touched too
SIDE_Y = wp.constant(2)


@wp.struct
class Walk:
    """The state of a walk, in cells. It touches the cell (cell_x, cell_y) at ``distance``, and is over past ``end``."""

    cell_x: int  # the cell that is touched now
    cell_y: int
    distance: wp.float64  # distance at which the beam touches it
    end: wp.float64
    beam_x: int  # the cell that the beam is in; side cells lie beside it
    beam_y: int
    sides: int  # bits of the side cells that are touched next: SIDE_X, SIDE_Y
    side_x: int  # offset of the side cell in x: -1 or 1
    side_y: int
    along_line: int  # SIDE_X or SIDE_Y if the beam runs along a grid line, so that every cell has a side cell; else 0
    step_x: int  # direction of travel: -1, 1, or 0 if the beam is parallel to the lines
    step_y: int
    next_x: wp.float64  # distance of the next grid line
    next_y: wp.float64
    gap_x: wp.float64  # distance between two grid lines along the beam
    gap_y: wp.float64


@wp.func
def cell_before(p: wp.float64, step: int) -> int:
    """Return the cell of a coordinate. On a grid line it is the cell that the beam leaves."""
    if step > 0:
        return int(wp.ceil(p - TIE)) - 1
    return int(wp.floor(p + TIE))


@wp.func
def begin_walk(start: wp.vec2d, direction: wp.vec2d, nx: int, ny: int, max_distance: wp.float64) -> Walk:
    """Return the walk from a start along a unit vector, at its first touch, in cells from the grid's corner."""
    px, py = start[0], start[1]
    ux, uy = direction[0], direction[1]
    # Per axis: step and gap, and the distances at which the beam enters and leaves the grid.
    w = Walk()
    w.next_x = NEVER
    w.next_y = NEVER
    w.gap_x = NEVER
    w.gap_y = NEVER
    enter = wp.float64(0.0)
    leave = wp.float64(max_distance)
    if wp.abs(ux) >= PARALLEL:
        w.step_x = wp.where(ux > ZERO, 1, -1)
        w.gap_x = ONE / wp.abs(ux)
        enter = wp.max(enter, wp.min(-px / ux, (wp.float64(nx) - px) / ux))
        leave = wp.min(leave, wp.max(-px / ux, (wp.float64(nx) - px) / ux))
    elif px < -TIE or px > wp.float64(nx) + TIE:
        leave = -ONE
    if wp.abs(uy) >= PARALLEL:
        w.step_y = wp.where(uy > ZERO, 1, -1)
        w.gap_y = ONE / wp.abs(uy)
        enter = wp.max(enter, wp.min(-py / uy, (wp.float64(ny) - py) / uy))
        leave = wp.min(leave, wp.max(-py / uy, (wp.float64(ny) - py) / uy))
    elif py < -TIE or py > wp.float64(ny) + TIE:
        leave = -ONE
    w.end = leave + TIE
    # First cell and next grid lines. A direction that counts as parallel keeps its coordinate.
    w.beam_x = cell_before(px + wp.where(w.step_x == 0, ZERO, enter * ux), w.step_x)
    w.beam_y = cell_before(py + wp.where(w.step_y == 0, ZERO, enter * uy), w.step_y)
    if w.step_x != 0:
        w.next_x = (wp.float64(w.beam_x + wp.max(w.step_x, 0)) - px) / ux
    if w.step_y != 0:
        w.next_y = (wp.float64(w.beam_y + wp.max(w.step_y, 0)) - py) / uy
    # A beam along a grid line touches the cells on its other side too.
    if w.step_x == 0 and wp.abs(px - wp.float64(w.beam_x)) <= TIE:
        w.along_line = SIDE_X
        w.side_x = -1
    if w.step_y == 0 and wp.abs(py - wp.float64(w.beam_y)) <= TIE:
        w.along_line = SIDE_Y
        w.side_y = -1
    w.cell_x = w.beam_x
    w.cell_y = w.beam_y
    w.sides = w.along_line
    w.distance = wp.max(ZERO, wp.min(w.next_x, w.next_y))
    return w


@wp.func
def advance_walk(w: Walk) -> Walk:
    """Advance to the next touch: a side cell that is still due, else the cell across the next grid line."""
    if w.sides != 0:
        if (w.sides & SIDE_X) != 0:
            w.cell_x = w.beam_x + w.side_x
            w.cell_y = w.beam_y
            w.sides = w.sides & SIDE_Y
        else:
            w.cell_x = w.beam_x
            w.cell_y = w.beam_y + w.side_y
            w.sides = 0
        return w
    if w.next_x < w.next_y - TIE:
        w.distance = w.next_x
        w.next_x = w.next_x + w.gap_x
        w.beam_x = w.beam_x + w.step_x
        w.sides = w.along_line
    elif w.next_y < w.next_x - TIE:
        w.distance = w.next_y
        w.next_y = w.next_y + w.gap_y
        w.beam_y = w.beam_y + w.step_y
        w.sides = w.along_line
    else:  # through a corner: both neighbours first touched here, then the cell beyond
        w.distance = wp.min(w.next_x, w.next_y)
        w.next_x = w.next_x + w.gap_x
        w.next_y = w.next_y + w.gap_y
        w.beam_x = w.beam_x + w.step_x
        w.beam_y = w.beam_y + w.step_y
        w.side_x = -w.step_x
        w.side_y = -w.step_y
        w.sides = SIDE_X + SIDE_Y
    w.cell_x = w.beam_x
    w.cell_y = w.beam_y
    return w


@wp.func
def is_inside(w: Walk, nx: int, ny: int) -> bool:
    """Return whether the touched cell is one of the grid's."""
    return w.cell_x >= 0 and w.cell_x < nx and w.cell_y >= 0 and w.cell_y < ny


@wp.kernel
def find_first_hits(
    first: int, walls: Uint8Rows, start: Vec2ds, angle_rad: Float64s, max_distance: wp.float64, distance: Float64s,
    visits: Int32s,
):  # fmt: skip
    """One thread per beam: walk to the first wall. Outputs are ``distance`` and the number of ``visits``."""
    beam = first + wp.tid()
    nx, ny = walls.shape[0], walls.shape[1]
    w = begin_walk(start[beam], wp.vec2d(wp.cos(angle_rad[beam]), wp.sin(angle_rad[beam])), nx, ny, max_distance)
    nearest = wp.float64(max_distance)
    n_visited = int(0)
    while w.distance <= w.end:
        if is_inside(w, nx, ny):
            n_visited += 1
            if walls[w.cell_x, w.cell_y] != wp.uint8(0):
                nearest = wp.min(w.distance, max_distance)
                break
        w = advance_walk(w)
    distance[beam] = nearest
    visits[beam] = n_visited


def cast_beams(
    walls: NDArray[Any], starts_cells: Floats, angles_rad: Floats, longest_cells: float, device: str = "cpu"
) -> tuple[Floats, Ints]:
    """Return the distance of each beam to the first wall, in cells, and the number of cells that it visits, (B,) each.
    ``walls`` is (nx, ny), ``starts_cells`` (B, 2). A beam without a wall has the distance ``longest_cells``.
    """
    device = devices.resolve(device)
    beams = (len(starts_cells),)
    inputs = [walls != 0, starts_cells, angles_rad, longest_cells, beams, beams]
    distance, visits = devices.launch(find_first_hits, len(starts_cells), inputs, device, threads=1)
    return distance, visits
