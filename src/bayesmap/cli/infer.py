"""``bayesmap infer``: from logs to posteriors, pictures and maps.

One log is inferred into one folder (`bayesmap.cli.pipeline`). Several logs form a fleet: each is inferred into its own
folder, one after the other or as tasks of a Ray cluster (`bayesmap.cli.fleet_on_ray`). A log that fails stops no other.
"""

import shlex
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import click

from bayesmap.cli import pipeline
from bayesmap.cli.command import Call, as_toml, command
from bayesmap.cli.console import Console, align_rows, exit_unless_good, reserve_stdout
from bayesmap.cli.fleet_on_ray import FleetLog, RayFleet
from bayesmap.cli.keys import InferSettings
from bayesmap.cli.pipeline import infer_log, log_stem, prepare, settings_in
from bayesmap.cli.translation import SENSOR_HELP, executor_of, logs_of, ray_address
from bayesmap.errors import BadInput
from bayesmap.files import write_file

SETTINGS = "fleet.toml"  # file beside the folders of the runs: the settings of the last fleet


@command("infer")
@click.argument("logs", metavar="LOG...", nargs=-1, required=True)
@click.option(
    "-o", "--output", metavar="DIR",
    help="Folder of the run; for several logs, the parent of their folders. [default: runs/NAME-OF-LOG]",
)  # fmt: skip
@click.option("--resume", is_flag=True, help="Resume the run in DIR, bit for bit as if it had never stopped.")
@click.option("--force", is_flag=True, help="Replace the run in DIR.")
def infer(call: Call[InferSettings], logs: tuple[str, ...], output: str | None, resume: bool, force: bool) -> None:
    r"""Infer the walls from LOG: a CARMEN log, a ROS 1 or ROS 2 bag, MCAP, g2o, CSV or .npz of range scans.

    By default a cell has a reflectivity (the chance that it stops a beam) and the position of a surface. The sensor is
    fitted to the log. With --cells binary a cell is a wall or free, and the sensor is fitted only with --sensor fit.

    The command writes into DIR the saved run (run.nc), a picture (posterior.png), the map for nav2 (map.yaml), the JSON
    document (summary.json) and the settings (config.toml). The run is saved at the end of warm-up, every 30 seconds,
    and on Ctrl-C. --resume continues it with its original settings.

    Several logs, a folder of logs or a quoted pattern are each inferred into their own folder, under -o or runs/. If a
    log fails, the table names it, and the exit code is 1. With --executor ray chains run on a Ray cluster; each of
    several logs is one task.

    \b
    bayesmap infer office.log.gz -o runs/office
    bayesmap infer office.log.gz --resolution 0.05 --max-range 20 --holdout 10 --json
    bayesmap infer recording.mcap --scan-topic /scan --pose-topic /odom
    bayesmap infer 'logs/*.log.gz' -o runs --executor ray

    {sensors}
    """
    if resume and force:
        raise click.UsageError("--resume goes on with a run and --force replaces it: give one of them")
    # Several logs form a fleet.
    all_logs, is_fleet = logs_of(logs)
    if is_fleet:
        infer_fleet(call, all_logs, Path(output or "runs"), resume=resume, force=force)
        return
    log = logs[0]
    folder = Path(output) if output else Path("runs") / log_stem(log)
    task = prepare(call, log, folder, resume=resume, force=force)
    executor = executor_of(task.settings.executor)
    if executor is not None:
        reserve_stdout()
    resume_command = shlex.join(["bayesmap", "infer", log, "-o", str(folder), "--resume"])
    try:
        document = infer_log(task, executor=executor, resume_command=resume_command)
    except KeyboardInterrupt:  # during set-up, or a second Ctrl-C while the chains stop
        if (task.folder.begun or resume) and task.folder.run_path.exists():
            call.console.say(f"the last checkpoint is kept; go on with:\n  {resume_command}")
        raise
    pipeline.print_result(call, document, strict=task.settings.strict)


infer.help = (infer.help or "").format(sensors=SENSOR_HELP)


def infer_fleet(call: Call[InferSettings], logs: list[str], output: Path, *, resume: bool, force: bool) -> None:
    """Infer each log into its folder under ``output``, and print a table; exit with code 1 if a log failed."""
    name, count = Counter(map(log_stem, logs)).most_common(1)[0]
    if count > 1:
        raise BadInput(f"{name}: two of the logs have this name, so their runs would share a folder; rename one")
    # Check the arguments, for all logs together and for each.
    earlier = settings_in(output / SETTINGS, "infer") if resume else None
    settings = call.settings(earlier)
    on_ray, address = ray_address(settings.executor)
    fleet = [FleetLog(log, output / log_stem(log)) for log in logs]
    for entry in fleet:
        try:
            entry.task = prepare(call, entry.log, entry.path, resume=resume, force=force, earlier=earlier)
        except Exception as error:
            entry.fail(error, call.console)
    checked = [entry for entry in fleet if entry.task is not None]
    # Save the settings before the first log begins: a resuming process may have to begin the other logs.
    if checked:
        toml = as_toml({"infer": settings})
        output.mkdir(parents=True, exist_ok=True)
        write_file(output / SETTINGS, toml)
        for entry in checked:
            entry.checked_task.folder.mark_outdated(toml)
    try:
        if on_ray:
            reserve_stdout()
            RayFleet(call.console, address).run(checked)
            finished = True
        else:
            finished = all(_infer_here(entry, call.console) for entry in checked)
    except KeyboardInterrupt:
        finished = False
    if not finished:
        resume_command = shlex.join(["bayesmap", "infer", *logs, "-o", str(output), "--resume"])
        call.console.say(f"interrupted; what was checkpointed is kept, go on with:\n  {resume_command}")
    call.console.result({"runs": [entry.as_json() for entry in fleet], "finished": finished}, fleet_table(fleet))
    problems = any(entry.problems and entry.checked_task.settings.strict for entry in fleet)
    exit_unless_good(finished=finished, failed=any(entry.error for entry in fleet), problems=problems)


def _infer_here(entry: FleetLog, console: Console) -> bool:
    """Infer a log in this process. Returns whether it was not interrupted."""
    try:
        document = infer_log(entry.checked_task)
    except Exception as error:
        entry.fail(error, console)
        return True
    entry.document = document if document["finished"] else None
    return entry.document is not None


def fleet_table(fleet: list[FleetLog]) -> Iterator[str]:
    """Yield the lines of the table: a heading, and one line per log."""
    rows = [("log", "beams", "minutes", "R-hat", "held out")]
    last_column = ["folder, or what went wrong"]  # set to the left, unlike the numbers
    for entry in fleet:
        run = entry.document
        if run is None:
            rows.append((entry.log, "-", "-", "-", "-"))
            last_column.append(entry.error or "not finished")
            continue
        rhat = "-" if run["rhat_max"] is None else f"{run['rhat_max']:.2f}"
        nats = f"{run['heldout']['nats_per_beam']:.3f}" if run["heldout"] else "-"
        rows.append((entry.log, f"{run['beams']:,}", f"{run['seconds']['total'] / 60:.1f}", rhat, nats))
        last_column.append(str(entry.path) + (f" ({len(entry.problems)} problems)" if entry.problems else ""))
    for line, text in zip(align_rows(rows), last_column, strict=True):
        yield f"{line}  {text}"
