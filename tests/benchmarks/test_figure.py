"""A figure is the best of its repeats, and repeats of what is compared are taken in turn."""

import itertools
from types import SimpleNamespace

import pytest

from benchmarks import figure, yardstick
from benchmarks.figure import Figure, derived, mean_for, ratio, repeated, timed


@pytest.fixture(autouse=True)
def quick_yardstick(monkeypatch):
    """The yardstick takes 3, 2, 1, 1, ... seconds."""
    times = itertools.chain([3.0, 2.0], itertools.repeat(1.0))
    monkeypatch.setattr(yardstick, "seconds", lambda for_s: next(times))


def test_the_best_repeat_counts_and_more_can_be_taken():
    samples = iter([5.0, 4.0, 6.0, 2.0, 7.0, 8.0])
    first = repeated(lambda: next(samples), lambda all_: Figure("a", min(all_), "s"), repeats=3)
    assert first.value == 4.0
    assert first.yardstick_s == 1.0
    assert first.again().value == 2.0


def test_a_ratio_is_of_the_fastest_of_each_measured_in_turn(monkeypatch):
    monkeypatch.setattr(figure, "LONGEST_S", 0.0)
    calls, theirs, ours = [], iter([30.0, 20.0, 90.0]), iter([9.0, 3.0, 2.0])

    def slower():
        calls.append("theirs")
        return next(theirs)

    def faster():
        calls.append("ours")
        return next(ours)

    found = ratio("r", slower, faster, repeats=3, against=lambda seconds: f"{seconds:g} s")
    assert found.value == 10.0
    assert found.spread == (30 / 9, 45.0)
    assert found.against == "20 s"
    assert found.better == "higher"
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
    assert double.value == 14.0
    assert double.again().value == 12.0
    assert double.again().again().value == 11.0


def test_json_says_everything_but_how_to_measure_again():
    found = Figure("a", 1.0, "s", spread=(1.0, 2.0), again=lambda: None)
    assert found.to_json() == {
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
    found = ratio("r", clock.work(1.0, lambda: 8.0), clock.work(0.25, lambda: next(ours)), repeats=1)
    assert found.value == 4.0
    assert next(ours) == 99.0
    once = iter([1.0, 99.0])
    assert mean_for(clock.work(5.0, lambda: next(once)), 2.0) == 1.0  # the longer of two is done once
