"""The server of the page (docs/app.md). It listens on loopback unless another host is given.

`serve`, at the end, opens the socket and runs a `Hub` behind the application that `build_application` makes. `Guard`
admits only requests that have the token, address the server by one of its names, and come from its own page.
"""

import asyncio
import base64
import contextlib
import hashlib
import ipaddress
import secrets
import signal
import socket
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
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

from bayesmap.app.figures import read_page, read_static
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
    "Referrer-Policy": "no-referrer", "X-Content-Type-Options": "nosniff", "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin", "Cache-Control": "no-store",
}  # fmt: skip
POLICY_VIOLATION = 1008  # code with which a WebSocket is closed (RFC 6455)

# The script of this page tries once the token that the browser kept. The policy lets only it run, by its hash.
WRONG_TOKEN_PAGE = read_page("wrong_token.html")
TOKEN_SCRIPT = WRONG_TOKEN_PAGE.partition("<script>")[2].partition("</script>")[0]
SCRIPT_HASH = "sha256-" + base64.b64encode(hashlib.sha256(TOKEN_SCRIPT.encode()).digest()).decode()


class Guard:
    """Middleware that refuses requests without the token, with an unknown Host, or with a foreign Origin."""

    def __init__(self, app: ASGIApp, token: str, host: str, port: int) -> None:
        self.app = app
        self.token = token.encode()
        self.host = host
        self.port = port
        self.any_address = host in ("0.0.0.0", "::", "")  # whether the server listens on all addresses
        names = ["127.0.0.1", "localhost", "[::1]", f"[{host}]" if ":" in host else host]
        if self.any_address:
            names.append(socket.gethostname())
        self.names = frozenset(name.lower() for name in names)  # host names of this server

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Check a request, then pass it on or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        reason = self.refusal_reason(scope)
        if reason is not None and scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": POLICY_VIOLATION, "reason": reason})
            return
        # A refused page may only run its own script. An admitted page runs its module, and connects to the socket.
        scripts = f"'{SCRIPT_HASH}'" if reason is not None else "'self'"
        sockets = "" if reason is not None else f" ws://{_read_header(scope, b'host')}"

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers[name] = value.format(sockets=sockets, scripts=scripts)
            await send(message)

        response: ASGIApp = self.app
        if reason == WRONG_TOKEN and scope.get("path") == "/":
            response = HTMLResponse(WRONG_TOKEN_PAGE, status_code=403)
        elif reason is not None:
            response = PlainTextResponse(f"{reason}\n", status_code=403)
        await response(scope, receive, send_with_headers if scope["type"] == "http" else send)

    def refusal_reason(self, scope: Scope) -> str | None:
        """Return the reason why a request is refused, or None."""
        # A foreign web page's own host name may resolve to this machine (DNS rebinding), so the Host is checked.
        if not self.is_own_host(_read_header(scope, b"host")):
            return "this server does not go by that name"
        origin = _read_header(scope, b"origin")
        if origin:
            url = urlsplit(origin)
            if url.scheme != "http" or not self.is_own_host(url.netloc):
                return "requests from other pages are refused"
        tokens = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])
        return None if secrets.compare_digest(tokens[-1].encode(), self.token) else WRONG_TOKEN

    def is_own_host(self, host: str) -> bool:
        """Return whether a host with its port ("localhost:8000") is this server."""
        has_port = ":" in host.rpartition("]")[2]  # browsers leave out port 80; the colons of an address do not count
        name, _, port = (host if has_port else f"{host}:80").lower().rpartition(":")
        return port == str(self.port) and (name in self.names or (self.any_address and _is_address(name)))


def _is_address(name: str) -> bool:
    """Return whether a name is a numeric address, which cannot be made to point to another machine."""
    with contextlib.suppress(ValueError):
        ipaddress.ip_address(name.strip("[]"))
        return True
    return False


def _read_header(scope: Scope, name: bytes) -> str:
    """Return a header of a request; values of repeated headers are joined by commas."""
    return b",".join(value for key, value in scope["headers"] if key == name).decode("latin-1")


MESSAGES_PER_SECOND = 200  # largest rate of a page's messages
BURST_MESSAGES = 400  # number of messages that a page may send at once
MAX_EXCESS_MESSAGES = 2000  # number of messages over the rate after which a page is disconnected
MAX_READ_BYTES = 4 * MAX_BYTES  # a longer message closes the connection; one over `MAX_BYTES` gets an error
MAX_FILE_BYTES = 1 << 30  # size of a saved run that is dropped onto the page


