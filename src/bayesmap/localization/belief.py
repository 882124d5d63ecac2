"""The posterior of a pose as weighted poses, and the importance sampling that computes it.

`PoseBelief` is the result: weighted poses, their modes (`Mode`) and regions (`Region`). `PoseMixture` is the proposal
of population Monte Carlo (Cappe, Guillin, Marin and Robert 2004). Each round draws from Student distributions about the
present places (`PoseMixture.draw`), weights the draws by target / proposal (`Population`), and moves the places to the
weighted means (`PoseMixture.adapt`). But for truncation the last weights are unbiased; they average to the evidence.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.special import gammaincinv, gammaln, ndtri

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats, compose, wrap_angle
from bayesmap.space.trajectory import ellipses

NEAR_M, NEAR_RAD = 0.2, np.radians(7.0)  # a turn that is as far as a step, among neighbours
MIN_MODE_SIGMA = np.array([0.002, 0.002, np.radians(0.05)])  # standard deviations of a mode
NEIGHBOURS = 10  # nearest poses that share a mode with each pose, itself among them
LINKING_WEIGHT = 0.995  # share of the weight whose poses link others into modes
MIN_PROBABILITY = 1e-4  # probability of a mode that is listed
REGION_DRAWS = 4000  # number of draws by which a region is computed
LogDensity = Callable[[Floats], Floats]  # log density of poses, (P, 3), not normalised, (P,)
DOF = 5.0  # degrees of freedom of proposals
STUDENT_CONSTANT = gammaln((DOF + 3) / 2) - gammaln(DOF / 2) - 1.5 * np.log(DOF * np.pi)
LATTICE = 1.1673039782614187 ** -np.arange(1.0, 5.0)  # steps of the lattice of draws: powers of the root of x^5 = x + 1
MIN_SIGMA = np.array([0.004, 0.004, np.radians(0.1)])  # standard deviations of a proposal
SAME_MODE_SIGMAS = 2.0  # places nearer than this are one mode, in standard deviations
SAME_MODE_XY_YAW = np.array([0.2, 0.2, np.radians(7.0)])  # places nearer than this are one mode: metres, radians
EFFECTIVE_SHARE = 0.3  # weights are tempered until this share of a place's draws is effective
EFFECTIVE_DRAWS = 16.0  # or until this number of draws is effective
MIN_TEMPERING = 1e-3  # power to which weights are tempered
NEGLIGIBLE_NATS = 15.0  # difference in log mass from the greatest beyond which places are dropped


@dataclass(frozen=True, eq=False)
class Mode:
    """One place where the robot may be."""

    mean: Floats  # x, y in metres and yaw in radians, (3,)
    covariance: Floats  # covariance of x, y and yaw in world axes, (3, 3)
    probability: float  # probability that the robot is there, if it is on the map at all

    def as_json(self) -> dict[str, Any]:
        """Return the mode as JSON values."""
        mean, covariance = self.mean.tolist(), self.covariance.tolist()
        return {"mean": mean, "covariance": covariance, "probability": float(self.probability)}


@dataclass(frozen=True, eq=False)
class Region:
    """The smallest region of positions that holds a probability, if modes are normal."""

    modes: tuple[Floats, Floats, Floats]  # means (K, 2), covariances (K, 2, 2), probabilities (K,)
    density: float  # minimum density of positions in the region, 1 / m^2
    level: float  # the probability
    area_m2: float

    def contains(self, positions: Floats) -> Mask:
        """Return a mask of the positions, (N, 2), that lie inside, (N,)."""
        return np.asarray(_density(np.atleast_2d(np.asarray(positions, dtype=np.float64)), *self.modes) >= self.density)


@dataclass(frozen=True, eq=False)
class PoseBelief:
    """The posterior of a pose, as weighted poses."""

    poses: Floats  # x, y and yaw in the world frame, (N, 3)
    weights: Floats  # weights of the poses, given that the robot is on the map and the map is right; sum 1, (N,)
    p_lost: float  # probability that the robot is elsewhere, or the map outdated
    nats_per_beam: float  # log density of the scan's readings under the best pose, per beam
    stamp_s: float | None = None  # stamp of the scan
    mode_of: Indices | None = None  # number of each pose's mode, (N,); if None, poses near each other make one
    shared_error: Floats | None = None  # standard deviations of the map's error, (3,): modes are wider by it
    p_alike: float = 0.0  # part of ``p_lost``: probability that the robot is lost where scans fit a place on the map

    def __repr__(self) -> str:
        """Return four lines: size, the likeliest pose, its probability, and that of being lost."""
        x, y, yaw = self.mean
        sigma_x, sigma_y, sigma_yaw = np.sqrt(np.diag(self.covariance))
        likely = f"{self.modes[0].probability:.1%}, the likeliest of {len(self.modes):,}"
        return (
            f"PoseBelief: {len(self.weights):,} weighted poses\n"
            f"  pose: x {x:.3f} +- {sigma_x:.2g} m, y {y:.3f} +- {sigma_y:.2g} m, "
            f"yaw {np.degrees(yaw):.2f} +- {np.degrees(sigma_yaw):.2g} degrees\n"
            f"  probability of this place: {likely}\n  probability of being lost: {self.p_lost:.2g}"
        )

    @cached_property
    def modes(self) -> tuple[Mode, ...]:
        """The places where the robot may be, the likeliest first."""
        modes = self.modes_above(MIN_PROBABILITY)
        if self.shared_error is None:
            return modes
        wider = np.diag(self.shared_error**2)
        return tuple(replace(mode, covariance=mode.covariance + wider) for mode in modes)

    def modes_above(self, min_probability: float) -> tuple[Mode, ...]:
        """Return the modes of at least this probability, the likeliest first, without the map's shared error."""
        mode_of = label_clusters(self.poses, self.weights) if self.mode_of is None else self.mode_of
        modes = []
        for number in np.unique(mode_of):
            in_mode = mode_of == number
            probability = float(self.weights[in_mode].sum())
            if probability >= min_probability:
                mean, covariance = _moments(self.poses[in_mode], self.weights[in_mode] / probability)
                modes.append(Mode(mean, covariance + np.diag(MIN_MODE_SIGMA**2), min(probability, 1.0)))
        return tuple(sorted(modes, key=lambda mode: -mode.probability))

    def of_frame(self, step: Floats) -> "PoseBelief":
        """Return the posterior of another frame on the robot, at ``step``, (3,), in the frame of these poses."""
        mode_of = label_clusters(self.poses, self.weights) if self.mode_of is None else self.mode_of
        return replace(self, poses=compose(self.poses, step), mode_of=mode_of)

    @property
    def mean(self) -> Floats:
        """Mean pose of the likeliest mode, (3,)."""
        return self.modes[0].mean

    @property
    def covariance(self) -> Floats:
        """Covariance of the likeliest mode, (3, 3)."""
        return self.modes[0].covariance

    @property
    def total_covariance(self) -> Floats:
        """Covariance over all modes, (3, 3)."""
        return _moments(self.poses, self.weights)[1]

    def region(self, level: float = 0.95) -> Region:
        """Return the smallest region with probability ``level``. Raises `BadInput` if it is not in (0, 1)."""
        if not 0 < level < 1:
            raise BadInput(f"region: level must lie inside (0, 1), got {level!r}")
        means = np.array([mode.mean[:2] for mode in self.modes])
        covariances = np.array([mode.covariance[:2, :2] for mode in self.modes]) + 1e-10 * np.eye(2)  # for Cholesky
        shares = np.array([mode.probability for mode in self.modes])
        modes = (means, covariances, shares / shares.sum())
        # Draw positions, and take the quantile of their densities.
        rng = np.random.default_rng(0)
        mode = rng.choice(len(shares), REGION_DRAWS, p=modes[2])
        roots = np.linalg.cholesky(covariances)
        draws = means[mode] + np.einsum("nij,nj->ni", roots[mode], rng.standard_normal((REGION_DRAWS, 2)))
        density = _density(draws, *modes)
        min_density = float(np.quantile(density, 1.0 - level))
        # The area is the mean over draws of 1 / density inside.
        area_m2 = float((1.0 / density[density >= min_density]).sum() / len(density))
        return Region(modes, min_density, level, area_m2)

    def outlines(self, level: float = 0.95) -> Floats:
        """Return ellipses that hold each mode's position with a probability, (modes, points, 2)."""
        covariances = np.array([mode.covariance[:2, :2] for mode in self.modes])
        return ellipses(np.array([mode.mean[:2] for mode in self.modes]), covariances, level)

    def probability_in(self, area: Floats) -> float:
        """Compute the probability that the robot is on the map and in an area.
        The area is a polygon of corners in order, (K, 2), metres, or (x_min, x_max, y_min, y_max); else `BadInput`.
        """
        corners = np.asarray(area, dtype=np.float64)
        if corners.shape == (4,):
            if not (corners[0] < corners[1] and corners[2] < corners[3]):
                raise BadInput(f"area: give x_min below x_max and y_min below y_max, got {corners.tolist()}")
            x0, x1, y0, y1 = corners
            corners = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
        if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) < 3:
            raise BadInput(f"area: give corners (K, 2) or (x_min, x_max, y_min, y_max), got shape {corners.shape}")
        return float((1.0 - self.p_lost) * min(1.0, self.weights[_are_inside(self.poses[:, :2], corners)].sum()))

    def as_json(self) -> dict[str, Any]:
        """Return the posterior's moments, modes and probabilities as JSON values."""
        return {
            "stamp_s": self.stamp_s, "mean": self.mean.tolist(), "covariance": self.covariance.tolist(),
            "modes": [mode.as_json() for mode in self.modes], "region_95_m2": self.region(0.95).area_m2,
            "p_lost": float(self.p_lost), "nats_per_beam": float(self.nats_per_beam),
        }  # fmt: skip


