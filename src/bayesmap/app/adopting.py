"""What becomes of a document that a page brings along: from a share link, or from before its connection was lost."""

from __future__ import annotations

from dataclasses import replace

from bayesmap.app.document import SCANS_USED, Document, Refused, settings_of
from bayesmap.app.log_settings import with_resolution, with_scans_used


def adopted(present: Document, brought: Document) -> Document:
    """The document to show: a simulation is taken as it is; of one that shows the present file, its settings are.

    Raises:
        Refused: the two show different files, or one of them none.
    """
    if brought.simulated and present.simulated:
        return brought
    if brought.source == present.source:
        # Where the trajectory is inferred, the map is as large as that turns out to be.
        any_size = "odometry" in (brought.poses, present.poses)
        shown, resolution_m = present, brought.grid.resolution
        if brought.grid != present.grid and not (any_size and resolution_m == present.grid.resolution):
            shown = with_resolution(present, resolution_m)
        if any_size or brought.grid == shown.grid:
            settings = {name: getattr(brought, name) for name in settings_of(present.source.kind)}
            used = settings.pop(SCANS_USED, None)
            return replace(shown if used is None else with_scans_used(shown, used), **settings)
    raise Refused(f"this server shows {_named(present)}, not {_named(brought)}", _remedy(brought))


def _named(document: Document) -> str:
    return "a map that was drawn" if document.simulated else f"{document.source.name}"


def _remedy(brought: Document) -> str:
    return f"start bayesmap app {'without a file' if brought.simulated else f'with {brought.source.name}'}"
