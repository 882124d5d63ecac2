"""Logs of the corpus: what is read, refused and left out on request; thinning, and poses that jump."""

import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from data import intel_log
from hypothesis import given
from hypothesis import strategies as st
from recordings import read_or_refused

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.io.logs import describe_log, read_log
from bayesmap.space.time_order import jumps, steps_m, thinned

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
        assert [skip.line for skip in reading.skipped] == facts["skipped"], name
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
    assert (reading.no_return_m, reading.no_return.origin) == (81.83, "found")
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
    np.testing.assert_array_equal(thinned(scans, 1.0).ranges_m[:, 0], [1, 11, 21, 31])
    there_and_back = [(0, 0), (0.6, 0), (0, 0), (0.6, 0), (0, 0)]
    np.testing.assert_array_equal(thinned(scans_at(there_and_back), 1.0).ranges_m[:, 0], [1, 3, 5])


@given(st.lists(st.tuples(st.floats(-50, 50), st.floats(-50, 50)), min_size=1, max_size=30), st.floats(0, 20))
def test_kept_scans_are_far_enough_apart_and_none_more_could_be_dropped(positions, spacing):
    scans = scans_at(positions)
    kept = thinned(scans, spacing).ranges_m[:, 0].astype(int) - 1
    travelled = np.concatenate([[0.0], np.cumsum(steps_m(scans.poses))])
    assert kept[0] == 0
    assert (np.diff(travelled[kept]) >= spacing * (1 - 1e-8)).all()
    ends = [*kept[1:], len(scans)]
    for start, end in zip(kept, ends, strict=True):
        assert spacing == 0 or (travelled[start + 1 : end] - travelled[start] < spacing).all()


@pytest.mark.parametrize("spacing", [-1.0, np.nan, np.inf])
def test_a_spacing_that_is_none_is_refused(spacing):
    with pytest.raises(bm.BadInput, match="thin"):
        thinned(scans_at([(0, 0)]), spacing)


@pytest.mark.parametrize(("x_m", "stamps", "jumped"), [
    ([0, 0.1, 0.2, 3.2, 3.3, 3.4], 0.1 * np.arange(6), [3]),  # faster than a robot
    (np.cumsum([0.1] * 20 + [2.5] + [0.1] * 5), None, [20]),  # a long step among short ones, without any time
    (3.0 * np.arange(9), 5.0 * np.arange(9), []),  # far apart throughout
    ([0, 0.1, 0], np.array([0.0, 0.0, 1e-6]), []),  # a trembling pose, however close the stamps
])  # fmt: skip
def test_a_step_is_a_jump_if_it_is_too_fast_or_far_longer_than_others(x_m, stamps, jumped):
    np.testing.assert_array_equal(jumps(scans_at([(x, 0) for x in x_m], stamps)), jumped)


@pytest.mark.parametrize("grain_s", [1.0, 10.0, 1e6])
def test_stamps_that_repeat_make_no_jump_of_an_ordinary_step(grain_s):
    times = 1.13486e9 + 0.5 * np.arange(100)
    walk = [(1.5 * i, 0) for i in range(100)]
    assert len(jumps(scans_at(walk, np.floor(times / grain_s) * grain_s))) == 0
    walk[60:] = [(x + 40.0, 0) for x, _ in walk[60:]]
    np.testing.assert_array_equal(jumps(scans_at(walk, np.floor(times / grain_s) * grain_s)), [60])
