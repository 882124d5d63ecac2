"""What is done with one log, step by step: read it, infer, leave a folder behind."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click

from bayesmap.cli import cells
from bayesmap.cli.command import INTERRUPTED
from bayesmap.cli.console import Console, counted
from bayesmap.cli.folder import Folder
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

PASSED_ON = (
    "method", "order", "chains", "warmup", "draws", "thin", "seed", "start", "particles", "rounds", "hit_depth",
    "threads", "device",
)  # fmt: skip
"""Settings that `bayesmap.infer` has under the same name."""

FLEET_SETTINGS = "fleet.toml"
"""In the folder of several runs' folders: what the last fleet there was started with."""

DEFAULTS = {key.name: key.default for key in SECTIONS["infer"]}


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


def saved(folder: Folder) -> Run | None:
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


def split(scans: Scans, every: int) -> tuple[Scans, Scans | None]:
    """Scans to infer from, and those that are held out."""
    return scans.holdout(every) if every else (scans, None)


def sample(
    folder: Folder,
    scans: Scans,
    train: Scans,
    values: dict[str, Any],
    sensor: SensorModel | str | None,
    saved: Run | None,
    executor: Executor | None = None,
    on_saved: Callable[[], None] = lambda: None,
    on_event: Callable[[Event], None] = lambda event: None,
) -> Run:
    """Infer from the scans that are not held out, with checkpoints in the folder.

    Args:
        folder: of the run.
        scans: all of the log.
        train: those that are not held out.
        values: the command's settings.
        sensor: as `bayesmap.infer` takes it; None for the default of the cells.
        saved: the run to go on with.
        executor: where chains run.
        on_saved: called after each checkpoint.
        on_event: called with how far it is, as the bar is.
    """
    from bayesmap.api import Event, infer
    from bayesmap.io.ros.maps import read_map
    from bayesmap.space.grid import Grid

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
            sensor=cells.sensor_for(values, sensor, grid.resolution),  # type: ignore[arg-type]
            resume=saved,
            on_progress=on_progress,
            on_checkpoint=on_checkpoint,
            checkpoint_every_s=values["checkpoint_every"],
            executor=executor,
            **{name: values[name] for name in PASSED_ON},
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


def leave(folder: Folder, run: Run, reading: LogReading, go_on: str) -> NoReturn:
    """Interrupted: keep the chains so far, say how to go on, and go."""
    kept: list[Path] = []
    # Chains that were stopped before their first sweep may have half a warm start: better none than that.
    if run.posterior.sweep > 0:
        with stage(folder.console, "save") as report:
            folder.save(run, report)
        kept = [folder.run]
        done = counted(run.posterior.sweep, "sweep")
        folder.console.say(f"interrupted after {done}, saved in {folder.run}; go on with:\n  {go_on}")
    elif folder.resuming and folder.run.exists():
        folder.console.say(f"interrupted before the first sweep; {folder.run} is as it was; go on with:\n  {go_on}")
    elif folder.run.exists() and not folder.begun:
        folder.console.say(f"interrupted before there was anything to save; {folder.run} is as it was")
    else:
        folder.console.say(f"interrupted before there was anything to save; start again with:\n  {go_on}")
    folder.console.result(document_of(run, reading, None, kept), kept)
    click.get_current_context().exit(INTERRUPTED)


def finish(folder: Folder, run: Run, reading: LogReading, heldout: Scans | None, every: int) -> dict[str, Any]:
    """Save a finished run, draw and score it, and keep its JSON document, which is returned."""
    outputs = folder.write_products(run)
    score = score_of(folder.console, run, heldout, every)
    with progress(folder.console, "comparing the chains"):
        document = document_of(run, reading, score, [*outputs, folder.path / "summary.json", folder.config])
    folder.write_document(document)
    return document
