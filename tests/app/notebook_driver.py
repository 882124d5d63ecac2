"""Notebooks whose one cell shows the widget, in marimo and in JupyterLab, run in a browser page by its own controls."""

import contextlib
import importlib.util
import json
import os
import re
import socket
import subprocess
import sys
import textwrap
import time
import urllib.error
import urllib.request

import pytest

CELL_SECONDS = 300.0
"""For a kernel to start, to import bayesmap, and to show the widget."""

TOKEN = "of-the-test"


@contextlib.contextmanager
def marimo_app(page, folder, source):
    """Served as an app, which runs the cell itself."""
    with marimo("run", folder, source, "--session-ttl", "1") as (address, process):
        page.goto(address)
        yield page.locator(".output canvas[role=application]"), process


@contextlib.contextmanager
def marimo_editor(page, folder, source):
    """In the editor; the cell is run by keys."""
    with marimo("edit", folder, source) as (address, process):
        page.goto(address)
        run_by_keys(page, ".cm-content", "Control+Enter")
        yield page.locator(".output-area canvas[role=application]"), process


@contextlib.contextmanager
def jupyterlab(page, folder, source):
    """In JupyterLab; the cell is run by keys."""
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
    address = f"http://127.0.0.1:{port}/lab/tree/map.ipynb?token={TOKEN}"
    with listening(command, folder, f"http://127.0.0.1:{port}/api") as process:
        page.goto(address)
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
def marimo(verb, folder, source, *more):
    """`marimo run` or `marimo edit` on a notebook of one cell: its address, and the server's process."""
    needed("marimo")
    path = folder / "map.py"
    cell = textwrap.indent(source, "    ")
    path.write_text(
        f"import marimo\n\napp = marimo.App()\n\n\n@app.cell\ndef _():\n{cell}\n    return\n\n\n"
        'if __name__ == "__main__":\n    app.run()\n'
    )
    port = free_port()
    options = ["--headless", "--no-token", "--host", "127.0.0.1", "--port", str(port), *more]
    address = f"http://127.0.0.1:{port}/"
    with listening(["marimo", "-y", verb, *options, str(path)], folder, address + "health") as process:
        yield address, process


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
    """Whether somebody is there; a refusal is an answer."""
    try:
        with urllib.request.urlopen(address, timeout=5):
            return True
    except urllib.error.HTTPError as refused:
        refused.close()
        return True
    except OSError:
        return False


def run_by_keys(page, code, keys):
    """Put the cursor into the cell's code, and run it."""
    editor = page.locator(code).first
    editor.click(timeout=CELL_SECONDS * 1000)
    editor.press(keys)


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as listener:
        return listener.getsockname()[1]


def needed(package):
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed")
