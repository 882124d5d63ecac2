"""Random little problems: a grid, a prior, a sensor, and scans drawn from the model; a sensor of the user's own."""

from dataclasses import dataclass

import numpy as np
from oracle.enumeration import Exact, all_maps, beams, distances, enumerate_posterior, log_prior_of_all
from oracle.stop_law import gaussian, reading_law

import bayesmap as bm
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.sensors.model import RangeLimits


@dataclass(frozen=True, eq=False)
class Case:
    """A problem for the package, and everything that the oracle says about it."""

    grid: bm.Grid
    scans: bm.Scans
    prior: bm.Independent | bm.Ising
    sensor: bm.SensorModel
    walls: np.ndarray  # from which the scans were drawn
    exact: Exact

    @property
    def n(self):
        return self.grid.n_cells

    def problem(self):
        return WallProblem(table=trace(self.scans, self.grid, self.sensor), prior=self.prior, poses=self.scans.poses)


def scorer(sensor, limits):
    """The oracle's log-likelihood of one reading at an array of distances, for normal noise and for mixtures."""
    low, high = limits
    if isinstance(sensor, bm.Gaussian):
        return lambda z, d: gaussian(np.clip(z, low, high) if np.isinf(z) else z, d, sigma=sensor.sigma_m,
                                     per_m=sensor.sigma_per_m, max_m=high)  # fmt: skip
    return lambda z, d: np.log(reading_law(z, d, 0.0, sensor, RangeLimits(low, high)))


def random_prior(rng, kind, shape):
    """A number, or "cells": a probability for each cell, some of them 0 and 1."""
    if kind != "cells":
        return kind
    p = rng.uniform(0.05, 0.95, shape)
    flat = p.ravel()
    if flat.size > 3:
        flat[rng.choice(flat.size, 3, replace=False)] = [0.0, 1.0, 0.0]
    return p


def make_case(seed, *, shape=(4, 4), n_poses=2, prior=0.3, sensor=None, beams_per_pose=9, lattice=False, coupling=0.0):
    """Draw a map from the prior and scans from the map; the poses stand anywhere, in walls and outside too.

    On a ``lattice`` they stand on corners, lines and in the middle of cells, and look along multiples of 45 degrees.
    """
    rng = np.random.default_rng(seed)
    sensor = bm.Gaussian(0.5) if sensor is None else sensor
    grid = bm.Grid(shape, resolution=0.5, origin=(-1.0, 2.0))
    size = np.array(shape) * grid.resolution
    xy = np.array(grid.origin) + rng.uniform(-0.1, 1.1, (n_poses, 2)) * size
    poses = np.column_stack([xy, rng.uniform(-np.pi, np.pi, n_poses)])
    if lattice:
        poses = np.round(poses / [0.25, 0.25, np.pi / 4]) * [0.25, 0.25, np.pi / 4]  # half cells
    angles = np.linspace(0, 2 * np.pi, beams_per_pose, endpoint=False)
    limits = (0.1, 3.0)
    p_wall = random_prior(rng, prior, shape)
    walls = rng.random(shape) < p_wall
    if coupling:
        walls = all_maps(walls.size)[rng.choice(1 << walls.size, p=np.exp(log_prior_of_all(shape, p_wall, coupling)))]
        walls = walls.reshape(shape)
    starts, directions = beams(poses, angles, grid)
    metres = distances(walls, starts, directions) * grid.resolution
    readings = sensor.sample(rng, metres, RangeLimits(*limits)).reshape(n_poses, -1)
    readings[rng.random(readings.shape) < 0.05] = np.nan
    scans = bm.Scans(poses, angles, readings, max_range_m=limits[1], min_range_m=limits[0])
    exact = enumerate_posterior(scans, grid, p_wall, scorer(sensor, limits), coupling)
    prior = bm.Ising(p_wall, coupling) if coupling else bm.Independent(p_wall)
    return Case(grid, scans, prior, sensor, walls, exact)


class OwnSensor(bm.SensorModel):
    """Another model's law without its formulas for kernels; ``weight`` multiplies its densities, and should be 1."""

    def __init__(self, law, weight=1.0):
        self.law, self.weight = law, weight

    def log_likelihood(self, range_m, distance_m, limits):
        return self.law.log_likelihood(range_m, distance_m, limits) + np.log(self.weight)

    def reach_m(self, range_m, limits):
        return self.law.reach_m(range_m, limits)

    def sample(self, rng, distance_m, limits):
        return self.law.sample(rng, distance_m, limits)
