"""A log, a saved run and a page in one file: scans and draws to look through, nothing to draw on."""

from pathlib import Path

import numpy as np
import pytest
from building_log import room_run, tutorial_run, write_room_log
from page_driver import document, fragment, served, snapshot, until
from page_hands import enter, press, show_draw, show_layer

import bayesmap as bm

TUTORIAL = Path(__file__).parents[2] / "docs/tutorial/interactive.html"


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """A dozen scans of a small room."""
    return write_room_log(tmp_path_factory.mktemp("page") / "office.log")


def test_a_log_is_inferred_while_its_scans_are_looked_through(open_page, log):
    with served(log) as (address, _):
        page = open_page(address)
        until(page, "s.painted && s.painted.sweeps > 0")
        first = snapshot(page)
        source = first["document"]["source"]
        assert {**source, "bounds": None} == {"kind": "log", "name": log.name, "scans": 12, "bounds": None}
        assert first["observed"].any()
        page.get_by_role("slider", name="Scan number").fill("7")
        until(page, "s.scan.index === 7")
        assert not np.array_equal(snapshot(page)["scan"]["pose"], first["scan"]["pose"])
        assert not page.get_by_role("radio", name="Draw", exact=True).is_visible()
        assert not page.get_by_role("slider", name="Noise").is_visible()
        assert page.get_by_role("slider", name="Prior").is_visible()
        before = snapshot(page)["generation"]
        page.mouse.click(480, 400)  # a press on the map pans, and draws nothing
        assert snapshot(page)["generation"] == before


def test_a_saved_run_shows_its_mean_and_its_draws(open_page, tmp_path):
    run = tutorial_run()
    run.save(tmp_path / "run.nc")
    with served(tmp_path / "run.nc") as (address, _):
        page = open_page(address)
        until(page, "s.draws.count === 20")
        shown = snapshot(page)
        assert np.abs(shown["probability"] / 255 - run.occupancy).max() <= 0.5 / 255 + 1e-6
        show_layer(page, "One draw")
        assert np.array_equal(show_draw(page, 14, chain=1) > 0, run.draws[1, 14])
        for name in ("Run", "Clear inference"):
            assert not page.get_by_role("button", name=name, exact=True).is_visible()
        assert set(np.unique(shown["scan"]["hit"])) == {0, 1}  # no return is read with noise, and none for a hit
        out = np.isclose(shown["scan"]["ranges"], 42, atol=1.0)
        assert np.array_equal(shown["scan"]["hit"] == 0, out)


CUT_ONCE = """
() => {
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (data) { this.close(); WebSocket.prototype.send = send; };
}
"""


@pytest.mark.full
@pytest.mark.parametrize("kind", ["log", "run"])
def test_a_share_link_of_a_file_opens_and_a_lost_connection_is_found_again(open_page, log, tmp_path, kind):
    file = log
    if kind == "run":
        file = tmp_path / "run.nc"
        room_run(bm.Independent(0.2)).save(file)
    with served(file) as (address, _):
        page = open_page(address)
        until(page, "s.painted")
        if kind == "log":
            enter(page, "Prior P(wall)", 0.3)
        press(page, "Share")
        link = page.get_by_role("textbox", name="Link").input_value()
        page.keyboard.press("Escape")
        other = page.context.new_page()
        other.goto(link)
        until(other, "s.painted && s.connected && s.status.text === 'Ready'")
        assert snapshot(other)["document"] == snapshot(page)["document"]
        other.evaluate(CUT_ONCE)
        other.get_by_role("radio", name="Entropy").check()
        other.get_by_role("status").get_by_text("Connected again").wait_for()
        until(other, "s.connected && s.painted.generation === s.generation && s.seq.confirmed === s.seq.sent")
        assert snapshot(other)["document"] == snapshot(page)["document"]


@pytest.mark.full
def test_a_link_to_another_file_says_what_to_start(open_page, server):
    elsewhere = document(source={"kind": "log", "name": "office.log.gz", "scans": 910}, walls="", sensors=[])
    page = open_page(server + fragment(elsewhere))
    page.get_by_role("status").get_by_text("start bayesmap app with office.log.gz").wait_for()
    assert snapshot(page)["document"]["source"]["kind"] == "simulation"


def test_the_tutorial_s_page_opens_from_a_disk_without_a_server(open_page):
    page = open_page(TUTORIAL.as_uri())
    until(page, "s.painted.sweeps === 1000")
    show_layer(page, "One draw")
    until(page, "s.painted.layer === 'draw'")
