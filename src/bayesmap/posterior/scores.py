"""Scores of predictions on held-out scans: likelihood, calibration and sharpness, with errors that respect scans.

After Gneiting, Balabdaoui and Raftery, *Probabilistic forecasts, calibration and sharpness* (JRSS B, 2007). If readings
follow the predictive law, then the probability integral transform

    u = P(reading < z) + v P(reading = z),    v uniform on (0, 1),

is uniform. The randomisation v spreads the atoms at "no return" and "too close" over their probability (Czado, Gneiting
and Held, Biometrics 2009). A central interval of probability p contains the reading if ``|u - 1/2| <= p / 2``.

Beams of one scan share the error of its pose, so standard errors come from a bootstrap whose blocks are whole scans
(`ScanBlocks`). `score_prediction` computes a `Score`, and `compare_scores` compares two.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.prediction import OnShare, Predictor, ignore_share, report_batches, split_progress
from bayesmap.sensors.model import RangeLimits, describe
from bayesmap.space.arrays import Floats, Indices, Mask
from bayesmap.space.scans import ReadingKind, Scans

REPLICATES = 1000  # replicates of the bootstrap: standard errors are then accurate to about 2 %
INTERVALS = 100  # intervals of u at whose ends its distribution is compared with the uniform one
LEVELS = (0.5, 0.8, 0.95)  # probabilities of central intervals
BINS = 20  # bins of the histogram of u
RELIABILITY_BINS = 10  # bins of the probabilities of events
PIT_KEY, BOOTSTRAP_KEY = 0x917, 0xB00  # keys of the random numbers v and of the bootstrap, with the seed
MIX_TIME, QUANTILES_TIME, EVENTS_TIME = 0.5, 12.0, 6.0  # computing times relative to the forecast of one draw


def randomised_pit(low: Floats, high: Floats, seed: int = 0) -> Floats:
    """Draw the probability integral transform, (B,), between P(reading < z), ``low``, and P(reading <= z), ``high``."""
    return low + np.random.default_rng([seed, PIT_KEY]).random(low.shape) * (high - low)


def pit_histogram(pit: Floats, bins: int) -> Floats:
    """Return the share of the transforms in each of ``bins`` equal bins: 1 / bins each if the predictions are right."""
    return np.asarray(np.histogram(pit, bins=bins, range=(0.0, 1.0))[0] / max(len(pit), 1))


def inside(pit: Floats, level: float) -> Mask:
    """Return the mask of the readings that lie in their central intervals of probability ``level``, (B,)."""
    return np.abs(pit - 0.5) <= 0.5 * level


def binary_scores(p: Floats, happened: Mask) -> tuple[Floats, Floats]:
    """Compute each event's Brier score ``(p - y)^2`` and log loss ``-log p`` or ``-log(1 - p)``, (n,) each."""
    brier = (p - happened) ** 2
    with np.errstate(divide="ignore"):
        loss = -np.where(happened, np.log(p), np.log1p(-p))
    return brier, loss


@dataclass(frozen=True)
class MeanAndError:
    """A mean and its standard error."""

    value: float
    error: float

    def as_json(self) -> dict[str, float | None]:
        """Return value and error, None where not finite."""
        return _numbers(value=self.value, error=self.error)


