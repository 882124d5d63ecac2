"""Where am I? The posterior over the pose of a scan, in a drawn world and on a run."""

from dataclasses import replace

import numpy as np
import pytest
from acted_engine import Heard

import bayesmap as bm
from bayesmap.app.answers.whereabouts import Locator, drawn_map
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.actions import ShowScan, WhereAmI
from bayesmap.app.protocol.document import Sensor, no_walls, packed
from bayesmap.app.protocol.tasks import Infer
from bayesmap.app.sources import opened_log, opened_run

PAGE = 7


def asked(document, sensor=1):
    heard = Heard()
    heard.infer(document, "preview")
    (report,) = heard.ask(WhereAmI(sensor))
    assert report.client == PAGE
    return report


def square(**changes):
    walls = np.zeros((21, 21), dtype=bool)
    walls[4:17, [4, 16]] = walls[[4, 16], 4:17] = True
    return replace(tutorial_document(), walls=packed(walls), noise=0.05, **changes)


def test_the_robot_of_the_tutorial_knows_where_it_is():
    report = asked(tutorial_document())
    modes, pose = report.header["modes"], report.header["pose"]
    assert len(modes) == 1
    assert modes[0]["probability"] == pytest.approx(1.0)
    assert np.abs(np.array(modes[0]["mean"][:2]) - pose[:2]).max() < 4 * modes[0]["sigma_m"] < 0.3
    assert report.header["p_lost"] < 1e-3
    assert report.buffers["pose"].shape == (len(report.buffers["weight"]), 3)
    assert report.buffers["weight"].sum() == pytest.approx(1.0, abs=1e-4)
    assert (np.diff(report.buffers["weight"]) >= 0).all()


def test_in_a_square_room_there_are_four_places_and_the_truth_is_one():
    report = asked(square(sensors=(Sensor(1, 8.3, 9.1, 0.2),)))
    modes = report.header["modes"]
    assert [mode["probability"] > 0.1 for mode in modes] == [True] * 4
    away = [np.hypot(mode["mean"][0] - 8.3, mode["mean"][1] - 9.1) for mode in modes]
    assert min(away) < 0.05
    assert sum(distance < 1.0 for distance in away) == 1


def test_each_sensor_is_asked_about_by_its_id():
    document = square(sensors=(Sensor(1, 8.3, 9.1, 0.2), Sensor(5, 11.0, 13.0, 0.0)))
    report = asked(document, sensor=5)
    assert (report.header["sensor"], report.header["pose"]) == (5, [11.0, 13.0, 0.0])
    assert asked(document, sensor=9).header["sensor"] == 1


def test_a_world_of_nothing_leaves_it_open():
    report = asked(replace(tutorial_document(), walls=no_walls(tutorial_document().grid)))
    assert report.header["modes"][0]["sigma_m"] > 5.0
    assert report.header["p_lost"] < 0.1


def test_the_same_question_has_the_same_answer():
    one, two = asked(tutorial_document()), asked(tutorial_document())
    assert np.array_equal(one.buffers["pose"], two.buffers["pose"])


def test_the_drawn_map_is_the_same_on_finer_cells():
    document = tutorial_document()
    known = drawn_map(document)
    assert known.grid.resolution <= 0.125
    assert known.grid.extent_m == document.grid.extent_m
    assert known.free.sum() * known.grid.resolution**2 == pytest.approx((~document.is_wall).sum())


@pytest.fixture(scope="module")
def run():
    walls = np.zeros((50, 36), dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[20:23, :14] = walls[34:, 24:] = True
    grid = bm.Grid(walls.shape, 0.1)
    t = np.linspace(0, 1, 14)
    poses = np.column_stack([1.0 + 2.5 * t, 2.6 - 0.6 * t, 2 * t])
    sensor = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01)
    angles = np.linspace(-np.pi, np.pi, 90, endpoint=False)
    scans = bm.simulate(walls, grid, poses, angles, sensor=sensor, max_range_m=8.0, seed=2)
    return bm.infer(scans, grid, prior=bm.Surface(), sensor=sensor, schedule=bm.Schedule(chains=2, warmup=15, draws=15))


def test_the_scan_on_show_is_located_in_the_map_of_a_run(run):
    heard = Heard(opened_run(run, "run.nc"))
    heard.infer(heard.engine._opened.document, scan=3)
    (first,) = heard.ask(WhereAmI())
    assert first.header["index"] == 3
    heard.ask(ShowScan(9))
    (second,) = heard.ask(WhereAmI())
    assert second.header["index"] == 9
    for report, index in ((first, 3), (second, 9)):
        assert report.header["pose"] == run.posterior.scans.poses[index].tolist()
        best = report.header["modes"][0]
        assert best["probability"] > 0.9
        assert np.hypot(*(np.array(best["mean"][:2]) - report.header["pose"][:2])) < 0.15
        assert report.header["p_lost"] < 0.05


def test_a_scan_of_nowhere_is_lost(run):
    """Readings as common as the map's own, but in an order that no place has."""
    opened = opened_run(run, "run.nc")
    ranges_m = np.random.default_rng(3).permuted(run.posterior.scans.ranges_m, axis=1)
    elsewhere = replace(run.posterior.scans, ranges_m=ranges_m)
    result = opened.result
    result = replace(result, scene=replace(result.scene, scans=elsewhere))
    notice, _ = Locator().answer(WhereAmI(), result, 0, 1)
    assert notice.p_lost > 0.5


def test_a_question_that_comes_with_an_edit_waits_for_its_picture():
    heard = Heard()
    heard.engine.take(Infer(1, tutorial_document(), "preview"))
    assert heard.ask(WhereAmI(1)) == []
    while heard.engine.busy:
        heard.engine.advance()
    assert heard.last("where")[0]["of"] == 1
    assert heard.last("where")[0]["trouble"] == ""


def test_why_there_is_no_answer(run):
    heard = Heard()
    assert "no map" in heard.ask(WhereAmI())[0].header["trouble"]
    log = opened_log(run.posterior.scans, "x.log")
    heard = Heard(log)
    heard.infer(log.document, "preview")
    assert "Run keeps them" in heard.ask(WhereAmI())[0].header["trouble"]
    heard.engine.take(Infer(9, replace(log.document, sweeps=5), "run"))
    while heard.engine.busy:
        heard.engine.advance()
    assert heard.ask(WhereAmI())[0].header["trouble"] == ""
