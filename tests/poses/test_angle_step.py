"""The angle between beams: found where scans show it, left as stated where they do not."""

from dataclasses import replace

import numpy as np
import pytest
from simulated import recording
from tiers import full_but

from bayesmap.poses import calibration
from bayesmap.poses.calibration import angle_step_ratio
from bayesmap.space.planar import wrapped


@pytest.fixture(scope="module")
def recorded():
    """Scans, and the poses at which they were taken."""
    return recording(laser_noise_m=0.01)


def ratio(scans, truth):
    first, second = (index.ravel().astype(np.int32) for index in np.indices((len(truth), len(truth))))
    near = (first < second) & (np.hypot(*(truth[first] - truth[second])[:, :2].T) < 2.0)
    turned = near & (np.abs(wrapped(truth[first, 2] - truth[second, 2])) > np.radians(25.0))
    return angle_step_ratio(scans, truth, first[turned], second[turned])


def test_angles_that_are_stated_wrong_are_found(recorded):
    """One part in 125 too wide; the truth is known to the estimate's own error, about 0.2 %."""
    scans, truth = recorded
    stated = replace(scans, angles_rad=scans.angles_rad * 1.008)
    assert ratio(stated, truth) == pytest.approx(1.0 / 1.008, abs=0.0025)


def test_right_angles_stay_as_they_are(recorded):
    assert ratio(*recorded) == 1.0


@pytest.mark.parametrize("case", full_but([(0.01, 2), (0.02, 0), (0.02, 2), (0.03, 1)], (0.01, 2), (0.03, 1)))
def test_noise_is_not_taken_for_wrong_angles(recorded, monkeypatch, case):
    """Where ranges scatter by a percent and more, the lowest residual lies anywhere. The twin: it is believed."""
    (noise, seed), (scans, truth) = case, recorded
    error = noise * np.random.default_rng(seed).standard_normal(scans.ranges_m.shape)
    noisy = replace(scans, ranges_m=np.asarray(scans.ranges_m * (1.0 + error)))
    assert ratio(noisy, truth) == 1.0
    monkeypatch.setattr(calibration, "SURE", 0.0)
    monkeypatch.setattr(calibration, "_regular", lambda factor, stated: factor)
    assert ratio(noisy, truth) != 1.0
