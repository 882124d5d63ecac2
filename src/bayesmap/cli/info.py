"""``bayesmap info`` and ``bayesmap config``: print the contents of a file, and the effective settings."""

import math
from dataclasses import fields
from typing import Any

import click
import msgspec

from bayesmap.cli.command import Call, as_toml, command, merge_layers
from bayesmap.cli.console import BAD_INPUT, counted, write_lines, write_out
from bayesmap.cli.folder import grid_document, run_document, work_done
from bayesmap.cli.keys import SECTIONS, Settings
from bayesmap.cli.pipeline import cost_of_suggestion
from bayesmap.cli.translation import LOG, is_map, need_file
from bayesmap.files import is_saved_run


@command(None)
@click.argument("file")
def info(call: Call[Settings], file: str) -> None:
    r"""Describe FILE: a log, a robot's recording (a file or a folder), a saved run, or a map (map_server YAML).

    For a recording the command lists topics and frames, describes the scans, names the topics that can give poses, and
    prints the command that infers a map. It counts damaged and malformed messages, and describes the others. If there
    are any, it exits with 3.

    \b
    bayesmap info recording.mcap
    bayesmap info runs/office/run.nc --json
    """
    need_file(file, f"a saved run (.nc), a map (.yaml), or {LOG}", runs=True)
    describe = _describe_run if is_saved_run(file) else _describe_map if is_map(file) else _describe_log
    document = describe(file)
    if call.console.as_json:
        call.console.result(document, [])
    else:
        write_lines(_lines(document))
    n_skipped = sum(sensor.get("skipped") or 0 for sensor in document["sensors"])
    missing = [f"malformed messages or lines ({n_skipped:,})"] if n_skipped else []
    missing += ["what stood behind the damage"] if any("cut short" in note for note in document["notes"]) else []
    if missing:
        n_scans = sum(sensor["scans"] for sensor in document["sensors"] if not sensor.get("error"))
        part, remedy = counted(n_scans, "scan"), "infer and slam take the same scans with --skip-bad-lines"
        call.console.warn(f"{file}: read in part: {part}, without {' and '.join(missing)}; {remedy}")
        click.get_current_context().exit(BAD_INPUT)


def _describe_run(file: str) -> dict[str, Any]:
    """Describe a saved run, ready for JSON."""
    from bayesmap.io.contents import scans_summary
    from bayesmap.result import load

    run = load(file)
    return {
        "path": file, "format": "bayesmap run",
        "run": {key: value for key, value in run_document(run).items() if key not in ("version", "peak_memory_mb")},
        "sensors": [scans_summary(run.posterior.scans)], "notes": list(run.posterior.notes),
    }  # fmt: skip


def _describe_map(file: str) -> dict[str, Any]:
    """Describe a map in a file, ready for JSON."""
    import numpy as np

    from bayesmap.io.ros.maps import read_map

    occupancy, grid = read_map(file)
    masks = {"occupied": occupancy > 0.5, "free": occupancy <= 0.5, "unknown": np.isnan(occupancy)}
    return {
        "path": file, "format": "map of map_server or nav2, no log", "grid": grid_document(grid), "sensors": [],
        "states": ", ".join(f"{int(mask.sum()):,} {state}" for state, mask in masks.items()),
        "notes": ["bayesmap localize and score take it in place of a saved run, and infer takes its cells by --grid"],
    }  # fmt: skip


def _describe_log(file: str) -> dict[str, Any]:
    """Describe a log, ready for JSON."""
    from bayesmap.io.contents import contents_of

    contents = contents_of(file)
    start, end = contents.start_s, contents.end_s
    duration = None if start is None or end is None else round(end - start, 3)
    document = {field.name: getattr(contents, field.name) for field in fields(contents) if field.name != "scans"}
    estimate = cost_of_suggestion(contents.suggestion, contents.scans)
    if estimate is not None and not estimate["fits"] and estimate["remedy"]:
        document["suggestion"] += f" {estimate['remedy']}"
    return {**document, "duration_s": duration, "notes": list(contents.notes), "estimate": estimate}


