"""Pictures as arrays: brightness by row, and walls where a picture is dark.

Row 0 of a picture is its top. Maps are indexed ``[x, y]`` with y up.
"""

from __future__ import annotations

import math
from os import PathLike
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from PIL.Image import Image

T = TypeVar("T", bound=np.generic)

ImageLike = str | PathLike[str] | ArrayLike
"""A path, a PIL image, or an array of rows."""

MAX_PIXELS = 100_000_000


def from_image(image: ImageLike | Image, threshold: float = 0.5) -> NDArray[np.bool_]:
    """Return walls where a picture is dark. Row 0 is the top, so the map shows the picture as it is drawn.

    Args:
        image: path to an image file, a PIL image, or an array of shape (height, width), (height, width, 3) or
            (height, width, 4): bool (True is bright), whole numbers 0..255, or floats 0..1. Transparent
            pixels count as white.
        threshold: a pixel is a wall where its brightness, from 0 (black) to 1 (white), is below this.

    Returns:
        Walls, shape (width, height), indexed ``[x, y]`` with y up: pixel (row r, column c) is
        ``walls[c, height - 1 - r]``.

    Raises:
        BadInput: a file that is no image, an array of another shape or range, a threshold outside (0, 1).
    """
    if not 0 < threshold < 1:
        raise BadInput(f"image: threshold must lie between 0 (black) and 1 (white), got {threshold!r}")
    return upright(brightness(image) < threshold)


def upright(rows: NDArray[T]) -> NDArray[T]:
    """Return image rows, top first, as an array indexed ``[x, y]`` with y up."""
    return np.ascontiguousarray(rows[::-1].T)


def brightness(image: ImageLike | Image) -> NDArray[np.float64]:
    """Return the brightness of every pixel, 0 (black) to 1 (white), shape (height, width), row 0 the top.

    Raises:
        BadInput: a file that is no image, or an array of another shape or range.
    """
    from PIL import Image as pil  # on first use: most programs never read an image

    if isinstance(image, str | PathLike):
        try:
            with pil.open(image) as opened:
                return brightness(opened)
        except (OSError, pil.DecompressionBombError) as error:
            raise BadInput(f"image {image}: cannot be read as an image: {error}") from None
    if isinstance(image, pil.Image):
        if image.mode == "1" or image.mode.startswith(("I", "F")):
            array = np.asarray(image)
            # 16-bit greys: PIL opens them in a wider mode that does not say how many bits were used.
            image = array / 65535 if array.dtype != bool and array.max(initial=0) > 255 else array
        else:
            image = np.asarray(image.convert("RGBA"))
    return _brightness_of_array(image)


def _brightness_of_array(image: ArrayLike) -> NDArray[np.float64]:
    array = np.asarray(image)
    if array.size == 0 or array.size > 4 * MAX_PIXELS:
        raise BadInput(f"image: {array.shape} is not the shape of a map's picture")
    if not (array.ndim == 2 or (array.ndim == 3 and array.shape[2] in (3, 4))):
        raise BadInput(f"image: shape {array.shape}, expected (height, width) or (height, width, 3 or 4)")
    if array.dtype.kind not in "buif":
        raise BadInput(f"image: {array.dtype} pixels; expected bool, whole numbers 0..255, or floats 0..1")
    top = 255.0 if array.dtype.kind in "ui" else 1.0
    values = array.astype(np.float64) / top
    if not (math.isfinite(float(values.sum())) and values.min() >= 0 and values.max() <= 1):
        raise BadInput(
            f"image: pixels from {array.min()} to {array.max()}; expected whole numbers 0..255, or floats 0..1"
        )
    if values.ndim == 2:
        return values
    grey = values[..., :3].mean(axis=2)
    if values.shape[2] == 4:
        grey = grey * values[..., 3] + (1.0 - values[..., 3])
    return np.asarray(grey)
