"""The public `infer`: from scans to a posterior, by any of the methods."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from bayesmap.assembly import Assembly
from bayesmap.cells.binary import Independent
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.reflectivity import Reflective
from bayesmap.errors import BadInput, check_count
from bayesmap.field_inference import FIT, FieldJob, default_draws, fit_sensor, infer_field
from bayesmap.field_result import FieldRun
from bayesmap.posterior.posterior import Posterior
from bayesmap.result import Run
from bayesmap.run.chain import Chains, Progress, Schedule, run_chains
from bayesmap.run.interrupt import stop_on_interrupt
from bayesmap.run.resuming import check_same
from bayesmap.samplers.block import BlockGibbs
from bayesmap.samplers.exact import enumerate_maps
from bayesmap.samplers.gibbs import Gibbs
from bayesmap.samplers.importance import Particles, sample_importance
from bayesmap.samplers.problem import Problem
from bayesmap.samplers.propagate import ROUNDS, Marginals, propagate
from bayesmap.samplers.sampler import Order
from bayesmap.samplers.start import Start, default_start, start_maps
from bayesmap.sensors.describe import describe
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

Method = Literal["exact", "importance", "gibbs", "block", "propagate"]
Stage = Literal[
    "trace", "compile", "start", "fit", "propagate", "warm-up", "draws", "particles", "save", "score"
]  # fmt: skip


@dataclass(frozen=True)
class Event:
    """Progress of a run: ``done`` of ``total`` of whatever the stage counts, and the mean log joint where known."""

    stage: Stage
    done: int
    total: int
    log_joint: float | None = None


def infer(
    scans: Scans,
    grid: Grid,
    *,
    prior: CellPrior,
    sensor: SensorModel | Literal["fit"],
    method: Method = "gibbs",
    order: Order = "radial",
    chains: int = 4,
    warmup: int = 100,
    draws: int | None = None,
    thin: int = 1,
    seed: int = 0,
    start: Start | NDArray[np.bool_] | None = None,
    particles: int = 100_000,
    rounds: int = ROUNDS,
    hit_depth: float = 0.0,
    threads: int | None = None,
    device: str = "cpu",
    resume: Run | None = None,
    on_progress: Callable[[Event], None] | None = None,
    on_checkpoint: Callable[[Run], None] | None = None,
    checkpoint_every_s: float = 30.0,
) -> Run:
    """Infer the walls from scans; or, where the prior says that cells stop only some beams, how many, and where.

    The result depends on the arguments up to ``hit_depth`` alone, and on the kind of device in the last bits: neither
    on the number of threads nor on how often the run was stopped and resumed.

    Args:
        scans: what the sensor reported, and from where.
        grid: the map to infer.
        prior: decides what a cell's state is: `Independent` (binary walls), `Beta` (reflectivities) or `Surface`
            (reflectivities and surfaces). The latter two have one method, "gibbs", and neither order nor start.
        sensor: the law of the readings; "fit" fits a `BeamMixture`, and with it the numbers of a `Beta` or `Surface`,
            to the scans themselves.
        method: "gibbs" (single cells), "block" (overlapping 2 x 2 blocks: use it where walls are rare),
            "propagate" (belief propagation: approximate, at once), "importance" (from the prior: for teaching),
            or "exact" (at most 16 unknown cells).
        order: of the cells or blocks in a sweep: "radial", "raster" or "random".
        chains: how many Markov chains; the other methods give ``chains * draws`` independent draws.
        warmup: sweeps of each chain that are not kept.
        draws: maps that each chain keeps; by default 1000, or of `Beta` and `Surface`, whose draws are larger and mix
            in tens of sweeps, 50 to 200, the more the fewer beams there are (`default_draws`); but none for
            "propagate", whose answer is the marginals.
        thin: sweeps from one kept map to the next.
        seed: of all random numbers.
        start: "prior", "zeros", "ones", "propagate", or a map; by default "propagate" on maps of more than 10 000
            cells and "prior" on others.
        particles: of "importance".
        rounds: of belief propagation, at most.
        hit_depth: where in a cell a beam stops, as a fraction of its chord: 0 at the near edge, as in the tutorial.
        threads: chains that run at once, and threads of belief propagation; all cores if None. Building the beam
            table uses all cores in any case.
        device: "cpu" or a CUDA device such as "cuda:0".
        resume: a run with the same arguments that was stopped early: go on where it stopped.
        on_progress: told how far the run is, about four times a second.
        on_checkpoint: given the run so far at the end of warm-up and every ``checkpoint_every_s`` seconds.
        checkpoint_every_s: see above.

    Returns:
        The run. Ctrl-C stops at the end of the current sweeps and returns what there is, with ``finished`` false.

    Raises:
        BadInput: arguments that do not make sense, or a run to resume that was made with others.
    """
    if method not in get_args(Method):
        raise BadInput(f"infer: method must be one of {', '.join(get_args(Method))}, got {method!r}")
    chains = check_count("infer", "chains", chains, 1)
    if draws is None and isinstance(prior, Reflective):
        draws = default_draws(scans.n_beams, grid.n_cells, chains)
    elif draws is None:
        draws = 0 if method == "propagate" else 1000
    schedule = Schedule(
        check_count("infer", "warmup", warmup, 0),
        check_count("infer", "draws", draws, 0),
        check_count("infer", "thin", thin, 1),
    )
    seed = check_count("infer", "seed", seed, 0)
    particles = check_count("infer", "particles", particles, 1)
    rounds = check_count("infer", "rounds", rounds, 1)
    if threads is not None:
        threads = check_count("infer", "threads", threads, 1)
    if not 0.0 <= hit_depth <= 1.0:
        raise BadInput(f"infer: hit_depth must lie in [0, 1], got {hit_depth!r}")
    if isinstance(sensor, str) and sensor != FIT:
        raise BadInput(f"infer: sensor must be a sensor model or {FIT!r}, got {sensor!r}")
    if isinstance(prior, Reflective):
        if method != "gibbs":
            raise BadInput(f"infer: {type(prior).__name__} has one method, 'gibbs', got {method!r}")
        if not isinstance(resume, FieldRun | None):
            raise BadInput("resume: the saved run is one over walls, not over reflectivities or surfaces")
        job = FieldJob(scans, grid, prior, sensor, schedule, chains, seed, hit_depth, threads, device)
        with stop_on_interrupt() as should_stop:
            return infer_field(
                job,
                resume=resume,
                on_stage=_stages(on_progress),
                on_progress=_teller(on_progress),
                on_checkpoint=on_checkpoint,
                checkpoint_every_s=checkpoint_every_s,
                should_stop=should_stop,
            )
    if isinstance(resume, FieldRun):
        raise BadInput("resume: the saved run is one over reflectivities or surfaces, not over walls")
    assert isinstance(prior, Independent)
    began = time.perf_counter()
    if isinstance(sensor, str):
        tell = _teller(on_progress, "fit")
        sensor = fit_sensor(scans, grid, hit_depth=hit_depth, seed=seed, device=device, on_progress=tell)
    problem = _build(scans, grid, prior, sensor, hit_depth, device)
    start = default_start(problem) if start is None else start
    settings: dict[str, Any] = {
        "method": method, "order": order, "chains": chains, "warmup": schedule.warmup, "draws": schedule.draws,
        "thin": schedule.thin, "seed": seed, "start": start if isinstance(start, str) else "given map",
        "particles": particles, "rounds": rounds, "hit_depth": float(hit_depth), "prior": prior.describe(),
        "sensor": describe(sensor),
    }  # fmt: skip
    settings["fingerprint"] = _fingerprint(settings, scans, grid, problem, start)
    if resume is not None:
        check_same(resume.posterior.settings, settings)
    if resume is not None and resume.posterior.sweep == 0:
        resume = None  # stopped before its first sweep: there is nothing to go on with
    before = None if resume is None else resume.posterior
    common = Assembly(problem, scans, sensor, settings, began, time.perf_counter() - began, before)
    with stop_on_interrupt() as should_stop:
        if method == "exact":
            return common.exact(enumerate_maps(problem))
        if method == "importance":
            return common.importance(_weigh(problem, particles, seed, on_progress, should_stop))
        if method == "propagate":
            return common.marginals(_warm(problem, rounds, threads, on_progress, should_stop))
        sampler = Gibbs(problem, order) if method == "gibbs" else BlockGibbs(problem, order)
        warm = None
        if isinstance(start, str) and start == "propagate" and resume is None:
            warm = _warm(problem, rounds, threads, on_progress, should_stop)

        def checkpoint(so_far: Chains) -> None:
            if on_checkpoint is not None:
                on_checkpoint(common.chains(so_far, warm, threads))

        result = run_chains(
            sampler,
            start_maps(problem, start, chains, seed, warm) if resume is None else np.empty((0, *grid.shape), bool),
            schedule,
            seed,
            threads=threads,
            resume=None if resume is None else _chains_of(resume.posterior),
            on_progress=_teller(on_progress),
            on_checkpoint=checkpoint if on_checkpoint is not None else None,
            checkpoint_every_s=checkpoint_every_s,
            should_stop=should_stop,
        )
        return common.chains(result, warm, threads)


def _teller(on_progress: Callable[[Event], None] | None, only: Stage | None = None) -> Callable[[Progress], None]:
    def tell(progress: Progress) -> None:
        if on_progress is not None:
            stage: Stage = only or ("warm-up" if progress.warming_up else "draws")
            on_progress(Event(stage, progress.done, progress.total, float(progress.log_joint.mean())))

    return tell


def _stages(on_progress: Callable[[Event], None] | None) -> Callable[[Stage, int, int], None]:
    def tell(stage: Stage, done: int, total: int) -> None:
        if on_progress is not None:
            on_progress(Event(stage, done, total))

    return tell


def _build(scans: Scans, grid: Grid, prior: Independent, sensor: SensorModel, hit_depth: float, device: str) -> Problem:
    from bayesmap.kernels.device import resolve
    from bayesmap.kernels.trace import trace

    device = resolve(device)
    prior.probabilities(grid)  # shapes are checked before the long work
    table = trace(scans, grid, sensor, hit_depth=hit_depth, device=device)
    return Problem(table=table, prior=prior, poses=scans.poses, device=device)


def _warm(
    problem: Problem,
    rounds: int,
    threads: int | None,
    on_progress: Callable[[Event], None] | None,
    should_stop: Callable[[], bool],
) -> Marginals:
    def tell(done: int, total: int, change: float) -> None:
        if on_progress is not None:
            on_progress(Event("propagate", done, total))

    return propagate(problem, rounds=rounds, threads=threads, on_round=tell, should_stop=should_stop)


def _weigh(
    problem: Problem,
    particles: int,
    seed: int,
    on_progress: Callable[[Event], None] | None,
    should_stop: Callable[[], bool],
) -> Particles:
    def tell(done: int, total: int) -> None:
        if on_progress is not None:
            on_progress(Event("particles", done, total))

    tell(0, particles)  # of a large map the first particles take a while
    return sample_importance(problem, particles, seed, on_progress=tell, should_stop=should_stop)


def _chains_of(posterior: Posterior) -> Chains:
    return Chains(
        packed=posterior.packed,
        log_likelihood=posterior.log_likelihood,
        log_prior=posterior.log_prior,
        warmup_log_joint=posterior.warmup_log_joint,
        walls=posterior.walls,
        sweep=posterior.sweep,
        seconds=posterior.seconds["sampling"],
        finished=posterior.finished,
    )


def _fingerprint(
    settings: dict[str, Any], scans: Scans, grid: Grid, problem: Problem, start: Start | NDArray[np.bool_]
) -> str:
    """What a run is determined by: settings, data, prior and start."""
    digest = hashlib.blake2b(json.dumps(settings, sort_keys=True).encode())
    digest.update(repr((grid.shape, grid.resolution, grid.origin, scans.min_range_m, scans.max_range_m)).encode())
    # The table's likelihoods stand for the sensor, which may be of the user's own making.
    table = problem.table
    for array in (scans.poses, scans.angles_rad, scans.ranges_m, problem.p_wall, table.loglik, table.no_hit):
        digest.update(np.ascontiguousarray(array).tobytes())
    if not isinstance(start, str):
        digest.update(np.ascontiguousarray(start, dtype=np.bool_).tobytes())
    return digest.hexdigest()[:16]
