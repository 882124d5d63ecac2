"""The uncertainty of relative poses of a trajectory."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.planar import between

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class RelativeLaw:
    """Student's t about the relative poses of a trajectory.

    Attributes:
        scales: a function of the numbers of the first and the second pose of N pairs. Returns the scale matrices of x,
            y and yaw of the second pose in the frame of the first, (N, 3, 3).
        dof: degrees of freedom; covariances are dof / (dof - 2) times the scale matrices.
    """

    scales: Callable[[Indices, Indices], Floats]
    dof: float

    def covariances(self, first: Indices, second: Indices) -> Floats:
        """Return covariances of the second poses in the frames of the first, (N, 3, 3)."""
        return self.dof / (self.dof - 2.0) * self.scales(first, second)

    def of_frame(self, poses: Floats, mount: Floats) -> RelativeLaw:
        """Return the law of another frame that is fixed to this one.

        Args:
            poses: of this frame, (S, 3).
            mount: where the other frame is in this one, (3,).
        """

        def scales(first: Indices, second: Indices) -> Floats:
            yaw = between(poses[first], poses[second])[:, 2]
            cosine, sine = np.cos(mount[2]), np.sin(mount[2])
            back = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
            swing = np.tile(np.eye(3), (len(yaw), 1, 1))  # a turn of this frame swings the other one round
            swing[:, 0, 2] = -np.sin(yaw) * mount[0] - np.cos(yaw) * mount[1]
            swing[:, 1, 2] = np.cos(yaw) * mount[0] - np.sin(yaw) * mount[1]
            turn = back @ swing
            return np.asarray(turn @ self.scales(first, second) @ np.swapaxes(turn, 1, 2))

        return RelativeLaw(scales, self.dof)
