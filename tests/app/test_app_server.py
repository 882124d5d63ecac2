"""The server as a program on the network meets it, its guard, and the supervisor of its worker."""

import asyncio
import contextlib
import http.client
import json
import os
import signal
import socket
import threading
import time
from dataclasses import replace
from urllib.parse import urlsplit

import pytest
from cli.shell import PATIENCE_S, refusal_of, start
from page_driver import served
from page_socket import Page, children, ended, serving, socket_address
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.tasks import Alive, Infer, Ready, Report, ShowScan
from bayesmap.app.server import Guard
from bayesmap.app.worker import Reporter, Supervisor, drop_outdated

SILENCE_S = 4.0


@pytest.fixture(scope="module")
def address():
    with served() as (found, _):
        yield found


@pytest.fixture
def page(address):
    with Page(address) as found:
        found.send("view", layer="mean")
        found.send("hello", document=tutorial_document().to_json())
        found.confirmed()
        yield found


def get(address, path=None, body=None, **headers):
    parts = urlsplit(address)
    connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=PATIENCE_S)
    with contextlib.closing(connection):
        path = f"{parts.path}?{parts.query}" if path is None else path
        connection.request("POST" if body else "GET", path, body, headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode(), answer.headers


def test_only_saved_runs_of_those_who_have_the_token_are_read(address):
    token = urlsplit(address).query
    for query, expected in ((token, 415), (f"{token}&name=../x.log", 415), ("name=x.nc", 403)):
        assert get(address, f"/open?{query}", body=b"x")[0] == expected


def test_the_page_and_its_module_are_served_with_a_policy(address):
    token = urlsplit(address).query
    status, text, headers = get(address)
    assert status == 200
    assert f"mapview.js?{token}" in text
    assert "__TOKEN__" not in text
    policy = headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "'unsafe-eval'" not in policy
    assert headers["Referrer-Policy"] == "no-referrer"
    status, text, headers = get(address, f"/mapview.js?{token}")
    assert status == 200
    assert headers["Content-Type"].startswith("text/javascript")
    assert " as mount," in text
    assert get(address, f"/elsewhere?{token}")[0] == 404


def test_a_request_without_the_token_or_from_another_host_or_origin_gets_nothing(address):
    for path in ("/", "/mapview.js", "/?token=guess"):
        status, text, _ = get(address, path)
        assert status == 403
        assert "token" in text
    assert get(address, Host=f"localhost:{urlsplit(address).port}")[0] == 200
    assert get(address, Host="evil.example")[0] == 403
    right = socket_address(address)
    for target, options in ((right + "x", {}), (right.split("?")[0], {}), (right, {"origin": "null"})):
        with pytest.raises(InvalidStatus) as refused, connect(target, **options):
            pass
        assert refused.value.response.status_code == 403
    with Page(address, origin=address.split("/?")[0]) as page:
        assert page.confirmed()["generation"] > 0


async def inner(scope, receive, send):
    """Answer everything, as the guarded application."""
    await receive()
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
    else:
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b"in"})


def guarded(query="token=secret", *, host="127.0.0.1", port=8000, name="127.0.0.1:8000", kind="http", origin=None):
    """Return the messages with which a guarded application answers."""
    headers = [(b"host", name.encode())] + ([(b"origin", origin.encode())] if origin else [])
    scope = {"type": kind, "method": "GET", "path": "/", "query_string": query.encode(), "headers": headers}
    sent = []

    async def receive():
        return {"type": f"{kind}.connect" if kind == "websocket" else "http.request"}

    async def send(message):
        sent.append(message)

    asyncio.run(Guard(inner, "secret", host, port)(scope, receive, send))
    return sent


OWN, ALL, OUTSIDE = "127.0.0.1", "0.0.0.0", "192.168.1.5"


@pytest.mark.parametrize(("options", "status"), [
    *[({"name": name}, 200) for name in ("127.0.0.1:8000", "localhost:8000", "LOCALHOST:8000")],
    *[({"name": name}, 403) for name in ("192.168.1.5:8000", "evil.example:8000", OWN, "127.0.0.1:80", "", "[::1")],
    *[({"host": host, "name": "192.168.1.5:8000"}, 200) for host in (OUTSIDE, ALL)],
    ({"host": "Robot", "name": "robot:8000"}, 200), ({"name": OWN, "port": 80, "origin": f"http://{OWN}"}, 200),
    ({"host": ALL, "name": "evil.example:8000"}, 403), ({"host": "::1", "name": "[::1]:8000"}, 200),
    *[({"query": query}, 403) for query in ("token=secre", "token=secret&token=x", "token=", "", "token=%C3%A9")],
    ({"origin": "http://127.0.0.1:8000"}, 200),
    *[({"origin": it}, 403) for it in ("http://127.0.0.1:8001", "https://127.0.0.1:8000", "null", "http://evil")],
])  # fmt: skip
def test_the_guard_knows_names_tokens_and_origins_before_a_socket_is_opened(options, status):
    (first, *_) = guarded(**options)
    assert first["status"] == status
    if status == 403:
        names = {name.decode() for name, _ in first["headers"]}
        assert {"content-security-policy", "x-content-type-options", "cache-control"} <= names
    (message,) = guarded(kind="websocket", **options)
    assert message["type"] == ("websocket.accept" if status == 200 else "websocket.close")
    assert message.get("code") == (None if status == 200 else 1008)


