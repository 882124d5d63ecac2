"""``bayesmap simulate``: the log of a robot in a known world, and the truth beside it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from bayesmap.cli import sensors
from bayesmap.cli.command import Call, takes
from bayesmap.cli.world import world_of
from bayesmap.errors import BadInput
from bayesmap.version import __version__

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MAX_BEAMS = 100_000


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

    {sensors}
    """
    values = call.values()
    log = Path(output or f"{Path(values['world']).stem}.log")
    truth = log.with_name(f"{_stem(log)}-truth.yaml")
    if not {".log", ".gz"} & {log.suffix}:
        raise click.UsageError(f"-o {log}: the name of a log ends in .log or .log.gz")
    existing = [path for path in (log, truth, truth.with_suffix(".pgm")) if path.exists()]
    if existing and not force:
        raise BadInput(f"{existing[0]}: exists already; --force replaces it, -o takes another name")
    sensor = sensors.sensor_of(values["sensor"])
    world = world_of(values, poses)
    tutorial = world.is_tutorial
    beams = (100 if tutorial else 180) if values["angles"] is None else values["angles"]
    angles = fan(beams, (360.0 if tutorial else 180.0) if values["fov"] is None else values["fov"])
    max_range_m = (42.0 if tutorial else 30.0) if values["max_range"] is None else values["max_range"]

    from bayesmap.io.carmen_writer import write_carmen
    from bayesmap.io.map_server import write_map
    from bayesmap.sim.forward import simulate

    scans = simulate(
        world.walls,
        world.grid,
        world.poses,
        angles,
        sensor=sensor if sensor is not None else world.sensor(),
        max_range_m=max_range_m,
        seed=values["seed"],
        opacity=world.opacity,
    )
    log.parent.mkdir(parents=True, exist_ok=True)
    message = write_carmen(log, scans)
    outputs = [log, *write_map(truth, world.walls.astype(float), world.grid)]

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
        "seed": values["seed"],
        "outputs": {path.name: str(path) for path in outputs},
    }
    call.talk.say(
        f"{log}: {len(scans):,} scans of {len(angles)} beams ({message}) in {values['world']}, "
        f"{world.grid.shape[0]} x {world.grid.shape[1]} cells of {world.grid.resolution:g} m"
    )
    call.talk.result(document, outputs)


def fan(beams: int, fov_deg: float) -> NDArray[np.float64]:
    """Beam angles, from half the field of view on the right to the left.

    An odd number of beams has one at each end, as lasers of 181 or 361 beams do; an even number leaves out the last,
    as those of 180 or 360 do. A full circle starts straight ahead and never has its first beam twice.

    Raises:
        BadInput: fewer than two beams, or a field of view outside (0, 360] degrees.
    """
    import numpy as np

    if not 2 <= beams <= MAX_BEAMS:
        raise BadInput(f"angles: give 2 to {MAX_BEAMS:,} beams a scan, got {beams}")
    if not 0 < fov_deg <= 360:
        raise BadInput(f"fov: the field of view must lie in (0, 360] degrees, got {fov_deg:g}")
    if fov_deg == 360:
        return np.asarray(np.arange(beams) * 2 * math.pi / beams)
    step = fov_deg / (beams - beams % 2)
    return np.asarray(np.radians(step * np.arange(beams) - fov_deg / 2))


def _stem(log: Path) -> str:
    return log.name.removesuffix(".gz").removesuffix(".log")


command.help = (command.help or "").format(sensors=sensors.HELP)
