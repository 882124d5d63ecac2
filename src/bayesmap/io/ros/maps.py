"""Read and write maps: pictures, ROS occupancy grids in per cent, and the files of map_server and nav2.

Arrays are indexed ``[x, y]`` with y up. Rows of images begin at the top, rows of `nav_msgs/OccupancyGrid` at the
*bottom*. Per cent are 0 to 100, and -1 is unknown. `in_percent` follows the three modes of map_server.

`write_map` and `read_map` handle a YAML file beside an image. nav2 decodes the image by ``p = 1 - grey / 255`` (``grey
/ 255`` if ``negate``) in the modes trinary and scale. In raw, a grey from 0 to 100 is the per cent, and other greys are
unknown. In scale, a pixel that is not opaque is unknown. docs/file-formats.md says how files mean the same to all.
"""

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
import yaml
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_file, write_whole
from bayesmap.space.grid import Grid, as_observed, as_probabilities
from bayesmap.space.scans import as_array

if TYPE_CHECKING:
    from PIL.Image import Image

T = TypeVar("T", bound=np.generic)
ImageLike = str | os.PathLike[str] | ArrayLike  # a path, or an array of rows; signatures add PIL's Image
MAX_PIXELS = 100_000_000
MODES = ("trinary", "scale", "raw")
THRESHOLDS = {"trinary": (0.65, 0.25), "scale": (1.0, 0.0), "raw": (0.65, 0.25)}  # occupied, free by default
OCCUPIED_GREY, FREE_GREY, UNKNOWN_GREY = 0, 254, 205  # grey values of trinary images
RAW_UNKNOWN_GREY = 255
TRINARY_FILE_THRESHOLDS = (0.65, 0.196)  # occupied and free, between the three greys for nav2


def from_image(image: "ImageLike | Image", threshold: float = 0.5) -> NDArray[np.bool_]:
    """Return walls, (width, height), for the dark pixels of a picture, row 0 the top: the map looks like it.

    The image is a path, a PIL image, or an array of shape (height, width), (height, width, 3) or (height, width, 4):
    bool (True is bright), whole numbers 0..255, or floats 0..1. Transparent pixels count as white. A pixel whose
    brightness, from 0 (black) to 1 (white), is below the threshold is a wall. Pixel (row r, column c) is ``walls[c,
    height - 1 - r]``. Raises `BadInput` for no image, an array that does not fit, or a threshold outside (0, 1).
    """
    if not 0 < threshold < 1:
        raise BadInput(f"image: threshold must lie between 0 (black) and 1 (white), got {threshold!r}")
    return rows_to_map(brightness(image) < threshold)


def rows_to_map(rows: NDArray[T]) -> NDArray[T]:
    """Return image rows, top first, as an array indexed ``[x, y]`` with y up."""
    return np.ascontiguousarray(rows[::-1].T)


def brightness(image: "ImageLike | Image") -> NDArray[np.float64]:
    """Return each pixel's brightness, 0 to 1, (height, width), row 0 the top. Raises `BadInput` for no image."""
    from PIL import Image as pil  # on first use: most programs never read an image

    if isinstance(image, str | os.PathLike):  # a path: brightness of the opened image
        try:
            with pil.open(image) as picture:
                return brightness(picture)
        except (OSError, pil.DecompressionBombError) as error:
            raise BadInput(f"image {image}: cannot be read as an image: {error}") from None
    if isinstance(image, pil.Image):
        if image.mode == "1" or image.mode.startswith(("I", "F")):
            array = np.asarray(image)
            # PIL opens 16-bit greys in a wider mode that does not state the number of bits.
            image = array / 65535 if array.dtype != bool and array.max(initial=0) > 255 else array
        else:
            image = np.asarray(image.convert("RGBA"))
    array = np.asarray(image)
    if array.size == 0 or array.size > 4 * MAX_PIXELS:
        raise BadInput(f"image: {array.shape} is not the shape of a map's picture")
    if not (array.ndim == 2 or (array.ndim == 3 and array.shape[2] in (3, 4))):
        raise BadInput(f"image: shape {array.shape}, expected (height, width) or (height, width, 3 or 4)")
    if array.dtype.kind not in "buif":
        raise BadInput(f"image: {array.dtype} pixels; expected bool, whole numbers 0..255, or floats 0..1")
    white = 255.0 if array.dtype.kind in "ui" else 1.0
    values = array.astype(np.float64) / white
    if not (values.min() >= 0 and values.max() <= 1):  # also refuses NaN
        raise BadInput(f"image: pixels from {array.min()} to {array.max()}; use whole numbers 0..255, or floats 0..1")
    if values.ndim == 2:
        return values
    grey = values[..., :3].mean(axis=2)
    if values.shape[2] == 4:  # transparent pixels count as white
        grey = grey * values[..., 3] + (1.0 - values[..., 3])
    return np.asarray(grey)


