"""Which names are those of the server, on loopback and on all addresses."""

import asyncio

import pytest

from bayesmap.app.server import Guard


async def inner(scope, receive, send):
    """What is guarded: answers everything."""
    await receive()
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
    else:
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b"in"})


def answer(query="token=secret", *, host="127.0.0.1", name="127.0.0.1:8000", kind="http", origin=None):
    """The messages with which a guarded application answers."""
    headers = [(b"host", name.encode())] + ([(b"origin", origin.encode())] if origin else [])
    scope = {"type": kind, "method": "GET", "path": "/", "query_string": query.encode(), "headers": headers}
    sent = []

    async def receive():
        return {"type": f"{kind}.connect" if kind == "websocket" else "http.request"}

    async def send(message):
        sent.append(message)

    asyncio.run(Guard(inner, "secret", host, 8000)(scope, receive, send))
    return sent


def status(*arguments, **options):
    return answer(*arguments, **options)[0]["status"]


@pytest.mark.parametrize(
    ("host", "name", "expected"),
    [
        ("127.0.0.1", "127.0.0.1:8000", 200),
        ("127.0.0.1", "localhost:8000", 200),
        ("127.0.0.1", "LOCALHOST:8000", 200),
        ("127.0.0.1", "192.168.1.5:8000", 403),
        ("127.0.0.1", "evil.example:8000", 403),
        ("127.0.0.1", "127.0.0.1", 403),
        ("127.0.0.1", "127.0.0.1:80", 403),
        ("127.0.0.1", "", 403),
        ("192.168.1.5", "192.168.1.5:8000", 200),
        ("0.0.0.0", "192.168.1.5:8000", 200),
        ("0.0.0.0", "evil.example:8000", 403),
        ("::1", "[::1]:8000", 200),
    ],
)
def test_a_server_knows_its_names(host, name, expected):
    assert status(host=host, name=name) == expected


@pytest.mark.parametrize(
    ("query", "expected"),
    [("token=secret", 200), ("token=secre", 403), ("token=secret&token=x", 403), ("", 403), ("token=%C3%A9", 403)],
)
def test_the_token_must_be_the_whole_token(query, expected):
    assert status(query) == expected


def test_an_origin_must_be_the_server_s_own():
    assert status(origin="http://127.0.0.1:8000") == 200
    assert status(origin="http://127.0.0.1:8001") == 403
    assert status(origin="null") == 403


def test_refusals_have_the_policy_too():
    names = {name.decode() for name, _ in answer("")[0]["headers"]}
    assert {"content-security-policy", "x-content-type-options", "cache-control"} <= names


def test_a_socket_is_refused_before_it_is_opened():
    assert answer(kind="websocket") == [{"type": "websocket.accept"}]
    for options in ({"query": ""}, {"name": "evil.example:8000"}, {"origin": "http://evil.example"}):
        (message,) = answer(kind="websocket", **options)
        assert (message["type"], message["code"]) == ("websocket.close", 1008)
