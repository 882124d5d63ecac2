"""Likelihood grids: how well a point at a place agrees with scans, as one byte a cell, with the pyramid for matching.

A cell holds 255 exp(-d^2 / (2 sigma^2)), d its distance from the nearest point (Olson 2009, "Real-time correlative scan
matching"; the likelihood field of Thrun, Burgard and Fox 2005, section 6.4, without the logarithm). Where neighbouring
beams ended on one wall further apart than sigma, points in between count as well: what a grid says does not depend on
how many beams a laser has. Level h of the pyramid holds at (x, y) the largest value of the cells
(x .. x + 2^h - 1, y .. y + 2^h - 1) (Hess et al. 2016).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.scan_geometry import ScanGeometry

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LikelihoodGrids:
    """Grids of one shape and resolution.

    Attributes:
        pyramid: (grids, levels, nx, ny) bytes on the device; level 0 is the likelihood.
        origins: world coordinates of each grid's corner, metres, shape (grids, 2).
        resolution: width of a cell, metres.
        device: where the pyramid is.
    """

    pyramid: Any
    origins: Floats
    resolution: float
    device: str = "cpu"

    def __len__(self) -> int:
        return len(self.origins)


def stamp_of(resolution: float, sigma_m: float) -> NDArray[np.uint8]:
    """What one point puts around itself: odd square of bytes, out to about two standard deviations."""
    radius = max(1, int(np.ceil(2.0 * sigma_m / resolution)))
    offsets = np.arange(-radius, radius + 1) * resolution
    squared = offsets[:, None] ** 2 + offsets[None, :] ** 2
    return np.round(255.0 * np.exp(-squared / (2.0 * sigma_m**2))).astype(np.uint8)


def likelihood_grids(
    geometry: ScanGeometry,
    scans: Sequence[NDArray[np.intp]],
    poses_world: Sequence[Floats],
    centres: Floats,
    half_width_m: float,
    *,
    resolution: float = 0.05,
    sigma_m: float = 0.07,
    levels: int = 4,
    threads: int | None = None,
    reuse: LikelihoodGrids | None = None,
) -> LikelihoodGrids:
    """Draw square grids, each from some scans at given poses.

    Args:
        geometry: of all scans.
        scans: for each grid, the scans that it is made of.
        poses_world: for each grid, the poses of those scans, shape (scans, 3), in the frame of the grid.
        centres: middle of each grid, shape (grids, 2).
        half_width_m: from the middle to each side.
        resolution: width of a cell, metres.
        sigma_m: of the likelihood.
        levels: of the pyramid: blocks of up to 2^(levels - 1) cells are bounded at once.
        threads: to compute with; by default all cores.
        reuse: grids of the same number, size and levels that are no longer needed: their memory is written over.
    """
    from bayesmap.kernels.match.likelihood_grid import draw_grids

    cells = int(np.ceil(2.0 * half_width_m / resolution))
    offsets = np.concatenate([[0], np.cumsum([len(s) for s in scans])]).astype(np.int32)
    scan = np.concatenate([np.asarray(s, np.int32) for s in scans]) if len(scans) else np.zeros(0, np.int32)
    poses = np.concatenate([np.reshape(p, (-1, 3)) for p in poses_world]) if len(scans) else np.zeros((0, 3))
    origins = np.asarray(centres, np.float64).reshape(-1, 2) - half_width_m
    pyramid = draw_grids(
        geometry, offsets, scan, poses, origins, resolution, stamp_of(resolution, sigma_m), sigma_m, (cells, cells),
        levels, threads, None if reuse is None else reuse.pyramid,
    )  # fmt: skip
    return LikelihoodGrids(pyramid, origins, resolution, geometry.device)
