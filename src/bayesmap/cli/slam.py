"""``bayesmap slam``: infer the posterior over map and trajectory from a log with raw odometry.

`slam` takes the steps of `bayesmap.cli.pipeline`. The trajectory of all scans is known before the chains of the map
begin: `TrajectoryFiles` writes it. `summarise` turns it into JSON values, and `_good`, `_notes` and `_doubtful` make
sentences.
"""

from __future__ import annotations

import shlex
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli import pipeline, translation
from bayesmap.cli.command import Call, as_toml, command
from bayesmap.cli.console import Console, progress_bar
from bayesmap.cli.folder import Folder
from bayesmap.cli.keys import SlamSettings
from bayesmap.cli.pipeline import Task
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.io.log_reading import ScanLog
    from bayesmap.poses.trajectory import InferredTrajectory
    from bayesmap.result import Run
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans

MAX_UNTHINNED_SCANS = 500  # number of scans above which the command that scores the trajectory takes one each 0.3 m
STAGES = "stages"  # folder of the finished stages of the trajectory, in the folder of the run
MAX_LISTED_STRETCHES = 3  # number of doubtful stretches of odometry that are listed
MAX_ALTERNATIVES = 5  # number of alternatives to the trajectory that are described
MAX_LISTED_SCANS = 10  # number of doubtful scans that are listed


@command("slam")
@click.argument("log")
@click.option("-o", "--output", metavar="DIR", help="Folder of the run. [default: runs/NAME-OF-LOG]")
@click.option("--resume", is_flag=True, help="Resume the run in DIR, bit for bit as if it had never stopped.")
@click.option("--force", is_flag=True, help="Replace the run in DIR.")
def slam(call: Call[SlamSettings], log: str, output: str | None, resume: bool, force: bool) -> None:
    r"""Infer map and trajectory from LOG with poses of raw odometry; any log that infer reads.

    The command matches all scans, closes loops, and matches every scan against all others that see the same walls. The
    result is a trajectory with covariances. Then chains sample the map. Of at most 100 key scans they sample the poses,
    too, each chain from its own draw of the trajectory. Of more key scans, or with --fast, the trajectory counts as
    known, and the map is made from as many scans and beams as its cells need.

    The command writes into DIR the saved run (run.nc), the trajectory of all scans (trajectory.tum; covariances in a
    second file), the map for nav2 (map.yaml), pictures (posterior.png, surfaces.png, trajectory.png, odometry.png,
    loops.png), summary.json, and the settings (config.toml). Ctrl-C keeps finished stages and sweeps; --resume
    continues from them. The trajectory comes before the chains begin.

    \b
    bayesmap slam recording.bag -o runs/office
    bayesmap slam intel-odometry.log.gz --max-range 20 --fast

    {sensors}
    """
    if resume and force:
        raise click.UsageError("--resume goes on with a run and --force replaces it: give one of them")
    if call.settings().fast and call.settings().sample_poses:
        raise click.UsageError("--fast takes poses as known and --sample-poses samples them: give one of them")
    folder = Path(output) if output else Path("runs") / pipeline.log_stem(log)
    task = pipeline.prepare(call, log, folder, resume=resume, force=force)
    resume_command = shlex.join(["bayesmap", "slam", log, "-o", str(folder), "--resume"])
    scan_log = pipeline.read_scan_log(call.console, log, task.settings, without_poses=task.settings.no_odometry)
    _check_scans(call.console, scan_log, task.settings)
    # Load the run to resume, or announce the cost of a new one.
    saved = pipeline.load_interrupted(task.folder) if task.folder.resuming else None
    if not task.folder.resuming:
        estimate = pipeline.cost_of_slam(task.settings, scan_log.scans)
        pipeline.announce(call.console, estimate)
        if estimate is not None and not task.settings.any_size:
            estimate.refuse(scan_log.scans)
    if force:
        shutil.rmtree(folder / STAGES, ignore_errors=True)
    from bayesmap.space.trajectory import step_to

    # The frame of the trajectory; the base is refused if nothing says where the laser sits on it.
    frame, _ = step_to(task.settings.frame, scan_log.scans.mount, "laser")
    files = TrajectoryFiles(task.folder, scan_log, task.settings.resolution, frame)
    try:
        # Infer trajectory and map, with checkpoints. The trajectory is written before the chains of the map begin.
        run = _sample(task, scan_log.scans, saved, files)
        # After Ctrl-C: leave the folder so that the run can go on.
        if not run.finished:
            document = pipeline.keep_interrupted(task.folder, run, scan_log, resume_command, files.written)
            files.write()  # if an older run has just been replaced
            if run.n_draws > 0:
                files.render(run)
            document["outputs"] |= {path.name: str(path) for path in files.written}
            pipeline.print_result(call, document, strict=task.settings.strict)
        outputs = [*task.folder.write_products(run), *files.finish(run)]
    except KeyboardInterrupt:
        if task.folder.begun or resume:
            call.console.say(f"the stages that are done are kept; go on with:\n  {resume_command}")
        raise
    outputs += [folder / "summary.json", task.folder.config_path]
    trajectory = summarise(run, files.frame)
    document = {**pipeline.document_of(run, scan_log, None, outputs), "trajectory": trajectory}
    task.folder.write_document(document)
    file = str(task.folder.run_path)
    thin = ["--thin-scans", "0.3"] if len(scan_log.scans) > MAX_UNTHINNED_SCANS else []  # score makes its own map
    score = ["score", log, "--trajectory", str(folder / "trajectory.tum"), *thin]
    commands = [["app", file], score, ["explore", file]]
    for note in _notes(trajectory):
        call.console.say(f"note: {note}")
    good, doubtful = _good(trajectory), _doubtful(trajectory)
    pipeline.print_report(call.console, document, good=good, doubtful=doubtful, commands=commands)
    pipeline.print_result(call, document, strict=task.settings.strict)