def _moments(poses: Floats, weights: Floats) -> tuple[Floats, Floats]:
    """Return mean and covariance of weighted poses. Yaws count from their circular mean."""
    centre = np.arctan2(weights @ np.sin(poses[:, 2]), weights @ np.cos(poses[:, 2]))
    unwrapped = poses.copy()
    unwrapped[:, 2] = wrap_angle(poses[:, 2] - centre)
    mean = weights @ unwrapped
    error = unwrapped - mean
    covariance = np.einsum("n,ni,nj->ij", weights, error, error)
    mean[2] = wrap_angle(mean[2] + centre)
    return mean, covariance


def label_clusters(poses: Floats, weights: Floats) -> Indices:
    """Label poses linked by their `NEIGHBOURS` nearest ones, (N,); light poses get the label of the nearest."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    radius_m = NEAR_M / NEAR_RAD
    points = np.column_stack([poses[:, :2], radius_m * np.sin(poses[:, 2]), radius_m * np.cos(poses[:, 2])])
    order = np.argsort(-weights, kind="stable")
    # Only poses that hold nearly all weight link others: strays between two modes must not link them.
    heavy = order[: int(np.searchsorted(np.cumsum(weights[order]), LINKING_WEIGHT * weights.sum())) + 1]
    tree, count = cKDTree(points[heavy]), len(heavy)
    nearest = tree.query(points[heavy], range(1, min(NEIGHBOURS, count) + 1))[1]
    rows = np.repeat(np.arange(count), nearest.shape[1])
    links = coo_matrix((np.ones(nearest.size), (rows, nearest.ravel())), shape=(count, count))
    _, label = connected_components(links, directed=False)
    return np.asarray(label[tree.query(points)[1]], dtype=np.intp)


def _density(positions: Floats, means: Floats, covariances: Floats, shares: Floats) -> Floats:
    """Compute the density of a mixture of normal distributions in the plane, (N,)."""
    deviations = positions[:, None] - means
    inverse = np.linalg.inv(covariances)
    squared = np.einsum("nki,kij,nkj->nk", deviations, inverse, deviations)
    return np.asarray((shares * np.sqrt(np.linalg.det(inverse)) / (2 * np.pi) * np.exp(-0.5 * squared)).sum(axis=1))


def _are_inside(positions: Floats, corners: Floats) -> Mask:
    """Return a mask of positions in a polygon, (N,): an odd number of its sides lies to their right."""
    x, y = positions[:, :1], positions[:, 1:]
    (ax, ay), (bx, by) = corners.T, np.roll(corners, -1, axis=0).T
    crosses = (ay > y) != (by > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing_x = ax + (y - ay) * (bx - ax) / (by - ay)
    return np.asarray((crosses & (x < crossing_x)).sum(axis=1) % 2 == 1)


def log_sum(logs: Floats) -> Floats:
    """Compute log sum exp over the last axis. SciPy's function is far slower for small arrays."""
    max_log = logs.max(axis=-1, keepdims=True)
    max_log = np.where(np.isfinite(max_log), max_log, 0.0)
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(np.exp(logs - max_log).sum(axis=-1)) + max_log[..., 0])


