"""What is written is what is read back."""

import gzip

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bayesmap.errors import BadInput
from bayesmap.io.logs import describe_log
from bayesmap.io.text.carmen import write_carmen
from bayesmap.space.scans import Scans


def some_scans(beams: int, first_deg: float, step_deg: float, no_returns: int = 0, scans: int = 5) -> Scans:
    rng = np.random.default_rng(beams + no_returns)
    ranges = np.round(rng.uniform(0.5, 9.5, (scans, beams)), 4)
    ranges.ravel()[rng.choice(ranges.size, no_returns, replace=False)] = np.inf
    poses = np.round(rng.uniform(-5, 5, (scans, 3)), 6)
    return Scans(poses, np.radians(first_deg + step_deg * np.arange(beams)), ranges, 10.0)


@pytest.mark.parametrize(
    ("beams", "first_deg", "step_deg", "no_returns", "kind"),
    [
        (180, -90, 1.0, 0, "FLASER"),
        (181, -90, 1.0, 40, "FLASER"),
        (360, -90, 0.5, 40, "FLASER"),
        (361, -90, 0.5, 0, "FLASER"),
        (180, -90, 1.0, 1, "ROBOTLASER1"),  # a single no-return would be taken for a wall far away
        (180, -180, 2.0, 0, "ROBOTLASER1"),
        (100, 0, 3.6, 40, "ROBOTLASER1"),
        (2, -10, 20.0, 1, "ROBOTLASER1"),
    ],
)
@pytest.mark.parametrize("name", ["scans.log", "scans.log.gz"])
def test_scans_are_read_back_as_they_were_written(tmp_path, beams, first_deg, step_deg, no_returns, kind, name):
    scans = some_scans(beams, first_deg, step_deg, no_returns)
    path = tmp_path / name
    assert write_carmen(path, scans) == kind
    assert path.read_bytes().startswith(b"\x1f\x8b") == name.endswith(".gz")
    reading = describe_log(path)
    assert reading.message == kind
    np.testing.assert_array_equal(reading.scans.ranges_m, scans.ranges_m)
    np.testing.assert_allclose(reading.scans.angles_rad, scans.angles_rad, atol=1e-9)
    np.testing.assert_array_equal(reading.scans.poses, scans.poses)


@given(st.lists(st.sampled_from([np.inf, -np.inf, np.nan, 1.25, 9.0, 29.5]), min_size=180, max_size=180))
def test_no_reading_becomes_another_hit(tmp_path_factory, readings):
    scans = Scans(np.zeros(3), np.radians(np.arange(180) - 90.0), np.array(readings), 30.0)
    path = tmp_path_factory.mktemp("log") / "one.log"
    write_carmen(path, scans)
    back = describe_log(path, max_range_m=30.0).scans.ranges_m[0]
    given_ranges = np.array(readings)
    np.testing.assert_array_equal(np.isfinite(back), np.isfinite(given_ranges))
    np.testing.assert_array_equal(np.isposinf(back), np.isposinf(given_ranges))


def test_the_same_scans_give_the_same_bytes(tmp_path):
    scans = some_scans(180, -90, 1.0)
    for name in ("a.log.gz", "b.log.gz"):
        write_carmen(tmp_path / name, scans)
    assert (tmp_path / "a.log.gz").read_bytes() == (tmp_path / "b.log.gz").read_bytes()
    assert gzip.decompress((tmp_path / "a.log.gz").read_bytes()).startswith(b"# CARMEN")


@pytest.mark.parametrize("angles", [[0.0], [0.0, 0.1, 0.3], [0.1, 0.0]])
def test_angles_that_no_message_can_say_are_refused(tmp_path, angles):
    scans = Scans(np.zeros(3), np.array(angles), np.ones(len(angles)), 10.0)
    with pytest.raises(BadInput, match="log:"):
        write_carmen(tmp_path / "x.log", scans)
    assert list(tmp_path.iterdir()) == []
