"""The legend: what it names, and that the map does not move when it names more."""

import playwright.sync_api as playwright
import pytest
from page_driver import END, centre, document, settled, until
from page_hands import choose, click, press, show_layer

HEIGHTS = """() => {
  const inside = document.querySelector("[data-bayesmap]").shadowRoot;
  return [".stage", ".legend"].map((part) => inside.querySelector(part).getBoundingClientRect().height);
}"""
PHONE = {"has_touch": True, "is_mobile": True}


def legend(page):
    """The legend of a page, as it is seen."""
    return page.get_by_role("list", name="Legend")


@pytest.mark.parametrize("width", [1280, pytest.param(1000, marks=pytest.mark.full)])
def test_the_map_stays_where_it_is_while_the_legend_of_a_run_grows(open_page, room, width):
    page = open_page(room[1], viewport={"width": width, "height": 860})
    heights, place = page.evaluate(HEIGHTS), centre(page, 20, 10)

    def unmoved(known, words):
        until(page, known)
        playwright.expect(legend(page).get_by_text(words)).to_be_visible()
        assert page.evaluate(HEIGHTS) == heights
        assert centre(page, 20, 10) == place

    choose(page, "Path")
    at = page.evaluate(END, 30)
    page.mouse.move(at["x"], at["y"])
    unmoved("s.reading.picked", "predicted reading")
    click(page, 6, 12)
    click(page, 8, 15)
    unmoved("s.decisions.path", "as wide as the robot")
    choose(page, "Where am I?")
    unmoved("s.where.found", "possible pose")
    choose(page, "Look next")
    unmoved("s.decisions.views", "one more scan tells")
    page.get_by_role("checkbox", name="Draws over the mean").check()
    unmoved("s.over", "this draw")
    show_layer(page, "Width")
    unmoved("s.painted.layer === 'width'", "width of the 90 % interval")


@pytest.mark.full
def test_it_stays_on_a_drawn_map_too(open_page):
    page = open_page(document(), viewport={"width": 1000, "height": 860})
    settled(page)
    heights = page.evaluate(HEIGHTS)
    for tool, known, words in (
        ("Where am I?", "s.where.found", "possible pose"), ("Look next", "s.decisions.views", "one more scan tells"),
        ("Ghost", "s.ghost.fan", "predicted reading"), ("Entropy", "s.view.layer === 'entropy'", "entropy (bit)"),
    ):  # fmt: skip
        choose(page, tool)
        until(page, known)
        playwright.expect(legend(page).get_by_text(words)).to_be_visible()
        assert page.evaluate(HEIGHTS) == heights


@pytest.mark.full
def test_phones_have_colours_and_numbers_in_one_row_or_a_legend_beside_the_map(open_page, room):
    page = open_page(room[1], **PHONE, viewport={"width": 320, "height": 720})
    first = legend(page).locator("li").first
    ramp, scale = (first.locator(part).bounding_box() for part in (".ramp", ".scale"))
    assert scale["height"] < 2 * ramp["height"]
    assert scale["x"] + scale["width"] <= 320
    assert first.locator(".scale").inner_text().split() == ["0", "1"]
    page = open_page(room[1], **PHONE, viewport={"width": 844, "height": 390})
    stage = page.locator(".stage").bounding_box()
    assert stage["height"] == 390
    for words in ("ray", "unobserved"):
        box = legend(page).get_by_text(words, exact=True).bounding_box()
        assert box["x"] >= stage["x"] + stage["width"]
        assert box["y"] + box["height"] <= 390


@pytest.mark.full
def test_where_surfaces_are_too_small_to_be_drawn_it_says_so(open_page, room):
    page = open_page(room[1], viewport={"width": 400, "height": 568})
    playwright.expect(legend(page).get_by_text("surface", exact=True)).to_be_visible()
    page.mouse.move(*centre(page, 20, 15))
    for _ in range(20):
        page.mouse.wheel(0, 200)
    until(page, "s.transform.scale < 2.5")
    playwright.expect(legend(page).get_by_text("surface (zoom in)")).to_be_visible()
    playwright.expect(page.get_by_role("checkbox", name="Surfaces (zoom in)")).to_be_visible()
    press(page, "Whole map")
    until(page, "s.transform.scale > 2.5")
    playwright.expect(legend(page).get_by_text("surface", exact=True)).to_be_visible()


WRITTEN = """() => {
  window.written = [];
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
    const wide = this.measureText(text).width;
    const left = x - { left: 0, start: 0, center: wide / 2, right: wide, end: wide }[this.textAlign];
    window.written.push({ text, left, right: left + wide, y });
    fillText.apply(this, arguments);
  };
}"""
"""From now on `window.written` is what is written on canvases, and where."""


@pytest.mark.full
def test_the_axis_s_unit_stands_apart_from_its_numbers(open_page, room):
    page = open_page(room[1], viewport={"width": 320, "height": 720})
    page.evaluate(WRITTEN)
    page.set_viewport_size({"width": 330, "height": 720})
    until(page, "window.written.some(({ text }) => text === 'm')")
    written = page.evaluate("window.written")
    unit = next(word for word in written if word["text"] == "m")
    numbers = [word for word in written if word["y"] == unit["y"] and word["text"] != "m"]
    assert len(numbers) > 2
    assert unit["left"] >= 0
    assert min(number["left"] for number in numbers) - unit["right"] > 8
