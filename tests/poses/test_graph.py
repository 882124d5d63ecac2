"""Pose graphs, sparse against dense; wrong loops, covariances, scans that nothing explains, and priors of poses."""

from dataclasses import replace
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
import scipy
from simulated import ring, scans_of

import bayesmap as bm
from bayesmap.poses import graph
from bayesmap.poses.alignment import Alignment, Pairs, PointError, place_scans
from bayesmap.poses.graph import Factors, PoseStudentT, bend_covariances, normal_equations, quadratic
from bayesmap.poses.key_alignment import flag_unexplained
from bayesmap.poses.map_scans import select_key_scans
from bayesmap.poses.odometry_factors import compose_factors
from bayesmap.poses.prior import FREE_SIGMA, KnownPoses, Motions, Odometry, UncertainPoses
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.trajectory import with_arcs
from bayesmap.space.planar import between, between_jacobians, compose, wrap_angle

RNG = np.random.default_rng(8)
COUNT = 12


def factors(poses, first, second, sigma=0.02, noise=0.0):
    first, second = np.asarray(first), np.asarray(second)
    relative = compose(between(poses[first], poses[second]), noise * RNG.normal(size=(len(first), 3)))
    root = RNG.normal(size=(len(first), 3, 3)) * 0.3 + np.eye(3)
    return Factors(first, second, relative, root @ np.swapaxes(root, 1, 2) / sigma**2)


TURN = np.arange(COUNT) * 2 * np.pi / COUNT
CIRCLE = np.column_stack([3 * np.cos(TURN), 3 * np.sin(TURN), TURN + np.pi / 2])
CHAIN = factors(CIRCLE, np.arange(COUNT - 1), np.arange(1, COUNT), noise=0.02)
LOOP = factors(CIRCLE, [0, 1, 2], [COUNT - 1, COUNT - 2, COUNT - 1])
STATES = compose(CIRCLE, 0.05 * RNG.normal(size=CIRCLE.shape))


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


def test_the_covariance_of_a_step_is_that_of_its_motions_drawn_with_noise():
    """Of 20 000 draws; every entry within five standard errors: under four false alarms in a million seeds."""
    rng, n = np.random.default_rng(3), 20_000
    motions, variances = np.array([[1.0, 0.0, 0.6], [1.0, 0.2, -0.3], [0.5, 0.1, 0.2]]), np.full((3, 3), 1e-4)
    covariance = np.linalg.inv(compose_factors(motions, variances, np.array([0, 3])).information[0])
    ends = np.zeros((n, 3))
    for motion in motions:
        ends = compose(ends, motion + 0.01 * rng.normal(size=(n, 3)))
    errors = np.sqrt((np.outer(covariance.diagonal(), covariance.diagonal()) + covariance**2) / n)
    assert (np.abs(np.cov(ends.T) - covariance) < 5 * errors).all()


def test_a_sparse_step_and_relative_covariances_equal_the_dense_ones():
    matrix, gradient = dense([CHAIN, LOOP], STATES)
    step, _ = graph.solve_step(COUNT, [quadratic(CHAIN, STATES), quadratic(LOOP, STATES)])
    np.testing.assert_allclose(step.ravel(), -np.linalg.solve(matrix, gradient), rtol=1e-6, atol=1e-9)
    covariance = np.linalg.inv(matrix)
    precision = graph.Precision(normal_equations(COUNT, [quadratic(CHAIN, STATES), quadratic(LOOP, STATES)])[0])
    pairs = np.array([[0, 5], [3, 9], [11, 2], [4, 4], [6, 7], [0, 11]])
    found = graph.relative_covariances(precision, STATES, pairs[:, 0], pairs[:, 1])
    for (i, j), block in zip(pairs, found, strict=True):
        by_i, by_j = between_jacobians(between(STATES[i], STATES[j]))
        jacobian = np.zeros((3, 3 * COUNT))
        jacobian[:, 3 * i : 3 * i + 3] += by_i
        jacobian[:, 3 * j : 3 * j + 3] += by_j
        np.testing.assert_allclose(block, jacobian @ covariance @ jacobian.T, rtol=1e-5, atol=1e-10)


