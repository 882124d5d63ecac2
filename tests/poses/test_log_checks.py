"""Odometry: its noise and systematic error, and the faults by which it is told from good logs."""

from dataclasses import replace

import numpy as np
import pytest
from data import intel_log
from simulated import odometry_of, path_around, poses_along, recording, ring, scans_of, worst_m
from tiers import full_but

import bayesmap as bm
from bayesmap.io.logs import read_log
from bayesmap.poses import calibration, log_checks
from bayesmap.poses.calibration import MotionNoise, OdometryFit, RunningOdometry, fit_noise, fit_odometry
from bayesmap.poses.log_checks import agreement, check_scans, frozen_stretches, look_like_odometry, odometry_warnings
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between, wrap_angle

USUAL = calibration.ORDINARY_RATES


def scans_at(stated, angles, ranges):
    return bm.Scans(stated, angles, ranges, 12.0, stamps_s=0.2 * np.arange(len(stated)))


def scans(truth, stated):
    return scans_at(stated, *scans_of(ring(), truth))


@pytest.fixture(scope="module")
def path():
    return path_around(0.5)


def test_constant_odometry_is_refused_with_the_remedy_and_a_frozen_stretch_is_named(path):
    constant = scans(path, np.zeros_like(path))
    with pytest.raises(bm.BadInput, match=r"odometry is constant, one pose for all scans.*--no-odometry"):
        infer_trajectory(constant)
    check_scans(constant, no_odometry=True)
    assert odometry_warnings(constant, no_odometry=True) == []
    stated = path.copy()
    stated[30:61] = stated[30] + 1e-9 * np.arange(31)[:, None]
    frozen = scans(path, stated)
    assert frozen_stretches(frozen) == [(30, 60)]
    (doubt,) = odometry_warnings(frozen, no_odometry=False)
    assert "stands still from scan 30 to 60 (6.0 to 12.0 s after the first scan)" in doubt
    assert "--no-odometry" in doubt
    check_scans(frozen, no_odometry=False)


