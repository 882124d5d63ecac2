"""Two states of the code are measured in turn, and only what stays worse counts."""

from pathlib import Path

import pytest

from benchmarks.beside import MOST_ROUNDS, ROUNDS, compare

OLD, NEW = Path("old"), Path("new")


def figure(*repeats, better="lower"):
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
        old=[{"a": figure(2.0, 5.0)}, {"a": figure(4.0)}], new=[{"a": figure(3.0, 9.0)}, {"a": figure(2.0)}]
    )
    (found,) = compare(OLD, NEW, "s", states)
    assert (found.before, found.now, found.factor) == (2.0, 2.0, 1.0)
    assert states.calls == [OLD, NEW] * ROUNDS


def test_what_looks_worse_is_measured_more_often():
    states = States(old=[{"a": figure(2.0)}], new=[{"a": figure(9.0)}] * 3 + [{"a": figure(2.1)}])
    (found,) = compare(OLD, NEW, "s", states)
    assert found.factor == pytest.approx(1.05)
    assert len(states.calls) == 8


def test_what_stays_worse_is_worse_and_each_round_says_so():
    states, rounds = States(old=[{"a": figure(2.0)}], new=[{"a": figure(3.0)}]), []
    (found,) = compare(OLD, NEW, "s", states, lambda number, found: rounds.append((number, found[0].now)))
    assert found.factor == 1.5
    assert len(states.calls) == 2 * MOST_ROUNDS
    assert rounds[:2] == [(1, 3.0), (2, 3.0)]


def test_lower_rates_are_worse():
    rate = {"a": figure(4.0, better="higher")}
    (found,) = compare(OLD, NEW, "s", States(old=[rate], new=[{"a": figure(2.0, better="higher")}]))
    assert found.factor == 2.0


def test_what_only_one_state_measures_is_left_out():
    states = States(old=[{"a": figure(1.0), "gone": figure(1.0)}], new=[{"a": figure(1.0), "new": figure(1.0)}])
    assert [one.name for one in compare(OLD, NEW, "s", states)] == ["a"]
