"""A log with raw odometry: its trajectory is inferred while the page shows how far it is, and then its cells."""

import itertools
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from acted import Acted, Heard
from poses.simulated import recording

from bayesmap.app.edits import adopt_document
from bayesmap.app.protocol.actions import Cancel, Export, Inspect, ShowScan
from bayesmap.app.protocol.document import Refused
from bayesmap.app.protocol.notices import DrawCount
from bayesmap.app.protocol.tasks import GridChanged, Infer, Ready, TrajectoryInferred, TrajectoryState
from bayesmap.app.protocol.wire import parse_document
from bayesmap.app.shown.hit_maps import MAX_SCANS, evenly_chosen_scans, grow_grid, hit_count_map
from bayesmap.app.sources import open_log
from bayesmap.app.trajectory import ASK_TO_RUN, STAGE_TEXTS, TrajectoryJob, move_to_trajectory
from bayesmap.poses.slam import sort_by_time
from bayesmap.space.grid import Grid


@cache
def recorded():
    return recording(turn_bias=0.03, noise=2.0)


def raw_scans():
    return recorded()[0]


@cache
def raw_log():
    return open_log(raw_scans(), "raw.log")


def few_sweeps():
    return replace(raw_log().document, sweeps=3)


@pytest.fixture(scope="module")
def found():
    """An engine that has inferred the trajectory and some maps."""
    heard = Heard(raw_log())
    heard.infer(few_sweeps(), "run", scan=20)
    return heard


def test_poses_are_taken_for_what_they_look_like():
    assert raw_log().document.poses == "odometry"
    assert open_log(raw_scans().at(recorded()[1]), "true.log").document.poses == "logged"


def test_a_log_before_its_run_is_shown_as_logged_and_answers_questions():
    heard = Heard(raw_log())
    header, buffers = heard.infer(raw_log().document)
    assert header["method"] == "counts"
    assert heard.last("status")[0]["text"] == ASK_TO_RUN
    assert heard.all("stage") == []
    counted = hit_count_map(raw_scans(), raw_log().document.grid)
    assert np.abs(buffers["p"] / 255 - counted.mean()).max() <= 0.5 / 255 + 1e-9
    assert np.array_equal(buffers["reached"] == 255, counted.observed())
    assert np.allclose(heard.last("overlay")[1]["trajectory"], raw_scans().poses[:, :2], atol=1e-5)
    assert heard.all("finished")[-1]["draws"].count == 0
    (cell,) = heard.ask(Inspect(5, 5))
    assert cell.header["beams"] == 0
    assert "run inference first" in heard.answer(Export("run"))[0]["text"]
    assert [heard.answer(Export(what))[0]["type"] for what in ("html", "map")] == ["download"] * 2


def test_run_bends_the_trajectory_stage_by_stage_and_then_samples_the_cells(found):
    kinds = [report.header["type"] for report in found.reports]
    names = [header["name"] for header in found.all("stage")]
    stages = [name for name, _ in itertools.groupby(names)]
    assert stages[:5] == ["reading", "front end", "loops", "aligned", "aligned-again"]
    assert stages[-1] == "placing"
    assert names.count("loops") >= 2  # one for each round
    said = [header["text"] for header in found.all("status")]
    assert said[: len(stages)] == [STAGE_TEXTS[name] for name in stages]
    assert said[-1].startswith("Trajectory inferred: odometry was off by up to")
    ways = [r.buffers["trajectory"] for r in found.reports if r.header["type"] == "overlay"]
    truth = recorded()[1][:, :2] - recorded()[1][0, :2]
    turn = raw_scans().poses[0, 2] - recorded()[1][0, 2]
    turned = truth @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]) + raw_scans().poses[0, :2]
    errors = [np.hypot(*(way - turned).T).max() for way in ways]
    assert errors[0] > 0.5
    assert errors[-1] < 0.05
    pairs = itertools.pairwise([r.header for r in found.reports if r.header["type"] in ("stage", "overlay")])
    drawn = [stage["name"] for stage, way in pairs if (stage["type"], way["type"]) == ("stage", "overlay")]
    assert errors[drawn.index("aligned")] < 0.5 * errors[0]
    begun = [next(header for header in found.all("stage") if header["name"] == name) for name in stages[2:]]
    assert {header["done"] for header in begun} == {0}  # each is named as it begins, not after its first round
    # Every picture of a stage comes with the rays of the scan on show, at its present pose.
    scans = [r for r in found.reports if r.header["type"] == "scan"]
    assert {r.header["index"] for r in scans} == {20}
    assert np.allclose(scans[-1].buffers["pose"][0, :2], turned[20], atol=0.05)
    fields = [header["method"] for header in found.all("field")]
    assert [method for method, _ in itertools.groupby(fields)] == ["counts", "propagate", "gibbs"]
    assert kinds.count("trajectoryinferred") == 1
    assert fields.count("counts") > 5
    assert found.all("finished")[-1]["draws"] == DrawCount(2, 3)
    placed, sizes = found.engine._log_trajectory.inferred_log.scans, []
    for scans in (raw_scans(), placed):  # the map sharpens: at wrong poses more cells seem to be walls
        grid = Grid.covering(scans, 0.1)
        sizes.append((hit_count_map(scans, grid).mean() > 0.5).sum())
    assert sizes[1] < 0.8 * sizes[0]
    assert found.all("gridchanged")[-1]["grid"] == grid == found.engine._result.document.grid


