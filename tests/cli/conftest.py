"""A small building's log, simulated once, and a recording."""

import gzip
import math
from functools import cache

import numpy as np
import pytest
from recordings import ODOM, SCAN, laser, odometry, written
from shell import SLAM, json_of, succeed

from bayesmap.io.logs import read_log

SHORT = ("--resolution 0.25 --chains 2 --warmup 5 --draws 8", "--no-progress")


@pytest.fixture(scope="session")
def office(tmp_path_factory):
    """A log of 12 scans in a small building; its truth lies beside it."""
    log = tmp_path_factory.mktemp("office") / "office.log"
    size = "--size 12x8 --resolution 0.25 --scans 12 --angles 60 --max-range 12"
    succeed("simulate", "--world building", size, "-o", log, "--set fov=180")
    return log


@pytest.fixture(scope="session")
def prior(office):
    """The first pose of that log, roughly: a map of 12 scans is not enough to be found on from anywhere."""
    x, y, yaw = read_log(office).poses[0]
    return "--prior", f"{x + 0.2},{y - 0.1},{np.degrees(yaw)},0.3,10"


@pytest.fixture(scope="session")
def office_run(office, tmp_path_factory):
    folder = tmp_path_factory.mktemp("run") / "office"
    succeed("infer", office, "-o", folder, *SHORT)
    return folder


@pytest.fixture(scope="session")
def held_out(office, tmp_path_factory):
    """Infer the log without every fourth scan, once for each kind of cells; returns the run, and what infer printed."""

    @cache
    def inferred(cells):
        folder = tmp_path_factory.mktemp("held-out") / cells
        return folder / "run.nc", json_of("infer", office, "-o", folder, *SHORT, "--holdout 4 --json --cells", cells)

    return inferred


@pytest.fixture
def cut_log(office, tmp_path):
    """The log, packed, and cut in the middle of a line."""
    path = tmp_path / "cut.log.gz"
    packed = gzip.compress(office.read_bytes(), mtime=0)
    path.write_bytes(packed[: len(packed) // 2])
    return path


@pytest.fixture(scope="session")
def raw_log(tmp_path_factory):
    """A robot's round through a small office, with the odometry of a Pioneer."""
    path = tmp_path_factory.mktemp("raw") / "office.log"
    world = "--world building --size 12x8 --scans 40 --odometry typical --fov 360 --angles 120 --seed 4"
    succeed("simulate", world, "--laser 0.2,-0.1,0", "-o", path)
    return path


@pytest.fixture(scope="session")
def slam_run(raw_log, tmp_path_factory):
    """Its map and trajectory: the folder, and what the command printed as JSON."""
    folder = tmp_path_factory.mktemp("slam") / "run"
    return folder, json_of("slam", raw_log, "-o", folder, SLAM, "--json")


@pytest.fixture(scope="session")
def short():
    """Options of a run that takes a moment."""
    return SHORT


@pytest.fixture(scope="session")
def recording(tmp_path_factory):
    """A recording of 6 scans by one laser, of which another topic has two, and odometry, of a robot that drives."""
    messages = [("/odom", ODOM, i, odometry(i, i, 0.0, 0.0, child="laser")) for i in range(7)]
    for i in range(6):
        scan = laser(i + 0.5, [2.0, 2.5, math.inf, math.nan], [-1.5, -0.5, 0.5, 1.5], limits=(0.1, 10.0))
        messages += [(topic, SCAN, i, scan) for topic in ("/scan", "/rear")[: 2 if i < 2 else 1]]
    return written(tmp_path_factory.mktemp("recording"), sorted(messages, key=lambda message: message[2]))
