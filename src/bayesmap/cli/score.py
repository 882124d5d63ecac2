"""``bayesmap score``: score the predictions of maps on unseen beams, the errors of poses, and their calibration."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

import click

from bayesmap.cli.command import FORCE, Call, command
from bayesmap.cli.console import aligned, write_out
from bayesmap.cli.keys import Frame, ScoreSettings
from bayesmap.cli.scores import Scored, score_others, score_run
from bayesmap.cli.translation import is_map, need_free
from bayesmap.files import need_ending
from bayesmap.version import __version__

if TYPE_CHECKING:
    from bayesmap.posterior.scores import Score
    from bayesmap.posterior.trajectory_scores import TrajectoryScore

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
@click.option("--picture", metavar="FILE", help="Draw calibration and errors: .png, .pdf or .svg.")
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
    of_run = _is_run(run_file)
    if frame is not None and relations is None:
        raise click.UsageError("--frame says whose --relations are known; give both")
    if picture is not None:
        need_ending(picture, ("png", "pdf", "svg"), "figure")  # check before minutes of computation
        need_free([Path(picture), _beside(picture)], force, "--picture")
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
    # Draw and print.
    outputs = {} if picture is None else {path.name: str(path) for path in _draw(picture, scored.rows, poses)}
    whose = str(scored.trajectory.frame)
    if call.console.as_json:
        about = None if poses is None else {"file": relations, "frame": whose, **poses.as_json()}
        call.console.result(_document(run_file, log, scored, about, outputs), [])
        return
    if scored.verdict is not None:
        write_out(f"{scored.verdict}\n")
    if scored.rows:
        table = [HEADINGS, *(_cells(name, own) for name, own in scored.rows)]
        write_out("".join(f"{line}\n" for line in aligned(table)))
    if poses is not None:
        write_out("".join(f"{line}\n" for line in lines_of(poses, whose, exact=exact, of_run=of_run)))


def _is_run(path: str) -> bool:
    """Return whether a path is a saved run. A missing file that is no map counts as one."""
    from bayesmap.cli.info import is_saved_run

    return is_saved_run(path) or not (is_map(path) or Path(path).exists())


def _beside(picture: str) -> Path:
    """Return the path of the picture of poses beside that of beams."""
    return Path(picture).with_stem(f"{Path(picture).stem}-poses")


def _draw(picture: str, rows: list[tuple[str, Score]], poses: TrajectoryScore | None) -> list[Path]:
    """Draw calibration and pose errors, and return the paths. With both, the errors go to NAME-poses.png."""
    from bayesmap.viz.figure import write_figure
    from bayesmap.viz.scores import calibration_figure, errors_figure

    target, written = Path(picture), []
    if rows:
        write_figure(calibration_figure(rows), target)
        written.append(target)
    if poses is not None:
        written.append(_beside(picture) if rows else target)
        write_figure(errors_figure(poses), written[-1])
    return written


def _document(
    path: str, log: str | None, scored: Scored, poses: dict[str, Any] | None, outputs: dict[str, str]
) -> dict[str, Any]:
    baselines = []
    for (name, score), fit in zip(scored.rows[1:], scored.fits, strict=True):
        fitted = {key: float(value) for key, value in fit.values.items()}
        more = {"fitted": fitted, "inner_nats_per_beam": fit.inner_nats_per_beam}
        baselines.append({"map": name, **score.as_json(), **more})
    document: dict[str, Any] = {"version": __version__, "run": path, "log": log}
    if scored.rows:
        name, own = scored.rows[0]
        document["heldout"] = {
            "every": scored.every or None, "scans": own.scans, "beams": own.beams, "nats_per_beam": own.nats_per_beam,
        }  # fmt: skip
        document["score"] = {"map": name, **own.as_json()}
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
    """Return the score of poses as lines of text. ``frame`` is that of the relations; ``of_run``: of a saved run."""
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
        held = ", ".join(f"{100 * c['share']:.1f} of {100 * c['level']:g}" for c in figures["coverage"])
        nees = figures["nees"]
        lines.append(
            f"regions      hold {held} %, if relations are exact; "
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
