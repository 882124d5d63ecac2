"""The base class of all kinds of cells, `CellPrior`: the prior that users pass, and its interface to the package.

A kind defines the state of a cell (its arrays), its prior probability, how it stops beams, and its names on maps and
axes. Samplers, files, scores, pictures, the command line and the page use this interface only. A class of your own that
extends `CellPrior` works everywhere, too. The methods stand in the order prior, stops, draws, files; abstract ones
must be defined, and the defaults of the others suit independent cells whose draws cover the grid.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import ArraySpec, Draws
from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Indices, Ints, Mask, Rng, Singles
from bayesmap.space.grid import Grid

Cells = Mapping[str, NDArray[Any]]  # one map: the arrays of a kind by name, each (nx, ny)
BATCH_BYTES = 12 << 20  # most bytes of one batch of stops


@dataclass(frozen=True)
class Words:
    """The words for a kind of cells and its maps."""

    kind: str  # name of the kind in settings, documents and saved runs; one word
    states: str  # the states of the cells, in the plural: "walls or free"
    mean: str  # label of the mean map, on colour bars
    value: str  # label of the map of one draw


class MeanSurfaces(NamedTuple):
    """Posterior mean surfaces of the U cells in which readings end."""

    mean_world: Floats  # means in the world frame, metres, (U, 2)
    covariance: Floats  # covariances of the points where beams stop, square metres, (U, 2, 2)
    reflectivity: Floats  # mean reflectivities of the cells, (U,)


KINDS: "dict[str, type[CellPrior]]" = {}  # kinds by name: subclasses of `CellPrior` with their own ``words``


class CellPrior(ABC):
    """A kind of cells with its prior."""

    words: ClassVar[Words]  # names of the kind and its maps
    arrays: ClassVar[tuple[ArraySpec, ...]]  # specifications of the arrays of a draw
    # sampler of each supported method of `bayesmap.infer`, the default first (see `bayesmap.samplers.methods`)
    methods: ClassVar[Mapping[str, str]] = {"metropolis": "metropolis"}
    hit_depth: ClassVar[float] = 0.5  # default stop of a beam in a cell, as a fraction of the beam's chord
    sensor_is_fitted: ClassVar[bool] = False  # whether the command line fits the sensor unless one is given
    has_interval: ClassVar[bool] = True  # whether a cell's state is a number with an interval
    has_surfaces: ClassVar[bool] = False  # whether a cell's state includes a surface
    sweeps_a_draw: ClassVar[int] = 1  # default number of sweeps from one draw to the next
    has_walls: ClassVar[bool] = False  # if so, a wall probability, a start, an order and a coupling can be chosen
    # mean stop probabilities for a robot's map: a cell above the first is occupied, below the second free if
    # `evidence_interval` agrees (docs/defaults.md), else unknown; None leaves them to the format
    thresholds: ClassVar[tuple[float, float] | None] = None

    @property
    def is_incomplete(self) -> bool:
        """True if a parameter of the prior must be fitted to the scans before a map can be drawn."""
        return False

    @classmethod
    def of(cls, prior: "CellPrior", caller: str, remedy: str = "") -> Self:
        """Return the prior. If it is of another kind, raises `BadInput` with the caller and the remedy."""
        if not isinstance(prior, cls):
            advice = f"; {remedy}" if remedy else ""
            raise BadInput(f"{caller}: the prior must be {cls.__name__}, got {type(prior).__name__}{advice}")
        return prior

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "words" in cls.__dict__:
            KINDS[cls.words.kind] = cls

    # The prior
    @abstractmethod
    def log_prob(self, cells: Cells, grid: Grid) -> float:
        """Compute the log prior density of a map, in nats, up to a constant that depends on neither map nor data."""

    @abstractmethod
    def sample_cells(self, rng: Rng, grid: Grid) -> dict[str, NDArray[Any]]:
        """Draw a map."""

    def propose(self, cells: Cells, site: tuple[int, int], rng: Rng, grid: Grid) -> tuple[dict[str, Any], float]:
        """Propose a new state of one cell: its value in every array, and the log of prior ratio x proposal ratio."""
        # A draw of the prior has the ratio 1, if the prior makes cells independent.
        proposal = self.sample_cells(rng, Grid((1, 1), grid.resolution))
        return {name: values[0, 0] for name, values in proposal.items()}, 0.0

    # The stops: how cells stop beams
    @abstractmethod
    def stops(self, cells: Cells, grid: Grid) -> NDArray[np.floating]:
        """Return the stops of all cells as `bayesmap.beams.rays.stops_of` takes them. Cell (x, y) is x * ny + y."""

    def mean_stop(self, grid: Grid) -> Floats:
        """Return the prior mean of the probability that a cell stops a beam, (nx, ny), by default from 200 draws."""
        rng = np.random.default_rng(0)
        maps = [self._stop_chances(self.sample_cells(rng, grid), grid) for _ in range(200)]
        return np.asarray(np.mean(maps, axis=0, dtype=np.float64))

    def _stop_chances(self, cells: Cells, grid: Grid) -> NDArray[np.floating]:
        """Return the probability that each cell stops a beam that meets its surface, (nx, ny)."""
        stops = self.stops(cells, grid)
        return (stops if stops.ndim == 1 else stops[:, 0]).reshape(grid.shape)

    def completed(self, cells: Cells, grid: Grid) -> Cells:
        """Return a map whose NaN cells, which draws do not store, have states of the prior. The default has no NaN."""
        return cells

    # Draws
    def map_of(self, draws: Draws, chain: int, draw: int) -> NDArray[Any]:
        """Return the values that a picture of one draw shows, (nx, ny)."""
        return self._stop_chances(draws.cells(chain, draw), draws.grid)

    def mean_map(self, draws: Draws) -> Floats:
        """Return the mean over draws of the probability that a cell stops a beam, (nx, ny), or NaN without draws."""
        total = np.zeros(draws.grid.shape)
        for chain, draw in draws.numbers():
            total += self.map_of(draws, chain, draw)
        return total / draws.size if draws.size else np.full(draws.grid.shape, np.nan)

    def interval(self, draws: Draws, level: float) -> tuple[Floats, Floats]:
        """Return the central credible interval of `map_of`, (nx, ny) each. Raises `BadInput` if the kind has none."""
        maps = np.stack([self.map_of(draws, chain, draw) for chain, draw in draws.numbers()]).astype(np.float64)
        lower, upper = np.quantile(maps, [0.5 * (1 - level), 0.5 * (1 + level)], axis=0)
        return lower, upper

    def evidence_interval(self, draws: Draws, level: float) -> tuple[Floats, Floats] | None:
        """Return the interval of each cell's stop chance under a uniform prior, (nx, ny) each. The default is None."""
        return None

    def width(self, draws: Draws, level: float) -> Floats:
        """Return the width of each cell's posterior or evidence interval, (nx, ny), whichever is wider."""
        # A prior that is nearly sure makes the posterior's interval narrow after a single beam.
        lower, upper = self.interval(draws, level)
        evidence = self.evidence_interval(draws, level)
        return upper - lower if evidence is None else np.maximum(upper - lower, evidence[1] - evidence[0])

    def traces(self, draws: Draws, cells: Indices) -> NDArray[Any]:
        """Return `map_of` at the given cells in all draws, (chains, draws, n), for diagnostics of convergence."""
        values = [self.map_of(draws, chain, draw).ravel()[cells] for chain, draw in draws.numbers()]
        return np.reshape(values, (draws.chains, draws.count, len(cells)))

    def expected_traces(self, draws: Draws, cells: Indices) -> NDArray[Any]:
        """Return the draws' expected values at cells, (chains, draws, n). Their mean is `mean_map`."""
        return self.traces(draws, cells)

    def constant_cells(self, draws: Draws) -> tuple[Mask | None, Mask | None]:
        """Return masks of the cells with one value in each chain, and in all, (N,) each, or None for real numbers."""
        return None, None

    def surfaces(self, draws: Draws) -> MeanSurfaces:
        """Compute the mean surfaces of the cells. Raises `BadInput` if the kind has no surfaces."""
        raise BadInput(
            f"surfaces: the cells of this run are {self.words.states}, without surfaces; infer with prior=Surface(), "
            "or --cells surface"
        )

    def predictive_stops(self, draws: Draws, cells: Ints | None = None) -> Iterator[Singles]:
        """Yield the `stops` of ``cells``, flat (None: all), in batches of draws: (draws, n) or (draws, n, 6)."""
        batch: list[Singles] = []
        for chain, draw in draws.numbers():
            stops = self.stops(draws.cells(chain, draw), draws.grid)
            batch.append(np.asarray(stops if cells is None else stops[cells], dtype=np.float32))
            if len(batch) * batch[0].nbytes >= BATCH_BYTES:
                yield np.stack(batch)
                batch = []
        if batch:
            yield np.stack(batch)

    def drawn_stops(self, draws: Draws, cells: Ints | None = None) -> Iterator[Singles]:
        """Yield the `stops` of drawn states, for decisions on single draws. The default is `predictive_stops`."""
        return self.predictive_stops(draws, cells)

    def default_draws(self, beams: int, cells: int, chains: int, thin: int = 1) -> int:
        """Return the default number of draws per chain, ``thin`` sweeps apart: 1000, unless a kind needs others."""
        return 1000

    # Files
    @abstractmethod
    def describe(self) -> dict[str, Any]:
        """Return the prior as plain JSON values. "kind" is its name."""

    def parameters(self) -> Mapping[str, NDArray[Any]]:
        """Return the array parameters, which saved runs store beside the description."""
        return {}

    @classmethod
    def from_description(cls, values: Mapping[str, Any]) -> "CellPrior":
        """Return the prior of a description. The default passes all entries but "kind" as arguments."""
        return cls(**{name: value for name, value in values.items() if name != "kind"})
