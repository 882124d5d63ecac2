"""Many chains at once: chain-sweeps a second of the tutorial, and of a real building's walls and surfaces.

A GPU gives each chain a thread of its own, so that its speed is that of thousands of chains; one chain on it is slow.
"""

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import warp as wp

import bayesmap as bm
from bayesmap.cells.kinds import HIT_DEPTH, P_WALL, default_sensor
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.fit import initial_sensor
from bayesmap.samplers.sampler import Sampler
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import trace_stops
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import WallBlocks, WallGibbs
from benchmarks.figure import Figure, rate
from benchmarks.suites.building import LOG, MAX_RANGE_M, RESOLUTION_M
from benchmarks.suites.tutorial import problem

ON_CPU, ON_GPU = (1, 64), (1, 4096, 65_536)
BUILDING_ON_CPU, BUILDING_ON_GPU = (1, 4), (1, 256, 1024)
REPEAT_S = 1.0
"""About how long a repeat lasts."""


def chain_sweeps(name: str, sampler: Sampler[Any, Any], of: Any, chains: int, settling: int) -> Figure:
    """Measure chain-sweeps a second of settled chains."""
    state, _ = sampler.step(sampler.init(replace(of, threads=None), range(chains), seed=0), settling)
    states = [state]

    def sweep(times: int) -> float:
        states[0], _ = sampler.step(states[0], times)
        wp.synchronize()
        return float(times * chains)

    sweep(1)
    began = time.perf_counter()
    sweep(2)
    each_s = (time.perf_counter() - began) / 2
    times = max(1, min(10_000, round(REPEAT_S / each_s)))
    return rate(name, lambda: sweep(times), unit="sweeps/s", repeats=3)


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """All figures of the suite; the building's need the recording."""
    for chains in ON_CPU if device == "cpu" else ON_GPU:
        gibbs = WallGibbs("radial", "zeros")
        yield chain_sweeps(f"chains/tutorial_gibbs_{chains}", gibbs, problem(0.5, device), chains, 20)
        block = WallBlocks("raster", "zeros")
        yield chain_sweeps(f"chains/tutorial_block_{chains}", block, problem(0.05, device), chains, 20)
    if not LOG.exists():
        print(f"skipped: chains/building: {LOG} is not there (set BAYESMAP_DATA)", flush=True)
        return
    scans, _ = bm.read_log(LOG).limited(MAX_RANGE_M).holdout(10)
    grid = bm.Grid.covering(scans, RESOLUTION_M)
    table = trace(scans, grid, default_sensor(RESOLUTION_M), hit_depth=HIT_DEPTH, device=device)
    walls = WallProblem(table, bm.Independent(P_WALL), scans.poses, device)
    sensor, surface = initial_sensor(bm.Surface(), RESOLUTION_M), bm.Surface()
    stops = trace_stops(scans, grid, surface, sensor, device=device)
    for chains in BUILDING_ON_CPU if device == "cpu" else BUILDING_ON_GPU:
        yield chain_sweeps(f"chains/building_gibbs_{chains}", WallGibbs("radial", "propagate"), walls, chains, 3)
        if chains <= BUILDING_ON_CPU[-1] or chains == BUILDING_ON_GPU[1]:
            yield chain_sweeps(f"chains/building_surfaces_{chains}", StopGibbs(0), stops, chains, 3)
