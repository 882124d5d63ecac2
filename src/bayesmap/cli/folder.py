"""The folder that a run leaves behind: the saved run, and what is made from it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bayesmap.cli.talk import Talk, as_json
from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.run import Run

DERIVED = ("posterior.png", "map.yaml", "map.pgm", "summary.json")
"""Made from the run: outdated as soon as another run takes its place."""


@dataclass
class Folder:
    """Where `infer` writes.

    Attributes:
        path: the folder.
        talk: for details and warnings.
        saved: whether this call has saved its run here.
    """

    path: Path
    talk: Talk
    saved: bool = field(default=False)

    @property
    def run(self) -> Path:
        """The saved run, and the checkpoint while it goes."""
        return self.path / "run.nc"

    @property
    def config(self) -> Path:
        """The settings that the run was started with."""
        return self.path / "config.toml"

    def open(self, *, force: bool, resume: bool) -> None:
        """Make the folder; refuse to touch a run that nobody said to replace.

        Raises:
            BadInput: there is a run already, or something that is no folder.
        """
        if self.run.exists() and not (force or resume):
            raise BadInput(
                f"{self.run}: there is a run already; --resume goes on with it, --force replaces it, "
                "-o takes another folder"
            )
        try:
            self.path.mkdir(parents=True, exist_ok=True)
        except (FileExistsError, NotADirectoryError):
            raise BadInput(f"{self.path}: not a folder; choose another with -o") from None

    def write_config(self, toml: str) -> None:
        """Keep the settings, so that the run can be resumed without saying them again."""
        from bayesmap.io.atomic import write_whole

        with write_whole(self.config) as partial:
            partial.write_text(toml, encoding="utf-8")

    def save(self, run: Run) -> None:
        """Save the run, whole or not at all. What was made from another run goes."""
        run.save(self.run)
        if not self.saved:
            for name in DERIVED:
                (self.path / name).unlink(missing_ok=True)
        self.saved = True

    def checkpoint(self, run: Run) -> None:
        """Save the run so far; a full disk is no reason to lose the hours to come."""
        try:
            self.save(run)
            self.talk.detail(f"checkpoint after {run.posterior.sweep:,} sweeps: {self.run}")
        except OSError as error:
            self.talk.warn(f"{self.run}: checkpoint could not be written: {error.strerror or error}")

    def write_products(self, run: Run) -> list[Path]:
        """Draw and export the run: the posterior's picture, and the map for nav2."""
        from bayesmap.viz.figure import write_figure

        picture = self.path / "posterior.png"
        write_figure(run.plot(), picture)
        return [self.run, picture, *run.export(self.path / "map.yaml")]

    def write_document(self, document: dict[str, Any]) -> None:
        """Keep the JSON document."""
        from bayesmap.io.atomic import write_whole

        with write_whole(self.path / "summary.json") as partial:
            partial.write_text(as_json(document), encoding="utf-8")
