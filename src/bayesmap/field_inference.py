"""The half of `bayesmap.infer` that is for reflectivities and surfaces: fit, sample, and make a run of it."""

from __future__ import annotations

import hashlib
import json
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

import numpy as np

from bayesmap.cells.reflectivity import Beta, Reflective
from bayesmap.field_result import FieldRun
from bayesmap.posterior.field import FieldPosterior
from bayesmap.run.chain import Progress, Schedule
from bayesmap.run.field_chain import FieldResult, run_field
from bayesmap.run.resuming import check_same
from bayesmap.samplers.field_gibbs import FieldProblem, build_field
from bayesmap.samplers.fit import Parameters
from bayesmap.sensors.describe import describe
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.model import SensorModel
from bayesmap.sensors.noise import Gaussian
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

FIT = "fit"
FIT_SWEEPS = 30
FEWEST_DRAWS, MOST_DRAWS = 50, 200
BEAMS_OF_FEWEST = 100_000
MOST_DRAW_BYTES = 1 << 30
"""Of all chains' draws, if beams were to touch every cell of the grid."""
BYTES_A_CELL = 4
PLAIN_SPREAD = 0.3
"""Where in a plain cell a beam stops is not known to better than this part of its edge: noise that a fit starts
from."""


@dataclass(frozen=True, eq=False)
class FieldJob:
    """What was asked for: the arguments of `bayesmap.infer` that fields have, checked."""

    scans: Scans
    grid: Grid
    prior: Reflective
    sensor: SensorModel | Literal["fit"]
    schedule: Schedule
    chains: int
    seed: int
    hit_depth: float
    threads: int | None
    device: str


def default_draws(beams: int, cells: int, chains: int) -> int:
    """Draws of each chain where none are asked for: as many as take the time of 50 with 100 000 beams, up to 200.

    The fewer the beams, the less certain the map and the more draws its predictions need (docs/defaults.md); and the
    sooner a sweep is over. Never fewer than 50, and no more of large grids than fit in 1 GiB.
    """
    affordable = BEAMS_OF_FEWEST * FEWEST_DRAWS // max(beams, 1)
    fitting = MOST_DRAW_BYTES // (BYTES_A_CELL * cells * chains)
    return max(FEWEST_DRAWS, min(affordable, fitting, MOST_DRAWS))


def first_sensor(prior: Reflective, resolution_m: float) -> BeamMixture:
    """Where a fit starts: a laser with few outliers."""
    sigma_m = 0.02 if prior.has_surfaces else math.hypot(0.02, PLAIN_SPREAD * resolution_m)
    return BeamMixture(Gaussian(sigma_m, 0.003), p_random=0.02, p_no_return=0.01, p_short=0.02)


def fit_sensor(
    scans: Scans,
    grid: Grid,
    *,
    hit_depth: float,
    seed: int = 0,
    device: str = "cpu",
    on_progress: Callable[[Progress], None] | None = None,
) -> BeamMixture:
    """The sensor that explains scans best, with the map unknown: from a short run over reflectivities.

    Raises:
        BadInput: too many incidences for the grid.
    """
    prior = Beta()
    problem = build_field(scans, grid, prior, first_sensor(prior, grid.resolution), hit_depth=hit_depth, device=device)
    schedule = Schedule(FIT_SWEEPS, 0)
    found = run_field(problem, schedule, 1, seed, fit_sensor=True, fit_prior=True, on_progress=on_progress)
    return found.parameters.sensor


def infer_field(
    job: FieldJob,
    *,
    resume: FieldRun | None,
    on_stage: Callable[[Literal["compile", "trace", "start"], int, int], None],
    on_progress: Callable[[Progress], None],
    on_checkpoint: Callable[[FieldRun], None] | None,
    checkpoint_every_s: float,
    should_stop: Callable[[], bool],
) -> FieldRun:
    """Run the chains of a field.

    Raises:
        BadInput: a sensor that fields cannot use, or a run to resume that was made with other arguments.
    """
    began = time.perf_counter()
    fitting = job.sensor == FIT
    sensor = first_sensor(job.prior, job.grid.resolution) if isinstance(job.sensor, str) else job.sensor
    settings = _settings(job, sensor)
    if resume is not None:
        check_same(resume.posterior.settings, settings)
    problem = build_field(
        job.scans,
        job.grid,
        job.prior,
        sensor,
        hit_depth=job.hit_depth,
        device=job.device,
        on_progress=partial(on_stage, "trace"),
    )
    _prepare(problem, on_stage)
    before = None if resume is None or resume.posterior.sweep == 0 else resume.posterior
    trace_seconds = time.perf_counter() - began
    spent = before.seconds["total"] if before else 0.0

    def as_run(found: FieldResult) -> FieldRun:
        total = time.perf_counter() - began + spent
        seconds = {"trace": trace_seconds, "warm_start": 0.0, "sampling": found.seconds, "total": total}
        return FieldRun(_posterior(job, problem, settings, found, seconds))

    result = run_field(
        problem,
        job.schedule,
        job.chains,
        job.seed,
        fit_sensor=fitting,
        fit_prior=fitting,
        threads=job.threads,
        resume=None if before is None else _result_of(before),
        on_progress=on_progress,
        on_checkpoint=None if on_checkpoint is None else lambda found: on_checkpoint(as_run(found)),
        checkpoint_every_s=checkpoint_every_s,
        should_stop=should_stop,
    )
    return as_run(result)


