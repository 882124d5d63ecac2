"""Files that are written whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import sqlite3
from collections.abc import Iterator
from pathlib import Path

from bayesmap.errors import BadInput


@contextlib.contextmanager
def write_whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a temporary path; when the block ends well, what was written there becomes ``path``.

    The temporary file lies in the same folder (a rename within a file system is atomic) and keeps the suffix
    of ``path`` (some libraries choose a format by it). It is flushed to disk before the rename, so that after
    a crash or a kill ``path`` holds all of the old content or all of the new. A symbolic link is followed:
    the file that it points to is replaced.

    If the block raises, the temporary file is removed and ``path`` is as it was.

    Raises:
        BadInput: the folder does not exist, or cannot be written to.
        OSError: writing failed, as on a full disk; it names ``path``.
    """
    target = Path(os.path.realpath(path))
    temporary = target.with_name(f".{target.stem}.{secrets.token_hex(4)}.partial{target.suffix}")
    # Made here, not by the block: the usual permissions apply, and a missing folder is noticed at once.
    try:
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    except OSError as error:
        raise BadInput(f"{path}: cannot be written ({error.strerror}); name a file in a folder that is there") from None
    try:
        with naming(path, temporary):
            yield temporary
            if target.exists():
                temporary.chmod(target.stat().st_mode & 0o777)
            _flush(temporary)
            os.replace(temporary, target)
            _flush(target.parent)
    finally:
        temporary.unlink(missing_ok=True)


@contextlib.contextmanager
def naming(path: str | os.PathLike[str], temporary: Path) -> Iterator[None]:
    """A failure to write becomes an `OSError` that names ``path``, whichever library has met it under which name."""
    try:
        yield
    except OSError as error:
        if error.filename is not None and not str(error.filename).startswith(str(temporary)):
            raise
        raise OSError(error.errno or errno.EIO, error.strerror or str(error), os.fspath(path)) from error
    except (RuntimeError, sqlite3.OperationalError) as error:
        if isinstance(error, RuntimeError) and not str(error).startswith("NetCDF"):
            raise
        raise OSError(errno.EIO, f"writing failed; is the disk full? ({error})", os.fspath(path)) from error


def _flush(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
