"""Have the chains on show converged? A verdict, and what to do about it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.notices import Verdict
from bayesmap.posterior.diagnostics import RHAT_LIMIT

GOOD_RHAT = 1.01
GOOD_ESS = 400.0
"""Vehtari et al. (2021): R-hat below 1.01, and 400 effective draws, which make R-hat itself reliable."""

BAD_ESS = 50.0
FEWEST_SWEEPS = 200
"""Before so many, nothing is said of chains that go on, nor of cells on which chains differ."""

FEWEST_DIAGNOSED = 4
"""R-hat needs two draws in each half of a chain."""

BAD_DIFFERENCE = 0.25
"""Of P(wall) between two chains: five standard errors for two means of 200 independent draws with p = 1/2."""


@dataclass(frozen=True)
class Difference:
    """Where chains differ most: by how much in P(wall), and in which cell."""

    by: float
    cell: tuple[int, int]


def difference(means: NDArray[np.float64], among: NDArray[np.bool_]) -> Difference | None:
    """The largest difference of chains' means, (chains, nx, ny), among some cells; None with one chain or no cell."""
    if len(means) < 2 or not among.any():
        return None
    spread = np.where(among, means.max(axis=0) - means.min(axis=0), 0.0)
    i, j = np.unravel_index(np.argmax(spread), spread.shape)
    return Difference(float(spread[i, j]), (int(i), int(j)))


def judge_chains(
    rhat: float, ess: float, sweeps: int, apart: Difference | None, *, over: bool = False
) -> Verdict | None:
    """The verdict on chains, or None where it is too early, or where the log joint never changed.

    It is never too early for chains that are over, finished, cancelled or saved: few sweeps are to be judged, too.
    Means of few differ by chance, so that then the log joint alone speaks.
    """
    few = sweeps < FEWEST_SWEEPS
    if few and not over:
        return None
    if apart is not None and apart.by > BAD_DIFFERENCE and not few:
        x, y = apart.cell
        return Verdict("bad", f"P(wall) of cell ({x}, {y}) differs by {apart.by:.2f} between the chains")
    if 0 < sweeps < FEWEST_DIAGNOSED:
        return Verdict("bad", f"{sweeps} {'sweep is' if sweeps == 1 else 'sweeps are'} too few to judge")
    if not (np.isfinite(rhat) and np.isfinite(ess)):
        return None
    if rhat > RHAT_LIMIT:
        return Verdict("bad", f"R-hat is {rhat:.2f}, over {RHAT_LIMIT}")
    if ess < BAD_ESS:
        return Verdict("bad", f"only {ess:.0f} effective draws")
    if rhat > GOOD_RHAT or ess < GOOD_ESS:
        return Verdict(
            "fair", f"R-hat {rhat:.3f} and {ess:.0f} effective draws; {GOOD_RHAT} and {GOOD_ESS:.0f} are good"
        )
    return Verdict("good", f"R-hat {rhat:.3f}, {ess:.0f} effective draws")


def judge_particles(ess: float) -> Verdict:
    """The verdict on weighted particles."""
    if ess < BAD_ESS:
        number = f"{ess:.1f}"
        carry = "one particle carries" if number == "1.0" else f"{number} particles carry"
        return Verdict("bad", f"{carry} all the weight")
    return Verdict("good" if ess >= GOOD_ESS else "fair", f"{ess:.0f} effective particles")
