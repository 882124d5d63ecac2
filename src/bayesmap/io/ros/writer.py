"""Write maps and trajectories as recordings that ROS plays: a ROS 1 bag, or ROS 2 in MCAP or sqlite.

docs/file-formats.md describes files and topics. A map's topic has the quality of service of nav2's map_server, so that
late subscribers get the map, too. Covariances are 6 x 6, of x, y, z and rotations about the fixed axes x, y, z.

**GridMap** (Fankhauser and Hutter 2016, "A Universal Grid Map Library"): the pose is the map's centre; row 0, column 0
is the corner with the largest x and y; rows run towards -x, columns towards -y; a layer is a matrix in Eigen's order,
column by column. So cell (i, j) of ours is row nx - 1 - i, column ny - 1 - j, at ``data[column * nx + row]``. Cells
that no beam reached are NaN, and invalid in grid_map, because ``mean`` is the basic layer.
"""

from __future__ import annotations

import contextlib
import math
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole, write_whole_folder
from bayesmap.space.grid import Grid, as_layers
from bayesmap.space.scans import Scans
from bayesmap.space.trajectory import Trajectory

if TYPE_CHECKING:
    from rosbags.interfaces import Qos
    from rosbags.typesys.store import Typestore

FOLDER = ""
ENDINGS = (".bag", ".mcap", ".db3", FOLDER)
ROS2_BAG_VERSION: Final = 8  # version of the metadata, the last that every release since Humble reads

NANOSECONDS = 1_000_000_000

FRAME = "map"
OCCUPANCY_GRID = "nav_msgs/msg/OccupancyGrid"
GRID_MAP, GRID_MAP_INFO = "grid_map_msgs/msg/GridMap", "grid_map_msgs/msg/GridMapInfo"
PATH, POSE = "nav_msgs/msg/Path", "geometry_msgs/msg/PoseWithCovarianceStamped"
SCAN, TRANSFORMS = "sensor_msgs/msg/LaserScan", "tf2_msgs/msg/TFMessage"

IN_PLANE = np.array([0, 1, 5])  # indices of x, y and yaw among the six components of ROS covariances

# Definitions of the messages of grid_map_msgs. In ROS 1 the header belongs to the info, in ROS 2 to the map.
_HEADER = "std_msgs/Header header\n"
_INFO = "float64 resolution\nfloat64 length_x\nfloat64 length_y\ngeometry_msgs/Pose pose\n"
_MAP = (
    "grid_map_msgs/GridMapInfo info\nstring[] layers\nstring[] basic_layers\nstd_msgs/Float32MultiArray[] data\n"
    "uint16 outer_start_index\nuint16 inner_start_index\n"
)

RosVersion = Literal[1, 2]
Message = Callable[["Typestore", RosVersion], Any]  # function that makes a message from a type store


@dataclass(frozen=True)
class Channel:
    """A topic, the type of its messages, and the messages, each with its time of receipt in seconds.

    A message without a time gets 1 ns, because ROS refuses zero. If ``latched`` is true, late subscribers get the last
    message.
    """

    topic: str
    type_name: str
    messages: Sequence[tuple[float | None, Message]]
    latched: bool = True


def container_of(path: str | os.PathLike[str]) -> str:
    """Return the ending of a path, one of `ENDINGS`, or raise `BadInput`. Without ending it is a folder."""
    name = os.fspath(path)
    if name.endswith(os.sep) or Path(path).is_dir():
        return FOLDER
    ending = Path(path).suffix.lower()
    if ending not in ENDINGS:
        raise BadInput(
            f"{path}: a recording ends in .bag (ROS 1), .mcap or .db3 (ROS 2), or is a folder without ending"
        )
    return ending


