"""The gate and two states beside each other: only what stays slower counts, not a machine that was busy for a while."""

from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks.beside import MOST_ROUNDS, ROUNDS, compare
from benchmarks.figure import Figure
from benchmarks.gate import PAUSES_S, Baseline, confirmed, fails, write


def baseline(**changes):
    before = {"value": 2.0, "unit": "s", "better": "lower", "yardstick_s": 0.5, **changes}
    return Baseline("cpu", {"a": before})


def test_times_are_compared_in_yardsticks():
    assert baseline().factor(Figure("a", 4.0, "s", yardstick_s=1.0), "cpu") == 1.0
    assert baseline().factor(Figure("a", 4.0, "s", yardstick_s=0.5), "cpu") == 2.0
    assert baseline(unit="MB").factor(Figure("a", 3.0, "MB"), "cpu") == 1.5  # memory is compared as it is
    assert baseline().factor(Figure("a", 1.0, "s", yardstick_s=1.0), "cuda:0") is None
    assert baseline().factor(Figure("new", 1.0, "s", yardstick_s=1.0), "cpu") is None


def test_rates_and_ratios_are_worse_when_they_are_lower():
    rates = baseline(unit="maps/s", better="higher")
    assert rates.factor(Figure("a", 1.0, "maps/s", "higher", yardstick_s=1.0), "cpu") == 1.0
    assert rates.factor(Figure("a", 1.0, "maps/s", "higher", yardstick_s=0.5), "cpu") == 2.0
    ratios = baseline(unit="x", better="higher")
    assert ratios.factor(Figure("a", 0.5, "x", "higher", yardstick_s=7.0), "cpu") == 4.0


class Machine:
    """Gives times one after the other, and notes how long it was left alone."""

    def __init__(self, *times):
        self.times, self.slept = list(times), []

    def figure(self):
        return Figure("a", self.times.pop(0), "s", yardstick_s=0.5, again=self.figure)

    def confirmed(self):
        return confirmed(self.figure(), lambda f: baseline().factor(f, "cpu"), worse=1.5, sleep=self.slept.append)


def test_a_busy_moment_is_waited_out():
    machine = Machine(9.0, 8.0, 2.0, 99.0)
    assert machine.confirmed().value == 2.0
    assert machine.slept == list(PAUSES_S[:2])
    passes = Machine(2.9, 99.0)
    assert passes.confirmed().value == 2.9
    assert passes.slept == []


def test_what_stays_slow_stays_worse():
    machine = Machine(9.0, 8.0, 7.0, 6.0, 5.0)
    assert machine.confirmed().value == 5.0
    assert machine.slept == list(PAUSES_S)


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
    found = Baseline.read(tmp_path / "b.json")
    assert found.factor(replace(figure, value=3.0), "cpu") == 1.5
    assert Baseline.read(tmp_path / "none.json").factor(figure, "cpu") is None


def test_what_is_saved_takes_the_place_of_its_own_groups_figures_alone(tmp_path):
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


def test_what_looks_worse_is_measured_more_often():
    states = States(old=[{"a": measured(2.0)}], new=[{"a": measured(9.0)}] * 3 + [{"a": measured(2.1)}])
    (found,) = compare(OLD, NEW, "s", states)
    assert found.factor == pytest.approx(1.05)
    assert len(states.calls) == 8


def test_what_stays_worse_is_worse_and_each_round_says_so():
    states, rounds = States(old=[{"a": measured(2.0)}], new=[{"a": measured(3.0)}]), []
    (found,) = compare(OLD, NEW, "s", states, lambda number, found: rounds.append((number, found[0].now)))
    assert found.factor == 1.5
    assert len(states.calls) == 2 * MOST_ROUNDS
    assert rounds[:2] == [(1, 3.0), (2, 3.0)]


def test_lower_rates_are_worse():
    rate = {"a": measured(4.0, better="higher")}
    (found,) = compare(OLD, NEW, "s", States(old=[rate], new=[{"a": measured(2.0, better="higher")}]))
    assert found.factor == 2.0


def test_what_only_one_state_measures_is_left_out():
    states = States(old=[{"a": measured(1.0), "gone": measured(1.0)}], new=[{"a": measured(1.0), "new": measured(1.0)}])
    assert [one.name for one in compare(OLD, NEW, "s", states)] == ["a"]
