"""Draws over the mean: one after the other, without end, and only one by one for who wants nothing to move."""

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import settled, snapshot, still, until, watch
from page_hands import act, press, run, show_layer

OPACITY = """() => {
  const canvas = document.querySelector("[data-bayesmap]").shadowRoot.querySelector("canvas.hypothesis");
  const context = canvas.getContext("2d");
  const box = canvas.getBoundingClientRect();
  const [nx, ny] = bayesmap.snapshot().document.grid.shape;
  const opacity = (x, y) => {
    const at = bayesmap.cellToClient(x, y);
    return context.getImageData(at.x - box.x, at.y - box.y, 1, 1).data[3];
  };
  return Array.from({ length: nx }, (_, x) => Array.from({ length: ny }, (_, y) => opacity(x, y)));
}"""
"""Of the layer of hypotheses: (cells x, cells y) by the pixel at each centre."""


def over(page):
    page.get_by_role("checkbox", name="Draws over the mean").check()
    until(page, "s.over && s.painted.layer === 'draw'")


def test_a_draw_lies_over_the_mean(open_page, room):
    posterior, address = room
    page = open_page(address, device_scale_factor=1)
    over(page)
    still(page)
    shown = snapshot(page)
    draw = posterior.map_of(0, shown["painted"]["draw"])
    expected = np.where(shown["observed"] > 0, np.rint(255 * draw), 0)  # of a saved run either is known, or not
    assert np.abs(np.array(page.evaluate(OPACITY)) - expected).max() <= 2
    playwright.expect(page.locator(".chips")).to_contain_text("over the mean")
    playwright.expect(page.get_by_role("list", name="Legend")).to_contain_text("this draw")
    playwright.expect(page.locator("canvas.hypothesis")).to_be_visible()
    page.get_by_role("checkbox", name="Draws over the mean").uncheck()
    until(page, "!s.over")
    playwright.expect(page.locator("canvas.hypothesis")).to_be_hidden()


@pytest.mark.full
def test_they_are_played_without_end(open_page, room):
    page = open_page(room[1])
    over(page)
    page.get_by_role("combobox", name="Speed").select_option("30")
    watch(page, "s.painted.draw")
    press(page, "Play the draws")
    until(page, "window.seen.length > 22")  # ten draws, more than twice over
    assert set(page.evaluate("window.seen")) == set(range(10))
    assert snapshot(page)["over"]
    press(page, "Pause the draws")
    still(page)
    paused = snapshot(page)["painted"]["draw"]
    page.wait_for_timeout(300)
    assert snapshot(page)["painted"]["draw"] == paused


@pytest.mark.full
def test_who_wants_nothing_to_move_is_shown_one_at_a_time(open_page, room):
    page = open_page(room[1], reduced_motion="reduce")
    over(page)
    playwright.expect(page.get_by_role("button", name="Play the draws")).to_have_count(0)
    playwright.expect(page.get_by_role("combobox", name="Speed")).to_be_disabled()
    first = snapshot(page)["painted"]["draw"]
    for step in (1, 2):
        press(page, "Next draw")
        until(page, "s.painted.draw === argument", (first + step) % 10)
    page.wait_for_timeout(400)
    assert snapshot(page)["painted"]["draw"] == (first + 2) % 10


@pytest.mark.full
def test_it_works_on_a_live_posterior_with_kept_draws(page):
    settled(page)
    act(page, lambda: run(page))
    until(page, "!s.running && s.draws.count > 1")
    over(page)
    press(page, "Play the draws")
    first = snapshot(page)["painted"]["draw"]
    until(page, "s.over && s.painted.draw !== argument", first)
    show_layer(page, "Mean")
    until(page, "!s.over && s.painted.layer === 'mean'")
