"""Draw where beams stop in maps (`draw_scan_stops`), and compute beams' information (`independent_information`).

A *view* is a pose with the beams of a scan that the robot would take there. The information is FSMI, the fast Shannon
mutual information between a beam's reading and a map of independent cells (Zhang, Henderson, Sze and Karaman 2019). Let
the beam meet the cells 1, 2, ... with odds r_1, r_2, ... . A reading in cell k has the information

    C_k = f(hit, r_k) + sum_{i < k} f(pass, r_i),

with the f of `update_information`. It lies in cell k with probability sum_j P(stop in cell j) G_kj, where G_kj is the
probability that the noise about the middle of cell j falls in cell k. FSMI is the mean of C_k over readings.
"""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import HALF, ONE, Float64Rows, Float64s, Floats, Int32s, Vec3ds
from bayesmap.kernels.predict.density import DeviceMaps, Frame, MapArrays, grid_frame, line_in, stop_on_walk
from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.rays import Line, walk_along
from bayesmap.kernels.walk import Walk, advance_walk, is_inside
from bayesmap.space.grid import Grid

wp.set_module_options({"enable_backward": False})
MIN_CHANCE = wp.constant(wp.float64(1.0e-6))  # smaller chances of getting to a cell, or of a stop there, are left out
INTEGRATION_SIGMAS = wp.constant(wp.float64(4.0))  # standard deviations about a stop in which readings are integrated
# Numbers of a cell: probability that it is occupied, and the information of a hit in it and of a pass, in nats.
OCCUPIED, HIT_NATS, PASS_NATS = 0, 1, 2


@wp.struct
class Views:
    """P poses, and the A beams of a scan at each. Beams are numbered pose by pose, from 0 to P A - 1."""

    poses: Float64Rows  # poses in the world frame, (P, 3)
    angles: Float64s  # angles of the beams in the sensor's frame, (A,)
    max_m: wp.float64  # distance to which beams are followed


@wp.func
def line_of_view(frame: Frame, views: Views, beam: int) -> Line:
    """Return the line of a beam of the views."""
    pose = beam / views.angles.shape[0]
    angle = views.poses[pose, 2] + views.angles[beam % views.angles.shape[0]]
    return line_in(frame, views.poses[pose, 0], views.poses[pose, 1], angle)


@wp.kernel
def draw_stop_distances(
    first: int, frame: Frame, maps: MapArrays, views: Views, map_of_pose: Int32s, key: wp.uint64, distance_m: Float64s,
    spread_m: Float64s,
):  # fmt: skip
    """One thread per beam: draw the distance at which it stops, infinite if nowhere, and the distance's spread."""
    # survive: chance of getting to the cell that the walk touches; the beam stops once it is below u.
    beam = first + wp.tid()
    line = line_of_view(frame, views, beam)
    row = map_of_pose[beam / views.angles.shape[0]]
    u = to_uniform(random_bits(key, wp.uint64(beam)))
    survive = wp.float64(1.0)
    distance_m[beam] = wp.float64(wp.inf)
    walk = walk_along(line, frame.nx, views.max_m)
    while walk.distance <= walk.end:
        if is_inside(walk, frame.nx, frame.ny):
            stop = stop_on_walk(maps, row, line, walk)  # chance, distance and spread
            survive = survive * (wp.float64(1.0) - stop[0])
            if survive < u:
                distance_m[beam] = stop[1]
                spread_m[beam] = stop[2]
                return
        walk = advance_walk(walk)


def draw_scan_stops(
    maps: DeviceMaps, poses: Floats, map_of_pose: NDArray[np.intp], angles_rad: Floats, max_m: float, key: int
) -> tuple[Floats, Floats]:
    """Draw the distances at which beams stop, from poses in the world frame, (P, 3), each in one of the maps.
    ``map_of_pose`` is the number of each pose's map, (P,), and ``angles_rad`` are the beams' angles in the sensor's
    frame, (A,). Returns distances, at most ``max_m`` or infinite, and their standard deviations, metres, (P, A) each.
    """
    n_beams = len(poses) * len(angles_rad)
    views = devices.pack(Views, maps.device, poses=poses, angles=angles_rad, max_m=max_m)
    inputs = [grid_frame(maps.grid), maps.arrays, views, map_of_pose, key, (n_beams,), (n_beams,)]
    distance_m, spread_m = devices.launch(draw_stop_distances, n_beams, inputs, maps.device)
    return distance_m.reshape(len(poses), -1), spread_m.reshape(len(poses), -1)


@wp.func
def normal_below(x: wp.float64) -> wp.float64:
    """Return P(standard normal < x)."""
    return wp.float64(0.5) * wp.erfc(-x * wp.float64(0.7071067811865476))  # 1 / sqrt(2)


@wp.func
def is_crossed(walk: Walk) -> bool:
    """Return whether the walk now touches the cell that the beam is in, not a cell at its side."""
    return walk.cell_x == walk.beam_x and walk.cell_y == walk.beam_y


@wp.func
def exit_distance(walk: Walk) -> wp.float64:
    """Return the distance at which the beam leaves the cell that it is in, in cells."""
    return wp.min(walk.next_x, walk.next_y)


@wp.struct
class Passage:
    """A walk, and the information of the cells that its beam has passed. Distances are in cells."""

    walk: Walk
    entered_at: wp.float64  # distance at which the beam enters the cell that it is in
    passed_nats: wp.float64  # information of passing all cells before that one


