"""Point-to-line pairs, what the laser claims of aligned poses, and scans placed between key scans."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from simulated import path_around, ring, scans_of
from tiers import full_but

from bayesmap.kernels.match.line_pairs import pair_sums
from bayesmap.poses import alignment
from bayesmap.poses.alignment import (
    Pairs,
    PointError,
    align,
    overlapping_pairs,
    place_scans,
    point_error,
    with_point_error,
)
from bayesmap.poses.graph import DEGREES_OF_FREEDOM, Factors
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.space.planar import between, transform
from bayesmap.space.scans import Scans

TRUTH = path_around()
SCALE, ALIKE = 0.1, 0.7


@cache
def ring_geometry(full):
    """Return the points and normals of twelve scans along the path, of half a circle or a full one."""
    angles, ranges = scans_of(ring(), TRUTH[:12], noise_m=0.02 if full else 0.005, full=full)
    return scan_geometry(Scans(TRUTH[:12], angles, ranges, max_range_m=12.0))


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
    geometry = ring_geometry(full)
    for i, j in ((3, 1), (5, 2), (11, 8)):
        z = between(TRUTH[j], TRUTH[i]) + np.array([0.02, -0.03, 0.01])
        pair = np.array([i], np.int32), np.array([j], np.int32), z[None]
        found_second, _, found_first, totals = pair_sums(geometry, None, *pair, reach, SCALE, ALIKE)
        second, first, cost = plain(geometry, i, j, z, reach)
        np.testing.assert_allclose(found_second[0], second, rtol=2e-3, atol=2e-2)
        np.testing.assert_allclose(found_first[0], first, rtol=2e-3, atol=2e-3)
        np.testing.assert_allclose(totals[0, 0], cost, rtol=2e-3, atol=1e-4)


def test_first_derivatives_equal_finite_differences_of_the_cost_with_fixed_pairs_and_normals():
    """A flat wall seen from two places: pairs do not change, and weights are near one."""
    angles = np.linspace(-0.5, 0.5, 41)
    poses = np.array([[0.0, 0.0, 0.0], [0.0, 0.1, 0.0]])
    wall = 3.0 / np.cos(angles)
    geometry = scan_geometry(Scans(poses, angles, np.stack([wall, wall]), max_range_m=10.0))
    z = np.array([0.01, 0.0, 0.004])
    arrays = [np.array([1], np.int32), np.array([0], np.int32)]

    def sums(at):
        return pair_sums(geometry, None, *arrays, at[None], 0.3, 100.0, 0.7)

    _, _, first, totals = sums(z)
    assert totals[0, 2] >= 35
    for axis in (0, 2):
        h = np.zeros(3)
        h[axis] = 1e-3
        slope = (sums(z + h)[3][0, 0] - sums(z - h)[3][0, 0]) / 2e-3 / 2
        np.testing.assert_allclose(first[0, axis], slope, rtol=0.05)


def test_along_a_corridor_there_is_only_slack():
    """Two walls along x: what the sums claim about x is what noisy normals add, and is taken off, in every pair.

    A tenth of it that stayed would add up: hundreds of pairs made a corridor's length look certain to centimetres.
    """
    rng = np.random.default_rng(2)
    angles = np.linspace(-np.pi, np.pi, 360, endpoint=False)
    exact = 1.0 / np.maximum(np.abs(np.sin(angles)), 1e-3)
    ranges = np.where(exact < 8.0, exact, np.inf)
    noisy = ranges + 0.01 * rng.normal(size=(40, 360))
    geometry = scan_geometry(Scans(np.zeros((40, 3)), angles, noisy, max_range_m=10.0))
    one, two = np.arange(20, dtype=np.int32), np.arange(20, 40, dtype=np.int32)
    second, slack, first, _ = pair_sums(geometry, None, one, two, np.zeros((20, 3)), 0.1, 0.05, 0.7)
    told, gradient = alignment.without_slack(second, slack, first, 0.01)
    along, across = second[:, 0, 0].mean(), second[:, 1, 1].mean()
    assert along < 1e-3 * across
    assert told[:, 0, 0].mean() < 0.02 * along
    np.testing.assert_allclose(told[:, 1, 1], second[:, 1, 1], rtol=0.05)
    assert np.isfinite(gradient).all()


APART = 5
NONE = Factors(np.empty(0, np.intp), np.empty(0, np.intp), np.empty((0, 3)), np.empty((0, 3, 3)))


@cache
def aligned(noise_m):
    """Scans round a building, aligned from the truth, without odometry."""
    truth = path_around(laps=1.0)
    angles, ranges = scans_of(ring(), truth, noise_m=noise_m, max_range_m=12.0)
    geometry = scan_geometry(Scans(truth, angles, ranges, max_range_m=12.0))
    pairs = overlapping_pairs(geometry, truth, 3.0)
    return truth, geometry, align(geometry, truth, NONE, pairs, rounds=8, reach_m=(0.15, 0.08), scale_m=(0.06, 0.03))


def squares(truth, gaussian):
    """Mean squared errors of relative poses by their scale matrices, as multiples of what Student's t expects."""
    first, second = np.arange(len(truth) - APART), np.arange(APART, len(truth))
    off = between(gaussian.poses[first], gaussian.poses[second]) - between(truth[first], truth[second])
    scale = gaussian.relative_covariances(first, second)
    expected = 3.0 * gaussian.dof / (gaussian.dof - 2.0)
    return float(np.einsum("mi,mij,mj->m", off, np.linalg.inv(scale), off).mean()) / expected


