"""Generative functions mapped over axes of their arguments.

`vmap` and `repeat` make a `Product` of an exact density, and a `Vmap` of any other function. A `Product` is a
distribution over arrays: `flip.repeat(n=21).repeat(n=21)` stores one (21, 21) array and one score. `Vectorised` is the
base of `Vmap` and of `scan`. An edit of one element costs no time in proportion to the number of elements.
"""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.axes import Mapped, check_index, map_over, replace_term, total, vectorise
from bayesmap.gen.choice_map import ChoiceMap, Indexed
from bayesmap.gen.diff import Change, Diff, IndexChange, NoChange, UnknownChange
from bayesmap.gen.distribution import DistributionTrace, ExactDensity
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, IndexRequest, Regenerate, Update, VectorRequest
from bayesmap.gen.errors import NotSupportedEditRequest
from bayesmap.gen.generative_function import GenerativeFunction, OuterTrace, Trace, decorator_method
from bayesmap.gen.pytree import dataclass, nth, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, InAxes, PRNGKey, Score, Weight


@dataclass
class Product(ExactDensity):
    """A distribution over arrays: one draw of `inner` per element of the mapped arguments, with `split(key, n)[i]`."""

    inner: ExactDensity  # distribution of one element
    in_axes: InAxes = static()  # mapped axes of the arguments, as for `jax.vmap`
    n: int | None = static()  # number of elements; if None, the length of the mapped axes

    def _map(self, args: Arguments) -> Mapped:
        return map_over(self.in_axes, args, self.n)

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        mapped = self._map(args)
        return mapped.vmap(self.inner.draw, jax.random.split(key, mapped.n))

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        return self._map(args).vmap(self.inner.score, value)

    def score(self, value: Any, args: Arguments, flags: Any = None) -> Score:
        """Return the sum of the elements' log densities, shape (). Values whose flag is False add 0."""
        mapped = self._map(args)
        if flags is None:
            scores = mapped.vmap(self.inner.score, value)
        else:
            scores = mapped.vmap(lambda v, flag, args: self.inner.score(v, args, flag), value, flags)
        return total(scores)  # type: ignore[no-any-return]

    def index_shape(self, args: Arguments) -> tuple[int, ...]:
        """Return (n, the shape that an index selects from in one element)."""
        # Trace `inner.index_shape` on abstract arguments of one element: it returns shapes, not arrays.
        mapped, inner_shapes = self._map(args), []

        def of_element(leaves: list[Any]) -> None:
            inner_shapes.append(self.inner.index_shape(mapped.rebuild(leaves)))

        jax.eval_shape(of_element, mapped.element_shapes())
        return (mapped.n, *inner_shapes[0])

    def in_support(self, value: Any) -> Any:
        return self.inner.in_support(value)

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit one element alone if the request names it, else the whole array."""
        match request:
            case IndexRequest(i, inner):
                return self._edit_element(key, trace, i, inner, argdiffs)
            case Update(Indexed(inner, i)) if jnp.ndim(i) == 0:
                return as_update(self._edit_element(key, trace, i, Update(inner), argdiffs))
        return super().edit(key, trace, request, argdiffs)

    def _edit_element(self, key: PRNGKey, trace: Any, i: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Change one element, without reading any other."""
        args = Diff.tree_primal(argdiffs)
        trace, args_weight, _, _ = EmptyRequest().edit(key, trace, argdiffs)
        mapped = self._map(args)
        i = check_index(i, mapped.n)
        # Edit the element's own trace, and store its value and score.
        element_args = mapped.element(i)
        value = trace.value[i]
        element = DistributionTrace(self.inner, element_args, value, self.inner.score(value, element_args))
        edited, weight, retdiff, backward = request.edit(key, element, Diff.no_change(element_args))
        new_value = trace.value.at[i].set(edited.get_retval())
        score = replace_term(trace.score, element.score, edited.get_score(), lambda: self.score(new_value, args))
        new = DistributionTrace(self, args, new_value, score)
        inner_index = retdiff.tangent.index if isinstance(retdiff.tangent, IndexChange) else ()
        return new, args_weight + weight, Diff(new_value, IndexChange((i, *inner_index))), IndexRequest(i, backward)