def test_an_inferred_trajectory_is_kept_and_told_to_the_next_worker(found):
    known = found.all("trajectoryinferred")[0]["trajectory"]
    heard = Heard(raw_log())
    heard.engine.take(TrajectoryState(known.poses, known.angles_rad))
    field = heard.infer(few_sweeps(), "run")
    assert heard.all("stage") == []
    assert np.array_equal(field[1]["p"], found.last("field")[1]["p"])
    assert heard.infer(replace(few_sweeps(), prior=0.3))[0]["method"] == "gibbs"
    logged = heard.infer(replace(few_sweeps(), poses="logged"))
    assert heard.engine._result.document.grid == raw_log().document.grid
    assert logged[1]["p"].shape == raw_log().document.grid.shape
    heard.infer(few_sweeps(), "clear")
    assert heard.all("trajectoryinferred")[-1]["trajectory"] is None
    assert heard.last("field")[0]["method"] == "counts"


def test_a_log_that_was_located_is_mapped_on_cells_of_any_size_from_the_first_of_its_scans(found):
    heard = Heard(raw_log())
    coarse = replace(raw_log().document.with_resolution(0.2), scans_used=40, sweeps=3)
    header, buffers = heard.infer(coarse, "coarse")
    assert header["method"] == "counts"  # nobody knows yet where the robot was
    raw = Grid.covering(raw_scans(), 0.2)
    assert coarse.grid == raw
    assert (
        np.abs(buffers["p"] / 255 - hit_count_map(raw_scans().select(slice(40)), raw).mean()).max() <= 0.5 / 255 + 1e-9
    )
    known = found.all("trajectoryinferred")[0]["trajectory"]
    heard.engine.take(TrajectoryState(known.poses, known.angles_rad))
    placed = heard.engine._log_trajectory.inferred_log.scans
    grid = Grid.covering(placed, 0.2)
    assert grid != raw
    for mode, method in (("coarse", "hits"), ("live", "gibbs")):
        header, buffers = heard.infer(coarse, mode)
        result = heard.engine._result
        assert header["method"] == result.method == method
        assert heard.last("gridchanged")[0]["grid"] == grid == result.document.grid
        assert buffers["p"].shape == grid.shape
        assert result.scene.n_used == 40
        assert np.array_equal(result.scene.scans.poses, placed.poses)
    assert result.scene.problem.table.n_beams == 40 * len(placed.angles_rad) < placed.ranges_m.size


@pytest.mark.parametrize("stage", ["front end", pytest.param("loops", marks=pytest.mark.full), "aligned"])
def test_cancel_stops_at_any_stage_and_leaves_what_there_is(stage):
    heard = Heard(raw_log())
    heard.infer_until(few_sweeps(), lambda: any(header["name"] == stage for header in heard.all("stage")), "run")
    heard.engine.take(ShowScan(5))
    assert heard.last("scan")[0]["index"] == 5
    heard.engine.take(Cancel())
    assert not heard.engine.busy
    assert heard.reports[-1].header["type"] == "finished"
    assert heard.last("field")[0]["method"] == "counts"
    TrajectoryJob._latest_thread.join(20)
    assert not TrajectoryJob._latest_thread.is_alive()
    assert heard.engine._log_trajectory.inferred_log is None


