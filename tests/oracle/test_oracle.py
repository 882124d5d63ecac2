"""The oracle itself, against answers that were worked out by hand."""

import numpy as np
import pytest
from oracle.enumeration import all_maps, enumerate_posterior, marginals, pairs
from oracle.formula import distances
from oracle.transitions import sweeps, update_sites
from oracle.verdict import ALPHA, goodness_of_fit, least_p_value

import bayesmap as bm

ONE = np.array([[False, False], [False, True]])  # a wall at [1, 2] x [1, 2]


@pytest.mark.parametrize(("start", "angle", "distance"), [
    ((0.0, 0.0), np.pi / 4, np.sqrt(2)),  # the corner
    ((0.0, 1.5), 0.0, 1.0),  # the left edge
    ((0.0, 1.0), 0.0, 1.0),  # along the line on which the lower edge lies: the left edge's end
    ((1.5, 1.5), 0.0, 0.5),  # from inside: the exit
    ((0.0, 0.5), 0.0, np.inf),  # below
    ((3.0, 1.5), 0.0, np.inf),  # behind
    ((2.0, 2.0), 0.3, 0.0),  # on a corner
])  # fmt: skip
def test_the_formula_gives_the_distances_that_a_ruler_gives(start, angle, distance):
    assert distances(ONE, [start], np.array([angle]))[0] == pytest.approx(distance, abs=1e-12)


def test_one_beam_on_two_cells_is_enumerated_as_by_hand():
    grid = bm.Grid((2, 1))
    scans = bm.Scans([[-1.0, 0.5, 0.0]], [0.0], [[1.5]], max_range_m=5.0)
    like = {1.0: 0.7, 2.0: 0.2, np.inf: 0.1}
    exact = enumerate_posterior(scans, grid, 0.25, lambda z, d: np.log([like[x] for x in d.tolist()]))
    joint = np.array([0.75 * 0.75 * 0.1, 0.25 * 0.75 * 0.7, 0.75 * 0.25 * 0.2, 0.25 * 0.25 * 0.7])
    np.testing.assert_allclose(exact.p, joint / joint.sum(), rtol=1e-12)
    assert exact.log_evidence == pytest.approx(np.log(joint.sum()))
    np.testing.assert_allclose(
        marginals(exact.p, 2), [(joint[1] + joint[3]) / joint.sum(), joint[2:].sum() / joint.sum()]
    )
    assert pairs(exact.p, 2)[0, 1] == pytest.approx(joint[3] / joint.sum())


def test_updates_keep_the_posterior_and_reach_it():
    rng = np.random.default_rng(2)
    log_joint = rng.normal(size=64)
    p = np.exp(log_joint) / np.exp(log_joint).sum()
    np.testing.assert_allclose(update_sites(p, log_joint, 6, [1, 4]), p, rtol=1e-12)
    start = np.eye(64)[7]
    np.testing.assert_allclose(update_sites(start, log_joint, 6, list(range(6))), p, rtol=1e-12)
    np.testing.assert_allclose(sweeps(start, log_joint, 6, [[c] for c in range(6)], 200), p, rtol=1e-9)


def test_the_verdict_passes_right_draws_as_often_as_it_says():
    """P-values of correct draws are at least uniform: at most 1 % (of 400: 12 is the 99.9 % point) below 0.01."""
    rng = np.random.default_rng(3)
    p = rng.dirichlet(np.full(16, 0.4))
    maps = all_maps(4)
    small = sum(least_p_value(maps[rng.choice(16, 2000, p=p)], p) < 0.01 for _ in range(400))
    assert small <= 12
    fits = [goodness_of_fit(np.bincount(rng.choice(16, 2000, p=p), minlength=16), p) for _ in range(400)]
    assert 0.4 < np.mean(fits) < 0.6


def test_the_verdict_rejects_a_law_that_is_a_little_off():
    rng = np.random.default_rng(4)
    log_joint = rng.normal(size=16)
    p = np.exp(log_joint) / np.exp(log_joint).sum()
    maps = all_maps(4)
    tilted = p * np.exp(0.1 * maps[:, 2])
    draws = maps[rng.choice(16, 40_000, p=tilted / tilted.sum())]
    assert least_p_value(draws, p) < ALPHA
