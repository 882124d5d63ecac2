"""What the laser says of poses is weighed by how far errors of points move them, not by what robust matching leaves."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from simulated import path_around, ring, scans_of

from bayesmap.poses.alignment import (
    COUNTED_AGAIN,
    Pairs,
    PointError,
    align,
    overlapping_pairs,
    point_error,
    with_point_error,
)
from bayesmap.poses.graph import Factors
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.space.planar import between
from bayesmap.space.scans import Scans

APART = 5
NONE = Factors(np.empty(0, np.intp), np.empty(0, np.intp), np.empty((0, 3)), np.empty((0, 3, 3)))


@cache
def aligned(noise_m):
    """Scans round a building, aligned from the truth, without odometry."""
    truth = path_around(laps=1.0)
    angles, ranges = scans_of(ring(), truth, noise_m=noise_m, max_range_m=12.0)
    geometry = scan_geometry(Scans(truth, angles, ranges, max_range_m=12.0))
    pairs = overlapping_pairs(geometry, truth, 3.0)
    return truth, geometry, align(geometry, truth, NONE, pairs, rounds=8, reach_m=(0.15, 0.08), scale_m=(0.06, 0.03))


def squares(truth, gaussian):
    """Mean squared errors of relative poses by their scale matrices, as multiples of what Student's t expects."""
    first, second = np.arange(len(truth) - APART), np.arange(APART, len(truth))
    off = between(gaussian.poses[first], gaussian.poses[second]) - between(truth[first], truth[second])
    scale = gaussian.relative_covariances(first, second)
    expected = 3.0 * gaussian.dof / (gaussian.dof - 2.0)
    return float(np.einsum("mi,mij,mj->m", off, np.linalg.inv(scale), off).mean()) / expected


def test_what_is_found_is_in_proportion_to_the_noise_and_what_matching_leaves_is_not():
    found = {noise: aligned(noise) for noise in (0.01, 0.04)}
    errors = [point_error(geometry, one).sigma_m / noise for noise, (_, geometry, one) in found.items()]
    assert errors[1] == pytest.approx(errors[0], rel=0.05)
    left = [one.sigma_m / noise for noise, (_, _, one) in found.items()]
    assert left[1] < 0.85 * left[0]


@pytest.mark.parametrize("noise_m", [0.01, 0.04])
def test_covariances_have_the_size_of_errors_for_any_noise(noise_m):
    truth, geometry, found = aligned(noise_m)
    assert 0.7 < squares(truth, with_point_error(found, point_error(geometry, found))) < 1.5


def test_what_matching_leaves_claims_twice_too_much_of_a_noisy_laser():
    truth, _, found = aligned(0.04)
    assert squares(truth, found.gaussian) > 1.8


def test_only_the_laser_s_part_is_scaled():
    _, _, found = aligned(0.01)
    laser = len(found.pairs)
    tied = found.gaussian
    by_wheels = replace(
        tied,
        first=np.append(tied.first, 0), second=np.append(tied.second, 1),
        relative=np.append(tied.relative, np.zeros((1, 3)), axis=0),
        curvature=np.append(tied.curvature, np.eye(3)[None], axis=0),
        force=np.append(tied.force, np.zeros((1, 3)), axis=0),
    )  # fmt: skip
    error = PointError(found.sigma_m, np.array([0.5, 0.5, 0.25]))
    scaled = with_point_error(replace(found, gaussian=by_wheels), error)
    share = tied.dof / (tied.dof - 2.0) / (1.0 - COUNTED_AGAIN)
    ratio = np.array([[4.0, 4.0, 2.0], [4.0, 4.0, 2.0], [2.0, 2.0, 1.0]]) / 16.0
    assert np.allclose(scaled.curvature[:laser], share * ratio * tied.curvature)
    assert np.allclose(scaled.force[:laser], share * np.diag(ratio) * tied.force)
    assert np.array_equal(scaled.curvature[laser], np.eye(3))


def test_scans_that_share_nothing_keep_what_matching_leaves():
    _, geometry, found = aligned(0.01)
    nothing = replace(
        found, pairs=Pairs(np.empty(0, np.int32), np.empty(0, np.int32), np.zeros(len(geometry) + 1, np.int32))
    )
    assert point_error(geometry, nothing).sigma_m == found.sigma_m
