"""An approximation of a trajectory made by hand: a round way of key scans, one more scan between two, and a closure."""

import numpy as np

from bayesmap.poses.calibration import ORDINARY_RATES, MotionNoise, OdometryFit
from bayesmap.poses.graph import Factors, PoseStudentT
from bayesmap.poses.trajectory import Calibration, InferredTrajectory, LoopClosures
from bayesmap.space.planar import between, chain_motions, compose

STEP = np.array([0.5, 0.0, np.pi / 8])


def round_way(keys=16, sigma=(0.01, 0.02, 0.005), closure=True, odometry=True, force=0.0, seed=0):
    """Key scans on a circle, each tied to the next and the last to the first; scan 1 lies between key scans.

    ``force`` is that of errors that neighbours have in common; without it the covariances are those of the pairs alone.
    """
    poses = np.vstack([np.zeros(3), chain_motions(np.zeros(3), np.tile(STEP, (keys - 1, 1)))])
    order = np.arange(keys - 1)
    first, second = (np.append(order, 0), np.append(order + 1, keys - 1)) if closure else (order, order + 1)
    relative = between(poses[first], poses[second])
    information = np.tile(np.diag(np.array(sigma) ** -2.0), (len(first), 1, 1))
    pulls = np.random.default_rng(seed).normal(size=(len(first), 3)) * force
    gaussian = PoseStudentT(poses, first, second, relative, information, pulls)
    scans = keys + 1
    at = np.delete(np.arange(scans), 1)
    every = np.insert(poses, 1, compose(poses[0], STEP / 2), axis=0)
    own = np.zeros((scans, 3, 3))
    own[1] = np.diag([0.02, 0.02, 0.01]) ** 2
    step = Factors(order, order + 1, relative[: keys - 1], information[: keys - 1])
    ends = np.array([0], np.intp), np.array([keys], np.intp)
    seen = between(every[:1], every[-1:])
    none = np.empty(0, np.intp)
    fit = OdometryFit(np.full((3, 3), 0.01), 1e-6 * np.eye(9), 0.09, 0.01, MotionNoise(ORDINARY_RATES))
    return InferredTrajectory(
        poses=every, stamps_s=10.0 + np.arange(scans), keys=at, gaussian=gaussian,
        nearest_key=np.insert(np.arange(keys), 1, 0), own_covariance=own, explained=np.ones(scans),
        flagged=np.arange(scans) == 1, breaks=none, leaps=np.array([3], np.intp),
        closures=LoopClosures(*ends, seen, np.zeros((1, 3)), np.ones(1)), order=np.arange(scans),
        calibration=Calibration(1.001, np.linspace(-1, 1, 5), fit if odometry else None,
                                fit.noise.as_odometry(relative) if odometry else None, 0.006),
        odometry=step if odometry else None,
    )  # fmt: skip
