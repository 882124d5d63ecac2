"""Logs of the corpus, thinning, jumps, and beams that differ from scan to scan."""

import math
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import recordings as r
from data import intel_log
from hypothesis import given
from hypothesis import strategies as st
from recordings import read_or_refused

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.io.live import live_scans
from bayesmap.io.logs import describe_log, read_log
from bayesmap.io.text.carmen import write_carmen
from bayesmap.space.planar import wrap_angle
from bayesmap.space.time_order import find_jumps, steps_m, thin_scans

CORPUS = Path(__file__).with_name("corpus")


@cache
def expected():
    return tomllib.loads((CORPUS / "expected.toml").read_text())


def refusal(path, **options):
    try:
        describe_log(path, **options)
    except BadInput as error:
        return str(error)
    return ""


def test_a_broken_log_is_refused_with_its_place_and_a_reason():
    assert {path.name for path in CORPUS.iterdir()} == {*expected(), "expected.toml"}
    offenders = {}
    for name, facts in expected().items():
        message = refusal(CORPUS / name)
        parts = [facts["error"], *(["--skip-bad-lines"] if "skipped" in facts else [])]
        if not (message.startswith(str(CORPUS / name)) and all(part in message for part in parts)):
            offenders[name] = message
    assert offenders == {}


def test_bad_lines_are_left_out_on_request_and_listed_but_not_all_lines():
    for name, facts in expected().items():
        if "skipped" not in facts:
            assert refusal(CORPUS / name, skip_bad_lines=True), name
            continue
        reading = describe_log(CORPUS / name, skip_bad_lines=True)
        assert [part.number for part in reading.skipped] == facts["skipped"], name
        assert (len(reading.scans), reading.summary()["skipped_lines"]) == (facts["scans"], len(facts["skipped"])), name


@given(st.binary(max_size=400))
def test_whatever_a_file_holds_it_is_read_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("junk") / "junk.log"
    for start in (b"", b"FLASER 2 ", b"ODOM 1 2 3\n", b"\x1f\x8b"):
        read_or_refused(path, start + content)


def test_a_missing_file_a_folder_and_a_saved_run_are_refused_by_name(tmp_path):
    with pytest.raises(BadInput, match=r"absent\.log: cannot be read: No such file"):
        read_log(tmp_path / "absent.log")
    with pytest.raises(BadInput, match=r"a folder, but not a ROS 2 bag's.*; give a file$"):
        read_log(tmp_path)
    (tmp_path / "b.log.gz").touch()
    with pytest.raises(BadInput, match=r"; give what is in it, such as .*/b\.log\.gz$"):
        read_log(tmp_path)
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "metadata.yaml").touch()  # a bag's folder
    with pytest.raises(BadInput, match=r"; give what is in it, such as .*/a$"):
        read_log(tmp_path)
    (tmp_path / "run.nc").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    with pytest.raises(BadInput, match=r"run\.nc: a saved run or another netCDF file, not a log; give the log"):
        read_log(tmp_path / "run.nc")


def test_the_intel_log_is_read_as_its_description_says():
    reading = describe_log(intel_log("intel-corrected.log.gz"))
    scans = reading.scans
    assert scans.ranges_m.shape == (910, 180)
    assert reading.messages == {"FLASER": 910, "ODOM": 14541, "NEFF": 910}
    assert (reading.no_return.code_m, reading.no_return.origin) == (81.83, "found")
    assert scans.counts() == {"hit": 159628, "no_return": 4172, "too_close": 0, "invalid": 0}
    assert (scans.max_range_m, scans.ranges_m.min()) == (26.0, 0.23)
    np.testing.assert_allclose(np.degrees(scans.angles_rad), np.arange(-90, 90), atol=1e-9)
    assert reading.reordered > 0
    assert (np.diff(scans.stamps_s) >= 0).all()
    np.testing.assert_array_equal(scans.mount, 0.0)
    assert reading.skipped == ()


def scans_at(positions, stamps=None):
    poses = np.column_stack([np.asarray(positions, float), np.zeros(len(positions))])
    return bm.Scans(poses, [0.0], np.arange(1.0, len(poses) + 1)[:, None], 1000.0, stamps_s=stamps)


def test_the_distance_is_that_of_the_path_and_steps_that_make_a_metre_keep_every_tenth_scan():
    scans = scans_at([(0.1 * i, 0.0) for i in range(31)])
    np.testing.assert_array_equal(thin_scans(scans, 1.0).ranges_m[:, 0], [1, 11, 21, 31])
    there_and_back = [(0, 0), (0.6, 0), (0, 0), (0.6, 0), (0, 0)]
    np.testing.assert_array_equal(thin_scans(scans_at(there_and_back), 1.0).ranges_m[:, 0], [1, 3, 5])


