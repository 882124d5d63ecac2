"""Calibrate odometry and the laser's beam angles from the scans.

* `RunningOdometry` learns systematic error and noise during the front end. To first order odometry states
  (1 + C) true - lag (v_end - v_begin), where C is a constant matrix (scale, bias, the laser's place) and v the stated
  velocity at the motion's begin and end. The correction is 1 + B = 1 / (1 + C). The stated motion is regressed on the
  matched one, which has smaller errors: in the opposite regression, noise would look like a scale below 1.
* `fit_odometry` fits C, the lag and the noise to aligned key scans. Over n scans, d metres and turns of a radians, the
  errors of x, y and yaw have the variances per_m d + per_rad a + per_scan n (`fit_noise`). They add up over parts of a
  motion, at any rate of scans, unlike the squares of `bayesmap.poses.prior.Odometry`.
* `angle_step_ratio` estimates the angle between beams: with a wrong one, scans are stretched and do not fit each other.
  The first beam's angle stays as stated, because a turn of all beams is a turn of the laser, which B contains.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import SEEN, WEIGHT
from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.poses.prior import Odometry
from bayesmap.poses.scan_geometry import ScanGeometry, scan_geometry
from bayesmap.space.arrays import Indices, Mask, evenly_spaced, matrix_roots
from bayesmap.space.planar import Floats, between, interpolate, lengths_and_turns, wrap_angle, wrap_yaw
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import elapsed_bounds_s, repeated_stamps

MAX_SPEED_M_PER_S = 3.0  # largest speed of a robot: faster motions count as impossible
UNUSUAL_M, UNUSUAL_RATIO = 2.0, 20.0  # a motion is unusual if longer: metres, and multiples of the median length
STAMP_ERROR_S, MOTION_ERROR_M = 0.3, 0.5  # errors of a time between stamps and of a stated motion that are allowed for
ORDINARY_ODOMETRY = Odometry(still_m=0.01, still_rad=0.01)  # a robot's noise is a multiple of this noise
PRIOR_RATIO = 3.0  # prior value of this multiple
PRIOR_COUNT = 12.0  # number of motions that the prior value counts as
RATIO_RANGE = (0.5, 30.0)  # credible values of this multiple
MAX_SLOPE_SIGMAS, MAX_NOISE_SIGMAS = 4.0, 5.0  # outliers for the slope; a motion counts to the noise as at most this
MEMORY_MOTIONS = 300.0  # number of motions over which the noise is averaged, since floors differ
SLOPE_SIGMA = 0.15  # prior standard deviation of the entries of C: 15 % of the motion
ORDINARY_RATES = np.array([[1e-3, 1e-3, 1e-5], [5e-4, 5e-4, 1e-5], [1e-3, 2e-3, 1e-6]])
"""Variance rates of ordinary robots: rows x, y, yaw; columns per metre, per radian, per scan."""

FACTOR_SIGMA = np.log(10.0)  # prior standard deviation of the logarithm of each rate: a factor of ten either way
MAX_INFORMATIVE_SHARE = 0.5  # largest share of matched in expected variance of a fitted motion
MIN_FITTED_MOTIONS = 20  # fewest informative motions to which an axis is fitted
MAX_LOG = 9.0  # largest size of the logarithm of a rate, in units of `ORDINARY_RATES`
DEGREES_OF_FREEDOM = 4.0  # nu of Student's t in the cost
CONSISTENCY_FACTOR = 1.2718  # 1 / E[(nu + 1) z^2 / (nu + z^2)] for a standard normal z and nu = 4
VELOCITY_WINDOW_S = 0.4  # time over which a stated velocity is averaged, seconds
LAG_SIGMA_S = 0.2  # prior standard deviation of the lag
MAX_LAG_S = 0.5  # largest size of the lag, early or late
FIT_ROUNDS = 6  # rounds of robust least squares and of the fit of the noise
MAX_PAIRS = 400  # most pairs of scans from which the angle between beams is estimated
MIN_PAIRS = 20  # fewest pairs for an estimate
MIN_TURN_RAD, MAX_TURN_RAD = np.radians(25.0), np.radians(130.0)  # bounds on the turn between the two scans of a pair
MAX_STRETCH = 0.0125  # largest relative change of the angle that is tried
JACKKNIFE_GROUPS = 20  # groups of pairs, for the standard error of the angle
MIN_STANDARD_ERRORS = 4.0  # fewest standard errors by which the angle is changed
MIN_STANDARD_ERRORS_TO_REGULAR = 2.0  # fewest if a regular angle lies within one standard error
REGULAR_TOLERANCE = 0.005  # relative accuracy of the estimated angle between beams


def stated_motions(poses: Floats, stamps_s: Floats | None) -> tuple[Floats, Mask]:
    """Return the motions from scan to scan in the earlier one's frame, (S - 1, 3), and which are impossible, (S - 1,).
    Repeated stamps bound the time of a motion. A motion is impossible if it is too fast for the longest time, or if it
    is much longer than usual and too fast for the shortest time.
    """
    motions = between(poses[:-1], poses[1:])
    lengths_m, _ = lengths_and_turns(motions)
    median_m = float(np.median(lengths_m)) if len(lengths_m) else 0.0
    is_unusual = lengths_m > max(UNUSUAL_M, UNUSUAL_RATIO * median_m)
    if stamps_s is None:
        return motions, is_unusual
    bounds_s = elapsed_bounds_s(stamps_s)
    max_short_m, max_long_m = (MAX_SPEED_M_PER_S * (time + STAMP_ERROR_S) + MOTION_ERROR_M for time in bounds_s)
    return motions, (lengths_m > max_long_m) | (is_unusual & (lengths_m > max_short_m))


def motion_variances(motions: Floats, ratios: Floats) -> Floats:
    """Return variances of x, y and yaw of motions, (..., 3), with ``ratios``, (2,), times an ordinary robot's noise."""
    variance = (ORDINARY_ODOMETRY.sigmas(motions) * ratios[[0, 0, 1]]) ** 2
    lever_m = 0.5 * lengths_and_turns(motions)[0]  # a heading error arises half-way on average, and moves the end
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
        self._squares = np.array([PRIOR_COUNT * PRIOR_RATIO**2] * 2)
        self._count = PRIOR_COUNT
        self._systematic: Floats = np.zeros((3, 3))
        self.slope: Floats = np.zeros((3, 3))  # B: the correction of a stated motion is B times this motion

    @property
    def ratios(self) -> Floats:
        """The noise of the position and of the heading as multiples of `ORDINARY_ODOMETRY`, (2,)."""
        return np.asarray(np.clip(np.sqrt(self._squares / self._count), *RATIO_RANGE))

    def corrected(self, motions: Floats) -> Floats:
        """Return stated motions with the systematic error removed, (..., 3)."""
        return wrap_yaw(motions + motions @ self.slope.T)

    def variances(self, motions: Floats) -> Floats:
        """Return variances of x, y and yaw of each motion's remaining error, (..., 3)."""
        return motion_variances(motions, self.ratios)

    def learn_slope(self, stated: Floats, matched: Floats, laser_variance: Floats) -> None:
        """Learn the systematic error from a longer motion: as stated, as matched, and the matching's variance, (3,)."""
        error = wrap_yaw(stated - matched)
        variance = self.variances(stated) + laser_variance
        residual = wrap_yaw(error - self._systematic @ matched)
        if not (residual**2 < MAX_SLOPE_SIGMAS**2 * variance).all():
            return
        # One weight for the three: the entries of C share a normal matrix.
        gain = float(np.exp(-np.mean(np.log(np.maximum(variance, 1e-6))))) * SLOPE_SIGMA**2  # 1e-6: no infinite weight
        self._normal += gain * np.outer(matched, matched)
        self._moment += gain * np.outer(error, matched)
        self._systematic = np.asarray(np.linalg.solve(self._normal, self._moment.T).T, np.float64)
        self.slope = inverse_slope(self._systematic)

    def learn_noise(self, stated: Floats, matched: Floats, laser_variance: Floats) -> None:
        """Learn the noise from a motion from scan to scan: as stated, as matched, and the matching's variance, (3,)."""
        residual = wrap_yaw(matched - stated - self.slope @ stated)
        excess = np.maximum(residual**2 - laser_variance, 0.0) / ORDINARY_ODOMETRY.sigmas(stated) ** 2
        forgetting = 1.0 - 1.0 / MEMORY_MOTIONS
        limit = MAX_NOISE_SIGMAS**2 * self._squares / self._count
        self._squares = forgetting * self._squares + np.minimum([0.5 * (excess[0] + excess[1]), excess[2]], limit)
        self._count = forgetting * self._count + 1.0


