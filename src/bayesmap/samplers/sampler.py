"""The interface of all Markov chain samplers, after BlackJAX: `init` makes a state, `step` returns (state, info).

A `Sampler` is a value: it holds options and no state. `prepare` makes a `Problem`, the data that all chains of a
process share, such as traced beams. `init` makes a `ChainState`, and `step` advances it and returns an `Info` with the
draws that `Keep` selects. A `Snapshot` continues chains elsewhere. A `Watch` receives the progress, and may stop a run.
Every draw depends on (seed, number of the chain, sweep, site) alone (docs/inference.md).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any, Literal, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.beams.table import BeamTable
from bayesmap.cells.arrays import Draws
from bayesmap.model import Model
from bayesmap.space.arrays import Floats, Ints, Mask
from bayesmap.space.grid import Grid

Stage = Literal[
    "trace", "compile", "start", "fit", "propagate", "warm-up", "draws", "particles", "save", "score",
    "front end", "loops", "aligned", "aligned-again", "aligned-rematched", "rematch", "placing",
]  # fmt: skip
PILOT = 1 << 32  # number of the pilot chain, which fits the sensor; no other chain has this number
MAPS_TO_INSPECT = 8  # most draws per chain that decide which cells count as observed


@dataclass(frozen=True)
class Event:
    """A report of the progress of a run: ``done`` of ``total`` units of a stage, and results so far."""

    stage: Stage
    done: int
    total: int  # an estimate, if the error decides how long chains run
    log_joint: float | None = None  # mean over the chains, nats
    error: float | None = None  # Monte Carlo error of the map, see `bayesmap.run.chains.map_error`
    warmup: int = 0  # units of the total that are warm-up
    end_is_open: bool = False  # true while the error is unknown: the total is then a lower bound


@dataclass(frozen=True)
class Watch:
    """The callbacks of a run: one receives the progress, one is called between pieces of work and may stop the run."""

    on_progress: Callable[[Event], None] | None = None
    should_stop: Callable[[], bool] = lambda: False  # returns true to stop the run

    def report(
        self, stage: Stage, done: int, total: int, log_joint: float | None = None, error: float | None = None,
        warmup: int = 0, end_is_open: bool = False,
    ) -> None:  # fmt: skip
        """Report the progress of a stage."""
        if self.on_progress is not None:
            self.on_progress(Event(stage, done, total, log_joint, error, warmup, end_is_open))

    def for_stage(self, stage: Stage) -> Callable[[int, int], None]:
        """Return a callback (done, total) that reports the progress of one stage."""
        return lambda done, total: self.report(stage, done, total)


SILENT = Watch()  # reports nothing, and never stops a run


class Stream(IntEnum):
    """The numbers of all streams of random numbers: streams with different numbers are independent for one seed."""

    SWEEPS = 1  # sweeps of cells
    START = 2  # start of cells
    PARTICLES = 3  # maps of importance sampling
    POSES = 4  # moves of poses
    VIEWS = 5  # scans simulated for the expected information
    START_POSES = 6  # start of poses
    LABELS = 7  # start of labels
    READINGS = 8  # readings that a run predicts
    NOISE = 11  # readings of the page's simulated sensors
    TYPICAL = 12  # poses of typical scans in a world that is drawn on the page


@dataclass(frozen=True)
class Keep:
    """The schedule of kept draws: those of the sweeps ``after + every``, ``after + 2 every``, ..., counted from 1."""

    after: int = 0  # number of first sweeps of which none is kept
    every: int = 0  # sweeps from one kept draw to the next; 0 keeps none

    def sweeps(self, begin: int, end: int) -> range:
        """Return the numbers of the kept sweeps from ``begin + 1`` to ``end``."""
        if self.every == 0:
            return range(0)
        n_kept = max(0, begin - self.after) // self.every
        return range(self.after + (n_kept + 1) * self.every, end + 1, self.every)


@dataclass(frozen=True, eq=False)
class Info:
    """The report of some sweeps. At an inverse temperature the likelihood is tempered."""

    log_likelihood: Floats  # log-likelihood of each sweep's draw, nats, (chains, sweeps)
    log_prior: Floats  # log prior of each sweep's draw, nats, (chains, sweeps)
    draws: Mapping[str, NDArray[Any]]  # kept draws by array name, in stored form, (chains, kept, ...)

    @classmethod
    def joined(cls, infos: "Sequence[Info]", axis: int) -> "Info":
        """Join reports of other chains (axis 0) or of consecutive sweeps (axis 1)."""
        return cls(
            np.concatenate([info.log_likelihood for info in infos], axis),
            np.concatenate([info.log_prior for info in infos], axis),
            {name: np.concatenate([info.draws[name] for info in infos], axis) for name in infos[0].draws},
        )


@dataclass(frozen=True, eq=False)
class Snapshot:
    """The states of chains: all that is needed to continue them."""

    sweep: int  # number of sweeps that each chain has made
    arrays: Mapping[str, NDArray[Any]] = field(default_factory=dict)  # arrays by name, (chains, ...)


class Problem:
    """A model in the form that a sampler's kernels use: the result of `Sampler.prepare`."""

    @property
    def traced(self) -> Rays | BeamTable:
        """The beams with the cells that they cross."""
        raise NotImplementedError

    @property
    def grid(self) -> Grid:
        """The map's cells."""
        return self.traced.grid

    @property
    def n_incidences(self) -> int:
        """The number of pairs of a beam and a cell that it crosses: the work of a sweep."""
        return self.traced.n_incidences

    @property
    def coordinates(self) -> Mapping[str, Ints]:
        """The coordinates of dimensions of draws that do not cover the grid, see `bayesmap.cells.arrays.Draws`."""
        return {}

    def touched_map(self) -> Mask:
        """Return the mask of the cells that at least one beam touches, (nx, ny). The others follow the prior."""
        return self.traced.touched_map()


