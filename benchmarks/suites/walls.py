"""Maps of a simulated building against its walls: what is reported, beside the owner's reflectivity and hit counts."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

import bayesmap as bm
from bayesmap.kernels.rays import count_hits, trace_rays
from bayesmap.posterior.baselines import BASELINES, fit_baseline
from bayesmap.posterior.posterior import Posterior
from bayesmap.posterior.scores import score_prediction
from bayesmap.posterior.summary import diagnose_cells
from bayesmap.sim.building import Building, building
from bayesmap.sim.robot import patrol
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans
from benchmarks.figure import Figure

Floats = NDArray[np.float64]

WORLD_M, RESOLUTION_M, MAX_RANGE_M, EVERY = 0.05, 0.1, 20.0, 10
NOISE = bm.Gaussian(0.01)
BEAMS = 240
SCANS = {3: 150, 4: 150}
FEW_SCANS = 40
"""Of which nine in ten are mapped."""

POINTS = 20
"""Along an edge of a cell at which it is asked whether something solid is there."""

WALL = 0.5
SEEN = 3
"""Beams that have to end in a cell for its wall to count as seen."""

APART = 0.5
BINS = np.array([0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1.01])


@dataclass(frozen=True, eq=False)
class Truth:
    """A building, the scans that are mapped, and beams that are not, without noise."""

    building: Building
    train: Scans
    heldout: Scans
    exact: Scans

    def solid(self, grid: Grid) -> NDArray[np.bool_]:
        """Whether something solid is at each of `POINTS` x `POINTS` points of every cell."""
        there = self.building.grid
        at = [
            np.floor((origin + (np.arange(n * POINTS) + 0.5) / POINTS * grid.resolution - o) / there.resolution)
            for n, origin, o in zip(grid.shape, grid.origin, there.origin, strict=True)
        ]
        inside = [(i >= 0) & (i < n) for i, n in zip(at, there.shape, strict=True)]
        out = np.zeros((len(at[0]), len(at[1])), dtype=np.bool_)
        rows, columns = (i[some].astype(int) for i, some in zip(at, inside, strict=True))
        out[np.ix_(*inside)] = self.building.walls[np.ix_(rows, columns)]
        return out


def simulated(seed: int, scans: int) -> Truth:
    """A building and a robot's round through it, as `bayesmap simulate --world building` makes them."""
    world = building(seed, resolution=WORLD_M)
    poses, angles = patrol(world, scans, seed), np.arange(BEAMS) * 2 * np.pi / BEAMS
    asked = {"max_range_m": MAX_RANGE_M, "opacity": world.opacity, "typed": True}
    train, heldout = bm.simulate(world.walls, world.grid, poses, angles, sensor=NOISE, seed=seed, **asked).holdout(
        EVERY
    )
    exact = bm.simulate(world.walls, world.grid, heldout.poses, angles, sensor=bm.Gaussian(1e-6), seed=seed, **asked)
    return Truth(world, train, heldout, exact)


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """Two buildings of 30 x 20 m at 10 cm, defaults; and one from few scans."""
    del with_peers
    for seed, scans in SCANS.items():
        truth = simulated(seed, scans)
        grid = Grid.covering(truth.train, RESOLUTION_M)
        found = bm.infer(truth.train, grid, prior=bm.Surface(), sensor="fit", where=bm.Where(device=device))
        posterior, name = found.posterior, f"walls/building_{seed}"
        yield from agreement(name, posterior)
        hits, passes = (counts.reshape(grid.shape).astype(float) for counts in count_hits(truth.train, grid))
        owners = posterior.draws.to_grid(
            posterior.draws.arrays["expected"].mean(axis=(0, 1), dtype=float), "cell", posterior.prior.mean_stop(grid)
        )
        maps = {"": found.occupancy, "_owner": owners, "_hit_ratio": (hits + 0.1) / (hits + passes + 0.6)}
        for which, stop in maps.items():
            yield from against_walls(f"{name}/%s{which}", stop, found.observed, grid, truth)
    yield few_scans(device)