def write_channels(path: str | os.PathLike[str], channels: Sequence[Channel]) -> Path:
    """Write topics as a recording, whole or not at all; raise `BadInput` if that is impossible."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    ending = container_of(path)
    ros_version = 1 if ending == ".bag" else 2
    store = get_typestore(Stores.ROS1_NOETIC if ros_version == 1 else Stores.ROS2_HUMBLE)
    # The messages of the package grid_map_msgs, which rosbags lacks.
    info = _HEADER + _INFO if ros_version == 1 else _INFO
    grid_map = _MAP if ros_version == 1 else _HEADER + _MAP
    store.register(get_types_from_msg(info, GRID_MAP_INFO) | get_types_from_msg(grid_map, GRID_MAP))
    target = Path(path)
    if ending == FOLDER:
        # The bag names its file after its folder, so it is made in a folder of the right name, and moved.
        with write_whole_folder(target, is_ros2_bag) as unfinished, _scratch(unfinished.parent) as scratch:
            made = scratch / target.name
            _write_ros2(made, ".db3", channels, store)
            os.replace(made, unfinished)
        return target
    with write_whole(target) as unfinished, _scratch(unfinished.parent) as scratch:
        made = scratch / target.stem
        if ending == ".bag":
            _write_ros1(made, channels, store)
            os.replace(made, unfinished)
        else:
            _write_ros2(made, ending, channels, store)
            os.replace(made / (made.name + ending), unfinished)
    return target


def is_ros2_bag(folder: Path) -> bool:
    """Return true if a folder holds a ROS 2 bag and nothing else."""
    files = list(folder.iterdir())
    return any(file.name == "metadata.yaml" for file in files) and all(
        file.name == "metadata.yaml" or file.suffix in (".db3", ".mcap") for file in files
    )


def header_of(store: Typestore, ros_version: RosVersion, frame: str, stamp_s: float | None) -> Any:
    """Return a std_msgs/Header, in ROS 1 with a sequence number."""
    stamp = time_of(store, stamp_s)
    header = store.types["std_msgs/msg/Header"]
    return header(seq=0, stamp=stamp, frame_id=frame) if ros_version == 1 else header(stamp=stamp, frame_id=frame)


def time_of(store: Typestore, stamp_s: float | None) -> Any:
    """Return a builtin_interfaces/Time; zero without a stamp."""
    seconds, nanoseconds = divmod(round((stamp_s or 0.0) * NANOSECONDS), NANOSECONDS)
    return store.types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=nanoseconds)


def pose_of(store: Typestore, x_m: float, y_m: float, yaw_rad: float = 0.0) -> Any:
    """Return a geometry_msgs/Pose in the plane."""
    types, half = store.types, 0.5 * yaw_rad
    return types["geometry_msgs/msg/Pose"](
        position=types["geometry_msgs/msg/Point"](x=x_m, y=y_m, z=0.0),
        orientation=types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=math.sin(half), w=math.cos(half)),
    )


@contextlib.contextmanager
def _scratch(parent: Path) -> Iterator[Path]:
    """Yield a temporary folder for the writers of bags, in the file system of the result."""
    with tempfile.TemporaryDirectory(prefix=".bayesmap-", dir=parent) as folder:
        yield Path(folder)


def _in_order(channels: Sequence[Channel]) -> list[tuple[int, int, Message]]:
    """Return the time in nanoseconds, the channel and the message of all messages, in time order."""
    every = [
        (max(1, round((stamp_s or 0.0) * NANOSECONDS)), number, message)
        for number, channel in enumerate(channels)
        for stamp_s, message in channel.messages
    ]
    return sorted(every, key=lambda timed: timed[:2])


def _write_ros1(path: Path, channels: Sequence[Channel], store: Typestore) -> None:
    from rosbags.rosbag1 import Writer

    with Writer(path) as bag:
        connections = [
            bag.add_connection(c.topic, c.type_name, typestore=store, callerid="/bayesmap", latching=int(c.latched))
            for c in channels
        ]
        for when, number, message in _in_order(channels):
            bag.write(connections[number], when, store.serialize_ros1(message(store, 1), channels[number].type_name))


def _write_ros2(path: Path, ending: str, channels: Sequence[Channel], store: Typestore) -> None:
    from rosbags.rosbag2 import StoragePlugin, Writer

    plugin = StoragePlugin.MCAP if ending == ".mcap" else StoragePlugin.SQLITE3
    with Writer(path, version=ROS2_BAG_VERSION, storage_plugin=plugin) as bag:
        connections = [
            bag.add_connection(c.topic, c.type_name, typestore=store, offered_qos_profiles=[_quality(c.latched)])
            for c in channels
        ]
        for when, number, message in _in_order(channels):
            bag.write(connections[number], when, store.serialize_cdr(message(store, 2), channels[number].type_name))


def _quality(latched: bool) -> Qos:
    """Return the quality of service, without deadlines; if latched, that of nav2's map_server."""
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime

    never = QosTime(9_223_372_036, 854_775_807)  # RMW_DURATION_INFINITE
    return Qos(
        history=QosHistory.KEEP_LAST, depth=1 if latched else 10, reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL if latched else QosDurability.VOLATILE, deadline=never,
        lifespan=never, liveliness=QosLiveliness.AUTOMATIC, liveliness_lease_duration=never,
        avoid_ros_namespace_conventions=False,
    )  # fmt: skip


