"""The server of the page and its guard (docs/app.md). The server listens on loopback unless another host is given.

The guard admits requests that have the token, address the server by one of its names, and come from its own page.
"""

from __future__ import annotations

import asyncio
import base64
import contextlib
import hashlib
import ipaddress
import secrets
import signal
import socket
import time
from collections.abc import Callable, Iterator, Mapping
from typing import Any
from urllib.parse import parse_qs, urlsplit

import uvicorn
from starlette.applications import Starlette
from starlette.datastructures import MutableHeaders
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from bayesmap.app.dropped import open_dropped
from bayesmap.app.figures import HEAD, read_static
from bayesmap.app.hub import Hub, Outbox
from bayesmap.app.protocol.document import Document, Refused
from bayesmap.app.protocol.notices import Story
from bayesmap.app.protocol.wire import MAX_BYTES
from bayesmap.errors import BadInput

WRONG_TOKEN = "the token is missing or wrong: open the address that bayesmap app printed"
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src {scripts}; style-src 'self' 'unsafe-inline'; connect-src 'self'{sockets}; "
        "img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
POLICY_VIOLATION = 1008  # code with which a WebSocket is closed (RFC 6455)

# Script of the page that a wrong token gets: it tries the token that the browser kept from an earlier visit, once.
SCRIPT = """
const key = "bayesmap-token";
const given = new URLSearchParams(location.search).get("token");
let kept = null;
try {
  kept = localStorage.getItem(key);
  if (kept === given) localStorage.removeItem(key);
} catch {}
if (kept && kept !== given) location.replace("/?token=" + encodeURIComponent(kept) + location.hash);
if (location.hash) document.getElementById("link").hidden = false;
"""

PAGE = f"""{HEAD}\
<style>body {{ max-width: 36em; margin: 12vh auto; padding: 0 1.5em; font: 16px/1.5 system-ui, sans-serif; }}</style>
</head>
<body>
<h1>bayesmap</h1>
<p>The token is missing or wrong: open the address that <code>bayesmap app</code> printed.</p>
<p id="link" hidden>Then open this link again: its map is shown there.</p>
<script>{SCRIPT}</script>
</body>
</html>
"""

SCRIPT_HASH = "sha256-" + base64.b64encode(hashlib.sha256(SCRIPT.encode()).digest()).decode()
"""The hash of the only script that the policy lets run."""


class Guard:
    """Middleware that refuses requests without the token, with an unknown Host, or with a foreign Origin. The Host is
    checked against foreign web pages whose own host name resolves to this machine.
    """

    def __init__(self, app: ASGIApp, token: str, host: str, port: int) -> None:
        self.app, self.token, self.host, self.port = app, token.encode(), host, port
        self.any_address = host in ("0.0.0.0", "::", "")
        names = ["127.0.0.1", "localhost", "[::1]", f"[{host}]" if ":" in host else host]
        if self.any_address:
            names.append(socket.gethostname().lower())
        self.names = frozenset(names)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Check a request, then pass it on or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        objection = self.objection(scope)
        if objection is not None and scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": POLICY_VIOLATION, "reason": objection})
            return

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                host = _header(scope, b"host")
                for name, value in HEADERS.items():
                    sockets, scripts = (f" ws://{host}", "'self'") if objection is None else ("", f"'{SCRIPT_HASH}'")
                    headers[name] = value.format(sockets=sockets, scripts=scripts)
            await send(message)

        answer: ASGIApp = self.app
        if objection == WRONG_TOKEN and scope.get("path") == "/":
            answer = HTMLResponse(PAGE, status_code=403)
        elif objection is not None:
            answer = PlainTextResponse(f"{objection}\n", status_code=403)
        await answer(scope, receive, with_headers if scope["type"] == "http" else send)

    def objection(self, scope: Scope) -> str | None:
        """Return the reason why a request is refused, or None."""
        if not self.knows(_header(scope, b"host")):
            return "this server does not go by that name"
        origin = _header(scope, b"origin")
        if origin:
            parts = urlsplit(origin)
            if parts.scheme != "http" or not self.knows(parts.netloc):
                return "requests from other pages are refused"
        tokens = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])
        return None if secrets.compare_digest(tokens[-1].encode(), self.token) else WRONG_TOKEN

    def knows(self, host: str) -> bool:
        """Return whether a host with its port is this server."""
        name, _, port = host.lower().rpartition(":")
        return port == str(self.port) and (name in self.names or (self.any_address and _is_address(name)))


def _is_address(name: str) -> bool:
    """Return whether a name is a numeric address, which cannot be made to point to another machine."""
    try:
        ipaddress.ip_address(name.strip("[]"))
    except ValueError:
        return False
    return True


def _header(scope: Scope, name: bytes) -> str:
    """Return a header of a request; values of repeated headers are joined by commas."""
    return b",".join(value for key, value in scope["headers"] if key == name).decode("latin-1")


MESSAGES_PER_SECOND = 200  # largest rate of a page's messages
BURST_MESSAGES = 400  # number of messages that a page may send at once
MAX_EXCESS_MESSAGES = 2000  # number of messages over the rate after which a page is disconnected
MAX_READ_BYTES = 4 * MAX_BYTES  # a longer message closes the connection; one over `MAX_BYTES` gets an error


