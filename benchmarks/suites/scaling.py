"""Does the cost of a sweep stay linear in the beams?"""

from collections.abc import Iterator

import numpy as np

import bayesmap as bm
from bayesmap.inference.gibbs import Gibbs
from bayesmap.inference.problem import Problem
from bayesmap.kernels.trace import trace
from bayesmap.world.tutorial import TUTORIAL_GRID
from benchmarks.figure import Figure
from benchmarks.suites.tutorial import SENSOR, sweep_time

BEAMS = (100, 200, 400, 800, 1600)


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """The tutorial's map with 100 to 1600 beams: the exponent of a power law fitted to the sweep times."""
    walls, pose = bm.worlds.tutorial()
    times = []
    for beams in BEAMS:
        angles = np.arange(beams) / beams * 2 * np.pi
        scans = bm.simulate(walls, TUTORIAL_GRID, pose, angles, sensor=SENSOR, max_range_m=42.0, seed=0)
        table = trace(scans, TUTORIAL_GRID, SENSOR)
        sampler = Gibbs(Problem(table, bm.Independent(0.5), scans.poses, device), "radial")
        figure = sweep_time(f"scaling/{beams}_beams", sampler, 2_000_000 // beams)
        times.append(figure.value)
        yield figure
    exponent = float(np.polyfit(np.log(BEAMS), np.log(times), 1)[0])
    yield Figure("scaling/exponent", exponent, "", against="sweep time ~ beams^exponent, 100 to 1600 beams")
