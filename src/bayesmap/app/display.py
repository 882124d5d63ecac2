"""What the worker reports of its job to pages: fields, rays, what is drawn over them, and how far it is."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from bayesmap.app.scene import Scene, rays
from bayesmap.app.shown.result import Result
from bayesmap.app.tasks import OWN_LAYERS, Infer, Report, View
from bayesmap.space.grid import Grid

FRAME_SECONDS = 0.08
OVERLAY_SECONDS = 2.0
"""Surfaces of chains that go on are drawn over their field so often."""

OnReport = Callable[[Report], None]


class Showing:
    """Makes reports of one job after another.

    Attributes:
        generation: of the present job.
        grid: on which pages show it.
    """

    def __init__(self, on_report: OnReport) -> None:
        self._send = on_report
        self.generation, self.grid = -1, Grid((1, 1))
        self._views: dict[int | None, View] = {}  # of pages that are shown a draw
        self._began = 0.0
        self._framed = self._overlaid = 0.0

    def begin(self, task: Infer) -> None:
        """Another job, from now on."""
        self.generation, self.grid = task.generation, task.document.grid
        self._began = time.perf_counter()

    def view(self, view: View, result: Result | None) -> None:
        """A page looks at something else; it is sent that at once, if there is any."""
        self._views.pop(view.client, None)
        if view.layer in OWN_LAYERS:
            self._views[view.client] = view
        if result is not None:
            self._field(view, result)

    def report(
        self, kind: str, buffers: dict[str, Any] | None = None, client: int | None = None, **fields: Any
    ) -> None:
        """Any message of the present job."""
        self._send(Report({"type": kind, "generation": self.generation, **fields}, buffers or {}, client))

    def frame(self, result: Result) -> None:
        """A field for every page."""
        for view in (View("mean"), *self._views.values()):
            self._field(view, result)
        self._framed = time.perf_counter()
        if result.prior.has_surfaces and self._framed - self._overlaid > OVERLAY_SECONDS:
            self.overlay(result)

    def _field(self, view: View, result: Result) -> None:
        """A field for one page, or for all that are not shown a draw."""
        header, buffers = result.field(view)
        self.report("field", buffers, client=view.client, **header, milliseconds=round(1e3 * self.elapsed_s(), 1))

    def rays(self, scene: Scene, scan: int | None) -> None:
        """The beams of one scan, or of all sensors."""
        header, buffers = rays(scene, scan)
        header.pop("type")
        self.report("scan", buffers, **header)

    def overlay(self, result: Result) -> None:
        """What is drawn over the field, if anything."""
        if (over := result.overlay()) is not None:
            self.report("overlay", dict(over))
            self._overlaid = time.perf_counter()

    def on_grid(self, grid: Grid) -> None:
        """From now on the map has other cells."""
        if grid != self.grid:
            self.grid = grid
            self.report("grid", grid=grid)

    def finished(self, result: Result | None) -> None:
        """The job is done."""
        self.report("finished", draws={"chains": 0, "count": 0} if result is None else result.draws())

    def elapsed_s(self) -> float:
        """Since the job began."""
        return time.perf_counter() - self._began

    def due(self) -> bool:
        """Whether the last frame is so old that another is due."""
        return time.perf_counter() - self._framed > FRAME_SECONDS
