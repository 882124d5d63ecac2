"""The posterior of a pose: weighted poses, their modes, and the probability that all of them are wrong."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.planar import Floats, compose, wrap_angle
from bayesmap.space.trajectory import ellipses

NEAR_M, NEAR_RAD = 0.2, np.radians(7.0)  # chains of poses with steps shorter than this belong to one mode
FINEST_SD = np.array([0.002, 0.002, np.radians(0.05)])  # least standard deviations of a mode, whatever its poses say
LINKING = 0.995  # share of the weight whose poses link others into modes
LEAST_MODE = 1e-4  # least probability of a mode that is listed


@dataclass(frozen=True, eq=False)
class Mode:
    """One place where the robot may be."""

    mean: Floats  # x, y in metres and yaw in radians, (3,)
    covariance: Floats  # of x, y and yaw in world axes, (3, 3)
    probability: float  # that the robot is there, if it is on the map at all

    def as_json(self) -> dict[str, Any]:
        """Return the mode as JSON values."""
        mean, covariance = self.mean.tolist(), self.covariance.tolist()
        return {"mean": mean, "covariance": covariance, "probability": float(self.probability)}


@dataclass(frozen=True, eq=False)
class Region:
    """The smallest region of positions that holds a probability, of normal modes."""

    modes: tuple[Floats, Floats, Floats]  # means (K, 2), covariances (K, 2, 2), probabilities (K,)
    density: float  # least density of positions in the region, 1 / m^2
    level: float  # the probability
    area_m2: float

    def contains(self, positions: Floats) -> NDArray[np.bool_]:
        """Return which positions lie inside, (N, 2) to (N,)."""
        return np.asarray(_density(np.atleast_2d(np.asarray(positions, dtype=np.float64)), *self.modes) >= self.density)


@dataclass(frozen=True, eq=False)
class PoseBelief:
    """The posterior of a pose, as weighted poses."""

    poses: Floats  # in the world frame, (N, 3)
    weights: Floats  # of the poses, (N,), summing to 1: given that the robot is on the map, and the map is right
    p_lost: float  # probability that the robot is elsewhere, or the map outdated
    nats_per_beam: float  # log density of the scan's readings under the best pose, per beam
    stamp_s: float | None = None  # stamp of the scan
    mode_of: NDArray[np.intp] | None = None  # the mode of each pose, (N,); None: poses near each other make one
    shared_error: Floats | None = None  # standard deviations of the map's error, (3,): modes are wider by it

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
        modes = self.places(LEAST_MODE)
        if self.shared_error is None:
            return modes
        wider = np.diag(self.shared_error**2)
        return tuple(replace(mode, covariance=mode.covariance + wider) for mode in modes)

    def places(self, least: float) -> tuple[Mode, ...]:
        """Return the places of at least this probability, the likeliest first, without the map's shared error."""
        label = _clusters(self.poses, self.weights) if self.mode_of is None else self.mode_of
        modes = []
        for number in np.unique(label):
            own = label == number
            share = float(self.weights[own].sum())
            if share >= least:
                mean, covariance = _moments(self.poses[own], self.weights[own] / share)
                modes.append(Mode(mean, covariance + np.diag(FINEST_SD**2), min(share, 1.0)))
        return tuple(sorted(modes, key=lambda mode: -mode.probability))

    def of_frame(self, step: Floats) -> PoseBelief:
        """Return the posterior of another frame on the robot, whose pose in this frame is ``step``, (3,)."""
        label = _clusters(self.poses, self.weights) if self.mode_of is None else self.mode_of
        return replace(self, poses=compose(self.poses, step), mode_of=label)

    @property
    def mean(self) -> Floats:
        """Mean pose of the likeliest mode, (3,)."""
        return self.modes[0].mean

    @property
    def covariance(self) -> Floats:
        """Covariance of the likeliest mode, (3, 3); `total_covariance` has all modes in it."""
        return self.modes[0].covariance

    @property
    def total_covariance(self) -> Floats:
        """Covariance over all modes, (3, 3)."""
        return _moments(self.poses, self.weights)[1]

    def region(self, level: float = 0.95) -> Region:
        """Return the smallest region of positions that holds a probability, all modes taken as normal. Raises BadInput:
        a level outside (0, 1).
        """
        if not 0 < level < 1:
            raise BadInput(f"region: level must lie inside (0, 1), got {level!r}")
        means = np.array([mode.mean[:2] for mode in self.modes])
        covariances = np.array([mode.covariance[:2, :2] for mode in self.modes]) + 1e-10 * np.eye(2)
        shares = np.array([mode.probability for mode in self.modes])
        modes = (means, covariances, shares / shares.sum())
        rng = np.random.default_rng(0)
        which = rng.choice(len(shares), 4000, p=modes[2])
        roots = np.linalg.cholesky(covariances)
        drawn = means[which] + np.einsum("nij,nj->ni", roots[which], rng.standard_normal((4000, 2)))
        density = _density(drawn, *modes)
        least = float(np.quantile(density, 1.0 - level))
        # The area is the mean over draws of 1 / density inside.
        return Region(modes, least, level, float((1.0 / density[density >= least]).sum() / len(density)))

    def outlines(self, level: float = 0.95) -> Floats:
        """Return ellipses that hold each mode's position with a probability, (modes, points, 2)."""
        covariances = np.array([mode.covariance[:2, :2] for mode in self.modes])
        return ellipses(np.array([mode.mean[:2] for mode in self.modes]), covariances, level)

    def probability_in(self, area: Floats) -> float:
        """Compute the probability that the robot is on the map and in a polygon.

        ``area`` holds its corners in order, (K, 2), metres; or (x_min, x_max, y_min, y_max). Anything else raises
        `BadInput`.
        """
        corners = np.asarray(area, dtype=np.float64)
        if corners.shape == (4,):
            if not (corners[0] < corners[1] and corners[2] < corners[3]):
                raise BadInput(f"area: give x_min below x_max and y_min below y_max, got {corners.tolist()}")
            x0, x1, y0, y1 = corners
            corners = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
        if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) < 3:
            raise BadInput(f"area: give corners (K, 2) or (x_min, x_max, y_min, y_max), got shape {corners.shape}")
        return float((1.0 - self.p_lost) * min(1.0, self.weights[_inside(self.poses[:, :2], corners)].sum()))

    def as_json(self) -> dict[str, Any]:
        """Return the posterior's moments, modes and probabilities as JSON values."""
        return {
            "stamp_s": self.stamp_s, "mean": self.mean.tolist(), "covariance": self.covariance.tolist(),
            "modes": [mode.as_json() for mode in self.modes], "region_95_m2": self.region(0.95).area_m2,
            "p_lost": float(self.p_lost), "nats_per_beam": float(self.nats_per_beam),
        }  # fmt: skip


