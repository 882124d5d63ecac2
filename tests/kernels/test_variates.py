"""Variates and prior surfaces against scipy's laws (Kolmogorov-Smirnov, `ALPHA` = 1e-4); orders of random sweeps."""

import numpy as np
import pytest
import scipy
import warp as wp
from kernels.shuffle_orders import shuffles, shuffles_of_chains
from oracle.stop_law import draw_covariances
from oracle.verdict import ALPHA

import bayesmap as bm
from bayesmap.kernels.device import Float64s
from bayesmap.kernels.random import (
    COUNTERS_PER_GAMMA,
    beta_or_zero,
    beta_variate,
    log_gamma_variate,
    nearly_normal,
    normal,
    random_bits,
)
from bayesmap.kernels.surfaces.surface import Cell, PriorArrays, fresh_surface

wp.set_module_options({"enable_backward": False})

COUNT = 100_000
SPACING = 1024
SHAPES = (0.01, 0.1, 0.5, 0.999, 1.0, 2.5, 100.0)
BETAS = ((0.02, 0.2), (0.02, 40.2), (0.5, 0.5), (1.0, 1.0), (3.5, 0.2), (200.0, 3000.0))
CASES = 40  # tests of a law below, at most
HUGE = 1e9
KEY = wp.uint64(0x123456789ABCDEF)


@wp.func
def at(i: int) -> wp.uint64:
    return wp.uint64(i) * wp.uint64(SPACING)


@wp.kernel
def draw_normal(key: wp.uint64, out: Float64s):
    i = wp.tid()
    out[i] = normal(key, at(i))


@wp.kernel
def draw_log_gamma(key: wp.uint64, shape: wp.float64, offset: wp.uint64, out: Float64s):
    i = wp.tid()
    out[i] = log_gamma_variate(shape, key, at(i) + offset)


@wp.kernel
def draw_beta(key: wp.uint64, a: wp.float64, b: wp.float64, out: Float64s):
    i = wp.tid()
    out[i] = beta_variate(a, b, key, at(i))


@wp.kernel
def draw_beta_or_zero(key: wp.uint64, a: wp.float64, b: wp.float64, out: Float64s):
    i = wp.tid()
    out[i] = beta_or_zero(a, b, key, at(i))


@wp.kernel
def draw_nearly_normal(key: wp.uint64, out: Float64s):
    i = wp.tid()
    out[i] = wp.float64(nearly_normal(random_bits(key, wp.uint64(i))))


@wp.kernel
def draw_surface(prior: PriorArrays, key: wp.uint64, out: wp.array(dtype=Cell)):
    i = wp.tid()
    out[i] = fresh_surface(prior, wp.vec2(1.5, 2.5), Cell(), key, at(i))


def drawn(kernel, *numbers):
    out = wp.zeros(COUNT, dtype=wp.float64, device="cpu")
    wp.launch(kernel, dim=COUNT, inputs=[KEY, *numbers, out], device="cpu")
    return out.numpy()


def follows(sample, cdf):
    return scipy.stats.kstest(sample, cdf).pvalue > ALPHA / CASES


@pytest.mark.parametrize("shape", SHAPES)
def test_normal_variates_and_logarithms_of_gamma_variates_follow_their_laws(shape):
    assert follows(drawn(draw_normal), scipy.stats.norm.cdf)
    assert not follows(1.04 * drawn(draw_normal), scipy.stats.norm.cdf)
    sample = drawn(draw_log_gamma, shape, 0)
    assert np.isfinite(sample).all()
    assert follows(sample, scipy.stats.loggamma(shape).cdf)
    assert not follows(sample, scipy.stats.loggamma(shape * 1.03).cdf)


@pytest.mark.parametrize(("a", "b"), BETAS)
def test_beta_variates(a, b):
    sample = drawn(draw_beta, a, b)
    assert ((sample >= 0) & (sample <= 1)).all()
    # What underflows, or rounds to one, is compared as a share.
    inner = (1e-280, 1 - 1e-15)
    law = scipy.stats.beta(a, b)
    for end, p in ((sample < inner[0], law.cdf(inner[0])), (sample > inner[1], law.sf(inner[1]))):
        assert scipy.stats.binomtest(int(end.sum()), COUNT, min(p, 1.0)).pvalue > ALPHA / CASES
    inside = sample[(sample >= inner[0]) & (sample <= inner[1])]
    low, high = law.cdf(inner)
    assert follows((law.cdf(inside) - low) / (high - low), scipy.stats.uniform.cdf)


@pytest.mark.parametrize(("a", "b"), [(0.01, 0.2), (0.01, 3.0), (0.02, 300.0), (2.0, 3.0)])
def test_beta_variates_under_e_to_the_minus_70_are_nothing_and_all_others_what_they_are(a, b):
    exact, mine = drawn(draw_beta, a, b), drawn(draw_beta_or_zero, a, b)
    nothing = (mine == 0) & (exact > 0)
    assert (exact[nothing] < np.exp(-70.0)).all()
    np.testing.assert_array_equal(mine[~nothing], exact[~nothing])
    assert nothing.any() == (a < 1 < b)


