"""The evidence of beams for a wall is the change of their log-likelihood, by enumeration."""

import itertools

import numpy as np
import pytest
from acted_engine import Heard

import bayesmap as bm
from bayesmap.app.evidence import evidence
from bayesmap.app.tasks import Inspect
from bayesmap.app.worlds import tutorial_document
from bayesmap.kernels.trace import trace


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
    found = evidence(table, p, cell)
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
    of_wall, of_floor = (heard.ask(Inspect(3, *cell))[0].header for cell in (wall, floor))
    assert of_wall["nats_for"] > of_wall["nats_against"]
    assert of_floor["nats_against"] > of_floor["nats_for"] + 1
    assert of_floor["beams_for"] + of_floor["beams_against"] <= of_floor["beams"]