@given(st.lists(st.tuples(st.floats(-50, 50), st.floats(-50, 50)), min_size=1, max_size=30), st.floats(0, 20))
def test_kept_scans_are_far_enough_apart_and_none_more_could_be_dropped(positions, spacing):
    scans = scans_at(positions)
    kept = thin_scans(scans, spacing).ranges_m[:, 0].astype(int) - 1
    travelled = np.concatenate([[0.0], np.cumsum(steps_m(scans.poses))])
    assert kept[0] == 0
    assert (np.diff(travelled[kept]) >= spacing * (1 - 1e-8)).all()
    for start, end in zip(kept, [*kept[1:], len(scans)], strict=True):
        assert spacing == 0 or (travelled[start + 1 : end] - travelled[start] < spacing).all()


@pytest.mark.parametrize("spacing", [-1.0, np.nan, np.inf])
def test_a_spacing_that_is_none_is_refused(spacing):
    with pytest.raises(bm.BadInput, match="thin"):
        thin_scans(scans_at([(0, 0)]), spacing)


@pytest.mark.parametrize(("x_m", "stamps", "jumped"), [
    ([0, 0.1, 0.2, 3.2, 3.3, 3.4], 0.1 * np.arange(6), [3]),  # faster than a robot
    (np.cumsum([0.1] * 20 + [2.5] + [0.1] * 5), None, [20]),  # a long step among short ones, without any time
    (3.0 * np.arange(9), 5.0 * np.arange(9), []),  # far apart throughout
    ([0, 0.1, 0], np.array([0.0, 0.0, 1e-6]), []),  # a trembling pose, however close the stamps
])  # fmt: skip
def test_a_step_is_a_jump_if_it_is_too_fast_or_far_longer_than_others(x_m, stamps, jumped):
    np.testing.assert_array_equal(find_jumps(scans_at([(x, 0) for x in x_m], stamps)), jumped)


@pytest.mark.parametrize("grain_s", [1.0, 10.0, 1e6])
def test_stamps_that_repeat_make_no_jump_of_an_ordinary_step(grain_s):
    times = 1.13486e9 + 0.5 * np.arange(100)
    walk = [(1.5 * i, 0) for i in range(100)]
    assert len(find_jumps(scans_at(walk, np.floor(times / grain_s) * grain_s))) == 0
    walk[60:] = [(x + 40.0, 0) for x, _ in walk[60:]]
    np.testing.assert_array_equal(find_jumps(scans_at(walk, np.floor(times / grain_s) * grain_s)), [60])


FANS = {
    "counts": [(0.0, 2 * math.pi / (n - 1), n) for n in (40, 44, 41, 40, 38, 43)],
    "first angles": [(-math.pi + d, 0.15, 41) for d in (0.0, 0.004, -0.003, 0.001, 0.002, -0.006)],
    "two layouts": [(-1.5664, 0.05, 60), (-1.5708, 0.05, 61)] * 3,
    "steps": [(-1.0, 0.05 + 0.001 * i, 20) for i in range(6)],
    "one beam and many": [(0.5, 0.0, 1), (-1.0, 0.1, 21)] * 3,
}
"""First angle, step and number of beams of each scan."""


def log(fans):
    angles = [first + step * np.arange(beams) for first, step, beams in fans]
    readings = [np.round(2.0 + 0.01 * i + 0.02 * np.arange(len(own)), 4) for i, own in enumerate(angles)]
    poses = np.column_stack([0.2 * np.arange(len(fans)), 0.1 * np.arange(len(fans)), 0.05 * np.arange(len(fans))])
    return angles, readings, poses, 10.0 + 0.1 * np.arange(len(fans))


def hits(angles, readings, poses):
    world = [pose[2] + own for pose, own in zip(poses, angles, strict=True)]
    ends = [row[:, None] * np.stack([np.cos(a), np.sin(a)], -1) for row, a in zip(readings, world, strict=True)]
    return np.concatenate([pose[:2] + end for pose, end in zip(poses, ends, strict=True)])


