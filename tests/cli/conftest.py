"""A small building's log, simulated once."""

import pytest
from shell import call

SHORT = ("--resolution", "0.25", "--chains", "2", "--warmup", "5", "--draws", "8", "--no-progress")
"""Options of a run that takes a moment."""


@pytest.fixture(scope="session")
def office(tmp_path_factory):
    """A log of 12 scans in a small building; its truth lies beside it."""
    log = tmp_path_factory.mktemp("office") / "office.log"
    size = ("--size", "12x8", "--resolution", "0.25", "--scans", "12", "--angles", "60", "--max-range", "12")
    result = call("simulate", "--world", "building", *size, "-o", log, "--set", "fov=180")
    assert result.exit_code == 0, result.stderr
    return log


@pytest.fixture(scope="session")
def office_run(office, tmp_path_factory):
    """That log, inferred."""
    folder = tmp_path_factory.mktemp("run") / "office"
    result = call("infer", office, "-o", folder, *SHORT)
    assert result.exit_code == 0, result.stderr
    return folder


@pytest.fixture
def short():
    """Options of a run that takes a moment."""
    return SHORT
