"""Where a robot sees next to nothing: covariances hold the arcs of a lost heading, and scans are flagged."""

import numpy as np
import pytest
from simulated import ring, scans_of

from bayesmap.poses.alignment import Alignment, Pairs, PointError
from bayesmap.poses.key_alignment import flag_unexplained
from bayesmap.poses.placement import place_scans
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.trajectory import with_arcs
from bayesmap.space.scans import Scans


@pytest.mark.parametrize("sigma_rad", [0.02, 0.5])
def test_covariances_hold_the_arc_on_which_a_lost_heading_puts_the_end_of_a_way(sigma_rad):
    """8 m straight on after a heading that errs: to first order only across, by Student's t of 10 degrees."""
    dof, way_m = 10.0, 8.0
    turn = sigma_rad * np.random.default_rng(1).standard_t(dof, 400_000)
    off = np.stack([-0.5 * way_m * turn**2, way_m * turn, turn], axis=1)
    expected = off.T @ off / len(off)
    by_heading = np.array([0.0, way_m, 1.0])
    linear = sigma_rad**2 * np.outer(by_heading, by_heading)
    covariance = dof / (dof - 2.0) * with_arcs(linear[None], dof)[0]
    np.testing.assert_allclose(np.diag(covariance), np.diag(expected), rtol=0.1)
    assert linear[0, 0] == 0.0


def test_scans_of_nothing_are_flagged_where_they_are_most_of_all():
    """Two thirds of the scans are explained by no other; the rest as usual, but for one."""
    explained = np.where(np.arange(60) % 3 == 0, 0.95, 0.0)
    explained[30] = 0.3
    flagged = flag_unexplained(explained, np.arange(0, 60, 2))
    np.testing.assert_array_equal(flagged, explained < 0.5)


def test_a_scan_is_explained_by_what_several_key_scans_see_together():
    """Two key scans see half of a scan's walls each: the mean of their shares was one half, and the scan was flagged.

    The last scan was taken elsewhere: neither explains it.
    """
    poses = np.tile([1.0, 1.0, 0.4], (4, 1))
    angles, ranges = scans_of(ring(), poses, full=True)
    ranges[0, :90], ranges[2, 90:] = np.inf, np.inf
    ranges[3] = scans_of(ring(), np.array([[8.0, 3.5, 2.0]]), full=True)[1]
    geometry = scan_geometry(Scans(poses, angles, ranges, max_range_m=12.0))
    keys, ends = np.array([0, 2]), np.array([0, 1], np.int32)
    pairs = Pairs(ends, ends[::-1], np.arange(3, dtype=np.int32))
    aligned = Alignment(poses[keys], pairs, 0.01, None, np.ones(2))
    placed = place_scans(geometry, poses, keys, aligned, PointError(0.01, np.ones(3)))
    assert placed.explained[1] > 0.75
    assert placed.explained[3] < 0.4
