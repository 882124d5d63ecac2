"""What is known of a simulated path beside its scans: wheel odometry with noise, bias, slip and lag; true relations.

The path is cut into turn, straight, turn (Thrun, Burgard and Fox, *Probabilistic Robotics*, 2005, section 5.4). The
book adds noise whose variance depends on the square of each part, so that the same path cut into smaller steps has
less of it. Here variances grow with the way itself, as those of a random walk do, and a log at 1 Hz and one at 10 Hz
drift alike: for a straight of d metres and turns of a_1 and a_2 radians, A = |a_1| + |a_2|,

    d'   = (1 + distance_scale) d + N(0, distance_per_m^2 d + distance_per_rad^2 A)
    a_i' = (1 + turn_scale) a_i + drift_rad_per_m d / 2 + N(0, turn_per_m^2 d / 2 + turn_per_rad^2 |a_i|)
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput, check_count
from bayesmap.space.planar import between, compose, interpolate, wrapped
from bayesmap.space.scans import as_poses

STANDING_M = 1e-9
"""A shorter straight has no direction: the step is one turn."""

NEAR_M = 4.0
"""Poses further apart than this see different walls, and no ground truth is measured between them."""

PAIRS_A_POSE = 3


@dataclass(frozen=True)
class OdometryNoise:
    """How a robot's odometry errs. The defaults are about those of a Pioneer in an office (Intel's raw log).

    Attributes:
        distance_per_m: standard deviation of the reported distance after one metre, m / sqrt(m).
        distance_per_rad: the same after a turn of one radian on the spot, m / sqrt(rad).
        turn_per_m: standard deviation of the reported yaw after one metre straight on, rad / sqrt(m).
        turn_per_rad: the same after a turn of one radian, rad / sqrt(rad).
        distance_scale: reported distances are longer by this share (a worn wheel).
        turn_scale: reported turns are larger by this share (a wrong wheel base).
        drift_rad_per_m: reported yaw turns away by this a metre (wheels of unequal size).
        slips_per_m: how often the wheels slip, in slips a metre.
        slip_m: in a slip the odometry reports on average so much more way than there was, metres.
        slip_rad: standard deviation of what a slip does to the reported yaw, radians.
        lag_s: the pose reported at a time is that of so many seconds before.

    Raises:
        BadInput: a number that is not finite, or is negative where it must not be.
    """

    distance_per_m: float = 0.03
    distance_per_rad: float = 0.06
    turn_per_m: float = 0.04
    turn_per_rad: float = 0.05
    distance_scale: float = 0.035
    turn_scale: float = 0.02
    drift_rad_per_m: float = -0.06
    slips_per_m: float = 0.0
    slip_m: float = 0.05
    slip_rad: float = 0.1
    lag_s: float = 0.0

    def __post_init__(self) -> None:
        signed = ("distance_scale", "turn_scale", "drift_rad_per_m", "lag_s")
        for field in fields(self):
            value = getattr(self, field.name)
            if not math.isfinite(value) or (value < 0 and field.name not in signed):
                kind = "a finite number" if field.name in signed else "a finite number of 0 or more"
                raise BadInput(f"odometry: {field.name} must be {kind}, got {value!r}")


def simulate_odometry(
    poses_world: ArrayLike,
    noise: OdometryNoise | None = None,
    *,
    stamps_s: ArrayLike | None = None,
    seed: int = 0,
) -> NDArray[np.float64]:
    """Return the poses that a robot's odometry reports along a path; it starts at the true first pose.

    Args:
        poses_world: where the robot's base truly was, shape (S, 3): x, y in metres and yaw in radians.
        noise: how the odometry errs.
        stamps_s: when, shape (S,), strictly ascending; needed where ``noise.lag_s`` is not 0.
        seed: of the noise. The noise of a step does not depend on the steps after it.

    Returns:
        Raw odometry, shape (S, 3), in a frame that drifts away from the world's.

    Raises:
        BadInput: shapes that do not fit, stamps that do not ascend, or a lag without stamps.
    """
    noise = OdometryNoise() if noise is None else noise
    truth = as_poses(poses_world)
    if len(truth) == 0:
        return truth
    rng = np.random.default_rng(check_count("odometry", "seed", seed, 0))
    reported = _accumulated(truth[0], _reported_steps(between(truth[:-1], truth[1:]), noise, rng))
    if noise.lag_s == 0.0:
        return reported
    if stamps_s is None:
        raise BadInput("odometry: a lag needs stamps_s, the time of each pose")
    stamps = np.asarray(stamps_s, dtype=np.float64)
    if stamps.shape != (len(truth),) or not (np.diff(stamps) > 0).all():
        raise BadInput(f"odometry: stamps_s must ascend, one a pose ({len(truth)},), got shape {stamps.shape}")
    return interpolate(stamps, reported, stamps - noise.lag_s)


def travel_times_s(poses_world: ArrayLike, speed_m_per_s: float, turn_rad_per_s: float) -> NDArray[np.float64]:
    """Compute when a robot of some speed comes by each pose of its path, seconds from the first, shape (S,).

    A step takes the longer of its way at full speed and its turn at the full rate.

    Raises:
        BadInput: a speed or rate that is not positive.
    """
    for name, value in (("speed", speed_m_per_s), ("turn rate", turn_rad_per_s)):
        if not (math.isfinite(value) and value > 0):
            raise BadInput(f"odometry: the {name} must be a positive number, got {value!r}")
    poses = as_poses(poses_world)
    steps = between(poses[:-1], poses[1:])
    ways, turns = np.hypot(steps[:, 0], steps[:, 1]), np.abs(steps[:, 2])
    took = np.maximum(ways / speed_m_per_s, turns / turn_rad_per_s)
    # Two scans from the same place still come one after the other.
    return np.concatenate([[0.0], np.cumsum(np.maximum(took, 1e-3))])


def _reported_steps(steps: NDArray[np.float64], noise: OdometryNoise, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return each true step as odometry reports it, as a pose in the frame of the step before, (S - 1, 3)."""
    normals, slips = rng.standard_normal((len(steps), 4)), rng.random((len(steps), 2))
    distance = np.hypot(steps[:, 0], steps[:, 1])
    first = np.where(distance > STANDING_M, np.arctan2(steps[:, 1], steps[:, 0]), 0.0)
    backwards = np.abs(first) > math.pi / 2  # a robot that reverses does not turn about first
    first = np.where(backwards, wrapped(first + math.pi), first)
    last = wrapped(steps[:, 2] - first)
    signed = np.where(backwards, -distance, distance)

    turned = np.abs(first) + np.abs(last)
    spread = np.sqrt(noise.distance_per_m**2 * distance + noise.distance_per_rad**2 * turned)
    reported = (1.0 + noise.distance_scale) * signed + spread * normals[:, 0]

    def turn(true: NDArray[np.float64], normal: NDArray[np.float64]) -> NDArray[np.float64]:
        sigma = np.sqrt(noise.turn_per_m**2 * distance / 2 + noise.turn_per_rad**2 * np.abs(true))
        return np.asarray((1.0 + noise.turn_scale) * true + noise.drift_rad_per_m * distance / 2 + sigma * normal)

    first, last = turn(first, normals[:, 1]), turn(last, normals[:, 2])
    slipped = slips[:, 0] < -np.expm1(-noise.slips_per_m * (distance + turned))
    reported = reported + np.where(slipped, -noise.slip_m * np.log1p(-slips[:, 1]), 0.0)
    last = last + np.where(slipped, noise.slip_rad * normals[:, 3], 0.0)
    return np.stack([reported * np.cos(first), reported * np.sin(first), wrapped(first + last)], axis=-1)