@dataclass(frozen=True, eq=False)
class ScanBlocks:
    """A bootstrap of n items in S blocks, the scans: the block of each item, and R replicates of the blocks."""

    block: Indices  # block of each item, in [0, S), (n,)
    weights: Floats  # number of times that each replicate draws each block, (R, S)

    @classmethod
    def make(cls, block: Indices, seed: int = 0, replicates: int = REPLICATES) -> "ScanBlocks":
        """Draw the replicates: each draws S of the S blocks, with replacement. ``block`` may skip numbers."""
        _, compact = np.unique(block, return_inverse=True)
        n_blocks = int(compact.max()) + 1 if len(compact) else 1
        rng = np.random.default_rng([seed, BOOTSTRAP_KEY])
        weights = rng.multinomial(n_blocks, np.full(n_blocks, 1.0 / n_blocks), size=replicates)
        return cls(compact, weights.astype(np.float64))

    def sums(self, values: Floats) -> Floats:
        """Return the sum of the values in each block, (S,)."""
        return np.bincount(self.block, values, minlength=self.weights.shape[1]).astype(np.float64)

    def mean(self, values: Floats) -> MeanAndError:
        """Return the mean of all items. Its error is the standard deviation over replicates, NaN with one block."""
        if self.weights.shape[1] < 2:
            return MeanAndError(float(values.mean()), float("nan"))
        means = (self.weights @ self.sums(values)) / (self.weights @ self.sums(np.ones(len(values))))
        return MeanAndError(float(values.mean()), float(means.std()))

    def uniformity(self, pit: Floats) -> tuple[float, float]:
        """Return the Kolmogorov-Smirnov distance of the distribution of u from the uniform one, and its p-value.
        The distance is computed at the ends of `INTERVALS` intervals. The p-value is the share of replicates whose
        distance from the distribution of all items is at least as large, NaN with a single block.
        """
        n_blocks = self.weights.shape[1]
        interval = np.clip(np.ceil(pit * INTERVALS).astype(np.intp) - 1, 0, INTERVALS - 1)
        counts = np.bincount(self.block * INTERVALS + interval, minlength=n_blocks * INTERVALS)
        cumulative = np.cumsum(counts.reshape(n_blocks, INTERVALS), axis=1)
        total = cumulative.sum(axis=0)
        distribution = total[:-1] / total[-1]
        distance = float(np.abs(distribution - np.arange(1, INTERVALS) / INTERVALS).max())
        if n_blocks < 2:
            return distance, float("nan")
        # Compare each replicate's distribution with that of all items.
        replicates = self.weights @ cumulative
        distances = np.abs(replicates[:, :-1] / replicates[:, -1:] - distribution).max(axis=1)
        return distance, float((distances >= distance).mean())


def reliability(p: Floats, happened: Mask) -> list[tuple[float, float, int]]:
    """Group events by probability. Returns (mean probability, share that happened, count) for each non-empty bin."""
    # First hits are mostly improbable: one bin lies below 0.001, and the others have equal widths in log10 up to 1.
    edges = np.concatenate([[0.0], np.logspace(-3, 0, RELIABILITY_BINS)])
    bin_of_event = np.clip(np.searchsorted(edges, p, side="left") - 1, 0, RELIABILITY_BINS - 1)
    counts, sums, n_happened = (np.bincount(bin_of_event, x, minlength=RELIABILITY_BINS) for x in (None, p, happened))
    return [(float(total / n), float(k / n), int(n)) for total, k, n in zip(sums, n_happened, counts, strict=True) if n]


def beam_log_scores(
    predictor: Predictor, scans: Scans, on_progress: Callable[[int, int], None] = lambda done, total: None,
    device: str = "cpu",
) -> Floats:  # fmt: skip
    """Compute the log predictive density of every reading, log mean over draws of p(reading | draw), (B,).
    Densities are per metre for hits, probabilities for typed readings, in nats; NaN where a reading is invalid. They
    equal `Score.by_beam` bit for bit. Raises `BadInput` without a valid reading or a draw.
    """
    from bayesmap.kernels.predict.density import explained_within_m, log_densities
    from bayesmap.kernels.rays import trace_rays

    if not (scans.readings != ReadingKind.INVALID).any():
        raise BadInput("score: none of the scans has a valid reading")
    sensor, limits = predictor.sensor, RangeLimits(scans.min_range_m, scans.max_range_m)
    reach_m = explained_within_m(scans.ranges_m.ravel(), sensor, limits, predictor.grid.resolution)
    rays = trace_rays(scans, predictor.grid, reach_m=reach_m, device=device)
    n_draws = predictor.draws
    batches = predictor.batches(rays.touched)
    reported = report_batches(batches, n_draws, lambda share: on_progress(round(share * n_draws), n_draws))
    return log_densities(rays, reported, sensor, predictor.hit_depth, device=device)


@dataclass(frozen=True)
class Coverage:
    """The share of readings in central intervals of one probability, and the width of these intervals."""

    level: float  # probability of the intervals
    share: MeanAndError  # share of readings inside; typed readings are randomised
    mean_width_m: float  # an end at "no return" counts as the largest range, at "too close" as the least
    median_width_m: float


