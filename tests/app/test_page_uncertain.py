"""Sliders for how well the sensor's pose is known: walls blur as it is known less, and 0 changes nothing."""

import numpy as np
import pytest
from page_driver import act, document, settled, until


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


@pytest.mark.full
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
