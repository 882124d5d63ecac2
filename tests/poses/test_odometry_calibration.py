"""The noise and systematic error of odometry, and the angle between beams, from scans."""

from dataclasses import replace

import numpy as np
import pytest
from simulated import recording
from tiers import full_but

from bayesmap.poses import calibration
from bayesmap.poses.calibration import USUAL, MotionNoise, OdometryFit, RunningOdometry, fit_noise, fit_odometry
from bayesmap.space.planar import between, compose, wrap_angle

RATES = np.array([[4e-3, 2e-3, 1e-6], [1e-3, 1e-3, 1e-6], [2e-3, 5e-3, 1e-7]])


def way(count, seed):
    """Ways, turns and numbers of scans of motions."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0.0, 0.6, count), rng.uniform(0.0, 0.5, count) * (rng.random(count) < 0.4), np.full(count, 3.0)


def errors_of(noise, ways, turns, scans, seed):
    sigma = np.sqrt(np.stack([ways, turns, scans], axis=-1) @ noise.rates.T)
    return sigma * np.random.default_rng(seed).normal(size=sigma.shape)


def test_variances_of_parts_and_the_noise_of_single_scans_add_up_to_that_of_the_whole():
    noise = MotionNoise(RATES)
    parts = np.array([[0.1, 0.0, 0.02], [0.2, 0.0, 0.05], [0.3, 0.0, 0.01]])
    whole = noise.variances(np.array([0.6, 0.0, 0.08])) + 2 * RATES[:, 2]
    np.testing.assert_allclose(noise.variances(parts).sum(axis=0), whole, rtol=1e-12)
    rng = np.random.default_rng(3)
    motions = np.stack([rng.uniform(0, 0.2, 500), np.zeros(500), rng.normal(0, 0.1, 500)], axis=-1)
    one = MotionNoise(RATES).of_scans(motions)
    np.testing.assert_allclose(
        (one.sigmas(motions)[:, 2] ** 2).sum(), MotionNoise(RATES).variances(motions)[:, 2].sum(), rtol=1e-9
    )


@pytest.mark.parametrize("slips", [0, 30])
def test_the_noise_is_found_whether_wheels_slip_or_not(slips):
    """Of 1500 motions: rates of variances are known to about 8 %, and 2 % of slips of half a metre add a fifth."""
    ways, turns, scans = way(1500, 1)
    errors = errors_of(MotionNoise(RATES), ways, turns, scans, 2)
    errors[:slips] += 0.5
    found = fit_noise(errors, ways, turns, scans, np.full((1500, 3), 1e-8))
    expected = np.stack([ways, turns, scans], axis=-1) @ RATES.T
    ratio = (np.stack([ways, turns, scans], axis=-1) @ found.rates.T).mean(axis=0) / expected.mean(axis=0)
    assert (np.abs(ratio - 1.0) < (0.4 if slips else 0.2)).all()


def test_motions_that_the_laser_cannot_see_do_not_make_odometry_look_exact():
    """Where the laser is blind the motion found is the one stated: an error of nought that was never measured."""
    ways, turns, scans = way(600, 4)
    errors = errors_of(MotionNoise(RATES), ways, turns, scans, 5)
    blind = np.arange(600) % 2 == 0
    errors[blind] = 0.0
    variance = np.where(blind[:, None], 1.0, 1e-8) * np.ones(3)
    found, seen = fit_noise(errors, ways, turns, scans, variance), ~blind
    alone = fit_noise(errors[seen], ways[seen], turns[seen], scans[seen], variance[seen])
    np.testing.assert_allclose(found.rates, alone.rates, rtol=1e-6)
    nothing = fit_noise(errors, ways, turns, scans, np.ones((600, 3)))
    np.testing.assert_array_equal(nothing.rates, USUAL)


def test_the_noise_is_found_where_the_laser_tells_not_much_more_than_odometry():
    """Motions were found by a laser half as noisy as odometry that is ten times as noisy as usual.

    A motion that both found errs less than the laser alone, and differs from odometry by less than odometry errs.
    """
    ways, turns, scans = way(1500, 8)
    noise = MotionNoise(100.0 * USUAL)
    errors, variance = errors_of(noise, ways, turns, scans, 9), noise.over(ways, turns, scans)
    laser = np.sqrt(0.25 * variance) * np.random.default_rng(10).normal(size=variance.shape)
    left, known = (errors - laser) * 0.8, 0.2 * variance  # of stated less found, and of what was found
    rates = fit_noise(left, ways, turns, scans, known, variance).rates
    ratio = MotionNoise(rates).over(ways, turns, scans).mean(axis=0) / variance.mean(axis=0)
    assert (np.abs(ratio - 1.0) < 0.25).all()
    blind = fit_noise(np.zeros((1500, 3)), ways, turns, scans, variance, variance)
    np.testing.assert_allclose(blind.over(ways, turns, scans).sum(axis=0), variance.sum(axis=0))


def straight_on(noise_rad, count=800, scale=1.03, seed=7):
    """A robot that drives exactly straight, and odometry whose heading is noisy: poses found and stated."""
    rng = np.random.default_rng(seed)
    found = np.cumsum(np.tile([0.5, 0.0, 0.0], (count, 1)), axis=0)
    stated = [np.zeros(3)]
    for _ in range(count - 1):
        stated.append(compose(stated[-1], np.array([0.5 * scale, 0.0, noise_rad * rng.normal()])))
    return found, np.array(stated)


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
    wrong = np.array([[0.05, 0.0, 0.02], [0.0, 0.05, -0.1], [0.03, 0.0, -0.02]])
    motion = np.array([0.4, 0.01, 0.2])
    stated = motion + wrong @ motion
    np.testing.assert_allclose(stated + calibration.inverse_slope(wrong) @ stated, motion, atol=1e-12)
    rng = np.random.default_rng(1)
    wrong = np.array([[0.05, 0.0, 0.02], [0.0, 0.05, -0.1], [0.03, 0.0, -0.02]])
    root = 2e-3 * rng.normal(size=(9, 9))
    fit = OdometryFit(calibration.inverse_slope(wrong), root @ root.T, 0.0, 0.0, MotionNoise(USUAL))
    motions = np.array([[0.4, 0.01, 0.2], [-0.1, 0.0, 1.0]])
    stated = motions @ (np.eye(3) + wrong).T
    draws = wrong + (rng.normal(size=(20_000, 9)) @ root.T).reshape(-1, 3, 3)
    corrected = np.linalg.solve(np.eye(3) + draws[:, None], stated[None, :, :, None])[..., 0].reshape(-1, 6)
    shifts = fit.shifts(motions).reshape(9, 6)
    expected = shifts.T @ shifts
    np.testing.assert_allclose(np.cov(corrected.T), expected, atol=0.05 * np.diag(expected).max())


def test_stamps_that_repeat_tell_no_lag_and_move_no_pose():
    """Odometry that is late by 0.2 s: found by exact stamps, not by whole seconds, which would tell another."""
    times = 100.0 + 0.2 * np.arange(300)
    found = np.column_stack([np.cumsum(0.1 + 0.08 * np.sin(0.7 * times)), np.zeros(300), np.zeros(300)])
    stated = calibration.stated_at(found, times, -0.2)
    scans, variance = np.arange(0, 300, 2), np.full((149, 3), 1e-6)
    assert fit_odometry(stated, times, found[scans], scans, variance).lag_s == pytest.approx(0.2, abs=0.03)
    assert fit_odometry(stated, np.floor(times), found[scans], scans, variance).lag_s == 0.0
    coarse = np.where(np.arange(300) < 200, times, times[200])
    np.testing.assert_array_equal(calibration.stated_at(found, coarse, 0.1)[200:], found[200:])
    assert (calibration.stated_at(found, coarse, 0.1)[:199, 0] > found[:199, 0]).all()


@pytest.fixture(scope="module")
def recorded():
    """Scans, and the poses at which they were taken."""
    return recording(laser_noise_m=0.01)


def ratio(scans, truth):
    first, second = (index.ravel().astype(np.int32) for index in np.indices((len(truth), len(truth))))
    near = (first < second) & (np.hypot(*(truth[first] - truth[second])[:, :2].T) < 2.0)
    turned = near & (np.abs(wrap_angle(truth[first, 2] - truth[second, 2])) > np.radians(25.0))
    return calibration.angle_step_ratio(scans, truth, first[turned], second[turned])


def test_angles_that_are_stated_wrong_are_found(recorded):
    """One part in 125 too wide; the truth is known to the estimate's own error, about 0.2 %."""
    scans, truth = recorded
    stated = replace(scans, angles_rad=scans.angles_rad * 1.008)
    assert ratio(stated, truth) == pytest.approx(1.0 / 1.008, abs=0.0025)


