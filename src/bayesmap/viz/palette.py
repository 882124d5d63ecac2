"""The style of all pictures: the colours, the reasons for them, and an empty figure.

- **Probability of wall** runs from paper to ink on a straight line in CIELAB. Equal steps in probability look equally
  large. Lightness falls all the way, so grey prints stay readable, and colour blindness confuses no two colours.
- **Uncertainty** (entropy, standard deviation) is cividis, which looks alike with and without a red-green deficiency.
  Bright is uncertain.
- **Unobserved** is a warm paper colour under a hatch. The light and grey colours of both maps above are cool, so
  unobserved cells look neither free nor undecided.
- **Residuals** run from blue (shorter than predicted) over light grey to vermilion (longer). These hues of Okabe and
  Ito differ for all colour vision, equally far from grey. **Surprise** is the warm half, darker.
- **Lines and marks** are from Okabe and Ito, "Color Universal Design" (2008): distinct for all common colour vision.
"""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.colors import Colormap, ListedColormap
    from matplotlib.figure import Figure

# Colours that end in _LAB are in CIELAB (D65).
PAPER_LAB: Final = (98.0, 0.0, 1.0)  # probability 0: nearly white
INK_LAB: Final = (14.0, 6.0, -24.0)  # probability 1: a blue so dark that it reads as ink
SHORTER_LAB: Final = (46.0, -2.0, -44.0)  # a reading shorter than predicted
NEUTRAL_LAB: Final = (88.0, 0.0, -1.0)  # a reading as predicted
LONGER_LAB: Final = (50.0, 48.0, 60.0)  # a reading longer than predicted
ALARMING_LAB: Final = (28.0, 40.0, 30.0)  # the largest surprise

UNOBSERVED: Final = "#EFE7D8"
UNOBSERVED_HATCH: Final = "#BFAE92"
UNOBSERVED_WALL: Final = "#C9BDA8"  # wall of a draw in a cell that no beam reached: faded, since the prior gives it
TRUTH: Final = "#D55E00"
RAY: Final = "#0072B2"
READING: Final = "#0072B2"
NO_RETURN: Final = "#CC79A7"
SENSOR: Final = "#009E73"
SURFACE: Final = "#56B4E9"
TEXT: Final = "#2B2F36"
FRAME: Final = "#6B7078"

# Line colours of the chains, in order, repeated for more chains.
CHAINS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")

HATCH: Final = "//////"  # pattern over unobserved cells
PAD_IN: Final = 0.08  # margin around the panels of a figure, inches


def lab_to_srgb(lab: NDArray[np.float64]) -> NDArray[np.float64]:
    """Convert CIELAB under D65, shape (n, 3), to sRGB in [0, 1], shape (n, 3) (IEC 61966-2-1)."""
    fy = (lab[:, 0] + 16.0) / 116.0
    f = np.stack([fy + lab[:, 1] / 500.0, fy, fy - lab[:, 2] / 200.0], axis=1)
    ratio = np.where(f > 6.0 / 29.0, f**3, 3.0 * (6.0 / 29.0) ** 2 * (f - 4.0 / 29.0))
    xyz = ratio * np.array([0.95047, 1.0, 1.08883])
    to_rgb = np.array(
        [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]]
    )
    linear = np.clip(xyz @ to_rgb.T, 0.0, 1.0)
    return np.asarray(np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1.0 / 2.4) - 0.055))


def probability_colors(n_colors: int = 256) -> NDArray[np.float64]:
    """Return the colours of wall probability 0 to 1 in equal steps, sRGB in [0, 1], shape (n_colors, 3)."""
    steps = np.linspace(0.0, 1.0, n_colors)[:, None]
    return lab_to_srgb((1.0 - steps) * np.array(PAPER_LAB) + steps * np.array(INK_LAB))


def probability_colormap() -> "Colormap":
    """Return the colours of probability: free is light, wall is dark, unobserved (masked) is `UNOBSERVED`."""
    return _colormap("probability", probability_colors()).with_extremes(bad=UNOBSERVED)


def uncertainty_colormap() -> "Colormap":
    """Return the colours of uncertainty: certain is dark, uncertain is bright, unobserved (masked) is `UNOBSERVED`."""
    from matplotlib import colormaps

    return _colormap("uncertainty", colormaps["cividis"](np.linspace(0.0, 1.0, 256))).with_extremes(bad=UNOBSERVED)


def residual_colormap() -> "Colormap":
    """Return the colours of residuals, from shorter than predicted to longer."""
    return _colormap("residual", _blend_lab(SHORTER_LAB, NEUTRAL_LAB, LONGER_LAB))


def surprise_colormap() -> "Colormap":
    """Return the colours of surprise: expected is light grey; the more surprising, the darker and redder."""
    return _colormap("surprise", _blend_lab(NEUTRAL_LAB, LONGER_LAB, ALARMING_LAB))


def _colormap(name: str, colors: Iterable[Any]) -> "ListedColormap":
    """Return a colormap of equal steps, given their colours."""
    # This module loads no matplotlib: a first map is written without it.
    from matplotlib.colors import ListedColormap

    return ListedColormap(list(colors), name=f"bayesmap.{name}")


def _blend_lab(*knots_lab: tuple[float, float, float]) -> NDArray[np.float64]:
    """Return 256 colours in equal steps along straight lines between CIELAB colours, sRGB in [0, 1], (256, 3)."""
    steps, knots = np.linspace(0.0, len(knots_lab) - 1.0, 256), np.arange(len(knots_lab))
    return lab_to_srgb(np.stack([np.interp(steps, knots, channel) for channel in np.array(knots_lab).T], axis=1))


def draw_colormap() -> "ListedColormap":
    """Return the colours of the kinds of cell in one draw: free, wall, unobserved and free, unobserved and wall."""
    free, wall = (tuple(color) for color in probability_colors(2).tolist())
    return _colormap("draw", [free, wall, UNOBSERVED, UNOBSERVED_WALL])


def chain_color(chain: int) -> str:
    """Return the line colour of a chain; colours repeat for many chains."""
    return CHAINS[chain % len(CHAINS)]


def blank_figure(width_in: float, height_in: float, dpi: float = 160.0, *, arranged: bool = True) -> "Figure":
    """Return an empty figure with its own Agg canvas, outside pyplot. If ``arranged``, matplotlib places its panels."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    layout = ConstrainedLayoutEngine(h_pad=PAD_IN, w_pad=PAD_IN) if arranged else None
    figure = Figure(figsize=(width_in, height_in), dpi=dpi, facecolor="white", layout=layout)
    FigureCanvasAgg(figure)
    return figure
