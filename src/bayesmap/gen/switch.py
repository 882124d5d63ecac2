"""A choice between generative functions, made at run time."""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.densities import categorical
from bayesmap.gen.diff import Diff, NoChange
from bayesmap.gen.dimap import contramap
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, Regenerate, Update
from bayesmap.gen.errors import AddressError, BadArguments, NotSupportedEditRequest, UnknownAddress
from bayesmap.gen.flags import is_concrete, optional_part, where
from bayesmap.gen.fluent import method
from bayesmap.gen.generative_function import GenerativeFunction, Trace, in_dtypes_of
from bayesmap.gen.pytree import dataclass
from bayesmap.gen.selection import Selection
from bayesmap.gen.static import gen
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class SwitchTrace(Trace):
    """A trace per branch; only that of number `index` is filled in."""

    gen_fn: Any
    args: Any
    index: Any
    branches: tuple[Trace, ...]
    retval: Any
    score: Score

    def get_idx(self) -> Any:
        """The number of the branch that ran."""
        return self.index

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.switch(self.index, [t.get_choices() for t in self.branches])

    def get_inner_trace(self, address: Any) -> Trace:
        """The branch's that ran; where that is not known, the one of those that have the address."""
        all_args = [None] * len(self.branches) if self.args is None else self.args[1:]
        branches = [t.with_args(a) for t, a in zip(self.branches, all_args, strict=True)]
        if is_concrete(self.index) and jnp.ndim(self.index) == 0:
            return branches[int(self.index)].get_inner_trace(address)
        found = {}
        for k, trace in enumerate(branches):
            with suppress(AddressError):
                found[k] = trace.get_inner_trace(address)
        if not found:
            raise UnknownAddress(address, "no branch has it")
        if len({jax.tree.structure(t) for t in found.values()}) > 1:
            raise AddressError(address, "the branches' traces differ there, and which one ran is not known")
        chosen = next(iter(found.values()))
        for k, trace in found.items():
            chosen = where(self.index == k, trace, chosen)
        return chosen


def run_branch(index: Any, thunks: Sequence[Callable[[], tuple[Any, Any]]]) -> tuple[tuple[Any, ...], Any]:
    """Run thunk number `index`; each returns (own, shared).

    Returns:
        (the own results of all, zeros for those not run; the shared result, in the thunks' common dtypes and shapes).

    Raises:
        ValueError: the shapes of the shared results do not go together.
    """
    blank, shapes = zip(*(jax.eval_shape(t) for t in thunks), strict=True)
    common = jax.tree.map(lambda *s: (jnp.broadcast_shapes(*(x.shape for x in s)), jnp.result_type(*s)), *shapes)

    def branch(k: int) -> Callable[[], Any]:
        def run() -> Any:
            own, shared = thunks[k]()
            zeros = [jax.tree.map(lambda s: jnp.zeros(s.shape, s.dtype), b) for b in blank]
            shared = jax.tree.map(lambda x, c: jnp.broadcast_to(jnp.asarray(x, c[1]), c[0]), shared, common)
            return (*zeros[:k], own, *zeros[k + 1 :]), shared

        return run

    return jax.lax.switch(index, [branch(k) for k in range(len(thunks))])  # type: ignore[no-any-return]


