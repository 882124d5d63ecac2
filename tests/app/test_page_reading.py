"""The reading under the pointer, in words: along its beam, and across and along the wall."""

import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from building_log import ANGLES, write_room_log
from page_driver import END, served, snapshot, until


def point_at(page, beam):
    place = page.evaluate(END, beam)
    page.mouse.move(place["x"], place["y"])
    until(page, "s.reading.found && s.reading.picked.beam === argument", beam)
    return snapshot(page)["reading"]["found"]


def test_a_reading_is_told_along_its_beam_and_across_and_along_the_wall(open_page, room):
    run, address = room
    page = open_page(address)
    said = page.locator(".words.reading")
    playwright.expect(said).to_contain_text("Point at a reading")
    beam = int(np.argmin(np.abs(run.posterior.scans.poses[0, 2] + ANGLES + np.pi / 2)))
    found = point_at(page, beam)
    assert found["range"] == pytest.approx(run.posterior.scans.ranges_m[0, beam])
    words = said.inner_text()
    assert f"Beam {beam + 1} of scan 1 read {found['range']:.2f} m" in words
    side = "shorter" if found["residual"] < 0 else "longer"
    assert f"{100 * abs(found['residual']):.1f} cm {side} than the predicted median" in words
    wall = found["wall"]
    where = "behind" if wall["across_m"] < 0 else "in front of"
    assert f"{100 * abs(wall['across_m']):.1f} cm {where} the wall" in words
    assert re.search(rf"{100 * abs(wall['along_m']):.1f} cm to the (left|right) along it", words)
    assert f"{np.degrees(wall['incidence_rad']):.0f}\u00b0 from its normal" in words


@pytest.mark.full
def test_it_is_marked_on_the_map_and_forgotten_with_the_scan(open_page, room):
    page = open_page(room[1])
    point_at(page, 30)
    mark = page.locator("canvas.reading")
    playwright.expect(mark).to_be_visible()
    page.get_by_role("slider", name="Scan number").fill("4")
    until(page, "s.scan.index === 4 && !s.reading.picked")
    playwright.expect(mark).to_be_hidden()
    playwright.expect(page.locator(".words.reading")).to_contain_text("Point at a reading")


@pytest.mark.full
def test_a_log_s_readings_are_compared_too_and_walls_have_no_surface(open_page, tmp_path):
    with served(write_room_log(tmp_path / "room.log")) as (address, _):
        page = open_page(address)
        found = point_at(page, 30)
        assert found["wall"] is None
        words = page.locator(".words.reading").inner_text()
        assert "than the predicted median" in words
        assert "wall" not in words
