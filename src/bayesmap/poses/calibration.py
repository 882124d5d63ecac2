"""Calibration of odometry and of the laser's beam angles from the scans.

Systematic errors. Wheels may have other sizes than assumed, the base another width, and the laser may be beside the
point that odometry follows. To first order odometry then states

    stated = (1 + C) true - lag (v_end - v_begin).

C is a constant matrix. Scan matching gives the true motion. v is the stated velocity at the motion's begin and end: if
odometry's stamps are late by ``lag``, its motion is that of another interval. The stated motion is regressed on the
matched one, which has smaller errors. (In the opposite regression, the noise of a robot that drives straight on would
look like a scale of 0.) A stated motion is corrected by 1 + B = 1 / (1 + C).
`RunningOdometry` learns C and the noise during the front end, by recursive least squares. `fit_odometry` fits C,
the lag and the noise to aligned key scans, by robust least squares.

Noise. Over n scans, d metres and turns of a radians in all (absolute values summed), the errors of x, y and yaw, in the
frame of the motion, have the variances

    v = per_m d + per_rad a + per_scan n.

So the variances of parts of a motion add up to that of the whole, with 1 scan per second as with 10. (The squares of
`bayesmap.poses.prior.Odometry` do not: ten short motions have a tenth of the variance of the whole motion.)

Angles. A scan with a wrong angle between its beams is stretched around the laser, so that scans do not fit each other.
The angle with the lowest residual is estimated. The first beam's angle stays as stated, because a turn of all beams is
a turn of the laser on the robot, which B contains.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.poses.prior import Odometry
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.space.planar import Floats, between, interpolate, wrap_angle, wrap_yaw
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import elapsed_s, repeated_stamps

FAST_M_PER_S = 3.0  # greatest possible speed of a robot: faster motions count as impossible
COMMON = Odometry(0.1, 0.05, 0.05, 0.1, 0.01, 0.01)  # noise of ordinary robots; a robot's noise is a multiple
FIRST_RATIO, PRIOR_COUNT = 3.0, 12.0  # prior of this multiple, and the number of motions that the prior counts as
MEMORY = 300.0  # number of motions over which the noise is averaged, since floors differ
SLOPE_SIGMA = 0.15  # prior standard deviation of the entries of C: 15 % of the motion


def stated_motions(poses: Floats, stamps_s: Floats | None) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the motions from scan to scan in the earlier one's frame, (S - 1, 3), and which are impossible, (S - 1,).

    Repeated stamps bound the time of a motion. A motion is impossible if it is too fast for the longest time, or if it
    is much longer than usual and too fast for the shortest time.
    """
    motions = between(poses[:-1], poses[1:])
    length = np.hypot(motions[:, 0], motions[:, 1])
    unusual = length > max(2.0, 20.0 * float(np.median(length)) if len(length) else 2.0)
    if stamps_s is None:
        return motions, unusual
    least_s, most_s = elapsed_s(stamps_s)
    return motions, (length > _farthest_m(most_s)) | (unusual & (length > _farthest_m(least_s)))


def _farthest_m(elapsed: Floats) -> Floats:
    return np.asarray(FAST_M_PER_S * (elapsed + 0.3) + 0.5)


def motion_variances(motions: Floats, ratios: Floats) -> Floats:
    """Return variances of x, y and yaw of motions, (..., 3), whose noise is ``ratios`` times `COMMON`. ``ratios`` are
    those of position and heading, (2,). A heading error half-way moves the rest of a motion sideways.
    """
    variance = (COMMON.sigmas(motions) * ratios[[0, 0, 1]]) ** 2
    lever_m = 0.5 * np.hypot(motions[..., 0], motions[..., 1])
    variance[..., :2] += (lever_m**2 * variance[..., 2])[..., None]
    return np.asarray(variance)


