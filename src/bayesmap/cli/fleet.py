"""Several logs, each inferred into a folder of its own: one after the other, or on a Ray cluster."""

from __future__ import annotations

import functools
import shlex
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bayesmap.cli import cells, inferring, sensors
from bayesmap.cli.command import FAILURE, INTERRUPTED, PROBLEMS, Call
from bayesmap.cli.executors import ray_address, stdout_for_results
from bayesmap.cli.fleet_worker import Sent, infer_log
from bayesmap.cli.folder import Folder
from bayesmap.cli.input_files import LOG, need_file
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.sensors.model import SensorModel

RETRIES = 3
"""How often a log is begun again, at its last checkpoint, whose worker has died."""
WAIT_S = 0.25


@dataclass
class Entry:
    """One log of a fleet.

    Attributes:
        log: as given.
        folder: of its run.
        values: its settings.
        sensor: as `bayesmap.infer` takes it.
        document: of the finished run.
        error: why there is none.
        deaths: of workers that had it.
    """

    log: str
    folder: Folder
    values: dict[str, Any] = field(default_factory=dict)
    sensor: SensorModel | str | None = None
    document: dict[str, Any] | None = None
    error: str | None = None
    deaths: int = 0

    @property
    def problems(self) -> list[str]:
        """What the diagnostics found."""
        return [] if self.document is None else list(self.document["problems"])

    def as_json(self) -> dict[str, Any]:
        """The entry of the table."""
        return {"log": self.log, "folder": str(self.folder.path), "error": self.error, "run": self.document}


def infer_fleet(call: Call, logs: list[str], output: Path, *, resume: bool, force: bool) -> None:
    """Infer each log into its own folder, and print a table; exits with 1 if one failed.

    Args:
        call: of the command.
        logs: two or more, or what a folder or a pattern held.
        output: the folder of their folders.
        resume: go on with the runs that there are.
        force: replace them.

    Raises:
        BadInput: two logs of one name, or a cluster that cannot be had.
    """
    from bayesmap.cli.group import explain

    names = Counter(inferring.stem(log) for log in logs)
    twice = next((name for name, times in names.items() if times > 1), None)
    if twice is not None:
        raise BadInput(f"{twice}: two of the logs have this name, so their runs would share a folder; rename one")
    entries = [Entry(log, Folder(output / inferring.stem(log), call.console, resuming=resume)) for log in logs]

    def attempt(entry: Entry, what: Callable[[], Any]) -> Any:
        """The result, or None if it failed: the entry says why, and the others go on."""
        try:
            return what()
        except (click.ClickException, click.exceptions.Exit):
            raise
        except Exception as error:
            entry.error = " ".join(explain(error)[1].split()).removeprefix(f"{entry.log}: ")
            call.console.warn(f"{entry.log}: {entry.error}")
            return None

    def check(entry: Entry) -> bool:
        need_file(entry.log, LOG, runs=False)
        entry.values = cells.settled(call.values(inferring.settings_of(entry.folder) if resume else None))
        named = entry.values["sensor"]
        entry.sensor = "fit" if named == "fit" else sensors.sensor_of(named)
        entry.folder.check(force=force)
        return True

    on_ray, address = ray_address(call.values()["executor"])
    ready = [entry for entry in entries if attempt(entry, functools.partial(check, entry))]
    interrupted = False
    try:
        if on_ray:
            with stdout_for_results():
                _RayFleet(call, address, attempt).run(ready)
        else:
            for entry in ready:
                interrupted = attempt(entry, functools.partial(_infer_here, call, entry)) is False
                if interrupted:
                    break
    except KeyboardInterrupt:
        interrupted = True
    if interrupted:
        again = shlex.join(["bayesmap", "infer", *logs, "-o", str(output), "--resume"])
        call.console.say(f"interrupted; what was checkpointed is kept, go on with:\n  {again}")
    document = {"runs": [entry.as_json() for entry in entries], "finished": not interrupted}
    if call.console.as_json:
        call.console.result(document, [])
    else:
        call.console.result({}, table(entries))
    context = click.get_current_context()
    if interrupted:
        context.exit(INTERRUPTED)
    if any(entry.error for entry in entries):
        context.exit(FAILURE)
    if any(entry.values["strict"] and entry.problems for entry in entries):
        context.exit(PROBLEMS)