@wp.func
def pass_cells(passage: Passage, frame: Frame, cells: Vec3ds, limit: wp.float64) -> Passage:
    """Walk on past all cells that the beam leaves before the distance ``limit``."""
    walk = passage.walk
    entered_at = passage.entered_at
    passed_nats = passage.passed_nats
    while exit_distance(walk) < limit and walk.distance <= walk.end:
        if is_crossed(walk):
            entered_at = exit_distance(walk)
            if is_inside(walk, frame.nx, frame.ny):
                passed_nats += cells[walk.cell_x * frame.ny + walk.cell_y][PASS_NATS]
        walk = advance_walk(walk)
    return Passage(walk, entered_at, passed_nats)


@wp.func
def add_stop_information(
    total: wp.float64, frame: Frame, cells: Vec3ds, passage: Passage, middle: wp.float64, sigma: wp.float64,
    chance: wp.float64,
) -> wp.float64:  # fmt: skip
    """Add to ``total`` sum_k G_kj C_k of readings about a stop at ``middle``, times the ``chance`` of the stop."""
    # The readings in cell k are those from where the beam enters it to where the beam leaves it.
    walk = passage.walk
    entered_at = passage.entered_at
    passed_nats = passage.passed_nats
    cdf_at_entry = normal_below((entered_at - middle) / sigma)
    while walk.distance <= walk.end and entered_at < middle + INTEGRATION_SIGMAS * sigma:
        if is_crossed(walk):
            leaves_at = exit_distance(walk)
            cdf_at_exit = normal_below((leaves_at - middle) / sigma)
            if is_inside(walk, frame.nx, frame.ny):
                cell = walk.cell_x * frame.ny + walk.cell_y
                total += chance * (cdf_at_exit - cdf_at_entry) * (passed_nats + cells[cell][HIT_NATS])
                passed_nats += cells[cell][PASS_NATS]
            entered_at = leaves_at
            cdf_at_entry = cdf_at_exit
        walk = advance_walk(walk)
    return total


@wp.kernel
def beam_information(first: int, frame: Frame, views: Views, cells: Vec3ds, sigma_m: wp.float64, nats: Float64s):
    """One thread per beam: compute its FSMI, from readings up to `INTEGRATION_SIGMAS` deviations about each stop."""
    # ``walk`` visits the cells j in which the beam may stop. ``passage`` follows it: it has passed the cells before the
    # first cell k that holds readings of a stop in cell j. Distances are in cells.
    beam = first + wp.tid()
    sigma = sigma_m / frame.resolution
    total = wp.float64(0.0)
    survive = wp.float64(1.0)
    walk = walk_along(line_of_view(frame, views, beam), frame.nx, views.max_m)
    entered_at = wp.float64(0.0)  # the walk touches the cell in which it starts at its exit
    passage = Passage(walk, entered_at, wp.float64(0.0))
    while walk.distance <= walk.end and survive > MIN_CHANCE:
        if is_crossed(walk):
            leaves_at = exit_distance(walk)
            if is_inside(walk, frame.nx, frame.ny):
                p = cells[walk.cell_x * frame.ny + walk.cell_y][OCCUPIED]
                chance = survive * p
                survive = survive * (ONE - p)
                if chance > MIN_CHANCE:
                    middle = HALF * (entered_at + leaves_at)
                    passage = pass_cells(passage, frame, cells, middle - INTEGRATION_SIGMAS * sigma)
                    total = add_stop_information(total, frame, cells, passage, middle, sigma, chance)
            entered_at = leaves_at
        walk = advance_walk(walk)
    if survive > MIN_CHANCE:  # a beam that stops nowhere passes every cell
        passage = pass_cells(passage, frame, cells, wp.float64(wp.inf))
        total += survive * passage.passed_nats
    nats[beam] = total


def update_information(factor: float, odds: Floats) -> Floats:
    """Compute FSMI's f(delta, r): the information, in nats, of an update of the odds r by the factor delta."""
    return np.asarray(np.log((odds + 1.0) / (odds + 1.0 / factor)) - np.log(factor) / (odds * factor + 1.0))


def independent_information(
    occupied: Floats, grid: Grid, poses: Floats, angles_rad: Floats, max_m: float, *, sigma_m: float,
    hit_factor: float, pass_factor: float, device: str = "cpu",
) -> Floats:  # fmt: skip
    """Compute FSMI of every beam at poses in the world frame, (P, 3), with a map of independent cells, nats, (P, A).
    *FSMI* (ICRA 2019), equation 14, with the exact integrals of the noise. ``occupied`` are probabilities inside
    (0, 1), (N,), and ``angles_rad`` the beams' angles in the sensor's frame, (A,). Readings up to ``max_m`` have the
    standard deviation ``sigma_m``. A reading in a cell multiplies the cell's odds by ``hit_factor``, over 1, and a
    reading behind it by ``pass_factor``, below 1.
    """
    device = devices.resolve(device)
    n_beams = len(poses) * len(angles_rad)
    odds = occupied / (1.0 - occupied)
    cells = np.stack([occupied, *(update_information(factor, odds) for factor in (hit_factor, pass_factor))], axis=-1)
    views = devices.pack(Views, device, poses=poses, angles=angles_rad, max_m=max_m)
    inputs = [grid_frame(grid), views, cells, sigma_m, (n_beams,)]
    return np.asarray(devices.launch(beam_information, n_beams, inputs, device)[0].reshape(len(poses), -1))
