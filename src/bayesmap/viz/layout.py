"""Where the panels of a figure stand, in whole pixels.

Computed here, not left to a layout engine, so that every cell of a map is the same whole number of pixels
wide and high: walls one cell thick stay crisp, and equally thick, in a map of any size.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from bayesmap.world.grid import Grid

PANEL_IN = 3.4
"""Longest side of a panel in inches."""
TALL_IN = 5.0
"""Height of a panel of a map at least twice as high as wide."""
WIDE_IN = 7.0
"""Width of a panel when panels are stacked, as those of a long map are."""
LEAST_SLOT_IN = 1.9
"""No panel's slot is narrower: its title and its colour bar need the room."""
LEAST_DPI, MOST_DPI = 160.0, 320.0

LEFT_IN, RIGHT_IN, TOP_IN, GAP_IN = 0.62, 0.2, 0.32, 0.25
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
    """

    dpi: float
    figure: tuple[int, int]
    panel: tuple[int, int]
    corners: list[tuple[int, int]]
    exact: bool
    columns: int

    def fractions(
        self, left: float, bottom: float, width: float, height: float
    ) -> tuple[float, float, float, float]:
        """A box in pixels as fractions of the figure, as `Figure.add_axes` takes it."""
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

    left, right, top, gap, title, label, bar, legend, least_slot = (
        round(inches * dpi)
        for inches in (
            LEFT_IN, RIGHT_IN, TOP_IN, GAP_IN, TITLE_IN, LABEL_IN, BAR_IN, LEGEND_IN, LEAST_SLOT_IN
        )
    )  # fmt: skip
    pitch = max(panel[0], least_slot) + gap
    inset = (pitch - gap - panel[0]) // 2
    below = [label + (bar if row * columns < bars else 0) for row in range(rows)]
    row_heights = [top + panel[1] + room for room in below]
    corners = [
        (left + column * pitch + inset, legend + sum(row_heights[row + 1 :]) + below[row])
        for row in range(rows)
        for column in range(columns)
    ]
    figure = (left + columns * pitch - gap + right, legend + sum(row_heights) + (title if titled else 0))
    return Layout(dpi, figure, panel, corners, exact, columns)