@dataclass(frozen=True, eq=False)
class PoseMixture:
    """K places, each with a mean pose, a covariance and a mass."""

    means: Floats  # mean poses, x, y and yaw in the world frame, (K, 3)
    covariances: Floats  # covariances in world axes, (K, 3, 3)
    log_mass: Floats  # log of each place's share of the target, up to a constant, (K,)

    def best(self, max_places: int, within_nats: float = NEGLIGIBLE_NATS) -> "PoseMixture":
        """Return the ``max_places`` places of greatest mass, none more than ``within_nats`` below the first."""
        order = np.argsort(-self.log_mass, kind="stable")[:max_places]
        order = order[self.log_mass[order] > self.log_mass[order[0]] - within_nats]
        return self.select(order)

    def select(self, places: Sequence[int] | Indices) -> "PoseMixture":
        """Return the places with these numbers."""
        return PoseMixture(self.means[places], self.covariances[places], self.log_mass[places])

    def draw(self, target: LogDensity, count: int | Indices, rng: np.random.Generator) -> "Population":
        """Draw ``count`` poses from each place, one number or (K,), and weight them. Masses of places are not used."""
        counts = np.broadcast_to(count, len(self.means))
        place = np.repeat(np.arange(len(counts)), counts)
        roots = np.linalg.cholesky(self.covariances)
        poses = self.means[place] + np.matmul(roots[place], student_draws(len(place), rng)[..., None])[..., 0]
        poses[:, 2] = wrap_angle(poses[:, 2])
        log_target = target(poses)
        log_weights = log_target - log_sum(self._student_logs(poses) + np.log(counts / counts.sum()))
        # Truncated importance sampling (Ionides 2008): no weight exceeds the mean times the root of their count.
        limit = log_sum(log_weights) - 0.5 * np.log(len(poses))
        return Population(poses, np.minimum(log_weights, limit), place, log_target)

    def draw_counts(self, max_draws: int, min_share: float = 1 / 3) -> Indices:
        """Return the number of draws of each place, (K,): by the root of its mass, and not below a share."""
        shares = np.exp(0.5 * (self.log_mass - self.log_mass.max()))
        return np.asarray(np.maximum(np.round(max_draws * shares), int(max_draws * min_share)), dtype=np.intp)

    def label_places(self, poses: Floats) -> Indices:
        """Label poses by place, (P,). Places of one mode share a label."""
        from scipy.sparse.csgraph import connected_components

        if len(self.means) == 1:
            return np.zeros(len(poses), dtype=np.intp)
        deviations = self.means[:, None] - self.means
        deviations[..., 2] = wrap_angle(deviations[..., 2])
        precision = np.linalg.inv(self.covariances[:, None] + self.covariances)
        is_same_mode = np.einsum("kli,klij,klj->kl", deviations, precision, deviations) < SAME_MODE_SIGMAS**2
        is_same_mode |= (np.abs(deviations) < SAME_MODE_XY_YAW).all(axis=2)
        _, label = connected_components(is_same_mode, directed=False)
        return np.asarray(label[self._student_logs(poses).argmax(axis=1)], dtype=np.intp)

    def mahalanobis_terms(self, poses: Floats) -> tuple[Floats, Floats]:
        """Return squared Mahalanobis distances of poses from the places, (P, K), and half of log determinants, (K,)."""
        deviations = poses - self.means[:, None]
        deviations[..., 2] = wrap_angle(deviations[..., 2])
        inverse = np.linalg.inv(self.covariances)
        squared = (np.matmul(deviations, inverse) * deviations).sum(axis=-1)
        return np.ascontiguousarray(squared.T), -0.5 * np.linalg.slogdet(inverse)[1]

    def _student_logs(self, poses: Floats) -> Floats:
        """Return the log density of each place's Student distribution, (P, K)."""
        squared, half_log_det = self.mahalanobis_terms(poses)
        return np.asarray(STUDENT_CONSTANT - half_log_det - 0.5 * (DOF + 3) * np.log1p(squared / DOF))

    def weigh(self, population: "Population") -> "PoseMixture":
        """Return the places with new masses: the sums of the weights of the draws from each place."""
        masses = [log_sum(population.log_weights[population.place == k]) for k in range(len(self.means))]
        return PoseMixture(self.means, self.covariances, np.array(masses))

    def adapt(self, population: "Population", widen: float = 1.5) -> "tuple[PoseMixture, float]":
        """Return the places at the weighted moments of their draws, and the lowest power of the tempered weights."""
        # With a power of 1 the proposals are near the target. With a lower power, another round will improve them.
        count, min_tempering = len(self.means), 1.0
        means, covariances, log_mass = self.means.copy(), self.covariances.copy(), np.full(count, -np.inf)
        for k in range(count):
            of_place = population.place == k
            logs = population.log_weights[of_place]
            max_log = logs.max()
            if not np.isfinite(max_log):
                continue  # no draw of this place is possible
            logs = logs - max_log
            weights = np.exp(logs)
            log_mass[k] = max_log + np.log(weights.sum())
            # Temper the weights until several draws are effective: a single dominant draw has no spread.
            tempering, min_effective = 1.0, min(EFFECTIVE_SHARE * len(logs), EFFECTIVE_DRAWS)
            while weights.sum() ** 2 < min_effective * (weights @ weights) and tempering > MIN_TEMPERING:
                tempering *= 0.8  # in small steps, to temper no more than needed
                weights = np.exp(tempering * logs)
            weights /= weights.sum()
            # Move the place to the weighted mean, and widen the weighted covariance.
            deviations = population.poses[of_place] - means[k]
            deviations[:, 2] = wrap_angle(deviations[:, 2])
            shift = weights @ deviations
            error = deviations - shift
            covariances[k] = widen * np.einsum("n,ni,nj->ij", weights, error, error) + np.diag(MIN_SIGMA**2)
            means[k] += shift
            min_tempering = min(min_tempering, tempering)
        return PoseMixture(means, covariances, log_mass), min_tempering


