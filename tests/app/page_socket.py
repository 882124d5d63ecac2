"""A page without a browser: the socket of a server in a process of its own."""

import contextlib
import json
import signal
import subprocess
import time
from pathlib import Path

from cli.shell import PATIENCE_S, start
from websockets.sync.client import connect

from bayesmap.app.protocol.wire import decode_frame


@contextlib.contextmanager
def serving(*arguments):
    """Start the command; gives its process and the address that it printed, and ends it with Ctrl-C."""
    process = start("app", "--no-browser", *arguments)
    try:
        address = process.stdout.readline().strip()
        assert address.startswith("http://"), process.communicate(timeout=PATIENCE_S)
        yield process, address
    finally:
        with contextlib.suppress(ProcessLookupError):
            process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=PATIENCE_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()


def socket_address(address):
    return address.replace("http", "ws", 1).replace("/?", "/socket?")


class Talk:
    """Sends numbered messages and reads until something comes; how, a subclass says."""

    seq = 0

    def send(self, kind, **fields):
        self.seq += 1
        self.deliver({"type": kind, "seq": self.seq, **fields})

    def until(self, kind, like=lambda header: True):
        """Return header and buffers of the next message of a kind for which a condition holds."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            header, buffers = self.read()
            if header["type"] == kind and like(header):
                return header, buffers
        raise AssertionError(f"no {kind} came within {PATIENCE_S:.0f} s")

    def confirmed(self):
        return self.until("state", lambda header: header["seq"] >= self.seq)[0]


class Page(Talk):
    def __init__(self, address, **options):
        self.connection = connect(socket_address(address), compression=None, max_size=None, **options)

    def __enter__(self):
        self.socket = self.connection.__enter__()
        self.send("hello")
        return self

    def __exit__(self, *_):
        self.connection.__exit__(None, None, None)

    def deliver(self, message):
        self.socket.send(json.dumps(message))

    def read(self):
        data = self.socket.recv(timeout=PATIENCE_S)
        return decode_frame(data) if isinstance(data, bytes) else (json.loads(data), {})

    def closed(self):
        """Read until the server closes, which is an exception."""
        while True:
            self.read()


def children(pid):
    return [int(child) for path in Path(f"/proc/{pid}/task").glob("*/children") for child in path.read_text().split()]


def ended(pid):
    """Wait until a process has ended, though perhaps nobody has asked for its exit status yet."""
    deadline = time.monotonic() + PATIENCE_S
    status = Path(f"/proc/{pid}/status")
    while status.exists() and "State:\tZ" not in status.read_text():
        assert time.monotonic() < deadline, "the worker outlived its server"
        time.sleep(0.05)
