"""A small map without symmetry to export (a flip shows), and recordings read back by libraries other than bayesmap."""

import sqlite3
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import yaml
from mcap.reader import make_reader
from mcap.records import Schema
from mcap_ros1.decoder import DecoderFactory as Ros1
from mcap_ros2.decoder import DecoderFactory as Ros2

from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans


@dataclass(frozen=True)
class Recorded:
    topic: str
    type_name: str
    time_ns: int
    message: Any
    qos: Any
    """Quality of service as a list of dicts; in ROS 1 whether the topic is latched."""


def read_mcap(path):
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=[Ros2()])
        assert reader.get_header().profile == "ros2"
        return [
            Recorded(
                channel.topic, schema.name, record.log_time, message,
                yaml.safe_load(channel.metadata["offered_qos_profiles"]),
            )
            for schema, channel, record, message in reader.iter_decoded_messages()
        ]  # fmt: skip


def read_db3(path):
    database = sqlite3.connect(path)
    try:
        rows = database.execute(
            "SELECT name, type, timestamp, data, offered_qos_profiles, encoded_message_definition, encoding"
            " FROM messages JOIN topics ON topics.id = topic_id JOIN message_definitions ON topic_type = type"
        ).fetchall()
    finally:
        database.close()
    records = []
    for topic, type_name, time_ns, data, qos, definition, encoding in rows:
        decode = Ros2().decoder_for("cdr", Schema(id=1, data=definition.encode(), encoding=encoding, name=type_name))
        records.append(Recorded(topic, type_name, time_ns, decode(data), yaml.safe_load(qos)))
    return records


def read_folder(path):
    """Read a ROS 2 bag: the file that its metadata names."""
    about = yaml.safe_load((path / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert about["storage_identifier"] == "sqlite3"
    assert {file.name for file in path.iterdir()} == {"metadata.yaml", *about["relative_file_paths"]}
    (topic,) = about["topics_with_message_count"]
    (file,) = about["relative_file_paths"]
    (record,) = read_db3(path / file)
    assert topic["message_count"] == about["message_count"] == 1
    assert topic["topic_metadata"]["name"] == record.topic
    assert yaml.safe_load(topic["topic_metadata"]["offered_qos_profiles"]) == record.qos
    assert about["starting_time"]["nanoseconds_since_epoch"] == record.time_ns
    return [record]


def read_bag(path):
    """Read a ROS 1 bag by rosbags, which wrote it (no other reader runs without ROS), and its messages by mcap_ros1."""
    from rosbags.rosbag1 import Reader

    records = []
    with Reader(path) as bag:
        for connection, time_ns, data in bag.messages():
            name = connection.msgtype.replace("/msg/", "/")
            schema = Schema(id=1, data=connection.msgdef.data.encode(), encoding="ros1msg", name=name)
            message = Ros1().decoder_for("ros1", schema)(data)
            assert message._md5sum == connection.digest
            records.append(Recorded(connection.topic, name, time_ns, message, connection.ext.latching))
    return records


READERS = {".bag": read_bag, ".mcap": read_mcap, ".db3": read_db3, "": read_folder}


GRID = Grid(shape=(5, 3), resolution=0.25, origin=(-1.5, 2.0))


def occupancy():
    return np.arange(15).reshape(5, 3)[::-1] / 20 + 0.01


def observed():
    seen = np.ones(GRID.shape, dtype=bool)
    seen[0, 2] = seen[3, 0] = False
    return seen


def scans(stamps=(100.5, 101.25, 103.0)):
    poses = np.array([[-1.4, 2.1, 0.0], [-1.0, 2.2, 0.5], [-0.5, 2.6, -3.0]])
    ranges = np.array([[0.5, np.inf], [0.25, 0.125], [np.nan, -np.inf]])
    return Scans(poses, np.array([0.0, 0.5]), ranges, 2.0, stamps_s=None if stamps is None else np.array(stamps))


def binary_run(**more):
    """Return what an export reads of a run."""
    p = occupancy()
    entropy = -p * np.log2(p) - (1 - p) * np.log2(1 - p)
    return SimpleNamespace(grid=GRID, occupancy=p, entropy=entropy, observed=observed(), **more)


def reflectivity_run():
    """Return a run whose cells hold a number, so that there are intervals of 90 %."""
    return binary_run(interval={0.9: (occupancy() / 2, (1 + occupancy()) / 2)}.__getitem__)
