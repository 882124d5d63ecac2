"""Correlative matching is exact; aligned poses are as sure as the laser is, and scans between key scans are placed."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import warp as wp
from simulated import path_around, ring, scans_of
from tiers import full_but

import bayesmap as bm
from bayesmap.kernels.match.likelihood_grid import next_level, next_level_on_cpu
from bayesmap.kernels.match.line_pairs import PairRules, linearise_pairs
from bayesmap.kernels.match.view_comparison import Agreement, view_counts
from bayesmap.poses import alignment
from bayesmap.poses.alignment import Annealing, Pairs, PointError, align, overlapping_pairs, place_scans, point_error
from bayesmap.poses.graph import DEGREES_OF_FREEDOM, Factors
from bayesmap.poses.matcher import ModeRule, Pull, SearchWindows, likelihood_grids, match, score_at
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.space.planar import between, transform

ANGLES = np.linspace(-np.pi, np.pi, 120, endpoint=False)
STEP = np.radians(3.0)


def ranges_in_room(pose, width, depth, notch=0.0):
    """Distances to the walls of a room centred on the origin, with one notch in a corner to break its symmetry."""
    found = []
    for angle in ANGLES + pose[2]:
        u = np.array([np.cos(angle), np.sin(angle)])
        with np.errstate(divide="ignore", invalid="ignore"):
            sides = np.array([[-width, width], [-depth, depth]]) / 2
            t = ((sides - np.array(pose[:2])[:, None]) / u[:, None]).ravel()
        hit = t[t > 0].min()
        along = np.linspace(0, hit, 400)[:, None] * u + pose[:2]
        inside = (along[:, 0] > width / 2 - notch) & (along[:, 1] > depth / 2 - notch)
        found.append(hit if not inside.any() else np.linspace(0, hit, 400)[inside.argmax()])
    return np.array(found)


def room(poses, notch=0.0, noise_m=0.0, seed=1):
    rng = np.random.default_rng(seed)
    ranges = np.array([ranges_in_room(p, 4.0, 3.0, notch) for p in poses])
    return bm.Scans(np.array(poses), ANGLES, ranges + noise_m * rng.normal(size=ranges.shape), max_range_m=20.0)


POSES = np.array([[0.0, 0.0, 0.0], [0.3, -0.2, 0.5], [-0.5, 0.4, -1.0]])


@cache
def notched_geometry():
    return scan_geometry(room(POSES, notch=0.8, noise_m=0.01))


@cache
def notched_grids():
    return likelihood_grids(notched_geometry(), [[0, 1]], [POSES[:2]], [[0.0, 0.0]], 3.0, levels=4)


def everywhere(grid, points, centre, half_m, half_rad, pull):
    """The score of every shift and angle of a window, by the plain formula: (angles, x, y)."""
    cells, steps = round(half_m / notched_grids().resolution), int(half_rad / STEP + 1e-9)
    shifts = np.arange(-cells, cells + 1) * notched_grids().resolution
    off = np.arange(-steps, steps + 1) * STEP
    poses = np.stack(np.meshgrid(off, shifts, shifts, indexing="ij"), axis=-1)[..., [1, 2, 0]]
    score = score_at(notched_grids(), grid, points, (poses + centre).reshape(-1, 3)).reshape(poses.shape[:3])
    if pull is not None:
        score = score - pull.weight * (
            (poses[..., 0] ** 2 + poses[..., 1] ** 2) / (2 * pull.sigma_m**2)
            + poses[..., 2] ** 2 / (2 * pull.sigma_rad**2)
        )
    return score, poses + centre


@pytest.mark.parametrize("pull", [None, Pull(0.2, 0.3, 0.05)], ids=["alone", "pulled"])
@pytest.mark.parametrize("centre", [(0.1, 0.2, 0.3), (-0.4, 0.3, -0.9), (2.9, 2.9, 0.0)], ids=["a", "b", "border"])
def test_the_search_finds_what_looking_everywhere_finds(centre, pull):
    points = notched_geometry().points_of(2)
    score, poses = everywhere(0, points, np.array(centre), 0.5, 0.5, pull)
    found = match(notched_grids(), [points], SearchWindows([centre], 0.5, 0.5, STEP), min_score=-9.0, pull=pull)
    assert found.scores[0, 0] == pytest.approx(score.max(), abs=1e-12)
    first = np.unravel_index(np.argmax(score > score.max() - 1e-12), score.shape)
    np.testing.assert_allclose(found.poses[0, 0], poses[first], atol=1e-9)


def test_further_modes_are_the_best_that_lie_apart_and_not_looked_for_where_they_score_too_little():
    points = notched_geometry().points_of(2)
    centre = np.array([0.0, 0.0, 0.0])
    score, poses = everywhere(0, points, centre, 0.8, 0.7, None)
    several = ModeRule(9, apart_m=0.3, apart_rad=0.32)
    found = match(notched_grids(), [points], SearchWindows([centre], 0.8, 0.7, STEP), modes=several)
    left = score.copy()
    for m in range(9):
        assert found.scores[0, m] == pytest.approx(left.max(), abs=1e-12)
        off = np.abs(poses - found.poses[0, m])
        left[(off[..., :2] <= 0.3 + 1e-9).all(axis=-1) & (off[..., 2] <= 6 * STEP + 1e-9)] = -1
    windows, three = SearchWindows([np.zeros(3)], 1.0, 1.2, STEP), replace(several, max_modes=3)
    whole = match(notched_grids(), [points], windows, modes=three, min_score=0.1)
    ratio = whole.scores[0] / whole.scores[0, 0]
    assert ratio[1] > ratio[2] > 0.1
    for share in (ratio[1] - 1e-9, ratio[1] + 1e-9, ratio[2] - 1e-9):
        some = match(notched_grids(), [points], windows, modes=replace(three, min_score_ratio=share), min_score=0.1)
        np.testing.assert_array_equal(some.scores[0], np.where(ratio > share, whole.scores[0], -np.inf))


def test_the_result_does_not_depend_on_threads():
    points = [notched_geometry().points_of(k) for k in range(3)]
    centres = POSES + np.array([0.15, -0.1, 0.1])
    windows, two = SearchWindows(centres, 0.6, np.pi, STEP), ModeRule(2, apart_m=0.2)
    one = match(replace(notched_grids(), threads=1), points, windows, modes=two, threads_per_job=1)
    for threads, strands in ((2, 1), (2, 3), (4, 8)):
        grids = replace(notched_grids(), threads=threads)
        other = match(grids, points, windows, modes=two, threads_per_job=strands)
        np.testing.assert_array_equal(one.scores, other.scores)
        np.testing.assert_array_equal(one.poses, other.poses)


def test_scans_are_found_where_they_were_taken_and_nothing_is_where_nothing_scores():
    points = [notched_geometry().points_of(2)]
    nothing = match(notched_grids(), points, SearchWindows([[50.0, 0.0, 0.0]], 0.5, 0.5, STEP), min_score=0.1)
    assert not nothing.has_pose.any()
    assert np.isnan(nothing.poses).all()
    found = match(notched_grids(), points, SearchWindows([[0.0, 0.0, 0.0]], 1.2, np.pi, np.radians(1.0)))
    off = between(POSES[2], found.poses[0, 0])
    assert np.hypot(off[0], off[1]) < 0.06
    assert abs(off[2]) < np.radians(1.5)
    with pytest.raises(bm.BadInput, match="finite"):
        match(notched_grids(), [notched_geometry().points_of(2)], SearchWindows(np.full((1, 3), np.nan), 0.5, 0.5))


def test_maxima_by_numpy_are_those_of_the_kernel():
    pyramid = np.random.default_rng(3).integers(0, 255, (2, 2, 37, 21), dtype=np.uint8)
    for level in (1, 2, 4):
        stack = np.zeros((2, level + 1, 37, 21), np.uint8)
        stack[:, level - 1] = pyramid[:, 0]
        on_device = wp.array(stack, dtype=wp.uint8, device="cpu")
        wp.launch(next_level, dim=2 * 37, inputs=[0, level, on_device], device="cpu")
        found = np.empty((2, 37, 21), np.uint8)
        next_level_on_cpu(pyramid[:, 0], found, 1 << (level - 1))
        np.testing.assert_array_equal(found, on_device.numpy()[:, level])


def wall_scan(beams, jump_m=0.0):
    """A wall 4 m ahead, seen by beams 60 degrees wide; from the middle on it stands further back."""
    angles = np.radians(30.0) * np.linspace(-1.0, 1.0, beams)
    ranges = (4.0 + jump_m * (angles > 0)) / np.cos(angles)
    return scan_geometry(bm.Scans(np.zeros((1, 3)), angles, ranges[None], max_range_m=20.0))


@pytest.mark.parametrize("beams", [121, 30, 15], ids=["half a degree", "2 degrees", "4 degrees"])
def test_a_wall_is_drawn_whole_however_far_apart_beams_are(beams):
    """Beams 4 degrees apart end 30 cm apart: half a sigma along the wall from a stamp the value is exp(-1/8)."""
    geometry = wall_scan(beams)
    grids = likelihood_grids(geometry, [[0]], [np.zeros((1, 3))], [[0.0, 0.0]], 6.0)
    along = np.column_stack([np.full(200, 4.0), np.linspace(-2.2, 2.2, 200)])
    values = [score_at(grids, 0, point[None], np.zeros(3))[0] for point in along]
    assert min(values) > np.exp(-0.125) - 0.25  # and a cell's half diagonal
    assert score_at(grids, 0, np.array([[3.7, 0.0]]), np.zeros(3))[0] == 0.0
    geometry = wall_scan(beams, jump_m=1.5)  # nothing is drawn between walls one behind the other
    grids = likelihood_grids(geometry, [[0]], [np.zeros((1, 3))], [[0.0, 0.0]], 8.0)
    between_them = np.column_stack([np.linspace(4.3, 5.2, 10), np.zeros(10)])
    assert beams != 30 or [score_at(grids, 0, p[None], np.zeros(3))[0] for p in between_them] == [0.0] * 10


@pytest.mark.parametrize("beams", [121, 15], ids=["half a degree", "4 degrees"])
def test_points_on_a_wall_agree_with_it_between_beams(beams):
    """A scan moved along a wall: its points fall between beams of the other; 60 cm before it they contradict."""
    geometry = wall_scan(beams)
    one = np.zeros(1, np.int32)
    seen = Agreement(near_m=0.05, clear_m=0.4, beams=1000)
    for ahead, column in ((0.0, 0), (-0.6, 1)):
        counts = view_counts(geometry, one, one, np.array([[ahead, 0.14, 0.0]]), seen)[0]
        assert counts[column] > 0.7 * counts[2], counts  # at the wall's ends beams meet nothing
        assert counts[1 - column] == 0, counts


TRUTH = path_around()
SCALE, ALIKE = 0.1, 0.7


def plain(geometry, i, j, z, reach):
    """The sums by NumPy: nearest point of all of j, mean normal, Geman and McClure's weight."""
    points, normals, kind = geometry.host_points, geometry.normals.numpy(), geometry.host_kind
    second, first, cost = np.zeros((3, 3)), np.zeros(3), 0.0
    there = points[j][kind[j] > 0]
    index = np.nonzero(kind[j] > 0)[0]
    turn = np.array([[np.cos(z[2]), -np.sin(z[2])], [np.sin(z[2]), np.cos(z[2])]])
    for b in np.nonzero(kind[i] > 0)[0]:
        x = transform(z, points[i, b].astype(float))
        k = np.argmin(((there - x) ** 2).sum(axis=1))
        near = index[k]
        if ((there[k] - x) ** 2).sum() >= reach**2 or kind[j, near] != kind[i, b]:
            continue
        if kind[i, b] == 1:  # no walls: point to point
            sides = [m for m in (near - 1, near + 1) if 0 <= m < kind.shape[1] and kind[j, m] > 0]
            apart = 0.5 * max(0.1, min([2.0, *(np.linalg.norm(points[j, m] - points[j, near]) for m in sides)]))
            if apart > 0.15:
                continue
            d, r = x - there[k], x - z[:2]
            w = (1 + d @ d / (SCALE**2 + apart**2)) ** -2 * 0.01**2 / apart**2
            jacobian = np.array([[1, 0, -r[1]], [0, 1, r[0]]])
            second += w * jacobian.T @ jacobian
            first += w * jacobian.T @ d
            continue
        own = turn @ normals[i, b]
        if own @ normals[j, near] < ALIKE:
            continue
        u = own + normals[j, near]
        u /= np.linalg.norm(u)
        e = u @ (x - there[k])
        r = x - z[:2]
        jacobian = np.array([u[0], u[1], u[1] * r[0] - u[0] * r[1]])
        w = (1 + e**2 / SCALE**2) ** -2
        second += w * np.outer(jacobian, jacobian)
        first += w * e * jacobian
        cost += w * e * e
    return second, first, cost


