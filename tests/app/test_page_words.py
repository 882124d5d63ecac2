"""What is written beside the map: the evidence for a wall in a cell, the numbers along a trace."""

import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import NEXT_FRAME, act, centre, document, propagated, settled, until

from bayesmap.app.answers.evidence import summed, wall_ratios

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


def number(text):
    return float(text.replace(",", "").replace("\u2212", "-"))


@pytest.mark.parametrize("cell", ["wall", pytest.param("free", marks=pytest.mark.full)])
def test_the_read_out_says_how_many_beams_speak_for_a_wall_and_how_much(open_page, cell):
    asked = document(method="propagate")
    scene, preview = propagated(asked)
    p_wall = preview.mean()
    sure = np.argwhere(preview.observed() & ((p_wall > 0.9) if cell == "wall" else (p_wall < 0.1)))
    x, y = map(int, sure[len(sure) // 2])
    page = open_page(asked)
    settled(page)
    page.mouse.move(*centre(page, x, y))
    read_out = page.locator(".readout")
    read_out.get_by_text("nats").wait_for()
    said = read_out.inner_text()
    assert said.startswith(f"Cell {x}, {y}")
    found = re.search(r"(\d+) beams?\b.*for a wall (\d+), ([\d.]+) nats.*against (\d+), ([\d.]+) nats", said)
    beams, beams_for, nats_for, beams_against, nats_against = map(float, found.groups())
    known = summed(wall_ratios(scene.problem.table, p_wall.ravel(), x * p_wall.shape[1] + y))
    assert (beams, beams_for, beams_against) == (known.beams, known.beams_for, known.beams_against)
    assert nats_for == pytest.approx(known.nats_for, abs=0.051)
    assert nats_against == pytest.approx(known.nats_against, abs=0.051)
    assert (nats_for > nats_against) == (cell == "wall")


def labels(page, part):
    """What is written along the trace when this part of it is chosen: numbers to its left, and below it."""
    page.evaluate("() => { window.written.length = 0; }")
    page.get_by_role("radio", name=part).check()
    page.evaluate(NEXT_FRAME)
    page.evaluate(NEXT_FRAME)
    written = page.evaluate("window.written")
    for one in written:
        assert one["from"] >= 0, one
        assert one["to"] <= one["wide"], one
    return [one["text"] for one in written if one["align"] != "center"], [
        number(one["text"]) for one in written if one["align"] == "center"
    ]


@pytest.mark.parametrize(
    "noise", [pytest.param(0.2, marks=pytest.mark.full), 0.002], ids=["short numbers", "long numbers"]
)
def test_the_numbers_along_a_trace_are_whole_and_those_of_the_trace(open_page, noise):
    page = open_page(document(noise=noise, method="gibbs", start="prior", sweeps=1000))
    settled(page)
    page.evaluate(LABELS)
    act(page, lambda: page.get_by_role("button", name="Run", exact=True).click())
    until(page, "!s.running && s.painted.sweeps === 1000 && s.painted.generation === s.generation")
    trace = np.array(page.evaluate("[...bayesmap.snapshot().painted.trace]"))
    log_joint, sweeps = labels(page, "First 50")
    assert len(log_joint) > 1
    assert len(sweeps) > 1
    assert max(sweeps) <= 50
    spread = np.ptp(trace)
    for text in log_joint:
        assert trace.min() - 0.1 * spread - 1 <= number(text) <= trace.max() + 0.1 * spread + 1
    assert max(map(len, log_joint)) >= (8 if noise < 0.01 else 3)
    assert max(labels(page, "All")[1]) == 1000


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
    page.get_by_role("slider", name="Draw number").fill("9")
    until(page, "s.painted.layer === 'draw' && s.painted.draw === 9")
    until(page, "window.bars.length > 0")
    middle, right = page.evaluate("window.bars.at(-1)")
    assert middle == pytest.approx(right, abs=3)  # the last draw is at the axis's end
