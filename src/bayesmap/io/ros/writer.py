"""Write maps and trajectories as recordings that ROS plays: a ROS 1 bag, or ROS 2 in MCAP or sqlite.

docs/file-formats.md describes files and topics. A `Recorder` makes messages and writes `Channel`s of them; functions
such as `write_occupancy_grid` fill it. A map's topic has the quality of service of nav2's map_server, so that late
subscribers get the map, too. Covariances are 6 x 6, of x, y, z and rotations about the fixed axes x, y, z.
"""

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole, write_whole_folder
from bayesmap.space.grid import Grid, as_layers
from bayesmap.space.scans import Scans
from bayesmap.space.trajectory import Trajectory

FOLDER = ""  # the ending of a folder's name
ENDINGS = (".bag", ".mcap", ".db3", FOLDER)
ROS2_BAG_VERSION: Final = 8  # version of the metadata, the last that every release since Humble reads
NS_PER_S = 1_000_000_000
FRAME = "map"
OCCUPANCY_GRID = "nav_msgs/msg/OccupancyGrid"
GRID_MAP = "grid_map_msgs/msg/GridMap"
GRID_MAP_INFO = "grid_map_msgs/msg/GridMapInfo"
PATH = "nav_msgs/msg/Path"
POSE = "geometry_msgs/msg/PoseWithCovarianceStamped"
SCAN = "sensor_msgs/msg/LaserScan"
TRANSFORMS = "tf2_msgs/msg/TFMessage"
IN_PLANE = np.array([0, 1, 5])  # indices of x, y and yaw among the six components of ROS covariances

# Definitions of the messages of grid_map_msgs. In ROS 1 the header belongs to the info, in ROS 2 to the map.
_HEADER = "std_msgs/Header header\n"
_INFO = "float64 resolution\nfloat64 length_x\nfloat64 length_y\ngeometry_msgs/Pose pose\n"
_MAP = (
    "grid_map_msgs/GridMapInfo info\nstring[] layers\nstring[] basic_layers\nstd_msgs/Float32MultiArray[] data\n"
    "uint16 outer_start_index\nuint16 inner_start_index\n"
)


@dataclass(frozen=True)
class Channel:
    """A topic and its messages."""

    topic: str
    type_name: str
    messages: Sequence[tuple[float | None, Any]]  # (seconds of receipt, message); None, like 0, is written as 1 ns
    latched: bool = True  # whether late subscribers get the last message


def ending_of(path: str | os.PathLike[str]) -> str:
    """Return the ending of a path, one of `ENDINGS`; a path without ending is a folder. Raises `BadInput`."""
    if os.fspath(path).endswith(os.sep) or Path(path).is_dir():
        return FOLDER
    ending = Path(path).suffix.lower()
    if ending not in ENDINGS:
        raise BadInput(f"{path}: a recording ends in .bag (ROS 1), .mcap or .db3 (ROS 2), or is a folder without one")
    return ending


