"""Write files and folders whole or not at all, and check the endings of their names.

Content goes to a temporary name beside the target, and a rename, which is atomic, puts it in place: a program that is
stopped while it writes leaves the old file. See `write_whole`, `write_file` and `write_whole_folder`.
"""

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

PICTURE_MARK = "bayesmap"  # the program's name in the first thousand bytes of each PNG and GIF picture
NETCDF_MAGICS = (b"\x89HDF", b"CDF")  # first bytes of netCDF files, such as saved runs


@contextlib.contextmanager
def write_whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a temporary path. If the block succeeds, the file written there becomes ``path``.
    The temporary file has the suffix of ``path``, since some libraries choose a format by it. It is flushed to disk
    before the rename: after an error, a crash or a kill ``path`` holds either the old or the new content. A symbolic
    link's target is replaced. Raises `BadInput` for no folder, or none to write to, and `OSError` if writing fails.
    """
    target = Path(os.path.realpath(path))
    temporary = target.with_name(f".{target.stem}.{secrets.token_hex(4)}.partial{target.suffix}")
    # Create the file before the block: it gets the usual permissions, and a missing folder fails at once.
    try:
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    except OSError as error:
        raise BadInput(f"{path}: cannot be written ({error.strerror}); name a file in a folder that is there") from None
    try:
        with name_path_in_errors(path, temporary):
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
    Raises `BadInput` if the folder does not exist, or is not writable.
    """
    target = Path(path)
    if not isinstance(content, bytes):
        content = (content if isinstance(content, str) else "".join(f"{line}\n" for line in content)).encode()
    with write_whole(target) as temporary:
        # No time stamp and no name in the header: the same content gives the same bytes.
        temporary.write_bytes(gzip.compress(content, mtime=0) if target.suffix == ".gz" else content)
    return target


@contextlib.contextmanager
def write_whole_folder(path: str | os.PathLike[str], may_replace: Callable[[Path], bool]) -> Iterator[Path]:
    """Yield the name of a temporary folder, to be made by the block. If the block succeeds, it becomes ``path``.
    An older folder at ``path`` is removed whole, but only if ``may_replace`` accepts it: a typing error must not delete
    a folder with other content. If the block raises an error, ``path`` is unchanged. Raises `BadInput` if ``path`` may
    not be replaced, or its parent folder is missing or not writable, and `OSError` naming ``path`` if writing failed.
    """
    target = Path(os.path.realpath(path))
    is_replaceable = target.is_dir() and (not any(target.iterdir()) or may_replace(target))
    if os.path.lexists(target) and not is_replaceable:
        raise BadInput(f"{path}: is there already and holds other things; name a folder that is not there yet")
    mark = secrets.token_hex(4)
    temporary = target.with_name(f".{target.name}.{mark}.partial")
    replaced = target.with_name(f".{target.name}.{mark}.old")
    # Make a folder and remove it: no other check tells for sure that one can be made.
    try:
        temporary.mkdir()
        temporary.rmdir()
    except OSError as error:
        reason = f"cannot be written ({error.strerror}); name a folder inside one that is there, and yours"
        raise BadInput(f"{path}: {reason}") from None
    try:
        with name_path_in_errors(path, temporary):
            yield temporary
        # Move the older folder away, and back again if the new one cannot take its place.
        if target.exists():
            os.replace(target, replaced)
        try:
            os.replace(temporary, target)
        except OSError:
            if replaced.exists():
                os.replace(replaced, target)
            raise
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        shutil.rmtree(replaced, ignore_errors=True)


@contextlib.contextmanager
def name_path_in_errors(path: str | os.PathLike[str], temporary: Path) -> Iterator[None]:
    """Convert write errors of any library into an `OSError` that names ``path``; errors of other files stay."""
    try:
        yield
    except OSError as error:
        if error.filename is not None and not str(error.filename).startswith(str(temporary)):
            raise
        raise OSError(error.errno or errno.EIO, error.strerror or str(error), os.fspath(path)) from error
    except (RuntimeError, sqlite3.OperationalError) as error:
        # netCDF4 raises a bare RuntimeError if the disk is full; a RuntimeError of other code is a fault of its own.
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


def is_saved_run(file: str | os.PathLike[str]) -> bool:
    """Return whether a file begins as a saved run. Raises `BadInput` if it cannot be read."""
    if not Path(file).is_file():
        return False
    try:
        with Path(file).open("rb") as start:
            return start.read(4).startswith(NETCDF_MAGICS)
    except OSError as error:
        raise BadInput(f"{file}: cannot be read: {error.strerror or error}") from None


def saved_run_hint(folder: str | os.PathLike[str]) -> str | None:
    """Return a sentence that names the saved runs in a folder and in its folders; None if there is no run."""
    if (Path(folder) / "run.nc").is_file():
        return "a folder; give the run.nc in it"
    runs = sorted(map(str, Path(folder).glob("*/run.nc")))
    more = f" ({len(runs) - 10:,} more)" if len(runs) > 10 else ""
    return f"a folder of runs; give one of them: {', '.join(runs[:10])}{more}" if runs else None


def check_ending(path: str | os.PathLike[str], endings: tuple[str, ...], kind: str) -> tuple[Path, str]:
    """Check a file's name before any slow work. Returns the path, and its ending in lower case without the dot.
    Raises `BadInput`, which names the ``kind`` of file, for an ending not among ``endings``, or a missing folder.
    """
    target = Path(path)
    ending = target.suffix.lower().removeprefix(".")
    if ending not in endings:
        choices = ", ".join("." + choice for choice in endings)
        raise BadInput(f"{kind}: cannot tell the format of '{target}'; end its name in one of {choices}")
    if not target.parent.is_dir():
        raise BadInput(f"{kind}: the folder '{target.parent}' does not exist; make it first")
    return target, ending