def _lines(document: dict[str, Any]) -> list[str]:
    """Return the description of a file as lines for the terminal."""
    lines = [f"{document['path']}: {document['format']}"]
    if document.get("duration_s") is not None:
        lines[0] += f", {document['duration_s']:,.1f} s"
    if (mapped := document.get("run", document)).get("grid"):
        size = " x ".join(map(str, mapped["grid"]["shape"]))
        lines.append(f"grid: {size} cells of {mapped['grid']['resolution']:g} m, {mapped['states']}")
    if "run" in document:
        lines += _run_lines(document["run"])
    topics = document.get("topics", [])
    if topics:
        width = max(len(topic["name"]) for topic in topics)
        lines.append("messages:")
        for topic in topics:
            rate = f"  {topic['rate_hz']:.1f} Hz" if topic.get("rate_hz") else ""
            kind = f"  {topic['type']}" if "type" in topic else ""
            lines.append(f"  {topic['name']:<{width}}  {topic['count']:>8,}{rate:>10}{kind}".rstrip())
    if document.get("frames"):
        lines.append(f"frames: {', '.join(document['frames'])}")
    if document.get("pose_sources"):
        lines.append("poses: " + ", ".join(f"{each['name']} ({each['type']})" for each in document["pose_sources"]))
    for sensor in document["sensors"]:
        lines += _sensor_lines(sensor)
    lines += [f"note: {note}" for note in document["notes"]]
    if document.get("suggestion"):
        cost = f" ({document['estimate']['words']})" if document["estimate"] else ""
        lines += [f"to infer a map{cost}:", f"  {document['suggestion']}"]
    return lines


def _run_lines(run: dict[str, Any]) -> list[str]:
    """Return the description of a run as lines for the terminal."""
    state = "finished" if run["finished"] else "not finished"
    draws = f", {counted(run['draws'], 'draw')} each" if run["sweeps"] else ""
    lines = [f"method: {run['method']}, {work_done(run)}{draws}, {state}"]
    fitted = run["fitted"] or {}
    if "sensor" in fitted:
        lines.append(f"fitted sensor: {_sensor_words(fitted['sensor'])}")
    if fitted.get("prior", {}).get("kind") == "ising":
        lines.append(f"fitted coupling: {fitted['prior']['coupling']:.3g}")
    return lines


def _sensor_words(sensor: dict[str, Any]) -> str:
    """Return a description of a sensor model in words."""
    from bayesmap.sensors.model import from_description

    model = from_description(sensor)
    noise = None if model is None else model.kernel_parameters()
    assert noise is not None
    tails = f" (Student's t, {noise.dof:g} degrees of freedom)" if noise.dof else ""
    others = f"up to {sensor['p_short']:.2g} end at objects in the way, {sensor['p_no_return']:.2g} have no return"
    shares = f"of all readings {sensor['p_random']:.2g} are random; of the others {others}"
    return f"noise {100 * noise.sigma_m:.2g} cm + {100 * noise.sigma_per_m:.2g} cm per metre{tails}; {shares}"


def _sensor_lines(sensor: dict[str, Any]) -> list[str]:
    """Return the scans of one sensor as lines of text: beams, ranges, poses, and what was left out."""
    name = sensor.get("topic") or sensor.get("message") or "readings"
    if sensor.get("error"):
        return [f"scans on {name}: {sensor['scans']:,}, which cannot be used: {sensor['error']}"]
    title = f"scans on {name}" if sensor.get("topic") else f"scans ({name})"
    beams = f"{sensor['beams']} beams from {sensor['angle_first_deg']:g} to {sensor['angle_last_deg']:g} degrees"
    if sensor["angle_step_deg"] is not None:
        beams += f", {sensor['angle_step_deg']:g} apart"
    kinds = ", ".join(f"{count:,} {kind.replace('_', ' ')}" for kind, count in sensor["readings"].items() if count)
    lines = [
        f"{title}: {sensor['scans']:,}, each of {beams}",
        f"  ranges from {sensor['min_range_m']:g} to {sensor['max_range_m']:g} m; readings: {kinds}",
    ]
    if sensor.get("no_poses"):
        lines.append(f"  no poses: {sensor['no_poses']}")
    else:
        (x0, y0), (x1, y1) = sensor["poses_from_m"], sensor["poses_to_m"]
        source = f" by {sensor['poses']}" if sensor.get("poses") else ""
        frames = f", {sensor['frame']} in {sensor['fixed_frame']}" if sensor.get("frame") else ""
        extent = f"x {x0:g} to {x1:g} m, y {y0:g} to {y1:g} m"
        lines.append(f"  poses{source}{frames}: {extent}, {sensor['travelled_m']:,.1f} m travelled")
    if sensor.get("skipped"):
        lines.append(f"  malformed messages or lines left out: {sensor['skipped']:,}, first {sensor['first_skipped']}")
    return lines + [f"  note: {note}" for note in sensor.get("notes", [])]


@command(None)
def config(call: Call[Settings]) -> None:
    r"""Print the effective settings as TOML, ready for -c.

    The output has one table per command. Keys outside the tables apply to every command that has them.

    \b
    bayesmap config > my.toml
    bayesmap infer -c my.toml --set resolution=0.05 office.log
    """
    settings = {section: merge_layers(section, *call.layers) for section in SECTIONS}
    if call.console.as_json:
        tables = {  # infinity is a text in JSON, which --set can read
            section: {k: "inf" if value == math.inf else value for k, value in msgspec.structs.asdict(values).items()}
            for section, values in settings.items()
        }
        call.console.result({"settings": tables}, [])
    else:
        write_out(as_toml(settings))
