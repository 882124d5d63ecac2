"""A fixed piece of single-core work: how fast this machine is at the moment."""

import time
from functools import cache

import numpy as np


@cache
def _arrays() -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(0)
    return rng.random(1 << 20), rng.integers(0, 1 << 20, 1 << 20)


def seconds(for_s: float = 0.0) -> float:
    """Seconds that the work takes: a gather, exponentials, a running sum and a sort.

    Args:
        for_s: do it again and again for so long, and take the mean: what lasts longer is disturbed more.
    """
    values, index = _arrays()
    began, times = time.perf_counter(), 0
    while times == 0 or time.perf_counter() - began < for_s:
        np.exp(values[index]).cumsum()
        np.sort(values[: 1 << 17])
        times += 1
    return (time.perf_counter() - began) / times
