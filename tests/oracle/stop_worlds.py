"""Little worlds whose cells stop some beams, world w at block (w % side, w // side) of one grid; each is a chain."""

import math
from dataclasses import dataclass, replace

import numpy as np
from oracle.stop_law import draw_readings, draw_states, paths_of

import bayesmap as bm
from bayesmap.beams.rays import around_readings
from bayesmap.kernels.rays import trace_rays
from bayesmap.samplers.sampler import Snapshot
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import StopProblem, trace_stops


def beam_rays(scans, grid, *, margin_m=np.inf, whole=False):
    """Rays, cut and marked about the readings, or whole."""
    reach_m, near_m = around_readings(scans, margin_m, grid.resolution)
    return trace_rays(scans, grid, reach_m=None if whole else reach_m, near_m=near_m)


def touching(rays, cells):
    """The rays, counting these cells as touched, whether a beam comes there or not."""
    vars(rays)["touched"] = np.sort(cells).astype(np.int32)
    return rays


def corners(shape, worlds, gap):
    """Lower left cell of each world on the large grid, (worlds, 2), and that grid's shape."""
    side = math.ceil(math.sqrt(worlds))
    w = np.arange(worlds)
    pitch = np.array(shape) + gap
    return np.stack([w % side, w // side], axis=-1) * pitch, tuple((side * pitch).tolist())


def side_by_side(rays, worlds):
    """Rays of ``worlds`` times as many scans, on one grid of blocks so far apart that no reading ends in another's."""
    nx, ny = rays.grid.shape
    corner, shape = corners((nx, ny), worlds, math.ceil(rays.limits.max_m / rays.grid.resolution) + 1)
    x, y = corner[:, :1] + np.arange(nx * ny) // ny, corner[:, 1:] + np.arange(nx * ny) % ny
    flat = x * shape[1] + y
    world = np.arange(rays.n_beams) // (rays.n_beams // worlds)
    many = replace(
        rays,
        grid=bm.Grid(shape, rays.grid.resolution),
        cells=flat[world[rays.beam_of_entry()], rays.cells].astype(np.int32),
        # as kernels read them, so that rounding far from the origin is no difference
        start_m=(rays.start_m + corner[world] * rays.grid.resolution).astype(np.float32).astype(float),
        direction=rays.direction.astype(np.float32).astype(float),
    )
    return touching(many, flat.ravel())


class Chain:
    """One chain, advanced a sweep at a time."""

    def __init__(self, problem, seed, states=None, sweep=0, early_sweeps=0):
        self.sampler = StopGibbs(early_sweeps)
        at = None if states is None else Snapshot(sweep, {"state": states[None].astype(np.float32)})
        self.state = self.sampler.init(problem, [0], seed, at)

    def sweep(self, count=1, beta=1.0):
        """Log-likelihood and log prior before each sweep, (count,) each."""
        self.state, info = self.sampler.step(self.state, count, beta)
        return info.log_likelihood[0], info.log_prior[0]

    def states(self):
        """All touched cells, (T, 6)."""
        return self.sampler.snapshot(self.state).arrays["state"][0]

    def counts(self):
        """Hits and met beams of the touched cells, (T,) each."""
        return tuple(self.sampler.snapshot(self.state).arrays["counts"][0])

    @property
    def arrays(self):
        return self.state.chains._state


@dataclass(frozen=True, eq=False)
class Worlds:
    """``count`` worlds side by side, as a problem for the package."""

    problem: StopProblem
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

    def sampler(self, seed, states=None, sweep=0, early_sweeps=0):
        """One chain over all worlds, from the states (T, 6) or from the package's own start."""
        return Chain(replaced(self.problem, threads=1), seed, states, sweep, early_sweeps)

    def sweep(self, sampler, count, beta=1.0):
        """Some sweeps with nothing fitted; where the chain then stands, (T, 6)."""
        sampler.sweep(count, beta)
        return sampler.states()


def replaced(problem, **changes):
    """The problem with other parts, and the same initial estimate."""
    other = replace(problem, **changes)
    vars(other)["estimate"] = problem.estimate
    return other


def build_worlds(scans, grid, prior, sensor, worlds, hit_depth=0.5):
    """The problem of ``worlds`` worlds: the scans of world w are the w-th part of ``scans``."""
    problem = trace_stops(scans, grid, prior, sensor, hit_depth=hit_depth)
    return Worlds(replace(problem, rays=side_by_side(problem.rays, worlds)), grid.shape, worlds)


def copies(scans, grid, prior, sensor, count, hit_depth=0.5):
    """Copy one world many times: a sweep of the copies makes independent draws."""
    many = replace(scans, poses=np.tile(scans.poses, (count, 1)), ranges_m=np.tile(scans.ranges_m, (count, 1)))
    return build_worlds(many, grid, prior, sensor, count, hit_depth)


def centres_of(rays):
    """Centres of the touched cells, and their edge, as the oracle takes them."""
    return rays.grid.centers_from_corner_m(rays.touched), rays.grid.resolution


def draw_worlds(seed, grid, prior, sensor, worlds, *, poses=2, beams=5, limits=(0.1, 3.0), invalid=0.03):
    """Worlds with cells from the prior, poses about them, and the oracle's readings: (worlds, true states (T, 6))."""
    rng = np.random.default_rng(seed)
    size = np.array(grid.shape) * grid.resolution
    xy = np.array(grid.origin) + rng.uniform(-0.4, 1.4, (worlds * poses, 2)) * size
    there = np.array(grid.origin) + rng.uniform(0.2, 0.8, (worlds * poses, 2)) * size - xy
    where = np.column_stack([xy, np.arctan2(there[:, 1], there[:, 0])])
    angles = np.linspace(-0.5, 0.5, beams)
    whole = bm.Scans(where, angles, np.full((len(where), beams), np.inf), max_range_m=limits[1], min_range_m=limits[0])
    plain = not isinstance(prior, bm.Surface)
    before = build_worlds(whole, grid, prior, sensor, worlds).problem.rays
    truth = draw_states(rng, prior, centres_of(before))
    readings = draw_readings(rng, paths_of(before), truth, sensor, plain).reshape(whole.ranges_m.shape)
    readings[rng.random(readings.shape) < invalid] = np.nan
    return build_worlds(replace(whole, ranges_m=readings), grid, prior, sensor, worlds), truth


def surfaces_of(rng, grid, stop):
    """Surfaces about the centres of all cells with these reflectivities (draws, N); none is thin. (draws, N, 6)."""
    out = np.zeros((*stop.shape, 6), dtype=np.float32)
    out[..., 0] = stop
    out[..., 1:3] = rng.normal(0, 0.2, (*stop.shape, 2)) * grid.resolution
    out[..., 1:3] += grid.centers_from_corner_m(np.arange(grid.n_cells))
    out[..., 3], out[..., 5] = rng.uniform(0.1, 0.4, (2, *stop.shape)) * grid.resolution
    out[..., 4] = rng.normal(0, 0.1, stop.shape) * grid.resolution
    return out


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
