"""Recordings of a simulated robot, by rosbags' and mcap's writers; each serialises plain dictionaries in its way."""

import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from rosbags.interfaces import Nodetype
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

import bayesmap as bm
from bayesmap.io.logs import describe_log, read_log
from bayesmap.io.ros.recording import zstd

T0 = 1_700_000_000 * 10**9
SCAN, RANGE = "sensor_msgs/msg/LaserScan", "sensor_msgs/msg/Range"
TF, ODOM = "tf2_msgs/msg/TFMessage", "nav_msgs/msg/Odometry"
POSE, POSE_COV = "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped"


@cache
def ros2():
    return get_typestore(Stores.ROS2_HUMBLE)


@cache
def ros1():
    store = get_typestore(Stores.ROS1_NOETIC)
    store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms\n", TF))
    return store


WRITERS = ("rosbag1", "sqlite3", "db3", "mcap-folder", "mcap", "mcap-zstd", "mcap-lz4", "mcap-plain", "mcap-ros1")
COMPRESSED = {
    "rosbag1-bz2": Writer1.CompressionFormat.BZ2, "rosbag1-lz4": Writer1.CompressionFormat.LZ4,
    "db3-messages": CompressionMode.MESSAGE, "db3-file": CompressionMode.FILE,
    "mcap-messages": CompressionMode.MESSAGE, "mcap-file": CompressionMode.FILE,
}  # fmt: skip
"""Bags whose chunks are compressed, and single files of a folder whose messages, or which themselves, are."""


def ns(seconds):
    return T0 + round(seconds * 1e9)


