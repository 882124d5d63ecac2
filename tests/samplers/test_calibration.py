"""Simulation-based calibration over random 8 x 8 worlds, and the tutorial's map from three kinds of start.

Talts, Betancourt, Simpson, Vehtari and Gelman, *Validating Bayesian inference algorithms with simulation-based
calibration* (2018): draw a map from the prior and readings from the map; then the rank of any function of the true map
among the same function of posterior draws is uniform. 320 worlds for each method; chi-square over 16 bins of ranks.

False alarms: `ALPHA` = 1e-4 for all methods and functions together.
"""

import numpy as np
import pytest
import scipy
from flat_options import infer
from oracle.formula import beams, distances
from oracle.verdict import ALPHA

import bayesmap as bm
from bayesmap.kernels.walls.table import trace
from bayesmap.posterior.summary import rhat
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.sensors.model import RangeLimits

WORLDS, DRAWS, BINS = 320, 31, 16
GRID = bm.Grid((8, 8), 0.5)
PRIOR = bm.Independent(0.2)
LIMITS = RangeLimits(0.0, 6.0)
ANGLES = np.linspace(0, 2 * np.pi, 24, endpoint=False)
PROJECTION = np.random.default_rng(0).normal(size=64)

METHODS = {
    "gibbs": {"method": "gibbs", "order": "random", "start": "prior"},
    "block": {"method": "block", "order": "radial", "start": "prior"},
    "gibbs started by belief propagation": {"method": "gibbs", "order": "radial", "start": "propagate"},
}


def functions(maps, log_joints, log_likelihoods):
    """Scalars of maps, (functions, maps)."""
    flat = maps.reshape(len(maps), -1)
    corner = maps[:, :4, :4].sum(axis=(1, 2))
    return np.stack([flat.sum(axis=1), log_joints, log_likelihoods, corner, flat @ PROJECTION])


def rank_of_truth(number, true_sensor, sensor, options):
    """Ranks of the functions of a world's true map among those of draws, ties broken by a coin."""
    rng = np.random.default_rng([number, 2018])
    walls = PRIOR.sample(rng, GRID)
    poses = np.column_stack([rng.uniform(0, 4, (2, 2)), rng.uniform(-3, 3, 2)])
    metres = distances(walls, *beams(poses, ANGLES, GRID)) * GRID.resolution
    readings = true_sensor.sample(rng, metres, LIMITS).reshape(2, -1)
    scans = bm.Scans(poses, ANGLES, readings, max_range_m=LIMITS.max_m)
    run = infer(
        scans, GRID, prior=PRIOR, sensor=sensor, chains=1, warmup=100, draws=DRAWS, thin=15, seed=number, threads=1,
        **options,
    )  # fmt: skip
    problem = WallProblem(trace(scans, GRID, sensor), PRIOR, poses)
    worth = [np.array([value]) for value in (problem.log_joint(walls), problem.table.log_likelihood(walls))]
    drawn = functions(run.draws[0], run.log_joint[0], run.posterior.log_likelihood[0])
    true = functions(walls[None], *worth)
    equal = abs(drawn - true) < 1e-4  # the log joint is summed in single precision
    return ((drawn < true) & ~equal).sum(axis=1) + rng.integers(0, equal.sum(axis=1) + 1)


def p_values(true_sensor, sensor, options, worlds=WORLDS):
    ranks = np.stack([rank_of_truth(i, true_sensor, sensor, options) for i in range(worlds)])
    return np.array(
        [scipy.stats.chisquare(np.bincount(r * BINS // (DRAWS + 1), minlength=BINS)).pvalue for r in ranks.T]
    )


@pytest.mark.parametrize(("method", "sensor"), [
    pytest.param("gibbs", bm.Gaussian(0.4), marks=pytest.mark.full),
    pytest.param("block", bm.BeamMixture(bm.Gaussian(0.2)), marks=pytest.mark.full),
    ("gibbs started by belief propagation", bm.Gaussian(0.4)),
])  # fmt: skip
def test_the_truth_ranks_uniformly_among_posterior_draws(method, sensor):
    assert p_values(sensor, sensor, METHODS[method]).min() > ALPHA / (5 * len(METHODS))


def test_a_wrong_noise_level_is_rejected():
    wrong = p_values(bm.Gaussian(0.4), bm.Gaussian(0.5), METHODS["gibbs"])
    assert wrong.min() < ALPHA / (5 * len(METHODS))


def test_all_starts_agree_on_the_tutorial_s_map_where_walls_are_rare():
    """Prior 0.05, 2 x 2 blocks, six chains from zeros, ones and prior draws: R-hat of the log joint below 1.01."""
    walls, pose = bm.worlds.tutorial()
    grid, angles = bm.worlds.TUTORIAL_GRID, np.arange(100) / 100 * 2 * np.pi
    scans = bm.simulate(walls, grid, pose, angles, sensor=bm.Gaussian(0.2), max_range_m=42.0, seed=1)
    prior = bm.Independent(0.05)
    runs = [
        infer(
            scans, grid, prior=prior, sensor=bm.Gaussian(0.2), method="block", order="radial", chains=2, warmup=1000,
            draws=1000, start=start, seed=seed,
        )
        for seed, start in enumerate(["zeros", "ones", "prior"])
    ]  # fmt: skip
    assert rhat(np.concatenate([run.log_joint for run in runs])) < 1.01
    means = np.stack([run.occupancy for run in runs])
    assert abs(means[0] - means[1]).max() < 0.1
    assert abs(means[0] - means[2]).max() < 0.1
