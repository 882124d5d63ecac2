"""Chains of the page start apart."""

from dataclasses import replace

import numpy as np

from bayesmap.app.edits import tutorial_document
from bayesmap.app.scene import simulated_scene
from bayesmap.app.shown.chains import starts
from bayesmap.app.shown.without_chains import Preview


def test_after_a_preview_one_chain_starts_from_it_and_the_other_from_nothing():
    document = tutorial_document()
    problem = simulated_scene(document).problem
    preview = Preview(problem)
    while not preview.converged:
        preview.round()
    begun = starts(problem, document, preview)
    assert begun.shape == (2, 21, 21)
    sure = np.abs(preview.mean() - 0.5) > 0.4
    assert np.array_equal(begun[0][sure], preview.mean()[sure] > 0.5)
    assert not begun[1].any()


def test_named_starts_are_what_they_say():
    document = tutorial_document()
    problem = simulated_scene(document).problem
    assert not starts(problem, replace(document, start="empty"), None).any()
    drawn = starts(problem, replace(document, start="prior"), None)
    assert 0.4 < drawn.mean() < 0.6
    assert not np.array_equal(drawn[0], drawn[1])
    assert np.array_equal(starts(problem, document, None), drawn)
