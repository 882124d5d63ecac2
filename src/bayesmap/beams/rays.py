"""Rays: the cells of a grid that each beam crosses, where it crosses them, and where it may stop.

Rays store the cells only, 4 bytes for each. Where a beam enters and leaves a cell follows from its line and the cell's
square (`Rays.chords`; `bayesmap.kernels.rays.chord` compiled):

    t_in  = max over axes of (side that the beam enters by - start) / direction
    t_out = min over axes of (side that it leaves by - start) / direction

(the slab method: Kay and Kajiya, *Ray tracing complex scenes*, 1986), with three rules for a touch:

- the cell in which a beam starts is met where the beam leaves it, as in the tutorial: t_in = t_out;
- a cell that is touched in a corner only has a chord of no length;
- an axis along which the beam does not move (a direction cosine below `PARALLEL`) limits nothing.

`stops_of` is the plain reference for every kernel that draws or predicts stops.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bayesmap.sensors.model import RangeLimits
from bayesmap.space.arrays import Floats, Ints, Mask, Singles
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

MAX_INCIDENCES = 2**31 - 1  # most entries: their indices have 32 bits
TIE = 1.0e-9  # cells: a start closer than this to a grid line lies on it
PARALLEL = 1.0e-10  # direction cosines below this count as zero, as in the tutorial
CROSSING_WIDTH = 2.2  # w in `stops_of`
DIRECTION_RAD = 0.005  # omega in `stops_of`: 4 to 8 mrad predict held-out scans best (docs/lab/surfaces.md)


@dataclass(frozen=True, eq=False)
class Rays:
    """B beams and the cells that each touches, in order: K entries, or incidences. Metres from the grid's corner."""

    grid: Grid  # the grid that has the cells
    offsets: Ints  # the entries of beam b are offsets[b]:offsets[b + 1], (B + 1,)
    cells: Ints  # flat index x * ny + y of the touched cell, (K,)
    first_near: Ints  # first entry of each beam at which a stop may explain the reading, (B,)
    start_m: Floats  # start of each beam, (B, 2)
    direction: Floats  # unit vector of each beam, (B, 2)
    range_m: Floats  # reading of each beam, coded as in `bayesmap.space.scans.Scans`, (B,)
    limits: RangeLimits  # the sensor's least and largest range

    @property
    def n_beams(self) -> int:
        """The number of beams."""
        return len(self.range_m)

    @property
    def n_incidences(self) -> int:
        """The number of entries, K: the work of one sweep."""
        return len(self.cells)

    @property
    def lengths(self) -> Ints:
        """The number of cells that each beam touches, (B,)."""
        return np.diff(self.offsets)

    def select(self, beams: NDArray[np.integer]) -> "Rays":
        """Return the rays of the beams of these indices, in their order."""
        lengths = self.lengths[beams]
        offsets = np.concatenate([[0], np.cumsum(lengths)]).astype(np.int32)
        entries = np.repeat(self.offsets[beams] - offsets[:-1], lengths) + np.arange(offsets[-1])
        return Rays(
            grid=self.grid, offsets=offsets, cells=self.cells[entries], limits=self.limits,
            first_near=offsets[:-1] + self.first_near[beams] - self.offsets[beams], start_m=self.start_m[beams],
            direction=self.direction[beams], range_m=self.range_m[beams],
        )  # fmt: skip

    def beam_of_entry(self) -> Ints:
        """Return the beam of each entry, (K,)."""
        return np.repeat(np.arange(self.n_beams, dtype=np.int32), self.lengths)

    @cached_property
    def touched(self) -> Ints:
        """The flat indices of the cells that any beam touches, ascending, (T,)."""
        return np.flatnonzero(self.touched_map()).astype(np.int32)

    def touched_map(self) -> Mask:
        """Return the mask of the cells that some beam touches, (nx, ny)."""
        is_touched = np.zeros(self.grid.n_cells, dtype=np.bool_)
        is_touched[self.cells] = True
        return is_touched.reshape(self.grid.shape)

    def chords(self) -> tuple[Floats, Floats]:
        """Return where each beam enters and leaves each of its cells, metres, (K,) each: the plain reference."""
        beam, ny = self.beam_of_entry(), self.grid.shape[1]
        enter, leave = np.zeros(len(beam)), np.full(len(beam), np.inf)
        holds_start = np.ones(len(beam), dtype=np.bool_)  # mask of entries of the cell that holds the start
        for axis, cell in enumerate((self.cells // ny, self.cells % ny)):
            start, cosine = self.start_m[:, axis] / self.grid.resolution, self.direction[:, axis]
            moves = np.abs(cosine) >= PARALLEL
            length_per_cell = 1.0 / np.where(moves, cosine, 1.0)
            first_cell = np.where(cosine > 0, np.ceil(start - TIE) - 1, np.floor(start + TIE))
            side_in = cell + (cosine < 0)[beam]
            t_in = (side_in - start[beam]) * length_per_cell[beam]
            t_out = (side_in + np.sign(cosine)[beam] - start[beam]) * length_per_cell[beam]
            enter = np.where(moves[beam], np.maximum(enter, t_in), enter)
            leave = np.where(moves[beam], np.minimum(leave, t_out), leave)
            holds_start &= ~moves[beam] | (cell == first_cell[beam])
        leave = np.maximum(leave, 0.0)
        enter = np.where(holds_start, leave, enter)
        return enter * self.grid.resolution, np.maximum(leave, enter) * self.grid.resolution

    def stop_distance_m(self, hit_depth: float) -> Singles:
        """Return the distance of a stop in each cell, at the share ``hit_depth`` of the chord, metres, (K,)."""
        enter, leave = self.chords()
        return (enter + hit_depth * (leave - enter)).astype(np.float32)

    def end_points_m(self) -> Floats:
        """Return the end point of each reading, (B, 2), or NaN if the reading is not a range."""
        range_m = np.where(np.isfinite(self.range_m), self.range_m, np.nan)
        return np.asarray(self.start_m + range_m[:, None] * self.direction)

    @cached_property
    def columns(self) -> Ints:
        """The position of each entry's cell among the touched cells, (K,), for maps of touched cells only."""
        column_of_cell = np.empty(self.grid.n_cells, dtype=np.int32)
        column_of_cell[self.touched] = np.arange(len(self.touched), dtype=np.int32)
        return column_of_cell[self.cells]


def around_readings(scans: Scans, margin_m: float | Floats, resolution_m: float) -> tuple[Floats, Floats]:
    """Return ``reach_m`` and ``near_m`` of `trace_rays` for each beam, (B,): weigh stops only around the readings.
    If a reading is not a range, they are the sensor's largest range and 0. ``margin_m`` is the largest distance of a
    stop from its reading, one number or one per beam. Stops are weighed from one cell before the margin on.
    """
    range_m = scans.ranges_m.ravel()
    is_hit = np.isfinite(range_m)
    hit_m = np.where(is_hit, range_m, 0.0)
    reach_m = np.where(is_hit, hit_m + margin_m, scans.max_range_m)
    return reach_m, np.where(is_hit, np.maximum(hit_m - margin_m - resolution_m, 0.0), 0.0)


class Stops(NamedTuple):
    """The stop that a map offers at every entry of rays, (K,) each."""

    chance: Floats  # chance that a beam which reaches the entry's cell is stopped in it
    distance_m: Floats  # mean distance of the stop
    spread_m: Floats  # standard deviation of the distance


def stops_of(rays: Rays, cell_stops: NDArray[np.floating], hit_depth: float) -> Stops:
    """Compute the stops that a map offers to rays.

    ``cell_stops`` are stop probabilities of the cells, (N,), at ``hit_depth`` of their chords, or surfaces, (N, 6):
    reflectivity m, mean mu in metres from the grid's lower left corner, and l11, l21, l22 of the covariance Sigma = L
    L' of the points where beams stop. A beam from p in direction u, with normal n, passes the mean at the offset
    o = n . (mu - p). Across the beam the surface has the variance v^2 = n' Sigma n. The beam meets it with probability

        g = 1 / (1 + (o / (w v))^6)

    which is nearly one where it crosses the surface's body and nearly zero beside it (docs/surfaces.md). It is then
    stopped with probability m, at a distance t ~ N(t*, s^2), the law of a point of the surface *if it is on the beam*:

        t* = u . (mu - p) - (u' Sigma n / c^2) o        s^2 = u' Sigma u - (u' Sigma n)^2 / c^2

    A beam's direction is known up to an angle omega only, so c^2 = v^2 + (omega d)^2 at the mean's distance d = u .
    (mu - p). The probability g keeps v: with c in it, held-out scans were predicted worse.
    """
    entry_stops = np.asarray(cell_stops, dtype=np.float64)[rays.cells]
    if entry_stops.ndim == 1:
        enter, leave = rays.chords()
        return Stops(entry_stops, enter + hit_depth * (leave - enter), np.zeros(len(entry_stops)))
    # The mean of each surface, along the beam (depth) and across it (offset).
    beam = rays.beam_of_entry()
    direction = rays.direction[beam]
    normal = np.stack([-direction[:, 1], direction[:, 0]], axis=-1)
    to_mean = entry_stops[:, 1:3] - rays.start_m[beam]
    depth, offset = (to_mean * direction).sum(axis=-1), (to_mean * normal).sum(axis=-1)
    l11, l21, l22 = entry_stops[:, 3:].T
    u_1, u_2 = l11 * direction[:, 0] + l21 * direction[:, 1], l22 * direction[:, 1]  # L' u
    n_1, n_2 = l11 * normal[:, 0] + l21 * normal[:, 1], l22 * normal[:, 1]  # L' n
    v_sq = n_1**2 + n_2**2
    u_sigma_n = u_1 * n_1 + u_2 * n_2
    g = 1.0 / (1.0 + (offset**2 / (CROSSING_WIDTH**2 * v_sq)) ** 3)
    direction_variance = (DIRECTION_RAD * np.maximum(depth, 0.0)) ** 2
    c_sq = v_sq + direction_variance
    distance = np.maximum(depth - u_sigma_n / c_sq * offset, 0.0)
    # s^2 = u' Sigma u - (u' Sigma n)^2 / c^2, without a difference of large numbers.
    variance = ((l11 * l22) ** 2 + direction_variance * (u_1**2 + u_2**2)) / c_sq
    return Stops(entry_stops[:, 0] * g, distance, np.sqrt(variance))
