"""Write a posterior as a file for other programs. The format's name, or the path's ending, selects the writer.

docs/file-formats.md describes the formats. `export_run` writes the map of a run, or its trajectory by
`export_trajectory`. `write_geotiff` and `write_rerun` are here, other writers have files of their own. Rows of a
GeoTIFF and of rerun's pictures run from the top, the largest y. rerun's coordinates are cells, with y downwards.
"""

import contextlib
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.io.ros import writer
from bayesmap.io.ros.maps import write_map
from bayesmap.io.text.g2o import Edges, chain_edges, slam_edges, write_g2o
from bayesmap.io.text.trajectories import covariances_path, write_covariances, write_trajectory
from bayesmap.space.grid import Grid, as_layers
from bayesmap.space.planar import inverse
from bayesmap.space.scans import Scans
from bayesmap.space.trajectory import RelativeLaw, Trajectory, ellipses

if TYPE_CHECKING:
    from bayesmap.cells.arrays import Draws
    from bayesmap.cells.kind import CellPrior
    from bayesmap.poses.trajectory import InferredTrajectory

RECORDING_ENDINGS = tuple(ending for ending in writer.ENDINGS if ending != writer.FOLDER)
FORMATS = {  # formats with the endings that select them; a name without ending is an occupancy grid in a folder
    "map-server": (".yaml", ".yml"), "occupancy-grid": RECORDING_ENDINGS, "gridmap": (), "rerun": (".rrd",),
    "tum": (".tum",), "trajectory": (), "g2o": (".g2o",), "geotiff": (".tif", ".tiff"),
}  # fmt: skip
TRAJECTORIES = ("tum", "trajectory", "g2o")  # formats of trajectories
THRESHOLDED = ("map-server", "occupancy-grid")  # formats in per cent, which take a mode and thresholds
APPROXIMATION = "the Student-t approximation of all scans' poses"
INTERVAL_PROBABILITY = 0.9  # probability of the interval from the layer lower to the layer upper
ELLIPSE_PROBABILITY = 0.95
MIN_DATE_S = 1e8  # larger stamps, in seconds, are dates; smaller ones count from the start of the log
SENSOR_COLOR = TRAJECTORY_COLOR = (0, 158, 115)
SCAN_COLOR = (213, 94, 0)
WALL_COLORS = ((250, 250, 248), (20, 31, 66))
UNCERTAINTY_COLORS = ((0, 32, 76), (124, 123, 120), (255, 233, 69))  # 0 to 1, linearly, as in `bayesmap.viz.palette`
UNKNOWN_COLOR = (214, 201, 176)  # not transparent: the viewer shows transparent pixels as black


def export_format(path: str | os.PathLike[str], format: str | None = None) -> str:
    """Return the format, by the path's ending if None. Raises `BadInput` for an unknown format or ending."""
    if format is not None:
        if format not in FORMATS:
            raise BadInput(f"export: format {format!r} is not known; use one of {', '.join(FORMATS)}")
        return format
    ending = Path(path).suffix.lower()
    if os.fspath(path).endswith(os.sep) or Path(path).is_dir() or ending == writer.FOLDER:
        return "occupancy-grid"
    for name, endings in FORMATS.items():
        if ending in endings:
            return name
    known_endings = ", ".join(ending for endings in FORMATS.values() for ending in endings)
    choices = f"the known endings are {known_endings}, and a name without ending is the folder of a ROS 2 bag"
    raise BadInput(f"{path}: no format is known by the ending {ending!r}; {choices}")


def path_to_replace(path: str | os.PathLike[str], format: str | None = None) -> Path | None:
    """Return a file or folder that an export would replace, or None. Raises `BadInput` for an unknown format."""
    target = Path(path)
    outputs = [target]
    chosen = export_format(path, format)
    if chosen == "map-server":
        outputs += [target.with_suffix(ending) for ending in (".pgm", ".png")]
    elif chosen == "tum":
        outputs.append(covariances_path(target))
    replaced = [output for output in outputs if os.path.lexists(output)]
    # Nothing can be lost in an empty folder.
    if replaced == [target] and target.is_dir() and not any(target.iterdir()):
        return None
    return replaced[0] if replaced else None


def layers_of(run: Any) -> dict[str, NDArray[np.float64]]:
    """Return the layers of a run, each (nx, ny): mean, entropy, and lower and upper if cells have intervals."""
    layers = {"mean": run.occupancy, "entropy": run.entropy}
    # Not part of the protocol: runs on binary walls need not have the method, and may raise `BadInput`.
    interval = getattr(run, "interval", None)
    if interval is not None:
        with contextlib.suppress(BadInput):
            layers["lower"], layers["upper"] = interval(INTERVAL_PROBABILITY)
    return layers


