"""Summaries of a run: convergence of chains, sizes and timings, and the mean and covariance of each scan's pose.

Split R-hat and effective sample size are those of Vehtari, Gelman, Simpson, Carpenter and Buerkner,
*Rank-normalization, folding, and localization: an improved R-hat* (Bayesian Analysis, 2021), for many cells at once.
The tests check them against arviz-stats, which takes some milliseconds for each of the hundred thousand cells of a map.
A binary quantity needs no ranks: its rank-normalised values are an affine image of it, and affine maps do not change
these diagnostics. `summarise` and `summarise_poses` compute the summaries, by the functions before them.
"""

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy import special

from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.posterior.posterior import Posterior
from bayesmap.run.chains import PRECISION, map_error
from bayesmap.space.arrays import Floats, Mask
from bayesmap.space.planar import wrap_angle

RHAT_LIMIT, ESS_LIMIT = 1.05, 100.0  # over this R-hat chains have not mixed; under this size means are too noisy
BATCH_CELLS = 4096  # cells whose traces are in memory together
MIN_DRAWS_PER_CHAIN = 4  # fewest draws of a chain with which its halves have a variance
# Share of the cells that may be over a limit without a warning. With 50 independent draws of each of four chains, one
# cell in a thousand has an R-hat over 1.05, and four in a thousand an effective sample size under 100, by chance.
CHANCE_SHARE = 0.01
MORE_DRAWS = "infer more draws (--draws of infer and slam; in Python Schedule(draws=...))"  # a remedy
MAX_ERROR_RATIO = 1.5  # largest ratio of error to a requested precision without a warning: slow cells fall short
VISIBLE_ERROR = 0.1  # on a grey map; a smaller error is no warning by default, for more draws help slow cells little
LEGEND = """R-hat compares chains with one another: 1 is equal, and over 1.05 they have not mixed. A cell that
changed only once in one chain has a large R-hat. The map is judged by the error of its mean, not by single cells."""


def split_chains(values: Floats) -> Floats:
    """Split each chain into its first and last half: (C, D, ...) to (2 C, D // 2, ...)."""
    half = values.shape[1] // 2
    return np.concatenate([values[:, :half], values[:, values.shape[1] - half :]])


def rank_normalise(values: Floats) -> Floats:
    """Return the normal scores of the ranks of values, (C, D), over all chains."""
    _, group, count = np.unique(values, return_inverse=True, return_counts=True)
    ranks = (np.cumsum(count) - (count - 1) / 2)[group].reshape(values.shape)  # ties share their mean rank
    return np.asarray(special.ndtri((ranks - 0.375) / (values.size + 0.25)))


def plain_rhat(chains: Floats) -> Floats:
    """Compute R-hat of (chains, draws, ...), not split: NaN if all values are equal, inf if only within chains."""
    n_draws = chains.shape[1]
    within = chains.var(axis=1, ddof=1).mean(axis=0)
    between = chains.mean(axis=1).var(axis=0, ddof=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.sqrt((n_draws - 1) / n_draws + between / within))


def rhat(values: Floats) -> float:
    """Compute the rank-normalised split R-hat of (C, D), the larger of bulk and folded; NaN below 4 draws a chain."""
    if values.shape[1] < MIN_DRAWS_PER_CHAIN:
        return float("nan")
    halves = split_chains(values)
    folded = np.abs(halves - np.median(halves))
    return float(np.fmax(plain_rhat(rank_normalise(halves)), plain_rhat(rank_normalise(folded))))


