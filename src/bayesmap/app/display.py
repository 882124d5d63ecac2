"""Reports of a job to pages: fields, rays, overlays, progress. `make_field` makes the main one, the cells' values."""

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.notices import OWN_LAYERS, AnyNotice, DrawCount, Field, Overlay, View
from bayesmap.app.protocol.tasks import Buffers, Finished, GridChanged, Infer, Report, Show, Signal
from bayesmap.app.scene import Scene, scan_message
from bayesmap.app.shown.result import Result
from bayesmap.space.grid import Grid

MIN_FIELD_SECONDS = 0.08  # time between two fields of a page
MIN_OVERLAY_SECONDS = 2.0  # time between two overlays of the surfaces of chains that go on
MAX_LEVEL = 255  # number that stands for a probability of one
TRACE_POINTS = 300  # evenly chosen points of the trace in a field
FIRST_SWEEPS = 100  # first sweeps that are all included in the trace
MIN_REFLECTIVITY = 0.1  # surfaces with a smaller reflectivity are not shown
WEIGHT_BINS = 24  # number of bins of a histogram of log weights

OnReport = Callable[[Report], None]


class Display:
    """Makes the reports of one job after another, and decides when the next fields are due."""

    def __init__(self, on_report: OnReport) -> None:
        self._on_report = on_report
        self.generation, self.grid = -1, Grid((1, 1))  # number and grid of the present job
        self._views: dict[int, View] = {}  # the views of pages that get their own fields
        self._began_s = self._fields_sent_s = self._overlay_sent_s = 0.0  # times of `time.perf_counter`

    def begin(self, task: Infer) -> None:
        """Begin the reports of another job."""
        self.generation, self.grid = task.generation, task.document.grid
        self._began_s = time.perf_counter()

    def show(self, task: Show, result: Result | None) -> None:
        """Change the view of a page. If there is a result, send the page the field of that view."""
        self._views.pop(task.client, None)
        if task.view.layer in OWN_LAYERS:
            self._views[task.client] = task.view
        if result is not None:
            self._send_field(task.view, result, task.client)

    def send(self, message: AnyNotice | Signal, buffers: Buffers | None = None, client: int | None = None) -> None:
        """Send any message."""
        self._on_report(Report(message, buffers or {}, client))

    def send_fields(self, result: Result) -> None:
        """Send a field to every page."""
        for client, view in ((None, View("mean")), *self._views.items()):
            self._send_field(view, result, client)
        self._fields_sent_s = time.perf_counter()
        if result.prior.has_surfaces and self._fields_sent_s - self._overlay_sent_s > MIN_OVERLAY_SECONDS:
            self.send_overlay(result)

    def _send_field(self, view: View, result: Result, client: int | None) -> None:
        """Send a field to one page, or to all pages without fields of their own."""
        self.send(*make_field(result, view, self.generation, round(1e3 * self.elapsed_s(), 1)), client)

    def send_scan(self, scene: Scene, scan: int | None) -> None:
        """Send the beams of one scan, or of all sensors."""
        self.send(*scan_message(scene, scan, self.generation))

    def send_overlay(self, result: Result) -> None:
        """Send the overlay of a file: surfaces and trajectory."""
        if not result.document.simulated:
            self.send(Overlay(generation=self.generation), make_overlay(result))
            self._overlay_sent_s = time.perf_counter()

    def send_grid(self, grid: Grid) -> None:
        """Report the map's grid if it has changed."""
        if grid != self.grid:
            self.grid = grid
            self.send(GridChanged(grid, generation=self.generation))

    def send_finished(self, result: Result | None) -> None:
        """Report that the job is done."""
        self.send(Finished(DrawCount() if result is None else result.draw_count, generation=self.generation))

    def elapsed_s(self) -> float:
        """Return the seconds since the job began."""
        return time.perf_counter() - self._began_s

    def fields_are_due(self) -> bool:
        """Return whether the last fields were sent more than `MIN_FIELD_SECONDS` ago."""
        return time.perf_counter() - self._fields_sent_s > MIN_FIELD_SECONDS


