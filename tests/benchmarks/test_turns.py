"""A process that does one repeat whenever it is told to, and what becomes of one that does not."""

import os
import sys

import pytest

from benchmarks.environments import PEERS
from benchmarks.turns import TurnFailed, turns

PEER = f"""
import sys
sys.path.insert(0, {str(PEERS)!r})
import harness
calls = []
def prepare(prior):
    print("what a library prints does not disturb the answers")
    return harness.Ready(lambda: calls.append(1), 4, lambda: len(calls))
case = harness.Case(prepare, 0.5, "sweep")
harness.main("toy", "A toy.", {{"a": case}}, ("numpy",), lambda prior: -prior, lambda: {{"passed": True}})
"""


def started(code, timeout_s=60.0, *arguments):
    command = [sys.executable, "-c", code, *arguments]
    return turns(command, cores=None, environment=os.environ, timeout_s=timeout_s)


def test_it_says_what_it_is_and_repeats_when_told():
    with started(PEER, 60.0, "--case", "a", "--in-turn") as process:
        assert process.about["peer"] == "toy"
        assert process.about["log_joint_of_truth"] == -0.5
        assert set(process.about["versions"]) == {"python", "numpy"}
        seconds = [process.seconds() for _ in range(3)]
        assert [answer["seconds"] for answer in process.answers] == seconds
        assert min(seconds) >= 0.0


def test_one_that_cannot_be_set_up_gives_its_last_words():
    with pytest.raises(TurnFailed, match="ValueError: no such problem"), started('raise ValueError("no such problem")'):
        pass


def test_one_that_takes_too_long_is_ended():
    slow = "import json, time\nprint(json.dumps({}), flush=True)\ninput()\ntime.sleep(600)"
    with started(slow, 2.0) as process, pytest.raises(TurnFailed, match="not done after 2 s"):
        process.seconds()


def test_one_that_has_ended_is_noticed():
    with started("print('{}', flush=True)") as process, pytest.raises(TurnFailed):
        process.seconds()
