"""Priors of poses are densities, and what samplers need of them follows from the density."""

from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
import scipy

from bayesmap.errors import BadInput
from bayesmap.poses.graph import Factors
from bayesmap.poses.map_scans import key_scans
from bayesmap.poses.prior import FREE, KnownPoses, Motions, Odometry, UncertainPoses
from bayesmap.space.planar import between, wrap_angle
from bayesmap.space.scans import Scans


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
def test_the_change_of_one_pose_or_of_a_colour_is_the_change_of_the_density(name):
    """Moving all of a colour at once changes the density by the sum of their changes; of all scans it does not."""
    law = PRIORS[name].law(trajectory(4))
    rng = np.random.default_rng(5)
    poses = law.sample(rng)
    proposed = poses + rng.normal(0, 0.05, poses.shape)
    changes, colours = law.log_change(poses, proposed), law.colours(len(poses))

    def unlike(moved):
        together = poses.copy()
        together[moved] = proposed[moved]
        return abs(law.log_prob(together) - law.log_prob(poses) - changes[moved].sum())

    assert max(unlike(moved) for moved in [*colours, *np.concatenate(colours)[:, None]]) < 1e-8
    assert name == "uncertain" or unlike(np.arange(1, len(poses))) > 1e-3


@pytest.mark.parametrize("name", PRIORS)
def test_the_precision_is_the_curvature_of_the_density(name):
    law = PRIORS[name].law(trajectory(6))
    poses = trajectory(6)  # where errors are zero, so that second derivatives of the motions have no part
    precision, h = law.precision(poses), 1e-4
    for i in np.concatenate(law.colours(len(poses))):
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
    poses = np.stack([np.broadcast_to(log[0], second.shape), second], axis=-2)
    total = np.exp(law.log_prob(poses))
    for axis in reversed(axes):
        total = scipy.integrate.trapezoid(total, axis)
    assert total == pytest.approx(1.0, abs=1e-4)


def test_samples_of_odometry_have_its_errors():
    """Kolmogorov-Smirnov on every standardised error; false-alarm rate 1e-4 over the three."""
    log, prior = trajectory(8, 4000), PRIORS["odometry"]
    poses = prior.law(log).sample(np.random.default_rng(9))
    motions = between(log[:-1], log[1:])
    error = between(poses[:-1], poses[1:]) - motions
    error[:, 2] = wrap_angle(error[:, 2])
    standard = error / prior.sigmas(motions)
    for axis in range(3):
        assert scipy.stats.kstest(standard[:, axis], "norm").pvalue > 1e-4 / 3
        assert scipy.stats.kstest(1.15 * standard[:, axis], "norm").pvalue < 1e-4 / 3  # a wrong twin


def test_samples_of_slipping_odometry_have_its_errors():
    """Kolmogorov-Smirnov against the mixture; false-alarm rate 1e-4 over both axes."""
    log = trajectory(12, 4000)
    poses = PRIORS["slipping"].law(log).sample(np.random.default_rng(13))
    error = between(poses[:-1], poses[1:]) - between(log[:-1], log[1:])

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
    np.testing.assert_allclose(precision, np.diag(FREE**-2.0), atol=0.01)  # steps as long as the walls allow


def test_known_poses_do_not_move_nor_does_the_first_of_odometry():
    log = trajectory(10)
    law = KnownPoses().law(log)
    assert (law.colours(len(log)), law.log_prob(log), law.log_prob(log + 1e-9)) == ((), 0, -np.inf)
    assert (law.sample(np.random.default_rng(0)) == log).all()
    law = PRIORS["odometry"].law(trajectory(11))
    assert 0 not in np.concatenate(law.colours(6))
    assert law.log_prob(trajectory(11) + np.array([1e-3, 0, 0])) == -np.inf


@pytest.mark.parametrize("make", [
    lambda: UncertainPoses(0.0, 0.1),
    lambda: UncertainPoses(0.1, float("nan")),
    lambda: Odometry(m_per_m=-1.0),
    lambda: Motions(np.zeros((1, 3)), np.ones((1, 3)), 1.0),
])  # fmt: skip
def test_senseless_numbers_are_refused(make):
    with pytest.raises(BadInput, match=r"sigma|m_per_m|p_slip"):
        make()


TURNED = np.array([[0.0, 0.0, 0.0], [0.0, 0.05, 0.5], [0.0, 0.1, 1.0]])


def test_odometry_that_missed_a_turn_does_not_turn_scans():
    """The log says firmly that the robot stood still between two scans that the walls hold half a radian apart."""
    scans = Scans(TURNED, np.array([0.0]), np.ones((3, 1)), 2.0)
    stood = Factors(np.arange(2), np.arange(1, 3), np.zeros((2, 3)), np.tile(np.eye(3) / 0.002**2, (2, 1, 1)))
    calibration = SimpleNamespace(angle_step_ratio=1.0)
    found = SimpleNamespace(
        keys=np.arange(3), order=np.arange(3), poses=TURNED, odometry=stood, calibration=calibration,
        draw=lambda count, seed: np.tile(TURNED, (count, 1, 1)),
    )  # fmt: skip
    law = key_scans(scans, found, chains=2, seed=0).prior.law(TURNED)
    turn = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.01], [0.0, 0.0, 0.01]])
    assert abs(law.log_prob(TURNED - turn) - law.log_prob(TURNED)) < 0.1
    still = np.zeros((3, 3))
    assert law.log_prob(still) > law.log_prob(still + turn) + 5  # steps that it can have seen right, it still holds
