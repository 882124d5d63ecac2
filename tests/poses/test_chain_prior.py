"""What chains over map and trajectory believe of odometry."""

from types import SimpleNamespace

import numpy as np

from bayesmap.api import key_scans
from bayesmap.poses.graph import Factors
from bayesmap.space.scans import Scans

TURNED = np.array([[0.0, 0.0, 0.0], [0.0, 0.05, 0.5], [0.0, 0.1, 1.0]])


def test_odometry_that_missed_a_turn_does_not_turn_the_scans_of_the_chains():
    """The log says firmly that the robot stood still between two scans that the walls hold half a radian apart."""
    scans = Scans(TURNED, np.array([0.0]), np.ones((3, 1)), 2.0)
    stood = Factors(np.arange(2), np.arange(1, 3), np.zeros((2, 3)), np.tile(np.eye(3) / 0.002**2, (2, 1, 1)))
    calibration = SimpleNamespace(angle_step_ratio=1.0)
    found = SimpleNamespace(
        keys=np.arange(3), order=np.arange(3), poses=TURNED, odometry=stood, calibration=calibration,
        draw=lambda count, seed: np.tile(TURNED, (count, 1, 1)),
    )  # fmt: skip
    law = key_scans(scans, found, chains=2, seed=0).prior.law(TURNED)
    turn = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.01], [0.0, 0.0, 0.01]])
    assert abs(law.log_prob(TURNED - turn) - law.log_prob(TURNED)) < 0.1
    still = np.zeros((3, 3))
    assert law.log_prob(still) > law.log_prob(still + turn) + 5  # steps that it can have seen right, it still holds
