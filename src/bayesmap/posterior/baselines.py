"""The maps that others keep, as predictions: hit-count ratios and log-odds, each with the best sensor for it.

All come from two counts: how often beams stopped in a cell, and how often they passed it. Each becomes a map of stop
probabilities, and predicts readings by the same formula as a posterior (`bayesmap.kernels.predict.density`).

A plug-in map has no sensor model of its own, so one is fitted to it, with where in a cell beams stop and the row's own
parameters. Fitting on the scans that were counted would reward over-confidence, hence an inner hold-out: of the
training scans every tenth is left out of the counts and predicted, in as many of the ten ways as it takes to have
`BEAMS_WANTED` beams. Scans that are scored in the end are never looked at.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.kinds import HIT_DEPTH, default_sensor
from bayesmap.posterior.folds import THIN, Fold, HeldOut, make_folds, together
from bayesmap.posterior.predictor import Predictor, fixed_maps
from bayesmap.posterior.progress_shares import OnShare, ignored, parts
from bayesmap.posterior.tuning import LAST_CLIMB, SENSOR, Parameter, Values, maximise, sensor_of
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

P_HIT, P_MISS = 0.7, 0.4
P_LEAST, P_MOST = 0.1192, 0.971
"""OctoMap's defaults: what a hit and a miss say, and where the probability of a cell is clamped."""

NOISES: tuple[float | None, ...] = (None, 4.0)
"""Degrees of freedom that are tried: normal noise, and Student-t noise with heavy tails."""