def make_field(result: Result, view: View, generation: int, milliseconds: float) -> tuple[Field, Buffers]:
    """Return the field of a view and its buffers. A draw or width that does not exist becomes the mean."""
    estimate, layer = result.estimate, view.layer
    lowest: float | None = None  # lower edge of the histogram of weights
    # The trace and the histogram of weights, which every layer has.
    trace, trace_sweeps = thin_trace(estimate.log_joint())
    buffers: dict[str, NDArray[np.generic]] = {"trace": trace, "traced": trace_sweeps}
    if estimate.log_weights is not None:
        buffers["weights"], lowest = histogram(estimate.log_weights)
    # The values of the cells: of a draw, widths of intervals, or the mean.
    drawn = estimate.draw(view.chain, view.draw) if layer == "draw" else None
    progress = estimate.progress(result.ended)
    if drawn is not None:
        values = drawn.values
        progress = replace(progress, log_joint=estimate.log_joint_of_draw(drawn.chain, drawn.draw))
    elif layer == "width" and result.width is not None:
        values = result.width
    else:
        layer, values = "mean" if layer in OWN_LAYERS else layer, estimate.mean()
    field = Field(
        generation=generation, layer=layer, method=result.method, approximate=estimate.approximate,
        **progress.as_fields(), draws=result.draw_count, quantity=result.quantity, about=result.about,
        milliseconds=milliseconds, chain=drawn.chain if drawn else None, draw=drawn.draw if drawn else None,
        averaged=estimate.averaged, lowest=lowest,
    )  # fmt: skip
    return field, {"p": to_levels(values), "reached": to_levels(estimate.reached()), **buffers}


def to_levels(values: NDArray[Any]) -> NDArray[np.uint8]:
    """Return values from 0 to 1 in 255ths."""
    return np.rint(values * np.float32(MAX_LEVEL)).astype(np.uint8)


def make_overlay(result: Result) -> dict[str, NDArray[np.float32]]:
    """Return the buffers of the overlay of a file: surfaces and trajectory."""
    return {"strokes": make_strokes(result), "trajectory": result.scan_poses[:, :2].astype(np.float32)}


def thin_trace(log_joint: NDArray[np.float64]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return the log joint at all first and at evenly chosen sweeps, (chains, m), and these sweeps, from 1, (m,)."""
    n_sweeps = log_joint.shape[1]
    even = np.linspace(1, n_sweeps, min(n_sweeps, TRACE_POINTS)).round().astype(int)
    sweeps = np.union1d(np.arange(1, min(n_sweeps, FIRST_SWEEPS) + 1), even)
    return log_joint[:, sweeps - 1].astype(np.float32), sweeps.astype(np.float32)


def histogram(log_weights: NDArray[np.float64]) -> tuple[NDArray[np.float32], float]:
    """Count log weights, (n,), in equal bins up to the largest. Returns counts, and lowest less largest edge, nats."""
    relative = log_weights - log_weights.max()
    lowest = min(-1.0, float(relative[np.isfinite(relative)].min()))
    counts, _ = np.histogram(relative, WEIGHT_BINS, (lowest, 0.0))
    return counts.astype(np.float32), lowest


def make_strokes(result: Result) -> NDArray[np.float32]:
    """Return surfaces as segments, (U, 5): x, y, x, y in metres, and the reflectivity."""
    surfaces = result.surfaces
    if surfaces is None:
        return np.zeros((0, 5), dtype=np.float32)
    # Each segment reaches two standard deviations to both sides, along the covariance's longest axis.
    variances, axes = np.linalg.eigh(surfaces.covariances_m2)
    half = 2.0 * np.sqrt(np.maximum(variances[:, 1], 0.0))[:, None] * axes[:, :, 1]
    strokes = np.column_stack([surfaces.means_m - half, surfaces.means_m + half, surfaces.reflectivities])
    return strokes[surfaces.reflectivities >= MIN_REFLECTIVITY].astype(np.float32)
