"""The page as a widget in a notebook: it runs the page's module over the notebook's own channel, without a server."""

import tempfile
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bayesmap.app.edits import tutorial_document
from bayesmap.app.exports import build_recording, encode_recording
from bayesmap.app.figures import page_in_one_file, read_static
from bayesmap.app.hub import on_this_loop, running_loop
from bayesmap.app.protocol.document import Refused
from bayesmap.app.protocol.notices import AnyNotice
from bayesmap.app.protocol.tasks import Buffers, FileUnusable, Report
from bayesmap.app.protocol.wire import check_action, parse_simulation, read_seq, separate_arrays
from bayesmap.app.session import Effects, Session, ToPage, refusal
from bayesmap.app.sources import open_run
from bayesmap.app.worker import Supervisor
from bayesmap.errors import BadInput
from bayesmap.result import Run

try:
    import anywidget
except ImportError as error:
    raise ImportError("bayesmap.MapWidget needs anywidget: pip install 'bayesmap[notebook]'") from error

CLIENT = 1  # number of the only page of a widget's session


class MapWidget(anywidget.AnyWidget):
    """The interactive page in Jupyter and marimo.

    ``MapWidget()`` is the live page on the tutorial's map. ``MapWidget(run)`` shows a finished run, its draws and its
    scans. The worker process starts when the widget is first shown. It ends with `close` or with the kernel. In marimo
    it also ends when the cell is run again, or when the visitor of an app has left.

    Args:
        run: the run to show; None for the live page.
        document: the first document of the live page, as JSON values (docs/app.md).
        seed: the seed of all random numbers of the live page.

    Raises `BadInput` for an invalid document.
    """

    _esm = read_static("mapview.js")
    _supervisor: Supervisor | None = None
    _folder: tempfile.TemporaryDirectory[str] | None = None

    def __init__(
        self, run: Run | None = None, *, document: Mapping[str, Any] | None = None, seed: int = 0, **options: Any
    ) -> None:
        super().__init__(**options)
        self._run = run
        first_document = tutorial_document(seed) if document is None else parse_simulation(dict(document))
        self._session = Session(first_document if run is None else open_run(run, "run").document)
        # Without an event loop, the supervisor's threads call the session directly.
        self._session_lock = threading.RLock()
        self._on_report = on_this_loop(self._receive_report)
        self._on_lost = on_this_loop(self._worker_lost)
        self.on_msg(self._receive_message)
        self._end_with_notebook()

    @property
    def document(self) -> dict[str, Any]:
        """The present document, as JSON values."""
        return self._session.document.to_json()

    @property
    def generation(self) -> int:
        """The generation of the present picture."""
        return self._session.generation

    def to_html(self) -> str:
        """Return a page in one file that shows the run. Raises `BadInput` if the widget is a live page."""
        if self._run is None:
            raise BadInput("MapWidget: a live page is exported from the page itself")
        return page_in_one_file("recording", encode_recording(*build_recording(open_run(self._run, "run").result)))

    def close(self) -> None:
        """End the worker and the widget."""
        self._end()
        super().close()

    def _end(self) -> None:
        """End the worker. A later message from the view starts another."""
        if self._supervisor is not None:
            self._supervisor.stop()
            self._supervisor = None
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def _end_with_notebook(self) -> None:
        """End the worker also if the notebook drops the widget without closing it, as marimo does."""
        # When a cell is run again, marimo closes the channels of its widgets, but not the widgets.
        channel = self.comm
        if channel is not None:
            close = channel.close

            def close_and_end(*arguments: Any, **options: Any) -> None:
                self._end()
                close(*arguments, **options)

            channel.close = close_and_end

        # Each visitor of an app has a thread. When the visitor leaves, nothing is closed, but the thread ends.
        thread = threading.current_thread()
        if thread is not threading.main_thread() and running_loop() is not None:

            def end_after() -> None:
                thread.join()
                self._end()

            threading.Thread(target=end_after, name="bayesmap-end", daemon=True).start()

    def _receive_message(self, _widget: object, content: Any, _buffers: object) -> None:
        """Read and apply a message from the view."""
        self._start_worker()
        with self._session_lock:
            if isinstance(content, dict) and content.get("type") == "hello":
                self._carry_out(self._session.join(CLIENT))
            try:
                action = check_action(content)
            except Refused as refused:
                self._post(refusal(refused, read_seq(content if isinstance(content, dict) else {})), {})
                return
            self._carry_out(self._session.receive(CLIENT, action))

    def _start_worker(self) -> None:
        """Start the worker, if it does not run yet. A run reaches the worker as a file."""
        if self._supervisor is not None:
            return
        path = None
        if self._run is not None:
            self._folder = tempfile.TemporaryDirectory(prefix="bayesmap-")
            path = str(Path(self._folder.name) / "run.nc")
            self._run.save(path)
        self._supervisor = Supervisor(self._on_report, self._on_lost, path)
        self._supervisor.start()

    def _receive_report(self, report: Report) -> None:
        if not isinstance(report.message, FileUnusable):
            with self._session_lock:
                self._carry_out(self._session.receive_report(report))

    def _worker_lost(self) -> None:
        with self._session_lock:
            self._carry_out(self._session.worker_lost())

    def _carry_out(self, effects: Effects) -> None:
        """Send messages to the view, and tasks to the worker."""
        for effect in effects:
            if isinstance(effect, ToPage):
                self._post(effect.message, effect.buffers)
            elif self._supervisor is not None:
                self._supervisor.send(effect)

    def _post(self, message: AnyNotice, buffers: Buffers) -> None:
        header, arrays = separate_arrays(message, buffers)
        self.send(header, [array.tobytes() for array in arrays])
