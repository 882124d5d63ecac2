"""Where files can be no longer than a few kilobytes, as on a disk nearly full: one line, and nothing half-written."""

import pytest
from shell import start
from tiers import full_but

LIMIT_BYTES = 4096


def written_on_a_full_disk(*arguments):
    """What a command says whose files are cut short."""
    cut = f"import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, ({LIMIT_BYTES}, {LIMIT_BYTES}))"
    process = start(*arguments, first=cut)
    out, errors = process.communicate()
    assert process.returncode == 1, errors
    assert out == ""
    assert "please report it" not in errors
    return errors.splitlines()[-1]


@pytest.mark.parametrize("name", full_but(["map.bag", "folder", "map.db3", "map.tif"], "folder"))
def test_exports(office_run, tmp_path, name):
    if name == "map.tif":
        pytest.importorskip("rasterio")
    told = written_on_a_full_disk("export", office_run / "run.nc", "-o", tmp_path / name)
    assert told.startswith(f"bayesmap: error: {tmp_path / name}: ")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.full
def test_a_picture(office_run, tmp_path):
    told = written_on_a_full_disk("render", office_run / "run.nc", "-o", tmp_path / "map.png")
    assert told == f"bayesmap: error: {tmp_path / 'map.png'}: File too large"
    assert list(tmp_path.iterdir()) == []


def test_a_run_goes_on_without_checkpoints_and_says_in_the_end_what_could_not_be_saved(office, tmp_path, short):
    told = written_on_a_full_disk("infer", office, "-o", tmp_path, *short)
    assert told.startswith(f"bayesmap: error: {tmp_path / 'run.nc'}: writing failed; is the disk full?")
    assert [path.name for path in tmp_path.iterdir()] == ["config.toml"]
