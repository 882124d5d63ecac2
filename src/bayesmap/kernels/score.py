"""Scoring beams under many maps: where does each beam first hit in every draw?"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch
from bayesmap.sensor.table import BeamTable

wp.set_module_options({"enable_backward": False})


@wp.kernel
def add_densities(
    first: int,
    offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    loglik: wp.array(dtype=wp.float32),
    beyond: wp.array(dtype=wp.float32),
    packed: wp.array2d(dtype=wp.uint8),
    most: wp.array(dtype=wp.float64),
    total: wp.array(dtype=wp.float64),
):
    """One thread a beam: add exp(log-likelihood) under each packed map to a running log-sum-exp."""
    b = first + wp.tid()
    for d in range(packed.shape[0]):
        term = beyond[b]
        for k in range(offsets[b], offsets[b + 1]):
            c = cells[k]
            if ((int(packed[d, c // 8]) >> (7 - c % 8)) & 1) != 0:
                term = loglik[k]
                break
        value = wp.float64(term)
        if value > most[b]:
            total[b] = total[b] * wp.exp(most[b] - value) + wp.float64(1.0)
            most[b] = value
        else:
            total[b] = total[b] + wp.exp(value - most[b])


def log_mean_density(table: BeamTable, packed: NDArray[np.uint8], device: str = "cpu") -> NDArray[np.float64]:
    """Log of each beam's likelihood averaged over packed maps (draws, bytes): the log predictive density, (B,)."""
    device = devices.resolve(device)
    beams = table.n_beams
    most: Any = wp.full(beams, -1.0e300, dtype=wp.float64, device=device)
    total = wp.zeros(beams, dtype=wp.float64, device=device)
    inputs = [devices.to_device(a, wp.int32, device) for a in (table.offsets, table.cells)]
    inputs += [devices.to_device(a, wp.float32, device) for a in (table.loglik, table.beyond)]
    inputs += [devices.to_device(packed, wp.uint8, device), most, total]
    launch(add_densities, beams, inputs, device)
    return np.asarray(most.numpy() + np.log(total.numpy() / len(packed)))


@wp.kernel
def sum_log_likelihoods(
    first: int,
    offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    loglik: wp.array(dtype=wp.float32),
    beyond: wp.array(dtype=wp.float32),
    packed: wp.array2d(dtype=wp.uint8),
    total: wp.array(dtype=wp.float64),
):
    """One thread a packed map: log p(readings | map)."""
    d = first + wp.tid()
    value = wp.float64(0.0)
    for b in range(beyond.shape[0]):
        term = beyond[b]
        for k in range(offsets[b], offsets[b + 1]):
            c = cells[k]
            if ((int(packed[d, c // 8]) >> (7 - c % 8)) & 1) != 0:
                term = loglik[k]
                break
        value += wp.float64(term)
    total[d] = value


def log_likelihoods(table: BeamTable, packed: NDArray[np.uint8], device: str = "cpu") -> NDArray[np.float64]:
    """Log p(all readings | map) of each packed map (draws, bytes), shape (draws,)."""
    device = devices.resolve(device)
    total = wp.empty(len(packed), dtype=wp.float64, device=device)
    inputs = [devices.to_device(a, wp.int32, device) for a in (table.offsets, table.cells)]
    inputs += [devices.to_device(a, wp.float32, device) for a in (table.loglik, table.beyond)]
    launch(sum_log_likelihoods, len(packed), [*inputs, devices.to_device(packed, wp.uint8, device), total], device)
    return np.array(total.numpy())
