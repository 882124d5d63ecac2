"""The session holds the document. It decides on the tasks for the worker and on the messages to pages.

`Session.receive` applies an action of a page, and `Session.receive_report` a report of the worker. Both return effects,
which the hub or the notebook's widget carries out. The session itself uses no sockets and no clocks. Every change of
the document begins a new *generation*: the worker starts inference again. Edits of a gesture that arrive faster than
pictures can be computed and painted are merged (`bayesmap.app.edits.Pace`).
"""

from collections.abc import Hashable
from dataclasses import dataclass, field, replace
from typing import Literal, get_args

import msgspec

from bayesmap.app.edits import ActionOfPage, History, Pace, adopt_document, edit_document, gesture_of
from bayesmap.app.figures import figure_page
from bayesmap.app.protocol import actions, notices, tasks
from bayesmap.app.protocol.document import VERSION, Document, Refused, encode_json
from bayesmap.app.protocol.wire import parse_document

QUESTIONS = get_args(actions.Question)
EDITS = get_args(actions.Edit)
REPLAYED = (notices.Scan, notices.Field, notices.Overlay)  # a page that connects gets the last message of each kind


@dataclass(frozen=True)
class ToPage:
    """The effect of sending a message."""

    message: notices.AnyNotice
    buffers: tasks.Buffers = field(default_factory=dict)  # arrays of the message, by name
    client: int | None = None  # number of the page; None for all pages


Effect = ToPage | tasks.Task
Effects = list[Effect]
Steps = tuple[tuple[Document, Hashable], ...]  # documents before or after steps of the history, with their authors


