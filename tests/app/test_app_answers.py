"""Answers of the worker: paths, views, the pose of a scan, and the evidence of beams about a cell."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from acted import Heard, shown
from building_log import bent_room_run, room_run
from msgspec import structs

import bayesmap as bm
from bayesmap.app.answers.evidence import (
    MAX_LISTED_BEAMS,
    BeamRatios,
    one_beam_each,
    ratios_with_cell_emptied,
    strongest_beams,
    sum_evidence,
    wall_ratios,
)
from bayesmap.app.answers.whereabouts import Locator
from bayesmap.app.display import histogram
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import FindPath, FindViews, Inspect, ShowScan, WhereAmI
from bayesmap.app.protocol.document import Sensor, empty_walls, pack_walls
from bayesmap.app.protocol.notices import CellFacts
from bayesmap.app.sources import open_log, open_run
from bayesmap.kernels.rays import trace_rays
from bayesmap.kernels.walls.table import log_likelihoods, trace
from bayesmap.posterior.decisions import path_free_probability
from bayesmap.posterior.prediction import Predictor, fixed_maps

DOCUMENT = replace(tutorial_document(), sweeps=300)
PATH = FindPath((6.0, 15.0), (10.0, 14.0), 0.4, 0.05)


@pytest.mark.parametrize("mode", ["live", "run"])
def test_a_path_s_probability_is_that_of_the_draws(heard, mode):
    heard.infer(DOCUMENT, mode)
    header, _ = heard.answer(PATH)
    assert (header["type"], header["generation"]) == ("path", heard.generation)
    free = path_free_probability(heard.engine._result, header["path"], 0.4)
    assert header["probability"] == free.probability
    assert header["within_risk"] == (1 - free.probability <= 0.05)
    assert [header["path"][0], header["path"][-1]] == [[6.0, 15.0], [10.0, 14.0]]
    outside, _ = heard.answer(structs.replace(PATH, goal=(900.0, 3.0)))
    assert outside["type"] == "undecided"
    assert "outside" in outside["text"]
    if mode == "run":  # a saved run is decided by, too
        saved = shown(heard.engine._result.as_run())
        assert [saved.answer(question)[0]["type"] for question in (PATH, FindViews())] == ["path", "views"]


def test_a_path_needs_draws(heard):
    heard.infer(replace(DOCUMENT, method="propagate"), "preview")
    header, _ = heard.answer(PATH)
    assert header["type"] == "undecided"
    assert "draws" in header["text"]


def test_views_stand_where_it_is_free_and_tell_more_where_less_is_known(heard):
    _, field = heard.infer(DOCUMENT, "live")
    header, buffers = heard.answer(FindViews())
    assert (header["type"], header["spacing"]) == ("views", 1.0)
    pose, nats = buffers["pose"], buffers["nats"]
    assert pose.shape == (len(nats), 3)
    assert (field["p"].reshape(21, 21)[tuple(np.floor(pose[:, :2] + 0.5).astype(int).T)] < 0.31 * 255).all()
    assert (nats > 0).all()
    own = np.hypot(*(pose[:, :2] - [6.0, 15.0]).T).argmin()
    assert nats[own] < 0.7 * nats.max()  # looking again from the same place tells less
    walls = np.zeros((120, 80), dtype=bool)  # a large map has no more places than can be told apart
    grid = replace(DOCUMENT.grid, shape=(120, 80))
    heard.infer(replace(DOCUMENT, grid=grid, walls=pack_walls(walls), max_range=60.0, sweeps=5), "live")
    assert 0 < len(heard.answer(FindViews())[1]["nats"]) <= 400


def asked(document, sensor=1):
    heard = Heard()
    heard.infer(document, "preview")
    return heard.answer(WhereAmI(sensor))


def square(**changes):
    walls = np.zeros((21, 21), dtype=bool)
    walls[4:17, [4, 16]] = walls[[4, 16], 4:17] = True
    return replace(tutorial_document(), walls=pack_walls(walls), noise=0.05, **changes)


def test_the_robot_of_the_tutorial_knows_where_it_is():
    header, buffers = asked(tutorial_document())
    modes, pose = header["modes"], header["pose"]
    assert (len(modes), modes[0]["probability"]) == (1, pytest.approx(1.0))
    assert np.abs(np.array(modes[0]["mean"][:2]) - pose[:2]).max() < 4 * modes[0]["sigma_m"] < 0.3
    assert header["p_lost"] < 1e-3
    assert buffers["pose"].shape == (len(buffers["weight"]), 3)
    assert buffers["weight"].sum() == pytest.approx(1.0, abs=1e-4)
    assert (np.diff(buffers["weight"]) >= 0).all()
    assert np.array_equal(asked(tutorial_document())[1]["pose"], buffers["pose"])


def test_a_square_room_leaves_four_places_and_the_truth_is_one():
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
    header, _ = asked(replace(tutorial_document(), walls=empty_walls(tutorial_document().grid)))
    assert header["modes"][0]["sigma_m"] > 5.0
    assert header["p_lost"] < 0.1


def test_the_scan_on_show_is_located_in_the_map_of_a_run():
    run = bent_room_run()
    heard = shown(run, scan=3)
    for index in (3, 9):
        heard.ask(ShowScan(index))
        header, _ = heard.answer(WhereAmI())
        assert (header["index"], header["pose"]) == (index, run.posterior.scans.poses[index].tolist())
        best = header["modes"][0]
        assert best["probability"] > 0.9
        assert np.hypot(*(np.array(best["mean"][:2]) - header["pose"][:2])) < 0.15
        assert header["p_lost"] < 0.05


def test_a_scan_of_no_place_is_lost():
    """Its readings are as common as the map's own, but in an order that no place has."""
    run = bent_room_run()
    ranges_m = np.random.default_rng(3).permuted(run.posterior.scans.ranges_m, axis=1)
    result = open_run(run, "run.nc").result
    result = replace(result, scene=replace(result.scene, scans=replace(run.posterior.scans, ranges_m=ranges_m)))
    notice, _ = Locator().answer(WhereAmI(), result, 0, 1)
    assert notice.p_lost > 0.5


