"""Verdicts on chains and particles."""

import math

import numpy as np
import pytest

from bayesmap.app.shown.result import Difference, difference, judge_chains, judge_particles


@pytest.mark.parametrize(
    ("rhat", "ess", "apart", "level"),
    [
        (1.001, 900, 0.03, "good"),
        (1.02, 900, 0.03, "fair"),
        (1.001, 300, 0.03, "fair"),
        (1.06, 900, 0.03, "bad"),
        (1.001, 20, 0.03, "bad"),
        (1.001, 900, 0.5, "bad"),
        (math.nan, math.nan, 0.5, "bad"),
    ],
)
def test_verdicts(rhat, ess, apart, level):
    found = judge_chains(rhat, ess, 1000, Difference(apart, (3, 4)))
    assert found.level == level
    assert ("(3, 4)" in found.why) == (apart > 0.25)


def test_nothing_is_said_too_early_or_of_a_log_joint_that_never_changed():
    assert judge_chains(2.0, 3, 20, None) is None
    assert judge_chains(2.0, 3, 20, None, over=True).level == "bad"
    assert judge_chains(math.nan, math.nan, 1000, Difference(0.0, (0, 0))) is None


def test_of_few_sweeps_that_are_over_the_log_joint_alone_speaks():
    apart = Difference(1.0, (3, 4))  # the means of a few draws differ by chance
    found = judge_chains(1.465, 7, 10, apart, over=True)
    assert found.level == "bad"
    assert "R-hat" in found.why
    assert judge_chains(1.001, 900, 150, apart, over=True).level == "good"


@pytest.mark.parametrize("sweeps", [1, 3])
def test_so_few_that_there_is_no_r_hat_are_called_too_few(sweeps):
    assert judge_chains(math.nan, math.nan, sweeps, None) is None
    found = judge_chains(math.nan, math.nan, sweeps, None, over=True)
    assert found.level == "bad"
    assert found.why.startswith(f"{sweeps} sweep")


def test_the_difference_is_the_largest_among_the_observed_cells():
    means = np.zeros((3, 4, 5))
    means[0, 1, 2], means[2, 3, 3] = 0.5, 0.9
    among = np.ones((4, 5), dtype=bool)
    assert difference(means, among) == Difference(0.9, (3, 3))
    among[3, 3] = False
    assert difference(means, among) == Difference(0.5, (1, 2))
    assert difference(means[:1], among) is None
    assert difference(means, np.zeros((4, 5), dtype=bool)) is None


@pytest.mark.parametrize(("ess", "level"), [(1.0, "bad"), (100, "fair"), (5000, "good")])
def test_particles(ess, level):
    assert judge_particles(ess).level == level


@pytest.mark.parametrize(
    ("ess", "why"), [(1.0, "one particle carries all the weight"), (1.2, "1.2 particles carry all the weight")]
)
def test_one_particle_is_called_one(ess, why):
    assert judge_particles(ess).why == why