def test_the_point_error_grows_with_the_noise_and_the_residuals_do_not():
    found = {noise: aligned(noise) for noise in (0.01, 0.04)}
    errors = [point_error(geometry, one).sigma_m / noise for noise, (_, geometry, one) in found.items()]
    assert errors[1] == pytest.approx(errors[0], rel=0.05)
    left = [one.sigma_m / noise for noise, (_, _, one) in found.items()]
    assert left[1] < 0.85 * left[0]


def test_a_fifth_of_the_pairs_tells_the_point_error(monkeypatch):
    _, geometry, found = aligned(0.04)
    every = point_error(geometry, found)
    monkeypatch.setattr(alignment, "ERROR_PAIRS", len(found.pairs) // 5)
    some = point_error(geometry, found)
    assert some.sigma_m != every.sigma_m
    assert some.sigma_m == pytest.approx(every.sigma_m, rel=0.05)
    assert some.response == pytest.approx(every.response, rel=0.05)


@pytest.mark.parametrize("noise_m", [0.01, 0.04])
def test_covariances_have_the_size_of_the_errors_for_any_noise(noise_m):
    """The twin: residuals alone claim twice too much of a noisy laser."""
    truth, geometry, found = aligned(noise_m)
    assert 0.7 < squares(truth, with_point_error(found, point_error(geometry, found))) < 1.5
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
    scaled = with_point_error(replace(found, gaussian=by_wheels), error)
    share = tied.dof / (tied.dof - 2.0) / (1.0 - alignment.COUNTED_AGAIN)
    ratio = np.array([[4.0, 4.0, 2.0], [4.0, 4.0, 2.0], [2.0, 2.0, 1.0]]) / 16.0
    assert np.allclose(scaled.curvature[:laser], share * ratio * tied.curvature)
    assert np.allclose(scaled.force[:laser], share * np.diag(ratio) * tied.force)
    assert np.array_equal(scaled.curvature[laser], np.eye(3))
    nothing = replace(
        found, pairs=Pairs(np.empty(0, np.int32), np.empty(0, np.int32), np.zeros(len(geometry) + 1, np.int32))
    )
    assert point_error(geometry, nothing).sigma_m == found.sigma_m


EVERY = 4
"""So many scans from one key scan to the next."""


@cache
def placed(noise_m):
    """Scans round a building, those between key scans placed among these, whose poses are the true ones."""
    truth = path_around(laps=2.0, step_m=0.1)
    angles, ranges = scans_of(ring(), truth, noise_m=noise_m, max_range_m=12.0)
    geometry = scan_geometry(Scans(truth, angles, ranges, max_range_m=12.0))
    keys = np.arange(0, len(truth), EVERY)
    key_geometry = geometry.select(keys)
    pairs = overlapping_pairs(key_geometry, truth[keys], 3.0)
    aligned = align(key_geometry, truth[keys], NONE, pairs, rounds=8, reach_m=(0.15, 0.08), scale_m=(0.06, 0.03))
    error = point_error(key_geometry, aligned)
    return truth, keys, place_scans(geometry, truth, keys, replace(aligned, poses=truth[keys]), error)


@pytest.mark.parametrize("noise_m", full_but([0.01, 0.03], 0.01))
def test_scans_between_key_scans_err_by_their_covariance(noise_m):
    truth, keys, found = placed(noise_m)
    others = np.setdiff1d(np.arange(len(truth)), keys)
    off = between(truth[others], found.poses[others])
    precision = np.linalg.inv(found.own_covariance(keys)[others])
    expected = 3.0 * DEGREES_OF_FREEDOM / (DEGREES_OF_FREEDOM - 2.0)  # of Student's t with this scale matrix
    assert 0.7 < np.einsum("mi,mij,mj->m", off, precision, off).mean() / expected < 1.4


def test_key_scans_stay_where_they_are():
    truth, keys, found = placed(0.01)
    np.testing.assert_array_equal(found.poses[keys], truth[keys])
    assert not found.own_covariance(keys)[keys].any()