def inverse_slope(systematic: Floats) -> Floats:
    """Return B = 1 / (1 + C) - 1, (3, 3): the correction of a motion that is stated as (1 + C) times the true one."""
    return np.asarray(np.linalg.inv(np.eye(3) + systematic) - np.eye(3))


class RunningOdometry:
    """The systematic error and the size of the noise of odometry, learnt motion by motion."""

    def __init__(self) -> None:
        self._normal = np.eye(3)
        self._moment = np.zeros((3, 3))
        self._squares = np.array([PRIOR_COUNT * FIRST_RATIO**2] * 2)
        self._count = PRIOR_COUNT
        self._systematic: Floats = np.zeros((3, 3))
        self._slope: Floats = np.zeros((3, 3))

    @property
    def slope(self) -> Floats:
        """B = 1 / (1 + C) - 1, (3, 3): the correction of a stated motion is B times this motion."""
        return self._slope

    @property
    def ratios(self) -> Floats:
        """The noise of the position and of the heading as multiples of `COMMON`, (2,)."""
        return np.asarray(np.clip(np.sqrt(self._squares / self._count), 0.5, 30.0))

    def corrected(self, motions: Floats) -> Floats:
        """Return stated motions with the systematic error removed, (..., 3)."""
        return wrap_yaw(motions + motions @ self._slope.T)

    def variances(self, motions: Floats) -> Floats:
        """Return variances of x, y and yaw of each motion's remaining error, (..., 3)."""
        return motion_variances(motions, self.ratios)

    def learn_slope(self, stated: Floats, matched: Floats, laser_variance: Floats) -> None:
        """Learn the systematic error from a longer motion: as stated, as matched, and the matching's variance, (3,)."""
        error = wrap_yaw(stated - matched)
        variance = self.variances(stated) + laser_variance
        rest = wrap_yaw(error - self._systematic @ matched)
        if not (rest**2 < 16.0 * variance).all():
            return
        # One weight for the three: the entries of C share a normal matrix.
        gain = float(np.exp(-np.mean(np.log(np.maximum(variance, 1e-6))))) * SLOPE_SIGMA**2
        self._normal += gain * np.outer(matched, matched)
        self._moment += gain * np.outer(error, matched)
        self._systematic = np.asarray(np.linalg.solve(self._normal, self._moment.T).T, np.float64)
        self._slope = inverse_slope(self._systematic)

    def learn_noise(self, stated: Floats, matched: Floats, laser_variance: Floats) -> None:
        """Learn the noise from a motion from scan to scan: as stated, as matched, and the matching's variance, (3,)."""
        rest = wrap_yaw(matched - stated - self._slope @ stated)
        base = COMMON.sigmas(stated) ** 2
        excess = np.maximum(rest**2 - laser_variance, 0.0) / base
        keep = 1.0 - 1.0 / MEMORY
        limit = 25.0 * self._squares / self._count
        self._squares = keep * self._squares + np.minimum([0.5 * (excess[0] + excess[1]), excess[2]], limit)
        self._count = keep * self._count + 1.0


USUAL = np.array([[1e-3, 1e-3, 1e-5], [5e-4, 5e-4, 1e-5], [1e-3, 2e-3, 1e-6]])
"""Variance rates of ordinary robots: rows x, y, yaw; columns per metre, per radian, per scan."""

FACTOR_SIGMA = np.log(10.0)  # prior standard deviation of the logarithm of each rate: a factor of ten either way
TELLING_SHARE = 0.5  # a motion is fitted if its matched variance is below this share of the expected one
MIN_FITTED_MOTIONS = 20
MAX_LOG = 9.0  # greatest size of the logarithm of a rate, in units of `USUAL`

DEGREES_OF_FREEDOM = 4.0
CONSISTENT = 1.2718  # 1 / E[(nu + 1) z^2 / (nu + z^2)] for a standard normal z and nu = 4


