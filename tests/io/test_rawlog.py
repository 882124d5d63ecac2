"""MRPT's rawlogs: written here version by version as MRPT lays them out, and read back as they were simulated."""

import dataclasses
import gzip
import math
import struct

import numpy as np
import pytest
from recordings import ANGLES, MOUNT, on, path_of, read_or_refused, refused, same, simulated

import bayesmap as bm
from bayesmap.io.logs import describe_log, format_of, read_log
from bayesmap.space.planar import between

TIMES = np.arange(6.0)
OPENING = float(ANGLES[-1] - ANGLES[0])


class Style:
    """How a release of MRPT writes: its headers, and the versions of its classes."""

    def __init__(self, scan=7, motion=7, odometry=2, pose2=1, pose3=3, prefix="mrpt::{}::", old=False, wide=False):
        self.scan, self.motion, self.odometry, self.pose2, self.pose3 = scan, motion, odometry, pose2, pose3
        self.prefix, self.old, self.wide = prefix, old, wide

    def object(self, name, version, data, space="obs"):
        name = (self.prefix.format(space) + name).encode()
        if self.old:
            return struct.pack("<i", len(name)) + name + struct.pack("<i", version) + data
        return bytes([0x80 | len(name)]) + name + bytes([version]) + data + b"\x88"


STYLES = {
    "MRPT 2.13": Style(scan=8),
    "MRPT 2": Style(),
    "wider fields": Style(scan=7, motion=6, odometry=2, pose3=2, prefix="", wide=True),
    "MRPT 1.0": Style(scan=6, motion=6, odometry=1, pose3=2, prefix=""),
    "MRPT 0.9": Style(scan=5, motion=5, odometry=1, pose3=1, prefix=""),
    "MRPT 0.6": Style(scan=4, motion=4, odometry=0, pose3=1, prefix=""),
    "MRPT 0.5": Style(scan=3, motion=3, odometry=0, pose2=0, pose3=0, prefix="", old=True),
    "before": Style(scan=1, motion=2, odometry=0, pose2=0, pose3=0, prefix="", old=True),
    "the first": Style(scan=0, motion=0, odometry=0, pose2=0, pose3=0, prefix="", old=True),
}


def ticks(seconds):
    return struct.pack("<Q", round((seconds + 11_644_473_600) * 1e7))


def matrix(style, values):
    values = np.asarray(values)
    name, kind = ("CMatrixD", "<f8") if values.dtype == np.float64 else ("CMatrix", "<f4")
    return style.object(name, 0, struct.pack("<II", *values.shape) + values.astype(kind).tobytes(), "math")


def pose2(style, pose):
    return style.object("CPose2D", style.pose2, struct.pack("<3d" if style.pose2 else "<3f", *pose), "poses")


def pose3(style, mount, roll=0.0):
    x, y, yaw = mount
    c, s, cr, sr = math.cos(yaw), math.sin(yaw), math.cos(roll), math.sin(roll)
    rotation = np.array([[c, -s * cr, s * sr], [s, c * cr, -c * sr], [0.0, sr, cr]])
    if style.pose3 < 2:
        whole = np.eye(4, dtype=np.float32 if style.pose3 == 0 else np.float64)
        whole[:3, :3], whole[:3, 3] = rotation, (x, y, 0.3)
        data = matrix(style, whole)
    elif style.pose3 == 2:
        (c, s), (cr, sr) = ((math.cos(half), math.sin(half)) for half in (0.5 * yaw, 0.5 * roll))
        data = struct.pack("<7d", x, y, 0.3, c * cr, c * sr, s * sr, s * cr)
    else:
        data = struct.pack("<12d", x, y, 0.3, *rotation.ravel())
    return style.object("CPose3D", style.pose3, data, "poses")


