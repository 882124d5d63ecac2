"""Reading a log by the settings that every command has which reads one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bayesmap.cli.input_files import need_file

if TYPE_CHECKING:
    from bayesmap.result import Run
    from bayesmap.space.scans import Scans


def options_of(values: dict[str, Any]) -> dict[str, Any]:
    """The settings of `bayesmap.cli.keys.READING` as `bayesmap.read_log` calls them."""
    same = ("no_return", "skip_bad_lines", "scan_topic", "pose_topic", "fixed_frame", "deskew")
    return {**{name: values[name] for name in same}, "thin_m": values["thin_scans"]}


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
    from bayesmap.posterior.heldout import unseen_scans

    scans = read_log(log, max_range_m=run.posterior.scans.max_range_m, **options_of(values))
    return unseen_scans(run.posterior.scans, scans, every, log)
