"""Importance sampling in short pieces: the particles of `bayesmap.samplers.importance`, some at a time."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.kernels.random import mix
from bayesmap.kernels.walls.importance import weigh
from bayesmap.samplers.importance import Particles
from bayesmap.samplers.sampler import STREAM_PARTICLES
from bayesmap.samplers.wall_problem import WallProblem

PIECE_SECONDS = 0.015
FIRST_PIECE = 64


class Weighing:
    """Particles that are being weighed.

    Attributes:
        total: how many there will be.
        done: how many there are.
    """

    def __init__(self, problem: WallProblem, total: int, seed: int) -> None:
        self.problem, self.total, self.done = problem, total, 0
        self._key = mix(seed, 0, STREAM_PARTICLES)
        self._log_weights: NDArray[np.float64] = np.empty(total)
        self._piece = FIRST_PIECE
        self._seconds = 0.0

    def advance(self) -> None:
        """Weigh some more: about `PIECE_SECONDS` of work."""
        began = time.perf_counter()
        now = min(self._piece, self.total - self.done)
        problem = self.problem
        some = weigh(problem.device_table, problem.device_prior, self._key, self.done, now, problem.device)
        self._log_weights[self.done : self.done + now] = some
        self.done += now
        spent = time.perf_counter() - began
        self._seconds += spent
        self._piece = int(np.clip(now * PIECE_SECONDS / max(spent, 1e-9), 1, 4 * self._piece))

    def particles(self) -> Particles:
        """Those weighed so far."""
        log_weights = self._log_weights[: self.done]
        log_total = float(special.logsumexp(log_weights))
        return Particles(
            log_weights=log_weights - log_total,
            log_evidence=log_total - float(np.log(self.done)),
            problem=self.problem,
            key=self._key,
            seconds=self._seconds,
            finished=self.done == self.total,
        )
