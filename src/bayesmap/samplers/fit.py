"""Fit the sensor and the prior to the scans by a pilot chain: stochastic approximation EM.

The likeliest parameters depend on the map, which is unknown. So a pilot chain draws maps and stops of beams. After each
sweep, the expectation step splits the readings into returns of walls, passing objects and random readings, given the
drawn stops. The maximisation step moves the parameters to the new estimate, after the first sweeps a shrinking share of
the way (Delyon, Lavielle and Moulines, 1999). docs/surfaces.md (Fitting) and docs/inference.md describe the fits.

`pilot_sweeps` is the loop; then follow `refit_sensor`, `refit_noise` and `refit_prior`. `fit_coupling_to_scans` fits an
Ising prior of binary walls by the pseudo-likelihood of the drawn maps. The pilot has a chain number of its own and ends
before other chains begin, so the parameters do not depend on the number of chains. Poses stay at the log's.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
import scipy
from scipy import special

from bayesmap.cells.binary import Ising, count_by_balance, maximise_pseudo_likelihood
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.kinds import prior_from
from bayesmap.cells.reflectivity import Beta
from bayesmap.model import Model
from bayesmap.samplers.sampler import PILOT, SILENT, Info, Keep, Watch
from bayesmap.samplers.stop_gibbs import StopGibbs, StopState
from bayesmap.samplers.stop_problem import StopProblem, trace_stops
from bayesmap.samplers.walls import WallSampler
from bayesmap.sensors.model import AdditiveNoise, BeamMixture, RangeLimits, describe, from_description, noise_with
from bayesmap.space.arrays import Floats, Ints, Mask

PILOT_SWEEPS = 40  # most sweeps of the pilot of reflectivities and surfaces; a short warm-up has a shorter pilot
SENSOR_SWEEPS = 30  # sweeps of the pilot that fits a sensor alone
SPREAD_WITHOUT_SURFACE = 0.3  # standard deviation of stops in cells without surfaces, in edges, with which a fit starts
MAX_FIT_BEAMS = 40_000  # most beams used in each sweep, approximately
FIRST_FIT_SWEEP = 3  # the first sweep, counted from 0, that moves parameters
FULL_STEPS_UNTIL = 20  # the sweep until which parameters move all the way to their estimates
PRIOR_EVERY = 2  # sweeps from one move of the prior to the next
MIN_SHARE = 1e-5  # least estimate of a share
MIN_RANDOM = 5e-4  # least share of random readings: a map of few scans may explain all theirs, but not new ones
PSEUDO_BEAMS = 2.0  # weight of a share's present value, in beams: it stays positive if a log has no such readings
DOFS = (3.0, 5.0, 9.0, 17.0, math.inf)  # degrees of freedom to try; odd numbers need no logarithm in kernels
MIN_SCALE_M, MIN_GROWTH = 1e-3, 1e-6  # metres, and metres per metre
SIMPLEX_SIZE, TOLERANCE = 0.1, 1e-3  # first steps and accuracy of the search, in logarithms of the noise's parameters
MIN_WEIGHT = 10.0  # least number of readings, summed by weight, that changes the noise
COUPLING_SWEEPS, COUPLING_FULL_STEPS_UNTIL = 100, 40  # sweeps of the coupling's pilot, and those of whole steps
FIRST_COUPLING = 0.5  # start of the pilot; at 0.88 and p = 0.5, whole regions become alike


@dataclass(frozen=True)
class Parameters:
    """The sensor and the prior that are fitted."""

    sensor: BeamMixture
    prior: Beta

    def describe(self) -> dict[str, Any]:
        """Return both as plain JSON values."""
        return {"sensor": describe(self.sensor), "prior": self.prior.describe()}

    @classmethod
    def from_description(cls, values: dict[str, Any]) -> "Parameters":
        """Return the parameters of a description."""
        sensor = from_description(values["sensor"])
        assert isinstance(sensor, BeamMixture)  # only mixtures are fitted
        return cls(sensor, Beta.of(prior_from(values["prior"]), "fitted parameters"))


def initial_sensor(prior: CellPrior, resolution_m: float) -> BeamMixture:
    """Return the sensor with which a fit starts: a laser with few outliers."""
    sigma_m = 0.02 if prior.has_surfaces else math.hypot(0.02, SPREAD_WITHOUT_SURFACE * resolution_m)
    return BeamMixture(noise_with(math.inf, sigma_m, 0.003), p_random=0.02, p_no_return=0.01, p_short=0.02)


def fit(
    problem: StopProblem, seed: int, sweeps: int, watch: Watch = SILENT, begun: StopState | None = None
) -> Parameters:
    """Fit sensor and prior by ``sweeps`` pilot sweeps; ``begun`` has made up to `FIRST_FIT_SWEEP`. A stop ends all."""
    assert isinstance(problem.sensor, BeamMixture)  # `initial_sensor`'s
    fitted = Parameters(problem.sensor, problem.prior)
    for parameters, _ in pilot_sweeps(problem, seed, sweeps, watch, begun=begun):
        fitted = parameters
        if watch.should_stop():
            break
    return fitted


def fit_sensor(model: Model, device: str, *, seed: int, threads: int | None, watch: Watch = SILENT) -> BeamMixture:
    """Fit the sensor to the model's scans by a pilot over reflectivities. Raises `BadInput` as `trace_stops`."""
    scans, grid, depth, prior = model.scans, model.grid, model.hit_depth, Beta()
    sensor = initial_sensor(prior, grid.resolution)
    problem = trace_stops(scans, grid, prior, sensor, hit_depth=depth, device=device, threads=threads)
    return fit(problem, seed, SENSOR_SWEEPS, watch).sensor


