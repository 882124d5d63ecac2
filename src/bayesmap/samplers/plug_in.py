"""A first guess at cells and surfaces, taking every reading at its word: where chains start, and how far they step.

Hits and their scatter per cell are what normal-distributions-transform maps keep (Stoyanov, Saarinen et al., 2013).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from bayesmap.beams.beam_rays import BeamRays
from bayesmap.cells.reflectivity import Reflective

CENTRE_WEIGHT = 0.3  # hits that the prior's centre counts for
IDLE_ROUND, REMOTE_ROUND = 16, 32
FRESH = 1 << 16  # surfaces that are drawn from the prior: more cells than that share them
LOGIT_STEP = 1.0
ALONG = 0.25
EXTENT = 0.5
ACROSS = 1.5
THICKNESS = 1.2
"""Sizes of steps: they accept a third to a half."""


@dataclass(frozen=True, eq=False)
class PlugIn:
    """What the readings at their word make of each touched cell.

    Attributes:
        hits, passes: readings that end there, and beams that pass, (T,).
        mean_m: mean of the end points, drawn towards the centre, (T, 2), metres from the grid's corner.
        factor_m: Cholesky factor of their covariance, drawn towards the prior's size: l11, l21, l22, (T, 3).
        remote: cells in which no reading ends, nor in any of the eight around them, (T,).
    """

    hits: NDArray[np.int64]
    passes: NDArray[np.int32]
    mean_m: NDArray[np.float64]
    factor_m: NDArray[np.float64]
    remote: NDArray[np.bool_]

    @property
    def busy(self) -> NDArray[np.bool_]:
        """Cells in which a reading ends, (T,)."""
        return np.asarray(self.hits > 0)


def plug_in(rays: BeamRays, prior: Reflective, device: str = "cpu") -> PlugIn:
    """Count hits and passes, and fit a normal distribution to each cell's end points."""
    from bayesmap.kernels.plug_in import passes_at_their_word

    cells, edge = rays.n_cells, rays.grid.resolution
    end_cell = end_cells(rays)
    ended = end_cell >= 0
    cell, points = end_cell[ended], rays.end_points_m()[ended]
    spread = prior.first_spread * edge

    def total(values: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        return np.bincount(cell, values, cells).astype(np.float64)

    centre, hits = rays.centres_m(), total()
    weight = hits + CENTRE_WEIGHT
    mean = np.stack([total(points[:, i]) + CENTRE_WEIGHT * centre[:, i] for i in (0, 1)], axis=-1) / weight[:, None]
    away, off = points - mean[cell], centre - mean

    def second(i: int, j: int) -> NDArray[np.float64]:
        scatter = total(away[:, i] * away[:, j]) + CENTRE_WEIGHT * off[:, i] * off[:, j]
        return (scatter + (i == j) * 0.5 * spread**2) / (hits + 1.0)

    l11 = np.sqrt(second(0, 0))
    l21 = second(0, 1) / l11
    l22 = np.sqrt(np.maximum(second(1, 1) - l21**2, (1e-3 * edge) ** 2))
    return PlugIn(
        hits=hits.astype(np.int64),
        passes=passes_at_their_word(rays, end_cell, device),
        mean_m=mean,
        factor_m=np.stack([l11, l21, l22], axis=-1),
        remote=_remote(rays, hits > 0),
    )


def _remote(rays: BeamRays, busy: NDArray[np.bool_]) -> NDArray[np.bool_]:
    ends = np.zeros(rays.grid.n_cells, dtype=np.bool_)
    ends[rays.touched[busy]] = True
    around = ndimage.binary_dilation(ends.reshape(rays.grid.shape), np.ones((3, 3)))
    return np.asarray(~around.reshape(-1)[rays.touched])


def end_cells(rays: BeamRays) -> NDArray[np.int32]:
    """Number of the touched cell in which each reading ends; -1 for none, shape (B,)."""
    nx, ny = rays.grid.shape
    points = rays.end_points_m()
    finite: NDArray[np.bool_] = np.asarray(np.isfinite(points).all(axis=1))
    cell = np.floor(np.where(finite[:, None], points, -1.0) / rays.grid.resolution).astype(np.int64)
    inside = finite & (cell >= 0).all(axis=1) & (cell < (nx, ny)).all(axis=1)
    flat = np.where(inside, cell[:, 0] * ny + cell[:, 1], 0)
    place = np.minimum(np.searchsorted(rays.touched, flat), max(rays.n_cells - 1, 0))
    if rays.n_cells == 0:
        return np.full(rays.n_beams, -1, dtype=np.int32)
    return np.where(inside & (rays.touched[place] == flat), place, -1).astype(np.int32)


def starts(
    guess: PlugIn, prior: Reflective, edge_m: float, chains: int, rng: np.random.Generator
) -> NDArray[np.float32]:
    """States for several chains, (C, T, 6), scattered about the guess about as widely as the posterior.

    Cells in which no reading ends have surfaces from the prior.
    """
    cells = len(guess.hits)
    states = np.zeros((chains, cells, 6), dtype=np.float32)
    width = 1.0 / np.sqrt(guess.hits + 1.0)
    for state in states:
        # Half of the passes: those of a cell that a wall fills in part mostly go by beside the wall.
        state[:, 0] = rng.beta(guess.hits + prior.a, 0.5 * guess.passes + prior.b)
        l11, l21, l22 = guess.factor_m.T * np.exp(0.5 * width * rng.standard_normal((3, cells)))
        e1, e2 = width * rng.standard_normal((2, cells))
        state[:, 1] = guess.mean_m[:, 0] + l11 * e1
        state[:, 2] = guess.mean_m[:, 1] + l21 * e1 + l22 * e2
        state[:, 3], state[:, 4], state[:, 5] = l11, l21, l22
        if prior.has_surfaces:
            idle = np.nonzero(~guess.busy)[0]
            surfaces = prior.sample_surfaces(rng, min(len(idle), FRESH)) * edge_m
            if len(idle) > FRESH:
                surfaces = surfaces[rng.integers(FRESH, size=len(idle))]
            state[idle, 1:3] = guess.mean_m[idle] + surfaces[:, :2]
            state[idle, 3:] = surfaces[:, 2:]
    return states


def pace(guess: PlugIn) -> NDArray[np.int32]:
    """In how many sweeps each cell's turn comes round, (T,): 0 for busy cells, whose turn is always.

    Of free cells away from all readings little is learnt in a sweep, and they are most of what beams cross.
    """
    return np.where(guess.busy, 0, np.where(guess.remote, REMOTE_ROUND, IDLE_ROUND)).astype(np.int32)


def steps(guess: PlugIn, edge_m: float) -> NDArray[np.float32]:
    """Frame and size of each cell's steps, (T, 8), as `bayesmap.kernels.surface_steps` reads them.

    Along the wall steps are a part of the cell; across it they shrink with the readings. Cells in which no reading ends
    take no steps: their candidates come from the prior.
    """
    l11, l21, l22 = guess.factor_m.T
    var_x, both, var_y = l11**2, l11 * l21, l21**2 + l22**2
    angle = 0.5 * np.arctan2(2 * both, var_x - var_y)
    half, off = 0.5 * (var_x + var_y), np.hypot(0.5 * (var_x - var_y), both)
    thickness = np.sqrt(np.maximum(half - off, (1e-3 * edge_m) ** 2))
    few = 1.0 / np.sqrt(guess.hits + 1.0)
    logit = np.sqrt(1.0 / (guess.hits + 1.0) + 1.0 / (0.5 * guess.passes + 1.0))
    across = ACROSS * thickness * few
    out = np.zeros((len(few), 8), dtype=np.float32)
    for i, size in enumerate((LOGIT_STEP * logit, ALONG * edge_m, across, EXTENT, across, THICKNESS * few)):
        out[:, i] = np.where(guess.busy, size, 0.0)
    out[:, 6], out[:, 7] = np.cos(angle), np.sin(angle)
    return out
