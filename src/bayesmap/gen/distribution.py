"""Distributions: generative functions with one choice, at the empty address.

`Distribution` implements the contract of generative functions for densities that may be estimates. Almost all
distributions derive from `ExactDensity`, which needs only a sampler and a log density. `exact_density` makes one.
"""

import operator
from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from bayesmap.gen.axes import dense
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.edits import Edited, EditRequest, Regenerate, Update
from bayesmap.gen.errors import BadArguments, MissingAddress, NotSupportedEditRequest, OutsideSupport, ShapeMismatch
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.masks import Mask, check_flags, in_optional_part, is_concrete, where_leaves
from bayesmap.gen.pytree import Const, dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, PRNGKey, Score, Weight


@dataclass
class DistributionTrace(Trace):
    """The trace of a distribution: a draw and its log density."""

    value: Any  # the draw
    score: Score  # its log density, or an estimate

    def get_retval(self) -> Any:
        return self.value

    def get_choices(self) -> ChoiceMap:
        return ChoiceMap.choice(self.value)


class GivenValue(NamedTuple):
    """The value that a choice map gives to a distribution."""

    value: Any  # None if the map gives no value
    flags: Any  # which elements are given; None for all elements
    penalty: Any  # -inf if the distribution cannot draw the value, else 0


class Distribution(GenerativeFunction):
    """Base of distributions whose density may be an estimate: implement `random_weighted` and `estimate_logpdf`.
    They are a pair as in Lew et al., Probabilistic programming with stochastic probabilities (2023). exp(-score) of
    `random_weighted` is an unbiased estimate of 1 / density at the draw, and exp(`estimate_logpdf`) of the density.
    """

    def random_weighted(self, key: PRNGKey, *args: Any) -> tuple[Score, Any]:
        """Draw a value. Returns (log density, draw)."""
        raise NotImplementedError

    def estimate_logpdf(self, key: PRNGKey, value: Any, *args: Any) -> Score:
        """Return the log density at `value`, shape ()."""
        raise NotImplementedError

    def read(self, choices: ChoiceMap, args: Arguments) -> GivenValue:
        """Return the value that the choices give."""
        value = choices.get_value()
        return GivenValue(value.value, value.flag, 0.0) if isinstance(value, Mask) else GivenValue(value, None, 0.0)

    def like(self, value: Any, old: Any) -> Any:
        """Return a new value in the dtypes of the old one, so that both can be branches of `lax.cond`."""
        return jax.tree.map(lambda v, o: jnp.asarray(v, jnp.result_type(o)), value, old)

    def simulate(self, key: PRNGKey, args: Arguments) -> Trace:
        """Draw a value. Returns its trace."""
        if not isinstance(args, tuple):
            raise TypeError(f"args must be a tuple of arguments, not {type(args).__name__}")
        score, value = self.random_weighted(key, *args)
        return DistributionTrace(self, args, value, score)

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        """Return (log density of the chosen value, value). Raises MissingAddress if the choices give no value."""
        value, flags, penalty = self.read(choices, args)
        if value is None:
            raise MissingAddress(())
        score = self.estimate_logpdf(jax.random.key(0), value, *args) + penalty
        if flags is not None:
            # A missing value is an error if this is known now; compiled code returns NaN.
            if is_concrete(flags) and not in_optional_part() and not bool(jnp.all(flags)):
                raise MissingAddress((), "its mask's flag is False" if jnp.ndim(flags) == 0 else f"given: {flags}")
            check_flags(jnp.logical_or(flags, in_optional_part()), "assess: a choice is masked, and its flag is False")
            score = jnp.where(jnp.all(flags), score, jnp.nan)
        return score, value

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        """Return the trace of the given value, weighted by its density, or of a draw, with weight 0."""
        value, flags, penalty = self.read(constraint, args)
        if value is None:
            return self.simulate(key, args), jnp.zeros(())
        score = self.estimate_logpdf(key, value, *args) + penalty
        if flags is None:
            return DistributionTrace(self, args, value, score), score
        drawn_score, drawn = self.random_weighted(key, *args)
        new = DistributionTrace(self, args, where_leaves(flags, value, drawn), jnp.where(flags, score, drawn_score))
        return new, jnp.where(flags, score, 0.0)

    def edit(self, key: PRNGKey, trace: Any, request: EditRequest, argdiffs: Any) -> Edited:
        """Replace the value by the given one, or by a draw, or score the old value under new arguments."""
        args, old = Diff.tree_primal(argdiffs), trace.value
        match request:
            case Update(constraint):
                value, flags, penalty = self.read(constraint, args)
                if value is None:
                    return self._rescore(key, trace, argdiffs)
                value = self.like(value, old)
                value = value if flags is None else where_leaves(flags, value, old)
                new = DistributionTrace(self, args, value, self.estimate_logpdf(key, value, *args) + penalty)
                discard = ChoiceMap.choice(old if flags is None else Mask(old, flags))
                return new, new.score - trace.score, Diff.unknown_change(value), Update(discard)
            case Regenerate(selection) if selection.check():
                score, value = self.random_weighted(key, *args)
                new = DistributionTrace(self, args, self.like(value, old), score)
                return new, jnp.zeros(()), Diff.unknown_change(new.value), Update(ChoiceMap.choice(old))
            case Regenerate():
                return self._rescore(key, trace, argdiffs)
        raise NotSupportedEditRequest(self, request)

    def project(self, key: PRNGKey, trace: Any, selection: Selection) -> Weight:
        return trace.score if selection.check() else jnp.zeros_like(trace.score)

    def _rescore(self, key: PRNGKey, trace: Any, argdiffs: Any) -> Edited:
        """Keep the value under new arguments."""
        unchanged, nothing = Diff.no_change(trace.value), Update(ChoiceMap.empty())
        if Diff.static_check_no_change(argdiffs):
            return trace, jnp.zeros(()), unchanged, nothing
        args = Diff.tree_primal(argdiffs)
        new = DistributionTrace(self, args, trace.value, self.estimate_logpdf(key, trace.value, *args))
        return new, new.score - trace.score, unchanged, nothing


