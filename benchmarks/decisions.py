"""How far decisions can be trusted, and how fast they are made: `python -m benchmarks.decisions`.

Short paths are laid across what a scan that was held out sees. The scan shows a path blocked where one of its beams
ends on what the robot would sweep, and free where all pass; it says nothing where a beam ends before. Of the
paths that a run holds for free with probability p, a share of p should be shown free. In simulated buildings the true
walls judge the same paths as well. Prints tables; nothing is asserted.
"""

import argparse
import itertools
import os
import time
from pathlib import Path

import numpy as np

import bayesmap as bm
from bayesmap.posterior.decisions import beam_information, next_views, typical_sigma_m
from bayesmap.posterior.route import centres_world, distance_to_path_m, square_to_path_m

LOG = Path(os.environ.get("BAYESMAP_DATA", "../shared/data")) / "intel-corrected.log.gz"
LENGTH_M, RADIUS_M, FARTHEST_M, EDGE_M = 0.5, 0.25, 8.0, 0.02
EDGES = np.array([0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 0.99, 1.0 + 1e-9])


def path_before(pose, angles, rng):
    """A straight path somewhere in a sensor's field of view, and whether all that a disc sweeps lies within it."""
    away, bearing = rng.uniform(0.8, FARTHEST_M), rng.uniform(angles.min(), angles.max())
    middle = pose[:2] + away * np.array([np.cos(pose[2] + bearing), np.sin(pose[2] + bearing)])
    turn = rng.uniform(0, np.pi)
    half = 0.5 * LENGTH_M * np.array([np.cos(turn), np.sin(turn)])
    margin = np.arcsin(min(1.0, (RADIUS_M + 0.5 * LENGTH_M) / away))
    return np.array([middle - half, middle + half]), angles.min() + margin < bearing < angles.max() - margin


def shown(pose, angles, ranges, path):
    """What a scan shows of a path: True free, False blocked, None nothing."""
    t = np.arange(0.0, FARTHEST_M + 1.5, EDGE_M)
    direction = np.stack([np.cos(pose[2] + angles), np.sin(pose[2] + angles)], axis=-1)
    within = distance_to_path_m(pose[:2] + t[None, :, None] * direction[:, None], path) < RADIUS_M
    crossing = within.any(axis=1)
    if crossing.sum() < 3 or within[:, 0].any() or np.isnan(ranges[crossing]).any():
        return None
    enter = t[within.argmax(axis=1)]
    if (ranges[crossing] < enter[crossing] - EDGE_M).any():
        return None
    hits = np.isfinite(ranges) & crossing
    ends = pose[:2] + ranges[hits, None] * direction[hits]
    return bool((distance_to_path_m(ends, path) >= RADIUS_M).all())


def judged(run, scans, each, seed, truth=None):
    """Probability by joint draws, by independent cells, and outcome, of paths before each scan, (n, 3) or (n, 4)."""
    rng, rows = np.random.default_rng(seed), []
    x0, x1, y0, y1 = run.grid.extent_m
    for pose, ranges in zip(scans.poses, scans.ranges_m, strict=True):
        for _ in range(each):
            path, whole = path_before(pose, scans.angles_rad, rng)
            inside = (path > [x0, y0]).all() and (path < [x1, y1]).all()
            outcome = shown(pose, scans.angles_rad, ranges, path) if whole and inside else None
            if outcome is not None:
                found = run.free_probability(path, RADIUS_M)
                rows.append([found.probability, found.independent, outcome])
                if truth is not None:
                    rows[-1].append(is_free(truth, path))
    return np.array(rows, dtype=float)


def is_free(building, path):
    """Whether no wall of a building comes within the radius of a path."""
    walls = np.flatnonzero(building.walls.ravel())
    centres = centres_world(walls, building.grid)
    near = np.abs(centres - path.mean(axis=0)).max(axis=1) < LENGTH_M + RADIUS_M + 1.0
    return bool((square_to_path_m(centres[near], building.grid.resolution, path) >= RADIUS_M).all())


