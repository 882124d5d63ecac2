"""``bayesmap score``: score runs, and maps and trajectories of other programs, on unseen beams and true relations.

A map is scored by the densities that it predicts for held-out readings (`score_run`). `score_other` fits a sensor
to a map, or infers a map from a trajectory, before that. A trajectory is scored by its errors in known relative poses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

import click

from bayesmap.cli.command import FORCE, Call, command
from bayesmap.cli.console import align_rows, progress_bar, share_bar, write_lines
from bayesmap.cli.keys import Frame, ScoreSettings
from bayesmap.cli.translation import NO_MOUNT, heldout_scans, is_map, log_options_of, need_file, need_free
from bayesmap.errors import BadInput
from bayesmap.files import check_ending, is_saved_run

if TYPE_CHECKING:
    from bayesmap.posterior.baselines import FittedBaseline
    from bayesmap.posterior.prediction import Predictor
    from bayesmap.posterior.scores import Score
    from bayesmap.posterior.trajectory_scores import TrajectoryScore
    from bayesmap.result import Run
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans
    from bayesmap.space.trajectory import Trajectory

VERDICT_M = 3.0  # distance of the wall for which a verdict states errors
MIN_PARTIAL_NATS = 0.3  # a map that gains less over no map, per beam, does not agree with the scans
MIN_AGREEMENT_NATS = 1.0  # a map that gains less agrees in part
MAX_STRAY_PER_CENT = 40.0  # if more beams than this meet something before a wall at `VERDICT_M`, it agrees in part

HEADINGS = ("map", "nats/beam", "50 %", "80 %", "95 %", "80 % width", "PIT", "Brier", "log loss")


@command("score")
@click.argument("run_file", metavar="RUN.nc|MAP.yaml|LOG")
@click.argument("log", required=False)
@click.option("--all", "all_scans", is_flag=True, help="Score all scans of LOG, another recording of the same place.")
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
    call: Call[ScoreSettings], run_file: str, log: str | None, all_scans: bool, compare: bool, relations: str | None,
    frame: Frame | None, exact: bool, picture: str | None, force: bool,
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
    # Check the arguments. A missing file that is no map counts as a run.
    is_run = is_saved_run(run_file) or not (is_map(run_file) or Path(run_file).exists())
    if frame is not None and relations is None:
        raise click.UsageError("--frame says whose --relations are known; give both")
    if picture is not None:
        check_ending(picture, ("png", "pdf", "svg"), "figure")  # check before minutes of computation
        poses_picture = Path(picture).with_stem(f"{Path(picture).stem}-poses")
        need_free([Path(picture), poses_picture], force=force, option="--picture")
    if is_run:
        scores_poses = relations is not None
        scores = score_run(call, run_file, log, frame, all_scans=all_scans, compare=compare, scores_poses=scores_poses)
    else:
        scores = score_other(call, run_file, log, frame, compare=compare)
    pose_score = None
    if relations is not None:
        from bayesmap.io.text.trajectories import read_relations
        from bayesmap.posterior.trajectory_scores import score_trajectory

        pose_score = score_trajectory(scores.trajectory, read_relations(relations), exact=exact)
    written = [] if picture is None else _write_pictures(Path(picture), scores.maps, pose_score)
    frame_words = str(scores.trajectory.frame)
    if call.console.as_json:
        poses_json = None if pose_score is None else {"file": relations, "frame": frame_words, **pose_score.as_json()}
        call.console.result(_document(run_file, log, scores, poses_json, written), [])
        return
    if scores.verdict is not None:
        write_lines([scores.verdict])
    if scores.maps:
        write_lines(align_rows([HEADINGS, *map(_table_row, scores.maps)]))
    if pose_score is not None:
        write_lines(_pose_score_lines(pose_score, frame_words, exact=exact, is_run=is_run))


@dataclass(frozen=True, eq=False)
class MapScore:
    """The score of one map: a row of the table."""

    name: str  # name of the map
    score: Score
    fit: FittedBaseline | None = None  # fit to the training scans, if this is a classic map for comparison


@dataclass(frozen=True, eq=False)
class Scores:
    """The scores of maps on the same held-out scans, and the trajectory to score."""

    maps: list[MapScore]  # the map in question first, then classic maps; empty if only poses are scored
    every: int  # every n-th scan was held out; 0 if none was
    trajectory: Trajectory  # trajectory of the run or the log, in the frame of the relations
    verdict: str | None = None  # verdict on the map of another program, in words


def score_run(
    call: Call[ScoreSettings], path: str, log: str | None, frame: Frame | None, *, all_scans: bool, compare: bool,
    scores_poses: bool,
) -> Scores:  # fmt: skip
    """Score a saved run, and with ``compare`` classic maps, on the scans of a log that the run has not seen.

    The scans are every n-th of the log, or ``all_scans`` of another recording. If ``scores_poses``, the log or its
    held-out scans may be missing. No map is scored then; the trajectory, of ``frame``, is returned in any case.
    """
    if log is None and not scores_poses:
        raise click.UsageError("give LOG, whose held-out scans score the run, or --relations, or both")
    from bayesmap.io.exports import trajectory_of
    from bayesmap.posterior.heldout import NoneHeldOut
    from bayesmap.posterior.prediction import predictor_of
    from bayesmap.result import load

    run = load(path)
    settings = call.settings()
    # The trajectory, of the base or the laser.
    mount = run.posterior.scans.mount if settings.laser is None else log_options_of(settings)["laser"]
    trajectory = trajectory_of(run, run.posterior.scans).of(frame, mount)
    if scores_poses and frame is None and mount is None:
        remedy = "if they are the base's, add --laser X,Y,DEGREES"
        call.console.warn(f"{path}: {NO_MOUNT}: relations are taken as those of the laser; {remedy}")
    if log is None:
        return Scores([], 0, trajectory)
    # The map, on scans that the run has not seen.
    every = 0 if all_scans else settings.holdout
    if every == 0 and not all_scans:
        raise BadInput("score: --holdout 0 leaves nothing to score; give 2 or more, or --all for another recording")
    try:
        heldout = heldout_scans(run, log, settings, every)
    except NoneHeldOut as error:
        if not scores_poses:
            raise
        call.console.say(f"only the poses are scored, not the map: {error}")
        return Scores([], 0, trajectory)
    call.console.say(f"scoring {len(heldout):,} scans of {log} that the run has not seen")
    maps = [_score_map(call, f"{run.posterior.kind} posterior", predictor_of(run.posterior), heldout)]
    maps += _score_classic_maps(call, run.posterior.scans, run.grid, heldout) if compare else []
    return Scores(maps, every, trajectory)


def score_other(call: Call[ScoreSettings], path: str, log: str | None, frame: Frame | None, *, compare: bool) -> Scores:
    """Score a map of another program, or a trajectory by a map inferred from it, on scans of ``log``."""
    from bayesmap.posterior.prediction import predictor_of

    settings = call.settings()
    fit = None
    if is_map(path):
        if log is None:
            raise click.UsageError(f"give the LOG whose scans score {path}")
        split = split_log(log, settings, frame)
        call.console.say(f"scoring every {settings.holdout}-th scan of {log}: {len(split.heldout):,}")
        fit = fit_map(call, path, split)
        name, predictor = fit.name, fit.predictor
    else:
        if log is not None:
            raise click.UsageError(f"{path}: neither a saved run (.nc) nor a map (.yaml)")
        if settings.trajectory is None:
            raise click.UsageError(f"{path}: a log by itself; give --trajectory, or the run or map to score on it")
        split = split_log(path, settings, frame)
        run = infer_map(call, split)
        name, predictor = f"{run.posterior.kind} posterior", predictor_of(run.posterior)
    maps = [_score_map(call, name, predictor, split.heldout)]
    words = None if fit is None else verdict(fit, maps[0].score, split)
    maps += _score_classic_maps(call, split.train, predictor.grid, split.heldout) if compare else []
    return Scores(maps, settings.holdout, split.trajectory, words)


def _score_map(
    call: Call[ScoreSettings], name: str, predictor: Predictor, heldout: Scans, fit: FittedBaseline | None = None
) -> MapScore:
    """Score a map's predictions of held-out scans. ``fit`` is that of a classic map."""
    from bayesmap.posterior.scores import score_prediction

    seed, device = call.settings().seed, call.settings().device
    with share_bar(call.console, f"scoring {name}") as report:
        score = score_prediction(predictor, heldout, seed=seed, device=device, on_progress=report)
    return MapScore(name, score, fit)


