"""Files of a result: the saved run, the map for map_server, and the page in one file.

The page in one file holds the page's module and the result as a recording, and needs no server (docs/app.md).
"""

from __future__ import annotations

import io
import tempfile
import zipfile
from pathlib import Path
from typing import Any, Literal

import numpy as np
from msgspec import Struct, structs
from numpy.typing import NDArray

from bayesmap.app.display import field_of, levels, overlay_of
from bayesmap.app.figures import one_file
from bayesmap.app.protocol.actions import Export
from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import Download, DrawCount, Field, Status, View
from bayesmap.app.protocol.tasks import Buffers, Report
from bayesmap.app.protocol.wire import frame
from bayesmap.app.scene import ray_buffers
from bayesmap.app.shown.result import Result
from bayesmap.errors import BadInput

MOST_DRAWS = 1000  # most draws of all chains in a recording; they are evenly spaced
MOST_DRAW_BYTES = 16 << 20  # most bytes of these draws
MOST_RAYS = 2_000_000  # most beams in a recording; its scans are evenly spaced


class RecordedDraws(Struct, frozen=True):
    """Draws in a recording: `count` of the `kept` draws of each chain, as packed `bits` or in 255ths."""

    chains: int = 0
    count: int = 0
    kept: int = 0
    bits: bool = False


class Recording(Struct, frozen=True, kw_only=True):
    """The result in a page in one file: the messages of a session, for a page without one.

    Buffers: those of `Field` for the mean; width uint8 (nx, ny) if there are intervals; beams uint32 (nx, ny), the
    beams through each cell; draws uint8 (chains, count, bytes of a map); those of `Scan` for all recorded scans, with
    one row of angles for each scan if scans differ in them; for a file those of `Overlay`.
    """

    version: Literal[1] = 1
    document: Document
    field: Field  # the mean
    ids: list[int]  # id of each recorded scan: of its sensor, or its index in the file plus 1
    draws: RecordedDraws
    log_joint: list[list[float]]  # log joint of each draw, one row per chain


def export_report(question: Export, result: Result | None, client: int) -> Report:
    """Return a report with a file of the result, or with the reason why there is none."""
    try:
        if result is None:
            raise BadInput("there is nothing to export yet")
        name, media_type, data = file_of(result, question.what)
    except (BadInput, OSError) as error:
        return Report(Status(str(error), "warning"), {}, client)
    remark = _say_draws_included(result) if question.what == "html" else ""
    return Report(Download(name, media_type, remark), {"data": data}, client)


def file_of(result: Result, what: str) -> tuple[str, str, bytes]:
    """Return name, media type and bytes of a file of a result: "run", "map", "recording" or the page, "html".

    Raises `BadInput` if a run has no draws to save.
    """
    if what == "html":
        return "bayesmap.html", "text/html", to_html(result).encode()
    if what == "recording":
        return "recording", "application/octet-stream", framed(result)
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as folder:
        if what == "run":
            path = Path(folder) / "run.nc"
            result.as_run().save(path)
            return "run.nc", "application/x-netcdf", path.read_bytes()
        archive = io.BytesIO()
        with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as files:
            for path in result.found.write_map(Path(folder) / "map.yaml", result):
                files.write(path, path.name)
        return "map.zip", "application/zip", archive.getvalue()


def to_html(result: Result) -> str:
    """Return a page in one file that shows a result. It can be opened from a disk and loads nothing else."""
    return one_file("recording", framed(result))


def framed(result: Result) -> bytes:
    """Return the recording of a result and its buffers as the page reads them."""
    recording = frame(*record(result))
    assert isinstance(recording, bytes)
    return recording


def record(result: Result) -> tuple[Recording, Buffers]:
    """Return the recording of a result, which the page's `recordedTransport` plays, and its buffers."""
    draw_indices = _recorded_draw_indices(result)
    draws, buffers = _packed_draws(result, draw_indices)
    field, field_buffers = field_of(result, View("mean"), 1, 0.0)
    buffers |= field_buffers
    if result.width is not None:
        buffers["width"] = field_of(result, View("width"), 1, 0.0)[1]["p"]
    cells = result.scene.problem.table.cells
    buffers["beams"] = np.bincount(cells, minlength=result.document.grid.n_cells).astype(np.uint32)
    if not result.document.simulated:
        buffers |= overlay_of(result)
    # Long logs are thinned evenly, so that the file stays at a few megabytes.
    scan_indices = evenly_spaced(len(result.scene.scans), MOST_RAYS // len(result.scene.scans.angles_rad))
    recording = Recording(
        document=result.document, field=structs.replace(field, draws=DrawCount(draws.chains, draws.count)),
        ids=[result.scene.ids[i] for i in scan_indices], draws=draws,
        log_joint=result.found.log_joint_of_draws()[:, draw_indices].tolist(),
    )  # fmt: skip
    return recording, {**buffers, **ray_buffers(result.scene, scan_indices)}


def _recorded_draw_indices(result: Result) -> NDArray[np.intp]:
    """Return the indices of the draws of each chain that a recording contains."""
    kept = result.found.kept
    if kept is None:
        return np.zeros(0, dtype=np.intp)
    n_bytes = kept.chains * result.document.grid.n_cells // (8 if kept.specs[0].storage == "bits" else 1)
    return evenly_spaced(kept.count, min(MOST_DRAWS // kept.chains, MOST_DRAW_BYTES // max(1, n_bytes)))


def _packed_draws(result: Result, indices: NDArray[np.intp]) -> tuple[RecordedDraws, dict[str, NDArray[Any] | bytes]]:
    """Return the draws of each chain at `indices`: packed walls, or maps in 255ths."""
    kept = result.found.kept
    if kept is None:
        return RecordedDraws(), {"draws": np.zeros((0, 0, 0), dtype=np.uint8)}
    bits = kept.specs[0].storage == "bits"
    if bits:
        draws = np.asarray(kept.arrays[kept.specs[0].name])[:, indices]
    else:
        chains = range(kept.chains)
        draws = np.array([[levels(result.prior.map_of(kept, c, int(d))).ravel() for d in indices] for c in chains])
    return RecordedDraws(kept.chains, len(indices), kept.count, bits), {"draws": draws}


def _say_draws_included(result: Result) -> str:
    """Return a phrase that says how many of the kept draws the file contains."""
    kept = result.found.kept
    if kept is None or not kept.count:
        return "without draws: none were kept"
    included = len(_recorded_draw_indices(result))
    limit = f"; at most {MOST_DRAWS:,} draws and {MOST_DRAW_BYTES >> 20} MB fit" if included < kept.count else ""
    return f"with {included:,} of the {kept.count:,} draws of each chain{limit}"


def evenly_spaced(count: int, most: int) -> NDArray[np.intp]:
    """Return at most `most` evenly spaced indices below `count`, but at least one."""
    return np.unique(np.linspace(0, count - 1, max(1, min(count, most))).round().astype(np.intp))
