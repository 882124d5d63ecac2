"""Gibbs sampling of reflectivities, surfaces and the stops of beams (docs/surfaces.md).

Given the cells, the stop of each beam is drawn from its exact conditional in one walk along the beam. Given the stops,
each cell's reflectivity follows a Beta, and its surface takes Metropolis steps. The update of reflectivities is related
to "counting" maps (Haehnel, 2004), which keep the counts of one assignment; here the assignments are drawn.
`StopGibbs` is the sampler. `bayesmap.kernels.surfaces.stop_chains` runs its sweeps, `StopDraws` records their draws.
"""

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
from bayesmap.samplers import stop_problem
from bayesmap.samplers.merge_moves import make_merge_moves, sweeps_before_merges
from bayesmap.samplers.sampler import SILENT, ChainState, Info, Keep, Snapshot, Stream, Watch
from bayesmap.samplers.stop_problem import StopProblem, trace_stops
from bayesmap.space.arrays import Indices, Ints, Mask, Singles
from bayesmap.space.grid import Grid

if TYPE_CHECKING:
    from bayesmap.kernels.surfaces.square_counts import SquareCounts
    from bayesmap.kernels.surfaces.stop_chains import Plan, StopChains

MAX_MEAN = float(np.nextafter(np.float16(1), np.float16(0)))  # the largest half below 1: a mean of 1 forbids passes
EARLY_SURFACE_STEPS = 12  # Metropolis steps of a surface in each early sweep, in which surfaces move furthest


class StopDraws:
    """The draws of the ``kept`` sweeps: cells before the sweep (`begin`), and means given its stops (`end`)."""

    def __init__(self, problem: StopProblem, chains: "StopChains", kept: range) -> None:
        self._problem, self._chains = problem, chains
        self._draw_of_sweep = {sweep - 1: draw for draw, sweep in enumerate(kept)}
        grid_sizes = dict(zip(("x", "y"), problem.grid.shape, strict=True))
        sizes = grid_sizes | {name: len(cells) for name, cells in problem.coordinates.items()}
        self._specs = {spec.name: spec for spec in problem.prior.arrays}
        self.arrays = {
            name: spec.empty(chains.n_chains, len(kept), tuple(sizes[dim] for dim in spec.dims))
            for name, spec in self._specs.items()
        }
        self._cells = problem.coordinates
        surface_cells = self._cells.get("surface_cell")
        self._centres_m = None if surface_cells is None else problem.grid.centers_from_corner_m(surface_cells)
        self._solid: dict[int, Mask] = {}  # labels before the present sweep, (N,), by chain

    @cached_property
    def _among_touched(self) -> tuple[Indices, Mask]:
        """The positions of the kept cells among the cells that beams touch, and the mask of the touched kept cells."""
        return positions_in(self._problem.rays.touched, self._cells["cell"])

    def begin(self, chain: int, sweep: int) -> None:
        """Record the cells before a sweep."""
        draw = self._draw_of_sweep.get(sweep)
        if draw is None:
            return  # the sweep is not kept
        cells = self._chains.cells(chain)
        self._store("reflectivity", chain, draw, cells[self._cells["cell"], 0])
        if self._problem.prior.has_labels:
            self._solid[chain] = self._chains.solid(chain).copy()
            self._store(SOLID.name, chain, draw, self._solid[chain].reshape(self._problem.grid.shape))
        if self._centres_m is not None:
            surfaces = cells[self._cells["surface_cell"], 1:].astype(np.float64)
            surfaces[:, :2] -= self._centres_m
            for part, values in zip(PARTS, surfaces.T / self._problem.grid.resolution, strict=True):
                self._store(f"surface_{part}", chain, draw, values)

    def end(self, chain: int, sweep: int) -> None:
        """Record the means given the stops of a sweep, for the cells before it."""
        draw = self._draw_of_sweep.get(sweep)
        if draw is None:
            return  # the sweep is not kept
        if self._centres_m is not None:
            squares = self._chains.in_squares(chain, sweep, is_kept=True, solid=self._solid.get(chain))
            self._store_chances(chain, draw, squares)
        cells, prior = self._cells["cell"], self._problem.prior
        hits, passes = (count[cells] for count in self._chains.hits_and_passes(chain))
        solid = self._solid[chain][cells] if prior.has_labels else None
        drawn = self.arrays["reflectivity"][chain, draw]
        self._store("expected", chain, draw, expected_reflectivity(hits, passes, prior, drawn, solid))

    def _store_chances(self, chain: int, draw: int, squares: "SquareCounts") -> None:
        """Store the chances that squares stop beams; a square that no beam can reach takes the prior mean."""
        prior, cells = self._problem.prior, self._cells["cell"]
        positions, touched = self._among_touched
        for name, values in (("stop_chance", squares.drawn), ("expected_stop_chance", squares.expected)):
            chances = np.full(len(cells), prior.mean, dtype=np.float32)
            if prior.has_labels:
                chances[:] = prior.mean_given(self._solid[chain][cells])
            chances[touched] = np.minimum(values[positions[touched]], np.float32(MAX_MEAN))
            self._store(name, chain, draw, chances)

    def _store(self, name: str, chain: int, draw: int, values: NDArray[Any]) -> None:
        """Store one array of a draw."""
        self.arrays[name][chain, draw] = self._specs[name].stored(values)