@pytest.mark.parametrize(("full", "reach"), [(False, 0.3), (True, 0.08), (True, 0.6)])
def test_sums_equal_the_plain_formula(full, reach):
    angles, ranges = scans_of(ring(), TRUTH[:12], noise_m=0.02 if full else 0.005, full=full)
    geometry = scan_geometry(bm.Scans(TRUTH[:12], angles, ranges, max_range_m=12.0))
    for i, j in ((3, 1), (5, 2), (11, 8)):
        z = between(TRUTH[j], TRUTH[i]) + np.array([0.02, -0.03, 0.01])
        pair = np.array([i], np.int32), np.array([j], np.int32), z[None]
        found_second, _, found_first, totals = linearise_pairs(geometry, None, *pair, PairRules(reach, SCALE, ALIKE))
        second, first, cost = plain(geometry, i, j, z, reach)
        np.testing.assert_allclose(found_second[0], second, rtol=2e-3, atol=2e-2)
        np.testing.assert_allclose(found_first[0], first, rtol=2e-3, atol=2e-3)
        np.testing.assert_allclose(totals[0, 0], cost, rtol=2e-3, atol=1e-4)


def test_along_a_corridor_there_is_only_slack():
    """Two walls along x: what the sums claim about x is what noisy normals add, and is taken off, in every pair.

    A tenth of it that stayed would add up: hundreds of pairs made a corridor's length look certain to centimetres.
    """
    rng = np.random.default_rng(2)
    angles = np.linspace(-np.pi, np.pi, 360, endpoint=False)
    exact = 1.0 / np.maximum(np.abs(np.sin(angles)), 1e-3)
    noisy = np.where(exact < 8.0, exact, np.inf) + 0.01 * rng.normal(size=(40, 360))
    geometry = scan_geometry(bm.Scans(np.zeros((40, 3)), angles, noisy, max_range_m=10.0))
    one, two = np.arange(20, dtype=np.int32), np.arange(20, 40, dtype=np.int32)
    second, slack, first, _ = linearise_pairs(geometry, None, one, two, np.zeros((20, 3)), PairRules(0.1, 0.05, 0.7))
    told, gradient = alignment.without_slack(second, slack, first, 0.01)
    along, across = second[:, 0, 0].mean(), second[:, 1, 1].mean()
    assert along < 1e-3 * across
    assert told[:, 0, 0].mean() < 0.02 * along
    np.testing.assert_allclose(told[:, 1, 1], second[:, 1, 1], rtol=0.05)
    assert np.isfinite(gradient).all()