@dataclass(frozen=True, eq=False)
class MotionNoise:
    """Variance rates of x, y and yaw (rows) per metre, per radian and per scan (columns), (3, 3)."""

    rates: Floats

    def variances(self, motions: Floats) -> Floats:
        """Return variances of x, y and yaw of motions from scan to scan, (..., 3)."""
        lengths_m, turns_rad = lengths_and_turns(motions)
        return np.asarray(np.stack([lengths_m, turns_rad, np.ones_like(lengths_m)], axis=-1) @ self.rates.T)

    def as_odometry(self, motions: Floats) -> Odometry:
        """Return the noise as parameters of `Odometry` that give equal total variances over motions, (S - 1, 3)."""
        lengths_m, turns_rad = lengths_and_turns(motions)
        per_m = lengths_m.sum() / max(float((lengths_m**2).sum()), 1e-12)
        per_rad = turns_rad.sum() / max(float((turns_rad**2).sum()), 1e-12)
        position, yaw = self.rates[:2].mean(axis=0), self.rates[2]
        squares = (position[0] * per_m, position[1] * per_rad, yaw[0] * per_m, yaw[1] * per_rad, position[2], yaw[2])
        return Odometry(*(float(np.sqrt(square)) for square in squares))


def fit_noise(
    errors: Floats, features: Floats, known_variance: Floats, expected_variance: Floats | None = None
) -> MotionNoise:
    """Fit variance rates to errors of M motions by maximum likelihood under a wide prior.

    The cost of an error e of variance v is log v / 2 + 1.27 (nu + 1) / 2 log(1 + e^2 / (nu v)): Student's t with
    nu = 4, made consistent for the normal distribution and robust against slips.
    The features of a motion are its path length, its total turn (of absolute values) and its number of scans, (M, 3).
    ``known_variance`` is the variance of the motions as estimated by odometry and laser together, (M, 3).
    ``expected_variance`` is the variance of odometry's errors before the fit, (M, 3); by default an ordinary robot's.
    """
    usual = features @ ORDINARY_RATES.T
    expected = usual if expected_variance is None else expected_variance
    # With too few informative motions, the noise is as expected, and no less than usual.
    rates = ORDINARY_RATES * np.maximum(1.0, expected.sum(axis=0) / np.maximum(usual.sum(axis=0), 1e-12))[:, None]
    for axis in range(3):
        # Use motions that the laser measures much more precisely than odometry.
        used = known_variance[:, axis] < MAX_INFORMATIVE_SHARE * expected[:, axis]
        if used.sum() >= MIN_FITTED_MOTIONS:
            variance = known_variance[used, axis]
            rates[axis] = _fit_rates(errors[used, axis], features[used], variance, ORDINARY_RATES[axis])
    return MotionNoise(rates)


