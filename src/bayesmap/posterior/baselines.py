"""Maps of other mappers as predictions, each with the best sensor for it: hit ratios, log-odds, and external maps.

docs/scoring.md explains the maps and their fits. A map of stop probabilities comes from counts of the beams that
stopped in each cell and passed it, or from another program. It predicts readings by the formula of a posterior
(`bayesmap.kernels.predict.density`). Its sensor, its hit depth and its own parameters maximise the score of training
scans that are left out of the counts (`bayesmap.posterior.heldout.make_folds`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy
from numpy.typing import NDArray

from bayesmap.cells.kinds import HIT_DEPTH, default_sensor
from bayesmap.errors import BadInput
from bayesmap.posterior.heldout import THIN, Fold, HeldOut, make_folds, one_fold, together
from bayesmap.posterior.prediction import OnShare, Predictor, fixed_maps, ignored, parts
from bayesmap.sensors.model import BeamMixture, noise_with
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats
from bayesmap.space.scans import Scans

Values = dict[str, float]
Target = Callable[[Values], float]  # to be maximised

LAST_CLIMB = 8.0  # time of the last climb, which uses the full score, relative to a rough climb, for progress
STEP = 2e-3  # step of the numeric gradient, in logarithms or logits: above the noise of stops in single precision
USUAL_GRADIENTS = 20  # per climb, for progress
MOST_STEPS = 100  # per climb
ROUGH = 1e-4  # relative gain in score at which the climb from each start ends
FINE = 1e-6  # relative gain at which the last climb ends, from the best of these results


@dataclass(frozen=True)
class Parameter:
    """A number to be fitted between two bounds."""

    name: str  # key in the values
    low: float
    high: float
    share: bool = False  # a share of one, searched by its logit; other parameters are positive: by their logarithm

    def inner(self, value: float) -> float:
        """Return the number that the search moves."""
        value = min(max(value, self.low), self.high)
        return math.log(value) - (math.log1p(-value) if self.share else 0.0)

    def outer(self, inner: float) -> float:
        """Return the parameter from the number that the search moves."""
        return 1.0 / (1.0 + math.exp(-inner)) if self.share else math.exp(inner)


SENSOR = (
    Parameter("scale_m", 1e-3, 2.0), Parameter("scale_per_m", 1e-6, 0.3), Parameter("p_random", 1e-4, 0.95, share=True),
    Parameter("p_no_return", 1e-5, 0.95, share=True), Parameter("p_short", 1e-5, 0.95, share=True),
    Parameter("rate_short_per_m", 1e-3, 50.0), Parameter("hit_depth", 1e-3, 1.0 - 1e-3, share=True),
)  # fmt: skip
"""Parameters of every prediction beside its map: the robust beam model, and where in a cell beams stop."""


def sensor_of(values: Mapping[str, float], dof: float | None) -> BeamMixture:
    """Return the beam model of some values: Student-t noise of ``dof`` degrees of freedom, or Gaussian if None."""
    scale, growth = values["scale_m"], values["scale_per_m"]
    noise = noise_with(math.inf if dof is None else dof, scale, growth)
    names = ("p_random", "p_no_return", "p_short", "rate_short_per_m")
    return BeamMixture(noise, **{name: values[name] for name in names})


def maximise(
    score: Target, rough_score: Target, parameters: Sequence[Parameter], starts: Sequence[Mapping[str, float]],
    on_progress: OnShare = ignored,
) -> tuple[Values, float]:  # fmt: skip
    """Find the values of the highest score, and the score, from the best of rough climbs from all starts."""

    def values_at(point: NDArray[np.float64]) -> Values:
        return {p.name: p.outer(x) for p, x in zip(parameters, point.tolist(), strict=True)}

    def climb(target: Target, start: Mapping[str, float], tolerance: float, on_share: OnShare) -> tuple[Values, float]:
        usual, calls = USUAL_GRADIENTS * (len(parameters) + 1), 0

        def descend(point: NDArray[np.float64]) -> float:
            nonlocal calls
            calls += 1
            on_share(0.9 * calls / usual if calls < usual else 1.0 - 0.1 * usual / calls)  # never all before the end
            return -target(values_at(point))

        result = scipy.optimize.minimize(
            descend, np.array([p.inner(start[p.name]) for p in parameters]), method="L-BFGS-B",
            bounds=[(p.inner(p.low), p.inner(p.high)) for p in parameters],
            options={"eps": STEP, "ftol": tolerance, "maxiter": MOST_STEPS, "maxfun": 3000},
        )  # fmt: skip
        on_share(1.0)
        return values_at(result.x), -float(result.fun)

    *rough_shares, on_last_share = parts(on_progress, *(1.0 for _ in starts), LAST_CLIMB)
    rough = [climb(rough_score, start, ROUGH, on_share) for start, on_share in zip(starts, rough_shares, strict=True)]
    return climb(score, max(rough, key=lambda result: result[1])[0], FINE, on_last_share)


# OctoMap's defaults:
P_HIT = 0.7  # probability of a cell after a hit
P_MISS = 0.4  # probability of a cell after a miss
P_BOUNDS = (0.1192, 0.971)  # bounds of a cell's probability

NOISE_DOFS: tuple[float | None, ...] = (None, 4.0)  # degrees of freedom of the noises that are tried; None for normal


def hit_ratio(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Compute (hits + a) / (hits + passes + a + b): a Beta posterior's mean, if every beam reached the cell."""
    a, b = values["a"], values["b"]
    return (hits + a) / (hits + passes + a + b)


