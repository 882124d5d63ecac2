"""The widget in marimo and in JupyterLab: it infers, it is drawn on, it shows a run, and it asks nobody else."""

import base64
import contextlib
import importlib.util
import json
import os
import queue
import re
import socket
import subprocess
import sys
import textwrap
import time
import urllib.error
import urllib.request
from functools import partial
from pathlib import Path

import numpy as np
import page_driver
import pytest
from page_driver import brightness_at, document, settled, snapshot, until
from page_hands import act, choose, press_and_drag, undo
from page_socket import children, ended

import bayesmap as bm

CELL_SECONDS = 300.0  # for a kernel to start, to import bayesmap, and to show the widget

TOKEN = "of-the-test"


@contextlib.contextmanager
def jupyterlab(page, folder, source):
    """Open a notebook of one cell in JupyterLab, and run the cell by keys."""
    needed("jupyterlab")
    notebooks = folder / "notebooks"
    notebooks.mkdir()
    cell = {"cell_type": "code", "id": "a", "metadata": {}, "source": source, "outputs": [], "execution_count": None}
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    notebook = {"cells": [cell], "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}
    (notebooks / "map.ipynb").write_text(json.dumps(notebook))
    port = free_port()
    options = {
        "ServerApp.ip": "127.0.0.1", "ServerApp.port": port, "ServerApp.root_dir": notebooks,
        "IdentityProvider.token": TOKEN, "LabApp.news_url": None,
        "LabApp.check_for_updates_class": "jupyterlab.NeverCheckForUpdate", "LabApp.extension_manager": "readonly",
    }  # fmt: skip
    command = ["jupyterlab", "--no-browser", "--allow-root", *(f"--{key}={value}" for key, value in options.items())]
    with listening(command, folder, f"http://127.0.0.1:{port}/api") as process:
        page.goto(f"http://127.0.0.1:{port}/lab/tree/map.ipynb?token={TOKEN}")
        deadline = time.monotonic() + CELL_SECONDS
        canvas = page.locator(".jp-OutputArea-output canvas[role=application]")
        while not canvas.count():
            # Before the kernel is connected, JupyterLab drops a cell that is run, at times after it was marked so.
            if not re.search(r"[*\d]", page.locator(".jp-InputPrompt").first.inner_text()):
                run_by_keys(page, ".jp-Notebook .cm-content", "Shift+Enter")
            page.wait_for_timeout(1000)
            assert time.monotonic() < deadline, "JupyterLab never ran the cell"
        yield canvas, process


@contextlib.contextmanager
def marimo(verb, page, folder, source):
    """Open a notebook of one cell in marimo: served as an app, which runs the cell, or in the editor, by keys."""
    needed("marimo")
    path, port = folder / "map.py", free_port()
    cell = textwrap.indent(source, "    ")
    path.write_text(
        f"import marimo\n\napp = marimo.App()\n\n\n@app.cell\ndef _():\n{cell}\n    return\n\n\n"
        'if __name__ == "__main__":\n    app.run()\n'
    )
    options = ["--headless", "--no-token", "--host", "127.0.0.1", "--port", str(port)]
    options += ["--session-ttl", "1"] if verb == "run" else []
    address = f"http://127.0.0.1:{port}/"
    with listening(["marimo", "-y", verb, *options, str(path)], folder, address + "health") as process:
        page.goto(address)
        if verb == "edit":
            run_by_keys(page, ".cm-content", "Control+Enter")
        output = ".output" if verb == "run" else ".output-area"
        yield page.locator(f"{output} canvas[role=application]"), process


@contextlib.contextmanager
def listening(module_and_arguments, folder, address):
    """A server in a process of its own, with settings of its own, from when it answers."""
    names = (
        "IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "JUPYTERLAB_SETTINGS_DIR",
        "JUPYTERLAB_WORKSPACES_DIR", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME",
    )  # fmt: skip
    own = {name: str(folder / name.lower()) for name in names}
    environment = {**os.environ, **own, "MARIMO_SKIP_UPDATE_CHECK": "1"}
    command = [sys.executable, "-m", *module_and_arguments]
    with (
        open(folder / "server.txt", "w+") as said,
        subprocess.Popen(command, env=environment, cwd=folder, stdout=said, stderr=said) as process,
    ):
        try:
            deadline = time.monotonic() + CELL_SECONDS
            while not answers(address):
                assert process.poll() is None, (folder / "server.txt").read_text()
                assert time.monotonic() < deadline, (folder / "server.txt").read_text()
                time.sleep(0.1)
            yield process
        finally:
            process.terminate()
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                process.kill()


def answers(address):
    """Tell whether a server answers; a refusal is an answer."""
    try:
        with urllib.request.urlopen(address, timeout=5):
            return True
    except urllib.error.HTTPError as refused:
        refused.close()
        return True
    except OSError:
        return False


def run_by_keys(page, code, keys):
    editor = page.locator(code).first
    editor.click(timeout=CELL_SECONDS * 1000)
    editor.press(keys)


def needed(package):
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed")


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as listener:
        return listener.getsockname()[1]


pytest.importorskip("anywidget")

HOMES = {"marimo run": partial(marimo, "run"), "marimo edit": partial(marimo, "edit"), "jupyterlab": jupyterlab}
LIVE = "import bayesmap as bm\nbm.MapWidget(seed=3)"


@pytest.fixture
def show(browser, tmp_path, monkeypatch):
    """Runs a cell in a notebook and waits for the widget's picture; no errors, and no request leaves the machine."""
    monkeypatch.setattr(page_driver, "WAIT_SECONDS", CELL_SECONDS)
    troubles = []
    with contextlib.ExitStack() as stack:
        context = stack.enter_context(contextlib.closing(page_driver.new_context(browser, CELL_SECONDS)))

        def shown(home, source):
            page = context.new_page()
            page_driver.watch_for_trouble(page, troubles)
            canvas, page.server = stack.enter_context(HOMES[home](page, tmp_path, source))
            stack.callback(page.close)  # before its server ends
            canvas.wait_for(timeout=CELL_SECONDS * 1000)
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
    assert np.argwhere(after["walls"] != before["walls"]).tolist() == [[x, 12] for x in range(6, 10)]
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


def test_the_widget_s_view_is_drawn_on_and_its_map_inferred(open_page, monkeypatch):
    """Carry messages between the widget and its view, as a notebook's kernel does."""
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
        page.evaluate("probes.mount()")
        carried_until("s.document?.seed === 3 && s.painted?.sweeps >= 100")
        page.locator("canvas[role=application]").last.scroll_into_view_if_needed()
        page.get_by_role("radio", name="Draw", exact=True).last.check()
        press_and_drag(page, [(6, 12), (9, 12)])
        carried_until("s.seq.sent === s.seq.confirmed && s.painted.generation === s.generation && s.walls[6 * 21 + 12]")
        assert widget.document == snapshot(page)["document"]
        page.evaluate("close_it()")
        assert page.locator("canvas[role=application]").count() == 1
    finally:
        widget.close()