@dataclass
class Switch(GenerativeFunction):
    """See `switch`."""

    branches: tuple[GenerativeFunction, ...]

    def _read(self, args: Any) -> tuple[Any, list[Any]]:
        """(Index, arguments of each branch).

        Raises:
            BadArguments: the index is known and numbers no branch, or there are too many or too few arguments.
        """
        index, *rest = args
        index, n = Diff.tree_primal(index), len(self.branches)
        if len(rest) != n:
            raise BadArguments(f"switch takes an index and {n} tuples of arguments, not {len(rest)}")
        if is_concrete(index) and not 0 <= int(index) < n:
            raise BadArguments(f"switch: there is no branch {int(index)}; the branches are 0 to {n - 1}")
        return (index if isinstance(index, int) else jnp.clip(index, 0, n - 1)), rest

    def _build(self, args: Arguments, thunks: Sequence[Callable[[], Any]]) -> tuple[SwitchTrace, Weight]:
        index, _ = self._read(args)

        def outcome(thunk: Callable[[], Any]) -> Callable[[], Any]:
            def run() -> Any:
                trace, weight = thunk()
                shared = (trace.get_retval(), trace.get_score(), jnp.asarray(weight))
                return trace.with_args(None), shared

            return run

        traces, (retval, score, weight) = run_branch(index, [outcome(t) for t in thunks])
        return SwitchTrace(self, args, index, traces, retval, score), weight

    def _parts(self, choices: ChoiceMap, args: Sequence[Any]) -> list[ChoiceMap]:
        """What of `choices` each branch knows.

        Raises:
            UnknownAddress: no branch knows a choice.
        """
        known = []
        for fn, a in zip(self.branches, args, strict=True):
            shape = jax.eval_shape(lambda fn=fn, a=a: fn.simulate(jax.random.key(0), a).get_choices())
            known.append(shape.get_selection())
        everything = known[0]
        for sel in known[1:]:
            everything = everything | sel
        for path in choices.filter(~everything).paths():
            raise UnknownAddress(path, "no branch has it")
        return [choices.filter(sel) for sel in known]

    def simulate(self, key: PRNGKey, args: Arguments) -> SwitchTrace:
        _, rest = self._read(args)
        thunks = [lambda fn=fn, a=a: (fn.simulate(key, a), 0.0) for fn, a in zip(self.branches, rest, strict=True)]
        return self._build(args, thunks)[0]

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[SwitchTrace, Weight]:
        _, rest = self._read(args)
        parts = zip(self.branches, self._parts(constraint, rest), rest, strict=True)
        thunks = [lambda fn=fn, c=c, a=a: fn.generate(key, c, a) for fn, c, a in parts]
        return self._build(args, thunks)

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        index, rest = self._read(args)
        parts = zip(self.branches, self._parts(choices, rest), rest, strict=True)
        thunks = [lambda fn=fn, c=c, a=a: ((), fn.assess(c, a)) for fn, c, a in parts]
        with optional_part():
            return run_branch(index, thunks)[1]  # type: ignore[no-any-return]

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """A branch that was not active before is drawn afresh: its draws add no weight.

        The backward request gives the old branch its old choices; going back takes the old index too.
        """
        if not isinstance(request, Update | EmptyRequest | Regenerate):
            raise NotSupportedEditRequest(self, request)
        _, diffs = self._read(argdiffs)
        constraint = request.constraint if isinstance(request, Update) else ChoiceMap.empty()
        parts = self._parts(constraint, [Diff.tree_primal(d) for d in diffs])
        same_index = argdiffs[0].tangent == NoChange

        def thunk(k: int) -> Callable[[], Any]:
            fn, old, diff = self.branches[k], trace.branches[k], diffs[k]
            mine = Update(parts[k]) if isinstance(request, Update) else request

            def edit() -> Any:
                new, weight, _, _ = mine.edit(key, old, diff)
                return new.with_args(None), weight

            def fresh() -> Any:
                new, weight = fn.generate(key, parts[k], Diff.tree_primal(diff))
                return in_dtypes_of(old, new.with_args(None)), weight - trace.score

            return edit if same_index else lambda: jax.lax.cond(trace.index == k, edit, fresh)

        args = Diff.tree_primal(argdiffs)
        new, weight = self._build(args, [thunk(k) for k in range(len(self.branches))])
        unchanged = isinstance(request, EmptyRequest) and Diff.static_check_no_change(argdiffs)
        retdiff = (Diff.no_change if unchanged else Diff.unknown_change)(new.retval)
        return new, weight, retdiff, Update(trace.get_choices())

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        pairs = zip(self.branches, trace.branches, strict=True)
        thunks = [lambda fn=fn, t=t: ((), fn.project(key, t, selection)) for fn, t in pairs]
        return run_branch(trace.index, thunks)[1]  # type: ignore[no-any-return]


@method
def switch(*gen_fns: GenerativeFunction) -> Switch:
    """Of several generative functions, run the one numbered by the first argument.

    The further arguments are one tuple per function; the return values have shapes and dtypes that go together. Unless
    the number is a Python int, choices are Masks. A number that is out of range raises where it is known, and counts as
    the nearest branch's where it is traced.
    """
    return Switch(tuple(fn.as_part() for fn in gen_fns))


def _branch_of(flag: Any, if_args: Any, else_args: Any) -> tuple[Any, ...]:
    return jnp.where(flag, 0, 1), if_args, else_args


@method
def or_else(if_fn: GenerativeFunction, else_fn: GenerativeFunction) -> Any:
    """`if_fn` where the first argument holds, else `else_fn`; then come the two tuples of arguments."""
    return contramap(_branch_of)(switch(if_fn, else_fn))


@method
def mix(*gen_fns: GenerativeFunction) -> Any:
    """A mixture: the first argument is the logits, then come the components' tuples of arguments.

    Choices: "mixture_component", and the component's under "component_sample".
    """
    chosen = switch(*gen_fns)

    def mixture(logits: Any, *args: Any) -> Any:
        index = categorical(logits=logits) @ "mixture_component"
        return chosen(index, *args) @ "component_sample"

    return gen(mixture)
