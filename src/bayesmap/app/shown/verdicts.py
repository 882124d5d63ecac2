"""Verdicts on results: whether chains, or weighted particles, represent the posterior well.

`judge_chains` and `judge_particles` give the verdicts by `VerdictLimits`. The functions before them compute what the
verdict on chains depends on. The page's figures repeat these rules in TypeScript (page/src/figure).
"""

import math
from dataclasses import dataclass

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from bayesmap.app.protocol.notices import Verdict
from bayesmap.posterior.summary import CHANCE_SHARE, RHAT_LIMIT, bulk_ess, rhat
from bayesmap.space.planar import Floats


class VerdictLimits(Struct, frozen=True):
    """The limits by which chains and particles are judged. R-hat and effective sample size: Vehtari et al. (2021)."""

    rhat_limit: float = RHAT_LIMIT  # R-hat over this is bad
    good_rhat: float = 1.01  # R-hat up to this is good
    good_ess: float = 400.0  # this many effective draws make R-hat reliable
    bad_ess: float = 50.0  # fewer effective draws are bad
    fewest_sweeps: int = 200  # fewest sweeps for a verdict on running chains, and for a comparison of their means
    fewest_diagnosed: int = 4  # R-hat needs two draws in each half of a chain
    bad_difference: float = 0.25  # a cell's means in two chains differ: 5 standard errors of 200 draws at p = 1/2
    misfit_sigmas: float = 4.0  # one of 30 000 true maps has a larger misfit
    chance_share: float = CHANCE_SHARE  # share of the cells in which means of chains may differ by more


VERDICT_LIMITS = VerdictLimits()


def rhat_and_ess(log_joint: Floats) -> tuple[float, float]:
    """Return R-hat and effective sample size of a trace, (chains, n); NaN if the log joint never changed."""
    constant = log_joint.size == 0 or float(np.ptp(log_joint)) == 0.0
    return (math.nan, math.nan) if constant else (rhat(log_joint), bulk_ess(log_joint))


@dataclass(frozen=True)
class Difference:
    """Differences between the mean maps of chains."""

    largest: float  # largest difference
    cell: tuple[int, int]  # cell with the largest difference
    n_bad: int  # number of cells with a difference over `VerdictLimits.bad_difference`
    n_compared: int  # number of cells compared


def compare_means(means: Floats, mask: NDArray[np.bool_]) -> Difference | None:
    """Compare the mean maps of chains, (chains, nx, ny), in the cells of a mask, (nx, ny); None without any."""
    if len(means) < 2 or not mask.any():
        return None
    ranges = np.where(mask, np.ptp(means, axis=0), 0.0)
    i, j = np.unravel_index(np.argmax(ranges), ranges.shape)
    n_bad = int((ranges > VERDICT_LIMITS.bad_difference).sum())
    return Difference(float(ranges[i, j]), (int(i), int(j)), n_bad, int(mask.sum()))


def misfit_of(log_likelihood: Floats, sigma_m: float, n_beams: int) -> float | None:
    """Return by how much maps contradict readings with normal noise: a posterior predictive check.

    The squared differences between readings and map, over the noise's variance, sum to a chi-squared variable if the
    map is true. Its upper limit is approximated by Wilson and Hilferty's formula. ``log_likelihood`` has a number for
    each draw, (chains, n). Returns the root mean square of the differences of the worst chain, in standard deviations
    of the noise; None if no chain is over the limit, or without draws.
    """
    if not n_beams or not log_likelihood.size:
        return None
    max_log_likelihood = -n_beams * math.log(sigma_m * math.sqrt(2 * math.pi))  # if readings equal the map
    chi_squared = 2 * (max_log_likelihood - float(log_likelihood.mean(axis=1).min()))
    variance = 2 / (9 * n_beams)  # variance of the cube root of a chi-squared variable over its mean
    limit = n_beams * (1 - variance + VERDICT_LIMITS.misfit_sigmas * math.sqrt(variance)) ** 3
    return math.sqrt(chi_squared / n_beams) if chi_squared > limit else None


