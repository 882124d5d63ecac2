"""Logs and saved runs on the page: scans and draws to look through, their quantity's own words, nothing to draw on."""

import base64
import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from building_log import tutorial_run, write_room_log
from cli.shell import succeed
from page_driver import centre, served, snapshot, still, until, watch
from page_hands import choose, click, enter, run, show_draw, show_layer, undo

import bayesmap as bm

SAMPLED = (
    "s.seq.confirmed === s.seq.sent && s.painted.generation === s.generation && !s.painted.approximate "
    "&& s.painted.sweeps >= s.document.sweeps"
)


def show_scan(page, index):
    page.get_by_role("slider", name="Scan number").fill(str(index))
    until(page, "s.scan.index === argument", index)
    return snapshot(page)["scan"]["pose"][:3]


def test_a_log_is_looked_through_and_dragging_along_it_is_coarse_and_letting_go_samples(open_page, tmp_path):
    log = write_room_log(tmp_path / "office.log")
    with served(log) as (address, _):
        page = open_page(address)
        first = snapshot(page)
        assert {**first["document"]["source"], "bounds": None} == {
            "kind": "log", "name": log.name, "scans": 12, "bounds": None,
        }  # fmt: skip
        assert not np.array_equal(show_scan(page, 7), first["scan"]["pose"])
        assert not page.get_by_role("radio", name="Draw", exact=True).is_visible()
        page.mouse.click(480, 400)  # a press on the map pans, and draws nothing
        assert snapshot(page)["generation"] == first["generation"]
        enter(page, "Sweeps", 20)
        until(page, SAMPLED)
        show_scan(page, 11)
        bright, whole = page.evaluate("probes.darkness()"), snapshot(page)["observed"].sum()
        scrubber = page.get_by_role("slider", name="Scans used")
        scrubber.scroll_into_view_if_needed()
        box = scrubber.bounding_box()
        y = box["y"] + box["height"] / 2
        page.mouse.move(box["x"] + box["width"] - 9, y)
        page.mouse.down()
        page.mouse.move(box["x"] + box["width"] / 2, y, steps=5)
        until(page, "s.painted.method === 'hits' && s.painted.generation === s.generation && s.document.scans_used < 9")
        playwright.expect(page.locator(".chips")).to_contain_text("approximate, counts of hits")
        page.mouse.up()
        until(page, SAMPLED)
        after = snapshot(page)
        assert 4 <= after["document"]["scans_used"] <= 8
        assert after["scan"]["index"] == after["document"]["scans_used"] - 1
        assert 0 < after["observed"].sum() < whole
        show_scan(page, 11)  # a scan that is not used is dimmed
        still(page)
        assert page.evaluate("probes.darkness()") < 0.6 * bright
        undo(page)  # the whole drag is one step
        playwright.expect(page.get_by_text("all 12 scans")).to_be_visible()


def drop(page, path):
    page.evaluate("probes.drop", [path.name, base64.b64encode(path.read_bytes()).decode()])


def test_a_dropped_run_is_shown_with_its_mean_and_draws_and_a_damaged_one_is_not(open_page, server, tmp_path):
    page = open_page(server, quiet=False)  # the browser tells its console of what is refused
    (tmp_path / "broken.nc").write_bytes(b"CDF not really")
    drop(page, tmp_path / "broken.nc")
    page.get_by_role("status").get_by_text("broken.nc cannot be shown: ").wait_for()
    (tmp_path / "notes.txt").write_text("no map")
    drop(page, tmp_path / "notes.txt")
    page.get_by_role("status").get_by_text("notes.txt is not read in the page: start bayesmap app with it").wait_for()
    run = tutorial_run()
    run.save(tmp_path / "found.nc")
    drop(page, tmp_path / "found.nc")
    page.get_by_role("status").get_by_text("Reading found.nc").wait_for()
    until(page, "s.document.source.name === 'found.nc' && s.draws.count === 20")
    shown = snapshot(page)
    assert np.abs(shown["probability"] / 255 - run.occupancy).max() <= 0.5 / 255 + 1e-6
    show_layer(page, "One draw")
    assert np.array_equal(show_draw(page, 14, chain=1) > 0, run.draws[1, 14])
    for name in ("Run", "Clear inference"):
        assert not page.get_by_role("button", name=name, exact=True).is_visible()
    # A range near the maximum is no return, whatever its noise.
    assert np.array_equal(shown["scan"]["hit"] == 0, np.isclose(shown["scan"]["ranges"], 42, atol=1.0))


def test_run_infers_a_trajectory_which_the_page_shows_stage_by_stage(open_page, tmp_path):
    size = "--size 12x8 --scans 70 --angles 90 --max-range 10 --odometry typical,drift_rad_per_m=0.04"
    succeed("simulate", "--world building", size, "-o", tmp_path / "raw.log")
    with served(tmp_path / "raw.log") as (address, _):
        page = open_page(address)
        assert page.get_by_label("Poses", exact=True).input_value() == "odometry"
        playwright.expect(page.get_by_text("Run infers where the robot was.")).to_be_visible()
        enter(page, "Sweeps", 5)
        before, last = snapshot(page), show_scan(page, 69)
        assert (before["painted"]["method"], before["overlay"]["trajectory"]) == ("counts", 70)
        watch(page, "[s.stage?.name ?? '', s.layers.overlay]")
        run(page)
        until(page, "s.painted.method === 'gibbs' && !s.running && s.draws.count === 5")
        stages, overlays = zip(*page.evaluate("window.seen"), strict=True)
        assert {"front end", "loops", "aligned", "placing"} & set(stages)  # the page had time to show some of them
        assert overlays[-1] > overlays[0] + 1
        after = snapshot(page)
        assert after["status"]["text"].startswith("Trajectory inferred: odometry was off by up to")
        assert np.hypot(*(after["scan"]["pose"][:2] - last[:2])) > 0.3
        run(page)
        until(page, "!s.running && s.draws.count === 10")
        assert snapshot(page)["document"]["grid"] == after["document"]["grid"]  # the trajectory is known already


