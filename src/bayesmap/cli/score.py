"""``bayesmap score``: score runs, and maps and trajectories of other programs, on unseen beams and true relations."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

import click

from bayesmap.cli.command import FORCE, Call, command
from bayesmap.cli.console import aligned, progress, share, write_out
from bayesmap.cli.info import is_saved_run
from bayesmap.cli.keys import Frame, ScoreSettings
from bayesmap.cli.translation import heldout_scans, is_map, log_options_of, need_file, need_free
from bayesmap.errors import BadInput
from bayesmap.files import check_ending

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.posterior.baselines import Fitted
    from bayesmap.posterior.prediction import Predictor
    from bayesmap.posterior.scores import Score
    from bayesmap.result import Run
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans
    from bayesmap.space.trajectory import Trajectory

    Floats = NDArray[np.float64]
    from bayesmap.posterior.trajectory_scores import TrajectoryScore

LITTLE_NATS = 0.3  # gain over no map, per beam, from which a map agrees with scans in part
MUCH_NATS = 1.0  # gain over no map, per beam, from which it agrees
MANY_STRAYS = 40.0  # per cent of beams that meet something before a wall at `VERDICT_M`: above, it agrees in part
VERDICT_M = 3.0


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

    ``frame`` is the trajectory's frame, see `bayesmap.space.trajectory.Trajectory.of`. ``whole`` scores all scans of
    the log, ``compare`` classic maps too. ``poses_too`` scores poses, too, and needs no held-out scans.
    """
    from bayesmap.io.exports import trajectory_of
    from bayesmap.posterior.heldout import NoneHeldOut
    from bayesmap.posterior.prediction import predictor_of
    from bayesmap.result import load

    run, settings = load(path), call.settings()
    mount = run.posterior.scans.mount if settings.laser is None else log_options_of(settings)["laser"]
    trajectory = trajectory_of(run, run.posterior.scans).of(frame, mount)
    if poses_too and frame is None and mount is None:
        call.console.warn(
            f"{path}: nothing in it says where the laser sits on the robot, as in runs of older versions: relations "
            "are taken as those of the laser; if they are the base's, add --laser X,Y,DEGREES"
        )
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
    rows = [_score(call, _name(run), predictor_of(run.posterior), heldout)]
    fits = _score_classic_maps(call, run.posterior.scans, run.grid, heldout, rows) if compare else []
    return Scored(rows, fits, every, trajectory)


def score_others(call: Call[ScoreSettings], path: str, log: str | None, frame: str | None, *, compare: bool) -> Scored:
    """Score a map of another program, or a trajectory by a map inferred from it, on scans of ``log``."""
    from bayesmap.posterior.prediction import predictor_of

    settings, words = call.settings(), None
    # Score a given map, or infer one from the trajectory and score that.
    if is_map(path):
        if log is None:
            raise click.UsageError(f"give the LOG whose scans score {path}")
        placed = placed_scans(log, settings, frame)
        call.console.say(f"scoring every {settings.holdout}-th scan of {log}: {len(placed.heldout):,}")
        fit = fit_map(call, path, placed)
        rows, grid = [_score(call, fit.name, fit.predictor, placed.heldout)], fit.predictor.grid
        words = verdict(fit, rows[0][1], placed)
    else:
        if log is not None:
            raise click.UsageError(f"{path}: neither a saved run (.nc) nor a map (.yaml)")
        if settings.trajectory is None:
            raise click.UsageError(f"{path}: a log by itself; give --trajectory, or the run or map to score on it")
        placed = placed_scans(path, settings, frame)
        run = infer_map(call, placed)
        rows, grid = [_score(call, _name(run), predictor_of(run.posterior), placed.heldout)], run.grid
    fits = _score_classic_maps(call, placed.train, grid, placed.heldout, rows) if compare else []
    return Scored(rows, fits, settings.holdout, placed.trajectory, words)


def _score(call: Call[ScoreSettings], name: str, predictor: Predictor, heldout: Scans) -> tuple[str, Score]:
    """Score a map's predictions. Returns a row of the table."""
    from bayesmap.posterior.scores import score_prediction

    seed, device = call.settings().seed, call.settings().device
    with share(call.console, f"scoring {name}") as report:
        return name, score_prediction(predictor, heldout, seed=seed, device=device, on_progress=report)


