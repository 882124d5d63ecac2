"""Recordings read back as the scans that were simulated, whoever wrote them."""

import bz2
import gc
import gzip
import math
import struct

import numpy as np
import pytest
import recordings as r

import bayesmap as bm
from bayesmap.io.logs import describe_log, read_log
from bayesmap.io.ros.recording import zstd


@pytest.mark.parametrize("writer", [*r.WRITERS, *r.COMPRESSED])
def test_scans_and_poses_by_tf_are_those_that_were_simulated(tmp_path, writer):
    messages, scans = r.robot()
    reading = describe_log(r.written(tmp_path, messages, writer))
    r.same(reading.scans, scans)
    assert reading.notes == ()
    assert (reading.pose_source, reading.fixed_frame, reading.sensor_frame) == ("/tf", "map", "laser")
    np.testing.assert_allclose(reading.scans.mount, r.MOUNT, atol=1e-9)
    assert reading.messages == {"/scan": 10, "/tf": 42, "/tf_static": 1}
    assert reading.summary()["scan_topic"] == "/scan"


def test_the_only_topic_of_poses_is_found_and_the_odometry_s_frame_can_be_chosen(tmp_path):
    messages, scans = r.robot(tf_poses=False, odom=True)
    path = r.written(tmp_path, messages)
    reading = describe_log(path)
    r.same(reading.scans, scans)
    assert "poses were taken from /odom, the only topic of poses" in reading.notes[0]
    named = describe_log(path, pose_topic="/odom")
    r.same(named.scans, scans)
    assert (named.pose_source, named.notes) == ("/odom", ())
    messages, _ = r.robot()
    scans = read_log(r.written(tmp_path / "other", messages), fixed_frame="/odom")
    x, y, yaw = r.path_of(r.SCAN_TIMES).T
    expected = r.on(np.stack([y - 1.0, -x, yaw - math.pi / 2], -1))
    np.testing.assert_allclose(scans.poses[:, :2], expected[:, :2], atol=1e-9)


@pytest.mark.parametrize("kind", [r.POSE, r.POSE_COV])
def test_poses_of_a_body_without_a_name_are_taken_as_the_base_s(tmp_path, kind):
    messages, scans = r.robot(tf_poses=False)
    for t, pose in zip(r.POSE_TIMES, r.path_of(r.POSE_TIMES), strict=True):
        told = r.posed(*pose)
        told = told if kind == r.POSE else {"pose": told, "covariance": [0.0] * 36}
        messages.append(("/pose", kind, t, {"header": r.header(t, "map"), "pose": told}))
    reading = describe_log(r.written(tmp_path, messages), pose_topic="pose")
    r.same(reading.scans, scans)
    assert "taken as poses of 'base_link'" in reading.notes[0]


def test_readings_mean_what_rep_117_says_and_older_drivers_write_range_max_for_no_return(tmp_path):
    inf, nan = math.inf, math.nan
    special = [inf, -inf, nan, 0.0, 0.05, 43.0, 42.0, 3.0]
    for readings, options, expected in (
        (special, {}, [inf, -inf, nan, nan, nan, inf, 42.0, 3.0]),
        ([0.0, 42.0, 43.0, 3.0], {}, [nan, inf, inf, 3.0]),
        ([0.0, 42.0, 43.0, 3.0], {"no_return": 0}, [inf, 42.0, inf, 3.0]),
    ):
        scan = r.laser(1.0, readings, np.linspace(-1, 1, len(readings)))
        file = r.written(tmp_path / f"{len(readings)}{len(options)}", r.with_scans(r.robot()[0], (1.0, scan)))
        np.testing.assert_array_equal(read_log(file, **options).ranges_m[0], expected)


@pytest.mark.parametrize("beams", [40, 42])
def test_readings_counted_off_by_one_are_accepted_with_a_note(tmp_path, beams):
    messages, scans = r.robot()
    rows = np.resize(np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 2.0), (10, beams))
    step = r.ANGLES[1] - r.ANGLES[0]
    others = [(t, r.laser(t, row, r.ANGLES)) for t, row in zip(r.SCAN_TIMES, rows, strict=True)]
    messages = r.with_scans(messages, *others)
    reading = describe_log(r.written(tmp_path, messages))
    np.testing.assert_allclose(reading.scans.angles_rad, r.ANGLES[0] + step * np.arange(beams), atol=1e-6)
    assert "one beam " + ("more" if beams == 40 else "less") in reading.notes[0]