def table(entries: list[Entry]) -> Iterator[str]:
    """What came out: a line for each log."""
    rows = [("log", "beams", "minutes", "R-hat", "held out", "folder, or what went wrong")]
    for entry in entries:
        if entry.document is None:
            rows.append((entry.log, "-", "-", "-", "-", entry.error or "not finished"))
            continue
        found = entry.document
        rhat, score = found["rhat_max"], found["heldout"]
        rows.append(
            (
                entry.log, f"{found['beams']:,}", f"{found['seconds']['total'] / 60:.1f}",
                "-" if rhat is None else f"{rhat:.2f}", "-" if not score else f"{score['nats_per_beam']:.3f}",
                str(entry.folder.path) + (f" ({len(entry.problems)} problems)" if entry.problems else ""),
            )
        )  # fmt: skip
    widths = [max(len(row[column]) for row in rows) for column in range(5)]
    for row in rows:
        cells_of_row = [row[0].ljust(widths[0]), *(row[column].rjust(widths[column]) for column in range(1, 5)), row[5]]
        yield "  ".join(cells_of_row)


def _infer_here(call: Call, entry: Entry) -> bool:
    """Infer a log in this process; false if it was interrupted."""
    folder, values = entry.folder, entry.values
    reading = inferring.read(call.console, entry.log, values)
    train, heldout = inferring.split(reading.scans, values["holdout"])
    saved = inferring.saved(folder) if folder.resuming else None
    run = inferring.sample(folder, reading.scans, train, values, entry.sensor, saved)
    if not run.finished:
        if run.posterior.sweep > 0:
            run.save(folder.run)
        return False
    entry.document = inferring.finish(folder, run, reading, heldout, values["holdout"])
    inferring.report(call.console, entry.document)
    return True


class _RayFleet:
    """A fleet on a Ray cluster: each log is read here, and inferred by a task of its own."""

    def __init__(self, call: Call, address: str | None, attempt: Callable[[Entry, Callable[[], Any]], Any]) -> None:
        from bayesmap.run.ray_cluster import connect

        self.call, self.attempt, self.ray = call, attempt, connect(address)
        self.running: dict[Any, Entry] = {}
        self.readings: dict[str, Any] = {}

    def run(self, entries: list[Entry]) -> None:
        """Infer them all; as many are read ahead as the cluster can work on."""
        waiting = list(reversed(entries))
        try:
            while waiting or self.running:
                while waiting and len(self.running) < self._most_at_once(waiting[-1]):
                    entry = waiting.pop()
                    self.attempt(entry, functools.partial(self._begin, entry))
                if not self.running:
                    continue
                ready, _ = self.ray.wait(list(self.running), num_returns=1, timeout=WAIT_S)
                for stream in ready:
                    entry = self.running[stream]
                    if self.attempt(entry, functools.partial(self._take, stream, entry)) is None:
                        self.running.pop(stream, None)
        finally:
            for stream in self.running:
                self.ray.cancel(stream, force=True)
            self.running.clear()

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
        if resuming and folder.run.exists():
            before = {path.name: path.read_bytes() for path in (folder.run, folder.config) if path.exists()}
        cpus = self._cpus(entry)
        options = {
            "num_cpus": cpus, "num_gpus": int(entry.values["device"] != "cpu"), "num_returns": "streaming",
            "max_retries": 0,  # a retry begins at the last checkpoint, which only this process has
        }  # fmt: skip
        work = self.ray.remote(infer_log).options(**options)
        values = {**entry.values, "threads": cpus}
        self.running[work.remote(self.readings[entry.log], values, entry.sensor, before)] = entry

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
            entry.deaths += 1
            if entry.deaths > RETRIES:
                raise failed(error) from error
            self.call.console.say(f"{entry.log}: its worker died; another goes on from the last checkpoint")
            self._submit(entry, resuming=entry.folder.begun or entry.folder.resuming)
            return True
        self._keep(entry, sent)
        return True

    def _keep(self, entry: Entry, sent: Sent) -> None:
        """Write the files that a worker has sent into the log's folder."""
        from bayesmap.io.atomic import write_whole

        folder, files = entry.folder, dict(sent.files)
        folder.begin(files.pop(folder.config.name).decode())
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
