"""Maps as ROS map_server and nav2 read them: a flat YAML file beside an image.

How nav2 decodes an image (row 0 is the top), with ``occ = 1 - grey / 255`` (``grey / 255`` if ``negate``):

    trinary: occ > occupied_thresh -> 100; occ < free_thresh -> 0; otherwise -1 (unknown)
    scale:   the same at both ends; between, round(100 (occ - free_thresh) / (occupied_thresh - free_thresh));
             unknown is a pixel that is not opaque
    raw:     the grey itself if it is 0..100, otherwise -1

(nav2 from 2025 on takes ``>=`` and ``<=`` in the first two, and unknown is a pixel that is not opaque in trinary maps
too; what is written here means the same to both.)

Two consequences, where map_saver itself loses information:

- Unknown is written as grey 205, that is occ = 0.19608; a file that also says ``free_thresh: 0.25`` reads it
  as free. Trinary files therefore say 0.196, whatever threshold made the cells free.
- A PGM has no transparency. A scaled map with unknown cells is written as PNG; every other map as PGM.
"""

from __future__ import annotations

import json
import math
import os
import re
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.io.atomic import write_whole
from bayesmap.io.layers import as_observed, as_occupancy
from bayesmap.io.percent import in_percent, thresholds_of
from bayesmap.sim.image import brightness, check_thresholds
from bayesmap.space.grid import Grid

OCCUPIED_GREY, FREE_GREY, UNKNOWN_GREY = 0, 254, 205
RAW_UNKNOWN_GREY = 255
TRINARY_FILE_THRESHOLDS = (0.65, 0.196)
"""Occupied and free thresholds by which nav2 tells the three greys apart."""

_QUOTED_VALUE = re.compile(r"""[^:#]*:\s*("([^"\\]|\\.)*"|'([^']|'')*')\s*(#[^'"]*)?""")
_PLAIN_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_./-]*")


def write_map(
    path_yaml: str | os.PathLike[str],
    occupancy: ArrayLike,
    grid: Grid,
    observed: ArrayLike | None = None,
    *,
    mode: str = "trinary",
    occupied_thresh: float | None = None,
    free_thresh: float | None = None,
) -> tuple[Path, Path]:
    """Write a map for nav2's map_server: the YAML file, and an image beside it of the same name.

    Each file is written whole or not at all; the image comes first, so that a YAML file always has its image.

    Args:
        path_yaml: the YAML file to write; the image gets its name with the suffix .pgm or .png.
        occupancy: probability that each cell is occupied, shape (nx, ny), NaN where unknown.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); the others are written as unknown. All by
            default.
        mode: ``"trinary"``: occupied above ``occupied_thresh``, free below ``free_thresh``, unknown between;
            ``"scale"``: nav2 reads the probability in per cent; or ``"raw"``: the same, and the greys are the
            per cents themselves, so that no rounding of greys comes between (an image viewer shows them nearly black).
        occupied_thresh: 0.65 for trinary. For scale 1: nav2 reads all above as 100. No effect in raw.
        free_thresh: 0.25 for trinary. For scale 0: nav2 reads all below as 0. No effect in raw.

    Returns:
        Paths of the YAML file and of the image.

    Raises:
        BadInput: shapes that do not fit the grid, probabilities outside [0, 1], an unknown mode, thresholds
            out of order, a path whose suffix is not .yaml or .yml.
        OSError: the folder cannot be written.
    """
    from PIL import Image

    target = Path(path_yaml)
    if target.suffix not in (".yaml", ".yml"):
        raise BadInput(f"map {target}: the name must end in .yaml; the image is named after it")
    occupied, free = thresholds_of(mode, occupied_thresh, free_thresh)
    percent = in_percent(occupancy, grid, observed, mode=mode, occupied_thresh=occupied, free_thresh=free)
    known = ~np.isnan(as_occupancy(occupancy, grid)) & as_observed(observed, grid)

    if mode == "trinary":
        cells = np.select([percent == 100, percent == 0], [OCCUPIED_GREY, FREE_GREY], UNKNOWN_GREY)
        occupied, free = TRINARY_FILE_THRESHOLDS
    elif mode == "raw":
        cells = np.where(known, percent, RAW_UNKNOWN_GREY)
    else:
        # Not from the per cents: 256 greys are finer, for readers that look at the greys.
        cells = np.rint(255 * (1 - np.where(known, np.asarray(occupancy, dtype=np.float64), 0.5)))
    rows = np.ascontiguousarray(cells.T[::-1].astype(np.uint8))
    if mode != "scale" or known.all():
        image, suffix = Image.fromarray(rows), ".pgm"
    else:
        opacity = np.where(known, 255, 0).astype(np.uint8).T[::-1]
        image, suffix = Image.fromarray(np.dstack([rows, opacity])), ".png"

    path_image = target.with_suffix(suffix)
    with write_whole(path_image) as temporary:
        image.save(temporary)
    x, y = grid.origin
    with write_whole(target) as temporary:
        temporary.write_text(
            f"image: {_scalar(path_image.name)}\n"
            f"mode: {mode}\n"
            f"resolution: {_number(grid.resolution)}\n"
            f"origin: [{_number(x)}, {_number(y)}, 0]\n"
            f"negate: 0\n"
            f"occupied_thresh: {_number(occupied)}\n"
            f"free_thresh: {_number(free)}\n",
            encoding="utf-8",
        )
    return target, path_image


