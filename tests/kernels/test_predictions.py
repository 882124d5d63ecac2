"""Predictive densities, cumulatives, quantiles and first-hit events against plain sums over cells and draws."""

import dataclasses

import numpy as np
import pytest
from oracle.own_sensor import OwnSensor
from oracle.stop_law import cross_surface, stop_probabilities
from tiers import latin

import bayesmap as bm
from bayesmap.kernels.predict.density import forecast, log_densities
from bayesmap.kernels.predict.stop_mixture import first_hit_events, mix_stops, range_quantiles
from bayesmap.kernels.rays import trace_rays
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((8, 6), 0.5, (-1.0, 2.0))
LIMITS = RangeLimits(0.2, 5.0)
SENSORS = {
    "gaussian": bm.Gaussian(0.2, 0.02),
    "student-t": bm.StudentT(0.2, 3.0, 0.01),
    "mixture": bm.BeamMixture(bm.Gaussian(0.1, 0.02), 0.05, 0.1, 0.2, 0.4),
    "mixture of student-t": bm.BeamMixture(bm.StudentT(0.1, 4.0), 0.02, 0.05, 0.1, 0.5),
    "mixture of odd student-t": bm.BeamMixture(bm.StudentT(0.1, 2.5), 0.02, 0.05, 0.1, 0.5),
}
ROBUST = [name for name in SENSORS if "mixture" in name]
DEPTH = 0.3


def world(seed, *, poses=2, rays=12, binary=False):
    """Scans with readings of all kinds, and three draws of a map."""
    rng = np.random.default_rng(seed)
    size = np.array(GRID.shape) * GRID.resolution
    xy = np.array(GRID.origin) + rng.uniform(-0.1, 1.1, (poses, 2)) * size
    readings = rng.uniform(0.2, 4.9, (poses, rays))
    kinds = rng.random(readings.shape)
    readings[kinds < 0.2] = np.inf
    readings[(kinds >= 0.2) & (kinds < 0.3)] = -np.inf
    readings[(kinds >= 0.3) & (kinds < 0.35)] = np.nan
    pose = np.column_stack([xy, rng.uniform(-4, 4, poses)])
    scans = bm.Scans(pose, rng.uniform(0, 7, rays), readings, max_range_m=LIMITS.max_m, min_range_m=LIMITS.min_m)
    stop = rng.beta(0.3, 1.0, (3, GRID.n_cells))
    stop[rng.random(stop.shape) < 0.1] = 1.0
    stop[rng.random(stop.shape) < 0.2] = 0.0
    return scans, (np.round(stop) if binary else stop).astype(np.float32)


def batches(rays, *maps):
    """Maps of the whole grid as predictions take them: the cells that beams touch."""
    return [m[:, rays.touched] for m in maps]


def stops(rays, b, m):
    """Weights of a beam's stops, nowhere last, under one draw: the formula of the module."""
    cells = rays.cells[rays.offsets[b] : rays.offsets[b + 1]]
    at = m[cells].astype(float)
    free = np.concatenate([[1.0], np.cumprod(1.0 - at)])
    return np.append(free[:-1] * at, free[-1])


def mean_over_draws(rays, maps, of_stop):
    """Sum over stops of weight x of_stop(beam, distance), averaged over draws, (B,)."""
    enter, leave = rays.stretches()
    d = enter + DEPTH * (leave - enter)
    out = np.zeros(rays.n_beams)
    for b in range(rays.n_beams):
        places = np.append(d[rays.offsets[b] : rays.offsets[b + 1]], np.inf)
        worth = of_stop(b, places)
        out[b] = np.mean([(stops(rays, b, m) * worth).sum() for m in maps])
    return out


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("name", SENSORS)
def test_densities_are_the_plain_sums(name, binary):
    sensor = SENSORS[name]
    for seed in range(4):
        scans, maps = world(seed, binary=binary)
        rays, z = trace_rays(scans, GRID), scans.ranges_m.ravel()
        found = forecast(rays, batches(rays, maps[:1], maps[1:]), sensor, DEPTH)

        def worth(b, d, z=z):
            return np.exp(sensor.log_likelihood(np.full(len(d), z[b]), d, LIMITS))

        plain = mean_over_draws(rays, maps, worth)
        valid = ~np.isnan(z)
        np.testing.assert_allclose(found.log_density[valid], np.log(plain[valid]), atol=1e-6)
        assert np.isnan(found.log_density[~valid]).all()
        alone = log_densities(rays, batches(rays, maps), sensor, DEPTH)
        np.testing.assert_allclose(alone, found.log_density, rtol=1e-12)


