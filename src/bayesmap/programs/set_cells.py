"""An edit of several cells at once, such as a 2 x 2 block."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff, IndexChange
from bayesmap.gen.edits import Edited, EditRequest, IndexRequest, Update
from bayesmap.gen.generative_function import Trace
from bayesmap.gen.pytree import dataclass
from bayesmap.gen.typing import PRNGKey


@dataclass
class SetCells(EditRequest):
    """Give the cells (i[k], j[k]) of a map the values `values[k]`: a request for the address "walls".

    A block is `SetCells(i + jnp.array([0, 0, 1, 1]), j + jnp.array([0, 1, 0, 1]), values)`. The work is that of
    changing the cells one by one, beams included.

    Attributes:
        i, j: cells, integers, shape (k,); the shape is known when the program is compiled, the cells need not be.
        values: shape (k,).
    """

    i: Any
    j: Any
    values: Any

    def edit(self, key: PRNGKey, trace: Trace, argdiffs: Any) -> Edited:
        """Edit one cell after the other. Undone by the same request with the old values."""
        i, j, values = jnp.broadcast_arrays(*map(jnp.atleast_1d, (self.i, self.j, self.values)))
        old = trace.get_retval()[i, j]
        weight = jnp.zeros(())
        for row, column, value in zip(i.ravel(), j.ravel(), values.ravel(), strict=True):
            request = IndexRequest(row, IndexRequest(column, Update(ChoiceMap.choice(value))))
            trace, gain, _, _ = trace.edit(key, request, argdiffs)
            argdiffs = Diff.no_change(Diff.tree_primal(argdiffs))
            weight += gain
        return trace, weight, Diff.tree(trace.get_retval(), IndexChange((i, j))), SetCells(i, j, old)