def test_a_worker_does_the_last_waiting_job_and_those_it_goes_on_from():
    document = tutorial_document()
    first, other = Infer(1, document, "live"), Infer(2, replace(document, seed=1), "live")
    runs = [Infer(n, document, "run") for n in (3, 4)]
    show = ShowScan(0)
    assert drop_outdated([other, show, first, *runs]) == [show, first, *runs]
    assert drop_outdated([first, *runs, other]) == [other]
    assert drop_outdated([first, other, runs[0]]) == [runs[0]]


@pytest.mark.parametrize("data", [
    "", "[]", '{"type": "boom", "seq": 5}',
    b"\xff\0", "[" * 50_000, '{"type": "hello", "seq": 5, "document": {"version": 1}}',
    "x" * (1 << 20) + "x",
], ids=range(7))  # fmt: skip
def test_malformed_messages_are_answered_by_an_error(page, data):
    page.socket.send(data)
    header, _ = page.until("error")
    assert header["text"]
    if '"seq": 5' in str(data[:100]):
        assert header["seq"] == 5
    page.send("set", patch={"prior": 0.25})
    assert page.confirmed()["document"]["prior"] == 0.25


def test_a_message_out_of_all_bounds_ends_the_connection_and_not_the_server(address):
    with Page(address) as page:
        with contextlib.suppress(ConnectionClosed):  # it may be refused while it is still being sent
            page.socket.send("x" * (5 << 20))
        with pytest.raises(ConnectionClosed):  # by 1009, which the reset of a half-sent message can overtake
            page.closed()
    with Page(address) as page:
        page.confirmed()


def test_a_flood_is_stopped_and_the_server_lives(address):
    # All that comes is read at once, and nothing is sent after the end: a reset would take the last words away unread.
    with Page(address, max_queue=None) as page:
        with contextlib.suppress(Exception):
            for _ in range(400):  # until it is closed: a loaded machine sends slowly
                for _ in range(100):
                    page.socket.send('{"type": "undo", "seq": 1}')
                time.sleep(0.01)
                if page.socket.protocol.close_code is not None:
                    break
        errors, code = [], None
        try:
            while True:
                header, _ = page.read()
                errors += [header["text"]] if header["type"] == "error" else []
        except Exception as closed:
            code = getattr(getattr(closed, "rcvd", None), "code", None)
        assert "too many messages" in errors
        assert code == 1008
    with Page(address) as page:
        page.confirmed()


def test_the_command_says_its_address_as_json_and_ends_with_ctrl_c_as_does_its_worker(tmp_path):
    shown = {**tutorial_document().to_json(), "prior": 0.125}
    (tmp_path / "document.json").write_text(json.dumps(shown))
    process = start("app", "--no-browser", "--json", "-q", tmp_path / "document.json")
    said = ""
    while not said.endswith("}\n") and (line := process.stdout.readline()):
        said += line
    with Page(json.loads(said)["url"]) as page:
        assert page.confirmed()["document"] == shown
        (worker,) = children(process.pid)
        process.send_signal(signal.SIGINT)
        with pytest.raises(ConnectionClosed):
            page.closed()
    out, errors = process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, out, errors) == (0, "", "")
    ended(worker)


def test_a_killed_server_takes_its_worker_along():
    with serving() as (process, _):
        (worker,) = children(process.pid)
        process.kill()
        process.wait(PATIENCE_S)
        ended(worker)


@pytest.mark.parametrize(("name", "content"), [
    ("run.nc", None), ("run.nc", "nonsense"), ("run.nc", ""), ("document.json", "{"),
    ("document.json", '{"version": 7}'),
    ("document.json", '{"version": 1, "source": {"kind": "log", "name": "a", "scans": 1}}'),
], ids=range(6))  # fmt: skip
def test_a_file_that_cannot_be_shown_and_a_port_that_is_taken_are_bad_input(name, content, tmp_path):
    if content is not None:
        (tmp_path / name).write_text(content)
    reason = "no such file" if content is None else {"run.nc": "saved run"}.get(name, name)
    assert reason in refusal_of("app", "--no-browser", tmp_path / name)
    with socket.create_server(("127.0.0.1", 0)) as taken:
        assert "--port" in refusal_of("app", "--no-browser", "--port", taken.getsockname()[1])


@pytest.mark.parametrize("what", [signal.SIGSTOP, signal.SIGKILL])
def test_a_worker_that_is_stopped_or_killed_is_replaced(what):
    ready, lost = threading.Semaphore(0), threading.Event()
    supervisor = Supervisor(
        lambda report: ready.release() if isinstance(report.message, Ready) else None, lost.set, silence_s=SILENCE_S
    )
    supervisor.start()
    try:
        assert ready.acquire(timeout=PATIENCE_S)
        before = supervisor.pid
        if what == signal.SIGSTOP:
            assert not lost.wait(SILENCE_S + 1.0)  # one that has nothing to do is not taken for dead
        os.kill(before, what)
        assert lost.wait(PATIENCE_S)
        assert ready.acquire(timeout=PATIENCE_S)
        assert supervisor.pid != before
    finally:
        supervisor.stop()


def test_reports_of_several_threads_do_not_mix():
    """A pipe takes a report in pieces: another thread's in between would make both unreadable."""

    class Pipe:
        sending, mixed, closed = 0, False, False

        def send(self, report):
            if self.closed:
                raise BrokenPipeError
            self.sending += 1
            time.sleep(0.002)  # another thread goes on here
            self.mixed = self.mixed or self.sending > 1
            self.sending -= 1

    pipe = Pipe()
    report = Reporter(pipe)
    threads = [threading.Thread(target=lambda: [report(Report(Alive())) for _ in range(20)]) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    pipe.closed = True  # which ends the reporter's own thread
    assert not pipe.mixed
