"""Map and poses together: exact by simulation-based calibration, the same bits however chains are run.

Simulation-based calibration (Talts, Betancourt, Simpson, Vehtari and Gelman, 2018): a map, poses and readings are drawn
from the model; then the rank of what is true among draws of its posterior is uniform. All its tests together fail for
one choice of seeds in ten thousand.
"""

from dataclasses import replace

import numpy as np
import pytest
import scipy
from oracle.formula import beams, distances
from oracle.verdict import ALPHA

import bayesmap as bm
from bayesmap.model import Model
from bayesmap.poses.prior import Odometry, UncertainPoses
from bayesmap.run.chains import SweepPlan
from bayesmap.run.runner import Job, run_chains
from bayesmap.samplers.sampler import Keep
from bayesmap.samplers.walls import WallGibbs
from bayesmap.samplers.with_poses import WithPoses
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((8, 8), 0.5, (0.0, 0.0))
LIMITS = RangeLimits(0.1, 5.0)
ANGLES = np.linspace(0, 2 * np.pi, 9, endpoint=False)
SENSOR = bm.Gaussian(0.25)
PRIORS = {"uncertain": UncertainPoses(0.15, 0.2), "odometry": Odometry(0.2, 0.1, 0.2, 0.2, 0.05, 0.08)}


def drawn_model(seed, prior, scans=4):
    """A model whose map, poses and readings come from itself, and the truth."""
    rng = np.random.default_rng(seed)
    walls = rng.random(GRID.shape) < 0.25
    said = np.column_stack([rng.uniform(1, 3, (scans, 2)), rng.uniform(-3, 3, scans)])
    truth = prior.law(said).sample(rng)
    starts, directions = beams(truth, ANGLES, GRID)
    metres = np.minimum(distances(walls, starts, directions) * GRID.resolution, LIMITS.max_m)
    readings = SENSOR.sample(rng, metres, LIMITS).reshape(scans, -1)
    log = bm.Scans(said, ANGLES, readings, max_range_m=LIMITS.max_m, min_range_m=LIMITS.min_m)
    return Model(log, GRID, bm.Independent(0.25), SENSOR, prior), walls, truth


def chains_of(model, ids, schedule, seed, walls="prior", **options):
    sampler = WithPoses(WallGibbs(start=walls), schedule.warmup, **{"every": 2, "pose_steps": 4} | options)
    return run_chains(Job(model, sampler, schedule, seed, tuple(ids), threads=1))


@pytest.mark.full
@pytest.mark.parametrize("name", PRIORS)
def test_ranks_of_the_truth_among_draws_are_uniform(name):
    """Ranks among seven nearly independent draws: of the last pose, the log likelihood, and the number of walls."""
    worlds, draws = 80, 7
    ranks = {what: [] for what in ("x", "y", "yaw", "walls", "likelihood")}
    biased = []
    for seed in range(worlds):
        model, walls, truth = drawn_model(seed, PRIORS[name])
        # The chain starts at the truth, a draw of the posterior: what has to be forgotten is forgotten in warm-up.
        chains = chains_of(model, [0], SweepPlan(15, draws, 12), seed, walls, start=truth[None], every=3, pose_steps=6)
        poses, maps = chains.draws.values("poses")[0], chains.draws.values("walls")[0]
        rng = np.random.default_rng(seed)

        def rank(true, drawn, rng=rng):
            return int((drawn < true).sum() + rng.integers((drawn == true).sum() + 1))

        last = poses[:, -1] - truth[-1]
        last[:, 2] = (last[:, 2] + np.pi) % (2 * np.pi) - np.pi
        for i, what in enumerate(("x", "y", "yaw")):
            ranks[what].append(rank(0.0, last[:, i]))
        biased.append(rank(0.15, last[:, 0]))
        ranks["walls"].append(rank(walls.sum(), maps.sum(axis=(1, 2))))
        state = replace(model.state({"walls": walls}), poses=truth)
        ranks["likelihood"].append(rank(model.log_likelihood(state), chains.log_likelihood[0]))
    for what, found in ranks.items():
        counts = np.bincount(found, minlength=draws + 1)
        assert scipy.stats.chisquare(counts).pvalue > ALPHA / (len(ranks) * len(PRIORS)), what
    counts = np.bincount(biased, minlength=draws + 1)  # a wrong twin: poses 15 cm off
    assert scipy.stats.chisquare(counts).pvalue < ALPHA / (len(ranks) * len(PRIORS))