def pilot_sweeps(
    problem: StopProblem, seed: int, sweeps: int, watch: Watch = SILENT, keep: Keep = Keep(),
    begun: StopState | None = None,
) -> Iterator[tuple[Parameters, Info]]:  # fmt: skip
    """Run the pilot, see `fit`. Yields the parameters after each sweep, and the sweep's report with a kept draw."""
    if sweeps == 0:
        return
    assert isinstance(problem.sensor, BeamMixture)  # `initial_sensor`'s
    sampler, sensor, prior = StopGibbs(), problem.sensor, problem.prior
    state = sampler.init(problem, [PILOT], seed) if begun is None else begun
    spacing = max(1, math.ceil(problem.rays.n_beams / MAX_FIT_BEAMS))
    beams = slice(spacing // 2, None, spacing)
    for sweep in range(state.sweep, sweeps):
        state, info = sampler.step(state, 1, keep=keep)
        if sweep >= FIRST_FIT_SWEEP:
            step_size = step_size_after(sweep)
            sensor = refit_sensor(sensor, select_stops(state, beams), problem.rays.limits, step_size)
            if sweep % PRIOR_EVERY == 0:
                touched = problem.estimate.touched
                hits, passes = (count[touched] for count in state.chains.hits_and_passes(0))
                solid = state.chains.solid(0)[touched] if prior.has_labels else None
                prior = refit_prior(prior, hits, passes, step_size, solid)
            state = replace(state, problem=problem.under(sensor, prior))
        watch.report("fit", sweep + 1, sweeps, float(info.log_likelihood[0, -1] + info.log_prior[0, -1]))
        yield Parameters(sensor, prior), info


def step_size_after(sweep: int, full_until: int = FULL_STEPS_UNTIL) -> float:
    """Return the share of the way that parameters move after a sweep: 1 until ``full_until``, then decreasing."""
    return 1.0 if sweep < full_until else float((sweep - full_until + 1.0) ** -0.7)  # Robbins and Monro


@dataclass(frozen=True, eq=False)
class DrawnStops:
    """Stops of N beams in the last sweep, those of all chains together, (N,) each."""

    range_m: Floats  # readings
    stopped: Mask  # whether the beam stopped
    distance_m: Floats  # distance of the stop
    variance: Floats  # variance of this distance, square metres


def select_stops(state: StopState, beams: slice) -> DrawnStops:
    """Return the drawn stops of the selected beams."""
    stops_by_chain = [state.chains.stops(chain) for chain in range(state.chains.n_chains)]
    fields = ([values[beams] for values in chains] for chains in zip(*stops_by_chain, strict=True))
    stopped, distance_m, variance = map(np.concatenate, fields)
    range_m = np.tile(state.problem.rays.range_m[beams], len(stops_by_chain))
    return DrawnStops(range_m, stopped, distance_m.astype(np.float64), variance.astype(np.float64))


def refit_sensor(sensor: BeamMixture, stops: DrawnStops, limits: RangeLimits, step_size: float) -> BeamMixture:
    """Move the sensor by the share ``step_size`` of the way to the likeliest for the readings, given the stops."""
    is_hit, no_return = np.isfinite(stops.range_m), np.isposinf(stops.range_m)
    wall = is_hit & stops.stopped
    p_model, rate = 1.0 - sensor.p_random, sensor.rate_short_per_m
    # Expectation: probabilities that a reading is random, a passing object, or a return of the wall.
    wall_m = np.where(stops.stopped, np.minimum(stops.distance_m, limits.max_m), limits.max_m)
    reading_m = np.where(is_hit, stops.range_m, 0.0)
    random = np.where(is_hit, sensor.p_random / (limits.max_m - limits.min_m), 0.0)
    short = p_model * sensor.p_short * rate * np.exp(-rate * np.maximum(reading_m, 0.0))
    short = np.where(is_hit & (reading_m < wall_m), short, 0.0)
    scale_m = np.sqrt(sensor.noise.scale_at(wall_m) ** 2 + stops.variance)
    noise = np.exp(sensor.noise.log_density(np.where(wall, reading_m - wall_m, 0.0) / scale_m))
    unblocked = sensor.unblocked(wall_m)
    returned = np.where(wall, p_model * unblocked * (1 - sensor.p_no_return) * noise / scale_m, 0.0)
    density = np.where(is_hit, random + short + returned, 1.0)
    by_chance, by_object, by_wall = random / density, short / density, returned / density
    # Maximisation: random readings, and missed walls.
    p_random = _smoothed_share(by_chance.sum(), float((is_hit | no_return).sum()), sensor.p_random)
    # A stop within range without a return was missed, or its reading lay out of range.
    in_range = stops.stopped & (stops.distance_m <= limits.max_m)
    out_of_range = (1.0 - sensor.p_no_return) * sensor.noise.tail((limits.max_m - wall_m) / scale_m)
    share_missed = sensor.p_no_return / np.maximum(sensor.p_no_return + out_of_range, MIN_SHARE)
    n_missed = float((no_return & in_range) @ share_missed)
    p_no_return = _smoothed_share(n_missed, n_missed + by_wall.sum(), sensor.p_no_return)
    # Passing objects may also be behind the end of the beam, unobserved.
    unblocked_beams = np.where(is_hit, by_wall, no_return * 1.0)
    behind = unblocked_beams * sensor.p_short * np.exp(-rate * wall_m) / unblocked
    # Objects too close to be measured are unobserved as well: this many per object further away.
    too_close = math.expm1(rate * limits.min_m)
    n_observed, n_further = by_object.sum(), by_object.sum() + behind.sum()
    n_objects = n_further * (1.0 + too_close)
    p_short = _smoothed_share(n_objects, n_observed + n_further * too_close + unblocked_beams.sum(), sensor.p_short)
    # The rate is the number of objects over the sum of their distances.
    sum_m = (by_object * reading_m).sum() + (behind * (wall_m + 1.0 / rate)).sum()
    sum_m += n_further * (too_close / rate - limits.min_m)
    new_rate = (n_objects + PSEUDO_BEAMS) / (sum_m + PSEUDO_BEAMS / rate)
    residuals = StopResiduals(reading_m[wall] - wall_m[wall], wall_m[wall], stops.variance[wall], by_wall[wall])
    return BeamMixture(
        noise=refit_noise(sensor.noise, residuals, step_size), rate_short_per_m=_between(rate, new_rate, step_size),
        p_random=max(_between(sensor.p_random, p_random, step_size), MIN_RANDOM),
        p_no_return=_between(max(sensor.p_no_return, MIN_SHARE), p_no_return, step_size),
        p_short=_between(max(sensor.p_short, MIN_SHARE), p_short, step_size),
    )  # fmt: skip


def _smoothed_share(count: float, total: float, present: float) -> float:
    """Estimate a share, drawn a little towards its present value."""
    return float(min(max((count + PSEUDO_BEAMS * present) / (total + PSEUDO_BEAMS), MIN_SHARE), 0.5))


def _between(present: float, estimate: float, step_size: float) -> float:
    """Return the number that lies the share ``step_size`` of the way to the estimate, on a logarithmic scale."""
    return float(math.exp((1 - step_size) * math.log(present) + step_size * math.log(estimate)))


@dataclass(frozen=True, eq=False)
class StopResiduals:
    """Readings of N beams that were stopped, against their stops, (N,) each."""

    residual_m: Floats  # reading minus distance of the stop
    distance_m: Floats  # distance of the stop
    variance: Floats  # variance of the stop along the beam, square metres, added to that of the noise
    weight: Floats  # probability that the reading returned from the stop

    def cost(self, dof: float, scale_m: float, per_m: float) -> float:
        """Return the mean negative log density of noise of scale sqrt((scale_m + per_m distance)^2 + variance)."""
        scale = np.sqrt((scale_m + per_m * self.distance_m) ** 2 + self.variance)
        log_density = noise_with(dof, 1.0, 0.0).log_density(self.residual_m / scale) - np.log(scale)
        return float(-(self.weight * log_density).sum() / self.weight.sum())

    def minimise_cost(self, dof: float, scale_m: float, per_m: float) -> tuple[float, Floats]:
        """Minimise the cost over scale and growth, from these values. Returns the cost, and the logarithms of both."""
        start = np.log([scale_m, max(per_m, 1e-5)])
        simplex = start + SIMPLEX_SIZE * np.eye(3, 2, -1)
        # Nelder-Mead is as fast as any method with two numbers, and uses no threads of linear algebra.
        result = scipy.optimize.minimize(
            lambda logs: self.cost(dof, *np.exp(logs)), start, method="Nelder-Mead",
            bounds=[(math.log(MIN_SCALE_M), math.log(10.0)), (math.log(MIN_GROWTH), 0.0)],
            options={"initial_simplex": simplex, "xatol": TOLERANCE, "fatol": TOLERANCE**2},
        )  # fmt: skip
        return float(result.fun), result.x


def refit_noise(noise: AdditiveNoise, residuals: StopResiduals, step_size: float) -> AdditiveNoise:
    """Move a noise by the share ``step_size`` of the way to the likeliest; a whole step may change the dof (`DOFS`)."""
    n_readings = residuals.weight.sum()
    if n_readings < MIN_WEIGHT:
        return noise
    present = noise.kernel_parameters()
    assert present is not None  # kernels have the noises that are fitted
    dof, scale_m, per_m = present.dof or math.inf, present.sigma_m, present.sigma_per_m
    index = DOFS.index(dof)
    candidates = DOFS[max(index - 1, 0) : index + 2] if step_size == 1.0 else (dof,)
    fits = {candidate: residuals.minimise_cost(candidate, scale_m, per_m) for candidate in candidates}
    # Student's t must be better by the cost of its further parameter (Schwarz 1978).
    dof_cost = 0.5 * math.log(n_readings) / n_readings
    best_dof = min(candidates, key=lambda dof: fits[dof][0] + (dof_cost if dof < math.inf else 0.0))
    present_logs = np.log([scale_m, max(per_m, MIN_GROWTH)])
    return noise_with(best_dof, *np.exp((1 - step_size) * present_logs + step_size * fits[best_dof][1]).tolist())


def refit_prior(prior: Beta, hits: Ints, passes: Ints, step_size: float, solid: Mask | None = None) -> Beta:
    """Move the Beta of each label towards the likeliest for its cells, whose reflectivities are integrated out.
    Cells stopped ``hits`` beams and let ``passes`` beams pass, (T,) each; a cell without counts has negative passes.
    ``solid`` holds the labels, (T,), if the prior has labels.
    """
    counted = passes >= 0
    free = counted if solid is None else counted & ~solid
    a, b = _refit_beta(prior.a, prior.b, hits[free], passes[free], step_size)
    prior = replace(prior, a=a, b=b)
    if solid is None:
        return prior
    full = counted & solid
    a, b = _refit_beta(prior.a_solid, prior.b_solid, hits[full], passes[full], step_size)
    return replace(prior, a_solid=a, b_solid=b)


def _refit_beta(a: float, b: float, hits: Ints, passes: Ints, step_size: float) -> tuple[float, float]:
    """Move a Beta's pseudo-counts towards those that make hits and passes likeliest; without counts they stay."""
    if not len(hits):
        return a, b
    # Both counts as one integer: a hundred times as fast as searching equal pairs.
    base = int(passes.max()) + 1
    pairs, n_cells = np.unique(hits.astype(np.int64) * base + passes, return_counts=True)
    pair_hits, pair_passes = (count.astype(np.float64) for count in np.divmod(pairs, base))

    def cost(logs: Floats) -> float:
        a, b = np.exp(logs)
        terms = special.betaln(a + pair_hits, b + pair_passes) - special.betaln(a, b)
        return float(-(n_cells * terms).sum() / n_cells.sum())

    start = np.log([a, b])
    bounds = [(math.log(1e-4), math.log(10.0)), (math.log(1e-3), math.log(100.0))]  # of log a and log b
    result = scipy.optimize.minimize(cost, start, method="L-BFGS-B", bounds=bounds)
    a, b = np.exp((1 - step_size) * start + step_size * result.x)
    return float(a), float(b)


def fit_coupling_to_scans(
    model: Model, sampler: WallSampler, device: str, *, seed: int, threads: int | None = None, watch: Watch = SILENT
) -> Ising:
    """Return a model's `Ising` prior with the coupling fitted to its scans. A stop by the watch ends pilot and run."""
    prior = replace(cast(Ising, model.cells), coupling=FIRST_COUPLING)
    problem = sampler.prepare(replace(model, cells=prior), device, threads, watch)
    state = sampler.init(problem, [PILOT], seed, watch=watch)
    for sweep in range(COUPLING_SWEEPS):
        state, info = sampler.step(state, 1)
        walls = state.walls().reshape(problem.grid.shape) != 0
        best = maximise_pseudo_likelihood(count_by_balance(walls, np.asarray(prior.p_wall, dtype=np.float64)))
        step_size = step_size_after(sweep, COUPLING_FULL_STEPS_UNTIL)
        prior = replace(prior, coupling=prior.pair_coupling + step_size * (best - prior.pair_coupling))
        state = replace(state, problem=state.problem.under(prior))
        watch.report("fit", sweep + 1, COUPLING_SWEEPS, float(info.log_likelihood[0, -1] + info.log_prior[0, -1]))
        if watch.should_stop():
            break
    return prior
