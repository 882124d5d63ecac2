"""`@gen`: a Python function whose calls of other generative functions are traced by address.

Such a call in the function's body is a site. `StaticGenerativeFunction` at the end has the contract's methods. Each
method runs the body under a handler that visits the sites: `_Run` to draw, `_Assess` to score, `_Edit` to edit. An edit
derives from the body's dataflow which arguments of a site have changed.
"""

import functools
import importlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.closure import Handler, as_path, running
from bayesmap.gen.diff import Change, Diff, NoChange, Origin, UnknownChange, dataflow
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, Regenerate, StaticRequest, Update
from bayesmap.gen.errors import AddressError, NotSupportedEditRequest, UnknownAddress, format_address
from bayesmap.gen.generative_function import GenerativeFunction, Trace, in_dtypes_of
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, StaticAddress, Weight

RequestAt = Callable[[StaticAddress], EditRequest]  # the request for the site at an address


class Replay(Handler):
    """A run whose sites return the values `retvals`. It stores each site's function and arguments in `calls`."""

    def __init__(self, retvals: dict[StaticAddress, Any]) -> None:
        super().__init__()
        self.retvals = retvals
        self.calls: dict[StaticAddress, Any] = {}

    def run(self, gen_fn: Any, args: Arguments) -> Any:
        """Run the body and return its return value."""
        with running(self):
            return gen_fn.call(args)

    def visit(self, path: StaticAddress, gen_fn: Any, args: Arguments) -> Any:
        if path not in self.retvals:
            raise UnknownAddress(path, "the trace that is edited has no such site")
        self.calls[path] = (gen_fn, args)
        return self.retvals[path]


@dataclass
class StaticTrace(Trace):
    """The calls of one run by address.
    If a call returned a leaf of the return value, only the call's trace stores the leaf, and its entry in `sources` is
    (address, number of the call's leaf). Otherwise the entry is None, and `computed` stores the leaf.
    """

    subtraces: dict[StaticAddress, Trace]
    computed: list[Any]
    retval_tree: Any = static()
    sources: tuple[tuple[StaticAddress, int] | None, ...] = static()

    @staticmethod
    def build(gen_fn: Any, args: Any, retval: Any, subtraces: dict[StaticAddress, Trace]) -> "StaticTrace":
        """Return the trace of a run whose calls made `subtraces`, in order."""
        # Leaves are recognised by identity: a leaf of a call that the body returns unchanged is the same object.
        source_by_id: dict[int, tuple[StaticAddress, int]] = {}
        for path, trace in subtraces.items():
            for k, leaf in enumerate(jax.tree.leaves(trace.get_retval())):
                source_by_id.setdefault(id(leaf), (path, k))
        leaves, tree = jax.tree.flatten(retval)
        sources = tuple(source_by_id.get(id(leaf)) if isinstance(leaf, jax.Array) else None for leaf in leaves)
        computed = [leaf for leaf, source in zip(leaves, sources, strict=True) if source is None]
        return StaticTrace(gen_fn, args, subtraces, computed, tree, sources)

    def get_retval(self) -> Any:
        """Return the return value, whose leaves come from `computed` and from the sites' traces."""
        computed = iter(self.computed)
        site_leaves = {path: jax.tree.leaves(t.get_retval()) for path, t in self.subtraces.items()}
        leaves = [next(computed) if source is None else site_leaves[source[0]][source[1]] for source in self.sources]
        return self.retval_tree.unflatten(leaves)

    def get_score(self) -> Score:
        return sum((t.get_score() for t in self.subtraces.values()), start=jnp.zeros(()))

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.from_mapping((path, t.get_choices()) for path, t in self.subtraces.items())

    def get_inner_trace(self, address: Any) -> Trace:
        """Return the trace of the site at `address`, with the arguments that the body gave to the site."""
        path = as_path(address)
        _require_sites([path], list(self.subtraces))
        if self.args is None:
            return self.subtraces[path]

        # The trace stores no arguments of sites: run the body again. A vectorised trace needs one vmap per axis.
        def site_args(trace: StaticTrace) -> Any:
            replay = Replay({p: t.get_retval() for p, t in trace.subtraces.items()})
            replay.run(trace.gen_fn, trace.args)
            return replay.calls[path][1]

        for _ in range(jnp.ndim(self.subtraces[path].get_score())):
            site_args = jax.vmap(site_args)
        return self.subtraces[path].with_args(site_args(self))


