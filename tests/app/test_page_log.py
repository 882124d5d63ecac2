"""A log on the page: a scrubber along it, and cells of another size."""

import playwright.sync_api as playwright
import pytest
from building_log import room_scans, write_room_log
from page_driver import fragment, served, settled, snapshot, until, watch
from page_hands import act, enter, press, select, undo

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
        enter(opened, "Sweeps", 20)
    until(opened, SAMPLED)
    scrubber(opened).scroll_into_view_if_needed()
    yield opened
    while snapshot(opened)["document"].get("scans_used") or snapshot(opened)["document"]["grid"]["resolution"] != 0.1:
        undo(opened)


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
    undo(page)  # the whole drag is one step
    assert snapshot(page)["document"]["scans_used"] is None
    playwright.expect(page.get_by_text("all 12 scans")).to_be_visible()


@pytest.mark.full
def test_fewer_scans_see_less_and_scans_after_are_dimmed(page):
    whole = snapshot(page)["observed"].sum()
    page.get_by_role("slider", name="Scan number").fill("9")
    until(page, "s.scan.index === 9")
    bright = page.evaluate(DARKNESS)
    scrubber(page).focus()
    page.keyboard.press("Home")
    until(page, f"s.document.scans_used === 1 && {SAMPLED}")
    assert snapshot(page)["observed"].sum() < whole
    assert snapshot(page)["scan"]["pose"][:2] == pytest.approx(room_scans().poses[0, :2], abs=1e-3)
    act(page, lambda: scrubber(page).fill("5"))
    page.get_by_role("slider", name="Scan number").fill("9")
    until(page, f"s.scan.index === 9 && {SAMPLED}")
    assert page.evaluate(DARKNESS) < 0.6 * bright


DARKNESS = """() => {
  const canvas = document.querySelector("[data-bayesmap]").shadowRoot.querySelector("canvas.rays");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let sum = 0;
  for (let i = 3; i < data.length; i += 4) sum += data[i];
  return sum;
}"""
"""The sum of the opacities of the rays' pixels."""


@pytest.mark.full
def test_another_size_of_cells_is_another_grid_of_the_same_place_and_a_share_link_holds_it(open_page, page, log):
    sizes = page.get_by_role("combobox", name="Cell size")
    playwright.expect(sizes).to_have_value("0.1")
    select(page, "Cell size", "0.4")
    act(page, lambda: scrubber(page).fill("6"))
    until(page, SAMPLED)
    linked, expected = snapshot(page)["document"], bm.Grid.covering(room_scans(), 0.4)
    assert linked["grid"]["shape"] == list(expected.shape)
    assert linked["grid"]["origin"] == pytest.approx(expected.origin)
    for _ in range(2):
        undo(page)
    playwright.expect(sizes).to_have_value("0.1")
    other = open_page(log + fragment({**linked, "walls": ""}))
    until(other, f"s.document.scans_used === 6 && s.document.grid.resolution === 0.4 && {SAMPLED}")
    assert snapshot(other)["document"]["grid"]["shape"] == linked["grid"]["shape"]
    undo(other)


@pytest.mark.full
def test_surfaces_of_a_log_are_painted_while_their_sensor_is_fitted(open_page, tmp_path):
    """With enough beams that a page which shares its core with others sees some of it, too."""
    with served(write_room_log(tmp_path / "long.log", 60)) as (address, _):
        page = open_page(address)
        page.get_by_role("checkbox", name="Live").uncheck()
        select(page, "Cells", "surface")
        inside = "document.querySelector('[data-bayesmap]').shadowRoot"
        chip, status = (f"{inside}.querySelector('{part}').textContent" for part in (".chip", "footer [role=status]"))
        watch(page, f"[s.painted.method, {chip}, {status}]")
        press(page, "Run")
        until(page, "s.painted.method === 'gibbs' && s.painted.sweeps > 2")
        press(page, "Cancel")
        until(page, "!s.running && s.overlay.strokes > 10")
        said = [words for method, *words in page.evaluate("window.seen") if method == "pilot"]
        assert any("draws of one chain, sensor being fitted" in chip for chip, _ in said)
        assert any(status == "Fitting the sensor" for _, status in said)
        playwright.expect(page.locator("footer").get_by_role("status")).not_to_contain_text("Fitting")


@pytest.mark.full
def test_a_new_map_where_a_log_was_opened_is_its_own(open_page, log):
    page = open_page(log)
    until(page, "s.overlay?.trajectory === 12")
    press(page, "New map")
    press(page, "Create")
    until(page, "s.document.source.kind === 'simulation' && s.painted?.generation === s.generation")
    shown = settled(page)
    assert shown["overlay"] is None
    assert len(shown["scan"]["pose"]) == 3  # of one robot, not of the log's scans
    assert shown["document"]["grid"]["shape"] == [21, 21]
    page.get_by_role("checkbox", name="Trajectory").wait_for(state="hidden")
    undo(page)
    until(page, "s.document.source.kind === 'log' && s.overlay?.trajectory === 12")
