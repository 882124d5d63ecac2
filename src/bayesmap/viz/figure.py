"""Figures of maps: an overview of a posterior, a single map, and maps side by side.

`posterior_figure`, `panel_figure` and `comparison_figure` are the main functions. `lay_out` computes positions in whole
pixels, without a layout engine. All cells are equally many pixels wide and high, so that thin walls stay sharp.
"""

import io
import math
import os
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Patch
from matplotlib.ticker import ScalarFormatter
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import PICTURE_MARK, check_ending, write_file
from bayesmap.space.grid import Grid, as_observed
from bayesmap.space.scans import Scans
from bayesmap.viz import maps, overlays, palette
from bayesmap.viz.overlays import plot_surfaces, plot_truth_outline

FONT_PT = 9.0
COARSE_CELLS = 100  # largest side of a map, in cells, in which an outline of the true walls does not hide cells
MIN_STROKE_PT = 2.5  # smallest size of a cell on the page for strokes of surfaces
PANEL_IN = 3.4  # longest side of a panel in inches
TALL_IN = 5.0  # height of a panel if the map is at least twice as high as wide
WIDE_IN = 7.0  # width of stacked panels, for a map much wider than high
MIN_SLOT_IN = 1.9  # smallest width for a panel with its title and colour bar
LETTER_IN = 0.075  # width of a digit of the tick labels
LINE_IN = 0.2  # line height of the tick labels
MIN_DPI, MAX_DPI = 160.0, 320.0
LEFT_IN, RIGHT_IN, TOP_IN, GAP_IN = 0.46, 0.2, 0.32, 0.25  # room at the sides of a panel, and between panels
TITLE_IN, LABEL_IN, BAR_IN, LEGEND_IN = 0.32, 0.42, 0.48, 0.36  # heights of title, x labels, colour bar and legend
LEGEND_KEY_IN = 0.95  # typical width of a key in the legend
BAR_HEIGHT_IN, BAR_DEPTH_IN, MIN_BAR_IN = 0.09, 0.58, 1.5  # colour bar: height, bottom below the panel, least width
NO_BAR_IN = 0.9  # width that a figure saves without a colour bar
BAR_TICKS = [0.0, 0.25, 0.5, 0.75, 1.0]
WIDTH_LABEL = "width of the 90 % interval"
Surfaces = tuple[ArrayLike, ArrayLike, ArrayLike]  # means (n, 2), covariances (n, 2, 2) in metres, reflectivities (n,)
_rc_lock = threading.Lock()


@dataclass(frozen=True)
class Layout:
    """The positions of a figure's panels, which have equal size."""

    dpi: float  # pixels per inch
    figure: tuple[int, int]  # width and height of the figure, pixels
    panel: tuple[int, int]  # width and height of a panel, pixels
    corners: list[tuple[int, int]]  # lower-left corner of each panel, pixels from the figure's, in reading order
    exact: bool  # whether a cell is a whole number of pixels; False for maps that are too large
    columns: int  # number of panels in a row
    max_ticks: tuple[int, int]  # largest number of tick intervals on x and on y whose labels fit

    def blank_figure(self) -> Figure:
        """Return the figure, without its panels."""
        return palette.blank_figure(self.figure[0] / self.dpi, self.figure[1] / self.dpi, self.dpi, arranged=False)

    def title(self, figure: Figure, text: str | None) -> None:
        """Write a title over the figure, if there is a text."""
        if text is not None:
            y = 1.0 - 0.12 * self.dpi / self.figure[1]
            figure.text(0.5, y, text, ha="center", va="top", fontsize=FONT_PT + 2.0, color=palette.TEXT)

    def fractions(self, left: float, bottom: float, width: float, height: float) -> tuple[float, float, float, float]:
        """Convert a box in pixels to fractions of the figure, for `Figure.add_axes`."""
        figure_width, figure_height = self.figure
        return left / figure_width, bottom / figure_height, width / figure_width, height / figure_height


