"""Messages, such as a map or a trajectory, as a recording that ROS plays: a ROS 1 bag, or ROS 2 in MCAP or sqlite.

    NAME.bag    ROS 1 bag, format 2.0, the connection latched
    NAME.mcap   one MCAP file, profile ros2, message definitions and the topic's quality of service inside
    NAME.db3    one sqlite file with the same (schema 4)
    NAME        a ROS 2 bag as ``ros2 bag record`` leaves it: a folder of metadata.yaml and NAME.db3

``ros2 bag play`` takes all of the last three. A map's topic is offered as nav2's map_server offers its map, reliable
and transient local (ROS 1: latched), so that whoever subscribes late gets the map too.
"""

from __future__ import annotations

import contextlib
import math
import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from bayesmap.errors import BadInput
from bayesmap.files import write_whole, write_whole_folder

if TYPE_CHECKING:
    from rosbags.interfaces import Qos
    from rosbags.typesys.store import Typestore

FOLDER = ""
ENDINGS = (".bag", ".mcap", ".db3", FOLDER)
ROS2_BAG_VERSION: Final = 8
"""Of the metadata; the last that every release since Humble reads."""

NANOSECONDS = 1_000_000_000

Message = Callable[["Typestore", int], Any]
"""Makes the message out of a type store's types, for ROS version 1 or 2."""


@dataclass(frozen=True)
class Channel:
    """A topic and its messages.

    Attributes:
        topic: such as ``/map``.
        type_name: such as ``nav_msgs/msg/OccupancyGrid``.
        messages: each with the time when the recording says that it came, seconds; a nanosecond if None (ROS refuses
            zero).
        latched: whether who subscribes late gets the last one.
    """

    topic: str
    type_name: str
    messages: Sequence[tuple[float | None, Message]]
    latched: bool = True


def container_of(path: str | os.PathLike[str]) -> str:
    """Return which of `ENDINGS` a path names; a trailing slash, an existing folder or no ending at all is a folder.

    Raises:
        BadInput: another ending.
    """
    name = os.fspath(path)
    if name.endswith(os.sep) or Path(path).is_dir():
        return FOLDER
    ending = Path(path).suffix.lower()
    if ending not in ENDINGS:
        raise BadInput(
            f"{path}: a recording ends in .bag (ROS 1), .mcap or .db3 (ROS 2), or is a folder without ending"
        )
    return ending


def write_channels(
    path: str | os.PathLike[str],
    channels: Sequence[Channel],
    *,
    definitions: Callable[[int], dict[str, str]] | None = None,
) -> Path:
    """Write topics with any number of messages as a recording, whole or not at all. Returns the path.

    Args:
        path: its ending chooses the container, see above.
        channels: the topics.
        definitions: message definitions, by type name, that rosbags lacks, for a ROS version.

    Raises:
        BadInput: another ending, or a file or folder that cannot be written.
    """
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    ending = container_of(path)
    ros = 1 if ending == ".bag" else 2
    store = get_typestore(Stores.ROS1_NOETIC if ros == 1 else Stores.ROS2_HUMBLE)
    for name, text in (definitions(ros) if definitions is not None else {}).items():
        store.register(get_types_from_msg(text, name))
    target = Path(path)
    if ending == FOLDER:
        # The bag names its file after its folder, so it is made in one of the right name and moved.
        with write_whole_folder(target, is_ros2_bag) as partial, _scratch(partial.parent) as scratch:
            made = scratch / target.name
            _write_ros2(made, ".db3", channels, store)
            os.replace(made, partial)
        return target
    with write_whole(target) as partial, _scratch(partial.parent) as scratch:
        made = scratch / target.stem
        if ending == ".bag":
            _write_ros1(made, channels, store)
            os.replace(made, partial)
        else:
            _write_ros2(made, ending, channels, store)
            os.replace(made / (made.name + ending), partial)
    return target


def is_ros2_bag(folder: Path) -> bool:
    """Return whether a folder holds a ROS 2 bag and nothing else."""
    files = list(folder.iterdir())
    return any(file.name == "metadata.yaml" for file in files) and all(
        file.name == "metadata.yaml" or file.suffix in (".db3", ".mcap") for file in files
    )


def header_of(store: Typestore, ros: int, frame: str, stamp_s: float | None) -> Any:
    """Return a std_msgs/Header: in ROS 1 with a sequence number."""
    stamp = time_of(store, stamp_s)
    header = store.types["std_msgs/msg/Header"]
    return header(seq=0, stamp=stamp, frame_id=frame) if ros == 1 else header(stamp=stamp, frame_id=frame)


def time_of(store: Typestore, stamp_s: float | None) -> Any:
    """Return a builtin_interfaces/Time; zero if there is none."""
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
    """Give a folder for what the writers of bags leave, in the same file system as what it becomes."""
    with tempfile.TemporaryDirectory(prefix=".bayesmap-", dir=parent) as folder:
        yield Path(folder)


def _in_order(channels: Sequence[Channel]) -> list[tuple[int, int, Message]]:
    """Return the time in nanoseconds, the channel and the message of all, in order of time."""
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
    """Return the quality of service: if latched, as nav2's map_server offers its map, without deadlines."""
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime

    never = QosTime(9_223_372_036, 854_775_807)  # RMW_DURATION_INFINITE
    return Qos(
        history=QosHistory.KEEP_LAST, depth=1 if latched else 10, reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL if latched else QosDurability.VOLATILE, deadline=never,
        lifespan=never, liveliness=QosLiveliness.AUTOMATIC, liveliness_lease_duration=never,
        avoid_ros_namespace_conventions=False,
    )  # fmt: skip