def test_a_question_waits_for_a_picture_or_is_answered_by_a_reason(heard):
    assert "no map" in heard.answer(WhereAmI())[0]["trouble"]
    heard.infer(tutorial_document(), "preview", steps=0)
    assert heard.ask(WhereAmI(1)) == []
    heard.finish()
    assert (heard.last("where")[0]["picture"], heard.last("where")[0]["trouble"]) == (1, "")
    log = open_log(bent_room_run().posterior.scans, "x.log")
    heard = Heard(log)
    heard.infer(log.document, "preview")
    assert "run Gibbs" in heard.answer(WhereAmI())[0]["trouble"]
    heard.infer(replace(log.document, sweeps=5), "run")
    assert heard.answer(WhereAmI())[0]["trouble"] == ""


SENSOR = bm.BeamMixture(bm.Gaussian(0.2), p_random=0.05, p_no_return=0.05)
DEPTH = 0.5


def test_evidence_for_a_wall_is_the_mean_over_all_maps_of_the_other_cells():
    grid = bm.Grid((4, 2), 1.0)
    scans = bm.Scans(np.array([[0.3, 0.9, 0.0]]), np.array([-0.2, 0.1, 0.3]), [[1.6, 2.9, 2.2]], max_range_m=6.0)
    table = trace(scans, grid, bm.Gaussian(0.4))
    p = np.random.default_rng(0).uniform(0.1, 0.9, grid.n_cells)
    cell, ratios = 2 * 2 + 1, []
    for b in range(3):
        entries = slice(*table.offsets[b : b + 2])
        cells, log_p = table.cells[entries], table.loglik[entries]
        if cell not in cells:
            continue
        mean = {True: 0.0, False: 0.0}
        for walls in itertools.product([False, True], repeat=len(cells)):
            weight = np.prod([p[c] if w else 1 - p[c] for c, w in zip(cells, walls, strict=True) if c != cell])
            first = next((i for i, w in enumerate(walls) if w), None)
            density = np.exp(table.no_hit[b] if first is None else log_p[first])
            mean[walls[list(cells).index(cell)]] += weight * density
        ratios.append(np.log(mean[True] / mean[False]))
    evidence = CellFacts(2, 1, False, **sum_evidence(wall_ratios(table, p, cell)))
    assert evidence.beams == len(ratios) > 0
    assert evidence.nats_for - evidence.nats_against == pytest.approx(sum(ratios), abs=1e-5)
    assert evidence.beams_for == sum(r > 0.005 for r in ratios)
    assert evidence.beams_against == sum(r < -0.005 for r in ratios)


