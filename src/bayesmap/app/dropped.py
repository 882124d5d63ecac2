"""Saved runs that are dropped onto the page: the server takes the file, and answers with its recording.

A process of its own reads the file and makes the recording. So a damaged file cannot stop the server.
"""

from __future__ import annotations

import asyncio
import sys
import tempfile
from pathlib import Path

from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from bayesmap.errors import BadInput

MAX_FILE_BYTES = 1 << 30


async def open_dropped(request: Request) -> Response:
    """Answer a saved run, the request's body, with its recording or a text about its fault. The query has its name."""
    name = Path(request.query_params.get("name", "")).name
    if not name.endswith(".nc"):
        return PlainTextResponse("not a saved run (.nc)", status_code=415)
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as folder:
        path, size = Path(folder) / name, 0
        with path.open("wb") as file:
            async for piece in request.stream():
                size += len(piece)
                if size > MAX_FILE_BYTES:
                    return PlainTextResponse("too large for the page; start bayesmap app with it", status_code=413)
                file.write(piece)
        command = (sys.executable, "-m", "bayesmap.app.dropped", str(path))
        pipe = asyncio.subprocess.PIPE
        reader = await asyncio.create_subprocess_exec(*command, stdin=pipe, stdout=pipe, stderr=pipe)
        recording, why = await reader.communicate()
    if reader.returncode == 0:
        return Response(recording, media_type="application/octet-stream")
    lines = why.decode(errors="replace").replace(f"{folder}/", "").splitlines()
    return PlainTextResponse(lines[-1] if lines else "it cannot be read", status_code=422)


def main(path: str) -> None:
    """Write the recording of a saved run to the standard output."""
    from bayesmap.app.exports import encode_recording, record
    from bayesmap.app.sources import OpenedRun, open_file

    opened = open_file(path)
    assert isinstance(opened, OpenedRun)
    sys.stdout.buffer.write(encode_recording(*record(opened.result)))


if __name__ == "__main__":
    try:
        main(sys.argv[1])
    except (BadInput, OSError, ValueError) as error:
        sys.exit(str(error))
