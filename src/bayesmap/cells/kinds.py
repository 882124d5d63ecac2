"""The built-in kinds of cells by name, the prior of a description, and the defaults for a laser log.

The defaults fit any building. The noise of a good laser is widened, because the wall's position within its cell is
unknown. They were chosen among a few round values by held-out score on a public office log (docs/lab/maps.md).
"""

import math
from collections.abc import Mapping
from typing import Any

from bayesmap.cells.binary import Independent, Ising
from bayesmap.cells.kind import KINDS, CellPrior
from bayesmap.cells.reflectivity import Beta
from bayesmap.cells.surface import Surface
from bayesmap.errors import BadInput
from bayesmap.sensors.model import BeamMixture, Gaussian

P_WALL = 0.2  # buildings are mostly free space, and unobserved cells should look unlike walls and free
HIT_DEPTH = Independent.hit_depth  # the expected stop of a beam in a cell, as a fraction of its chord
LASER_SIGMA_M, LASER_SIGMA_PER_M = 0.02, 0.005  # standard deviation of a reading at range 0, and its growth per metre
CELL_SHARE = 0.35  # standard deviation that the cell adds, as a share of its edge

BUILT_IN: dict[str, type[CellPrior]] = {cls.words.kind: cls for cls in (Independent, Beta, Surface)}

_NAMED: dict[str, type[CellPrior]] = {
    "independent": Independent, "binary": Independent, "ising": Ising, "beta": Beta, "reflectivity": Beta,
}  # fmt: skip
"""Priors by names that descriptions use beside the words of the kinds."""


def prior_from(description: Mapping[str, Any]) -> CellPrior:
    """Return the prior of a description. Raises `BadInput` if no loaded module defines the kind."""
    kind = str(description.get("kind"))
    prior_class = _NAMED.get(kind, KINDS.get(kind))
    if prior_class is None:
        raise BadInput(f"cells of kind {kind!r} are not known here; import the module that defines them first")
    return prior_class.from_description(description)


def default_sensor(resolution_m: float) -> BeamMixture:
    """Return a robust laser model for cells of a given size."""
    return BeamMixture(Gaussian(math.hypot(LASER_SIGMA_M, CELL_SHARE * resolution_m), LASER_SIGMA_PER_M))