def draw_shape(sample_shape: Any) -> tuple[int, ...]:
    """Return as a tuple the shape `sample_shape`: a number of draws, a sequence of lengths, or a `Const` of either."""
    shape = Const.unwrap(sample_shape)
    try:
        return tuple(map(operator.index, shape)) if np.ndim(shape) else (operator.index(shape),)
    except TypeError:
        choices = "a number of draws or a tuple of lengths (under jit as a Const)"
        raise BadArguments(f"sample_shape is {choices}, not {shape!r}") from None


class ExactDensity(Distribution):
    """Base of distributions with a known density: implement `sample` and `logpdf`.
    With array parameters the draws are independent, and the score is the sum of their log densities, of shape ().
    """

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        """Return a draw, an array."""
        raise NotImplementedError

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        """Return the log density at `value`, in the shape of the independent draws."""
        raise NotImplementedError

    def draw(self, key: PRNGKey, args: Arguments) -> Any:
        """Return a draw for a trace."""
        return self.sample(key, *args)

    def score(self, value: Any, args: Arguments, flags: Any = None) -> Score:
        """Return the total log density, shape (). Values whose flag is False add 0."""
        total = jnp.sum(jnp.asarray(self.logpdf(value, *args))).astype(jnp.result_type(float))
        return total if flags is None else jnp.where(flags, total, 0.0)

    def index_shape(self, args: Arguments) -> tuple[int, ...]:
        """Return the leading axes that an index in a constraint selects from: none, unless vectorised."""
        return ()

    def in_support(self, value: Any) -> Any:
        """Return elementwise whether any parameters of a discrete distribution can give this value."""
        return True

    def random_weighted(self, key: PRNGKey, *args: Any) -> tuple[Score, Any]:
        value = self.draw(key, args)
        return self.score(value, args), value

    def estimate_logpdf(self, key: PRNGKey, value: Any, *args: Any) -> Score:
        return self.score(value, args)

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[Trace, Weight]:
        """Return the trace of the given elements and of draws elsewhere, weighted by the given elements' density."""
        value, flags, penalty = self.read(constraint, args)
        if value is None or flags is None:
            return super().generate(key, constraint, args)
        drawn = self.draw(key, args)
        value = where_leaves(flags, self.like(value, drawn), drawn)
        new = DistributionTrace(self, args, value, self.score(value, args) + penalty)
        return new, self.score(value, args, flags) + penalty

    def read(self, choices: ChoiceMap, args: Arguments) -> GivenValue:
        """Return the value that the choices give, perhaps at indices, as one array.
        The value keeps its dtype, but integers become real where draws are real: later edits keep the trace's dtypes
        and could not move integers. Raises ShapeMismatch, and OutsideSupport if a known value is never drawn.
        """
        constraint = dense(choices, self.index_shape(args))
        # The arguments are closed over, not traced: one of them may be a shape.
        expected = jax.eval_shape(lambda key: self.draw(key, args), jax.random.key(0))
        if constraint is None:
            # No choice map holds an array without elements, so that it needs no value.
            return GivenValue(jnp.zeros(expected.shape, expected.dtype) if 0 in expected.shape else None, None, 0.0)
        value, flags = constraint
        if jnp.shape(value) != expected.shape:
            raise ShapeMismatch((), f"found {jnp.shape(value)}, expected {expected.shape}")
        value = jnp.asarray(value)
        draws_real = jnp.issubdtype(expected.dtype, jnp.floating)
        is_real = jnp.issubdtype(value.dtype, jnp.floating)
        # A copy, so that no two sites share one array: traces tell values apart by identity.
        copy = jnp.array(value, expected.dtype if draws_real and not is_real else value.dtype, copy=True)
        if value.dtype == jnp.bool_:
            return GivenValue(copy, flags, 0.0)
        possible = self.in_support(copy)
        if not draws_real:
            possible = jnp.logical_and(value.astype(expected.dtype) == value, possible)
        return GivenValue(copy, flags, self._penalty(value, flags, possible, expected.dtype))

    def _penalty(self, value: Any, flags: Any, possible: Any, dtype: Any) -> Any:
        """Return 0 if all given elements are possible, else -inf. Raises OutsideSupport if this is known at once."""
        if possible is True:
            return 0.0
        if flags is not None:
            possible = where_leaves(flags, possible, jnp.ones_like(possible))
        if not is_concrete(possible):
            return jnp.where(jnp.all(possible), 0.0, -jnp.inf)
        if not bool(jnp.all(possible)):
            impossible = value[jnp.logical_not(possible)].ravel()[0]
            raise OutsideSupport((), f"found {impossible}, which a choice of dtype {dtype} here never is")
        return 0.0


