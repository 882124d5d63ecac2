"""``bayesmap simulate``: write the log of a robot in a known world, and the true map and trajectory.

`simulate` completes the settings, makes the world (`world_of`), draws the scans and the poses of odometry, and writes
the log: a CARMEN log of scans, or an MCAP recording of a driving robot, each with defaults of its own.
"""

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
from bayesmap.cli.translation import MAP_ENDINGS, is_map, need_free, odometry_of, pose_of, sensor_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.sensors.model import SensorModel
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans

    Floats = NDArray[np.float64]

TURN_RAD_PER_S = 1.0  # turning rate of a simulated robot, used for the time stamps

P_RANDOM = 1e-5  # probability of a random reading: it is small, since one far reading makes the map larger
RATE_HZ = 10.0  # scans a second of a recording
START_S = 1.7e9  # time stamp of its first scan

LOG_DEFAULTS: dict[str, Any] = {"world": "tutorial", "odometry": "true", "laser": "0,0,0"}
RECORDING_DEFAULTS: dict[str, Any] = {"world": "building", "odometry": "typical", "laser": "-0.1,0.03,180"}
RECORDING_DEFAULTS |= {"angles": 720, "fov": 360.0, "max_range": 12.0}

IMAGE_ENDINGS = (".png", ".pgm", ".ppm", ".pbm", ".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp")


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
    bayesmap simulate --world building --odometry typical --drive-seed 1 -o second-drive.log

    {odometry}

    {sensors}
    """
    settings = call.settings()
    # Check the arguments, and name the files.
    is_recording = settings.format == "mcap" if output is None else Path(output).suffix == ".mcap"
    if output is not None and settings.format not in (None, "mcap" if is_recording else "carmen"):
        raise click.UsageError(f"-o {output}: the name of a log of --format {settings.format} ends differently")
    settings = _completed(settings, is_recording=is_recording, has_poses=bool(poses))
    drive_seed = seed_of_drive(settings)
    noise, mount = odometry_of(str(settings.odometry)), pose_of(str(settings.laser), "--laser")
    log = Path(output or f"{Path(str(settings.world)).stem}{'.mcap' if is_recording else '.log'}")
    if log.suffix not in (".log", ".gz", ".mcap"):
        raise click.UsageError(f"-o {log}: the name of a log ends in .log, .log.gz or .mcap")
    stem = log.name.removesuffix(".gz").removesuffix(".log").removesuffix(".mcap")
    true_map, relations = log.with_name(f"{stem}-truth.yaml"), log.with_name(f"{stem}.relations")
    trajectory, image = true_map.with_suffix(".tum"), true_map.with_suffix(".pgm")
    need_free([log, true_map, image, *([] if noise is None else [trajectory, relations])], force=force)
    sensor = sensor_of(settings.sensor)
    # Make the world and the sensor, and draw the scans.
    world = world_of(settings, poses)
    sensor = world.sensor() if sensor is None else sensor
    scans = _draw_scans(settings, world, mount, sensor)
    import numpy as np

    from bayesmap.io.ros.maps import write_map
    from bayesmap.io.ros.writer import write_scans
    from bayesmap.io.text.carmen import write_carmen
    from bayesmap.sensors.model import describe
    from bayesmap.sim.robot import simulate_odometry, travel_times_s
    from bayesmap.space.planar import compose

    # Draw the poses of odometry, and put them into the log.
    base, stamps_s = world.poses, world.stamps_s
    if stamps_s is None and (is_recording or noise is not None):
        stamps_s = travel_times_s(base, settings.speed, TURN_RAD_PER_S)
    if stamps_s is not None:
        stamps_s = stamps_s + (START_S if is_recording else 0.0)
        if noise is not None:
            base = simulate_odometry(base, noise, stamps_s=stamps_s, seed=drive_seed)
        scans = replace(scans, poses=compose(base, np.array(mount)), stamps_s=stamps_s)
    # Write the log and the truth.
    log.parent.mkdir(parents=True, exist_ok=True)
    if is_recording:
        message = "/scan, /tf and /tf_static"
        write_scans(log, scans, base, mount)
    else:
        message = write_carmen(log, scans, base)
    outputs = [log, *write_map(true_map, world.walls.astype(float), world.grid)]
    if noise is not None:
        assert stamps_s is not None
        outputs += _write_true_poses(trajectory, relations, world.poses, stamps_s, drive_seed)
    # Print the result.
    grid = world.grid
    document = {
        "world": settings.world, "grid": grid_document(grid), "scans": len(scans), "beams": scans.n_beams,
        "readings": scans.counts(), "message": message, "max_range_m": scans.max_range_m, "sensor": describe(sensor),
        "odometry": None if noise is None else asdict(noise), "laser": list(mount), "seed": settings.seed,
        "drive_seed": drive_seed, "outputs": {path.name: str(path) for path in outputs},
    }  # fmt: skip
    poses_kind = "true poses" if noise is None else "raw odometry"
    size = f"{len(scans):,} scans of {scans.ranges_m.shape[1]} beams"
    cells = f"{grid.shape[0]} x {grid.shape[1]} cells of {grid.resolution:g} m"
    call.console.say(f"{log}: {size} ({message}, {poses_kind}) in {settings.world}, {cells}")
    call.console.result(document, outputs)


simulate.help = (simulate.help or "").format(sensors=translation.SENSOR_HELP, odometry=translation.ODOMETRY_HELP)


def _completed(settings: SimulateSettings, *, is_recording: bool, has_poses: bool) -> SimulateSettings:
    """Return the settings with the defaults of a recording or a log. Raises `BadInput` for unused minutes."""
    defaults = RECORDING_DEFAULTS if is_recording else LOG_DEFAULTS
    unset = {name: value for name, value in defaults.items() if getattr(settings, name) is None}
    settings = msgspec.structs.replace(settings, **unset)
    drives = settings.world == "building" and not has_poses
    if settings.minutes is not None and not drives:
        raise BadInput("--minutes: the robot drives in --world building, without --pose, only")
    if settings.minutes is None and is_recording and drives:
        settings = msgspec.structs.replace(settings, minutes=2.0)
    return settings


def seed_of_drive(settings: SimulateSettings) -> int:
    """Return the seed of the robot's path, its readings and its odometry. The building has a seed of its own."""
    return settings.seed if settings.drive_seed is None else settings.drive_seed


