"""Decisions from a posterior: whether a path is free, which route to take, where to look next.

`bayesmap.posterior.route` has the algorithms for paths. `next_views` ranks poses by `beam_information`, the formula of
FSMI for independent cells and beams: fast, but it counts shared information of beams twice (docs/decisions.md). It
compares the best by `expected_information`, bounds of the information of a whole scan from joint draws.
"""

import math
from dataclasses import dataclass, fields, replace
from functools import partial
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from bayesmap.errors import BadInput
from bayesmap.posterior import route as routes
from bayesmap.posterior.posterior import Posterior
from bayesmap.posterior.prediction import Fan, OnShare, draw_readings, ignore_share, report_batches, split_progress
from bayesmap.samplers.sampler import Stream
from bayesmap.space.arrays import Floats, Indices, Singles
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans, as_angles, as_poses, as_user_poses

if TYPE_CHECKING:
    from bayesmap.cells.arrays import Draws
    from bayesmap.cells.kind import CellPrior
    from bayesmap.sensors.model import SensorModel

MIN_STOP_PROBABILITY = 1e-4  # least distance of stop probabilities from 0 and 1: draws are no more precise
SEARCH_DRAWS = 60  # draws that propose paths; all draws then judge each path
INFORMATION_PAIRS = 2500  # default number of compared pairs: 25 draws of each of four chains, or 50 independent draws
MIN_FREE = 0.5  # least probability that the disc touches nothing at the position of a view
HEADINGS = 8  # headings that are tried at each position
FULL_CIRCLE_RAD = np.radians(350.0)  # field of view from which one heading is enough
MIN_SEPARATION = 0.05  # least distance of two views, as a share of the map's diagonal
CANDIDATES_KEY = 6  # key of the random numbers of candidates, with the seed


