"""What draws of poses say of each scan's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.posterior.diagnostics import plain_ess, plain_rhat, split_chains
from bayesmap.space.planar import wrapped

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PoseSummary:
    """The posterior of each scan's pose, by its moments.

    Attributes:
        mean: in the world frame, (S, 3); of headings the circular mean.
        covariance: of x, y and yaw, (S, 3, 3), metres and radians.
        rhat: split R-hat of the three, (S, 3); NaN with fewer than four draws a chain, or of a pose that never moved.
        ess: effective sample size likewise.
    """

    mean: Floats
    covariance: Floats
    rhat: Floats
    ess: Floats

    @property
    def sigma_m(self) -> Floats:
        """Standard deviation of the position along the long axis of its ellipse, metres, (S,)."""
        return np.asarray(np.sqrt(np.linalg.eigvalsh(self.covariance[:, :2, :2])[:, 1]))

    @property
    def sigma_rad(self) -> Floats:
        """Standard deviation of the heading, radians, (S,)."""
        return np.asarray(np.sqrt(self.covariance[:, 2, 2]))


def summarise_poses(poses: Floats) -> PoseSummary:
    """Summarise draws of poses, (chains, draws, S, 3)."""
    flat = poses.reshape(-1, *poses.shape[2:])
    heading = np.arctan2(np.sin(flat[..., 2]).mean(axis=0), np.cos(flat[..., 2]).mean(axis=0))
    mean = np.concatenate([flat[..., :2].mean(axis=0), heading[:, None]], axis=-1)
    error = poses - mean
    error[..., 2] = wrapped(error[..., 2])
    every = error.reshape(-1, *poses.shape[2:])
    covariance = np.einsum("dsi,dsj->sij", every, every) / max(len(every) - 1, 1)
    rhat = ess = np.full(mean.shape, np.nan)
    if poses.shape[1] >= 4:
        halves = split_chains(error)
        rhat, ess = plain_rhat(halves), plain_ess(halves)
    return PoseSummary(mean, covariance, rhat, ess)
