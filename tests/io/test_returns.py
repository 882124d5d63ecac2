import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bayesmap.errors import BadInput
from bayesmap.io.returns import Views, decode

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
    ranges, found = decode(readings)
    assert (found.code_m, found.origin, found.values_m) == (code, "found", (code,))
    np.testing.assert_array_equal(np.isposinf(ranges), coded)
    np.testing.assert_array_equal(ranges[~coded], readings[~coded])


@pytest.mark.parametrize("code", SENSOR_CODES)
def test_a_code_is_found_though_ranges_reach_up_to_it(code):
    readings, coded = a_log(code, 0.05, largest_m=code - 0.01)
    readings[0] = np.round(np.linspace(code - 3, code - 0.01, 90), 2)
    coded[0] = False
    ranges, found = decode(readings)
    assert found.code_m == code
    np.testing.assert_array_equal(np.isposinf(ranges), coded)


def test_rarer_codes_above_the_usual_one_are_no_return_too():
    readings, _ = a_log(81.83, 0.05, largest_m=25.0)
    readings[3, 4], readings[5, 6] = 81.91, 81.87
    ranges, found = decode(readings)
    assert (found.code_m, found.values_m) == (81.83, (81.83, 81.87, 81.91))
    assert np.isposinf(ranges[[3, 5], [4, 6]]).all()


@given(st.integers(0, 10_000), st.floats(2.0, 60.0))
def test_a_log_without_a_code_keeps_all_its_ranges(seed, largest_m):
    readings, _ = a_log(0.0, 0.0, largest_m, seed=seed)
    ranges, found = decode(readings)
    assert (found.code_m, found.origin) == (None, "none")
    np.testing.assert_array_equal(ranges, readings)


def test_a_distance_met_again_and_again_is_no_code_while_others_are_longer_or_the_robot_stands():
    readings, _ = a_log(0.0, 0.0, largest_m=20.0)
    readings[:, 40:50] = 0.9 * readings.max()
    _, found = decode(readings)
    assert found.code_m is None
    scan = np.round(np.random.default_rng(0).uniform(1, 5, 180), 2)
    scan[90:92] = 23.5  # seen through a door, by the same two beams in every scan
    _, found = decode(np.tile(scan, (200, 1)))
    assert found.code_m is None


def seen(distances_m, poses, code=None, noise_m=0.0, directions=()):
    """Decode a log of centimetres whose beams see, in directions of the world (degrees), so many metres far."""
    rng = np.random.default_rng(1)
    angles = np.radians(np.arange(-180, 180))
    world = np.degrees(poses[:, 2:] + angles)
    at = np.rint(world).astype(int) % 360
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
    ranges, found = seen(room, poses, noise_m=noise_m)
    assert found.code_m is None
    assert np.isfinite(ranges).all()


@pytest.mark.parametrize("poses", [STANDING, SPINNING])
def test_what_stands_out_in_one_direction_is_noted_and_a_code_in_many_is_found_though_the_robot_stands(poses):
    _, found = seen(a_room(metres=81.83), poses)
    assert "say --no-return 81.83" in found.notes()[0]
    assert seen(a_room(far=()), poses)[1].notes() == ()
    directions = [3, 50, 51, 52, 120, 200, 201, 330]
    ranges, found = seen(a_room(far=()), poses, code=81.83, directions=directions)
    assert (found.code_m, np.isposinf(ranges).sum()) == (81.83, len(directions) * len(poses))


def test_a_single_scan_shows_its_code_if_it_is_far_above_the_rest():
    scan = np.round(np.random.default_rng(0).uniform(1, 9, (1, 180)), 2)
    scan[0, [3, 70, 120]] = 81.83
    ranges, found = decode(scan)
    assert (found.code_m, np.isposinf(ranges).sum()) == (81.83, 3)


@pytest.mark.parametrize("code", [0.0, -1.0])
def test_zero_and_minus_one_are_codes_if_repeated_and_none_is_at_the_top(code):
    readings, coded = a_log(code, 0.02, largest_m=9.0)
    ranges, found = decode(readings)
    assert (found.code_m, found.origin) == (code, "found")
    np.testing.assert_array_equal(np.isposinf(ranges), coded)


@pytest.mark.parametrize(("share", "zeros"), [(0.02, 20), (0.0, 1)])
def test_beside_a_code_at_the_top_and_where_they_are_rare_zeros_are_invalid(share, zeros):
    readings, coded = a_log(81.83, share, largest_m=9.0)
    readings[0, :zeros] = 0.0
    ranges, found = decode(readings)
    assert found.code_m == (81.83 if share else None)
    assert np.isnan(ranges).sum() == np.isnan(ranges[0, :zeros]).sum() == zeros
    assert np.isposinf(ranges).sum() == coded[1:].sum() + coded[0, zeros:].sum()


@pytest.mark.parametrize(("given_code", "readings", "expected"), [
    (81.83, [5.0, 81.8299, 81.83, 81.91, 81.8], [5.0, np.inf, np.inf, np.inf, 81.8]),  # the precision of print
    (-1.0, [5.0, -1.0, 0.0], [5.0, np.inf, np.inf]),  # all numbers that are no range
    (np.inf, [5.0, 81.83, 81.83, 81.83], [5.0, 81.83, 81.83, 81.83]),  # the log has no code
])  # fmt: skip
def test_a_given_code_is_taken(given_code, readings, expected):
    ranges, found = decode(np.array([readings]), no_return=given_code)
    np.testing.assert_array_equal(ranges, [expected])
    assert found.code_m == (None if np.isinf(given_code) else given_code)


@pytest.mark.parametrize("given_code", [np.nan, -np.inf])
def test_a_given_code_must_be_a_number(given_code):
    with pytest.raises(BadInput, match="--no-return"):
        decode(np.ones((1, 3)), no_return=given_code)
