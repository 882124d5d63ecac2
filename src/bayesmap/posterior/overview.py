"""A run in five lines."""

from __future__ import annotations

import numpy as np

from bayesmap.posterior.diagnostics import rhat
from bayesmap.posterior.posterior import Posterior


def overview(posterior: Posterior) -> tuple[str, list[tuple[str, str]]]:
    """A title, and four rows of a name and a value: what was inferred, from what, how, how well, and how long it
    took.
    """
    (nx, ny), counts, joint = posterior.grid.shape, posterior.counts, posterior.log_joint
    title = f"Run: {posterior.prior.words.states}, {nx} x {ny} cells of {posterior.grid.resolution:g} m"
    chains, draws = joint.shape
    work = f"{chains} chains of {posterior.sweep:,} sweeps, {draws:,} draws each"
    if not posterior.has_chains:
        work = f"{chains * draws:,} independent draws"
    state = "finished" if posterior.finished else "not finished"
    fit = "no draws yet"
    if joint.size:
        fit = f"{joint.mean():,.1f} on average"
        if posterior.has_chains and draws >= 4:
            fit += f", R-hat {rhat(joint):.3f}"
    seen = f"{np.count_nonzero(posterior.observed):,} of {posterior.observed.size:,} cells observed"
    return title, [
        ("scans", f"{counts['scans']:,}, {counts['beams']:,} beams; {seen}"),
        ("method", f"{posterior.settings['method']}, {work}, {state}"),
        ("log joint", fit),
        ("seconds", f"{posterior.seconds['total']:.1f}, {posterior.seconds['sampling']:.1f} of them in sweeps"),
    ]
