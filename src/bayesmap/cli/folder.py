"""The folder of a run: the saved run, and the files made from it, such as its JSON document.

An interrupted run must leave a folder from which it can go on, and a new run must not destroy an older one too early.
`Folder` keeps both promises: `check` before the work, `begin` when the run has started, `checkpoint` during the work,
and `write_products` at the end. `run_document` makes the JSON document.
"""

import contextlib
import math
import os
import resource
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bayesmap.cli.console import Console, as_json, counted, progress_bar, stage_bar
from bayesmap.errors import BadInput
from bayesmap.files import write_file
from bayesmap.version import __version__

if TYPE_CHECKING:
    from bayesmap.result import Run
    from bayesmap.space.grid import Grid


PREVIEW_PIXELS = 800  # longer side of the picture of a first map
SETTINGS = ("method", "order", "prior", "sensor", "hit_depth", "start", "seed", "chains", "warmup", "thin")
"""Settings of a run that its document repeats."""

DERIVED = (
    "posterior.png", "map.yaml", "map.pgm", "summary.json", "trajectory.tum", "trajectory-covariances.txt",
    "trajectory.png", "odometry.png", "loops.png", "surfaces.png",
)  # fmt: skip
"""Files made from the run. They are removed when another run takes its place."""


@dataclass
class Folder:
    """The folder into which `infer` and `slam` write.

    Until `begin`, only the file ``outdated`` is written. It marks an older run, which the first `save` replaces.
    """

    path: Path  # the folder
    console: Console  # prints details and warnings
    resuming: bool = False  # whether to resume the run in the folder; False if that run is outdated
    begun: bool = field(default=False, init=False)  # whether `begin` has been called
    _toml: str = field(default="", init=False)
    first_map: list[Path] = field(default_factory=list, init=False)  # the files of `preview`

    def __post_init__(self) -> None:
        self.run_path = self.path / "run.nc"  # the saved run, which is also its checkpoint
        self.config_path = self.path / "config.toml"  # the settings that the run was started with
        self.outdated_path = self.path / "outdated"  # marks a run as to be replaced; holds the settings of the new run
        self.resuming = self.resuming and not self.outdated_path.exists()

    def check(self, *, force: bool) -> None:
        """Raise `BadInput` for a folder that cannot be written, or whose run is neither replaced nor resumed."""
        try:
            str(self.path).encode()
        except UnicodeEncodeError:
            raise BadInput(f"{str(self.path)!a}: the name is not UTF-8; choose another folder with -o") from None
        may_replace = force or self.resuming or self.outdated_path.exists()
        if self.run_path.exists() and not may_replace:
            remedy = "--resume goes on with it, --force replaces it, -o takes another folder"
            raise BadInput(f"{self.run_path}: there is a run already; {remedy}")
        older_files = [self.path / name for name in DERIVED if (self.path / name).exists()]
        if older_files and not (self.run_path.exists() or may_replace):
            resume = "--resume goes on with the run that wrote it, " if self.config_path.exists() else ""
            raise BadInput(f"{older_files[0]}: exists already; {resume}--force replaces it, -o takes another folder")
        # Refuse an unwritable folder before a long run, not after it.
        nearest = next(path for path in (self.path, *self.path.parents) if path.exists())
        if not nearest.is_dir():
            raise BadInput(f"{nearest}: not a folder; choose another with -o")
        if not os.access(nearest, os.W_OK):
            raise BadInput(f"{nearest}: no permission to write there; choose another folder with -o")

    def mark_outdated(self, toml: str) -> None:
        """Mark an older run in the folder as to be replaced, perhaps by another process."""
        if self.run_path.exists() and not self.resuming:
            write_file(self.outdated_path, toml)

    def begin(self, toml: str) -> None:
        """Save the settings of a run that has started, to resume it. Raises `BadInput` if that is impossible."""
        if self.begun:
            return
        self._toml = toml
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            self.mark_outdated(toml)
            if self.resuming or not self.run_path.exists():
                self.start_afresh()
        except OSError as error:
            reason = f"cannot be written: {error.strerror or error}; choose another folder with -o"
            raise BadInput(f"{error.filename or self.path}: {reason}") from None
        self.begun = True

    def start_afresh(self) -> None:
        """Save the settings of the new run, and remove the files made from the older run that it replaces."""
        write_file(self.config_path, self._toml)
        if not self.first_map:  # its files belong to the new run
            for name in DERIVED:
                (self.path / name).unlink(missing_ok=True)
        self.outdated_path.unlink(missing_ok=True)

    def save(self, run: "Run", on_progress: Callable[[int, int], None] = lambda done, total: None) -> None:
        """Save the run. If it replaces an older run, remove the files made from that one."""
        try:
            run.save(self.run_path, on_progress)
        except OSError as error:
            if not self.run_path.exists():
                raise
            is_older = self.outdated_path.exists()
            content = "the run to be replaced" if is_older else "what was saved before, and --resume goes on"
            reason = f"{error.strerror or error}; {self.run_path.name} still holds {content}"
            raise OSError(error.errno, reason, error.filename) from error
        if self.outdated_path.exists():
            self.start_afresh()

    def preview(self, run: "Run") -> None:
        """Write a picture of a first map without axes, and export it. An older run in the folder keeps its picture."""
        from bayesmap.viz.thumbnail import thumbnail

        if not self.run_path.exists():
            self.path.mkdir(parents=True, exist_ok=True)
            _, png = thumbnail(run.occupancy, run.observed, PREVIEW_PIXELS)
            try:
                self.first_map = [write_file(self.path / "posterior.png", png), *run.export(self.path / "map.yaml")]
                self.console.say(f"a first, rough map: {self.first_map[0]}")
            except OSError as error:
                self.console.warn(f"{self.path}: a first map could not be written: {error.strerror or error}")

    def render(self, run: "Run") -> list[Path]:
        """Render the map of a run (a single draw without uncertainty), and export it for nav2. Returns the paths."""
        from bayesmap.viz.figure import panel_figure, write_figure

        picture, words = self.path / "posterior.png", run.posterior.prior.words
        single = run.n_draws == 1 and not run.finished
        figure = panel_figure(run.grid, "mean", run.occupancy, run.observed, label=words.mean) if single else run.plot()
        write_figure(figure, picture)
        return [picture, *run.export(self.path / "map.yaml")]

    def checkpoint(self, run: "Run", on_progress: Callable[[int, int], None] = lambda done, total: None) -> None:
        """Save the run so far. If this fails, as on a full disk, warn and let the run continue."""
        try:
            self.save(run, on_progress)
            if run.n_draws > 0:
                self.render(run)
            self.console.detail(f"checkpoint after {counted(run.posterior.sweep, 'sweep')}: {self.run_path}")
        except OSError as error:
            self.console.warn(f"{self.run_path}: checkpoint could not be written: {error.strerror or error}")

    def write_products(self, run: "Run") -> list[Path]:
        """Save the run; if it has draws, also render it and export it for nav2. Returns the paths of the files."""
        with stage_bar(self.console, "save") as report:
            self.save(run, report)
        paths = [self.run_path]
        if run.n_draws == 0 and not run.finished:
            return paths
        with progress_bar(self.console, "rendering the map"):
            paths += self.render(run)
            if run.posterior.prior.has_surfaces and run.n_draws > 0:
                from bayesmap.viz.figure import write_figure
                from bayesmap.viz.overlays import surfaces_figure

                paths.append(self.path / "surfaces.png")
                write_figure(surfaces_figure(run.grid, *run.surfaces(), run.observed), paths[-1])
        return paths

    def write_document(self, document: dict[str, Any]) -> None:
        """Write the JSON document of the run."""
        write_file(self.path / "summary.json", as_json(document))


