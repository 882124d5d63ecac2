"""May a stopped run go on? Only with what it was made with."""

from __future__ import annotations

from typing import Any

from bayesmap.errors import BadInput

FOUND_ON_THE_WAY = ("fingerprint", "threads_used", "fitted")
"""Entries of a run's settings that nobody asked for."""


def check_same(saved: dict[str, Any], wanted: dict[str, Any]) -> None:
    """Refuse to go on with a run that was made with other arguments.

    Args:
        saved: the settings of the stopped run, with its fingerprint, which also stands for its scans and its grid.
        wanted: those that were asked for now.

    Raises:
        BadInput: they differ; the message says in what.
    """
    if saved["fingerprint"] != wanted["fingerprint"]:
        raise BadInput(f"resume: the saved run was made with other {difference(saved, wanted)}")


def difference(saved: dict[str, Any], wanted: dict[str, Any]) -> str:
    """Which settings differ, in words."""
    names = [name for name in wanted if name not in FOUND_ON_THE_WAY and saved.get(name) != wanted[name]]
    if not names:
        return "scans or on another grid, or with another sensor"
    return "; ".join(f"{name} ({saved.get(name)!r}, now {wanted[name]!r})" for name in names)
