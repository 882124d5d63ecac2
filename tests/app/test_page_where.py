"""Where am I? A cloud of poses over the map, live while the robot is dragged, and the same in words."""

import base64
import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from axe_playwright_python.sync_playwright import Axe
from page_driver import centre, colour_at, document, served, settled, snapshot, until, watch

import bayesmap as bm

FOUND = """() => {
  const f = bayesmap.snapshot().where.found;
  return f && {...f, cloud: [...f.cloud], weight: [...f.weight]};
}"""


def square():
    walls = np.zeros((21, 21), dtype=bool)
    walls[4:17, [4, 16]] = walls[[4, 16], 4:17] = True
    return base64.b64encode(np.packbits(walls.ravel()).tobytes()).decode()


def ask(page):
    page.get_by_role("radio", name="Where am I").check()


def found(page):
    until(page, "s.where.found && s.where.found.of === s.generation")
    return page.evaluate(FOUND)


def test_the_robot_of_the_tutorial_has_one_place(page):
    settled(page)
    ask(page)
    answer = found(page)
    (place,) = answer["modes"]
    robot = snapshot(page)["sensors"][0]
    assert np.hypot(place["mean"][0] - robot["x"], place["mean"][1] - robot["y"]) < 0.1
    said = page.locator(".whereabouts")
    playwright.expect(said).to_contain_text("One place: ")
    playwright.expect(said).to_contain_text("The robot stands")
    assert len(answer["cloud"]) == 3 * len(answer["weight"])
    page.get_by_role("radio", name="Pan").check()
    until(page, "!s.where.found")


@pytest.mark.full
def test_a_square_room_has_four_places_with_probabilities(open_page):
    page = open_page(document(walls=square(), noise=0.05, angles=90, sensors=[sensor(8.3, 9.1)]))
    settled(page)
    ask(page)
    answer = found(page)
    assert len(answer["modes"]) == 4
    said = page.locator(".whereabouts").inner_text()
    listed = [int(number) for number in re.findall(r"(\d+) %", said)]
    assert said.startswith("4 places: ")
    assert listed[:4] == [round(100 * mode["probability"]) for mode in answer["modes"]]
    for mode in answer["modes"]:  # each is marked on the map
        x, y = mode["mean"][:2]
        before = colour_at(page, x, y)
        assert before[2] > before[1] + 30  # violet


def sensor(x, y, yaw=0.2):
    return {"id": 1, "x": x, "y": y, "yaw": yaw}


@pytest.mark.full
def test_the_cloud_follows_the_robot_while_it_is_dragged(open_page):
    page = open_page(document(walls=square(), noise=0.05, angles=90, sensors=[sensor(8, 9)]))
    settled(page)
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
def test_a_room_that_loses_its_symmetry_loses_places(open_page):
    page = open_page(document(walls=square(), noise=0.05, angles=90, sensors=[sensor(8.3, 9.1)]))
    settled(page)
    page.get_by_role("radio", name="Draw", exact=True).check()
    page.mouse.click(*centre(page, 13, 6))
    settled(page)
    ask(page)
    assert len([m for m in found(page)["modes"] if m["probability"] > 0.01]) == 1
    playwright.expect(page.locator(".whereabouts")).to_contain_text("One place")


@pytest.mark.full
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_scan_of_a_run_is_located_in_its_map(open_page, tmp_path, scheme):
    grid = bm.Grid((50, 36), 0.1)
    walls = np.zeros(grid.shape, dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[20:23, :14] = walls[34:, 24:] = True
    t = np.linspace(0, 1, 12)
    poses = np.column_stack([1.0 + 2.5 * t, 2.6 - 0.6 * t, 2 * t])
    laser = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01)
    angles = np.linspace(-np.pi, np.pi, 90, endpoint=False)
    scans = bm.simulate(walls, grid, poses, angles, sensor=laser, max_range_m=8.0, seed=2)
    bm.infer(scans, grid, prior=bm.Surface(), sensor=laser, schedule=bm.Schedule(chains=2, warmup=10, draws=10)).save(
        tmp_path / "run.nc"
    )
    with served(tmp_path / "run.nc") as (address, _):
        page = open_page(address, color_scheme=scheme, bypass_csp=True)
        ask(page)
        first = found(page)
        assert np.allclose(first["pose"], poses[0])
        page.get_by_role("slider", name="Scan number").fill("8")
        until(page, "s.where.found?.index === 8")
        second = page.evaluate(FOUND)
        assert np.allclose(second["pose"], poses[8])
        best = second["modes"][0]
        assert np.hypot(best["mean"][0] - poses[8, 0], best["mean"][1] - poses[8, 1]) < 0.2
        playwright.expect(page.locator(".whereabouts")).to_contain_text("The robot was recorded")
        violations = Axe().run(page).response["violations"]
        assert [rule["id"] for rule in violations if rule["impact"] in ("serious", "critical")] == []
