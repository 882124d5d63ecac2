"""The beam angles of a laser whose beams fill a field of view evenly."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

MAX_BEAMS = 100_000


def fan(beams: int, fov_deg: float) -> NDArray[np.float64]:
    """Return beam angles in the sensor frame, radians, (beams,), from the right end of the field of view to the left.

    An odd number of beams has one at each end, as lasers of 181 or 361 beams do. An even number leaves out the last,
    as lasers of 180 or 360 do: 180 beams over 180 degrees are 1 degree apart. A full circle starts straight ahead, and
    its last beam is one step before its first.

    Raises:
        BadInput: fewer than two beams, or a field of view outside (0, 360] degrees.
    """
    if not 2 <= beams <= MAX_BEAMS:
        raise BadInput(f"angles: give 2 to {MAX_BEAMS:,} beams a scan, got {beams}")
    if not 0 < fov_deg <= 360:
        raise BadInput(f"fov: the field of view must lie in (0, 360] degrees, got {fov_deg:g}")
    if fov_deg == 360:
        return np.asarray(np.arange(beams) * 2 * math.pi / beams)
    step = fov_deg / (beams - beams % 2)
    return np.asarray(np.radians(step * np.arange(beams) - fov_deg / 2))
