"""Chains stop when the mean map is known: its error is told honestly, and where chains stop depends on nothing else."""

import signal
from functools import cache

import numpy as np
import pytest
from flat_options import infer
from scipy import stats

import bayesmap as bm
from bayesmap.run.chains import KNOWN_SHARE, MIN_BATCHES, EndRule, SweepPlan, map_error

CELLS, CHAINS, DRAWS, STICKY = 4000, 4, 400, 0.8


class Traces:
    """Stands for cells and their draws: what each draw expects of each cell, (chains, draws, cells)."""

    def __init__(self, values):
        self.values, (self.chains, self.count, _) = values, values.shape

    def expected_traces(self, draws, cells):
        return self.values[:, :, cells]


def error(values):
    return map_error(Traces(values), Traces(values), np.ones((1, values.shape[-1]), dtype=bool))


@cache
def sticky_chains():
    """Draw autoregressive chains of standard normal values: each is 0.8 of the one before it, and noise."""
    rng = np.random.default_rng(4)
    values = rng.standard_normal((CHAINS, DRAWS, CELLS))
    for i in range(1, DRAWS):
        values[:, i] = STICKY * values[:, i - 1] + np.sqrt(1 - STICKY**2) * values[:, i]
    return values


def expected_error(sd):
    """The 99 % quantile of an estimate from eight batches whose mean has a standard deviation."""
    degrees = MIN_BATCHES - 1
    return sd * np.sqrt(stats.chi2(degrees).ppf(KNOWN_SHARE) / degrees)


def test_the_error_is_that_of_the_mean_of_chains_that_mix_slowly():
    """A quantile over 4000 cells has a relative error of 1 %; neighbouring batches are alike by 5 %."""
    values = sticky_chains()
    true = np.sqrt((1 + STICKY) / (1 - STICKY) / (CHAINS * DRAWS))
    assert values.mean(axis=(0, 1)).std() == pytest.approx(true, rel=0.05)
    assert error(values) == pytest.approx(expected_error(true), rel=0.1)


def test_a_twin_that_takes_draws_as_independent_is_refused():
    values = sticky_chains()
    shuffled = np.random.default_rng(5).permuted(values.reshape(-1, CELLS), axis=0).reshape(values.shape)
    true = np.sqrt((1 + STICKY) / (1 - STICKY) / (CHAINS * DRAWS))
    assert error(shuffled) < 0.5 * expected_error(true)


def test_chains_that_disagree_do_not_know_the_map():
    """Nothing changes within a chain: each alone would be sure."""
    apart = np.broadcast_to(np.array([0.0, 1.0, 0.0, 1.0])[:, None, None], (4, 50, 10))
    assert error(apart) > 0.15
    assert error(np.zeros((4, 50, 10))) == 0.0


@pytest.mark.parametrize(("chains", "draws"), [(4, 3), (1, 15), (8, 1)])
def test_too_few_draws_know_nothing(chains, draws):
    assert error(np.zeros((chains, draws, 3))) == float("inf")
    assert error(np.zeros((chains, draws + 1, 3))) == 0.0


def test_marks_are_fixed_and_ever_further_apart():
    assert SweepPlan(50, 60, 3, 0.03).marks == (80, 95, 110, 125, 143, 164, 191, 224)
    assert SweepPlan(50, 60, 3).marks == ()


WALLS, POSE = bm.worlds.tutorial()
GRID = bm.worlds.TUTORIAL_GRID
ASKED = {"prior": bm.Independent(0.3), "sensor": bm.Gaussian(0.2), "warmup": 20, "draws": 400, "seed": 3}


@cache
def scans():
    angles = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    return bm.simulate(WALLS, GRID, POSE, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=0)


@cache
def stopped_early(threads=2):
    return infer(scans(), GRID, precision=0.04, threads=threads, **ASKED)


def test_chains_stop_at_the_first_mark_at_which_the_map_is_known():
    run, marks = stopped_early(), SweepPlan(20, 400, 1, 0.04).marks
    at = marks.index(run.posterior.sweep)
    assert run.finished
    assert run.summary().map_error <= 0.04
    assert run.summary().problems() == []
    before = infer(scans(), GRID, **ASKED | {"draws": marks[at - 1] - 20})
    assert before.summary().map_error > 0.04


def test_they_draw_what_chains_without_a_precision_draw():
    run = stopped_early()
    longer = infer(scans(), GRID, **ASKED)
    assert longer.n_draws == 400
    np.testing.assert_array_equal(longer.draws[:, : run.n_draws], run.draws)
    np.testing.assert_array_equal(stopped_early(threads=1).draws, run.draws)


@pytest.mark.parametrize("after", [10, 20, 30, 41, 60])
def test_a_run_that_is_stopped_and_goes_on_ends_where_it_would_have(after):
    """Ctrl-C during warm-up, at its end, at a mark, and between two."""

    def stop(event):
        if event.stage in ("warm-up", "draws") and event.done >= after:
            signal.raise_signal(signal.SIGINT)

    stopped = infer(scans(), GRID, precision=0.04, on_progress=stop, **ASKED)
    assert not stopped.finished
    run = infer(scans(), GRID, precision=0.04, resume=stopped, **ASKED)
    assert run.finished
    np.testing.assert_array_equal(run.draws, stopped_early().draws)


def test_a_limit_that_comes_first_is_said():
    run = infer(scans(), GRID, precision=0.001, **ASKED | {"draws": 40})
    assert run.n_draws == 40
    [problem] = run.summary().problems()
    assert "not to 0.001: draw more maps" in problem


def test_a_default_run_stops_early_and_a_number_of_draws_is_kept_to():
    cells = {"prior": bm.Independent(0.3), "sensor": bm.Gaussian(0.2), "seed": 3}
    assert bm.infer(scans(), GRID, **cells).n_draws < 1000
    assert bm.infer(scans(), GRID, schedule=bm.Schedule(draws=70), **cells).n_draws == 70
    for precision in (0.0, -1.0, float("nan")):
        with pytest.raises(bm.BadInput, match="precision must be a positive probability"):
            bm.Schedule(precision=precision)


def test_progress_expects_the_first_mark_and_then_what_the_error_asks_for():
    rule = EndRule(SweepPlan(50, 60, 3, 0.03), lambda: 0.06)
    rule.check(20)
    assert (rule.expected_sweeps(20), rule.error, rule.reached) == (80, None, False)
    rule.check(80)
    assert (rule.expected_sweeps(80), rule.error, rule.reached) == (50 + 4 * 30, 0.06, False)
    assert EndRule(SweepPlan(50, 60, 3), lambda: 0.0).expected_sweeps(20) == 230