def test_the_evidence_of_a_beam_has_no_cap():
    """A reading a thousand standard deviations before the only other wall: half a million nats."""
    scans = bm.Scans(np.array([[0.5, 0.5, 0.0]]), np.zeros(1), np.array([[5.0]]), max_range_m=20.0)
    table = trace(scans, bm.Grid((12, 1), 1.0), bm.Gaussian(0.001))
    p = np.zeros(12)
    p[8] = 1.0
    (nats,) = wall_ratios(table, p, 5).nats
    begin = int(np.flatnonzero(table.cells == 5)[0])
    other = int(np.flatnonzero(table.cells == 8)[0])
    assert nats == pytest.approx(float(table.loglik[begin]) - float(table.loglik[other]), rel=1e-6)
    assert nats > 1000


def test_the_histogram_reaches_to_the_lightest_particle():
    counts, lowest = histogram(np.concatenate([np.linspace(-178_000.0, -90_000.0, 19_999), [0.0], [-np.inf]]))
    assert (lowest, counts.sum()) == (-178_000.0, 20_000)
    assert (counts[0] > 0, counts[-1]) == (True, 1)


def test_beams_speak_for_a_wall_and_against_floor_and_each_is_told_on_request(heard):
    _, field = heard.infer(tutorial_document())
    wall = tuple(np.argwhere((field["reached"] >= 128) & (field["p"].reshape(21, 21) == 255))[0].tolist())
    (of_wall, _), (of_floor, nothing) = (heard.answer(Inspect(*cell)) for cell in (wall, (10, 12)))
    assert of_wall["nats_for"] > of_wall["nats_against"]
    assert of_floor["nats_against"] > of_floor["nats_for"] + 1
    assert of_floor["beams_for"] + of_floor["beams_against"] <= of_floor["beams"]
    assert nothing == {}
    header, each = heard.answer(Inspect(10, 12, each_beam=True))
    assert {**header, "each": False} == of_floor
    nats = each["nats"]
    assert nats[nats > 0].sum() == pytest.approx(header["nats_for"])
    assert -nats[nats < 0].sum() == pytest.approx(header["nats_against"])
    # All of them run through the cell, of 1 m about (10, 12).
    start, end = each["start"], each["end"]
    along = (end - start) / np.linalg.norm(end - start, axis=1)[:, None]
    away = np.array([10.0, 12.0]) - start
    assert (np.abs(along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]) < np.sqrt(0.5)).all()


def test_the_strongest_beams_come_first_with_their_ends():
    readings = np.array([[1.0, np.inf], [2.0, -np.inf], [np.nan, 3.0]])
    poses = np.array([[1.0, 1.0, 0.0], [2.0, 0.0, np.pi], [0.0, 5.0, 0.1]])
    scans = bm.Scans(poses, np.array([0.0, np.pi / 2]), readings, max_range_m=6.0, min_range_m=0.5)
    beams = strongest_beams(BeamRatios(np.array([0, 1, 2, 3]), np.array([0.5, -2.0, 0.004, 1.0]), 8, 2), scans)
    assert [beams[name].tolist() for name in ("nats", "scan", "beam")] == [[-2.0, 1.0, 0.5], [0, 1, 0], [1, 1, 0]]
    np.testing.assert_allclose(beams["start"], [[1, 1], [2, 0], [1, 1]])
    np.testing.assert_allclose(beams["end"], [[1, 7], [2, -0.5], [2, 1]], atol=1e-12)  # no return, too close, a hit
    many = BeamRatios(np.zeros(500, dtype=np.intp), np.linspace(0.01, 5, 500), 500, 1)
    assert strongest_beams(many, scans)["nats"].tolist() == many.nats[: -MAX_LISTED_BEAMS - 1 : -1].tolist()


def density(rays, beam, stop):
    """The density of a beam's reading under one map of stop probabilities, (N,), cell by cell."""
    entries = slice(*rays.offsets[beam : beam + 2])
    distance = np.append(rays.stop_distance_m(DEPTH)[entries], np.inf)
    chance = np.append(stop[rays.cells[entries]], 1.0)
    arrives = np.cumprod(np.append(1.0, 1.0 - chance[:-1]))
    reading = np.full(len(distance), rays.range_m[beam])
    return float((arrives * chance * np.exp(SENSOR.log_likelihood(reading, distance, rays.limits))).sum())


