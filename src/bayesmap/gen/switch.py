"""Generative functions chosen at run time: `mask` gives a function a flag, and `switch` runs one of several branches.

If the flag is False, the function's choices do not count. `or_else` and `mix` are cases of `switch`. JAX compiles all
branches, so that the trace of a switch stores a trace of each branch.
"""

import operator
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial, reduce
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.closure import Outer, contramap
from bayesmap.gen.densities import categorical
from bayesmap.gen.diff import Diff, NoChange
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, Regenerate, Update
from bayesmap.gen.errors import AddressError, BadArguments, NotSupportedEditRequest, UnknownAddress
from bayesmap.gen.generative_function import GenerativeFunction, OuterTrace, Trace, in_dtypes_of, method
from bayesmap.gen.masks import Mask, is_concrete, optional_part, where_leaves
from bayesmap.gen.pytree import dataclass
from bayesmap.gen.selection import Selection
from bayesmap.gen.static import gen
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class MaskTrace(OuterTrace):
    """The trace of a masked function. The choices and the score of `inner` count if `flag` is True."""

    flag: Any

    def get_retval(self) -> Mask:
        return Mask.build(self.inner.get_retval(), self.flag)

    def get_score(self) -> Score:
        return jnp.where(self.flag, self.inner.get_score(), 0.0)

    def get_choices(self) -> ChoiceMap:
        return self.inner.get_choices().mask(self.flag)

    def with_args(self, args: Arguments | None) -> "MaskTrace":
        """Return this trace with other arguments. The first is the flag, the others are those of `inner`."""
        return self.replace(args=args, inner=self.inner.with_args(None if args is None else args[1:]))


def _flag(args: Arguments) -> Any:
    """Return the flag, which is the first argument: Python's True as it is, all else as a Boolean array, shape ()."""
    if jnp.ndim(args[0]) > 0:
        raise BadArguments(f"mask: the flag is an array of shape {jnp.shape(args[0])}; map over it with .mask().vmap()")
    return True if args[0] is True else jnp.asarray(args[0], bool)


