"""From what a method found to the run that users hold."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.packing import pack, unpack
from bayesmap.posterior.posterior import Posterior, mean_of_draws
from bayesmap.result import Run
from bayesmap.run.chain import Chains
from bayesmap.samplers.exact import Enumeration
from bayesmap.samplers.importance import Particles
from bayesmap.samplers.problem import Problem
from bayesmap.samplers.propagate import Marginals
from bayesmap.samplers.sampler import STREAM_START
from bayesmap.sensors.model import SensorModel
from bayesmap.space.scans import Scans

MAPS_TO_SEE = 32
"""How many draws decide which cells count as observed."""


@dataclass(frozen=True, eq=False)
class Assembly:
    """What the results of all methods share: the problem, the data and the settings."""

    problem: Problem
    scans: Scans
    sensor: SensorModel
    settings: dict[str, Any]
    began: float
    trace_seconds: float
    before: Posterior | None = None  # what is being resumed

    def exact(self, whole: Enumeration) -> Run:
        """The whole posterior, with draws from it."""
        walls = self._independent(whole.sample)
        return self._run(walls, occupancy=whole.marginals(), log_evidence=whole.log_evidence)

    def importance(self, found: Particles) -> Run:
        """Weighted maps, with draws resampled from them."""
        walls = self._independent(lambda rng, count: found.maps(found.resample(rng, count)))
        return self._run(
            walls,
            occupancy=found.occupancy(),
            log_weights=found.log_weights,
            log_evidence=found.log_evidence,
            sampling=found.seconds,
            finished=found.finished,
        )

    def marginals(self, found: Marginals) -> Run:
        """Beliefs, with draws that are independent from cell to cell: marginals are all that there is."""
        walls = self._independent(lambda rng, count: rng.random((count, *found.p_wall.shape)) < found.p_wall)
        return self._run(
            walls,
            occupancy=found.p_wall,
            belief_changes=found.changes,
            sampling=found.seconds,
            finished=found.finished,
        )

    def chains(self, chains: Chains, warm: Marginals | None, threads: int | None) -> Run:
        """Chains, finished or not."""
        from bayesmap.kernels.parallel import available_cores

        used = min(threads or available_cores(), len(chains.walls)) if self.problem.device == "cpu" else 1
        if self.before is not None:
            changes, warm_seconds = self.before.belief_changes, self.before.seconds["warm_start"]
        else:
            changes, warm_seconds = (None, 0.0) if warm is None else (warm.changes, warm.seconds)
        return self._run(
            None,
            occupancy=mean_of_draws(chains.packed, self.problem.table.grid),
            chains=chains,
            belief_changes=changes,
            warm_start=warm_seconds,
            sampling=chains.seconds,
            finished=chains.finished,
            threads_used=used,
        )

    def _independent(self, draw: Callable[[np.random.Generator, int], NDArray[np.bool_]]) -> list[NDArray[np.bool_]]:
        seed, chains, draws = (self.settings[key] for key in ("seed", "chains", "draws"))
        return [draw(np.random.default_rng([seed, chain, STREAM_START]), draws) for chain in range(chains)]

    def _run(
        self,
        walls: list[NDArray[np.bool_]] | None,
        *,
        occupancy: NDArray[np.float64],
        chains: Chains | None = None,
        warm_start: float = 0.0,
        sampling: float = 0.0,
        finished: bool = True,
        threads_used: int = 1,
        **extra: Any,
    ) -> Run:
        from bayesmap.kernels.score import log_likelihoods

        table = self.problem.table
        if chains is None:
            assert walls is not None
            packed = pack(np.stack(walls))
            chains = Chains(
                packed=packed,
                log_likelihood=np.stack([log_likelihoods(table, chain, self.problem.device) for chain in packed]),
                log_prior=np.array([[self.problem.prior.log_prob(w, table.grid) for w in chain] for chain in walls]),
                warmup_log_joint=np.zeros((len(walls), 0)),
                walls=np.zeros((len(walls), table.grid.n_cells), dtype=np.uint8),
                sweep=0,
                seconds=sampling,
                finished=finished,
            )
        settings = {**self.settings, "threads_used": threads_used}
        total = time.perf_counter() - self.began + (self.before.seconds["total"] if self.before else 0.0)
        seconds = {"trace": self.trace_seconds, "warm_start": warm_start, "sampling": sampling, "total": total}
        return Run(
            Posterior(
                grid=table.grid,
                scans=self.scans,
                sensor=self.sensor,
                settings=settings,
                occupancy=occupancy,
                observed=self._observed(chains, occupancy),
                packed=chains.packed,
                log_likelihood=chains.log_likelihood,
                log_prior=chains.log_prior,
                warmup_log_joint=chains.warmup_log_joint,
                walls=chains.walls,
                sweep=chains.sweep,
                finished=finished,
                seconds=seconds,
                counts={"scans": len(self.scans), "beams": self.scans.n_beams, "incidences": table.n_incidences},
                **extra,
            )
        )

    def _observed(self, chains: Chains, occupancy: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Cells that a beam reaches in at least half of the maps: some draws, else where the chains stand."""
        from bayesmap.kernels.reach import reach_frequency

        shape = self.problem.table.grid.shape
        draws = chains.packed.reshape(-1, chains.packed.shape[-1])
        if len(draws):
            some = np.unique(np.linspace(0, len(draws) - 1, MAPS_TO_SEE).astype(int))
            maps = unpack(draws[some], shape)
        elif chains.sweep:
            maps = chains.walls.reshape(-1, *shape) != 0
        else:
            maps = occupancy[None] > 0.5
        return reach_frequency(self.problem.table, maps, self.problem.device) >= 0.5
