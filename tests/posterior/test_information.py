"""The information of a scan, against enumeration; FSMI against its formula, cell by cell."""

import numpy as np
import pytest
import scipy
from oracle.formula import beams, distances

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.kernels.predict.density import device_maps
from bayesmap.kernels.predict.view import draw_scan_stops, independent_information
from bayesmap.posterior.decisions import best_views, expected_information
from bayesmap.posterior.prediction import Fan
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((5, 4), 0.5, (-1.0, 2.0))
POSE = np.array([[-0.8, 2.9, 0.1]])
ANGLES = np.array([-0.4, 0.0, 0.5])


def test_stops_are_drawn_with_the_chances_that_beams_have():
    """Chi-square over the cells in which one beam stops, false-alarm rate 1e-4 for three beams."""
    rng = np.random.default_rng(0)
    stop = rng.beta(0.7, 1.0, GRID.n_cells).astype(np.float32)
    draws = 20_000
    at = np.broadcast_to(POSE[0], (draws, 3))
    maps = device_maps([stop[None]], GRID, 0.0)
    found, spread = draw_scan_stops(maps, at, np.zeros(draws, dtype=int), ANGLES, 9.0, 3)
    assert (spread == 0).all()
    for a, angle in enumerate(ANGLES):
        start, direction = beams(POSE, [angle], GRID)
        alone = [
            distances(np.arange(GRID.n_cells).reshape(GRID.shape) == c, start, direction)[0]
            for c in range(GRID.n_cells)
        ]
        order = np.argsort(alone)
        order = order[np.isfinite(np.array(alone)[order])]
        weights = stop[order] * np.cumprod(np.append(1.0, 1.0 - stop[order]))[:-1]
        metres = np.append(np.array(alone)[order] * GRID.resolution, np.inf)
        weights = np.append(weights, 1.0 - weights.sum())
        where, place = np.unique(np.round(metres, 6), return_inverse=True)
        expected = np.bincount(place, weights) * draws
        counts = np.array([(np.round(found[:, a], 6) == w).sum() if np.isfinite(w) else np.isinf(found[:, a]).sum()
                           for w in where])  # fmt: skip
        assert counts.sum() == draws
        keep = expected > 5
        chi2 = ((counts - expected)[keep] ** 2 / expected[keep]).sum()
        assert scipy.stats.chi2.sf(chi2, keep.sum() - 1) > 1e-4 / 3


def fan(sensor, angles=ANGLES):
    return Fan(angles, RangeLimits(0.0, 6.0), sensor)


def exact_information(maps, weights, sensor, count, seed):
    """Mutual information of map and scan where the maps are few: the outer mean over many scans, the inner exact."""
    rng = np.random.default_rng(seed)
    which = rng.choice(len(maps), size=count, p=weights)
    at = np.array([
        np.minimum(distances(m.reshape(GRID.shape), *beams(POSE, ANGLES, GRID)) * GRID.resolution, 6.0) for m in maps
    ])  # fmt: skip
    readings = at[which] + sensor.sigma_m * rng.standard_normal((count, len(ANGLES)))
    log_p = scipy.stats.norm.logpdf(readings[:, None], at[None], sensor.sigma_m).sum(axis=2)
    gains = log_p[np.arange(count), which] - scipy.special.logsumexp(log_p + np.log(weights), axis=1)
    return gains.mean(), gains.std() / np.sqrt(count)


def test_joint_draws_give_the_information_of_enumeration():
    rng = np.random.default_rng(1)
    maps = rng.random((6, GRID.n_cells)) < 0.3
    weights = rng.dirichlet(np.ones(6))
    sensor = bm.Gaussian(0.4)
    exact, error = exact_information(maps, weights, sensor, 200_000, 2)
    draws = maps[rng.choice(6, size=600, p=weights)].astype(np.float32)
    found = expected_information(draws, GRID, fan(sensor), POSE, hit_depth=0.0)
    assert found.at_least[0] == pytest.approx(exact, abs=4 * np.hypot(found.at_least_error[0], error))
    assert found.at_most[0] == pytest.approx(exact, abs=4 * np.hypot(found.at_most_error[0], error))
    assert found.at_least_error[0] < 0.1 * exact
    # A wrong twin: the maps without their weights.
    assert abs(exact_information(maps, np.full(6, 1 / 6), bm.Gaussian(4.0), 200_000, 2)[0] - exact) > 0.2


def test_a_known_map_leaves_nothing_to_learn_one_draw_is_too_few_and_the_best_views_are_apart():
    known = np.tile(np.random.default_rng(3).random(GRID.n_cells) < 0.3, (20, 1)).astype(np.float32)
    found = expected_information(known, GRID, fan(bm.Gaussian(0.2)), POSE)
    assert (found.at_least[0], found.at_most[0]) == pytest.approx((0.0, 0.0), abs=1e-9)
    with pytest.raises(BadInput, match="draws"):
        expected_information(known[:1], GRID, fan(bm.Gaussian(0.1)), POSE)
    poses = np.array([[0.0, 0, 0], [0.1, 0, 1], [2.0, 0, 0], [5.0, 0, 0]])
    assert best_views(np.array([4.0, 3.9, 2.0, 1.0]), poses, 2, 1.0).tolist() == [0, 2]


