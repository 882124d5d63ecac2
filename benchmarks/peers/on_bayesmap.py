"""Runs a script that was written for GenJAX on `bayesmap.gen`: only what `import genjax` means is changed.

`python on_bayesmap.py genjax_tutorial.py --case raster --repeats 5 --json`, with bayesmap's own interpreter.
"""

import runpy
import sys
import warnings
from pathlib import Path

import bayesmap.gen

if __name__ == "__main__":
    # The tutorial gives `categorical` its logits without their name, which warns here as in GenJAX.
    warnings.filterwarnings("ignore", "a bare argument", DeprecationWarning)
    sys.modules["genjax"] = bayesmap.gen
    sys.argv = sys.argv[1:]
    sys.path.insert(0, str(Path(__file__).parent))
    runpy.run_path(str(Path(__file__).with_name(sys.argv[0])), run_name="__main__")
