"""Decisions on the page: two clicks give a path and its probability; a click on the map of views places a sensor."""

import numpy as np
import playwright.sync_api as playwright
import pytest
from page_driver import document, settled, snapshot, until
from page_hands import act, choose, click, enter, press_and_drag

VIEWS = "() => { const v = bayesmap.snapshot().decisions.views; return {pose: [...v.pose], nats: [...v.nats]}; }"


def found_path(page):
    until(page, "s.decisions.path || s.decisions.trouble")
    return snapshot(page)["decisions"]["path"]


def test_two_clicks_give_a_path_and_its_probability(page):
    settled(page)
    choose(page, "Path")
    said = page.locator(".said")
    playwright.expect(said).to_contain_text("Click where the robot is")
    click(page, 6, 15)
    playwright.expect(said).to_contain_text("where it is to go")
    click(page, 10, 14)
    path = found_path(page)
    assert path["path"][0] == pytest.approx([6, 15], abs=0.5)
    assert path["path"][-1] == pytest.approx([10, 14], abs=0.5)
    assert 0 <= path["probability"] <= 1
    playwright.expect(said).to_contain_text(f"free with probability {path['probability']:.3f}")
    assert "Independent cells" in said.inner_text()
    before = snapshot(page)["layers"]["decisions"]
    click(page, 3, 3)  # the start of another
    until(page, "!s.decisions.path")
    until(page, "s.layers.decisions > argument", before)


@pytest.mark.full
def test_why_there_is_no_path_is_said_plainly_and_of_the_path_alone(page):
    shown = settled(page)
    x, y = next((x, y) for x, y in np.argwhere(shown["walls"]).tolist() if shown["probability"][x, y] == 255)
    choose(page, "Path")
    click(page, x, y)
    click(page, 10, 14)
    until(page, "s.decisions.trouble")
    said = page.locator(".said")
    playwright.expect(said).to_contain_text(f"At the start ({x:.2f}, {y:.2f} m) the disc touches something")
    choose(page, "Look next")
    until(page, "s.decisions.views")
    enter(page, "Prior P(wall)", 0.44)
    settled(page)  # both are asked for again
    until(page, "s.decisions.views && s.decisions.trouble")
    playwright.expect(said).to_contain_text("One more scan would tell")


@pytest.mark.full
def test_a_wall_drawn_across_is_decided_about_anew(open_page):
    page = open_page(document(noise=0.1, prior=0.1))
    settled(page)
    choose(page, "Path")
    click(page, 6, 15)
    click(page, 10, 14)
    until(page, "s.decisions.path")
    first = snapshot(page)["generation"]
    choose(page, "Draw")
    act(page, lambda: press_and_drag(page, [(8, 13), (8, 17)], steps=4))
    settled(page)
    until(page, "s.decisions.path?.generation > argument || s.decisions.trouble", first)


def test_looking_where_most_is_to_be_learnt_closes_the_loop(page):
    """Look, infer, choose the next view, look again: the map is known better, and less is left to learn there."""
    choose(page, "Look next")
    before = settled(page)
    until(page, "s.decisions.views && s.decisions.views.nats.length > 5")
    for _ in range(2000):  # views may come anew: words and numbers are read until they are of the same ones
        views, words = page.evaluate(VIEWS), page.locator(".said").inner_text()
        nats = np.array(views["nats"])
        if f"{nats.max():.1f} nats" in words:
            break
        page.wait_for_timeout(15)
    else:
        pytest.fail(f"{words!r} is not of {nats}")
    pose = np.reshape(views["pose"], (-1, 3))
    cells = np.round(pose[:, :2]).astype(int)
    best = next(i for i in np.argsort(-nats) if not before["walls"][tuple(cells[i])])
    act(page, lambda: click(page, *cells[best].tolist()))
    after = settled(page)
    assert len(after["sensors"]) == len(before["sensors"]) + 1
    new = after["sensors"][-1]
    assert [new["x"], new["y"]] == pytest.approx(pose[best, :2].tolist(), abs=1e-3)
    assert after["observed"].sum() > before["observed"].sum()
    until(page, "s.decisions.views && Math.max(...s.decisions.views.nats) !== argument", float(nats.max()))


@pytest.mark.full
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_saved_run_of_surfaces_has_paths_and_views(open_page, room, scheme):
    page = open_page(room[1], color_scheme=scheme)
    choose(page, "Path")
    click(page, 7, 12)
    click(page, 12, 22)
    assert found_path(page)["draws"] == 20
    choose(page, "Look next")
    until(page, "s.decisions.views")
    click(page, 12, 20)
    page.get_by_text("would tell").first.wait_for()
    assert len(snapshot(page)["sensors"]) == 0
