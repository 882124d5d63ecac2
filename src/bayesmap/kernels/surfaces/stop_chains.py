"""Chains of reflectivities and surfaces on a device, and their sweeps.

On a GPU each kernel is launched once for all chains, with one thread per chain's cell or beam. On the CPU each chain is
one task from its first sweep to its last. If there are more threads than chains, a chain's beams are divided into
parts, one per thread. Counts are integers, and floating-point sums run over slices of fixed size. So the result does
not depend on threads or on other chains.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.cells.reflectivity import KernelNumbers
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Floats, Ints, Singles
from bayesmap.kernels.sensor_law import SensorLaw32, sensor_law
from bayesmap.kernels.surfaces import cell_draws, endpoint_cells, stops
from bayesmap.kernels.surfaces.endpoint_beams import endpoint_cells_to_device, room_for_blocks
from bayesmap.kernels.surfaces.square_counts import InSquares, count_in_squares, draw_stop_chances, square_arrays
from bayesmap.kernels.surfaces.surface import cells_to_device, pack_prior
from bayesmap.sensors.model import SensorModel

Launch = tuple[Any, int, list[Any]]  # a kernel, the number of a chain's elements, and the kernel's inputs

STATE_SIZE = 6  # numbers of a `Cell` that belong to its state; the other two do not
KERNELS = (
    cell_draws.begin_sweep, stops.pass_lazy_cells, stops.draw_stops, endpoint_cells.count_endpoint_cells,
    cell_draws.draw_labels, cell_draws.draw_untouched, cell_draws.update_free_cells,
    endpoint_cells.update_endpoint_cells, count_in_squares, draw_stop_chances,
)  # fmt: skip


def load_stop_kernels(device: str) -> Iterator[int]:
    """Compile the kernels of a sweep, or fetch them from Warp's cache, and yield the number of loaded kernels."""
    for done, kernel in enumerate(KERNELS, 1):
        devices.load_kernels(kernel, device)
        yield done


@dataclass(frozen=True, eq=False)
class Plan:
    """The parts that the sweeps of all chains share."""

    rays: Rays  # the beams, with flat indices of the grid's cells
    periods: NDArray[np.uint8]  # update period of each touched cell, in sweeps, (T,), see `cell_draws.ActiveCells`
    endpoints: Ints  # the cells in which readings end, flat, ascending, (U,)
    steps: Singles  # sizes and frames of these cells' steps, (U, 8)
    distance_m: Singles | None  # distance of a stop at each entry, if cells have no surfaces, (K,)
    device: str  # the device of the chains