def expected_reflectivity(
    hits: Ints, passes: Ints, prior: Beta, drawn: NDArray[np.float16], solid: Mask | None = None
) -> Singles:
    """Compute the mean of each cell's reflectivity given its counts, (a + hits) / (a + b + hits + passes), (T,).
    The density of one more beam under these means is the mean density under draws (docs/surfaces.md, Predictions). The
    counts must come from the sweep that began at the draw, with its surfaces. A cell that this sweep did not update has
    the counts of its last update, an approximation. Cells have stopped ``hits`` beams and let ``passes`` pass. A cell
    with negative ``passes`` has not counted yet, and keeps ``drawn``. Labels ``solid`` choose a and b. All are (T,).
    """
    stopped = hits.astype(np.float32)
    total = stopped + np.maximum(passes, 0)
    a, b = (prior.a, prior.b) if solid is None else prior.beta_given(solid)
    stopped += np.asarray(a, dtype=np.float32)
    total += np.asarray(np.add(a, b), dtype=np.float32)
    return np.minimum(np.where(passes >= 0, stopped / total, drawn), np.float32(MAX_MEAN))


@dataclass(frozen=True, eq=False)
class StopState(ChainState):
    """Chains between two sweeps."""

    problem: StopProblem
    chains: "StopChains"
    keys: Sequence[int]  # keys of the chains' random numbers