def _draw_scans(
    settings: SimulateSettings, world: World, mount: tuple[float, float, float], sensor: SensorModel
) -> Scans:
    """Draw a scan from each pose of the world. ``mount`` is the pose of the laser on the robot."""
    import numpy as np

    from bayesmap.sim import forward
    from bayesmap.space.planar import compose
    from bayesmap.space.scans import fan

    n_beams = world.n_beams if settings.angles is None else settings.angles
    angles_rad = fan(n_beams, world.fov_deg if settings.fov is None else settings.fov)
    laser_poses = compose(world.poses, np.array(mount)) if any(mount) else world.poses  # composing may round
    max_range_m = world.max_range_m if settings.max_range is None else settings.max_range
    return forward.simulate(
        world.walls, world.grid, laser_poses, angles_rad, sensor=sensor, max_range_m=max_range_m,
        seed=seed_of_drive(settings), opacity=world.opacity, typed=True,
    )  # fmt: skip


def _write_true_poses(trajectory: Path, relations: Path, base: Floats, stamps_s: Floats, seed: int) -> list[Path]:
    """Write true poses of the base, (S, 3), at their times, (S,), and relations between them. Returns the paths."""
    from bayesmap.io.text.trajectories import write_relations, write_trajectory
    from bayesmap.sim.robot import related_pairs
    from bayesmap.space.planar import between

    outputs = [write_trajectory(trajectory, base, stamps_s, "base")]
    start, end = related_pairs(base, seed)
    if len(start):
        outputs.append(write_relations(relations, stamps_s[start], stamps_s[end], between(base[start], base[end])))
    return outputs


@dataclass(frozen=True, eq=False)
class World:
    """A world with a robot in it, and the robot's default laser."""

    walls: NDArray[np.bool_]  # true walls, (nx, ny)
    grid: Grid
    poses: Floats  # poses of the robot's base in the world frame, (S, 3)
    stamps_s: Floats | None = None  # time of each pose, (S,), where the robot drives
    opacity: Floats | None = None  # probability that a wall stops a beam, (nx, ny); None if all do
    is_tutorial: bool = False  # whether the sensor is the tutorial's
    n_beams: int = 180
    fov_deg: float = 180.0
    max_range_m: float = 30.0

    def sensor(self) -> SensorModel:
        """Return the default sensor: the tutorial's noise with typed no-returns, or a good laser."""
        from bayesmap.cells.kinds import LASER_SIGMA_M, LASER_SIGMA_PER_M
        from bayesmap.sensors.model import BeamMixture, Gaussian

        if self.is_tutorial:
            return BeamMixture(Gaussian(0.2), p_random=P_RANDOM, p_no_return=0.0, p_short=0.0)
        return BeamMixture(Gaussian(LASER_SIGMA_M, LASER_SIGMA_PER_M), p_random=P_RANDOM)


