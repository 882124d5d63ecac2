"""Read scans from a NumPy archive (.npz), which holds them under the names of the fields of `bayesmap.Scans`.

Readings have the codes of `bayesmap.Scans`; a no-return code is decoded only if the user gives it.
"""

import os
import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogAccount, LogOptions, ScanLog
from bayesmap.io.returns import NoReturn, Readings, decode, max_range_of
from bayesmap.space.planar import compose

Arrays = dict[str, NDArray[np.float64]]  # arrays by their names in the archive
NPZ_MAGIC = b"PK\x03\x04"  # first bytes of the file
NEEDED = ("poses", "angles_rad", "ranges_m")
OPTIONAL = ("max_range_m", "min_range_m", "stamps_s", "beam_poses")


def read_npz(path: str | os.PathLike[str], options: LogOptions) -> ScanLog:
    """Read scans from an .npz archive. Raises `BadInput` for an array that is missing or does not fit."""
    account = LogAccount(os.fspath(path), "npz", options)
    name = account.name
    arrays, all_names = _read_arrays(name)
    has_poses = "poses" in arrays
    missing = [key for key in NEEDED if key not in arrays and not (key == "poses" and options.without_poses)]
    if missing == ["poses"]:
        raise account.no_poses_error("the archive has no 'poses'")
    if missing:
        raise BadInput(f"{name}: the archive has no {missing[0]!r}; it has {', '.join(all_names) or 'nothing'}")
    if not has_poses:
        arrays["poses"] = np.zeros((len(np.atleast_2d(arrays["ranges_m"])), 3))
    if options.laser is not None:
        for key in {"poses", "beam_poses"} & arrays.keys():
            arrays[key] = compose(arrays[key], np.array(options.laser))
    account.stamps_s = arrays.get("stamps_s")
    try:
        account.counts["scans"] = len(np.atleast_2d(arrays["ranges_m"]))
        return account.scan_log(
            "scans", arrays["poses"], arrays["angles_rad"], _readings(account, arrays),
            beam_poses=arrays.get("beam_poses"), posed=has_poses,
        )  # fmt: skip
    except BadInput as problem:  # errors of readings begin with the name already, errors of scans do not
        raise BadInput(f"{name}: {str(problem).removeprefix(f'{name}: ')}") from None


def _readings(account: LogAccount, arrays: Arrays) -> Readings:
    """Return the readings with the sensor's limits in the archive. Raises `BadInput` if none is valid."""
    name = account.name
    ranges = np.atleast_2d(arrays["ranges_m"])
    no_return = NoReturn(code_m=None, origin="none")
    if account.options.no_return is not None:
        ranges, no_return = decode(ranges, account.options.no_return)
    if not ranges.size or np.isnan(ranges).all():
        raise BadInput(f"{name}: none of {ranges.size:,} readings is valid")
    user_max_m = account.options.max_range_m
    archive_max_m = _number(name, arrays, "max_range_m") if user_max_m is None and "max_range_m" in arrays else None
    max_range_m, origin = max_range_of(name, ranges, user_max_m, archive_max_m)
    min_range_m = _number(name, arrays, "min_range_m") if "min_range_m" in arrays else 0.0
    return Readings(ranges, no_return, min_range_m, max_range_m, origin, notes=())


def _read_arrays(name: str) -> tuple[Arrays, list[str]]:
    """Return the arrays that are used, as doubles, and the names of all. Raises `BadInput` for a damaged archive."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # warnings about old headers: the arrays are checked below
            with Path(name).open("rb") as file, np.load(file, allow_pickle=False) as archive:
                names = sorted(archive.files)
                arrays = {key: np.asarray(archive[key]) for key in (*NEEDED, *OPTIONAL) if key in names}
    except Exception as error:  # NumPy and zipfile raise many kinds of errors
        reason = " ".join(str(error).split()) or type(error).__name__
        raise BadInput(f"{name}: not a readable .npz archive; damaged or cut short? ({reason})") from None
    for key, array in arrays.items():
        if array.dtype.kind not in "iuf":
            raise BadInput(f"{name}: {key} holds {array.dtype}, not numbers")
    return {key: array.astype(np.float64) for key, array in arrays.items()}, names


def _number(name: str, arrays: Arrays, key: str) -> float:
    """Return an array of one number as a number. Raises `BadInput` for another size."""
    if arrays[key].size != 1:
        raise BadInput(f"{name}: {key} has shape {arrays[key].shape}, expected one number")
    return float(arrays[key].reshape(()))
