"""An engine whose reports are kept, and a session whose pages and worker exist on paper only."""

import json
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from msgspec import structs

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.engine import Engine
from bayesmap.app.exports import make_file
from bayesmap.app.protocol.actions import Cancel, ShowScan
from bayesmap.app.protocol.document import Document, Sensor, pack_walls
from bayesmap.app.protocol.notices import DrawCount, Field, Notice, Quantity, View
from bayesmap.app.protocol.tasks import Ask, Infer, Ready, Report, Show
from bayesmap.app.protocol.wire import check_action, encode_frame
from bayesmap.app.session import Session, ToPage
from bayesmap.app.shown.chains import RunningChains
from bayesmap.app.sources import open_run
from bayesmap.space.grid import Grid

PAGE = 7  # that asks


TINY = Document(
    Grid((3, 3), 1.0, (-0.5, -0.5)),
    pack_walls(np.array([[0, 0, 1], [0, 0, 0], [1, 0, 1]], dtype=bool)),
    (Sensor(1, 0.1, 1.2, 0.3),),
    prior=0.3, noise=0.6, angles=12, max_range=6.0, sweeps=20_000, seed=1,
)  # fmt: skip
"""A world whose maps can be enumerated."""


def header_of(message):
    """Return a message as JSON values; a signal's fields as they are."""
    if isinstance(message, Notice):
        return json.loads(encode_frame(message, {}))
    fields = {name: getattr(message, name) for name in message.__struct_fields__}
    return {"type": type(message).__name__.lower(), **fields}


@dataclass(frozen=True)
class Said:
    report: Report

    @cached_property
    def header(self):
        return header_of(self.report.message)

    @property
    def buffers(self):
        return self.report.buffers


class Heard:
    def __init__(self, opened=None):
        self.reports = []
        self.engine = Engine(lambda report: self.reports.append(Said(report)), opened)
        self.generation = 0

    def infer(self, document, mode="live", *, steps=None, **options):
        """Do a job to its end, or some pieces of it; returns the last field's header and buffers."""
        self.generation += 1
        self.engine.take(Infer(self.generation, document, mode, **options))
        while self.engine.busy and (steps is None or steps > 0):
            self.engine.advance()
            steps = None if steps is None else steps - 1
        return self.last("field") if steps is None else None

    def infer_until(self, document, holds, mode="live"):
        """Do a job until something holds; how many pieces come before depends on the machine."""
        self.infer(document, mode, steps=0)
        while not holds():
            assert self.engine.busy, "the job ended before"
            self.engine.advance()

    def chains_run(self):
        return self.engine._result is not None and isinstance(self.engine._result.estimate, RunningChains)

    def finish(self):
        while self.engine.busy:
            self.engine.advance()

    def ask(self, question):
        """Return the answers to a page's question, or to its wish to see another field or scan, or to stop."""
        before = len(self.reports)
        asked = Show(PAGE, question) if isinstance(question, View) else Ask(PAGE, question)
        self.engine.take(question if isinstance(question, Cancel | ShowScan) else asked)
        return self.reports[before:]

    def answer(self, question):
        """Return header and buffers of the one answer, which is for the page that asked."""
        (said,) = self.ask(question)
        assert said.report.client == PAGE
        return said.header, said.buffers

    def saved_run(self, folder):
        (folder / "run.nc").write_bytes(make_file(self.engine._result, "run")[1])
        return bm.load(folder / "run.nc")

    def every(self, kind):
        """Return headers and buffers of all reports of a kind."""
        return [(report.header, report.buffers) for report in self.reports if report.header["type"] == kind]

    def last(self, kind):
        return self.every(kind)[-1]

    def all(self, kind):
        return [header for header, _ in self.every(kind)]


def shown(run, **options):
    heard = Heard(open_run(run, "run.nc"))
    heard.infer(heard.engine._opened.document, **options)
    return heard


PICTURE = Field(
    generation=0, layer="mean", method="gibbs", approximate=False, sweeps=1, total=1, ess=None, rhat=None,
    log_joint=None, verdict=None, draws=DrawCount(), milliseconds=0.0,
    quantity=Quantity("binary", "P(wall)", "wall", False),
)  # fmt: skip


class Acted:
    """A session; what its pages were sent, and what its worker was asked."""

    def __init__(self, document=None):
        self.session = Session(tutorial_document() if document is None else document)
        self.sent, self.tasks, self.seq = [], [], 0
        self.session.join(1)
        self.hear(Ready())

    def act(self, kind, client=1, **fields):
        """Send a page's message; returns what that page is sent in answer."""
        self.seq += 1
        return self.do(self.session.receive(client, check_action({"type": kind, "seq": self.seq, **fields})), client)

    def hear(self, message, generation=None):
        """Send a worker's report about a generation, by default the present one."""
        buffers = {"p": np.zeros((21, 21), np.uint8)} if isinstance(message, Field) else {}
        if not isinstance(message, Ready):
            generation = self.session.generation if generation is None else generation
            message = structs.replace(message, generation=generation)
        return self.do(self.session.receive_report(Report(message, buffers)))

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
        return self.hear(PICTURE)

    def painted(self, client=1, generation=None):
        """Say that a page has painted the first picture of a generation, by default of the present one."""
        generation = self.session.generation if generation is None else generation
        return self.do(self.session.receive(client, check_action({"type": "painted", "generation": generation})))

    @property
    def inferred(self):
        return [task for task in self.tasks if isinstance(task, Infer)]

    @property
    def asked(self):
        """Pages that asked, and what they asked the worker, without its number."""
        asked = [task for task in self.tasks if isinstance(task, Ask)]
        return [(task.client, structs.replace(task.request, seq=0)) for task in asked]

    @property
    def state(self):
        return [header for header in self.sent if header["type"] == "state"][-1]

    @property
    def text(self):
        return [header for header in self.sent if header["type"] == "status"][-1]["text"]