def lay_out(grid: Grid, panels: int, *, bars: int, titled: bool) -> Layout:
    """Arrange 1 to 4 panels in a row, a square or a column. The first ``bars`` panels have a colour bar."""
    nx, ny = grid.shape
    tall = ny >= 2 * nx
    columns = panels if panels < 4 or tall else 2
    if nx >= (2 if panels < 4 else 4) * ny:
        columns = 1
    rows = panels // columns
    longest_in = WIDE_IN if columns == 1 else TALL_IN if tall else PANEL_IN
    # Whole pixels per cell, with at least `MIN_DPI`, unless that would exceed `MAX_DPI`.
    longest = max(nx, ny)
    cell_px = float(math.ceil(MIN_DPI * longest_in / longest))
    dpi = cell_px * longest / longest_in
    exact = dpi <= MAX_DPI
    if not exact:
        dpi, cell_px = MAX_DPI, MAX_DPI * longest_in / longest
    panel = (max(1, round(nx * cell_px)), max(1, round(ny * cell_px)))
    x0, x1, y0, y1 = grid.extent_m
    x_letters, y_letters = _tick_letters(x0, x1), _tick_letters(y0, y1)
    max_x_ticks = max(1, min(6, int(panel[0] / dpi / ((x_letters + 2) * LETTER_IN))))
    max_y_ticks = max(1, min(6, int(panel[1] / dpi / LINE_IN)))
    left_in = LEFT_IN + y_letters * LETTER_IN
    gap_in = max(GAP_IN, (x_letters + 2) * LETTER_IN)  # labels at the ends of two axes must not meet
    right_in = max(RIGHT_IN, (x_letters / 2 + 1) * LETTER_IN)
    left, right, gap, slot = (round(dpi * inches) for inches in (left_in, right_in, gap_in, MIN_SLOT_IN))
    top, title, label, bar, legend = (round(dpi * inches) for inches in (TOP_IN, TITLE_IN, LABEL_IN, BAR_IN, LEGEND_IN))
    pitch = max(panel[0], slot) + gap
    inset = (pitch - gap - panel[0]) // 2
    room_below = [label + (bar if row * columns < bars else 0) for row in range(rows)]
    row_heights = [top + panel[1] + room for room in room_below]
    corners = [
        (left + column * pitch + inset, legend + sum(row_heights[row + 1 :]) + room_below[row])
        for row in range(rows)
        for column in range(columns)
    ]
    figure = (left + columns * pitch - gap + right, legend + sum(row_heights) + (title if titled else 0))
    return Layout(dpi, figure, panel, corners, exact, columns, (max_x_ticks, max_y_ticks))


def _tick_letters(low: float, high: float) -> int:
    """Return the number of letters of the longest tick label on an axis from low to high."""
    formatter = ScalarFormatter(useOffset=False)
    formatter.create_dummy_axis()
    ticks = [float(tick) for tick in maps.tick_locator(6).tick_values(low, high)]
    return max(len(label) for label in formatter.format_ticks(ticks))


def posterior_figure(
    grid: Grid, occupancy: ArrayLike, observed: ArrayLike | None = None, *, draw: ArrayLike | None = None,
    truth: ArrayLike | None = None, scans: Scans | None = None, title: str | None = None,
    label: str = "probability of wall", width: ArrayLike | None = None, surfaces: Surfaces | None = None,
) -> Figure:  # fmt: skip
    """Return an overview of the posterior: the mean, its uncertainty, the readings, and one draw.

    Arrays are (nx, ny). ``occupancy`` is the posterior probability of wall, and ``label`` its name. Cells that are not
    ``observed`` are hatched; None: all are observed. ``draw`` is one draw of the map, walls or numbers in [0, 1], and
    ``scans`` have the rays, readings and poses; None: no such panel. ``truth`` has true walls. They are outlined over
    the readings, and over mean and draw too if cells are large, or without readings. ``width`` is the width of each
    reflectivity's 90 % interval, as `CellPrior.width` returns it; it replaces the entropy of a wall. Surfaces are
    strokes over the mean if cells are large enough on the page.
    Raises `BadInput` if a shape differs from the grid's, a probability is outside [0, 1], or the truth is not 0 or 1.
    """
    observed_mask = as_observed(grid, observed)
    scans = scans if scans is not None and len(scans) else None
    uncertain = "entropy" if width is None else "width"
    titles = {"mean": "posterior mean", uncertain: "uncertainty"}
    titles |= {"data": "readings"} if scans is not None else {}
    titles |= {"draw": "one draw"} if draw is not None else {}
    layout = lay_out(grid, len(titles), bars=2, titled=title is not None)
    figure = layout.blank_figure()
    panels = {
        name: figure.add_axes(layout.fractions(*corner, *layout.panel), label=name)
        for name, corner in zip(titles, layout.corners, strict=True)
    }
    mean = maps.plot_probability(panels["mean"], grid, occupancy, observed_mask)
    if width is None:
        uncertainty, unit = maps.plot_entropy(panels[uncertain], grid, occupancy, observed_mask), "entropy [bits]"
    else:
        uncertainty, unit = maps.plot_width(panels[uncertain], grid, width, observed_mask), WIDTH_LABEL
    images = [mean, uncertainty]
    if "data" in panels:
        images.append(maps.plot_sample(panels["data"], grid, np.zeros(grid.shape, dtype=np.bool_), observed_mask))
    if draw is not None:
        images.append(maps.plot_draw(panels["draw"], grid, draw, observed_mask))
    for image in images:
        image.set_interpolation("nearest" if layout.exact else "auto")
    keys = _plot_overlays(panels, grid, truth, scans)
    cell_pt = 72.0 * layout.panel[0] / layout.dpi / grid.shape[0]
    if surfaces is not None and cell_pt >= MIN_STROKE_PT:
        width_pt, longest_m = float(np.clip(cell_pt / 5.0, 0.6, 1.6)), 1.5 * grid.resolution
        color = palette.SURFACE
        keys.append(plot_surfaces(panels["mean"], *surfaces, width_pt=width_pt, longest_m=longest_m, color=color))
    for position, (name, panel) in enumerate(panels.items()):
        label_panel(panel, titles[name], layout.max_ticks, leftmost=position % layout.columns == 0)
    color_bar(figure, layout, layout.corners[0], mean, label)
    color_bar(figure, layout, layout.corners[1], uncertainty, unit)
    place_legend(figure, [*_state_keys(draw), *([] if observed_mask.all() else [maps.hatch_key()]), *keys])
    layout.title(figure, title)
    return figure


