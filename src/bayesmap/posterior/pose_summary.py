"""What draws of poses say of each scan's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.posterior.diagnostics import ESS_LIMIT, RHAT_LIMIT, plain_ess, plain_rhat, split_chains
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
        by_approximation: whether mean and covariance are those of the approximation that chains started from, because
            the draws of chains that have not mixed are far too alike.
    """

    mean: Floats
    covariance: Floats
    rhat: Floats
    ess: Floats
    by_approximation: bool = False

    @property
    def rhat_max(self) -> float:
        """The largest R-hat; infinite where a pose that chains disagree on, or are too short for, has none."""
        return float(np.where(np.isfinite(self.rhat), self.rhat, np.inf)[self._free].max(initial=1.0))

    @property
    def ess_min(self) -> float:
        """The least effective sample size; zero where a pose has none."""
        return float(np.where(np.isfinite(self.ess), self.ess, 0.0)[self._free].min(initial=np.inf))

    @property
    def mixed(self) -> bool:
        """Whether the draws tell how sure the poses are: R-hats of at most 1.05, effective sample sizes over 100."""
        return self.rhat_max <= RHAT_LIMIT and self.ess_min >= ESS_LIMIT

    @property
    def _free(self) -> NDArray[np.bool_]:
        """Scans that can have moved: the first may be the frame of the map."""
        free = np.ones(len(self.mean), dtype=np.bool_)
        free[:1] = not np.isnan(self.rhat[:1]).all() or len(free) == 1
        return free

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