def judge_chains(
    joint_rhat: float, ess: float, sweeps: int, difference: Difference | None, *, ended: bool = False,
    quantity: str = "P(wall)", misfit: float | None = None,
) -> Verdict | None:  # fmt: skip
    """Return the verdict on chains, or None if it is too early.

    Chains that have ended (finished, cancelled or saved) get a verdict even after few sweeps. Means of few draws differ
    by chance, so then only the log joint is judged. As in the summary of a run, one cell in a hundred may differ.
    ``joint_rhat`` and ``ess`` are from `rhat_and_ess`, ``difference`` is from `compare_means`, and ``misfit`` from
    `misfit_of`. ``quantity`` names the means that are compared.
    """
    early = sweeps < VERDICT_LIMITS.fewest_sweeps
    if early and not ended:
        return None
    # Do the chains disagree, on the map or on the log joint?
    if difference is not None and difference.n_bad > VERDICT_LIMITS.chance_share * difference.n_compared and not early:
        x, y = difference.cell
        share = f"{difference.n_bad:,} of {difference.n_compared:,} observed cells"
        extent = f"in {share}, most in cell ({x}, {y}), by {difference.largest:.2f}"
        why = f"{quantity} differs by over {VERDICT_LIMITS.bad_difference} between the chains {extent}"
        return Verdict("bad", why, difference.cell)
    if 0 < sweeps < VERDICT_LIMITS.fewest_diagnosed:
        return Verdict("bad", f"{sweeps} {'sweep is' if sweeps == 1 else 'sweeps are'} too few to judge")
    if joint_rhat > VERDICT_LIMITS.rhat_limit:
        return Verdict("bad", f"R-hat is {joint_rhat:.3f}, over {VERDICT_LIMITS.rhat_limit}")
    # Do they agree on maps that do not fit the readings?
    if misfit is not None:
        why = f"the chains agree, but on maps that the readings contradict: they differ by {misfit:.3g} times the noise"
        return Verdict("bad", why)
    # Are there enough effective draws?
    if not (np.isfinite(joint_rhat) and np.isfinite(ess)):
        why = "nothing varies: the log joint is the same in all draws of all chains"
        return Verdict("fair" if difference is None else "good", why)
    if ess < VERDICT_LIMITS.bad_ess:
        return Verdict("bad", f"only {ess:.0f} effective draws")
    if joint_rhat > VERDICT_LIMITS.good_rhat or ess < VERDICT_LIMITS.good_ess:
        good_values = f"{VERDICT_LIMITS.good_rhat} and {VERDICT_LIMITS.good_ess:.0f} are good"
        return Verdict("fair", f"R-hat {joint_rhat:.3f} and {ess:.0f} effective draws; {good_values}")
    return Verdict("good", f"R-hat {joint_rhat:.3f}, {ess:.0f} effective draws")


def judge_shifted_chains(verdict: Verdict | None, log_joint: Floats, sweeps: int, shifts: Floats) -> Verdict | None:
    """Correct a bad verdict on chains at several shifts: only chains at one shift must agree. Others stay unchanged.
    ``log_joint`` is (chains, n). ``shifts`` are the shifts of map and sensors together, in cells, (chains, 2).
    """
    distinct_shifts, shift_of_chain = np.unique(shifts, axis=0, return_inverse=True)
    is_bad = verdict is not None and verdict.level == "bad"
    if not is_bad or len(distinct_shifts) < 2 or sweeps < VERDICT_LIMITS.fewest_sweeps:
        return verdict
    groups = [log_joint[shift_of_chain.ravel() == k] for k in range(len(distinct_shifts))]
    max_rhat = np.nanmax([1.0, *(rhat_and_ess(group)[0] for group in groups)])
    finding = f"chains stand at {len(distinct_shifts)} shifts of map and sensors together"
    advice = "another sensor or surer poses leave fewer shifts"
    if max_rhat > VERDICT_LIMITS.rhat_limit:
        return Verdict("bad", f"{finding}; at one of them R-hat is {max_rhat:.3f}, which more sweeps lower; {advice}")
    shares = "in the shares that the poses' prior gives them; neither blocks nor more sweeps move a chain to another"
    return Verdict("fair", f"{finding}, {shares}; {advice}. At each shift R-hat is at most {max_rhat:.3f}")


def judge_particles(ess: float) -> Verdict:
    """Return the verdict on weighted particles by their effective sample size."""
    if ess < VERDICT_LIMITS.bad_ess:
        number = f"{ess:.1f}"
        subject = "one particle carries" if number == "1.0" else f"{number} particles carry"
        return Verdict("bad", f"{subject} all the weight")
    return Verdict("good" if ess >= VERDICT_LIMITS.good_ess else "fair", f"{ess:.0f} effective particles")