def write_occupancy_grid(
    path: str | os.PathLike[str], occupancy: ArrayLike, grid: Grid, observed: ArrayLike | None = None, *,
    stamp_s: float | None = None, **thresholds: Any,
) -> Path:  # fmt: skip
    """Write a map as the one message of a recording, an OccupancyGrid. Returns the path.

    ``occupancy``, ``grid``, ``observed`` and ``thresholds`` are those of `bayesmap.io.ros.maps.in_percent`.

    Raises `BadInput` as `in_percent`, for another ending, or a file that cannot be written.
    """
    from bayesmap.io.ros.maps import in_percent

    cells = in_percent(occupancy, grid, observed, **thresholds)

    def message(store: Typestore, ros_version: RosVersion) -> Any:
        info = store.types["nav_msgs/msg/MapMetaData"](
            map_load_time=time_of(store, stamp_s), resolution=grid.resolution, width=grid.shape[0],
            height=grid.shape[1], origin=pose_of(store, *grid.origin),
        )  # fmt: skip
        data = np.ascontiguousarray(cells.T).ravel()
        return store.types[OCCUPANCY_GRID](header=header_of(store, ros_version, FRAME, stamp_s), info=info, data=data)

    return write_channels(path, [Channel("/map", OCCUPANCY_GRID, [(stamp_s, message)])])


def write_grid_map(
    path: str | os.PathLike[str], layers: Mapping[str, ArrayLike], grid: Grid, observed: ArrayLike | None = None, *,
    stamp_s: float | None = None,
) -> Path:  # fmt: skip
    """Write layers (see `as_layers`) as the one message of a recording, a GridMap. Returns the path.

    The first layer is the basic layer.

    Raises `BadInput` for layers that do not fit, another ending, or a file that cannot be written.
    """
    checked = as_layers(grid, layers, observed)
    length_m = np.array(grid.shape) * grid.resolution
    x_m, y_m = (float(v) for v in np.array(grid.origin) + length_m / 2)

    def message(store: Typestore, ros_version: RosVersion) -> Any:
        # In ROS 1 the header belongs to the info, in ROS 2 to the map.
        header = {"header": header_of(store, ros_version, FRAME, stamp_s)}
        info = store.types[GRID_MAP_INFO](
            **(header if ros_version == 1 else {}), resolution=grid.resolution, length_x=float(length_m[0]),
            length_y=float(length_m[1]), pose=pose_of(store, x_m, y_m),
        )  # fmt: skip
        return store.types[GRID_MAP](
            **({} if ros_version == 1 else header), info=info, layers=list(checked), basic_layers=list(checked)[:1],
            data=[_matrix(store, values) for values in checked.values()], outer_start_index=0, inner_start_index=0,
        )  # fmt: skip

    return write_channels(path, [Channel("/grid_map", GRID_MAP, [(stamp_s, message)])])


