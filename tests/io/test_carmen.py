"""CARMEN logs, and the readings by which logs say that nothing came back."""

import gzip
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogOptions
from bayesmap.io.logs import describe_log
from bayesmap.io.returns import Views, decode
from bayesmap.io.text.carmen import read_carmen, write_carmen
from bayesmap.space.scans import Scans

numbers = st.floats(-1e4, 1e4).map(lambda v: round(v, 6))
ranges = st.floats(0.01, 80).map(lambda v: round(v, 4))


def flaser(readings, pose=(0.0, 0.0, 0.0), robot=None, t=0.0, kind="FLASER"):
    words = [kind, len(readings), *readings, *pose, *(pose if robot is None else robot), t, "host", t]
    return " ".join(map(str, words)) + "\n"


def robotlaser(readings, pose=(0.0, 0.0, 0.0), t=0.0, first=-1.0, step=0.5, max_range=80.0, remissions=()):
    words = ["ROBOTLASER1", 0, first, step * (len(readings) - 1), step, max_range, 0.01, 0, len(readings), *readings]
    words += [len(remissions), *remissions, *pose, *pose, 0, 0, 0.3, 0.2, 0, t, "host", t]
    return " ".join(map(str, words)) + "\n"


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    path = tmp_path_factory.mktemp("carmen") / "robot.log"

    def write_and_read(text, **options):
        path.write_text(text)
        return read_carmen(path, LogOptions(**options))

    return write_and_read


@st.composite
def logs(draw):
    """Draw the ranges, poses and distinct times of a log."""
    n, beams = draw(st.integers(1, 6)), draw(st.integers(2, 8))
    times = draw(st.lists(numbers, min_size=n, max_size=n, unique=True))
    readings = draw(st.lists(st.lists(ranges, min_size=beams, max_size=beams), min_size=n, max_size=n))
    return readings, draw(st.lists(st.tuples(numbers, numbers, numbers), min_size=n, max_size=n)), times


@given(logs(), st.booleans(), st.data())
def test_lines_of_a_log_are_read_back_in_order_of_time(read, log, explicit, data):
    readings, poses, times = log
    lines = [(robotlaser if explicit else flaser)(r, p, t=t) for r, p, t in zip(readings, poses, times, strict=True)]
    lines += ["ODOM 0 0 0 0 0 0 1 host 1\n", "# a comment\n", "NEFF 3\n", "PARAM laser_on yes\n", "\n"]
    reading = read("".join(data.draw(st.permutations(lines))), no_return=np.inf)
    scans = reading.scans
    assert reading.messages == Counter({lines[0].split()[0]: len(times), "ODOM": 1, "NEFF": 1, "PARAM": 1})
    order = np.argsort(times)
    np.testing.assert_array_equal(scans.stamps_s, np.array(times)[order])
    np.testing.assert_array_equal(scans.ranges_m, np.array(readings)[order])
    np.testing.assert_array_equal(scans.poses, np.array(poses)[order])


@given(logs(), st.lists(st.text(alphabet="FLASERODM .0123456789-\t", min_size=1, max_size=30), max_size=4), st.data())
def test_bad_lines_among_good_ones_change_nothing_but_the_account(read, log, junk, data):
    good = [flaser(r, p, t=t) for r, p, t in zip(*log, strict=True)]
    bad = [f"FLASER 3 {line}x\n" for line in junk]  # never a whole message
    mixed = data.draw(st.permutations(good + bad))
    clean, reading = read("".join(good)), read("".join(mixed), skip_bad_lines=True)
    np.testing.assert_array_equal(reading.scans.ranges_m, clean.scans.ranges_m)
    assert [part.number for part in reading.skipped] == [k for k, line in enumerate(mixed, 1) if line in bad]
    if bad:
        first = 1 + min(mixed.index(line) for line in bad)
        with pytest.raises(BadInput, match=rf"robot\.log: line {first}: .*--skip-bad-lines"):
            read("".join(mixed))


@pytest.mark.parametrize(
    ("beams", "last_deg", "step_deg"),
    [(180, 89, 1), (181, 90, 1), (360, 89.5, 0.5), (361, 90, 0.5), (400, 9.75, 0.25), (401, 10, 0.25), (7, 90, 30)],
)
def test_angles_of_flaser_follow_from_the_number_of_beams(read, beams, last_deg, step_deg):
    reading = read(flaser([1.0] * beams))
    angles = np.degrees(reading.scans.angles_rad)
    assert len(angles) == beams
    assert (reading.notes == ()) == (beams in (180, 181, 360, 361)), "angles that the log does not say are noted"
    np.testing.assert_allclose(angles[[0, -1]], [-90, last_deg], atol=1e-9)
    np.testing.assert_allclose(np.diff(angles), step_deg, atol=1e-9)