@dataclass
class MaskCombinator(Outer):
    """A generative function whose first argument is a flag. If it is False, the choices do not count. See `mask`."""

    inner: GenerativeFunction

    def inner_args(self, args: Arguments) -> Arguments:
        """Return the arguments without the flag. Raises BadArguments for a flag that is no scalar."""
        _flag(args)
        return args[1:]

    def wrap(self, args: Arguments, inner: Trace) -> MaskTrace:
        return MaskTrace(self, args, inner, _flag(args))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[OuterTrace, Weight]:
        """Generate the inner trace. The weight is 0 if the flag is False."""
        trace, weight = super().generate(key, constraint, args)
        return trace, jnp.where(args[0], weight, 0.0)

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Mask]:
        """Return (the choices' log density, or 0 if the flag is False; return value as a Mask)."""
        with optional_part():
            score, retval = super().assess(choices, args)
        return jnp.where(args[0], score, 0.0), Mask.build(retval, _flag(args))

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit the inner trace even if the flag is False. Its choices count as soon as the flag is True."""
        if not isinstance(request, Update | EmptyRequest | Regenerate):
            raise NotSupportedEditRequest(self, request)
        args = Diff.tree_primal(argdiffs)
        old_flag, new_flag = jnp.asarray(trace.flag), jnp.asarray(_flag(args))
        inner, weight, retdiff, backward = request.edit(key, trace.inner, argdiffs[1:])
        new = self.wrap(args, inner)
        # The edit's weight counts if the flag was and is True. A flag that changes adds or removes the whole score.
        score_change = new.get_score() - trace.get_score()
        weight = jnp.where(old_flag & new_flag, weight, jnp.where(old_flag == new_flag, 0.0, score_change))
        retval = new.get_retval()
        unchanged = argdiffs[0].tangent == NoChange and Diff.static_check_no_change(retdiff)
        return new, weight, (Diff.no_change if unchanged else Diff.unknown_change)(retval), backward

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return jnp.where(trace.flag, super().project(key, trace, selection), 0.0)


@method
def mask(gen_fn: GenerativeFunction) -> MaskCombinator:
    """Return a generative function with an additional first argument, a flag.
    If the flag is False, the score is 0, and the choices and the return value are Masks whose flag is False.
    """
    return MaskCombinator(gen_fn.as_part())


@dataclass
class SwitchTrace(Trace):
    """One trace per branch. Only the trace of branch number `index`, which ran, has values; the others are zeros."""

    index: Any  # number of the branch that ran
    branches: tuple[Trace, ...]  # a trace per branch, without arguments
    retval: Any  # value of the branch that ran, in common shapes and dtypes
    score: Score  # score of the branch that ran

    def get_idx(self) -> Any:
        """Return the number of the branch that ran."""
        return self.index

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.switch(self.index, [t.get_choices() for t in self.branches])

    def get_inner_trace(self, address: Any) -> Trace:
        """Return the subtrace of the branch that ran. A traced index selects among the branches with the address."""
        all_args = [None] * len(self.branches) if self.args is None else self.args[1:]
        branches = [t.with_args(a) for t, a in zip(self.branches, all_args, strict=True)]
        if is_concrete(self.index) and jnp.ndim(self.index) == 0:
            return branches[int(self.index)].get_inner_trace(address)
        # The index is known only at run time: select among subtraces of one structure.
        subtraces = {}
        for k, trace in enumerate(branches):
            with suppress(AddressError):
                subtraces[k] = trace.get_inner_trace(address)
        if not subtraces:
            raise UnknownAddress(address, "no branch has it")
        if len({jax.tree.structure(t) for t in subtraces.values()}) > 1:
            raise AddressError(address, "the branches' traces differ there, and which one ran is not known")
        selected = next(iter(subtraces.values()))
        for k, trace in subtraces.items():
            selected = where_leaves(self.index == k, trace, selected)
        return selected


def run_branch(index: Any, thunks: Sequence[Callable[[], tuple[Any, Any]]]) -> tuple[tuple[Any, ...], Any]:
    """Run thunk number `index`, a function without arguments that returns (own result, shared result).
    Returns (own results of all thunks, zeros for those that did not run; shared result in common dtypes and shapes).
    """
    own_shapes, shared_shapes = zip(*(jax.eval_shape(t) for t in thunks), strict=True)
    dtypes = jax.tree.map(jnp.result_type, *shared_shapes)
    shapes = jax.tree.map(lambda *s: jnp.broadcast_shapes(*(x.shape for x in s)), *shared_shapes)

    def in_common_form(x: Any, dtype: Any, shape: tuple[int, ...]) -> Any:
        return jnp.broadcast_to(jnp.asarray(x, dtype), shape)

    def run(k: int) -> Any:
        results = [jax.tree.map(lambda s: jnp.zeros(s.shape, s.dtype), trees) for trees in own_shapes]
        results[k], shared = thunks[k]()
        return tuple(results), jax.tree.map(in_common_form, shared, dtypes, shapes)

    return jax.lax.switch(index, [partial(run, k) for k in range(len(thunks))])  # type: ignore[no-any-return]


@dataclass
class Switch(GenerativeFunction):
    """A generative function that runs one of several branches. See `switch`."""

    branches: tuple[GenerativeFunction, ...]

    def _split(self, args: Any) -> tuple[Any, list[Any]]:
        """Return (index, arguments of each branch). Raises BadArguments for a known index out of range."""
        index, *branch_args = args
        index = Diff.tree_primal(index)
        n = len(self.branches)
        if len(branch_args) != n:
            raise BadArguments(f"switch takes an index and {n} tuples of arguments, not {len(branch_args)}")
        if is_concrete(index) and not 0 <= int(index) < n:
            raise BadArguments(f"switch: there is no branch {int(index)}; the branches are 0 to {n - 1}")
        return (index if isinstance(index, int) else jnp.clip(index, 0, n - 1)), branch_args

    def _run(self, index: Any, run: Callable[[int], tuple[Any, Any]]) -> tuple[tuple[Any, ...], Any]:
        """Return `run_branch`, where thunk number k is `run(k)`."""
        return run_branch(index, [partial(run, k) for k in range(len(self.branches))])

    def _trace(self, args: Arguments, trace_branch: Callable[[int], tuple[Trace, Any]]) -> tuple[SwitchTrace, Weight]:
        """Return the trace and the weight of the branch that runs. `trace_branch(k)` returns those of branch k."""
        index, _ = self._split(args)

        def run(k: int) -> Any:
            trace, weight = trace_branch(k)
            return trace.with_args(None), (trace.get_retval(), trace.get_score(), jnp.asarray(weight))

        traces, (retval, score, weight) = self._run(index, run)
        return SwitchTrace(self, args, index, traces, retval, score), weight

    def _choices_of_branches(self, choices: ChoiceMap, args: Sequence[Any]) -> list[ChoiceMap]:
        """Return for each branch the choices that it can make. Raises UnknownAddress for a choice of no branch."""
        selections = [fn.choice_shapes(a).get_selection() for fn, a in zip(self.branches, args, strict=True)]
        unknown = next(choices.filter(~reduce(operator.or_, selections)).paths(), None)
        if unknown is not None:
            raise UnknownAddress(unknown, "no branch has it")
        return [choices.filter(selection) for selection in selections]

    def simulate(self, key: PRNGKey, args: Arguments) -> SwitchTrace:
        _, branch_args = self._split(args)
        return self._trace(args, lambda k: (self.branches[k].simulate(key, branch_args[k]), 0.0))[0]

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[SwitchTrace, Weight]:
        """Generate a trace of the branch with the given index, from the part of the constraint that it can make."""
        _, branch_args = self._split(args)
        constraints = self._choices_of_branches(constraint, branch_args)
        return self._trace(args, lambda k: self.branches[k].generate(key, constraints[k], branch_args[k]))

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        index, branch_args = self._split(args)
        branch_choices = self._choices_of_branches(choices, branch_args)
        with optional_part():
            _, assessed = self._run(index, lambda k: ((), self.branches[k].assess(branch_choices[k], branch_args[k])))
        return assessed  # type: ignore[no-any-return]

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit the branch that stays active, or generate a newly active branch, whose draws add no weight.
        The backward request restores the old branch's choices. The caller must restore the old index.
        """
        if not isinstance(request, Update | EmptyRequest | Regenerate):
            raise NotSupportedEditRequest(self, request)
        # Each branch gets the part of an update that it can make.
        _, branch_diffs = self._split(argdiffs)
        constraint = request.constraint if isinstance(request, Update) else ChoiceMap.empty()
        constraints = self._choices_of_branches(constraint, [Diff.tree_primal(d) for d in branch_diffs])
        same_index = argdiffs[0].tangent == NoChange

        def edit_active(k: int) -> Any:
            branch_request = Update(constraints[k]) if isinstance(request, Update) else request
            new, weight, _, _ = branch_request.edit(key, trace.branches[k], branch_diffs[k])
            return new.with_args(None), weight

        def generate_new(k: int) -> Any:
            new, weight = self.branches[k].generate(key, constraints[k], Diff.tree_primal(branch_diffs[k]))
            # The old branch's score leaves the trace; the new one's own draws cancel in `weight`. `lax.cond` needs
            # results of one dtype, and the stored trace decides it.
            return in_dtypes_of(trace.branches[k], new.with_args(None)), weight - trace.score

        def edit_branch(k: int) -> Any:
            # An index that is marked as unchanged needs no `cond`, which would compile both cases.
            if same_index:
                return edit_active(k)
            return jax.lax.cond(trace.index == k, partial(edit_active, k), partial(generate_new, k))

        new, weight = self._trace(Diff.tree_primal(argdiffs), edit_branch)
        unchanged = isinstance(request, EmptyRequest) and Diff.static_check_no_change(argdiffs)
        retdiff = (Diff.no_change if unchanged else Diff.unknown_change)(new.retval)
        return new, weight, retdiff, Update(trace.get_choices())

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        _, score = self._run(trace.index, lambda k: ((), self.branches[k].project(key, trace.branches[k], selection)))
        return score  # type: ignore[no-any-return]


