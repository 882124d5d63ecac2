"""Where am I? A cloud of poses over the map, live while the robot is dragged, and the same in words."""

import base64
import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from building_log import bent_room_run
from page_driver import centre, colour_at, document, serious, served, settled, snapshot, until, watch
from page_hands import choose, click

FOUND = """() => {
  const f = bayesmap.snapshot().where.found;
  return f && {...f, cloud: [...f.cloud], weight: [...f.weight]};
}"""


def square(x, y):
    """A document of a square room."""
    walls = np.zeros((21, 21), dtype=bool)
    walls[4:17, [4, 16]] = walls[[4, 16], 4:17] = True
    packed = base64.b64encode(np.packbits(walls.ravel()).tobytes()).decode()
    return document(walls=packed, noise=0.05, angles=90, sensors=[{"id": 1, "x": x, "y": y, "yaw": 0.2}])


def ask(page):
    settled(page)
    choose(page, "Where am I?")


def found(page):
    until(page, "s.where.found && s.where.found.picture === s.generation")
    return page.evaluate(FOUND)


def test_the_robot_of_the_tutorial_has_one_place(page):
    ask(page)
    answer = found(page)
    (place,) = answer["modes"]
    robot = snapshot(page)["sensors"][0]
    assert np.hypot(place["mean"][0] - robot["x"], place["mean"][1] - robot["y"]) < 0.1
    said = page.locator(".whereabouts")
    playwright.expect(said).to_contain_text("One place: ")
    playwright.expect(said).to_contain_text("The robot stands")
    assert len(answer["cloud"]) == 3 * len(answer["weight"])
    choose(page, "Pan")
    until(page, "!s.where.found")


@pytest.mark.full
def test_a_square_room_has_four_places_with_probabilities_until_it_loses_its_symmetry(open_page):
    page = open_page(square(8.3, 9.1))
    ask(page)
    answer = found(page)
    assert len(answer["modes"]) == 4
    said = page.locator(".whereabouts").inner_text()
    listed = [int(number) for number in re.findall(r"(\d+) %", said)]
    assert said.startswith("4 places: ")
    assert listed[:4] == [round(100 * mode["probability"]) for mode in answer["modes"]]
    for mode in answer["modes"]:  # each is marked on the map
        _, green, blue = colour_at(page, *mode["mean"][:2])
        assert blue > green + 30  # violet
    choose(page, "Draw")
    click(page, 13, 6)
    ask(page)
    assert len([m for m in found(page)["modes"] if m["probability"] > 0.01]) == 1
    playwright.expect(page.locator(".whereabouts")).to_contain_text("One place")


@pytest.mark.full
def test_the_cloud_follows_the_robot_while_it_is_dragged(open_page):
    page = open_page(square(8.0, 9.0))
    ask(page)
    found(page)
    page.mouse.move(*centre(page, 8, 9))
    page.mouse.down()
    watch(page, "s.where.found?.pose[0] ?? null")
    for i in range(1, 41):
        page.mouse.move(*centre(page, 8 + i * 0.1, 9))
        if i % 10 == 0:  # still under the hand
            until(page, "window.seen.length > argument", i // 10)
    page.mouse.up()
    settled(page)
    answer = found(page)
    assert answer["pose"][0] == pytest.approx(12.0, abs=0.05)
    nearest = min(np.hypot(m["mean"][0] - answer["pose"][0], m["mean"][1] - 9.0) for m in answer["modes"])
    assert nearest < 0.1
    page.keyboard.press("ArrowRight")  # the keyboard moves it too
    until(page, "s.sensors[0].x > 12.9")
    assert found(page)["pose"][0] == pytest.approx(13.0, abs=0.05)


@pytest.mark.full
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_scan_of_a_run_is_located_in_its_map(open_page, tmp_path, scheme):
    run = bent_room_run()
    run.save(tmp_path / "run.nc")
    poses = run.posterior.scans.poses
    with served(tmp_path / "run.nc") as (address, _):
        page = open_page(address, color_scheme=scheme, bypass_csp=True)
        choose(page, "Where am I?")
        assert np.allclose(found(page)["pose"], poses[0])
        page.get_by_role("slider", name="Scan number").fill("8")
        until(page, "s.where.found?.index === 8")
        second = page.evaluate(FOUND)
        assert np.allclose(second["pose"], poses[8])
        assert np.hypot(*(np.array(second["modes"][0]["mean"][:2]) - poses[8, :2])) < 0.2
        playwright.expect(page.locator(".whereabouts")).to_contain_text("The robot was recorded")
        assert serious(page) == []
