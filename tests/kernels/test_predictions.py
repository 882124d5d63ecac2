"""Predictive densities, cumulatives, quantiles, first hits, and likelihoods at poses against plain sums and tracing."""

import dataclasses
from dataclasses import replace

import numpy as np
import pytest
from oracle.stop_law import paths_of, stop_probabilities, stops
from oracle.stop_worlds import scans_of_all_kinds, surfaces_of
from oracle.worlds import OwnSensor
from tiers import latin

import bayesmap as bm
from bayesmap.kernels.match.likelihood_grid import field_sums
from bayesmap.kernels.predict.density import MIN_STOP_CHANCE, ScanLikelihood, device_maps, forecast, log_densities
from bayesmap.kernels.predict.pose_weights import scan_log_likelihood
from bayesmap.kernels.predict.stop_mixture import first_hit_events, mix_stops, range_quantiles
from bayesmap.kernels.rays import trace_rays
from bayesmap.posterior.prediction import CENTRAL_80, Predictor, ScanPredictor, fixed_maps
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((8, 6), 0.5, (-1.0, 2.0))
SENSORS = {
    "gaussian": bm.Gaussian(0.2, 0.02),
    "student-t": bm.StudentT(0.2, 3.0, 0.01),
    "mixture": bm.BeamMixture(bm.Gaussian(0.1, 0.02), 0.05, 0.1, 0.2, 0.4),
    "mixture of student-t": bm.BeamMixture(bm.StudentT(0.1, 4.0), 0.02, 0.05, 0.1, 0.5),
    "mixture of odd student-t": bm.BeamMixture(bm.StudentT(0.1, 2.5), 0.02, 0.05, 0.1, 0.5),
}
ROBUST = [name for name in SENSORS if "mixture" in name]
KINDS = {"partial": 1e-6, "binary": 1e-6, "surfaces": 2e-4}
"""Kinds of cells, and how far logarithms may be off: surfaces are in single precision."""
CASES = [*((name, kind) for name in SENSORS for kind in ("partial", "binary")), ("mixture", "surfaces")]
DEPTH = 0.3


def world(seed, kind="partial", poses=3):
    """Scans with readings of all kinds, and three draws of a map."""
    rng = np.random.default_rng(seed)
    scans = scans_of_all_kinds(seed, GRID, poses=poses, limits=(0.2, 5.0))
    stop = rng.beta(0.3, 1.0, (3, GRID.n_cells))
    if kind == "surfaces":
        return scans, surfaces_of(rng, GRID, stop)
    stop[rng.random(stop.shape) < 0.1] = 1.0
    stop[rng.random(stop.shape) < 0.2] = 0.0
    return scans, (np.round(stop) if kind == "binary" else stop).astype(np.float32)


def batches(rays, *maps):
    """Return maps of the whole grid as predictions take them: the cells that beams touch."""
    return [m[:, rays.touched] for m in maps]


def plain_stops(rays, maps):
    """Weight, distance and spread of every stop under every draw, nowhere last, (draws, B, K + 1); beams are padded."""
    paths, plain = paths_of(rays, far=False), maps.ndim == 2
    enter, leave = rays.chords()
    paths.plain_m[paths.there] = enter + DEPTH * (leave - enter)
    states = maps.reshape(len(maps), GRID.n_cells, -1)[:, rays.touched].astype(float)
    stopped, distance, variance = stops(paths, states, plain)
    ends = [np.full((*stopped.shape[:2], 1), end) for end in (np.inf, 0.0)]
    distance, spread = (
        np.concatenate([np.broadcast_to(a, stopped.shape), end], axis=-1)
        for a, end in zip((distance, np.sqrt(variance)), ends, strict=True)
    )
    return stop_probabilities(stopped), distance, spread


