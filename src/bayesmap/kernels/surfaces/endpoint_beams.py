"""The likelihood of the stops of beams in a cell in which readings end, one beam or eight beams at a time.

With g the chance of meeting the surface,

    log p(stops, readings | m, surface) = sum over passing beams log(1 - m g)
                                        + sum over stopped beams log(m g p(reading | stop)^beta).

A cell evaluates its beams again for every step of its surface. `log_stops` takes one beam after the other, for any
sensor. `log_stops_in_lanes` evaluates eight at once in wide registers: nearly all hits of a mixture whose noise is
normal or Student's t of few, whole degrees of freedom. These beams are first copied to *blocks* of eight: one `Lanes`
for each of their numbers. Left-over lanes hold beams that do not count.
"""

import numpy as np
import warp as wp

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import ONE_32, Float32Rows, Int32s, Ints, Singles
from bayesmap.kernels.sensor_law import FAR_SQ, MIXTURE, SensorLaw32
from bayesmap.kernels.surfaces import surface
from bayesmap.kernels.surfaces.stops import MIN_FACTOR, TracedRays, hit_density
from bayesmap.kernels.surfaces.surface import CROSSING_WIDTH_SQ, L11, L21, L22, MEAN_X, MEAN_Y, REFLECTIVITY, Cell

MIN_PRODUCT = wp.constant(wp.float32(1.0e-20))  # products are turned into logarithms before they underflow
BLOCK_WIDTH = 8  # beams of a block
Lanes = wp.types.vector(length=BLOCK_WIDTH, dtype=wp.float32)  # one number of each of eight beams
# Lanes of a block. Passing beams: offset of the cell's centre from the beam, and direction of the beam. Stopped beams:
# also distance of the centre along the beam, reading, decay, and 1 if the beam counts, 0 if it only fills a lane.
OFFSET, LINE_X, LINE_Y, PASSING_LANES = 0, 1, 2, 3
CENTRE, READING, DECAY, COUNTS, STOPPED_LANES = 3, 4, 5, 6, 7
PRODUCT_LANES = wp.constant(2)  # lanes before the blocks: product and least product, see `log_stops_in_lanes`
CHUNK_BLOCKS = wp.constant(4)  # blocks whose factors are multiplied before the product is turned into a logarithm
MIN_LANE_PRODUCT = wp.constant(wp.float32(1.0e-35))  # a smaller product may have underflowed
STEEP_SLOPE = wp.constant(wp.float32(1.0e30))  # slope of the step function `positive`
MAX_EXPONENT = wp.constant(wp.float32(41.0))  # largest absolute argument of `exponential`
FAR_OFFSET_M = wp.constant(wp.float32(1.0e3))  # no surface of a cell is met at this offset
UNKNOWN = wp.constant(wp.float64(1.0e300))  # stands for a sum that could not be computed


@wp.struct
class EndpointCells:
    """Incidences of the cells in which readings end: cell ``cell[u]`` has ``offsets[u]:offsets[u + 1]``."""

    cell: Int32s
    offsets: Int32s
    # For each incidence:
    entry: Int32s  # its entry in the rays
    beam: Int32s
    line: wp.array(dtype=wp.vec3)  # offset of the cell's centre from the beam, metres, and direction of the beam
    centre_and_range: wp.array(dtype=wp.vec2)  # distance of the centre along the beam, and the reading, metres
    # For each cell:
    steps_and_frame: wp.array(dtype=Cell)  # sizes of its steps, and its frame: see `kernels.surfaces.endpoint_cells`


