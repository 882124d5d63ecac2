"""Locate a robot in a map posterior, from one scan or along many: `bayesmap.localize`.

`localize` collects the posteriors that `follow` yields. For each scan, `follow` moves the belief by odometry
(`predict`) and weights it by the scan (`bayesmap.localization.filter.update`).
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtr

from bayesmap.errors import BadInput, check_count, near_names
from bayesmap.localization.belief import MIN_SIGMA, Mode, PoseBelief, PoseMixture, Region
from bayesmap.localization.filter import P_ALIKE, P_LOST_AT_FIRST, Prior, Scan, update
from bayesmap.localization.known_map import KnownMap, Trust
from bayesmap.poses.prior import Odometry
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.planar import Floats, between, compose, frame_jacobians, rotation
from bayesmap.space.scans import Scans, as_user_poses, check_sigma_rad
from bayesmap.space.trajectory import Trajectory, step_to

if TYPE_CHECKING:
    from bayesmap.space.grid import Grid

MIN_SURE_PROBABILITY = 0.99  # probability of the likeliest mode below which every scan is searched for in the whole map
SURE_P_LOST = 0.5  # probability of being lost above which every scan is searched for in the whole map, too
MIN_MAP_PROBABILITY = 1e-3  # least probability of the map's area under a prior
TURN_M = 0.5  # length of path with as much new evidence as a turn by one radian, metres
MIN_NEW_SHARE = 0.02  # least share of new evidence, and of `P_GETS_LOST` and `P_FOUND`: for a robot that stands still
LOST_PATH_M = 1.5  # path, metres, over which the three probabilities below apply; over less, in proportion
P_GETS_LOST = 1e-3  # probability that a robot on the map gets lost
P_FOUND = 0.05  # probability that a lost robot returns to the map
P_UNLIKE = 0.4  # probability that a lost robot leaves a place that looks like one on the map
MAX_P_RETURNED = 0.5  # largest share of the prior that stands for a return to the map


@dataclass(frozen=True, eq=False)
class InitialPose:
    """The prior under which the first pose is normal about a guess.

    Attributes:
        pose: x, y in metres and yaw in radians, (3,).
        sigma_m: standard deviation of x and of y.
        sigma_rad: standard deviation of the yaw.

    Raises `BadInput` for a pose of another shape, numbers that are not finite, or deviations that are not positive.
    """

    pose: ArrayLike
    sigma_m: float = 0.5
    sigma_rad: float = 0.3

    def __post_init__(self) -> None:
        pose = np.asarray(self.pose, dtype=np.float64)
        if pose.shape != (3,) or not np.isfinite(pose).all() or not (self.sigma_m > 0 and self.sigma_rad > 0):
            raise BadInput("InitialPose: give pose (x, y, yaw), and sigma_m and sigma_rad above 0")
        as_user_poses("InitialPose", pose)
        check_sigma_rad("InitialPose", self.sigma_rad)
        object.__setattr__(self, "pose", pose)

    def components(self) -> PoseMixture:
        """Return the prior as a normal distribution."""
        covariance = np.diag(np.array([self.sigma_m, self.sigma_m, self.sigma_rad]) ** 2)
        return PoseMixture(np.asarray(self.pose)[None], covariance[None], np.zeros(1))

    def share_in(self, grid: "Grid") -> float:
        """Compute the probability of a position on the map's grid."""
        low, high = (np.array(grid.extent_m[side::2]) for side in (0, 1))
        xy = np.asarray(self.pose)[:2]
        return float(np.prod(ndtr((high - xy) / self.sigma_m) - ndtr((low - xy) / self.sigma_m)))


