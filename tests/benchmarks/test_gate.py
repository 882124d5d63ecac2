"""Figures are the best of their repeats; the gate counts what stays slower, not a machine that was busy."""

import itertools
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import pytest

from benchmarks import figure, yardstick
from benchmarks.beside import MOST_ROUNDS, ROUNDS, compare
from benchmarks.figure import Figure, derived, mean_for, ratio, repeated, timed
from benchmarks.gate import PAUSES_S, Baseline, confirmed, fails, write


@pytest.fixture(autouse=True)
def quick_yardstick(monkeypatch):
    """The yardstick takes 3, 2, 1, 1, ... seconds."""
    times = itertools.chain([3.0, 2.0], itertools.repeat(1.0))
    monkeypatch.setattr(yardstick, "seconds", lambda for_s: next(times))


def test_the_best_repeat_counts_and_more_can_be_taken():
    samples = iter([5.0, 4.0, 6.0, 2.0, 7.0, 8.0])
    first = repeated(lambda: next(samples), lambda all_: Figure("a", min(all_), "s"), repeats=3)
    assert ((first.value, first.yardstick_s), first.again().value) == ((4.0, 1.0), 2.0)


def test_a_ratio_is_of_the_fastest_of_each_measured_in_turn(monkeypatch):
    monkeypatch.setattr(figure, "LONGEST_S", 0.0)
    calls, times = [], {"theirs": iter([30.0, 20.0, 90.0]), "ours": iter([9.0, 3.0, 2.0])}

    def seconds(name):
        calls.append(name)
        return next(times[name])

    found = ratio("r", *(partial(seconds, name) for name in times), repeats=3, against=lambda seconds: f"{seconds:g} s")
    assert found.value == 10.0
    assert found.spread == (30 / 9, 45.0)
    assert (found.against, found.better) == ("20 s", "higher")
    assert calls == ["theirs", "ours"] * 3


def test_timed_work_is_divided_by_its_units_after_a_run_that_does_not_count():
    calls = []

    def work():
        calls.append(1)
        return 10**9

    found = timed("t", work, unit="s", scale=1.0, repeats=2)
    assert len(calls) == 3
    assert 0 < found.value < 1e-6


def test_a_derived_figure_measures_its_sources_again():
    samples = iter([4.0, 2.0, 3.0, 1.0])
    one = repeated(lambda: next(samples), lambda all_: Figure("a", min(all_), "s"), repeats=1)
    double = derived("d", [one, Figure("fixed", 10.0, "MB")], sum)
    assert (double.value, double.again().value) == (14.0, 12.0)
    assert double.again().again().value == 11.0


def test_json_says_everything_but_how_to_measure_again():
    assert Figure("a", 1.0, "s", spread=(1.0, 2.0), again=lambda: None).to_json() == {
        "name": "a", "value": 1.0, "unit": "s", "better": "lower", "spread": (1.0, 2.0), "against": "",
        "yardstick_s": None, "gated": True,
    }  # fmt: skip


def test_the_yardstick_lasts_as_long_as_what_it_is_held_against(monkeypatch):
    clock, asked = Clock(), []
    monkeypatch.setattr(figure, "time", clock)
    monkeypatch.setattr(yardstick, "seconds", lambda for_s: asked.append(for_s) or 1.0)
    timed("t", clock.work(0.5, lambda: 1), unit="s", scale=1.0, repeats=2)
    assert asked == [0.5, 0.5]


def test_the_yardstick_is_the_mean_of_its_runs(monkeypatch):
    monkeypatch.undo()
    ticks = iter([0.0, 1.0, 2.0, 3.0, 3.0])
    monkeypatch.setattr(yardstick, "time", SimpleNamespace(perf_counter=lambda: next(ticks)))
    assert yardstick.seconds(2.5) == 1.0


class Clock:
    """Stands still but when work is done."""

    def __init__(self):
        self.now_s = 0.0

    def perf_counter(self):
        return self.now_s

    def work(self, lasts_s, says):
        def seconds():
            self.now_s += lasts_s
            return says()

        return seconds


def test_the_shorter_of_two_is_repeated_for_as_long_as_the_longer(monkeypatch):
    clock, ours = Clock(), iter([1.0, 3.0, 2.0, 2.0, 99.0])
    monkeypatch.setattr(figure, "time", clock)
    assert ratio("r", clock.work(1.0, lambda: 8.0), clock.work(0.25, lambda: next(ours)), repeats=1).value == 4.0
    assert next(ours) == 99.0
    once = iter([1.0, 99.0])
    assert mean_for(clock.work(5.0, lambda: next(once)), 2.0) == 1.0  # the longer of two is done once


def baseline(**changes):
    return Baseline("cpu", {"a": {"value": 2.0, "unit": "s", "better": "lower", "yardstick_s": 0.5, **changes}})


RATES, RATIOS = {"unit": "maps/s", "better": "higher"}, {"unit": "x", "better": "higher"}


@pytest.mark.parametrize(("before", "value", "yardstick_s", "factor"), [
    ({}, 4.0, 1.0, 1.0), ({}, 4.0, 0.5, 2.0), ({"unit": "MB"}, 3.0, None, 1.5),  # memory is compared as it is
    (RATES, 1.0, 1.0, 1.0), (RATES, 1.0, 0.5, 2.0), (RATIOS, 0.5, 7.0, 4.0),  # lower rates and ratios are worse
])  # fmt: skip
def test_times_and_rates_are_compared_in_yardsticks(before, value, yardstick_s, factor):
    fields = {"unit": "s", "better": "lower", **before}
    measured = Figure("a", value, **fields, yardstick_s=yardstick_s)
    assert baseline(**before).factor(measured, "cpu") == factor
    assert baseline(**before).factor(measured, "cuda:0") is None
    assert baseline(**before).factor(replace(measured, name="new"), "cpu") is None


