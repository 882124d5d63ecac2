"""A log on cells of any size, from the first of its scans: the session, the worker, and the coarse map of a drag."""

from dataclasses import replace

import numpy as np
import pytest
from acted import Acted, Heard
from building_log import ANGLES, room_scans

import bayesmap as bm
from bayesmap.app.edits import new_document, tutorial_document
from bayesmap.app.protocol.actions import MoveVirtualScan, ShowScan
from bayesmap.app.protocol.document import Source
from bayesmap.app.protocol.notices import Overlay, View
from bayesmap.app.protocol.wire import parse_document
from bayesmap.app.scene import hit_mask
from bayesmap.app.shown.hit_maps import HitCounts, stop_probabilities
from bayesmap.app.sources import OpenedLog, first_beams, open_log
from bayesmap.cells.arrays import Draws
from bayesmap.samplers.fit import initial_sensor, pilot_sweeps
from bayesmap.samplers.sampler import Keep
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.space.grid import Grid


@pytest.fixture(scope="module")
def log():
    return open_log(room_scans(), "room.log")


@pytest.fixture
def acted(log):
    found = Acted(log.document)
    found.picture()
    return found


def test_a_new_map_where_a_log_was_opened_has_its_own_readings(log):
    """The readings are not those of the log on the new map's cells."""
    new = replace(new_document("tutorial", (21, 21), log.document), sweeps=5)
    here = Heard(log)
    here.infer(replace(log.document, sweeps=2))
    (_, found), (_, expected) = here.infer(new), Heard().infer(new)
    assert here.last("scan")[1]["ranges"].shape == (1, len(ANGLES))
    assert all(np.array_equal(found[name], expected[name]) for name in ("p", "reached"))
    assert here.infer(replace(log.document, sweeps=2))[1]["p"].shape == log.document.grid.shape  # and back


# The session


def test_another_size_of_cells_covers_the_same_place_and_can_be_undone(acted, log):
    acted.act("set", patch={"resolution": 0.2})
    assert acted.session.document.grid == Grid.covering(log.scans, 0.2)
    assert acted.inferred[-1].document.grid.resolution == 0.2
    acted.picture()
    acted.act("set", patch={"resolution": 0.1})
    assert acted.session.document == log.document  # it does not depend on the way there
    acted.picture()
    acted.act("undo")
    assert acted.session.document.grid.resolution == 0.2


def test_a_page_that_comes_after_the_log_was_left_is_sent_no_trajectory(acted):
    def sent():
        acted.session.join(2)
        return {header["type"] for header in acted.act("hello", client=2)}

    acted.hear(Overlay(generation=0))
    assert "overlay" in sent()
    acted.act("new", shape=[21, 21], world="tutorial")
    acted.picture()
    assert "overlay" not in sent()


def test_cells_that_are_too_small_are_refused_with_the_least_size(log):
    acted = Acted(replace(log.document, source=replace(log.document.source, bounds=((0.0, 0.0), (200.0, 10.0)))))
    acted.act("set", patch={"resolution": 0.1})
    assert "more than 1000 a side" in acted.text
    assert "give at least 0.200 m" in acted.text
    assert acted.session.document.grid.resolution == 0.1


@pytest.mark.parametrize(("kind", "patch", "words"), [
    *[(kind, patch, "only") for kind in ("simulation", "run") for patch in ({"resolution": 0.2}, {"scans_used": 3})],
    ("simulation", {"poses": "odometry"}, "there is no log"),
    ("log", {"pose_sigma": 0.5}, "pose_sigma cannot be changed"),
])  # fmt: skip
def test_settings_of_another_kind_of_source_are_refused(kind, patch, words, log):
    run = replace(log.document, source=Source("run", "run.nc", 12))
    acted = Acted({"simulation": None, "log": log.document, "run": run}[kind])
    before = acted.session.document
    acted.act("set", patch=patch)
    assert words in acted.text
    assert acted.session.document is before


def test_a_drag_along_the_log_is_coarse_and_one_step_and_letting_go_samples(acted, log):
    for n in (9, 6, 4):
        acted.act("set", patch={"scans_used": n}, drag=5, coarse=True)
        acted.picture()
    assert [task.mode for task in acted.inferred[-3:]] == ["coarse"] * 3
    assert acted.inferred[-1].scan == 3  # the last of those used is shown
    acted.act("set", patch={"scans_used": 4}, drag=5)
    assert acted.inferred[-1].mode == "live"  # though the document is the same
    assert acted.inferred[-1].document.scans_used == 4
    acted.picture()
    asked = len(acted.inferred)
    acted.act("set", patch={"scans_used": 4}, drag=5)
    assert len(acted.inferred) == asked  # once
    acted.act("undo")
    assert acted.session.document == log.document
    acted.picture()
    acted.act("redo")
    assert acted.session.document.scans_used == 4
    acted.act("set", patch={"scans_used": 12})  # all scans is no setting
    assert acted.session.document == log.document


