"""Several logs, each inferred into a folder of its own: one after the other, or on a Ray cluster."""

from __future__ import annotations

import functools
import shlex
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import click

from bayesmap.cli import cells, inferring, sensors
from bayesmap.cli.command import FAILURE, INTERRUPTED, PROBLEMS, Call
from bayesmap.cli.console import reserve_stdout
from bayesmap.cli.executors import ray_address
from bayesmap.cli.fleet_entry import Entry
from bayesmap.cli.folder import Folder
from bayesmap.cli.input_files import LOG, need_file
from bayesmap.cli.ray_fleet import RayFleet
from bayesmap.cli.settings import as_toml
from bayesmap.errors import BadInput


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
    from bayesmap.files import write_whole

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
        began = (inferring.settings_of(entry.folder) or inferring.settings_in(kept)) if resume else None
        entry.values = cells.with_defaults(call.values(began))
        named = entry.values["sensor"]
        entry.sensor = "fit" if named == "fit" else sensors.sensor_of(named)
        entry.folder.check(force=force)
        return True

    kept = output / inferring.FLEET_SETTINGS
    values = call.values(inferring.settings_in(kept) if resume else None)
    on_ray, address = ray_address(values["executor"])
    ready = [entry for entry in entries if attempt(entry, functools.partial(check, entry))]
    if ready:  # before the first begins: the others may have to be begun by the process that resumes
        output.mkdir(parents=True, exist_ok=True)
        toml = as_toml({"infer": values})
        with write_whole(kept) as partial:
            partial.write_text(toml, encoding="utf-8")
        for entry in ready:
            entry.folder.wait(toml)
    interrupted = False
    try:
        if on_ray:
            reserve_stdout()
            RayFleet(call, address, attempt).run(ready)
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
            folder.save(run)
        return False
    entry.document = inferring.finish(folder, run, reading, heldout, values["holdout"])
    inferring.report(call.console, entry.document)
    return True
