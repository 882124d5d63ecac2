"""Compute the scores of ``bayesmap score``: of runs, of maps and trajectories of other programs, and of poses."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import Call
from bayesmap.cli.console import progress, share
from bayesmap.cli.keys import ScoreSettings
from bayesmap.cli.translation import heldout_scans, is_map, need_file, reading_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.posterior.baselines import Fitted
    from bayesmap.posterior.scores import Score
    from bayesmap.result import Run
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans
    from bayesmap.space.trajectory import Trajectory

    Floats = NDArray[np.float64]

LITTLE_NATS, MUCH_NATS, MANY_STRAYS, VERDICT_M = 0.3, 1.0, 40.0, 3.0
"""Thresholds of the verdict on a map. The gain over no map, in nats per beam, must reach the first number for agreement
in part, and the second for agreement. Above the third number agreement is only in part: it is the per cent of beams
that meet something before a wall at the last distance."""


@dataclass(frozen=True, eq=False)
class Scored:
    """The scores that were computed."""

    rows: list[tuple[str, Score]]  # name and score of each row of the table; the first row is the scored map
    fits: list[Fitted]  # fits of the classic maps in the other rows
    every: int  # one scan in so many was held out; 0 if none was
    trajectory: Trajectory  # in the frame of the relations
    verdict: str | None = None  # verdict on the map of another program, in words


def score_run(
    call: Call[ScoreSettings], path: str, log: str | None, frame: str | None, *, whole: bool, compare: bool,
    poses_too: bool,
) -> Scored:  # fmt: skip
    """Score a saved run on the scans of a log that it has not seen. Without a log return only its trajectory.

    ``frame`` is that of the trajectory, see `bayesmap.space.trajectory.Trajectory.of`. ``whole`` scores all scans of
    the log, ``compare`` classic maps too. With ``poses_too``, the poses are scored afterwards, and a run without
    held-out scans is accepted.
    """
    from bayesmap.io.exports import trajectory_of
    from bayesmap.posterior.heldout import NoneHeldOut
    from bayesmap.result import load, score

    run, settings = load(path), call.settings()
    mount = run.posterior.scans.mount if settings.laser is None else reading_of(settings)["laser"]
    trajectory = trajectory_of(run, run.posterior.scans).of(frame, mount)
    if log is None:
        return Scored([], [], 0, trajectory)
    every = 0 if whole else settings.holdout
    if every == 0 and not whole:
        raise BadInput("score: --holdout 0 leaves nothing to score; give 2 or more, or --all for another recording")
    try:
        heldout = heldout_scans(run, log, settings, every)
    except NoneHeldOut as error:
        if not poses_too:
            raise
        call.console.say(f"only the poses are scored, not the map: {error}")
        return Scored([], [], 0, trajectory)
    call.console.say(f"scoring {len(heldout):,} scans of {log} that the run has not seen")
    with share(call.console, f"scoring the {_name(run)}") as report:
        rows = [(_name(run), score(run, heldout, **_how(settings), on_progress=report))]
    fits = _score_classic_maps(call, run.posterior.scans, run.grid, heldout, rows) if compare else []
    return Scored(rows, fits, every, trajectory)


def score_others(call: Call[ScoreSettings], path: str, log: str | None, frame: str | None, *, compare: bool) -> Scored:
    """Score a map of another program, or a trajectory (a TUM file) by a map inferred from it.

    ``log`` has the scans that score a map, and ``frame`` is that of the returned trajectory.
    """
    from bayesmap.result import score

    settings, words = call.settings(), None
    # Score a given map, or infer one from the trajectory and score that.
    if is_map(path):
        if log is None:
            raise click.UsageError(f"give the LOG whose scans score {path}")
        placed = placed_scans(log, settings, frame)
        call.console.say(f"scoring every {settings.holdout}-th scan of {log}: {len(placed.heldout):,}")
        fit, own = score_map(call, path, placed)
        rows, grid = [(fit.name, own)], fit.predictor.grid
        words = verdict(fit, own, placed)
    else:
        if log is not None:
            raise click.UsageError(f"{path}: neither a saved run (.nc) nor a map (.yaml)")
        if settings.trajectory is None:
            raise click.UsageError(f"{path}: a log by itself; give --trajectory, or the run or map to score on it")
        placed = placed_scans(path, settings, frame)
        run = infer_map(call, placed)
        with share(call.console, f"scoring the {_name(run)}") as report:
            rows = [(_name(run), score(run, placed.heldout, **_how(settings), on_progress=report))]
        grid = run.grid
    fits = _score_classic_maps(call, placed.train, grid, placed.heldout, rows) if compare else []
    return Scored(rows, fits, settings.holdout, placed.trajectory, words)


def _how(settings: ScoreSettings) -> dict[str, Any]:
    return {"seed": settings.seed, "device": settings.device}


def _name(run: Run) -> str:
    """Return the name of a run's map, such as "surface posterior"."""
    return f"{run.posterior.kind} posterior"


