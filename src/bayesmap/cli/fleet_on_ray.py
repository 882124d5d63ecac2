"""A fleet of logs on a Ray cluster, for `bayesmap.cli.infer`.

`RayFleet` starts one task per log, `infer_on_worker`. Workers send files and progress to a `Mailbox`, and the process
that started the fleet stores them in the logs' folders. A log whose worker dies goes on from its last checkpoint.
"""

import tempfile
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import msgspec

from bayesmap.cli.console import SAMPLING, STAGES, Console, share_bar
from bayesmap.cli.folder import Folder
from bayesmap.cli.keys import InferSettings
from bayesmap.cli.pipeline import Task, infer_log, print_report, read_scan_log
from bayesmap.files import write_file

if TYPE_CHECKING:
    from bayesmap.api import Event
    from bayesmap.io.log_reading import ScanLog

MAX_RETRIES = 3  # number of times that a log is restarted from its last checkpoint after its worker has died
WAIT_S = 0.25  # time between two checks of the workers
EVENT_S = 1.0  # time between two progress messages of a worker
STOP_S = 30.0  # longest wait for the workers after Ctrl-C
MAX_NAMED_LOGS = 3  # number of logs that the progress bar names
TaskRef = Any  # reference to a task on the cluster, `ray.ObjectRef`
LogRef = Any  # reference to a log in the cluster's object store, `ray.ObjectRef`


@dataclass
class FleetLog:
    """One log of a fleet, and its progress."""

    log: str  # path of the log, as typed
    path: Path  # folder of its run
    task: Task[InferSettings] | None = None  # the log with its settings; None until these are checked
    document: dict[str, Any] | None = None  # JSON document of the finished run
    error: str | None = None  # reason why there is no run
    event: "Event | None" = None  # latest progress of its worker
    deaths: int = 0  # number of workers that died with this log

    @property
    def checked_task(self) -> Task[InferSettings]:
        """The task of a log whose settings were checked."""
        assert self.task is not None
        return self.task

    @property
    def problems(self) -> list[str]:
        """The problems that the diagnostics report."""
        return [] if self.document is None else list(self.document["problems"])

    def fail(self, error: Exception, console: Console) -> None:
        """Store and print why there is no run. Errors of usage are raised, since they concern all logs."""
        from bayesmap.cli.group import exit_code_and_message

        if isinstance(error, click.ClickException | click.exceptions.Exit):
            raise error
        self.error = " ".join(exit_code_and_message(error)[1].split()).removeprefix(f"{self.log}: ")
        console.warn(f"{self.log}: {self.error}")

    def as_json(self) -> dict[str, Any]:
        """Return the entry of the log in the JSON document."""
        return {"log": self.log, "folder": str(self.path), "error": self.error, "run": self.document}