def read_map(path_yaml: str | os.PathLike[str]) -> tuple[NDArray[np.float64], Grid]:
    """Read a map as nav2's map_server does.

    Args:
        path_yaml: the YAML file; the image's path in it is relative to it.

    Returns:
        Occupancy, shape (nx, ny), in steps of 0.01, NaN where unknown; and the grid.

    Raises:
        BadInput: a file that cannot be read, a missing or wrong entry, or a map that is turned (yaw).
    """
    path = Path(path_yaml)
    entries = _read_flat_yaml(path)
    resolution = _entry_number(path, entries, "resolution")
    negate = _entry_number(path, entries, "negate", 0) != 0
    occupied = _entry_number(path, entries, "occupied_thresh", 0.65)
    free = _entry_number(path, entries, "free_thresh", 0.196)
    mode = entries.get("mode", "trinary")
    check_thresholds(occupied, free)
    grey, opaque = _read_image(path.parent / _entry(path, entries, "image"), with_alpha=mode == "trinary")
    occ = grey if negate else 1 - grey
    cells: NDArray[np.float64]
    if mode == "trinary":
        cells = np.full(occ.shape, np.nan)
        cells[occ > occupied] = 100
        cells[occ < free] = 0
    elif mode == "scale":
        cells = np.rint(100 * (np.clip(occ, free, occupied) - free) / (occupied - free))
        cells[~opaque] = np.nan
    elif mode == "raw":
        cells = np.rint(255 * grey)
        cells[cells > 100] = np.nan
    else:
        raise BadInput(f"{path}: mode {mode!r} is not known; map_server has trinary, scale and raw")
    grid = Grid(shape=(cells.shape[1], cells.shape[0]), resolution=resolution, origin=_origin(path, entries))
    return np.ascontiguousarray(cells[::-1].T) / 100, grid


def _read_image(path: Path, with_alpha: bool) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Brightness and "is opaque" of each pixel, row 0 the top."""
    from PIL import Image

    try:
        with Image.open(path) as image:
            if not image.has_transparency_data:
                grey = brightness(image)
                return grey, np.ones(grey.shape, dtype=bool)
            rgba = np.asarray(image.convert("RGBA"), dtype=np.float64) / 255
    except (OSError, Image.DecompressionBombError) as error:
        raise BadInput(f"{path}: cannot be read as an image: {error}") from None
    # In trinary mode map_server averages opacity in with the colours, as a fourth channel.
    return rgba[..., : 4 if with_alpha else 3].mean(axis=2), rgba[..., 3] == 1


def _number(value: float) -> str:
    """Exact, and a number to every YAML parser: version 1.1 takes 1e-05 for a string, but not 1.0e-05."""
    text = repr(float(value))
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _scalar(name: str) -> str:
    return name if _PLAIN_NAME.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def _read_flat_yaml(path: Path) -> dict[str, str]:
    """Keys and values of a YAML file without nesting; a block list becomes ``[a, b, c]``."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise BadInput(f"{path}: cannot be read: {reason}") from None
    entries: dict[str, str] = {}
    key = ""
    for number, raw in enumerate(lines, start=1):
        line = raw.strip()
        if not _QUOTED_VALUE.fullmatch(line):
            line = re.sub(r"(^|\s)#.*", "", line).strip()
        if not line or line == "---":
            continue
        if line.startswith("- ") and key:
            entries[key] = f"{entries[key]}, {line[2:]}".lstrip(", ")
            continue
        key, colon, value = (part.strip() for part in line.partition(":"))
        if not colon:
            raise BadInput(f"{path}: line {number}: expected 'key: value', got {raw.strip()[:80]!r}")
        entries[key] = _unquoted(value)
    return entries


def _unquoted(value: str) -> str:
    if value[:1] in ("'", '"'):
        value = value[: value.rindex(value[0]) + 1]  # what follows is a comment
    if len(value) >= 2 and value[0] == "'":
        return value[1:-1].replace("''", "'")
    if value.startswith('"'):
        try:
            return str(json.loads(value))
        except ValueError:
            return value
    return value


def _entry(path: Path, entries: dict[str, str], key: str) -> str:
    if not entries.get(key):
        raise BadInput(f"{path}: has no '{key}:'; a map needs image, resolution and origin")
    return entries[key]


def _entry_number(path: Path, entries: dict[str, str], key: str, default: float | None = None) -> float:
    if default is not None and key not in entries:
        return default
    text = _entry(path, entries, key)
    if text.lower() in ("true", "false"):
        return float(text.lower() == "true")
    try:
        return float(text)
    except ValueError:
        raise BadInput(f"{path}: {key} must be a number, got {text!r}") from None


def _origin(path: Path, entries: dict[str, str]) -> tuple[float, float]:
    text = _entry(path, entries, "origin")
    try:
        x, y, yaw = (float(part) for part in text.strip("[]").split(","))
    except ValueError:
        raise BadInput(f"{path}: origin must be [x, y, yaw], got {text!r}") from None
    if not math.isclose(yaw, 0.0, abs_tol=1e-9):
        raise BadInput(f"{path}: the map is turned by {yaw:g} rad; only maps with yaw 0 can be read")
    return x, y
