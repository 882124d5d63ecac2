"""A run's own quantity is what the page names and shows: reflectivities, their intervals, surfaces, the trajectory."""

import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from building_log import ANGLES, room_run, write_room_log
from page_driver import END, centre, served, snapshot, until
from page_hands import select, show_layer, slide

import bayesmap as bm
from bayesmap.app.exports import to_html
from bayesmap.app.sources import opened_run


def test_a_run_of_surfaces_names_its_quantity_everywhere_and_shows_widths_for_entropy(open_page, room):
    run, address = room
    page = open_page(address)
    legend, readout = page.get_by_role("list", name="Legend"), page.locator(".readout")
    playwright.expect(legend).to_contain_text(bm.Surface.words.mean)
    playwright.expect(legend).not_to_contain_text("P(wall)")
    playwright.expect(page.get_by_role("radio", name="Entropy")).to_be_hidden()
    page.mouse.move(*centre(page, 20, 10))
    mean = f"{bm.Surface.words.mean} {np.rint(255 * run.occupancy[20, 10]) / 255:.2f}"
    playwright.expect(readout).to_contain_text(mean)
    playwright.expect(readout).not_to_contain_text("entropy")
    playwright.expect(readout).to_contain_text(re.compile(r"\d+ beams?\b . for its surface \d+, [\d.]+ nats . against"))
    assert "emptied" in readout.get_attribute("title")
    show_layer(page, "One draw")
    until(page, "s.painted.layer === 'draw'")
    page.mouse.move(*centre(page, 20, 9))
    playwright.expect(readout).to_contain_text("in this draw")
    playwright.expect(readout).not_to_contain_text("free in this draw")
    playwright.expect(legend).to_contain_text(bm.Surface.words.value)
    show_layer(page, "Width")
    until(page, "s.painted.layer === 'width'")
    width = run.posterior.prior.width(run.posterior.draws, 0.9)
    np.testing.assert_allclose(snapshot(page)["probability"], 255 * width, atol=1.0)
    playwright.expect(legend).to_contain_text("width of the 90 % interval")
    page.mouse.move(*centre(page, 20, 10))
    playwright.expect(readout).to_contain_text("90 % interval")


def test_surfaces_and_trajectory_lie_over_the_map_and_can_be_hidden(open_page, room):
    run, address = room
    page = open_page(address)
    until(page, "s.overlay?.strokes > 10")
    found = snapshot(page)
    _, _, reflectivity = run.surfaces()
    assert found["overlay"] == {"strokes": (reflectivity >= 0.1).sum(), "trajectory": 12}
    overlay = page.locator("canvas.overlay")
    before, with_surfaces = found["layers"]["overlay"], overlay.screenshot()
    page.get_by_role("checkbox", name="Surfaces").uncheck()
    until(page, "s.layers.overlay > argument", before)
    assert overlay.screenshot() != with_surfaces
    page.get_by_role("checkbox", name="Trajectory").uncheck()
    playwright.expect(overlay).to_be_hidden()


def point_at(page, beam):
    place = page.evaluate(END, beam)
    page.mouse.move(place["x"], place["y"])
    until(page, "s.reading.found && s.reading.picked.beam === argument", beam)
    return snapshot(page)["reading"]["found"], page.locator(".words.reading").inner_text()


def test_a_reading_is_told_along_its_beam_and_across_and_along_the_wall(open_page, room):
    run, address = room
    page = open_page(address)
    playwright.expect(page.locator(".words.reading")).to_contain_text("Point at a reading")
    beam = int(np.argmin(np.abs(run.posterior.scans.poses[0, 2] + ANGLES + np.pi / 2)))
    found, words = point_at(page, beam)
    assert found["range"] == pytest.approx(run.posterior.scans.ranges_m[0, beam])
    assert f"Beam {beam + 1} of scan 1 read {found['range']:.2f} m" in words
    side = "shorter" if found["residual"] < 0 else "longer"
    assert f"{100 * abs(found['residual']):.1f} cm {side} than the predicted median" in words
    wall = found["wall"]
    where = "behind" if wall["across_m"] < 0 else "in front of"
    assert f"{100 * abs(wall['across_m']):.1f} cm {where} the wall" in words
    assert re.search(rf"{100 * abs(wall['along_m']):.1f} cm to the (left|right) along it", words)
    assert f"{np.degrees(wall['incidence_rad']):.0f}\u00b0 from its normal" in words
    mark = page.locator("canvas.reading")  # it is marked on the map, and forgotten with the scan
    playwright.expect(mark).to_be_visible()
    page.get_by_role("slider", name="Scan number").fill("4")
    until(page, "s.scan.index === 4 && !s.reading.picked")
    playwright.expect(mark).to_be_hidden()
    playwright.expect(page.locator(".words.reading")).to_contain_text("Point at a reading")


@pytest.mark.full
def test_a_run_of_walls_keeps_its_probabilities(open_page, tmp_path):
    room_run(bm.Independent(0.2)).save(tmp_path / "run.nc")
    with served(tmp_path / "run.nc") as (address, _):
        page = open_page(address)
        playwright.expect(page.get_by_role("list", name="Legend")).to_contain_text("P(wall)")
        playwright.expect(page.get_by_role("radio", name="Width")).to_be_hidden()
        assert snapshot(page)["overlay"] == {"strokes": 0, "trajectory": 12}


def test_an_exported_page_of_reflectivities_names_them(open_page, tmp_path):
    (tmp_path / "page.html").write_text(to_html(opened_run(room_run(bm.Beta()), "run").result))
    page = open_page((tmp_path / "page.html").as_uri())
    playwright.expect(page.get_by_role("list", name="Legend")).to_contain_text("mean reflectivity")


@pytest.mark.full
def test_a_log_is_inferred_as_surfaces_where_they_are_chosen_and_its_readings_are_compared(open_page, tmp_path):
    with served(write_room_log(tmp_path / "small.log")) as (address, _):
        page = open_page(address)
        found, words = point_at(page, 30)
        assert found["wall"] is None
        assert "than the predicted median" in words
        assert "wall" not in words
        slide(page, "Sweeps", 0)
        select(page, "Cells", "surface")
        until(page, "s.painted.quantity.kind === 'surface' && s.painted.sweeps >= s.document.sweeps")
        playwright.expect(page.get_by_role("list", name="Legend")).to_contain_text(bm.Surface.words.mean)
        for name in ("Method", "Order", "Start"):
            playwright.expect(page.get_by_role("combobox", name=name)).to_be_hidden()
        playwright.expect(page.get_by_role("slider", name="Prior")).to_be_hidden()
        show_layer(page, "Width")
        until(page, "s.painted.layer === 'width'")
        select(page, "Cells", "binary")
        until(page, "s.painted.quantity.kind === 'binary'")
