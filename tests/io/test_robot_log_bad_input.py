"""Recordings that cannot be used, whatever their bytes: one sentence says what is there and what to give."""

import math
import sqlite3

import numpy as np
import pytest
import recordings as r
from tiers import full_but, pairs_but

import bayesmap as bm
from bayesmap.io.contents import contents_of
from bayesmap.io.logs import describe_log, read_log
from bayesmap.io.ros.recording import zstd

CONTAINERS = ("rosbag1", "db3", "mcap", "mcap-zstd", "mcap-lz4", "mcap-plain", "mcap-ros1")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """One recording in each container; its name does not say which."""
    messages, _ = r.robot(odom=True)
    folder = tmp_path_factory.mktemp("whole")
    return {
        writer: r.written(folder / writer, messages, writer).rename(folder / f"{writer}.bin") for writer in CONTAINERS
    }


@pytest.mark.parametrize("writer", CONTAINERS)
def test_a_truncated_recording_is_refused_and_read_as_far_as_it_goes_on_request(whole, tmp_path, writer):
    _, scans = r.robot()
    assert len(read_log(whole[writer])) == 10
    content = whole[writer].read_bytes()
    path = tmp_path / "cut"
    path.write_bytes(content[: int(len(content) * 0.75)])  # without the index at the end and a little of the data
    r.refused(path, "damaged or cut short", "--skip-bad-lines")
    try:
        reading = describe_log(path, skip_bad_lines=True, pose_topic="/odom")
    except bm.BadInput:
        assert writer not in ("rosbag1", "mcap", "mcap-ros1")  # chunks of others may hold no scan or no poses
        r.refused(path, skip_bad_lines=True, pose_topic="/odom")
    else:
        np.testing.assert_array_equal(reading.scans.ranges_m, scans.ranges_m[: len(reading.scans)])
        assert len(reading.scans) > 1
        assert "could be read" in reading.notes[0]


@pytest.mark.parametrize("skip", [False, True])
def test_an_unindexed_bag_is_read_on_request(whole, tmp_path, skip):
    content = bytearray(whole["rosbag1"].read_bytes())
    at = content.index(b"index_pos=") + len(b"index_pos=")
    content[at : at + 8] = bytes(8)
    path = tmp_path / "active.bag"
    path.write_bytes(content)
    if skip:
        assert len(read_log(path, skip_bad_lines=True)) == 10
    else:
        assert "not indexed" in r.refused(path)


@pytest.mark.parametrize("content", [b"", b"#ROSBAG V2.0\n", b"\x89MCAP0\r\n", b"SQLite format 3\0", b"#ROSBAG V1.2\n"])
@pytest.mark.parametrize("skip", [False, True])
def test_empty_recordings_are_refused_and_bags_of_earlier_formats_with_the_remedy(tmp_path, content, skip):
    path = tmp_path / "empty.bag"
    path.write_bytes(content)
    message = r.refused(path, skip_bad_lines=skip)
    assert ("format 1.2" in message and "rosbag fix" in message) == (b"V1.2" in content)


def test_a_packed_file_that_is_no_recording_is_refused_with_the_remedy(tmp_path):
    path = tmp_path / "robot.log.zst"
    path.write_bytes(zstd().compress(b"FLASER 3 1.0 2.0 1.5 0.1 0 0 0.1 0 0 1 host 1\n" * 20))
    assert "compressed by zstd, and no recording; unpack it: zstd -d" in r.refused(path)
    path.write_bytes(path.read_bytes()[:9] + bytes(9))
    assert "compressed by zstd, but damaged or cut short" in r.refused(path)


@pytest.mark.parametrize("writer", ["db3", "mcap"])
def test_a_packed_recording_that_breaks_off_is_read_as_far_as_it_goes_on_request(tmp_path, writer):
    content = r.packed(r.written(tmp_path, r.robot(odom=True)[0], writer).read_bytes())
    path = tmp_path / "cut.zst"
    path.write_bytes(content[: int(len(content) * 0.8)])
    assert "compressed by zstd and cannot be unpacked to its end" in r.refused(path)
    try:
        told = describe_log(path, skip_bad_lines=True, pose_topic="/odom").notes[0]
    except bm.BadInput as problem:
        told = str(problem)  # what is left may hold no scan
    assert "damaged" in told or "no topic" in told


