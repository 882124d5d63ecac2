"""Settings that only the document of a log has: the edge of its cells, and how many of its scans are used."""

from __future__ import annotations

from dataclasses import replace

from bayesmap.app.document import LARGEST_SIDE_OF_LOG, Document, Refused, WallMap
from bayesmap.space.grid import Grid


def with_resolution(document: Document, resolution_m: float) -> Document:
    """The same log on cells of another edge; the grid depends on the log and the edge alone.

    Raises:
        Refused: not a log, or cells so small that the map would have too many.
    """
    bounds = document.source.bounds
    if document.source.kind != "log" or bounds is None:
        raise Refused("only a log is shown on cells of any size")
    grid = Grid.over(*bounds, resolution_m)
    if max(grid.shape) > LARGEST_SIDE_OF_LOG:
        least = max(high - low for low, high in zip(*bounds, strict=True)) / (LARGEST_SIDE_OF_LOG - 1)
        raise Refused(
            f"cells of {resolution_m:g} m make a map of {grid.shape[0]} x {grid.shape[1]} cells, more than "
            f"{LARGEST_SIDE_OF_LOG} a side", f"give at least {least:.3f} m"
        )  # fmt: skip
    return document if grid == document.grid else replace(document, grid=grid, walls=WallMap.none(grid.shape))


def with_scans_used(document: Document, scans: int | None) -> Document:
    """The map of the first scans alone; of all of them where there are no more than that.

    Raises:
        Refused: not a log.
    """
    if document.source.kind != "log":
        raise Refused("only of a log some of the scans can be left out")
    return replace(document, scans_used=None if scans is None or scans >= document.source.scans else scans)
