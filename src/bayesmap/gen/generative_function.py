"""The contract: what a trace, a generative function and an edit request can be asked; large batches in bounded memory.

To write a generative function of your own, subclass `GenerativeFunction` and `Trace` as pytree
dataclasses and implement

- `simulate(key, args)`: draw the choices; the trace's score is their log density;
- `assess(choices, args)`: (log density of exactly these choices, return value);
- `generate(key, constraint, args)`: (trace that agrees with the constraint, weight), the weight being
  the log of (joint density / density with which the unconstrained choices were drawn);
- `edit(key, trace, request, argdiffs)`: (new trace, weight, retdiff, backward request). For requests that
  draw nothing the weight is new score - old score. `argdiffs` are the new arguments as `Diff` leaves, and say
  which of them changed, and where: a `Diff` whose tangent is `IndexChange((i, j))` is the old array but
  for element [i, j]. That is the place to be incremental. `edit` may rely on `Diff.tree_primal(argdiffs)`
  alone for arguments: a trace inside a larger one is stored without its own.
- `project(key, trace, selection)`: the selected choices' part of the score.

`vmap`, `@gen` and the rest call nothing else.
"""

import math
from collections.abc import Callable
from typing import Any, Self

import jax
import jax.numpy as jnp
from jax.custom_batching import custom_vmap
from jax.extend.core import jaxprs_in_params

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, Update
from bayesmap.gen.errors import AddressError
from bayesmap.gen.fluent import Fluent
from bayesmap.gen.outline import Outlined, leaf_text
from bayesmap.gen.pytree import Pytree
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight

CACHE_BYTES, DEVICE_BYTES = 1 << 20, 1 << 28
"""How large the largest intermediate array of a chunk may be, on a CPU and on an accelerator."""


def in_chunks(fn: Callable[..., Any], *args: Any) -> Any:
    """`fn(*args)`; under `jax.vmap`, as many elements at a time as keep every array small.

    Memory is then that of the results and of one chunk. Work that all elements share is done once, too: XLA
    takes it out of the loop over chunks, whereas in one large batch it may repeat it for each element.
    """
    leaves, treedef = jax.tree.flatten(args)
    traced = [k for k, x in enumerate(leaves) if isinstance(x, jax.core.Tracer)]
    if not traced:
        return fn(*args)

    def of_traced(*values: Any) -> Any:
        # What is known stays known, so that errors can be raised while tracing.
        filled = dict(zip(traced, values, strict=True))
        return fn(*jax.tree.unflatten(treedef, [filled.get(k, x) for k, x in enumerate(leaves)]))

    chunked = custom_vmap(of_traced)

    @chunked.def_vmap
    def _(axis_size: int, in_batched: list[bool], *values: Any) -> Any:
        moving = [v for v, b in zip(values, in_batched, strict=True) if b]

        def one(moving: list[Any]) -> Any:
            rest = iter(moving)
            return of_traced(*(next(rest) if b else v for v, b in zip(values, in_batched, strict=True)))

        largest = _largest_array(jax.make_jaxpr(one)([v[0] for v in moving]).jaxpr)
        chunk = (CACHE_BYTES if jax.default_backend() == "cpu" else DEVICE_BYTES) // largest
        if chunk >= axis_size:
            out = jax.vmap(one)(moving)
        else:
            chunk = _even_share(axis_size, chunk)
            out = jax.lax.map(one, moving, batch_size=chunk if chunk > 1 else None)
        return out, jax.tree.map(lambda _: True, out)

    # Derivatives are those of the function itself: custom_vmap has no reverse mode.
    differentiable = jax.custom_jvp(chunked)
    differentiable.defjvp(lambda primals, tangents: jax.jvp(of_traced, primals, tangents))
    return differentiable(*(leaves[k] for k in traced))