def log_odds(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Add logit p_hit for every hit and logit p_miss for every pass to logit p_start. Returns probabilities."""
    logit = {name: np.log(values[name]) - np.log1p(-values[name]) for name in ("p_hit", "p_miss", "p_start")}
    summed = logit["p_start"] + hits * logit["p_hit"] + passes * logit["p_miss"]
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(summed, -500.0, 500.0))))


def log_odds_as_usual(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Compute `log_odds` with OctoMap's hit and miss, from 1/2, without clamping."""
    return log_odds(hits, passes, {"p_hit": P_HIT, "p_miss": P_MISS, "p_start": 0.5})


def log_odds_clamped(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Clamp `log_odds_as_usual` to OctoMap's interval, once and not after every update."""
    return np.clip(log_odds_as_usual(hits, passes, values), *P_BOUNDS)


@dataclass(frozen=True)
class Baseline:
    """A kind of map. ``stop`` returns stop probabilities of all cells from hits, passes and its own parameters."""

    name: str
    stop: Callable[[Floats, Floats, Mapping[str, float]], Floats]
    own: tuple[Parameter, ...] = ()  # parameters of this baseline alone
    starts: tuple[Mapping[str, float], ...] = ({},)  # starting values of these parameters

    def stops(self, hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
        """Return one stop probability for each cell; raise `ValueError` for another number of them."""
        probabilities = np.asarray(self.stop(hits, passes, values))
        if probabilities.shape != hits.shape:
            raise ValueError(f"{self.name}: stop gave shape {probabilities.shape} for cells of shape {hits.shape}")
        return probabilities


BASELINES = (
    Baseline(
        "hit ratio", hit_ratio, (Parameter("a", 1e-5, 100.0), Parameter("b", 1e-5, 100.0)), ({"a": 0.1, "b": 0.5},)
    ),
    Baseline(
        "log-odds, tuned", log_odds,
        (
            Parameter("p_hit", 0.5001, 1 - 1e-6, share=True), Parameter("p_miss", 1e-6, 0.4999, share=True),
            Parameter("p_start", 1e-4, 0.9, share=True),
        ),
        ({"p_hit": 0.7, "p_miss": 0.4, "p_start": 0.3}, {"p_hit": 0.6, "p_miss": 0.48, "p_start": 0.1}),
    ),
    Baseline("log-odds", log_odds_as_usual),
    Baseline("log-odds, clamped", log_odds_clamped),
)  # fmt: skip
"""The rows of the table. OctoMap's own numbers are the last row's."""


@dataclass(frozen=True, eq=False)
class Fitted:
    """A baseline ready to predict."""

    name: str
    predictor: Predictor  # predictor with the map from all training scans, the sensor and the hit depth
    values: Values  # all fitted numbers
    inner_nats_per_beam: float  # score on the inner hold-out


def inner_score(held_out: HeldOut, baseline: Baseline, dof: float | None, values: Values) -> float:
    """Compute the mean log predictive density of the folds' beams, each under the counts of the other scans."""
    from bayesmap.kernels.predict.density import log_densities

    stops = [baseline.stops(fold.hits, fold.passes, values)[fold.rays.touched] for fold in held_out.folds]
    maps, sensor = np.concatenate(stops)[None].astype(np.float32), sensor_of(values, dof)
    logs = log_densities(held_out.rays, [maps], sensor, values["hit_depth"], columns=held_out.columns)
    return float(np.nanmean(logs))


def fit_baseline(
    baseline: Baseline, train: Scans, grid: Grid, folds: Sequence[Fold] | None = None, on_progress: OnShare = ignored
) -> Fitted:
    """Fit a baseline's sensor, hit depth and parameters on the training scans, or on given ``folds`` of them."""
    from bayesmap.kernels.rays import count_hits

    folds = make_folds(train, grid) if folds is None else folds
    default = default_sensor(grid.resolution)
    assert hasattr(default.noise, "sigma_m")
    usual = {
        "scale_m": default.noise.sigma_m, "scale_per_m": 0.005, "p_random": default.p_random,
        "p_no_return": default.p_no_return, "p_short": default.p_short,
        "rate_short_per_m": default.rate_short_per_m, "hit_depth": HIT_DEPTH,
    }  # fmt: skip
    many_outliers = usual | {"p_random": 0.3, "p_short": 0.5, "rate_short_per_m": 0.1}
    starts = [sensor | dict(own) for own in baseline.starts for sensor in (usual, many_outliers)]
    rough = [folds[0].thinned()] if len(folds[0].scans) >= 2 * THIN else folds[: math.ceil(len(folds) / THIN)]
    all_beams, rough_beams = together(folds), together(rough)
    fits: list[tuple[float, Values, float | None]] = []
    climbs = [len(starts) + LAST_CLIMB] + [1 + LAST_CLIMB] * (len(NOISE_DOFS) - 1)
    for dof, on_share in zip(NOISE_DOFS, parts(on_progress, *climbs), strict=True):
        scores = partial(inner_score, all_beams, baseline, dof), partial(inner_score, rough_beams, baseline, dof)
        values, score = maximise(*scores, (*SENSOR, *baseline.own), starts, on_share)
        fits.append((score, values, dof))
        # Heavy tails start from the fit of normal noise: the other parameters change little.
        starts = [values | {"scale_m": 0.7 * values["scale_m"]}]
    score, values, dof = max(fits, key=lambda fit: fit[0])
    hits, passes = count_hits(train, grid)
    stop = baseline.stops(hits.astype(float), passes.astype(float), values)
    predictor = Predictor(grid, fixed_maps(stop[None]), sensor_of(values, dof), values["hit_depth"])
    return Fitted(baseline.name, predictor, values, score)


EXTERNAL = (
    Parameter("stop_occupied", 1e-3, 1 - 1e-6, share=True), Parameter("stop_free", 1e-7, 0.5, share=True),
    Parameter("stop_unknown", 1e-7, 1 - 1e-3, share=True),
)  # fmt: skip
EXTERNAL_STARTS = (
    {"stop_occupied": 0.9, "stop_free": 1e-3, "stop_unknown": 0.05},
    {"stop_occupied": 0.5, "stop_free": 0.01, "stop_unknown": 0.01},
)


def stop_probabilities(occupancy: Floats, values: Mapping[str, float]) -> Floats:
    """Return the chance that a beam stops in each cell, from its occupancy, NaN where unknown; same shape."""
    ends = np.array([values["stop_free"], values["stop_occupied"]])
    low, high = np.log(ends) - np.log1p(-ends)
    between = 1.0 / (1.0 + np.exp(-(low + (high - low) * np.nan_to_num(occupancy))))
    return np.where(np.isnan(occupancy), values["stop_unknown"], between)


def fit_external_map(name: str, occupancy: Floats, grid: Grid, train: Scans, on_progress: OnShare = ignored) -> Fitted:
    """Fit a sensor to an external map, and the stop probabilities of its occupied, free and unknown cells.

    ``occupancy`` holds probabilities of the cells, (nx, ny), NaN where unknown; ``train`` scans that are not scored, at
    poses in the map's frame. Raises `BadInput`: another shape, values outside [0, 1], or no pose on the map.
    """
    values = np.asarray(occupancy, dtype=np.float64)
    if values.shape != grid.shape or (np.abs(np.nan_to_num(values, nan=0.5) - 0.5) > 0.5).any():
        raise BadInput(f"{name}: occupancy must be probabilities of shape {grid.shape}, got shape {values.shape}")
    x0, x1, y0, y1 = grid.extent_m
    x, y = train.poses[:, 0], train.poses[:, 1]
    if not ((x > x0) & (x < x1) & (y > y0) & (y < y1)).any():
        raise BadInput(
            f"{name}: none of the poses lies on the map, which reaches from ({x0:.6g}, {y0:.6g}) to "
            f"({x1:.6g}, {y1:.6g}) m; are map and poses in one frame?"
        )

    def stop(hits: Floats, passes: Floats, numbers: Mapping[str, float]) -> Floats:
        return stop_probabilities(values.ravel(), numbers)

    baseline = Baseline(name, stop, EXTERNAL, EXTERNAL_STARTS)
    return fit_baseline(baseline, train, grid, one_fold(train, grid), on_progress)
