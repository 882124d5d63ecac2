"""Crossings are the beam table's cells and distances, for the whole length of every beam."""

import dataclasses

import numpy as np
import pytest
from oracle.formula import beams, touches

import bayesmap as bm
from bayesmap.kernels.counts import count_hits
from bayesmap.kernels.crossings import trace_crossings
from bayesmap.kernels.trace import trace

GRID = bm.Grid((13, 9), 0.25, (3.0, -1.0))
KINDS = {"anywhere": False, "on lines and corners": True}


def random_scans(seed, *, lattice=False, poses=3, rays=30, grid=GRID):
    """Poses in and around the grid, readings of all kinds."""
    rng = np.random.default_rng(seed)
    size = np.array(grid.shape) * grid.resolution
    xy = np.array(grid.origin) + rng.uniform(-0.2, 1.2, (poses, 2)) * size
    yaw, angles = rng.uniform(-4, 4, poses), rng.uniform(0, 2 * np.pi, rays)
    if lattice:
        xy, yaw, angles = np.round(xy * 8) / 8, np.zeros(poses), np.arange(rays) * np.pi / 12
    readings = rng.uniform(0.1, 4.0, (poses, rays))
    kinds = rng.random(readings.shape)
    readings[kinds < 0.15] = np.inf
    readings[(kinds >= 0.15) & (kinds < 0.2)] = -np.inf
    readings[(kinds >= 0.2) & (kinds < 0.25)] = np.nan
    return bm.Scans(np.column_stack([xy, yaw]), angles, readings, max_range_m=4.0, min_range_m=0.1)


@pytest.mark.parametrize("kind", KINDS)
def test_they_do_not_depend_on_the_readings(kind):
    scans = random_scans(1, lattice=KINDS[kind])
    other = dataclasses.replace(scans, ranges_m=np.where(np.isnan(scans.ranges_m), np.nan, 0.2))
    both = (dataclasses.astuple(trace_crossings(s, GRID))[1:] for s in (scans, other))
    for a, b in zip(*both, strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("kind", KINDS)
def test_cells_and_entries_are_the_oracle_s(kind):
    scans = random_scans(2, lattice=KINDS[kind])
    crossings = trace_crossings(scans, GRID)
    met = touches(*beams(scans.poses, scans.angles_rad, GRID), GRID.shape) * GRID.resolution
    met[np.isnan(scans.ranges_m.ravel())] = np.inf
    for b in range(crossings.n_beams):
        mine = slice(crossings.offsets[b], crossings.offsets[b + 1])
        assert set(crossings.cells[mine].tolist()) == set(np.flatnonzero(met[b] <= scans.max_range_m).tolist())
        np.testing.assert_allclose(crossings.entry_m[mine], met[b, crossings.cells[mine]], atol=1e-5)


def test_distances_are_the_beam_table_s():
    """A table holds likelihoods; those of noise as wide as a metre give the distance back."""
    scans = random_scans(3)
    scans = dataclasses.replace(scans, ranges_m=np.zeros(scans.ranges_m.shape))
    for depth in (0.0, 0.25, 1.0):
        table, crossings = trace(scans, GRID, bm.Gaussian(1.0), hit_depth=depth), trace_crossings(scans, GRID)
        np.testing.assert_array_equal(table.cells, crossings.cells)
        d = np.sqrt(np.maximum(-2 * (table.loglik.astype(float) + 0.5 * np.log(2 * np.pi)), 0.0))
        np.testing.assert_allclose(crossings.distance_m(depth), d, atol=2e-3)


def test_beams_that_left_from_poses_of_their_own_are_traced_from_there():
    scans = random_scans(6, poses=1)
    moving = np.repeat(scans.poses[:, None], scans.n_beams, axis=1)
    moving[0, 1::2] += [0.4, -0.2, 0.3]
    other = dataclasses.replace(scans, poses=moving[0, 1], beam_poses=None)
    found = trace_crossings(dataclasses.replace(scans, beam_poses=moving), GRID)
    both = [trace_crossings(s, GRID) for s in (scans, other)]
    for b in range(scans.n_beams):
        expected = both[b % 2]
        mine, theirs = (slice(c.offsets[b], c.offsets[b + 1]) for c in (found, expected))
        np.testing.assert_array_equal(found.cells[mine], expected.cells[theirs])
        np.testing.assert_array_equal(found.entry_m[mine], expected.entry_m[theirs])


@pytest.mark.parametrize("kind", KINDS)
def test_stretches_follow_one_another_without_gaps(kind):
    crossings = trace_crossings(random_scans(4, lattice=KINDS[kind]), GRID)
    ends = crossings.ends_m()
    for b in range(crossings.n_beams):
        mine = slice(crossings.offsets[b], crossings.offsets[b + 1])
        np.testing.assert_allclose(ends[mine][:-1], crossings.entry_m[mine][1:], atol=1e-6)
        assert (ends[mine] >= crossings.entry_m[mine]).all()


@pytest.mark.parametrize("kind", KINDS)
def test_hits_and_passes_are_those_of_a_slow_count(kind):
    for seed in range(8):
        scans = random_scans(seed, lattice=KINDS[kind])
        met = touches(*beams(scans.poses, scans.angles_rad, GRID), GRID.shape) * GRID.resolution
        crossings = trace_crossings(scans, GRID)
        hits, passes = np.zeros((2, GRID.n_cells), int)
        for b, z in enumerate(scans.ranges_m.ravel()):
            mine = slice(crossings.offsets[b], crossings.offsets[b + 1])
            reach = min(z, scans.max_range_m)
            cells = [c for c in crossings.cells[mine].tolist() if met[b, c] <= reach + 1e-9]
            inside = len(cells) and z <= crossings.ends_m()[mine].max() + 1e-6
            stopped = np.isfinite(z) and inside
            if stopped:
                hits[cells[-1]] += 1
            if not np.isneginf(z) and not np.isnan(z):
                np.add.at(passes, cells[: -1 if stopped else None], 1)
        found = count_hits(scans, GRID)
        np.testing.assert_array_equal(found[0], hits)
        np.testing.assert_array_equal(found[1], passes)