class _Run(Handler):
    """A run that records traces from `trace_site(path, function, arguments, key)`, and the sum of their weights."""

    def __init__(self, key: PRNGKey, trace_site: Callable[..., tuple[Trace, Any]]) -> None:
        super().__init__()
        self.key, self.trace_site = key, trace_site
        self.traces: dict[StaticAddress, Trace] = {}
        self.weight: Any = 0.0

    def run(self, gen_fn: "StaticGenerativeFunction", args: Arguments) -> tuple[StaticTrace, Weight]:
        """Run the body; return the trace and the weight of the run."""
        if not isinstance(args, tuple):
            raise TypeError(f"args must be a tuple of arguments, not {type(args).__name__}")
        with running(self):
            retval = gen_fn.call(args)
        return StaticTrace.build(gen_fn, args, retval, self.traces), jnp.asarray(self.weight, jnp.result_type(float))

    def visit(self, path: StaticAddress, gen_fn: Any, args: Arguments) -> Any:
        """Trace the site, and return its value."""
        with _errors_below(path):
            trace, weight = self.trace_site(path, gen_fn, args, jax.random.fold_in(self.key, len(self.visited)))
        self.weight += weight
        self.traces[path] = trace.with_args(None)
        return trace.get_retval()


class _Assess(Handler):
    """A run on given choices. It sums the sites' log densities in `score`."""

    def __init__(self, choices: ChoiceMap) -> None:
        super().__init__()
        self.choices = choices
        self.score: Score = jnp.zeros(())

    def visit(self, path: StaticAddress, gen_fn: Any, args: Arguments) -> Any:
        """Score the site's choices, and return its value."""
        with _errors_below(path):
            score, retval = gen_fn.assess(self.choices(path), args)
        self.score += score
        return retval


class _Edit(_Run):
    """A run that edits each site's trace, given which of the site's arguments changed.
    `request_at(path)` returns the request for a site. `flow` stores the origins of the body's outputs, as returned by
    `_body_dataflow`. `input_changes` are the changes of the leaves of the body's function and arguments.
    `return_changes` are the changes of the leaves of each site's return value. `n_outputs` counts the leaves so far.
    """

    def __init__(self, key: PRNGKey, old: StaticTrace, request_at: RequestAt, argdiffs: Any):
        super().__init__(key, self.edit_site)
        self.old, self.request_at = old, request_at
        self.backward: dict[StaticAddress, EditRequest] = {}
        self.flow = _body_dataflow(old, Diff.tree_primal(argdiffs))
        fn_changes: list[Change] = [NoChange] * len(jax.tree.leaves(old.gen_fn))
        self.input_changes = fn_changes + Diff.tangents(argdiffs)
        self.return_changes: dict[StaticAddress, list[Change]] = {}
        self.n_outputs = 0

    def with_known_changes(self, value: Any) -> Any:
        """Return the next output of the body as `Diff` leaves. A change that cannot be derived is marked unknown."""
        first = self.n_outputs
        self.n_outputs += len(jax.tree.leaves(value))
        if self.flow is None:
            return Diff.unknown_change(value)
        changes = list(self.input_changes)
        for path, subtrace in self.old.subtraces.items():
            unknown = [UnknownChange] * len(jax.tree.leaves(subtrace.get_retval()))
            changes += self.return_changes.get(path, unknown)
        return Diff.zip(value, [origin.change(changes) for origin in self.flow[first : self.n_outputs]])

    def edit_site(self, path: StaticAddress, gen_fn: Any, args: Arguments, key: PRNGKey) -> tuple[Trace, Weight]:
        """Return the site's edited trace and the weight of the edit; store its changes and its backward request."""
        if path not in self.old.subtraces:
            raise UnknownAddress((), "the trace that is edited has no such site")
        # A function that the body defined again, and that may differ, needs a full rescoring.
        fn_diff, argdiffs = self.with_known_changes((gen_fn, args))
        subtrace, request = self.old.subtraces[path], self.request_at(path)
        same_structure = bool(jax.tree.structure(gen_fn) == jax.tree.structure(subtrace.get_gen_fn()))  # type: ignore[operator]
        if same_structure and Diff.static_check_no_change(fn_diff):
            trace, weight, retdiff, backward = request.edit(key, subtrace, argdiffs)
        else:
            trace, weight, retdiff, backward = _edit_by_rescoring(key, subtrace, gen_fn, request, args)
        self.return_changes[path] = Diff.tangents(retdiff)
        self.backward[path] = backward
        return trace, weight