@pytest.mark.parametrize("name", SENSORS)
def test_cumulatives_are_the_plain_sums(name):
    sensor = SENSORS[name]
    scans, maps = world(10)
    rays, z = trace_rays(scans, GRID), scans.ranges_m.ravel()
    found = forecast(rays, batches(rays, maps), sensor, DEPTH)

    def below(r):
        return mean_over_draws(rays, maps, lambda b, d: sensor.cumulative(np.full(len(d), r[b]), d, LIMITS))

    valid = ~np.isnan(z)
    np.testing.assert_allclose(found.pit_high[valid], below(z)[valid], atol=1e-9)
    robust = name in ROBUST
    top, bottom = (below(np.full(len(z), x)) for x in (LIMITS.max_m, LIMITS.min_m))
    np.testing.assert_allclose(found.p_no_return[valid], (1 - top)[valid] * robust, atol=1e-9)
    np.testing.assert_allclose(found.p_too_close[valid], bottom[valid] * robust, atol=1e-9)
    low = found.pit_high.copy()
    if robust:
        low[np.isposinf(z)], low[np.isneginf(z)] = top[np.isposinf(z)], 0.0
    np.testing.assert_allclose(found.pit_low[valid], low[valid], atol=1e-9)


def test_weights_of_stops_are_their_means_over_draws():
    scans, maps = world(40)
    rays = trace_rays(scans, GRID)
    mixed = mix_stops(rays, batches(rays, maps[:2], maps[2:]), DEPTH)
    for b in range(rays.n_beams):
        expected = np.mean([stops(rays, b, m) for m in maps], axis=0)
        mine = slice(rays.offsets[b], rays.offsets[b + 1])
        np.testing.assert_allclose(np.append(mixed.weight[mine], mixed.no_stop[b]), expected, atol=1e-6)


@pytest.mark.parametrize("name", SENSORS)
def test_quantiles_rise_and_belong_to_the_cumulative(name):
    sensor, robust = SENSORS[name], name in ROBUST
    scans, maps = world(50)
    scans = dataclasses.replace(scans, ranges_m=np.full(scans.ranges_m.shape, 1.0))
    rays = trace_rays(scans, GRID)
    levels = np.array([0.025, 0.1, 0.25, 0.5, 0.75, 0.9, 0.975])
    q = range_quantiles(mix_stops(rays, batches(rays, maps), DEPTH), levels, sensor)
    with np.errstate(invalid="ignore"):
        assert not (np.diff(q, axis=1) < 0).any()
    for i, level in enumerate(levels):
        at, before = (
            forecast(dataclasses.replace(rays, range_m=q[:, i] - back), batches(rays, maps), sensor, DEPTH)
            for back in (0.0, 0.002)
        )  # at the quantile the cumulative has reached the level, just before it has not
        inner = np.isfinite(q[:, i])
        assert (at.pit_high[inner] >= level - 1e-6).all()
        assert (before.pit_low[inner] <= level + 1e-6).all()
        if robust:
            np.testing.assert_array_equal(np.isposinf(q[:, i]), 1 - at.p_no_return < level)
            np.testing.assert_array_equal(np.isneginf(q[:, i]), at.p_too_close >= level)
        else:
            assert inner.all()


@pytest.mark.parametrize("name", ["mixture", "gaussian"])
def test_events_multiply_to_the_chance_of_the_cell(name):
    sensor = SENSORS[name]
    scans, maps = world(60, poses=4)
    scans = dataclasses.replace(scans, ranges_m=np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 3.0))
    rays, z = trace_rays(scans, GRID), scans.ranges_m.ravel()
    chance, stopped = first_hit_events(mix_stops(rays, batches(rays, maps), DEPTH), sensor)
    enter, leave = rays.stretches()
    checked = 0
    for b in range(rays.n_beams):
        mine = slice(rays.offsets[b], rays.offsets[b + 1])
        event = stopped[mine] >= 0
        ends = np.append(enter[mine][1:], leave[mine][-1:])  # of each cell's own part of the beam
        entry, end, p, y = (a[event] for a in (enter[mine], ends, chance[mine], stopped[mine]))
        assert (entry <= z[b]).all()
        np.testing.assert_array_equal(y, (entry <= z[b]) & (z[b] < np.minimum(end, LIMITS.max_m)))
        if not y.any():
            continue
        assert y.sum() == y[-1] == 1

        def below(r, b=b):
            return mean_over_draws(
                rays, maps, lambda i, d: sensor.cumulative(np.full(len(d), r), d, LIMITS) * (i == b)
            )[b]

        whole = (below(end[-1]) - below(entry[-1])) / (1 - below(entry[0]))
        product = np.prod(np.where(y == 1, p, 1 - p).astype(float))
        assert product == pytest.approx(whole, rel=2e-4, abs=1e-7)
        checked += 1
    assert checked > 10


OWN = ["mixture", "student-t", "mixture of student-t"]


