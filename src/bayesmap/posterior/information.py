"""Where to look next: how much one more scan from a pose is expected to tell about the map, in nats.

Two estimates. `expected_information` is the mutual information of a whole scan with the map, from joint draws: a scan
is simulated in a draw and weighed in all of them. `bayesmap.kernels.view.independent_information` is the formula of
FSMI for independent cells and beams, fast enough for thousands of poses, and too large where beams tell the same
twice.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from bayesmap.errors import BadInput
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans, as_angles, as_poses

Floats = NDArray[np.float64]

STREAM_VIEW = 5
SURE = 1e-4
"""Cells are taken to stop beams with a probability no nearer to 0 and 1 than this: what a finite number of draws can
say at most."""


@dataclass(frozen=True, eq=False)
class Information:
    """What one more scan is expected to tell.

    Attributes:
        nats: from each pose, (P,).
        standard_error: of these, (P,): from the finite number of draws and simulated scans.
        most: the logarithm of the number of draws: no estimate can be larger, and those near it are too small.
    """

    nats: Floats
    standard_error: Floats
    most: float


def expected_information(
    cells: NDArray[np.float32],
    grid: Grid,
    sensor: SensorModel,
    poses: ArrayLike,
    angles_rad: ArrayLike,
    *,
    max_range_m: float,
    min_range_m: float = 0.0,
    hit_depth: float = 0.5,
    seed: int = 0,
    device: str = "cpu",
) -> Information:
    """Mutual information of the map and one more scan from each pose, from joint draws of the map.

    In draw d a scan z_d is simulated; the estimate is the mean over d of

        log p(z_d | map d) - log (1 / D) sum_e p(z_d | map e)

    over all D draws e, d included: the nested estimator with its inner sample reused. It is exact as the draws become
    many, never over log D, and on average too small by about half the variance of the inner mean.

    Args:
        cells: D draws of the map, (D, N) stop probabilities or (D, N, 6) surfaces, as
            `bayesmap.cells.kind.CellPrior.stops`.
        grid: of the map.
        sensor: the law of a reading given where its beam stops.
        poses: P poses in the world frame, (P, 3).
        angles_rad: of the beams in the sensor's frame, (A,).
        max_range_m: of the sensor.
        min_range_m: likewise.
        hit_depth: where a beam stops in a cell without a surface, as a part of its chord.
        seed: of the simulated scans.
        device: where to compute.

    Raises:
        BadInput: poses or angles that are none, or fewer than two draws.
    """
    from bayesmap.kernels.random import mix
    from bayesmap.kernels.scan_likelihood import ScanLikelihood
    from bayesmap.kernels.view import drawn_stops
    from bayesmap.sensors.model import RangeLimits

    where, angles, draws = as_poses(poses), as_angles(angles_rad), len(cells)
    if draws < 2:
        raise BadInput(f"information: {draws} draws of the map; two are the least that can differ")
    limits = RangeLimits(min_range_m, max_range_m)
    nats, errors = np.empty(len(where)), np.empty(len(where))
    every = np.arange(draws)
    for i, pose in enumerate(where):
        at = np.broadcast_to(pose, (draws, 3))
        key = mix(seed, i, STREAM_VIEW)
        distance_m, spread_m = drawn_stops(cells, grid, at, every, angles, max_range_m, hit_depth, key, device)
        rng = np.random.default_rng([seed, i, STREAM_VIEW])
        met = np.isfinite(distance_m)
        distance_m[met] += spread_m[met] * rng.standard_normal(met.sum())
        readings = sensor.sample(rng, np.maximum(distance_m, 0.0), limits)
        scans = Scans(at, angles, readings, max_range_m, min_range_m)
        likelihood = ScanLikelihood(scans, grid, sensor, hit_depth, device)
        scan, chain = (a.ravel() for a in np.meshgrid(every, every, indexing="ij"))
        weighed = likelihood(cells, np.broadcast_to(pose, (len(scan), 3)), scan, chain).reshape(draws, draws)
        gains = weighed[every, every] - (special.logsumexp(weighed, axis=1) - math.log(draws))
        nats[i], errors[i] = gains.mean(), gains.std(ddof=1) / math.sqrt(draws)
    return Information(nats, errors, math.log(draws))


def beam_information(
    occupied: Floats,
    grid: Grid,
    poses: ArrayLike,
    angles_rad: ArrayLike,
    *,
    max_range_m: float,
    sigma_m: float,
    p_right: float = 0.9,
    device: str = "cpu",
) -> Floats:
    """FSMI: the sum over a scan's beams of their information about a map of independent cells, in nats, (P,).

    Args:
        occupied: probability that each cell stops a beam, (nx, ny).
        grid: of the map.
        poses: (P, 3).
        angles_rad: (A,).
        max_range_m: of the sensor.
        sigma_m: of the readings.
        p_right: how sure a reading makes of a cell: it multiplies the odds of the cell in which it falls by
            p / (1 - p), and those of the cells before it by (1 - p) / p.
        device: where to compute.
    """
    from bayesmap.kernels.view import independent_information

    probability = np.clip(np.nan_to_num(occupied.ravel(), nan=0.5), SURE, 1.0 - SURE)
    factor = p_right / (1.0 - p_right)
    per_beam = independent_information(
        probability, grid, as_poses(poses), as_angles(angles_rad), max_range_m,
        sigma_m=sigma_m, hit_factor=factor, pass_factor=1.0 / factor, device=device,
    )  # fmt: skip
    return np.asarray(per_beam.sum(axis=1))


def best_views(nats: Floats, poses: Floats, count: int, apart_m: float) -> NDArray[np.intp]:
    """The most telling poses that are not close to each other, the best first: numbers of poses, at most ``count``."""
    taken: list[int] = []
    for i in np.argsort(-nats, kind="stable"):
        if all(math.hypot(*(poses[i, :2] - poses[j, :2])) >= apart_m for j in taken):
            taken.append(int(i))
        if len(taken) == count:
            break
    return np.array(taken, dtype=np.intp)
