"""The quick answer while the hand moves: of beams that end a little past their readings."""

import math
from dataclasses import replace

import numpy as np
import pytest

from bayesmap.app import scene as scanning
from bayesmap.app.edits import new_document, tutorial_document
from bayesmap.app.protocol.document import Sensor
from bayesmap.app.scene import simulated_scene
from bayesmap.app.shown.without_chains import Preview

ROUNDS = 6
BUILDING = new_document("building", (80, 60), tutorial_document())
SENSOR = BUILDING.sensors[0]
CASES = {
    "tutorial": tutorial_document(),
    "much noise": replace(tutorial_document(), noise=3.0),
    "rare walls": replace(tutorial_document(), prior=0.02),
    "exact readings, no noise": replace(tutorial_document(), readings="exact", noise=0.0),
    "a short range": replace(BUILDING, max_range=1.5),
    "a fan of two": replace(BUILDING, fov=math.pi / 2, sensors=(SENSOR, Sensor(2, SENSOR.x + 0.3, SENSOR.y, 2.0))),
    "a building": BUILDING,
}


def rounds(problem):
    preview = Preview(problem)
    while preview.rounds < ROUNDS:
        preview.round()
    return preview


@pytest.mark.parametrize("name", CASES)
def test_beams_that_end_past_their_readings_say_what_whole_ones_say(name):
    scene = simulated_scene(CASES[name])
    near, whole = rounds(scene.near), rounds(scene.problem)
    assert near.problem.table.n_incidences <= whole.problem.table.n_incidences
    assert np.abs(near.mean() - whole.mean()).max() < 1e-5
    assert np.array_equal(near.observed(), whole.observed())


def test_most_of_a_beam_through_a_building_is_left_out():
    scene = simulated_scene(BUILDING)
    assert scene.near.n_incidences < 0.5 * scene.problem.n_incidences


def test_beams_that_end_at_their_readings_say_something_else(monkeypatch):
    """A wrong twin."""
    monkeypatch.setattr(scanning, "NEAR_SIGMAS", 0.5)
    scene = simulated_scene(tutorial_document())
    assert np.abs(rounds(scene.near).mean() - rounds(scene.problem).mean()).max() > 0.05


def test_another_prior_shares_the_beams_that_there_are():
    scene = simulated_scene(tutorial_document())
    untouched = scene.with_prior(0.3)
    assert "problem" not in vars(untouched)
    assert untouched.problem.prior.p_wall == untouched.near.prior.p_wall == 0.3
    table, near = scene.problem.table, scene.near.table
    other = scene.with_prior(0.2)
    assert other.problem.table is table
    assert other.near.table is near
    assert other.problem.prior.p_wall == other.near.prior.p_wall == 0.2