def test_moves_that_wait_are_merged_and_the_last_one_decides(acted):
    acted.act("set", patch={"scans_used": 9}, drag=5, coarse=True)
    acted.act("set", patch={"scans_used": 7}, drag=5, coarse=True)  # waits for the first picture
    acted.act("set", patch={"scans_used": 5}, drag=5)
    acted.picture()
    assert [(t.mode, t.document.scans_used) for t in acted.inferred[-2:]] == [("coarse", 9), ("live", 5)]


def test_a_link_to_the_same_log_takes_both_along(acted, log):
    linked = replace(log.document, scans_used=5, grid=Grid.covering(log.scans, 0.2)).to_json()
    assert parse_document(linked).scans_used == 5
    acted.act("hello", document={**linked, "walls": ""})
    assert acted.session.document.scans_used == 5
    assert acted.session.document.grid == Grid.covering(log.scans, 0.2)
    acted.act("hello", document={**linked, "grid": {**linked["grid"], "origin": [0.0, 0.0]}, "walls": ""})
    assert "this server shows" in acted.text


# The worker


def test_the_posterior_of_the_first_scans_is_that_of_a_log_of_them(log):
    document = replace(log.document, scans_used=5, sweeps=15, grid=Grid.covering(log.scans, 0.2))
    heard = Heard(log)
    field = heard.infer(document)
    alone = OpenedLog(log.document, log.scans.select(slice(5)))  # on the cells of the whole log
    np.testing.assert_array_equal(field[1]["p"], Heard(alone).infer(replace(document, scans_used=None))[1]["p"])
    assert (heard.infer(replace(document, scans_used=None))[1]["p"] != field[1]["p"]).any()
    surfaces = replace(document, cells="surface", sweeps=3)
    found, lone = heard.infer(surfaces), Heard(alone).infer(replace(surfaces, scans_used=None))
    np.testing.assert_array_equal(found[1]["p"], lone[1]["p"])
    heard.ask(ShowScan(11))  # a scan that is not used can still be looked at
    assert heard.last("scan")[0]["index"] == 11


def test_first_beams_are_those_of_the_first_scans(log):
    whole, few = log.scene(log.document).problem.table, log.scene(replace(log.document, scans_used=3)).problem.table
    walls = np.random.default_rng(0).random(few.grid.shape) < 0.1
    assert few.n_beams == 3 * len(ANGLES)
    np.testing.assert_array_equal(few.beam_log_likelihoods(walls), whole.beam_log_likelihoods(walls)[: few.n_beams])
    assert first_beams(whole, 0).n_incidences == 0


def plain_counts(scans, grid):
    """Hits and passes of each cell by walking along every beam in steps of a millimetre."""
    found = np.zeros((2, grid.n_cells), dtype=int)
    for pose, ranges in zip(scans.poses, scans.ranges_m, strict=True):
        for angle, reading in zip(scans.angles_rad + pose[2], ranges, strict=True):
            if not np.isfinite(reading):
                continue  # what came back from nothing is not counted
            t = np.append(np.arange(0, reading, 1e-3), reading)
            at = np.floor(grid.to_cells(pose[:2] + t[:, None] * [np.cos(angle), np.sin(angle)])).astype(int)
            inside = ((at >= 0) & (at < grid.shape)).all(axis=1)
            cells = at[inside, 0] * grid.shape[1] + at[inside, 1]
            assert inside[-1]
            found[0, cells[-1]] += 1
            found[1, np.setdiff1d(cells, cells[-1:])] += 1
    return found


def test_counts_are_those_of_a_plain_walk_whatever_the_way_to_them(log):
    grid = Grid.covering(log.scans, 0.2)
    scene = log.scene(replace(log.document, grid=grid))
    counts = HitCounts(scene.scans, scene.problem.table)
    for n in (3, 12, 1, 7):  # on and back
        found, expected = counts.count_first(n), plain_counts(log.scans.select(slice(n)), grid)
        np.testing.assert_array_equal(found[0], expected[0])
        # a beam through a corner, or by less than a step through a cell, is all that may differ
        assert np.abs(found[1] - expected[1]).sum() <= 0.05 * expected[1].sum()
    np.testing.assert_array_equal(counts.count_first(None), counts.count_first(12))
    assert counts.count_first(1)[0].sum() == hit_mask(scene)[0].sum()