def test_blocks_of_the_inverse_are_the_same_on_the_pattern_and_off_it():
    matrix = normal_equations(COUNT, [quadratic(CHAIN, STATES), quadratic(LOOP, STATES)])[0]
    inverse = np.linalg.inv(matrix.toarray()).reshape(COUNT, 3, COUNT, 3)
    first, second = (a.ravel() for a in np.mgrid[:COUNT, :COUNT])
    for at_once in (2, 400):
        found = graph.Precision(matrix).blocks(first, second, at_once)
        np.testing.assert_allclose(found, inverse[first, :, second, :], rtol=1e-6, atol=1e-10)


def test_the_optimum_has_no_slope_and_a_wrong_loop_is_not_believed():
    poses, weights = graph.optimise(STATES, CHAIN, LOOP)
    assert (weights > 0.9).all()
    _, gradient = normal_equations(COUNT, [quadratic(CHAIN, poses), quadratic(LOOP, poses, weights)])
    _, before = normal_equations(COUNT, [quadratic(CHAIN, STATES), quadratic(LOOP, STATES)])
    assert np.abs(gradient[3:]).max() < 1e-3 * np.abs(before[3:]).max()
    wrong = Factors(np.array([0]), np.array([6]), np.array([[9.0, 4.0, 1.0]]), np.eye(3)[None] / 0.02**2)
    names = ("first", "second", "relative", "information")
    both = Factors(*(np.concatenate([getattr(part, name) for part in (LOOP, wrong)]) for name in names))
    poses, weights = graph.optimise(STATES, CHAIN, both)
    assert weights[-1] < 0.01
    assert (weights[:3] > 0.5).all()
    off = between(between(CIRCLE[0], CIRCLE), between(poses[0], poses))
    assert np.hypot(off[:, 0], off[:, 1]).max() < 0.15


LAPS, ON_A_LAP, NEAR_M, STEP_M = 6, 24, 2.0, 0.5
POSES = LAPS * ON_A_LAP
SIGMA = np.array([0.01, 0.01, 0.01])


def way():
    """Round and round, each pose paired with all near it: only where there are many pairs do errors in common show."""
    angle = 2 * np.pi * np.arange(POSES) / ON_A_LAP
    radius = STEP_M * ON_A_LAP / (2 * np.pi)
    truth = np.column_stack([radius * np.sin(angle), -radius * np.cos(angle), angle])
    apart = np.hypot(*np.moveaxis(truth[:, None, :2] - truth[None, :, :2], -1, 0))
    return truth, *np.nonzero(np.triu(apart < NEAR_M, 1))


def aligned(seed, *, in_common):
    """Poses aligned to relative poses that err, all pairs of two stretches alike or each by itself."""
    truth, first, second = way()
    rng = np.random.default_rng(seed)
    stretch = (STEP_M * np.arange(POSES) / graph.STRETCH_M).astype(int)
    _, cluster = np.unique(np.stack([stretch[first], stretch[second]]), axis=1, return_inverse=True)
    cluster = cluster.ravel() if in_common else np.arange(len(first))
    errors = SIGMA * rng.standard_normal((cluster.max() + 1, 3))[cluster]
    measured = between(truth[first], truth[second]) + errors
    curvature, poses = np.tile(np.diag(SIGMA**-2.0), (len(first), 1, 1)), truth
    for _ in range(5):
        relative = between(poses[first], poses[second])
        force = np.einsum("mij,mj->mi", curvature, relative - measured)
        gaussian = PoseStudentT(poses, first, second, relative, curvature, force)
        poses = compose(poses, graph.solve_step(POSES, [graph.Quadratic(first, second, relative, curvature, force)])[0])
    return truth, gaussian


def squares(truth, gaussian):
    """Squared errors of relative poses over metres by their scale matrices, as multiples of what is expected."""
    first, second = np.arange(0, POSES - 32, 7), np.arange(32, POSES, 7)
    off = between(gaussian.poses[first], gaussian.poses[second]) - between(truth[first], truth[second])
    return np.einsum("mi,mij,mj->m", off, np.linalg.inv(gaussian.relative_scales(first, second)), off) / 3.0


@pytest.mark.full
@pytest.mark.parametrize(("in_common", "low", "high"), [(True, 0.5, 2.0), (False, 0.5, 1.2)])
def test_covariances_have_the_size_of_errors(in_common, low, high):
    """Means over 40 alignments; by their spread over seeds a false alarm has a chance under 1 in 10 000."""
    assert low < np.mean([squares(*aligned(seed, in_common=in_common)).mean() for seed in range(40)]) < high


