"""The page shares what it shows, and recovers what is lost on the way."""

import contextlib
import io
import json
import os
import signal
import zipfile
from urllib.parse import urlsplit

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import NO_WALLS, document, fragment, new_context, served, settled, snapshot, until
from page_hands import act, choose, press, press_and_drag, run, show_draw, show_layer, undo
from PIL import Image

import bayesmap as bm


def saved(page, name):
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as waiting:
        page.get_by_role("button", name=name).click()
    return waiting.value


@pytest.fixture
def drawn(page):
    choose(page, "Draw")
    settled(page)
    act(page, lambda: press_and_drag(page, [(7, 7), (9, 8)]))
    return page


def test_a_share_link_opens_to_the_same_map_and_the_same_posterior(drawn, open_page):
    shared = settled(drawn)
    press(drawn, "Share")
    link = drawn.get_by_role("textbox", name="Link").input_value()
    assert "#m=" in link
    assert "token" not in link
    assert len(link) < 1000
    drawn.keyboard.press("Escape")
    act(drawn, lambda: press(drawn, "Clear walls"))
    assert settled(drawn)["walls"].sum() == 0
    other = drawn.context.new_page()  # this browser knows the token
    other.goto(link)
    until(other, "s.painted?.generation === s.generation && s.seq.confirmed === s.seq.sent")
    linked = settled(other)
    assert linked["document"] == shared["document"]
    assert np.array_equal(linked["probability"], shared["probability"])
    assert np.array_equal(settled(drawn)["walls"], shared["walls"])  # pages of one server show the same


@pytest.fixture
def stranger(browser):
    """A page in a browser that knows no token."""
    with contextlib.closing(new_context(browser)) as context:
        yield context.new_page()


def test_a_link_without_the_token_opens_nothing_in_another_browser(stranger, server):
    bare = server.split("?")[0]
    assert stranger.goto(bare + fragment(document())).status == 403
    stranger.get_by_text("open the address that bayesmap app printed").wait_for()
    stranger.get_by_text("open this link again").wait_for()
    assert stranger.evaluate("window.bayesmap") is None
    stranger.goto(server)
    until(stranger, "s.painted")
    stranger.goto("about:blank")
    stranger.goto(bare + fragment(document(prior=0.375)))  # now it knows it
    until(stranger, "s.document?.prior === 0.375")


@pytest.mark.full
def test_a_token_that_is_refused_is_not_tried_for_ever(stranger, server):
    bare = server.split("?")[0]
    stranger.goto(bare)
    stranger.evaluate("localStorage.setItem('bayesmap-token', 'old')")
    stranger.goto(bare)
    stranger.wait_for_url("**/?token=old")
    stranger.get_by_text("open the address that bayesmap app printed").wait_for()
    assert stranger.evaluate("localStorage.getItem('bayesmap-token')") is None


