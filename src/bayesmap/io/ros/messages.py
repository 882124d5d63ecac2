"""Read the messages of a recording as scans and poses: select the topic, and find the definitions of messages.

The definition in the recording decides how a message is read; definitions that ROS ships complete it. By the definition
of ``sensor_msgs/LaserScan``, beam i points to ``angle_min + i * angle_increment``; ``angle_max`` is not needed.
Begin with `scan_topic_of` and `read_messages`.
"""

import math
import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

from bayesmap.errors import BadInput
from bayesmap.io.ros.containers import REMEDY, ZSTD, NotUnpacked, reason_of, unpack_zstd
from bayesmap.io.ros.frames import PoseMessages, frame_name, stamp_ns_of
from bayesmap.io.ros.recording import LASER_SCAN, RANGE, SCAN_TYPES, Damaged, MalformedMessage, Recording, Topic
from bayesmap.space.scans import MAX_BEAMS, Fan, fan_fault, side_by_side

Reject = Callable[[str, int, str], None]  # called with unusable messages: topic, number, reason
READABLE = ("cdr", "ros1")  # encodings that can be read
IDL_SEPARATOR = "=" * 80 + "\n"  # line between the types of a definition
MAX_MESSAGE_BYTES = 1 << 28  # larger sizes are taken for damage
SAME_ANGLE_RAD = 1e-5  # largest difference of the first and last angles of equal fans: angles are in single precision
AS_DEFINED = "beam i was taken at angle_min + i * angle_increment, as the message is defined"


@dataclass(frozen=True)
class Layout(Fan):
    """The beams of a scan, and their frame."""

    frame: str

    def equals(self, other: "Layout") -> bool:
        """Return whether two scans have the same beams, within single precision."""
        span = (self.beams - 1) * (self.step_rad - other.step_rad)
        offset = self.first_rad - other.first_rad
        is_same = (self.frame, self.beams) == (other.frame, other.beams)
        return is_same and abs(offset) <= SAME_ANGLE_RAD and abs(offset + span) <= SAME_ANGLE_RAD


@dataclass(frozen=True, eq=False)
class LaserMessage:
    """The scan of one message."""

    number: int  # number of the message on its topic, from 1
    received_ns: int
    stamp_ns: int  # time of the first ray; 0 if the driver did not state it
    layout: Layout
    ranges_m: NDArray[np.float32]  # raw readings, (A,)
    limits_m: tuple[float, float]  # smallest and largest range
    ray_interval_s: float  # time from one ray to the next (``time_increment``)
    oddity: str = ""  # an unusual but acceptable property, in words


def laser_message(type_name: str, message: Any, number: int, received_ns: int) -> LaserMessage:
    """Return a message as a scan. Raises `MalformedMessage` for angles that do not fit its readings."""
    if type_name == RANGE:
        layout = Layout(1, 0.0, 0.0, frame_name(message.header.frame_id))
        oddity = ""
        readings = np.array([message.range], dtype=np.float32)
        limits = float(message.min_range), float(message.max_range)
        interval = 0.0
    else:
        readings = np.asarray(message.ranges, dtype=np.float32)
        layout, oddity = _layout(message, len(readings))
        limits = float(message.range_min), float(message.range_max)
        interval = float(message.time_increment)
    return LaserMessage(number, received_ns, stamp_ns_of(message.header), layout, readings, limits, interval, oddity)


def _layout(message: Any, beams: int) -> tuple[Layout, str]:
    """Return the beams of a LaserScan, and its oddity, see `LaserMessage`. Raises `MalformedMessage`."""
    first, last, step = (float(v) for v in (message.angle_min, message.angle_max, message.angle_increment))
    if beams > MAX_BEAMS:
        raise MalformedMessage(f"has {beams:,} readings; more than {MAX_BEAMS:,} are taken for damage")
    frame = frame_name(message.header.frame_id)
    if beams == 0:
        return Layout(0, 0.0, 0.0, frame), ""
    if not math.isfinite(first):
        raise MalformedMessage(f"has angle_min {first:g}")
    if beams == 1:
        return Layout(1, first, 0.0, frame), ""
    if not math.isfinite(step):
        raise MalformedMessage(f"has angle_increment {step:g}")
    oddity = ""
    if step == 0:
        if first == last or not math.isfinite(last):
            raise MalformedMessage(f"has {beams} readings, but angle_increment 0 and angle_max {last:g}")
        step = (last - first) / (beams - 1)
        oddity = "angle_increment is 0; it was taken from angle_min and angle_max"
    end = first + step * (beams - 1)
    if (fault := fan_fault(min(first, end), max(first, end))) is not None:
        raise MalformedMessage(f"has {beams} readings, angle_min {first:g} and angle_increment {step:g}: {fault}")
    return Layout(beams, first, step, frame), oddity or _end_oddity(first, last, step, beams)


