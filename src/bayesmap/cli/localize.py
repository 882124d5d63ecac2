"""``bayesmap localize``: where in the map of a saved run was each scan of a log taken, and how sure is that?"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.command import Call, takes
from bayesmap.cli.console import INTERRUPTED, Console, write_out
from bayesmap.cli.keys import LocalizeSettings
from bayesmap.cli.logs import is_map, need_file
from bayesmap.cli.progress import share
from bayesmap.cli.translation import reading_of
from bayesmap.cli.typed import numbers_of
from bayesmap.errors import BadInput
from bayesmap.version import __version__

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bayesmap.localization.belief import PoseBelief
    from bayesmap.localization.known_map import KnownMap
    from bayesmap.localization.localize import Localization, Near
    from bayesmap.result import Run
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans

IMAGES = (".pgm", ".png", ".bmp")
ENDINGS = (".tum", ".mcap", ".bag", ".db3", ".jsonl")


@takes("localize")
@click.argument("run_file", metavar="RUN.nc|MAP.yaml")
@click.argument("log")
@click.option("-o", "--output", metavar="FILE", help=f"Trajectory: {', '.join(ENDINGS)}.")
@click.option("--follow", is_flag=True, help="A JSON line on standard output for each scan, as it comes; see below.")
@click.option(
    "--for", "idle_s", type=click.FloatRange(min=0), metavar="SECONDS", help="With --follow: the longest wait."
)
@click.option("--prior", metavar="X,Y,DEGREES[,M,DEGREES]", help="First pose, and its standard deviations.")
@click.option("--independent", is_flag=True, help="Locate each scan by itself; without the log's poses.")
@click.option("--scans", "span", metavar="FIRST:LAST", help="Only these scans of the log, from 0; LAST is left out.")
@click.option("--area", metavar="X0,X1,Y0,Y1", help="Also the probability of being in this rectangle, in metres.")
@click.option("--force", is_flag=True, help="Replace an existing file.")
def localize(
    call: Call[LocalizeSettings],
    run_file: str,
    log: str,
    output: str | None,
    follow: bool,
    idle_s: float | None,
    prior: str | None,
    independent: bool,
    span: str | None,
    area: str | None,
    force: bool,
) -> None:
    r"""Locate the scans of LOG in the map of a saved run, or of another program: the posterior of each pose.

    \b
    bayesmap localize runs/office/run.nc today.bag -o today.tum
    bayesmap localize runs/office/run.nc now.log --follow | jq .mean
    bayesmap localize runs/office/run.nc today.bag --scans 0:1
    bayesmap localize map.yaml today.bag -o today.tum

    With --follow LOG may be a CARMEN log or a CSV table that is being written: new lines are waited for until Ctrl-C,
    or for as long as --for says. A pipe, or - for standard input, ends when its writer does. Other formats end where
    the file ends.

    The first scan may be anywhere on the map, unless --prior says where. From scan to scan the log's poses are taken
    for odometry: only motions count. Answers: the likeliest place with its covariance, all places with their
    probabilities, and the probability of being lost: that the scan is as scans are elsewhere, or the map outdated.

    A map of another program (map_server YAML) says nothing of the sensor or of its own errors: a law is fitted to those
    scans of LOG that are surely located under a wary one, and told. With --follow the wary law is taken.
    """
    settings = call.settings()
    from bayesmap.io.logs import describe_log
    from bayesmap.localization.localize import Localization, localize

    if idle_s is not None and not follow:
        raise click.UsageError("--for says how long --follow waits: give both")
    target = None if output is None else _target(output, force)
    near, corners = _near(prior), _area(area)
    live = follow and can_follow(call.console, log)
    if not live:
        need_file(log, "the log whose scans are to be located", runs=False)
    place = _Map.of(run_file, settings)
    seed = settings.seed

    def tell(number: int, belief: PoseBelief) -> bool:
        return write_out(json.dumps({"scan": number, **_answer(belief, corners)}, allow_nan=False) + "\n")

    interrupted = False
    if live:
        to_come = scans_to_come(
            call.console, log, settings, place.max_range_live_m, span, idle_s, without_poses=independent
        )
        call.console.detail(f"{log}: waiting for scans")
        found_live = place.located_live(call, to_come, prior=near, independent=independent, seed=seed)
        beliefs, interrupted = located(found_live, tell)
        if not beliefs:
            raise BadInput(f"{log}: it ended without a scan")
        found = Localization(tuple(beliefs))
    else:
        reading = describe_log(log, max_range_m=place.max_range_m, **reading_of(settings), without_poses=independent)
        for note in reading.notes:
            call.console.say(f"{log}: {note}")
        scans = reading.scans
        scans = scans.select(_slice(span, len(scans)))
        known = place.known(call, scans)
        with share(call.console, "locating scans") as report:

            def on_belief(number: int, belief: PoseBelief) -> None:
                report((number + 1) / len(scans))
                if follow:
                    tell(number, belief)

            found = localize(known, scans, prior=near, independent=independent, seed=seed, on_belief=on_belief)
    outputs = [] if target is None else _write(target, found)
    lost = sum(belief.p_lost > 0.5 for belief in found.beliefs)
    if lost:
        call.console.warn(f"{lost:,} of {len(found):,} scans fit nowhere on the map: lost, or the map is outdated")
    if interrupted:
        click.get_current_context().exit(INTERRUPTED)
    if follow:
        return
    if call.console.as_json:
        document = {
            "version": __version__,
            "run": run_file,
            "log": log,
            "scans": len(found),
            "lost": lost,
            "last": _answer(found.last, corners),
            "outputs": {path.name: str(path) for path in outputs},
        }
        call.console.result(document, outputs)
    else:
        write_out("".join(f"{line}\n" for line in [*_lines(found, corners), *(str(path) for path in outputs)]))


@dataclass(frozen=True, eq=False)
class _Map:
    """The map of a run, or that of another program: its occupancy, NaN where unknown, and its grid."""

    settings: LocalizeSettings
    run: Run | None = None
    external: tuple[NDArray[np.float64], Grid] | None = None

    @classmethod
    def of(cls, file: str, settings: LocalizeSettings) -> _Map:
        """Read it, by the ending of its name."""
        if is_map(file):
            from bayesmap.io.ros.maps import read_map

            need_file(file, "a saved run (.nc), or a map of map_server (.yaml)", runs=True)
            return cls(settings, external=read_map(file))
        from bayesmap.result import load

        if Path(file).suffix.lower() in IMAGES and Path(file).exists():
            raise BadInput(f"{file}: the image of a map; give the YAML file that names it and says where it lies")
        return cls(settings, run=load(file))

    @property
    def max_range_m(self) -> float | None:
        """Largest range of the run's sensor; None: as the log says."""
        return None if self.run is None else self.run.posterior.scans.max_range_m

    @property
    def max_range_live_m(self) -> float:
        """The same for a log that is still written: in another program's map, from one of its corners to the other."""
        if self.external is None:
            assert self.run is not None
            return self.run.posterior.scans.max_range_m
        grid = self.external[1]
        return grid.resolution * math.hypot(*grid.shape)

    def known(self, call: Call[LocalizeSettings], scans: Scans, *, fit: bool = True) -> KnownMap:
        """The map, ready to locate scans in; of another program's the law is fitted to them first."""
        from bayesmap.localization.external_map import external_map, fit_law
        from bayesmap.localization.known_map import KnownMap

        how: dict[str, Any] = {"beam_weight": self.settings.beam_weight, "device": self.settings.device}
        if self.run is not None:
            return KnownMap.of_run(self.run, **how)
        assert self.external is not None
        law = None
        if fit:
            with share(call.console, "fitting what the map means") as report:
                law = fit_law(*self.external, scans, self.settings.seed, report)
            call.console.say(law.words())
        return external_map(*self.external, scans, law, **how)

    def located_live(self, call: Call[LocalizeSettings], scans: Iterator[Scans], **how: Any) -> Iterator[PoseBelief]:
        """The posteriors of scans that are still to come: another program's map is taken by the assumed law."""
        from bayesmap.localization.localize import follow_live

        for first in scans:
            known = self.known(call, first, fit=False)
            yield from follow_live(known, itertools.chain([first], scans), **how)


