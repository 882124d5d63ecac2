import os
import re
import signal
import sqlite3
import subprocess
import sys

import pytest

import bayesmap
from bayesmap.errors import BadInput
from bayesmap.files import write_whole, write_whole_folder


def test_a_block_s_output_becomes_the_file_unless_the_block_fails(tmp_path):
    path = tmp_path / "run.nc"
    with write_whole(path) as temporary:
        assert temporary.parent == tmp_path
        assert temporary.suffix == ".nc"
        temporary.write_text("whole")
        assert not path.exists()
    assert path.read_text() == "whole"
    with write_whole(path) as temporary:  # libraries may delete and create it
        temporary.unlink()
        temporary.write_text("new")

    def write_half():
        with write_whole(path) as temporary:
            temporary.write_text("half")
            raise RuntimeError("half-way")

    with pytest.raises(RuntimeError, match="half-way"):
        write_half()
    assert path.read_text() == "new"
    with write_whole(path) as one, write_whole(path) as other:  # two programs at once: each has a file of its own
        one.write_text("one")
        other.write_text("the other")
    assert path.read_text() == "one"  # it was closed last
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(("failure", "reason"), [
    (OSError(28, "No space left on device"), "No space left on device"),
    (RuntimeError("NetCDF: HDF error"), "writing failed; is the disk full? (NetCDF: HDF error)"),
    (sqlite3.OperationalError("disk I/O error"), "writing failed; is the disk full? (disk I/O error)"),
])  # fmt: skip
@pytest.mark.parametrize("write", [write_whole, lambda path: write_whole_folder(path, lambda old: True)])
def test_a_full_disk_is_an_error_that_names_the_file_and_not_the_temporary_one(tmp_path, write, failure, reason):
    def fail():
        with write(tmp_path / "run"):
            raise failure

    with pytest.raises(OSError, match=re.escape(reason)) as raised:
        fail()
    assert raised.value.filename == str(tmp_path / "run")
    assert raised.value.strerror == reason
    assert list(tmp_path.iterdir()) == []

    def read_something_else():
        with write_whole(tmp_path / "run"):
            (tmp_path / "other").read_text()

    with pytest.raises(FileNotFoundError) as raised:
        read_something_else()
    assert raised.value.filename == str(tmp_path / "other")


def test_permissions_and_links_stay_and_a_missing_folder_is_noticed_first(tmp_path):
    old, new, usual = tmp_path / "old", tmp_path / "new", tmp_path / "usual"
    old.write_text("")
    old.chmod(0o640)
    usual.write_text("")
    for path in (old, new):
        with write_whole(path) as temporary:
            temporary.write_text("x")
    assert old.stat().st_mode & 0o777 == 0o640
    assert new.stat().st_mode == usual.stat().st_mode

    with pytest.raises(BadInput, match="absent"), write_whole(tmp_path / "absent" / "file"):
        pytest.fail("the block must not run")
    (tmp_path / "there").mkdir()
    link, target = tmp_path / "link", tmp_path / "there" / "file"
    link.symlink_to(target)
    with write_whole(link) as temporary:
        temporary.write_text("x")
    assert link.is_symlink()
    assert target.read_text() == "x"


def test_killed_at_any_moment_the_file_is_old_or_new(tmp_path):
    path = tmp_path / "chain"
    path.write_text("0" * 100_000)
    endless = (
        "import sys, itertools\n"
        "from bayesmap.files import write_whole\n"
        "print('ready', flush=True)\n"
        "for k in itertools.count():\n"
        "    with write_whole(sys.argv[1]) as temporary:\n"
        "        temporary.write_text(str(k % 10) * 100_000)\n"
    )
    source = os.path.dirname(os.path.dirname(bayesmap.__file__))
    for _ in range(3):
        child = subprocess.Popen(
            [sys.executable, "-c", endless, str(path)], stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": source}
        )
        assert child.stdout.readline() == b"ready\n"
        child.send_signal(signal.SIGKILL)
        child.wait()
        child.stdout.close()
        text = path.read_text()
        assert (len(text), len(set(text))) == (100_000, 1)