def _score_classic_maps(
    call: Call[ScoreSettings], train: Scans, grid: Grid, heldout: Scans, rows: list[tuple[str, Score]]
) -> list[Fitted]:
    """Fit hit ratios and log-odds to the training scans, add a row for each, and return the fits."""
    from bayesmap.posterior.baselines import BASELINES, fit_baseline
    from bayesmap.posterior.heldout import make_folds
    from bayesmap.posterior.scores import score_prediction

    with progress(call.console, "tracing beams"):
        folds = make_folds(train, grid)
    fits = []
    for baseline in BASELINES:
        call.console.say(f"fitting {baseline.name} to the scans that are not scored")
        with share(call.console, f"fitting {baseline.name}") as report:
            fit = fit_baseline(baseline, train, grid, folds, report)
        with share(call.console, f"scoring {baseline.name}") as report:
            scored = score_prediction(fit.predictor, heldout, **_how(call.settings()), on_progress=report)
        fits.append(fit)
        rows.append((fit.name, scored))
    return fits


@dataclass(frozen=True, eq=False)
class Placed:
    """A log's scans at the poses that are scored."""

    train: Scans  # all scans but every n-th
    heldout: Scans  # every n-th scan
    trajectory: Trajectory


def placed_scans(log: str, settings: ScoreSettings, frame: str | None) -> Placed:
    """Return the scans of a log, at the log's poses or at those of ``settings.trajectory``, and their trajectory.

    Raises `BadInput` for files that cannot be read, scans without stamps, or a trajectory of another time.
    """
    need_file(log, "the log that the map was made from", runs=False)
    from bayesmap.io.logs import read_log
    from bayesmap.space.trajectory import Trajectory

    if settings.holdout == 0:
        raise BadInput("score: --holdout 0 leaves nothing to score; the sensor is fitted on the other scans")
    options = reading_of(settings)
    scans = read_log(log, **options)
    path = options["trajectory"] or Trajectory(scans.poses, scans.stamps_s, frame="laser")
    train, heldout = scans.holdout(settings.holdout)
    return Placed(train, heldout, path.of(frame, scans.mount))


def score_map(call: Call[ScoreSettings], path: str, placed: Placed) -> tuple[Fitted, Score]:
    """Fit a sensor to a map on the training scans, and score the map on the held-out scans."""
    from bayesmap.io.ros.maps import read_map
    from bayesmap.posterior.baselines import fit_external_map
    from bayesmap.posterior.scores import score_prediction

    occupancy, grid = read_map(path)
    name = Path(path).name
    with share(call.console, f"fitting a sensor to {name}") as report:
        fit = fit_external_map(name, occupancy, grid, placed.train, report)
    with share(call.console, f"scoring {name}") as report:
        return fit, score_prediction(fit.predictor, placed.heldout, **_how(call.settings()), on_progress=report)


def verdict(fit: Fitted, own: Score, placed: Placed) -> str:
    """Return in words whether a map agrees with the held-out scans, by its gain over no map in nats per beam."""
    import numpy as np

    from bayesmap.localization.known_map import log_anywhere, readings_anywhere

    # Gain per beam over a prediction without a map.
    heldout, values = placed.heldout, fit.values
    law = readings_anywhere(placed.train)
    beams = max(1, int((~np.isnan(heldout.ranges_m)).sum()))
    gain = own.nats_per_beam - log_anywhere(law, heldout.ranges_m, placed.train.max_range_m) / beams
    # Scatter about a wall at `VERDICT_M`, and beams that meet something else before it, in per cent.
    off_m = values["scale_m"] + values["scale_per_m"] * VERDICT_M
    met = values["p_short"] * -math.expm1(-values["rate_short_per_m"] * VERDICT_M)
    strays = 100 * (values["p_random"] + (1 - values["p_random"]) * met)
    if gain < LITTLE_NATS:
        says = "does not agree with these scans: another place, another frame or scale, or wrong poses"
    elif gain < MUCH_NATS or strays > MANY_STRAYS:
        says = "agrees with these scans in part: much was moved, or parts are shifted"
    else:
        says = "agrees with these scans"
    return (
        f"{fit.name} {says}. It tells {gain:.2f} nats a beam more than no map would; walls {VERDICT_M:g} m away are "
        f"met to {100 * off_m:.0f} cm, and {strays:.0f} % of beams met something else before them."
    )


def infer_map(call: Call[ScoreSettings], placed: Placed) -> Run:
    """Infer the posterior over surfaces given a trajectory, from the training scans."""
    from bayesmap.api import infer
    from bayesmap.arguments import Schedule, Where
    from bayesmap.cells.surface import Surface
    from bayesmap.space.grid import Grid

    settings = call.settings()
    grid = Grid.covering(placed.train, settings.resolution)
    call.console.say(f"inferring a map of {grid.shape[0]} x {grid.shape[1]} cells from {len(placed.train):,} scans")
    with progress(call.console, "tracing beams") as on_progress:
        return infer(
            placed.train, grid, prior=Surface(), sensor="fit", schedule=Schedule(warmup=50), seed=settings.seed,
            hit_depth=0.5, where=Where(device=settings.device), on_progress=on_progress,
        )  # fmt: skip
