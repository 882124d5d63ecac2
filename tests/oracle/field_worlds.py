"""Little worlds whose cells stop some beams, many side by side: one sweep moves them all, and each is a chain.

A world is a small grid; world w stands at block (w % side, w // side) of one large grid. No beam leaves its world.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from oracle.field_law import draw_readings, draw_states, paths_of

import bayesmap as bm
from bayesmap.inference.field_gibbs import FieldGibbs, FieldProblem, build_field


def side_by_side(rays, worlds):
    """Rays of ``worlds`` times as many scans on a small grid, as rays on one large grid with a block for each world."""
    nx, ny = rays.grid.shape
    side = math.ceil(math.sqrt(worlds))
    world_of_beam = np.arange(rays.n_beams) // (rays.n_beams // worlds)
    block = np.stack([world_of_beam % side * nx, world_of_beam // side * ny], axis=-1)
    flat = rays.touched[rays.cells]
    corner = np.repeat(block, np.diff(rays.offsets), axis=0)
    cells = (flat // ny + corner[:, 0]) * (ny * side) + flat % ny + corner[:, 1]
    grid = bm.Grid((nx * side, ny * side), rays.grid.resolution)
    return replace(
        rays,
        grid=grid,
        touched=np.arange(grid.n_cells, dtype=np.int32),
        cells=cells.astype(np.int32),
        start_m=(rays.start_m + block * rays.grid.resolution).astype(np.float32),
    )


@dataclass(frozen=True, eq=False)
class Worlds:
    """``count`` worlds side by side, as a problem for the package."""

    problem: FieldProblem
    shape: tuple
    count: int

    def cells(self):
        """Numbers of the cells of each world, (count, nx * ny)."""
        nx, ny = self.shape
        side = self.problem.rays.grid.shape[0] // nx
        w = np.arange(self.count)[:, None]
        i = np.arange(nx * ny)
        return (i // ny + w % side * nx) * (ny * side) + i % ny + w // side * ny

    def split(self, states):
        """States (T, 6) of all cells as (count, nx * ny, 6), surfaces in the world's own coordinates, in edges."""
        edge = self.problem.rays.grid.resolution
        cells = self.cells()
        out = np.asarray(states, dtype=float)[cells]
        corner = np.array(self.shape) * edge
        side = self.problem.rays.grid.shape[0] // self.shape[0]
        w = np.arange(self.count)
        out[..., 1:3] -= (np.stack([w % side, w // side], axis=-1) * corner)[:, None]
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
