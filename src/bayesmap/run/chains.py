"""The plan, the end and the results of Markov chains.

Each chain makes warm-up sweeps, and then keeps every ``thin``-th sweep as a draw (`SweepPlan`). All chains may end
early at fixed numbers of sweeps, the *marks*, once the mean map is precise enough (`StoppingRule`, `map_error`). Their
results (`Chains`) can be joined and resumed; `DrawRecord` stores the draws while the chains run.
"""

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.samplers.sampler import Info, Keep, Snapshot
from bayesmap.space.arrays import Floats

PRECISION = 0.03  # default error of the mean map at which chains stop: an error of 0.1 is visible on a grey map
FIRST_MARK_DRAWS = 10  # draws per chain at the first estimate of the map's error
MIN_DRAWS_PER_CHAIN = 2  # fewest draws per chain if the time ends a run
MAX_WARMUP_SHARE = 0.4  # largest share of a limited time that warm-up may take
MIN_BATCHES = 8  # fewest batches of an estimate: with one batch per chain, and few chains, estimates scatter widely
ERROR_QUANTILE = 0.99  # share of the observed cells whose error is at most the reported error
CELLS_AT_ONCE = 8192  # cells whose errors are computed together, which limits the memory
DENSITY_FIELDS = ("log_likelihood", "log_prior", "warmup_log_joint")  # fields of `Chains` with one number a sweep


