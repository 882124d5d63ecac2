r"""How many beams are stopped inside each square of the grid, and how many pass it: what maps of surfaces show.

A surface need not lie in the square of the cell that it belongs to, and which of two neighbouring cells a piece of wall
belongs to is a label. So the beams' stops are counted in the squares in which the points lie at which they were
stopped, drawn given the readings (`bayesmap.kernels.surfaces.stop_points`). Squares that the beam crosses before that
point it passes; of those behind it the beam says nothing. With S beams stopped in a square and P beams that pass it,
the chance q that a beam which comes to the square is stopped inside it is drawn from

    q | stops ~ Beta(a + S, b + P)

with a and b of the label of the square's own cell, where cells have labels: that of the map which the sweep began with,
as it is the map that a kept draw shows.
"""

from typing import NamedTuple

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels.random import BEAMS, CELLS, sweep_key
from bayesmap.kernels.rays import Lines, line_of, put_lines, stretch
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.surfaces.cell_draws import PER_CELL
from bayesmap.kernels.surfaces.cell_prior import CellPrior, pseudo_counts
from bayesmap.kernels.surfaces.stop_points import stop_point_m
from bayesmap.kernels.surfaces.stops import ChainArrays, TracedRays
from bayesmap.kernels.surfaces.variates import beta_or_nothing

wp.set_module_options({"enable_backward": False})

AT_SQUARE = wp.constant(wp.uint64(640))  # of the counters of a cell in a sweep
STREAM_POINT = wp.constant(wp.uint64(5 << 32))


@wp.kernel
def count_in_squares(
    chain: int,
    sweep: int,
    law: SensorLaw32,
    lines: Lines,
    rays: TracedRays,
    state: ChainArrays,
    keys: wp.array(dtype=wp.uint64),
    stopped: wp.array(dtype=wp.int32),
    behind: wp.array(dtype=wp.int32),
):
    """One thread a beam of a chain: add one to the square in which it was stopped, and to each that lies behind."""
    b = wp.tid()
    i = chain * state.n_beams + b
    begin = rays.offsets[b]
    end = rays.offsets[b + 1]
    stop = state.stop[i]
    if stop < begin or stop >= end:
        return
    counter = STREAM_POINT + wp.uint64(b) * wp.uint64(4)
    where = state.where[i]
    key = sweep_key(keys[chain], sweep, BEAMS)
    point = stop_point_m(law, rays.range_m[b], rays.decay[b], where[0], where[1], key, counter)
    line = line_of(lines, b)
    k = end - 1
    crossed = stretch(line, rays.cells[k])
    if point > crossed[1]:  # further than the beam is followed
        return
    while k > begin and crossed[0] > point:
        wp.atomic_add(behind, rays.cells[k], 1)
        k -= 1
        crossed = stretch(line, rays.cells[k])
    wp.atomic_add(stopped, rays.cells[k], 1)


@wp.kernel
def draw_stop_chances(
    chain: int,
    sweep: int,
    prior: CellPrior,
    touched: wp.array(dtype=wp.int32),
    keys: wp.array(dtype=wp.uint64),
    crossings: wp.array(dtype=wp.int32),
    stopped: wp.array(dtype=wp.int32),
    behind: wp.array(dtype=wp.int32),
    drawn: wp.array(dtype=wp.float32),
    expected: wp.array(dtype=wp.float32),
    kept: int,
    n_cells: int,
    solid: wp.array(dtype=wp.uint8),
    observed_counts: wp.array(dtype=wp.vec2i),
):
    """One thread a touched cell: q as above, drawn, and its mean (a + S) / (a + b + S + P). ``solid`` are the labels.

    If the draw is kept, ``observed_counts`` counts it, and whether some beam comes to the square in it.
    """
    i = wp.tid()
    c = touched[i]
    here = chain * n_cells + c
    counts = pseudo_counts(prior, solid[c])
    a = counts[0] + wp.float64(stopped[c])
    b = counts[1] + wp.float64(crossings[c] - stopped[c] - behind[c])
    key = sweep_key(keys[chain], sweep, CELLS)
    drawn[i] = wp.float32(beta_or_nothing(a, b, key, wp.uint64(c) * PER_CELL + AT_SQUARE))
    expected[i] = wp.float32(a / (a + b))
    if kept != 0:
        observed_counts[here] = observed_counts[here] + wp.vec2i(wp.where(crossings[c] > behind[c], 1, 0), 1)


class InSquares(NamedTuple):
    """Of every touched cell's square, (T,) each: beams stopped in it, beams that pass it, and the chance that a beam
    which comes to it is stopped in it, drawn given these counts, and its mean.
    """

    stopped: NDArray[np.int32]
    passed: NDArray[np.int32]
    drawn: NDArray[np.float32]
    expected: NDArray[np.float32]


class Squares:
    """Room for each chain's counts, and the beams' lines, on a device."""

    def __init__(self, rays: Rays, chains: int, device: str) -> None:
        self._rays, self._device = rays, device
        cells, touched = rays.grid.n_cells, rays.touched
        self._crossings = np.bincount(rays.cells, minlength=cells).astype(np.int32)
        self._lines = put_lines(rays.start_m, rays.direction, rays.grid, device)
        self._crossings_there = devices.to_device(self._crossings, wp.int32, device)
        self._touched = devices.to_device(touched, wp.int32, device)
        sizes = ((cells, wp.int32), (cells, wp.int32), (len(touched), wp.float32), (len(touched), wp.float32))
        self._room = [[wp.zeros(n, dtype=dtype, device=device) for n, dtype in sizes] for _ in range(chains)]

    def of_chain(
        self,
        chain: int,
        sweep: int,
        law: SensorLaw32,
        prior: CellPrior,
        rays: TracedRays,
        state: ChainArrays,
        keys: wp.array,
        observed_counts: wp.array,
        kept: bool,
        solid: NDArray[np.bool_] | None = None,
    ) -> InSquares:
        """Count a chain's stops, and draw the chances given the counts.

        Args:
            chain: its number on the device.
            sweep: number of the sweep that drew the stops.
            law: of the readings.
            prior: of the cells.
            rays: the beams where kernels read them.
            state: of all chains.
            keys: of all chains' random numbers.
            observed_counts: draws in which a beam says something of each square, and draws, of all chains so far.
            kept: whether this draw counts there.
            solid: labels of all cells when the sweep began, (N,); those that the chain has now if None.
        """
        stopped, behind, drawn, expected = self._room[chain]
        for counts in (stopped, behind):
            counts.zero_()
        inputs = [chain, sweep, law, self._lines, rays, state, keys, stopped, behind]
        wp.launch(count_in_squares, dim=self._rays.n_beams, inputs=inputs, device=self._device)
        cells = self._rays.grid.n_cells
        labels = state.solid[chain * cells : (chain + 1) * cells]
        if solid is not None:
            labels = devices.to_device(solid, wp.uint8, self._device)
        inputs = [
            chain, sweep, prior, self._touched, keys, self._crossings_there, stopped, behind, drawn, expected,
            int(kept), cells, labels, observed_counts,
        ]  # fmt: skip
        wp.launch(draw_stop_chances, dim=len(self._rays.touched), inputs=inputs, device=self._device)
        touched = self._rays.touched
        ends, unseen = (np.asarray(counts.numpy())[touched] for counts in (stopped, behind))
        passed = self._crossings[touched] - ends - unseen
        return InSquares(ends, passed, np.array(drawn.numpy()), np.array(expected.numpy()))
