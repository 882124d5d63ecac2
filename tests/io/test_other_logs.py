"""g2o, CSV and NumPy files: what they say is what is read, and what is malformed is named."""

import gzip
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from recordings import ANGLES, on, path_of, simulated

import bayesmap as bm
from bayesmap.io.logs import describe_log, read_log

TIMES = np.arange(6.0)


def equal(a, b):
    np.testing.assert_allclose(a.poses, b.poses, atol=1e-9)
    np.testing.assert_allclose(a.angles_rad, b.angles_rad, atol=1e-12)
    np.testing.assert_array_equal(a.ranges_m, b.ranges_m)
    np.testing.assert_allclose(a.stamps_s, b.stamps_s)
    assert (a.min_range_m, a.max_range_m) == (b.min_range_m, b.max_range_m)


def refused(path, **options):
    with pytest.raises(bm.BadInput) as error:
        read_log(path, **options)
    assert str(error.value).startswith(str(path))
    return str(error.value)


def g2o(scans, kind="ROBOTLASER1"):
    """A graph whose vertices an optimiser has moved: the poses in the laser lines are the odometry's, all zero."""
    lines = []
    for i, (pose, row, stamp) in enumerate(zip(path_of(TIMES), scans.ranges_m, scans.stamps_s, strict=True)):
        lines.append("VERTEX_SE2 {} {} {} {}".format(i, *map(repr, map(float, pose))))
        laser = on([0.0, 0.0, 0.0])
        readings = [len(row), *(81.83 if math.isinf(v) else v for v in row)]
        first, step = float(ANGLES[0]), float(ANGLES[1] - ANGLES[0])
        words = [
            kind,
            0,
            first,
            4.0,
            step,
            42.0,
            0.01,
            0,
            *readings,
            0,
            *laser,
            0,
            0,
            0,
            0,
            0,
            0,
            0,
            0,
            stamp,
            "h",
            stamp,
        ]
        lines.append(" ".join(str(w) for w in words[:-14]) + " " + " ".join(str(w) for w in words[-14:]))
        if i:
            lines.append(f"EDGE_SE2 {i - 1} {i} 1 0 0 1 0 0 1 0 1")
    return "\n".join([*lines, "FIX 0", ""])


def test_scans_on_the_vertices_of_a_graph(tmp_path):
    scans = simulated(TIMES)
    path = tmp_path / "graph.g2o"
    path.write_text(g2o(scans))
    reading = describe_log(path, max_range_m=42.0)
    assert reading.format == "g2o"
    np.testing.assert_allclose(reading.scans.poses, scans.poses, atol=1e-9)
    np.testing.assert_array_equal(reading.scans.ranges_m, scans.ranges_m)
    np.testing.assert_allclose(reading.scans.angles_rad, ANGLES, atol=1e-12)
    assert reading.messages == {"VERTEX_SE2": 6, "ROBOTLASER1": 6, "EDGE_SE2": 5, "FIX": 1}
    np.testing.assert_allclose(reading.laser_offset, (0.2, -0.1, 0.3), atol=1e-9)
    packed = tmp_path / "graph.g2o.gz"
    packed.write_bytes(gzip.compress(path.read_bytes()))
    np.testing.assert_array_equal(read_log(packed, max_range_m=42.0).ranges_m, scans.ranges_m)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("VERTEX_SE2 3 ", "VERTEX_SE2 3 nan "), "line 9: VERTEX_SE2 has 6 fields"),
        (("VERTEX_SE2 0 ", "# "), "line 2: ROBOTLASER1 does not follow a VERTEX_SE2"),
        (("ROBOTLASER1 0 -2.0", "ROBOTLASER1 0 x"), "line 2: ROBOTLASER1 has 'x' for a number"),
    ],
)
def test_malformed_lines_of_a_graph_are_named_and_left_out_on_request(tmp_path, change, message):
    path = tmp_path / "graph.g2o"
    path.write_text(g2o(simulated(TIMES)).replace(*change, 1))
    assert message in refused(path)
    assert len(read_log(path, skip_bad_lines=True)) == 5