def tell(name, said, outcome):
    print(f"\n{name}: {len(said)} paths, {outcome.mean():.3f} free", flush=True)
    score = np.clip(said, 0.0025, 0.9975)  # a share of 200 draws says no more
    loss = -(outcome * np.log(score) + (1 - outcome) * np.log(1 - score)).mean()
    print(f"Brier score {((said - outcome) ** 2).mean():.4f}, log loss {loss:.4f}")
    print(f"{'said':>15} {'paths':>7} {'mean said':>10} {'were free':>10}")
    for low, high in itertools.pairwise(EDGES):
        chosen = (said >= low) & (said < high)
        if chosen.any():
            share = outcome[chosen].mean()
            error = np.sqrt(max(share * (1 - share), 0.25 / chosen.sum()) / chosen.sum())
            row = f"{low:6.2f} to {min(high, 1):4.2f}  {chosen.sum():7d} {said[chosen].mean():10.3f}"
            print(f"{row} {share:10.3f} +- {error:.3f}", flush=True)


def intel(each, saved):
    if not LOG.exists():
        print(f"skipped: {LOG} is not there (set BAYESMAP_DATA)")
        return
    training, held = bm.read_log(LOG).limited(20.0).holdout(10)
    if saved is None:
        run = bm.infer(training, bm.Grid.covering(training, 0.1), prior=bm.Surface(), sensor="fit")
    else:
        run = bm.load(saved)
    speed(run)
    rows = judged(run, held, each, 0)
    tell("Intel, held-out scans, joint draws", rows[:, 0], rows[:, 2])
    tell("Intel, held-out scans, independent cells", rows[:, 1], rows[:, 2])


def speed(run):
    """The fast formula over 1000 poses of 180 beams, and the bounds from joint draws."""
    posterior, scans = run.posterior, run.posterior.scans
    rng = np.random.default_rng(0)
    poses = scans.poses[rng.integers(0, len(scans), 1000)]
    sigma_m = typical_sigma_m(posterior.sensor, scans.max_range_m)
    seconds = []
    for _ in range(6):
        began = time.perf_counter()
        beam_information(
            posterior.occupancy, run.grid, poses, scans.angles_rad, max_range_m=scans.max_range_m, sigma_m=sigma_m
        )
        seconds.append(time.perf_counter() - began)
    print(
        f"independent cells, 1000 poses x {len(scans.angles_rad)} beams: {min(seconds[1:]):.2f} s (asked: 2 s)",
        flush=True,
    )
    began = time.perf_counter()
    told = run.information_gain(poses[:10])
    print(f"bounds from joint draws, {told.draws} draws: {(time.perf_counter() - began) / 10:.2f} s a pose", flush=True)
    began = time.perf_counter()
    next_views(posterior, 200, 5, RADIUS_M)
    print(f"explore, 200 candidates, 5 views: {time.perf_counter() - began:.1f} s", flush=True)


def buildings(each, seeds):
    from bayesmap.sim.building import building
    from bayesmap.sim.robot import patrol

    rows = []
    angles = np.radians(np.arange(-90, 90))
    sensor = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01)
    for seed in seeds:
        made = building(seed, (20.0, 14.0), 0.05)
        first, later = (
            bm.simulate(
                made.walls, made.grid, patrol(made, 80, seed + k), angles, sensor=sensor, max_range_m=12.0,
                seed=seed + k, opacity=made.opacity, typed=True,
            )
            for k in (0, 100)
        )  # fmt: skip
        run = bm.infer(first, bm.Grid.covering(first, 0.1), prior=bm.Surface(), sensor="fit", seed=seed)
        rows.append(judged(run, later, each, seed, made))
        print(f"building {seed}: {len(rows[-1])} paths", flush=True)
    rows = np.concatenate(rows)
    tell("simulated buildings, later scans, joint draws", rows[:, 0], rows[:, 2])
    tell("simulated buildings, later scans, independent cells", rows[:, 1], rows[:, 2])
    tell("simulated buildings, true walls, joint draws", rows[:, 0], rows[:, 3])
    tell("simulated buildings, true walls, independent cells", rows[:, 1], rows[:, 3])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--each", type=int, default=40, help="paths laid before each held-out scan")
    parser.add_argument("--intel-run", help="a saved run of the Intel log with --holdout 10, instead of a new one")
    parser.add_argument("--buildings", type=int, nargs="*", default=[3, 4, 5, 6], help="seeds of simulated buildings")
    given = parser.parse_args()
    intel(given.each, given.intel_run)
    if given.buildings:
        buildings(given.each, given.buildings)


if __name__ == "__main__":
    main()
