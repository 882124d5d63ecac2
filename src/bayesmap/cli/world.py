"""The worlds that `bayesmap simulate` knows, and where a robot goes in them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.typed_numbers import numbers_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.sensors.model import SensorModel
    from bayesmap.space.grid import Grid

RARE = 1e-5
"""How often a simulated laser reads nonsense: seldom, since one such reading far outside makes a map larger."""

IMAGES = (".png", ".pgm", ".ppm", ".pbm", ".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp")
MAPS = (".yaml", ".yml")


@dataclass(frozen=True, eq=False)
class World:
    """A world with a robot in it.

    Attributes:
        walls: shape (nx, ny).
        grid: where the cells are.
        poses: the robot's, (S, 3).
        opacity: chance that a wall stops a beam, or None if all do.
        is_tutorial: whether the tutorial's sensor is the default.
    """

    walls: NDArray[np.bool_]
    grid: Grid
    poses: NDArray[np.float64]
    opacity: NDArray[np.float64] | None = None
    is_tutorial: bool = False

    def sensor(self) -> SensorModel:
        """The sensor where none is named: the tutorial's noise with typed no-returns, or a good laser's."""
        from bayesmap.cells.kinds import LASER_SIGMA_M, LASER_SIGMA_PER_M
        from bayesmap.sensors.mixture import BeamMixture
        from bayesmap.sensors.noise import Gaussian

        if self.is_tutorial:
            return BeamMixture(Gaussian(0.2), p_random=RARE, p_no_return=0.0, p_short=0.0)
        return BeamMixture(Gaussian(LASER_SIGMA_M, LASER_SIGMA_PER_M), p_random=RARE)


def world_of(values: dict[str, Any], poses: Sequence[str]) -> World:
    """The world that the settings of `simulate` name.

    Args:
        values: the settings.
        poses: as typed; none for the world's own.

    Raises:
        BadInput: a file that cannot be read as a world, a size or a pose that is not one.
        click.UsageError: a file, but no pose.
    """
    name, resolution = values["world"], values["resolution"]
    given = [pose_of(text) for text in poses]
    if name == "tutorial":
        return _tutorial(resolution, given)
    if name == "building":
        return _building(values, given)
    path = Path(name)
    if not path.is_file():
        raise BadInput(
            f"world {name!r}: no such file; give tutorial, building, or a drawing, picture or map_server YAML"
        )
    if not given:
        raise click.UsageError(f"where is the robot in {name}? give --pose X,Y,DEGREES, once for each scan")
    walls, grid = _from_file(path, resolution)
    return World(walls, grid, _stack(given))


def _tutorial(resolution: float | None, given: list[tuple[float, float, float]]) -> World:
    from bayesmap.sim.tutorial import TUTORIAL_GRID, tutorial
    from bayesmap.space.grid import Grid

    walls, pose = tutorial()
    poses = _stack(given) if given else pose[None]
    grid = TUTORIAL_GRID
    if resolution is not None and resolution != grid.resolution:
        grid = Grid(grid.shape, resolution, (-resolution / 2, -resolution / 2))
        poses = poses if given else poses * (resolution, resolution, 1.0)
    return World(walls, grid, poses, is_tutorial=True)


def _building(values: dict[str, Any], given: list[tuple[float, float, float]]) -> World:
    from bayesmap.sim.building import building
    from bayesmap.sim.patrol import patrol

    made = building(values["seed"], _size(values["size"]), values["resolution"] or 0.1)
    poses = _stack(given) if given else patrol(made, values["scans"], values["seed"])
    return World(made.walls, made.grid, poses, made.opacity)


def _from_file(path: Path, resolution: float | None) -> tuple[NDArray[np.bool_], Grid]:
    from bayesmap.io.image import from_image
    from bayesmap.sim.drawing import from_text
    from bayesmap.space.grid import Grid

    if path.suffix.lower() in MAPS:
        from bayesmap.io.ros.maps import read_map

        occupancy, grid = read_map(path)
        return occupancy > 0.5, grid if resolution is None else Grid(grid.shape, resolution, grid.origin)
    if path.suffix.lower() in IMAGES:
        walls = from_image(path)
        return walls, Grid(walls.shape, resolution or 0.1)
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise BadInput(
            f"{path}: neither a text drawing nor a file called {', '.join(IMAGES)} or {', '.join(MAPS)}"
        ) from None
    try:
        walls = from_text(text)
    except BadInput as problem:
        raise BadInput(f"{path}: {problem}") from None
    return walls, Grid(walls.shape, resolution or 1.0)


def pose_of(text: str, flag: str = "--pose") -> tuple[float, float, float]:
    """A pose as typed, in metres and degrees, in metres and radians.

    Raises:
        click.BadParameter: something else; the message names the flag.
    """
    x, y, degrees = numbers_of(text, flag, "X,Y,DEGREES", (3,))
    return x, y, math.radians(degrees)


def _stack(poses: list[tuple[float, float, float]]) -> NDArray[np.float64]:
    import numpy as np

    return np.array(poses, dtype=np.float64)


def _size(text: str) -> tuple[float, float]:
    try:
        width, depth = (float(part) for part in text.lower().split("x"))
    except ValueError:
        raise BadInput(f"size {text!r}: give width and depth in metres, such as 30x20") from None
    return width, depth
