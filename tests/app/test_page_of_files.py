"""What the page says and offers of a log, a run and a drawn map: each what is true of it."""

import re

import playwright.sync_api as playwright
import pytest
from building_log import write_room_log
from page_driver import act, centre, document, served, settled, show_layer, snapshot, until


@pytest.fixture(scope="module")
def log(tmp_path_factory, browser):
    with served(write_room_log(tmp_path_factory.mktemp("log") / "room.log")) as (address, _):
        yield address


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


def help_of(page):
    page.keyboard.press("?")
    dialog = page.get_by_role("dialog", name="Help")
    dialog.wait_for()
    return dialog


def test_help_and_share_speak_of_what_is_open(open_page, log, room):
    drawn, of_log, of_run = open_page(document()), open_page(log), open_page(room[1])
    for page, wanted, unwanted in (
        (drawn, ["Draw walls", "draw, erase, sensor", "run, cancel", "Shift or the right"], ["this log", "saved run"]),
        (of_log, ["scans of this log", "run, cancel", "pan, path"], ["Draw walls", "draw, erase", "add, remove"]),
        (of_run, ["saved run", "(width)", "pan, path"], ["Draw walls", "draw, erase", "run, cancel", "(entropy)"]),
    ):
        dialog = help_of(page)
        for words in wanted:
            playwright.expect(dialog.get_by_text(words).first).to_be_visible()
        for words in unwanted:
            playwright.expect(dialog.get_by_text(words)).not_to_be_visible()
        page.keyboard.press("Escape")
        page.get_by_role("button", name="Share").click()
        said = page.get_by_role("dialog", name="Share").inner_text()
        assert ("holds the walls" in said) == (page is drawn)
        assert ("no scans" in said) == (page is not drawn)
        page.keyboard.press("Escape")
    assert not of_log.get_by_role("button", name="Clear walls").is_visible()


def test_h_shows_the_width_where_entropy_would_mean_nothing(open_page, room):
    page = open_page(room[1])
    page.keyboard.press("h")
    until(page, "s.painted.layer === 'width'")
    playwright.expect(page.get_by_role("radio", name="Width")).to_be_checked()


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


def test_chains_that_were_cancelled_are_said_to_have_stopped(open_page):
    page = open_page(document(sweeps=100_000))
    until(page, "s.painted.sweeps > 20")
    cancel = page.get_by_role("button", name="Cancel")
    cancel.click()
    playwright.expect(page.get_by_text(re.compile(r"^\d+ of 100000 sweeps, stopped$"))).to_be_visible()
    playwright.expect(cancel).to_be_disabled()


def test_the_legend_is_of_what_is_on_show_until_there_are_intervals(open_page, log):
    page = open_page(log)
    page.get_by_role("checkbox", name="Live").uncheck()
    act(page, lambda: page.get_by_role("combobox", name="Cells").select_option("surface"))
    scrubber = page.get_by_role("slider", name="Scans used")
    scrubber.evaluate("(slider) => { slider.value = 6; slider.dispatchEvent(new Event('input')); }")  # still held
    until(page, "s.painted.generation === s.generation && s.painted.method === 'hits'")
    show_layer(page, "Width")
    until(page, "s.view.layer === 'width' && s.seq.confirmed === s.seq.sent")
    assert "width" not in page.get_by_role("list", name="Legend").inner_text()
    act(page, lambda: scrubber.fill("12"))
    page.get_by_role("checkbox", name="Live").check()  # the server keeps it


def test_a_new_map_where_a_log_was_opened_is_its_own(open_page, log):
    page = open_page(log)
    until(page, "s.overlay?.trajectory === 12")
    page.get_by_role("button", name="New map").click()
    page.get_by_role("button", name="Create").click()
    until(page, "s.document.source.kind === 'simulation' && s.painted?.generation === s.generation")
    shown = settled(page)
    assert shown["overlay"] is None
    assert len(shown["scan"]["pose"]) == 3  # of one robot, not of the log's scans
    assert shown["document"]["grid"]["shape"] == [21, 21]
    page.get_by_role("checkbox", name="Trajectory").wait_for(state="hidden")
    act(page, lambda: page.get_by_role("button", name="Undo").click())
    until(page, "s.document.source.kind === 'log' && s.overlay?.trajectory === 12")


def test_space_chooses_where_to_look_from(open_page):
    page = open_page(document())
    settled(page)
    page.keyboard.press("l")
    until(page, "s.decisions.views?.nats.length > 5")
    page.keyboard.press("ArrowUp")
    act(page, lambda: page.keyboard.press("Space"))
    assert len(settled(page)["sensors"]) == 2


def test_space_erases_no_wall_with_a_tool_that_does_not_draw(open_page):
    page = open_page(document())
    before = settled(page)
    wall = next((x, 10) for x in range(11, 21) if before["walls"][x, 10])
    page.keyboard.press("l")
    until(page, "s.decisions.views")
    for _ in range(wall[0] - 10):
        page.keyboard.press("ArrowRight")
    for key in ("o", "w"):
        page.keyboard.press(key)
        page.keyboard.press("Space")
    page.wait_for_timeout(300)
    assert (settled(page)["walls"] == before["walls"]).all()
    assert snapshot(page)["seq"]["sent"] == before["seq"]["sent"]


def test_the_legend_names_what_each_tool_paints(open_page):
    page = open_page(document())
    settled(page)
    legend = page.get_by_role("list", name="Legend")
    for key, words, known in (
        ("w", "possible pose", "s.where.found"),
        ("l", "one more scan tells", "s.decisions.views"),
    ):
        playwright.expect(legend.get_by_text(words)).not_to_be_visible()
        page.keyboard.press(key)
        until(page, known)
        playwright.expect(legend.get_by_text(words)).to_be_visible()
    page.keyboard.press("v")
    playwright.expect(legend.get_by_text("speaks against it")).not_to_be_visible()
    page.mouse.click(*centre(page, 10, 12))
    playwright.expect(legend.get_by_text("speaks for it")).to_be_visible()
    playwright.expect(legend.get_by_text("speaks against it")).to_be_visible()
    page.keyboard.press("g")
    playwright.expect(legend.get_by_text("speaks against it")).not_to_be_visible()
    playwright.expect(legend.get_by_text("one more scan tells")).not_to_be_visible()
    for cell in ((6, 15), (10, 14)):
        page.mouse.click(*centre(page, *cell))
    until(page, "s.decisions.path")
    playwright.expect(legend.get_by_text("as wide as the robot")).to_be_visible()
