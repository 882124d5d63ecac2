"""The beam angles of lasers that are sold, and of a full circle."""

import math

import numpy as np
import pytest

from bayesmap.errors import BadInput
from bayesmap.space.scans import fan


def test_fans():
    np.testing.assert_allclose(np.degrees(fan(180, 180.0)), np.arange(180) - 90)
    np.testing.assert_allclose(np.degrees(fan(361, 180.0)), np.arange(361) / 2 - 90)
    np.testing.assert_allclose(np.degrees(fan(4, 360.0)), [0, 90, 180, 270])
    np.testing.assert_array_equal(fan(7, math.degrees(2 * math.pi)), fan(7, 360.0))


@pytest.mark.parametrize(("beams", "fov_deg", "named"), [(1, 90.0, "angles"), (90, 0.0, "fov"), (90, 361.0, "fov")])
def test_what_is_no_fan_is_refused_by_name(beams, fov_deg, named):
    with pytest.raises(BadInput, match=named):
        fan(beams, fov_deg)
