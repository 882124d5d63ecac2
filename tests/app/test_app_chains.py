"""Chains, previews and verdicts that the page shows: those of the library, and what they are worth."""

import math
from dataclasses import replace

import numpy as np
import pytest
from acted import TINY, Heard
from flat_options import infer

import bayesmap as bm
from bayesmap.app import scene as scanning
from bayesmap.app.edits import new_document, tutorial_document
from bayesmap.app.protocol.document import Sensor
from bayesmap.app.scene import simulate_document, simulated_scene
from bayesmap.app.shown import verdicts
from bayesmap.app.shown.chains import (
    MIN_SIGMA_M,
    MIN_SIGMA_RAD,
    POSE_CHAINS,
    chains_of_walls,
    first_maps_of,
    pose_prior,
    pose_starts,
)
from bayesmap.app.shown.verdicts import Difference, compare_means, judge_chains, judge_particles, misfit_of
from bayesmap.app.shown.without_chains import Preview
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.without_chains import enumerate_maps, propagate


def test_known_poses_are_sampled_as_known():
    scene = simulated_scene(TINY)
    assert not chains_of_walls(scene, TINY, first_maps_of(scene.problem, TINY, None)).model.poses.unknown


@pytest.mark.parametrize(
    "changes", [{"pose_sigma": 0.5}, {"heading_sigma": 0.1}, {"pose_sigma": 0.5, "method": "block"}]
)
def test_a_run_is_that_of_the_library_and_saved_with_its_poses(heard, changes, tmp_path):
    document = replace(tutorial_document(), sweeps=6, angles=40, burn_in=0.0, **changes)
    heard.infer(document, "run")
    scans, _ = simulate_document(document)
    sigma_m = max(document.pose_sigma, MIN_SIGMA_M)
    run = infer(
        scans, document.grid, prior=bm.Independent(0.5), sensor=bm.Gaussian(0.2), method=document.sampler,
        chains=POSE_CHAINS, warmup=0, draws=6, start=first_maps_of(simulated_scene(document).problem, document, None),
        poses=bm.UncertainPoses(sigma_m, max(document.heading_sigma, MIN_SIGMA_RAD)),
        start_poses=pose_starts(document, POSE_CHAINS), seed=0,
    )  # fmt: skip
    stream = heard.engine._result.estimate
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
    evidence, maps = [], []
    for pose in scene.scans.poses[0] + 0.3 * np.random.default_rng(5).standard_normal((2000, 3)):
        table = trace(scene.scans.at(pose[None]), document.grid, scene.sensor)
        posterior = enumerate_maps(WallProblem(table, scene.problem.prior, pose[None]))
        evidence.append(posterior.log_evidence)
        maps.append(posterior.marginals())
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
        sure.append((buffers["p"][drawn & (buffers["reached"] >= 128)] / 255).mean())
        if sigma_m > 0:  # no picture of known poses in between
            assert {header["method"] for header in heard.all("field")} == {"gibbs"}
    assert sure[0] > sure[1] + 0.1 > sure[2] + 0.2


def test_chains_are_dealt_out_over_shifts_by_whole_cells_as_the_prior_says():
    sensors = (Sensor(1, 6.0, 15.0, 0.4), Sensor(2, 9.0, 14.0, 0.0))
    document = replace(tutorial_document(), pose_sigma=1.0, sensors=sensors)
    starts_of_chains = pose_starts(document, 4000)
    shift = starts_of_chains[..., :2] - pose_starts(document, 1)[..., :2]
    assert np.array_equal(shift[:, 0], shift[:, 1])
    assert np.array_equal(shift, np.round(shift))
    assert (starts_of_chains[..., 2] == [0.4, 0.0]).all()
    cells = np.arange(-3, 4)
    share = np.exp(-(cells**2.0))  # two sensors: exp(-2 s^2 / 2)
    for axis in range(2):
        assert np.abs([(shift[:, 0, axis] == cell).mean() for cell in cells] - share / share.sum()).max() < 0.01


@pytest.mark.parametrize("method", ["propagate", "importance"])
def test_methods_that_take_poses_as_known_do_so(method):
    document = replace(tutorial_document(), method=method, pose_sigma=0.5, sweeps=100)
    assert pose_prior(document) is None
    _, buffers = Heard().infer(document, "run")
    assert np.array_equal(buffers["p"], Heard().infer(replace(document, pose_sigma=0.0), "run")[1]["p"])


