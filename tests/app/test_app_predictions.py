"""Virtual scans, and readings against their predictions: those of the library, whatever beams the scans have."""

from dataclasses import replace

import numpy as np
import pytest
from acted import shown
from building_log import ANGLES, GRID, SENSOR, room_run, room_scans

import bayesmap as bm
from bayesmap.app.answers.predictions import COARSE_DRAWS, nearest_scan
from bayesmap.app.edits import tutorial_document
from bayesmap.app.exports import build_recording
from bayesmap.app.protocol.actions import CompareBeam, MoveVirtualScan, ShowScan
from bayesmap.posterior.prediction import ScanPredictor, predictor_of
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.scans import side_by_side

POSE = (2.1, 3.2, 0.4)
QUANTILES = ("low", "median", "high")


def limits_of(run):
    return RangeLimits(run.posterior.scans.min_range_m, run.posterior.scans.max_range_m)


@pytest.fixture(scope="module")
def surfaces():
    return room_run(bm.Surface())


def test_a_virtual_scan_is_the_library_s_law_by_a_few_of_the_draws_while_the_hand_moves(surfaces):
    heard, limits, whole = shown(surfaces), limits_of(surfaces), predictor_of(surfaces.posterior)
    header, at_rest = heard.answer(MoveVirtualScan(*POSE))
    assert (header["type"], header["coarse"], header["draws"]) == ("ghost", False, 20)
    expected = ScanPredictor.of(whole, limits).quantiles(POSE, ANGLES)
    np.testing.assert_allclose(np.column_stack([at_rest[name] for name in QUANTILES]), expected, atol=1e-5)
    np.testing.assert_allclose(at_rest["angles"], ANGLES, atol=1e-6)
    header, moving = heard.answer(MoveVirtualScan(*POSE, coarse=True))
    assert (header["coarse"], header["draws"]) == (True, COARSE_DRAWS)
    (states,) = whole.batches()
    few_states = states[np.linspace(0, len(states) - 1, COARSE_DRAWS).round().astype(int)]
    law = ScanPredictor.of(replace(whole, batches=lambda cells=None: iter([few_states]), draws=COARSE_DRAWS), limits)
    quantiles = np.column_stack([moving[name] for name in QUANTILES])
    np.testing.assert_allclose(quantiles, law.quantiles(POSE, ANGLES), atol=1e-5)
    _, again = heard.answer(MoveVirtualScan(*POSE))
    assert all(np.array_equal(again[name], at_rest[name]) for name in QUANTILES)
    assert not np.array_equal(moving["median"], at_rest["median"])


def test_a_scan_taken_nearby_is_shown_beside_it(surfaces):
    scans = surfaces.posterior.scans
    header, buffers = shown(surfaces).answer(MoveVirtualScan(*(scans.poses[5] + [0.05, -0.02, 0.1])))
    near = {"index": 5, "away": pytest.approx(np.hypot(0.05, 0.02), abs=1e-3), "turn": pytest.approx(-0.1, abs=1e-3)}
    assert header["near"] == near
    np.testing.assert_array_equal(buffers["near_ranges"], scans.ranges_m[5].astype(np.float32))
    np.testing.assert_array_equal(buffers["near_pose"], scans.poses[5])
    np.testing.assert_array_equal(buffers["near_hit"], np.isfinite(scans.ranges_m[5]))


def test_near_means_half_a_metre_and_a_shared_field_of_view():
    poses = np.array([[0.0, 0.0, 0.0], [0.3, 0.0, 3.0], [5.0, 5.0, 0.0]])
    half_turn, whole_turn = np.linspace(-np.pi / 2, np.pi / 2, 5), np.linspace(-np.pi, np.pi, 9)
    assert nearest_scan(poses, (0.3, 0.0, 0.2), half_turn).index == 0  # the nearer one looks the other way
    assert nearest_scan(poses, (0.3, 0.0, 2.9), half_turn).index == 1
    assert nearest_scan(poses, (0.0, 0.6, 0.0), half_turn) is None
    assert nearest_scan(poses, (5.0, 5.0, np.pi), half_turn) is None
    assert nearest_scan(poses, (5.0, 5.0, np.pi), whole_turn).index == 2
    assert nearest_scan(poses[:0], (0.0, 0.0, 0.0), half_turn) is None