def _check_thresholds(occupied_thresh: float, free_thresh: float) -> None:
    """Raise `BadInput` unless the thresholds are probabilities in ascending order."""
    if not (0 <= free_thresh < occupied_thresh <= 1):
        values = f"free_thresh {free_thresh!r} and occupied_thresh {occupied_thresh!r}"
        raise BadInput(f"map: thresholds must be 0 <= free_thresh < occupied_thresh <= 1, got {values}")


def _thresholds(mode: str, occupied_thresh: float | None, free_thresh: float | None) -> tuple[float, float]:
    """Return the occupied and the free threshold, by default those of the mode. Raises `BadInput`."""
    if mode not in MODES:
        raise BadInput(f"map: mode {mode!r} is not known; use one of {', '.join(MODES)}")
    occupied, free = THRESHOLDS[mode]
    occupied = occupied if occupied_thresh is None else float(occupied_thresh)
    free = free if free_thresh is None else float(free_thresh)
    _check_thresholds(occupied, free)
    return occupied, free


def in_percent(
    occupancy: ArrayLike, grid: Grid, observed: ArrayLike | None = None, *, mode: str = "scale",
    occupied_thresh: float | None = None, free_thresh: float | None = None,
) -> NDArray[np.int8]:  # fmt: skip
    """Return the occupancy of every cell in per cent, shape (nx, ny), -1 where unknown; arguments as in `write_map`.

    Raises `BadInput` for unequal shapes, probabilities outside [0, 1], an unknown mode, or unordered thresholds.
    """
    occupied, free = _thresholds(mode, occupied_thresh, free_thresh)
    p = as_probabilities(grid, occupancy, "occupancy", unknown=True)
    p = np.where(as_observed(grid, observed), p, np.nan)
    percent = np.rint(100 * p) if mode == "raw" else _by_thresholds(p, mode, occupied, free)
    return np.where(np.isnan(percent), -1, percent).astype(np.int8)


def _by_thresholds(p: NDArray[np.float64], mode: str, occupied: float, free: float) -> NDArray[np.float64]:
    """Return probabilities p in per cent by map_server's trinary or scale rule, NaN where unknown.

    trinary: p > occupied -> 100; p < free -> 0; otherwise unknown
    scale:   as trinary at both ends; between, round(100 (p - free) / (occupied - free))
    """
    if mode == "scale":
        return np.asarray(np.rint(100 * (np.clip(p, free, occupied) - free) / (occupied - free)))
    return np.select([p > occupied, p < free], [100.0, 0.0], np.nan)


