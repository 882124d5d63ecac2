"""The evidence of beams for a wall is the change of their log-likelihood, by enumeration."""

import itertools

import numpy as np
import pytest
from acted_engine import Heard

import bayesmap as bm
from bayesmap.app.answers.evidence import MOST_DRAWN, BeamRatios, strongest, summed, wall_ratios
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import Inspect
from bayesmap.kernels.walls.table import trace


def test_it_is_the_mean_over_all_maps_of_the_other_cells():
    grid = bm.Grid((4, 2), 1.0)
    angles = np.array([-0.2, 0.1, 0.3])
    readings = np.array([[1.6, 2.9, 2.2]])
    scans = bm.Scans(np.array([[0.3, 0.9, 0.0]]), angles, readings, max_range_m=6.0)
    table = trace(scans, grid, bm.Gaussian(0.4))
    p = np.random.default_rng(0).uniform(0.1, 0.9, grid.n_cells)
    cell = 2 * 2 + 1
    through = [b for b in range(3) if cell in table.cells[table.offsets[b] : table.offsets[b + 1]]]
    ratios = []
    for b in through:
        cells = table.cells[table.offsets[b] : table.offsets[b + 1]]
        log_p = table.loglik[table.offsets[b] : table.offsets[b + 1]]
        mean = {True: 0.0, False: 0.0}
        for walls in itertools.product([False, True], repeat=len(cells)):
            weight = np.prod([p[c] if w else 1 - p[c] for c, w in zip(cells, walls, strict=True) if c != cell])
            first = next((i for i, w in enumerate(walls) if w), None)
            density = np.exp(table.no_hit[b] if first is None else log_p[first])
            mean[walls[list(cells).index(cell)]] += weight * density
        ratios.append(np.log(mean[True] / mean[False]))
    found = summed(wall_ratios(table, p, cell))
    assert found.beams == len(through) > 0
    assert found.nats_for - found.nats_against == pytest.approx(sum(ratios), abs=1e-5)
    assert found.beams_for == sum(r > 0.005 for r in ratios)
    assert found.beams_against == sum(r < -0.005 for r in ratios)


def test_a_wall_is_spoken_for_and_floor_against():
    heard = Heard()
    _, field = heard.infer(tutorial_document())
    p = field["p"].reshape(21, 21)
    seen = np.unpackbits(field["observed"], count=441).reshape(21, 21).astype(bool)
    wall = tuple(np.argwhere(seen & (p == 255))[0].tolist())
    floor = 10, 12
    of_wall, of_floor = (heard.ask(Inspect(*cell))[0].header for cell in (wall, floor))
    assert of_wall["nats_for"] > of_wall["nats_against"]
    assert of_floor["nats_against"] > of_floor["nats_for"] + 1
    assert of_floor["beams_for"] + of_floor["beams_against"] <= of_floor["beams"]


def test_the_beams_that_say_most_come_first_with_where_they_run():
    angles = np.array([0.0, np.pi / 2])
    readings = np.array([[1.0, np.inf], [2.0, -np.inf], [np.nan, 3.0]])
    poses = np.array([[1.0, 1.0, 0.0], [2.0, 0.0, np.pi], [0.0, 5.0, 0.1]])
    scans = bm.Scans(poses, angles, readings, max_range_m=6.0, min_range_m=0.5)
    said = BeamRatios(np.array([0, 1, 2, 3]), np.array([0.5, -2.0, 0.004, 1.0]), 8, 2)
    found = strongest(said, scans)
    assert found["nats"].tolist() == [-2.0, 1.0, 0.5]
    assert found["scan"].tolist() == [0, 1, 0]
    assert found["beam"].tolist() == [1, 1, 0]
    np.testing.assert_allclose(found["start"], [[1, 1], [2, 0], [1, 1]])
    np.testing.assert_allclose(found["end"], [[1, 7], [2, -0.5], [2, 1]], atol=1e-12)  # no return, too close, a hit
    many = BeamRatios(np.zeros(500, dtype=np.intp), np.linspace(0.01, 5, 500), 500, 1)
    assert strongest(many, scans)["nats"].tolist() == many.nats[: -MOST_DRAWN - 1 : -1].tolist()


def test_each_beam_is_told_where_it_is_asked_for():
    heard = Heard()
    heard.infer(tutorial_document())
    (together,) = heard.ask(Inspect(10, 12))
    assert together.buffers == {}
    (each,) = heard.ask(Inspect(10, 12, each=True))
    assert {**each.header, "each": False} == together.header
    nats = each.buffers["nats"]
    assert nats[nats > 0].sum() == pytest.approx(each.header["nats_for"])
    assert -nats[nats < 0].sum() == pytest.approx(each.header["nats_against"])
    # All of them run through the cell, of 1 m about (10, 12).
    start, end = each.buffers["start"], each.buffers["end"]
    along = (end - start) / np.linalg.norm(end - start, axis=1)[:, None]
    away = np.array([10.0, 12.0]) - start
    assert (np.abs(along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]) < np.sqrt(0.5)).all()
