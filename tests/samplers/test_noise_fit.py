"""The likeliest noise is that which the residuals were drawn from: its scale, its growth, and its tails.

Data are drawn anew for each of some seeds; tolerances are in standard errors from these. False alarms: below 1e-4.
"""

import math

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.samplers.fit import SHAPES, StopResiduals, refit_noise

COUNT = 10_000
FIRST = bm.Gaussian(0.02, 0.002)


def residuals(noise, seed, count=COUNT):
    """Of stops at 1 to 15 m whose surfaces spread up to 3 cm: the scale of a reading is that of both together."""
    rng = np.random.default_rng(seed)
    distance = rng.uniform(1.0, 15.0, count)
    variance = rng.uniform(0.0, 0.03, count) ** 2
    scale = np.hypot(noise.scale_at(distance), np.sqrt(variance))
    return StopResiduals(scale * noise.draw(rng, (count,)), distance, variance, np.ones(count))


def fitted(found):
    noise = FIRST
    for _ in SHAPES:
        noise = refit_noise(noise, found, 1.0)
    return noise


@pytest.mark.parametrize("dof", SHAPES)
def test_shape_scale_and_growth_are_found(dof):
    truth = bm.Gaussian(0.01, 0.003) if dof == math.inf else bm.StudentT(0.01, dof, 0.003)
    found = [fitted(residuals(truth, seed)) for seed in range(6)]
    assert [type(noise) for noise in found] == [type(truth)] * 6
    numbers = np.array([(n.dof, n.sigma_m, n.sigma_per_m) for n in (one.kernel_parameters() for one in found)])
    assert (numbers[:, 0] == truth.kernel_parameters().dof).all()
    error = numbers[:, 1:].std(axis=0, ddof=1) / np.sqrt(len(found))
    assert (abs(numbers[:, 1:].mean(axis=0) - [0.01, 0.003]) < 6 * error).all()
    assert (error < [0.0008, 0.00015]).all()


def test_few_readings_do_not_make_heavy_tails():
    """Normal ones, 60 at a time: a number more has to be worth its while."""
    shapes = [type(fitted(residuals(bm.Gaussian(0.02), seed, count=60))) for seed in range(40)]
    assert shapes.count(bm.StudentT) < 8  # 2 expected; 8 or more are chance less often than once in 10 000 runs
    heavy = [type(fitted(residuals(bm.StudentT(0.02, 3.0), seed, count=600))) for seed in range(5)]
    assert heavy == [bm.StudentT] * 5


def test_a_part_of_a_step_goes_a_part_of_the_way_and_leaves_the_shape():
    found = residuals(bm.StudentT(0.01, 3.0, 0.003), 0)
    whole = refit_noise(bm.StudentT(0.04, 9.0, 0.001), found, 1.0)
    assert whole.dof == 5.0  # one shape at a time
    normal, half = refit_noise(FIRST, found, 0.5), refit_noise(FIRST, found, 0.25)
    assert isinstance(normal, bm.Gaussian)
    assert math.log(normal.sigma_m / FIRST.sigma_m) == pytest.approx(2 * math.log(half.sigma_m / FIRST.sigma_m))


def test_too_few_readings_change_nothing():
    assert refit_noise(FIRST, residuals(bm.Gaussian(0.02), 0, count=9), 1.0) is FIRST
