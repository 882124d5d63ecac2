"""A telephone: 390 x 844, fingers."""

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import NO_WALLS, centre, document, settled, snapshot, until
from page_hands import choose

PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True, "device_scale_factor": 2}


@pytest.fixture
def phone(open_page):
    page = open_page(document(walls=NO_WALLS), **PHONE)
    settled(page)
    return page


def fingers(page):
    """Puts fingers on the screen, moves them, takes them off."""
    session = page.context.new_cdp_session(page)

    def touch(kind, *points):
        touches = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})

    return touch


@pytest.fixture
def touch(phone):
    return fingers(phone)


def test_a_finger_draws_and_a_tap_draws_one_cell(phone, touch):
    touch("touchStart", centre(phone, 3, 3))
    for x in (5, 9, 13):
        touch("touchMove", centre(phone, x, 3))
    touch("touchEnd")
    until(phone, "s.walls.reduce((a, b) => a + b) === 11")
    phone.touchscreen.tap(*centre(phone, 5, 17))
    until(phone, "s.walls.reduce((a, b) => a + b) === 12")
    assert settled(phone)["walls"][5, 17]


@pytest.mark.full
def test_two_fingers_zoom_and_draw_nothing(phone, touch):
    scale = snapshot(phone)["transform"]["scale"]
    x, y = centre(phone, 10, 10)
    touch("touchStart", (x - 30, y), (x + 30, y))  # together: the page waits for a second finger for 90 ms only
    for spread in (40, 60, 90):
        touch("touchMove", (x - spread, y), (x + spread, y))
    touch("touchEnd")
    until(phone, f"s.transform.scale > {scale * 2}")
    phone.wait_for_timeout(200)
    assert settled(phone)["walls"].sum() == 0
    assert np.allclose(centre(phone, 10, 10), (x, y), atol=12)


@pytest.mark.full
def test_a_finger_moves_the_robot(phone, touch):
    choose(phone, "Sensor")
    touch("touchStart", centre(phone, 10, 10))
    for step in (9, 7, 5):
        touch("touchMove", centre(phone, step, 10))
    touch("touchEnd")
    until(phone, "Math.abs(s.sensors[0].x - 5) < 0.2 && s.painted.generation === s.generation")


def test_everything_fits_and_fingers_find_it(phone):
    wide = phone.evaluate("document.documentElement.scrollWidth")
    assert wide <= 390
    for role, name in (("button", "Run"), ("button", "Undo"), ("radio", "Erase"), ("button", "Whole map")):
        box = phone.get_by_role(role, name=name, exact=True).bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
        assert min(box["width"], box["height"]) >= 34
    phone.get_by_role("slider", name="Prior").fill("0.2")  # reached by scrolling the panel
    until(phone, "s.document.prior === 0.2")
    low, high = centre(phone, 0, 0), centre(phone, 20, 20)
    assert 0 < low[0] < high[0] < 390
    assert 0 < high[1] < low[1] < 844 * 0.6


TOOLS = ("Draw", "Pan", "Where am I?", "Ghost")


@pytest.mark.full
@pytest.mark.parametrize(("width", "height"), [(844, 390), (320, 640)], ids=["in landscape", "small"])
def test_other_phones_have_a_large_map_every_tool_and_a_whole_status(open_page, room, width, height):
    phone = {**PHONE, "viewport": {"width": width, "height": height}}
    page = open_page(document(), **phone)
    settled(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    buttons = [("button", name) for name in ("Whole map", "Export", "Run")]
    for role, name in (*[("radio", tool) for tool in TOOLS], *buttons):
        box = page.get_by_role(role, name=name, exact=True).bounding_box()
        assert 0 <= box["x"] <= box["x"] + box["width"] <= width
        assert 0 <= box["y"] <= box["y"] + box["height"] <= height
    assert 21 * snapshot(page)["transform"]["scale"] > 0.7 * min(width, height)
    page = open_page(room[1], **phone)
    status = page.locator("footer").get_by_role("status")
    playwright.expect(status).to_have_text("Ready, but the chains have not converged")
    wide, room_for_it = status.evaluate("(status) => [status.scrollWidth, status.clientWidth]")
    assert wide <= room_for_it + 1
    playwright.expect(page.get_by_text("Touch a cell")).to_be_visible()
    choose(page, "Ghost")
    until(page, "s.ghost.fan")
    touch = fingers(page)
    touch("touchStart", centre(page, 6, 20))
    for cell in ((10, 20), (12, 12)):
        touch("touchMove", centre(page, *cell))
    touch("touchEnd")
    until(page, "Math.abs(s.ghost.fan.x - 2.5) < 0.05 && Math.abs(s.ghost.fan.y - 2.5) < 0.05")
    for chip in page.locator(".chip:visible").all():
        assert chip.bounding_box()["x"] + chip.bounding_box()["width"] <= width