def endpoint_cells_to_device(rays: Rays, cells: Ints, steps_and_frame: Singles, device: str) -> EndpointCells:
    """List the incidences of cells, flat, ascending, (U,), on a device; ``steps_and_frame`` is (U, 8)."""
    is_listed = np.bincount(cells, minlength=rays.grid.n_cells) > 0
    entry = np.nonzero(is_listed[rays.cells])[0].astype(np.int32)
    beam = np.searchsorted(rays.offsets, entry, side="right") - 1  # while entries ascend, which is faster
    # Order entries by the number of their cell: NumPy sorts numbers of 16 bits much faster.
    number = np.zeros(rays.grid.n_cells, dtype=np.min_scalar_type(len(cells)))
    number[cells] = np.arange(len(cells))
    order = np.argsort(number[rays.cells[entry]], kind="stable")
    entry, beam = entry[order], beam[order]
    cell_of_entry = rays.cells[entry]
    to_centre = rays.grid.centers_from_corner_m(cell_of_entry) - rays.start_m[beam]
    ux, uy = rays.direction[beam].astype(np.float64).T
    line = np.stack([ux * to_centre[:, 1] - uy * to_centre[:, 0], ux, uy], axis=-1)
    centre_and_range = np.stack([(to_centre * rays.direction[beam]).sum(axis=1), rays.range_m[beam]], axis=-1)
    return devices.pack(
        EndpointCells, device, cell=cells, steps_and_frame=steps_and_frame, entry=entry, beam=beam, line=line,
        offsets=np.append(np.searchsorted(cell_of_entry, cells), len(entry)), centre_and_range=centre_and_range,
    )  # fmt: skip


@wp.func
def meeting_chance_of(line: wp.vec3, dx: wp.float32, dy: wp.float32, cell: Cell) -> wp.float32:
    """Return the chance of meeting a surface whose mean lies (dx, dy) from the cell's centre."""
    offset = line[0] + line[1] * dy - line[2] * dx
    across_1, across_2 = cell[L21] * line[1] - cell[L11] * line[2], cell[L22] * line[1]
    return surface.meeting_chance_at(offset, across_1 * across_1 + across_2 * across_2)


@wp.struct
class StopLikelihood:
    """Law and beams of the likelihood of stops, shared by all cells."""

    law: SensorLaw32
    beta: wp.float32  # inverse temperature
    rays: TracedRays
    endpoints: EndpointCells


@wp.struct
class CellBeams:
    """Incidences of one cell, as indices into `EndpointCells`: beams that pass it, and beams that it stops."""

    number: int  # number of the cell in `EndpointCells`
    entries: Int32s  # passing beams are entries[passing_begin:passing_end], stopped beams follow further on
    passing_begin: int
    passing_end: int
    stopped_begin: int
    stopped_end: int


@wp.func
def log_stops(
    likelihood: StopLikelihood, beams: CellBeams, centre: wp.vec2, cell: Cell, least: wp.float64
) -> wp.float64:
    """Compute log p(stops, readings | m, surface) of a cell's beams. A sum below ``least`` is returned unfinished."""
    # Stopped beams come first, because every passing beam makes the sum smaller. product: factors since the last
    # logarithm; (dx, dy): mean relative to the cell's centre.
    endpoints = likelihood.endpoints
    total = wp.float64(0.0)
    product = ONE_32
    reflectivity = cell[REFLECTIVITY]
    dx, dy = cell[MEAN_X] - centre[0], cell[MEAN_Y] - centre[1]
    for i in range(beams.stopped_begin, beams.stopped_end):
        incidence = beams.entries[i]
        beam = endpoints.beam[incidence]
        line = endpoints.line[incidence]
        offset = line[0] + line[1] * dy - line[2] * dx
        ahead = endpoints.centre_and_range[incidence][0] + line[1] * dx + line[2] * dy
        crossing = surface.cross_at(offset, ahead, cell, line[1], line[2])
        p = hit_density(
            likelihood.law, likelihood.beta, endpoints.entry[incidence], likelihood.rays.first_near[beam],
            endpoints.centre_and_range[incidence][1], likelihood.rays.decay[beam], crossing,
        )  # fmt: skip
        product = product * wp.max(reflectivity * crossing.meeting_chance * p, MIN_FACTOR)
        if product < MIN_PRODUCT or product > ONE_32 / MIN_PRODUCT:
            total += wp.log(wp.float64(product))
            product = ONE_32
    total += wp.log(wp.float64(product))
    if total < least:
        return total
    product = ONE_32
    floor = wp.max(MIN_PRODUCT, wp.float32(wp.exp(least - total)))
    for i in range(beams.passing_begin, beams.passing_end):
        g = meeting_chance_of(endpoints.line[beams.entries[i]], dx, dy, cell)
        product = product * wp.max(ONE_32 - reflectivity * g, MIN_FACTOR)
        if product < floor:
            total += wp.log(wp.float64(product))
            if total < least:
                return total
            product = ONE_32
            floor = wp.max(MIN_PRODUCT, wp.float32(wp.exp(least - total)))
    return total + wp.log(wp.float64(product))


