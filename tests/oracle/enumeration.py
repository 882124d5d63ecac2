"""The posterior of tiny maps by brute force: every map, its prior, its likelihood by the tutorial's formula."""

from dataclasses import dataclass

import numpy as np
from oracle.formula import beams, touches


def all_maps(n):
    """Every map of n cells, shape (2^n, n); bit c of a map's number is its cell c."""
    return (np.arange(1 << n)[:, None] >> np.arange(n)) & 1 == 1


def number_of(maps):
    """The numbers of maps, shape (..., n) to (...)."""
    maps = np.asarray(maps)
    return (maps.astype(np.int64) << np.arange(maps.shape[-1])).sum(axis=-1)


@dataclass(frozen=True)
class Exact:
    """log p(map, readings) and p(map | readings) of all 2^n maps."""

    n: int
    log_joint: np.ndarray

    @property
    def log_evidence(self):
        top = self.log_joint.max()
        return float(top + np.log(np.exp(self.log_joint - top).sum()))

    @property
    def p(self):
        p = np.exp(self.log_joint - self.log_joint.max())
        return p / p.sum()


def neighbours(shape):
    """All pairs of cells that share an edge, by flat index."""
    places = [(x, y) for x in range(shape[0]) for y in range(shape[1])]
    return [
        (i, j)
        for i, (a, b) in enumerate(places)
        for j, (c, d) in enumerate(places)
        if i < j and abs(a - c) + abs(b - d) == 1
    ]


def log_prior_of_all(shape, p_wall, coupling=0.0):
    """Log p(map) of all 2^n maps, normalised; ``coupling`` is what each pair of like neighbours adds."""
    maps = all_maps(shape[0] * shape[1])
    p_wall = np.broadcast_to(p_wall, shape).ravel()
    with np.errstate(divide="ignore"):
        log_p = np.where(maps, np.log(p_wall), np.log1p(-p_wall)).sum(axis=1)
    if coupling:
        for a, b in neighbours(shape):
            log_p = log_p + coupling * (maps[:, a] == maps[:, b])
        log_p = log_p - log_p.max() - np.log(np.exp(log_p - log_p.max()).sum())
    return log_p


def enumerate_posterior(scans, grid, p_wall, log_likelihood, coupling=0.0):
    """Enumerate. ``log_likelihood(z, d)`` scores one reading at an array of distances in metres (inf: no wall)."""
    n = grid.shape[0] * grid.shape[1]
    maps = all_maps(n)
    log_joint = log_prior_of_all(grid.shape, p_wall, coupling)
    starts, angles = beams(scans.poses, scans.angles_rad, grid)
    metres = touches(starts, angles, grid.shape) * grid.resolution
    for z, to_cell in zip(scans.ranges_m.ravel(), metres, strict=True):
        if np.isnan(z):
            continue
        first = np.full(len(maps), n)  # the cell that a map's beam meets first, n for none
        for c in np.argsort(to_cell)[::-1]:  # the nearest is written last
            if np.isfinite(to_cell[c]):
                first[maps[:, c]] = c
        log_joint = log_joint + log_likelihood(z, np.append(to_cell, np.inf))[first]
    return Exact(n, log_joint)


def marginals(p, n):
    """P(cell is a wall), shape (n,)."""
    return p @ all_maps(n).astype(float)


def pairs(p, n):
    """P(both cells are walls), shape (n, n)."""
    maps = all_maps(n).astype(float)
    return (maps * p[:, None]).T @ maps
