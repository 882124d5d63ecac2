"""Fit a sensor, and the other parameters of a prediction, by the score of held-out scans.

Parameters live in boxes; the search is L-BFGS-B on their logarithms or logits, from several starts.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from bayesmap.posterior.predictor import OnShare, ignored, parts
from bayesmap.sensors.builtin import BeamMixture, noise_with

Values = dict[str, float]

LAST_CLIMB = 8.0
"""Time of the last climb, which uses the full score, in times of a rough climb."""

STEP = 2e-3
"""Step of the numeric gradient, in logarithms or logits: above the noise of stops in single precision."""

GRADIENTS, MOST_STEPS = 20, 100
"""Usual number of gradients of a climb, for progress, and most steps."""

ROUGH, FINE = 1e-4, 1e-6
"""Relative gain in score at which a climb ends: from every start, and then from the best place found."""


@dataclass(frozen=True)
class Parameter:
    """A number to be fitted.

    Attributes:
        name: key in the values.
        low, high: bounds.
        share: whether it is a share of one, searched by its logit; otherwise it is positive, searched by its logarithm.
    """

    name: str
    low: float
    high: float
    share: bool = False

    def inner(self, value: float) -> float:
        """Return the number that the search moves."""
        value = min(max(value, self.low), self.high)
        return math.log(value) - (math.log1p(-value) if self.share else 0.0)

    def outer(self, moved: float) -> float:
        """Return the parameter from the number that the search moves."""
        return 1.0 / (1.0 + math.exp(-moved)) if self.share else math.exp(moved)


SENSOR = (
    Parameter("scale_m", 1e-3, 2.0),
    Parameter("scale_per_m", 1e-6, 0.3),
    Parameter("p_random", 1e-4, 0.95, share=True),
    Parameter("p_no_return", 1e-5, 0.95, share=True),
    Parameter("p_short", 1e-5, 0.95, share=True),
    Parameter("rate_short_per_m", 1e-3, 50.0),
    Parameter("hit_depth", 1e-3, 1.0 - 1e-3, share=True),
)
"""Parameters of every prediction beside its map: the robust beam model, and where in a cell beams stop."""


def sensor_of(values: Mapping[str, float], dof: float | None) -> BeamMixture:
    """Return the beam model of some values: Student-t noise of ``dof`` degrees of freedom, or Gaussian if None."""
    scale, growth = values["scale_m"], values["scale_per_m"]
    noise = noise_with(math.inf if dof is None else dof, scale, growth)
    names = ("p_random", "p_no_return", "p_short", "rate_short_per_m")
    return BeamMixture(noise, **{name: values[name] for name in names})


def maximise(
    score: Callable[[Values], float],
    rough_score: Callable[[Values], float],
    parameters: Sequence[Parameter],
    starts: Sequence[Mapping[str, float]],
    on_progress: OnShare = ignored,
) -> tuple[Values, float]:
    """Find the values of the highest score, and that score.

    Args:
        score: to be maximised, from the best end of the rough climbs.
        rough_score: a cheap approximation of it, climbed from every start.
        parameters: to be varied.
        starts: values of all of them.
        on_progress: called with the share that is done, as far as that can be known of a search.
    """
    names = [p.name for p in parameters]

    def values_at(point: NDArray[np.float64]) -> Values:
        return {n: p.outer(x) for n, p, x in zip(names, parameters, point.tolist(), strict=True)}

    def climb(
        what: Callable[[Values], float], start: Mapping[str, float], tolerance: float, on_share: OnShare
    ) -> tuple[Values, float]:
        usual, calls = GRADIENTS * (len(parameters) + 1), 0

        def descend(point: NDArray[np.float64]) -> float:
            nonlocal calls
            calls += 1
            on_share(0.9 * calls / usual if calls < usual else 1.0 - 0.1 * usual / calls)  # never all before the end
            return -what(values_at(point))

        result = scipy.optimize.minimize(
            descend,
            np.array([p.inner(start[p.name]) for p in parameters]),
            method="L-BFGS-B",
            bounds=[(p.inner(p.low), p.inner(p.high)) for p in parameters],
            options={"eps": STEP, "ftol": tolerance, "maxiter": MOST_STEPS, "maxfun": 3000},
        )
        on_share(1.0)
        return values_at(result.x), -float(result.fun)

    *low, last = parts(on_progress, *(1.0 for _ in starts), LAST_CLIMB)
    rough = [climb(rough_score, start, ROUGH, on_share) for start, on_share in zip(starts, low, strict=True)]
    return climb(score, max(rough, key=lambda result: result[1])[0], FINE, last)
