"""Chains of reflectivities and surfaces on a device, and their sweeps.

A sweep draws where the beams stop, given the cells, then the cells, given these stops. On a GPU each kernel is launched
once for all chains, with one thread per chain's cell or beam. On the CPU each chain is one task from its first sweep to
its last. If there are more threads than chains, a chain's beams are divided into parts, one per thread. Counts are
integers, and floating-point sums run over slices of fixed size. So the result does not depend on threads or on other
chains. `StopChains.sweeps` is the main function, and `StopChains._sweep_launches` has the order of the kernels.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product
from typing import Any, NamedTuple

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.cells.reflectivity import PriorParameters
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Floats, Ints, Singles
from bayesmap.kernels.sensor_law import SensorLaw32, sensor_law
from bayesmap.kernels.surfaces import cell_draws, endpoint_cells, stops
from bayesmap.kernels.surfaces.endpoint_beams import StopLikelihood, endpoint_cells_to_device, room_for_blocks
from bayesmap.kernels.surfaces.square_counts import SquareCounts, count_in_squares, draw_stop_chances, square_arrays
from bayesmap.kernels.surfaces.surface import cells_to_device, pack_prior
from bayesmap.sensors.model import SensorModel

STATE_SIZE = 6  # numbers of a `Cell` that belong to its state; the other two do not
KERNELS = (
    cell_draws.begin_sweep, stops.pass_lazy_cells, stops.draw_stops, endpoint_cells.list_and_count_beams,
    cell_draws.draw_labels, cell_draws.draw_untouched, cell_draws.update_free_cells,
    endpoint_cells.update_endpoint_cells, count_in_squares, draw_stop_chances,
)  # fmt: skip


def load_stop_kernels(device: str) -> Iterator[int]:
    """Compile the kernels of a sweep, or fetch them from Warp's cache, and yield the number of loaded kernels."""
    for loaded, kernel in enumerate(KERNELS, 1):
        devices.load_kernels(kernel, device)
        yield loaded


@dataclass(frozen=True, eq=False)
class Plan:
    """The problem that the sweeps of all chains share."""

    rays: Rays  # the beams, with flat indices of the grid's cells
    periods: NDArray[np.uint8]  # update period of each touched cell, in sweeps, (T,), see `cell_draws.ActiveCells`
    endpoints: Ints  # the cells in which readings end, flat, ascending, (U,)
    steps_and_frames: Singles  # sizes and frames of these cells' steps, (U, 8)
    distance_m: Singles | None  # distance of a stop at each entry, if cells have no surfaces, (K,)
    device: str  # the device of the chains


class Launch(NamedTuple):
    """A kernel, to be launched for all elements of a chain, such as its beams or its cells."""

    kernel: Any
    size: int  # number of a chain's elements
    inputs: list[Any]


class SweepRequest(NamedTuple):
    """The arguments of one call of `StopChains.sweeps`, and its results on the device."""

    first: int
    count: int
    steps: int
    observe_from: int | None
    before: Callable[[int, int], None] | None
    after: Callable[[int, int], None] | None
    likelihood: Any  # `StopLikelihood`
    laws_changed: bool  # sensor, prior or beta differ from those of the last call
    is_start: bool  # the chains have not made a sweep yet
    log_likelihood: Any  # (chains, sweeps)
    log_prior: Any  # (chains, sweeps)


class ChainStops(NamedTuple):
    """The stops of a chain's beams, (B,) each."""

    stopped: NDArray[np.bool_]  # false for a beam that stopped nowhere
    distance_m: Singles
    variance: Singles  # variance of the distance, square metres


