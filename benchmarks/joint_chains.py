"""What is exact about chains over map and poses: against enumeration in small worlds, and along a loop.

`python -m benchmarks.joint_chains [worlds] [loop]` prints the two tables of docs/lab/poses.md.

In a small world every map is enumerated, and the poses are summed over by quasi-random draws of their prior: scans are
independent given the map, so

    p(map | readings) ~ p(map) prod_scans  integral p(pose) p(readings | map, pose) d pose

In the loop the chains start from different draws of the approximation. How far their means of a relative pose lie
apart, by the spread within a chain, says whether they forget where they started.
"""

import sys
from dataclasses import dataclass
from itertools import product

import numpy as np
import scipy
from numpy.typing import NDArray

import bayesmap as bm
from bayesmap.kernels.predict.density import ScanLikelihood
from bayesmap.poses.prior import UncertainPoses
from bayesmap.posterior.summary import rhat
from bayesmap.sim.building import building
from bayesmap.sim.robot import patrol
from bayesmap.space.planar import between, wrap_angle

Floats = NDArray[np.float64]

GRID = bm.Grid((3, 3), 0.5, (0.0, 0.0))
P_WALL, MAX_RANGE_M = 0.3, 3.0
NOISES_M = (0.25, 0.1)
"""Standard deviations of the readings: wide, and narrow beside cells of half a metre."""
PRIOR = UncertainPoses(0.15, 0.2)
ANGLES = np.linspace(0, 2 * np.pi, 9, endpoint=False)
SCANS, POINTS = 3, 2048
WORLDS = range(2)
MAPS = np.array([[k >> i & 1 for i in range(9)] for k in range(512)], dtype=np.float32)


@dataclass(frozen=True, eq=False)
class Posterior:
    """Of a small world.

    Attributes:
        walls: probability of each cell, (9,).
        mean: of the poses, less the stated ones, (S, 3).
        sigma: standard deviations of these, (S, 3).
    """

    walls: Floats
    mean: Floats
    sigma: Floats


def world(seed: int, sensor: bm.SensorModel) -> bm.Scans:
    """Scans of a random map, from poses that the log states wrongly; where the sensor truly stands there is no wall."""
    rng = np.random.default_rng(seed)
    walls = rng.random(GRID.shape) < P_WALL
    said = np.column_stack([rng.uniform(0.2, 1.3, (SCANS, 2)), rng.uniform(-3, 3, SCANS)])
    truth = PRIOR.law(said).sample(rng)
    stands = np.floor(GRID.to_cells(truth[:, :2])).astype(int).clip(0, 2)
    walls[stands[:, 0], stands[:, 1]] = False
    made = bm.simulate(walls, GRID, truth, ANGLES, sensor=sensor, max_range_m=MAX_RANGE_M, seed=seed)
    return made.at(said)


def enumerated(scans: bm.Scans, sensor: bm.SensorModel) -> Posterior:
    """By all maps and many poses."""
    off = scipy.stats.norm.ppf(scipy.stats.qmc.Sobol(3, seed=1).random(POINTS)) * [
        PRIOR.sigma_m,
        PRIOR.sigma_m,
        PRIOR.sigma_rad,
    ]
    likelihood = ScanLikelihood(scans, GRID, sensor, 0.0)
    of_maps = MAPS.sum(axis=1) * np.log(P_WALL / (1 - P_WALL))
    means, squares = np.empty((SCANS, len(MAPS), 3)), np.empty((SCANS, len(MAPS), 3))
    for scan in range(SCANS):
        for k in range(len(MAPS)):
            poses, zero = scans.poses[scan] + off, np.zeros(POINTS, int)
            logs = likelihood(MAPS[k : k + 1], poses, zero + scan, zero)
            top = logs.max()
            weights = np.exp(logs - top)
            of_maps[k] += top + np.log(weights.mean())
            weights /= weights.sum()
            means[scan, k], squares[scan, k] = weights @ off, weights @ off**2
    p = np.exp(of_maps - of_maps.max())
    p /= p.sum()
    mean = np.einsum("k,ski->si", p, means)
    return Posterior(p @ MAPS, mean, np.sqrt(np.einsum("k,ski->si", p, squares) - mean**2))


