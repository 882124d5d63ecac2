"""Count the beams stopped inside each square of the grid, and the beams that pass it, for maps of surfaces.

A surface may extend beyond the square of its cell. So a beam's stop is counted in the square that holds the point at
which it was stopped, and q ~ Beta(a + S, b + P) of a square follows (docs/surfaces.md, "What a map of surfaces shows").
If a surface stops a beam at about t* with variance s^2 (`bayesmap.beams.rays`), the distance t of the point follows

    p(t | z) proportional to N(t; t*, s^2) p(z | t).

Under a mixture this is N(t*, s^2), or proportional to N(t; t*, s^2) N(t; z, sigma^2) if the reading returned from the
point. Under a tabulated law t is chosen from candidates with weights p(t | z) / q(t) (sampling importance resampling,
Rubin 1987). Half lie at quantiles of the surface's law, half at quantiles of the law that the reading suggests, evenly
spread with one random shift; q is the density of both halves together.
"""

from typing import Any, NamedTuple

import numpy as np
import warp as wp

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import ONE, Float32s, Int32s, Ints, Singles, Uint8s
from bayesmap.kernels.law_table import readings_scale_m, table_log_density
from bayesmap.kernels.random import BEAMS, CELLS, beta_or_zero, normal, random_bits, sweep_key, to_uniform
from bayesmap.kernels.rays import Lines, chord, line_of, lines_to_device
from bayesmap.kernels.sensor_law import TABLE, SensorLaw32, mixed_density, returned_density, variance_at
from bayesmap.kernels.surfaces.cell_draws import PER_CELL
from bayesmap.kernels.surfaces.stops import ChainArrays, TracedRays
from bayesmap.kernels.surfaces.surface import PriorArrays, pseudo_counts

wp.set_module_options({"enable_backward": False})
CANDIDATES = wp.constant(32)  # candidates for a beam's point under a tabulated law
CANDIDATES_PER_LAW = wp.constant(16)  # of each of the two laws
PER_CANDIDATE = wp.constant(wp.float64(1.0 / 16.0))  # 1 / CANDIDATES_PER_LAW
LOGISTIC_SCALE = wp.constant(wp.float64(0.6))  # scale of a logistic for a normal: longer tails, known quantiles
MIN_VARIANCE = wp.constant(wp.float64(1.0e-12))  # square metres: a thinner surface counts as one point
IMPOSSIBLE = wp.constant(wp.float64(-1.0e300))  # log weight of an impossible candidate
AT_SQUARE = wp.constant(wp.uint64(640))  # random counter of a cell in part CELLS, apart from those of `cell_draws`
AT_POINTS = wp.constant(wp.uint64(5 << 32))  # first random counter of the beams' points, in part BEAMS


@wp.func
def draw_stop_point_m(
    law: SensorLaw32, reading: wp.float32, decay: wp.float32, distance: wp.float32, variance: wp.float32,
    key: wp.uint64, counter: wp.uint64,
) -> wp.float64:  # fmt: skip
    """Draw where a beam was stopped, metres >= 0, given its reading and that one's `object_decay`; takes 4 counters."""
    mean = wp.float64(distance)
    variance_m2 = wp.float64(variance)
    if law.kind == TABLE:
        if variance_m2 > MIN_VARIANCE:
            return wp.max(draw_point_by_table_m(law, reading, mean, variance_m2, key, counter), wp.float64(0.0))
        return wp.max(mean, wp.float64(0.0))
    if wp.isfinite(reading):
        returned = returned_density(law, reading, decay, distance, variance)
        u = wp.float32(to_uniform(random_bits(key, counter)))
        if u * mixed_density(law, reading, decay, distance, returned) < returned:
            total = wp.float64(variance_at(law, distance, variance))
            mean += variance_m2 / total * (wp.float64(reading) - mean)
            variance_m2 = variance_m2 * (total - variance_m2) / total
    point = mean + wp.sqrt(wp.max(variance_m2, wp.float64(0.0))) * normal(key, counter + wp.uint64(1))
    return wp.max(point, wp.float64(0.0))


@wp.func
def logistic_density(x: wp.float64, middle: wp.float64, scale: wp.float64) -> wp.float64:
    """Return the density of the logistic distribution."""
    e = wp.exp(-wp.abs(x - middle) / scale)
    return e / (scale * (wp.float64(1.0) + e) * (wp.float64(1.0) + e))


