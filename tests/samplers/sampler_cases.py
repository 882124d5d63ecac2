"""The problems on which all samplers are tried, and how to draw with them."""

from dataclasses import replace
from functools import cache
from itertools import product
from typing import NamedTuple

import numpy as np
from oracle.enumeration import all_maps, block_sites, single_sites
from oracle.worlds import make_case

import bayesmap as bm
from bayesmap.model import Model
from bayesmap.run.runner import Job, run_chains
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import WallBlocks, WallGibbs

ORDERS = ("raster", "radial", "random")
SAMPLERS = {"gibbs": (WallGibbs, single_sites), "block": (WallBlocks, block_sites)}
BOTH = [(method, order) for method in SAMPLERS for order in ORDERS]

PRIORS = (0.05, 0.3, 0.5, "cells")
NOISES = (0.1, 0.5, 2.0)
SHAPES = ((4, 4), (3, 4), (4, 2), (1, 6), (4, 4), (5, 1), (2, 2), (4, 4))
LATTICE = 8
"""Beams a pose where they go along lines and through corners: a beam touches three cells at once, and ties are many."""


class World(NamedTuple):
    """A little problem: prior wall probability, noise, and whether it is robust; beams of each pose; coupling."""

    prior: float | str
    noise: float
    robust: bool
    shape: tuple
    poses: int
    beams: int
    coupling: float = 0.0

    @property
    def name(self):
        kind, coupled = "mixture" if self.robust else "gaussian", f"-coupling{self.coupling}" if self.coupling else ""
        size = "x".join(map(str, self.shape))
        return f"{kind}-noise{self.noise}-prior{self.prior}{coupled}-{size}-{self.poses}poses-{self.beams}beams"


# Every prior with every noise, Gaussian and robust; shapes and numbers of poses take turns.
APART = [
    World(prior, noise, robust, SHAPES[(5 * i + 3 * j + k) % len(SHAPES)], 1 + (i + j + k) % 3, 9)
    for i, prior in enumerate(PRIORS)
    for j, noise in enumerate(NOISES)
    for k, robust in enumerate((False, True))
]
# Many beams a cell: what samplers do to save work there (bounds, kept sums) is tried too.
APART += [World(*case, (4, 4), 2, 70) for case in product((0.3, "cells"), (0.1, 0.4), (False, True))]
APART += [World(0.3, 0.1, False, (4, 4), 3, LATTICE), World(0.5, 0.5, True, (4, 4), 3, LATTICE)]
APART += [World("cells", 0.3, False, (3, 4), 2, LATTICE), World(0.2, 0.2, False, (2, 5), 3, LATTICE)]
# Weak and strong couplings, rare walls, large noise, narrow grids, fixed cells, poses on grid lines.
COUPLED = [
    World(0.5, 0.5, False, (4, 4), 1, 9, 0.3), World(0.5, 2.0, True, (4, 4), 2, 9, 1.2),
    World(0.3, 0.5, True, (3, 4), 3, 9, 0.8), World(0.05, 0.5, False, (4, 4), 2, 9, 0.5),
    World(0.05, 2.0, False, (4, 4), 2, 9, 1.0), World(0.2, 0.1, False, (4, 3), 3, 70, 0.7),
    World(0.2, 0.5, True, (2, 5), 2, 9, 2.5), World("cells", 0.3, False, (4, 4), 2, 9, 0.6),
    World("cells", 1.0, True, (3, 4), 3, LATTICE, 1.5), World(0.4, 0.5, False, (1, 6), 1, 9, 0.9),
    World(0.4, 0.5, True, (6, 1), 2, 9, 0.9), World(0.3, 0.5, False, (2, 2), 2, 9, 0.8),
]  # fmt: skip
WORLDS = APART + COUPLED
NAMES = [world.name for world in WORLDS]


@cache
def case_of(world):
    sensor = bm.BeamMixture(bm.Gaussian(world.noise)) if world.robust else bm.Gaussian(world.noise)
    seed = [COUPLED.index(world), 1925] if world.coupling else [APART.index(world), 77]
    return make_case(
        seed, shape=world.shape, n_poses=world.poses, prior=world.prior, sensor=sensor, beams_per_pose=world.beams,
        lattice=world.beams == LATTICE, coupling=world.coupling,
    )  # fmt: skip


def first(**wanted):
    return next(world for world in WORLDS if all(getattr(world, name) == value for name, value in wanted.items()))


def draw_maps(rng, p, n, count):
    """Independent draws from a law over all maps of n cells, (count, n)."""
    return all_maps(n)[rng.choice(len(p), count, p=p)]


def run_sweeps(problem, method, order, starts, sweeps, seed, threads=None, beta=1.0):
    """Return the maps of chains after sweeps from given maps (chains, n) at an inverse temperature, (chains, n)."""
    problem = replace(problem, threads=threads)
    starts = np.asarray(starts).reshape(-1, *problem.grid.shape)
    sampler = SAMPLERS[method][0](order, starts)
    state, _ = sampler.step(sampler.init(problem, range(len(starts)), seed), sweeps, beta)
    return state.walls() != 0


def chains_of(problem, method, order, chains=5, seed=3, schedule=None, start="prior", **options):
    sampler = SAMPLERS[method][0](order, start)
    return run_chains(Job(model_of(problem), sampler, schedule, seed, tuple(range(chains)), problem=problem), **options)


def model_of(problem):
    """A model of which a problem has the table; its scans and its sensor are not looked at."""
    nothing = bm.Scans(problem.poses, [0.0], np.full((len(problem.poses), 1), np.nan), max_range_m=1.0)
    return Model(nothing, problem.grid, problem.prior, bm.Gaussian(1.0))


def problem_of(case, *, table=None, prior=None):
    """The case's problem, with another table or prior if given: for samplers that are wrong on purpose."""
    right = case.problem()
    return WallProblem(table=table or right.table, prior=prior or right.prior, poses=right.poses)
