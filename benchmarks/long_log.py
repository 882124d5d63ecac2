"""A recording as a robot of today makes it: 720 beams of 12 m at 10 Hz, odometry with noise, the laser backwards.

`python -m benchmarks.long_log MINUTES FILE.mcap` writes it as a ROS 2 recording.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.kinds import LASER_SIGMA_M, LASER_SIGMA_PER_M
from bayesmap.sensors.builtin import BeamMixture, Gaussian
from bayesmap.sim.building import building
from bayesmap.sim.forward import simulate
from bayesmap.sim.robot import OdometryNoise, patrol, simulate_odometry, travel_times_s
from bayesmap.space.planar import compose, wrapped
from bayesmap.space.scans import Scans, fan

Floats = NDArray[np.float64]

SIZE_M, SEED = (40.0, 25.0), 7
BEAMS, MAX_RANGE_M, HZ = 720, 12.0, 10.0
SPEED_M_PER_S, TURN_RAD_PER_S = 0.5, 1.0
RARE = 0.002
SENSOR = BeamMixture(Gaussian(LASER_SIGMA_M, LASER_SIGMA_PER_M), p_random=RARE)
MOUNT = (-0.1, 0.03, np.pi)
"""The laser on the robot: x and y in metres, yaw in radians."""


def driven(minutes: float) -> tuple[NDArray[np.bool_], Scans, Floats, Floats]:
    """Return walls, scans with raw odometry of the laser, true poses of the laser, and the robot's odometry.

    The robot goes round the building, turns about, goes the same way back, and so on.
    """
    made = building(SEED, SIZE_M)
    seconds, once = 60.0 * minutes, patrol(made, 4000, SEED)
    back = once[::-1] + np.array([0.0, 0.0, np.pi])
    rounds = [once]
    while travel_times_s(np.concatenate(rounds), SPEED_M_PER_S, TURN_RAD_PER_S)[-1] < seconds:
        rounds.append(once if len(rounds) % 2 == 0 else back)
    way = np.concatenate(rounds)
    times = travel_times_s(way, SPEED_M_PER_S, TURN_RAD_PER_S)
    at = np.arange(0.0, seconds, 1.0 / HZ)
    yaw = way[0, 2] + np.concatenate([[0.0], np.cumsum(wrapped(np.diff(way[:, 2])))])
    base = np.column_stack([np.interp(at, times, column) for column in (way[:, 0], way[:, 1], yaw)])
    base[:, 2] = wrapped(base[:, 2])
    laser = compose(base, np.array(MOUNT))
    scans = simulate(made.walls, made.grid, laser, fan(BEAMS, 360.0), sensor=SENSOR, max_range_m=MAX_RANGE_M,
                     seed=SEED, opacity=made.opacity, typed=True)  # fmt: skip
    odometry = simulate_odometry(base, OdometryNoise(), stamps_s=at, seed=SEED)
    return made.walls, replace(scans, poses=compose(odometry, np.array(MOUNT)), stamps_s=at), laser, odometry


def write_mcap(path: Path, scans: Scans, odometry: Floats) -> None:
    """Write scans, odometry and the laser's place as a ROS 2 recording, a single MCAP file."""
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    types = store.types
    scan_type, tf_type = "sensor_msgs/msg/LaserScan", "tf2_msgs/msg/TFMessage"
    prefix = "geometry_msgs/msg/"

    def header(stamp: float, frame: str) -> object:
        ns = 1_700_000_000 * 10**9 + round(stamp * 1e9)
        time = types["builtin_interfaces/msg/Time"](ns // 10**9, ns % 10**9)
        return types["std_msgs/msg/Header"](time, frame)

    def transform(stamp: float, parent: str, child: str, pose: Floats) -> object:
        x, y, yaw = (float(v) for v in pose)
        turn = types[prefix + "Quaternion"](0.0, 0.0, float(np.sin(yaw / 2)), float(np.cos(yaw / 2)))
        where = types[prefix + "Transform"](types[prefix + "Vector3"](x, y, 0.0), turn)
        return types[tf_type]([types[prefix + "TransformStamped"](header(stamp, parent), child, where)])

    assert scans.stamps_s is not None
    none = np.zeros(0, np.float32)
    with TemporaryDirectory() as folder:
        bag = Writer(Path(folder) / "bag", version=9, storage_plugin=StoragePlugin.MCAP)
        with bag:
            static = bag.add_connection("/tf_static", tf_type, typestore=store)
            moving = bag.add_connection("/tf", tf_type, typestore=store)
            laser = bag.add_connection("/scan", scan_type, typestore=store)
            first = 1_700_000_000 * 10**9
            fixed = transform(0.0, "base_link", "laser", np.array(MOUNT))
            bag.write(static, first, store.serialize_cdr(fixed, tf_type))
            step = float(scans.angles_rad[1] - scans.angles_rad[0])
            begin, end = float(scans.angles_rad[0]), float(scans.angles_rad[-1])
            for stamp, pose, ranges in zip(scans.stamps_s, odometry, scans.ranges_m, strict=True):
                ns = first + round(float(stamp) * 1e9)
                message = transform(float(stamp), "odom", "base_link", pose)
                bag.write(moving, ns, store.serialize_cdr(message, tf_type))
                scan = types[scan_type](
                    header(float(stamp), "laser"), begin, end, step, 0.0, 0.1, 0.05, MAX_RANGE_M,
                    ranges.astype(np.float32), none,
                )  # fmt: skip
                bag.write(laser, ns, store.serialize_cdr(scan, scan_type))
        (file,) = (Path(folder) / "bag").glob("*.mcap")
        path.write_bytes(file.read_bytes())


def main() -> None:
    """Write a recording, and the laser's true poses beside it."""
    from bayesmap.io.text.trajectories import write_trajectory

    minutes, path = float(sys.argv[1]), Path(sys.argv[2])
    _, scans, laser, odometry = driven(minutes)
    write_mcap(path, scans, odometry)
    assert scans.stamps_s is not None
    write_trajectory(path.with_suffix(".tum"), laser, scans.stamps_s)


if __name__ == "__main__":
    main()