def scan(style, readings, seconds, label="LASER", mount=MOUNT, roll=0.0, left_to_right=False, far=42.0):
    """A scan; readings of infinity are what the driver calls not valid, at the sensor's maximum."""
    valid = np.isfinite(readings)
    ranges = np.where(np.isnan(readings), 3.0, np.minimum(readings, far)).astype("<f4")
    version = style.scan
    data = struct.pack("<f?f", OPENING, not left_to_right, far) + pose3(style, mount, roll)
    if version < 6:
        data += matrix(style, np.zeros((6, 6), np.float32))
    data += struct.pack("<I", len(ranges)) + ranges.tobytes()
    data += valid.astype("u1").tobytes() if version >= 1 else b""
    data += struct.pack("<f", 0.01) if version >= 2 else b""
    data += ticks(seconds) if version >= 3 else b""
    data += struct.pack("<f", 0.002) if version >= 4 else b""
    if version >= 5:
        data += struct.pack("<I", len(label)) + label.encode() + struct.pack("<d", 0.0)
    if version >= 7:
        data += struct.pack("<?", style.wide) + (np.ones(len(ranges), "<i4").tobytes() if style.wide else b"")
    return style.object("CObservation2DRangeScan", version, data + (struct.pack("<f", 0.1) if version >= 8 else b""))


def motion(style, step, by=0):
    version, width = style.motion, "d" if style.wide else "f"
    covariance = matrix(style, np.eye(3, dtype=np.float32))
    gaussian = style.object("CPosePDFGaussian", 0, pose2(style, step) + covariance, "poses")
    if version < 2:
        return style.object("CActionRobotMovement2D", version, gaussian + struct.pack("<i", by))
    data = struct.pack("<i", by)
    if by:
        data += gaussian
    elif version == 2:
        data += pose2(style, step) + bytes(44)
    else:
        gaussian, thrun = 5 if version == 3 else 6, 4 if version < 5 else 6
        data += pose2(style, step) + struct.pack(f"<i{gaussian}f", 0, *[0.1] * gaussian)
        data += struct.pack(f"<I{thrun}f", 300, *[0.1] * thrun)
    if version < 7:
        data += struct.pack("<?2" + width, True, 0.5, 0.1) + struct.pack("<?2i", True, 7, 8)
    else:
        data += struct.pack("<?3d", True, 0.5, 0.0, 0.1) + struct.pack("<?", False)
    return style.object("CActionRobotMovement2D", version, data + (ticks(0.0) if version >= 6 else b""))


def odometry(style, pose, seconds, label="ODO"):
    data = pose2(style, pose) + struct.pack("<I", len(label)) + label.encode() + ticks(seconds)
    if style.odometry == 1:
        data += struct.pack("<?2i", False, 0, 0) + struct.pack("<?2" + ("d" if style.wide else "f"), True, 0.5, 0.1)
    if style.odometry == 2:
        data += struct.pack("<?", False) + struct.pack("<?3d", True, 0.5, 0.0, 0.1)
    return style.object("CObservationOdometry", style.odometry, data)


def collection(style, *motions):
    return style.object("CActionCollection", 0, struct.pack("<I", len(motions)) + b"".join(motions))


def frame(style, *observations):
    return style.object("CSensoryFrame", 2, struct.pack("<I", len(observations)) + b"".join(observations))


def in_frames(style, scans, **options):
    """Return a log of motions and sensory frames; the first motion leads to the first pose."""
    robot, before, parts = path_of(TIMES), np.zeros(3), []
    for pose, row, at in zip(robot, scans.ranges_m, scans.stamps_s, strict=True):
        parts += [collection(style, motion(style, between(before, pose)))]
        parts += [frame(style, scan(style, row, at, **options))]
        before = pose
    return b"".join(parts)


def in_observations(style, scans, at=None, **options):
    """Return a log of observations one by one, with odometry at times of its own."""
    times = (np.arange(13) * 0.5 if at is None else at) + scans.stamps_s[0]
    parts = [(t, odometry(style, pose, t)) for t, pose in zip(times, path_of(times - scans.stamps_s[0]), strict=True)]
    parts += [(t, scan(style, row, t, **options)) for t, row in zip(scans.stamps_s, scans.ranges_m, strict=True)]
    return b"".join(part for _, part in sorted(parts, key=lambda p: p[0]))


def known(times):
    """Return the simulated scans; a rawlog does not state the smallest range."""
    return dataclasses.replace(simulated(times), min_range_m=0.0)


