"""The orders in which random sweeps visit their sites, by the package's own shuffle."""

import numpy as np
import warp as wp

from bayesmap.kernels import device
from bayesmap.kernels.random import cipher_bits, mix, permuted_index, random_bits
from bayesmap.samplers.sampler import Stream

wp.set_module_options({"enable_backward": False})


@wp.kernel
def all_shuffled(size: int, bits: wp.uint32, keys: wp.array(dtype=wp.uint64), out: wp.array2d(dtype=wp.uint32)):
    row, i = wp.tid()
    out[row, i] = permuted_index(wp.uint32(i), wp.uint32(size), bits, keys[row])


@wp.kernel
def sweep_keys(sweep: int, keys: wp.array(dtype=wp.uint64), out: wp.array(dtype=wp.uint64)):
    i = wp.tid()
    out[i] = random_bits(keys[i], ~wp.uint64(sweep))


def shuffles(size, keys):
    device.start()
    out = wp.empty((len(keys), size), dtype=wp.uint32, device="cpu")
    if not isinstance(keys, wp.array):
        keys = wp.array(np.array(keys, dtype=np.uint64), dtype=wp.uint64, device="cpu")
    wp.launch(all_shuffled, dim=(len(keys), size), inputs=[size, cipher_bits(size), keys, out], device="cpu")
    return out.numpy().astype(np.int64)


def shuffles_of_chains(size, seed, chains, sweep):
    """The orders in which the chains of a run visit ``size`` sites in a sweep, (chains, size)."""
    device.start()
    keys = [mix(seed, chain, Stream.SWEEPS) for chain in range(chains)]
    keys = wp.array(np.array(keys, dtype=np.uint64), dtype=wp.uint64, device="cpu")
    mixed = wp.empty(chains, dtype=wp.uint64, device="cpu")
    wp.launch(sweep_keys, dim=chains, inputs=[sweep, keys, mixed], device="cpu")
    return shuffles(size, mixed)