def plain_below(rays, maps, sensor, z):
    """The mean over draws of P(reading <= z), (B,)."""
    weight, distance, spread = plain_stops(rays, maps)
    return (weight * sensor.cumulative(z[:, None], distance, rays.limits, spread_m=spread)).sum(axis=-1).mean(axis=0)


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_densities_are_the_plain_sums(name, kind):
    sensor = SENSORS[name]
    for seed in range(4):
        scans, maps = world(seed, kind)
        rays, z = trace_rays(scans, GRID), scans.ranges_m.ravel()
        found = forecast(rays, batches(rays, maps[:1], maps[1:]), sensor, DEPTH)
        valid, (weight, distance, spread) = ~np.isnan(z), plain_stops(rays, maps)
        p = np.exp(sensor.stop_log_likelihood(z[:, None], distance, spread, rays.limits))
        expected = np.log((weight * p).sum(axis=-1).mean(axis=0))
        np.testing.assert_allclose(found.log_density[valid], expected[valid], atol=KINDS[kind])
        assert np.isnan(found.log_density[~valid]).all()
        alone = log_densities(rays, batches(rays, maps), sensor, DEPTH)
        np.testing.assert_allclose(alone, found.log_density, rtol=1e-12)


@pytest.mark.parametrize(("name", "kind"), [case for case in CASES if case[1] != "binary"])
def test_cumulatives_are_the_plain_sums(name, kind):
    sensor, close = SENSORS[name], {"atol": 1e-9 if kind == "partial" else 2e-5}
    scans, maps = world(10, kind)
    rays, z = trace_rays(scans, GRID), scans.ranges_m.ravel()
    found = forecast(rays, batches(rays, maps), sensor, DEPTH)
    valid = ~np.isnan(z)
    at, top, bottom = (
        plain_below(rays, maps, sensor, x) for x in (z, *(np.full(len(z), m) for m in (5.0, 0.2)))
    )  # at the reading and at both limits
    np.testing.assert_allclose(found.pit_high[valid], at[valid], **close)
    robust = name in ROBUST
    np.testing.assert_allclose(found.p_no_return[valid], (1 - top)[valid] * robust, **close)
    np.testing.assert_allclose(found.p_too_close[valid], bottom[valid] * robust, **close)
    low = found.pit_high.copy()
    if robust:
        low[np.isposinf(z)], low[np.isneginf(z)] = top[np.isposinf(z)], 0.0
    np.testing.assert_allclose(found.pit_low[valid], low[valid], **close)


@pytest.mark.parametrize("kind", ["partial", "surfaces"])
def test_stops_in_a_cell_are_merged_with_their_moments(kind):
    scans, maps = world(40, kind)
    rays = trace_rays(scans, GRID)
    mixed = mix_stops(rays, batches(rays, maps[:2], maps[2:]), DEPTH)
    weight, distance, spread = plain_stops(rays, maps)
    np.testing.assert_allclose(mixed.no_stop, weight[..., -1].mean(axis=0), atol=1e-5)
    there = paths_of(rays).there
    w, d, s = (a[..., :-1][:, there] for a in (weight, distance, spread))  # (draws, K)
    np.testing.assert_allclose(mixed.weight, w.mean(axis=0), atol=1e-6)
    likely = w.mean(axis=0) > 1e-3
    mean, square = ((w * a).sum(axis=0)[likely] / w.sum(axis=0)[likely] for a in (d, d**2 + s**2))
    np.testing.assert_allclose(mixed.distance_m[likely], mean, atol=1e-4)
    np.testing.assert_allclose(mixed.spread_m[likely], np.sqrt(np.maximum(square - mean**2, 0.0)), atol=2e-3)


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