def written(path, content, zipped=True):
    path.write_bytes(gzip.compress(content) if zipped else content)
    return path


@pytest.mark.parametrize("release", STYLES)
def test_scans_and_motions_of_each_release_are_those_that_were_simulated(tmp_path, release):
    style, scans = STYLES[release], known(TIMES)
    path = written(tmp_path / "log.rawlog", in_frames(style, scans))
    assert format_of(path) == "rawlog"
    reading = describe_log(path)
    same(reading.scans, scans, timed=style.scan >= 3, atol=1e-9 if style.pose2 and style.pose3 else 1e-5)
    np.testing.assert_allclose(reading.scans.mount, MOUNT, atol=1e-6)
    assert (reading.format, reading.pose_source) == ("rawlog", "CActionRobotMovement2D")
    assert reading.messages["CObservation2DRangeScan"] == len(TIMES)
    assert (reading.scans.stamps_s is None) == (style.scan < 3)


@pytest.mark.parametrize("release", [name for name, style in STYLES.items() if style.scan >= 3])
@pytest.mark.parametrize("zipped", [False, True])
def test_scans_between_readings_of_odometry(tmp_path, release, zipped):
    style, scans = STYLES[release], known(TIMES)
    reading = describe_log(written(tmp_path / "log", in_observations(style, scans), zipped))
    same(reading.scans, scans, atol=1e-3 if style.pose2 else 2e-4)
    assert reading.pose_source == "CObservationOdometry"
    outside = describe_log(written(tmp_path / "part", in_observations(style, scans, at=1.5 + np.arange(3))))
    np.testing.assert_array_equal(outside.scans.ranges_m, scans.ranges_m[2:4])
    assert "4 scans were left out" in outside.notes[0]


def test_order_counts_if_stamps_repeat_and_matched_motions_if_there_are_no_others(tmp_path):
    style, scans = STYLES["MRPT 2"], known(TIMES)
    parts = [odometry(style, pose, 100.0) + scan(style, row, 100.0)
             for pose, row in zip(path_of(TIMES), scans.ranges_m, strict=True)]  # fmt: skip
    reading = describe_log(written(tmp_path / "log", b"".join(parts)))
    same(reading.scans, scans, timed=False)
    assert any("stamps are coarse" in note for note in reading.notes)
    robot = path_of(TIMES)
    steps = [between(a, b) for a, b in zip([np.zeros(3), *robot[:-1]], robot, strict=True)]
    wrong = [0.5, 0.5, 0.5]
    for kinds in (lambda s: [motion(style, s), motion(style, wrong, by=1)], lambda s: [motion(style, s, by=1)],
                  lambda s: [motion(style, wrong, by=1), motion(style, s)]):  # fmt: skip
        parts = [collection(style, *kinds(step)) + frame(style, scan(style, row, at))
                 for step, row, at in zip(steps, scans.ranges_m, scans.stamps_s, strict=True)]  # fmt: skip
        same(read_log(written(tmp_path / "log", b"".join(parts))), scans)


def test_a_laser_upside_down_one_that_sweeps_clockwise_and_one_on_its_side(tmp_path):
    style, scans = STYLES["MRPT 2"], known(TIMES)
    turned = describe_log(written(tmp_path / "down", in_frames(style, scans, roll=math.pi)))
    same(turned.scans, bm.Scans(scans.poses, -ANGLES, scans.ranges_m, 42.0), timed=False)
    assert "mounted upside down" in turned.notes[0]
    clockwise = read_log(written(tmp_path / "clockwise", in_frames(style, scans, left_to_right=True)))
    same(clockwise, bm.Scans(scans.poses, ANGLES[::-1], scans.ranges_m, 42.0), timed=False)
    assert "tilted by 69 degrees" in refused(written(tmp_path / "side", in_frames(style, scans, roll=1.2)))


