"""The problems on which all samplers are tried, and how to draw with them."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from oracle.enumeration import all_maps
from oracle.transitions import block_sites, single_sites
from oracle.worlds import make_case
from tiers import latin

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

# Every prior with every noise, Gaussian and robust; shapes and numbers of poses take turns.
WORLDS = [
    (prior, noise, robust, SHAPES[(5 * i + 3 * j + k) % len(SHAPES)], 1 + (i + j + k) % 3, 9)
    for i, prior in enumerate(PRIORS)
    for j, noise in enumerate(NOISES)
    for k, robust in enumerate((False, True))
]
# Many beams a cell: what samplers do to save work there (bounds, kept sums) is tried too.
WORLDS += [
    (prior, noise, robust, (4, 4), 2, 70)
    for prior in (0.3, "cells")
    for noise in (0.1, 0.4)
    for robust in (False, True)
]
# Beams along lines and through corners, 8 a pose: there a beam touches three cells at once, and ties are many.
LATTICE = 8
WORLDS += [(prior, noise, robust, (4, 4), 3, LATTICE) for prior, noise, robust in ((0.3, 0.1, False), (0.5, 0.5, True))]
WORLDS += [("cells", 0.3, False, (3, 4), 2, LATTICE), (0.2, 0.2, False, (2, 5), 3, LATTICE)]
NAMES = [
    f"{'mixture' if robust else 'gaussian'}-noise{noise}-prior{prior}-{shape[0]}x{shape[1]}-{poses}poses-{beams}beams"
    for prior, noise, robust, shape, poses, beams in WORLDS
]


def matrix(worlds, orders=ORDERS, names=NAMES):
    """Parametrise a test over numbers of worlds, methods and orders; the landing run takes each world with each method
    in one order, and so each method and order with one world in three (in two, where there are two orders).
    """
    cases = latin(len(orders), worlds, list(SAMPLERS), orders)
    ids = [f"{names[number]}-{method}-{order}" for number, method, order in (case.values for case in cases)]
    return pytest.mark.parametrize(("number", "method", "order"), cases, ids=ids)


@cache
def world(number):
    prior, noise, robust, shape, poses, beams = WORLDS[number]
    sensor = bm.BeamMixture(bm.Gaussian(noise)) if robust else bm.Gaussian(noise)
    return make_case(
        [number, 77],
        shape=shape,
        n_poses=poses,
        prior=prior,
        sensor=sensor,
        beams_per_pose=beams,
        lattice=beams == LATTICE,
    )


def draw_maps(rng, p, n, count):
    """Independent draws from a law over all maps of n cells, (count, n)."""
    return all_maps(n)[rng.choice(len(p), count, p=p)]


def run_sweeps(problem, method, order, starts, sweeps, seed, threads=None, beta=1.0):
    """Where chains from the given maps (chains, n) stand after some sweeps at an inverse temperature, (chains, n)."""
    problem = replace(problem, threads=threads)
    starts = np.asarray(starts).reshape(-1, *problem.grid.shape)
    sampler = SAMPLERS[method][0](order, starts)
    state, _ = sampler.step(sampler.init(problem, range(len(starts)), seed), sweeps, beta)
    return state.walls() != 0


def chains_of(problem, method, order, chains=5, seed=3, schedule=None, start="prior", **options):
    """The runner's chains of a sampler."""
    job = Job(
        model_of(problem), SAMPLERS[method][0](order, start), schedule, seed, tuple(range(chains)), problem=problem
    )
    return run_chains(job, **options)


def model_of(problem):
    """A model of which a problem has the table; its scans and its sensor are not looked at."""
    nothing = bm.Scans(problem.poses, [0.0], np.full((len(problem.poses), 1), np.nan), max_range_m=1.0)
    return Model(nothing, problem.grid, problem.prior, bm.Gaussian(1.0))


def problem_of(case, *, table=None, prior=None):
    """The case's problem, with another table or prior if given: for samplers that are wrong on purpose."""
    right = case.problem()
    return WallProblem(table=table or right.table, prior=prior or right.prior, poses=right.poses)