class Machine:
    """Gives times one after the other, and notes how long it was left alone."""

    def __init__(self, *times):
        self.times, self.slept = list(times), []

    def figure(self):
        return Figure("a", self.times.pop(0), "s", yardstick_s=0.5, again=self.figure)

    def confirmed(self):
        return confirmed(self.figure(), lambda f: baseline().factor(f, "cpu"), worse=1.5, sleep=self.slept.append)


@pytest.mark.parametrize(("times", "value", "pauses"), [
    ((9.0, 8.0, 2.0, 99.0), 2.0, 2), ((2.9, 99.0), 2.9, 0), ((9.0, 8.0, 7.0, 6.0, 5.0), 5.0, len(PAUSES_S)),
], ids=["a busy moment", "no worse", "slow for ever"])  # fmt: skip
def test_a_busy_moment_is_waited_out_and_a_machine_that_stays_slow_is_not(times, value, pauses):
    machine = Machine(*times)
    assert (machine.confirmed().value, machine.slept) == (value, list(PAUSES_S[:pauses]))


def test_a_ratio_to_a_peer_fails_nothing():
    figure = Figure("a", 9.0, "s", yardstick_s=0.5, gated=False, again=pytest.fail)
    assert confirmed(figure, lambda f: 4.5) is figure
    assert not fails(figure, 4.5)
    assert fails(replace(figure, gated=True), 4.5)
    alone = replace(figure, gated=True, again=None)  # cannot be measured again
    assert confirmed(alone, lambda f: 4.5, sleep=pytest.fail) is alone


def test_a_baseline_is_read_as_it_was_written(tmp_path):
    figure = Figure("a", 2.0, "s", yardstick_s=0.5, spread=(2.0, 3.0))
    write(tmp_path / "b.json", "cpu", "0.1", {"a": figure})
    assert Baseline.read(tmp_path / "b.json").factor(replace(figure, value=3.0), "cpu") == 1.5
    assert Baseline.read(tmp_path / "none.json").factor(figure, "cpu") is None


def test_saved_figures_replace_those_of_their_own_groups_alone(tmp_path):
    path, figure = tmp_path / "b.json", Figure("", 1.0, "MB")
    write(path, "cpu", "0.1", {"walls/a": figure, "poses/b": figure})
    measured = {"walls/c": figure}
    write(path, "cpu", "0.1", measured, Baseline.read(path).besides(measured, "cpu"))
    assert set(Baseline.read(path).figures) == {"poses/b", "walls/c"}
    assert Baseline.read(path).besides(measured, "cuda:0") == {}


def test_the_committed_baseline_can_be_compared_with():
    from benchmarks.run import BASELINE

    baseline = Baseline.read(BASELINE)
    for name, before in baseline.figures.items():
        fields = {key: before[key] for key in ("value", "unit", "better", "yardstick_s")}
        assert baseline.factor(Figure(name, **fields), baseline.device) == pytest.approx(1.0), name


OLD, NEW = Path("old"), Path("new")


def measured(*repeats, better="lower"):
    value = min(repeats) if better == "lower" else max(repeats)
    return {"value": value, "spread": [min(repeats), max(repeats)], "unit": "s", "better": better}


class States:
    """Says what each state measures, round for round, the last for ever."""

    def __init__(self, **rounds):
        self.rounds, self.calls = rounds, []

    def __call__(self, state, suite):
        self.calls.append(state)
        rounds = self.rounds[state.name]
        return rounds[min(self.calls.count(state) - 1, len(rounds) - 1)]


def test_states_take_turns_and_the_best_repeats_count():
    states = States(
        old=[{"a": measured(2.0, 5.0)}, {"a": measured(4.0)}], new=[{"a": measured(3.0, 9.0)}, {"a": measured(2.0)}]
    )
    (found,) = compare(OLD, NEW, "s", states)
    assert (found.before, found.now, found.factor) == (2.0, 2.0, 1.0)
    assert states.calls == [OLD, NEW] * ROUNDS


def test_a_figure_that_looks_worse_is_measured_more_often():
    states = States(old=[{"a": measured(2.0)}], new=[{"a": measured(9.0)}] * 3 + [{"a": measured(2.1)}])
    (found,) = compare(OLD, NEW, "s", states)
    assert (found.factor, len(states.calls)) == (pytest.approx(1.05), 8)


def test_a_figure_that_stays_worse_is_worse_and_each_round_says_so():
    states, rounds = States(old=[{"a": measured(2.0)}], new=[{"a": measured(3.0)}]), []
    (found,) = compare(OLD, NEW, "s", states, lambda number, found: rounds.append((number, found[0].now)))
    assert found.factor == 1.5
    assert len(states.calls) == 2 * MOST_ROUNDS
    assert rounds[:2] == [(1, 3.0), (2, 3.0)]


def test_lower_rates_are_worse():
    rate = {"a": measured(4.0, better="higher")}
    (found,) = compare(OLD, NEW, "s", States(old=[rate], new=[{"a": measured(2.0, better="higher")}]))
    assert found.factor == 2.0


def test_figures_of_one_state_alone_are_left_out():
    states = States(old=[{"a": measured(1.0), "gone": measured(1.0)}], new=[{"a": measured(1.0), "new": measured(1.0)}])
    assert [one.name for one in compare(OLD, NEW, "s", states)] == ["a"]