def test_covariances_without_shared_errors_are_far_too_small():
    found = [aligned(seed, in_common=True) for seed in range(10)]
    assert np.mean([squares(truth, replace(g, force=np.zeros_like(g.force))).mean() for truth, g in found]) > 4.0


def test_bends_move_relative_poses_as_they_move_poses_and_without_forces_there_are_none():
    _, gaussian = aligned(2, in_common=True)
    first, second, small = np.array([3, 40]), np.array([70, 12]), 1e-4
    moved = [compose(gaussian.poses, small * bend) for bend in gaussian.bends]
    now = between(gaussian.poses[first], gaussian.poses[second])
    off = np.stack([between(poses[first], poses[second]) - now for poses in moved]) / small
    brute = np.einsum("nmi,nmj->mij", off, off) / len(off)
    np.testing.assert_allclose(bend_covariances(gaussian.bends, gaussian.poses, first, second), brute, rtol=2e-3)
    assert not replace(gaussian, force=np.zeros_like(gaussian.force)).bends.any()


SCALE_SIGMA, STEPS = 0.05, 20


def corridor(*, seen_m):
    """A way of 10 m along x, known by odometry alone whose scale is uncertain, and which the laser measures once."""
    order = np.arange(STEPS)
    poses = np.column_stack([np.arange(STEPS + 1) * STEP_M, np.zeros(STEPS + 1), np.zeros(STEPS + 1)])
    first, second = np.append(0, order), np.append(STEPS, order + 1)
    curvature = np.tile(np.diag([1e4, 1e4, 1e6]), (STEPS + 1, 1, 1))
    curvature[0] = np.diag([seen_m**-2.0, 1.0, 1.0])
    relative = between(poses[first], poses[second])
    gaussian = PoseStudentT(poses, first, second, relative, curvature, np.zeros((STEPS + 1, 3)))
    return replace(gaussian, by_odometry=gaussian.steps_from_changes(SCALE_SIGMA * relative[None, 1:])), gaussian


def test_a_length_that_odometry_alone_knows_is_as_uncertain_as_its_scale_and_one_that_the_laser_knows_is_not():
    found, plain = corridor(seen_m=1e3)
    added = found.relative_scales([0, 5], [STEPS, 9]) - plain.relative_scales([0, 5], [STEPS, 9])
    lengths = np.array([STEPS * STEP_M, 4 * STEP_M])
    np.testing.assert_allclose(added[:, 0, 0], found.scale_of_covariance * (SCALE_SIGMA * lengths) ** 2, rtol=1e-3)
    draws = replace(found, dof=1e6).draw(2000, seed=1)
    assert draws[:, STEPS, 0].std() == pytest.approx(np.hypot(SCALE_SIGMA * 10.0, 0.01 * np.sqrt(STEPS)), rel=0.08)
    found, plain = corridor(seen_m=1e-4)
    added = found.relative_scales([0], [STEPS]) - plain.relative_scales([0], [STEPS])
    assert added[0, 0, 0] < 1e-8


@pytest.mark.parametrize("sigma_rad", [0.02, 0.5])
def test_covariances_hold_the_arc_on_which_a_lost_heading_puts_the_end_of_a_way(sigma_rad):
    """8 m straight on after a heading that errs: to first order only across, by Student's t of 10 degrees."""
    dof, way_m = 10.0, 8.0
    turn = sigma_rad * np.random.default_rng(1).standard_t(dof, 400_000)
    off = np.stack([-0.5 * way_m * turn**2, way_m * turn, turn], axis=1)
    expected = off.T @ off / len(off)
    by_heading = np.array([0.0, way_m, 1.0])
    linear = sigma_rad**2 * np.outer(by_heading, by_heading)
    covariance = dof / (dof - 2.0) * with_arcs(linear[None], dof)[0]
    np.testing.assert_allclose(np.diag(covariance), np.diag(expected), rtol=0.1)
    assert linear[0, 0] == 0.0