def test_chains_that_differ_by_a_cell_tell_nothing_and_cells_that_change_within_chains_do():
    rng = np.random.default_rng(5)
    chains = np.tile(rng.random((1, 1, GRID.n_cells)) < 0.15, (4, 15, 1)).astype(np.float32)
    chains[:2, :, 10], chains[2:, :, 11] = 1.0, 1.0
    stuck = chains.reshape(60, -1)
    options = {"hit_depth": 0.0, "chains": 4}
    around = fan(bm.Gaussian(0.05), np.linspace(-np.pi, np.pi, 24, endpoint=False))
    pose = np.array([[0.3, 3.1, 0.1]])
    assert expected_information(stuck, GRID, around, pose, hit_depth=0.0).at_least[0] > 0.5  # what pooling would say
    assert expected_information(stuck, GRID, around, pose, **options).at_most[0] == pytest.approx(0.0, abs=1e-9)
    chains[:, :, 6] = rng.random((4, 15)) < 0.5
    assert expected_information(chains.reshape(60, -1), GRID, around, pose, **options).at_least[0] > 0.3


def test_few_draws_of_an_unknown_map_give_bounds():
    """Eight draws cannot tell more than log 8; that many beams tell more stands in the upper bound."""
    rng = np.random.default_rng(4)
    maps = rng.random((400, GRID.n_cells)) < 0.15
    sensor = bm.Gaussian(0.05)
    angles = np.linspace(-np.pi, np.pi, 24, endpoint=False)
    options = {"hit_depth": 0.0}
    pose = np.array([[0.3, 3.1, 0.1]])
    many = expected_information(maps.astype(np.float32), GRID, fan(sensor, angles), pose, **options)
    few = expected_information(maps[:8].astype(np.float32), GRID, fan(sensor, angles), pose, **options)
    assert few.at_least[0] <= np.log(8) + 1e-9 < many.at_least[0]
    assert few.at_least[0] < many.at_least[0] <= many.at_most[0] <= few.at_most[0] + 4 * few.at_most_error[0]


def plain_fsmi(occupied, pose, angle, sigma, hit, passed):
    """The formula by a plain double sum over the cells that one beam crosses, in cells of the grid."""
    x, y = (pose[:2] - np.array(GRID.origin)) / GRID.resolution
    u = np.array([np.cos(pose[2] + angle), np.sin(pose[2] + angle)])
    crossed = []
    for i in range(GRID.shape[0]):
        for j in range(GRID.shape[1]):
            enter, leave = 0.0, np.inf
            for low, p, d in ((i, x, u[0]), (j, y, u[1])):
                a, b = (low - p) / d, (low + 1 - p) / d
                enter, leave = max(enter, min(a, b)), min(leave, max(a, b))
            if leave > enter + 1e-9:
                crossed.append((enter, leave, occupied[i * GRID.shape[1] + j]))
    crossed.sort()

    def f(delta, r):
        return np.log((r + 1) / (r + 1 / delta)) - np.log(delta) / (r * delta + 1)

    odds = [p / (1 - p) for _, _, p in crossed]
    learnt = np.cumsum([0.0] + [f(passed, r) for r in odds])
    total, survive = 0.0, 1.0
    for enter, leave, p in crossed:
        middle = 0.5 * (enter + leave)
        for k, (low, high, _) in enumerate(crossed):
            share = scipy.stats.norm.cdf((high - middle) / sigma) - scipy.stats.norm.cdf((low - middle) / sigma)
            total += survive * p * share * (learnt[k] + f(hit, odds[k]))
        survive *= 1 - p
    return total + survive * learnt[-1]


@pytest.mark.parametrize("seed", range(6))
def test_independent_cells_give_the_double_sum(seed):
    rng = np.random.default_rng(seed)
    occupied = rng.uniform(0.01, 0.9, GRID.n_cells)
    poses = np.column_stack([rng.uniform(-0.9, 1.4, 3), rng.uniform(2.1, 3.9, 3), rng.uniform(-3, 3, 3)])
    found = independent_information(occupied, GRID, poses, ANGLES, 20.0, sigma_m=0.3, hit_factor=9.0, pass_factor=1 / 9)
    plain = [[plain_fsmi(occupied, pose, angle, 0.6, 9.0, 1 / 9) for angle in ANGLES] for pose in poses]
    np.testing.assert_allclose(found, plain, rtol=1e-4, atol=1e-6)
