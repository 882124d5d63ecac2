"""``bayesmap infer``: from a log to a posterior, a picture and a map."""

from __future__ import annotations

import os
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click

from bayesmap.cli import cells, sensors
from bayesmap.cli.command import INTERRUPTED, PROBLEMS, Call, takes
from bayesmap.cli.folder import Folder
from bayesmap.cli.given import LOG, need_file
from bayesmap.cli.keys import SECTIONS
from bayesmap.cli.progress import SETTING_UP, progress, stage
from bayesmap.cli.reading import options_of
from bayesmap.cli.settings import Settings, as_toml, read_file
from bayesmap.cli.talk import Talk, counted

if TYPE_CHECKING:
    from bayesmap.io.log_reading import LogReading
    from bayesmap.result import Run
    from bayesmap.sensors.model import SensorModel
    from bayesmap.space.scans import Scans

PASSED_ON = (
    "method", "order", "chains", "warmup", "draws", "thin", "seed", "start", "particles", "rounds", "hit_depth",
    "threads", "device",
)  # fmt: skip
"""Settings that `bayesmap.infer` has under the same name."""

DEFAULTS = {key.name: key.default for key in SECTIONS["infer"]}


def names_of(section: str) -> list[str]:
    """Names of a command's settings."""
    return [key.name for key in SECTIONS[section]]


@takes("infer")
@click.argument("log")
@click.option("-o", "--output", metavar="DIR", help="Folder of the run. [default: runs/NAME-OF-LOG]")
@click.option("--resume", is_flag=True, help="Go on with the run in DIR, bit for bit as if it had never stopped.")
@click.option("--force", is_flag=True, help="Replace the run in DIR.")
def command(call: Call, log: str, output: str | None, resume: bool, force: bool) -> None:
    r"""Infer the walls from LOG: a CARMEN log, a ROS 1 or ROS 2 bag, MCAP, g2o, CSV or .npz of range scans.

    A cell's state is by default a reflectivity (the chance that it stops a beam) and the place of the surface in it,
    and the sensor is fitted to the log; with --cells binary a cell is a wall or free, and --sensor fit says so.

    Leaves in DIR the saved run (run.nc), a picture (posterior.png), the map for nav2 (map.yaml), the JSON document
    (summary.json) and the settings (config.toml). The run is saved at the end of warm-up, every 30 seconds, and on
    Ctrl-C; --resume goes on, with the settings that the run was started with.

    \b
    bayesmap infer office.log.gz -o runs/office
    bayesmap infer office.log.gz --resolution 0.05 --max-range 20 --holdout 10 --json
    bayesmap infer recording.mcap --scan-topic /scan --pose-topic /odom

    {sensors}
    """
    if resume and force:
        raise click.UsageError("--resume goes on with a run and --force replaces it: give one of them")
    need_file(log, f"{LOG} (bayesmap info FILE says what is in one)", runs=False)
    folder = Folder(Path(output) if output else Path("runs") / stem(log), call.talk, resuming=resume)
    values = call.values(settings_of(folder) if resume else None)
    values = cells.settled(values)
    sensor = "fit" if values["sensor"] == "fit" else sensors.sensor_of(values["sensor"])
    folder.check(force=force)

    go_on = shlex.join(["bayesmap", "infer", log, "-o", str(folder.path), "--resume"])
    try:
        _run(call, folder, log, values, sensor, go_on)
    except KeyboardInterrupt:  # while setting up, or once more while the chains were being stopped
        if (folder.begun or resume) and folder.run.exists():
            call.talk.say(f"the last checkpoint is kept; go on with:\n  {go_on}")
        raise


def _run(
    call: Call, folder: Folder, log: str, values: dict[str, Any], sensor: SensorModel | str | None, go_on: str
) -> None:
    reading = read(call.talk, log, values)
    train, heldout = _split(reading.scans, values["holdout"])
    before = saved(folder) if folder.resuming else None
    run = _infer(folder, reading.scans, train, values, sensor, before)
    if not run.finished:
        leave(folder, run, reading, go_on)

    outputs = folder.write_products(run)
    score = _score(call.talk, run, heldout, values["holdout"])
    with progress(call.talk, "comparing the chains"):
        document = document_of(run, reading, score, [*outputs, folder.path / "summary.json", folder.config])
    folder.write_document(document)
    report(call.talk, document)
    call.talk.result(document, document["outputs"].values())
    if values["strict"] and document["problems"]:
        click.get_current_context().exit(PROBLEMS)


def stem(log: str) -> str:
    """What a run of a log is called."""
    name = os.path.basename(os.path.normpath(log))
    for ending in (".gz", ".log", ".clf", ".txt", ".bag", ".mcap", ".db3", ".g2o", ".csv", ".npz"):
        name = name.removesuffix(ending)
    return name or "log"


def settings_of(folder: Folder, section: str = "infer") -> Settings:
    """What the run in the folder was started with."""
    return {k: v for k, v in read_file(folder.config).items() if k == section} if folder.config.exists() else {}


def saved(folder: Folder) -> Run | None:
    """The run to go on with; None if it had not come to its first checkpoint."""
    from bayesmap.result import load

    if not folder.run.exists():
        folder.talk.say(f"{folder.run}: no run to resume; starting from the beginning")
        return None
    run = load(folder.run)
    folder.talk.say(f"resuming {folder.run} after {counted(run.posterior.sweep, 'sweep')}")
    return run


