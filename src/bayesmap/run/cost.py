"""The cost of a run, estimated before it begins: processor time, memory, and the options that make it fit.

A run costs time and memory in proportion to its *incidences*: the cells that a beam crosses, summed over all beams.

Read `estimate` and `Estimate` (the answer), `size_of` (measures scans on a grid), `Sampling.processor_s` and
`Sampling.peak_bytes` (the formulas), and `_remedies`. Each constant names the measurement that it comes from.
docs/scale.md compares estimates with whole runs.
"""

import contextlib
import math
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from bayesmap.cells.arrays import ArraySpec
from bayesmap.cells.binary import Independent
from bayesmap.errors import BadInput
from bayesmap.run.chains import FIRST_MARK_DRAWS, SweepPlan
from bayesmap.space.grid import Grid, outlying, why_outlying
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import steps_m

LONG_S = 60.0  # a run that takes longer is announced
LARGE_MEMORY_SHARE = 0.5  # a run that takes more than this share of the memory is announced
# Files with the memory limit of a container on Linux.
CONTAINER_LIMIT_FILES = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")
MIN_TOUCHED_SHARE = 0.5  # share of the grid's cells that beams touch in a building, at least: 0.6 in most
PROPOSED_SPACINGS_M = (0.1, 0.2, 0.5, 1.0)  # distances between scans that are proposed


def estimate(scans: Scans, grid: Grid, size: "ProblemSize", sampling: "Sampling") -> "Estimate | None":
    """Estimate the cost of a run here, with a remedy if it is long or large, or None for an unknown sampler."""
    if sampling.constants is None:
        return None
    cost = _estimate_without_remedy(size, sampling)
    if cost.is_large:
        return replace(cost, remedy=_options_for_memory(scans, grid, size, sampling))
    return replace(cost, remedy=_option_for_time(scans, size, sampling)) if cost.is_long else cost


def _estimate_without_remedy(size: "ProblemSize", sampling: "Sampling") -> "Estimate":
    plan = sampling.plan
    fewest = plan.draws if plan.precision is None else min(FIRST_MARK_DRAWS, plan.draws)
    fewest, most = min(fewest, 2) if plan.seconds else fewest, plan.draws
    times = sampling.processor_s(size, fewest), sampling.processor_s(size, most)
    processor_s = None if times[0] is None or times[1] is None else (times[0], times[1])
    peak_bytes = sampling.peak_bytes(size, fewest), sampling.peak_bytes(size, most)
    return Estimate(peak_bytes, processor_s, sampling.cores, memory_bytes(), samples_poses=sampling.samples_poses)