def test_lines_state_angles_largest_range_and_the_laser_s_pose_and_its_offset_is_reported(read):
    text = robotlaser([1.0, 50.0, 51.2], (1.0, 2.0, 0.5), first=-0.2, step=0.2, max_range=50.0, remissions=(7, 8))
    reading = read(text)
    np.testing.assert_allclose(reading.scans.angles_rad, [-0.2, 0.0, 0.2], atol=1e-12)
    np.testing.assert_array_equal(reading.scans.poses, [[1.0, 2.0, 0.5]])
    np.testing.assert_array_equal(reading.scans.ranges_m, [[1.0, np.inf, np.inf]])
    assert (reading.message, reading.no_return.origin, reading.no_return.code_m) == ("ROBOTLASER1", "message", 50.0)
    robot, offset = np.array([2.0, 1.0, np.pi / 2]), 0.3
    laser = (2.0, 1.0 + offset, np.pi / 2)  # 0.3 m ahead of a robot that looks along +y
    reading = read(flaser([1.0, 2.0], laser, robot))
    np.testing.assert_array_equal(reading.scans.poses, [laser])
    np.testing.assert_allclose(reading.scans.mount, [offset, 0, 0], atol=1e-12)


def test_the_laser_with_more_scans_is_read_and_the_other_noted(read):
    front = [flaser([1.0, 2.0], t=t) for t in range(2)]
    rear = [flaser([3.0, 4.0], t=t, kind="RLASER") for t in range(3)]
    reading = read("".join(front + rear))
    assert (reading.message, len(reading.scans)) == ("RLASER", 3)
    assert reading.notes[0].startswith("the log also holds 2 FLASER scans, which were not used")
    assert read("".join(front + rear[:2])).message == "FLASER"


def test_gzip_is_recognised_by_content_whatever_the_name(tmp_path):
    text = "".join(flaser([1.0, 2.0], t=t) for t in range(3)).encode()
    packed = gzip.compress(text)
    for name, content, scans in (("a.log", packed, 3), ("plain.gz", text, 3), ("joined", packed + packed, 6)):
        (tmp_path / name).write_bytes(content)
        assert len(read_carmen(tmp_path / name, LogOptions()).scans) == scans


def test_codes_of_ros_keep_their_meaning_and_the_maximum_range_is_the_largest_hit_rounded_up_unless_given(read):
    scans = read(flaser(["nan", "inf", "-inf", 1.0])).scans
    assert scans.counts() == {"hit": 1, "no_return": 1, "too_close": 1, "invalid": 1}
    text = flaser([3.2, 7.01, 5.0])
    assert (read(text).scans.max_range_m, read(text).max_range_origin) == (8.0, "readings")
    limited = read(text, max_range_m=6.0)
    np.testing.assert_array_equal(limited.scans.ranges_m, [[3.2, np.inf, 5.0]])
    assert (limited.scans.max_range_m, limited.max_range_origin) == (6.0, "given")


def test_lines_that_are_too_long_are_refused(read):
    with pytest.raises(BadInput, match="line 2 is over 1,048,576 bytes"):
        read(flaser([1.0, 2.0]) + "X" * 3_000_000)


def some_scans(beams: int, first_deg: float, step_deg: float, no_returns: int = 0, scans: int = 5) -> Scans:
    rng = np.random.default_rng(beams + no_returns)
    ranges = np.round(rng.uniform(0.5, 9.5, (scans, beams)), 4)
    ranges.ravel()[rng.choice(ranges.size, no_returns, replace=False)] = np.inf
    poses = np.round(rng.uniform(-5, 5, (scans, 3)), 6)
    return Scans(poses, np.radians(first_deg + step_deg * np.arange(beams)), ranges, 10.0)


@pytest.mark.parametrize(("beams", "first_deg", "step_deg", "no_returns", "kind"), [
    (180, -90, 1.0, 0, "FLASER"), (361, -90, 0.5, 40, "FLASER"),
    (180, -90, 1.0, 1, "ROBOTLASER1"),  # a single no-return would be taken for a wall far away
    (180, -180, 2.0, 0, "ROBOTLASER1"), (100, 0, 3.6, 40, "ROBOTLASER1"), (2, -10, 20.0, 1, "ROBOTLASER1"),
])  # fmt: skip
@pytest.mark.parametrize("name", ["scans.log", "scans.log.gz"])
def test_scans_are_read_back_as_they_were_written(tmp_path, beams, first_deg, step_deg, no_returns, kind, name):
    scans = some_scans(beams, first_deg, step_deg, no_returns)
    path = tmp_path / name
    assert write_carmen(path, scans) == kind
    content = path.read_bytes()
    assert content.startswith(b"\x1f\x8b" if name.endswith(".gz") else b"# CARMEN")
    write_carmen(path, scans)
    assert path.read_bytes() == content, "the same scans give the same bytes"
    reading = describe_log(path)
    assert reading.message == kind
    np.testing.assert_array_equal(reading.scans.ranges_m, scans.ranges_m)
    np.testing.assert_allclose(reading.scans.angles_rad, scans.angles_rad, atol=1e-9)
    np.testing.assert_array_equal(reading.scans.poses, scans.poses)


