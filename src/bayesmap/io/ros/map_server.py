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

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.io.layers import as_observed, as_occupancy
from bayesmap.io.ros.percent import in_percent, thresholds_of
from bayesmap.sim.image import brightness, check_thresholds
from bayesmap.space.grid import Grid

OCCUPIED_GREY, FREE_GREY, UNKNOWN_GREY = 0, 254, 205
RAW_UNKNOWN_GREY = 255
TRINARY_FILE_THRESHOLDS = (0.65, 0.196)
"""Occupied and free thresholds by which nav2 tells the three greys apart."""


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
        cells = np.where(known, percent.astype(np.int16), RAW_UNKNOWN_GREY)
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
    entries = {
        "image": path_image.name, "mode": mode, "resolution": float(grid.resolution),
        "origin": [float(x), float(y), 0], "negate": 0, "occupied_thresh": float(occupied), "free_thresh": float(free),
    }  # fmt: skip
    with write_whole(target) as temporary:
        text = yaml.safe_dump(entries, sort_keys=False, default_flow_style=None, allow_unicode=True)
        temporary.write_text(text, encoding="utf-8")
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
    entries = _read_entries(path)
    resolution = _entry_number(path, entries, "resolution")
    negate = _entry_number(path, entries, "negate", 0) != 0
    occupied = _entry_number(path, entries, "occupied_thresh", 0.65)
    free = _entry_number(path, entries, "free_thresh", 0.196)
    mode = str(entries.get("mode", "trinary"))
    check_thresholds(occupied, free)
    grey, opaque = _read_image(path.parent / str(_entry(path, entries, "image")), with_alpha=mode == "trinary")
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


def _read_entries(path: Path) -> dict[str, Any]:
    try:
        entries = yaml.safe_load(path.read_bytes())
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "context_mark", None) or getattr(error, "problem_mark", None)
        where = f"line {mark.line + 1}: " if mark is not None else ""
        raise BadInput(f"{path}: {where}not YAML: {getattr(error, 'problem', None) or error}") from None
    if not isinstance(entries, dict):
        raise BadInput(f"{path}: line 1: expected 'key: value', as in a map of map_server")
    return entries


def _entry(path: Path, entries: Mapping[str, Any], key: str) -> Any:
    if entries.get(key) in (None, ""):
        raise BadInput(f"{path}: has no '{key}:'; a map needs image, resolution and origin")
    return entries[key]


def _entry_number(path: Path, entries: Mapping[str, Any], key: str, default: float | None = None) -> float:
    if default is not None and key not in entries:
        return default
    value = _entry(path, entries, key)
    try:
        return float(value)  # YAML 1.1 takes 1e-05 for a text
    except (TypeError, ValueError):
        raise BadInput(f"{path}: {key} must be a number, got {value!r}") from None


def _origin(path: Path, entries: Mapping[str, Any]) -> tuple[float, float]:
    value = _entry(path, entries, "origin")
    try:
        x, y, yaw = (float(part) for part in value)
    except (TypeError, ValueError):
        raise BadInput(f"{path}: origin must be [x, y, yaw], got {value!r}") from None
    if not math.isclose(yaw, 0.0, abs_tol=1e-9):
        raise BadInput(f"{path}: the map is turned by {yaw:g} rad; only maps with yaw 0 can be read")
    return x, y
