"""``bayesmap infer``: from logs to posteriors, pictures and maps.

Several logs form a fleet. Each log is inferred into its own folder, one after the other, or as tasks of a Ray cluster.
"""

from __future__ import annotations

import shlex
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import msgspec

from bayesmap.cli import pipeline
from bayesmap.cli.command import Call, as_toml, command
from bayesmap.cli.console import FAILURE, SAMPLING, STAGES, Console, aligned, exit_unless_good, reserve_stdout, share
from bayesmap.cli.folder import Folder
from bayesmap.cli.keys import InferSettings
from bayesmap.cli.pipeline import Task, infer_log, prepare, read, report, settings_in, stem
from bayesmap.cli.translation import SENSOR_HELP, executor_of, logs_of, ray_address
from bayesmap.errors import BadInput
from bayesmap.files import write_file

if TYPE_CHECKING:
    from bayesmap.api import Event
    from bayesmap.io.log_reading import ScanLog

SETTINGS = "fleet.toml"  # file beside the folders of the runs: the settings of the last fleet
RETRIES = 3  # number of times that a log is restarted from its last checkpoint after its worker has died
WAIT_S = 0.25  # between two checks of the workers
EVENT_S = 1.0  # between two progress messages of a worker
STOP_S = 30.0  # longest wait for the workers after Ctrl-C
NAMED_LOGS = 3  # number of logs that the progress bar names


@dataclass
class Entry:
    """One log of a fleet, and its progress."""

    log: str  # path of the log, as typed
    path: Path  # folder of its run
    task: Task[InferSettings] | None = None  # the log with its settings; None until these are checked
    document: dict[str, Any] | None = None  # JSON document of the finished run
    error: str | None = None  # reason why there is no run
    event: Event | None = None  # latest progress of its worker
    deaths: int = 0  # number of workers that died with this log

    @property
    def ready(self) -> Task[InferSettings]:
        """Return the task of a log whose settings were checked."""
        assert self.task is not None
        return self.task

    @property
    def problems(self) -> list[str]:
        """Return the problems that the diagnostics report."""
        return [] if self.document is None else list(self.document["problems"])

    def fail(self, error: Exception, console: Console) -> None:
        """Store and print why there is no run. Errors of usage are raised, since they concern all logs."""
        from bayesmap.cli.group import explain

        if isinstance(error, click.ClickException | click.exceptions.Exit):
            raise error
        self.error = " ".join(explain(error)[1].split()).removeprefix(f"{self.log}: ")
        console.warn(f"{self.log}: {self.error}")

    def as_json(self) -> dict[str, Any]:
        """Return the entry of the log in the JSON document."""
        return {"log": self.log, "folder": str(self.path), "error": self.error, "run": self.document}


def infer_fleet(call: Call[InferSettings], logs: list[str], output: Path, *, resume: bool, force: bool) -> None:
    """Infer each log into its folder under ``output``, and print a table; exit with code 1 if a log failed."""
    name, count = Counter(map(stem, logs)).most_common(1)[0]
    if count > 1:
        raise BadInput(f"{name}: two of the logs have this name, so their runs would share a folder; rename one")
    # Check the arguments, for all logs together and for each.
    earlier = settings_in(output / SETTINGS, "infer") if resume else None
    settings = call.settings(earlier)
    on_ray, address = ray_address(settings.executor)
    entries = [Entry(log, output / stem(log)) for log in logs]
    for entry in entries:
        try:
            entry.task = prepare(call, entry.log, entry.path, resume=resume, force=force, earlier=earlier)
        except Exception as error:
            entry.fail(error, call.console)
    ready = [entry for entry in entries if entry.task is not None]
    # Save the settings before the first log begins: a resuming process may have to begin the other logs.
    if ready:
        toml = as_toml({"infer": settings})
        output.mkdir(parents=True, exist_ok=True)
        write_file(output / SETTINGS, toml)
        for entry in ready:
            entry.ready.folder.mark_outdated(toml)
    # Infer the logs.
    try:
        if on_ray:
            reserve_stdout()
            RayFleet(call.console, address).run(ready)
            finished = True
        else:
            finished = all(_infer_here(entry, call.console) for entry in ready)
    except KeyboardInterrupt:
        finished = False
    # Print the result.
    if not finished:
        again = shlex.join(["bayesmap", "infer", *logs, "-o", str(output), "--resume"])
        call.console.say(f"interrupted; what was checkpointed is kept, go on with:\n  {again}")
    call.console.result({"runs": [entry.as_json() for entry in entries], "finished": finished}, table(entries))
    exit_unless_good(finished=finished, problems=False)
    if any(entry.error for entry in entries):
        click.get_current_context().exit(FAILURE)
    exit_unless_good(finished=True, problems=any(e.problems and e.ready.settings.strict for e in entries))