def test_beams_without_return_standing_robots_and_odometry_slower_than_scans_are_not_in_doubt(path):
    blind = scans(path, np.zeros_like(path))
    blind.ranges_m[:, ::9] = np.inf
    blind.ranges_m[:, 4::9] = np.nan
    assert frozen_stretches(blind) == [(0, len(path) - 1)]
    blind.ranges_m[:, 5:] = np.inf
    assert frozen_stretches(blind) == []
    rests = np.concatenate([path[:30], np.repeat(path[30:31], 40, axis=0), path[31:]])
    slow = path[np.arange(len(path)) // 5 * 5]
    assert not any(odometry_warnings(log, no_odometry=False) for log in (scans(rests, rests), scans(path, slow)))
    parked = np.repeat(path[:1], 40, axis=0)
    check_scans(scans(parked, parked), no_odometry=False)


def test_scans_of_a_clock_that_was_set_back_keep_their_order(path):
    set_back = scans(path, path)
    set_back.stamps_s[len(path) // 2 :] -= 4.0
    found = infer_trajectory(set_back, threads=1)
    np.testing.assert_array_equal(found.order, np.arange(len(path)))
    assert len(found.breaks) == 0
    assert np.hypot(*(found.poses - path)[:, :2].T).max() < 0.2


LATE = 3
"""Scans over which odometry says nothing new."""


@pytest.fixture(scope="module")
def drive():
    """True poses, odometry and scans of a robot that turns by 30 degrees a scan at corners."""
    truth = path_around(0.8)
    turning = np.abs(np.diff(truth[:, 2], prepend=truth[0, 2])) > 0.1
    truth = truth[~turning | (np.cumsum(turning) % 2 == 0)]
    angles, ranges = scans_of(ring(), truth)
    return truth, odometry_of(truth, noise=3.0), angles, ranges


def late(stated, at):
    """Odometry that repeats the pose of some scans for `LATE` more."""
    held = stated.copy()
    for first in at:
        held[first : first + LATE + 1] = stated[first]
    return held


def corners(truth):
    """The scan before each turn on the spot."""
    turns = np.abs(np.diff(truth[:, 2])) > 0.2
    return np.flatnonzero(turns[1:] & ~turns[:-1])


def test_late_poses_are_spread_over_the_scans_that_moved_but_a_robot_that_stood_still_is_believed(drive):
    truth, stated, angles, ranges = drive
    at = corners(truth)[:3]
    held = scans_at(late(stated, at), angles, ranges)
    mended = log_checks.correct_late_odometry(held, scan_geometry(held))
    off_before, off_after = (np.abs(between(stated, poses)[:, 2]).max() for poses in (held.poses, mended))
    assert off_before > np.radians(55.0)
    assert off_after < np.radians(35.0)  # the turn does not begin with the first repeated pose
    fresh = np.ones(len(truth), bool)
    for first in at:
        fresh[first + 1 : first + LATE + 1] = False
    np.testing.assert_array_equal(mended[fresh], held.poses[fresh])
    # The wrong twin: the same repeated poses and the same leap, of a robot that did stand and then was fast.
    held = late(stated, at)
    _, index = np.unique(held, axis=0, return_index=True)
    first = np.sort(index)[np.searchsorted(np.sort(index), np.arange(len(held)), side="right") - 1]
    stood = scans_at(held, angles, ranges[first] + np.random.default_rng(2).normal(0.0, 0.01, ranges.shape))
    np.testing.assert_array_equal(log_checks.correct_late_odometry(stood, scan_geometry(stood)), held)
    # A public log counted a turn twice: by its scans, and by odometry when it came.
    found = infer_trajectory(scans_at(held, angles, ranges), threads=1)
    assert worst_m(found.poses, truth) < 0.05
    assert len(found.breaks) == 0


def test_raw_odometry_is_told_from_true_poses_but_by_few_scans_or_no_hits():
    made, sensor = bm.worlds.building(3, (20.0, 12.0), 0.1), bm.Gaussian(0.01)
    poses, angles = bm.worlds.patrol(made, 200, 3), np.radians(np.arange(180) - 90.0)
    options = {"sensor": sensor, "max_range_m": 15.0, "typed": True, "seed": 1}
    round_trip = bm.simulate(made.walls, made.grid, poses, angles, **options)
    assert look_like_odometry(round_trip.at(bm.simulate_odometry(round_trip.poses, seed=5)))
    assert not look_like_odometry(round_trip)
    assert agreement(round_trip) > 0.8
    nothing = bm.Scans(round_trip.poses, round_trip.angles_rad, np.full(round_trip.ranges_m.shape, np.inf), 15.0)
    assert agreement(round_trip.select(slice(0, 10))) is agreement(nothing) is None


@pytest.mark.parametrize("name", ["intel-corrected", "intel-odometry", "loop5-odometry"])
def test_real_logs(name):
    assert look_like_odometry(read_log(intel_log(f"{name}.log.gz"))) == name.endswith("odometry")


RATES = np.array([[4e-3, 2e-3, 1e-6], [1e-3, 1e-3, 1e-6], [2e-3, 5e-3, 1e-7]])


def features_of_motions(count, seed):
    """Ways, turns and numbers of scans of motions."""
    rng = np.random.default_rng(seed)
    ways, turns = rng.uniform(0.0, 0.6, count), rng.uniform(0.0, 0.5, count) * (rng.random(count) < 0.4)
    return np.stack([ways, turns, np.full(count, 3.0)], axis=-1)


def errors_of(noise, features, seed):
    sigma = np.sqrt(features @ noise.rates.T)
    return sigma * np.random.default_rng(seed).normal(size=sigma.shape)


def test_variances_of_parts_and_the_noise_of_single_scans_add_up_to_that_of_the_whole():
    noise = MotionNoise(RATES)
    parts = np.array([[0.1, 0.0, 0.02], [0.2, 0.0, 0.05], [0.3, 0.0, 0.01]])
    whole = noise.variances(np.array([0.6, 0.0, 0.08])) + 2 * RATES[:, 2]
    np.testing.assert_allclose(noise.variances(parts).sum(axis=0), whole, rtol=1e-12)
    rng = np.random.default_rng(3)
    motions = np.stack([rng.uniform(0, 0.2, 500), np.zeros(500), rng.normal(0, 0.1, 500)], axis=-1)
    one = MotionNoise(RATES).as_odometry(motions)
    total = MotionNoise(RATES).variances(motions)[:, 2].sum()
    np.testing.assert_allclose((one.sigmas(motions)[:, 2] ** 2).sum(), total, rtol=1e-9)


@pytest.mark.parametrize("slips", [0, 30])
def test_the_noise_is_found_whether_wheels_slip_or_not(slips):
    """1500 motions tell rates of variances to about 8 %, and 2 % of slips of half a metre add a fifth."""
    features = features_of_motions(1500, 1)
    errors = errors_of(MotionNoise(RATES), features, 2)
    errors[:slips] += 0.5
    found = fit_noise(errors, features, np.full((1500, 3), 1e-8))
    ratio = (features @ found.rates.T).mean(axis=0) / (features @ RATES.T).mean(axis=0)
    assert (np.abs(ratio - 1.0) < (0.4 if slips else 0.2)).all()


def test_the_noise_is_found_where_the_laser_is_blind_or_tells_not_much_more_than_odometry():
    """A blind laser measures no error; a motion that both found differs from odometry by less than odometry errs."""
    features = features_of_motions(600, 4)
    errors = errors_of(MotionNoise(RATES), features, 5)
    blind = np.arange(600) % 2 == 0
    errors[blind] = 0.0
    variance = np.where(blind[:, None], 1.0, 1e-8) * np.ones(3)
    found, seen = fit_noise(errors, features, variance), ~blind
    np.testing.assert_allclose(found.rates, fit_noise(errors[seen], features[seen], variance[seen]).rates, rtol=1e-6)
    np.testing.assert_array_equal(fit_noise(errors, features, np.ones((600, 3))).rates, USUAL)
    features = features_of_motions(1500, 8)
    noise = MotionNoise(100.0 * USUAL)
    errors, variance = errors_of(noise, features, 9), features @ noise.rates.T
    laser = np.sqrt(0.25 * variance) * np.random.default_rng(10).normal(size=variance.shape)
    left, known = (errors - laser) * 0.8, 0.2 * variance  # of stated less found, and of what was found
    ratio = (features @ fit_noise(left, features, known, variance).rates.T).mean(axis=0) / variance.mean(axis=0)
    assert (np.abs(ratio - 1.0) < 0.25).all()
    blind = fit_noise(np.zeros((1500, 3)), features, variance, variance)
    np.testing.assert_allclose((features @ blind.rates.T).sum(axis=0), variance.sum(axis=0))


def straight_on(noise_rad, count=800, scale=1.03, seed=7):
    """A robot that drives exactly straight, and odometry whose heading is noisy: poses found and stated."""
    motions = np.tile([0.5 * scale, 0.0, 0.0], (count - 1, 1))
    motions[:, 2] = noise_rad * np.random.default_rng(seed).normal(size=count - 1)
    return np.cumsum(np.tile([0.5, 0.0, 0.0], (count, 1)), axis=0), poses_along(np.zeros(3), motions)


def test_noise_while_driving_straight_does_not_pass_for_a_scale_of_turns():
    """Regressing what was found on what was stated would give B of -1 for the heading: no turn is ever believed."""
    found, stated = straight_on(0.04)
    fit = fit_odometry(stated, None, found, np.arange(len(found)), np.full((len(found) - 1, 3), 1e-8))
    assert abs(fit.slope[2, 2]) < 0.2
    assert fit.slope[0, 0] == pytest.approx(1 / 1.03 - 1, abs=0.003)
    running = RunningOdometry()
    for stated_motion, motion in zip(between(stated[:-1], stated[1:]), between(found[:-1], found[1:]), strict=True):
        running.learn_slope(stated_motion, motion, np.full(3, 1e-6))
    assert abs(running.slope[2, 2]) < 0.2
    assert running.slope[0, 0] == pytest.approx(1 / 1.03 - 1, abs=0.01)


def test_the_correction_removes_the_systematic_error_and_shifts_have_the_covariance_of_its_entries():
    rng = np.random.default_rng(1)
    wrong = np.array([[0.05, 0.0, 0.02], [0.0, 0.05, -0.1], [0.03, 0.0, -0.02]])
    root, slope = 2e-3 * rng.normal(size=(9, 9)), calibration.inverse_slope(wrong)
    fit = OdometryFit(slope, root @ root.T, 0.0, 0.0, MotionNoise(USUAL))
    motions = np.array([[0.4, 0.01, 0.2], [-0.1, 0.0, 1.0]])
    stated = motions @ (np.eye(3) + wrong).T
    np.testing.assert_allclose(stated + stated @ slope.T, motions, atol=1e-12)
    draws = wrong + (rng.normal(size=(20_000, 9)) @ root.T).reshape(-1, 3, 3)
    corrected = np.linalg.solve(np.eye(3) + draws[:, None], stated[None, :, :, None])[..., 0].reshape(-1, 6)
    shifts = fit.shifts(motions).reshape(9, 6)
    expected = shifts.T @ shifts
    np.testing.assert_allclose(np.cov(corrected.T), expected, atol=0.05 * np.diag(expected).max())


def test_stamps_that_repeat_tell_no_lag_and_move_no_pose():
    """Odometry that is late by 0.2 s: found by exact stamps, not by whole seconds, which would tell another."""
    times = 100.0 + 0.2 * np.arange(300)
    found = np.column_stack([np.cumsum(0.1 + 0.08 * np.sin(0.7 * times)), np.zeros(300), np.zeros(300)])
    stated = calibration.compensate_lag(found, times, -0.2)
    scans, variance = np.arange(0, 300, 2), np.full((149, 3), 1e-6)
    assert fit_odometry(stated, times, found[scans], scans, variance).lag_s == pytest.approx(0.2, abs=0.03)
    assert fit_odometry(stated, np.floor(times), found[scans], scans, variance).lag_s == 0.0
    coarse = np.where(np.arange(300) < 200, times, times[200])
    np.testing.assert_array_equal(calibration.compensate_lag(found, coarse, 0.1)[200:], found[200:])
    assert (calibration.compensate_lag(found, coarse, 0.1)[:199, 0] > found[:199, 0]).all()


def ratio(scans, truth):
    first, second = (index.ravel().astype(np.int32) for index in np.indices((len(truth), len(truth))))
    near = (first < second) & (np.hypot(*(truth[first] - truth[second])[:, :2].T) < 2.0)
    turned = near & (np.abs(wrap_angle(truth[first, 2] - truth[second, 2])) > np.radians(25.0))
    return calibration.angle_step_ratio(scans, truth, first[turned], second[turned])


@pytest.mark.parametrize("case", full_but([(0.01, 2), (0.02, 0), (0.02, 2), (0.03, 1)], (0.01, 2), (0.03, 1)))
def test_angles_that_are_stated_wrong_are_found_and_noise_is_not_taken_for_them(monkeypatch, case):
    """Angles one part in 125 too wide; the truth is known to the estimate's own error, about 0.2 %.

    Where ranges scatter by a percent and more, the lowest residual lies anywhere. The twin: it is believed.
    """
    (noise, seed), (scans, truth) = case, recording(laser_noise_m=0.01)
    assert ratio(replace(scans, angles_rad=scans.angles_rad * 1.008), truth) == pytest.approx(1.0 / 1.008, abs=0.0025)
    error = noise * np.random.default_rng(seed).standard_normal(scans.ranges_m.shape)
    noisy = replace(scans, ranges_m=np.asarray(scans.ranges_m * (1.0 + error)))
    assert ratio(noisy, truth) == 1.0
    monkeypatch.setattr(calibration, "MIN_STANDARD_ERRORS", 0.0)
    monkeypatch.setattr(calibration, "_nearest_regular", lambda factor, stated: factor)
    assert ratio(noisy, truth) != 1.0


@pytest.mark.parametrize("seed", range(6))
def test_rates_are_the_most_probable_ones_also_at_their_bounds(seed):
    """Some motions do not turn and some do not err: their rates go to the bound. No step of 1 % makes them likelier."""
    rng = np.random.default_rng(seed)
    features = features_of_motions(200, seed)
    features[:, 1] *= seed % 2
    errors = np.sqrt(features @ (USUAL[0] * np.exp(rng.normal(0.0, 3.0, 3)))) * rng.normal(size=200) * (seed > 1)
    known = np.full(200, 1e-9)
    found = calibration._fit_rates(errors, features, known, USUAL[0])

    def cost(rates):
        variance, nu = features @ rates, calibration.DEGREES_OF_FREEDOM
        tails = np.log1p((errors**2 + known) / (nu * variance)).sum()
        logs = np.log(rates / USUAL[0])
        assert np.abs(logs).max() <= calibration.MAX_LOG + 1e-9
        prior = 0.5 * ((logs / calibration.FACTOR_SIGMA) ** 2).sum()
        return 0.5 * np.log(variance).sum() + 0.5 * calibration.CONSISTENCY_FACTOR * (nu + 1.0) * tails + prior

    for axis in range(3):
        for factor in (0.99, 1.01):
            other = found * np.where(np.arange(3) == axis, factor, 1.0)
            if np.abs(np.log(other / USUAL[0])).max() <= calibration.MAX_LOG:
                assert cost(other) > cost(found)