@dataclass(frozen=True)
class Estimate:
    """The cost of a run: pairs of the least and the most, since chains end when the map is known."""

    peak_bytes: tuple[float, float]  # peak of the memory
    processor_s: tuple[float, float] | None  # processor time; None if it is not known
    cores: int
    available_bytes: int | None  # memory of the machine; None if not known
    remedy: str = ""  # options of the command line that make it fit, or shorter; empty if it fits or nothing helps
    samples_poses: bool = False  # whether poses are sampled, too

    @property
    def seconds(self) -> tuple[float, float] | None:
        """Least and most seconds on the clock: processor time divided by the cores; None if not known."""
        times = self.processor_s
        return None if times is None else (times[0] / self.cores, times[1] / self.cores)

    @property
    def is_long(self) -> bool:
        """True if the run may take more than `LONG_S`."""
        return self.seconds is not None and self.seconds[1] > LONG_S

    @property
    def is_large(self) -> bool:
        """True if the run may take more than `LARGE_MEMORY_SHARE` of the memory."""
        return self.available_bytes is not None and self.peak_bytes[1] > LARGE_MEMORY_SHARE * self.available_bytes

    @property
    def is_too_large(self) -> bool:
        """True if even the least peak of the run is more than the memory."""
        return self.available_bytes is not None and self.peak_bytes[0] > self.available_bytes

    def words(self) -> str:
        """Return the estimate in words, with the remedy if the run is long or large."""
        available = "" if self.available_bytes is None else f" of {self.available_bytes / 1e9:.0f}"
        text = f"{_range_in_unit(self.peak_bytes, 1e9)}{available} GB of memory"
        if self.seconds is not None:
            unit_s, unit = (3600.0, "hours") if self.seconds[1] > 5400 else (60.0, "minutes")  # 1.5 hours
            unit_s, unit = (1.0, "s") if self.seconds[1] < 100 else (unit_s, unit)
            cores = f"{self.cores} core{'s' * (self.cores > 1)}"
            text = f"{_range_in_unit(self.seconds, unit_s)} {unit} on {cores}, and {text}"
        remedy = f"; less with {self.remedy}" if self.remedy and (self.is_long or self.is_large) else ""
        poses = "; poses are sampled, too, as in all short logs: --fast does not" if self.samples_poses else ""
        return f"about {text}{poses}{remedy}"

    def refuse(self, scans: Scans) -> None:
        """Raise `BadInput` for a run that cannot fit into memory; it names the scan that lies furthest out."""
        if not self.is_too_large:
            return
        assert self.available_bytes is not None
        outliers = outlying(scans)
        remedy = why_outlying(scans, int(outliers[0])) if len(outliers) else f"make it smaller with {self.remedy}"
        need = f"at least {self.peak_bytes[0] / 1e9:.1f} GB, and there are {self.available_bytes / 1e9:.1f}"
        override = "--any-size (in Python bm.Where(any_size=True)) begins all the same"
        raise BadInput(f"memory: this takes {need}: {remedy}; {override}")


def _range_in_unit(bounds: tuple[float, float], unit: float) -> str:
    """Return two numbers in a unit, with about two digits, or one number if both have the same digits."""
    words = [f"{value / unit:.{0 if value >= 9.5 * unit else 1}f}" for value in bounds]
    return " to ".join(dict.fromkeys(words))