@pytest.mark.parametrize("kind", ["partial", "surfaces"])
def test_quantiles_of_a_scan_at_a_pose_are_where_the_plain_cumulative_reaches_their_levels(kind):
    """To a millimetre or a thousandth. Surfaces are alike in all draws: nothing is merged. The twin: one draw's."""
    sensor, limits = SENSORS["mixture"], RangeLimits(0.2, 5.0)
    _, maps = world(50, kind)
    if kind == "surfaces":
        maps[..., 1:] = maps[0, :, 1:]
    angles, pose = np.linspace(-1.5, 1.4, 9), np.array([0.3, 3.1, 0.7])
    rays = trace_rays(bm.Scans(pose, angles, np.full((1, 9), np.inf), limits.max_m, limits.min_m), GRID)

    def agree(draws):
        predictor = Predictor(GRID, fixed_maps(draws), sensor, DEPTH, len(draws))
        found = ScanPredictor.of(predictor, limits).quantiles(pose, angles)
        for level, q in zip(CENTRAL_80, found.T, strict=True):
            before = plain_below(rays, maps, sensor, np.minimum(q - 1e-3, limits.max_m)) <= level + 1e-3
            if not (plain_below(rays, maps, sensor, q + 1e-3) >= level - 1e-3).all() or not before[q > 0].all():
                return False
        return np.isfinite(found).any()

    assert agree(maps)
    assert not agree(maps[:1])


@pytest.mark.parametrize("name", ["mixture", "gaussian"])
def test_events_multiply_to_the_chance_of_the_cell(name):
    sensor = SENSORS[name]
    scans, maps = world(60, poses=6)
    scans = dataclasses.replace(scans, ranges_m=np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 3.0))
    rays, z = trace_rays(scans, GRID), scans.ranges_m.ravel()
    chance, stopped = first_hit_events(mix_stops(rays, batches(rays, maps), DEPTH), sensor)
    enter, leave = rays.chords()
    checked = 0
    for b in range(rays.n_beams):
        mine = slice(rays.offsets[b], rays.offsets[b + 1])
        event = stopped[mine] >= 0
        ends = np.append(enter[mine][1:], leave[mine][-1:])  # of each cell's own part of the beam
        entry, end, p, y = (a[event] for a in (enter[mine], ends, chance[mine], stopped[mine]))
        assert (entry <= z[b]).all()
        np.testing.assert_array_equal(y, (entry <= z[b]) & (z[b] < np.minimum(end, 5.0)))
        if not y.any():
            continue
        assert y.sum() == y[-1] == 1
        first, before, after = (
            plain_below(rays, maps, sensor, np.full(len(z), r))[b] for r in (entry[0], entry[-1], end[-1])
        )
        whole = (after - before) / (1 - first)
        assert np.prod(np.where(y == 1, p, 1 - p).astype(float)) == pytest.approx(whole, rel=2e-4, abs=1e-7)
        checked += 1
    assert checked > 10


OWN = ["mixture", "student-t", "mixture of student-t"]


@pytest.mark.parametrize(("name", "kind"), latin(3, OWN, ["partial", "binary"]))
def test_a_sensor_of_the_user_s_own_predicts_by_a_table_what_its_formula_says(name, kind):
    formula = SENSORS[name]
    own = OwnSensor(formula)
    scans, maps = world(70, kind, poses=9)
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


def test_predictions_without_draws_or_a_proper_density_are_refused():
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


def predicted(scans, maps, sensor):
    """Log-likelihoods by tracing, one map after the other, (maps, S, A), invalid readings 0."""
    rays = trace_rays(scans, GRID)
    found = [log_densities(rays, [m[None, rays.touched]], sensor, DEPTH) for m in maps]
    return np.nan_to_num(np.array(found)).reshape(len(maps), *scans.ranges_m.shape)


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_scans_at_other_poses_have_the_likelihood_of_beams_traced_there(name, kind):
    for seed in range(4):
        scans, maps = world(seed, kind)
        off = np.random.default_rng(seed).normal(0, [0.3, 0.3, 0.5], scans.poses.shape)
        there = replace(scans, poses=scans.poses + off)
        chain, scan = (a.ravel() for a in np.meshgrid(np.arange(3), np.arange(len(scans)), indexing="ij"))
        found = ScanLikelihood(scans, GRID, SENSORS[name], DEPTH).beams(maps, np.tile(there.poses, (3, 1)), scan, chain)
        expected = predicted(there, maps, SENSORS[name])
        np.testing.assert_allclose(found.reshape(expected.shape), expected, atol=1e-5, rtol=1e-5)