@wp.struct
class LaneBlocks:
    """Working memory for the blocks of all cells, or of one cell per thread."""

    numbers: Float32Rows
    lanes: wp.array2d(dtype=Lanes)  # the memory of ``numbers``
    begin: Int32s  # first lane of each cell's blocks in its row; 0 if each row belongs to one thread


@wp.struct
class CellBlocks:
    """The blocks of one cell: their place in `LaneBlocks`, and the number of beams in them."""

    row: int  # -1 if the cell has no blocks
    begin: int  # first lane in the row
    n_passing: int
    n_stopped: int


def room_for_blocks(endpoints: EndpointCells, rows: int, device: str) -> LaneBlocks:
    """Allocate blocks for each row: on a GPU for all cells, on the CPU for the cell with the most blocks."""
    # Upper bound: each kind fills at most one block in part, and a stopped beam takes more lanes than a passing one.
    blocks = devices.ceil_div(np.diff(endpoints.offsets.numpy()), BLOCK_WIDTH)
    lanes = int(PRODUCT_LANES) + int(PASSING_LANES) + int(STOPPED_LANES) * (1 + blocks)
    begin = np.zeros(len(lanes), dtype=np.int64) if device == "cpu" else np.cumsum(lanes) - lanes
    size = int((begin + lanes).max(initial=0))
    on_device = LaneBlocks()
    on_device.numbers = wp.zeros((rows, size * BLOCK_WIDTH), dtype=wp.float32, device=device)
    on_device.lanes = wp.array(ptr=on_device.numbers.ptr, shape=(rows, size), dtype=Lanes, device=device)
    on_device.begin = devices.to_device(begin, wp.int32, device)
    return on_device


@wp.func
def fits_lanes(law: SensorLaw32, beta: wp.float32) -> bool:
    """Return whether hits of this law can be computed in lanes."""
    return law.kind == MIXTURE and (law.dof == wp.float32(0.0) or law.power > 0) and beta == wp.float32(1.0)


@wp.func
def block_count(beams: int) -> int:
    """Return the number of blocks for a number of beams."""
    return (beams + BLOCK_WIDTH - 1) // BLOCK_WIDTH


@wp.func
def exponential(x: Lanes) -> Lanes:
    """Compute exp(x) of eight numbers to a relative error of 5e-6, x clipped at -41 and 41."""
    # Taylor's series at x / 64, squared six times. The exponential of the C library takes one number only.
    one = Lanes(wp.float32(1.0))
    most = Lanes(MAX_EXPONENT)
    z = wp.float32(1.0 / 64.0) * wp.max(wp.min(x, most), -most)
    y = one + wp.float32(1.0 / 8.0) * z
    y = one + wp.float32(1.0 / 7.0) * wp.cw_mul(z, y)
    y = one + wp.float32(1.0 / 6.0) * wp.cw_mul(z, y)
    y = one + wp.float32(1.0 / 5.0) * wp.cw_mul(z, y)
    y = one + wp.float32(1.0 / 4.0) * wp.cw_mul(z, y)
    y = one + wp.float32(1.0 / 3.0) * wp.cw_mul(z, y)
    y = one + wp.float32(1.0 / 2.0) * wp.cw_mul(z, y)
    y = one + wp.cw_mul(z, y)
    for _ in range(6):  # Warp unrolls this loop
        y = wp.cw_mul(y, y)
    return y


@wp.func
def square_root(x: Lanes) -> Lanes:
    """Return the square root of each number."""
    out = Lanes()
    for j in range(BLOCK_WIDTH):
        out[j] = wp.sqrt(x[j])
    return out


@wp.func
def positive(x: Lanes) -> Lanes:
    """Return 1 where a number is positive, 0 where it is not."""
    return wp.max(wp.min(STEEP_SLOPE * x, Lanes(wp.float32(1.0))), Lanes(wp.float32(0.0)))


