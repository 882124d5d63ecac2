"""The oracle against answers by hand, definitions, quadrature and its own draws; false alarms: `ALPHA` = 1e-4."""

import numpy as np
import pytest
import scipy
from oracle import stop_law
from oracle.enumeration import all_maps, distances, enumerate_posterior, marginals, pairs, sweeps, update_sites
from oracle.stop_law import Paths, cross_surface, draw_readings, exact_reflectivities, log_likelihoods, paths_of
from oracle.stop_worlds import draw_worlds
from oracle.verdict import ALPHA, goodness_of_fit, least_p_value

import bayesmap as bm
from bayesmap.sensors.model import RangeLimits

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
    np.testing.assert_allclose(marginals(exact.p, 2) * joint.sum(), [joint[1] + joint[3], joint[2:].sum()])
    assert pairs(exact.p, 2)[0, 1] == pytest.approx(joint[3] / joint.sum())


def test_updates_keep_the_posterior_and_reach_it():
    log_joint = np.random.default_rng(2).normal(size=64)
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
    assert sum(least_p_value(maps[rng.choice(16, 2000, p=p)], p) < 0.01 for _ in range(400)) <= 12
    fits = [goodness_of_fit(np.bincount(rng.choice(16, 2000, p=p), minlength=16), p) for _ in range(400)]
    assert 0.4 < np.mean(fits) < 0.6


def test_the_verdict_rejects_a_law_that_is_a_little_off():
    rng = np.random.default_rng(4)
    log_joint = rng.normal(size=16)
    p = np.exp(log_joint) / np.exp(log_joint).sum()
    maps = all_maps(4)
    tilted = p * np.exp(0.1 * maps[:, 2])
    assert least_p_value(maps[rng.choice(16, 40_000, p=tilted / tilted.sum())], p) < ALPHA


SENSOR = bm.BeamMixture(bm.Gaussian(0.06, 0.02), p_random=0.08, p_no_return=0.15, p_short=0.2, rate_short_per_m=0.7)
LIMITS = RangeLimits(0.2, 2.5)
STATES = np.array(
    [[0.6, 0.45, 0.3, 0.10, 0.03, 0.05], [0.3, 1.10, 0.2, 0.02, -0.10, 0.15], [0.9, 1.70, 0.3, 0.15, 0.20, 0.02]]
)
"""Three cells of half a metre in a row."""


def one_path(z, *, angle=0.1, start=(-0.3, 0.15)):
    plain = np.array([[0.5, 1.05, 1.6]])
    no = np.zeros((1, 3), dtype=bool)
    direction = np.array([[np.cos(angle), np.sin(angle)]])
    return Paths(np.arange(3)[None], ~no, plain, no, np.array([start]), direction, np.array([z]), LIMITS)


def same_path(z):
    beams = Paths(*(np.repeat(part, len(z), axis=0) for part in one_path(0.0)[:-1]), LIMITS)
    return beams._replace(range_m=np.asarray(z))


def law_at(z, plain):
    """The density, or the probability, of each of some readings of that beam."""
    return np.exp(log_likelihoods(same_path(z), STATES, SENSOR, plain))


def test_a_beam_meets_a_surface_where_the_surface_s_density_along_the_beam_says():
    """Mean and variance of the normal density on the line, by quadrature, the surface widened across the beam."""
    start, angle = np.array([-0.3, 0.15]), 0.1
    u = np.array([np.cos(angle), np.sin(angle)])
    t = np.linspace(-10, 10, 200_001)
    for state in STATES:
        factor = np.array([[state[3], 0.0], [state[4], state[5]]])
        across = np.outer([-u[1], u[0]], [-u[1], u[0]]) * (0.005 * (state[1:3] - start) @ u) ** 2
        weight = scipy.stats.multivariate_normal(state[1:3], factor @ factor.T + across).pdf(start + t[:, None] * u)
        mean = np.average(t, weights=weight)
        _, distance, variance = cross_surface(state, start, u)
        assert distance == pytest.approx(mean, abs=1e-6)
        assert variance == pytest.approx(np.average((t - mean) ** 2, weights=weight), rel=1e-6)


def test_the_gate_is_one_through_the_middle_and_a_half_at_its_width():
    u, n = np.array([0.6, 0.8]), np.array([-0.8, 0.6])
    state = STATES[1]
    factor = np.array([[state[3], 0.0], [state[4], state[5]]])
    v = np.sqrt(n @ factor @ factor.T @ n)
    for offset, chance in ((0.0, 1.0), (2.2 * v, 0.5), (-2.2 * v, 0.5), (4.4 * v, 1 / 65), (1.1 * v, 64 / 65)):
        assert cross_surface(state, state[1:3] - 0.7 * u - offset * n, u)[0] == pytest.approx(chance, rel=1e-9)