class RayFleet:
    """A fleet on a Ray cluster. This process reads the logs and writes the files; one task per log infers."""

    def __init__(self, console: Console, address: str | None) -> None:
        from bayesmap.run.ray_executor import connect

        self.console = console
        self.ray = connect(address)
        self.fleet: dict[str, FleetLog] = {}  # all logs, by path
        self.running: dict[TaskRef, FleetLog] = {}  # logs by the references of their tasks
        self.logs: dict[str, LogRef] = {}  # references to the logs that were read, by path
        # Run the mailbox on this process's node: if another node died with it, Ctrl-C would not reach the workers.
        own_node = self.ray.util.scheduling_strategies.NodeAffinitySchedulingStrategy(
            self.ray.get_runtime_context().get_node_id(), soft=False
        )
        self.mailbox = self.ray.remote(Mailbox).options(num_cpus=0, scheduling_strategy=own_node).remote()
        self.stopping = False  # whether Ctrl-C was pressed

    def run(self, fleet: list[FleetLog]) -> None:
        """Infer all logs, at most as many at once as the cluster can run. After Ctrl-C workers save first."""
        waiting, self.fleet = list(reversed(fleet)), {entry.log: entry for entry in fleet}
        try:
            with share_bar(self.console, f"0 of {len(fleet)} logs") as show:
                while waiting or self.running:
                    while waiting and len(self.running) < self.max_at_once(waiting[-1]):
                        self._begin(waiting.pop())
                    self._handle_messages()
                    show(*self._progress(len(fleet) - len(waiting) - len(self.running), len(fleet)))
        except KeyboardInterrupt:
            self._stop()
            raise
        finally:
            # Ray's cancel could abort this process. Without a mailbox a worker fails at its next message instead.
            self.running.clear()
            self.ray.kill(self.mailbox)

    def max_at_once(self, entry: FleetLog) -> int:
        """Return the number of logs that the cluster can infer at the same time."""
        settings = entry.checked_task.settings
        unit, n_each = ("CPU", settings.threads or 1) if settings.device == "cpu" else ("GPU", 1)
        return max(1, int(self.ray.cluster_resources().get(unit, 1)) // n_each)

    def _begin(self, entry: FleetLog) -> None:
        """Read a log, put it into the object store, and start its task."""
        try:
            log = read_scan_log(self.console, entry.log, entry.checked_task.settings)
        except Exception as error:
            entry.fail(error, self.console)
            return
        self.logs[entry.log] = self.ray.put(log)
        self._submit(entry, resuming=entry.checked_task.folder.resuming)

    def _submit(self, entry: FleetLog, *, resuming: bool) -> None:
        """Start the task of a log, from the last checkpoint in its folder if ``resuming``."""
        task, folder, files = entry.checked_task, entry.checked_task.folder, {}
        if resuming and folder.run_path.exists() and not folder.outdated_path.exists():
            files = {path.name: path.read_bytes() for path in (folder.run_path, folder.config_path) if path.exists()}
        cpus, gpus = task.settings.threads or 1, int(task.settings.device != "cpu")
        # No retries by Ray: they would not resume from the last checkpoint.
        remote = self.ray.remote(infer_on_worker).options(num_cpus=cpus, num_gpus=gpus, max_retries=0)
        task = replace(task, settings=msgspec.structs.replace(task.settings, threads=cpus))
        self.running[remote.remote(task, self.logs[entry.log], files, self.mailbox)] = entry

    def _handle_messages(self) -> None:
        """Wait `WAIT_S` for workers, store their messages, and handle the tasks that have ended."""
        from bayesmap.run.ray_executor import task_result, worker_death

        ended, _ = self.ray.wait(list(self.running), timeout=WAIT_S) if self.running else ([], None)
        # Store the messages first: the last one of a task that has ended holds its result.
        for log, message in self.ray.get(self.mailbox.take.remote()):
            try:
                self.store(self.fleet[log], message)
            except OSError as error:
                self.fleet[log].fail(error, self.console)
        for task in ended:
            entry = self.running.pop(task)
            try:
                task_result(self.ray, task)
            except self.ray.exceptions.RayError as error:  # the worker died
                entry.deaths += 1
                if entry.deaths > MAX_RETRIES:
                    entry.fail(worker_death(error), self.console)
                elif not self.stopping:
                    self.console.say(f"{entry.log}: its worker died; another goes on from the last checkpoint")
                    folder = entry.checked_task.folder
                    self._submit(entry, resuming=folder.begun or folder.resuming)
            except Exception as error:
                entry.fail(error, self.console)

    def store(self, entry: FleetLog, message: "Message") -> None:
        """Store a worker's progress, and write the files of its message into the log's folder."""
        entry.event = message.event or entry.event
        if not message.files or entry.error is not None:
            return
        folder, files = entry.checked_task.folder, dict(message.files)
        folder.begin(files.pop(folder.config_path.name).decode())
        if folder.run_path.name in files and folder.outdated_path.exists():
            folder.start_afresh()
        files.pop("summary.json", None)
        for name, content in files.items():
            write_file(folder.path / name, content)
        if message.document is not None:  # with the names of the files in the worker's folder
            outputs = {name: str(folder.path / name) for name in message.document["outputs"]}
            entry.document = {**message.document, "outputs": outputs}
            folder.write_document(entry.document)
            self.logs.pop(entry.log, None)
            self.console.say(f"{entry.log}: finished")
            print_report(self.console, entry.document)

    def _stop(self) -> None:
        """Ask workers to save their chains, and store their messages for at most `STOP_S`."""
        if not self.running:
            return
        self.console.say("stopping: what the workers have is fetched; Ctrl-C again leaves it")
        self.stopping = True
        self.ray.get(self.mailbox.stop.remote())
        deadline = time.monotonic() + STOP_S
        while self.running and time.monotonic() < deadline:
            self._handle_messages()

    def _progress(self, n_ended: int, n_logs: int) -> tuple[float, str]:
        """Return the share of the work that is done, and the progress of the logs in words."""
        words, logs_done = [f"{n_ended} of {n_logs} logs"], float(n_ended)
        for entry in self.running.values():
            event = entry.event
            if event is not None:
                words.append(f"{entry.path.name} {STAGES[event.stage][0]} {event.done:,}/{event.total:,}")
                logs_done += event.done / event.total if event.stage in SAMPLING and event.total else 0.0
        more = f", {len(words) - 1 - MAX_NAMED_LOGS} more" if len(words) > MAX_NAMED_LOGS + 1 else ""
        return logs_done / max(n_logs, 1), ", ".join(words[: MAX_NAMED_LOGS + 1]) + more


@dataclass(frozen=True, eq=False)
class Message:
    """A message from a worker."""

    files: dict[str, bytes] = field(default_factory=dict)  # contents of the files in the run's folder, by name
    document: dict[str, Any] | None = None  # JSON document of the finished run; None before
    event: "Event | None" = None  # progress of the run


class Mailbox:
    """A Ray actor that passes messages from the workers of a fleet to the process that started it."""

    def __init__(self) -> None:
        self._messages: list[tuple[str, Message]] = []
        self._stop = False

    def send(self, log: str, message: Message) -> bool:
        """Store a worker's message about a log. Return whether the worker should stop."""
        self._messages.append((log, message))
        return self._stop

    def take(self) -> list[tuple[str, Message]]:
        """Return the messages since the last call, in order."""
        messages, self._messages = self._messages, []
        return messages

    def stop(self) -> None:
        """Ask all workers to stop."""
        self._stop = True


class _Sender:
    """Sends the files and the progress of a worker to the mailbox, and learns whether to stop."""

    def __init__(self, log: str, folder: Path, mailbox: Any) -> None:
        self._log, self._folder, self._mailbox = log, folder, mailbox
        self.is_stopped, self._sent_at = False, 0.0

    def send_event(self, event: "Event") -> None:
        """Send the progress, unless a message was sent within `EVENT_S`."""
        if time.monotonic() - self._sent_at >= EVENT_S:
            self._send(Message(event=event))

    def send_files(self, document: dict[str, Any] | None = None) -> None:
        """Send all files of the folder, and the document of a finished run."""
        self._send(Message({path.name: path.read_bytes() for path in self._folder.iterdir()}, document))

    def _send(self, message: Message) -> None:
        import ray

        self.is_stopped, self._sent_at = ray.get(self._mailbox.send.remote(self._log, message)), time.monotonic()


def infer_on_worker(task: Task[InferSettings], log: "ScanLog", files: dict[str, bytes], mailbox: Any) -> None:
    """Infer a log in a worker's folder that starts with the given files; send all files after each checkpoint."""
    from bayesmap.run.runner import ThreadExecutor

    with tempfile.TemporaryDirectory(prefix="bayesmap-") as scratch:
        sender = _Sender(task.log, Path(scratch), mailbox)
        for name, content in files.items():
            (Path(scratch) / name).write_bytes(content)
        folder = Folder(Path(scratch), Console(quiet=True, bar=False), resuming=bool(files))
        document = infer_log(
            replace(task, folder=folder), log=log, executor=ThreadExecutor(lambda: sender.is_stopped),
            on_saved=sender.send_files, on_event=sender.send_event,
        )  # fmt: skip
        sender.send_files(document if document["finished"] else None)
