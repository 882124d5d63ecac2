"""Rooms to be located in: maps that are known, and scans drawn in them."""

import numpy as np

import bayesmap as bm
from bayesmap.sensors.model import RangeLimits

LASER = bm.BeamMixture(bm.Gaussian(0.03), p_random=0.02, p_no_return=0.01, p_short=0.01)
ANGLES = np.arange(36) * 2 * np.pi / 36
LIMITS = RangeLimits(0.0, 10.0)


def walls_of(width, depth, resolution=0.1, alcove=True):
    """A rectangular room with walls a cell thick, and perhaps an alcove that breaks its symmetry."""
    walls = np.zeros((round(width / resolution), round(depth / resolution)), dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    if alcove:
        walls[-8:, -12:] = True
    return walls, bm.Grid(walls.shape, resolution)


def known(walls, grid, scans, sensor=LASER, observed=None, **options):
    seen = np.ones(grid.shape, dtype=bool) if observed is None else observed
    return bm.KnownMap.of_draws(
        walls.ravel()[None].astype(np.float32), grid, sensor, scans, occupancy=walls.astype(float), observed=seen,
        hit_depth=0.0, **options,
    )  # fmt: skip


def scan_from(walls, grid, poses, sensor=LASER, angles=ANGLES, seed=0, max_range_m=10.0):
    return bm.simulate(walls, grid, poses, angles, sensor=sensor, max_range_m=max_range_m, typed=True, seed=seed)


def enumerated(here, lattice, ranges_m, log_prior=0.0, **options):
    """Mean and standard deviations of poses by sums over a lattice."""
    logs = log_prior + here.log_likelihood(lattice, ANGLES, ranges_m, LIMITS, **options)
    weights = np.exp(logs - logs.max())
    weights /= weights.sum()
    mean = weights @ lattice
    return mean, np.sqrt(weights @ (lattice - mean) ** 2)


def lattice_about(pose, half_widths, steps):
    """Poses in a box about one, (steps^3, 3)."""
    axes = [np.linspace(-half, half, steps) for half in half_widths]
    return pose + np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def offset(found, truth):
    turn = (found[2] - truth[2] + np.pi) % (2 * np.pi) - np.pi
    return np.hypot(found[0] - truth[0], found[1] - truth[1]), abs(turn)