def _fit_rates(errors: Floats, features: Floats, known_variance: Floats, usual: Floats) -> Floats:
    """Fit the rates of one axis, (3,), by L-BFGS in their logarithms.
    The motions were estimated with odometry. So the mean square of its error is the mean square of the residual plus
    the motions' variance. Products are summed without BLAS, whose threads would take longer to meet than to add.
    """
    from scipy.optimize import minimize

    data = (errors**2 + known_variance, features, usual)
    bounds = [(-MAX_LOG, MAX_LOG)] * 3
    optimum = minimize(_rate_cost, np.zeros(3), data, jac=True, method="L-BFGS-B", bounds=bounds)
    return np.asarray(usual * np.exp(optimum.x))


def _rate_cost(log_factors: Floats, squares: Floats, features: Floats, usual: Floats) -> tuple[float, Floats]:
    """Return the cost of rates at factors of the usual ones, given squared errors, (M,), and its gradient, (3,)."""
    nu = DEGREES_OF_FREEDOM
    contributions = features * (usual * np.exp(log_factors))
    variance = contributions.sum(axis=1)
    ratio = squares / (nu * variance)
    slopes = 0.5 / variance - 0.5 * CONSISTENCY_FACTOR * (nu + 1.0) * ratio / (1.0 + ratio) / variance
    value = 0.5 * np.log(variance).sum() + 0.5 * CONSISTENCY_FACTOR * (nu + 1.0) * np.log1p(ratio).sum()
    prior = log_factors / FACTOR_SIGMA
    gradient = (slopes[:, None] * contributions).sum(axis=0) + prior / FACTOR_SIGMA
    return float(value + 0.5 * (prior**2).sum()), gradient