@wp.func
def meeting_chance_lanes(offset: Lanes, across: Lanes) -> Lanes:
    """Compute `meeting_chance_at` for each beam."""
    one = Lanes(wp.float32(1.0))
    r = wp.cw_div(wp.cw_mul(offset, offset), CROSSING_WIDTH_SQ * across)
    return wp.cw_div(one, one + wp.cw_mul(r, wp.cw_mul(r, r)))


@wp.func
def stop_density_lanes(law: SensorLaw32, reading: Lanes, decay: Lanes, distance: Lanes, variance: Lanes) -> Lanes:
    """Compute `stop_density` of finite readings, for a mixture that `fits_lanes`."""
    # returns: 1 if the stop lies within the sensor's range (for normal noise, also near the reading), else 0.
    one = Lanes(wp.float32(1.0))
    scale = Lanes(law.sigma_m) + law.sigma_per_m * distance
    total = wp.cw_mul(scale, scale) + variance
    error = reading - distance
    square = wp.cw_mul(error, error)
    limit = Lanes(law.max_m)
    returns = positive(limit - distance)
    precision = wp.cw_div(one, total)
    standard_sq = wp.cw_mul(square, precision)
    # Density of the noise.
    noise = one
    if law.power > 0:
        base = one + (wp.float32(1.0) / law.dof) * standard_sq
        product = base
        if law.half_power > 0:
            product = wp.cw_mul(base, square_root(base))
        for _ in range(1, law.power):
            product = wp.cw_mul(product, base)
        noise = wp.cw_div(one, product)
    else:
        returns = wp.cw_mul(returns, positive(wp.float32(FAR_SQ) * total - square))
        noise = exponential(wp.float32(-0.5) * standard_sq)
    noise = wp.cw_mul(noise, square_root(precision))
    # Add returns, random readings and passing objects.
    decay_at_stop = wp.cw_mul(decay, exponential(law.rate_short_per_m * error))
    unblocked = (wp.float32(1.0) - law.p_short) * one + law.p_short * decay_at_stop
    returned = law.p_not_random * law.p_return * law.height * wp.cw_mul(unblocked, wp.cw_mul(returns, noise))
    before = positive(wp.min(distance, limit) - reading)
    return Lanes(law.uniform) + returned + law.passing * wp.cw_mul(before, decay)


@wp.func
def stopped_blocks_begin(passing: int) -> int:
    """Return where a cell's blocks of stopped beams begin, relative to its first lane: after the passing beams."""
    return PRODUCT_LANES + PASSING_LANES * block_count(passing)


