"""Uncertain poses of a drawn world: the chains are the library's, their maps the posterior over map and poses."""

from dataclasses import replace

import numpy as np
import pytest
from acted_engine import TINY, Heard
from flat_options import infer

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.document import Sensor
from bayesmap.app.scene import simulate_document, simulated_scene
from bayesmap.app.shown.chains import (
    POSE_CHAINS,
    SMALLEST_HEADING_RAD,
    SMALLEST_POSE_M,
    chains_of_walls,
    pose_prior,
    pose_starts,
    starts,
)
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.without_chains import enumerate_maps


def test_known_poses_are_sampled_as_known():
    scene = simulated_scene(TINY)
    assert not chains_of_walls(scene, TINY, starts(scene.problem, TINY, None)).model.poses.unknown


@pytest.mark.parametrize(
    "changes", [{"pose_sigma": 0.5}, {"heading_sigma": 0.1}, {"pose_sigma": 0.5, "method": "block"}]
)
def test_a_run_is_that_of_the_library_and_saved_with_its_poses(changes, tmp_path):
    document = replace(tutorial_document(), sweeps=6, angles=40, burn_in=0.0, **changes)
    heard = Heard()
    heard.infer(document, "run")
    scans, _ = simulate_document(document)
    sigma_m = max(document.pose_sigma, SMALLEST_POSE_M)
    run = infer(
        scans, document.grid, prior=bm.Independent(0.5), sensor=bm.Gaussian(0.2), method=document.sampler,
        chains=POSE_CHAINS, warmup=0, draws=6, start=starts(simulated_scene(document).problem, document, None),
        poses=bm.UncertainPoses(sigma_m, max(document.heading_sigma, SMALLEST_HEADING_RAD)),
        start_poses=pose_starts(document, POSE_CHAINS), seed=0,
    )  # fmt: skip
    stream = heard.engine._result.found
    assert np.array_equal(stream.draws.arrays["walls"], run.posterior.draws.arrays["walls"])
    assert np.array_equal(stream.draws.arrays["poses"], run.poses)
    assert np.array_equal(stream.log_joint(), run.log_joint)
    assert np.array_equal(heard.saved_run(tmp_path).poses, run.poses)


@pytest.mark.full
def test_maps_are_averaged_over_the_posterior_of_the_pose():
    """Against enumeration of all maps at 2000 poses of the prior, each weighed by its evidence.

    They are worth some 700, so that the reference's standard error is 0.02 at most; that of the chains, at 400
    effective draws, 0.025. Two of both together are 0.07; known poses, the twin, are more than four times that off.
    """
    document = replace(TINY, noise=2.0, angles=10, sweeps=2500, pose_sigma=0.3, heading_sigma=0.3)
    scene = simulated_scene(document)
    rng = np.random.default_rng(5)
    evidence, maps = [], []
    for there in scene.scans.poses[0] + 0.3 * rng.standard_normal((2000, 3)):
        table = trace(scene.scans.at(there[None]), document.grid, scene.sensor)
        found = enumerate_maps(WallProblem(table, scene.problem.prior, there[None]))
        evidence.append(found.log_evidence)
        maps.append(found.marginals())
    weights = np.exp(np.array(evidence) - max(evidence))
    weights /= weights.sum()
    assert 1 / (weights**2).sum() > 500
    exact = np.einsum("k,kxy->xy", weights, np.array(maps))
    header, buffers = Heard().infer(document)
    assert header["ess"] > 400
    assert np.abs(buffers["p"] / 255 - exact).max() < 0.07
    assert np.abs(enumerate_maps(scene.problem).marginals() - exact).max() > 0.28


def test_walls_blur_as_positions_become_uncertain_by_whole_cells():
    drawn = tutorial_document().is_wall
    sure = []
    for sigma_m in (0.0, 0.5, 1.0):
        heard = Heard()
        _, buffers = heard.infer(replace(tutorial_document(), sweeps=20, angles=40, pose_sigma=sigma_m))
        seen = buffers["reached"] >= 128
        sure.append((buffers["p"][drawn & seen] / 255).mean())
        if sigma_m > 0:  # no picture of known poses in between
            assert {header["method"] for header in heard.all("field")} == {"gibbs"}
    assert sure[0] > sure[1] + 0.1 > sure[2] + 0.2


def test_chains_are_dealt_out_over_shifts_by_whole_cells_as_the_prior_says():
    sensors = (Sensor(1, 6.0, 15.0, 0.4), Sensor(2, 9.0, 14.0, 0.0))
    document = replace(tutorial_document(), pose_sigma=1.0, sensors=sensors)
    found = pose_starts(document, 4000)
    shift = found[..., :2] - pose_starts(document, 1)[..., :2]
    assert np.array_equal(shift[:, 0], shift[:, 1])
    assert np.array_equal(shift, np.round(shift))
    assert (found[..., 2] == [0.4, 0.0]).all()
    cells = np.arange(-3, 4)
    share = np.exp(-(cells**2.0))  # two sensors: exp(-2 s^2 / 2)
    for axis in range(2):
        counted = [(shift[:, 0, axis] == cell).mean() for cell in cells]
        assert np.abs(counted - share / share.sum()).max() < 0.01


@pytest.mark.parametrize("method", ["propagate", "importance"])
def test_methods_that_take_poses_as_known_do_so(method):
    document = replace(tutorial_document(), method=method, pose_sigma=0.5, sweeps=100)
    assert pose_prior(document) is None
    _, buffers = Heard().infer(document, "run")
    assert np.array_equal(buffers["p"], Heard().infer(replace(document, pose_sigma=0.0), "run")[1]["p"])


def test_chains_at_several_shifts_are_judged_at_each_and_told_what_would_help(monkeypatch):
    for module in ("chains", "result"):
        monkeypatch.setattr(f"bayesmap.app.shown.{module}.FEWEST_SWEEPS", 40)  # sweeps of sixteen chains take long
    document = replace(tutorial_document(), pose_sigma=1.0, sweeps=40, angles=40)
    heard = Heard()
    header, _ = heard.infer(document)
    found = heard.engine._result.found
    places = np.unique(found.shifts, axis=0)
    assert len(places) > 1
    verdict = header["verdict"]
    assert header["rhat"] > 1.05
    assert f"chains stand at {len(places)} shifts" in verdict["why"]
    assert "another sensor or surer poses" in verdict["why"]
    same = heard.infer(replace(document, pose_sigma=0.01))[0]
    assert "shifts" not in (same["verdict"] or {"why": ""})["why"]
