"""g2o, CSV and NumPy files: what they say is what is read, and what is malformed is named."""

import gzip
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from recordings import ANGLES, on, path_of, read_or_refused, refused, same, simulated

import bayesmap as bm
from bayesmap.io.logs import describe_log, read_log
from bayesmap.io.text.carmen import write_carmen

TIMES = np.arange(6.0)


def written(path, text):
    path.write_text(text)
    return path


def g2o(scans):
    """A graph whose vertices an optimiser has moved: the poses in the laser lines are the odometry's, all zero."""
    head = f"ROBOTLASER1 0 {float(ANGLES[0])!r} 4.0 {float(ANGLES[1] - ANGLES[0])!r} 42.0 0.01 0"
    lines, mount = [], "{} {} {}".format(*on([0.0, 0.0, 0.0]))
    for i, (pose, row, stamp) in enumerate(zip(path_of(TIMES), scans.ranges_m, scans.stamps_s, strict=True)):
        lines.append("VERTEX_SE2 {} {} {} {}".format(i, *map(repr, map(float, pose))))
        readings = " ".join(str(81.83 if math.isinf(v) else v) for v in row)
        lines.append(f"{head} {len(row)} {readings} 0 {mount} 0 0 0 0 0 0 0 0 {stamp} h {stamp}")
        if i:
            lines.append(f"EDGE_SE2 {i - 1} {i} 1 0 0 1 0 0 1 0 1")
    return "\n".join([*lines, "FIX 0", ""])


def test_scans_on_the_vertices_of_a_graph(tmp_path):
    scans = simulated(TIMES)
    path = written(tmp_path / "graph.g2o", g2o(scans))
    reading = describe_log(path, max_range_m=42.0)
    assert reading.format == "g2o"
    np.testing.assert_allclose(reading.scans.poses, scans.poses, atol=1e-9)
    np.testing.assert_array_equal(reading.scans.ranges_m, scans.ranges_m)
    np.testing.assert_allclose(reading.scans.angles_rad, ANGLES, atol=1e-12)
    assert reading.messages == {"VERTEX_SE2": 6, "ROBOTLASER1": 6, "EDGE_SE2": 5, "FIX": 1}
    np.testing.assert_allclose(reading.scans.mount, (0.2, -0.1, 0.3), atol=1e-9)
    packed = tmp_path / "graph.g2o.gz"
    packed.write_bytes(gzip.compress(path.read_bytes()))
    np.testing.assert_array_equal(read_log(packed, max_range_m=42.0).ranges_m, scans.ranges_m)


@pytest.mark.parametrize("edges", ["", "EDGE2 0 1 1 0 0 1 0 1 1 0 0\n"])
def test_toro_s_vertices_are_those_of_a_graph(tmp_path, edges):
    """VERTEX2 beside CARMEN lines: the optimised poses, not those of the laser lines."""
    scans = simulated(TIMES)
    reading = describe_log(written(tmp_path / "toro.graph", edges + g2o(scans).replace("VERTEX_SE2", "VERTEX2")))
    same(reading.scans, describe_log(written(tmp_path / "graph.g2o", g2o(scans))).scans)
    assert reading.pose_source == "VERTEX2"
    late = written(tmp_path / "late.graph", g2o(scans).replace("VERTEX_SE2", "# ", 1) + "VERTEX2 9 0 0 0\n")
    refused(late, "line 2: ROBOTLASER1 does not follow a VERTEX_SE2 or VERTEX2")


def test_a_graph_without_scans_and_gmapping_s_own_log_are_refused_and_late_vertices_noted(tmp_path):
    path = written(tmp_path / "graph.g2o", "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 0 0 0 0 1 0 0 1 0 1\n")
    assert "no vertex of the graph carries a scan" in refused(path)
    text = "ODO_UPDATE 1 0 0 0 0\nLASER_READING 3 1.0 2.0 1.5 0.1\nNEFF 20\n"
    for start in ("", "NEFF 1\n", "# comment\n"):
        assert "gfs2log" in refused(written(tmp_path / "run.gfs", start + text))
    text = "".join("FLASER 3 1.0 2.0 1.5 {x} 0 0 {x} 0 0 {x} host {x}\n".format(x=0.1 * i) for i in range(1100))
    reading = describe_log(written(tmp_path / "log", text + "VERTEX2 0 1 0 0\n"))
    assert any("1 VERTEX2 lines, which were not used" in note for note in reading.notes)


