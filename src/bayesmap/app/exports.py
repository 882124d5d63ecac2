"""Files of a result: the saved run, the map for map_server, and the page in one file.

The page in one file holds the page's module and the result as a recording, and needs no server (docs/app.md).
"""

from __future__ import annotations

import base64
import io
import math
import tempfile
import zipfile
import zlib
from collections.abc import Iterable
from importlib import resources
from pathlib import Path
from typing import Literal

import msgspec
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from bayesmap.app.display import LEVELS
from bayesmap.app.protocol.actions import Export
from bayesmap.app.protocol.document import Document, plain
from bayesmap.app.protocol.notices import Download, Quantity, Status, Verdict
from bayesmap.app.protocol.tasks import Report
from bayesmap.app.scene import hits
from bayesmap.app.shown.result import Result
from bayesmap.errors import BadInput

MOST_DRAWS = 1000
MOST_DRAW_BYTES = 16 << 20
MOST_RAYS = 2_000_000
"""The most draws of all chains in a recording, the most bytes of them, and the most beams. All are evenly chosen."""

DECIMALS_M = 4
"""The decimal places of ranges in metres."""

Range = float | Literal["-Infinity", "NaN"] | None
"""Metres. None means no return, "-Infinity" too close, and "NaN" an invalid reading."""


class RecordedScans(Struct, frozen=True):
    """Scans, one per row; in a simulation, one per sensor."""

    ids: list[int]
    pose: list[list[float | None]]
    angles: list[list[float]]  # beam angles, radians: one row for all scans, or one row per scan
    ranges: list[list[Range]]
    exact: list[list[Range]]  # noise-free ranges, metres; no row for a file
    hit: str  # base64 of packed bits (S, A), 0 for a beam without a return


class RecordedDraws(Struct, frozen=True):
    """Kept maps of walls. `data` is base64 of deflate-raw of packed bits, (chains, count, nx * ny)."""

    chains: int
    count: int
    data: str


class RecordedFigures(Struct, frozen=True):
    """The figures shown beside the picture, as in the message `Field`."""

    method: str
    quantity: Quantity
    sweeps: int
    ess: float | None
    rhat: float | None
    verdict: Verdict | None


class Recording(Struct, frozen=True, kw_only=True):
    """The result in a page in one file."""

    version: Literal[1] = 1
    document: Document
    scans: RecordedScans
    mean: str  # mean map: base64 of uint8 (nx, ny), in 255ths
    observed: str  # observed cells: base64 of packed bits (nx, ny)
    draws: RecordedDraws
    log_joint: list[list[float | None]]  # log joint of each draw, one row per chain
    settings: RecordedFigures


PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>bayesmap</title>
<link rel="icon" href="data:,">
</head>
<body>
<div data-bayesmap></div>
<noscript>This page needs JavaScript.</noscript>
<script type="application/json" data-recording>{recording}</script>
<script type="application/octet-stream" data-module>{module}</script>
<script type="module">
const packed = atob(document.querySelector("script[data-module]").textContent);
const bytes = Uint8Array.from(packed, (character) => character.charCodeAt(0));
const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
const text = await new Response(stream).text();
await import(URL.createObjectURL(new Blob([text], {{ type: "text/javascript" }})));
</script>
</body>
</html>
"""


def static(name: str) -> str:
    """Return the text of one of the page's static files."""
    return resources.files("bayesmap.app").joinpath("static", name).read_text(encoding="utf-8")


def exported(question: Export, result: Result | None, client: int) -> Report:
    """Return a report with a file of the result, or with the reason why there is none."""
    try:
        if result is None:
            raise BadInput("there is nothing to export yet")
        name, mime, data = export(result, question.what)
    except (BadInput, OSError) as error:
        return Report(Status(str(error), "warning"), {}, client)
    return Report(Download(name, mime), {"data": data}, client)


def export(result: Result, what: str) -> tuple[str, str, bytes]:
    """Return the name, media type and bytes of a file: a "run", a "map", or the page as "html".

    Raises:
        BadInput: the result has no draws to save.
    """
    if what == "html":
        return "bayesmap.html", "text/html", to_html(result).encode()
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
    recording = msgspec.json.encode(record(result), enc_hook=plain).decode().replace("</", "<\\/")
    return PAGE.format(recording=recording, module=_text(_deflate(static("mapview.js").encode())))