def write_map(
    path_yaml: str | os.PathLike[str], occupancy: ArrayLike, grid: Grid, observed: ArrayLike | None = None, *,
    mode: str = "trinary", occupied_thresh: float | None = None, free_thresh: float | None = None,
) -> tuple[Path, Path]:  # fmt: skip
    """Write a map for nav2's map_server: the YAML file, and an image of the same name beside it. Returns both paths.

    Each file is written whole or not at all. Occupancy is the probability that each cell is occupied, shape (nx, ny),
    NaN where unknown, and ``observed`` the cells that some beam reached; all by default. The modes are

    - ``"trinary"``: occupied above ``occupied_thresh`` (0.65), free below ``free_thresh`` (0.25), unknown between;
    - ``"scale"``: nav2 reads the probability in per cent; above ``occupied_thresh`` (1) 100, under ``free_thresh`` 0;
    - ``"raw"``: the same without thresholds; greys are the per cents themselves (a viewer shows them nearly black).

    Raises `BadInput` as `in_percent`, for a path whose suffix is not .yaml or .yml, or a folder that cannot be written.
    """
    from PIL import Image

    target = Path(path_yaml)
    if target.suffix not in (".yaml", ".yml"):
        raise BadInput(f"map {target}: the name must end in .yaml; the image is named after it")
    occupied, free = _thresholds(mode, occupied_thresh, free_thresh)
    percent = in_percent(occupancy, grid, observed, mode=mode, occupied_thresh=occupied, free_thresh=free)
    # The greys of the cells, and the thresholds by which nav2 decodes them.
    p = np.asarray(occupancy, dtype=np.float64)
    is_known = ~np.isnan(p) & as_observed(grid, observed)
    if mode == "trinary":
        greys = np.select([percent == 100, percent == 0], [OCCUPIED_GREY, FREE_GREY], UNKNOWN_GREY)
        occupied, free = TRINARY_FILE_THRESHOLDS
    elif mode == "raw":
        greys = np.where(is_known, percent.astype(np.int16), RAW_UNKNOWN_GREY)
    else:
        # From the probabilities: 256 greys are finer than per cents, for programs that read the greys.
        greys = np.rint(255 * (1 - np.where(is_known, p, 0.5)))
    rows = np.ascontiguousarray(greys.T[::-1].astype(np.uint8))
    if mode != "scale" or is_known.all():
        image, suffix = Image.fromarray(rows), ".pgm"
    else:
        opacity = np.where(is_known, 255, 0).astype(np.uint8).T[::-1]
        image, suffix = Image.fromarray(np.dstack([rows, opacity])), ".png"
    # The image comes first, so that a YAML file always has its image.
    path_image = target.with_suffix(suffix)
    with write_whole(path_image) as temporary:
        image.save(temporary)
    # Without the noise of floating point: 0.3, not 0.30000000000000004.
    x, y = (round(v, 9) if math.isclose(v, round(v, 9), rel_tol=1e-12) else v for v in grid.origin)
    entries = {
        "image": path_image.name, "mode": mode, "resolution": float(grid.resolution),
        "origin": [float(x), float(y), 0], "negate": 0, "occupied_thresh": float(occupied), "free_thresh": float(free),
    }  # fmt: skip
    text = yaml.safe_dump(entries, sort_keys=False, default_flow_style=None, allow_unicode=True)
    return write_file(target, text), path_image


def read_map(path_yaml: str | os.PathLike[str]) -> tuple[NDArray[np.float64], Grid]:
    """Read a map as nav2's map_server does, by its YAML file, to which the path of the image is relative.

    Returns the occupancy, shape (nx, ny), in steps of 0.01, NaN where unknown, and the grid. Raises `BadInput` for a
    file that cannot be read, a missing or wrong entry, or a map that is turned (yaw).
    """
    path = Path(path_yaml)
    entries = _read_entries(path)
    resolution = _entry_number(path, entries, "resolution")
    negate = _entry_number(path, entries, "negate", 0) != 0
    occupied = _entry_number(path, entries, "occupied_thresh", 0.65)
    free = _entry_number(path, entries, "free_thresh", 0.196)
    mode = str(entries.get("mode", "trinary"))
    _check_thresholds(occupied, free)
    if mode not in MODES:
        raise BadInput(f"{path}: mode {mode!r} is not known; map_server has trinary, scale and raw")
    grey, opaque = _read_image(path.parent / str(_entry(path, entries, "image")), with_alpha=mode == "trinary")
    if mode == "raw":
        cells = np.rint(255 * grey)
        cells[cells > 100] = np.nan
    else:
        cells = _by_thresholds(grey if negate else 1 - grey, mode, occupied, free)
        if mode == "scale":
            cells[~opaque] = np.nan
    grid = Grid(shape=(cells.shape[1], cells.shape[0]), resolution=resolution, origin=_origin(path, entries))
    return rows_to_map(cells) / 100, grid


def from_map_image(
    image: "ImageLike | Image", resolution: float, origin: tuple[float, float] = (0.0, 0.0), *, negate: bool = False,
    occupied_thresh: float = 0.65, free_thresh: float = 0.25, unknown_is_wall: bool = False,
) -> tuple[NDArray[np.bool_], Grid]:  # fmt: skip
    """Return walls, (width, height), and grid of a map_server image, by map_server's trinary rule.

    The image is as for `from_image`, ``resolution`` the metres per pixel, and ``origin`` the world position in metres
    of the image's lower-left corner. With ``negate`` white is occupied and black is free. A pixel whose shade, from 0
    (white) to 1 (black), is above ``occupied_thresh`` is occupied, below ``free_thresh`` free, and unknown between: a
    wall if ``unknown_is_wall``, else free. Raises `BadInput` as `from_image`, or for thresholds out of 0 to 1 or order.
    """
    _check_thresholds(occupied_thresh, free_thresh)
    shade = brightness(image)
    cells = _by_thresholds(shade if negate else 1.0 - shade, "trinary", occupied_thresh, free_thresh)
    cells = np.where(np.isnan(cells), -1, cells)
    return from_occupancy(cells[::-1], resolution, origin, unknown_is_wall=unknown_is_wall)