class Recorder:
    """A recording to be written, and the definitions of its messages. Raises `BadInput` for an unknown ending."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore

        self.target, self.ending = Path(path), ending_of(path)
        self.is_ros1 = self.ending == ".bag"
        self.store = get_typestore(Stores.ROS1_NOETIC if self.is_ros1 else Stores.ROS2_HUMBLE)
        # The messages of the package grid_map_msgs, which rosbags lacks.
        info, grid_map = (_HEADER + _INFO, _MAP) if self.is_ros1 else (_INFO, _HEADER + _MAP)
        self.store.register(get_types_from_msg(info, GRID_MAP_INFO) | get_types_from_msg(grid_map, GRID_MAP))

    def make(self, type_name: str, **values: Any) -> Any:
        """Return a message, given its fields."""
        return self.store.types[type_name](**values)

    def header(self, frame: str, stamp_s: float | None) -> Any:
        """Return a std_msgs/Header, in ROS 1 with a sequence number."""
        sequence = {"seq": 0} if self.is_ros1 else {}
        return self.make("std_msgs/msg/Header", **sequence, stamp=self.time(stamp_s), frame_id=frame)

    def time(self, stamp_s: float | None) -> Any:
        """Return a builtin_interfaces/Time; zero without a stamp."""
        seconds, nanoseconds = divmod(round((stamp_s or 0.0) * NS_PER_S), NS_PER_S)
        return self.make("builtin_interfaces/msg/Time", sec=seconds, nanosec=nanoseconds)

    def pose(self, x_m: float, y_m: float, yaw_rad: float = 0.0) -> Any:
        """Return a geometry_msgs/Pose in the plane."""
        position = self.make("geometry_msgs/msg/Point", x=x_m, y=y_m, z=0.0)
        half = 0.5 * yaw_rad
        orientation = self.make("geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=math.sin(half), w=math.cos(half))
        return self.make("geometry_msgs/msg/Pose", position=position, orientation=orientation)

    def transform(self, stamp_s: float, parent: str, child: str, pose: Sequence[float]) -> Any:
        """Return a tf2_msgs/TFMessage with one transform, the pose of a child frame in its parent."""
        x, y = (float(v) for v in pose[:2])
        translation = self.make("geometry_msgs/msg/Vector3", x=x, y=y, z=0.0)
        rotation = self.pose(*pose).orientation
        transform = self.make("geometry_msgs/msg/Transform", translation=translation, rotation=rotation)
        frames = {"header": self.header(parent, stamp_s), "child_frame_id": child}
        stamped = self.make("geometry_msgs/msg/TransformStamped", **frames, transform=transform)
        return self.make(TRANSFORMS, transforms=[stamped])

    def write(self, *channels: Channel) -> Path:
        """Write topics, whole or not at all, and return the path. Raises `BadInput` if the path cannot be written."""
        # rosbags names a bag's file after its folder: write a bag of the target's name beside it, then move it.
        target = self.target
        is_folder = self.ending == FOLDER
        whole = write_whole_folder(target, is_ros2_bag) if is_folder else write_whole(target)
        with whole as unfinished, TemporaryDirectory(prefix=".bayesmap-", dir=unfinished.parent) as scratch:
            bag = Path(scratch) / (target.name if is_folder else target.stem)
            self._write(bag, channels)
            os.replace(bag if is_folder or self.is_ros1 else bag / (bag.name + self.ending), unfinished)
        return target

    def _write(self, path: Path, channels: Sequence[Channel]) -> None:
        from rosbags import rosbag1, rosbag2

        plugin = rosbag2.StoragePlugin.MCAP if self.ending == ".mcap" else rosbag2.StoragePlugin.SQLITE3
        serialize = self.store.serialize_ros1 if self.is_ros1 else self.store.serialize_cdr
        bag: Any = (
            rosbag1.Writer(path) if self.is_ros1
            else rosbag2.Writer(path, version=ROS2_BAG_VERSION, storage_plugin=plugin)
        )  # fmt: skip
        with bag:
            connections = []
            for channel in channels:
                options: dict[str, Any] = (
                    {"callerid": "/bayesmap", "latching": int(channel.latched)} if self.is_ros1
                    else {"offered_qos_profiles": [_quality_of_service(channel.latched)]}
                )  # fmt: skip
                connection = bag.add_connection(channel.topic, channel.type_name, typestore=self.store, **options)
                connections.append(connection)
            messages = [
                (max(1, round((stamp_s or 0.0) * NS_PER_S)), number, message)
                for number, channel in enumerate(channels)
                for stamp_s, message in channel.messages
            ]
            for time_ns, number, message in sorted(messages, key=lambda timed: timed[:2]):
                bag.write(connections[number], time_ns, serialize(message, channels[number].type_name))


def is_ros2_bag(folder: Path) -> bool:
    """Return whether a folder holds a ROS 2 bag and nothing else."""
    return [file.name for file in folder.iterdir() if file.suffix not in (".db3", ".mcap")] == ["metadata.yaml"]


def _quality_of_service(latched: bool) -> Any:
    """Return the quality of service, without deadlines; if latched, as nav2's map_server has it."""
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
    """Write a recording of one OccupancyGrid. Arguments and errors are those of `in_percent` and `Recorder`."""
    from bayesmap.io.ros.maps import in_percent

    cells = in_percent(occupancy, grid, observed, **thresholds)
    ros = Recorder(path)
    info = ros.make(
        "nav_msgs/msg/MapMetaData", map_load_time=ros.time(stamp_s), resolution=grid.resolution, width=grid.shape[0],
        height=grid.shape[1], origin=ros.pose(*grid.origin),
    )  # fmt: skip
    data = np.ascontiguousarray(cells.T).ravel()
    message = ros.make(OCCUPANCY_GRID, header=ros.header(FRAME, stamp_s), info=info, data=data)
    return ros.write(Channel("/map", OCCUPANCY_GRID, [(stamp_s, message)]))


def write_grid_map(
    path: str | os.PathLike[str], layers: Mapping[str, ArrayLike], grid: Grid, observed: ArrayLike | None = None, *,
    stamp_s: float | None = None,
) -> Path:  # fmt: skip
    """Write layers (see `as_layers`), the first as the basic layer, as the one message of a recording, a GridMap.
    Cells that no beam reached are NaN in all layers, and so invalid in grid_map. Raises `BadInput`
    for layers that do not fit, another ending, or a file that cannot be written.
    """
    checked = as_layers(grid, layers, observed)
    ros = Recorder(path)
    length_m = np.array(grid.shape) * grid.resolution
    x_m, y_m = (float(v) for v in np.array(grid.origin) + length_m / 2)
    # In ROS 1 the header belongs to the info, in ROS 2 to the map.
    header = {"header": ros.header(FRAME, stamp_s)}
    info = ros.make(
        GRID_MAP_INFO, **(header if ros.is_ros1 else {}), resolution=grid.resolution, length_x=float(length_m[0]),
        length_y=float(length_m[1]), pose=ros.pose(x_m, y_m),
    )  # fmt: skip
    message = ros.make(
        GRID_MAP, **({} if ros.is_ros1 else header), info=info, layers=list(checked), basic_layers=list(checked)[:1],
        data=[_matrix(ros, values) for values in checked.values()], outer_start_index=0, inner_start_index=0,
    )  # fmt: skip
    return ros.write(Channel("/grid_map", GRID_MAP, [(stamp_s, message)]))