@dataclass(frozen=True, eq=False)
class MotionNoise:
    """Variance rates of x, y and yaw (rows) per metre, per radian and per scan (columns), (3, 3)."""

    rates: Floats

    def variances(self, motions: Floats) -> Floats:
        """Return variances of x, y and yaw of motions from scan to scan, (..., 3)."""
        ways, turns = np.hypot(motions[..., 0], motions[..., 1]), np.abs(motions[..., 2])
        return self.over(ways, turns, np.ones_like(ways))

    def over(self, ways_m: Floats, turns_rad: Floats, scans: Floats) -> Floats:
        """Return variances of x, y and yaw over path lengths, total turns and numbers of scans, (..., 3)."""
        return np.asarray(_features(ways_m, turns_rad, scans) @ self.rates.T)

    def of_scans(self, motions: Floats) -> Odometry:
        """Return the noise as parameters of `Odometry` that give equal total variances over motions, (S - 1, 3)."""
        ways, turns = np.hypot(motions[:, 0], motions[:, 1]), np.abs(motions[:, 2])
        per_m = ways.sum() / max(float((ways**2).sum()), 1e-12)
        per_rad = turns.sum() / max(float((turns**2).sum()), 1e-12)
        place, yaw = self.rates[:2].mean(axis=0), self.rates[2]
        return Odometry(
            float(np.sqrt(place[0] * per_m)), float(np.sqrt(place[1] * per_rad)), float(np.sqrt(yaw[0] * per_m)),
            float(np.sqrt(yaw[1] * per_rad)), float(np.sqrt(place[2])), float(np.sqrt(yaw[2])),
        )  # fmt: skip


def fit_noise(
    errors: Floats, ways_m: Floats, turns_rad: Floats, scans: Floats, known_variance: Floats,
    expected_variance: Floats | None = None,
) -> MotionNoise:  # fmt: skip
    """Fit variance rates to errors of M motions by maximum likelihood under a wide prior.

    The cost of an error e of variance v is log v / 2 + 1.27 (nu + 1) / 2 log(1 + e^2 / (nu v)): Student's t with
    nu = 4, made consistent for the normal distribution and robust against slips.

    Each motion has a path length, a total turn (of absolute values) and a number of scans, (M,). ``known_variance`` is
    that of the motions as estimated by odometry and laser together, (M, 3). ``expected_variance`` is that of odometry's
    errors before the fit, (M, 3); by default an ordinary robot's.
    """
    features = _features(ways_m, turns_rad, scans)
    usual = features @ USUAL.T
    expected = usual if expected_variance is None else expected_variance
    # With too few informative motions, the noise is as expected, and no less than usual.
    rates = USUAL * np.maximum(1.0, expected.sum(axis=0) / np.maximum(usual.sum(axis=0), 1e-12))[:, None]
    for axis in range(3):
        # Use motions that the laser measures much more precisely than odometry.
        tells = known_variance[:, axis] < TELLING_SHARE * expected[:, axis]
        if tells.sum() >= MIN_FITTED_MOTIONS:
            rates[axis] = _rates(errors[tells, axis], features[tells], known_variance[tells, axis], USUAL[axis])
    return MotionNoise(rates)


def _rates(errors: Floats, features: Floats, known_variance: Floats, usual: Floats) -> Floats:
    """Fit the rates of one axis, (3,), by L-BFGS in their logarithms.

    The motions were estimated with odometry. So the mean square of its error is that of the residual plus the motions'
    variance. Products are summed without BLAS, whose threads would take longer to meet than to add.
    """
    from scipy.optimize import minimize

    nu, squares = DEGREES_OF_FREEDOM, errors**2 + known_variance

    def cost(log_factors: Floats) -> tuple[float, Floats]:
        parts = features * (usual * np.exp(log_factors))
        variance = parts.sum(axis=1)
        ratio = squares / (nu * variance)
        slopes = 0.5 / variance - 0.5 * CONSISTENT * (nu + 1.0) * ratio / (1.0 + ratio) / variance
        value = 0.5 * np.log(variance).sum() + 0.5 * CONSISTENT * (nu + 1.0) * np.log1p(ratio).sum()
        prior = log_factors / FACTOR_SIGMA
        slope = (slopes[:, None] * parts).sum(axis=0) + prior / FACTOR_SIGMA
        return float(value + 0.5 * (prior**2).sum()), slope

    optimum = minimize(cost, np.zeros(3), jac=True, method="L-BFGS-B", bounds=[(-MAX_LOG, MAX_LOG)] * 3)
    return np.asarray(usual * np.exp(optimum.x))