def test_a_chain_does_not_depend_on_its_company_nor_on_steps():
    model, _, _ = drawn_model(1, PRIORS["odometry"])
    schedule = SweepPlan(6, 5, 2)
    together = chains_of(model, [3, 4, 7], schedule, 11)
    alone = chains_of(model, [4], schedule, 11)
    for name, values in alone.draws.arrays.items():
        assert (together.draws.arrays[name][1] == values[0]).all(), name
    sampler = WithPoses(WallGibbs(start="prior"), 6, every=2, pose_steps=4)
    problem = sampler.prepare(model, "cpu", 1)
    state = sampler.init(problem, [4], 11)
    for count in (1, 4, 3, 8):
        if count == 3:  # stopped, and gone on with
            state = sampler.init(problem, [4], 11, sampler.snapshot(state))
        state, info = sampler.step(state, count, keep=Keep(6, 2))
    assert (info.draws["poses"][0, -1] == alone.draws.arrays["poses"][0, -1]).all()
    assert (info.draws["walls"][0, -1] == alone.draws.arrays["walls"][0, -1]).all()
    assert info.log_likelihood[0, -1] == alone.log_likelihood[0, -1]


def test_the_log_joint_is_the_models():
    model, _, _ = drawn_model(2, PRIORS["odometry"])
    chains = chains_of(model, [0, 1], SweepPlan(4, 6), 3)
    for chain in range(2):
        for draw in range(6):
            state = replace(
                model.state({"walls": chains.draws.values("walls")[chain, draw]}),
                poses=chains.draws.values("poses")[chain, draw],
            )
            assert chains.log_joint[chain, draw] == pytest.approx(model.log_joint(state), abs=1e-3)


def test_infer_takes_a_prior_of_poses_and_its_run_keeps_their_draws(tmp_path):
    model, _, _ = drawn_model(5, PRIORS["uncertain"])
    options = {"prior": bm.Independent(0.25), "sensor": SENSOR, "schedule": bm.Schedule(chains=2, warmup=10, draws=8)}
    run = bm.infer(model.scans, GRID, poses=model.poses, **options)
    assert run.poses.shape == (2, 8, 4, 3)
    assert run.poses.std(axis=1).min() > 0
    assert run.pose_summary().mean.shape == (4, 3)
    run.save(tmp_path / "run.nc")
    again = bm.load(tmp_path / "run.nc")
    assert (again.poses == run.poses).all()
    assert again.posterior.settings["poses"] == model.poses.describe()
    assert (bm.infer(model.scans, GRID, **options).poses == model.scans.poses).all()


@pytest.mark.parametrize("prior", [bm.Beta(), bm.Surface()], ids=["reflectivity", "surface"])
def test_reflectivities_and_surfaces_have_poses_too(prior):
    """Poses that are a little wrong come nearer to where they were, when the map is seen from all of them."""
    walls, pose = bm.worlds.tutorial()
    grid = bm.Grid((21, 21), 1.0, (-0.5, -0.5))
    rng = np.random.default_rng(0)
    truth = np.array(pose) + np.column_stack([rng.uniform(-1.5, 1.5, (12, 2)), rng.uniform(-3, 3, 12)])
    angles = np.arange(60) / 60 * 2 * np.pi
    sensor = bm.BeamMixture(bm.Gaussian(0.05))
    scans = bm.simulate(walls, grid, truth, angles, sensor=sensor, max_range_m=30.0, seed=0)
    said = truth + rng.normal(0, [0.2, 0.2, 0.05], truth.shape)
    run = bm.infer(
        scans.at(said), grid, prior=prior, sensor=sensor, poses=UncertainPoses(0.2, 0.05),
        method=bm.Gibbs(start_poses=said[None]), schedule=bm.Schedule(chains=2, warmup=60, draws=30),
        hit_depth=0.0 if prior == bm.Beta() else 0.5,
    )  # fmt: skip
    found = run.pose_summary().mean

    # The whole map may lie elsewhere: what is compared is each pose in the frame of the others.
    def spread(poses):
        turned = poses - truth
        return np.abs(turned[:, :2] - turned[:, :2].mean(axis=0)).mean()

    assert spread(found) < 0.7 * spread(said)
