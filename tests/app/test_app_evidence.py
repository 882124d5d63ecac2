"""The evidence of beams about a cell is the change of their log-likelihood, by enumeration and by a plain sum."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from acted_engine import Heard, shown
from building_log import room_run

import bayesmap as bm
from bayesmap.app.answers.evidence import (
    MOST_DRAWN,
    BeamRatios,
    log_ratios,
    one_beam_each,
    strongest,
    summed,
    wall_ratios,
)
from bayesmap.app.display import histogram
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import Inspect
from bayesmap.kernels.rays import trace_rays
from bayesmap.kernels.walls.table import log_likelihoods, trace
from bayesmap.posterior.prediction import Predictor, fixed_maps

SENSOR = bm.BeamMixture(bm.Gaussian(0.2), p_random=0.05, p_no_return=0.05)
DEPTH = 0.5


def test_for_a_wall_it_is_the_mean_over_all_maps_of_the_other_cells():
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
    found = summed(wall_ratios(table, p, cell))
    assert found.beams == len(ratios) > 0
    assert found.nats_for - found.nats_against == pytest.approx(sum(ratios), abs=1e-5)
    assert found.beams_for == sum(r > 0.005 for r in ratios)
    assert found.beams_against == sum(r < -0.005 for r in ratios)


def test_the_evidence_of_a_beam_has_no_cap():
    """A reading a thousand standard deviations before the only other wall: half a million nats."""
    grid = bm.Grid((12, 1), 1.0)
    scans = bm.Scans(np.array([[0.5, 0.5, 0.0]]), np.zeros(1), np.array([[5.0]]), max_range_m=20.0)
    table = trace(scans, grid, bm.Gaussian(0.001))
    p = np.zeros(12)
    p[8] = 1.0
    (nats,) = wall_ratios(table, p, 5).nats
    begin = int(np.flatnonzero(table.cells == 5)[0])
    other = int(np.flatnonzero(table.cells == 8)[0])
    assert nats == pytest.approx(float(table.loglik[begin]) - float(table.loglik[other]), rel=1e-6)
    assert nats > 1000


def test_the_histogram_reaches_to_the_lightest_particle():
    log_weights = np.concatenate([np.linspace(-178_000.0, -90_000.0, 19_999), [0.0], [-np.inf]])
    counts, lowest = histogram(log_weights)
    assert lowest == -178_000.0
    assert counts.sum() == 20_000
    assert (counts[0] > 0, counts[-1]) == (True, 1)


def test_a_wall_is_spoken_for_and_floor_against_and_each_beam_is_told_where_it_is_asked_for():
    heard = Heard()
    _, field = heard.infer(tutorial_document())
    seen = field["reached"] >= 128
    wall = tuple(np.argwhere(seen & (field["p"].reshape(21, 21) == 255))[0].tolist())
    (of_wall, _), (of_floor, nothing) = (heard.answer(Inspect(*cell)) for cell in (wall, (10, 12)))
    assert of_wall["nats_for"] > of_wall["nats_against"]
    assert of_floor["nats_against"] > of_floor["nats_for"] + 1
    assert of_floor["beams_for"] + of_floor["beams_against"] <= of_floor["beams"]
    assert nothing == {}
    header, each = heard.answer(Inspect(10, 12, each=True))
    assert {**header, "each": False} == of_floor
    nats = each["nats"]
    assert nats[nats > 0].sum() == pytest.approx(header["nats_for"])
    assert -nats[nats < 0].sum() == pytest.approx(header["nats_against"])
    # All of them run through the cell, of 1 m about (10, 12).
    start, end = each["start"], each["end"]
    along = (end - start) / np.linalg.norm(end - start, axis=1)[:, None]
    away = np.array([10.0, 12.0]) - start
    assert (np.abs(along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]) < np.sqrt(0.5)).all()


def test_the_beams_that_say_most_come_first_with_where_they_run():
    readings = np.array([[1.0, np.inf], [2.0, -np.inf], [np.nan, 3.0]])
    poses = np.array([[1.0, 1.0, 0.0], [2.0, 0.0, np.pi], [0.0, 5.0, 0.1]])
    scans = bm.Scans(poses, np.array([0.0, np.pi / 2]), readings, max_range_m=6.0, min_range_m=0.5)
    found = strongest(BeamRatios(np.array([0, 1, 2, 3]), np.array([0.5, -2.0, 0.004, 1.0]), 8, 2), scans)
    assert [found[name].tolist() for name in ("nats", "scan", "beam")] == [[-2.0, 1.0, 0.5], [0, 1, 0], [1, 1, 0]]
    np.testing.assert_allclose(found["start"], [[1, 1], [2, 0], [1, 1]])
    np.testing.assert_allclose(found["end"], [[1, 7], [2, -0.5], [2, 1]], atol=1e-12)  # no return, too close, a hit
    many = BeamRatios(np.zeros(500, dtype=np.intp), np.linspace(0.01, 5, 500), 500, 1)
    assert strongest(many, scans)["nats"].tolist() == many.nats[: -MOST_DRAWN - 1 : -1].tolist()


def density(rays, beam, stop):
    """The density of a beam's reading under one map of stop probabilities, (N,), cell by cell."""
    entries = slice(*rays.offsets[beam : beam + 2])
    distance = np.append(rays.distance_m(DEPTH)[entries], np.inf)
    chance = np.append(stop[rays.cells[entries]], 1.0)
    arrives = np.cumprod(np.append(1.0, 1.0 - chance[:-1]))
    reading = np.full(len(distance), rays.range_m[beam])
    return float((arrives * chance * np.exp(SENSOR.log_likelihood(reading, distance, rays.limits))).sum())


