"""``bayesmap infer``: from logs to posteriors, pictures and maps."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli import cells, executors, inferring, sensors
from bayesmap.cli.command import PROBLEMS, Call, takes
from bayesmap.cli.console import reserve_stdout
from bayesmap.cli.fleet import infer_fleet
from bayesmap.cli.folder import Folder
from bayesmap.cli.input_files import LOG, logs_of, need_file

if TYPE_CHECKING:
    from bayesmap.sensors.model import SensorModel


@takes("infer")
@click.argument("logs", metavar="LOG...", nargs=-1, required=True)
@click.option(
    "-o",
    "--output",
    metavar="DIR",
    help="Folder of the run; of several, their folders' folder. [default: runs/NAME-OF-LOG]",
)
@click.option("--resume", is_flag=True, help="Go on with the run in DIR, bit for bit as if it had never stopped.")
@click.option("--force", is_flag=True, help="Replace the run in DIR.")
def command(call: Call, logs: tuple[str, ...], output: str | None, resume: bool, force: bool) -> None:
    r"""Infer the walls from LOG: a CARMEN log, a ROS 1 or ROS 2 bag, MCAP, g2o, CSV or .npz of range scans.

    A cell's state is by default a reflectivity (the chance that it stops a beam) and the place of the surface in it,
    and the sensor is fitted to the log; with --cells binary a cell is a wall or free, and --sensor fit says so.

    Leaves in DIR the saved run (run.nc), a picture (posterior.png), the map for nav2 (map.yaml), the JSON document
    (summary.json) and the settings (config.toml). The run is saved at the end of warm-up, every 30 seconds, and on
    Ctrl-C; --resume goes on, with the settings that the run was started with.

    Several logs, a folder of them or a quoted pattern are inferred each into a folder of its own, under -o or runs/;
    one that cannot be is named, and the exit code is then 1. With --executor ray chains run on a Ray cluster, and of
    several logs each is a task of its own.

    \b
    bayesmap infer office.log.gz -o runs/office
    bayesmap infer office.log.gz --resolution 0.05 --max-range 20 --holdout 10 --json
    bayesmap infer recording.mcap --scan-topic /scan --pose-topic /odom
    bayesmap infer 'logs/*.log.gz' -o runs --executor ray

    {sensors}
    """
    if resume and force:
        raise click.UsageError("--resume goes on with a run and --force replaces it: give one of them")
    found = logs_of(logs)
    if found is not None:
        infer_fleet(call, found, Path(output or "runs"), resume=resume, force=force)
        return
    log = logs[0]
    need_file(log, f"{LOG} (bayesmap info FILE says what is in one)", runs=False)
    folder = Folder(Path(output) if output else Path("runs") / inferring.stem(log), call.console, resuming=resume)
    values = call.values(inferring.settings_of(folder) if resume else None)
    values = cells.with_defaults(values)
    sensor = "fit" if values["sensor"] == "fit" else sensors.sensor_of(values["sensor"])
    folder.check(force=force)

    go_on = shlex.join(["bayesmap", "infer", log, "-o", str(folder.path), "--resume"])
    try:
        _run(call, folder, log, values, sensor, go_on)
    except KeyboardInterrupt:  # while setting up, or once more while the chains were being stopped
        if (folder.begun or resume) and folder.run.exists():
            call.console.say(f"the last checkpoint is kept; go on with:\n  {go_on}")
        raise


def _run(
    call: Call, folder: Folder, log: str, values: dict[str, Any], sensor: SensorModel | str | None, go_on: str
) -> None:
    executor = executors.executor_of(values["executor"])
    reading = inferring.read(call.console, log, values)
    train, heldout = inferring.split(reading.scans, values["holdout"])
    saved = inferring.saved(folder) if folder.resuming else None
    if executor is not None:
        reserve_stdout()
    run = inferring.sample(folder, reading.scans, train, values, sensor, saved, executor)
    if not run.finished:
        inferring.leave(folder, run, reading, go_on)

    document = inferring.finish(folder, run, reading, heldout, values["holdout"])
    inferring.report(call.console, document)
    call.console.result(document, document["outputs"].values())
    if values["strict"] and document["problems"]:
        click.get_current_context().exit(PROBLEMS)


command.help = (command.help or "").format(sensors=sensors.HELP)
