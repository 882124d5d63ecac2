"""An engine whose reports are kept."""

from bayesmap.app.engine import Engine
from bayesmap.app.tasks import Infer


class Heard:
    """An engine and what it said."""

    def __init__(self, opened=None):
        self.reports = []
        self.engine = Engine(self.reports.append, opened)
        self.generation = 0

    def infer(self, document, mode="live", *, steps=None, **options):
        """Do a job to its end, or some pieces of it; returns the last field's header and buffers."""
        self.generation += 1
        self.engine.take(Infer(self.generation, document, mode, **options))
        while self.engine.busy and (steps is None or steps > 0):
            self.engine.advance()
            steps = None if steps is None else steps - 1
        return self.last("field") if steps is None else None

    def infer_until_chains_run(self, document):
        """Do a job until its chains have made a step; how many pieces come before depends on the machine."""
        self.infer(document, steps=0)
        while self.engine._result is None or self.engine._result.stream is None:
            assert self.engine.busy, "the job ended without chains"
            self.engine.advance()

    def ask(self, task):
        """Its answers to a question."""
        before = len(self.reports)
        self.engine.take(task)
        return self.reports[before:]

    def last(self, kind):
        """Header and buffers of the last report of a kind."""
        found = [report for report in self.reports if report.header["type"] == kind][-1]
        return found.header, found.buffers

    def every(self, kind):
        """Headers and buffers of all reports of a kind."""
        return [(report.header, report.buffers) for report in self.reports if report.header["type"] == kind]

    def all(self, kind):
        """All headers of a kind."""
        return [report.header for report in self.reports if report.header["type"] == kind]
