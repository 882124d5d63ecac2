"""Scans between key scans: where they are placed, and how sure that is."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from simulated import path_around, ring, scans_of
from tiers import full_but

from bayesmap.poses.alignment import align, overlapping_pairs, point_error
from bayesmap.poses.graph import Factors
from bayesmap.poses.placement import place_scans
from bayesmap.poses.pose_gaussian import DEGREES_OF_FREEDOM
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.space.planar import between
from bayesmap.space.scans import Scans

EVERY = 4
"""So many scans from one key scan to the next."""

NONE = Factors(np.empty(0, np.intp), np.empty(0, np.intp), np.empty((0, 3)), np.empty((0, 3, 3)))


@cache
def placed(noise_m):
    """Scans round a building, those between key scans placed among these, whose poses are the true ones."""
    truth = path_around(laps=2.0, step_m=0.1)
    angles, ranges = scans_of(ring(), truth, noise_m=noise_m, max_range_m=12.0)
    geometry = scan_geometry(Scans(truth, angles, ranges, max_range_m=12.0))
    keys = np.arange(0, len(truth), EVERY)
    key_geometry = geometry.select(keys)
    pairs = overlapping_pairs(key_geometry, truth[keys], 3.0)
    aligned = align(key_geometry, truth[keys], NONE, pairs, rounds=8, reach_m=(0.15, 0.08), scale_m=(0.06, 0.03))
    error = point_error(key_geometry, aligned)
    return truth, keys, place_scans(geometry, truth, keys, replace(aligned, poses=truth[keys]), error)


@pytest.mark.parametrize("noise_m", full_but([0.01, 0.03], 0.01))
def test_scans_between_key_scans_err_as_much_as_is_said(noise_m):
    truth, keys, found = placed(noise_m)
    others = np.setdiff1d(np.arange(len(truth)), keys)
    off = between(truth[others], found.poses[others])
    precision = np.linalg.inv(found.own_covariance(keys)[others])
    expected = 3.0 * DEGREES_OF_FREEDOM / (DEGREES_OF_FREEDOM - 2.0)  # of Student's t with this scale matrix
    assert 0.7 < np.einsum("mi,mij,mj->m", off, precision, off).mean() / expected < 1.4


def test_key_scans_stay_where_they_are():
    truth, keys, found = placed(0.01)
    np.testing.assert_array_equal(found.poses[keys], truth[keys])
    assert not found.own_covariance(keys)[keys].any()
