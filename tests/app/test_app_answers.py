"""Answers of the worker: paths, views, and the posterior over the pose of a scan, in a drawn world and on a run."""

from dataclasses import replace

import numpy as np
import pytest
from acted_engine import Heard, shown
from acted_session import Acted
from building_log import bent_room_run
from msgspec import structs

from bayesmap.app.answers.whereabouts import Locator, drawn_map
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import FindPath, FindViews, ShowScan, WhereAmI
from bayesmap.app.protocol.document import Sensor, no_walls, packed
from bayesmap.app.sources import opened_log, opened_run
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


def asked(document, sensor=1):
    heard = Heard()
    heard.infer(document, "preview")
    return heard.answer(WhereAmI(sensor))


def square(**changes):
    walls = np.zeros((21, 21), dtype=bool)
    walls[4:17, [4, 16]] = walls[[4, 16], 4:17] = True
    return replace(tutorial_document(), walls=packed(walls), noise=0.05, **changes)


def test_the_robot_of_the_tutorial_knows_where_it_is():
    header, buffers = asked(tutorial_document())
    modes, pose = header["modes"], header["pose"]
    assert len(modes) == 1
    assert modes[0]["probability"] == pytest.approx(1.0)
    assert np.abs(np.array(modes[0]["mean"][:2]) - pose[:2]).max() < 4 * modes[0]["sigma_m"] < 0.3
    assert header["p_lost"] < 1e-3
    assert buffers["pose"].shape == (len(buffers["weight"]), 3)
    assert buffers["weight"].sum() == pytest.approx(1.0, abs=1e-4)
    assert (np.diff(buffers["weight"]) >= 0).all()
    assert np.array_equal(asked(tutorial_document())[1]["pose"], buffers["pose"])


def test_in_a_square_room_there_are_four_places_and_the_truth_is_one():
    document = square(sensors=(Sensor(1, 8.3, 9.1, 0.2), Sensor(5, 11.0, 13.0, 0.0)))
    modes = asked(document)[0]["modes"]
    assert [mode["probability"] > 0.1 for mode in modes] == [True] * 4
    away = [np.hypot(mode["mean"][0] - 8.3, mode["mean"][1] - 9.1) for mode in modes]
    assert min(away) < 0.05
    assert sum(distance < 1.0 for distance in away) == 1
    header, _ = asked(document, sensor=5)
    assert (header["sensor"], header["pose"]) == (5, [11.0, 13.0, 0.0])
    assert asked(document, sensor=9)[0]["sensor"] == 1


def test_a_world_of_nothing_leaves_it_open():
    header, _ = asked(replace(tutorial_document(), walls=no_walls(tutorial_document().grid)))
    assert header["modes"][0]["sigma_m"] > 5.0
    assert header["p_lost"] < 0.1


def test_the_drawn_map_is_the_same_on_finer_cells():
    document = tutorial_document()
    known = drawn_map(document)
    assert known.grid.resolution <= 0.125
    assert known.grid.extent_m == document.grid.extent_m
    assert known.free.sum() * known.grid.resolution**2 == pytest.approx((~document.is_wall).sum())


@pytest.fixture(scope="module")
def run():
    return bent_room_run()


def test_the_scan_on_show_is_located_in_the_map_of_a_run(run):
    heard = shown(run, scan=3)
    for index in (3, 9):
        heard.ask(ShowScan(index))
        header, _ = heard.answer(WhereAmI())
        assert (header["index"], header["pose"]) == (index, run.posterior.scans.poses[index].tolist())
        best = header["modes"][0]
        assert best["probability"] > 0.9
        assert np.hypot(*(np.array(best["mean"][:2]) - header["pose"][:2])) < 0.15
        assert header["p_lost"] < 0.05


def test_a_scan_of_nowhere_is_lost(run):
    """Readings as common as the map's own, but in an order that no place has."""
    ranges_m = np.random.default_rng(3).permuted(run.posterior.scans.ranges_m, axis=1)
    result = opened_run(run, "run.nc").result
    result = replace(result, scene=replace(result.scene, scans=replace(run.posterior.scans, ranges_m=ranges_m)))
    notice, _ = Locator().answer(WhereAmI(), result, 0, 1)
    assert notice.p_lost > 0.5


def test_a_question_waits_for_a_picture_or_says_why_there_is_no_answer(run):
    heard = Heard()
    assert "no map" in heard.answer(WhereAmI())[0]["trouble"]
    heard.infer(tutorial_document(), "preview", steps=0)
    assert heard.ask(WhereAmI(1)) == []
    heard.finish()
    assert (heard.last("where")[0]["picture"], heard.last("where")[0]["trouble"]) == (1, "")
    log = opened_log(run.posterior.scans, "x.log")
    heard = Heard(log)
    heard.infer(log.document, "preview")
    assert "run Gibbs" in heard.answer(WhereAmI())[0]["trouble"]
    heard.infer(replace(log.document, sweeps=5), "run")
    assert heard.answer(WhereAmI())[0]["trouble"] == ""
