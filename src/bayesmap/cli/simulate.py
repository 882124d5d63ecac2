"""``bayesmap simulate``: write the log of a robot in a known world, and the true map and trajectory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import msgspec

from bayesmap.cli import translation
from bayesmap.cli.command import FORCE, Call, command
from bayesmap.cli.folder import grid_document
from bayesmap.cli.keys import SimulateSettings
from bayesmap.cli.translation import MAPS, is_map, need_free, odometry_of, pose_of, sensor_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.sensors.model import SensorModel
    from bayesmap.space.grid import Grid

TURN_RAD_PER_S = 1.0  # turning rate of a simulated robot, used for the time stamps

P_RANDOM = 1e-5  # probability of a random reading: it is small, since one far reading makes the map larger
RATE_HZ = 10.0  # scans a second of a recording
START_S = 1.7e9  # time stamp of its first scan

LOG_DEFAULTS: dict[str, Any] = {"world": "tutorial", "odometry": "true", "laser": "0,0,0"}
RECORDING_DEFAULTS: dict[str, Any] = {"world": "building", "odometry": "typical", "laser": "-0.1,0.03,180"}
RECORDING_DEFAULTS |= {"angles": 720, "fov": 360.0, "max_range": 12.0}

IMAGES = (".png", ".pgm", ".ppm", ".pbm", ".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp")


@command("simulate")
@click.option("-o", "--output", metavar="LOG", help="The log: .log, .log.gz or .mcap. [default: WORLD.log]")
@click.option("--pose", "poses", metavar="X,Y,DEGREES", multiple=True, help="Take a scan from here; may be repeated.")
@FORCE
def simulate(call: Call[SimulateSettings], output: str | None, poses: tuple[str, ...], force: bool) -> None:
    r"""Simulate the scans of a robot in a known world, and write them as a log for infer and slam.

    The command writes the true map beside LOG.log, for nav2: LOG-truth.yaml. In a building the robot drives through
    the rooms. In the tutorial's map it stands in the middle. In other worlds give its poses with --pose.

    \b
    bayesmap simulate --world building -o office.log
    bayesmap infer office.log -o runs/office
    bayesmap render runs/office/run.nc --truth office-truth.yaml

    With --odometry the log holds the poses of the robot's odometry. The command then writes the true trajectory of the
    robot's base to LOG-truth.tum, and true relations between its poses (Kuemmerle et al. 2009) to LOG.relations.

    \b
    bayesmap simulate --world building --odometry typical --laser 0.1,0,0 -o office.log

    {odometry}

    {sensors}
    """
    settings = call.settings()
    # Check the arguments.
    recorded = settings.format == "mcap" if output is None else Path(output).suffix == ".mcap"
    if output is not None and settings.format not in (None, "mcap" if recorded else "carmen"):
        raise click.UsageError(f"-o {output}: the name of a log of --format {settings.format} ends differently")
    defaults = RECORDING_DEFAULTS if recorded else LOG_DEFAULTS
    settings = msgspec.structs.replace(settings, **{k: v for k, v in defaults.items() if getattr(settings, k) is None})
    assert isinstance(settings.world, str)
    assert isinstance(settings.odometry, str)
    assert isinstance(settings.laser, str)
    minutes = settings.minutes
    if recorded and minutes is None and settings.world == "building" and not poses:
        minutes = 2.0
    if minutes is not None and (settings.world != "building" or poses):
        raise BadInput("--minutes: the robot drives in --world building, without --pose, only")
    noise, mount = odometry_of(settings.odometry), pose_of(settings.laser, "--laser")
    log = Path(output or f"{Path(settings.world).stem}{'.mcap' if recorded else '.log'}")
    if not {".log", ".gz", ".mcap"} & {log.suffix}:
        raise click.UsageError(f"-o {log}: the name of a log ends in .log, .log.gz or .mcap")
    stem = log.name.removesuffix(".gz").removesuffix(".log").removesuffix(".mcap")
    truth, relations = log.with_name(f"{stem}-truth.yaml"), log.with_name(f"{stem}.relations")
    trajectory = truth.with_suffix(".tum")
    need_free([log, truth, truth.with_suffix(".pgm"), *([] if noise is None else [trajectory, relations])], force)
    sensor = sensor_of(settings.sensor)
    # Make the world and the sensor.
    world = world_of(settings, poses, minutes)
    sensor = world.sensor() if sensor is None else sensor
    max_range_m = world.max_range_m if settings.max_range is None else settings.max_range

    import numpy as np

    from bayesmap.io.ros.maps import write_map
    from bayesmap.io.ros.writer import write_scans
    from bayesmap.io.text.carmen import write_carmen
    from bayesmap.sensors.model import describe
    from bayesmap.sim import forward
    from bayesmap.sim.robot import simulate_odometry, travel_times_s
    from bayesmap.space.planar import compose
    from bayesmap.space.scans import fan

    n_beams = world.beams if settings.angles is None else settings.angles
    angles = fan(n_beams, world.fov_deg if settings.fov is None else settings.fov)
    # Draw the scans.
    base = world.poses
    laser = compose(base, np.array(mount)) if any(mount) else base
    scans = forward.simulate(
        world.walls, world.grid, laser, angles, sensor=sensor, max_range_m=max_range_m, seed=settings.seed,
        opacity=world.opacity, typed=True,
    )  # fmt: skip
    # Draw the poses of odometry, and put them into the log.
    stamps_s = world.stamps_s
    if stamps_s is None and (recorded or noise is not None):
        stamps_s = travel_times_s(base, settings.speed, TURN_RAD_PER_S)
    if stamps_s is not None:
        stamps_s = stamps_s + (START_S if recorded else 0.0)
        if noise is not None:
            base = simulate_odometry(base, noise, stamps_s=stamps_s, seed=settings.seed)
        scans = replace(scans, poses=compose(base, np.array(mount)), stamps_s=stamps_s)
    # Write the log and the truth.
    log.parent.mkdir(parents=True, exist_ok=True)
    if recorded:
        message = "/scan, /tf and /tf_static"
        write_scans(log, scans, base, mount)
    else:
        message = write_carmen(log, scans, base)
    outputs = [log, *write_map(truth, world.walls.astype(float), world.grid)]
    if noise is not None:
        assert stamps_s is not None
        outputs += _write_truth(trajectory, relations, world.poses, stamps_s, settings.seed)
    # Print the result.
    grid = world.grid
    document = {
        "world": settings.world, "grid": grid_document(grid), "scans": len(scans), "beams": scans.n_beams,
        "readings": scans.counts(), "message": message,
        "max_range_m": max_range_m, "sensor": describe(sensor), "odometry": None if noise is None else asdict(noise),
        "laser": list(mount), "seed": settings.seed, "outputs": {path.name: str(path) for path in outputs},
    }  # fmt: skip
    poses_kind = "true poses" if noise is None else "raw odometry"
    call.console.say(
        f"{log}: {len(scans):,} scans of {len(angles)} beams ({message}, {poses_kind}) in {settings.world}, "
        f"{grid.shape[0]} x {grid.shape[1]} cells of {grid.resolution:g} m"
    )
    call.console.result(document, outputs)


def _write_truth(
    trajectory: Path, relations: Path, base: NDArray[np.float64], stamps_s: NDArray[np.float64], seed: int,
) -> list[Path]:  # fmt: skip
    from bayesmap.io.text.trajectories import write_relations, write_trajectory
    from bayesmap.sim.robot import related_pairs
    from bayesmap.space.planar import between

    outputs = [write_trajectory(trajectory, base, stamps_s, "base")]
    start, end = related_pairs(base, seed)
    if len(start):
        relative = between(base[start], base[end])
        outputs.append(write_relations(relations, stamps_s[start], stamps_s[end], relative))
    return outputs


@dataclass(frozen=True, eq=False)
class World:
    """A world with a robot in it, and the robot's default laser."""

    walls: NDArray[np.bool_]  # true walls, (nx, ny)
    grid: Grid
    poses: NDArray[np.float64]  # poses of the robot, (S, 3)
    stamps_s: NDArray[np.float64] | None = None  # time of each pose, (S,), where the robot drives
    opacity: NDArray[np.float64] | None = None  # probability that a wall stops a beam, (nx, ny); None if all do
    is_tutorial: bool = False  # whether the sensor is the tutorial's
    beams: int = 180
    fov_deg: float = 180.0
    max_range_m: float = 30.0

    def sensor(self) -> SensorModel:
        """Return the default sensor: the tutorial's noise with typed no-returns, or a good laser."""
        from bayesmap.cells.kinds import LASER_SIGMA_M, LASER_SIGMA_PER_M
        from bayesmap.sensors.model import BeamMixture, Gaussian

        if self.is_tutorial:
            return BeamMixture(Gaussian(0.2), p_random=P_RANDOM, p_no_return=0.0, p_short=0.0)
        return BeamMixture(Gaussian(LASER_SIGMA_M, LASER_SIGMA_PER_M), p_random=P_RANDOM)