@pytest.mark.parametrize("cells", ["binary", "reflectivity", "surface"])
def test_the_coarse_picture_is_made_of_counts_at_once(log, cells):
    document = replace(log.document, cells=cells, scans_used=6)
    heard = Heard(log)
    header, buffers = heard.infer(document, "coarse")
    assert (header["method"], header["approximate"], header["sweeps"]) == ("hits", True, 0)
    assert len(heard.all("field")) == 1
    assert header["quantity"]["kind"] == cells
    scene = log.scene(replace(document, scans_used=None))
    counts = HitCounts(scene.scans, scene.problem.table).count_first(6)
    prior = {"binary": bm.Independent(0.2), "reflectivity": bm.Beta(), "surface": bm.Surface()}[cells]
    np.testing.assert_array_equal(buffers["p"].ravel(), np.rint(255 * stop_probabilities(counts, prior, 0.2)))
    observed = buffers["reached"].ravel() > 0
    np.testing.assert_array_equal(observed, counts.any(axis=0))
    p = buffers["p"].ravel() / 255
    often = counts[0] > 4
    assert p[often].mean() > p[observed & ~often].mean() + 0.3
    heard.ask(View("draw"))
    assert heard.last("field")[0]["layer"] == "mean"  # there are no draws
    # surfaces that are on show are of other scans, and go
    assert [buffers["strokes"].size for _, buffers in heard.every("overlay")] == [0] * (cells == "surface")


def surfaces_of(log):
    return replace(log.document, cells="surface", sweeps=3, grid=Grid.covering(log.scans, 0.2))


def test_surfaces_of_a_log_are_counted_first_then_shown_by_the_draws_of_the_chain_that_fits_the_sensor_once(log):
    surfaces = Heard(log)
    surfaces.engine._display.fields_are_due = lambda: True
    _, first = surfaces.infer(surfaces_of(log), "run")
    fields = surfaces.every("field")
    methods = [header["method"] for header, _ in fields]
    assert methods == ["hits"] + ["pilot"] * 40 + ["gibbs"] * (len(methods) - 41)
    pilots = fields[1:41]
    assert [f["sweeps"] for f, _ in pilots] == list(range(1, 41))
    assert [f["averaged"] for f, _ in pilots] == [(k + 1) // 2 for k in range(1, 41)]
    assert all(f["approximate"] and f["total"] == 40 for f, _ in pilots)
    # the same chain, by the library
    prior, document = bm.Surface(), surfaces_of(log)
    model = replace(log.scene(document).model(prior), sensor=initial_sensor(prior, 0.2), hit_depth=prior.hit_depth)
    problem = StopGibbs().prepare(model, "cpu")
    maps = []
    for found, info in pilot_sweeps(problem, document.seed, 7, keep=Keep(every=1)):
        maps.append(found.prior.mean_map(Draws(model.grid, prior.arrays, info.draws, problem.coordinates)))
    touched = problem.touched_map()
    for k in (1, 2, 7):
        mean = np.mean(maps[k // 2 : k], axis=0)[touched]
        np.testing.assert_allclose(pilots[k - 1][1]["p"][touched], 255 * mean, atol=0.6)
    # the same readings are fitted once
    surfaces.reports.clear()
    _, again = surfaces.infer(surfaces_of(log), "live")
    assert [f["method"] for f in surfaces.all("field") if f["method"] != "gibbs"] == ["hits"]
    np.testing.assert_array_equal(again["p"], first["p"])
    surfaces.reports.clear()
    surfaces.infer(replace(surfaces_of(log), seed=1), steps=4)
    assert "pilot" in [f["method"] for f in surfaces.all("field")]


def test_draws_intervals_and_surfaces_are_shown_while_the_sensor_is_fitted(log, monkeypatch):
    monkeypatch.setattr("bayesmap.app.display.MIN_OVERLAY_SECONDS", 0.0)
    heard = Heard(log)
    heard.engine._display.fields_are_due = lambda: True
    heard.infer(surfaces_of(log), "run", steps=9)
    assert heard.last("field")[0]["method"] == "pilot"
    heard.ask(View("draw"))
    header, drawn = heard.last("field")
    assert (header["layer"], header["chain"]) == ("draw", 0)
    heard.ask(View("width"))
    header, width = heard.last("field")
    assert header["layer"] == "width"
    assert width["p"].max() > 20
    assert not np.array_equal(drawn["p"], width["p"])
    header, buffers = heard.last("overlay")
    assert len(buffers["strokes"]) > 10
    (ghost,) = heard.ask(MoveVirtualScan(1.5, 2.5, 0.3))
    assert (ghost.header["type"], ghost.header["draws"]) == ("ghost", heard.all("field")[-1]["averaged"])


def test_a_cleared_inference_shows_the_prior_of_the_chosen_cells(log):
    drawn = replace(tutorial_document(), prior=0.2)
    surfaces = replace(log.document, cells="surface", grid=Grid.covering(log.scans, 0.2))
    for heard, document, mean in ((Heard(), drawn, 0.2), (Heard(log), surfaces, bm.Surface().mean)):
        header, buffers = heard.infer(document, "clear")
        assert (header["quantity"]["kind"], header["method"]) == (document.cells, "none")
        np.testing.assert_allclose(buffers["p"] / 255, mean, atol=0.5 / 255 + 1e-9)
        assert not buffers["reached"].any()