@pytest.mark.parametrize(("first", "step", "beams", "last", "note"), [
    (-math.pi, -0.0043, 1455, math.pi, "angle_increment is negative, but angle_max lies the other way"),
    (math.pi, 0.03, 200, -math.pi, "angle_increment is positive, but angle_max lies the other way"),
    (-1.0, -0.05, 41, 1.0, "angle_increment is negative, but angle_max lies the other way"),
    (-math.pi, 0.00869, 719, math.pi, "angle_max does not fit the number of readings"),
    (-2.0, 0.1, 30, 2.0, "angle_max does not fit the number of readings"),
    (-2.0, 0.1, 41, math.nan, "angle_max is nan"),
    (0.0, 2 * math.pi / 450, 458, 6.3, "angle_max does not fit the number of readings"),  # beams overlap
    (-2.0, 0.0, 41, 2.0, "angle_increment is 0; it was taken from angle_min and angle_max"),
    (3.0, 0.1, 10, 3.9 - 2 * math.pi, None),  # the beams pass behind the sensor
])  # fmt: skip
def test_beams_point_where_the_message_is_defined_to_say_and_what_contradicts_it_is_noted(
    tmp_path, first, step, beams, last, note
):
    messages = r.without(r.robot()[0], "/scan")
    for t in r.SCAN_TIMES:
        scan = r.laser(t, np.linspace(2.0, 3.0, beams), r.ANGLES)
        messages.append(("/scan", r.SCAN, t, {**scan, "angle_min": first, "angle_increment": step, "angle_max": last}))
    reading = describe_log(r.written(tmp_path, messages))
    angles = first + (step or (last - first) / (beams - 1)) * np.arange(beams)
    np.testing.assert_allclose(reading.scans.angles_rad, angles, atol=1e-4)  # a step in single precision, 1455 times
    told = [line for line in reading.notes if "angle_" in line]
    assert [note in line for line in told] == [True] * (note is not None)


def test_a_scanner_mounted_upside_down_sees_the_same_world(tmp_path):
    messages, scans = r.robot(static=False)
    messages = r.without(messages, "/scan")
    messages.append(("/tf_static", r.TF, 0.0, r.tf(r.transform(0.0, "base_link", "laser", *r.MOUNT, roll=math.pi))))
    for t, row in zip(r.SCAN_TIMES, scans.ranges_m, strict=True):
        messages.append(("/scan", r.SCAN, t, r.laser(t, row[::-1], r.ANGLES)))  # the angles are symmetric
    reading = describe_log(r.written(tmp_path, messages))
    r.same(reading.scans, bm.Scans(
        scans.poses, -r.ANGLES, scans.ranges_m[:, ::-1], 42.0, scans.min_range_m, stamps_s=scans.stamps_s
    ))  # fmt: skip
    assert "upside down" in reading.notes[-1]
    a, b = (np.sort(s.hit_points_world(), axis=0) for s in (reading.scans, scans))
    np.testing.assert_allclose(a, b, atol=1e-4)


def test_de_skewing_undoes_the_sensor_s_motion_during_a_scan(tmp_path):
    ray_s = 0.02  # a scan takes 0.8 s, in which the robot turns by 11 degrees
    walls, _ = bm.worlds.tutorial()
    grid = bm.Grid((21, 21), 1.0, (-0.5, -0.5))
    times = r.SCAN_TIMES[:8]
    rays = times[:, None] + ray_s * np.arange(len(r.ANGLES))
    poses = r.on(r.path_of(rays))
    flat = poses.reshape(-1, 3) + [0, 0, 1] * np.tile(r.ANGLES, len(times))[:, None]
    exact = bm.ranges(walls, grid, flat, [0.0], 42.0).reshape(rays.shape)
    exact[exact == 42.0] = np.inf
    moving = [(t, r.laser(t, row, r.ANGLES, ray_s=ray_s)) for t, row in zip(times, exact, strict=True)]
    file = r.written(tmp_path, r.with_scans(r.robot()[0], *moving))
    still, moved = read_log(file), describe_log(file, deskew=True)
    assert moved.deskewed
    np.testing.assert_allclose(moved.scans.beam_poses[..., :2], poses[..., :2], atol=5e-3)  # chords of the path's arc
    np.testing.assert_allclose(moved.scans.beam_poses[:, 0], moved.scans.poses)
    hit = np.isfinite(exact)
    directions = np.stack([np.cos(flat[:, 2]), np.sin(flat[:, 2])], -1)[hit.ravel()]
    truth = poses[hit][:, :2] + exact[hit][:, None] * directions
    errors = [np.abs(s.hit_points_world() - truth).max() for s in (moved.scans, still)]
    assert errors[0] < 0.02
    assert errors[1] > 0.5
    nothing = describe_log(r.written(tmp_path / "at once", r.robot()[0]), deskew=True)
    assert not nothing.deskewed
    assert any("nothing to de-skew" in note for note in nothing.notes)