def _features(ways_m: Floats, turns_rad: Floats, scans: Floats) -> Floats:
    return np.stack([ways_m, turns_rad, scans], axis=-1).astype(np.float64)


VELOCITY_OVER_S = 0.4  # time over which a stated velocity is averaged, seconds
LAG_SIGMA_S, MOST_LAG_S = 0.2, 0.5  # prior standard deviation and greatest size of the lag
PAIRS = 400  # most pairs of scans from which the angle between beams is estimated

JACKKNIFE_GROUPS = 20
MIN_STANDARD_ERRORS = 4.0  # standard errors beyond which the angle is changed
MIN_STANDARD_ERRORS_TO_REGULAR = 2.0  # the same, if the new angle is within one standard error of a regular angle

REGULAR_WITHIN = 0.005  # relative accuracy of the estimated angle between beams


@dataclass(frozen=True, eq=False)
class OdometryFit:
    """The errors of odometry."""

    slope: Floats  # matrix B, (3, 3)
    systematic_covariance: Floats  # covariance of the entries of C, row by row, (9, 9)
    lag_s: float  # delay of odometry's stamps, seconds: the motion from t to t' is stated for t + lag to t' + lag
    lag_sigma_s: float  # standard deviation of the lag, seconds
    noise: MotionNoise  # variance rates of the remaining errors

    @property
    def slope_sigma(self) -> Floats:
        """Standard deviations of B's entries to first order, (3, 3)."""
        return np.asarray(np.sqrt(np.diag(self.systematic_covariance)).reshape(3, 3))

    def shifts(self, corrected: Floats) -> Floats:
        """Return the changes of corrected motions, (M, 3), by the standard errors of C, (9, M, 3). The changes are
        independent of each other. A change dC of C changes B by -(1 + B) dC (1 + B).
        """
        values, vectors = np.linalg.eigh(self.systematic_covariance)
        changes = (vectors * np.sqrt(np.maximum(values, 0.0))).T.reshape(9, 3, 3)
        return np.asarray(-corrected @ np.swapaxes((np.eye(3) + self.slope) @ changes, 1, 2))


def stated_at(poses: Floats, stamps_s: Floats | None, lag_s: float) -> Floats:
    """Return odometry's poses at the scans' stamps, (S, 3), if its own stamps are late by ``lag_s``. Scans that share
    their stamp with others keep their poses.
    """
    if stamps_s is None or lag_s == 0.0:
        return poses
    late = interpolate(stamps_s, poses, stamps_s + lag_s)
    return np.where(repeated_stamps(stamps_s)[:, None], poses, late)


def velocities(poses: Floats, stamps_s: Floats) -> Floats:
    """Compute the mean stated velocity about each scan, in the scan's frame, (S, 3)."""
    half = 0.5 * VELOCITY_OVER_S
    begin, end = np.clip(stamps_s - half, *stamps_s[[0, -1]]), np.clip(stamps_s + half, *stamps_s[[0, -1]])
    motion = between(interpolate(stamps_s, poses, begin), interpolate(stamps_s, poses, end))
    return np.asarray(motion / np.maximum(end - begin, 1e-3)[:, None])


