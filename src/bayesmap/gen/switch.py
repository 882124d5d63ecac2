"""A choice between generative functions, made at run time."""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from collections.abc import Callable, Sequence
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.densities import categorical
from bayesmap.gen.diff import Diff, NoChange
from bayesmap.gen.dimap import contramap
from bayesmap.gen.errors import NotSupportedEditRequest, UnknownAddress
from bayesmap.gen.generative_function import (
    Edited,
    EditRequest,
    EmptyRequest,
    GenerativeFunction,
    Regenerate,
    Trace,
    Update,
)
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

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.switch(self.index, [t.get_choices() for t in self.branches])


def _run(index: Any, thunks: Sequence[Callable[[], tuple[Any, Any]]]) -> tuple[tuple[Any, ...], Any]:
    """Run thunk number `index`; each returns (own, shared).

    Returns:
        (the own results of all, zeros for those not run; the shared result).
    """
    blank = [jax.eval_shape(lambda t=t: t()[0]) for t in thunks]

    def branch(k: int) -> Callable[[], Any]:
        def run() -> Any:
            own, shared = thunks[k]()
            zeros = [jax.tree.map(lambda s: jnp.zeros(s.shape, s.dtype), b) for b in blank]
            return (*zeros[:k], own, *zeros[k + 1 :]), shared

        return run

    return jax.lax.switch(index, [branch(k) for k in range(len(thunks))])  # type: ignore[no-any-return]


@dataclass
class Switch(GenerativeFunction):
    """See `switch`."""

    branches: tuple[GenerativeFunction, ...]

    def _read(self, args: Any) -> tuple[Any, list[Any]]:
        """(Index clamped to the branches, arguments of each)."""
        index, *rest = args
        if len(rest) != len(self.branches):
            raise TypeError(f"switch takes an index and {len(self.branches)} tuples of arguments, not {len(rest)}")
        return jnp.clip(jnp.asarray(Diff.tree_primal(index)), 0, len(self.branches) - 1), rest

    def _build(self, args: Arguments, thunks: Sequence[Callable[[], Any]]) -> tuple[SwitchTrace, Weight]:
        index, _ = self._read(args)

        def outcome(thunk: Callable[[], Any]) -> Callable[[], Any]:
            def run() -> Any:
                trace, weight = thunk()
                shared = (trace.get_retval(), trace.get_score(), jnp.asarray(weight))
                return trace.with_args(None), shared

            return run

        traces, (retval, score, weight) = _run(index, [outcome(t) for t in thunks])
        return SwitchTrace(self, args, index, traces, retval, score), weight

    def _parts(self, choices: ChoiceMap, args: Sequence[Any]) -> list[ChoiceMap]:
        """What of `choices` each branch knows.

        Raises:
            UnknownAddress: no branch knows a choice.
        """
        known = []
        for fn, a in zip(self.branches, args, strict=True):
            shape = jax.eval_shape(lambda a, fn=fn: fn.simulate(jax.random.key(0), a), a)
            known.append(shape.get_choices().get_selection())
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
        return _run(index, thunks)[1]  # type: ignore[no-any-return]

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
                return new.with_args(None), weight - trace.score

            return edit if same_index else lambda: jax.lax.cond(trace.index == k, edit, fresh)

        args = Diff.tree_primal(argdiffs)
        new, weight = self._build(args, [thunk(k) for k in range(len(self.branches))])
        unchanged = isinstance(request, EmptyRequest) and Diff.static_check_no_change(argdiffs)
        retdiff = (Diff.no_change if unchanged else Diff.unknown_change)(new.retval)
        return new, weight, retdiff, Update(trace.get_choices())

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        pairs = zip(self.branches, trace.branches, strict=True)
        thunks = [lambda fn=fn, t=t: ((), fn.project(key, t, selection)) for fn, t in pairs]
        return _run(trace.index, thunks)[1]  # type: ignore[no-any-return]


def switch(*gen_fns: GenerativeFunction) -> Switch:
    """Of several generative functions, run the one numbered by the first argument (clamped to their number).

    The further arguments are one tuple per function; all return values have the same shape. Choices
    are Masks.
    """
    return Switch(gen_fns)


def _branch_of(flag: Any, if_args: Any, else_args: Any) -> tuple[Any, ...]:
    return jnp.where(flag, 0, 1), if_args, else_args


def or_else(if_fn: GenerativeFunction, else_fn: GenerativeFunction) -> Any:
    """`if_fn` where the first argument holds, else `else_fn`; then come the two tuples of arguments."""
    return contramap(_branch_of)(switch(if_fn, else_fn))


def mix(*gen_fns: GenerativeFunction) -> Any:
    """A mixture: the first argument is the logits, then come the components' tuples of arguments.

    Choices: "mixture_component", and the component's under "component_sample".
    """
    chosen = switch(*gen_fns)

    def mixture(logits: Any, *args: Any) -> Any:
        index = categorical(logits=logits) @ "mixture_component"
        return chosen(index, *args) @ "component_sample"

    return gen(mixture)