def record(result: Result) -> Recording:
    """Return the recording of a result, which the page's `recordedTransport` plays."""
    found, grid = result.found, result.document.grid
    figures = found.figures(result.over).as_fields()
    packed, joint = _thinned(result)
    chains, count = packed.shape[:2]
    bits = np.unpackbits(packed, axis=-1, count=grid.n_cells)
    draws = _text(_deflate(np.packbits(bits.ravel()).tobytes()))
    numbers = (figures[name] for name in ("sweeps", "ess", "rhat", "verdict"))
    return Recording(
        document=result.document, scans=_scans(result),
        mean=_text(np.rint(found.mean() * LEVELS).astype(np.uint8).tobytes()),
        observed=_text(np.packbits(found.observed().ravel()).tobytes()),
        draws=RecordedDraws(chains if count else 0, count, draws), log_joint=_numbers(joint, 2),
        settings=RecordedFigures(result.method, result.quantity, *numbers),
    )  # fmt: skip


def _thinned(result: Result) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    """Return packed maps of walls, evenly chosen from the kept draws, (chains, count, bytes), and their log joint.

    For other kinds of cells, both are empty.
    """
    kept, joint = result.found.kept, result.found.log_joint()
    if kept is None or kept.specs[0].storage != "bits" or kept.count == 0:
        return np.zeros((0, 0, 0), dtype=np.uint8), np.zeros((0, 0))
    packed = np.asarray(kept.arrays[kept.specs[0].name])
    chains, count, size = packed.shape
    most = max(1, min(MOST_DRAWS // chains, MOST_DRAW_BYTES // (chains * max(1, size))))
    chosen = np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))
    every = max(1, joint.shape[1] // count)  # a thinned chain has its log joint for every sweep
    return packed[:, chosen], joint[:, np.minimum(chosen * every + every - 1, joint.shape[1] - 1)]


def _scans(result: Result) -> RecordedScans:
    """Return the scans. Long logs are thinned evenly so that the file stays at a few megabytes."""
    scene, scans = result.scene, result.scene.scans
    most = max(1, MOST_RAYS // len(scans.angles_rad))
    chosen = np.unique(np.linspace(0, len(scans) - 1, min(len(scans), most)).round().astype(int))
    beams = scans.has_beam[chosen]
    own = scans.own_angles_rad is not None
    angles = [scans.beams_of(int(i))[0] for i in chosen] if own else [scans.angles_rad]
    return RecordedScans(
        ids=[scene.ids[i] for i in chosen],
        pose=_numbers(scans.poses[chosen], 6),
        angles=[[round(float(angle), 7) for angle in row] for row in angles],
        ranges=_readings(row[has] for row, has in zip(scans.ranges_m[chosen], beams, strict=True)),
        exact=_readings(scene.exact_m[chosen] if len(scene.exact_m) else scene.exact_m),
        hit=_text(np.packbits(hits(scene)[chosen][beams]).tobytes()),
    )


def _readings(values: Iterable[NDArray[np.float64]]) -> list[list[Range]]:
    """Return rows of ranges in metres."""

    def reading(value: float) -> Range:
        if math.isfinite(value):
            return round(float(value), DECIMALS_M)
        return None if value > 0 else "-Infinity" if value < 0 else "NaN"

    return [[reading(value) for value in row] for row in values]


def _numbers(values: Iterable[NDArray[np.float64]], decimals: int) -> list[list[float | None]]:
    """Return rows of rounded numbers, with null for a number that is not finite."""
    return [[round(float(v), decimals) if math.isfinite(v) else None for v in row] for row in values]


def _deflate(data: bytes) -> bytes:
    """Compress by raw deflate, which the browser's DecompressionStream reads."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)  # the best compression, and no header around the data
    return packer.compress(data) + packer.flush()


def _text(data: bytes) -> str:
    return base64.b64encode(data).decode()
