"""The tests of the page's own logic, which node runs on its sources: `npm --prefix page test`."""

import base64
import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from msgspec import to_builtins
from page_driver import document, fragment

from bayesmap.app.protocol.notices import LIMITS
from bayesmap.app.protocol.wire import frame

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "page"


def test_the_logic_of_the_page(tmp_path):
    if not PAGE.is_dir():
        pytest.skip("the page's sources are not in this copy")
    if shutil.which("npm") is None:
        pytest.skip("no npm on this machine: install node 20 or later")
    if not (PAGE / "node_modules").is_dir():
        pytest.skip("the page's tools are not installed: npm --prefix page ci")
    buffers = {
        "p": np.array([[0, 1, 255]], dtype=np.uint8),
        "pose": np.array([[0.1, -2.0, 3.0]]),
        "ranges": np.array([1.5, 0.25], dtype=np.float32),
    }
    library = {
        "limits": to_builtins(LIMITS),
        "frame": base64.b64encode(frame({"type": "field", "generation": 3}, buffers)).decode(),
        "buffers": {name: values.ravel().tolist() for name, values in buffers.items()},
        "document": document(prior=0.375),
        "fragment": fragment(document(prior=0.375)),
        "tutorial": str(ROOT / "docs/tutorial/interactive.html"),
    }
    (tmp_path / "library.json").write_text(json.dumps(library))
    environment = {**os.environ, "BAYESMAP_LIBRARY": str(tmp_path / "library.json"), "NO_COLOR": "1"}
    command = ["npm", "test", "--silent"]
    done = subprocess.run(command, cwd=PAGE, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "skipped 0" in done.stdout, done.stdout