def memory_bytes() -> int | None:
    """Return the memory of this machine, or the limit of this container, in bytes, or None if unknown."""
    sizes: list[int] = []
    with contextlib.suppress(AttributeError, OSError, ValueError):
        sizes.append(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    for path in CONTAINER_LIMIT_FILES:
        with contextlib.suppress(OSError, ValueError):  # no such file, or "max" for no limit
            sizes.append(int(Path(path).read_text()))
    return min(sizes, default=None)


CELLS_PER_CELL_LENGTH = 4.0 / math.pi  # mean number of cells that a line of the length of a cell's edge enters
MARGIN_CELLS = 4.0  # traced behind a reading: 1.5 cells and six standard deviations of 4 cm at 10 cm
MAX_MEASURED_BEAMS = 500_000  # if there are more beams, evenly spaced scans are measured
MAX_TRACED_BEAMS = 20_000  # number of beams whose touched cells are counted
POINTS_PER_BEAM = 64  # points at which touched cells are looked up
SQUARE_CELLS = 4  # edge, in cells, of the squares in which touched cells are counted


@dataclass(frozen=True)
class ProblemSize:
    """The counts that decide the cost of a run."""

    beams: float  # number of beams
    incidences: float  # cells that a beam crosses, summed over all beams
    cells: float  # cells of the grid
    touched: float  # cells that some beam touches
    endpoints: float  # cells in which readings end
    readings: float  # readings of the log, which is in memory
    matched: int = 0  # scans whose poses `slam` infers first

    def thinned(self, share: float) -> "ProblemSize":
        """Return the size with a share of the scans. The map of `slam` is made from few scans in any case."""
        thin = replace(self, matched=round(self.matched * share), readings=self.readings * share)
        return thin if self.matched else replace(thin, beams=self.beams * share, incidences=self.incidences * share)

    def coarser(self, factor: float) -> "ProblemSize":
        """Return the size with cells whose edges are longer by a factor."""
        return replace(
            self, incidences=self.incidences / factor, cells=self.cells / factor**2,
            touched=self.touched / factor**2, endpoints=self.endpoints / factor,
        )  # fmt: skip


def size_of(scans: Scans, grid: Grid, log: Scans | None = None) -> ProblemSize:
    """Measure scans on a grid. ``log`` has the scans whose trajectory `slam` infers first; None for `infer`."""
    stride = max(1, math.ceil(scans.ranges_m.size / MAX_MEASURED_BEAMS))
    readings = (scans if log is None else log).ranges_m.size
    scans = scans.select(slice(None, None, stride))
    # Lengths of the beams on the grid, in cells; a beam without return ends at the grid's edge.
    valid = ~np.isnan(scans.ranges_m.ravel())
    ranges_m = scans.ranges_m.ravel()[valid]
    starts = grid.to_cells(scans.beam_starts_world()).reshape(-1, 2)[valid]
    angles_rad = scans.beam_angles_world().ravel()[valid]
    directions = np.stack([np.cos(angles_rad), np.sin(angles_rad)], axis=-1)
    ends_m = np.where(np.isneginf(ranges_m), scans.min_range_m, np.minimum(ranges_m, scans.max_range_m))
    with np.errstate(divide="ignore", invalid="ignore"):
        to_sides = np.where(directions > 0, np.array(grid.shape) - starts, -starts) / directions
    to_edge = np.where(directions == 0, np.inf, to_sides).min(axis=-1)
    lengths = np.clip(np.minimum(ends_m / grid.resolution + MARGIN_CELLS, to_edge), 0.0, None)
    # Count the squares that some beams touch, and the cells in which readings end.
    sampled = slice(None, None, max(1, len(lengths) // MAX_TRACED_BEAMS))
    distances = lengths[sampled, None, None] * np.linspace(0.0, 1.0, POINTS_PER_BEAM)[:, None]
    points = starts[sampled, None] + directions[sampled, None] * distances
    squares = np.floor(points / SQUARE_CELLS).astype(np.int64)
    touched = len(np.unique(squares[..., 0] * (max(grid.shape) + 1) + squares[..., 1])) * SQUARE_CELLS**2
    ends = np.floor(grid.to_cells(scans.hit_points_world())).astype(np.int64)
    endpoints = len(np.unique(ends[:, 0] * (grid.shape[1] + 1) + ends[:, 1]))
    return ProblemSize(
        beams=stride * len(lengths), incidences=stride * CELLS_PER_CELL_LENGTH * float(lengths.sum()),
        cells=grid.n_cells, touched=min(touched, grid.n_cells), endpoints=min(endpoints, grid.n_cells),
        readings=readings, matched=0 if log is None else len(log),
    )  # fmt: skip


@dataclass(frozen=True)
class SamplerCost:
    """The constants of a sampler: nanoseconds of a sweep per unit of work (None: not measured), and bytes."""

    warmup_ns: float | None
    sweep_ns: float | None
    incidence_bytes: float  # bytes per incidence, once for all chains
    chain_incidence_bytes: float  # bytes per chain and incidence
    chain_cell_bytes: float  # bytes per chain and cell
    chain_beam_bytes: float  # bytes per chain and beam


SURFACES = SamplerCost(37.0, 25.0, 16.0, 1.3, 110.0, 20.0)
"""Times: between Intel (6.4 M incidences, 4 x (30 + 50) sweeps, 75 s in all) and five minutes of 720 beams (5.9 M, 82 s
of chains; 212 s with 246 sweeps). The pilot and settling chains take longer sweeps. Bytes: docs/surfaces.md, with a
third of the incidences in endpoint cells."""
REFLECTIVITIES = SamplerCost(22.0, 15.5, 8.0, 0.0, 75.0, 20.0)
"""Times: 0.6 of surfaces (72 ms for 118 ms a sweep of Intel, docs/lab/benchmarks.md). Bytes: docs/surfaces.md."""
WALLS = SamplerCost(6.0, 6.0, 32.0, 0.0, 11.0, 8.0)
"""Times: 28.7 ms a sweep of 6.5 M incidences (docs/lab/benchmarks.md), 7.6 ns in runs. Bytes: docs/beam-table.md."""
BLOCKS = SamplerCost(None, None, 57.0, 0.0, 11.0, 8.0)  # bytes: docs/beam-table.md; times were not measured
TABLE = SamplerCost(None, None, 40.0, 0.0, 32.0, 8.0)
"""Methods without chains: the beam table and the messages of belief propagation; times were not measured."""

TOUCHED_CELL_WORK = 10.0  # units of work per touched cell, 1 per incidence: sweeps of 24, 6, 2 scans take 30, 13, 7 ms
POSES_FACTOR = 3.5  # ratio of a sweep that samples poses, too: 2 to 4 (MIT CSAIL; 305 000 beams of the five minutes)
MATCHING_S_PER_SCAN = 7.4e-3  # time for the trajectory: 22 s for 3000 scans, 90 s for 12 000, of 720 beams
FIXED_S = 8.0  # time for files and pictures: with 40 draws of 1.1 MB 10 s
FILE_S_PER_BYTE = 40e-9  # more time for them: with 200 draws 17 to 20 s
BASE_BYTES = 390e6  # peak of runs of 3000 beams
READING_BYTES = 40.0  # bytes of each reading: measured with 2.2 M readings and `slam`
CELL_BYTES = 100.0  # beside the chains: a map of 2 million cells, three beams and one draw took 101, and 107 a chain


@dataclass(frozen=True)
class Sampling:
    """The settings of a sampler that decide, with the `ProblemSize`, the cost of a run."""

    sampler: str  # name of the sampler, as in `CellPrior.methods`
    arrays: tuple[ArraySpec, ...]  # arrays of a draw
    has_surfaces: bool  # whether cells have surfaces
    chains: int
    plan: SweepPlan
    is_fitted: bool  # whether a pilot chain fits the sensor
    samples_poses: bool  # whether poses are sampled
    cores: int

    @property
    def constants(self) -> SamplerCost | None:
        """The constants of the sampler, or None for one whose cost is not known."""
        stops = SURFACES if self.has_surfaces else REFLECTIVITIES
        costs = {"stop-gibbs": stops, "wall-gibbs": WALLS, "wall-blocks": BLOCKS}
        return costs.get(self.sampler, None if self.sampler == "metropolis" else TABLE)

    def draw_bytes(self, size: ProblemSize) -> float:
        """Return the bytes of a draw of one chain."""
        counts = {"cell": size.cells if self.samples_poses else size.touched, "surface_cell": size.endpoints, "scan": 0}
        total = 0.0
        for spec in self.arrays:
            item_bytes = {"bits": 1 / 8, "half": 2.0}.get(spec.storage, np.dtype(spec.dtype).itemsize)
            total += item_bytes * counts.get(spec.dims[0], size.cells)
        return total

    def peak_bytes(self, size: ProblemSize, draws: int) -> float:
        """Return the peak of the memory in bytes, for a number of draws per chain."""
        cost = self.constants
        assert cost is not None
        # All chains share the problem; each has a state and draws of its own.
        shared = BASE_BYTES + CELL_BYTES * size.cells + cost.incidence_bytes * size.incidences
        state = cost.chain_cell_bytes * size.cells + cost.chain_beam_bytes * size.beams
        state += cost.chain_incidence_bytes * size.incidences
        draw_bytes = self.chains * draws * self.draw_bytes(size)
        return shared + self.chains * state + draw_bytes + READING_BYTES * size.readings

    def processor_s(self, size: ProblemSize, draws: int) -> float | None:
        """Return the processor time for a number of draws per chain, in seconds, or None if it is not known."""
        cost, plan = self.constants, self.plan
        if cost is None or cost.warmup_ns is None or cost.sweep_ns is None:
            return None
        # The pilot makes as many sweeps as the warm-up of one chain.
        warmup = plan.warmup * (self.chains + self.is_fitted) * cost.warmup_ns
        work = size.incidences + TOUCHED_CELL_WORK * size.touched
        chains = 1e-9 * work * (warmup + draws * plan.thin * self.chains * cost.sweep_ns)
        chains *= POSES_FACTOR if self.samples_poses else 1.0
        if plan.seconds is not None:
            chains = min(chains, plan.seconds * self.cores)
        files = FIXED_S + FILE_S_PER_BYTE * self.chains * draws * self.draw_bytes(size)
        return chains + files + MATCHING_S_PER_SCAN * size.matched


def _option_for_time(scans: Scans, size: ProblemSize, sampling: Sampling) -> str:
    """Return the option that makes a run shorter: fewer scans if they are close together, else a limit."""
    # Thinning shortens `slam` only if the matching of scans takes long.
    for spacing_m, share in _spacings(scans):
        if share <= 0.5 and (not size.matched or MATCHING_S_PER_SCAN * size.matched > LONG_S * sampling.cores):
            return f"--thin-scans {spacing_m:g}"
    return "" if sampling.plan.seconds is not None else f"--seconds {LONG_S:g}"


def _options_for_memory(scans: Scans, grid: Grid, size: ProblemSize, sampling: Sampling) -> str:
    """Return the options after which a run fits into `LARGE_MEMORY_SHARE`, the one that fits the cause first."""
    options: list[str] = []
    for option, estimate_with_it in _remedies(scans, grid, size, sampling):
        # A second value of an option replaces the first.
        options = [*(earlier for earlier in options if earlier.split()[0] != option.split()[0]), option]
        if not estimate_with_it.is_large:
            break
    return " ".join(options)


def _remedies(scans: Scans, grid: Grid, size: ProblemSize, sampling: Sampling) -> Iterator[tuple[str, Estimate]]:
    """Yield options, each with the estimate of the run with it and all options before it."""
    # Which need more memory: beams, or cells and their draws?
    without_beams = replace(size, beams=0.0, incidences=0.0, readings=0.0)
    cell_bytes = sampling.peak_bytes(without_beams, sampling.plan.draws) - BASE_BYTES
    beam_bytes = sampling.peak_bytes(size, sampling.plan.draws) - cell_bytes - BASE_BYTES
    # A hundredth of the hits, far away, may make the grid much larger: cut them off.
    hits_m = scans.ranges_m[np.isfinite(scans.ranges_m)]
    nearly_all_m = math.ceil(np.percentile(hits_m, 99.0)) if hits_m.size else math.inf
    if cell_bytes > beam_bytes and scans.min_range_m < nearly_all_m < 0.7 * hits_m.max():
        smaller_grid = Grid.covering(scans.limited(nearly_all_m), grid.resolution)
        if smaller_grid.n_cells < 0.7 * size.cells:
            share = smaller_grid.n_cells / size.cells
            size = replace(size, cells=size.cells * share, touched=size.touched * share)
            yield f"--max-range {nearly_all_m:g}", _estimate_without_remedy(size, sampling)
    if beam_bytes > cell_bytes:
        thin = size
        for spacing_m, share in _spacings(scans):
            thin = size.thinned(share)
            yield f"--thin-scans {spacing_m:g}", _estimate_without_remedy(thin, sampling)
        size = thin
    for factor in (2, 4):
        yield f"--resolution {factor * grid.resolution:g}", _estimate_without_remedy(size.coarser(factor), sampling)
    if sampling.has_surfaces or sampling.sampler == "stop-gibbs":
        walls = replace(sampling, sampler="wall-gibbs", arrays=Independent.arrays, has_surfaces=False)
        yield "--cells binary", _estimate_without_remedy(size.coarser(4), walls)


def _spacings(scans: Scans) -> Iterator[tuple[float, float]]:
    """Yield distances between scans in metres, and the share of the scans that each leaves, if it is below 0.8."""
    travelled_m = np.concatenate([[0.0], np.cumsum(steps_m(scans.poses))])
    for spacing_m in PROPOSED_SPACINGS_M:
        share = len(np.unique(np.floor(travelled_m / spacing_m))) / max(len(scans), 1)
        if share < 0.8:
            yield spacing_m, share