def test_a_scan_is_explained_by_several_key_scans_together_and_scans_of_nothing_are_flagged():
    """Two key scans see half of a scan's walls each: their mean would flag it. The last scan was taken elsewhere."""
    poses = np.tile([1.0, 1.0, 0.4], (4, 1))
    angles, ranges = scans_of(ring(), poses, full=True)
    ranges[0, :90], ranges[2, 90:] = np.inf, np.inf
    ranges[3] = scans_of(ring(), np.array([[8.0, 3.5, 2.0]]), full=True)[1]
    geometry = scan_geometry(bm.Scans(poses, angles, ranges, max_range_m=12.0))
    keys, ends = np.array([0, 2]), np.array([0, 1], np.int32)
    aligned = Alignment(poses[keys], Pairs(ends, ends[::-1], np.arange(3, dtype=np.int32)), 0.01, None)
    placed = place_scans(geometry, poses, keys, aligned, PointError(0.01, np.ones(3)))
    assert placed.explained[1] > 0.75
    assert placed.explained[3] < 0.4
    explained = np.where(np.arange(60) % 3 == 0, 0.95, 0.0)
    explained[30] = 0.3
    np.testing.assert_array_equal(flag_unexplained(explained, np.arange(0, 60, 2)), explained < 0.5)


def trajectory(seed, scans=6):
    rng = np.random.default_rng(seed)
    return np.column_stack([rng.normal(0, 2, (scans, 2)), rng.uniform(-np.pi, np.pi, scans)])


class Slipping:
    """Odometry that says nothing of every fifth motion."""

    def law(self, log):
        motions = between(log[:-1], log[1:])
        return Motions(motions, np.full(motions.shape, 0.05), p_slip=0.2).law(log)


PRIORS = {
    "uncertain": UncertainPoses(0.1, 0.05),
    "odometry": Odometry(0.1, 0.05, 0.04, 0.2, 0.02, 0.01),
    "slipping": Slipping(),
}


@pytest.mark.parametrize("name", PRIORS)
def test_the_change_of_one_pose_or_of_a_group_is_the_change_of_the_density(name):
    """Moving all of a group at once changes the density by the sum of their changes; of all scans it does not."""
    law = PRIORS[name].law(trajectory(4))
    rng = np.random.default_rng(5)
    poses = law.sample(rng)
    proposed = poses + rng.normal(0, 0.05, poses.shape)
    changes, groups = law.log_change(poses, proposed), law.independent_groups()

    def unlike(moved):
        together = poses.copy()
        together[moved] = proposed[moved]
        return abs(law.log_prob(together) - law.log_prob(poses) - changes[moved].sum())

    assert max(unlike(moved) for moved in [*groups, *np.concatenate(groups)[:, None]]) < 1e-8
    assert name == "uncertain" or unlike(np.arange(1, len(poses))) > 1e-3


@pytest.mark.parametrize("name", PRIORS)
def test_the_precision_is_the_curvature_of_the_density(name):
    law = PRIORS[name].law(trajectory(6))
    poses = trajectory(6)  # where errors are zero, so that second derivatives of the motions have no part
    precision, h = law.precision(poses), 1e-4
    for i in np.concatenate(law.independent_groups()):
        curvature = np.zeros((3, 3))
        for a, b, sa, sb in product(range(3), range(3), (1, -1), (1, -1)):
            one = poses.copy()
            one[i, a] += sa * h
            one[i, b] += sb * h
            curvature[a, b] -= sa * sb * float(law.log_prob(one)) / (4 * h * h)
        np.testing.assert_allclose(precision[i], curvature, rtol=2e-3, atol=np.abs(curvature).max() * 1e-4)


def test_the_density_of_a_motion_integrates_to_one():
    prior = Odometry(0.1, 0.05, 0.04, 0.2, 0.02, 0.01)
    log = np.array([[0.0, 0.0, 0.4], [0.5, 0.1, 0.9]])
    law = prior.law(log)
    sigma = prior.sigmas(between(log[:1], log[1:]))[0]
    axes = [np.linspace(-6 * s, 6 * s, 61) for s in (sigma[0], sigma[0], sigma[2])]
    x, y, yaw = np.meshgrid(*axes, indexing="ij")
    second = log[1] + np.stack([x, y, yaw], axis=-1)
    total = np.exp(law.log_prob(np.stack([np.broadcast_to(log[0], second.shape), second], axis=-2)))
    for axis in reversed(axes):
        total = scipy.integrate.trapezoid(total, axis)
    assert total == pytest.approx(1.0, abs=1e-4)


