"""The contract of all Markov chain samplers, as BlackJAX has it: `init` makes a state, `step` gives (state, info).

A sampler is a value: it holds options and no state. `prepare` makes what all chains of a process share, such as traced
beams. A chain has a number that does not depend on where it runs. Every draw depends on (seed, number of the chain,
sweep, site) alone: not on other chains, threads, the division of sweeps into steps, or stops and resumptions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import Floats
from bayesmap.model import Model
from bayesmap.samplers.progress import SILENT, Watch
from bayesmap.space.grid import Grid

STREAM_SWEEPS = 1
STREAM_START = 2
STREAM_PARTICLES = 3
STREAM_LABELS = 7
STREAM_SECOND_SWEEPS, STREAM_SECOND_START = 8, 9
"""Streams of random numbers: with the seed and the chain, each makes a key of its own."""

PILOT = 1 << 32
"""Number of the chain to which a sensor is fitted: none that is kept has it."""


@dataclass(frozen=True)
class Keep:
    """The draws to keep: those of the sweeps ``after + every``, ``after + 2 every``, ..., counted from 1.

    Attributes:
        after: sweeps of which none is kept.
        every: sweeps from one kept draw to the next; 0 keeps none.
    """

    after: int = 0
    every: int = 0

    def sweeps(self, begin: int, end: int) -> range:
        """Return the sweeps that are kept among those after ``begin`` and up to ``end``."""
        if self.every == 0:
            return range(0)
        past = max(0, begin - self.after)
        first = self.after + (past // self.every + 1) * self.every
        return range(first, end + 1, self.every)


NOTHING = Keep()

MAPS_TO_SEE = 8
"""Draws of each chain that decide which cells count as observed, at most; they do not depend on the other chains."""


@dataclass(frozen=True, eq=False)
class Info:
    """The report of some sweeps.

    Attributes:
        log_likelihood, log_prior: of each sweep, (chains, sweeps): of the map that its draw shows. At an inverse
            temperature the likelihood is the tempered one.
        draws: the kept draws, (chains, kept, ...), by the names of the arrays of the kind of cells and as these are
            stored.
    """

    log_likelihood: Floats
    log_prior: Floats
    draws: Mapping[str, NDArray[Any]]

    @classmethod
    def joined(cls, infos: Sequence[Info], axis: int) -> Info:
        """Join reports of other chains (axis 0) or of consecutive sweeps (axis 1)."""
        return cls(
            np.concatenate([info.log_likelihood for info in infos], axis),
            np.concatenate([info.log_prior for info in infos], axis),
            {name: np.concatenate([info.draws[name] for info in infos], axis) for name in infos[0].draws},
        )


@dataclass(frozen=True, eq=False)
class Snapshot:
    """The states of chains: all that is needed to continue them.

    Attributes:
        sweep: sweeps that each has made.
        arrays: by name, (chains, ...).
    """

    sweep: int
    arrays: Mapping[str, NDArray[Any]] = field(default_factory=dict)


class Problem(Protocol):
    """The result of `Sampler.prepare`: a model where a sampler's kernels can read it."""

    @property
    def grid(self) -> Grid:
        """The map's cells."""

    @property
    def n_incidences(self) -> int:
        """The number of cells that all beams cross together: the work of a sweep."""

    @property
    def coordinates(self) -> Mapping[str, NDArray[np.int32]]:
        """For the dimensions of draws that count some cells only: these cells (see `bayesmap.cells.arrays.Draws`)."""

    def touched(self) -> NDArray[np.bool_]:
        """Return cells that some beam touches, (nx, ny): the others have the prior."""


class ChainState(Protocol):
    """Several chains between two sweeps. Arrays on the device are advanced in place: do not use a state twice."""

    @property
    def sweep(self) -> int:
        """The number of sweeps that each chain has made."""

    @property
    def problem(self) -> Problem:
        """The problem of the chains."""

    @property
    def statistics(self) -> Mapping[str, Floats]:
        """Results of the start beside the chains, by name, such as the changes of belief propagation."""


P = TypeVar("P", bound=Problem)
S = TypeVar("S", bound=ChainState)


class Sampler(Protocol[P, S]):
    """A Markov chain sampler."""

    def prepare(self, model: Model, device: str, threads: int | None = None, watch: Watch = SILENT) -> P:
        """Trace the model's beams, and prepare all else that chains share.

        Args:
            model: what is sampled.
            device: where kernels run.
            threads: of the CPU; all cores if None. Nothing depends on it but time.
            watch: gets how far it is.

        Raises:
            BadInput: a model that this sampler cannot sample.
        """

    def init(
        self, problem: P, chain_ids: Sequence[int], seed: int, resume: Snapshot | None = None, watch: Watch = SILENT
    ) -> S:
        """Start chains with these numbers, or continue from a snapshot of them."""

    def step(self, state: S, sweeps: int, beta: float = 1.0, keep: Keep = NOTHING) -> tuple[S, Info]:
        """Make some sweeps of all chains.

        Args:
            state: not to be used afterwards.
            sweeps: how many.
            beta: inverse temperature: p(reading | stop) to this power, so that 0 samples the prior and 1 the posterior.
                For binary walls that is the likelihood to this power.
            keep: which draws are kept.
        """

    def snapshot(self, state: S) -> Snapshot:
        """Copy what is needed to continue."""

    def observed_counts(self, state: S, draws: Mapping[str, NDArray[Any]]) -> NDArray[np.int32]:
        """Count the draws in which at least one beam observes each cell, and the draws inspected, of all chains.
        Returns (2, nx, ny). Without draws, the maps at which the chains stand count.

        Args:
            state: of the chains.
            draws: what `to_see` has chosen of theirs; {} for the maps at which they stand.
        """


def to_see(draws: Draws) -> dict[str, NDArray[Any]]:
    """Select the draws for `Sampler.observed_counts`: some maps, evenly spread, and none of arrays that cover some
    cells only.

    Which cells are observed hardly differs from draw to draw, and all draws may be gigabytes, or far away.
    """
    selected = np.unique(np.linspace(0, draws.count - 1, MAPS_TO_SEE).astype(np.intp)) if draws.count else slice(0)
    whole = {spec.name for spec in draws.specs if spec.dims == ("x", "y")}
    return {name: array[:, selected if name in whole else slice(0)] for name, array in draws.arrays.items()}
