"""Every control changes what it says, and nothing else."""

import numpy as np
import pytest
from page_driver import document, settled, snapshot, until
from page_hands import enter, press, run, slide, undo


def test_the_prior_is_what_unobserved_cells_have_and_a_slider_moved_in_one_go_is_one_step_of_undo(page):
    shown = settled(page)
    touched = shown["observed"] > 0
    assert shown["probability"][20, 20] == pytest.approx(128, abs=15)  # 5 standard errors of 2000 draws
    slide(page, "Prior", 0.05)
    shown = settled(page)
    assert shown["document"]["prior"] == 0.05
    assert shown["probability"][20, 20] == pytest.approx(13, abs=7)
    hidden = ~touched & (shown["observed"] == 0)
    assert shown["probability"][hidden].mean() / 255 == pytest.approx(0.05, abs=0.02)
    slider = page.get_by_role("slider", name="Prior")
    box = slider.bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] * 0.5, y)
    page.mouse.down()
    for part in (0.45, 0.4, 0.35, 0.3):
        page.mouse.move(box["x"] + box["width"] * part, y)
    page.mouse.up()
    assert 0.1 < settled(page)["document"]["prior"] < 0.4
    page.keyboard.press("Escape")
    undo(page)
    assert settled(page)["document"]["prior"] == 0.05


@pytest.mark.full
def test_angles_sweeps_and_seed_and_the_same_document_has_the_same_posterior(page):
    first = settled(page)
    for angles in (10, 1000):
        enter(page, "Angles", angles)
        scan = settled(page)["scan"]
        assert scan["angles"].size == scan["ranges"].size == angles
    assert page.get_by_role("slider", name="Angles").get_attribute("aria-valuetext") == "1000"
    slide(page, "Angles", 500)  # the middle of a logarithmic scale
    assert settled(page)["document"]["angles"] == 100
    enter(page, "Sweeps", 250)
    assert settled(page)["painted"]["sweeps"] == 250
    enter(page, "Seed", 7)
    assert not np.array_equal(settled(page)["scan"]["ranges"], first["scan"]["ranges"])
    page.get_by_role("checkbox", name="Live").uncheck()  # it stays with the approximate answer
    enter(page, "Seed", 3)
    page.wait_for_timeout(300)
    assert snapshot(page)["painted"]["approximate"]
    assert page.get_by_text("mean \u00b7 approximate").is_visible()
    page.get_by_role("checkbox", name="Live").check()
    enter(page, "Seed", 0)
    enter(page, "Sweeps", 1000)
    again = settled(page)
    assert np.array_equal(again["scan"]["ranges"], first["scan"]["ranges"])
    assert np.array_equal(again["probability"], first["probability"])


@pytest.mark.full
@pytest.mark.parametrize("method", ["gibbs", "block", "propagate", "importance"])
def test_every_method_can_be_chosen_and_run(page, method):
    known = "s.seq.confirmed === s.seq.sent && s.painted?.generation === s.generation && !s.running"
    page.get_by_label("Method").select_option(method)
    until(page, known)
    assert page.get_by_label("Order").is_disabled() == (method != "gibbs")
    run(page)
    until(page, known)
    shown = snapshot(page)
    assert shown["document"]["method"] == shown["painted"]["method"] == method
    assert (shown["draws"]["count"] > 0) == (method in ("gibbs", "block"))


def sure(shown):
    """Mean probability of the drawn walls that are seen."""
    return shown["probability"][(shown["walls"] > 0) & (shown["observed"] > 0)].mean() / 255


def test_walls_blur_as_the_position_becomes_uncertain_and_0_gives_the_same_bits_again(open_page):
    page = open_page(document(sweeps=20, angles=40))
    known = settled(page)
    slide(page, "Position \u00b1", 1)
    blurred = settled(page)
    assert blurred["document"]["pose_sigma"] == 1
    assert blurred["painted"]["method"] == "gibbs"
    assert sure(known) > sure(blurred) + 0.1
    slide(page, "Position \u00b1", 0)
    assert np.array_equal(settled(page)["probability"], known["probability"])
    press(page, "Undo")
    until(page, "s.document.pose_sigma > 0")


@pytest.mark.full
def test_while_the_slider_is_dragged_no_picture_of_known_poses_comes_between(open_page):
    page = open_page(document(sweeps=200, pose_sigma=0.6))
    settled(page)
    slider, methods = page.get_by_role("slider", name="Position \u00b1"), set()
    for metres in np.arange(0.6, 1.6, 0.1):
        slider.fill(f"{metres:.2f}")
        for _ in range(4):
            methods.add(page.evaluate("() => bayesmap.snapshot().painted.method"))
            page.wait_for_timeout(20)
    assert methods == {"gibbs"}
