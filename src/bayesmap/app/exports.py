"""Files of a result that a page can save: saved run, map for map_server, recording, and page in one file.

`make_file` makes any of them. A recording holds what a page shows of a result: its mean, intervals, draws and scans.
The page in one file contains the page's module and a recording, and needs no server (docs/app.md).
"""

import io
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Any, Literal

import numpy as np
from msgspec import Struct, structs
from numpy.typing import NDArray

from bayesmap.app.display import make_field, make_overlay, to_levels
from bayesmap.app.figures import page_in_one_file
from bayesmap.app.protocol.actions import Export, FileKind
from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import Download, DrawCount, Field, Status, View
from bayesmap.app.protocol.tasks import Buffers, Report
from bayesmap.app.protocol.wire import encode_frame
from bayesmap.app.scene import scan_buffers
from bayesmap.app.shown.result import Result
from bayesmap.errors import BadInput
from bayesmap.space.arrays import evenly_spaced_indices

MAX_DRAWS = 1000  # draws of all chains in a recording; they are evenly spaced
MAX_DRAW_BYTES = 16 << 20  # bytes of these draws
MAX_BEAMS = 2_000_000  # beams in a recording; its scans are evenly spaced. A file then has a few megabytes.


class RecordedDraws(Struct, frozen=True):
    """The numbers and the format of the draws in a recording."""

    chains: int = 0  # number of chains
    count: int = 0  # number of draws of each chain in the recording
    kept: int = 0  # number of kept draws of each chain in the result
    bits: bool = False  # true for walls, packed bits of a map; false for stop probabilities in 255ths


class Recording(Struct, frozen=True, kw_only=True):
    """The result in a page in one file: the messages of a session, for a page without one.

    Buffers: the buffers of `Field` for the mean; width uint8 (nx, ny) if there are intervals; beams uint32 (nx * ny,),
    the beams through each cell; draws uint8 (chains, count, bytes of a map); the buffers of `Scan` for all recorded
    scans, with one row of angles for each scan if scans differ in them; for a file the buffers of `Overlay`.
    """

    version: Literal[1] = 1  # version of this format
    document: Document  # document of the result
    field: Field  # the mean
    ids: list[int]  # id of each recorded scan: of its sensor, or its index in the file plus 1
    draws: RecordedDraws  # numbers of draws
    log_joint: list[list[float]]  # log joint of each draw, one row per chain


def export_report(question: Export, result: Result | None, client: int) -> Report:
    """Return a report for one page with a file of the result, or with the reason why there is none."""
    try:
        if result is None:
            raise BadInput("there is nothing to export yet")
        download, data = make_file(result, question.what)
    except (BadInput, OSError) as error:
        return Report(Status(str(error), "warning"), {}, client)
    return Report(download, {"data": data}, client)


def make_file(result: Result, kind: FileKind) -> tuple[Download, bytes]:
    """Return a file of a result. Raises `BadInput` if a run has no draws."""
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as folder:
        match kind:
            case "recording":
                return Download("recording", "application/octet-stream"), encode_recording(*build_recording(result))
            case "html":
                recording, buffers = build_recording(result)
                page = page_in_one_file("recording", encode_recording(recording, buffers))
                return Download("bayesmap.html", "text/html", _describe_draws(recording.draws)), page.encode()
            case "run":
                path = Path(folder) / "run.nc"
                result.as_run().save(path)
                return Download("run.nc", "application/x-netcdf"), path.read_bytes()
            case "map":
                archive = io.BytesIO()
                with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as files:
                    for path in result.estimate.write_map(Path(folder) / "map.yaml", result):
                        files.write(path, path.name)
                return Download("map.zip", "application/zip"), archive.getvalue()
            case "figure" | "document":
                raise AssertionError("the session makes the files of a drawn world")


def encode_recording(recording: Recording, buffers: Buffers) -> bytes:
    """Return a recording and its buffers as one binary frame, which the page reads."""
    data = encode_frame(recording, buffers)
    assert isinstance(data, bytes)
    return data


def build_recording(result: Result) -> tuple[Recording, Buffers]:
    """Return the recording of a result, which the page's `recordedTransport` plays, and its buffers."""
    # The mean, the draws, the interval widths and the number of beams through each cell.
    recorded, draw_indices, packed = _pack_draws(result)
    field, field_buffers = make_field(result, View("mean"), 1, 0.0)
    beam_cells = result.scene.problem.table.cells
    n_beams = np.bincount(beam_cells, minlength=result.document.grid.n_cells).astype(np.uint32)
    buffers: dict[str, NDArray[Any] | bytes] = {"draws": packed, **field_buffers, "beams": n_beams}
    if result.width is not None:
        buffers["width"] = to_levels(result.width)
    if not result.document.simulated:
        buffers |= make_overlay(result)
    # The scans; long logs are thinned evenly.
    scan_indices = evenly_spaced_indices(len(result.scene.scans), MAX_BEAMS // len(result.scene.scans.angles_rad))
    recording = Recording(
        document=result.document, draws=recorded, ids=[result.scene.ids[i] for i in scan_indices],
        field=structs.replace(field, draws=DrawCount(recorded.chains, recorded.count)),
        log_joint=result.estimate.log_joint_of_draws()[:, draw_indices].tolist(),
    )  # fmt: skip
    return recording, {**buffers, **scan_buffers(result.scene, scan_indices)}


def _pack_draws(result: Result) -> tuple[RecordedDraws, NDArray[np.intp], NDArray[Any]]:
    """Return the numbers of the recorded draws, their indices, and the draws: packed walls, or maps in 255ths."""
    draws = result.estimate.kept_draws
    if draws is None:
        return RecordedDraws(), np.zeros(0, dtype=np.intp), np.zeros((0, 0, 0), dtype=np.uint8)
    bits = draws.specs[0].storage == "bits"
    draw_bytes = draws.chains * result.document.grid.n_cells // (8 if bits else 1)
    indices = evenly_spaced_indices(draws.count, min(MAX_DRAWS // draws.chains, MAX_DRAW_BYTES // max(1, draw_bytes)))
    if bits:
        packed = np.asarray(draws.arrays[draws.specs[0].name])[:, indices]
    else:
        map_of = result.prior.map_of
        packed = np.array([[to_levels(map_of(draws, c, int(d))).ravel() for d in indices] for c in range(draws.chains)])
    return RecordedDraws(draws.chains, len(indices), draws.count, bits), indices, packed


def _describe_draws(draws: RecordedDraws) -> str:
    """Return a phrase that says how many of the kept draws the file contains."""
    if not draws.kept:
        return "without draws: none were kept"
    limit = f"; at most {MAX_DRAWS:,} draws and {MAX_DRAW_BYTES >> 20} MB fit" if draws.count < draws.kept else ""
    return f"with {draws.count:,} of the {draws.kept:,} draws of each chain{limit}"


def main(path: str) -> None:
    """Write the recording of a saved run to the standard output. The server calls this in a process of its own."""
    from bayesmap.app.sources import OpenedRun, open_file

    opened = open_file(path)
    assert isinstance(opened, OpenedRun)
    sys.stdout.buffer.write(encode_recording(*build_recording(opened.result)))


if __name__ == "__main__":
    try:
        main(sys.argv[1])
    except (BadInput, OSError, ValueError) as error:
        sys.exit(str(error))