APART, NARROW = 5, Annealing(8, reach_m=(0.15, 0.08), scale_m=(0.06, 0.03))
NONE = Factors(np.empty(0, np.intp), np.empty(0, np.intp), np.empty((0, 3)), np.empty((0, 3, 3)))


@cache
def aligned(noise_m):
    """Scans round a building, aligned from the truth, without odometry."""
    truth = path_around(laps=1.0)
    angles, ranges = scans_of(ring(), truth, noise_m=noise_m, max_range_m=12.0)
    geometry = scan_geometry(bm.Scans(truth, angles, ranges, max_range_m=12.0))
    pairs = overlapping_pairs(geometry, truth, 3.0)
    return truth, geometry, align(geometry, truth, NONE, lambda _: pairs, NARROW)


def squares(truth, gaussian):
    """Mean squared errors of relative poses by their scale matrices, as multiples of what Student's t expects."""
    first, second = np.arange(len(truth) - APART), np.arange(APART, len(truth))
    off = between(gaussian.poses[first], gaussian.poses[second]) - between(truth[first], truth[second])
    scale = gaussian.relative_scales(first, second)
    expected = 3.0 * gaussian.dof / (gaussian.dof - 2.0)
    return float(np.einsum("mi,mij,mj->m", off, np.linalg.inv(scale), off).mean()) / expected