@dataclass(frozen=True, eq=False)
class Score:
    """The score of a prediction on held-out beams. Errors are standard errors from a bootstrap over scans.

    Attributes:
        scans, beams: numbers of scored scans and beams, without invalid readings.
        nats_per_beam: mean log predictive density of a reading: nats per metre for ranges, nats for typed readings.
        nats_per_beam_error: standard error of ``nats_per_beam``.
        coverage: coverage of central intervals at 50, 80 and 95 %.
        pit: probability integral transform of each valid reading, (beams,): uniform if the predictions are right.
        by_beam: log predictive density of each valid reading, nats, (beams,); `bayesmap.compare_scores` compares them.
        scan_of_beam, reading_m: scan and reading of each beam, (beams,).
        pit_histogram: share of ``pit`` in each of 20 bins.
        pit_distance, pit_p_value: result of `ScanBlocks.uniformity` for ``pit``.
        events: number of first-hit events: chords of beams in cells that readings reached.
        brier, log_loss: mean over events of the two scores of "does the reading end here?". Lower is better.
        reliability: groups of events by predicted probability: (its mean, share that happened, count).
        p_no_return: mean predicted probability of no return, and observed share.
        sensor: description of the prediction's sensor model.
        hit_depth: depth of a stop in a plain cell, as a fraction of the beam's chord.
    """

    scans: int
    beams: int
    nats_per_beam: float
    nats_per_beam_error: float
    coverage: tuple[Coverage, ...]
    pit: NDArray[np.float64] = field(repr=False)
    by_beam: NDArray[np.float64] = field(repr=False)
    scan_of_beam: Indices = field(repr=False)
    reading_m: NDArray[np.float64] = field(repr=False)
    pit_histogram: tuple[float, ...]
    pit_distance: float
    pit_p_value: float
    events: int
    brier: MeanAndError
    log_loss: MeanAndError
    reliability: tuple[tuple[float, float, int], ...] = field(repr=False)
    p_no_return: tuple[float, float]
    sensor: dict[str, Any]
    hit_depth: float

    def __repr__(self) -> str:
        """Return five lines: size, log density, coverage, calibration and events. `as_json` has all figures."""
        coverage = ", ".join(f"{c.share.value:.1%} in {c.level:.0%}" for c in self.coverage)
        return (
            f"Score: {self.scans:,} scans, {self.beams:,} beams\n"
            f"  log density: {self.nats_per_beam:.3f} +- {self.nats_per_beam_error:.3f} nats per beam\n"
            f"  coverage of central intervals: {coverage}\n"
            f"  distance of u from uniform: {self.pit_distance:.3f}, p = {self.pit_p_value:.2g}\n"
            f"  Brier score: {self.brier.value:.4f} +- {self.brier.error:.4f}, over {self.events:,} events"
        )

    def as_json(self) -> dict[str, Any]:
        """Return all fields except those of single beams as JSON values."""
        predicted, observed = self.p_no_return
        return {
            "scans": self.scans, "beams": self.beams,
            **_numbers(nats_per_beam=self.nats_per_beam, nats_per_beam_error=self.nats_per_beam_error),
            "coverage": [
                {"level": c.level, **c.share.as_json()}
                | _numbers(mean_width_m=c.mean_width_m, median_width_m=c.median_width_m)
                for c in self.coverage
            ],
            "pit_histogram": [round(x, 6) for x in self.pit_histogram],
            **_numbers(pit_distance=self.pit_distance, pit_p_value=self.pit_p_value),
            "events": self.events, "brier": self.brier.as_json(), "log_loss": self.log_loss.as_json(),
            "reliability": [
                {"predicted": p, "observed": share, "events": count} for p, share, count in self.reliability
            ],
            "no_return": _numbers(predicted=predicted, observed=observed), "sensor": self.sensor,
            "hit_depth": self.hit_depth,
        }  # fmt: skip


def _numbers(**values: float) -> dict[str, float | None]:
    """Return numbers as JSON values: None if not finite."""
    return {name: float(value) if math.isfinite(value) else None for name, value in values.items()}