@dataclass(frozen=True)
class StopGibbs:
    """A sampler whose sweeps draw stops, labels, reflectivities and surfaces.
    In the first ``early_sweeps``, surfaces take `EARLY_SURFACE_STEPS` steps each; then, if any, they are merged.
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
        """Start chains scattered about the initial estimate, or continue from a snapshot; ``watch`` is not used."""
        from bayesmap.kernels.random import mix
        from bayesmap.kernels.surfaces.stop_chains import StopChains

        resume = Snapshot(0) if resume is None else resume
        stored, cells = resume.arrays, problem.coordinates["cell"]
        keys = [mix(seed, chain, Stream.SWEEPS) for chain in chain_ids]
        solid = self._first_labels(problem, chain_ids, seed, stored)

        def first_state(chain: int) -> Singles:
            rng = np.random.default_rng([seed, chain_ids[chain], Stream.START])
            labels = None if solid is None else solid[chain]
            state = stop_problem.draw_start(problem.estimate, problem.prior, problem.rays, rng, labels)
            if "state" in stored:
                state[cells] = stored["state"][chain]
            return state

        counts, observed = (_spread(stored.get(name), cells, problem.grid) for name in ("counts", "observed_counts"))
        chains = StopChains(
            _plan(problem), first_state, keys, threads=problem.threads, counts=counts, solid=solid,
            observed_counts=None if observed is None else np.ascontiguousarray(observed.transpose(0, 2, 1)),
        )  # fmt: skip
        return StopState(problem, resume.sweep, chains, keys)

    def _first_labels(
        self, problem: StopProblem, chain_ids: Sequence[int], seed: int, stored: Mapping[str, NDArray[Any]]
    ) -> Mask | None:
        """Return the labels of all cells, stored ones or draws, (C, N), or None if the prior has no labels."""
        if not problem.prior.has_labels:
            return None
        cells = problem.grid.n_cells
        if SOLID.name in stored:
            return np.unpackbits(stored[SOLID.name], axis=-1, count=cells).view(np.bool_)
        rngs = [np.random.default_rng([seed, chain, Stream.LABELS]) for chain in chain_ids]
        labels = [stop_problem.draw_first_labels(problem.estimate, problem.prior, problem.grid, rng) for rng in rngs]
        return np.stack(labels)

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

        chains, plan = state.chains, _plan(problem)
        values = chains.hits_and_passes, chains.observed_counts, chains.solid
        counts, observed, solid = (_stack_chains(value, chains) for value in values)
        moved_chains = StopChains(
            plan, chains.cells, state.keys, threads=problem.threads, counts=counts, observed_counts=observed,
            solid=solid,
        )  # fmt: skip
        return replace(state, problem=problem, chains=moved_chains)

    def present_cells(self, state: StopState) -> Singles:
        """Return the chains' present reflectivities, (C, N), or surfaces, (C, N, 6)."""
        # If cells have labels, sweeps do not need the reflectivities of untouched cells: draw them now, in place.
        if state.problem.prior.has_labels and state.chains.has_swept:
            state.chains.draw_untouched(state.sweep)
        cells = _stack_chains(state.chains.cells, state.chains)
        return np.ascontiguousarray(cells if state.problem.prior.has_surfaces else cells[..., 0])

    def step(self, state: StopState, sweeps: int, beta: float = 1.0, keep: Keep = Keep()) -> tuple[StopState, Info]:
        """Make some sweeps of all chains, and merge surfaces after those that `sweeps_before_merges` lists."""
        end = state.sweep + sweeps
        merges = sweeps_before_merges(self.early_sweeps)
        if not state.problem.prior.has_surfaces or state.sweep >= max(merges, default=0):
            return self._sweep(state, sweeps, beta, keep)
        infos: list[Info] = []
        while not infos or state.sweep < end:
            # Sweep up to the next merge, or to the end.
            count = min([end, *(sweep for sweep in merges if sweep > state.sweep)]) - state.sweep
            is_early = state.sweep < self.early_sweeps
            state, info = self._sweep(state, count, beta, keep, EARLY_SURFACE_STEPS if is_early else None)
            infos.append(info)
            if count > 0 and state.sweep in merges:
                make_merge_moves(state.problem, state.chains, beta)
        return state, Info.joined(infos, axis=1)

    def _sweep(
        self, state: StopState, sweeps: int, beta: float, keep: Keep, surface_steps: int | None = None
    ) -> tuple[StopState, Info]:
        """Make some sweeps of all chains, with this number of Metropolis steps of each surface a sweep."""
        from bayesmap.kernels.surfaces.endpoint_cells import STEPS

        problem, chains = state.problem, state.chains
        kept = keep.sweeps(state.sweep, state.sweep + sweeps)
        draws = StopDraws(problem, chains, kept)
        log_likelihood, log_prior = chains.sweeps(
            state.sweep, sweeps, problem.sensor, problem.prior.kernel_parameters(problem.grid.resolution), beta,
            steps=STEPS if surface_steps is None else surface_steps, observe_from=keep.after if keep.every else None,
            before=draws.begin if kept else None, after=draws.end if kept else None,
        )  # fmt: skip
        return replace(state, sweep=state.sweep + sweeps), Info(log_likelihood, log_prior, draws.arrays)

    def snapshot(self, state: StopState) -> Snapshot:
        """Return the kept cells' states and counts, (C, T, 6) and (C, 2, T), and labels of all cells, packed."""
        chains, cells = state.chains, state.problem.coordinates["cell"]
        arrays = {
            "state": _stack_chains(lambda chain: chains.cells(chain)[cells], chains),
            "counts": _stack_chains(lambda chain: np.stack(chains.hits_and_passes(chain))[:, cells], chains),
            "observed_counts": _stack_chains(lambda chain: chains.observed_counts(chain)[cells].T, chains),
        }
        if state.problem.prior.has_labels:
            arrays[SOLID.name] = np.packbits(_stack_chains(chains.solid, chains), axis=-1)
        return Snapshot(state.sweep, arrays)

    def observed_counts(self, state: StopState, draws: Mapping[str, NDArray[Any]]) -> Ints:
        """Count the kept sweeps (or the last) in which a beam observes each cell, and all of these, (2, nx, ny)."""

        def counts(chain: int) -> NDArray[Any]:
            return state.chains.observed_counts(chain).T if draws else self._observed_in_last_sweep(state, chain)

        total = _stack_chains(counts, state.chains).sum(axis=0)
        return np.reshape(total, (2, *state.problem.grid.shape)).astype(np.int32)

    def _observed_in_last_sweep(self, state: StopState, chain: int) -> Mask:
        """Return the masks of the cells that a beam observes in a chain's last sweep, and that it counted, (2, N)."""
        if not state.problem.prior.has_surfaces:
            hits, passes = state.chains.hits_and_passes(chain)
            return np.stack([(passes >= 0) & (hits + passes > 0), passes >= 0])
        masks = np.zeros((2, state.problem.grid.n_cells), dtype=np.bool_)
        if state.chains.has_swept:
            squares = state.chains.in_squares(chain, state.sweep - 1, is_kept=False)
            touched = state.problem.rays.touched
            masks[0, touched], masks[1, touched] = squares.stopped + squares.passed > 0, True
        return masks


def _stack_chains(values: Callable[[int], Any], chains: "StopChains") -> NDArray[Any]:
    """Stack the values of every chain, (C, ...)."""
    return np.stack([values(chain) for chain in range(chains.n_chains)])


def _spread(counts: Ints | None, cells: Ints, grid: Grid) -> Ints | None:
    """Spread two counts of each kept cell, (C, 2, T), over the grid, (C, 2, N); None stays None."""
    if counts is None:
        return None
    spread = np.zeros((*counts.shape[:-1], grid.n_cells), dtype=np.int32)
    spread[..., cells] = counts
    return spread


def _plan(problem: StopProblem) -> "Plan":
    """Return the data that the sweeps of all chains share."""
    from bayesmap.kernels.surfaces.stop_chains import Plan

    estimate = problem.estimate
    return Plan(
        rays=problem.rays, periods=stop_problem.update_periods(estimate), endpoints=estimate.endpoint_cells,
        steps_and_frames=stop_problem.steps_and_frames(estimate, problem.grid.resolution),
        distance_m=None if problem.prior.has_surfaces else problem.distance_m, device=problem.device,
    )  # fmt: skip
