"""Files that the page shows: a saved run, or a log of scans, from which the worker infers a map."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from bayesmap.app.protocol.document import MAX_FILE_SIDE, MAX_LOG_SIDE, METHODS, Document, Refused, Source, empty_walls
from bayesmap.app.protocol.wire import parse_simulation
from bayesmap.app.scene import Scene, scene_of_file
from bayesmap.app.shown.hit_maps import HitCountMap, HitCounts, stop_probabilities
from bayesmap.app.shown.result import DrawnMap, Estimate, Progress, Result
from bayesmap.app.shown.verdicts import judge_chains, judge_particles, rhat_and_ess
from bayesmap.beams.table import BeamTable
from bayesmap.cells.arrays import Draws
from bayesmap.cells.binary import Independent
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.kinds import BUILT_IN, P_WALL, default_sensor
from bayesmap.errors import BadInput
from bayesmap.poses.log_checks import look_like_odometry
from bayesmap.result import Run, load
from bayesmap.sensors.model import Gaussian, SensorModel
from bayesmap.space.grid import Grid, bounds_m
from bayesmap.space.planar import Floats
from bayesmap.space.scans import Scans

LOG_RESOLUTION_M = 0.1  # cell size of a log that is opened
LOG_SWEEPS = 200  # number of sweeps for a log that is opened


@dataclass(frozen=True, eq=False)
class OpenedRun:
    """A saved run, or a run that is still in memory."""

    document: Document  # the document that shows the run
    run: Run  # the run

    @cached_property
    def result(self) -> Result:
        """The run as a `Result`. The beam table is traced again, only to count the beams."""
        from bayesmap.kernels.walls.table import trace  # loads Warp

        posterior = self.run.posterior
        sensor = posterior.sensor if posterior.sensor is not None else Gaussian(posterior.grid.resolution)
        depth = float(posterior.settings.get("hit_depth", 0.0))
        table = trace(posterior.scans, posterior.grid, sensor, hit_depth=depth)
        scene = scene_of_file(posterior.scans, posterior.grid, sensor, self.document.prior, table, depth)
        return Result(scene, self.document, str(posterior.settings.get("method", "gibbs")), SavedRun(self.run))


class SavedRun(Estimate):
    """The estimate of a saved run."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self.approximate = run.posterior.settings.get("method") == "propagate"

    def progress(self, ended: bool) -> Progress:
        posterior, log_joint, seconds = self.run.posterior, self.run.log_joint, self.run.posterior.seconds["total"]
        if posterior.log_weights is not None:
            count, ess = len(posterior.log_weights), self.run.summary().effective_sample_size
            return Progress(count, count, ess, verdict=judge_particles(ess), seconds=seconds)
        if self.approximate or not log_joint.size:
            return Progress(posterior.sweep, posterior.sweep, seconds=seconds)
        rhat, ess = rhat_and_ess(log_joint)
        verdict, last = judge_chains(rhat, ess, posterior.sweep, None, ended=True), float(log_joint[:, -1].mean())
        return Progress(posterior.sweep, posterior.sweep, ess, rhat, last, verdict, seconds=seconds)

    @property
    def prior(self) -> CellPrior:
        return self.run.posterior.prior

    @property
    def poses(self) -> Mapping[str, Any]:
        return self.run.posterior.settings.get("poses") or {"kind": "known"}

    @property
    def sensor_and_depth(self) -> None:
        """None, since the scene has the run's own sensor model. Raises `BadInput` if that model is the user's own."""
        if self.run.posterior.sensor is None:
            raise BadInput("the run's sensor model is not one of bayesmap's, so nothing can be predicted")

    @property
    def kept_draws(self) -> Draws | None:
        return self.run.posterior.draws if self.run.posterior.draws.count else None

    @property
    def scan_poses(self) -> Floats | None:
        if not self.run.n_draws or "poses" not in self.run.posterior.draws.arrays:
            return None
        x, y, yaw = np.moveaxis(self.run.poses, -1, 0).reshape(3, -1, len(self.run.posterior.scans))
        # The circular mean of the headings, which an average of angles near -pi and pi would miss.
        heading = np.arctan2(np.sin(yaw).mean(axis=0), np.cos(yaw).mean(axis=0))
        return np.column_stack([x.mean(axis=0), y.mean(axis=0), heading])

    def mean(self) -> Floats:
        """Return the run's mean, (nx, ny), with 0.5 in cells without a value."""
        return np.nan_to_num(self.run.occupancy, nan=0.5)

    def reached(self) -> Floats:
        """Return 1 in the cells that a beam observes in at least half of the draws, and 0 in the others, (nx, ny)."""
        return self.run.observed.astype(np.float64)

    def log_joint(self) -> Floats:
        return self.run.log_joint

    def draw(self, chain: int | None, number: int | None) -> DrawnMap | None:
        if not self.run.n_draws:
            return None
        chain = min(chain or 0, len(self.run.log_joint) - 1)
        number = self.run.n_draws - 1 if number is None else min(number, self.run.n_draws - 1)
        return DrawnMap(self.run.map_of(chain, number), chain, number)

    def as_run(self, result: Result) -> Run:
        return self.run


