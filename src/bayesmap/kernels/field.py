"""Chains of cell states on a device, and a sweep of them: propose, let the beams speak, settle.

On the CPU the chains' beams are cut into parts, one a thread, each with counts of its own; on a GPU every beam of a
chain is a thread, and the counts are atomic. They are whole numbers, so the result depends on neither.
"""

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.beam_rays import BeamRays
from bayesmap.kernels import device as devices
from bayesmap.kernels.busy import busy_index, update_busy
from bayesmap.kernels.cell_draws import CellPrior, propose, settle
from bayesmap.kernels.likelihood import sensor_parameters
from bayesmap.kernels.meeting import Cell
from bayesmap.kernels.parallel import available_cores, thread_pool
from bayesmap.kernels.random import mix
from bayesmap.kernels.stops import IN_A_ROW, Field, Rays, draw_stops
from bayesmap.sensors.model import KernelParameters, RangeLimits

STATE_SIZE = 6  # of a Cell's eight numbers: the other two live for one sweep


@dataclass(frozen=True)
class PriorNumbers:
    """Prior of reflectivity and surface, lengths in metres; see `bayesmap.kernels.cell_draws`."""

    a: float
    b: float
    tau_m: float
    psi_m2: float
    nu: float
    kappa_m: float


def put_rays(rays: BeamRays, plain: bool, device: str) -> Any:
    """Rays where kernels read them."""
    there = Rays()
    there.plain = int(plain)
    for name, dtype in (("offsets", wp.int32), ("cells", wp.int32), ("distance_m", wp.float32), ("near", wp.int32)):
        setattr(there, name, devices.to_device(getattr(rays, name), dtype, device))
    there.start_m = wp.array(rays.start_m, dtype=wp.vec2, device=device)
    there.direction = wp.array(rays.direction, dtype=wp.vec2, device=device)
    there.range_m = devices.to_device(rays.range_m, wp.float32, device)
    return there


def as_cells(states: NDArray[np.float32], device: str) -> Any:
    """(T, 6) numbers as an array of `Cell`."""
    padded = np.zeros((len(states), 8), dtype=np.float32)
    padded[:, : states.shape[1]] = states
    return wp.array(padded, dtype=Cell, device=device)


KERNELS = (propose, draw_stops, settle, update_busy)


def load_field_kernels(device: str) -> Iterator[int]:
    """Compile what sweeps need, or fetch it from Warp's cache, and count the kernels that are there."""
    for done, kernel in enumerate(KERNELS, 1):
        devices.load_kernels(kernel, device)
        yield done


