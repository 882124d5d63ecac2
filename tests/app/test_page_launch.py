"""The page opens, paints a posterior, asks nobody else, and says what it is to everybody."""

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from page_driver import act, brightness_at, colour_at, document, settled, until


def test_the_first_picture_is_the_posterior_of_the_tutorial(page):
    shown = settled(page)
    assert shown["document"]["grid"]["shape"] == [21, 21]
    assert shown["connected"]
    assert shown["painted"]["method"] == "gibbs"
    assert not shown["painted"]["approximate"]
    p = shown["probability"] / 255
    seen, walls = shown["observed"] > 0, shown["walls"] > 0
    assert 100 < seen.sum() < 400
    assert p[seen & walls].mean() > 0.7
    assert p[seen & ~walls].mean() < 0.05
    assert abs(p[~seen].mean() - 0.5) < 0.05


def test_pixels_tell_free_cells_walls_and_hatched_unobserved_ones_apart(page):
    for label in ("Rays", "Readings"):
        page.get_by_role("checkbox", name=label).uncheck()
    shown = settled(page)
    free = colour_at(page, 10, 12)
    assert brightness_at(page, 10, 12) > 235
    assert shown["observed"][10, 12]
    sure = [
        (x, y) for x in range(21) for y in range(21) if shown["observed"][x, y] and shown["probability"][x, y] > 250
    ]
    assert brightness_at(page, *sure[0]) < 90
    assert not shown["observed"][20, 0]
    red, _, blue = colour_at(page, 20, 0)
    assert red - blue > 12  # warm
    assert free[0] - free[2] < 6  # not warm


@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.full)])
def test_axe_finds_no_serious_violation(open_page, scheme):
    page = open_page(document(), color_scheme=scheme, bypass_csp=True)
    settled(page)
    states = {"page": lambda: None, "help": lambda: page.keyboard.press("?"), "new map": lambda: press(page, "New map")}
    for name, reach in states.items():
        page.keyboard.press("Escape")
        reach()
        found = Axe().run(page).response["violations"]
        serious = [
            (rule["id"], rule["nodes"][0]["html"]) for rule in found if rule["impact"] in ("serious", "critical")
        ]
        assert serious == [], name


def press(page, name):
    page.get_by_role("button", name=name).click()


@pytest.mark.full
def test_light_and_dark_follow_the_system_and_the_button(open_page):
    page = open_page(document(), color_scheme="dark")
    settled(page)
    assert brightness_at(page, 10, 12) < 90
    button = page.get_by_role("button", name="Theme")
    button.click()
    assert button.get_attribute("aria-label") == "Theme: light"
    assert brightness_at(page, 10, 12) > 190  # a ray may cross it
    button.click()
    assert button.get_attribute("aria-label") == "Theme: dark"
    assert brightness_at(page, 10, 12) < 90


def test_each_page_looks_where_it_likes_and_undoes_what_it_did(open_page, page):
    other = open_page(page.url)
    other.get_by_role("radio", name="One draw").check()
    until(other, "s.painted.layer === 'draw'")
    act(page, lambda: page.get_by_label("Prior P(wall), number").fill("0.45") or page.keyboard.press("Tab"))
    assert settled(page)["painted"]["layer"] == "mean"
    until(other, "s.document.prior === 0.45 && s.painted.layer === 'draw' && s.painted.generation === s.generation")
    assert other.get_by_role("button", name="Undo").is_disabled()
    other.get_by_role("radio", name="Mean").check()
    until(other, "s.painted.layer === 'mean'")
    assert np.array_equal(settled(other)["probability"], settled(page)["probability"])
    act(page, lambda: page.get_by_role("button", name="Undo").click())


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
