"""A run's own quantity is what the page names and shows: reflectivities, their intervals, surfaces, the trajectory."""

import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from building_log import room_run, write_room_log
from page_driver import act, centre, served, show_layer, snapshot, until

import bayesmap as bm


def test_a_run_of_surfaces_names_its_quantity_everywhere(open_page, room):
    run, address = room
    page = open_page(address)
    legend = page.get_by_role("list", name="Legend")
    playwright.expect(legend).to_contain_text(bm.Surface.words.mean)
    playwright.expect(legend).not_to_contain_text("P(wall)")
    page.mouse.move(*centre(page, 20, 10))
    readout = page.locator(".readout")
    mean = f"{bm.Surface.words.mean} {np.rint(255 * run.occupancy[20, 10]) / 255:.2f}"
    playwright.expect(readout).to_contain_text(mean)
    playwright.expect(readout).not_to_contain_text("entropy")
    show_layer(page, "One draw")
    until(page, "s.painted.layer === 'draw'")
    page.mouse.move(*centre(page, 20, 9))
    playwright.expect(readout).to_contain_text("in this draw")
    playwright.expect(readout).not_to_contain_text("free in this draw")
    playwright.expect(legend).to_contain_text(bm.Surface.words.value)


@pytest.mark.full
def test_the_beams_of_a_cell_are_said_to_speak_for_what_is_there(open_page, room):
    run, address = room
    page = open_page(address)
    cell = np.unravel_index(np.argmax(np.where(run.observed, run.occupancy, 0)), run.grid.shape)
    page.mouse.move(*centre(page, *map(int, cell)))
    readout = page.locator(".readout")
    playwright.expect(readout).to_contain_text(
        re.compile(r"\d+ beams . for its surface \d+, [\d.]+ nats . against \d+")
    )
    assert "emptied" in readout.get_attribute("title")


def test_the_width_of_the_interval_is_shown_in_place_of_an_entropy(open_page, room):
    run, address = room
    page = open_page(address)
    playwright.expect(page.get_by_role("radio", name="Entropy")).to_be_hidden()
    show_layer(page, "Width")
    until(page, "s.painted.layer === 'width'")
    lower, upper = run.interval(0.9)
    np.testing.assert_allclose(snapshot(page)["probability"], 255 * (upper - lower), atol=1.0)
    playwright.expect(page.get_by_role("list", name="Legend")).to_contain_text("width of the 90 % interval")
    page.mouse.move(*centre(page, 20, 10))
    playwright.expect(page.locator(".readout")).to_contain_text("90 % interval")


def test_surfaces_and_trajectory_lie_over_the_map_and_can_be_hidden(open_page, room):
    run, address = room
    page = open_page(address)
    until(page, "s.overlay?.strokes > 10")
    found = snapshot(page)
    assert found["overlay"]["trajectory"] == 12
    _, _, reflectivity = run.surfaces()
    assert found["overlay"]["strokes"] == (reflectivity >= 0.1).sum()
    overlay = page.locator("canvas.overlay")
    before, with_surfaces = found["layers"]["overlay"], overlay.screenshot()
    page.get_by_role("checkbox", name="Surfaces").uncheck()
    until(page, "s.layers.overlay > argument", before)
    assert overlay.screenshot() != with_surfaces
    page.get_by_role("checkbox", name="Trajectory").uncheck()
    playwright.expect(overlay).to_be_hidden()


@pytest.mark.full
def test_a_run_of_walls_keeps_its_probabilities(open_page, tmp_path):
    room_run(bm.Independent(0.2), draws=5).save(tmp_path / "run.nc")
    with served(tmp_path / "run.nc") as (address, _):
        page = open_page(address)
        playwright.expect(page.get_by_role("list", name="Legend")).to_contain_text("P(wall)")
        playwright.expect(page.get_by_role("radio", name="Width")).to_be_hidden()
        assert snapshot(page)["overlay"] == {"strokes": 0, "trajectory": 12}


def test_an_exported_page_of_reflectivities_names_them(open_page, tmp_path):
    from bayesmap.app.exports import to_html
    from bayesmap.app.sources import opened_run

    (tmp_path / "page.html").write_text(to_html(opened_run(room_run(bm.Beta(), draws=5), "run").result))
    page = open_page((tmp_path / "page.html").as_uri())
    playwright.expect(page.get_by_role("list", name="Legend")).to_contain_text("mean reflectivity")


@pytest.mark.full
def test_a_log_is_inferred_as_surfaces_where_they_are_chosen(open_page, tmp_path):
    with served(write_room_log(tmp_path / "small.log")) as (address, _):
        page = open_page(address)
        act(page, lambda: page.get_by_role("slider", name="Sweeps").fill("0"))
        act(page, lambda: page.get_by_role("combobox", name="Cells").select_option("surface"))
        until(page, "s.painted.quantity.kind === 'surface' && s.painted.sweeps >= s.document.sweeps")
        playwright.expect(page.get_by_role("list", name="Legend")).to_contain_text(bm.Surface.words.mean)
        for name in ("Method", "Order", "Start"):
            playwright.expect(page.get_by_role("combobox", name=name)).to_be_hidden()
        playwright.expect(page.get_by_role("slider", name="Prior")).to_be_hidden()
        show_layer(page, "Width")
        until(page, "s.painted.layer === 'width'")
        act(page, lambda: page.get_by_role("combobox", name="Cells").select_option("binary"))
        until(page, "s.painted.quantity.kind === 'binary'")
