"""Figures of maps: one map alone, and maps side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.cell_arrays import as_observed
from bayesmap.space.grid import Grid
from bayesmap.viz import maps
from bayesmap.viz.figure import color_bar, lay_out, letter, place_legend
from bayesmap.viz.overlays import draw_truth_outline

NO_BAR_IN = 0.9
"""How much narrower a panel is without a bar."""


def panel_figure(
    grid: Grid,
    what: str,
    values: NDArray[Any],
    observed: ArrayLike | None = None,
    *,
    truth: ArrayLike | None = None,
    label: str = "probability of wall",
) -> Figure:
    """Draw a single map with its colour bar.

    Args:
        grid: the map's grid.
        what: "mean" and "entropy" (values: probabilities of a wall), "deviation" (values: the same; drawn is the
            standard deviation of a cell), "width" (values: upper minus lower bound of the interval), or "draw"
            (values: walls, or numbers in [0, 1]).
        values: shape (nx, ny).
        observed: cells to draw; the others are hatched. All if None.
        truth: true walls, (nx, ny), to be outlined.
        label: what the values of "mean" and of a draw in [0, 1] are.

    Raises:
        BadInput: shapes or values that do not fit.
    """
    figure, axes = maps.map_figure(grid, dpi=max(160.0, 1.1 * max(grid.shape) / maps.HEIGHT_IN))
    if what == "mean":
        image, words = maps.draw_probability(axes, grid, values, observed), label
    elif what == "entropy":
        image, words = maps.draw_entropy(axes, grid, values, observed), "entropy [bits]"
    elif what == "deviation":
        spread = np.sqrt(values * (1.0 - values))
        image, words = maps.draw_deviation(axes, grid, spread, observed), "standard deviation"
    elif what == "width":
        image, words = maps.draw_width(axes, grid, values, observed), "width of the 90 % interval"
    elif np.isin(values, (0, 1)).all():
        image, words = maps.draw_sample(axes, grid, values, observed), ""
    else:
        image, words = maps.draw_probability(axes, grid, values, observed), label.removeprefix("mean ")
    if not words:
        figure.set_figwidth(figure.get_figwidth() - NO_BAR_IN)
    else:
        figure.colorbar(image, ax=axes, label=words, shrink=0.8)
    if truth is not None:
        draw_truth_outline(axes, grid, truth)
    return figure


@dataclass(frozen=True, eq=False)
class Candidate:
    """A map to compare.

    Attributes:
        title: over its panel.
        occupancy: probability of a wall, or that a beam stops, per cell, shape (nx, ny).
        observed: true where some beam reached, shape (nx, ny); None for everywhere.
        note: a line under the title, such as its held-out score.
    """

    title: str
    occupancy: ArrayLike
    observed: ArrayLike | None = None
    note: str = ""


def comparison_figure(
    grid: Grid, candidates: Sequence[Candidate], *, label: str = "probability of wall", title: str | None = None
) -> Figure:
    """Draw up to four maps in the same colours, with one colour bar.

    Args:
        grid: where the cells are, of all of them.
        candidates: two to four maps.
        label: of the colour bar.
        title: a line over the figure.

    Returns:
        A figure with its own Agg canvas; write it with `bayesmap.viz.figure.write_figure`.

    Raises:
        BadInput: fewer than two or more than four maps, shapes that do not fit, probabilities outside [0, 1].
    """
    if not 2 <= len(candidates) <= 4:
        raise BadInput(f"picture: compare two to four maps, got {len(candidates)}")
    layout = lay_out(grid, len(candidates), bars=len(candidates), titled=title is not None)
    figure = layout.blank_figure()
    everywhere = True
    for position, (candidate, corner) in enumerate(zip(candidates, layout.corners, strict=True)):
        panel = figure.add_axes(layout.fractions(*corner, *layout.panel), label=f"{position}: {candidate.title}")
        seen = as_observed(grid, candidate.observed)
        everywhere &= bool(seen.all())
        image = maps.draw_probability(panel, grid, candidate.occupancy, seen)
        image.set_interpolation("nearest" if layout.exact else "auto")
        text = candidate.title + (f": {candidate.note}" if candidate.note else "")
        letter(panel, text, layout.most_ticks, leftmost=position % layout.columns == 0)
    last_row = layout.corners[-layout.columns :]
    middle = sum(left for left, _ in last_row) // len(last_row), last_row[0][1]
    color_bar(figure, layout, middle, image, label, [0.0, 0.25, 0.5, 0.75, 1.0])
    if not everywhere:
        place_legend(figure, [maps.hatch_patch()])
    layout.title(figure, title)
    return figure
