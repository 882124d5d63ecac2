"""``bayesmap localize``: the posterior of the pose of each scan of a log, in the map of a saved run.

`localize` parses the arguments into a `_Request`, and locates the scans of a log that is complete (`_locate_scans`) or
still being written (`_locate_live`). Both fill `_Posteriors`, from which the output is made.
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import FORCE, Call, command
from bayesmap.cli.console import Console, exit_unless_good, share_bar, write_lines, write_out
from bayesmap.cli.keys import LocalizeSettings
from bayesmap.cli.translation import corners_of, initial_pose_of, is_map, log_options_of, need_file, need_free, slice_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.localization.belief import PoseBelief
    from bayesmap.localization.known_map import KnownMap
    from bayesmap.localization.localize import InitialPose, Localization
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans

IMAGE_ENDINGS = (".pgm", ".png", ".bmp")  # endings of the images that the YAML file of a map names
OUTPUT_ENDINGS = (".tum", ".mcap", ".bag", ".db3", ".jsonl")  # endings of the files that -o may name
MAX_NAMED_STRETCHES = 5  # number of stretches of consecutive lost scans that are named
MAX_P_LOST = 0.5  # probability of being lost above which a scan counts as lost
MAX_MODES = 5  # number of modes of the last pose that are printed

PrintBelief = Callable[[int, "PoseBelief"], bool]  # prints a scan's posterior; False if nobody reads it any more


@command("localize")
@click.argument("run_file", metavar="RUN.nc|MAP.yaml")
@click.argument("log")
@click.option("-o", "--output", metavar="FILE", help=f"Trajectory, without lost scans: {', '.join(OUTPUT_ENDINGS)}.")
@click.option("--follow", is_flag=True, help="Print a JSON line for each scan as it arrives (see above).")
@click.option(
    "--for", "idle_s", type=click.FloatRange(min=0), metavar="SECONDS", help="With --follow: the longest wait."
)
@click.option("--prior", metavar="X,Y,DEGREES[,M,DEGREES]", help="First pose, and its standard deviations.")
@click.option("--independent", is_flag=True, help="Locate each scan by itself, without the log's poses.")
@click.option("--scans", "span", metavar="FIRST:LAST", help="Only these scans of the log, from 0; LAST is excluded.")
@click.option("--area", metavar="X0,X1,Y0,Y1", help="Also print the probability of being in this rectangle, in metres.")
@FORCE
def localize(
    call: Call[LocalizeSettings], run_file: str, log: str, output: str | None, follow: bool, idle_s: float | None,
    prior: str | None, independent: bool, span: str | None, area: str | None, force: bool,
) -> None:  # fmt: skip
    r"""Compute the posterior of the pose of each scan of LOG, in the map of a saved run or of another program.

    \b
    bayesmap localize runs/office/run.nc today.bag -o today.tum
    bayesmap localize runs/office/run.nc now.log --follow | jq .mean
    bayesmap localize runs/office/run.nc today.bag --scans 0:1
    bayesmap localize map.yaml today.bag -o today.tum

    With --follow LOG may be a CARMEN log or a CSV table that is still being written. The command then waits for new
    lines until Ctrl-C, or for the seconds of --for. A pipe, or - for standard input, ends when its writer ends. Other
    formats end at the end of the file.

    The first scan may be anywhere on the map, unless --prior gives its pose. The log's poses serve as odometry: only
    motions between scans count. The command returns the likeliest pose with its covariance, all likely poses with
    their probabilities if the robot is not lost, and the probability that it is: the scan comes from outside the map,
    or is blocked, or the map is outdated.

    Poses, also in --prior and --area, are poses of the robot's base, if the log says where the laser sits on it, and
    else of the laser (--frame). Scans are numbered as in the log, from 0.

    A map of another program (map_server YAML) has no sensor law. The command first locates scans under a cautious
    sensor law. It then fits the law to the scans located with certainty, and prints it (not with --follow).
    """
    if idle_s is not None and not follow:
        raise click.UsageError("--for says how long --follow waits: give both")
    target = None if output is None else _checked_path(output, force)
    first_pose = initial_pose_of(prior)
    corners = corners_of(area)
    live = follow and _can_follow(call.console, log)
    if not live:
        need_file(log, "the log whose scans are to be located", runs=False)
    request = _Request(call, log, _read_map(run_file, call.settings()), span, first_pose, independent)

    def print_belief(number: int, belief: PoseBelief) -> bool:
        return write_out(json.dumps({"scan": number, **_belief_json(belief, corners)}, allow_nan=False) + "\n")

    interrupted = False
    if live:
        posteriors, interrupted = _locate_live(request, idle_s, print_belief)
    else:
        posteriors = _locate_scans(request, print_belief if follow else None)
    localization, lost = posteriors.localization, posteriors.lost_scans()
    if lost:
        share, which = f"{len(lost):,} of {len(localization):,} scans", posteriors.describe_stretches(lost)
        call.console.warn(f"{share} are probably off the map, or blocked, or the map is outdated: {which}")
    # Write the file and print the posterior, unless it has been printed scan by scan.
    nothing_to_write = target is not None and target.suffix != ".jsonl" and len(lost) == len(localization)
    outputs = [] if target is None or nothing_to_write else _write(target, posteriors)
    if not follow and call.console.as_json:
        document = {
            "run": run_file, "log": log, "scans": len(localization), "lost": len(lost), "lost_scans": lost,
            "frame": localization.frame, "last": _belief_json(localization.last, corners),
            "outputs": {path.name: str(path) for path in outputs},
        }  # fmt: skip
        call.console.result(document, outputs)
    elif not follow:
        write_lines([*_describe_last_pose(posteriors, corners), *outputs])
    if nothing_to_write:
        raise BadInput(f"{target}: not written, since all scans are lost; .jsonl has the posteriors of lost scans, too")
    exit_unless_good(finished=not interrupted, problems=False)


@dataclass(frozen=True, eq=False)
class _Request:
    """The scans of a log that are to be located in a map."""

    call: Call[LocalizeSettings]
    log: str  # path of the log, as typed
    map: _MapSource
    span: str | None  # scans to locate, as FIRST:LAST; None for all
    first_pose: InitialPose | None  # prior of the first pose; None if it may be anywhere
    independent: bool  # locate each scan by itself

    def options(self, mount: NDArray[np.float64] | None) -> dict[str, Any]:
        """Return the arguments of localization, given the pose of the laser on the robot, (3,), if it is known."""
        from bayesmap.space.planar import compose
        from bayesmap.space.trajectory import step_to

        prior, settings = self.first_pose, self.call.settings()
        # Localization takes a prior of the laser, not of the base.
        if step_to(settings.frame, mount, "laser")[0] == "base" and prior is not None:
            prior = replace(prior, pose=compose(prior.pose, mount))  # type: ignore[arg-type]
        return {"prior": prior, "independent": self.independent, "seed": settings.seed}


@dataclass(eq=False)
class _Posteriors:
    """The posteriors of scans of a log."""

    frame: str | None  # frame of the answers, as typed
    mount: NDArray[np.float64] | None  # pose of the laser on the robot, (3,), if it is known
    first: int  # number of the first scan in the log
    start_s: float | None  # stamp from which times count; None without stamps
    beliefs: list[PoseBelief] = field(default_factory=list)  # posterior of the laser's pose at each scan

    def latest(self) -> tuple[int, PoseBelief]:
        """Return the number of the latest scan, and the posterior of the pose of `frame`."""
        from bayesmap.localization.localize import Localization

        latest = Localization(tuple(self.beliefs[-1:])).of(self.frame, self.mount)
        return self.first + len(self.beliefs) - 1, latest.last

    @cached_property
    def localization(self) -> Localization:
        """The posteriors of all poses of `frame`. Read it when all scans are located, since it is computed once."""
        from bayesmap.localization.localize import Localization

        return Localization(tuple(self.beliefs)).of(self.frame, self.mount)

    def lost_scans(self) -> list[int]:
        """Return the numbers of the scans that are probably lost."""
        return [self.first + i for i, belief in enumerate(self.beliefs) if belief.p_lost > MAX_P_LOST]

    def describe(self, first: int, last: int) -> str:
        """Return a scan, or the scans from the first to the last, in words, with their times."""
        numbers = f"scan {first}" if first == last else f"scans {first} to {last}"
        stamps_s = [self.beliefs[number - self.first].stamp_s for number in (first, last)]
        if self.start_s is None or None in stamps_s:
            return numbers
        times = dict.fromkeys(f"{stamp_s - self.start_s:.1f}" for stamp_s in stamps_s)  # type: ignore[operator]
        return f"{numbers} (at {' to '.join(times)} s)"

    def describe_stretches(self, scans: list[int]) -> str:
        """Return ascending numbers of scans in words: the first and the last of each stretch of consecutive scans."""
        starts = [scan for i, scan in enumerate(scans) if i == 0 or scans[i - 1] != scan - 1]
        ends = [scan for i, scan in enumerate(scans) if i == len(scans) - 1 or scans[i + 1] != scan + 1]
        stretches = list(zip(starts, ends, strict=True))
        words = [self.describe(start, end) for start, end in stretches[:MAX_NAMED_STRETCHES]]
        n_more = len(stretches) - len(words)
        return ", ".join(words) + (f", and {n_more:,} more stretches" if n_more > 0 else "")


def _locate_scans(request: _Request, print_belief: PrintBelief | None) -> _Posteriors:
    """Locate the scans that a log holds now, and print the posterior of each, if it is to be printed."""
    from bayesmap.io.logs import describe_log
    from bayesmap.localization.localize import localize

    call, path = request.call, request.log
    log_options = log_options_of(call.settings())
    log = describe_log(path, max_range_m=request.map.max_range_m, without_poses=request.independent, **log_options)
    for note in log.notes:
        call.console.say(f"{path}: {note}")
    span = slice_of(request.span, len(log.scans))
    scans = log.scans.select(span)
    first = range(len(log.scans))[span][0]
    start_s = None if log.scans.stamps_s is None else log.scans.stamps_s[0]
    posteriors = _Posteriors(call.settings().frame, scans.mount, first, start_s)
    options = request.options(scans.mount)
    known_map = request.map.prepare(call.console, scans, live=False)
    with share_bar(call.console, "locating scans") as report:

        def on_belief(number: int, belief: PoseBelief) -> None:
            report((number + 1) / len(scans))
            posteriors.beliefs.append(belief)
            if print_belief is not None:
                print_belief(*posteriors.latest())

        localize(known_map, scans, on_belief=on_belief, **options)
    return posteriors


def _locate_live(request: _Request, idle_s: float | None, print_belief: PrintBelief) -> tuple[_Posteriors, bool]:
    """Locate scans as they arrive, until the log or the output ends. Returns also whether Ctrl-C ended them."""
    from bayesmap.localization.localize import follow

    scans = _live_scans_of(request, idle_s)
    request.call.console.detail(f"{request.log}: waiting for scans")
    posteriors = _Posteriors(request.call.settings().frame, None, slice_of(request.span).start or 0, None)
    interrupted = False
    try:
        # Prepare the map with the first scan: an external map takes the law of readings from it.
        for first in scans:
            posteriors.mount, posteriors.start_s = first.mount, None if first.stamps_s is None else first.stamps_s[0]
            options = request.options(first.mount)
            known_map = request.map.prepare(request.call.console, first, live=True)
            for belief in follow(known_map, itertools.chain([first], scans), **options):
                posteriors.beliefs.append(belief)
                if not print_belief(*posteriors.latest()):
                    return posteriors, False
    except KeyboardInterrupt:
        if not posteriors.beliefs:
            raise
        interrupted = True
    if not posteriors.beliefs:
        raise BadInput(f"{request.log}: it ended without a scan")
    return posteriors, interrupted


@dataclass(frozen=True, eq=False)
class _MapSource:
    """The map in which scans are located: that of a saved run, or of another program."""

    max_range_m: float | None  # largest range of the sensor; if None, as in the log
    live_max_range_m: float  # largest range for a log that is still being written
    prepare: Callable[..., KnownMap]  # prepares the map, given the console, scans, and whether their log is `live`


def _read_map(file: str, settings: LocalizeSettings) -> _MapSource:
    """Read a map. The ending of the name distinguishes a saved run from a map of another program."""
    if is_map(file):
        from bayesmap.io.ros.maps import read_map

        need_file(file, "a saved run (.nc), or a map of map_server (.yaml)", runs=True)
        occupancy, grid = read_map(file)
        diagonal_m = grid.resolution * math.hypot(*grid.shape)
        return _MapSource(None, diagonal_m, partial(_external_map, occupancy, grid, settings))
    from bayesmap.localization.known_map import KnownMap
    from bayesmap.result import load

    if Path(file).suffix.lower() in IMAGE_ENDINGS and Path(file).exists():
        raise BadInput(f"{file}: the image of a map; give the YAML file that names it and says where it lies")
    run = load(file)
    max_range_m = run.posterior.scans.max_range_m
    known_map = partial(KnownMap.of_run, run, beam_weight=settings.beam_weight, device=settings.device)
    return _MapSource(max_range_m, max_range_m, lambda *_, **__: known_map())


def _external_map(
    occupancy: NDArray[np.float64], grid: Grid, settings: LocalizeSettings, console: Console, scans: Scans, live: bool
) -> KnownMap:
    """Return a map with a sensor law: fitted to the scans, or the cautious default for a live log."""
    from bayesmap.localization.external_map import external_map, fit_law

    law = None
    if not live:
        with share_bar(console, "fitting the map's occupied, free and unknown cells") as report:
            law = fit_law(occupancy, grid, scans, settings.seed, report)
        console.say(law.words())
    return external_map(occupancy, grid, scans, law, beam_weight=settings.beam_weight, device=settings.device)


def _belief_json(belief: PoseBelief, corners: list[float] | None) -> dict[str, Any]:
    """Return a posterior as JSON values, with the probability of the area if there is one."""
    document = belief.as_json()
    if corners is not None:
        document["probability_in_area"] = belief.probability_in(corners)  # type: ignore[arg-type]
    return document


def _describe_last_pose(posteriors: _Posteriors, corners: list[float] | None) -> list[str]:
    """Describe the last pose in lines of text: likeliest modes, probability of being lost, probability of the area."""
    localization, last = posteriors.localization, posteriors.first + len(posteriors.beliefs) - 1
    lines = [f"the {localization.frame} at {posteriors.describe(last, last)}, if it is not lost:"]
    for mode in localization.modes[:MAX_MODES]:
        (x, y, yaw), sd = mode.mean, [math.sqrt(variance) for variance in mode.covariance.diagonal()]
        position = f"x {x:.3f} +- {sd[0]:.3f} m  y {y:.3f} +- {sd[1]:.3f} m"
        heading = f"yaw {math.degrees(yaw):.2f} +- {math.degrees(sd[2]):.2f} degrees"
        lines.append(f"{100 * mode.probability:5.1f} %  {position}  {heading}")
    lines.append(f"lost (off the map, the scan blocked, or the map outdated): {_per_cent(localization.p_lost)} %")
    if corners is not None:
        lines.append(f"not lost, and in the area: {100 * localization.probability_in(corners):.1f} %")
    return lines


def _per_cent(probability: float) -> str:
    """Return a probability in per cent: two significant digits below 10 %, one decimal above."""
    if 0.0 < probability < 1e-4:
        return "under 0.01"
    return f"{100 * probability:.2g}" if probability < 0.1 else f"{100 * probability:.1f}"


def _write(target: Path, posteriors: _Posteriors) -> list[Path]:
    """Write the trajectory without lost scans, of which not all are lost, or all posteriors for .jsonl."""
    from bayesmap.files import write_file
    from bayesmap.io.exports import export_trajectory

    localization = posteriors.localization
    if target.suffix == ".jsonl":
        numbered = enumerate(localization.beliefs, posteriors.first)
        return [write_file(target, (json.dumps({"scan": i, **b.as_json()}, allow_nan=False) for i, b in numbered))]
    lost = [belief.p_lost > MAX_P_LOST for belief in localization.beliefs]
    if target.suffix == ".tum":
        return list(export_trajectory(target, localization.trajectory(), lost=lost))
    not_lost = tuple(belief for belief, is_lost in zip(localization.beliefs, lost, strict=True) if not is_lost)
    return list(export_trajectory(target, replace(localization, beliefs=not_lost).trajectory()))


def _checked_path(output: str, force: bool) -> Path:
    """Return the output path, after checking its ending and that it may be written."""
    from bayesmap.io.text.trajectories import covariances_path

    target = Path(output)
    if target.suffix.lower() not in OUTPUT_ENDINGS:
        raise click.UsageError(f"-o {output}: end its name in one of {', '.join(OUTPUT_ENDINGS)}")
    need_free([target, covariances_path(target)] if target.suffix == ".tum" else [target], force=force)
    if not target.parent.is_dir():
        raise BadInput(f"{target.parent}: no such folder; make it first, or choose another with -o")
    return target


def _can_follow(console: Console, log: str) -> bool:
    """Return whether a log can be followed; if not, warn that only the scans that it holds now are located."""
    from bayesmap.io.live import STANDARD_INPUT, can_be_followed

    if log not in STANDARD_INPUT:
        need_file(log, "the log whose scans are to be located", runs=False, pipes=True)
    if can_be_followed(log):
        return True
    reason = "only CARMEN logs and CSV tables can be followed while they are written, as text"
    console.warn(f"{log}: {reason}; only the scans that it holds now are located")
    return False


def _live_scans_of(request: _Request, idle_s: float | None) -> Iterator[Scans]:
    """Return a live log's scans, until none arrives for ``idle_s``. Raises `BadInput` for settings of other logs."""
    from bayesmap.io.live import live_scans

    log = request.log
    settings = request.call.settings()
    for name in ("scan_topic", "pose_topic", "fixed_frame", "trajectory"):
        value = getattr(settings, name)
        if value is not None:
            raise BadInput(f"{log}: --{name.replace('_', '-')} {value}: a log that is followed has its own poses alone")
    span = slice_of(request.span)
    scans = live_scans(
        log, max_range_m=request.map.live_max_range_m, no_return=settings.no_return, idle_s=idle_s,
        skip_bad_lines=settings.skip_bad_lines, laser=log_options_of(settings)["laser"],
        without_poses=request.independent,
        on_skipped=lambda line, reason: request.call.console.say(f"{log}: line {line} left out: {reason}"),
    )  # fmt: skip
    return itertools.islice(_thin(scans, settings.thin_scans), span.start or 0, span.stop)


def _thin(scans: Iterable[Scans], spacing_m: float) -> Iterator[Scans]:
    """Yield the first scan, and then a scan each time the robot has travelled ``spacing_m``."""
    travelled_m, previous_position = math.inf, None
    for scan in scans:
        position = scan.poses[0, :2]
        travelled_m += 0.0 if previous_position is None else math.dist(position, previous_position)
        previous_position = position
        if travelled_m >= spacing_m * (1 - 1e-9):  # sums of steps round
            travelled_m = 0.0
            yield scan