def _score_classic_maps(call: Call[ScoreSettings], train: Scans, grid: Grid, heldout: Scans) -> list[MapScore]:
    """Fit hit ratios and log-odds to the training scans, and score them on the held-out scans."""
    from bayesmap.posterior.baselines import BASELINES, fit_baseline
    from bayesmap.posterior.heldout import make_folds

    with progress_bar(call.console, "tracing beams"):
        folds = make_folds(train, grid)
    maps = []
    for baseline in BASELINES:
        call.console.say(f"fitting {baseline.name} to the scans that are not scored")
        with share_bar(call.console, f"fitting {baseline.name}") as report:
            fit = fit_baseline(baseline, train, grid, folds, report)
        maps.append(_score_map(call, fit.name, fit.predictor, heldout, fit))
    return maps


@dataclass(frozen=True, eq=False)
class SplitLog:
    """A log's scans at the poses that are scored, split into those for the fit and those for the score."""

    train: Scans  # all scans but every n-th
    heldout: Scans  # every n-th scan
    trajectory: Trajectory


def split_log(log: str, settings: ScoreSettings, frame: Frame | None) -> SplitLog:
    """Read a log at its poses, or at those of ``settings.trajectory``, and split off every n-th scan."""
    need_file(log, "the log that the map was made from", runs=False)
    from bayesmap.io.logs import read_log
    from bayesmap.space.trajectory import Trajectory

    if settings.holdout == 0:
        raise BadInput("score: --holdout 0 leaves nothing to score; the sensor is fitted on the other scans")
    options = log_options_of(settings)
    scans = read_log(log, **options)
    trajectory = options["trajectory"] or Trajectory(scans.poses, scans.stamps_s, frame="laser")
    train, heldout = scans.holdout(settings.holdout)
    return SplitLog(train, heldout, trajectory.of(frame, scans.mount))


