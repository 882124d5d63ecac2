"""Gibbs sampling of reflectivities, surfaces and the stops of beams (docs/surfaces.md).

Given the cells, the stop of each beam is drawn from its exact conditional in one walk along the beam. Given the stops,
each cell's reflectivity follows a Beta, and its surface takes Metropolis steps. The update of reflectivities is related
to "counting" maps (Haehnel, 2004), which keep the counts of one assignment; here the assignments are drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.ising_field import SOLID
from bayesmap.cells.reflectivity import Beta, positions_in
from bayesmap.cells.surface import PARTS
from bayesmap.model import Model
from bayesmap.samplers.merge_moves import merge, merge_sweeps
from bayesmap.samplers.sampler import SILENT, ChainState, Info, Keep, Snapshot, Stream, Watch
from bayesmap.samplers.stop_problem import StopProblem, draw_start, first_labels, steps, trace_stops, update_periods

if TYPE_CHECKING:
    from bayesmap.kernels.surfaces.square_counts import InSquares
    from bayesmap.kernels.surfaces.stop_chains import Plan, StopChains

HIGHEST = float(np.nextafter(np.float16(1), np.float16(0)))  # the largest half below 1: a mean of 1 would forbid passes
EARLY_SURFACE_STEPS = 12  # Metropolis steps of a surface in each early sweep, in which surfaces move furthest


class StopDraws:
    """Arrays for the draws of some sweeps, filled during the sweeps, chain by chain."""

    def __init__(self, problem: StopProblem, chains: StopChains, kept: range) -> None:
        self._problem, self._chains = problem, chains
        self._number = {sweep - 1: number for number, sweep in enumerate(kept)}
        shape = dict(zip(("x", "y"), problem.grid.shape, strict=True))
        sizes = shape | {name: len(cells) for name, cells in problem.coordinates.items()}
        self._specs = {spec.name: spec for spec in problem.prior.arrays}
        self.arrays = {
            name: spec.empty(chains.n_chains, len(kept), tuple(sizes[dim] for dim in spec.dims))
            for name, spec in self._specs.items()
        }
        self._cells = problem.coordinates
        surfaces = self._cells.get("surface_cell")
        self._centres = None if surfaces is None else problem.grid.centers_from_corner_m(surfaces)
        self._solid: dict[int, NDArray[np.bool_]] = {}

    @cached_property
    def _among_touched(self) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
        """Positions of the kept cells among the cells that beams touch, and the mask of kept cells among these."""
        return positions_in(self._problem.rays.touched, self._cells["cell"])

    def begin(self, chain: int, sweep: int) -> None:
        """Record the cells before a sweep."""
        number = self._number.get(sweep)
        if number is None:
            return
        cells, edge = self._chains.cells(chain), self._problem.grid.resolution
        self._put("reflectivity", chain, number, cells[self._cells["cell"], 0])
        if self._problem.prior.has_labels:
            self._solid[chain] = self._chains.solid(chain).copy()
            self._put(SOLID.name, chain, number, self._solid[chain].reshape(self._problem.grid.shape))
        if self._centres is not None:
            surfaces = cells[self._cells["surface_cell"], 1:].astype(np.float64)
            surfaces[:, :2] -= self._centres
            for part, values in zip(PARTS, surfaces.T / edge, strict=True):
                self._put(f"surface_{part}", chain, number, values)

    def end(self, chain: int, sweep: int) -> None:
        """Record the counts of the sweep for the cells before it."""
        number = self._number.get(sweep)
        if number is None:
            return
        if self._centres is not None:
            self._put_chances(chain, number, self._chains.in_squares(chain, sweep, True, self._solid.get(chain)))
        kept, prior = self._cells["cell"], self._problem.prior
        hits, met = (count[kept] for count in self._chains.counted(chain))
        solid = self._solid[chain][kept] if prior.has_labels else None
        drawn = self.arrays["reflectivity"][chain, number]
        self._put("expected", chain, number, expected_reflectivity(hits, met, prior, drawn, solid))

    def _put_chances(self, chain: int, number: int, squares: InSquares) -> None:
        """Record the chances that squares stop beams; a square that no beam can reach takes the prior mean."""
        prior, kept = self._problem.prior, self._cells["cell"]
        positions, touched = self._among_touched
        for name, values in (("stop_chance", squares.drawn), ("expected_stop_chance", squares.expected)):
            chances = np.full(len(kept), prior.mean, dtype=np.float32)
            if prior.has_labels:
                chances[:] = prior.mean_given(self._solid[chain][kept])
            chances[touched] = np.minimum(values[positions[touched]], np.float32(HIGHEST))
            self._put(name, chain, number, chances)

    def _put(self, name: str, chain: int, number: int, values: NDArray[Any]) -> None:
        """Store an array of a draw."""
        self.arrays[name][chain, number] = self._specs[name].stored(values)


def expected_reflectivity(
    hits: NDArray[np.int32], met: NDArray[np.int32], prior: Beta, drawn: NDArray[np.float16],
    solid: NDArray[np.bool_] | None = None,
) -> NDArray[np.float32]:  # fmt: skip
    """Compute the mean of each cell's reflectivity given its counts, (a + hits) / (a + b + hits + met), (T,).

    The density of one more beam under these means is the mean density under draws (docs/surfaces.md, Predictions). The
    counts must come from the sweep that began at the draw, with its surfaces. A cell that this sweep did not update has
    the counts of its last update, an approximation: its correlation with later changes is lost.

    Cells have stopped ``hits`` beams, and let ``met`` beams pass. If ``met`` is negative, a cell has not counted yet,
    and the ``drawn`` reflectivity stays. Labels ``solid`` choose a and b. All are (T,).
    """
    stopped = hits.astype(np.float32)
    total = stopped + np.maximum(met, 0)
    a, b = (prior.a, prior.b) if solid is None else prior.beta_given(solid)
    stopped += np.asarray(a, dtype=np.float32)
    total += np.asarray(np.add(a, b), dtype=np.float32)
    return np.minimum(np.where(met >= 0, stopped / total, drawn), np.float32(HIGHEST))


@dataclass(frozen=True, eq=False)
class StopState(ChainState):
    """Chains between two sweeps."""

    problem: StopProblem
    chains: StopChains
    keys: Sequence[int]


@dataclass(frozen=True)
class StopGibbs:
    """Sweeps of stops, labels, reflectivities and surfaces. In the first ``early_sweeps``, surfaces take
    `EARLY_SURFACE_STEPS` Metropolis steps; then, if there were any, they are merged (`merge_sweeps`).
    """

    early_sweeps: int = 0

    def prepare(self, model: Model, device: str, threads: int | None = None, watch: Watch = SILENT) -> StopProblem:
        """Compile the kernels, trace the beams, and estimate where chains start."""
        from bayesmap.kernels.surfaces.stop_chains import KERNELS, load_stop_kernels

        cells = Beta.of(model.cells, "stop-gibbs")
        problem = trace_stops(
            model.scans, model.grid, cells, model.sensor, hit_depth=model.hit_depth, device=device,
            threads=threads, watch=watch,
        )  # fmt: skip
        watch.report("compile", 0, len(KERNELS))
        for done in load_stop_kernels(problem.device):
            watch.report("compile", done, len(KERNELS))
        watch.report("start", 0, 2)
        _ = problem.estimate
        watch.report("start", 1, 2)
        return problem

    def init(
        self, problem: StopProblem, chain_ids: Sequence[int], seed: int, resume: Snapshot | None = None,
        watch: Watch = SILENT,
    ) -> StopState:  # fmt: skip
        """Start chains scattered about the initial estimate, or continue from a snapshot."""
        from bayesmap.kernels.random import mix
        from bayesmap.kernels.surfaces.stop_chains import StopChains

        resume = Snapshot(0) if resume is None else resume
        stored, cells = resume.arrays, problem.coordinates["cell"]
        keys = [mix(seed, chain, Stream.SWEEPS) for chain in chain_ids]
        solid = self._labels(problem, chain_ids, seed, stored)

        def states(chain: int) -> NDArray[np.float32]:
            rng = np.random.default_rng([seed, chain_ids[chain], Stream.START])
            labels = None if solid is None else solid[chain]
            state = draw_start(problem.estimate, problem.prior, problem.rays, rng, labels)
            if "state" in stored:
                state[cells] = stored["state"][chain]
            return state

        def on_grid(name: str) -> NDArray[np.int32] | None:
            """Spread two numbers for each kept cell, (C, 2, T), over the grid."""
            if name not in stored:
                return None
            out = np.zeros((len(chain_ids), 2, problem.grid.n_cells), dtype=np.int32)
            out[..., cells] = stored[name]
            return out

        observed = on_grid("observed_counts")
        chains = StopChains(
            _plan(problem), states, keys, threads=problem.threads, counts=on_grid("counts"), solid=solid,
            observed_counts=None if observed is None else np.ascontiguousarray(observed.transpose(0, 2, 1)),
        )  # fmt: skip
        return StopState(problem, resume.sweep, chains, keys)

    def _labels(
        self, problem: StopProblem, chain_ids: Sequence[int], seed: int, stored: Mapping[str, NDArray[Any]]
    ) -> NDArray[np.bool_] | None:
        """Return the first labels of all cells, or the stored ones, (C, N); None without labels."""
        if not problem.prior.has_labels:
            return None
        cells = problem.grid.n_cells
        if SOLID.name in stored:
            return np.unpackbits(stored[SOLID.name], axis=-1, count=cells).view(np.bool_)
        rngs = [np.random.default_rng([seed, chain, Stream.LABELS]) for chain in chain_ids]
        return np.stack([first_labels(problem.estimate, problem.prior, problem.grid, rng) for rng in rngs])

    def retrace(self, problem: StopProblem, model: Model) -> StopProblem:
        """Return this problem with the scans moved to other poses. Draws keep their cells."""
        retraced = trace_stops(
            model.scans, model.grid, problem.prior, problem.sensor, hit_depth=problem.hit_depth, device=problem.device,
            threads=1,
        )  # fmt: skip
        return replace(retraced, kept=problem.kept)

    def moved(self, state: StopState, problem: StopProblem) -> StopState:
        """Return the chains with their present cells, under another problem."""
        from bayesmap.kernels.surfaces.stop_chains import StopChains

        old = state.chains
        new = StopChains(
            _plan(problem), old.cells, state.keys, threads=problem.threads, counts=_of_chains(old.counted, old),
            observed_counts=_of_chains(old.observed_counts, old), solid=_of_chains(old.solid, old),
        )  # fmt: skip
        return replace(state, problem=problem, chains=new)

    def present_cells(self, state: StopState) -> NDArray[np.float32]:
        """Return the present cells of the chains: reflectivities (C, N), or surfaces (C, N, 6). If cells have labels,
        this draws the reflectivity of untouched cells in place. Sweeps do not use it.
        """
        if state.problem.prior.has_labels and state.chains.swept:
            state.chains.draw_untouched(state.sweep)
        cells = _of_chains(state.chains.cells, state.chains)
        return np.ascontiguousarray(cells if state.problem.prior.has_surfaces else cells[..., 0])

    def step(self, state: StopState, sweeps: int, beta: float = 1.0, keep: Keep = Keep()) -> tuple[StopState, Info]:
        """Make some sweeps of all chains, and merge surfaces after those that `merge_sweeps` lists."""
        end = state.sweep + sweeps
        merging = merge_sweeps(self.early_sweeps)
        if not state.problem.prior.has_surfaces or state.sweep >= max(merging, default=0):
            return self._sweep(state, sweeps, beta, keep)
        infos: list[Info] = []
        while not infos or state.sweep < end:
            # Sweep up to the next merge, or to the end.
            count = min([end, *(number for number in merging if number > state.sweep)]) - state.sweep
            early = state.sweep < self.early_sweeps
            state, info = self._sweep(state, count, beta, keep, EARLY_SURFACE_STEPS if early else None)
            infos.append(info)
            if count > 0 and state.sweep in merging:
                merge(state.problem, state.chains, beta)
        return state, Info.joined(infos, axis=1)

    def _sweep(
        self, state: StopState, sweeps: int, beta: float, keep: Keep, steps: int | None = None
    ) -> tuple[StopState, Info]:
        """Make some sweeps of the chains."""
        from bayesmap.kernels.surfaces.endpoint_cells import STEPS

        problem, chains = state.problem, state.chains
        kept = keep.sweeps(state.sweep, state.sweep + sweeps)
        draws = StopDraws(problem, chains, kept)
        log_likelihood, log_prior = chains.sweeps(
            state.sweep, sweeps, problem.sensor, problem.prior.kernel_numbers(problem.grid.resolution), beta,
            steps=STEPS if steps is None else steps, observe_from=keep.after if keep.every else None,
            before=draws.begin if kept else None, after=draws.end if kept else None,
        )  # fmt: skip
        return replace(state, sweep=state.sweep + sweeps), Info(log_likelihood, log_prior, draws.arrays)

    def snapshot(self, state: StopState) -> Snapshot:
        """Return the kept cells' states and counts, (C, T, 6) and (C, 2, T), and labels of all cells, packed."""
        chains, cells = state.chains, state.problem.coordinates["cell"]
        arrays = {
            "state": _of_chains(lambda chain: chains.cells(chain)[cells], chains),
            "counts": _of_chains(lambda chain: np.stack(chains.counted(chain))[:, cells], chains),
            "observed_counts": _of_chains(lambda chain: chains.observed_counts(chain)[cells].T, chains),
        }
        if state.problem.prior.has_labels:
            arrays[SOLID.name] = np.packbits(_of_chains(chains.solid, chains), axis=-1)
        return Snapshot(state.sweep, arrays)

    def observed_counts(self, state: StopState, draws: Mapping[str, NDArray[Any]]) -> NDArray[np.int32]:
        """Count the kept sweeps (or the last) in which a beam observes each cell, and those inspected, (2, nx, ny)."""
        each = range(state.chains.n_chains)
        counts = [state.chains.observed_counts(i).T if draws else self._observed_at_present(state, i) for i in each]
        return np.reshape(np.sum(counts, axis=0), (2, *state.problem.grid.shape)).astype(np.int32)

    def _observed_at_present(self, state: StopState, chain: int) -> NDArray[np.bool_]:
        """Return whether a beam observes each cell in a chain's last sweep, and whether this is known, (2, N)."""
        if not state.problem.prior.has_surfaces:
            hits, met = state.chains.counted(chain)
            return np.stack([(met >= 0) & (hits + met > 0), met >= 0])
        out = np.zeros((2, state.problem.grid.n_cells), dtype=np.bool_)
        if state.chains.swept:
            squares = state.chains.in_squares(chain, state.sweep - 1, kept=False)
            touched = state.problem.rays.touched
            out[0, touched], out[1, touched] = squares.stopped + squares.passed > 0, True
        return out


def _of_chains(values: Callable[[int], Any], chains: StopChains) -> NDArray[Any]:
    """Stack the values of every chain, (C, ...)."""
    return np.stack([values(chain) for chain in range(chains.n_chains)])


def _plan(problem: StopProblem) -> Plan:
    """Return the data that the sweeps of all chains share."""
    from bayesmap.kernels.surfaces.stop_chains import Plan

    estimate = problem.estimate
    return Plan(
        rays=problem.rays, periods=update_periods(estimate), endpoints=estimate.endpoint_cells,
        steps=steps(estimate, problem.grid.resolution),
        distance_m=None if problem.prior.has_surfaces else problem.distance_m, device=problem.device,
    )  # fmt: skip
