"""The session: what actions do, what is refused, one step of undo a gesture, and pictures in order."""

from dataclasses import replace

import numpy as np
import pytest
from acted import PICTURE, Acted
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace as replace_fields

from bayesmap.app.edits import MAX_UNDO_STEPS, History, new_document, tutorial_document
from bayesmap.app.protocol.actions import Cancel, Export, FindPath, Inspect
from bayesmap.app.protocol.document import Source, empty_walls
from bayesmap.app.protocol.notices import DrawCount, Scan, View, Whereabouts
from bayesmap.app.protocol.tasks import Failed, Finished, Ready, Report, Show


def walls_of(acted):
    return acted.session.document.is_wall


def test_hello_is_answered_by_the_state_and_what_was_seen_last_and_a_document_is_adopted(acted):
    acted.hear(Scan([1], generation=0))
    assert [m["type"] for m in acted.hear(Whereabouts(0), generation=acted.session.generation - 1)] == ["where"]
    acted.picture()
    assert [m["type"] for m in acted.act("hello", client=2)] == ["state", "scan", "field"]
    document = new_document("blank", (5, 7), tutorial_document())
    acted.act("hello", document=document.to_json())
    assert acted.session.document == acted.inferred[-1].document == document
    generation = acted.session.generation
    acted.act("hello", document=document.to_json())  # the same again, as after a lost connection
    assert acted.session.generation == generation


def test_a_link_to_the_file_on_show_brings_its_settings_and_another_is_answered_by_what_to_start():
    acted = Acted(of_a_log())
    generation = acted.session.generation
    own = {**of_a_log().to_json(), "walls": ""}
    acted.act("hello", document=own)
    assert acted.session.generation == generation
    acted.act("hello", document={**own, "prior": 0.25, "max_range": 7.0})
    assert acted.session.document == replace(of_a_log(), prior=0.25)
    other = {**of_a_log("other.log").to_json(), "walls": ""}
    for brought, named in ((other, "other.log"), (tutorial_document().to_json(), "without a file")):
        assert [m["type"] for m in acted.act("hello", document=brought)] == ["status", "state"]
        assert named in acted.text
        assert acted.session.document == replace(of_a_log(), prior=0.25)


def of_a_log(name="office.log"):
    drawn = tutorial_document()
    return replace(drawn, walls=empty_walls(drawn.grid), sensors=(), source=Source("log", name, 9))


def test_a_stroke_or_a_drag_is_one_step_of_undo():
    acted, before = Acted(), walls_of(Acted()).copy()
    for x in range(5):
        acted.act("walls", cells=[[x, 0]], wall=True, stroke=1)
        acted.picture()
    acted.act("walls", cells=[[0, 5]], wall=True, stroke=2)
    acted.picture()
    assert walls_of(acted)[:5, 0].all()
    acted.act("undo")
    assert walls_of(acted)[:5, 0].all()
    assert not walls_of(acted)[0, 5]
    acted.act("undo")
    assert np.array_equal(walls_of(acted), before)
    acted.act("redo")
    assert walls_of(acted)[:5, 0].all()
    acted = Acted()
    dragged(acted, 4)  # and so is a drag
    acted.act("undo")
    assert acted.session.document.sensors[0].x == 10.0
    assert not acted.state["can_undo"]


@pytest.mark.parametrize(("x", "y", "named"), [(2.0, 2.0, "wall"), (-3.0, 5.0, "outside"), (1e5, 1e5, "outside")])
def test_a_sensor_cannot_go_into_a_wall_or_outside(acted, x, y, named):
    before, generation = acted.session.document, acted.session.generation
    answers = acted.act("move_sensor", id=1, x=x, y=y, drag=1)
    assert [m["type"] for m in answers] == []  # the first picture is in flight: it waits
    acted.picture()
    assert named in acted.text
    assert acted.session.document is before
    assert (acted.session.generation, acted.state["seq"]) == (generation, acted.seq)


