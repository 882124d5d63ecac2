"""Paths and views from the worker."""

from dataclasses import replace

import numpy as np
import pytest
from acted_engine import Heard, shown
from acted_session import Acted
from msgspec import structs

from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import FindPath, FindViews
from bayesmap.app.protocol.document import packed
from bayesmap.posterior.decisions import path_is_free

DOCUMENT = replace(tutorial_document(), sweeps=300)
PATH = FindPath((6.0, 15.0), (10.0, 14.0), 0.4, 0.05)


@pytest.mark.parametrize("mode", ["live", "run"])
def test_a_path_s_probability_is_that_of_the_draws(mode):
    heard = Heard()
    heard.infer(DOCUMENT, mode)
    header, _ = heard.answer(PATH)
    assert (header["type"], header["generation"]) == ("path", heard.generation)
    free = path_is_free(heard.engine._result.maps, header["path"], 0.4)
    assert header["probability"] == free.probability
    assert header["within_risk"] == (1 - free.probability <= 0.05)
    assert [header["path"][0], header["path"][-1]] == [[6.0, 15.0], [10.0, 14.0]]
    outside, _ = heard.answer(structs.replace(PATH, goal=(900.0, 3.0)))
    assert outside["type"] == "undecided"
    assert "outside" in outside["text"]
    if mode == "run":  # a saved run is decided by, too
        saved = shown(heard.engine._result.as_run())
        assert [saved.answer(question)[0]["type"] for question in (PATH, FindViews())] == ["path", "views"]


def test_a_path_needs_draws():
    heard = Heard()
    heard.infer(replace(DOCUMENT, method="propagate"), "preview")
    header, _ = heard.answer(PATH)
    assert header["type"] == "undecided"
    assert "draws" in header["text"]


def test_views_stand_where_it_is_free_and_tell_more_where_less_is_known():
    heard = Heard()
    _, field = heard.infer(DOCUMENT, "live")
    header, buffers = heard.answer(FindViews())
    assert (header["type"], header["spacing"]) == ("views", 1.0)
    pose, nats = buffers["pose"], buffers["nats"]
    assert pose.shape == (len(nats), 3)
    cells = np.floor(pose[:, :2] + 0.5).astype(int)
    assert (field["p"].reshape(21, 21)[tuple(cells.T)] < 0.31 * 255).all()
    assert (nats > 0).all()
    own = np.hypot(*(pose[:, :2] - [6.0, 15.0]).T).argmin()
    assert nats[own] < 0.7 * nats.max()  # looking again from the same place tells less
    walls = np.zeros((120, 80), dtype=bool)  # a large map has no more places than can be told apart
    grid = replace(DOCUMENT.grid, shape=(120, 80))
    heard.infer(replace(DOCUMENT, grid=grid, walls=packed(walls), max_range=60.0, sweeps=5), "live")
    assert 0 < len(heard.answer(FindViews())[1]["nats"]) <= 400


def test_questions_change_nothing():
    acted = Acted()
    before = acted.session.generation
    acted.act("path", start=[0, 0], goal=[1.5, 2], radius=0.2, risk=0.1)
    acted.act("views")
    assert acted.session.generation == before
    assert acted.asked == [(1, FindPath((0.0, 0.0), (1.5, 2.0), 0.2, 0.1)), (1, FindViews())]