def world_of(settings: SimulateSettings, poses: Sequence[str]) -> World:
    """Return the world that the settings name, with the robot at the typed poses, or driving. Refuses a wrong world."""
    import numpy as np

    name, resolution = settings.world or "tutorial", settings.resolution
    typed_poses = np.array([pose_of(text) for text in poses]) if poses else None
    if name == "tutorial":
        return _tutorial(resolution, typed_poses)
    if name == "building":
        return _building(settings, typed_poses)
    path = Path(name)
    if not path.is_file():
        raise BadInput(f"world {name!r}: no such file; give tutorial, building, a drawing, picture or map_server YAML")
    if typed_poses is None:
        raise click.UsageError(f"where is the robot in {name}? give --pose X,Y,DEGREES, once for each scan")
    return World(*_read_walls(path, resolution), typed_poses)


def _tutorial(resolution: float | None, typed_poses: Floats | None) -> World:
    """Return the tutorial's world, with cells of another size if there is a resolution."""
    from bayesmap.sim.drawing import TUTORIAL_GRID, tutorial
    from bayesmap.space.grid import Grid

    walls, pose = tutorial()
    grid, poses = TUTORIAL_GRID, pose[None]
    if resolution is not None and resolution != grid.resolution:
        grid = Grid(grid.shape, resolution, (-resolution / 2, -resolution / 2))
        poses = poses * (resolution, resolution, 1.0)
    poses = poses if typed_poses is None else typed_poses
    return World(walls, grid, poses, is_tutorial=True, n_beams=100, fov_deg=360.0, max_range_m=42.0)


def _building(settings: SimulateSettings, typed_poses: Floats | None) -> World:
    """Return a building, in which the robot drives for some minutes, patrols, or stands at the typed poses."""
    from bayesmap.sim.building import building
    from bayesmap.sim.robot import drive, patrol

    plan, stamps_s = building(settings.seed, _size(settings.size), settings.resolution or 0.1), None
    drive_seed = seed_of_drive(settings)
    if settings.minutes is not None:
        speeds = {"speed_m_per_s": settings.speed, "turn_rad_per_s": TURN_RAD_PER_S}
        stamps_s, poses = drive(plan, 60.0 * settings.minutes, RATE_HZ, **speeds, seed=drive_seed)
    else:
        poses = patrol(plan, settings.scans, drive_seed) if typed_poses is None else typed_poses
    return World(plan.walls, plan.grid, poses, stamps_s, plan.opacity)


def _read_walls(path: Path, resolution: float | None) -> tuple[NDArray[np.bool_], Grid]:
    """Read walls, (nx, ny), and their grid from a map_server map, a picture or a text drawing."""
    from bayesmap.io.ros.maps import from_image, read_map
    from bayesmap.sim.drawing import from_text
    from bayesmap.space.grid import Grid

    if is_map(str(path)):
        occupancy, grid = read_map(path)
        return occupancy > 0.5, grid if resolution is None else Grid(grid.shape, resolution, grid.origin)
    if path.suffix.lower() in IMAGE_ENDINGS:
        walls = from_image(path)
        return walls, Grid(walls.shape, resolution or 0.1)
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        endings = f"{', '.join(IMAGE_ENDINGS)} or {', '.join(MAP_ENDINGS)}"
        raise BadInput(f"{path}: neither a text drawing nor called {endings}") from None
    try:
        walls = from_text(text)
    except BadInput as problem:
        raise BadInput(f"{path}: {problem}") from None
    return walls, Grid(walls.shape, resolution or 1.0)


def _size(text: str) -> tuple[float, float]:
    """Return width and depth in metres. Raises `BadInput` for another text than two numbers with an x between them."""
    try:
        width, depth = (float(number) for number in text.lower().split("x"))
    except ValueError:
        raise BadInput(f"size {text!r}: give width and depth in metres, such as 30x20") from None
    return width, depth
