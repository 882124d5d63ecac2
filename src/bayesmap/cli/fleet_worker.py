"""What a worker of a Ray cluster does for a fleet: infer one log, and send what it leaves behind."""

from __future__ import annotations

import queue
import tempfile
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bayesmap.cli import inferring
from bayesmap.cli.console import Console
from bayesmap.cli.folder import Folder

if TYPE_CHECKING:
    from bayesmap.io.log_reading import LogReading
    from bayesmap.sensors.model import SensorModel


@dataclass(frozen=True, eq=False)
class Sent:
    """What came from a worker.

    Attributes:
        files: contents of files of the run's folder, by name.
        document: the JSON document, once the run is finished.
    """

    files: dict[str, bytes]
    document: dict[str, Any] | None = None


def infer_log(
    reading: LogReading, values: dict[str, Any], sensor: SensorModel | str | None, before: dict[str, bytes]
) -> Iterator[Sent]:
    """Infer one log here, in a folder of this machine.

    Args:
        reading: the log.
        values: the command's settings.
        sensor: as `bayesmap.infer` takes it.
        before: files of the run to go on with; none to begin.

    Yields:
        The files after each checkpoint, and all with the document at the end.
    """
    sent: queue.SimpleQueue[Sent | BaseException] = queue.SimpleQueue()
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as place:
        folder = Folder(Path(place), Console(quiet=True, bar=False), resuming=bool(before))
        for name, content in before.items():
            (folder.path / name).write_bytes(content)

        def files() -> dict[str, bytes]:
            return {path.name: path.read_bytes() for path in folder.path.iterdir()}

        def work() -> None:
            try:
                saved = inferring.saved(folder) if folder.run.exists() else None
                train, heldout = inferring.split(reading.scans, values["holdout"])
                run = inferring.sample(
                    folder, reading.scans, train, values, sensor, saved, on_saved=lambda: sent.put(Sent(files()))
                )
                document = inferring.finish(folder, run, reading, heldout, values["holdout"])
                sent.put(Sent(files(), document))
            except BaseException as error:
                sent.put(error)

        # Beside this one, so that a checkpoint can be sent while the chains go on.
        threading.Thread(target=work, daemon=True).start()
        while True:
            one = sent.get()
            if isinstance(one, BaseException):
                raise one
            yield one
            if one.document is not None:
                return