@pytest.mark.parametrize("plain", [True, False])
def test_drawn_readings_follow_the_density_which_adds_up_to_one(plain):
    count, edges = 200_000, np.linspace(LIMITS.min_m, LIMITS.max_m, 47)
    drawn = draw_readings(np.random.default_rng(1), same_path(np.zeros(count)), STATES, SENSOR, plain)
    z = np.linspace(edges[0], edges[-1], 46 * 200 + 1)
    p = law_at(z, plain)
    mass = ((p[1:] + p[:-1]) / 2 * np.diff(z)).reshape(46, 200).sum(axis=1)
    typed = law_at([np.inf, -np.inf], plain)
    counts = [*np.histogram(drawn, edges)[0], np.isposinf(drawn).sum(), np.isneginf(drawn).sum()]
    law = np.array([*mass, *typed])
    assert law.sum() == pytest.approx(1.0, abs=5e-4)  # the density jumps at every stop
    assert goodness_of_fit(np.array(counts), law / law.sum()) > ALPHA / 2
    tilted = law * np.where(np.arange(48) < 24, 1.06, 1.0)
    assert goodness_of_fit(np.array(counts), tilted / tilted.sum()) < ALPHA / 2


def test_the_prior_of_surfaces_has_the_jacobian_of_its_coordinates():
    prior = bm.Surface(0.7, 1.3, mean_scale=0.5, spread=0.4, dof=3.5, size_scale=0.6)
    centres = (np.array([[0.25, 0.25]]), 0.5)
    state = STATES[0]

    def sigma(log11, l21, log22):
        l11, l22 = np.exp(log11), np.exp(log22)
        return np.array([l11**2, l11 * l21, l21**2 + l22**2])

    at, step = np.array([np.log(state[3]), state[4], np.log(state[5])]), 1e-6
    columns = [(sigma(*(at + step * e)) - sigma(*(at - step * e))) / (2 * step) for e in np.eye(3)]
    s11, s12, s22 = sigma(*at)
    expected = (
        np.log(abs(np.linalg.det(columns)))
        + scipy.stats.invwishart(3.5, (0.4 * 0.5) ** 2 * np.eye(2)).logpdf([[s11, s12], [s12, s22]])
        + scipy.stats.norm(0.25, 0.25).logpdf(state[1:3]).sum()
        + scipy.stats.beta(0.7, 1.3).logpdf(0.6)
        + np.log(0.6 * 0.4)  # d m / d logit m
        - (s11 + s22) / (2 * 0.3**2)
    )
    assert stop_law.log_prior(prior, state[None], centres)[0] == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("prior", [bm.Beta(0.8, 1.7), bm.Beta()])
def test_the_enumeration_of_stops_equals_quadrature_over_reflectivities(prior):
    """Gauss-Jacobi rules are exact: the likelihood is a polynomial in every m, of a degree of at most the beams'."""
    worlds, _ = draw_worlds(5, bm.Grid((2, 2), 0.5), bm.Beta(1, 1), SENSOR, 6, poses=2, beams=5, limits=(0.2, 2.5))
    rays = worlds.problem.rays
    scans = 10
    for w in range(6):
        beams = np.arange(w * scans, (w + 1) * scans)
        path = paths_of(rays)
        mine = Paths(*(part[beams] for part in path[:-1]), path.limits)
        mine = mine._replace(cell=np.where(mine.there, np.searchsorted(worlds.cells()[w], mine.cell), 0))
        exact = exact_reflectivities(mine, 4, prior, SENSOR)
        nodes, weights = scipy.special.roots_jacobi(8, prior.b - 1, prior.a - 1)
        m = np.stack(np.meshgrid(*[(nodes + 1) / 2] * 4, indexing="ij"), axis=-1).reshape(-1, 4)
        states = np.zeros((len(m), 4, 6))
        states[..., 0] = m
        p = np.exp(log_likelihoods(mine, states, SENSOR, True).sum(axis=-1))
        p *= np.prod(np.stack(np.meshgrid(*[weights] * 4, indexing="ij")), axis=0).ravel()
        np.testing.assert_allclose(exact.mean(), p @ m / p.sum(), rtol=1e-8)
        np.testing.assert_allclose(exact.pairs(), (m * p[:, None]).T @ m / p.sum(), rtol=1e-8)
        assert exact.cdf(0)(1.0)[0] == pytest.approx(1.0)
