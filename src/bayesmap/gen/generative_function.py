"""The contract of traces, generative functions and edit requests.

To write your own generative function, subclass `GenerativeFunction` and `Trace` as pytree dataclasses and implement

- `simulate(key, args)`: draw the choices; the trace's score is their log density;
- `assess(choices, args)`: (log density of exactly these choices, return value);
- `generate(key, constraint, args)`: (trace that agrees with the constraint, weight); the weight is the log of
  (joint density / density with which the other choices were drawn);
- `edit(key, trace, request, argdiffs)`: (new trace, weight, retdiff, backward request). A request that draws nothing
  has the weight new score - old score. `argdiffs` are the new arguments as `Diff` leaves, which say what changed and
  where, so that `edit` can recompute less: `IndexChange((i, j))` marks an array that differs from the old one at [i, j]
  alone. Read the arguments from `argdiffs`: a trace inside a larger one is stored without its arguments;
- `project(key, trace, selection)`: the part of the score that belongs to the selected choices.

`vmap`, `@gen` and all other combinators call only these methods.
"""

from collections.abc import Callable
from typing import Any, Self, TypeVar

import jax
import jax.numpy as jnp

from bayesmap.gen.axes import in_chunks
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, Update
from bayesmap.gen.errors import AddressError
from bayesmap.gen.outline import Outlined, leaf_text
from bayesmap.gen.pytree import Pytree, dataclass
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class Trace(Outlined, Pytree):
    """A record of one run: arguments, choices, return value, score.
    A batch of traces, from `jax.vmap`, is a trace whose leaves have a leading axis. A subclass has either the fields
    `retval` and `score` or the methods `get_retval` and `get_score`.
    """

    gen_fn: Any
    args: Any

    def outline(self, label: str = "") -> list[str]:
        """Return the trace as lines: its classes, its score, its choices."""
        head = f"{type(self).__name__} of {type(self.get_gen_fn()).__name__}, score {leaf_text(self.get_score())}"
        return [label + head, *("  " + line for line in self.get_choices().outline())]

    def get_gen_fn(self) -> "GenerativeFunction":
        """Return the generative function that made the trace."""
        return self.gen_fn  # type: ignore[no-any-return]

    def get_args(self) -> Arguments:
        """Return the arguments of the run."""
        return self.args  # type: ignore[no-any-return]

    def get_retval(self) -> Any:
        """Return the return value of the run."""
        return self.retval  # type: ignore[attr-defined]

    def get_score(self) -> Score:
        """Return the log density of all choices."""
        return self.score  # type: ignore[attr-defined, no-any-return]

    def get_choices(self) -> ChoiceMap:
        """Return the choices by address."""
        raise NotImplementedError

    def get_sample(self) -> ChoiceMap:
        """Return the choices by address: GenJAX's other name of `get_choices`."""
        return self.get_choices()

    def get_subtrace(self, *addresses: Any) -> "Trace":
        """Return the trace of the call at an address; further addresses lead deeper."""
        trace = self
        for address in addresses:
            trace = trace.get_inner_trace(address)
        return trace

    def get_inner_trace(self, address: Any) -> "Trace":
        """Return the trace of the call at one address, a name or a tuple."""
        raise AddressError(address, f"a {type(self).__name__} has no subtraces")

    def with_args(self, args: Arguments | None) -> "Trace":
        """Return this trace with other arguments.
        A combinator stores the traces of its parts `with_args(None)`, so that a batch of traces holds an argument that
        all parts share only once. Override this method in a trace whose own edits need the old arguments.
        """
        return self.replace(args=args)

    def edit(self, key: PRNGKey, request: EditRequest, argdiffs: Any = None) -> Edited:
        """Return (new trace, weight, retdiff, backward request). Without `argdiffs` the arguments are unchanged."""
        if not isinstance(request, EditRequest):
            raise TypeError(f"edit takes an EditRequest, such as Update(choices), not {type(request).__name__}")
        return request.edit(key, self, Diff.no_change(self.get_args()) if argdiffs is None else argdiffs)

    def update(self, key: PRNGKey, constraint: ChoiceMap, argdiffs: Any = None) -> tuple[Self, Weight, Any, ChoiceMap]:
        """Change the choices in `constraint`. Returns (new trace, weight, retdiff, the replaced choices)."""
        trace, weight, retdiff, backward = self.edit(key, Update(constraint), argdiffs)
        if isinstance(backward, EmptyRequest):
            return trace, weight, retdiff, ChoiceMap.empty()
        if not isinstance(backward, Update):
            raise TypeError(f"This update is undone by {type(backward).__name__}, not by choices; use edit")
        return trace, weight, retdiff, backward.constraint

    def project(self, key: PRNGKey, selection: Selection) -> Weight:
        """Return the part of the score that belongs to the selected choices."""
        return self.get_gen_fn().project(key, self, selection)


@dataclass
class OuterTrace(Trace):
    """Base of traces that have the choices of one other trace, the field `inner`."""

    inner: Trace

    def get_choices(self) -> ChoiceMap:
        return self.inner.get_choices()

    def get_inner_trace(self, address: Any) -> Trace:
        return self.inner.get_inner_trace(address)


