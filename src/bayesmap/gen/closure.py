"""Calls of generative functions: running `@gen` bodies, fixed arguments, transformed arguments and return values.

`g(x)` is a `GenerativeFunctionClosure`. In the body of a `@gen` function, `g(x) @ "address"` is a site: the `Handler`
of the present run traces it. `Outer` is the base of functions that wrap one other function, such as `Dimap`.
"""

import dataclasses
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from jax.extend.core import get_opaque_trace_state

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff, dataflow
from bayesmap.gen.edits import Edited, EditRequest
from bayesmap.gen.errors import AddressError, AddressReuse, NotAnAddress
from bayesmap.gen.generative_function import GenerativeFunction, OuterTrace, Trace, decorator_method, method
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, StaticAddress, Weight

_local = threading.local()


def as_path(address: Any) -> StaticAddress:
    """Return an address of names as a tuple. Raises NotAnAddress if a component is not a string."""
    path = address if isinstance(address, tuple) else (address,)
    if not all(isinstance(component, str) for component in path):
        raise NotAnAddress(path, "the address of a site is a string or a tuple of strings")
    return path


def _trace_state() -> Any:
    """Return a value that differs inside each JAX transformation. It reveals sites in a transformation."""
    return get_opaque_trace_state(convention="flax")  # type: ignore[no-untyped-call]


class Handler:
    """One run of the body of a `@gen` function. The body calls `enter` and `visit` for each site, in order."""

    def __init__(self) -> None:
        self.visited: list[StaticAddress] = []
        self.trace_state = _trace_state()

    def visit(self, path: StaticAddress, gen_fn: Any, args: tuple[Any, ...]) -> Any:
        """Return the value of the site's call."""
        raise NotImplementedError

    def enter(self, path: StaticAddress) -> None:
        """Record a site. Raises AddressError if its address is in use, or if it lies in a JAX transformation."""
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
    """Let `handler` receive the sites of the code inside. Runs may be nested: the innermost handler receives them."""
    stack = _local.__dict__.setdefault("stack", [])
    stack.append(handler)
    try:
        yield
    finally:
        stack.pop()


class Outer(GenerativeFunction):
    """Base of functions that have the choices of one other function, `inner`. The contract's methods pass on to it."""

    inner: GenerativeFunction

    def inner_args(self, args: Arguments) -> Arguments:
        """Return the inner function's arguments."""
        raise NotImplementedError

    def wrap(self, args: Arguments, inner: Any) -> OuterTrace:
        """Return the trace of a run on `args`, given the trace of the inner function."""
        raise NotImplementedError

    def simulate(self, key: PRNGKey, args: Arguments) -> OuterTrace:
        return self.wrap(args, self.inner.simulate(key, self.inner_args(args)))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[OuterTrace, Weight]:
        inner, weight = self.inner.generate(key, constraint, self.inner_args(args))
        return self.wrap(args, inner), weight

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        return self.inner.assess(choices, self.inner_args(args))

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return self.inner.project(key, trace.inner, selection)


