"""Recordings with several robots, several publishers, or a clock that starts again; rigid motions over time."""

import math
from functools import partial

import numpy as np
import pytest
import recordings as r
from scipy.spatial.transform import RigidTransform, Rotation

from bayesmap.io.contents import contents_of
from bayesmap.io.logs import describe_log
from bayesmap.io.ros.frames import Samples, Track
from bayesmap.io.ros.publishers import find_contradiction


def way(number):
    """Return the path of robot 1, 2 or 3, far from the others."""
    return lambda seconds: r.path_of(seconds) + np.array([0.4, -0.7, 0.5]) * number


def mount(number):
    return (0.1 * number, 0.05, 0.4 * number)


def fleet(**options):
    """Return three robots with equal times, and their scans as they were simulated."""
    return [r.robot(path=way(n), mount=mount(n), **{k: v.format(n) for k, v in options.items()}) for n in (1, 2, 3)]


same = partial(r.same, timed=False)


def test_robots_with_transforms_of_their_own_are_read_by_these(tmp_path):
    robots = fleet(space="/robot{}")
    file = r.written(tmp_path, r.merged(*(messages for messages, _ in robots)))
    for n, (_, scans) in enumerate(robots, 1):
        reading = describe_log(file, scan_topic=f"/robot{n}/scan")
        same(reading.scans, scans)
        assert reading.pose_source == f"/robot{n}/tf"
        assert len(reading.notes) == 1
        assert "transforms of other namespaces were not used" in reading.notes[0]
        chosen = describe_log(file, scan_topic=f"/robot{n}/scan", pose_topic=f"/robot{n}/tf")
        same(chosen.scans, scans)
        assert chosen.notes == ()


def test_transforms_of_all_robots_on_one_topic_with_names_of_their_own(tmp_path):
    robots = fleet(space="/robot{}", tf_space="", prefix="robot{}/")
    messages = [m for part, _ in robots for m in part]
    for n in (1, 2, 3):  # the world sees robot 1's map move, as its localization corrects it
        for t in r.POSE_TIMES:
            moved = (0.3 * t, 0.1 * t, 0.2 * t) if n == 1 else (0.0, 0.0, 0.0)
            messages.append(("/tf", r.TF, t, r.tf(r.transform(t, "world", f"robot{n}/map", *moved))))
    file = r.written(tmp_path, r.merged(messages))
    for n, (_, scans) in enumerate(robots, 1):
        reading = describe_log(file, scan_topic=f"/robot{n}/scan")
        assert reading.fixed_frame == f"robot{n}/map"
        same(reading.scans, scans)
        assert reading.notes == ()
    same(describe_log(file, scan_topic="/robot3/scan", fixed_frame="world").scans, robots[2][1])
    other = describe_log(file, scan_topic="/robot3/scan", fixed_frame="robot1/map")
    assert any("the frame 'robot1/map' is not over that of the scans" in note for note in other.notes)


def test_the_nearest_of_two_maps_over_the_sensor_is_taken(tmp_path):
    messages, scans = r.robot()
    messages += [("/tf", r.TF, t, r.tf(r.transform(t, "site/map", "map", 0.5 * t, 0.0, 0.0))) for t in r.POSE_TIMES]
    reading = describe_log(r.written(tmp_path, r.merged(messages)))
    assert reading.fixed_frame == "map"
    same(reading.scans, scans)


def test_namespaces_of_transforms_that_scans_have_not_are_to_be_chosen_from(tmp_path):
    robots = [r.robot(path=way(n), mount=mount(n), space=f"/laser{n}", tf_space=f"/robot{n}") for n in (1, 2)]
    file = r.written(tmp_path / "two", r.merged(*(messages for messages, _ in robots)))
    parts = ("differs between topics: /robot1/tf", "choose one with --pose-topic: /robot1/tf", "/robot2/tf (tf2_msgs")
    r.refused(file, *parts, scan_topic="/laser2/scan")
    same(describe_log(file, scan_topic="/laser2/scan", pose_topic="/robot2/tf").scans, robots[1][1])
    alone = describe_log(r.written(tmp_path / "one", robots[0][0]))
    same(alone.scans, robots[0][1])
    assert "transforms were taken from /robot1/tf" in alone.notes[0]


