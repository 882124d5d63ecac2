"""Independent draws from one distribution: again a distribution, over arrays.

So `flip.repeat(n=21).repeat(n=21)` stores one (21, 21) array and one score, whatever the nesting.
"""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.axes import Mapped, map_over, replace_term, total
from bayesmap.gen.choice_map import Indexed
from bayesmap.gen.dense import check_index
from bayesmap.gen.diff import Diff, IndexChange
from bayesmap.gen.distribution import DistributionTrace, ExactDensity
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, IndexRequest, Update
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.typing import Arguments, InAxes, PRNGKey, Score


@dataclass
class Product(ExactDensity):
    """`inner` drawn once per element of the mapped arguments, element i with the i-th of `split(key, n)`."""

    inner: ExactDensity
    in_axes: InAxes = static()
    n: int | None = static()

    def _map(self, args: Arguments) -> Mapped:
        return map_over(self.in_axes, args, self.n)

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        mapped = self._map(args)
        return mapped.vmap(self.inner.draw, jax.random.split(key, mapped.n))

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        return self._map(args).vmap(self.inner.score, value)

    def score(self, value: Any, args: Arguments, given: Any = None) -> Score:
        rest = (value,) if given is None else (value, given)
        scores = self._map(args).vmap(lambda v, *g_args: self.inner.score(v, g_args[-1], *g_args[:-1]), *rest)
        return total(scores)  # type: ignore[no-any-return]

    def index_shape(self, args: Arguments) -> tuple[int, ...]:
        mapped, below = self._map(args), []

        def of_element(leaves: list[Any]) -> None:
            below.append(self.inner.index_shape(mapped.rebuild(leaves)))

        jax.eval_shape(of_element, mapped.element_shapes())
        return (mapped.n, *below[0])

    def in_support(self, value: Any) -> Any:
        return self.inner.in_support(value)

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        match request:
            case IndexRequest(i, inner):
                return self._edit_element(key, trace, i, inner, argdiffs)
            case Update(Indexed(inner, i)) if jnp.ndim(i) == 0:
                new, weight, retdiff, back = self._edit_element(key, trace, i, Update(inner), argdiffs)
                return new, weight, retdiff, Update(back.request.constraint.extend(back.idx))  # type: ignore[attr-defined]
        return super().edit(key, trace, request, argdiffs)

    def _edit_element(self, key: PRNGKey, trace: Any, i: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Change one element; no other is looked at."""
        args = Diff.tree_primal(argdiffs)
        trace, before, _, _ = EmptyRequest().edit(key, trace, argdiffs)
        mapped = self._map(args)
        i = check_index(i, mapped.n)
        here = mapped.element(i)
        value = trace.value[i]
        element = DistributionTrace(self.inner, here, value, self.inner.score(value, here))
        edited, weight, retdiff, back = request.edit(key, element, Diff.no_change(here))
        new_value = trace.value.at[i].set(edited.get_retval())
        below = retdiff.tangent.index if isinstance(retdiff.tangent, IndexChange) else ()
        score = replace_term(trace.score, element.score, edited.get_score(), lambda: self.score(new_value, args))
        new = DistributionTrace(self, args, new_value, score)
        return new, before + weight, Diff(new_value, IndexChange((i, *below))), IndexRequest(i, back)
