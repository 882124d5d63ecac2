"""A map alone as a PNG file, without axes: for notebooks, and for first maps, since matplotlib takes long to load."""

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from bayesmap.viz import palette


def thumbnail(
    occupancy: NDArray[np.float64], observed: NDArray[np.bool_], longest_px: int
) -> tuple[tuple[int, int], bytes]:
    """Return width and height in pixels, and the PNG file, of probabilities and a mask, (nx, ny); y runs upwards."""
    # The colours of `palette.probability_colormap`, by number; the last one is that of unobserved cells.
    unobserved_rgb = np.array([*bytes.fromhex(palette.UNOBSERVED.removeprefix("#"))])
    colors = np.rint([*(255 * palette.probability_colors()), unobserved_rgb]).astype(np.uint8)
    number = np.minimum(256 * np.nan_to_num(occupancy, nan=0.5), 255).astype(np.intp)
    pixels = colors[np.where(observed, number, 256)[:, ::-1].T]
    scale = longest_px / max(occupancy.shape)
    width, height = (max(1, round(side * scale)) for side in occupancy.shape)
    resampling = Image.Resampling.BOX if scale < 1 else Image.Resampling.NEAREST
    buffer = io.BytesIO()
    Image.fromarray(pixels).resize((width, height), resampling).save(buffer, format="PNG", optimize=True)
    return (width, height), buffer.getvalue()
