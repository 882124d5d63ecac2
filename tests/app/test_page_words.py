"""Words beside the map: the evidence of beams about a cell, each beam by itself, and the numbers of a trace."""

import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import NEXT_FRAME, centre, colour_at, document, propagated, settled, snapshot, until
from page_hands import act, choose, click, press_and_drag, run, show_draw

from bayesmap.app.answers.evidence import strongest, summed, wall_ratios

BLUE, ORANGE = (0, 114, 178), (213, 94, 0)
TOLD = "s.evidence.each && s.evidence.together.x === argument[0] && s.evidence.together.y === argument[1]"


def inspect(page, x, y):
    """Click a cell with the tool for evidence, and wait for its beams."""
    click(page, x, y)
    until(page, TOLD, [x, y])
    return snapshot(page)["evidence"]


def number(text):
    return float(text.replace(",", "").replace("\u2212", "-"))


def test_the_read_out_and_a_click_say_how_many_beams_speak_for_a_wall_and_how_much_each(open_page):
    asked = document(method="propagate")
    scene, preview = propagated(asked)
    p_wall = preview.mean()
    page = open_page(asked)
    settled(page)
    choose(page, "Evidence")
    section = page.get_by_role("heading", name="Evidence of beams").locator("..")
    playwright.expect(section).to_contain_text("Click a cell")
    for is_wall, cells in ((True, p_wall > 0.9), (False, p_wall < 0.1)):
        sure = np.argwhere(preview.observed() & cells)
        x, y = sure[len(sure) // 2].tolist()
        ratios = wall_ratios(scene.problem.table, p_wall.ravel(), x * p_wall.shape[1] + y)
        known, expected = summed(ratios), strongest(ratios, scene.scans)
        page.mouse.move(*centre(page, x, y))
        read_out = page.locator(".readout")
        read_out.get_by_text(f"Cell {x}, {y}").wait_for()
        read_out.get_by_text("nats").wait_for()
        pattern = r"(\d+) beams?\b.*for a wall (\d+), ([\d.]+) nats.*against (\d+), ([\d.]+) nats"
        beams, beams_for, nats_for, against, nats = map(float, re.search(pattern, read_out.inner_text()).groups())
        assert (beams, beams_for, against) == (known.beams, known.beams_for, known.beams_against)
        assert (nats_for, nats) == pytest.approx((known.nats_for, known.nats_against), abs=0.051)
        assert (nats_for > nats) == is_wall
        found = inspect(page, x, y)["each"]
        for name, values in expected.items():
            np.testing.assert_allclose(np.ravel(found[name]), values.ravel(), atol=1e-6, err_msg=name)
        words = section.inner_text()
        assert f"For a wall (blue) {known.beams_for}, {known.nats_for:.1f} nats" in words
        assert f"against (orange) {known.beams_against}, {known.nats_against:.1f} nats" in words
        listed = re.findall(r"([+\u2212])([\d.]+) nats: beam (\d+) of sensor (\d+)", words)
        assert len(listed) == min(8, len(expected["nats"]))
        assert listed[0][1] == f"{abs(expected['nats'][0]):.1f}"
        assert int(listed[0][2]) == expected["beam"][0] + 1
        assert int(listed[0][3]) == scene.ids[int(expected["scan"][0])]
    assert not page.locator("canvas.rays").is_visible()  # the others would hide them


@pytest.mark.full
def test_beams_for_are_blue_and_against_orange_and_follow_the_map(open_page):
    page = open_page(document(method="propagate"))
    before = settled(page)
    for label in ("True walls", "Readings"):
        page.get_by_role("checkbox", name=label).uncheck()
    choose(page, "Evidence")
    wall = np.argwhere((before["observed"] == 1) & (before["probability"] > 250))[0].tolist()
    free = np.argwhere((before["observed"] == 1) & (before["probability"] < 5))
    floor = free[np.abs(free - np.array([10, 12])).sum(axis=1).argmin()].tolist()
    for cell, own, other in ((wall, BLUE, ORANGE), (floor, ORANGE, BLUE)):
        found = inspect(page, *cell)
        each = found["each"]
        assert (each["nats"][0] > 0) == (own is BLUE)
        start, end = np.reshape(each["start"], (-1, 2))[0], np.reshape(each["end"], (-1, 2))[0]
        colour = colour_at(page, *(start + 0.2 * (end - start)).tolist())
        assert np.abs(colour - own).sum() < np.abs(colour - other).sum(), colour
    choose(page, "Draw")
    x, y = floor
    act(page, lambda: press_and_drag(page, [(x - 1, y), (x + 1, y)]))
    settled(page)
    choose(page, "Evidence")
    until(page, "s.evidence.together && s.evidence.together.nats_for > argument + 1", found["together"]["nats_for"])


@pytest.mark.full
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_saved_run_of_surfaces_has_evidence_too(open_page, room, scheme):
    page = open_page(room[1], color_scheme=scheme)
    choose(page, "Evidence")
    # Of the wall in the room's middle: some cells of it a neighbour's long surface would do without.
    best = max(range(2, 18), key=lambda y: inspect(page, 20, y)["together"]["nats_for"])
    found = inspect(page, 20, best)
    assert found["together"]["nats_for"] > 5
    assert found["each"]["nats"][0] > 0
    section = page.get_by_role("heading", name="Evidence of beams").locator("..")
    assert re.search(r"For its surface \(blue\) \d+, [\d.]+ nats", section.inner_text())
    assert re.search(r"\+[\d.]+ nats: beam \d+ of scan \d+", section.inner_text())


LABELS = """
() => {
  // what is written on the trace's canvas from now on: text, and where it begins and ends, pixels
  window.written = [];
  const write = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...rest) {
    if (this.canvas.closest(".chart")) {
      const { a, e } = this.getTransform();
      const width = this.measureText(text).width;
      const from = x - { right: width, end: width, center: width / 2 }[this.textAlign] || x;
      window.written.push({ text, from: a * from + e, to: a * (from + width) + e, align: this.textAlign,
                            wide: this.canvas.width });
    }
    return write.call(this, text, x, y, ...rest);
  };
}
"""


def labels(page, part):
    """What is written along the trace when this part of it is chosen: numbers to its left, and below it."""
    page.evaluate("() => { window.written.length = 0; }")
    choose(page, part)
    page.evaluate(NEXT_FRAME)
    page.evaluate(NEXT_FRAME)
    left, below = [], []
    for one in page.evaluate("window.written"):
        assert 0 <= one["from"] <= one["to"] <= one["wide"], one
        (below if one["align"] == "center" else left).append(one["text"])
    return left, list(map(number, below))


@pytest.mark.parametrize(
    "noise", [pytest.param(0.2, marks=pytest.mark.full), 0.01], ids=["short numbers", "long numbers"]
)
def test_the_numbers_along_a_trace_are_whole_and_those_of_the_trace(open_page, noise):
    page = open_page(document(noise=noise, method="gibbs", start="prior", sweeps=1000))
    settled(page)
    page.evaluate(LABELS)
    run(page, 2000)
    trace = np.array(page.evaluate("[...bayesmap.snapshot().painted.trace]"))
    log_joint, sweeps = labels(page, "First 50")
    assert len(log_joint) > 1
    assert len(sweeps) > 1
    assert max(sweeps) <= 50
    slack = 0.1 * np.ptp(trace) + 1
    assert all(trace.min() - slack <= number(text) <= trace.max() + slack for text in log_joint)
    assert max(map(len, log_joint)) >= (8 if noise < 0.1 else 3)
    assert max(labels(page, "All")[1]) == 2000


BARS = """
() => {
  // where bars are drawn on the trace from now on, and how far it reaches, pixels
  window.bars = [];
  const fill = CanvasRenderingContext2D.prototype.fillRect;
  CanvasRenderingContext2D.prototype.fillRect = function (x, y, width, height) {
    const chart = this.canvas.closest?.(".chart");
    const over = chart?.querySelector(".u-over").getBoundingClientRect();
    const own = this.canvas.getBoundingClientRect();
    if (chart && width === 2) window.bars.push([x + 1, (over.right - own.left) * devicePixelRatio]);
    return fill.call(this, x, y, width, height);
  };
}
"""


@pytest.mark.full
def test_the_bar_on_a_runs_trace_is_at_the_draw_on_show(open_page, room):
    """The room's run made ten sweeps of warm-up before its ten draws: sweeps are not draws."""
    page = open_page(room[1])
    playwright.expect(page.get_by_text("log joint by draw")).to_be_visible()
    page.evaluate(BARS)
    show_draw(page, 9)
    until(page, "window.bars.length > 0")
    middle, right = page.evaluate("window.bars.at(-1)")
    assert middle == pytest.approx(right, abs=3)  # the last draw is at the axis's end
