"""A file that was given: is it there, and is it what is wanted, or a folder that holds it?"""

from __future__ import annotations

from pathlib import Path

from bayesmap.errors import BadInput

LOG = "a log or a recording of range scans"


def need_file(file: str, wanted: str, *, runs: bool) -> None:
    """Refuse what cannot be opened before anything is loaded to open it.

    Args:
        file: as typed; the folder of a ROS 2 bag will do.
        wanted: what to give instead.
        runs: whether a saved run would do.

    Raises:
        BadInput: nothing is there, or it is the folder that a run left behind.
    """
    if not Path(file).exists():
        raise BadInput(f"{file}: no such file; give {wanted}")
    if (Path(file) / "run.nc").is_file():
        raise BadInput(f"{file}: a folder; give the run.nc in it" if runs else f"{file}: a run's folder; give {wanted}")
