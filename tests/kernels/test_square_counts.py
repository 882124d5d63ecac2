"""Where beams are stopped: counts by squares follow their exact law, whichever cell a surface belongs to.

Many copies of one little world in a known state, swept once, are independent draws of its stops. False alarms: `ALPHA`
= 1e-4 over this module.
"""

import numpy as np
import pytest
import scipy
from oracle.stop_law import joint, paths_of, reading_law, stops
from oracle.stop_worlds import centres_of, copies
from oracle.verdict import ALPHA

import bayesmap as bm

GRID = bm.Grid((8, 2), 0.25)
SENSOR = bm.BeamMixture(bm.Gaussian(0.04, 0.01), p_random=0.2, p_no_return=0.1, p_short=0.1, rate_short_per_m=0.6)
PRIOR = bm.Surface(1.0, 2.0, dof=5.0)
COPIES, TESTS = 6000, 200
LIMIT = -scipy.special.ndtri(ALPHA / TESTS / 2)
READINGS = [0.5, 1.1, 1.75, 1.9, np.inf, -np.inf]
SCANS = bm.Scans(
    [-0.1, 0.22, 0.03], np.linspace(-0.08, 0.08, len(READINGS)), [READINGS], max_range_m=2.2, min_range_m=0.05
)


def swept(states_of_world, count=COPIES, scans=SCANS, sensor=SENSOR):
    """Copies of a world in one state (cells, 6), surfaces from the cells' centres; the squares of one sweep's stops."""
    worlds = copies(scans, GRID, PRIOR, sensor, count)
    states = np.zeros((len(worlds.problem.rays.touched), 6))
    states[worlds.cells()] = states_of_world
    states[:, 1:3] += centres_of(worlds.problem.rays)[0]
    sampler = worlds.sampler(5, states)
    sampler.sweep()
    found = sampler.state.chains.in_squares(0, 0, kept=False)
    return worlds, states.astype(np.float32).astype(float), found


def one_world(seed=1):
    """Reflectivities of many sizes, and surfaces anywhere, also outside their own squares."""
    rng = np.random.default_rng(seed)
    cells = GRID.n_cells
    state = np.zeros((cells, 6))
    state[:, 0] = rng.choice([0.02, 0.15, 0.4, 0.8], cells)
    state[:, 1:3] = rng.normal(0, 0.12, (cells, 2))
    state[:, 3], state[:, 5] = rng.uniform(0.02, 0.09, (2, cells))
    state[:, 4] = rng.normal(0, 0.05, cells)
    return state


def law_of_points(worlds, states, given_reading=True):
    """Of each beam of one copy: the chance that the point of its stop lies in the square of each of its entries.

    Returns (B, K), and the chance that the beam passes each, (B, K).
    """
    rays, paths = worlds.problem.rays, paths_of(worlds.problem.rays)
    enter, leave = rays.stretches()
    beams = len(READINGS)
    _, distance, variance = stops(paths, states, False)
    chances = joint(paths, states, SENSOR, False)
    chances /= chances.sum(axis=-1, keepdims=True)
    inside, passed = (np.zeros((beams, paths.cell.shape[1])) for _ in range(2))
    for b in range(beams):
        n, first, z = paths.there[b].sum(), rays.offsets[b], rays.range_m[b]
        edges = np.concatenate([[-np.inf], enter[first + 1 : first + n], [leave[first + n - 1]], [np.inf]])
        for k in range(n):
            t, v = distance[b, k], variance[b, k]
            echo, post, post_v = 0.0, t, v
            if np.isfinite(z) and given_reading:
                known, rate = 1 - SENSOR.p_random, SENSOR.rate_short_per_m
                other = SENSOR.p_random / (paths.limits.max_m - paths.limits.min_m)
                other += known * SENSOR.p_short * rate * np.exp(-rate * z) * (z < min(t, paths.limits.max_m))
                echo = 1 - other / reading_law(z, t, v, SENSOR, paths.limits)
                noise = (SENSOR.noise.sigma_m + SENSOR.noise.sigma_per_m * t) ** 2
                post, post_v = t + v / (v + noise) * (z - t), v * noise / (v + noise)
            below = echo * scipy.stats.norm.cdf(edges, post, np.sqrt(post_v))
            below = below + (1 - echo) * scipy.stats.norm.cdf(edges, t, np.sqrt(v))
            inside[b, :n] += chances[b, k] * np.diff(below)[:n]
            passed[b, :n] += chances[b, k] * (1 - below[1 : n + 1])
        passed[b, :n] += chances[b, -1]
    return inside, passed


