"""Verdicts on chains and particles."""

import math
from dataclasses import replace

import numpy as np
import pytest
from acted_engine import Heard

from bayesmap.app.edits import tutorial_document
from bayesmap.app.shown.result import Difference, difference, judge_chains, judge_particles, misfit_of

NAN = math.nan


@pytest.mark.parametrize(("rhat", "ess", "sweeps", "apart", "over", "level", "why"), [
    (1.001, 900, 1000, 0.03, False, "good", "R-hat"), (1.02, 900, 1000, 0.03, False, "fair", "R-hat"),
    (1.001, 300, 1000, 0.03, False, "fair", "300 effective"), (1.06, 900, 1000, 0.03, False, "bad", "R-hat"),
    (1.001, 20, 1000, 0.03, False, "bad", "20 effective"), (1.001, 900, 1000, 0.5, False, "bad", "cell (3, 4)"),
    (NAN, NAN, 1000, 0.5, False, "bad", "cell (3, 4)"),
    (NAN, NAN, 1000, 0.0, False, "good", "nothing varies"),  # a log joint that never changed
    (NAN, NAN, 1000, None, True, "fair", "nothing varies"),  # of one chain, or a saved run
    (2.0, 3, 20, None, False, None, ""),  # too early
    (2.0, 3, 20, None, True, "bad", "R-hat"),
    # of few sweeps that are over the log joint alone speaks: their means differ by chance
    (1.465, 7, 10, 1.0, True, "bad", "R-hat"), (1.001, 900, 150, 1.0, True, "good", "R-hat"),
    (NAN, NAN, 1, None, False, None, ""), (NAN, NAN, 1, None, True, "bad", "1 sweep is"),
    (NAN, NAN, 3, None, True, "bad", "3 sweeps are"),
])  # fmt: skip
def test_verdicts(rhat, ess, sweeps, apart, over, level, why):
    found = judge_chains(
        rhat, ess, sweeps, None if apart is None else Difference(apart, (3, 4), 2 * (apart > 0.25), 100), over=over
    )
    assert (found and found.level) == level
    assert found is None or why in found.why
    assert found is None or ("(3, 4)" in found.why) == ("(3, 4)" in why)


def test_chains_that_agree_on_maps_that_the_readings_contradict_are_not_called_converged():
    beams, sigma_m = 50, 0.3
    peak = -beams * math.log(sigma_m * math.sqrt(2 * math.pi))
    true = np.random.default_rng(0).chisquare(beams, (20_000, 1))
    assert sum(misfit_of(peak - one[None] / 2, sigma_m, beams) is not None for one in true) <= 3
    off = misfit_of(np.full((2, 9), peak - 4 * beams / 2), sigma_m, beams)  # twice the noise
    assert off == pytest.approx(2.0)
    assert misfit_of(np.zeros((2, 0)), sigma_m, beams) is misfit_of(np.ones((2, 3)), sigma_m, 0) is None
    for rhat, ess in ((1.001, 900), (NAN, NAN)):
        found = judge_chains(rhat, ess, 1000, Difference(0.0, (0, 0), 0, 9), misfit=off)
        assert (found.level, "readings contradict: they differ by 2 times the noise" in found.why) == ("bad", True)
    assert "R-hat" in judge_chains(1.2, 900, 1000, None, misfit=off).why  # they do not agree


@pytest.mark.parametrize("method", ["gibbs", "block"])
def test_rare_walls_cell_by_cell_from_the_prior_are_seen_to_be_impossible_and_blocks_are_not(method):
    document = replace(tutorial_document(), prior=0.05, method=method, start="prior", sweeps=250, seed=3)
    heard = Heard()
    verdict = heard.infer(document)[0]["verdict"]
    stream = heard.engine._result.found
    likelihood = stream._log_likelihood[:, stream._past[0].sweep :]
    assert (misfit_of(likelihood, document.noise, document.angles) is None) == (method == "block")
    assert (verdict["level"] == "bad") == (method == "gibbs")


def test_settings_are_told_as_they_were_set():
    heard = Heard()
    about = dict(heard.infer(replace(tutorial_document(), prior=0.0, pose_sigma=0.2, sweeps=5))[0]["about"])
    assert about["Prior"] == "independent: p wall 0"
    assert about["Poses"] == "uncertain: sigma 0.2 m"


def test_the_difference_is_the_largest_among_the_observed_cells():
    means = np.zeros((3, 4, 5))
    means[0, 1, 2], means[2, 3, 3] = 0.5, 0.9
    among = np.ones((4, 5), dtype=bool)
    assert difference(means, among) == Difference(0.9, (3, 3), 2, 20)
    among[3, 3] = False
    assert difference(means, among) == Difference(0.5, (1, 2), 1, 19)
    assert difference(means[:1], among) is None
    assert difference(means, np.zeros((4, 5), dtype=bool)) is None


@pytest.mark.parametrize(("ess", "level", "why"), [
    (1.0, "bad", "one particle carries all the weight"), (1.2, "bad", "1.2 particles carry all the weight"),
    (100, "fair", "100 effective particles"), (5000, "good", "5000 effective particles"),
])  # fmt: skip
def test_particles(ess, level, why):
    found = judge_particles(ess)
    assert (found.level, found.why) == (level, why)


def test_one_cell_of_a_hundred_makes_no_verdict_red_and_the_words_are_the_kind_s():
    def judged(cells):
        return judge_chains(1.001, 900, 1000, Difference(0.9, (3, 4), cells, 200), mean="mean reflectivity")

    assert judged(2).level == "good"
    assert (judged(3).level, judged(3).cell) == ("bad", (3, 4))
    assert judged(3).why.startswith("mean reflectivity differs by over 0.25 between the chains in 3 of 200")
