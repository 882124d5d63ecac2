"""Point-to-line pairs: derivatives, and what errors of normals add to them."""

from functools import cache

import numpy as np
from simulated import path_around, ring, scans_of

from bayesmap.kernels.match.line_pairs import pair_sums
from bayesmap.poses.alignment import without_slack
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.space.planar import between, transform
from bayesmap.space.scans import Scans

TRUTH = path_around()
REACH, SCALE, ALIKE = 0.3, 0.1, 0.7


@cache
def ring_geometry():
    """Return the points and normals of twelve scans along the path."""
    angles, ranges = scans_of(ring(), TRUTH[:12], noise_m=0.005)
    return scan_geometry(Scans(TRUTH[:12], angles, ranges, max_range_m=12.0))


def plain(i, j, z):
    """The sums by NumPy: nearest point of j, mean normal, Geman and McClure's weight."""
    geometry = ring_geometry()
    points, normals, kind = geometry.host_points, geometry.host_normals, geometry.host_kind
    second, first, cost = np.zeros((3, 3)), np.zeros(3), 0.0
    there = points[j][kind[j] > 0]
    index = np.nonzero(kind[j] > 0)[0]
    turn = np.array([[np.cos(z[2]), -np.sin(z[2])], [np.sin(z[2]), np.cos(z[2])]])
    for b in np.nonzero(kind[i] > 0)[0]:
        x = transform(z, points[i, b].astype(float))
        k = np.argmin(((there - x) ** 2).sum(axis=1))
        near = index[k]
        if ((there[k] - x) ** 2).sum() >= REACH**2 or kind[j, near] != kind[i, b]:
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


def kernel(i, j, z):
    one = [np.array([k], np.int32) for k in (i, j)]
    second, slack, first, totals = pair_sums(ring_geometry(), None, *one, np.array([z]), REACH, SCALE, ALIKE)
    return second[0], slack[0], first[0], totals[0]


def test_sums_equal_the_plain_formula():
    for i, j in ((3, 1), (5, 2), (11, 8)):
        z = between(TRUTH[j], TRUTH[i]) + np.array([0.02, -0.03, 0.01])
        second, first, cost = plain(i, j, z)
        found_second, _, found_first, totals = kernel(i, j, z)
        np.testing.assert_allclose(found_second, second, rtol=2e-3, atol=2e-2)
        np.testing.assert_allclose(found_first, first, rtol=2e-3, atol=2e-3)
        np.testing.assert_allclose(totals[0], cost, rtol=2e-3, atol=1e-4)


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
    """Two walls along x: what the sums claim about x is what noisy normals add, and is taken off."""
    rng = np.random.default_rng(2)
    angles = np.linspace(-np.pi, np.pi, 360, endpoint=False)
    exact = 1.0 / np.maximum(np.abs(np.sin(angles)), 1e-3)
    ranges = np.where(exact < 8.0, exact, np.inf)
    noisy = ranges + 0.01 * rng.normal(size=(40, 360))
    geometry = scan_geometry(Scans(np.zeros((40, 3)), angles, noisy, max_range_m=10.0))
    one, two = np.arange(20, dtype=np.int32), np.arange(20, 40, dtype=np.int32)
    second, slack, first, _ = pair_sums(geometry, None, one, two, np.zeros((20, 3)), 0.1, 0.05, 0.7)
    told, gradient = without_slack(second, slack, first, 0.01)
    along, across = second[:, 0, 0].mean(), second[:, 1, 1].mean()
    assert told[:, 0, 0].mean() < along < 1e-3 * across
    np.testing.assert_allclose(told[:, 1, 1], second[:, 1, 1], rtol=0.05)
    assert np.isfinite(gradient).all()
