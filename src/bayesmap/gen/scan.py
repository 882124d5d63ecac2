"""Generative functions iterated: the state of each step is an argument of the next step.

The contract's methods of `Scan` run `Scan._loop`. The functions at the end transform its arguments and return values.
"""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.axes import total, vectorise
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.closure import dimap, map
from bayesmap.gen.diff import Diff
from bayesmap.gen.edits import Edited, EditRequest, EmptyRequest, IndexRequest
from bayesmap.gen.generative_function import GenerativeFunction, OuterTrace, Trace, decorator_method
from bayesmap.gen.pytree import dataclass, nth, static
from bayesmap.gen.switch import mask
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight
from bayesmap.gen.vmap import Vectorised, undo_all


@dataclass
class ScanTrace(OuterTrace):
    """The trace of a scan: `inner` has the steps' traces, stacked and without their arguments."""

    carries: Any  # the state before each step, stacked
    retval: Any  # (last state, stacked outputs)
    score: Score  # sum of the steps' scores


@dataclass
class Scan(Vectorised):
    """A generative function iterated over a state and inputs. See `scan`."""

    inner: GenerativeFunction  # (state, x) -> (state, y)
    n: int | None = static(default=None)  # number of steps; if None, the length of the inputs

    def length(self, args: Arguments) -> int:
        """Return the number of steps: `n`, or the length of the leading axis of the inputs."""
        if len(args) != 2:
            raise TypeError(f"scan takes two arguments, (state, inputs), not {len(args)}")
        sizes = dict.fromkeys(jnp.shape(leaf)[0] for leaf in jax.tree.leaves(args[1]))
        if len(sizes) > 1:
            raise ValueError(f"scan got values with different leading axis sizes: {', '.join(f'{n}' for n in sizes)}.")
        if self.n is None and not sizes:
            raise TypeError("scan needs n= where there are no inputs")
        return self.n if self.n is not None else next(iter(sizes))

    def _loop(self, key: PRNGKey, args: Arguments, step: Callable[..., Any], mapped: Any) -> Any:
        """Iterate `step(key, (state, x_t), mapped_t) -> (trace, weight, extra)`. Returns them for the whole scan."""
        n = self.length(args)

        def body(carry: Any, scanned: Any) -> Any:
            key, state = carry
            t, x, mapped = scanned
            key = jax.random.fold_in(key, t)
            trace, weight, extra = step(key, (state, x), mapped)
            next_state, out = trace.get_retval()
            return (key, next_state), (trace.with_args(None), state, out, weight, extra)

        start = (key, jax.tree.map(jnp.asarray, args[0]))
        (_, state), stacked = jax.lax.scan(body, start, (jnp.arange(n), args[1], mapped), length=n)
        inner, carries, out, weights, extra = stacked
        trace = ScanTrace(self, args, inner, carries, (state, out), total(inner.get_score()))
        return trace, total(weights), extra

    def simulate(self, key: PRNGKey, args: Arguments) -> ScanTrace:
        trace, _, _ = self._loop(key, args, lambda k, a, _: (self.inner.simulate(k, a), 0.0, None), None)
        return trace  # type: ignore[no-any-return]

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[ScanTrace, Weight]:
        """Generate every step with its part of the constraint. The weight is the sum of the steps' weights."""
        constraints = vectorise(constraint, self.length(args))
        trace, weight, _ = self._loop(key, args, lambda k, a, c: (*self.inner.generate(k, c, a), None), constraints)
        return trace, weight

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        """Return (sum of the steps' log densities, (last state, stacked outputs))."""

        def step(state: Any, scanned: Any) -> Any:
            x, choices = scanned
            score, (state, out) = self.inner.assess(choices, (state, x))
            return state, (score, out)

        n = self.length(args)
        step_choices = vectorise(choices, n)
        if n == 0:  # arrays without elements are in no choice map, and simulating draws nothing
            empty = self.simulate(jax.random.key(0), args)
            return empty.get_score(), empty.get_retval()
        start = jax.tree.map(jnp.asarray, args[0])
        state, (scores, out) = jax.lax.scan(step, start, (args[1], step_choices), length=n)
        return total(scores), (state, out)

    def edit_all(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit every step. The state before a step counts as changed."""
        args = Diff.tree_primal(argdiffs)
        mark_input = Diff.no_change if Diff.static_check_no_change(argdiffs[1]) else Diff.unknown_change

        def step(key: PRNGKey, args: Any, mapped: Any) -> Any:
            inner, request = mapped
            new, weight, _, backward = request.edit(key, inner, (Diff.unknown_change(args[0]), mark_input(args[1])))
            return new, weight, backward

        new, weight, backward = self._loop(key, args, step, (trace.inner, request))
        return new, weight, Diff.unknown_change(new.retval), undo_all(backward)

    def edit_one(self, key: PRNGKey, trace: Any, i: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Edit step i, and the steps after it if the state after step i may differ."""
        # Move the trace to the new arguments first, then edit step i alone.
        args = Diff.tree_primal(argdiffs)
        trace, args_weight, _, _ = EmptyRequest().edit(key, trace, argdiffs)
        old, *step_args = nth((trace.inner, trace.carries, args[1]), i)
        new, weight, retdiff, backward = request.edit(key, old, Diff.no_change(tuple(step_args)))
        state_diff, _ = retdiff
        _, out = new.get_retval()
        new = new.with_args(None)

        def store(stack: Any, value: Any) -> Any:
            return jax.tree.map(lambda x, v: x.at[i].set(v), stack, value)

        # If the state after step i cannot have changed, only this step's entries change.
        if Diff.static_check_no_change(state_diff):
            retval = (trace.retval[0], store(trace.retval[1], out))
            inner = store(trace.inner, new)
            result = ScanTrace(self, args, inner, trace.carries, retval, total(inner.get_score()))
            diff = (Diff.no_change(retval[0]), Diff.unknown_change(retval[1]))
            return result, args_weight + weight, diff, IndexRequest(i, backward)

        # Otherwise run all steps: those before i stay, step i is the edited one, and later ones get their new state.
        def step(key: PRNGKey, step_args: Any, mapped: Any) -> Any:
            inner, t = mapped

            def rescore() -> tuple[Trace, Weight]:
                diffs = (Diff.unknown_change(step_args[0]), Diff.no_change(step_args[1]))
                rescored, rescored_weight, _, _ = EmptyRequest().edit(key, inner, diffs)
                return rescored.with_args(None), rescored_weight

            branches = [lambda: (inner, jnp.zeros(())), lambda: (new, weight), rescore]
            return (*jax.lax.switch(jnp.sign(t - i) + 1, branches), None)

        result, change, _ = self._loop(key, args, step, (trace.inner, jnp.arange(self.length(args))))
        return result, args_weight + change, Diff.unknown_change(result.retval), IndexRequest(i, backward)


@decorator_method
def scan(*, n: int | None = None) -> Callable[[GenerativeFunction], Scan]:
    """Return a decorator that turns `(state, x) -> (state, y)` into `(state, xs) -> (last state, ys)`.
    Step t uses the key `fold_in(key of step t - 1, t)`. Addresses of its choices begin with t. Without `xs` give `n`.
    """
    return lambda gen_fn: Scan(gen_fn.as_part(), n)


# The functions that `map` and `dimap` use are no closures: equal functions make equal traces, which can be compared.
def _as_output(state: Any) -> tuple[Any, Any]:
    return state, state


def _last_state(args: Any, inner_args: Any, retval: Any) -> Any:
    return retval[0]


def _all_states(args: Any, inner_args: Any, retval: Any) -> Any:
    """Return the first state and the stacked outputs, which are the later states, with a leading axis of n + 1."""
    first, later = inner_args[0], retval[1]
    return jax.tree.map(lambda x, xs: jnp.concatenate([jnp.asarray(x)[None], xs]), first, later)


def _without_inputs(state: Any) -> tuple[Any, None]:
    return state, None


def _drop_input(state: Any, x: Any) -> tuple[Any]:
    return (state,)


def _steps(gen_fn: GenerativeFunction, n: int | None = None) -> Scan:
    """Return the scan of a function `(state, x) -> state`, or with `n` of a function `state -> state`."""
    step = map(_as_output)(gen_fn)
    return scan(n=n)(step if n is None else dimap(pre=_drop_input)(step))


@decorator_method
def accumulate() -> Callable[[GenerativeFunction], Any]:
    """Return a decorator that turns `(state, x) -> state` into `(state, xs) -> states`, with all n + 1 states."""
    return lambda gen_fn: dimap(post=_all_states)(_steps(gen_fn))


@decorator_method
def reduce() -> Callable[[GenerativeFunction], Any]:
    """Return a decorator that turns `(state, x) -> state` into `(state, xs) -> last state`."""
    return lambda gen_fn: dimap(post=_last_state)(_steps(gen_fn))


@decorator_method
def iterate(*, n: int) -> Callable[[GenerativeFunction], Any]:
    """Return a decorator that turns `state -> state` into `state -> states`, with all n + 1 states."""
    return lambda gen_fn: dimap(pre=_without_inputs, post=_all_states)(_steps(gen_fn, n))


@decorator_method
def masked_iterate() -> Callable[[GenerativeFunction], Any]:
    """Return a decorator that turns `state -> state` into `(state, flags) -> states`, with all n + 1 states.
    If a step's flag is False, its choices do not count, but the step still changes the state.
    """
    return lambda gen_fn: dimap(post=_all_states)(_steps(_flagged(gen_fn)))


@decorator_method
def masked_iterate_final() -> Callable[[GenerativeFunction], Any]:
    """Return a decorator that turns `state -> state` into `(state, flags) -> last state`. See `masked_iterate`."""
    return lambda gen_fn: dimap(post=_last_state)(_steps(_flagged(gen_fn)))


def _flagged(gen_fn: GenerativeFunction) -> Any:
    """Return `state -> state` as a function `(state, flag) -> state`."""
    return dimap(pre=_flag_first, post=_unmasked)(mask(gen_fn))


def _flag_first(state: Any, flag: Any) -> tuple[Any, Any]:
    return flag, state


def _unmasked(args: Any, inner_args: Any, retval: Any) -> Any:
    return retval.value


@decorator_method
def iterate_final(*, n: int) -> Callable[[GenerativeFunction], Any]:
    """Return a decorator that turns `state -> state` into `state -> last state`, after n steps."""
    return lambda gen_fn: dimap(pre=_without_inputs, post=_last_state)(_steps(gen_fn, n))
