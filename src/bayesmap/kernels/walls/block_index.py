"""The 2 x 2 blocks of a grid, and which beams touch each of them."""

import numpy as np
import warp as wp

from bayesmap.beams.rays import MAX_INCIDENCES
from bayesmap.beams.table import BeamTable
from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import available_cores, launch

wp.set_module_options({"enable_backward": False})

LOOK_BACK = wp.constant(8)  # a beam's cells in one block lie close together, even where it runs along a line
Weights = wp.types.vector(length=16, dtype=wp.float64)


@wp.struct
class Blocks:
    """Which beams touch each block, and where."""

    offsets: wp.array(dtype=wp.int32)
    beam: wp.array(dtype=wp.int32)
    first: wp.array(dtype=wp.int32)  # the first of the beam's entries in the block
    last: wp.array(dtype=wp.int32)  # the last of them
    takes: wp.array(dtype=Weights)  # [free * 4 + j][state]: 1 if j is a wall there and the cells of `free` are not
    rows: int
    nx: int
    ny: int


@wp.func
def cell_of_block(blocks: Blocks, x: int, y: int, j: int) -> int:
    """The j-th cell of the block at (x, y), or -1 where a grid one cell wide has none."""
    cx = x + j // 2
    cy = y + j % 2
    if cx >= blocks.nx or cy >= blocks.ny:
        return -1
    return cx * blocks.ny + cy


@wp.func
def place_in_block(c: int, x: int, y: int, ny: int) -> int:
    """Which of the four cells c is, or -1."""
    dx = c // ny - x
    dy = c % ny - y
    if dx < 0 or dx > 1 or dy < 0 or dy > 1:
        return -1
    return 2 * dx + dy


@wp.kernel
def list_block_beams(
    first: int,
    filling: int,
    bounds: wp.array(dtype=wp.int32),
    nx: int,
    ny: int,
    rows: int,
    table_offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    counts: wp.array(dtype=wp.int32),
    beam: wp.array(dtype=wp.int32),
    begin: wp.array(dtype=wp.int32),
    end: wp.array(dtype=wp.int32),
):
    """One thread a range of block columns: count the beams of each block, or fill their entries in."""
    thread = first + wp.tid()
    for b in range(table_offsets.shape[0] - 1):
        for k in range(table_offsets[b], table_offsets[b + 1]):
            cx = cells[k] // ny
            cy = cells[k] % ny
            for dx in range(2):
                for dy in range(2):
                    x = cx - dx
                    y = cy - dy
                    if x >= bounds[thread] and x < bounds[thread + 1] and y >= 0 and y < rows:
                        seen = int(0)
                        for j in range(wp.max(table_offsets[b], k - LOOK_BACK), k):
                            if place_in_block(cells[j], x, y, ny) >= 0:
                                seen = 1
                        block = x * rows + y
                        if seen == 0:
                            i = counts[block]
                            counts[block] = i + 1
                            if filling != 0:
                                beam[i] = b
                                begin[i] = k
                                end[i] = k
                        elif filling != 0:
                            end[counts[block] - 1] = k


def list_blocks(table: BeamTable, device: str) -> Blocks:
    """List the beams of every block; memory is about 25 bytes for each incidence of the table."""
    nx, ny = table.grid.shape
    columns, rows = max(1, nx - 1), max(1, ny - 1)
    threads = min(available_cores(), columns)
    bounds = np.linspace(0, columns, threads + 1).astype(np.int32)
    counts = np.zeros(columns * rows, dtype=np.int32)
    empty = np.empty(0, dtype=np.int32)

    def run(filling: int, *arrays: np.ndarray) -> None:
        shared = [devices.to_device(a, wp.int32, "cpu") for a in arrays]
        inputs = [filling, devices.to_device(bounds, wp.int32, "cpu"), nx, ny, rows]
        inputs += [devices.to_device(a, wp.int32, "cpu") for a in (table.offsets, table.cells)]
        launch(list_block_beams, threads, [*inputs, *shared], "cpu")

    run(0, counts, empty, empty, empty)
    total = int(counts.sum(dtype=np.int64))
    if total > MAX_INCIDENCES:
        raise BadInput(
            f"block: the beams meet {total:,} blocks, over the limit of {MAX_INCIDENCES:,}; "
            "use method 'gibbs', a coarser resolution, or fewer scans"
        )
    offsets = np.zeros(len(counts) + 1, dtype=np.int32)
    np.cumsum(counts, out=offsets[1:])
    beam, begin, end = (np.empty(offsets[-1], dtype=np.int32) for _ in range(3))
    run(1, offsets[:-1].copy(), beam, begin, end)

    state = np.arange(16)
    takes = [((state >> j) & 1) * ((state & free) == 0) for free in range(16) for j in range(4)]
    blocks = Blocks()
    blocks.offsets = devices.to_device(offsets, wp.int32, device)
    blocks.beam = devices.to_device(beam, wp.int32, device)
    blocks.first = devices.to_device(begin, wp.int32, device)
    blocks.last = devices.to_device(end, wp.int32, device)
    blocks.takes = wp.array(np.array(takes, dtype=np.float64), dtype=Weights, device=device)
    blocks.rows, blocks.nx, blocks.ny = rows, nx, ny
    return blocks
