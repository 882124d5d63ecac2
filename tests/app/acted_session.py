"""A session with pages and a worker that exist on paper only."""

import numpy as np

from bayesmap.app.messages import check
from bayesmap.app.session import Session, ToWorker, addressed
from bayesmap.app.tasks import Infer, Report
from bayesmap.app.worlds import tutorial_document


class Acted:
    """A session; what its pages were sent, and what its worker was asked."""

    def __init__(self, document=None):
        self.session = Session(tutorial_document() if document is None else document)
        self.sent, self.tasks, self.seq = [], [], 0
        self.hear("ready", generation=None)

    def act(self, kind, client=1, **fields):
        """A page's message; its answer's messages for that page."""
        self.seq += 1
        return self.do(self.session.receive(client, check({"type": kind, "seq": self.seq, **fields})), client)

    def hear(self, kind, generation, **fields):
        """A worker's report."""
        numbered = {} if generation is None else {"generation": generation}
        buffers = {"p": np.zeros((21, 21), np.uint8)} if kind == "field" else {}
        return self.do(self.session.hear(Report({"type": kind, **numbered, **fields}, buffers)))

    def do(self, effects, client=1):
        new = []
        for effect in effects:
            if isinstance(effect, ToWorker):
                self.tasks.append(effect.task)
            elif effect.client in (None, client):
                new.append(addressed(effect.header, client))
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
    def state(self):
        """The last state that was sent."""
        return [header for header in self.sent if header["type"] == "state"][-1]

    @property
    def text(self):
        """The last status that was sent."""
        return [header for header in self.sent if header["type"] == "status"][-1]["text"]
