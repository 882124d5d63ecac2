"""A session with pages and a worker that exist on paper only."""

import numpy as np
from acted_engine import header_of
from msgspec import structs

from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.notices import DrawCount, Field, Overlay, Quantity, Scan, Stage
from bayesmap.app.protocol.tasks import Ask, Failed, Finished, Infer, Located, OnGrid, Ready, Report
from bayesmap.app.protocol.wire import check
from bayesmap.app.session import Session, ToPage

WALLS = Quantity("binary", "P(wall)", "wall", False)


def a_field(generation):
    """A picture."""
    return Field(
        generation=generation, layer="mean", method="gibbs", approximate=False, sweeps=1, total=1, ess=None, rhat=None,
        log_joint=None, verdict=None, draws=DrawCount(), quantity=WALLS, milliseconds=0.0,
    )  # fmt: skip


MADE = {
    "ready": lambda generation, document=None: Ready(document),
    "field": a_field,
    "scan": lambda generation: Scan([1], generation=generation),
    "overlay": lambda generation: Overlay(generation=generation),
    "stage": lambda generation, text: Stage("loops", text, 0, 1, generation=generation),
    "finished": lambda generation, draws: Finished(DrawCount(**draws), generation=generation),
    "failed": lambda generation, text: Failed(text, generation=generation),
    "grid": lambda generation, grid: OnGrid(grid, generation=generation),
    "trajectory": lambda generation, found: Located(found, generation=generation),
}
"""Reports of the worker's, by what they are called here."""


class Acted:
    """A session; what its pages were sent, and what its worker was asked."""

    def __init__(self, document=None):
        self.session = Session(tutorial_document() if document is None else document)
        self.sent, self.tasks, self.seq = [], [], 0
        self.session.join(1)
        self.hear("ready", generation=None)

    def act(self, kind, client=1, **fields):
        """A page's message; its answer's messages for that page."""
        self.seq += 1
        return self.do(self.session.receive(client, check({"type": kind, "seq": self.seq, **fields})), client)

    def hear(self, kind, generation, **fields):
        """A worker's report."""
        buffers = {"p": np.zeros((21, 21), np.uint8)} if kind == "field" else {}
        return self.do(self.session.receive_report(Report(MADE[kind](generation, **fields), buffers)))

    def do(self, effects, client=1):
        new = []
        for effect in effects:
            if not isinstance(effect, ToPage):
                self.tasks.append(effect)
            elif effect.client in (None, client):
                new.append(header_of(effect.message))
        self.sent += new
        return new

    def picture(self):
        """The worker answers the present generation's first picture."""
        return self.hear("field", self.session.generation)

    def painted(self, client=1, generation=None):
        """A page has painted the first picture of a generation, by default of the present one."""
        of = self.session.generation if generation is None else generation
        return self.do(self.session.receive(client, check({"type": "painted", "generation": of})))

    @property
    def inferred(self):
        """What the worker was asked to infer, in order."""
        return [task for task in self.tasks if isinstance(task, Infer)]

    @property
    def asked(self):
        """Pages that asked, and what they asked the worker, without its number."""
        asked = [task for task in self.tasks if isinstance(task, Ask)]
        return [(task.client, structs.replace(task.question, seq=0)) for task in asked]

    @property
    def state(self):
        """The last state that was sent."""
        return [header for header in self.sent if header["type"] == "state"][-1]

    @property
    def text(self):
        """The last status that was sent."""
        return [header for header in self.sent if header["type"] == "status"][-1]["text"]
