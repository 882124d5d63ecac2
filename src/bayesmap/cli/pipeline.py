"""One log from its file to the folder of its run: read, split, take up, sample, leave or finish, report."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bayesmap.cli import cells, sensors
from bayesmap.cli.command import Call
from bayesmap.cli.console import Console, counted
from bayesmap.cli.folder import Folder
from bayesmap.cli.input_files import LOG, need_file
from bayesmap.cli.keys import SECTIONS
from bayesmap.cli.progress import SETTING_UP, progress, stage
from bayesmap.cli.reading import options_of
from bayesmap.cli.settings import Settings, as_toml, read_file

if TYPE_CHECKING:
    from collections.abc import Callable

    from bayesmap.api import Event
    from bayesmap.io.log_reading import LogReading
    from bayesmap.result import Run
    from bayesmap.run.executor import Executor
    from bayesmap.sensors.model import SensorModel
    from bayesmap.space.scans import Scans

DEFAULTS = {key.name: key.default for key in SECTIONS["infer"]}


@dataclass(frozen=True, eq=False)
class Task:
    """One log that is to be inferred.

    Attributes:
        log: as typed.
        folder: of its run.
        values: the command's settings.
        sensor: as `bayesmap.infer` takes it; None for the default of the cells.
    """

    log: str
    folder: Folder
    values: dict[str, Any]
    sensor: SensorModel | str | None


def prepare(
    call: Call,
    log: str,
    path: Path,
    *,
    resume: bool,
    force: bool,
    section: str = "infer",
    begun: Settings | None = None,
) -> Task:
    """Check what was typed for one log, before anything is read or written.

    Args:
        call: of the command.
        log: as typed.
        path: folder of the run.
        resume: go on with the run in the folder.
        force: replace it.
        section: the command.
        begun: settings to resume with where the folder has none.

    Raises:
        BadInput: no such log, settings that do not fit together, or a folder that may not be written.
    """
    need_file(log, f"{LOG} (bayesmap info FILE says what is in one)", runs=False)
    folder = Folder(path, call.console, resuming=resume)
    under = (settings_of(folder, section) or begun) if resume else None
    values = cells.with_defaults({**DEFAULTS, **call.values(under)})
    sensor = "fit" if values["sensor"] == "fit" else sensors.sensor_of(values["sensor"])
    folder.check(force=force)
    return Task(log, folder, values, sensor)


def infer_log(
    task: Task,
    *,
    reading: LogReading | None = None,
    executor: Executor | None = None,
    go_on: str | None = None,
    on_saved: Callable[[], None] = lambda: None,
    on_event: Callable[[Event], None] = lambda event: None,
) -> dict[str, Any]:
    """Infer one log into its folder, and say what came out.

    Args:
        task: the log, its folder and settings.
        reading: the log, if it has been read already.
        executor: where chains run.
        go_on: the command that goes on with the run, to be said after Ctrl-C.
        on_saved: called after each checkpoint.
        on_event: called with how far the run is, as the bar is.

    Returns:
        The JSON document of the run. After Ctrl-C its "finished" is false.
    """
    folder, values = task.folder, task.values
    # Read the log.
    if reading is None:
        reading = read(folder.console, task.log, values)
    # Split off the scans that are held out.
    train, heldout = reading.scans.holdout(values["holdout"]) if values["holdout"] else (reading.scans, None)
    # Take up the run that is in the folder.
    saved = taken_up(folder) if folder.resuming else None
    # Sample the posterior, with checkpoints.
    run = sample(task, reading.scans, train, saved, executor, on_saved, on_event)
    # After Ctrl-C: leave the folder so that the run can go on.
    if not run.finished:
        return leave(folder, run, reading, go_on)
    # Finish: save the run, draw it, export it, score it.
    document = finish(folder, run, reading, heldout, values["holdout"])
    # Report.
    report(folder.console, document)
    return document


def names_of(section: str) -> list[str]:
    """Names of a command's settings."""
    return [key.name for key in SECTIONS[section]]


