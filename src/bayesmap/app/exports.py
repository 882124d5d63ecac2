"""Files of a result: the saved run, the map for map_server, the page in one file."""

from __future__ import annotations

import io
import tempfile
import zipfile
from pathlib import Path

from bayesmap.app.recording import to_html
from bayesmap.app.shown.result import Result
from bayesmap.result import Run


def export(result: Result, what: str) -> tuple[str, str, bytes]:
    """Name, media type and bytes of a file.

    Args:
        result: of the present job.
        what: "run", "map" or "html".

    Raises:
        BadInput: there is nothing of that kind.
    """
    if what == "run":
        return "run.nc", "application/x-netcdf", _saved(result.as_run())
    if what == "map":
        return "map.zip", "application/zip", _map(result)
    return "bayesmap.html", "text/html", to_html(result).encode()


def _saved(run: Run) -> bytes:
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as folder:
        path = Path(folder) / "run.nc"
        run.save(path)
        return path.read_bytes()


def _map(result: Result) -> bytes:
    """YAML and image, as `bayesmap export` writes them, in one archive."""
    archive = io.BytesIO()
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as folder:
        paths = result.found.write_map(Path(folder) / "map.yaml", result)
        with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as files:
            for path in paths:
                files.write(path, path.name)
    return archive.getvalue()
