"""The angle between beams: found where scans show it, left as stated where they do not."""

from dataclasses import replace

import numpy as np
import pytest
from simulated import recording

from bayesmap.poses import calibration
from bayesmap.poses.calibration import angle_step_ratio
from bayesmap.space.planar import wrapped

SCANS, TRUTH = recording(laser_noise_m=0.01)
FIRST, SECOND = (index.ravel().astype(np.int32) for index in np.indices((len(TRUTH), len(TRUTH))))
NEAR = (FIRST < SECOND) & (np.hypot(*(TRUTH[FIRST] - TRUTH[SECOND])[:, :2].T) < 2.0)
TURNED = NEAR & (np.abs(wrapped(TRUTH[FIRST, 2] - TRUTH[SECOND, 2])) > np.radians(25.0))


def ratio(scans):
    return angle_step_ratio(scans, TRUTH, FIRST[TURNED], SECOND[TURNED])


def test_angles_that_are_stated_wrong_are_found():
    """One part in 125 too wide; the truth is known to the estimate's own error, about 0.2 %."""
    stated = replace(SCANS, angles_rad=SCANS.angles_rad * 1.008)
    assert ratio(stated) == pytest.approx(1.0 / 1.008, abs=0.0025)


def test_right_angles_stay_as_they_are():
    assert ratio(SCANS) == 1.0


@pytest.mark.parametrize(("noise", "seed"), [(0.01, 2), (0.02, 0), (0.02, 2), (0.03, 1)])
def test_noise_is_not_taken_for_wrong_angles(monkeypatch, noise, seed):
    """Where ranges scatter by a percent and more, the lowest residual lies anywhere. The twin: it is believed."""
    error = noise * np.random.default_rng(seed).standard_normal(SCANS.ranges_m.shape)
    noisy = replace(SCANS, ranges_m=np.asarray(SCANS.ranges_m * (1.0 + error)))
    assert ratio(noisy) == 1.0
    monkeypatch.setattr(calibration, "SURE", 0.0)
    monkeypatch.setattr(calibration, "_regular", lambda factor, stated: factor)
    assert ratio(noisy) != 1.0
