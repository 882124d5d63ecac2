"""The search for poses finds what looking everywhere finds; modes, regions and areas of a posterior over poses."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import scipy
from rooms import ANGLES, LIMITS, known, lattice_about, offset, scan_from, walls_of
from tiers import full_but

import bayesmap as bm
from bayesmap.localization import search
from bayesmap.localization.belief import DOF, PoseBelief, PoseMixture, student_draws
from bayesmap.localization.filter import Prior, Scan, Target, locate, refine_by_end_points, without_duplicates
from bayesmap.space.planar import wrap_angle


@cache
def belief(p_lost=0.0, count=2000):
    """Three quarters about (0, 0, pi), a quarter about (5, 2, 0)."""
    rng = np.random.default_rng(0)
    first = rng.normal(size=(count, 3)) * (0.1, 0.05, 0.02) + (0.0, 0.0, np.pi)
    second = rng.normal(size=(count, 3)) * 0.05 + (5.0, 2.0, 0.0)
    poses = np.concatenate([first, second])
    poses[:, 2] = (poses[:, 2] + np.pi) % (2 * np.pi) - np.pi
    return PoseBelief(poses, np.repeat([0.75 / count, 0.25 / count], count), p_lost, 1.0)


def test_modes_are_separated_regions_hold_their_share_and_areas_leave_room_for_being_lost():
    one, two = belief().modes
    assert (one.probability, two.probability) == pytest.approx((0.75, 0.25))
    np.testing.assert_allclose(two.mean, [5, 2, 0], atol=0.01)
    np.testing.assert_allclose(one.mean[:2], 0, atol=0.01)
    assert abs(one.mean[2]) == pytest.approx(np.pi, abs=0.01)
    np.testing.assert_allclose(np.sqrt(np.diag(one.covariance)), [0.1, 0.05, 0.02], rtol=0.05)
    assert belief().probability_in([-1, 1, -1, 1]) == pytest.approx(0.75, abs=0.01)
    assert belief(p_lost=0.2).probability_in([[4, 1], [6, 1], [6, 3], [4, 3]]) == pytest.approx(0.2, abs=0.01)
    triangle = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0]]
    assert belief().probability_in(np.array(triangle)) == pytest.approx(0.375, abs=0.02)
    with pytest.raises(bm.BadInput, match="give corners"):
        belief().probability_in([1, 2, 3])
    with pytest.raises(bm.BadInput, match="inside"):
        belief().region(1.0)
    answer = belief(0.1).as_json()
    assert (len(answer["modes"]), answer["p_lost"]) == (2, pytest.approx(0.1))
    assert answer["region_95_m2"] > 0
    for level in (0.5, 0.8, 0.95):
        region = belief().region(level)
        assert belief().weights[region.contains(belief().poses[:, :2])].sum() == pytest.approx(level, abs=0.03)
    assert region.contains([[5.0, 2.0]])[0]  # a region of that share about the first mode would leave out the second
    assert region.area_m2 < np.pi * 0.1 * 0.05 * 10 + np.pi * 0.05**2 * 10


def scan_of(scans):
    return Scan(scans.angles_rad, scans.ranges_m[0], LIMITS)


def test_few_returns_have_the_posterior_of_a_lattice(monkeypatch):
    """Four beams leave several places: shares of 24 parts of a room's poses. The twin weights poses, but moves none."""
    walls, grid = walls_of(6.0, 4.0)
    angles, laser = np.array([-1.2, -0.4, 0.5, 1.3]), bm.Gaussian(0.3)
    scans = scan_from(walls, grid, np.array([1.5, 1.4, 0.4]), laser, angles, seed=2)
    target = Target(known(walls, grid, scans, laser, beam_weight=1.0), Prior(), scan_of(scans), 1.0)
    lattice = lattice_about(np.array([3.0, 2.0, 0.0]), (2.95, 1.95, np.pi * 59 / 60), 60)
    parts = {"bins": (3, 2, 4), "range": ((0.0, 6.0), (0.0, 4.0), (-np.pi, np.pi))}
    shares = np.histogramdd(lattice, weights=np.exp(target(lattice)), **parts)[0]
    for moves, low, high in ((6, 0.0, 0.1), (0, 0.2, 1.0)):
        monkeypatch.setattr("bayesmap.localization.filter.ANNEAL_MOVES", moves)
        found = locate(target.known, target.scan, np.random.default_rng(1))
        error = np.histogramdd(found.poses, weights=found.weights, **parts)[0] - shares / shares.sum()
        assert low <= 0.5 * np.abs(error).sum() < high


