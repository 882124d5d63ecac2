"""What a run says, as messages in a recording that ROS plays (`bayesmap.io.ros.writer`).

    /map          nav_msgs/OccupancyGrid, latched: what nav2, RViz and Foxglove show
    /grid_map     grid_map_msgs/GridMap, latched: all layers, for grid_map, its RViz plugin and Foxglove
    /trajectory   nav_msgs/Path, latched: all poses
    /pose         geometry_msgs/PoseWithCovarianceStamped: a message a pose, at its time; where covariances are known

**OccupancyGrid.** Cells are signed bytes in per cent, -1 unknown, row by row from the lower left: cell (i, j) is
``data[j * width + i]``. The origin is the lower-left corner of cell (0, 0). The message keeps the resolution in single
precision: 0.1 m comes back as 0.100000001.

**GridMap.** The conventions of grid_map (Fankhauser and Hutter 2016, "A Universal Grid Map Library"): the pose is the
map's centre; row 0, column 0 is the corner with the largest x and y; rows run towards -x, columns towards -y; a layer
is a matrix in Eigen's order, column by column, in single precision. So cell (i, j) of ours is row nx - 1 - i, column
ny - 1 - j, at ``data[column * nx + row]``. Cells that no beam reached are NaN, and grid_map takes them for invalid,
since ``mean`` is the basic layer.

**Covariances** are ROS's: 6 x 6, row by row, of x, y, z and turns about the fixed axes x, y, z; what a pose in the
plane does not have is 0.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.io.ros.maps import in_percent
from bayesmap.io.ros.writer import Channel, header_of, pose_of, time_of, write_channels
from bayesmap.space.cell_arrays import as_layers
from bayesmap.space.grid import Grid
from bayesmap.space.trajectory import Trajectory

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

FRAME = "map"
OCCUPANCY_GRID = "nav_msgs/msg/OccupancyGrid"
GRID_MAP, GRID_MAP_INFO = "grid_map_msgs/msg/GridMap", "grid_map_msgs/msg/GridMapInfo"
PATH, POSE = "nav_msgs/msg/Path", "geometry_msgs/msg/PoseWithCovarianceStamped"

IN_PLANE = np.array([0, 1, 5])
"""Where x, y and yaw stand among ROS's six."""

_HEADER = "std_msgs/Header header\n"
_INFO = "float64 resolution\nfloat64 length_x\nfloat64 length_y\ngeometry_msgs/Pose pose\n"
_MAP = (
    "grid_map_msgs/GridMapInfo info\nstring[] layers\nstring[] basic_layers\nstd_msgs/Float32MultiArray[] data\n"
    "uint16 outer_start_index\nuint16 inner_start_index\n"
)


def write_occupancy_grid(
    path: str | os.PathLike[str],
    occupancy: ArrayLike,
    grid: Grid,
    observed: ArrayLike | None = None,
    *,
    stamp_s: float | None = None,
    **thresholds: Any,
) -> Path:
    """Write a map as the one message of a recording, an OccupancyGrid. Returns the path.

    Args:
        path: .bag, .mcap, .db3 or a folder, see `bayesmap.io.ros.writer`.
        occupancy: probability that each cell is occupied, shape (nx, ny), NaN where unknown.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); the others are -1. All by default.
        stamp_s: time of the map; zero if None.
        thresholds: ``mode``, ``occupied_thresh`` and ``free_thresh`` of `bayesmap.io.ros.maps.in_percent`.

    Raises:
        BadInput: those of `bayesmap.io.ros.maps.in_percent`, another ending, or a file that cannot be written.
    """
    cells = in_percent(occupancy, grid, observed, **thresholds)

    def message(store: Typestore, ros: int) -> Any:
        info = store.types["nav_msgs/msg/MapMetaData"](
            map_load_time=time_of(store, stamp_s), resolution=grid.resolution, width=grid.shape[0],
            height=grid.shape[1], origin=pose_of(store, *grid.origin),
        )  # fmt: skip
        data = np.ascontiguousarray(cells.T).ravel()
        return store.types[OCCUPANCY_GRID](header=header_of(store, ros, FRAME, stamp_s), info=info, data=data)

    return write_channels(path, [Channel("/map", OCCUPANCY_GRID, [(stamp_s, message)])])


