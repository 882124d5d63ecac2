"""The posterior of tiny maps by brute force: every map, its prior, its likelihood by the tutorial's formula.

And the laws of Gibbs updates on all 2^n maps at once: a distribution in, the distribution after the update out.

Distances are those of the tutorial's formula: intersect the beam's line with the four edges of every wall pixel. This
shares no code with the package. Distances are in cells: cell (i, j) is the closed square [i, i + 1] x [j, j + 1].
"""

from dataclasses import dataclass

import numpy as np

PARALLEL = 1e-10  # the tutorial's tolerance on the determinant


def touches(starts, angles, shape, *, slack=1e-11):
    """Distance at which each beam would meet each cell if it were a wall; inf where it misses. Shape (B, nx * ny).

    ``slack`` lengthens the edges on either side, so that rounding does not open the closed edges.
    """
    starts = np.asarray(starts, dtype=np.float64)
    u = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    corners = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 2).astype(float)
    nearest = np.full((len(starts), len(corners)), np.inf)
    for corner, edge in (((0, 0), (1, 0)), ((0, 0), (0, 1)), ((1, 0), (0, 1)), ((0, 1), (1, 0))):
        q, v = corners + np.array(corner), np.array(edge, dtype=float)
        det = (u[:, 0] * v[1] - u[:, 1] * v[0])[:, None]
        parallel = np.abs(det) < PARALLEL
        det = np.where(parallel, 1.0, det)
        away = starts[:, None, :] - q[None, :, :]
        s = (v[0] * away[..., 1] - v[1] * away[..., 0]) / det
        t = (u[:, None, 0] * away[..., 1] - u[:, None, 1] * away[..., 0]) / det
        met = ~parallel & (s >= -slack) & (t >= -slack) & (t <= 1 + slack)
        nearest = np.minimum(nearest, np.where(met, np.maximum(s, 0.0), np.inf))
    return nearest


def distances(walls, starts, angles, *, longest=np.inf, slack=1e-11):
    """Distance of the first wall along each beam, capped: the least over all wall cells. Shape (B,)."""
    met = touches(starts, angles, walls.shape, slack=slack)
    return np.minimum(np.where(walls.ravel(), met, np.inf).min(axis=1), longest)


def beams(poses, angles, grid):
    """Starts in cells and directions of all beams of several poses, scan by scan: (S * A, 2) and (S * A,)."""
    poses = np.atleast_2d(np.asarray(poses, dtype=np.float64))
    starts = (poses[:, :2] - np.array(grid.origin)) / grid.resolution
    return np.repeat(starts, len(angles), axis=0), (poses[:, 2:] + np.asarray(angles)[None, :]).ravel()


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
    for z, to_cell in zip(scans.ranges_m.ravel(), touches(starts, angles, grid.shape) * grid.resolution, strict=True):
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


def update_sites(p, log_joint, n, cells):
    """Redraw some cells together from their conditional: p' (s) = P(other cells of s) P(cells of s | others)."""
    states = np.arange(1 << n)
    mask = int(sum(1 << c for c in cells))
    patterns = [int(sum(1 << c for i, c in enumerate(cells) if m >> i & 1)) for m in range(1 << len(cells))]
    others = states[(states & mask) == 0]
    group = np.stack([others | pattern for pattern in patterns])  # (patterns, 2^(n - cells))
    # A group without any possible state is never entered: what stands there does not matter.
    weights = np.exp(log_joint[group] - np.maximum(log_joint[group].max(axis=0), -1e300))
    total = weights.sum(axis=0)
    conditional = weights / np.where(total == 0, 1.0, total)
    after = np.zeros_like(p)
    after[group] = p[group].sum(axis=0) * conditional
    return after


def radial(shape, poses, grid):
    """Cells by L1 distance from the nearest sensor, ties by index: the tutorial's diamonds."""
    start = np.floor((np.atleast_2d(poses)[:, :2] - np.array(grid.origin)) / grid.resolution).astype(int)
    start = np.clip(start, 0, np.array(shape) - 1)
    return {
        (x, y): min(abs(x - a) + abs(y - b) for a, b in start.tolist())
        for x in range(shape[0])
        for y in range(shape[1])
    }


def single_sites(shape, order, poses, grid):
    cells = [(x, y) for x in range(shape[0]) for y in range(shape[1])]
    if order == "radial":
        cells = sorted(cells, key=radial(shape, poses, grid).__getitem__)  # sorted() is stable
    return [[x * shape[1] + y] for x, y in cells]


def block_sites(shape, order, poses, grid):
    """The overlapping 2 x 2 blocks of one sweep (smaller on grids one cell wide), ordered by their low corner."""
    nx, ny = shape
    corners = [(x, y) for x in range(max(1, nx - 1)) for y in range(max(1, ny - 1))]
    if order == "radial":
        corners = sorted(corners, key=radial(shape, poses, grid).__getitem__)
    return [
        [(x + dx) * ny + y + dy for dx in (0, 1) for dy in (0, 1) if x + dx < nx and y + dy < ny] for x, y in corners
    ]


def sweeps(p, log_joint, n, sites, count):
    for _ in range(count):
        for cells in sites:
            p = update_sites(p, log_joint, n, cells)
    return p