def z_of(worlds, counts, law):
    """How far each square's mean count over the copies lies from the law's, in its standard errors."""
    paths = paths_of(worlds.problem.rays)
    cells = worlds.cells()
    numbers = {int(cell): i for i, cell in enumerate(cells[0])}
    mean, variance = (np.zeros(GRID.n_cells) for _ in range(2))
    for b, row in enumerate(law):
        for k in np.flatnonzero(paths.there[b]):
            mean[numbers[int(paths.cell[b, k])]] += row[k]
            variance[numbers[int(paths.cell[b, k])]] += row[k] * (1 - row[k])
    some = variance > 1e-3
    off = counts[cells].mean(axis=0) - mean
    assert abs(off[~some]).max(initial=0) < 5e-3
    return off[some] / np.sqrt(variance[some] / len(cells))


def test_beams_are_counted_where_their_points_lie():
    worlds, states, found = swept(one_world())
    inside, passed = law_of_points(worlds, states)
    assert abs(z_of(worlds, found.stopped, inside)).max() < LIMIT
    assert abs(z_of(worlds, found.passed, passed)).max() < LIMIT
    # the twin: points that know nothing of the reading
    inside, passed = law_of_points(worlds, states, given_reading=False)
    assert abs(z_of(worlds, found.stopped, inside)).max() > LIMIT
    assert abs(z_of(worlds, found.passed, passed)).max() > LIMIT


def test_the_chance_is_a_beta_of_the_counts():
    _, _, found = swept(one_world())
    a, b = PRIOR.a + found.stopped, PRIOR.b + found.passed
    np.testing.assert_allclose(found.expected, a / (a + b), rtol=1e-5)
    assert scipy.stats.kstest(scipy.stats.beta.cdf(found.drawn, a, b), "uniform").pvalue > ALPHA / TESTS
    twin = scipy.stats.beta.cdf(found.drawn, a, b + 0.3)
    assert scipy.stats.kstest(twin, "uniform").pvalue < ALPHA / TESTS


@pytest.mark.parametrize("owner", [4, 5])
def test_which_cell_a_surface_belongs_to_makes_no_difference(owner):
    """One wall across the first row, just behind the edge between two of its cells, in the one cell or in the other."""
    law = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01, p_short=0.01)
    scans = bm.Scans([-0.1, 0.125, 0.0], np.linspace(-0.02, 0.02, 6), np.full((1, 6), 1.37), max_range_m=2.2)
    world = np.zeros((GRID.n_cells, 6))
    world[:, 0], world[:, 3], world[:, 5] = 1e-7, 0.05, 0.05
    wall_x = 1.265  # the edge is at 1.25, the square behind it is that of column 5
    cell = 2 * owner
    world[cell] = 0.999, wall_x - (owner + 0.5) * 0.25, 0.0, 0.004, 0.0, 0.12
    worlds, _, found = swept(world, 200, scans, law)
    columns = np.arange(GRID.n_cells) // 2
    stopped = found.stopped[worlds.cells()].reshape(200, -1)
    share = [stopped[:, columns == column].sum() / stopped.sum() for column in range(8)]
    assert share[5] > 0.98
    assert found.passed[worlds.cells()][:, columns == 4].sum() > 0.98 * 6 * 200
