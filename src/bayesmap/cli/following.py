"""`bayesmap localize --follow`: each scan of a log that is still being written is located as it comes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli.console import Console
from bayesmap.cli.input_files import need_file
from bayesmap.cli.reading import options_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.localization.belief import PoseBelief
    from bayesmap.space.scans import Scans

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
    values: dict[str, Any],
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
        values: the command's settings.
        max_range_m: of the run.
        span: FIRST:LAST of the scans to come, or None for all.
        idle_s: the end, when nothing has come for so long; None: wait on.
        without_poses: whether tables without poses will do.

    Raises:
        BadInput: a setting that only recordings have.
    """
    from bayesmap.io.live import live_scans

    for name in RECORDED:
        if values[name] is not None:
            raise BadInput(f"{log}: --{name.replace('_', '-')} {values[name]}: a text has no topics and no frames")
    first, last = _ends(span)
    scans = live_scans(
        log,
        max_range_m=max_range_m,
        no_return=values["no_return"],
        skip_bad_lines=values["skip_bad_lines"],
        idle_s=idle_s,
        on_skipped=lambda line, reason: console.say(f"{log}: line {line} left out: {reason}"),
        laser=options_of(values)["laser"],
        without_poses=without_poses,
    )
    return itertools.islice(_thinned(scans, values["thin_scans"]), first, last)


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
