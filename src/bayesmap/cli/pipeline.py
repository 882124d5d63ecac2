"""The steps of ``bayesmap infer`` for one log, several of which ``bayesmap slam`` shares.

`prepare` checks the arguments and makes a `Task`. `infer_log` is the pipeline. Its steps follow in their order: read
a log, load the run to resume, sample with checkpoints, report, finish. The estimates of time and memory come last.
"""

from __future__ import annotations

import os
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from bayesmap.cli import translation
from bayesmap.cli.command import Call, Layer, as_toml, read_file
from bayesmap.cli.console import SETTING_UP, Console, counted, exit_unless_good, progress_bar, stage_bar
from bayesmap.cli.folder import Folder, run_document, work_done
from bayesmap.cli.keys import InferSettings, SamplingSettings, SlamSettings
from bayesmap.cli.translation import LOG, need_file
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bayesmap.api import Event
    from bayesmap.io.log_reading import ScanLog
    from bayesmap.result import Run
    from bayesmap.run.cost import Estimate
    from bayesmap.run.runner import Executor
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans


S = TypeVar("S", bound=SamplingSettings)


@dataclass(frozen=True, eq=False)
class Task(Generic[S]):
    """One log that is to be inferred."""

    log: str  # path of the log, as typed
    folder: Folder  # folder of its run
    settings: S  # settings of the command


def prepare(call: Call[S], log: str, path: Path, *, resume: bool, force: bool, earlier: Layer | None = None) -> Task[S]:
    """Return the task of one log, after checking the arguments. A fleet resumes its ``earlier`` settings."""
    need_file(log, f"{LOG} (bayesmap info FILE says what is in one)", runs=False)
    folder = Folder(path, call.console, resuming=resume)
    # Resume the settings of the run in the folder, or of the run that replaces it.
    config = folder.outdated_path if folder.outdated_path.exists() else folder.config_path
    resumed = (settings_in(config, call.section) or earlier) if resume else None
    settings = translation.completed(call.settings(resumed))
    folder.check(force=force)
    return Task(log, folder, settings)


def infer_log(
    task: Task[InferSettings], *, log: ScanLog | None = None, executor: Executor | None = None,
    resume_command: str | None = None, on_saved: Callable[[], None] = lambda: None,
    on_event: Callable[[Event], None] = lambda event: None,
) -> dict[str, Any]:  # fmt: skip
    """Infer one log into its folder, print a report, and return the JSON document.

    ``log`` is given if it was read already. ``executor`` runs the chains; None: this process. After Ctrl-C the command
    ``resume_command`` is printed. ``on_saved`` is called after each checkpoint, ``on_event`` with the progress.
    """
    folder, every = task.folder, task.settings.holdout  # every n-th scan is held out; 0: none
    if log is None:
        log = read_scan_log(folder.console, task.log, task.settings)
    if not (task.settings.poses_as_given or folder.resuming):
        refuse_odometry(task.log, log)
    train, heldout = log.scans.holdout(every) if every else (log.scans, None)
    saved = load_interrupted(folder) if folder.resuming else None
    # Sample the posterior, with checkpoints.
    run = sample(task, log.scans, train, saved, executor, on_saved, on_event)
    # After Ctrl-C: leave the folder so that the run can go on.
    if not run.finished:
        return keep_interrupted(folder, run, log, resume_command)
    # Finish: save the run, render it, export it, score it.
    document = finish(folder, run, log, heldout, every)
    # Report, and name commands to give next.
    file = str(folder.run_path)
    second = ["score", file, task.log, "--holdout", str(every)] if every else ["explore", file]
    print_report(folder.console, document, commands=[["app", file], second, ["render", file]] if resume_command else ())
    return document


def log_stem(log: str) -> str:
    """Return the name of a log without its folder and its endings."""
    name = os.path.basename(os.path.normpath(log))
    for ending in (".gz", ".log", ".clf", ".txt", ".bag", ".mcap", ".db3", ".g2o", ".csv", ".npz", ".rawlog"):
        name = name.removesuffix(ending)
    return name or "log"


def settings_in(config: Path, section: str) -> Layer:
    """Return a command's settings from a file; empty if there is no file."""
    layer = read_file(config) if config.exists() else {}
    return {section: layer[section]} if section in layer else {}


def load_interrupted(folder: Folder) -> Run | None:
    """Load the run to resume; None if it was stopped before its first checkpoint."""
    from bayesmap.result import load

    if not folder.run_path.exists():
        folder.console.say(f"{folder.run_path}: not there yet, as no sweep was saved; the chains start anew")
        return None
    run = load(folder.run_path)
    folder.console.say(f"resuming {folder.run_path} after {counted(run.posterior.sweep, 'sweep')}")
    return run


