"""The kinds of cells that are built in, by the name that users say, and the prior of a description."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bayesmap.cells.binary import Independent
from bayesmap.cells.kind import KINDS, CellPrior
from bayesmap.cells.reflectivity import Beta
from bayesmap.cells.surface import Surface
from bayesmap.errors import BadInput

BUILT_IN: dict[str, type[CellPrior]] = {cls.words.kind: cls for cls in (Independent, Beta, Surface)}

_ALIASES = {"independent": "binary", "beta": "reflectivity"}
"""What descriptions have always called two of them."""


def prior_from(description: Mapping[str, Any]) -> CellPrior:
    """The prior of a description.

    Raises:
        BadInput: a kind that no loaded module defines.
    """
    kind = str(description.get("kind"))
    kind = _ALIASES.get(kind, kind)
    if kind not in KINDS:
        raise BadInput(f"cells of kind {kind!r} are not known here; import the module that defines them first")
    return KINDS[kind].from_description(description)
