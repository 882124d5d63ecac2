"""An engine whose reports are kept."""

import json
from dataclasses import dataclass
from functools import cached_property

import numpy as np

import bayesmap as bm
from bayesmap.app.engine import Engine
from bayesmap.app.exports import file_of
from bayesmap.app.protocol.actions import Cancel, ShowScan
from bayesmap.app.protocol.document import Document, Sensor, packed
from bayesmap.app.protocol.notices import Notice, View
from bayesmap.app.protocol.tasks import Ask, Infer, Report, Show
from bayesmap.app.protocol.wire import frame
from bayesmap.app.shown.chains import Stream
from bayesmap.app.sources import opened_run
from bayesmap.space.grid import Grid

PAGE = 7
"""The page that asks."""


TINY = Document(
    Grid((3, 3), 1.0, (-0.5, -0.5)),
    packed(np.array([[0, 0, 1], [0, 0, 0], [1, 0, 1]], dtype=bool)),
    (Sensor(1, 0.1, 1.2, 0.3),),
    prior=0.3, noise=0.6, angles=12, max_range=6.0, sweeps=20_000, seed=1,
)  # fmt: skip
"""A world whose maps can be enumerated."""


def header_of(message):
    """A message as JSON values; of a signal its fields as they are."""
    if isinstance(message, Notice):
        return json.loads(frame(message, {}))
    fields = {name: getattr(message, name) for name in message.__struct_fields__}
    return {"type": type(message).__name__.lower(), **fields}


@dataclass(frozen=True)
class Said:
    """A report, and what a test reads of it."""

    report: Report

    @cached_property
    def header(self):
        return header_of(self.report.message)

    @property
    def buffers(self):
        return self.report.buffers


class Heard:
    """An engine and what it said."""

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
        """Whether the result on show is that of chains."""
        return self.engine._result is not None and isinstance(self.engine._result.found, Stream)

    def finish(self):
        """Do the rest of the job."""
        while self.engine.busy:
            self.engine.advance()

    def ask(self, question):
        """Its answers to a page: to a question, to the wish to see another field or scan, or to stop."""
        before = len(self.reports)
        asked = Show(PAGE, question) if isinstance(question, View) else Ask(PAGE, question)
        self.engine.take(question if isinstance(question, Cancel | ShowScan) else asked)
        return self.reports[before:]

    def answer(self, question):
        """Header and buffers of the one answer, which is for the page that asked."""
        (said,) = self.ask(question)
        assert said.report.client == PAGE
        return said.header, said.buffers

    def saved_run(self, folder):
        """The run that is saved of the result on show."""
        (folder / "run.nc").write_bytes(file_of(self.engine._result, "run")[2])
        return bm.load(folder / "run.nc")

    def every(self, kind):
        """Headers and buffers of all reports of a kind."""
        return [(report.header, report.buffers) for report in self.reports if report.header["type"] == kind]

    def last(self, kind):
        """Header and buffers of the last report of a kind."""
        return self.every(kind)[-1]

    def all(self, kind):
        """All headers of a kind."""
        return [header for header, _ in self.every(kind)]


def shown(run, **options):
    """An engine that shows a run."""
    heard = Heard(opened_run(run, "run.nc"))
    heard.infer(heard.engine._opened.document, **options)
    return heard
