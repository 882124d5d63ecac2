"""Processes that are started to ignore Ctrl-C, as a script's shell starts jobs in the background."""

import json
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from shell import PATIENCE_S, Listener, start, wait_for

import bayesmap as bm
from bayesmap.run.runner import stop_on_interrupt

IGNORE = "import signal\nsignal.signal(signal.SIGINT, signal.SIG_IGN)"


def test_an_ignored_ctrl_c_does_not_stop_a_run(office, tmp_path, short):
    """Without a terminal there is no bar, and only data on standard output."""
    folder = tmp_path / "run"
    process = start("infer", office, "-o", folder, *short[:-1], "--checkpoint-every 0 --json", first=IGNORE)
    wait_for(folder / "run.nc", process)
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate()
    assert process.returncode == 0, errors
    assert json.loads(out)["schema_version"] == 1
    assert "\x1b" not in out + errors
    assert "\r" not in errors
    assert bm.load(folder / "run.nc").finished


@pytest.mark.full
def test_an_ignored_ctrl_c_does_not_end_the_page():
    process = start("app", "--no-browser", first=IGNORE)
    try:
        assert Listener(process).line().startswith("http://")
        process.send_signal(signal.SIGINT)
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(2.0)
        process.terminate()
        process.communicate(timeout=PATIENCE_S)
        assert process.returncode is not None
    finally:
        process.kill()
        process.communicate()


def test_ctrl_c_is_a_request_only_where_it_can_come():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with stop_on_interrupt() as stopped:
            signal.raise_signal(signal.SIGINT)
            assert not stopped()
            assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)
    with stop_on_interrupt() as stopped:
        signal.raise_signal(signal.SIGINT)
        assert stopped()
    elsewhere = threading.Thread(target=_never_stopped)
    elsewhere.start()
    elsewhere.join()


def _never_stopped():
    with stop_on_interrupt() as stopped:
        assert not stopped()


PRESSED = """
import signal
import subprocess
import sys

def test_here():
    try:
        signal.raise_signal(signal.SIGINT)
    except KeyboardInterrupt:
        return
    raise AssertionError("Ctrl-C was ignored")

def test_in_a_child():
    code = "import signal; signal.raise_signal(signal.SIGINT)"
    done = subprocess.run([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
    assert done.returncode == -signal.SIGINT
"""


@pytest.mark.full
@pytest.mark.parametrize("with_settings", [True, False])
def test_tests_may_press_ctrl_c_even_where_they_were_started_to_ignore_it(tmp_path, with_settings):
    """The second case shows what the settings of all tests (tests/conftest.py) are for."""
    (tmp_path / "test_pressed.py").write_text(PRESSED)
    tests = Path(__file__).parents[1]
    if with_settings:
        (tmp_path / "conftest.py").write_text((tests / "conftest.py").read_text())
    run = f"{IGNORE}\nimport pytest\nraise SystemExit(pytest.main(['-q', '-p', 'no:cacheprovider']))"
    done = subprocess.run(
        [sys.executable, "-c", run], cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(tests)}, capture_output=True,
        text=True, check=False,
    )  # fmt: skip
    assert ("2 passed" if with_settings else "2 failed") in done.stdout
