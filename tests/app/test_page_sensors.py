"""The robot under the hand: the posterior follows, and where it cannot stand is said."""

import numpy as np
import pytest
from page_driver import act, brightness_at, centre, document, press_and_drag, settled, snapshot, until, watch


@pytest.fixture
def sensors(page):
    page.get_by_role("radio", name="Sensor").check()
    settled(page)
    return page


def test_the_posterior_is_painted_while_the_robot_is_dragged(sensors):
    page = sensors
    watch(page, "s.painted.generation")
    before = snapshot(page)
    page.mouse.move(*centre(page, 10, 10))
    page.mouse.down()
    for k in range(1, 31):
        page.mouse.move(*centre(page, 10 - k / 10, 10 - k / 15))
        if k % 5 == 0:  # a picture now and then, however slow the machine: the hand is still there
            until(page, "s.painted.generation > argument", before["generation"] + k // 5 - 1)
    page.mouse.up()
    after = settled(page)
    seen = np.array(page.evaluate("window.seen"))
    moved = after["sensors"][0]
    assert moved["x"] == pytest.approx(7.0, abs=0.06)
    assert moved["y"] == pytest.approx(8.0, abs=0.06)
    assert len(seen) > 5
    assert (np.diff(seen) > 0).all()  # never an older picture
    assert len(after["events"]["eventToPaint_ms"]) >= 20
    assert after["scan"]["pose"] == pytest.approx([moved["x"], moved["y"], 0.0])
    act(page, lambda: page.keyboard.press("Control+z"))  # the whole drag is one step
    assert settled(page)["sensors"] == before["sensors"]


@pytest.mark.full
def test_the_server_refuses_too_and_says_so(sensors):
    page = sensors
    page.get_by_label("Selected sensor").select_option("1")
    page.evaluate("bayesmap.snapshot().walls[12 * 21 + 5] = 0")  # the page believes that there is no wall
    press_and_drag(page, [(10, 10), (12, 5)])
    until(page, "s.status.level !== 'info' && s.seq.confirmed === s.seq.sent")
    assert "wall" in snapshot(page)["status"]["text"]
    assert snapshot(page)["sensors"][0]["x"] == 10


@pytest.mark.full
def test_sensors_are_added_turned_and_removed(sensors):
    page = sensors
    alone = settled(page)
    page.mouse.move(*centre(page, 8, 5))
    page.keyboard.down("Shift")
    act(page, lambda: page.mouse.click(*centre(page, 8, 5)))
    page.keyboard.up("Shift")
    both = settled(page)
    assert [sensor["id"] for sensor in both["sensors"]] == [1, 2]
    assert both["observed"].sum() > alone["observed"].sum()
    assert both["scan"]["ranges"].size == 2 * 100
    green = brightness_at(page, 8, 5)
    assert not page.get_by_label("heading").is_visible()  # in a full circle all headings are alike
    act(page, lambda: page.get_by_label("Field of view").fill("180") or page.keyboard.press("Tab"))
    act(page, lambda: page.get_by_label("heading").fill("90") or page.keyboard.press("Tab"))
    assert settled(page)["sensors"][1]["yaw"] == pytest.approx(np.pi / 2)
    act(page, lambda: page.get_by_role("button", name="Remove the sensor").click())
    assert [sensor["id"] for sensor in settled(page)["sensors"]] == [1]
    assert brightness_at(page, 8, 5) > green + 20
    assert page.get_by_role("button", name="Remove the sensor").is_disabled()


@pytest.mark.full
def test_moving_one_sensor_does_not_change_the_noise_of_another(open_page):
    two = [{"id": 1, "x": 10.0, "y": 10.0, "yaw": 0.0}, {"id": 2, "x": 8.0, "y": 5.0, "yaw": 0.0}]
    page = open_page(document(sensors=two))
    before = settled(page)["scan"]["ranges"].reshape(2, -1)
    page.get_by_role("radio", name="Sensor").check()
    act(page, lambda: press_and_drag(page, [(8, 5), (9, 5)]))
    after = settled(page)["scan"]["ranges"].reshape(2, -1)
    assert np.array_equal(before[0], after[0])
    assert not np.array_equal(before[1], after[1])


@pytest.mark.full
def test_a_large_map_is_dragged_on_too(open_page):
    page = open_page(document())
    page.get_by_role("button", name="New map").click()
    page.get_by_label("World").select_option("building")
    page.get_by_role("spinbutton", name="Width").fill("500")
    page.get_by_label("Height").fill("500")
    act(page, lambda: page.get_by_role("button", name="Create").click())
    page.get_by_role("radio", name="Sensor").check()
    before = snapshot(page)
    sensor = before["sensors"][0]
    x, y = int(sensor["x"] * 10), int(sensor["y"] * 10)
    press_and_drag(page, [(x, y), (x + 2, y + 1), (x + 4, y + 2)], steps=4)
    until(page, "s.seq.confirmed === s.seq.sent && s.painted.generation === s.generation")
    after = snapshot(page)
    assert after["sensors"][0]["x"] == pytest.approx(sensor["x"] + 0.4, abs=0.15)
    assert after["painted"]["generation"] > before["generation"]
    assert after["probability"].shape == (500, 500)


@pytest.mark.full
def test_a_field_of_view_is_about_the_heading(open_page):
    page = open_page(document(angles=11, fov=np.pi / 2))
    scan = settled(page)["scan"]
    assert scan["angles"] == pytest.approx(np.linspace(-np.pi / 4, np.pi / 4, 11), abs=1e-6)


@pytest.mark.full
def test_exact_and_noisy_readings_are_compared_at_a_choice(open_page):
    page = open_page(document(noise=1.0))
    noisy = settled(page)
    act(page, lambda: page.get_by_role("combobox", name="Readings").select_option("exact"))
    exact = settled(page)
    assert np.array_equal(exact["scan"]["ranges"], exact["scan"]["exact"])
    assert not np.array_equal(noisy["scan"]["ranges"], noisy["scan"]["exact"])
    act(page, lambda: page.get_by_role("combobox", name="Readings").select_option("noisy"))
    again = settled(page)
    assert np.array_equal(again["scan"]["ranges"], noisy["scan"]["ranges"])
    assert np.array_equal(again["probability"], noisy["probability"])
