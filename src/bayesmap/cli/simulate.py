"""``bayesmap simulate``: the log of a robot in a known world, and the truth beside it."""

from __future__ import annotations

from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli import odometry, sensors
from bayesmap.cli.command import Call, takes
from bayesmap.cli.world import pose_of, world_of
from bayesmap.errors import BadInput
from bayesmap.version import __version__

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.sim.odometry import OdometryNoise

TURN_RAD_PER_S = 1.0
"""How fast a simulated robot turns."""


@takes("simulate")
@click.option("-o", "--output", metavar="LOG", help="The log, .log or .log.gz. [default: WORLD.log]")
@click.option("--pose", "poses", metavar="X,Y,DEGREES", multiple=True, help="One scan from here; may be repeated.")
@click.option("--force", is_flag=True, help="Replace existing files.")
def command(call: Call, output: str | None, poses: tuple[str, ...], force: bool) -> None:
    r"""Draw the scans of a robot in a known world, as a CARMEN log that infer reads.

    Beside LOG.log the truth is written as a map for nav2, LOG-truth.yaml. In a building the robot goes round
    through the rooms; in the tutorial's map it stands in the middle; elsewhere say where with --pose.

    \b
    bayesmap simulate --world building -o office.log
    bayesmap infer office.log -o runs/office
    bayesmap render runs/office/run.nc --truth office-truth.yaml

    With --odometry the log says what the robot's odometry reports; the laser's true trajectory is written to
    LOG-truth.tum, and true relations between poses of the robot's base (Kuemmerle et al. 2009) to LOG.relations.

    \b
    bayesmap simulate --world building --odometry typical --laser 0.1,0,0 -o office.log

    {odometry}

    {sensors}
    """
    values = call.values()
    log = Path(output or f"{Path(values['world']).stem}.log")
    if not {".log", ".gz"} & {log.suffix}:
        raise click.UsageError(f"-o {log}: the name of a log ends in .log or .log.gz")
    truth = log.with_name(f"{_stem(log)}-truth.yaml")
    trajectory, relations = truth.with_suffix(".tum"), log.with_name(f"{_stem(log)}.relations")
    noise = odometry.odometry_of(values["odometry"])
    written = [log, truth, truth.with_suffix(".pgm"), *([] if noise is None else [trajectory, relations])]
    existing = [path for path in written if path.exists()]
    if existing and not force:
        raise BadInput(f"{existing[0]}: exists already; --force replaces it, -o takes another name")
    mount = pose_of(values["laser"], "--laser")
    sensor = sensors.sensor_of(values["sensor"])
    world = world_of(values, poses)
    tutorial = world.is_tutorial
    beams = (100 if tutorial else 180) if values["angles"] is None else values["angles"]
    max_range_m = (42.0 if tutorial else 30.0) if values["max_range"] is None else values["max_range"]

    import numpy as np

    from bayesmap.io.ros.maps import write_map
    from bayesmap.io.text.carmen import write_carmen
    from bayesmap.sim.forward import simulate
    from bayesmap.space.beam_angles import fan
    from bayesmap.space.planar import compose

    angles = fan(beams, (360.0 if tutorial else 180.0) if values["fov"] is None else values["fov"])

    base = world.poses
    laser = compose(base, np.array(mount)) if any(mount) else base
    scans = simulate(
        world.walls,
        world.grid,
        laser,
        angles,
        sensor=sensor if sensor is not None else world.sensor(),
        max_range_m=max_range_m,
        seed=values["seed"],
        opacity=world.opacity,
        typed=True,
    )
    if noise is not None:
        from bayesmap.sim.odometry import simulate_odometry, travel_times_s

        stamps = travel_times_s(base, values["speed"], TURN_RAD_PER_S)
        base = simulate_odometry(base, noise, stamps_s=stamps, seed=values["seed"])
        scans = replace(scans, poses=compose(base, np.array(mount)), stamps_s=stamps)
    log.parent.mkdir(parents=True, exist_ok=True)
    message = write_carmen(log, scans, base)
    outputs = [log, *write_map(truth, world.walls.astype(float), world.grid)]
    if noise is not None:
        outputs += _write_truth(trajectory, relations, laser, world.poses, stamps, values["seed"])

    from bayesmap.sensors.describe import describe

    document = {
        "version": __version__,
        "world": values["world"],
        "grid": {
            "shape": list(world.grid.shape),
            "resolution": world.grid.resolution,
            "origin": list(world.grid.origin),
        },
        "scans": len(scans),
        "beams": scans.n_beams,
        "readings": scans.counts(),
        "message": message,
        "max_range_m": max_range_m,
        "sensor": describe(sensor if sensor is not None else world.sensor()),
        "odometry": _described(noise),
        "laser": list(mount),
        "seed": values["seed"],
        "outputs": {path.name: str(path) for path in outputs},
    }
    poses_are = "true poses" if noise is None else "raw odometry"
    call.console.say(
        f"{log}: {len(scans):,} scans of {len(angles)} beams ({message}, {poses_are}) in {values['world']}, "
        f"{world.grid.shape[0]} x {world.grid.shape[1]} cells of {world.grid.resolution:g} m"
    )
    call.console.result(document, outputs)


def _write_truth(
    trajectory: Path,
    relations: Path,
    laser: NDArray[np.float64],
    base: NDArray[np.float64],
    stamps_s: NDArray[np.float64],
    seed: int,
) -> list[Path]:
    from bayesmap.io.text.relations import write_relations
    from bayesmap.io.text.tum import write_trajectory
    from bayesmap.sim.odometry import related_pairs
    from bayesmap.space.planar import between

    outputs = [write_trajectory(trajectory, laser, stamps_s)]
    start, end = related_pairs(base, seed)
    if len(start):
        true = between(base[start], base[end])
        outputs.append(write_relations(relations, stamps_s[start], stamps_s[end], true))
    return outputs


def _described(noise: OdometryNoise | None) -> dict[str, Any] | None:
    return None if noise is None else asdict(noise)


def _stem(log: Path) -> str:
    return log.name.removesuffix(".gz").removesuffix(".log")


command.help = (command.help or "").format(sensors=sensors.HELP, odometry=odometry.HELP)
