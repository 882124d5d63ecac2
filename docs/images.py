"""Makes the pictures of the README and the docs: `python docs/images.py` from the repository's root.

The building's log is not part of the project; without it (`BAYESMAP_DATA`) only the tutorial's picture is made.
"""

import os
from pathlib import Path

import numpy as np

import bayesmap as bm
from bayesmap.cli.render import log_odds_map
from bayesmap.sim.drawing import TUTORIAL_GRID
from bayesmap.viz.figure import Candidate, comparison_figure, write_figure
from bayesmap.viz.maps import window
from bayesmap.viz.overlays import plot_surfaces
from bayesmap.viz.palette import SURFACE, blank_figure
from bayesmap.viz.trajectory import ODOMETRY_COLOR, SIZE_IN, crop_to_walls, plot_trajectory

IMAGES = Path(__file__).with_name("images")
ROOMS = (6.0, 19.0), (-5.0, 6.5)  # x and y of the building's picture, metres
DATA = Path(os.environ.get("BAYESMAP_DATA", "../shared/data"))
LOG, ODOMETRY = DATA / "intel-corrected.log.gz", DATA / "intel-odometry.log.gz"


def building() -> None:
    """A few rooms of a real building at 10 cm: what log-odds make of the scans, and the posterior with its surfaces."""
    scans, _ = bm.read_log(LOG).limited(20.0).holdout(10)
    grid = bm.Grid.covering(scans, 0.1)
    run = bm.infer(scans, grid, prior=bm.Surface(), sensor="fit", schedule=bm.Schedule(warmup=50, draws=50))
    part, cut = window(grid, *ROOMS)
    log_odds, seen = log_odds_map(run)
    maps = [
        Candidate("log-odds", log_odds[cut], seen[cut]),
        Candidate("posterior over surfaces", run.occupancy[cut], run.observed[cut]),
    ]
    figure = comparison_figure(part, maps, label="chance that a cell stops a beam")
    plot_surfaces(figure.axes[1], *run.surfaces(), color=SURFACE)
    write_figure(figure, IMAGES / "building.png")


def trajectory() -> None:
    """A building from raw odometry: what the robot reports, and the posterior of trajectory and map."""
    log = bm.read_log(ODOMETRY).limited(20.0)
    run = bm.slam(log, fast=True, schedule=bm.Schedule(draws=30))
    found = run.trajectory
    raw = log.select(found.order)
    some = raw.select(np.arange(0, len(raw), 4))
    angles = some.poses[:, 2:] + some.angles_rad
    ends = some.poses[:, None, :2] + some.ranges_m[..., None] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    ends = ends[np.isfinite(some.ranges_m)]
    grid, occupancy, observed = crop_to_walls(run.grid, run.occupancy, run.observed, found.poses)
    figure = blank_figure(1.5 * SIZE_IN, SIZE_IN * 0.75 * grid.shape[1] / grid.shape[0] + 0.8, dpi=110)
    left, right = figure.subplots(1, 2)
    left.plot(*ends.T, ",", color="#8a8a8a", zorder=1)
    left.plot(*raw.poses[:, :2].T, color=ODOMETRY_COLOR, linewidth=0.9, label="raw odometry")
    left.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", title="what wheels and laser report")
    plot_trajectory(right, grid, occupancy, observed, found.poses, found.covariances())
    right.set(xlabel="x [m]", ylabel="y [m]", title="inferred")
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=9)
    write_figure(figure, IMAGES / "slam.png")


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
        trajectory()
        building()
    else:
        print(f"{LOG} is not there: set BAYESMAP_DATA to make the building's pictures")