def test_walls_spare_sensors_which_are_added_up_to_the_limit_and_removed_down_to_one():
    acted = Acted(new_document("blank", (40, 40), tutorial_document()))
    acted.picture()
    ((x, y),) = acted.session.document.sensor_cells()
    acted.act("walls", cells=[[x - 1, y], [x, y], [x + 1, y]], wall=True, stroke=1)
    assert f"({x}, {y})" in acted.text
    assert walls_of(acted)[x - 1 : x + 2, y].tolist() == [True, False, True]
    for i in range(40):
        acted.act("add_sensor", x=i % 30, y=3)
    assert len(acted.session.document.sensors) == 32
    assert "remove one" in acted.text
    for sensor in acted.session.document.sensors:
        acted.act("remove_sensor", id=sensor.id)
    assert len(acted.session.document.sensors) == 1
    assert "last sensor" in acted.text


@pytest.mark.parametrize("message", [
    {"type": "walls", "cells": [[21, 0]], "wall": True, "stroke": 0}, {"type": "remove_sensor", "id": 9},
    {"type": "undo"}, {"type": "redo"}, {"type": "scan", "index": 0},
], ids=lambda m: m["type"])  # fmt: skip
def test_actions_that_cannot_be_done_change_nothing(acted, message):
    acted.picture()
    before = acted.session.generation
    assert [m["type"] for m in acted.act(message.pop("type"), **message)] == ["status", "state"]
    assert acted.session.generation == before