def test_chains_at_several_shifts_are_judged_at_each_and_told_what_would_help(heard, monkeypatch):
    monkeypatch.setattr(verdicts, "VERDICT_LIMITS", verdicts.VerdictLimits(fewest_sweeps=40))  # sixteen take long
    document = replace(tutorial_document(), pose_sigma=1.0, sweeps=40, angles=40)
    header, _ = heard.infer(document)
    places = np.unique(heard.engine._result.estimate.shifts, axis=0)
    assert len(places) > 1
    verdict = header["verdict"]
    assert header["rhat"] > 1.05
    assert f"chains stand at {len(places)} shifts" in verdict["why"]
    assert "which more sweeps lower; another sensor or surer poses" in verdict["why"]
    assert "shifts" not in (heard.infer(replace(document, pose_sigma=0.01))[0]["verdict"] or {"why": ""})["why"]


BUILDING = new_document("building", (80, 60), tutorial_document())
SENSOR = BUILDING.sensors[0]
CASES = {
    "tutorial": tutorial_document(),
    "much noise": replace(tutorial_document(), noise=3.0),
    "rare walls": replace(tutorial_document(), prior=0.02),
    "exact readings, no noise": replace(tutorial_document(), readings="exact", noise=0.01),
    "a short range": replace(BUILDING, max_range=1.5),
    "a fan of two": replace(BUILDING, fov=math.pi / 2, sensors=(SENSOR, Sensor(2, SENSOR.x + 0.3, SENSOR.y, 2.0))),
    "a building": BUILDING,
}


def previewed(problem, rounds=math.inf):
    preview = Preview(problem)
    while preview.rounds < rounds and not (rounds == math.inf and preview.converged):
        preview.round()
    return preview


@pytest.mark.parametrize("name", CASES)
def test_beams_that_end_past_their_readings_say_what_whole_ones_say(name):
    scene = simulated_scene(CASES[name])
    near, whole = previewed(scene.near_problem, 6), previewed(scene.problem, 6)
    least = 0.5 if name == "a building" else 1.0  # there most of a beam is left out
    assert near.problem.table.n_incidences <= least * whole.problem.table.n_incidences
    assert np.abs(near.mean() - whole.mean()).max() < 1e-5
    assert np.array_equal(near.observed(), whole.observed())


def test_beams_that_end_at_their_readings_say_something_else(monkeypatch):
    """The wrong twin of the test above is told apart."""
    monkeypatch.setattr(scanning, "CUT_SIGMAS", 0.5)
    scene = simulated_scene(tutorial_document())
    assert np.abs(previewed(scene.near_problem, 6).mean() - previewed(scene.problem, 6).mean()).max() > 0.05


def test_another_prior_shares_the_beams_that_there_are():
    scene = simulated_scene(tutorial_document())
    untouched = scene.with_prior(0.3)
    assert "problem" not in vars(untouched)
    assert untouched.problem.prior.p_wall == untouched.near_problem.prior.p_wall == 0.3
    table, near = scene.problem.table, scene.near_problem.table
    other = scene.with_prior(0.2)
    assert (other.problem.table, other.near_problem.table) == (table, near)
    assert other.problem.prior.p_wall == other.near_problem.prior.p_wall == 0.2


def test_a_preview_is_the_library_s_belief_propagation_and_one_chain_of_two_starts_from_it():
    document = tutorial_document()
    problem = simulated_scene(document).problem
    preview, whole = previewed(problem), propagate(WallProblem(problem.table, problem.prior, problem.poses))
    assert preview.rounds == len(whole.changes)
    assert np.abs(preview.mean() - whole.p_wall).max() < 1e-5
    begun = first_maps_of(problem, document, preview)
    assert begun.shape == (2, 21, 21)
    sure = np.abs(preview.mean() - 0.5) > 0.4
    assert np.array_equal(begun[0][sure], preview.mean()[sure] > 0.5)
    assert not begun[1].any()
    assert not first_maps_of(problem, replace(document, start="empty"), None).any()
    drawn = first_maps_of(problem, replace(document, start="prior"), None)
    assert 0.4 < drawn.mean() < 0.6
    assert not np.array_equal(drawn[0], drawn[1])
    assert np.array_equal(first_maps_of(problem, document, None), drawn)


NAN = math.nan


