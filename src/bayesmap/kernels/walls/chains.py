"""Chains on a device, and running their sweeps."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch
from bayesmap.kernels.walls.shuffle import cipher_bits
from bayesmap.kernels.walls.state import Chains, derive_state

wp.set_module_options({"enable_backward": False})


class WallChains:
    """The states of several chains on a device, each following from its walls (see `bayesmap.kernels.walls.state`).

    Attributes:
        states: the arrays, one row a chain.
        keys: (chains,), one key of random numbers each.
    """

    def __init__(self, table: Any, walls: NDArray[np.uint8], keys: Sequence[int], device: str) -> None:
        self.device = device
        self.shape = chains, cells = walls.shape
        beams = table.no_hit.shape[0]
        states = Chains()
        states.walls = wp.array(np.ascontiguousarray(walls, dtype=np.uint8), dtype=wp.uint8, device=device)
        states.first = wp.empty((chains, beams), dtype=wp.int32, device=device)
        states.current = wp.empty((chains, beams), dtype=wp.float32, device=device)
        states.reached = wp.empty((chains, cells), dtype=wp.int32, device=device)
        states.gain = wp.empty((chains, cells), dtype=wp.float32, device=device)
        states.known = wp.empty((chains, cells), dtype=wp.uint8, device=device)
        self.states = states
        self.keys = wp.array(np.array(keys, dtype=np.uint64), dtype=wp.uint64, device=device)
        launch(derive_state, chains, [table, states], device)

    def host_walls(self) -> NDArray[np.uint8]:
        """A copy of the maps in main memory, shape (chains, N)."""
        return np.array(self.states.walls.numpy())


def run_sweeps(
    kernel: Any,
    tables: Sequence[Any],
    prior: Any,
    log_all_free: float,
    order: NDArray[np.int32],
    shuffle: bool,
    chains: WallChains,
    *,
    first: int,
    sweeps: int,
    kept: range,
    beta: float = 1.0,
    threads: int | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.uint8]]:
    """Advance the chains in place by some sweeps of a kernel, one chain a thread.

    Args:
        kernel: of the sweep.
        tables: that it takes first.
        prior: of the walls, on the device.
        log_all_free: log prior of the map with no wall but those that the prior fixes.
        order: of the sites.
        shuffle: whether it is shuffled in each sweep.
        chains: to advance.
        first: number of the first sweep, from 0.
        sweeps: how many.
        kept: numbers, from 1, of those whose maps are kept.
        beta: inverse temperature.
        threads: of the CPU; all cores if None.

    Returns:
        log-likelihoods and log priors after each sweep, (chains, sweeps), and the kept maps, packed, (chains, kept,
        ceil(N / 8)).
    """
    n, cells = chains.shape
    device = chains.device
    log_likelihoods, log_priors = (wp.empty((n, sweeps), dtype=wp.float64, device=device) for _ in range(2))
    draws = wp.empty((n, len(kept), (cells + 7) // 8), dtype=wp.uint8, device=device)
    bits = cipher_bits(len(order)) if shuffle else 0
    inputs = [*tables, prior, wp.float64(log_all_free), wp.float64(beta), chains.keys]
    inputs += [devices.to_device(order, wp.int32, device), wp.uint32(bits), first, sweeps]
    inputs += [chains.states, kept.start, kept.step, draws, log_likelihoods, log_priors]
    launch(kernel, n, inputs, device, threads=threads)
    return log_likelihoods.numpy(), log_priors.numpy(), draws.numpy()