def test_exported_files_of_a_run_open_again_with_all_its_draws(drawn, open_page, tmp_path):
    run(drawn, 2000)  # those of Live, and as many more
    live = snapshot(drawn)
    saved(drawn, "Saved run").save_as(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    assert loaded.draws.shape[-2:] == (21, 21)
    apart = np.abs(loaded.occupancy - live["probability"] / 255)
    assert apart[live["observed"] > 0].max() < 0.01
    assert apart.max() < 0.06  # where no beam is, the page has the prior itself
    with zipfile.ZipFile(io.BytesIO(saved(drawn, "Map for robots").path().read_bytes())) as archive:
        assert {name.rsplit(".")[-1] for name in archive.namelist()} == {"pgm", "yaml"}
    assert json.loads(saved(drawn, "Document").path().read_text()) == live["document"]
    saved(drawn, "Page in one file").save_as(tmp_path / "page.html")
    page = open_page((tmp_path / "page.html").as_uri())
    until(page, "s.draws.count > 0")
    opened = snapshot(page)
    for name in ("walls", "probability", "observed"):
        assert np.array_equal(opened[name], live[name])
    show_layer(page, "One draw")
    assert set(np.unique(show_draw(page, opened["draws"]["count"] - 1))) <= {0, 255}
    for name in ("Run", "Undo", "Share", "New map"):
        assert not page.get_by_role("button", name=name, exact=True).is_visible()
    assert page.evaluate("performance.getEntriesByType('resource').length") == 0


def test_a_picture_is_made_in_the_page(drawn):
    settled(drawn)  # the first picture after an edit is paler: belief propagation has only begun
    image = Image.open(saved(drawn, "Picture").path())
    assert image.format == "PNG"
    assert image.width >= 1600
    pixels = np.asarray(image.convert("RGB"), dtype=int).reshape(-1, 3)
    assert ((pixels[:, 0] > 190) & (pixels[:, 1] < 110) & (pixels[:, 2] < 40)).sum() > 1000  # true walls
    assert (pixels.sum(axis=1) < 150).sum() > 5000  # inferred ones


@pytest.mark.parametrize("ended_by", [signal.SIGKILL, pytest.param(signal.SIGSTOP, marks=pytest.mark.full)])
def test_a_killed_or_hanging_worker_is_replaced_with_a_message_and_the_map_is_as_it_was(open_page, browser, ended_by):
    with served() as (address, server):
        page = open_page(address + fragment(document()))
        choose(page, "Draw")
        act(page, lambda: press_and_drag(page, [(7, 7), (9, 7)]))
        before, worker = settled(page), server.worker
        os.kill(worker, ended_by)
        if ended_by == signal.SIGKILL:  # the next of a worker that lived longer is there before this can be seen
            page.get_by_role("alert").get_by_text("The worker stopped").wait_for()
        until(page, "s.worker === 'ready' && s.generation > argument", before["generation"])
        after = settled(page)
        assert server.worker != worker
        assert np.array_equal(after["walls"], before["walls"])
        assert np.array_equal(after["probability"], before["probability"])
        page.get_by_role("alert").wait_for(state="hidden")
        undo(page)


def test_a_lost_socket_shows_a_banner_reconnects_and_restores_what_was_drawn_meanwhile(open_page):
    page = open_page(document(walls=NO_WALLS))
    settled(page)
    choose(page, "Draw")
    page.evaluate("probes.cut()")
    press_and_drag(page, [(4, 8), (4, 8)])
    banner = page.get_by_role("alert")
    banner.get_by_text("Connection lost").wait_for()
    assert not snapshot(page)["connected"]
    press_and_drag(page, [(8, 8), (8, 12)])
    assert snapshot(page)["walls"][8, 8:13].all()
    status = page.locator("footer").get_by_role("status")
    playwright.expect(status).to_have_text("Connection lost")
    for keys in ("Control+z", "r", "a"):
        page.keyboard.press(keys)
        playwright.expect(status).to_have_text("Not while the connection is lost: this needs the server")
    # In one go: the page tries again by itself, too, and then there is nothing left to click.
    page.evaluate("mend()")
    with contextlib.suppress(playwright.TimeoutError):
        page.get_by_role("button", name="Reconnect now").click(timeout=2000)
    banner.wait_for(state="hidden")
    until(page, "s.connected && s.seq.confirmed === s.seq.sent && s.painted.generation === s.generation")
    after = settled(page)["walls"]
    assert after.sum() == 6
    assert np.array_equal(snapshot(open_page(page.url))["walls"], after)  # the server has it too


def test_after_a_restart_on_the_same_port_the_page_goes_on_with_what_was_drawn_meanwhile(open_page, browser):
    """The server ends as if its machine were switched off."""
    with served() as (address, server):
        page = open_page(address + fragment(document(walls=NO_WALLS)), quiet=False)
        settled(page)
        server.stop()
        port = urlsplit(address).port
        page.get_by_role("alert").get_by_text("Connection lost").wait_for()
        choose(page, "Draw")
        press_and_drag(page, [(4, 8), (8, 8)])
    with served(port=port) as (address, _):
        page.get_by_role("alert").get_by_text("started again, with another address").wait_for()
        other = page.context.new_page()
        other.goto(address)
        page.get_by_role("alert").wait_for(state="hidden")
        until(page, "s.connected && s.seq.confirmed === s.seq.sent && s.painted.generation === s.generation")
        until(other, "s.walls.reduce((a, b) => a + b, 0) === 5")
        assert settled(page)["walls"][4:9, 8].all()
        page.reload()  # its address has the new token
        until(page, "s.connected && s.painted")