@pytest.mark.parametrize(("rhat", "ess", "sweeps", "apart", "over", "level", "why"), [
    (1.001, 900, 1000, 0.03, False, "good", "R-hat"), (1.02, 900, 1000, 0.03, False, "fair", "R-hat"),
    (1.001, 300, 1000, 0.03, False, "fair", "300 effective"), (1.06, 900, 1000, 0.03, False, "bad", "R-hat"),
    (1.001, 20, 1000, 0.03, False, "bad", "20 effective"), (1.001, 900, 1000, 0.5, False, "bad", "cell (3, 4)"),
    (NAN, NAN, 1000, 0.5, False, "bad", "cell (3, 4)"),
    (NAN, NAN, 1000, 0.0, False, "good", "nothing varies"),  # a log joint that never changed
    (NAN, NAN, 1000, None, True, "fair", "nothing varies"),  # of one chain, or a saved run
    (2.0, 3, 20, None, False, None, ""),  # too early
    (2.0, 3, 20, None, True, "bad", "R-hat"),
    # of few sweeps that are over the log joint alone speaks: their means differ by chance
    (1.465, 7, 10, 1.0, True, "bad", "R-hat"), (1.001, 900, 150, 1.0, True, "good", "R-hat"),
    (NAN, NAN, 1, None, False, None, ""), (NAN, NAN, 1, None, True, "bad", "1 sweep is"),
    (NAN, NAN, 3, None, True, "bad", "3 sweeps are"),
])  # fmt: skip
def test_chains_are_judged_by_r_hat_effective_draws_and_their_difference(rhat, ess, sweeps, apart, over, level, why):
    largest = None if apart is None else Difference(apart, (3, 4), 2 * (apart > 0.25), 100)
    verdict = judge_chains(rhat, ess, sweeps, largest, ended=over)
    assert (verdict and verdict.level) == level
    assert verdict is None or why in verdict.why
    assert verdict is None or ("(3, 4)" in verdict.why) == ("(3, 4)" in why)


def test_chains_that_agree_on_maps_that_the_readings_contradict_are_not_called_converged():
    beams, sigma_m = 50, 0.3
    peak = -beams * math.log(sigma_m * math.sqrt(2 * math.pi))
    true = np.random.default_rng(0).chisquare(beams, (20_000, 1))
    assert sum(misfit_of(peak - one[None] / 2, sigma_m, beams) is not None for one in true) <= 3
    off = misfit_of(np.full((2, 9), peak - 4 * beams / 2), sigma_m, beams)  # twice the noise
    assert off == pytest.approx(2.0)
    assert misfit_of(np.zeros((2, 0)), sigma_m, beams) is misfit_of(np.ones((2, 3)), sigma_m, 0) is None
    for rhat, ess in ((1.001, 900), (NAN, NAN)):
        verdict = judge_chains(rhat, ess, 1000, Difference(0.0, (0, 0), 0, 9), misfit=off)
        assert (verdict.level, "readings contradict: they differ by 2 times the noise" in verdict.why) == ("bad", True)
    assert "R-hat" in judge_chains(1.2, 900, 1000, None, misfit=off).why  # they do not agree


@pytest.mark.parametrize("method", ["gibbs", "block"])
def test_rare_walls_cell_by_cell_from_the_prior_are_seen_to_be_impossible_and_blocks_are_not(heard, method):
    document = replace(tutorial_document(), prior=0.05, method=method, start="prior", sweeps=250, seed=3)
    verdict = heard.infer(document)[0]["verdict"]
    stream = heard.engine._result.estimate
    likelihood = stream._log_likelihood[:, stream._checkpoints[0].sweep :]
    assert (misfit_of(likelihood, document.noise, document.angles) is None) == (method == "block")
    assert (verdict["level"] == "bad") == (method == "gibbs")


def test_settings_are_told_as_they_were_set():
    about = dict(Heard().infer(replace(tutorial_document(), prior=0.0, pose_sigma=0.2, sweeps=5))[0]["about"])
    assert (about["Prior"], about["Poses"]) == ("independent: p wall 0", "uncertain: sigma 0.2 m")


def test_the_difference_is_the_largest_among_the_observed_cells():
    means = np.zeros((3, 4, 5))
    means[0, 1, 2], means[2, 3, 3] = 0.5, 0.9
    among = np.ones((4, 5), dtype=bool)
    assert compare_means(means, among) == Difference(0.9, (3, 3), 2, 20)
    among[3, 3] = False
    assert compare_means(means, among) == Difference(0.5, (1, 2), 1, 19)
    assert compare_means(means[:1], among) is None
    assert compare_means(means, np.zeros((4, 5), dtype=bool)) is None


@pytest.mark.parametrize(("ess", "level", "why"), [
    (1.0, "bad", "one particle carries all the weight"), (1.2, "bad", "1.2 particles carry all the weight"),
    (100, "fair", "100 effective particles"), (5000, "good", "5000 effective particles"),
])  # fmt: skip
def test_particles_are_judged_by_their_effective_number(ess, level, why):
    verdict = judge_particles(ess)
    assert (verdict.level, verdict.why) == (level, why)


def test_one_cell_of_a_hundred_makes_no_verdict_red_and_the_words_are_the_kind_s():
    def judged(cells):
        return judge_chains(1.001, 900, 1000, Difference(0.9, (3, 4), cells, 200), quantity="mean reflectivity")

    assert judged(2).level == "good"
    assert (judged(3).level, judged(3).cell) == ("bad", (3, 4))
    assert judged(3).why.startswith("mean reflectivity differs by over 0.25 between the chains in 3 of 200")
