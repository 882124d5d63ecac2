"""A small map that has no symmetry, so that a picture turned or mirrored cannot pass for it."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import bayesmap as bm

GRID = bm.Grid(shape=(6, 4), resolution=0.5, origin=(-1.0, 2.0))
CORNER = (5, 3)  # the cell in the upper right
HIDDEN = (0, 3)  # the cell in the upper left, which no beam reached


def occupancy():
    p = np.zeros(GRID.shape)
    p[CORNER] = 1.0
    p[2, 1] = 0.5
    return p


def observed():
    seen = np.ones(GRID.shape, dtype=bool)
    seen[HIDDEN] = False
    return seen


def scans():
    ranges = np.array([[0.8, np.inf, -np.inf, np.nan, 0.3]])
    angles = np.linspace(0.0, np.pi, 5)
    return bm.Scans(poses=np.array([[0.25, 2.75, 0.0]]), angles_rad=angles, ranges_m=ranges, max_range_m=2.0)


def panel():
    """A panel that fills its figure of 60 x 40 pixels: ten pixels to a cell, and nothing but the map."""
    figure = Figure(figsize=(0.6, 0.4), dpi=100)
    FigureCanvasAgg(figure)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set_axis_off()
    return ax


def pixels(figure):
    """RGB of the figure as floats in [0, 1], first row on top."""
    figure.canvas.draw()
    return np.asarray(figure.canvas.buffer_rgba())[..., :3] / 255.0


def cell(ax, i, j):
    """Mean RGB of the inner pixels of a cell of a `panel`."""
    top = 10 * (GRID.shape[1] - 1 - j)
    return pixels(ax.figure)[top + 2 : top + 8, 10 * i + 2 : 10 * i + 8].reshape(-1, 3).mean(axis=0)