def trajectory_of(run: object, scans: Scans) -> Trajectory:
    """Return the trajectory of the sensor in a run, with its uncertainty.
    A run of `bayesmap.slam` gives the draws of its chains over poses if these have mixed, else its approximation of the
    poses of all scans. Other runs give their draws of poses, or else the poses of their scans.
    """
    approximation = getattr(run, "trajectory", None)
    draws = getattr(run, "poses", None)  # (chains, draws, S, 3)
    if draws is None or draws.ndim != 4 or draws.shape[0] * draws.shape[1] < 2 or (draws == draws[0, 0]).all():
        if approximation is None:
            return Trajectory(scans.poses, scans.stamps_s, frame="laser")
        return approximate_trajectory(approximation)
    from bayesmap.posterior.summary import summarise_poses

    mixing = summarise_poses(draws)
    figures = f"R-hat up to {mixing.rhat_max:.3g}, effective sample size from {mixing.ess_min:.0f}"
    unmixed = f"the chains over poses have not mixed ({figures})"
    if approximation is not None and not mixing.mixed:
        return approximate_trajectory(approximation, f"{APPROXIMATION}: {unmixed}")
    known_by = f"draws of poses, which are too alike: {unmixed}"
    if mixing.mixed:
        known_by = f"draws of the chains over poses, which have mixed ({figures})"
    return replace(Trajectory.of_draws(draws, scans.stamps_s, known_by), frame="laser")


def approximate_trajectory(trajectory: "InferredTrajectory", known_by: str = APPROXIMATION) -> Trajectory:
    """Return the approximate trajectory of `bayesmap.slam` with its law of relative poses."""
    law = RelativeLaw(trajectory.relative_scales, trajectory.gaussian.dof)
    covariances = trajectory.covariances()
    return Trajectory(trajectory.poses, trajectory.stamps_s, covariances, None, law, known_by, frame="laser")


def export_trajectory(
    path: str | os.PathLike[str], trajectory: Trajectory, *, format: str | None = None, edges: Edges | None = None,
    lost: Sequence[bool] = (),
) -> tuple[Path, ...]:  # fmt: skip
    """Write a trajectory as "tum", "g2o" or "trajectory" (a recording), by the path's ending if ``format`` is None.

    An existing file is replaced. ``edges`` is the pose graph for g2o; if None, the chain of steps
    (`bayesmap.io.text.g2o.chain_edges`). Returns the paths of the files written. If covariances are known,
    NAME-covariances.txt is written beside NAME.tum. There, poses that are ``lost``, (S,), become comments. Raises
    `BadInput` for another format, no pose, a graph of a trajectory without covariances, or an unwritable file.
    """
    ending = Path(path).suffix.lower()
    chosen = {".tum": "tum", ".g2o": "g2o"}.get(ending, "trajectory") if format is None else format
    if chosen == "g2o":
        return (write_g2o(path, trajectory.poses, chain_edges(trajectory) if edges is None else edges),)
    if chosen == "tum":
        written = (write_trajectory(path, trajectory.poses, trajectory.stamps_s, trajectory.frame, lost),)
        if trajectory.covariances is None:
            return written
        covariances = write_covariances(covariances_path(path), trajectory.covariances, trajectory.stamps_s, lost)
        return (*written, covariances)
    if chosen != "trajectory":
        raise BadInput(f"export: a trajectory is written as {', '.join(TRAJECTORIES)}, not as {chosen!r}")
    return (writer.write_trajectory_recording(path, trajectory),)


def known_cells(
    prior: "CellPrior", draws: "Draws | None", occupancy: NDArray[np.float64], observed: NDArray[np.bool_],
    free_thresh: float | None = None,
) -> NDArray[np.bool_]:  # fmt: skip
    """Select the cells that a map of occupied, free and unknown cells does not call unknown, (nx, ny).
    An observed cell below the free threshold is unknown unless the beams alone show that it stops fewer than half of
    all beams: four passed it, and none stopped. This holds for kinds of cells that count beams.
    """
    if prior.thresholds is None or draws is None or not draws.count:
        return observed
    evidence = prior.evidence_interval(draws, 0.9)
    if evidence is None:
        return observed
    limit = prior.thresholds[1] if free_thresh is None else free_thresh
    return observed & ((evidence[1] < 0.5) | (occupancy >= limit))


