"""Sliders for how well the sensor's pose is known: walls blur as it is known less, and 0 changes nothing."""

import numpy as np
from page_driver import act, document, settled, snapshot, until


def put(page, name, value):
    act(page, lambda: page.get_by_label(f"{name} \u00b1, number").fill(str(value)) or page.keyboard.press("Tab"))


def sure(shown):
    """Mean probability of the drawn walls that are seen."""
    return shown["probability"][(shown["walls"] > 0) & (shown["observed"] > 0)].mean() / 255


def test_walls_blur_while_the_slider_is_moved_and_0_gives_the_same_bits_again(open_page):
    page = open_page(document(sweeps=60))
    known = settled(page)
    slider = page.get_by_role("slider", name="Position \u00b1")
    blurred = []
    for metres in ("0.5", "1", "2"):
        act(page, lambda metres=metres: slider.fill(metres))
        until(page, "s.document.pose_sigma === argument", float(metres))
        shown = settled(page)
        assert shown["painted"]["method"] == "gibbs"
        blurred.append(sure(shown))
    assert sure(known) > blurred[0] + 0.1 > blurred[1] + 0.1
    assert blurred[1] > blurred[2] + 0.05
    act(page, lambda: slider.fill("0"))
    assert np.array_equal(settled(page)["probability"], known["probability"])
    page.get_by_role("button", name="Undo").click()
    until(page, "s.document.pose_sigma > 0")


def test_headings_are_in_degrees_on_the_page_and_in_radians_in_the_document(page):
    settled(page)
    put(page, "Yaw", 10)
    assert abs(snapshot(page)["document"]["heading_sigma"] - np.radians(10)) < 1e-9
    assert page.get_by_label("Yaw \u00b1, number").input_value() == "10"
    page.get_by_role("slider", name="Yaw \u00b1").fill("30")
    until(page, "Math.abs(s.document.heading_sigma - Math.PI / 6) < 1e-9")
    put(page, "Yaw", 0)


def test_a_method_that_takes_poses_as_known_says_so(page):
    settled(page)
    put(page, "Position", 0.4)
    remark = page.get_by_text("This method takes poses as known")
    assert not remark.is_visible()
    act(page, lambda: page.get_by_label("Method").select_option("propagate"))
    remark.wait_for()
    act(page, lambda: page.get_by_label("Method").select_option("auto"))
    put(page, "Position", 0)


def test_while_the_slider_is_dragged_no_picture_of_known_poses_comes_between(open_page):
    page = open_page(document(sweeps=200, pose_sigma=0.6))
    settled(page)
    slider = page.get_by_role("slider", name="Position \u00b1")
    methods = set()
    for metres in np.arange(0.6, 1.6, 0.1):
        slider.fill(f"{metres:.2f}")
        for _ in range(4):
            methods.add(page.evaluate("() => bayesmap.snapshot().painted.method"))
            page.wait_for_timeout(20)
    assert methods == {"gibbs"}
