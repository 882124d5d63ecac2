"""Stopped runs: Ctrl-C, SIGKILL, and going on bit for bit."""

import json
import os
import signal

import numpy as np
import pytest
from shell import call, start, wait_for

import bayesmap as bm
from bayesmap.cli.folder import Folder

LONG = (
    "--resolution", "0.25", "--chains", "2", "--warmup", "20", "--draws", "30", "--thin", "400", "--no-progress",
    "--checkpoint-every", "0",
)  # fmt: skip
"""Options of a run of some seconds."""


def same(one, other):
    """Equal draws, traces and ends of the chains."""
    for name in ("packed", "log_likelihood", "log_prior", "warmup_log_joint", "walls", "occupancy"):
        np.testing.assert_array_equal(getattr(one.posterior, name), getattr(other.posterior, name))


@pytest.fixture(scope="module")
def uninterrupted(office, tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole") / "run"
    result = call("infer", office, "-o", folder, *LONG)
    assert result.exit_code == 0, result.stderr
    return bm.load(folder / "run.nc")


def interrupt_at_checkpoint(monkeypatch):
    """Press Ctrl-C as soon as the first checkpoint is there."""
    save = Folder.checkpoint

    def checkpoint(self, run):
        save(self, run)
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(Folder, "checkpoint", checkpoint)


def test_ctrl_c_exits_130_and_resume_goes_on_bit_for_bit(office, tmp_path, uninterrupted):
    folder = tmp_path / "run"
    process = start("infer", office, "-o", folder, *LONG, "--json")
    wait_for(folder / "run.nc", process)
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate()
    assert process.returncode == 130, errors
    assert f"bayesmap infer {office} -o {folder} --resume" in errors
    document = json.loads(out)
    assert document["finished"] is False
    assert list(document["outputs"]) == ["run.nc"]
    stopped = bm.load(folder / "run.nc")
    assert not stopped.finished
    assert 20 <= stopped.posterior.sweep < uninterrupted.posterior.sweep
    assert sorted(path.name for path in folder.iterdir()) == ["config.toml", "run.nc"]

    # The settings need not be said again.
    resumed = call("infer", office, "-o", folder, "--resume", "--json")
    assert resumed.exit_code == 0, resumed.stderr
    assert json.loads(resumed.stdout)["finished"] is True
    same(bm.load(folder / "run.nc"), uninterrupted)


def test_sigkill_leaves_the_last_checkpoint_whole(office, tmp_path, uninterrupted):
    folder = tmp_path / "run"
    process = start("infer", office, "-o", folder, *LONG)
    wait_for(folder / "run.nc", process)
    process.kill()
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    assert bm.load(folder / "run.nc").posterior.sweep >= 20
    resumed = call("infer", office, "-o", folder, "--resume")
    assert resumed.exit_code == 0, resumed.stderr
    same(bm.load(folder / "run.nc"), uninterrupted)


def test_other_settings_or_another_log_are_refused_and_nothing_is_lost(office, tmp_path, short, monkeypatch):
    folder = tmp_path / "run"
    with monkeypatch.context() as patch:
        interrupt_at_checkpoint(patch)
        assert call("infer", office, "-o", folder, *short).exit_code == 130
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    other = tmp_path / "other.log"
    other.write_text("\n".join(office.read_text().splitlines()[:-1]))
    for arguments, message in (
        ([office, "--seed", "4"], "seed (0, now 4)"),
        ([office, "--draws", "9", "--thin", "2"], "draws (8, now 9); thin (1, now 2)"),
        ([office, "--resolution", "0.5"], "the saved run was made with other"),
        ([other], "scans or on another grid"),
    ):
        result = call("infer", *arguments, "-o", folder, "--resume")
        assert result.exit_code == 3, result.stderr
        assert message in result.stderr
        assert result.stdout == ""
        assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_resume_where_nothing_was_saved_starts_from_the_beginning(office, tmp_path, short):
    result = call("infer", office, "-o", tmp_path / "run", *short, "--resume")
    assert result.exit_code == 0
    assert "no run to resume; starting from the beginning" in result.stderr


def test_resume_of_a_finished_run_changes_nothing(office, tmp_path, short):
    folder = tmp_path / "run"
    assert call("infer", office, "-o", folder, *short).exit_code == 0
    before = bm.load(folder / "run.nc")
    assert call("infer", office, "-o", folder, "--resume").exit_code == 0
    same(bm.load(folder / "run.nc"), before)


def test_an_impatient_ctrl_c_keeps_the_last_checkpoint(office, tmp_path, short, monkeypatch):
    folder = tmp_path / "run"
    save = Folder.checkpoint

    def checkpoint(self, run):
        save(self, run)
        raise KeyboardInterrupt

    monkeypatch.setattr(Folder, "checkpoint", checkpoint)
    result = call("infer", office, "-o", folder, *short)
    assert result.exit_code == 130
    assert f"the last checkpoint is kept; go on with:\n  bayesmap infer {office}" in result.stderr
    assert bm.load(folder / "run.nc").posterior.sweep == 5


def test_interrupted_in_its_warm_up_a_run_has_no_picture_yet(office, tmp_path, monkeypatch):
    folder = tmp_path / "run"
    long = ("--resolution", "0.25", "--warmup", "20000", "--draws", "2", "--checkpoint-every", "0", "--chains", "1")
    interrupt_at_checkpoint(monkeypatch)
    assert call("infer", office, "-o", folder, *long).exit_code == 130
    assert 0 < bm.load(folder / "run.nc").posterior.sweep < 20000
    for command in ("render", "export"):
        result = call(command, folder / "run.nc")
        assert result.exit_code == 3
        assert "the run has no draws yet" in result.stderr


def test_a_full_disk_at_a_checkpoint_is_a_warning(office, tmp_path, short, monkeypatch):
    save = bm.Run.save
    calls = []

    def full(self, path):
        calls.append(path)
        if len(calls) == 1:
            raise OSError(28, "No space left on device")
        save(self, path)

    monkeypatch.setattr(bm.Run, "save", full)
    result = call("infer", office, "-o", tmp_path / "run", *short)
    assert result.exit_code == 0
    assert "checkpoint could not be written: No space left on device" in result.stderr
