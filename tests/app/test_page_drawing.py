"""Walls under the hand: no gaps, one stroke one step of undo, and the picture follows."""

import io

import numpy as np
import pytest
from page_driver import NO_WALLS, brightness_at, centre, colour_at, document, settled, snapshot, still, until
from page_hands import act, choose, click, press, press_and_drag, show_layer, undo
from PIL import Image


def test_a_fast_drag_over_twenty_cells_leaves_no_gaps_and_one_undo_restores(open_page):
    page = open_page(document(walls=NO_WALLS))
    choose(page, "Draw")
    assert settled(page)["walls"].sum() == 0
    press_and_drag(page, [(0, 4), (6, 4), (19, 4)])  # the browser says where the hand was only twice
    until(page, "s.walls.reduce((a, b) => a + b) === 20")
    drawn = settled(page)
    assert np.array_equal(np.argwhere(drawn["walls"]), [(x, 4) for x in range(20)])
    assert (drawn["probability"][6:15, 4] > 200).mean() > 0.7  # and inference has seen it
    orange = colour_at(page, 8, 4, offset=(0, 0.5))
    assert orange[0] - orange[2] > 60
    undo(page)
    assert settled(page)["walls"].sum() == 0
    act(page, lambda: page.keyboard.press("Control+y"))
    assert settled(page)["walls"].sum() == 20


@pytest.mark.full
def test_walls_are_erased_and_cleared_and_a_cleared_inference_leaves_the_prior(page):
    before = settled(page)["walls"]
    assert before[12, 2:7].all()
    choose(page, "Erase")
    act(page, lambda: press_and_drag(page, [(12, 2), (12, 6)]))
    after = settled(page)["walls"]
    assert not after[12, 2:7].any()
    assert before.sum() - after.sum() == 5
    act(page, lambda: press(page, "Clear walls"))
    assert settled(page)["walls"].sum() == 0
    for _ in range(2):
        act(page, lambda: page.keyboard.press("Control+z"))
    assert np.array_equal(settled(page)["walls"], before)
    act(page, lambda: press(page, "Clear inference"))
    shown = snapshot(page)
    assert (shown["probability"] == 128).all()
    assert not shown["observed"].any()


@pytest.mark.full
def test_a_click_shows_no_frame_around_the_map_and_a_key_does(page):
    settled(page)
    outline = """() => getComputedStyle(document.querySelector("[data-bayesmap]").shadowRoot
      .querySelector("canvas[role=application]")).outlineStyle"""
    page.keyboard.press("p")
    click(page, 10, 14)
    assert page.evaluate(outline) == "none"
    page.keyboard.press("ArrowUp")
    assert page.evaluate(outline) != "none"


def test_a_new_map_of_another_size_can_be_undone(page):
    settled(page)
    press(page, "New map")
    page.get_by_label("World").select_option("blank")
    page.get_by_role("spinbutton", name="Width").fill("40")
    page.get_by_label("Height").fill("30")
    act(page, lambda: press(page, "Create"))
    assert settled(page)["walls"].shape == (40, 30)
    x, y = centre(page, 39, 29)
    assert 0 < x < 960
    assert 0 < y < 860
    act(page, lambda: page.keyboard.press("Control+z"))
    assert settled(page)["walls"].shape == (21, 21)


@pytest.mark.full
def test_zoom_and_pan_keep_cells_under_the_pointer_and_crisp(page):
    settled(page)
    for label in ("Rays", "Readings", "True walls"):
        page.get_by_role("checkbox", name=label).uncheck()
    before, at = snapshot(page)["transform"]["scale"], np.array(centre(page, 10, 12))
    pointer = np.floor(at)  # a wheel tells of whole pixels
    page.mouse.move(*pointer)
    for _ in range(8):
        page.mouse.wheel(0, -240)
    until(page, "s.transform.scale > 80")
    growth = snapshot(page)["transform"]["scale"] / before
    assert np.allclose(centre(page, 10, 12), pointer + growth * (at - pointer), atol=1.5)
    assert min(brightness_at(page, 10, 12, (off, off)) for off in (0.3, -0.3)) > 235
    choose(page, "Pan")
    x, y = centre(page, 10, 12)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 50, y + 40)
    page.mouse.up()
    assert np.allclose(centre(page, 10, 12), (x + 50, y + 40), atol=1.5)
    page.keyboard.press("0")
    until(page, "s.transform.scale < 40")


def test_each_layer_is_painted_only_when_what_it_shows_changes(page):
    settled(page)

    def paints(action, *expected):
        still(page)
        before = snapshot(page)["layers"]
        action()
        until(page, "argument.every(([name, count]) => s.layers[name] > count)", [[n, before[n]] for n in expected])
        still(page)
        found = {name for name, count in snapshot(page)["layers"].items() if count > before[name]}
        assert found == set(expected)

    page.mouse.move(*centre(page, 10, 14))
    paints(lambda: page.mouse.move(*centre(page, 12, 15)), "cursor")
    page.mouse.move(600, 20)
    paints(lambda: page.get_by_role("checkbox", name="Rays").uncheck(), "rays")
    paints(lambda: page.get_by_role("checkbox", name="True walls").uncheck(), "marks")
    paints(lambda: choose(page, "Entropy"), "field")
    show_layer(page, "Mean")
    # sheets with nothing on them are hidden, and not painted
    hidden = page.locator(".stage canvas").evaluate_all(
        "(all) => all.filter((one) => getComputedStyle(one).visibility === 'hidden').map((one) => one.className)"
    )
    assert set(hidden) == {"hypothesis", "overlay", "reading", "evidence", "decisions", "where", "ghost"}
    paints(lambda: page.keyboard.press("+"), "field", "rays", "marks", "cursor")


@pytest.mark.parametrize("height", [860, *(pytest.param(odd, marks=pytest.mark.full) for odd in (861, 777))])
def test_zoom_and_cursors_leave_nothing_behind(open_page, height):
    page = open_page(document(), viewport={"width": 1280, "height": height})
    settled(page)

    def picture():
        still(page)
        shot = page.screenshot(clip=page.locator("main.stage").bounding_box())
        return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"), dtype=int)

    before = picture()
    choose(page, "Pan")
    page.mouse.move(*centre(page, 10, 1))
    assert np.abs(picture() - before).max() > 30  # a cursor that stayed would be noticed
    for turn in (-240, -240, -240, 240, -100):
        page.mouse.wheel(0, turn)
        press_and_drag(page, [(10, 10), (10, 12), (9, 8)])
        page.mouse.move(480, height - 60)
        still(page)
    page.mouse.move(600, 20)
    page.keyboard.press("0")
    choose(page, "Draw")
    # A rounded corner that is painted anew may come out a level of 255 off, where the browser puts layers together.
    assert np.abs(picture() - before).max() <= 3
