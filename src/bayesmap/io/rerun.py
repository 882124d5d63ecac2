"""Write layers of a map, scans and a trajectory for the rerun viewer.

Pictures have the row of the largest y at the top. Coordinates are cells from the upper left corner, with y downwards.
"""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.space.grid import Grid, as_layers
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import DATES_S
from bayesmap.space.trajectory import Trajectory, ellipses

ELLIPSE_PROBABILITY = 0.95
SENSOR_COLOR = TRAJECTORY_COLOR = (0, 158, 115)
SCAN_COLOR = (213, 94, 0)
WALL_COLORS = ((250, 250, 248), (20, 31, 66))
UNCERTAINTY_COLORS = ((0, 32, 76), (124, 123, 120), (255, 233, 69))  # 0 to 1, linearly, as in `bayesmap.viz.palette`
UNKNOWN_COLOR = (214, 201, 176)  # not transparent: the viewer shows transparent pixels as black


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
        kind = "timestamp" if scans.stamps_s.min() > DATES_S[0] else "duration"
        times.append(rr.TimeColumn("stamp", **{kind: scans.stamps_s}))
    n_hits = np.isfinite(scans.ranges_m).sum(axis=1)
    ends = to_pixels(scans.hit_points_world(), grid)
    recording.log("sensor", rr.Points2D.from_fields(colors=[SENSOR_COLOR], radii=[1.5]), static=True)
    recording.log("scan", rr.Points2D.from_fields(colors=[SCAN_COLOR], radii=[0.6]), static=True)
    recording.send_columns("sensor", times, rr.Points2D.columns(positions=positions))
    recording.send_columns("scan", times, rr.Points2D.columns(positions=ends).partition(lengths=n_hits))


def _log_trajectory(rr: Any, recording: Any, trajectory: Trajectory, grid: Grid) -> None:
    """Add the line through the positions, and the ellipses of their covariances; ``rr`` is the module rerun."""
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