def run_document(run: "Run") -> dict[str, Any]:
    """Return the JSON document of a run: its settings, result, timings, diagnostics and problems."""
    posterior = run.posterior
    joint = run.log_joint
    summary = run.summary()
    diagnostics = summary.as_json()
    last, mean = (finite(joint[:, -1].mean()), finite(joint.mean())) if joint.size else (None, None)
    return {
        "version": __version__, "grid": grid_document(run.grid),
        **{name: posterior.counts[name] for name in ("scans", "beams", "incidences")},
        "cells": posterior.kind, "states": posterior.prior.words.states, "fitted": posterior.settings.get("fitted"),
        **{name: posterior.settings[name] for name in SETTINGS},
        "draws": int(joint.shape[1]), "sweeps": posterior.sweep, "finished": run.finished,
        "seconds": {name: round(value, 6) for name, value in posterior.seconds.items()},
        "log_joint": {"last": last, "mean": mean}, "log_evidence": finite(posterior.log_evidence),
        **{name: diagnostics[name] for name in ("microseconds_per_sweep", "rhat_max", "ess_min")},
        "unchanged_cells": diagnostics["unchanged_cells"] or 0, "diagnostics": diagnostics,
        "good": summary.strengths(), "problems": summary.problems(), "peak_memory_mb": peak_memory_mb(),
    }  # fmt: skip


def grid_document(grid: "Grid") -> dict[str, Any]:
    """Return the numbers of a grid as JSON values."""
    return {"shape": list(grid.shape), "resolution": grid.resolution, "origin": list(grid.origin)}


def work_done(document: dict[str, Any]) -> str:
    """Return the work of a run in words: "4 chains of 100 sweeps", or "4,000 independent maps" without chains."""
    from bayesmap.posterior.posterior import WITHOUT_CHAINS

    if document["method"] not in WITHOUT_CHAINS:
        return f"{counted(document['chains'], 'chain')} of {counted(document['sweeps'], 'sweep')}"
    return counted(document["chains"] * document["draws"], "independent map")


def finite(value: Any) -> float | None:
    """Return a JSON number, or None for NaN and infinity."""
    return None if value is None or not math.isfinite(value) else float(value)


def peak_memory_mb() -> float:
    """Return the peak memory of this process, in megabytes."""
    with contextlib.suppress(OSError):  # Linux, where getrusage inherits the peak of the parent process
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return round(int(line.split()[1]) * 1024 / 1e6, 1)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # bytes on macOS, kibibytes elsewhere
    return round(peak / (1e6 if sys.platform == "darwin" else 1e6 / 1024), 1)
