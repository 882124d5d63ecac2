"""The widget without a browser: what its view would send, and what it would be sent."""

import json
import os
import queue
import threading
import time

import numpy as np
import pytest
from building_log import tutorial_run
from page_socket import PATIENCE_S, Talk

import bayesmap as bm
from bayesmap.app import session
from bayesmap.app.edits import new_document, tutorial_document
from bayesmap.app.protocol.notices import DrawCount
from bayesmap.app.protocol.tasks import Finished, Report

pytest.importorskip("anywidget")


class View(Talk):
    """Stands for the page in the notebook."""

    def __init__(self, widget, monkeypatch):
        self.widget, self.inbox = widget, queue.Queue()
        monkeypatch.setattr(widget, "send", lambda content, buffers=None: self.inbox.put((content, buffers or [])))

    def deliver(self, message):
        self.widget._handle_custom_msg(message, [])

    def read(self):
        content, buffers = self.inbox.get(timeout=PATIENCE_S)
        header = json.loads(json.dumps(content))  # as the notebook sends it
        pairs = zip(header.get("buffers", []), buffers, strict=True)
        return header, {at["name"]: np.frombuffer(data, at["dtype"]).reshape(at["shape"]) for at, data in pairs}


@pytest.fixture
def shown(monkeypatch):
    made = []

    def show(*arguments, **options):
        widget = bm.MapWidget(*arguments, **options)
        made.append(widget)
        view = View(widget, monkeypatch)
        view.send("hello")
        return view

    yield show
    for widget in made:
        widget.close()


def test_the_live_page_infers(shown):
    document = new_document("blank", (15, 16), tutorial_document()).to_json()
    view = shown(document=document)
    assert view.until("welcome")[0]["version"] == 1
    assert view.until("state")[0]["document"] == view.widget.document == document
    _, arrays = view.until("field", lambda h: not h["approximate"])
    assert arrays["p"].shape == (15, 16)
    view.send("walls", cells=[[3, 2]], wall=True, stroke=1)
    state = view.confirmed()
    assert state["document"] == view.widget.document
    view.until("field", lambda h: h["generation"] == state["generation"] == view.widget.generation)


def test_a_report_that_comes_while_an_edit_is_applied_waits_for_it(shown, monkeypatch):
    view = shown(seed=3)
    view.until("field", lambda h: not h["approximate"])
    begun, edit = threading.Event(), session.edit_document

    def slow(document, message):
        begun.set()
        time.sleep(0.2)
        return edit(document, message)

    monkeypatch.setattr(session, "edit_document", slow)
    editing = threading.Thread(target=view.send, args=("walls",), kwargs={"cells": [[10, 12]], "wall": True})
    editing.start()
    begun.wait(PATIENCE_S)
    done = Finished(DrawCount(1, 1), generation=view.widget.generation)
    view.widget._receive_report(Report(done))  # as a thread of the supervisor's calls it; it tells of the state
    editing.join()
    assert view.confirmed()["document"] == view.widget.document


def test_a_run_is_shown_with_its_draws(shown):
    run = tutorial_run()
    view = shown(run)
    header, arrays = view.until("field")
    assert header["draws"] == {"chains": 2, "count": 20}
    assert np.array_equal(arrays["p"], np.rint(255 * run.occupancy))
    view.send("view", layer="draw", chain=1, draw=7)
    _, arrays = view.until("field", lambda h: h["layer"] == "draw")
    assert np.array_equal(arrays["p"] > 0, run.draws[1, 7])
    assert "data-recording" in view.widget.to_html()


def test_malformed_messages_are_answered_by_an_error(shown):
    view = shown()
    for content in (None, [], {"type": "nonsense", "seq": 9}):
        view.widget._handle_custom_msg(content, [])
        assert view.until("error")[0]["text"]
    with pytest.raises(bm.BadInput, match="version"):
        bm.MapWidget(document={"version": 7})


def test_the_worker_ends_with_the_channel_which_is_all_that_marimo_closes(shown):
    view = shown()
    view.until("field")
    worker = view.widget._supervisor.pid
    os.kill(worker, 0)
    view.widget.comm.close()
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)


def test_the_module_travels_with_the_widget():
    widget = bm.MapWidget()
    assert " as default," in widget._esm
    with pytest.raises(bm.BadInput, match="live page"):
        widget.to_html()
    widget.close()