def _body_dataflow(old: StaticTrace, args: Arguments) -> list[Origin] | None:
    """Return the origins of the leaves of sites' functions and arguments, and of the result; None if unknown."""

    def body(gen_fn: Any, args: Arguments, *retvals: Any) -> Any:
        replay = Replay(dict(zip(old.subtraces, retvals, strict=True)))
        retval = replay.run(gen_fn, args)
        return list(replay.calls.values()), retval

    return dataflow(body, old.gen_fn, args, *(t.get_retval() for t in old.subtraces.values()))


def _edit_by_rescoring(key: PRNGKey, old: Trace, gen_fn: Any, request: EditRequest, args: Arguments) -> Edited:
    """Edit the trace of a function that the body defined again and that may differ, by scoring the whole trace.
    A request that depends on addresses alone becomes a call of `generate`. Another request edits the rescored trace.
    """
    choices = old.get_choices()
    match request:
        case Update(constraint):
            new_constraint, removed_score = constraint | choices, old.get_score()
        case EmptyRequest():
            new_constraint, removed_score = choices, old.get_score()
        case Regenerate(selection):
            new_constraint, removed_score = choices.filter(~selection), old.project(key, ~selection)
        case _:
            trace, weight, _, _ = _edit_by_rescoring(key, old, gen_fn, EmptyRequest(), args)
            trace, edit_weight, retdiff, backward = request.edit(key, trace, Diff.no_change(args))
            return trace, weight + edit_weight, Diff.unknown_change(Diff.tree_primal(retdiff)), backward
    trace, weight = gen_fn.generate(key, new_constraint, args)
    trace = in_dtypes_of(old, trace.with_args(None)).with_args(args)
    return trace, weight - removed_score, Diff.unknown_change(trace.get_retval()), Update(choices)


@contextmanager
def _errors_below(path: StaticAddress) -> Iterator[None]:
    """Prefix the addresses of errors in the code inside with `path`, the address of a site."""
    try:
        yield
    except AddressError as error:
        raise error.under(path) from None


def _require_sites(paths: Iterable[Any], sites: list[StaticAddress]) -> None:
    """Raise UnknownAddress if a path is not the address of a site."""
    for path in paths:
        if path not in sites:
            raise UnknownAddress(path, f"its sites are {', '.join(map(format_address, sites))}")


def _require_reachable(paths: Iterable[Any], visited: list[StaticAddress]) -> None:
    """Raise UnknownAddress if a path is neither at nor below a site."""
    sites = ", ".join(map(format_address, visited)) or "none"
    for path in paths:
        if path == () and () not in visited:
            raise UnknownAddress((), f"there is a function with the sites {sites}, so a bare value cannot stand for it")
        if not any(path[: len(site)] == site for site in visited):
            raise UnknownAddress(path, f"its sites are {sites}")


