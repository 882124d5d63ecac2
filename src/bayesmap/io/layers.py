"""Layers of a map, one number a cell, for programs outside ROS: GeoTIFF and the rerun viewer. Each needs an extra.

**GeoTIFF** (``bayesmap[geotiff]``, rasterio): one band a layer, which QGIS, GDAL and rasterio read. Row 0 is the top
(largest y). The affine transform takes (column, row) to metres of the map frame, from the upper-left corner of the
upper-left cell. The frame of a robot's map is nowhere on Earth, so no coordinate reference system is written; a program
that asks for one may be told any that counts in metres.

**rerun** (``bayesmap[rerun]``, rerun-sdk): a recording (.rrd) of

    /map/NAME      picture of a layer: mean: dark is wall; others: yellow is 1, dark blue 0; sand where no beam reached
    /values/NAME   the layer's numbers, a tensor (row from the top, column), NaN where no beam reached
    /trajectory    the poses, a line
    /ellipses      regions that hold their positions with 95 % probability, where that is known
    /sensor, /scan position and hits of each scan, on the timelines ``scan`` (its number) and ``stamp`` (where known)
    /about         where the pixels are in the map's frame, in words

Everything lies in the plane of the picture, whose unit is the cell: a point x, y in metres is at
((x - x_min) / resolution, (y_max - y) / resolution), y downwards, as pictures have it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.space.cell_arrays import as_layers
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans
from bayesmap.space.trajectory import Trajectory, ellipses

EPOCH_FROM_S = 1e8
"""Later stamps are dates, earlier ones count from some start."""

SENSOR_COLOR, TRAJECTORY_COLOR, SCAN_COLOR = (0, 158, 115), (0, 158, 115), (213, 94, 0)
WALL_COLORS = ((250, 250, 248), (20, 31, 66))
UNCERTAINTY_COLORS = ((0, 32, 76), (124, 123, 120), (255, 233, 69))
"""Of 0 to 1, in straight lines: those of `bayesmap.viz.palette`, near enough."""
LEVEL = 0.95
UNKNOWN_COLOR = (214, 201, 176)
"""Not transparent: the viewer shows that as black."""


def write_geotiff(
    path: str | os.PathLike[str], layers: Mapping[str, ArrayLike], grid: Grid, observed: ArrayLike | None = None
) -> Path:
    """Write the layers of a map as bands of a GeoTIFF in single precision, whole or not at all. Returns the path.

    Args:
        path: the file to write.
        layers: by name, which describes the band; each of shape (nx, ny), NaN where unknown.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); the others are NaN, which is the bands' nodata value.

    Raises:
        BadInput: rasterio is not installed, no layer, shapes that do not fit, infinite numbers, or a file that cannot
            be written.
    """
    try:
        from rasterio.io import MemoryFile  # type: ignore[import-untyped, import-not-found, unused-ignore]
        from rasterio.transform import Affine  # type: ignore[import-untyped, import-not-found, unused-ignore]
    except ImportError:
        raise BadInput(f"{path}: GeoTIFF needs rasterio: pip install 'bayesmap[geotiff]'") from None

    checked = as_layers(grid, layers, observed)
    x0, _, _, y1 = grid.extent_m
    target = Path(path)
    # In memory first: GDAL only prints what goes wrong on a full disk.
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
    path: str | os.PathLike[str],
    layers: Mapping[str, ArrayLike],
    grid: Grid,
    observed: ArrayLike | None = None,
    *,
    scans: Scans | None = None,
    trajectory: Trajectory | None = None,
) -> Path:
    """Write layers, and the scans that they came from, for the rerun viewer, whole or not at all. Returns the path.

    Args:
        path: the file to write.
        layers: by name, each of shape (nx, ny), within [0, 1], NaN where unknown.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); all by default.
        scans: drawn over the layers; none by default.
        trajectory: drawn instead of the scans' poses, with its ellipses.

    Raises:
        BadInput: rerun-sdk is not installed, no layer, shapes that do not fit, infinite numbers, or a file that cannot
            be written.
    """
    try:
        import rerun as rr
        import rerun.blueprint as rrb
    except ImportError:
        raise BadInput(f"{path}: .rrd needs rerun-sdk: pip install 'bayesmap[rerun]'") from None

    checked = as_layers(grid, layers, observed)
    drawn = ["/trajectory", "/ellipses", "/sensor", "/scan"]
    views = [rrb.Spatial2DView(origin="/", contents=[f"/map/{name}", *drawn], name=name) for name in checked]
    target = Path(path)
    with write_whole(target) as partial:
        recording = rr.RecordingStream("bayesmap", send_properties=False)
        recording.send_recording_name(target.stem)
        recording.save(partial, default_blueprint=rrb.Blueprint(rrb.Grid(*views)))
        recording.log("about", rr.TextDocument(_about(grid)), static=True)
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
    at = to_pixels(scans.poses[:, :2], grid)
    times = [rr.TimeColumn("scan", sequence=np.arange(len(scans)))]
    if scans.stamps_s is not None:
        kind = "timestamp" if scans.stamps_s.min() > EPOCH_FROM_S else "duration"
        times.append(rr.TimeColumn("stamp", **{kind: scans.stamps_s}))
    hits = np.isfinite(scans.ranges_m).sum(axis=1)
    ends = to_pixels(scans.hit_points_world(), grid)
    recording.log("sensor", rr.Points2D.from_fields(colors=[SENSOR_COLOR], radii=[1.5]), static=True)
    recording.log("scan", rr.Points2D.from_fields(colors=[SCAN_COLOR], radii=[0.6]), static=True)
    recording.send_columns("sensor", times, rr.Points2D.columns(positions=at))
    recording.send_columns("scan", times, rr.Points2D.columns(positions=ends).partition(lengths=hits))


def _log_trajectory(rr: Any, recording: Any, trajectory: Trajectory, grid: Grid) -> None:
    line = rr.LineStrips2D([to_pixels(trajectory.poses[:, :2], grid)], colors=[TRAJECTORY_COLOR], radii=[0.3])
    recording.log("trajectory", line, static=True)
    if trajectory.covariances is not None:
        outlines = ellipses(trajectory.poses[:, :2], trajectory.covariances[:, :2, :2], LEVEL)
        drawn = rr.LineStrips2D(list(to_pixels(outlines, grid)), colors=[TRAJECTORY_COLOR], radii=[0.1])
        recording.log("ellipses", drawn, static=True)


def _picture(values: NDArray[np.float32], colors: tuple[tuple[int, int, int], ...]) -> NDArray[np.uint8]:
    """Return the colours of 0 to 1, shape (ny, nx, 3), the first row on top."""
    knots = np.linspace(0.0, 1.0, len(colors))
    pixels = np.stack([np.interp(values, knots, shade) for shade in np.array(colors).T], axis=-1)
    pixels[np.isnan(values)] = UNKNOWN_COLOR
    return np.ascontiguousarray(np.rint(pixels).astype(np.uint8).transpose(1, 0, 2)[::-1])


def _about(grid: Grid) -> str:
    x0, _, _, y1 = grid.extent_m
    return (
        f"A map by bayesmap: {grid.shape[0]} x {grid.shape[1]} cells of {grid.resolution:g} m. Pictures count in cells "
        f"from their upper left corner, which is x = {x0:g} m, y = {y1:g} m of the map's frame; y points up there."
    )