def _infer_here(entry: Entry, console: Console) -> bool:
    """Infer a log in this process. Return False if it was interrupted."""
    try:
        document = infer_log(entry.ready)
    except Exception as error:
        entry.fail(error, console)
        return True
    entry.document = document if document["finished"] else None
    return entry.document is not None


def table(entries: list[Entry]) -> Iterator[str]:
    """Yield the lines of the table: a heading, and one line per log."""
    rows = [("log", "beams", "minutes", "R-hat", "held out", "folder, or what went wrong")]
    for entry in entries:
        run = entry.document
        if run is None:
            rows.append((entry.log, "-", "-", "-", "-", entry.error or "not finished"))
            continue
        rhat, score = run["rhat_max"], run["heldout"]
        rhat, nats = "-" if rhat is None else f"{rhat:.2f}", "-" if not score else f"{score['nats_per_beam']:.3f}"
        path = str(entry.path) + (f" ({len(entry.problems)} problems)" if entry.problems else "")
        rows.append((entry.log, f"{run['beams']:,}", f"{run['seconds']['total'] / 60:.1f}", rhat, nats, path))
    *numbers, last = zip(*rows, strict=True)
    for line, text in zip(aligned(list(zip(*numbers, strict=True))), last, strict=True):
        yield f"{line}  {text}"


@dataclass(frozen=True, eq=False)
class Message:
    """A message from a worker."""

    files: dict[str, bytes] = field(default_factory=dict)  # contents of the files in the run's folder, by name
    document: dict[str, Any] | None = None  # JSON document of the finished run; None before
    event: Event | None = None  # progress of the run


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


def work(task: Task[InferSettings], log: ScanLog, files: dict[str, bytes], mailbox: Any) -> None:
    """Infer a log in a worker's folder that starts with the given files; send all files after each checkpoint."""
    import ray

    from bayesmap.run.runner import ThreadExecutor

    stopped, sent_at = False, 0.0

    def send(message: Message) -> None:
        nonlocal stopped, sent_at
        stopped = ray.get(mailbox.send.remote(task.log, message))
        sent_at = time.monotonic()

    def on_event(event: Event) -> None:
        if time.monotonic() - sent_at >= EVENT_S:
            send(Message(event=event))

    with tempfile.TemporaryDirectory(prefix="bayesmap-") as scratch:

        def files_now() -> dict[str, bytes]:
            return {path.name: path.read_bytes() for path in Path(scratch).iterdir()}

        for name, content in files.items():
            (Path(scratch) / name).write_bytes(content)
        folder = Folder(Path(scratch), Console(quiet=True, bar=False), resuming=bool(files))
        document = infer_log(
            replace(task, folder=folder), log=log, executor=ThreadExecutor(lambda: stopped),
            on_saved=lambda: send(Message(files_now())), on_event=on_event,
        )  # fmt: skip
        send(Message(files_now(), document if document["finished"] else None))