def export_run(
    path: str | os.PathLike[str], run: Any, scans: Scans, *, format: str | None = None, mode: str | None = None,
    occupied_thresh: float | None = None, free_thresh: float | None = None, known: NDArray[np.bool_] | None = None,
    frame: str | None = None,
) -> tuple[Path, ...]:  # fmt: skip
    """Write a run in another program's format, by the path's ending if ``format`` is None. Returns the paths written.

    An existing file is replaced. The path may be the folder of a ROS 2 bag. The stamp of the last of ``scans`` is the
    map's, and their poses are the default trajectory. ``mode`` is trinary, scale or raw, see `bayesmap.io.ros.maps`: by
    default trinary for map-server (a cell is occupied above 0.65, and free below 0.25), and scale, the probability in
    per cent, for occupancy-grid. Other formats write exact numbers and take no mode. ``known`` are the cells, (nx, ny),
    that these two do not call unknown; by default the observed ones. ``frame`` is the frame on the robot whose poses a
    trajectory has, "base" or "laser"; by default the base, if the log said where the laser sits on it.

    Raises `BadInput` for an unknown ending, format or mode, a mode or threshold that the format does not take, an
    optional package that is not installed, or a file that cannot be written.
    """
    chosen = export_format(path, format)
    thresholds = {"mode": mode, "occupied_thresh": occupied_thresh, "free_thresh": free_thresh}
    options: dict[str, Any] = {name: value for name, value in thresholds.items() if value is not None}
    if options and chosen not in THRESHOLDED:
        remedy = f"leave it out, or choose {' or '.join(THRESHOLDED)}"
        raise BadInput(f"{path}: {chosen} keeps the numbers and takes no {next(iter(options))}; {remedy}")
    if frame is not None and chosen not in TRAJECTORIES:
        raise BadInput(f"{path}: {chosen} holds a map, and takes no frame; {', '.join(TRAJECTORIES)} hold a trajectory")
    grid, observed = run.grid, run.observed
    known = observed if known is None else known
    stamp_s = float(scans.stamps_s[-1]) if scans.stamps_s is not None and len(scans) else None
    if chosen == "map-server":
        return write_map(path, run.occupancy, grid, known, **options)
    if chosen == "occupancy-grid":
        return (writer.write_occupancy_grid(path, run.occupancy, grid, known, stamp_s=stamp_s, **options),)
    if chosen == "gridmap":
        return (writer.write_grid_map(path, layers_of(run), grid, observed, stamp_s=stamp_s),)
    if chosen == "geotiff":
        return (write_geotiff(path, layers_of(run), grid, observed),)
    # Trajectories, of the frame that the user names. The pose graph of `bayesmap.slam` is of the laser's poses.
    trajectory = trajectory_of(run, scans)
    if chosen == "rerun":
        return (write_rerun(path, layers_of(run), grid, observed, scans=scans, trajectory=trajectory),)
    framed = trajectory.of(frame, scans.mount)
    edges = None
    if chosen == "g2o" and trajectory.relative is not None and run.trajectory is not None:
        edges = slam_edges(run.trajectory)
        if framed.frame == "base":
            edges = edges.of_frame(inverse(np.asarray(scans.mount)))
    return export_trajectory(path, framed, format=chosen, edges=edges)


def write_geotiff(
    path: str | os.PathLike[str], layers: Mapping[str, ArrayLike], grid: Grid, observed: ArrayLike | None = None
) -> Path:
    """Write layers (see `as_layers`) as bands of a GeoTIFF, whole or not at all. Returns the path.
    Cells that no beam reached are NaN, which is the bands' nodata value. Raises `BadInput` if rasterio is not
    installed, for layers that do not fit, or a file that cannot be written.
    """
    try:
        from rasterio.io import MemoryFile  # type: ignore[import-untyped, import-not-found, unused-ignore]
        from rasterio.transform import Affine  # type: ignore[import-untyped, import-not-found, unused-ignore]
    except ImportError:
        raise BadInput(f"{path}: GeoTIFF needs rasterio: pip install 'bayesmap[geotiff]'") from None

    checked = as_layers(grid, layers, observed)
    x0, _, _, y1 = grid.extent_m
    target = Path(path)
    # The file is made in memory first, because GDAL only prints errors of a full disk.
    with write_whole(target) as partial, MemoryFile() as memory:
        with memory.open(
            driver="GTiff", width=grid.shape[0], height=grid.shape[1], count=len(checked), dtype="float32",
            nodata=float("nan"), transform=Affine(grid.resolution, 0.0, x0, 0.0, -grid.resolution, y1),
            compress="deflate", interleave="band",
        ) as file:  # fmt: skip
            for band, (name, values) in enumerate(checked.items(), start=1):
                file.write(values.T[::-1], band)
                file.set_band_description(band, name)
        partial.write_bytes(memory.getbuffer())
    return target