def hit_ratio(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """(hits + a) / (hits + passes + a + b): the mean of a Beta posterior, were it known which beams got there."""
    a, b = values["a"], values["b"]
    return (hits + a) / (hits + passes + a + b)


def log_odds(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Every hit adds logit p_hit, every pass logit p_miss; starts at ``p_start``."""
    logit = {name: np.log(values[name]) - np.log1p(-values[name]) for name in ("p_hit", "p_miss", "p_start")}
    total = logit["p_start"] + hits * logit["p_hit"] + passes * logit["p_miss"]
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(total, -500.0, 500.0))))


def log_odds_as_usual(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Log-odds with OctoMap's hit and miss, from 1/2, without clamping."""
    return log_odds(hits, passes, {"p_hit": P_HIT, "p_miss": P_MISS, "p_start": 0.5})


def log_odds_clamped(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """The same, clamped to OctoMap's interval.

    OctoMap clamps after every update, so that the order of hits and misses matters; its tree is clamped at once here.
    """
    return np.clip(log_odds_as_usual(hits, passes, values), P_LEAST, P_MOST)


@dataclass(frozen=True)
class Baseline:
    """A kind of map.

    Attributes:
        name: in tables.
        stop: stop probabilities of all cells, from the hits and passes of all, and the row's own parameters.
        own: those parameters.
        starts: where their fit starts.
    """

    name: str
    stop: Callable[[Floats, Floats, Mapping[str, float]], Floats]
    own: tuple[Parameter, ...] = ()
    starts: tuple[Mapping[str, float], ...] = ({},)

    def stops(self, hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
        """What ``stop`` says, which must be one probability for every cell.

        Raises:
            ValueError: another number of them, which would give cells the values of others.
        """
        found = np.asarray(self.stop(hits, passes, values))
        if found.shape != hits.shape:
            raise ValueError(f"{self.name}: stop gave an array of shape {found.shape} for cells of shape {hits.shape}")
        return found


BASELINES = (
    Baseline(
        "hit ratio",
        hit_ratio,
        (Parameter("a", 1e-5, 100.0), Parameter("b", 1e-5, 100.0)),
        ({"a": 0.1, "b": 0.5},),
    ),
    Baseline(
        "log-odds, tuned",
        log_odds,
        (
            Parameter("p_hit", 0.5001, 1 - 1e-6, share=True),
            Parameter("p_miss", 1e-6, 0.4999, share=True),
            Parameter("p_start", 1e-4, 0.9, share=True),
        ),
        ({"p_hit": 0.7, "p_miss": 0.4, "p_start": 0.3}, {"p_hit": 0.6, "p_miss": 0.48, "p_start": 0.1}),
    ),
    Baseline("log-odds", log_odds_as_usual),
    Baseline("log-odds, clamped", log_odds_clamped),
)
"""The rows of the table. OctoMap's own numbers are the last row's."""


@dataclass(frozen=True, eq=False)
class Fitted:
    """A baseline ready to predict.

    Attributes:
        name: of the baseline.
        predictor: its map from all training scans, its sensor, its hit depth.
        values: all fitted numbers.
        inner_nats_per_beam: what they reached on the inner hold-out.
    """

    name: str
    predictor: Predictor
    values: Values
    inner_nats_per_beam: float


def inner_score(held_out: HeldOut, baseline: Baseline, dof: float | None, values: Values) -> float:
    """Mean log predictive density of the folds' beams, each under the counts of the other scans."""
    from bayesmap.kernels.predict.density import log_densities

    stops = [baseline.stops(fold.hits, fold.passes, values)[fold.rays.touched] for fold in held_out.folds]
    maps, sensor = np.concatenate(stops)[None].astype(np.float32), sensor_of(values, dof)
    logs = log_densities(held_out.rays, [maps], sensor, values["hit_depth"], columns=held_out.columns)
    return float(np.nanmean(logs))


def fit_baseline(
    baseline: Baseline, train: Scans, grid: Grid, folds: Sequence[Fold] | None = None, on_progress: OnShare = ignored
) -> Fitted:
    """Fit a baseline's sensor, hit depth and own parameters on the training scans alone.

    Args:
        baseline: the kind of map.
        train: the scans that the map is made from.
        grid: its cells.
        folds: of `make_folds`, to share between baselines.
        on_progress: called with the share that is done, as far as that can be known of a search.
    """
    from bayesmap.kernels.counts import count_hits

    folds = make_folds(train, grid) if folds is None else folds
    default = default_sensor(grid.resolution)
    assert hasattr(default.noise, "sigma_m")
    sensible = {
        "scale_m": default.noise.sigma_m, "scale_per_m": 0.005, "p_random": default.p_random,
        "p_no_return": default.p_no_return, "p_short": default.p_short,
        "rate_short_per_m": default.rate_short_per_m, "hit_depth": HIT_DEPTH,
    }  # fmt: skip
    wary = sensible | {"p_random": 0.3, "p_short": 0.5, "rate_short_per_m": 0.1}
    starts = [sensor | dict(own) for own in baseline.starts for sensor in (sensible, wary)]
    rough = [folds[0].thinned()] if len(folds[0].scans) >= 2 * THIN else folds[: -(-len(folds) // THIN)]
    whole, part = together(folds), together(rough)
    best: tuple[float, Values, float | None] | None = None
    climbs = [len(starts) + LAST_CLIMB] + [1 + LAST_CLIMB] * (len(NOISES) - 1)
    for dof, on_share in zip(NOISES, parts(on_progress, *climbs), strict=True):
        # Heavy tails start where normal noise ended: the rest is nearly the same.
        begin = starts if best is None else [best[1] | {"scale_m": 0.7 * best[1]["scale_m"]}]
        values, score = maximise(
            partial(inner_score, whole, baseline, dof),
            partial(inner_score, part, baseline, dof),
            (*SENSOR, *baseline.own),
            begin,
            on_share,
        )
        if best is None or score > best[0]:
            best = score, values, dof
    assert best is not None
    score, values, dof = best
    hits, passes = count_hits(train, grid)
    stop = baseline.stops(hits.astype(float), passes.astype(float), values)
    predictor = Predictor(grid, fixed_maps(stop[None]), sensor_of(values, dof), values["hit_depth"])
    return Fitted(baseline.name, predictor, values, score)