def _name(run: Run) -> str:
    """Return the name of a run's map, such as "surface posterior"."""
    return f"{run.posterior.kind} posterior"


def _score_classic_maps(
    call: Call[ScoreSettings], train: Scans, grid: Grid, heldout: Scans, rows: list[tuple[str, Score]]
) -> list[Fitted]:
    """Fit hit ratios and log-odds to the training scans, add a row for each, and return the fits."""
    from bayesmap.posterior.baselines import BASELINES, fit_baseline
    from bayesmap.posterior.heldout import make_folds

    with progress(call.console, "tracing beams"):
        folds = make_folds(train, grid)
    fits = []
    for baseline in BASELINES:
        call.console.say(f"fitting {baseline.name} to the scans that are not scored")
        with share(call.console, f"fitting {baseline.name}") as report:
            fit = fit_baseline(baseline, train, grid, folds, report)
        fits.append(fit)
        rows.append(_score(call, fit.name, fit.predictor, heldout))
    return fits


@dataclass(frozen=True, eq=False)
class Placed:
    """A log's scans at the poses that are scored."""

    train: Scans  # all scans but every n-th
    heldout: Scans  # every n-th scan
    trajectory: Trajectory


def placed_scans(log: str, settings: ScoreSettings, frame: str | None) -> Placed:
    """Return a log's scans at its poses, or at the poses of ``settings.trajectory``, and their trajectory."""
    need_file(log, "the log that the map was made from", runs=False)
    from bayesmap.io.logs import read_log
    from bayesmap.space.trajectory import Trajectory

    if settings.holdout == 0:
        raise BadInput("score: --holdout 0 leaves nothing to score; the sensor is fitted on the other scans")
    options = log_options_of(settings)
    scans = read_log(log, **options)
    path = options["trajectory"] or Trajectory(scans.poses, scans.stamps_s, frame="laser")
    train, heldout = scans.holdout(settings.holdout)
    return Placed(train, heldout, path.of(frame, scans.mount))


def fit_map(call: Call[ScoreSettings], path: str, placed: Placed) -> Fitted:
    """Fit a sensor to a map of another program on the training scans."""
    from bayesmap.io.ros.maps import read_map
    from bayesmap.posterior.baselines import fit_external_map

    occupancy, grid = read_map(path)
    name = Path(path).name
    with share(call.console, f"fitting a sensor to {name}") as report:
        return fit_external_map(name, occupancy, grid, placed.train, report)