@method
def switch(*gen_fns: GenerativeFunction) -> Switch:
    """Return a generative function that runs one of `gen_fns`. Its first argument is the number of the function.
    The other arguments are one tuple per function. Return values are converted to common shapes and dtypes. Unless the
    number is a Python int, the choices are Masks. A known number out of range raises an error; a traced one is clipped.
    """
    return Switch(tuple(fn.as_part() for fn in gen_fns))


def _branch_of(flag: Any, if_args: Any, else_args: Any) -> tuple[Any, ...]:
    """Return the arguments of a switch, which runs branch 0 if the flag is True, else branch 1."""
    return jnp.where(flag, 0, 1), if_args, else_args


@method
def or_else(if_fn: GenerativeFunction, else_fn: GenerativeFunction) -> Any:
    """Return a function that runs `if_fn` or `else_fn`. Its arguments are a flag, and a tuple of arguments for each."""
    return contramap(_branch_of)(switch(if_fn, else_fn))


@method
def mix(*gen_fns: GenerativeFunction) -> Any:
    """Return a mixture. Its arguments are the logits, then one tuple of arguments per component.
    Its choices are "mixture_component", and the component's choices under "component_sample".
    """
    component = switch(*gen_fns)

    def mixture(logits: Any, *args: Any) -> Any:
        return component(categorical(logits=logits) @ "mixture_component", *args) @ "component_sample"

    return gen(mixture)
