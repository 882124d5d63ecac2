"""Map and poses together: exact by simulation-based calibration, the same bits however chains are run.

Steps of poses leave the posterior of the poses given the cells as it is, against enumeration on a lattice of poses.
Simulation-based calibration (Talts, Betancourt, Simpson, Vehtari and Gelman, 2018): a map, poses and readings are drawn
from the model; then the rank of what is true among draws of its posterior is uniform. False alarms: `ALPHA` = 1e-4 for
each of both.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
import scipy
from oracle.enumeration import beams, distances
from oracle.stop_law import gaussian
from oracle.verdict import ALPHA, goodness_of_fit
from tiers import latin

import bayesmap as bm
from bayesmap.kernels.predict.density import ScanLikelihood
from bayesmap.model import Model
from bayesmap.run.chains import SweepPlan
from bayesmap.run.runner import Job, run_chains
from bayesmap.samplers.sampler import Keep
from bayesmap.samplers.walls import WallGibbs
from bayesmap.samplers.with_poses import PoseMetropolis, PoseState, WithPoses, proposal_factors
from bayesmap.sensors.model import RangeLimits

GRID = bm.Grid((8, 8), 0.5, (0.0, 0.0))
LIMITS = RangeLimits(0.1, 5.0)
ANGLES = np.linspace(0, 2 * np.pi, 9, endpoint=False)
SENSOR = bm.Gaussian(0.25)
PRIORS = {"uncertain": bm.UncertainPoses(0.15, 0.2), "odometry": bm.Odometry(0.2, 0.1, 0.2, 0.2, 0.05, 0.08)}


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
    for number in np.ndindex(2, 6):
        state = model.state({"walls": chains.draws.values("walls")[number]})
        state = replace(state, poses=chains.draws.values("poses")[number])
        assert chains.log_joint[number] == pytest.approx(model.log_joint(state), abs=1e-3)


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
        scans.at(said), grid, prior=prior, sensor=sensor, poses=bm.UncertainPoses(0.2, 0.05),
        method=bm.Gibbs(start_poses=said[None]), schedule=bm.Schedule(chains=2, warmup=60, draws=30),
        hit_depth=0.0 if prior == bm.Beta() else 0.5,
    )  # fmt: skip
    found = run.pose_summary().mean

    # The whole map may lie elsewhere: what is compared is each pose in the frame of the others.
    def spread(poses):
        turned = poses - truth
        return np.abs(turned[:, :2] - turned[:, :2].mean(axis=0)).mean()

    assert spread(found) < 0.7 * spread(said)


SMALL_GRID = bm.Grid((4, 4), 0.5, (-1.0, 2.0))
BLUNT = bm.Gaussian(0.6)
RANGE_LIMITS = (0.1, 3.0)
STEP = np.array([0.25, 0.25, np.pi / 6])
OFFSETS = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)  # 27 poses a scan
WIDE_PRIORS = {"uncertain": bm.UncertainPoses(0.3, 0.5), "odometry": bm.Odometry(0.2, 0.1, 0.2, 0.3, 0.1, 0.2)}
TESTS = 2 * 3 * 2  # priors, seeds, betas


@dataclass(frozen=True, eq=False)
class LatticeSteps(PoseMetropolis):
    """The sampler with another symmetric proposal: to one of the 27 poses of a lattice, whichever it is at."""

    centre: np.ndarray = None

    def _random(self, state, step):
        rng = np.random.default_rng([state.seed, step])
        shape = state.poses.shape[:2]
        aim = self.centre + OFFSETS[rng.integers(len(OFFSETS), size=shape)] * STEP
        return aim - state.poses, np.log(rng.random(shape))  # the factor is the identity


def scene(seed, prior):
    rng = np.random.default_rng(seed)
    walls = rng.random(SMALL_GRID.shape) < 0.3
    poses = np.column_stack([rng.uniform(-0.5, 0.5, 3), rng.uniform(2.5, 3.5, 3), rng.uniform(-3, 3, 3)])
    angles = np.linspace(0, 2 * np.pi, 5, endpoint=False)
    met = np.minimum(exact_distances(walls, poses, angles), RANGE_LIMITS[1])
    readings = met + BLUNT.sigma_m * rng.standard_normal((3, 5))
    scans = bm.Scans(poses, angles, readings, max_range_m=RANGE_LIMITS[1], min_range_m=RANGE_LIMITS[0])
    return walls, scans, prior.law(poses)


def exact_distances(walls, poses, angles):
    starts, directions = beams(poses, angles, SMALL_GRID)
    return (distances(walls, starts, directions) * SMALL_GRID.resolution).reshape(len(poses), -1)


def log_likelihood(walls, scans, pose, scan):
    """Log-likelihood of one scan at a pose, from the oracle's distances and densities."""
    d = np.minimum(exact_distances(walls, pose[None], scans.angles_rad)[0], RANGE_LIMITS[1])
    return float(sum(gaussian(z, np.array([x]), sigma=BLUNT.sigma_m, per_m=0.0, max_m=RANGE_LIMITS[1])[0]
                     for z, x in zip(scans.ranges_m[scan], d, strict=True)))  # fmt: skip