def _end_oddity(first: float, last: float, step: float, beams: int) -> str:
    """Return the contradiction between ``angle_max`` and the other angles, in words; "" if there is none."""
    if not math.isfinite(last):
        return f"angle_max is {last:g}; {AS_DEFINED}"
    # The number of beams by angle_max, which may be a turn less if the beams pass behind the sensor.
    steps = [(last + turn - first) / step for turn in (0.0, math.copysign(2 * math.pi, step))]
    counts = [round(min(max(n_steps, -1e9), 1e9)) + 1 for n_steps in steps]
    count = min(counts, key=lambda count: abs(count - beams))
    if count == beams:
        return ""
    if abs(count - beams) == 1:
        return f"angle_max counts one beam {'more' if count > beams else 'less'} than there are readings"
    if (last - first) * step < 0:
        fault = f"is {'negative' if step < 0 else 'positive'}, but angle_max lies the other way from angle_min"
        warning = "If the sensor turns the other way round, the map is a mirror image"
        return f"angle_increment {fault}; {AS_DEFINED}. {warning}"
    return f"angle_max does not fit the number of readings and angle_increment; {AS_DEFINED}"


def in_commonest_frame(topic: str, scans: list[LaserMessage], reject: Reject) -> list[LaserMessage]:
    """Return the scans with readings in the commonest frame, and reject the others."""
    scans = [scan for scan in scans if scan.layout.beams]
    frame = Counter(scan.layout.frame for scan in scans).most_common(1)[0][0] if scans else ""
    for scan in scans:
        if scan.layout.frame != frame:
            reject(topic, scan.number, f"is in frame {scan.layout.frame!r}, but most scans of {topic} in {frame!r}")
    return [scan for scan in scans if scan.layout.frame == frame]


