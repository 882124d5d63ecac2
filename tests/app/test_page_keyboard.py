"""Everything without a pointer, and said aloud."""

import numpy as np
import pytest
from page_driver import NO_WALLS, document, settled, until
from page_hands import act

CONTROLS = (
    "New map,Share,Export,Help,Draw,Zoom in,Whole map,Run,Live,Mean,True walls,Rays,Readings,Prior P(wall),Noise (m),"
    "Angles,Method,Order,Sweeps,Seed,Clear walls,Clear inference,Selected sensor,Add a sensor"
)
FOCUS = """() => {
  const e = document.querySelector("[data-bayesmap]").shadowRoot.activeElement;
  if (!e) return null;
  const ring = (x) => getComputedStyle(x).outlineStyle !== "none";
  const name = e.getAttribute("aria-label") ?? e.labels?.[0]?.textContent ?? e.textContent;
  return [name.trim(), ring(e) || ring(e.closest("label") ?? e), e.tagName];
}"""
"""Of the control that has the focus: its name, whether that is seen, and its kind."""


def test_a_map_is_drawn_undone_and_inferred_by_keys_alone(open_page):
    page = open_page(document(walls=NO_WALLS))
    settled(page)
    page.keyboard.press("d")  # draw, and the map has the focus
    for key in ("ArrowUp", "ArrowUp", "ArrowUp", "ArrowLeft"):
        page.keyboard.press(key)
    act(page, lambda: page.keyboard.press("Space"))
    page.keyboard.press("ArrowLeft")
    act(page, lambda: page.keyboard.press(" "))
    assert np.argwhere(settled(page)["walls"]).tolist() == [[8, 13], [9, 13]]
    act(page, lambda: page.keyboard.press("Space"))  # again: free
    assert np.argwhere(settled(page)["walls"]).tolist() == [[9, 13]]
    act(page, lambda: page.keyboard.press("Control+z"))
    assert settled(page)["walls"].sum() == 2
    page.keyboard.press("e")
    act(page, lambda: page.keyboard.press("Space"))
    assert np.argwhere(settled(page)["walls"]).tolist() == [[9, 13]]
    act(page, lambda: page.keyboard.press("r"))
    until(page, "!s.running && s.draws.count === 2000")
    for key, layer in (("n", "draw"), ("h", "entropy"), ("m", "mean")):
        page.keyboard.press(key)
        until(page, "s.painted.layer === argument", layer)


@pytest.mark.full
def test_the_robot_is_moved_turned_added_and_removed_by_keys_and_a_cell_is_said(page):
    settled(page)
    page.keyboard.press("s")
    for key in ("ArrowDown", "Shift+ArrowLeft", "["):
        act(page, lambda key=key: page.keyboard.press(key))
    sensor = settled(page)["sensors"][0]
    assert (sensor["x"], sensor["y"]) == (5.0, 9.0)
    assert abs(sensor["yaw"] - np.pi / 12) < 1e-6
    for key, sensors in (("a", 2), ("Delete", 1)):
        act(page, lambda key=key: page.keyboard.press(key))
        assert len(settled(page)["sensors"]) == sensors
    page.keyboard.press("d")
    page.keyboard.press("ArrowRight")
    said = page.locator("span[aria-live=polite]").filter(has_text="Cell ")
    said.wait_for(state="attached")
    assert "P(wall)" in said.inner_text()


def test_every_control_is_reached_by_tab_and_shows_its_focus(page):
    settled(page)
    reached = []
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.append(page.evaluate(FOCUS))
    reached = [entry for entry in reached if entry]
    names = {name for name, _, _ in reached}
    assert all(seen for _, seen, _ in reached), [name for name, seen, _ in reached if not seen]
    assert set(CONTROLS.split(",")) <= names
    assert any(name.startswith("Map, 21 by 21") for name in names)
    assert any(name.startswith("Theme") for name in names)


def test_help_opens_and_closes_and_gives_the_focus_back(page):
    settled(page)
    page.keyboard.press("d")
    page.keyboard.press("?")
    dialog = page.get_by_role("dialog", name="Help")
    dialog.wait_for()
    page.keyboard.press("e")  # no shortcut while the dialog is open
    assert page.get_by_role("radio", name="Draw", exact=True).is_checked(timeout=1000)
    page.keyboard.press("Escape")
    dialog.wait_for(state="hidden")
    assert page.evaluate(FOCUS)[2] == "CANVAS"


@pytest.mark.full
def test_the_export_menu_by_keys(page):
    settled(page)
    button = page.get_by_role("button", name="Export")
    for key, expanded in (("Enter", "true"), ("Escape", "false")):
        button.press(key)
        assert button.get_attribute("aria-expanded") == expanded
    assert not page.get_by_role("button", name="Picture (PNG)").is_visible()
