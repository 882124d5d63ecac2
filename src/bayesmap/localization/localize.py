"""`bayesmap.localize`: the posterior of a robot's pose in a map posterior, from one scan or along many."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput, check_count
from bayesmap.localization.belief import Mode, PoseBelief, Region
from bayesmap.localization.filter import CARRIED, GETS_LOST, IS_FOUND, LOST_AT_FIRST, Prior, Scan, update
from bayesmap.localization.known_map import KnownMap
from bayesmap.localization.particles import LEAST_SD, PoseMixture
from bayesmap.poses.prior import Odometry
from bayesmap.poses.se2 import rotation
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.planar import between, compose, wrapped
from bayesmap.space.trajectory import Trajectory

if TYPE_CHECKING:
    from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

SURE = 0.99
"""While the likeliest mode has less than this, the whole map is searched with every scan."""


@dataclass(frozen=True, eq=False)
class Near:
    """A prior: the first pose is normal about a guess.

    Attributes:
        pose: x, y in metres and yaw in radians, (3,).
        sigma_m: standard deviation of x and of y.
        sigma_rad: of the yaw.

    Raises:
        BadInput: a pose that is not one, or a standard deviation that is not positive.
    """

    pose: ArrayLike
    sigma_m: float = 0.5
    sigma_rad: float = 0.3

    def __post_init__(self) -> None:
        pose = np.asarray(self.pose, dtype=np.float64)
        if pose.shape != (3,) or not np.isfinite(pose).all() or not (self.sigma_m > 0 and self.sigma_rad > 0):
            raise BadInput("Near: give pose (x, y, yaw), and sigma_m and sigma_rad above 0")
        object.__setattr__(self, "pose", pose)

    def components(self) -> PoseMixture:
        """As a normal distribution."""
        covariance = np.diag(np.array([self.sigma_m, self.sigma_m, self.sigma_rad]) ** 2)
        return PoseMixture(np.asarray(self.pose)[None], covariance[None], np.zeros(1))


@dataclass(frozen=True, eq=False)
class Localization:
    """Posteriors of the poses of some scans; what is asked of it is of the last one.

    Attributes:
        beliefs: one a scan, each given all scans up to it.
    """

    beliefs: tuple[PoseBelief, ...]

    def __len__(self) -> int:
        return len(self.beliefs)

    @property
    def last(self) -> PoseBelief:
        """The last scan's."""
        return self.beliefs[-1]

    @property
    def mean(self) -> Floats:
        """Mean pose of the likeliest mode, (3,)."""
        return self.last.mean

    @property
    def covariance(self) -> Floats:
        """Covariance of the likeliest mode, (3, 3)."""
        return self.last.covariance

    @property
    def modes(self) -> tuple[Mode, ...]:
        """Where the robot may be, the likeliest first."""
        return self.last.modes

    @property
    def p_lost(self) -> float:
        """Probability that the robot is not on the map, or the map outdated."""
        return self.last.p_lost

    def region(self, level: float = 0.95) -> Region:
        """The smallest region of positions that holds a probability."""
        return self.last.region(level)

    def probability_in(self, area: ArrayLike) -> float:
        """The probability of being in a polygon (K, 2), or in (x_min, x_max, y_min, y_max)."""
        return self.last.probability_in(np.asarray(area, dtype=np.float64))

    def trajectory(self) -> Trajectory:
        """Means and covariances of all scans' poses."""
        stamps = [belief.stamp_s for belief in self.beliefs]
        known = None if any(stamp is None for stamp in stamps) else np.array(stamps, dtype=np.float64)
        poses = np.array([belief.mean for belief in self.beliefs])
        return Trajectory(poses, known, np.array([belief.covariance for belief in self.beliefs]))


def localize(
    run: Any,
    scans: Scans,
    *,
    prior: Near | None = None,
    odometry: Odometry | None = None,
    independent: bool = False,
    seed: int = 0,
    on_belief: Callable[[int, PoseBelief], None] | None = None,
) -> Localization:
    """Where were these scans taken, in the map of this run?

    Args:
        run: a run with draws, or a `KnownMap` of one, which saves preparing it again.
        scans: one, or several in order of time. Their poses are taken for odometry: only the motion from one to the
            next is looked at, not the poses themselves.
        prior: of the first scan's pose; None: it may be anywhere in the map.
        odometry: how far off motions are; by default that of a usual robot.
        independent: locate each scan by itself, as if nothing were known of motions.
        seed: of the draws of poses.
        on_belief: given the number of each scan and its posterior as soon as it is known.

    Raises:
        BadInput: no scan, a run without draws, or a sensor model of the user's own.
    """
    if len(scans) == 0:
        raise BadInput("localize: there is no scan")
    beliefs = []
    known = run if isinstance(run, KnownMap) else KnownMap.of_run(run)
    for number, belief in enumerate(follow(known, scans, prior, odometry, independent, seed)):
        beliefs.append(belief)
        if on_belief is not None:
            on_belief(number, belief)
    return Localization(tuple(beliefs))


def follow(
    known: KnownMap,
    scans: Scans,
    prior: Near | None = None,
    odometry: Odometry | None = None,
    independent: bool = False,
    seed: int = 0,
) -> Iterator[PoseBelief]:
    """The posteriors of scans, one after the other; arguments are those of `localize`."""
    odometry = Odometry() if odometry is None else odometry
    rng = np.random.default_rng(check_count("localize", "seed", seed, 0))
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    first = Prior() if prior is None else Prior(prior.components(), CARRIED, LOST_AT_FIRST)
    believed, belief = first, None
    for i in range(len(scans)):
        stamp = None if scans.stamps_s is None else float(scans.stamps_s[i])
        scan = Scan(scans.angles_rad, scans.ranges_m[i], limits, stamp)
        if belief is not None:
            motion = between(scans.poses[i - 1], scans.poses[i])
            believed = Prior() if independent else moved(belief, motion, odometry.sigmas(motion))
        unsure = belief is None or belief.p_lost > 0.5 or belief.modes[0].probability < SURE
        belief = update(known, believed, scan, rng, look_everywhere=unsure or independent)
        yield belief


def moved(belief: PoseBelief, motion: Floats, sigmas: Floats) -> Prior:
    """What is believed after a motion that odometry reports.

    Args:
        belief: before it.
        motion: the new pose as seen from the old one, (3,).
        sigmas: standard deviations of its error, in the frame of the old pose, (3,).
    """
    means = np.array([mode.mean for mode in belief.modes])
    covariances = np.array([mode.covariance for mode in belief.modes])
    ends = compose(means, motion)
    swing = np.broadcast_to(np.eye(3), covariances.shape).copy()
    swing[:, 0, 2] = -(ends[:, 1] - means[:, 1])
    swing[:, 1, 2] = ends[:, 0] - means[:, 0]
    turn = rotation(means[:, 2])
    noise = turn @ np.diag(sigmas**2 + LEAST_SD**2) @ np.swapaxes(turn, 1, 2)
    ends[:, 2] = wrapped(ends[:, 2])
    mass = np.log([mode.probability for mode in belief.modes])
    components = PoseMixture(ends, swing @ covariances @ np.swapaxes(swing, 1, 2) + noise, mass)
    lost = belief.p_lost * (1.0 - IS_FOUND) + (1.0 - belief.p_lost) * GETS_LOST
    # A robot that was lost may be back anywhere.
    return Prior(components, CARRIED + (1.0 - CARRIED) * min(belief.p_lost * IS_FOUND, 0.5), lost)