def _even_share(size: int, most: int) -> int:
    """A chunk that divides the batch, if one is near the limit: a remainder would copy all results once more."""
    for chunk in range(most, max(1, most // 4), -1):
        if size % chunk == 0:
            return chunk
    return most


def _largest_array(jaxpr: Any) -> int:
    """Bytes of the largest array that a jaxpr computes."""
    sizes = [1]
    for eqn in jaxpr.eqns:
        sizes += [math.prod(v.aval.shape) * v.aval.dtype.itemsize for v in eqn.outvars if hasattr(v.aval, "shape")]
        sizes += [_largest_array(inner) for inner in jaxprs_in_params(eqn.params)]
    return max(sizes)


class Trace(Outlined, Pytree):
    """A record of one run: arguments, choices, return value, score.

    Fields hold arrays, so a batch of traces (from `jax.vmap`) is a trace whose every leaf has a leading
    axis, and the methods below then answer for the whole batch. A subclass has the fields `gen_fn` and
    `args`, and either fields `retval` and `score` or methods `get_retval` and `get_score`.
    """

    gen_fn: Any
    args: Any

    def outline(self, label: str = "") -> list[str]:
        """The trace in lines: what made it, its score, its choices."""
        head = f"{type(self).__name__} of {type(self.get_gen_fn()).__name__}, score {leaf_text(self.get_score())}"
        return [label + head, *("  " + line for line in self.get_choices().outline())]

    def get_gen_fn(self) -> "GenerativeFunction":
        """The generative function that made the trace."""
        return self.gen_fn  # type: ignore[no-any-return]

    def get_args(self) -> Arguments:
        """The arguments that it was run on."""
        return self.args  # type: ignore[no-any-return]

    def get_retval(self) -> Any:
        """Its return value."""
        return self.retval  # type: ignore[attr-defined]

    def get_score(self) -> Score:
        """The log density of all choices."""
        return self.score  # type: ignore[attr-defined, no-any-return]

    def get_choices(self) -> ChoiceMap:
        """The choices by address."""
        raise NotImplementedError

    def get_sample(self) -> ChoiceMap:
        """The same as `get_choices`."""
        return self.get_choices()

    def get_subtrace(self, *addresses: Any) -> "Trace":
        """The trace of the call made at an address."""
        trace = self
        for address in addresses:
            trace = trace.get_inner_trace(address)
        return trace

    def get_inner_trace(self, address: Any) -> "Trace":
        """The trace of the call made at one address, a name or a tuple."""
        raise AddressError(address, f"a {type(self).__name__} has no subtraces")

    def with_args(self, args: Arguments | None) -> "Trace":
        """The same trace holding other arguments.

        A combinator stores the traces of its parts `with_args(None)`: it can work their arguments out, and a
        batch of traces then holds an argument that all parts share once. Override it in a trace whose own
        edits need the old arguments.
        """
        return self.replace(args=args)

    def edit(self, key: PRNGKey, request: EditRequest, argdiffs: Any = None) -> Edited:
        """Carry out a request; `argdiffs` None means that the arguments stay the same.

        Returns:
            (new trace, weight, retdiff, backward request)
        """
        if not isinstance(request, EditRequest):
            raise TypeError(f"edit takes an EditRequest, such as Update(choices), not {type(request).__name__}")
        return request.edit(key, self, Diff.no_change(self.get_args()) if argdiffs is None else argdiffs)

    def update(self, key: PRNGKey, constraint: ChoiceMap, argdiffs: Any = None) -> tuple[Self, Weight, Any, ChoiceMap]:
        """Change the choices in `constraint`: (new trace, weight, retdiff, the choices replaced)."""
        trace, weight, retdiff, backward = self.edit(key, Update(constraint), argdiffs)
        if isinstance(backward, EmptyRequest):
            return trace, weight, retdiff, ChoiceMap.empty()
        if not isinstance(backward, Update):
            raise TypeError(f"This update is undone by {type(backward).__name__}, not by choices; use edit")
        return trace, weight, retdiff, backward.constraint

    def project(self, key: PRNGKey, selection: Selection) -> Weight:
        """The selected choices' part of the score."""
        return self.get_gen_fn().project(key, self, selection)


def in_dtypes_of(old: Any, new: Any) -> Any:
    """A trace in the dtypes of the one that it replaces, so that both can be branches of `lax.cond`."""
    leaves, treedef = jax.tree.flatten(new)
    dtypes = map(jnp.result_type, jax.tree.leaves(old))
    return jax.tree.unflatten(treedef, [jnp.asarray(x, dtype) for x, dtype in zip(leaves, dtypes, strict=True)])


class GenerativeFunction(Fluent, Pytree):
    """A probabilistic program: see the module's text for what each method means."""

    def simulate(self, key: PRNGKey, args: Arguments) -> Trace:
        """Run on the tuple `args`, drawing every choice."""
        raise NotImplementedError

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        """(Log density of `choices`, return value).

        Raises:
            MissingAddress: a choice has no value.
            UnknownAddress: a value belongs to no choice.
        """
        raise NotImplementedError

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        """Run with some choices given: (trace, log importance weight)."""
        raise NotImplementedError

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Carry out a primitive request on `trace`, whose new arguments are `argdiffs`."""
        raise NotImplementedError

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        """The selected choices' part of the trace's score."""
        raise NotImplementedError

    def handle_kwargs(self) -> "GenerativeFunction":
        """The same function with arguments in the form `((positional, ...), {"name": value, ...})`.

        Raises:
            TypeError: the function takes no arguments by name.
        """
        raise TypeError(f"a {type(self).__name__} takes no arguments by name")

    def as_part(self) -> "GenerativeFunction":
        """What a combinator over this function works on: something whose traces it edits through itself."""
        return self

    def check_conditioning(self, constraint: ChoiceMap, args: Arguments) -> None:
        """Raise BadArguments if inference cannot be given just these choices. Most functions take any."""

    def get_zero_trace(self, *args: Any) -> Trace:
        """A trace of the right structure, shapes and dtypes whose every number is zero; nothing is run."""
        shapes = jax.eval_shape(lambda: self.simulate(jax.random.key(0), args).with_args(None))
        return jax.tree.map(lambda s: jnp.zeros(s.shape, s.dtype), shapes).with_args(args)  # type: ignore[no-any-return]

    def importance(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        """The same as `generate`; a large batch of it under `jax.vmap` runs in chunks, see `in_chunks`."""
        return in_chunks(self.generate, key, constraint, args)  # type: ignore[no-any-return]

    def propose(self, key: PRNGKey, args: Arguments) -> tuple[ChoiceMap, Score, Any]:
        """Simulate, and return (choices, score, return value)."""
        trace = self.simulate(key, args)
        return trace.get_choices(), trace.get_score(), trace.get_retval()

    def update(self, key: PRNGKey, trace: Trace, constraint: ChoiceMap, argdiffs: Any) -> tuple[Any, Weight, Any, Any]:
        """The same as `trace.update(key, constraint, argdiffs)`."""
        return trace.update(key, constraint, argdiffs)