@pytest.mark.parametrize(("writer", "damage", "says"), [
    ("db3", "zeroblob(7)", "message 1 on /scan"),
    ("db3-messages", "substr(data, 1, 40)", "LaserScan is compressed by zstd and cannot be unpacked"),
])  # fmt: skip
def test_a_damaged_row_of_a_database_is_named_and_left_out_on_request(tmp_path, writer, damage, says):
    path = r.written(tmp_path, r.robot()[0], writer)
    with sqlite3.connect(path) as database:
        database.execute(
            f"UPDATE messages SET data = {damage} WHERE id = (SELECT messages.id FROM messages JOIN topics "
            "ON topic_id = topics.id WHERE name = '/scan' LIMIT 1)"
        )
    database.close()
    r.refused(path, "message 1 on /scan", says)
    assert len(describe_log(path, skip_bad_lines=True).skipped) == 1


def test_a_folder_that_is_no_recording_and_topics_of_a_carmen_log_are_refused(tmp_path):
    assert "metadata.yaml" in r.refused(tmp_path)
    (tmp_path / "metadata.yaml").write_text("rosbag2_bagfile_information: [")
    r.refused(tmp_path)
    r.refused(tmp_path, skip_bad_lines=True)
    path = tmp_path / "robot.log"
    path.write_text("FLASER 3 1.0 2.0 1.5 0.1 0 0 0.1 0 0 1 host 1\n")
    assert "a carmen file has no topics" in r.refused(path, scan_topic="/scan")


def two_lasers():
    messages, _ = r.robot()
    return r.merged(messages, [("/rear", *m[1:]) for m in messages if m[0] == "/scan"][:4])


def two_odometries():
    messages, _ = r.robot(tf_poses=False, odom=True)
    return r.merged(messages, [("/wheels", *m[1:]) for m in messages if m[0] == "/odom"])


def on_its_side():
    side = r.transform(0.0, "base_link", "laser", *r.MOUNT, roll=math.pi / 2)
    return [("/tf_static", r.TF, 0.0, r.tf(side)), *r.robot(static=False)[0]]


REFUSED = {
    "missing scans": (lambda: r.robot()[0], {"scan_topic": "/front/scan"}, ["/scan (sensor_msgs/msg/LaserScan, 10 "]),
    "no scans": (lambda: r.robot(odom=True)[0], {"scan_topic": "/odom"}, ["it is a topic of nav_msgs/msg/Odometry"]),
    "missing poses": (
        lambda: r.robot(odom=True)[0], {"pose_topic": "/amcl_pose"},
        ["/odom (nav_msgs/msg/Odometry, 21 messages)", "/tf (tf2_msgs/msg/TFMessage, 42 messages)"],
    ),
    "without scans": (
        lambda: r.without(r.robot(odom=True)[0], "/scan"), {},
        ["no topic holds sensor_msgs/msg/LaserScan or sensor_msgs/msg/Range", "/odom (nav_msgs/msg/Odometry"],
    ),
    "two lasers": (two_lasers, {}, ["choose one with --scan-topic: /rear (", "/scan ("]),
    "no chain": (lambda: r.without(r.robot()[0], "/tf"), {}, ["known frames: base_link, laser", "--fixed-frame"]),
    "unknown frame": (
        lambda: r.robot()[0], {"fixed_frame": "earth"},
        ["the frame 'earth' is not known; known frames: base_link, laser, map, odom"],
    ),
    "two odometries": (two_odometries, {}, ["choose one with --pose-topic: there are /odom ("]),
    "another clock": (
        lambda: r.with_scans(r.robot()[0], (1.0, r.laser(5000.0, [1.0] * 41, r.ANGLES))), {},
        ["are both by the same clock?"],
    ),
    "on its side": (on_its_side, {}, ["is tilted by 90 degrees"]),
}  # fmt: skip
"""Recordings, options of the reader, and parts of the message that refuses them."""


@pytest.mark.parametrize(("make", "options", "parts"), REFUSED.values(), ids=REFUSED)
def test_recordings_with_a_choice_or_without_use_are_refused_with_their_topics(tmp_path, make, options, parts):
    r.refused(r.written(tmp_path, make()), *parts, **options)