def test_another_job_takes_the_place_of_the_inference():
    heard = Heard(raw_log())
    heard.infer(few_sweeps(), "run", steps=1)
    assert heard.infer(replace(few_sweeps(), poses="logged"))[0]["method"] == "gibbs"


def test_trouble_of_the_inference_is_reported():
    log = open_log(replace(raw_scans(), ranges_m=np.full_like(raw_scans().ranges_m, np.inf)), "blind.log")
    heard = Heard(log)
    heard.infer(replace(log.document, poses="odometry"), "run", steps=0)
    heard.finish()
    assert "no scan has a single hit" in heard.last("failed")[0]["reason"]


def test_a_log_gives_equal_poses_again_and_scans_stay_in_its_order(found):
    shuffled = np.random.default_rng(3).permutation(len(raw_scans()))
    scans = raw_scans().select(shuffled)
    job = TrajectoryJob(Infer(1, few_sweeps(), "run"), scans, raw_log().document.grid)
    steps = [step for step in job.reports() if step is not None]
    last = move_to_trajectory(scans, job.trajectory)
    assert np.array_equal(sort_by_time(scans)[0], np.argsort(scans.stamps_s))
    assert np.array_equal(last.stamps_s, scans.stamps_s)
    assert np.array_equal(last.poses, found.engine._log_trajectory.inferred_log.scans.poses[shuffled])
    assert np.array_equal(steps[-1].result.scene.scans.poses, last.poses)


def test_the_map_only_grows_and_on_the_same_lattice():
    grid = raw_log().document.grid
    assert grow_grid(grid, raw_scans()) == grid
    away = raw_scans().at(raw_scans().poses + np.array([-3.33, 0.0, 0.0]))
    larger = grow_grid(grid, away)
    x0, x1, y0, y1 = larger.extent_m
    assert x0 < grid.extent_m[0]
    assert x1 == pytest.approx(grid.extent_m[1])
    assert (y0, y1) == pytest.approx(grid.extent_m[2:])
    assert (grid.origin[0] - x0) / 0.1 == pytest.approx(round((grid.origin[0] - x0) / 0.1))
    assert hit_count_map(away, larger).observed().sum() > 1000
    assert len(evenly_chosen_scans(raw_scans().select(np.arange(2000) % len(raw_scans())))) == MAX_SCANS


def test_the_session_takes_over_the_grid_and_keeps_the_trajectory_for_the_next_worker():
    acted = Acted(raw_log().document)
    acted.act("hello")
    acted.act("run")
    acted.hear(GridChanged(Grid((30, 40), 0.1, (-1.0, 2.0)), generation=0))
    assert acted.state["document"]["grid"]["shape"] == [30, 40]
    assert not acted.state["can_undo"]
    acted.hear(TrajectoryInferred(TrajectoryState(np.zeros((2, 3)), np.zeros(4)), generation=0))
    acted.session.worker_lost()
    before = len(acted.tasks)
    acted.hear(Ready())
    assert [type(task) for task in acted.tasks[before:]] == [TrajectoryState, Infer]
    assert acted.inferred[-1].mode == "run"  # it was under way
    acted.act("set", patch={"poses": "logged"})
    assert acted.inferred[-1].document.poses == "logged"
    acted.act("undo")
    assert acted.inferred[-1].document.poses == "odometry"


def test_a_link_to_a_log_that_was_inferred_fits_the_log_as_it_is_opened():
    inferred = replace(raw_log().document.on_grid(Grid((30, 40), 0.1)), sweeps=77)
    brought = parse_document({**inferred.to_json(), "walls": ""})
    adopted = adopt_document(raw_log().document.with_scans_used(3), brought)
    assert (adopted.sweeps, adopted.scans_used) == (77, None)
    assert adopt_document(raw_log().document, brought).grid == raw_log().document.grid
    as_logged = [replace(document, poses="logged") for document in (raw_log().document, brought)]
    with pytest.raises(Refused):
        adopt_document(*as_logged)