def test_edits_of_a_gesture_wait_for_the_picture_and_are_merged_but_not_with_those_of_another(acted):
    for i in range(1, 7):
        acted.act("move_sensor", id=1, x=10 + 0.1 * i, y=10, drag=1 + i // 6)
    assert len(acted.inferred) == 2  # what waits is applied when another drag begins
    acted.picture()
    assert [task.document.sensors[0].x for task in acted.inferred[1:]] == [10.5, 10.6]
    assert acted.state["seq"] == acted.seq


def dragged(acted, moves, paints=False):
    """A sensor is moved so often; the worker is done with each picture before the next move."""
    for i in range(moves):
        acted.act("move_sensor", id=1, x=10 + 0.01 * (i + 1), y=10, drag=1)
        acted.picture()
        if paints:
            acted.painted()


@pytest.mark.parametrize(
    ("paints", "pictures"), [("slowly", 2), ("in time", 8), ("and never says so", 8), ("elsewhere", 8)]
)
def test_a_drag_is_shown_as_far_as_its_page_paints(acted, paints, pictures):
    acted.picture()
    if paints == "elsewhere":  # one slow page does not hold up another
        acted.session.join(2)
        acted.painted(client=2)
    elif paints != "and never says so":
        acted.painted()
    dragged(acted, 8, paints == "in time")
    assert len(acted.inferred) == 1 + pictures
    acted.painted()
    assert (acted.inferred[-1].document.sensors[0].x, acted.state["seq"]) == (10.08, acted.seq)


def test_edits_that_waited_for_a_page_are_applied_when_it_leaves(acted):
    acted.picture()
    acted.painted()
    dragged(acted, 4)
    acted.session.leave(1)
    assert acted.session.document.sensors[0].x == 10.04


def test_strokes_that_wait_lose_no_cell_and_anything_else_applies_what_waits_first(acted):
    for y in range(20):
        acted.act("walls", cells=[[0, y]], wall=True, stroke=1)
    acted.act("set", patch={"prior": 0.2})
    assert acted.inferred[-1].document.is_wall[0, :20].all()
    assert acted.inferred[-1].document.prior == 0.2


def test_run_keeps_draws_until_the_next_edit_and_the_state_says_whether_the_picture_will_change(acted):
    for kind, fields in (("run", {}), ("set", {"patch": {"prior": 0.1}})):  # live chains are no run
        acted.act(kind, **fields)
        assert acted.inferred[-1].mode == ("run" if kind == "run" else "live")
        assert acted.state["running"] == (kind == "run")
        assert acted.state["draws"] == {"chains": 0, "count": 0}
        acted.picture()
        assert acted.session.working
        acted.hear(Finished(DrawCount(2, 1000), generation=0))
        assert not acted.state["working"]
        assert not acted.state["running"]
        assert acted.state["draws"] == {"chains": 2, "count": 1000}
    acted.act("run")
    acted.hear(Failed("no", generation=0))
    assert not acted.state["working"]
    acted.act("clear", what="inference")
    assert not acted.state["working"]


@pytest.mark.parametrize("ended", [Finished(DrawCount(), generation=0), Failed("too many beams", generation=0)])
def test_a_job_that_is_cancelled_or_fails_lets_waiting_edits_go_on(acted, ended):
    acted.act("move_sensor", id=1, x=10.3, y=10, drag=1)
    acted.act("cancel")  # which applies what waits, and so begins a picture
    acted.act("move_sensor", id=1, x=10.4, y=10, drag=1)
    acted.hear(ended)
    assert acted.inferred[-1].document.sensors[0].x == 10.4
    assert ("too many beams" in [m.get("text") for m in acted.sent]) == isinstance(ended, Failed)


def test_questions_go_to_the_worker_and_change_nothing(acted):
    before = acted.session.generation
    acted.act("inspect", x=3, y=4, each=True)
    acted.act("path", start=[0, 0], goal=[1.5, 2], radius=0.2, risk=0.1)
    acted.act("view", layer="draw", chain=1, draw=5)
    acted.act("export", what="map")
    acted.act("cancel")
    path = FindPath((0.0, 0.0), (1.5, 2.0), 0.2, 0.1)
    assert acted.asked == [(1, question) for question in (Inspect(3, 4, each_beam=True), path, Export("map"))]
    assert acted.session.generation == before
    assert Show(1, View("draw", 1, 5)) in acted.tasks
    assert isinstance(acted.tasks[-1], Cancel)
    assert acted.state["view"] == {"layer": "draw", "chain": 1, "draw": 5}


def test_each_page_has_its_own_view(acted):
    acted.picture()
    for client in (1, 2):
        acted.session.join(client)
        acted.act("hello", client=client)
    acted.act("view", client=2, layer="draw", chain=0, draw=3)
    assert acted.state["view"] == {"layer": "draw", "chain": 0, "draw": 3}
    acted.act("cancel")
    assert acted.state["view"]["layer"] == "mean"  # as the first page sees it
    for client, pages in ((None, [1]), (2, [2])):
        report = Report(replace_fields(PICTURE, generation=acted.session.generation), {}, client)
        assert [effect.client for effect in acted.session.receive_report(report)] == pages
    assert acted.session.leave(2)[0] == Show(2, View("mean"))  # nobody is shown that draw any more


def test_a_page_undoes_its_own_steps_and_those_of_pages_that_have_gone(acted):
    acted.picture()
    acted.session.join(2)
    acted.act("set", patch={"prior": 0.3})
    acted.act("set", client=2, patch={"prior": 0.4})
    acted.act("undo")
    assert "another tab" in acted.text
    assert acted.session.document.prior == 0.4
    assert not acted.state["can_undo"]
    acted.session.leave(2)
    acted.act("undo")
    assert acted.session.document.prior == 0.3


def test_the_document_is_exported_without_the_worker_and_live_off_leaves_the_preview(acted):
    assert (acted.act("export", what="document")[0]["type"], acted.asked) == ("download", [])
    acted.act("live", on=False)
    acted.act("set", patch={"prior": 0.1})
    assert acted.inferred[-1].mode == "preview"
    acted.act("live", on=True)
    assert acted.inferred[-1].mode == "live"


def test_a_worker_that_died_is_given_everything_again(acted):
    acted.act("view", layer="entropy")
    acted.act("set", patch={"prior": 0.1})
    assert [m["type"] for m in acted.do(acted.session.worker_lost())] == ["worker", "status"]
    acted.hear(Ready())
    assert (acted.inferred[-1].document.prior, acted.tasks[-2]) == (0.1, Show(1, View("entropy")))


def test_a_scan_of_a_file_can_be_chosen():
    acted = Acted(of_a_log())
    acted.act("scan", index=2)
    assert acted.tasks[-1].index == 2
    acted.act("scan", index=9)
    assert "no scan 9" in acted.text
    acted.act("walls", cells=[[0, 0]], wall=True, stroke=1)
    acted.picture()
    assert "cannot be edited" in acted.text


EVENT = st.one_of(
    st.tuples(st.sampled_from(["move", "stroke"]), st.integers(0, 20)),
    st.tuples(st.just("set"), st.sampled_from([0.1, 0.2, 0.3])),
    st.tuples(st.just("other"), st.sampled_from(["undo", "redo", "run", "cancel"])),
    st.tuples(st.sampled_from(["worker", "painted"]), st.integers(0, 3)),
)


@given(st.lists(EVENT, max_size=50))
def test_no_page_is_sent_a_picture_older_than_a_state_that_it_has_seen(events):
    """In any order of actions, worker's answers and painted messages, late ones of earlier generations among them."""
    acted, at, drawn = Acted(), None, set()
    for kind, value in events:
        if kind == "move":
            at = 10 + 0.05 * value
            acted.act("move_sensor", id=1, x=at, y=10, drag=1)
        elif kind == "stroke":
            drawn.add(value)
            acted.act("walls", cells=[[0, value]], wall=True, stroke=1)
        elif kind == "set":
            acted.act("set", patch={"prior": value}, drag=2)
        elif kind == "other":
            acted.act(value)
            if value in ("undo", "redo"):
                at, drawn = None, set()
        else:
            generation = acted.inferred[-1 - min(value, len(acted.inferred) - 1)].generation
            if kind == "worker":
                acted.hear(PICTURE, generation)
            else:
                acted.painted(generation=generation)
    for _ in range(2):  # an edit waits for a picture or for the page, and what waits is one edit
        acted.picture()
        acted.painted()
    assert acted.seq == 0 or acted.state["seq"] == acted.seq
    newest = 0
    for header in acted.sent:
        if header["type"] in ("state", "field"):
            assert header["generation"] >= newest
            newest = header["generation"]
    generations = [task.generation for task in acted.inferred]
    assert generations == sorted(set(generations))
    assert acted.inferred[-1].document == acted.session.document
    # Nothing that a hand did last is lost.
    assert at is None or acted.session.document.sensors[0].x == at
    assert all(acted.session.document.is_wall[0, y] for y in drawn)
    assert acted.state["seq"] == acted.seq


PUSH = st.tuples(st.just("push"), st.integers(0, 5), st.sampled_from([None, "a", "b"]))


@given(st.lists(st.one_of(PUSH, st.tuples(st.sampled_from(["undo", "redo"]))), max_size=60))
def test_undo_and_redo_walk_along_the_states_that_were(steps):
    """The plainest model is a list and a position in it."""
    history, states, at, gesture = History(0), [0], 0, None
    for action in steps:
        if action[0] == "push":
            _, state, new = action
            history = history.push(state, new)
            if state == states[at]:
                continue
            if new is not None and new == gesture:
                states[at:] = [state]
            else:
                states[at + 1 :] = [state]
                at += 1
            gesture = new
        elif action[0] == "undo":
            history, at, gesture = history.undo(), max(0, at - 1), gesture if at == 0 else None
        else:
            last = len(states) - 1
            history, at, gesture = history.redo(), min(last, at + 1), gesture if at == last else None
        assert history.present == states[at]
        assert bool(history.past) == (at > 0)
        assert bool(history.future) == (at < len(states) - 1)


def test_old_states_are_forgotten():
    history = History(0)
    for state in range(1, MAX_UNDO_STEPS + 50):
        history = history.push(state)
    assert len(history.past) == MAX_UNDO_STEPS
    assert history.undo().redo().present == MAX_UNDO_STEPS + 49