def header(seconds, frame):
    stamp = 0 if seconds is None else ns(seconds)
    return {"stamp": {"sec": stamp // 10**9, "nanosec": stamp % 10**9}, "frame_id": frame}


def quaternion(yaw, roll=0.0, pitch=0.0):
    cr, sr, cp, sp = math.cos(roll / 2), math.sin(roll / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return {
        "x": sr * cp * cy - cr * sp * sy, "y": cr * sp * cy + sr * cp * sy,
        "z": cr * cp * sy - sr * sp * cy, "w": cr * cp * cy + sr * sp * sy,
    }  # fmt: skip


def point(x, y, z=0.0):
    return {"x": float(x), "y": float(y), "z": float(z)}


def transform(seconds, parent, child, x, y, yaw, z=0.0, **angles):
    where = {"translation": point(x, y, z), "rotation": quaternion(yaw, **angles)}
    return {"header": header(seconds, parent), "child_frame_id": child, "transform": where}


def tf(*transforms):
    return {"transforms": list(transforms)}


def posed(x, y, yaw):
    return {"position": point(x, y), "orientation": quaternion(yaw)}


def odometry(seconds, x, y, yaw, frame="odom", child="base_link"):
    still = {"twist": {"linear": point(0, 0), "angular": point(0, 0)}, "covariance": [0.0] * 36}
    pose = {"pose": posed(x, y, yaw), "covariance": [0.0] * 36}
    return {"header": header(seconds, frame), "child_frame_id": child, "pose": pose, "twist": still}


def laser(seconds, ranges, angles, frame="laser", limits=(0.1, 42.0), ray_s=0.0, **changed):
    step = (angles[-1] - angles[0]) / (len(angles) - 1) if len(angles) > 1 else 0.0
    message = {
        "header": header(seconds, frame), "angle_min": float(angles[0]), "angle_max": float(angles[-1]),
        "angle_increment": float(step), "time_increment": ray_s, "scan_time": 0.1,
        "range_min": limits[0], "range_max": limits[1],
        "ranges": [float(v) for v in ranges], "intensities": [],
    }  # fmt: skip
    return {**message, **changed}


def sonar(seconds, reading, frame="sonar"):
    return {
        "header": header(seconds, frame), "radiation_type": 0, "field_of_view": 0.1,
        "min_range": 0.1, "max_range": 8.0, "range": float(reading),
    }  # fmt: skip


def written(path: Path, messages, writer="mcap", definitions=None):
    """Write (topic, type, seconds received, message), for ROS 1 with ``definitions`` {type: (text, MD5)}; the path."""
    path.mkdir(parents=True, exist_ok=True)
    if writer.startswith("rosbag1"):
        return _rosbag1(path, messages, writer, definitions or {})
    return {"mcap-ros1": _mcap_ros1}.get(writer, _ros2)(path, messages, writer)


def packed(content):
    """Pack by zstd in blocks of 4 kB, so that a broken file can be unpacked as far as it goes."""
    packer = zstd().ZstdCompressor()
    blocks = (packer.compress(content[i : i + 4096], packer.FLUSH_BLOCK) for i in range(0, len(content), 4096))
    return b"".join(blocks) + packer.flush()


def _rosbag1(path, messages, writer, definitions):
    file = path / "recording.bag"
    bag = Writer1(file)
    if writer in COMPRESSED:
        bag.set_compression(COMPRESSED[writer])
    with bag:
        connections = {}
        for topic, kind, seconds, message in messages:
            if topic not in connections:
                text, md5 = definitions.get(kind) or ros1().generate_msgdef(kind, ros_version=1)
                connections[topic] = bag.add_connection(topic, kind, msgdef=text, md5sum=md5)
            bag.write(connections[topic], ns(seconds), ros1().serialize_ros1(_built(ros1(), kind, message), kind))
    return file


def _ros2(path, messages, writer):
    if writer in ("mcap-zstd", "mcap-lz4", "mcap-plain"):
        return _mcap_ros2(path, messages, writer.removeprefix("mcap-"))
    folder = path / "recording"
    storage = StoragePlugin.SQLITE3 if writer.startswith(("sqlite3", "db3")) else StoragePlugin.MCAP
    bag = Writer2(folder, version=9, storage_plugin=storage)
    if writer in COMPRESSED:
        bag.set_compression(COMPRESSED[writer], CompressionFormat.ZSTD)
    with bag:
        connections = {}
        for topic, kind, seconds, message in messages:
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, kind, typestore=ros2())
            bag.write(connections[topic], ns(seconds), ros2().serialize_cdr(_built(ros2(), kind, message), kind))
    if writer in ("sqlite3", "mcap-folder"):
        return folder
    return next(file for file in folder.iterdir() if file.name != "metadata.yaml")


def _mcap_ros2(path, messages, compression):
    from mcap.writer import CompressionType
    from mcap_ros2.writer import Writer

    file = path / "recording.mcap"
    chosen = {"zstd": CompressionType.ZSTD, "lz4": CompressionType.LZ4, "plain": CompressionType.NONE}[compression]
    with file.open("wb") as out:
        bag, schemas = Writer(out, chunk_size=20_000, compression=chosen), {}
        for topic, kind, seconds, message in messages:
            if kind not in schemas:
                schemas[kind] = bag.register_msgdef(kind, ros2().generate_msgdef(kind, ros_version=2)[0])
            bag.write_message(topic, schemas[kind], message, log_time=ns(seconds), publish_time=ns(seconds))
        bag.finish()
    return file


def _mcap_ros1(path, messages, _):
    from mcap.writer import Writer

    file = path / "recording.mcap"
    with file.open("wb") as out:
        bag, channels = Writer(out), {}
        bag.start("ros1")
        for topic, kind, seconds, message in messages:
            if topic not in channels:
                text = ros1().generate_msgdef(kind)[0].encode()
                schema = bag.register_schema(kind.replace("/msg/", "/"), "ros1msg", text)
                channels[topic] = bag.register_channel(topic, "ros1", schema)
            data = ros1().serialize_ros1(_built(ros1(), kind, message), kind)
            bag.add_message(channels[topic], ns(seconds), data, ns(seconds))
        bag.finish()
    return file


def _built(store, kind, message):
    values = {}
    for name, (node, about) in store.fielddefs[kind][1]:
        if name not in message:
            values[name] = 0  # ROS 1's sequence number
        elif node == Nodetype.NAME:
            values[name] = _built(store, about, message[name])
        elif node in (Nodetype.SEQUENCE, Nodetype.ARRAY):
            inner, what = about[0]
            if inner == Nodetype.NAME:
                values[name] = [_built(store, what, entry) for entry in message[name]]
            else:
                values[name] = np.array(message[name], dtype=what[0])
        else:
            values[name] = message[name]
    return store.types[kind](**values)


# A robot in the tutorial's map.

ANGLES = np.linspace(-2.0, 2.0, 41)
MOUNT = (0.2, -0.1, 0.3)  # the laser on the robot: x, y, yaw


def path_of(seconds):
    """The robot's pose at some times: a slow arc through the tutorial's map, which turns past the angle pi."""
    t = np.asarray(seconds, dtype=float)
    return np.stack([9.0 + 0.3 * t, 10.0 + 0.2 * t, 2.8 + 0.25 * t], axis=-1)


def on(poses, offset=MOUNT):
    x, y, yaw = np.moveaxis(np.asarray(poses, dtype=float), -1, 0)
    dx, dy, turn = offset
    return np.stack([x + np.cos(yaw) * dx - np.sin(yaw) * dy, y + np.sin(yaw) * dx + np.cos(yaw) * dy, yaw + turn], -1)


def simulated(seconds, sensor=None, path=path_of, mount=MOUNT):
    """The scans of the robot's laser at some times; ranges in single precision, as messages carry them."""
    walls, _ = bm.worlds.tutorial()
    grid = bm.Grid((21, 21), 1.0, (-0.5, -0.5))
    poses = on(path(seconds), mount)
    sensor = bm.BeamMixture(bm.Gaussian(0.03), p_no_return=0.1, p_short=0.0) if sensor is None else sensor
    scans = bm.simulate(walls, grid, poses, ANGLES, sensor=sensor, max_range_m=42.0, min_range_m=0.1, seed=1)
    stamps = np.array([ns(t) for t in seconds]) * 1e-9
    ranges = scans.ranges_m.astype(np.float32).astype(np.float64)
    ranges[ranges < 0.1] = 1.0
    return bm.Scans(poses, ANGLES, ranges, 42.0, float(np.float32(0.1)), stamps_s=stamps)


SCAN_TIMES = 0.5 + 0.37 * np.arange(10)
POSE_TIMES = 0.25 * np.arange(21)  # four times a second, at other times than scans


def robot(
    tf_poses=True, odom=False, static=True, *, path=path_of, mount=MOUNT, space="", tf_space=None, prefix="", late=0.0
):
    """The messages of a robot on its path, and the scans as they were simulated.

    /tf, /odom or both hold its poses, ``late`` seconds after `POSE_TIMES`, and /tf_static the laser's place on it. Its
    topics have the namespace ``space``, those of transforms ``tf_space``, if another, and its frames a prefix.
    """
    scans = simulated(SCAN_TIMES, path=path, mount=mount)
    messages = []
    tf_space = space if tf_space is None else tf_space
    frame = [prefix + name for name in ("map", "odom", "base_link", "laser")]
    if static:
        messages.append((f"{tf_space}/tf_static", TF, 0.0, tf(transform(0.0, *frame[2:], *mount, z=0.4))))
    times = POSE_TIMES + late
    for t, (x, y, yaw) in zip(times, path(times), strict=True):
        if tf_poses:
            # The map's own frame is 1 m and a quarter turn from the odometry's.
            messages.append((f"{tf_space}/tf", TF, t, tf(transform(t, *frame[1:3], y - 1.0, -x, yaw - math.pi / 2))))
            messages.append((f"{tf_space}/tf", TF, t, tf(transform(t, *frame[:2], 0.0, 1.0, math.pi / 2))))
        if odom:
            messages.append((f"{space}/odom", ODOM, t, odometry(t, x, y, yaw, frame[1], frame[2])))
    for t, row in zip(SCAN_TIMES, scans.ranges_m, strict=True):
        messages.append((f"{space}/scan", SCAN, t + 0.02, laser(t, row, ANGLES, frame[3])))
    return sorted(messages, key=lambda m: m[2]), scans


def replaced(change, topic="/scan", **options):
    """Return the messages of a robot, of which a topic's fifth is changed, and the scans before that."""
    messages, scans = robot(**options)
    at = [i for i, m in enumerate(messages) if m[0] == topic][4]
    messages[at] = (*messages[at][:3], {**messages[at][3], **change})
    return messages, scans


def merged(*parts):
    return sorted((message for part in parts for message in part), key=lambda message: message[2])


def without(messages, topic):
    return [m for m in messages if m[0] != topic]


def with_scans(messages, *scans):
    return [*without(messages, "/scan"), *(("/scan", SCAN, t, scan) for t, scan in scans)]


def refused(path, *parts, **options):
    """Return the one sentence by which a log is refused; it begins with the path and has some parts."""
    with pytest.raises(bm.BadInput) as error:
        describe_log(path, **options)
    assert str(error.value).startswith(str(path))
    assert "\n" not in str(error.value)
    assert [part for part in parts if part not in str(error.value)] == []
    return str(error.value)


def read_or_refused(path, content):
    """Check that a log of some bytes is read or refused by its name, whether or not bad lines are left out."""
    path.write_bytes(content)
    for skip in (False, True):
        try:
            told = f"{path}: read" if len(read_log(path, skip_bad_lines=skip)) else "nothing was read, and nothing said"
        except bm.BadInput as problem:
            told = str(problem)
        assert told.startswith(str(path))


def same(read, expected, *, timed=True, atol=1e-9, frame=(0.0, 0.0, 0.0)):
    """Check that scans are those expected, seen from a frame of the world; a yaw is compared as a direction."""
    places = (expected.poses[:, 0] + 1j * expected.poses[:, 1] - frame[0] - 1j * frame[1]) * np.exp(-1j * frame[2])
    np.testing.assert_allclose(read.poses[:, :2], np.stack([places.real, places.imag], -1), atol=atol)
    np.testing.assert_allclose(np.exp(1j * read.poses[:, 2]), np.exp(1j * (expected.poses[:, 2] - frame[2])), atol=atol)
    np.testing.assert_array_equal(read.ranges_m, expected.ranges_m)
    np.testing.assert_allclose(read.angles_rad, expected.angles_rad, atol=1e-6)  # single precision in the messages
    if timed:
        np.testing.assert_allclose(read.stamps_s, expected.stamps_s, atol=1e-6)
    assert (read.min_range_m, read.max_range_m) == (expected.min_range_m, expected.max_range_m)