def _moments(poses: Floats, weights: Floats) -> tuple[Floats, Floats]:
    """Return mean and covariance of weighted poses; those of the yaw are about its circular mean."""
    centre = np.arctan2(weights @ np.sin(poses[:, 2]), weights @ np.cos(poses[:, 2]))
    off = poses.copy()
    off[:, 2] = wrap_angle(poses[:, 2] - centre)
    mean = weights @ off
    error = off - mean
    covariance = np.einsum("n,ni,nj->ij", weights, error, error)
    mean[2] = wrap_angle(mean[2] + centre)
    return mean, covariance


def _clusters(poses: Floats, weights: Floats) -> NDArray[np.intp]:
    """Label poses linked by steps of less than `NEAR_M` and `NEAR_RAD`, (N,); light ones get the nearest label."""
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    turn = NEAR_M / NEAR_RAD
    seat = np.column_stack([poses[:, :2], turn * np.sin(poses[:, 2]), turn * np.cos(poses[:, 2])])
    order = np.argsort(-weights, kind="stable")
    # The poses that hold nearly all weight: strays between two modes must not link them.
    heavy = order[: int(np.searchsorted(np.cumsum(weights[order]), LINKING * weights.sum())) + 1]
    tree = cKDTree(seat[heavy])
    _, own = connected_components(tree.sparse_distance_matrix(tree, NEAR_M, output_type="coo_matrix"), directed=False)
    label = np.empty(len(poses), dtype=np.intp)
    label[:] = own[tree.query(seat)[1]]
    return label


def _density(positions: Floats, means: Floats, covariances: Floats, shares: Floats) -> Floats:
    """Compute the density of a mixture of normal distributions in the plane, (N,)."""
    off = positions[:, None] - means
    inverse = np.linalg.inv(covariances)
    squared = np.einsum("nki,kij,nkj->nk", off, inverse, off)
    return np.asarray((shares * np.sqrt(np.linalg.det(inverse)) / (2 * np.pi) * np.exp(-0.5 * squared)).sum(axis=1))


def _inside(positions: Floats, corners: Floats) -> NDArray[np.bool_]:
    """Return which positions lie in a polygon: an odd number of its sides lies to their right."""
    x, y = positions[:, :1], positions[:, 1:]
    (ax, ay), (bx, by) = corners.T, np.roll(corners, -1, axis=0).T
    crosses = (ay > y) != (by > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = ax + (y - ay) * (bx - ax) / (by - ay)
    return np.asarray((crosses & (x < at)).sum(axis=1) % 2 == 1)
