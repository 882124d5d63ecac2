"""Belief propagation with ray potentials: approximate marginals in a few rounds.

`bayesmap.kernels.walls.propagate` states the messages.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np
from scipy import special

from bayesmap.cells.kind import Floats
from bayesmap.errors import BadInput, check_count
from bayesmap.samplers.progress import SILENT, Watch
from bayesmap.samplers.wall_problem import WallProblem

DAMPING = 0.5
ROUNDS = 20


@dataclass(frozen=True, eq=False)
class Marginals:
    """The marginals of belief propagation, and how it converged."""

    p_wall: Floats  # approximate posterior wall probability, (nx, ny)
    changes: Floats  # largest change of any cell's probability in each round, (rounds,)
    mean_changes: Floats  # mean change over the cells that beams touch, (rounds,)
    converged: bool  # whether the last largest change was below the tolerance
    finished: bool  # whether it converged or made all rounds; false if it was stopped early
    seconds: float
    prior: Floats | None = None  # wall probability without any beam, (nx, ny); None if it is the prior's own


def propagate(
    problem: WallProblem, *, rounds: int = ROUNDS, damping: float = DAMPING, tolerance: float = 1e-3, beta: float = 1.0,
    watch: Watch = SILENT,
) -> Marginals:  # fmt: skip
    """Pass messages between all beams and cells until beliefs converge, or for a number of rounds.

    If no cell lies on two beams and neighbours are not coupled, one undamped round is exact. If beams and coupled
    neighbours form a tree, the result is exact after as many rounds as the tree is wide. Otherwise the marginals are
    approximate, and usually too certain (docs/inference.md).

    Rounds end when no probability changes by more than ``tolerance``. ``damping`` in [0, 1) is the weight of the old
    message in the new one, geometrically; ``beta`` is the inverse temperature. Raises `BadInput` if rounds or damping
    are out of range.
    """
    from bayesmap.kernels.walls.propagate import Beliefs

    rounds = check_count("propagate", "rounds", rounds, 1)
    if not 0 <= damping < 1:
        raise BadInput(f"propagate: damping must lie in [0, 1), got {damping!r}")
    began = time.perf_counter()
    beliefs = Beliefs(problem.table, problem.logit, problem.device, beta, problem.coupling)
    observed = problem.table.touched_map().ravel()
    p_wall = special.expit(beliefs.log_odds().astype(np.float64))
    changes, mean_changes = [], []
    for number in range(rounds):
        beliefs.round(damping, problem.threads)
        old_p_wall, p_wall = p_wall, special.expit(beliefs.log_odds().astype(np.float64))
        change = np.abs(p_wall - old_p_wall)
        changes.append(float(change.max()))
        mean_changes.append(float(change[observed].mean()) if observed.any() else 0.0)
        watch.report("propagate", number + 1, rounds)
        if changes[-1] < tolerance or watch.should_stop():
            break
    fixed = (problem.p_wall == 0) | (problem.p_wall == 1)
    p_wall = np.where(fixed, problem.p_wall, p_wall)
    return Marginals(
        p_wall=p_wall.reshape(problem.table.grid.shape), changes=np.array(changes), mean_changes=np.array(mean_changes),
        converged=changes[-1] < tolerance, finished=changes[-1] < tolerance or len(changes) == rounds,
        seconds=time.perf_counter() - began,
    )  # fmt: skip


def propagate_to_start(problem: WallProblem, rounds: int = ROUNDS, watch: Watch = SILENT) -> Marginals:
    """Propagate beliefs for a start; if neighbours are coupled, also without beams, to find the effect of beams."""
    marginals = propagate(problem, rounds=rounds, watch=watch)
    if problem.coupling == 0.0:
        return marginals
    return replace(marginals, prior=propagate(problem, rounds=rounds, beta=0.0).p_wall)
