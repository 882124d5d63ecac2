"""Two trajectories of one log, from every other beam each: how far apart they should be.

They share odometry and no beam. So what odometry has wrong moves both alike, and their difference has the covariance of
the laser's errors alone: with H the precision of a trajectory and L the laser's part of it, H^-1 L H^-1, and of what
pairs of scans have wrong in common.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.graph import PoseStudentT, Quadratic, normal_equations
from bayesmap.poses.trajectory import InferredTrajectory
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]


def every_other_beam(scans: Scans, first: int) -> Scans:
    """The scans with every second beam."""
    return Scans(scans.poses, scans.angles_rad[first::2], scans.ranges_m[:, first::2], max_range_m=scans.max_range_m,
                 min_range_m=scans.min_range_m, stamps_s=scans.stamps_s)  # fmt: skip


def difference_scales(
    one: InferredTrajectory, other: InferredTrajectory, first: NDArray[np.intp], second: NDArray[np.intp]
) -> Floats:
    """Scale matrices of what relative poses of pairs of scans differ by, (N, 3, 3)."""
    return _laser_alone(one).relative_scales(first, second) + _laser_alone(other).relative_scales(first, second)


@dataclass(frozen=True, eq=False)
class _Dense:
    """A covariance matrix, asked as `bayesmap.poses.graph.Precision` is for its inverse."""

    covariance: Floats

    def blocks(self, first: NDArray[np.intp], second: NDArray[np.intp]) -> Floats:
        poses = len(self.covariance) // 3
        return np.asarray(self.covariance.reshape(poses, 3, poses, 3)[first, :, second, :])


@dataclass(frozen=True, eq=False)
class _LaserAlone(PoseStudentT):
    """A Gaussian of which the first so many parts are the laser's; covariances are what their errors make."""

    laser: int = 0
    of_all: PoseStudentT | None = None

    @cached_property
    def bends(self) -> Floats:
        """What the laser's parts have wrong in common, as in the whole."""
        assert self.of_all is not None
        return self.of_all.bends

    @cached_property
    def precision(self) -> Any:
        """Of the laser's noise alone."""
        count, own = len(self.poses), slice(self.laser)
        zero = np.zeros_like(self.relative)
        parts = (
            Quadratic(self.first, self.second, self.relative, self.curvature, zero),
            Quadratic(self.first[own], self.second[own], self.relative[own], self.curvature[own], zero[own]),
        )
        whole, laser = (normal_equations(count, [part])[0].toarray() for part in parts)
        inverse = np.linalg.inv(whole)
        return _Dense(inverse @ laser @ inverse)


def _laser_alone(found: InferredTrajectory) -> InferredTrajectory:
    gaussian = found.gaussian
    laser = len(gaussian.first) - (0 if found.odometry is None else len(found.odometry))
    fields = {name: getattr(gaussian, name) for name in ("poses", "first", "second", "relative", "curvature", "force")}
    return replace(found, gaussian=_LaserAlone(**fields, laser=laser, of_all=gaussian))