class Vectorised(GenerativeFunction):
    """Base of functions that run one function, `inner`, many times. Their traces store the runs' traces, stacked.
    A subclass implements `length`, `edit_all` and `edit_one`, and the contract except `edit` and `project`.
    """

    inner: GenerativeFunction

    def length(self, args: Arguments) -> int:
        """Return the number of runs."""
        raise NotImplementedError

    def edit_all(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit every run. Leaves of `request` have a leading axis."""
        raise NotImplementedError

    def edit_one(self, key: PRNGKey, trace: Any, i: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit run number `i`."""
        raise NotImplementedError

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit one run if the request names it, else every run."""
        n = self.length(Diff.tree_primal(argdiffs))
        match request:
            case IndexRequest(i, inner):
                return self.edit_one(key, trace, check_index(i, n), inner, argdiffs)
            case Update(Indexed(inner, i)) if jnp.ndim(i) == 0:
                return as_update(self.edit_one(key, trace, check_index(i, n), Update(inner), argdiffs))
            case Update(constraint) if constraint.static_is_empty():
                return self.edit_all(key, trace, EmptyRequest(), argdiffs)
            case Update(constraint):
                return self.edit_all(key, trace, Update(vectorise(constraint, n)), argdiffs)
            case VectorRequest(requests):
                return self.edit_all(key, trace, requests, argdiffs)
            case Regenerate():
                return self.edit_all(key, trace, request, argdiffs)
        raise NotSupportedEditRequest(self, request)

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return jnp.sum(jax.vmap(lambda t: self.inner.project(key, t, selection))(trace.inner))


def as_update(edited: Edited) -> Edited:
    """Return the outcome of an update of one element with an Update as its backward request, not an IndexRequest."""
    new, weight, retdiff, backward = edited
    return new, weight, retdiff, Update(backward.request.constraint.extend(backward.idx))  # type: ignore[attr-defined]


def undo_all(backward: EditRequest) -> EditRequest:
    """Return the request that undoes an edit of every run, given the runs' backward requests, stacked."""
    return backward if isinstance(backward, Update | EmptyRequest) else VectorRequest(backward)


@dataclass
class VmapTrace(OuterTrace):
    """The trace of a `Vmap`: `inner` has the elements' traces, stacked and without their arguments."""

    score: Score  # sum of the elements' scores

    def get_retval(self) -> Any:
        return self.inner.get_retval()


@dataclass
class Vmap(Vectorised):
    """A generative function mapped over axes of its arguments. See `vmap` and `repeat`."""

    inner: GenerativeFunction  # function of one element
    in_axes: InAxes = static()  # mapped axes of the arguments, as for `jax.vmap`
    n: int | None = static()  # number of elements; if None, the length of the mapped axes

    def _map(self, args: Arguments) -> Mapped:
        return map_over(self.in_axes, args, self.n)

    def length(self, args: Arguments) -> int:
        return self._map(args).n

    def _trace(self, args: Arguments, inner: Trace) -> VmapTrace:
        return VmapTrace(self, args, inner, total(inner.get_score()))

    def simulate(self, key: PRNGKey, args: Arguments) -> VmapTrace:
        mapped = self._map(args)
        keys = jax.random.split(key, mapped.n)
        return self._trace(args, mapped.vmap(lambda k, a: self.inner.simulate(k, a).with_args(None), keys))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[VmapTrace, Weight]:
        """Generate every element with its part of the constraint. The weight is the sum of the elements' weights."""
        mapped = self._map(args)

        def element(key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> Any:
            trace, weight = self.inner.generate(key, constraint, args)
            return trace.with_args(None), weight

        inner, weights = mapped.vmap(element, jax.random.split(key, mapped.n), vectorise(constraint, mapped.n))
        return self._trace(args, inner), total(weights)

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        """Return (sum of the elements' log densities, stacked return values)."""
        mapped = self._map(args)
        choices = vectorise(choices, mapped.n)
        if mapped.n == 0:  # arrays without elements are in no choice map, and simulating draws nothing
            empty = self.simulate(jax.random.key(0), args)
            return empty.get_score(), empty.get_retval()
        scores, retvals = mapped.vmap(self.inner.assess, choices)
        return total(scores), retvals

    def edit_all(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        args = Diff.tree_primal(argdiffs)
        mapped = self._map(args)
        pairs = zip(Diff.tangents(argdiffs), mapped.axes, strict=True)
        tangents = [t if axis is None else _without_index(t) for t, axis in pairs]

        def element(key: PRNGKey, inner: Trace, request: EditRequest, args: Arguments) -> Any:
            new, weight, retdiff, backward = request.edit(key, inner, Diff.zip(args, tangents))
            ret_tangents = [_without_index(t) for t in Diff.tangents(retdiff)]
            return new.with_args(None), weight, Diff.zip(Diff.tree_primal(retdiff), ret_tangents), backward

        keys = jax.random.split(key, mapped.n)
        inner, weights, retdiff, backward = mapped.vmap(element, keys, trace.inner, request)
        return self._trace(args, inner), total(weights), retdiff, undo_all(backward)

    def edit_one(self, key: PRNGKey, trace: Any, i: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Change one element, without reading any other."""
        args = Diff.tree_primal(argdiffs)
        # Move the trace to the new arguments first, then edit the element's own trace.
        trace, args_weight, _, _ = EmptyRequest().edit(key, trace, argdiffs)
        element = nth(trace.inner, i)
        new, weight, retdiff, backward = request.edit(key, element, Diff.no_change(self._map(args).element(i)))

        def store(stack: Any, old: Any, new: Any) -> Any:
            return stack if new is old else stack.at[i].set(new)  # an unchanged leaf is the old object: copy nothing

        inner = jax.tree.map(store, trace.inner, element, new.with_args(None))
        score = replace_term(trace.score, element.get_score(), new.get_score(), lambda: total(inner.get_score()))
        retdiff = Diff.zip(inner.get_retval(), [_change_at(i, t) for t in Diff.tangents(retdiff)])
        return VmapTrace(self, args, inner, score), args_weight + weight, retdiff, IndexRequest(i, backward)


def _without_index(tangent: Change) -> Change:
    """Return the mark of one element and of the whole array: unknown for an index, which fits only one of them."""
    return UnknownChange if isinstance(tangent, IndexChange) else tangent


def _change_at(i: Any, tangent: Change) -> Change:
    """Return the change of the whole array, given the change of its element `i`."""
    if tangent == NoChange:
        return NoChange
    return IndexChange((i, *(tangent.index if isinstance(tangent, IndexChange) else ())))


def _mapped(gen_fn: GenerativeFunction, in_axes: InAxes, n: int | None) -> Any:
    """Return the mapped function: a `Product` for an exact density, otherwise a `Vmap`."""
    kind: Any = Product if isinstance(gen_fn, ExactDensity) else Vmap
    return kind(gen_fn.as_part(), in_axes, n)


@decorator_method
def vmap(*, in_axes: InAxes = 0) -> Callable[[GenerativeFunction], Any]:
    """Return a decorator that maps a generative function over axes of its arguments.
    The i-th element uses the key `split(key, n)[i]`. Choices and return values have a leading axis, and the address of
    a choice of element i begins with i. `in_axes` is as for `jax.vmap`, with one entry per argument: None shares it.
    """
    return lambda gen_fn: _mapped(gen_fn, tuple(in_axes) if isinstance(in_axes, list) else in_axes, None)


@decorator_method
def repeat(*, n: int) -> Callable[[GenerativeFunction], Any]:
    """Return a decorator that calls a generative function `n` times with the same arguments. See `vmap`."""
    return lambda gen_fn: _mapped(gen_fn, None, n)