def beams_of(scans: Sequence[LaserMessage]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return angles in the sensor's frame, (A,), or (S, A) if beams differ, and readings, (S, A)."""
    first = scans[0].layout
    if all(scan.layout is first or scan.layout.equals(first) for scan in scans):
        with np.errstate(invalid="ignore"):  # readings may hold signalling NaN
            return first.angles_rad(), np.array([scan.ranges_m for scan in scans], dtype=np.float64)
    return side_by_side([scan.layout.angles_rad() for scan in scans], [scan.ranges_m for scan in scans])


def scan_topic_of(recording: Recording, name: str | None) -> Topic:
    """Return the named topic, or else the only topic of scans, or of ranges. Raises `BadInput` with the choices."""
    topics = recording.of_type(SCAN_TYPES)
    others = ", ".join(map(str, recording.topics.values()))
    choices = f"no topic holds {' or '.join(SCAN_TYPES)}; there are {others}"
    choices = f"scans are on {', '.join(map(str, topics))}" if topics else choices
    if name is not None:
        topic = recording.named("--scan-topic", name, SCAN_TYPES, choices)
    else:
        candidates = [topic for topic in topics if topic.type == LASER_SCAN] or topics
        if not candidates:
            raise BadInput(f"{recording.path}: {choices}" + "".join(f" ({note})" for note in recording.notes))
        if len(candidates) > 1:
            names = ", ".join(map(str, candidates))
            raise BadInput(f"{recording.path}: several topics hold scans; choose one with --scan-topic: {names}")
        topic = candidates[0]
    if topic.encoding not in READABLE:
        raise BadInput(f"{recording.path}: {topic.name} is in {topic.encoding!r}; {' and '.join(READABLE)} are read")
    return topic


def read_messages(recording: Recording, topics: list[Topic], poses: PoseMessages, reject: Reject) -> list[LaserMessage]:
    """Return the scans on topics, and add other messages to poses. Raises `BadInput` for a damaged recording."""
    by_name = {topic.name: topic for topic in topics}
    scans: list[LaserMessage] = []
    counts: Counter[str] = Counter()
    try:
        types = {topic.name: _types_of(topic) for topic in by_name.values()}
        for message in recording.read(frozenset(by_name)):
            topic = by_name[message.topic]
            counts[topic.name] += 1
            try:
                content = _content(types[topic.name], topic, message.data)
                if topic.type in SCAN_TYPES:
                    scans.append(laser_message(topic.type, content, counts[topic.name], message.received_ns))
                else:
                    poses.add(topic, content, message.received_ns)
            except MalformedMessage as problem:
                reject(topic.name, counts[topic.name], str(problem))
            except AttributeError as error:  # a definition that was damaged, or one of somebody's own
                if not hasattr(error.obj, "__msgtype__"):
                    raise
                reject(topic.name, counts[topic.name], f"{topic.type} lacks the field {error.name!r}")
    except Damaged as problem:
        raise BadInput(f"{recording.path}: the recording is damaged or cut short ({problem}); {REMEDY}") from None
    return scans


def _content(types: Any, topic: Topic, data: bytes) -> Any:
    """Return a message with its fields as attributes. Raises `MalformedMessage` if they do not fit the definition."""
    try:
        if topic.encoding == "ros1":
            return types.deserialize_ros1(data, topic.type)
        if data.startswith(ZSTD):  # recorded with --compression-mode message; CDR begins otherwise
            data = unpack_zstd(data, MAX_MESSAGE_BYTES)
        return types.deserialize_cdr(data, topic.type)
    except NotUnpacked as problem:
        raise MalformedMessage(f"{topic.type} is compressed by zstd and cannot be unpacked: {problem}") from None
    except Exception as error:  # rosbags raises many kinds of errors
        raise MalformedMessage(f"{topic.type} of {len(data):,} bytes cannot be read: {reason_of(error)}") from None


@cache
def _ros_types(encoding: str) -> Any:
    """Return the types of messages of ROS 1 or ROS 2, by the encoding of a recording."""
    if encoding != "ros1":
        return get_typestore(Stores.ROS2_HUMBLE)
    store = get_typestore(Stores.ROS1_NOETIC)
    for name in ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"):
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms\n", name))
    return store


def _types_of(topic: Topic) -> Any:
    """Return the definitions to read the messages of a topic: the recording's, or else ROS's own.
    Databases before ROS 2 Iron hold no definitions; the messages that are read here were equal in all versions before.
    Raises `Damaged` for a definition that cannot be parsed, of a type or an MD5 sum that ROS does not know.
    """
    shipped = _ros_types(topic.encoding)
    if not topic.definition.strip():
        return shipped
    store = get_typestore(Stores.EMPTY)
    try:
        store.register(_parsed(topic))
        added = _add_missing_types(store, shipped)
        store.get_msgdef(topic.type)
        if not added or _md5_of(store, topic) in (topic.md5, None):
            return store
        problem = f"it lacks {', '.join(added)}"
    except Exception as error:  # the parser raises many kinds of errors
        problem = reason_of(error)[:200]
    # The type and its sum identify the messages, even if the definition is unusable.
    if topic.type in shipped.fielddefs and _md5_of(shipped, topic) in (topic.md5, None):
        return shipped
    raise Damaged(f"the definition of {topic.type} on {topic.name} cannot be used: {problem}")


def _parsed(topic: Topic) -> dict[str, Any]:
    """Return the types in the definition of a topic's messages, by name."""
    if topic.language != "idl":
        return get_types_from_msg(topic.definition, topic.type)
    types: dict[str, Any] = {}
    for text in topic.definition.split(IDL_SEPARATOR):
        if text.strip():
            types |= get_types_from_idl(text.split("\n", 1)[1] if text.startswith("IDL: ") else text)
    return types


def _add_missing_types(store: Any, shipped: Any) -> list[str]:
    """Add the types that a store refers to and lacks, and the types that these refer to. Returns their names."""
    added: list[str] = []
    while True:
        fields = [field for _, fields in store.fielddefs.values() for _, field in fields]
        referred = [_message_type(*field) for field in fields]
        missing = sorted({name for name in referred if name} - store.fielddefs.keys())
        if not missing:
            return added
        store.register({name: shipped.fielddefs[name] for name in missing})
        added += missing


def _message_type(node: Any, args: Any) -> str | None:
    """Return the type of a field, or of its elements, if it is a message; else None."""
    if node in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        node, args = args[0]
    return str(args) if node == Nodetype.NAME else None


def _md5_of(store: Any, topic: Topic) -> str | None:
    """Return ROS 1's MD5 sum over a definition; None if the recording states no sum to compare with."""
    if not re.fullmatch("[0-9a-f]{32}", topic.md5):
        return None
    return str(store.generate_msgdef(topic.type, ros_version=1)[1])
