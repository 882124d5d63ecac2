"""Where the chains of the page start."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.chains import pose_prior, pose_starts
from bayesmap.app.document import Document
from bayesmap.app.preview import Preview
from bayesmap.app.stream import CHAINS, POSE_CHAINS
from bayesmap.samplers.propagate import Marginals
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import Start, start_maps


def starts(problem: WallProblem, document: Document, preview: Preview | None) -> NDArray[np.bool_]:
    """One map a chain, (chains, nx, ny), that depends on the document alone.

    "prior" and "empty" are what they say. "auto" is prior draws where there is no preview. After one, the first chain
    of a simulation starts from what belief propagation says and the second from the empty map, and so on in turn:
    chains that started alike would agree on a wrong answer long before they have left it. On a file, whose maps are
    large, all start from belief propagation, with prior draws where it says nothing.
    """
    chains = CHAINS if pose_prior(document) is None else POSE_CHAINS

    def maps(kind: Start, marginals: Marginals | None = None) -> NDArray[np.bool_]:
        return start_maps(problem, kind, range(chains), document.seed, marginals)

    if document.start == "empty":
        return maps("zeros")
    if document.start == "prior" or preview is None:
        return maps("prior")
    likely = maps("propagate", preview.marginals())
    if not document.simulated:
        return likely
    likely[1::2] = False
    if chains > CHAINS:  # a map that is shifted starts empty: the beliefs are those of another place
        likely[(pose_starts(document, chains) != pose_starts(document, 1)).any(axis=(1, 2))] = False
    return likely
