"""Distances by the tutorial's formula: intersect the beam's line with the four edges of every wall pixel.

This shares no code with the package, neither with its kernels nor with its plain reference. Everything is in units of
cells: cell (i, j) is the closed square [i, i + 1] x [j, j + 1].
"""

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