class RayFleet:
    """A fleet on a Ray cluster. This process reads the logs and writes the files; one task per log infers."""

    def __init__(self, console: Console, address: str | None) -> None:
        from bayesmap.run.ray_executor import connect

        self.console, self.ray = console, connect(address)
        self.entries: dict[str, Entry] = {}
        self.running: dict[Any, Entry] = {}
        self.logs: dict[str, Any] = {}  # references to the logs that were read, by path
        # Run the mailbox on this process's node: if another node died with it, Ctrl-C would not reach the workers.
        own_node = self.ray.util.scheduling_strategies.NodeAffinitySchedulingStrategy(
            self.ray.get_runtime_context().get_node_id(), soft=False
        )
        self.mailbox = self.ray.remote(Mailbox).options(num_cpus=0, scheduling_strategy=own_node).remote()
        self.stopping = False

    def run(self, entries: list[Entry]) -> None:
        """Infer all logs, at most as many at once as the cluster can run. After Ctrl-C workers save first."""
        waiting, self.entries = list(reversed(entries)), {entry.log: entry for entry in entries}
        try:
            with share(self.console, f"0 of {len(entries)} logs") as show:
                while waiting or self.running:
                    while waiting and len(self.running) < self.most_at_once(waiting[-1]):
                        self._begin(waiting.pop())
                    self._handle_messages()
                    show(*self._progress(len(entries) - len(waiting) - len(self.running), len(entries)))
        except KeyboardInterrupt:
            self._stop()
            raise
        finally:
            # Ray's cancel could abort this process. Without a mailbox a worker fails at its next message instead.
            self.running.clear()
            self.ray.kill(self.mailbox)

    def most_at_once(self, entry: Entry) -> int:
        """Return the number of logs that the cluster can infer at the same time."""
        return max(1, int(self.ray.cluster_resources().get("CPU", 1)) // (entry.ready.settings.threads or 1))

    def _begin(self, entry: Entry) -> None:
        try:
            log = read(self.console, entry.log, entry.ready.settings)
        except Exception as error:
            entry.fail(error, self.console)
            return
        self.logs[entry.log] = self.ray.put(log)
        self._submit(entry, resuming=entry.ready.folder.resuming)

    def _submit(self, entry: Entry, *, resuming: bool) -> None:
        task, folder, files = entry.ready, entry.ready.folder, {}
        if resuming and folder.run_path.exists() and not folder.outdated_path.exists():
            files = {path.name: path.read_bytes() for path in (folder.run_path, folder.config_path) if path.exists()}
        cpus, gpus = task.settings.threads or 1, int(task.settings.device != "cpu")
        # No retries by Ray: they would not resume from the last checkpoint.
        remote = self.ray.remote(work).options(num_cpus=cpus, num_gpus=gpus, max_retries=0)
        task = replace(task, settings=msgspec.structs.replace(task.settings, threads=cpus))
        self.running[remote.remote(task, self.logs[entry.log], files, self.mailbox)] = entry

    def _handle_messages(self) -> None:
        """Wait `WAIT_S` for workers, store their messages, and handle the tasks that have ended."""
        from bayesmap.run.ray_executor import failed, outcome

        ended, _ = self.ray.wait(list(self.running), timeout=WAIT_S) if self.running else ([], None)
        for log, message in self.ray.get(self.mailbox.take.remote()):
            try:
                self.keep(self.entries[log], message)
            except OSError as error:
                self.entries[log].fail(error, self.console)
        for task in ended:
            entry = self.running.pop(task)
            try:
                outcome(self.ray, task)
            except self.ray.exceptions.RayError as error:  # the worker died
                entry.deaths += 1
                if entry.deaths > RETRIES:
                    entry.fail(failed(error), self.console)
                elif not self.stopping:
                    self.console.say(f"{entry.log}: its worker died; another goes on from the last checkpoint")
                    folder = entry.ready.folder
                    self._submit(entry, resuming=folder.begun or folder.resuming)
            except Exception as error:
                entry.fail(error, self.console)

    def keep(self, entry: Entry, message: Message) -> None:
        """Store a worker's progress, and write the files of its message into the log's folder."""
        entry.event = message.event or entry.event
        if not message.files:
            return
        folder, files = entry.ready.folder, dict(message.files)
        folder.begin(files.pop(folder.config_path.name).decode())
        if folder.run_path.name in files and folder.outdated_path.exists():
            folder.start_afresh()
        files.pop("summary.json", None)
        for name, content in files.items():
            write_file(folder.path / name, content)
        if message.document is not None:
            outputs = {name: str(folder.path / name) for name in message.document["outputs"]}
            entry.document = {**message.document, "outputs": outputs}
            folder.write_document(entry.document)
            self.logs.pop(entry.log, None)
            self.console.say(f"{entry.log}: finished")
            report(self.console, entry.document)

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

    def _progress(self, done: int, total: int) -> tuple[float, str]:
        """Return the share of the work that is done, and the progress of the logs in words."""
        words, logs_done = [f"{done} of {total} logs"], float(done)
        for entry in self.running.values():
            if (event := entry.event) is not None:
                words.append(f"{entry.path.name} {STAGES[event.stage][0]} {event.done:,}/{event.total:,}")
                logs_done += event.done / event.total if event.stage in SAMPLING and event.total else 0.0
        more = f", {len(words) - 1 - NAMED_LOGS} more" if len(words) > NAMED_LOGS + 1 else ""
        return logs_done / max(total, 1), ", ".join(words[: NAMED_LOGS + 1]) + more


@command("infer")
@click.argument("logs", metavar="LOG...", nargs=-1, required=True)
@click.option(
    "-o", "--output", metavar="DIR",
    help="Folder of the run; for several logs, the parent of their folders. [default: runs/NAME-OF-LOG]",
)  # fmt: skip
@click.option("--resume", is_flag=True, help="Resume the run in DIR, bit for bit as if it had never stopped.")
@click.option("--force", is_flag=True, help="Replace the run in DIR.")
def infer(call: Call[InferSettings], logs: tuple[str, ...], output: str | None, resume: bool, force: bool) -> None:
    r"""Infer the walls from LOG: a CARMEN log, a ROS 1 or ROS 2 bag, MCAP, g2o, CSV or .npz of range scans.

    By default a cell has a reflectivity (the chance that it stops a beam) and the position of a surface. The sensor is
    fitted to the log. With --cells binary a cell is a wall or free, and the sensor is fitted only with --sensor fit.

    The command writes into DIR the saved run (run.nc), a picture (posterior.png), the map for nav2 (map.yaml), the JSON
    document (summary.json) and the settings (config.toml). The run is saved at the end of warm-up, every 30 seconds,
    and on Ctrl-C. --resume continues it with its original settings.

    Several logs, a folder of logs or a quoted pattern are each inferred into their own folder, under -o or runs/. If a
    log fails, the table names it, and the exit code is 1. With --executor ray chains run on a Ray cluster; each of
    several logs is one task.

    \b
    bayesmap infer office.log.gz -o runs/office
    bayesmap infer office.log.gz --resolution 0.05 --max-range 20 --holdout 10 --json
    bayesmap infer recording.mcap --scan-topic /scan --pose-topic /odom
    bayesmap infer 'logs/*.log.gz' -o runs --executor ray

    {sensors}
    """
    if resume and force:
        raise click.UsageError("--resume goes on with a run and --force replaces it: give one of them")
    # Several logs form a fleet.
    all_logs, several = logs_of(logs)
    if several:
        infer_fleet(call, all_logs, Path(output or "runs"), resume=resume, force=force)
        return
    # Check the arguments.
    log = logs[0]
    folder = Path(output) if output else Path("runs") / pipeline.stem(log)
    task = pipeline.prepare(call, log, folder, resume=resume, force=force)
    executor = executor_of(task.settings.executor)
    if executor is not None:
        reserve_stdout()
    # Infer the log.
    resume_command = shlex.join(["bayesmap", "infer", log, "-o", str(folder), "--resume"])
    try:
        document = pipeline.infer_log(task, executor=executor, resume_command=resume_command)
    except KeyboardInterrupt:  # during set-up, or a second Ctrl-C while the chains stop
        if (task.folder.begun or resume) and task.folder.run_path.exists():
            call.console.say(f"the last checkpoint is kept; go on with:\n  {resume_command}")
        raise
    # Print the result.
    pipeline.print_result(call, document, strict=task.settings.strict)


infer.help = (infer.help or "").format(sensors=SENSOR_HELP)
