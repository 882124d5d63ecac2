"""A recording as a robot of today makes it: 720 beams of 12 m at 10 Hz, odometry with noise, the laser backwards.

`python -m benchmarks.long_log MINUTES FILE.mcap` writes it as a ROS 2 recording.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.kinds import LASER_SIGMA_M, LASER_SIGMA_PER_M
from bayesmap.io.ros.writer import write_scans
from bayesmap.sensors.model import BeamMixture, Gaussian
from bayesmap.sim.building import building
from bayesmap.sim.forward import simulate
from bayesmap.sim.robot import OdometryNoise, drive, simulate_odometry
from bayesmap.space.planar import compose
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
    at, base = drive(made, 60.0 * minutes, HZ, speed_m_per_s=SPEED_M_PER_S, turn_rad_per_s=TURN_RAD_PER_S, seed=SEED)
    laser = compose(base, np.array(MOUNT))
    scans = simulate(made.walls, made.grid, laser, fan(BEAMS, 360.0), sensor=SENSOR, max_range_m=MAX_RANGE_M,
                     seed=SEED, opacity=made.opacity, typed=True)  # fmt: skip
    odometry = simulate_odometry(base, OdometryNoise(), stamps_s=at, seed=SEED)
    return made.walls, replace(scans, poses=compose(odometry, np.array(MOUNT)), stamps_s=at), laser, odometry


def write_mcap(path: Path, scans: Scans, odometry: Floats) -> None:
    """Write scans, odometry and the laser's place as a ROS 2 recording, a single MCAP file."""
    assert scans.stamps_s is not None
    write_scans(path, replace(scans, stamps_s=1.7e9 + scans.stamps_s), odometry, MOUNT)


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
