"""What is lost on the way is found again."""

import contextlib
import os
import signal
from urllib.parse import urlsplit

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import NO_WALLS, document, fragment, served, settled, snapshot, until
from page_hands import act, choose, press_and_drag, undo


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


CUT = """
() => {
  // the line is cut, and stays so until `mend`
  const Real = WebSocket;
  const send = Real.prototype.send;
  Real.prototype.send = function (data) { this.close(); };
  window.WebSocket = class { static OPEN = 1; constructor() { setTimeout(() => this.onclose?.()); } close() {} };
  window.mend = () => { window.WebSocket = Real; Real.prototype.send = send; };
}
"""


def test_a_lost_socket_shows_a_banner_reconnects_and_restores_what_was_drawn_meanwhile(open_page):
    page = open_page(document(walls=NO_WALLS))
    settled(page)
    choose(page, "Draw")
    page.evaluate(CUT)
    press_and_drag(page, [(4, 8), (4, 8)])
    banner = page.get_by_role("alert")
    banner.get_by_text("Connection lost").wait_for()
    assert not snapshot(page)["connected"]
    press_and_drag(page, [(8, 8), (8, 12)])
    assert snapshot(page)["walls"][8, 8:13].all()
    status = page.locator("footer").get_by_role("status")
    playwright.expect(status).to_have_text("Connection lost")
    for press in ("Control+z", "r", "a"):
        page.keyboard.press(press)
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
    """A server that ends as one whose machine is switched off."""
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
