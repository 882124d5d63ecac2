"""The preview while the hand moves, of beams that end a little past their readings, and the starts of chains."""

import math
from dataclasses import replace

import numpy as np
import pytest

from bayesmap.app import scene as scanning
from bayesmap.app.edits import new_document, tutorial_document
from bayesmap.app.protocol.document import Sensor
from bayesmap.app.scene import simulated_scene
from bayesmap.app.shown.chains import starts
from bayesmap.app.shown.without_chains import Preview
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.without_chains import propagate

BUILDING = new_document("building", (80, 60), tutorial_document())
SENSOR = BUILDING.sensors[0]
CASES = {
    "tutorial": tutorial_document(),
    "much noise": replace(tutorial_document(), noise=3.0),
    "rare walls": replace(tutorial_document(), prior=0.02),
    "exact readings, no noise": replace(tutorial_document(), readings="exact", noise=0.01),
    "a short range": replace(BUILDING, max_range=1.5),
    "a fan of two": replace(BUILDING, fov=math.pi / 2, sensors=(SENSOR, Sensor(2, SENSOR.x + 0.3, SENSOR.y, 2.0))),
    "a building": BUILDING,
}


def previewed(problem, rounds=math.inf):
    preview = Preview(problem)
    while preview.rounds < rounds and not (rounds == math.inf and preview.converged):
        preview.round()
    return preview


@pytest.mark.parametrize("name", CASES)
def test_beams_that_end_past_their_readings_say_what_whole_ones_say(name):
    scene = simulated_scene(CASES[name])
    near, whole = previewed(scene.near, 6), previewed(scene.problem, 6)
    least = 0.5 if name == "a building" else 1.0  # there most of a beam is left out
    assert near.problem.table.n_incidences <= least * whole.problem.table.n_incidences
    assert np.abs(near.mean() - whole.mean()).max() < 1e-5
    assert np.array_equal(near.observed(), whole.observed())


def test_beams_that_end_at_their_readings_say_something_else(monkeypatch):
    """A wrong twin."""
    monkeypatch.setattr(scanning, "NEAR_SIGMAS", 0.5)
    scene = simulated_scene(tutorial_document())
    assert np.abs(previewed(scene.near, 6).mean() - previewed(scene.problem, 6).mean()).max() > 0.05


def test_another_prior_shares_the_beams_that_there_are():
    scene = simulated_scene(tutorial_document())
    untouched = scene.with_prior(0.3)
    assert "problem" not in vars(untouched)
    assert untouched.problem.prior.p_wall == untouched.near.prior.p_wall == 0.3
    table, near = scene.problem.table, scene.near.table
    other = scene.with_prior(0.2)
    assert (other.problem.table, other.near.table) == (table, near)
    assert other.problem.prior.p_wall == other.near.prior.p_wall == 0.2


def test_a_preview_is_the_library_s_belief_propagation_and_one_chain_of_two_starts_from_it():
    document = tutorial_document()
    problem = simulated_scene(document).problem
    preview, whole = previewed(problem), propagate(WallProblem(problem.table, problem.prior, problem.poses))
    assert preview.rounds == len(whole.changes)
    assert np.abs(preview.mean() - whole.p_wall).max() < 1e-5
    begun = starts(problem, document, preview)
    assert begun.shape == (2, 21, 21)
    sure = np.abs(preview.mean() - 0.5) > 0.4
    assert np.array_equal(begun[0][sure], preview.mean()[sure] > 0.5)
    assert not begun[1].any()
    assert not starts(problem, replace(document, start="empty"), None).any()
    drawn = starts(problem, replace(document, start="prior"), None)
    assert 0.4 < drawn.mean() < 0.6
    assert not np.array_equal(drawn[0], drawn[1])
    assert np.array_equal(starts(problem, document, None), drawn)
