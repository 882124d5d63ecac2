"""Run GenJAX 0.10.3's own tests on `bayesmap.gen`; print which do not pass.

.venv/bin/python tests/conformance/run_peer_tests.py [FOLDER OR FILE OF THEM ...]

Its authors' files are kept beside the recordings and are not part of this project.
"""

import gzip
import json
import os
import subprocess
import sys
import tarfile
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]

from data import FOLDER  # noqa: E402 - found through the line above


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


def outcomes(*names: str) -> dict[str, bool]:
    """Return whether each test passes, by `file::Class::test`. A file that cannot be read counts as a failed test."""
    with tempfile.TemporaryDirectory() as scratch:
        with tarfile.open(peer_file("genjax-0.10.3-tests.tar.gz")) as archive:
            archive.extractall(scratch, filter="data")
        tests, report = Path(scratch) / "tests", Path(scratch) / "report.xml"
        paths = [str(tests / name) for name in names] or [str(tests)]
        options = ["-p", "genjax_alias", "-p", "no:cacheprovider", "-c", os.devnull, "--rootdir", str(tests)]
        options += ["-q", "--continue-on-collection-errors", f"--junitxml={report}"]
        path = os.pathsep.join([str(HERE), os.environ.get("PYTHONPATH", "")])
        command = [sys.executable, "-m", "pytest", *options, *paths]
        # Without fusion emitters, which tests/conftest.py leaves out, one of them differs in the last bit of a float32.
        env = {**os.environ, "PYTHONPATH": path, "XLA_FLAGS": "--xla_backend_optimization_level=0"}
        subprocess.run(command, check=False, env=env, cwd=scratch, capture_output=True)
        return {_name(case): len(case) == 0 for case in ET.parse(report).iter("testcase")}


def _name(case: ET.Element) -> str:
    """`tests.core.test_diff.TestDiff` and `test_x` as `test_diff.py::TestDiff::test_x`."""
    parts = (case.get("classname") or case.get("name") or "").split(".")
    file = next(k for k, part in enumerate(parts) if part.startswith("test_"))
    inside = [*parts[file + 1 :], *([case.get("name", "")] if case.get("classname") else [])]
    return "::".join([f"{parts[file]}.py", *inside])


if __name__ == "__main__":
    passed = outcomes(*sys.argv[1:])
    print(*sorted(name for name, ok in passed.items() if not ok), sep="\n")
    print(f"{sum(passed.values())} of {len(passed)} pass")