@pytest.mark.parametrize("seed", full_but(range(6), 0, 3))
def test_a_square_room_has_four_places_alike(seed):
    """Full circles in a square room: turned by quarters all is alike but for 36 beams' own noise, which is the same."""
    walls, grid = walls_of(4.0, 4.0, alcove=False)
    scans = scan_from(walls, grid, np.array([1.33, 1.71, 0.2]), seed=seed)
    belief = locate(known(walls, grid, scans, beam_weight=1.0), scan_of(scans), np.random.default_rng(seed))
    likely = [mode for mode in belief.modes if mode.probability > 0.05]
    assert len(likely) == 4
    assert sum(mode.probability for mode in likely) > 0.99
    middle = np.array([2.0, 2.0])
    for quarter in range(4):
        turn = quarter * np.pi / 2
        c, s = np.cos(turn), np.sin(turn)
        place = np.append(middle + np.array([[c, -s], [s, c]]) @ (np.array([1.33, 1.71]) - middle), 0.2 + turn)
        near = [mode for mode in likely if offset(mode.mean, place)[0] < 0.1 and offset(mode.mean, place)[1] < 0.1]
        assert (len(near), near[0].probability) == (1, pytest.approx(0.25, abs=0.15))


@pytest.fixture(scope="module")
def room():
    walls, grid = walls_of(6.0, 4.0)
    return walls, grid, search.likelihood_field(walls.astype(float), grid, ~walls)


def test_the_coarse_search_scores_every_position_and_heading(room):
    """The best of its poses is the best of the whole lattice, by the plain sum."""
    walls, grid, field = room
    scans = scan_from(walls, grid, np.array([2.0, 1.7, 1.0]))
    points = search.end_points(ANGLES, scans.ranges_m[0], search.COARSE_POINTS)
    (mx, my), size = field.coarse_grid.shape, field.coarse_grid.resolution

    def plain(cell, heading):
        cos, sin = np.cos(heading), np.sin(heading)
        i = cell[0] + np.floor((cos * points[:, 0] - sin * points[:, 1]) / size + 0.5).astype(int)
        j = cell[1] + np.floor((sin * points[:, 0] + cos * points[:, 1]) / size + 0.5).astype(int)
        inside = (i >= 0) & (j >= 0) & (i < mx) & (j < my)
        return int(field.coarse[i[inside], j[inside]].sum())

    headings = np.arange(search.HEADINGS) * 2 * np.pi / search.HEADINGS
    best = max(plain(cell, heading) for cell in np.argwhere(field.open) for heading in headings)
    scores = [plain(np.floor(pose[:2] / size).astype(int), pose[2]) for pose in search._coarse_poses(field, points)]
    assert max(scores) == best
    assert len(search.search(field, ANGLES, np.full(len(ANGLES), np.inf), 5).poses) == 0
    start = np.array([[2.1, 1.6, 1.05]])
    assert search.refine(field, points, start, 1).scores[0] >= field.score(points, start)[0]  # refining never loses