@dataclass(frozen=True, eq=False)
class Localization:
    """Posteriors of the poses of scans. Moments, modes and probabilities are those of the last scan."""

    beliefs: tuple[PoseBelief, ...]  # posterior of each scan's pose, given all scans up to it
    frame: str = "laser"  # frame on the robot whose poses these are, "base" or "laser"

    def __len__(self) -> int:
        return len(self.beliefs)

    def __repr__(self) -> str:
        """Return four or five lines: size, and the belief about the last scan."""
        last = repr(self.last).split("\n", 1)[1] if self.beliefs else "  no scan"
        return f"Localization: {len(self):,} scans; of the last one:\n{last}"

    @property
    def last(self) -> PoseBelief:
        """The posterior of the last scan."""
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
        """The modes of the posterior, the likeliest first."""
        return self.last.modes

    @property
    def p_lost(self) -> float:
        """Probability that the robot is not on the map, or the map outdated."""
        return self.last.p_lost

    def region(self, level: float = 0.95) -> Region:
        """Return the smallest region of positions that holds the probability ``level``."""
        return self.last.region(level)

    def probability_in(self, area: ArrayLike) -> float:
        """Return the probability of being in a polygon (K, 2), or in (x_min, x_max, y_min, y_max)."""
        return self.last.probability_in(np.asarray(area, dtype=np.float64))

    def trajectory(self) -> Trajectory:
        """Return means and covariances of all scans' poses."""
        stamps = [belief.stamp_s for belief in self.beliefs]
        stamps_s = None if None in stamps else np.array(stamps, dtype=np.float64)
        poses = np.array([belief.mean for belief in self.beliefs])
        return Trajectory(poses, stamps_s, np.array([belief.covariance for belief in self.beliefs]), frame=self.frame)

    def of(self, frame: str | None, mount: Floats | None) -> "Localization":
        """Return the posteriors of the robot's "base", or of its "laser" at ``mount``, (3,). See `step_to`."""
        new_frame, step = step_to(frame, mount, self.frame)
        return Localization(self.beliefs if step is None else tuple(b.of_frame(step) for b in self.beliefs), new_frame)


@near_names
def localize(
    run: Any, scans: Scans, *, prior: InitialPose | None = None, odometry: Odometry | None = None,
    independent: bool = False, seed: int = 0, device: str = "cpu",
    on_belief: Callable[[int, PoseBelief], None] | None = None,
) -> Localization:  # fmt: skip
    """Locate scans in the map of a run.

    Args:
        run: a run with draws, or a `KnownMap` of one, which need not be prepared again.
        scans: one scan, or several in order of time. Their poses are odometry: only motions count.
        prior: prior of the first scan's pose; None if it may be anywhere in the map.
        odometry: errors of the motions; by default those of a usual robot.
        independent: True to locate each scan by itself, without odometry.
        seed: seed of the draws of poses.
        device: "cpu", or a CUDA device such as "cuda:0", that weights poses; a `KnownMap` has its own.
        on_belief: function that is called with the number of each scan and its posterior.

    Raises `BadInput` for no scan, a run without draws, no such device, a sensor model of the user's own, a prior that
    lies outside the map, or arguments of another kind.
    """
    if not isinstance(scans, Scans):
        raise BadInput(f"localize: scans must be those that bm.read_log gives, got {scans!r}")
    if len(scans) == 0:
        raise BadInput("localize: there is no scan")
    beliefs = []
    located = follow(known_map_of(run, device), scans, prior, odometry, independent=independent, seed=seed)
    for number, belief in enumerate(located):
        beliefs.append(belief)
        if on_belief is not None:
            on_belief(number, belief)
    return Localization(tuple(beliefs))


def follow(
    known_map: KnownMap, scans: Scans | Iterable[Scans], prior: InitialPose | None = None,
    odometry: Odometry | None = None, *, independent: bool = False, seed: int = 0,
) -> Iterator[PoseBelief]:  # fmt: skip
    """Yield the posterior of each scan before the next scan is read. The arguments are those of `localize`."""
    odometry = Odometry() if odometry is None else odometry
    trust = known_map.trust
    _check_arguments(known_map, prior, odometry)
    rng = np.random.default_rng(check_count("localize", "seed", seed, 0))
    p_missed = 0.0 if known_map.reference_fit is None else known_map.reference_fit.missed
    p_alike = P_ALIKE * P_LOST_AT_FIRST
    anywhere = Prior(p_lost=max(P_LOST_AT_FIRST, p_missed), p_alike=p_alike)
    pose_prior = anywhere
    if prior is not None:
        pose_prior = Prior(prior.components(), trust.p_carried, p_lost=P_LOST_AT_FIRST, p_alike=p_alike)
    belief, pose, since_search_m = None, np.zeros(3), 0.0
    singles = (scans.select(slice(i, i + 1)) for i in range(len(scans))) if isinstance(scans, Scans) else scans
    for single in singles:
        pose_before, pose = pose, single.poses[0]
        new_share = 1.0  # share of the scan's evidence that is new
        # Predict by odometry; after a short path only part of the scan's evidence is new.
        if independent:
            pose_prior = anywhere
        elif belief is not None:
            motion = between(pose_before, pose)
            path_m = float(np.hypot(motion[0], motion[1]) + TURN_M * abs(motion[2]))
            since_search_m += path_m
            if path_m < trust.shared_path_m:
                new_share = max(MIN_NEW_SHARE, path_m / trust.shared_path_m)
            pose_prior = predict(belief, motion, odometry.sigmas(motion), trust, path_m, new_share)
        # Search the whole map if the pose is uncertain, or after a long path.
        is_unsure = belief is None or belief.p_lost > SURE_P_LOST or belief.modes[0].probability < MIN_SURE_PROBABILITY
        search_all = independent or is_unsure or since_search_m >= trust.search_path_m
        if search_all:
            since_search_m = 0.0
        belief = update(known_map, pose_prior, _scan_of(single, new_share), rng, look_everywhere=search_all)
        yield belief


