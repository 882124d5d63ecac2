"""Across and along a surface: a wall with a known direction, seen from both of its sides."""

import numpy as np
import pytest

from bayesmap.posterior.predictor import surface_offset

THICK_M, LONG_M = 0.01, 0.2


def wall(direction_rad):
    """Covariance of a wall that runs in a direction."""
    t = np.array([np.cos(direction_rad), np.sin(direction_rad)])
    n = np.array([-t[1], t[0]])
    return LONG_M**2 * np.outer(t, t) + THICK_M**2 * np.outer(n, n)


@pytest.mark.parametrize("turn_rad", [0.0, 0.7, 2.5, -1.2])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_point_has_its_parts_across_and_along(turn_rad, side):
    """A wall along x at the origin, a sensor above or below it, all turned about the origin."""
    turn = np.array([[np.cos(turn_rad), -np.sin(turn_rad)], [np.sin(turn_rad), np.cos(turn_rad)]])
    sensor, point = turn @ [0.5, side * 2.0], turn @ [0.3, side * 0.04]
    found = surface_offset(np.zeros(2), wall(turn_rad), point, sensor)
    assert found.across_m == pytest.approx(0.04)  # in front of it, on whichever side the sensor stands
    # the sensor above looks down, so that larger x is on its left; from below it is on its right
    assert found.along_m == pytest.approx(side * 0.3)
    assert (found.thickness_m, found.length_m) == pytest.approx((THICK_M, LONG_M))
    assert found.incidence_rad == pytest.approx(np.arctan2(0.5, 2.0))


def test_behind_the_wall_is_negative():
    found = surface_offset(np.zeros(2), wall(0.0), np.array([0.0, -0.05]), np.array([0.0, 3.0]))
    assert found.across_m == pytest.approx(-0.05)
    assert found.incidence_rad == pytest.approx(0.0)