def agreement(name: str, posterior: Posterior) -> Iterator[Figure]:
    """Do the chains agree about what is reported?"""
    found = diagnose_cells(posterior.prior, posterior.draws, posterior.observed)
    summary = bm.Run(posterior).summary()
    likelihood = f"of the log likelihood {summary.rhat_log_likelihood:.3f}"
    yield Figure(f"{name}/rhat_log_joint", summary.rhat_log_joint, "", against=likelihood)
    judged = max(found.judged_cells, 1)
    yield Figure(
        f"{name}/rhat_high",
        100 * found.rhat_high_cells / judged,
        "%",
        against=f"of {judged}; worst {found.rhat_max:.2f}",
    )
    yield Figure(f"{name}/ess_low", 100 * found.ess_low_cells / judged, "%", against=f"least {found.ess_min:.0f}")
    traces = posterior.prior.traces(posterior.draws, np.flatnonzero(posterior.observed.ravel())).astype(float)
    of_chain = traces.mean(axis=1)
    walls = of_chain.mean(axis=0) > 0.2
    apart = (np.ptp(of_chain[:, walls], axis=0) > APART).mean()
    yield Figure(
        f"{name}/chains_apart", 100 * float(apart), "%", against=f"of {walls.sum()} wall cells, by over {APART}"
    )


def against_walls(name: str, stop: Floats, observed: NDArray[np.bool_], grid: Grid, truth: Truth) -> Iterator[Figure]:
    """A map of stop probabilities beside what is there; ``name`` has a place for what is measured."""
    solid = truth.solid(grid)
    blocks = (grid.shape[0], POINTS, grid.shape[1], POINTS)
    said = (stop > WALL) & observed
    holds = solid.reshape(blocks).any(axis=(1, 3))
    count = f"of {said.sum()} cells over {WALL}"
    yield Figure(name % "not_solid", 100 * float((~holds[said]).mean()), "%", against=count)
    away = ndimage.distance_transform_edt(~solid) * grid.resolution / POINTS
    centre = away.reshape(blocks)[:, POINTS // 2, :, POINTS // 2]
    yield Figure(name % "distance", 1e3 * float(centre[said].mean()), "mm", against="centre to what is solid")

    rays = trace_rays(truth.exact, grid, device="cpu")
    enter, leave = rays.chords()
    reading = rays.range_m[rays.beam_of_entry()]
    comes = (enter < reading) & (leave > enter) & observed.ravel()[rays.cells]
    p, stops = stop.ravel()[rays.cells[comes]], leave[comes] >= reading[comes]
    ended = np.bincount(rays.cells[comes][stops], minlength=grid.n_cells).reshape(grid.shape)
    seen = ended >= SEEN
    yield Figure(name % "seen", 100 * float(said[seen].mean()), "%", "higher", against=f"of {seen.sum()} cells")
    place, off, total = np.digitize(p, BINS), 0.0, 0
    for i in range(1, len(BINS)):
        some = place == i
        off += abs(float(p[some].sum() - stops[some].sum()))
        total += int(some.sum())
    yield Figure(name % "unreliable", off / max(total, 1), "", against="mean |p - share of beams stopped|, p over 0.03")
    safe = np.clip(p, 1e-6, 1 - 1e-6)
    score = float(np.where(stops, np.log(safe), np.log1p(-safe)).mean())
    yield Figure(name % "log_score", 1e3 * score, "mnats/square", "higher", against="of stop or pass")


def few_scans(device: str) -> Figure:
    """From few scans: held-out beams of the rest of the round, above the tuned hit ratio."""
    truth = simulated(3, FEW_SCANS)
    grid = Grid.covering(truth.train, RESOLUTION_M)
    found = bm.infer(truth.train, grid, prior=bm.Surface(), sensor="fit", where=bm.Where(device=device))
    ours = bm.score(found, truth.heldout).nats_per_beam
    theirs = score_prediction(fit_baseline(BASELINES[0], truth.train, grid).predictor, truth.heldout).nats_per_beam
    return Figure(
        "walls/few_scans", ours - theirs, "nats/beam", "higher", against=f"{ours:.3f}; hit ratio {theirs:.3f}"
    )