@dataclass(eq=False)
class TracedBeams:
    """All beams of a log on the cells of one grid."""

    grid: Grid  # the cells
    sensor: SensorModel  # the default sensor for logs
    table: BeamTable  # beam table
    counts: HitCounts | None = None  # hits and passes of the beams; None before their first use


class OpenedLog:
    """Scans of a log, with the document that shows them on the grid with which the log is opened."""

    def __init__(self, document: Document, scans: Scans) -> None:
        self.document, self.scans = document, scans
        self._traced: TracedBeams | None = None  # the beams on the last grid

    def fit_grid(self, document: Document) -> Document:
        """Return the document on a new grid of its cell size, or on the log's own if the new one has too many cells."""
        own_grid, bounds = self.document.grid, self.document.source.bounds
        if bounds is None or document.grid.resolution == own_grid.resolution:
            return document.on_grid(own_grid)
        grid = Grid.over(*bounds, document.grid.resolution)
        return document.on_grid(own_grid if max(grid.shape) > MAX_LOG_SIDE else grid)

    def scene(self, document: Document) -> Scene:
        """Return the scene of the document's first scans, `scans_used`, under the document's prior."""
        traced, n_used = self._trace(document.grid), document.scans_used
        table = traced.table if n_used is None else first_beams(traced.table, n_used * len(self.scans.angles_rad))
        depth = Independent.hit_depth
        return scene_of_file(self.scans, document.grid, traced.sensor, document.prior, table, depth, n_used)

    def hit_count_result(self, document: Document) -> Result:
        """Return the hit-count map of the document's first scans, `scans_used`."""
        traced = self._trace(document.grid)
        if traced.counts is None:
            traced.counts = HitCounts(self.scans, traced.table)
        counts = traced.counts.count_first(document.scans_used)
        prior: CellPrior = Independent(document.prior) if document.cells == "binary" else BUILT_IN[document.cells]()
        p_stop = stop_probabilities(counts, prior, document.prior)
        mean, observed = p_stop.reshape(document.grid.shape), np.reshape(np.any(counts, axis=0), document.grid.shape)
        return Result(self.scene(document), document, "hits", HitCountMap(mean, observed, prior))

    def _trace(self, grid: Grid) -> TracedBeams:
        """Trace the beams on a grid, and keep them for later calls with this grid."""
        from bayesmap.kernels.walls.table import trace  # loads Warp

        if self._traced is None or self._traced.grid != grid:
            self._traced = None  # free the old table first: two may not fit in memory
            sensor = default_sensor(grid.resolution)
            self._traced = TracedBeams(grid, sensor, trace(self.scans, grid, sensor, hit_depth=Independent.hit_depth))
        return self._traced


