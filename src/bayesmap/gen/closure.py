"""A generative function together with its first arguments."""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from typing import Any

from bayesmap.gen import handler
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.edits import Edited, EditRequest
from bayesmap.gen.fluent import method
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.pytree import dataclass
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class GenerativeFunctionClosure(GenerativeFunction):
    """`m(x)`: a site with `@ "address"`, a draw with `(key)`, or `m` with `x` before its arguments.

    Its traces are those of `m`, and their arguments include the ones held here. Where some are given by name, they
    have the form that `m.handle_kwargs()` takes.
    """

    gen_fn: GenerativeFunction
    args: tuple[Any, ...]
    kwargs: dict[str, Any]

    def _full(self, rest: tuple[Any, ...], by_name: dict[str, Any] | None = None) -> tuple[Any, Arguments]:
        """(The function to run, all of its arguments)."""
        args, kwargs = (*self.args, *rest), {**self.kwargs, **(by_name or {})}
        return (self.gen_fn.handle_kwargs(), (args, kwargs)) if kwargs else (self.gen_fn, args)

    def __matmul__(self, address: Any) -> Any:
        return handler.visit(address, *self._full(()))

    def __call__(self, key: PRNGKey, *rest: Any, **by_name: Any) -> Any:
        """Simulate, and keep the return value alone."""
        gen_fn, args = self._full(rest, by_name)
        return gen_fn.simulate(key, args).get_retval()

    def handle_kwargs(self) -> GenerativeFunction:
        """This closure: it takes arguments by name when it is called."""
        return self

    def as_part(self) -> GenerativeFunction:
        return Applied(self)

    def simulate(self, key: PRNGKey, args: Arguments) -> Trace:
        gen_fn, full = self._full(args)
        return gen_fn.simulate(key, full)  # type: ignore[no-any-return]

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        gen_fn, full = self._full(args)
        return gen_fn.assess(choices, full)  # type: ignore[no-any-return]

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        gen_fn, full = self._full(args)
        return gen_fn.generate(key, constraint, full)  # type: ignore[no-any-return]

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        held = Diff.unknown_change(self.args)
        return request.edit(key, trace, _in_form((*held, *argdiffs), Diff.unknown_change(self.kwargs)))

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return trace.project(key, selection)  # type: ignore[no-any-return]


def _in_form(args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[Any, ...]:
    return (args, kwargs) if kwargs else args


@dataclass
class AppliedTrace(Trace):
    """The trace of the function within a closure; its arguments are those that the closure lacked."""

    gen_fn: Any
    args: Any
    inner: Trace

    def get_retval(self) -> Any:
        return self.inner.get_retval()

    def get_score(self) -> Score:
        return self.inner.get_score()

    def get_choices(self) -> ChoiceMap:
        return self.inner.get_choices()

    def get_inner_trace(self, address: Any) -> Trace:
        return self.inner.get_inner_trace(address)


@dataclass
class Applied(GenerativeFunction):
    """A closure as a part of a combinator, whose traces know the closure and not only the function in it."""

    closure: GenerativeFunctionClosure

    def simulate(self, key: PRNGKey, args: Arguments) -> AppliedTrace:
        return AppliedTrace(self, args, self.closure.simulate(key, args))

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        return self.closure.assess(choices, args)

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[AppliedTrace, Weight]:
        inner, weight = self.closure.generate(key, constraint, args)
        return AppliedTrace(self, args, inner), weight

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        held = Diff.no_change((self.closure.args, self.closure.kwargs))
        inner, weight, retdiff, back = request.edit(key, trace.inner, _in_form((*held[0], *argdiffs), held[1]))
        return AppliedTrace(self, Diff.tree_primal(argdiffs), inner), weight, retdiff, back

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return trace.inner.project(key, selection)  # type: ignore[no-any-return]


@method
def apply(gen_fn: GenerativeFunction, args: tuple[Any, ...], kwargs: dict[str, Any]) -> GenerativeFunctionClosure:
    """`gen_fn(*args, **kwargs)`."""
    return GenerativeFunctionClosure(gen_fn, args, kwargs)
