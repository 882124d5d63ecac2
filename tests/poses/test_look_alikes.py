"""A visit of a place that only looks alike is left out, a doubtful one is reported, and covariances contain it."""

import numpy as np
import pytest
from simulated import poses_along, worst_m

from bayesmap.poses import key_graph, loops
from bayesmap.poses.graph import Factors, PoseStudentT, optimise
from bayesmap.poses.key_graph import _doubtful_visits, label_visits, twist_squares, weigh_visits
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between, compose
from benchmarks.pose_cases import office, record

STEP_SIGMA = np.array([0.02, 0.02, np.radians(0.4)])
CLOSURE_SIGMA = np.array([0.02, 0.02, np.radians(0.3)])


def square(side=15, step_m=0.5):
    """True poses around a square, on from where they began for some more."""
    motions = [[step_m, 0.0, np.pi / 2 if k % side == 0 else 0.0] for k in range(1, 4 * side + 12)]
    return poses_along(np.zeros(3), np.array(motions))


TRUTH = square()
ALONG = 0.5 * np.arange(len(TRUTH))


def chain_of(rng, noise=1.0):
    """Motions with noise, whose stated covariance is that of ``noise`` = 1, and the poses that they lead to."""
    motions = between(TRUTH[:-1], TRUTH[1:]) + noise * STEP_SIGMA * rng.normal(size=(len(TRUTH) - 1, 3))
    order = np.arange(len(motions))
    factors = Factors(order, order + 1, motions, np.tile(np.diag(STEP_SIGMA**-2.0), (len(order), 1, 1)))
    return factors, poses_along(TRUTH[0], motions)


def closed(chain, poses, shift, rng):
    """Five closures of one visit, each off by the same shift, and the poses where all is settled."""
    first = np.arange(0, 10, 2)
    second = first + 60
    true = between(TRUTH[first], compose(TRUTH[second], np.asarray(shift, float)[None]))
    relative = true + CLOSURE_SIGMA * rng.normal(size=true.shape)
    loops = Factors(first, second, relative, np.tile(np.diag(CLOSURE_SIGMA**-2.0), (5, 1, 1)))
    there, weights = optimise(poses, chain, loops)
    return loops, there, weights


def test_a_right_visit_stays_and_a_wrong_one_is_left_out():
    rng = np.random.default_rng(1)
    chain, poses = chain_of(rng, noise=0.5)
    loops, there, weights = closed(chain, poses, [0.0, 0.0, 0.0], rng)
    right = weigh_visits(there, weights, chain, loops, ALONG)
    np.testing.assert_array_equal(right.poses, there)
    assert len(right.probabilities) == 0
    assert (right.weights > 0.5).all()
    loops, there, weights = closed(chain, poses, [3.5, 0.0, 0.0], rng)
    assert (weights > 0.5).all(), "each closure by itself is believed: all five agree"
    wrong = weigh_visits(there, weights, chain, loops, ALONG)
    np.testing.assert_allclose(wrong.poses, poses, atol=1e-3)
    assert not wrong.weights.any()


def test_a_doubtful_visit_is_reported_with_the_poses_without_it():
    rng = np.random.default_rng(2)
    chain, poses = chain_of(rng, noise=0.3)
    told = []
    for shift in (0.5, 0.6, 0.7):
        loops, there, weights = closed(chain, poses, [shift, 0.0, 0.0], rng)
        found = weigh_visits(there, weights, chain, loops, ALONG)
        assert len(found.probabilities) <= 1
        told.append(float(found.probabilities[0]) if len(found.probabilities) else 0.0)
        if len(found.probabilities):
            assert (found.first[0], found.last[0]) == (loops.first.min(), loops.second.max())
            left, kept = (there, poses) if not found.weights.any() else (poses, there)
            np.testing.assert_allclose(found.poses, kept, atol=1e-3)
            np.testing.assert_allclose(found.alternatives[0], left, atol=1e-3)
    assert 0.05 < max(told) < 0.95


@pytest.mark.parametrize(("noise", "paths", "calibrated"), [(1.0, 60, True), (2.0, 20, False)])
def test_the_distance_of_right_visits_is_half_a_chi_squared(noise, paths, calibrated, monkeypatch):
    """60 paths: the mean of D is 1.5, its standard error 0.16; within four. Noise stated at half its size shows in
    20 paths: the mean is 6, its standard error 1.1.
    """
    monkeypatch.setattr("bayesmap.poses.key_graph.AGREE_M", 0.0)
    monkeypatch.setattr("bayesmap.poses.key_graph.SURE_LOG_ODDS", 20.7)
    distances = []
    for seed in range(paths):
        rng = np.random.default_rng(100 + seed)
        chain, poses = chain_of(rng, noise)
        loops, there, _ = closed(chain, poses, [0.0, 0.0, 0.0], rng)
        out, label = np.zeros(5, bool), np.zeros(5, np.intp)
        found = list(_doubtful_visits(there, chain, loops, label, out, np.zeros(1)))
        distances.append(-found[0][0] if found else 0.0)
    assert (abs(np.mean(distances) - 1.5) < 0.65) == calibrated


