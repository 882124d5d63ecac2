"""The posterior on the page: settings, runs, draws, traces, and how far the numbers can be trusted."""

import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import document, settled, snapshot, until
from page_hands import act, choose, press, run, show_draw, show_layer, slide, undo

CLOSE = {"sensors": [{"id": 1, "x": 7.0, "y": 11.0, "yaw": 0.0}], "noise": 1.0, "prior": 0.05, "method": "gibbs"}
"""A noisy sensor beside rare walls: single-site chains keep a wall at (7, 12) that is not there."""


def test_draws_are_valid_and_average_to_the_mean(open_page):
    page = open_page(document(sweeps=5, burn_in=0))
    run(page, 10)  # five of Live, and five more
    shown = snapshot(page)
    show_layer(page, "One draw")
    draws = [show_draw(page, draw, chain) for chain in range(shown["draws"]["chains"]) for draw in range(10)]
    assert set(np.unique(draws)) <= {0, 255}
    assert page.get_by_role("slider", name="Draw number").get_attribute("max") == "9"
    seen = shown["observed"] > 0  # where no beam is, the mean is the prior
    assert np.abs(np.mean(draws, axis=0) - shown["probability"])[seen].max() <= 0.5 + 1e-9


def test_cancel_keeps_the_partial_chain(open_page):
    page = open_page(document(sweeps=100_000, angles=1000))
    run(page)
    until(page, "s.running && s.painted.method === 'gibbs' && s.painted.generation === s.generation")
    page.get_by_text(" of 200000 sweeps").wait_for()
    page.get_by_text("s left").wait_for()
    assert page.get_by_role("progressbar").evaluate("(bar) => bar.value") < 1
    press(page, "Cancel")
    until(page, "!s.running && s.draws.count > 0 && s.draws.count === s.painted.sweeps")
    partial = snapshot(page)
    assert 0 < partial["painted"]["sweeps"] < 100_000
    page.wait_for_timeout(300)
    assert snapshot(page)["painted"]["sweeps"] == partial["painted"]["sweeps"]


def test_the_prior_is_what_unobserved_cells_have_and_a_slider_moved_in_one_go_is_one_step_of_undo(page):
    shown = settled(page)
    unseen = shown["observed"] == 0
    assert shown["probability"][20, 20] == pytest.approx(128, abs=15)  # 5 standard errors of 2000 draws
    slide(page, "Prior", 0.05)
    shown = settled(page)
    assert shown["document"]["prior"] == 0.05
    assert shown["probability"][unseen & (shown["observed"] == 0)].mean() == pytest.approx(13, abs=5)
    box = page.get_by_role("slider", name="Prior").bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] * 0.5, y)
    page.mouse.down()
    for part in (0.45, 0.4, 0.35, 0.3):
        page.mouse.move(box["x"] + box["width"] * part, y)
    page.mouse.up()
    assert 0.1 < settled(page)["document"]["prior"] < 0.4
    page.keyboard.press("Escape")
    undo(page)
    assert settled(page)["document"]["prior"] == 0.05


def test_chains_that_disagree_are_called_so_and_a_click_mends_it(open_page):
    page = open_page(document(**CLOSE))
    shown = settled(page)
    assert shown["painted"]["verdict"]["level"] == "bad"
    chip = page.get_by_role("button", name="Not converged: try blocks")
    chip.wait_for()
    page.get_by_role("status").get_by_text("have not converged").wait_for()
    assert page.locator("dd.bad").count() == 2
    assert shown["probability"][7, 12] > 80
    act(page, chip.click)
    mended = settled(page)
    assert mended["document"]["method"] == "block"
    assert mended["painted"]["verdict"]["level"] != "bad"
    assert mended["probability"][7, 12] == 0
    playwright.expect(chip).to_be_hidden()
    page.get_by_role("status").get_by_text("Ready", exact=True).wait_for()


