"""Is a field's run fit for use? The same diagnostics as for walls, of reflectivities instead of zeros and ones."""

from __future__ import annotations

import numpy as np

from bayesmap.posterior.diagnostics import (
    RHAT_LIMIT,
    CellDiagnostics,
    bulk_ess,
    plain_ess,
    plain_rhat,
    rhat,
    split_chains,
    tail_ess,
)
from bayesmap.posterior.field import CELLS_AT_ONCE, FieldPosterior
from bayesmap.posterior.summary import Summary

NAN = float("nan")


def diagnose_reflectivities(posterior: FieldPosterior) -> CellDiagnostics:
    """R-hat and effective sample size of the observed cells' reflectivities.

    Not rank-normalised: they are bounded, and a hundred thousand cells are to be judged. No cell counts as unchanged.
    """
    judged = np.nonzero(posterior.observed.ravel()[posterior.touched])[0]
    worst, least, high = NAN, NAN, 0
    if posterior.n_draws >= 4:
        for i in range(0, len(judged), CELLS_AT_ONCE):
            some = judged[i : i + CELLS_AT_ONCE]
            halves = split_chains(posterior.reflectivity[:, :, some].astype(np.float64))
            varied = np.ptp(halves.reshape(-1, len(some)), axis=0) > 0
            if not varied.any():
                continue
            rhats = plain_rhat(halves[..., varied])
            high += int((rhats > RHAT_LIMIT).sum())
            worst = float(np.fmax(worst, np.fmax.reduce(rhats)))
            least = float(np.fmin(least, np.fmin.reduce(plain_ess(halves[..., varied]))))
    return CellDiagnostics(worst, least, 0, 0, high)


def summarise_field(posterior: FieldPosterior) -> Summary:
    """Compute the diagnostics of a run."""
    log_joint = posterior.log_likelihood + posterior.log_prior
    chains, draws = log_joint.shape
    enough = draws >= 4
    cells = diagnose_reflectivities(posterior)
    sweeps = posterior.sweep * max(1, chains)
    threads = int(posterior.settings.get("threads_used", 1))
    return Summary(
        rhat_log_joint=rhat(log_joint) if enough else NAN,
        rhat_log_likelihood=rhat(posterior.log_likelihood) if enough else NAN,
        ess_log_joint_bulk=bulk_ess(log_joint) if enough else NAN,
        ess_log_joint_tail=tail_ess(log_joint) if enough else NAN,
        rhat_max=cells.rhat_max,
        ess_min=cells.ess_min,
        unchanged_cells=None,
        disagreeing_cells=None,
        rhat_high_cells=cells.high,
        effective_sample_size=NAN,
        microseconds_per_sweep=1e6 * posterior.seconds["sampling"] * threads / sweeps if sweeps else NAN,
        finished=posterior.finished,
    )
