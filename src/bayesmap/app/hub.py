"""The hub passes messages between one session, one worker and any number of pages.

The session turns a page's message or a worker's report into effects. `Hub._carry_out` sends them to worker and pages.
"""

import asyncio
import contextlib
import contextvars
import itertools
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

from bayesmap.app.protocol.document import Document, Refused
from bayesmap.app.protocol.notices import AnyNotice, Field, Scan, State, Story
from bayesmap.app.protocol.tasks import Buffers, Failed, FileUnusable, Report
from bayesmap.app.protocol.wire import encode_frame, parse_action, read_seq
from bayesmap.app.session import Effects, Session, ToPage, refusal
from bayesmap.app.worker import Supervisor
from bayesmap.errors import BadInput

NEWEST_ONLY = (Field, Scan, State)  # the types of messages of which a slow page needs only the newest


class Outbox:
    """The messages that wait to be sent to one page."""

    def __init__(self) -> None:
        self._waiting: deque[tuple[AnyNotice, Buffers]] = deque()
        self._filled = asyncio.Event()

    def put(self, message: AnyNotice, buffers: Buffers) -> None:
        """Add a message. It replaces a waiting message of its type if the type is in `NEWEST_ONLY`."""
        if isinstance(message, NEWEST_ONLY):
            self._waiting = deque(entry for entry in self._waiting if type(entry[0]) is not type(message))
        self._waiting.append((message, buffers))
        self._filled.set()

    async def get(self) -> str | bytes:
        """Wait for the oldest message, and return it in the socket's format."""
        while not self._waiting:
            self._filled.clear()
            await self._filled.wait()
        return encode_frame(*self._waiting.popleft())


class Hub:
    """Connects pages, session and worker on one event loop. The arguments are those of `bayesmap.app.server.serve`."""

    def __init__(
        self, document: Document, path: str | None = None, log_options: Mapping[str, Any] | None = None,
        story: Story | None = None,
    ) -> None:  # fmt: skip
        self.session = Session(document, story)  # the session that the pages share
        self._first_picture = asyncio.Event()  # set when there is a first field, or an error instead
        on_report, on_lost = on_this_loop(self._receive_report), on_this_loop(self._worker_lost)
        self._supervisor = Supervisor(on_report, on_lost, path, log_options=log_options)
        self._outboxes: dict[int, Outbox] = {}  # the outbox of each connected page, by its number
        self._numbers = itertools.count(1)
        self._file_fault: str | None = None  # the reason why the file cannot be opened

    async def start(self) -> None:
        """Start the worker and wait for its first picture. Raises `BadInput` if the file cannot be shown."""
        self._supervisor.start()
        await self._first_picture.wait()
        if self._file_fault is not None:
            raise BadInput(self._file_fault)

    def stop(self) -> None:
        """End the worker."""
        self._supervisor.stop()

    def join(self) -> tuple[int, Outbox]:
        """Connect a page; return its number and its outbox."""
        client = next(self._numbers)
        self._outboxes[client] = Outbox()
        self._carry_out(self.session.join(client))
        return client, self._outboxes[client]

    def leave(self, client: int) -> None:
        """Disconnect a page."""
        self._outboxes.pop(client, None)
        self._carry_out(self.session.leave(client))

    def receive(self, client: int, data: str | bytes) -> None:
        """Read and apply a message of a page."""
        try:
            action = parse_action(data)
        except Refused as refused:
            self.refuse(client, refused, read_seq(data))
            return
        self._carry_out(self.session.receive(client, action))

    def refuse(self, client: int, refused: Refused, seq: int | None = None) -> None:
        """Tell a page that a message was refused."""
        self._outboxes[client].put(refusal(refused, seq), {})

    def _carry_out(self, effects: Effects) -> None:
        """Send messages to pages, and tasks to the worker."""
        for effect in effects:
            if not isinstance(effect, ToPage):
                self._supervisor.send(effect)
                continue
            for client, outbox in self._outboxes.items():
                if effect.client is None or effect.client == client:
                    outbox.put(effect.message, effect.buffers)

    def _receive_report(self, report: Report) -> None:
        """Pass a report of the worker to the session, and note the first picture."""
        if isinstance(report.message, FileUnusable):
            self._file_fault = report.message.reason
            self._first_picture.set()
            return
        self._carry_out(self.session.receive_report(report))
        if isinstance(report.message, Field | Failed):
            self._first_picture.set()

    def _worker_lost(self) -> None:
        self._carry_out(self.session.worker_lost())


def on_this_loop(call: Callable[..., None]) -> Callable[..., None]:
    """Return a function by which other threads run a call on this thread's event loop; the call itself without one."""
    loop = running_loop()
    if loop is None:
        return call
    context = contextvars.copy_context()

    def call_later(*arguments: Any) -> None:
        if not loop.is_closed():
            loop.call_soon_threadsafe(call, *arguments, context=context)

    return call_later


def running_loop() -> asyncio.AbstractEventLoop | None:
    """Return the event loop that runs in this thread, or None."""
    with contextlib.suppress(RuntimeError):
        return asyncio.get_running_loop()
    return None
