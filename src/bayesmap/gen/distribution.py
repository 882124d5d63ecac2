"""Distributions with a known density, as generative functions with one choice at the empty address."""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.dense import dense
from bayesmap.gen.diff import Diff
from bayesmap.gen.errors import MissingAddress, NotSupportedEditRequest, OutsideSupport, ShapeMismatch
from bayesmap.gen.generative_function import (
    Edited,
    EditRequest,
    GenerativeFunction,
    Regenerate,
    Trace,
    Update,
)
from bayesmap.gen.mask import Mask, is_concrete, where
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class DistributionTrace(Trace):
    """One draw and its log density."""

    gen_fn: Any
    args: Any
    value: Any
    score: Score

    def get_retval(self) -> Any:
        return self.value

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.choice(self.value)


class ExactDensity(GenerativeFunction):
    """Base of distributions: implement `sample` and `logpdf`.

    With array parameters the draws are independent and the score is their sum, of shape ().
    """

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        """A draw: an array."""
        raise NotImplementedError

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        """The log density at `value`; its shape is that of the independent draws."""
        raise NotImplementedError

    def score(self, value: Any, args: Arguments, given: Any = None) -> Score:
        """The total log density, shape (); with a flag `given`, 0 where it does not hold."""
        total = jnp.sum(jnp.asarray(self.logpdf(value, *args))).astype(jnp.result_type(float))
        return total if given is None else jnp.where(given, total, 0.0)

    def draw(self, key: PRNGKey, args: Arguments) -> Any:
        """A draw for a trace."""
        return self.sample(key, *args)

    def index_shape(self, args: Arguments) -> tuple[int, ...]:
        """The leading axes that an index in a constraint selects from: none, unless vectorised."""
        return ()

    def in_support(self, value: Any) -> Any:
        """Elementwise: could some parameter give this value? Asked of discrete distributions."""
        return True

    def simulate(self, key: PRNGKey, args: Arguments) -> DistributionTrace:
        if not isinstance(args, tuple):
            raise TypeError(f"args must be a tuple of arguments, not {type(args).__name__}")
        value = self.draw(key, args)
        return DistributionTrace(self, args, value, self.score(value, args))

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        value, given, penalty = self._read(choices, args)
        if value is None:
            raise MissingAddress(())
        if given is None:
            return self.score(value, args) + penalty, value
        if is_concrete(given) and not bool(jnp.all(given)):
            raise MissingAddress((), "its mask's flag is False" if jnp.ndim(given) == 0 else f"given: {given}")
        return jnp.where(jnp.all(given), self.score(value, args) + penalty, jnp.nan), value

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        value, given, penalty = self._read(constraint, args)
        if value is None:
            return self.simulate(key, args), jnp.zeros(())
        if given is None:
            score = self.score(value, args) + penalty
            return DistributionTrace(self, args, value, score), score
        value = where(given, value, self.draw(key, args))
        new = DistributionTrace(self, args, value, self.score(value, args) + penalty)
        return new, self.score(value, args, given) + penalty

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        args, old = Diff.tree_primal(argdiffs), trace.value
        match request:
            case Update(constraint):
                value, given, penalty = self._read(constraint, args)
                if value is None:
                    return self._rescore(trace, argdiffs)
                value = value if given is None else where(given, value, old)
                new = DistributionTrace(self, args, value, self.score(value, args) + penalty)
                discard = ChoiceMap.choice(old if given is None else Mask(old, given))
                return new, new.score - trace.score, Diff.unknown_change(value), Update(discard)
            case Regenerate(selection) if selection.check():
                new = self.simulate(key, args)
                return new, jnp.zeros(()), Diff.unknown_change(new.value), Update(ChoiceMap.choice(old))
            case Regenerate():
                return self._rescore(trace, argdiffs)
        raise NotSupportedEditRequest(self, request)

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return trace.score if selection.check() else jnp.zeros_like(trace.score)

    def _rescore(self, trace: Any, argdiffs: Any) -> Edited:
        """The same value under new arguments."""
        unchanged, nothing = Diff.no_change(trace.value), Update(ChoiceMap.empty())
        if Diff.static_check_no_change(argdiffs):
            return trace, jnp.zeros(()), unchanged, nothing
        args = Diff.tree_primal(argdiffs)
        new = DistributionTrace(self, args, trace.value, self.score(trace.value, args))
        return new, new.score - trace.score, unchanged, nothing

    def _read(self, choices: ChoiceMap, args: Arguments) -> tuple[Any, Any, Any]:
        """(Value in the shape and dtype of a draw, flag of what was given, 0 or -inf if impossible).

        The value is None if nothing was given.

        Raises:
            ShapeMismatch: the shape is not a draw's.
            OutsideSupport: the value is known, and a discrete distribution never draws it.
        """
        found = dense(choices, self.index_shape(args))
        if found is None:
            return None, None, 0.0
        value, given = found
        expected = jax.eval_shape(self.draw, jax.random.key(0), args)
        if jnp.shape(value) != expected.shape:
            raise ShapeMismatch((), f"found {jnp.shape(value)}, expected {expected.shape}")
        value = jnp.asarray(value)
        # A copy, so that no two sites share one array: traces tell values apart by identity.
        cast = jnp.array(value, expected.dtype, copy=True)
        if jnp.issubdtype(expected.dtype, jnp.floating) or value.dtype == jnp.bool_:
            return cast, given, 0.0
        possible = jnp.logical_and(cast == value, self.in_support(cast))
        if given is not None:
            possible = where(given, possible, jnp.ones_like(possible))
        if not is_concrete(possible):
            return cast, given, jnp.where(jnp.all(possible), 0.0, -jnp.inf)
        if not bool(jnp.all(possible)):
            bad = value[jnp.logical_not(possible)].ravel()[0]
            raise OutsideSupport((), f"found {bad}, which a choice of dtype {expected.dtype} here never is")
        return cast, given, 0.0


@dataclass
class CustomDensity(ExactDensity):
    """The distribution of a pair of functions; made by `exact_density`."""

    sampler: Callable[..., Any] = static()
    log_density: Callable[..., Any] = static()
    name: str = static()

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        return self.sampler(key, *args, **kwargs)

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        return self.log_density(value, *args, **kwargs)


def exact_density(sample: Callable[..., Any], logpdf: Callable[..., Any], name: str) -> CustomDensity:
    """A distribution from `sample(key, *args)` and `logpdf(value, *args)`."""
    return CustomDensity(sample, logpdf, name)