def test_a_map_of_the_whole_fleet_is_found_beside_each_robot_s_transforms(tmp_path):
    robots = fleet(space="/robot{}", prefix="robot{}_")
    messages = [m for part, _ in robots for m in part]
    tops = [r.transform(0.0, "map", f"robot{n}_map", 1, 2, 0.3) for n in (1, 2, 3)]
    messages += [("/tf_static", r.TF, 0.0, r.tf(top)) for top in tops]
    file = r.written(tmp_path, r.merged(messages))
    for n, (_, scans) in enumerate(robots, 1):
        reading = describe_log(file, scan_topic=f"/robot{n}/scan")
        assert reading.fixed_frame == "map"
        cos, sin = math.cos(-0.3), math.sin(-0.3)
        same(reading.scans, scans, frame=(-(cos * 1 - sin * 2), -(sin * 1 + cos * 2), -0.3))


def test_odometry_of_the_scans_namespace_is_taken_where_there_are_no_transforms(tmp_path):
    robots = [r.robot(False, True, path=way(n), mount=mount(n), space=f"/robot{n}") for n in (1, 2)]
    file = r.written(tmp_path, r.merged(*(messages for messages, _ in robots)))
    for n, (_, scans) in enumerate(robots, 1):
        reading = describe_log(file, scan_topic=f"/robot{n}/scan")
        same(reading.scans, scans)
        assert f"/robot{n}/odom, the only topic of poses in the namespace" in reading.notes[0]


def test_a_topic_that_tells_other_transforms_is_to_be_chosen_from(tmp_path):
    messages, scans = r.robot()
    others = [("/tf_other", *m[1:]) for m in r.robot(path=way(1), late=0.01)[0] if m[0] == "/tf"]
    file = r.written(tmp_path, r.merged(messages, others))
    choice = "choose one with --pose-topic: /tf (tf2_msgs/msg/TFMessage, 42 messages), /tf_other ("
    r.refused(file, "the transform odom -> base_link differs between topics: /tf says x ", choice)
    same(describe_log(file, pose_topic="/tf").scans, scans)
    assert [source["name"] for source in contents_of(file).pose_sources] == ["/tf", "/tf_other"]
    assert "tf_static" not in r.refused(file, "there is no such topic; poses are on /tf (", pose_topic="/nothing")


def mounts(topic, *values, **angles):
    stamped = [(0.1 * i, value) for i, value in enumerate(values)]
    return [(topic, r.TF, t, r.tf(r.transform(t, "base_link", "laser", *v, **angles))) for t, v in stamped]


def test_a_static_transform_may_be_repeated(tmp_path):
    messages, scans = r.robot(static=False)
    again = mounts("/tf_static", *[r.MOUNT] * 4)
    rotation = again[2][3]["transforms"][0]["transform"]["rotation"]
    rotation.update({axis: -value for axis, value in rotation.items()})  # the same rotation
    reading = describe_log(r.written(tmp_path, r.merged(messages, again, mounts("/tf", *[r.MOUNT] * 3))))
    same(reading.scans, scans)
    assert reading.notes == ()


@pytest.mark.parametrize("other", [(0.2, -0.1, 0.3 + math.pi), (0.2, -0.05, 0.3), (0.2, -0.1, 0.302)])
def test_a_static_transform_with_two_values_is_noted_with_both(tmp_path, other):
    messages, _ = r.robot(static=False)
    reading = describe_log(r.written(tmp_path, r.merged(messages, mounts("/tf_static", other, r.MOUNT))))
    (note,) = reading.notes
    assert note.startswith("the transform base_link -> laser has two values on /tf_static that differ: x 0.2 m, y ")
    assert "yaw 17.19 degrees (1 x); the last was used, x 0.2 m, y -0.1 m, yaw 17.19 degrees" in note
    np.testing.assert_allclose(reading.scans.mount, r.MOUNT, atol=1e-9)


def test_a_sensor_that_is_upside_down_by_one_publisher_only_is_noted(tmp_path):
    messages, _ = r.robot()
    reading = describe_log(r.written(tmp_path, r.merged(messages, mounts("/tf_static", r.MOUNT, roll=math.pi))))
    assert any("has two values on /tf_static" in note and "roll" in note for note in reading.notes)


@pytest.mark.parametrize("moving", [False, True])
def test_a_transform_that_is_static_and_not_is_to_be_chosen(tmp_path, moving):
    messages, scans = r.robot()
    still = r.transform(0.0, "odom", "base_link", 1.0, 2.0, 0.5) if moving else r.transform(0.0, "map", "odom", 1, 2, 0)
    file = r.written(tmp_path, r.merged([("/tf_static", r.TF, 0.0, r.tf(still))], messages))
    joint = "odom -> base_link" if moving else "map -> odom"
    r.refused(file, f"the transform {joint} differs between topics", "/tf_static says x 1 m, y 2 m", "--pose-topic: ")
    same(describe_log(file, pose_topic="/tf").scans, scans)