slam.help = (slam.help or "").format(sensors=translation.SENSOR_HELP)


def _check_scans(console: Console, log: ScanLog, settings: SlamSettings) -> None:
    """Refuse scans that cannot be inferred, before an older run is changed, and warn of doubtful odometry."""
    from bayesmap.poses.log_checks import check_scans, odometry_warnings

    check_scans(log.scans, no_odometry=settings.no_odometry)
    warnings = odometry_warnings(log.scans, no_odometry=settings.no_odometry)
    for warning in warnings[:MAX_LISTED_STRETCHES]:
        console.warn(warning)
    if len(warnings) > MAX_LISTED_STRETCHES:
        console.warn(f"odometry stands still like that in {len(warnings) - MAX_LISTED_STRETCHES:,} more stretches")


def _sample(task: Task[SlamSettings], scans: Scans, saved: Run | None, files: TrajectoryFiles) -> Run:
    """Infer trajectory and map, with checkpoints in the folder; ``saved`` is the run to resume."""
    from bayesmap.api import Event, slam
    from bayesmap.arguments import Checkpoints, Where
    from bayesmap.poses.map_scans import MAX_SAMPLED_KEYS

    folder, settings = task.folder, task.settings
    toml = as_toml({"slam": settings})
    with progress_bar(folder.console, "matching scans") as show:

        def on_progress(event: Event) -> None:
            if event.stage in ("warm-up", "draws"):
                folder.begin(toml)
                files.write()
            show(event)

        def on_checkpoint(run: Run) -> None:
            folder.begin(toml)
            folder.checkpoint(run, lambda done, total: show(Event("save", done, total)))
            files.write()

        def on_trajectory(trajectory: InferredTrajectory) -> None:
            files.write(trajectory)
            if translation.fast_of(settings) is None and len(trajectory.keys) <= MAX_SAMPLED_KEYS:
                few = f"the log is short ({len(trajectory.keys)} key scans, {MAX_SAMPLED_KEYS} at most)"
                folder.console.say(f"{few}: chains sample its poses with the map, which takes longer; --fast does not")

        if saved is None:
            folder.begin(toml)  # before the first stage: to resume finished stages takes the settings
        run = slam(
            scans, resolution=settings.resolution, prior=translation.prior_of(settings), seed=settings.seed,
            sensor=translation.sensor_for(settings, settings.resolution), fast=translation.fast_of(settings),
            no_odometry=settings.no_odometry, schedule=translation.schedule_of(settings), hit_depth=settings.hit_depth,
            where=Where(settings.threads, settings.device, any_size=settings.any_size), on_progress=on_progress,
            checkpoints=Checkpoints(
                saved, on_checkpoint, settings.checkpoint_every, folder.path / STAGES, folder.preview, on_trajectory
            ),
        )  # fmt: skip
        if run.finished or run.posterior.sweep > 0:
            folder.begin(toml)  # a resumed run that had finished reports no sweep
        return run


