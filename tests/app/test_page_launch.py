"""The page opens, paints a posterior, asks nobody else, and says what it is to everybody."""

import numpy as np
import pytest
from page_driver import brightness_at, centre, colour_at, document, serious, settled, until
from page_hands import choose, enter, press, undo


def test_the_first_picture_is_the_posterior_of_the_tutorial_and_pixels_tell_what_is_known(page):
    for label in ("Rays", "Readings"):
        page.get_by_role("checkbox", name=label).uncheck()
    shown = settled(page)
    assert shown["document"]["grid"]["shape"] == [21, 21]
    assert shown["connected"]
    assert shown["painted"]["method"] == "gibbs"
    assert not shown["painted"]["approximate"]
    p, seen, walls = shown["probability"] / 255, shown["observed"] > 0, shown["walls"] > 0
    assert 100 < seen.sum() < 400
    assert p[seen & walls].mean() > 0.7
    assert p[seen & ~walls].mean() < 0.05
    assert abs(p[~seen].mean() - 0.5) < 0.05
    free = colour_at(page, 10, 12)
    assert seen[10, 12]
    assert brightness_at(page, 10, 12) > 235
    assert brightness_at(page, *np.argwhere(seen & (p > 0.98))[0].tolist()) < 90
    assert not seen[20, 0]
    red, _, blue = colour_at(page, 20, 0)
    assert red - blue > 12  # warm: hatched where nothing was observed
    assert free[0] - free[2] < 6  # not warm
    theme = page.get_by_role("button", name="Theme")
    for name, bright in (("light", True), ("dark", False), ("automatic", True)):
        theme.click()
        assert theme.get_attribute("aria-label") == f"Theme: {name}"
        assert (brightness_at(page, 10, 12) > 190) == bright
    page.mouse.move(*centre(page, 10, 12))  # zoomed in on, a cell is even up to its corners
    for _ in range(8):
        page.mouse.wheel(0, -240)
    until(page, "s.transform.scale > 80")
    assert min(brightness_at(page, 10, 12, (off, off)) for off in (0.3, -0.3)) > 235


SCHEMES = pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.full)])


@SCHEMES
def test_axe_finds_no_serious_violation(open_page, scheme):
    page = open_page(document(), color_scheme=scheme, bypass_csp=True)
    settled(page)
    for reach in (lambda: None, lambda: page.keyboard.press("?"), lambda: press(page, "New map")):
        page.keyboard.press("Escape")
        reach()
        assert serious(page) == []


@pytest.mark.full
@SCHEMES
def test_axe_finds_none_on_a_run_and_its_answers_either(open_page, room, scheme):
    page = open_page(room[1], color_scheme=scheme, bypass_csp=True)
    for tool, known in (("Where am I?", "s.where.found"), ("Look next", "s.decisions.views")):
        choose(page, tool)
        until(page, known)
        assert serious(page) == []


def test_each_page_looks_where_it_likes_and_undoes_what_it_did(open_page, page):
    other = open_page(page.url)
    choose(other, "One draw")
    until(other, "s.painted.layer === 'draw'")
    enter(page, "Prior P(wall)", 0.45)
    assert settled(page)["painted"]["layer"] == "mean"
    until(other, "s.document.prior === 0.45 && s.painted.layer === 'draw' && s.painted.generation === s.generation")
    assert other.get_by_role("button", name="Undo").is_disabled()
    choose(other, "Mean")
    until(other, "s.painted.layer === 'mean'")
    assert np.array_equal(settled(other)["probability"], settled(page)["probability"])
    undo(page)


def test_the_tools_fit_into_a_window_of_any_width(open_page):
    page = open_page(document())
    for width in (
        1400, 1361, 1360, 1300, 1280, 1261, 1260, 1201, 1200, 1000, 901, 900, 800, 761, 760, 700, 641, 640, 451, 450,
        421, 420, 381, 380, 320,
    ):  # fmt: skip
        page.set_viewport_size({"width": width, "height": 860})
        until(page, "true")
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        whole, seen = page.locator(".bar").evaluate("(bar) => [bar.scrollWidth, bar.clientWidth]")
        assert whole <= seen, width