@pytest.mark.parametrize("late", [0.0, 0.1])
@pytest.mark.parametrize("away", [(0.05, 0.0, 0.0), (1.0, -2.0, 0.7), (0.0, 0.0, math.pi)])
def test_two_publishers_of_odometry_are_refused_with_both_values(tmp_path, late, away):
    messages, scans = r.robot(odom=True)
    others = [m for m in r.robot(path=lambda t: r.path_of(t) + away, late=late)[0] if m[0] == "/tf"]
    others = [m for m in others if m[3]["transforms"][0]["child_frame_id"] == "base_link"]
    file = r.written(tmp_path, r.merged(messages, others))
    fault = "the transform odom -> base_link on /tf goes to and fro between values that differ: at "
    message = r.refused(file, fault, "two publishers", "--pose-topic: /odom")
    same(describe_log(file, pose_topic="/odom").scans, scans)
    told = contents_of(file)
    assert told.suggestion.endswith("--pose-topic /odom")
    reason = message.split(";")[0].split(": ", 1)[1]
    assert f"poses are from /odom: without --pose-topic, {reason}" in told.sensors[0]["notes"]


def test_two_publishers_of_the_map_leave_the_odometry_and_two_of_poses_are_refused(tmp_path):
    messages, _ = r.robot()
    others = [("/tf", r.TF, t + 0.1, r.tf(r.transform(t + 0.1, "map", "odom", 1.0, 1.0, 0.0))) for t in r.POSE_TIMES]
    file = r.written(tmp_path, r.merged(messages, others))
    assert "map in a frame below it with --fixed-frame odom" in r.refused(file)
    assert describe_log(file, fixed_frame="odom").fixed_frame == "odom"
    messages, _ = r.robot(tf_poses=False, odom=True)
    others = [m for m in r.robot(tf_poses=False, odom=True, path=way(1), late=0.1)[0] if m[0] == "/odom"]
    r.refused(r.written(tmp_path / "other", r.merged(messages, others)), "odom -> base_link on /odom goes to and fro")


