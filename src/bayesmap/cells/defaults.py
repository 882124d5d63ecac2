"""What to assume about a laser log of which nothing else is known.

None of this is particular to one building: the noise is a good laser's, widened by not knowing where in a cell the wall
stands. Chosen by held-out score among a few round values on a public office log (docs/defaults.md has the table).
"""

from __future__ import annotations

import math

from bayesmap.cells.binary import Independent
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.noise import Gaussian

P_WALL = 0.2
"""Prior wall probability: buildings are mostly free space, and unobserved cells should look unlike both."""

HIT_DEPTH = Independent.hit_depth
"""Where in a cell a beam is expected to stop, as a fraction of its chord."""

LASER_SIGMA_M = 0.02
LASER_SIGMA_PER_M = 0.005
CELL_SHARE = 0.35


def default_sensor(resolution_m: float) -> BeamMixture:
    """A robust laser model for cells of a given size."""
    return BeamMixture(Gaussian(math.hypot(LASER_SIGMA_M, CELL_SHARE * resolution_m), LASER_SIGMA_PER_M))
