"""A page in one file: the module, and a result as a recording that it plays, without a server (docs/app.md)."""

from __future__ import annotations

import base64
import math
import zlib
from collections.abc import Iterable
from importlib import resources
from typing import TYPE_CHECKING, Literal

import msgspec
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from bayesmap.app.display import LEVELS
from bayesmap.app.protocol.document import Document, plain
from bayesmap.app.protocol.notices import Quantity, Verdict
from bayesmap.app.scene import hits
from bayesmap.app.shown.result import Result
from bayesmap.cells.arrays import Draws

if TYPE_CHECKING:
    from bayesmap.result import Run

MOST_DRAWS = 1000
"""Of all chains together: a file of more is thinned, evenly."""

MOST_DRAW_BYTES = 16 << 20
MOST_RAYS = 2_000_000
DECIMALS_M = 4

Range = float | Literal["-Infinity", "NaN"] | None
"""Metres; None is no return, "-Infinity" too close, "NaN" an invalid reading."""


class RecordedScans(Struct, frozen=True):
    """Scans, one a row; of a simulation one a sensor.

    Attributes:
        angles: of the beams: one row that all scans have, or a row a scan.
        exact: where the beams truly end; no row for a file.
        hit: base64 of packed bits (S, A).
    """

    ids: list[int]
    pose: list[list[float | None]]
    angles: list[list[float]]
    ranges: list[list[Range]]
    exact: list[list[Range]]
    hit: str


class RecordedDraws(Struct, frozen=True):
    """Kept maps of walls: base64 of deflate-raw of packed bits, (chains, count, nx * ny) in one run."""

    chains: int
    count: int
    data: str


class RecordedFigures(Struct, frozen=True):
    """What a field says beside its picture."""

    method: str
    quantity: Quantity
    sweeps: int
    ess: float | None
    rhat: float | None
    verdict: Verdict | None


class Recording(Struct, frozen=True, kw_only=True):
    """A result in a page in one file.

    Attributes:
        mean: base64 of uint8 (nx, ny), in 255ths.
        observed: base64 of packed bits.
        log_joint: of each draw, a row a chain.
    """

    version: Literal[1] = 1
    document: Document
    scans: RecordedScans
    mean: str
    observed: str
    draws: RecordedDraws
    log_joint: list[list[float | None]]
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
    """The text of a file of the page."""
    return resources.files("bayesmap.app").joinpath("static", name).read_text(encoding="utf-8")


def to_html(result: Result) -> str:
    """A page that shows a result from its own file; it opens from a disk and reaches for nothing."""
    recording = msgspec.json.encode(record(result), enc_hook=plain).decode().replace("</", "<\\/")
    return PAGE.format(recording=recording, module=_text(_deflate(static("mapview.js").encode())))


def run_to_html(run: Run, name: str = "run") -> str:
    """The same for a run of `bayesmap.infer`."""
    from bayesmap.app.sources import opened_run

    return to_html(opened_run(run, name).result())


def record(result: Result) -> Recording:
    """Return what `recordedTransport` plays."""
    figures = result.found.figures(result.over).as_fields()
    packed, joint = _thinned(result)
    chains, count = packed.shape[:2]
    shape = result.document.grid.shape
    bits = np.unpackbits(packed, axis=-1, count=shape[0] * shape[1])
    draws = _text(_deflate(np.packbits(bits.ravel()).tobytes()))
    return Recording(
        document=result.document,
        scans=_scans(result),
        mean=_text(np.rint(result.found.mean() * LEVELS).astype(np.uint8).tobytes()),
        observed=_text(np.packbits(result.found.observed().ravel()).tobytes()),
        draws=RecordedDraws(chains if count else 0, count, draws),
        log_joint=_numbers(joint, 2),
        settings=RecordedFigures(
            result.method, result.quantity, figures["sweeps"], figures["ess"], figures["rhat"], figures["verdict"]
        ),
    )


def _packed(kept: Draws | None) -> NDArray[np.uint8]:
    """Kept maps of walls, (chains, count, bytes); none where a map's cells are numbers."""
    if kept is None or kept.specs[0].storage != "bits":
        return np.zeros((0, 0, 0), dtype=np.uint8)
    return np.asarray(kept.arrays[kept.specs[0].name])


def _thinned(result: Result) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    """Draws, evenly spread over the kept ones, and their log joint, (chains, count)."""
    packed, joint = _packed(result.found.kept), result.found.log_joint()
    chains, count, size = packed.shape
    if count == 0:
        return packed, np.zeros((chains, 0))
    most = max(1, min(MOST_DRAWS // chains, MOST_DRAW_BYTES // (chains * max(1, size))))
    some = np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))
    every = max(1, joint.shape[1] // count)  # a thinned chain has its log joint for every sweep
    return packed[:, some], joint[:, np.minimum(some * every + every - 1, joint.shape[1] - 1)]


def _scans(result: Result) -> RecordedScans:
    """All scans; of a long log as many, evenly spread, as make a file of a few megabytes."""
    scene = result.scene
    scans = scene.scans
    most = max(1, MOST_RAYS // len(scans.angles_rad))
    some = np.unique(np.linspace(0, len(scans) - 1, min(len(scans), most)).round().astype(int))
    exact = scene.exact_m[some] if len(scene.exact_m) else scene.exact_m
    beams = scans.has_beam[some]
    own = scans.own_angles_rad is not None
    angles = [scans.beams_of(int(i))[0] for i in some] if own else [scans.angles_rad]
    numbers = [[round(float(angle), 7) for angle in row] for row in angles]
    return RecordedScans(
        ids=[scene.ids[i] for i in some],
        pose=_numbers(scans.poses[some], 6),
        angles=numbers,
        ranges=_readings(row[has] for row, has in zip(scans.ranges_m[some], beams, strict=True)),
        exact=_readings(exact),
        hit=_text(np.packbits(hits(scene)[some][beams]).tobytes()),
    )


def _readings(values: Iterable[NDArray[np.float64]]) -> list[list[Range]]:
    """Rows of ranges in metres: null for no return, "-Infinity" for too close, "NaN" for an invalid reading."""

    def reading(value: float) -> Range:
        if math.isfinite(value):
            return round(float(value), DECIMALS_M)
        return None if value > 0 else "-Infinity" if value < 0 else "NaN"

    return [[reading(value) for value in row] for row in values]


def _numbers(values: Iterable[NDArray[np.float64]], decimals: int) -> list[list[float | None]]:
    """Rows of rounded numbers; what is not finite is null."""
    return [[round(float(v), decimals) if math.isfinite(v) else None for v in row] for row in values]


def _deflate(data: bytes) -> bytes:
    """Raw deflate, as the browser's DecompressionStream reads it."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return packer.compress(data) + packer.flush()


def _text(data: bytes) -> str:
    return base64.b64encode(data).decode()
