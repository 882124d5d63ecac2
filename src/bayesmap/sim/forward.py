"""The forward model: scans from a map and poses. `ranges` has no noise; `simulate` draws from a sensor model."""

import numpy as np
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput, check_count, near_names
from bayesmap.sensors.model import AdditiveNoise, RangeLimits, SensorModel
from bayesmap.space.arrays import Mask
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats
from bayesmap.space.scans import Scans, as_angles, as_poses, as_user_poses, check_limits


def ranges(
    walls: Mask, grid: Grid, poses: ArrayLike, angles_rad: ArrayLike, max_range_m: float, *, device: str = "cpu"
) -> Floats:
    """Compute noise-free ranges: the distance from each pose to the first wall along each beam, capped.
    Walls are true (or non-zero), (nx, ny). Poses are (x, y, yaw) in the world frame, (3,) or (S, 3), and angles are in
    the sensor frame, (A,). Cells are closed squares: a beam that touches a corner hits all cells there. From inside a
    wall the range is the distance to the exit edge.
    Returns metres, at most ``max_range_m``, (A,) for a pose of shape (3,), else (S, A). Raises `BadInput` for shapes
    that do not fit, numbers that are not finite, or a cap that is not positive.
    """
    distances_m = _distances_m(walls, grid, as_poses(poses), as_angles(angles_rad), max_range_m, device)
    return distances_m[0] if np.ndim(poses) == 1 else distances_m


@near_names
def simulate(
    walls: Mask, grid: Grid, poses: ArrayLike, angles_rad: ArrayLike, *, sensor: SensorModel, max_range_m: float,
    min_range_m: float = 0.0, seed: int = 0, opacity: Floats | None = None, typed: bool = False, device: str = "cpu",
) -> Scans:  # fmt: skip
    """Draw scans from a sensor model in a known world.

    Walls, poses, angles and device are as for `ranges`. ``sensor`` is the noise model of the readings, and ``seed``
    the seed of all draws. The sensor measures from ``min_range_m`` to ``max_range_m``. ``opacity`` is the chance that a
    wall cell stops the beams of a scan, shape (nx, ny): less than 1 for glass; None is 1 everywhere. With ``typed`` a
    beam that meets nothing within ``max_range_m``, or reads more, has no return, as lasers report. Otherwise the sensor
    model decides: additive noise reads the largest range plus noise, as in the tutorial.
    Raises `BadInput` as `ranges`, and for a pose inside a wall.
    """
    poses_world = as_user_poses("simulate", poses)
    angles = as_angles(angles_rad)
    check_limits(min_range_m, max_range_m)
    rng = np.random.default_rng(check_count("simulate", "seed", seed, 0))
    is_wall = np.asarray(walls) != 0
    _check_walls(is_wall, grid)
    for scan, (x, y, _) in enumerate(poses_world):
        cell = grid.cell_at(x, y)
        if cell is not None and is_wall[cell]:
            raise BadInput(
                f"simulate: pose {scan} at ({x:g}, {y:g}) m stands in the occupied cell {cell}; "
                "move the robot, or clear that cell"
            )
    if opacity is not None:
        opacity = np.asarray(opacity, dtype=np.float64)
        if opacity.shape != grid.shape or not ((opacity >= 0) & (opacity <= 1)).all():
            raise BadInput(f"simulate: opacity must be {grid.shape} numbers in [0, 1], one a cell; got {opacity.shape}")
    # Cast rays. With an opacity, each scan meets its own random walls.
    if opacity is None:
        distances_m = _distances_m(is_wall, grid, poses_world, angles, np.inf, device)
    else:
        distances_m = np.concatenate([
            _distances_m(is_wall & (rng.random(grid.shape) < opacity), grid, pose[None], angles, np.inf, device)
            for pose in poses_world
        ])  # fmt: skip
    readings = sensor.sample(rng, distances_m, RangeLimits(min_range_m, max_range_m))
    if typed:
        no_return = readings > max_range_m
        if isinstance(sensor, AdditiveNoise):  # other sensor models draw no returns themselves
            no_return |= distances_m > max_range_m
        readings = np.where(no_return, np.inf, readings)
    return Scans(poses_world, angles, readings, max_range_m=max_range_m, min_range_m=min_range_m)


def _distances_m(walls: Mask, grid: Grid, poses: Floats, angles_rad: Floats, max_range_m: float, device: str) -> Floats:
    """Cast all beams. Returns the distances to the first walls, (S, A), at most ``max_range_m``."""
    from bayesmap.kernels.walk import cast_beams  # loads Warp

    _check_walls(walls, grid)
    if not max_range_m > 0:
        raise BadInput(f"ranges: max_range_m must be a positive number of metres, got {max_range_m!r}")
    starts = np.repeat(grid.to_cells(poses[:, :2]), len(angles_rad), axis=0)
    directions = (poses[:, 2:3] + angles_rad[None, :]).ravel()
    distances_cells, _ = cast_beams(walls, starts, directions, max_range_m / grid.resolution, device)
    return np.minimum(distances_cells * grid.resolution, max_range_m).reshape(len(poses), len(angles_rad))


def _check_walls(walls: Mask, grid: Grid) -> None:
    """Raise `BadInput` unless the walls have the grid's shape."""
    if np.shape(walls) != grid.shape:
        raise BadInput(f"map: walls have shape {np.shape(walls)}, but the grid is {grid.shape}")
