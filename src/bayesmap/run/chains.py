"""Chains: the plan of their sweeps, the error of their map, and their results, which can be joined and resumed."""

from __future__ import annotations

import hashlib
import json
import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior, Floats
from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.samplers.sampler import Info, Keep, Snapshot
from bayesmap.sensors.model import RangeLimits

PRECISION = 0.03  # default error of the mean map at which chains stop: an error of 0.1 is visible on a grey map
FIRST_MARK = 10  # draws per chain at the first estimate of the map's error
MIN_DRAWS_PER_CHAIN = 2  # fewest draws per chain if the time ends a run
MAX_WARMUP_SHARE = 0.4  # largest share of a limited time that warm-up may take
MIN_BATCHES = 8  # fewest batches of an estimate: with one batch per chain, and few chains, estimates scatter widely
KNOWN_SHARE = 0.99  # share of the observed cells whose error is at most the reported error
CELLS_AT_ONCE = 8192  # per batch of `map_error`
DENSITIES = ("log_likelihood", "log_prior", "warmup_log_joint")


@dataclass(frozen=True)
class SweepPlan:
    """The plan of a chain's sweeps."""

    warmup: int  # number of sweeps before the first draw
    draws: int  # most draws per chain
    thin: int = 1  # sweeps from one draw to the next
    precision: float | None = None  # chains stop at this `map_error`; None: no limit
    seconds: float | None = None  # chains stop after this time, once each has `MIN_DRAWS_PER_CHAIN`; None: no limit

    @property
    def sweeps(self) -> int:
        """Number of sweeps of one chain."""
        return self.warmup + self.draws * self.thin

    @property
    def keep(self) -> Keep:
        """Rule that selects the sweeps to keep as draws."""
        return Keep(self.warmup, self.thin if self.draws else 0)

    @property
    def marks(self) -> tuple[int, ...]:
        """Sweeps at which chains may stop: fixed, whatever the number of threads or interruptions."""
        marks, draws = [], FIRST_MARK
        while self.precision is not None and draws < self.draws:
            marks.append(self.warmup + draws * self.thin)
            draws += max(5, draws // 4)
        return tuple(marks)

    def shortened(self, sweep_s: float, left_s: float) -> SweepPlan:
        """Return the plan with a warm-up of at most `MAX_WARMUP_SHARE` of the time left, given the time of a sweep."""
        return replace(self, warmup=min(self.warmup, max(1, int(MAX_WARMUP_SHARE * left_s / sweep_s))))


class EndRule:
    """Decides when chains may end before all their draws: when the map is known, or when the time is over."""

    def __init__(self, plan: SweepPlan, error_of_map: Callable[[], float]) -> None:
        """Start the clock. ``error_of_map`` estimates the error of the map from all draws so far."""
        self._plan, self._error_of_map, self._began = plan, error_of_map, time.monotonic()
        self.reached = False  # whether the chains may end
        self._expected = next(iter(plan.marks), plan.sweeps)  # number of sweeps at the expected end
        self.error: float | None = None  # the latest `map_error`; None before the first mark

    def check(self, sweep: int) -> None:
        """Update the decision after a number of sweeps."""
        plan = self._plan
        if plan.precision is not None and sweep in plan.marks:
            error = self.error = self._error_of_map()
            # The error falls with the square root of the number of draws.
            more = max(1.0, (error / plan.precision) ** 2) if np.isfinite(error) else np.inf
            self._expected = int(min(plan.warmup + more * (sweep - plan.warmup), plan.sweeps))
            self.reached = error <= plan.precision
        if plan.seconds is not None and sweep >= plan.warmup + MIN_DRAWS_PER_CHAIN * plan.thin:
            self.reached = self.reached or time.monotonic() - self._began >= plan.seconds

    @property
    def end_is_open(self) -> bool:
        """Whether the error decides when chains end, and is not known yet: until then the least number is expected."""
        return self._plan.precision is not None and self._plan.seconds is None and self.error is None

    def expected_sweeps(self, sweep: int) -> int:
        """Return the expected number of sweeps at the end, by the error at the last mark and by the time."""
        expected = self._expected
        if self._plan.seconds is not None and sweep > 0:
            spent = max(time.monotonic() - self._began, 1e-3)
            expected = min(expected, int(sweep * max(1.0, self._plan.seconds / spent)))
        return max(expected, sweep)


@dataclass(frozen=True, eq=False)
class Chains:
    """The draws and the states of chains so far."""

    draws: Draws
    log_likelihood: Floats  # of each kept draw, (chains, kept)
    log_prior: Floats  # (chains, kept)
    warmup_log_joint: Floats  # of each warm-up sweep so far, (chains, warm-up sweeps)
    snapshot: Snapshot
    observed_counts: NDArray[np.int32]  # draws in which some beam observes each cell, and draws inspected, (2, nx, ny)
    statistics: Mapping[str, Floats]  # results of the start, by name
    n_incidences: int  # number of cells that beams cross, summed over beams
    seconds: Mapping[str, float]  # time in tracing ("trace"), at the start ("warm_start") and in sweeps ("sampling")
    finished: bool

    @property
    def log_joint(self) -> Floats:
        """Log joint of every kept draw, (chains, kept)."""
        return self.log_likelihood + self.log_prior

    @property
    def sweep(self) -> int:
        """Number of sweeps of each chain, warm-up included."""
        return self.snapshot.sweep

    def observed(self) -> NDArray[np.bool_]:
        """Return the cells that at least one beam observes in at least half of the draws, (nx, ny)."""
        return observed_cells(self.observed_counts)


def observed_cells(counts: NDArray[np.int32]) -> NDArray[np.bool_]:
    """Return the cells that are observed in at least half of the inspected draws; both counts are (2, nx, ny)."""
    observed_in, inspected = counts
    return np.asarray(2 * observed_in >= np.maximum(inspected, 1))


def map_error(cells: CellPrior, draws: Draws, observed: NDArray[np.bool_]) -> float:
    """Estimate the Monte Carlo standard error of the mean map: the 99 % quantile over observed cells.

    The method is replicated batch means (Argon and Andradottir 2006). Each chain is cut into batches of successive
    draws, eight or more over all chains. The error of a mean over n batches is the standard deviation of the batch
    means over sqrt(n). Chains that disagree make it large, so it also judges convergence. It is inf for fewer than two
    draws per batch, and 0 without observed cells.
    """
    # The first draws are left out if batches of equal length do not cover all.
    batches = math.ceil(MIN_BATCHES / draws.chains)
    length = draws.count // batches
    if length < 2:
        return float("inf")
    indices = np.flatnonzero(observed.ravel())
    errors = np.zeros(len(indices))
    for i in range(0, len(indices), CELLS_AT_ONCE):
        values = cells.expected_traces(draws, indices[i : i + CELLS_AT_ONCE])[:, draws.count - batches * length :]
        means = values.reshape(draws.chains * batches, length, -1).mean(axis=1, dtype=np.float64)
        errors[i : i + CELLS_AT_ONCE] = means.std(axis=0, ddof=1) / np.sqrt(len(means))
    return float(np.quantile(errors, KNOWN_SHARE)) if len(indices) else 0.0


def _concatenated(parts: Sequence[Chains], axis: int) -> Chains:
    """Return the last part with the draws and densities of all parts along an axis, and the sum of their seconds."""
    last = parts[-1]
    arrays = {name: np.concatenate([part.draws.arrays[name] for part in parts], axis) for name in last.draws.arrays}
    fields: dict[str, Any] = {name: np.concatenate([getattr(part, name) for part in parts], axis) for name in DENSITIES}
    fields["seconds"] = {name: sum(part.seconds.get(name, 0.0) for part in parts) for name in last.seconds}
    return replace(last, draws=replace(last.draws, arrays=arrays), statistics=parts[0].statistics, **fields)


def join(parts: Sequence[Chains]) -> Chains:
    """Join chains of equal numbers of sweeps that ran separately, in order, as if they had run together."""
    if len(parts) == 1:
        return parts[0]
    assert len({part.sweep for part in parts}) == 1, "chains of different length cannot be joined"
    snapshots = [part.snapshot.arrays for part in parts]
    arrays = {name: np.concatenate([snapshot[name] for snapshot in snapshots]) for name in snapshots[0]}
    return replace(
        _concatenated(parts, 0), snapshot=Snapshot(parts[0].sweep, arrays),
        observed_counts=np.sum([part.observed_counts for part in parts], axis=0),
        finished=all(part.finished for part in parts),
    )  # fmt: skip


def select_chains(chains: Chains, which: slice) -> Chains:
    """Return a slice of the chains."""
    draws = replace(chains.draws, arrays={name: array[which] for name, array in chains.draws.arrays.items()})
    snapshot = Snapshot(chains.sweep, {name: array[which] for name, array in chains.snapshot.arrays.items()})
    densities: dict[str, Any] = {name: getattr(chains, name)[which] for name in DENSITIES}
    return replace(chains, draws=draws, snapshot=snapshot, **densities)


def in_sequence(parts: Sequence[Chains]) -> Chains:
    """Join consecutive sweeps of the same chains. Snapshot and observed counts come from the last part."""
    return _concatenated(parts, 1)


class Record:
    """The draws and traces of chains, which grow as the chains advance."""

    def __init__(self, empty: Draws, plan: SweepPlan, resume: Chains | None = None) -> None:
        """Allocate arrays for the plan's draws, and copy the draws of ``resume``; ``empty`` has the specs."""
        chains = next(iter(empty.arrays.values())).shape[0]
        arrays = {spec.name: spec.empty(chains, plan.draws, empty.shape_of(spec)) for spec in empty.specs}
        self._draws = replace(empty, arrays=arrays)
        self._keep = plan.keep
        self._log_likelihood, self._log_prior = np.zeros((2, chains, plan.draws))
        self._warmup = np.zeros((chains, plan.warmup))
        self.kept = self.warmed = 0
        if resume is not None:
            self.kept, self.warmed = resume.log_joint.shape[1], resume.warmup_log_joint.shape[1]
            for name, array in self._draws.arrays.items():
                array[:, : self.kept] = resume.draws.arrays[name]
            self._log_likelihood[:, : self.kept] = resume.log_likelihood
            self._log_prior[:, : self.kept] = resume.log_prior
            self._warmup[:, : self.warmed] = resume.warmup_log_joint

    def add(self, info: Info, begin: int) -> None:
        """Record the sweeps of a step that began after ``begin`` sweeps."""
        # Warm-up sweeps: the log joint alone.
        sweeps = info.log_likelihood.shape[1]
        warm = max(0, min(self._warmup.shape[1] - begin, sweeps))
        self._warmup[:, self.warmed : self.warmed + warm] = (info.log_likelihood + info.log_prior)[:, :warm]
        self.warmed += warm
        # Kept sweeps: the parts of the log joint, and the draws.
        kept = self._keep.sweeps(begin, begin + sweeps)
        new, steps = slice(self.kept, self.kept + len(kept)), [sweep - begin - 1 for sweep in kept]
        self._log_likelihood[:, new] = info.log_likelihood[:, steps]
        self._log_prior[:, new] = info.log_prior[:, steps]
        for name, values in info.draws.items():
            self._draws.arrays[name][:, new] = values if values.shape[1] == len(kept) else values[:, steps]
        self.kept = new.stop

    def grown(self, plan: SweepPlan) -> Record:
        """Return this record with room for the draws of a longer plan, which may thin by a multiple of this one's."""
        record = Record(self.draws, plan)
        every = plan.thin // max(1, self._keep.every)
        thinned = slice(every - 1, self.kept, every)
        record.kept = len(range(self.kept)[thinned])
        for name, array in record._draws.arrays.items():
            array[:, : record.kept] = self._draws.arrays[name][:, thinned]
        record._log_likelihood[:, : record.kept] = self._log_likelihood[:, thinned]
        record._log_prior[:, : record.kept] = self._log_prior[:, thinned]
        return record

    @property
    def draws(self) -> Draws:
        """The draws so far."""
        return replace(self._draws, arrays={name: a[:, : self.kept] for name, a in self._draws.arrays.items()})

    def chains(self, **results: Any) -> Chains:
        """Return the chains so far; ``results`` are the fields of `Chains` beside draws and densities."""
        kept = slice(self.kept)
        return Chains(
            draws=self.draws, log_likelihood=self._log_likelihood[:, kept], log_prior=self._log_prior[:, kept],
            warmup_log_joint=self._warmup[:, : self.warmed], **results,
        )  # fmt: skip


RANDOM_STREAMS = 8  # version of the assignment of random numbers: chains of another version cannot be continued
NOT_ASKED_FOR = ("fingerprint", "threads_used", "fitted")  # entries of a run's settings that are not arguments
PROBES = 64  # number of readings and of distances at which a sensor model is evaluated for the fingerprint


def fingerprint(settings: dict[str, Any], model: Model, *starts: NDArray[Any] | None) -> str:
    """Compute the fingerprint of a run from its settings, data, prior, sensor, and starts of cells and poses."""
    scans, grid = model.scans, model.grid
    digest = hashlib.blake2b(json.dumps(settings, sort_keys=True).encode())
    digest.update(repr((grid.shape, grid.resolution, grid.origin, scans.min_range_m, scans.max_range_m)).encode())
    arrays = [scans.poses, scans.angles_rad, scans.ranges_m, scans.beam_poses, scans.own_angles_rad]
    arrays += [*model.cells.parameters().values()]
    # A user's own sensor model is described by its name alone; its likelihood of some readings identifies it.
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    readings = scans.ranges_m.ravel()[:: max(1, scans.ranges_m.size // PROBES)][:PROBES, None]
    arrays.append(model.sensor.log_likelihood(readings, np.linspace(0.0, limits.max_m, PROBES), limits))
    for array in (*arrays, *starts):
        if array is not None:
            digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:16]


def check_same(saved: dict[str, Any], asked: dict[str, Any]) -> None:
    """Raise `BadInput` with the differences if a run was made with other arguments, scans or grid."""
    if saved["fingerprint"] == asked["fingerprint"]:
        return
    if saved.get("streams") != asked["streams"]:
        raise BadInput(
            "resume: the saved run was made by a version of bayesmap with other random numbers; it can be looked at "
            "and scored, but not gone on with: start again"
        )
    names = [name for name in asked if name not in (*NOT_ASKED_FOR, "streams") and saved.get(name) != asked[name]]
    settings = "; ".join(f"{name} ({saved.get(name)!r}, now {asked[name]!r})" for name in names)
    different = settings or "scans or on another grid, or with another sensor"
    raise BadInput(f"resume: the saved run was made with other {different}")
