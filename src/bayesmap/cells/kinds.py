"""The built-in kinds of cells by name, the prior of a description, and the defaults for a laser log.

The defaults fit any building: the noise is a good laser's, widened because the place of a wall within its cell is
unknown. They were chosen by held-out score among a few round values on a public office log (docs/lab/maps.md).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bayesmap.cells.binary import Independent, Ising
from bayesmap.cells.kind import KINDS, CellPrior
from bayesmap.cells.reflectivity import Beta
from bayesmap.cells.surface import Surface
from bayesmap.errors import BadInput
from bayesmap.sensors.builtin import BeamMixture, Gaussian

BUILT_IN: dict[str, type[CellPrior]] = {cls.words.kind: cls for cls in (Independent, Beta, Surface)}

_NAMED: dict[str, type[CellPrior]] = {
    "independent": Independent, "binary": Independent, "ising": Ising, "beta": Beta, "reflectivity": Beta,
}  # fmt: skip
"""Names of priors in descriptions, where these differ from the word of the kind."""


def prior_from(description: Mapping[str, Any]) -> CellPrior:
    """Return the prior of a description.

    Raises:
        BadInput: a kind that no loaded module defines.
    """
    kind = str(description.get("kind"))
    named = _NAMED.get(kind, KINDS.get(kind))
    if named is None:
        raise BadInput(f"cells of kind {kind!r} are not known here; import the module that defines them first")
    return named.from_description(description)


P_WALL = 0.2
"""Prior wall probability: buildings are mostly free space, and unobserved cells should look unlike both."""

HIT_DEPTH = Independent.hit_depth
"""The expected stop of a beam in a cell, as a fraction of its chord."""

LASER_SIGMA_M = 0.02
LASER_SIGMA_PER_M = 0.005
CELL_SHARE = 0.35


def default_sensor(resolution_m: float) -> BeamMixture:
    """Return a robust laser model for cells of a given size."""
    return BeamMixture(Gaussian(math.hypot(LASER_SIGMA_M, CELL_SHARE * resolution_m), LASER_SIGMA_PER_M))
