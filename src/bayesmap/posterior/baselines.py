"""Maps of other mappers as predictions, each with the best sensor for it: hit ratios, log-odds, and external maps.

docs/scoring.md explains the maps and their fits. A map of stop probabilities comes from counts of the beams that
stopped in each cell and passed it (`BASELINES`), or from another program. It predicts readings by the formula of a
posterior. `fit_baseline` and `fit_external_map` find the sensor, the hit depth and the map's own parameters that
`maximise` the score of training scans that are left out of the counts (`bayesmap.posterior.heldout.make_folds`).
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy
from numpy.typing import NDArray

from bayesmap.cells.kinds import HIT_DEPTH, default_sensor
from bayesmap.errors import BadInput
from bayesmap.posterior.heldout import THIN, Fold, JoinedFolds, join_folds, make_folds, one_fold
from bayesmap.posterior.prediction import OnShare, Predictor, fixed_maps, ignore_share, split_progress
from bayesmap.sensors.model import BeamMixture, noise_with
from bayesmap.space.arrays import Floats
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

Values = dict[str, float]  # parameters by name
LogDensities = Callable[[Values], Floats]  # returns the log density of each reading, (B,), NaN for invalid readings

LAST_CLIMB_TIME = 8.0  # time of the last climb, which uses the full score, in times of a rough climb; for the progress
GRADIENT_STEP = 1e-3  # step of the numeric gradient, in units of the search: above the rounding of single precision
LEAST_INFORMATION = 1e-3  # added to the information of one reading about a parameter, which may be none
USUAL_GRADIENTS = 20  # gradients that a climb usually computes; for the progress
MAX_STEPS = 100  # most steps of a climb
ROUGH_TOLERANCE, FINE_TOLERANCE = 1e-4, 1e-6  # relative gains in score at which rough climbs and the last one end
P_HIT, P_MISS = 0.7, 0.4  # probabilities of a cell after a hit and after a miss, OctoMap's defaults
P_BOUNDS = (0.1192, 0.971)  # bounds of a cell's probability, OctoMap's defaults
HEAVY_TAILS = {"dof": 4.0}  # Student's t with 4 degrees of freedom, which is tried beside normal noise


@dataclass(frozen=True)
class Parameter:
    """A number to be fitted between two bounds."""

    name: str  # key in the values
    low: float
    high: float
    share: bool = False  # a share of one, searched by its logit; other parameters are positive: by their logarithm

    def encode(self, value: float) -> float:
        """Return the number that the search moves: the logit or the logarithm of a value, moved into the bounds."""
        value = min(max(value, self.low), self.high)
        return math.log(value) - (math.log1p(-value) if self.share else 0.0)

    def decode(self, coordinate: float) -> float:
        """Return the value from the number that the search moves."""
        return 1.0 / (1.0 + math.exp(-coordinate)) if self.share else math.exp(coordinate)


SENSOR = (
    Parameter("scale_m", 1e-3, 2.0), Parameter("scale_per_m", 1e-6, 0.3), Parameter("p_random", 1e-4, 0.95, share=True),
    Parameter("p_no_return", 1e-5, 0.95, share=True), Parameter("p_short", 1e-5, 0.95, share=True),
    Parameter("rate_short_per_m", 1e-3, 50.0), Parameter("hit_depth", 1e-3, 1.0 - 1e-3, share=True),
)  # fmt: skip
"""Parameters of every prediction beside its map: the robust beam model, and where in a cell beams stop."""


def sensor_of(values: Mapping[str, float]) -> BeamMixture:
    """Return the beam model of some values; its noise is normal unless they have degrees of freedom, "dof"."""
    noise = noise_with(values.get("dof", math.inf), values["scale_m"], values["scale_per_m"])
    names = ("p_random", "p_no_return", "p_short", "rate_short_per_m")
    return BeamMixture(noise, **{name: values[name] for name in names})


def maximise(
    log_densities: LogDensities, rough_log_densities: LogDensities, parameters: Sequence[Parameter],
    starts: Sequence[Mapping[str, float]], on_progress: OnShare = ignore_share,
) -> tuple[Values, float]:  # fmt: skip
    """Find the values of the highest score, the mean log density, by a climb from the best rough climb of all starts.
    Values of a start that are no ``parameters`` stay as they are. Returns the values and their score.
    """
    *rough_shares, last_share = split_progress(on_progress, *(1.0 for _ in starts), LAST_CLIMB_TIME)
    climb = partial(_climb, rough_log_densities, parameters, tolerance=ROUGH_TOLERANCE)
    rough = [climb(start=start, on_share=on_share) for start, on_share in zip(starts, rough_shares, strict=True)]
    best_values, _ = max(rough, key=lambda result: result[1])
    return _climb(log_densities, parameters, best_values, FINE_TOLERANCE, last_share)


def _climb(
    log_densities: LogDensities, parameters: Sequence[Parameter], start: Mapping[str, float], tolerance: float,
    on_share: OnShare,
) -> tuple[Values, float]:  # fmt: skip
    """Climb from a start to a local maximum of the score. Returns the values and the score there."""
    usual_calls = USUAL_GRADIENTS * (len(parameters) + 1)
    n_calls = 0
    low, high, first = np.array([[p.encode(value) for value in (p.low, p.high, start[p.name])] for p in parameters]).T

    def values_at(point: NDArray[np.float64]) -> Values:
        return {**start, **{p.name: p.decode(x) for p, x in zip(parameters, point.tolist(), strict=True)}}

    def logs_at(point: NDArray[np.float64]) -> Floats:
        nonlocal n_calls
        n_calls += 1
        on_share(0.9 * n_calls / usual_calls if n_calls < usual_calls else 1.0 - 0.1 * usual_calls / n_calls)  # under 1
        return log_densities(values_at(point)).ravel()

    # Search in units in which a reading's information about each parameter, the mean squared slope of its log density,
    # is one: the score is about as steep in all of them, which halves the steps.
    beside = np.clip(first + GRADIENT_STEP * np.eye(len(first)), low, high)
    at_first, *moved = (logs_at(point) for point in (first, *beside))
    information = np.nanmean(((np.array(moved) - at_first) / GRADIENT_STEP) ** 2, axis=1)
    unit = 1.0 / np.sqrt(information + LEAST_INFORMATION)
    result = scipy.optimize.minimize(
        lambda moves: -float(np.nanmean(logs_at(first + unit * moves))), np.zeros(len(first)), method="L-BFGS-B",
        bounds=list(zip((low - first) / unit, (high - first) / unit, strict=True)),
        options={"eps": GRADIENT_STEP, "ftol": tolerance, "maxiter": MAX_STEPS, "maxfun": 3000},
    )  # fmt: skip
    on_share(1.0)
    return values_at(first + unit * result.x), -float(result.fun)


def hit_ratio(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Compute (hits + a) / (hits + passes + a + b): a Beta posterior's mean, if every beam reached the cell."""
    return (hits + values["a"]) / (hits + passes + values["a"] + values["b"])


