"""A page in one file: the module, and a result as a recording that it plays, without a server (docs/app.md)."""

from __future__ import annotations

import base64
import json
import math
import zlib
from collections.abc import Iterable
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.scene import hits
from bayesmap.app.shown.result import LEVELS, Result

if TYPE_CHECKING:
    from bayesmap.result import Run

MOST_DRAWS = 1000
"""Of all chains together: a file of more is thinned, evenly."""

MOST_DRAW_BYTES = 16 << 20
MOST_RAYS = 2_000_000
DECIMALS_M = 4

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
    recording = json.dumps(record(result), allow_nan=False, separators=(",", ":")).replace("</", "<\\/")
    return PAGE.format(recording=recording, module=_text(_deflate(static("mapview.js").encode())))


def run_to_html(run: Run, name: str = "run") -> str:
    """The same for a run of `bayesmap.infer`."""
    from bayesmap.app.sources import opened_run

    return to_html(opened_run(run, name).result())


def record(result: Result) -> dict[str, Any]:
    """What `recordedTransport` plays: document, scans, draws, mean, log joint and figures, as JSON values."""
    statistics = result.statistics()
    packed, joint = _thinned(result)
    chains, count = packed.shape[:2]
    shape = result.document.grid.shape
    bits = np.unpackbits(packed, axis=-1, count=shape[0] * shape[1])
    return {
        "version": 1,
        "document": result.document.to_json(),
        "scans": _scans(result),
        "mean": _text(np.rint(result.mean() * LEVELS).astype(np.uint8).tobytes()),
        "observed": _text(np.packbits(result.observed().ravel()).tobytes()),
        "draws": {
            "chains": chains if count else 0,
            "count": count,
            "data": _text(_deflate(np.packbits(bits.ravel()).tobytes())),
        },
        "log_joint": _numbers(joint, 2),
        "settings": {
            "method": result.method,
            "quantity": result.quantity(),
            **{name: statistics[name] for name in ("sweeps", "ess", "rhat", "verdict")},
        },
    }


def _thinned(result: Result) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    """Draws, evenly spread over the kept ones, and their log joint, (chains, count)."""
    packed, joint = result.packed(), result.log_joint()
    chains, count, size = packed.shape
    if count == 0:
        return packed, np.zeros((chains, 0))
    most = max(1, min(MOST_DRAWS // chains, MOST_DRAW_BYTES // (chains * max(1, size))))
    some = np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))
    every = max(1, joint.shape[1] // count)  # a thinned chain has its log joint for every sweep
    return packed[:, some], joint[:, np.minimum(some * every + every - 1, joint.shape[1] - 1)]


def _scans(result: Result) -> dict[str, Any]:
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
    return {
        "ids": [scene.ids[i] for i in some],
        "pose": _numbers(scans.poses[some], 6),
        "angles": numbers if own else numbers[0],
        "ranges": _readings(row[has] for row, has in zip(scans.ranges_m[some], beams, strict=True)),
        "exact": _readings(exact),
        "hit": _text(np.packbits(hits(scene)[some][beams]).tobytes()),
    }


def _readings(values: Iterable[NDArray[np.float64]]) -> list[list[float | str | None]]:
    """Rows of ranges in metres: null for no return, "-Infinity" for too close, "NaN" for an invalid reading."""

    def reading(value: float) -> float | str | None:
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
