"""Beams that differ from scan to scan, in every format: each scan keeps its own."""

import math

import numpy as np
import pytest
import recordings as r

import bayesmap as bm
from bayesmap.io.live import live_scans
from bayesmap.io.logs import describe_log
from bayesmap.io.text.carmen import write_carmen
from bayesmap.space.planar import wrap_angle

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
    """Angles, readings and walls are those of the log, beam by beam."""
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
        fields = [*map(repr, map(float, [t, *pose, first, step, *row])), *[""] * (wide - beams)]
        rows.append(",".join(fields))
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
    messages, scans = r.robot()
    at = [i for i, m in enumerate(messages) if m[0] == "/scan"][4]
    topic, kind, t, message = messages[at]
    messages[at] = (topic, kind, t, {**message, "ranges": []})
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
    messages += [
        ("/tf", r.TF, t, r.tf(r.transform(t, "odom", "laser", t - 10.0, 0.0, 0.0))) for t in np.arange(9.9, 10.8, 0.05)
    ]
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