def test_the_point_error_grows_with_the_noise_unlike_residuals_and_a_fifth_of_the_pairs_tells_it(monkeypatch):
    found = {noise: aligned(noise) for noise in (0.01, 0.04)}
    errors = [point_error(geometry, one).sigma_m / noise for noise, (_, geometry, one) in found.items()]
    assert errors[1] == pytest.approx(errors[0], rel=0.05)
    left = [one.sigma_m / noise for noise, (_, _, one) in found.items()]
    assert left[1] < 0.85 * left[0]
    _, geometry, noisy = found[0.04]
    every = point_error(geometry, noisy)
    monkeypatch.setattr(alignment, "MIN_ERROR_PAIRS", len(noisy.pairs) // 5)
    some = point_error(geometry, noisy)
    assert some.sigma_m != every.sigma_m
    assert some.sigma_m == pytest.approx(every.sigma_m, rel=0.05)
    assert some.response == pytest.approx(every.response, rel=0.05)


@pytest.mark.parametrize("noise_m", [0.01, 0.04])
def test_covariances_have_the_size_of_the_errors_for_any_noise(noise_m):
    """The twin: residuals alone claim twice too much of a noisy laser."""
    truth, geometry, found = aligned(noise_m)
    assert 0.7 < squares(truth, alignment.with_point_error(found, point_error(geometry, found))) < 1.5
    assert noise_m < 0.04 or squares(truth, found.gaussian) > 1.8


def test_only_the_laser_s_part_is_scaled_and_scans_that_share_nothing_keep_the_residuals_error():
    _, geometry, found = aligned(0.01)
    laser = len(found.pairs)
    tied = found.gaussian
    by_wheels = replace(
        tied,
        first=np.append(tied.first, 0), second=np.append(tied.second, 1),
        relative=np.append(tied.relative, np.zeros((1, 3)), axis=0),
        curvature=np.append(tied.curvature, np.eye(3)[None], axis=0),
        force=np.append(tied.force, np.zeros((1, 3)), axis=0),
    )  # fmt: skip
    error = PointError(found.sigma_m, np.array([0.5, 0.5, 0.25]))
    scaled = alignment.with_point_error(replace(found, gaussian=by_wheels), error)
    share = tied.dof / (tied.dof - 2.0) / (1.0 - alignment.SHARED_ERROR_SHARE)
    ratio = np.array([[4.0, 4.0, 2.0], [4.0, 4.0, 2.0], [2.0, 2.0, 1.0]]) / 16.0
    assert np.allclose(scaled.curvature[:laser], share * ratio * tied.curvature)
    assert np.allclose(scaled.force[:laser], share * np.diag(ratio) * tied.force)
    assert np.array_equal(scaled.curvature[laser], np.eye(3))
    none = Pairs(np.empty(0, np.int32), np.empty(0, np.int32), np.zeros(len(geometry) + 1, np.int32))
    assert point_error(geometry, replace(found, pairs=none)).sigma_m == found.sigma_m


EVERY = 4
"""Scans from one key scan to the next."""


@cache
def placed(noise_m):
    """Scans round a building, those between key scans placed among these, whose poses are the true ones."""
    truth = path_around(laps=2.0, step_m=0.1)
    angles, ranges = scans_of(ring(), truth, noise_m=noise_m, max_range_m=12.0)
    geometry = scan_geometry(bm.Scans(truth, angles, ranges, max_range_m=12.0))
    keys = np.arange(0, len(truth), EVERY)
    key_geometry = geometry.select(keys)
    pairs = overlapping_pairs(key_geometry, truth[keys], 3.0)
    aligned = align(key_geometry, truth[keys], NONE, lambda _: pairs, NARROW)
    error = point_error(key_geometry, aligned)
    return truth, keys, place_scans(geometry, truth, keys, replace(aligned, poses=truth[keys]), error)


@pytest.mark.parametrize("noise_m", full_but([0.01, 0.03], 0.01))
def test_scans_between_key_scans_err_by_their_covariance_and_key_scans_stay(noise_m):
    truth, keys, found = placed(noise_m)
    others = np.setdiff1d(np.arange(len(truth)), keys)
    off = between(truth[others], found.poses[others])
    precision = np.linalg.inv(found.own_covariance(keys)[others])
    expected = 3.0 * DEGREES_OF_FREEDOM / (DEGREES_OF_FREEDOM - 2.0)  # of Student's t with this scale matrix
    assert 0.7 < np.einsum("mi,mij,mj->m", off, precision, off).mean() / expected < 1.4
    np.testing.assert_array_equal(found.poses[keys], truth[keys])
    assert not found.own_covariance(keys)[keys].any()
