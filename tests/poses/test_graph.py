"""Pose graphs: sparse against dense, loops that are wrong, covariances."""

import numpy as np
import scipy

from bayesmap.poses import graph
from bayesmap.poses.graph import Factors, Precision, normal_equations, quadratic, relative_covariances, solve_step
from bayesmap.space.planar import between, between_jacobians, compose, retract

RNG = np.random.default_rng(8)
COUNT = 12


def circle():
    angle = np.arange(COUNT) * 2 * np.pi / COUNT
    return np.column_stack([3 * np.cos(angle), 3 * np.sin(angle), angle + np.pi / 2])


def factors(poses, first, second, sigma=0.02, noise=0.0):
    first, second = np.asarray(first), np.asarray(second)
    relative = compose(between(poses[first], poses[second]), noise * RNG.normal(size=(len(first), 3)))
    root = RNG.normal(size=(len(first), 3, 3)) * 0.3 + np.eye(3)
    return Factors(first, second, relative, root @ np.swapaxes(root, 1, 2) / sigma**2)


TRUTH = circle()
CHAIN = factors(TRUTH, np.arange(COUNT - 1), np.arange(1, COUNT), noise=0.02)
LOOP = factors(TRUTH, [0, 1, 2], [COUNT - 1, COUNT - 2, COUNT - 1])
POSES = retract(TRUTH, 0.05 * RNG.normal(size=TRUTH.shape))


def dense(parts, poses):
    matrix, gradient = np.eye(3 * COUNT) * graph.RIDGE, np.zeros(3 * COUNT)
    matrix[:3, :3] += np.eye(3) * graph.ANCHOR
    for part in parts:
        for k in range(len(part)):
            i, j = part.first[k], part.second[k]
            by_i, by_j = between_jacobians(between(poses[i], poses[j]))
            jacobian = np.zeros((3, 3 * COUNT))
            jacobian[:, 3 * i : 3 * i + 3], jacobian[:, 3 * j : 3 * j + 3] = by_i, by_j
            matrix += jacobian.T @ part.information[k] @ jacobian
            gradient += jacobian.T @ part.information[k] @ part.errors(poses)[k]
    return matrix, gradient


def test_a_sparse_step_and_relative_covariances_equal_the_dense_ones():
    matrix, gradient = dense([CHAIN, LOOP], POSES)
    step, _ = solve_step(COUNT, [quadratic(CHAIN, POSES), quadratic(LOOP, POSES)])
    np.testing.assert_allclose(step.ravel(), -np.linalg.solve(matrix, gradient), rtol=1e-6, atol=1e-9)
    covariance = np.linalg.inv(matrix)
    precision = Precision(normal_equations(COUNT, [quadratic(CHAIN, POSES), quadratic(LOOP, POSES)])[0])
    pairs = np.array([[0, 5], [3, 9], [11, 2], [4, 4], [6, 7], [0, 11]])
    found = relative_covariances(precision, POSES, pairs[:, 0], pairs[:, 1])
    for (i, j), block in zip(pairs, found, strict=True):
        by_i, by_j = between_jacobians(between(POSES[i], POSES[j]))
        jacobian = np.zeros((3, 3 * COUNT))
        jacobian[:, 3 * i : 3 * i + 3] += by_i
        jacobian[:, 3 * j : 3 * j + 3] += by_j
        np.testing.assert_allclose(block, jacobian @ covariance @ jacobian.T, rtol=1e-5, atol=1e-10)


def test_blocks_of_the_inverse_are_the_same_on_the_pattern_and_off_it():
    matrix = normal_equations(COUNT, [quadratic(CHAIN, POSES), quadratic(LOOP, POSES)])[0]
    inverse = np.linalg.inv(matrix.toarray()).reshape(COUNT, 3, COUNT, 3)
    first, second = (a.ravel() for a in np.mgrid[:COUNT, :COUNT])
    for at_once in (2, 400):
        found = Precision(matrix).blocks(first, second, at_once)
        np.testing.assert_allclose(found, inverse[first, :, second, :], rtol=1e-6, atol=1e-10)


def test_the_pattern_holds_every_entry_of_the_factor():
    """Random matrices: the pattern that elimination can fill, against the dense Cholesky factor."""
    for seed in range(5):
        rng = np.random.default_rng(seed)
        links = rng.random((30, 30)) < 0.06
        dense_matrix = np.where(links | links.T, 0.1 * rng.normal(), 0.0) + 5.0 * np.eye(30)
        place = rng.permutation(30)
        begin, row = graph.filled_pattern(scipy.sparse.csc_matrix(dense_matrix), place)
        moved = np.empty_like(dense_matrix)
        moved[np.ix_(place, place)] = dense_matrix
        held = np.zeros((30, 30), bool)
        held[row, np.repeat(np.arange(30), np.diff(begin))] = True
        np.testing.assert_array_equal(held, np.abs(np.linalg.cholesky(moved)) > 0)


def test_the_optimum_has_no_slope_and_a_wrong_loop_is_not_believed():
    poses, weights = graph.optimise(POSES, CHAIN, LOOP)
    assert (weights > 0.9).all()
    _, gradient = normal_equations(COUNT, [quadratic(CHAIN, poses), quadratic(LOOP, poses, weights)])
    _, before = normal_equations(COUNT, [quadratic(CHAIN, POSES), quadratic(LOOP, POSES)])
    assert np.abs(gradient[3:]).max() < 1e-3 * np.abs(before[3:]).max()
    wrong = Factors(np.array([0]), np.array([6]), np.array([[9.0, 4.0, 1.0]]), np.eye(3)[None] / 0.02**2)
    both = Factors(
        *(np.concatenate([getattr(LOOP, n), getattr(wrong, n)]) for n in ("first", "second", "relative", "information"))
    )
    poses, weights = graph.optimise(POSES, CHAIN, both)
    assert weights[-1] < 0.01
    assert (weights[:3] > 0.5).all()
    off = between(between(TRUTH[0], TRUTH), between(poses[0], poses))
    assert np.hypot(off[:, 0], off[:, 1]).max() < 0.15