@given(st.lists(st.sampled_from([np.inf, -np.inf, np.nan, 1.25, 9.0, 29.5]), min_size=180, max_size=180))
def test_no_reading_becomes_another_hit(tmp_path_factory, readings):
    path = tmp_path_factory.mktemp("log") / "one.log"
    write_carmen(path, Scans(np.zeros(3), np.radians(np.arange(180) - 90.0), np.array(readings), 30.0))
    back = describe_log(path, max_range_m=30.0).scans.ranges_m[0]
    given_ranges = np.array(readings)
    np.testing.assert_array_equal(np.isfinite(back), np.isfinite(given_ranges))
    np.testing.assert_array_equal(np.isposinf(back), np.isposinf(given_ranges))


@pytest.mark.parametrize("angles", [[0.0], [0.0, 0.1, 0.3], [0.1, 0.0]])
def test_angles_that_no_message_can_say_are_refused(tmp_path, angles):
    with pytest.raises(BadInput, match="log:"):
        write_carmen(tmp_path / "x.log", Scans(np.zeros(3), np.array(angles), np.ones(len(angles)), 10.0))
    assert list(tmp_path.iterdir()) == []


SENSOR_CODES = [81.83, 81.91, 50.0, 51.15, 32.76]


def a_log(code, share, largest_m, scans=60, beams=90, seed=0):
    """Readings in centimetres up to largest_m, a share of them replaced by a code; and where."""
    rng = np.random.default_rng(seed)
    ranges = np.round(0.2 + (largest_m - 0.2) * rng.beta(1.5, 4.0, (scans, beams)), 2)
    coded = rng.random(ranges.shape) < share
    return np.where(coded, code, ranges), coded


@pytest.mark.parametrize("code", SENSOR_CODES)
@pytest.mark.parametrize("share", [0.005, 0.05, 0.6])
def test_codes_of_real_sensors_are_found(code, share):
    readings, coded = a_log(code, share, largest_m=25.0)
    ranges, no_return = decode(readings)
    assert (no_return.code_m, no_return.origin, no_return.values_m) == (code, "found", (code,))
    np.testing.assert_array_equal(np.isposinf(ranges), coded)
    np.testing.assert_array_equal(ranges[~coded], readings[~coded])


@pytest.mark.parametrize("code", SENSOR_CODES)
def test_a_code_is_found_though_ranges_reach_up_to_it(code):
    readings, coded = a_log(code, 0.05, largest_m=code - 0.01)
    readings[0] = np.round(np.linspace(code - 3, code - 0.01, 90), 2)
    coded[0] = False
    ranges, no_return = decode(readings)
    assert no_return.code_m == code
    np.testing.assert_array_equal(np.isposinf(ranges), coded)


def test_rarer_codes_above_the_usual_one_are_no_return_too():
    readings, _ = a_log(81.83, 0.05, largest_m=25.0)
    readings[3, 4], readings[5, 6] = 81.91, 81.87
    ranges, no_return = decode(readings)
    assert (no_return.code_m, no_return.values_m) == (81.83, (81.83, 81.87, 81.91))
    assert np.isposinf(ranges[[3, 5], [4, 6]]).all()


@given(st.integers(0, 10_000), st.floats(2.0, 60.0))
def test_a_log_without_a_code_keeps_all_its_ranges(seed, largest_m):
    readings, _ = a_log(0.0, 0.0, largest_m, seed=seed)
    ranges, no_return = decode(readings)
    assert (no_return.code_m, no_return.origin) == (None, "none")
    np.testing.assert_array_equal(ranges, readings)


def test_a_distance_met_again_and_again_is_no_code_while_others_are_longer_or_the_robot_stands():
    readings, _ = a_log(0.0, 0.0, largest_m=20.0)
    readings[:, 40:50] = 0.9 * readings.max()
    _, no_return = decode(readings)
    assert no_return.code_m is None
    scan = np.round(np.random.default_rng(0).uniform(1, 5, 180), 2)
    scan[90:92] = 23.5  # seen through a door, by the same two beams in every scan
    _, no_return = decode(np.tile(scan, (200, 1)))
    assert no_return.code_m is None


