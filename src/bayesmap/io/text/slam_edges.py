"""The pose graph of a trajectory that `bayesmap.slam` found: what ties its scans together, and how firmly."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.io.text.g2o_writer import Edges
from bayesmap.poses.pose_gaussian import PoseGaussian
from bayesmap.poses.precision import relative_covariances
from bayesmap.poses.se2 import between_jacobians
from bayesmap.poses.trajectory import Trajectory
from bayesmap.space.planar import between

Floats = NDArray[np.float64]

LEAST = 1e-3
"""Information, 1 / m^2 and 1 / rad^2, of what an edge says nothing of: programs want matrices that can be inverted."""

SAMPLED, SEED = 300, 1
"""Pairs of key scans over which it is seen how much more uncertain errors in common make them."""


def slam_edges(found: Trajectory) -> Edges:
    """All pairs of key scans that the laser or odometry ties together, and each scan between with its key scan.

    Informations are the curvatures of the cost, divided by what makes normal covariances of those of Student's t, and
    by how much larger errors that pairs have in common make covariances, on average: a graph cannot say those.
    """
    gaussian, keys = found.gaussian, found.keys
    of_student = gaussian.dof / (gaussian.dof - 2.0)
    values, vectors = np.linalg.eigh(gaussian.curvature / (of_student * _shared(gaussian)))
    information = (vectors * np.maximum(values, LEAST)[:, None, :]) @ np.swapaxes(vectors, 1, 2)
    others = np.setdiff1d(np.arange(len(found)), keys)
    nearest = keys[found.nearest_key[others]]
    beside = between(found.poses[nearest], found.poses[others])
    _, by_other = between_jacobians(beside)
    own = of_student * by_other @ found.own_covariance[others] @ np.swapaxes(by_other, 1, 2)
    return Edges(
        np.concatenate([keys[gaussian.first], nearest]),
        np.concatenate([keys[gaussian.second], others]),
        np.concatenate([gaussian.relative, beside]),
        np.concatenate([information, np.linalg.inv(own + 1e-12 * np.eye(3))]),
    )


def _shared(gaussian: PoseGaussian) -> float:
    """How many times larger covariances of relative poses are with errors in common than without, geometric mean."""
    rng = np.random.default_rng(SEED)
    first, second = rng.integers(0, len(gaussian.poses), (2, SAMPLED))
    first, second = first[first != second], second[first != second]
    if not len(first):
        return 1.0
    alone = relative_covariances(gaussian.precision, gaussian.poses, first, second)
    together = gaussian.relative_covariances(first, second)
    grown = np.linalg.slogdet(together)[1] - np.linalg.slogdet(alone)[1]
    return float(np.exp(grown.mean() / 3.0))