def first_beams(table: BeamTable, n_beams: int) -> BeamTable:
    """Return the first beams of a table, as views of its arrays."""
    offsets = table.offsets[: n_beams + 1]
    n_entries = int(offsets[-1])
    cells, loglik, no_hit = table.cells[:n_entries], table.loglik[:n_entries], table.no_hit[:n_beams]
    return replace(table, offsets=offsets, cells=cells, loglik=loglik, no_hit=no_hit)


def read_document(path: str) -> Document:
    """Read a document that the page has exported (``.json``). Raises `BadInput`, with the path, if it is invalid."""
    try:
        return parse_simulation(json.loads(Path(path).read_text(encoding="utf-8")))
    except (OSError, ValueError, RecursionError) as error:
        reason = error if isinstance(error, Refused) else getattr(error, "strerror", "not JSON")
        raise BadInput(f"{path}: {reason}; give a document that the page has exported") from None


def open_file(path: str, **log_options: Any) -> OpenedRun | OpenedLog:
    """Open a saved run (``.nc``) or a log, with options of `bayesmap.read_log`. Raises `BadInput` if it is neither."""
    if not Path(path).exists():
        raise BadInput(f"{path}: no such file; give a saved run (.nc) or a log of range scans")
    if path.endswith(".nc"):
        return open_run(load(path), Path(path).name)
    from bayesmap.io.logs import read_log

    return open_log(read_log(path, **log_options), Path(path).name)


def open_run(run: Run, name: str) -> OpenedRun:
    """Open a run that is in memory. Raises `BadInput` if the map is too large for the page."""
    settings, scans = run.posterior.settings, run.posterior.scans
    p_wall = settings.get("prior", {}).get("p_wall")
    p_wall = p_wall if isinstance(p_wall, int | float) else 0.5  # an array, or another kind of prior: 0.5
    method = settings.get("method")
    document = replace(
        _file_document(run.grid, scans, Source("run", name, len(scans)), p_wall),
        method=method if method in METHODS else "gibbs",
        order=settings.get("order") or "radial",  # other kinds of cells than walls have no order
        cells=run.posterior.prior.words.kind,  # type: ignore[arg-type]
        sweeps=max(1, min(100_000, int(run.posterior.sweep))),  # within the limits of `Document.sweeps`
        seed=min(2**31 - 1, int(settings.get("seed", 0))),  # at most the limit of `Document.seed`
    )
    return OpenedRun(document, run)


def open_log(scans: Scans, name: str) -> OpenedLog:
    """Open scans as a log, on cells of 10 cm, or on larger cells if a side would have more than 1000 cells.
    Poses that look like raw odometry are at first treated as odometry. Raises `BadInput` if the log has no scans.
    """
    grid = Grid.covering(scans, LOG_RESOLUTION_M)
    if max(grid.shape) > MAX_LOG_SIDE:
        grid = Grid.covering(scans, LOG_RESOLUTION_M * math.ceil(max(grid.shape) / MAX_LOG_SIDE))
    document = _file_document(grid, scans, Source("log", name, len(scans)), P_WALL)
    document = replace(document, sweeps=LOG_SWEEPS, source=replace(document.source, bounds=bounds_m(scans)))
    return OpenedLog(replace(document, poses="odometry") if look_like_odometry(scans) else document, scans)


def _file_document(grid: Grid, scans: Scans, source: Source, p_wall: float) -> Document:
    """Return the document of a file. Raises `BadInput` if the grid has too many cells for the page."""
    if max(grid.shape) > MAX_FILE_SIDE:
        raise BadInput(f"{source.name}: {grid.shape} cells are too many for the page, at most {MAX_FILE_SIDE}")
    return Document(
        grid=grid, walls=empty_walls(grid), sensors=(), prior=float(p_wall), angles=len(scans.angles_rad),
        max_range=scans.max_range_m, source=source,
    )  # fmt: skip