class StopChains:
    """Several chains on a device, advanced in place."""

    def __init__(
        self, plan: Plan, states: Callable[[int], Singles], keys: Sequence[int], *, threads: int | None,
        counts: Ints | None = None, observed_counts: Ints | None = None, solid: NDArray[np.bool_] | None = None,
    ) -> None:  # fmt: skip
        """Put chains on the device, one per key. ``states`` returns the cells of a chain, (N, 6); ``solid`` holds their
        labels, (C, N), if any. Chains that continue have ``counts`` (C, 2, N) and ``observed_counts`` (C, N, 2).
        """
        self.plan = plan
        self.device = device = plan.device
        self.n_chains = chains = len(keys)
        self.without_surfaces = int(plan.distance_m is not None)
        cells, beams, touched = plan.rays.grid.n_cells, plan.rays.n_beams, len(plan.rays.touched)
        self.threads = (threads or devices.available_cores()) if device == "cpu" else 1
        self._rays = stops.traced_rays_to_device(plan.rays, plan.distance_m, device)
        self._schedule = stops.UpdateSchedule(plan.rays, plan.periods)
        self._lazy = self._schedule.mark_watched(self._rays, device)
        self._endpoints = endpoint_cells_to_device(plan.rays, plan.endpoints, plan.steps, device)
        self._active = devices.pack(
            cell_draws.ActiveCells, device, cell=plan.rays.touched, period=plan.periods, ny=plan.rays.grid.shape[1],
            edge_m=plan.rays.grid.resolution,
        )  # fmt: skip
        counted = plan.endpoints[:0] if self.without_surfaces else plan.endpoints
        self._status = cell_draws.status_to_device(cells, plan.rays.touched, counted, device)
        self._law: tuple[Any, ...] = ()
        self._packed: tuple[Any, Any] | None = None
        self._squares = square_arrays(plan.rays, 0 if self.without_surfaces else chains, device)

        # The state of all chains, with labels and counts from the host if given.
        parts = devices.ceil_div(self.threads, chains)
        by_cell, by_beam, by_part = (chains * cells,), (chains * beams,), (chains * parts, cells)
        unknown = np.full(by_cell, -1, dtype=np.int32)
        self._state: Any = devices.pack(
            stops.ChainArrays, device, n_cells=cells, n_beams=beams, parts=parts, beta=1.0,
            keys=np.array(keys, dtype=np.uint64), cells=by_cell,
            solid=by_cell if solid is None else solid.ravel().astype(np.uint8),
            fixed_m=np.full(by_cell, stops.LEARNS, dtype=np.float32),
            candidates=(1,) if self.without_surfaces else by_cell, met=by_part, hits=by_part, gain=by_part,
            stop=np.full(by_beam, -1, dtype=np.int32), stop_moments=by_beam, stopped_in=unknown, log_likelihood=by_beam,
            lazy_survival=by_beam, last_hits=by_cell if counts is None else counts[:, 0].flatten(),
            last_met=unknown.copy() if counts is None else counts[:, 1].flatten(),
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
        self, first: int, count: int, sensor: SensorModel, prior: KernelNumbers, beta: float = 1.0, *,
        steps: int = endpoint_cells.STEPS, observe_from: int | None = None,
        before: Callable[[int, int], None] | None = None, after: Callable[[int, int], None] | None = None,
    ) -> tuple[Floats, Floats]:  # fmt: skip
        """Advance every chain by ``count`` sweeps, numbered from ``first``, at the inverse temperature ``beta``.

        A surface makes ``steps`` Metropolis steps in a sweep, at most 24: a cell has random counters for this many.
        With 0, cells stay. From sweep ``observe_from`` on, the cells which beams observe are counted; with surfaces
        `in_squares` counts them. The callbacks get the numbers of chain and sweep, ``after`` on the thread of the
        sweep. Returns log-likelihood and log prior of the cells *before* each sweep, (chains, count) each.
        """
        packed = pack_prior(prior)
        law = sensor_law(sensor, self.plan.rays.limits, self.device, SensorLaw32)
        moved, starts = self._law != (sensor, prior, beta), not self.swept
        self._law, self._packed, self._state.beta = (sensor, prior, beta), (law, packed), beta
        if moved:
            self._launch(stops.compute_decays, self.plan.rays.n_beams, [law, self._rays])
        zeros = partial(wp.zeros, (self.n_chains, count), dtype=wp.float64, device=self.device)
        likelihood, log_prior = zeros(), zeros()
        beams, touched = self.plan.rays.n_beams, len(self.plan.rays.touched)
        endpoints = 0 if self.without_surfaces else len(self.plan.endpoints)
        state, all_chains = self._state, range(self.n_chains)
        shape, cells = self.plan.rays.grid.shape, state.n_cells
        endpoint_inputs = [self._endpoints, self._active, state, self._lists]
        beam_sums, cell_sums, label_sums = self._slices

        def cell_launches(sweep: int) -> list[Launch]:
            """Return the kernels that draw the cells given the stops."""
            launches = [(endpoint_cells.count_endpoint_cells, endpoints, [sweep, *endpoint_inputs])]
            if prior.coupling > 0:
                launches.append((cell_draws.sum_label_prior, label_sums.shape[1], [*shape, packed, state, label_sums]))
                inputs = [sweep, *shape, packed, self._status, state]
                launches += [(cell_draws.draw_labels, cells, [colour, *inputs]) for colour in (0, 1)]
            inputs = [sweep, self.without_surfaces, packed, self._active, state]
            launches.append((cell_draws.update_free_cells, touched, inputs))
            inputs = [sweep, steps, law, packed, self._rays, *endpoint_inputs, self._blocks]
            launches.append((endpoint_cells.update_endpoint_cells, endpoints, inputs))
            if self.without_surfaces and observe_from is not None and sweep >= observe_from:
                launches.append((cell_draws.count_observed, touched, [self._active, state]))
            return launches

        def sweep_launches(i: int) -> list[Launch]:
            """Return the kernels of the i-th sweep in their order."""
            sweep, changed = first + i, int(moved and i == 0)
            lazy, lazy_before = (int(self._schedule.updates_lazy(number)) for number in (sweep, sweep - 1))
            inputs = [sweep, self.without_surfaces, packed, changed, self._active, state, self._log_priors]
            launches = [(cell_draws.begin_sweep, touched, inputs)]
            if not lazy and (lazy_before or (starts and i == 0)):
                launches.append((stops.pass_lazy_cells, beams, [self._lazy, self._rays, state]))
            launches.append((stops.draw_stops, beams, [sweep, lazy, law, self._rays, state]))
            if steps > 0:
                launches += cell_launches(sweep)
            launches.append((cell_draws.sum_slices, beam_sums.shape[1], [beams, state.log_likelihood, beam_sums]))
            launches.append((cell_draws.sum_slices, cell_sums.shape[1], [touched, self._log_priors, cell_sums]))
            launches.append((cell_draws.sum_log_joint, 1, [i, beam_sums, cell_sums, label_sums, likelihood, log_prior]))
            return launches

        def report(callback: Callable[[int, int], None] | None, chains: range, i: int) -> None:
            for chain in chains:
                if callback is not None:
                    callback(chain, first + i)

        def make_sweeps(chains: range, run: Callable[[Launch], None]) -> None:
            """Make all sweeps of some chains; ``run`` runs a kernel for all of them."""
            for i in range(count):
                report(before, chains, i)
                for launch in sweep_launches(i):
                    run(launch)
                report(after, chains, i)

        def sweep_alone(chains: range) -> None:
            """Make all sweeps of neighbouring chains on this thread."""
            make_sweeps(chains, lambda launch: self._launch_part(launch, (chains, 0)))

        if self.device != "cpu":
            sweep_alone(all_chains)
        elif state.parts == 1:
            self._map(sweep_alone, [range(chain, chain + 1) for chain in all_chains])
        else:
            parts = [(range(chain, chain + 1), part) for chain in all_chains for part in range(state.parts)]
            make_sweeps(all_chains, lambda launch: self._map(partial(self._launch_part, launch), parts))
        return likelihood.numpy(), log_prior.numpy()

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

    def _launch(self, kernel: Any, size: int, inputs: list[Any]) -> None:
        """Launch a kernel over ``size`` elements."""
        wp.launch(kernel, dim=size, inputs=[0, *inputs], device=self.device)

    def _map(self, work: Callable[[Any], None], tasks: Sequence[Any]) -> None:
        """Do all tasks, on the pool of threads if there are several of both."""
        if self.threads == 1 or len(tasks) == 1:
            for task in tasks:
                work(task)
            return
        list(load_stop_kernels(self.device))
        list(devices.thread_pool(self.threads).map(work, tasks))

    def _of(self, array: Any, chain: int) -> NDArray[Any]:
        """Return the part of an array that belongs to a chain: no copy on the CPU, valid until the next sweep."""
        size = array.shape[0] // self.n_chains
        return np.asarray(array[chain * size : (chain + 1) * size].numpy())

    def cells(self, chain: int) -> Singles:
        """Return all cells of a chain, (N, 6): no copy on the CPU, valid until the next sweep."""
        return self._of(self._state.cells, chain)[:, :STATE_SIZE]

    def put_cells(self, chain: int, states: Singles, solid: NDArray[np.bool_] | None = None) -> None:
        """Replace the cells of a chain, (N, 6), and their labels, (N,), if cells have labels."""
        of_chain = slice(chain * self._state.n_cells, (chain + 1) * self._state.n_cells)
        wp.copy(self._state.cells[of_chain], cells_to_device(states, self.device))
        if solid is not None:
            wp.copy(self._state.solid[of_chain], wp.array(solid.astype(np.uint8), dtype=wp.uint8, device=self.device))
        self._law, self._packed = (), None  # numbers computed from the cells before are out of date

    def solid(self, chain: int) -> NDArray[np.bool_]:
        """Return the labels of all cells of a chain, (N,), valid until the next sweep; all free if cells have none."""
        return self._of(self._state.solid, chain).view(np.bool_)

    def draw_untouched(self, sweep: int) -> None:
        """Draw the reflectivities of cells that no beam touches, which sweeps leave out, before the sweep ``sweep``."""
        assert self._packed is not None, "no sweep has been made"
        size = self.n_chains * self._state.n_cells
        self._launch(cell_draws.draw_untouched, size, [sweep, self._packed[1], self._status, self._state])

    def counted(self, chain: int) -> tuple[Ints, Ints]:
        """Return the beams that each cell stopped, and that met its surface and passed, (N,) each, when it last drew
        its reflectivity (before it, the second is -1). The arrays are valid until the next sweep.
        """
        return self._of(self._state.last_hits, chain), self._of(self._state.last_met, chain)

    @property
    def swept(self) -> bool:
        """Whether these chains have made a sweep on this device, so that beams have stopped somewhere."""
        return self._packed is not None

    def in_squares(self, chain: int, sweep: int, kept: bool, solid: NDArray[np.bool_] | None = None) -> InSquares:
        """Count the stops of a chain with surfaces in each square, after its last sweep, which has this number.
        If ``kept``, `observed_counts` counts the draw. ``solid`` holds the labels before the sweep, (N,), if any.
        """
        assert self._squares, "cells without surfaces stop beams inside their own squares"
        assert self._packed is not None, "no sweep has been made"
        (law, prior), squares, touched, state = self._packed, self._squares[chain], self.plan.rays.touched, self._state
        squares.stopped_inside.zero_()
        squares.stopped_before.zero_()
        inputs = [chain, sweep, law, self._rays, state, squares]
        wp.launch(count_in_squares, dim=state.n_beams, inputs=inputs, device=self.device)
        labels = state.solid[chain * state.n_cells : (chain + 1) * state.n_cells]
        if solid is not None:
            labels = devices.to_device(solid, wp.uint8, self.device)
        inputs = [chain, sweep, prior, state, squares, labels, int(kept)]
        wp.launch(draw_stop_chances, dim=len(touched), inputs=inputs, device=self.device)
        arrays = squares.crossings, squares.stopped_inside, squares.stopped_before
        crossings, stopped, stopped_before = (a.numpy()[touched] for a in arrays)
        chances = (np.array(a.numpy()) for a in (squares.drawn, squares.expected))
        return InSquares(stopped, crossings - stopped - stopped_before, *chances)

    def observed_counts(self, chain: int) -> Ints:
        """Return the draws in which some beam observes each cell, and the draws inspected, (N, 2); see `counted`.
        With surfaces the kept draws are inspected, without surfaces the sweeps in which the cell has counted.
        """
        return self._of(self._state.observed_counts, chain)

    def log_likelihood(self, chain: int) -> Singles:
        """Return each beam's log-likelihood before a chain's last sweep, over all stops, (B,), valid until the next."""
        return self._of(self._state.log_likelihood, chain)

    def stopped_by(self, chain: int) -> Ints:
        """Return the cell that stopped each beam of a chain in its last sweep, flat; -1 for none, (B,)."""
        stop, rays = self._of(self._state.stop, chain), self.plan.rays
        stopped = stop < rays.offsets[1:]
        cells = np.full(len(stop), -1, dtype=np.int32)  # the rays may have no cells at all
        cells[stopped] = rays.cells[stop[stopped]]
        return cells

    def stops(self, chain: int) -> tuple[NDArray[np.bool_], Singles, Singles]:
        """Return whether each beam of a chain stopped, at what distance in metres and with what variance, (B,) each."""
        distance_m, variance = self._of(self._state.stop_moments, chain).T.copy()
        return self._of(self._state.stop, chain) < self.plan.rays.offsets[1:], distance_m, variance