def test_stamps_out_of_order_are_sorted_and_scans_without_a_pose_at_their_time_are_left_out(tmp_path):
    messages, scans = r.robot()
    laser = [m for m in messages if m[0] == "/scan"]
    shuffled = [(a[0], a[1], b[2], a[3]) for a, b in zip(reversed(laser), laser, strict=True)]
    reading = describe_log(r.written(tmp_path, sorted([*r.without(messages, "/scan"), *shuffled], key=lambda m: m[2])))
    r.same(reading.scans, scans)
    assert reading.reordered == 9
    assert "all were sorted" in reading.notes[0]
    messages, scans = r.robot()
    first, last = r.SCAN_TIMES[2], r.SCAN_TIMES[7]
    messages = [m for m in messages if m[0] != "/tf" or first <= m[2] <= last]
    reading = describe_log(r.written(tmp_path / "other", messages))
    poses = [m[2] for m in messages if m[0] == "/tf"]
    kept = (min(poses) <= r.SCAN_TIMES) & (max(poses) >= r.SCAN_TIMES)
    assert 0 < kept.sum() < 10
    np.testing.assert_array_equal(reading.scans.ranges_m, scans.ranges_m[kept])
    assert f"{(~kept).sum()} scans were left out" in reading.notes[-1]


@pytest.mark.parametrize("which", ["/scan", "both"])
def test_times_of_receipt_replace_missing_stamps(tmp_path, which):
    scans = r.simulated(r.SCAN_TIMES)
    stamped = None if which == "both" else 0.0
    messages = []
    for t, pose in zip(r.POSE_TIMES, r.on(r.path_of(r.POSE_TIMES)), strict=True):
        messages.append(("/odom", r.ODOM, t, r.odometry(None if stamped is None else t, *pose, child="laser")))
    for t, row in zip(r.SCAN_TIMES, scans.ranges_m, strict=True):
        messages.append(("/scan", r.SCAN, t, r.laser(None, row, r.ANGLES)))
    reading = describe_log(r.written(tmp_path, messages), pose_topic="/odom")
    np.testing.assert_allclose(reading.scans.stamps_s, scans.stamps_s, atol=1e-6)
    assert any("no message on /scan has a time stamp" in note for note in reading.notes)
    assert any("no message on /odom has a time stamp" in note for note in reading.notes) == (which == "both")


def test_a_scan_that_is_there_twice_counts_once_and_poses_that_jump_are_named(tmp_path):
    messages, _ = r.robot()
    laser = [m for m in messages if m[0] == "/scan"]
    other = ("/scan", r.SCAN, laser[3][2], {**laser[3][3], "ranges": [1.0] * 41})
    reading = describe_log(r.written(tmp_path, sorted([*messages, *laser, other], key=lambda m: m[2])))
    assert len(reading.scans) == 11
    assert any("10 scans of /scan are in the recording twice" in note for note in reading.notes)
    assert any("have the time of another, but other readings" in note for note in reading.notes)
    messages = []
    for i in range(20):
        x = 0.01 * i + (5.0 if i >= 12 else 0.0)
        messages.append(("/odom", r.ODOM, 0.1 * i, r.odometry(0.1 * i, x, 0, 0, child="laser")))
        messages.append(("/scan", r.SCAN, 0.1 * i, r.laser(0.1 * i, [1.0, 2.0, 3.0], np.array([-1.0, 0, 1.0]))))
    reading = describe_log(r.written(tmp_path / "other", messages), pose_topic="/odom")
    assert len(reading.scans) == 20
    assert "1 poses jump: the first is the pose of scan 12" in reading.notes[-1]


def test_sonars_are_scans_of_one_beam_and_are_chosen_one_at_a_time(tmp_path):
    left = r.transform(0.0, "base_link", "left", 0.1, 0.2, math.pi / 2)
    right = r.transform(0.0, "base_link", "right", 0.1, -0.2, 0.0)
    messages = [("/tf_static", r.TF, 0.0, r.tf(left, right))]
    for t in r.POSE_TIMES:
        messages.append(("/odom", r.ODOM, t, r.odometry(t, t, 0, 0)))
        messages.append(("/sonar/left", r.RANGE, t, r.sonar(t, 2.0 + t, "left")))
        messages.append(("/sonar/right", r.RANGE, t, r.sonar(t, 8.0, "right")))
    file = r.written(tmp_path, messages)
    with pytest.raises(bm.BadInput, match=r"choose one with --scan-topic: /sonar/left .*, /sonar/right"):
        read_log(file, pose_topic="/odom")
    left = read_log(file, scan_topic="/sonar/left", pose_topic="/odom")
    right = read_log(file, scan_topic="sonar/right", pose_topic="/odom")
    assert left.ranges_m.shape == right.ranges_m.shape == (21, 1)
    np.testing.assert_allclose(left.poses - [[t, 0, 0] for t in r.POSE_TIMES], [[0.1, 0.2, math.pi / 2]] * 21)
    np.testing.assert_allclose(left.ranges_m[:, 0], 2.0 + r.POSE_TIMES)
    assert right.counts()["no_return"] == 21


