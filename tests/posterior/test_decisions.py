"""Decisions of a run: paths in its draws, the shortest safe route, and a scan's information against enumeration."""

import itertools

import numpy as np
import pytest
import scipy
from flat_options import infer
from hypothesis import given
from hypothesis import strategies as st
from oracle.enumeration import beams, distances

import bayesmap as bm
from bayesmap.kernels.predict.density import device_maps
from bayesmap.kernels.predict.view import draw_scan_stops, independent_information
from bayesmap.posterior import route as routes
from bayesmap.posterior.decisions import MapDraws, best_views, expected_information, next_views, typical_sigma_m
from bayesmap.posterior.prediction import Fan
from bayesmap.sensors.model import RangeLimits

ANGLES = np.linspace(-np.pi, np.pi, 120, endpoint=False)
SENSOR = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.01, p_no_return=0.01)


def room():
    """A hall of 8 m x 6 m with a wall of which the sensor, in the left half, sees one side; and its scans."""
    grid = bm.Grid((32, 24), 0.25, (-1.0, -2.0))
    walls = np.zeros(grid.shape, dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[16, :14] = True  # x = 3.0 to 3.25, from below up to y = 1.5
    along = np.linspace(0.0, 1.0, 8)
    poses = np.column_stack([0.5 + along, 0.5 + 2.4 * along, along])
    return walls, grid, bm.simulate(walls, grid, poses, ANGLES, sensor=SENSOR, max_range_m=12.0, seed=1)


@pytest.fixture(scope="module", params=[bm.Independent(0.1), bm.Beta(), bm.Surface()], ids=lambda p: p.words.kind)
def run(request):
    _, grid, scans = room()
    return infer(scans, grid, prior=request.param, sensor=SENSOR, chains=2, warmup=20, draws=30, seed=3)


def test_the_robot_s_path_is_free_one_through_a_wall_is_not_and_a_wider_robot_is_no_likelier_to_pass(run):
    free = run.free_probability(run.posterior.scans.poses[:, :2], 0.2)
    assert free.probability > 0.8
    assert 0 < free.standard_error < 0.2
    assert free.blocked.shape == (2, 30)
    through = run.free_probability([[2.5, 0.5], [4.0, 0.5]], 0.2)
    assert through.probability < 0.1
    assert through.independent < 0.1
    path = [[0.5, 0.5], [2.0, 2.5]]
    found = [run.free_probability(path, radius).probability for radius in (0.05, 0.2, 0.5, 1.0)]
    assert found == sorted(found, reverse=True)


def test_the_draws_decide_as_they_would_by_hand(run):
    """A point in one cell of a kind without surfaces is free in the draws in which that cell is."""
    if run.posterior.prior.has_surfaces:
        pytest.skip("surfaces lie where they lie, not where their cell is")
    grid = run.grid
    x, y = grid.origin[0] + 16.5 * 0.25, grid.origin[1] + 10.5 * 0.25
    found = run.free_probability([[x, y]], 0.05)
    solid = np.array([[run.map_of(c, d)[16, 10] >= 0.1 for d in range(30)] for c in range(2)])
    if run.posterior.kind == "binary":
        assert (found.blocked == solid).all()
    assert found.probability == pytest.approx(1 - solid.mean(), abs=0.02)


def test_a_plan_keeps_to_its_risk_and_its_ends(run):
    start, goal = [0.5, 0.5], [1.5, 2.9]
    route = run.plan(start, goal, 0.2, risk=0.3)
    assert (route.path[0].tolist(), route.path[-1].tolist()) == (start, goal)
    assert route.within_risk == (route.free.probability >= 0.7)
    assert route.length_m >= np.hypot(1.0, 2.4) - 1e-9
    assert run.free_probability(route.path, 0.2).probability == route.free.probability


def test_the_information_of_a_scan_lies_between_bounds_and_is_more_round_the_corner(run):
    told = run.information_gain([[0.5, 0.5, 0.0], [2.5, 3.0, 0.0]], ANGLES[::10], draws=30)
    assert told.draws == 30
    assert (told.at_least <= np.log(30) + 1e-9).all()
    assert (told.at_least - 3 * told.at_least_error <= told.at_most + 3 * told.at_most_error).all()
    assert told.independent.shape == (2,)
    assert (told.independent > 0).all()
    told = run.information_gain([[2.8, 2.6, -0.6], [1.6, 0.5, np.pi]], np.linspace(-0.6, 0.6, 12), draws=40)
    assert told.at_most[0] > told.at_most[1]
    assert told.independent[0] > told.independent[1]


def test_the_best_views_can_be_reached_and_are_the_best(run):
    views = next_views(run.posterior, candidates=60, views=3, radius_m=0.2, draws=20)
    assert 3 <= len(views.candidates) <= 60
    assert len(views.best) == 3
    assert (np.diff(views.information.at_most) <= 0).all()
    assert run.observed[tuple(np.floor(run.grid.to_cells(views.candidates[:, :2])).astype(int).T)].all()
    same = next_views(run.posterior, candidates=60, views=3, radius_m=0.2, draws=20)
    assert (same.candidates == views.candidates).all()


def test_the_typical_spread_is_that_of_the_noise_and_a_run_without_draws_decides_nothing():
    assert typical_sigma_m(bm.Gaussian(0.07), 10.0) == pytest.approx(0.07, rel=0.05)
    _, grid, scans = room()
    run = infer(scans, grid, prior=bm.Independent(0.1), sensor=SENSOR, chains=1, warmup=1, draws=0)
    with pytest.raises(bm.BadInput, match="no draws"):
        run.free_probability([[0.0, 0.0]], 0.2)


@pytest.mark.parametrize(("call", "words"), [
    (lambda run: run.free_probability([[0, 0], [99, 0]], 0.2), "outside the map"),
    (lambda run: run.free_probability([[0, 0]], 0.0), "radius"),
    (lambda run: run.plan([0, 0], [[1, 1], [2, 2]], 0.2), "one point each"),
    (lambda run: run.plan([0, 0], [99, 1], 0.2), "goal .* outside"),
    (lambda run: run.information_gain([[0, 0, 0]], draws=1), "draws"),
    (lambda run: run.information_gain([[0, 0, 0]], max_range_m=-1.0), "max_range_m"),
    (lambda run: next_views(run.posterior, 0, 1, 0.2), "candidates"),
    (lambda run: next_views(run.posterior, 10, 1, 9.0), "smaller radius"),
])  # fmt: skip
def test_impossible_decisions_are_refused(run, call, words):
    with pytest.raises(bm.BadInput, match=words):
        call(run)


GRID = bm.Grid((5, 4), 0.5, (-1.0, 2.0))
POSE = np.array([[-0.8, 2.9, 0.1]])
FAN_RAD = np.array([-0.4, 0.0, 0.5])


def test_stops_are_drawn_with_the_chances_that_beams_have():
    """Chi-square over the cells in which one beam stops, false-alarm rate 1e-4 for three beams."""
    stop = np.random.default_rng(0).beta(0.7, 1.0, GRID.n_cells).astype(np.float32)
    draws = 20_000
    at = np.broadcast_to(POSE[0], (draws, 3))
    maps = device_maps([stop[None]], GRID, 0.0)
    found, spread = draw_scan_stops(maps, at, np.zeros(draws, dtype=int), FAN_RAD, 9.0, 3)
    assert (spread == 0).all()
    for a, angle in enumerate(FAN_RAD):
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


def fan(sensor, angles=FAN_RAD):
    return Fan(angles, RangeLimits(0.0, 6.0), sensor)


def exact_information(maps, weights, sensor, count, seed):
    """Mutual information of map and scan where the maps are few: the outer mean over many scans, the inner exact."""
    rng = np.random.default_rng(seed)
    which = rng.choice(len(maps), size=count, p=weights)
    at = np.array([
        np.minimum(distances(m.reshape(GRID.shape), *beams(POSE, FAN_RAD, GRID)) * GRID.resolution, 6.0) for m in maps
    ])  # fmt: skip
    readings = at[which] + sensor.sigma_m * rng.standard_normal((count, len(FAN_RAD)))
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
    found = expected_information(MapDraws(draws, GRID, 0.0), fan(sensor), POSE)
    assert found.at_least[0] == pytest.approx(exact, abs=4 * np.hypot(found.at_least_error[0], error))
    assert found.at_most[0] == pytest.approx(exact, abs=4 * np.hypot(found.at_most_error[0], error))
    assert found.at_least_error[0] < 0.1 * exact
    # A wrong twin: the maps without their weights.
    assert abs(exact_information(maps, np.full(6, 1 / 6), bm.Gaussian(4.0), 200_000, 2)[0] - exact) > 0.2


def test_a_known_map_leaves_nothing_to_learn_one_draw_is_too_few_and_the_best_views_are_apart():
    known = np.tile(np.random.default_rng(3).random(GRID.n_cells) < 0.3, (20, 1)).astype(np.float32)
    found = expected_information(MapDraws(known, GRID), fan(bm.Gaussian(0.2)), POSE)
    assert (found.at_least[0], found.at_most[0]) == pytest.approx((0.0, 0.0), abs=1e-9)
    with pytest.raises(bm.BadInput, match="draws"):
        expected_information(MapDraws(known[:1], GRID), fan(bm.Gaussian(0.1)), POSE)
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
    assert expected_information(MapDraws(stuck, GRID, 0.0), around, pose).at_least[0] > 0.5  # what pooling would say
    assert abs(expected_information(MapDraws(stuck, GRID, **options), around, pose).at_most[0]) <= 1e-9
    chains[:, :, 6] = rng.random((4, 15)) < 0.5
    assert expected_information(MapDraws(chains.reshape(60, -1), GRID, **options), around, pose).at_least[0] > 0.3


def test_few_draws_of_an_unknown_map_give_bounds():
    """Eight draws cannot tell more than log 8; that many beams tell more stands in the upper bound."""
    maps = np.random.default_rng(4).random((400, GRID.n_cells)) < 0.15
    sensor = bm.Gaussian(0.05)
    angles = np.linspace(-np.pi, np.pi, 24, endpoint=False)
    pose = np.array([[0.3, 3.1, 0.1]])
    many = expected_information(MapDraws(maps.astype(np.float32), GRID, 0.0), fan(sensor, angles), pose)
    few = expected_information(MapDraws(maps[:8].astype(np.float32), GRID, 0.0), fan(sensor, angles), pose)
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
    found = independent_information(
        occupied, GRID, poses, FAN_RAD, 20.0, sigma_m=0.3, hit_factor=9.0, pass_factor=1 / 9
    )
    plain = [[plain_fsmi(occupied, pose, angle, 0.6, 9.0, 1 / 9) for angle in FAN_RAD] for pose in poses]
    np.testing.assert_allclose(found, plain, rtol=1e-4, atol=1e-6)


SMALL = bm.Grid((12, 10), 0.5, (-1.0, 2.0))
BENT = np.array([[0.0, 3.0], [3.0, 3.2], [3.5, 5.0]])


@given(st.integers(0, 10_000))
def test_distances_are_those_of_points_sampled_along_the_path(seed):
    rng = np.random.default_rng(seed)
    path, points = rng.uniform(-3, 3, (3, 2)), rng.uniform(-4, 4, (5, 2))
    dense = np.concatenate([a + np.linspace(0, 1, 4000)[:, None] * (b - a) for a, b in itertools.pairwise(path)])
    plain = np.hypot(*(points[:, None] - dense).transpose(2, 0, 1)).min(axis=1)
    np.testing.assert_allclose(routes.distance_to_path_m(points, path), plain, atol=3e-3)
    outside = np.maximum(np.abs(points[:, None] - dense) - 0.25, 0.0)
    plain = np.hypot(outside[..., 0], outside[..., 1]).min(axis=1)
    np.testing.assert_allclose(routes.square_to_path_m(points, 0.5, path), plain, atol=3e-3)


def test_no_cell_that_can_touch_the_disc_is_left_out_and_cells_without_surfaces_are_squares():
    cells = routes.cells_about(BENT, 0.3, SMALL)
    every = np.arange(SMALL.n_cells)
    near = routes.distance_to_path_m(routes.centres_world(every, SMALL), BENT) < 0.3 + 2.5 * 0.5
    assert set(every[near]) <= set(cells)
    assert len(cells) < SMALL.n_cells
    stops = np.random.default_rng(0).choice([0.0, 0.05, 0.2, 1.0], size=(7, len(cells))).astype(np.float32)
    found = routes.blocking_cells([stops[:3], stops[3:]], cells, SMALL, BENT, 0.3)
    near = routes.square_to_path_m(routes.centres_world(cells, SMALL), 0.5, BENT) < 0.3
    assert (found == ((stops > 0.1) & near)).all()
    assert found.any()


def test_surfaces_block_where_they_lie_and_not_where_their_cell_is():
    cells = np.array([5 * 10 + 2], dtype=np.int32)  # its square is [1.5, 2] x [3, 3.5], on the path
    wall = np.array([0.9, 3.2, 0.6, 0.1, 0.0, 0.01], dtype=np.float32)  # 2.2, 2.6 in the world
    straight = np.array([[0.0, 3.1], [4.0, 3.1]])
    far, near = wall.copy(), wall.copy()
    near[2] = 0.9  # 2.9 in the world: 0.2 from the path
    for surface, radius_m, expected in ((far, 0.3, False), (near, 0.3, True), (near, 0.15, False)):
        assert routes.blocking_cells([surface[None, None]], cells, SMALL, straight, radius_m).tolist() == [[expected]]
    draws = np.zeros((1, TWO_ROOMS.n_cells, 6), dtype=np.float32)
    draws[0, 10 * 30 + 10] = [0.9, 2.9, 2.6, 0.02, 0.0, 0.02]  # the cell's own centre is 2.625, 2.625
    blocked = routes.blocked_probability([draws], TWO_ROOMS, 0.2)
    assert (blocked[11, 10], blocked[9, 10]) == (1, 0)


@given(st.integers(0, 10_000))
def test_an_ellipse_touches_the_disc_where_points_of_its_outline_do(seed):
    """The ellipse is probed at five places: nearness within a quarter of its length is not judged."""
    rng = np.random.default_rng(seed)
    l11, l22 = rng.uniform(0.02, 0.2, 2)
    l21 = rng.uniform(-0.2, 0.2)
    mean = rng.uniform(0, 2, 2)
    turn = np.linspace(0, 2 * np.pi, 400)
    outline = mean + 2 * np.stack([np.cos(turn), np.sin(turn)], -1) @ np.array([[l11, 0], [l21, l22]]).T
    path = rng.uniform(0, 2, (2, 2))
    nearest = routes.distance_to_path_m(outline, path).min()
    surface = np.array([[1.0, *mean, l11, l21, l22]])
    radius_m = 0.2
    found = routes._surface_touches(surface, np.zeros(2), path, radius_m)[0]
    longest = 2 * np.sqrt(np.linalg.eigvalsh([[l11**2, l11 * l21], [l11 * l21, l21**2 + l22**2]])[1])
    if nearest < radius_m - 0.25 * longest:
        assert found
    if nearest > radius_m + 0.25 * longest and routes.distance_to_path_m(mean, path) > radius_m + longest:
        assert not found


def test_the_probability_of_a_free_path_and_its_error():
    """A door of five cells that is shut in half of the draws counts once: one half, and not a half to the fifth.

    Draws that depend on each other are worth less, and where all draws agree the error is not zero.
    """
    shut = np.random.default_rng(1).random(2000) < 0.5
    blocking = np.repeat(shut[:, None], 5, axis=1)
    found = routes.free_probability(blocking, chains=4)
    assert found.probability == 1 - shut.mean()
    assert (found.independent, found.blocked.shape) == (pytest.approx((1 - shut.mean()) ** 5), (4, 500))
    assert found.standard_error == pytest.approx(np.sqrt(0.25 / 2000), rel=0.15)
    shut = np.repeat(np.random.default_rng(2).random(100) < 0.5, 20)
    found = routes.free_probability(shut[:, None], chains=2)
    assert found.standard_error > 2.5 * np.sqrt(0.25 / 2000)
    found = routes.free_probability(np.zeros((200, 3), dtype=bool), chains=2)
    assert found.probability == 1.0
    assert 0 < found.standard_error < 0.02


@pytest.mark.parametrize("path", [[], [[0.0]], [[0.0, float("nan")]], "here", [[1.0, 2.0, 3.0]]])
def test_a_path_that_is_none_is_refused(path):
    with pytest.raises(bm.BadInput, match="path"):
        routes.check_path(path)


TWO_ROOMS = bm.Grid((40, 30), 0.25, (0.0, 0.0))
RADIUS = 0.3


def rooms(door_shut):
    """Two rooms with a near door that is shut in some draws, and a far one that never is."""
    draws = np.zeros((len(door_shut), *TWO_ROOMS.shape), dtype=np.float32)
    draws[:, 20] = 1.0
    draws[:, 20, 2:8] = 0.0  # far door, about y = 1.2
    draws[:, 20, 20:26] = 0.0  # near door, about y = 5.7
    draws[door_shut, 20, 20:26] = 1.0
    return draws.reshape(len(door_shut), -1)


def route(draws, risk, start=(2.0, 5.7), goal=(8.0, 5.7), grid=TWO_ROOMS, radius_m=RADIUS):
    def judge(path):
        cells = routes.cells_about(path, radius_m, grid)
        return routes.free_probability(routes.blocking_cells([draws[:, cells]], cells, grid, path, radius_m), chains=2)

    blocked = routes.blocked_probability([draws], grid, radius_m)
    return routes.plan_route(blocked, grid, np.array(start), np.array(goal), risk, judge)


@pytest.mark.parametrize(("share", "risk", "probability"), [(0.0, 0.01, 1.0), (0.1, 0.2, 0.9), (0.1, 0.05, 1.0)])
def test_a_door_that_may_be_shut_is_taken_only_if_the_risk_is_accepted(share, risk, probability):
    found = route(rooms(np.arange(40) < 40 * share), risk)
    assert found.within_risk
    assert found.free.probability == pytest.approx(probability)
    if risk >= share:
        assert found.length_m == pytest.approx(6.0, abs=0.05)  # straight through the near door
    else:
        assert found.length_m > 9
        assert np.hypot(*(found.path - [5.125, 1.2]).T).min() < 1.5  # by the far door


def test_the_safest_path_is_returned_if_all_are_too_risky_and_impossible_plans_are_refused():
    draws = rooms(np.arange(40) % 4 == 0)
    draws.reshape(-1, *TWO_ROOMS.shape)[:, 20, 2:8] = 1.0
    found = route(draws, 0.05)
    assert not found.within_risk
    assert found.free.probability == pytest.approx(0.75)
    draws = rooms(np.zeros(4, dtype=bool))
    closed = draws.copy()
    closed.reshape(-1, *TWO_ROOMS.shape)[:, 20] = 1.0  # no door
    for maps, start, risk, message in (
        (draws, (-1.0, 1.0), 0.1, "outside"), (draws, (5.1, 4.0), 0.1, "touches"), (draws, (2.0, 5.7), 1.5, "risk"),
        (closed, (2.0, 5.7), 0.1, "no path"),
    ):  # fmt: skip
        with pytest.raises(bm.BadInput, match=message):
            route(maps, risk, start)


def test_a_route_in_an_empty_hall_is_straight_and_goes_round_walls_without_cutting_corners():
    empty = np.zeros((4, TWO_ROOMS.n_cells), dtype=np.float32)
    for seed in range(20):
        start, goal = np.random.default_rng(seed).uniform([1, 1], [9, 6.5], (2, 2))
        found = route(empty, 0.01, tuple(start), tuple(goal))
        assert found.length_m <= np.hypot(*(goal - start)) * 1.001 + 1e-6
    grid = bm.Grid((6, 5), 1.0, (-0.5, -0.5))
    walls = np.zeros((8, *grid.shape), dtype=np.float32)
    walls[:, 2, 3:] = 1.0
    found = route(walls.reshape(8, -1), 0.05, (1.0, 3.0), (4.0, 3.0), grid, 0.25)
    assert found.free.probability == 1.0
    assert found.within_risk
    assert found.length_m == pytest.approx(2 * np.sqrt(2) + 1 + 1, abs=1.01)