def from_occupancy(
    cells: ArrayLike, resolution: float, origin: tuple[float, float] = (0.0, 0.0), *, threshold: float = 50,
    unknown_is_wall: bool = False,
) -> tuple[NDArray[np.bool_], Grid]:  # fmt: skip
    """Return walls, (width, height), indexed ``[x, y]``, and grid of a ROS occupancy grid.

    Cells have shape (height, width), and values 0 (free) to 100 (occupied), -1 unknown; row 0 is the *bottom*, as in
    ``nav_msgs/OccupancyGrid``: ``np.reshape(msg.data, (msg.info.height, msg.info.width))``. Cells above the threshold
    are walls, and unknown ones if ``unknown_is_wall``. ``resolution`` is in metres per cell, and ``origin`` is the
    world position in metres of the lower-left corner. Raises `BadInput` for another shape, or a value outside -1..100.
    """
    array = as_array(cells, "occupancy: cells")
    if array.ndim != 2 or array.size == 0:
        remedy = "reshape the data of a message by its info.height and info.width"
        raise BadInput(f"occupancy: cells have shape {array.shape}, expected (height, width); {remedy}")
    is_bad = ~((array == -1) | ((array >= 0) & (array <= 100)))
    if is_bad.any():
        row, column = (int(k) for k in np.argwhere(is_bad)[0])
        expected = "expected 0 (free) to 100 (occupied), or -1 (unknown)"
        raise BadInput(f"occupancy: row {row}, column {column} is {array[row, column]:g}; {expected}")
    walls = np.where(array == -1, unknown_is_wall, array > threshold)
    grid = Grid(shape=(array.shape[1], array.shape[0]), resolution=resolution, origin=origin)
    return np.ascontiguousarray(walls.T), grid


def _read_image(path: Path, with_alpha: bool) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return the brightness of each pixel, and the mask of opaque pixels, row 0 the top."""
    from PIL import Image

    try:
        with Image.open(path) as image:
            if not image.has_transparency_data:
                grey = brightness(image)
                return grey, np.ones(grey.shape, dtype=bool)
            rgba = np.asarray(image.convert("RGBA"), dtype=np.float64) / 255
    except (OSError, Image.DecompressionBombError) as error:
        raise BadInput(f"{path}: cannot be read as an image: {error}") from None
    # In trinary mode map_server averages the opacity with the colours, as a fourth channel.
    return rgba[..., : 4 if with_alpha else 3].mean(axis=2), rgba[..., 3] == 1


def _read_entries(path: Path) -> dict[str, Any]:
    """Return the entries of a YAML file. Raises `BadInput`, with the line, for another file."""
    try:
        entries = yaml.safe_load(path.read_bytes())
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "context_mark", None) or getattr(error, "problem_mark", None)
        line = f"line {mark.line + 1}: " if mark is not None else ""
        raise BadInput(f"{path}: {line}not YAML: {getattr(error, 'problem', None) or error}") from None
    if not isinstance(entries, dict):
        raise BadInput(f"{path}: line 1: expected 'key: value', as in a map of map_server")
    return entries


def _entry(path: Path, entries: Mapping[str, Any], key: str) -> Any:
    """Return an entry of a map file. Raises `BadInput` if it is missing or empty."""
    if entries.get(key) in (None, ""):
        raise BadInput(f"{path}: has no '{key}:'; a map needs image, resolution and origin")
    return entries[key]


def _entry_number(path: Path, entries: Mapping[str, Any], key: str, default: float | None = None) -> float:
    """Return a number of a map file, or the default if it is missing. Raises `BadInput` for anything else."""
    if default is not None and key not in entries:
        return default
    value = _entry(path, entries, key)
    try:
        return float(value)  # YAML 1.1 takes 1e-05 for a text
    except (TypeError, ValueError):
        raise BadInput(f"{path}: {key} must be a number, got {value!r}") from None


def _origin(path: Path, entries: Mapping[str, Any]) -> tuple[float, float]:
    """Return x and y of the map's lower-left corner, metres. Raises `BadInput` for a rotated map."""
    value = _entry(path, entries, "origin")
    try:
        x, y, yaw = (float(part) for part in value)
    except (TypeError, ValueError):
        raise BadInput(f"{path}: origin must be [x, y, yaw], got {value!r}") from None
    if not math.isclose(yaw, 0.0, abs_tol=1e-9):  # up to rounding
        raise BadInput(f"{path}: the map is turned by {yaw:g} rad; only maps with yaw 0 can be read")
    return x, y
