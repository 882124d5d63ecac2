"""Which pairs of a simulated path's poses a file of true relations names."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import check_count

NEAR_M = 4.0
"""Poses further apart than this see different walls, and no ground truth is measured between them."""

PAIRS_A_POSE = 3


def related_pairs(poses_world: NDArray[np.float64], seed: int = 0) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Choose pairs of poses up to `NEAR_M` apart: each with its next, and with two others, at all distances in time.

    Kuemmerle et al. (2009) relate poses whose scans a person can lay on top of each other: neighbours in time, and
    places seen again.

    Args:
        poses_world: shape (S, 3).
        seed: of the choice.

    Returns:
        Indices of the earlier and the later pose of each pair, ascending, each pair once.
    """
    count = len(poses_world)
    rng = np.random.default_rng(check_count("relations", "seed", seed, 0))
    if count < 2:
        return np.empty(0, np.intp), np.empty(0, np.intp)
    pairs = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    start = rng.integers(0, count - 1, PAIRS_A_POSE * 4 * count)
    # Log-uniform gaps: as many pairs seconds apart as minutes.
    gap = np.exp(rng.uniform(0.0, np.log(count), len(start))).astype(np.intp)
    far = np.stack([start, start + gap], axis=1)[start + gap < count]
    pairs = np.concatenate([pairs, far])
    apart = np.hypot(*(poses_world[pairs[:, 0], :2] - poses_world[pairs[:, 1], :2]).T)
    _, first = np.unique(pairs, axis=0, return_index=True)
    kept = pairs[np.sort(first)]
    kept = kept[apart[np.sort(first)] <= NEAR_M][: PAIRS_A_POSE * count]
    order = np.lexsort((kept[:, 1], kept[:, 0]))
    return kept[order, 0], kept[order, 1]