@pytest.mark.parametrize("poses", ["odom", "tf", "tf of another frame", "tf with another mount"])
def test_an_option_gives_the_laser_s_place_if_the_recording_does_not(tmp_path, poses):
    messages, scans = r.robot(tf_poses=poses != "odom", odom=poses == "odom", static=poses == "tf with another mount")
    if poses == "tf of another frame":
        for topic, _, _, message in messages:
            if topic == "/scan":
                message["header"]["frame_id"] = "robot/base_link/lidar"
    if poses == "tf with another mount":
        messages = r.without(messages, "/tf_static")
        messages.insert(0, ("/tf_static", r.TF, 0.0, r.tf(r.transform(0.0, "base_link", "laser", 5.0, 5.0, 1.0))))
    path = r.written(tmp_path, messages)
    reading = describe_log(path, laser=r.MOUNT)
    r.same(reading.scans, scans)
    np.testing.assert_allclose(reading.scans.mount, r.MOUNT)
    assert not any("taken as the sensor's" in note for note in reading.notes)
    if poses == "odom":
        assert any("--laser X,Y,DEGREES" in note for note in describe_log(path).notes)
    elif poses != "tf with another mount":
        with pytest.raises(bm.BadInput, match="--laser X,Y,DEGREES"):
            describe_log(path)


def test_the_scans_frame_says_on_which_of_two_robots_the_laser_sits(tmp_path):
    messages, scans = r.robot(static=False)
    for topic, _, _, message in messages:
        if topic == "/tf":
            for entry in message["transforms"]:
                entry["child_frame_id"] = entry["child_frame_id"].replace("base_link", "one/base_link")
        else:
            message["header"]["frame_id"] = "one/lidar"
    messages.append(("/tf", r.TF, 4.9, r.tf(r.transform(4.9, "odom", "two/base_link", 5.0, 5.0, 1.0))))
    r.same(describe_log(r.written(tmp_path, messages), laser=r.MOUNT).scans, scans)
    for topic, _, _, message in messages:
        if topic == "/scan":
            message["header"]["frame_id"] = "lidar"
    with pytest.raises(bm.BadInput, match="one/base_link, two/base_link"):
        describe_log(r.written(tmp_path / "other", messages), laser=r.MOUNT)


@pytest.mark.parametrize("writer", ["rosbag1", "db3", "mcap"])
def test_scans_alone_are_read_where_no_poses_are_needed(tmp_path, writer):
    messages, scans = r.robot(tf_poses=False, static=False)
    path = r.written(tmp_path, messages, writer)
    with pytest.raises(bm.BadInput, match="bayesmap slam --no-odometry needs no poses"):
        describe_log(path)
    reading = describe_log(path, without_poses=True)
    r.same(reading.scans, scans.at(np.zeros((len(scans), 3))))
    assert (reading.posed, reading.pose_source, reading.notes) == (False, None, ())


def test_poses_are_not_looked_at_where_none_are_needed(tmp_path):
    """Neither those of a part of the time, nor damaged ones; but a laser that is upside down is known to be."""
    messages = [m for m in r.robot()[0] if m[0] == "/scan" or m[2] < 1.0]
    messages.append(("/tf", r.TF, 0.9, r.tf(r.transform(0.5, "odom", "base_link", math.nan, 0.0, 0.0))))
    reading = describe_log(r.written(tmp_path / "upright", sorted(messages, key=lambda m: m[2])), without_poses=True)
    assert len(reading.scans) == 10
    assert not reading.scans.poses.any()
    messages = [m for m in messages if m[0] == "/scan"]
    messages.append(("/tf_static", r.TF, 0.0, r.tf(r.transform(0.0, "base_link", "laser", 0, 0, 0, roll=math.pi))))
    turned = describe_log(r.written(tmp_path / "turned", messages), without_poses=True)
    np.testing.assert_allclose(turned.scans.angles_rad, -reading.scans.angles_rad)
    assert "upside down" in turned.notes[0]


