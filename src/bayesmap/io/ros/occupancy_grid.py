"""Maps as nav_msgs/OccupancyGrid in a recording: what nav2, RViz and Foxglove show.

Cells are signed bytes in per cent, -1 unknown, row by row from the lower left: cell (i, j) is ``data[j * width + i]``.
The origin is the lower-left corner of cell (0, 0) in the frame ``map``. The message keeps the resolution in single
precision: 0.1 m comes back as 0.100000001.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from bayesmap.io.ros.percent import in_percent
from bayesmap.io.ros.writer import header_of, pose_of, time_of, write_recording
from bayesmap.space.grid import Grid

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

TYPE, TOPIC, FRAME = "nav_msgs/msg/OccupancyGrid", "/map", "map"


def write_occupancy_grid(
    path: str | os.PathLike[str],
    occupancy: ArrayLike,
    grid: Grid,
    observed: ArrayLike | None = None,
    *,
    mode: str = "scale",
    occupied_thresh: float | None = None,
    free_thresh: float | None = None,
    stamp_s: float | None = None,
) -> Path:
    """Write a map as the one message of a recording, on the topic /map, latched.

    Args:
        path: .bag, .mcap, .db3 or a folder, see `bayesmap.io.ros.writer`.
        occupancy: probability that each cell is occupied, shape (nx, ny), NaN where unknown.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); the others are -1. All by default.
        mode: scale and raw: the probability in per cent; trinary: 0, 100 and -1. See `bayesmap.io.ros.percent`.
        occupied_thresh: 0.65 for trinary, 1 for scale.
        free_thresh: 0.25 for trinary, 0 for scale.
        stamp_s: time of the map; zero if None.

    Returns:
        The path.

    Raises:
        BadInput: shapes that do not fit, probabilities outside [0, 1], an unknown mode, thresholds out of order,
            another ending, or a file that cannot be written.
    """
    cells = in_percent(occupancy, grid, observed, mode=mode, occupied_thresh=occupied_thresh, free_thresh=free_thresh)

    def message(store: Typestore, ros: int) -> Any:
        info = store.types["nav_msgs/msg/MapMetaData"](
            map_load_time=time_of(store, stamp_s),
            resolution=grid.resolution,
            width=grid.shape[0],
            height=grid.shape[1],
            origin=pose_of(store, *grid.origin),
        )
        return store.types[TYPE](
            header=header_of(store, ros, FRAME, stamp_s), info=info, data=np.ascontiguousarray(cells.T).ravel()
        )

    return write_recording(path, TOPIC, TYPE, message, stamp_s=stamp_s)