def test_closures_of_one_visit_that_contradict_each_other_are_two():
    rng = np.random.default_rng(3)
    chain, poses = chain_of(rng)
    loops = closed(chain, poses, [0.0, 0.0, 0.0], rng)[0]
    relative = loops.relative.copy()
    relative[3:] += [1.0, 0.0, 0.0]
    label = label_visits(Factors(loops.first, loops.second, relative, loops.information), TRUTH, ALONG)
    assert label[0] == label[1] == label[2] != label[3] == label[4]


def test_covariances_and_draws_hold_the_alternative():
    order = np.arange(4)
    poses = np.column_stack([np.arange(5.0), np.zeros(5), np.zeros(5)])
    curvature, force = np.tile(np.eye(3) * 1e4, (4, 1, 1)), np.zeros((4, 3))
    parts = (poses, order, order + 1, between(poses[:-1], poses[1:]), curvature, force)
    step = np.zeros((1, 5, 3))
    step[0, 3:, 1] = np.sqrt(0.2) * 2.0  # probability 0.2, 2 m to the side
    plain, other = PoseStudentT(*parts), PoseStudentT(*parts, elsewhere=step)
    before, after = (g.relative_scales([0, 1], [4, 2]) for g in (plain, other))
    expected = np.diag([0.0, 0.2 * 4.0, 0.0]) * other.scale_of_covariance
    np.testing.assert_allclose((after - before)[0], expected, atol=1e-9)
    np.testing.assert_allclose(after[1], before[1], atol=1e-12)
    draws = other.draw(1500, seed=1)
    # The scale matrix's share is stretched by Student's t: a variance of 0.8, known to 8 % or so.
    assert abs(draws[:, 4, 1].var() / 0.8 - 1.0) < 0.3


def test_a_turn_half_way_is_as_long_as_the_turn():
    """A way of 20 m with a heading of standard deviation 0.6 lost at its middle: the end lies on an arc."""
    rng = np.random.default_rng(4)
    half = np.array([10.0, 0.0, 0.3])
    middle = np.array([[0.0, 0.0, turn] for turn in 0.6 * rng.normal(size=400)])
    ends = compose(compose(half[None], middle), half[None])
    expected = np.tile(compose(half, half), (400, 1))
    lever = np.array([-np.sin(0.3) * 10.0, np.cos(0.3) * 10.0, 1.0])
    covariance = np.tile(0.36 * np.outer(lever, lever) + 1e-6 * np.eye(3), (400, 1, 1))
    lengths = twist_squares(expected, ends, covariance)
    np.testing.assert_allclose(lengths, (middle[:, 2] / 0.6) ** 2, rtol=1e-3, atol=1e-3)
    off = ends - expected
    straight = np.einsum("mi,mij,mj->m", off, np.linalg.inv(covariance), off)
    assert np.median(straight) > 100.0 * np.median(lengths), "an ellipsoid in x and y holds little of it"


def recorded(seed):
    """Scans with raw odometry in an office whose doors repeat every 2.8 m, and the laser's true poses."""
    made, path = office(450, seed)
    case = record(made.walls, made.grid, path, seed=seed + 10)
    return case.scans, case.truth


@pytest.mark.full
@pytest.mark.parametrize("seed", [3, 15, 19])
def test_rooms_in_a_row_that_look_alike_are_distinguished(seed):
    """Odometry's heading is off by much: closures between neighbouring rooms once put the end of the way 2.8 m off."""
    scans, truth = recorded(seed)
    found = infer_trajectory(scans)
    assert worst_m(found.poses, truth) < 0.1
    assert len(found.leaps) == 0


@pytest.mark.full
def test_steps_between_confused_rooms_are_named_as_leaps(monkeypatch):
    """Closures that the way rules out are taken all the same, and visits that look alike are believed."""
    monkeypatch.setattr(key_graph, "VISIT_ODDS", 1e9)
    monkeypatch.setattr(loops, "_agree_with_graph", lambda closures, *_: np.ones(len(closures), bool))
    scans, truth = recorded(15)
    found = infer_trajectory(scans)
    assert worst_m(found.poses, truth) > 1.0
    leaps = between(found.poses[found.leaps - 1], found.poses[found.leaps])
    true = between(truth[found.leaps - 1], truth[found.leaps])
    assert len(found.leaps) > 0
    assert (np.hypot(*(leaps - true)[:, :2].T) > 0.3).all()