def score_prediction(
    predictor: Predictor, scans: Scans, *, seed: int = 0, device: str = "cpu", on_progress: OnShare = ignore_share
) -> Score:
    """Score a prediction on scans that had no part in it. Raises `BadInput` without a valid reading or a draw."""
    from bayesmap.kernels.predict.density import forecast
    from bayesmap.kernels.predict.stop_mixture import first_hit_events, mix_stops, range_quantiles
    from bayesmap.kernels.rays import trace_rays

    valid = (scans.readings != ReadingKind.INVALID).ravel()
    if not valid.any():
        raise BadInput("score: none of the scans has a valid reading")
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    sensor, range_m = predictor.sensor, scans.ranges_m.ravel()
    rays = trace_rays(scans, predictor.grid, device=device)
    # Predict: density and transform of each reading, quantiles of its distribution, and probabilities of first hits.
    depth, n_draws = predictor.hit_depth, predictor.draws
    times = (n_draws, MIX_TIME * n_draws, QUANTILES_TIME, EVENTS_TIME)
    on_forecast, on_mix, on_quantiles, on_events = split_progress(on_progress, *times)
    batches = report_batches(predictor.batches(rays.touched), n_draws, on_forecast)
    prediction = forecast(rays, batches, sensor, depth, device=device)
    law = mix_stops(rays, report_batches(predictor.batches(rays.touched), n_draws, on_mix), depth, device=device)
    # Quantiles at the ends of the intervals of all levels.
    ends = np.array(sorted({0.5 - side * 0.5 * level for level in LEVELS for side in (1, -1)}))
    quantiles_m = np.clip(range_quantiles(law, ends, sensor, device)[valid], limits.min_m, limits.max_m)
    on_quantiles(1.0)
    p_first_hit, stopped = first_hit_events(law, sensor, device)
    on_events(1.0)
    # Score the valid readings, with a bootstrap over scans.
    scan = np.repeat(np.arange(len(scans)), len(scans.angles_rad))
    blocks = ScanBlocks.make(scan[valid], seed)
    nats = blocks.mean(prediction.log_density[valid])
    pit = randomised_pit(prediction.pit_low[valid], prediction.pit_high[valid], seed)
    distance, p_value = blocks.uniformity(pit)
    event = stopped >= 0
    happened, p = stopped[event] == 1, p_first_hit[event].astype(np.float64)
    brier, loss = binary_scores(p, happened)
    event_blocks = ScanBlocks.make(np.repeat(scan, rays.lengths)[event], seed)
    no_events = MeanAndError(float("nan"), float("nan"))
    return Score(
        scans=len(np.unique(scan[valid])), beams=int(valid.sum()), nats_per_beam=nats.value,
        nats_per_beam_error=nats.error, coverage=_coverage(pit, ends, quantiles_m, blocks), pit=pit,
        by_beam=prediction.log_density[valid], scan_of_beam=scan[valid], reading_m=range_m[valid],
        pit_histogram=tuple(pit_histogram(pit, BINS).tolist()), pit_distance=distance, pit_p_value=p_value,
        events=len(p), brier=event_blocks.mean(brier) if len(p) else no_events,
        log_loss=event_blocks.mean(loss) if len(p) else no_events, reliability=tuple(reliability(p, happened)),
        p_no_return=(float(prediction.p_no_return[valid].mean()), float(np.isposinf(range_m[valid]).mean())),
        sensor=describe(sensor), hit_depth=predictor.hit_depth,
    )  # fmt: skip


def _coverage(pit: Floats, ends: Floats, quantiles_m: Floats, blocks: ScanBlocks) -> tuple[Coverage, ...]:
    """Return the coverage of the central intervals, given the quantiles at their ends, (B, number of ends)."""
    coverage = []
    for level in LEVELS:
        low_index, high_index = (np.argmin(np.abs(ends - end)) for end in (0.5 - level / 2, 0.5 + level / 2))
        width_m = quantiles_m[:, high_index] - quantiles_m[:, low_index]
        share = blocks.mean(inside(pit, level).astype(np.float64))
        coverage.append(Coverage(level, share, float(width_m.mean()), float(np.median(width_m))))
    return tuple(coverage)


@dataclass(frozen=True)
class ScoreDifference:
    """The difference of two scores on the same beams: the first minus the second.

    Attributes:
        nats_per_beam: mean difference of the log predictive densities; positive if the first predicts better.
        error: its standard error, from a bootstrap over scans of the paired differences.
        beams, scans: numbers of compared beams and scans.
    """

    nats_per_beam: float
    error: float
    beams: int
    scans: int

    def __repr__(self) -> str:
        """Return two lines: the difference, and its meaning."""
        verdict = "neither predicts better by two standard errors"
        if abs(self.nats_per_beam) > 2 * self.error:
            verdict = f"the {'first' if self.nats_per_beam > 0 else 'second'} predicts better"
        return (
            f"ScoreDifference: {self.nats_per_beam:+.4f} +- {self.error:.4f} nats per beam, first minus second\n"
            f"  {self.beams:,} beams of {self.scans:,} scans: {verdict}"
        )


def compare_scores(first: Score, second: Score, *, seed: int = 0) -> ScoreDifference:
    """Compare two scores on the same held-out beams, by the mean difference with its paired standard error.
    Both models find the same beams hard, so the error of the difference is mostly far below that of either score.
    ``seed`` is that of the bootstrap over scans. Raises `BadInput` for scores of different beams.
    """
    for name in ("scan_of_beam", "reading_m"):
        if not np.array_equal(getattr(first, name), getattr(second, name)):
            raise BadInput("compare_scores: the scores are of different beams; score both runs on the same scans")
    gain = ScanBlocks.make(first.scan_of_beam, seed).mean(first.by_beam - second.by_beam)
    return ScoreDifference(gain.value, gain.error, first.beams, first.scans)
