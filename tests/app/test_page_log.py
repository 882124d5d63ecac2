"""A log on the page: a scrubber along it, and cells of another size."""

import numpy as np
import playwright.sync_api as playwright
import pytest
from building_log import room_scans, write_room_log
from page_driver import act, fragment, served, settled, snapshot, until, watch

import bayesmap as bm

SAMPLED = (
    "s.seq.confirmed === s.seq.sent && s.painted.generation === s.generation && !s.painted.approximate "
    "&& s.painted.sweeps >= s.document.sweeps"
)


@pytest.fixture(scope="module")
def log(tmp_path_factory, browser):
    with served(write_room_log(tmp_path_factory.mktemp("log") / "room.log")) as (address, _):
        yield address


@pytest.fixture
def page(open_page, log):
    opened = open_page(log)
    if snapshot(opened)["document"]["sweeps"] != 20:
        act(opened, lambda: opened.get_by_role("spinbutton", name="Sweeps").fill("20") or opened.keyboard.press("Tab"))
    until(opened, SAMPLED)
    scrubber(opened).scroll_into_view_if_needed()
    yield opened
    while snapshot(opened)["document"].get("scans_used") or snapshot(opened)["document"]["grid"]["resolution"] != 0.1:
        act(opened, lambda: opened.get_by_role("button", name="Undo").click())


def scrubber(page):
    return page.get_by_role("slider", name="Scans used")


def test_dragging_is_coarse_and_letting_go_samples(page):
    whole = snapshot(page)["observed"].sum()
    box = scrubber(page).bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] - 9, y)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2, y, steps=5)
    until(page, "s.painted.method === 'hits' && s.painted.generation === s.generation && s.document.scans_used < 9")
    coarse = snapshot(page)
    assert coarse["painted"]["approximate"]
    playwright.expect(page.locator(".chips")).to_contain_text("approximate, counts of hits")
    page.mouse.up()
    until(page, SAMPLED)
    after = snapshot(page)
    used = after["document"]["scans_used"]
    assert 4 <= used <= 8
    assert after["painted"]["method"] == "gibbs"
    assert after["scan"]["index"] == used - 1
    assert 0 < after["observed"].sum() < whole
    act(page, lambda: page.get_by_role("button", name="Undo").click())  # the whole drag is one step
    assert snapshot(page)["document"]["scans_used"] is None
    playwright.expect(page.get_by_text("all 12 scans")).to_be_visible()


@pytest.mark.full
def test_fewer_scans_see_less(page):
    whole = snapshot(page)["observed"].sum()
    scrubber(page).focus()
    page.keyboard.press("Home")
    until(page, f"s.document.scans_used === 1 && {SAMPLED}")
    assert snapshot(page)["observed"].sum() < whole
    expected = room_scans().select(slice(1))
    assert snapshot(page)["scan"]["pose"][:2] == pytest.approx(expected.poses[0, :2], abs=1e-3)


@pytest.mark.full
def test_scans_after_are_dimmed(page):
    page.get_by_role("slider", name="Scan number").fill("9")
    until(page, "s.scan.index === 9")
    bright = darkness(page, "canvas.rays")
    act(page, lambda: scrubber(page).fill("5"))
    page.get_by_role("slider", name="Scan number").fill("9")
    until(page, f"s.scan.index === 9 && {SAMPLED}")
    assert darkness(page, "canvas.rays") < 0.6 * bright


def darkness(page, canvas):
    """Sum of the opacities of a layer's pixels."""
    return page.evaluate(
        """(name) => {
          const canvas = document.querySelector("[data-bayesmap]").shadowRoot.querySelector(name);
          const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
          let sum = 0;
          for (let i = 3; i < data.length; i += 4) sum += data[i];
          return sum;
        }""",
        canvas,
    )


@pytest.mark.full
def test_another_size_of_cells_is_another_grid_of_the_same_place(page):
    sizes = page.get_by_role("combobox", name="Cell size")
    playwright.expect(sizes).to_have_value("0.1")
    act(page, lambda: sizes.select_option("0.2"))
    until(page, SAMPLED)
    grid = snapshot(page)["document"]["grid"]
    expected = bm.Grid.covering(room_scans(), 0.2)
    assert grid["shape"] == list(expected.shape)
    assert grid["origin"] == pytest.approx(expected.origin)
    act(page, lambda: page.get_by_role("button", name="Undo").click())
    playwright.expect(sizes).to_have_value("0.1")


@pytest.mark.full
def test_a_share_link_holds_both(open_page, page, log):
    act(page, lambda: page.get_by_role("combobox", name="Cell size").select_option("0.4"))
    act(page, lambda: scrubber(page).fill("6"))
    until(page, SAMPLED)
    linked = snapshot(page)["document"]
    for _ in range(2):
        act(page, lambda: page.get_by_role("button", name="Undo").click())
    other = open_page(log + fragment({**linked, "walls": ""}))
    until(other, f"s.document.scans_used === 6 && s.document.grid.resolution === 0.4 && {SAMPLED}")
    assert np.array_equal(snapshot(other)["document"]["grid"]["shape"], linked["grid"]["shape"])
    act(other, lambda: other.get_by_role("button", name="Undo").click())


@pytest.mark.full
def test_surfaces_of_a_log_are_painted_while_their_sensor_is_fitted(open_page, tmp_path):
    """With enough beams that a page which shares its core with others sees some of it, too."""
    with served(write_room_log(tmp_path / "long.log", 60)) as (address, _):
        page = open_page(address)
        page.get_by_role("checkbox", name="Live").uncheck()
        act(page, lambda: page.get_by_role("combobox", name="Cells").select_option("surface"))
        inside = "document.querySelector('[data-bayesmap]').shadowRoot"
        chip, status = (f"{inside}.querySelector('{part}').textContent" for part in (".chip", "footer [role=status]"))
        watch(page, f"[s.painted.method, {chip}, {status}]")
        page.get_by_role("button", name="Run", exact=True).click()
        until(page, "s.painted.method === 'gibbs' && s.painted.sweeps > 2")
        page.get_by_role("button", name="Cancel").click()
        until(page, "!s.running && s.overlay.strokes > 10")
        said = [words for method, *words in page.evaluate("window.seen") if method == "pilot"]
        assert any("draws of one chain, sensor being fitted" in chip for chip, _ in said)
        assert any(status == "Fitting the sensor" for _, status in said)
        playwright.expect(page.locator("footer").get_by_role("status")).not_to_contain_text("Fitting")


@pytest.mark.full
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
