"""What the JSON document says of the process itself."""

import os
import subprocess
import sys

import numpy as np
from shell import SOURCE

SMALL = "from bayesmap.cli.folder import peak_memory_mb; print(peak_memory_mb())"


def test_peak_memory_is_that_of_this_process_not_of_the_one_that_started_it():
    ours = np.ones(1 << 26)  # half a gigabyte
    environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
    done = subprocess.run([sys.executable, "-c", SMALL], capture_output=True, text=True, check=True, env=environment)
    assert 5 < float(done.stdout) < 200 < ours.nbytes / 1e6