def csv(scans, delimiter=","):
    names = ["stamp", "x", "y", "yaw", *(f"r_{i}" for i in range(len(ANGLES)))]
    lines = [
        f"# angle_min: {float(ANGLES[0])!r}", f"# angle_increment: {float(ANGLES[1] - ANGLES[0])!r}",
        f"# range_min: {scans.min_range_m!r}", f"# range_max: {scans.max_range_m!r}", delimiter.join(names),
    ]  # fmt: skip
    for pose, row, stamp in zip(scans.poses, scans.ranges_m, scans.stamps_s, strict=True):
        lines.append(delimiter.join(repr(float(v)) for v in (stamp, *pose, *row)))
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_a_table_of_one_row_a_scan(tmp_path, delimiter):
    scans = simulated(TIMES)
    reading = describe_log(written(tmp_path / "scans.csv", csv(scans, delimiter)))
    same(reading.scans, scans)
    assert (reading.format, reading.max_range_origin) == ("csv", "message")


@pytest.mark.parametrize("moving", [False, True])
def test_a_table_of_one_row_a_beam(tmp_path, moving):
    scans = simulated(TIMES)
    poses = np.repeat(scans.poses[:, None], len(ANGLES), axis=1)
    if moving:
        poses = poses + np.arange(len(ANGLES))[:, None] * [0.01, 0.0, 0.001]
    lines = ["# range_max: 42", f"# range_min: {scans.min_range_m!r}", "scan,x,y,yaw,angle,range,stamp,remark"]
    for s in range(len(TIMES)):
        for a, angle in enumerate(ANGLES):
            numbers = (*poses[s, a], angle, scans.ranges_m[s, a], scans.stamps_s[s])
            lines.append(f"{s}," + ",".join(repr(float(v)) for v in numbers) + ",")
    reading = describe_log(written(tmp_path / "beams.csv", "\n".join(lines)))
    same(reading.scans, scans)
    assert reading.deskewed == moving
    if moving:
        np.testing.assert_allclose(reading.scans.beam_poses, poses)


@pytest.mark.parametrize(("change", "message"), [
    (("# angle_increment", "# step"), "the directions of 41 beams are not said"),
    (("# range_max: 42.0", "# range_max: far"), "line 4: range_max must be a number"),
    (("r_3,", "r_99,"), "must be r_0 to r_40, without gaps"),
    (("# angle_increment: ", "# angle_increment: 0\n# "), "all 41 beams point the same"),
])  # fmt: skip
def test_tables_that_cannot_be_used(tmp_path, change, message):
    path = written(tmp_path / "scans.csv", csv(simulated(TIMES)).replace(*change, 1))
    assert message in refused(path)
    assert message in refused(path, skip_bad_lines=True)


@pytest.mark.parametrize(("text", "number", "line", "message"), [
    (g2o, 8, "VERTEX_SE2 3 nan 0 0 0", "line 9: VERTEX_SE2 has 6 fields"),
    (g2o, 0, "# 0", "line 2: ROBOTLASER1 does not follow a VERTEX_SE2"),
    (g2o, 1, "ROBOTLASER1 0 -2.0 4.0 0.1 42.0 0.01 0 1 x 0" + " 0" * 12 + " h 0", "line 2: ROBOTLASER1 has 'x'"),
    (csv, 7, "1,2,3", "line 8: the row has 3 fields where the header has 45"),
    (csv, 7, ",".join(["1"] * 20 + ["x"] * 25), "line 8: field 21 is 'x', not a number"),
    (csv, 7, ",".join(["nan"] * 45), "line 8: a number that must be finite is not"),
    (csv, 7, ",".join(["1e9"] * 45), "or is too large: {'x': 1000000000.0"),
])  # fmt: skip
def test_malformed_lines_are_named_and_left_out_on_request(tmp_path, text, number, line, message):
    lines = text(simulated(TIMES)).splitlines()
    lines[number] = line
    path = written(tmp_path / "log", "\n".join(lines))
    assert message in refused(path)
    assert len(read_log(path, skip_bad_lines=True)) == 5


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
@pytest.mark.parametrize("zipped", [False, True])
@pytest.mark.parametrize("text", [csv, g2o])
def test_a_byte_order_mark_and_utf_16_change_nothing(tmp_path, encoding, zipped, text):
    scans = simulated(TIMES)
    mark = "" if encoding in ("utf-8-sig", "utf-16") else "\ufeff"
    content = (mark + text(scans).replace("\n", "\r\n")).encode(encoding)
    path = tmp_path / "log"
    path.write_bytes(gzip.compress(content) if zipped else content)
    same(read_log(path), read_log(written(tmp_path / "plain", text(scans))))
    path.write_bytes(b"\xff\xfe" + text(scans).encode()[:-1] + b"\x00\xd8")  # a mark of another encoding
    refused(path)


