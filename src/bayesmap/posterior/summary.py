"""Summaries of a run: convergence, sizes and timings, and the mean and covariance of each scan's pose."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.posterior.diagnostics import (
    ESS_LIMIT,
    RHAT_LIMIT,
    CellDiagnostics,
    bulk_ess,
    diagnose_cells,
    plain_ess,
    plain_rhat,
    rhat,
    split_chains,
    tail_ess,
)
from bayesmap.posterior.posterior import Posterior
from bayesmap.space.planar import wrapped

Floats = NDArray[np.float64]

FEWEST_DRAWS = 4
"""Fewest draws of a chain with which its halves have a variance."""

CHANCE_SHARE = 0.01
"""Share of the cells that may be over a limit without a warning. With 50 independent draws of each of four chains, one
cell in a thousand has an R-hat over 1.05, and four in a thousand have an estimated effective sample size under 100, by
chance."""


@dataclass(frozen=True)
class Summary:
    """Diagnostics of a run. Numbers that the method does not have are NaN.

    Attributes:
        rhat_log_joint, rhat_log_likelihood: rank-normalised split R-hat over the chains. The likelihood's is the
            sharper test where many cells are unobserved, whose prior draws drown slow changes of the joint.
        ess_log_joint_bulk, ess_log_joint_tail: effective sample sizes of the log joint.
        rhat_max, ess_min: worst over the observed cells that changed.
        unchanged_cells: cells with one value in all draws; they have no R-hat and are counted apart.
        disagreeing_cells: cells that never changed within a chain but differ between chains. Both are of walls, and
            None where a cell's state is a number, which no two draws share.
        rhat_high_cells: observed cells with an R-hat over 1.05, those that disagree included.
        ess_low_cells: observed cells with an effective sample size under 100.
        judged_cells: observed cells that changed, and those that disagree: what the last two are parts of.
        effective_sample_size: of the weights, for importance sampling.
        microseconds_per_sweep: of one chain on one core.
        finished: false if stopped early.
    """

    rhat_log_joint: float
    rhat_log_likelihood: float
    ess_log_joint_bulk: float
    ess_log_joint_tail: float
    rhat_max: float
    ess_min: float
    unchanged_cells: int | None
    disagreeing_cells: int | None
    rhat_high_cells: int
    ess_low_cells: int
    judged_cells: int
    effective_sample_size: float
    microseconds_per_sweep: float
    finished: bool

    def as_json(self) -> dict[str, Any]:
        """Return the diagnostics as JSON values: NaN and infinity become null."""
        return {
            name: None if isinstance(value, float) and not math.isfinite(value) else value
            for name, value in asdict(self).items()
        }

    def __str__(self) -> str:
        """Write one line a diagnostic that the method has, then the problems, if any."""
        lines = []
        for name, value in asdict(self).items():
            if value is None or (isinstance(value, float) and math.isnan(value)):
                continue
            shown = f"{value:.4g}" if isinstance(value, float) else str(value)
            lines.append(f"{name.replace('_', ' '):26} {shown}")
        return "\n".join([*lines, *(f"! {problem}" for problem in self.problems())])

    def problems(self) -> list[str]:
        """Return reasons not to trust the run, in words; empty where there are none."""
        problems = []
        if not self.finished:
            problems.append("the run was stopped before it had finished")
        allowed = CHANCE_SHARE * self.judged_cells
        cells_agree = self.judged_cells > 0 and self.rhat_high_cells <= allowed and not self.disagreeing_cells
        places = ": in some places chains explain the readings differently; cells agree, so take means over all"
        for name, value, remedy in (
            ("log joint", self.rhat_log_joint, ""),
            ("log likelihood", self.rhat_log_likelihood, places if cells_agree else ""),
        ):
            if value > RHAT_LIMIT:
                problems.append(f"R-hat of the {name} is {value:.3f}, over {RHAT_LIMIT}{remedy}")
        if self.rhat_max > RHAT_LIMIT and self.rhat_high_cells > allowed:
            worst = f"the worst is {self.rhat_max:.3f}"
            problems.append(f"R-hat of {self.rhat_high_cells} cells is over {RHAT_LIMIT}; {worst}")
        if self.disagreeing_cells:
            problems.append(f"{self.disagreeing_cells} cells are stuck at different values in different chains")
        if self.ess_low_cells > allowed:
            least = f"the least is {self.ess_min:.0f}"
            problems.append(f"effective sample size of {self.ess_low_cells} cells is under {ESS_LIMIT:.0f}; {least}")
        swept = not math.isnan(self.microseconds_per_sweep)
        if self.finished and swept and math.isnan(self.rhat_log_joint):
            problems.append(f"nothing can be judged: under {FEWEST_DRAWS} draws of each chain, or none that differ")
        if self.effective_sample_size < ESS_LIMIT:
            problems.append(f"importance sampling has an effective sample size of {self.effective_sample_size:.1f}")
        return problems


def summarise(posterior: Posterior) -> Summary:
    """Compute the diagnostics of a run."""
    nan = float("nan")
    markov, log_joint = posterior.has_chains, posterior.log_joint
    chains, draws = log_joint.shape
    enough = markov and draws >= FEWEST_DRAWS
    weights = posterior.log_weights
    sweeps = posterior.sweep * max(1, chains)
    threads = int(posterior.settings.get("threads_used", 1))
    cells = CellDiagnostics(nan, nan, 0, 0, 0, 0, 0)
    if markov:
        cells = diagnose_cells(posterior.prior, posterior.draws, posterior.observed)
    return Summary(
        rhat_log_joint=rhat(log_joint) if enough else nan,
        rhat_log_likelihood=rhat(posterior.log_likelihood) if enough else nan,
        ess_log_joint_bulk=bulk_ess(log_joint) if enough else nan,
        ess_log_joint_tail=tail_ess(log_joint) if enough else nan, rhat_max=cells.rhat_max, ess_min=cells.ess_min,
        unchanged_cells=cells.unchanged, disagreeing_cells=cells.disagreeing, rhat_high_cells=cells.high,
        ess_low_cells=cells.low, judged_cells=cells.judged,
        effective_sample_size=float(1.0 / np.exp(2 * weights).sum()) if weights is not None else nan,
        microseconds_per_sweep=1e6 * posterior.seconds["sampling"] * threads / sweeps if markov and sweeps else nan,
        finished=posterior.finished,
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class PoseSummary:
    """The posterior of each scan's pose, by its moments.

    Attributes:
        mean: in the world frame, (S, 3); of headings the circular mean.
        covariance: of x, y and yaw, (S, 3, 3), metres and radians.
        rhat: split R-hat of the three, (S, 3); NaN with fewer than four draws a chain, or of a pose that never moved.
        ess: effective sample size of each part, (S, 3).
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
        """The largest R-hat; infinite where chains of a pose are too short for one, or disagree."""
        return float(np.where(np.isfinite(self.rhat), self.rhat, np.inf)[self._free].max(initial=1.0))

    @property
    def ess_min(self) -> float:
        """The least effective sample size; zero where a pose has none."""
        return float(np.where(np.isfinite(self.ess), self.ess, 0.0)[self._free].min(initial=np.inf))

    @property
    def mixed(self) -> bool:
        """Whether the draws tell the uncertainty of the poses: R-hats up to 1.05, effective sample sizes over 100."""
        return self.rhat_max <= RHAT_LIMIT and self.ess_min >= ESS_LIMIT

    @property
    def _free(self) -> NDArray[np.bool_]:
        """Return the scans that can have moved: the first may be the frame of the map."""
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