@dataclass
class TrajectoryFiles:
    """The trajectory of all scans in the folder, written once it is known and no older run is in it."""

    folder: Folder
    log: ScanLog
    resolution: float  # edge of a cell of the pictures, metres
    frame: str  # frame on the robot whose poses are written
    written: list[Path] = field(default_factory=list)  # the files, once they are written
    _trajectory: InferredTrajectory | None = field(default=None, init=False)

    def write(self, trajectory: InferredTrajectory | None = None) -> None:
        """Write all files unless they are written; while an older run is in the folder, store the trajectory."""
        self._trajectory = self._trajectory if trajectory is None else trajectory
        if self.written or self._trajectory is None or not self.folder.begun or self.folder.outdated_path.exists():
            return
        try:
            self.written = self._write(self._trajectory)
        except (OSError, BadInput) as error:
            self.folder.console.warn(f"the trajectory could not be written yet: {error}")
        else:
            self.folder.console.say(f"the trajectory of the {self.frame}, at all scans: {self.written[0]}")

    def finish(self, run: Run) -> list[Path]:
        """Write all files that are not written yet, and render the trajectory on the map of the run."""
        assert self._trajectory is not None
        self.written = self.written or self._write(self._trajectory)
        self.render(run)
        return self.written

    def render(self, run: Run) -> None:
        """Render the trajectory on the map of a run, if its files are written."""
        if self.written and self._trajectory is not None:
            self._render(self._trajectory, run.grid, run.occupancy, run.observed)

    def _render(
        self, trajectory: InferredTrajectory, grid: Grid, occupancy: NDArray[Any], observed: NDArray[np.bool_]
    ) -> None:
        from bayesmap.viz.figure import write_figure
        from bayesmap.viz.trajectory import trajectory_figure

        covariances = trajectory.covariances()
        figure = trajectory_figure(grid, occupancy, observed, trajectory.poses, covariances, trajectory.flagged)
        write_figure(figure, self.folder.path / "trajectory.png")

    def _write(self, trajectory: InferredTrajectory) -> list[Path]:
        """Write all files, and return their paths. The map in the picture has the cells that the key scans hit."""
        import numpy as np

        from bayesmap.io.exports import approximate_trajectory, export_trajectory
        from bayesmap.poses.map_scans import calibrated_keys
        from bayesmap.space.grid import Grid
        from bayesmap.space.planar import between, compose
        from bayesmap.viz.figure import write_figure
        from bayesmap.viz.trajectory import loops_figure, odometry_figure

        path, closures = self.folder.path, trajectory.closures
        moved = approximate_trajectory(trajectory).of(self.frame, self.log.scans.mount)
        texts = export_trajectory(path / "trajectory.tum", moved)
        scans = calibrated_keys(self.log.scans, trajectory)
        grid = Grid.covering(scans, self.resolution)
        hit = np.zeros(grid.shape, np.bool_)
        hit[tuple(np.floor(grid.to_cells(scans.hit_points_world())).astype(np.intp).T)] = True
        self._render(trajectory, grid, hit.astype(float), hit)
        poses, probabilities = trajectory.poses, trajectory.alternatives.probabilities
        alternatives = [(trajectory.alternative_poses(n), float(p)) for n, p in enumerate(probabilities)]
        ends = closures.first, closures.second
        pictures = {"loops.png": loops_figure(poses, *ends, closures.residuals, closures.weights, alternatives)}
        if self.log.posed:
            raw = self.log.scans.poses[trajectory.order]
            pictures["odometry.png"] = odometry_figure(compose(poses[0], between(raw[0], raw)), poses)
        for name, figure in pictures.items():
            write_figure(figure, path / name)
        return [*texts, *(path / name for name in ("trajectory.png", *pictures))]


def summarise(run: Run, frame: str) -> dict[str, Any]:
    """Return a summary of the inferred trajectory as JSON values; ``frame`` is the frame of its file."""
    import numpy as np

    trajectory = run.trajectory
    assert trajectory is not None
    sigma_m = np.sqrt(np.linalg.eigvalsh(trajectory.covariances()[:, :2, :2])[:, 1])  # along the worst direction
    fit = trajectory.calibration.odometry
    document: dict[str, Any] = {
        "frame": frame, "scans": len(trajectory), "key_scans": len(trajectory.keys),
        "map": {"scans": len(run.posterior.scans), "beams": run.posterior.scans.ranges_m.size},
        "loop_closures": int((trajectory.closures.weights > 0.5).sum()),
        "flagged": np.flatnonzero(trajectory.flagged).tolist(),
        "breaks": trajectory.breaks.tolist(), "leaps": trajectory.leaps.tolist(),
        "alternatives": [_alternative(trajectory, n) for n in range(len(trajectory.alternatives))],
        "sigma_m": {"median": float(np.median(sigma_m)), "max": float(sigma_m.max())},
        "angle_step_ratio": trajectory.calibration.angle_step_ratio,
        "odometry": None if fit is None else {"lag_s": fit.lag_s, "slope": fit.slope.tolist()},
    }  # fmt: skip
    if run.posterior.draws.count and run.posterior.settings["poses"]["kind"] != "known":
        poses = run.pose_summary()
        # With few draws a chain may never move a pose; that pose has no R-hat.
        document["sampled"] = {
            "sigma_m": float(np.median(poses.sigma_m)), "sigma_rad": float(np.median(poses.sigma_rad)),
            "by_approximation": poses.by_approximation, "ess_min": poses.ess_min,
            "rhat_max": float(poses.rhat[np.isfinite(poses.rhat)].max(initial=1.0)),
            "unmoved": int((~np.isfinite(poses.rhat)).any(axis=-1).sum()),
        }  # fmt: skip
    return document


