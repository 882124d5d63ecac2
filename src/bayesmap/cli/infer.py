"""``bayesmap infer``: from logs to posteriors, pictures and maps."""

from __future__ import annotations

import shlex
from pathlib import Path

import click

from bayesmap.cli import pipeline, typed
from bayesmap.cli.command import Call, takes
from bayesmap.cli.console import INTERRUPTED, PROBLEMS, reserve_stdout
from bayesmap.cli.fleet import infer_fleet
from bayesmap.cli.keys import InferSettings
from bayesmap.cli.logs import logs_of
from bayesmap.cli.translation import executor_of


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
def infer(call: Call[InferSettings], logs: tuple[str, ...], output: str | None, resume: bool, force: bool) -> None:
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
    # Several logs are a fleet.
    several = logs_of(logs)
    if several is not None:
        infer_fleet(call, several, Path(output or "runs"), resume=resume, force=force)
        return
    # Check what was typed.
    log = logs[0]
    folder = Path(output) if output else Path("runs") / pipeline.stem(log)
    task = pipeline.prepare(call, log, folder, resume=resume, force=force)
    executor = executor_of(task.settings.executor)
    if executor is not None:
        reserve_stdout()
    # Infer the log.
    go_on = shlex.join(["bayesmap", "infer", log, "-o", str(folder), "--resume"])
    try:
        document = pipeline.infer_log(task, executor=executor, go_on=go_on)
    except KeyboardInterrupt:  # while setting up, or once more while the chains were being stopped
        if (task.folder.begun or resume) and task.folder.run.exists():
            call.console.say(f"the last checkpoint is kept; go on with:\n  {go_on}")
        raise
    # Print the result.
    call.console.result(document, document["outputs"].values())
    if not document["finished"]:
        click.get_current_context().exit(INTERRUPTED)
    if task.settings.strict and document["problems"]:
        click.get_current_context().exit(PROBLEMS)


infer.help = (infer.help or "").format(sensors=typed.SENSOR_HELP)