def world_of(settings: SimulateSettings, poses: Sequence[str], minutes: float | None = None) -> World:
    """Return the world that the settings name, with the robot at the typed poses, or driving for ``minutes``. Raises
    `BadInput` for a file that is no world, or an invalid size or pose, and `click.UsageError` for a file without pose.
    """
    import numpy as np

    name, resolution = settings.world or "tutorial", settings.resolution
    typed_poses = np.array([pose_of(text) for text in poses]) if poses else None
    if name == "tutorial":
        return _tutorial(resolution, typed_poses)
    if name == "building":
        return _building(settings, typed_poses, minutes)
    path = Path(name)
    if not path.is_file():
        raise BadInput(f"world {name!r}: no such file; give tutorial, building, a drawing, picture or map_server YAML")
    if typed_poses is None:
        raise click.UsageError(f"where is the robot in {name}? give --pose X,Y,DEGREES, once for each scan")
    return World(*_from_file(path, resolution), typed_poses)


def _tutorial(resolution: float | None, typed_poses: NDArray[np.float64] | None) -> World:
    from bayesmap.sim.drawing import TUTORIAL_GRID, tutorial
    from bayesmap.space.grid import Grid

    walls, pose = tutorial()
    grid, poses = TUTORIAL_GRID, pose[None]
    if resolution is not None and resolution != grid.resolution:
        grid = Grid(grid.shape, resolution, (-resolution / 2, -resolution / 2))
        poses = poses * (resolution, resolution, 1.0)
    poses = poses if typed_poses is None else typed_poses
    return World(walls, grid, poses, is_tutorial=True, beams=100, fov_deg=360.0, max_range_m=42.0)