def numbers_along(page, part):
    """Choose a part of the trace; return what is written to its left, and the numbers below it."""
    page.evaluate("() => { window.written.length = 0; }")
    choose(page, part)
    for _ in range(2):
        page.evaluate("probes.nextFrame()")
    written = page.evaluate("window.written.filter(({ chart }) => chart)")
    assert all(0 <= word["left"] <= word["right"] <= word["wide"] for word in written), written
    below = [float(word["text"].replace(",", "")) for word in written if word["align"] == "center"]
    return [word["text"] for word in written if word["align"] != "center"], below


def test_two_methods_stand_side_by_side_under_one_slider_of_draws(open_page):
    page = open_page(document(**CLOSE, sweeps=20, burn_in=0))
    whole = settled(page)["transform"]["scale"]
    page.get_by_label("Keep this result beside the next").click()
    until(page, "s.beside !== null")
    page.get_by_text("Now: the same model and method.").wait_for()
    page.get_by_label("Method", exact=True).select_option("block")
    settled(page)
    page.get_by_text(re.compile("Kept: method ")).wait_for()
    assert snapshot(page)["beside"]["method"] == "gibbs"
    assert snapshot(page)["transform"]["scale"] < whole
    mean = snapshot(page)["beside"]["probability"]
    show_layer(page, "One draw")
    for draw in (0, 19):
        show_draw(page, draw, 1)
        until(page, f"s.beside.layer === 'draw' && s.beside.draw === {draw} && s.beside.chain === 1")
        assert set(snapshot(page)["beside"]["probability"]) <= {0, 255}
    assert snapshot(page)["beside"]["probability"] != mean
    page.get_by_label("Keep this result beside the next").click()
    until(page, f"s.beside === null && s.transform.scale === {whole}")


@pytest.mark.parametrize("noise", [0.2, 0.01], ids=["short numbers", "long numbers"])
def test_traces_of_all_chains_are_drawn_with_axes_whose_numbers_are_whole(open_page, noise):
    page = open_page(document(noise=noise, method="gibbs", start="prior"))
    settled(page)
    page.evaluate("probes.recordWriting()")
    run(page, 2000)  # 1000 sweeps of Live, and as many more
    trace, sweeps = page.evaluate("() => ['trace', 'traced'].map((name) => [...bayesmap.snapshot().painted[name]])")
    trace = np.reshape(trace, (2, -1))
    assert (sweeps[:100], sweeps[-1]) == (list(range(1, 101)), 2000)
    assert np.isfinite(trace).all()
    assert not np.array_equal(trace[0], trace[1])
    chart, canvas = page.locator(".chart").first, page.locator(".chart canvas").first
    assert len(chart.get_attribute("data-sweeps").split(",")) > 200
    lines = 2 if noise == 0.2 else 1  # with little noise one chain is far below the other's scale
    assert sum(count > 20 for count in canvas.evaluate("probes.inked")) >= lines
    log_joint, below = numbers_along(page, "First 50")
    assert chart.get_attribute("data-sweeps") == ",".join(map(str, range(1, 51)))
    assert sum(count > 20 for count in canvas.evaluate("probes.inked")) >= lines
    assert min(len(log_joint), len(below)) > 1
    assert max(below) <= 50
    assert max(map(len, log_joint)) >= (8 if noise < 0.1 else 3)
    assert max(numbers_along(page, "All")[1]) == 2000


@pytest.mark.full
def test_the_bar_on_a_runs_trace_is_at_the_draw_on_show(open_page, room):
    """The room's run made ten sweeps of warm-up before its ten draws: sweeps are not draws."""
    page = open_page(room[1])
    playwright.expect(page.get_by_text("log joint by draw")).to_be_visible()
    page.evaluate("probes.recordBars()")
    show_draw(page, 9)
    until(page, "window.bars.length > 0")
    middle, right = page.evaluate("window.bars.at(-1)")
    assert middle == pytest.approx(right, abs=3)  # the last draw is at the axis's end
