"""Where the chains of the page start."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.document import Document
from bayesmap.app.preview import Preview
from bayesmap.app.stream import CHAINS
from bayesmap.samplers.problem import WallProblem
from bayesmap.samplers.propagate import Marginals
from bayesmap.samplers.start import Start, start_map


def starts(problem: WallProblem, document: Document, preview: Preview | None) -> NDArray[np.bool_]:
    """One map a chain, (chains, nx, ny), that depends on the document alone.

    "prior" and "empty" are what they say. "auto" is prior draws where there is no preview. After one, the first chain
    of a simulation starts from what belief propagation says and the second from the empty map: two chains that started
    alike would agree on a wrong answer long before they have left it. On a file, whose maps are large, both start from
    belief propagation, with prior draws where it says nothing.
    """

    def maps(kind: Start, marginals: Marginals | None = None) -> NDArray[np.bool_]:
        return np.stack([start_map(problem, kind, chain, document.seed, marginals) for chain in range(CHAINS)])

    if document.start == "empty":
        return maps("zeros")
    if document.start == "prior" or preview is None:
        return maps("prior")
    likely = maps("propagate", preview.marginals())
    if not document.simulated:
        return likely
    empty = np.zeros_like(likely[1:])
    return np.concatenate([likely[:1], empty])