@wp.func
def draw_point_by_table_m(
    law: SensorLaw32, reading: wp.float32, mean: wp.float64, variance: wp.float64, key: wp.uint64, counter: wp.uint64
) -> wp.float64:
    """Draw the distance under a tabulated law, metres; it may be negative."""
    # Middle and scale of the two laws of candidates: the surface's, and the one that the reading suggests.
    scale = LOGISTIC_SCALE * wp.sqrt(variance)
    suggested = mean
    suggested_scale = scale
    if wp.isfinite(reading):
        sigma = wp.float64(readings_scale_m(law.table, wp.float32(mean), law.max_m))
        total = variance + sigma * sigma
        suggested = mean + variance / total * (wp.float64(reading) - mean)
        suggested_scale = LOGISTIC_SCALE * wp.sqrt(variance * sigma * sigma / total)
    shift = to_uniform(random_bits(key, counter))
    choice = to_uniform(random_bits(key, counter + wp.uint64(1)))
    # Weights are summed relative to the largest so far. Each candidate replaces the chosen one with its share of the
    # weights so far. One uniform number serves all choices: it is rescaled to be uniform again after each.
    chosen = mean
    largest = IMPOSSIBLE
    total_weight = wp.float64(0.0)
    candidate = int(0)
    while candidate < CANDIDATES:
        middle = mean
        width = scale
        rank = candidate
        if candidate >= CANDIDATES_PER_LAW:
            middle = suggested
            width = suggested_scale
            rank = candidate - CANDIDATES_PER_LAW
        candidate = candidate + 1
        u = (wp.float64(rank) + shift) * PER_CANDIDATE
        t = middle + width * wp.log(u / (ONE - u))
        log_weight = wp.float64(table_log_density(law, reading, wp.float32(t), wp.float32(0.0)))
        log_weight -= wp.float64(0.5) * (t - mean) * (t - mean) / variance
        log_weight -= wp.log(logistic_density(t, mean, scale) + logistic_density(t, suggested, suggested_scale))
        if t < wp.float64(0.0):
            log_weight = IMPOSSIBLE
        if log_weight > largest:
            total_weight = total_weight * wp.exp(largest - log_weight)
            largest = log_weight
        weight = wp.exp(log_weight - largest)
        total_weight += weight
        p = weight / total_weight
        if choice <= p:  # rounding may have made it one
            chosen = t
            choice = choice / p
        else:
            choice = (choice - p) / (ONE - p)
    return chosen


@wp.struct
class SquareArrays:
    """The squares of the grid: counts of one chain's beams for each, and the chances drawn for each touched square."""

    lines: Lines  # lines of the beams
    touched: Int32s  # cells of the touched squares, flat
    crossings: Int32s  # beams that cross the square, or would if they were not stopped before it
    stopped_inside: Int32s
    stopped_before: Int32s
    drawn: Float32s  # chance q drawn for each touched square
    expected: Float32s  # mean of q given the counts


@wp.kernel
def count_in_squares(
    chain: int, sweep: int, law: SensorLaw32, rays: TracedRays, state: ChainArrays, squares: SquareArrays
):
    """One thread per beam of a chain: count it as stopped in one square, and as stopped before each square behind."""
    beam = wp.tid()
    index = chain * state.n_beams + beam  # index in the arrays of all chains
    begin, end = rays.offsets[beam], rays.offsets[beam + 1]
    stop = state.stop[index]
    if stop < begin or stop >= end:
        return  # no surface stopped it
    counter = AT_POINTS + wp.uint64(beam) * wp.uint64(4)  # `draw_stop_point_m` takes four
    moments = state.stop_moments[index]
    key = sweep_key(state.keys[chain], sweep, BEAMS)
    point = draw_stop_point_m(law, rays.range_m[beam], rays.decay[beam], moments[0], moments[1], key, counter)
    line = line_of(squares.lines, beam)
    # From the last entry back to the square that holds the point.
    entry = end - 1
    interval = chord(line, rays.cells[entry])
    if point > interval[1]:  # further than the beam is followed
        return
    while entry > begin and interval[0] > point:
        wp.atomic_add(squares.stopped_before, rays.cells[entry], 1)
        entry -= 1
        interval = chord(line, rays.cells[entry])
    wp.atomic_add(squares.stopped_inside, rays.cells[entry], 1)


@wp.kernel
def draw_stop_chances(
    chain: int, sweep: int, prior: PriorArrays, state: ChainArrays, squares: SquareArrays, solid: Uint8s, is_kept: int
):
    """One thread per touched cell: draw q from its Beta posterior, compute its mean; count it if ``is_kept`` is 1."""
    i = wp.tid()
    cell = squares.touched[i]
    index = chain * state.n_cells + cell
    arrived = squares.crossings[cell] - squares.stopped_before[cell]
    counts = pseudo_counts(prior, solid[cell])
    a = counts[0] + wp.float64(squares.stopped_inside[cell])
    b = counts[1] + wp.float64(arrived - squares.stopped_inside[cell])
    key = sweep_key(state.keys[chain], sweep, CELLS)
    squares.drawn[i] = wp.float32(beta_or_zero(a, b, key, wp.uint64(cell) * PER_CELL + AT_SQUARE))
    squares.expected[i] = wp.float32(a / (a + b))
    if is_kept != 0:
        state.observed_counts[index] = state.observed_counts[index] + wp.vec2i(wp.where(arrived > 0, 1, 0), 1)


class SquareCounts(NamedTuple):
    """Counts of each touched square, (T,) each: beams stopped, beams passed, chance of a stop drawn, and its mean."""

    stopped: Ints
    passed: Ints
    drawn: Singles
    expected: Singles


def square_arrays(rays: Rays, chains: int, device: str) -> list[Any]:
    """Return working memory for the counts of each chain."""
    by_cell, by_touched = (rays.grid.n_cells,), (len(rays.touched),)
    lines = lines_to_device(rays.start_m, rays.direction, rays.grid, device)
    counts = np.bincount(rays.cells, minlength=rays.grid.n_cells)
    touched, crossings = (devices.to_device(a, wp.int32, device) for a in (rays.touched, counts))
    shared = {"lines": lines, "touched": touched, "crossings": crossings}
    own = {"stopped_inside": by_cell, "stopped_before": by_cell, "drawn": by_touched, "expected": by_touched}
    return [devices.pack(SquareArrays, device, **shared, **own) for _ in range(chains)]