def test_a_graph_without_scans_is_refused(tmp_path):
    path = tmp_path / "graph.g2o"
    path.write_text("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 0 0 0 0 1 0 0 1 0 1\n")
    assert "no vertex of the graph carries a scan" in refused(path)


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
    path = tmp_path / "scans.csv"
    path.write_text(csv(scans, delimiter))
    reading = describe_log(path)
    equal(reading.scans, scans)
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
    path = tmp_path / "beams.csv"
    path.write_text("\n".join(lines))
    reading = describe_log(path)
    equal(reading.scans, scans)
    assert reading.deskewed == moving
    if moving:
        np.testing.assert_allclose(reading.scans.beam_poses, poses)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("# angle_increment", "# step"), "the directions of 41 beams are not said"),
        (("# range_max: 42.0", "# range_max: far"), "line 4: range_max must be a number"),
        (("r_3,", "r_99,"), "must be r_0 to r_40, without gaps"),
        (
            (f"# angle_increment: {float(ANGLES[1] - ANGLES[0])!r}", "# angle_increment: 0"),
            "all 41 beams point the same",
        ),
    ],
)
def test_tables_that_cannot_be_used(tmp_path, change, message):
    path = tmp_path / "scans.csv"
    path.write_text(csv(simulated(TIMES)).replace(*change, 1))
    assert message in refused(path)
    assert message in refused(path, skip_bad_lines=True)


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ("1,2,3", "line 8: the row has 3 fields where the header has 45"),
        (",".join(["1"] * 20 + ["x"] * 25), "line 8: field 21 is 'x', not a number"),
        (",".join(["nan"] * 45), "line 8: a number that must be finite is not"),
    ],
)
def test_malformed_rows_are_named_and_left_out_on_request(tmp_path, row, message):
    lines = csv(simulated(TIMES)).splitlines()
    lines[7] = row
    path = tmp_path / "scans.csv"
    path.write_text("\n".join(lines))
    assert message in refused(path)
    assert len(read_log(path, skip_bad_lines=True)) == 5


def test_an_archive_holds_the_fields_of_scans(tmp_path):
    scans = simulated(TIMES)
    path = tmp_path / "scans.npz"
    fields = {name: getattr(scans, name) for name in ("poses", "angles_rad", "ranges_m", "max_range_m", "stamps_s")}
    np.savez_compressed(path, min_range_m=scans.min_range_m, **fields)
    reading = describe_log(path)
    equal(reading.scans, scans)
    assert (reading.format, reading.no_return_m) == ("npz", None)
    moving = np.repeat(scans.poses[:, None], len(ANGLES), axis=1)
    np.savez(path, **{k: fields[k] for k in ("poses", "angles_rad", "ranges_m")}, beam_poses=moving)
    reading = describe_log(path)
    assert reading.deskewed
    assert reading.max_range_origin == "readings"


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"poses": np.zeros((2, 3)), "angles_rad": np.zeros(3)}, "the archive has no 'ranges_m'"),
        ({"poses": np.zeros((2, 3)), "angles_rad": np.zeros(3), "ranges_m": np.ones((2, 4))}, "ranges_m has shape"),
        ({"poses": np.zeros((2, 3)), "angles_rad": np.zeros(3), "ranges_m": np.full((2, 3), np.nan)}, "none of 6"),
        ({"poses": np.array(["a"]), "angles_rad": np.zeros(3), "ranges_m": np.ones((1, 3))}, "not numbers"),
        ({"poses": np.array([None]), "angles_rad": np.zeros(3), "ranges_m": np.ones((1, 3))}, "not a readable .npz"),
    ],
)
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
        path.write_bytes(content)
        for skip in (False, True):
            try:
                told = f"{path}: {len(read_log(path, skip_bad_lines=skip))} scans"
            except bm.BadInput as problem:
                told = str(problem)
            assert told.startswith(str(path))