def write_rerun(
    path: str | os.PathLike[str], layers: Mapping[str, ArrayLike], grid: Grid, observed: ArrayLike | None = None, *,
    scans: Scans | None = None, trajectory: Trajectory | None = None,
) -> Path:  # fmt: skip
    """Write layers (see `as_layers`) for the rerun viewer, whole or not at all. Returns the path.
    Over the layers the viewer shows the scans, and the trajectory with its ellipses, or else the scans' poses. Raises
    `BadInput` if rerun-sdk is not installed, for layers that do not fit, or a file that cannot be written.
    """
    try:
        import rerun as rr
        import rerun.blueprint as rrb
    except ImportError:
        raise BadInput(f"{path}: .rrd needs rerun-sdk: pip install 'bayesmap[rerun]'") from None

    checked = as_layers(grid, layers, observed)
    overlays = ["/trajectory", "/ellipses", "/sensor", "/scan"]
    views = [rrb.Spatial2DView(origin="/", contents=[f"/map/{name}", *overlays], name=name) for name in checked]
    target = Path(path)
    with write_whole(target) as partial:
        recording = rr.RecordingStream("bayesmap", send_properties=False)
        recording.send_recording_name(target.stem)
        recording.save(partial, default_blueprint=rrb.Blueprint(rrb.Grid(*views)))
        size, (x0, _, _, y1) = f"{grid.shape[0]} x {grid.shape[1]} cells of {grid.resolution:g} m", grid.extent_m
        corner = f"their upper left corner, which is x = {x0:g} m, y = {y1:g} m of the map's frame; y points up there"
        about = f"A map by bayesmap: {size}. Pictures count in cells from {corner}."
        recording.log("about", rr.TextDocument(about), static=True)
        for name, values in checked.items():
            picture = _picture(values, WALL_COLORS if name == "mean" else UNCERTAINTY_COLORS)
            recording.log(f"map/{name}", rr.Image(picture), static=True)
            tensor = rr.Tensor(np.ascontiguousarray(values.T[::-1]), dim_names=("row", "column"))
            recording.log(f"values/{name}", tensor, static=True)
        if scans is not None and len(scans):
            _log_scans(rr, recording, scans, grid)
            trajectory = Trajectory(scans.poses) if trajectory is None else trajectory
        if trajectory is not None and len(trajectory):
            _log_trajectory(rr, recording, trajectory, grid)
        recording.flush()
        recording.disconnect()
    return target


def to_pixels(points_world: NDArray[np.float64], grid: Grid) -> NDArray[np.float64]:
    """Return points of the map frame in the picture's plane, (..., 2): columns from the left, rows from the top."""
    cells = grid.to_cells(points_world)
    return np.stack([cells[..., 0], grid.shape[1] - cells[..., 1]], axis=-1)


def _log_scans(rr: Any, recording: Any, scans: Scans, grid: Grid) -> None:
    """Add the sensor's positions and the ends of its beams at each time; ``rr`` is the module rerun."""
    positions = to_pixels(scans.poses[:, :2], grid)
    times = [rr.TimeColumn("scan", sequence=np.arange(len(scans)))]
    if scans.stamps_s is not None:
        kind = "timestamp" if scans.stamps_s.min() > MIN_DATE_S else "duration"
        times.append(rr.TimeColumn("stamp", **{kind: scans.stamps_s}))
    n_hits = np.isfinite(scans.ranges_m).sum(axis=1)
    ends = to_pixels(scans.hit_points_world(), grid)
    recording.log("sensor", rr.Points2D.from_fields(colors=[SENSOR_COLOR], radii=[1.5]), static=True)
    recording.log("scan", rr.Points2D.from_fields(colors=[SCAN_COLOR], radii=[0.6]), static=True)
    recording.send_columns("sensor", times, rr.Points2D.columns(positions=positions))
    recording.send_columns("scan", times, rr.Points2D.columns(positions=ends).partition(lengths=n_hits))


def _log_trajectory(rr: Any, recording: Any, trajectory: Trajectory, grid: Grid) -> None:
    line = rr.LineStrips2D([to_pixels(trajectory.poses[:, :2], grid)], colors=[TRAJECTORY_COLOR], radii=[0.3])
    recording.log("trajectory", line, static=True)
    if trajectory.covariances is not None:
        outlines = ellipses(trajectory.poses[:, :2], trajectory.covariances[:, :2, :2], ELLIPSE_PROBABILITY)
        strips = rr.LineStrips2D(list(to_pixels(outlines, grid)), colors=[TRAJECTORY_COLOR], radii=[0.1])
        recording.log("ellipses", strips, static=True)


def _picture(values: NDArray[np.float32], colors: tuple[tuple[int, int, int], ...]) -> NDArray[np.uint8]:
    """Return the colours of values from 0 to 1 as a picture, shape (ny, nx, 3), with the top row first."""
    knots = np.linspace(0.0, 1.0, len(colors))
    pixels = np.stack([np.interp(values, knots, shade) for shade in np.array(colors).T], axis=-1)
    pixels[np.isnan(values)] = UNKNOWN_COLOR
    return np.ascontiguousarray(np.rint(pixels).astype(np.uint8).transpose(1, 0, 2)[::-1])
