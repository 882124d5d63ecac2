"""Evaluate maps of binary walls on a beam table: importance weights, log-likelihoods, and the cells that beams reach.

Maps of particles are not stored: each can be drawn again from its counter.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float64s, Floats, Uint8Rows
from bayesmap.kernels.random import random_bits
from bayesmap.kernels.walls.chains import Table, WallPriorArrays, draw_from_prior, table_to_device

wp.set_module_options({"enable_backward": False})

DeviceTable = Any  # a `Table` on a device, from `table_to_device`
DevicePrior = Any  # `WallPriorArrays` on a device, from `wall_prior_to_device`


@wp.func
def particle_wall(prior: WallPriorArrays, key: wp.uint64, particle: wp.uint64, n_cells: wp.uint64, c: int) -> bool:
    """Return whether cell c is a wall in the map of a particle."""
    return draw_from_prior(prior, c, random_bits(key, particle * n_cells + wp.uint64(c)))


@wp.kernel
def weigh_particles(
    first: int, t: Table, prior: WallPriorArrays, key: wp.uint64, particle_0: wp.uint64, log_weights: Float64s
):
    """One thread per particle: compute log p(readings | its map). Only cells that beams reach are drawn."""
    i = first + wp.tid()
    particle = particle_0 + wp.uint64(i)
    n_cells = wp.uint64(prior.level.shape[0])
    total = wp.float64(0.0)
    for b in range(t.no_hit.shape[0]):
        term = t.no_hit[b]
        for k in range(t.offsets[b], t.offsets[b + 1]):
            if particle_wall(prior, key, particle, n_cells, t.cells[k]):
                term = t.loglik[k]
                break
        total += wp.float64(term)
    log_weights[i] = total


@wp.kernel
def draw_particles(
    first: int, prior: WallPriorArrays, key: wp.uint64, particles: wp.array(dtype=wp.uint64), walls: Uint8Rows
):
    """One thread per particle: write its whole map."""
    i = first + wp.tid()
    n_cells = walls.shape[1]
    for c in range(n_cells):
        wall = particle_wall(prior, key, particles[i], wp.uint64(n_cells), c)
        walls[i, c] = wp.uint8(wp.where(wall, 1, 0))


def particle_log_weights(
    table: DeviceTable, prior: DevicePrior, key: int, first_particle: int, count: int, device: str
) -> Floats:
    """Compute the log weights of ``count`` particles from ``first_particle`` on, (count,)."""
    return np.asarray(devices.launch(weigh_particles, count, [table, prior, key, first_particle, (count,)], device)[0])


def particle_maps(prior: DevicePrior, key: int, particles: NDArray[np.intp], device: str) -> NDArray[np.uint8]:
    """Return the maps of the given particles, (n, N)."""
    walls = (len(particles), prior.level.shape[0])
    return np.asarray(devices.launch(draw_particles, len(particles), [prior, key, particles, walls], device)[0])


@wp.kernel
def sum_log_likelihoods(first: int, t: Table, packed: Uint8Rows, total: Float64s):
    """One thread per packed map: compute log p(readings | map); each beam ends at its first wall."""
    d = first + wp.tid()
    value = wp.float64(0.0)
    for b in range(t.no_hit.shape[0]):
        term = t.no_hit[b]
        for k in range(t.offsets[b], t.offsets[b + 1]):
            c = t.cells[k]
            if ((int(packed[d, c // 8]) >> (7 - c % 8)) & 1) != 0:
                term = t.loglik[k]
                break
        value += wp.float64(term)
    total[d] = value


def log_likelihoods(table: BeamTable, packed: NDArray[np.uint8], device: str = "cpu") -> Floats:
    """Compute log p(all readings | map) of each packed map (draws, bytes), (draws,)."""
    device = devices.resolve(device)
    inputs = [table_to_device(table, None, device), packed, (len(packed),)]
    return np.asarray(devices.launch(sum_log_likelihoods, len(packed), inputs, device)[0])


@wp.kernel
def mark_reached(first: int, t: Table, walls: Uint8Rows, reached: Uint8Rows):
    """One thread per map: mark every cell up to each beam's first wall."""
    m = first + wp.tid()
    for b in range(t.no_hit.shape[0]):
        for k in range(t.offsets[b], t.offsets[b + 1]):
            c = t.cells[k]
            reached[m, c] = wp.uint8(1)
            if walls[m, c] != wp.uint8(0):
                break


def reach_frequency(table: BeamTable, maps: NDArray[np.bool_], device: str = "cpu") -> Floats:
    """Compute the share of the maps (n, nx, ny) in which at least one beam reaches each cell, (nx, ny)."""
    device = devices.resolve(device)
    flat = np.reshape(maps, (len(maps), -1))
    (reached,) = devices.launch(
        mark_reached, len(flat), [table_to_device(table, None, device), flat, flat.shape], device
    )
    return np.asarray(reached.mean(axis=0).reshape(table.grid.shape))
