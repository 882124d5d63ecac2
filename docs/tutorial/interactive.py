"""Makes interactive.html: the tutorial's map with draws of its posterior, as a page in one file.

Run `python docs/tutorial/interactive.py` from the repository's root. It does what a reader does who starts
`bayesmap app`, presses *Run* and then *Export, Page in one file*.
"""

from pathlib import Path

from bayesmap.app.edits import tutorial_document
from bayesmap.app.engine import Engine
from bayesmap.app.protocol.actions import Export
from bayesmap.app.protocol.notices import Download
from bayesmap.app.protocol.tasks import Ask, Infer, Report

PAGE = Path(__file__).with_name("interactive.html")


def interactive_page() -> bytes:
    """The page: Gibbs sampling on the tutorial's map, 1000 sweeps of two chains, every other draw kept."""
    reports: list[Report] = []
    engine = Engine(reports.append)
    engine.take(Infer(1, tutorial_document(), "run"))
    while engine.busy:
        engine.advance()
    engine.take(Ask(1, Export("html")))
    (download,) = (report for report in reports if isinstance(report.message, Download))
    return bytes(download.buffers["data"])


if __name__ == "__main__":
    PAGE.write_bytes(interactive_page())