def _building(settings: SimulateSettings, typed_poses: NDArray[np.float64] | None, minutes: float | None) -> World:
    from bayesmap.sim.building import building
    from bayesmap.sim.robot import drive, patrol

    plan, stamps_s = building(settings.seed, _size(settings.size), settings.resolution or 0.1), None
    if minutes is not None:
        speeds = {"speed_m_per_s": settings.speed, "turn_rad_per_s": TURN_RAD_PER_S}
        stamps_s, poses = drive(plan, 60.0 * minutes, RATE_HZ, **speeds, seed=settings.seed)
    else:
        poses = patrol(plan, settings.scans, settings.seed) if typed_poses is None else typed_poses
    return World(plan.walls, plan.grid, poses, stamps_s, plan.opacity)


def _from_file(path: Path, resolution: float | None) -> tuple[NDArray[np.bool_], Grid]:
    from bayesmap.io.ros.maps import from_image
    from bayesmap.sim.drawing import from_text
    from bayesmap.space.grid import Grid

    if is_map(str(path)):
        from bayesmap.io.ros.maps import read_map

        occupancy, grid = read_map(path)
        return occupancy > 0.5, grid if resolution is None else Grid(grid.shape, resolution, grid.origin)
    if path.suffix.lower() in IMAGES:
        walls = from_image(path)
        return walls, Grid(walls.shape, resolution or 0.1)
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise BadInput(f"{path}: neither a text drawing nor called {', '.join(IMAGES)} or {', '.join(MAPS)}") from None
    try:
        walls = from_text(text)
    except BadInput as problem:
        raise BadInput(f"{path}: {problem}") from None
    return walls, Grid(walls.shape, resolution or 1.0)


def _size(text: str) -> tuple[float, float]:
    try:
        width, depth = (float(part) for part in text.lower().split("x"))
    except ValueError:
        raise BadInput(f"size {text!r}: give width and depth in metres, such as 30x20") from None
    return width, depth


simulate.help = (simulate.help or "").format(sensors=translation.SENSOR_HELP, odometry=translation.ODOMETRY_HELP)
