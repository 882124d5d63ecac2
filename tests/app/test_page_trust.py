"""The page says how far its numbers can be trusted, and what to do where they cannot."""

import base64

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import NEXT_FRAME, document, settled, snapshot, until, watch
from page_hands import act, choose, press, run, show_draw, slide

CLOSE = {"sensors": [{"id": 1, "x": 7.0, "y": 11.0, "yaw": 0.0}], "noise": 1.0, "prior": 0.05, "method": "gibbs"}
"""A noisy sensor beside rare walls: single-site chains keep a wall at (7, 12) that is not there."""


def with_walls(**changes):
    """The same with some walls drawn near y = 14, after which two chains that start alike agree on a wrong answer."""
    cells = np.unpackbits(np.frombuffer(base64.b64decode(document()["walls"]), np.uint8), count=441).reshape(21, 21)
    cells[4:9, 14] = 1
    return document(walls=base64.b64encode(np.packbits(cells.ravel()).tobytes()).decode(), **{**CLOSE, **changes})


@pytest.mark.parametrize(
    "walls", [False, pytest.param(True, marks=pytest.mark.full)], ids=["the tutorial's map", "with walls"]
)
def test_chains_that_disagree_are_called_so_and_a_click_mends_it(open_page, walls):
    page = open_page(with_walls() if walls else document(**CLOSE))
    shown = settled(page)
    assert shown["painted"]["verdict"]["level"] == "bad"
    chip = page.get_by_role("button", name="Not converged: try blocks")
    chip.wait_for()
    page.get_by_role("status").get_by_text("have not converged").wait_for()
    assert page.locator("dd.bad").count() == 2
    wrong = shown["probability"][7, 12]
    act(page, chip.click)
    mended = settled(page)
    assert mended["document"]["method"] == "block"
    assert mended["painted"]["verdict"]["level"] != "bad"
    assert mended["probability"][7, 12] == 0
    assert wrong > 80
    playwright.expect(chip).to_be_hidden()
    page.get_by_role("status").get_by_text("Ready", exact=True).wait_for()


@pytest.mark.full
def test_where_walls_are_rare_blocks_are_the_default_and_the_tutorial_s_chains_are_called_converged(open_page):
    page = open_page(document(**{**CLOSE, "method": "auto"}))
    shown = settled(page)
    assert shown["painted"]["method"] == "block"
    assert shown["painted"]["verdict"]["level"] != "bad"
    slide(page, "Prior", 0.5)
    assert settled(page)["painted"]["method"] == "gibbs"
    page = open_page(document())
    assert settled(page)["painted"]["verdict"]["level"] == "good"
    assert page.locator("dd.good").count() == 2
    assert page.locator(".verdict").inner_text().startswith("Converged")


def test_traces_of_all_chains_are_drawn_with_axes(open_page):
    page = open_page(document(start="prior"))
    settled(page)
    run(page, 2000)  # those of Live, and as many more
    painted = page.evaluate("() => { const p = bayesmap.snapshot().painted; return [[...p.trace], [...p.traced]]; }")
    trace, sweeps = np.array(painted[0]).reshape(2, -1), np.array(painted[1])
    assert (sweeps[0], sweeps[-1]) == (1, 2000)
    assert np.array_equal(sweeps[:100], np.arange(1, 101))
    assert np.isfinite(trace).all()
    assert not np.array_equal(trace[0], trace[1])
    drawn = page.locator(".chart").first
    apart = np.diff([int(sweep) for sweep in drawn.get_attribute("data-sweeps").split(",")])
    assert apart[:-1].max() < 2 * apart[:-1].min()  # the first sweeps no denser than the rest
    assert len(apart) > 200
    canvas = page.locator(".chart canvas").first
    assert canvas.bounding_box()["width"] > 200
    inked = """(canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const near = (i, r, g, b) => data[i + 3] > 100 && Math.hypot(data[i] - r, data[i + 1] - g, data[i + 2] - b) < 60;
      let blue = 0, orange = 0;
      for (let i = 0; i < data.length; i += 4) { blue += near(i, 0, 114, 178); orange += near(i, 213, 94, 0); }
      return [blue, orange];
    }"""
    assert min(canvas.evaluate(inked)) > 20  # a line a chain
    choose(page, "First 50")
    page.evaluate(NEXT_FRAME)
    assert drawn.get_attribute("data-sweeps") == ",".join(map(str, range(1, 51)))
    assert min(page.locator(".chart canvas").first.evaluate(inked)) > 20


@pytest.mark.full
def test_from_the_empty_map_the_first_sweeps_can_be_watched(open_page):
    page = open_page(document(start="empty", sweeps=30))
    run(page, 60)
    shown = snapshot(page)
    mean, observed = shown["probability"] > 128, shown["observed"] > 0
    page.get_by_label("Speed").select_option("30")
    watch(page, "s.painted.layer === 'draw' ? s.painted.draw : -1")
    press(page, "From the first sweep")
    until(page, "s.painted.layer === 'draw' && s.painted.draw === 59 && window.seen.includes(0)")
    last, first = (int(((show_draw(page, draw) > 128) != mean)[observed].sum()) for draw in (59, 0))
    assert last <= first


def test_importance_sampling_shows_its_weights(open_page):
    page = open_page(document(method="importance", sweeps=5000))
    run(page)
    until(page, "!s.running && s.painted.method === 'importance' && s.painted.sweeps === 5000")
    counts = page.evaluate("[...bayesmap.snapshot().painted.weights]")
    assert sum(counts) == 5000
    assert counts[-1] >= 1
    assert snapshot(page)["painted"]["verdict"]["level"] == "bad"
    page.get_by_role("img", name="Histogram of the particles").wait_for()
    act(page, lambda: press(page, "Collapsed: try Gibbs"))
    assert settled(page)["painted"]["method"] == "gibbs"
