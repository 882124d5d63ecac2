"""The page opens and paints a posterior, and follows hands: by mouse, keys and fingers."""

import io

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import (
    NO_WALLS,
    brightness_at,
    centre,
    colour_at,
    document,
    serious,
    settled,
    snapshot,
    still,
    until,
    watch,
)
from page_hands import act, choose, click, enter, press, press_and_drag, show_layer, undo
from PIL import Image
from tiers import pairs_but


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


PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True, "device_scale_factor": 2}


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


def test_each_layer_is_painted_only_when_what_it_shows_changes(page):
    settled(page)

    def paints(action, *expected):
        still(page)
        before = snapshot(page)["layers"]
        action()
        until(page, "argument.every(([name, count]) => s.layers[name] > count)", [[n, before[n]] for n in expected])
        still(page)
        assert {name for name, count in snapshot(page)["layers"].items() if count > before[name]} == set(expected)

    page.mouse.move(*centre(page, 10, 14))
    paints(lambda: page.mouse.move(*centre(page, 12, 15)), "cursor")
    page.mouse.move(600, 20)
    paints(lambda: page.get_by_role("checkbox", name="Rays").uncheck(), "rays")
    paints(lambda: page.get_by_role("checkbox", name="True walls").uncheck(), "marks")
    paints(lambda: choose(page, "Entropy"), "field")
    show_layer(page, "Mean")
    # sheets with nothing on them are hidden, and not painted
    hidden = page.locator(".stage > canvas").evaluate_all(
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


def test_the_posterior_is_painted_while_the_robot_is_dragged(page):
    choose(page, "Sensor")
    before = settled(page)
    watch(page, "s.painted.generation")
    page.mouse.move(*centre(page, 10, 10))
    page.mouse.down()
    for k in range(1, 31):
        page.mouse.move(*centre(page, 10 - k / 10, 10 - k / 15))
        if k % 5 == 0:  # a picture now and then, however slow the machine: the hand is still there
            until(page, "s.painted.generation > argument", before["generation"] + k // 5 - 1)
    page.mouse.up()
    after = settled(page)
    seen = np.array(page.evaluate("window.seen"))
    moved = after["sensors"][0]
    assert [moved["x"], moved["y"]] == pytest.approx([7.0, 8.0], abs=0.06)
    assert len(seen) > 5
    assert (np.diff(seen) > 0).all()  # never an older picture
    assert len(after["events"]["eventToPaint_ms"]) >= 20
    assert after["scan"]["pose"] == pytest.approx([moved["x"], moved["y"], 0.0])
    act(page, lambda: page.keyboard.press("Control+z"))  # the whole drag is one step
    assert settled(page)["sensors"] == before["sensors"]


CONTROLS = (
    "New map,Share,Export,Help,Draw,Zoom in,Whole map,Run,Live,Mean,True walls,Rays,Readings,Prior P(wall),Noise (m),"
    "Angles,Method,Order,Sweeps,Seed,Clear walls,Clear inference,Selected sensor,Add a sensor"
)


def test_every_control_is_reached_by_tab_and_shows_its_focus(page):
    settled(page)
    reached = []
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("probes.focus()"))
    reached = [entry for entry in reached if entry]
    names = {name for name, _, _ in reached}
    assert all(seen for _, seen, _ in reached), [name for name, seen, _ in reached if not seen]
    assert set(CONTROLS.split(",")) <= names
    assert any(name.startswith("Map, 21 by 21") for name in names)
    assert any(name.startswith("Theme") for name in names)


def test_help_and_menus_open_and_close_by_keys_and_a_click_shows_no_frame_around_the_map(page):
    settled(page)
    export = page.get_by_role("button", name="Export")
    for key, expanded in (("Enter", "true"), ("Escape", "false")):
        export.press(key)
        assert export.get_attribute("aria-expanded") == expanded
    assert not page.get_by_role("button", name="Picture (PNG)").is_visible()
    page.keyboard.press("d")
    page.keyboard.press("?")
    dialog = page.get_by_role("dialog", name="Help")
    dialog.wait_for()
    page.keyboard.press("e")  # no shortcut while the dialog is open
    assert page.get_by_role("radio", name="Draw", exact=True).is_checked(timeout=1000)
    page.keyboard.press("Escape")
    dialog.wait_for(state="hidden")
    assert page.evaluate("probes.focus()")[1:] == [True, "CANVAS"]
    page.keyboard.press("p")
    click(page, 10, 14)
    assert page.evaluate("probes.focus()")[1:] == [False, "CANVAS"]
    page.keyboard.press("ArrowUp")
    assert page.evaluate("probes.focus()")[1:] == [True, "CANVAS"]


@pytest.fixture
def phone(open_page):
    page = open_page(document(walls=NO_WALLS), **PHONE)
    settled(page)
    return page


def drag_a_finger(page, *cells):
    session = page.context.new_cdp_session(page)

    def touch(kind, *points):
        touches = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})

    for i, cell in enumerate(cells):
        touch("touchMove" if i else "touchStart", centre(page, *cell))
    touch("touchEnd")