def test_beams_that_left_while_the_sensor_moved_move_with_their_scan_and_company_does_not_matter():
    scans, maps = world(5)
    drift = np.random.default_rng(0).normal(0, 0.05, (*scans.ranges_m.shape, 3))
    scans = replace(scans, beam_poses=scans.poses[:, None] + drift)
    likelihood = ScanLikelihood(scans, GRID, bm.Gaussian(0.2), DEPTH)
    scan, chain = np.arange(len(scans)), np.zeros(len(scans), dtype=int)
    unmoved = likelihood.beams(maps, scans.poses, scan, chain)
    np.testing.assert_allclose(unmoved, predicted(scans, maps[:1], bm.Gaussian(0.2))[0], atol=1e-5, rtol=1e-5)
    turn, shift = 0.3, np.array([0.2, -0.1])
    c, s = np.cos(turn), np.sin(turn)
    rotation = np.array([[c, -s], [s, c]])

    def rigid(poses):
        return np.concatenate([poses[..., :2] @ rotation.T + shift, poses[..., 2:] + turn], axis=-1)

    there = replace(scans, poses=rigid(scans.poses), beam_poses=rigid(scans.beam_poses))
    found = likelihood.beams(maps, there.poses, scan, chain)
    np.testing.assert_allclose(found, predicted(there, maps[:1], bm.Gaussian(0.2))[0], atol=1e-5, rtol=1e-5)
    scans, maps = world(3)
    likelihood = ScanLikelihood(scans, GRID, SENSORS["mixture"], DEPTH)
    scan = np.repeat(np.arange(len(scans)), 50)
    poses = np.repeat(scans.poses, 50, axis=0) + np.random.default_rng(1).normal(0, 0.2, (len(scan), 3))
    chain = np.zeros(len(scan), dtype=int)
    together = likelihood(maps, poses, scan, chain)
    for i in range(0, len(scan), 7):
        assert likelihood(maps, poses[i : i + 1], scan[i : i + 1], chain[i : i + 1])[0] == together[i]


LARGE_GRID = bm.Grid((60, 50), 0.1, (-1.0, 2.0))
LASER = bm.BeamMixture(bm.Gaussian(0.02, 0.005), p_random=0.01, p_no_return=0.05, p_short=0.05)
TAILS = bm.BeamMixture(bm.StudentT(0.02, 9.0, 0.005), p_random=0.01, p_no_return=0.05, p_short=0.05)
FIELD_GRID = bm.Grid((30, 20), 0.1, (-1.0, 0.5))
ANGLES = np.radians(np.arange(60) * 6.0)


def states(kind, rng):
    stop = np.where(rng.random((3, LARGE_GRID.n_cells)) < 0.05, rng.uniform(0.2, 1.0, (3, LARGE_GRID.n_cells)), 4e-3)
    return stop.astype(np.float32) if kind == "plain" else surfaces_of(rng, LARGE_GRID, stop)


def random_poses(rng, count, low, high):
    """Draw poses with x, y between two corners and any heading, (count, 3)."""
    return rng.uniform([*low, -4], [*high, 4], (count, 3))


