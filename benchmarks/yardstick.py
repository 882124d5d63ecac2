"""A fixed piece of single-core work: how fast this machine is at the moment."""

import time
from functools import cache

import numpy as np


@cache
def _arrays() -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(0)
    return rng.random(1 << 20), rng.integers(0, 1 << 20, 1 << 20)


def seconds() -> float:
    """Do the work once: a gather, exponentials, a running sum and a sort."""
    values, index = _arrays()
    began = time.perf_counter()
    np.exp(values[index]).cumsum()
    np.sort(values[: 1 << 17])
    return time.perf_counter() - began