def fit_odometry(
    stated: Floats, stamps_s: Floats | None, known: Floats, scans: NDArray[np.intp], laser_variance: Floats,
    expected_variance: Floats | None = None,
) -> OdometryFit:  # fmt: skip
    """Fit B, the lag and the noise to K of the scans whose poses are ``known``, (K, 3); their indices ascend.

    ``stated`` are odometry's poses of all scans, (S, 3). Without stamps, (S,), the lag is 0; scans with equal stamps do
    not affect it. ``laser_variance`` is that of the known motions, (K - 1, 3): large along corridors.
    ``expected_variance`` is that of odometry's errors before the fit, (K - 1, 3); by default an ordinary robot's.
    """
    # Errors of odometry between known scans, and the changes of velocity that a lag multiplies.
    motion = between(known[:-1], known[1:])
    error = wrap_yaw(between(stated[scans[:-1]], stated[scans[1:]]) - motion)
    change = np.zeros_like(motion)
    if stamps_s is not None:
        speed, told = velocities(stated, stamps_s), ~repeated_stamps(stamps_s)[scans]
        change = np.where((told[:-1] & told[1:])[:, None], speed[scans[:-1]] - speed[scans[1:]], 0.0)
    timed = change.any()
    steps = between(stated[:-1], stated[1:])
    ways, turns = (_over(size, scans) for size in (np.hypot(steps[:, 0], steps[:, 1]), np.abs(steps[:, 2])))
    parts = np.diff(scans).astype(np.float64)
    noise = fit_noise(error, ways, turns, parts, laser_variance, expected_variance)
    # Ten coefficients: the entries of C, and the lag. Alternate robust least squares and the fit of the noise.
    coefficients = np.zeros(10)
    covariance = np.eye(10)
    for _ in range(6):
        variance = laser_variance + noise.over(ways, turns, parts)
        normal = np.diag(np.append(np.full(9, SLOPE_SIGMA**-2.0), LAG_SIGMA_S**-2.0))
        moment = np.zeros(10)
        rest = _left(error, motion, change, coefficients)
        weight = 1.0 / variance / (1.0 + (rest**2 / variance).sum(axis=1, keepdims=True) / 9.0)
        for axis in range(3):
            design = np.zeros((len(motion), 10))
            design[:, 3 * axis : 3 * axis + 3] = motion
            design[:, 9] = change[:, axis]
            normal += design.T @ (design * weight[:, axis : axis + 1])
            moment += design.T @ (error[:, axis] * weight[:, axis])
        coefficients = np.asarray(np.linalg.solve(normal, moment), np.float64)
        coefficients[9] = np.clip(coefficients[9], -MOST_LAG_S, MOST_LAG_S)
        covariance = np.linalg.inv(normal)
        rest = _left(error, motion, change, coefficients)
        noise = fit_noise(rest, ways, turns, parts, laser_variance, expected_variance)
    lag_s = float(coefficients[9]) if timed else 0.0
    slope = inverse_slope(coefficients[:9].reshape(3, 3))
    return OdometryFit(slope, covariance[:9, :9], lag_s, float(np.sqrt(covariance[9, 9])), noise)


def _left(error: Floats, motion: Floats, change: Floats, coefficients: Floats) -> Floats:
    return wrap_yaw(error - motion @ coefficients[:9].reshape(3, 3).T - coefficients[9] * change)


def _over(sizes: Floats, scans: NDArray[np.intp]) -> Floats:
    """Return sums of sizes of motions from scan to scan, (S - 1,), between the given scans, (K - 1,)."""
    return np.asarray(np.diff(np.concatenate([[0.0], np.cumsum(sizes)])[scans]))