def read_scan_log(console: Console, path: str, settings: SamplingSettings, *, without_poses: bool = False) -> ScanLog:
    """Read a log, and print a summary of it."""
    from bayesmap.io.logs import describe_log

    options = translation.log_options_of(settings)
    log = describe_log(path, max_range_m=settings.max_range, without_poses=without_poses, **options)
    scans, n_hits, code_m = log.scans, log.scans.counts()["hit"], log.no_return.code_m
    number = "" if code_m is None else f" ({code_m:g} m, {log.no_return.origin})"
    size = f"{len(scans):,} scans, {scans.n_beams:,} beams, {n_hits:,} hits up to {scans.max_range_m:g} m"
    console.say(f"{path}: {size}, {scans.counts()['no_return']:,} no return{number}")
    if n_hits == 0:
        console.warn(f"{path}: no reading is a hit, so there is no wall to find; check --max-range and --no-return")
    listed = log.skipped if console.verbose else log.skipped[:10]
    for skip in listed:
        console.say(f"{path}: {skip} left out: {skip.reason}")
    if len(log.skipped) > len(listed):
        console.say(f"{path}: {len(log.skipped) - len(listed):,} more left out; -v lists them")
    for note in log.notes:
        console.say(f"{path}: {note}")
    return log


def refuse_odometry(path: str, log: ScanLog) -> None:
    """Raise `BadInput` if walls appear in several places, as with poses of raw odometry, or with yaw in degrees."""
    from bayesmap.io.logs import DEGREES_QUESTION
    from bayesmap.poses.log_checks import DOUBLED, look_like_odometry

    if not look_like_odometry(log.scans):
        return
    for note in log.notes:
        if note.endswith(DEGREES_QUESTION):
            raise BadInput(f"{path}: {note} Convert it to radians; --poses-as-given takes the poses as they are")
    remedy = f"`bayesmap slam {path}` infers the trajectory, too (bayesmap info says more)"
    override = "To take the poses as they are, add --poses-as-given"
    raise BadInput(f"{path}: {DOUBLED}, as with raw odometry; {remedy}. {override}")


def sample(
    task: Task[InferSettings], scans: Scans, train: Scans, saved: Run | None, executor: Executor | None,
    on_saved: Callable[[], None], on_event: Callable[[Event], None],
) -> Run:  # fmt: skip
    """Infer from the training scans, or go on with ``saved``, with checkpoints. The grid covers all ``scans``."""
    from bayesmap.api import Event, infer
    from bayesmap.arguments import Checkpoints, Where
    from bayesmap.io.ros.maps import read_map
    from bayesmap.space.grid import Grid

    folder, settings = task.folder, task.settings
    if saved is not None and settings.grid is not None and not os.path.exists(settings.grid):
        grid = saved.grid  # the map of --grid is gone, or its path belongs to another machine
    elif settings.grid is None:
        # Held-out scans count too: the map must not depend on the split, and needs a cell for each scored reading.
        grid = Grid.covering(scans, settings.resolution)
    else:
        _, grid = read_map(settings.grid)
    folder.console.say(f"grid: {grid.shape[0]} x {grid.shape[1]} cells of {grid.resolution:g} m")
    settings = translation.with_schedule(settings, train.n_beams, grid.n_cells)
    toml = as_toml({"infer": settings})
    if saved is None:
        announce(folder.console, cost_of_infer(settings, train, grid, executor))
    with progress_bar(folder.console, "tracing beams") as show:

        def on_progress(event: Event) -> None:
            if event.stage not in SETTING_UP:
                folder.begin(toml)
            show(event)
            on_event(event)

        def on_checkpoint(run: Run) -> None:
            folder.begin(toml)  # a short warm-up may end before the first event
            folder.checkpoint(run, lambda done, total: show(Event("save", done, total)))
            on_saved()

        run = infer(
            train, grid, prior=translation.prior_of(settings), sensor=translation.sensor_for(settings, grid.resolution),
            method=translation.method_of(settings), schedule=translation.schedule_of(settings), seed=settings.seed,
            hit_depth=settings.hit_depth or 0.0, on_progress=on_progress,
            where=Where(settings.threads, settings.device, executor, settings.any_size),
            checkpoints=Checkpoints(saved, on_checkpoint, settings.checkpoint_every, preview=folder.preview),
        )  # fmt: skip
    if run.finished or run.posterior.sweep > 0 or not folder.run_path.exists():
        folder.begin(toml)  # otherwise no sweep is done, and an older run keeps its place
    return run


def document_of(run: Run, log: ScanLog, score: dict[str, Any] | None, outputs: list[Path]) -> dict[str, Any]:
    """Return the JSON document of a run, with its log, its score on held-out scans, and the paths of its files."""
    names = {path.name: str(path) for path in outputs}
    return {**run_document(run), "heldout": score, "log": log.summary(), "outputs": names}


def print_report(
    console: Console, document: dict[str, Any], *, good: Sequence[str] = (), doubtful: Sequence[str] = (),
    commands: Sequence[Sequence[str]] = (),
) -> None:  # fmt: skip
    """Print the work of a run, sentences about what is good or doubtful, and commands to give next."""
    seconds, joint, score = document["seconds"], document["log_joint"], document["heldout"]
    mean = "" if joint["mean"] is None else f"; log joint {joint['mean']:,.1f} on average"
    work = f"{work_done(document)} over {document['incidences']:,} incidences in {seconds['total']:.1f} s"
    console.say(f"{document['method']}: {work}{mean}")
    heldout = [f"held out: {score['nats_per_beam']:.4f} nats per beam over {score['beams']:,} beams"] if score else []
    for text in [*good, *document["good"], *heldout]:
        console.say(f"good: {text}")
    for text in [*doubtful, *document["problems"]]:
        console.warn(text)
    if commands:
        console.say("next:\n" + "\n".join(f"  {shlex.join(['bayesmap', *words])}" for words in commands))