@pytest.mark.parametrize(("mode", "draws"), [("live", 32), ("run", 32), ("preview", 0), ("clear", None)])
def test_it_works_on_live_posteriors_and_says_how_many_draws_there_are(heard, mode, draws):
    heard.infer(replace(tutorial_document(), sweeps=40), mode)
    header, buffers = heard.answer(MoveVirtualScan(6.0, 15.0, 0.0))
    if draws is None:
        assert (header["type"], header["question"]) == ("undecided", "ghost")
        return
    assert header["draws"] == draws
    assert len(buffers["median"]) == 100
    assert header["near"] is None  # a simulation's sensors are on the map already
    assert (buffers["low"] <= buffers["median"]).all()


def test_chains_rest_while_it_is_moved(heard, monkeypatch):
    monkeypatch.setattr("bayesmap.app.engine.VIRTUAL_SCAN_SECONDS", 60.0)  # this process may be kept waiting
    heard.infer_until(replace(tutorial_document(), sweeps=100_000), heard.chains_run)
    heard.answer(MoveVirtualScan(6.0, 15.0, 0.0))
    before = heard.engine._result.estimate.sweep
    heard.engine.advance()
    assert heard.engine._result.estimate.sweep == before


def test_its_draws_are_those_of_the_last_sweep_once_chains_are_done(heard, monkeypatch):
    monkeypatch.setattr("bayesmap.app.answers.predictions.STALE_SECONDS", 60.0)
    heard.infer_until(replace(tutorial_document(), sweeps=2000), heard.chains_run)

    def asked(x):
        heard.answer(MoveVirtualScan(x, 15.0, 0.0))
        return heard.engine._answers._virtual_scans._predictor

    held = asked(6.0)
    assert asked(6.1) is held  # nothing was put there twice
    heard.finish()
    assert asked(6.1) is not held


def compared(run, scan, beam):
    header, _ = shown(run).answer(CompareBeam(scan, beam))
    assert header["type"] == "beam"
    return header


def test_a_reading_is_compared_along_its_beam_and_across_and_along_its_wall():
    run = room_run(bm.Surface(), draws=10, thin=10)  # so far apart that a mean surface has its wall's direction
    scans = run.posterior.scans  # the beam that meets the wall at the bottom, of edge y = 0.2 m, at a right angle:
    beam = int(np.argmin(np.abs(scans.poses[0, 2] + ANGLES + np.pi / 2)))
    answer = compared(run, 0, beam)
    law = ScanPredictor.of(predictor_of(run.posterior), limits_of(run))
    assert answer["range"] == pytest.approx(scans.ranges_m[0, beam])
    ends = [np.inf if answer[name] is None else answer[name] for name in QUANTILES]
    assert ends == pytest.approx(law.quantiles(scans.poses[0], ANGLES[[beam]])[0], abs=2e-3)
    assert answer["residual"] == pytest.approx(answer["range"] - answer["median"])
    wall = answer["wall"]
    assert wall["incidence_rad"] < 0.6
    assert abs(wall["across_m"]) < 0.15
    assert abs(wall["along_m"]) < 0.25
    assert wall["thickness_m"] < wall["length_m"]
    # At a right angle the two residuals are each other's negatives, but for where the surface's mean is.
    moved = scans.ranges_m.copy()
    moved[0, beam] += 0.05
    longer = replace(run, posterior=replace(run.posterior, scans=replace(scans, ranges_m=moved)))
    further = compared(longer, 0, beam)
    assert further["residual"] == pytest.approx(answer["residual"] + 0.05, abs=1e-6)
    mean, covariance, _ = run.surfaces()
    heading = scans.poses[0, 2] + ANGLES[beam]
    ahead = np.array([np.cos(heading), np.sin(heading)])
    nearest = int(np.argmin(np.hypot(*(mean - scans.poses[0, :2] - answer["range"] * ahead).T)))
    cosine = abs(np.linalg.eigh(covariance[nearest])[1][:, 0] @ ahead)
    assert further["wall"]["across_m"] - wall["across_m"] == pytest.approx(-0.05 * cosine, abs=5e-3)