def seen(distances_m, poses, code=None, noise_m=0.0, directions=()):
    """Decode a log of centimetres whose beams see, in directions of the world (degrees), so many metres far."""
    rng = np.random.default_rng(1)
    angles = np.radians(np.arange(-180, 180))
    at = np.rint(np.degrees(poses[:, 2:] + angles)).astype(int) % 360
    readings = np.round(distances_m[at] + rng.normal(0, noise_m, at.shape) * (rng.random(at.shape) < 0.3), 2)
    if code is not None:
        readings[np.isin(at, directions)] = code
    return decode(readings, views=Views.of(poses, angles))


def a_room(far=(88, 89, 90, 91, 92), metres=8.5):
    distances = np.round(np.random.default_rng(0).uniform(1, 5.5, 360), 2)
    distances[list(far)] = metres
    return distances


STANDING = np.tile([1.0, 2.0, 0.3], (40, 1))
SPINNING = np.column_stack([np.tile([1.0, 2.0], (40, 1)), np.radians(np.arange(40) * 9.0)])


@pytest.mark.parametrize("poses", [STANDING, SPINNING])
@pytest.mark.parametrize("noise_m", [0.0, 0.01])
@pytest.mark.parametrize("room", [a_room(), a_room(metres=25.0), a_room(far=range(70, 100)), a_room(far=(89, 90, 270))])
def test_a_robot_that_stands_or_turns_on_the_spot_before_a_far_wall_makes_no_code(poses, noise_m, room):
    ranges, no_return = seen(room, poses, noise_m=noise_m)
    assert no_return.code_m is None
    assert np.isfinite(ranges).all()


@pytest.mark.parametrize("poses", [STANDING, SPINNING])
def test_a_range_that_stands_out_in_one_direction_is_noted_and_a_code_in_many_is_found(poses):
    _, no_return = seen(a_room(metres=81.83), poses)
    assert "say --no-return 81.83" in no_return.notes()[0]
    assert seen(a_room(far=()), poses)[1].notes() == ()
    directions = [3, 50, 51, 52, 120, 200, 201, 330]
    ranges, no_return = seen(a_room(far=()), poses, code=81.83, directions=directions)
    assert (no_return.code_m, np.isposinf(ranges).sum()) == (81.83, len(directions) * len(poses))


def test_a_single_scan_shows_its_code_if_it_is_far_above_the_rest():
    scan = np.round(np.random.default_rng(0).uniform(1, 9, (1, 180)), 2)
    scan[0, [3, 70, 120]] = 81.83
    ranges, no_return = decode(scan)
    assert (no_return.code_m, np.isposinf(ranges).sum()) == (81.83, 3)


@pytest.mark.parametrize("code", [0.0, -1.0])
def test_zero_and_minus_one_are_codes_if_repeated_and_none_is_at_the_top(code):
    readings, coded = a_log(code, 0.02, largest_m=9.0)
    ranges, no_return = decode(readings)
    assert (no_return.code_m, no_return.origin) == (code, "found")
    np.testing.assert_array_equal(np.isposinf(ranges), coded)


@pytest.mark.parametrize(("share", "zeros"), [(0.02, 20), (0.0, 1)])
def test_zeros_are_invalid_if_rare_or_beside_a_code_at_the_top(share, zeros):
    readings, coded = a_log(81.83, share, largest_m=9.0)
    readings[0, :zeros] = 0.0
    ranges, no_return = decode(readings)
    assert no_return.code_m == (81.83 if share else None)
    assert np.isnan(ranges).sum() == np.isnan(ranges[0, :zeros]).sum() == zeros
    assert np.isposinf(ranges).sum() == coded[1:].sum() + coded[0, zeros:].sum()


@pytest.mark.parametrize(("given_code", "readings", "expected"), [
    (81.83, [5.0, 81.8299, 81.83, 81.91, 81.8], [5.0, np.inf, np.inf, np.inf, 81.8]),  # the precision of print
    (-1.0, [5.0, -1.0, 0.0], [5.0, np.inf, np.inf]),  # all numbers that are no range
    (np.inf, [5.0, 81.83, 81.83, 81.83], [5.0, 81.83, 81.83, 81.83]),  # the log has no code
])  # fmt: skip
def test_a_given_code_is_taken(given_code, readings, expected):
    ranges, no_return = decode(np.array([readings]), no_return=given_code)
    np.testing.assert_array_equal(ranges, [expected])
    assert no_return.code_m == (None if np.isinf(given_code) else given_code)


@pytest.mark.parametrize("given_code", [np.nan, -np.inf])
def test_a_given_code_must_be_a_number(given_code):
    with pytest.raises(BadInput, match="--no-return"):
        decode(np.ones((1, 3)), no_return=given_code)
