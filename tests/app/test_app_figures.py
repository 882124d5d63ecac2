"""Pages that sample without a server, and stories: read, refused with the step and the key, and gone through."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from acted import Acted
from page_driver import snapshot, until
from page_hands import click

from bayesmap.app.edits import tutorial_document
from bayesmap.app.figures import BUILT_IN_STORY, figure_page, read_story
from bayesmap.app.session import Session
from bayesmap.errors import BadInput


def test_the_live_page_exports_a_figure_of_what_is_drawn_from_known_poses():
    acted = Acted()
    assert [said["name"] for said in acted.act("export", what="figure")] == ["figure.html"]
    acted.act("set", patch={"pose_sigma": 0.2})
    acted.act("export", what="figure")
    assert "set the uncertainty of the poses to 0" in acted.text


def test_a_figure_is_sampled_in_the_page_as_it_is_drawn_in(open_page, tmp_path):
    (tmp_path / "figure.html").write_text(figure_page(tutorial_document()), encoding="utf-8")
    page = open_page((tmp_path / "figure.html").as_uri())
    until(page, "s.painted?.sweeps === s.document.sweeps")
    first = snapshot(page)
    sure = first["probability"] > 250
    assert first["painted"]["method"] == "gibbs"
    assert sure.sum() > 20
    assert tutorial_document().is_wall[sure].mean() > 0.9
    assert max(first["probability"][[10, 8], 10]) < 25
    click(page, 8, 10)  # a wall is drawn beside the robot
    until(page, "s.painted.generation > 1 && s.painted.sweeps === s.document.sweeps")
    shown = snapshot(page)
    assert shown["walls"][8, 10] == 1
    assert shown["probability"][8, 10] > 250
    for name in ("Path", "Ghost", "Evidence"):  # only a server can answer these
        assert not page.get_by_role("radio", name=name, exact=True).is_visible()
    page.get_by_role("button", name="Export", exact=True).click()
    assert page.locator(".menu button:visible").all_inner_texts() == ["Picture (PNG)", "Document (JSON)"]


PAGE = (Path(__file__).parents[2] / "docs/stories.md").read_text(encoding="utf-8")
EXAMPLE = json.loads(re.search("```json\n(.*?)```", PAGE, re.DOTALL)[1])
DONE = "s.painted.generation === s.generation && s.painted.sweeps === s.document.sweeps"


def told(tmp_path, **second):
    """Read the story of the documentation's example with changes to its second step."""
    first, other = EXAMPLE["steps"]
    (tmp_path / "own.json").write_text(json.dumps({**EXAMPLE, "steps": [first, {**other, **second}]}))
    return read_story(str(tmp_path / "own.json"), tutorial_document(7))


def test_states_change_the_start_and_solutions_their_state(tmp_path):
    first, second = told(tmp_path, state=tutorial_document().to_json()).steps
    known = [(one.prior, one.noise, one.seed) for one in (first.document, first.solution, second.document)]
    assert known == [(0.2, 0.1, 7), (0.5, 0.1, 7), (0.5, 0.2, 0)]
    assert np.argwhere(first.document.is_wall).tolist() == [[7, 1], [7, 2], [7, 3]]  # as it is drawn
    assert (second.document, second.solution, second.layer) == (tutorial_document(), None, "entropy")


@pytest.mark.parametrize(("step", "why"), [
    ({"state": {"noise": 99}}, r"step 2, state: noise \(m\): 99 is not a number from 0.01 to 5"),
    ({"solution": {"nois": 1}}, "step 2, solution: there is no nois; there are: map, prior,"),
    ({"task": None}, "step 2.task: None is not a text"), ({"tool": "pen"}, "step 2.tool: 'pen' is not one of"),
    ({"tsk": ""}, "step 2: there is no tsk; there are: title, text, task, state"),
    ({"state": {"map": ["..", ".."]}}, "step 2, state: the sensor cannot stand outside"),
    ({"state": {"map": ["##", "#"]}}, "step 2, state: drawing: line 2 has 1 cells"),
])  # fmt: skip
def test_a_wrong_step_is_refused_with_its_number_and_its_key(tmp_path, step, why):
    with pytest.raises(BadInput, match=rf"own\.json: {why}.*docs/stories\.md"):
        told(tmp_path, **step)


def test_files_without_a_story_and_steps_that_no_figure_has_are_refused(tmp_path):
    for step, why in (
        ({"tool": "path"}, "step 2: tool: a figure has no path"),
        ({"state": {"method": "propagate"}}, "step 2: method"),
    ):
        with pytest.raises(BadInput, match=why):
            figure_page(tutorial_document(), told(tmp_path, **step))
    for text, why in (("{", "not JSON"), ("[]", "story: "), ('{"title": "a", "steps": []}', "a list of 1 to 30")):
        (tmp_path / "none.json").write_text(text)
        with pytest.raises(BadInput, match=rf"none\.json: .*{why}"):
            read_story(str(tmp_path / "none.json"), tutorial_document())


def test_a_reader_goes_through_our_story_in_one_file(open_page, tmp_path):
    story = read_story(BUILT_IN_STORY, tutorial_document())
    assert next(iter(Session(story.steps[0].document, story).join(1))).message.story == story  # of a server, too
    (tmp_path / "story.html").write_text(figure_page(story.steps[0].document, story), encoding="utf-8")
    page = open_page((tmp_path / "story.html").as_uri() + "#step=3")
    until(page, f"s.painted.method === 'importance' && s.painted.ess < 2 && {DONE}")
    page.get_by_role("button", name="Particles", exact=True).click()  # the name leads to the control
    assert 0 < page.get_by_role("slider", name="Particles").bounding_box()["y"] < page.viewport_size["height"]
    page.get_by_role("button", name="Next", exact=True).click()  # another state, and the address follows
    until(page, f"s.document.order === 'radial' && s.painted.layer === 'draw' && {DONE}")
    assert page.evaluate("location.hash") == "#step=4"
    outwards = snapshot(page)["painted"]["trace"]  # both chains arrive within six sweeps; row by row they do not
    page.get_by_role("button", name="Show me").click()
    until(page, f"s.document.order === 'raster' && {DONE}")
    assert min(map(float, outwards[5::6])) > -1000 > max(map(float, snapshot(page)["painted"]["trace"][5::6]))
    page.get_by_role("link", name="Step 7").click()  # the last one locates the scan in the page, in a known map
    until(page, "s.where.found?.modes.length === 4 && location.hash === '#step=7'")
    page.get_by_text("known map: the walls as drawn").wait_for()
    page.get_by_role("button", name="Show me").click()
    until(page, "s.where.found?.modes.length === 1 && Math.abs(s.where.found.modes[0].mean[0] - 6) < 0.2")
