"""Which cells each beam crosses and how far away they are: the beam table without readings, for JAX.

Two views of the same incidences: by beams, as rows of equal length that end in sentinels, to look along a beam; and
by cells, to find the beams through one.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.sensors.model import RangeLimits
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

LOOK = 16
"""How many cells of a beam are looked at in one go."""
GROUP = 8
"""How many beams of a cell are looked at in one go."""


@dataclass(frozen=True, eq=False)
class BeamGeometry:
    """B beams on a grid of N cells; position l of a beam is the l-th cell that it touches.

    It is compared by content and can be hashed, so that it may be a static part of JAX's trees: two models of
    equal geometry share one compilation, and a batch of traces does not hold a copy for each.

    Attributes:
        shape: (nx, ny) of the grid.
        cells: (B, L + LOOK) int32, flat indices x * ny + y in the order of touch, then sentinels N: a wall that is
            always there, so that every search along a beam ends.
        distance_m: (B, L + LOOK) float32, distance at which the beam would hit each; inf at sentinels.
        offsets: (N + 1,) int32; cell c has the entries offsets[c] : offsets[c + 1] of the two arrays below.
        beam: (K + GROUP,) int32, beams through the cells; the last GROUP are padding.
        position: (K + GROUP,) int32, where in that beam the cell stands.
    """

    shape: tuple[int, int]
    cells: NDArray[np.int32]
    distance_m: NDArray[np.float32]
    offsets: NDArray[np.int32]
    beam: NDArray[np.int32]
    position: NDArray[np.int32]

    @property
    def n_beams(self) -> int:
        """B."""
        return len(self.cells)

    @property
    def n_cells(self) -> int:
        """N."""
        return self.shape[0] * self.shape[1]

    @property
    def longest(self) -> int:
        """L + 1, the number of outcomes of the longest beam; its last position is a sentinel."""
        return int(self.cells.shape[1]) - LOOK + 1

    @cached_property
    def position_dtype(self) -> np.dtype[np.unsignedinteger]:
        """The smallest type that holds a position: a trace keeps one for each beam."""
        return np.min_scalar_type(self.longest)

    @cached_property
    def _digest(self) -> bytes:
        found = hashlib.sha256()
        for f in fields(self):
            array = np.asarray(getattr(self, f.name))
            found.update(repr((array.shape, array.dtype)).encode() + array.tobytes())
        return found.digest()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, BeamGeometry) and self._digest == other._digest

    def __hash__(self) -> int:
        return hash(self._digest)

    def __repr__(self) -> str:
        return f"BeamGeometry({self.n_beams} beams on {self.shape[0]} x {self.shape[1]} cells)"


def beam_geometry(
    grid: Grid, poses: ArrayLike, angles_rad: NDArray[np.float64], limits: RangeLimits, hit_depth: float
) -> BeamGeometry:
    """Trace the beams of S poses, shape (S, 3), and A angles: beam s * A + a is beam a of pose s."""
    from bayesmap.kernels.rays import trace_rays  # loads Warp

    unread = np.zeros((len(np.atleast_2d(poses)), len(angles_rad)))
    scans = Scans(poses, angles_rad, unread, limits.max_m, limits.min_m)  # type: ignore[arg-type]
    rays = trace_rays(scans, grid)

    beam = rays.beam_of_entry()
    position = (np.arange(rays.n_incidences) - rays.offsets[beam]).astype(np.int32)
    width = int(rays.lengths.max(initial=0)) + LOOK
    cells = np.full((rays.n_beams, width), grid.n_cells, dtype=np.int32)
    distance_m = np.full((rays.n_beams, width), np.inf, dtype=np.float32)
    cells[beam, position] = rays.cells
    distance_m[beam, position] = rays.distance_m(hit_depth)

    by_cell = np.argsort(rays.cells, kind="stable")
    offsets = np.zeros(grid.n_cells + 1, dtype=np.int32)
    np.cumsum(np.bincount(rays.cells, minlength=grid.n_cells), out=offsets[1:])
    padding = np.zeros(GROUP, dtype=np.int32)
    return BeamGeometry(
        shape=grid.shape,
        cells=cells,
        distance_m=distance_m,
        offsets=offsets,
        beam=np.concatenate([beam[by_cell], padding]),
        position=np.concatenate([position[by_cell], padding]),
    )
