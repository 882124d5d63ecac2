"""The kinds of cells that are built in, by the name that users say."""

from __future__ import annotations

from bayesmap.cells.binary import Independent
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.reflectivity import Beta
from bayesmap.cells.surface import Surface

BUILT_IN: dict[str, type[CellPrior]] = {cls.words.kind: cls for cls in (Independent, Beta, Surface)}
