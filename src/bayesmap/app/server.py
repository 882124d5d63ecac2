"""The server of the page: on loopback unless another host is named, guarded by a token (docs/app.md)."""

from __future__ import annotations

import asyncio
import contextlib
import secrets
import signal
import socket
import time
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from bayesmap.app.guard import Guard
from bayesmap.app.hub import Hub, Outbox
from bayesmap.app.protocol.document import Document, Refused
from bayesmap.app.protocol.wire import MAX_BYTES
from bayesmap.app.recording import static
from bayesmap.errors import BadInput

MESSAGES_PER_SECOND = 200
BURST = 400
FLOOD = 2000
"""Messages over the rate after which a page is cut off."""

HARD_LIMIT_BYTES = 4 * MAX_BYTES
"""Messages over `MAX_BYTES` are answered by an error; over this, the connection is closed unread."""

POLICY_VIOLATION = 1008


class Rate:
    """A bucket of messages that fills again with time."""

    def __init__(self) -> None:
        self._left, self._at = float(BURST), time.monotonic()
        self.over = 0

    def allow(self) -> bool:
        """Whether one more is allowed now."""
        now = time.monotonic()
        self._left = min(BURST, self._left + (now - self._at) * MESSAGES_PER_SECOND)
        self._at = now
        if self._left < 1:
            self.over += 1
            return False
        self._left -= 1
        return True


def application(hub: Hub, token: str, host: str, port: int) -> Guard:
    """The ASGI application: the page, its module, and the socket."""

    def page(request: Request) -> Response:
        return HTMLResponse(static("index.html").replace("__TOKEN__", token))

    def module(request: Request) -> Response:
        return Response(static("mapview.js"), media_type="text/javascript")

    async def connect(socket: WebSocket) -> None:
        await socket.accept()
        client, outbox = hub.join()
        sending = asyncio.create_task(_send(socket, outbox))
        try:
            await _receive(socket, hub, client)
        finally:
            sending.cancel()
            hub.leave(client)

    routes = [Route("/", page), Route("/mapview.js", module), WebSocketRoute("/socket", connect)]
    return Guard(Starlette(routes=routes), token, host, port)


async def _send(socket: WebSocket, outbox: Outbox) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while True:
            data = await outbox.get()
            await (socket.send_bytes(data) if isinstance(data, bytes) else socket.send_text(data))


async def _receive(socket: WebSocket, hub: Hub, client: int) -> None:
    rate = Rate()
    while True:
        event = await socket.receive()
        if event["type"] != "websocket.receive":
            return
        if not rate.allow():
            if rate.over % MESSAGES_PER_SECOND == 1:
                hub.refuse(client, Refused("too many messages", f"send at most {MESSAGES_PER_SECOND} a second"))
            if rate.over > FLOOD:
                await socket.close(POLICY_VIOLATION, "too many messages")
                return
            continue
        text = event.get("text")
        hub.receive(client, text if text is not None else event.get("bytes") or b"")


def listen(host: str, port: int) -> socket.socket:
    """A listening socket; port 0 takes any that is free.

    Raises:
        BadInput: the address cannot be had.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    # With the protocol named, asyncio sends small messages at once; else each would wait for the last one's receipt.
    found = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        found.bind((host, port))
        found.listen(128)
    except (OSError, OverflowError) as error:
        found.close()
        reason = getattr(error, "strerror", None) or str(error)
        raise BadInput(f"app: cannot listen on {host}:{port} ({reason}); choose another --port, or 0 for any") from None
    return found


class _Server(uvicorn.Server):
    """Tells when it answers."""

    def __init__(self, config: uvicorn.Config, on_ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._on_ready = on_ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self._on_ready()

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        # uvicorn listens to Ctrl-C even in a process that was started to ignore it.
        before = signal.getsignal(signal.SIGINT)
        with super().capture_signals():
            if before is signal.SIG_IGN:
                signal.signal(signal.SIGINT, before)
            yield


async def _serve(
    hub_of: Callable[[], Hub],
    found: socket.socket,
    host: str,
    announce: Callable[[str], None],
    server_of: Callable[[uvicorn.Config, Callable[[], None]], uvicorn.Server] = _Server,
) -> None:
    port = found.getsockname()[1]
    token = secrets.token_urlsafe(24)
    hub = hub_of()
    name = f"[{host}]" if ":" in host else host
    shown = {"0.0.0.0": "127.0.0.1", "[::]": "[::1]"}.get(name, name)
    try:
        await hub.start()
        config = uvicorn.Config(
            application(hub, token, host, port),
            ws="websockets-sansio",
            ws_max_size=HARD_LIMIT_BYTES,
            ws_per_message_deflate=False,  # it costs more time on loopback than it saves
            lifespan="off",
            log_level="error",
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=1,
        )
        await server_of(config, lambda: announce(f"http://{shown}:{port}/?token={token}")).serve(sockets=[found])
    finally:
        hub.stop()


def serve(
    document: Document,
    *,
    path: str | None = None,
    reading: Mapping[str, Any] | None = None,
    host: str = "127.0.0.1",
    port: int = 0,
    on_ready: Callable[[str], None],
) -> None:
    """Serve the page until Ctrl-C.

    Args:
        document: what is shown first, where no file is.
        path: a saved run or a log to show.
        reading: how a log is read, as `bayesmap.read_log` calls it.
        host: to listen on.
        port: the same; 0 takes any that is free.
        on_ready: given the address of the page when the server answers and the first picture is there.

    Raises:
        BadInput: the port is taken, or the file cannot be shown.
        KeyboardInterrupt: Ctrl-C before that.
    """
    with contextlib.closing(listen(host, port)) as found:
        ready = False

        def announce(address: str) -> None:
            nonlocal ready
            ready = True
            on_ready(address)

        try:
            asyncio.run(_serve(lambda: Hub(document, path, reading), found, host, announce))
        except KeyboardInterrupt:
            if not ready:
                raise
