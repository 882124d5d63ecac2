"""Little worlds whose cells stop some beams, many side by side: one sweep moves them all, and each is a chain.

A world is a small grid; world w stands at block (w % side, w // side) of one large grid.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from oracle.field_law import draw_readings, draw_states, paths_of

import bayesmap as bm
from bayesmap.beams.beam_rays import BeamRays
from bayesmap.beams.rays import around_readings
from bayesmap.kernels.rays import trace_rays
from bayesmap.samplers.field_gibbs import FieldGibbs, FieldProblem, build_field


def beam_rays(scans, grid, *, margin_m=np.inf, hit_depth=0.5, whole=False):
    """Rays as chains keep them, cut and marked about the readings, or whole."""
    reach_m, near_m = around_readings(scans, margin_m, grid.resolution)
    rays = trace_rays(scans, grid, reach_m=None if whole else reach_m, near_m=near_m)
    return BeamRays.of(rays, rays.distance_m(hit_depth))


def corners(shape, worlds, gap):
    """Lower left cell of each world on the large grid, (worlds, 2), and that grid's shape."""
    side = math.ceil(math.sqrt(worlds))
    w = np.arange(worlds)
    pitch = np.array(shape) + gap
    return np.stack([w % side, w // side], axis=-1) * pitch, tuple((side * pitch).tolist())


def side_by_side(rays, worlds):
    """Rays of ``worlds`` times as many scans on a small grid, as rays on one large grid with a block for each world.

    Blocks lie so far apart that no reading ends in another's.
    """
    nx, ny = rays.grid.shape
    corner, shape = corners((nx, ny), worlds, math.ceil(rays.limits.max_m / rays.grid.resolution) + 1)
    x, y = corner[:, :1] + np.arange(nx * ny) // ny, corner[:, 1:] + np.arange(nx * ny) % ny
    touched = np.sort((x * shape[1] + y).ravel())
    world = np.arange(rays.n_beams) // (rays.n_beams // worlds)
    entry_world = np.repeat(world, np.diff(rays.offsets))
    flat = rays.touched[rays.cells]
    return replace(
        rays,
        grid=bm.Grid(shape, rays.grid.resolution),
        touched=touched.astype(np.int32),
        cells=np.searchsorted(touched, (x * shape[1] + y)[entry_world, flat]).astype(np.int32),
        start_m=(rays.start_m + corner[world] * rays.grid.resolution).astype(np.float32),
    )


@dataclass(frozen=True, eq=False)
class Worlds:
    """``count`` worlds side by side, as a problem for the package."""

    problem: FieldProblem
    shape: tuple
    count: int

    def corners(self):
        rays = self.problem.rays
        return corners(self.shape, self.count, math.ceil(rays.limits.max_m / rays.grid.resolution) + 1)[0]

    def cells(self):
        """Numbers of the cells of each world, (count, nx * ny)."""
        nx, ny = self.shape
        corner, i = self.corners(), np.arange(nx * ny)
        flat = (corner[:, :1] + i // ny) * self.problem.rays.grid.shape[1] + corner[:, 1:] + i % ny
        return np.searchsorted(self.problem.rays.touched, flat)

    def split(self, states):
        """States (T, 6) of all cells as (count, nx * ny, 6), surfaces in the world's own coordinates, in edges."""
        edge = self.problem.rays.grid.resolution
        out = np.asarray(states, dtype=float)[self.cells()]
        out[..., 1:3] -= self.corners()[:, None] * edge
        out[..., 1:] /= edge
        return out

    def sampler(self, seed, states=None, threads=1):
        """One chain over all worlds, from the states (T, 6) or from the package's own start."""
        return FieldGibbs(
            self.problem, 1, seed, threads=threads, states=None if states is None else states[None].astype(np.float32)
        )

    def sweep(self, sampler, first, count):
        """Some sweeps with nothing fitted; where the chain then stands, (T, 6)."""
        for number in range(first, first + count):
            sampler.sweep(number, self.problem.sensor, self.problem.prior)
        return sampler.states()[0]


def build_worlds(scans, grid, prior, sensor, worlds, hit_depth=0.5):
    """The problem of ``worlds`` worlds: the scans of world w are the w-th part of ``scans``."""
    problem = build_field(scans, grid, prior, sensor, hit_depth=hit_depth)
    return Worlds(replace(problem, rays=side_by_side(problem.rays, worlds)), grid.shape, worlds)


def copies(scans, grid, prior, sensor, count, hit_depth=0.5):
    """The same world many times: a sweep of it makes independent draws."""
    many = replace(scans, poses=np.tile(scans.poses, (count, 1)), ranges_m=np.tile(scans.ranges_m, (count, 1)))
    return build_worlds(many, grid, prior, sensor, count, hit_depth)


def centres_of(rays):
    """Centres of the touched cells, and their edge, as the oracle takes them."""
    return rays.centres_m(), rays.grid.resolution


def draw_worlds(seed, grid, prior, sensor, worlds, *, poses=2, beams=5, limits=(0.1, 3.0), invalid=0.03):
    """Worlds with cells from the prior, poses about the cells that look at them, and readings from the
    oracle: (worlds, true states (T, 6)).
    """
    rng = np.random.default_rng(seed)
    size = np.array(grid.shape) * grid.resolution
    xy = np.array(grid.origin) + rng.uniform(-0.4, 1.4, (worlds * poses, 2)) * size
    there = np.array(grid.origin) + rng.uniform(0.2, 0.8, (worlds * poses, 2)) * size - xy
    where = np.column_stack([xy, np.arctan2(there[:, 1], there[:, 0])])
    angles = np.linspace(-0.5, 0.5, beams)
    whole = bm.Scans(where, angles, np.full((len(where), beams), np.inf), max_range_m=limits[1], min_range_m=limits[0])
    plain = isinstance(prior, bm.Beta)
    before = build_worlds(whole, grid, prior, sensor, worlds).problem.rays
    truth = draw_states(rng, prior, centres_of(before))
    readings = draw_readings(rng, paths_of(before), truth, sensor, plain).reshape(whole.ranges_m.shape)
    readings[rng.random(readings.shape) < invalid] = np.nan
    return build_worlds(replace(whole, ranges_m=readings), grid, prior, sensor, worlds), truth


def scans_of_all_kinds(seed, grid, *, poses=5, beams=9, limits=(0.1, 3.0), lattice=False):
    """Readings of every kind from anywhere in and about a grid; on a ``lattice`` from corners and along lines."""
    rng = np.random.default_rng(seed)
    size = np.array(grid.shape) * grid.resolution
    xy = np.array(grid.origin) + rng.uniform(-0.1, 1.1, (poses, 2)) * size
    where = np.column_stack([xy, rng.uniform(-np.pi, np.pi, poses)])
    if lattice:
        half = grid.resolution / 2
        where = np.round(where / [half, half, np.pi / 4]) * [half, half, np.pi / 4]
    readings = rng.uniform(limits[0], 0.6 * limits[1], (poses, beams))
    readings.ravel()[rng.choice(readings.size, 6, replace=False)] = [np.inf, np.inf, -np.inf, -np.inf, np.nan, np.nan]
    angles = np.arange(beams) * (np.pi / 4 if lattice else 0.7)
    return bm.Scans(where, angles, readings, max_range_m=limits[1], min_range_m=limits[0])