def _answer(belief: PoseBelief, corners: list[float] | None) -> dict[str, Any]:
    answer = belief.as_json()
    if corners is not None:
        answer["probability_in_area"] = belief.probability_in(corners)  # type: ignore[arg-type]
    return answer


def _lines(found: Localization, corners: list[float] | None) -> list[str]:
    lines = []
    for mode in found.modes[:5]:
        (x, y, yaw), sd = mode.mean, [math.sqrt(v) for v in mode.covariance.diagonal()]
        lines.append(
            f"{100 * mode.probability:5.1f} %  x {x:.3f} +- {sd[0]:.3f} m  y {y:.3f} +- {sd[1]:.3f} m  "
            f"yaw {math.degrees(yaw):.2f} +- {math.degrees(sd[2]):.2f} degrees"
        )
    lines.append(f"lost, or the map outdated: {_per_cent(found.p_lost)} %")
    if corners is not None:
        lines.append(f"in the area: {100 * found.probability_in(corners):.1f} %")
    return lines


def _per_cent(probability: float) -> str:
    """Two digits of what is small, a tenth of a per cent of what is not."""
    if 0.0 < probability < 1e-4:
        return "under 0.01"
    return f"{100 * probability:.2g}" if probability < 0.1 else f"{100 * probability:.1f}"