def fit_map(call: Call[ScoreSettings], path: str, split: SplitLog) -> FittedBaseline:
    """Fit a sensor to a map of another program on the training scans."""
    from bayesmap.io.ros.maps import read_map
    from bayesmap.posterior.baselines import fit_external_map

    occupancy, grid = read_map(path)
    name = Path(path).name
    with share_bar(call.console, f"fitting a sensor to {name}") as report:
        return fit_external_map(name, occupancy, grid, split.train, report)


def verdict(fit: FittedBaseline, score: Score, split: SplitLog) -> str:
    """Return in words whether a map agrees with the held-out scans, by its gain over no map in nats per beam."""
    import numpy as np

    from bayesmap.localization.known_map import log_anywhere, readings_anywhere

    # Gain per beam over a prediction without a map.
    heldout = split.heldout
    law = readings_anywhere(split.train)  # the density of a reading that is taken anywhere, without a map
    beams = max(1, int((~np.isnan(heldout.ranges_m)).sum()))
    gain = score.nats_per_beam - log_anywhere(law, heldout.ranges_m, split.train.max_range_m) / beams
    # Scatter about a wall at `VERDICT_M`, and beams that meet something else before it, in per cent.
    values = fit.values
    scatter_m = values["scale_m"] + values["scale_per_m"] * VERDICT_M
    p_object = values["p_short"] * -math.expm1(-values["rate_short_per_m"] * VERDICT_M)
    strays = 100 * (values["p_random"] + (1 - values["p_random"]) * p_object)
    if gain < MIN_PARTIAL_NATS:
        agreement = "does not agree with these scans: another place, another frame or scale, or wrong poses"
    elif gain < MIN_AGREEMENT_NATS or strays > MAX_STRAY_PER_CENT:
        agreement = "agrees with these scans in part: much was moved, or parts are shifted"
    else:
        agreement = "agrees with these scans"
    return (
        f"{fit.name} {agreement}. It tells {gain:.2f} nats a beam more than no map would; walls {VERDICT_M:g} m away "
        f"are met to {100 * scatter_m:.0f} cm, and {strays:.0f} % of beams met something else before them."
    )


def infer_map(call: Call[ScoreSettings], split: SplitLog) -> Run:
    """Infer the posterior over surfaces given a trajectory, from the training scans."""
    from bayesmap.api import infer
    from bayesmap.arguments import Schedule, Where
    from bayesmap.cells.surface import Surface
    from bayesmap.space.grid import Grid

    settings = call.settings()
    grid = Grid.covering(split.train, settings.resolution)
    call.console.say(f"inferring a map of {grid.shape[0]} x {grid.shape[1]} cells from {len(split.train):,} scans")
    with progress_bar(call.console, "tracing beams") as on_progress:
        return infer(
            split.train, grid, prior=Surface(), sensor="fit", schedule=Schedule(warmup=50), seed=settings.seed,
            hit_depth=0.5, where=Where(device=settings.device), on_progress=on_progress,
        )  # fmt: skip