@dataclass(frozen=True, eq=False)
class OdometryFit:
    """The errors of odometry."""

    slope: Floats  # matrix B of the correction, (3, 3)
    systematic_covariance: Floats  # covariance of the entries of C, row by row, (9, 9)
    lag_s: float  # delay of odometry's stamps, seconds: the motion from t to t' is stated for t + lag to t' + lag
    lag_sigma_s: float  # standard deviation of the lag, seconds
    noise: MotionNoise  # variance rates of the remaining errors

    @property
    def slope_sigma(self) -> Floats:
        """Standard deviations of B's entries to first order, (3, 3)."""
        return np.asarray(np.sqrt(np.diag(self.systematic_covariance)).reshape(3, 3))

    def shifts(self, corrected: Floats) -> Floats:
        """Return the changes of corrected motions, (M, 3), by the nine independent standard errors of C, (9, M, 3)."""
        changes = matrix_roots(self.systematic_covariance).T.reshape(9, 3, 3)  # dC changes B by -(1 + B) dC (1 + B)
        return np.asarray(-corrected @ np.swapaxes((np.eye(3) + self.slope) @ changes, 1, 2))


def compensate_lag(poses: Floats, stamps_s: Floats | None, lag_s: float) -> Floats:
    """Return odometry's poses at the scans' stamps, (S, 3), if it is late by ``lag_s``. Equal stamps keep theirs."""
    if stamps_s is None or lag_s == 0.0:
        return poses
    shifted = interpolate(stamps_s, poses, stamps_s + lag_s)
    return np.where(repeated_stamps(stamps_s)[:, None], poses, shifted)


def velocities(poses: Floats, stamps_s: Floats) -> Floats:
    """Compute the mean stated velocity about each scan, in the scan's frame, (S, 3)."""
    half = 0.5 * VELOCITY_WINDOW_S
    begin, end = np.clip(stamps_s - half, *stamps_s[[0, -1]]), np.clip(stamps_s + half, *stamps_s[[0, -1]])
    motion = between(interpolate(stamps_s, poses, begin), interpolate(stamps_s, poses, end))
    return np.asarray(motion / np.maximum(end - begin, 1e-3)[:, None])  # no division by zero


