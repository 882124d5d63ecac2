"""Files of GenJAX's authors, which are kept beside the recordings and are not part of this project."""

import gzip
import json
import tarfile
from pathlib import Path

import pytest
from data import FOLDER


def peer_file(name: str) -> Path:
    """A file of the folder `peers` beside $BAYESMAP_DATA; skips the test where it is absent."""
    path = FOLDER.resolve().parent / "peers" / name
    if not path.exists():
        pytest.skip(f"{path} is absent")
    return path


def notebook_cells() -> list[str]:
    """The code cells of the original mapping tutorial."""
    with gzip.open(peer_file("mapping_tutorial.ipynb.gz"), "rt") as file:
        cells = json.load(file)["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def unpack_genjax_tests(folder: Path) -> Path:
    """GenJAX 0.10.3's own tests, unpacked into a folder."""
    with tarfile.open(peer_file("genjax-0.10.3-tests.tar.gz")) as archive:
        archive.extractall(folder, filter="data")
    return folder / "tests"
