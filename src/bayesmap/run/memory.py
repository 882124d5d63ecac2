"""Check whether a map fits into this machine's memory: one error at once, before the system kills the process."""

from __future__ import annotations

import os
from pathlib import Path

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid, outlying, why_outlying
from bayesmap.space.scans import Scans

OF_A_CELL = {True: (200, 280), False: (120, 75)}
"""Bytes for each cell of the grid, once and for each chain, of cells with surfaces and without: nine tenths of what was
measured of maps of 2 million cells. Beams and draws come on top."""

GROUP_LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")
"""Where Linux says how much memory a container may take."""


def check_memory(grid: Grid, scans: Scans, surfaces: bool, chains: int) -> None:
    """Refuse a grid whose chains do not fit into memory.

    Args:
        grid: of the map.
        scans: those that it covers.
        surfaces: whether cells have surfaces.
        chains: that run on this machine together.

    Raises:
        BadInput: they take more than the machine has; if single scans lie so far out that it must be their fault, the
            message names the worst of them.
    """
    once, each = OF_A_CELL[surfaces]
    needed, available = grid.n_cells * (once + chains * each), memory_bytes()
    if available is None or needed <= available:
        return
    nx, ny = grid.shape
    wrong = outlying(scans)
    remedy = (
        why_outlying(scans, int(wrong[0]))
        if len(wrong)
        else "use a coarser resolution, or fewer chains, or a smaller map"
    )
    raise BadInput(
        f"grid: {chains} chains of {nx} x {ny} cells take at least {needed / 1e9:.0f} GB of memory, and there are "
        f"{available / 1e9:.0f}: {remedy}"
    )


def memory_bytes() -> int | None:
    """Return the memory of this machine, or the limit of this container, in bytes; None where unknown."""
    try:
        sizes = [os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")]
    except (AttributeError, OSError, ValueError):
        sizes = []
    for path in GROUP_LIMITS:
        try:
            sizes.append(int(Path(path).read_text()))
        except (OSError, ValueError):
            continue
    return min(sizes, default=None)