def keep_interrupted(
    folder: Folder, run: Run, log: ScanLog, resume_command: str | None, complete: Sequence[Path] = ()
) -> dict[str, Any]:
    """Save an interrupted run, print how to resume it, and return its document. ``complete`` are finished files."""
    outputs = [*folder.first_map, folder.config_path] if folder.first_map else []
    go_on = f"; go on with:\n  {resume_command}"
    # Chains stopped before their first sweep may have an incomplete start, so they are not saved.
    if run.posterior.sweep > 0:
        outputs += [*folder.write_products(run), folder.config_path]
        state = f"after {counted(run.posterior.sweep, 'sweep')}, saved in {folder.run_path}{go_on}"
    elif folder.resuming and folder.run_path.exists():
        state = f"before the first sweep; {folder.run_path} is as it was{go_on}"
    elif folder.run_path.exists() and not folder.begun:
        state = f"before there was anything to save; {folder.run_path} is as it was"
    elif complete:
        state = f"before the first sweep; {complete[0]} is complete{go_on}"
    else:
        state = f"before there was anything to save; start again with:\n  {resume_command}"
    if resume_command is not None:
        folder.console.say(f"interrupted {state}")
    return document_of(run, log, None, outputs)


def print_result(call: Call[Any], document: dict[str, Any], *, strict: bool) -> None:
    """Print the result. Exit with 130 if the run was interrupted, or with 4 if it is strict and has problems."""
    call.console.result(document, document["outputs"].values())
    exit_unless_good(finished=document["finished"], problems=strict and bool(document["problems"]))


def finish(folder: Folder, run: Run, log: ScanLog, heldout: Scans | None, every: int) -> dict[str, Any]:
    """Save, render and score a finished run on each ``every``-th scan, and write and return its JSON document."""
    outputs, score = folder.write_products(run), None
    if heldout is not None:
        with stage_bar(folder.console, "score") as on_progress:
            nats = run.log_score(heldout, on_progress=on_progress)
        score = {"every": every, "beams": heldout.n_beams - heldout.counts()["invalid"], "nats_per_beam": nats}
    with progress_bar(folder.console, "comparing the chains"):
        document = document_of(run, log, score, [*outputs, folder.path / "summary.json", folder.config_path])
    folder.write_document(document)
    return document


def cost_of_infer(
    settings: InferSettings, scans: Scans, grid: Grid | None = None, executor: Executor | None = None
) -> Estimate | None:
    """Estimate the cost of `infer`; None if it is not known."""
    from bayesmap.api import ChosenLaws, Inference
    from bayesmap.arguments import Where
    from bayesmap.space.grid import Grid

    grid = Grid.covering(scans, settings.resolution) if grid is None else grid
    prior, sensor = translation.prior_of(settings), translation.sensor_for(settings, grid.resolution)
    inference = Inference.of(
        scans, grid, ChosenLaws(prior, sensor, None, settings.hit_depth or 0.0), translation.method_of(settings),
        translation.schedule_of(settings), settings.seed, Where(settings.threads, settings.device, executor),
    )  # fmt: skip
    return inference.estimate()


def cost_of_slam(settings: SlamSettings, scans: Scans) -> Estimate | None:
    """Estimate the cost of `slam` from the poses of the log; None if it is not known."""
    from bayesmap.api import ChosenLaws, estimate_slam
    from bayesmap.arguments import Where

    laws = ChosenLaws(translation.prior_of(settings), translation.sensor_for(settings, settings.resolution))
    return estimate_slam(
        scans, settings.resolution, laws, translation.fast_of(settings), settings.no_odometry,
        translation.schedule_of(settings), Where(settings.threads, settings.device),
    )  # fmt: skip


def announce(console: Console, estimate: Estimate | None) -> None:
    """Print the estimate if the run is long or large."""
    if estimate is not None and (estimate.is_long or estimate.is_large):
        console.say(f"this takes {estimate.words()}")


def cost_of_suggestion(suggestion: str | None, scans: Scans | None) -> dict[str, Any] | None:
    """Return the cost of a suggested command as JSON values; None if it is not known."""
    if suggestion is None or scans is None:
        return None
    slam = SlamSettings(no_odometry="--no-odometry" in suggestion.split())
    try:
        is_slam = suggestion.startswith("bayesmap slam")
        cost = cost_of_slam(slam, scans) if is_slam else cost_of_infer(InferSettings(), scans)
    except BadInput:  # the command itself says why
        return None
    if cost is None:
        return None
    return {
        "seconds": cost.seconds, "cores": cost.cores, "words": cost.words(), "memory_bytes": cost.peak_bytes,
        "available_bytes": cost.available_bytes, "fits": not cost.is_too_large, "remedy": cost.remedy or None,
    }  # fmt: skip
