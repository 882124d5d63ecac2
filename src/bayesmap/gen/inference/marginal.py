"""Marginals: generative functions of which only the selected choices are shown; the others are hidden.

The density of the shown choices is a sum over the hidden ones. Importance sampling or another algorithm estimates it.
The estimates exp(weight) in `generate` and exp(-score) in `simulate` are unbiased: samplers that use them stay exact.
"""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
from jax.scipy.special import logsumexp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.edits import Edited, EditRequest, Regenerate, Update
from bayesmap.gen.errors import BadArguments, NotSupportedEditRequest
from bayesmap.gen.generative_function import GenerativeFunction, Trace, decorator_method
from bayesmap.gen.inference.smc import Algorithm, SampleDistribution, Target
from bayesmap.gen.pytree import dataclass, nth, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import Arguments, Array, PRNGKey, Score, Weight


@dataclass
class MarginalTrace(Trace):
    """The shown choices, and `score`, an estimate of their log marginal density."""

    choices: ChoiceMap  # the shown choices
    retval: Any  # the return value of the run with all choices
    score: Score

    def get_choices(self) -> ChoiceMap:
        return self.choices


@dataclass
class Marginal(SampleDistribution):
    """The marginal distribution of the selected choices of a generative function. See `marginal`."""

    gen_fn: GenerativeFunction  # the function with all choices
    selection: Selection  # selection of the shown choices
    algorithm: Algorithm | None = None  # the estimator of densities; if None, importance sampling
    particles: int = static(default=1)  # number of runs in importance sampling

    def random_weighted(self, key: PRNGKey, *args: Any) -> tuple[Score, ChoiceMap]:
        """Draw the shown choices. Returns (estimate of their log density, choices)."""
        trace = self.simulate(key, args)
        return trace.score, trace.choices

    def estimate_logpdf(self, key: PRNGKey, value: ChoiceMap, *args: Any) -> Score:
        """Return an estimate of the log density of the shown choices `value`."""
        return self.generate(key, value, args)[1]

    def check_conditioning(self, constraint: ChoiceMap, args: Arguments) -> None:
        """Raise BadArguments if `constraint` leaves a selected choice open."""
        # Importance sampling would draw the open choice, and it needs exact densities of the choices that it draws.
        _require_all(self.gen_fn.choice_shapes(args).filter(self.selection), constraint)

    def _importance_sample(self, key: PRNGKey, shown: ChoiceMap, args: Arguments, n: int) -> tuple[Trace, Array]:
        """Return `n` runs that agree with `shown`, and their log weights, (n,)."""
        return jax.vmap(lambda k: self.gen_fn.generate(k, shown, args))(jax.random.split(key, n))

    def simulate(self, key: PRNGKey, args: Arguments) -> MarginalTrace:
        """Draw all choices, and keep the shown ones. exp(-score) is an unbiased estimate of 1 / density."""
        simulate_key, estimate_key = jax.random.split(key)
        trace = self.gen_fn.simulate(simulate_key, args)
        choices = trace.get_choices()
        shown = choices.filter(self.selection)
        if self.algorithm is not None:
            hidden = choices.filter(~self.selection)
            target = Target(self.gen_fn, args, shown)
            estimate = self.algorithm.estimate_reciprocal_normalizing_constant
            score = estimate(estimate_key, target, hidden, trace.get_score())
            return MarginalTrace(self, args, shown, trace.get_retval(), score)
        # Conditional importance sampling: this run is one of the particles, else 1 / density would be biased.
        # `project` uses no randomness, so that the reuse of the key has no effect.
        log_weights = trace.project(simulate_key, self.selection)[None]
        if self.particles > 1:
            _, other_log_weights = self._importance_sample(estimate_key, shown, args, self.particles - 1)
            log_weights = jnp.concatenate([log_weights, other_log_weights])
        score = logsumexp(log_weights) - jnp.log(self.particles)
        return MarginalTrace(self, args, shown, trace.get_retval(), score)

    def generate(self, key: PRNGKey, constraint: ChoiceMap, args: Arguments) -> tuple[MarginalTrace, Weight]:
        """Return (trace of the given choices, estimate of their log density). exp(weight) is unbiased.
        An empty constraint draws all choices. Raises BadArguments if only some of the shown choices are given.
        """
        if constraint.static_is_empty():
            return self.simulate(key, args), jnp.zeros(())
        if self.algorithm is None:
            traces, log_weights = self._importance_sample(key, constraint, args, self.particles)
            trace = nth(traces, 0)  # all runs share the shown choices; the return value is the first run's
            score = logsumexp(log_weights) - jnp.log(self.particles)
        else:
            trace, _ = self.gen_fn.generate(key, constraint, args)
            # The kept run uses this key too, but has no part in the estimate, which therefore stays unbiased.
            score = self.algorithm.estimate_normalizing_constant(key, Target(self.gen_fn, args, constraint))
        shown = trace.get_choices().filter(self.selection)
        _require_all(shown, constraint)
        return MarginalTrace(self, args, shown, trace.get_retval(), score), score

    def assess(self, choices: ChoiceMap, args: Arguments) -> tuple[Score, Any]:
        """Return (exact log density of the choices, return value). Raises NotImplementedError for hidden choices."""
        self.check_conditioning(choices, args)
        if not self.gen_fn.choice_shapes(args).filter(~self.selection).static_is_empty():
            raise NotImplementedError("this marginal density is an estimate that needs a key: use generate")
        trace, score = self.generate(jax.random.key(0), choices, args)  # nothing is hidden: the key has no effect
        return score, trace.get_retval()

    def edit(self, key: PRNGKey, trace: MarginalTrace, request: EditRequest, argdiffs: Any) -> Edited:
        """Replace shown choices by an Update, or all of them by a Regenerate. The hidden choices are drawn anew."""
        args = Diff.tree_primal(argdiffs)
        match request:
            case Update(constraint) if constraint.static_is_empty() and Diff.static_check_no_change(argdiffs):
                return trace, jnp.zeros(()), Diff.no_change(trace.retval), request
            case Update(constraint):
                new, score = self.generate(key, constraint | trace.choices, args)
                discard = constraint & trace.choices
                return new, score - trace.score, Diff.unknown_change(new.retval), Update(discard)
            case Regenerate(selection) if trace.choices.filter(~selection).static_is_empty():
                new = self.simulate(key, args)
                return new, jnp.zeros(()), Diff.unknown_change(new.retval), Update(trace.choices)
        raise NotSupportedEditRequest(self, request)

    def project(self, key: PRNGKey, trace: MarginalTrace, selection: Selection) -> Weight:
        """Return the score. Raises NotImplementedError unless all shown choices are selected."""
        if not trace.choices.filter(~selection).static_is_empty():
            raise NotImplementedError("a marginal's score cannot be split among its choices")
        return trace.score


def _require_all(shown: ChoiceMap, constraint: ChoiceMap) -> None:
    """Raise BadArguments if a choice in `shown` has no value in `constraint`."""
    constrained = constraint.get_selection()
    missing = [path for path in shown.paths() if not constrained[path]]
    if missing:
        raise BadArguments(f"a marginal needs values for all of its choices; missing: {missing}")


@decorator_method
def marginal(
    *, selection: Selection | None = None, algorithm: Algorithm | None = None, particles: int = 1
) -> Callable[[GenerativeFunction], Marginal]:
    """Return a decorator that keeps the selected choices and marginalises the others.
    The score is exact if no choice is hidden. Otherwise `algorithm` estimates it; without an algorithm, importance
    sampling with `particles` runs does. The weights of `generate` are unbiased.
    """
    shown = Selection.all() if selection is None else selection
    return lambda gen_fn: Marginal(gen_fn.as_part(), shown, algorithm, particles)