def plain_ess(chains: Floats) -> Floats:
    """Compute the effective sample size of (chains, draws, ...), not split, by Geyer's initial monotone sequence."""
    m, n = chains.shape[:2]
    flat = chains.reshape(m, n, -1)
    # Autocovariances of every chain, by fast Fourier transforms, padded so that they do not wrap around.
    centred = flat - flat.mean(axis=1, keepdims=True)
    length = 1 << (2 * n - 1).bit_length()
    spectrum = np.fft.rfft(centred, length, axis=1)
    autocovariance = np.fft.irfft(np.abs(spectrum) ** 2, length, axis=1)[:, :n] / n  # (m, n, cells)
    within = autocovariance[:, 0].mean(axis=0) * n / (n - 1)
    variance = within * (n - 1) / n
    if m > 1:
        variance = variance + flat.mean(axis=1).var(axis=0, ddof=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        rho = 1.0 - (within - autocovariance.mean(axis=0)) / variance  # (n, cells)
    rho[0] = 1.0
    # Geyer: add up neighbouring pairs, made monotone, until one is not positive. This pair adds its even lag alone.
    pairs = max(1, (n - 1) // 2)
    even, odd = rho[0 : 2 * pairs : 2], rho[1 : 2 * pairs : 2]
    sums = even + odd
    positive = sums > 0
    stop = np.where(positive.all(axis=0), pairs - 1, np.argmin(positive, axis=0))
    monotone = np.minimum.accumulate(sums, axis=0)
    tau = -1.0 + 2.0 * np.where(np.arange(pairs)[:, None] < stop, monotone, 0.0).sum(axis=0)
    even_at_stop = np.take_along_axis(even, stop[None], axis=0)[0]
    tau += np.where(positive.all(axis=0), even_at_stop, np.maximum(even_at_stop, 0.0))
    tau = np.maximum(tau, 1.0 / np.log10(m * n))
    return np.asarray(m * n / tau).reshape(chains.shape[2:])


def bulk_ess(values: Floats) -> float:
    """Compute the bulk effective sample size of one quantity, (chains, draws). NaN below four draws a chain."""
    if values.shape[1] < MIN_DRAWS_PER_CHAIN:
        return float("nan")
    return float(plain_ess(rank_normalise(split_chains(values))))


def tail_ess(values: Floats) -> float:
    """Compute the tail effective sample size of (C, D): the lesser of the indicators' at the 5 % and 95 % quantiles."""
    if values.shape[1] < MIN_DRAWS_PER_CHAIN:
        return float("nan")
    quantiles = np.quantile(values, [0.05, 0.95])
    indicators = [split_chains((values <= quantile).astype(np.float64)) for quantile in quantiles]
    # An indicator without variation, as short chains have, counts as fully effective: the other one decides.
    return float(min(halves.size if halves.min() == halves.max() else plain_ess(halves) for halves in indicators))


@dataclass(frozen=True)
class CellDiagnostics:
    """The convergence of the cells of a map: `Summary` documents the fields."""

    rhat_max: float
    ess_min: float
    unchanged_cells: int | None
    disagreeing_cells: int | None
    rhat_high_cells: int
    ess_low_cells: int
    judged_cells: int


def diagnose_cells(prior: CellPrior, draws: Draws, observed: Mask) -> CellDiagnostics:
    """Compute R-hat and effective sample size of the cells of a run, as their maps show them, not rank-normalised.
    Only ``observed`` cells, (nx, ny), are judged: the worst of a hundred thousand prior draws is bad by chance.
    """
    constant, agreed = prior.constant_cells(draws)
    changed = np.flatnonzero(observed.ravel())
    n_disagreeing = 0
    n_unchanged: int | None = None
    if constant is not None and agreed is not None:
        n_disagreeing = int((constant & ~agreed & observed.ravel()).sum())
        changed, n_unchanged = np.flatnonzero(observed.ravel() & ~constant), int(agreed.sum())
    rhats, sizes = [np.zeros(0)], [np.zeros(0)]
    if draws.count >= MIN_DRAWS_PER_CHAIN:
        for i in range(0, len(changed), BATCH_CELLS):
            halves = split_chains(prior.traces(draws, changed[i : i + BATCH_CELLS]).astype(np.float64))
            varies = np.ptp(halves.reshape(-1, halves.shape[-1]), axis=0) > 0
            if varies.any():
                rhats.append(plain_rhat(halves[..., varies]))
                sizes.append(plain_ess(halves[..., varies]))
    rhat_of_cell, ess_of_cell = np.concatenate(rhats), np.concatenate(sizes)
    return CellDiagnostics(
        rhat_max=float(np.fmax.reduce(rhat_of_cell, initial=np.nan)),
        ess_min=float(np.fmin.reduce(ess_of_cell, initial=np.nan)), unchanged_cells=n_unchanged,
        disagreeing_cells=None if n_unchanged is None else n_disagreeing,
        rhat_high_cells=n_disagreeing + int((rhat_of_cell > RHAT_LIMIT).sum()),
        ess_low_cells=int((ess_of_cell < ESS_LIMIT).sum()), judged_cells=n_disagreeing + len(rhat_of_cell),
    )  # fmt: skip


@dataclass(frozen=True)
class Summary(CellDiagnostics):
    """Diagnostics of a run. Numbers that the method does not have are NaN.

    Attributes:
        rhat_log_joint, rhat_log_likelihood: rank-normalised split R-hat over the chains. If many cells are unobserved,
            the likelihood's is the sharper test: prior draws hide slow changes of the joint.
        ess_log_joint_bulk, ess_log_joint_tail: effective sample sizes of the log joint.
        rhat_max, ess_min: largest split R-hat and least effective sample size of the observed cells that changed.
        unchanged_cells: cells with one value in all draws, which have no R-hat.
        disagreeing_cells: observed cells that never changed within a chain but differ between chains. This and
            ``unchanged_cells`` are None if a cell's state is a real number.
        map_error: Monte Carlo standard error of the mean map that 99 of 100 observed cells stay under, by batches and
            chains (`bayesmap.run.chains.map_error`). The run is judged by it.
        precision: the requested ``map_error``.
        rhat_high_cells: observed cells with an R-hat over 1.05, and those that disagree.
        ess_low_cells: observed cells with an effective sample size under 100.
        judged_cells: observed cells that changed, and those that disagree.
        effective_sample_size: of the weights, for importance sampling.
        microseconds_per_sweep: of one chain on one core.
        finished: false if stopped early.
    """

    rhat_log_joint: float
    rhat_log_likelihood: float
    ess_log_joint_bulk: float
    ess_log_joint_tail: float
    map_error: float
    precision: float
    effective_sample_size: float
    microseconds_per_sweep: float
    finished: bool

    def as_json(self) -> dict[str, Any]:
        """Return the diagnostics as JSON values: NaN and infinity become null."""
        return {name: None if isinstance(x, float) and not math.isfinite(x) else x for name, x in asdict(self).items()}

    def __str__(self) -> str:
        """Return strengths, problems, the figures in words, and their meaning, a line each."""
        lines = [f"good: {strength}" for strength in self.strengths()]
        lines += [f"doubtful: {problem}" for problem in self.problems()]
        if not math.isnan(self.rhat_log_joint):
            lines += [
                f"R-hat: {self.rhat_log_joint:.3f} of the log joint, {self.rhat_log_likelihood:.3f} of the likelihood",
                f"effective sample size of the log joint: {self.ess_log_joint_bulk:,.0f} in its middle, "
                f"{self.ess_log_joint_tail:,.0f} in its tails",
            ]
        if not math.isnan(self.rhat_max):
            lines.append(
                f"observed cells that changed: {self.judged_cells - (self.disagreeing_cells or 0):,}; R-hat is over "
                f"{RHAT_LIMIT} in {self.rhat_high_cells:,}, the effective sample size is under {ESS_LIMIT:.0f} in "
                f"{self.ess_low_cells:,}; the worst cell has {self.rhat_max:.3g} and {self.ess_min:,.0f}"
            )
        if self.unchanged_cells is not None and not math.isnan(self.precision):
            lines.append(
                f"cells with one value in all draws: {self.unchanged_cells:,}; in each chain, but not the same in all: "
                f"{self.disagreeing_cells:,}"
            )
        if not math.isnan(self.microseconds_per_sweep):
            lines.append(f"one sweep of one chain: {self.microseconds_per_sweep:,.0f} microseconds on one core")
        if not math.isnan(self.rhat_log_joint):
            lines.append(LEGEND)
        return "\n".join(lines)

    @property
    def good_error(self) -> float:
        """The largest error of the mean map without a warning."""
        return max(MAX_ERROR_RATIO * self.precision, VISIBLE_ERROR if self.precision >= PRECISION else 0.0)

    def strengths(self) -> list[str]:
        """Return the good results of the diagnostics, in words with figures; empty if there are none."""
        strengths = []
        if self.map_error <= self.good_error:
            limit = f" (good up to {self.good_error:g})" if self.precision < math.inf else ""
            limit += "" if self.map_error <= self.precision else f"; {self.precision:g} takes more draws"
            strengths.append(f"the mean map is known to {self.map_error:.3f} in 99 of 100 observed cells{limit}")
        if self.rhat_log_likelihood <= RHAT_LIMIT:
            strengths.append(f"the chains agree: R-hat of the log likelihood is {self.rhat_log_likelihood:.3f}")
        if self.effective_sample_size >= ESS_LIMIT:
            strengths.append(f"the particles are worth {self.effective_sample_size:,.0f} independent draws")
        return strengths

    def problems(self) -> list[str]:
        """Return the doubtful results of the diagnostics, each with a remedy, in words; empty if there are none."""
        problems = []
        if not self.finished:
            problems.append("the run was stopped before it had finished: resume it")
        if self.disagreeing_cells and self.disagreeing_cells > CHANCE_SHARE * self.judged_cells:
            problems.append(
                f"{self.disagreeing_cells} cells are stuck at different values in different chains: warm up longer "
                "(--warmup), or use method 'block'"
            )
        if self.good_error < self.map_error < math.inf:
            problems.append(
                f"the mean map is known to {self.map_error:.3f} in 99 of 100 observed cells, which is good up to "
                f"{self.good_error:g}: {MORE_DRAWS}"
            )
        has_sweeps = not math.isnan(self.microseconds_per_sweep)
        if self.finished and has_sweeps and math.isnan(self.rhat_log_joint):
            problems.append(
                f"nothing can be judged: under {MIN_DRAWS_PER_CHAIN} draws of each chain, or none that differ; "
                f"{MORE_DRAWS}"
            )
        if self.effective_sample_size < ESS_LIMIT:
            ess = self.effective_sample_size
            problems.append(f"importance sampling has an effective sample size of {ess:.1f}: use 'gibbs'")
        return problems


def summarise(posterior: Posterior) -> Summary:
    """Compute the diagnostics of a run."""
    nan = float("nan")
    has_chains, log_weights = posterior.has_chains, posterior.log_weights
    # Independent draws have no diagnostics of chains.
    selected = slice(None if has_chains else 0)
    log_joint, log_likelihood = posterior.log_joint[:, selected], posterior.log_likelihood[:, selected]
    n_chains, n_draws = log_joint.shape
    n_sweeps = posterior.sweep * max(1, n_chains)
    threads = int(posterior.settings.get("threads_used", 1))
    cells = CellDiagnostics(nan, nan, 0, 0, 0, 0, 0)
    if has_chains:
        cells = diagnose_cells(posterior.prior, posterior.draws, posterior.observed)
    enough = n_draws >= MIN_DRAWS_PER_CHAIN
    sweep_us = 1e6 * posterior.seconds["sampling"] * threads / n_sweeps if has_chains and n_sweeps else nan
    return Summary(
        **vars(cells), rhat_log_joint=rhat(log_joint), rhat_log_likelihood=rhat(log_likelihood),
        ess_log_joint_bulk=bulk_ess(log_joint), ess_log_joint_tail=tail_ess(log_joint),
        map_error=map_error(posterior.prior, posterior.draws, posterior.observed) if enough else nan,
        precision=(posterior.settings.get("precision") or PRECISION) if has_chains else nan,
        effective_sample_size=float(1.0 / np.exp(2 * log_weights).sum()) if log_weights is not None else nan,
        microseconds_per_sweep=sweep_us, finished=posterior.finished,
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class PoseSummary:
    """The mean and covariance of each scan's pose, ``by_approximation`` if chains have not mixed, and the mixing."""

    mean: Floats  # mean in the world frame, (S, 3), with the circular mean of headings
    covariance: Floats  # covariance of x, y and yaw, (S, 3, 3), metres and radians
    rhat: Floats  # split R-hat of x, y and yaw, (S, 3); NaN below four draws a chain, or if a pose never moved
    ess: Floats  # effective sample size of x, y and yaw, (S, 3)
    by_approximation: bool = False  # whether mean and covariance come from the approximation that chains started from

    def __repr__(self) -> str:
        """Return four lines: size, standard deviations, mixing, and source."""
        sigmas = np.stack([self.sigma_m, np.degrees(self.sigma_rad)])
        sigma_m, sigma_deg = np.nanmedian(sigmas, axis=1) if len(self.mean) else (np.nan, np.nan)
        mixing = f"largest R-hat {self.rhat_max:.3f}, least effective sample size {self.ess_min:,.0f}"
        if np.isnan(self.rhat).all():
            mixing = "not known, since no pose moved or there are too few draws"
        source = "the approximation that chains started from" if self.by_approximation else "draws"
        return (
            f"PoseSummary: {len(self.mean):,} poses\n"
            f"  median standard deviation: {sigma_m:.2g} m, {sigma_deg:.2g} degrees\n"
            f"  mixing: {mixing}\n  by: {source}"
        )

    @property
    def rhat_max(self) -> float:
        """The largest R-hat, or infinity if chains are too short for one, or if the chains of a pose disagree."""
        return float(np.where(np.isfinite(self.rhat), self.rhat, np.inf)[self._free].max(initial=1.0))

    @property
    def ess_min(self) -> float:
        """The least effective sample size; zero if a pose has none."""
        return float(np.where(np.isfinite(self.ess), self.ess, 0.0)[self._free].min(initial=np.inf))

    @property
    def mixed(self) -> bool:
        """True if the draws show the uncertainty of the poses: R-hats up to 1.05, effective sample sizes over 100."""
        return self.rhat_max <= RHAT_LIMIT and self.ess_min >= ESS_LIMIT

    @property
    def _free(self) -> Mask:
        """Mask of the scans whose poses can move, (S,): the first pose may be the frame of the map."""
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
    """Compute means, covariances and mixing of draws of poses, (chains, draws, S, 3)."""
    flat = poses.reshape(-1, *poses.shape[2:])  # poses of all chains
    heading = np.arctan2(np.sin(flat[..., 2]).mean(axis=0), np.cos(flat[..., 2]).mean(axis=0))
    mean = np.concatenate([flat[..., :2].mean(axis=0), heading[:, None]], axis=-1)
    errors = poses - mean
    errors[..., 2] = wrap_angle(errors[..., 2])
    flat_errors = errors.reshape(flat.shape)
    covariance = np.einsum("dsi,dsj->sij", flat_errors, flat_errors) / max(len(flat) - 1, 1)
    rhat = ess = np.full(mean.shape, np.nan)
    if poses.shape[1] >= MIN_DRAWS_PER_CHAIN:
        halves = split_chains(errors)
        rhat, ess = plain_rhat(halves), plain_ess(halves)
    return PoseSummary(mean, covariance, rhat, ess)