def exact_marginals(walls, scans, law, beta):
    """Probability of each lattice pose of scan 1 and of scan 2, jointly, scan 0 at the middle: (27, 27)."""
    centre, n = scans.poses, len(OFFSETS)
    alone = np.array([
        [log_likelihood(walls, scans, centre[s] + o * STEP, s) for o in OFFSETS] for s in (1, 2)
    ])  # fmt: skip
    poses = np.broadcast_to(centre, (n, n, 3, 3)).copy()
    poses[:, :, 1] += (OFFSETS * STEP)[:, None]
    poses[:, :, 2] += (OFFSETS * STEP)[None, :]
    log_p = beta * (alone[0][:, None] + alone[1][None, :]) + law.log_prob(poses)
    p = np.exp(log_p - log_p.max())
    return p / p.sum()


def lattice_draws(p, rng, count, centre):
    """Poses of ``count`` chains from a law over the lattice poses of scans 1 and 2."""
    number = rng.choice(p.size, size=count, p=p.ravel())
    poses = np.broadcast_to(centre, (count, 3, 3)).copy()
    poses[:, 1] += OFFSETS[number // len(OFFSETS)] * STEP
    poses[:, 2] += OFFSETS[number % len(OFFSETS)] * STEP
    return poses


@pytest.mark.parametrize(("name", "seed", "beta"), latin(4, list(WIDE_PRIORS), [0, 1, 2], [1.0, 0.4]))
def test_poses_drawn_by_enumeration_still_follow_it_after_many_steps(name, seed, beta, monkeypatch):
    walls, scans, law = scene(seed, WIDE_PRIORS[name])
    groups, chains = tuple(g[g > 0] for g in law.independent_groups()), 3000  # the first scan stays
    monkeypatch.setattr(type(law), "independent_groups", lambda self: groups)
    centre = np.broadcast_to(scans.poses, (chains, 3, 3))
    likelihood, factor = ScanLikelihood(scans, SMALL_GRID, BLUNT, 0.0), np.broadcast_to(np.eye(3), (3, 3, 3))
    sampler = LatticeSteps(likelihood, law, factor, centre=centre)
    cells = np.broadcast_to(walls.reshape(1, -1).astype(np.float32), (chains, SMALL_GRID.n_cells))
    exact = exact_marginals(walls, scans, law, beta)
    start = lattice_draws(exact, np.random.default_rng(seed), chains, scans.poses)

    def fit_after(at):
        state = PoseState(start, np.zeros((chains, 3)), np.arange(chains), seed)
        moved = 0.0
        for _ in range(25):  # one by one: each looks anew where the poses are
            state, accepted = sampler.step(state, cells, 1, beta=at)
            moved += accepted.mean()
        place = np.rint((state.poses - centre)[:, 1:] / STEP).astype(int) + 1
        number = place @ np.array([9, 3, 1]) @ [27, 1]
        return goodness_of_fit(np.bincount(number, minlength=exact.size), exact.ravel()), moved

    fit, moved = fit_after(beta)
    assert fit > ALPHA / TESTS
    assert moved > 0.5  # with scan 0 at rest, two poses in three move: each some times
    assert fit_after(0.3 * beta)[0] < ALPHA / TESTS  # the wrong twin


def test_warm_up_brings_the_acceptance_to_where_it_is_wanted():
    walls, scans, law = scene(4, bm.UncertainPoses(0.1, 0.1))
    likelihood, cells = ScanLikelihood(scans, SMALL_GRID, BLUNT, 0.0), walls.reshape(1, -1).astype(np.float32)
    sampler = PoseMetropolis(likelihood, law, 50 * proposal_factors(likelihood, cells, scans.poses, law, 0.1))
    many = 200
    state = PoseState(np.broadcast_to(scans.poses, (many, 3, 3)), np.zeros((many, 3)), np.arange(many), 0)
    cells = np.repeat(cells, many, axis=0)
    for step in range(200):
        state, _ = sampler.step(state, cells, adaptation_rate=(step + 1.0) ** -0.6)
    _, accepted = sampler.step(state, cells, 50)
    assert 0.25 < accepted.mean() < 0.45