def _prepare(problem: FieldProblem, on_stage: Callable[[Literal["compile", "trace", "start"], int, int], None]) -> None:
    """Compile and count beforehand what the chains would otherwise wait for in silence."""
    from bayesmap.kernels.field import KERNELS, load_field_kernels

    on_stage("compile", 0, len(KERNELS))
    for done in load_field_kernels(problem.device):
        on_stage("compile", done, len(KERNELS))
    on_stage("start", 0, 2)
    _ = problem.guess
    on_stage("start", 1, 2)


def _settings(job: FieldJob, sensor: SensorModel) -> dict[str, Any]:
    from bayesmap.kernels.parallel import available_cores

    settings: dict[str, Any] = {
        "method": "gibbs", "order": None, "chains": job.chains, "warmup": job.schedule.warmup,
        "draws": job.schedule.draws, "thin": job.schedule.thin, "seed": job.seed, "start": "readings",
        "hit_depth": job.hit_depth, "prior": job.prior.describe(),
        "sensor": FIT if isinstance(job.sensor, str) else describe(sensor),
    }  # fmt: skip
    digest = hashlib.blake2b(json.dumps(settings, sort_keys=True).encode())
    grid, scans = job.grid, job.scans
    digest.update(repr((grid.shape, grid.resolution, grid.origin, scans.min_range_m, scans.max_range_m)).encode())
    for array in (scans.poses, scans.angles_rad, scans.ranges_m, scans.beam_poses):
        if array is not None:
            digest.update(np.ascontiguousarray(array).tobytes())
    settings["fingerprint"] = digest.hexdigest()[:16]
    cores = job.threads or available_cores()
    settings["threads_used"] = cores if job.device == "cpu" else 1
    return settings


def _posterior(
    job: FieldJob, problem: FieldProblem, settings: dict[str, Any], found: FieldResult, seconds: dict[str, float]
) -> FieldPosterior:
    rays, prior = problem.rays, found.parameters.prior
    draws = found.reflectivity.shape[0] * found.reflectivity.shape[1]
    if draws:
        mean = found.expected.mean(axis=(0, 1), dtype=np.float64)
        occupancy = rays.to_grid(mean, prior.mean)
    else:
        occupancy = np.full(rays.grid.shape, np.nan)
    told, counted = found.informed
    busy = np.nonzero(problem.guess.busy)[0] if not problem.plain else np.zeros(0, dtype=np.intp)
    return FieldPosterior(
        grid=rays.grid,
        scans=job.scans,
        sensor=found.parameters.sensor,
        prior=prior,
        settings={**settings, "fitted": _fitted(found.parameters) if job.sensor == FIT else None},
        touched=rays.touched,
        busy=busy.astype(np.int32),
        reflectivity=found.reflectivity,
        expected=found.expected,
        surfaces=found.surfaces,
        occupancy=occupancy,
        observed=rays.to_grid((2 * told >= np.maximum(counted, 1)).astype(np.float64), 0.0) > 0,
        log_likelihood=found.log_likelihood,
        log_prior=found.log_prior,
        warmup_log_joint=found.warmup_log_joint,
        states=found.states,
        last_counts=found.last_counts,
        informed=found.informed,
        sweep=found.sweep,
        finished=found.finished,
        seconds=seconds,
        counts={"scans": len(job.scans), "beams": job.scans.n_beams, "incidences": rays.n_incidences},
    )


def _fitted(parameters: Parameters) -> dict[str, Any]:
    return {"sensor": describe(parameters.sensor), "prior": parameters.prior.describe()}


def _result_of(posterior: FieldPosterior) -> FieldResult:
    return FieldResult(
        reflectivity=posterior.reflectivity,
        expected=posterior.expected,
        surfaces=posterior.surfaces,
        log_likelihood=posterior.log_likelihood,
        log_prior=posterior.log_prior,
        warmup_log_joint=posterior.warmup_log_joint,
        states=posterior.states,
        last_counts=posterior.last_counts,
        parameters=Parameters(posterior.sensor, posterior.prior),
        informed=posterior.informed,
        sweep=posterior.sweep,
        seconds=posterior.seconds["sampling"],
        finished=posterior.finished,
    )
