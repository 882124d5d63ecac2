"""A figure that samples without a server: one file, in which the posterior follows the hand."""

import pytest
from acted_session import Acted
from page_driver import snapshot, until

from bayesmap.app.edits import tutorial_document
from bayesmap.app.figures import to_figure


@pytest.fixture
def figure(tmp_path):
    path = tmp_path / "figure.html"
    path.write_text(to_figure(tutorial_document()), encoding="utf-8")
    return path


def test_the_live_page_exports_a_figure_of_what_is_drawn_from_known_poses():
    acted = Acted()
    assert [said["name"] for said in acted.act("export", what="figure")] == ["figure.html"]
    acted.act("set", patch={"pose_sigma": 0.2})
    acted.act("export", what="figure")
    assert "set the uncertainty of the poses to 0" in acted.text


def test_a_figure_is_sampled_in_the_page_as_it_is_drawn_in(open_page, figure):
    page = open_page(figure.as_uri())
    until(page, "s.painted?.sweeps === s.document.sweeps")
    first = snapshot(page)
    truth = tutorial_document().is_wall
    assert first["painted"]["method"] == "gibbs"
    # Where the posterior is sure of a wall, there is one; and the cell of the robot is free.
    sure = first["probability"] > 250
    assert sure.sum() > 20
    assert truth[sure].mean() > 0.9
    assert first["probability"][10, 10] < 25
    assert first["probability"][8, 10] < 25
    # A wall is drawn beside the robot.
    at = page.evaluate("bayesmap.cellToClient(8, 10)")
    page.mouse.click(at["x"], at["y"])
    until(page, "s.painted.generation > 1 && s.painted.sweeps === s.document.sweeps")
    shown = snapshot(page)
    assert shown["walls"][8, 10] == 1
    assert shown["probability"][8, 10] > 250
    # What only a server can do is not offered.
    for name in ("Path", "Ghost", "Evidence"):
        assert not page.get_by_role("radio", name=name, exact=True).is_visible()
    page.get_by_role("button", name="Export", exact=True).click()
    offered = page.locator(".menu button:visible").all_inner_texts()
    assert offered == ["Picture (PNG)", "Document (JSON)"]
