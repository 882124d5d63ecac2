"""A run whose scans have beams of their own: each is shown, compared and recorded by its own angles."""

import base64
from dataclasses import replace

import numpy as np
import pytest
from acted_engine import Heard
from building_log import ANGLES, GRID, SENSOR, room_scans

import bayesmap as bm
from bayesmap.app.exports import record
from bayesmap.app.protocol.actions import CompareBeam, MoveGhost, ShowScan
from bayesmap.app.sources import opened_run
from bayesmap.space.scans import side_by_side

FIRST, COUNT = [0, 3, 7, 1] * 3, [91, 60, 75, 83] * 3


@pytest.fixture(scope="module")
def run():
    whole = room_scans()
    parts = [slice(first, first + count) for first, count in zip(FIRST, COUNT, strict=True)]
    beams = side_by_side(
        [ANGLES[part] for part in parts], [row[p] for row, p in zip(whole.ranges_m, parts, strict=True)]
    )
    scans = bm.Scans(whole.poses, *beams, 12.0)
    return bm.infer(
        scans, GRID, prior=bm.Independent(0.2), sensor=SENSOR, schedule=bm.Schedule(chains=2, warmup=10, draws=20)
    )


@pytest.fixture(scope="module")
def heard(run):
    heard = Heard(opened_run(run, "run.nc"))
    heard.infer(heard.engine._opened.document)
    return heard


def test_a_scan_is_shown_with_its_own_beams(run, heard):
    heard.engine.take(ShowScan(5))
    header, buffers = heard.last("scan")
    angles, ranges = run.posterior.scans.beams_of(5)
    assert header["index"] == 5
    np.testing.assert_allclose(buffers["angles"][: len(angles)], angles, atol=1e-6)
    np.testing.assert_allclose(buffers["ranges"].ravel()[: len(ranges)], ranges, atol=1e-5)
    assert np.isnan(buffers["ranges"].ravel()[len(ranges) :]).all()


def test_a_beam_is_compared_by_its_own_angle(run, heard):
    scan, beam = 5, 10
    (report,) = heard.ask(CompareBeam(scan, beam))
    assert report.header["range"] == pytest.approx(run.posterior.scans.ranges_m[scan, beam])
    assert abs(report.header["residual"]) < 0.3  # three degrees to the side the wall is elsewhere


def test_the_ghost_beside_a_scan_has_its_beams(run, heard):
    (report,) = heard.ask(MoveGhost(*run.posterior.scans.poses[5], False))
    assert report.header["near"]["index"] == 5
    angles, _ = run.posterior.scans.beams_of(5)
    n = len(angles)
    np.testing.assert_allclose(report.buffers["angles"][:n], angles, atol=1e-6)
    off = np.abs(report.buffers["near_ranges"][:n] - report.buffers["median"][:n])
    assert np.median(off[np.isfinite(off)]) < 0.15


def test_a_recording_holds_each_scan_s_beams(heard):
    found = record(heard.engine._result).scans
    assert [len(row) for row in found.angles] == [len(row) for row in found.ranges] == COUNT
    np.testing.assert_allclose(found.angles[5], ANGLES[3:63], atol=1e-6)
    assert len(base64.b64decode(found.hit)) == -(-sum(COUNT) // 8)


def test_a_recording_tells_readings_of_four_kinds_apart(heard):
    result = heard.engine._result
    ranges = result.scene.scans.ranges_m.copy()
    ranges[0, :3] = np.inf, -np.inf, np.nan
    scene = replace(result.scene, scans=replace(result.scene.scans, ranges_m=ranges))
    found = record(replace(result, scene=scene)).scans.ranges[0]
    assert found[:3] == [None, "-Infinity", "NaN"]
    assert found[3:] == pytest.approx(ranges[0, 3 : len(found)], abs=1e-4)
