"""A small picture of a map beside a few lines, for notebooks."""

from __future__ import annotations

import base64
import html
import io

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray
from PIL import Image

from bayesmap.viz import palette

LARGEST_PIXELS = 240
"""Of the longer side."""


def thumbnail_html(
    occupancy: NDArray[np.float64], observed: NDArray[np.bool_], title: str, rows: list[tuple[str, str]]
) -> str:
    """HTML of a picture of the map, x to the right and y up, and of a table.

    Args:
        occupancy: in [0, 1], (nx, ny); NaN where unknown.
        observed: cells that some beam reached, (nx, ny).
        title: above the table.
        rows: name and value of each line of it.
    """
    colours = palette.probability_colormap()(np.nan_to_num(occupancy, nan=0.5))[..., :3]
    colours[~observed] = to_rgb(palette.UNOBSERVED)
    pixels = np.rint(255 * colours[:, ::-1].transpose(1, 0, 2)).astype(np.uint8)
    scale = LARGEST_PIXELS / max(occupancy.shape)
    size = tuple(max(1, round(side * scale)) for side in occupancy.shape)
    picture = Image.fromarray(pixels).resize(size, Image.Resampling.BOX if scale < 1 else Image.Resampling.NEAREST)
    buffer = io.BytesIO()
    picture.save(buffer, format="PNG", optimize=True)
    data = base64.b64encode(buffer.getvalue()).decode()
    lines = "".join(
        f"<tr><th align='left'>{html.escape(name)}</th><td align='left'>{html.escape(value)}</td></tr>"
        for name, value in rows
    )
    return (
        "<div style='display:flex;gap:1em;align-items:flex-start'>"
        f"<img alt='mean map' width='{size[0]}' height='{size[1]}' src='data:image/png;base64,{data}'>"
        f"<div><b>{html.escape(title)}</b><table>{lines}</table></div></div>"
    )