def _state_keys(draw: ArrayLike | None) -> list[Artist]:
    """Return a legend key for each state of a cell, free and wall, if these are the only states in a draw."""
    if draw is None or not np.isin(np.asarray(draw), (0, 1)).all():
        return []
    colors = palette.probability_colors(2)
    return [
        Patch(facecolor=tuple(color), edgecolor=palette.FRAME, linewidth=0.6, label=name)
        for name, color in zip(("free", "wall"), colors.tolist(), strict=True)
    ]


def write_figure(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure as PNG, PDF or SVG, by the path's ending, whole or not at all. Equal figures give equal bytes.
    Raises `BadInput` for another ending or a missing folder, and `OSError` if writing failed.
    """
    target, ending = check_ending(path, ("png", "pdf", "svg"), "figure")
    # No date and no random identifiers, so that equal pictures are equal files.
    undated = {"png": {"Software": PICTURE_MARK}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}[ending]
    buffer = io.BytesIO()
    # These settings are global in matplotlib, hence the lock.
    with _rc_lock, rc_context({"svg.hashsalt": "bayesmap", "pdf.fonttype": 42}):
        figure.savefig(buffer, format=ending, dpi="figure", metadata=undated)
    write_file(target, buffer.getvalue())


def _plot_overlays(panels: dict[str, Axes], grid: Grid, truth: ArrayLike | None, scans: Scans | None) -> list[Artist]:
    """Plot the true walls, the rays and the sensor over suitable panels, and return one legend key of each."""
    keys: list[Artist] = []
    if truth is not None:
        names = [name for name in panels if name not in ("entropy", "width")]
        if "data" in panels and max(grid.shape) > COARSE_CELLS:
            names = ["data"]
        outlines = [overlays.plot_truth_outline(panels[name], grid, truth) for name in names]
        keys.append(outlines[0])
    if scans is not None:
        keys += overlays.plot_rays(panels["data"], scans)
        names = [name for name in panels if name == "data" or len(scans) <= overlays.MAX_ARROWS]
        marks = [overlays.plot_sensor(panels[name], scans.poses) for name in names]
        keys.append(marks[0][0])
    return keys


def label_panel(panel: Axes, title: str, max_ticks: tuple[int, int], *, leftmost: bool) -> None:
    """Set the panel's title and fonts. Only the leftmost panel labels the y axis."""
    panel.set_title(title, fontsize=FONT_PT + 1.0, pad=5.0, color=palette.TEXT)
    for axis, max_intervals in zip((panel.xaxis, panel.yaxis), max_ticks, strict=True):
        axis.label.set(fontsize=FONT_PT, color=palette.TEXT)
        axis.set_major_locator(maps.tick_locator(max_intervals))
    panel.tick_params(labelsize=FONT_PT - 0.5, labelleft=leftmost)
    if not leftmost:
        panel.set_ylabel("")


def color_bar(figure: Figure, layout: Layout, corner: tuple[int, int], image: AxesImage, label: str) -> None:
    """Add a thin horizontal bar under the panel's x label, never too narrow to read."""
    width = max(0.7 * layout.panel[0], MIN_BAR_IN * layout.dpi)
    left = corner[0] + (layout.panel[0] - width) / 2.0
    box = layout.fractions(left, corner[1] - BAR_DEPTH_IN * layout.dpi, width, BAR_HEIGHT_IN * layout.dpi)
    bar = figure.colorbar(image, cax=figure.add_axes(box, label=label), orientation="horizontal", ticks=BAR_TICKS)
    bar.set_label(label, labelpad=2.0, fontsize=FONT_PT, color=palette.TEXT)
    bar.ax.tick_params(length=2.0, width=0.6, pad=1.5, labelsize=FONT_PT - 1.5, colors=palette.TEXT)
    bar.ax.xaxis.set_major_formatter("{x:g}")
    bar.outline.set(edgecolor=palette.FRAME, linewidth=0.6)


def place_legend(figure: Figure, handles: list[Artist]) -> None:
    """Place the legend keys under the panels, in as many rows as they need."""
    if not handles:
        return
    # Use more rows if one row would be wider than the figure, and fill them evenly.
    rows = math.ceil(len(handles) / max(1, int(figure.get_figwidth() / LEGEND_KEY_IN)))
    legend = figure.legend(
        handles=handles, loc="lower center", bbox_to_anchor=(0.5, 0.0), ncols=math.ceil(len(handles) / rows),
        frameon=False, fontsize=FONT_PT, labelcolor=palette.TEXT, handlelength=1.6, handletextpad=0.6,
        columnspacing=1.4, borderaxespad=0.5,
    )  # fmt: skip
    # Many marks are faint and small on the map; their legend keys must be visible.
    for key in legend.legend_handles:
        if key is not None:
            key.set_alpha(1.0)
        if isinstance(key, PathCollection):
            key.set_sizes([9.0])


def panel_figure(
    grid: Grid, quantity: str, values: NDArray[Any], observed: ArrayLike | None = None, *,
    truth: ArrayLike | None = None, label: str = "probability of wall",
) -> Figure:  # fmt: skip
    """Return a figure of a single map of values, (nx, ny), with its colour bar.
    ``quantity`` is "mean", "entropy" or "deviation" (values: probabilities of a wall; "deviation" shows their standard
    deviations), "width" (values: widths of intervals), or "draw" (values: walls or numbers in [0, 1]). Cells that are
    not ``observed`` are hatched. ``truth``, (nx, ny), is outlined. ``label`` names values of "mean" and of draws.
    Raises `BadInput` if shapes or values do not fit.
    """
    figure, axes = maps.map_figure(grid, dpi=max(160.0, 1.1 * max(grid.shape) / maps.HEIGHT_IN))
    is_walls = quantity == "draw" and np.isin(values, (0, 1)).all()
    plot, bar_label = {
        "mean": (maps.plot_probability, label), "entropy": (maps.plot_entropy, "entropy [bits]"),
        "deviation": (maps.plot_deviation, "standard deviation"), "width": (maps.plot_width, WIDTH_LABEL),
        "draw": (maps.plot_draw, "" if is_walls else label.removeprefix("mean ")),
    }[quantity]  # fmt: skip
    image = plot(axes, grid, np.sqrt(values * (1.0 - values)) if quantity == "deviation" else values, observed)
    if bar_label:
        figure.colorbar(image, ax=axes, label=bar_label, shrink=0.8)
    else:
        figure.set_figwidth(figure.get_figwidth() - NO_BAR_IN)
    if truth is not None:
        plot_truth_outline(axes, grid, truth)
    return figure


@dataclass(frozen=True, eq=False)
class Candidate:
    """A map of a comparison, with its title."""

    title: str  # title of its panel
    occupancy: ArrayLike  # probability of a wall, or that a beam stops, per cell, shape (nx, ny)
    observed: ArrayLike | None = None  # mask of the cells that a beam reached, shape (nx, ny); if None, all cells
    note: str = ""  # a line under the title, for example its held-out score


def comparison_figure(
    grid: Grid, candidates: Sequence[Candidate], *, label: str = "probability of wall", title: str | None = None
) -> Figure:
    """Return a figure of two to four maps of one grid. Raises `BadInput` if their number or a shape does not fit."""
    if not 2 <= len(candidates) <= 4:
        raise BadInput(f"picture: compare two to four maps, got {len(candidates)}")
    layout = lay_out(grid, len(candidates), bars=len(candidates), titled=title is not None)
    figure = layout.blank_figure()
    masks = [as_observed(grid, candidate.observed) for candidate in candidates]
    for position, (candidate, mask, corner) in enumerate(zip(candidates, masks, layout.corners, strict=True)):
        panel = figure.add_axes(layout.fractions(*corner, *layout.panel), label=f"{position}: {candidate.title}")
        image = maps.plot_probability(panel, grid, candidate.occupancy, mask)
        image.set_interpolation("nearest" if layout.exact else "auto")
        text = candidate.title + (f": {candidate.note}" if candidate.note else "")
        label_panel(panel, text, layout.max_ticks, leftmost=position % layout.columns == 0)
    # One colour bar, below the middle of the last row.
    last_row = layout.corners[-layout.columns :]
    color_bar(figure, layout, (sum(left for left, _ in last_row) // len(last_row), last_row[0][1]), image, label)
    if not np.all(masks):
        place_legend(figure, [maps.hatch_key()])
    layout.title(figure, title)
    return figure