@dataclass
class StaticGenerativeFunction(GenerativeFunction):
    """A Python function under `@gen`."""

    partial_args: tuple[Any, ...]  # fixed arguments, which come before the others
    source: Callable[..., Any] = static()  # the Python function
    by_name: bool = static(default=False)  # whether arguments have the form ((positional, ...), {"name": value})

    def call(self, args: Arguments) -> Any:
        """Run the body."""
        positional, named = args if self.by_name else (args, {})
        return self.source(*self.partial_args, *positional, **named)

    def inline(self, *args: Any) -> Any:
        """Run the body as if the caller contained it: its sites become the caller's sites."""
        return self.call(args)

    def partial_apply(self, *args: Any) -> "StaticGenerativeFunction":
        """Return the function with its first arguments fixed. Its traces' arguments leave them out."""
        return self.replace(partial_args=(*self.partial_args, *args))

    def handle_kwargs(self) -> "StaticGenerativeFunction":
        """Return the function with arguments in the form `by_name`."""
        return self.replace(by_name=True)

    def __get__(self, instance: Any, owner: Any = None) -> "StaticGenerativeFunction":
        """Return the method of `instance`, as a plain Python function in a class does."""
        return self if instance is None else self.partial_apply(instance)

    def __reduce__(self) -> Any:
        """Pickle the source by its name; the source of a local function is pickled as it is."""
        # The source's name in its module now stands for this object, so pickle finds the source through this object.
        if "<" in self.source.__qualname__:
            return StaticGenerativeFunction, (self.partial_args, self.source, self.by_name)
        return _unpickle, (self.source.__module__, self.source.__qualname__, self.partial_args, self.by_name)

    def simulate(self, key: PRNGKey, args: Arguments) -> StaticTrace:
        return _Run(key, lambda path, gen_fn, args, key: (gen_fn.simulate(key, args), 0.0)).run(self, args)[0]

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[StaticTrace, Weight]:
        """Run the body, and generate each site with the part of the constraint at its address."""
        handler = _Run(key, lambda path, gen_fn, args, key: gen_fn.generate(key, constraint(path), args))
        outcome = handler.run(self, args)
        _require_reachable(constraint.paths(), handler.visited)
        return outcome

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        """Run the body, and assess each site on the choices at its address."""
        handler = _Assess(choices)
        with running(handler):
            retval = self.call(args)
        _require_reachable(choices.paths(), handler.visited)
        return handler.score, retval

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        projections = (t.project(key, selection(path)) for path, t in trace.subtraces.items())
        return sum(projections, start=jnp.zeros(()))

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Run the body on the new arguments, and edit each site on the way."""
        handler = _Edit(key, trace, _requests_at_sites(request, self, list(trace.subtraces)), argdiffs)
        new, weight = handler.run(self, Diff.tree_primal(argdiffs))
        return new, weight, handler.with_known_changes(new.get_retval()), _backward_request(request, handler.backward)


def _requests_at_sites(request: EditRequest, gen_fn: StaticGenerativeFunction, sites: list[StaticAddress]) -> RequestAt:
    """Return the function that gives the part of a request for each site. Raises UnknownAddress for other addresses."""
    match request:
        case Update(constraint):
            _require_reachable(constraint.paths(), sites)

            def update_at(path: StaticAddress) -> EditRequest:
                site_constraint = constraint(path)
                return EmptyRequest() if site_constraint.static_is_empty() else Update(site_constraint)

            return update_at
        case StaticRequest(addressed):
            _require_sites(addressed, sites)
            return lambda path: addressed.get(path, EmptyRequest())
        case Regenerate(selection):
            return lambda path: Regenerate(selection(path))
    raise NotSupportedEditRequest(gen_fn, request)


def _backward_request(request: EditRequest, backward: dict[StaticAddress, EditRequest]) -> EditRequest:
    """Join the sites' backward requests. Returns an Update if `request` and all backward requests are updates."""
    if isinstance(request, Update) and all(isinstance(b, Update | EmptyRequest) for b in backward.values()):
        return Update(ChoiceMap.from_mapping((p, b.constraint) for p, b in backward.items() if isinstance(b, Update)))
    return StaticRequest(dict(backward))


def _unpickle(module: str, name: str, partial_args: Any, by_name: bool) -> StaticGenerativeFunction:
    """Return the generative function of the source at `name` in a module, which may be decorated or plain."""
    member: Any = functools.reduce(getattr, name.split("."), importlib.import_module(module))
    source = member.source if isinstance(member, StaticGenerativeFunction) else member
    return StaticGenerativeFunction(partial_args, source, by_name)


def gen(source: Callable[..., Any]) -> StaticGenerativeFunction:
    """Return a Python function as a generative function.
    In its body `g(*args) @ "address"` calls a generative function and records its choices under the address. No other
    call may have this address (AddressReuse). `@ ()` records a call's choices as the function's own choices. The i-th
    call uses `fold_in(key, i)`, with i from 1. Choices at other addresses raise MissingAddress or UnknownAddress.
    """
    gen_fn = StaticGenerativeFunction((), source)
    for name in (*functools.WRAPPER_ASSIGNMENTS, "__wrapped__"):
        object.__setattr__(gen_fn, name, source if name == "__wrapped__" else getattr(source, name, None))
    return gen_fn
