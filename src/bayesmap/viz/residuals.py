"""Where the map predicts beams badly: every held-out beam's end point, coloured by how far off the prediction was."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.colors import Colormap
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.space.cell_arrays import as_array
from bayesmap.space.grid import Grid
from bayesmap.viz import maps, palette

FAINT = 0.3
"""Opacity of the map beneath."""

MAX_POINTS = 60_000
"""More end points than this are thinned evenly, but for the worst, which are all kept."""


@dataclass(frozen=True)
class Scale:
    """How numbers become colours."""

    colors: Colormap
    low: float
    high: float
    label: str


def residual_scale(residuals_m: ArrayLike, limit_m: float | None = None) -> Scale:
    """Return a symmetric scale: by default to the residual that 90 % of the beams stay within, but 5 cm at least."""
    values = as_array(residuals_m, "residuals_m")
    if limit_m is None:
        limit_m = max(0.05, _rounded(float(np.quantile(np.abs(values), 0.9)) if values.size else 0.0))
    if not limit_m > 0.0:
        raise BadInput(f"picture: the limit of the residuals must be a positive number of metres, got {limit_m:g}")
    return Scale(palette.residual_colormap(), -limit_m, limit_m, "reading minus predicted median [m]")


def surprise_scale(surprises: ArrayLike) -> Scale:
    """Return a scale of surprise, minus the log score in nats: from the median beam's to the 99th percentile's."""
    values = as_array(surprises, "surprises")
    low, high = (float(v) for v in np.quantile(values, [0.5, 0.99])) if values.size else (0.0, 1.0)
    return Scale(palette.surprise_colormap(), low, max(high, low + 1e-3), "surprise: minus log score [nats]")


def draw_residuals(ax: Axes, ends_world: ArrayLike, values: ArrayLike, scale: Scale) -> PathCollection:
    """Draw a dot at the end of every beam; the worst are larger and lie on top.

    Args:
        ax: where to draw, already framed.
        ends_world: end points in metres, shape (n, 2).
        values: what the colours show, shape (n,).
        scale: how.

    Returns:
        The dots, for a colour bar.

    Raises:
        BadInput: shapes that do not fit, or a number that is not finite.
    """
    ends, numbers = as_array(ends_world, "ends_world"), as_array(values, "values")
    if ends.shape != (len(numbers), 2) or numbers.ndim != 1:
        raise BadInput(f"picture: end points have shape {ends.shape} and values {numbers.shape}; give (n, 2) and (n,)")
    if not (np.isfinite(ends).all() and np.isfinite(numbers).all()):
        raise BadInput("picture: an end point or its value is not finite; leave out invalid readings")
    middle = 0.0 if scale.low == -scale.high else scale.low
    severity = np.clip((np.abs(numbers) if middle == 0.0 else numbers - middle) / (scale.high - middle), 0.0, 1.0)
    order = np.argsort(severity, kind="stable")
    if len(order) > MAX_POINTS:
        worst = order[-MAX_POINTS // 2 :]
        rest = order[: len(order) - len(worst)]
        order = np.concatenate([rest[:: -(-len(rest) // (MAX_POINTS - len(worst)))], worst])
    unit_pt2 = float(np.clip(12_000.0 / max(len(order), 1), 0.6, 14.0))
    return ax.scatter(
        ends[order, 0], ends[order, 1], c=numbers[order], s=unit_pt2 * (0.6 + 2.4 * severity[order]),
        cmap=scale.colors, vmin=scale.low, vmax=scale.high, linewidths=0.0, zorder=3.4,
    )  # fmt: skip


def residuals_figure(
    grid: Grid,
    occupancy: ArrayLike,
    ends_world: ArrayLike,
    values: ArrayLike,
    observed: ArrayLike | None = None,
    *,
    scale: Scale | None = None,
) -> Figure:
    """Draw held-out beams over the faded map.

    Args:
        grid: where the cells are.
        occupancy: posterior mean per cell, shape (nx, ny).
        ends_world: end points in metres, shape (n, 2); those outside the grid are not seen.
        values: residuals in metres, or surprises in nats with `surprise_scale`, shape (n,).
        observed: true where some beam reached, shape (nx, ny); None for everywhere.
        scale: `residual_scale` of the values by default.

    Raises:
        BadInput: shapes or values that do not fit.
    """
    scale = residual_scale(values) if scale is None else scale
    figure, axes = maps.map_figure(grid, aspects=(0.4, 2.5), dpi=200)
    maps.draw_probability(axes, grid, occupancy, observed).set_alpha(FAINT)
    dots = draw_residuals(axes, ends_world, values, scale)
    bar = figure.colorbar(dots, ax=axes, label=scale.label, shrink=0.8, extend="both")
    bar.ax.tick_params(colors=palette.TEXT)
    bar.outline.set(edgecolor=palette.FRAME, linewidth=0.6)
    return figure


def _rounded(value: float) -> float:
    """Round up to the next of 1, 2 or 5 times a power of ten."""
    if value <= 0.0:
        return 0.0
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(step * power for step in (1.0, 2.0, 5.0, 10.0) if value <= step * power * (1 + 1e-9)))
