"""Several logs on a Ray cluster: each is read here, and inferred by a task of its own."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bayesmap.cli import inferring
from bayesmap.cli.command import Call
from bayesmap.cli.fleet_entry import Entry
from bayesmap.cli.fleet_worker import Sent, StopFlag, infer_log
from bayesmap.cli.progress import STAGES, described_share

if TYPE_CHECKING:
    from bayesmap.api import Event

RETRIES = 3
"""How often a log is begun again, at its last checkpoint, whose worker has died."""
WAIT_S = 0.25
STOP_S = 30.0
"""How long workers that were asked to stop may take to send where their chains stand."""
SHOWN = 3
"""Logs that the bar names."""
SAMPLING = ("warm-up", "draws")
FLAG_WAITERS = 100_000
"""Workers that may wait for the flag at a time."""


class RayFleet:
    """A fleet on a Ray cluster: each log is read here, and inferred by a task of its own."""

    def __init__(self, call: Call, address: str | None, attempt: Callable[[Entry, Callable[[], Any]], Any]) -> None:
        from bayesmap.run.ray_cluster import connect

        self.call, self.attempt, self.ray = call, attempt, connect(address)
        self.running: dict[Any, Entry] = {}
        self.readings: dict[str, Any] = {}
        self.latest: dict[str, Event] = {}
        # An actor without a CPU of its own: workers wait for its answer while their chains go on. It is on this
        # process's node, and on no other: on one that dies, or has just died, nobody would hear of Ctrl-C.
        here = self.ray.util.scheduling_strategies.NodeAffinitySchedulingStrategy(
            self.ray.get_runtime_context().get_node_id(), soft=False
        )
        options = {"num_cpus": 0, "max_concurrency": FLAG_WAITERS, "scheduling_strategy": here}
        self.flag = self.ray.remote(StopFlag).options(**options).remote()
        self.stopping = False

    def run(self, entries: list[Entry]) -> None:
        """Infer them all; as many are read ahead as the cluster can work on. Ctrl-C lets workers save first."""
        waiting, total = list(reversed(entries)), len(entries)
        try:
            with described_share(self.call.console, f"0 of {total} logs") as show:
                while waiting or self.running:
                    while waiting and len(self.running) < self._most_at_once(waiting[-1]):
                        entry = waiting.pop()
                        self.attempt(entry, functools.partial(self._begin, entry))
                    if self.running:
                        self._take_some()
                    show(*self._how_far(total - len(waiting) - len(self.running), total))
        except KeyboardInterrupt:
            self._stop()
            raise
        finally:
            for stream in self.running:
                self.ray.cancel(stream, force=True)
            self.running.clear()
            self.ray.kill(self.flag)

    def _stop(self) -> None:
        """Ask workers to save where their chains stand, and take what they send, for some time."""
        if not self.running:
            return
        self.call.console.say("stopping: what the workers have is fetched; Ctrl-C again leaves it")
        self.stopping = True
        self.flag.set.remote()
        deadline = time.monotonic() + STOP_S
        while self.running and time.monotonic() < deadline:
            self._take_some()

    def _take_some(self) -> None:
        """Wait a moment for what workers send."""
        ready, _ = self.ray.wait(list(self.running), num_returns=1, timeout=WAIT_S)
        for stream in ready:
            entry = self.running[stream]
            if self.attempt(entry, functools.partial(self._take, stream, entry)) is None:
                self.running.pop(stream, None)

    def _how_far(self, done: int, total: int) -> tuple[str, float]:
        """What the bar says, and the share of all logs that is done."""
        words, share = [f"{done} of {total} logs"], float(done)
        for entry in self.running.values():
            event = self.latest.get(entry.log)
            if event is None:
                continue
            words.append(f"{entry.folder.path.name} {STAGES[event.stage][0]} {event.done:,}/{event.total:,}")
            share += event.done / event.total if event.stage in SAMPLING and event.total else 0.0
        more = f", {len(words) - 1 - SHOWN} more" if len(words) > SHOWN + 1 else ""
        return ", ".join(words[: SHOWN + 1]) + more, share / max(total, 1)

    def _most_at_once(self, entry: Entry) -> int:
        return max(1, int(self.ray.cluster_resources().get("CPU", 1)) // self._cpus(entry))

    @staticmethod
    def _cpus(entry: Entry) -> int:
        return int(entry.values["threads"] or 1)

    def _begin(self, entry: Entry) -> bool:
        """Read a log, put its scans into the object store, and give it to a worker."""
        reading = inferring.read(self.call.console, entry.log, entry.values)
        self.readings[entry.log] = self.ray.put(reading)
        self._submit(entry, resuming=entry.folder.resuming)
        return True

    def _submit(self, entry: Entry, *, resuming: bool) -> None:
        folder, before = entry.folder, {}
        if resuming and folder.run.exists() and not folder.outdated.exists():
            before = {path.name: path.read_bytes() for path in (folder.run, folder.config) if path.exists()}
        cpus = self._cpus(entry)
        options = {
            "num_cpus": cpus, "num_gpus": int(entry.values["device"] != "cpu"), "num_returns": "streaming",
            "max_retries": 0,  # a retry begins at the last checkpoint, which only this process has
        }  # fmt: skip
        work = self.ray.remote(infer_log).options(**options)
        values = {**entry.values, "threads": cpus}
        self.running[work.remote(self.readings[entry.log], values, entry.sensor, before, self.flag)] = entry

    def _take(self, stream: Any, entry: Entry) -> bool:
        """Take what a worker has sent; true, unless it failed for good."""
        from bayesmap.run.ray_cluster import failed, outcome

        try:
            sent = outcome(self.ray, next(stream))
        except StopIteration:
            self.running.pop(stream)
            return True
        except self.ray.exceptions.RayError as error:
            self.running.pop(stream)
            if self.stopping:
                return True
            entry.deaths += 1
            if entry.deaths > RETRIES:
                raise failed(error) from error
            self.call.console.say(f"{entry.log}: its worker died; another goes on from the last checkpoint")
            self._submit(entry, resuming=entry.folder.begun or entry.folder.resuming)
            return True
        self._keep(entry, sent)
        return True

    def _keep(self, entry: Entry, sent: Sent) -> None:
        """Note how far a worker is, and write the files that it has sent into the log's folder."""
        from bayesmap.files import write_whole

        if sent.event is not None:
            self.latest[entry.log] = sent.event
        if not sent.files:
            return
        folder, files = entry.folder, dict(sent.files)
        folder.begin(files.pop(folder.config.name).decode())
        if folder.run.name in files and folder.outdated.exists():
            folder.replace()
        if sent.document is not None:
            folder_of = {name: str(folder.path / name) for name in sent.document["outputs"]}
            entry.document = {**sent.document, "outputs": folder_of}
            files.pop("summary.json", None)
        for name, content in files.items():
            with write_whole(folder.path / name) as partial:
                partial.write_bytes(content)
        if entry.document is not None:
            folder.write_document(entry.document)
            self.readings.pop(entry.log, None)
            self.call.console.say(f"{entry.log}: finished")
            inferring.report(self.call.console, entry.document)