@dataclass(frozen=True)
class SweepPlan:
    """The plan of a chain's sweeps."""

    warmup: int  # number of sweeps before the first draw
    draws: int  # largest number of draws per chain
    thin: int = 1  # sweeps from one draw to the next
    precision: float | None = None  # chains stop at this `map_error`, if given
    seconds: float | None = None  # chains stop after this time, once each has `MIN_DRAWS_PER_CHAIN`, if given

    @property
    def sweeps(self) -> int:
        """Largest number of sweeps of one chain."""
        return self.warmup + self.draws * self.thin

    @property
    def keep(self) -> Keep:
        """Rule that selects the sweeps to keep as draws."""
        return Keep(self.warmup, self.thin if self.draws else 0)

    @property
    def marks(self) -> tuple[int, ...]:
        """Numbers of sweeps at which chains may end, ascending; independent of threads and interruptions."""
        marks, draws = [], FIRST_MARK_DRAWS
        while self.precision is not None and draws < self.draws:
            marks.append(self.warmup + draws * self.thin)
            draws += max(5, draws // 4)  # an estimate reads all draws: growing gaps keep its share of the time small
        return tuple(marks)

    def shortened(self, sweep_s: float, remaining_s: float) -> "SweepPlan":
        """Return this plan with a warm-up of at most `MAX_WARMUP_SHARE` of the time left, at ``sweep_s`` a sweep."""
        return replace(self, warmup=min(self.warmup, max(1, int(MAX_WARMUP_SHARE * remaining_s / sweep_s))))


class StoppingRule:
    """The rule that ends chains before all their draws: the mean map is precise enough, or the time is over."""

    def __init__(self, plan: SweepPlan, estimate_error: Callable[[], float]) -> None:
        """Start the clock. ``estimate_error`` returns the `map_error` of all draws so far."""
        self._plan, self._estimate_error = plan, estimate_error
        self._began_s = time.monotonic()
        self.is_met = False  # whether the chains may end
        self._expected = next(iter(plan.marks), plan.sweeps)  # number of sweeps at the expected end
        self.error: float | None = None  # the latest `map_error`; None before the first mark

    def check(self, sweep: int) -> None:
        """Update the decision when all chains have made ``sweep`` sweeps."""
        plan = self._plan
        if plan.precision is not None and sweep in plan.marks:
            error = self.error = self._estimate_error()
            # The error falls with the square root of the number of draws.
            draws_ratio = max(1.0, (error / plan.precision) ** 2) if np.isfinite(error) else np.inf
            self._expected = int(min(plan.warmup + draws_ratio * (sweep - plan.warmup), plan.sweeps))
            self.is_met = error <= plan.precision
        if plan.seconds is not None and sweep >= plan.warmup + MIN_DRAWS_PER_CHAIN * plan.thin:
            self.is_met = self.is_met or time.monotonic() - self._began_s >= plan.seconds

    @property
    def end_is_open(self) -> bool:
        """True if the end depends on an error that is not estimated yet. Until then the first mark is expected."""
        return self._plan.precision is not None and self._plan.seconds is None and self.error is None

    def expected_sweeps(self, sweep: int) -> int:
        """Return the expected number of sweeps at the end, at least ``sweep``, by the latest error and the time."""
        expected = self._expected
        if self._plan.seconds is not None and sweep > 0:
            spent_s = max(time.monotonic() - self._began_s, 1e-3)  # no division by zero
            expected = min(expected, int(sweep * max(1.0, self._plan.seconds / spent_s)))
        return max(expected, sweep)


@dataclass(frozen=True, eq=False)
class Chains:
    """The draws and the states of chains so far. Log densities are in nats."""

    draws: Draws  # kept draws of all unknowns
    log_likelihood: Floats  # log likelihood of each kept draw, (chains, kept)
    log_prior: Floats  # log prior of each kept draw, (chains, kept)
    warmup_log_joint: Floats  # log joint of each warm-up sweep so far, (chains, warm-up sweeps)
    snapshot: Snapshot  # states from which the chains continue
    observed_counts: NDArray[np.int32]  # draws in which some beam observes each cell, and draws inspected, (2, nx, ny)
    statistics: Mapping[str, Floats]  # results of the start, by name
    n_incidences: int  # number of cells that beams cross, summed over beams
    seconds: Mapping[str, float]  # time in tracing ("trace"), at the start ("warm_start") and in sweeps ("sampling")
    finished: bool  # whether the chains have made all sweeps, or met the stopping rule

    @property
    def log_joint(self) -> Floats:
        """Log joint of every kept draw, (chains, kept)."""
        return self.log_likelihood + self.log_prior

    @property
    def sweep(self) -> int:
        """Number of sweeps of each chain, warm-up included."""
        return self.snapshot.sweep

    def observed(self) -> NDArray[np.bool_]:
        """Return a mask of the cells that at least one beam observes in at least half of the draws, (nx, ny)."""
        return observed_cells(self.observed_counts)

    def select(self, selection: slice) -> "Chains":
        """Return the results of some of the chains. The observed counts remain those of all chains."""
        draws = replace(self.draws, arrays={name: array[selection] for name, array in self.draws.arrays.items()})
        snapshot = Snapshot(self.sweep, {name: array[selection] for name, array in self.snapshot.arrays.items()})
        densities: dict[str, Any] = {name: getattr(self, name)[selection] for name in DENSITY_FIELDS}
        return replace(self, draws=draws, snapshot=snapshot, **densities)


def observed_cells(observed_counts: NDArray[np.int32]) -> NDArray[np.bool_]:
    """Return a mask of the cells observed in at least half of the inspected draws, (nx, ny), by counts of `Chains`."""
    n_observed, n_inspected = observed_counts
    return np.asarray(2 * n_observed >= np.maximum(n_inspected, 1))


def map_error(cells: CellPrior, draws: Draws, observed: NDArray[np.bool_]) -> float:
    """Estimate the Monte Carlo standard error of the mean map: the 99 % quantile over observed cells.

    The method is replicated batch means (Argon and Andradottir 2006). Each chain is cut into batches of successive
    draws, eight or more over all chains. The error of a mean over n batches is the standard deviation of the batch
    means over sqrt(n). Chains that disagree make the error large, so it also judges convergence. The error is inf for
    fewer than two draws per batch, and 0 without observed cells (``observed`` is a mask, (nx, ny)).
    """
    # Batches of a chain have equal length; draws that do not fill one are left out at the start of the chain.
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
    return float(np.quantile(errors, ERROR_QUANTILE)) if len(indices) else 0.0


def join_chains(groups: Sequence[Chains]) -> Chains:
    """Join groups of chains that ran apart for equal numbers of sweeps, in order, as if they had run together."""
    if len(groups) == 1:
        return groups[0]
    assert len({group.sweep for group in groups}) == 1, "chains of different length cannot be joined"
    snapshots = [group.snapshot.arrays for group in groups]
    arrays = {name: np.concatenate([snapshot[name] for snapshot in snapshots]) for name in snapshots[0]}
    return replace(
        _concatenate(groups, 0), snapshot=Snapshot(groups[0].sweep, arrays),
        observed_counts=np.sum([group.observed_counts for group in groups], axis=0),
        finished=all(group.finished for group in groups),
    )  # fmt: skip


def join_segments(segments: Sequence[Chains]) -> Chains:
    """Join consecutive sweeps of the same chains. Snapshot and observed counts come from the last segment."""
    return _concatenate(segments, 1)


def _concatenate(results: Sequence[Chains], axis: int) -> Chains:
    """Return the last result with draws and densities of all: of more chains (axis 0) or sweeps (axis 1)."""
    last = results[-1]
    arrays: dict[str, NDArray[Any]] = {}
    for name in last.draws.arrays:
        arrays[name] = np.concatenate([result.draws.arrays[name] for result in results], axis)
    fields: dict[str, Any] = {}
    for name in DENSITY_FIELDS:
        fields[name] = np.concatenate([getattr(result, name) for result in results], axis)
    fields["seconds"] = {name: sum(result.seconds.get(name, 0.0) for result in results) for name in last.seconds}
    return replace(last, draws=replace(last.draws, arrays=arrays), statistics=results[0].statistics, **fields)


class DrawRecord:
    """The draws and log densities of running chains, in arrays that are allocated for all draws of a plan."""

    def __init__(self, empty: Draws, plan: SweepPlan, resume: Chains | None = None) -> None:
        """Allocate arrays for the plan's draws, with the specs of ``empty``, and copy the draws of ``resume``."""
        chains = next(iter(empty.arrays.values())).shape[0]
        self._empty, self._keep = empty, plan.keep
        self._warmup = np.zeros((chains, plan.warmup))
        self._arrays = {spec.name: spec.empty(chains, plan.draws, empty.shape_of(spec)) for spec in empty.specs}
        self._arrays |= {"log_likelihood": np.zeros((chains, plan.draws)), "log_prior": np.zeros((chains, plan.draws))}
        self.kept = self.warmed = 0  # numbers of draws and of warm-up sweeps so far
        if resume is not None:
            self.kept, self.warmed = resume.log_joint.shape[1], resume.warmup_log_joint.shape[1]
            self._warmup[:, : self.warmed] = resume.warmup_log_joint
            densities = {"log_likelihood": resume.log_likelihood, "log_prior": resume.log_prior}
            for name, values in {**resume.draws.arrays, **densities}.items():
                self._arrays[name][:, : self.kept] = values

    def add(self, info: Info, begin: int) -> None:
        """Record the sweeps of a step that began after ``begin`` sweeps."""
        # Warm-up sweeps: the log joint alone.
        n_sweeps = info.log_likelihood.shape[1]
        n_warmup = max(0, min(self._warmup.shape[1] - begin, n_sweeps))
        self._warmup[:, self.warmed : self.warmed + n_warmup] = (info.log_likelihood + info.log_prior)[:, :n_warmup]
        self.warmed += n_warmup
        # Kept sweeps: log likelihood, log prior and draws. Samplers may return the kept draws alone, or all of a step.
        kept_sweeps = self._keep.sweeps(begin, begin + n_sweeps)
        columns = slice(self.kept, self.kept + len(kept_sweeps))
        indices = [sweep - begin - 1 for sweep in kept_sweeps]  # indices of the kept sweeps within this step
        densities = {"log_likelihood": info.log_likelihood, "log_prior": info.log_prior}
        for name, values in {**info.draws, **densities}.items():
            self._arrays[name][:, columns] = values if values.shape[1] == len(kept_sweeps) else values[:, indices]
        self.kept = columns.stop

    def grown(self, plan: SweepPlan) -> "DrawRecord":
        """Return this record with room for the draws of a longer plan. Its ``thin`` is a multiple of this plan's."""
        record = DrawRecord(self.draws, plan)
        stride = plan.thin // max(1, self._keep.every)
        columns = slice(stride - 1, self.kept, stride)
        record.kept = len(range(self.kept)[columns])
        for name, array in record._arrays.items():
            array[:, : record.kept] = self._arrays[name][:, columns]
        return record

    @property
    def draws(self) -> Draws:
        """The draws so far."""
        kept_arrays = {spec.name: self._arrays[spec.name][:, : self.kept] for spec in self._empty.specs}
        return replace(self._empty, arrays=kept_arrays)

    def chains(self, **fields: Any) -> Chains:
        """Return the chains so far. ``fields`` are the fields of `Chains` other than draws and log densities."""
        names = ("log_likelihood", "log_prior")
        densities: dict[str, Any] = {name: self._arrays[name][:, : self.kept] for name in names}
        return Chains(draws=self.draws, warmup_log_joint=self._warmup[:, : self.warmed], **densities, **fields)
