"""Reflectivities: a cell stops a beam at its hit depth with chance m in [0, 1], its reflectivity.

Binary walls are too rigid for glass, chair legs, people and cells that a wall fills in part. The class `Beta` is the
prior. Draws hold the cells that beams touch only: "reflectivity" is a drawn m, and "expected" is its mean given the
draw's stops. Other cells follow the prior wherever a whole map is needed.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells import ising_field
from bayesmap.cells.arrays import ArraySpec, Draws
from bayesmap.cells.binary import MAX_COUPLING
from bayesmap.cells.kind import BATCH_BYTES, CellPrior, Cells, Words
from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Indices, Ints, Mask, Rng, Singles
from bayesmap.space.grid import Grid

MIN_REFLECTIVITY, MAX_REFLECTIVITY = 1e-30, 1.0 - 1e-7  # between these, single precision can hold log odds
BATCH_CELLS = 8192  # cells per batch of `interval`
HALF_ROUNDING = 2.0**-11  # relative error of half precision
MAX_STOPS = 32  # stopped beams that `recover_counts` tries; a cell with more is well known
POOL_CELLS = 1 << 16  # size of the pool of prior states for cells that no beam touched
MIN_DRAWS, MAX_DRAWS = 100, 200  # bounds of the default number of draws per chain
MIN_DRAWS_UNTHINNED = 50  # least default number if every sweep is kept: a further draw then adds less
BEAMS_AT_MIN_DRAWS = 100_000  # fewest beams for which the default is the least number
MAX_DRAW_BYTES = 1 << 30  # most bytes of all chains' draws, if beams were to touch every cell of the grid
BYTES_A_CELL = 4  # bytes of a cell in a draw: two arrays in half precision
POOL_SEED = 1  # seed of the pool of states drawn from the prior
REFLECTIVITY = ArraySpec("reflectivity", ("cell",), "float32", "half", "chance that the cell stops a beam")
EXPECTED = ArraySpec(
    "expected", ("cell",), "float32", "half", "mean of the reflectivity given the draw's surfaces and stops"
)


class PriorParameters(NamedTuple):
    """Parameters of the priors of reflectivities, surfaces and labels."""

    a: float  # parameter of the Beta prior of reflectivities; with labels, of free cells
    b: float
    tau_m: float  # standard deviation of a surface's mean
    psi_m2: float  # scale of the inverse Wishart prior of its covariance
    nu: float  # degrees of freedom of the inverse Wishart prior
    kappa_m: float  # size beyond which a surface is unlikely
    half_m: float  # half of a cell's edge
    coupling: float  # coupling of the labels of neighbours
    a_solid: float  # parameter of the Beta prior of solid cells
    b_solid: float
    log_beta: float = 0.0  # log normaliser of free cells' Beta, which kernels fill in if cells have labels
    log_beta_solid: float = 0.0  # log normaliser of solid cells' Beta


@dataclass(frozen=True)
class Beta(CellPrior):
    """A reflectivity in each cell; a stopped beam stops at the cell's hit depth.

    At a coupling of 0, reflectivities are independent: Beta(a, b) in each cell. At a coupling above 0 each cell has a
    label: the reflectivity is Beta(a, b) in free cells, and Beta(a_solid, b_solid) in solid cells.

    Attributes:
        a, b: pseudo-counts of stopped and of passing beams; for free cells only, if cells have labels.
        coupling: log density added by each pair of neighbours (cells that share an edge) with the same label.
        a_solid, b_solid: pseudo-counts for solid cells, if cells have labels.

    Raises `BadInput` for a pseudo-count that is not positive, or a coupling that is not a number from 0 to 50.
    """

    a: float = 0.02
    b: float = 0.2
    coupling: float = field(default=0.0, kw_only=True)
    a_solid: float = field(default=1.0, kw_only=True)
    b_solid: float = field(default=1.0, kw_only=True)

    words: ClassVar[Words] = Words("reflectivity", "reflectivities", "mean reflectivity", "reflectivity")
    arrays: ClassVar[tuple[ArraySpec, ...]] = (REFLECTIVITY, EXPECTED)
    methods: ClassVar[Mapping[str, str]] = {"gibbs": "stop-gibbs"}
    sensor_is_fitted: ClassVar[bool] = True
    sweeps_a_draw: ClassVar[int] = 3
    drawn_array: ClassVar[str] = "reflectivity"  # the array of drawn values that maps and intervals show
    expected_array: ClassVar[str] = "expected"  # the array of means given the draw's stops
    thresholds: ClassVar[tuple[float, float] | None] = (0.3, 0.1)  # a cell that stops 3 of 10 beams is no free floor

    def __post_init__(self) -> None:
        name = type(self).__name__
        for parameter in ("a", "b", "a_solid", "b_solid"):
            value = getattr(self, parameter)
            if not (math.isfinite(value) and value > 0):
                raise BadInput(f"{name}: {parameter} must be a positive number, got {value!r}")
        coupling: Any = self.coupling  # may be "fit", which only binary walls allow
        if isinstance(coupling, str) or not (0 <= coupling <= MAX_COUPLING):
            raise BadInput(f"{name}: coupling must be a number in [0, {MAX_COUPLING:g}], got {self.coupling!r}")
        if self.has_labels:  # set on the instance: priors of this class without labels store none
            object.__setattr__(self, "arrays", (*type(self).arrays, ising_field.SOLID))

    @property
    def has_labels(self) -> bool:
        """True if cells are labelled free or solid."""
        return self.coupling > 0

    @property
    def mean(self) -> float:
        """The prior mean of the reflectivity; both labels are equally likely."""
        free = self.a / (self.a + self.b)
        return 0.5 * (free + self.a_solid / (self.a_solid + self.b_solid)) if self.has_labels else free

    def mean_given(self, solid: Mask | Floats) -> Floats:
        """Return the prior mean of the reflectivity given labels, or given the probability that each is solid."""
        free = self.a / (self.a + self.b)
        return np.asarray(free + (self.a_solid / (self.a_solid + self.b_solid) - free) * solid)

    def beta_given(self, solid: Mask) -> tuple[Floats, Floats]:
        """Return the pseudo-counts of stopped and of passing beams in cells with these labels."""
        return np.where(solid, self.a_solid, self.a), np.where(solid, self.b_solid, self.b)

    @property
    def first_spread(self) -> float:
        """The prior width of surfaces in the first estimate from hits, in edges of a cell; it sizes the first steps."""
        return 0.3

    def log_prob(self, cells: Cells, grid: Grid) -> float:
        """Compute the log density of labels and of the log odds of all reflectivities, up to a constant."""
        m = np.clip(np.asarray(cells["reflectivity"], dtype=np.float64), MIN_REFLECTIVITY, MAX_REFLECTIVITY)
        if not self.has_labels:
            return float((self.a * np.log(m) + self.b * np.log1p(-m)).sum())
        solid = np.asarray(cells["solid"]) != 0
        a, b = self.beta_given(solid)
        log_density = float((a * np.log(m) + b * np.log1p(-m) - special.betaln(a, b)).sum())
        return log_density + self.coupling * ising_field.count_alike_pairs(solid)

    def sample_cells(self, rng: Rng, grid: Grid) -> dict[str, NDArray[Any]]:
        """Draw a map. Raises `BadInput` if coupling and grid are so large that exact draws of labels take too long."""
        if not self.has_labels:
            m = rng.beta(self.a, self.b, grid.shape).astype(np.float32)
            return {"reflectivity": m, "expected": m}
        solid = ising_field.perfect_draws(rng, np.zeros(grid.shape), self.coupling, 1)[0]
        m = rng.beta(*self.beta_given(solid)).astype(np.float32)
        return {"reflectivity": m, "expected": m, "solid": solid}

    def propose(self, cells: Cells, site: tuple[int, int], rng: Rng, grid: Grid) -> tuple[dict[str, Any], float]:
        """Propose a state from the prior without neighbours. Returns it, and the log prior ratio due to neighbours."""
        proposal, log_ratio = super().propose(cells, site, rng, grid)
        if self.has_labels:
            solid = np.asarray(cells["solid"]) != 0
            change = int(proposal["solid"]) - int(solid[site])
            log_ratio += self.coupling * change * ising_field.balance_at(solid, site)
        return proposal, log_ratio

    def completed(self, cells: Cells, grid: Grid) -> Cells:
        """Return the map with the prior's mean reflectivity in untouched cells, given the label if there is one."""
        m = np.asarray(cells["reflectivity"], dtype=np.float64)
        mean = self.mean_given(np.asarray(cells["solid"]) != 0) if self.has_labels else np.asarray(self.mean)
        return {**cells, "reflectivity": np.where(np.isnan(m), mean, m)}

    def sample_surfaces(self, rng: Rng, count: int) -> Floats:
        """Return zeros as placeholders, (count, 5): these cells have no surfaces."""
        return np.zeros((count, 5))

    def stops(self, cells: Cells, grid: Grid) -> NDArray[np.floating]:
        """Return the reflectivities, (N,)."""
        return np.ravel(cells["reflectivity"]).astype(np.float32)

    def mean_stop(self, grid: Grid) -> Floats:
        """Return the prior's mean everywhere, (nx, ny)."""
        return np.full(grid.shape, self.mean)

    def default_draws(self, beams: int, cells: int, chains: int, thin: int = 1) -> int:
        """Return the default number of draws per chain: 100 (50 if ``thin`` is 1) to 200 (docs/defaults.md).
        They take the time of the least number at 100 000 beams. Large grids get fewer, to fit the draws into 1 GiB.
        """
        min_draws = MIN_DRAWS_UNTHINNED if thin == 1 else MIN_DRAWS
        draws_by_time = BEAMS_AT_MIN_DRAWS * min_draws // max(beams, 1)
        draws_by_memory = MAX_DRAW_BYTES // (BYTES_A_CELL * cells * chains)
        return max(min_draws, min(draws_by_time, draws_by_memory, MAX_DRAWS))

    def kernel_parameters(self, edge_m: float) -> PriorParameters:
        """Return the prior's parameters for kernels, which ignore the parameters of surfaces here."""
        return PriorParameters(
            a=self.a, b=self.b, tau_m=edge_m, psi_m2=edge_m**2, nu=3.0, kappa_m=edge_m, half_m=0.5 * edge_m,
            coupling=self.coupling, a_solid=self.a_solid, b_solid=self.b_solid,
        )  # fmt: skip

    def map_of(self, draws: Draws, chain: int, draw: int) -> Floats:
        """Return each cell's chance to stop a beam in one draw, (nx, ny). Untouched cells have the prior's mean."""
        elsewhere: Floats | float = self.mean
        if self.has_labels:
            elsewhere = self.mean_given(ising_field.labels_of_draw(draws, chain, draw))
        return draws.to_grid(draws.arrays[self.drawn_array][chain, draw], "cell", elsewhere)

    def mean_map(self, draws: Draws) -> Floats:
        """Return the mean of the draws' expected chances to stop a beam, (nx, ny), or NaN without draws."""
        # It has the same limit as the mean of drawn chances, and less noise.
        if draws.size == 0:
            return np.full(draws.grid.shape, np.nan)
        elsewhere = self.mean_given(ising_field.solid_share(draws)) if self.has_labels else self.mean
        return draws.to_grid(draws.arrays[self.expected_array].mean(axis=(0, 1), dtype=np.float64), "cell", elsewhere)

    def interval(self, draws: Draws, level: float) -> tuple[Floats, Floats]:
        """Return the central credible interval of the chances: lower and upper end, (nx, ny) each."""
        tails = (0.5 * (1 - level), 0.5 * (1 + level))
        # Touched cells: quantiles of the draws, some cells at a time.
        drawn = draws.arrays[self.drawn_array]
        ends = np.empty((2, drawn.shape[-1]))
        for i in range(0, drawn.shape[-1], BATCH_CELLS):
            batch = drawn[:, :, i : i + BATCH_CELLS]
            ends[:, i : i + BATCH_CELLS] = quantiles_of_halves(batch.reshape(-1, batch.shape[-1]), tails)
        if self.has_labels:
            betas = (self.a, self.b), (self.a_solid, self.b_solid)
            elsewhere = ising_field.mixture_quantiles(ising_field.solid_share(draws), *betas, tails)
        else:
            elsewhere = special.betaincinv(self.a, self.b, tails)
        lower, upper = (draws.to_grid(ends[i], "cell", elsewhere[i]) for i in (0, 1))
        return lower, upper

    def evidence_interval(self, draws: Draws, level: float) -> tuple[Floats, Floats]:
        """Return the central interval under a uniform prior, by the beams counted in each chain's last draw."""
        # Mean counts of stopped and of passing beams over the chains.
        cells = draws.index["cell"]
        counts, solid = np.zeros((2, len(cells))), np.zeros(len(cells), np.bool_)
        for chain in range(draws.chains):
            if self.has_labels:
                solid = ising_field.labels_of_draw(draws, chain, -1)[cells]
            expected = draws.arrays[self.expected_array][chain, -1].astype(np.float64)
            counts += np.stack(recover_counts(expected, *self.beta_given(solid))) / draws.chains
        # Quantiles of Beta(1 + stopped, 1 + passed), once per distinct pair of counts.
        tails = (0.5 * (1 - level), 0.5 * (1 + level))
        (stopped, passed), group = np.unique(counts, axis=1, return_inverse=True)
        ends = [special.betaincinv(1.0 + stopped, 1.0 + passed, tail)[group.ravel()] for tail in tails]
        lower, upper = (draws.to_grid(end, "cell", tail) for end, tail in zip(ends, tails, strict=True))
        return lower, upper

    def traces(self, draws: Draws, cells: Indices) -> NDArray[np.float16]:
        """Return the drawn chances of the given touched cells in all draws, (chains, draws, n)."""
        return np.asarray(draws.arrays[self.drawn_array][:, :, np.searchsorted(draws.index["cell"], cells)])

    def expected_traces(self, draws: Draws, cells: Indices) -> NDArray[np.float16]:
        """Return the expected chances of the given touched cells in all draws, (chains, draws, n)."""
        return np.asarray(draws.arrays[self.expected_array][:, :, np.searchsorted(draws.index["cell"], cells)])

    def predictive_stops(self, draws: Draws, cells: Ints | None = None) -> Iterator[Singles]:
        """Yield the stops of each draw with expected reflectivities; untouched cells have the prior's mean."""
        # The density of a reading is linear in each cell's reflectivity. So expected reflectivities have the mean
        # density over draws that drawn reflectivities have, with less noise.
        return self._stops_of_draws(draws, cells, drawn=False)

    def drawn_stops(self, draws: Draws, cells: Ints | None = None) -> Iterator[Singles]:
        """Yield the stops with drawn reflectivities; untouched cells draw their reflectivities from the prior."""
        return self._stops_of_draws(draws, cells, drawn=True)

    def _stops_of_draws(self, draws: Draws, cells: Ints | None, *, drawn: bool) -> Iterator[Singles]:
        """Yield the stops of each draw, (n,) or (n, 6), in batches, with drawn or with expected reflectivities."""
        cells = np.arange(draws.grid.n_cells, dtype=np.int32) if cells is None else cells
        # Draws hold the touched cells; the others follow the prior.
        position, stored = positions_in(draws.index["cell"], cells)
        position, stored_indices = position[stored], np.flatnonzero(stored)
        prior_reflectivities = self._prior_sampler(cells) if drawn else self._prior_mean
        reflectivities = draws.arrays["reflectivity" if drawn else "expected"]
        write_surfaces = self.surface_writer(draws, cells)
        # Batches of draws whose memory is limited.
        numbers = list(draws.numbers())
        shape = (len(cells), 6) if self.has_surfaces else (len(cells),)
        batch_size = max(1, BATCH_BYTES // ((32 if self.has_surfaces else 4) * max(len(cells), 1)))
        for i in range(0, len(numbers), batch_size):
            batch_numbers = numbers[i : i + batch_size]
            batch = np.empty((len(batch_numbers), *shape), dtype=np.float32)
            for stops, (chain, draw) in zip(batch, batch_numbers, strict=True):
                write_surfaces(stops, chain, draw)
                m = stops[:, 0] if self.has_surfaces else stops
                solid = ising_field.labels_of_draw(draws, chain, draw)[cells] if self.has_labels else None
                m[:] = prior_reflectivities(solid)
                m[stored_indices] = reflectivities[chain, draw][position]
            yield batch

    def _prior_mean(self, solid: Mask | None) -> NDArray[np.floating] | float:
        """Return the prior mean of reflectivities, given labels, (n,), if cells have some."""
        return self.mean if solid is None else self.mean_given(solid)

    def _prior_sampler(self, cells: Ints) -> Callable[[Mask | None], NDArray[np.floating] | float]:
        """Return a function that draws the reflectivities of cells from the prior, (n,), given labels as above."""
        # Pools of draws are made once; each call reads them from another random offset.
        rng = np.random.default_rng(POOL_SEED)
        pools = [rng.beta(self.a, self.b, POOL_CELLS).astype(np.float32)]
        if self.has_labels:
            pools.append(rng.beta(self.a_solid, self.b_solid, POOL_CELLS).astype(np.float32))

        def draw(solid: Mask | None) -> NDArray[np.floating]:
            pool_index = (cells + int(rng.integers(POOL_CELLS))) % POOL_CELLS
            m = pools[0][pool_index]
            if solid is not None:
                m[solid] = pools[1][pool_index[solid]]
            return m

        return draw

    def surface_writer(self, draws: Draws, cells: Ints) -> Callable[[Singles, int, int], None]:
        """Return a function (stops, chain, draw) that writes a draw's surfaces into stops, (n, 6): here none."""
        return lambda stops, chain, draw: None

    def describe(self) -> dict[str, Any]:
        """Return the prior as plain JSON values."""
        described: dict[str, Any] = {"kind": "beta", "a": self.a, "b": self.b}
        if self.has_labels:
            described |= {"coupling": float(self.coupling), "a_solid": self.a_solid, "b_solid": self.b_solid}
        return described


def positions_in(stored: Ints, cells: Ints) -> tuple[Indices, Mask]:
    """Return the position of each cell in the ascending ``stored``, and the mask of the cells that are in it, (n,)."""
    position = np.minimum(np.searchsorted(stored, cells), max(len(stored) - 1, 0))
    is_stored = stored[position] == cells if len(stored) else np.zeros(len(cells), dtype=np.bool_)
    return position, is_stored


def recover_counts(expected: Floats, a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Find the least whole counts (stopped, passing) that give each expected chance in half precision; all are (T,).
    The chance is (a + stopped) / (a + b + stopped + passing). Cells that stopped over `MAX_STOPS` beams get at least
    this count.
    """
    chance = np.clip(expected, HALF_ROUNDING**2, 1.0 - 0.5 * HALF_ROUNDING)  # halves round to 0 and to 1
    stopped, beams = np.zeros_like(chance), np.zeros_like(chance)
    pending = np.arange(len(chance))
    for count in range(MAX_STOPS + 1):
        n = (a[pending] + count) / chance[pending] - (a[pending] + b[pending])
        whole = np.rint(n)
        fits = (np.abs(n - whole) <= HALF_ROUNDING * (n + a[pending] + b[pending])) & (whole >= count)
        fits |= count == MAX_STOPS
        stopped[pending[fits]], beams[pending[fits]] = count, np.maximum(whole[fits], count)
        pending = pending[~fits]
    return stopped, beams - stopped


def quantiles_of_halves(draws: NDArray[np.float16], tails: tuple[float, ...]) -> Floats:
    """Compute `numpy.quantile` of nonnegative halves (draws, cells), ten times as fast: (len(tails), cells)."""
    # The bits of nonnegative halves, read as integers, are in the order of the numbers, and sort faster.
    ordered = np.sort(np.ascontiguousarray(draws.T).view(np.uint16), axis=1).view(np.float16)
    rank = np.array(tails) * (len(draws) - 1)
    below = np.floor(rank).astype(np.intp)
    low, high = (ordered[:, k].T.astype(np.float64) for k in (below, np.minimum(below + 1, len(draws) - 1)))
    return np.asarray(low + (high - low) * (rank - below)[:, None])