def verdict(fit: Fitted, score: Score, placed: Placed) -> str:
    """Return in words whether a map agrees with the held-out scans, by its gain over no map in nats per beam."""
    import numpy as np

    from bayesmap.localization.known_map import log_anywhere, readings_anywhere

    # Gain per beam over a prediction without a map.
    heldout, values = placed.heldout, fit.values
    law = readings_anywhere(placed.train)
    beams = max(1, int((~np.isnan(heldout.ranges_m)).sum()))
    gain = score.nats_per_beam - log_anywhere(law, heldout.ranges_m, placed.train.max_range_m) / beams
    # Scatter about a wall at `VERDICT_M`, and beams that meet something else before it, in per cent.
    scatter_m = values["scale_m"] + values["scale_per_m"] * VERDICT_M
    p_object = values["p_short"] * -math.expm1(-values["rate_short_per_m"] * VERDICT_M)
    strays = 100 * (values["p_random"] + (1 - values["p_random"]) * p_object)
    if gain < LITTLE_NATS:
        says = "does not agree with these scans: another place, another frame or scale, or wrong poses"
    elif gain < MUCH_NATS or strays > MANY_STRAYS:
        says = "agrees with these scans in part: much was moved, or parts are shifted"
    else:
        says = "agrees with these scans"
    return (
        f"{fit.name} {says}. It tells {gain:.2f} nats a beam more than no map would; walls {VERDICT_M:g} m away are "
        f"met to {100 * scatter_m:.0f} cm, and {strays:.0f} % of beams met something else before them."
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


HEADINGS = ("map", "nats/beam", "50 %", "80 %", "95 %", "80 % width", "PIT", "Brier", "log loss")


@command("score")
@click.argument("run_file", metavar="RUN.nc|MAP.yaml|LOG")
@click.argument("log", required=False)
@click.option("--all", "whole", is_flag=True, help="Score all scans of LOG, another recording of the same place.")
@click.option("--compare", is_flag=True, help="Also score hit ratios and log-odds, fitted on the same scans.")
@click.option("--relations", metavar="FILE", help="True relative poses (Kuemmerle et al. 2009) to score poses.")
@click.option(
    "--frame", type=click.Choice(get_args(Frame)),
    help="Frame of --relations. [default: base, if it is known where the laser sits on it]",
)  # fmt: skip
@click.option("--exact", is_flag=True, help="Score only relations at times of poses, not between poses.")
@click.option("--picture", metavar="FILE", help="Plot calibration and errors: .png, .pdf or .svg.")
@FORCE
def score(
    call: Call[ScoreSettings], run_file: str, log: str | None, whole: bool, compare: bool, relations: str | None,
    frame: str | None, exact: bool, picture: str | None, force: bool,
) -> None:  # fmt: skip
    r"""Score a saved run, or another program's map or trajectory, on held-out scans of LOG.

    \b
    bayesmap infer office.log.gz --holdout 10 -o runs/office
    bayesmap score runs/office/run.nc office.log.gz --compare --picture calibration.png

    Read LOG as for the run: give the same --no-return, topics, --deskew and --thin-scans as to infer.

    The columns are: mean log predictive density of a reading, with its standard error over scans; per cent of readings
    in their central 50, 80 and 95 % intervals; median width of the 80 % interval; distance of the probability integral
    transform from uniform; Brier score and log loss of first hits. docs/scoring.md has the formulas.

    With --relations the command also scores poses: errors of translation and rotation. If covariances are known, it
    adds the per cent of true relations in their 50, 80 and 95 % regions, and NEES. For a saved run LOG is optional.

    \b
    bayesmap score runs/office/run.nc --relations office.relations
    bayesmap score theirs.yaml office.log.gz --trajectory theirs.tum --relations office.relations
    bayesmap score office.log.gz --trajectory theirs.tum

    For a map of another program (map_server YAML) a sensor is fitted, with the meaning of occupied, free and unknown.
    Every --holdout-th scan is scored, and the fit uses the others. Without --trajectory the command uses LOG's own
    poses. Without a map it infers one from the trajectory.
    """
    # A missing file that is no map counts as a run.
    of_run = is_saved_run(run_file) or not (is_map(run_file) or Path(run_file).exists())
    if frame is not None and relations is None:
        raise click.UsageError("--frame says whose --relations are known; give both")
    if picture is not None:
        check_ending(picture, ("png", "pdf", "svg"), "figure")  # check before minutes of computation
        need_free([Path(picture), _poses_picture(picture)], force, "--picture")
    # Score the map.
    if of_run:
        if log is None and relations is None:
            raise click.UsageError("give LOG, whose held-out scans score the run, or --relations, or both")
        poses_too = relations is not None
        scored = score_run(call, run_file, log, frame, whole=whole, compare=compare, poses_too=poses_too)
    else:
        scored = score_others(call, run_file, log, frame, compare=compare)
    # Score the poses.
    poses = None
    if relations is not None:
        from bayesmap.io.text.trajectories import read_relations
        from bayesmap.posterior.trajectory_scores import score_trajectory

        poses = score_trajectory(scored.trajectory, read_relations(relations), exact=exact)
    # Render and print.
    outputs = {} if picture is None else {path.name: str(path) for path in _render(picture, scored.rows, poses)}
    relations_frame = str(scored.trajectory.frame)
    if call.console.as_json:
        poses_json = None if poses is None else {"file": relations, "frame": relations_frame, **poses.as_json()}
        call.console.result(_document(run_file, log, scored, poses_json, outputs), [])
        return
    if scored.verdict is not None:
        write_out(f"{scored.verdict}\n")
    if scored.rows:
        table = [HEADINGS, *(_cells(name, score) for name, score in scored.rows)]
        write_out("".join(f"{line}\n" for line in aligned(table)))
    if poses is not None:
        write_out("".join(f"{line}\n" for line in lines_of(poses, relations_frame, exact=exact, of_run=of_run)))


def _poses_picture(picture: str) -> Path:
    """Return the path of the picture of poses, beside the picture of beams."""
    return Path(picture).with_stem(f"{Path(picture).stem}-poses")


def _render(picture: str, rows: list[tuple[str, Score]], poses: TrajectoryScore | None) -> list[Path]:
    """Render calibration and pose errors, and return the paths. With both, the errors go to NAME-poses.png."""
    from bayesmap.viz.figure import write_figure
    from bayesmap.viz.scores import calibration_figure, errors_figure

    target, written = Path(picture), []
    if rows:
        write_figure(calibration_figure(rows), target)
        written.append(target)
    if poses is not None:
        written.append(_poses_picture(picture) if rows else target)
        write_figure(errors_figure(poses), written[-1])
    return written


def _document(
    path: str, log: str | None, scored: Scored, poses: dict[str, Any] | None, outputs: dict[str, str]
) -> dict[str, Any]:
    baselines = []
    for (name, score), fit in zip(scored.rows[1:], scored.fits, strict=True):
        fitted = {key: float(value) for key, value in fit.values.items()}
        inner = {"fitted": fitted, "inner_nats_per_beam": fit.inner_nats_per_beam}
        baselines.append({"map": name, **score.as_json(), **inner})
    document: dict[str, Any] = {"run": path, "log": log}
    if scored.rows:
        name, score = scored.rows[0]
        counts = {"scans": score.scans, "beams": score.beams, "nats_per_beam": score.nats_per_beam}
        document["heldout"] = {"every": scored.every or None, **counts}
        document["score"] = {"map": name, **score.as_json()}
    if scored.verdict is not None:
        document["verdict"] = scored.verdict
    return {**document, "baselines": baselines or None, "relations": poses, "outputs": outputs}


def _cells(name: str, score: Score) -> tuple[str, ...]:
    shares = [f"{100 * c.share.value:.1f}" for c in score.coverage]
    width = next(c.median_width_m for c in score.coverage if c.level == 0.8)
    nats = f"{score.nats_per_beam:.3f} +- {score.nats_per_beam_error:.3f}"
    events = (f"{score.brier.value:.4f}", f"{score.log_loss.value:.4f}")
    return (name, nats, *shares, f"{width:.3f} m", f"{score.pit_distance:.3f}", *events)


def lines_of(score: TrajectoryScore, frame: str, *, exact: bool, of_run: bool) -> list[str]:
    """Return the score of poses, of a saved run if ``of_run``, as lines of text. ``frame`` is the relations' frame."""
    from bayesmap.space.trajectory import LONGEST_GAP_S

    figures = score.as_json()
    missing = ""
    if figures["in_gaps"]:
        where = "not at times of poses" if exact else f"between poses over {LONGEST_GAP_S:g} s apart"
        missing = f"; {figures['in_gaps']:,} more are {where}, and left out"
    if outside := figures["not_covered"] - figures["in_gaps"]:
        missing += f"; {outside:,} more are of other times"
    lines = [
        f"relations    {figures['relations']:,}, of the {frame}{missing}",
        f"translation  {figures['translation_m_mean']:.4f} +- {figures['translation_m_std']:.4f} m, "
        f"median {figures['translation_m_median']:.4f}",
        f"rotation     {figures['rotation_deg_mean']:.3f} +- {figures['rotation_deg_std']:.3f} degrees, "
        f"median {figures['rotation_deg_median']:.3f}",
    ]
    if figures["coverage"] is not None:
        shares = ", ".join(f"{100 * c['share']:.1f} of {100 * c['level']:g}" for c in figures["coverage"])
        nees = figures["nees"]
        lines.append(
            f"regions      hold {shares} %, if relations are exact; "
            f"NEES {nees['mean']:.2f}, median {nees['median']:.2f} (3 is right)"
        )
        lines += [f"by           {score.known_by}"] if score.known_by else []
    elif of_run:
        lines.append(
            "regions      unknown: the run takes its poses as known, or was saved by an earlier version, and has no "
            "covariances of them; slam saves them"
        )
    else:
        lines.append(
            "regions      unknown: the poses come without covariances; "
            "--trajectory FILE.tum with FILE-covariances.txt beside it has them"
        )
    return lines