def legend(page):
    return page.get_by_role("list", name="Legend")


def test_a_run_of_surfaces_names_its_quantity_and_shows_widths_for_entropy(open_page, room):
    run, address = room
    page = open_page(address)
    readout = page.locator(".readout")
    playwright.expect(legend(page)).to_contain_text(bm.Surface.words.mean)
    playwright.expect(page.get_by_role("radio", name="Entropy")).to_be_hidden()
    page.mouse.move(*centre(page, 20, 10))
    mean = f"{bm.Surface.words.mean} {np.rint(255 * run.occupancy[20, 10]) / 255:.2f}"
    playwright.expect(readout).to_contain_text(mean)
    playwright.expect(readout).to_contain_text(re.compile(r"\d+ beams?\b . for its surface \d+, [\d.]+ nats . against"))
    show_layer(page, "One draw")
    until(page, "s.painted.layer === 'draw'")
    playwright.expect(readout).to_contain_text("in this draw")
    show_layer(page, "Width")
    until(page, "s.painted.layer === 'width'")
    width = run.posterior.prior.width(run.posterior.draws, 0.9)
    np.testing.assert_allclose(snapshot(page)["probability"], 255 * width, atol=1.0)
    playwright.expect(legend(page)).to_contain_text("width of the 90 % interval")


def test_surfaces_and_trajectory_lie_over_the_map_and_can_be_hidden(open_page, room):
    run, address = room
    page = open_page(address)
    until(page, "s.overlay?.strokes > 10")
    layers, overlay = snapshot(page)["layers"], page.locator(".stage > canvas.overlay")
    assert snapshot(page)["overlay"] == {"strokes": (run.surfaces()[2] >= 0.1).sum(), "trajectory": 12}
    with_surfaces = overlay.screenshot()
    page.get_by_role("checkbox", name="Surfaces").uncheck()
    until(page, "s.layers.overlay > argument", layers["overlay"])
    assert overlay.screenshot() != with_surfaces
    page.get_by_role("checkbox", name="Trajectory").uncheck()
    playwright.expect(overlay).to_be_hidden()


def test_a_draw_lies_over_the_mean(open_page, room):
    posterior, address = room
    page = open_page(address, device_scale_factor=1)
    page.get_by_role("checkbox", name="Draws over the mean").check()
    until(page, "s.over && s.painted.layer === 'draw'")
    still(page)
    shown = snapshot(page)
    draw = posterior.map_of(0, shown["painted"]["draw"])
    expected = np.where(shown["observed"] > 0, np.rint(255 * draw), 0)  # of a saved run either is known, or not
    assert np.abs(np.array(page.evaluate("probes.opacity()")) - expected).max() <= 2
    playwright.expect(page.locator(".chips")).to_contain_text("over the mean")
    playwright.expect(legend(page)).to_contain_text("this draw")
    playwright.expect(page.locator(".stage > canvas.hypothesis")).to_be_visible()
    page.get_by_role("checkbox", name="Draws over the mean").uncheck()
    until(page, "!s.over")
    playwright.expect(page.locator(".stage > canvas.hypothesis")).to_be_hidden()


@pytest.mark.parametrize("width", [1280, pytest.param(1000, marks=pytest.mark.full)])
def test_the_map_stays_where_it_is_while_the_legend_of_a_run_grows(open_page, room, width):
    page = open_page(room[1], viewport={"width": width, "height": 860})
    heights, place = page.evaluate("probes.heights()"), centre(page, 20, 10)

    def unmoved(known, words):
        until(page, known)
        playwright.expect(legend(page).get_by_text(words)).to_be_visible()
        assert page.evaluate("probes.heights()") == heights
        assert centre(page, 20, 10) == place

    choose(page, "Path")
    at = page.evaluate("probes.beamEnd(30)")
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
def test_phones_have_colours_and_numbers_in_one_row_or_a_legend_beside_the_map(open_page, room):
    phone = {"has_touch": True, "is_mobile": True}
    page = open_page(room[1], **phone, viewport={"width": 320, "height": 720})
    first = legend(page).locator("li").first
    ramp, scale = (first.locator(part).bounding_box() for part in (".ramp", ".scale"))
    assert scale["height"] < 2 * ramp["height"]
    assert scale["x"] + scale["width"] <= 320
    assert first.locator(".scale").inner_text().split() == ["0", "1"]
    page.evaluate("probes.recordWriting()")
    page.set_viewport_size({"width": 330, "height": 720})
    until(page, "window.written.some(({ text }) => text === 'm')")
    written = page.evaluate("window.written")
    unit = next(word for word in written if word["text"] == "m")  # of the axis, apart from its numbers
    numbers = [word for word in written if word["y"] == unit["y"] and word["text"] != "m"]
    assert len(numbers) > 2
    assert unit["left"] >= 0
    assert min(number["left"] for number in numbers) - unit["right"] > 8
    page = open_page(room[1], **phone, viewport={"width": 844, "height": 390})
    stage = page.locator(".stage").bounding_box()
    assert stage["height"] == 390
    for words in ("ray", "unobserved"):
        box = legend(page).get_by_text(words, exact=True).bounding_box()
        assert box["x"] >= stage["x"] + stage["width"]
        assert box["y"] + box["height"] <= 390
