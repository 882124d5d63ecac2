"""The robot under the hand: the posterior follows, and where it cannot stand is said."""

import numpy as np
import pytest
from page_driver import brightness_at, centre, document, settled, snapshot, until, watch
from page_hands import act, choose, click, enter, press, press_and_drag, select


@pytest.fixture
def sensors(page):
    choose(page, "Sensor")
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
    assert [moved["x"], moved["y"]] == pytest.approx([7.0, 8.0], abs=0.06)
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
    act(page, lambda: click(page, 8, 5))
    page.keyboard.up("Shift")
    both = settled(page)
    assert [sensor["id"] for sensor in both["sensors"]] == [1, 2]
    assert both["observed"].sum() > alone["observed"].sum()
    assert both["scan"]["ranges"].size == 2 * 100
    green = brightness_at(page, 8, 5)
    assert not page.get_by_label("heading").is_visible()  # in a full circle all headings are alike
    for name, degrees in (("Field of view", "180"), ("heading", "90")):
        act(page, lambda at=(name, degrees): page.get_by_label(at[0]).fill(at[1]) or page.keyboard.press("Tab"))
    assert settled(page)["sensors"][1]["yaw"] == pytest.approx(np.pi / 2)
    act(page, lambda: press(page, "Remove the sensor"))
    assert [sensor["id"] for sensor in settled(page)["sensors"]] == [1]
    assert brightness_at(page, 8, 5) > green + 20
    assert page.get_by_role("button", name="Remove the sensor").is_disabled()


@pytest.mark.full
def test_a_large_map_is_dragged_on_too(open_page):
    page = open_page(document())
    press(page, "New map")
    page.get_by_label("World").select_option("building")
    page.get_by_role("spinbutton", name="Width").fill("500")
    page.get_by_label("Height").fill("500")
    act(page, lambda: press(page, "Create"))
    choose(page, "Sensor")
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
def test_readings_spread_by_the_noise_or_are_exact_at_a_choice(open_page):
    page = open_page(document(angles=11, fov=np.pi / 2))
    assert settled(page)["scan"]["angles"] == pytest.approx(np.linspace(-np.pi / 4, np.pi / 4, 11), abs=1e-6)
    page = open_page(document())
    for noise in (0.2, 2.0, 0.01):
        if noise != 0.2:
            enter(page, "Noise (m)", noise)
        noisy = settled(page)
        near = noisy["scan"]["exact"] < 20
        spread = np.std((noisy["scan"]["ranges"] - noisy["scan"]["exact"])[near])
        assert spread == pytest.approx(noise, rel=0.35)  # of some 80 readings: 4 standard errors
    select(page, "Readings", "exact")
    exact = settled(page)["scan"]
    assert np.array_equal(exact["ranges"], exact["exact"])
    select(page, "Readings", "noisy")
    again = settled(page)
    assert np.array_equal(again["scan"]["ranges"], noisy["scan"]["ranges"])
    assert np.array_equal(again["probability"], noisy["probability"])