def fit_odometry(
    stated: Floats, stamps_s: Floats | None, key_poses: Floats, keys: Indices, laser_variance: Floats,
    expected_variance: Floats | None = None,
) -> OdometryFit:  # fmt: skip
    """Fit B, the lag and the noise to poses of key scans, (K, 3). The keys, (K,), ascend.

    ``stated`` are odometry's poses of all scans, (S, 3). Without stamps, (S,), the lag is 0; scans with equal stamps do
    not affect it. ``laser_variance`` is the variance of the keys' motions, (K - 1, 3): large along corridors.
    ``expected_variance`` is the variance of odometry's errors before the fit, (K - 1, 3); by default a usual robot's.
    """
    # Errors of odometry between key scans, and the changes of velocity that a lag multiplies.
    motion = between(key_poses[:-1], key_poses[1:])
    error = wrap_yaw(between(stated[keys[:-1]], stated[keys[1:]]) - motion)
    velocity_change = np.zeros_like(motion)
    if stamps_s is not None:
        velocity, is_timed = velocities(stated, stamps_s)[keys], ~repeated_stamps(stamps_s)[keys]
        velocity_change = np.where((is_timed[:-1] & is_timed[1:])[:, None], velocity[:-1] - velocity[1:], 0.0)

    def residuals(coefficients: Floats) -> Floats:
        return wrap_yaw(error - motion @ coefficients[:9].reshape(3, 3).T - coefficients[9] * velocity_change)

    # Path lengths, turns and numbers of scans between key scans, by sums over motions from scan to scan.
    totals = np.cumsum(lengths_and_turns(between(stated[:-1], stated[1:])), axis=1)
    lengths_m, turns_rad = np.diff(np.concatenate([[[0.0], [0.0]], totals], axis=1)[:, keys], axis=1)
    features = np.stack([lengths_m, turns_rad, np.diff(keys)], axis=-1)
    noise = fit_noise(error, features, laser_variance, expected_variance)
    # Ten coefficients: the entries of C, and the lag. Alternate robust least squares and the fit of the noise.
    coefficients = np.zeros(10)
    covariance = np.eye(10)
    for _ in range(FIT_ROUNDS):
        # Weight motions by their variance, and less beyond three standard deviations.
        variance = laser_variance + features @ noise.rates.T
        squares = (residuals(coefficients) ** 2 / variance).sum(axis=1, keepdims=True)
        weight = 1.0 / variance / (1.0 + squares / 9.0)
        # Sum the normal equations over x, y and yaw, from the priors on, and solve them.
        normal = np.diag(np.append(np.full(9, SLOPE_SIGMA**-2.0), LAG_SIGMA_S**-2.0))
        moment = np.zeros(10)
        for axis in range(3):
            design = np.zeros((len(motion), 10))
            design[:, 3 * axis : 3 * axis + 3] = motion
            design[:, 9] = velocity_change[:, axis]
            normal += design.T @ (design * weight[:, axis : axis + 1])
            moment += design.T @ (error[:, axis] * weight[:, axis])
        coefficients = np.asarray(np.linalg.solve(normal, moment), np.float64)
        coefficients[9] = np.clip(coefficients[9], -MAX_LAG_S, MAX_LAG_S)
        covariance = np.linalg.inv(normal)
        noise = fit_noise(residuals(coefficients), features, laser_variance, expected_variance)
    lag_s = float(coefficients[9]) if velocity_change.any() else 0.0
    slope = inverse_slope(coefficients[:9].reshape(3, 3))
    return OdometryFit(slope, covariance[:9, :9], lag_s, float(np.sqrt(covariance[9, 9])), noise)