@dataclass(frozen=True, eq=False)
class InformationGain:
    """Bounds on the expected information of one more scan from each of P poses.

    On average over draws, the information lies between the bounds. More draws bring them closer.

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
        low = f"{self.at_least[best]:.2f} +- {self.at_least_error[best]:.2g}"
        high = f"{self.at_most[best]:.2f} +- {self.at_most_error[best]:.2g}"
        return f"{title}\n  greatest for pose {best}: at least {low} nats\n  at most {high} nats"


@dataclass(frozen=True, eq=False)
class MapDraws:
    """D draws of the map, equally many of each chain, chain by chain."""

    cells: Singles  # stop probabilities (D, N), or surfaces (D, N, 6), as `CellPrior.stops`
    grid: Grid
    hit_depth: float = 0.5  # where in a cell without a surface a beam stops, as a fraction of its chord
    chains: int = 1


def expected_information(
    draws: MapDraws, fan: Fan, poses: ArrayLike, *, seed: int = 0, device: str = "cpu",
    on_progress: OnShare = ignore_share,
) -> InformationGain:  # fmt: skip
    """Bound the mutual information of the map and one more scan from each pose, from joint draws of the map.

    In draw d a scan z_d is simulated. With its density p(z_d | e) in each of D draws e, the means over d of

        log p(z_d | d) - log (1 / D) sum_e p(z_d | e)                    all draws e, d among them
        log p(z_d | d) - log (1 / (D - 1)) sum_{e != d} p(z_d | e)       d left out

    are at most, and at least, the information, on average over draws (Foster et al., "A unified stochastic gradient
    approach to designing Bayesian-optimal experiments", AISTATS 2020). The first is never over log D. The second is far
    too large if every draw explains only its own scan. But beams are independent given the map, so the sum over beams
    of the second line is an upper bound, too. The smaller of the two upper bounds is returned.

    Draws are compared within each chain: chains that have not mixed differ where the posterior does not. Poses are in
    the world frame, (P, 3). Raises `BadInput` for poses that are not valid, or fewer than two draws of a chain.
    """
    from bayesmap.kernels.predict.density import ScanLikelihood, device_maps

    poses_world = as_poses(poses)
    chains, n_draws = draws.chains, len(draws.cells)
    draws_per_chain = n_draws // chains
    if draws_per_chain < 2:
        raise BadInput(f"information: {draws_per_chain} draws of the map from each chain; two are the fewest")
    maps = device_maps([draws.cells], draws.grid, draws.hit_depth, device=device)
    draw_index = np.arange(n_draws)
    # All pairs of draws of one chain: the scan of the first is weighed in the second.
    scan = np.repeat(draw_index, draws_per_chain)
    other_draw = np.tile(draw_index.reshape(chains, 1, draws_per_chain), (1, draws_per_chain, 1)).ravel()
    bounds = np.empty((4, len(poses_world)))
    # For each pose, simulate a scan in every draw, and weigh each scan in every draw of its chain.
    for i, pose in enumerate(poses_world):
        poses_of_draws = np.broadcast_to(pose, (n_draws, 3))
        readings = draw_readings(maps, fan, poses_of_draws, draw_index, (seed, i, Stream.VIEWS))
        scans = Scans(poses_of_draws, fan.angles_rad, readings, fan.limits.max_m, fan.limits.min_m)
        likelihood = ScanLikelihood(scans, draws.grid, fan.sensor, draws.hit_depth, device)
        log_p = likelihood.beams(maps, np.broadcast_to(pose, (len(scan), 3)), scan, other_draw)
        bounds[:, i] = _bounds(log_p.reshape(chains, draws_per_chain, draws_per_chain, -1))
        on_progress((i + 1) / len(poses_world))
    at_least, at_least_error, at_most, at_most_error = bounds
    return InformationGain(at_least, at_least_error, at_most, at_most_error, n_draws)


def _bounds(beam_log_p: Floats) -> tuple[float, float, float, float]:
    """Return both bounds with their errors, given log p(beam b of draw d's scan | draw e of chain c), (C, D, D, B)."""
    n_chains, n_draws = beam_log_p.shape[:2]
    draw_index = np.arange(n_draws)
    without_own = np.where(np.eye(n_draws, dtype=bool), -np.inf, 0.0)
    scan_log_p = beam_log_p.sum(axis=3)
    own_log_p = scan_log_p[:, draw_index, draw_index]

    def log_mean_of_others(log_p: Floats) -> Floats:
        others = log_p + without_own.reshape(n_draws, n_draws, *(1,) * (log_p.ndim - 3))
        return np.asarray(special.logsumexp(others, axis=2) - math.log(n_draws - 1))

    lower = own_log_p - (special.logsumexp(scan_log_p, axis=2) - math.log(n_draws))
    by_scan = own_log_p - log_mean_of_others(scan_log_p)
    by_beam = (beam_log_p[:, draw_index, draw_index] - log_mean_of_others(beam_log_p)).sum(axis=2)
    upper = min((by_scan, by_beam), key=lambda gains: float(gains.mean()))
    root = math.sqrt(n_chains * n_draws)
    return lower.mean(), lower.std(ddof=1) / root, upper.mean(), upper.std(ddof=1) / root


def beam_information(
    occupied: Floats, grid: Grid, poses: ArrayLike, angles_rad: ArrayLike, *, max_range_m: float, sigma_m: float,
    p_right: float = 0.9, device: str = "cpu",
) -> Floats:  # fmt: skip
    """Return the sum of FSMI over a scan's beams: their information about a map of independent cells, nats, (P,).
    ``occupied`` is the probability that each cell stops a beam, (nx, ny), and ``sigma_m`` the standard deviation of
    readings. A reading is right with probability p = ``p_right``. It multiplies the odds of the cell in which it falls
    by p / (1 - p), and the odds of each cell before it by (1 - p) / p.
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


def best_views(information_nats: Floats, poses: Floats, count: int, min_distance_m: float) -> Indices:
    """Select the most informative poses that are not close to each other, best first: indices, at most ``count``."""
    best: list[int] = []
    for i in np.argsort(-information_nats, kind="stable"):
        if all(math.hypot(*(poses[i, :2] - poses[j, :2])) >= min_distance_m for j in best):
            best.append(int(i))
        if len(best) == count:
            break
    return np.array(best, dtype=np.intp)


class HasDraws(Protocol):
    """Draws of the map with their prior: a posterior, or chains that are still running."""

    @property
    def prior(self) -> "CellPrior":
        """The prior of the cells."""

    @property
    def draws(self) -> "Draws":
        """The draws of the map."""


def path_free_probability(posterior: HasDraws, path: ArrayLike, radius_m: float) -> routes.FreeProbability:
    """Return a disc's probability of a free path. Raises `BadInput` without draws, off the map, or if radius <= 0."""
    _check_draws(posterior, "free_probability")
    corners = routes.check_path(path)
    grid = posterior.draws.grid
    _check_radius(radius_m)
    inside = ((corners >= np.array(grid.extent_m[::2])) & (corners <= np.array(grid.extent_m[1::2]))).all(axis=1)
    if not inside.all():
        i = int(np.argmin(inside))
        raise BadInput(f"path: point {i}, {corners[i].tolist()}, lies outside the map, {grid.extent_words()}")
    cells = routes.cells_about(corners, radius_m, grid)
    batches = posterior.prior.drawn_stops(posterior.draws, cells)
    blocking = routes.blocking_cells(batches, cells, grid, corners, radius_m)
    return routes.free_probability(blocking, posterior.draws.chains)


def shortest_safe_path(
    posterior: HasDraws, start: ArrayLike, goal: ArrayLike, radius_m: float, risk: float,
    on_progress: OnShare = ignore_share,
) -> routes.Route:  # fmt: skip
    """Find the shortest path of bounded risk. Raises `BadInput` as `plan_route`, without draws, or if radius <= 0."""
    _check_draws(posterior, "plan")
    _check_radius(radius_m)
    ends = [routes.check_path(point) for point in (start, goal)]
    if any(len(end) != 1 for end in ends):
        raise BadInput("plan: start and goal are one point each: x, y in metres")
    blocked = blocked_by_cell(posterior, radius_m, on_progress)
    judge = partial(path_free_probability, posterior, radius_m=radius_m)
    return routes.plan_route(blocked, posterior.draws.grid, ends[0][0], ends[1][0], risk, judge)


def blocked_by_cell(posterior: HasDraws, radius_m: float, on_progress: OnShare = ignore_share) -> Floats:
    """Estimate from `SEARCH_DRAWS` draws the probability that a disc at a cell's centre touches something, (nx, ny)."""
    draws = posterior.draws.thinned(SEARCH_DRAWS)
    batches = report_batches(posterior.prior.drawn_stops(draws), draws.size, on_progress)
    return routes.blocked_probability(batches, draws.grid, radius_m)


def information_of(
    posterior: Posterior, poses: ArrayLike, angles_rad: ArrayLike | None = None, *, max_range_m: float | None = None,
    sensor: "SensorModel | None" = None, draws: int | None = None, seed: int = 0, device: str = "cpu",
    on_progress: OnShare = ignore_share,
) -> InformationGain:  # fmt: skip
    """Compute the expected information of one more scan from each pose. See `bayesmap.Run.information_gain`."""
    _check_draws(posterior, "information_gain")
    if draws is not None and draws < 2:
        raise BadInput(f"information_gain: draws must be 2 or more, got {draws!r}")
    fan = Fan.of("information_gain", posterior, angles_rad, max_range_m, sensor)
    poses_world = as_user_poses("information_gain", poses)
    chains = posterior.draws.chains if posterior.has_chains and posterior.draws.count > 1 else 1
    draws_per_chain = int((INFORMATION_PAIRS / chains) ** 0.5) if draws is None else max(2, draws // chains)
    thinned = posterior.draws.thinned(draws_per_chain * chains)
    cells = np.concatenate(list(posterior.prior.drawn_stops(thinned)))
    map_draws = MapDraws(cells, posterior.grid, float(posterior.settings["hit_depth"]), chains)
    joint = expected_information(map_draws, fan, poses_world, seed=seed, device=device, on_progress=on_progress)
    return replace(joint, independent=mean_beam_information(posterior, poses_world, fan, device))


def mean_beam_information(posterior: Posterior, poses: Floats, fan: Fan, device: str = "cpu") -> Floats:
    """Compute the formula for independent cells and beams, nats, (P,): its mean over the mean maps of the chains.
    A cell that is a wall in one chain and free in another counts as known, because no scan tells why chains differ.
    """
    draws, max_range_m = posterior.draws, fan.limits.max_m
    maps = [posterior.occupancy]
    if posterior.has_chains and draws.chains > 1:
        maps = [posterior.prior.mean_map(draws.of_chain(chain)) for chain in range(draws.chains)]
    information = partial(
        beam_information, grid=posterior.grid, poses=poses, angles_rad=fan.angles_rad, max_range_m=max_range_m,
        sigma_m=typical_sigma_m(fan.sensor, max_range_m), device=device,
    )  # fmt: skip
    return np.asarray(np.mean([information(occupied) for occupied in maps], axis=0))


def typical_sigma_m(sensor: "SensorModel", max_range_m: float) -> float:
    """Estimate the standard deviation of hits at a quarter of the range, m: half the middle 68 % of 4000 samples."""
    from bayesmap.sensors.model import RangeLimits

    distance_m = np.full(4000, 0.25 * max_range_m)
    readings_m = sensor.sample(np.random.default_rng(0), distance_m, RangeLimits(0.0, max_range_m))
    low, high = np.quantile(readings_m[np.isfinite(readings_m)], [0.16, 0.84])
    return float(max(0.5 * (high - low), 1e-3))  # not below a millimetre


@dataclass(frozen=True, eq=False)
class Views:
    """The poses from which to look next, V of P candidates."""

    candidates: Floats  # poses that were considered, (P, 3)
    independent: Floats  # expected information of each by the formula for independent cells and beams, nats, (P,)
    best: Indices  # indices of the best candidates by the upper bound from joint draws, the best first, (V,)
    information: InformationGain  # expected information of the best candidates, (V,)


def next_views(
    posterior: Posterior, candidates: int, views: int, radius_m: float, *, draws: int | None = None, seed: int = 0,
    on_progress: OnShare = ignore_share,
) -> Views:  # fmt: skip
    """Find the most informative poses among candidates that a robot can reach.
    Candidates lie where a disc is free with probability `MIN_FREE`, and free cells connect them with the robot's last
    position. The fast formula ranks all candidates. Joint draws then compare the best, twice as many as ``views``.
    Raises `BadInput` if there are no draws or no candidates, or if a count is below 1.
    """
    _check_draws(posterior, "explore")
    _check_radius(radius_m)
    for name, count in (("candidates", candidates), ("views", views)):
        if count < 1:
            raise BadInput(f"explore: {name} must be 1 or more, got {count!r}")
    on_search, on_comparison = split_progress(on_progress, 1.0, 2.0)
    fan = Fan.of("explore", posterior, angles_rad=None, max_range_m=None, sensor=None)
    # Rank candidates with all headings by the fast formula, and keep each one's best heading.
    poses = _draw_candidates(posterior, blocked_by_cell(posterior, radius_m, on_search), candidates, seed)
    headings = headings_to_try(fan.angles_rad)
    turned = np.repeat(poses, len(headings), axis=0)
    turned[:, 2] += np.tile(headings, len(poses))
    nats_by_heading = mean_beam_information(posterior, turned, fan).reshape(len(poses), -1)
    poses[:, 2] += headings[nats_by_heading.argmax(axis=1)]
    nats = nats_by_heading.max(axis=1)
    min_distance_m = MIN_SEPARATION * float(np.hypot(*np.array(posterior.grid.shape))) * posterior.grid.resolution
    compared = best_views(nats, poses, 2 * views, min_distance_m)
    expected = information_of(posterior, poses[compared], draws=draws, seed=seed, on_progress=on_comparison)
    order = np.argsort(-expected.at_most, kind="stable")[:views]
    arrays = {f.name: getattr(expected, f.name)[order] for f in fields(expected) if f.name != "draws"}
    return Views(poses, nats, compared[order], replace(expected, **arrays))


def _draw_candidates(posterior: Posterior, blocked: Floats, count: int, seed: int) -> Floats:
    """Draw at most ``count`` poses at random cells that the robot can reach, with yaw 0, (P, 3)."""
    from scipy import ndimage

    grid = posterior.grid
    open_cells = (blocked <= 1.0 - MIN_FREE) & posterior.observed
    labels, n_areas = ndimage.label(open_cells, structure=np.ones((3, 3)))
    if not n_areas:
        raise BadInput("explore: nowhere on the map is the disc free with probability one half; try a smaller radius")
    x, y, _ = posterior.scans.poses[-1]
    centres = np.stack(np.meshgrid(*grid.centers_m(), indexing="ij"), axis=-1) + 0.0
    cells = np.argwhere(open_cells)
    nearest = cells[np.hypot(*(centres[tuple(cells.T)] - [x, y]).T).argmin()]
    reachable = np.argwhere(labels == labels[tuple(nearest)])
    selected = reachable[np.random.default_rng([seed, CANDIDATES_KEY]).permutation(len(reachable))[:count]]
    return np.column_stack([centres[tuple(selected.T)], np.zeros(len(selected))])


def headings_to_try(angles_rad: Floats) -> Floats:
    """Return the yaws to try, radians: one if the beams, with the step after the last, span a full circle."""
    count = 1 if np.ptp(angles_rad) * (1 + 1 / max(len(angles_rad), 1)) >= FULL_CIRCLE_RAD else HEADINGS
    return np.arange(count) / count * 2 * np.pi


def _check_draws(posterior: HasDraws, caller: str) -> None:
    """Raise `BadInput` if there are no draws."""
    if posterior.draws.size == 0:
        raise BadInput(f"{caller}: the run has no draws; resume it, or take a method that draws maps")


def _check_radius(radius_m: float) -> None:
    """Raise `BadInput` unless the radius is positive."""
    if not 0 < radius_m < np.inf:
        raise BadInput(f"radius: must be a positive number of metres, got {radius_m!r}")