def test_the_chosen_laser_is_read_and_a_scan_of_nan_leaves_the_others(tmp_path):
    assert len(read_log(r.written(tmp_path, two_lasers()), scan_topic="/rear")) == 4
    nothing = [math.nan] * 41
    messages, scans = r.replaced({"ranges": nothing})
    read = read_log(r.written(tmp_path / "one", messages))
    assert np.isnan(read.ranges_m[4]).all()
    np.testing.assert_array_equal(np.delete(read.ranges_m, 4, 0), np.delete(scans.ranges_m, 4, 0))
    every = [(*m[:3], {**m[3], "ranges": nothing}) if m[0] == "/scan" else m for m in messages]
    assert "none of 410 readings in 10 scans is valid" in r.refused(r.written(tmp_path / "all", every))


def pose(position, orientation):
    return {"pose": {"pose": {"position": position, "orientation": orientation}, "covariance": [0.0] * 36}}


@pytest.mark.parametrize(("topic", "change", "reason"), [
    ("/scan", {"angle_min": math.nan}, "has angle_min nan"),
    ("/scan", {"angle_increment": math.inf}, "angle_increment inf"),
    ("/scan", {"angle_increment": 0.0, "angle_max": math.nan}, "but angle_increment 0 and angle_max nan"),
    ("/scan", {"angle_min": -90.0, "angle_max": -50.0, "angle_increment": 1.0}, "6.37 turns; angles must be"),
    ("/scan", {"angle_min": -90.0, "angle_increment": 0.01}, "over a turn away from straight ahead; angles"),
    ("/scan", {"header": r.header(None, "laser")}, "does not say its time"),
    ("/scan", {"header": r.header(2.0, "other")}, "in frame 'other', but most scans"),
    ("/odom", pose(r.point(math.nan, 0), r.quaternion(0.0)), "has the position (nan, 0, 0)"),
    ("/odom", pose(r.point(0, 0), dict.fromkeys("xyzw", 0.0)), "which is no unit quaternion"),
])  # fmt: skip
def test_a_scan_or_pose_that_cannot_be_used_is_named_and_left_out_on_request(tmp_path, topic, change, reason):
    messages, scans = r.replaced(change, topic, tf_poses=False, odom=True)
    path = r.written(tmp_path, messages)
    r.refused(path, f"message 5 on {topic}", reason, "--skip-bad-lines")
    reading = describe_log(path, skip_bad_lines=True)
    left = np.delete(scans.ranges_m, 4, axis=0) if topic == "/scan" else scans.ranges_m
    np.testing.assert_array_equal(reading.scans.ranges_m, left)
    assert [str(skip) for skip in reading.skipped] == [f"message 5 on {topic}"]


def tries(many, few, *landing):
    """Return cases of writers with many tries, and of the landing run's writers with few."""
    short = [(writer, few) for writer in landing]
    return pairs_but([*((writer, many) for writer in CONTAINERS), *short], *short)


@pytest.mark.parametrize(("writer", "count"), tries(40, 12, "rosbag1", "mcap"))
def test_recordings_cut_anywhere(whole, tmp_path, writer, count):
    content = whole[writer].read_bytes()
    ends = np.random.default_rng(0).integers(0, len(content), count)
    for end in [*ends, 1, 12, 13, 20, len(content) - 1, len(content) - 9]:
        r.read_or_refused(tmp_path / "cut", content[:end])


@pytest.mark.parametrize(("writer", "count"), tries(60, 16, "mcap-zstd", "mcap-plain"))
def test_recordings_with_some_bytes_changed_inserted_or_removed(whole, tmp_path, writer, count):
    rng, intact = np.random.default_rng(1), whole[writer].read_bytes()
    for i in range(count):
        content, at = bytearray(intact), int(rng.integers(len(intact)))
        for _ in range(rng.integers(1, 6)):
            content[rng.integers(len(content))] ^= 1 << rng.integers(8)
        inserted, removed = intact[:at] + rng.bytes(5) + intact[at:], intact[:at] + intact[at + 9 :]
        r.read_or_refused(tmp_path / "damaged", (bytes(content), inserted, bytes(content), removed)[i % 4])


@pytest.mark.parametrize("writer", full_but(CONTAINERS, "db3", "mcap-ros1"))
def test_looking_into_damaged_recordings(whole, tmp_path, writer):
    rng, intact = np.random.default_rng(3), whole[writer].read_bytes()
    path = tmp_path / "damaged"
    for _ in range(15):
        content = bytearray(intact[: rng.integers(len(intact))])
        if content:
            content[rng.integers(len(content))] ^= 0xFF
        path.write_bytes(content)
        try:
            found = contents_of(path).path
        except bm.BadInput as problem:
            found = str(problem)
        assert found.startswith(str(path))
