"""One message, such as a map, as a recording that ROS plays: a ROS 1 bag, or a ROS 2 bag in MCAP or sqlite.

    NAME.bag    ROS 1 bag, format 2.0, the connection latched
    NAME.mcap   one MCAP file, profile ros2, message definitions and the topic's quality of service inside
    NAME.db3    one sqlite file with the same (schema 4)
    NAME        a ROS 2 bag as ``ros2 bag record`` leaves it: a folder of metadata.yaml and NAME.db3

``ros2 bag play`` takes all of the last three. The topic is offered as nav2's map_server offers its map, reliable and
transient local (ROS 1: latched), so that whoever subscribes late gets the map too.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from bayesmap.errors import BadInput
from bayesmap.io.atomic import write_whole
from bayesmap.io.atomic_folder import write_whole_folder

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


def container_of(path: str | os.PathLike[str]) -> str:
    """Which of `ENDINGS` a path names; a trailing slash, an existing folder or no ending at all is a folder.

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


def write_recording(
    path: str | os.PathLike[str],
    topic: str,
    type_name: str,
    message: Message,
    *,
    stamp_s: float | None = None,
    definitions: Callable[[int], dict[str, str]] | None = None,
) -> Path:
    """Write one message as a recording, whole or not at all.

    Args:
        path: its ending chooses the container, see above.
        topic: such as ``/map``.
        type_name: such as ``nav_msgs/msg/OccupancyGrid``.
        message: makes the message, given a type store and the ROS version.
        stamp_s: when the recording says that the message came; a nanosecond if None (ROS refuses zero).
        definitions: message definitions, by type name, that rosbags lacks, for a ROS version.

    Returns:
        The path.

    Raises:
        BadInput: another ending, or a file or folder that cannot be written.
    """
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    ending = container_of(path)
    ros = 1 if ending == ".bag" else 2
    store = get_typestore(Stores.ROS1_NOETIC if ros == 1 else Stores.ROS2_HUMBLE)
    for name, text in (definitions(ros) if definitions is not None else {}).items():
        store.register(get_types_from_msg(text, name))
    when = max(1, round((stamp_s or 0.0) * NANOSECONDS))
    content = message(store, ros)
    target = Path(path)
    if ending == FOLDER:
        # The bag names its file after its folder, so it is made in one of the right name and moved.
        with write_whole_folder(target, is_ros2_bag) as partial, _scratch(partial.parent) as scratch:
            made = scratch / target.name
            _write_ros2(made, ".db3", topic, type_name, store, content, when)
            os.replace(made, partial)
        return target
    with write_whole(target) as partial, _scratch(partial.parent) as scratch:
        made = scratch / target.stem
        if ending == ".bag":
            _write_ros1(made, topic, type_name, store, content, when)
            os.replace(made, partial)
        else:
            _write_ros2(made, ending, topic, type_name, store, content, when)
            os.replace(made / (made.name + ending), partial)
    return target


def is_ros2_bag(folder: Path) -> bool:
    """Whether a folder holds a ROS 2 bag and nothing else."""
    files = list(folder.iterdir())
    return any(file.name == "metadata.yaml" for file in files) and all(
        file.name == "metadata.yaml" or file.suffix in (".db3", ".mcap") for file in files
    )


def header_of(store: Typestore, ros: int, frame: str, stamp_s: float | None) -> Any:
    """A std_msgs/Header: in ROS 1 with a sequence number."""
    stamp = time_of(store, stamp_s)
    header = store.types["std_msgs/msg/Header"]
    return header(seq=0, stamp=stamp, frame_id=frame) if ros == 1 else header(stamp=stamp, frame_id=frame)


def time_of(store: Typestore, stamp_s: float | None) -> Any:
    """A builtin_interfaces/Time; zero if there is none."""
    seconds, nanoseconds = divmod(round((stamp_s or 0.0) * NANOSECONDS), NANOSECONDS)
    return store.types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=nanoseconds)


def pose_of(store: Typestore, x_m: float, y_m: float) -> Any:
    """A geometry_msgs/Pose in the plane, not turned."""
    types = store.types
    return types["geometry_msgs/msg/Pose"](
        position=types["geometry_msgs/msg/Point"](x=x_m, y=y_m, z=0.0),
        orientation=types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0),
    )


@contextlib.contextmanager
def _scratch(parent: Path) -> Iterator[Path]:
    """A folder for what the writers of bags leave, in the same file system as what it becomes."""
    with tempfile.TemporaryDirectory(prefix=".bayesmap-", dir=parent) as folder:
        yield Path(folder)


def _write_ros1(path: Path, topic: str, type_name: str, store: Typestore, content: Any, when: int) -> None:
    from rosbags.rosbag1 import Writer

    with Writer(path) as bag:
        connection = bag.add_connection(topic, type_name, typestore=store, callerid="/bayesmap", latching=1)
        bag.write(connection, when, store.serialize_ros1(content, type_name))


def _write_ros2(path: Path, ending: str, topic: str, type_name: str, store: Typestore, content: Any, when: int) -> None:
    from rosbags.rosbag2 import StoragePlugin, Writer

    plugin = StoragePlugin.MCAP if ending == ".mcap" else StoragePlugin.SQLITE3
    with Writer(path, version=ROS2_BAG_VERSION, storage_plugin=plugin) as bag:
        connection = bag.add_connection(topic, type_name, typestore=store, offered_qos_profiles=[_latched()])
        bag.write(connection, when, store.serialize_cdr(content, type_name))


def _latched() -> Qos:
    """As nav2's map_server offers its map: the last one, reliable, transient local, without deadlines."""
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime

    never = QosTime(9_223_372_036, 854_775_807)  # RMW_DURATION_INFINITE
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=1,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL,
        deadline=never,
        lifespan=never,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=never,
        avoid_ros_namespace_conventions=False,
    )
