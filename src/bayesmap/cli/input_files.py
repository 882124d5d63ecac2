"""Input files as typed: whether they exist, are of the wanted kind, or are folders and patterns of such."""

from __future__ import annotations

import glob
from collections.abc import Sequence
from pathlib import Path

from bayesmap.errors import BadInput

RECORDED = (".db3", ".mcap", ".zstd")
"""How the files of a ROS 2 bag end."""
LOG = "a log or a recording of range scans"


def need_file(file: str, wanted: str, *, runs: bool, pipes: bool = False) -> None:
    """Refuse what cannot be opened before anything is loaded to open it.

    Args:
        file: as typed; the folder of a ROS 2 bag will do.
        wanted: what to give instead.
        runs: whether a saved run would do.
        pipes: whether a pipe would do.

    Raises:
        BadInput: nothing is there, it is the folder that a run left behind, or a pipe.
    """
    if not pipes and (file in ("-", "/dev/stdin") or Path(file).is_fifo()):
        raise BadInput(f"{file}: a pipe, and this needs a file that can be read again; localize --follow reads pipes")
    if not Path(file).exists():
        raise BadInput(f"{file}: no such file; give {wanted}")
    if (Path(file) / "run.nc").is_file():
        raise BadInput(f"{file}: a folder; give the run.nc in it" if runs else f"{file}: a run's folder; give {wanted}")


def logs_of(typed: Sequence[str]) -> list[str] | None:
    """The logs that are meant by several names, a folder of logs, or a pattern; None if it is one log.

    Args:
        typed: names. Of a folder those in it are meant whose names end as logs' do, and folders of ROS 2 bags.

    Raises:
        BadInput: a pattern or a folder with nothing in it.
    """
    found: list[str] = []
    several = len(typed) > 1
    for one in typed:
        path = Path(one)
        if not path.exists() and any(sign in one for sign in "*?["):
            several = True
            matches = sorted(glob.glob(one))
            if not matches:
                raise BadInput(f"{one}: no file matches; give {LOG}")
            found += matches
        elif path.is_dir() and not _is_recording(path) and not (path / "run.nc").is_file():
            several = True
            inside = [entry for entry in sorted(path.iterdir()) if _is_log(entry)]
            if not inside:
                raise BadInput(f"{one}: a folder without logs, by the endings of the names; give {LOG}")
            found += map(str, inside)
        else:
            found.append(one)
    return found if several else None


def _is_log(path: Path) -> bool:
    """Whether a path in a folder is a log, by its name."""
    from bayesmap.io.logs import ENDINGS

    if path.is_dir():
        return _is_recording(path)
    return path.name.endswith((*ENDINGS, *RECORDED)) and not path.name.startswith(".")


def _is_recording(folder: Path) -> bool:
    """Whether a folder is a ROS 2 bag rather than one of logs: two bags of one recording lie side by side."""
    if (folder / "metadata.yaml").exists():
        return True
    recorded = [entry for entry in folder.glob("*") if entry.name.endswith(RECORDED)]
    return len(recorded) == 1