def angle_step_ratio(
    scans: Scans, poses: Floats, source: NDArray[np.integer], target: NDArray[np.integer], *,
    farthest_m: float | None = None, threads: int | None = None,
) -> float:  # fmt: skip
    """Estimate the angle between beams, divided by the stated one, by the lowest residual of pairs of scans.

    ``source`` and ``target`` are pairs of overlapping scans at poses (S, 3). Only pairs turned against each other are
    compared, since stretched scans that look one way fit each other. Hits beyond ``farthest_m`` are left out. The ratio
    is 1 without such pairs or a significant estimate, or if beams go full circle: their number then says the angle.
    """
    step_rad = float(np.nanmedian(scans.steps_rad)) if scans.steps_rad.size else np.pi
    if np.median(scans.sweep_rad) + 1.5 * step_rad > 2.0 * np.pi:
        return 1.0
    # Select pairs that are turned against each other, and their scans.
    turns_rad = np.abs(wrap_angle(poses[source, 2] - poses[target, 2]))
    pairs = np.nonzero((turns_rad > MIN_TURN_RAD) & (turns_rad < MAX_TURN_RAD))[0]
    if len(pairs) < MIN_PAIRS:
        return 1.0
    pairs = evenly_spaced(pairs, MAX_PAIRS)
    used, ends = np.unique(np.stack([source[pairs], target[pairs]]), return_inverse=True)
    first, second = ends.reshape(2, -1).astype(np.int32)
    # Compute the residual of each pair with beams stretched by each factor.
    factors = 1.0 + np.linspace(-MAX_STRETCH, MAX_STRETCH, 11)
    selected = scans.select(used)
    values = np.empty((len(factors), len(pairs)))
    for k, factor in enumerate(factors.tolist()):
        geometry = scan_geometry(selected.stretched(factor), farthest_m=farthest_m, threads=threads)
        # Beams are stretched from the first one. Turn the pose back, so that the middle beam keeps its direction.
        start = poses[used]
        start[:, 2] -= 0.5 * (factor - 1.0) * selected.sweep_rad
        values[k] = _pair_residuals(geometry, start, first, second, threads)
    # Find the factor with the lowest residual, and its standard error (Efron and Tibshirani 1993, ch. 11).
    lowest = _parabola_minimum(factors, values.mean(axis=1))
    is_left_out = np.arange(len(pairs)) % JACKKNIFE_GROUPS == np.arange(JACKKNIFE_GROUPS)[:, None]
    minima_without = np.array([_parabola_minimum(factors, values[:, ~group].mean(axis=1)) for group in is_left_out])
    error = np.sqrt((JACKKNIFE_GROUPS - 1) / JACKKNIFE_GROUPS * ((minima_without - minima_without.mean()) ** 2).sum())
    # Change the angle if the factor is significant, or rather if it is near a regular angle.
    if not abs(lowest - 1.0) <= MAX_STRETCH:
        return 1.0
    regular = _nearest_regular(lowest, float(np.degrees(step_rad)))
    is_regular = regular != lowest and abs(lowest - regular) < error
    min_errors = MIN_STANDARD_ERRORS_TO_REGULAR if is_regular else MIN_STANDARD_ERRORS
    return regular if abs(lowest - 1.0) > min_errors * error else 1.0


def _pair_residuals(
    geometry: ScanGeometry, poses: Floats, first: NDArray[np.int32], second: NDArray[np.int32], threads: int | None
) -> Floats:
    """Refine the first scan of each pair against the second, and return the badness of the fit, from 0 to 1, (M,)."""
    weak_prior = np.tile(np.diag([25.0, 25.0, 100.0]), (len(first), 1, 1))  # sigmas of 0.2 m and 0.1 rad
    offsets, start = np.arange(len(first) + 1, dtype=np.int32), poses[first]
    refinement = Refinement(first, offsets, second, poses[second], start, start, weak_prior)
    reach_m, scale_m = geometry.reach_m(0.2, 0.15), geometry.scale_m(0.05, 0.03)
    convergence = Convergence(sigma_m=0.02, steps=10, reach_m=reach_m, scale_m=scale_m, min_cosine=0.7)
    totals = refine_scans(geometry, refinement, convergence, threads).totals
    return np.asarray(1.0 - totals[:, WEIGHT] / np.maximum(totals[:, SEEN], 1.0))


def _parabola_minimum(factors: Floats, values: Floats) -> float:
    """Return the minimum of the parabola through values, or NaN if the parabola has none."""
    bend, tilt, _ = np.polyfit(factors - 1.0, values, 2)
    return float(1.0 - tilt / (2.0 * bend)) if bend > 0.0 else float("nan")


def _nearest_regular(factor: float, stated_deg: float) -> float:
    """Return the factor of the nearest regular angle, as stated or a multiple of 1/8 degree, if it is near enough."""
    regular = round(8.0 * factor * stated_deg) / 8.0 / stated_deg
    nearest = min((1.0, regular), key=lambda candidate: abs(factor - candidate))
    return nearest if regular > 0 and abs(factor / nearest - 1.0) < REGULAR_TOLERANCE else factor
