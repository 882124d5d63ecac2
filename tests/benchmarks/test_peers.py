"""Peers hold their own packages and repeat when told; batteries of simulated logs are not sure of what is wrong."""

import gzip
import json
import os
import struct
import sys
from dataclasses import replace

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.poses.slam import infer_trajectory
from benchmarks import environments
from benchmarks.environments import PEERS, Unavailable
from benchmarks.external_maps import NOT_LOST, SURE, asked, case_of, simulated
from benchmarks.peers import mrpt_localization as mrpt
from benchmarks.pose_battery import case, judge
from benchmarks.turns import TurnFailed, turns

SAYS = "import os; raise SystemExit(' '.join(sorted(k for k in os.environ if k.startswith('PIP_'))) or 'none')"


def test_pins_of_our_environment_do_not_reach_the_peers(monkeypatch):
    for name in ("PIP_CONSTRAINT", "PIP_REQUIREMENT", "PIP_TARGET"):
        monkeypatch.setenv(name, "ours.txt")
    monkeypatch.setenv("PIP_INDEX_URL", "https://mirror.example/simple")
    said = environments._run([sys.executable, "-c", SAYS])
    assert said is not None
    assert "PIP_INDEX_URL" in said.split()
    assert not {"PIP_CONSTRAINT", "PIP_REQUIREMENT", "PIP_TARGET"} & set(said.split())


def test_a_peer_that_cannot_be_installed_is_left_out_with_the_reason(monkeypatch, tmp_path):
    monkeypatch.setattr(environments, "ENVIRONMENTS", tmp_path)
    monkeypatch.setattr(environments, "_run", lambda command: "no matching distribution")
    monkeypatch.setattr(environments, "_find_python", lambda versions: sys.executable)
    found = environments.ensure("numpyro")
    assert found == environments.Unavailable("numpyro could not be installed: no matching distribution")


@pytest.mark.parametrize("name", sorted(environments.PYTHONS))
def test_every_peer_is_pinned(name):
    lines = (environments.PEERS / f"{name}.constraints.txt").read_text().splitlines()
    assert all("==" in line for line in lines if line and not line.startswith("#"))


PEER = f"""
import sys
sys.path.insert(0, {str(PEERS)!r})
import harness
calls = []
def prepare(prior):
    print("what a library prints does not disturb the answers")
    return harness.Ready(lambda: calls.append(1), 4, lambda: len(calls))
case = harness.Case(prepare, 0.5, "sweep")
harness.main("toy", "A toy.", {{"a": case}}, ("numpy",), lambda prior: -prior, lambda: {{"passed": True}})
"""


def started(code, timeout_s=60.0, *arguments):
    return turns([sys.executable, "-c", code, *arguments], cores=None, environment=os.environ, timeout_s=timeout_s)


def test_a_peer_says_what_it_is_and_repeats_when_told():
    with started(PEER, 60.0, "--case", "a", "--in-turn") as process:
        assert (process.about["peer"], process.about["log_joint_of_truth"]) == ("toy", -0.5)
        assert set(process.about["versions"]) == {"python", "numpy"}
        seconds = [process.seconds() for _ in range(3)]
        assert [answer["seconds"] for answer in process.answers] == seconds
        assert min(seconds) >= 0.0


def test_a_peer_that_cannot_be_set_up_gives_its_last_words():
    with pytest.raises(TurnFailed, match="ValueError: no such problem"), started('raise ValueError("no such problem")'):
        pass


def test_a_peer_that_takes_too_long_is_ended():
    slow = "import json, time\nprint(json.dumps({}), flush=True)\ninput()\ntime.sleep(600)"
    with started(slow, 2.0) as process, pytest.raises(TurnFailed, match="not done after 2 s"):
        process.seconds()


def test_a_peer_that_has_ended_is_noticed():
    with started("print('{}', flush=True)") as process, pytest.raises(TurnFailed):
        process.seconds()


