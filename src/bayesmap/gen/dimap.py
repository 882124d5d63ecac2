"""A generative function with its arguments or its return value transformed."""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

import dataclasses
from collections.abc import Callable
from typing import Any

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff, dataflow
from bayesmap.gen.edits import Edited, EditRequest
from bayesmap.gen.generative_function import GenerativeFunction, OuterTrace, Trace, decorator_method
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class DimapTrace(OuterTrace):
    """The inner trace with the outer arguments and return value."""

    gen_fn: Any
    args: Any
    inner: Trace
    retval: Any

    def get_score(self) -> Score:
        return self.inner.get_score()

    def get_inner_trace(self, address: Any) -> Trace:
        inner_args = None if self.args is None else self.gen_fn.pre(*self.args)
        return self.inner.with_args(inner_args).get_inner_trace(address)


def _changes(fn: Callable[..., Any], *inputs: Any) -> Any:
    """Return `fn` of the primal inputs, marked with the change that follows from the marks of the inputs."""
    primal = Diff.tree_primal(inputs)
    flow, value = dataflow(fn, *primal), fn(*primal)
    if flow is None:
        return Diff.unknown_change(value)
    tangents = Diff.tangents(inputs)
    return Diff.zip(value, [origin.change(tangents) for origin in flow])


@dataclass
class Dimap(GenerativeFunction):
    """See `dimap`."""

    inner: GenerativeFunction
    pre: Callable[..., Any] = static()
    post: Callable[..., Any] = static()

    def _inner_args(self, *args: Any) -> tuple[Any, ...]:
        inner_args = self.pre(*args)
        if not isinstance(inner_args, tuple):
            raise TypeError(f"the function of the arguments must return a tuple, not {type(inner_args).__name__}")
        return inner_args

    def _trace(self, args: Arguments, inner_args: Arguments, inner: Trace) -> DimapTrace:
        retval = self.post(args, inner_args, inner.get_retval())
        return DimapTrace(self, args, inner.with_args(None), retval)

    def simulate(self, key: PRNGKey, args: Arguments) -> DimapTrace:
        inner_args = self._inner_args(*args)
        return self._trace(args, inner_args, self.inner.simulate(key, inner_args))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[DimapTrace, Weight]:
        inner_args = self._inner_args(*args)
        inner, weight = self.inner.generate(key, constraint, inner_args)
        return self._trace(args, inner_args, inner), weight

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        inner_args = self._inner_args(*args)
        score, retval = self.inner.assess(choices, inner_args)
        return score, self.post(args, inner_args, retval)

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        inner_diffs = _changes(self._inner_args, *argdiffs)
        inner, weight, inner_retdiff, back = request.edit(key, trace.inner, inner_diffs)
        retdiff = _changes(self.post, argdiffs, inner_diffs, inner_retdiff)
        args = Diff.tree_primal(argdiffs)
        return DimapTrace(self, args, inner.with_args(None), Diff.tree_primal(retdiff)), weight, retdiff, back

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return self.inner.project(key, trace.inner, selection)


def _same_args(*args: Any) -> tuple[Any, ...]:
    return args


def _same_retval(args: Any, inner_args: Any, retval: Any) -> Any:
    return retval


@dataclasses.dataclass(frozen=True)
class _OfRetval:
    """`f` of the return value alone; equal for equal `f`, so that traces can be compared."""

    f: Callable[..., Any]

    def __call__(self, args: Any, inner_args: Any, retval: Any) -> Any:
        return self.f(retval)


@decorator_method
def dimap(
    *, pre: Callable[..., Any] = _same_args, post: Callable[..., Any] = _same_retval
) -> Callable[[GenerativeFunction], Dimap]:
    """Return a decorator that transforms arguments by `pre` and the return value by `post`.

    Args:
        pre: takes the arguments, and returns the inner function's arguments as a tuple.
        post: takes (arguments, inner arguments, inner return value).

    Raises, when it runs:
        TypeError: `pre` does not return a tuple.
    """
    return lambda gen_fn: Dimap(gen_fn.as_part(), pre, post)


@decorator_method
def map(f: Callable[[Any], Any]) -> Callable[[GenerativeFunction], Dimap]:
    """Return a decorator that applies `f` to the return value."""
    return dimap(post=_OfRetval(f))


@decorator_method
def contramap(f: Callable[..., Any]) -> Callable[[GenerativeFunction], Dimap]:
    """Return a decorator that passes the arguments through `f`, which returns a tuple."""
    return dimap(pre=f)
