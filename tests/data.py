"""Recordings that are not shipped with the code: tests on them are skipped where they are absent."""

import os
from pathlib import Path

import pytest

FOLDER = Path(os.environ.get("BAYESMAP_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))


def intel_log(name: str) -> Path:
    """A file of the Intel Research Lab recording, from $BAYESMAP_DATA or ../shared/data."""
    path = FOLDER / name
    if not path.exists():
        pytest.skip(f"{path} is absent; set BAYESMAP_DATA to the folder of the recordings")
    return path
