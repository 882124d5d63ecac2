"""Where the panels of a figure stand, in whole pixels.

Computed here, not left to a layout engine, so that every cell of a map is the same whole number of pixels
wide and high: walls one cell thick stay crisp, and equally thick, in a map of any size.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from matplotlib.ticker import MaxNLocator, ScalarFormatter

from bayesmap.space.grid import Grid

PANEL_IN = 3.4
"""Longest side of a panel in inches."""
TALL_IN = 5.0
"""Height of a panel of a map at least twice as high as wide."""
WIDE_IN = 7.0
"""Width of a panel when panels are stacked, as those of a long map are."""
LEAST_SLOT_IN = 1.9
"""No panel's slot is narrower: its title and its colour bar need the room."""
LETTER_IN, LINE_IN = 0.075, 0.2
"""Width of a digit, and height of a line with its lead, in the tick labels' type."""
LEAST_DPI, MOST_DPI = 160.0, 320.0

LEFT_IN, RIGHT_IN, TOP_IN, GAP_IN = 0.46, 0.2, 0.32, 0.25
TITLE_IN, LABEL_IN, BAR_IN, LEGEND_IN = 0.32, 0.42, 0.48, 0.36
"""Room for the figure's title, the x axis' labels, the colour bar beneath them, and the legend."""


@dataclass(frozen=True)
class Layout:
    """A figure of panels of equal size.

    Attributes:
        dpi: pixels per inch.
        figure: width and height of the figure, pixels.
        panel: width and height of a panel, pixels.
        corners: lower-left corner of each panel, pixels from the figure's, in reading order.
        exact: whether a cell is a whole number of pixels; not so in maps too large for it.
        columns: number of panels in a row.
        most_ticks: the largest number of intervals between ticks on x and on y whose labels fit.
    """

    dpi: float
    figure: tuple[int, int]
    panel: tuple[int, int]
    corners: list[tuple[int, int]]
    exact: bool
    columns: int
    most_ticks: tuple[int, int]

    def fractions(self, left: float, bottom: float, width: float, height: float) -> tuple[float, float, float, float]:
        """Return a box in pixels as fractions of the figure, as `Figure.add_axes` takes it."""
        wide, high = self.figure
        return left / wide, bottom / high, width / wide, height / high


def lay_out(grid: Grid, panels: int, *, bars: int, titled: bool) -> Layout:
    """Arrange the panels of a map: in a row, four in a square, or stacked if the map is long.

    Args:
        grid: its shape is the panels'.
        panels: number of panels, 1 to 4.
        bars: the first so many panels have a colour bar.
        titled: whether the figure has a title.
    """
    nx, ny = grid.shape
    tall = ny >= 2 * nx
    columns = panels if panels < 4 or tall else 2
    if nx >= (2 if panels < 4 else 4) * ny:
        columns = 1
    rows = panels // columns
    longest_in = WIDE_IN if columns == 1 else TALL_IN if tall else PANEL_IN

    longest = max(nx, ny)
    cell = float(math.ceil(LEAST_DPI * longest_in / longest))
    dpi = cell * longest / longest_in
    exact = dpi <= MOST_DPI
    if not exact:
        dpi, cell = MOST_DPI, MOST_DPI * longest_in / longest
    panel = (max(1, round(nx * cell)), max(1, round(ny * cell)))

    x0, x1, y0, y1 = grid.extent_m
    x_letters, y_letters = _tick_letters(x0, x1), _tick_letters(y0, y1)
    most_ticks = (
        max(1, min(6, int(panel[0] / dpi / ((x_letters + 2) * LETTER_IN)))),
        max(1, min(6, int(panel[1] / dpi / LINE_IN))),
    )

    left_in = LEFT_IN + y_letters * LETTER_IN
    gap_in = max(GAP_IN, (x_letters + 2) * LETTER_IN)  # labels at the ends of two axes must not meet
    right_in = max(RIGHT_IN, (x_letters / 2 + 1) * LETTER_IN)
    left, right, gap, slot = (round(dpi * inches) for inches in (left_in, right_in, gap_in, LEAST_SLOT_IN))
    top, title, label, bar, legend = (round(dpi * inches) for inches in (TOP_IN, TITLE_IN, LABEL_IN, BAR_IN, LEGEND_IN))
    pitch = max(panel[0], slot) + gap
    inset = (pitch - gap - panel[0]) // 2
    below = [label + (bar if row * columns < bars else 0) for row in range(rows)]
    row_heights = [top + panel[1] + room for room in below]
    corners = [
        (left + column * pitch + inset, legend + sum(row_heights[row + 1 :]) + below[row])
        for row in range(rows)
        for column in range(columns)
    ]
    figure = (left + columns * pitch - gap + right, legend + sum(row_heights) + (title if titled else 0))
    return Layout(dpi, figure, panel, corners, exact, columns, most_ticks)


def tick_locator(most: int) -> MaxNLocator:
    """Return ticks at 1, 2 or 5 times a power of ten, with so many intervals at most."""
    return MaxNLocator(nbins=most, steps=[1, 2, 5, 10])


def _tick_letters(low: float, high: float) -> int:
    """Return the length of the longest tick label on an axis from low to high, as the widest choice of ticks has it."""
    formatter = ScalarFormatter(useOffset=False)
    formatter.create_dummy_axis()
    ticks = [float(tick) for tick in tick_locator(6).tick_values(low, high)]
    return max(len(label) for label in formatter.format_ticks(ticks))
