"""Scans in a NumPy .npz archive, under the names of the fields of `bayesmap.Scans`.

Needed: ``poses`` (S, 3), ``angles_rad`` (A,), ``ranges_m`` (S, A); ``angles_rad`` (S, A) where the beams differ from
scan to scan, with NaN where a scan has fewer. May be there: ``max_range_m``, ``min_range_m``,
``stamps_s`` (S,), ``beam_poses`` (S, A, 3). Readings are coded as in `Scans`: +inf no return, -inf too close, NaN
invalid, all else hits; a code is looked for only if one is named by ``no_return``.
"""

from __future__ import annotations

import os
import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogReading, Pose, no_poses
from bayesmap.io.rep117 import largest_hit_m
from bayesmap.io.returns import NoReturn, decode
from bayesmap.space.planar import compose
from bayesmap.space.scans import Scans

MAGIC = b"PK\x03\x04"
NEEDED = ("poses", "angles_rad", "ranges_m")
OPTIONAL = ("max_range_m", "min_range_m", "stamps_s", "beam_poses")


def read_npz(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    max_range_m: float | None = None,
    laser: Pose | None = None,
    without_poses: bool = False,
) -> LogReading:
    """Read scans from an .npz archive. The arguments are those of `bayesmap.io.logs.read_log`.

    Raises:
        BadInput: not such an archive, an array that is missing or does not fit, or no valid reading.
    """
    name = os.fspath(path)
    arrays = _arrays(name)
    posed = "poses" in arrays
    if not posed and without_poses and "ranges_m" in arrays:
        arrays["poses"] = np.zeros((len(np.atleast_2d(arrays["ranges_m"])), 3))
    if arrays.keys() >= {"angles_rad", "ranges_m"} and "poses" not in arrays:
        raise no_poses(name, "the archive has no 'poses'")
    missing = [key for key in NEEDED if key not in arrays]
    if missing:
        raise BadInput(f"{name}: the archive has no {missing[0]!r}; it has {', '.join(sorted(arrays)) or 'nothing'}")
    if laser is not None:
        for key in {"poses", "beam_poses"} & arrays.keys():
            arrays[key] = compose(arrays[key], np.array(laser))
    ranges = np.atleast_2d(arrays["ranges_m"])
    coded = NoReturn(None, "none")
    if no_return is not None:
        ranges, coded = decode(ranges, no_return)
    if not ranges.size or np.isnan(ranges).all():
        raise BadInput(f"{name}: none of {ranges.size:,} readings is valid")
    limit, origin = max_range_m, "given"
    if limit is None and "max_range_m" in arrays:
        limit, origin = _number(name, arrays, "max_range_m"), "message"
    if limit is None:
        limit, origin = largest_hit_m(name, ranges), "readings"
    smallest = _number(name, arrays, "min_range_m") if "min_range_m" in arrays else 0.0
    try:
        scans = Scans(
            arrays["poses"], arrays["angles_rad"], ranges, limit, smallest,
            stamps_s=arrays.get("stamps_s"), beam_poses=arrays.get("beam_poses"),
        )  # fmt: skip
        scans = scans if origin == "message" else scans.limited(limit)
    except BadInput as problem:
        raise BadInput(f"{name}: {problem}") from None
    return LogReading(
        path=name,
        format="npz",
        message="scans",
        scans=scans,
        messages={"scans": len(scans)},
        skipped=(),
        no_return=coded,
        max_range_origin=origin,
        laser_offset=laser or (0.0, 0.0, 0.0),
        reordered=0,
        notes=(),
        deskewed=scans.beam_poses is not None,
        posed=posed,
    )


def _arrays(name: str) -> dict[str, NDArray[np.float64]]:
    arrays: dict[str, NDArray[np.float64]] = {}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # NumPy's about old or odd headers: the arrays are checked anyway
            with Path(name).open("rb") as file, np.load(file, allow_pickle=False) as archive:
                for key in archive.files:
                    arrays[key] = np.asarray(archive[key])
    except Exception as error:  # NumPy and zipfile raise whatever their parsing meets
        reason = " ".join(str(error).split()) or type(error).__name__
        raise BadInput(f"{name}: not a readable .npz archive; damaged or cut short? ({reason})") from None
    for key in (*NEEDED, *OPTIONAL):
        if key in arrays:
            if arrays[key].dtype.kind not in "iuf":
                raise BadInput(f"{name}: {key} holds {arrays[key].dtype}, not numbers")
            arrays[key] = arrays[key].astype(np.float64)
    return arrays


def _number(name: str, arrays: dict[str, NDArray[np.float64]], key: str) -> float:
    if arrays[key].size != 1:
        raise BadInput(f"{name}: {key} has shape {arrays[key].shape}, expected one number")
    return float(arrays[key].reshape(()))