def _scan_of(single: Scans, new_share: float) -> Scan:
    """Return a single scan as the filter takes it."""
    stamp_s = None if single.stamps_s is None else float(single.stamps_s[0])
    limits = RangeLimits(single.min_range_m, single.max_range_m)
    angles, ranges = single.beams_of(0)
    if not len(angles):  # a beam without a reading has no evidence, like no beam
        angles, ranges = single.angles_rad, single.ranges_m[0]
    return Scan(angles, ranges, limits, stamp_s, new_share)


def known_map_of(run: Any, device: str) -> KnownMap:
    """Return the prepared map of a run. Raises `BadInput` for anything that is neither a run nor a `KnownMap`."""
    if isinstance(run, KnownMap):
        return run
    if not hasattr(run, "posterior"):
        raise BadInput(f"localize: give a run, such as bm.load gives, or a KnownMap of one, got {run!r}")
    return KnownMap.of_run(run, device=device)


def _check_arguments(known_map: KnownMap, prior: InitialPose | None, odometry: Odometry) -> None:
    """Raise `BadInput` for a prior or odometry of another type, and for a prior outside the map."""
    if not isinstance(odometry, Odometry):
        raise BadInput(f"localize: odometry must be such as bm.Odometry(), got {odometry!r}")
    if prior is None:
        return
    if not isinstance(prior, InitialPose):
        raise BadInput(f"localize: prior must be such as bm.InitialPose((x, y, yaw)), or None: anywhere; got {prior!r}")
    if prior.share_in(known_map.grid) < MIN_MAP_PROBABILITY:
        (x0, x1, y0, y1), (x, y) = known_map.grid.extent_m, np.asarray(prior.pose)[:2]
        raise BadInput(
            f"prior: ({x:g}, {y:g}) +- {prior.sigma_m:g} m lies outside the map, which is from {x0:g} to {x1:g} m in x "
            f"and from {y0:g} to {y1:g} m in y"
        )


def predict(
    belief: PoseBelief, motion: Floats, sigmas: Floats, trust: Trust, path_m: float, new_share: float = 1.0
) -> Prior:
    """Return the prior of the pose after a motion in the frame of the pose before, (3,), with deviations (3,)."""
    modes = belief.modes_above(float(np.exp(-trust.forgotten_nats)))
    means = np.array([mode.mean for mode in modes])
    covariances = np.array([mode.covariance for mode in modes])
    ends = compose(means, motion)
    jacobian, to_world = frame_jacobians(np.zeros(len(means)), ends - means), rotation(means[:, 2])
    noise = to_world @ np.diag(sigmas**2 + MIN_SIGMA**2) @ np.swapaxes(to_world, 1, 2)
    log_mass = np.log([mode.probability for mode in modes])
    components = PoseMixture(ends, jacobian @ covariances @ np.swapaxes(jacobian, 1, 2) + noise, log_mass)
    # A lost robot may return to any position.
    p_lost, p_alike, p_returned = predict_lost(belief.p_lost, belief.p_alike, path_m)
    p_carried = new_share * trust.p_carried
    uniform_share = p_carried + (1.0 - p_carried) * min(p_returned, MAX_P_RETURNED)
    return Prior(components, uniform_share, p_lost=p_lost, p_alike=p_alike)


def predict_lost(p_lost: float, p_alike: float, path_m: float) -> tuple[float, float, float]:
    """Return ``p_lost``, ``p_alike`` (as in `Prior`) and the probability of return to the map, after a path."""
    moved_share = min(path_m / LOST_PATH_M, 1.0)
    share, p_unlike = max(moved_share, MIN_NEW_SHARE), moved_share * P_UNLIKE
    # The share of the alike places stays `P_ALIKE`, as long as no scan tells more.
    p_elsewhere = p_lost - p_alike
    p_got_lost = share * P_GETS_LOST * (1.0 - p_lost)
    p_returned = share * P_FOUND * p_elsewhere
    p_alike += p_unlike * (P_ALIKE / (1.0 - P_ALIKE) * p_elsewhere - p_alike) + P_ALIKE * p_got_lost
    return p_lost + p_got_lost - p_returned, p_alike, p_returned
