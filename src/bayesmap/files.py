"""Files and folders that are written whole or not at all, and the formats that their names ask for."""

from __future__ import annotations

import contextlib
import errno
import gzip
import os
import secrets
import shutil
import sqlite3
from collections.abc import Callable, Iterable, Iterator
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


def write_text(path: str | os.PathLike[str], lines: Iterable[str]) -> Path:
    """Write lines of ASCII text, whole or not at all; gzipped if the name ends in .gz. Returns the path.

    Raises:
        BadInput: the folder does not exist, or cannot be written to.
    """
    target, content = Path(path), "".join(f"{line}\n" for line in lines).encode("ascii")
    with write_whole(target) as partial:
        # No time stamp and no name in the header: the same lines give the same bytes.
        partial.write_bytes(gzip.compress(content, mtime=0) if target.suffix == ".gz" else content)
    return target


@contextlib.contextmanager
def write_whole_folder(path: str | os.PathLike[str], may_replace: Callable[[Path], bool]) -> Iterator[Path]:
    """Give the name of a temporary folder; when the block ends well, what it made there becomes ``path``.

    The temporary folder lies beside ``path``, hidden, and is not there yet: the block makes it. A folder of that name
    goes as a whole, and only if ``may_replace`` says that it is of the kind that is written: a slip of the fingers must
    not cost a folder of other things.

    If the block raises, what it made is removed and ``path`` is as it was.

    Raises:
        BadInput: ``path`` is something that may not be replaced, or the folder around it is not there or is not
            writable.
        OSError: writing failed, as on a full disk; it names ``path``.
    """
    target = Path(os.path.realpath(path))
    if os.path.lexists(target) and not (target.is_dir() and (not any(target.iterdir()) or may_replace(target))):
        raise BadInput(f"{path}: is there already and holds other things; name a folder that is not there yet")
    mark = secrets.token_hex(4)
    temporary, old = (target.with_name(f".{target.name}.{mark}.{what}") for what in ("partial", "old"))
    # Tried, not asked: only making a folder tells whether one can be made.
    try:
        temporary.mkdir()
        temporary.rmdir()
    except OSError as error:
        raise BadInput(
            f"{path}: cannot be written ({error.strerror}); name a folder inside one that is there, and yours"
        ) from None
    try:
        with naming(path, temporary):
            yield temporary
        if target.exists():
            os.replace(target, old)
        try:
            os.replace(temporary, target)
        except OSError:
            if old.exists():
                os.replace(old, target)
            raise
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)


@contextlib.contextmanager
def naming(path: str | os.PathLike[str], temporary: Path) -> Iterator[None]:
    """Turn a failure to write into an `OSError` that names ``path``, whichever library raised it."""
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


def need_ending(path: str | os.PathLike[str], endings: tuple[str, ...], kind: str) -> tuple[Path, str]:
    """Return the path, and its ending in lower case without the dot.

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
