"""Does the cost of a sweep stay linear in the beams, or in the incidences?"""

from collections.abc import Iterator, Sequence

import numpy as np

import bayesmap as bm
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.fit import initial_sensor
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import trace_stops
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import WallGibbs
from bayesmap.sim.drawing import TUTORIAL_GRID
from benchmarks.figure import Figure, derived, timed
from benchmarks.suites.tutorial import SENSOR, sweep_time, sweeps_of

BEAMS = (100, 200, 400, 800, 1600)

SCANS, SCAN_BEAMS = (25, 50, 100, 200, 400), 180
SETTLING = 20


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """Exponents of power laws fitted to the times of sweeps."""
    yield from walls_of_the_tutorial(device)
    yield from surfaces_of_a_building(device)


def walls_of_the_tutorial(device: str) -> Iterator[Figure]:
    """Binary walls of the tutorial's map, seen by 100 to 1600 beams."""
    walls, pose = bm.worlds.tutorial()
    figures = []
    for beams in BEAMS:
        angles = np.arange(beams) / beams * 2 * np.pi
        scans = bm.simulate(walls, TUTORIAL_GRID, pose, angles, sensor=SENSOR, max_range_m=42.0, seed=0)
        table = trace(scans, TUTORIAL_GRID, SENSOR)
        problem = WallProblem(table, bm.Independent(0.5), scans.poses, device)
        work = sweeps_of(WallGibbs("radial", "zeros"), problem, 2_000_000 // beams)
        figure = sweep_time(f"scaling/{beams}_beams", work)
        figures.append(figure)
        yield figure
    against = "sweep time ~ beams^exponent, 100 to 1600 beams"
    yield derived("scaling/exponent", figures, lambda times: exponent(BEAMS, times), against=against)


def surfaces_of_a_building(device: str) -> Iterator[Figure]:
    """Surfaces of a simulated building at 10 cm, seen by 25 to 400 scans of one patrol."""
    world = bm.worlds.building(seed=1, size_m=(30.0, 20.0), resolution=0.1)
    poses = bm.worlds.patrol(world, max(SCANS), seed=1)
    angles = np.arange(SCAN_BEAMS) / SCAN_BEAMS * 2 * np.pi
    sensor, prior = initial_sensor(bm.Surface(), world.grid.resolution), bm.Surface()
    everything = bm.simulate(
        world.walls, world.grid, poses, angles, sensor=sensor, max_range_m=20.0, seed=1, opacity=world.opacity
    )
    incidences, figures = [], []
    for scans in SCANS:
        some = everything.select(slice(None, None, max(SCANS) // scans))
        problem = trace_stops(some, world.grid, prior, sensor, device=device)
        # A whole round of the cells that are updated seldom, or several.
        work = sweeps_of(StopGibbs(), problem, 16 * max(1, 100 // scans), settling=SETTLING)
        against = f"{problem.rays.n_incidences:,} incidences"
        name = f"scaling/surface_{len(some) * SCAN_BEAMS}_beams"
        figure = timed(name, work, unit="ms/sweep", scale=1e3, repeats=5, against=against)
        incidences.append(problem.rays.n_incidences)
        figures.append(figure)
        yield figure
    against = "sweep time ~ incidences^exponent, surfaces"
    yield derived("scaling/surface_exponent", figures, lambda times: exponent(incidences, times), against=against)


def exponent(sizes: Sequence[float], times: Sequence[float]) -> float:
    """Of the power law fitted to times by least squares of their logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])