def _with_kwargs(args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[Any, ...]:
    """Return arguments as one tuple, in the form of `handle_kwargs` if some are given by name."""
    return (args, kwargs) if kwargs else args


@dataclass
class GenerativeFunctionClosure(Outer):
    """`m(x)`: a site with `@ "address"`, a draw with `(key)`, or `m` with `x` before its other arguments.
    Its traces are traces of `m`, or of `m.handle_kwargs()` if some arguments are named. Their arguments include `x`.
    """

    gen_fn: GenerativeFunction  # m
    args: tuple[Any, ...]  # the positional arguments so far
    kwargs: dict[str, Any]  # the arguments by name so far

    @property
    def inner(self) -> GenerativeFunction:  # type: ignore[override]
        """The function that is called."""
        return self.gen_fn.handle_kwargs() if self.kwargs else self.gen_fn

    def inner_args(self, args: Arguments) -> Arguments:
        return _with_kwargs((*self.args, *args), self.kwargs)

    def wrap(self, args: Arguments, inner: Any) -> Any:
        return inner

    def __matmul__(self, address: Any) -> Any:
        """Visit the site at `address` of the body that runs, and return the value of the call."""
        stack = getattr(_local, "stack", [])
        path = as_path(address)
        if not stack:
            raise AddressError(path, "`@` is for the body of a @gen function; call the closure with a key instead")
        stack[-1].enter(path)
        return stack[-1].visit(path, self.inner, self.inner_args(()))

    def __call__(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        """Simulate, and return only the return value."""
        return self.replace(kwargs={**self.kwargs, **kwargs}).simulate(key, args).get_retval()

    def handle_kwargs(self) -> GenerativeFunction:
        """Return this closure, which takes arguments by name when it is called."""
        return self

    def as_part(self) -> GenerativeFunction:
        """Return an `Applied`, because a combinator needs traces that lead back to this closure."""
        return Applied(self.inner, self.args, self.kwargs)

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit a trace of the inner function. It may be of a call with other fixed arguments: they count as changed."""
        fixed_args, fixed_kwargs = Diff.unknown_change((self.args, self.kwargs))
        return request.edit(key, trace, _with_kwargs((*fixed_args, *argdiffs), fixed_kwargs))

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return trace.project(key, selection)  # type: ignore[no-any-return]


@dataclass
class TransformedTrace(OuterTrace):
    """The inner trace, without its arguments, with the outer arguments and return value."""

    retval: Any

    def get_score(self) -> Score:
        return self.inner.get_score()

    def get_inner_trace(self, address: Any) -> Trace:
        """Return the inner function's trace at one address. The inner arguments are computed again."""
        inner_args = None if self.args is None else self.gen_fn.inner_args(self.args)
        return self.inner.with_args(inner_args).get_inner_trace(address)


@dataclass
class Applied(Outer):
    """A closure as a part of a combinator. Its traces store the closure, not only the function in the closure."""

    inner: GenerativeFunction
    fixed_args: tuple[Any, ...]  # the closure's arguments
    fixed_kwargs: dict[str, Any]  # the closure's arguments by name

    def inner_args(self, args: Arguments) -> Arguments:
        return _with_kwargs((*self.fixed_args, *args), self.fixed_kwargs)

    def wrap(self, args: Arguments, inner: Trace) -> TransformedTrace:
        return TransformedTrace(self, args, inner.with_args(None), inner.get_retval())

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit the inner trace. The fixed arguments are unchanged."""
        fixed_args, fixed_kwargs = Diff.no_change((self.fixed_args, self.fixed_kwargs))
        inner_diffs = _with_kwargs((*fixed_args, *argdiffs), fixed_kwargs)
        inner, weight, retdiff, backward = request.edit(key, trace.inner, inner_diffs)
        return self.wrap(Diff.tree_primal(argdiffs), inner), weight, retdiff, backward


@method
def apply(gen_fn: GenerativeFunction, args: tuple[Any, ...], kwargs: dict[str, Any]) -> GenerativeFunctionClosure:
    """Return `gen_fn(*args, **kwargs)`."""
    return GenerativeFunctionClosure(gen_fn, args, kwargs)


def _apply_to_diffs(fn: Callable[..., Any], *inputs: Any) -> Any:
    """Return `fn` of the primal inputs, marked with the change that follows from the marks of the inputs."""
    primal = Diff.tree_primal(inputs)
    origins = dataflow(fn, *primal)
    value = fn(*primal)
    if origins is None:
        return Diff.unknown_change(value)
    tangents = Diff.tangents(inputs)
    return Diff.zip(value, [origin.change(tangents) for origin in origins])


@dataclass
class Dimap(Outer):
    """A generative function with transformed arguments and return value. See `dimap`."""

    inner: GenerativeFunction
    pre: Callable[..., Any] = static()  # (*arguments) -> inner arguments, a tuple
    post: Callable[..., Any] = static()  # (arguments, inner arguments, inner return value) -> return value

    def inner_args(self, args: Arguments) -> Arguments:
        """Return the arguments after `pre`. Raises TypeError unless they are a tuple."""
        inner_args = self.pre(*args)
        if not isinstance(inner_args, tuple):
            raise TypeError(f"the function of the arguments must return a tuple, not {type(inner_args).__name__}")
        return inner_args

    def wrap(self, args: Arguments, inner: Trace) -> TransformedTrace:
        retval = self.post(args, inner.get_args(), inner.get_retval())
        return TransformedTrace(self, args, inner.with_args(None), retval)

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        score, retval = super().assess(choices, args)
        return score, self.post(args, self.inner_args(args), retval)

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit the inner trace. `pre` and `post` pass on which values changed."""
        inner_diffs = _apply_to_diffs(self.inner_args, argdiffs)
        inner, weight, inner_retdiff, backward = request.edit(key, trace.inner, inner_diffs)
        retdiff = _apply_to_diffs(self.post, argdiffs, inner_diffs, inner_retdiff)
        args, retval = Diff.tree_primal((argdiffs, retdiff))
        return TransformedTrace(self, args, inner.with_args(None), retval), weight, retdiff, backward


def _same_args(*args: Any) -> tuple[Any, ...]:
    """Return the arguments: the default of `pre`."""
    return args


def _same_retval(args: Any, inner_args: Any, retval: Any) -> Any:
    """Return the return value: the default of `post`."""
    return retval


@dataclasses.dataclass(frozen=True)
class _OfRetval:
    """A `post` that applies `f` to the return value alone. Equal `f` make it equal, so that traces can be compared."""

    f: Callable[..., Any]

    def __call__(self, args: Any, inner_args: Any, retval: Any) -> Any:
        return self.f(retval)


@decorator_method
def dimap(
    *, pre: Callable[..., Any] = _same_args, post: Callable[..., Any] = _same_retval
) -> Callable[[GenerativeFunction], Dimap]:
    """Return a decorator that transforms arguments by `pre` and the return value by `post`.
    `pre` returns the inner arguments as a tuple. `post` takes (arguments, inner arguments, inner return value).
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
