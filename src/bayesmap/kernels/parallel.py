"""Launching one kernel over many beams on all cores.

Warp runs a CPU launch on the calling thread and releases the GIL, so a launch is split into slices, one a
thread. Kernels launched here take the index of their first element as their first argument and write only to
their own elements, so the result does not depend on how many threads there are.
"""

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any

import warp as wp

from bayesmap.kernels.device import load_kernels

FEW_BEAMS = 1_000
"""Fewer beams than this are traced before a second thread has begun: to start one takes 0.2 ms."""


def available_cores() -> int:
    """Cores that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # macOS
        return os.cpu_count() or 1


def threads_for(beams: int) -> int | None:
    """Threads for a kernel that follows each of so many beams through the grid: one, or as many as there are cores."""
    return 1 if beams < FEW_BEAMS else None


@cache
def thread_pool(threads: int) -> ThreadPoolExecutor:
    """One pool for each width, kept for the life of the process."""
    return ThreadPoolExecutor(threads, thread_name_prefix="bayesmap")


if hasattr(os, "register_at_fork"):  # a forked child has the pools, but none of their threads
    os.register_at_fork(after_in_child=thread_pool.cache_clear)


def launch(
    kernel: Any, size: int, inputs: Sequence[Any], device: str, threads: int | None = None, begin: int = 0
) -> None:
    """Run ``kernel(first, *inputs)`` over ``size`` elements from ``begin`` on: on the CPU in one slice a thread."""
    if size == 0:
        return
    threads = min(threads or available_cores(), size) if device == "cpu" else 1
    if threads == 1:
        wp.launch(kernel, dim=size, inputs=[begin, *inputs], device=device)
        return
    load_kernels(kernel, device)  # once, before the threads would all try
    edges = [begin + size * i // threads for i in range(threads + 1)]

    def run(i: int) -> None:
        wp.launch(kernel, dim=edges[i + 1] - edges[i], inputs=[edges[i], *inputs], device=device)

    list(thread_pool(threads).map(run, range(threads)))