def _alternative(trajectory: InferredTrajectory, number: int) -> dict[str, Any]:
    """Return an alternative as JSON values: its scans, its probability, and how far off its last scan lies."""
    import numpy as np

    from bayesmap.space.planar import between

    alternatives, poses = trajectory.alternatives, trajectory.alternative_poses(number)
    first, last = alternatives.first[number], alternatives.last[number]
    offset = between(between(trajectory.poses[first], trajectory.poses[last]), between(poses[first], poses[last]))
    return {
        "first": int(first), "last": int(last), "probability": float(alternatives.probabilities[number]),
        "off_m": float(np.hypot(offset[0], offset[1])), "off_degrees": float(np.degrees(np.abs(offset[2]))),
    }  # fmt: skip


def _good(trajectory: dict[str, Any]) -> list[str]:
    """Return sentences about the quality of the trajectory, whose `summarise` is given."""
    sampled, used, sigma_m = trajectory.get("sampled"), trajectory["map"], trajectory["sigma_m"]
    sentences = [
        f"the trajectory of the {trajectory['frame']} at {trajectory['scans']:,} scans, with "
        f"{trajectory['loop_closures']:,} loop closures: standard deviation {100 * sigma_m['median']:.1f} cm, "
        f"at most {100 * sigma_m['max']:.0f} cm"
    ]
    if sampled is None:
        beams = f"the map of {used['beams']:,} beams of {used['scans']:,} key scans, at the poses of the trajectory"
        sentences.append(f"{beams}; the others have seen the same (--sample-poses uses all beams of all key scans)")
    return sentences


def _notes(trajectory: dict[str, Any]) -> list[str]:
    """Return a sentence if the chains did not improve the trajectory, whose `summarise` is given."""
    sampled = trajectory.get("sampled")
    if sampled is None or not sampled["by_approximation"]:
        return []
    which = "poses and covariances are those of the approximation, also in scores and exports"
    mixing = f"R-hat up to {sampled['rhat_max']:.2f}, effective sample size from {sampled['ess_min']:.0f}"
    return [f"{which}, since the chains over poses were too short to replace it ({mixing})"]


def _doubtful(trajectory: dict[str, Any]) -> list[str]:
    """Return sentences about doubtful scans, breaks and alternatives, with a remedy."""
    doubtful = []
    if trajectory["flagged"]:
        doubt = "see what few others see: people, glass, a new place, or a wrong pose (one in two, in simulated logs)"
        remedy = "compare them with the map in trajectory.png, where they have crosses"
        doubtful.append(f"{len(trajectory['flagged'])} scans {doubt}; {remedy}: {_list_scans(trajectory['flagged'])}")
    if trajectory["breaks"]:
        doubt = "before these scans the robot seems to have been carried, or data are missing"
        remedy = "if it was not, look for gaps with bayesmap info"
        doubtful.append(f"{doubt}; {remedy}: {_list_scans(trajectory['breaks'])}")
    if trajectory["leaps"]:
        doubt = "before these scans the trajectory moves as odometry did not, which the scans before do not confirm"
        effect = "what lies before and after may be shifted against each other, as loops.png shows"
        doubtful.append(f"{doubt}; {effect}: {_list_scans(trajectory['leaps'])}")
    doubtful += [
        f"from scan {other['first']} to {other['last']} the trajectory hangs on one visit of places that look alike: "
        f"with probability {other['probability']:.2f} scan {other['last']} lies {other['off_m']:.1f} m and "
        f"{other['off_degrees']:.0f} degrees elsewhere, as in loops.png; covariances cover both"
        for other in trajectory["alternatives"][:MAX_ALTERNATIVES]
    ]
    if len(trajectory["alternatives"]) > MAX_ALTERNATIVES:
        doubtful.append(f"{len(trajectory['alternatives']) - MAX_ALTERNATIVES} more alternatives are in summary.json")
    return doubtful


def _list_scans(scans: list[int]) -> str:
    return ", ".join(map(str, scans[:MAX_LISTED_SCANS])) + (", ..." if len(scans) > MAX_LISTED_SCANS else "")
