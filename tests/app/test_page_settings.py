"""Every control changes what it says, and nothing else."""

import numpy as np
import pytest
from page_driver import act, settled, snapshot, until


def by_number(page, name, value):
    field = page.get_by_role("spinbutton", name=name)
    field.fill(str(value))
    field.press("Tab")


def test_the_prior_is_what_unobserved_cells_have(page):
    shown = settled(page)
    touched = shown["observed"] > 0
    assert shown["probability"][20, 20] == pytest.approx(128, abs=15)  # 5 standard errors of 2000 draws
    act(page, lambda: page.get_by_role("slider", name="Prior").fill("0.05"))
    shown = settled(page)
    assert shown["document"]["prior"] == 0.05
    assert shown["probability"][20, 20] == pytest.approx(13, abs=7)
    hidden = ~touched & (shown["observed"] == 0)
    assert shown["probability"][hidden].mean() / 255 == pytest.approx(0.05, abs=0.02)


@pytest.mark.full
def test_noise_spreads_the_readings(page):
    def spread():
        scan = settled(page)["scan"]
        near = scan["exact"] < 20
        return np.std((scan["ranges"] - scan["exact"])[near])

    assert spread() == pytest.approx(0.2, rel=0.35)  # of some 80 readings: 4 standard errors
    act(page, lambda: page.get_by_role("slider", name="Noise").fill("2"))
    assert spread() == pytest.approx(2.0, rel=0.35)
    act(page, lambda: page.get_by_role("slider", name="Noise").fill("0"))
    assert spread() < 0.05


@pytest.mark.full
def test_angles_from_ten_to_a_thousand(page):
    settled(page)
    for angles in (10, 1000):
        act(page, lambda n=angles: by_number(page, "Angles", n))
        scan = settled(page)["scan"]
        assert scan["angles"].size == scan["ranges"].size == angles
    slider = page.get_by_role("slider", name="Angles")
    assert slider.get_attribute("aria-valuetext") == "1000"
    act(page, lambda: slider.fill("500"))  # the middle of a logarithmic scale
    assert settled(page)["document"]["angles"] == 100


def test_a_slider_moved_in_one_go_is_one_step_of_undo(page):
    settled(page)
    slider = page.get_by_role("slider", name="Prior")
    box = slider.bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] * 0.5, y)
    page.mouse.down()
    for part in (0.45, 0.4, 0.3, 0.2):
        page.mouse.move(box["x"] + box["width"] * part, y)
    page.mouse.up()
    assert settled(page)["document"]["prior"] < 0.3
    page.keyboard.press("Escape")
    act(page, lambda: page.get_by_role("button", name="Undo").click())
    assert settled(page)["document"]["prior"] == 0.5


@pytest.mark.full
@pytest.mark.parametrize("method", ["gibbs", "block", "propagate", "importance"])
def test_every_method_can_be_chosen_and_run(page, method):
    page.get_by_label("Method").select_option(method)
    settled_or_preview(page)
    assert page.get_by_label("Order").is_disabled() == (method != "gibbs")
    page.get_by_role("button", name="Run", exact=True).click()
    shown = settled_or_preview(page)
    assert shown["document"]["method"] == shown["painted"]["method"] == method
    assert (shown["draws"]["count"] > 0) == (method in ("gibbs", "block"))


def settled_or_preview(page):
    until(page, "s.seq.confirmed === s.seq.sent && s.painted?.generation === s.generation && !s.running")
    return snapshot(page)


@pytest.mark.full
def test_sweeps_and_seed(page):
    first = settled(page)
    act(page, lambda: by_number(page, "Sweeps", 250))
    assert settled(page)["painted"]["sweeps"] == 250
    act(page, lambda: by_number(page, "Seed", 7))
    other = settled(page)
    assert not np.array_equal(other["scan"]["ranges"], first["scan"]["ranges"])
    act(page, lambda: by_number(page, "Seed", 0))
    act(page, lambda: by_number(page, "Sweeps", 1000))
    again = settled(page)
    assert np.array_equal(again["scan"]["ranges"], first["scan"]["ranges"])
    assert np.array_equal(again["probability"], first["probability"])  # same document, same posterior


@pytest.mark.full
def test_live_off_stays_with_the_approximate_answer(page):
    settled(page)
    page.get_by_role("checkbox", name="Live").uncheck()
    try:
        act(page, lambda: by_number(page, "Seed", 3))
        page.wait_for_timeout(300)
        assert snapshot(page)["painted"]["approximate"]
        assert page.get_by_text("mean \u00b7 approximate").is_visible()
    finally:
        page.get_by_role("checkbox", name="Live").check()
    assert not settled(page)["painted"]["approximate"]