def sampled(scans: bm.Scans, sensor: bm.SensorModel, seed: int) -> tuple[Posterior, float]:
    """By four chains, and the largest R-hat of a pose."""
    run = bm.infer(
        scans,
        GRID,
        prior=bm.Independent(P_WALL),
        sensor=sensor,
        poses=PRIOR,
        schedule=bm.Schedule(chains=4, warmup=500, draws=2000, thin=2),
        seed=seed,
        hit_depth=0.0,
    )
    off = run.poses - scans.poses
    off[..., 2] = wrap_angle(off[..., 2])
    worst = max(float(rhat(off[:, :, s, i])) for s in range(SCANS) for i in range(3))
    return Posterior(run.occupancy.ravel(), off.mean(axis=(0, 1)), off.std(axis=(0, 1))), worst


def small_worlds() -> None:
    """A row a world."""
    print("| noise | walls: largest difference | poses: means, by their deviation | their deviations | R-hat |")
    print("|---|---|---|---|---|")
    for sigma_m, seed in product(NOISES_M, WORLDS):
        sensor = bm.Gaussian(sigma_m)
        scans = world(seed, sensor)
        exact, (found, worst) = enumerated(scans, sensor), sampled(scans, sensor, seed)
        walls = np.abs(exact.walls - found.walls).max()
        means = np.abs((exact.mean - found.mean) / exact.sigma).max()
        ratio = found.sigma / exact.sigma
        print(
            f"| {sigma_m:g} m | {walls:.3f} | {means:.3f} | {ratio.min():.2f} to {ratio.max():.2f} | {worst:.2f} |",
            flush=True,
        )


def loop() -> None:
    """How far chains agree on relative poses, by how far apart the scans are."""
    made = building(3, (12.0, 8.0))
    truth = patrol(made, 110, 3)
    angles = np.radians(np.linspace(-90, 90, 91))
    seen = bm.simulate(made.walls, made.grid, truth, angles, sensor=bm.BeamMixture(bm.Gaussian(0.01)), max_range_m=12.0,
                       seed=1, typed=True)  # fmt: skip
    log = seen.at(bm.simulate_odometry(truth, bm.OdometryNoise(), seed=1))
    run = bm.slam(log, resolution=0.1, schedule=bm.Schedule(chains=4, warmup=30, draws=50), seed=1)
    found = run.trajectory
    assert found is not None
    poses, keys = run.poses, found.keys
    way_m = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(found.poses[keys, :2], axis=0).T))])
    print(f"{len(keys)} key scans, {way_m[-1]:.0f} m, {(found.closures.weights > 0.5).sum()} loop closures\n")
    print(
        "| scans along the way | pairs | deviation in a chain | between chains' means | approximation | R-hat, median |"
    )
    print("|---|---|---|---|---|---|")
    for name, low, high in (("neighbours", 0.0, 0.6), ("2 to 4 m", 2.0, 4.0), ("over 10 m", 10.0, np.inf)):
        first, second = np.nonzero((way_m - way_m[:, None] > low) & (way_m - way_m[:, None] <= high))
        some = np.random.default_rng(0).permutation(len(first))[:200]
        first, second = first[some], second[some]
        x = between(poses[:, :, first], poses[:, :, second])[..., :2]
        within = np.sqrt(x.var(axis=1).mean(axis=(0, 2)))
        apart = np.sqrt(x.mean(axis=1).var(axis=0, ddof=1).mean(axis=1))
        dof = found.gaussian.dof
        scale = dof / (dof - 2.0) * found.relative_scales(keys[first], keys[second])
        said = np.sqrt(0.5 * (scale[:, 0, 0] + scale[:, 1, 1]))
        worst = [max(float(rhat(x[:, :, k, i])) for i in range(2)) for k in range(len(first))]
        print(
            f"| {name} | {len(first)} | {1e3 * np.median(within):.1f} mm | {1e3 * np.median(apart):.1f} mm "
            f"| {1e3 * np.median(said):.1f} mm | {np.median(worst):.2f} |",
            flush=True,
        )


if __name__ == "__main__":
    for name, table in (("worlds", small_worlds), ("loop", loop)):
        if name in (sys.argv[1:] or ("worlds", "loop")):
            table()
