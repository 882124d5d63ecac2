"""What the pages of the tutorial use to draw: a row of panels, and a way to show them."""

import os
import sys
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bayesmap import viz

FIGURES = Path(os.environ.get("BAYESMAP_TUTORIAL_FIGURES") or Path(__file__).parent / "figures")


def panels(*titles: str, size_in: float = 3.1, height_in: float | None = None) -> tuple[Figure, list[Axes]]:
    """A figure with a row of panels, each so wide, and as high unless another height is given."""
    height_in = size_in if height_in is None else height_in
    figure = Figure(figsize=(size_in * len(titles), height_in + 0.2), dpi=110, layout="constrained")
    FigureCanvasAgg(figure)
    axes = list(np.atleast_1d(figure.subplots(1, len(titles))))
    for ax, title in zip(axes, titles, strict=True):
        ax.set_title(title, fontsize=10)
        ax.tick_params(labelsize=8)
        ax.xaxis.label.set_size(9)
        ax.yaxis.label.set_size(9)
    return figure, axes


def show(figure: Figure, name: str, caption: str) -> None:
    """Write a figure and print its name and caption, from which the page is made; in a notebook, show it too."""
    FIGURES.mkdir(parents=True, exist_ok=True)
    viz.write_figure(figure, FIGURES / name)
    print(f"figure: {name}: {caption}")
    if "IPython" in sys.modules:
        from IPython.display import Image, display

        display(Image(FIGURES / name))