def odds_map(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Add logit p_hit for every hit and logit p_miss for every pass to logit p_start. Returns probabilities."""
    logit = {name: np.log(values[name]) - np.log1p(-values[name]) for name in ("p_hit", "p_miss", "p_start")}
    summed = logit["p_start"] + hits * logit["p_hit"] + passes * logit["p_miss"]
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(summed, -500.0, 500.0))))


def octomap_map(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Compute `odds_map` with OctoMap's hit and miss, from 1/2, without clamping; ``values`` are not used."""
    return odds_map(hits, passes, {"p_hit": P_HIT, "p_miss": P_MISS, "p_start": 0.5})


def clamped_octomap_map(hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
    """Clamp `octomap_map` to OctoMap's interval, once and not after every update."""
    return np.clip(octomap_map(hits, passes, values), *P_BOUNDS)


@dataclass(frozen=True)
class Baseline:
    """A kind of map that is computed from counts of hits and passes."""

    name: str
    stop: Callable[[Floats, Floats, Mapping[str, float]], Floats]  # stop probabilities by hits, passes and values
    parameters: tuple[Parameter, ...] = ()  # parameters of this baseline beside those of the sensor
    starts: tuple[Mapping[str, float], ...] = ({},)  # starting values of these parameters

    def stops(self, hits: Floats, passes: Floats, values: Mapping[str, float]) -> Floats:
        """Return the stop probability of each cell, (N,). Raises `ValueError` if ``stop`` returns another shape."""
        probabilities = np.asarray(self.stop(hits, passes, values))
        if probabilities.shape != hits.shape:
            raise ValueError(f"{self.name}: stop gave shape {probabilities.shape} for cells of shape {hits.shape}")
        return probabilities


BASELINES = (
    Baseline(
        "hit ratio", hit_ratio, (Parameter("a", 1e-5, 100.0), Parameter("b", 1e-5, 100.0)), ({"a": 0.1, "b": 0.5},)
    ),
    Baseline(
        "log-odds, tuned", odds_map,
        (
            Parameter("p_hit", 0.5001, 1 - 1e-6, share=True), Parameter("p_miss", 1e-6, 0.4999, share=True),
            Parameter("p_start", 1e-4, 0.9, share=True),
        ),
        ({"p_hit": 0.7, "p_miss": 0.4, "p_start": 0.3}, {"p_hit": 0.6, "p_miss": 0.48, "p_start": 0.1}),
    ),
    Baseline("log-odds", octomap_map),
    Baseline("log-odds, clamped", clamped_octomap_map),
)  # fmt: skip
"""The rows of the table of scores. The last row has OctoMap's own numbers."""


@dataclass(frozen=True, eq=False)
class FittedBaseline:
    """A baseline ready to predict."""

    name: str
    predictor: Predictor  # predictor with the map from all training scans, the sensor and the hit depth
    values: Values  # all fitted numbers
    inner_nats_per_beam: float  # score on the inner hold-out


def inner_log_densities(joined: JoinedFolds, baseline: Baseline, values: Values) -> Floats:
    """Compute the log predictive densities of the folds' beams, (B,), each under the counts of the other scans."""
    from bayesmap.kernels.predict.density import log_densities

    stops = [baseline.stops(fold.hits, fold.passes, values)[fold.rays.touched] for fold in joined.folds]
    maps = np.concatenate(stops)[None].astype(np.float32)
    return log_densities(joined.rays, [maps], sensor_of(values), values["hit_depth"], columns=joined.columns)


def fit_baseline(
    baseline: Baseline, train: Scans, grid: Grid, folds: Sequence[Fold] | None = None,
    on_progress: OnShare = ignore_share,
) -> FittedBaseline:  # fmt: skip
    """Fit a baseline's sensor, hit depth and parameters on the training scans, or on given ``folds`` of them."""
    from bayesmap.kernels.rays import count_hits

    folds = make_folds(train, grid) if folds is None else folds
    default = default_sensor(grid.resolution)
    assert hasattr(default.noise, "sigma_m")  # the default noise is normal
    few_outliers = {
        "scale_m": default.noise.sigma_m, "scale_per_m": 0.005, "p_random": default.p_random,
        "p_no_return": default.p_no_return, "p_short": default.p_short,
        "rate_short_per_m": default.rate_short_per_m, "hit_depth": HIT_DEPTH,
    }  # fmt: skip
    many_outliers = few_outliers | {"p_random": 0.3, "p_short": 0.5, "rate_short_per_m": 0.1}
    sensors = (few_outliers, many_outliers, many_outliers | HEAVY_TAILS)
    starts = [sensor | dict(start) for start in baseline.starts for sensor in sensors]
    # The rough score uses a share of the beams: some scans of the first fold, or some folds if it has few scans.
    rough = [folds[0].thinned()] if len(folds[0].scans) >= 2 * THIN else folds[: math.ceil(len(folds) / THIN)]
    full_logs, rough_logs = (partial(inner_log_densities, join_folds(some), baseline) for some in (folds, rough))
    parameters = (*SENSOR, *baseline.parameters)
    values, best_score = maximise(full_logs, rough_logs, parameters, starts, on_progress)
    hits, passes = (counts.astype(float) for counts in count_hits(train, grid))
    stop = baseline.stops(hits, passes, values)
    predictor = Predictor(grid, fixed_maps(stop[None]), sensor_of(values), values["hit_depth"])
    return FittedBaseline(baseline.name, predictor, values, best_score)


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
    # Interpolate the logit linearly between those of free and of occupied cells.
    ends = np.array([values["stop_free"], values["stop_occupied"]])
    low, high = np.log(ends) - np.log1p(-ends)
    between = 1.0 / (1.0 + np.exp(-(low + (high - low) * np.nan_to_num(occupancy))))
    return np.where(np.isnan(occupancy), values["stop_unknown"], between)


def fit_external_map(
    name: str, occupancy: Floats, grid: Grid, train: Scans, on_progress: OnShare = ignore_share
) -> FittedBaseline:
    """Fit a sensor to an external map, and the stop probabilities of its occupied, free and unknown cells.
    ``occupancy`` holds probabilities, (nx, ny), NaN where unknown. Poses of the scans ``train`` are in the map's frame.
    Raises `BadInput` for another shape, values outside [0, 1], or scans without a pose on the map.
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

    def stop(hits: Floats, passes: Floats, fitted: Mapping[str, float]) -> Floats:  # counts are not used
        return stop_probabilities(values.ravel(), fitted)

    baseline = Baseline(name, stop, EXTERNAL, EXTERNAL_STARTS)
    return fit_baseline(baseline, train, grid, one_fold(train, grid), on_progress)
