"""A log and a saved run in the page: scans and draws to look through, nothing to draw on."""

import numpy as np
import pytest
from building_log import room_run, write_room_log
from page_driver import act, document, fragment, served, show_layer, snapshot, until

import bayesmap as bm


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
    walls, pose = bm.worlds.tutorial()
    grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
    angles = np.arange(60) / 60 * 2 * np.pi
    scans = bm.simulate(walls, grid, pose, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=0)
    run = bm.infer(
        scans,
        grid,
        prior=bm.Independent(0.5),
        sensor=bm.Gaussian(0.2),
        schedule=bm.Schedule(chains=2, warmup=10, draws=15),
    )
    run.save(tmp_path / "run.nc")
    with served(tmp_path / "run.nc") as (address, _):
        page = open_page(address)
        until(page, "s.draws.count === 15")
        shown = snapshot(page)
        assert np.abs(shown["probability"] / 255 - run.occupancy).max() <= 0.5 / 255 + 1e-6
        show_layer(page, "One draw")
        page.get_by_label("Chain", exact=True).select_option("1")
        page.get_by_role("slider", name="Draw number").fill("14")
        until(page, "s.painted.layer === 'draw' && s.painted.draw === 14 && s.painted.chain === 1")
        assert np.array_equal(snapshot(page)["probability"] > 0, run.draws[1, 14])
        for name in ("Run", "Clear inference"):
            assert not page.get_by_role("button", name=name, exact=True).is_visible()
        assert set(np.unique(shown["scan"]["hit"])) == {0, 1}  # no return is read with noise, and none for a hit
        out = np.isclose(shown["scan"]["ranges"], 42, atol=1.0)
        assert np.array_equal(shown["scan"]["hit"] == 0, out)


@pytest.mark.full
@pytest.mark.parametrize("kind", ["log", "run"])
def test_a_share_link_of_a_file_opens_and_a_lost_connection_is_found_again(open_page, log, tmp_path, kind):
    file = log
    if kind == "run":
        file = tmp_path / "run.nc"
        room_run(bm.Independent(0.2), draws=5).save(file)
    with served(file) as (address, _):
        page = open_page(address)
        until(page, "s.painted")
        if kind == "log":
            act(page, lambda: page.get_by_label("Prior P(wall), number").fill("0.3") or page.keyboard.press("Tab"))
        page.get_by_role("button", name="Share").click()
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


CUT_ONCE = """
() => {
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (data) { this.close(); WebSocket.prototype.send = send; };
}
"""


@pytest.mark.full
def test_a_link_to_another_file_says_what_to_start(open_page, server):
    elsewhere = document(source={"kind": "log", "name": "office.log.gz", "scans": 910}, walls="", sensors=[])
    page = open_page(server + fragment(elsewhere))
    page.get_by_role("status").get_by_text("start bayesmap app with office.log.gz").wait_for()
    assert snapshot(page)["document"]["source"] == {"kind": "simulation"}
