"""The beams through the cell that was clicked: which speak for what is there, which against it, and how much each."""

import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import act, centre, colour_at, document, press_and_drag, propagated, settled, snapshot, until

from bayesmap.app.answers.evidence import strongest, summed, wall_ratios

BLUE, ORANGE = (0, 114, 178), (213, 94, 0)
TOLD = "s.evidence.each && s.evidence.together.x === argument[0] && s.evidence.together.y === argument[1]"


def click(page, x, y):
    page.mouse.click(*centre(page, x, y))
    until(page, TOLD, [x, y])
    return snapshot(page)["evidence"]


def choose(page):
    page.get_by_role("radio", name="Evidence", exact=True).check()


def is_nearer(colour, one, other):
    return np.abs(colour - one).sum() < np.abs(colour - other).sum()


def test_a_click_shows_each_beam_and_its_nats(open_page):
    asked = document(method="propagate")
    scene, preview = propagated(asked)
    p_wall = preview.mean()
    x, y = map(int, np.argwhere(preview.observed() & (p_wall < 0.1))[10])
    known = wall_ratios(scene.problem.table, p_wall.ravel(), x * p_wall.shape[1] + y)
    page = open_page(asked)
    settled(page)
    for label in ("True walls", "Readings"):
        page.get_by_role("checkbox", name=label).uncheck()
    choose(page)
    section = page.get_by_role("heading", name="Evidence of beams").locator("..")
    playwright.expect(section).to_contain_text("Click a cell")
    found = click(page, x, y)
    expected = strongest(known, scene.scans)
    for name, values in expected.items():
        np.testing.assert_allclose(np.ravel(found["each"][name]), values.ravel(), atol=1e-6, err_msg=name)
    words = section.inner_text()
    together = summed(known)
    assert f"For a wall (blue) {together.beams_for}, {together.nats_for:.1f} nats" in words
    assert f"against (orange) {together.beams_against}, {together.nats_against:.1f} nats" in words
    listed = re.findall(r"([+\u2212])([\d.]+) nats: beam (\d+) of sensor (\d+)", words)
    assert len(listed) == min(8, len(expected["nats"]))
    assert listed[0][1] == f"{abs(expected['nats'][0]):.1f}"
    assert int(listed[0][2]) == expected["beam"][0] + 1
    assert int(listed[0][3]) == scene.ids[int(expected["scan"][0])]
    assert not page.locator("canvas.rays").is_visible()  # the others would hide them


@pytest.mark.full
def test_beams_for_are_blue_and_against_orange(open_page):
    page = open_page(document(method="propagate"))
    before = settled(page)
    for label in ("True walls", "Readings"):
        page.get_by_role("checkbox", name=label).uncheck()
    choose(page)
    wall = np.argwhere((before["observed"] == 1) & (before["probability"] > 250))[0].tolist()
    free = np.argwhere((before["observed"] == 1) & (before["probability"] < 5))
    floor = free[np.abs(free - np.array([10, 12])).sum(axis=1).argmin()].tolist()
    for cell, own, other in ((wall, BLUE, ORANGE), (floor, ORANGE, BLUE)):
        each = click(page, *cell)["each"]
        assert (each["nats"][0] > 0) == (own is BLUE)
        start, end = np.reshape(each["start"], (-1, 2))[0], np.reshape(each["end"], (-1, 2))[0]
        at = start + 0.2 * (end - start)
        colour = colour_at(page, float(at[0]), float(at[1]))
        assert is_nearer(colour, own, other), colour


@pytest.mark.full
def test_what_is_said_follows_the_map(page):
    settled(page)
    choose(page)
    before = click(page, 10, 12)
    page.get_by_role("radio", name="Draw", exact=True).check()
    act(page, lambda: press_and_drag(page, [(9, 12), (11, 12)]))
    settled(page)
    choose(page)
    until(page, "s.evidence.together && s.evidence.together.nats_for > argument + 1", before["together"]["nats_for"])


@pytest.mark.full
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_of_a_saved_run_of_surfaces_too(open_page, room, scheme):
    _, address = room
    page = open_page(address, color_scheme=scheme)
    choose(page)
    # Of the wall in the room's middle: some cells of it a neighbour's long surface would do without.
    best = max(range(2, 18), key=lambda y: click(page, 20, y)["together"]["nats_for"])
    found = click(page, 20, best)
    assert found["together"]["nats_for"] > 5
    assert found["each"]["nats"][0] > 0
    section = page.get_by_role("heading", name="Evidence of beams").locator("..")
    assert re.search(r"For its surface \(blue\) \d+, [\d.]+ nats", section.inner_text())
    assert re.search(r"\+[\d.]+ nats: beam \d+ of scan \d+", section.inner_text())