def test_objects_of_other_classes_lie_between_other_lasers_are_named_and_scans_alone_are_read(tmp_path):
    style, scans = STYLES["MRPT 2"], known(TIMES)
    image = style.object("CObservationImage", 4, pose3(style, MOUNT) + bytes(range(256)) * 3)
    parts, before = [style.object("CObservationComment", 0, b"\x05\x00\x00\x00hello")], np.zeros(3)
    for i, (pose, row, at) in enumerate(zip(path_of(TIMES), scans.ranges_m, scans.stamps_s, strict=True)):
        rear = [scan(style, row[::-1], at, label="REAR", mount=(-0.3, 0.0, math.pi))] if i else []
        parts += [collection(style, motion(style, between(before, pose)))]
        parts += [frame(style, image, *rear, scan(style, row, at), image)]
        before = pose
    reading = describe_log(written(tmp_path / "log", b"".join(parts)))
    same(reading.scans, scans)
    assert "also holds 5 scans of the sensor 'REAR'" in reading.notes[0]
    assert (reading.messages["CObservationImage"], reading.messages["CSensoryFrame"]) == (12, 6)
    alone = b"".join(scan(style, row, at) for row, at in zip(scans.ranges_m, scans.stamps_s, strict=True))
    path = written(tmp_path / "alone", alone)
    assert "bayesmap slam --no-odometry" in refused(path)
    reading = describe_log(path, without_poses=True)
    assert not reading.posed
    same(reading.scans, scans.at(np.zeros((6, 3))))
    moved = read_log(written(tmp_path / "log", in_frames(style, scans)), laser=(1.0, 0.0, 2.0))
    np.testing.assert_allclose(moved.poses[:, :2], on(path_of(TIMES), (1.0, 0.0, 2.0))[:, :2], atol=1e-9)


def test_invalid_readings_are_no_return_only_at_the_maximum_and_logs_without_scans_or_cut_are_refused(tmp_path):
    style, whole_scans = STYLES["MRPT 2"], known(TIMES)
    row = np.array([1.0, np.inf, np.nan, 2.0] + [5.0] * 37)
    scans = read_log(written(tmp_path / "log", odometry(style, (0, 0, 0), 1.0) + scan(style, row, 1.0)))
    np.testing.assert_array_equal(scans.ranges_m[0], row)
    assert "it holds 1 CObservationOdometry" in refused(written(tmp_path / "odometry", odometry(style, (0, 0, 0), 1.0)))
    whole = written(tmp_path / "log", in_frames(style, whole_scans)).read_bytes()
    cut = tmp_path / "cut"
    cut.write_bytes(whole[: len(whole) * 2 // 3])
    assert "--skip-bad-lines" in refused(cut)
    assert 1 <= len(read_log(cut, skip_bad_lines=True)) < 6


@pytest.mark.parametrize(("change", "message"), [
    (lambda d: d.replace(b"DRangeScan\x07", b"DRangeScan\x63", 1), "2DRangeScan 1 in the log: version 99 is not known"),
    (lambda d: d.replace(b"Movement2D\x07", b"Movement2D\x15", 1), "CActionRobotMovement2D 1 in the log: version 21"),
    (lambda d: d.replace(b"LASER", b"LASE", 1), "does not end where it should"),
    (lambda d: d.replace(b"CPose3D\x03", b"CPose3D\x09", 1), "CPose3D of version 9"),
    (lambda d: d[: len(d) - 100], "is cut short"),
])  # fmt: skip
def test_objects_that_cannot_be_read_are_named_and_left_out_on_request(tmp_path, change, message):
    path = written(tmp_path / "log", change(in_frames(STYLES["MRPT 2"], known(TIMES))))
    assert message in refused(path)
    reading = describe_log(path, skip_bad_lines=True)
    assert len(reading.skipped) == 1
    assert len(reading.scans) == (6 if "Movement" in message else 5)


@pytest.mark.parametrize("seed", range(20))
def test_whatever_a_damaged_rawlog_holds_it_is_read_or_refused(tmp_path, seed):
    rng = np.random.default_rng(seed)
    data = bytearray(in_frames(STYLES["MRPT 2"], known(TIMES)))
    for at in rng.integers(0, len(data), 20):
        data[at] = rng.integers(256)
    read_or_refused(tmp_path / "log", bytes(data))
