"""Folders that are written whole or not at all."""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

from bayesmap.errors import BadInput
from bayesmap.io.atomic import naming


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