def spreadsheet(scans, delimiter, decimal):
    """The table as a spreadsheet leaves it: padded comments, quotes, an empty row, perhaps decimal commas."""
    lines = ["sep=" + delimiter]
    for line in csv(scans, "\t").splitlines():
        cells = line.split("\t")
        lines.append(delimiter.join(cell.replace(".", decimal) for cell in cells + [""] * (45 - len(cells))))
        if "," in line and delimiter == ",":
            lines[-1] = '"' + lines[-1] + '"'
    return "\n".join([*lines, delimiter * 44, ""])


@pytest.mark.parametrize(("delimiter", "decimal"), [(",", "."), (";", "."), (";", ","), ("\t", ",")])
def test_a_table_that_a_spreadsheet_saved(tmp_path, delimiter, decimal):
    scans = simulated(TIMES)
    same(read_log(written(tmp_path / "scans.csv", spreadsheet(scans, delimiter, decimal))), scans)


@pytest.mark.parametrize("line", [
    "# angles: -1.5 -0.25 1", "# angles: -1.5,-0.25,1", '"# angles: -1.5, -0.25, 1",,',
    "# angles: -1,5 -0,25 1,0", "# angles: -1,5;-0,25;1,0;;",
])  # fmt: skip
def test_angles_with_decimal_points_or_commas(tmp_path, line):
    for text, angles in ((line, [-1.5, -0.25, 1.0]), ("# angles: -1,0,1", [-1.0, 0.0, 1.0])):
        path = written(tmp_path / "scans.csv", text + "\nx;y;yaw;r_0;r_1;r_2\n0;0;0;1;2;3\n")
        np.testing.assert_array_equal(read_log(path).angles_rad, angles)


def echoed(scans, poses=False, stamp="field.header.stamp"):
    """Return the table that rostopic echo -p makes of the messages."""
    head = ["%time", "field.header.seq", stamp, "field.header.frame_id", "field.angle_min", "field.angle_max"]
    head += ["field.angle_increment", "field.time_increment", "field.scan_time", "field.range_min", "field.range_max"]
    head += [f"field.ranges{i}" for i in range(len(ANGLES))] + [f"field.intensities{i}" for i in range(len(ANGLES))]
    lines = [",".join([*head, *(["x", "y", "yaw"] if poses else [])])]
    for i, (pose, row, at) in enumerate(zip(scans.poses, scans.ranges_m, scans.stamps_s, strict=True)):
        ns = round(at * 1e9)
        step = float(ANGLES[1] - ANGLES[0])
        words = [ns + 10**7, i, ns if "stamp" in stamp else 0, "laser", float(ANGLES[0]), float(ANGLES[-1]), step]
        words += [0.0, 0.1, scans.min_range_m, scans.max_range_m, *map(float, row), *[47.0] * len(ANGLES)]
        lines.append(",".join(str(word) for word in [*words, *(map(float, pose) if poses else [])]))
    return "\n".join(lines) + "\n"


def test_scans_as_rostopic_echo_writes_them(tmp_path):
    """Scans with poses in columns of their own are a log; others are scans alone."""
    scans = simulated(TIMES)
    same(read_log(written(tmp_path / "posed.csv", echoed(scans, poses=True))), scans)
    path = written(tmp_path / "scans.csv", echoed(scans))
    assert "bayesmap slam --no-odometry" in refused(path)
    reading = describe_log(path, without_poses=True)
    assert not reading.posed
    same(reading.scans, scans.at(np.zeros((len(TIMES), 3))))
    assert reading.scans.own_angles_rad is None
    unstamped = written(tmp_path / "received.csv", echoed(scans, stamp="field.header.none"))
    np.testing.assert_allclose(read_log(unstamped, without_poses=True).stamps_s, scans.stamps_s + 0.01)