class RateLimit:
    """Rate limit for messages by a token bucket: `BURST_MESSAGES` tokens, refilled at `MESSAGES_PER_SECOND`."""

    def __init__(self) -> None:
        self._tokens, self._refilled_s = float(BURST_MESSAGES), time.monotonic()
        self.n_refused = 0

    def allow(self) -> bool:
        """Return whether one more message is allowed now."""
        now_s = time.monotonic()
        self._tokens = min(BURST_MESSAGES, self._tokens + (now_s - self._refilled_s) * MESSAGES_PER_SECOND)
        self._refilled_s = now_s
        allowed = self._tokens >= 1
        self._tokens -= allowed
        self.n_refused += not allowed
        return allowed


def application(hub: Hub, token: str, host: str, port: int) -> Guard:
    """Return the ASGI application: the page, its module, and the socket."""

    def page(request: Request) -> Response:
        return HTMLResponse(read_static("index.html").replace("__TOKEN__", token))

    def module(request: Request) -> Response:
        return Response(read_static("mapview.js"), media_type="text/javascript")

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
    routes.append(Route("/open", open_dropped, methods=["POST"]))
    return Guard(Starlette(routes=routes), token, host, port)


async def _send(socket: WebSocket, outbox: Outbox) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while True:
            data = await outbox.get()
            await (socket.send_bytes(data) if isinstance(data, bytes) else socket.send_text(data))


async def _receive(socket: WebSocket, hub: Hub, client: int) -> None:
    limit = RateLimit()
    while True:
        event = await socket.receive()
        if event["type"] != "websocket.receive":
            return
        if not limit.allow():
            if limit.n_refused % MESSAGES_PER_SECOND == 1:
                hub.refuse(client, Refused("too many messages", f"send at most {MESSAGES_PER_SECOND} a second"))
            if limit.n_refused > MAX_EXCESS_MESSAGES:
                await socket.close(POLICY_VIOLATION, "too many messages")
                return
            continue
        text = event.get("text")
        hub.receive(client, text if text is not None else event.get("bytes") or b"")


def listen(host: str, port: int) -> socket.socket:
    """Return a listening socket. Port 0 means any free port. Raises `BadInput` if the address is not available."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    # With TCP given explicitly, asyncio sends small messages at once. Else each waits for the last one's receipt.
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen(128)
    except (OSError, OverflowError) as error:
        listener.close()
        reason = getattr(error, "strerror", None) or str(error)
        raise BadInput(f"app: cannot listen on {host}:{port} ({reason}); choose another --port, or 0 for any") from None
    return listener


class _Server(uvicorn.Server):
    """A server that calls `on_ready` when it accepts requests."""

    def __init__(self, config: uvicorn.Config, on_ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._on_ready = on_ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self._on_ready()

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        # uvicorn would handle Ctrl-C even in a process that was started to ignore it.
        handler = signal.getsignal(signal.SIGINT)
        with super().capture_signals():
            if handler is signal.SIG_IGN:
                signal.signal(signal.SIGINT, handler)
            yield


async def _serve(
    make_hub: Callable[[], Hub], listener: socket.socket, host: str, announce: Callable[[str], None],
    make_server: Callable[[uvicorn.Config, Callable[[], None]], uvicorn.Server] = _Server,
) -> None:  # fmt: skip
    """Serve a hub, and announce the page's address when requests are accepted and a picture is there."""
    port, token, hub = listener.getsockname()[1], secrets.token_urlsafe(24), make_hub()
    name = f"[{host}]" if ":" in host else host
    name = {"0.0.0.0": "127.0.0.1", "[::]": "[::1]"}.get(name, name)
    try:
        await hub.start()
        config = uvicorn.Config(
            application(hub, token, host, port), ws="websockets-sansio", ws_max_size=MAX_READ_BYTES,
            ws_per_message_deflate=False,  # it costs more time on loopback than it saves
            lifespan="off", log_level="error", access_log=False, server_header=False, timeout_graceful_shutdown=1,
        )  # fmt: skip
        await make_server(config, lambda: announce(f"http://{name}:{port}/?token={token}")).serve(sockets=[listener])
    finally:
        hub.stop()


def serve(
    document: Document, *, path: str | None = None, log_options: Mapping[str, Any] | None = None,
    story: Story | None = None, host: str = "127.0.0.1", port: int = 0, on_ready: Callable[[str], None],
) -> None:  # fmt: skip
    """Serve the page until Ctrl-C. ``on_ready`` gets its address when requests are accepted and a picture is there.

    ``path`` is a saved run, or a log that `bayesmap.read_log` reads with ``log_options``; without one, ``document`` is
    shown first. ``story`` is shown beside the map. Port 0 means any free port. Raises `BadInput` if the port is taken,
    or the file cannot be shown, and `KeyboardInterrupt` if Ctrl-C comes before the server is ready.
    """
    with contextlib.closing(listen(host, port)) as listener:
        ready = False

        def announce(address: str) -> None:
            nonlocal ready
            ready = True
            on_ready(address)

        try:
            asyncio.run(_serve(lambda: Hub(document, path, log_options, story), listener, host, announce))
        except KeyboardInterrupt:
            if not ready:
                raise