def _write(target: Path, found: Localization) -> list[Path]:
    from bayesmap.files import write_whole
    from bayesmap.io.exports import export_trajectory

    if target.suffix != ".jsonl":
        return list(export_trajectory(target, found.trajectory()))
    with write_whole(target) as partial:
        rows = (json.dumps({"scan": i, **b.as_json()}, allow_nan=False) for i, b in enumerate(found.beliefs))
        partial.write_text("".join(f"{row}\n" for row in rows), encoding="ascii")
    return [target]


def _target(output: str, force: bool) -> Path:
    target = Path(output)
    if target.suffix.lower() not in ENDINGS:
        raise click.UsageError(f"-o {output}: end its name in one of {', '.join(ENDINGS)}")
    if target.exists() and not force:
        raise BadInput(f"{target}: exists already; --force replaces it, -o takes another name")
    if not target.parent.is_dir():
        raise BadInput(f"{target.parent}: no such folder; make it first, or choose another with -o")
    return target


def _near(text: str | None) -> Near | None:
    from bayesmap.localization.localize import Near

    if text is None:
        return None
    x, y, degrees, *spread = numbers_of(text, "--prior", "X,Y,DEGREES or X,Y,DEGREES,M,DEGREES", (3, 5))
    pose = (x, y, math.radians(degrees))
    return Near(pose, spread[0], math.radians(spread[1])) if spread else Near(pose)


def _area(text: str | None) -> list[float] | None:
    if text is None:
        return None
    x0, x1, y0, y1 = corners = numbers_of(text, "--area", "X0,X1,Y0,Y1", (4,))
    if not (x0 < x1 and y0 < y1):
        raise BadInput(f"--area {text}: give X0 below X1, and Y0 below Y1")
    return corners


def _slice(text: str | None, count: int) -> slice:
    if text is None:
        return slice(None)
    first, colon, last = text.partition(":")
    try:
        chosen = slice(int(first) if first else None, int(last) if last else None)
    except ValueError:
        colon = ""
    if not colon:
        raise click.BadParameter(f"{text!r} is not FIRST:LAST", param_hint="'--scans'")
    if not range(count)[chosen]:
        raise BadInput(f"--scans {text}: none of the log's {count:,} scans is among them")
    return chosen


