"""A generative function that may be switched off at run time."""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from typing import Any

import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff, NoChange
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, Regenerate, Update
from bayesmap.gen.errors import BadArguments, NotSupportedEditRequest
from bayesmap.gen.flags import optional_part
from bayesmap.gen.fluent import method
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.mask import Mask
from bayesmap.gen.pytree import dataclass
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class MaskTrace(Trace):
    """The inner trace, whose choices and score count where `flag` holds; it has arguments where this trace has."""

    gen_fn: Any
    args: Any
    inner: Trace
    flag: Any

    def get_retval(self) -> Mask:
        return Mask.build(self.inner.get_retval(), self.flag)

    def get_score(self) -> Score:
        return jnp.where(self.flag, self.inner.get_score(), 0.0)

    def get_choices(self) -> ChoiceMap:
        return self.inner.get_choices().mask(self.flag)

    def get_inner_trace(self, address: Any) -> Trace:
        return self.inner.get_inner_trace(address)

    def with_args(self, args: Arguments | None) -> "MaskTrace":
        return self.replace(args=args, inner=self.inner.with_args(None if args is None else args[1:]))


def _flag(args: Arguments) -> Any:
    """The first argument: True if it is Python's, else an array, so that choices stay, masked.

    Raises:
        BadArguments: it has a shape.
    """
    if jnp.ndim(args[0]) > 0:
        raise BadArguments(f"mask: the flag is an array of shape {jnp.shape(args[0])}; map over it with .mask().vmap()")
    return True if args[0] is True else jnp.asarray(args[0], bool)


@dataclass
class MaskCombinator(GenerativeFunction):
    """See `mask`."""

    inner: GenerativeFunction

    def _trace(self, args: Arguments, inner: Trace) -> MaskTrace:
        return MaskTrace(self, args, inner, _flag(args))

    def simulate(self, key: PRNGKey, args: Arguments) -> MaskTrace:
        _flag(args)
        return self._trace(args, self.inner.simulate(key, args[1:]))

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[MaskTrace, Weight]:
        inner, weight = self.inner.generate(key, constraint, args[1:])
        return self._trace(args, inner), jnp.where(args[0], weight, 0.0)

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Mask]:
        with optional_part():
            score, retval = self.inner.assess(choices, args[1:])
        return jnp.where(args[0], score, 0.0), Mask.build(retval, _flag(args))

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edits move the hidden choices of a trace that is off, too; they weigh when it turns on."""
        if not isinstance(request, Update | EmptyRequest | Regenerate):
            raise NotSupportedEditRequest(self, request)
        args = Diff.tree_primal(argdiffs)
        before, after = jnp.asarray(trace.flag), jnp.asarray(_flag(args))
        inner, weight, retdiff, back = request.edit(key, trace.inner, argdiffs[1:])
        new = self._trace(args, inner)
        switched = jnp.where(after, inner.get_score(), 0.0) - jnp.where(before, trace.inner.get_score(), 0.0)
        weight = jnp.where(before & after, weight, jnp.where(before == after, 0.0, switched))
        retval = new.get_retval()
        unchanged = argdiffs[0].tangent == NoChange and Diff.static_check_no_change(retdiff)
        return new, weight, (Diff.no_change if unchanged else Diff.unknown_change)(retval), back

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return jnp.where(trace.flag, self.inner.project(key, trace.inner, selection), 0.0)


@method
def mask(gen_fn: GenerativeFunction) -> MaskCombinator:
    """Give a generative function a Boolean first argument.

    Where it is True the choices count; where it is False they do not: the score is 0, and choices and
    return value are Masks whose flag is False.
    """
    return MaskCombinator(gen_fn.as_part())
