"""A reading against its prediction: along the beam, and across and along the wall."""

import numpy as np
import pytest
from acted_engine import PAGE, Heard
from building_log import ANGLES, room_run

import bayesmap as bm
from bayesmap.app.protocol.actions import CompareBeam
from bayesmap.app.sources import opened_run
from bayesmap.posterior.predictor import ScanPredictor, predictor_of
from bayesmap.sensors.model import RangeLimits


def compared(run, scan, beam):
    heard = Heard(opened_run(run, "run.nc"))
    heard.infer(heard.engine._opened.document)
    (report,) = heard.ask(CompareBeam(scan, beam))
    assert report.client == PAGE
    assert report.header["type"] == "beam"
    return report.header


@pytest.fixture(scope="module")
def surfaces():
    """Draws so far apart that the mean direction of a surface is that of its wall."""
    return room_run(bm.Surface(), draws=10, thin=10)


def straight_ahead_on_the_lower_wall(run):
    """A scan and its beam that meets the wall at the bottom nearly at a right angle: y = 0.2 m is its edge."""
    poses = run.posterior.scans.poses
    beam = int(np.argmin(np.abs(poses[0, 2] + ANGLES + np.pi / 2)))
    return 0, beam


def test_a_reading_in_front_of_its_median_lies_in_front_of_the_wall(surfaces):
    scan, beam = straight_ahead_on_the_lower_wall(surfaces)
    found = compared(surfaces, scan, beam)
    scans = surfaces.posterior.scans
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    low, median, high = ScanPredictor.of(predictor_of(surfaces.posterior), limits).quantiles(
        scans.poses[scan], ANGLES[[beam]]
    )[0]
    assert found["range"] == pytest.approx(scans.ranges_m[scan, beam])
    ends = [np.inf if found[name] is None else found[name] for name in ("low", "median", "high")]
    assert ends == pytest.approx([low, median, high], abs=2e-3)
    assert found["residual"] == pytest.approx(found["range"] - found["median"])
    wall = found["wall"]
    assert wall["incidence_rad"] < 0.6
    assert abs(wall["across_m"]) < 0.15
    assert abs(wall["along_m"]) < 0.25
    assert wall["thickness_m"] < wall["length_m"]


def test_a_longer_reading_lies_further_behind(surfaces):
    """At a right angle the two residuals are each other's negatives, but for where the surface's mean is."""
    scan, beam = straight_ahead_on_the_lower_wall(surfaces)
    scans = surfaces.posterior.scans
    found = compared(surfaces, scan, beam)
    moved = scans.ranges_m.copy()
    moved[scan, beam] += 0.05
    from dataclasses import replace

    longer = replace(surfaces, posterior=replace(surfaces.posterior, scans=replace(scans, ranges_m=moved)))
    further = compared(longer, scan, beam)
    assert further["residual"] == pytest.approx(found["residual"] + 0.05, abs=1e-6)
    shift = further["wall"]["across_m"] - found["wall"]["across_m"]
    assert shift == pytest.approx(-0.05 * np.cos(_angle(surfaces, scan, beam, found)), abs=5e-3)


def _angle(run, scan, beam, found):
    """Between the beam and the normal of the wall that it met, by the surface itself."""
    mean, covariance, _ = run.surfaces()
    pose = run.posterior.scans.poses[scan]
    heading = pose[2] + ANGLES[beam]
    end = pose[:2] + found["range"] * np.array([np.cos(heading), np.sin(heading)])
    nearest = int(np.argmin(np.hypot(*(mean - end).T)))
    normal = np.linalg.eigh(covariance[nearest])[1][:, 0]
    return np.arccos(abs(normal @ [np.cos(heading), np.sin(heading)]))


def test_cells_without_surfaces_have_the_range_alone():
    found = compared(room_run(bm.Beta()), 0, 45)
    assert found["wall"] is None
    assert np.isfinite(found["residual"])


def test_no_return_has_no_residual_but_a_probability(surfaces):
    scans = surfaces.posterior.scans
    none = np.argwhere(np.isposinf(scans.ranges_m))
    assert len(none)
    found = compared(surfaces, *map(int, none[0]))
    assert found["reading"] == "none"
    assert found["range"] is None
    assert found["residual"] is None
    assert 0 < found["no_return"] < 0.5
