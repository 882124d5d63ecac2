"""The information about the map that one more scan from a pose is expected to give, in nats.

`expected_information` bounds the mutual information of a whole scan with the map from both sides, by joint draws: a
scan is simulated in a draw and weighted in all of them. `beam_information` is the formula of FSMI for independent cells
and beams. It is fast enough for thousands of poses. But it counts shared information of beams twice, and a cell that is
known to stop half of the beams counts as unknown.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from bayesmap.errors import BadInput
from bayesmap.posterior.prediction import Fan, draw_readings
from bayesmap.posterior.predictor import ignored
from bayesmap.samplers.sampler import STREAM_VIEWS
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans, as_angles, as_poses

Floats = NDArray[np.float64]

MIN_STOP_PROBABILITY = 1e-4
"""Least distance of a stop probability from 0 and 1: a finite number of draws is no more precise."""


@dataclass(frozen=True, eq=False)
class InformationGain:
    """Bounds on the expected information of one more scan from each of P poses.

    The information lies between two estimates, on average over draws. With many informative beams they lie apart, and
    more draws bring them closer.

    Attributes:
        at_least: lower bound for each pose, nats, (P,); no more than the logarithm of the number of draws of a chain.
        at_least_error: Monte Carlo standard error of the lower bound, (P,).
        at_most: upper bound for each pose, nats, (P,).
        at_most_error: Monte Carlo standard error of the upper bound, (P,).
        draws: number of draws of the map that were compared.
        independent: information by the formula for independent cells and beams, nats, (P,); None if not computed.
    """

    at_least: Floats
    at_least_error: Floats
    at_most: Floats
    at_most_error: Floats
    draws: int
    independent: Floats | None = None

    def __repr__(self) -> str:
        """Return two or three lines: size, and the bounds for the pose with the greatest upper bound."""
        title = f"InformationGain: {len(self.at_most):,} poses, {self.draws:,} draws of the map"
        if not len(self.at_most):
            return title
        best = int(np.argmax(self.at_most))
        low, high = (
            f"{value[best]:.2f} +- {error[best]:.2g}"
            for value, error in ((self.at_least, self.at_least_error), (self.at_most, self.at_most_error))
        )
        return f"{title}\n  greatest for pose {best}: at least {low} nats\n  at most {high} nats"


def expected_information(
    cells: NDArray[np.float32], grid: Grid, fan: Fan, poses: ArrayLike, *, hit_depth: float = 0.5, chains: int = 1,
    seed: int = 0, device: str = "cpu", on_progress: Callable[[float], None] = ignored,
) -> InformationGain:  # fmt: skip
    """Bound the mutual information of the map and one more scan from each pose, from joint draws of the map.

    In draw d a scan z_d is simulated. With its density p(z_d | e) in each of D draws e, the means over d of

        log p(z_d | d) - log (1 / D) sum_e p(z_d | e)                    all draws e, d among them
        log p(z_d | d) - log (1 / (D - 1)) sum_{e != d} p(z_d | e)       d left out

    are at most, and at least, the information, on average over draws (Foster et al., "A unified stochastic gradient
    approach to designing Bayesian-optimal experiments", AISTATS 2020). The first is never over log D. The second is far
    too large if every draw explains only its own scan. But beams are independent given the map. So a scan's information
    is at most the sum over its beams, each by the second line. The smaller of the two values is the upper bound.

    Draws are compared within each chain. Chains that have not mixed differ where the posterior does not, such as in
    which of two cells a wall stands, and a scan would tell nearly all of them apart.

    ``cells`` holds the draws of the map, equally many of each chain, chain by chain: (D, N) stop probabilities or
    (D, N, 6) surfaces, as `bayesmap.cells.kind.CellPrior.stops`. Poses are in the world frame, (P, 3).

    Raises `BadInput` for poses that are not valid, or fewer than two draws of a chain.
    """
    from bayesmap.kernels.predict.density import device_maps
    from bayesmap.kernels.predict.scan_likelihood import ScanLikelihood

    poses_world = as_poses(poses)
    n_draws = len(cells)
    draws_per_chain = n_draws // chains
    if draws_per_chain < 2:
        raise BadInput(
            f"information: {draws_per_chain} draws of the map from each chain; two are the least that can differ"
        )
    maps = device_maps([cells], grid, hit_depth, device=device)
    draw_index = np.arange(n_draws)
    # Pairs of draws of one chain.
    scan = np.repeat(draw_index, draws_per_chain)
    other = np.tile(draw_index.reshape(chains, 1, draws_per_chain), (1, draws_per_chain, 1)).ravel()
    bounds = np.empty((4, len(poses_world)))
    limits = fan.limits
    # For each pose, simulate a scan in every draw, and weight each scan in every draw of its chain.
    for i, pose in enumerate(poses_world):
        at = np.broadcast_to(pose, (n_draws, 3))
        readings = draw_readings(maps, fan, at, draw_index, (seed, i, STREAM_VIEWS))
        likelihood = ScanLikelihood(
            Scans(at, fan.angles_rad, readings, limits.max_m, limits.min_m), grid, fan.sensor, hit_depth, device
        )
        weighed = likelihood.beams(maps, np.broadcast_to(pose, (len(scan), 3)), scan, other)
        bounds[:, i] = _bounds(weighed.reshape(chains, draws_per_chain, draws_per_chain, -1))
        on_progress((i + 1) / len(poses_world))
    return InformationGain(bounds[0], bounds[1], bounds[2], bounds[3], n_draws)


def _bounds(weighed: Floats) -> tuple[float, float, float, float]:
    """Return the lower bound and its error, and the upper bound and its error.

    ``weighed`` is log p(beam b of the scan that was simulated in draw d | draw e of its chain c), (c, d, e, b).
    """
    chains, draws = weighed.shape[:2]
    draw_index = np.arange(draws)
    others = np.where(np.eye(draws, dtype=bool), -np.inf, 0.0)
    whole = weighed.sum(axis=3)
    own = whole[:, draw_index, draw_index]

    def left_out(log_p: Floats) -> Floats:
        hidden = log_p + others.reshape(draws, draws, *(1,) * (log_p.ndim - 3))
        return np.asarray(special.logsumexp(hidden, axis=2) - math.log(draws - 1))

    lower = own - (special.logsumexp(whole, axis=2) - math.log(draws))
    uppers = (own - left_out(whole), (weighed[:, draw_index, draw_index] - left_out(weighed)).sum(axis=2))
    upper = min(uppers, key=lambda gains: float(gains.mean()))
    root = math.sqrt(chains * draws)
    return (
        float(lower.mean()), float(lower.std(ddof=1)) / root, float(upper.mean()), float(upper.std(ddof=1)) / root,
    )  # fmt: skip


def beam_information(
    occupied: Floats, grid: Grid, poses: ArrayLike, angles_rad: ArrayLike, *, max_range_m: float, sigma_m: float,
    p_right: float = 0.9, device: str = "cpu",
) -> Floats:  # fmt: skip
    """Return the sum of FSMI over a scan's beams: their information about a map of independent cells, nats, (P,).

    ``occupied`` is the probability that each cell stops a beam, (nx, ny), and ``sigma_m`` the standard deviation of
    readings. A reading is right with probability p = ``p_right``: it multiplies the odds of the cell in which it falls
    by p / (1 - p), and those of the cells before it by (1 - p) / p.
    """
    from bayesmap.kernels.predict.view import independent_information

    probability = np.nan_to_num(occupied.ravel(), nan=0.5)
    probability = np.clip(probability, MIN_STOP_PROBABILITY, 1.0 - MIN_STOP_PROBABILITY)
    factor = p_right / (1.0 - p_right)
    per_beam = independent_information(
        probability, grid, as_poses(poses), as_angles(angles_rad), max_range_m,
        sigma_m=sigma_m, hit_factor=factor, pass_factor=1.0 / factor, device=device,
    )  # fmt: skip
    return np.asarray(per_beam.sum(axis=1))


def best_views(nats: Floats, poses: Floats, count: int, apart_m: float) -> NDArray[np.intp]:
    """Select the most informative poses that are not close to each other, best first: indices, at most ``count``."""
    best: list[int] = []
    for i in np.argsort(-nats, kind="stable"):
        if all(math.hypot(*(poses[i, :2] - poses[j, :2])) >= apart_m for j in best):
            best.append(int(i))
        if len(best) == count:
            break
    return np.array(best, dtype=np.intp)
