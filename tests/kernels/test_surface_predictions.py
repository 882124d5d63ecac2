"""Predictions from surfaces are plain sums over cells and draws."""

import numpy as np
import pytest
from oracle.stop_law import cross_surface, stop_probabilities

import bayesmap as bm
from bayesmap.kernels.predict.density import forecast
from bayesmap.kernels.predict.stop_mixture import mix_stops
from bayesmap.kernels.rays import trace_rays
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((8, 6), 0.5, (-1.0, 2.0))
LIMITS = RangeLimits(0.0, 5.0)
SIGMA, MIXTURE = 0.05, (0.05, 0.1, 0.2, 0.4)


def world(seed):
    """Scans, their beams, and three draws of surfaces in the cells that they touch."""
    rng = np.random.default_rng(seed)
    poses = np.column_stack([rng.uniform(-1, 3, 2), rng.uniform(2, 5, 2), rng.uniform(-4, 4, 2)])
    readings = rng.uniform(0.2, 4.9, (2, 14))
    readings[rng.random(readings.shape) < 0.2] = np.inf
    scans = bm.Scans(poses, rng.uniform(0, 7, 14), readings, max_range_m=LIMITS.max_m)
    rays = trace_rays(scans, GRID)
    touched = rays.touched
    cells = len(touched)
    centre = np.stack([touched // 6 + 0.5, touched % 6 + 0.5], axis=-1) * GRID.resolution
    states = np.zeros((3, cells, 6), np.float32)
    states[..., 0] = rng.beta(0.5, 1.0, (3, cells))
    states[..., 1:3] = centre + rng.normal(0, 0.1, (3, cells, 2))
    states[..., 3], states[..., 5] = rng.uniform(0.02, 0.2, (2, 3, cells))
    states[..., 4] = rng.normal(0, 0.05, (3, cells))
    return scans, rays, states


def stops(rays, states, b):
    """Weight, distance and spread of every stop of a beam under one draw, nowhere last."""
    at = states[rays.columns[rays.offsets[b] : rays.offsets[b + 1]]].astype(float)
    chance, distance, variance = cross_surface(at, rays.start_m[b].astype(float), rays.direction[b].astype(float))
    weights = stop_probabilities(at[:, 0] * chance)
    return list(zip(weights, np.append(distance, np.inf), np.append(np.sqrt(variance), 0.0), strict=True))


def test_densities_and_cumulatives_are_the_plain_sums():
    sensor = bm.BeamMixture(bm.Gaussian(SIGMA), *MIXTURE)
    for seed in range(3):
        scans, rays, states = world(seed)
        z = scans.ranges_m.ravel()
        found = forecast(rays, [states[:2], states[2:]], sensor, 0.5)
        for b in range(rays.n_beams):
            density, below = [], []
            for draw in states:
                terms = stops(rays, draw, b)
                laws = [bm.BeamMixture(bm.Gaussian(np.hypot(SIGMA, s)), *MIXTURE) for *_, s in terms]
                pairs = list(zip(terms, laws, strict=True))
                one = [w * np.exp(law.log_likelihood(z[b], np.float64(d), LIMITS)) for (w, d, _), law in pairs]
                density.append(np.sum(one))
                below.append(np.sum([w * law.cumulative(z[b], np.float64(d), LIMITS) for (w, d, _), law in pairs]))
            assert found.log_density[b] == pytest.approx(np.log(np.mean(density)), abs=2e-4)  # states are single
            assert found.pit_high[b] == pytest.approx(np.mean(below), abs=2e-5)


def test_stops_in_a_cell_are_merged_with_their_moments():
    _, rays, states = world(5)
    mixed = mix_stops(rays, [states], 0.5)
    for b in range(rays.n_beams):
        draws = np.array([stops(rays, draw, b) for draw in states])  # (draws, stops, 3)
        w, d, s = np.moveaxis(draws[:, :-1], -1, 0)
        mine = slice(rays.offsets[b], rays.offsets[b + 1])
        np.testing.assert_allclose(mixed.weight[mine], w.mean(axis=0), atol=1e-6)
        assert mixed.no_stop[b] == pytest.approx(draws[:, -1, 0].mean(), abs=1e-5)
        some = w.mean(axis=0) > 1e-3
        mean = (w * d).sum(axis=0)[some] / w.sum(axis=0)[some]
        square = (w * (d**2 + s**2)).sum(axis=0)[some] / w.sum(axis=0)[some]
        np.testing.assert_allclose(mixed.distance_m[mine][some], mean, atol=1e-4)
        np.testing.assert_allclose(mixed.spread_m[mine][some], np.sqrt(square - mean**2), atol=2e-3)