def scans(angles_rad):
    ranges = np.array([[1.5, np.inf, 2.5]] * 2)
    return bm.Scans(np.array([[1.0, 2.0, 0.5], [3.0, 4.0, -0.5]]), angles_rad, ranges, max_range_m=20.0)


def test_a_rawlog_has_odometry_and_readings_in_turn(tmp_path):
    """The layout is that of files that MRPT 2.5's carmen2rawlog writes."""
    mrpt.write_rawlog(scans(np.radians([-1.0, 0.0, 1.0])), tmp_path / "log.rawlog")
    data = gzip.decompress((tmp_path / "log.rawlog").read_bytes())
    name = b"\x9fmrpt::obs::CObservationOdometry\x02\x94mrpt::poses::CPose2D\x01"
    assert data.startswith(name + struct.pack("<3d", 1.0, 2.0, 0.5) + b"\x88\x08\x00\x00\x00ODOMETRY")
    assert [data.count(kind) for kind in (b"CObservationOdometry\x02", b"CObservation2DRangeScan\x07")] == [2, 2]
    assert data.count(struct.pack("<I3f", 3, 1.5, 20.0, 2.5) + b"\x01\x00\x01") == 2
    aperture = struct.pack("<f?f", np.radians(2.0), True, 20.0)
    assert data.count(b"CObservation2DRangeScan\x07" + aperture + b"\x94mrpt::poses::CPose3D\x03") == 2


def test_beams_that_are_not_evenly_spaced_are_refused(tmp_path):
    with pytest.raises(ValueError, match="evenly spaced"):
        mrpt.write_rawlog(scans(np.array([0.0, 0.1, 0.3])), tmp_path / "log.rawlog")


def test_mrpt_is_left_out_with_a_reason_if_it_is_not_installed(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    found = mrpt.missing()
    assert isinstance(found, Unavailable)
    assert "mrpt-apps" in found.reason


@pytest.mark.full
def test_a_weak_laser_on_a_campus_is_not_wrong_without_a_word():
    """Fewer beams in the first alignments once put its trajectory 20 m off."""
    log = case(52)
    trajectory = infer_trajectory(log.scans)
    outcome = judge(trajectory, log.truth)
    assert outcome.median_m < 0.1
    assert outcome.worst_m < 5.0
    assert outcome.unannounced == 0
    # The judge sees what nobody announced: half of the way 5 m to the side.
    moved = trajectory.poses + np.outer(np.arange(len(log.truth)) > len(log.truth) // 2, [0.0, 5.0, 0.0])
    assert judge(replace(trajectory, poses=moved), log.truth).unannounced > 100


def test_a_case_is_what_its_number_says():
    """Maps differ from the building, and people come before walls; the same number gives the same."""
    case = case_of(5)
    occupancy, grid, moved, route = simulated(case, 6)
    again = simulated(case, 6)
    np.testing.assert_array_equal(occupancy, again[0])
    np.testing.assert_array_equal(moved.ranges_m, again[2].ranges_m)
    assert occupancy.shape == grid.shape
    assert 0.0 < np.isnan(occupancy).mean() < 0.9
    assert np.hypot(*np.diff(route[:, :2], axis=0).T) == pytest.approx(case.step_m, rel=0.2)


@pytest.mark.full
def test_localization_is_not_sure_of_wrong_places(tmp_path):
    """At most 1 % of 4 x 40 scans are wrong and sure; in maps trusted as our own, more are wrong at over 0.9."""
    for seed in (0, 2, 6, 13):
        asked(seed, ("fitted", "own"), 40, tmp_path / f"{seed}.json")
    found = [json.loads(path.read_text()) for path in tmp_path.glob("*.json")]

    def wrong(law, least, lost):
        answers = [a for f in found for name in ("along", "ten", "one") for a in f[law][name]]
        return np.mean([not a["right"] and a["modes"][0][0] > least and a["lost"] < lost for a in answers])

    assert wrong("fitted", SURE, NOT_LOST) <= 0.01
    assert wrong("own", 0.9, 1.0) > wrong("fitted", 0.9, 1.0)