def a_track(rng, samples, noise, late_s=0.0, away=(0.0, 0.0, 0.0)):
    """Return odometry at about 10 Hz with turns, stops and jumps; noise in metres and radians."""
    t = 0.1 * np.arange(samples) + rng.uniform(0, 0.02, samples)
    speed = np.repeat(rng.choice([0.0, 0.3, 1.0], samples // 10 + 1), 10)[:samples]
    yaw = np.cumsum(0.1 * np.repeat(rng.choice([0.0, -0.5, 0.8], samples // 10 + 1), 10)[:samples])
    x, y = np.cumsum(0.1 * speed * np.cos(yaw)), np.cumsum(0.1 * speed * np.sin(yaw))
    x[samples // 2 :] += 0.7  # found its place again
    x, y, yaw = (np.interp(t, 0.1 * np.arange(samples), v) for v in (x, y, yaw))
    x, y, yaw = (v + rng.normal(0, noise, samples) + d for v, d in zip((x, y, yaw), away, strict=True))
    part = Samples(topic="/tf")
    for i in range(samples):
        stamp = round((t[i] + late_s + 1) * 1e9)
        part.add(stamp, stamp, (x[i], y[i], 0.0, 0.0, 0.0, math.sin(yaw[i] / 2), math.cos(yaw[i] / 2)))
    return part


@pytest.mark.parametrize("noise", [0.0, 0.001, 0.03])
def test_one_noisy_publisher_is_not_taken_for_two_and_two_are(noise):
    rng = np.random.default_rng(5)
    for _ in range(30):
        assert find_contradiction("odom", "base_link", [a_track(rng, int(rng.integers(10, 300)), noise)]) is None
    found = 0
    for seed in range(20):
        one = a_track(np.random.default_rng(seed), 150, 0.1 * noise)
        other = a_track(np.random.default_rng(seed), 150, 0.1 * noise, 0.05, (0.3, 0.4, 0.1))
        found += find_contradiction("odom", "base_link", [Samples.joined([one, other])]) is not None
    assert found == 20


def run_of(number, seconds, **options):
    """A run of the simulated robot on a path of its own, received from a time on, and its scans."""
    messages, scans = r.robot(path=way(number), **options)
    return [(topic, kind, t + seconds, message) for topic, kind, t, message in messages], scans


@pytest.mark.parametrize("writer", ["mcap", "db3", "rosbag1"])
@pytest.mark.parametrize("runs", [2, 3])
def test_a_clock_that_starts_again_keeps_the_runs_apart(tmp_path, writer, runs):
    parts = [run_of(n, 100.0 + 7.0 * n) for n in range(runs)]
    reading = describe_log(r.written(tmp_path, r.merged(*(messages for messages, _ in parts)), writer))
    assert len(reading.scans) == 10 * runs
    for n, (_, scans) in enumerate(parts):
        same(reading.scans.select(np.arange(10 * n, 10 * n + 10)), scans)
    assert (np.diff(reading.scans.stamps_s) > 0).all()
    np.testing.assert_allclose(reading.scans.stamps_s[10:20] - reading.scans.stamps_s[:10], 7.0, atol=1e-6)
    assert sum("the clock goes back by" in note for note in reading.notes) == runs - 1
    assert reading.reordered == 0


@pytest.mark.parametrize("sources", [(True, False), (False, True)])
def test_a_clock_that_starts_again_on_the_way_with_transforms_between_the_scans(tmp_path, sources):
    first, scans = run_of(1, 100.0, tf_poses=sources[0], odom=sources[1])
    second, others = run_of(2, 103.0, tf_poses=sources[0], odom=sources[1])
    first = [m for m in first if m[2] <= 103.0]  # the first run is cut off by the second
    reading = describe_log(r.written(tmp_path, r.merged(first, second)))
    kept = len(reading.scans) - 10
    assert 4 <= kept <= 7
    same(reading.scans.select(np.arange(kept)), scans.select(np.arange(kept)))
    same(reading.scans.select(np.arange(kept, kept + 10)), others)


def test_a_clock_that_starts_again_while_messages_are_on_their_way(tmp_path):
    """A few messages of the first run are received after the second run's first."""
    first, scans = run_of(1, 100.0)
    second, others = run_of(2, 105.2)
    last = max(m[2] for m in first if m[0] == "/scan")
    first = [(*m[:2], 105.25, m[3]) if m[2] == last else m for m in first]
    reading = describe_log(r.written(tmp_path, r.merged(first, second)))
    same(reading.scans.select(np.arange(10)), scans)
    same(reading.scans.select(np.arange(10, 20)), others)


def test_a_run_without_poses_is_left_out_and_a_clock_that_starts_again_for_the_recorder_too_is_refused(tmp_path):
    first, scans = run_of(1, 100.0)
    reading = describe_log(r.written(tmp_path, r.merged(first, [m for m in run_of(2, 107.0)[0] if m[0] == "/scan"])))
    same(reading.scans, scans)
    assert any("one run of the clock was left out: " in note for note in reading.notes)
    parts = [r.robot(path=way(n), late=0.01 * n)[0] for n in (1, 2)]
    assert "or the clock of the recording started again" in r.refused(r.written(tmp_path / "other", r.merged(*parts)))


def some(seed, count=20):
    rng = np.random.default_rng(seed)
    return RigidTransform.from_components(rng.normal(size=(count, 3)), Rotation.random(count, rng))


def test_a_track_goes_through_its_poses_and_straight_between():
    motions, start = some(5, 4), 1_700_000_000_000_000_000
    track = Track(start + np.array([0, 10, 30, 40]), motions)
    np.testing.assert_allclose(track.at(track.stamps_ns).as_matrix(), motions.as_matrix(), atol=1e-12)
    outside = track.at(start + np.array([-5, 45]))
    np.testing.assert_allclose(outside.as_matrix(), motions[[0, 3]].as_matrix(), atol=1e-12)
    halfway = track.at(start + np.array([20]))
    np.testing.assert_allclose(halfway.translation[0], (motions.translation[1] + motions.translation[2]) / 2)
    turn = motions.rotation[1].inv() * motions.rotation[2]
    half = motions.rotation[1] * Rotation.from_rotvec(turn.as_rotvec() / 2)
    np.testing.assert_allclose(halfway.rotation[0].as_matrix(), half.as_matrix(), atol=1e-12)
    np.testing.assert_array_equal(track.covers(start + np.array([-1, 0, 40, 41])), [False, True, True, False])
    alone = Track(start + np.array([10]), motions[:1]).at(track.stamps_ns)
    np.testing.assert_allclose(alone.as_matrix(), np.tile(motions[0].as_matrix(), (4, 1, 1)))