def ros2_rows(scans, intensities=True):
    """Yield rows as ros2 topic echo --csv --full-length writes them: no header, an empty field for no intensities."""
    for scan, at in enumerate(scans.stamps_s):
        angles, ranges = scans.beams_of(scan)
        ns, step = round(at * 1e9), float(angles[1] - angles[0])
        words = [ns // 10**9, ns % 10**9, "laser", float(angles[0]), float(angles[-1]), step, 0.0, 0.1]
        words += [scans.min_range_m, scans.max_range_m, *map(float, ranges)]
        yield ",".join(map(str, [*words, *([47.0] * len(ranges) if intensities else [""])])) + "\n"


def test_scans_as_ros2_topic_echo_writes_them(tmp_path):
    scans = simulated(TIMES).at(np.zeros((len(TIMES), 3)))
    for intensities in (True, False):
        path = written(tmp_path / "scans.csv", "".join(ros2_rows(scans, intensities)))
        assert "bayesmap slam --no-odometry" in refused(path)
        same(read_log(path, without_poses=True), scans)
    few = bm.Scans(scans.poses, scans.angles_rad[:3] + 0.1, scans.ranges_m[:, :3], 42.0, stamps_s=scans.stamps_s + 99.0)
    wide, narrow = ros2_rows(scans), ros2_rows(few)
    both = read_log(written(tmp_path / "both.csv", "".join([*wide, *narrow])), without_poses=True)
    assert np.isfinite(both.own_angles_rad).sum(axis=1).tolist() == [len(ANGLES)] * len(TIMES) + [3] * len(TIMES)
    row = next(ros2_rows(scans, intensities=False))
    assert "--full-length" in refused(written(tmp_path / "cut.csv", ",".join([*row.split(",")[:14], "...", "\n"])))
    odd = written(tmp_path / "odd.csv", row.rstrip("\n") + "1.0,2.0\n")
    assert "line 1: " in refused(odd, without_poses=True)


def test_a_table_with_the_names_of_a_message_s_fields_and_poses_that_are_not_needed_are_read(tmp_path):
    head = "Time,header.seq,header.stamp.secs,header.stamp.nsecs,header.frame_id,angle_min,angle_max,angle_increment"
    text = head + ",range_min,range_max,ranges_0,ranges_1,ranges_2\n"
    text += "10.5,0,10,250000000,laser,-0.5,0.5,0.5,0.1,8,1,inf,2\n10.7,1,10,450000000,laser,-0.5,0.5,0.5,0.1,8,1,2,3\n"
    scans = read_log(written(tmp_path / "bag.csv", text), without_poses=True)
    np.testing.assert_allclose(scans.angles_rad, [-0.5, 0.0, 0.5])
    np.testing.assert_allclose(scans.stamps_s, [10.25, 10.45])
    np.testing.assert_array_equal(scans.ranges_m, [[1, np.inf, 2], [1, 2, 3]])
    assert (scans.min_range_m, scans.max_range_m) == (0.1, 8.0)
    scans = simulated(TIMES)
    reading = describe_log(written(tmp_path / "scans.csv", csv(scans)), without_poses=True)
    assert reading.posed
    same(reading.scans, scans)
    path = tmp_path / "scans.npz"
    np.savez(path, angles_rad=ANGLES, ranges_m=scans.ranges_m)
    assert "bayesmap slam --no-odometry" in refused(path)
    assert not describe_log(path, without_poses=True).posed


MOUNTED = (0.2, -0.1, 2.5)


@pytest.mark.parametrize("kind", ["csv", "npz", "g2o", "carmen"])
def test_a_laser_that_sits_elsewhere_on_the_robot_than_the_log_says(tmp_path, kind):
    """The poses of the log are then the robot's, in lines that say both, too."""
    scans = simulated(TIMES)
    robot = scans.poses
    if kind == "npz":
        path = tmp_path / "scans.npz"
        np.savez(path, poses=robot, angles_rad=ANGLES, ranges_m=scans.ranges_m)
    elif kind == "carmen":
        path = tmp_path / "log"
        write_carmen(path, scans.at(on(robot, (9.0, 9.0, 0.0))), robot)
    else:
        path = written(tmp_path / "log", csv(scans) if kind == "csv" else g2o(scans))
        robot = robot if kind == "csv" else path_of(TIMES)
    reading = describe_log(path, laser=MOUNTED)
    expected = on(robot, MOUNTED)
    np.testing.assert_allclose(reading.scans.poses[:, :2], expected[:, :2], atol=1e-5)
    np.testing.assert_allclose(np.cos(reading.scans.poses[:, 2] - expected[:, 2]), 1.0, atol=1e-9)
    np.testing.assert_allclose(reading.scans.mount, MOUNTED)
    with pytest.raises(bm.BadInput, match="laser: give x and y in metres"):
        read_log(path, laser=(0.0, math.nan, 0.0))


def raw(kind="RAWLASER1"):
    line = "{} 0 -1.0 2.0 1.0 30.0 0.01 0 3 1.5 2.5 {} 0 {} host {}\n"
    return "".join(line.format(kind, 3.0 + i, 100.0 + 0.1 * i, 0.1 * i) for i in range(4))


@pytest.mark.parametrize("kind", ["RAWLASER1", "RAWLASER4"])
def test_laser_lines_without_poses_are_scans_alone(tmp_path, kind):
    path = written(tmp_path / "raw.log", raw(kind))
    assert "RAWLASER lines have no pose: bayesmap slam --no-odometry" in refused(path)
    reading = describe_log(path, without_poses=True)
    assert not reading.posed
    np.testing.assert_array_equal(reading.scans.ranges_m[:, 2], [3.0, 4.0, 5.0, 6.0])
    np.testing.assert_array_equal(reading.scans.angles_rad, [-1.0, 0.0, 1.0])
    np.testing.assert_allclose(reading.scans.stamps_s, 100.0 + 0.1 * np.arange(4))
    assert not reading.scans.poses.any()


def test_an_archive_holds_the_fields_of_scans(tmp_path):
    scans = simulated(TIMES)
    path = tmp_path / "scans.npz"
    fields = {name: getattr(scans, name) for name in ("poses", "angles_rad", "ranges_m", "max_range_m", "stamps_s")}
    unused = np.array([None])  # an array of objects, which cannot be read
    np.savez_compressed(path, min_range_m=scans.min_range_m, notes=unused, **fields)
    reading = describe_log(path)
    same(reading.scans, scans)
    assert (reading.format, reading.no_return.code_m) == ("npz", None)
    moving = np.repeat(scans.poses[:, None], len(ANGLES), axis=1)
    np.savez(path, **{k: fields[k] for k in ("poses", "angles_rad", "ranges_m")}, beam_poses=moving)
    reading = describe_log(path)
    assert reading.deskewed
    assert reading.max_range_origin == "readings"


@pytest.mark.parametrize(("arrays", "message"), [
    ({"poses": np.zeros((2, 3)), "angles_rad": np.zeros(3)}, "the archive has no 'ranges_m'"),
    ({"poses": np.zeros((2, 3)), "angles_rad": np.zeros(3), "ranges_m": np.ones((2, 4))}, "ranges_m has shape"),
    ({"poses": np.zeros((2, 3)), "angles_rad": np.zeros(3), "ranges_m": np.full((2, 3), np.nan)}, "none of 6"),
    ({"poses": np.array(["a"]), "angles_rad": np.zeros(3), "ranges_m": np.ones((1, 3))}, "not numbers"),
    ({"poses": np.array([None]), "angles_rad": np.zeros(3), "ranges_m": np.ones((1, 3))}, "not a readable .npz"),
])  # fmt: skip
def test_archives_that_cannot_be_used(tmp_path, arrays, message):
    path = tmp_path / "scans.npz"
    np.savez(path, **arrays)
    assert message in refused(path)


@given(st.integers(0, 2**32 - 1))
def test_whatever_a_damaged_file_holds_it_is_read_or_refused(tmp_path_factory, seed):
    rng = np.random.default_rng(seed)
    folder = tmp_path_factory.mktemp("fuzz")
    scans = simulated(TIMES)
    np.savez(folder / "a.npz", poses=scans.poses, angles_rad=ANGLES, ranges_m=scans.ranges_m)
    (folder / "a.csv").write_text(csv(scans))
    (folder / "a.g2o").write_text(g2o(scans))
    for path in (folder / "a.npz", folder / "a.csv", folder / "a.g2o"):
        content = bytearray(path.read_bytes())
        content = content[: rng.integers(1, len(content) + 1)] if rng.random() < 0.5 else content
        for _ in range(rng.integers(1, 4)):
            content[rng.integers(len(content))] = rng.integers(256)
        read_or_refused(path, bytes(content))
