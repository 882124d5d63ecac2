"""``bayesmap score``: how well does a saved run predict beams that it has not seen, and how honest is it?"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import Call, takes
from bayesmap.cli.progress import progress, share
from bayesmap.cli.reading import heldout_scans
from bayesmap.cli.talk import write_out
from bayesmap.errors import BadInput
from bayesmap.version import __version__

if TYPE_CHECKING:
    from bayesmap.posterior.baselines import Fitted
    from bayesmap.posterior.scoring import Score
    from bayesmap.result import Run
    from bayesmap.space.scans import Scans

HEADINGS = ("map", "nats/beam", "50 %", "80 %", "95 %", "80 % width", "PIT", "Brier", "log loss")


@takes("score")
@click.argument("run_file", metavar="RUN.nc")
@click.argument("log")
@click.option("--all", "whole", is_flag=True, help="Score all scans of LOG, another recording of the same place.")
@click.option("--compare", is_flag=True, help="Also hit ratios and log-odds, fitted on the run's own scans.")
@click.option("--picture", metavar="FILE", help="Draw the calibration: .png, .pdf or .svg.")
def command(call: Call, run_file: str, log: str, whole: bool, compare: bool, picture: str | None) -> None:
    r"""Score a saved run on the scans of LOG that were held out when it was made.

    \b
    bayesmap infer office.log.gz --holdout 10 -o runs/office
    bayesmap score runs/office/run.nc office.log.gz --compare --picture calibration.png

    LOG is read as it was for the run: give the same --no-return, topics, --deskew and --thin-scans as to infer.

    Columns: mean log predictive density of a reading, with its standard error over scans; how many readings lie in
    their central 50, 80 and 95 % intervals; median width of the 80 % interval; distance of the probability integral
    transform from uniform; and Brier score and log loss of first hits. docs/scoring.md has the formulas.
    """
    from bayesmap.result import load, score

    values = call.values()
    if picture is not None:
        from bayesmap.viz.writing import need_ending

        need_ending(picture, ("png", "pdf", "svg"), "figure")  # before the minutes of work
    run = load(run_file)
    every = 0 if whole else values["holdout"]
    if every == 0 and not whole:
        raise BadInput("score: --holdout 0 leaves nothing to score; give 2 or more, or --all for another recording")
    heldout = heldout_scans(run, log, values, every)
    call.talk.say(f"scoring {len(heldout):,} scans of {log} that the run has not seen")
    with share(call.talk, f"scoring the {_name(run)}") as tell:
        rows: list[tuple[str, Score]] = [(_name(run), score(run, heldout, seed=values["seed"], on_progress=tell))]
    fits: list[Fitted] = []
    if compare:
        for fit, found in _baselines(call, run, heldout, values["seed"]):
            fits.append(fit)
            rows.append((fit.name, found))
    outputs = {}
    if picture is not None:
        from bayesmap.viz.calibration import calibration_figure
        from bayesmap.viz.figure import write_figure

        write_figure(calibration_figure(rows), picture)
        outputs[Path(picture).name] = picture
    if call.talk.as_json:
        call.talk.result(_document(run_file, log, every, rows, fits, outputs), [])
    else:
        _print_table(rows)


def _name(run: Run) -> str:
    """Such as "surface posterior"."""
    return f"{run.posterior.kind} posterior"


def _baselines(call: Call, run: Run, heldout: Scans, seed: int) -> list[tuple[Fitted, Score]]:
    from bayesmap.posterior.baselines import BASELINES, fit_baseline, make_folds
    from bayesmap.posterior.scoring import score_prediction

    train, grid = run.posterior.scans, run.grid
    with progress(call.talk, "tracing beams"):
        folds = make_folds(train, grid)
    found = []
    for baseline in BASELINES:
        call.talk.say(f"fitting {baseline.name} to the run's own scans")
        with share(call.talk, f"fitting {baseline.name}") as tell:
            fit = fit_baseline(baseline, train, grid, folds, tell)
        with share(call.talk, f"scoring {baseline.name}") as tell:
            found.append((fit, score_prediction(fit.predictor, heldout, seed=seed, on_progress=tell)))
    return found


def _document(
    run_file: str, log: str, every: int, rows: list[tuple[str, Score]], fits: list[Fitted], outputs: dict[str, str]
) -> dict[str, Any]:
    own = rows[0][1]
    baselines = [
        {
            "map": name,
            **found.as_json(),
            "fitted": {key: float(value) for key, value in fit.values.items()},
            "inner_nats_per_beam": fit.inner_nats_per_beam,
        }
        for (name, found), fit in zip(rows[1:], fits, strict=True)
    ]
    return {
        "version": __version__,
        "run": run_file,
        "log": log,
        "heldout": {
            "every": every or None,
            "scans": own.scans,
            "beams": own.beams,
            "nats_per_beam": own.nats_per_beam,
        },
        "score": {"map": rows[0][0], **own.as_json()},
        "baselines": baselines or None,
        "outputs": outputs,
    }


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