@dataclass(frozen=True, eq=False)
class Population:
    """N weighted poses. Their mean weight, of target / proposal, estimates the target's normaliser."""

    poses: Floats  # x, y and yaw in the world frame, (N, 3)
    log_weights: Floats  # log of target / proposal, not normalised, (N,)
    place: Indices  # number of the place from which each pose was drawn, (N,)
    log_target: Floats  # log density of the target, not normalised, (N,)

    @property
    def log_evidence(self) -> float:
        """Log of the integral of the target."""
        return float(log_sum(self.log_weights) - np.log(len(self.poses)))

    @property
    def weights(self) -> Floats:
        """Normalised weights, (N,)."""
        return np.asarray(np.exp(self.log_weights - log_sum(self.log_weights)))


def student_draws(count: int, rng: np.random.Generator) -> Floats:
    """Draw from the standard Student distribution in three dimensions, evenly spread, (N, 3).
    The draws are points of a lattice (Roberts 2018) with a random shift (Cranley and Patterson 1976). So each point has
    the law of a single draw.
    """
    even = (rng.random(4) + np.arange(count)[:, None] * LATTICE) % 1.0
    even = np.clip(even, 1e-12, 1.0 - 1e-12)  # at 0 and 1 the quantiles are infinite
    stretch = np.sqrt(0.5 * DOF / gammaincinv(0.5 * DOF, even[:, 3:]))
    return np.asarray(stretch * ndtri(even[:, :3]))
