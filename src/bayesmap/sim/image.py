"""Walls from pictures and from the occupancy grids of ROS, with their orientations made explicit.

Three conventions meet here; everything returned is indexed ``[x, y]`` with y up:

| source                        | first index | its first entry is |
|-------------------------------|-------------|--------------------|
| image                         | row         | the top            |
| map_server image (PGM)        | row         | the top            |
| `nav_msgs/OccupancyGrid` data | row         | the *bottom*       |
"""

from __future__ import annotations

import math
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid

if TYPE_CHECKING:
    from PIL.Image import Image

ImageLike = str | PathLike[str] | ArrayLike
"""A path, a PIL image, or an array of rows."""

MAX_PIXELS = 100_000_000
UNKNOWN = -1
OCCUPIED = 100


def from_image(image: ImageLike | Image, threshold: float = 0.5) -> NDArray[np.bool_]:
    """Walls where a picture is dark. Row 0 of a picture is its top, so it appears on the map as it is drawn.

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


def from_map_image(
    image: ImageLike | Image,
    resolution: float,
    origin: tuple[float, float] = (0.0, 0.0),
    *,
    negate: bool = False,
    occupied_thresh: float = 0.65,
    free_thresh: float = 0.25,
    unknown_is_wall: bool = False,
) -> tuple[NDArray[np.bool_], Grid]:
    """Walls and grid from a map_server image, by map_server's trinary rule.

    Args:
        image: as for `from_image`; row 0 is the top.
        resolution: metres per pixel.
        origin: world position in metres of the image's lower-left corner.
        negate: white is occupied and black is free, instead of the other way round.
        occupied_thresh: darker than this, on a scale from 0 (white) to 1 (black), is occupied.
        free_thresh: lighter than this is free; what lies between is unknown.
        unknown_is_wall: what to make of unknown cells.

    Returns:
        Walls, shape (width, height), indexed ``[x, y]``, and the grid they lie on.

    Raises:
        BadInput: as `from_image`, or thresholds that are not 0 <= free_thresh < occupied_thresh <= 1.
    """
    check_thresholds(occupied_thresh, free_thresh)
    shade = brightness(image)
    darkness = shade if negate else 1.0 - shade
    cells = np.full(darkness.shape, UNKNOWN)
    cells[darkness > occupied_thresh] = OCCUPIED
    cells[darkness < free_thresh] = 0
    return from_occupancy(cells[::-1], resolution, origin, unknown_is_wall=unknown_is_wall)


def from_occupancy(
    cells: ArrayLike,
    resolution: float,
    origin: tuple[float, float] = (0.0, 0.0),
    *,
    threshold: float = 50,
    unknown_is_wall: bool = False,
) -> tuple[NDArray[np.bool_], Grid]:
    """Walls and grid from a ROS occupancy grid.

    Args:
        cells: shape (height, width), values 0 (free) to 100 (occupied), -1 unknown; row 0 is the *bottom*, as
            in ``nav_msgs/OccupancyGrid``: ``np.reshape(msg.data, (msg.info.height, msg.info.width))``.
        resolution: metres per cell.
        origin: world position in metres of the lower-left corner.
        threshold: cells above this are walls.
        unknown_is_wall: what to make of unknown cells.

    Returns:
        Walls, shape (width, height), indexed ``[x, y]``, and the grid they lie on.

    Raises:
        BadInput: another shape, or a value outside -1..100; the message names the cell.
    """
    try:
        array = np.asarray(cells, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise BadInput(f"occupancy: cells must be an array of numbers: {error}") from None
    if array.ndim != 2 or array.size == 0:
        raise BadInput(
            f"occupancy: cells have shape {array.shape}, expected (height, width); "
            "reshape the data of a message by its info.height and info.width"
        )
    bad = ~((array == UNKNOWN) | ((array >= 0) & (array <= OCCUPIED)))
    if bad.any():
        row, column = (int(k) for k in np.argwhere(bad)[0])
        raise BadInput(
            f"occupancy: row {row}, column {column} is {array[row, column]:g}; "
            "expected 0 (free) to 100 (occupied), or -1 (unknown)"
        )
    walls = np.where(array == UNKNOWN, unknown_is_wall, array > threshold)
    grid = Grid(shape=(array.shape[1], array.shape[0]), resolution=resolution, origin=origin)
    return np.ascontiguousarray(walls.T), grid


def check_thresholds(occupied_thresh: float, free_thresh: float) -> None:
    """Refuse map_server thresholds that are out of order.

    Raises:
        BadInput: not 0 <= free_thresh < occupied_thresh <= 1.
    """
    if not (0 <= free_thresh < occupied_thresh <= 1):
        raise BadInput(
            "map: thresholds must be 0 <= free_thresh < occupied_thresh <= 1, "
            f"got free_thresh {free_thresh!r} and occupied_thresh {occupied_thresh!r}"
        )


def upright(rows: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Image rows, top first, as an array indexed ``[x, y]`` with y up."""
    return np.ascontiguousarray(rows[::-1].T)


def brightness(image: ImageLike | Image) -> NDArray[np.float64]:
    """Brightness of every pixel, 0 (black) to 1 (white), shape (height, width), row 0 the top.

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