def _matrix(ros: Recorder, values: NDArray[np.float32]) -> Any:
    """Return a layer, (nx, ny), as grid_map stores it (Fankhauser and Hutter 2016, "A Universal Grid Map Library").
    Row 0, column 0 is the corner with the largest x and y; rows run towards -x, columns towards -y. A layer is a matrix
    in Eigen's order, by columns. Cell (i, j) is at ``data[column * nx + row]``, row nx - 1 - i and column ny - 1 - j.
    """
    rows, columns = values.shape
    sizes = (("column_index", columns, rows * columns), ("row_index", rows, rows))
    dimensions = [
        ros.make("std_msgs/msg/MultiArrayDimension", label=label, size=size, stride=stride)
        for label, size, stride in sizes
    ]
    layout = ros.make("std_msgs/msg/MultiArrayLayout", dim=dimensions, data_offset=0)
    return ros.make("std_msgs/msg/Float32MultiArray", layout=layout, data=values[::-1, ::-1].ravel(order="F"))


def write_trajectory_recording(path: str | os.PathLike[str], trajectory: Trajectory, *, frame: str = FRAME) -> Path:
    """Write a trajectory as a recording, whole or not at all; without stamps, poses get 0, 1, 2 and so on, in seconds.
    Raises `BadInput` for no pose, another ending, or a file that cannot be written.
    """
    if len(trajectory) == 0:
        raise BadInput("trajectory: there is no pose to write")
    ros = Recorder(path)
    stamps = np.arange(len(trajectory)) if trajectory.stamps_s is None else trajectory.stamps_s
    times, poses = [float(stamp) for stamp in stamps], [ros.pose(*pose) for pose in trajectory.poses.tolist()]
    stamped = [
        ros.make("geometry_msgs/msg/PoseStamped", header=ros.header(frame, stamp), pose=pose)
        for pose, stamp in zip(poses, times, strict=True)
    ]
    path_message = ros.make(PATH, header=ros.header(frame, times[-1]), poses=stamped)
    channels = [Channel("/trajectory", PATH, [(times[-1], path_message)])]
    if trajectory.covariances is not None:
        covariances = np.zeros((len(poses), 6, 6))
        covariances[:, IN_PLANE[:, None], IN_PLANE] = trajectory.covariances
        messages = []
        for pose, stamp, covariance in zip(poses, times, covariances, strict=True):
            with_covariance = ros.make("geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=covariance.ravel())
            messages.append((stamp, ros.make(POSE, header=ros.header(frame, stamp), pose=with_covariance)))
        channels.append(Channel("/pose", POSE, messages, latched=False))
    return ros.write(*channels)


def write_scans(path: str | os.PathLike[str], scans: Scans, base_poses: ArrayLike, mount: Sequence[float]) -> Path:
    """Write scans as a robot records them: /scan, odometry in /tf, and the laser's place in /tf_static.
    The scans have one fan of two beams or more, and stamps of 1 ns and later. ``base_poses``, (S, 3), are the poses of
    the robot's base by its odometry, and ``mount`` is the pose of the laser in the frame of the base. Raises `BadInput`
    for scans without stamps, another ending, or a file that cannot be written.
    """
    if scans.stamps_s is None or scans.own_angles_rad is not None:
        raise BadInput("recording: scans need stamps and one fan of beams")
    ros = Recorder(path)
    angles, stamps = scans.angles_rad, scans.stamps_s.tolist()
    limits = {"range_min": float(scans.min_range_m), "range_max": float(scans.max_range_m)}
    first, last, step = float(angles[0]), float(angles[-1]), float(angles[1] - angles[0])
    beams = {"angle_min": first, "angle_max": last, "angle_increment": step, "time_increment": 0.0, "scan_time": 0.0}
    constant = {**beams, **limits, "intensities": np.zeros(0, np.float32)}
    readings = [
        ros.make(SCAN, header=ros.header("laser", stamp), ranges=ranges.astype(np.float32), **constant)
        for ranges, stamp in zip(scans.ranges_m, stamps, strict=True)
    ]
    poses = np.asarray(base_poses, dtype=np.float64).tolist()
    odometry = [
        (stamp, ros.transform(stamp, "odom", "base_link", pose)) for stamp, pose in zip(stamps, poses, strict=True)
    ]
    return ros.write(
        Channel("/tf_static", TRANSFORMS, [(stamps[0], ros.transform(stamps[0], "base_link", "laser", mount))]),
        Channel("/tf", TRANSFORMS, odometry, latched=False),
        Channel("/scan", SCAN, list(zip(stamps, readings, strict=True)), latched=False),
    )
