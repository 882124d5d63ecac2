"""A small building's log, simulated once, and a recording."""

import math

import numpy as np
import pytest
from shell import SLAM, json_of, succeed

from bayesmap.io.logs import read_log

SHORT = ("--resolution 0.25 --chains 2 --warmup 5 --draws 8", "--no-progress")
"""Options of a run that takes a moment."""


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
    """That log, inferred."""
    folder = tmp_path_factory.mktemp("run") / "office"
    succeed("infer", office, "-o", folder, *SHORT)
    return folder


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
    """A recording of 6 scans by one laser, with /tf and /odom, of a robot that drives along a wall."""
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    make = {name.rpartition("/")[2]: kind for name, kind in store.types.items()}
    still = make["Vector3"](0.0, 0.0, 0.0)
    ahead = make["Quaternion"](0.0, 0.0, 0.0, 1.0)
    folder = tmp_path_factory.mktemp("recording") / "drive"
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as bag:
        laser, odometry = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry"
        kinds = {"/scan": laser, "/rear": laser, "/odom": odometry}
        topics = {name: bag.add_connection(name, kind, typestore=store) for name, kind in kinds.items()}

        def write(name, t, message):
            bag.write(topics[name], t, store.serialize_cdr(message, kinds[name]))

        for i in range(7):
            t = (1000 + i) * 10**9
            stamp = make["Time"](1000 + i, 0)
            pose = make["PoseWithCovariance"](make["Pose"](make["Point"](float(i), 0.0, 0.0), ahead), np.zeros(36))
            twist = make["TwistWithCovariance"](make["Twist"](still, still), np.zeros(36))
            write("/odom", t, make["Odometry"](make["Header"](stamp, "odom"), "laser", pose, twist))
            if i < 6:
                stamp = make["Time"](1000 + i, 5 * 10**8)
                ranges = np.array([2.0, 2.5, math.inf, math.nan], np.float32)
                head = make["Header"](stamp, "laser")
                scan = make["LaserScan"](head, -1.5, 1.5, 1.0, 0.0, 0.1, 0.1, 10.0, ranges, np.zeros(0, np.float32))
                write("/scan", t + 1, scan)
                if i < 2:
                    write("/rear", t + 2, scan)
    return folder / "drive.mcap"