def in_dtypes_of(old: Any, new: Any) -> Any:
    """Return the trace `new` in the dtypes of `old`, so that both can be branches of `lax.cond`."""
    leaves, treedef = jax.tree.flatten(new)
    dtypes = map(jnp.result_type, jax.tree.leaves(old))
    return jax.tree.unflatten(treedef, [jnp.asarray(x, dtype) for x, dtype in zip(leaves, dtypes, strict=True)])


# `GenerativeFunction` cannot import combinators, because they import it. Each combinator registers itself here.
_COMBINATORS: dict[str, Callable[..., Any]] = {}

F = TypeVar("F", bound=Callable[..., Any])


def method(combinator: F) -> F:
    """Register a combinator, so that `combinator(m, *others)` is `m.combinator(*others)` too."""
    _COMBINATORS[combinator.__name__] = combinator
    return combinator


def decorator_method(combinator: F) -> F:
    """Register a combinator, so that `combinator(**options)(m)` is `m.combinator(**options)` too."""
    _COMBINATORS[combinator.__name__] = lambda m, *args, **options: combinator(*args, **options)(m)
    return combinator


def _lookup(name: str) -> Callable[..., Any]:
    """Return the method of the combinator that is registered as `name`."""

    def call(self: Any, *args: Any, **options: Any) -> Any:
        return _COMBINATORS[name](self, *args, **options)

    call.__name__, call.__doc__ = name, f"See `bayesmap.gen.{name}`."
    return call


class GenerativeFunction(Pytree):
    """A probabilistic program. The module's docstring has the meaning of each method of the contract."""

    vmap, repeat, scan = _lookup("vmap"), _lookup("repeat"), _lookup("scan")
    iterate, iterate_final = _lookup("iterate"), _lookup("iterate_final")
    masked_iterate, masked_iterate_final = _lookup("masked_iterate"), _lookup("masked_iterate_final")
    accumulate, reduce = _lookup("accumulate"), _lookup("reduce")
    dimap, map, contramap = _lookup("dimap"), _lookup("map"), _lookup("contramap")
    mask, or_else, switch, mix = _lookup("mask"), _lookup("or_else"), _lookup("switch"), _lookup("mix")
    marginal = _lookup("marginal")

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Return the function applied to arguments: trace it with `@ "address"`, draw from it with `(key)`."""
        return _COMBINATORS["apply"](self, args, kwargs)

    def simulate(self, key: PRNGKey, args: Arguments) -> Trace:
        """Run on the tuple `args`, and draw every choice."""
        raise NotImplementedError

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        """Return (log density of `choices`, return value). Raises MissingAddress or UnknownAddress for a mismatch."""
        raise NotImplementedError

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        """Run with the choices in `constraint`, and draw the others. Returns (trace, log importance weight)."""
        raise NotImplementedError

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit `trace` by a primitive request; `argdiffs` are its new arguments, with marks of their change."""
        raise NotImplementedError

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        """Return the part of the trace's score that belongs to the selected choices."""
        raise NotImplementedError

    def handle_kwargs(self) -> "GenerativeFunction":
        """Return this function with arguments in the form `((positional, ...), {"name": value, ...})`."""
        raise TypeError(f"a {type(self).__name__} takes no arguments by name")

    def as_part(self) -> "GenerativeFunction":
        """Return the function that stands for this one in a combinator: it edits all of its own traces."""
        return self

    def check_conditioning(self, constraint: ChoiceMap, args: Arguments) -> None:
        """Raise BadArguments if inference cannot condition on exactly these choices. Most functions accept any."""

    def choice_shapes(self, args: Arguments) -> ChoiceMap:
        """Return the choices of a run on `args`, with shapes and dtypes in place of values; nothing is run."""
        return jax.eval_shape(lambda: self.simulate(jax.random.key(0), args).get_choices())  # type: ignore[no-any-return]

    def get_zero_trace(self, *args: Any) -> Trace:
        """Return a trace with a real trace's structure, shapes and dtypes whose numbers are all 0; nothing is run."""
        shapes = jax.eval_shape(lambda: self.simulate(jax.random.key(0), args).with_args(None))
        return jax.tree.map(lambda s: jnp.zeros(s.shape, s.dtype), shapes).with_args(args)  # type: ignore[no-any-return]

    def importance(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        """Return `generate(key, constraint, args)`; a large batch of it under `jax.vmap` runs in chunks."""
        return in_chunks(self.generate, key, constraint, args)  # type: ignore[no-any-return]

    def propose(self, key: PRNGKey, args: Arguments) -> tuple[ChoiceMap, Score, Any]:
        """Draw all choices. Returns (choices, score, return value)."""
        trace = self.simulate(key, args)
        return trace.get_choices(), trace.get_score(), trace.get_retval()

    def update(self, key: PRNGKey, trace: Trace, constraint: ChoiceMap, argdiffs: Any) -> tuple[Any, Weight, Any, Any]:
        """Return `trace.update(key, constraint, argdiffs)`."""
        return trace.update(key, constraint, argdiffs)
