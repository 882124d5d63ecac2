"""Write files and folders whole or not at all, and check the endings of their names."""

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
    """Yield a temporary path. If the block succeeds, the file written there becomes ``path``.

    The temporary file lies in the same folder, since a rename within a file system is atomic, and has the suffix of
    ``path``, since some libraries choose a format by it. It is flushed to disk before the rename: after an error, a
    crash or a kill ``path`` holds either the old or the new content. A symbolic link's target is replaced. Raises
    `BadInput` if the folder does not exist, or cannot be written to, and `OSError` naming ``path`` if writing failed.
    """
    target = Path(os.path.realpath(path))
    temporary = target.with_name(f".{target.stem}.{secrets.token_hex(4)}.partial{target.suffix}")
    # Create the file before the block: it gets the usual permissions, and a missing folder fails at once.
    try:
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    except OSError as error:
        raise BadInput(f"{path}: cannot be written ({error.strerror}); name a file in a folder that is there") from None
    try:
        with errors_naming(path, temporary):
            yield temporary
            if target.exists():
                temporary.chmod(target.stat().st_mode & 0o777)
            _flush(temporary)
            os.replace(temporary, target)
            _flush(target.parent)
    finally:
        temporary.unlink(missing_ok=True)


def write_file(path: str | os.PathLike[str], content: bytes | str | Iterable[str]) -> Path:
    """Write bytes, a text or lines of text, whole or not at all, gzipped if the name ends in .gz. Returns the path.
    Raises `BadInput` if the folder does not exist, or cannot be written to.
    """
    target = Path(path)
    if not isinstance(content, bytes):
        content = (content if isinstance(content, str) else "".join(f"{line}\n" for line in content)).encode()
    with write_whole(target) as partial:
        # No time stamp and no name in the header: the same content gives the same bytes.
        partial.write_bytes(gzip.compress(content, mtime=0) if target.suffix == ".gz" else content)
    return target


@contextlib.contextmanager
def write_whole_folder(path: str | os.PathLike[str], may_replace: Callable[[Path], bool]) -> Iterator[Path]:
    """Yield the name of a temporary folder, to be made by the block. If the block succeeds, it becomes ``path``.

    An older folder at ``path`` is removed whole, but only if ``may_replace`` accepts it: a typing error must not delete
    a folder with other content. If the block raises an error, ``path`` is unchanged. Raises `BadInput` if ``path`` may
    not be replaced, or its parent folder is missing or not writable, and `OSError` naming ``path`` if writing failed.
    """
    target = Path(os.path.realpath(path))
    if os.path.lexists(target) and not (target.is_dir() and (not any(target.iterdir()) or may_replace(target))):
        raise BadInput(f"{path}: is there already and holds other things; name a folder that is not there yet")
    mark = secrets.token_hex(4)
    temporary, old = (target.with_name(f".{target.name}.{mark}.{what}") for what in ("partial", "old"))
    # Make a folder and remove it: no other check tells for sure that one can be made.
    try:
        temporary.mkdir()
        temporary.rmdir()
    except OSError as error:
        reason = f"cannot be written ({error.strerror}); name a folder inside one that is there, and yours"
        raise BadInput(f"{path}: {reason}") from None
    try:
        with errors_naming(path, temporary):
            yield temporary
        # Move the old folder away, and back again if the new one cannot take its place.
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
def errors_naming(path: str | os.PathLike[str], temporary: Path) -> Iterator[None]:
    """Convert a write error of any library into an `OSError` that names ``path``."""
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
    """Flush a file or a folder to disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def run_in(folder: str | os.PathLike[str]) -> str | None:
    """Return which saved run to give instead of a folder, in words; None if neither it nor a folder in it has one."""
    if (Path(folder) / "run.nc").is_file():
        return "a folder; give the run.nc in it"
    inside = sorted(map(str, Path(folder).glob("*/run.nc")))
    more = f" ({len(inside) - 10:,} more)" if len(inside) > 10 else ""
    return f"a folder of runs; give one of them: {', '.join(inside[:10])}{more}" if inside else None


def need_ending(path: str | os.PathLike[str], endings: tuple[str, ...], kind: str) -> tuple[Path, str]:
    """Return the path, and its ending in lower case without the dot. Raises `BadInput` for an ending that is not among
    ``endings``, or a missing folder, before any slow work.
    """
    target = Path(path)
    ending = target.suffix.lower().removeprefix(".")
    if ending not in endings:
        known = ", ".join("." + e for e in endings)
        raise BadInput(f"{kind}: cannot tell the format of '{target}'; end its name in one of {known}")
    if not target.parent.is_dir():
        raise BadInput(f"{kind}: the folder '{target.parent}' does not exist; make it first")
    return target, ending