def test_for_other_cells_it_is_the_log_ratio_of_densities_averaged_over_draws():
    grid = bm.Grid((5, 3), 1.0)
    draws = np.random.default_rng(3).uniform(0.0, 0.8, (4, grid.n_cells))
    readings = np.array([[2.4, 2.6, np.inf, np.nan], [2.2, 3.1, 0.9, 1.7]])
    poses, angles = np.array([[0.3, 1.4, 0.0], [0.2, 0.4, 0.3]]), np.array([-0.3, 0.0, 0.1, 0.6])
    scans = bm.Scans(poses, angles, readings, max_range_m=6.0)
    cell, beams, rays = 2 * 3 + 1, np.arange(scans.n_beams), trace_rays(scans, grid)
    emptied = draws.copy()
    emptied[:, cell] = 0.0
    expected = []
    for beam in beams:
        means = [np.mean([density(rays, beam, stop) for stop in maps]) for maps in (draws, emptied)]
        expected.append(0.0 if np.isnan(rays.range_m[beam]) else np.log(means[0] / means[1]))
    predictor = Predictor(grid, fixed_maps(draws), SENSOR, DEPTH, len(draws))
    found = log_ratios(predictor, one_beam_each(scans, beams), cell)
    assert found == pytest.approx(expected, abs=1e-4)
    assert found.max() > 0.01
    assert found.min() < -0.01


@pytest.mark.parametrize("prior", [bm.Surface(), bm.Beta()], ids=["surfaces", "reflectivities"])
def test_the_wall_of_a_room_is_spoken_for_and_its_floor_by_nobody(prior):
    run = room_run(prior)
    heard = shown(run)
    # A single cell of the wall may be one that its neighbour's long surface would do without.
    of_wall = [heard.answer(Inspect(20, y))[0] for y in range(2, 18)]
    of_floor = heard.answer(Inspect(10, 14))[0]
    assert sum(cell["nats_for"] - cell["nats_against"] for cell in of_wall) > 30
    assert max(cell["nats_for"] for cell in of_wall) > 5
    assert all(cell["beams_for"] + cell["beams_against"] <= cell["beams"] for cell in of_wall)
    assert of_floor["beams"] > 20
    assert abs(of_floor["nats_for"] - of_floor["nats_against"]) < 5
    touched = np.zeros(run.grid.n_cells, dtype=bool)
    touched[heard.engine._scene.problem.table.cells] = True
    found, _ = heard.answer(Inspect(*np.argwhere(~touched.reshape(run.grid.shape))[0].tolist()))
    assert (found["beams"], found["nats_for"], found["nats_against"]) == (0, 0.0, 0.0)


def test_given_one_draw_prior_and_beams_are_the_log_odds_by_which_gibbs_draws_the_cell():
    document = replace(tutorial_document(), prior=0.3, noise=0.6, angles=30, sweeps=40)
    heard = Heard()
    heard.infer(document)
    stream = heard.engine._result.found
    for (x, y), chain, draw in (((12, 6), 0, 5), ((8, 10), 1, 39), ((11, 10), 0, 0)):
        facts, buffers = heard.answer(Inspect(x, y, each=True, chain=chain, draw=draw))
        maps = np.repeat(stream.draw(chain, draw)[0][None].astype(bool), 2, axis=0)
        maps[:, x, y] = [False, True]
        likelihood = log_likelihoods(stream.problem.table, np.packbits(maps.reshape(2, -1), axis=1))
        odds = np.log(0.3 / 0.7) + likelihood[1] - likelihood[0]
        assert facts["log_odds"] == pytest.approx(odds, abs=1e-3)
        assert facts["prior_nats"] == pytest.approx(np.log(0.3 / 0.7))
        assert facts["log_odds"] == pytest.approx(
            facts["prior_nats"] + facts["nats_for"] - facts["nats_against"], abs=0.005 * facts["beams"]
        )
        states = [[stream.draw(c, d)[0][x, y] for d in range(40)] for c in range(2)]
        assert np.array_equal(buffers["trace"], states)
    facts, _ = heard.answer(Inspect(12, 6, each=True))
    assert (facts["draw"], facts["log_odds"]) == (None, None)  # given the means, it is not