def check(reading, fans, atol=1e-6):
    """Check that angles, readings and walls are those of the log, beam by beam."""
    angles, readings, poses, _ = log(fans)
    scans = reading.scans
    assert len(scans) == len(fans)
    for i in range(len(fans)):
        own, row = scans.beams_of(i)
        np.testing.assert_allclose(own, angles[i], atol=atol)
        np.testing.assert_allclose(row, readings[i], atol=1e-5)
    np.testing.assert_allclose(scans.hit_points_world(), hits(angles, readings, poses), atol=1e-4)
    assert scans.ranges_m.shape == (len(fans), max(map(len, readings)))
    assert scans.n_beams == sum(scans.counts().values()) == sum(map(len, readings))
    assert any("each keeps its own" in note for note in reading.notes)


@pytest.mark.parametrize("writer", ["rosbag1", "mcap-ros1", "mcap", "sqlite3"])
@pytest.mark.parametrize("fans", FANS.values(), ids=FANS)
def test_recordings(tmp_path, writer, fans):
    _, readings, poses, stamps = log(fans)
    messages = []
    for (first, step, beams), row, pose, t in zip(fans, readings, poses, stamps, strict=True):
        scan = r.laser(t, row, [first, first + step * (beams - 1)] if beams > 1 else [first])
        messages.append(("/scan", r.SCAN, t, {**scan, "angle_increment": step}))
        messages.append(("/tf", r.TF, t, r.tf(r.transform(t, "odom", "laser", *pose))))
    check(describe_log(r.written(tmp_path, messages, writer)), fans, atol=2e-5)


def carmen(fans, kind="ROBOTLASER1"):
    _, readings, poses, stamps = log(fans)
    lines = []
    for (first, step, beams), row, pose, t in zip(fans, readings, poses, stamps, strict=True):
        place, values = " ".join(map(repr, map(float, pose))), " ".join(map(repr, map(float, row)))
        head = f"0 {first!r} 3.0 {step or 0.1!r} 80.0 0.01 0 "
        lines.append(f"{kind} {head}{beams} {values} 0 {place} {place} 0 0 0 0 0 {t} host {t}\n")
    return lines


@pytest.mark.parametrize("fans", FANS.values(), ids=FANS)
def test_texts_and_arrays(tmp_path, fans):
    angles, readings, poses, stamps = log(fans)
    (tmp_path / "a.log").write_text("".join(carmen(fans)))
    check(describe_log(tmp_path / "a.log"), fans)
    vertices = [f"VERTEX_SE2 {i} {' '.join(map(repr, map(float, pose)))}\n" for i, pose in enumerate(poses)]
    (tmp_path / "a.g2o").write_text("".join(v + line for v, line in zip(vertices, carmen(fans), strict=True)))
    check(describe_log(tmp_path / "a.g2o"), fans)
    rows, wide = ["scan,stamp,x,y,yaw,angle,range"], max(map(len, readings))
    for i, (own, row, pose) in enumerate(zip(angles, readings, poses, strict=True)):
        start = ",".join(map(repr, map(float, [i, stamps[i], *pose])))
        rows += [f"{start},{float(a)!r},{float(v)!r}" for a, v in zip(own, row, strict=True)]
    (tmp_path / "beams.csv").write_text("\n".join(rows))
    check(describe_log(tmp_path / "beams.csv"), fans)
    rows = ["stamp,x,y,yaw,angle_min,angle_increment," + ",".join(f"r_{k}" for k in range(wide))]
    for (first, step, beams), row, pose, t in zip(fans, readings, poses, stamps, strict=True):
        rows.append(",".join([*map(repr, map(float, [t, *pose, first, step, *row])), *[""] * (wide - beams)]))
    (tmp_path / "scans.csv").write_text("\n".join(rows) + "\n")
    check(describe_log(tmp_path / "scans.csv"), fans)
    block = np.full((2, len(fans), wide), np.nan)
    for i, (own, row) in enumerate(zip(angles, readings, strict=True)):
        block[0, i, : len(own)], block[1, i, : len(own)] = own, row
    np.savez(tmp_path / "a.npz", poses=poses, angles_rad=block[0], ranges_m=block[1], stamps_s=stamps)
    check(describe_log(tmp_path / "a.npz"), fans)
    block[1, 0, :] = 1.0
    block[0, 0, -1] = np.nan
    np.savez(tmp_path / "b.npz", poses=poses, angles_rad=block[0], ranges_m=block[1])
    with pytest.raises(bm.BadInput, match=r"angle of beam \d+ of scan 0 is nan, but its reading is 1\.0"):
        describe_log(tmp_path / "b.npz")