class StopChains:
    """Several chains on a device, advanced in place. Chain i has the key of random numbers ``keys[i]``."""

    def __init__(
        self, plan: Plan, states: Callable[[int], Singles], keys: Sequence[int], *, threads: int | None,
        counts: Ints | None = None, observed_counts: Ints | None = None, solid: NDArray[np.bool_] | None = None,
    ) -> None:  # fmt: skip
        """Put chains on the device, one per key; ``states`` returns the cells of each, (N, 6).
        ``solid`` holds labels (C, N). Chains that continue have ``counts`` (C, 2, N) and ``observed_counts`` (C, N, 2).
        """
        self.plan = plan
        self.device = device = plan.device
        self.n_chains = chains = len(keys)
        self.without_surfaces = int(plan.distance_m is not None)
        rays = plan.rays
        cells, beams, touched = rays.grid.n_cells, rays.n_beams, len(rays.touched)
        self.threads = (threads or devices.available_cores()) if device == "cpu" else 1
        self._rays = devices.pack(
            stops.TracedRays, device, without_surfaces=self.without_surfaces, offsets=rays.offsets, cells=rays.cells,
            first_near=rays.first_near, start_m=rays.start_m, direction=rays.direction, range_m=rays.range_m,
            decay=(beams,), distance_m=np.zeros(1) if plan.distance_m is None else plan.distance_m,
        )  # fmt: skip
        self._schedule = stops.UpdateSchedule(rays, plan.periods)
        self._lazy = self._schedule.watched_to_device(self._rays, device)
        self._endpoints = endpoint_cells_to_device(rays, plan.endpoints, plan.steps_and_frames, device)
        fields = {"cell": rays.touched, "period": plan.periods, "without_surfaces": self.without_surfaces}
        self._active = devices.pack(cell_draws.ActiveCells, device, **fields)
        endpoints = plan.endpoints[:0] if self.without_surfaces else plan.endpoints
        self._kinds = cell_draws.kinds_to_device(cells, rays.touched, endpoints, device)
        self._laws: tuple[Any, ...] = ()  # sensor, prior and beta of the last sweep; empty if cells were replaced since
        self._law: Any = None  # `SensorLaw32` of the last sweep; None before the first one
        self._prior: Any = None  # `PriorArrays` of the last sweep
        self._squares = square_arrays(rays, 0 if self.without_surfaces else chains, device)
        # The state of all chains, with labels and counts from the host if given.
        parts = devices.ceil_div(self.threads, chains)
        by_cell, by_beam, by_part = (chains * cells,), (chains * beams,), (chains * parts, cells)
        unset = np.full(by_cell, -1, dtype=np.int32)  # no sweep yet, and `stops.NOT_COUNTED`
        self._state: Any = devices.pack(
            stops.ChainArrays, device, n_cells=cells, n_beams=beams, parts=parts, beta=1.0, nx=rays.grid.shape[0],
            ny=rays.grid.shape[1], edge_m=rays.grid.resolution, keys=np.array(keys, dtype=np.uint64),
            cells=by_cell, solid=by_cell if solid is None else solid.ravel().astype(np.uint8),
            fixed_reflectivity=np.full(by_cell, stops.LEARNS, dtype=np.float32),
            candidates=(1,) if self.without_surfaces else by_cell, met=by_part, hits=by_part, gain=by_part,
            stop=np.full(by_beam, -1, dtype=np.int32), stop_moments=by_beam, stopped_in=unset, log_likelihood=by_beam,
            lazy_survival=by_beam, last_hits=by_cell if counts is None else counts[:, 0].flatten(),
            last_met=unset.copy() if counts is None else counts[:, 1].flatten(),
            observed_counts=by_cell if observed_counts is None else np.array(observed_counts).reshape(-1, 2),
        )  # fmt: skip
        for chain in range(chains):
            self.put_cells(chain, states(chain))
        # Working memory of the kernels. Without labels, the slices of their prior stay zero.
        incidences, passes = (chains, self._endpoints.entry.shape[0]), (chains, len(plan.endpoints))
        self._lists = devices.pack(endpoint_cells.BeamLists, device, entries=incidences, passes=passes)
        self._blocks = room_for_blocks(self._endpoints, chains * parts, device)
        self._log_priors = wp.zeros(chains * touched, dtype=wp.float32, device=device)
        slices = [max(devices.ceil_div(size, cell_draws.SLICE), 1) for size in (beams, touched, cells)]
        self._slices = [wp.zeros((chains, count), dtype=wp.float64, device=device) for count in slices]

    def sweeps(
        self, first: int, count: int, sensor: SensorModel, prior: PriorParameters, beta: float = 1.0, *,
        steps: int = endpoint_cells.STEPS, observe_from: int | None = None,
        before: Callable[[int, int], None] | None = None, after: Callable[[int, int], None] | None = None,
    ) -> tuple[Floats, Floats]:  # fmt: skip
        """Advance every chain by ``count`` sweeps, numbered from ``first``, at the inverse temperature ``beta``.
        A surface makes ``steps`` Metropolis steps in a sweep, at most 24: a cell has random counters for this many.
        With 0, cells stay. From sweep ``observe_from`` on, the cells which beams observe are counted; with surfaces
        `in_squares` counts them. The callbacks get the numbers of chain and sweep, ``after`` on the thread of the
        sweep. Returns log-likelihood and log prior of the cells *before* each sweep, (chains, count) each.
        """
        laws_changed = self._laws != (sensor, prior, beta)
        is_start = not self.has_swept
        law = sensor_law(sensor, self.plan.rays.limits, self.device, SensorLaw32)
        self._laws = (sensor, prior, beta)
        self._law, self._prior = law, pack_prior(prior)
        self._state.beta = beta
        if laws_changed:
            wp.launch(stops.compute_decays, dim=self.plan.rays.n_beams, inputs=[0, law, self._rays], device=self.device)
        sums = [wp.zeros((self.n_chains, count), dtype=wp.float64, device=self.device) for _ in range(2)]
        beams = {"rays": self._rays, "endpoints": self._endpoints}
        likelihood = devices.pack(StopLikelihood, self.device, law=law, beta=beta, **beams)
        request = SweepRequest(
            first, count, steps, observe_from, before, after, likelihood, laws_changed, is_start, *sums
        )
        single_chains = [range(chain, chain + 1) for chain in range(self.n_chains)]
        if self.device != "cpu":
            self._sweep_alone(request, range(self.n_chains))
        elif self._state.parts == 1:
            self._map(partial(self._sweep_alone, request), single_chains)
        else:  # every kernel ends in all parts of all chains before the next one starts
            parts = list(product(single_chains, range(self._state.parts)))
            all_chains = range(self.n_chains)
            self._make_sweeps(request, all_chains, lambda launch: self._map(partial(self._launch_part, launch), parts))
        return request.log_likelihood.numpy(), request.log_prior.numpy()

    def _sweep_alone(self, request: SweepRequest, chains: range) -> None:
        """Make all sweeps of neighbouring chains on this thread."""
        self._make_sweeps(request, chains, lambda launch: self._launch_part(launch, (chains, 0)))

    def _make_sweeps(self, request: SweepRequest, chains: range, run: Callable[[Launch], None]) -> None:
        """Make all sweeps of neighbouring chains; ``run`` runs a kernel for all of them."""
        for sweep in range(request.first, request.first + request.count):
            if request.before is not None:
                for chain in chains:
                    request.before(chain, sweep)
            for launch in self._sweep_launches(request, sweep):
                run(launch)
            if request.after is not None:
                for chain in chains:
                    request.after(chain, sweep)

    def _sweep_launches(self, request: SweepRequest, sweep: int) -> list[Launch]:
        """Return the launches of a sweep in their order."""
        beams, touched, state = self.plan.rays.n_beams, len(self.plan.rays.touched), self._state
        is_first = sweep == request.first
        # Reset counts, and draw candidates. Lazy cells keep their part in a beam's chance until they are updated.
        inputs = [sweep, self._prior, int(request.laws_changed and is_first), self._active, state, self._log_priors]
        launches = [Launch(cell_draws.begin_sweep, touched, inputs)]
        lazy, lazy_before = (int(self._schedule.updates_lazy(number)) for number in (sweep, sweep - 1))
        if not lazy and (lazy_before or (request.is_start and is_first)):
            launches.append(Launch(stops.pass_lazy_cells, beams, [self._lazy, self._rays, state]))
        # Draw the stops given the cells, then the cells given the stops.
        launches.append(Launch(stops.draw_stops, beams, [sweep, lazy, self._law, self._rays, state]))
        if request.steps > 0:
            launches += self._cell_launches(request, sweep)
        # Sum the log joint of the cells before the sweep.
        beam_sums, cell_sums = self._slices[:2]
        inputs = [sweep - request.first, *self._slices, request.log_likelihood, request.log_prior]
        return [
            *launches,
            Launch(cell_draws.sum_slices, beam_sums.shape[1], [beams, state.log_likelihood, beam_sums]),
            Launch(cell_draws.sum_slices, cell_sums.shape[1], [touched, self._log_priors, cell_sums]),
            Launch(cell_draws.sum_log_joint, 1, inputs),
        ]

    def _cell_launches(self, request: SweepRequest, sweep: int) -> list[Launch]:
        """Return the launches that draw the cells given the stops."""
        state, prior = self._state, self._prior
        touched, label_sums = len(self.plan.rays.touched), self._slices[2]
        endpoints = 0 if self.without_surfaces else len(self.plan.endpoints)
        inputs = [sweep, self._endpoints, state, self._lists]
        launches = [Launch(endpoint_cells.list_and_count_beams, endpoints, inputs)]
        if prior.coupling > 0:  # cells of one colour of the checkerboard after those of the other
            launches.append(Launch(cell_draws.sum_label_prior, label_sums.shape[1], [prior, state, label_sums]))
            inputs = [sweep, prior, self._kinds, state]
            launches += [Launch(cell_draws.draw_labels, state.n_cells, [colour, *inputs]) for colour in (0, 1)]
        launches.append(Launch(cell_draws.update_free_cells, touched, [sweep, prior, self._active, state]))
        inputs = [sweep, request.steps, request.likelihood, prior, state, self._lists, self._blocks]
        launches.append(Launch(endpoint_cells.update_endpoint_cells, endpoints, inputs))
        if self.without_surfaces and request.observe_from is not None and sweep >= request.observe_from:
            launches.append(Launch(cell_draws.count_observed, touched, [self._active, state]))
        return launches

    def _launch_part(self, launch: Launch, chains_and_part: tuple[range, int]) -> None:
        """Launch a kernel over a part of the elements of neighbouring chains."""
        (kernel, size, inputs), (chains, part) = launch, chains_and_part
        begin, end = (size * i // self._state.parts for i in (part, part + 1))
        if len(chains) > 1:  # all elements of all chains: several chains are launched together only without parts
            end = size * len(chains)
        if end > begin:
            first = chains.start * size + begin
            by_parts = kernel in (stops.draw_stops, endpoint_cells.update_endpoint_cells)
            inputs = [first, part, *inputs] if by_parts else [first, *inputs]
            wp.launch(kernel, dim=end - begin, inputs=inputs, device=self.device)

    def _map(self, work: Callable[[Any], None], tasks: Sequence[Any]) -> None:
        """Do all tasks, on the pool of threads if there are several of both."""
        if self.threads == 1 or len(tasks) == 1:
            for task in tasks:
                work(task)
            return
        list(load_stop_kernels(self.device))
        list(devices.thread_pool(self.threads).map(work, tasks))

    def _view(self, array: Any, chain: int) -> NDArray[Any]:
        """Return the elements of an array that belong to a chain: no copy on the CPU, valid until the next sweep."""
        size = array.shape[0] // self.n_chains
        return np.asarray(array[chain * size : (chain + 1) * size].numpy())

    def cells(self, chain: int) -> Singles:
        """Return all cells of a chain, (N, 6): no copy on the CPU, valid until the next sweep."""
        return self._view(self._state.cells, chain)[:, :STATE_SIZE]

    def put_cells(self, chain: int, states: Singles, solid: NDArray[np.bool_] | None = None) -> None:
        """Replace the cells of a chain, (N, 6), and their labels, (N,), if cells have labels."""
        of_chain = slice(chain * self._state.n_cells, (chain + 1) * self._state.n_cells)
        wp.copy(self._state.cells[of_chain], cells_to_device(states, self.device))
        if solid is not None:
            wp.copy(self._state.solid[of_chain], wp.array(solid.astype(np.uint8), dtype=wp.uint8, device=self.device))
        self._laws, self._law = (), None  # numbers computed from the cells before are out of date

    def solid(self, chain: int) -> NDArray[np.bool_]:
        """Return the labels of a chain's cells, (N,), valid until the next sweep. All are free if cells have none."""
        return self._view(self._state.solid, chain).view(np.bool_)

    def draw_untouched(self, sweep: int) -> None:
        """Draw the reflectivities of cells that no beam touches, which sweeps leave out, before the sweep ``sweep``."""
        assert self.has_swept, "no sweep has been made"
        size = self.n_chains * self._state.n_cells
        inputs = [0, sweep, self._prior, self._kinds, self._state]
        wp.launch(cell_draws.draw_untouched, dim=size, inputs=inputs, device=self.device)

    def hits_and_passes(self, chain: int) -> tuple[Ints, Ints]:
        """Return the hits and passes of each cell's last draw, (N,) each. Before its first draw they are 0 and -1."""
        return self._view(self._state.last_hits, chain), self._view(self._state.last_met, chain)

    @property
    def has_swept(self) -> bool:
        """True if these chains have made a sweep on this device, so that beams have stopped somewhere."""
        return self._law is not None

    def in_squares(self, chain: int, sweep: int, is_kept: bool, solid: NDArray[np.bool_] | None = None) -> SquareCounts:
        """Count the stops of a chain with surfaces in each square, after its last sweep, which has this number.
        If ``is_kept``, `observed_counts` counts the draw. ``solid`` holds the labels before the sweep, (N,), if any.
        """
        assert self._squares, "cells without surfaces stop beams inside their own squares"
        assert self.has_swept, "no sweep has been made"
        squares, touched, state = self._squares[chain], self.plan.rays.touched, self._state
        # Count the stops of beams in squares, then draw each square's chance of a stop given its counts.
        squares.stopped_inside.zero_()
        squares.stopped_before.zero_()
        inputs = [chain, sweep, self._law, self._rays, state, squares]
        wp.launch(count_in_squares, dim=state.n_beams, inputs=inputs, device=self.device)
        labels = state.solid[chain * state.n_cells : (chain + 1) * state.n_cells]
        if solid is not None:
            labels = devices.to_device(solid, wp.uint8, self.device)
        inputs = [chain, sweep, self._prior, state, squares, labels, int(is_kept)]
        wp.launch(draw_stop_chances, dim=len(touched), inputs=inputs, device=self.device)
        arrays = squares.crossings, squares.stopped_inside, squares.stopped_before
        crossings, stopped, stopped_before = (a.numpy()[touched] for a in arrays)
        chances = (np.array(a.numpy()) for a in (squares.drawn, squares.expected))
        return SquareCounts(stopped, crossings - stopped - stopped_before, *chances)

    def observed_counts(self, chain: int) -> Ints:
        """Count the draws in which at least one beam observes each cell, and the draws inspected, (N, 2)."""
        return self._view(self._state.observed_counts, chain)

    def log_likelihood(self, chain: int) -> Singles:
        """Return each beam's log-likelihood before a chain's last sweep, over all stops, (B,), valid until the next."""
        return self._view(self._state.log_likelihood, chain)

    def stopped_by(self, chain: int) -> Ints:
        """Return the cell that stopped each beam of a chain in its last sweep, flat, or -1 for none, (B,)."""
        stop, rays = self._view(self._state.stop, chain), self.plan.rays
        stopped = stop < rays.offsets[1:]
        cells = np.full(len(stop), -1, dtype=np.int32)  # the rays may have no cells at all
        cells[stopped] = rays.cells[stop[stopped]]
        return cells

    def stops(self, chain: int) -> ChainStops:
        """Return the stops of a chain's beams in its last sweep."""
        distance_m, variance = self._view(self._state.stop_moments, chain).T.copy()
        return ChainStops(self._view(self._state.stop, chain) < self.plan.rays.offsets[1:], distance_m, variance)
