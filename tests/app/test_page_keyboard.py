"""Everything without a pointer, and said aloud."""

import numpy as np
import pytest
from page_driver import NO_WALLS, act, document, settled, until


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
    until(page, "!s.running && s.draws.count === 1000")
    page.keyboard.press("n")
    until(page, "s.painted.layer === 'draw'")
    page.keyboard.press("h")
    until(page, "s.painted.layer === 'entropy'")
    page.keyboard.press("m")
    until(page, "s.painted.layer === 'mean'")


@pytest.mark.full
def test_the_robot_is_moved_turned_added_and_removed_by_keys(page):
    settled(page)
    page.keyboard.press("s")
    act(page, lambda: page.keyboard.press("ArrowDown"))
    act(page, lambda: page.keyboard.press("Shift+ArrowLeft"))
    act(page, lambda: page.keyboard.press("["))
    sensor = settled(page)["sensors"][0]
    assert (sensor["x"], sensor["y"]) == (5.0, 9.0)
    assert abs(sensor["yaw"] - np.pi / 12) < 1e-6
    act(page, lambda: page.keyboard.press("a"))
    assert len(settled(page)["sensors"]) == 2
    act(page, lambda: page.keyboard.press("Delete"))
    assert len(settled(page)["sensors"]) == 1


@pytest.mark.full
def test_the_cell_under_the_cursor_is_said(page):
    settled(page)
    page.keyboard.press("d")
    page.keyboard.press("ArrowRight")
    said = page.locator("span[aria-live=polite]").filter(has_text="Cell 11, 10")
    said.wait_for(state="attached")
    assert "P(wall)" in said.inner_text()


def test_every_control_is_reached_by_tab_and_shows_its_focus(page):
    settled(page)
    reached = []
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.append(
            page.evaluate("""() => {
              const e = document.querySelector("[data-bayesmap]").shadowRoot.activeElement;
              if (!e) return null;
              const ring = (x) => getComputedStyle(x).outlineStyle !== "none";
              const name = e.getAttribute("aria-label") ?? e.labels?.[0]?.textContent ?? e.textContent;
              return [name.trim(), ring(e) || ring(e.closest("label") ?? e)];
            }""")
        )
    names = {entry[0] for entry in reached if entry}
    assert all(entry[1] for entry in reached if entry), [entry for entry in reached if entry and not entry[1]]
    wanted = "New map,Share,Export,Help,Draw,Zoom in,Whole map,Run,Live,Mean,True walls,Rays,Readings,Prior P(wall)"
    wanted += ",Noise (m),Angles,Method,Order,Sweeps,Seed,Clear walls,Clear inference,Selected sensor,Add a sensor"
    assert set(wanted.split(",")) <= names
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
    focused = page.evaluate("document.querySelector('[data-bayesmap]').shadowRoot.activeElement.tagName")
    assert focused == "CANVAS"


@pytest.mark.full
def test_the_export_menu_by_keys(page):
    settled(page)
    button = page.get_by_role("button", name="Export")
    button.press("Enter")
    assert button.get_attribute("aria-expanded") == "true"
    page.keyboard.press("Escape")
    assert button.get_attribute("aria-expanded") == "false"
    assert not page.get_by_role("button", name="Picture (PNG)").is_visible()