@pytest.mark.parametrize("name", ["counts", "first angles", "two layouts", "steps"])
def test_a_log_that_is_written_anew_and_followed_says_the_same(tmp_path, name):
    (tmp_path / "a.log").write_text("".join(carmen(FANS[name])))
    scans = describe_log(tmp_path / "a.log").scans
    assert write_carmen(tmp_path / "b.log", scans) == "ROBOTLASER1"
    check(describe_log(tmp_path / "b.log"), FANS[name])
    for i, one in enumerate(live_scans(str(tmp_path / "b.log"), max_range_m=80.0, idle_s=0.1)):
        np.testing.assert_allclose(one.beams_of(0), scans.beams_of(i), atol=1e-4)


def test_scans_without_a_reading_are_left_out_and_counted(tmp_path):
    fans = FANS["counts"]
    lines = carmen(fans)
    empty = "ROBOTLASER1 0 0.0 3.0 0.1 80.0 0.01 0 0 0 0 0 0 0 0 0 0 0 0 0 0 10.05 host 10.05\n"
    (tmp_path / "a.log").write_text("".join([lines[0], empty, *lines[1:]]))
    reading = describe_log(tmp_path / "a.log")
    check(reading, fans)
    assert "1 ROBOTLASER1 lines have no readings, and were left out" in reading.notes
    messages, scans = r.replaced({"ranges": []})
    reading = describe_log(r.written(tmp_path, messages))
    np.testing.assert_array_equal(reading.scans.ranges_m, np.delete(scans.ranges_m, 4, axis=0))
    assert reading.scans.own_angles_rad is None
    assert "1 messages on /scan have no readings, and were left out" in reading.notes
    silent = [(*m[:3], {**m[3], "ranges": []}) if m[0] == "/scan" else m for m in messages]
    with pytest.raises(bm.BadInput, match="no message on /scan has a reading"):
        describe_log(r.written(tmp_path / "silent", silent))


def test_rays_of_scans_of_unlike_length_have_poses_of_their_own(tmp_path):
    fans, messages = FANS["counts"], []
    for (first, step, beams), t in zip(fans, 10.0 + 0.1 * np.arange(6), strict=True):
        scan = r.laser(t, [2.0] * beams, [first, first + step * (beams - 1)], ray_s=0.001, angle_increment=step)
        messages.append(("/scan", r.SCAN, t, scan))
    moves = [(t, r.transform(t, "odom", "laser", t - 10.0, 0.0, 0.0)) for t in np.arange(9.9, 10.8, 0.05)]
    messages += [("/tf", r.TF, t, r.tf(move)) for t, move in moves]
    scans = describe_log(r.written(tmp_path, messages), deskew=True).scans
    expected = 0.1 * np.arange(6)[:, None] + 0.001 * np.arange(44)
    np.testing.assert_allclose(scans.beam_poses[..., 0][scans.has_beam], expected[scans.has_beam], atol=1e-6)
    np.testing.assert_array_equal(scans.has_beam.sum(axis=1), [fan[2] for fan in fans])


@pytest.mark.parametrize(("text", "reason"), [
    ("# angle_min: -90\n# angle_increment: 2\nx,y,yaw,r_0,r_1,r_2,r_3,r_4\n0,0,0,1,1,1,1,1\n", "1.27 turns"),
    ("scan,x,y,yaw,angle,range\n0,0,0,0,-90,1\n0,0,0,0,90,1\n", "line 2: the scan that starts here: its beams"),
    ("x,y,yaw,angle_min,angle_increment,r_0,r_1\n0,0,0,-90,1,1,1\n", "line 2: its beams point from -90 to -89"),
    ("ROBOTLASER1 0 -90 180 45 80 0.01 0 5 1 1 1 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1 host 1\n", "line 1: ROBOTLASER1"),
])  # fmt: skip
def test_degrees_are_refused(tmp_path, text, reason):
    (tmp_path / "log").write_text(text)
    with pytest.raises(bm.BadInput, match="angles must be in radians: are these degrees") as error:
        describe_log(tmp_path / "log")
    assert reason in str(error.value)


def test_a_yaw_in_degrees_is_noted_and_one_in_radians_is_not(tmp_path):
    turn = 0.12 * np.arange(200) - 3.0
    for yaw, unit in ((turn, 1.0), (wrap_angle(turn), 1.0), (turn, 57.3), (turn % (2 * np.pi), 57.3)):
        poses = np.column_stack([np.zeros((200, 2)), yaw * unit])
        np.savez(tmp_path / "a.npz", poses=poses, angles_rad=[0.0, 0.1], ranges_m=np.ones((200, 2)))
        notes = describe_log(tmp_path / "a.npz").notes
        assert [("is it in degrees?" in note) for note in notes] == [True] * (unit != 1.0)