def test_a_finger_draws_and_a_tap_draws_one_cell(phone):
    drag_a_finger(phone, (3, 3), (5, 3), (9, 3), (13, 3))
    until(phone, "s.walls.reduce((a, b) => a + b) === 11")
    phone.touchscreen.tap(*centre(phone, 5, 17))
    until(phone, "s.walls.reduce((a, b) => a + b) === 12")
    assert settled(phone)["walls"][5, 17]


SIZES = [(390, 844), (844, 390), (320, 640)]


@pytest.mark.parametrize(("width", "height"), pairs_but(SIZES, (390, 844)))
def test_a_phone_has_a_large_map_and_every_tool_in_reach_of_a_finger(open_page, width, height):
    page = open_page(document(), **{**PHONE, "viewport": {"width": width, "height": height}})
    settled(page)
    page.get_by_role("button", name="More tools").click()
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    tools = [("radio", tool) for tool in ("Draw", "Erase", "Pan", "Where am I?", "Ghost")]
    buttons = [("button", name) for name in ("Fewer tools", "Undo", "Whole map", "Export", "Run")]
    for role, name in (*tools, *buttons):
        box = page.get_by_role(role, name=name, exact=True).bounding_box()
        assert 0 <= box["x"] <= box["x"] + box["width"] <= width
        assert 0 <= box["y"] <= box["y"] + box["height"] <= height
        assert min(box["width"], box["height"]) >= (34 if width == 390 else 28), name
    assert 21 * snapshot(page)["transform"]["scale"] > 0.7 * min(width, height)
    page.get_by_role("slider", name="Prior").fill("0.2")  # reached by scrolling the panel
    until(page, "s.document.prior === 0.2")


@pytest.mark.full
@pytest.mark.parametrize(("width", "height"), SIZES[1:], ids=["in landscape", "small"])
def test_other_phones_show_a_run_s_whole_status_and_its_ghost(open_page, room, width, height):
    page = open_page(room[1], **{**PHONE, "viewport": {"width": width, "height": height}})
    status = page.locator("footer").get_by_role("status")
    playwright.expect(status).to_have_text("Ready, but the chains have not converged")
    wide, room_for_it = status.evaluate("(status) => [status.scrollWidth, status.clientWidth]")
    assert wide <= room_for_it + 1
    playwright.expect(page.get_by_text("Touch a cell")).to_be_visible()
    choose(page, "Ghost")
    until(page, "s.ghost.fan")
    drag_a_finger(page, (6, 20), (10, 20), (12, 12))
    until(page, "Math.abs(s.ghost.fan.x - 2.5) < 0.05 && Math.abs(s.ghost.fan.y - 2.5) < 0.05")
    for chip in page.locator(".chip:visible").all():
        assert chip.bounding_box()["x"] + chip.bounding_box()["width"] <= width