RECORDED = ("scan_topic", "pose_topic", "fixed_frame")
"""Settings that only recordings have."""


def can_follow(console: Console, log: str) -> bool:
    """Whether a log can be followed; if not, the user is told that it ends where it ends now."""
    from bayesmap.io.live import STANDARD_INPUT, can_be_followed

    if log not in STANDARD_INPUT:
        need_file(log, "the log whose scans are to be located", runs=False, pipes=True)
    if can_be_followed(log):
        return True
    console.warn(
        f"{log}: only CARMEN logs and CSV tables can be followed while they are written, as text; of this file the "
        "scans that it holds now are located"
    )
    return False


def scans_to_come(
    console: Console,
    log: str,
    settings: LocalizeSettings,
    max_range_m: float,
    span: str | None,
    idle_s: float | None,
    *,
    without_poses: bool = False,
) -> Iterator[Scans]:
    """The scans of a log that can be followed, one at a time, as its settings say.

    Args:
        console: told of lines that are left out.
        log: a file, a pipe, or "-".
        settings: of the command.
        max_range_m: of the run.
        span: FIRST:LAST of the scans to come, or None for all.
        idle_s: the end, when nothing has come for so long; None: wait on.
        without_poses: whether tables without poses will do.

    Raises:
        BadInput: a setting that only recordings have.
    """
    from bayesmap.io.live import live_scans

    for name in RECORDED:
        value = getattr(settings, name)
        if value is not None:
            raise BadInput(f"{log}: --{name.replace('_', '-')} {value}: a text has no topics and no frames")
    first, last = _ends(span)
    scans = live_scans(
        log,
        max_range_m=max_range_m,
        no_return=settings.no_return,
        skip_bad_lines=settings.skip_bad_lines,
        idle_s=idle_s,
        on_skipped=lambda line, reason: console.say(f"{log}: line {line} left out: {reason}"),
        laser=reading_of(settings)["laser"],
        without_poses=without_poses,
    )
    return itertools.islice(_thinned(scans, settings.thin_scans), first, last)


def located(beliefs: Iterable[PoseBelief], tell: Callable[[int, PoseBelief], bool]) -> tuple[list[PoseBelief], bool]:
    """Take posteriors as they come, until there are no more, nobody listens, or Ctrl-C.

    Args:
        beliefs: one a scan.
        tell: given each with its number; whether somebody listens.

    Returns:
        All of them, and whether Ctrl-C was the end.
    """
    found: list[PoseBelief] = []
    try:
        for number, belief in enumerate(beliefs):
            found.append(belief)
            if not tell(number, belief):
                break
    except KeyboardInterrupt:
        if not found:
            raise
        return found, True
    return found, False


def _ends(span: str | None) -> tuple[int, int | None]:
    first, colon, last = (span or ":").partition(":")
    try:
        ends = int(first or 0), int(last) if last else None
    except ValueError:
        colon = ""
    if not colon or ends[0] < 0 or (ends[1] is not None and ends[1] <= ends[0]):
        raise click.BadParameter(f"{span!r} is not FIRST:LAST of scans to come", param_hint="'--scans'")
    return ends


def _thinned(scans: Iterable[Scans], spacing_m: float) -> Iterator[Scans]:
    """The first scan, and then each by which the robot has travelled so far since the last one kept."""
    travelled_m, at = math.inf, None
    for scan in scans:
        x, y = scan.poses[0, :2]
        if at is not None:
            travelled_m += math.hypot(x - at[0], y - at[1])
        at = (x, y)
        if travelled_m >= spacing_m * (1 - 1e-9):
            travelled_m = 0.0
            yield scan
