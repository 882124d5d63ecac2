"""One panel as a picture of its own."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from bayesmap.space.grid import Grid
from bayesmap.viz import maps
from bayesmap.viz.overlays import draw_truth_outline

HEIGHT_IN, BAR_IN = 5.6, 1.3
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
    width_in = HEIGHT_IN * float(np.clip(grid.shape[0] / grid.shape[1], 0.3, 3.0)) + BAR_IN
    dpi = max(160.0, 1.1 * max(grid.shape) / HEIGHT_IN)
    figure = Figure(figsize=(width_in, HEIGHT_IN), dpi=dpi, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
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
        figure.set_figwidth(width_in - NO_BAR_IN)
    else:
        figure.colorbar(image, ax=axes, label=words, shrink=0.8)
    if truth is not None:
        draw_truth_outline(axes, grid, truth)
    return figure
