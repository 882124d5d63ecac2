"""Fit the coupling of an Ising prior to scans by a pilot chain: stochastic expectation maximisation.

After each sweep the pilot's map, in which what no beam saw is drawn, too, has a coupling of greatest
pseudo-likelihood (`bayesmap.cells.ising`), and the coupling under which the next sweep is made moves there:
all the way in the first sweeps, and then a shrinking part of it (Delyon, Lavielle and Moulines, 1999). It comes to
where the slope of the pseudo-likelihood is zero on the mean over the posterior, as it is over maps of the prior at the
truth. Poses that are unknown are taken as the log states them.

As the pilot of a sensor it is over before the chains begin, and has a number that none of them has.
"""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import numpy as np

from bayesmap.cells.ising import Ising, counts, likeliest
from bayesmap.model import Model
from bayesmap.samplers.progress import SILENT, Watch
from bayesmap.samplers.sampler import PILOT
from bayesmap.samplers.walls import WallSampler

SWEEPS = 100
WHOLE_UNTIL = 40
FIRST = 0.5
"""Where the pilot starts: below the coupling of about 0.88 at which, at p = 0.5, whole regions become alike."""


def fit_coupling_to_scans(
    model: Model, sampler: WallSampler, device: str, *, seed: int, threads: int | None = None, watch: Watch = SILENT
) -> Ising:
    """Return a model's prior with the coupling that suits its scans.

    Args:
        model: its cells an `Ising`, whose wall probability is held.
        sampler: of the pilot.
        device: where kernels run.
        seed: of the pilot.
        threads: of the CPU; all cores if None.
        watch: gets progress after each sweep; a stop ends the pilot, and with it the run.

    Raises:
        BadInput: as `WallSampler.prepare`.
    """
    now = replace(cast(Ising, model.cells), coupling=FIRST)
    problem = sampler.prepare(replace(model, cells=now), device, threads, watch)
    state = sampler.init(problem, [PILOT], seed, watch=watch)
    for sweep in range(SWEEPS):
        state, info = sampler.step(state, 1)
        walls = state.walls().reshape(problem.grid.shape) != 0
        best = likeliest(*counts(walls, np.asarray(now.p_wall, dtype=np.float64)))
        step = 1.0 if sweep < WHOLE_UNTIL else (sweep - WHOLE_UNTIL + 1.0) ** -0.7
        now = replace(now, coupling=now.pair_coupling + step * (best - now.pair_coupling))
        state = replace(state, problem=state.problem.under(now))
        watch.report("fit", sweep + 1, SWEEPS, float(info.log_likelihood[0, -1] + info.log_prior[0, -1]))
        if watch.should_stop():
            break
    return now