def test_evidence_for_other_cells_is_the_log_ratio_of_densities_averaged_over_draws():
    grid = bm.Grid((5, 3), 1.0)
    draws = np.random.default_rng(3).uniform(0.0, 0.8, (4, grid.n_cells))
    poses, angles = np.array([[0.3, 1.4, 0.0], [0.2, 0.4, 0.3]]), np.array([-0.3, 0.0, 0.1, 0.6])
    scans = bm.Scans(poses, angles, np.array([[2.4, 2.6, np.inf, np.nan], [2.2, 3.1, 0.9, 1.7]]), max_range_m=6.0)
    cell, beams, rays = 2 * 3 + 1, np.arange(scans.n_beams), trace_rays(scans, grid)
    emptied = draws.copy()
    emptied[:, cell] = 0.0
    expected = []
    for beam in beams:
        means = [np.mean([density(rays, beam, stop) for stop in maps]) for maps in (draws, emptied)]
        expected.append(0.0 if np.isnan(rays.range_m[beam]) else np.log(means[0] / means[1]))
    predictor = Predictor(grid, fixed_maps(draws), SENSOR, DEPTH, len(draws))
    ratios = ratios_with_cell_emptied(predictor, one_beam_each(scans, beams), cell)
    assert ratios == pytest.approx(expected, abs=1e-4)
    assert ratios.max() > 0.01
    assert ratios.min() < -0.01


@pytest.mark.parametrize("prior", [bm.Surface(), bm.Beta()], ids=["surfaces", "reflectivities"])
def test_beams_speak_for_the_wall_of_a_room_and_neither_for_nor_against_its_floor(prior):
    run = room_run(prior)
    heard = shown(run)
    # A single cell of the wall may be one that its neighbour's long surface would do without.
    wall_cells = [heard.answer(Inspect(20, y))[0] for y in range(2, 18)]
    assert sum(cell["nats_for"] - cell["nats_against"] for cell in wall_cells) > 30
    assert max(cell["nats_for"] for cell in wall_cells) > 5
    floor = heard.answer(Inspect(10, 14))[0]
    assert floor["beams"] > 20
    assert abs(floor["nats_for"] - floor["nats_against"]) < 5
    untouched = np.setdiff1d(np.arange(run.grid.n_cells), heard.engine._scene.problem.table.cells)[0]
    unseen, _ = heard.answer(Inspect(*map(int, np.unravel_index(untouched, run.grid.shape))))
    assert (unseen["beams"], unseen["nats_for"], unseen["nats_against"]) == (0, 0.0, 0.0)


def test_prior_and_beams_given_one_draw_are_the_log_odds_by_which_gibbs_draws_the_cell(heard):
    heard.infer(replace(tutorial_document(), prior=0.3, noise=0.6, angles=30, sweeps=40))
    stream = heard.engine._result.estimate
    for (x, y), chain, draw in (((12, 6), 0, 5), ((8, 10), 1, 39), ((11, 10), 0, 0)):
        facts, buffers = heard.answer(Inspect(x, y, each_beam=True, chain=chain, draw=draw))
        maps = np.repeat(stream.draw(chain, draw)[0][None].astype(bool), 2, axis=0)
        maps[:, x, y] = [False, True]
        likelihood = log_likelihoods(stream.problem.table, np.packbits(maps.reshape(2, -1), axis=1))
        assert facts["log_odds"] == pytest.approx(np.log(0.3 / 0.7) + likelihood[1] - likelihood[0], abs=1e-3)
        assert facts["prior_nats"] == pytest.approx(np.log(0.3 / 0.7))
        assert facts["log_odds"] == pytest.approx(
            facts["prior_nats"] + facts["nats_for"] - facts["nats_against"], abs=0.005 * facts["beams"]
        )
        assert np.array_equal(buffers["trace"], [[stream.draw(c, d)[0][x, y] for d in range(40)] for c in range(2)])
    facts, _ = heard.answer(Inspect(12, 6, each_beam=True))
    assert (facts["draw"], facts["log_odds"]) == (None, None)  # given the means, it is not