def stem(log: str) -> str:
    """The name of a log without its folder and its endings."""
    name = os.path.basename(os.path.normpath(log))
    for ending in (".gz", ".log", ".clf", ".txt", ".bag", ".mcap", ".db3", ".g2o", ".csv", ".npz", ".rawlog"):
        name = name.removesuffix(ending)
    return name or "log"


def settings_of(folder: Folder, section: str = "infer") -> Settings:
    """What the run in the folder was started with, or the one that is to replace it; nothing if there is neither."""
    return settings_in(folder.outdated if folder.outdated.exists() else folder.config, section)


def settings_in(config: Path, section: str = "infer") -> Settings:
    """A command's settings in a file; none if there is no file."""
    return {k: v for k, v in read_file(config).items() if k == section} if config.exists() else {}


def taken_up(folder: Folder) -> Run | None:
    """The run to go on with; None if it had not come to its first checkpoint."""
    from bayesmap.result import load

    if not folder.run.exists():
        folder.console.say(f"{folder.run}: no run to resume; starting from the beginning")
        return None
    run = load(folder.run)
    folder.console.say(f"resuming {folder.run} after {counted(run.posterior.sweep, 'sweep')}")
    return run


def read(console: Console, log: str, values: dict[str, Any]) -> LogReading:
    """Read a log, and say what is in it."""
    from bayesmap.io.logs import describe_log

    how = {**options_of(values), "without_poses": values.get("no_odometry", False)}
    reading = describe_log(log, max_range_m=values["max_range"], **how)
    scans, counts = reading.scans, reading.scans.counts()
    code = reading.no_return_m
    coded = "no code for no return" if code is None else f"{code:g} m is no return ({reading.no_return.origin})"
    console.say(
        f"{log}: {len(scans):,} scans, {scans.n_beams:,} beams, "
        f"{counts['hit']:,} hits up to {scans.max_range_m:g} m; {coded}"
    )
    if counts["hit"] == 0:
        console.warn(f"{log}: no reading is a hit, so there is no wall to find; check --max-range and --no-return")
    for skip in reading.skipped[: 10 if not console.verbose else None]:
        console.say(f"{log}: {skip} left out: {skip.reason}")
    if len(reading.skipped) > 10 and not console.verbose:
        console.say(f"{log}: {len(reading.skipped) - 10:,} more left out; -v lists them")
    for note in reading.notes:
        console.say(f"{log}: {note}")
    return reading


def sample(
    task: Task,
    scans: Scans,
    train: Scans,
    saved: Run | None,
    executor: Executor | None,
    on_saved: Callable[[], None],
    on_event: Callable[[Event], None],
) -> Run:
    """Infer from the scans that are not held out, with checkpoints in the folder.

    Args:
        task: the log, its folder and settings.
        scans: all of the log.
        train: those that are not held out.
        saved: the run to go on with.
        executor: where chains run.
        on_saved: called after each checkpoint.
        on_event: called with how far the run is.
    """
    from bayesmap.api import Event, infer
    from bayesmap.arguments import Checkpoints, Schedule, Where
    from bayesmap.io.ros.map_server import read_map
    from bayesmap.space.grid import Grid

    folder, values = task.folder, task.values
    if saved is not None and values["grid"] is not None and not os.path.exists(values["grid"]):
        grid = saved.grid  # the map that named the cells has gone, or the path was one from elsewhere
    elif values["grid"] is None:
        # It holds the held-out scans too: the map shall be the same, and have a cell for each reading to score.
        grid = Grid.covering(scans, values["resolution"])
    else:
        _, grid = read_map(values["grid"])
    folder.console.say(f"grid: {grid.shape[0]} x {grid.shape[1]} cells of {grid.resolution:g} m")
    values = {**values, "thin": cells.sweeps_a_draw(values)}
    values = {**values, "draws": cells.draws_for(values, train.n_beams, grid.n_cells)}
    toml = as_toml({"infer": values})
    with progress(folder.console, "tracing beams") as report:

        def on_progress(event: Event) -> None:
            if event.stage not in SETTING_UP:
                folder.begin(toml)
            report(event)
            on_event(event)

        def on_checkpoint(run: Run) -> None:
            folder.begin(toml)  # a short warm-up may be over before anything was reported
            folder.checkpoint(run, lambda done, total: report(Event("save", done, total)))
            on_saved()

        run = infer(
            train,
            grid,
            prior=cells.prior_of(values),
            sensor=cells.sensor_for(values, task.sensor, grid.resolution),  # type: ignore[arg-type]
            method=cells.method_of(values),
            schedule=Schedule(values["chains"], values["warmup"], values["draws"], values["thin"]),
            seed=values["seed"],
            hit_depth=values["hit_depth"],
            where=Where(values["threads"], values["device"], executor),
            checkpoints=Checkpoints(saved, on_checkpoint, values["checkpoint_every"]),
            on_progress=on_progress,
        )
    if run.finished or run.posterior.sweep > 0 or not folder.run.exists():
        folder.begin(toml)  # else there is nothing that could take an older run's place
    return run


