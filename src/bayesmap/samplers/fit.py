"""Fit the sensor and the prior to the scans, by a pilot chain: stochastic expectation maximisation.

The pilot is a short chain with a chain number of its own, which ends before the other chains begin. So the parameters
depend on the seed and on the number of the pilot's sweeps, but not on the number of chains. In the first sweeps
parameters move all the way to the new estimate, later a shrinking share of the way (Delyon, Lavielle and Moulines,
1999).

Sensor and Beta prior. After each sweep, the drawn stops give the distance of each reading from its surface. The
expectation step splits the readings into returns of walls, passing objects and random readings. The maximisation step
is in closed form except for the noise and the Beta.

Noise. Real readings can scatter more than a normal law allows, so the noise may be Student's t, a mixture of normal
laws of all scales.

Coupling of an Ising prior. Each sweep of the pilot gives a whole map, with cells that no beam observes. The coupling
moves towards the maximum of the pseudo-likelihood for this map (`bayesmap.cells.binary`). It converges where the
posterior mean of the pseudo-likelihood's slope is zero. Unknown poses are fixed at the poses of the log.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
import scipy
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells.binary import Ising, counts, likeliest
from bayesmap.cells.kind import CellPrior, Floats
from bayesmap.cells.kinds import prior_from
from bayesmap.cells.reflectivity import Beta
from bayesmap.model import Model
from bayesmap.samplers.progress import SILENT, Watch
from bayesmap.samplers.sampler import PILOT, Info, Keep
from bayesmap.samplers.stop_gibbs import StopGibbs, StopState
from bayesmap.samplers.stop_problem import StopProblem, trace_stops
from bayesmap.samplers.walls import WallSampler
from bayesmap.sensors.builtin import AdditiveNoise, BeamMixture, Gaussian, describe, from_description, noise_with
from bayesmap.sensors.model import RangeLimits

SHAPES = (3.0, 5.0, 9.0, 17.0, math.inf)  # degrees of freedom to try; odd numbers need no logarithm in kernels
LEAST_SCALE_M = 1e-3
LEAST_GROWTH = 1e-6  # metres per metre
FIRST_STEP, CLOSE = 0.1, 1e-3  # first step and final accuracy of the search, in logarithms of the noise's parameters
LEAST_WEIGHT = 10.0  # least number of readings, summed by weight, that changes the noise


@dataclass(frozen=True, eq=False)
class StopResiduals:
    """Readings of beams that were stopped, (N,) each."""

    residual_m: Floats  # reading minus distance of the stop
    distance_m: Floats  # distance of the stop
    variance: Floats  # variance of the stop along the beam, square metres, added to that of the noise
    weight: Floats  # probability that the reading returned from the stop

    def cost(self, dof: float, scale_m: float, per_m: float) -> float:
        """Return the mean negative log density of noise of scale sqrt((scale_m + per_m distance)^2 + variance)."""
        scale = np.sqrt((scale_m + per_m * self.distance_m) ** 2 + self.variance)
        log_density = noise_with(dof, 1.0, 0.0).log_density(self.residual_m / scale) - np.log(scale)
        return float(-(self.weight * log_density).sum() / self.weight.sum())

    def likeliest(self, dof: float, scale_m: float, per_m: float) -> tuple[float, Floats]:
        """Minimise the cost over scale and growth, from these values. Returns the cost, and the logarithms of both."""
        first = np.log([scale_m, max(per_m, 1e-5)])
        result = scipy.optimize.minimize(
            lambda logs: self.cost(dof, *np.exp(logs)),
            first,
            method="Nelder-Mead",  # as fast as any with two numbers, and without threads of linear algebra
            bounds=[(math.log(LEAST_SCALE_M), math.log(10.0)), (math.log(LEAST_GROWTH), 0.0)],
            options={"initial_simplex": first + FIRST_STEP * np.eye(3, 2, -1), "xatol": CLOSE, "fatol": CLOSE**2},
        )
        return float(result.fun), result.x


def refit_noise(noise: AdditiveNoise, residuals: StopResiduals, step: float) -> AdditiveNoise:
    """Move a noise by the share ``step`` of the way to the likeliest. A whole step may also move its degrees of freedom
    to a neighbouring value of `SHAPES`.
    """
    readings = residuals.weight.sum()
    if readings < LEAST_WEIGHT:
        return noise
    numbers = noise.kernel_parameters()
    assert numbers is not None
    dof, scale_m, per_m = numbers.dof or math.inf, numbers.sigma_m, numbers.sigma_per_m
    index = SHAPES.index(dof)
    tried = SHAPES[max(index - 1, 0) : index + 2] if step == 1.0 else (dof,)
    costs = {shape: residuals.likeliest(shape, scale_m, per_m) for shape in tried}
    a_number_more = 0.5 * math.log(readings) / readings  # cost of the parameter dof (Schwarz 1978)
    best = min(tried, key=lambda shape: costs[shape][0] + (a_number_more if shape < math.inf else 0.0))
    present = np.log([scale_m, max(per_m, LEAST_GROWTH)])
    return noise_with(best, *np.exp((1 - step) * present + step * costs[best][1]).tolist())


BEAMS_LOOKED_AT = 40_000  # beams used in each sweep, at most about
PILOT_SWEEPS = 40  # most sweeps of the pilot of reflectivities and surfaces; a short warm-up has a shorter pilot
SENSOR_SWEEPS = 30  # sweeps of the pilot that fits a sensor alone
SPREAD_WITHOUT_SURFACE = 0.3  # standard deviation of stops in cells without surfaces, in edges, with which a fit starts
FIRST_SWEEP, WHOLE_UNTIL = 3, 20  # the first sweep that moves parameters, and the last that moves them all the way
PRIOR_EVERY = 2  # sweeps from one move of the prior to the next
LEAST_SHARE = 1e-5
LEAST_RANDOM = 5e-4  # least share of random readings: a map of few scans may explain all theirs, but not new ones
PSEUDO_BEAMS = 2.0  # weight of a share's present value, in beams: it stays positive if a log has no such readings


@dataclass(frozen=True)
class Parameters:
    """The sensor and the prior that are fitted."""

    sensor: BeamMixture
    prior: Beta

    def describe(self) -> dict[str, Any]:
        """Return both as plain JSON values."""
        return {"sensor": describe(self.sensor), "prior": self.prior.describe()}

    @classmethod
    def from_description(cls, values: dict[str, Any]) -> Parameters:
        """Return the parameters of a description."""
        sensor = from_description(values["sensor"])
        assert isinstance(sensor, BeamMixture)
        return cls(sensor, Beta.of(prior_from(values["prior"]), "fitted parameters"))


@dataclass(frozen=True, eq=False)
class DrawnStops:
    """Stops of some beams of all chains."""

    range_m: Floats  # readings
    stopped: NDArray[np.bool_]  # whether the beam stopped
    distance_m: Floats  # distance of the stop
    variance: Floats  # variance of this distance, square metres


def first_sensor(prior: CellPrior, resolution_m: float) -> BeamMixture:
    """Return the sensor with which a fit starts: a laser with few outliers."""
    sigma_m = 0.02 if prior.has_surfaces else math.hypot(0.02, SPREAD_WITHOUT_SURFACE * resolution_m)
    return BeamMixture(Gaussian(sigma_m, 0.003), p_random=0.02, p_no_return=0.01, p_short=0.02)


def fit(problem: StopProblem, seed: int, sweeps: int, watch: Watch = SILENT) -> Parameters:
    """Fit sensor and prior to the scans of a problem, starting from the problem's, by ``sweeps`` sweeps of the pilot.
    The watch gets progress after each sweep; a stop ends the pilot, and with it the run.
    """
    assert isinstance(problem.sensor, BeamMixture)
    fitted = Parameters(problem.sensor, problem.prior)
    for parameters, _ in pilot_sweeps(problem, seed, sweeps, watch):
        fitted = parameters
        if watch.should_stop():
            break
    return fitted


def pilot_sweeps(
    problem: StopProblem, seed: int, sweeps: int, watch: Watch = SILENT, keep: Keep = Keep()
) -> Iterator[tuple[Parameters, Info]]:
    """Run the pilot. Yields the parameters after each sweep, and the sweep's report with its draw, if kept."""
    if sweeps == 0:
        return
    assert isinstance(problem.sensor, BeamMixture)
    sampler, sensor, prior = StopGibbs(), problem.sensor, problem.prior
    state = sampler.init(problem, [PILOT], seed)
    every = max(1, math.ceil(problem.rays.n_beams / BEAMS_LOOKED_AT))
    beams = slice(every // 2, None, every)
    for sweep in range(sweeps):
        state, info = sampler.step(state, 1, keep=keep)
        if sweep >= FIRST_SWEEP:
            step = step_share(sweep)
            sensor = refit_sensor(sensor, stops_of(state, beams), problem.rays.limits, step)
            if sweep % PRIOR_EVERY == 0:
                touched = problem.estimate.touched
                hits, met = (count[touched] for count in state.chains.counted(0))
                solid = state.chains.solid(0)[touched] if prior.has_labels else None
                prior = refit_prior(prior, hits, met, step, solid)
            state = replace(state, problem=problem.under(sensor, prior))
        watch.report("fit", sweep + 1, sweeps, float(info.log_likelihood[0, -1] + info.log_prior[0, -1]))
        yield Parameters(sensor, prior), info


def fit_sensor(
    model: Model, device: str, *, seed: int, threads: int | None = None, watch: Watch = SILENT
) -> BeamMixture:
    """Fit the sensor to the model's scans by a pilot over reflectivities. Raises BadInput: too many incidences."""
    prior = Beta()
    sensor = first_sensor(prior, model.grid.resolution)
    problem = trace_stops(
        model.scans, model.grid, prior, sensor, hit_depth=model.hit_depth, device=device, threads=threads
    )
    return fit(problem, seed, SENSOR_SWEEPS, watch).sensor


def stops_of(state: StopState, beams: slice) -> DrawnStops:
    """Return the stops of the given beams in the last sweep, all chains together."""
    each = [state.chains.stops(chain) for chain in range(state.chains.n_chains)]
    stopped, distance_m, variance = (np.concatenate([p[beams] for p in parts]) for parts in zip(*each, strict=True))
    range_m = np.tile(state.problem.rays.range_m[beams], len(each))
    return DrawnStops(range_m, stopped, distance_m.astype(np.float64), variance.astype(np.float64))


def step_share(sweep: int, whole_until: int = WHOLE_UNTIL) -> float:
    """Return the share of the way that parameters move after a sweep: 1 until ``whole_until``, then decreasing."""
    return 1.0 if sweep < whole_until else float((sweep - whole_until + 1.0) ** -0.7)


def refit_sensor(sensor: BeamMixture, stops: DrawnStops, limits: RangeLimits, step: float) -> BeamMixture:
    """Move the sensor's parameters towards those that make the readings likeliest, given the stops."""
    z, hit = stops.range_m, np.isfinite(stops.range_m)
    wall = hit & stops.stopped
    silent = np.isposinf(z)
    known, rate = 1.0 - sensor.p_random, sensor.rate_short_per_m

    # Expectation: probabilities that a reading is random, a passing object, or a return of the wall.
    t = np.where(stops.stopped, np.minimum(stops.distance_m, limits.max_m), limits.max_m)
    anything = np.where(hit, sensor.p_random / (limits.max_m - limits.min_m), 0.0)
    reading = np.where(hit, z, 0.0)
    passing = np.where(
        hit & (reading < t), known * sensor.p_short * rate * np.exp(-rate * np.maximum(reading, 0.0)), 0.0
    )
    scale = np.sqrt(sensor.noise.scale_at(t) ** 2 + stops.variance)
    standard = np.where(wall, reading - t, 0.0) / scale
    unblocked = sensor.unblocked(t)
    returned = np.where(
        wall, known * unblocked * (1 - sensor.p_no_return) * np.exp(sensor.noise.log_density(standard)) / scale, 0.0
    )
    total = np.where(hit, anything + passing + returned, 1.0)
    by_chance, by_object, by_wall = anything / total, passing / total, returned / total

    # Maximisation.
    valid = float((hit | silent).sum())
    p_random = _share(by_chance.sum(), valid, sensor.p_random)
    # A stop within range without a return was missed, or its reading lay out of range.
    reached = stops.stopped & (stops.distance_m <= limits.max_m)
    out_of_range = (1.0 - sensor.p_no_return) * sensor.noise.tail((limits.max_m - t) / scale)
    share_missed = sensor.p_no_return / np.maximum(sensor.p_no_return + out_of_range, LEAST_SHARE)
    missing = float((silent & reached) @ share_missed)
    p_no_return = _share(missing, missing + by_wall.sum(), sensor.p_no_return)
    # Passing objects may also be behind the end of the beam, unobserved.
    free = np.where(hit, by_wall, silent * 1.0)
    behind = free * sensor.p_short * np.exp(-rate * t) / unblocked
    # Objects too close to be measured are unobserved as well: this many per object further away.
    too_close = math.expm1(rate * limits.min_m)
    seen, further = by_object.sum(), by_object.sum() + behind.sum()
    objects = further * (1.0 + too_close)
    p_short = _share(objects, seen + further * too_close + free.sum(), sensor.p_short)
    metres = (by_object * reading).sum() + (behind * (t + 1.0 / rate)).sum()
    metres += further * (too_close / rate - limits.min_m)
    rate_new = (objects + PSEUDO_BEAMS) / (metres + PSEUDO_BEAMS / rate)
    residuals = StopResiduals(reading[wall] - t[wall], t[wall], stops.variance[wall], by_wall[wall])

    def moved(old: float, new: float) -> float:
        return float(math.exp((1 - step) * math.log(old) + step * math.log(new)))

    return BeamMixture(
        noise=refit_noise(sensor.noise, residuals, step),
        p_random=max(moved(sensor.p_random, p_random), LEAST_RANDOM),
        p_no_return=moved(max(sensor.p_no_return, LEAST_SHARE), p_no_return),
        p_short=moved(max(sensor.p_short, LEAST_SHARE), p_short),
        rate_short_per_m=moved(rate, rate_new),
    )


def _share(part: float, whole: float, present: float) -> float:
    """Estimate a share, drawn a little towards its present value."""
    share = (part + PSEUDO_BEAMS * present) / (whole + PSEUDO_BEAMS)
    return float(min(max(share, LEAST_SHARE), 0.5))


def refit_prior(
    prior: Beta, hits: NDArray[np.int32], met: NDArray[np.int32], step: float,
    solid: NDArray[np.bool_] | None = None,
) -> Beta:  # fmt: skip
    """Move the Beta's counts towards those that make hits and passes likeliest, reflectivities integrated out, in each
    label's cells. Cells with negative ``met`` have not counted yet and are left out.
    """
    counted = met >= 0
    if solid is None:
        a, b = _likeliest_beta(prior.a, prior.b, hits[counted], met[counted], step)
        return replace(prior, a=a, b=b)
    free, full = counted & ~solid, counted & solid
    a, b = _likeliest_beta(prior.a, prior.b, hits[free], met[free], step)
    a_solid, b_solid = _likeliest_beta(prior.a_solid, prior.b_solid, hits[full], met[full], step)
    return replace(prior, a=a, b=b, a_solid=a_solid, b_solid=b_solid)


def _likeliest_beta(
    a: float, b: float, hits: NDArray[np.int32], met: NDArray[np.int32], step: float
) -> tuple[float, float]:
    """Move a Beta's counts towards those that make hits and passes likeliest; without counts they stay."""
    if not len(hits):
        return a, b
    # Both counts as one integer: a hundred times as fast as searching equal pairs.
    base = int(met.max()) + 1
    pairs, times = np.unique(hits.astype(np.int64) * base + met, return_counts=True)
    h, p = (part.astype(np.float64) for part in np.divmod(pairs, base))

    def cost(logs: Floats) -> float:
        a, b = np.exp(logs)
        terms = special.betaln(a + h, b + p) - special.betaln(a, b)
        return float(-(times * terms).sum() / times.sum())

    first = np.log([a, b])
    bounds = [(math.log(1e-4), math.log(10.0)), (math.log(1e-3), math.log(100.0))]
    result = scipy.optimize.minimize(cost, first, method="L-BFGS-B", bounds=bounds)
    a, b = np.exp((1 - step) * first + step * result.x)
    return float(a), float(b)


COUPLING_SWEEPS = 100
COUPLING_WHOLE_UNTIL = 40  # the last sweep in which the coupling moves all the way
FIRST_COUPLING = 0.5  # start of the pilot; at 0.88 and p = 0.5, whole regions become alike


def fit_coupling_to_scans(
    model: Model, sampler: WallSampler, device: str, *, seed: int, threads: int | None = None, watch: Watch = SILENT
) -> Ising:
    """Return the `Ising` prior of a model with the coupling that suits its scans; its wall probability stays. The watch
    gets progress after each sweep of the pilot; a stop ends the pilot, and with it the run.
    """
    prior = replace(cast(Ising, model.cells), coupling=FIRST_COUPLING)
    problem = sampler.prepare(replace(model, cells=prior), device, threads, watch)
    state = sampler.init(problem, [PILOT], seed, watch=watch)
    for sweep in range(COUPLING_SWEEPS):
        state, info = sampler.step(state, 1)
        walls = state.walls().reshape(problem.grid.shape) != 0
        best = likeliest(*counts(walls, np.asarray(prior.p_wall, dtype=np.float64)))
        step = step_share(sweep, COUPLING_WHOLE_UNTIL)
        prior = replace(prior, coupling=prior.pair_coupling + step * (best - prior.pair_coupling))
        state = replace(state, problem=state.problem.under(prior))
        watch.report("fit", sweep + 1, COUPLING_SWEEPS, float(info.log_likelihood[0, -1] + info.log_prior[0, -1]))
        if watch.should_stop():
            break
    return prior
