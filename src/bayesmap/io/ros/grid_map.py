"""Maps of several layers as grid_map_msgs/GridMap in a recording: what grid_map, its RViz plugin and Foxglove show.

The conventions of grid_map (Fankhauser and Hutter 2016, "A Universal Grid Map Library"): the pose is the map's
centre; row 0, column 0 is the corner with the largest x and y; rows run towards -x, columns towards -y; a layer is a
matrix in Eigen's order, column by column, in single precision. So cell (i, j) of ours is row nx - 1 - i, column
ny - 1 - j, at ``data[column * nx + row]``. Cells that no beam reached are NaN, and grid_map takes them for invalid,
since ``mean`` is the basic layer.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.io.layers import as_layers
from bayesmap.io.ros.writer import header_of, pose_of, write_recording
from bayesmap.space.grid import Grid

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

TYPE, INFO_TYPE, TOPIC, FRAME = "grid_map_msgs/msg/GridMap", "grid_map_msgs/msg/GridMapInfo", "/grid_map", "map"

_INFO = "float64 resolution\nfloat64 length_x\nfloat64 length_y\ngeometry_msgs/Pose pose\n"
_MAP = (
    "grid_map_msgs/GridMapInfo info\nstring[] layers\nstring[] basic_layers\nstd_msgs/Float32MultiArray[] data\n"
    "uint16 outer_start_index\nuint16 inner_start_index\n"
)
_HEADER = "std_msgs/Header header\n"


def definitions(ros: int) -> dict[str, str]:
    """The messages of the package grid_map_msgs: in ROS 1 the header is the info's, in ROS 2 the map's."""
    return {INFO_TYPE: _HEADER + _INFO, TYPE: _MAP} if ros == 1 else {INFO_TYPE: _INFO, TYPE: _HEADER + _MAP}


def write_grid_map(
    path: str | os.PathLike[str],
    layers: Mapping[str, ArrayLike],
    grid: Grid,
    observed: ArrayLike | None = None,
    *,
    stamp_s: float | None = None,
) -> Path:
    """Write the layers of a map as the one message of a recording, on the topic /grid_map, latched.

    Args:
        path: .bag, .mcap, .db3 or a folder, see `bayesmap.io.ros.writer`.
        layers: by name, each of shape (nx, ny), NaN where unknown; the first is the basic layer.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); the others are NaN. All by default.
        stamp_s: time of the map; zero if None.

    Returns:
        The path.

    Raises:
        BadInput: no layer, shapes that do not fit, infinite numbers, another ending, or a file that cannot be written.
    """
    checked = as_layers(layers, grid, observed)
    length_m = np.array(grid.shape) * grid.resolution
    x_m, y_m = (float(v) for v in np.array(grid.origin) + length_m / 2)

    def message(store: Typestore, ros: int) -> Any:
        types = store.types
        header = header_of(store, ros, FRAME, stamp_s)
        inner, outer = ({"header": header}, {}) if ros == 1 else ({}, {"header": header})
        info = types[INFO_TYPE](
            **inner,
            resolution=grid.resolution,
            length_x=float(length_m[0]),
            length_y=float(length_m[1]),
            pose=pose_of(store, x_m, y_m),
        )
        return types[TYPE](
            **outer,
            info=info,
            layers=list(checked),
            basic_layers=list(checked)[:1],
            data=[_matrix(store, values) for values in checked.values()],
            outer_start_index=0,
            inner_start_index=0,
        )

    return write_recording(path, TOPIC, TYPE, message, stamp_s=stamp_s, definitions=definitions)


def _matrix(store: Typestore, values: NDArray[np.float32]) -> Any:
    """A layer in Eigen's order, labelled as grid_map labels it."""
    rows, columns = values.shape
    dimension = store.types["std_msgs/msg/MultiArrayDimension"]
    layout = store.types["std_msgs/msg/MultiArrayLayout"](
        dim=[
            dimension(label="column_index", size=columns, stride=rows * columns),
            dimension(label="row_index", size=rows, stride=rows),
        ],
        data_offset=0,
    )
    return store.types["std_msgs/msg/Float32MultiArray"](layout=layout, data=values[::-1, ::-1].ravel(order="F"))
