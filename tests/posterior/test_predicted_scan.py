"""Quantiles of a scan that nobody took, against the plain definition: cells met by small steps, sums over draws."""

import numpy as np
import pytest
from oracle.stop_law import cross_surface

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.posterior.prediction import CENTRAL_80, Predictor, ScanPredictor, fixed_maps
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((12, 9), 0.5, (-1.0, 2.0))
LIMITS = RangeLimits(0.2, 5.0)
SENSOR = bm.BeamMixture(bm.Gaussian(0.05), 0.02, 0.05, 0.1, 0.4)
DEPTH = 0.5
STEP_M = 1e-4
POSE = (1.3, 4.1, 0.7)
ANGLES = np.linspace(-1.5, 1.4, 9)
RANGES = np.linspace(LIMITS.min_m, LIMITS.max_m, 20_001)
OFF_M = 1e-3
"""Of a quantile: a 30 000th of the span, the step of the plain walk, and that of the ranges."""


def cells_met(angle):
    """Cells on a beam in order, and where it enters and leaves each, by steps of a tenth of a millimetre.

    The cell of the start is met where the beam leaves it.
    """
    t = np.arange(0.0, LIMITS.max_m, STEP_M)
    heading = POSE[2] + angle
    u = (POSE[0] - GRID.origin[0] + t * np.cos(heading)) / GRID.resolution
    v = (POSE[1] - GRID.origin[1] + t * np.sin(heading)) / GRID.resolution
    inside = (u >= 0) & (u < GRID.shape[0]) & (v >= 0) & (v < GRID.shape[1])
    flat = np.where(inside, np.floor(u) * GRID.shape[1] + np.floor(v), -1).astype(int)
    first = np.flatnonzero(np.diff(flat, prepend=-2))
    last = np.append(first[1:], len(t))
    cells, enter, leave = flat[first], t[first], np.append(t, LIMITS.max_m)[last]
    enter[0] = leave[0]
    return cells[cells >= 0], enter[cells >= 0], leave[cells >= 0]


def law(stops):
    """P(reading <= each of RANGES), of stops (weight, distance, spread)."""
    total = np.zeros(len(RANGES))
    for weight, distance, spread in stops:
        sensor = bm.BeamMixture(bm.Gaussian(np.hypot(0.05, spread)), 0.02, 0.05, 0.1, 0.4)
        total += weight * sensor.cumulative(RANGES, np.full(len(RANGES), distance), LIMITS)
    return total


def along(chances, distances, spreads):
    free = 1.0
    for chance, distance, spread in zip(chances, distances, spreads, strict=True):
        yield free * chance, distance, spread
        free *= 1 - chance
    yield free, np.inf, 0.0


def quantile(below, level):
    """The least of RANGES that readings stay below with a probability: the definition."""
    if below[0] >= level:
        return -np.inf
    return RANGES[np.argmax(below >= level)] if below[-1] >= level else np.inf


def expected(draws_of_beam):
    """Of every beam, the quantiles of the mean over draws of its law."""
    return [[quantile(np.mean(laws, axis=0), level) for level in CENTRAL_80] for laws in draws_of_beam]


def predicted(states, **options):
    predictor = Predictor(GRID, fixed_maps(states), SENSOR, DEPTH, len(states))
    return ScanPredictor.of(predictor, LIMITS).quantiles(POSE, ANGLES, **options)


def stop_maps():
    rng = np.random.default_rng(3)
    stop = rng.beta(0.3, 1.5, (3, GRID.n_cells))
    stop[rng.random(stop.shape) < 0.1] = 1.0
    return stop.astype(np.float32)


def test_quantiles_are_those_of_the_mean_over_draws():
    maps = stop_maps()
    laws = []
    for angle in ANGLES:
        cells, enter, leave = cells_met(angle)
        where = enter + DEPTH * (leave - enter)
        laws.append([law(along(one[cells].astype(float), where, np.zeros(len(cells)))) for one in maps])
    found = predicted(maps)
    assert np.isinf(expected(laws)).any()  # a beam that probably comes back from nothing is among them
    np.testing.assert_allclose(found, expected(laws), atol=OFF_M)
    one_draw = expected([each[:1] for each in laws])
    assert not np.allclose(found, one_draw, atol=0.05)  # another law would be noticed


def test_quantiles_of_surfaces_are_where_a_beam_crosses_them_and_levels_must_rise_inside_zero_and_one():
    rng = np.random.default_rng(4)
    states = np.zeros((2, GRID.n_cells, 6), np.float32)
    states[..., 0] = rng.beta(0.6, 1.0, (2, GRID.n_cells))
    mean = GRID.centers_from_corner_m(np.arange(GRID.n_cells)) + rng.uniform(-0.2, 0.2, (GRID.n_cells, 2))
    shape = np.column_stack([rng.uniform(0.05, 0.2, GRID.n_cells), rng.normal(0, 0.05, GRID.n_cells)])
    states[..., 1:3], states[..., 3:5], states[..., 5] = mean, shape, 0.04  # alike in both draws: nothing is merged
    start = np.array(POSE[:2]) - GRID.origin
    laws = []
    for angle in ANGLES:
        cells, _, _ = cells_met(angle)
        direction = np.array([np.cos(POSE[2] + angle), np.sin(POSE[2] + angle)])
        chance, distance, variance = cross_surface(states[0, cells].astype(float), start, direction)
        stops = [one[cells, 0] * chance for one in states.astype(float)]
        laws.append([law(along(chances, distance, np.sqrt(variance))) for chances in stops])
    np.testing.assert_allclose(predicted(states), expected(laws), atol=OFF_M)
    for levels in ((), (0.5, 0.5), (0.9, 0.1), (0.0, 0.5), (0.5, 1.0)):
        with pytest.raises(BadInput, match="levels must rise"):
            predicted(stop_maps(), levels=levels)
    with pytest.raises(BadInput, match="no draw"):
        predicted(stop_maps()[:0])
