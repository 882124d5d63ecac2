"""Run GenJAX 0.10.3's own tests on `bayesmap.gen`; print which do not pass.

.venv/bin/python tests/conformance/run_peer_tests.py [FOLDER OR FILE OF THEM ...]
"""

import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from peers import unpack_genjax_tests  # noqa: E402 - found through the line above


def outcomes(*wanted: str) -> dict[str, bool]:
    """Return whether each test passes, by `file::Class::test`. A file that cannot be read counts as a failed test."""
    with tempfile.TemporaryDirectory() as scratch:
        tests = unpack_genjax_tests(Path(scratch))
        report = Path(scratch) / "report.xml"
        paths = [str(tests / name) for name in wanted] or [str(tests)]
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
    found = outcomes(*sys.argv[1:])
    print(*sorted(name for name, passed in found.items() if not passed), sep="\n")
    print(f"{sum(found.values())} of {len(found)} pass")
