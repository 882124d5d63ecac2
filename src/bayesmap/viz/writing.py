"""Pictures reach the disk whole or not at all."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from bayesmap.errors import BadInput


def need_ending(path: str | os.PathLike[str], endings: tuple[str, ...], kind: str) -> tuple[Path, str]:
    """The path, and its ending in lower case without the dot.

    Raises:
        BadInput: an ending that is not among ``endings``, or a folder that is not there. Both are checked
            before anything is drawn, since drawing is what takes the time.
    """
    target = Path(path)
    ending = target.suffix.lower().removeprefix(".")
    if ending not in endings:
        known = ", ".join("." + e for e in endings)
        raise BadInput(f"{kind}: cannot tell the format of '{target}'; end its name in one of {known}")
    if not target.parent.is_dir():
        raise BadInput(f"{kind}: the folder '{target.parent}' does not exist; make it first")
    return target, ending


def write_whole(path: Path, content: bytes) -> None:
    """Write under another name in the same folder, then rename: readers see the old file or the new one.

    Raises:
        OSError: writing failed, as on a full disk; it names ``path``.
    """
    # Not tempfile: its files are private to the user, and would stay so under the final name.
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")
    try:
        with open(temporary, "xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError as error:  # which may name no file, or the temporary one
        raise OSError(error.errno, error.strerror, os.fspath(path)) from error
    finally:
        temporary.unlink(missing_ok=True)
