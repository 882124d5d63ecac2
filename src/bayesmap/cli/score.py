"""``bayesmap score``: how well do maps predict unseen beams, how good are poses, and how honest are both?"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import Call, takes
from bayesmap.cli.console import write_out
from bayesmap.cli.progress import progress, share
from bayesmap.cli.reading import heldout_scans, options_of
from bayesmap.cli.score_others import infer_map, is_map, placed_scans, score_map, verdict
from bayesmap.cli.score_poses import FRAMES, check_frames, lines_of, score_poses
from bayesmap.errors import BadInput
from bayesmap.version import __version__

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.posterior.baselines import Fitted
    from bayesmap.posterior.scores import Score
    from bayesmap.posterior.trajectory_scores import TrajectoryScore
    from bayesmap.result import Run
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans
    from bayesmap.space.trajectory import Trajectory

HEADINGS = ("map", "nats/beam", "50 %", "80 %", "95 %", "80 % width", "PIT", "Brier", "log loss")


@takes("score")
@click.argument("run_file", metavar="RUN.nc|MAP.yaml|LOG")
@click.argument("log", required=False)
@click.option("--all", "whole", is_flag=True, help="Score all scans of LOG, another recording of the same place.")
@click.option("--compare", is_flag=True, help="Also hit ratios and log-odds, fitted on the same scans.")
@click.option("--trajectory", metavar="FILE.tum", help="Where the laser was, by another program.")
@click.option("--relations", metavar="FILE", help="True relative poses (Kuemmerle et al. 2009) to hold poses against.")
@click.option(
    "--frame", type=click.Choice(FRAMES), help="Whose relations are known. [default: base, if LOG says where]"
)
@click.option("--exact", is_flag=True, help="Only relations at times of poses; else also between close ones.")
@click.option("--trajectory-frame", type=click.Choice(FRAMES), default="laser", show_default=True, help="Of FILE.tum.")
@click.option("--laser", metavar="X,Y,DEGREES", help="Where the laser sits on the robot. [default: as LOG says]")
@click.option("--picture", metavar="FILE", help="Draw calibration and errors: .png, .pdf or .svg.")
def command(
    call: Call,
    run_file: str,
    log: str | None,
    whole: bool,
    compare: bool,
    trajectory: str | None,
    relations: str | None,
    frame: str | None,
    exact: bool,
    trajectory_frame: str,
    laser: str | None,
    picture: str | None,
) -> None:
    r"""Score a saved run, or another program's map or trajectory, on the scans of LOG that had no part in it.

    \b
    bayesmap infer office.log.gz --holdout 10 -o runs/office
    bayesmap score runs/office/run.nc office.log.gz --compare --picture calibration.png

    LOG is read as it was for the run: give the same --no-return, topics, --deskew and --thin-scans as to infer.

    Columns: mean log predictive density of a reading, with its standard error over scans; how many readings lie in
    their central 50, 80 and 95 % intervals; median width of the 80 % interval; distance of the probability integral
    transform from uniform; and Brier score and log loss of first hits. docs/scoring.md has the formulas.

    With --relations poses are scored, too (of a run alone LOG is not needed): errors of translation and rotation, and
    where covariances are known, how many true relations lie in their 50, 80 and 95 % regions, and NEES.

    \b
    bayesmap score runs/office/run.nc --relations office.relations
    bayesmap score theirs.yaml office.log.gz --trajectory theirs.tum --relations office.relations
    bayesmap score office.log.gz --trajectory theirs.tum

    A map of another program (map_server YAML) gets the sensor, and the meaning of occupied, free and unknown, that
    suit it best, fitted on all scans but every --holdout-th, which are scored. Without --trajectory LOG's own poses are
    taken; without a map one is inferred from the trajectory.
    """
    values = {**call.values(), "laser": laser}
    frames = check_frames(frame, laser, relations)
    if picture is not None:
        from bayesmap.files import need_ending

        need_ending(picture, ("png", "pdf", "svg"), "figure")  # before the minutes of work
    own_log = log if _is_run(run_file) or is_map(run_file) else run_file
    wanted = relations is not None or trajectory_frame == "base"
    mount = frames.mount(own_log, options_of(values)) if wanted else None
    shift = frames.base_in_laser(mount)
    if _is_run(run_file):
        if trajectory is not None:
            raise click.UsageError("--trajectory goes with a map or a log; a run has poses of its own")
        found = _score_run(call, run_file, log, values, whole=whole, compare=compare, poses_too=relations is not None)
        if log is None and relations is None:
            raise click.UsageError("give LOG, whose held-out scans score the run, or --relations, or both")
    else:
        if trajectory_frame == "base" and mount is None:
            raise BadInput(
                "score: --trajectory-frame base needs to know where the laser sits: give --laser X,Y,DEGREES"
            )
        of_base = mount if trajectory_frame == "base" else None
        found = _score_others(call, run_file, log, values, trajectory, of_base, compare=compare)
    poses = None
    if relations is not None:
        poses = score_poses(found.trajectory, relations, shift, exact=exact)
    outputs: dict[str, str] = {}
    if picture is not None:
        outputs = {path.name: str(path) for path in _draw(picture, found.rows, poses)}
    of = "laser" if shift is None else "base"
    about = None if poses is None else {"file": relations, "frame": of, **poses.as_json()}
    if call.console.as_json:
        call.console.result(_document(run_file, log, found, about, outputs), [])
        return
    if found.verdict is not None:
        write_out(f"{found.verdict}\n")
    if found.rows:
        _print_table(found.rows)
    if poses is not None:
        write_out("".join(f"{line}\n" for line in lines_of(poses, of, exact=exact, of_run=_is_run(run_file))))


@dataclass(frozen=True, eq=False)
class _Found:
    """What was scored: rows of the table, fits of all but the first, every how many scans were held out, and poses.

    Of a map of another program also a verdict in words.
    """

    rows: list[tuple[str, Score]]
    fits: list[Fitted]
    every: int
    trajectory: Trajectory
    verdict: str | None = None


def _is_run(path: str) -> bool:
    from bayesmap.cli.info import is_saved_run

    return is_saved_run(path) or not (is_map(path) or Path(path).exists())


def _score_run(
    call: Call, path: str, log: str | None, values: dict[str, Any], *, whole: bool, compare: bool, poses_too: bool
) -> _Found:
    from bayesmap.io.exports import trajectory_of
    from bayesmap.posterior.heldout import NoneHeldOut
    from bayesmap.result import load, score

    run = load(path)
    there = trajectory_of(run, run.posterior.scans)
    if log is None:
        return _Found([], [], 0, there)
    every = 0 if whole else values["holdout"]
    if every == 0 and not whole:
        raise BadInput("score: --holdout 0 leaves nothing to score; give 2 or more, or --all for another recording")
    try:
        heldout = heldout_scans(run, log, values, every)
    except NoneHeldOut as error:
        if not poses_too:
            raise
        call.console.say(f"only the poses are scored, not the map: {error}")
        return _Found([], [], 0, there)
    call.console.say(f"scoring {len(heldout):,} scans of {log} that the run has not seen")
    with share(call.console, f"scoring the {_name(run)}") as report:
        rows = [(_name(run), score(run, heldout, **_how(values), on_progress=report))]
    fits: list[Fitted] = []
    if compare:
        for fit, found in _baselines(call, run.posterior.scans, run.grid, heldout, _how(values)):
            fits.append(fit)
            rows.append((fit.name, found))
    return _Found(rows, fits, every, there)


def _score_others(
    call: Call,
    path: str,
    log: str | None,
    values: dict[str, Any],
    trajectory: str | None,
    mount: NDArray[np.float64] | None,
    *,
    compare: bool,
) -> _Found:
    from bayesmap.result import score

    words = None
    if is_map(path):
        if log is None:
            raise click.UsageError(f"give the LOG whose scans score {path}")
        placed = placed_scans(log, values, trajectory, mount)
        call.console.say(f"scoring every {values['holdout']}-th scan of {log}: {len(placed.heldout):,}")
        fit, own = score_map(call, path, placed, _how(values))
        rows, grid = [(fit.name, own)], fit.predictor.grid
        words = verdict(fit.name, fit, own, placed)
    else:
        if log is not None:
            raise click.UsageError(f"{path}: neither a saved run (.nc) nor a map (.yaml)")
        if trajectory is None:
            raise click.UsageError(f"{path}: a log by itself; give --trajectory, or the run or map to score on it")
        placed = placed_scans(path, values, trajectory, mount)
        run = infer_map(call, placed, values)
        with share(call.console, f"scoring the {_name(run)}") as report:
            rows = [(_name(run), score(run, placed.heldout, **_how(values), on_progress=report))]
        grid = run.grid
    fits: list[Fitted] = []
    if compare:
        for fit, scored in _baselines(call, placed.train, grid, placed.heldout, _how(values)):
            fits.append(fit)
            rows.append((fit.name, scored))
    return _Found(rows, fits, values["holdout"], placed.trajectory, words)


def _draw(picture: str, rows: list[tuple[str, Score]], poses: TrajectoryScore | None) -> list[Path]:
    """Draw what there is, and say where: errors of poses beside NAME.png in NAME-poses.png if it is taken."""
    from bayesmap.viz.figure import write_figure
    from bayesmap.viz.scores import calibration_figure, errors_figure

    target, written = Path(picture), []
    if rows:
        write_figure(calibration_figure(rows), target)
        written.append(target)
    if poses is not None:
        written.append(target.with_stem(f"{target.stem}-poses") if rows else target)
        write_figure(errors_figure(poses), written[-1])
    return written


def _how(values: dict[str, Any]) -> dict[str, Any]:
    """The settings that a score has under the same name."""
    return {name: values[name] for name in ("seed", "device")}


def _name(run: Run) -> str:
    """Such as "surface posterior"."""
    return f"{run.posterior.kind} posterior"


def _baselines(call: Call, train: Scans, grid: Grid, heldout: Scans, how: dict[str, Any]) -> list[tuple[Fitted, Score]]:
    from bayesmap.posterior.baselines import BASELINES, fit_baseline
    from bayesmap.posterior.folds import make_folds
    from bayesmap.posterior.scores import score_prediction

    with progress(call.console, "tracing beams"):
        folds = make_folds(train, grid)
    found = []
    for baseline in BASELINES:
        call.console.say(f"fitting {baseline.name} to the scans that are not scored")
        with share(call.console, f"fitting {baseline.name}") as report:
            fit = fit_baseline(baseline, train, grid, folds, report)
        with share(call.console, f"scoring {baseline.name}") as report:
            found.append((fit, score_prediction(fit.predictor, heldout, **how, on_progress=report)))
    return found


def _document(
    path: str, log: str | None, found: _Found, poses: dict[str, Any] | None, outputs: dict[str, str]
) -> dict[str, Any]:
    baselines = [
        {
            "map": name,
            **scored.as_json(),
            "fitted": {key: float(value) for key, value in fit.values.items()},
            "inner_nats_per_beam": fit.inner_nats_per_beam,
        }
        for (name, scored), fit in zip(found.rows[1:], found.fits, strict=True)
    ]
    document: dict[str, Any] = {"version": __version__, "run": path, "log": log}
    if found.rows:
        name, own = found.rows[0]
        document["heldout"] = {
            "every": found.every or None,
            "scans": own.scans,
            "beams": own.beams,
            "nats_per_beam": own.nats_per_beam,
        }
        document["score"] = {"map": name, **own.as_json()}
    if found.verdict is not None:
        document["verdict"] = found.verdict
    return {**document, "baselines": baselines or None, "relations": poses, "outputs": outputs}


def _cells(name: str, found: Score) -> tuple[str, ...]:
    """A row of the table."""
    shares = [f"{100 * c.share.value:.1f}" for c in found.coverage]
    width = next(c.median_width_m for c in found.coverage if c.level == 0.8)
    nats = f"{found.nats_per_beam:.3f} +- {found.nats_per_beam_error:.3f}"
    events = (f"{found.brier.value:.4f}", f"{found.log_loss.value:.4f}")
    return (name, nats, *shares, f"{width:.3f} m", f"{found.pit_distance:.3f}", *events)


def _print_table(rows: list[tuple[str, Score]]) -> None:
    cells = [_cells(name, found) for name, found in rows]
    if sys.stdout.isatty():
        from rich.console import Console
        from rich.table import Table

        table = Table(*HEADINGS, caption=f"{rows[0][1].beams:,} beams of {rows[0][1].scans:,} scans")
        for column in table.columns[1:]:
            column.justify = "right"
        for row in cells:
            table.add_row(*row)
        Console().print(table)
        return
    widths = [max(len(row[i]) for row in (HEADINGS, *cells)) for i in range(len(HEADINGS))]
    for row in (HEADINGS, *cells):
        padded = [
            row[0].ljust(widths[0]),
            *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True)),
        ]
        write_out("  ".join(padded).rstrip() + "\n")
