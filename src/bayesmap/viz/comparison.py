"""Maps side by side: the posterior, and what other mappers make of the same scans."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.space.cell_arrays import as_observed
from bayesmap.space.grid import Grid
from bayesmap.viz import maps, palette
from bayesmap.viz.figure import FONT_PT, color_bar, letter, unobserved_legend
from bayesmap.viz.layout import lay_out


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
    size_in = layout.figure[0] / layout.dpi, layout.figure[1] / layout.dpi
    figure = Figure(figsize=size_in, dpi=layout.dpi, facecolor="white")
    FigureCanvasAgg(figure)
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
        unobserved_legend(figure)
    if title is not None:
        top = 1.0 - 0.12 * layout.dpi / layout.figure[1]
        figure.text(0.5, top, title, ha="center", va="top", fontsize=FONT_PT + 2.0, color=palette.TEXT)
    return figure
