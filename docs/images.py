"""Makes the pictures of the README and the docs: `python docs/images.py` from the repository's root.

The building's log is not part of the project; without it (`BAYESMAP_DATA`) only the tutorial's picture is made.
"""

import os
from pathlib import Path

import numpy as np

import bayesmap as bm
from bayesmap.model.defaults import HIT_DEPTH, P_WALL, default_sensor
from bayesmap.viz.figure import write_figure
from bayesmap.world.tutorial import TUTORIAL_GRID

IMAGES = Path(__file__).with_name("images")
LOG = Path(os.environ.get("BAYESMAP_DATA", "../shared/data")) / "intel-corrected.log.gz"


def building() -> None:
    """A real building at 10 cm: mean and entropy of 4 x 100 draws."""
    scans, _ = bm.read_log(LOG).limited(20.0).holdout(10)
    grid = bm.Grid.covering(scans, 0.1)
    run = bm.infer(
        scans, grid, prior=bm.Independent(P_WALL), sensor=default_sensor(0.1), hit_depth=HIT_DEPTH, warmup=50, draws=100
    )
    write_figure(run.plot(scans=None, draw=None), IMAGES / "building.png")


def tutorial() -> None:
    """The tutorial's map where walls are rare: block Gibbs."""
    walls, pose = bm.worlds.tutorial()
    angles = np.arange(100) / 100 * 2 * np.pi
    sensor = bm.Gaussian(0.2)
    scans = bm.simulate(walls, TUTORIAL_GRID, pose, angles, sensor=sensor, max_range_m=42.0, seed=0)
    run = bm.infer(scans, TUTORIAL_GRID, prior=bm.Independent(0.05), sensor=sensor, method="block")
    write_figure(run.plot(truth=walls), IMAGES / "tutorial.png")


if __name__ == "__main__":
    tutorial()
    if LOG.exists():
        building()
    else:
        print(f"{LOG} is not there: set BAYESMAP_DATA to make the building's picture")
