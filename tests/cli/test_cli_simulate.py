"""`simulate`: typed readings, raw odometry, and the truth beside them."""

import numpy as np
import pytest
from shell import json_of, refusal_of

import bayesmap as bm
from bayesmap.cli.translation import odometry_of
from bayesmap.errors import BadInput
from bayesmap.io.logs import describe_log
from bayesmap.sim.robot import OdometryNoise
from bayesmap.space.planar import between, compose, interpolate

SMALL = "--world building --size 12x8 --resolution 0.25 --scans 15 --angles 60"


def simulated(tmp_path, *arguments):
    return json_of("simulate", SMALL, *arguments, "-o", tmp_path / "office.log", "--json")


def truth_of(tmp_path):
    rows = np.loadtxt(tmp_path / "office-truth.tum")
    return rows[:, 0], np.column_stack([rows[:, 1:3], 2 * np.arctan2(rows[:, 6], rows[:, 7])])


def test_beams_that_meet_nothing_are_no_return_whatever_the_sensor(tmp_path):
    document = simulated(tmp_path, "--sensor gaussian:0.02 --max-range 2")
    assert document["readings"]["no_return"] > 100
    scans = describe_log(tmp_path / "office.log").scans
    hits = scans.ranges_m[np.isfinite(scans.ranges_m)]
    # 2 % of the hits between 0 and 2 m lie within the last 4 cm, if none stand for nothing.
    assert (hits > 1.96).mean() < 0.1
    assert hits.max() <= 2.0


def test_the_tutorial_keeps_its_cap_where_it_is_called_from_python():
    walls, pose = bm.worlds.tutorial()
    angles = np.arange(100) / 100 * 2 * np.pi
    scans = bm.simulate(walls, bm.worlds.TUTORIAL_GRID, pose, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0)
    assert np.isfinite(scans.ranges_m).all()
    typed = bm.simulate(
        walls, bm.worlds.TUTORIAL_GRID, pose, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0, typed=True
    )
    nothing = scans.ranges_m > 40.0
    assert nothing.any()
    np.testing.assert_array_equal(np.isposinf(typed.ranges_m), nothing)


def test_raw_odometry_with_the_truth_beside_it(tmp_path):
    document = simulated(tmp_path, "--odometry typical,slips_per_m=0.05 --laser 0.1,-0.05,5")
    assert document["odometry"]["slips_per_m"] == 0.05
    reading = describe_log(tmp_path / "office.log")
    stamps, base = truth_of(tmp_path)
    mount = np.array([0.1, -0.05, np.radians(5.0)])
    laser = compose(base, mount)
    np.testing.assert_allclose(reading.scans.mount, mount, atol=1e-4)
    np.testing.assert_allclose(reading.scans.stamps_s, stamps, atol=1e-5)
    drift = between(laser, reading.scans.poses)
    assert np.abs(drift[0]).max() < 1e-5
    assert np.hypot(*drift[:, :2].T).max() > 0.1

    relations = np.loadtxt(tmp_path / "office.relations")
    start, end = (interpolate(stamps, base, relations[:, column]) for column in (0, 1))
    assert len(relations) > 20
    np.testing.assert_allclose(between(relations[:, [2, 3, 7]], between(start, end)), 0.0, atol=1e-4)


def test_a_recording_holds_scans_odometry_and_the_place_of_the_laser(tmp_path):
    document = json_of(
        "simulate", "--format mcap --size 12x8 --resolution 0.25 --minutes 0.05 --angles 60 --laser 0.2,0,90 -o",
        tmp_path / "robot.mcap", "--json",
    )  # fmt: skip
    assert (document["scans"], document["beams"]) == (30, 1800)
    reading = describe_log(tmp_path / "robot.mcap")
    mount = np.array([0.2, 0.0, np.pi / 2])
    np.testing.assert_allclose(reading.scans.mount, mount, atol=1e-6)
    rows = np.loadtxt(tmp_path / "robot-truth.tum")
    np.testing.assert_allclose(reading.scans.stamps_s, rows[:, 0], atol=1e-5)
    np.testing.assert_allclose(np.diff(rows[:, 0]), 0.1, atol=1e-5)
    true = np.column_stack([rows[:, 1:3], 2 * np.arctan2(rows[:, 6], rows[:, 7])])
    drift = between(compose(true, mount), reading.scans.poses)
    assert np.abs(drift[0]).max() < 1e-5
    assert np.abs(drift[-1]).max() > 0.01


@pytest.mark.parametrize(("line", "message"), [
    ("--format carmen -o a.mcap", "ends differently"), ("--format mcap -o a.log", "ends differently"),
    ("--minutes 1 -o a.log", "--world building"),
])  # fmt: skip
def test_a_recording_that_cannot_be_made_is_refused(tmp_path, monkeypatch, line, message):
    monkeypatch.chdir(tmp_path)
    assert message in refusal_of("simulate", line, code=3 if "minutes" in line else 2)


def test_true_poses_come_with_no_trajectory_of_the_truth(tmp_path):
    simulated(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "office-truth.pgm", "office-truth.yaml", "office.log",
    ]  # fmt: skip


def test_odometry_as_it_is_typed():
    assert odometry_of("true") is None
    assert odometry_of("typical") == OdometryNoise()
    assert odometry_of("perfect, lag_s=0.1").lag_s == 0.1
    assert odometry_of("perfect").turn_per_m == 0.0
    for text, message in (
        ("worn", "begin with true, typical or perfect"),
        ("typical,wheels=2", "'wheels=2' is not name=value with one of distance_per_m"),
        ("typical,lag_s=soon", "'soon' is not a number"),
        ("typical,slip_m=-1", "slip_m must be a finite number of 0 or more"),
    ):
        with pytest.raises(BadInput, match=message):
            odometry_of(text)