def _write_pictures(picture: Path, maps: list[MapScore], poses: TrajectoryScore | None) -> list[Path]:
    """Render calibration and pose errors, and return the paths. With both, the errors go to NAME-poses.png."""
    from bayesmap.viz.figure import write_figure
    from bayesmap.viz.scores import calibration_figure, errors_figure

    written = []
    if maps:
        written.append(picture)
        write_figure(calibration_figure([(row.name, row.score) for row in maps]), picture)
    if poses is not None:
        written.append(picture.with_stem(f"{picture.stem}-poses") if maps else picture)
        write_figure(errors_figure(poses), written[-1])
    return written


def _document(
    path: str, log: str | None, scores: Scores, poses: dict[str, Any] | None, written: list[Path]
) -> dict[str, Any]:
    """Return the JSON document of the scores; ``poses`` is the score of the trajectory as JSON values."""
    document: dict[str, Any] = {"run": path, "log": log}
    if scores.maps:
        score = scores.maps[0].score
        counts = {"scans": score.scans, "beams": score.beams, "nats_per_beam": score.nats_per_beam}
        document["heldout"] = {"every": scores.every or None, **counts}
        document["score"] = {"map": scores.maps[0].name, **score.as_json()}
    if scores.verdict is not None:
        document["verdict"] = scores.verdict
    baselines = []
    for row in scores.maps:
        if row.fit is not None:
            fitted = {name: float(value) for name, value in row.fit.values.items()}
            inner = {"fitted": fitted, "inner_nats_per_beam": row.fit.inner_nats_per_beam}
            baselines.append({"map": row.name, **row.score.as_json(), **inner})
    outputs = {file.name: str(file) for file in written}
    return {**document, "baselines": baselines or None, "relations": poses, "outputs": outputs}


def _table_row(row: MapScore) -> tuple[str, ...]:
    """Return the cells of a map's score in the table, as in `HEADINGS`."""
    score = row.score
    shares = [f"{100 * interval.share.value:.1f}" for interval in score.coverage]
    width_m = next(interval.median_width_m for interval in score.coverage if interval.level == 0.8)
    nats = f"{score.nats_per_beam:.3f} +- {score.nats_per_beam_error:.3f}"
    events = (f"{score.brier.value:.4f}", f"{score.log_loss.value:.4f}")
    return (row.name, nats, *shares, f"{width_m:.3f} m", f"{score.pit_distance:.3f}", *events)


def _pose_score_lines(score: TrajectoryScore, frame: str, *, exact: bool, is_run: bool) -> list[str]:
    """Return the score of poses, of a saved run if ``is_run``, as lines of text. ``frame`` is the relations' frame."""
    figures = score.as_json()
    lines = [
        f"relations    {figures['relations']:,}, of the {frame}{_words_for_missing(figures, exact=exact)}",
        f"translation  {figures['translation_m_mean']:.4f} +- {figures['translation_m_std']:.4f} m, "
        f"median {figures['translation_m_median']:.4f}",
        f"rotation     {figures['rotation_deg_mean']:.3f} +- {figures['rotation_deg_std']:.3f} degrees, "
        f"median {figures['rotation_deg_median']:.3f}",
    ]
    if figures["coverage"] is not None:
        shares = ", ".join(f"{100 * row['share']:.1f} of {100 * row['level']:g}" for row in figures["coverage"])
        nees = figures["nees"]
        nees_words = f"NEES {nees['mean']:.2f}, median {nees['median']:.2f} (3 is right)"
        lines.append(f"regions      hold {shares} %, if relations are exact; {nees_words}")
        lines += [f"by           {score.known_by}"] if score.known_by else []
    elif is_run:
        reason = "the run takes its poses as known, or was saved by an earlier version, and has no covariances of them"
        lines.append(f"regions      unknown: {reason}; slam saves them")
    else:
        remedy = "--trajectory FILE.tum with FILE-covariances.txt beside it has them"
        lines.append(f"regions      unknown: the poses come without covariances; {remedy}")
    return lines


def _words_for_missing(figures: dict[str, Any], *, exact: bool) -> str:
    """Return words for the relations that the ``figures`` of a trajectory's score leave out; empty if there is none."""
    from bayesmap.space.trajectory import MAX_INTERPOLATED_S

    words = ""
    if figures["in_gaps"]:
        reason = "not at times of poses" if exact else f"between poses over {MAX_INTERPOLATED_S:g} s apart"
        words = f"; {figures['in_gaps']:,} more are {reason}, and left out"
    if n_outside := figures["not_covered"] - figures["in_gaps"]:
        words += f"; {n_outside:,} more are of other times"
    return words
