"""Calls of generative functions: the stack of running `@gen` bodies, and functions with some of their arguments."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from jax.extend.core import get_opaque_trace_state

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.edits import Edited, EditRequest
from bayesmap.gen.errors import AddressError, AddressReuse, NotAnAddress
from bayesmap.gen.generative_function import GenerativeFunction, OuterTrace, Trace, method
from bayesmap.gen.pytree import dataclass
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, StaticAddress, Weight

# ruff: noqa: D102 - the methods are those of the contract, documented with it.

_local = threading.local()


def as_path(address: Any) -> StaticAddress:
    """Return an address of names as a tuple.

    Raises:
        NotAnAddress: some component is not a string.
    """
    path = address if isinstance(address, tuple) else (address,)
    if not all(isinstance(component, str) for component in path):
        raise NotAnAddress(path, "the address of a site is a string or a tuple of strings")
    return path


def _trace_state() -> Any:
    return get_opaque_trace_state(convention="flax")  # type: ignore[no-untyped-call]


class Handler:
    """One run of a body, which calls `visit` for each site, in order."""

    def __init__(self) -> None:
        self.visited: list[StaticAddress] = []
        self.trace_state = _trace_state()

    def visit(self, path: StaticAddress, gen_fn: Any, args: tuple[Any, ...]) -> Any:
        """Return the value of the site's call."""
        raise NotImplementedError

    def enter(self, path: StaticAddress) -> None:
        """Record a site.

        Raises:
            AddressReuse: another site is at, above or below the same address.
            AddressError: the site lies in a JAX transformation within the body.
        """
        for other in self.visited:
            shared = min(len(other), len(path))
            if other[:shared] == path[:shared]:
                raise AddressReuse(path, f"there is one at {other}")
        if _trace_state() != self.trace_state:
            remedy = "use the vmap, scan or or_else combinator"
            raise AddressError(path, f"the site is inside a jax transformation within the body; {remedy}")
        self.visited.append(path)


@contextmanager
def running(handler: Handler) -> Iterator[None]:
    """Let `handler` receive the sites of the code inside."""
    stack = _local.__dict__.setdefault("stack", [])
    stack.append(handler)
    try:
        yield
    finally:
        stack.pop()


@dataclass
class GenerativeFunctionClosure(GenerativeFunction):
    """`m(x)`: a site with `@ "address"`, a draw with `(key)`, or `m` with `x` before its arguments.

    Its traces are traces of `m`, whose arguments include `x`. Where some arguments are given by name, the traces'
    arguments have the form that `m.handle_kwargs()` takes.
    """

    gen_fn: GenerativeFunction
    args: tuple[Any, ...]
    kwargs: dict[str, Any]

    def _full(self, rest: tuple[Any, ...], by_name: dict[str, Any] | None = None) -> tuple[Any, Arguments]:
        """Return (the function to run, all of its arguments)."""
        args, kwargs = (*self.args, *rest), {**self.kwargs, **(by_name or {})}
        return (self.gen_fn.handle_kwargs(), (args, kwargs)) if kwargs else (self.gen_fn, args)

    def __matmul__(self, address: Any) -> Any:
        stack, path = getattr(_local, "stack", []), as_path(address)
        if not stack:
            raise AddressError(path, "`@` is for the body of a @gen function; call the closure with a key instead")
        stack[-1].enter(path)
        return stack[-1].visit(path, *self._full(()))

    def __call__(self, key: PRNGKey, *rest: Any, **by_name: Any) -> Any:
        """Simulate, and return the return value alone."""
        gen_fn, args = self._full(rest, by_name)
        return gen_fn.simulate(key, args).get_retval()

    def handle_kwargs(self) -> GenerativeFunction:
        """Return this closure, which takes arguments by name when it is called."""
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
class AppliedTrace(OuterTrace):
    """The trace of the function within a closure; its arguments are the arguments that the closure lacked."""

    gen_fn: Any
    args: Any
    inner: Trace

    def get_retval(self) -> Any:
        return self.inner.get_retval()

    def get_score(self) -> Score:
        return self.inner.get_score()


@dataclass
class Applied(GenerativeFunction):
    """A closure as a part of a combinator. Its traces know the closure, not only the function in the closure."""

    closure: GenerativeFunctionClosure

    def simulate(self, key: PRNGKey, args: Arguments) -> AppliedTrace:
        return AppliedTrace(self, args, self.closure.simulate(key, args))

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        return self.closure.assess(choices, args)

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[AppliedTrace, Weight]:
        inner, weight = self.closure.generate(key, constraint, args)
        return AppliedTrace(self, args, inner), weight

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        args, kwargs = Diff.no_change((self.closure.args, self.closure.kwargs))
        inner, weight, retdiff, back = request.edit(key, trace.inner, _in_form((*args, *argdiffs), kwargs))
        return AppliedTrace(self, Diff.tree_primal(argdiffs), inner), weight, retdiff, back

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return trace.inner.project(key, selection)  # type: ignore[no-any-return]


@method
def apply(gen_fn: GenerativeFunction, args: tuple[Any, ...], kwargs: dict[str, Any]) -> GenerativeFunctionClosure:
    """Return `gen_fn(*args, **kwargs)`."""
    return GenerativeFunctionClosure(gen_fn, args, kwargs)
