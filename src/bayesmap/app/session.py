"""The session: applies what pages ask for, decides what the worker does and what pages are sent. No sockets, no clocks.

Edits of a gesture that arrive faster than pictures can be computed and painted are merged (`pacing.py`): so a fast hand
sees every picture that there is time for, never starves, and never falls behind.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from numpy.typing import NDArray

from bayesmap.app.document import LIMITS, SCANS_USED, VERSION, Document, Refused
from bayesmap.app.edits import EDITS, adopted, edit, gesture_of
from bayesmap.app.gestures import From, History, Pace
from bayesmap.app.questions import QUESTIONS, question
from bayesmap.app.tasks import OWN_LAYERS, Cancel, Export, Infer, Mode, Remember, Report, ShowScan, Task, View

Message = Mapping[str, Any]
REPLAYED = ("scan", "field", "overlay")
"""What a page that connects late is sent again."""


@dataclass(frozen=True)
class ToPage:
    """A message to one page, or to all where client is None."""

    header: dict[str, Any]
    buffers: Mapping[str, NDArray[Any] | bytes] = field(default_factory=dict)
    client: int | None = None


@dataclass(frozen=True)
class ToWorker:
    """A task for the worker."""

    task: Task


Effect = ToPage | ToWorker
Effects = list[Effect]


class Session:
    """One document, shown on any number of pages.

    Attributes:
        history: of the document.
        generation: of the present picture; see docs/app.md.
        live: whether edits restart Gibbs.
        running: whether a run is under way.
        working: whether the picture is to change yet: chains go on, or are about to begin.
        draws: {"chains", "count"} of the present result.
    """

    def __init__(self, document: Document) -> None:
        self.history = History(document)
        self.generation = 0
        self.live = True
        self.running = self.working = False
        self.draws = {"chains": 0, "count": 0}
        self._views: dict[int, View] = {}  # of pages that are shown something else than the mean
        self.scan = 0
        self.worker_ready = False
        self._mode: Mode = "live"
        self._pace = Pace()
        self._seqs: dict[int, int] = {}
        self._last: dict[str, ToPage] = {}
        self._trajectory: Remember | None = None  # of a log, inferred; the next worker shall know it

    @property
    def document(self) -> Document:
        """The present document."""
        return self.history.present

    # From pages

    def receive(self, client: int, message: Message) -> Effects:
        """Apply a checked message.

        Returns:
            What to do, in order.
        """
        kind = message["type"]
        if kind in QUESTIONS:
            return self._asked(client, message)
        if kind == "painted":
            self._pace.painted(client, message["generation"])
            return self._apply(self._pace.due())
        return self._apply(self._pace.take(client, message))

    def join(self, client: int) -> Effects:
        """A page has connected; it answers with hello."""
        self._seqs[client] = 0
        self._pace.forget(client)
        mean: Effects = [ToWorker(View("mean", client=client))] if self._views.pop(client, None) is not None else []
        welcome = {"type": "welcome", "version": VERSION, "limits": LIMITS, "base": ""}
        worker = {"type": "worker", "state": "ready" if self.worker_ready else "starting"}
        return [*mean, ToPage(welcome, {}, client), ToPage(worker, {}, client)]

    def leave(self, client: int) -> Effects:
        """A page has gone: the worker need not draw for it any more, and anybody may undo its steps."""
        self._pace.forget(client)
        last = self._apply(self._pace.due())
        self._seqs.pop(client, None)
        view = self._views.pop(client, None)
        mean: Effects = [ToWorker(View("mean", client=client))] if view is not None else []
        return [*last, *mean, self._state()]

    def _apply(self, messages: list[From]) -> Effects:
        return [effect for client, message in messages for effect in self._apply_one(client, message)]

    def _apply_one(self, client: int, message: Message) -> Effects:
        kind = message["type"]
        self._seqs[client] = message["seq"]
        try:
            if kind in EDITS and message.get("what") != "inference":
                return self._edit(client, message)
            effects: Effects = getattr(self, f"_on_{kind}")(client, message)
            return effects
        except Refused as refusal:
            text = f"{refusal.text}; {refusal.remedy}" if refusal.remedy else refusal.text
            return [self._status(text, "warning", client), self._state()]

    def _edit(self, client: int, message: Message) -> Effects:
        before = self.document
        after, remark = edit(before, message)
        self.history = self.history.push(after, gesture_of(message, client), client)
        effects: Effects = [self._status(remark, "warning", client)] if remark else []
        if SCANS_USED in message.get("patch", ()):
            self.scan = (self.document.scans_used or self.document.source.scans) - 1
        coarse = bool(message.get("coarse")) and self.document.source.kind == "log"
        let_go = self._mode == "coarse" and not coarse
        if self.document is before and not let_go:
            return [*effects, self._state()]
        return effects + self._restart("coarse" if coarse else None)

    def _on_hello(self, client: int, message: Message) -> Effects:
        effects: Effects = []
        document = message.get("document")
        if document is not None:
            try:
                document = adopted(self.document, document)
            except Refused as refusal:
                effects.append(self._status(f"{refusal.text}; {refusal.remedy}", "warning", client))
            else:
                self.history = self.history.push(document, author=client)
                if self.document is document:
                    return self._restart()
        effects.append(replace(self._state(), client=client))
        return effects + [replace(self._last[kind], client=client) for kind in REPLAYED if kind in self._last]

    def _on_clear(self, client: int, message: Message) -> Effects:
        return self._restart("clear")

    def _on_undo(self, client: int, message: Message) -> Effects:
        return self._step(client, self.history.undo(), self.history.undoes, "undo")

    def _on_redo(self, client: int, message: Message) -> Effects:
        return self._step(client, self.history.redo(), self.history.redoes, "redo")

    def _may_step(self, client: int, author: object) -> bool:
        """Whether the next step back or forth is this page's, or of one that has gone."""
        return author == client or author not in self._seqs

    def _step(self, client: int, history: History[Document], author: object, name: str) -> Effects:
        if history is self.history:
            return [self._status(f"nothing to {name}", "info", client), self._state()]
        if not self._may_step(client, author):
            return [
                self._status(f"the last step was made in another tab: {name} it there", "info", client),
                self._state(),
            ]
        self.history = history
        return self._restart()

    def _on_run(self, client: int, message: Message) -> Effects:
        if self.document.source.kind == "run":
            raise Refused("a saved run is shown as it is", "begin a new map to run inference")
        return self._restart("run")

    def _on_cancel(self, client: int, message: Message) -> Effects:
        return [ToWorker(Cancel()), self._state()]

    def _on_live(self, client: int, message: Message) -> Effects:
        self.live = message["on"]
        if self.running or self.document.source.kind == "run":
            return [self._state()]
        return self._restart() if self.live else [ToWorker(Cancel()), self._state()]

    def _on_view(self, client: int, message: Message) -> Effects:
        self._views[client] = View(message["layer"], message.get("chain"), message.get("draw"), client)
        return [ToWorker(self._views[client]), self._state()]

    def _on_scan(self, client: int, message: Message) -> Effects:
        scans = self.document.source.scans
        if not 0 <= message["index"] < scans:
            raise Refused(f"there is no scan {message['index']}", f"there are {scans}, from 0" if scans else "")
        self.scan = message["index"]
        return [ToWorker(ShowScan(self.scan)), self._state()]

    def _on_export(self, client: int, message: Message) -> Effects:
        if message["what"] != "document":
            return [ToWorker(Export(client, message["what"])), self._state()]
        import json

        data = (json.dumps(self.document.to_json(), indent=1) + "\n").encode()
        header = {"type": "download", "name": "document.json", "mime": "application/json"}
        return [ToPage(header, {"data": data}, client), self._state()]

    def _asked(self, client: int, message: Message) -> Effects:
        """A question: it changes nothing, and no state confirms it."""
        try:
            return [ToWorker(question(self.document, client, message))]
        except Refused as refusal:
            return [self._status(refusal.text, "warning", client)]

    # From the worker

    def hear(self, report: Report) -> Effects:
        """What a report of the worker's leads to; those of an older generation to nothing."""
        header = report.header
        kind = header["type"]
        if kind == "ready":
            return self._on_ready(header.get("document"))
        if header.get("generation", self.generation) != self.generation:
            return []
        if kind == "finished":
            self.running = self.working = False
            self.draws = header["draws"]
            return [self._state(), *self._picture_is_out()]
        if kind == "failed":
            self.running = self.working = False
            return [self._status(header["text"], "error"), self._state(), *self._picture_is_out()]
        if kind == "grid":
            self.history = replace(self.history, present=self.document.on_grid(header["grid"]))
            return [self._state()]
        if kind == "trajectory":
            self._trajectory = header["found"]
            return []
        message = ToPage(header, report.buffers, report.client)
        if kind in REPLAYED and report.client is None:
            self._last[kind] = message
        return [*self._shown(message), *self._picture_is_out()] if kind == "field" else [message]

    def _shown(self, field: ToPage) -> Effects:
        """A field goes to the page that asked for it, or to all but those that are shown a draw."""
        drawing = {client for client, view in self._views.items() if view.layer in OWN_LAYERS}
        as_it_is = field.client is not None or not drawing
        pages = [field.client] if as_it_is else [client for client in self._seqs if client not in drawing]
        for client in pages:
            self._pace.sent(client, self.generation)
        return [replace(field, client=client) for client in pages]

    def worker_lost(self) -> Effects:
        """The worker died; another is being started."""
        self.worker_ready = False
        text = "the worker stopped and is being restarted; the map is kept"
        return [ToPage({"type": "worker", "state": "restarted"}), self._status(text, "warning")]

    def _on_ready(self, document: Document | None) -> Effects:
        """A worker without a past: give it the document, or take that of the file that it has opened."""
        self.worker_ready = True
        if document is not None and self.generation == 0:
            self.history = History(document)
        known = () if self._trajectory is None else (self._trajectory,)
        tasks = map(ToWorker, (*known, *self._views.values()))
        ready: Effects = [ToPage({"type": "worker", "state": "ready"}), *tasks]
        again: Mode = "run" if self.running else self._mode if self._mode == "clear" else self._usual()
        return [*ready, *self._restart(again)]

    def _picture_is_out(self) -> Effects:
        self._pace.computing = False
        return self._apply(self._pace.due())

    # What follows from both

    def _usual(self) -> Mode:
        return "live" if self.live else "preview"

    def _restart(self, mode: Mode | None = None) -> Effects:
        """A new generation."""
        self.generation += 1
        self._mode = mode if mode is not None else self._usual()
        self.running, self.working = self._mode == "run", self._mode != "clear"
        self.draws = {"chains": 0, "count": 0}
        self._pace.computing = True
        self._last.pop("field", None)
        if self.document.simulated:
            self._last.pop("overlay", None)  # of the file that was shown before
        self.scan = min(self.scan, max(0, self.document.source.scans - 1))
        task = Infer(self.generation, self.document, self._mode, self.scan)
        # The state first: a page must know of a generation before it sees the picture.
        return [self._state(), ToWorker(task)]

    def _state(self) -> ToPage:
        """The present state, with the number of each page's last message in it: see `addressed`."""
        header = {
            "type": "state",
            "document": self.document.to_json(),
            "generation": self.generation,
            "live": self.live,
            "running": self.running,
            "working": self.working,
            "draws": self.draws,
            "scan": self.scan,
            "pages": {
                client: {
                    "seq": seq,
                    "view": _as_json(self._views.get(client, View("mean"))),
                    "can_undo": self.history.can_undo and self._may_step(client, self.history.undoes),
                    "can_redo": self.history.can_redo and self._may_step(client, self.history.redoes),
                }
                for client, seq in self._seqs.items()
            },
        }
        return ToPage(header)

    def _status(self, text: str, level: str, client: int | None = None) -> ToPage:
        return ToPage({"type": "status", "text": text, "level": level}, {}, client)


def addressed(header: Mapping[str, Any], client: int) -> Mapping[str, Any]:
    """A message as one page is to see it: in a state, its own last message that was applied, its view, its undo."""
    if header["type"] != "state":
        return header
    unknown = {"seq": 0, "view": _as_json(View("mean")), "can_undo": False, "can_redo": False}
    own = header["pages"].get(client, unknown)
    return {**{name: value for name, value in header.items() if name != "pages"}, **own}


def _as_json(view: View) -> dict[str, Any]:
    return {"layer": view.layer, "chain": view.chain, "draw": view.draw}


def refusal(refused: Refused, kind: str | None = None, seq: int | None = None) -> dict[str, Any]:
    """The answer to a message that was not understood."""
    named = {"type": kind, "seq": seq}
    return {"type": "error", "text": refused.text, "remedy": refused.remedy, "refused": named}
