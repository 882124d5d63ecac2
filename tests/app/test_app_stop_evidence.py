"""The evidence of beams for what stands in a cell is how much likelier it makes their readings, by a plain sum."""

import numpy as np
import pytest
from acted_engine import Heard
from building_log import room_run

import bayesmap as bm
from bayesmap.app.answers.evidence import log_ratios, one_beam_each
from bayesmap.app.protocol.actions import Inspect
from bayesmap.app.sources import opened_run
from bayesmap.kernels.rays import trace_rays
from bayesmap.posterior.predictor import Predictor, fixed_maps

SENSOR = bm.BeamMixture(bm.Gaussian(0.2), p_random=0.05, p_no_return=0.05)
DEPTH = 0.5


def density(rays, beam, stop):
    """Of a beam's reading under one map of stop probabilities, (N,), cell by cell."""
    entries = slice(rays.offsets[beam], rays.offsets[beam + 1])
    distance = np.append(rays.distance_m(DEPTH)[entries], np.inf)
    chance = np.append(stop[rays.cells[entries]], 1.0)
    arrives = np.cumprod(np.append(1.0, 1.0 - chance[:-1]))
    reading = np.full(len(distance), rays.range_m[beam])
    return float((arrives * chance * np.exp(SENSOR.log_likelihood(reading, distance, rays.limits))).sum())


def test_it_is_the_log_ratio_of_densities_averaged_over_draws():
    grid = bm.Grid((5, 3), 1.0)
    rng = np.random.default_rng(3)
    draws = rng.uniform(0.0, 0.8, (4, grid.n_cells))
    angles = np.array([-0.3, 0.0, 0.1, 0.6])
    readings = np.array([[2.4, 2.6, np.inf, np.nan], [2.2, 3.1, 0.9, 1.7]])
    scans = bm.Scans(np.array([[0.3, 1.4, 0.0], [0.2, 0.4, 0.3]]), angles, readings, max_range_m=6.0)
    cell = 2 * 3 + 1
    beams = np.arange(scans.n_beams)
    rays = trace_rays(scans, grid)
    emptied = draws.copy()
    emptied[:, cell] = 0.0
    expected = []
    for beam in beams:
        means = [np.mean([density(rays, beam, stop) for stop in maps]) for maps in (draws, emptied)]
        read = not np.isnan(rays.range_m[beam])
        expected.append(np.log(means[0] / means[1]) if read else 0.0)
    predictor = Predictor(grid, fixed_maps(draws), SENSOR, DEPTH, len(draws))
    found = log_ratios(predictor, one_beam_each(scans, beams), cell)
    assert found == pytest.approx(expected, abs=1e-4)
    assert found.max() > 0.01
    assert found.min() < -0.01


@pytest.fixture(scope="module", params=[bm.Surface(), bm.Beta()], ids=["surfaces", "reflectivities"])
def shown(request):
    run = room_run(request.param, draws=10)
    heard = Heard(opened_run(run, "run.nc"))
    heard.infer(heard.engine._opened.document)
    return run, heard


def test_the_wall_of_a_room_is_spoken_for_and_nobody_misses_anything_on_its_floor(shown):
    _, heard = shown
    # A single cell of the wall may be one that its neighbour's long surface would do without.
    of_wall = [heard.ask(Inspect(20, y))[0].header for y in range(2, 18)]
    of_floor = heard.ask(Inspect(10, 14))[0].header
    assert sum(cell["nats_for"] - cell["nats_against"] for cell in of_wall) > 30
    assert max(cell["nats_for"] for cell in of_wall) > 5
    assert all(cell["beams_for"] + cell["beams_against"] <= cell["beams"] for cell in of_wall)
    assert of_floor["beams"] > 20
    assert abs(of_floor["nats_for"] - of_floor["nats_against"]) < 5


def test_a_cell_that_no_beam_reaches_has_none(shown):
    run, heard = shown
    touched = np.zeros(run.grid.n_cells, dtype=bool)
    touched[heard.engine._scene.problem.table.cells] = True
    x, y = np.argwhere(~touched.reshape(run.grid.shape))[0].tolist()
    found = heard.ask(Inspect(x, y))[0].header
    assert (found["beams"], found["nats_for"], found["nats_against"]) == (0, 0.0, 0.0)
