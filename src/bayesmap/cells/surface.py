"""Surfaces: each cell has a reflectivity, and a normal distribution of the points at which it stops beams.

Normal-distributions-transform maps (Biber and Strasser, 2003) store this distribution as well; here it is inferred.
The class `Surface` is the prior of all cells. Its draws are in edges of a cell. Its stops, the numbers by which kernels
let cells stop beams, are in metres: `bayesmap.kernels.surfaces.surface` computes how a surface stops a beam.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells.arrays import ArraySpec, Draws
from bayesmap.cells.kind import Cells, MeanSurfaces, Words
from bayesmap.cells.reflectivity import EXPECTED, POOL_CELLS, REFLECTIVITY, Beta, PriorParameters, positions_in
from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Ints, Rng, Singles
from bayesmap.space.grid import Grid

MAX_SPREAD_RATIO = 3.0  # largest spread in units of size_scale: beyond it, almost all prior draws are rejected
ROUNDING = 1e-3  # edges by which rounding to half precision may move a mean out of its cell
PARTS = ("mean_x", "mean_y", "l11", "l21", "l22")  # mean from the cell's centre, Cholesky factor, in edges


def _spec(part: str) -> ArraySpec:
    """Return the specification of the array of one part of all surfaces."""
    text = f"{part} of the surface, from the cell's centre" if part.startswith("mean") else f"{part} of its covariance"
    return ArraySpec(f"surface_{part}", ("surface_cell",), "float32", "half", f"{text}, in edges of a cell")


# Values that maps show. They count all stops in a square, whichever cell the surface belongs to.
STOP_CHANCES = tuple(
    ArraySpec(name, ("cell",), "float32", "half", meaning)
    for name, meaning in (
        ("stop_chance", "chance that a beam which comes to the cell's square is stopped in it"),
        ("expected_stop_chance", "mean of the stop chance given where the draw's beams stop"),
    )
)


@dataclass(frozen=True)
class Surface(Beta):
    """The prior of cells that each have a reflectivity, as in `Beta`, and a surface with mean mu and covariance Sigma.

    The prior is mu ~ N(centre, tau^2 I) inside the cell's own square, and Sigma ~ InverseWishart(nu, psi I) x
    exp(-tr Sigma / (2 kappa^2)). Lengths are in edges of a cell, so that one prior serves all resolutions.
    Raises `BadInput` if a number is not positive, the dof are too few, or surfaces much exceed their scale.

    Attributes:
        a, b, coupling, a_solid, b_solid: as in `Beta`.
        mean_scale: tau, standard deviation of a surface's mean about the cell's centre; the mean lies inside the cell.
        spread: sqrt(psi), typical size of surfaces.
        dof: nu, degrees of freedom of the size; more than 1.
        size_scale: kappa, the size beyond which surfaces are unlikely: about that of a cell.
    """

    mean_scale: float = 0.4
    spread: float = 0.28
    dof: float = 3.0
    size_scale: float = 0.35

    words: ClassVar[Words] = Words(
        "surface", "reflectivities and surfaces", "chance that a cell stops a beam", "chance that a cell stops a beam",
    )  # fmt: skip
    arrays: ClassVar[tuple[ArraySpec, ...]] = (REFLECTIVITY, EXPECTED, *STOP_CHANCES, *(_spec(part) for part in PARTS))
    drawn_array: ClassVar[str] = "stop_chance"
    expected_array: ClassVar[str] = "expected_stop_chance"
    has_surfaces: ClassVar[bool] = True

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("mean_scale", "spread", "size_scale"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise BadInput(f"Surface: {name} must be a positive number of cells, got {value!r}")
        if not (math.isfinite(self.dof) and self.dof > 1):
            raise BadInput(f"Surface: dof must exceed 1, got {self.dof!r}")
        if self.spread > MAX_SPREAD_RATIO * self.size_scale:  # almost no draw would be small enough
            raise BadInput(
                f"Surface: spread must not exceed {MAX_SPREAD_RATIO:g} times size_scale, got {self.spread!r} and "
                f"{self.size_scale!r}"
            )

    @property
    def first_spread(self) -> float:
        """The prior width of surfaces in the first estimate from hits, in edges of a cell; it sizes the first steps."""
        return self.spread

    def log_prob(self, cells: Cells, grid: Grid) -> float:
        """Compute the log density of (logit m, mean, log l11, l21, log l22) of all cells, metres, up to a constant."""
        edge = grid.resolution
        x, y, l11, l21, l22 = (np.asarray(cells[f"surface_{part}"], dtype=np.float64) * edge for part in PARTS)
        # Inverse Wishart: |Sigma|^-(nu + 3)/2 = (l11 l22)^-(nu + 3) times the Jacobian 4 l11^3 l22^2, then -psi / 2
        # times the trace of the inverse of Sigma.
        q = l21 / (l11 * l22)
        shape = -self.dof * np.log(l11) - (self.dof + 1) * np.log(l22)
        shape -= 0.5 * (self.spread * edge) ** 2 * (1 / l11**2 + 1 / l22**2 + q**2)
        # The bound of the size, tr Sigma / kappa^2, and the normal distribution of the mean.
        size = (l11**2 + l21**2 + l22**2) / (self.size_scale * edge) ** 2
        mean = (x**2 + y**2) / (self.mean_scale * edge) ** 2
        if max(np.abs(x).max(initial=0.0), np.abs(y).max(initial=0.0)) > (0.5 + ROUNDING) * edge:
            return -math.inf
        return super().log_prob(cells, grid) + float((shape - 0.5 * (size + mean)).sum())

    def sample_cells(self, rng: Rng, grid: Grid) -> dict[str, NDArray[Any]]:
        """Draw a map with a surface in every cell."""
        surfaces = self.sample_surfaces(rng, grid.n_cells).reshape(*grid.shape, len(PARTS))
        return super().sample_cells(rng, grid) | {f"surface_{part}": surfaces[..., i] for i, part in enumerate(PARTS)}

    def sample_surfaces(self, rng: Rng, count: int) -> Floats:
        """Draw surfaces in edges, (count, 5): mean x, y from the centre, then l11, l21, l22 of Sigma = L L'."""
        # Rejection sampling: the factor exp(-tr Sigma / (2 kappa^2)) is the probability of acceptance.
        surfaces = np.zeros((count, 5))
        pending = np.arange(count)
        while len(pending):
            candidates = self._sample_unbounded(rng, len(pending))
            with np.errstate(over="ignore"):  # infinite sizes are rejected, as they should be
                size = (candidates[:, 2:] ** 2).sum(axis=1) / self.size_scale**2
            accepted = rng.random(len(pending)) < np.exp(-0.5 * size)
            surfaces[pending[accepted]] = candidates[accepted]
            pending = pending[~accepted]
        return surfaces

    def _sample_unbounded(self, rng: Rng, count: int) -> Floats:
        """Draw surfaces without the factor that bounds their size, (count, 5)."""
        # Means are truncated normals by inversion; Cholesky factors invert Bartlett's factor of a Wishart draw.
        a11 = np.sqrt(rng.chisquare(self.dof, count))
        a22 = np.sqrt(rng.chisquare(self.dof - 1.0, count))
        a21 = rng.standard_normal(count)
        low, high = special.ndtr(np.array([-0.5, 0.5]) / self.mean_scale)
        mean = self.mean_scale * special.ndtri(rng.uniform(low, high, (2, count)))
        with np.errstate(divide="ignore", over="ignore"):
            shape = (self.spread / a22, -self.spread * a21 / (a11 * a22), self.spread / a11)
        return np.stack([*mean, *shape], axis=-1)

    def stops(self, cells: Cells, grid: Grid) -> NDArray[np.floating]:
        """Return reflectivities and surfaces, (N, 6), lengths in metres from the grid's corner."""
        parts = [np.ravel(cells[f"surface_{part}"]) for part in PARTS]
        stops = np.stack([np.ravel(cells["reflectivity"]), *parts], axis=-1).astype(np.float32)
        stops[:, 1:] *= grid.resolution
        stops[:, 1:3] += grid.centers_from_corner_m(np.arange(grid.n_cells))
        return stops

    def completed(self, cells: Cells, grid: Grid) -> Cells:
        """Return the map with prior draws of surfaces in cells in which no reading ends; the seed is fixed."""
        prior_draw = self.sample_surfaces(np.random.default_rng(0), grid.n_cells).reshape(*grid.shape, len(PARTS))
        complete = dict(super().completed(cells, grid))
        for i, name in enumerate(f"surface_{part}" for part in PARTS):
            stored = np.asarray(cells[name], dtype=np.float64)
            complete[name] = np.where(np.isnan(stored), prior_draw[..., i], stored)
        return complete

    def kernel_parameters(self, edge_m: float) -> PriorParameters:
        """Return the prior's parameters for kernels."""
        return PriorParameters(
            a=self.a, b=self.b, tau_m=self.mean_scale * edge_m, psi_m2=(self.spread * edge_m) ** 2, nu=self.dof,
            kappa_m=self.size_scale * edge_m, half_m=0.5 * edge_m, coupling=self.coupling, a_solid=self.a_solid,
            b_solid=self.b_solid,
        )  # fmt: skip

    def surfaces(self, draws: Draws) -> MeanSurfaces:
        """Compute the posterior mean surfaces of the cells in which readings end."""
        edge = draws.grid.resolution
        cells = draws.index["surface_cell"]
        mean = np.zeros((len(cells), 2))
        covariance = np.zeros((len(cells), 2, 2))
        for chain, draw in draws.numbers():
            arrays = [draws.arrays[f"surface_{part}"][chain, draw] for part in PARTS]
            x, y, l11, l21, l22 = (array.astype(np.float64) * edge for array in arrays)
            mean += np.stack([x, y], axis=-1)
            covariance[:, 0, 0] += l11**2
            covariance[:, 0, 1] += l11 * l21
            covariance[:, 1, 1] += l21**2 + l22**2
        covariance[:, 1, 0] = covariance[:, 0, 1]
        # Divide by the number of draws, and look up the reflectivities of the same cells.
        n_draws = max(draws.size, 1)
        mean = draws.grid.centers_from_corner_m(cells) + np.array(draws.grid.origin) + mean / n_draws
        position, _ = positions_in(draws.index["cell"], cells)
        reflectivity = draws.arrays["expected"][..., position].mean(axis=(0, 1), dtype=np.float64)
        return MeanSurfaces(mean, covariance / n_draws, reflectivity)

    def surface_writer(self, draws: Draws, cells: Ints) -> Callable[[Singles, int, int], None]:
        """Return a function (stops, chain, draw) that writes the surfaces of a draw's cells into stops, (n, 6)."""
        position, stored = positions_in(draws.index["surface_cell"], cells)
        position = position[stored]
        centre = draws.grid.centers_from_corner_m(cells)
        rng = np.random.default_rng(0)
        # Surfaces that draws do not store almost follow the prior, and are drawn from it. The pool of prior surfaces is
        # drawn once; each call of `write` reads it from the next random offset: results follow the order of calls.
        pool = self.sample_surfaces(rng, POOL_CELLS).astype(np.float32)

        def write(stops: Singles, chain: int, draw: int) -> None:
            surfaces = stops[:, 1:]
            surfaces[:] = pool[(cells + int(rng.integers(POOL_CELLS))) % POOL_CELLS]
            for part, name in enumerate(PARTS):
                surfaces[stored, part] = draws.arrays[f"surface_{name}"][chain, draw][position]
            surfaces *= draws.grid.resolution
            surfaces[:, :2] += centre

        return write

    def describe(self) -> dict[str, Any]:
        """Return the prior as plain JSON values."""
        parameters = {name: getattr(self, name) for name in ("mean_scale", "spread", "dof", "size_scale")}
        return {**super().describe(), "kind": "surface", **parameters}