@pytest.mark.parametrize("writer", ["rosbag1", "db3", "mcap"])
@pytest.mark.parametrize("pack", [gzip.compress, bz2.compress, zstd().compress])
def test_a_recording_packed_as_a_whole_is_read(tmp_path, writer, pack):
    messages, scans = r.robot()
    path = tmp_path / "packed"
    path.write_bytes(pack(r.written(tmp_path, messages, writer).read_bytes()))
    r.same(read_log(path), scans)


@pytest.mark.parametrize("ending", ["db3.zstd", "mcap.zst", "mcap"])
def test_files_without_their_metadata_packed_or_not_are_one_recording(tmp_path, ending):
    messages, scans = r.robot()
    folder = tmp_path / "split"
    folder.mkdir()
    writer = ending.partition(".")[0] + ("-file" if "." in ending else "")
    for i, part in enumerate((messages[:30], messages[30:])):
        r.written(tmp_path / f"part{i}", part, writer).rename(folder / f"split_{i}.{ending}")
    reading = describe_log(folder)
    r.same(reading.scans, scans)
    assert "the folder has no metadata.yaml" in reading.notes[0]
    assert "its 2 files were read" in reading.notes[0]


def test_copies_of_what_was_packed_are_removed(tmp_path, monkeypatch):
    room = tmp_path / "room"
    room.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(room))
    content = r.packed(r.written(tmp_path, r.robot()[0], "db3").read_bytes())
    path = tmp_path / "packed.db3.zst"
    path.write_bytes(content)
    assert len(read_log(path)) == 10
    gc.collect()
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(bm.BadInput, match="compressed by zstd and cannot be unpacked to its end"):
        read_log(path)
    assert not list(room.iterdir())


FLOATS = ("angle_min", "angle_max", "angle_increment", "time_increment", "scan_time", "range_min", "range_max")
ARRAYS = "float32[] ranges\nfloat32[] intensities\n"
LASER_FIELDS = "Header header\n" + "".join(f"float32 {name}\n" for name in FLOATS) + ARRAYS
LASER_SUM = "90c7ef2dc6895d81024acba2ac42f369"
OLD_HEADER = "=" * 80 + "\nMSG: roslib/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
TF_FIELDS, TF_SUM = "geometry_msgs/TransformStamped[] transforms\n", "94810edda583a504dfda3829e70d7eec"


@pytest.mark.parametrize("definitions", [
    {r.SCAN: (LASER_FIELDS + OLD_HEADER, LASER_SUM)},
    {r.SCAN: (LASER_FIELDS.replace("Header", "roslib/Header", 1) + OLD_HEADER, LASER_SUM)},
    {r.SCAN: (LASER_FIELDS, LASER_SUM)}, {r.SCAN: (LASER_FIELDS, "*")}, {r.SCAN: ("", LASER_SUM)},
    {r.SCAN: ("<definition>lost</definition>", LASER_SUM)}, {r.TF: (TF_FIELDS, TF_SUM)}, {r.TF: ("", TF_SUM)},
])  # fmt: skip
def test_definitions_that_lack_parts_are_completed_by_those_of_ros(tmp_path, definitions):
    messages, scans = r.robot()
    reading = describe_log(r.written(tmp_path, messages, "rosbag1", definitions))
    r.same(reading.scans, scans)
    assert reading.notes == ()


def test_a_definition_of_another_sum_is_not_taken_for_that_of_ros(tmp_path):
    messages, _ = r.robot()
    longer = LASER_FIELDS.replace("float32[] ranges", "float64[] ranges")
    path = r.written(tmp_path, messages, "rosbag1", {r.SCAN: (longer, "0" * 31 + "1")})
    with pytest.raises(bm.BadInput, match=r"the definition of sensor_msgs/msg/LaserScan on /scan cannot be used"):
        read_log(path)


@pytest.mark.parametrize("skip", [False, True])
def test_index_records_are_as_long_as_they_count(tmp_path, skip):
    messages, scans = r.robot()
    content = bytearray(r.written(tmp_path, messages, "rosbag1").read_bytes())
    at, records = 0, 0
    while (at := content.find(b"op=\x04", at)) >= 0:
        at = content.index(b"count=", at) + len(b"count=")  # the last field of the record's header
        count, length = struct.unpack_from("<II", content, at)
        assert length == 12 * count
        struct.pack_into("<I", content, at + 4, 20 * count)
        records += 1
    assert records == 3
    path = tmp_path / "2010.bag"
    path.write_bytes(content)
    reading = describe_log(path, skip_bad_lines=skip)
    r.same(reading.scans, scans)
    assert reading.notes == ()
