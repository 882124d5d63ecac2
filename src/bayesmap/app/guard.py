"""Who may speak to the server: those who know the token, by the name that was given to it, from its own page."""

from __future__ import annotations

import base64
import hashlib
import ipaddress
import secrets
import socket
from collections.abc import Iterable
from urllib.parse import parse_qs, urlsplit

from starlette.datastructures import MutableHeaders
from starlette.responses import HTMLResponse, PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

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

PAGE = f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>bayesmap</title>
<link rel="icon" href="data:,">
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
"""For the policy: this script and no other may run."""


class Guard:
    """Middleware: refuses requests without the token, under a strange Host, or from a strange Origin.

    The Host is checked so that no web page can reach the server by a name of its own that resolves to this machine.

    Args:
        app: what is guarded.
        token: must be in the query of every request.
        host: that the server listens on.
        port: the same.
    """

    def __init__(self, app: ASGIApp, token: str, host: str, port: int) -> None:
        self.app, self.token, self.host, self.port = app, token.encode(), host, port
        self.any_address = host in ("0.0.0.0", "::", "")
        names = ["127.0.0.1", "localhost", "[::1]", f"[{host}]" if ":" in host else host]
        if self.any_address:
            names.append(socket.gethostname().lower())
        self.names = frozenset(names)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Check, then pass on."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        why = self.objection(scope)
        if why is not None and scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": why})
            return

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                host = _header(scope, b"host")
                for name, value in HEADERS.items():
                    sockets, scripts = (f" ws://{host}", "'self'") if why is None else ("", f"'{SCRIPT_HASH}'")
                    headers[name] = value.format(sockets=sockets, scripts=scripts)
            await send(message)

        answer: ASGIApp = self.app
        if why is WRONG_TOKEN and scope.get("path") == "/":
            answer = HTMLResponse(PAGE, status_code=403)
        elif why is not None:
            answer = PlainTextResponse(f"{why}\n", status_code=403)
        await answer(scope, receive, with_headers if scope["type"] == "http" else send)

    def objection(self, scope: Scope) -> str | None:
        """Why a request is refused, or None."""
        if not self.knows(_header(scope, b"host")):
            return "this server does not go by that name"
        origin = _header(scope, b"origin")
        if origin:
            parts = urlsplit(origin)
            if parts.scheme != "http" or not self.knows(parts.netloc):
                return "requests from other pages are refused"
        given = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])
        if not secrets.compare_digest(given[-1].encode(), self.token):
            return WRONG_TOKEN
        return None

    def knows(self, host: str) -> bool:
        """Whether that is a name, with port, of this server."""
        name, _, port = host.lower().rpartition(":")
        known = name in self.names or (self.any_address and _is_address(name))
        return known and port == str(self.port)


def _is_address(name: str) -> bool:
    """An address in numbers cannot be made to point elsewhere, as a name can."""
    try:
        ipaddress.ip_address(name.strip("[]"))
    except ValueError:
        return False
    return True


def _header(scope: Scope, name: bytes) -> str:
    found: Iterable[bytes] = (value for key, value in scope["headers"] if key == name)
    return b",".join(found).decode("latin-1")