@wp.func
def write_line(blocks: LaneBlocks, row: int, begin: int, lanes: int, i: int, line: wp.vec3) -> int:
    """Write the line of beam i to the blocks of ``lanes`` lanes from ``begin`` on. Returns the index of its offset."""
    first = (begin + lanes * (i // BLOCK_WIDTH)) * BLOCK_WIDTH + i % BLOCK_WIDTH
    blocks.numbers[row, first + OFFSET * BLOCK_WIDTH] = line[0]
    blocks.numbers[row, first + LINE_X * BLOCK_WIDTH] = line[1]
    blocks.numbers[row, first + LINE_Y * BLOCK_WIDTH] = line[2]
    return first


@wp.func
def write_stopped(blocks: LaneBlocks, row: int, begin: int, i: int, line: wp.vec3, numbers: wp.vec4):
    """Write the i-th stopped beam to the blocks from ``begin`` on; numbers: centre, reading, decay, and 1 to count."""
    first = write_line(blocks, row, begin, STOPPED_LANES, i, line)
    blocks.numbers[row, first + CENTRE * BLOCK_WIDTH] = numbers[0]
    blocks.numbers[row, first + READING * BLOCK_WIDTH] = numbers[1]
    blocks.numbers[row, first + DECAY * BLOCK_WIDTH] = numbers[2]
    blocks.numbers[row, first + COUNTS * BLOCK_WIDTH] = numbers[3]


@wp.func
def fill_blocks(likelihood: StopLikelihood, blocks: LaneBlocks, row: int, beams: CellBeams) -> CellBlocks:
    """Copy a cell's beams to its blocks. Stopped beams that lanes cannot compute move to the head of their list."""
    if not fits_lanes(likelihood.law, likelihood.beta):
        return CellBlocks(-1, 0, 0, 0)
    rays = likelihood.rays
    endpoints = likelihood.endpoints
    # Passing beams, and beams far away that fill the last block.
    n_passing = beams.passing_end - beams.passing_begin
    begin = blocks.begin[beams.number]
    passing_lane = begin + PRODUCT_LANES
    for i in range(n_passing):
        line = endpoints.line[beams.entries[beams.passing_begin + i]]
        write_line(blocks, row, passing_lane, PASSING_LANES, i, line)
    far_line = wp.vec3(FAR_OFFSET_M, wp.float32(0.0), wp.float32(1.0))
    for i in range(n_passing, BLOCK_WIDTH * block_count(n_passing)):
        write_line(blocks, row, passing_lane, PASSING_LANES, i, far_line)
    # Stopped beams, and beams that do not count.
    stopped_lane = begin + stopped_blocks_begin(n_passing)
    n_others = int(0)
    n_stopped = int(0)
    for i in range(beams.stopped_begin, beams.stopped_end):
        incidence = beams.entries[i]
        beam = endpoints.beam[incidence]
        centre_and_range = endpoints.centre_and_range[incidence]
        if endpoints.entry[incidence] >= rays.first_near[beam] and wp.isfinite(centre_and_range[1]):
            numbers = wp.vec4(centre_and_range[0], centre_and_range[1], rays.decay[beam], wp.float32(1.0))
            write_stopped(blocks, row, stopped_lane, n_stopped, endpoints.line[incidence], numbers)
            n_stopped = n_stopped + 1
        else:
            head = beams.stopped_begin + n_others
            beams.entries[i] = beams.entries[head]
            beams.entries[head] = incidence
            n_others = n_others + 1
    no_line = wp.vec3(wp.float32(0.0), wp.float32(0.0), wp.float32(1.0))
    for i in range(n_stopped, BLOCK_WIDTH * block_count(n_stopped)):
        write_stopped(blocks, row, stopped_lane, i, no_line, wp.vec4())
    return CellBlocks(row, begin, n_passing, n_stopped)


@wp.func
def log_product(blocks: LaneBlocks, row: int, begin: int) -> wp.float64:
    """Return the log of the product of all lanes at ``begin``, or UNKNOWN if one of them was too small."""
    if wp.min(blocks.lanes[row, begin + 1]) < MIN_LANE_PRODUCT:
        return UNKNOWN
    product = wp.float64(1.0)
    lanes = blocks.lanes[row, begin]
    for j in range(BLOCK_WIDTH):
        product = product * wp.float64(lanes[j])
    return wp.log(product)


# In the loops over lanes the product and the smallest product so far are stored in every round, because compilers
# vectorise eight lanes that are stored together.


@wp.func
def log_stops_in_lanes(
    law: SensorLaw32, blocks: LaneBlocks, cell_blocks: CellBlocks, centre: wp.vec2, cell: Cell, least: wp.float64
) -> wp.float64:
    """Compute `log_stops` of the beams in a cell's own blocks, or UNKNOWN if a product was too small."""
    # Stopped beams: the arithmetic of `cross_at` and `stop_density`. Densities are relative to the law's peak.
    row, begin = cell_blocks.row, cell_blocks.begin
    one = Lanes(wp.float32(1.0))
    l11, l21, l22 = cell[L11], cell[L21], cell[L22]
    area = l11 * l22
    dx, dy = cell[MEAN_X] - centre[0], cell[MEAN_Y] - centre[1]  # mean relative to the cell's centre
    stopped_begin = begin + stopped_blocks_begin(cell_blocks.n_passing)
    stopped_blocks = block_count(cell_blocks.n_stopped)
    highest = wp.float64(wp.max(cell[REFLECTIVITY], MIN_FACTOR)) * wp.float64(law.peak)
    total = wp.float64(cell_blocks.n_stopped) * wp.log(highest)
    per_peak = wp.float32(1.0) / law.peak
    for chunk in range(0, stopped_blocks, CHUNK_BLOCKS):
        product = one
        smallest = one
        for i in range(chunk, wp.min(chunk + CHUNK_BLOCKS, stopped_blocks)):
            lane = stopped_begin + STOPPED_LANES * i  # the block's first
            ux = blocks.lanes[row, lane + LINE_X]
            uy = blocks.lanes[row, lane + LINE_Y]
            offset = blocks.lanes[row, lane + OFFSET] + dy * ux - dx * uy
            ahead = blocks.lanes[row, lane + CENTRE] + dx * ux + dy * uy
            across_1 = l21 * ux - l11 * uy
            across_2 = l22 * ux
            along_1 = l11 * ux + l21 * uy
            along_2 = l22 * uy
            depth = wp.max(ahead, Lanes(wp.float32(0.0)))
            body = wp.cw_mul(across_1, across_1) + wp.cw_mul(across_2, across_2)
            unsure = surface.DIRECTION_SQ * wp.cw_mul(depth, depth)
            per_across = wp.cw_div(one, body + unsure)
            slope = wp.cw_mul(wp.cw_mul(along_1, across_1) + wp.cw_mul(along_2, across_2), per_across)
            distance = wp.max(ahead - wp.cw_mul(slope, offset), Lanes(wp.float32(0.0)))
            along = wp.cw_mul(along_1, along_1) + wp.cw_mul(along_2, along_2)
            variance = wp.cw_mul(Lanes(area * area) + wp.cw_mul(unsure, along), per_across)
            reading = blocks.lanes[row, lane + READING]
            p = stop_density_lanes(law, reading, blocks.lanes[row, lane + DECAY], distance, variance)
            factor = wp.max(per_peak * wp.cw_mul(meeting_chance_lanes(offset, body), p), Lanes(MIN_FACTOR))
            counts = blocks.lanes[row, lane + COUNTS]
            product = wp.cw_mul(product, wp.cw_mul(counts, factor) + (one - counts))
            smallest = wp.min(smallest, product)
            blocks.lanes[row, begin] = product
            blocks.lanes[row, begin + 1] = smallest
        log_stopped = log_product(blocks, row, begin)
        if log_stopped == UNKNOWN:
            return UNKNOWN
        total += log_stopped
    if total < least:
        return total
    return add_passing_in_lanes(total, blocks, cell_blocks, dx, dy, cell, least)


@wp.func
def add_passing_in_lanes(
    total: wp.float64, blocks: LaneBlocks, cell_blocks: CellBlocks, dx: wp.float32, dy: wp.float32, cell: Cell,
    least: wp.float64,
) -> wp.float64:  # fmt: skip
    """Add the log-likelihood of a cell's passing beams to ``total``; UNKNOWN if a product was too small."""
    # The arithmetic of `meeting_chance`. A sum below ``least`` is returned unfinished.
    row, begin = cell_blocks.row, cell_blocks.begin
    one = Lanes(wp.float32(1.0))
    l11, l21, l22 = cell[L11], cell[L21], cell[L22]
    reflectivity = cell[REFLECTIVITY]
    passing_blocks = block_count(cell_blocks.n_passing)
    for chunk in range(0, passing_blocks, CHUNK_BLOCKS):
        product = one
        smallest = one
        for i in range(chunk, wp.min(chunk + CHUNK_BLOCKS, passing_blocks)):
            lane = begin + PRODUCT_LANES + PASSING_LANES * i  # the block's first
            ux = blocks.lanes[row, lane + LINE_X]
            uy = blocks.lanes[row, lane + LINE_Y]
            across_1 = l21 * ux - l11 * uy
            across_2 = l22 * ux
            across = wp.cw_mul(across_1, across_1) + wp.cw_mul(across_2, across_2)
            chance = meeting_chance_lanes(blocks.lanes[row, lane + OFFSET] + dy * ux - dx * uy, across)
            product = wp.cw_mul(product, wp.max(one - reflectivity * chance, Lanes(MIN_FACTOR)))
            smallest = wp.min(smallest, product)
            blocks.lanes[row, begin] = product
            blocks.lanes[row, begin + 1] = smallest
        log_passing = log_product(blocks, row, begin)
        if log_passing == UNKNOWN:
            return UNKNOWN
        total += log_passing
        if total < least:
            return total
    return total