@pytest.mark.parametrize("case", full_but([(0.01, 2), (0.02, 0), (0.02, 2), (0.03, 1)], (0.01, 2), (0.03, 1)))
def test_noise_is_not_taken_for_wrong_angles(recorded, monkeypatch, case):
    """Where ranges scatter by a percent and more, the lowest residual lies anywhere. The twin: it is believed."""
    (noise, seed), (scans, truth) = case, recorded
    error = noise * np.random.default_rng(seed).standard_normal(scans.ranges_m.shape)
    noisy = replace(scans, ranges_m=np.asarray(scans.ranges_m * (1.0 + error)))
    assert ratio(noisy, truth) == 1.0
    monkeypatch.setattr(calibration, "MIN_STANDARD_ERRORS", 0.0)
    monkeypatch.setattr(calibration, "_regular", lambda factor, stated: factor)
    assert ratio(noisy, truth) != 1.0


@pytest.mark.parametrize("seed", range(6))
def test_rates_are_the_most_probable_ones_also_at_their_bounds(seed):
    """Some motions do not turn and some do not err: their rates go to the bound. No step of 1 % makes them likelier."""
    rng = np.random.default_rng(seed)
    ways, turns, scans = way(200, seed)
    features = np.stack([ways, turns * (seed % 2), scans], axis=-1)
    errors = np.sqrt(features @ (USUAL[0] * np.exp(rng.normal(0.0, 3.0, 3)))) * rng.normal(size=200) * (seed > 1)
    known = np.full(200, 1e-9)
    found = calibration._rates(errors, features, known, USUAL[0])

    def cost(rates):
        variance, nu = features @ rates, calibration.DEGREES_OF_FREEDOM
        tails = np.log1p((errors**2 + known) / (nu * variance)).sum()
        logs = np.log(rates / USUAL[0])
        assert np.abs(logs).max() <= calibration.MAX_LOG + 1e-9
        prior = 0.5 * ((logs / calibration.FACTOR_SIGMA) ** 2).sum()
        return 0.5 * np.log(variance).sum() + 0.5 * calibration.CONSISTENT * (nu + 1.0) * tails + prior

    for axis in range(3):
        for factor in (0.99, 1.01):
            other = found * np.where(np.arange(3) == axis, factor, 1.0)
            if np.abs(np.log(other / USUAL[0])).max() <= calibration.MAX_LOG:
                assert cost(other) > cost(found)