@pytest.mark.parametrize("laser", [LASER, TAILS], ids=["normal", "heavy tails"])
@pytest.mark.parametrize("kind", ["plain", "surfaces"])
def test_the_fast_law_is_the_plain_one(kind, laser):
    rng = np.random.default_rng(1)
    maps = states(kind, rng)
    poses = random_poses(rng, 40, (-1.5, 1.5), (5.5, 7.5))
    ranges = rng.uniform(0.0, 6.0, (2, 60))
    ranges[:, ::7], ranges[0, 3], ranges[1, 4] = np.inf, np.nan, -np.inf
    which, limits = rng.integers(0, 2, 40), RangeLimits(0.1, 6.0)
    fast = scan_log_likelihood(device_maps([maps], LARGE_GRID, 0.5), poses, ANGLES, ranges, laser, limits, scan=which)
    plain = ScanLikelihood(bm.Scans(np.zeros((2, 3)), ANGLES, ranges, 6.0, 0.1), LARGE_GRID, laser, 0.5)
    for draw in range(3):
        np.testing.assert_allclose(fast[:, draw], plain(maps, poses, which, np.full(40, draw)), rtol=2e-5, atol=2e-3)


def test_cells_that_hardly_ever_stop_a_beam_cost_all_poses_alike():
    """A beam that reads 4 m has passed some forty of them: what they take off differs little from pose to pose."""
    rng = np.random.default_rng(3)
    maps = states("plain", rng)
    maps[maps < 0.1] = 0.9 * MIN_STOP_CHANCE
    poses = random_poses(rng, 40, (1, 4), (3, 5))
    ranges = rng.uniform(0.0, 6.0, (1, 60))
    packed, limits = device_maps([maps], LARGE_GRID, 0.5), RangeLimits(0.1, 6.0)
    fast = scan_log_likelihood(packed, poses, ANGLES, ranges, LASER, limits)
    plain = ScanLikelihood(bm.Scans(np.zeros((1, 3)), ANGLES, ranges, 6.0, 0.1), LARGE_GRID, LASER, 0.5)
    for draw in range(3):
        less = fast[:, draw] - plain(maps, poses, np.zeros(40, int), np.full(40, draw))
        assert less.min() > 0.0
        assert less.max() < 0.06 * len(ANGLES)
        assert less.std() < 0.01 * len(ANGLES)


def test_poses_are_weighed_under_first_draws_or_one_in_turn_and_sums_of_a_field_are_the_plain_formula_s():
    rng = np.random.default_rng(4)
    packed = device_maps([states("surfaces", rng)], LARGE_GRID, 0.5)
    poses = random_poses(rng, 7, (0, 3), (4, 6))
    given = (packed, poses, ANGLES, rng.uniform(0, 6, 60), LASER, RangeLimits(0.0, 6.0))
    every = scan_log_likelihood(*given)
    np.testing.assert_array_equal(scan_log_likelihood(*given, draws=2), every[:, :2])
    turns = scan_log_likelihood(*given, in_turn=True)
    np.testing.assert_array_equal(turns[:, 0], every[np.arange(7), np.arange(7) % 3])
    rng = np.random.default_rng(0)
    field = rng.integers(0, 256, FIELD_GRID.shape).astype(np.uint8)
    points, poses = rng.uniform(-2, 2, (40, 2)), random_poses(rng, 50, (-1, 0.5), (2, 2.5))
    cos, sin = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
    x = cos * points[:, 0] - sin * points[:, 1] + poses[:, :1]
    y = sin * points[:, 0] + cos * points[:, 1] + poses[:, 1:2]
    cells = FIELD_GRID.to_cells(np.stack([x, y], axis=-1))
    assert np.abs(cells - np.round(cells)).min() > 1e-5  # none lies so near a line that single precision decides
    i, j = np.moveaxis(np.floor(cells).astype(int), -1, 0)
    inside = (i >= 0) & (j >= 0) & (i < 30) & (j < 20)
    expected = np.where(inside, field[np.clip(i, 0, 29), np.clip(j, 0, 19)], 0).sum(axis=1)
    assert inside.any()
    assert not inside.all()
    np.testing.assert_array_equal(field_sums(field, FIELD_GRID, points, poses), expected)