class FieldChains:
    """Chains where kernels change them."""

    def __init__(
        self,
        rays: BeamRays,
        states: NDArray[np.float32],
        steps: NDArray[np.float32],
        pace: NDArray[np.int32],
        *,
        plain: bool,
        seed: int,
        stream: int,
        threads: int | None,
        device: str,
        counts: NDArray[np.int32] | None = None,
    ) -> None:
        """Put chains that stand at ``states``, (C, T, 6), on the device; ``counts`` (2, C, T) if they go on.

        ``steps`` and ``pace`` are each cell's, as `bayesmap.samplers.plug_in` has them.
        """
        self.rays, self.device, self.plain = rays, device, int(plain)
        self._rays = put_rays(rays, plain, device)
        self._steps = wp.array(np.ascontiguousarray(steps, dtype=np.float32), dtype=Cell, device=device)
        self._pace = devices.to_device(pace, wp.int32, device)
        self._last_prior: PriorNumbers | None = None
        self._centres = wp.array(rays.centres_m().astype(np.float32), dtype=wp.vec2, device=device)
        self._keys = [(seed, chain, stream) for chain in range(len(states))]
        self.threads = (threads or available_cores()) if device == "cpu" else 1
        parts = max(1, -(-self.threads // len(states)))
        edges = [rays.n_beams * i // parts for i in range(parts + 1)]
        self._parts = list(itertools.pairwise(edges))
        cells = rays.n_cells
        self._busy = busy_index(rays, (pace == 0) & (not plain), device)

        def empty(shape: Any, dtype: Any) -> Any:
            return wp.zeros(shape, dtype=dtype, device=device)

        self._fields = []
        for state in states:
            field = Field()
            field.cells = as_cells(state, device)
            field.candidates, field.glance = empty(-(-cells // IN_A_ROW), Cell), empty(cells, wp.float32)
            field.met, field.hits = empty((parts, cells), wp.int32), empty((parts, cells), wp.int32)
            field.gain = empty((parts, cells), wp.int64)
            field.faded = empty(rays.n_beams, wp.float32)
            field.stop = empty(rays.n_beams, wp.int32)
            field.where = empty(rays.n_beams, wp.vec2)
            field.log_likelihood = empty(rays.n_beams, wp.float32)
            self._fields.append(field)
        if counts is None:
            counts = np.zeros((2, len(states), cells), dtype=np.int32)
            counts[1] = -1
        self._totals = [
            tuple(wp.array(of[chain], dtype=wp.int32, device=device) for of in counts) for chain in range(len(states))
        ]
        incidences = self._busy.entry.shape[0]
        self._concerned = [empty(incidences, wp.int32) for _ in states]
        self._log_priors = [empty(cells, wp.float32) for _ in states]

    def sweep(
        self, number: int, sensor: KernelParameters, prior: PriorNumbers
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Advance every chain by one sweep.

        Returns:
            log-likelihood and log prior of the cells as they were *before* the sweep, (C,) each.
        """
        packed = CellPrior()
        packed.a, packed.b, packed.tau_m = prior.a, prior.b, prior.tau_m
        packed.psi_m2, packed.nu, packed.kappa_m = prior.psi_m2, prior.nu, prior.kappa_m
        moved, self._last_prior = int(prior != self._last_prior), prior
        limits = RangeLimits(self.rays.limits.min_m, self.rays.limits.max_m)
        law = sensor_parameters(sensor, limits)
        keys = [
            wp.array(
                np.array([mix(*key, number, half) for half in (0, 1)], dtype=np.uint64), dtype=wp.uint64,
                device=self.device,
            )
            for key in self._keys
        ]  # fmt: skip
        cells, chains = self.rays.n_cells, range(len(self._fields))

        def start(i: int) -> None:
            inputs = [0, self.plain, packed, moved, self._centres, self._pace, self._fields[i], keys[i], number]
            inputs.append(self._log_priors[i])
            wp.launch(propose, dim=cells, inputs=inputs, device=self.device)

        def speak(task: tuple[int, int]) -> None:
            i, part = task
            first, last = self._parts[part]
            inputs = [first, part, law, self._rays, self._fields[i], keys[i]]
            wp.launch(draw_stops, dim=last - first, inputs=inputs, device=self.device)

        def finish(i: int) -> None:
            inputs = [0, packed, self._fields[i], keys[i], *self._totals[i]]
            wp.launch(settle, dim=cells, inputs=inputs, device=self.device)
            if not self.plain:
                inputs = [0, law, packed, self._rays, self._busy, self._centres, self._steps, self._fields[i]]
                inputs += [self._concerned[i], keys[i], *self._totals[i]]
                wp.launch(update_busy, dim=self._busy.cell.shape[0], inputs=inputs, device=self.device)

        self._each(start, chains)
        self._each(speak, [(i, part) for i in chains for part in range(len(self._parts))])
        self._each(finish, chains)
        likelihood = [field.log_likelihood.numpy().sum(dtype=np.float64) for field in self._fields]
        prior_sums = [log_prior.numpy().sum(dtype=np.float64) for log_prior in self._log_priors]
        return np.array(likelihood), np.array(prior_sums)

    def _each(self, work: Callable[[Any], None], tasks: Sequence[Any]) -> None:
        if self.threads == 1 or len(tasks) == 1:
            for task in tasks:
                work(task)
            return
        for kernel in KERNELS:
            devices.load_kernels(kernel, self.device)
        list(thread_pool(self.threads).map(work, tasks))

    @property
    def n_chains(self) -> int:
        """Number of chains."""
        return len(self._fields)

    def cells(self, chain: int) -> NDArray[np.float32]:
        """All cells of a chain, (T, 6): on the CPU not a copy, and good until the next sweep."""
        return np.asarray(self._fields[chain].cells.numpy()[:, :STATE_SIZE])

    def counted(self, chain: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """How many beams stopped in each cell of a chain, and how many met its surface and passed, (T,) each, likewise.

        They are those of the sweep in which the cell last drew its reflectivity; ``met`` is -1 if it has not yet.
        """
        hits, met = self._totals[chain]
        return np.asarray(hits.numpy()), np.asarray(met.numpy())

    def states(self) -> NDArray[np.float32]:
        """A copy of all cells, (C, T, 6)."""
        return np.stack([self.cells(chain) for chain in range(self.n_chains)])

    def counts(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Copies of all chains' counts, (C, T) each."""
        hits, met = zip(*(self.counted(chain) for chain in range(self.n_chains)), strict=True)
        return np.stack(hits), np.stack(met)

    def stops(self, chain: int) -> tuple[NDArray[np.bool_], NDArray[np.float32], NDArray[np.float32]]:
        """Of every beam of a chain: whether it stopped, at what distance in metres, and with what variance, (B,)."""
        field = self._fields[chain]
        where = field.where.numpy()
        return field.stop.numpy() < self.rays.offsets[1:], where[:, 0].copy(), where[:, 1].copy()
