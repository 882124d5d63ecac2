"""The laws of Gibbs updates on all 2^n maps at once: a distribution in, the distribution after the update out."""

import numpy as np


def update_sites(p, log_joint, n, cells):
    """Redraw some cells together from their conditional: p' (s) = P(other cells of s) P(cells of s | others)."""
    states = np.arange(1 << n)
    mask = int(sum(1 << c for c in cells))
    patterns = [int(sum(1 << c for i, c in enumerate(cells) if m >> i & 1)) for m in range(1 << len(cells))]
    others = states[(states & mask) == 0]
    group = np.stack([others | pattern for pattern in patterns])  # (patterns, 2^(n - cells))
    # A group without any possible state is never entered: what stands there does not matter.
    top = np.maximum(log_joint[group].max(axis=0), -1e300)
    weights = np.exp(log_joint[group] - top)
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
    """The cells of one sweep, each in a list of its own."""
    cells = [(x, y) for x in range(shape[0]) for y in range(shape[1])]
    if order == "radial":
        away = radial(shape, poses, grid)
        cells = sorted(cells, key=away.__getitem__)  # sorted() is stable
    return [[x * shape[1] + y] for x, y in cells]


def block_sites(shape, order, poses, grid):
    """The overlapping 2 x 2 blocks of one sweep (smaller on grids one cell wide), ordered by their low corner."""
    nx, ny = shape
    corners = [(x, y) for x in range(max(1, nx - 1)) for y in range(max(1, ny - 1))]
    if order == "radial":
        away = radial(shape, poses, grid)
        corners = sorted(corners, key=away.__getitem__)
    return [
        [(x + dx) * ny + y + dy for dx in (0, 1) for dy in (0, 1) if x + dx < nx and y + dy < ny] for x, y in corners
    ]


def sweeps(p, log_joint, n, sites, count):
    """The law after some sweeps."""
    for _ in range(count):
        for cells in sites:
            p = update_sites(p, log_joint, n, cells)
    return p