@pytest.mark.parametrize(("name", "binary"), latin(3, OWN, [False, True]))
def test_a_sensor_of_the_user_s_own_predicts_by_a_table_what_its_formula_says(name, binary):
    formula = SENSORS[name]
    own = OwnSensor(formula)
    scans, maps = world(70, binary=binary, poses=6)
    rays = trace_rays(scans, GRID)
    mine, exact = (forecast(rays, batches(rays, maps), sensor, DEPTH) for sensor in (own, formula))
    likely = exact.log_density > -8
    assert likely.sum() > 50
    np.testing.assert_allclose(mine.log_density[likely], exact.log_density[likely], atol=0.02)
    for field in ("pit_low", "pit_high", "p_no_return", "p_too_close"):
        np.testing.assert_allclose(getattr(mine, field), getattr(exact, field), atol=5e-3)
    quantiles = [
        range_quantiles(mix_stops(rays, batches(rays, maps), DEPTH), np.array([0.2, 0.5, 0.8]), sensor)
        for sensor in (own, formula)
    ]
    np.testing.assert_array_equal(*map(np.isfinite, quantiles))
    away = np.abs(np.subtract(*np.nan_to_num(quantiles, posinf=9.0, neginf=-9.0)))
    assert np.median(away) < 2e-3
    assert np.quantile(away, 0.95) < 0.05


def test_what_cannot_be_predicted_is_refused():
    half = OwnSensor(bm.StudentT(0.1), 0.5)
    scans, maps = world(70)
    rays = trace_rays(scans, GRID)
    assert np.isfinite(log_densities(rays, batches(rays, maps), half, DEPTH)).any()
    with pytest.raises(bm.BadInput, match="densities of OwnSensor do not integrate to one, so only its log score"):
        forecast(rays, batches(rays, maps), half, DEPTH)
    with pytest.raises(bm.BadInput, match="there is no draw to predict from"):
        forecast(rays, [], bm.Gaussian(0.1), DEPTH)
    with pytest.raises(bm.BadInput, match="there is no draw to predict from"):
        mix_stops(rays, [], DEPTH)


OPEN = RangeLimits(0.0, 5.0)
SIGMA, MIXTURE = 0.05, (0.05, 0.1, 0.2, 0.4)


def surface_world(seed):
    """Scans, their beams, and three draws of surfaces in the cells that they touch."""
    rng = np.random.default_rng(seed)
    poses = np.column_stack([rng.uniform(-1, 3, 2), rng.uniform(2, 5, 2), rng.uniform(-4, 4, 2)])
    readings = rng.uniform(0.2, 4.9, (2, 14))
    readings[rng.random(readings.shape) < 0.2] = np.inf
    scans = bm.Scans(poses, rng.uniform(0, 7, 14), readings, max_range_m=OPEN.max_m)
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


def surface_stops(rays, states, b):
    """Weight, distance and spread of every stop of a beam under one draw, nowhere last."""
    at = states[rays.columns[rays.offsets[b] : rays.offsets[b + 1]]].astype(float)
    chance, distance, variance = cross_surface(at, rays.start_m[b].astype(float), rays.direction[b].astype(float))
    weights = stop_probabilities(at[:, 0] * chance)
    return list(zip(weights, np.append(distance, np.inf), np.append(np.sqrt(variance), 0.0), strict=True))


def test_densities_and_cumulatives_of_surfaces_are_the_plain_sums():
    sensor = bm.BeamMixture(bm.Gaussian(SIGMA), *MIXTURE)
    for seed in range(3):
        scans, rays, states = surface_world(seed)
        z = scans.ranges_m.ravel()
        found = forecast(rays, [states[:2], states[2:]], sensor, 0.5)
        for b in range(rays.n_beams):
            density, below = [], []
            for draw in states:
                terms = surface_stops(rays, draw, b)
                laws = [bm.BeamMixture(bm.Gaussian(np.hypot(SIGMA, s)), *MIXTURE) for *_, s in terms]
                pairs = list(zip(terms, laws, strict=True))
                one = [w * np.exp(law.log_likelihood(z[b], np.float64(d), OPEN)) for (w, d, _), law in pairs]
                density.append(np.sum(one))
                below.append(np.sum([w * law.cumulative(z[b], np.float64(d), OPEN) for (w, d, _), law in pairs]))
            assert found.log_density[b] == pytest.approx(np.log(np.mean(density)), abs=2e-4)  # states are single
            assert found.pit_high[b] == pytest.approx(np.mean(below), abs=2e-5)


def test_stops_in_a_cell_are_merged_with_their_moments():
    _, rays, states = surface_world(5)
    mixed = mix_stops(rays, [states], 0.5)
    for b in range(rays.n_beams):
        draws = np.array([surface_stops(rays, draw, b) for draw in states])  # (draws, stops, 3)
        w, d, s = np.moveaxis(draws[:, :-1], -1, 0)
        mine = slice(rays.offsets[b], rays.offsets[b + 1])
        np.testing.assert_allclose(mixed.weight[mine], w.mean(axis=0), atol=1e-6)
        assert mixed.no_stop[b] == pytest.approx(draws[:, -1, 0].mean(), abs=1e-5)
        some = w.mean(axis=0) > 1e-3
        mean = (w * d).sum(axis=0)[some] / w.sum(axis=0)[some]
        square = (w * (d**2 + s**2)).sum(axis=0)[some] / w.sum(axis=0)[some]
        np.testing.assert_allclose(mixed.distance_m[mine][some], mean, atol=1e-4)
        np.testing.assert_allclose(mixed.spread_m[mine][some], np.sqrt(square - mean**2), atol=2e-3)
