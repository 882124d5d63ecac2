"""What a worker of a Ray cluster does for a fleet: infer one log, and send what it leaves behind."""

from __future__ import annotations

import asyncio
import contextlib
import queue
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bayesmap.cli import inferring
from bayesmap.cli.console import Console
from bayesmap.cli.folder import Folder

if TYPE_CHECKING:
    from bayesmap.api import Event
    from bayesmap.io.log_reading import LogReading
    from bayesmap.run.chains import Chains
    from bayesmap.run.runner import Job
    from bayesmap.samplers.progress import Watch
    from bayesmap.sensors.model import SensorModel

EVENT_S = 1.0
"""From one word of how far a worker is to the next, seconds."""


@dataclass(frozen=True, eq=False)
class Sent:
    """What came from a worker.

    Attributes:
        files: contents of files of the run's folder, by name.
        document: the JSON document, once the run is finished.
        event: how far it is.
        last: nothing comes after it.
    """

    files: dict[str, bytes] = field(default_factory=dict)
    document: dict[str, Any] | None = None
    event: Event | None = None
    last: bool = False


class StopFlag:
    """An actor of the cluster that workers wait for: Ctrl-C sets it."""

    def __init__(self) -> None:
        self._set = asyncio.Event()

    async def wait(self) -> None:
        """Return when it is set."""
        await self._set.wait()

    async def set(self) -> None:
        """Let all who wait go on."""
        self._set.set()


@dataclass(frozen=True)
class _Stoppable:
    """Chains on this process's threads that stop at the end of a step when the fleet does.

    Attributes:
        should_stop: asked between two steps.
    """

    should_stop: Callable[[], bool]

    def run(
        self,
        job: Job,
        resume: Chains | None,
        watch: Watch,
        on_checkpoint: Callable[[Chains], None] | None,
        checkpoint_every_s: float,
    ) -> Chains:
        """Run them here."""
        from bayesmap.run.executor import ThreadExecutor

        return ThreadExecutor().run(
            job, resume, replace(watch, should_stop=self.should_stop), on_checkpoint, checkpoint_every_s
        )


def infer_log(
    reading: LogReading,
    values: dict[str, Any],
    sensor: SensorModel | str | None,
    before: dict[str, bytes],
    flag: Any,
) -> Iterator[Sent]:
    """Infer one log here, in a folder of this machine.

    Args:
        reading: the log.
        values: the command's settings.
        sensor: as `bayesmap.infer` takes it.
        before: files of the run to go on with; none to begin.
        flag: the `StopFlag` of the fleet.

    Yields:
        How far it is, the files after each checkpoint, and all with the document at the end; or, when the fleet is
        stopped, the files as they are then.
    """
    sent: queue.SimpleQueue[Sent | BaseException] = queue.SimpleQueue()
    stopped = threading.Event()
    threading.Thread(target=_listen, args=(flag, stopped), daemon=True).start()
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as place:
        folder = Folder(Path(place), Console(quiet=True, bar=False), resuming=bool(before))
        for name, content in before.items():
            (folder.path / name).write_bytes(content)

        def files() -> dict[str, bytes]:
            return {path.name: path.read_bytes() for path in folder.path.iterdir()}

        said_at = -EVENT_S

        def on_event(event: Event) -> None:
            nonlocal said_at
            if time.monotonic() - said_at >= EVENT_S:
                said_at = time.monotonic()
                sent.put(Sent(event=event))

        def work() -> None:
            try:
                saved = inferring.saved(folder) if folder.run.exists() else None
                train, heldout = inferring.split(reading.scans, values["holdout"])
                run = inferring.sample(
                    folder, reading.scans, train, values, sensor, saved, _Stoppable(stopped.is_set),
                    on_saved=lambda: sent.put(Sent(files())), on_event=on_event,
                )  # fmt: skip
                if run.finished:
                    document = inferring.finish(folder, run, reading, heldout, values["holdout"])
                    sent.put(Sent(files(), document, last=True))
                    return
                if run.posterior.sweep > 0:
                    folder.save(run)
                sent.put(Sent(files(), last=True))
            except BaseException as error:
                sent.put(error)

        # Beside this one, so that a checkpoint can be sent while the chains go on.
        threading.Thread(target=work, daemon=True).start()
        while True:
            one = sent.get()
            if isinstance(one, BaseException):
                raise one
            yield one
            if one.last:
                return


def _listen(flag: Any, stopped: threading.Event) -> None:
    """Wait until the fleet is stopped; where the flag has gone, nobody will say so."""
    import ray

    with contextlib.suppress(ray.exceptions.RayError):
        ray.get(flag.wait.remote())
        stopped.set()
