"""The noise of a laser, found from its scans alone, and what matching makes of lasers that are noisier than usual."""

import numpy as np
import pytest
from simulated import off, path_around, recording, ring, scans_of
from tiers import latin

from bayesmap.poses import scan_geometry as geometry_module
from bayesmap.poses.scan_geometry import LEAST_M, MOST_M, range_noise_m, scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.scans import Scans

POSES = path_around(laps=1.0)[::2]


def found_m(noise_m, beams=180):
    angles, ranges = scans_of(ring(), POSES, beams=beams, noise_m=noise_m)
    return range_noise_m(ranges, float(angles[1] - angles[0]))


@pytest.mark.parametrize(("noise_m", "beams"), latin(3, [0.015, 0.03, 0.045], [90, 180, 720]))
def test_the_noise_is_found_to_an_eighth(noise_m, beams):
    assert found_m(noise_m, beams) == pytest.approx(noise_m, rel=0.125)


def test_no_laser_is_taken_to_be_better_or_worse_than_walls_allow():
    assert found_m(0.001) == LEAST_M
    assert found_m(0.2) == MOST_M


def test_scans_with_too_few_hits_tell_nothing():
    assert range_noise_m(np.full((3, 180), np.inf), 0.0175) == LEAST_M
    assert range_noise_m(np.full((3, 2), 1.0), 0.0175) == LEAST_M


def test_noisy_scans_have_normals_too(monkeypatch):
    """The twin: fitted as if the laser were a good one."""
    angles, ranges = scans_of(ring(), POSES, noise_m=0.03)
    scans = Scans(POSES, angles, ranges, max_range_m=12.0)

    def share():
        kind = scan_geometry(scans).host_kind
        return (kind == 2).sum() / (kind > 0).sum()

    assert share() > 0.6
    monkeypatch.setattr(geometry_module, "range_noise_m", lambda *_: LEAST_M)
    assert share() < 0.45


@pytest.mark.full
def test_a_noisy_laser_s_trajectory_is_right_and_knows_how_far(monkeypatch):
    scans, truth = recording(noise=2.0, turn_bias=0.03, laser_noise_m=0.03)

    def errors():
        found = infer_trajectory(scans, threads=2)
        error = off(found.poses, truth)
        return np.hypot(error[:, 0], error[:, 1])

    right = errors()
    assert right.max() < 0.06
    monkeypatch.setattr(geometry_module, "range_noise_m", lambda *_: LEAST_M)
    assert np.sqrt((errors() ** 2).mean()) > 1.2 * np.sqrt((right**2).mean())
