"""What inference is asked for, and what answers."""

from typing import Any

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.distribution import Distribution
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.pytree import Pytree, dataclass
from bayesmap.gen.typing import PRNGKey, Score, Weight


@dataclass
class Target(Pytree):
    """The posterior of `p(*args)` given the choices in `constraint`; `target["y"]` is the value given at "y".

    Raises:
        BadArguments: `p` is a marginal, and some of its choices are not in the constraint.
    """

    p: GenerativeFunction
    args: tuple[Any, ...]
    constraint: ChoiceMap

    def __post_init__(self) -> None:
        self.p.check_conditioning(self.constraint, self.args)

    def __getitem__(self, address: Any) -> Any:
        return self.constraint[address]

    def importance(self, key: PRNGKey, choices: ChoiceMap) -> tuple[Trace, Weight]:
        """A trace that agrees with the constraint and these choices, and its weight."""
        return self.p.importance(key, self.constraint | choices, self.args)

    def filter_to_unconstrained(self, choices: ChoiceMap) -> ChoiceMap:
        """The choices that the constraint leaves open."""
        return choices.filter(~self.constraint.get_selection())


class SampleDistribution(Distribution):
    """A distribution over choice maps, such as a marginal or the draws of an algorithm."""


class Algorithm(SampleDistribution):
    """Base of inference algorithms: distributions of a target's open choices, with estimated densities.

    `random_weighted(key, target)` gives (log density estimate, choices), `estimate_logpdf(key, choices, target)` the
    estimate alone.
    """

    def estimate_normalizing_constant(self, key: PRNGKey, target: Target) -> Weight:
        """The log of an unbiased estimate of the target's evidence."""
        raise NotImplementedError

    def estimate_reciprocal_normalizing_constant(
        self, key: PRNGKey, target: Target, latent_choices: ChoiceMap, w: Score
    ) -> Weight:
        """The log evidence such that exp of its negative is an unbiased estimate of 1 / evidence.

        Args:
            key: random key.
            target: what is open and what is given.
            latent_choices: a draw from the target.
            w: its log density, open and given choices together.
        """
        raise NotImplementedError
