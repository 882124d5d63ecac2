"""Drives the page of a real server in a real browser, and reads back what it shows."""

import asyncio
import base64
import contextlib
import io
import json
import shutil
import threading
import time
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from bayesmap.app import server as app_server
from bayesmap.app.edits import tutorial_document
from bayesmap.app.hub import Hub
from bayesmap.app.protocol.wire import parse_document
from bayesmap.app.scene import simulated_scene
from bayesmap.app.shown.without_chains import Preview

BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
"""The first of them that there is draws the page; the first needs two thirds of the second's time for all tests."""
CHROMIUM = next(filter(None, map(shutil.which, BROWSERS)), None)
ARGUMENTS = (
    "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--no-first-run",
)  # fmt: skip
WAIT_SECONDS = 180.0  # for anything that a page does, on a machine that others use, too
PROBES = Path(__file__).with_name("probes.js")
DESKTOP = {"viewport": {"width": 1280, "height": 860}, "color_scheme": "light"}

NO_WALLS = base64.b64encode(bytes(56)).decode()  # of a map of 21 x 21 cells


def new_context(browser, wait_s=WAIT_SECONDS, **options):
    context = browser.new_context(**{**DESKTOP, **options})
    context.add_init_script(path=PROBES)
    context.set_default_timeout(1000 * wait_s)
    return context


class Served:
    """A server on a thread of this process, until `stop`; its `address` is what it announced."""

    def __init__(self, file=None, port=0, started=None):
        self._servers, self._hubs, self._trouble, ready = [], [], None, threading.Event()

        class Server(app_server._Server):
            def __init__(own, *arguments):
                super().__init__(*arguments)
                self._servers.append(own)

        def hub():
            self._hubs.append(Hub(started or tutorial_document(), file if file is None else str(file)))
            return self._hubs[0]

        def announce(address):
            self.address = address
            ready.set()

        def run():
            try:
                with contextlib.closing(app_server.open_listener("127.0.0.1", port)) as found:
                    asyncio.run(app_server._serve(hub, found, "127.0.0.1", announce, Server))
            except Exception as trouble:
                self._trouble = trouble

        self._thread = threading.Thread(target=run, name="bayesmap_served")
        self._thread.start()
        deadline = time.monotonic() + WAIT_SECONDS
        while not ready.wait(0.2):
            if not self._thread.is_alive():
                raise AssertionError("the server ended before it answered") from self._trouble
            assert time.monotonic() < deadline, "the server did not answer"

    @property
    def worker(self):
        """The number of the process that computes."""
        return self._hubs[0]._supervisor.pid

    def stop(self):
        """End it as one whose machine is switched off: connections end, and nobody is told why."""
        for server in self._servers:
            server.force_exit = server.should_exit = True
        self._thread.join()
        assert self._trouble is None, self._trouble


@contextlib.contextmanager
def served(file=None, port=0, started=None):
    """The address of a server of a file, of a document, or of the tutorial's map, and the server."""
    server = Served(file, port, started)
    try:
        yield server.address, server
    finally:
        server.stop()


DONE = "s.painted.sweeps >= s.document.sweeps || s.painted.approximate && !/auto|gibbs|block/.test(s.document.method)"


def document(**changes):
    return {**tutorial_document().to_json(), **changes}


def propagated(json_document):
    scene = simulated_scene(parse_document(json_document))
    preview = Preview(scene.near_problem)
    while not preview.converged:
        preview.round()
    return scene, preview


def fragment(json_document):
    """Return the part of a share link after the address."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = deflate.compress(json.dumps(json_document).encode()) + deflate.flush()
    return "#m=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def snapshot(page):
    """Return what the page knows and shows; arrays indexed [x, y]."""
    shown = page.evaluate("probes.read()")
    shape = shown["document"]["grid"]["shape"]
    for name in ("probability", "observed", "walls"):
        shown[name] = np.frombuffer(base64.b64decode(shown[name]), dtype=np.uint8).reshape(shape).astype(int)
    for name, values in (shown["scan"] or {}).items():
        if isinstance(values, list):
            numbers = [value.replace("Infinity", "inf") if isinstance(value, str) else value for value in values]
            shown["scan"][name] = np.array(numbers, dtype=float)
    return shown


def until(page, condition, argument=None):
    """Wait until a condition on the snapshot `s` holds and is painted; the page's policy forbids Playwright's way."""
    wrapped = f"(argument) => {{ const s = window.bayesmap?.snapshot(); return Boolean(s && ({condition})); }}"
    deadline = time.monotonic() + WAIT_SECONDS
    while not page.evaluate(wrapped, argument):
        assert time.monotonic() < deadline, f"never: {condition}; the page knows {page.evaluate('probes.brief()')}"
        page.wait_for_timeout(15)
    page.evaluate("probes.nextFrame()")


def still(page):
    """Wait until all actions are confirmed and nothing has been painted for some frames."""
    page.evaluate("probes.still()")


def watch(page, expression):
    """From now on, `window.seen` is all values that an expression of the snapshot `s` takes from frame to frame."""
    page.evaluate(f"probes.watch((s) => ({expression}))")


OWN = ("http://127.0.0.1:", "ws://127.0.0.1:", "blob:", "data:", "file:", "about:")


def watch_for_trouble(page, troubles):
    """Add the errors of a page, and what it asks of other machines, to a list."""

    def heard(message):  # that a server has ended before its page is no error
        if message.type == "error" and "ERR_CONNECTION_REFUSED" not in message.text:
            troubles.append(message.text)

    page.on("console", heard)
    page.on("pageerror", lambda error: troubles.append(str(error)))
    for kind in ("request", "websocket"):
        page.on(kind, lambda asked: None if asked.url.startswith(OWN) else troubles.append(asked.url))


def settled(page):
    """Wait until all actions are confirmed and the picture is that of the newest generation and not preliminary."""
    until(page, f"s.seq.confirmed === s.seq.sent && s.painted?.generation === s.generation && !s.running && ({DONE})")
    return snapshot(page)


def serious(page):
    """The serious violations that axe finds on a page: rules, and an element of each."""
    violations = pytest.importorskip("axe_playwright_python.sync_playwright").Axe().run(page).response["violations"]
    return [(rule["id"], rule["nodes"][0]["html"]) for rule in violations if rule["impact"] in ("serious", "critical")]


def centre(page, x, y):
    """Return the place of a cell's centre on the page, in CSS pixels."""
    point = page.evaluate("([x, y]) => bayesmap.cellToClient(x, y)", [x, y])
    return point["x"], point["y"]


def colour_at(page, x, y, offset=(0.0, 0.0)):
    """Return the median colour of the few pixels about a cell's centre, or off it by a fraction of a cell; 0 to 255."""
    left, top = centre(page, x, y)
    scale = page.evaluate("bayesmap.snapshot().transform.scale")
    left, top = left + offset[0] * scale, top - offset[1] * scale
    clip = {"x": left - 3, "y": top - 3, "width": 6, "height": 6}
    shot = Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB")
    return np.median(np.asarray(shot, dtype=float).reshape(-1, 3), axis=0)


def brightness_at(page, x, y, offset=(0.0, 0.0)):
    return float(colour_at(page, x, y, offset).mean())