def test_no_return_has_no_residual_but_a_probability_and_other_cells_no_wall(surfaces):
    answer = compared(surfaces, *np.argwhere(np.isposinf(surfaces.posterior.scans.ranges_m))[0].tolist())
    assert (answer["reading"], answer["range"], answer["residual"]) == ("none", None, None)
    assert 0 < answer["no_return"] < 0.5
    answer = compared(room_run(bm.Beta()), 0, 45)
    assert answer["wall"] is None
    assert np.isfinite(answer["residual"])


FIRST, COUNT = [0, 3, 7, 1] * 3, [91, 60, 75, 83] * 3


@pytest.fixture(scope="module")
def unlike():
    """An engine that shows a run whose scans have beams of their own."""
    whole = room_scans()
    parts = [slice(first, first + count) for first, count in zip(FIRST, COUNT, strict=True)]
    ranges = [row[part] for row, part in zip(whole.ranges_m, parts, strict=True)]
    scans = bm.Scans(whole.poses, *side_by_side([ANGLES[part] for part in parts], ranges), 12.0)
    schedule = bm.Schedule(chains=2, warmup=10, draws=20)
    return shown(bm.infer(scans, GRID, prior=bm.Independent(0.2), sensor=SENSOR, schedule=schedule))


def test_a_scan_with_its_own_beams_is_shown_compared_and_predicted_by_them(unlike):
    scans = unlike.engine._result.scene.scans
    angles, ranges = scans.beams_of(5)
    n = len(angles)
    unlike.engine.take(ShowScan(5))
    header, buffers = unlike.last("scan")
    assert header["index"] == 5
    np.testing.assert_allclose(buffers["angles"].ravel()[:n], angles, atol=1e-6)
    np.testing.assert_allclose(buffers["ranges"].ravel()[:n], ranges, atol=1e-5)
    assert np.isnan(buffers["ranges"].ravel()[n:]).all()
    header, _ = unlike.answer(CompareBeam(5, 10))
    assert header["range"] == pytest.approx(scans.ranges_m[5, 10])
    assert abs(header["residual"]) < 0.3  # three degrees to the side the wall is elsewhere
    header, buffers = unlike.answer(MoveVirtualScan(*scans.poses[5]))
    assert header["near"]["index"] == 5
    np.testing.assert_allclose(buffers["angles"][:n], angles, atol=1e-6)
    off = np.abs(buffers["near_ranges"][:n] - buffers["median"][:n])
    assert np.median(off[np.isfinite(off)]) < 0.15


def test_a_recording_holds_each_scan_s_beams_and_tells_readings_of_four_kinds_apart(unlike):
    result = unlike.engine._result
    _, buffers = build_recording(result)
    ranges = result.scene.scans.ranges_m.copy()
    assert np.isfinite(buffers["ranges"]).sum(axis=1).tolist() == np.isfinite(ranges).sum(axis=1).tolist()
    np.testing.assert_allclose(buffers["angles"][5, :60], ANGLES[3:63], atol=1e-6)
    assert buffers["hit"].shape == ranges.shape
    ranges[0, :3] = np.inf, -np.inf, np.nan
    scene = replace(result.scene, scans=replace(result.scene.scans, ranges_m=ranges))
    np.testing.assert_allclose(build_recording(replace(result, scene=scene))[1]["ranges"][0], ranges[0], atol=1e-4)