def test_samples_of_odometry_have_its_errors_also_if_it_slips():
    """Kolmogorov-Smirnov on every standardised error; false-alarm rate 1e-4 over the three, and over two that slip."""
    log, prior = trajectory(8, 4000), PRIORS["odometry"]
    poses = prior.law(log).sample(np.random.default_rng(9))
    motions = between(log[:-1], log[1:])
    error = between(poses[:-1], poses[1:]) - motions
    error[:, 2] = wrap_angle(error[:, 2])
    standard = error / prior.sigmas(motions)
    for axis in range(3):
        assert scipy.stats.kstest(standard[:, axis], "norm").pvalue > 1e-4 / 3
        assert scipy.stats.kstest(1.15 * standard[:, axis], "norm").pvalue < 1e-4 / 3  # a wrong twin
    poses = PRIORS["slipping"].law(log).sample(np.random.default_rng(13))
    error = between(poses[:-1], poses[1:]) - motions

    def mixture(p_slip):
        return lambda e: (1 - p_slip) * scipy.stats.norm.cdf(e, scale=0.05) + p_slip * scipy.stats.norm.cdf(e)

    for axis in range(2):  # headings wrap
        assert scipy.stats.kstest(error[:, axis], mixture(0.2)).pvalue > 1e-4 / 2
        assert scipy.stats.kstest(error[:, axis], mixture(0.3)).pvalue < 1e-4 / 2  # a wrong twin


def test_a_motion_that_odometry_missed_pulls_at_no_pose():
    """Intel's log states a pose twice while the robot turns by half a radian: 300 standard deviations."""
    stood, turned = np.zeros((2, 3)), np.array([[0.0, 0.0, 0.0], [0.0, 0.05, 0.5]])
    sigmas = np.array([[0.0025, 0.0013, 0.0017]])
    back = turned.copy()
    back[1, 2] -= 0.002
    changes = {p: Motions(stood[1:], sigmas, p).law(stood).log_change(turned, back)[1] for p in (0.0, 0.01)}
    assert changes[0.0] > 100  # what turned scans against the walls
    assert 0 < changes[0.01] < 0.01
    precision = Motions(stood[1:], sigmas, 0.01).law(stood).precision(turned)[1]
    np.testing.assert_allclose(precision, np.diag(FREE_SIGMA**-2.0), atol=0.01)  # steps as long as the walls allow


def test_known_poses_do_not_move_nor_does_the_first_of_odometry():
    log = trajectory(10)
    law = KnownPoses().law(log)
    assert (law.independent_groups(), law.log_prob(log), law.log_prob(log + 1e-9)) == ((), 0, -np.inf)
    assert (law.sample(np.random.default_rng(0)) == log).all()
    law = PRIORS["odometry"].law(trajectory(11))
    assert 0 not in np.concatenate(law.independent_groups())
    assert law.log_prob(trajectory(11) + np.array([1e-3, 0, 0])) == -np.inf


@pytest.mark.parametrize("make", [
    lambda: UncertainPoses(0.0, 0.1),
    lambda: UncertainPoses(0.1, float("nan")),
    lambda: Odometry(m_per_m=-1.0),
    lambda: Motions(np.zeros((1, 3)), np.ones((1, 3)), 1.0),
])  # fmt: skip
def test_senseless_numbers_are_refused(make):
    with pytest.raises(bm.BadInput, match=r"sigma|m_per_m|p_slip"):
        make()


TURNED = np.array([[0.0, 0.0, 0.0], [0.0, 0.05, 0.5], [0.0, 0.1, 1.0]])


def test_odometry_that_missed_a_turn_does_not_turn_scans():
    """The log says firmly that the robot stood still between two scans that the walls hold half a radian apart."""
    scans = bm.Scans(TURNED, np.array([0.0]), np.ones((3, 1)), 2.0)
    stood = Factors(np.arange(2), np.arange(1, 3), np.zeros((2, 3)), np.tile(np.eye(3) / 0.002**2, (2, 1, 1)))
    calibration = SimpleNamespace(angle_step_ratio=1.0)
    found = SimpleNamespace(
        keys=np.arange(3), order=np.arange(3), poses=TURNED, odometry=stood, calibration=calibration,
        draw=lambda count, seed: np.tile(TURNED, (count, 1, 1)),
    )  # fmt: skip
    law = select_key_scans(scans, found, chains=2, seed=0).prior.law(TURNED)
    turn = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.01], [0.0, 0.0, 0.01]])
    assert abs(law.log_prob(TURNED - turn) - law.log_prob(TURNED)) < 0.1
    still = np.zeros((3, 3))
    assert law.log_prob(still) > law.log_prob(still + turn) + 5  # steps that it can have seen right, it still holds
