"""The tutorial's map, 100 beams: sweeps of one chain on one core, and the same work done by the peers."""

from collections.abc import Iterator

import numpy as np

import bayesmap as bm
from bayesmap.kernels.parallel import available_cores
from bayesmap.kernels.trace import trace
from bayesmap.samplers.block import BlockGibbs
from bayesmap.samplers.gibbs import Gibbs
from bayesmap.samplers.importance import sample_importance
from bayesmap.samplers.problem import Problem
from bayesmap.samplers.sampler import WallSampler
from bayesmap.sim.tutorial import TUTORIAL_GRID
from benchmarks.figure import Figure, rate, ratio, timed
from benchmarks.peer_runner import Unavailable, run_peer, tutorial_data

SENSOR = bm.Gaussian(0.2)


def problem(p_wall: float, device: str) -> Problem:
    """The tutorial's problem, on the readings that all systems are given."""
    _, readings = tutorial_data()
    angles = np.arange(len(readings)) / len(readings) * 2 * np.pi
    scans = bm.Scans(poses=[10.0, 10.0, 0.0], angles_rad=angles, ranges_m=readings, max_range_m=42.0)
    return Problem(trace(scans, TUTORIAL_GRID, SENSOR), bm.Independent(p_wall), scans.poses, device)


def sweep_time(name: str, sampler: WallSampler, sweeps: int, chains: int = 1, threads: int = 1) -> Figure:
    """Microseconds of a sweep of one chain, draws not kept."""
    shape = sampler.problem.table.grid.shape
    state = [sampler.init(np.zeros((chains, *shape), dtype=bool), seed=0)]
    state[0], _ = sampler.step(state[0], 500, keep=False, threads=threads)

    def work() -> int:
        state[0], _ = sampler.step(state[0], sweeps, keep=False, threads=threads)
        return sweeps * chains

    return timed(name, work, unit="us/sweep", scale=1e6)


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """All figures of the suite."""
    likely, rare = problem(0.5, device), problem(0.05, device)
    raster = sweep_time("tutorial/gibbs_raster", Gibbs(likely, "raster"), 20_000)
    radial = sweep_time("tutorial/gibbs_radial", Gibbs(likely, "radial"), 20_000)
    yield raster
    yield radial
    yield sweep_time("tutorial/gibbs_random", Gibbs(likely, "random"), 10_000)
    block = sweep_time("tutorial/block_raster", BlockGibbs(rare, "raster"), 2_000)
    yield block

    one = sweep_time("tutorial/8_chains_1_core", Gibbs(likely, "radial"), 10_000, chains=8, threads=1)
    cores = available_cores()
    many = sweep_time("tutorial/8_chains_all_cores", Gibbs(likely, "radial"), 10_000, chains=8, threads=cores)
    yield ratio("tutorial/8_chains_speedup", one.value, many.value, f"{cores} cores against one, same run")

    def particles() -> float:
        return float(len(sample_importance(likely, 50_000, seed=0).log_weights))

    importance = rate("tutorial/importance", particles, unit="maps/s", repeats=5)
    yield importance
    if not with_peers:
        return
    truth = {p.p_wall[0]: p.log_joint(tutorial_data()[0]) for p in (likely, rare)}
    for peer, case, cores, ours in (
        ("genjax", "raster", 1, raster),
        ("genjax", "radial", 1, radial),
        ("genjax", "incremental", 1, raster),
        ("genjax", "block", 1, block),
        ("genjax", "importance", None, importance),
        ("numpyro", "dense", 1, raster),
        ("numpyro", "dense", None, raster),
        ("numpyro", "sparse", 1, raster),
    ):
        result = run_peer(peer, case, repeats=5, cores=cores)
        if isinstance(result, Unavailable):
            print(f"skipped: {result.reason}", flush=True)
            continue
        assert abs(result.log_joint_of_truth - truth[result.prior]) < 0.01, f"{peer} solves another problem"
        ours_s = 10_000 / ours.value if ours is importance else ours.value * 1e-6
        where = "all cores" if cores is None else "1 core"
        against = f"{peer} {case}, {where}: {result.median_s * 1e3:.2f} ms; cpu/wall {result.cpu_per_wall:.2f}"
        yield ratio(f"tutorial/{peer}_{case}_{'all' if cores is None else 1}", result.median_s, ours_s, against)
