"""The kinds of cells that are built in, by the name that users say, and the prior of a description."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bayesmap.cells.binary import Independent
from bayesmap.cells.ising import Ising
from bayesmap.cells.kind import KINDS, CellPrior
from bayesmap.cells.reflectivity import Beta
from bayesmap.cells.surface import Surface
from bayesmap.errors import BadInput

BUILT_IN: dict[str, type[CellPrior]] = {cls.words.kind: cls for cls in (Independent, Beta, Surface)}

_NAMED: dict[str, type[CellPrior]] = {
    "independent": Independent, "binary": Independent, "ising": Ising, "beta": Beta, "reflectivity": Beta,
}  # fmt: skip
"""What descriptions call priors where that is not the word of the kind, or where a kind has several."""


def prior_from(description: Mapping[str, Any]) -> CellPrior:
    """The prior of a description.

    Raises:
        BadInput: a kind that no loaded module defines.
    """
    kind = str(description.get("kind"))
    named = _NAMED.get(kind, KINDS.get(kind))
    if named is None:
        raise BadInput(f"cells of kind {kind!r} are not known here; import the module that defines them first")
    return named.from_description(description)