def angle_step_ratio(
    scans: Scans, poses: Floats, source: NDArray[np.integer], target: NDArray[np.integer], *,
    farthest_m: float | None = None, threads: int | None = None,
) -> float:  # fmt: skip
    """Estimate the angle between beams, divided by the stated one, by the lowest residual of pairs of scans.

    Stretched scans still fit each other if they look the same way. So the pairs that are compared are turned against
    each other.

    ``source`` and ``target`` are pairs of overlapping scans at poses (S, 3). Hits beyond ``farthest_m`` are left out.
    The ratio is 1 if no scans are turned against each other, if the estimate is not significant, or if the beams of a
    scan go full circle: the number of beams then says the angle.
    """
    step = float(np.nanmedian(scans.steps_rad)) if scans.steps_rad.size else np.pi
    if np.median(scans.sweep_rad) + 1.5 * step > 2.0 * np.pi:
        return 1.0
    turned = np.abs(wrap_angle(poses[source, 2] - poses[target, 2]))
    useful = np.nonzero((turned > np.radians(25.0)) & (turned < np.radians(130.0)))[0]
    if len(useful) < 20:
        return 1.0
    useful = useful[np.arange(min(len(useful), PAIRS)) * len(useful) // min(len(useful), PAIRS)]
    needed, at = np.unique(np.concatenate([source[useful], target[useful]]), return_inverse=True)
    first, second = at[: len(useful)].astype(np.int32), at[len(useful) :].astype(np.int32)
    selected, selected_poses = scans.select(needed), poses[needed]
    weak = np.tile(np.diag([25.0, 25.0, 100.0]), (len(useful), 1, 1))
    offsets = np.arange(len(useful) + 1, dtype=np.int32)

    def residuals(factor: float) -> Floats:
        geometry = scan_geometry(selected.stretched(factor), farthest_m=farthest_m, threads=threads)
        # Beams are stretched from the first one. Turn the pose back, so that the middle beam keeps its direction.
        start = selected_poses.copy()
        start[:, 2] -= 0.5 * (factor - 1.0) * selected.sweep_rad
        jobs = Refinement(first, offsets, second, start[second], start[first], start[first], weak)
        convergence = Convergence(0.02, 10, geometry.reach_m(0.2, 0.15), geometry.scale_m(0.05, 0.03), 0.7)
        _, _, totals = refine_scans(geometry, jobs, convergence, threads)
        return 1.0 - totals[:, 1] / np.maximum(totals[:, 3], 1.0)

    factors = 1.0 + np.linspace(-0.0125, 0.0125, 11)
    values = np.array([residuals(float(f)) for f in factors])
    lowest = _lowest(factors, values.mean(axis=1))
    groups = np.arange(len(useful)) % JACKKNIFE_GROUPS
    without = np.array([_lowest(factors, values[:, groups != group].mean(axis=1)) for group in range(JACKKNIFE_GROUPS)])
    # The jackknife's standard error (Efron and Tibshirani 1993, ch. 11).
    error = np.sqrt((JACKKNIFE_GROUPS - 1) / JACKKNIFE_GROUPS * ((without - without.mean()) ** 2).sum())
    if not abs(lowest - 1.0) <= 0.0125:
        return 1.0  # outside the range that was tried
    regular = _regular(lowest, float(np.degrees(step)))
    sure = (
        MIN_STANDARD_ERRORS_TO_REGULAR if regular != lowest and abs(lowest - regular) < error else MIN_STANDARD_ERRORS
    )
    return regular if abs(lowest - 1.0) > sure * error else 1.0


def _lowest(factors: Floats, values: Floats) -> float:
    """Return the minimum of the parabola through values; NaN if it has none."""
    bend, tilt, _ = np.polyfit(factors - 1.0, values, 2)
    return float(1.0 - tilt / (2.0 * bend)) if bend > 0.0 else float("nan")


def _regular(factor: float, stated_deg: float) -> float:
    """Return the factor of the nearest regular angle, as stated or a multiple of 1/8 degree, if it is as likely."""
    regular = round(8.0 * factor * stated_deg) / 8.0 / stated_deg
    nearest = min((1.0, regular), key=lambda f: abs(factor - f))
    return nearest if regular > 0 and abs(factor / nearest - 1.0) < REGULAR_WITHIN else factor