class RateLimit:
    """Rate limit for messages by a token bucket: `BURST_MESSAGES` tokens, refilled at `MESSAGES_PER_SECOND`."""

    def __init__(self) -> None:
        self._tokens, self._refilled_s = float(BURST_MESSAGES), time.monotonic()
        self.n_refused = 0  # number of messages refused so far

    def allow(self) -> bool:
        """Take a token for one more message. Returns whether there was one."""
        now_s = time.monotonic()
        self._tokens = min(BURST_MESSAGES, self._tokens + (now_s - self._refilled_s) * MESSAGES_PER_SECOND)
        self._refilled_s = now_s
        if self._tokens < 1:
            self.n_refused += 1
            return False
        self._tokens -= 1
        return True


def build_application(hub: Hub, token: str, host: str, port: int) -> Guard:
    """Return the ASGI application: the page, its module, the socket and dropped runs, behind the guard."""

    def get_page(request: Request) -> Response:
        return HTMLResponse(read_page("index.html").replace("__TOKEN__", token))

    def get_module(request: Request) -> Response:
        return Response(read_static("mapview.js"), media_type="text/javascript")

    async def connect(socket: WebSocket) -> None:
        await socket.accept()
        client, outbox = hub.join()
        sending = asyncio.create_task(_send_messages(socket, outbox))
        try:
            await _receive_messages(socket, hub, client)
        finally:
            sending.cancel()
            hub.leave(client)

    routes = [Route("/", get_page), Route("/mapview.js", get_module), WebSocketRoute("/socket", connect)]
    routes.append(Route("/open", open_dropped_run, methods=["POST"]))
    return Guard(Starlette(routes=routes), token, host, port)


async def open_dropped_run(request: Request) -> Response:
    """Return the recording of a saved run, the request's body, or a text about its fault. The query has its name."""
    name = Path(request.query_params.get("name", "")).name
    if not name.endswith(".nc"):
        return PlainTextResponse("not a saved run (.nc)", status_code=415)
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as folder:
        path = Path(folder) / name
        with path.open("wb") as file:
            async for chunk in request.stream():
                if file.tell() + len(chunk) > MAX_FILE_BYTES:
                    return PlainTextResponse("too large for the page; start bayesmap app with it", status_code=413)
                file.write(chunk)
        # A process of its own reads the file and makes the recording, so a damaged file cannot stop the server.
        command = (sys.executable, "-m", "bayesmap.app.exports", str(path))
        pipe = asyncio.subprocess.PIPE
        process = await asyncio.create_subprocess_exec(*command, stdin=pipe, stdout=pipe, stderr=pipe)
        recording, errors = await process.communicate()
    if process.returncode == 0:
        return Response(recording, media_type="application/octet-stream")
    lines = errors.decode(errors="replace").replace(f"{folder}/", "").splitlines()
    return PlainTextResponse(lines[-1] if lines else "it cannot be read", status_code=422)


async def _send_messages(socket: WebSocket, outbox: Outbox) -> None:
    """Send the messages of an outbox until the page disconnects."""
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while True:
            data = await outbox.get()
            await (socket.send_bytes(data) if isinstance(data, bytes) else socket.send_text(data))


async def _receive_messages(socket: WebSocket, hub: Hub, client: int) -> None:
    """Pass the messages of a page to the hub until the page disconnects, or sends far too many."""
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


def open_listener(host: str, port: int) -> socket.socket:
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
    port = listener.getsockname()[1]
    token = secrets.token_urlsafe(24)
    hub = make_hub()
    name = f"[{host}]" if ":" in host else host
    name = {"0.0.0.0": "127.0.0.1", "[::]": "[::1]"}.get(name, name)  # a browser cannot open "all addresses"
    try:
        await hub.start()
        config = uvicorn.Config(
            build_application(hub, token, host, port), ws="websockets-sansio", ws_max_size=MAX_READ_BYTES,
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

    ``path`` is a saved run, or a log that `bayesmap.read_log` reads with ``log_options``. Without a path, ``document``
    is shown first. ``story`` is shown beside the map. Port 0 means any free port. Raises `BadInput` if the port is
    taken or the file cannot be shown. Raises `KeyboardInterrupt` if Ctrl-C comes before the server is ready.
    """
    with contextlib.closing(open_listener(host, port)) as listener:
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