def read(talk: Talk, log: str, values: dict[str, Any]) -> LogReading:
    """Read a log by a command's settings, and say what is in it."""
    from bayesmap.io.logs import describe_log

    reading = describe_log(log, max_range_m=values["max_range"], **options_of(values))
    scans, counts = reading.scans, reading.scans.counts()
    code = reading.no_return_m
    coded = "no code for no return" if code is None else f"{code:g} m is no return ({reading.no_return.origin})"
    talk.say(
        f"{log}: {len(scans):,} scans, {scans.n_beams:,} beams, "
        f"{counts['hit']:,} hits up to {scans.max_range_m:g} m; {coded}"
    )
    if counts["hit"] == 0:
        talk.warn(f"{log}: no reading is a hit, so there is no wall to find; check --max-range and --no-return")
    for skip in reading.skipped[: 10 if not talk.verbose else None]:
        talk.say(f"{log}: {skip} left out: {skip.reason}")
    if len(reading.skipped) > 10 and not talk.verbose:
        talk.say(f"{log}: {len(reading.skipped) - 10:,} more left out; -v lists them")
    for note in reading.notes:
        talk.say(f"{log}: {note}")
    return reading


def _split(scans: Scans, every: int) -> tuple[Scans, Scans | None]:
    return scans.holdout(every) if every else (scans, None)


def _infer(
    folder: Folder,
    scans: Scans,
    train: Scans,
    values: dict[str, Any],
    sensor: SensorModel | str | None,
    saved: Run | None,
) -> Run:
    from bayesmap.api import Event, infer
    from bayesmap.io.map_server import read_map
    from bayesmap.space.grid import Grid

    if values["grid"] is None:
        # It holds the held-out scans too: the map shall be the same, and have a cell for each reading to score.
        grid = Grid.covering(scans, values["resolution"])
    else:
        _, grid = read_map(values["grid"])
    folder.talk.say(f"grid: {grid.shape[0]} x {grid.shape[1]} cells of {grid.resolution:g} m")
    values = {**values, "draws": cells.draws_for(values, train.n_beams, grid.n_cells)}
    toml = as_toml({"infer": values})
    with progress(folder.talk, "tracing beams") as tell:

        def on_progress(event: Event) -> None:
            if event.stage not in SETTING_UP:
                folder.begin(toml)
            tell(event)

        def on_checkpoint(run: Run) -> None:
            folder.begin(toml)  # a short warm-up may be over before anything was told of it
            folder.checkpoint(run, lambda done, total: tell(Event("save", done, total)))

        run = infer(
            train,
            grid,
            prior=cells.prior_of(values),
            sensor=cells.sensor_for(values, sensor, grid.resolution),  # type: ignore[arg-type]
            resume=saved,
            on_progress=on_progress,
            on_checkpoint=on_checkpoint,
            checkpoint_every_s=values["checkpoint_every"],
            **{name: values[name] for name in PASSED_ON},
        )
    folder.begin(toml)
    return run


def leave(folder: Folder, run: Run, reading: LogReading, go_on: str) -> NoReturn:
    """Interrupted: keep the chains so far, say how to go on, and go."""
    kept: list[Path] = []
    # Chains that were stopped before their first sweep may have half a warm start: better none than that.
    if run.posterior.sweep > 0:
        with stage(folder.talk, "save") as tell:
            run.save(folder.run, tell)
        kept = [folder.run]
        done = counted(run.posterior.sweep, "sweep")
        folder.talk.say(f"interrupted after {done}, saved in {folder.run}; go on with:\n  {go_on}")
    elif folder.resuming and folder.run.exists():
        folder.talk.say(f"interrupted before the first sweep; {folder.run} is as it was; go on with:\n  {go_on}")
    else:
        folder.talk.say(f"interrupted before there was anything to save; start again with:\n  {go_on}")
    folder.talk.result(document_of(run, reading, None, kept), kept)
    click.get_current_context().exit(INTERRUPTED)


def _score(talk: Talk, run: Run, heldout: Scans | None, every: int) -> dict[str, Any] | None:
    if heldout is None:
        return None
    valid = heldout.n_beams - heldout.counts()["invalid"]
    with stage(talk, "score") as tell:
        nats = run.log_score(heldout, on_progress=tell)
    return {"every": every, "beams": valid, "nats_per_beam": nats}


def document_of(run: Run, reading: LogReading, score: dict[str, Any] | None, outputs: list[Path]) -> dict[str, Any]:
    """The JSON document of a run and its log."""
    from bayesmap.cli.document import run_document

    return {
        **run_document(run),
        "heldout": score,
        "log": reading.summary(),
        "outputs": {path.name: str(path) for path in outputs},
    }


def report(talk: Talk, document: dict[str, Any]) -> None:
    """Say what the JSON document holds."""
    from bayesmap.cli.document import work_done

    seconds, joint = document["seconds"], document["log_joint"]
    talk.say(
        f"{document['method']}: {work_done(document)} over {document['incidences']:,} incidences "
        f"in {seconds['total']:.1f} s"
    )
    if joint["mean"] is not None:
        talk.say(f"log joint {joint['mean']:,.1f} on average, {joint['last']:,.1f} at the end")
    if document["heldout"]:
        score = document["heldout"]
        talk.say(f"held out: {score['nats_per_beam']:.4f} nats per beam over {score['beams']:,} beams")
    for problem in document["problems"]:
        talk.warn(problem)


command.help = (command.help or "").format(sensors=sensors.HELP)