def score_of(console: Console, run: Run, heldout: Scans | None, every: int) -> dict[str, Any] | None:
    """The score of the scans that were held out."""
    if heldout is None:
        return None
    valid = heldout.n_beams - heldout.counts()["invalid"]
    with stage(console, "score") as report:
        nats = run.log_score(heldout, on_progress=report)
    return {"every": every, "beams": valid, "nats_per_beam": nats}


def document_of(run: Run, reading: LogReading, score: dict[str, Any] | None, outputs: list[Path]) -> dict[str, Any]:
    """The JSON document of a run."""
    from bayesmap.cli.document import run_document

    return {
        **run_document(run),
        "heldout": score,
        "log": reading.summary(),
        "outputs": {path.name: str(path) for path in outputs},
    }


def report(console: Console, document: dict[str, Any]) -> None:
    """Say what came out."""
    from bayesmap.cli.document import work_done

    seconds, joint = document["seconds"], document["log_joint"]
    console.say(
        f"{document['method']}: {work_done(document)} over {document['incidences']:,} incidences "
        f"in {seconds['total']:.1f} s"
    )
    if joint["mean"] is not None:
        console.say(f"log joint {joint['mean']:,.1f} on average, {joint['last']:,.1f} at the end")
    if document["heldout"]:
        score = document["heldout"]
        console.say(f"held out: {score['nats_per_beam']:.4f} nats per beam over {score['beams']:,} beams")
    for problem in document["problems"]:
        console.warn(problem)


def leave(folder: Folder, run: Run, reading: LogReading, go_on: str | None) -> dict[str, Any]:
    """Keep the chains of an interrupted run, and say how to go on with them; returns the document of what is kept."""
    kept: list[Path] = []
    # Chains that were stopped before their first sweep may have half a warm start: better none than that.
    if run.posterior.sweep > 0:
        with stage(folder.console, "save") as report:
            folder.save(run, report)
        kept = [folder.run]
        done = counted(run.posterior.sweep, "sweep")
        said = f"interrupted after {done}, saved in {folder.run}; go on with:\n  {go_on}"
    elif folder.resuming and folder.run.exists():
        said = f"interrupted before the first sweep; {folder.run} is as it was; go on with:\n  {go_on}"
    elif folder.run.exists() and not folder.begun:
        said = f"interrupted before there was anything to save; {folder.run} is as it was"
    else:
        said = f"interrupted before there was anything to save; start again with:\n  {go_on}"
    if go_on is not None:
        folder.console.say(said)
    return document_of(run, reading, None, kept)


def finish(folder: Folder, run: Run, reading: LogReading, heldout: Scans | None, every: int) -> dict[str, Any]:
    """Save a finished run, draw and score it, and keep its JSON document, which is returned."""
    outputs = folder.write_products(run)
    score = score_of(folder.console, run, heldout, every)
    with progress(folder.console, "comparing the chains"):
        document = document_of(run, reading, score, [*outputs, folder.path / "summary.json", folder.config])
    folder.write_document(document)
    return document
