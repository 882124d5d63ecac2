"""Fields say what their numbers are; runs of numbers have intervals, surfaces and a trajectory."""

import numpy as np
import pytest
from acted_engine import Heard

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.notices import View
from bayesmap.app.sources import opened_run

SENSOR = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.01, p_no_return=0.01)


def shown(prior):
    grid = bm.Grid((12, 10), 0.5)
    walls = np.zeros(grid.shape, dtype=bool)
    walls[9] = True
    poses = np.column_stack([np.linspace(1, 2, 4), np.full(4, 2.5), np.zeros(4)])
    scans = bm.simulate(walls, grid, poses, np.linspace(-0.8, 0.8, 40), sensor=SENSOR, max_range_m=8.0, seed=1)
    run = bm.infer(scans, grid, prior=prior, sensor=SENSOR, schedule=bm.Schedule(chains=2, warmup=5, draws=20))
    opened = opened_run(run, "run.nc")
    heard = Heard(opened)
    heard.infer(opened.document)
    return run, heard


@pytest.mark.parametrize(
    ("prior", "kind", "mean"),
    [
        (bm.Independent(0.2), "binary", None),
        (bm.Beta(), "reflectivity", "mean reflectivity"),
        (bm.Surface(), "surface", "mean chance that a square stops a beam"),
    ],
)
def test_a_field_names_its_quantity(prior, kind, mean):
    _, heard = shown(prior)
    header, _ = heard.last("field")
    assert header["quantity"]["kind"] == kind
    assert header["quantity"]["interval"] == (kind != "binary")
    if mean:
        assert header["quantity"]["mean"] == mean
    assert heard.engine._opened.document.cells == kind  # a share link and an exported document say so, too


def test_the_width_is_that_of_the_interval_and_walls_have_none():
    run, heard = shown(bm.Surface())
    heard.ask(View("width"))
    header, buffers = heard.last("field")
    lower, upper = run.interval(0.9)
    assert header["layer"] == "width"
    np.testing.assert_allclose(buffers["p"], 255 * (upper - lower), atol=0.51)
    _, walls = shown(bm.Independent(0.2))
    walls.ask(View("width"))
    assert walls.last("field")[0]["layer"] == "mean"


def test_surfaces_are_strokes_two_deviations_to_either_side():
    run, heard = shown(bm.Surface())
    _, over = heard.last("overlay")
    mean, covariance, reflectivity = run.surfaces()
    some = reflectivity >= 0.1
    strokes = over["strokes"]
    assert len(strokes) == some.sum() > 0
    np.testing.assert_allclose(0.5 * (strokes[:, :2] + strokes[:, 2:4]), mean[some], atol=1e-5)
    length = np.hypot(*(strokes[:, 2:4] - strokes[:, :2]).T)
    np.testing.assert_allclose(length, 4 * np.sqrt(np.linalg.eigvalsh(covariance[some])[:, 1]), rtol=1e-4)
    np.testing.assert_allclose(over["trajectory"], run.posterior.scans.poses[:, :2], atol=1e-6)


def test_a_simulation_has_neither():
    heard = Heard()
    heard.infer(tutorial_document(), "preview")
    assert heard.all("overlay") == []
    assert heard.last("field")[0]["quantity"]["kind"] == "binary"