class RaysProblem(Problem):
    """A problem whose beams are traced as rays."""

    rays: Rays

    @property
    def traced(self) -> Rays:
        """The rays."""
        return self.rays


def keep_cached(changed: "T", original: "T", *names: str) -> "T":
    """Copy the named cached properties of a problem to its changed copy, for which they are valid. Returns the copy."""
    vars(changed).update({name: value for name, value in vars(original).items() if name in names})
    return changed


@dataclass(frozen=True, eq=False)
class ChainState:
    """Several chains between two sweeps. Arrays on the device are advanced in place: do not use a state twice."""

    problem: Any
    sweep: int  # number of sweeps that each chain has made
    # further results of the start by name, such as the changes of belief propagation
    statistics: Mapping[str, Floats] = field(default_factory=dict, kw_only=True)


P = TypeVar("P", bound=Problem)
S = TypeVar("S", bound=ChainState)
T = TypeVar("T")


class Sampler(Protocol[P, S]):
    """A Markov chain sampler."""

    def prepare(self, model: Model, device: str, threads: int | None = None, watch: Watch = SILENT) -> P:
        """Trace beams and make what chains share, on all cores if ``threads`` is None. `BadInput`: unsuited model."""

    def init(
        self, problem: P, chain_ids: Sequence[int], seed: int, resume: Snapshot | None = None, watch: Watch = SILENT
    ) -> S:
        """Start the chains of these numbers, or continue them from a snapshot."""

    def step(self, state: S, sweeps: int, beta: float = 1.0, keep: Keep = Keep()) -> tuple[S, Info]:
        """Make some sweeps of all chains. Do not use the argument ``state`` afterwards.
        ``beta`` is the power of p(reading | stop) (walls: of the likelihood): 0 samples the prior, 1 the posterior.
        """

    def snapshot(self, state: S) -> Snapshot:
        """Copy the data that is needed to continue."""

    def observed_counts(self, state: S, draws: Mapping[str, NDArray[Any]]) -> Ints:
        """Count the draws of all chains in which at least one beam observes each cell, and the draws inspected.
        Returns (2, nx, ny). `draws_to_inspect` selects ``draws``; without draws, the present maps are inspected.
        """


def draws_to_inspect(draws: Draws) -> dict[str, NDArray[Any]]:
    """Select `MAPS_TO_INSPECT` whole maps of each chain for `Sampler.observed_counts`, evenly spread."""
    # Observed cells hardly differ from draw to draw, and all draws may be gigabytes, or on another machine.
    selected = np.unique(np.linspace(0, draws.count - 1, MAPS_TO_INSPECT).astype(np.intp)) if draws.count else slice(0)
    on_grid = {spec.name for spec in draws.specs if spec.dims == ("x", "y")}
    return {name: array[:, selected if name in on_grid else slice(0)] for name, array in draws.arrays.items()}