class Session:
    """One document, shown on any number of pages."""

    def __init__(self, document: Document, story: notices.Story | None = None) -> None:
        self._story = story  # shown beside the map
        self.history = History(document)  # the document, and its earlier and undone states
        self.generation = 0  # number of the present picture (docs/app.md)
        self.live = True  # whether edits restart the chains
        self.running = False  # whether a run is under way
        self.working = False  # whether the picture is still being computed
        self.draws = notices.DrawCount()  # kept draws of the present result
        self.scan = 0  # index of the scan on show, for a file
        self.worker_ready = False  # whether the worker has loaded its kernels
        self._views: dict[int, notices.View] = {}  # the views of pages that asked for one
        self._mode: tasks.Mode = "live"  # mode of the present generation
        self._pace = Pace()  # merges edits that arrive faster than pictures
        self._last_seqs: dict[int, int] = {}  # number of the last applied action of every page
        self._last_sent: dict[type, ToPage] = {}  # last message of each kind in `REPLAYED`
        self._trajectory: tasks.TrajectoryState | None = None  # inferred from a log, for the next worker

    @property
    def document(self) -> Document:
        """The present document."""
        return self.history.present

    def receive(self, client: int, action: actions.AnyAction) -> Effects:
        """Apply an action of a page. Returns its effects in order. A refused action has a warning as its effect."""
        if isinstance(action, QUESTIONS):
            try:
                check_question(self.document, action)
            except Refused as refused:
                return [_status(refused.text, "warning", client)]
            return [tasks.Ask(client, action)]
        if isinstance(action, actions.Painted):
            self._pace.record_painted(client, action.generation)
            return self._apply_all(self._pace.release_due())
        return self._apply_all(self._pace.accept(client, action))

    def join(self, client: int) -> Effects:
        """Return the first messages for a page that has connected. The page answers with `hello`."""
        self._last_seqs[client] = 0
        self._pace.forget(client)
        worker = notices.Worker("ready" if self.worker_ready else "starting")
        return [
            *self._forget_view(client),
            ToPage(notices.Welcome(VERSION, notices.LIMITS, story=self._story), {}, client),
            ToPage(worker, {}, client),
        ]

    def leave(self, client: int) -> Effects:
        """Forget a page that has disconnected. The worker makes no fields for it, and any page may undo its steps."""
        self._pace.forget(client)
        effects = self._apply_all(self._pace.release_due())
        self._last_seqs.pop(client, None)
        return [*effects, *self._forget_view(client), *self._state_for_all()]

    def _forget_view(self, client: int) -> Effects:
        """Forget the view of a page, so that the worker makes no field for it."""
        view = self._views.pop(client, None)
        return [] if view is None else [tasks.Show(client, notices.View("mean"))]

    def _apply_all(self, page_actions: list[ActionOfPage]) -> Effects:
        """Apply actions of pages in order. Returns their effects, or the reasons why they are refused."""
        effects: Effects = []
        for client, action in page_actions:
            self._last_seqs[client] = action.seq
            try:
                effects += self._dispatch(client, action)
            except Refused as refused:
                effects += [_status(str(refused), "warning", client), *self._state_for_all()]
        return effects

    def _dispatch(self, client: int, action: actions.AnyAction) -> Effects:
        """Apply an action by its kind. Raises `Refused` if it cannot be applied."""
        match action:
            case actions.Hello():
                return self._answer_hello(client, action)
            case actions.Clear(what="inference"):
                return self._restart("clear")
            case actions.Undo():
                return self._undo_or_redo(client, self.history.undo(), self.history.past, "undo")
            case actions.Redo():
                return self._undo_or_redo(client, self.history.redo(), self.history.future, "redo")
            case actions.Run():
                if self.document.source.kind == "run":
                    raise Refused("a saved run is shown as it is", "begin a new map to run inference")
                return self._restart("run")
            case actions.Cancel():
                return [action, *self._state_for_all()]
            case actions.SetLive():
                self.live = action.on
                if self.running or self.document.source.kind == "run":
                    return self._state_for_all()
                return self._restart() if self.live else [actions.Cancel(), *self._state_for_all()]
            case actions.ShowView():
                self._views[client] = notices.View(action.layer, action.chain, action.draw)
                return [tasks.Show(client, self._views[client]), *self._state_for_all()]
            case actions.ShowScan():
                scans = self.document.source.scans
                if action.index >= scans:
                    raise Refused(f"there is no scan {action.index}", f"there are {scans}, from 0" if scans else "")
                self.scan = action.index
                return [action, *self._state_for_all()]
            case actions.Export(what="document"):
                data = msgspec.json.format(encode_json(self.document), indent=1) + b"\n"
                return [ToPage(notices.Download("document.json", "application/json"), {"data": data}, client)]
            case actions.Export(what="figure"):
                download = notices.Download("figure.html", "text/html", "which samples by itself")
                return [ToPage(download, {"data": figure_page(self.document, self._story).encode()}, client)]
            case actions.Export():
                return [tasks.Ask(client, action), *self._state_for_all()]
            case _:
                assert isinstance(action, EDITS)
                return self._apply_edit(client, action)

    def _apply_edit(self, client: int, action: actions.Edit) -> Effects:
        """Change the document by an edit, and restart inference if the document has changed."""
        before = self.document
        document, remark = edit_document(before, action)
        self.history = self.history.push(document, gesture_of(client, action), client)
        effects: Effects = [_status(remark, "warning", client)] if remark else []
        # While the hand drags a setting of a log, show only counts of hits. The end of the drag starts inference.
        coarse = False
        if isinstance(action, actions.ChangeSettings):
            coarse = action.coarse and self.document.source.kind == "log"
            if "scans_used" in actions.changed_settings(action.patch):
                self.scan = (self.document.scans_used or self.document.source.scans) - 1
        if self.document is before and (coarse or self._mode != "coarse"):
            return [*effects, *self._state_for_all()]
        return effects + self._restart("coarse" if coarse else None)

    def _answer_hello(self, client: int, action: actions.Hello) -> Effects:
        """Send the state and the last messages to a page. Adopt the document that it brings, if possible."""
        effects: Effects = []
        if action.document is not None:
            try:
                page_document = parse_document(action.document)
            except Refused as refused:
                return [ToPage(refusal(refused, action.seq), {}, client)]
            try:
                document = adopt_document(self.document, page_document)
            except Refused as refused:
                effects.append(_status(str(refused), "warning", client))
            else:
                self.history = self.history.push(document, author=client)
                if self.document is document:
                    return self._restart()
        effects.append(self._state_for(client))
        return effects + [replace(self._last_sent[kind], client=client) for kind in REPLAYED if kind in self._last_sent]

    def _may_step(self, client: int, steps: Steps) -> bool:
        """Return whether a page may undo or redo the last step: its own step, or a disconnected page's step."""
        author = steps[-1][1] if steps else None
        return bool(steps) and (author == client or author not in self._last_seqs)

    def _undo_or_redo(self, client: int, history: History[Document], steps: Steps, name: str) -> Effects:
        """Move to `history`, if the page may undo or redo (`name`) the last of `steps`."""
        if not self._may_step(client, steps):
            text = f"the last step was made in another tab: {name} it there" if steps else f"nothing to {name}"
            return [_status(text, "info", client), *self._state_for_all()]
        self.history = history
        return self._restart()

    def receive_report(self, report: tasks.Report) -> Effects:
        """Return the effects of a worker's report. Of an older generation only `Whereabouts` has any: a page waits."""
        message = report.message
        if isinstance(message, tasks.Ready):
            return self._restart_in_new_worker(message.document)
        is_old = getattr(message, "generation", self.generation) != self.generation
        if is_old and not isinstance(message, notices.Whereabouts):
            return []
        match message:
            case tasks.Finished():
                self.running = self.working = False
                self.draws = message.draws
                return [*self._state_for_all(), *self._picture_computed()]
            case tasks.Failed():
                self.running = self.working = False
                return [_status(message.reason, "error"), *self._state_for_all(), *self._picture_computed()]
            case tasks.GridChanged():
                self.history = replace(self.history, present=self.document.on_grid(message.grid))
                return self._state_for_all()
            case tasks.TrajectoryInferred():
                self._trajectory = message.trajectory
                return []
            case tasks.Alive() | tasks.FileUnusable():
                return []
        notice = ToPage(message, report.buffers, report.client)
        if isinstance(message, REPLAYED) and report.client is None:
            self._last_sent[type(message)] = notice
        if isinstance(message, notices.Field):
            return [*self._field_to_pages(notice), *self._picture_computed()]
        return [notice]

    def _field_to_pages(self, notice: ToPage) -> Effects:
        """Return a field for the page that asked for it, or for all pages without fields of their own."""
        clients: list[int | None] = [notice.client]
        own_fields = {client for client, view in self._views.items() if view.layer in notices.OWN_LAYERS}
        if notice.client is None and own_fields:
            clients = [client for client in self._last_seqs if client not in own_fields]
        for client in clients:
            self._pace.record_sent(client, self.generation)
        return [replace(notice, client=client) for client in clients]

    def worker_lost(self) -> Effects:
        """Return messages that tell all pages that the worker stopped and is being restarted."""
        self.worker_ready = False
        text = "the worker stopped and is being restarted; the map is kept"
        return [ToPage(notices.Worker("restarted")), _status(text, "warning")]

    def _restart_in_new_worker(self, document: Document | None) -> Effects:
        """Restart inference in a new worker, at first on the document of the file that it has opened."""
        self.worker_ready = True
        if document is not None and self.generation == 0:
            self.history = History(document)
        effects: Effects = [ToPage(notices.Worker("ready"))]
        if self._trajectory is not None:
            effects.append(self._trajectory)
        effects += [tasks.Show(client, view) for client, view in self._views.items()]
        return effects + self._restart("run" if self.running else "clear" if self._mode == "clear" else None)

    def _picture_computed(self) -> Effects:
        """Apply the actions that waited for a picture."""
        self._pace.computing = False
        return self._apply_all(self._pace.release_due())

    def _restart(self, mode: tasks.Mode | None = None) -> Effects:
        """Begin a new generation: inference starts again on the present document. Mode None: as after an edit."""
        self.generation += 1
        self._mode = mode or ("live" if self.live else "preview")
        self.running, self.working = self._mode == "run", self._mode != "clear"
        self.draws = notices.DrawCount()
        self._pace.computing = True
        self._last_sent.pop(notices.Field, None)
        if self.document.simulated:
            self._last_sent.pop(notices.Overlay, None)  # it belongs to the file shown before
        self.scan = min(self.scan, max(0, self.document.source.scans - 1))
        task = tasks.Infer(self.generation, self.document, self._mode, self.scan)
        # The state comes first: a page must get a generation's number before its picture.
        return [*self._state_for_all(), task]

    def _state_for_all(self) -> Effects:
        """Return the present state for every page."""
        return [self._state_for(client) for client in self._last_seqs]

    def _state_for(self, client: int) -> ToPage:
        """Return the present state for one page."""
        state = notices.State(
            document=self.document, generation=self.generation, seq=self._last_seqs.get(client, 0),
            can_undo=self._may_step(client, self.history.past), can_redo=self._may_step(client, self.history.future),
            live=self.live, running=self.running, working=self.working, draws=self.draws, scan=self.scan,
            view=self._views.get(client, notices.View("mean")),
        )  # fmt: skip
        return ToPage(state, {}, client)


def check_question(document: Document, question: actions.Question) -> None:
    """Check that the cell or the beam of a question exists. Raises `Refused` if it does not."""
    match question:
        case actions.Inspect():
            if question.x >= document.grid.shape[0] or question.y >= document.grid.shape[1]:
                raise Refused("inspect: a cell outside the map")
        case actions.CompareBeam():
            scans = len(document.sensors) if document.simulated else document.source.scans
            if question.scan >= scans or question.beam >= document.angles:
                raise Refused(f"beam: there is no beam {question.beam} of scan {question.scan}")


def refusal(refused: Refused, seq: int | None = None) -> notices.Refusal:
    """Return the answer to a message that was refused."""
    return notices.Refusal(refused.text, refused.remedy, seq)


def _status(text: str, level: Literal["info", "warning", "error"], client: int | None = None) -> ToPage:
    """Return a message for the status line of one page, or of all pages if the client is None."""
    return ToPage(notices.Status(text, level), {}, client)