def _accumulated(start: NDArray[np.float64], steps: NDArray[np.float64]) -> NDArray[np.float64]:
    poses = np.empty((len(steps) + 1, 3))
    poses[0] = start
    for i, step in enumerate(steps):
        poses[i + 1] = compose(poses[i], step)
    return poses


def related_pairs(poses_world: NDArray[np.float64], seed: int = 0) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Choose pairs of poses up to `NEAR_M` apart: each with its next, and with two others, at all distances in time.

    Kuemmerle et al. (2009) relate poses whose scans a person can lay on top of each other: neighbours in time, and
    places seen again.

    Args:
        poses_world: shape (S, 3).
        seed: of the choice.

    Returns:
        Indices of the earlier and the later pose of each pair, ascending, each pair once.
    """
    count = len(poses_world)
    rng = np.random.default_rng(check_count("relations", "seed", seed, 0))
    if count < 2:
        return np.empty(0, np.intp), np.empty(0, np.intp)
    pairs = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    start = rng.integers(0, count - 1, PAIRS_A_POSE * 4 * count)
    # Log-uniform gaps: as many pairs seconds apart as minutes.
    gap = np.exp(rng.uniform(0.0, np.log(count), len(start))).astype(np.intp)
    far = np.stack([start, start + gap], axis=1)[start + gap < count]
    pairs = np.concatenate([pairs, far])
    apart = np.hypot(*(poses_world[pairs[:, 0], :2] - poses_world[pairs[:, 1], :2]).T)
    _, first = np.unique(pairs, axis=0, return_index=True)
    kept = pairs[np.sort(first)]
    kept = kept[apart[np.sort(first)] <= NEAR_M][: PAIRS_A_POSE * count]
    order = np.lexsort((kept[:, 1], kept[:, 0]))
    return kept[order, 0], kept[order, 1]
