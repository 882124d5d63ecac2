"""The ghost: the library's predictive quantiles at its pose, and the real scan that was taken there."""

from dataclasses import replace

import numpy as np
import pytest
from acted_engine import Heard
from building_log import ANGLES, room_run, room_scans

import bayesmap as bm
from bayesmap.app.answers.predictions import FEW_DRAWS, nearest_scan
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import MoveGhost
from bayesmap.app.sources import opened_run
from bayesmap.posterior.predictor import ScanPredictor, predictor_of
from bayesmap.sensors.model import RangeLimits


def asked(heard, *pose, coarse=False):
    (report,) = heard.ask(MoveGhost(*pose, coarse))
    assert report.client == 7
    return report.header, report.buffers


def opened(run):
    heard = Heard(opened_run(run, "run.nc"))
    heard.infer(heard.engine._opened.document)
    return heard


@pytest.fixture(scope="module")
def surfaces():
    return room_run(bm.Surface(), draws=10)


def test_the_fan_is_the_library_s_predictive_law(surfaces):
    pose = (2.1, 3.2, 0.4)
    header, buffers = asked(opened(surfaces), *pose)
    assert (header["type"], header["draws"]) == ("ghost", 20)
    limits = RangeLimits(surfaces.posterior.scans.min_range_m, surfaces.posterior.scans.max_range_m)
    expected = ScanPredictor.of(predictor_of(surfaces.posterior), limits).quantiles(pose, ANGLES)
    found = np.column_stack([buffers[name] for name in ("low", "median", "high")])
    np.testing.assert_allclose(found, expected, atol=1e-5)
    np.testing.assert_allclose(buffers["angles"], ANGLES, atol=1e-6)


def test_while_the_hand_moves_it_is_that_of_a_few_of_the_draws_and_at_rest_that_of_all(surfaces):
    heard, pose = opened(surfaces), (2.1, 3.2, 0.4)
    _, at_rest = asked(heard, *pose)
    header, moving = asked(heard, *pose, coarse=True)
    assert (header["coarse"], header["draws"]) == (True, FEW_DRAWS)
    limits = RangeLimits(surfaces.posterior.scans.min_range_m, surfaces.posterior.scans.max_range_m)
    whole = predictor_of(surfaces.posterior)
    (states,) = whole.batches()
    some = states[np.linspace(0, len(states) - 1, FEW_DRAWS).round().astype(int)]
    law = ScanPredictor.of(replace(whole, batches=lambda cells=None: iter([some]), draws=FEW_DRAWS), limits)
    found = np.column_stack([moving[name] for name in ("low", "median", "high")])
    np.testing.assert_allclose(found, law.quantiles(pose, ANGLES), atol=1e-5)
    header, again = asked(heard, *pose)
    assert (header["coarse"], header["draws"]) == (False, 20)
    for name in ("low", "median", "high"):
        np.testing.assert_array_equal(again[name], at_rest[name])
    assert not np.array_equal(moving["median"], at_rest["median"])


def test_the_fan_holds_readings_that_were_never_seen(surfaces):
    """Its 80 % intervals hold about 80 % of what a real scan at that place reads; a mirrored fan holds few."""
    heard, scans = opened(surfaces), room_scans(25)  # every second one of these was not in the run
    inside, mirrored = [], []
    for scan in range(1, 25, 2):
        _, buffers = asked(heard, *scans.poses[scan])
        hit = np.isfinite(scans.ranges_m[scan])
        for flags, order in ((inside, slice(None)), (mirrored, slice(None, None, -1))):
            reading = scans.ranges_m[scan][order]
            flags.append(((buffers["low"] <= reading) & (reading <= buffers["high"]))[hit])
    assert 0.6 < np.concatenate(inside).mean() < 0.95
    assert np.concatenate(mirrored).mean() < 0.4


def test_a_scan_taken_nearby_is_shown_beside_it(surfaces):
    heard, scans = opened(surfaces), surfaces.posterior.scans
    x, y, yaw = scans.poses[5]
    header, buffers = asked(heard, x + 0.05, y - 0.02, yaw + 0.1)
    assert header["near"]["index"] == 5
    assert header["near"]["away"] == pytest.approx(np.hypot(0.05, 0.02), abs=1e-3)
    assert header["near"]["turn"] == pytest.approx(-0.1, abs=1e-3)
    np.testing.assert_array_equal(buffers["near_ranges"], scans.ranges_m[5].astype(np.float32))
    np.testing.assert_array_equal(buffers["near_pose"], scans.poses[5])
    np.testing.assert_array_equal(buffers["near_hit"], np.isfinite(scans.ranges_m[5]))


def test_near_means_half_a_metre_and_a_shared_field_of_view():
    poses = np.array([[0.0, 0.0, 0.0], [0.3, 0.0, 3.0], [5.0, 5.0, 0.0]])
    half_turn = np.linspace(-np.pi / 2, np.pi / 2, 5)
    assert nearest_scan(poses, (0.3, 0.0, 0.2), half_turn).index == 0  # the nearer one looks the other way
    assert nearest_scan(poses, (0.3, 0.0, 2.9), half_turn).index == 1
    assert nearest_scan(poses, (0.0, 0.6, 0.0), half_turn) is None
    assert nearest_scan(poses, (5.0, 5.0, np.pi), half_turn) is None
    whole_turn = np.linspace(-np.pi, np.pi, 9)
    assert nearest_scan(poses, (5.0, 5.0, np.pi), whole_turn).index == 2
    assert nearest_scan(poses[:0], (0.0, 0.0, 0.0), half_turn) is None


@pytest.mark.parametrize("mode", ["live", "run", "preview"])
def test_it_works_on_live_posteriors_and_says_how_many_draws_there_are(mode):
    heard = Heard()
    heard.infer(replace(tutorial_document(), sweeps=40), mode)
    header, buffers = asked(heard, 6.0, 15.0, 0.0)
    assert header["draws"] == (0 if mode == "preview" else 32)
    assert len(buffers["median"]) == 100
    assert header["near"] is None  # a simulation's sensors are on the map already
    assert (buffers["low"] <= buffers["median"]).all()


def test_without_a_posterior_it_says_so():
    heard = Heard()
    heard.infer(tutorial_document(), "clear")
    header, _ = asked(heard, 6.0, 15.0, 0.0)
    assert (header["type"], header["of"]) == ("undecided", "ghost")


def test_chains_rest_while_it_is_moved(monkeypatch):
    monkeypatch.setattr("bayesmap.app.engine.GHOST_SECONDS", 60.0)  # this process may be kept waiting
    heard = Heard()
    heard.infer_until_chains_run(replace(tutorial_document(), sweeps=100_000))
    asked(heard, 6.0, 15.0, 0.0)
    before = heard.engine._result.found.sweep
    heard.engine.advance()
    assert heard.engine._result.found.sweep == before


def test_its_draws_are_those_of_the_last_sweep_once_chains_are_done(monkeypatch):
    monkeypatch.setattr("bayesmap.app.answers.predictions.STALE_SECONDS", 60.0)
    heard = Heard()
    heard.infer_until_chains_run(replace(tutorial_document(), sweeps=2000))
    asked(heard, 6.0, 15.0, 0.0)
    held = heard.engine._answers._ghost._predictor
    asked(heard, 6.1, 15.0, 0.0)
    assert heard.engine._answers._ghost._predictor is held  # nothing was put there twice
    while heard.engine.busy:
        heard.engine.advance()
    asked(heard, 6.1, 15.0, 0.0)
    assert heard.engine._answers._ghost._predictor is not held