def write_grid_map(
    path: str | os.PathLike[str],
    layers: Mapping[str, ArrayLike],
    grid: Grid,
    observed: ArrayLike | None = None,
    *,
    stamp_s: float | None = None,
) -> Path:
    """Write the layers of a map as the one message of a recording, a GridMap. Returns the path.

    Args:
        path: .bag, .mcap, .db3 or a folder, see `bayesmap.io.ros.writer`.
        layers: by name, each of shape (nx, ny), NaN where unknown; the first is the basic layer.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); the others are NaN. All by default.
        stamp_s: time of the map; zero if None.

    Raises:
        BadInput: no layer, shapes that do not fit, infinite numbers, another ending, or a file that cannot be written.
    """
    checked = as_layers(grid, layers, observed)
    length_m = np.array(grid.shape) * grid.resolution
    x_m, y_m = (float(v) for v in np.array(grid.origin) + length_m / 2)

    def message(store: Typestore, ros: int) -> Any:
        # In ROS 1 the header is the info's, in ROS 2 the map's.
        header = {"header": header_of(store, ros, FRAME, stamp_s)}
        info = store.types[GRID_MAP_INFO](
            **(header if ros == 1 else {}), resolution=grid.resolution, length_x=float(length_m[0]),
            length_y=float(length_m[1]), pose=pose_of(store, x_m, y_m),
        )  # fmt: skip
        return store.types[GRID_MAP](
            **({} if ros == 1 else header), info=info, layers=list(checked), basic_layers=list(checked)[:1],
            data=[_matrix(store, values) for values in checked.values()], outer_start_index=0, inner_start_index=0,
        )  # fmt: skip

    def definitions(ros: int) -> dict[str, str]:
        """Return the messages of the package grid_map_msgs, which rosbags lacks."""
        return {GRID_MAP_INFO: _HEADER + _INFO, GRID_MAP: _MAP} if ros == 1 else {
            GRID_MAP_INFO: _INFO, GRID_MAP: _HEADER + _MAP
        }  # fmt: skip

    return write_channels(path, [Channel("/grid_map", GRID_MAP, [(stamp_s, message)])], definitions=definitions)


def _matrix(store: Typestore, values: NDArray[np.float32]) -> Any:
    """Return a layer in Eigen's order, labelled as grid_map labels it."""
    rows, columns = values.shape
    dimension = store.types["std_msgs/msg/MultiArrayDimension"]
    dimensions = [
        dimension(label="column_index", size=columns, stride=rows * columns),
        dimension(label="row_index", size=rows, stride=rows),
    ]
    layout = store.types["std_msgs/msg/MultiArrayLayout"](dim=dimensions, data_offset=0)
    return store.types["std_msgs/msg/Float32MultiArray"](layout=layout, data=values[::-1, ::-1].ravel(order="F"))


def write_trajectory_recording(path: str | os.PathLike[str], trajectory: Trajectory, *, frame: str = FRAME) -> Path:
    """Write a trajectory as a recording, whole or not at all. Returns the path.

    Args:
        path: .bag, .mcap, .db3 or a folder.
        trajectory: poses without stamps are numbered, a second apart.
        frame: in which the poses are given.

    Raises:
        BadInput: no pose, another ending, or a file that cannot be written.
    """
    if len(trajectory) == 0:
        raise BadInput("trajectory: there is no pose to write")
    stamps = trajectory.stamps_s
    stamps = np.arange(len(trajectory), dtype=np.float64) if stamps is None else stamps
    whole = partial(_path_message, trajectory.poses, stamps, frame)
    channels = [Channel("/trajectory", PATH, [(float(stamps[-1]), whole)])]
    if trajectory.covariances is not None:
        messages = [
            (float(stamp), partial(_pose_message, pose, covariance, float(stamp), frame))
            for pose, covariance, stamp in zip(trajectory.poses, trajectory.covariances, stamps, strict=True)
        ]
        channels.append(Channel("/pose", POSE, messages, latched=False))
    return write_channels(path, channels)


def _path_message(
    poses: NDArray[np.float64], stamps_s: NDArray[np.float64], frame: str, store: Typestore, ros: int
) -> Any:
    stamped = store.types["geometry_msgs/msg/PoseStamped"]
    listed = [
        stamped(header=header_of(store, ros, frame, float(stamp)), pose=pose_of(store, *(float(v) for v in pose)))
        for pose, stamp in zip(poses, stamps_s, strict=True)
    ]
    return store.types[PATH](header=header_of(store, ros, frame, float(stamps_s[-1])), poses=listed)


def _pose_message(
    pose: NDArray[np.float64], covariance: NDArray[np.float64], stamp_s: float, frame: str, store: Typestore, ros: int
) -> Any:
    six = np.zeros((6, 6))
    six[np.ix_(IN_PLANE, IN_PLANE)] = covariance
    posed = store.types["geometry_msgs/msg/PoseWithCovariance"](
        pose=pose_of(store, *(float(v) for v in pose)), covariance=six.ravel()
    )
    return store.types[POSE](header=header_of(store, ros, frame, stamp_s), pose=posed)