@pytest.mark.parametrize("seed", full_but(range(5), 0, 4))
def test_the_true_pose_is_found(room, seed):
    walls, grid, field = room
    rng = np.random.default_rng(seed)
    truth = np.array([rng.uniform(0.5, 4.5), rng.uniform(0.5, 2.5), rng.uniform(-np.pi, np.pi)])
    found = search.search(field, ANGLES, scan_from(walls, grid, truth, seed=seed).ranges_m[0], 10)
    assert min(sum(offset(pose, truth)) for pose in found.poses) < 0.15
    assert (np.diff(found.scores) <= 0).all()
    for i, pose in enumerate(found.poses):
        near = np.abs(found.poses[:i, :2] - pose[:2]).max(axis=1, initial=0) < search.MIN_APART_M
        assert not (near & (np.abs(wrap_angle(found.poses[:i, 2] - pose[2])) < search.MIN_APART_RAD)).any()


NOWHERE = (np.zeros((40, 30), dtype=bool), 0.0)


def test_the_field_of_a_surface_is_its_widened_density_and_the_nearer_of_two_draws_counts():
    _, grid = walls_of(4.0, 3.0)
    states = np.zeros((1, grid.n_cells, 6), dtype=np.float32)
    states[0, 20 * 30 + 10] = [0.9, 2.05, 1.07, 0.03, 0.01, 0.02]
    field = search.endpoint_field(states, grid, 0.02, *NOWHERE)
    assert field.grid.resolution == pytest.approx(0.025)
    lower = np.array([[0.03, 0.0], [0.01, 0.02]])
    covariance = lower @ lower.T + (0.02**2 + 0.25 * 0.025**2) * np.eye(2)
    cells = np.array([[82, 42], [83, 44], [80, 41], [100, 42]])
    off = (cells + 0.5) * 0.025 - [2.05, 1.07]
    peak = np.exp(-0.5 * np.einsum("ni,ij,nj->n", off, np.linalg.inv(covariance), off))
    expected = np.log(search.SURFACE_FLOOR + (1 - search.SURFACE_FLOOR) * peak)
    log_likelihood = field.log_likelihood(np.zeros((1, 2)), np.column_stack([(cells + 0.5) * 0.025, np.zeros(4)]))
    scores = log_likelihood + np.log(search.SURFACE_FLOOR)
    np.testing.assert_allclose(scores, expected, atol=0.02)
    assert scores[3] == pytest.approx(np.log(search.SURFACE_FLOOR), abs=1e-9)
    states = np.zeros((2, grid.n_cells), dtype=np.float32)
    states[0, 20 * 30 + 10] = states[1, 25 * 30 + 10] = 1.0
    both = search.endpoint_field(states, grid, 0.02, *NOWHERE)
    each = [search.endpoint_field(one[None], grid, 0.02, *NOWHERE) for one in states]
    np.testing.assert_array_equal(both.values, np.maximum(each[0].values, each[1].values))
    assert (each[0].values != each[1].values).any()


def test_unknown_cells_are_worth_more_than_open_ones_and_less_than_walls():
    walls, grid = walls_of(4.0, 3.0)
    unknown = np.zeros(grid.shape, dtype=bool)
    unknown[20:30, 12:20] = True
    field = search.likelihood_field(walls.astype(float), grid, ~walls & ~unknown, unknown, 0.08)
    open_, behind, wall = field.fine[10, 15], field.fine[25, 15], field.fine[0, 15]
    assert open_ < behind < wall == search.MAX_VALUE
    assert field.coarse.max() == search.MAX_VALUE
    assert search.likelihood_field(walls.astype(float), grid, ~walls & ~unknown, unknown, 0.0).fine[25, 15] == open_
    assert search.likelihood_in_unknown(0.08, 0.12, 0.1) == pytest.approx(0.08 / 0.1 * 0.12 * np.sqrt(2 * np.pi))
    assert search.likelihood_in_unknown(0.5, 0.12, 0.1) == 1.0