def test_nearly_normal_numbers_have_a_normal_s_first_moments_and_counters_of_variates_do_not_meet():
    """The fourth moment of a sum of four uniform numbers is 2.7, not 3."""
    sample = drawn(draw_nearly_normal)
    for power, expected in ((1, 0.0), (2, 1.0), (3, 0.0), (4, 2.7)):
        error = np.std(sample**power) / np.sqrt(COUNT)
        assert abs((sample**power).mean() - expected) < 4.5 * error
    assert abs((sample**4).mean() - 3.0) > 4.5 * np.std(sample**4) / np.sqrt(COUNT)  # the twin: a normal's
    assert scipy.stats.ks_2samp(sample, -sample).pvalue > ALPHA / CASES
    logs, following = (drawn(draw_log_gamma, 0.7, offset) for offset in (0, COUNTERS_PER_GAMMA))
    assert abs(np.corrcoef(scipy.stats.rankdata(logs), scipy.stats.rankdata(following))[0, 1]) < 4.5 / np.sqrt(COUNT)


def surface_functions(surfaces):
    """Coordinates and some of their combinations, by name; surfaces (N, 5)."""
    x, y, l11, l21, l22 = np.asarray(surfaces, dtype=float).T
    values = [x, y, np.log(l11), l21, np.log(l22), l21 / np.hypot(l21, l22), np.log(l11 * l22), l21 / l11]
    names = ("x", "y", "log l11", "l21", "log l22", "correlation", "area", "tilt")
    return dict(zip(names, values, strict=True)) | {"size": np.log(l11**2 + l21**2 + l22**2)}


def by_kernel(prior):
    """Prior surfaces of the kernel, about their centre, in edges of a cell, which are 0.5 m here."""
    packed = PriorArrays()
    packed.a, packed.b = prior.a, prior.b
    packed.tau_m, packed.psi_m2, packed.nu = prior.mean_scale * 0.5, (prior.spread * 0.5) ** 2, prior.dof
    out = wp.zeros(COUNT, dtype=Cell, device="cpu")
    wp.launch(draw_surface, dim=COUNT, inputs=[packed, KEY, out], device="cpu")
    surfaces = out.numpy()[:, 1:6].astype(float)
    surfaces[:, :2] -= (1.5, 2.5)
    return surfaces / 0.5


def by_numpy(prior):
    return prior.sample_surfaces(np.random.default_rng(3), COUNT)


def by_scipy(prior, *, inside=True):
    """Draw prior surfaces, with means inside their own cell or anywhere."""
    rng = np.random.default_rng(4)
    factor = np.linalg.cholesky(draw_covariances(rng, prior, COUNT))
    most = 0.5 / prior.mean_scale if inside else np.inf
    mean = scipy.stats.truncnorm.rvs(-most, most, scale=prior.mean_scale, size=(COUNT, 2), random_state=rng)
    return np.column_stack([mean, factor[:, 0, 0], factor[:, 1, 0], factor[:, 1, 1]])


@pytest.mark.parametrize("dof", [2.5, 3.0, 6.0])
@pytest.mark.parametrize(("draw", "extent"), [(by_kernel, HUGE), (by_numpy, HUGE), (by_numpy, 0.35)])
def test_prior_surfaces_follow_the_inverse_wishart_thinned_by_their_size(draw, extent, dof):
    """The kernel's are thinned, and kept within their cell, when they are accepted, and not before."""
    prior = bm.Surface(1, 1, mean_scale=0.4, spread=0.28, dof=dof, size_scale=extent)
    mine, theirs = surface_functions(draw(prior)), surface_functions(by_scipy(prior, inside=draw is by_numpy))
    for name, sample in mine.items():
        assert scipy.stats.ks_2samp(sample, theirs[name]).pvalue > ALPHA / CASES / 9, name
    wrong = surface_functions(draw(prior)[:, [0, 1, 4, 3, 2]])  # the twin: x and y the wrong way round
    assert min(scipy.stats.ks_2samp(wrong[name], theirs[name]).pvalue for name in mine) < ALPHA / CASES / 9


def test_a_shuffle_is_a_permutation_for_every_size_and_differs_from_sweep_to_sweep_and_chain_to_chain():
    for size in (*range(1, 2001), 65_535, 65_536, 65_537, 1_000_003):
        orders = shuffles(size, [size, 2**63 + size])
        np.testing.assert_array_equal(np.sort(orders, axis=1), np.tile(np.arange(size), (2, 1)))
    orders = [shuffles_of_chains(100, 1, 3, sweep) for sweep in range(3)]
    assert len(np.unique(np.concatenate(orders), axis=0)) == 9


@pytest.mark.parametrize("size", [2, 3, 4, 7, 16, 100, 441])
def test_every_cell_comes_in_every_place_equally_often_and_before_its_neighbour_half_the_time(size):
    """20 000 shuffles: chi-square over place and cell, false alarms 1e-5 each; a fair coin, 1e-6 each.

    Four rounds on two or three bits are not quite uniform: on a handful of cells within a fifth. Any order is correct.
    """
    found = shuffles(size, np.random.default_rng(1).integers(0, 2**63, 20_000))
    place = np.argsort(found, axis=1)
    for cell in range(0, size - 1, max(1, size // 8)):
        counts = np.bincount(place[:, cell], minlength=size)
        if size < 10:
            assert abs(counts * size / len(found) - 1).max() < 0.2
            continue
        assert scipy.stats.chisquare(counts).pvalue > 1e-5
        assert scipy.stats.binomtest(int((place[:, cell] < place[:, cell + 1]).sum()), len(found)).pvalue > 1e-6