def _matrix(store: Typestore, values: NDArray[np.float32]) -> Any:
    """Return a layer in Eigen's order, with the labels of grid_map."""
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

    Poses without stamps get stamps 0, 1, 2 and so on, in seconds.

    Raises `BadInput` for no pose, another ending, or a file that cannot be written.
    """
    if len(trajectory) == 0:
        raise BadInput("trajectory: there is no pose to write")
    stamps = trajectory.stamps_s
    stamps = np.arange(len(trajectory), dtype=np.float64) if stamps is None else stamps
    poses, times = trajectory.poses.tolist(), [float(stamp) for stamp in stamps]

    def path_message(store: Typestore, ros_version: RosVersion) -> Any:
        stamped = store.types["geometry_msgs/msg/PoseStamped"]
        listed = [
            stamped(header=header_of(store, ros_version, frame, stamp), pose=pose_of(store, *pose))
            for pose, stamp in zip(poses, times, strict=True)
        ]
        return store.types[PATH](header=header_of(store, ros_version, frame, times[-1]), poses=listed)

    def pose_message(at: int, store: Typestore, ros_version: RosVersion) -> Any:
        covariance = np.zeros((6, 6))
        covariance[np.ix_(IN_PLANE, IN_PLANE)] = trajectory.covariances[at]  # type: ignore[index]
        posed = store.types["geometry_msgs/msg/PoseWithCovariance"]
        pose = posed(pose=pose_of(store, *poses[at]), covariance=covariance.ravel())
        return store.types[POSE](header=header_of(store, ros_version, frame, times[at]), pose=pose)

    channels = [Channel("/trajectory", PATH, [(times[-1], path_message)])]
    if trajectory.covariances is not None:
        messages = [(stamp, partial(pose_message, i)) for i, stamp in enumerate(times)]
        channels.append(Channel("/pose", POSE, messages, latched=False))
    return write_channels(path, channels)


def write_scans(path: str | os.PathLike[str], scans: Scans, base: ArrayLike, mount: Sequence[float]) -> Path:
    """Write scans as a robot records them: /scan, odometry in /tf, and the laser's place in /tf_static.

    Args:
        path: the recording.
        scans: scans of one fan of beams, with stamps of 1 ns and later.
        base: poses of the robot's base as odometry reports them, shape (S, 3).
        mount: pose of the laser in the frame of the base.

    Raises `BadInput` for scans without stamps, another ending, or a file that cannot be written.
    """
    if scans.stamps_s is None or scans.own_angles_rad is not None:
        raise BadInput("recording: scans need stamps and one fan of beams")
    angles, stamps = scans.angles_rad, scans.stamps_s.tolist()

    def transform(
        stamp_s: float, frames: tuple[str, str], pose: Sequence[float], store: Typestore, ros_version: RosVersion
    ) -> Any:
        types, posed = store.types, pose_of(store, *pose)
        shift = types["geometry_msgs/msg/Vector3"](*(float(v) for v in (*pose[:2], 0.0)))
        moved = types["geometry_msgs/msg/Transform"](translation=shift, rotation=posed.orientation)
        stamped = types["geometry_msgs/msg/TransformStamped"]
        header = header_of(store, ros_version, frames[0], stamp_s)
        return types[TRANSFORMS](transforms=[stamped(header=header, child_frame_id=frames[1], transform=moved)])

    def scan(at: int, store: Typestore, ros_version: RosVersion) -> Any:
        return store.types[SCAN](
            header=header_of(store, ros_version, "laser", stamps[at]), angle_min=float(angles[0]),
            angle_max=float(angles[-1]),
            angle_increment=float(angles[1] - angles[0]), time_increment=0.0, scan_time=0.0,
            range_min=float(scans.min_range_m), range_max=float(scans.max_range_m),
            ranges=scans.ranges_m[at].astype(np.float32), intensities=np.zeros(0, np.float32),
        )  # fmt: skip

    poses = np.asarray(base, dtype=np.float64).tolist()
    moving = [(s, partial(transform, s, ("odom", "base_link"), p)) for s, p in zip(stamps, poses, strict=True)]
    channels = [
        Channel("/tf_static", TRANSFORMS, [(stamps[0], partial(transform, stamps[0], ("base_link", "laser"), mount))]),
        Channel("/tf", TRANSFORMS, moving, latched=False),
        Channel("/scan", SCAN, [(stamp, partial(scan, i)) for i, stamp in enumerate(stamps)], latched=False),
    ]
    return write_channels(path, channels)
