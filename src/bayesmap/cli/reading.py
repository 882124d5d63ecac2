"""Reading a log by the settings that every command has which reads one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bayesmap.cli.input_files import need_file
from bayesmap.cli.world import pose_of

if TYPE_CHECKING:
    from bayesmap.result import Run
    from bayesmap.space.scans import Scans


def options_of(values: dict[str, Any]) -> dict[str, Any]:
    """The settings of `bayesmap.cli.keys.READING` as `bayesmap.read_log` calls them."""
    same = ("no_return", "skip_bad_lines", "scan_topic", "pose_topic", "fixed_frame", "deskew")
    typed = values.get("laser")
    return {
        **{name: values[name] for name in same},
        "thin_m": values["thin_scans"],
        "laser": None if typed is None else pose_of(typed, "--laser"),
    }


def heldout_scans(run: Run, log: str, values: dict[str, Any], every: int) -> Scans:
    """The scans of a log that a run did not see, read with the run's largest range.

    Args:
        run: what is to be judged by them.
        log: the run's own, or with ``every`` 0 another of the same place.
        values: the command's settings.
        every: every n-th, by the rule of `infer --holdout`; 0 for all.

    Raises:
        BadInput: the log cannot be read, or the run was made from some of the scans.
    """
    need_file(log, "the log that the run was made from", runs=False)
    from bayesmap.io.logs import read_log
    from bayesmap.posterior.heldout import moved_by, unseen_scans

    train, typed = run.posterior.scans, values.get("laser")

    def scans_with(laser: str | None) -> Scans:
        return read_log(log, max_range_m=train.max_range_m, **options_of({**values, "laser": laser}))

    scans = scans_with(None)
    if typed is not None and moved_by(train, scans):
        scans = scans_with(typed)  # as infer --laser read them
    return unseen_scans(run.posterior.scans, scans, every, log)
