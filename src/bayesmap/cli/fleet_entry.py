"""One log of a fleet: what is asked of it, and what has become of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from bayesmap.cli.folder import Folder

if TYPE_CHECKING:
    from bayesmap.sensors.model import SensorModel


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
