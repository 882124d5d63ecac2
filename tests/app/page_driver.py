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

import numpy as np
import pytest
from PIL import Image

from bayesmap.app import server as app_server
from bayesmap.app.edits import tutorial_document
from bayesmap.app.hub import Hub
from bayesmap.app.protocol.wire import parse_document, unframe
from bayesmap.app.scene import simulated_scene
from bayesmap.app.shown.without_chains import Preview

BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
"""The first of them that there is draws the page; the first needs two thirds of the second's time for all tests."""
CHROMIUM = next(filter(None, map(shutil.which, BROWSERS)), None)
ARGUMENTS = (
    "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--no-first-run",
)  # fmt: skip
WAIT_SECONDS = 180.0
"""How long anything may take that a page does, on a machine that others use, too."""
DESKTOP = {"viewport": {"width": 1280, "height": 860}, "color_scheme": "light"}

NO_WALLS = base64.b64encode(bytes(56)).decode()
"""Of 21 x 21 cells."""

READ = """
() => {
  const s = bayesmap.snapshot();
  const bytes = (a) => { let t = ""; for (const v of a) t += String.fromCharCode(v); return btoa(t); };
  const plain = ([name, value]) => [name, value?.buffer ? Array.from(value, String) : value];
  const scan = s.scan && Object.fromEntries(Object.entries(s.scan).map(plain));
  const observed = bytes(s.reached.map((share) => Number(share >= 128)));
  return {...s, probability: bytes(s.probability), observed, walls: bytes(s.walls), scan};
}
"""


BRIEFLY = """
() => {
  const s = window.bayesmap?.snapshot();
  const { generation, connected, worker, running, seq, status, stage, painted, events } = s ?? {};
  const { trace, traced, ...shown } = painted ?? {};
  const { method, cells, sweeps } = s?.document ?? {};
  const known = { generation, connected, worker, running, seq, status, stage, shown, method, cells, sweeps, events };
  return JSON.stringify(known);
}
"""
"""What a wait in vain tells."""

NEXT_FRAME = "() => new Promise((done) => requestAnimationFrame(() => done()))"
"""What is known is painted in the next frame, and callbacks run in the order in which they were asked for."""

STILL = """
() => new Promise((done) => {
  let before = "", frames = 0;
  const look = () => {
    const { layers, events, seq } = bayesmap.snapshot();
    const now = JSON.stringify([layers, events.paints, seq]);
    frames = now === before && seq.sent === seq.confirmed ? frames + 1 : 0;
    before = now;
    if (frames === 12) done();
    else requestAnimationFrame(look);
  };
  look();
})
"""

END = """(beam) => {
  const { scan, document } = bayesmap.snapshot();
  const { resolution, origin } = document.grid;
  const angle = scan.pose[2] + scan.angles[beam];
  const half = (v, axis) => (v - origin[axis]) / resolution - 0.5;
  const end = [Math.cos, Math.sin].map((f, axis) => half(scan.pose[axis] + scan.ranges[beam] * f(angle), axis));
  return bayesmap.cellToClient(...end);
}"""
"""Where a beam of the scan on show ended, on the page."""

WRITTEN = """() => {
  // what is written on canvases, and where, from now on
  window.written = [];
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...rest) {
    const { a, e } = this.getTransform();
    const wide = this.measureText(text).width;
    const from = x - ({ right: wide, end: wide, center: wide / 2 }[this.textAlign] ?? 0);
    window.written.push({ text, left: a * from + e, right: a * (from + wide) + e, y, align: this.textAlign,
                          chart: Boolean(this.canvas.closest(".chart")), wide: this.canvas.width });
    return fillText.call(this, text, x, y, ...rest);
  };
}"""

WATCH = """
() => {
  window.seen = [];
  let last;
  const look = () => {
    const s = bayesmap.snapshot();
    const now = JSON.stringify(EXPRESSION);
    if (now !== last) window.seen.push(JSON.parse((last = now)));
    requestAnimationFrame(look);
  };
  look();
}
"""


class Served:
    """A server on a thread of this process, until `stop`.

    Attributes:
        address: what it announced.
    """

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
                with contextlib.closing(app_server.listen("127.0.0.1", port)) as found:
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
    """The tutorial's document as JSON, with changes."""
    return {**tutorial_document().to_json(), **changes}


def propagated(json_document):
    """The readings of a document, and what belief propagation says of them."""
    scene = simulated_scene(parse_document(json_document))
    preview = Preview(scene.near)
    while not preview.converged:
        preview.round()
    return scene, preview


def fragment(json_document):
    """What a share link puts after the address."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = deflate.compress(json.dumps(json_document).encode()) + deflate.flush()
    return "#m=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def snapshot(page):
    """What the page knows and shows; arrays indexed [x, y]."""
    found = page.evaluate(READ)
    shape = found["document"]["grid"]["shape"]
    for name in ("probability", "observed", "walls"):
        found[name] = np.frombuffer(base64.b64decode(found[name]), dtype=np.uint8).reshape(shape).astype(int)
    for name, values in (found["scan"] or {}).items():
        if isinstance(values, list):
            numbers = [value.replace("Infinity", "inf") if isinstance(value, str) else value for value in values]
            found["scan"][name] = np.array(numbers, dtype=float)
    return found


def until(page, condition, argument=None):
    """Wait until a JavaScript condition on the snapshot `s` holds, and its picture and its words are on the screen.

    The page's own policy forbids Playwright's way.
    """
    wrapped = f"(argument) => {{ const s = window.bayesmap?.snapshot(); return Boolean(s && ({condition})); }}"
    deadline = time.monotonic() + WAIT_SECONDS
    while not page.evaluate(wrapped, argument):
        assert time.monotonic() < deadline, f"never: {condition}; the page knows {page.evaluate(BRIEFLY)}"
        page.wait_for_timeout(15)
    page.evaluate(NEXT_FRAME)


def still(page):
    """Wait until all actions are confirmed and nothing has been painted for some frames."""
    page.evaluate(STILL)


def watch(page, expression):
    """From now on, `window.seen` is all values that an expression of the snapshot `s` takes from frame to frame."""
    page.evaluate(WATCH.replace("EXPRESSION", expression))


def listen(page, heard):
    """Add the header of every message that the page is sent to a list; before it opens its address."""

    def hear(payload):
        heard.append(unframe(payload)[0] if isinstance(payload, bytes) else json.loads(payload))

    page.on("websocket", lambda socket: socket.on("framereceived", hear))


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
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    found = axe.run(page).response["violations"]
    return [(rule["id"], rule["nodes"][0]["html"]) for rule in found if rule["impact"] in ("serious", "critical")]


def centre(page, x, y):
    """Where a cell is on the page, in CSS pixels."""
    point = page.evaluate("([x, y]) => bayesmap.cellToClient(x, y)", [x, y])
    return point["x"], point["y"]


def colour_at(page, x, y, offset=(0.0, 0.0)):
    """Median colour of the few pixels about a cell's centre, or off it by a fraction of a cell; 0 to 255."""
    left, top = centre(page, x, y)
    scale = page.evaluate("bayesmap.snapshot().transform.scale")
    left, top = left + offset[0] * scale, top - offset[1] * scale
    clip = {"x": left - 3, "y": top - 3, "width": 6, "height": 6}
    shot = Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB")
    return np.median(np.asarray(shot, dtype=float).reshape(-1, 3), axis=0)


def brightness_at(page, x, y, offset=(0.0, 0.0)):
    """0 is black, 255 white."""
    return float(colour_at(page, x, y, offset).mean())