def test_evenly_spread_draws_have_the_student_distribution_and_places_that_came_together_are_one():
    """Each coordinate over 600 calls that share no random number; false alarms: 1e-4 each."""
    rng = np.random.default_rng(0)
    draws = np.array([student_draws(16, rng)[7] for _ in range(600)])
    for k in range(3):
        assert scipy.stats.kstest(draws[:, k], scipy.stats.t(DOF).cdf).pvalue > 1e-4
    radius = (draws**2).sum(axis=1) / 3.0
    assert scipy.stats.kstest(radius, scipy.stats.f(3, DOF).cdf).pvalue > 1e-4
    assert scipy.stats.kstest(radius, scipy.stats.f(3, 4 * DOF).cdf).pvalue < 1e-4
    means = np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.0], [1.0, 0.0, np.pi], [1.0, 0.005, -np.pi + 0.001]])
    places = PoseMixture(means, np.tile(np.diag([0.01, 0.01, 0.01]), (4, 1, 1)), np.array([1.0, 2.0, 3.0, 2.5]))
    assert np.array_equal(without_duplicates(places).log_mass, [3.0, 2.0])


def test_unequal_draws_of_places_leave_the_integral_right():
    """A target of two normal distributions, three quarters and one, weighed by 60 and 20 draws: twelve such runs."""
    means = np.array([[0.0, 0.0, 0.0], [3.0, 1.0, 2.0]])
    covariances = np.tile(np.diag([0.04, 0.04, 0.01]), (2, 1, 1))
    places = PoseMixture(means, covariances, np.log([0.75, 0.25]))

    def target(poses):
        squared = ((poses[:, None] - means) ** 2 / np.diag(covariances[0])).sum(axis=2)
        constant = -1.5 * np.log(2 * np.pi) - 0.5 * np.log(np.diag(covariances[0])).sum()
        return np.log(np.exp(constant - 0.5 * squared) @ [0.75, 0.25])

    runs = [places.draw(target, np.array([60, 20]), np.random.default_rng(seed)) for seed in range(12)]
    assert all(np.bincount(run.place).tolist() == [60, 20] for run in runs)
    assert np.mean([np.exp(run.log_evidence) for run in runs]) == pytest.approx(1.0, abs=0.05)
    assert np.mean([run.weights[run.place == 0].sum() for run in runs]) == pytest.approx(0.75, abs=0.05)
    assert places.draw_counts(40).tolist() == [40, round(40 * np.sqrt(1 / 3))]


@pytest.mark.parametrize("uniform_share", [0.0, 0.4])
def test_the_density_of_a_prior_is_one_over_the_poses_on_the_map(uniform_share):
    walls, grid = walls_of(6.0, 5.0)
    here = known(walls, grid, scan_from(walls, grid, [3.0, 2.5, 0.0]))
    prior = Prior(bm.InitialPose([3.0, 2.5, 0.5], 0.3, 0.3).components(), uniform_share)
    steps = [np.arange(0.05, 6.0, 0.1), np.arange(0.05, 5.0, 0.1), np.arange(-np.pi, np.pi, np.pi / 32)]
    poses = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 3)
    assert np.exp(prior.log_density(poses, here)).sum() * 0.1**2 * np.pi / 32 == pytest.approx(1.0, abs=0.01)


def test_a_wide_prior_is_narrowed_about_the_pose_but_by_a_scan_with_few_hits():
    walls, grid = walls_of(4.0, 3.0)
    truth = np.array([1.52, 1.23, 0.4])
    scans = scan_from(walls, grid, truth)
    here = known(walls, grid, scans, beam_weight=0.3)
    guess = bm.InitialPose(truth + np.array([0.2, -0.15, 0.1]), 0.25, 0.15)
    prior = Prior(guess.components(), 0.0)
    scan = scan_of(scans)
    rng = np.random.default_rng(0)
    found = refine_by_end_points(guess.components(), lambda poses: prior.log_density(poses, here), here, scan, rng)
    assert len(found.means) == 1
    np.testing.assert_array_less(np.abs(found.means[0] - truth), [0.05, 0.05, 0.03])
    assert (np.sqrt(np.diag(found.covariances[0])) < [0.1, 0.1, 0.06]).all()
    blind, places = replace(scan, ranges_m=np.full(len(ANGLES), np.inf)), guess.components()
    assert refine_by_end_points(places, np.zeros_like, here, blind, rng) is places
