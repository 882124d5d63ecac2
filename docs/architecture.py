"""Draws docs/images/architecture.svg, the way of one beam through the source: `python docs/architecture.py`.

Each step below is a row of the picture: what the beam is before it, what is done, where, and what else comes in. The
tests hold that all files and folders named here exist and that the committed picture is the one that this draws.
"""

from __future__ import annotations

from html import escape
from pathlib import Path
from typing import NamedTuple

PICTURE = Path(__file__).with_name("images") / "architecture.svg"


class Step(NamedTuple):
    """A row of the picture.

    Attributes:
        is_: what the beam is when it gets here: a name, and an example or its arrays, one entry a line.
        does: what is done with it, one entry a line.
        where: files and folders of src/bayesmap that do it.
        beside: what else comes in, and the files and folders that it is from.
        leaves: whether it goes out instead.
    """

    is_: tuple[str, ...]
    does: tuple[str, ...]
    where: tuple[str, ...]
    beside: tuple[str, ...]
    leaves: bool = False


STEPS = (
    Step(
        ("a line of a log", "FLASER 181 4.02 3.18 ... 1.20 0.40 0.31"),
        ("Read it", "recognise the file; type each reading: hit, no return,", "too close, invalid"),
        ("io/logs.py", "io/text/carmen.py"),
        ("recordings", "ROS bags, MCAP, g2o, CSV", "io/ros/recording.py"),
    ),
    Step(
        ("a reading of Scans", "ranges_m[s, a] = 3.18, angles_rad[a],", "poses[s] = (x, y, yaw)"),
        ("State the problem", "check the arguments, choose what was left open"),
        ("api.py", "space/scans.py", "cells/kinds.py"),
        ("grid", "shape, resolution, origin", "space/grid.py"),
    ),
    Step(
        ("a beam in the world", "start, direction, range_m = 3.18"),
        ("Trace it through the grid", "which cells it crosses, where it enters and leaves them"),
        ("beams/rays.py", "kernels/walk.py"),
        ("poses of the scans", "known, uncertain, odometry", "poses/"),
    ),
    Step(
        ("its crossings", "cell k = 1, 2, ..., entry_m, exit_m"),
        (
            "Weigh where it stopped",
            "p(z) = Σ Tₖ aₖ p(z | stop k) + T p(z | no stop),",
            "Tₖ = Π (1 - aⱼ) over the cells before k, T over all",
        ),
        ("model.py", "beams/rays.py", "kernels/sensor_law.py"),
        ("aₖ and p(z | stop k)", "kinds of cells, sensor models", "cells/", "sensors/"),
    ),
    Step(
        ("a weight for every cell on its way", "how likely it stopped there"),
        ("Draw new cells given all beams", "sweep after sweep; fit the sensor while warming up"),
        ("samplers/", "kernels/"),
        ("random numbers", "of (seed, chain, sweep, site)", "kernels/random.py"),
    ),
    Step(
        ("its part of a chain's state", "cells passed, the cell that stopped it"),
        ("Run the chains", "on threads; keep draws, report progress, write", "checkpoints, stop on Ctrl-C and resume"),
        ("run/", "io/saved.py"),
        ("run.nc", "one netCDF file", "io/saved.py"),
        leaves=True,
    ),
    Step(
        ("its trace in the draws", "draws[chain, draw, x, y]"),
        ("Sum them up", "mean, intervals, R-hat; the density of beams that were", "held out"),
        ("posterior/", "result.py"),
        ("scores", "held-out beams, calibration", "posterior/scores.py"),
        leaves=True,
    ),
    Step(
        ("a number for every cell that it crossed", "mean[x, y] = 0.97"),
        ("Draw the map", "the same colours in figures and in the live page"),
        ("viz/maps.py", "app/"),
        ("maps for robots", "map_server, OccupancyGrid, ...", "io/exports.py"),
        leaves=True,
    ),
)
END = ("a pixel", "dark: this cell stops beams")

WIDTH, ROW, TOP = 1200, 118, 56
COLUMNS = ((20, 340), (410, 430), (890, 290))
"""Left edge and width: what the beam is; what is done; what is beside."""


def svg() -> str:
    """The picture as SVG: text stays text, nothing is loaded, the background is its own."""
    height = TOP + ROW * len(STEPS) + 84
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        'font-family="sans-serif" font-size="14">',
        "<title>The way of one beam, from a line of a log to a pixel</title>",
        '<defs><marker id="head" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto">'
        '<path d="M0 0 L8 4 L0 8 z" fill="#445"/></marker></defs>',
        f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
    ]
    for (left, _), heading in zip(
        COLUMNS, ("The beam is", "What is done, and where", "What comes in, or goes out"), strict=True
    ):
        parts.append(_text(left, 32, heading, size=17, bold=True))
    for number, step in enumerate(STEPS):
        top = TOP + number * ROW
        parts += _box(
            COLUMNS[0],
            top,
            step.is_,
            "#e8f0fb",
            code=tuple(line for line in step.is_ if set(line) & set("[_=") or "FLASER" in line),
        )
        where = "   ".join(step.where)
        parts += _box(COLUMNS[1], top, (*step.does, where), "#f3f1ea", code=(where,))
        parts.append(_arrow(f"M{_right(0)} {top + 44} H{COLUMNS[1][0] - 2}"))
        down = top + 88
        parts.append(_arrow(f"M{COLUMNS[1][0] + 30} {down} V{down + 15} H{COLUMNS[0][0] + 175} V{top + ROW - 2}"))
        code = tuple(line for line in step.beside if line.endswith((".py", "/")))
        parts += _box(COLUMNS[2], top, step.beside, "#eaf5ec", code=code)
        between = (_right(1), COLUMNS[2][0] - 2) if step.leaves else (COLUMNS[2][0], _right(1) + 2)
        parts.append(_arrow(f"M{between[0]} {top + 44} H{between[1]}"))
    parts += _box(COLUMNS[0], TOP + len(STEPS) * ROW, END, "#1d2b4f", ink="#ffffff", height=58)
    return "\n".join([*parts, "</svg>"]) + "\n"


def _right(column: int) -> int:
    left, width = COLUMNS[column]
    return left + width


def _box(
    column: tuple[int, int],
    top: int,
    lines: tuple[str, ...],
    fill: str,
    code: tuple[str, ...] = (),
    ink: str = "#1c2333",
    height: int = 88,
) -> list[str]:
    """A box with its lines; the first is a title, those of ``code`` stand in a fixed width."""
    left, width = column
    found = [f'<rect x="{left}" y="{top}" width="{width}" height="{height}" rx="6" fill="{fill}" stroke="#9aa3b5"/>']
    first = top + height / 2 - 9 * (len(lines) - 1) + 5
    for number, line in enumerate(lines):
        style = {"bold": number == 0, "mono": line in code, "ink": ink}
        found.append(_text(left + 12, first + 18 * number, line, **style))
    return found


def _text(
    x: float, y: float, text: str, size: int = 0, bold: bool = False, mono: bool = False, ink: str = "#1c2333"
) -> str:
    style = (f' font-size="{size}"' if size else "") + (' font-weight="bold"' if bold else "")
    style += ' font-family="monospace" font-size="13"' if mono else ""
    return f'<text x="{x:g}" y="{y:g}" fill="{ink}"{style}>{escape(text)}</text>'


def _arrow(path: str) -> str:
    return f'<path d="{path}" fill="none" stroke="#445" stroke-width="1.5" marker-end="url(#head)"/>'


if __name__ == "__main__":
    PICTURE.write_text(svg(), encoding="utf-8")
