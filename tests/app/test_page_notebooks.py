"""The widget in marimo and in JupyterLab: it infers, it is drawn on, it shows a run, and it asks nobody else."""

import base64
import contextlib
import queue
import time
from pathlib import Path

import notebook_driver
import numpy as np
import page_driver
import pytest
from page_driver import brightness_at, document, settled, snapshot, until
from page_hands import act, choose, press_and_drag, undo
from page_socket import children, ended

import bayesmap as bm

pytest.importorskip("anywidget")

HOMES = {
    "marimo run": notebook_driver.marimo_app,
    "marimo edit": notebook_driver.marimo_editor,
    "jupyterlab": notebook_driver.jupyterlab,
}
LIVE = "import bayesmap as bm\nbm.MapWidget(seed=3)"


@pytest.fixture
def show(browser, tmp_path, monkeypatch):
    """Runs a cell in a notebook and waits for the widget's picture; no errors, and no request leaves the machine."""
    monkeypatch.setattr(page_driver, "WAIT_SECONDS", notebook_driver.CELL_SECONDS)
    troubles = []
    with contextlib.ExitStack() as stack:
        context = stack.enter_context(contextlib.closing(browser.new_context(**page_driver.DESKTOP)))
        context.set_default_timeout(1000 * notebook_driver.CELL_SECONDS)

        def shown(home, source):
            page = context.new_page()
            page_driver.watch_for_trouble(page, troubles)
            canvas, page.server = stack.enter_context(HOMES[home](page, tmp_path, source))
            stack.callback(page.close)  # before its server ends
            canvas.wait_for(timeout=notebook_driver.CELL_SECONDS * 1000)
            canvas.scroll_into_view_if_needed()
            until(page, "s.painted?.generation === s.generation && s.seq.confirmed === s.seq.sent")
            return page

        yield shown
    assert troubles == []


@pytest.mark.full
@pytest.mark.parametrize("home", HOMES)
def test_the_live_widget_infers_and_walls_are_drawn_on_it(show, home):
    page = show(home, LIVE)
    settled(page)  # panels have found their places
    for label in ("True walls", "Rays", "Readings"):  # so that a cell's pixels are its probability
        page.get_by_role("checkbox", name=label).uncheck()
    before = settled(page)
    assert before["document"]["seed"] == 3
    assert not before["walls"][6:10, 12].any()
    assert brightness_at(page, 8, 12) > 200

    choose(page, "Draw")
    act(page, lambda: press_and_drag(page, [(6, 12), (9, 12)]))
    after = settled(page)
    drawn = after["walls"] != before["walls"]
    assert np.argwhere(drawn).tolist() == [[x, 12] for x in range(6, 10)]
    assert (after["probability"][6:10, 12] > 200).sum() >= 3
    assert brightness_at(page, 8, 12) < 100
    undo(page)
    assert np.array_equal(settled(page)["walls"], before["walls"])
    assert not page.get_by_role("button", name="Share").is_visible()  # a notebook's address holds no map


@pytest.mark.full
def test_the_worker_ends_when_the_visitor_of_an_app_has_gone(show):
    page = show("marimo run", LIVE)
    server = page.server
    commands = {pid: Path(f"/proc/{pid}/cmdline").read_bytes() for pid in children(server.pid)}
    (worker,) = (pid for pid, command in commands.items() if b"bayesmap.app.worker" in command)
    page.close()
    ended(worker)
    assert server.poll() is None


MOUNT = """async () => {
  // the widget's view, as anywidget makes one, with a model whose messages the test carries
  const { default: widget } = await import(document.querySelector("script[type=module]").src);
  const listeners = [];
  window.model = {
    sent: [],
    on: (event, listener) => listeners.push(listener),
    off: () => {},
    send: (message) => model.sent.push(message),
    deliver: (message, packed) => {
      const views = packed.map((text) => new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer));
      for (const listener of listeners) listener(message, views);
    },
  };
  const element = document.body.appendChild(document.createElement("div"));
  window.close_it = widget.render({ model, el: element });
}"""


def test_the_widget_s_view_is_drawn_on_and_its_map_inferred(open_page, monkeypatch):
    """Without a notebook: what its kernel does between the widget and its view is done here."""
    page, widget, said = open_page(document()), bm.MapWidget(seed=3), queue.Queue()
    monkeypatch.setattr(widget, "send", lambda content, buffers=None: said.put((content, buffers or [])))

    def carried_until(condition):
        deadline = time.monotonic() + page_driver.WAIT_SECONDS
        while not page.evaluate(f"() => {{ const s = bayesmap.snapshot(); return Boolean({condition}); }}"):
            assert time.monotonic() < deadline, f"never: {condition}"
            for message in page.evaluate("model.sent.splice(0)"):
                widget._handle_custom_msg(message, [])
            page.wait_for_timeout(40)
            while not said.empty():
                content, buffers = said.get()
                packed = [base64.b64encode(data).decode() for data in buffers]
                page.evaluate("([content, packed]) => model.deliver(content, packed)", [content, packed])

    try:
        page.evaluate(MOUNT)
        carried_until("s.document?.seed === 3 && s.painted?.sweeps >= 100")
        shown = snapshot(page)
        seen, walls = shown["observed"] == 1, shown["walls"] == 1
        assert (shown["probability"][seen & walls] / 255).mean() > 0.7
        assert (shown["probability"][seen & ~walls] / 255).mean() < 0.05
        assert page.get_by_role("button", name="Share").count() == 1  # of the page around it
        page.locator("canvas[role=application]").last.scroll_into_view_if_needed()
        page.get_by_role("radio", name="Draw", exact=True).last.check()
        press_and_drag(page, [(6, 12), (9, 12)])
        carried_until("s.seq.sent === s.seq.confirmed && s.painted.generation === s.generation && s.walls[6 * 21 + 12]")
        assert widget.document == snapshot(page)["document"]
        page.evaluate("close_it()")
        assert page.locator("canvas[role=application]").count() == 1
    finally:
        widget.close()
