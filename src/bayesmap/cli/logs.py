"""The logs that a command reads: folders and patterns of logs, files that must exist, scans that a run has not seen."""

from __future__ import annotations

import glob
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from bayesmap.cli.keys import ReadingSettings
from bayesmap.cli.translation import reading_of
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.result import Run
    from bayesmap.space.scans import Scans

RECORDED = (".db3", ".mcap", ".zstd")
"""How the files of a ROS 2 bag end."""
MAPS = (".yaml", ".yml")
"""How maps of map_server end."""
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
    """Return the logs that several names, a folder of logs, or a pattern mean; None if it is one log.

    Args:
        typed: names. A folder means the logs in it, by the endings of their names, and the folders of ROS 2 bags in it.

    Raises:
        BadInput: a pattern or a folder with nothing in it.
    """
    logs: list[str] = []
    several = len(typed) > 1
    for name in typed:
        path = Path(name)
        if not path.exists() and any(sign in name for sign in "*?["):
            several = True
            matches = sorted(glob.glob(name))
            if not matches:
                raise BadInput(f"{name}: no file matches; give {LOG}")
            logs += matches
        elif path.is_dir() and not _is_recording(path) and not (path / "run.nc").is_file():
            several = True
            inside = [entry for entry in sorted(path.iterdir()) if _is_log(entry)]
            if not inside:
                raise BadInput(f"{name}: a folder without logs, by the endings of the names; give {LOG}")
            logs += map(str, inside)
        else:
            logs.append(name)
    return logs if several else None


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


def heldout_scans(run: Run, log: str, settings: ReadingSettings, every: int) -> Scans:
    """Return the scans of a log that a run did not see, read with the run's largest range.

    Args:
        run: the run that is to be scored by them.
        log: the run's own log, or with ``every`` 0 another of the same place.
        settings: how the log is read.
        every: every n-th scan, by the rule of `infer --holdout`; 0 for all.

    Raises:
        BadInput: the log cannot be read, or the run was made from some of the scans.
    """
    need_file(log, "the log that the run was made from", runs=False)
    from bayesmap.io.logs import read_log
    from bayesmap.posterior.heldout import moved_by, unseen_scans

    train = run.posterior.scans

    def scans_with(laser: str | None) -> Scans:
        options = reading_of(msgspec.structs.replace(settings, laser=laser))
        return read_log(log, max_range_m=train.max_range_m, **options)

    scans = scans_with(None)
    if settings.laser is not None and moved_by(train, scans):
        scans = scans_with(settings.laser)  # as infer --laser read them
    return unseen_scans(train, scans, every, log)


def is_map(path: str) -> bool:
    """Whether a file is called like a map_server map."""
    return Path(path).suffix.lower() in MAPS