@dataclass
class KeywordDensity(ExactDensity):
    """Base of exact densities with named arguments. With `by_name` they are `((positional, ...), {"name": value})`."""

    by_name: bool = static(default=False, kw_only=True)

    def handle_kwargs(self) -> GenerativeFunction:
        return self.replace(by_name=True)

    def split(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[tuple[Any, ...], dict[str, Any]]:
        """Return (positional arguments, arguments by name)."""
        return (args[0], {**args[1], **kwargs}) if self.by_name else (args, dict(kwargs))


@dataclass
class CustomDensity(KeywordDensity):
    """The distribution of a sampler and a log density, two functions of a user. See `exact_density`."""

    sampler: Callable[..., Any] = static()  # (key, *args) -> draw
    log_density: Callable[..., Any] = static()  # (value, *args) -> log density
    name: str = static()

    def sample(self, key: PRNGKey, *args: Any, **kwargs: Any) -> Any:
        args, kwargs = self.split(args, kwargs)
        return self.sampler(key, *args, **kwargs)

    def logpdf(self, value: Any, *args: Any, **kwargs: Any) -> Any:
        args, kwargs = self.split(args, kwargs)
        return self.log_density(value, *args, **kwargs)


def exact_density(sample: Callable[..., Any], logpdf: Callable[..., Any], name: str = "unnamed") -> CustomDensity:
    """Return the distribution with the sampler `sample(key, *args)` and the log density `logpdf(value, *args)`."""
    return CustomDensity(sample, logpdf, name)
