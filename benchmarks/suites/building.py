"""A real building: the Intel log at 10 cm, from the table to converged chains."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import bayesmap as bm
from bayesmap.cells.kinds import HIT_DEPTH, P_WALL, default_sensor
from bayesmap.kernels.walls.propagate import Beliefs
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import WallGibbs
from benchmarks.figure import Figure, best, timed
from benchmarks.suites.tutorial import sweeps_of

LOG = Path(os.environ.get("BAYESMAP_DATA", "../shared/data")) / "intel-corrected.log.gz"
RESOLUTION_M, MAX_RANGE_M = 0.1, 20.0

WHOLE_RUN = r"""
import re, sys, time
from pathlib import Path
import bayesmap as bm
from bayesmap.cells.kinds import HIT_DEPTH, P_WALL, default_sensor
from bayesmap.posterior.summary import rhat
began = time.perf_counter()
scans, _ = bm.read_log(sys.argv[1]).limited({max_range}).holdout(10)
grid = bm.Grid.covering(scans, {resolution})
arguments = dict(prior=bm.Independent(P_WALL), sensor=default_sensor({resolution}), hit_depth=HIT_DEPTH)
run = bm.infer(scans, grid, schedule=bm.Schedule(chains=4, warmup=20, draws=80), **arguments)
seconds = time.perf_counter() - began
joint, likelihood = rhat(run.log_joint), rhat(run.posterior.log_likelihood)
peak = int(re.search(r"VmHWM:\s+(\d+)", Path("/proc/self/status").read_text())[1]) / 1024
print(f"seconds={{seconds}} rhat={{joint}} rhat_likelihood={{likelihood}} peak_mb={{peak}}")
"""


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """Table, belief propagation and sweeps on one core; then the whole run on all cores, in a process of its own."""
    if not LOG.exists():
        print(f"skipped: building: {LOG} is not there (set BAYESMAP_DATA)", flush=True)
        return
    scans, _ = bm.read_log(LOG).limited(MAX_RANGE_M).holdout(10)
    grid = bm.Grid.covering(scans, RESOLUTION_M)
    sensor = default_sensor(RESOLUTION_M)

    def build() -> WallProblem:
        table = trace(scans, grid, sensor, hit_depth=HIT_DEPTH, device=device)
        return WallProblem(table, bm.Independent(P_WALL), scans.poses, device)

    def table_and_index() -> int:
        _ = build().index
        return 1

    yield timed("building/table", lambda: build() is not None, unit="s", scale=1, repeats=5)
    yield timed("building/table_and_index", table_and_index, unit="s", scale=1, repeats=5)
    problem = build()
    yield Figure("building/incidences", problem.table.n_incidences * 1e-6, "M")
    arrays = [*vars(problem.table).values(), *vars(problem.index).values()]
    memory = sum(array.nbytes for array in arrays if hasattr(array, "nbytes"))
    yield Figure("building/table_bytes", memory / problem.table.n_incidences, "B/incidence")

    beliefs = Beliefs(problem.table, problem.logit, device)

    def one_round() -> int:
        beliefs.round(0.5, threads=1)
        return 1

    yield timed("building/propagation_round", one_round, unit="s", scale=1, repeats=9)

    sweeps = sweeps_of(WallGibbs("radial", "propagate"), problem, 10, settling=10)
    yield timed("building/gibbs_sweep", sweeps, unit="ms/sweep", scale=1e3)
    if device == "cpu":
        yield from whole_run()


def whole_run(repeats: int = 3) -> Iterator[Figure]:
    """Log to 4 chains of 80 draws, with what R-hat says of them."""
    script = WHOLE_RUN.format(max_range=MAX_RANGE_M, resolution=RESOLUTION_M)
    found: dict[str, float] = {}

    def log_to_chains() -> float:
        done = subprocess.run([sys.executable, "-c", script, str(LOG)], capture_output=True, text=True, check=True)
        found.update({name: float(value) for name, value in re.findall(r"(\w+)=(\S+)", done.stdout)})
        return found["seconds"]

    whole = best("building/whole_run", log_to_chains, unit="s", scale=1, repeats=repeats, warm_up=False)
    note = f"R-hat of the log joint {found['rhat']:.3f}, of the log likelihood {found['rhat_likelihood']:.3f}"
    yield replace(whole, against=note)
    yield Figure("building/peak_memory", found["peak_mb"], "MB")
